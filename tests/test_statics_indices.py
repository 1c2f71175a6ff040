"""Indices, polytopes, forces, stiffness and accuracy at a pose, against numbers of the sources."""

import json
from dataclasses import replace
from fractions import Fraction
from itertools import combinations
from itertools import product as every_choice
from math import comb, sqrt
from random import Random

import numpy as np
import pytest
from flint import arb, arb_mat
from samples import MODELS, model, solved
from test_statics import POSES, at, dual_v, h4, vector

from pkm_exact import Mechanism, Robot
from pkm_exact.cli.main import main
from pkm_exact.constraints.distance import Distance
from pkm_exact.constraints.point_in_plane import InPlane
from pkm_exact.errors import InputError
from pkm_exact.geometry.mechanism import LockedValues
from pkm_exact.motions.motion import Motion
from pkm_exact.motions.motion_groups import PLANAR, TRANSLATION
from pkm_exact.polytopes.enclosures import interval_of
from pkm_exact.polytopes.slabs import Slabs
from pkm_exact.precision import working_precision
from pkm_exact.radicals import RootSum
from pkm_exact.roots.interval import Interval
from pkm_exact.statics.at_pose import AtPose, at_box
from pkm_exact.statics.capability import ordinary_vertices
from pkm_exact.statics.eigenvalues import eigenvalues
from pkm_exact.statics.exact_rows import column_squares
from pkm_exact.statics.failures_of_actuators import determinant, relative_manipulability
from pkm_exact.statics.forces import force_ranges, forces, has_force_closure, has_positive_vector, internal_loads
from pkm_exact.statics.freedom import Freedom
from pkm_exact.statics.index_rows import STATICS_INDICES, enclosed_indices
from pkm_exact.statics.largest_ellipsoid import largest_ellipsoid
from pkm_exact.statics.linear_program import greatest
from pkm_exact.statics.machine_at_pose import machine_at
from pkm_exact.statics.redundant_actuation import park_kim, perturbation_norm
from pkm_exact.statics.stiffness import amplification, greatest_displacement, least_stiffness, rod_errors, stiffness

Capture = pytest.CaptureFixture[str]
FILES = {path.stem: path for path in MODELS}
ALL = {
    "speeds": 1,
    "forces": 1,
    "resolutions": 1,
    "length": 1,
    "speed": 5,
    "force": "1/5",
    "turn": 1,
    "moment": 1,
    "spin": [1],
}


def is_narrow_around(value: Interval, wanted: float | Fraction, digits: int = 12) -> bool:
    """Whether an enclosure is narrow, and a number that is right to so many digits lies at it."""
    return bool(value.width < Fraction(1, 10**12) and abs(float(value) - float(wanted)) < 10.0**-digits * abs(wanted))


def at_dual_v() -> AtPose:
    return dual_v().at({"position": [0, 0], "half_tangent": 0}, configuration="home")


def test_dual_v_has_the_exact_indices() -> None:
    found = at_dual_v().indices(**ALL)
    wanted = {
        "condition": Fraction(8, 3),
        "ms": Fraction(6, 25),
        "v_iso_p": 5,
        "f_iso_p": Fraction(48, 125),
        "w_iso_o": Fraction(25, 8),
        "m_iso_o": Fraction(32, 25),
        "v_iso_spin": Fraction(17, 5),
        "fvi_p": 1,
        "fvi_o": Fraction(32, 25),
        "resolution_p": Fraction(25, 3),
        "resolution_o": Fraction(25, 8),
    }
    assert is_narrow_around(found["v_iso"], 25 / sqrt(89))
    assert is_narrow_around(found["f_iso"], 96 / (25 * sqrt(109)))
    assert is_narrow_around(found["fvi"], 5 / sqrt(89))
    for name, value in wanted.items():
        assert Fraction(value) in found[name], name
        assert found[name].width < Fraction(1, 10**13), name


def test_dual_v_has_the_exact_polytope_and_ellipsoid() -> None:
    found = at_dual_v()
    assert len(found.velocity_polytope(1).facets) == 8
    assert is_narrow_around(found.velocity_polytope(1).inscribed_radius, 25 / sqrt(89))
    wrenches = found.wrench_polytope(1)
    assert (len(wrenches.vertices), len(wrenches.facets)) == (14, 12)
    largest = found.ellipsoid(1, 1)
    assert largest.weights == (Fraction(1, 4),) * 4
    for place, value in enumerate((Fraction(625, 27), Fraction(625, 48), Fraction(625, 192))):
        assert value in largest.matrix[place, place]
        assert is_narrow_around(largest.half_axes[2 - place], sqrt(value))
    null = internal_loads(found)[0]
    assert [(x / null[0].rational).rational for x in null] == [1, -1, 1, -1]  # type: ignore[operator]


def pmar() -> arb_mat:
    """J of the 120-degree machine at (-40, -10): rails at 30 degrees and every 120 on, rods of length 100."""
    s3 = arb(3).sqrt()
    t1, t2 = (5 * s3 - 20) / (9525 + 200 * s3).sqrt(), -(20 + 5 * s3) / (9525 - 200 * s3).sqrt()
    half = arb(1) / 2
    return arb_mat(
        [
            [s3 / 2 - t1 / 2, half + s3 * t1 / 2],
            [-s3 / 2 - t2 / 2, half - s3 * t2 / 2],
            [2 / arb(21).sqrt(), arb(-1)],
        ]
    )


def test_table_i_of_krut_and_what_of_it_is_possible() -> None:
    """Printed: condition 1.49, ellipse 1.08, speeds 1.35 and 0.97, polytope 1.48."""
    with working_precision(256):
        rows = pmar()
        squares = eigenvalues(rows.transpose() * rows)
        assert squares is not None
        condition = interval_of((squares[1] / squares[0]).sqrt())
        table = tuple(tuple(rows[i, j] for j in range(2)) for i in range(3))
        polytope = Slabs(table, (arb(-1),) * 3, (arb(1),) * 3).polytope()
    assert is_narrow_around(condition, 1.48242946934109, 13)  # not 1.49
    largest = largest_ellipsoid(rows, ("x", "y"))
    assert largest.touching == (0, 2)
    assert largest.weights == (Fraction(1, 2), 0, Fraction(1, 2))
    assert is_narrow_around(largest.index, 1.08406798013414, 13)
    assert is_narrow_around(largest.half_axes[1], 0.993557814639609, 13)
    assert is_narrow_around(largest.half_axes[0], 0.916508773293599, 13)
    greatest_speed, least_speed = polytope.greatest_norm, polytope.inscribed_radius
    assert is_narrow_around(greatest_speed, 1.35276993910266, 13)
    assert is_narrow_around(least_speed, sqrt(21) / 5, 13)  # 0.9165, not 0.97
    assert float(greatest_speed) / float(least_speed) == pytest.approx(1.47599301042828, abs=1e-13)
    # The printed speeds belong neither both to the ellipse nor both to the polytope, whatever the convention.
    low, high = Fraction("1.345") / Fraction("0.975"), Fraction("1.355") / Fraction("0.965")
    assert not low < Fraction("1.08") < high
    assert high < Fraction("1.475")


def test_the_centre_of_the_120_degree_machine_is_isotropic() -> None:
    with working_precision(256):
        s3, half = arb(3).sqrt() / 2, arb(1) / 2
        rows = arb_mat([[s3, half], [-s3, half], [0, -1]])
    found = largest_ellipsoid(rows, ("x", "y"))
    assert found.touching == (0, 1, 2)
    assert all(is_narrow_around(axis, 1) for axis in found.half_axes)


def orthogonal() -> list[list[RootSum]]:
    """M of the [4 4] platform of chapter 3, exactly."""
    root = RootSum.root
    x1, y1 = root(Fraction(57, 160)), root(Fraction(3, 40))
    s3 = root(Fraction(3))
    half, upright = Fraction(1, 2), s3 / 2
    turns = [(1, 0), (0, 1), (-1, 0), (0, -1)]
    rows = []
    for sine, cosine, x, y, first in (
        (upright, RootSum.of(half), x1, y1, 0),
        (RootSum.of(half), upright, -(s3 * x1), -y1, 1),
    ):
        for k in range(4):
            c, s = turns[(k + first) % 4]
            rows.append([sine * c, sine * s, cosine,
                         x * s + y * cosine * c, y * cosine * s - x * c, -(y * sine)])  # fmt: skip
    return rows


def test_the_orthogonal_platform_of_chapter_3() -> None:
    rows = orthogonal()
    gram = [[sum((r[i] * r[j] for r in rows), RootSum()).rational for j in range(6)] for i in range(6)]
    wanted = [2, 2, 4, 3, 3, Fraction(3, 10)]
    assert gram == [[wanted[i] if i == j else 0 for j in range(6)] for i in range(6)]
    printed = [0.8660, 0, 0.5, 0.1369, -0.5969, -0.2372]
    assert [float(x) for x in rows[0]] == pytest.approx(printed, abs=4e-5)
    assert set(relative_manipulability(rows, 1).values()) == {Fraction(1, 4)}
    two = relative_manipulability(rows, 2)
    assert sorted(two.values()) == [0] * 12 + [Fraction(1, 16)] * 16
    assert all((square == 0) == (a // 4 == b // 4) for (a, b), square in two.items())


@pytest.mark.parametrize("size", [(4, 2), (5, 3), (7, 3)])
def test_squares_over_all_failure_sets_sum_to_a_binomial(size: tuple[int, int]) -> None:
    """Theorem 1 of chapter 3. Its table says 2 for (8, 2), and 3 for (9, 3): both are 1."""
    m, n = size
    random = Random(m)
    rows = [[Fraction(random.randint(-9, 9)) for _ in range(n)] for _ in range(m)]
    for failed in range(1, m - n + 1):
        found = relative_manipulability(rows, failed)
        assert sum(found.values(), Fraction(0)) == comb(m - n, failed)
        assert len(found) == comb(m, failed)


def bipod(*points: tuple[object, object]) -> Mechanism:
    """Legs from base points to the platform's origin, translations in the plane."""
    legs = [Distance(vector(x, y, 0), vector(0, 0, 0), Fraction(1), f"leg {k}") for k, (x, y) in enumerate(points, 1)]
    plane = InPlane(vector(0, 0, 1), Fraction(0), vector(0, 0, 0), "plane")
    return Mechanism("legs", "mm", "made up", (*legs, plane), tuple(leg.name for leg in legs), TRANSLATION)


def test_the_bipod_has_the_printed_transmission() -> None:
    for x in (25, 35):
        found = bipod((0, 0), (60, 0)).at({"position": [x, 60, 0]}).indices()
        assert is_narrow_around(found["transmission"], 3600 / (65 * sqrt(4825)))
        assert round(float(found["transmission"]), 4) == 0.7973


def test_rp_2rpr_is_isotropic_at_its_centre() -> None:
    corners = [(0, 0), (1, 0), ("1/2", "1/2")]  # in the metric (1, 3, 1)
    machine = bipod(*corners)
    machine = Mechanism(machine.name, "1", "made up", machine.constraints, machine.actuated, TRANSLATION, (1, 3, 1))
    for position, product, ratio in (
        (["1/2", "1/6", 0], Fraction(9, 4), 1),
        (["1/2", 0, 0], Fraction(2), Fraction(1, 2)),
    ):
        found = machine.at({"position": position}).indices()
        assert is_narrow_around(found["manipulability"], sqrt(product))
        assert is_narrow_around(found["condition"], 1 / sqrt(ratio))


def test_drives_that_stand_elsewhere_perturb_the_forces() -> None:
    """Chapter 5's machine at its centroid; its drive 3, the apex, and drive 1 displaced by a twentieth of the side."""
    corners = [[Fraction(0), Fraction(0)], [Fraction(1), Fraction(0)], [Fraction(1, 2), Fraction(1, 2)]]
    pose = {"position": ["1/2", "1/6"], "half_tangent": 0}

    def placed(which: int, shift: Fraction, axis: int = 0) -> AtPose:
        moved = [list(corner) for corner in corners]
        moved[which][axis] += shift
        legs = [Distance(vector(x, y, 0), vector(0, 0, 0), Fraction(1), f"leg {k}") for k, (x, y) in enumerate(moved)]
        return Mechanism("RP/2RPR", "1", "made up", tuple(legs), tuple(leg.name for leg in legs), PLANAR, (1, 3, 1)).at(
            pose
        )

    for which, wanted in ((2, 0.04947), (0, 0.01801)):
        nominal, real = placed(which, Fraction(0)), placed(which, Fraction(1, 20))
        found = perturbation_norm(*(_translations(found) for found in (nominal, real)), (1, 2))
        assert round(float(found), 5) == wanted
    along = [_translations(placed(2, shift, 1)) for shift in (Fraction(0), Fraction(1, 20))]
    assert perturbation_norm(*along, (1, 2)).hi < Fraction(1, 10**30)  # along its own leg: nothing


def _translations(found: AtPose) -> AtPose:
    """The same machine on translations only."""
    plane = Motion("plane", "made up for a test", 2, 2, (), (0, 5, 6), (0, 1))
    return replace(found, motion=plane)


def test_park_and_kims_metric_of_the_collinear_machine() -> None:
    table = [[1, 0], [0, 1], [0, 0], [0, 0], [0, 1], [0, 0]]
    for length in (1, 3):
        h = length
        loops = [
            [0, h, h, 0, 0, 0], [0, h, 0, 0, 0, 0], [0, 1, 1, 1, 0, 0],
            [1, h, h, 0, 0, 0], [0, 0, 0, 0, h, 0], [0, 0, 0, 1, 1, 1],
        ]  # fmt: skip
        rational = [[[Fraction(x) for x in row] for row in rows] for rows in (table, loops)]
        unit = [[Fraction(1), Fraction(0)], [Fraction(0), Fraction(1)]]
        weights = [Fraction(x) for x in (1, 1, 1, 0, 0, 0, 0, 0)]
        g, m = park_kim(rational[0], rational[1], weights, unit, unit)
        assert g == [[2, 0], [0, 1]]
        assert m == [[Fraction(1, 2), 0], [0, 1]]


def test_linapod_amplifies_errors_as_chapter_8_says() -> None:
    found = machine_at(model("linapod-n"), solved("linapod-n").poses[0])
    printed = [
        [-0.058, 0.617, -0.558, 0.010, 0.557, -0.567],
        [-0.678, 0.289, 0.390, -0.649, 0.333, 0.316],
        [-0.154, -0.154, -0.154, -0.230, -0.230, -0.230],
        [0.905, -2.130, 1.220, -0.103, 2.520, -2.410],
        [1.930, -0.181, -1.750, -2.840, 1.330, 1.510],
        [-2.230, -2.230, -2.230, 2.020, 2.020, 2.020],
    ]
    signs = np.array([1, 1, 1, -1, -1, -1])[:, None]  # the source takes the moments the other way round
    # The printed numbers belong to geometry with more decimals than the source prints.
    assert np.abs(signs * rod_errors(found).to_numpy() - printed).max() < 0.0105
    assert float(greatest_displacement(found, [Fraction(1, 100_000)] * 6)) == pytest.approx(11.5296e-6, abs=5e-11)
    assert float(amplification(found)) * sqrt(7) == pytest.approx(4.4926, abs=5e-5)  # seven frames each leg


def test_robocranes_tensions_and_determinant() -> None:
    """Both poses above the base pull with all cables; weight acts towards the base, along -z of this file's frame."""
    robot, printed = model("robocrane-r"), []
    for pose in solved("robocrane-r").poses:
        found = forces(machine_at(robot, pose), [0, 0, -1, 0, 0, 0])
        assert set(found.signs) in ({1}, {-1})
        assert found.is_unique
        printed.append(sorted(round(abs(float(value)), 5) for value in found.values))
    assert sorted([0.12167, 0.29858, 0.09718, 0.26460, 0.13968, 0.22707]) in printed
    assert sorted([0.32132, 0.05348, 0.50310, 0.11751, 0.39249, 0.19409]) in printed
    for half, height in ((Fraction(1, 3), Fraction(1, 2)), (Fraction(1), Fraction(2))):
        quaternion = [1, 0, 0, half]  # of the model: its last number by sqrt(3) is the tangent of half the yaw
        at_yaw = machine_at(robot, {"position": [0, 0, height], "quaternion": quaternion})
        rows = at_yaw.exact_rows
        assert rows is not None
        cosine = (3 - half * half) / (3 + half * half)
        value = determinant([[entry / 2 for entry in row.wrench] for row in rows])
        roots = RootSum.of(1)
        for square in column_squares((1, 3, 1), range(6)):
            roots = roots * RootSum.root(square)
        wanted = 48 * RootSum.root(Fraction(3)) * (8 * (3 + height) ** 3 * cosine)  # a = 1, b = 2, h = 3
        assert abs(value * roots) == abs(wanted)


def test_loads_are_in_equilibrium() -> None:
    for name in POSES:
        found = at(name)
        random = Random(name)
        load = [Fraction(random.randint(-9, 9)) for _ in found.twist]
        borne = forces(found, load)
        assert found.jacobian is not None
        rest = found.jacobian.to_numpy().T @ np.array([float(x) for x in borne.values]) + np.array(load, dtype=float)
        assert rest == pytest.approx(np.zeros(len(load)), abs=1e-9)
    with pytest.raises(InputError, match="2 components; give 3"):
        forces(at("3-rpr-merlet-p"), [0, 1])


def cables(*points: tuple[object, object]) -> AtPose:
    """A point on cables in the plane, as a machine whose only freedoms are its two translations."""
    legs = [Distance(vector(x, y, 0), vector(0, 0, 0), Fraction(1), f"cable {k}") for k, (x, y) in enumerate(points, 1)]
    found = Mechanism("cables", "m", "made up", tuple(legs), tuple(leg.name for leg in legs), PLANAR)
    return _translations(found.at({"position": [0, 0], "half_tangent": 0}))


def test_force_closure_is_decided_exactly() -> None:
    around, beside = cables((3, 4), (-3, 4), (0, -1)), cables((3, 4), (-3, 4), (0, 1))
    border = cables((3, 4), (-3, -4), (0, -1))
    assert [has_force_closure(found) for found in (around, beside, border)] == [True, False, False]
    assert has_positive_vector([[Fraction(1), Fraction(0), Fraction(-1)], [Fraction(0), Fraction(1), Fraction(2)]])
    ranges = force_ranges(around, [Fraction(0), Fraction(-1)], [Fraction(-10)] * 3, [Fraction(-1)] * 3)
    assert ranges is not None
    # Both upper cables pull alike by s, 2 s 4/5 = 1 + the lower one's.
    assert [(low.lo, high.hi) for low, high in ranges] == [
        (Fraction(-55, 8), Fraction(-5, 4)), (Fraction(-55, 8), Fraction(-5, 4)), (Fraction(-10), Fraction(-1))
    ]  # fmt: skip
    assert force_ranges(beside, [Fraction(0), Fraction(-1)], [Fraction(-10)] * 3, [Fraction(-1)] * 3) is None


def test_linear_programs_agree_with_their_corners() -> None:
    random = Random(5)
    for _ in range(10):
        rows = [[Fraction(random.randint(-5, 5)) for _ in range(2)] for _ in range(4)]
        rows += [[Fraction(x), Fraction(y)] for x, y in ((1, 0), (-1, 0), (0, 1), (0, -1))]
        bounds = [Fraction(random.randint(0, 9)) for _ in range(4)] + [Fraction(5)] * 4
        aim = [Fraction(random.randint(-5, 5)) for _ in range(2)]
        corners = []
        for i, j in combinations(range(8), 2):
            (a, b), (c, d) = rows[i], rows[j]
            det = a * d - b * c
            if det:
                x, y = (bounds[i] * d - b * bounds[j]) / det, (a * bounds[j] - bounds[i] * c) / det
                if all(p * x + q * y <= bound for (p, q), bound in zip(rows, bounds, strict=True)):
                    corners.append(aim[0] * x + aim[1] * y)
        assert greatest(aim, rows, bounds) == max(corners)


def test_stiffness_and_its_least_eigenvalue() -> None:
    found = Freedom(at("rolland-6-6"))
    rows = found.at.jacobian.to_numpy()  # type: ignore[union-attr]
    weights = [Fraction(k) for k in range(1, 7)]
    wanted = rows.T @ np.diag([float(k) for k in weights]) @ rows
    assert np.allclose(stiffness(found, weights).to_numpy(), wanted)
    scale = np.diag([1, 1, 1, 0.01, 0.01, 0.01])
    least = np.linalg.eigvalsh(scale @ wanted @ scale)[0]
    assert float(least_stiffness(found, weights, Fraction(100))) == pytest.approx(least)
    with pytest.raises(InputError, match="give a length"):
        least_stiffness(found, weights)


@pytest.mark.parametrize("index", STATICS_INDICES, ids=lambda index: index.name)
def test_every_index_says_what_it_is_and_agrees_with_floating_point(index: object) -> None:
    found = at_dual_v()
    values, refused = enclosed_indices(found.measures(**ALL))
    name = index.name  # type: ignore[attr-defined]
    assert name in values
    assert name not in refused
    assert index.definition  # type: ignore[attr-defined]
    assert "(" in index.source or "20" in index.source  # type: ignore[attr-defined]


def test_narrow_boxes_have_all_indices_of_the_pose_within() -> None:
    """At a pose where entries of J are 0: in the box they are intervals about 0, whose squares are numbers too."""
    robot = Robot.load(FILES["3-rpr-merlet-p"])
    exact = robot.at({"position": [0, 5], "half_tangent": 0})
    assert any(entry.lo == entry.hi == 0 for row in exact.jacobian.entries for entry in row)
    near = Fraction(1, 10**30)
    position, rotation = (
        [[Interval(x - near, x + near) for x in row] for row in rows] for rows in ([exact.position], exact.rotation)
    )
    boxed = at_box(robot, exact.held, position[0], rotation, 3)
    given = {key: value for key, value in ALL.items() if key != "least_forces"}
    whole, _ = enclosed_indices(exact.measures(**given))
    found, refused = enclosed_indices(boxed.measures(**given))
    assert found.keys() == whole.keys(), refused
    assert "v_iso_p" in found
    assert all(found[name].lo <= whole[name].hi and whole[name].lo <= found[name].hi for name in found)
    assert amplification(boxed).contains(amplification(exact).midpoint)


def test_one_index_that_is_refused_leaves_the_others() -> None:
    """At a singular pose errors of actuators bound no twists; speeds that are reached are there all the same."""
    at = Robot.load(FILES["3-rpr-merlet-p"]).at({"position": ["11/5", 5], "half_tangent": 0})
    assert at.rank == 2
    found, refused = enclosed_indices(at.measures(resolutions=1, speeds=1))
    assert "v_iso_p" in found
    assert refused["resolution_p"]


def test_what_mixes_units_is_refused() -> None:
    _, refused = enclosed_indices(at_dual_v().measures())
    for name in (
        "condition",
        "sigma_min",
        "sigma_max",
        "manipulability",
        "ms",
        "transmission",
        "v_iso",
        "f_iso",
        "fvi",
    ):
        assert "give a length" in refused[name]
    values, _ = enclosed_indices(
        h4().at({"position": [0, 0, -42], "quaternion": [1, 0, 0, 0]}, modes="++++").measures(length=1)
    )
    assert float(values["condition"]) == pytest.approx(8.558969, abs=5e-7)


def test_constraints_that_are_not_actuated_leave_fewer_twists() -> None:
    robot = model("3-rps")
    if not robot.actuated:
        values = solved("3-rps").problem.constraints
        legs = tuple(found.name for found in values if isinstance(found, Distance))
        locked = LockedValues("home", tuple(found.length_squared for found in values if isinstance(found, Distance)))
        robot = Mechanism(robot.name, robot.unit, "made up", values, legs, robot.motion, robot.metric, (locked,))
    found = machine_at(robot, solved("3-rps").poses[0])
    assert float(enclosed_indices(found.measures(length=1))[0]["condition"]) > 1
    assert "all of whose constraints are actuated" in enclosed_indices(found.measures(speeds=1))[1]["v_iso_p"]
    borne = forces(found, [0, 0, -1, 0, 0, 0])
    assert len(borne.names) == 6


@pytest.mark.parametrize("where", ["exact", "enclosed"])
def test_polytopes_where_constraints_are_not_actuated(where: str) -> None:
    """The three freedoms of legs on hinges: twists that the hinges allow, wrenches up to what they bear."""
    robot = model("3-rps")
    found = machine_at(
        robot,
        solved("3-rps").poses[1] if where == "enclosed" else {"position": [0, 0, "1/2"], "quaternion": [1, 0, 0, 0]},
    )
    measures = found.measures(speeds=1, forces=5, length=1)
    freedom = measures.freedom
    assert freedom.components == ("vz", "wx", "wy")
    twists, wrenches = found.velocity_polytope(1), found.wrench_polytope(5)
    assert [(len(p.vertices), len(p.facets)) for p in (twists, wrenches)] == [(8, 6)] * 2
    jacobian, rows = found.jacobian.to_numpy(), found.wrenches.to_numpy()
    expansion = np.array([[float(x.mid()) for x in row] for row in freedom.expansion.table()])
    for vertex in ordinary_vertices(twists):
        twist = expansion @ [float(x) for x in vertex]
        assert np.abs(jacobian @ twist) == pytest.approx(np.ones(3), abs=1e-6)
        assert np.abs(rows[[1, 3, 5]] @ twist).max() < 1e-6  # the hinges
        powers = [
            np.dot([float(x) for x in vertex], [float(x) for x in wrench]) for wrench in ordinary_vertices(wrenches)
        ]
        assert max(powers) == pytest.approx(15, abs=1e-6)  # three legs, force 5 times speed 1
    values, _ = enclosed_indices(found.measures(speeds=1, forces=5, length=1, resolutions=1))
    scaled = jacobian @ np.linalg.qr(np.linalg.svd(rows[[1, 3, 5]])[2][3:].T)[0]
    assert float(values["v_iso"]) == pytest.approx(1 / np.linalg.norm(scaled, axis=1).max(), rel=1e-6)
    assert float(values["f_iso"]) == pytest.approx(5 / np.linalg.norm(np.linalg.inv(scaled), axis=0).max(), rel=1e-6)
    corners = [
        np.linalg.solve(np.vstack([jacobian, rows[[1, 3, 5]]]), [*s, 0, 0, 0]) for s in every_choice((-1, 1), repeat=3)
    ]
    for name, part in (("resolution_p", slice(3)), ("resolution_o", slice(3, 6))):
        assert float(values[name]) == pytest.approx(max(np.linalg.norm(c[part]) for c in corners), rel=1e-6)
    if where == "exact":
        assert twists.vertices[0] == (-RootSum.root(Fraction(2)), RootSum(), RootSum())
        assert all(isinstance(x, int) for facet in wrenches.facets for x in facet.normal)


def test_the_command_has_all_of_it_in_json(capsys: Capture) -> None:
    words = [
        "statics",
        "models/3-rpr-merlet-p.toml",
        "--position",
        "5,9/2",
        "--half-tangent",
        "1/3",
        "--format",
        "json",
    ]
    more = [
        "--limits",
        "speeds=1/2",
        "--limits",
        "forces=3",
        "--limits",
        "length=2",
        "--load",
        "0,-10",
        "--stiffness",
        "5",
    ]
    assert main([*words, *more]) == 0
    found = json.loads(capsys.readouterr().out)
    assert set(found["indices"]["condition"]) == {"value", "unit", "definition", "source"}
    for name, count in (("velocity_polytope", 8), ("wrench_polytope", 8)):
        assert set(found[name]) == {"vertices", "facets", "volume"}
        assert len(found[name]["vertices"]) == count
        assert len(found[name]["facets"]) == 6
    assert found["polytope_components"] == ["vx", "vy", "wz"]
    assert len(found["ellipsoid"]["half_axes"]) == 3
    assert all(sign in (1, -1) for sign in found["forces"]["signs"])
    assert main([*words, "--limits", "speed=x"]) == 2
    assert main([*words, "--limits", "swiftness=1"]) == 2
    assert "limits: 'swiftness' is unknown" in capsys.readouterr().err
    assert main([*words, "--load", "1,2,3,4"]) == 2
    assert "--load: 4 numbers given" in capsys.readouterr().err


def test_a_load_away_from_the_origin_has_a_moment(capsys: Capture) -> None:
    words = [
        "statics",
        "models/rolland-6-6.toml",
        "--position",
        "0,0,650",
        "--quaternion",
        "1,0,0,1",
        "--format",
        "json",
    ]
    assert main([*words, "--load", "0,0,-5", "--load-at", "2,0,0"]) == 0
    there = json.loads(capsys.readouterr().out)["forces"]
    assert main([*words, "--load", "0,0,-5,-10,0,0"]) == 0  # the point stands at (0, 2, 0): r x f = (-10, 0, 0)
    assert json.loads(capsys.readouterr().out)["forces"] == there


def test_a_pose_of_a_solution_has_a_largest_ellipsoid_though_its_box_is_wide() -> None:
    """In the polytope at the middle of the box; its weights prove that no other one has a volume much larger."""
    at = machine_at(model("mssm"), solved("mssm").poses[0])
    found = at.ellipsoid(1, 1)
    rows = at.jacobian.to_numpy()
    matrix = found.matrix.to_numpy()
    reach = np.einsum("ij,jk,ik->i", rows, matrix, rows)
    assert reach.max() <= 1 + 1e-9
    assert found.gap.hi < Fraction(1, 100)
    weights = np.array([float(x) for x in found.weights])
    dual = 6 * (rows.T * weights) @ rows
    assert 1 - 0.07 < np.linalg.det(matrix) * np.linalg.det(dual) <= 1 + 1e-6
    axes = np.sqrt(np.linalg.eigvalsh(matrix))
    for enclosed, axis in zip(found.half_axes, axes, strict=True):
        assert float(enclosed.lo) * 0.99 <= axis <= float(enclosed.hi) * 1.01
