"""Inverse kinematics of machines with parasitic motion: what height and tilt leave open, as a polynomial system.

Of a machine with three freedoms such as the 3-PRS a task gives the height z and the tilt Ry(theta) Rx(psi) = T. The
place x, y, the turn phi about the vertical and the positions S_i of the slides follow from

    c^2 + w s^2 = 1,    n_i.(P_i - A_i - S_i d_i) = offset,    |P_i - A_i - S_i d_i|^2 = l_i^2,
    P_i = (x, y, z) + Rz(phi) T B_i,    c = cos(phi),  s = sin(phi) / sqrt(w)

in all planes and rods of the machine. A hinge whose axis has an error along its slide joins the equations of leg and
platform, so that no closed form is left; the source iterates. As a system all solutions are found, with proofs.
Reference: Tang and Huang in Parallel Manipulators: Towards New Applications (2008), ch. 15, (49) and (50).
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from fractions import Fraction

from pkm_exact.constraints.distance import Distance
from pkm_exact.constraints.form import Vector
from pkm_exact.constraints.point_in_plane import InPlane
from pkm_exact.errors import InputError
from pkm_exact.geometry.inverse import Metric, Quaternion, rotation_of
from pkm_exact.geometry.mechanism import Mechanism
from pkm_exact.geometry.working_modes import platform_point
from pkm_exact.wording import shown


@dataclass(frozen=True)
class TiltedPlatform:
    """Polynomial equations for what height and tilt leave open.

    Attributes
    ----------
    equations : tuple of str
        Polynomials that vanish.
    variables : tuple of str
        x, y, c, s, then S1, S2, .. of the slides in their order.
    """

    equations: tuple[str, ...]
    variables: tuple[str, ...]


def tilted_platform(mechanism: Mechanism, height: Fraction, tilt: Quaternion) -> TiltedPlatform:
    """The equations of a machine of rods, planes and slides whose platform has a height and a tilt.

    Parameters
    ----------
    mechanism : Mechanism
        Such as a 3-PRS, with errors or without.
    height : Fraction
        Third coordinate of the platform's origin.
    tilt : tuple of 4 Fraction
        Quaternion of T, scalar first, of any norm, in the metric of the mechanism.

    Raises
    ------
    InputError
        If the machine has other constraints or actuators.

    Examples
    --------
    >>> from pkm_exact import read_robot, solve_system
    >>> robot = read_robot("models/3-prs.toml")
    >>> system = tilted_platform(robot, Fraction(4), (Fraction(9), Fraction(1), Fraction(-1), Fraction(0)))
    >>> print(solve_system(system.equations, system.variables))
    16 complex solutions, 8 real; complete: it is proved that there is no other
    """
    metric = mechanism.metric
    names = {drive.name: f"S{k}" for k, drive in enumerate(mechanism.drives, 1)}
    turn = rotation_of(tilt, metric)
    equations = [f"c^2 + {metric[0] * metric[1]}*s^2 - 1"]
    for constraint in mechanism.constraints:
        if not isinstance(constraint, Distance | InPlane):
            raise InputError(
                f"{shown(constraint.name)}: is of type {constraint.type}; give a machine of rods, planes and slides"
            )
        shift = _shift(mechanism, constraint.name, names)
        at = platform_point(constraint.platform, (Fraction(0), Fraction(0), height), turn)
        if isinstance(constraint, InPlane):
            terms = _dot(constraint.normal, _turned(at, metric), metric)
            equations.append(" + ".join([terms, f"({-constraint.offset})", *_moved(shift, "offset", constraint.name)]))
        else:
            base = _offsets(constraint.base, shift, constraint.name)
            rest = [f"{x} - ({a})" for x, a in zip(_turned(at, metric), base, strict=True)]
            squares = " + ".join(f"{g}*({x})^2" for g, x in zip(metric, rest, strict=True))
            equations.append(f"{squares} - ({constraint.length_squared})")
    return TiltedPlatform(tuple(equations), ("x", "y", "c", "s", *names.values()))


_Shift = Mapping[str, tuple[str, object]]


def _shift(mechanism: Mechanism, name: str, names: Mapping[str, str]) -> _Shift:
    """By field the variable of the slide that moves it, and by how much per unit."""
    found: dict[str, tuple[str, object]] = {}
    for drive in mechanism.drives:
        for part in drive.parts:
            if part.constraint == name:
                if drive.is_crank or part.field in found or part.field not in ("base", "offset"):
                    raise InputError(
                        f"{shown(drive.name)}: is no slide of its own; give a machine with one in each leg"
                    )
                found[part.field] = names[drive.name], part.axes[0]
    if name in mechanism.actuated:
        raise InputError(f"{shown(name)}: is actuated itself; give a machine whose actuators are slides")
    return found


def _turned(at: Vector, metric: Metric) -> tuple[str, str, str]:
    """The coordinates of a point, turned about the vertical and moved."""
    x, y, z = at
    return (
        f"x + ({x})*c + ({-metric[1] * y})*s",
        f"y + ({y})*c + ({metric[0] * x})*s",
        f"({z})",
    )


def _offsets(base: Vector, shift: _Shift, name: str) -> Sequence[str]:
    if "base" not in shift:
        return [str(x) for x in base]
    variable, direction = shift["base"]
    if not isinstance(direction, tuple):
        raise InputError(f"{shown(name)}: its slide has no direction; give one that moves the foot of the rod")
    return [f"{x} + ({d})*{variable}" for x, d in zip(base, direction, strict=True)]


def _moved(shift: _Shift, field: str, name: str) -> list[str]:
    if "base" in shift:
        raise InputError(f"{shown(name)}: a slide moves its foot; give a machine whose slides shift planes")
    return [f"({-shift[field][1]})*{shift[field][0]}"] if field in shift else []  # type: ignore[operator]


def _dot(normal: Vector, point: Sequence[str], metric: Metric) -> str:
    return " + ".join(f"({g * n})*({x})" for g, n, x in zip(metric, normal, point, strict=True))
