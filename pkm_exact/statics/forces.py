"""Actuator forces that bear a load, and what is free in them where actuators are redundant.

A load f, the force and moment about the platform's origin that act on the platform, is in equilibrium with the forces s
of the actuators and those of the other constraints, l at unit wrench, if they do no work together on any twist:

    J^T s + W_s^T l = -f

A force is positive where it acts towards greater values: a leg that pushes, so a cable pulls where it is negative. If
there are more unknowns than freedoms, internal loads z, J^T z = 0, can be added (Mueller, in Parallel Manipulators:
Towards New Applications (2008), chapter 5).
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from fractions import Fraction
from typing import Any, Final

from flint import arb, arb_mat

from pkm_exact.errors import InputError
from pkm_exact.polytopes.enclosures import ball_of, interval_of
from pkm_exact.polytopes.rationals import rational_matrix
from pkm_exact.polytopes.slabs import Slabs
from pkm_exact.precision import working_precision
from pkm_exact.radicals import OutOfReachError, RootSum, independent_roots
from pkm_exact.roots.interval import Interval
from pkm_exact.statics.ball_rows import BITS
from pkm_exact.statics.entangled_rows import solved
from pkm_exact.statics.exact_rows import column_squares
from pkm_exact.statics.freedom import Freedom
from pkm_exact.statics.linear_program import greatest
from pkm_exact.statics.pose_rows import PoseRows
from pkm_exact.statics.ranks import left_kernel

MOST_ROOTS: Final = 4
"""Independent square roots with which forces are exact: numbers have up to 2^4 terms."""
NOT_EXACT = "forces: internal loads are computed at exact poses of machines all of whose constraints are actuated"


@dataclass(frozen=True)
class Forces:
    """Forces that bear a load.

    Attributes
    ----------
    names : tuple of str
        Of the actuators, then of the other constraints.
    values : tuple of Interval
        The forces; of redundant actuators those of least norm.
    signs : tuple of int or None
        Proved; 0 if it is exactly 0, None where it is not decided.
    exact : tuple of str or None
        As sums of square roots.
    is_unique : bool
        Whether there are no others.
    """

    names: tuple[str, ...]
    values: tuple[Interval, ...]
    signs: tuple[int | None, ...]
    exact: tuple[str, ...] | None
    is_unique: bool


def moved_load(load: Sequence[Fraction], offset: Sequence[Any]) -> list[Any]:
    """A load whose force acts at a point, as one at the origin: the moment of the force is added.

    >>> [str(x) for x in moved_load([Fraction(0), Fraction(0), Fraction(-2), *[Fraction(0)] * 3], (1, 0, 0))]
    ['0', '0', '-2', '0', '2', '0']
    """
    force, moment = load[:3], load[3:]
    arm = list(offset)

    def product(i: int, k: int) -> Any:
        if isinstance(arm[i], arb):
            return arm[i] * ball_of(force[k])
        return arm[i] * force[k]

    turned = [product(1, 2) - product(2, 1), product(2, 0) - product(0, 2), product(0, 1) - product(1, 0)]
    return [*force, *(m + t if not isinstance(t, arb) else ball_of(m) + t for m, t in zip(moment, turned, strict=True))]


def forces(at: PoseRows, load: Sequence[Any]) -> Forces:
    """The forces of actuators and constraints that bear a load.

    Parameters
    ----------
    load : sequence of numbers
        On the platform, about its origin: a component for each freedom of the motion, ordinary coordinates.

    Raises
    ------
    InputError
        If no forces bear it, or the pose is singular.
    """
    if len(load) != len(at.twist):
        raise InputError(f"load: {len(load)} components; give {len(at.twist)}: {', '.join(at.twist)}")
    freedom = Freedom(at)
    if freedom.directions is not None and not any(isinstance(x, arb) for x in load):
        return _exactly(at, freedom, load)
    exact = None if any(isinstance(x, arb) for x in load) else _by_elimination(at, load)
    if exact is not None:
        return exact
    with working_precision(BITS):
        return _in_balls(at, freedom, load)


def _by_elimination(at: PoseRows, load: Sequence[Any]) -> Forces | None:
    """Of as many constraints as freedoms at an exact pose, over sums of square roots; None if these are too many."""
    rows = at.exact_apart
    if rows is None or len(rows) != len(load):
        return None
    roots = [RootSum.root(1 / k) for k in column_squares(at.metric, at.motion.twist)]
    wanted = [RootSum.of(-1 * x) * root for x, root in zip(load, roots, strict=True)]
    numbers = [*wanted, *(RootSum.of(x) for row in rows for x in (*row.wrench, *row.rates.values()))]
    if independent_roots({n for number in numbers for n, _ in number.terms}) > MOST_ROOTS:
        return None
    lines, sizes = [], []
    for k, actuator in enumerate(at.held.actuators):
        inverse = rows[actuator.equation].rates[k].inverse()
        lines.append([inverse * x for x in rows[actuator.equation].wrench])
        sizes.append(RootSum.of(1))
    for index in at.held.structural:
        line = list(rows[index].wrench)
        for k, rate in rows[index].rates.items():
            line = [x - rate * y for x, y in zip(line, lines[k], strict=True)]
        lines.append(line)
        sizes.append(RootSum.root(rows[index].size_squared))
    try:
        found = solved([[RootSum.of(line[j]) for line in lines] for j in range(len(load))], [[x] for x in wanted])
        if found is None:
            raise InputError("load: the pose is singular, so that not every load can be borne; give another pose")
        values = [size * x[0] for size, x in zip(sizes, found, strict=True)]
    except OutOfReachError:
        return None
    names = (*at.actuated, *(at.equations[index].name for index in at.held.structural))
    signs = tuple(value.sign() for value in values)
    return Forces(names, tuple(map(interval_of, values)), signs, tuple(map(str, values)), is_unique=True)


def _exactly(at: PoseRows, freedom: Freedom, load: Sequence[Any]) -> Forces:
    """Of a machine all of whose constraints are actuated, at an exact pose."""
    found = freedom.directions
    if found is None:
        raise InputError(NOT_EXACT)
    roots = [RootSum.root(1 / k) for k in found.squares]
    wanted = [RootSum.of(-1 * x) * root for x, root in zip(load, roots, strict=True)]
    columns = rational_matrix([list(column) for column in zip(*found.rows, strict=True)])
    if columns.rank() < columns.nrows():
        raise InputError("load: the pose is singular, so that not every load can be borne; give another pose")
    if columns.nrows() == columns.ncols():
        inverse = columns.inv()
        products = [
            sum((x * Fraction(int(inverse[i, j].p), int(inverse[i, j].q)) for j, x in enumerate(wanted)), RootSum())
            for i in range(len(found.rows))
        ]
        values = [x * weight.inverse() for x, weight in zip(products, found.weights, strict=True)]
        signs = tuple(value.sign() for value in values)
        return Forces(at.actuated, tuple(map(interval_of, values)), signs, tuple(map(str, values)), is_unique=True)
    with working_precision(BITS):
        return _in_balls(at, freedom, load)


def _in_balls(at: PoseRows, freedom: Freedom, load: Sequence[Any]) -> Forces:
    rows, apart = freedom.ball_jacobian, at.ball_apart or ()
    matrix = rows.tolist()
    for index in at.held.structural:
        entries = list(apart[index].wrench)
        for actuator, rate in apart[index].rates.items():
            entries = [x - rate * rows[actuator, j] for j, x in enumerate(entries)]
        matrix.append(entries)
    names = (*at.actuated, *(at.equations[index].name for index in at.held.structural))
    full = arb_mat(matrix)
    wanted = arb_mat(len(load), 1, [-ball_of(x) for x in load])
    if full.nrows() < full.ncols():
        raise InputError("load: the machine has fewer constraints than freedoms, so that not every load can be borne")
    try:
        gram = full.transpose() * full
        solved = full * gram.solve(wanted)
    except ZeroDivisionError:
        raise InputError("load: the pose is or may be singular, so that not every load can be borne") from None
    values = [solved[i, 0] for i in range(full.nrows())]
    signs = tuple(1 if x > 0 else -1 if x < 0 else 0 if x.is_zero() else None for x in values)
    return Forces(names, tuple(map(interval_of, values)), signs, None, is_unique=full.nrows() == full.ncols())


def internal_loads(at: PoseRows) -> list[list[RootSum]]:
    """A basis of the actuator forces that bear nothing: J^T z = 0, exactly.

    Raises
    ------
    InputError
        If the pose is not exact, or constraints are not actuated.
    """
    found = Freedom(at).directions
    if found is None:
        raise InputError(NOT_EXACT)
    rows = [list(map(Fraction, row)) for row in found.rows]
    return [[x * weight.inverse() for x, weight in zip(z, found.weights, strict=True)] for z in left_kernel(rows)]


def has_force_closure(at: PoseRows) -> bool:
    """Whether actuators that can only pull, or only push, bear every load: some internal load is positive everywhere.

    With it, and J of full rank, every wrench is a combination with positive coefficients. Decided exactly.
    """
    found = Freedom(at).directions
    if found is None:
        raise InputError(NOT_EXACT)
    rows = [list(map(Fraction, row)) for row in found.rows]
    if rational_matrix(rows).rank() < len(rows[0]):
        return False
    return has_positive_vector(left_kernel(rows))


def has_positive_vector(basis: Sequence[Sequence[Fraction]]) -> bool:
    """Whether a combination of vectors has only positive entries, exactly.

    >>> has_positive_vector([[Fraction(1), Fraction(1)]]), has_positive_vector([[Fraction(1), Fraction(-1)]])
    (True, False)
    """
    if not basis:
        return False
    # Greatest e with every entry of the combination at least e, and none above 1.
    size, width = len(basis[0]), len(basis)
    rows, bounds = [], []
    for i in range(size):
        entries = [z[i] for z in basis]
        rows += [[*(-x for x in entries), Fraction(1)], [*entries, Fraction(0)]]
        bounds += [Fraction(0), Fraction(1)]
    return greatest([Fraction(0)] * width + [Fraction(1)], rows, bounds) > 0


def force_ranges(
    at: PoseRows, load: Sequence[Any], low: Sequence[Fraction], high: Sequence[Fraction]
) -> list[tuple[Interval, Interval]] | None:
    """For each redundant actuator the least and the greatest force with which a load can be borne within limits.

    None if it cannot be borne. Exact: vertices of the polytope of internal loads.
    """
    found = Freedom(at).directions
    if found is None:
        raise InputError(NOT_EXACT)
    rows = [list(map(Fraction, row)) for row in found.rows]
    basis = left_kernel(rows)
    if not basis:
        raise InputError("forces: the actuators are not redundant, so that there is one answer only")
    roots = [RootSum.root(1 / k) for k in column_squares(at.metric, at.motion.twist)]
    wanted = [RootSum.of(-1 * x) * root for x, root in zip(load, roots, strict=True)]
    columns = rational_matrix(rows)
    gram = columns.transpose() * columns
    back = columns * gram.inv()
    special = [
        sum((x * Fraction(int(back[i, j].p), int(back[i, j].q)) for j, x in enumerate(wanted)), RootSum())
        for i in range(len(rows))
    ]
    limits = [
        (_short(weight * lo - x), _short(weight * hi - x))
        for weight, lo, hi, x in zip(found.weights, low, high, special, strict=True)
    ]
    slabs = Slabs(
        tuple(tuple(z[i] for z in basis) for i in range(len(rows))),
        tuple(lo for lo, _ in limits),
        tuple(hi for _, hi in limits),
    )
    try:
        vertices = slabs.polytope().vertices
    except InputError:
        return None
    ranges = []
    for i, weight in enumerate(found.weights):
        values = [
            (sum((RootSum.of(v) * z[i] for v, z in zip(vertex, basis, strict=True)), special[i])) * weight.inverse()
            for vertex in vertices
        ]
        least = most = values[0]
        for value in values[1:]:
            least = value if (value - least).sign() < 0 else least
            most = value if (value - most).sign() > 0 else most
        ranges.append((interval_of(least), interval_of(most)))
    return ranges


def _short(value: RootSum) -> Any:
    rational = value.rational
    return value if rational is None else rational
