"""Certificates of version 2 with a wrong number of solutions: multiple ones, and invented points at infinity."""

from __future__ import annotations

from collections.abc import Callable
from fractions import Fraction
from functools import partial
from typing import Any

from flint import fmpq, fmpq_mat, fmpq_poly, fmpz_poly
from forged_completions import without_factor
from forged_infinity import infinity_of
from held_mechanisms import KEYS, Content, Pose, listing
from mechanism_certificates import mechanism_content
from spherical_nets import triple_and_double

Case = tuple[Callable[[], Content], str]
REJECTED, ACCEPTED = "rejected", "accepted"
TRIPLE, DOUBLE, CONCURRENT = (
    *("planar, a triple pose", "planar, a double pose"),
    "more legs than freedoms, a multiple solution",
)


def _multiple(name: str, *multiplicities: int | None, total: int | None = None) -> Content:
    content = mechanism_content(name)
    poses = zip(content["poses"], multiplicities, strict=True)
    found = [{**pose, "multiplicity": multiplicity} for pose, multiplicity in poses]
    return content | {"poses": found, "complex_solutions": content["complex_solutions"] if total is None else total}


def _of_five(place: int = 0, step: int = 0) -> Content:
    """A triple pose, a double one and three simple ones; the multiplicity of one of them is another."""
    content = triple_and_double()
    poses = [
        {**pose, "multiplicity": pose["multiplicity"] + step * (number == place)}
        for number, pose in enumerate(content["poses"])
    ]
    return content | {"poses": poses}


def _of_five_without(step: int) -> Content:
    """Without a step of its elimination."""
    content = triple_and_double()
    steps = content["elimination"]
    return content | {"elimination": [*steps[:step], *steps[step + 1 :]]}


def lacking(name: str, number: int, **entries: Any) -> Content:
    """A certificate without the solutions at the roots of one factor of the eliminant; the others count as before."""
    content = mechanism_content(name)
    h = fmpz_poly([int(c, 16) for c in content["representation"]["eliminant"]])
    found = without_factor(content, h.factor()[1][number][0], 1)
    kept = {key: content[key] for key in ("claim", "completeness_route", "elimination")}
    multiplicities = {str(pose["position"] + pose["quaternion"]): pose["multiplicity"] for pose in content["poses"]}
    poses = [
        {**pose, "multiplicity": multiplicities.get(str(pose["position"] + pose["quaternion"]), 1)}
        for pose in found["poses"]
    ]
    counted = {"poses": poses, "complex_solutions": content["complex_solutions"]}
    counted |= {} if poses else {"box_exponent": 0}
    whole = found | kept | counted | entries
    return {key: whole[key] for key in KEYS}


MULTIPLE: dict[str, Case] = {
    "a triple pose, a double one and three simple ones": (_of_five, ACCEPTED),
    **{
        f"multiplicity of pose {place} of five, {step} off": (partial(_of_five, place, step), REJECTED)
        for place in range(5)
        for step in (1, -1)
    },
    **{
        f"multiplicities {here} of a triple pose and a simple one": (partial(_multiple, TRIPLE, *here), REJECTED)
        for here in ((2, 1), (4, 1), (1, 3), (1, 1), (3, 2), (3, 3), (None, 1), (3, None))
    },
    **{
        f"a triple pose, {total} in all": (partial(_multiple, TRIPLE, 3, 1, total=total), REJECTED)
        for total in (4, 5, 7)
    },
    **{f"multiplicity {m} of a double pose": (partial(_multiple, DOUBLE, m), REJECTED) for m in (1, 3, None)},
    **{
        f"a double pose among six, {total} in all": (partial(_multiple, DOUBLE, 2, total=total), REJECTED)
        for total in (5, 7)
    },
    **{
        f"factor {number} left out beside a {name.rpartition(' a ')[2]}": (partial(lacking, name, number), REJECTED)
        for name, numbers in ((TRIPLE, (0, 1)), (DOUBLE, (0, 1)))
        for number in numbers
    },
    "a double pose of more legs than freedoms, by an elimination": (
        lambda: mechanism_content(CONCURRENT) | {"completeness_route": "exact-elimination", "elimination": []},
        ACCEPTED,
    ),
    **{
        f"a double pose of more legs than freedoms, by an elimination, multiplicity {m}": (
            lambda m=m: (
                _multiple(CONCURRENT, m, total=m)  # type: ignore[misc]
                | {"completeness_route": "exact-elimination", "elimination": []}
            ),
            REJECTED,
        )
        for m in (1, 3)
    },
}


def _touched_all_round() -> Content:
    """A point on six cylinders that all have one tangent there; their equations are no basis of what follows."""
    at = Pose((1, 0, 0, 0), (0, 1, 2, 5))
    across = (((1, 0), (0, 1, 1)), ((0, 1), (1, 0, 2)), ((1, 1), (1, -1, 1)), ((1, -1), (1, 1, -1)))
    across += (((2, 1), (1, -2, 3)), ((1, 2), (2, -1, -1)))
    x, y, z = at.quantities()[0]
    cylinders = [at.axis_distance((x - a, y - b, z), v, (0, 0, 0)) for (a, b), v in across]
    content = listing("translation", [at], list(cylinders), 2, 2)
    return content | {"claim": "complete", "completeness_route": "exact-elimination", "elimination": []}


MULTIPLE["six cylinders that touch in a point, said to be all by an elimination"] = (_touched_all_round, REJECTED)


# Points at infinity


def _invented(number: int, multiplicity: int) -> Content:
    """Points where all constraints of the 3-RPS are parallel, which are no limits of rigid motions."""
    rows = [constraint["forms"][0][:16] for constraint in mechanism_content("3-RPS")["robot"]["constraints"]]
    values = [[Fraction(value) for value in row] for row in rows]
    echelon, rank = fmpq_mat([[fmpq(x.numerator, x.denominator) for x in row] for row in values]).rref()
    pivots = [next(j for j in range(16) if echelon[row, j]) for row in range(rank)]
    free = [j for j in range(16) if j not in pivots][:3]
    t = fmpq_poly([0, 1])
    powers = [fmpq_poly([1]), t, t * t]
    points = [fmpq_poly([0])] * 16
    for place, power in zip(free, powers, strict=True):
        points[place] = points[place] + power
        for row, pivot in enumerate(pivots):
            points[pivot] = points[pivot] - echelon[row, place] * power
    h = fmpz_poly([1])
    for root in range(number):
        h *= fmpz_poly([-root, 1])
    chart, form = ([int(j == free[k]) for j in range(16)] for k in (0, 1))
    values_at = [value % fmpq_poly(h) for value in points]
    return infinity_of([(h, values_at)], chart, form, multiplicity)


def _scaled() -> Content:
    """The points times 1/2, where w.z is 1/2."""
    content = mechanism_content("3-PSS+C, general")
    infinity = content["infinity"]
    doubled = {
        "eliminant": [hex(2 * int(c, 16)) for c in infinity["eliminant"]],
        "separating_form": [2 * c for c in infinity["separating_form"]],
    }
    return content | {"infinity": infinity | doubled}


INFINITY: dict[str, Case] = {
    "points at infinity are invented, half of the poses left out": (
        lambda: lacking("3-RPS", 0, complex_solutions=8) | {"infinity": _invented(32, 32)},
        REJECTED,
    ),
    "all points at infinity are invented": (
        lambda: mechanism_content("3-RPS") | {"infinity": _invented(24, 24)},
        REJECTED,
    ),
    "points at infinity in another chart than said": (_scaled, REJECTED),
}

COUNTS: dict[str, Case] = {**MULTIPLE, **INFINITY}
