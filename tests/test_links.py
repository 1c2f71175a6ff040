"""Mechanisms with passive bodies: their equations against mathematics, published counts and poses, certificates."""

import json
from collections.abc import Sequence
from dataclasses import replace
from fractions import Fraction
from functools import cache
from itertools import chain
from math import atan2, cos, degrees, dist, hypot, pi, sin, sqrt
from pathlib import Path
from random import Random
from typing import Any

import pytest
from budgets import budget
from hypothesis import given
from hypothesis import strategies as st

from pkm_exact import InputError, read_robot
from pkm_exact.certify import pure
from pkm_exact.certify.check import check_bytes
from pkm_exact.certify.links_build import links_certificate_bytes
from pkm_exact.cli.main import main
from pkm_exact.constraints.angle import Angle
from pkm_exact.constraints.constraint import Constraint, Role
from pkm_exact.constraints.constraint_types import CONSTRAINTS
from pkm_exact.constraints.distance import Distance
from pkm_exact.constraints.form import value_at
from pkm_exact.geometry.inverse import Metric, rotation_of
from pkm_exact.geometry.links import LinkBody, Links
from pkm_exact.geometry.mechanism import Mechanism
from pkm_exact.geometry.reader import any_from_toml, read_links
from pkm_exact.links.link_engine import solve_links
from pkm_exact.links.link_equations import LinkEquations
from pkm_exact.links.link_poses import unit_quaternion
from pkm_exact.links.link_solution import Assembly, LinkSolution
from pkm_exact.links.start_box import NotFoundError, solve_from_start
from pkm_exact.motions.motion_groups import MOTIONS, PLANAR, SPATIAL, TRANSLATION
from pkm_exact.poses.pose import Pose
from pkm_exact.roots.interval import Interval

ROOT = Path(__file__).parent.parent
SHIPPED = sorted((ROOT / "models" / "links").glob("*.toml"))
COUNTS = {  # complex solutions, real poses
    "four-bar": (2, 2),
    "watt": (4, 2),
    "stephenson": (6, 2),
    "3-rrr-links": (6, 2),
    "3-rrr-regular": (6, 2),
    "3-prrr-rotary": (8, 8),
    "micabo-h-links": (12, 2),
}
FIVE_LEGS = ("5-rrr-rr", "5-r3-rr", "5-r3-r2")
SINGLE = (*FIVE_LEGS, "5-strut-pentapod")
"""Of these one pose is proved."""
SLOW = ("watt", "stephenson", "micabo-h-links")
Matrix = Sequence[Sequence[Fraction]]


@cache
def _links(name: str) -> Links:
    return read_links(ROOT / "models" / "links" / f"{name}.toml")


@cache
def _solved(name: str) -> LinkSolution:
    return solve_links(_links(name))


def test_every_shipped_mechanism_has_its_counts() -> None:
    assert {path.stem for path in SHIPPED} == {*COUNTS, *SINGLE}
    page = (ROOT / "docs" / "links.md").read_text(encoding="utf-8")
    assert all(path.name in page for path in SHIPPED)


@pytest.mark.parametrize("name", [pytest.param(k, marks=pytest.mark.slow if k in SLOW else ()) for k in COUNTS])
def test_counts_are_proved(name: str) -> None:
    found = _solved(name)
    assert (found.is_complete, found.complex_solutions, len(found)) == (True, *COUNTS[name])


def test_the_four_bar_closes() -> None:
    """The coupler's end is 5 from the ground joint, as the rocker says."""
    for assembly in _solved("four-bar"):
        coupler, _ = assembly.poses
        end = [coupler.position[i].midpoint + 6 * coupler.rotation[i][0].midpoint for i in (0, 1)]
        assert abs((end[0] - 7) ** 2 + end[1] ** 2 - 25) < Fraction(1, 10**7)


def test_published_poses_of_the_3_rrr() -> None:
    """Both poses at (0.03, 0.02) and 0.2 rad of chapter 5, from angles printed to six digits."""
    found = _solved("3-rrr-links")
    poses = [found.platform_pose(assembly) for assembly in found]
    values = [[float(value) for value in (*p.position[:2], p.rotation[0][0], p.rotation[1][0])] for p in poses]
    home, other = sorted(values, key=lambda row: -row[0])
    assert home[:2] == pytest.approx([0.03, 0.02], abs=1e-7)
    assert atan2(home[3], home[2]) == pytest.approx(0.2, abs=1e-6)
    assert other == pytest.approx([-0.0029, 0.046781, -0.109346, -0.994004], abs=1e-6)


def test_regular_triangles_are_exact_in_their_metric() -> None:
    """Joints, cranks and rods of the platform's pose next to that of the example, in ordinary coordinates."""
    found = _solved("3-rrr-regular")
    assembly = found.assemblies[1]
    *cranks, platform = assembly.poses
    ends = []
    for k, crank in enumerate(cranks):
        turn = 2 * k * pi / 3 - 5 * pi / 6
        foot = (sqrt(3) / 6 * cos(turn), sqrt(3) / 6 * sin(turn))
        assert [float(x.midpoint) for x in crank.position[:2]] == pytest.approx(foot)
        elbow = _placed(crank, (0.2, 0))
        wrist = _placed(platform, (0.2 / sqrt(3) * cos(turn), 0.2 / sqrt(3) * sin(turn)))
        assert dist(elbow, foot) == pytest.approx(0.2)
        assert dist(elbow, wrist) == pytest.approx(0.2)
        ends.append(wrist)
    assert [dist(ends[k], ends[k - 1]) for k in range(3)] == pytest.approx([0.2] * 3)
    assert [float(x.midpoint) for x in platform.position[:2]] == pytest.approx([0.03, 0.02], abs=0.001)


def _placed(pose: Pose, point: tuple[float, float]) -> tuple[float, float]:
    x, y = (
        float(pose.position[i].midpoint) + sum(float(pose.rotation[i][j].midpoint) * point[j] for j in range(2))
        for i in range(2)
    )
    return x, y


def test_the_3_rrr_without_its_links_has_the_same_poses() -> None:
    """A link of length l between two pins is a distance."""
    links = _links("3-rrr-links")
    text = [
        'schema = 1\nname = "x"\nkind = "3-RRR"\nunit = "m"\nsource = "x"\n',
        f"[base]\njoints = {_points(links, 'ground', 'point')}\n",
        "[cranks]\nat_0 = [[0.2, 0], [0.2, 0], [0.2, 0]]\n[rods]\nlength = 0.2\n",
        f"[platform]\njoints = {_points(links, 'wrist', 'platform')}\n",
        f'[[configurations]]\nname = "home"\ncos_sin = {_cosines(links)}\n',
    ]
    robot: Any = any_from_toml("".join(text))
    from pkm_exact.engine import solve

    alone = solve(robot.problem(robot.configuration()))
    mine = [_solved("3-rrr-links").platform_pose(assembly) for assembly in _solved("3-rrr-links")]
    assert len(alone.poses) == len(mine)
    for one, other in zip(alone.poses, sorted(mine, key=lambda pose: pose.position[0].lo), strict=True):
        pairs = zip((*one.position, *one.rotation[0]), (*other.position, *other.rotation[0]), strict=True)
        assert all(a.overlaps(b) for a, b in pairs)


def _points(links: Links, name: str, field: str) -> list[list[str]]:
    found = [c for c in links.declared.constraints if c.name.startswith(name)]
    return [[str(x) for x in getattr(constraint, field)[:2]] for constraint in found]


def _cosines(links: Links) -> list[list[str]]:
    values = links.configuration().values
    return [[str(values[2 * leg]), str(values[2 * leg + 1])] for leg in range(3)]


def test_published_poses_of_the_rotary_3_prrr() -> None:
    """All eight at the half tangents (0, 1, 1/4) of chapter 13, real."""
    printed = [
        (0.252402, 0.252402, 0.121671),
        (0.293411, 0.916589, 0.205040),
        (0.783659, 0.426341, 0.327429),
        (0.762880, 0.762880, 0.337939),
    ]
    found = {
        tuple(round(float(x), 6) for x in _solved("3-prrr-rotary").platform_pose(a).position)
        for a in _solved("3-prrr-rotary")
    }
    assert found == {(x, y, sign * z) for x, y, z in printed for sign in (1, -1)}


def test_sliders_stand_beside_the_platform() -> None:
    """In every assembly each slider has the coordinate of the platform along its rail."""
    for assembly in _solved("3-prrr-rotary"):
        platform = assembly.poses[3].position
        assert all(assembly.poses[axis].position[axis].overlaps(platform[axis]) for axis in range(3))


# ---------------------------------------------------------------------------------------------------------------------
# One pose from a start
# ---------------------------------------------------------------------------------------------------------------------


@pytest.mark.parametrize("name", ["four-bar", "3-prrr-rotary"])
def test_the_pose_from_a_start_is_one_of_all(name: str) -> None:
    found = solve_from_start(_links(name))
    (assembly,) = found
    assert (str(found.claim), found.complex_solutions, found.distinct_solutions) == ("not-proven-complete", None, None)
    matches = [other for other in _solved(name) if _overlap(assembly, other)]
    assert len(matches) == 1


def _overlap(one: Assembly, other: Assembly) -> bool:
    pairs = zip(one.poses, other.poses, strict=True)
    return all(a.overlaps(b) for p, q in pairs for a, b in zip(_entries(p), _entries(q), strict=True))


def _entries(pose: Pose) -> list[Interval]:
    return [*pose.position, *(entry for row in pose.rotation for entry in row)]


def test_other_starts_find_other_poses() -> None:
    links = _links("four-bar")
    home = (Fraction(9, 5), Fraction(12, 5), Fraction(0))
    found = set()
    for half in (Fraction(1, 4), Fraction(-3, 4)):
        start = (home, rotation_of((Fraction(1), Fraction(0), Fraction(0), half), (1, 1, 1)))
        (assembly,) = solve_from_start(links.with_start(start))
        found.add(assembly.poses[0].rotation[1][0].lo > 0)
    assert found == {True, False}


@pytest.mark.parametrize("name", FIVE_LEGS)
def test_the_platform_of_a_five_legged_machine_is_near_its_start(name: str) -> None:
    """The motors are turned by a few degrees from where all bodies stand at their starts."""
    found = solve_from_start(_links(name), width=Fraction(1, 10**20))
    pose = found.platform_pose(found.assemblies[0])
    assert max(value.width for value in _entries(pose)) <= Fraction(1, 10**20)
    assert float(pose.quaternion[0]) > 0.99
    assert not pose.position[0].contains(Fraction(0))


def test_the_struts_of_collars_with_radius_have_their_lengths() -> None:
    """A strut ends where its plane through the tool's axis meets its collar, of radius 40."""
    links = _links("5-strut-pentapod")
    found = solve_from_start(links, width=Fraction(1, 10**20))
    pose = found.platform_pose(found.assemblies[0])
    struts = [c for c in links.declared.constraints if isinstance(c, Distance)]
    assert len(struts) == 5
    for strut in struts:
        x, y, z = (
            float(
                place.midpoint + sum(entry.midpoint * value for entry, value in zip(row, strut.platform, strict=True))
            )
            for place, row in zip(pose.position, pose.rotation, strict=True)
        )
        assert (hypot(x, y) - 40) ** 2 + (z - float(strut.base[2])) ** 2 == pytest.approx(float(strut.length_squared))


def test_a_width_that_holds_both_poses_is_made_smaller() -> None:
    (assembly,) = solve_from_start(_links("four-bar"), width=Fraction(1))
    assert max(value.width for value in _entries(assembly.poses[0])) < 1


def test_equations_must_be_as_many_as_unknowns() -> None:
    with pytest.raises(InputError, match=r"31 equations in 28 unknowns.*leave out constraints"):
        solve_from_start(_links("3-rrr-links"))
    links = _links("four-bar")
    declared = Mechanism("x", "1", "x", links.declared.constraints[:2], motion=PLANAR)
    with pytest.raises(InputError, match=r"6 equations in 8 unknowns.*more constraints"):
        solve_from_start(Links(declared, links.bodies, links.joined[:2], 1))


def _one_distance(squares: Sequence[int], motion: str = "translation") -> Links:
    """A point at distances from (0, 0, 0), (4, 0, 0) and (0, 4, 0)."""
    origin = (Fraction(0),) * 3
    places = ((0, 0, 0), (4, 0, 0), (0, 4, 0))
    legs = tuple(
        Distance((Fraction(x), Fraction(y), Fraction(z)), origin, Fraction(square), f"leg {x}{y}")
        for (x, y, z), square in zip(places, squares, strict=True)
    )
    return Links(Mechanism("x", "1", "x", legs), (LinkBody("b", MOTIONS[motion]),), ((0, 1),) * 3, 1)


def test_where_there_is_no_pose_none_is_found() -> None:
    with pytest.raises(NotFoundError, match="give starts of bodies nearer"):
        solve_from_start(_one_distance((1, 1, 1)))


def test_a_double_pose_is_not_proved() -> None:
    """In the plane of the joints both mirrored poses meet."""
    with pytest.raises(NotFoundError, match="may be singular there"):
        solve_from_start(_one_distance((1, 9, 17)).with_start(((Fraction(1), Fraction(0), Fraction(0)), _UNIT)))


_UNIT = rotation_of((Fraction(1), Fraction(0), Fraction(0), Fraction(0)), (1, 1, 1))


def test_a_mirrored_body_is_no_pose() -> None:
    """R is triangular: by R^T R = 1 it is diagonal, and the start is a reflection."""
    axes = [tuple(Fraction(int(i == j)) for j in range(3)) for i in range(3)]
    images = [*axes[:2], (Fraction(0), Fraction(0), Fraction(-1))]
    pairs = [(0, 1), (1, 2), (0, 2)]
    angles = tuple(
        Angle(axes[i], axes[j], images[j][i], f"angle {i}{j}")
        for i, j in pairs  # type: ignore[arg-type]
    )
    body = LinkBody("b", MOTIONS["spherical"], ((Fraction(0),) * 3, (axes[0], axes[1], images[2])))  # type: ignore[arg-type]
    links = Links(Mechanism("x", "1", "x", angles), (body,), ((0, 1),) * 3, 1)
    with pytest.raises(NotFoundError, match="'b' is mirrored"):
        solve_from_start(links)


# ---------------------------------------------------------------------------------------------------------------------
# Equations
# ---------------------------------------------------------------------------------------------------------------------

numbers = st.integers(-5, 5).map(Fraction)
quaternions = st.tuples(numbers, numbers, numbers, numbers).filter(any)
poses = st.tuples(st.tuples(numbers, numbers, numbers), quaternions)


def _example(type_: type[Constraint], random: Random) -> Constraint:
    """A constraint with random numbers."""
    fields: dict[str, Any] = {}
    for name, role in type_.fields.items():
        if role == Role.COEFFICIENTS:
            fields[name] = tuple(Fraction(random.randint(1, 9)) for _ in range(17))
        elif role in (Role.NUMBER, Role.POSITIVE):
            fields[name] = Fraction(random.randint(1, 9))
        else:
            fields[name] = tuple(Fraction(random.randint(1, 9)) for _ in range(3))
    built: Any = type_
    found: Constraint = built(**fields, name="c")
    return found


def _relative(one: tuple[Any, Matrix], other: tuple[Any, Matrix], g: Metric) -> tuple[Any, Any]:
    """R_a^-1 d and R_a^-1 R_b, with R^-1 = G^-1 R^T G."""
    (c, r), (d, s) = one, other
    inverse = [[r[i][j] * g[i] / g[j] for i in range(3)] for j in range(3)]
    difference = [y - x for x, y in zip(c, d, strict=True)]
    position = tuple(sum((inverse[j][i] * difference[i] for i in range(3)), Fraction(0)) for j in range(3))
    rotation = tuple(
        tuple(sum((inverse[j][i] * s[i][k] for i in range(3)), Fraction(0)) for k in range(3)) for j in range(3)
    )
    return position, rotation


@pytest.mark.parametrize("type_", CONSTRAINTS)
@budget(12)
@given(poses, poses, st.integers(0, 99), st.sampled_from([(1, 1, 1), (1, 3, 1), (2, 3, 5)]))
def test_equations_are_those_of_the_motion_of_one_body_seen_from_the_other(
    type_: str, first: Any, second: Any, seed: int, metric: Metric
) -> None:
    constraint = _example(CONSTRAINTS[type_], Random(seed))
    one, other = ((place, rotation_of(quaternion, metric)) for place, quaternion in (first, second))
    bodies = (LinkBody("a", SPATIAL), LinkBody("b", SPATIAL))
    links = Links(Mechanism("x", "1", "x", (constraint,), metric=metric), bodies, ((1, 2),), 2)
    equations = LinkEquations(links, (constraint,))
    point = [value for c, r in (one, other) for value in (*c, *(entry for row in r for entry in row))]
    assert not any(_at(polynomial, point) for polynomial in equations.rotations(spare=True))
    found = [_at(polynomial, point) for polynomial in equations.constraint_polynomials()]
    position, rotation = _relative(one, other, metric)
    asked = [value_at(form, position, rotation, metric) for form in constraint.forms(metric)]
    for square in constraint.squares(metric):
        linear, root = (value_at(form, position, rotation, metric) for form in (square.linear, square.root))
        asked.append(linear - square.factor * root * root)
    if type_ == "at-point":  # said in the coordinates of the ground
        asked = [sum((one[1][i][j] * asked[j] / metric[j] for j in range(3)), Fraction(0)) for i in range(3)]
    assert found == asked


def _stretched(links: Links, roots: Sequence[int]) -> Links:
    """The same mechanism in coordinates of which the ordinary ones are these multiples, in the metric of squares."""

    def vector(values: Sequence[Fraction]) -> Any:
        return tuple(x / root for x, root in zip(values, roots, strict=True))

    g = tuple(root * root for root in roots)
    constraints = [
        replace(each, **{field: vector(value) for field, value in vars(each).items() if isinstance(value, tuple)})  # type: ignore[type-var]
        for each in links.declared.constraints
    ]
    bodies = []
    for body in links.bodies:
        if body.start is None:
            bodies.append(body)
            continue
        place, rotation = body.start
        rows = tuple(
            tuple(x * b / a for x, b in zip(row, roots, strict=True)) for row, a in zip(rotation, roots, strict=True)
        )
        bodies.append(replace(body, start=(vector(place), rows)))  # type: ignore[arg-type]
    declared = replace(links.declared, constraints=tuple(constraints), metric=g)  # type: ignore[arg-type]
    return replace(links, declared=declared, bodies=tuple(bodies))


def _meet(one: Pose, other: Pose) -> bool:
    """Whether all bounds of two poses have numbers in common."""
    pairs = zip((*one.position, *chain(*one.rotation)), (*other.position, *chain(*other.rotation)), strict=True)
    return all(a.lo <= b.hi and b.lo <= a.hi for a, b in pairs)


@pytest.mark.parametrize(
    ("name", "roots"),
    [
        ("four-bar", (2, 3, 1)),
        ("3-prrr-rotary", (3, 1, 2)),
        pytest.param("3-rrr-links", (1, 2, 1), marks=pytest.mark.slow),
    ],
)
def test_mechanisms_in_a_metric_have_the_poses_of_those_without(name: str, roots: Sequence[int]) -> None:
    plain, stretched = _solved(name), solve_links(_stretched(_links(name), roots))
    assert (stretched.claim, stretched.complex_solutions, len(stretched)) == (
        plain.claim,
        plain.complex_solutions,
        len(plain),
    )
    for assembly in plain:
        same = [all(map(_meet, assembly.poses, found.poses)) for found in stretched]
        assert same.count(True) == 1
    data = links_certificate_bytes(stretched)
    assert (check_bytes(data).status, pure.check_bytes(data).status) == ("accepted", "accepted")


def test_a_start_in_a_metric_finds_the_pose_of_that_without() -> None:
    """Spatial bodies; other coordinates may lead to another pose, so that it starts at the one without."""
    links = _links("micabo-h-links")
    plain = solve_from_start(links)
    near = []
    for body, pose in zip(links.bodies, plain.assemblies[0].poses, strict=True):
        place, *rows = (tuple(x.midpoint for x in row) for row in (pose.position, *pose.rotation))
        near.append(replace(body, start=(place, tuple(rows))))  # type: ignore[arg-type]
    stretched = solve_from_start(_stretched(replace(links, bodies=tuple(near)), (1, 2, 4)))
    assert all(map(_meet, plain.assemblies[0].poses, stretched.assemblies[0].poses))
    data = links_certificate_bytes(stretched)
    assert (check_bytes(data).status, pure.check_bytes(data).status) == ("accepted", "accepted")


def test_boxes_in_a_metric_are_as_narrow_as_asked() -> None:
    width = Fraction(1, 10**6)
    (pose, *_) = (
        found
        for assembly in solve_links(_stretched(_links("four-bar"), (4, 5, 1)), width=width)
        for found in assembly.poses
    )
    assert all(x.hi - x.lo <= width for x in (*pose.position, *chain(*pose.rotation)))


def test_a_start_is_in_ordinary_coordinates(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    text = (ROOT / "models" / "links" / "four-bar.toml").read_text()
    assert 'motion = "planar"' in text
    found = []
    for metric in ("", "metric = [1, 1]\n"):
        path = tmp_path / f"m{len(found)}.toml"
        path.write_text(metric + text)
        assert main(["solve", str(path), "--method", "krawczyk", "--start", "7,0,90"]) == 3
        found.append(capsys.readouterr().out)
    assert found[0] == found[1]


def _at(polynomial: Any, point: Sequence[Fraction]) -> Fraction:
    total = Fraction(0)
    for exponents, value in polynomial.to_dict().items():
        term = Fraction(int(value.p), int(value.q))
        for x, e in zip(point, exponents, strict=True):
            term *= x ** int(e)
        total += term
    return total


@pytest.mark.parametrize(
    ("motion", "whole", "names"),
    [
        ("spatial", SPATIAL, 12),
        ("planar", SPATIAL, 4),
        ("schoenflies", SPATIAL, 5),
        ("translation", SPATIAL, 3),
        ("spherical", SPATIAL, 9),
        ("planar", PLANAR, 4),
        ("translation", PLANAR, 2),
    ],
)
def test_bodies_have_the_unknowns_of_their_motion(motion: str, whole: Any, names: int) -> None:
    constraint = _example(CONSTRAINTS["distance"], Random(1))
    declared = Mechanism("x", "1", "x", (constraint,), motion=whole)
    equations = LinkEquations(Links(declared, (LinkBody("a", MOTIONS[motion]),), ((0, 1),), 1), (constraint,))
    assert len(equations.names) == names


@budget(25)
@given(quaternions)
def test_quaternions_are_enclosed(e: Any) -> None:
    rotation = rotation_of(e, (1, 1, 1))
    near = Fraction(1, 2**40)
    found = unit_quaternion([[Interval(x - near, x + near) for x in row] for row in rotation], 30)
    norm = sum(x * x for x in e)
    largest = max(range(4), key=lambda k: float(found[k].midpoint))
    for value, interval in zip(e, found, strict=True):
        square, sign = value * value / norm, 1 if value * e[largest] >= 0 else -1
        low, high = (interval.lo, interval.hi) if sign > 0 else (-interval.hi, -interval.lo)
        assert high >= 0
        assert max(low, Fraction(0)) ** 2 <= square <= high**2
        assert interval.width < Fraction(1, 2**20)


def test_an_exchanged_pair_of_bodies_says_the_same() -> None:
    """A pin belongs to both of its bodies."""
    links = _links("four-bar")
    constraints = list(links.declared.constraints)
    place = next(i for i, pair in enumerate(links.joined) if 0 not in pair)
    exchanged = constraints[place].mirrored()
    assert exchanged is not None
    constraints[place] = exchanged
    joined = [pair[::-1] if i == place else pair for i, pair in enumerate(links.joined)]
    other = Links(
        Mechanism("x", "1", "x", tuple(constraints), motion=PLANAR), links.bodies, tuple(joined), links.platform
    )
    assert solve_links(other).assemblies == _solved("four-bar").assemblies


def test_loops_that_cannot_close_are_inconsistent(tmp_path: Path) -> None:
    text = (ROOT / "models" / "links" / "four-bar.toml").read_text()
    path = tmp_path / "torn.toml"
    path.write_text(text + _POINT.replace("7, 0", "8, 1"))
    found = solve_links(read_links(path))
    assert (str(found.claim), len(found)) == ("inconsistent", 0)


_POINT = """
[[constraints]]
name = "second pin"
type = "at-point"
bodies = ["base", "rocker"]
point = [7, 0]
platform = [0, 0]
"""


def test_a_passive_freedom_is_infinitely_many() -> None:
    """Without its ground joint the rocker turns freely."""
    links = _links("four-bar")
    declared = Mechanism("x", "1", "x", links.declared.constraints[:2], motion=PLANAR)
    found = solve_links(Links(declared, links.bodies, links.joined[:2], 1))
    assert str(found.claim).startswith("positive-dimensional")


# ---------------------------------------------------------------------------------------------------------------------
# Model files and commands
# ---------------------------------------------------------------------------------------------------------------------

MODEL = str(ROOT / "models" / "links" / "four-bar.toml")


@pytest.mark.parametrize(
    ("old", "new", "words"),
    [
        ('body = "coupler"', 'body = "x"', "platform.body: 'x' is not the name of a body; use base, coupler, rocker"),
        ('body = "coupler"', 'body = "base"', "platform.body: 'base' does not move"),
        ('name = "rocker"', 'name = "base"', "bodies[2].name: 'base' is the body that stands still"),
        ('name = "rocker"', 'name = "coupler"', "bodies: the name 'coupler' is used twice"),
        ('name = "rocker"', 'name = "rocker"\nmotion = "sideways"', "bodies[2].motion: 'sideways' is unknown"),
        ('name = "rocker"', 'name = "rocker"\nmotion = "spatial"', "spatial is no motion of a planar mechanism"),
        ('name = "rocker"', 'name = "rocker"\nmass = 1', "bodies[2]: unknown key 'mass'"),
        ('name = "rocker"', 'name = "rocker"\nstart = 3', "bodies[2].start: 3 is not a table"),
        ('bodies = ["base", "coupler"]', 'bodies = ["base"]', "constraints[1].bodies: a list of 1 is not two names"),
        ('bodies = ["base", "coupler"]', 'bodies = ["base", "a"]', "constraints[1].bodies: 'a' is not the name"),
        ('bodies = ["base", "coupler"]', 'bodies = ["coupler", "base"]', "'base' is the second; name it first"),
        ('bodies = ["base", "coupler"]', 'bodies = ["coupler", "coupler"]', "constraints[1].bodies: 'coupler' twice"),
        ('bodies = ["base", "coupler"]', "", "constraints[1].bodies: is missing"),
        ('motion = "planar"', 'motion = "planar"\nmetric = [1, "1/3"]', "metric[2]: 1/3 is not a positive integer"),
        ('motion = "planar"', 'motion = "planar"\nmetric = 3', "metric: 3 is not a list"),
        ("point = [7, 0]", "point = [7, 0, 1]", "constraints[3] ('pin of the rocker').point"),
        ('type = "at-point"', 'type = "glue"', "constraints[1].type: 'glue' is unknown"),
        ("[platform]", "[nominal]\nposition = [0, 0]\n[platform]", "nominal: a file of kind links has no pose"),
        ("[platform]", '[[configurations]]\nname = "a"\npose = 1\n[platform]', "configurations[1].pose: does not say"),
    ],
)
def test_what_is_wrong_is_said_in_a_sentence(old: str, new: str, words: str) -> None:
    text = Path(MODEL).read_text(encoding="utf-8")
    assert old in text
    with pytest.raises(InputError) as refused:
        any_from_toml(text.replace(old, new, 1))
    assert words in str(refused.value)


def test_too_many_unknowns_are_refused() -> None:
    constraint = _example(CONSTRAINTS["distance"], Random(1))
    bodies = tuple(LinkBody(f"b{k}", SPATIAL) for k in range(6))
    with pytest.raises(InputError, match="72 unknowns in all, at most 64"):
        LinkEquations(Links(Mechanism("x", "1", "x", (constraint,)), bodies, ((0, 1),), 1), (constraint,))


def test_a_body_of_a_planar_mechanism_may_only_shift() -> None:
    text = (
        Path(MODEL)
        .read_text(encoding="utf-8")
        .replace('name = "rocker"', 'name = "rocker"\nmotion = "translation"\nstart = { position = [1, 2] }', 1)
    )
    found = any_from_toml(text)
    assert isinstance(found, Links)
    assert found.bodies[1].motion is TRANSLATION
    assert found.bodies[1].start is not None


def test_solve_prints_poses_of_all_bodies(capsys: pytest.CaptureFixture[str], tmp_path: Path) -> None:
    path = tmp_path / "four-bar.json"
    assert main(["solve", MODEL, "--format", "json", "-o", str(path)]) == 0
    printed = json.loads(capsys.readouterr().out)
    assert (printed["claim"], printed["complex_solutions"], printed["real_poses"]) == ("complete", 2, 2)
    assert printed["platform"] == "coupler"
    assert [list(pose["bodies"]) for pose in printed["poses"]] == [["coupler", "rocker"]] * 2
    for pose in printed["poses"]:
        assert pose["bodies"]["coupler"]["planar"] == pose["planar"]
    assert check_bytes(path.read_bytes()).status == "accepted"
    assert main(["solve", MODEL]) == 0
    table = capsys.readouterr().out
    assert "2 complex solutions, 2 real poses; complete" in table
    angles = sorted(float(line.split()[-1]) for line in table.splitlines() if line[:1].isdigit() and "." in line)
    wanted = [
        degrees(atan2(*(float(Fraction(pose["planar"][k][0])) for k in ("sin", "cos")))) for pose in printed["poses"]
    ]
    assert angles == pytest.approx(sorted(wanted), abs=1e-6)


def test_joint_values_are_taken(capsys: pytest.CaptureFixture[str]) -> None:
    model = str(ROOT / "models" / "links" / "3-rrr-links.toml")
    values = ",".join(str(value) for value in _links("3-rrr-links").configuration().values)
    assert main(["solve", model, "--joints", values, "--format", "json"]) == 0
    printed = json.loads(capsys.readouterr().out)
    assert printed["configuration"]["name"] == "joints given"
    assert printed["real_poses"] == 2


@pytest.mark.parametrize(
    ("words", "sentence"),
    [
        (["--lengths", "1,2,3"], "--lengths: belongs to robots with legs"),
        (["--formulation", "AFD1"], "--formulation: a mechanism with passive bodies has one"),
        (["--tolerance", "1"], "--tolerance: is for robots with legs"),
        (["--near", "1,2,3"], "--near: a mechanism with passive bodies has no nominal pose"),
        (["--feasible"], "--feasible: a mechanism with passive bodies has no limits"),
        (["--format", "csv"], "--format csv: has no place for several bodies"),
        (["--method", "newton"], "--method newton: is not for mechanisms with passive bodies"),
        (["--start", "1,2,3"], "--start: belongs to the method krawczyk"),
        (["--method", "krawczyk", "--start", "1,2,3,1,0,0,0"], "--start: 7 numbers, but the mechanism is planar"),
        (["--method", "krawczyk", "--time-limit", "3"], "--time-limit: belongs to the method exact"),
        (["--configuration", "other"], "configuration: 'other' is unknown"),
        (["--joints", "1"], "--joints: 1 values; give 0"),
    ],
)
def test_options_that_mean_nothing_are_refused(
    words: list[str], sentence: str, capsys: pytest.CaptureFixture[str], tmp_path: Path
) -> None:
    path = tmp_path / "never.json"
    assert main(["solve", MODEL, "-o", str(path), *words]) == 2
    error = capsys.readouterr().err
    assert sentence in error
    assert error.count("\n") == 1
    assert not path.exists()


@pytest.mark.parametrize(
    "words",
    [
        ["mobility", MODEL],
        ["statics", MODEL],
        ["formulations", MODEL],
        ["compare", MODEL],
        ["legs", MODEL, "--position", "0,0", "--half-tangent", "0"],
        ["export", MODEL, "--to", "msolve"],
    ],
)
def test_commands_for_one_platform_refuse_at_once(words: list[str], capsys: pytest.CaptureFixture[str]) -> None:
    assert main(words) == 2
    error = capsys.readouterr().err
    assert "kind: links is a mechanism with passive bodies" in error
    assert error.count("\n") == 1


def test_files_of_other_kinds_have_no_links() -> None:
    with pytest.raises(InputError, match="kind: 3-RPR has no passive bodies"):
        read_links(ROOT / "models" / "3-rpr-merlet-p.toml")
    with pytest.raises(InputError, match="only certify-poses solve takes those"):
        read_robot(MODEL)
