"""Certificates whose count of solutions rests on the algebra that an elimination defines: honest ones and forged ones.

Systems of few polynomials with forged eliminations, and translations with a pose at which two conics meet four times.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from fractions import Fraction
from functools import partial
from typing import Any

from forged_representations import fit_real_poses, representation_through, set_representation
from handmade_systems import Content, complete, listed, represented, system_content
from held_mechanisms import Pose, listing

from pkm_exact.constraints.constraint import Constraint

Case = tuple[Callable[[], Content], str]
REJECTED, ACCEPTED = "rejected", "accepted"
Points = Sequence[Sequence[Fraction | int]]
PRIME = (1 << 127) - 1
"""That of the plain checker's first eliminations."""


def _system(
    unknowns: str, texts: Sequence[str], points: Points, multiplicities: Any, elimination: Any, exponent: int = 8
) -> Content:
    """Some solutions, said to be all, with these multiplicities; the first unknown tells them apart."""
    form = (1, *[0] * unknowns.count(","))
    entries = complete("exact-elimination", sum(multiplicities), elimination=elimination)
    return listed(
        unknowns, texts, represented(points, form), multiplicities=list(multiplicities), exponent=exponent, **entries
    )


# Matrices that do not commute: x^2 = +-y and x y = 0 imply y^2 = 0, of which only y^3 = 0 is derived

CONICS = (("x^2-y", "x*y"), ("x^2+y", "x*y"))
TOO_FEW, ENOUGH = [["0 1 1", "1 0 1"]], [["0 1", "1 0"]]
COMMUTING: dict[str, Case] = {
    **{
        f"{', '.join(texts)}, three times": (partial(_system, "x,y", texts, [(0, 0)], [3], ENOUGH), ACCEPTED)
        for texts in CONICS
    },
    **{
        f"{', '.join(texts)}, said to be four times": (
            partial(_system, "x,y", texts, [(0, 0)], [4], TOO_FEW),
            REJECTED,
        )
        for texts in CONICS
    },
}

# Polynomials off the border of what is left, and solutions that are left out

FILLED: dict[str, Case] = {
    "x^3 and x^5 - x^2, said to be three times": (
        partial(_system, "x", ("x^3", "x^5-x^2"), [(0,)], [3], []),
        REJECTED,
    ),
    **{
        f"(x - {root})^2 and x^4 - {root} x^3, said to be twice": (
            partial(_system, "x", (f"x^2{-2 * root:+d}*x+1", f"x^4{-root:+d}*x^3"), [(root,)], [2], []),
            REJECTED,
        )
        for root in (1, -1)
    },
    "x^3 and x^5 + x^4": (partial(_system, "x", ("x^3", "x^5+x^4"), [(0,)], [3], []), ACCEPTED),
    "x^3 and x^5 + x^4, times 2^127 - 1": (
        partial(_system, "x", (f"{PRIME}*x^3", f"{PRIME}*x^5+{PRIME}*x^4"), [(0,)], [3], []),
        ACCEPTED,
    ),
    **{
        f"x^{n} - x^{n - 1}, and 1 is left out": (
            partial(_system, "x", (f"x^{n}-x^{n - 1}",), [(0,)], [n], []),
            REJECTED,
        )
        for n in (3, 4)
    },
    "x^4 - x^3": (partial(_system, "x", ("x^4-x^3",), [(0,), (1,)], [3, 1], []), ACCEPTED),
}

# Polynomials with other leading monomials modulo a prime: both rows of the echelon form begin with x^2 there

ROOT = 3**70
CONSTANT = ROOT * (PRIME * ROOT + 1)
LEADING: dict[str, Case] = {
    f"p x^2 + {one}, p x^2 + {other} with p = 2^127 - 1": (
        partial(
            _system,
            "x,y",
            [f"{PRIME}*x^2+{each}-{CONSTANT}" for each in (one, other)],
            [[Fraction(-PRIME * ROOT - 1, PRIME)] * 2, [ROOT] * 2],
            [1, 1],
            [["1 0", "1 1", "0"]],
        ),
        ACCEPTED,
    )
    for one, other in ("xy", "yx")
}

# Polynomials that are dependent modulo a prime, the last or the first of them of the others

A, B = 3**100, 5**70
ONE, OTHER = f"x*y-{A}*x+{A - 1}", f"x*y-{B}*y+{B - 1}"
THIRD = f"{B}*y-{A}*x+{PRIME}*z+{A - B - PRIME}"
DEPENDENT: dict[str, Case] = {
    f"polynomials that are dependent modulo 2^127 - 1, the {name} of the others": (
        lambda texts=texts: system_content(  # type: ignore[misc]
            "x,y,z",
            texts,
            claim="positive-dimensional-proved",
            representation=represented([(1, 1, 1)], (1, 0, 0)),
            witness={"cause": "fewer-polynomials", "forms": [], "slices": []},
        ),
        REJECTED,
    )
    for name, texts in (("last", (ONE, OTHER, THIRD)), ("first", (THIRD, ONE, OTHER)))
}

# A row whose numbers, over the first, are no small fractions modulo the first prime, though six combinations are 0

HIDDEN = (
    *(67956373001590533229459338, -795819047774331344277647578, 681945822573107668004544524),
    *(211880969149941273787118010, -336340513227041437296476414, 1166781352978442131852174025),
    *(-417910069005219879435966347, -420723554688355596991422224, -157771333008133348871783334),
)
"""Of x^8, .., 1; their sum is 0. The combinations are those by which the first checker seeks a denominator."""
HIDING: dict[str, Case] = {
    "a polynomial whose combinations hide its denominator": (
        lambda: system_content(
            "x,y",
            ("+".join(f"{c}*x^{8 - k}" for k, c in enumerate(HIDDEN)).replace("+-", "-").replace("*x^0", ""),),
            claim="positive-dimensional-proved",
            representation=represented([(1, 0)], (1, 0)),
            witness={"cause": "fewer-polynomials", "forms": [], "slices": []},
        ),
        ACCEPTED,
    ),
}

# Steps that name an unknown that there is not

STEPS: dict[str, Case] = {
    f"a step {text}": (partial(_system, "x,y", CONICS[0], [(0, 0)], [3], [[text], *ENOUGH]), REJECTED)
    for text in ("0 2", "0 0 2", "0 15")
}

# A double point at each of some heights, where a plane touches itself

HEIGHTS: dict[str, Case] = {
    "multiplicity 4 at heights that differ by 2^-100": (
        partial(
            _system,
            "z,x,y",
            ("x^2-y", "y^2", f"{1 << 100}*z^2-z"),
            [(0, 0, 0), (Fraction(1, 1 << 100), 0, 0)],
            [4, 4],
            [],
            110,
        ),
        ACCEPTED,
    ),
}


# Translations in a plane with a pose at which x^2 + y^2 = 1 and 2 x^2 + (y + 1)^2 = 4 meet four times


def _four_times(scale: Fraction, multiplicity: int = 4, parameter: int = 0) -> Content:
    """The pose (0, 1), in other units; the parameter is that coordinate so many times."""
    pose = Pose((1, 0, 0, 0), (0, 0, scale, 0))
    constraints: list[Constraint] = [
        pose.axis_distance((0, 0, 0), (0, 0, 1), (0, 0, 0)),
        pose.axis_distance((0, 0, scale), (0, 1, 1), (0, 0, 0)),
        pose.in_plane((0, 0, 1), (0, 0, 0)),
    ]
    content = listing("translation", [pose], constraints, multiplicity, multiplicity)
    if parameter:
        point = [Fraction(x) for x in pose.e], [Fraction(x) for x in pose.f]
        form = (0, 0, 0, 0, 0, 0, parameter, 0)
        set_representation(content, representation_through([parameter * scale], [point]), form)
        fit_real_poses(content, multiplicity)
    counts = {"complex_solutions": multiplicity, "distinct_solutions": 1}
    return content | counts | complete("exact-elimination", multiplicity, elimination=[])


def _open_algebra(number: int) -> Content:
    """The pose (0, 1) alone, of two ellipses that touch there; the elimination stops before its matrices commute."""
    pose = Pose((1, 0, 0, 0), (0, 0, 1, 0))
    constraints: list[Constraint] = [
        pose.axis_distance((0, 0, 0), (0, 0, 1), (0, 0, 0)),
        pose.axis_distance((-1, 1, -2), (1, 1, 1), (0, 0, 0)),
        pose.in_plane((0, 0, 1), (0, 0, 0)),
    ]
    counts = {"complex_solutions": number, "distinct_solutions": 1}
    content = listing("translation", [pose], constraints, 2, 2)
    return content | counts | complete("exact-elimination", number, elimination=[["0 1 1", "1 0 1"]])


SCALES = {
    "1": Fraction(1),
    "1/(2^127 - 1)": Fraction(1, PRIME),
    "1/(2^63 - 25)": Fraction(1, (1 << 63) - 25),
    "1/3^100": Fraction(1, 3**100),
}
"""The primes are those that the checkers try first."""
MULTIPLE: dict[str, Case] = {
    **{
        f"a pose of multiplicity 4, in units of {name}, at {parameter} times its place": (
            partial(_four_times, scale, 4, parameter),
            ACCEPTED,
        )
        for name, scale in SCALES.items()
        for parameter in (0, 1)
    },
    **{
        f"a pose of multiplicity 4, said to be {number}": (partial(_four_times, Fraction(1), number), REJECTED)
        for number in (3, 5)
    },
    **{f"a double pose alone, said to be {number}": (partial(_open_algebra, number), REJECTED) for number in (2, 5)},
}

ALGEBRAS: dict[str, Case] = {**COMMUTING, **FILLED, **LEADING, **DEPENDENT, **HIDING, **STEPS, **HEIGHTS, **MULTIPLE}
