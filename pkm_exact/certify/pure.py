"""Checks certificates a second time, with Python's integers and nothing else: a file that runs alone.

    python pure.py CERT.json...

It prints what ``certify-poses check`` prints, and takes longer: one line per claim that was proved, then accepted,
rejected, malformed or too-large. Exit code: 0 if all are accepted, 1 if one is rejected, otherwise 2. Certificates of
version 2 need the file ``pure_mechanism.py`` beside this one, those of polynomial systems ``pure_system.py``, of
mobility ``pure_mobility.py`` and ``pure_mobility_ideal.py``, of regions ``pure_region.py``, of statics
``pure_statics.py`` (with ``pure_statics_box.py`` for version 2, and ``pure_statics_equations.py`` too for version 4),
of mechanisms with passive bodies ``pure_links.py``.

Written from the definition of the format and its proofs, ``docs/certificates.md``; the sections below have its order
and its notation. It shares no line with the other checker and needs no library, so an error of one of them, or of
FLINT, shows as a disagreement. The three ideas that make plain integers suffice:

* A polynomial of bounded coefficients is its value at X = 2^k, for k large enough. So an identity modulo the eliminant
  is one division of integers (``Multiples``).
* What is computed modulo a number is proved over Q by putting it back into the equations (``echelon_form``), or because
  the number is greater than what would be if it were not 0 (``has_dependent_lines``).
* Real numbers are pairs of integers over 2^p, rounded outward (``Interval``).
"""

from __future__ import annotations

import errno
import json
import os
import re
import stat
import sys
from collections.abc import Callable, Iterable, Iterator, Mapping, Sequence
from contextvars import ContextVar
from dataclasses import dataclass, replace
from fractions import Fraction
from functools import partial
from hashlib import sha256
from importlib import import_module
from itertools import accumulate, chain, combinations, count, islice, pairwise
from math import gcd, isqrt, lcm
from typing import Any, Final, NamedTuple, TypeAlias, TypeVar

__all__ = ["Verdict", "check_bytes", "main"]

# ---------------------------------------------------------------------------------------------------------------------
# Limits and verdicts
# ---------------------------------------------------------------------------------------------------------------------

MAX_BYTES: Final = 64 << 20
MAX_ENTRIES: Final = 1 << 20  # commas and brackets
MAX_TEXT: Final = 10_000
MAX_DEPTH: Final = 16
MAX_JOINT_DIGITS: Final = 600
MAX_RATIONAL_LENGTH: Final = 10_000
MAX_INTEGER_LENGTH: Final = 12
MAX_COEFFICIENT_BITS: Final = 1 << 18
MAX_DEGREE: Final = 2000
MAX_BOX_EXPONENT: Final = 8192
MAX_BOX_GRID: Final = 2048  # of boxes around solutions
MAX_ISOLATION: Final = 4096  # real roots in cells of the grid 2^-4096 that touch are too close
MAX_PRECISION: Final = 1 << 14
MAX_PRODUCTS: Final = 5000
MAX_CELL_BITS: Final = 14_000  # Python writes no integers of more than 4300 decimal digits
MAX_MONOMIAL_DEGREE: Final = 100  # where an algebra is needed
MAX_TERMS: Final = 1 << 20  # of the products of a step, and of all elements
MAX_ENTRIES_OF_A_MATRIX: Final = 1 << 22

GREATEST_NUMBER: Final = 40
"""Degree of the variety of rigid motions: six legs have no more isolated poses."""

PLANAR_NUMBER: Final = 6
"""Degree of the variety of planar motions."""


class Verdict(NamedTuple):
    """The answer on a certificate.

    Attributes
    ----------
    status : str
        "accepted", "rejected", "malformed" or "too-large".
    lines : tuple of str
        One line per claim that was proved; the last one says why the certificate was not accepted, if it was not.
    """

    status: str
    lines: tuple[str, ...]


class Refusal(Exception):  # noqa: N818 - the end of a check, no error of the program
    """Ends a check with a status and a reason."""

    def __init__(self, status: str, line: str) -> None:
        super().__init__(line)
        self.status = status
        self.line = line


def require(holds: object, line: str) -> None:
    """Reject unless the claim holds."""
    if not holds:
        raise Refusal("rejected", line)


def well_formed(holds: object, line: str) -> None:
    """Refuse what is not a certificate."""
    if not holds:
        raise Refusal("malformed", line)


def affordable(holds: object, line: str) -> None:
    """Refuse what exceeds a limit."""
    if not holds:
        raise Refusal("too-large", line)


# ---------------------------------------------------------------------------------------------------------------------
# Work: counted before it is done, from sizes alone; an operation stands for about a nanosecond
# ---------------------------------------------------------------------------------------------------------------------

WORK_OF_ANY_FILE: Final = 200 * 10**9
WORK_OF_A_BYTE: Final = 600 * 10**3


class Work:
    """What a file of a size may cost, and what was spent on it."""

    def __init__(self, size: int) -> None:
        self.size = size
        self.allowed = WORK_OF_ANY_FILE + WORK_OF_A_BYTE * size
        self.spent = 0
        self.tried: int | None = None

    def spend(self, operations: int) -> None:
        """Count operations; refuse if they are too many."""
        if self.tried is not None and self.spent + operations > self.tried:
            raise Refusal("too-large", "work: an attempt takes more than its part of what is allowed")
        self.spent += operations
        affordable(
            self.spent <= self.allowed,
            f"work: checking takes more than {self.allowed} operations, all that a file of {self.size} bytes may cost",
        )


WORK: Final[ContextVar[Work | None]] = ContextVar("WORK", default=None)
"""That of the file being checked."""


def spend(operations: int) -> None:
    """Count operations, about to be done, on the file being checked, if it is a file that is checked."""
    work = WORK.get()
    if work is not None:
        work.spend(operations)


Found = TypeVar("Found")


def attempted(find: Callable[[], Found], part: int) -> Found | None:
    """What is found with one part, of so many, of the work allowed; None if that is not enough."""
    work = WORK.get()
    try:
        if work is not None:
            work.tried = work.spent + work.allowed // part
        return find()
    except Refusal as refusal:
        if refusal.status != "too-large":
            raise
        return None
    finally:
        if work is not None:
            work.tried = None


def product_cost(a: int, b: int) -> int:
    """Operations for a product of integers of a and b bits: Karatsuba's method above some size."""
    small, large = (a, b) if a < b else (b, a)
    times = large // (small + 1) + 1
    while small > 2000:
        small, times = small // 2, 3 * times
    return 150 + times * (small * small // 900 + small // 10)


def division_cost(quotient: int, divisor: int) -> int:
    """Operations for a quotient, both in bits, or for a greatest common divisor or an inverse of numbers so long."""
    return 300 + (quotient + 30) * (divisor + 30) // 750


def fraction_cost(a: int, b: int) -> int:
    """Operations for a sum or a product of fractions, with numerators and denominators of a and b bits."""
    return 4000 + 8 * (a + b) + a * b // 350


def most_bits(values: Iterable[int]) -> int:
    """The length of the longest number."""
    return max((value.bit_length() for value in values), default=0)


# ---------------------------------------------------------------------------------------------------------------------
# Format and spelling
# ---------------------------------------------------------------------------------------------------------------------

RATIONAL: Final = re.compile(r"(?:0|-?[1-9][0-9]*)(?:/[1-9][0-9]*)?", re.ASCII)
HEXADECIMAL: Final = re.compile(r"0x0|-?0x[1-9a-f][0-9a-f]*", re.ASCII)
PRODUCT: Final = re.compile(r"(?:0|[1-9][0-9]{0,5})(?: (?:[0-9]|1[0-5])){0,8}", re.ASCII)
FORMULATION: Final = re.compile(r"(?:SE3|AFD[1-6]|AFP[1-4])(?::[a-z0-9]{1,10})?", re.ASCII)

KINDS: Final = {"6-UPS": 6, "3-RPR": 3}
METHODS: Final = ("exact", "krawczyk")
CLAIMS: Final = (
    "complete",
    "not-proven-complete",
    "positive-dimensional-detected",
    "positive-dimensional-proved",
    "inconsistent",
)
ROUTES: Final = ("refined-bezout", "exact-elimination")

KEYS: Final = (
    "format version robot configuration formulation method claim completeness_route complex_solutions "
    "distinct_solutions real_poses representation elimination krawczyk box_exponent poses notes"
)

Reader: TypeAlias = Callable[[Any, str], Any]
Ends: TypeAlias = tuple[str, str]
Point: TypeAlias = tuple[Fraction, ...]
Metric: TypeAlias = tuple[int, int, int]
Polynomial: TypeAlias = list[int]  # lowest degree first, the last coefficient not 0
Step: TypeAlias = tuple[tuple[int, ...], ...]  # products: index of an element, then those of the unknowns


@dataclass(frozen=True)
class Leg:
    """A leg from base joint A to platform joint B, with its squared length."""

    base: Point
    platform: Point
    length_squared: Fraction


@dataclass(frozen=True)
class Representation:
    """(e, f) = (E, F)(t) / h'(t) at the roots t of h, with w.e = 1 and c.(e, f) = t; ``numerators`` are E, then F."""

    w: tuple[int, ...]
    c: tuple[int, ...]
    h: Polynomial
    numerators: tuple[Polynomial, ...]


@dataclass(frozen=True, slots=True)
class Gaussian:
    """A number of Q(i)."""

    re: Fraction
    im: Fraction

    def __add__(self, other: Gaussian) -> Gaussian:
        return Gaussian(self.re + other.re, self.im + other.im)

    def __sub__(self, other: Gaussian) -> Gaussian:
        return Gaussian(self.re - other.re, self.im - other.im)

    def __mul__(self, other: Gaussian) -> Gaussian:
        return Gaussian(self.re * other.re - self.im * other.im, self.re * other.im + self.im * other.re)

    def __rmul__(self, scalar: int | Fraction) -> Gaussian:
        return Gaussian(scalar * self.re, scalar * self.im)

    def largest(self) -> Fraction:
        """The larger one of |Re| and |Im|."""
        return max(abs(self.re), abs(self.im))

    def size(self) -> Fraction:
        """|Re| + |Im|, submultiplicative."""
        return abs(self.re) + abs(self.im)

    def rounded(self, p: int) -> Gaussian:
        """A number nearby with denominator 2^p."""
        return Gaussian(*(Fraction(round(part * (1 << p)), 1 << p) for part in (self.re, self.im)))


NULL: Final = Gaussian(Fraction(0), Fraction(0))
UNIT: Final = Gaussian(Fraction(1), Fraction(0))


@dataclass(frozen=True)
class Box:
    """All x with |Re (x_i - m_i)| and |Im (x_i - m_i)| at most r_i; real x only, if it is real.

    ``bits`` is the greatest of the exponents and of the lengths of the integers that give the centre.
    """

    centre: tuple[Gaussian, ...]
    radius: tuple[Fraction, ...]
    bits: int
    real: bool

    def conjugate(self) -> Box:
        """The box of the conjugate points."""
        return Box(tuple(Gaussian(m.re, -m.im) for m in self.centre), self.radius, self.bits, self.real)

    def is_disjoint(self, other: Box) -> bool:
        """Whether no point is in both."""
        gaps = (a - b for a, b in zip(self.centre, other.centre, strict=True))
        reaches = (r + s for r, s in zip(self.radius, other.radius, strict=True))
        return any(max(abs(gap.re), abs(gap.im)) > reach for gap, reach in zip(gaps, reaches, strict=True))

    def holds(self, other: Box) -> bool:
        """Whether the other box, real if this one is, lies in this one."""
        gaps = (a - b for a, b in zip(self.centre, other.centre, strict=True))
        rooms = (r - s for r, s in zip(self.radius, other.radius, strict=True))
        return all(max(abs(gap.re), abs(gap.im)) <= room for gap, room in zip(gaps, rooms, strict=True))


class Boxes(NamedTuple):
    """Boxes in the chart w.e = 1 of Study coordinates, with one solution each; others stand for two conjugate ones."""

    w: tuple[int, ...]
    real: tuple[Box, ...]
    others: tuple[Box, ...]

    def number(self) -> int:
        """How many solutions they stand for."""
        return len(self.real) + 2 * len(self.others)


@dataclass(frozen=True)
class ListedPose:
    """A pose as listed: ends of intervals as texts; ``box`` is position, rotation by rows, quaternion."""

    parameter: Ends | None
    box: tuple[Ends, ...]
    multiplicity: int | None


@dataclass(frozen=True)
class Certificate:
    """What a certificate says."""

    metric: Metric
    legs: tuple[Leg, ...]
    method: str
    claim: str
    route: str | None
    counts: tuple[int, int, int]  # complex solutions, distinct solutions, real poses
    representation: Representation | None
    elimination: tuple[Step, ...] | None
    boxes: Boxes | None
    box_exponent: int
    poses: tuple[ListedPose, ...]


def parsed(data: bytes) -> dict[str, Any]:
    """The JSON object without its digest, in its one spelling."""
    affordable(len(data) <= MAX_BYTES, f"file: more than {MAX_BYTES} bytes")
    spend(1000 * len(data))
    entries = data.count(b",") + data.count(b"[") + data.count(b"{")
    affordable(entries <= MAX_ENTRIES, f"file: more than {MAX_ENTRIES} entries")
    try:
        content = json.loads(
            data.decode("ascii"),
            object_pairs_hook=without_repeated_keys,
            parse_int=short_integer,
            parse_float=no_number,
            parse_constant=no_number,
        )
        well_formed(
            isinstance(content, dict) and isinstance(content.get("digest"), str),
            "file: not a JSON object with a digest",
        )
        well_formed(is_shallow(content), "file: brackets are nested too deeply")
        digest = content.pop("digest")
        body, whole = canonical(content), canonical({**content, "digest": digest})
    except RecursionError:
        raise Refusal("malformed", "file: brackets are nested too deeply") from None
    except ValueError:
        raise Refusal("malformed", "file: not JSON in ASCII") from None
    require(digest == f"sha256:{sha256(body).hexdigest()}", "digest: differs from that of the content")
    well_formed(data == whole, "file: not in canonical form, one entry per line with an indent of one space per level")
    return dict(content)


def is_shallow(content: object) -> bool:
    """Whether nothing is nested deeply: lines are indented, so that depth makes the one spelling long."""
    level: list[Any] = [content]
    for _ in range(MAX_DEPTH):
        lists = [list(value.values()) if isinstance(value, dict) else value for value in level]
        level = [entry for values in lists if isinstance(values, list) for entry in values]
    return not level


def canonical(content: object) -> bytes:
    """The one spelling of a content."""
    return (json.dumps(content, indent=1, ensure_ascii=True) + "\n").encode("ascii")


def without_repeated_keys(pairs: list[tuple[str, Any]]) -> dict[str, Any]:
    """An object as a dictionary; refused if a key occurs twice."""
    content = dict(pairs)
    well_formed(len(content) == len(pairs), "file: a key occurs twice in one object")
    return content


def short_integer(text: str) -> int:
    """An integer; refused, before a number is made of it, if it is long."""
    well_formed(len(text) <= MAX_INTEGER_LENGTH, f"file: an integer of more than {MAX_INTEGER_LENGTH} digits")
    return int(text)


def no_number(_text: str) -> float:
    """Refuse what is not an integer."""
    raise Refusal("malformed", "file: a number with a decimal point or an exponent, or no number at all")


def an_object(value: Any, where: str, keys: str) -> list[Any]:
    """The values of an object with exactly these keys, in this order."""
    names = keys.split()
    well_formed(
        isinstance(value, dict) and list(value) == names,
        f"{where}: not an object with the keys {', '.join(names)}, in this order",
    )
    return list(value.values())


def a_list(read: Reader, length: int | None = None) -> Reader:
    """The reader of lists of a length (any if None) whose entries ``read`` reads."""

    def reader(value: Any, where: str) -> tuple[Any, ...]:
        fits = isinstance(value, list) and (length is None or len(value) == length)
        well_formed(fits, f"{where}: not a list" + (f" of {length}" if length else ""))
        return tuple(read(entry, f"{where}[{number}]") for number, entry in enumerate(value, 1))

    return reader


def a_text(value: Any, where: str) -> str:
    """A text."""
    well_formed(isinstance(value, str), f"{where}: not a text")
    affordable(len(value) <= MAX_TEXT, f"{where}: more than {MAX_TEXT} characters")
    return str(value)


def one_of(words: Iterable[str]) -> Reader:
    """The reader of texts that must be one of the words."""

    def reader(value: Any, where: str) -> str:
        well_formed(isinstance(value, str) and value in words, f"{where}: not one of {', '.join(words)}")
        return str(value)

    return reader


def an_integer(value: Any, where: str) -> int:
    """An integer written as a JSON number."""
    well_formed(type(value) is int, f"{where}: not an integer")
    return int(value)


def a_number(value: Any, where: str) -> int:
    """An integer that is not negative."""
    number = an_integer(value, where)
    well_formed(number >= 0, f"{where}: negative")
    return number


def a_rational_text(value: Any, where: str) -> str:
    """A text p or p/q; that it is in lowest terms shows when it is compared."""
    well_formed(isinstance(value, str), f"{where}: not a rational number in quotes")
    affordable(len(value) <= MAX_RATIONAL_LENGTH, f"{where}: more than {MAX_RATIONAL_LENGTH} characters")
    well_formed(RATIONAL.fullmatch(value), f"{where}: not a rational number p or p/q")
    return str(value)


def a_rational(value: Any, where: str, digits: int = MAX_JOINT_DIGITS) -> Fraction:
    """A rational number in lowest terms."""
    text = a_rational_text(value, where)
    numerator, _, denominator = text.partition("/")
    short = max(len(numerator), len(denominator)) <= digits
    affordable(short, f"{where}: more than {digits} digits")
    number = Fraction(int(numerator), int(denominator or "1"))
    well_formed(str(number) == text, f"{where}: not in lowest terms")
    return number


def a_positive_rational(value: Any, where: str) -> Fraction:
    """A rational number above 0."""
    number = a_rational(value, where)
    well_formed(number > 0, f"{where}: not positive")
    return number


def a_hexadecimal(value: Any, where: str) -> int:
    """An integer in hexadecimal digits."""
    well_formed(isinstance(value, str), f"{where}: not an integer in hexadecimal digits")
    affordable(4 * len(value) <= MAX_COEFFICIENT_BITS, f"{where}: more than {MAX_COEFFICIENT_BITS} bits")
    well_formed(HEXADECIMAL.fullmatch(value), f"{where}: not an integer in hexadecimal digits")
    return int(value, 16)


def a_polynomial(value: Any, where: str) -> Polynomial:
    """A polynomial over Z."""
    affordable(not isinstance(value, list) or len(value) <= MAX_DEGREE + 1, f"{where}: degree above {MAX_DEGREE}")
    coefficients = list(a_list(a_hexadecimal)(value, where))
    well_formed(not coefficients or coefficients[-1], f"{where}: the coefficient of highest degree is 0")
    return coefficients


def a_product(value: Any, where: str) -> tuple[int, ...]:
    """The index of an element, then those of unknowns."""
    text = a_text(value, where)
    fits = PRODUCT.fullmatch(text)
    well_formed(fits, f"{where}: not the index of an element and those of the unknowns that multiply it")
    index, *factors = map(int, text.split(" "))
    well_formed(factors == sorted(factors), f"{where}: the unknowns are not in increasing order")
    return index, *factors


def a_step(value: Any, where: str) -> Step:
    """The products of a step of an elimination."""
    few = not isinstance(value, list) or len(value) <= MAX_PRODUCTS
    affordable(few, f"{where}: more than {MAX_PRODUCTS} products")
    return a_list(a_product)(value, where)  # type: ignore[no-any-return]


def nullable(read: Reader) -> Reader:
    """The reader that also reads null."""
    return lambda value, where: None if value is None else read(value, where)


an_interval: Final = a_list(a_rational_text, 2)


def a_pose(value: Any, where: str) -> ListedPose:
    """A pose as listed."""
    values = an_object(value, where, "parameter position rotation quaternion multiplicity")
    parameter, position, rotation, quaternion, multiplicity = values
    rows = a_list(a_list(an_interval, 3), 3)(rotation, f"{where}.rotation")
    box = (
        *a_list(an_interval, 3)(position, f"{where}.position"),
        *(entry for row in rows for entry in row),
        *a_list(an_interval, 4)(quaternion, f"{where}.quaternion"),
    )
    times = nullable(a_number)(multiplicity, f"{where}.multiplicity")
    return ListedPose(nullable(an_interval)(parameter, f"{where}.parameter"), box, times)


def a_representation(value: Any, where: str) -> Representation:
    """A rational univariate representation."""
    w, c, h, e, f = an_object(value, where, "chart separating_form eliminant quaternion translation")
    eliminant = a_polynomial(h, f"{where}.eliminant")
    well_formed(len(eliminant) > 1, f"{where}.eliminant: constant")
    return Representation(
        w=a_list(an_integer, 4)(w, f"{where}.chart"),
        c=a_list(an_integer, 8)(c, f"{where}.separating_form"),
        h=eliminant,
        numerators=(
            *a_list(a_polynomial, 4)(e, f"{where}.quaternion"),
            *a_list(a_polynomial, 4)(f, f"{where}.translation"),
        ),
    )


def a_box(value: Any, where: str, *, real: bool) -> Box:
    """A box around a solution."""
    exponents, centre = an_object(value, where, "exponents centre")
    a, b = a_list(a_number, 2)(exponents, f"{where}.exponents")
    affordable(max(a, b) <= MAX_BOX_GRID, f"{where}.exponents: more than {MAX_BOX_GRID}")
    values = a_list(a_hexadecimal if real else a_list(a_hexadecimal, 2), 8)(centre, f"{where}.centre")
    parts = [(value, 0) for value in values] if real else values
    bits = max(abs(part).bit_length() for pair in parts for part in pair)
    affordable(bits <= 2 * MAX_BOX_GRID, f"{where}.centre: a coordinate of more than {2 * MAX_BOX_GRID} bits")
    units = [Fraction(1, 1 << a)] * 4 + [Fraction(1, 1 << b)] * 4
    points = tuple(Gaussian(x * unit, y * unit) for (x, y), unit in zip(parts, units, strict=True))
    return Box(points, tuple(4 * unit for unit in units), max(a, b, bits), real)


def a_list_of_boxes(value: Any, where: str) -> Boxes:
    """Boxes around real and around complex solutions."""
    chart, real, others = an_object(value, where, "chart real complex")
    few = not isinstance(real, list) or not isinstance(others, list) or len(real) + 2 * len(others) <= GREATEST_NUMBER
    require(few, f"boxes: more than {GREATEST_NUMBER} solutions, the degree of the rigid motions")
    return Boxes(
        a_list(an_integer, 4)(chart, f"{where}.chart"),
        a_list(partial(a_box, real=True))(real, f"{where}.real"),
        a_list(partial(a_box, real=False))(others, f"{where}.complex"),
    )


def a_robot(value: Any, where: str) -> tuple[Metric, Sequence[Point], Sequence[Point]]:
    """Metric, base joints and platform joints."""
    values = an_object(value, where, "name kind unit source metric base platform")
    name, kind, unit, source, metric, base, platform = values
    for label, text in (("name", name), ("unit", unit), ("source", source)):
        a_text(text, f"{where}.{label}")
    number = KINDS[one_of(KINDS)(kind, f"{where}.kind")]
    g = a_list(a_positive_rational, 3)(metric, f"{where}.metric")
    well_formed(all(x.denominator == 1 for x in g), f"{where}.metric: not three integers")
    joints = a_list(a_list(a_rational, 3), number)
    sides = joints(base, f"{where}.base"), joints(platform, f"{where}.platform")
    flat = number == 6 or not any(joint[2] for side in sides for joint in side)
    well_formed(flat, f"{where}: a joint of a planar robot has a third coordinate other than 0")
    well_formed(number == 6 or g[2] == 1, f"{where}.metric: the third of a planar robot is not 1")
    return (int(g[0]), int(g[1]), int(g[2])), *sides


def a_configuration(value: Any, number: int) -> Sequence[Fraction]:
    """The squared lengths of the legs."""
    name, lengths_squared = an_object(value, "configuration", "name lengths_squared")
    nullable(a_text)(name, "configuration.name")
    squares: Sequence[Fraction] = a_list(a_positive_rational, number)(lengths_squared, "configuration.lengths_squared")
    return squares


def read(body: dict[str, Any]) -> Certificate:
    """The content of a certificate."""
    version = body.get("version")
    is_known = body.get("format") == "pkm_exact certificate" and type(version) is int and version == 1
    well_formed(is_known, "format: not a pkm_exact certificate, version 1 or 2")
    values = dict(zip(KEYS.split(), an_object(body, "certificate", KEYS), strict=True))

    def entry(key: str, read: Reader) -> Any:
        return read(values[key], key)

    metric, base, platform = entry("robot", a_robot)
    well_formed(FORMULATION.fullmatch(entry("formulation", a_text)), "formulation: not the code of one")
    entry("notes", a_list(a_text))
    exponent = entry("box_exponent", a_number)
    affordable(exponent <= MAX_BOX_EXPONENT, f"box_exponent: more than {MAX_BOX_EXPONENT}")
    squares = a_configuration(values["configuration"], len(base))
    return Certificate(
        metric=metric,
        legs=tuple(map(Leg, base, platform, squares)),
        method=entry("method", one_of(METHODS)),
        claim=entry("claim", one_of(CLAIMS)),
        route=entry("completeness_route", nullable(one_of(ROUTES))),
        counts=(
            entry("complex_solutions", a_number),
            entry("distinct_solutions", a_number),
            entry("real_poses", a_number),
        ),
        representation=entry("representation", nullable(a_representation)),
        elimination=entry("elimination", nullable(a_list(a_step))),
        boxes=entry("krawczyk", nullable(a_list_of_boxes)),
        box_exponent=exponent,
        poses=entry("poses", a_list(a_pose)),
    )


# ---------------------------------------------------------------------------------------------------------------------
# Notation: motions and legs
# ---------------------------------------------------------------------------------------------------------------------

CYCLIC: Final = ((0, 1, 2), (1, 2, 0), (2, 0, 1))


class Motion(NamedTuple):
    """N(e) times 1, R (by rows), C, R^-1 C and |C|^2, in any commutative ring; and e.f, which must be 0."""

    norm: Any
    rotation: list[list[Any]]
    position: list[Any]
    turned: list[Any]
    square: Any
    study: Any

    def quantities(self) -> list[Any]:
        """The 17 quantities in the order of ``leg_form``."""
        return [self.norm, *self.by_rows(), *self.position, *self.turned, self.square]

    def by_rows(self) -> list[Any]:
        """The entries of the rotation."""
        return [entry for row in self.rotation for entry in row]


def motion(e: Sequence[Any], f: Sequence[Any], g: Metric) -> Motion:
    """The formulas under "Notation", each product of coordinates formed once.

    Examples
    --------
    >>> placed = motion((0, 0, 0, 1), (-7, 6, -5, 0), (1, 1, 1))
    >>> placed.rotation, placed.position, placed.square, placed.study
    ([[-1, 0, 0], [0, -1, 0], [0, 0, 1]], [5, 6, 7], 110, 0)
    """
    scalar = (g[0] * g[1] * g[2]) * (e[0] * e[0])
    squares = [g[i] * (e[i + 1] * e[i + 1]) for i in range(3)]
    norm = scalar + squares[0] + squares[1] + squares[2]
    rotation: list[list[Any]] = [[None] * 3 for _ in range(3)]
    position, turned = [None] * 3, [None] * 3
    square, study = f[0] * f[0], e[0] * f[0]
    for i, j, k in CYCLIC:
        rotation[i][i] = scalar + squares[i] - squares[j] - squares[k]
        mixed, turn = e[i + 1] * e[j + 1], g[k] * (e[0] * e[k + 1])
        rotation[i][j] = (2 * g[j]) * (mixed - turn)
        rotation[j][i] = (2 * g[i]) * (mixed + turn)
        a = (g[j] * g[k]) * (e[0] * f[i + 1]) - e[i + 1] * f[0]
        b = g[j] * (e[j + 1] * f[k + 1]) - g[k] * (e[k + 1] * f[j + 1])
        position[i], turned[i] = a + b, a - b
        square = square + (g[j] * g[k]) * (f[i + 1] * f[i + 1])
        study = study + e[i + 1] * f[i + 1]
    return Motion(norm, rotation, position, turned, square, study)


def scalar_product(g: Sequence[int], u: Sequence[Fraction], v: Sequence[Fraction]) -> Fraction:
    """u.v in the metric."""
    return sum((x * y * z for x, y, z in zip(g, u, v, strict=True)), Fraction(0))


def leg_form(leg: Leg, g: Metric) -> list[int]:
    """L as a form in the 17 quantities, cleared of denominators."""
    a, b = leg.base, leg.platform
    ga = [x * y for x, y in zip(g, a, strict=True)]
    form = [
        scalar_product(g, a, a) + scalar_product(g, b, b) - leg.length_squared,
        *(-2 * x * y for x in ga for y in b),
        *(-2 * x for x in ga),
        *(2 * x * y for x, y in zip(g, b, strict=True)),
        Fraction(1),
    ]
    return cleared(form)


def cleared(values: Sequence[Fraction]) -> list[int]:
    """The values times their least common denominator."""
    denominator = 1
    for value in values:
        spend(2 * division_cost(denominator.bit_length(), value.denominator.bit_length()))
        denominator = lcm(denominator, value.denominator)
    bits = denominator.bit_length()
    spend(sum(200 + product_cost(bits, value.numerator.bit_length()) for value in values) + len(values) * bits // 2)
    return [value.numerator * (denominator // value.denominator) for value in values]


def combination(scalars: Iterable[int], values: Iterable[Any]) -> Any:
    """The sum of the products, in any ring."""
    pairs = zip(scalars, values, strict=True)
    first, value = next(pairs)
    total = first * value
    for scalar, value in pairs:
        if scalar:
            total = total + scalar * value
    return total


# ---------------------------------------------------------------------------------------------------------------------
# Polynomials over Z, as values at a power of 2
# ---------------------------------------------------------------------------------------------------------------------


def at_power(polynomial: Sequence[int], k: int) -> int:
    """The value at 2^k."""
    spend(len(polynomial) * (300 + (len(polynomial) * k + most_bits(polynomial)) // 50))
    value = 0
    for coefficient in reversed(polynomial):
        value = (value << k) + coefficient
    return value


def digits(value: int, k: int) -> Polynomial:
    """The polynomial with coefficients between -2^(k-1) and 2^(k-1) that has a value at 2^k."""
    spend((value.bit_length() // k + 2) * (300 + value.bit_length() // 50))
    mask, half = (1 << k) - 1, 1 << (k - 1)
    coefficients = []
    while value:
        low = value & mask
        low -= (low > half) << k
        coefficients.append(low)
        value = (value - low) >> k
    return coefficients


def derivative(polynomial: Sequence[int]) -> Polynomial:
    """The derivative."""
    return [power * coefficient for power, coefficient in enumerate(polynomial)][1:]


def primitive_part(polynomial: Sequence[int]) -> Polynomial:
    """The polynomial divided by the greatest common divisor of its coefficients."""
    bits = most_bits(polynomial)
    spend(2 * len(polynomial) * division_cost(bits, bits))
    content = gcd(*polynomial)
    return [coefficient // content for coefficient in polynomial]


def size(polynomial: Sequence[int]) -> int:
    """The sum of the absolute values of the coefficients. It bounds them, and is submultiplicative."""
    return sum(map(abs, polynomial))


class Multiples:
    """Decides whether a primitive polynomial h0 divides polynomials P over Z that are given by values at X = 2^k.

    Let P have size at most ``bound`` and degree at most 2D, or as many times D as ``degrees`` says. If P = h0 q, then
    q, of degree d, has size at most 2^d bound (Mignotte), so X, chosen larger, makes q the digits of the integer
    P(X) / h0(X). Conversely, if this is an integer with digits q so small that h0 q, like P, has coefficients below
    X / 2, then P = h0 q, because both have the same value at X.
    Exact quotients are found from below, some bits at a time, modulo a power of 2, where the inverse of h0(X) is found
    once, by Newton's iteration (Hensel).
    X may be chosen smaller, with ``spare`` bits instead of those for the greatest q: then a quotient, if it is longer
    than usual, may be missed, but what is found still divides.
    """

    def __init__(self, h0: Polynomial, bound: int, degrees: int = 2, *, spare: int | None = None) -> None:
        self.h0 = h0
        number = (degrees - 1) * (len(h0) - 1) + 1
        self.k = bound.bit_length() + 2 + (number + size(h0).bit_length() if spare is None else spare)
        value = at_power(h0, self.k)
        self.zeros = (value & -value).bit_length() - 1
        self.odd = value >> self.zeros
        self.step = self.k * min(len(h0) + 1, number + 1)
        self.steps = -(-self.k * (number + 1) // self.step)
        spend(6 * product_cost(self.step, self.step))
        self.inverse, known = 1, 1
        while known < self.step:
            known = min(2 * known, self.step)
            mask = (1 << known) - 1
            self.inverse = self.inverse * (2 - (self.odd & mask) * self.inverse) & mask

    def include(self, value: int) -> bool:
        """Whether h0 divides the polynomial with this value at X."""
        length = max(self.step * self.steps, value.bit_length())
        spend(self.steps * (2 * product_cost(self.step, self.odd.bit_length()) + length // 10))
        if value & ((1 << self.zeros) - 1):
            return False
        rest, quotient, mask = value >> self.zeros, 0, (1 << self.step) - 1
        for number in range(self.steps):
            digit = (rest & mask) * self.inverse & mask
            rest = (rest - digit * self.odd) >> self.step
            quotient |= digit << (number * self.step)
        if rest == -self.odd:
            quotient -= 1 << (self.steps * self.step)
        elif rest:
            return False
        return size(digits(quotient, self.k)) * size(self.h0) < 1 << (self.k - 2)


# ---------------------------------------------------------------------------------------------------------------------
# Polynomials modulo a prime, and modulo a polynomial as well
# ---------------------------------------------------------------------------------------------------------------------

PRIMES: Final = tuple((1 << n) - 1 for n in (61, 89, 107, 127))
"""Primes of Mersenne: no table of primes and no test is needed."""


def reduced(polynomial: Iterable[int], p: int) -> Polynomial:
    """The image modulo p."""
    image = [coefficient % p for coefficient in polynomial]
    while image and not image[-1]:
        image.pop()
    return image


def divided(a: Polynomial, b: Polynomial, p: int) -> tuple[Polynomial, Polynomial]:
    """Quotient and remainder modulo a prime, or modulo any p if b is monic."""
    bits, steps = p.bit_length(), max(len(a) - len(b) + 1, 0)
    spend(
        8000
        + bits * bits // 8
        + (len(a) + steps * len(b)) * (300 + product_cost(bits, bits) + division_cost(bits, bits))
    )
    inverse = pow(b[-1], -1, p)
    rest, quotient = list(a), [0] * steps
    for place in reversed(range(steps)):
        factor = quotient[place] = rest[place + len(b) - 1] * inverse % p
        if factor:
            for power, coefficient in enumerate(b, place):
                rest[power] = (rest[power] - factor * coefficient) % p
    return reduced(quotient, p), reduced(rest[: len(b) - 1], p)


def common_divisor(a: Polynomial, b: Polynomial, p: int) -> Polynomial:
    """The monic greatest common divisor modulo a prime."""
    while b:
        a, b = b, divided(a, b, p)[1]
    return [coefficient * pow(a[-1], -1, p) % p for coefficient in a]


def product(a: Polynomial, b: Polynomial, p: int) -> Polynomial:
    """The product modulo p."""
    k = 2 * p.bit_length() + len(a).bit_length() + 2
    spend(product_cost(k * len(a), k * len(b)) + (len(a) + len(b)) * (500 + division_cost(k, k // 2)))
    return reduced(digits(at_power(a, k) * at_power(b, k), k), p)


class Residues:
    """The ring (Z / m)[T] / (g), where the leading coefficient of g is a unit modulo m.

    Polynomials are multiplied by their values at a power of 256 above all coefficients that occur.
    """

    def __init__(self, g: Polynomial, m: int) -> None:
        bits = m.bit_length()
        spend(8000 + bits * bits // 8 + len(g) ** 2 * (500 + product_cost(bits, bits) + division_cost(bits, bits)))
        inverse = pow(g[-1], -1, m)
        self.m = m
        self.g = [coefficient * inverse % m for coefficient in g]
        self.degree = len(g) - 1
        self.width = (2 * m.bit_length() + self.degree.bit_length() + 8) // 8
        power = [-coefficient % m for coefficient in self.g[:-1]]
        whole, part = 8 * self.width * self.degree, division_cost(8 * self.width, bits)
        self.cost = product_cost(whole, whole) + self.degree * (product_cost(bits, whole) + 3 * (part + 500))
        self.powers = []  # T^d, T^(d+1), ..
        for _ in range(self.degree):
            self.powers.append(self.packed(power))
            top = power[-1]
            power = [(low - top * coefficient) % m for low, coefficient in zip([0, *power], self.g[:-1], strict=False)]

    def packed(self, coefficients: Iterable[int]) -> int:
        """The value at 256^width."""
        return int.from_bytes(b"".join(c.to_bytes(self.width, "little") for c in coefficients), "little")

    def unpacked(self, value: int, number: int) -> list[int]:
        """The coefficients, reduced modulo m."""
        data = value.to_bytes(number * self.width, "little")
        starts = range(0, len(data), self.width)
        return [int.from_bytes(data[i : i + self.width], "little") % self.m for i in starts]

    def element(self, polynomial: Polynomial) -> Residue:
        """The class of a polynomial."""
        spend(len(polynomial) * division_cost(most_bits(polynomial), self.m.bit_length()))
        rest = divided(reduced(polynomial, self.m), self.g, self.m)[1]
        return Residue(self, [*rest, *[0] * (self.degree - len(rest))])


class Residue:
    """An element of a ring of residues: its coefficients, lowest first."""

    __slots__ = ("ring", "value")

    def __init__(self, ring: Residues, value: list[int]) -> None:
        self.ring = ring
        self.value = value

    def __add__(self, other: Residue) -> Residue:
        m = self.ring.m
        return Residue(self.ring, [(x + y) % m for x, y in zip(self.value, other.value, strict=True)])

    def __sub__(self, other: Residue) -> Residue:
        m = self.ring.m
        return Residue(self.ring, [(x - y) % m for x, y in zip(self.value, other.value, strict=True)])

    def __rmul__(self, scalar: int) -> Residue:
        m = self.ring.m
        bits = scalar.bit_length() if isinstance(scalar, int) else 0
        spend(len(self.value) * (300 + product_cost(bits, m.bit_length()) + division_cost(bits, m.bit_length())))
        return Residue(self.ring, [scalar * x % m for x in self.value])

    def __mul__(self, other: Residue) -> Residue:
        ring = self.ring
        spend(ring.cost)
        low = ring.packed(self.value) * ring.packed(other.value)
        coefficients = ring.unpacked(low, 2 * ring.degree)
        total = ring.packed(coefficients[: ring.degree])
        for coefficient, power in zip(coefficients[ring.degree :], ring.powers, strict=True):
            total += coefficient * power
        return Residue(ring, ring.unpacked(total, ring.degree))

    def polynomial(self) -> Polynomial:
        """The representative of smallest degree."""
        return reduced(self.value, self.ring.m)


def good_primes(polynomial: Polynomial) -> Iterator[int]:
    """Primes that do not divide the leading coefficient; the last ones follow from all: none is met by accident."""
    seed = sha256(",".join(map(hex, polynomial)).encode()).digest()
    numbers = (int.from_bytes(seed[place : place + 8], "big") >> 3 | 1 << 60 | 1 for place in range(0, len(seed), 8))
    derived = (next(n for n in range(number, 1 << 64, 2) if is_prime(n)) for number in numbers)
    return (p for p in chain(PRIMES, derived) if polynomial[-1] % p)


def is_prime(n: int) -> bool:
    """Whether an odd number between 37 and 2^64 is prime: Miller's test with these bases (Sorenson, Webster 2017)."""
    twos = (n - 1 & 1 - n).bit_length() - 1

    def passes(base: int) -> bool:
        power = pow(base, n - 1 >> twos, n)
        return power == 1 or any(pow(power, 1 << i, n) == n - 1 for i in range(twos))

    return all(map(passes, (2, 3, 5, 7, 11, 13, 17, 19, 23, 29, 31, 37)))


# ---------------------------------------------------------------------------------------------------------------------
# Checks 1 to 5: the roots of the eliminant are distinct poses of the robot
# ---------------------------------------------------------------------------------------------------------------------


def check_eliminant(representation: Representation, most: int = GREATEST_NUMBER) -> Iterator[str]:
    """Check 1."""
    h = representation.h
    degree = len(h) - 1
    require(
        degree <= most,
        f"eliminant: degree {degree}, but six legs have at most {GREATEST_NUMBER} isolated poses",
    )
    numbers = [*h, *(coefficient for numerator in representation.numerators for coefficient in numerator)]
    spend(2 * len(numbers) * division_cost(most_bits(numbers), most_bits(h)))
    content = gcd(*h, *(coefficient for numerator in representation.numerators for coefficient in numerator))
    require(h[-1] > 0 and content == 1, "eliminant: not in lowest terms with positive leading coefficient")
    h0 = primitive_part(h)
    squarefree = any(is_coprime(h0, derivative(h0), p) for p in good_primes(h0))
    require(squarefree, "eliminant: not proved squarefree")
    yield f"eliminant: squarefree of degree {degree}"


def is_coprime(h0: Polynomial, q: Polynomial, p: int) -> bool:
    """Whether two polynomials have no common factor modulo p."""
    spend(sum(len(each) * division_cost(most_bits(each), p.bit_length()) for each in (h0, q)))
    return len(common_divisor(reduced(h0, p), reduced(q, p), p)) == 1


def check_distinct(representation: Representation) -> Iterator[str]:
    """Checks 2 and 3, as identities of polynomials of degree below D."""
    h, numerators = representation.h, representation.numerators
    degree = len(h) - 1
    small = all(len(numerator) <= degree for numerator in numerators)
    require(small, "representation: a numerator has not a smaller degree than the eliminant")
    padded = [[*numerator, *[0] * (degree - len(numerator))] for numerator in numerators]
    slope = derivative(h)
    chart = [combination(representation.w, column) for column in zip(*padded[:4], strict=True)]
    require(chart == slope, "chart: w.e is not 1 at the roots of the eliminant")
    yield "chart: w.e = 1 at every solution"
    form = [combination(representation.c, column) for column in zip(*padded, strict=True)]
    expected = [(power - degree) * coefficient for power, coefficient in enumerate(h[:-1])]  # T h' - D h
    require(form == expected, "separating form: its values are not the roots of the eliminant")
    yield f"separating form: takes {degree} different values, the solutions are distinct"


def check_poses(representation: Representation, legs: Sequence[Leg], g: Metric) -> Iterator[str]:
    """Checks 4 and 5: h0 divides e.f and the forms of the legs, and is coprime to N."""
    h0 = primitive_part(representation.h)
    e1, e2, f0, f3 = (representation.numerators[place] for place in (1, 2, 4, 7))
    planar = len(legs) == 3
    flat = not planar or not any((e1, e2, f0, f3))
    require(flat, "motion: e1, e2, f0 and f3 are not all 0, but the robot is planar")
    forms = [leg_form(leg, g) for leg in legs]
    multiples, placed = evaluated(representation, g, max(map(size, forms)))
    require(multiples.include(placed.study), "motion: e.f is not 0 at every root of the eliminant")
    require(
        any(is_coprime(h0, norm_modulo(representation, g, p), p) for p in good_primes(h0)),
        "motion: not proved that N(e) is nowhere 0",
    )
    yield "motion: e.f = 0 and N(e) is not 0, every solution is a rigid motion"
    quantities = placed.quantities()
    for number, form in enumerate(forms, 1):
        spend(17 * product_cost(most_bits(form), most_bits(quantities)))
        holds = multiples.include(combination(form, quantities))
        require(holds, f"legs: leg {number} does not have its length at every solution")
    yield f"legs: all {len(legs)} have their lengths at every solution"


def evaluated(representation: Representation, g: Metric, scale: int) -> tuple[Multiples, Motion]:
    """The quantities of the motion at a power of 2 that is large enough for forms in them of size ``scale``."""
    bounds = sized_motion(representation, g)
    bound = max(each.size for each in (*bounds.quantities(), bounds.study))
    multiples = Multiples(primitive_part(representation.h), bound * max(scale, 1))
    values = [at_power(numerator, multiples.k) for numerator in representation.numerators]
    spend(80 * product_cost(most_bits(values), most_bits(values)))
    return multiples, motion(values[:4], values[4:], g)


def norm_modulo(representation: Representation, g: Metric, p: int) -> Polynomial:
    """N(E) modulo p and h0."""
    return motion_modulo(representation, g, primitive_part(representation.h), p).norm.polynomial()  # type: ignore[no-any-return]


def motion_modulo(representation: Representation, g: Metric, modulus: Polynomial, m: int) -> Motion:
    """The quantities of the motion modulo m and a polynomial."""
    ring = Residues(modulus, m)
    x = [ring.element(numerator) for numerator in representation.numerators]
    return motion(x[:4], x[4:], g)


# ---------------------------------------------------------------------------------------------------------------------
# Check 6: the real poses. Real roots by the rule of Descartes, coordinates by interval arithmetic
# ---------------------------------------------------------------------------------------------------------------------


class Root(NamedTuple):
    """A real root t: 2^k t = m if ``exact``, else m < 2^k t < m + 1. Other roots are outside, perhaps at an end."""

    m: int
    k: int
    exact: bool

    def mirrored(self) -> Root:
        """The cell of -t."""
        return Root(-self.m - (not self.exact), self.k, self.exact)


TOO_CLOSE: Final = f"real poses: the roots are not told apart by {MAX_ISOLATION} bits"


def real_roots(h0: Polynomial, finest: int = MAX_ISOLATION) -> list[Root]:
    """The real roots of a squarefree polynomial, increasing, each isolated. All are below 2^b (Fujiwara)."""
    lead = h0[-1].bit_length() - 1
    b = max(2 + (c.bit_length() - lead) // (len(h0) - 1 - power) for power, c in enumerate(h0[:-1]))
    b = max(b, 0)
    affordable(b <= finest, TOO_CLOSE)
    mirrored = [-c if power % 2 else c for power, c in enumerate(h0)]
    roots = [root.mirrored() for root in positive_roots(mirrored, b, finest)]
    roots += [*positive_roots(h0, b, finest), *[Root(0, 0, True)] * (not h0[0])]
    return sorted(roots, key=lambda root: Fraction(2 * root.m + (not root.exact)) / Fraction(2) ** root.k)


def positive_roots(h0: Polynomial, b: int, finest: int) -> Iterator[Root]:
    """The roots in (0, 2^b), in any order: intervals (m, m + 1) / 2^k are halved until Descartes' rule decides.

    q is h0 on the interval, mapped to (0, 1). The number of changes of sign in the coefficients of
    (1 + x)^D q(1 / (1 + x)) is that of the roots in (0, 1), or greater by an even number.
    """
    pending = [(0, -b, [c << (b * power) for power, c in enumerate(h0)])]
    while pending:
        m, k, q = pending.pop()
        spend(len(q) * (2000 + len(q) * (150 + most_bits(q) // 200)))
        changes = sign_changes(shifted(q[::-1]))
        if changes == 1:
            yield Root(m, k, False)
        elif changes:
            affordable(k < finest, TOO_CLOSE)
            left = [c << (len(q) - 1 - power) for power, c in enumerate(q)]
            right = shifted(left)
            if not right[0]:
                yield Root(2 * m + 1, k + 1, True)
            pending += [(2 * m, k + 1, left), (2 * m + 1, k + 1, right)]


def shifted(q: Sequence[int]) -> Polynomial:
    """q(x + 1), by the triangle of Pascal."""
    rest, result = list(q[::-1]), []
    while rest:
        rest = list(accumulate(rest))
        result.append(rest.pop())
    return result


def sign_changes(coefficients: Sequence[int]) -> int:
    """The number of changes of sign, zeros left out."""
    signs = [c > 0 for c in coefficients if c]
    return sum(a != b for a, b in pairwise(signs))


class Fixed:
    """Values of a polynomial at points of a cell [m, m + 1] / 2^k, in fixed point, with bounds of their errors.

    With |x| <= 2^b in the cell and y = x / 2^b, they are the sums of a_i 2^(b i) y^i, by Horner's rule, as multiples of
    2^(s - q), where all |a_i| 2^(b i) are below 2^s. As |y| <= 1, errors do not grow: rounding down adds less than 2
    for each coefficient, and where y is known to 2^-j, not better, each factor of y adds its own size times 2^-j.
    """

    def __init__(self, polynomial: Sequence[int], m: int, k: int) -> None:
        self.polynomial = polynomial
        self.b = abs(m).bit_length() - k
        self.s = max((c.bit_length() + self.b * i for i, c in enumerate(polynomial) if c), default=0)
        self.q = 128
        self.known: dict[int, list[int]] = {}

    def coefficients(self, q: int) -> list[int]:
        """All a_i 2^(b i) as multiples of 2^(s - q), rounded down, highest first."""
        if q not in self.known:
            spend(len(self.polynomial) * (500 + (q + most_bits(self.polynomial)) // 30))
            shifts = ((c, q - self.s + self.b * i) for i, c in enumerate(self.polynomial))
            self.known[q] = [c << shift if shift >= 0 else c >> -shift for c, shift in shifts][::-1]
        return self.known[q]

    def near(self, m: int, k: int, q: int, *, exact: bool) -> tuple[int, int]:
        """The value at m / 2^k, or at any point between that and (m + 1) / 2^k, and a bound of its error."""
        lost = max(m.bit_length() - q, 0)
        exact = exact and not m & ((1 << lost) - 1)
        m, j = m >> lost, k + self.b - lost
        spend(len(self.polynomial) * (900 + product_cost(m.bit_length(), q) + q // 10))
        value = factors = 0
        for coefficient in self.coefficients(q):
            factors += abs(value)
            value = (value * m >> j) + coefficient
        return value, 2 * len(self.polynomial) + (0 if exact else (factors >> j) + 1)

    def at(self, m: int, k: int, bits: int) -> tuple[int, int]:
        """The value at m / 2^k to so many leading bits, as a multiple of 2^(s - q), and q; 0 only if it is 0.

        It is a multiple of 2^(-k degree), an integer if k < 0: it is 0 if a smaller one cannot be told from 0.
        """
        least = max(k, 0) * (len(self.polynomial) - 1) + max(self.s, 0) + len(self.polynomial).bit_length() + 2
        most = max(least, k + self.b + 1) + bits
        while True:
            q = min(self.q, most)
            value, error = self.near(m, k, q, exact=True)
            if abs(value) >> bits > error:
                return value, q
            if q == most:
                return 0, q
            self.q *= 2


def refined(h0: Polynomial, root: Root, k: int) -> Root:
    """The root on the finer grid 2^-k.

    By halving where an end is another root, then by quadratic refinement (Abbott 2014): a cell 2^step times as fine is
    guessed by the secant; after a right guess, which two signs prove, step is doubled, otherwise halved.
    """
    m, grid, exact = root
    step, values = 1, Fixed(h0, m, grid)
    low, high = values.at(m, grid, 8), values.at(m + 1, grid, 8)
    is_positive = (low if low[0] else Fixed(derivative(h0), m, grid).at(m, grid, 1))[0] > 0
    while not exact and grid < k:
        step = min(step, k - grid)
        if step == 1 or not low[0] or not high[0]:
            m, grid = 2 * m, grid + 1
            middle = values.at(m + 1, grid, 8)
            exact = not middle[0]
            m, low, high = (m + 1, middle, high) if exact or (middle[0] > 0) == is_positive else (m, low, middle)
            step = 2
            continue
        guess = (m << step) + secant(low, high, step)
        ends = tuple(values.at(place, grid + step, 2 * step + 4) for place in (guess, guess + 1))
        if not all(value for value, _ in ends):
            m, grid, exact = guess + (not ends[1][0]), grid + step, True
        elif (ends[0][0] > 0) == is_positive != (ends[1][0] > 0):
            m, grid, (low, high), step = guess, grid + step, ends, 2 * step
        else:
            step //= 2
    return Root(m << (k - grid), k, exact)


def secant(low: tuple[int, int], high: tuple[int, int], step: int) -> int:
    """In which of 2^step parts of a cell the secant has its zero, from values of different signs at the ends."""
    q = max(low[1], high[1])
    left, right = (value << (q - own) for value, own in (low, high))
    spend(division_cost(left.bit_length() + step, max(left.bit_length(), right.bit_length())))
    return (left << step) // (left - right)


def isolated(h0: Polynomial) -> list[Root]:
    """The real roots in the cells of the coarsest grid, from 2^-32 on, where each closed cell holds one root only.

    Where h0 is a polynomial in S = T^m, they are the m-th roots of the real roots of that, which has a smaller degree.
    """
    m = gcd(*(power for power, c in enumerate(h0) if c))
    powers = h0[::m]
    known = real_roots(powers, m * MAX_ISOLATION)
    k = max(32, *(-(-root.k // m) for root in known)) if known else 32
    while True:
        known = [refined(powers, root, m * k) for root in known]
        roots = roots_of_powers(known, m)
        if are_apart(roots):
            break
        affordable(k < MAX_ISOLATION, TOO_CLOSE)
        k = min(2 * k, MAX_ISOLATION)
    spend((k - 31) * (2000 + 3000 * len(roots)))
    grids = ([coarser(root, grid) for root in roots] for grid in range(32, k + 1))
    return next(cells for cells in grids if are_apart(cells))


def roots_of_powers(known: Sequence[Root], m: int) -> list[Root]:
    """The real m-th roots of numbers, not 0 if m > 1, both increasing: on the grid 2^-k from those on 2^-(m k)."""
    if m == 1:
        return list(known)
    roots = [root_of_power(root, m) for root in known if root.m >= 0]
    others = [root_of_power(root.mirrored(), m) for root in known if root.m < 0] if m % 2 else roots[::-1]
    return [*(root.mirrored() for root in others), *roots]


def root_of_power(power: Root, m: int) -> Root:
    """The positive m-th root of a positive number: 2^k t rounded down is the m-th root of 2^(m k) t^m rounded down."""
    bits = -(-power.m.bit_length() // m)
    spend(2000 + bits * (300 + 4 * product_cost(power.m.bit_length(), power.m.bit_length())))
    low = 0
    for place in reversed(range(bits)):
        if (low + (1 << place)) ** m <= power.m:
            low += 1 << place
    return Root(low, power.k // m, power.exact and low**m == power.m)


def coarser(root: Root, k: int) -> Root:
    """The cell of a root on a coarser grid."""
    shift = root.k - k
    return Root(root.m >> shift, k, root.exact and not root.m & ((1 << shift) - 1))


def are_apart(roots: Sequence[Root]) -> bool:
    """Whether no closed cell holds a neighbouring root."""
    return not any(a.m == b.m or (a.m + 1 == b.m and b.exact and not a.exact) for a, b in pairwise(roots))


def has_root(factor: Polynomial, root: Root) -> bool:
    """Whether a root of a polynomial is one of a factor of it: an exact one, or the only one in its closed cell."""
    m, k, exact = root
    values = Fixed(factor, m, k)
    low = values.at(m, k, 0)[0]
    return not low if exact else (low > 0) != (values.at(m + 1, k, 0)[0] > 0)


class Interval:
    """The real numbers from low / 2^p to high / 2^p; results of operations are rounded outward."""

    __slots__ = ("high", "low", "p")

    def __init__(self, low: int, high: int, p: int) -> None:
        self.low = low
        self.high = high
        self.p = p

    def __add__(self, other: Interval) -> Interval:
        return Interval(self.low + other.low, self.high + other.high, self.p)

    def __sub__(self, other: Interval) -> Interval:
        return Interval(self.low - other.high, self.high - other.low, self.p)

    def __rmul__(self, scalar: int) -> Interval:
        ends = scalar * self.low, scalar * self.high
        return Interval(min(ends), max(ends), self.p)

    def __mul__(self, other: Interval) -> Interval:
        spend(1200 + 4 * product_cost(self.bits(), other.bits()))
        ends = [x * y for x in (self.low, self.high) for y in (other.low, other.high)]
        return Interval(min(ends) >> self.p, -(-max(ends) >> self.p), self.p)

    def over(self, other: Interval) -> Interval:
        """The quotient by an interval that does not contain 0."""
        bits = other.bits()
        spend(2000 + 8 * division_cost(max(self.p + self.bits() - bits, 0), bits))
        pairs = [(x << self.p, y) for x in (self.low, self.high) for y in (other.low, other.high)]
        return Interval(min(x // y for x, y in pairs), max(-(-x // y) for x, y in pairs), self.p)

    def root(self) -> Interval:
        """The square root of an interval of positive numbers."""
        bits = self.p + self.high.bit_length()
        spend(6000 + division_cost(bits, bits))
        return Interval(isqrt(self.low << self.p), isqrt((self.high << self.p) - 1) + 1, self.p)

    def bits(self) -> int:
        """The length of the longer end."""
        return max(self.low.bit_length(), self.high.bit_length())

    def contains_zero(self) -> bool:
        """Whether 0 is in the interval."""
        return self.low <= 0 <= self.high

    def largest(self) -> int:
        """The largest absolute value, times 2^p."""
        return max(abs(self.low), abs(self.high))


def check_real_poses(certificate: Certificate, representation: Representation) -> Iterator[str]:
    """Check 6. The real poses are those with a real parameter."""
    h0, g = primitive_part(representation.h), certificate.metric
    roots = isolated(h0)
    listed = len(certificate.poses)
    require(listed == len(roots), f"real poses: {listed} listed, the eliminant has {len(roots)} real roots")
    enclosures = [partial(at_root, representation, g, root) for root in roots]
    boxes = [cells_of(enclose, certificate.box_exponent) for enclose in enclosures]
    order = sorted(range(len(roots)), key=lambda place: boxes[place][:12])
    for number, (pose, place) in enumerate(zip(certificate.poses, order, strict=True), 1):
        root = roots[place]
        same = pose.parameter == ends(root.m, root.m + (not root.exact), root.k)
        require(same, f"real poses: pose {number} does not have the isolating interval of real root {place + 1}")
    yield f"real poses: {listed}, one for each real root of the eliminant"
    yield from check_cells(certificate, [boxes[place] for place in order])


def at_root(representation: Representation, g: Metric, root: Root, p: int) -> list[Interval] | None:
    """Enclosures of the coordinates of the pose at a root."""
    finer = refined(primitive_part(representation.h), root, max(p, root.k))
    return coordinates(representation, g, finer, p)


def check_cells(certificate: Certificate, boxes: Sequence[list[tuple[int, int]]]) -> Iterator[str]:
    """The intervals listed are those of the poses, and no two boxes meet."""
    poses, exponent = certificate.poses, certificate.box_exponent
    bits = most_bits(end for cells in boxes for pair in cells for end in pair)
    affordable(bits <= MAX_CELL_BITS, f"boxes: a coordinate of more than {MAX_CELL_BITS} bits")
    spend(len(poses) * (32 * (5000 + division_cost(bits, bits) * 4) + 20000 * len(poses)))
    for number, (pose, cells) in enumerate(zip(poses, boxes, strict=True), 1):
        same = pose.box == tuple(ends(low, high, exponent) for low, high in cells)
        require(same, f"boxes: the box of pose {number} is not that of its solution")
    yield f"boxes: all {16 * len(poses)} intervals are those of the solutions, on the grid 2^-{exponent}"
    for (i, one), (j, other) in combinations(enumerate(boxes, 1), 2):
        apart = any(a[1] < b[0] or b[1] < a[0] for a, b in zip(one[:12], other[:12], strict=True))
        require(apart, f"boxes: those of poses {i} and {j} are not disjoint in position or rotation")
    yield "boxes: pairwise disjoint in position or rotation"


def ends(low: int, high: int, exponent: int) -> Ends:
    """The ends of an interval on the grid 2^-exponent, as they are listed."""
    return str(Fraction(low, 1 << exponent)), str(Fraction(high, 1 << exponent))


def cells_of(enclose: Callable[[int], list[Interval] | None], exponent: int) -> list[tuple[int, int]]:
    """The cells of the 16 coordinates of a pose on the grid 2^-exponent, from enclosures in any precision."""
    p, late = exponent + 256, 0
    while True:
        affordable(p <= MAX_PRECISION, f"boxes: a coordinate is not decided by {MAX_PRECISION} bits")
        values = enclose(p)
        if values is not None and all(value.high - value.low < 1 << (p - exponent - 40) for value in values):
            cells = [cell(value, p - exponent, late=late == 4) for value in values]
            decided = [found for found in cells if found is not None]
            if len(decided) == len(cells):
                return decided
            late += 1
        p *= 2


def cell(value: Interval, shift: int, *, late: bool) -> tuple[int, int] | None:
    """The cell of y, enclosed to 2^-40 with 2^shift for the unit; None if it is not decided whether y is near to n."""
    unit = 1 << shift
    n = (value.low + value.high + unit) // (2 * unit)
    distances = abs(value.low - n * unit), abs(value.high - n * unit)
    nearest = 0 if value.low <= n * unit <= value.high else min(distances)
    limit = unit >> 32
    if max(distances) < limit or (late and nearest <= limit):
        return n - 1, n + 1
    return (value.low // unit, value.low // unit + 1) if nearest > limit else None


def coordinates(representation: Representation, g: Metric, root: Root, p: int) -> list[Interval] | None:
    """Position, rotation and quaternion at a root; None if the precision does not suffice."""
    h = representation.h
    slope, *values = enclosed([derivative(h), *representation.numerators], root, p)
    if slope.contains_zero():
        return None
    return ordinary([value.over(slope) for value in values], g, p)


def ordinary(x: Sequence[Interval], g: Metric, p: int) -> list[Interval] | None:
    """Position, rotation and quaternion in ordinary coordinates at (e, f); None if N(e) is not enclosed well enough."""
    placed = motion(x[:4], x[4:], g)
    if placed.norm.contains_zero():
        return None
    axes = [Interval(value << p, value << p, p).root() for value in g]
    length = placed.norm.root()
    position = [(axis * value).over(placed.norm) for axis, value in zip(axes, placed.position, strict=True)]
    rotation = [(axes[i] * placed.rotation[i][j]).over(axes[j] * placed.norm) for i in range(3) for j in range(3)]
    quaternion = [axes[0] * axes[1] * axes[2] * x[0], *(axis * value for axis, value in zip(axes, x[1:4], strict=True))]
    return [*position, *rotation, *(value.over(length) for value in quaternion)]


def enclosed(polynomials: Sequence[Polynomial], root: Root, p: int) -> list[Interval]:
    """The values at the root, all times one power of 2 that depends on the root and the polynomials."""
    m, k, exact = root
    q = max(p, k) + max(map(len, polynomials)).bit_length() + 8
    values = [Fixed(polynomial, m, k) for polynomial in polynomials]
    unit = min(each.s for each in values)
    found = []
    for each in values:
        value, error = each.near(m, k, q, exact=exact)
        shift = each.s - unit
        spend(500 + (q + shift) // 30)
        found.append(Interval(value - error << shift, value + error << shift, p))
    return found


# ---------------------------------------------------------------------------------------------------------------------
# Check 7: simple solutions
# ---------------------------------------------------------------------------------------------------------------------


def are_simple(representation: Representation, legs: Sequence[Leg], g: Metric) -> bool:
    """Whether the determinant of the leg lines is coprime to h0 modulo a prime."""
    h0 = primitive_part(representation.h)
    return any(len(common_divisor(h0_p, lines, p)) == 1 for p, h0_p, lines in lines_modulo(h0, representation, legs, g))


def lines_modulo(
    h0: Polynomial, representation: Representation, legs: Sequence[Leg], g: Metric
) -> Iterator[tuple[int, Polynomial, Polynomial]]:
    """Primes, with h0 and the determinant of the leg lines modulo them."""
    for p in good_primes(h0):
        placed = motion_modulo(representation, g, h0, p)
        yield p, reduced(h0, p), determinant(leg_lines(legs, placed)).polynomial()


def double_factor(representation: Representation, legs: Sequence[Leg], g: Metric, degree: int) -> Polynomial | None:
    """A factor of h0 of a degree at whose roots the leg lines are dependent, hence the solutions multiple.

    None if it is not found. Modulo a prime it is the greatest common divisor of h0 and the determinant.
    """
    h0 = primitive_part(representation.h)
    for p in ((1 << n) - 1 for n in MERSENNE[:4] if degree > 0):
        if h0[-1] % p:
            lines = determinant(leg_lines(legs, motion_modulo(representation, g, h0, p))).polynomial()
            factor = lifted_factor(common_divisor(reduced(h0, p), lines, p), p)
            if len(factor) - 1 != degree:
                return None
            if is_factor(factor, h0):
                return factor if has_dependent_lines(factor, representation, legs, g) else None
    return None


def lifted_factor(monic: Polynomial, p: int) -> Polynomial:
    """A primitive polynomial over Z that is a multiple of a monic one modulo p, its coefficients small if possible."""
    lead, bound = 1, isqrt(p) >> 8
    for value in monic:
        lead *= least_denominator(value * lead % p, p, bound)
    values = [value * lead % p for value in monic[:-1]]
    return primitive_part([*(value - p if 2 * value > p else value for value in values), lead])


def is_factor(a: Polynomial, b: Polynomial) -> bool:
    """Whether a, primitive, divides b over Z."""
    spend(len(a) * len(b) * (300 + product_cost(max(map(abs, a)).bit_length(), 2 * max(map(abs, b)).bit_length())))
    rest = list(b)
    for place in reversed(range(len(b) - len(a) + 1)):
        factor = rest[place + len(a) - 1] // a[-1]
        for power, coefficient in enumerate(a, place):
            rest[power] -= factor * coefficient
    return not any(rest)


def has_dependent_lines(a: Polynomial, representation: Representation, legs: Sequence[Leg], g: Metric) -> bool:
    """Whether the determinant of the leg lines is 0 at all roots of a factor a of h0, over Q.

    It is a polynomial in T of a degree d and of a size S at most; with l the leading coefficient of a, l^d times its
    remainder has integer coefficients of a size of at most S size(a)^d. If they are 0 modulo a number greater than
    this, they are 0.
    """
    bound = determinant(leg_lines(legs, sized_motion(representation, g)))
    n = exponent_above(bound.size * size(a) ** bound.degree, a[-1])
    placed = motion_modulo(representation, g, a, (1 << n) - 1)
    return not determinant(leg_lines(legs, placed)).polynomial()


@dataclass(frozen=True)
class Sized:
    """Bounds of the size and the degree of a polynomial, which what is computed from polynomials keeps to."""

    size: int
    degree: int

    def __add__(self, other: Sized) -> Sized:
        return Sized(self.size + other.size, max(self.degree, other.degree))

    __sub__ = __add__

    def __mul__(self, other: Sized) -> Sized:
        return Sized(self.size * other.size, self.degree + other.degree)

    def __rmul__(self, scalar: int) -> Sized:
        return Sized(abs(scalar) * self.size, self.degree)

    @property
    def ring(self) -> type[Sized]:
        """Where it is from."""
        return Sized

    @classmethod
    def element(cls, polynomial: Polynomial) -> Sized:
        """The bounds of a polynomial."""
        return cls(size(polynomial), len(polynomial))


def sized_motion(representation: Representation, g: Metric) -> Motion:
    """Bounds of the quantities of the motion."""
    x = [Sized.element(numerator) for numerator in representation.numerators]
    return motion(x[:4], x[4:], g)


def doubled(factor: Polynomial, representation: Representation) -> dict[Ends, int]:
    """2 at the real roots of a factor of h0, by the texts of their isolating intervals."""
    found = {}
    for root in isolated(primitive_part(representation.h)):
        if has_root(factor, root):
            found[ends(root.m, root.m + (not root.exact), root.k)] = 2
    return found


def leg_lines(legs: Sequence[Leg], placed: Motion) -> list[list[Any]]:
    """Rows (d, b x d) with d = N (C + R B - A) and b = N R B, times q^2; for planar robots d1, d2 and the third moment.

    q is a denominator of the joints of the leg; it multiplies the row, and N the last columns.
    """
    rows = []
    for leg in legs:
        scale, *joints = cleared([Fraction(1), *leg.base, *leg.platform])
        arm = [combination(joints[3:], row) for row in placed.rotation]
        line = [scale * placed.position[i] + arm[i] - joints[i] * placed.norm for i in range(3)]
        moment = [arm[j] * line[k] - arm[k] * line[j] for _, j, k in CYCLIC]
        row = [*(scale * entry for entry in line), *moment]
        rows.append(row if len(legs) == 6 else [row[0], row[1], row[5]])
    return rows


def determinant(rows: Sequence[Sequence[Any]]) -> Any:
    """The determinant by Laplace's expansion, row by row: n 2^(n - 1) products, no division."""
    minors: dict[tuple[int, ...], Any] = {(column,): entry for column, entry in enumerate(rows[0])}
    for number, row in enumerate(rows[1:], 2):
        wider = {}
        for columns in combinations(range(len(rows)), number):
            total: Any = None
            for place, column in enumerate(columns):
                term = row[column] * minors[columns[:place] + columns[place + 1 :]]
                signed = -1 * term if (number - 1 - place) % 2 else term
                total = signed if total is None else total + signed
            wider[columns] = total
        minors = wider
    return minors[tuple(range(len(rows)))]


# ---------------------------------------------------------------------------------------------------------------------
# Check 8: elimination
# ---------------------------------------------------------------------------------------------------------------------

Monomial: TypeAlias = tuple[int, ...]  # exponents
Terms: TypeAlias = dict[Monomial, int]
Affine: TypeAlias = dict[Monomial, Fraction]  # also of degree 2: a product of two

MERSENNE: Final = (127, 521, 1279, 2203, 3217, 4423, 9689, 19937, 44497, 86243)
"""2^n - 1 is prime for these n."""


@dataclass(frozen=True)
class Elimination:
    """Polynomials that vanish at all poses, in terms of the unknowns, which stand at these places in (u, C, s, R)."""

    places: tuple[int, ...]
    elements: list[Terms]
    leading: list[Monomial]

    def is_standard(self, monomial: Monomial) -> bool:
        """Whether no leading monomial divides this one."""
        return not any(is_divisor(lead, monomial) for lead in self.leading)

    def basis(self, most: int = GREATEST_NUMBER) -> list[Monomial]:
        """The standard monomials, smallest first; at most 40 of them, or another number."""
        spend(2000 * (most + 1) * (len(self.places) + 1) * (1 + len(self.leading)))
        found: list[Monomial] = []
        layer = list(filter(self.is_standard, [(0,) * len(self.places)]))
        while layer:
            found += sorted(layer, key=order)
            few = len(found) <= most
            require(few, f"elimination: it leaves more than {most} monomials")
            larger = {times(monomial, axis) for monomial in layer for axis in range(len(self.places))}
            layer = list(filter(self.is_standard, larger))
        return found


def order(monomial: Monomial) -> tuple[int, ...]:
    """The key of the degree reverse lexicographic order."""
    return sum(monomial), *(-exponent for exponent in reversed(monomial))


def times(monomial: Monomial, *axes: int) -> Monomial:
    """The monomial times unknowns."""
    exponents = list(monomial)
    for axis in axes:
        exponents[axis] += 1
    return tuple(exponents)


def is_divisor(one: Monomial, other: Monomial) -> bool:
    """Whether one monomial divides the other."""
    return all(a <= b for a, b in zip(one, other, strict=True))


def eliminate(legs: Sequence[Leg], g: Metric, steps: Sequence[Step]) -> Elimination:
    """Check 8."""
    places, quadrics = section(legs, g)
    return followed(places, echelon_form(quadrics), steps)


def followed(places: tuple[int, ...], elements: list[Terms], steps: Sequence[Step]) -> Elimination:
    """The steps of an elimination, from the first elements on."""
    leading = [next(iter(element)) for element in elements]
    for number, step in enumerate(steps, 1):
        known = all(index < len(elements) and max(factors, default=-1) < len(places) for index, *factors in step)
        require(known, f"elimination: step {number} names an element or an unknown that there is not")
        limit_terms(sum(len(elements[index]) for index, *_ in step))
        products = [
            {times(monomial, *factors): value for monomial, value in elements[index].items()}
            for index, *factors in step
        ]
        found = echelon_form(products)
        spend(2000 * len(found) * len(leading))
        new = [element for element in found if not any(is_divisor(lead, next(iter(element))) for lead in leading)]
        elements += new
        leading += [next(iter(element)) for element in new]
        limit_terms(sum(map(len, elements)))
    return Elimination(places, elements, leading)


def limit_terms(number: int) -> None:
    """Refuse more terms than the products of a step, or all elements, may have; count going over them."""
    affordable(number <= MAX_TERMS, f"elimination: more than {MAX_TERMS} terms")
    spend(3000 * number)


def section(legs: Sequence[Leg], g: Metric) -> tuple[tuple[int, ...], list[Terms]]:
    """The places of the unknowns in (u, C, s, R), and the quadrics in them that vanish at the poses."""
    rows = []
    for leg in legs:
        constant, *rotation = leg_form(leg, g)[:10]
        position, turned, square = leg_form(leg, g)[10:13], leg_form(leg, g)[13:16], leg_form(leg, g)[16]
        rows.append([*turned, *position, square, *rotation, constant])
    if len(legs) == 3:
        fixed = {2: 0, 5: 0, 9: 0, 12: 0, 13: 0, 14: 0, 15: 1}
        rows += [[*(int(place == other) for other in range(16)), -value] for place, value in fixed.items()]
    solved = echelon_form([{(-place,): value for place, value in enumerate(row) if value} for row in rows])
    pivots = {-next(iter(row))[0]: row for row in solved}
    places = tuple(place for place in range(16) if place not in pivots)
    one = (0,) * len(places)
    coordinates: list[Affine] = []
    for place in range(16):
        if place in places:
            coordinates.append({times(one, places.index(place)): Fraction(1)})
        else:
            (_, lead), *rest = pivots[place].items()
            monomials = [one if column == -16 else times(one, places.index(-column)) for (column,), _ in rest]
            values = [Fraction(-value, lead) for _, value in rest]
            coordinates.append(dict(zip(monomials, values, strict=True)))
    quadrics = [cleared_terms(quadric) for quadric in motion_quadrics(coordinates, g, {one: Fraction(1)})]
    return places, [*quadrics, *[{one: 1}] * (16 in pivots)]


def cleared_terms(polynomial: Affine) -> Terms:
    """An integer multiple."""
    return dict(zip(polynomial, cleared(list(polynomial.values())), strict=True))


def added(*terms: tuple[Fraction | int, Affine]) -> Affine:
    """The combination of polynomials."""
    total: Affine = {}
    bits = max((bits_of_fraction(value) for _, each in terms for value in each.values()), default=0)
    spend(sum(len(each) for _, each in terms) * 2 * fraction_cost(bits, bits))
    for scalar, polynomial in terms:
        for monomial, value in polynomial.items():
            total[monomial] = total.get(monomial, Fraction(0)) + scalar * value
    return {monomial: value for monomial, value in total.items() if value}


def bits_of_fraction(value: Fraction) -> int:
    """The length of its longer part."""
    return max(value.numerator.bit_length(), value.denominator.bit_length())


def multiplied(a: Affine, b: Affine) -> Affine:
    """The product."""
    total: Affine = {}
    bits = max(map(bits_of_fraction, [*a.values(), *b.values(), Fraction(0)]))
    spend(len(a) * len(b) * (3000 + 2 * fraction_cost(2 * bits, bits)))
    for one, x in a.items():
        for other, y in b.items():
            monomial = tuple(map(sum, zip(one, other, strict=True)))
            total[monomial] = total.get(monomial, Fraction(0)) + x * y
    return total


def motion_quadrics(coordinates: Sequence[Affine], g: Metric, one: Affine) -> Iterator[Affine]:
    """The equations of rigid motions in check 8, of u, C, s and R given as polynomials."""
    u, c, s = coordinates[:3], coordinates[3:6], coordinates[6]
    r = [coordinates[7 + 3 * i : 10 + 3 * i] for i in range(3)]
    inverse = [Fraction(1, x) for x in g]
    for i in range(3):
        for j in range(i, 3):
            same = int(i == j)
            yield added(*((g[k], multiplied(r[k][i], r[k][j])) for k in range(3)), (-same * g[i], one))
            yield added(*((inverse[k], multiplied(r[i][k], r[j][k])) for k in range(3)), (-same * inverse[i], one))
        yield added(*((1, multiplied(r[i][k], u[k])) for k in range(3)), (-1, c[i]))
        yield added(*((g[k], multiplied(r[k][i], c[k])) for k in range(3)), (-g[i], u[i]))
    for v in (u, c):
        yield added(*((g[k], multiplied(v[k], v[k])) for k in range(3)), (-1, s))
    for i, j, k in CYCLIC:
        for x, y, z in CYCLIC:
            minor = (1, multiplied(r[j][y], r[k][z])), (-1, multiplied(r[j][z], r[k][y]))
            yield added(*minor, (-g[i] * inverse[x], r[i][x]))
            # row i of G^-1 (C x R e_x) = R G^-1 (u x e_x), where u x e_x = u_z e_y - u_y e_z
            left = (inverse[i], multiplied(c[j], r[k][x])), (-inverse[i], multiplied(c[k], r[j][x]))
            right = (-inverse[y], multiplied(r[i][y], u[z])), (inverse[z], multiplied(r[i][z], u[y]))
            yield added(*left, *right)


def echelon_form(rows: Sequence[Mapping[Monomial, int]]) -> list[Terms]:
    """The reduced echelon form over Q, as primitive integer rows, monomials decreasing.

    The columns of the pivots are found modulo a prime, where the rank r is at most that over Q. For them, rows E are
    computed modulo a larger number and lifted to rationals. If each given row is, over Q, the combination of E that its
    entries at the pivots demand, then E spans all given rows, so their rank is r; if moreover each row of E begins at
    its pivot, then E is the reduced echelon form, which is unique. If not, a prime was unlucky, or a number too small.
    """
    spend(3000 * sum(map(len, rows)))
    columns = sorted({monomial for row in rows for monomial in row}, key=order, reverse=True)
    place = {monomial: number for number, monomial in enumerate(columns)}
    matrix = [{place[monomial]: value for monomial, value in row.items() if value} for row in rows]
    matrix = [row for row in matrix if row]
    if not matrix:
        return []
    few = len(rows) * len(columns) <= MAX_ENTRIES_OF_A_MATRIX
    affordable(few, f"elimination: a matrix of more than {MAX_ENTRIES_OF_A_MATRIX} entries")
    for n in MERSENNE[:3]:
        pivots, independent = pivots_modulo(matrix, n)
        if not pivots:
            continue
        denominator, bits = common_denominator(independent, pivots, n)
        for larger in islice(prime_exponents(bits + 40), 2):
            solved = solved_modulo(independent, pivots, larger)
            lifted = lifted_rows(solved, larger, denominator) if solved is not None else None
            if (
                lifted is not None
                and list(map(min, lifted.values())) == list(lifted)
                and all(is_combination(row, lifted) for row in matrix)
            ):
                return [{columns[c]: lifted[pivot][c] for c in sorted(lifted[pivot])} for pivot in sorted(lifted)]
    raise Refusal("too-large", "elimination: an echelon form is not found modulo several primes")


def prime_exponents(least: int) -> Iterator[int]:
    """Prime numbers n from a size on for which 2^n - 1 has no small factor, so hardly ever one in common with a pivot.

    Its factors are 1 modulo 2 n.
    """
    for n in count(least | 1, 2):
        if all(n % k for k in range(3, isqrt(n) + 1, 2)):
            spend(10**7)
            if all(pow(2, n, 2 * k * n + 1) != 1 for k in range(1, 1000)):
                yield n


def exponent_above(bound: int, lead: int) -> int:
    """An n for which 2^n - 1 is above a bound, and modulo which a number has an inverse."""
    return next(n for n in prime_exponents(bound.bit_length() + 2) if gcd(lead, (1 << n) - 1) == 1)


def pivots_modulo(matrix: Sequence[Mapping[int, int]], n: int) -> tuple[set[int], list[Mapping[int, int]]]:
    """The columns of the pivots of the echelon form modulo 2^n - 1, and as many rows that are independent there."""
    found: dict[int, dict[int, int]] = {}
    independent = []
    for given in sorted(matrix, key=min):
        row = remainders(given, n)
        while row:
            lead = min(row)
            factor = row.pop(lead)
            if lead not in found:
                found[lead] = scaled(row, factor, n)
                independent.append(given)
                break
            subtract(row, factor, found[lead], n)
    return set(found), independent


class Pivot(NamedTuple):
    """A step of an elimination modulo a prime: row ``number``, times ``inverse``, is 1 at ``column`` and else ``row``.

    Multiples of it, ``multiples``, were subtracted from the rows that were left.
    """

    number: int
    column: int
    inverse: int
    multiples: dict[int, int]
    row: dict[int, int]


def factored(rows: Sequence[Mapping[int, int]], n: int) -> list[Pivot]:
    """The elimination of a square matrix that is regular modulo 2^n - 1, sparse rows and columns first (Markowitz)."""
    left = {number: remainders(row, n) for number, row in enumerate(rows)}
    steps = []
    while left:
        spend(300 * len(left) * 40)
        number = min(left, key=lambda i: len(left[i]))
        row = left.pop(number)
        column = min(row, key=lambda c: sum(c in other for other in left.values()))
        factor = row.pop(column)
        inverse = inverse_of(factor, n)
        row = {c: folded(value * inverse, n) for c, value in row.items()}
        multiples = {other: entries.pop(column) for other, entries in left.items() if column in entries}
        for other, multiple in multiples.items():
            subtract(left[other], multiple, row, n)
        steps.append(Pivot(number, column, inverse, multiples, row))
    return steps


def solution_modulo(steps: Sequence[Pivot], right: Sequence[int], n: int) -> dict[int, int]:
    """The solution, by columns, of the equations of an eliminated matrix with these right sides."""
    spend(sum(2 + len(step.multiples) + len(step.row) for step in steps) * (300 + product_cost(n, n)))
    values = list(right)
    for step in steps:
        value = values[step.number] = folded(values[step.number] * step.inverse, n)
        for other, multiple in step.multiples.items():
            values[other] = folded(values[other] - multiple * value, n)
    solution: dict[int, int] = {}
    for step in reversed(steps):
        rest = sum(value * solution[column] for column, value in step.row.items())
        solution[step.column] = folded(values[step.number] - rest, n)
    return solution


def common_denominator(rows: Sequence[Mapping[int, int]], pivots: set[int], n: int) -> tuple[int, int]:
    """A common denominator D of X, where B X = C for the columns B at the pivots and the others C; the bits of D X.

    They are those of one vector X v, its digits to the base p = 2^n - 1 found one after another (Dixon 1982). It may,
    rarely, lack a small factor of D.
    """
    square = [{column: value for column, value in row.items() if column in pivots} for row in rows]
    steps, p = factored(square, n), (1 << n) - 1
    spend(1000 * sum(map(len, rows)))
    weights = {column: pow(3, 1000 + column, 65537) for row in rows for column in row if column not in pivots}
    right = [sum(value * weights[column] for column, value in row.items() if column in weights) for row in rows]
    bits = max(abs(value).bit_length() for row in rows for value in row.values())
    terms = sum(map(len, square))
    solution, modulus, due = dict.fromkeys(pivots, 0), 1, 1
    for number in count(1):
        digit = solution_modulo(steps, [folded(value, n) for value in right], n)
        spend(terms * (200 + product_cost(bits, n)) + len(rows) * (500 + product_cost(n, modulus.bit_length() + bits)))
        right = [
            (value - sum(entry * digit[column] for column, entry in row.items())) // p
            for value, row in zip(right, square, strict=True)
        ]
        solution = {column: value + digit[column] * modulus for column, value in solution.items()}
        modulus *= p
        if number >= due:
            due += number // 6 + 1
            found = denominator_of(list(solution.values()), modulus)
            if found is not None:
                return found
    raise AssertionError("endless")


def denominator_of(residues: Sequence[int], modulus: int) -> tuple[int, int] | None:
    """A common denominator of fractions with these residues and the bits of all when it is cleared; None if unclear."""
    bits = modulus.bit_length()
    spend(len(residues) * (1000 + product_cost(bits, bits)))
    bound = isqrt(modulus) >> 16
    mixed = sum(value * pow(5, 1000 + place, 65537) for place, value in enumerate(residues))
    denominator = least_denominator(mixed % modulus, modulus, bound)
    largest = denominator
    for residue in residues:
        value = residue * denominator % modulus
        if bound < value < modulus - bound:
            further = least_denominator(value, modulus, bound)
            denominator, largest = denominator * further, largest * further
            value = value * further % modulus
        largest = max(largest, min(value, modulus - value))
        if largest > bound:
            return None
    return denominator, largest.bit_length()


def inverse_of(value: int, n: int) -> int:
    """The inverse modulo 2^n - 1; ValueError if there is none."""
    spend(8000 + n * n // 8)
    return pow(value, -1, (1 << n) - 1)


def solved_modulo(rows: Sequence[Mapping[int, int]], pivots: set[int], n: int) -> dict[int, dict[int, int]] | None:
    """The rows modulo p = 2^n - 1 that have a 1, left out, at one of the pivots, by pivot, and 0 at the others.

    Any order of elimination serves; to keep the rows sparse, the one with the fewest pivots is next (Markowitz 1957).
    None if p divides the determinant at the pivots, or has a factor in common with one of them.
    """
    left = [remainders(row, n) for row in rows]
    done = []
    while left:
        spend(300 * len(left) * 40)
        row = left.pop(min(range(len(left)), key=lambda i: len(left[i].keys() & pivots)))
        candidates = sorted(row.keys() & pivots)
        if not candidates:
            return None
        pivot = min(candidates, key=lambda column: sum(column in other for other in left))
        try:
            row = scaled(row, row.pop(pivot), n)
        except ValueError:
            return None
        done.append((pivot, row))
        for other in left:
            if pivot in other:
                subtract(other, other.pop(pivot), row, n)
    solved: dict[int, dict[int, int]] = {}
    for pivot, row in reversed(done):
        total = {column: value for column, value in row.items() if column not in pivots}
        for known in sorted(row.keys() & pivots):
            spend(len(solved[known]) * (300 + product_cost(n, n)))
            for column, value in solved[known].items():
                total[column] = total.get(column, 0) - row[known] * value
        solved[pivot] = remainders(total, n)
    return solved


def remainders(row: Mapping[int, int], n: int) -> dict[int, int]:
    """A row modulo 2^n - 1, without zeros."""
    spend(400 * len(row))
    return {column: rest for column, value in row.items() if (rest := folded(value, n))}


def folded(value: int, n: int) -> int:
    """The remainder modulo p = 2^n - 1, where 2^n is 1."""
    p = (1 << n) - 1
    value = (value & p) + (value >> n)
    return value if 0 <= value < p else value % p


def scaled(row: Mapping[int, int], divisor: int, n: int) -> dict[int, int]:
    """A row divided by a number, modulo 2^n - 1."""
    inverse = inverse_of(divisor, n)
    spend(len(row) * (300 + product_cost(n, n)))
    return {column: folded(value * inverse, n) for column, value in row.items()}


def subtract(row: dict[int, int], factor: int, other: Mapping[int, int], n: int) -> None:
    """Subtract a multiple of another row, modulo 2^n - 1."""
    spend(len(other) * (300 + product_cost(n, n)))
    p = (1 << n) - 1
    for column, value in other.items():
        entry = row.get(column, 0) - factor * value
        entry = (entry & p) + (entry >> n)
        if not 0 <= entry < p:
            entry %= p
        if entry:
            row[column] = entry
        else:
            row.pop(column, None)


def lifted_rows(pivots: Mapping[int, Mapping[int, int]], n: int, denominator: int) -> dict[int, dict[int, int]] | None:
    """Primitive integer rows that are the given ones modulo 2^n - 1, of about this denominator; None if it fails."""
    p, lifted = (1 << n) - 1, {}
    bound = p >> 20
    for pivot, row in pivots.items():
        spend(len(row) * (1000 + 5 * product_cost(n, n)))
        lead = denominator
        for value in row.values():
            value = value * lead % p
            if bound < value < p - bound:
                lead *= least_denominator(value, p, bound)
        cleared_row = {column: value * lead % p for column, value in row.items()}
        if lead > bound or any(bound < value < p - bound for value in cleared_row.values()):
            return None
        cleared_row = {column: value - p if 2 * value > p else value for column, value in cleared_row.items()}
        content = gcd(lead, *cleared_row.values())
        lifted[pivot] = {pivot: lead // content, **{column: value // content for column, value in cleared_row.items()}}
    return lifted


def least_denominator(value: int, p: int, bound: int) -> int:
    """The denominator of the fraction, numerator up to a bound, that is this value modulo p (Wang 1981)."""
    spend(1000 + (p.bit_length() - bound.bit_length()) * (300 + p.bit_length() // 8))
    older, newer, before, now = p, min(value, p - value), 0, 1
    while newer > bound:
        quotient = older // newer
        older, newer = newer, older - quotient * newer
        before, now = now, before - quotient * now
    return abs(now)


def is_combination(row: Mapping[int, int], lifted: Mapping[int, Mapping[int, int]]) -> bool:
    """Whether a row is the combination of the lifted rows that its entries at their pivots demand, over Q."""
    pivots = [column for column in row if column in lifted]
    spend(300 * len(row) + sum(lifted[pivot][pivot].bit_length() for pivot in pivots) ** 2 // 700)
    scale = lcm(*(lifted[pivot][pivot] for pivot in pivots))
    entry = max(max(map(abs, lifted[pivot].values())).bit_length() for pivot in pivots) if pivots else 0
    given = max(map(abs, row.values())).bit_length()
    spend(sum(len(lifted[pivot]) for pivot in pivots) * (500 + product_cost(scale.bit_length() + given, entry)))
    rest = {column: -scale * value for column, value in row.items()}
    for pivot in pivots:
        factor = row[pivot] * (scale // lifted[pivot][pivot])
        for column, value in lifted[pivot].items():
            rest[column] = rest.get(column, 0) + factor * value
    return not any(rest.values())


# ---------------------------------------------------------------------------------------------------------------------
# Check 9: the algebra that an elimination defines, and multiplicities
# ---------------------------------------------------------------------------------------------------------------------


class Vector(NamedTuple):
    """Rational coordinates on the basis of an algebra, with a common denominator."""

    numerators: list[int]
    denominator: int


def combined(terms: Sequence[tuple[int, Vector]], divisor: int, length: int) -> Vector:
    """The combination of vectors, divided by a number."""
    common = 1
    for _, vector in terms:
        spend(2 * division_cost(common.bit_length(), vector.denominator.bit_length()))
        common = lcm(common, vector.denominator)
    total = [0] * length
    for scalar, vector in terms:
        factor = scalar * (common // vector.denominator)
        spend(length * (200 + product_cost(factor.bit_length(), most_bits(vector.numerators))))
        for place, value in enumerate(vector.numerators):
            total[place] += factor * value
    spend(2 * length * division_cost(most_bits(total), most_bits([common * divisor])))
    shared = gcd(common * divisor, *total)
    return Vector([value // shared for value in total], common * divisor // shared)


@dataclass(frozen=True)
class Algebra:
    """The algebra of all poses: row b of ``unknowns[i]`` is the i-th unknown times the b-th monomial of the basis."""

    basis: list[Monomial]
    unknowns: list[list[Vector]]

    def times_unknown(self, vector: Vector, axis: int) -> Vector:
        """The product of an element and an unknown."""
        terms = [(value, row) for value, row in zip(vector.numerators, self.unknowns[axis], strict=True) if value]
        return combined(terms, vector.denominator, len(self.basis))

    def vanish(self, elements: Iterable[Terms]) -> bool:
        """Whether all elements are 0, evaluated by the matrices alone; those of leading monomials may define none."""
        vectors = {self.basis[0]: Vector([1] + [0] * (len(self.basis) - 1), 1)}
        for element in elements:
            spend(1000 * len(element))
            for monomial in element:
                if monomial not in vectors:
                    self.reach(monomial, vectors)
            value = combined([(factor, vectors[m]) for m, factor in element.items()], 1, len(self.basis))
            if any(value.numerators):
                return False
        return True

    def reach(self, monomial: Monomial, vectors: dict[Monomial, Vector]) -> None:
        """Add the coordinates of a monomial to the known ones, multiplying by one unknown after another."""
        word = [axis for axis, exponent in enumerate(monomial) for _ in range(exponent)]
        known = self.basis[0]
        for axis in word:
            larger = times(known, axis)
            if larger not in vectors:
                vectors[larger] = self.times_unknown(vectors[known], axis)
            known = larger

    def traces(self) -> tuple[list[list[Vector]], list[Fraction]]:
        """The products of any two monomials of the basis, and the trace of multiplication by each."""
        size = len(self.basis)
        products = {self.basis[0]: [Vector([int(i == j) for j in range(size)], 1) for i in range(size)]}
        for monomial in self.basis[1:]:
            axis = next(axis for axis, exponent in enumerate(monomial) if exponent)
            smaller = tuple(exponent - (place == axis) for place, exponent in enumerate(monomial))
            products[monomial] = [self.times_unknown(row, axis) for row in products[smaller]]
        tables = [products[monomial] for monomial in self.basis]
        bits = max(row.denominator.bit_length() + most_bits(row.numerators) for table in tables for row in table)
        spend(2 * size**2 * fraction_cost(bits, bits))
        diagonals = [[Fraction(row.numerators[i], row.denominator) for i, row in enumerate(rows)] for rows in tables]
        return tables, [sum(diagonal, Fraction(0)) for diagonal in diagonals]


class Reduction:
    """Coordinates of polynomials modulo the elements, each monomial reduced once."""

    def __init__(self, elimination: Elimination, basis: Sequence[Monomial]) -> None:
        self.elements = dict(zip(elimination.leading, elimination.elements, strict=True))
        self.known = {m: Vector([int(m == other) for other in basis], 1) for m in basis}
        self.basis = set(basis)
        self.order = list(basis)

    def polynomial(self, terms: Mapping[Monomial, int], divisor: int = 1) -> Vector:
        """Coordinates of a polynomial divided by a number."""
        return combined([(value, self.monomial(m)) for m, value in terms.items()], divisor, len(self.order))

    def monomial(self, monomial: Monomial) -> Vector:
        """Coordinates of a monomial: by the element that it leads, or as an unknown times a smaller monomial."""
        if monomial not in self.known:
            if monomial in self.elements:
                (_, lead), *tail = self.elements[monomial].items()
                self.known[monomial] = self.polynomial({m: -value for m, value in tail}, lead)
            else:
                self.known[monomial] = self.from_smaller(monomial)
        return self.known[monomial]

    def from_smaller(self, monomial: Monomial) -> Vector:
        """The case that the monomial leads no element: divided by some unknown it is not standard either."""
        for axis, exponent in enumerate(monomial):
            smaller = tuple(e - (place == axis) for place, e in enumerate(monomial))
            if exponent and smaller not in self.basis:
                vector = self.monomial(smaller)
                break
        terms = zip(self.order, vector.numerators, strict=True)
        return self.polynomial({times(m, axis): value for m, value in terms if value}, vector.denominator)


def quotient_algebra(elimination: Elimination, basis: list[Monomial]) -> Algebra | None:
    """The algebra, or None if the matrices do not commute or an element is not 0 in it (Mourrain 1999)."""
    reduction = Reduction(elimination, basis)
    shallow = all(sum(m) <= MAX_MONOMIAL_DEGREE for element in elimination.elements for m in element)
    affordable(shallow, f"elimination: a monomial of degree above {MAX_MONOMIAL_DEGREE}")
    axes = range(len(elimination.places))
    border = {times(m, axis) for m in basis for axis in axes}
    # Smaller ones first, so that recursion is shallow.
    found = {m: reduction.monomial(m) for m in sorted(border.union(*elimination.elements), key=order)}
    algebra = Algebra(basis, [[found[times(m, axis)] for m in basis] for axis in axes])
    twice = [[[algebra.times_unknown(row, axis) for row in rows] for axis in axes] for rows in algebra.unknowns]
    commute = twice == [list(column) for column in zip(*twice, strict=True)]
    return algebra if commute and algebra.vanish(elimination.elements) else None


Powers: TypeAlias = Callable[[Sequence[int], int], list[list[int]]]


def multiplicity_polynomial(
    algebra: Algebra, representation: Representation, powers_of: Powers, number: int
) -> Polynomial | None:
    """V with V(t) = m(t) h0'(t) at each root t of h0, where m(t) is the multiplicity; None if it is not found.

    The algebra must have D distinct solutions: those at the roots of h0. For a combination u of unknowns,
    Tr(u^k) is the sum of m(t) u(t)^k. Modulo p, u is a polynomial in T modulo h0, by the representation, and so are its
    powers (``powers_of``, from the weights of the ``number`` unknowns and p). If 1, u, u^2, .. are independent there,
    these equations yield s_j = sum of m(t) t^j, and V = sum of m(t) h0 / (T - t) follows. Now V is an integer
    polynomial: the sum over m of m a' b, where h0 = a b and the roots of a are those of multiplicity m. Its
    coefficients are at most n^2 D 2^D times the size of h0 (Mignotte), less than p / 2.
    """
    h0 = primitive_part(representation.h)
    tables, traces = algebra.traces()
    scale, *trace_numbers = cleared([Fraction(1), *traces])
    rows: list[Terms] = [
        {(-j,): value for j, value in enumerate(cleared([inner(row, trace_numbers, scale) for row in table])) if value}
        for table in tables
    ]
    if len(echelon_form(rows)) != len(h0) - 1:  # the rank of the trace form
        return None
    bound = 2 * len(algebra.basis) ** 2 * len(h0) * size(h0) << len(h0)
    for n, weight in ((n, weight) for n in MERSENNE if bound >> n == 0 for weight in (3, 5, 7)):
        p = (1 << n) - 1
        weights = [pow(weight, power, p) for power in range(number)]
        try:
            powers, sums = powers_of(weights, p), power_sums(algebra, traces, weights, p, len(h0) - 1)
        except ValueError:  # p divides a denominator
            continue
        solved = solved_modulo(
            [dict(enumerate([*power, total])) for power, total in zip(powers, sums, strict=True)],
            set(range(len(h0) - 1)),
            n,
        )
        if solved is not None:
            s = [solved[j].get(len(h0) - 1, 0) for j in range(len(h0) - 1)]
            v = [sum(x * y for x, y in zip(h0[i:], s, strict=False)) % p for i in range(1, len(h0))]
            return [x - p if 2 * x > p else x for x in v]
    raise Refusal("rejected", "elimination: no form in its unknowns tells the multiple solutions apart")


def inner(vector: Vector, values: Sequence[int], scale: int) -> Fraction:
    """The value of a linear form, given with a common denominator, at a vector."""
    bits, by = most_bits(vector.numerators), most_bits(values)
    spend(len(values) * (200 + product_cost(bits, by)) + fraction_cost(bits, by))
    return Fraction(sum(x * y for x, y in zip(vector.numerators, values, strict=True)), vector.denominator * scale)


def powers_modulo(
    representation: Representation, g: Metric, places: Sequence[int], weights: Sequence[int], p: int
) -> list[list[int]]:
    """1, u, .., u^(D - 1) as polynomials in T modulo p and h0; ValueError if p is not suitable.

    It is above the leading coefficient of h0.
    """
    placed = motion_modulo(representation, g, primitive_part(representation.h), p)
    ordered = [*placed.turned, *placed.position, placed.square, *placed.by_rows()]
    return powers_of_quotient(combination(weights, [ordered[place] for place in places]), placed.norm)


def powers_of_quotient(numerator: Residue, denominator: Residue) -> list[list[int]]:
    """1, u, .., u^(D - 1) for a quotient u of residues; ValueError if the denominator is no unit."""
    ring = numerator.ring
    u = numerator * ring.element(inverse_modulo(denominator.polynomial(), ring.g, ring.m))
    powers = [ring.element([1])]
    for _ in range(ring.degree - 1):
        powers.append(powers[-1] * u)
    return [power.value for power in powers]


def inverse_modulo(a: Polynomial, g: Polynomial, p: int) -> Polynomial:
    """The inverse modulo g and a prime; ValueError without one. Remainders of Euclid's algorithm are c a modulo g."""
    older: tuple[Polynomial, Polynomial] = (reduced(g, p), [])
    newer: tuple[Polynomial, Polynomial] = (a, [1])
    while len(newer[0]) > 1:
        quotient, rest = divided(older[0], newer[0], p)
        step = product(quotient, newer[1], p)
        length = max(len(step), len(older[1]))
        c = [x - y for x, y in zip(padded(older[1], length), padded(step, length), strict=True)]
        older, newer = newer, (rest, reduced(c, p))
    inverse = pow(sum(newer[0]), -1, p)  # of a constant, or of 0
    return [c * inverse % p for c in newer[1]]


def padded(polynomial: Polynomial, length: int) -> list[int]:
    """The coefficients, with zeros up to a length."""
    return [*polynomial, *[0] * (length - len(polynomial))]


def power_sums(algebra: Algebra, traces: Sequence[Fraction], weights: Sequence[int], p: int, number: int) -> list[int]:
    """Tr(1), Tr(u), .. modulo p; ValueError if that divides a denominator."""
    vectors = [row for rows in algebra.unknowns for row in rows]
    bits, each = p.bit_length(), max(most_bits([v.denominator, *v.numerators]) for v in vectors)
    cost = 300 + product_cost(bits, max(bits, each)) + division_cost(max(bits, each), bits)
    spend((len(vectors) + number + 1) * (len(traces) * cost + bits * bits // 8))
    matrix = [[0] * len(traces) for _ in traces]
    tau = [trace.numerator * pow(trace.denominator, -1, p) % p for trace in traces]
    for weight, rows in zip(weights, algebra.unknowns, strict=True):
        for target, row in zip(matrix, rows, strict=True):
            factor = weight * pow(row.denominator, -1, p)
            target[:] = [(x + factor * y) % p for x, y in zip(target, row.numerators, strict=True)]
    vector = [1] + [0] * (len(tau) - 1)
    sums = []
    for _ in range(number):
        sums.append(sum(x * y for x, y in zip(vector, tau, strict=True)) % p)
        vector = [sum(x * row[j] for x, row in zip(vector, matrix, strict=True)) % p for j in range(len(tau))]
    return sums


def multiplicities(v: Polynomial, representation: Representation) -> dict[Ends, int]:
    """V / h0' at the real roots, by the texts of their isolating intervals."""
    h0 = primitive_part(representation.h)
    found = {}
    for root in isolated(h0):
        p = 64
        while True:
            slope, value = enclosed([derivative(h0), v], refined(h0, root, max(p, root.k)), p)
            if not slope.contains_zero():
                value = value.over(slope)
                if value.high - value.low < 1 << (p - 1):
                    break
            p *= 2
        found[ends(root.m, root.m + (not root.exact), root.k)] = (value.low + value.high + (1 << p)) >> (p + 1)
    return found


# ---------------------------------------------------------------------------------------------------------------------
# Checks 9 and 10: counts and claims
# ---------------------------------------------------------------------------------------------------------------------


class Proved(NamedTuple):
    """What is proved of all solutions; ``multiplicity`` by parameter, None where they are not known."""

    claim: str
    route: str | None
    total: int | None
    has_multiple: bool
    multiplicity: dict[Ends, int] | None


def check_claims(certificate: Certificate) -> Iterator[str]:
    """The claim is what is proved, no more and no less."""
    claimed, listed = certificate.counts[2], len(certificate.poses)
    require(claimed == listed, f"real poses: {claimed} claimed, {listed} listed")
    check_parts(certificate)
    if certificate.boxes is not None:
        yield from boxes_listed(certificate, certificate.boxes)
    elif certificate.representation is None:
        yield from nothing_listed(certificate)
    elif certificate.claim == "positive-dimensional-proved":
        yield from check_self_motion(certificate, certificate.representation)
    else:
        yield from solutions_listed(certificate, certificate.representation)
    require(listed or not certificate.box_exponent, "boxes: a grid is given, but there is no pose")


def check_parts(certificate: Certificate) -> None:
    """What a certificate must have depends on its method and claim."""
    boxes = certificate.boxes is not None
    if certificate.method == "krawczyk":
        alone = boxes and certificate.representation is None and certificate.elimination is None
        require(alone, "method: krawczyk needs boxes, and neither a representation nor an elimination")
    else:
        beside = not boxes or certificate.claim.startswith("positive-dimensional")
        require(beside, "method: exact, but boxes around solutions, and no positive dimension is claimed")


def nothing_listed(certificate: Certificate) -> Iterator[str]:
    """Without a representation, an elimination may prove that there is nothing; else nothing is proved."""
    require(not any(certificate.counts), "representation: missing, but solutions are claimed")
    claim = certificate.claim, certificate.route
    if certificate.elimination is None and claim == ("not-proven-complete", None):
        yield "not proven complete: no solution is listed, and none is excluded"
    elif certificate.elimination is None and claim == ("positive-dimensional-detected", None):
        yield "positive dimension detected: evidence found by the solver, no proof"
    elif certificate.elimination is not None and claim == ("inconsistent", "exact-elimination"):
        elimination = eliminate(certificate.legs, certificate.metric, certificate.elimination)
        origin = (0,) * len(elimination.places)
        require(not elimination.is_standard(origin), "elimination: it leaves more than 0 monomials")
        yield "inconsistent: 1 = 0 follows from the leg lengths, there is no solution, real or complex"
    else:
        raise Refusal("rejected", f"claim: {certificate.claim} is not proved by what is in the certificate")


def solutions_listed(certificate: Certificate, representation: Representation) -> Iterator[str]:
    """The claim, the counts and the multiplicities beside solutions."""
    total, distinct, _ = certificate.counts
    number = len(representation.h) - 1
    require(distinct == number, f"distinct solutions: {distinct} claimed, {number} proved")
    proved = proved_of_all(certificate, representation)
    claimed = f"{certificate.claim} by {certificate.route or 'no route'}"
    require(
        (certificate.claim, certificate.route) == (proved.claim, proved.route),
        f"claim: {claimed}, but what is proved is {proved.claim} by {proved.route or 'no route'}",
    )
    require(proved.total in (None, total), f"complex solutions: {total} claimed, {proved.total} proved")
    possible = number <= total <= GREATEST_NUMBER
    require(possible, f"complex solutions: {total} claimed, {number} distinct ones proved")
    for place, pose in enumerate(certificate.poses, 1):
        expected = None if proved.multiplicity is None else proved.multiplicity.get(pose.parameter or ("", ""), 1)
        same = pose.multiplicity == expected
        require(same, f"multiplicity: that of pose {place} differs from what is proved")
    yield from solution_lines(number, total, proved)


def solution_lines(number: int, total: int, proved: Proved) -> Iterator[str]:
    """What is proved, in words."""
    if proved.total is None:
        yield (
            f"complex solutions: {number} distinct; not proved that all are simple, and the number {total} with "
            "multiplicity is not proved"
        )
    elif proved.has_multiple:
        yield f"complex solutions: {number} distinct, {total} with multiplicity"
    else:
        yield f"complex solutions: {number}, each isolated and simple, its leg lines are independent"
    if proved.route == "refined-bezout":
        yield f"complete: {number} isolated solutions are the degree of the rigid motions, there is no other"
    elif proved.route == "exact-elimination":
        yield f"complete: polynomials over Q that vanish at all poses leave room for {proved.total}, there is no other"
    else:
        yield f"not proven complete: {number} solutions are proved, others are not excluded"


def proved_of_all(certificate: Certificate, representation: Representation) -> Proved:
    """The strongest claim that is proved."""
    number = len(representation.h) - 1
    simple = are_simple(representation, certificate.legs, certificate.metric)
    if certificate.elimination is None:
        if simple and number == GREATEST_NUMBER and len(certificate.legs) == 6:
            return Proved("complete", "refined-bezout", number, False, {})
        return Proved("not-proven-complete", None, number if simple else None, False, {} if simple else None)
    elimination = eliminate(certificate.legs, certificate.metric, certificate.elimination)
    basis = elimination.basis()
    if simple and len(basis) == number:
        return Proved("complete", "exact-elimination", number, False, {})
    line = f"elimination: it leaves {len(basis)} monomials, but the {number} solutions are proved simple"
    require(not simple, line)
    double = double_factor(representation, certificate.legs, certificate.metric, len(basis) - number)
    if double is not None:
        return Proved("complete", "exact-elimination", len(basis), True, doubled(double, representation))
    algebra = quotient_algebra(elimination, basis) if basis else None
    powers = partial(powers_modulo, representation, certificate.metric, elimination.places)
    v = multiplicity_polynomial(algebra, representation, powers, len(elimination.places)) if algebra else None
    if v is None:
        line = f"elimination: it leaves {len(basis)} monomials, the solutions are not proved to fill them"
        raise Refusal("rejected", line)
    has_multiple = v != derivative(primitive_part(representation.h))
    return Proved("complete", "exact-elimination", len(basis), has_multiple, multiplicities(v, representation))


_NOT_REAL = "that one of them is real, and the robot moves, is not proved"


def check_self_motion(certificate: Certificate, representation: Representation) -> Iterator[str]:
    """The witnesses, poses by checks 1 to 5, lie on a set of poses of positive dimension: three arguments."""
    nothing = certificate.boxes is not None or not any(certificate.counts)
    require(nothing, "claim: beside positive dimension, isolated solutions are claimed without boxes")
    alone = certificate.route is None and certificate.elimination is None
    require(alone, "claim: beside positive dimension, completeness is claimed")
    planar = len(certificate.legs) == 3
    freedom = 3 if planar else 6
    rank = rank_of([quantities_form(leg, certificate.metric, planar=planar) for leg in certificate.legs])
    sides = [leg.base for leg in certificate.legs], [leg.platform for leg in certificate.legs]
    turning = max(turning_dimension(joints, planar=planar) for joints in sides)
    if freedom - rank > turning:
        least = f"sets of dimension {freedom - rank} at least"
        yield f"positive dimension: the legs have rank {rank}, complex poses form {least}; {_NOT_REAL}"
    elif turning:
        least = f"sets of dimension {turning} at least by turning about it"
        yield f"positive dimension: joints lie on a line or in a point, complex poses form {least}; {_NOT_REAL}"
    else:
        parallel = legs_are_one_vector(certificate, representation)
        require(parallel, "claim: positive-dimensional-proved is not proved by the witnesses")
        path = "circle" if planar else "sphere"
        what = f"real poses form a {path}; the robot moves with its legs locked"
        yield f"positive dimension: all legs are the same vector, {what}"


def rank_of(rows: Sequence[Sequence[int]]) -> int:
    """The rank over Q."""
    return len(echelon_form([{(-place,): value for place, value in enumerate(row)} for row in rows]))


def quantities_form(leg: Leg, g: Metric, *, planar: bool) -> list[int]:
    """L on the 17 quantities; of a planar robot on N (1, r11, r21 / g1, C1, C2, u1, u2, |C|^2)."""
    form = leg_form(leg, g)
    if not planar:
        return form
    constant, r11, r12, r21, r22 = (form[place] for place in (0, 1, 2, 4, 5))
    return [constant, r11 + r22, g[0] * r21 - g[1] * r12, *form[10:12], *form[13:15], form[16]]


def turning_dimension(joints: Sequence[Point], *, planar: bool) -> int:
    """The dimension of the turns that leave all joints where they are."""
    shifts = [[x - y for x, y in zip(joint, joints[0], strict=True)] for joint in joints[1:]]
    spanned = rank_of([cleared(shift) for shift in shifts])
    turns = {0: 1} if planar else {0: 3, 1: 1}
    return turns.get(spanned, 0)


def legs_are_one_vector(certificate: Certificate, representation: Representation) -> bool:
    """Whether h0 divides the entries of N R (B_i - B_1) - N (A_i - A_1)."""
    first, *others = certificate.legs
    forms = []
    for leg in others:
        sides = (leg.platform, first.platform), (leg.base, first.base)
        shift = cleared([x - y for one, other in sides for x, y in zip(one, other, strict=True)])
        forms.append((shift[:3], shift[3:]))
    scale = max(size([*platform, *base]) for platform, base in forms)
    multiples, placed = evaluated(representation, certificate.metric, scale)
    return all(
        multiples.include(combination([*platform, -base[i]], [*placed.rotation[i], placed.norm]))
        for platform, base in forms
        for i in range(3)
    )


# ---------------------------------------------------------------------------------------------------------------------
# Check 11: boxes with one solution each, by the operator of Krawczyk
# ---------------------------------------------------------------------------------------------------------------------


@dataclass(frozen=True)
class System:
    """n equations in n Study coordinates: x^T Q x = 0, where ``forms`` are the matrices 2 Q, and chart.x = 1.

    ``norm`` has the coefficients of 2 N(e), a sum of squares.
    """

    places: tuple[int, ...]
    forms: list[list[list[int]]]
    chart: list[int]
    norm: list[int]

    def restricted(self, box: Box) -> Box:
        """The box in the coordinates of the system."""
        kept = self.places
        return replace(box, centre=tuple(box.centre[i] for i in kept), radius=tuple(box.radius[i] for i in kept))

    def slopes(self, x: Sequence[Gaussian]) -> list[list[Gaussian]]:
        """F'(x)."""
        bits = max((most_bits(row) for form in self.forms for row in form), default=0)
        spend(4 * len(x) ** 3 * fraction_cost(bits_of(x) + bits, bits))
        rows = [[dot(row, x) for row in form] for form in self.forms]
        return [*rows, [weight * UNIT for weight in self.chart]]

    def bends(self, _x: Sequence[Gaussian], reach: Sequence[Fraction]) -> list[list[Fraction]]:
        """Bounds of |F'(x + h) - F'(x)| for all |h_l| up to the reach."""
        bends = [
            [sum((abs(v) * h for v, h in zip(row, reach, strict=True)), Fraction(0)) for row in form]
            for form in self.forms
        ]
        return [*bends, [Fraction(0)] * len(reach)]

    def values(self, x: Sequence[Gaussian], slopes: Sequence[Sequence[Gaussian]]) -> list[Gaussian]:
        """F(x), as quadratic forms are half of x^T (2 Q) x."""
        spend(8 * len(x) ** 2 * fraction_cost(bits_of(x), max(map(bits_of, slopes))))
        products = [total(a * b for a, b in zip(row, x, strict=True)) for row in slopes]
        return [*(Fraction(1, 2) * value for value in products[:-1]), products[-1] - UNIT]


def bits_of(values: Iterable[Gaussian]) -> int:
    """The length of the longest numerator or denominator."""
    parts = (part for value in values for part in (value.re, value.im))
    return max((max(part.numerator.bit_length(), part.denominator.bit_length()) for part in parts), default=0)


def total(values: Iterable[Gaussian]) -> Gaussian:
    """The sum."""
    result = NULL
    for value in values:
        result = result + value
    return result


def dot(scalars: Sequence[int], x: Sequence[Gaussian]) -> Gaussian:
    """The combination."""
    return total(scalar * value for scalar, value in zip(scalars, x, strict=True) if scalar)


def chart_system(legs: Sequence[Leg], g: Metric, chart: Sequence[int]) -> System:
    """Legs, Study's condition and chart."""
    planar = len(legs) == 3
    places = (0, 3, 5, 6) if planar else tuple(range(8))
    return study_system(places, [leg_form(leg, g) for leg in legs], g, chart, is_bound=not planar)


def study_system(
    places: tuple[int, ...], forms: Iterable[Sequence[int]], g: Metric, chart: Sequence[int], *, is_bound: bool
) -> System:
    """Forms in the 17 quantities, Study's condition if coordinates are bound by it, and chart."""
    matrix = matrices(places, g)
    rows = [matrix(partial(form_value, form)) for form in forms]
    if is_bound:
        rows.append(matrix(lambda placed: placed.study))
    norm = matrix(lambda placed: placed.norm)
    weights = [chart[place] if place < 4 else 0 for place in places]
    return System(places, rows, weights, [row[i] for i, row in enumerate(norm)])


def matrices(places: tuple[int, ...], g: Metric) -> Callable[[Callable[[Motion], int]], list[list[int]]]:
    """What gives the matrix 2 Q of a quadratic form in these coordinates: by its values at sums of two unit vectors."""

    def at(*indices: int) -> Motion:
        x = [indices.count(place) for place in range(8)]
        return motion(x[:4], x[4:], g)

    single = [at(i) for i in places]
    double = [[at(i, j) for j in places] for i in places]

    def matrix(value: Callable[[Motion], int]) -> list[list[int]]:
        alone = [value(placed) for placed in single]
        return [[value(double[i][j]) - alone[i] - alone[j] for j in range(len(places))] for i in range(len(places))]

    return matrix


def form_value(form: Sequence[int], placed: Motion) -> int:
    """A form in the 17 quantities at a motion over Z."""
    return int(combination(form, placed.quantities()))


def has_one_solution(system: System, box: Box, p: int) -> bool:
    """Whether Krawczyk's operator proves that the box holds exactly one zero of F, a regular one, and no zero of N.

    Let m be the centre, r the radii, Y any matrix, z = 1 - Y F'(m), and |z| = |Re z| + |Im z|. For x = m + h in the box

        x - Y F(x) - m = -Y F(m) + (z - Y F''(h, .) / 2) h,

    and derivatives of x - Y F(x) differ from z by Y F''(h, .). So if for each i

        |Y F(m)|_i + sum_j (|z|_ij + sum_k |Y|_ik sum_l |F''|_kjl |h_l|) r_j < r_i,

    where |h_l| is at most r_l in a real box and 2 r_l in another, and |Y F(m)| is the larger one of real and imaginary
    part, then x -> x - Y F(x) maps the box into its interior and contracts it, in the norm max (|Re x_i|, |Im x_i|) /
    r_i: there is one fixed point. As Y F' is within less than 1 of the unit matrix, Y and F' are regular, so it is a
    zero of F. The numbers are rational; none is rounded.
    """
    slopes = system.slopes(box.centre)
    y = near_inverse(slopes, p)
    spend(16 * len(y) ** 3 * fraction_cost(max(map(bits_of, y)), max(map(bits_of, slopes)) + bits_of(box.centre)))
    reach = [(1 if box.real else 2) * r for r in box.radius]
    bends = system.bends(box.centre, reach)
    values = system.values(box.centre, slopes)
    for i, row in enumerate(y):
        image = total(a * b for a, b in zip(row, values, strict=True)).largest()
        for j, r in enumerate(box.radius):
            z = (UNIT if i == j else NULL) - total(a * line[j] for a, line in zip(row, slopes, strict=True))
            bend = sum((a.size() * line[j] for a, line in zip(row, bends, strict=True)), Fraction(0))
            image += (z.size() + bend) * r
        if image >= box.radius[i]:
            return False
    return norm_is_not_zero(system, box)


def norm_is_not_zero(system: System, box: Box) -> bool:
    """Whether N(e) is not 0 in the box: real and imaginary part of N(m + h) - N(m) are bounded.

    Those of 2 m h by 2 |m| r, as those of h are by r; those of h^2 by r^2 and, if h is not real, 2 r^2.
    """
    value, change = NULL, Fraction(0)
    for g, m, r in zip(system.norm, box.centre, box.radius, strict=True):
        value = value + g * (m * m)
        change += g * (2 * m.size() + (1 if box.real else 2) * r) * r
    return value.largest() > change


def near_inverse(matrix: Sequence[Sequence[Gaussian]], p: int) -> list[list[Gaussian]]:
    """A matrix near the inverse, by elimination in units of 2^-p, rounded; zeros, which prove nothing, without one.

    Rows are first brought to about the size of 1, whatever numbers the equations have: scales are powers of 2.
    """
    nothing = [[NULL] * len(matrix) for _ in matrix]
    n, rows, scales = len(matrix), [], []
    for i, row in enumerate(matrix):
        largest = max(entry.size() for entry in row)
        scales.append(Fraction(2) ** (largest.denominator.bit_length() - largest.numerator.bit_length()))
        scale = scales[-1] * (1 << p)
        unit = [(int(i == j) << p, 0) for j in range(n)]
        rows.append([*((int(scale * entry.re), int(scale * entry.im)) for entry in row), *unit])
    for column in range(n):
        bits = max(abs(part).bit_length() for row in rows for entry in row for part in entry)
        spend(8 * n * n * (500 + product_cost(bits, bits)) + 4 * n * division_cost(bits + p, 2 * bits))
        best = max(range(column, n), key=lambda i: abs(rows[i][column][0]) + abs(rows[i][column][1]))
        rows[column], rows[best] = rows[best], rows[column]
        c, d = rows[column][column]
        norm = c * c + d * d
        if not norm:
            return nothing
        rows[column] = [((a * c + b * d << p) // norm, (b * c - a * d << p) // norm) for a, b in rows[column]]
        for i in range(n):
            c, d = rows[i][column]
            if i != column:
                pairs = zip(rows[i], rows[column], strict=True)
                rows[i] = [(a - (c * x - d * y >> p), b - (c * y + d * x >> p)) for (a, b), (x, y) in pairs]
    return [
        [Gaussian(scale * a / (1 << p), scale * b / (1 << p)) for scale, (a, b) in zip(scales, row[n:], strict=True)]
        for row in rows
    ]


def narrowed(system: System, box: Box, p: int) -> Box | None:
    """A box of radius 2^-p with one solution, inside a box that has one: the same. None if Newton's method fails."""
    x, precisions = box.centre, [2 * p + 64] * 3
    while precisions[0] > 2 * box.bits + 64:
        precisions.insert(0, precisions[0] // 2 + 32)
    for precision in precisions:
        slopes = system.slopes(x)
        y = near_inverse(slopes, precision)
        values = system.values(x, slopes)
        spend(10 * len(y) ** 2 * fraction_cost(max(map(bits_of, y)), bits_of(values)))
        steps = [total(a * b for a, b in zip(row, values, strict=True)) for row in y]
        x = tuple((a - step).rounded(min(precision, p + 4)) for a, step in zip(x, steps, strict=True))
    finer = Box(x, (Fraction(1, 1 << p),) * len(x), p, real=box.real)
    return finer if box.holds(finer) and has_one_solution(system, finer, 2 * p + 64) else None


def is_nearest(system: System, box: Box) -> bool:
    """Whether the solution is within 1/2 + 2^-20 units of the centre, a unit being a quarter of the radius."""
    limits = [r / 4 * (Fraction(1, 2) + Fraction(1, 1 << 20)) for r in box.radius]
    for p in doublings(min(box.radius).denominator.bit_length() + 40):
        finer = narrowed(system, box, p)
        if finer is not None:
            gaps = [(a - b).largest() for a, b in zip(finer.centre, box.centre, strict=True)]
            if all(gap + r <= limit for gap, r, limit in zip(gaps, finer.radius, limits, strict=True)):
                return True
            if any(gap - r > limit for gap, r, limit in zip(gaps, finer.radius, limits, strict=True)):
                return False
    return False


def doublings(p: int) -> Iterator[int]:
    """Precisions to try, as how many bits are lost depends on the robot: each twice the one before."""
    yield p
    while 2 * p <= MAX_PRECISION:
        p *= 2
        yield p


def check_pairs(others: Sequence[Box]) -> None:
    """Complex boxes hold no real solution; the first imaginary part that is not 0 is positive; centres are in order."""
    for number, box in enumerate(others, 1):
        require(box.is_disjoint(box.conjugate()), f"boxes: complex box {number} meets its conjugate")
        first = next((m.im for m in box.centre if m.im), Fraction(0))
        require(first > 0, f"boxes: complex box {number} is not the one of its pair that is listed")
    keys = [[part for m in box.centre for part in (m.re, m.im)] for box in others]
    require(keys == sorted(keys), "boxes: the complex ones are not listed in their order")


def check_boxes(system: System, boxes: Boxes) -> Iterator[str]:
    """Check 11: each box holds one solution, and boxes and conjugates are disjoint."""
    flat = not any(weight for place, weight in enumerate(boxes.w) if place not in system.places)
    require(flat, "boxes: the chart has a weight for a coordinate that is 0 for every pose")
    named = [(f"real box {number}", box) for number, box in enumerate(boxes.real, 1)]
    named += [(f"complex box {number}", box) for number, box in enumerate(boxes.others, 1)]
    for name, box in named:
        flat = all(m == NULL for place, m in enumerate(box.centre) if place not in system.places)
        require(flat, f"boxes: {name} leaves the plane of the robot")
        inner = system.restricted(box)
        proved = any(has_one_solution(system, inner, p) for p in doublings(2 * box.bits + 64))
        require(proved, f"boxes: not proved that {name} holds exactly one solution")
        nearest = is_nearest(system, inner)
        require(nearest, f"boxes: the centre of {name} is not the grid point nearest to the solution")
    yield f"boxes: each of {len(named)} holds exactly one solution, simple, and N(e) is not 0 there"
    most = max((box.bits + box.radius[0].denominator.bit_length() for _, box in named), default=0)
    spend(40 * len(named) ** 2 * fraction_cost(most, most))
    check_pairs(boxes.others)
    for (name, one), (other_name, other) in combinations(named, 2):
        apart = one.is_disjoint(other) and one.is_disjoint(other.conjugate())
        require(apart, f"boxes: {name} and {other_name} meet")
    number = boxes.number()
    yield f"boxes: pairwise disjoint, {number} solutions with conjugate ones, {len(boxes.real)} of them real"


def check_poses_in_boxes(certificate: Certificate, boxes: Boxes, system: System) -> Iterator[str]:
    """Check 6 for poses from real boxes around solutions, which check 11 has proved."""
    listed = len(certificate.poses)
    require(listed == len(boxes.real), f"real poses: {listed} listed, there are {len(boxes.real)} real boxes")
    without = all(pose.parameter is None for pose in certificate.poses)
    require(without, "real poses: a parameter is given, but there is no eliminant")
    yield f"real poses: {listed}, one in each real box"
    enclosures = [partial(at_solution, system, certificate.metric, system.restricted(box)) for box in boxes.real]
    found = [cells_of(enclose, certificate.box_exponent) for enclose in enclosures]
    in_order = all(one[:12] < other[:12] for one, other in pairwise(found))
    require(in_order, "real poses: not listed in the order of their boxes")
    yield from check_cells(certificate, found)


def at_solution(system: System, g: Metric, box: Box, p: int) -> list[Interval] | None:
    """Enclosures of the coordinates of the pose in a box."""
    finer = narrowed(system, box, p)
    if finer is None:
        return None
    x: dict[int, Interval] = {}
    for place, m, r in zip(system.places, finer.centre, finer.radius, strict=True):
        low, high = (m.re - r) * (1 << p), (m.re + r) * (1 << p)
        x[place] = Interval(low.__floor__(), high.__ceil__(), p)
    nothing = 0 * x[system.places[0]]
    return ordinary([x.get(place, nothing) for place in range(8)], g, p)


def boxes_listed(certificate: Certificate, boxes: Boxes) -> Iterator[str]:
    """The claims and counts beside boxes that were proved to hold one solution each."""
    number, (total, distinct, _) = boxes.number(), certificate.counts
    same = total == distinct == number
    require(same, f"complex solutions: {total}, {distinct} distinct claimed, {number} proved")
    for place, pose in enumerate(certificate.poses, 1):
        require(pose.multiplicity == 1, f"multiplicity: that of pose {place} differs from what is proved")
    claim = certificate.claim, certificate.route
    degree = PLANAR_NUMBER if len(certificate.legs) == 3 else GREATEST_NUMBER
    if certificate.method == "exact":
        fewer = number < degree
        require(fewer, f"claim: {certificate.claim}, but {degree} isolated solutions are all that there are")
        yield f"isolated: {number} solutions, {len(boxes.real)} of them real, lie on no curve of poses"
        if certificate.claim == "positive-dimensional-proved" and certificate.representation is not None:
            yield from check_self_motion(certificate, certificate.representation)
            return
        alone = certificate.representation is None and certificate.elimination is None
        detected = alone and claim == ("positive-dimensional-detected", None)
        require(detected, f"claim: {certificate.claim} is not proved by what is in the certificate")
        yield "positive dimension detected: evidence found by the solver, no proof"
        return
    proved = ("complete", "refined-bezout") if number == degree else ("not-proven-complete", None)
    require(claim == proved, f"claim: what is proved is {proved[0]} by {proved[1] or 'no route'}")
    if number == degree:
        yield f"complete: {degree} isolated solutions are the degree of the motions, there is no other"
    else:
        yield f"not proven complete: {number} solutions are proved, others are not excluded"


# ---------------------------------------------------------------------------------------------------------------------
# Tolerance certificates
# ---------------------------------------------------------------------------------------------------------------------

SHRINKINGS: Final = 8
"""Times that a box of all robots is replaced by what may hold its solutions."""
TOLERANCE_FORMAT: Final = "pkm_exact tolerance certificate"
TOLERANCE_KEYS: Final = "format version robot configuration tolerances frames exponent boxes unproved pairs complete"
MAX_TOLERANCE_GRID: Final = 4096
MAX_CENTRE_BITS: Final = 256  # before the point
MAX_WEIGHT: Final = 10**6
GUARD: Final = 128  # bits beyond the grid and half of it: Y is at most 2^(k/2) where a core is proved
ROUGHLY: Final = 64  # first bits of a number that serve for a bound
ORDINARY: Final = (1, 1, 1)


@dataclass(frozen=True)
class Place:
    """Where a solution is: w, real and imaginary part each; centre and half widths in units of the grid."""

    chart: tuple[tuple[int, int], ...]
    centre: tuple[tuple[int, int], ...]
    outer: tuple[int, ...]

    def is_real(self) -> bool:
        """Whether chart and centre are."""
        return not any(imaginary for _, imaginary in (*self.chart, *self.centre))


@dataclass(frozen=True)
class PoseBox:
    """The box of a real pose; ``bounds`` are of position, rotation by rows, quaternion and centroid."""

    pose: int
    place: Place
    inner: tuple[int, ...]
    bounds: tuple[tuple[Fraction, Fraction], ...]
    position_error: Fraction
    rotation_error: Fraction


@dataclass(frozen=True)
class ToleranceCertificate:
    """What a tolerance certificate says; tolerances of base joints, platform joints and lengths."""

    metric: Metric
    legs: tuple[Leg, ...]
    tolerances: tuple[Fraction, ...]
    origins: tuple[Point, Point]
    unit: Fraction
    exponent: int
    boxes: tuple[PoseBox, ...]
    unproved: tuple[int, ...]
    pairs: tuple[Place, ...]
    complete: bool

    @property
    def degree(self) -> int:
        """That of the motions."""
        return PLANAR_NUMBER if len(self.legs) == 3 else GREATEST_NUMBER


def read_tolerances(body: dict[str, Any]) -> ToleranceCertificate:
    """The content of a tolerance certificate."""
    version = body.get("version")
    well_formed(type(version) is int and version == 1, f"format: not a {TOLERANCE_FORMAT}, version 1")
    values = dict(zip(TOLERANCE_KEYS.split(), an_object(body, "certificate", TOLERANCE_KEYS), strict=True))
    metric, base, platform = a_robot(values["robot"], "robot")
    squares = a_configuration(values["configuration"], len(base))
    limits = an_object(values["tolerances"], "tolerances", "base platform lengths")
    tolerances = a_list(a_rational, 3)(limits, "tolerances")
    well_formed(min(tolerances) >= 0, "tolerances: negative")
    first, second, unit = an_object(values["frames"], "frames", "base platform unit")
    origins = a_list(a_rational, 3)(first, "frames.base"), a_list(a_rational, 3)(second, "frames.platform")
    well_formed(type(values["complete"]) is bool, "complete: neither true nor false")
    exponent = a_number(values["exponent"], "exponent")
    affordable(exponent <= MAX_TOLERANCE_GRID, f"exponent: more than {MAX_TOLERANCE_GRID}")
    planar = len(base) == 3
    flat = not planar or not any(origin[2] for origin in origins)
    well_formed(flat, "frames: an origin of a planar robot has a third coordinate other than 0")
    degree = PLANAR_NUMBER if planar else GREATEST_NUMBER
    for key in ("boxes", "pairs", "unproved"):
        short = not isinstance(values[key], list) or len(values[key]) <= degree
        well_formed(short, f"{key}: more than {degree}")
    size = 4 if planar else 8
    certificate = ToleranceCertificate(
        metric=metric,
        legs=tuple(map(Leg, base, platform, squares)),
        tolerances=tolerances,
        origins=origins,
        unit=a_positive_rational(unit, "frames.unit"),
        exponent=exponent,
        boxes=a_list(partial(a_pose_box, size=size))(values["boxes"], "boxes"),
        unproved=a_list(a_number)(values["unproved"], "unproved"),
        pairs=a_list(partial(a_pair, size=size))(values["pairs"], "pairs"),
        complete=values["complete"],
    )
    places = [*(box.place for box in certificate.boxes), *certificate.pairs]
    bits = max((abs(part).bit_length() for place in places for pair in place.centre for part in pair), default=0)
    affordable(bits <= exponent + MAX_CENTRE_BITS, f"centre: a coordinate of more than 2^{MAX_CENTRE_BITS}")
    flat = not planar or not any(any(place.chart[1] + place.chart[2]) for place in places)
    well_formed(flat, "chart: a weight for a coordinate that is 0 for every pose of a planar robot")
    return certificate


def a_pose_box(value: Any, where: str, *, size: int) -> PoseBox:
    """The box of a pose with its bounds."""
    keys = "pose chart centre outer inner position rotation quaternion centroid position_error rotation_error"
    pose, chart, centre, outer, inner, *bounds, distance, angle = an_object(value, where, keys)
    position, rotation, quaternion, centroid = bounds
    return PoseBox(
        pose=a_number(pose, f"{where}.pose"),
        place=a_place((chart, centre, outer), where, size),
        inner=a_list(a_width, size)(inner, f"{where}.inner"),
        bounds=(
            *a_list(some_bounds, 3)(position, f"{where}.position"),
            *(entry for row in a_list(a_list(some_bounds, 3), 3)(rotation, f"{where}.rotation") for entry in row),
            *a_list(some_bounds, 4)(quaternion, f"{where}.quaternion"),
            *a_list(some_bounds, 3)(centroid, f"{where}.centroid"),
        ),
        position_error=a_positive_rational(distance, f"{where}.position_error"),
        rotation_error=a_positive_rational(angle, f"{where}.rotation_error"),
    )


def a_pair(value: Any, where: str, *, size: int) -> Place:
    """Where one of two conjugate solutions is."""
    return a_place(an_object(value, where, "chart centre outer"), where, size)


def a_place(values: Sequence[Any], where: str, size: int) -> Place:
    """Chart, centre and half widths."""
    chart, centre, outer = values
    return Place(
        a_list(a_list(a_weight, 2), 4)(chart, f"{where}.chart"),
        a_list(a_list(a_grid_number, 2), size)(centre, f"{where}.centre"),
        a_list(a_width, size)(outer, f"{where}.outer"),
    )


def a_weight(value: Any, where: str) -> int:
    """A small integer."""
    number = an_integer(value, where)
    affordable(abs(number) <= MAX_WEIGHT, f"{where}: more than {MAX_WEIGHT}")
    return number


def a_grid_number(value: Any, where: str) -> int:
    """An integer in units of the grid."""
    number = a_hexadecimal(value, where)
    short = number.bit_length() <= 2 * MAX_TOLERANCE_GRID
    affordable(short, f"{where}: more than {2 * MAX_TOLERANCE_GRID} bits")
    return number


def a_width(value: Any, where: str) -> int:
    """A positive integer in units of the grid."""
    number = a_grid_number(value, where)
    well_formed(number > 0, f"{where}: not positive")
    return number


def some_bounds(value: Any, where: str) -> tuple[Fraction, Fraction]:
    """A lower and an upper bound."""
    low, high = a_list(a_rational, 2)(value, where)
    well_formed(low <= high, f"{where}: ends out of order")
    return low, high


class Rectangle:
    """Complex numbers with real and imaginary parts in intervals."""

    __slots__ = ("im", "re")

    def __init__(self, re: Interval, im: Interval) -> None:
        self.re = re
        self.im = im

    def __add__(self, other: Rectangle) -> Rectangle:
        return Rectangle(self.re + other.re, self.im + other.im)

    def __sub__(self, other: Rectangle) -> Rectangle:
        return Rectangle(self.re - other.re, self.im - other.im)

    def __rmul__(self, scalar: int) -> Rectangle:
        return Rectangle(scalar * self.re, scalar * self.im)

    def __mul__(self, other: Rectangle) -> Rectangle:
        return Rectangle(self.re * other.re - self.im * other.im, self.re * other.im + self.im * other.re)

    def scaled(self, factor: Interval) -> Rectangle:
        """The product with real numbers."""
        return Rectangle(factor * self.re, factor * self.im)

    def contains_zero(self) -> bool:
        """Whether 0 is in the rectangle."""
        return self.re.contains_zero() and self.im.contains_zero()

    def largest(self) -> int:
        """More than the largest absolute value, times 2^p: its first 64 bits, rounded up."""
        re, im = self.re.largest(), self.im.largest()
        value = isqrt(re * re + im * im)
        shift = further_bits(value)
        return (value >> shift) + 1 << shift

    def conjugate(self) -> Rectangle:
        """The conjugate numbers."""
        return Rectangle(self.re, -1 * self.im)


def further_bits(value: int) -> int:
    """The number of bits behind the first 64."""
    return (value >> ROUGHLY).bit_length()


def surrounding(value: Fraction, p: int) -> Interval:
    """The narrowest interval around a rational number."""
    spend(1000 + 2 * division_cost(p + value.numerator.bit_length(), value.denominator.bit_length()))
    shifted = value.numerator << p
    return Interval(shifted // value.denominator, -(-shifted // value.denominator), p)


def summed(terms: Iterable[Any], zero: Any) -> Any:
    """The sum of intervals or rectangles."""
    result = zero
    for term in terms:
        result = result + term
    return result


class Family:
    """All robots within tolerance, in new frames and units, enclosed to p bits; and the equations of their poses.

    The data of a leg are A, B, l and differ by at most ``errors`` from ``joints`` and ``lengths``. The unknowns x are
    those of (e, f) that are not 0 for every pose. ``polar[k][i]`` are the j and v of v x_j in the i-th derivative of
    the k-th quantity: N, R, C, R^-1 C, |C|^2, e.f.
    """

    def __init__(self, certificate: ToleranceCertificate, p: int) -> None:
        self.p = p
        self.planar = len(certificate.legs) == 3
        self.axes = range(2 if self.planar else 3)
        self.places = (0, 3, 5, 6) if self.planar else tuple(range(8))
        unit, (base, platform) = certificate.unit, certificate.origins
        scales = [Interval(g << p, g << p, p).root() for g in certificate.metric]

        def joint(point: Point, origin: Point) -> list[Interval]:
            shifts = [(x - m) / unit for x, m in zip(point, origin, strict=True)]
            return [s * surrounding(x, p) for s, x in zip(scales, shifts, strict=True)]

        self.zero = Interval(0, 0, p)
        self.one = Interval(1 << p, 1 << p, p)
        self.base = [joint(leg.base, base) for leg in certificate.legs]
        self.platform = [joint(leg.platform, platform) for leg in certificate.legs]
        self.lengths = [surrounding(leg.length_squared / unit**2, p).root() for leg in certificate.legs]
        highest = [surrounding(t / unit, p).high for t in certificate.tolerances]
        self.errors = [Interval(-high, high, p) for high in highest]
        self.unit, self.per_unit = surrounding(unit, p), surrounding(1 / unit, p)
        self.origins = [[s * surrounding(x, p) for s, x in zip(scales, o, strict=True)] for o in (base, platform)]
        self.polar = polar_forms(self.places)

    def rectangle(self, pair: tuple[int, int], exponent: int) -> Rectangle:
        """A number of the grid, exactly."""
        re, im = (part << (self.p - exponent) for part in pair)
        return Rectangle(Interval(re, re, self.p), Interval(im, im, self.p))

    def spread(self, widths: Sequence[int], exponent: int, *, real: bool) -> list[Rectangle]:
        """The box around 0 with these half widths in units of the grid."""
        ends = [width << (self.p - exponent) for width in widths]
        sides = [Interval(-end, end, self.p) for end in ends]
        return [Rectangle(side, self.zero if real else side) for side in sides]

    def quantities(self, x: Sequence[Any], zero: Any) -> list[Any]:
        """The quantities at x."""
        full = [zero] * 8
        for place, value in zip(self.places, x, strict=True):
            full[place] = value
        placed = motion(full[:4], full[4:], ORDINARY)
        return [*placed.quantities(), placed.study]

    def slopes(self, x: Sequence[Any], zero: Any) -> list[list[Any]]:
        """The derivatives of the quantities at x."""
        return [[summed((v * x[j] for j, v in terms), zero) for terms in form] for form in self.polar]

    def forms(self) -> list[list[Interval]]:
        """Study's condition, unless planar, and the legs of the nominal robot as rows of coefficients."""
        rows = [] if self.planar else [[*[self.zero] * 17, self.one]]
        for a, b, length in zip(self.base, self.platform, self.lengths, strict=True):
            squares = summed((x * x for x in (*a, *b)), self.zero) - length * length
            twice = [-2 * x for x in a]
            rows.append([squares, *(x * y for x in twice for y in b), *twice, *(2 * x for x in b), self.one, self.zero])
        return rows

    def quadric(self, form: Sequence[Interval]) -> list[list[Interval]]:
        """The derivatives of those of a form in the quantities: a symmetric matrix."""
        found = [[self.zero] * len(self.places) for _ in self.places]
        for c, rows in zip(form, self.polar, strict=True):
            if c.largest():
                for i, terms in enumerate(rows):
                    for j, v in terms:
                        found[i][j] = found[i][j] + v * c
        return found

    def leg_changes(self, at: Sequence[Rectangle]) -> list[Rectangle]:
        """E_i = N (2 d.(R b - a) - 2 l t + |R b - a|^2 - t^2), from the quantities at a point.

        d = C + R B - A, and d.(R b) = (R^-1 d).b with R^-1 d = R^-1 C + B - R^-1 A. It is linear in the quantities:
        their derivatives give its derivatives.
        """
        da, db, dl = self.errors
        norm, position, turned = at[0], at[10:13], at[13:16]
        r = [at[1 + 3 * i : 4 + 3 * i] for i in range(3)]
        nothing = Rectangle(self.zero, self.zero)
        square = summed((norm.scaled(da * da + db * db) for _ in self.axes), nothing)
        square = square - summed((r[j][k].scaled(2 * (da * db)) for j in self.axes for k in self.axes), nothing)
        square = square - norm.scaled(dl * dl)
        changes = []
        for a, b, length in zip(self.base, self.platform, self.lengths, strict=True):
            change = square - norm.scaled(2 * (length * dl))
            for j in self.axes:
                along = summed((r[j][k].scaled(b[k]) for k in range(3)), position[j] - norm.scaled(a[j]))
                back = turned[j] + norm.scaled(b[j]) - summed((r[k][j].scaled(a[k]) for k in range(3)), nothing)
                change = change + back.scaled(2 * db) - along.scaled(2 * da)
            changes.append(change)
        return changes


def polar_forms(places: Sequence[int]) -> list[list[list[tuple[int, int]]]]:
    """The matrices 2 M_k of the quantities x^T M_k x, from their values at sums of unit vectors; zeros left out."""

    def values(*indices: int) -> list[int]:
        x = [indices.count(place) for place in range(8)]
        placed = motion(x[:4], x[4:], ORDINARY)
        return [*placed.quantities(), placed.study]

    single = {i: values(i) for i in places}
    double = {(i, j): values(i, j) for i in places for j in places}
    return [
        [[(n, v) for n, j in enumerate(places) if (v := double[i, j][k] - single[i][k] - single[j][k])] for i in places]
        for k in range(18)
    ]


class Neighbourhood:
    """The equations F of a family around a centre m: Y, F(m), and the changes E_i of the legs at m.

    ``slope`` is Y F'(m) of the nominal robot; ``curvature[a][b]`` are the derivatives of the entry (a, b) of Y F'.
    """

    def __init__(self, family: Family, place: Place, exponent: int) -> None:
        self.family = family
        self.exponent = exponent
        self.real = place.is_real()
        self.nothing = Rectangle(family.zero, family.zero)
        weights = [pair for axis, pair in enumerate(place.chart) if not family.planar or axis in (0, 3)]
        one = Rectangle(family.one, family.zero)
        self.weights = [family.rectangle(pair, 0) for pair in weights]
        self.centre = [family.rectangle(pair, exponent) for pair in place.centre]
        forms, jacobian = family.forms(), self.jacobian()
        inverse = near_inverse([[midpoint(entry) for entry in row] for row in jacobian], family.p)
        self.inverse = [[exact_rectangle(entry, family.p) for entry in row] for row in inverse]
        quantities = family.quantities(self.centre, self.nothing)
        self.residual = [self.form_value(row, quantities) for row in forms]
        self.residual.append(self.chart_value() - one)
        self.changes = family.leg_changes(quantities)
        columns = list(zip(*jacobian, strict=True))
        self.slope = [[inner_product(row, column) for column in columns] for row in self.inverse]
        quadrics = [family.quadric(form) for form in forms]
        places = range(len(columns))
        self.curvature = [
            [[self.weighted(row, [q[b][j] for q in quadrics]) for j in places] for b in places] for row in self.inverse
        ]

    def weighted(self, row: Sequence[Rectangle], values: Sequence[Interval]) -> Rectangle:
        """The sum of a row of Y times values of all equations but the last; zeros are left out."""
        terms = (y.scaled(v) for y, v in zip(row, values, strict=False) if v.largest())
        return summed(terms, self.nothing)  # type: ignore[no-any-return]

    def on_legs(self, changes: Sequence[Rectangle]) -> list[Rectangle]:
        """Values for all equations: 0 for Study's condition and the chart."""
        before = [] if self.family.planar else [self.nothing]
        return [*before, *changes, self.nothing]

    def chart_value(self) -> Rectangle:
        """w.e at the centre."""
        pairs = zip(self.weights, self.centre, strict=False)
        return summed((w * x for w, x in pairs), self.nothing)  # type: ignore[no-any-return]

    def form_value(self, form: Sequence[Interval], values: Sequence[Rectangle]) -> Rectangle:
        """A form in the quantities; zeros are left out."""
        terms = (v.scaled(c) for c, v in zip(form, values, strict=True) if c.largest())
        return summed(terms, self.nothing)  # type: ignore[no-any-return]

    def jacobian(self) -> list[list[Rectangle]]:
        """F'(m) of the nominal robot."""
        slopes = list(zip(*self.family.slopes(self.centre, self.nothing), strict=True))
        rows = [[self.form_value(form, c) for c in slopes] for form in self.family.forms()]
        return [*rows, [*self.weights, *[self.nothing] * (len(self.centre) - len(self.weights))]]

    def around(self, widths: Sequence[int]) -> list[Rectangle]:
        """The box around the centre."""
        spread = self.family.spread(widths, self.exponent, real=self.real)
        return [m + side for m, side in zip(self.centre, spread, strict=True)]

    def defect(self, widths: Sequence[int], *, uncertain: bool, half: bool = False) -> list[list[Rectangle]]:
        """1 - Y F' on a box, or on the box of half the size."""
        family = self.family
        spread = family.spread(widths, self.exponent + half, real=self.real)
        one = Rectangle(family.one, family.zero)
        found = [
            [
                (one if a == b else self.nothing) - at - inner_product(derivatives, spread)
                for b, (at, derivatives) in enumerate(zip(*rows, strict=True))
            ]
            for a, rows in enumerate(zip(self.slope, self.curvature, strict=True))
        ]
        if not uncertain:
            return found
        slopes = family.slopes([m + side for m, side in zip(self.centre, spread, strict=True)], self.nothing)
        columns = [self.on_legs(family.leg_changes(column)) for column in zip(*slopes, strict=True)]
        return [
            [entry - inner_product(y, column) for entry, column in zip(row, columns, strict=True)]
            for row, y in zip(found, self.inverse, strict=True)
        ]

    def contracts(self, widths: Sequence[int], *, uncertain: bool) -> bool:
        """Whether Krawczyk's operator maps the box into its interior, for the nominal robot; N(e) not being 0 there.

        Or, if ``uncertain``, whether x -> x - Y F(x) does so for all robots: F(x) - F(m) = F'((x + m) / 2) (x - m).
        """
        spread = self.family.spread(widths, self.exponent, real=self.real)
        for image, side in zip(self.image(widths, uncertain=uncertain), spread, strict=True):
            parts = (image.re, side.re), (image.im, side.im)  # those of real boxes are real
            for part, within in parts[:1] if self.real else parts:
                if not (within.low < part.low and part.high < within.high):
                    return False
        return self.has_poses(widths)

    def image(self, widths: Sequence[int], *, uncertain: bool) -> list[Rectangle]:
        """Krawczyk's operator on the box, moved to 0; if ``uncertain``, images of x -> x - Y F(x) for all robots."""
        spread = self.family.spread(widths, self.exponent, real=self.real)
        right = self.residual
        if uncertain:
            right = [value + change for value, change in zip(right, self.on_legs(self.changes), strict=True)]
        defect = self.defect(widths, uncertain=uncertain, half=uncertain)
        return [
            inner_product(row, spread) - inner_product(y, right) for row, y in zip(defect, self.inverse, strict=True)
        ]

    def holds_at_most_one(self, widths: Sequence[int]) -> bool:
        """Whether no robot has two solutions in the box, and N(e) is not 0 in it.

        A solution x has x - m = (x - m) - Y F(x): it is in the image of the box too, so that a narrower box holds the
        same solutions, again and again, until F' is regular there.
        """
        if not self.has_poses(widths):
            return False
        for _ in range(SHRINKINGS):
            if self.is_regular(widths):
                return True
            sizes = self.reached(self.image(widths, uncertain=True))
            narrower = [min(pair) for pair in zip(sizes, widths, strict=True)]
            if narrower == list(widths):
                return False
            widths = narrower
        return self.is_regular(widths)

    def has_poses(self, widths: Sequence[int]) -> bool:
        """Whether N(e) is not 0 on the box."""
        return not self.family.quantities(self.around(widths), self.nothing)[0].contains_zero()

    def is_regular(self, widths: Sequence[int]) -> bool:
        """Whether F' is regular all over the box, for all robots; then Y is regular too.

        By v > 0 with |1 - Y F'| v < v: the spectral radius is below 1. The first bits of the v tried are enough.
        """
        p, size = self.family.p, len(widths)
        bounds = [[entry.largest() for entry in row] for row in self.defect(widths, uncertain=True)]
        sums = near_inverse(less_than_one(bounds, p), p)
        exact = [int(sum((entry.re for entry in row), Fraction(0)) * (1 << p)) for row in sums]
        vector = [v >> further_bits(v) << further_bits(v) for v in exact]
        bits = max(map(most_bits, (*bounds, vector)))
        spend(size**2 * (200 + product_cost(bits, bits)))
        images = [sum(b * v for b, v in zip(row, vector, strict=True)) for row in bounds]
        return all(v > 0 and image < v << p for v, image in zip(vector, images, strict=True))

    def is_nearest(self, widths: Sequence[int]) -> bool:
        """Whether the nominal solution, which is in the box, is within 1/2 + 2^-20 units of the grid of the centre.

        x - m = -Y F(m) + (1 - Y F'((x + m) / 2)) (x - m), used again and again; (x + m) / 2 is in the box.
        """
        unit = self.family.p - self.exponent
        limit = (1 << 19) + 1 << unit - 20
        steps = [inner_product(y, self.residual) for y in self.inverse]
        found = self.family.spread(widths, self.exponent, real=self.real)
        for _ in range(8):
            defect = self.defect(widths, uncertain=False)
            for _ in range(2):
                found = [inner_product(row, found) - step for row, step in zip(defect, steps, strict=True)]
                parts = [part for value in found for part in (value.re, value.im)]
                if all(part.largest() < limit for part in parts):
                    return True
            widths = self.reached(found)
        return False

    def reached(self, values: Sequence[Rectangle]) -> list[int]:
        """Half widths of a box around 0 with these values, in units of the grid."""
        unit = self.family.p - self.exponent
        return [(max(v.re.largest(), v.im.largest()) >> unit) + 1 for v in values]

    def motion_in(self, widths: Sequence[int]) -> list[Rectangle]:
        """The quantities on a box, in the new frames."""
        return self.family.quantities(self.around(widths), self.nothing)


def less_than_one(bounds: Sequence[Sequence[int]], p: int) -> list[list[Gaussian]]:
    """1 - B for a matrix in units of 2^-p."""
    return [
        [Gaussian(Fraction((int(i == j) << p) - v, 1 << p), Fraction(0)) for j, v in enumerate(row)]
        for i, row in enumerate(bounds)
    ]


def inner_product(one: Sequence[Any], other: Sequence[Any]) -> Any:
    """The sum of the products."""
    first, *rest = (a * b for a, b in zip(one, other, strict=True))
    return summed(rest, first)


def midpoint(value: Rectangle) -> Gaussian:
    """A number in the middle."""
    return Gaussian(*(Fraction(part.low + part.high, 2 << part.p) for part in (value.re, value.im)))


def exact_rectangle(value: Gaussian, p: int) -> Rectangle:
    """The rectangle of one number with denominator 2^p."""
    return Rectangle(surrounding(value.re, p), surrounding(value.im, p))


def check_tolerances(certificate: ToleranceCertificate) -> Iterator[str]:
    """One line per claim of a tolerance certificate that is proved."""
    labels = [box.pose for box in certificate.boxes]
    in_order = labels == sorted(labels) and list(certificate.unproved) == sorted(certificate.unproved)
    every = sorted([*labels, *certificate.unproved]) == list(range(1, len(labels) + len(certificate.unproved) + 1))
    require(in_order and every, "boxes: poses are not numbered from 1, each once, in order")
    places = [*(box.place for box in certificate.boxes), *certificate.pairs]
    bits = max((abs(part).bit_length() for place in places for pair in place.centre for part in pair), default=0)
    k = certificate.exponent
    family = Family(certificate, k + k // 2 + GUARD + 2 * max(bits - k, 0))
    core = [1 << (certificate.exponent - certificate.exponent // 2)] * len(family.places)
    cores = []
    for box in certificate.boxes:
        name = f"box of pose {box.pose}"
        at = Neighbourhood(family, box.place, certificate.exponent)
        require(at.real, f"{name}: not real")
        check_place(at, box.place, core, name)
        check_pose_box(at, box, name)
        cores.append(at.motion_in(core))
    for (one, core_of_one), (other, core_of_other) in combinations(zip(labels, cores, strict=True), 2):
        distinct = are_distinct(core_of_one, core_of_other)
        require(distinct, f"boxes: the poses {one} and {other} are not proved distinct")
    yield (
        f"boxes: {len(cores)} poses, in the box of each there is exactly one pose of every robot within tolerance, "
        "its errors are not greater than claimed"
    )
    if certificate.unproved:
        yield f"boxes: for {len(certificate.unproved)} poses nothing is claimed"
    if certificate.complete:
        require(not certificate.unproved, "complete: claimed, though poses are not proved")
        yield check_all_solutions(certificate, family, core, cores)
    else:
        require(not certificate.pairs, "pairs: listed, though completeness is not claimed")
        yield "not proven complete: further poses of robots within tolerance are not excluded"


def are_distinct(one: Sequence[Rectangle], other: Sequence[Rectangle]) -> bool:
    """Whether poses with these quantities q and r differ: N(q) r = N(r) q, entry by entry, for the same pose."""
    return any(not (one[0] * b - other[0] * a).contains_zero() for a, b in zip(one, other, strict=True))


def check_place(at: Neighbourhood, place: Place, core: Sequence[int], name: str) -> None:
    """At most one solution of every robot in the outer box, the nominal one in the core, which lies in it."""
    require(min(place.outer) >= core[0], f"{name}: smaller than the core of the nominal solution")
    nominal = at.contracts(core, uncertain=False)
    require(nominal, f"{name}: not proved to hold a solution of the nominal robot")
    nearest = at.is_nearest(core)
    require(nearest, f"{name}: its centre is not the grid point nearest to the nominal solution")
    single = at.holds_at_most_one(place.outer)
    require(single, f"{name}: not proved to hold at most one solution of every robot within tolerance")


def check_pose_box(at: Neighbourhood, box: PoseBox, name: str) -> None:
    """The bounds of the pose are bounds for every robot, and no other pose satisfies them."""
    family, p = at.family, at.family.p
    inside = all(a <= b for a, b in zip(box.inner, box.place.outer, strict=True))
    require(inside, f"{name}: the inner box is not contained in the outer one")
    holds = at.contracts(box.inner, uncertain=True)
    require(holds, f"{name}: the inner box is not proved to hold a solution of every robot within tolerance")
    inverses = inverse_jacobians(at, box.inner)
    effect = [
        [inner_product(row, column) for column in zip(*inverses, strict=True)]
        for row in components(family, [side.re for side in at.around(box.inner)])[1]
    ]
    legs = range(0 if family.planar else 1, len(family.places) - 1)
    offsets = [inner_product(row, [value.re for value in at.residual]).largest() for row in effect]
    by_leg = [[row[i] for i in legs] for row in effect]
    reaches = [change.re.largest() for change in at.changes]
    values = components(family, [m.re for m in at.centre])[0]
    for value, row, offset, (low, high) in zip(values, by_leg, offsets, box.bounds, strict=True):
        reach = offset - (-sum(entry.largest() * r for entry, r in zip(row, reaches, strict=True)) >> p)
        proved = low <= Fraction(value.low - reach, 1 << p) and Fraction(value.high + reach, 1 << p) <= high
        require(proved, f"{name}: a bound of the pose is not proved")
    check_nothing_else(at, box, name)
    for places, what in (((0, 1, 2), "position"), ((12, 13, 14, 15), "rotation")):
        length = greatest_length([by_leg[k] for k in places], reaches, p) + 2 * sum(offsets[k] for k in places)
        error = Fraction(length, 1 << p)
        is_proved = error <= box.position_error if what == "position" else is_angle_of(box.rotation_error, error, p)
        require(is_proved, f"{name}: its {what} error is not proved")


def inverse_jacobians(at: Neighbourhood, widths: Sequence[int]) -> list[list[Interval]]:
    """Enclosures of the inverses of all matrices in F', real, on half of a box that every robot's operator contracts.

    With M = 1 - Y F' they are V = Y + M Y + M^2 Y + .., and |V - Y| is at most any S for which |M| (|Y| + S) <= S.
    As |M| w < w for the half widths w, that holds for any matrix and a multiple of w in each column, large enough.
    """
    p = at.family.p
    m = [[entry.re.largest() for entry in row] for row in at.defect(widths, uncertain=True, half=True)]
    y = [[entry.re for entry in row] for row in at.inverse]
    bits = p + most_bits(chain(*m))
    spend(4 * len(m) ** 3 * (200 + product_cost(bits, 2 * bits)) + 8 * len(m) ** 2 * fraction_cost(bits, 2 * bits))
    rooms = [(w << p) - sum(a * v for a, v in zip(row, widths, strict=True)) for row, w in zip(m, widths, strict=True)]
    powers = [[entry.re for entry in row] for row in near_inverse(less_than_one(m, p), p)]
    found = []
    for column in zip(*y, strict=True):
        sizes = [entry.largest() for entry in column]
        first = [sum(a * v for a, v in zip(row, sizes, strict=True)) >> p for row in m]
        exact = [int(sum(a * v for a, v in zip(row, first, strict=True))) for row in powers]
        near = [v >> further_bits(v) << further_bits(v) for v in exact]
        wholes = [v + s for v, s in zip(sizes, near, strict=True)]
        lacks = [
            sum(a * v for a, v in zip(row, wholes, strict=True)) - (s << p) for row, s in zip(m, near, strict=True)
        ]
        share = max(Fraction(lack, room) for lack, room in zip(lacks, rooms, strict=True))
        reach = [s + (share * w).__ceil__() for s, w in zip(near, widths, strict=True)]
        found.append([v + Interval(-r, r, p) for v, r in zip(column, reach, strict=True)])
    return [list(row) for row in zip(*found, strict=True)]


def components(family: Family, x: Sequence[Interval]) -> tuple[list[Interval], list[list[Interval]]]:
    """Position, rotation, quaternion and centroid in ordinary coordinates of the model, and their derivatives by x."""
    quantities, slopes = family.quantities(x, family.zero), family.slopes(x, family.zero)
    norm, by_norm = quantities[0], slopes[0]
    ratios = [value.over(norm) for value in quantities[1:13]]
    tangents = [
        [(s - ratio * t).over(norm) for s, t in zip(row, by_norm, strict=True)]
        for ratio, row in zip(ratios, slopes[1:13], strict=True)
    ]
    turns = [[*zip(ratios[3 * i : 3 * i + 3], tangents[3 * i : 3 * i + 3], strict=True)] for i in range(3)]
    (base, platform), unit = family.origins, family.unit
    centroid = [
        (a + unit * c, [unit * t for t in row]) for a, c, row in zip(base, ratios[9:], tangents[9:], strict=True)
    ]
    position = []
    for (value, line), turn in zip(centroid, turns, strict=True):
        moved, slope = value, line
        for (ratio, tangent), b in zip(turn, platform, strict=True):
            moved = moved - ratio * b
            slope = [s - t * b for s, t in zip(slope, tangent, strict=True)]
        position.append((moved, slope))
    length = norm.root()
    quaternion = []
    for axis in range(4):
        entry = x[family.places.index(axis)].over(length) if axis in family.places else family.zero
        own = [family.one.over(length) if place == axis else family.zero for place in family.places]
        quaternion.append((entry, [o - (entry * t).over(2 * norm) for o, t in zip(own, by_norm, strict=True)]))
    every = [*position, *(pair for turn in turns for pair in turn), *quaternion, *centroid]
    return [value for value, _ in every], [line for _, line in every]


def greatest_length(rows: Sequence[Sequence[Interval]], reaches: Sequence[int], p: int) -> int:
    """At least the greatest length of rows times E, for |E_i| up to the reaches, in units of 2^-p: at a vertex."""
    greatest = 0
    for signs in range(1 << (len(reaches) - 1)):
        ends = [-reach if signs >> i & 1 else reach for i, reach in enumerate(reaches)]
        vertex = [Interval(end, end, p) for end in ends]
        lengths = [inner_product(row, vertex).largest() for row in rows]
        greatest = max(greatest, sum(length * length for length in lengths))
    return isqrt(greatest) + 1


def is_angle_of(angle: Fraction, chord: Fraction, p: int) -> bool:
    """Whether angle >= 4 arcsin(chord / 2), for a chord up to 8/5: by the series of sin(angle / 4), ended below it."""
    end = min(int(angle * (1 << p)) // 4, 1 << p)  # the sine increases up to 1, where it is above 4/5
    x = Interval(end, end, p)
    square, term, sine = x * x, x, x
    n = 1
    while term.largest() > 1:
        for sign in (-1, 1):
            divisor = (n + 1) * (n + 2) << p
            term = (term * square).over(Interval(divisor, divisor, p))
            sine = sine + sign * term
            n += 2
    sine = sine - term
    return 2 * Fraction(sine.low, 1 << p) >= chord


def check_nothing_else(at: Neighbourhood, box: PoseBox, name: str) -> None:
    """All poses with these bounds of centroid and quaternion lie in the outer box, where there is only one."""
    family, p = at.family, at.family.p
    sides = [Interval(surrounding(low, p).low, surrounding(high, p).high, p) for low, high in box.bounds]
    q = sides[12:16]
    c = [(value - a) * family.per_unit for value, a in zip(sides[16:], family.origins[0], strict=True)]
    f = [-1 * inner_product(c, q[1:])]
    f += [c[i] * q[0] + c[j] * q[k + 1] - c[k] * q[j + 1] for i, j, k in CYCLIC]
    kept = [[*q, *f][place] for place in family.places]
    chart = inner_product([w.re for w in at.weights], kept[: len(at.weights)])
    apart = not chart.contains_zero()
    within = apart and all(
        side.low <= point.low and point.high <= side.high
        for point, side in zip(
            (value.over(chart) for value in kept), map(real_part, at.around(box.place.outer)), strict=True
        )
    )
    require(within, f"{name}: the bounds of the pose reach beyond the outer box")


def real_part(value: Rectangle) -> Interval:
    """The real parts."""
    return value.re


def check_all_solutions(
    certificate: ToleranceCertificate, family: Family, core: Sequence[int], cores: list[list[Rectangle]]
) -> str:
    """As many distinct solutions of the nominal robot as the degree, each of them proved for every robot."""
    keys = [(place.chart, place.centre) for place in certificate.pairs]
    require(keys == sorted(keys), "pairs: not listed in their order")
    for number, place in enumerate(certificate.pairs, 1):
        name = f"pair {number}"
        at = Neighbourhood(family, place, certificate.exponent)
        check_place(at, place, core, name)
        holds = at.contracts(place.outer, uncertain=True)
        require(holds, f"{name}: not proved to hold a solution of every robot within tolerance")
        found = at.motion_in(core)
        cores = [*cores, found, [value.conjugate() for value in found]]
    degree = certificate.degree
    require(len(cores) == degree, f"complete: claimed, but {len(cores)} of {degree} solutions are proved")
    distinct = all(are_distinct(one, other) for one, other in combinations(cores, 2))
    require(distinct, "complete: claimed, but two nominal solutions are not proved distinct")
    return (
        f"complete: {degree} solutions of every robot within tolerance, isolated and distinct, are the degree of the "
        f"motions; {len(certificate.boxes)} of them are real, there is no other pose"
    )


# ---------------------------------------------------------------------------------------------------------------------
# The checker and its command
# ---------------------------------------------------------------------------------------------------------------------


def check_bytes(data: bytes) -> Verdict:
    r"""The verdict on the content of a certificate file.

    Parameters
    ----------
    data : bytes
        Anything; nothing is raised on account of it, and the work is bounded.

    Returns
    -------
    Verdict
        "accepted" if every claim was proved again, from the robot and the polynomials alone (``docs/certificates.md``).
        "rejected" means not proved, which is not to say false.

    Examples
    --------
    >>> check_bytes(b"{}\n")
    Verdict(status='malformed', lines=('file: not a JSON object with a digest',))
    """
    return check_counted(data)[0]


def check_counted(data: bytes) -> tuple[Verdict, Work]:
    """The verdict, and the work spent on it."""
    lines, work = [], Work(len(data))
    token = WORK.set(work)
    try:
        lines_proved = replayed(parsed(data))
        lines.append("digest: that of the content")
        for line in lines_proved:
            lines.append(line)  # noqa: PERF402 - the lines before a refusal stay
    except Refusal as refusal:
        return Verdict(refusal.status, (*lines, refusal.line)), work
    finally:
        WORK.reset(token)
    return Verdict("accepted", tuple(lines)), work


def replayed(body: dict[str, Any]) -> Iterator[str]:
    """The content, read at once, and its checks, one after another."""
    name = body.get("format")
    if name == TOLERANCE_FORMAT:
        return check_tolerances(read_tolerances(body))
    if isinstance(name, str) and name in OTHER_KINDS:
        return checks_beside(*OTHER_KINDS[name])(body)
    if body.get("version") == 2 and type(body["version"]) is int:
        return checks_beside("pure_mechanism", "version 2")(body)
    return checks(read(body))


OTHER_KINDS: Final = {
    "pkm_exact system certificate": ("pure_system", "a system certificate"),
    "pkm_exact mobility certificate": ("pure_mobility", "a mobility certificate"),
    "pkm_exact platform certificate": ("pure_platform", "a platform certificate"),
    "pkm_exact region certificate": ("pure_region", "a region certificate"),
    "pkm_exact statics certificate": ("pure_statics", "a statics certificate"),
    "pkm_exact links certificate": ("pure_links", "a links certificate"),
}
"""Files beside this one that check certificates of other kinds, by their format."""


def checks_beside(module: str, kind: str) -> Callable[[dict[str, Any]], Iterator[str]]:
    """What reads and checks certificates of another kind: in a file beside this one, which imports it."""
    package = f"{__package__}." if __package__ else ""
    sys.modules.setdefault(f"{package}pure", sys.modules[__name__])
    if not package:
        sys.path.append(os.path.dirname(os.path.abspath(__file__)))  # noqa: PTH100, PTH120 - Python may be isolated
    try:
        return import_module(f"{package}{module}").replayed  # type: ignore[no-any-return]
    except ModuleNotFoundError:
        raise Refusal("malformed", f"format: {kind} needs {module}.py, which is not beside this program") from None


def checks(certificate: Certificate) -> Iterator[str]:
    """One line per claim that is proved."""
    representation = certificate.representation
    if representation is not None:
        yield from check_eliminant(representation)
        yield from check_distinct(representation)
        yield from check_poses(representation, certificate.legs, certificate.metric)
        if certificate.claim != "positive-dimensional-proved":
            yield from check_real_poses(certificate, representation)
    if certificate.boxes is not None:
        system = chart_system(certificate.legs, certificate.metric, certificate.boxes.w)
        yield from check_boxes(system, certificate.boxes)
        yield from check_poses_in_boxes(certificate, certificate.boxes, system)
    yield from check_claims(certificate)


def check_file(path: str) -> int:
    """Print the verdict on a file; its exit code."""
    name = "".join(c if c.isprintable() else ascii(c)[1:-1] for c in path)
    try:
        # Opening a pipe must not wait for a writer.
        with open(os.open(path, os.O_RDONLY | getattr(os, "O_NONBLOCK", 0)), "rb") as stream:  # noqa: PTH123
            if not stat.S_ISREG(os.fstat(stream.fileno()).st_mode):
                raise OSError(errno.EINVAL, "not a regular file")
            data = stream.read(MAX_BYTES + 1)
    except (OSError, ValueError) as error:
        reason = error.strerror if isinstance(error, OSError) else str(error)
        sys.stderr.write(f"error: {name}: cannot be read ({reason}); give the path of a certificate\n")
        return 2
    verdict = check_bytes(data)
    sys.stdout.write("".join(f"{name}: {line}\n" for line in (*verdict.lines, verdict.status)))
    sys.stdout.flush()
    return {"accepted": 0, "rejected": 1}.get(verdict.status, 2)


def main(paths: Sequence[str]) -> int:
    """Check files; the exit code: 0 all accepted, 1 one rejected, otherwise 2."""
    if not paths:
        sys.stderr.write("usage: python pure.py CERT.json...\n")
        return 2
    codes = [check_file(path) for path in paths]
    return 1 if 1 in codes else max(codes)


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
