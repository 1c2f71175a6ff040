"""Certificates of boxes and of witnesses that differ from each other, or from the truth, in one coordinate alone."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from fractions import Fraction
from functools import partial

from certificate_subjects import Content, subject
from certificate_tools import Path_, with_entry
from forged_cores import SIX
from forged_margins import ALIKE, BASES, PLATFORMS, leg_through
from forged_margins import boxed as around
from forged_margins import off as beside
from forged_neighbours import witness_of
from forgeries import on_circle
from held_mechanisms import Pose

Case = tuple[Callable[[], Content], str]
REJECTED, ACCEPTED = "rejected", "accepted"
FIRST = (1, 0, 0, 0)


def _spatial(poses: Sequence[Pose], bits: int, exponent: int) -> Content:
    """Boxes around two poses of a robot with six legs through both."""
    return around(poses, FIRST, bits, legs=[leg_through(poses, b, a, 2) for b, a in SIX], exponent=exponent)


def _swapped(content: Content) -> Content:
    boxes = {**content["krawczyk"], "real": content["krawczyk"]["real"][::-1]}
    return {**content, "krawczyk": boxes, "poses": content["poses"][::-1]}


def _oriented() -> Content:
    return _spatial([Pose(e, (0, 0, 0, 0)) for e in ALIKE], 40, 4)


def _two_in_one() -> Content:
    """A box around one of two solutions that are 2^-200 apart; its centre makes the Jacobian nearly singular."""
    place = Pose((2, 0, 0, 1), (0, 1, 6, 0))
    close = [place, Pose((2, 0, 0, 1), (0, 1, 6 + Fraction(1, 1 << 200), 0))]
    both = around(close, FIRST, 240, legs=[leg_through(close, b, a) for b, a in zip(PLATFORMS, BASES, strict=True)])
    coarse = around([place, Pose((2, 0, 0, 1), (0, 1, 14, 0))], FIRST)["krawczyk"]["real"]
    one = {"complex_solutions": 1, "distinct_solutions": 1, "real_poses": 1, "poses": both["poses"][:1]}
    centre = both["krawczyk"]["real"][0]["centre"]
    rounded = [hex(round(Fraction(int(x, 16), 1 << 216))) for x in centre]
    return {**both, **one, "krawczyk": {**both["krawczyk"], "real": [{**coarse[0], "centre": rounded}]}}


def _upright() -> Content:
    """Two conjugate solutions at C = (4, +-2 i), R = 1: joints of a leg have the same second coordinate."""
    base, platform = [(0, 1), (-3, 4), (1, -2)], [(0, 1), (1, 4), (4, -2)]
    content = subject("planar, boxes")
    sides = {"base": base, "platform": platform}
    joints = {key: [[str(x), str(y), "0"] for x, y in side] for key, side in sides.items()}
    squares = [str((4 + c - a) ** 2 - 4) for (a, _), (c, _) in zip(base, platform, strict=True)]
    parts = ((1, 0), (0, 0), (0, 0), (0, 0), (0, 0), (4, 0), (0, 2), (0, 0))
    box = {"exponents": [28, 28], "centre": [[hex(x << 28), hex(y << 28)] for x, y in parts]}
    counts: Content = {"complex_solutions": 2, "distinct_solutions": 2, "real_poses": 0, "box_exponent": 0, "poses": []}
    return {
        **content,
        **counts,
        "robot": {**content["robot"], **joints},
        "configuration": {"name": None, "lengths_squared": squares},
        "claim": "not-proven-complete",
        "completeness_route": None,
        "krawczyk": {"chart": list(FIRST), "real": [], "complex": [box]},
    }


def _six_of_forty() -> Content:
    """As many solutions of a spatial robot as would be all of a planar one."""
    content = subject("general 6-6, boxes")
    boxes = {key: content["krawczyk"][key][:2] for key in ("real", "complex")}
    counts = {"complex_solutions": 6, "distinct_solutions": 6, "real_poses": 2, "poses": content["poses"][:2]}
    claim = {"claim": "not-proven-complete", "completeness_route": None}
    return {**content, **counts, **claim, "krawczyk": {**content["krawczyk"], **boxes}}


def _changed(name: str, path: Path_, value: Callable[[Content], object]) -> Content:
    content = {key: entry for key, entry in subject(name).items() if key != "digest"}
    return with_entry(content, path, value(content))


def _last_twice(name: str) -> Content:
    content = subject(name)
    return {**content, "poses": [*content["poses"], content["poses"][-1]], "real_poses": content["real_poses"] + 1}


def _on_lines(pose: Pose, base: tuple[int, int], platform: tuple[int, int]) -> Content:
    """Base and platform joints divide lines in one ratio: the legs are dependent but for the angle of the lines."""
    (x, y), (u, v) = base, platform
    joints = [(2 * s * x + 1, 2 * s * y, 0) for s in (0, 1, 3)], [(s * u, s * v + 2, 0) for s in (0, 1, 3)]
    return witness_of(pose, *joints)


def _half_turned(content: Content) -> list[int]:
    chart: list[int] = content["krawczyk"]["chart"]
    return [*chart[:3], chart[3] + 1]


def _less(content: Content) -> int:
    return int(content["representation"]["separating_form"][0]) - 1


def _given(value: object, _: Content) -> object:
    return value


CHART_BOXES: dict[str, Case] = {
    "boxes that differ in f3 alone": (
        lambda: _spatial([Pose(FIRST, (0, 2, 3, c)) for c in (-4, 4)], 24, 31),
        ACCEPTED,
    ),
    "poses in boxes that differ in r33 alone": (_oriented, ACCEPTED),
    "poses in boxes that differ in r33 alone, in the wrong order": (lambda: _swapped(_oriented()), REJECTED),
    **{
        f"a centre off by the limit and {sign} 2^-{bits} of a unit more": (
            partial(beside, "e0", 1 + Fraction(sign, 1 << bits), 1),
            REJECTED if sign > 0 else ACCEPTED,
        )
        for bits in (10, 20)
        for sign in (1, -1)
    },
    "a centre off by the limit exactly": (partial(beside, "e0", Fraction(1), 1), REJECTED),
    "two solutions in one box": (_two_in_one, REJECTED),
    "solutions with real and imaginary coordinates": (_upright, ACCEPTED),
    **{
        f"a pose on the grid 2^-{exponent}": (
            partial(on_circle, [(Fraction(3, 5), Fraction(4, 5))], (0, 5, 0), exponent),
            ACCEPTED,
        )
        for exponent in (900, 8000)
    },
    "a weight for e3 in a translation": (
        partial(_changed, "kept-2, cylinders, boxes", ("krawczyk", "chart"), _half_turned),
        REJECTED,
    ),
    "six solutions of a spatial robot": (_six_of_forty, ACCEPTED),
    **{
        f"boxes of 6 solutions, {total} in both counts": (
            lambda total=total: {  # type: ignore[misc]
                **subject("planar, boxes"),
                **dict.fromkeys(("complex_solutions", "distinct_solutions"), total),
            },
            REJECTED,
        )
        for total in (5, 7)
    },
    "all solutions in boxes, not called complete": (
        lambda: {**subject("planar, boxes"), "claim": "not-proven-complete", "completeness_route": None},
        REJECTED,
    ),
    **{
        f"a pose twice, {name}": (partial(_last_twice, name), REJECTED)
        for name in ("planar, boxes", "planar, representation")
    },
    "a separating form that is less": (
        partial(_changed, "planar, representation", ("representation", "separating_form", 0), _less),
        REJECTED,
    ),
    **{
        f"the format {word}": (partial(_changed, "nothing known", ("format",), partial(_given, word)), "malformed")
        for word in ("pkm_exact certificat", "A", ["A"])
    },
    **{
        f"the version {version} of a tolerance certificate": (
            partial(_changed, "tolerance-open, planar", ("version",), partial(_given, version)),
            "malformed",
        )
        for version in (0, 2, True)
    },
    "pairs, but not called complete": (
        partial(_changed, "tolerance, planar, complete", ("complete",), partial(_given, False)),
        REJECTED,
    ),
    "pairs in the wrong order": (
        partial(_changed, "tolerance, planar, complete", ("pairs",), lambda content: content["pairs"][::-1]),
        REJECTED,
    ),
    **{
        f"{total} solutions, not all proved simple": (
            partial(_changed, "unproved multiplicities", ("complex_solutions",), partial(_given, total)),
            status,
        )
        for total, status in ((40, ACCEPTED), (41, REJECTED))
    },
    **{
        f"legs on lines along {base} and {platform}, turned by {name}": (
            partial(_on_lines, Pose((*e,), (0, 3, 5, 0)), base, platform),
            REJECTED,
        )
        for name, e in (("a right angle", (1, 0, 0, 1)), ("some angle", (2, 0, 0, 1)), ("nothing", FIRST))
        for base in ((1, 0), (0, 1))
        for platform in ((1, 0), (0, 1))
    },
}
