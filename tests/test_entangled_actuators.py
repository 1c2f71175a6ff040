"""Equations with several actuators, actuators with several equations, and more actuators than equations for them."""

import json
from dataclasses import replace
from fractions import Fraction
from itertools import product
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from certificate_tools import golden
from flint import arb
from samples import model

from pkm_exact import Mechanism, read_robot
from pkm_exact.certify.statics_of_poses import at_certified_poses
from pkm_exact.cli.main import main
from pkm_exact.constraints.distance import Distance
from pkm_exact.errors import InputError
from pkm_exact.geometry.drives import Drive, Part
from pkm_exact.geometry.mechanism import LockedValues
from pkm_exact.motions.motion_groups import PLANAR
from pkm_exact.polytopes.enclosures import interval_of
from pkm_exact.radicals import RootSum
from pkm_exact.statics.at_pose import AtPose, at_box
from pkm_exact.statics.ball_zonotope import ball_zonotope
from pkm_exact.statics.freedom import Freedom
from pkm_exact.statics.matrix_ranks import matrix_ranks

Capture = pytest.CaptureFixture[str]
MODEL = Path(__file__).parent.parent / "models" / "carriage-hexapod.toml"
AT = {"position": ["3/2", 7, 9], "quaternion": [1, 0, 0, 0]}
Vector = tuple[Fraction, Fraction, Fraction]
E1, E2 = (Fraction(1), Fraction(0), Fraction(0)), (Fraction(0), Fraction(1), Fraction(0))


def vector(x: int, y: int) -> Vector:
    return Fraction(x), Fraction(y), Fraction(0)


def table(rods: list[Distance], slides: dict[str, tuple[dict[str, Vector], int]], *lengths: str) -> AtPose:
    """A planar platform at (2, 3), turned by the half tangent 1/2, on rods whose base joints slides move."""
    drives = tuple(
        Drive(name, tuple(Part(rod, "base", (way,)) for rod, way in moved.items()))
        for name, (moved, _) in slides.items()
    )
    values = tuple(next(rod.length_squared for rod in rods if rod.name == name) for name in lengths)
    stand = LockedValues("home", (*values, *(Fraction(value) for _, value in slides.values())))
    names = (*lengths, *slides)
    found = Mechanism("table", "1", "invented", tuple(rods), names, PLANAR, configurations=(stand,), drives=drives)
    return found.at({"position": [2, 3], "half_tangent": "1/2"}, configuration="home")


LEG = Distance(vector(0, 0), vector(0, 0), Fraction(13), "leg")
SECOND = Distance(vector(6, 3), vector(5, 0), Fraction(25), "second")  # its knee at (8, 3) with the slide A at 2
THIRD = Distance(vector(0, 2), vector(0, 5), Fraction(25), "third")  # at (2, 3) with A at 2 and B at 1
BOTH = {"second": E1, "third": E1}


def moves_along(at: AtPose, moved: dict[str, dict[str, Vector]]) -> bool:
    """Whether J keeps every rod as long as its actuator says, by velocities of points and nothing else."""
    rows = {name: [x.rational for x in row] for name, row in zip(at.actuated, at.exact_jacobian or (), strict=True)}
    root = RootSum.root(Fraction(13))
    rows["leg"] = [(root * x).rational for x in (at.exact_jacobian or ())[0]]  # l l'
    for column, (v, w) in enumerate((((1, 0), 0), ((0, 1), 0), ((0, 0), 1))):
        for knee, joint, name in (((0, 0), (2, 3), "leg"), ((8, 3), (5, 7), "second"), ((2, 3), (-2, 6), "third")):
            arm = joint[0] - 2, joint[1] - 3
            speed = [v[0] - w * arm[1], v[1] + w * arm[0]]
            for slide, ways in moved.items():
                for k in (0, 1):
                    speed[k] -= ways.get(name, (0, 0))[k] * rows[slide][column]
            rate = sum((joint[k] - knee[k]) * speed[k] for k in (0, 1))
            if rate != (rows["leg"][column] if name == "leg" else 0):
                return False
    return True


def test_a_slide_of_two_rods_is_not_forgotten_in_the_speed_of_another() -> None:
    """J_q has an entry beside its diagonal: the third rod moves with A as well as with B."""
    moved = {"A": BOTH, "B": {"third": E2}}
    at = table([LEG, SECOND, THIRD], {"A": (BOTH, 2), "B": ({"third": E2}, 1)}, "leg")
    assert moves_along(at, moved)
    assert float(at.J_q[2, 1]) != 0 == float(at.J_q[1, 2])
    assert (at.rank, at.singular, at.kinds.undecided) == (3, (), ())
    forces = at.forces([0, -10, 1])
    assert forces.is_unique
    assert all(sign is not None for sign in forces.signs)


def test_a_pose_in_a_box_says_the_same() -> None:
    at = table([LEG, SECOND, THIRD], {"A": (BOTH, 2), "B": ({"third": E2}, 1)}, "leg")

    class Named:
        name, unit, motion, metric = "table", "1", PLANAR, (1, 1, 1)

    place = [interval_of(x) for x in at.position], [[interval_of(x) for x in row] for row in at.rotation]
    boxed = at_box(Named, at.held, *place, None)
    for exact, balls in zip(at.jacobian.entries, boxed.jacobian.entries, strict=True):
        assert all(x.lo <= y.hi and y.lo <= x.hi for x, y in zip(exact, balls, strict=True))
    assert (boxed.rank, boxed.kinds.undecided) == (3, ())
    for one, other in zip(at.forces([1, 2, 3]).values, boxed.forces([1, 2, 3]).values, strict=True):
        assert one.lo <= other.hi
        assert other.lo <= one.hi


def test_slides_that_can_move_alone_together_are_type_1() -> None:
    """Upright, the second rod does not feel A; then A and B move the knee of the third one around its joint."""
    upright = Distance(vector(3, 2), vector(5, 0), Fraction(25), "second")
    at = table([LEG, upright, THIRD], {"A": (BOTH, 2), "B": ({"third": E2}, 1)}, "leg")
    assert at.jacobian is None
    assert [(x.name, x.constraints) for x in at.singularities] == [("type-1", ("A", "B"))]


def test_a_load_has_forces_where_a_slide_can_move_alone() -> None:
    """Type 1: no J, but the twist follows from the actuators. The load does no work with a slide that moves nothing."""
    upright = Distance(vector(3, 2), vector(5, 0), Fraction(25), "second")
    alone = replace(THIRD, base=vector(2, 3))
    at = table([LEG, upright, alone], {"A": ({"second": E1}, 2)}, "leg", "third")
    assert (at.jacobian, at.singular) == (None, ("type-1",))
    found = at.forces([1, -2, 3])
    assert (found.exact[2], found.signs[2]) == ("0", 0)
    for k, column in enumerate(zip(*at.forward.entries, strict=True)):
        work = sum(float(x) * f for x, f in zip(column, (1, -2, 3), strict=True))
        assert float(found.values[k]) == pytest.approx(-work)
    with pytest.raises(InputError, match="has no interior"):
        at.velocity_polytope(1)


def test_what_needs_j_says_so_where_there_is_none(tmp_path: Path, capsys: Capture) -> None:
    """Two slides that stand upright to their rods: type 1."""
    words = ["certs/v-shape.json", "--pose", "2", "--model", "models/v-shape.toml", "--limits", "speeds=1"]
    assert main(["plot", *words, "-o", str(tmp_path / "pose.svg")]) == 2
    assert "there is no J at this pose, by which velocities" in capsys.readouterr().err
    assert main(["statics", *words, "--load", "0,1,0", "--stiffness", "1", "-o", str(tmp_path / "statics.json")]) == 2
    assert "stiffness: T has or may have dependent rows here" in capsys.readouterr().err
    at = at_certified_poses(golden("v-shape"), model("v-shape"), [1])[0]
    assert (at.kinds.undecided, at.forward.shape) == (("type-1",), (3, 2))
    assert at.indices(speeds=1, forces=1, length=1, resolutions=1) == {}


def test_two_velocities_fill_no_volume_in_a_box() -> None:
    with pytest.raises(InputError, match="do not span the space"):
        ball_zonotope([[arb(1), arb(0), arb(0)], [arb(0), arb(1), arb(0)]], [Fraction(-1)] * 2, [Fraction(1)] * 2)


def test_a_rod_that_feels_the_slide_gives_its_speed() -> None:
    """Of two rods on one slide the first is upright: the second one moves with the slide, which cannot move alone."""
    upright = Distance(vector(3, 2), vector(5, 0), Fraction(25), "second")
    third = Distance(vector(0, 3), vector(0, 5), Fraction(25), "third")
    at = table([LEG, upright, third], {"A": (BOTH, 2)}, "leg")
    assert (at.singular, at.kinds.undecided) == ((), ())
    assert at.jacobian is not None
    assert at.J_x.rows == ("leg", "third")


def test_two_slides_of_one_rod_leave_the_third_rod_to_no_actuator() -> None:
    """More actuators than equations for them; a rod that both find upright is a row of zeros."""
    slides = {"A": ({"second": E1}, 2), "B": ({"second": E1}, 0)}
    at = table([LEG, SECOND, Distance(vector(2, 3), vector(0, 5), Fraction(25), "third")], slides, "leg")
    assert at.held.is_redundant
    assert (at.J_x.rows, at.J_q.shape, at.jacobian) == (("leg", "second"), (2, 3), None)
    assert at.singular == ()
    assert at.forward is not None
    upright = Distance(vector(3, 2), vector(5, 0), Fraction(25), "second")
    at = table([LEG, upright, Distance(vector(2, 3), vector(0, 5), Fraction(25), "third")], slides, "leg")
    assert [(x.name, x.constraints) for x in at.singularities] == [("type-1", ("second",))]


@pytest.fixture(scope="module")
def carriage() -> AtPose:
    return read_robot(MODEL).at(AT, configuration="home")


def test_the_carriage_takes_the_platform_along(carriage: AtPose) -> None:
    """A slide moves everything; the tilted arm turns everything about its axis, and the lengths stand."""
    assert carriage.J_q.shape == (6, 9)
    exact = [[Fraction(x) for x in row[6:]] for row in carriage.forward.exact]
    about = [0, -9, 3, 1, 0, 0]  # the axis along x through (.., 4, 0), the platform at (.., 7, 9)
    assert exact == [[int(k == 0), int(k == 1), about[k]] for k in range(6)]
    assert carriage.jacobian is None
    assert (carriage.rank, carriage.singular, carriage.kinds.undecided) == (6, (), ())
    with pytest.raises(InputError, match="there is no J, as speeds of the actuators do not follow from the twist"):
        Freedom(carriage)


def test_forces_do_the_work_of_the_load(carriage: AtPose) -> None:
    load = [Fraction(x) for x in (1, -2, 3, -4, 5, -6)]
    found = carriage.forces(load)
    assert found.exact is not None
    assert found.exact[6:] == ("-1", "2", str(-(-2 * -9 + 3 * 3 - 4)))
    for k, row in enumerate(zip(*carriage.forward.entries, strict=True)):
        work = sum(float(x) * float(f) for x, f in zip(row, load, strict=True))
        assert float(found.values[k]) == pytest.approx(-work)


def test_velocities_of_two_slides_and_two_lengths_are_an_image_of_a_box() -> None:
    """The plane with four actuators: each vertex of twists is at ends of the speeds."""
    slides = {"A": ({"second": E1}, 2), "B": ({"second": E2}, 0)}
    second, third = Distance(vector(6, 3), vector(5, 0), Fraction(25), "second"), replace(THIRD, base=vector(2, 3))
    at = table([LEG, second, third], slides, "leg", "third")
    found, forward = at.velocity_polytope(2), at.forward.to_numpy()
    corners = 2 * np.array(list(product((-1, 1), repeat=4))) @ forward.T
    for vertex in found.vertices:
        assert min(abs(corners - np.array(list(map(float, vertex)))).max(axis=1)) < 1e-9
    assert (len(found.vertices), len(found.facets)) == (8, 6)  # both slides move the platform alike
    wrenches = at.wrench_polytope(3)
    reach = abs(np.array([list(map(float, vertex)) for vertex in wrenches.vertices]) @ forward)
    assert reach.max() == pytest.approx(3)
    assert (np.isclose(reach, 3).sum(axis=1) >= 3).all()
    assert len(wrenches.facets) == 6


@pytest.mark.slow
def test_velocities_are_an_image_and_wrenches_its_dual(carriage: AtPose) -> None:
    """Each corner of the speeds stays inside; at each vertex of the wrenches six actuators are at a limit."""
    velocities = carriage.velocity_polytope(2)
    forward = carriage.forward.to_numpy()
    ends = 2 * np.array(list(product((-1, 1), repeat=9))) @ forward.T
    normals = np.array([list(map(float, facet.normal)) for facet in velocities.facets])
    offsets = [float(facet.offset) for facet in velocities.facets]
    assert (ends @ normals.T).max(axis=0) == pytest.approx(offsets)
    section = carriage.measures().freedom.forward.wrench_section([Fraction(-1)] * 9, [Fraction(1)] * 9, range(3))
    assert (section.dimension, len(section.facets) % 2) == (3, 0)


@pytest.mark.slow
def test_wrenches_are_where_six_actuators_are_at_a_limit(carriage: AtPose) -> None:
    forward = carriage.forward.to_numpy()
    wrenches = carriage.wrench_polytope(3)
    for vertex in wrenches.vertices:
        forces = abs(forward.T @ [float(x) for x in vertex])
        assert forces.max() == pytest.approx(3)
        assert sum(forces > 3 - 1e-9) >= 6


def test_json_has_what_is_given(capsys: Capture) -> None:
    words = ["--position", "3/2,7,9", "--quaternion", "1,0,0,0", "--configuration", "home", "--load", "0,0,-1"]
    assert main(["statics", str(MODEL), *words, "--stiffness", "100", "--format", "json"]) == 0
    found = json.loads(capsys.readouterr().out)
    assert found["given"] == ["J_x", "J_q", "T"]
    assert (len(found["J_x"]), len(found["J_q"]), len(found["J_q"][0]), found["jacobian"]) == (6, 6, 9, None)
    assert (len(found["forward"]), len(found["forward"][0])) == (6, 9)
    assert found["forces"]["exact"][8] == "3"
    assert len(found["stiffness"]) == 6
    assert found["refused"]["velocity_polytope"] == "needs limits: speeds"


@pytest.mark.slow
def test_limits_give_indices_polytopes_and_an_ellipsoid(capsys: Capture) -> None:
    limits = ["--limits", "speeds=1", "--limits", "forces=1", "--limits", "length=1"]
    words = ["--position", "3/2,7,9", "--quaternion", "1,0,0,0", "--configuration", "home"]
    assert main(["statics", str(MODEL), *words, *limits, "--format", "json"]) == 0
    found = json.loads(capsys.readouterr().out)
    assert sorted(found["indices"]) == ["condition", "manipulability", "ms", "sigma_max", "sigma_min", "transmission"]
    assert "speeds of the actuators do not follow from the twist" in found["refused"]["v_iso"]
    assert (len(found["velocity_polytope"]["facets"]), len(found["wrench_polytope"]["facets"])) == (242, 16)
    assert found["ellipsoid"] is not None


def test_a_pose_does_not_say_where_a_carriage_stands(capsys: Capture) -> None:
    words = ["statics", str(MODEL), "--position", "3/2,7,9", "--quaternion", "1,0,0,0"]
    assert main(words) == 2
    assert "a pose does not say where they are; name a configuration" in capsys.readouterr().err


def test_ranks_of_matrices_that_are_not_square(capsys: Capture) -> None:
    words = ["statics", str(MODEL), "--position", "3/2,7,9", "--quaternion", "1,0,0,0", "--configuration", "home"]
    assert main([*words, "--format", "json"]) == 0
    assert json.loads(capsys.readouterr().out)["ranks"] == {"wrenches": 6, "J_x": 6, "J_q": 6}
    upright = Distance(vector(3, 2), vector(5, 0), Fraction(25), "second")
    at = table([LEG, upright, THIRD], {"A": (BOTH, 2), "B": ({"third": E2}, 1)}, "leg")
    assert matrix_ranks(at) == {"wrenches": 3, "J_x": 3, "J_q": 2}


@pytest.mark.parametrize(("name", "pose", "modes"), [("delta", {"position": [0, "1/10", "-1/2"]}, "+++")])
def test_forces_are_exact_where_joint_values_are_square_roots(name: str, pose: dict[str, Any], modes: str) -> None:
    """Three independent roots: J^T s is the load, in numbers with eight terms each."""
    at = read_robot(MODEL.with_name(f"{name}.toml")).at(pose, modes=modes)
    found = at.forces([0, 0, 1])
    assert found.exact is not None
    assert (found.signs[1], found.signs[2]) == (found.signs[1],) * 2
    rows = at.jacobian.to_numpy()
    assert rows.T @ [float(x) for x in found.values] == pytest.approx([0, 0, -1])
    assert at.forces([0, 0, 0]).exact == ("0", "0", "0")
