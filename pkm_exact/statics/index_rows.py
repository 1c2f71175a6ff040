"""The indices of a machine at a pose. One row adds one, with its unit, definition and source; tests ask every row."""

from __future__ import annotations

from collections.abc import Callable, Collection
from dataclasses import dataclass
from typing import Final

from flint import arb

from pkm_exact.errors import InputError
from pkm_exact.polytopes.enclosures import interval_of
from pkm_exact.polytopes.signs import UndecidedError
from pkm_exact.precision import working_precision
from pkm_exact.roots.interval import Interval
from pkm_exact.statics.ball_rows import BITS
from pkm_exact.statics.measures import Measures, RefusedError

KRUT: Final = "Krut, Company and Pierrot, Robotica 22 (2004), 129-139"
SHAYYA: Final = "Shayya, Krut, Company, Baradat and Pierrot, IROS 2014, 490-497"
YOSHIKAWA: Final = "Yoshikawa, Int. J. Robotics Research 4 (1985), 3-9"
STAN: Final = (
    "Stan, Maties and Balan, in Parallel Manipulators: Towards New Applications (2008), chapter 14, equation 9"
)


@dataclass(frozen=True)
class StaticsIndex:
    """An index of a machine at a pose.

    Attributes
    ----------
    name : str
        Key of JSON.
    unit : str
        With "length" for the robot's unit and "q" for that of the actuators; "1" if it has none.
    definition, source : str
    value : callable
        In balls; raises ``RefusedError`` where it has no meaning, or needs what was not given.
    """

    name: str
    unit: str
    definition: str
    source: str
    value: Callable[[Measures], arb]


def _condition(m: Measures) -> arb:
    return m.singular_values[-1] / m.singular_values[0]


def _manipulability(m: Measures) -> arb:
    product = arb(1)
    for value in m.singular_values:
        product *= value
    return product


def _ms(m: Measures) -> arb:
    return m.singular_values[0].min(1 / m.singular_values[-1])


def _transmission(m: Measures) -> arb:
    squares = [value * value for value in m.singular_values]
    return len(squares) / (sum(squares, arb(0)) * sum((1 / x for x in squares), arb(0))).sqrt()


def _fvi(m: Measures, places: list[int] | None, speed: str, force: str) -> arb:
    wanted_speed, wanted_force = m.known(speed), m.known(force)
    reached = m.isotropic_speed(places) / _rational(wanted_speed)
    return reached.min(m.isotropic_force(places) / _rational(wanted_force))


def _rational(value: object) -> arb:
    from pkm_exact.polytopes.enclosures import ball_of

    return ball_of(value)


def _moving(m: Measures) -> list[int]:
    return m.columns(turning=False)


def _turning(m: Measures) -> list[int]:
    return m.columns(turning=True)


def _of_all(m: Measures) -> Measures:
    """For all directions that constraints allow; of translations and turns only with a length."""
    if m.freedom.has_both and m.limits.length is None:
        raise RefusedError("mixes translations and turns: give a length, or see its parts with the endings _p and _o")
    return m


STATICS_INDICES: Final[tuple[StaticsIndex, ...]] = (
    StaticsIndex(
        "condition", "1", "greatest by least singular value of J on the allowed twists", YOSHIKAWA, _condition
    ),
    StaticsIndex("sigma_max", "q/length", "greatest singular value of J", YOSHIKAWA, lambda m: m.singular_values[-1]),
    StaticsIndex("sigma_min", "q/length", "least singular value of J", YOSHIKAWA, lambda m: m.singular_values[0]),
    StaticsIndex(
        "manipulability",
        "(q/length)^freedoms",
        "sqrt(det J^T J), q' = J t; its inverse is how volumes of actuator speeds become those of twists",
        YOSHIKAWA,
        _manipulability,
    ),
    StaticsIndex(
        "ms",
        "1",
        "min(least singular value, 1 / greatest), lengths in the unit of the robot",
        f"{SHAYYA}, equation 5",
        _ms,
    ),
    StaticsIndex(
        "transmission", "1", "freedoms / (|J| |J^+|), norms of Frobenius: 1 if isotropic", STAN, _transmission
    ),
    StaticsIndex(
        "v_iso",
        "length/time",
        "norm of the twist, turns by the length, reached in every direction that constraints allow",
        f"{SHAYYA}, equation 7",
        lambda m: _of_all(m).isotropic_speed(None),
    ),
    StaticsIndex(
        "f_iso",
        "force",
        "norm of the wrench, moments divided by the length, borne in every direction that constraints do not bear, by "
        "actuator forces of least norm",
        f"{SHAYYA}, equation 7",
        lambda m: _of_all(m).isotropic_force(None),
    ),
    StaticsIndex(
        "v_iso_p",
        "length/time",
        "speed of the platform's origin reached in every direction without turning",
        f"{SHAYYA}, equation 9",
        lambda m: m.isotropic_speed(_moving(m)),
    ),
    StaticsIndex(
        "v_iso_spin",
        "length/time",
        "the same at the imposed spin of the platform",
        f"{SHAYYA}, equation 13",
        lambda m: m.isotropic_speed(_moving(m), m.known("spin")),
    ),
    StaticsIndex(
        "w_iso_o",
        "1/time",
        "angular velocity reached about every axis with the origin at rest",
        f"{SHAYYA}, equation 11",
        lambda m: m.isotropic_speed(_turning(m)),
    ),
    StaticsIndex(
        "f_iso_p",
        "force",
        "force borne in every direction without a moment, by actuator forces of least norm",
        f"{SHAYYA}, equation 9",
        lambda m: m.isotropic_force(_moving(m)),
    ),
    StaticsIndex(
        "m_iso_o",
        "moment",
        "moment borne about every axis without a force, by actuator forces of least norm",
        f"{SHAYYA}, equation 11",
        lambda m: m.isotropic_force(_turning(m)),
    ),
    StaticsIndex(
        "fvi",
        "1",
        "least ratio of isotropic speed and force to those wanted",
        f"{SHAYYA}, equation 6",
        lambda m: _fvi(_of_all(m), None, "speed", "force"),
    ),
    StaticsIndex(
        "fvi_p",
        "1",
        "the same of translations and forces",
        f"{SHAYYA}, equation 8",
        lambda m: _fvi(m, _moving(m), "speed", "force"),
    ),
    StaticsIndex(
        "fvi_o",
        "1",
        "the same of turns and moments",
        f"{SHAYYA}, equation 10",
        lambda m: _fvi(m, _turning(m), "turn", "moment"),
    ),
    StaticsIndex(
        "resolution_p",
        "length",
        "greatest displacement of the origin for errors of the actuators within their resolutions",
        f"{SHAYYA}, equation 24",
        lambda m: m.greatest_error(_moving(m)),
    ),
    StaticsIndex(
        "resolution_o",
        "rad",
        "greatest turn for errors of the actuators within their resolutions",
        f"{SHAYYA}, equation 26",
        lambda m: m.greatest_error(_turning(m)),
    ),
)
"""In the order of outputs."""


def enclosed_indices(
    measures: Measures, names: Collection[str] | None = None
) -> tuple[dict[str, Interval], dict[str, str]]:
    """The values of all indices, or of those named, that have one, and why the others have none."""
    values: dict[str, Interval] = {}
    refused: dict[str, str] = {}
    for index in STATICS_INDICES:
        if names is not None and index.name not in names:
            continue
        try:
            with working_precision(BITS):
                found = index.value(measures)
        except (InputError, UndecidedError) as error:
            refused[index.name] = str(error)
            continue
        if found.is_finite():
            values[index.name] = interval_of(found)
        else:
            refused[index.name] = "is not decided: the pose is not enclosed narrowly enough"
    return values, refused


def unit_of(index: StaticsIndex, measures: Measures) -> str:
    """The unit of an index of this machine, with the robot's unit of length."""
    units = measures.freedom.units
    actuator = "1" if len(units) > 1 else {"length": measures.unit, "angle": "rad"}.get(next(iter(units)), "1")
    length = measures.unit if measures.unit != "1" else "unit length"
    if "q/length" not in index.unit:
        return index.unit.replace("length", length)
    if actuator == measures.unit:
        return "1"
    return index.unit.replace("q", actuator).replace("length", length)
