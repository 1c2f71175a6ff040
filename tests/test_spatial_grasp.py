"""Grasps in space: grasp matrices, internal forces, and closure by friction with a proof either way."""

from fractions import Fraction
from random import Random

import pytest

from pkm_exact.errors import InputError
from pkm_exact.polytopes.rationals import as_fraction, rational_matrix
from pkm_exact.screws.screw import dot
from pkm_exact.statics.forces import has_positive_vector
from pkm_exact.statics.friction_closure import Closure, friction_closure
from pkm_exact.statics.ranks import left_kernel
from pkm_exact.statics.spatial_grasp import (
    SpatialContact,
    is_never_opposed,
    is_within_cone,
    spatial_grasp_matrix,
    spatial_internal_forces,
)


def contact(point: str, normal: str, friction: str = "0", torsion: str | None = None) -> SpatialContact:
    x, y, z = map(Fraction, point.split())
    u, v, w = map(Fraction, normal.split())
    return SpatialContact((x, y, z), (u, v, w), Fraction(friction), None if torsion is None else Fraction(torsion))


def fingers(height: str, torsion: str | None) -> list[SpatialContact]:
    """Two that press on parallel faces, one higher than the other; friction 1/5."""
    return [contact("-1 0 0", "3 0 0", "1/5", torsion), contact(f"1 {height} 0", "-2 0 0", "1/5", torsion)]


TRIPOD = ("0 1 0", "3/5 -4/5 0", "-3/5 -4/5 0")


def tripod(friction: str) -> list[SpatialContact]:
    """Three hard fingers about a disc, whose normals meet in its middle."""
    return [contact(p, " ".join(str(-Fraction(x)) for x in p.split()), friction) for p in TRIPOD]


GRASPS = {
    "two soft fingers": (fingers("0", "1/10"), Closure.CLOSED),
    "two soft fingers, line in both cones": (fingers("39/100", "1/10"), Closure.CLOSED),
    "two soft fingers, line on both cones": (fingers("2/5", "1/10"), Closure.OPEN),
    "two soft fingers, line out of both cones": (fingers("41/100", "1/10"), Closure.OPEN),
    "two soft fingers without torsional friction": (fingers("0", "0"), Closure.OPEN),
    "two hard fingers": (fingers("0", None), Closure.OPEN),
    "three hard fingers": (tripod("1/100"), Closure.CLOSED),
    "three hard fingers without friction": (tripod("0"), Closure.OPEN),
    "three hard fingers on a line": ([contact(f"{x} 0 0", f"0 0 {z}", "1") for x, z in ((-1, 1), (0, -1), (1, 1))],
                                     Closure.OPEN),
    "three fingers that push one way": ([contact(p, "0 0 1", "1/5") for p in TRIPOD], Closure.OPEN),
    "three fingers, two of which hold, one turns": ([*fingers("0", None), contact("0 5 0", "0 0 1")], Closure.OPEN),
    "seven without friction": ([contact(p, n) for p, n in (
        ("-1 1/2 0", "1 0 0"), ("-1 -1/2 1/2", "1 0 0"), ("1/3 1/4 1/5", "-1 -1 -1"), ("1/2 -1 0", "0 1 0"),
        ("0 -1 1/2", "0 1 0"), ("1/2 1/2 -1", "0 0 1"), ("-1/2 1/3 -1", "0 0 1"))], None),
}  # fmt: skip


@pytest.mark.parametrize("name", GRASPS)
def test_known_grasps(name: str) -> None:
    grasp, wanted = GRASPS[name]
    found = friction_closure(grasp)
    assert wanted is None or found.verdict is wanted
    assert found.verdict is not Closure.UNDECIDED
    assert is_proved(grasp)


def test_form_closure_needs_seven_and_is_what_positive_combinations_say() -> None:
    """Without friction cones are rays: closure is decided by a linear program too."""
    verdicts = set()
    for last in ("0 -1 0", "0 0 1", "0 0 -1", "1 0 0"):
        grasp = [*GRASPS["seven without friction"][0][:6], contact("1/5 1/3 1/2", last)]
        matrix = rational_matrix(spatial_grasp_matrix(grasp))
        rays = []
        for k, c in enumerate(grasp):
            force = rational_matrix([[c.normal[j - 3 * k] if j // 3 == k else 0] for j in range(21)])
            rays.append([as_fraction(x) for x in (matrix * force).entries()])
        closed = rational_matrix(rays).rank() == 6 and has_positive_vector(left_kernel(rays))
        assert friction_closure(grasp).verdict is (Closure.CLOSED if closed else Closure.OPEN)
        assert friction_closure(grasp[:6]).verdict is Closure.OPEN
        verdicts.add(closed)
    assert verdicts == {True, False}


def test_a_verdict_has_a_proof_and_does_not_depend_on_the_frame() -> None:
    """Random grasps, turned and moved; more friction keeps what is closed."""
    random, verdicts = Random(3), []
    for _ in range(20):
        grasp = [
            contact(three(random, 9), three(random, 5, nonzero=True), rough, random.choice((None, "1/3")))
            for rough in random.choices(("1/5", "3/5", "6/5"), k=random.randint(2, 6))
        ]
        assert is_proved(grasp)
        verdict = friction_closure(grasp).verdict
        verdicts.append(verdict)
        assert verdict is not Closure.UNDECIDED
        assert friction_closure([moved(c) for c in grasp]).verdict is verdict
        rougher = [SpatialContact(c.point, c.normal, 2 * c.friction, c.torsion) for c in grasp]
        assert verdict is Closure.OPEN or friction_closure(rougher).verdict is Closure.CLOSED
    assert {Closure.OPEN, Closure.CLOSED} == set(verdicts)


def is_proved(grasp: list[SpatialContact]) -> bool:
    """Whether the proof of a verdict is one, asked anew."""
    found, rows = friction_closure(grasp), spatial_grasp_matrix(grasp)
    if found.forces is not None:
        whole = [x for force in found.forces for x in force]
        balance = all(dot(row, whole) == 0 for row in rows)
        return balance and all(map(lambda c, f: is_within_cone(c, f, strictly=True), grasp, found.forces))
    assert found.twist is not None
    works = [dot([row[k] for row in rows], found.twist) for k in range(len(rows[0]))]
    # No edge of the cones does negative work, in rational directions all around.
    least, start = [], 0
    for c in grasp:
        for t in (Fraction(k, 7) for k in range(-21, 22)):
            across = perpendicular(c, t)
            for turn in (1, -1):
                force = [n + c.friction * x for n, x in zip(c.normal, across, strict=True)]
                moment = [] if c.torsion is None else [turn * c.torsion * (1 - Fraction(1, 10**9)) / size(c.normal)]
                least.append(dot(works[start : start + c.width], [*force, *moment]))
        start += c.width
    return any(found.twist) and min(least) >= 0


def perpendicular(c: SpatialContact, t: Fraction) -> list[Fraction]:
    """Nearly all directions across a normal, of nearly its length but not above."""
    x, y, z = c.normal
    one = [-y, x, Fraction(0)] if x or y else [Fraction(1), Fraction(0), Fraction(0)]
    other = [y * one[2] - z * one[1], z * one[0] - x * one[2], x * one[1] - y * one[0]]
    cosine, sine = (1 - t * t) / (1 + t * t), 2 * t / (1 + t * t)
    shrunk = 1 - Fraction(1, 10**9)
    return [
        shrunk * size(c.normal) * (cosine * a / size(one) + sine * b / size(other))
        for a, b in zip(one, other, strict=True)
    ]


def size(vector: list[Fraction] | tuple[Fraction, ...]) -> Fraction:
    """The norm, to 1e-12."""
    return Fraction(float(dot(vector, vector)) ** 0.5).limit_denominator(10**12)


def three(random: Random, most: int, *, nonzero: bool = False) -> str:
    found = [random.randint(-most, most) for _ in range(3)]
    return " ".join(map(str, found)) if any(found) or not nonzero else "0 0 1"


def moved(c: SpatialContact) -> SpatialContact:
    """Turned by the rotation (1, 1, 1, 0), (2, 2, -1) / 3 and so on, and moved."""
    rows = [
        [Fraction(2, 3), Fraction(-1, 3), Fraction(2, 3)],
        [Fraction(2, 3), Fraction(2, 3), Fraction(-1, 3)],
        [Fraction(-1, 3), Fraction(2, 3), Fraction(2, 3)],
    ]
    x, y, z = (
        dot(row, c.point) + shift for row, shift in zip(rows, (Fraction(5), Fraction(-70), Fraction(1, 3)), strict=True)
    )
    u, v, w = (dot(row, c.normal) for row in rows)
    return SpatialContact((x, y, z), (u, v, w), c.friction, c.torsion)


def test_internal_forces_of_space_exert_nothing() -> None:
    """Five soft digits: 6 x 20; three hard fingers: grips along the three lines between them."""
    digits = [contact("-3 1 0", "1 0 0", "1", "1"), *(contact(f"3 {y} 0", "-1 0 0", "1", "1") for y in (5, 2, -1, -4))]
    for grasp, columns, nullity in ((digits, 20, 14), (tripod("1"), 9, 3), (fingers("0", None), 6, 1)):
        rows = spatial_grasp_matrix(grasp)
        assert len(rows[0]) == columns
        assert len(spatial_internal_forces(grasp)) == nullity
        assert all(dot(row, force) == 0 for row in rows for force in spatial_internal_forces(grasp))


def test_cones_are_the_true_ones_and_dual() -> None:
    soft = contact("0 0 0", "0 0 2", "3/4", "1/5")
    edge = (
        Fraction(3, 5) * Fraction(3, 4),
        Fraction(4, 5) * Fraction(3, 4),
        Fraction(1),
        Fraction(1, 10),
    )  # friction and torsion at their limits
    assert is_within_cone(soft, edge)
    assert not is_within_cone(soft, edge, strictly=True)
    for place in (0, 3):
        beyond = [x + (Fraction(1, 10**9) if k == place else 0) for k, x in enumerate(edge)]
        assert not is_within_cone(soft, beyond)
    assert not is_within_cone(soft, (Fraction(0), Fraction(0), Fraction(-1), Fraction(0)))
    # Of the dual cone: along the normal 1, across up to 4/3, less what torsion takes.
    assert is_never_opposed(soft, [Fraction(4, 3), Fraction(0), Fraction(1), Fraction(0), Fraction(0), Fraction(0)])
    assert not is_never_opposed(
        soft, [Fraction(4, 3), Fraction(0), Fraction(1), Fraction(0), Fraction(0), Fraction(1, 10**9)]
    )
    assert is_never_opposed(soft, [Fraction(2, 3), Fraction(0), Fraction(1), Fraction(0), Fraction(0), Fraction(-5, 2)])
    assert not is_never_opposed(
        soft, [Fraction(2, 3), Fraction(0), Fraction(1), Fraction(0), Fraction(0), Fraction(-5, 2) - Fraction(1, 10**9)]
    )


def test_what_is_no_contact_is_refused_in_a_sentence() -> None:
    origin, up = (Fraction(0), Fraction(0), Fraction(0)), (Fraction(0), Fraction(0), Fraction(1))
    with pytest.raises(InputError, match="its normal is 0; give the direction into the object"):
        SpatialContact(origin, origin)
    with pytest.raises(InputError, match="its friction is not a rational number from 0"):
        SpatialContact(origin, up, 0.5)  # type: ignore[arg-type]
    with pytest.raises(InputError, match="its torsion is not a rational number from 0"):
        SpatialContact(origin, up, Fraction(1), Fraction(-1))
    with pytest.raises(InputError, match="its point is not three rational numbers"):
        SpatialContact((Fraction(0), Fraction(0)), up)  # type: ignore[arg-type]
    with pytest.raises(InputError, match="no contacts; give one at least"):
        friction_closure([])
    with pytest.raises(InputError, match="3 numbers; give 4"):
        is_within_cone(SpatialContact(origin, up, torsion=Fraction(1)), up)


def test_a_grasp_at_the_limit_says_so_or_proves_it() -> None:
    """Whatever is said at a limit that is not rational, it has a proof or is not decided."""
    slack = Fraction(1, 10**14)
    for friction in (Fraction(1, 3) - slack, Fraction(1, 3), Fraction(1, 3) + slack):
        grasp = [
            SpatialContact(
                (Fraction(-1), Fraction(0), Fraction(0)), (Fraction(1), Fraction(0), Fraction(0)), friction, Fraction(1)
            ),
            SpatialContact(
                (Fraction(1), Fraction(2, 5), Fraction(8, 15)),
                (Fraction(-1), Fraction(0), Fraction(0)),
                friction,
                Fraction(1),
            ),
        ]
        found = friction_closure(grasp)  # the line is at the limit for friction 1/3
        assert found.verdict in ((Closure.CLOSED if friction > Fraction(1, 3) else Closure.OPEN), Closure.UNDECIDED)
        assert str(found).startswith(found.verdict.value)
