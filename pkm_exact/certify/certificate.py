"""A certificate as an object: read from a file or made of a solution, checked, and written.

The bytes are kept as they are: what is checked is the file, not what a reader made of it.
"""

from __future__ import annotations

import errno
import json
import os
import stat
from dataclasses import dataclass, field
from functools import cached_property
from html import escape
from typing import TYPE_CHECKING, Any

from pkm_exact.errors import InputError
from pkm_exact.files import write_whole
from pkm_exact.wording import printable

if TYPE_CHECKING:
    from pkm_exact.certify.checker.verdict import Verdict


@dataclass(frozen=True, repr=False)
class Certificate:
    """The content of a certificate file. That it can be read does not mean that it is true: ``check`` it.

    Attributes
    ----------
    data : bytes
        All of the file.

    Examples
    --------
    >>> found = Certificate.load("certs/3-rpr-merlet-p.json")
    >>> found.content["claim"], found.content["real_poses"]
    ('complete', 2)
    >>> verdict = found.check()
    >>> print(verdict.status, len(verdict.lines) > 3)
    accepted True
    """

    data: bytes = field(repr=False)

    @classmethod
    def load(cls, path: str | os.PathLike[str]) -> Certificate:
        """The certificate in a file.

        Raises
        ------
        InputError
            If the file cannot be read, or is larger than any certificate.

        Examples
        --------
        >>> str(Certificate.load("certs/3-rrr.json").check().status)
        'accepted'
        """
        from pkm_exact.certify.checker.verdict import MAX_BYTES

        data = content_of(path)
        if len(data) > MAX_BYTES:
            name = printable(os.fsdecode(path))
            raise InputError(f"{name}: is larger than {MAX_BYTES} bytes; give the path of a certificate")
        return cls(data)

    @cached_property
    def content(self) -> dict[str, Any]:
        """The JSON object, as the file has it: nothing in it is proved before ``check`` accepts it.

        Raises
        ------
        InputError
            If it is no JSON object.
        """
        try:
            content = json.loads(self.data)
        except (ValueError, RecursionError):
            content = None
        if not isinstance(content, dict):
            raise InputError("certificate: is not a JSON object; give one that pkm_exact wrote")
        return content

    def check(self) -> Verdict:
        """The verdict of the checker, which shares nothing with the solver; it never raises on account of the data.

        Examples
        --------
        >>> Certificate.load("certs/3-rpr-merlet-p.json").check().lines[-1]
        'complete: polynomials over Q that vanish at all poses leave room for 6, there is no other'
        """
        from pkm_exact.certify.check import check_bytes
        from pkm_exact.precision import working_precision

        with working_precision():  # no other thread changes it; the checker itself imports nothing of this
            return check_bytes(self.data)

    def save(self, path: str | os.PathLike[str]) -> None:
        """Write it to a file, which appears whole or not at all.

        Raises
        ------
        InputError
            If the file cannot be written.
        """
        try:
            write_whole(path, self.data)
        except OSError as error:
            name = printable(os.fsdecode(path))
            raise InputError(f"{name}: cannot be written ({error.strerror}); give another path") from None

    def __str__(self) -> str:
        try:
            content = self.content
        except InputError:
            return "no JSON object; not checked yet"
        robot = content.get("robot")
        name = robot.get("name") if isinstance(robot, dict) else content.get("title")
        return f"{printable(str(name))}, claim: {printable(str(content.get('claim')))}; not checked yet"

    def __repr__(self) -> str:
        return f"<Certificate: {len(self.data)} bytes>"

    def _repr_html_(self) -> str:
        return f"<p>{escape(repr(self))} {escape(str(self))}: use <code>.check()</code></p>"


def content_of(path: str | os.PathLike[str]) -> bytes:
    """The content of a file, cut off where it is too large for a certificate anyway.

    Raises
    ------
    InputError
        If it cannot be read.
    """
    from pkm_exact.certify.checker.verdict import MAX_BYTES

    name = os.fsdecode(path)
    try:
        # Opening a pipe must not wait for a writer.
        with open(os.open(name, os.O_RDONLY | getattr(os, "O_NONBLOCK", 0)), "rb") as stream:  # noqa: PTH123
            if not stat.S_ISREG(os.fstat(stream.fileno()).st_mode):
                raise OSError(errno.EINVAL, "not a regular file")
            return stream.read(MAX_BYTES + 1)
    except (OSError, ValueError) as error:
        reason = error.strerror if isinstance(error, OSError) else str(error)
        raise InputError(f"{printable(name)}: cannot be read ({reason}); give the path of a certificate") from None


def check(certificate: Certificate | str | os.PathLike[str]) -> Verdict:
    """The checker's verdict on a certificate, or on the file at a path.

    A verdict is true if the certificate was accepted: everything that it claims was proved again.

    Raises
    ------
    InputError
        If the file cannot be read.

    Examples
    --------
    >>> bool(check("certs/3-rpr-merlet-p.json"))
    True
    """
    return (certificate if isinstance(certificate, Certificate) else Certificate.load(certificate)).check()
