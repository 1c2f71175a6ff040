"""Self-motions of mechanisms: why poses form a set of positive dimension, and whether a real one moves. All exact."""

from __future__ import annotations

from collections.abc import Generator, Iterator, Sequence
from fractions import Fraction
from itertools import pairwise
from typing import Final

from pkm_exact.certify.checker.document import Representation
from pkm_exact.certify.checker.listed_roots import number_of_real_roots
from pkm_exact.certify.checker.mechanism_document import MechanismDocument, SelfMotion
from pkm_exact.certify.checker.mechanism_forms import (
    SIZE,
    Form,
    Mechanism,
    cleared,
    rank_beside,
)
from pkm_exact.certify.checker.mechanism_solutions import are_regular, check_solutions, form_minus, full_rank_with
from pkm_exact.certify.checker.solutions import primitive_part, vanishes
from pkm_exact.certify.checker.study_motion import CYCLIC, Metric, combination, motion
from pkm_exact.certify.checker.verdict import rejected

_ZERO: Final = Fraction(0)


def check_mechanism_motion(document: MechanismDocument, claimed: SelfMotion) -> Iterator[str]:
    """The set of poses has positive dimension for the cause that is named, and moves really iff that is proved."""
    by_slices = claimed.cause == "more-poses-than-bound"
    if by_slices == bool(document.representation) or by_slices != bool(claimed.forms and claimed.slices):
        raise rejected(f"self-motion: the cause {claimed.cause} has not the parts that prove it")
    if by_slices:
        moves = yield from _by_slices(claimed, document.mechanism)
    else:
        representation = document.representation
        if representation is None or claimed.forms or claimed.slices:
            raise rejected(f"self-motion: the cause {claimed.cause} has not the parts that prove it")
        yield from check_solutions(representation, document.mechanism)
        proof = {"dependent-forms": _dependent, "symmetry": _symmetric, "equal-legs": _equal_legs}[claimed.cause]
        moves = proof(document.mechanism, representation)
        yield f"self-motion: {_WORDS[claimed.cause]}"
    if moves != claimed.is_real:
        raise rejected("self-motion: what is claimed of real poses is not what is proved")
    if moves:
        yield "self-motion: real poses form a curve at least; the mechanism moves with its actuators locked"
    else:
        yield "self-motion: complex poses form it; that one of them is real, and the mechanism moves, is not proved"


_WORDS: Final = {
    "dependent-forms": "the constraints are dependent, their poses form sets of positive dimension",
    "symmetry": "a group of motions leaves all constraints as they are",
    "equal-legs": "all legs are the same vector, their poses form a sphere or circle",
}


def _dependent(mechanism: Mechanism, representation: Representation) -> bool:
    if mechanism.rank + len(mechanism.quadrics) >= mechanism.group.dimension:
        raise rejected("self-motion: the constraints are not dependent")
    return has_real_root(representation) and full_rank_with(independent(mechanism), representation, mechanism)


def independent(mechanism: Mechanism) -> list[Form]:
    """The linear forms that are no combination of those before them, beside those that vanish on all motions."""
    found: list[Form] = []
    for form in mechanism.linear:
        if rank_beside([*found, form], mechanism.vanishing) > len(found):
            found.append(form)
    return found


def has_real_root(representation: Representation) -> bool:
    """Whether the eliminant has a real root: then one of its poses is real."""
    return number_of_real_roots(primitive_part(representation.eliminant)) > 0


def _symmetric(mechanism: Mechanism, representation: Representation) -> bool:
    forms = mechanism.linear
    for quadric in mechanism.quadrics:
        forms += [quadric.whole, quadric.root]
    if not any(_has_symmetry(forms, mechanism, of_platform=side) for side in (True, False)):
        raise rejected("self-motion: no motion of the platform or of the base leaves all constraints as they are")
    return has_real_root(representation)


def _has_symmetry(forms: Sequence[Form], mechanism: Mechanism, *, of_platform: bool) -> bool:
    """Whether some (t, w) changes all forms by combinations of those that vanish on all motions.

    The changes of all forms, one behind another, are linear in (t, w): the rank of those for the unit vectors tells.
    """
    directions = [[Fraction(int(k == twist)) for k in range(6)] for twist in mechanism.group.twists]
    changes = [[_rate(form, d[:3], d[3:], mechanism.metric, of_platform) for form in forms] for d in directions]
    # One block of coordinates for each form; what vanishes on all motions may be added in each block.
    width = SIZE * len(forms)
    rows = [tuple(value for rate in change for value in rate) for change in changes]
    free = []
    for block in range(len(forms)):
        for form in mechanism.vanishing:
            row: list[Fraction | int] = [_ZERO] * width
            row[SIZE * block : SIZE * (block + 1)] = form
            free.append(tuple(row))
    return rank_beside(rows, free) < len(rows)


def _rate(form: Form, t: Sequence[Fraction], w: Sequence[Fraction], g: Metric, of_platform: bool) -> Form:
    """The rate of a form along a motion of the platform, or of the base, as a form again."""
    square, turned, position, rotation = form[0], form[1:4], form[4:7], form[7:16]
    spin = [[_ZERO] * 3 for _ in range(3)]  # W x = G^-1 (w x x)
    for i, j, k in CYCLIC:
        spin[i][k], spin[i][j] = w[j] / g[i], -w[k] / g[i]
    rate = [_ZERO] * SIZE

    def add(place: int, value: Fraction) -> None:
        rate[place] += value

    moved = 1 if of_platform else 4  # where u or C stand
    for i in range(3):
        add(moved + i, 2 * square * g[i] * t[i])  # of |C|^2: 2 t.u or 2 t.C
        add(16, (turned if of_platform else position)[i] * t[i])
        for j in range(3):
            if of_platform:
                add(1 + j, -turned[i] * spin[i][j])  # u: t - W u
                add(7 + 3 * i + j, position[i] * t[j])  # C: R t
            else:
                add(4 + j, position[i] * spin[i][j])  # C: t + W C
                add(7 + 3 * j + i, turned[i] * g[j] * t[j] / g[i])  # u: G^-1 R^T G t
            for k in range(3):
                if of_platform:
                    add(7 + 3 * i + k, rotation[3 * i + j] * spin[k][j])  # R: R W
                else:
                    add(7 + 3 * k + j, rotation[3 * i + j] * spin[i][k])  # R: W R
    return tuple(rate)


def _equal_legs(mechanism: Mechanism, representation: Representation) -> bool:
    legs = [constraint.leg for constraint in mechanism.constraints]
    known = [leg for leg in legs if leg is not None]
    if mechanism.group.degree not in (6, 40) or len(known) < len(legs):
        raise rejected("self-motion: equal legs are those of spatial or planar robots with legs only")
    h0 = primitive_part(representation.eliminant)
    placed = motion(representation.quaternion, representation.translation, mechanism.metric)
    first = known[0]
    for leg in known[1:]:
        shift = [x - y for x, y in zip(leg.platform, first.platform, strict=True)]
        base = [x - y for x, y in zip(leg.base, first.base, strict=True)]
        for row, coordinate in zip(placed.rotation, base, strict=True):
            scalars = cleared((*shift, -coordinate))
            if not vanishes(combination(scalars, [*row, placed.norm]), h0):
                raise rejected("self-motion: the legs are not the same vector")
    # In the plane the legs may be tilted, as joints may lie off it: the path is a circle if they are not upright.
    tilt = mechanism.metric[2] * (first.base[2] - first.platform[2]) ** 2 if mechanism.group.dimension == 3 else 0
    return has_real_root(representation) and first.length_squared > tilt


def _by_slices(claimed: SelfMotion, mechanism: Mechanism) -> Generator[str, None, bool]:
    """More poses, in slices by one more form, than there can be isolated ones; returns whether real ones are too."""
    constants = [cut.constant for cut in claimed.slices]
    if any(a >= b for a, b in pairwise(constants)):
        raise rejected("self-motion: the constants of the slices do not increase")
    bound = mechanism.with_forms(claimed.forms[:-1]).bound
    poses = real = 0
    for number, cut in enumerate(claimed.slices, 1):
        forms = [*claimed.forms[:-1], form_minus(claimed.forms[-1], cut.constant)]
        sliced = mechanism.with_forms(forms)
        yield from check_solutions(cut.representation, sliced, f"slice {number}: ")
        poses += int(cut.representation.eliminant.degree())
        h0 = primitive_part(cut.representation.eliminant)
        if are_regular(h0, cut.representation, sliced):
            real += number_of_real_roots(h0)
    if poses <= bound:
        raise rejected(f"self-motion: {poses} poses, but {bound} can be isolated")
    yield f"self-motion: {poses} poses, more than the {bound} that can be isolated"
    return real > bound
