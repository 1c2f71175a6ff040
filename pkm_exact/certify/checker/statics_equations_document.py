"""What a statics certificate of version 4 says, read strictly: equations of a machine in a box, and claims about it."""

from __future__ import annotations

from dataclasses import dataclass
from fractions import Fraction
from typing import Any, Final

from pkm_exact.certify.checker.spelling import entries, integer, items, positive, rational, text
from pkm_exact.certify.checker.statics_box_document import (
    FORM,
    BoxEllipsoid,
    BoxVelocity,
    BoxWrench,
    Ends,
    Numbers,
    Table,
    ellipsoid_of,
    ends_of,
    indices_of,
    places_of,
    range_of,
    require_solution,
    rows_of_ends,
    velocity_of,
    wrench_of,
)
from pkm_exact.certify.checker.statics_document import MAX_LEGS, vector_of, whole
from pkm_exact.certify.checker.verdict import malformed, too_large

KEYS: Final = (
    "format",
    "version",
    "name",
    "unit",
    "solution",
    "metric",
    "freedoms",
    "position",
    "rotation",
    "actuators",
    "equations",
    "free",
    "speeds",
    "forces",
    "length",
    "load",
    "regular",
    "jacobian",
    "expansion",
    "actuator_forces",
    "velocity_polytope",
    "wrench_polytope",
    "ellipsoid",
    "indices",
)
MAX_EQUATIONS: Final = 18


@dataclass(frozen=True)
class DrivenEquation:
    """The form, what its square is multiplied by and of which form, and forms of rates by actuators from 0."""

    form: Numbers
    square: tuple[Fraction, Numbers] | None
    rates: tuple[tuple[int, Numbers], ...]


@dataclass(frozen=True)
class DrivenMachine:
    """What is no claim; ``free`` are places among the freedoms, None where the twist follows from the actuators."""

    metric: tuple[int, ...]
    freedoms: tuple[int, ...]
    position: tuple[Ends, ...]
    rotation: Table
    actuators: Numbers
    equations: tuple[DrivenEquation, ...]
    free: tuple[int, ...] | None
    speeds: Numbers | None
    forces: tuple[Ends, ...] | None
    length: Fraction | None
    load: Numbers | None

    @property
    def count(self) -> int:
        """Of what everything else follows from: free components, or actuators."""
        return len(self.actuators) if self.free is None else len(self.free)


@dataclass(frozen=True)
class EquationStatics:
    """A certificate; where the twist follows from the actuators, polytopes have each other's form."""

    machine: DrivenMachine
    regular: bool
    jacobian: Table | None
    expansion: Table
    actuator_forces: tuple[Ends, ...] | None
    velocity: BoxVelocity | BoxWrench | None
    wrench: BoxVelocity | BoxWrench | None
    ellipsoid: BoxEllipsoid | None
    indices: tuple[Ends, ...] | None


def read_equation_statics(body: dict[str, Any]) -> EquationStatics:
    """The content of a certificate; a refusal if it is not one."""
    values = dict(zip(KEYS, entries(body, "certificate", KEYS), strict=True))
    text(values["name"], "name")
    text(values["unit"], "unit")
    if values["solution"] is not None:
        require_solution(values["solution"])
    if not isinstance(values["regular"], bool):
        raise malformed("regular: not true or false")
    machine = _machine(values)
    n, m, f = len(machine.freedoms), len(machine.actuators), machine.count
    forward = machine.free is None
    for name, needed, given in (
        ("velocity_polytope", "speeds", machine.speeds),
        ("ellipsoid", "speeds", machine.speeds),
        ("wrench_polytope", "forces", machine.forces),
        ("actuator_forces", "load", machine.load),
    ):
        if values[name] is not None and given is None:
            raise malformed(f"{name}: needs {needed}")
    if machine.load is not None and values["actuator_forces"] is None:
        raise malformed("actuator_forces: are missing for the load")
    for name in ("jacobian", "ellipsoid", "indices"):
        if forward and values[name] is not None:
            raise malformed(f"{name}: is there, and no component is free")
    # Sums of m rows and m bounds of rows, in as many dimensions as there are free components; or the twist has.
    sums, bounds = ("velocity_polytope", "wrench_polytope") if forward else ("wrench_polytope", "velocity_polytope")
    size = n if forward else f
    polytopes: dict[str, Any] = {
        sums: None if values[sums] is None else wrench_of(values[sums], m, size, sums),
        bounds: None if values[bounds] is None else velocity_of(values[bounds], m, size, bounds),
    }
    borne, ellipsoid, indices = values["actuator_forces"], values["ellipsoid"], values["indices"]
    return EquationStatics(
        machine,
        values["regular"],
        None if forward else items(values["jacobian"], "jacobian", m, rows_of_ends(f)),
        items(values["expansion"], "expansion", n, rows_of_ends(f)),
        None if borne is None else items(borne, "actuator_forces", m, ends_of),
        polytopes["velocity_polytope"],
        polytopes["wrench_polytope"],
        None if ellipsoid is None else ellipsoid_of(ellipsoid, m, f),
        None if indices is None else indices_of(indices),
    )


def _machine(values: dict[str, Any]) -> DrivenMachine:
    metric = items(values["metric"], "metric", 3, whole)
    if min(metric) <= 0:
        raise malformed("metric: one is not positive")
    freedoms = places_of(values["freedoms"], "freedoms", range(6))
    for name, most in (("actuators", MAX_LEGS), ("equations", MAX_EQUATIONS)):
        if isinstance(values[name], list) and len(values[name]) > most:
            raise too_large(f"{name}: more than {most} entries")
    actuators = items(values["actuators"], "actuators", None, positive)
    n, m = len(freedoms), len(actuators)
    equations = items(values["equations"], "equations", None, lambda x, w: _equation(x, w, m))
    free = None if values["free"] is None else places_of(values["free"], "free", freedoms)
    if len(equations) != (n if free is None else n - len(free) + m):
        raise malformed("equations: not as many as freedoms, free components and actuators leave")
    if m < (n if free is None else len(free)):
        raise malformed("actuators: fewer than free components, or than freedoms if none is free")
    speeds, forces, length, load = (values[name] for name in ("speeds", "forces", "length", "load"))
    return DrivenMachine(
        metric,
        freedoms,
        items(values["position"], "position", 3, ends_of),
        items(values["rotation"], "rotation", 3, rows_of_ends(3)),
        actuators,
        equations,
        None if free is None else tuple(freedoms.index(k) for k in free),
        None if speeds is None else items(speeds, "speeds", m, positive),
        None if forces is None else items(forces, "forces", m, range_of),
        None if length is None else positive(length, "length"),
        None if load is None else items(load, "load", n, rational),
    )


def _equation(value: Any, where: str, actuators: int) -> DrivenEquation:
    form, square, rates = entries(value, where, ("form", "square", "rates"))
    read = vector_of(FORM)
    found = None
    if square is not None:
        factor, root = entries(square, f"{where}.square", ("factor", "form"))
        found = rational(factor, f"{where}.square.factor"), read(root, f"{where}.square.form")
        if found[0] == 0:
            raise malformed(f"{where}.square.factor: is 0")
    pairs = items(rates, f"{where}.rates", None, _rate)
    names = [actuator for actuator, _ in pairs]
    if names != sorted(set(names)) or not set(names) <= set(range(actuators)):
        raise malformed(f"{where}.rates: not increasing numbers of actuators")
    return DrivenEquation(read(form, f"{where}.form"), found, pairs)


def _rate(value: Any, where: str) -> tuple[int, Numbers]:
    if not (isinstance(value, list) and len(value) == 2):
        raise malformed(f"{where}: not an actuator and a form")
    return integer(value[0], where) - 1, items(value[1], where, FORM, rational)
