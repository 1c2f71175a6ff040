"""Changes of JSON documents that keep them JSON, so that a fuzzer gets past the parser and the digest."""

from __future__ import annotations

import json
from collections.abc import Iterator
from random import Random
from typing import Any

from pkm_exact.certify.build import canonical_bytes, sealed

Place = tuple[Any, Any]
"""A list or object, and the index or key of an entry."""
LONG = 10**400
WORDS = (
    "complete",
    "inconsistent",
    "not-proven-complete",
    "positive-dimensional-proved",
    "krawczyk",
    "exact",
    "0x1",
    "",
)


def mutated(data: bytes, seed: int) -> bytes | None:
    """The document with some entries changed and its digest made to fit; None if it is no JSON object."""
    try:
        content = json.loads(data)
    except (ValueError, RecursionError):
        return None
    if not isinstance(content, dict):
        return None
    random = Random(seed)
    for _ in range(random.choice((1, 1, 1, 2, 4))):
        places = list(_places(content))
        if not places:
            break
        _change(random, *random.choice(places), places)
    try:
        content.pop("digest", None)
        return canonical_bytes(sealed(content))
    except (TypeError, ValueError, RecursionError):
        return json.dumps(content).encode()


def _places(value: Any) -> Iterator[Place]:
    entries = value.items() if isinstance(value, dict) else enumerate(value) if isinstance(value, list) else ()
    for key, entry in entries:
        yield value, key
        yield from _places(entry)


def _change(random: Random, owner: Any, key: Any, places: list[Place]) -> None:
    """Change one entry; its owner is changed in place."""
    value = owner[key]
    if isinstance(value, list) and value and random.random() < 0.7:
        _rearrange(random, value)
    elif random.random() < 0.2:
        other, place = random.choice(places)
        owner[key] = json.loads(json.dumps(other[place]))
    elif isinstance(owner, dict) and random.random() < 0.1:
        owner[random.choice((f"{key}_", str(key)[:-1], "extra"))] = owner.pop(key)
    else:
        owner[key] = random.choice(list(_others(random, value)))


def _rearrange(random: Random, values: list[Any]) -> None:
    one, two = random.randrange(len(values)), random.randrange(len(values))
    match random.randrange(4):
        case 0:
            del values[one]
        case 1:
            values.insert(two, json.loads(json.dumps(values[one])))
        case 2:
            values[one], values[two] = values[two], values[one]
        case _:
            del values[one:]


def _others(random: Random, value: Any) -> Iterator[Any]:
    yield from (None, [], {}, True, 0, -1, 1.5, random.choice(WORDS), LONG, str(LONG))
    if isinstance(value, int):
        yield from (value + 1, value - 1, -value, 2 * value, value + (1 << random.randrange(64)))
    if isinstance(value, str):
        yield from (value + "0", value[:-1], "-" + value, value.replace("/", "/-"), f"{value}/3", f" {value}")
        if value:
            index = random.randrange(len(value))
            yield from (value[:index] + random.choice("0123456789abcdef-/.") + value[index + 1 :] for _ in range(6))
