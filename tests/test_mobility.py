"""How mechanisms can move: the examples of the sources, corrected where they are wrong."""

import json
from dataclasses import replace
from fractions import Fraction
from functools import cache
from pathlib import Path
from typing import Any

import pytest

from pkm_exact import Screw, ScrewSystem, mobility_of, read_linkage
from pkm_exact.cli.main import main
from pkm_exact.geometry.joint_types import JointGeometry
from pkm_exact.geometry.linkage import Joint, Linkage
from pkm_exact.mobility.actuation import actuation
from pkm_exact.mobility.analysis import LinkageMobility
from pkm_exact.mobility.closure_series import higher_order
from pkm_exact.mobility.finite_mobility import Argument, finite
from pkm_exact.mobility.instantaneous_mobility import instantaneous
from pkm_exact.mobility.local_ring import local_degree
from pkm_exact.mobility.motion_series import motion_series
from pkm_exact.mobility.rational_directions import rational_directions
from pkm_exact.mobility.second_order import cone_dimension, section_vectors

ROOT = Path(__file__).parent.parent
CHAINS = ROOT / "models" / "chains"
ORIGIN = (Fraction(0),) * 3


@cache
def found(name: str) -> LinkageMobility:
    """The mobility of a shipped mechanism."""
    return mobility_of(read_linkage(CHAINS / f"{name}.toml"))


def _hinges(points: list[tuple[object, ...]], axes: list[tuple[object, ...]], cut: int | None = None) -> Linkage:
    """A closed loop of hinges; the platform is the body behind as many of them."""
    count = len(points)
    bodies = tuple(f"b{k}" for k in range(count))
    joints = tuple(
        Joint(
            f"j{k}",
            "R",
            (bodies[k], bodies[(k + 1) % count]),
            JointGeometry(tuple(map(Fraction, points[k])), (tuple(map(Fraction, axes[k])),)),
        )
        for k in range(count)
    )
    return Linkage("loop", "1", "a test", bodies, joints, "b0", bodies[cut or count // 2])


@pytest.mark.parametrize(
    ("name", "rank", "total", "counted", "platform", "argument"),
    [
        ("3-pprr", 8, 4, 0, "1 translation along (0, 0, 1)", "subgroups"),
        ("sarrus", 5, 1, 0, "1 translation along (0, 0, 1)", "subgroups"),
        ("seven-link", 5, 2, 1, "1 translation along (0, 0, 1)", "subgroups"),
        (
            *("bricard", 5, 1, 0),
            *("1 screw motion of pitch 24/5 about an axis along (2, 1, 0) through (0, 0, -7/5)", "real curves"),
        ),
        ("peaucellier", 9, 1, -8, "1 rotation about an axis along (0, 0, 1) through (96/37, 6, 0)", "regular"),
        ("3-prrr", 9, 3, 0, "3 translations in all directions", "subgroups"),
        ("3-upu", 12, 3, 3, "3 translations in all directions", "regular"),
        (
            "5-rrr-rr",
            20,
            5,
            1,
            "2 translations perpendicular to (0, 0, 1), 3 rotations about axes in all directions through (0, 0, 0)",
            "subgroups",
        ),
    ],
)
def test_mobilities_of_the_shipped_mechanisms(
    name: str, rank: int, total: int, counted: int, platform: str, argument: str
) -> None:
    free, proved = found(name).free, found(name).finite
    assert (free.rank, free.total, free.counted) == (rank, total, counted)
    assert str(free.platform.free_motions()) == platform
    assert (proved.least, proved.most, proved.argument) == (total, total, argument)
    assert proved.platform_least == proved.platform_most == free.platform.rank


# 3-PPRR: the source's equations (16) to (24).


@pytest.mark.parametrize(
    ("actuated", "mobility", "platform"),
    [
        (["A1"], 3, 1),
        (["A1", "B2"], 2, 1),
        (["A1", "RB1"], 3, 1),
        (["A1", "A2", "A3"], 1, 1),
        (["A1", "B1"], 2, 0),
        (["A2", "B2"], 2, 0),
        (["A1", "A2", "A3", "B1"], 0, 0),
        (["A1", "A2", "A3", "B3"], 0, 0),
    ],
)
def test_actuators_of_3_pprr(actuated: list[str], mobility: int, platform: int) -> None:
    done = actuation(found("3-pprr").free, actuated)
    assert (done.left, done.left_of_platform) == (mobility, platform)


def test_the_platform_of_3_pprr_is_held_by_its_common_slide_and_another_joint_of_the_leg() -> None:
    sets = found("3-pprr").hold_platform
    assert sets.is_complete
    assert {frozenset(names) for names in sets.sets} == {
        frozenset((f"B{leg}", f"{other}{leg}")) for leg in (1, 2, 3) for other in ("A", "RB", "RC")
    }
    every = found("3-pprr").hold_mechanism
    assert every.is_complete
    assert {len(names) for names in every.sets} == {4}
    assert ("A1", "A2", "A3", "B1") in {tuple(sorted(names)) for names in every.sets}


def test_the_constraints_of_a_leg_of_3_pprr_are_those_of_the_source() -> None:
    leg = found("3-pprr").legs[0]
    e_a, e_b = (1, 0, 0), (0, 0, 1)
    assert (leg.freedoms, leg.twists.rank) == (4, 3)
    expected = [Screw.couple(e_a), Screw.couple(e_b), Screw.line((20, 0, 10), (0, 1, 0))]
    assert leg.constraints == ScrewSystem.span(expected)


# Sarrus's six-bar and the seven-link mechanism.


def test_sarrus_has_passive_freedoms_nowhere_and_any_joint_holds_it() -> None:
    sarrus = found("sarrus")
    assert sarrus.free.passive == ()
    assert sarrus.free.overconstraint == 1
    assert sarrus.hold_platform.sets == (("A",), ("B",), ("C",), ("F",), ("E",), ("D",))
    assert sarrus.counted_with_common == 1


def test_parallel_chains_are_no_sarrus_linkage() -> None:
    """At alpha = 0 the mechanism is planar: mobility 3."""
    x = (1, 0, 0)
    points = [(0, 3, 0), (0, 5, 2), (0, 3, 4), (4, -3, 4), (8, -6, 2), (4, -3, 0)]
    assert instantaneous(_hinges(points, [x] * 6)).total == 3


def test_the_seven_link_mechanism_turns_to_the_first_order_only() -> None:
    oblique = found("seven-link-oblique")
    assert (oblique.free.total, oblique.free.platform.rank) == (2, 2)
    proved = oblique.finite
    assert (proved.least, proved.most, proved.argument, proved.locked) == (1, 1, Argument.SECOND_ORDER, ("G",))
    assert found("seven-link").free.passive == (("F", "E", "D", "G"),)


# 5-RRR(RR): chapter 22.


def test_five_legs_with_a_common_force() -> None:
    spine = found("5-rrr-rr")
    assert str(spine.common.constraints()) == "1 force along (0, 0, 1) through (0, 0, 0)"
    assert (spine.common.rank, spine.counted_with_common) == (1, 5)
    assert (spine.locked.total, spine.locked.platform.rank) == (0, 0)


def test_legs_that_are_alike_leave_two_freedoms_when_locked() -> None:
    alike = found("5-rrr-rr-alike")
    assert alike.free.platform.rank == 5
    # The wrenches that five locked legs transmit have rank 4.
    assert alike.locked.platform.reciprocal().rank == 4
    lines = ScrewSystem(())
    for leg in alike.legs:
        locked = mobility_of(leg.linkage, [leg.linkage.joints[0].name]).locked
        lines = lines | locked.platform.reciprocal()
    assert lines.rank == 4
    assert (alike.actuation.degree, alike.actuation.redundancy) == (3, 2)


def test_sets_that_are_too_many_are_not_called_all() -> None:
    assert not found("5-rrr-rr").hold_platform.is_complete
    some = mobility_of(read_linkage(CHAINS / "5-rrr-rr.toml"), among=["R11", "R21", "R31", "R41", "R51", "R12"])
    assert some.hold_platform.is_complete
    assert ("R11", "R21", "R31", "R41", "R51") in some.hold_platform.sets


# Finite mobility where rank alone says nothing.


def test_two_bars_in_a_line_are_rigid() -> None:
    """A triangle without height: one freedom to the first order, none in truth."""
    z = (0, 0, 1)
    line = _hinges([(0, 0, 0), (1, 0, 0), (3, 0, 0)], [z] * 3)
    assert (instantaneous(line).total, cone_dimension(instantaneous(line))) == (1, 0)
    proved = finite(instantaneous(line))
    assert (proved.least, proved.most, proved.argument) == (0, 0, Argument.SECOND_ORDER)
    triangle = _hinges([(0, 0, 0), (1, 0, 0), (3, 1, 0)], [z] * 3)
    assert finite(instantaneous(triangle)).argument == Argument.REGULAR


def test_a_flat_parallelogram_has_a_motion_of_one_freedom() -> None:
    """It has two motions, as parallelogram and as contraparallelogram, through the same configuration."""
    z = (0, 0, 1)
    flat = instantaneous(_hinges([(0, 0, 0), (1, 0, 0), (4, 0, 0), (3, 0, 0)], [z] * 4))
    proved = finite(flat)
    assert flat.total == 2
    assert (proved.least, proved.most, proved.argument) == (1, 1, Argument.SECOND_ORDER)
    longest = instantaneous(_hinges([(0, 0, 0), (1, 0, 0), (3, 0, 0), (6, 0, 0)], [z] * 4))
    assert longest.total == 2
    assert finite(longest).least == finite(longest).most == 0


@cache
def bennett() -> Linkage:
    """Bennett's linkage: a square folded about a diagonal, each hinge perpendicular to its two links."""
    points = [(1, 0, 0), (0, 1, 1), (-1, 0, 0), (0, -1, 1)]
    axes = []
    for k in range(4):
        before, here, after = (points[(k + j) % 4] for j in (-1, 0, 1))
        u, v = ([a - b for a, b in zip(other, here, strict=True)] for other in (before, after))
        axes.append((u[1] * v[2] - u[2] * v[1], u[2] * v[0] - u[0] * v[2], u[0] * v[1] - u[1] * v[0]))
    return _hinges(points, axes)


def test_bennett_s_linkage_moves_along_a_rational_curve() -> None:
    """To the second order nothing decides; half tangents that are rational functions do."""
    found = instantaneous(bennett())
    assert (found.total, found.counted) == (1, -2)
    assert cone_dimension(found) == 1
    proved = finite(found)
    assert (proved.least, proved.most, proved.argument) == (1, 1, Argument.CURVE)
    assert (proved.platform_least, proved.platform_most) == (1, 1)
    written = read_linkage(CHAINS / "bennett.toml")
    assert [joint.twists for joint in written.joints] == [joint.twists for joint in bennett().joints]


THIRD = (
    [(0, 1, -1), (0, -1, 0), (0, 1, 1), (-1, 0, 1), (0, 1, 0)],
    [(1, 0, 1), (1, 1, 0), (1, 0, 1), (1, 0, 0), (1, -1, 0)],
)
FOURTH = (
    [(1, 0, 1), (-1, 0, 0), (-1, 0, -1), (-1, -1, 1), (0, -1, 0), (1, 1, -1)],
    [(1, 0, 0), (1, 1, 0), (1, 1, 0), (1, -1, 0), (1, -1, 0), (1, 0, 0)],
)


@pytest.mark.parametrize(("hinges", "order"), [(THIRD, 3), (FOURTH, 4)])
def test_loops_that_are_rigid_in_the_third_and_fourth_order(hinges: Any, order: int) -> None:
    found = instantaneous(_hinges(*hinges))
    assert (found.total, cone_dimension(found)) == (1, 1)
    proved = finite(found)
    assert (proved.least, proved.most, proved.argument) == (0, 0, Argument.HIGHER_ORDER)
    series = higher_order(found)
    assert series is not None
    assert len(series.terms) + 1 == order


def with_arm() -> Linkage:
    """Bennett's linkage, and a body that turns on one of its links: the series are those of one freedom only."""
    linkage = bennett()
    arm = Joint("arm", "R", ("b1", "arm"), JointGeometry(ORIGIN, ((Fraction(1), Fraction(2), Fraction(2)),)))
    return replace(linkage, bodies=(*linkage.bodies, "arm"), joints=(*linkage.joints, arm), platform="arm")


def test_parts_that_share_no_loop_move_by_themselves() -> None:
    proved = finite(instantaneous(with_arm()))
    assert (proved.least, proved.most, proved.argument) == (2, 2, Argument.CURVES)
    assert (proved.platform_least, proved.platform_most) == (2, 2)
    assert [[bool(speed) for speed in curve.speeds] for curve in proved.curves] == [
        [True] * 4 + [False],
        [False] * 4 + [True],
    ]


def test_bricard_s_loops_move_along_curves_that_are_not_rational() -> None:
    """Line-symmetric, as shipped, and plane-symmetric: hinges 0 and 3 are in the plane, the others mirrored."""
    proved = found("bricard").finite
    assert (proved.least, proved.most, proved.argument) == (1, 1, Argument.CURVES)
    assert len(proved.curves[0].relation) == 3
    points, axes = [(0, 0, 0), (1, 2, 1), (3, 3, 2), (5, 1, 0)], [(1, 2, 0), (1, 0, 1), (2, 1, -1), (1, -3, 0)]
    mirrored = [(x, y, -z) for x, y, z in points[2:0:-1]], [(-x, -y, z) for x, y, z in axes[2:0:-1]]
    loop = instantaneous(_hinges([*points, *mirrored[0]], [*axes, *mirrored[1]]))
    assert loop.total == 1
    assert finite(loop).argument == Argument.CURVES


SEVEN = (
    [(0, -1, 0), (0, 1, 1), (-1, 0, 0), (0, -1, 1), (0, -1, 0), (-1, -1, -1), (0, 1, 1)],
    [(1, 1, -1), (0, -1, 0), (1, -1, 1), (1, 0, 1), (-1, -1, 0), (-1, 1, -1), (0, -1, 0)],
)
"""Seven hinges with two freedoms to the second order, one of which goes on."""


def _sharing(one: Linkage, other: Linkage) -> Linkage:
    """Two loops with their first hinges in common."""
    names = {body: body if k < 2 else f"c{body}" for k, body in enumerate(other.bodies)}
    joints = tuple(
        replace(joint, name=f"c{joint.name}", bodies=(names[joint.bodies[0]], names[joint.bodies[1]]))
        for joint in other.joints[1:]
    )
    return replace(
        one, bodies=(*one.bodies, *(names[body] for body in other.bodies[2:])), joints=(*one.joints, *joints)
    )


def test_loops_that_share_a_hinge() -> None:
    """Bennett's with a planar four-bar about its first axis; a spherical one with a planar one; two parallelograms."""
    about = [(1 + y, x, -y) for x, y in ((0, 0), (3, 1), (5, 4), (1, 3))]
    coupled = finite(instantaneous(_sharing(bennett(), _hinges(about, [(-2, 0, -2)] * 4))))
    assert (coupled.least, coupled.most, coupled.argument) == (1, 1, Argument.CURVES)
    z = (0, 0, 1)
    spherical = _hinges([(0, 0, 0)] * 4, [z, (1, 0, 1), (1, 2, 3), (0, 1, 1)])
    planar = _hinges([(0, 0, 0), (3, 1, 0), (5, 4, 0), (1, 3, 0)], [z] * 4)
    assert finite(instantaneous(_sharing(spherical, planar))).argument == Argument.REGULAR
    flat = [_hinges([(x, 0, 0) for x in places], [z] * 4) for places in ((0, 1, 4, 3), (0, 1, 6, 5))]
    folded = instantaneous(_sharing(*flat))
    assert folded.total == 3
    assert (finite(folded).least, finite(folded).most, finite(folded).argument) == (1, 1, Argument.CURVES)


def test_goldberg_s_loop_of_two_of_bennett_s() -> None:
    """Its links on one side of a common link, and those turned about the middle of that link by half a turn."""
    points, axes = ([tuple(map(Fraction, v)) for v in table] for table in (SQUARE, SQUARE_AXES))
    middle, along = tuple((a + b) / 2 for a, b in zip(points[2], points[3], strict=True)), (1, -1, -2)

    def turned(v: Any) -> Any:
        factor = 2 * sum(a * b for a, b in zip(v, along, strict=True)) / sum(a * a for a in along)
        return [factor * a - b for a, b in zip(along, v, strict=True)]

    arms = [[x - m for x, m in zip(point, middle, strict=True)] for point in points[:2]]
    others = [tuple(a + b for a, b in zip(turned(arm), middle, strict=True)) for arm in arms]
    turned_axes = [tuple(turned(axis)) for axis in axes[:2]]
    loop = instantaneous(_hinges([*points[:3], *others], [*axes[:3], *turned_axes]))
    assert (loop.total, loop.counted) == (1, -1)
    assert (finite(loop).least, finite(loop).argument) == (1, Argument.CURVE)


SQUARE = [(1, 0, 0), (0, 1, 1), (-1, 0, 0), (0, -1, 1)]
SQUARE_AXES = [(-2, 0, -2), (0, 2, -2), (2, 0, -2), (0, -2, -2)]


def test_rational_directions_of_two_forms() -> None:
    """x^2 = y^2 and x y = z^2 at (1, 1, 1), (1, 1, -1); x^2 = 2 y^2 nowhere; one form in three unknowns not at all."""
    one, two = {(0, 0): Fraction(1), (1, 1): Fraction(-1)}, {(0, 1): Fraction(1), (2, 2): Fraction(-1)}
    assert {tuple(map(int, y)) for y in rational_directions([one, two], 3)} == {(1, 1, 1), (-1, -1, 1)}
    assert rational_directions([{(0, 0): Fraction(1), (1, 1): Fraction(-2)}], 2) == []
    assert rational_directions([one], 3) == [(-1, 1, 0), (1, 1, 0)]


def test_the_local_ring_bounds_what_the_second_order_does_not() -> None:
    singular = instantaneous(_hinges(*SEVEN))
    assert (singular.total, cone_dimension(singular)) == (2, 2)
    proved = finite(singular)
    assert (proved.least, proved.most, proved.argument) == (1, 1, Argument.LOCAL_RING_AND_CURVES)
    twice = instantaneous(_two_loops(THIRD))
    assert (twice.total, cone_dimension(twice)) == (2, 2)
    proved = finite(twice)
    assert (proved.least, proved.most, proved.argument) == (0, 0, Argument.LOCAL_RING)


def _two_loops(hinges: Any) -> Linkage:
    """A loop, and the same loop again on its second body."""
    loop = _hinges(*hinges)
    names = {body: f"c{body}" if body != "b0" else "b1" for body in loop.bodies}
    again = tuple(
        replace(joint, name=f"c{joint.name}", bodies=(names[joint.bodies[0]], names[joint.bodies[1]]))
        for joint in loop.joints
    )
    return replace(
        loop, bodies=(*loop.bodies, *(f"c{body}" for body in loop.bodies[1:])), joints=(*loop.joints, *again)
    )


def test_a_multiple_of_the_half_tangents_is_no_motion_of_the_others() -> None:
    """The series of the fourth-order loop leave it, modulo primes as over the rational numbers."""
    loop = instantaneous(_hinges(*FOURTH))
    prime = 2**61 - 1
    assert motion_series(loop, prime, 3) is not None
    assert motion_series(loop, prime, 4) is None
    assert local_degree(loop, section_vectors(1, 0)) == 4


def test_what_is_not_decided_has_bounds() -> None:
    """The form of the second order is a square: nothing is seen from below."""
    proved = finite(instantaneous(_hinges(*CUSP)))
    assert (proved.least, proved.most, proved.argument, proved.is_known) == (0, 1, Argument.NONE, False)


CUSP = (
    [(0, 0, -1), (1, 0, 1), (-1, 0, 0), (0, 1, -1), (-1, 1, 0), (1, 0, 0), (-1, 1, 0)],
    [(1, 0, -1), (0, 0, 1), (0, 1, 0), (-1, -1, 1), (1, 1, 0), (-1, -1, 0), (-1, 0, 0)],
)


def test_the_platform_moves_as_its_legs_can() -> None:
    """A hinge by itself is a leg; the other one has five freedoms more, but the platform only turns."""
    ball, up = JointGeometry((Fraction(1), Fraction(2), Fraction(3))), (Fraction(0), Fraction(0), Fraction(1))
    joints = (
        Joint("a", "S", ("base", "x"), ball),
        Joint("b", "S", ("x", "y"), JointGeometry(ORIGIN)),
        Joint("c", "S", ("y", "top"), JointGeometry((Fraction(0), Fraction(5), Fraction(0)))),
        Joint("d", "R", ("top", "base"), JointGeometry(ORIGIN, (up,))),
    )
    proved = finite(instantaneous(Linkage("legs", "1", "a test", ("base", "x", "y", "top"), joints, "base", "top")))
    assert (proved.least, proved.platform_least, proved.platform_most) == (4, 1, 1)


def test_a_joint_that_cannot_move_is_named() -> None:
    line = _hinges([(0, 0, 0), (1, 0, 0), (3, 1, 0)], [(0, 0, 1)] * 3)
    assert instantaneous(line).still == ("j0", "j1", "j2")


def test_a_serial_chain_has_the_mobility_of_its_joints() -> None:
    leg = found("3-upu").legs[0].linkage
    alone = mobility_of(leg)
    assert (alone.free.total, alone.free.counted, alone.free.platform.rank) == (5, 5, 5)
    assert alone.finite.argument == Argument.REGULAR


# Invariance: results do not depend on how the mechanism is written down.


@pytest.mark.parametrize("name", ["3-pprr", "seven-link-oblique", "5-rrr-rr-alike", "peaucellier"])
def test_order_and_direction_of_joints_do_not_matter(name: str) -> None:
    linkage = read_linkage(CHAINS / f"{name}.toml")
    turned = tuple(
        replace(joint, bodies=joint.bodies[::-1]) if k % 2 and len(joint.twists) == 1 else joint
        for k, joint in enumerate(linkage.joints[::-1])
    )
    one, other = found(name).free, instantaneous(replace(linkage, joints=turned))
    assert (one.rank, one.total, one.platform) == (other.rank, other.total, other.platform)
    assert finite(other).least == found(name).finite.least


@pytest.mark.parametrize("name", ["3-pprr", "sarrus", "seven-link-oblique"])
def test_a_rigid_motion_moves_everything_along(name: str) -> None:
    linkage = read_linkage(CHAINS / f"{name}.toml")

    def turned(v: tuple[Fraction, ...]) -> tuple[Fraction, ...]:
        x, y, z = v
        return ((2 * x - y + 2 * z) / 3, (2 * x + 2 * y - z) / 3, (-x + 2 * y + 2 * z) / 3)

    def moved(v: tuple[Fraction, ...]) -> tuple[Fraction, ...]:
        x, y, z = turned(v)
        return (x + 5, y - 7, z + Fraction(1, 3))

    joints = tuple(
        replace(joint, geometry=JointGeometry(moved(joint.geometry.point), tuple(map(turned, joint.geometry.axes))))
        for joint in linkage.joints
    )
    other = instantaneous(replace(linkage, joints=joints))
    one = found(name)
    assert (other.rank, other.total, other.platform.rank) == (one.free.rank, one.free.total, one.free.platform.rank)
    assert finite(other).argument == one.finite.argument
    motions, before = other.platform.free_motions(), one.free.platform.free_motions()
    assert len(motions.translations) == len(before.translations)


# The command.


def test_the_command_says_it_as_json(capsys: pytest.CaptureFixture[str]) -> None:
    code = main(["mobility", str(CHAINS / "3-pprr.toml"), "--actuated", "A1,B1", "--json"])
    answer = json.loads(capsys.readouterr().out)
    assert code == 0
    assert answer["instantaneous"]["mobility"] == 4
    assert answer["finite"] == {
        "mobility": 4,
        "least": 4,
        "most": 4,
        "argument": "subgroups",
        "locked": [],
        "platform": {"least": 1, "most": 1},
    }
    assert answer["actuation"]["locked"]["platform"]["number"] == 0
    assert answer["actuator_sets"]["platform"]["complete"]


@pytest.mark.parametrize(
    ("words", "sentence"),
    [
        (["chains/sarrus.toml", "--at", "0,0,0,1,0,0,0"], "--at: a mechanism of bodies and joints stands as its file"),
        (["chains/sarrus.toml", "--actuated", "Q"], "actuated: 'Q' is not the name of a joint"),
        (["chains/sarrus.toml", "--among", "Q"], "among: 'Q' is not the name of a joint"),
        (["mssm.toml", "--among", "leg 1"], "--among: belongs to mechanisms of bodies and joints"),
        (["mssm.toml", "--actuated", "leg 7"], "actuated: 'leg 7' is not one of the model's"),
        (["mssm.toml", "--at", "0,0,1"], "--at: 3 numbers given; give 7"),
        (["mssm.toml", "--at", "0,0,1,0,0,0,0"], "all four numbers are 0"),
        (["3-rps.toml", "--at", "5,5,5,1,1,1,1"], "does not hold at this pose"),
        (["hexa.toml", "--at", "0,0,1,1,0,0,0"], "has not its length at this pose"),
        (["h4.toml", "--at", "0,0,1,1,1,0,0"], "is not among the translations, and turns about the third axis"),
    ],
)
def test_bad_questions_are_refused_in_one_sentence(
    words: list[str], sentence: str, capsys: pytest.CaptureFixture[str]
) -> None:
    assert main(["mobility", str(ROOT / "models" / words[0]), *words[1:]]) == 2
    captured = capsys.readouterr()
    assert sentence in captured.err
    assert [line for line in captured.err.splitlines() if ": note: " not in line] == captured.err.splitlines()[-1:]
    assert captured.out == ""


def test_what_is_not_known_has_an_exit_code_of_its_own(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    linkage = _hinges(*CUSP)
    text = 'schema = 1\nname = "folded"\nkind = "chains"\nunit = "1"\nsource = "a test"\n'
    text += "".join(f'[[bodies]]\nname = "{body}"\n' for body in linkage.bodies)
    for joint in linkage.joints:
        point, axis = ([int(x) for x in v] for v in (joint.geometry.point, joint.geometry.axes[0]))
        text += f'[[joints]]\nname = "{joint.name}"\ntype = "R"\nbodies = {json.dumps(joint.bodies)}\n'
        text += f"point = {point}\naxis = {axis}\n"
    (tmp_path / "flat.toml").write_text(text)
    assert main(["mobility", str(tmp_path / "flat.toml")]) == 3
    assert "not known, 0 to 1" in capsys.readouterr().out
