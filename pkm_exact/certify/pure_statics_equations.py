"""Checks certificates of what any machine can do at all poses of a box, with Python's integers and nothing else.

The part of the plain checker that ``pure_statics.py``, beside this file, uses for version 4. Written from the
definition of the format, ``docs/certificates-statics.md``; the functions below have its order and its notation. It
shares no line with the other checker.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from fractions import Fraction
from math import comb
from typing import TYPE_CHECKING, Any, Final, TypeAlias

if TYPE_CHECKING or __package__:
    from pkm_exact.certify import pure, pure_statics, pure_statics_box
    from pkm_exact.certify.pure import Interval
    from pkm_exact.certify.pure_statics_box import Ends, Line, Row, interval, scalar, whole
else:
    import pure
    import pure_statics
    import pure_statics_box
    from pure import Interval
    from pure_statics_box import Ends, Line, Row, interval, scalar, whole

__all__ = ["replayed"]

KEYS: Final = (
    "format version name unit solution metric freedoms position rotation actuators equations free speeds forces length "
    "load regular jacobian expansion actuator_forces velocity_polytope wrench_polytope ellipsoid indices"
)
MAX_EQUATIONS: Final = 18

Equation: TypeAlias = tuple[Row, tuple[Fraction, Row] | None, list[tuple[int, Row]]]
"""The form; factor and form of the square; forms of the rates with the actuators, from 0."""


@dataclass(frozen=True)
class Machine:
    """Metric, box, h_a, equations; free components as places, None if the twist follows from the actuators."""

    metric: tuple[int, ...]
    freedoms: tuple[int, ...]
    position: Line
    rotation: list[Line]
    h: Row
    equations: list[Equation]
    free: list[int] | None


# ---------------------------------------------------------------------------------------------------------------------
# Reading
# ---------------------------------------------------------------------------------------------------------------------


def replayed(body: dict[str, Any]) -> Iterator[str]:
    """The content, read at once, and its checks, one after another."""
    values = dict(zip(KEYS.split(), pure_statics.fields(body, "certificate", KEYS), strict=True))
    for where in ("name", "unit"):
        pure_statics_box.text_of(values[where], where)
    if values["solution"] is not None:
        digest, pose = pure_statics.fields(values["solution"], "solution", "digest pose")
        pure_statics_box.text_of(digest, "solution.digest")
        pure.well_formed(type(pose) is int and pose >= 1, "solution.pose: not a number from 1")
    machine = read_machine(values)
    m, n, forward = len(machine.h), len(machine.freedoms), machine.free is None
    f = m if machine.free is None else len(machine.free)
    speeds = None if values["speeds"] is None else pure_statics.vector(values["speeds"], "speeds", m)
    pure.well_formed(speeds is None or min(speeds) > 0, "speeds: one is not positive")
    forces = None if values["forces"] is None else pure_statics_box.row_of(values["forces"], "forces", m)
    good = forces is None or all(low < high for low, high in forces)
    pure.well_formed(good, "forces: a least one is not below the greatest")
    length = None if values["length"] is None else pure_statics.rational(values["length"], "length")
    pure.well_formed(length is None or length > 0, "length: not positive")
    load = None if values["load"] is None else pure_statics.vector(values["load"], "load", n)
    regular = values["regular"]
    pure.well_formed(type(regular) is bool, "regular: not true or false")
    limits = {"velocity_polytope": speeds, "ellipsoid": speeds, "wrench_polytope": forces, "actuator_forces": load}
    for name, limit in limits.items():
        pure.well_formed(values[name] is None or limit is not None, f"{name}: its limits or the load are missing")
    for name in ("jacobian", "ellipsoid", "indices"):
        pure.well_formed(not forward or values[name] is None, f"{name}: nothing is free, it must be null")
    p = None if forward else pure_statics_box.table_of(values["jacobian"], "jacobian", m, f)
    e = pure_statics_box.table_of(values["expansion"], "expansion", n, f)
    borne = None if load is None else pure_statics_box.row_of(values["actuator_forces"], "actuator_forces", m)
    claims = (
        borne,
        read_polytope(values["velocity_polytope"], "velocity_polytope", m, n if forward else f, sums=forward),
        read_polytope(values["wrench_polytope"], "wrench_polytope", m, n if forward else f, sums=not forward),
        None if values["ellipsoid"] is None else pure_statics_box.read_ellipsoid(values["ellipsoid"], m, f),
        None if values["indices"] is None else pure_statics.read_indices(values["indices"]),
    )
    listed = [[interval(*pair) for pair in row] for row in e]
    rows = listed_rows(p, listed)
    return checks(machine, (p, e), regular, pure_statics_box.Listed(rows, listed, speeds, forces, length, load), claims)


def listed_rows(p: list[list[Ends]] | None, e: list[Line]) -> list[Line]:
    """P, or Q = E^T if there is none."""
    if p is None:
        return [pure_statics_box.column(e, k) for k in range(len(e[0]))]
    return [[interval(*pair) for pair in row] for row in p]


def read_polytope(value: Any, where: str, m: int, size: int, *, sums: bool) -> tuple[bool, Any] | None:
    """Whether it is one of sums of rows, and what is listed; None if nothing is claimed."""
    if value is None:
        return None
    read: Any = pure_statics_box.read_wrench if sums else pure_statics_box.read_velocity
    return sums, read(value, m, size, where)


def read_machine(values: dict[str, Any]) -> Machine:
    """Actuators, equations and the box."""
    metric = pure_statics.integers(values["metric"], "metric", 3)
    pure.well_formed(min(metric) > 0, "metric: one is not positive")
    freedoms = pure_statics_box.places_of(values["freedoms"], "freedoms", range(6))
    position = pure_statics_box.row_of(values["position"], "position", 3)
    rotation = pure_statics_box.table_of(values["rotation"], "rotation", 3, 3)
    listed = pure_statics.list_of(values["actuators"], "actuators", pure_statics.MAX_LEGS)
    h = pure_statics.vector(listed, "actuators", len(listed))
    pure.well_formed(all(x > 0 for x in h), "actuators: one is not positive")
    entries = pure_statics.list_of(values["equations"], "equations", MAX_EQUATIONS)
    equations = [read_equation(entry, f"equations[{k}]", len(h)) for k, entry in enumerate(entries, 1)]
    free = None if values["free"] is None else pure_statics_box.places_of(values["free"], "free", freedoms)
    n, m = len(freedoms), len(h)
    e, f = (n, n) if free is None else (n - len(free) + m, len(free))
    pure.well_formed(len(equations) == e, f"equations: not {e}, as many as determine twist and speeds")
    pure.well_formed(f <= m, "actuators: fewer than components of the twist are free, or than it has")
    return Machine(
        metric,
        freedoms,
        [interval(*pair) for pair in position],
        [[interval(*pair) for pair in row] for row in rotation],
        h,
        equations,
        None if free is None else [freedoms.index(k) for k in free],
    )


def read_equation(value: Any, where: str, m: int) -> Equation:
    """Form, square and rates."""
    form, square, rates = pure_statics.fields(value, where, "form square rates")
    found = None
    if square is not None:
        factor, root = pure_statics.fields(square, f"{where}.square", "factor form")
        number = pure_statics.rational(factor, f"{where}.square.factor")
        pure.well_formed(number != 0, f"{where}.square.factor: is 0")
        found = number, pure_statics.vector(root, f"{where}.square.form", 17)
    pairs = []
    pure.well_formed(isinstance(rates, list), f"{where}.rates: not a list")
    for k, entry in enumerate(rates, 1):
        place = f"{where}.rates[{k}]"
        actuator, rate = pure_statics.entries_of(entry, place, 2)
        pure.well_formed(type(actuator) is int and 1 <= actuator <= m, f"{place}: not an actuator")
        pairs.append((actuator - 1, pure_statics.vector(rate, place, 17)))
    names = [actuator for actuator, _ in pairs]
    pure.well_formed(names == sorted(set(names)), f"{where}.rates: actuators are not increasing")
    return pure_statics.vector(form, f"{where}.form", 17), found, pairs


# ---------------------------------------------------------------------------------------------------------------------
# Checks
# ---------------------------------------------------------------------------------------------------------------------


def checks(
    machine: Machine,
    bounds: tuple[list[list[Ends]] | None, list[list[Ends]]],
    regular: bool,
    listed: pure_statics_box.Listed,
    claims: tuple[Any, ...],
) -> Iterator[str]:
    """One line for each claim that is proved."""
    borne, velocity, wrench, ellipsoid, indices = claims
    m, size = len(listed.p), len(listed.p[0])
    for name, claim in (("velocity_polytope", velocity), ("wrench_polytope", wrench)):
        few = claim is None or comb(m, size - claim[0]) << size <= pure_statics_box.MAX_CHOICES
        pure.affordable(few, f"{name}: too many choices of legs")
    w, r = matrices(machine)
    check_rows(machine, w, r, *bounds)
    if machine.free is None:
        yield f"machine: {m} actuators move {size} freedoms in a box of poses, T in its bounds"
    else:
        yield f"machine: {m} actuators in a box of poses, {size} freedoms, J in its bounds"
    if regular:
        check_regular(machine, w, r)
        yield "singularities: none in the box"
    if borne is not None and listed.load is not None:
        if machine.free is None:
            check_work(listed.p, listed.load, borne)
        else:
            pure_statics_box.check_forces(listed, listed.load, borne)
        yield "forces: those that bear the load, within their bounds"
    if velocity is not None and listed.speeds is not None:
        ends = pure_statics_box.both_ways(listed.speeds)
        yield f"velocity polytope: {proved(listed.p, ends, velocity, 'velocity_polytope')}, and no others"
    if wrench is not None and listed.forces is not None:
        yield f"wrench polytope: {proved(listed.p, listed.forces, wrench, 'wrench_polytope')}, and no others"
    if ellipsoid is not None and listed.speeds is not None:
        pure_statics_box.check_ellipsoid(listed, listed.speeds, *ellipsoid)
        yield "ellipsoid: in the velocity polytope, and no larger one but for the part that is said"
    if indices is not None:
        pure_statics_box.check_indices(listed, machine.freedoms, indices)
        yield "indices: singular values and condition within their bounds"


def proved(rows: list[Line], ends: Sequence[Ends], claim: tuple[bool, Any], where: str) -> str:
    """Checks 3 and 4: how many vertices and facets the polytope has, which are proved."""
    sums, (facets, vertices, volume) = claim
    if sums:
        pure_statics_box.check_wrench(rows, ends, facets, vertices, volume, where)
    else:
        pure_statics_box.check_velocity(rows, ends, facets, vertices, volume, where)
    return f"{len(vertices)} vertices, {len(facets)} facets"


def matrices(machine: Machine) -> tuple[list[Line], list[Line]]:
    """W and r."""
    roots: Any = [whole(g).root() for g in machine.metric]
    box: Any = machine
    h = [interval(x).root() for x in machine.h]
    w, r = [], []
    for form, square, rates in machine.equations:
        row = pure_statics_box.form_row(form, roots, box)
        if square is not None:
            factor, root = square
            twice = interval(2 * factor) * value_of(root, roots, machine)
            row = [x - twice * y for x, y in zip(row, pure_statics_box.form_row(root, roots, box), strict=True)]
        line = [whole(0)] * len(h)
        for actuator, rate in rates:
            line[actuator] = h[actuator] * value_of(rate, roots, machine)
        w.append(row)
        r.append(line)
    return w, r


def value_of(form: Row, roots: Line, machine: Machine) -> Interval:
    """c_s C.C + c'_u.(R^T C) + c'_C.C + sum c'_Rij R_ij + c_1."""
    c, rotation = machine.position, machine.rotation
    turned = [scalar(pure_statics_box.column(rotation, k), c) for k in range(3)]
    c_u, c_c = ([interval(form[start + k]).over(roots[k]) for k in range(3)] for start in (1, 4))
    parts = [interval(form[0]) * scalar(c, c), scalar(c_u, turned), scalar(c_c, c), interval(form[16])]
    for i in range(3):
        weights = [(interval(form[7 + 3 * i + j]) * roots[j]).over(roots[i]) for j in range(3)]
        parts.append(scalar(weights, rotation[i]))
    return pure_statics_box.total(parts)


def check_rows(machine: Machine, w: list[Line], r: list[Line], p: list[list[Ends]] | None, e: list[list[Ends]]) -> None:
    """Check 1: -V^-1 U at the places that are not free, or V^-1 r."""
    free = machine.free
    if free is None or p is None:
        require_within(follows(w, r), e, "expansion")
        return
    n = len(machine.freedoms)
    others = [k for k in range(n) if k not in free]
    v = [[*(row[k] for k in others), *map(pure_statics_box.negative, line)] for row, line in zip(w, r, strict=True)]
    found = follows(v, [[pure_statics_box.negative(row[k]) for k in free] for row in w])
    expansion = [[whole(int(k == place)) for place in free] for k in range(n)]
    for place, line in zip(others, found, strict=False):
        expansion[place] = line
    require_within(expansion, e, "expansion")
    require_within(found[len(others) :], p, "jacobian")


def follows(v: list[Line], right: list[Line]) -> list[Line]:
    """V^-1 times a matrix."""
    found = pure_statics_box.solved(v, right)
    if found is None:
        raise pure.Refusal("rejected", "equations: twist and speeds may not follow")
    return found


def require_within(rows: list[Line], bounds: list[list[Ends]], name: str) -> None:
    """Refuse enclosures that leave what is listed."""
    for row, pairs in zip(rows, bounds, strict=True):
        pure.require(pure_statics_box.lie_in(row, pairs), f"{name}: an entry is not within its bounds")


def check_regular(machine: Machine, w: list[Line], r: list[Line]) -> None:
    """Check 7: W^T W, or r r^T, is positive definite."""
    rows = r if machine.free is None else [list(line) for line in zip(*w, strict=True)]
    gram = [[scalar(x, y) for y in rows] for x in rows]
    definite = pure_statics_box.is_positive(gram) is True
    pure.require(definite, f"regular: a singularity of type {1 if machine.free is None else 2} is not excluded")


def check_work(q: list[Line], load: Row, borne: list[Ends]) -> None:
    """Check 2 if nothing is free: -E^T F."""
    found = [pure_statics_box.negative(scalar(row, [interval(x) for x in load])) for row in q]
    pure.require(pure_statics_box.lie_in(found, borne), "actuator_forces: one is not within its bounds")
