"""Checks certificates of a platform's mobility with Python's integers and nothing else.

The part of the plain checker that ``pure.py``, beside this file, uses when it meets such a certificate; constraints are
read by ``pure_mechanism.py``, proofs of ranks by ``pure_mobility.py``. Written from the definition of the format,
``docs/certificates-platform.md``; the functions below have its order and its notation. It shares no line with the other
checker.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from fractions import Fraction
from itertools import pairwise, product
from typing import TYPE_CHECKING, Any, Final, NamedTuple, TypeAlias

if TYPE_CHECKING or __package__:
    from pkm_exact.certify import pure, pure_mechanism, pure_mobility
else:
    import pure
    import pure_mechanism
    import pure_mobility

__all__ = ["replayed"]

Row: TypeAlias = tuple[Fraction, ...]

FORMAT: Final = "pkm_exact platform certificate"
KEYS: Final = "format version robot actuated pose everywhere"
ROUTES: Final = ("full", "combination", "grid", "none")
MAX_POSES: Final = 20_000
ORDER: Final = ((0, 1, 2), (1, 2, 0), (2, 0, 1))

# ---------------------------------------------------------------------------------------------------------------------
# Format
# ---------------------------------------------------------------------------------------------------------------------


class Pose(NamedTuple):
    """C and R."""

    position: Row
    rotation: tuple[Row, ...]


class Everywhere(NamedTuple):
    """The rank at every pose."""

    pose: Pose
    rows: tuple[int, ...]
    columns: tuple[int, ...]
    route: str
    combinations: tuple[Row, ...]


a_vector: Final = pure.a_list(pure.a_rational, 3)
a_matrix: Final = pure.a_list(a_vector, 3)


def increasing(value: Any, where: str) -> tuple[int, ...]:
    """Numbers from 0, each greater than the one before."""
    places: tuple[int, ...] = pure.a_list(pure.a_number)(value, where)
    pure.well_formed(all(a < b for a, b in pairwise(places)), f"{where}: not in increasing order")
    return places


def some_places(value: Any, where: str, number: int) -> tuple[int, ...]:
    """So many of them."""
    pure.well_formed(isinstance(value, list) and len(value) == number, f"{where}: not a list of {number}")
    return increasing(value, where)


def replayed(body: dict[str, Any]) -> Iterator[str]:
    """The content, read at once, and its checks, one after another."""
    version = body.get("version")
    known = body.get("format") == FORMAT and type(version) is int and version == 1
    pure.well_formed(known, f"format: not a {FORMAT}, version 1")
    _, _, machine, actuated, pose, everywhere = pure.an_object(body, "certificate", KEYS)
    robot = pure_mechanism.a_robot(machine, "robot")
    locked = increasing(actuated, "actuated")
    pure.well_formed(all(place < len(robot.constraints) for place in locked), "actuated: no place of a constraint")
    at = None
    if pose is not None:
        position, rotation, free, held = pure.an_object(pose, "pose", "position rotation free locked")
        placed = Pose(a_vector(position, "pose.position"), a_matrix(rotation, "pose.rotation"))
        proofs = [pure_mobility.a_rank_proof(free, "pose.free"), pure_mobility.a_rank_proof(held, "pose.locked")]
        at = placed, proofs
    return checks(robot, locked, at, None if everywhere is None else read_everywhere(everywhere))


def read_everywhere(value: Any) -> Everywhere:
    """What is claimed at every pose."""
    rank, position, rotation, rows, columns, route, combinations = pure.an_object(
        value, "everywhere", "rank position rotation rows columns route combinations"
    )
    number = pure.a_number(rank, "everywhere.rank")
    places = [some_places(rows, "everywhere.rows", number), some_places(columns, "everywhere.columns", number)]
    word = pure.one_of(ROUTES)(route, "everywhere.route")
    vectors = pure.a_list(pure.a_list(pure.a_rational))(combinations, "everywhere.combinations")
    pure.well_formed(bool(vectors) == (word == "combination"), "everywhere.combinations: not those of the route")
    placed = Pose(a_vector(position, "everywhere.position"), a_matrix(rotation, "everywhere.rotation"))
    return Everywhere(placed, places[0], places[1], word, vectors)


# ---------------------------------------------------------------------------------------------------------------------
# Rows
# ---------------------------------------------------------------------------------------------------------------------


def total(terms: Sequence[Any]) -> Any:
    """The sum."""
    return sum(terms, 0 * terms[0])


def row_of(c: Sequence[Any], g: pure.Metric, at: Sequence[Any], r: Sequence[Sequence[Any]], one: Any) -> list[Any]:
    """g1 g2 g3 (F; T) of a form, and n times it if R is n times a rotation matrix and ``one`` is n."""
    volume = g[0] * g[1] * g[2]
    a = [total([volume // g[n] * g[i] * r[i][n] * c[1 + n] for n in range(3)]) for i in range(3)]
    found = [volume * one * (2 * g[i] * c[0] * at[i] + c[4 + i]) + a[i] for i in range(3)]
    for _, j, k in ORDER:
        turned = [g[j] * r[j][n] * c[7 + 3 * k + n] - g[k] * r[k][n] * c[7 + 3 * j + n] for n in range(3)]
        found.append(g[k] * a[j] * at[k] - g[j] * a[k] * at[j] + volume * total(turned))
    return found


def values_at(pose: Pose, g: pure.Metric) -> Row:
    """The 17 coordinates."""
    c, r = pose
    turned = [total([g[i] * r[i][n] * c[i] for i in range(3)]) / g[n] for n in range(3)]
    square = total([weight * x * x for weight, x in zip(g, c, strict=True)])
    return (square, *turned, *c, *(entry for row in r for entry in row), Fraction(1))


def value_of(form: Sequence[Fraction], values: Row) -> Fraction:
    """A form at a pose."""
    bits = pure_mobility.longest([form]), pure_mobility.longest([values])
    pure.spend(17 * pure.fraction_cost(*bits))
    return total([x * y for x, y in zip(form, values, strict=True)])  # type: ignore[no-any-return]


def rows_at(
    robot: pure_mechanism.Robot, constraints: Sequence[pure_mechanism.Constraint], pose: Pose
) -> list[list[Fraction]]:
    """The rows of constraints in the columns of the motions."""
    g, values = robot.metric, values_at(pose, robot.metric)
    found = []
    for constraint in constraints:
        bits = pure_mobility.longest(constraint.forms) + pure_mobility.longest([values])
        pure.spend(100 * len(constraint.forms) * pure.fraction_cost(bits, bits))
        rows = [row_of(form, g, pose.position, pose.rotation, Fraction(1)) for form in constraint.forms]
        if constraint.weight is not None:
            slope = 2 * value_of(constraint.forms[1], values)
            rows = [[constraint.weight * x - slope * y for x, y in zip(*rows, strict=True)]]
        found += [[row[k] for k in robot.kind.twists] for row in rows]
    return found


def require_motion(robot: pure_mechanism.Robot, pose: Pose, where: str) -> None:
    """R^T G R = G, det R = 1, and the forms L are 0."""
    g, r = robot.metric, pose.rotation
    bits = pure_mobility.longest([pose.position, *r])
    pure.spend(200 * pure.fraction_cost(3 * bits, 3 * bits))
    for a in range(3):
        for b in range(a + 1):
            found = total([g[i] * r[i][a] * r[i][b] for i in range(3)])
            pure.require(found == (g[a] if a == b else 0), f"{where}.rotation: not one in the metric")
    terms = [r[0][i] * (r[1][j] * r[2][k] - r[1][k] * r[2][j]) for i, j, k in ORDER]
    pure.require(total(terms) == 1, f"{where}.rotation: not one in the metric")
    values = values_at(pose, g)
    inside = not any(value_of(form, values) for form in robot.fixed)
    pure.require(inside, f"{where}: not one of the motions")


# ---------------------------------------------------------------------------------------------------------------------
# Checks
# ---------------------------------------------------------------------------------------------------------------------


def checks(robot: pure_mechanism.Robot, locked: Sequence[int], at: Any, everywhere: Everywhere | None) -> Iterator[str]:
    """One line for each claim that is proved."""
    yield f"robot: {len(robot.constraints)} constraints, {len(locked)} of them actuated"
    yield "pose: nothing is claimed" if at is None else check_pose(robot, locked, *at)
    yield "everywhere: nothing is claimed" if everywhere is None else check_everywhere(robot, everywhere)


def check_pose(robot: pure_mechanism.Robot, locked: Sequence[int], pose: Pose, proofs: Sequence[Any]) -> str:
    """The ranks at a pose."""
    require_motion(robot, pose, "pose")
    always = [constraint for place, constraint in enumerate(robot.constraints) if place not in locked]
    values, m = values_at(pose, robot.metric), len(robot.kind.twists)
    for constraint in always:
        found = [value_of(form, values) for form in constraint.forms]
        if constraint.weight is not None:
            found = [constraint.weight * found[0] - found[1] * found[1]]
        pure.require(not any(found), "pose: a constraint that always holds does not hold there")
    free = len(pure_mobility.proved(proofs[0], rows_at(robot, always, pose), m, "pose.free"))
    left = len(pure_mobility.proved(proofs[1], rows_at(robot, robot.constraints, pose), m, "pose.locked"))
    return f"pose: rank {m - free}, freedom {free}; with the actuators locked rank {m - left}, freedom {left}"


def check_everywhere(robot: pure_mechanism.Robot, claim: Everywhere) -> str:
    """The rank at every pose."""
    pure.require(not robot.quadrics, "everywhere: a constraint is a quadric")
    require_motion(robot, claim.pose, "everywhere")
    rows, m, r = rows_at(robot, robot.constraints, claim.pose), len(robot.kind.twists), len(claim.rows)
    inside = all(place < len(rows) for place in claim.rows) and all(place < m for place in claim.columns)
    pure.well_formed(inside, "everywhere: a place outside the matrix")
    minor = [[rows[i][j] for j in claim.columns] for i in claim.rows]
    pure.require(pure_mobility.rank_of(minor) == r, "everywhere: the minor is 0")
    if claim.route == "full":
        pure.require(r == min(len(rows), m), "everywhere: the rank is not the largest possible")
        return f"everywhere: rank {r}, the largest possible, at almost every pose"
    if claim.route == "none":
        return f"everywhere: rank {r} was met, a larger one is not excluded"
    if claim.route == "combination":
        check_combinations(robot, claim.combinations, r)
    else:
        check_grid(robot, r)
    return f"everywhere: rank {r} at most, at every pose"


def check_combinations(robot: pure_mechanism.Robot, combinations: Sequence[Row], r: int) -> None:
    """Independent combinations of the rows are 0 at every pose."""
    forms = robot.linear
    fits = all(len(factors) == len(forms) for factors in combinations)
    pure.well_formed(fits, "everywhere.combinations: not a number for each row")
    left = len(forms) - len(combinations)
    pure.require(r == left, "everywhere: not the rank that the combinations leave")
    independent = pure_mobility.rank_of(combinations) == len(combinations)
    pure.require(independent, "everywhere.combinations: not independent")
    slopes = [[form[k] for form in forms] for k in range(16)]
    known = pure_mechanism.Span([form[:16] for form in robot.fixed])
    for factors in combinations:
        rest = known.remainder(pure_mobility.applied(slopes, factors))
        pure.require(not any(rest), "everywhere.combinations: not 0 at every pose")


def check_grid(robot: pure_mechanism.Robot, r: int) -> None:
    """No pose of the grid has a greater rank."""
    kind, g = robot.kind, robot.metric
    columns_of_w = len([k for k in kind.twists if k >= 3])
    columns_of_v = len(kind.twists) - columns_of_w
    t = 2 * (r + 1) if columns_of_w else 0
    p = min(r + 1, columns_of_w + 1) if columns_of_v else 0
    turns = list(points([k in kind.support for k in range(1, 4)], t))
    places = list(points([k in kind.twists for k in range(3)], p))
    few = len(turns) * len(places) <= MAX_POSES
    pure.affordable(few, f"everywhere: a grid of more than {MAX_POSES} poses")
    forms = [pure_mobility.whole(form[:16]) for form in robot.linear]

    def is_greater(pose: tuple[tuple[int, ...], tuple[int, ...]]) -> bool:
        e, at = pose
        pure.spend(len(forms) * (50_000 + 50 * pure.most_bits(x for form in forms for x in form)))
        turned = pure.motion((1, *e), (0, 0, 0, 0), g)
        rows = [row_of(form, g, at, turned.rotation, turned.norm) for form in forms]
        return len(pure_mobility.echelon([[row[k] for k in kind.twists] for row in rows])) > r

    greater = any(map(is_greater, product(turns, places)))
    pure.require(not greater, "everywhere: the rank is greater at a pose of the grid")


def points(free: Sequence[bool], most: int) -> Iterator[tuple[int, ...]]:
    """Whole points with coordinates >= 0, 0 where they are not free, and a sum of at most so much."""
    if not free:
        yield ()
        return
    for first in range(most + 1 if free[0] else 1):
        for rest in points(free[1:], most - first):
            yield (first, *rest)
