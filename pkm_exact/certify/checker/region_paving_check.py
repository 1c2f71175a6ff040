"""The paving of a region certificate, checked letter by letter with exact Bernstein coefficients."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from fractions import Fraction
from math import isqrt
from typing import Any, Final

from pkm_exact.certify.checker.budget import charge
from pkm_exact.certify.checker.region_coefficients import Part
from pkm_exact.certify.checker.region_designs_check import designs_lines
from pkm_exact.certify.checker.region_document import RegionDocument
from pkm_exact.certify.checker.region_document_2 import require_held
from pkm_exact.certify.checker.region_polynomials import RegionEquations
from pkm_exact.certify.checker.region_proofs import LETTER, is_proved, ranges_on
from pkm_exact.certify.checker.region_regular import Regular
from pkm_exact.certify.checker.region_ring import (
    Condition,
    Conditions,
    Deferred,
    Signed,
    beyond,
    number_words,
    polynomial_words,
    size_factor,
)
from pkm_exact.certify.checker.verdict import malformed, rejected

_SIGN_BITS: Final = (64, 256, 1024)
_WORDS: Final = {"i": "inside", "o": "outside"}


def check_region(document: RegionDocument) -> Iterator[str]:
    """One line for each claim that is proved."""
    if any(weight < 0 for part in document.shape for weight in part.weights):
        raise malformed("shape: a weight is negative")
    require_held(document)
    conditions = RegionEquations(document).conditions()
    yield f"conditions: {', '.join(document.asked)}, as polynomials in {', '.join(document.variables)}"
    if document.claim == "not-all":
        if document.paving or document.inside or document.undecided or document.measure is not None:
            raise malformed("paving: there is one, but a pose refutes the question")
        yield _refuted(document, conditions)
        return
    if document.points:
        raise malformed("counterexample: there is one, but the claim is another")
    if document.claim == "designs":
        yield from designs_lines(document, conditions)
        _require_poses(document, conditions)
        yield "claim: what the boxes of designs say is true for every design in them"
        return
    yield from _paved(document, conditions)


def _paved(document: RegionDocument, conditions: Conditions) -> Iterator[str]:
    if document.claim == "map":
        condition: Condition = ("and", [conditions.region, conditions.asked])
    else:
        condition = ("or", [beyond(conditions.region), conditions.asked])
    shares = _shares(document, condition, conditions.roots)
    counts = {letter: document.paving.count(letter) for letter in "iou"}
    if (counts["i"], counts["u"]) != (document.inside, document.undecided):
        raise rejected("inside, undecided: not as many parts as the paving has")
    yield f"paving: {counts['i']} parts inside, {counts['o']} outside, each proved; {counts['u']} undecided"
    if document.claim == "all":
        if counts["o"] or counts["u"]:
            raise rejected("claim: not all parts are inside")
        _require_poses(document, conditions)
        yield "claim: all poses of the region are good"
    elif document.claim == "undecided":
        if not counts["u"] and not counts["o"]:
            raise rejected("claim: all parts are inside, which is more than claimed")
        yield "claim: none but what is proved of the parts"
    yield from _measured(document, shares)


def _require_poses(document: RegionDocument, conditions: Conditions) -> None:
    """The region has poses, of which something is said."""
    if document.member:
        if not _is_in_region(document, conditions, document.member):
            raise rejected("member: is not proved to be in the region, so nothing shows that the region has poses")
        return
    middle = [(low + high) / 2 for low, high in document.box]
    if any(_value(part.polynomial, middle, ()) < 0 for part in conditions.shape):
        raise rejected("shape: the middle of the box is not in it, so nothing shows that the region has poses")


def _is_in_region(document: RegionDocument, conditions: Conditions, point: Sequence[Fraction]) -> bool:
    """Whether a point is in the box, and proved to be in the region."""
    is_in_box = all(low <= x <= high for x, (low, high) in zip(point, document.box, strict=True))
    return is_in_box and _holds(conditions.region, point, conditions.roots)


def _measured(document: RegionDocument, shares: dict[str, Fraction]) -> Iterator[str]:
    """The bounds of a map, if it has any."""
    if document.claim != "map" or not all(name in "xyz" for name in document.variables):
        if document.measure is not None:
            raise rejected("measure: claimed where there is none")
        return
    size = Fraction(1)
    for low, high in document.box:
        size *= high - low
    if document.measure != (size * shares["i"], size * (shares["i"] + shares["u"])):
        raise rejected("measure: not that of the parts inside, and of these with the undecided ones")
    yield "measure: between that of the parts inside, and that of these with the undecided ones"


def _shares(document: RegionDocument, condition: Condition, roots: Sequence[Any]) -> dict[str, Fraction]:
    """For every letter the share of the box of the parts that have it; refused if one is not proved."""
    axes, found = document.axes, dict.fromkeys("iou", Fraction(0))
    waiting = [Part(0)]
    for place, letter in enumerate(document.paving, 1):
        if not waiting:
            raise rejected("paving: it goes on after its end")
        part = waiting.pop()
        charge(LETTER)
        if letter == "s":
            if part.depth >= len(axes):
                raise rejected(f"paving: letter {place} halves a part deeper than the axes say")
            waiting += part.halves(axes[part.depth])[::-1]
            continue
        if letter != "u" and not is_proved(condition, ranges_on(part, document, roots), wanted=letter == "i"):
            raise rejected(f"paving: the part of letter {place} is not proved to be {_WORDS[letter]}")
        found[letter] += Fraction(1, 1 << part.depth)
    if waiting:
        raise rejected("paving: parts of the region are missing")
    return found


def _refuted(document: RegionDocument, conditions: Conditions) -> str:
    """That a pose of the region is not good, or that the determinant has both signs in it."""
    if any(not _is_in_region(document, conditions, point) for point in document.points):
        raise rejected("counterexample: a pose is not one of the region")
    if len(document.points) == 1:
        (point,) = document.points
        if not _fails(conditions.asked, point, conditions.roots):
            raise rejected("counterexample: no condition is proved to fail there")
        return "claim: not all poses of the region are good, as one shows"
    if len(document.points) != 2 or conditions.determinant is None or document.joints:
        raise malformed("counterexample: neither one pose, nor two between which a determinant changes its sign")
    signs = [_determinant_sign(conditions.determinant, point, conditions.roots) for point in document.points]
    if None in signs or signs[0] != -(signs[1] or 0) or not signs[0]:
        raise rejected("counterexample: the determinants are not proved to have opposite signs")
    return "claim: not all poses of the region are good, as the determinant has both signs in it, which is connected"


def _holds(condition: Condition, point: Sequence[Fraction], roots: Sequence[Any]) -> bool:
    """Whether a condition is proved to hold at a point whose tests are all that something is not negative."""
    if isinstance(condition, Signed):
        sign = _sign(condition.polynomial, point, roots)
        return sign is not None and sign >= 0
    word, parts = condition
    holding = (_holds(part, point, roots) for part in parts)
    return all(holding) if word == "and" else any(holding)


def _fails(condition: Condition, point: Sequence[Fraction], roots: Sequence[Any]) -> bool:
    if isinstance(condition, Regular):
        return _determinant_sign(condition, point, roots) == 0
    if isinstance(condition, Signed):
        sign = _sign(condition.polynomial, point, roots)
        if sign is None:
            return False
        return {"+": sign <= 0, "0+": sign < 0, "/": sign == 0}[condition.sign]
    if isinstance(condition, Deferred):
        return _fails(condition.condition, point, roots)
    word, parts = condition
    failing = (_fails(part, point, roots) for part in parts)
    return any(failing) if word == "and" else all(failing)


def _determinant_sign(determinant: Any, point: Sequence[Fraction], roots: Sequence[Any]) -> int | None:
    """The sign at a point of a determinant, or of that of a matrix."""
    if isinstance(determinant, Regular):
        determinant = determinant.determinant_at(point)
    return _sign(determinant, point, roots)


def _value(polynomial: Any, point: Sequence[Fraction], used: tuple[int, ...]) -> Fraction:
    """The value at a point of the part of a polynomial that has exactly these roots."""
    total, count = Fraction(0), len(point)
    degree = max((sum(int(e) for e in exponents[:count]) for exponents in polynomial.to_dict()), default=0)
    words = polynomial_words(polynomial) + number_words(*point) * degree
    charge(2000 * max(1, len(polynomial)) * size_factor(words // 5, words // 5))
    for exponents, coefficient in polynomial.to_dict().items():
        if tuple(k for k, e in enumerate(exponents[count:]) if e) != used:
            continue
        term = Fraction(int(coefficient.p), int(coefficient.q))
        for x, exponent in zip(point, exponents, strict=False):
            term *= x ** int(exponent)
        total += term
    return total


def _sign(polynomial: Any, point: Sequence[Fraction], roots: Sequence[Any]) -> int | None:
    """The sign of a polynomial at a point; None if it is not proved."""
    count = len(point)
    used = {tuple(k for k, e in enumerate(exponents[count:]) if e) for exponents in polynomial.to_dict()}
    values = {key: _value(polynomial, point, key) for key in sorted(used)}
    if not any(used):
        total = values.get((), Fraction(0))
        return (total > 0) - (total < 0)
    squares = [_value(root, point, ()) for root in roots]
    if any(square < 0 for square in squares):
        return None
    for bits in _SIGN_BITS:
        scale = 1 << bits
        low = high = Fraction(0)
        for key, value in values.items():
            ends = [Fraction(1), Fraction(1)]
            for k in key:
                root = isqrt(squares[k].numerator * scale * scale // squares[k].denominator)
                ends = [ends[0] * Fraction(root, scale), ends[1] * Fraction(root + 1, scale)]
            low += min(value * end for end in ends)
            high += max(value * end for end in ends)
        if low > 0 or high < 0:
            return 1 if low > 0 else -1
    return None
