"""The one spelling of certificates of all kinds, and their digest."""

from __future__ import annotations

import json
from hashlib import sha256
from json.encoder import encode_basestring_ascii
from typing import Any, Final

_TEXTS: Final = {str}


def sealed(content: dict[str, Any]) -> dict[str, Any]:
    """The object with the digest of all its other entries as last entry.

    Examples
    --------
    >>> sealed({"version": 1})["digest"][:20]
    'sha256:aa2c737df4367'
    """
    body = {key: value for key, value in content.items() if key != "digest"}
    return {**body, "digest": digest_of(canonical_bytes(body))}


def digest_of(body: bytes) -> str:
    """That of the bytes of all other entries."""
    return f"sha256:{sha256(body).hexdigest()}"


def canonical_bytes(content: object) -> bytes:
    r"""The one spelling of a JSON value that certificates use: one entry per line, ASCII only, a line feed at the end.

    Examples
    --------
    >>> canonical_bytes({"a": [1, "é"]})
    b'{\n "a": [\n  1,\n  "\\u00e9"\n ]\n}\n'
    """
    return (_text(content, "\n") + "\n").encode("ascii")


def _text(value: object, line: str) -> str:
    """What ``json.dumps`` with an indent of 1 writes after the given beginning of a line, in a third of its time."""
    if type(value) is str:
        return encode_basestring_ascii(value)
    if type(value) is int:
        return str(value)
    inner = line + " "
    if isinstance(value, (list, tuple)) and value:
        # Most lists are of texts.
        is_text = set(map(type, value)) == _TEXTS
        entries = map(encode_basestring_ascii, value) if is_text else [_text(entry, inner) for entry in value]
        return f"[{inner}{f',{inner}'.join(entries)}{line}]"
    if isinstance(value, dict) and value:
        entries = [f"{inner}{encode_basestring_ascii(k)}: {_text(v, inner)}" for k, v in value.items()]
        return f"{{{','.join(entries)}{line}}}"
    return json.dumps(value, allow_nan=False)
