"""The checks of a statics certificate of version 4, numbered as in ``docs/certificates-statics.md``, in balls."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from math import comb

from flint import arb, arb_mat, ctx

from pkm_exact.certify.checker.budget import charge
from pkm_exact.certify.checker.statics_box_checks import (
    BITS,
    MAX_CHOICES,
    STEP,
    ListedRows,
    ball_around,
    both_ways,
    check_ellipsoid,
    check_forces,
    check_indices,
    check_velocity,
    check_wrench,
    form_row,
    holds,
    hull_of,
    is_definite,
)
from pkm_exact.certify.checker.statics_box_document import BoxVelocity, BoxWrench, Ends, Numbers, Table
from pkm_exact.certify.checker.statics_equations_document import DrivenMachine, EquationStatics
from pkm_exact.certify.checker.verdict import rejected, too_large


def check_equation_statics(document: EquationStatics) -> Iterator[str]:
    """One line per claim."""
    machine = document.machine
    with ctx.workprec(BITS):
        _require_affordable(document)
        rows, rates = _matrices(machine)
        _check_rows(document, rows, rates)
        size, count = len(machine.actuators), machine.count
        if document.jacobian is None:
            yield f"machine: {size} actuators move {len(machine.freedoms)} freedoms in a box of poses, T in its bounds"
        else:
            yield f"machine: {size} actuators in a box of poses, {count} freedoms, J in its bounds"
        if document.regular:
            _check_regular(rows, rates, forward=machine.free is None)
            yield "singularities: none in the box"
        yield from _claims(document)


def _claims(document: EquationStatics) -> Iterator[str]:
    machine = document.machine
    turned = tuple(zip(*document.expansion, strict=True))
    box = ListedRows(document.jacobian or turned, document.expansion)
    if machine.load is not None and document.actuator_forces is not None:
        if document.jacobian is None:
            _check_work(box, machine.load, document.actuator_forces)
        else:
            check_forces(box, machine.load, document.actuator_forces)
        yield "forces: those that bear the load, within their bounds"
    if document.velocity is not None and machine.speeds is not None:
        _check_polytope(box, both_ways(machine.speeds), document.velocity, "velocity_polytope")
        yield f"velocity polytope: {_size(document.velocity)}, and no others"
    if document.wrench is not None and machine.forces is not None:
        _check_polytope(box, machine.forces, document.wrench, "wrench_polytope")
        yield f"wrench polytope: {_size(document.wrench)}, and no others"
    if document.ellipsoid is not None and machine.speeds is not None:
        check_ellipsoid(box, machine.speeds, document.ellipsoid)
        yield "ellipsoid: in the velocity polytope, and no larger one but for the part that is said"
    if document.indices is not None:
        check_indices(box, machine.freedoms, machine.length, document.indices)
        yield "indices: singular values and condition within their bounds"


def _size(claim: BoxVelocity | BoxWrench) -> str:
    return f"{len(claim.vertices)} vertices, {len(claim.facets)} facets"


def _check_polytope(box: ListedRows, ends: Sequence[Ends], claim: BoxVelocity | BoxWrench, where: str) -> None:
    """Checks 3 and 4: by bounds of rows, or by sums of rows."""
    if isinstance(claim, BoxVelocity):
        check_velocity(box, ends, claim, where)
    else:
        check_wrench(box, ends, claim, where)


def _require_affordable(document: EquationStatics) -> None:
    m = len(document.machine.actuators)
    f = len(document.machine.freedoms) if document.jacobian is None else document.machine.count
    for name, claim in (("velocity_polytope", document.velocity), ("wrench_polytope", document.wrench)):
        if claim is not None and comb(m, _chosen(claim, f)) << f > MAX_CHOICES:
            raise too_large(f"{name}: too many choices of legs")
    charge_steps(document, m, f)


def _chosen(claim: BoxVelocity | BoxWrench, f: int) -> int:
    """How many rows meet in a vertex, or span a facet."""
    return f if isinstance(claim, BoxVelocity) else f - 1


def charge_steps(document: EquationStatics, m: int, f: int) -> None:
    """The work for m actuators in f dimensions."""
    steps = 400 + 20 * comb(m, f)  # 400 for elimination in the largest systems, of 18 equations
    for claim in (document.velocity, document.wrench):
        if claim is not None:
            steps += (comb(m, _chosen(claim, f)) << f + 1) + 10 * len(claim.facets)
    charge(STEP * steps)


def _matrices(machine: DrivenMachine) -> tuple[list[list[arb]], list[list[arb]]]:
    """W and r."""
    roots = [arb(g).sqrt() for g in machine.metric]
    position = [hull_of(ends) for ends in machine.position]
    rotation = arb_mat([[hull_of(ends) for ends in row] for row in machine.rotation])
    scales = [ball_around(square).sqrt() for square in machine.actuators]
    rows, rates = [], []
    for equation in machine.equations:
        row = form_row(equation.form, roots, position, rotation)
        if equation.square is not None:
            factor, root = equation.square
            slope = 2 * ball_around(factor) * _value(root, roots, position, rotation)
            row = [x - slope * y for x, y in zip(row, form_row(root, roots, position, rotation), strict=True)]
        rows.append([row[k] for k in machine.freedoms])
        line = [arb(0)] * len(scales)
        for actuator, form in equation.rates:
            line[actuator] = scales[actuator] * _value(form, roots, position, rotation)
        rates.append(line)
    return rows, rates


def _value(form: Numbers, roots: Sequence[arb], position: Sequence[arb], rotation: arb_mat) -> arb:
    """A form at a pose, in ordinary coordinates."""
    total = ball_around(form[16])
    for k in range(3):
        arm = rotation[0, k] * position[0] + rotation[1, k] * position[1] + rotation[2, k] * position[2]
        total += ball_around(form[0]) * position[k] * position[k]
        total += (ball_around(form[1 + k]) * arm + ball_around(form[4 + k]) * position[k]) / roots[k]
        for j in range(3):
            total += ball_around(form[7 + 3 * k + j]) * rotation[k, j] * roots[j] / roots[k]
    return total


def _check_rows(document: EquationStatics, rows: list[list[arb]], rates: list[list[arb]]) -> None:
    """Check 1."""
    machine, free = document.machine, document.machine.free
    n = len(machine.freedoms)
    if free is None:
        _require_held("expansion", document.expansion, _solution(rows, rates))
        return
    others = [k for k in range(n) if k not in free]
    system = [[row[k] for k in others] + [-x for x in line] for row, line in zip(rows, rates, strict=True)]
    found = _solution(system, [[-row[k] for k in free] for row in rows])
    expansion = [[arb(int(k == place)) for place in free] for k in range(n)]
    for i, place in enumerate(others):
        expansion[place] = found[i]
    _require_held("expansion", document.expansion, expansion)
    _require_held("jacobian", document.jacobian or (), found[len(others) :])


def _solution(left: list[list[arb]], right: list[list[arb]]) -> list[list[arb]]:
    try:
        found: list[list[arb]] = arb_mat(left).solve(arb_mat(right)).tolist()
    except ZeroDivisionError:
        raise rejected("equations: twist and speeds are not proved to follow") from None
    return found


def _require_held(name: str, listed: Table, found: Sequence[Sequence[arb]]) -> None:
    for bounds, line in zip(listed, found, strict=True):
        if not all(holds(ends, value) for ends, value in zip(bounds, line, strict=True)):
            raise rejected(f"{name}: an entry is not within its bounds")


def _check_regular(rows: list[list[arb]], rates: list[list[arb]], *, forward: bool) -> None:
    """Check 7."""
    w, r = arb_mat(rows), arb_mat(rates)
    if is_definite(r * r.transpose() if forward else w.transpose() * w) is not True:
        raise rejected(f"regular: a singularity of type {1 if forward else 2} is not excluded")


def _check_work(box: ListedRows, load: Numbers, listed: Sequence[Ends]) -> None:
    """Check 2 where the twist follows from the actuators."""
    found = box.rows * arb_mat([[-ball_around(x)] for x in load])
    if not all(holds(ends, found[k, 0]) for k, ends in enumerate(listed)):
        raise rejected("actuator_forces: one is not within its bounds")
