"""Every type of constraint against its own equation, and the wrenches against derivatives; every group of motions."""

from fractions import Fraction
from random import Random

import pytest

from pkm_exact.constraints.constraint import Constraint, Role
from pkm_exact.constraints.constraint_types import CONSTRAINTS
from pkm_exact.constraints.form import SIZE, Form, Vector, rational_wrench, value_at, wrench
from pkm_exact.geometry.inverse import Matrix, dot, rotation_of
from pkm_exact.geometry.study import evaluate, motion_quadrics, translation_coordinates
from pkm_exact.motions.motion import Motion
from pkm_exact.motions.motion_groups import MOTIONS

METRICS = ((1, 1, 1), (1, 3, 1), (2, 3, 5))
Pose = tuple[Vector, Matrix]


def number(random: Random) -> Fraction:
    return Fraction(random.randrange(-9, 10), random.randrange(1, 5))


def vector(random: Random) -> Vector:
    return number(random), number(random), Fraction(random.randrange(1, 9))


def some_pose(random: Random, metric: tuple[int, int, int]) -> Pose:
    return vector(random), rotation_of((*vector(random), number(random)), metric)


def inverse(pose: Pose, metric: tuple[int, int, int]) -> Pose:
    position, rotation = pose
    back = [[rotation[j][i] * metric[j] / metric[i] for j in range(3)] for i in range(3)]
    turned = [-sum((back[i][j] * position[j] for j in range(3)), Fraction(0)) for i in range(3)]
    return (turned[0], turned[1], turned[2]), tuple(map(tuple, back))  # type: ignore[return-value]


def some(type_: str, random: Random) -> Constraint:
    """A constraint of a type with random data, its value not yet fitted to a pose."""
    made = {
        Role.NUMBER: number,
        Role.POSITIVE: lambda r: abs(number(r)) + 1,
        Role.COEFFICIENTS: lambda r: tuple(number(r) for _ in range(SIZE)),
    }
    values = {key: made.get(role, vector)(random) for key, role in CONSTRAINTS[type_].fields.items()}
    return CONSTRAINTS[type_](**values, name="it")  # type: ignore[call-arg]


def admits(constraint: Constraint, pose: Pose, metric: tuple[int, int, int]) -> bool:
    """Whether a constraint holds, by its forms and quadrics."""

    def value(form: Form) -> Fraction:
        return Fraction(value_at(form, *pose, metric))

    linear = all(value(form) == 0 for form in constraint.forms(metric))
    return linear and all(value(q.linear) == q.factor * value(q.root) ** 2 for q in constraint.squares(metric))


def placed(point: Vector, pose: Pose) -> Vector:
    x, y, z = (
        c + sum((r * b for r, b in zip(row, point, strict=True)), Fraction(0)) for c, row in zip(*pose, strict=True)
    )
    return x, y, z


def difference(a: Vector, b: Vector) -> Vector:
    return a[0] - b[0], a[1] - b[1], a[2] - b[2]


def direct(constraint: Constraint, pose: Pose, metric: tuple[int, int, int]) -> bool:
    """Whether a constraint holds, by its definition in coordinates."""
    c = constraint
    match c.type:
        case "distance":
            d = difference(placed(c.platform, pose), c.base)
            return dot(d, d, metric) == c.length_squared
        case "in-plane":
            return dot(c.normal, placed(c.platform, pose), metric) == c.offset
        case "carries":
            return dot(c.normal, placed(c.base, inverse(pose, metric)), metric) == c.offset
        case "angle":
            return dot(c.base, placed(c.platform, ((Fraction(0),) * 3, pose[1])), metric) == c.product
        case "at-point":
            return placed(c.platform, pose) == c.point
        case "on-line":
            d, v = difference(placed(c.platform, pose), c.point), c.direction
            return all(d[i] * v[j] == d[j] * v[i] for i in range(3) for j in range(3))
        case "axis-distance":
            d, v = difference(placed(c.platform, pose), c.point), c.direction
            return dot(d, d, metric) - dot(d, v, metric) ** 2 / dot(v, v, metric) == c.radius_squared
    assert c.type == "linear"
    return value_at(c.coefficients, *pose, metric) == 0


def fitted(constraint: Constraint, pose: Pose, metric: tuple[int, int, int]) -> Constraint:
    """The same constraint with the value that it has at a pose."""
    values = {key: getattr(constraint, key) for key in constraint.fields}
    match constraint.type:
        case "on-line":
            values["point"] = tuple(
                p + 3 * v for p, v in zip(placed(constraint.platform, pose), constraint.direction, strict=True)
            )
        case "at-point":
            values["point"] = placed(constraint.platform, pose)
        case "linear":
            rest = value_at(constraint.coefficients, *pose, metric)
            values["coefficients"] = (*constraint.coefficients[:-1], constraint.coefficients[-1] - rest)
        case "axis-distance":
            (quadric,) = constraint.squares(metric)
            rest = value_at(quadric.linear, *pose, metric) - quadric.factor * value_at(quadric.root, *pose, metric) ** 2
            values["radius_squared"] += rest
        case _:
            (form,) = constraint.forms(metric)
            values[constraint.value_field] += value_at(form, *pose, metric)
    return type(constraint)(**values, name="it")


@pytest.mark.parametrize("metric", METRICS)
@pytest.mark.parametrize("type_", CONSTRAINTS)
def test_a_constraint_is_its_equation(type_: str, metric: tuple[int, int, int]) -> None:
    random = Random(type_)
    for _ in range(5):
        pose = some_pose(random, metric)
        constraint = some(type_, random)
        there = fitted(constraint, pose, metric)
        assert admits(constraint, pose, metric) == direct(constraint, pose, metric)
        assert admits(there, pose, metric)
        assert direct(there, pose, metric)
        elsewhere = some_pose(random, metric)
        assert admits(there, elsewhere, metric) == direct(there, elsewhere, metric)


@pytest.mark.parametrize("type_", CONSTRAINTS)
def test_a_mirrored_constraint_admits_the_inverse_poses(type_: str) -> None:
    random, metric = Random(type_), (1, 1, 1)
    pose = some_pose(random, metric)
    mirrored = fitted(some(type_, random), pose, metric).mirrored()
    assert mirrored is None or admits(mirrored, inverse(pose, metric), metric)
    assert mirrored is None or not admits(mirrored, pose, metric)


@pytest.mark.parametrize("type_", CONSTRAINTS)
def test_a_constraint_says_what_it_is(type_: str) -> None:
    found = CONSTRAINTS[type_]
    assert found.type == type_
    assert found.value_field is None or found.value_field in found.fields
    constraint = some(type_, Random(1))
    assert len(constraint.forms((1, 1, 1))) + len(constraint.squares((1, 1, 1))) == found.codimension
    assert constraint.name == "it"


class Dual:
    """a + b eps, eps^2 = 0: derivatives without formulas."""

    def __init__(self, a: Fraction, b: Fraction = Fraction(0)) -> None:
        self.a, self.b = a, b

    def __add__(self, other: "Dual | Fraction | int") -> "Dual":
        return Dual(self.a + other.a, self.b + other.b) if isinstance(other, Dual) else Dual(self.a + other, self.b)

    def __mul__(self, other: "Dual | Fraction | int") -> "Dual":
        if isinstance(other, Dual):
            return Dual(self.a * other.a, self.a * other.b + self.b * other.a)
        return Dual(self.a * other, self.b * other)

    def __truediv__(self, other: int) -> "Dual":
        return Dual(self.a / other, self.b / other)

    __radd__, __rmul__ = __add__, __mul__


@pytest.mark.parametrize("metric", METRICS)
def test_a_wrench_is_the_derivative_along_a_twist(metric: tuple[int, int, int]) -> None:
    random = Random(7)
    position, rotation = some_pose(random, metric)
    form = [number(random) for _ in range(SIZE)]
    found = rational_wrench(form, position, rotation, metric)
    still = [[Dual(x) for x in row] for row in rotation]
    for k in range(3):
        moving = [Dual(c, Fraction(i == k)) for i, c in enumerate(position)]
        assert value_at(form, moving, still, metric).b == found[k]
    for n, (_, j, k) in enumerate(((0, 1, 2), (1, 2, 0), (2, 0, 1))):
        slope = [[Fraction(0)] * 3 for _ in range(3)]
        for column in range(3):
            slope[k][column], slope[j][column] = metric[j] * rotation[j][column], -metric[k] * rotation[k][column]
        turning = [[Dual(a, b) for a, b in zip(*rows, strict=True)] for rows in zip(rotation, slope, strict=True)]
        assert value_at(form, [Dual(c) for c in position], turning, metric).b == found[3 + n]
    if metric == (1, 1, 1):
        assert found == wrench(form, position, rotation)


def pose_in(motion: Motion, random: Random, metric: tuple[int, int, int]) -> Pose:
    """A random pose of a group, from its Study coordinates."""
    e = [number(random) if k in motion.support else Fraction(0) for k in range(4)]
    e[0] += 20
    rotation = rotation_of((e[0], e[1], e[2], e[3]), metric)
    free = [k in motion.twist for k in range(3)]
    x, y, z = (number(random) if moves else Fraction(0) for moves in free)
    return (x, y, z), rotation


@pytest.mark.parametrize("metric", METRICS)
@pytest.mark.parametrize("motion", MOTIONS.values(), ids=str)
def test_a_motion_satisfies_its_forms_and_stays_in_its_support(motion: Motion, metric: tuple[int, int, int]) -> None:
    random = Random(motion.name)
    assert motion.dimension == len(motion.twist)
    for _ in range(3):
        position, rotation = pose_in(motion, random, metric)
        assert all(value_at(form, position, rotation, metric) == 0 for form in motion.forms)
        others = [m for m in MOTIONS.values() if m.dimension > motion.dimension and m.name != "spatial"]
        for other in others:
            inside = all(value_at(form, position, rotation, metric) == 0 for form in other.forms)
            assert inside == set(motion.support).issubset(other.support)


@pytest.mark.parametrize("motion", MOTIONS.values(), ids=str)
def test_the_study_coordinates_off_the_support_are_0(motion: Motion) -> None:
    random, metric = Random(motion.name), (1, 1, 1)
    e = [number(random) if k in motion.support else Fraction(0) for k in range(4)]
    position = [number(random) if k in motion.twist else Fraction(0) for k in range(3)]
    f = translation_coordinates([[c * x for x in e] for c in position], metric)
    point = [*e, *f]
    assert all(point[k] == 0 for k in range(8) if k not in motion.support)
    products = [[a * b for b in point] for a in point]
    values = [evaluate(quadric, products) for quadric in motion_quadrics(metric)]
    assert all(sum(a * b for a, b in zip(form, values, strict=True)) == 0 for form in motion.forms)
