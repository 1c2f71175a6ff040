"""What a machine can do at a pose as a picture: its polytopes of velocities and wrenches, the ellipsoid in the first.

Of more than three dimensions the section without turning, and without moment, is drawn. Drawing takes doubles nearest
to exact or enclosed values: a picture proves nothing.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from fractions import Fraction
from typing import TYPE_CHECKING, Any, Final

import numpy as np

from pkm_exact.errors import InputError, PkmExactError
from pkm_exact.pictures import style
from pkm_exact.pictures.polytope_picture import draw_polytope
from pkm_exact.polytopes.polytope import Polytope
from pkm_exact.statics.capability import (
    velocity_polytope,
    velocity_section,
    wrench_polytope,
    wrench_section,
)
from pkm_exact.statics.largest_ellipsoid import LargestEllipsoid
from pkm_exact.statics.measures import Measures
from pkm_exact.statics.pose_rows import TWIST, WRENCH

if TYPE_CHECKING:
    from matplotlib.figure import Figure

_MOST: Final = 3
"""Dimensions that can be drawn."""


@dataclass(frozen=True)
class StaticsPanel:
    """One polytope to be drawn.

    Attributes
    ----------
    title : str
    names : tuple of str
        Of the axes.
    polytope : Polytope
    ellipsoid : array or None
        S of the ellipsoid x^T S^-1 x <= 1 in the same coordinates.
    """

    title: str
    names: tuple[str, ...]
    polytope: Polytope
    ellipsoid: Any = None


def statics_panels(measures: Measures, ellipsoid: LargestEllipsoid | None = None) -> list[StaticsPanel]:
    """The polytopes whose limits are known, of three dimensions at most.

    Raises
    ------
    InputError
        If there are no limits, or a polytope is not known.
    """
    limits, found = measures.limits, []
    kept = _kept(measures)
    is_section = len(kept) < len(measures.freedom.components)
    if limits.speeds is not None:
        speeds, freedom = limits.speeds, measures.freedom
        polytope = _asked(
            lambda: velocity_section(freedom, speeds, kept) if is_section else velocity_polytope(freedom, speeds)
        )
        title = "velocities without turning" if is_section else "velocities"
        shape = None if ellipsoid is None else ellipsoid_matrix(measures, ellipsoid, kept)
        found.append(StaticsPanel(title, _names(measures, TWIST, kept), polytope, shape))
    if limits.forces is not None:
        low, high = limits.force_ends or ((), ())
        freedom = measures.freedom
        polytope = _asked(
            lambda: wrench_section(freedom, low, high, kept) if is_section else wrench_polytope(freedom, low, high)
        )
        title = "forces without moment" if is_section else "wrenches"
        found.append(StaticsPanel(title, _names(measures, WRENCH, kept), polytope))
    if not found:
        raise InputError("picture: no limits are known; give greatest speeds, or forces")
    return found


def ellipsoid_matrix(measures: Measures, ellipsoid: LargestEllipsoid, kept: list[int]) -> Any:
    """S of the section of the ellipsoid at the kept components, turns no longer multiplied by the length."""
    length = measures.limits.length or Fraction(1)
    freedom = measures.freedom
    twist = [freedom.at.motion.twist[place] for place in freedom.free.places]
    factors = np.array([1.0 if k < 3 else float(length) for k in twist])
    inverse = np.linalg.inv(ellipsoid.matrix.to_numpy()) * np.outer(factors, factors)
    return np.linalg.inv(inverse[np.ix_(kept, kept)])


def statics_figure(measures: Measures, ellipsoid: LargestEllipsoid | None = None) -> Figure:
    """Velocity and wrench polytopes side by side, as far as their limits are known.

    Parameters
    ----------
    measures : Measures
        Of a machine at a pose, with greatest speeds, forces or both.
    ellipsoid : LargestEllipsoid, optional
        Drawn in the velocity polytope.

    Raises
    ------
    InputError
        As ``statics_panels``; if a polytope has one dimension; if matplotlib is not installed.

    Examples
    --------
    >>> from pkm_exact import Robot
    >>> at = Robot.load("models/3-rpr-merlet-p.toml").at({"position": [5, "9/2"], "half_tangent": "1/3"})
    >>> len(statics_figure(at.measures(speeds=1, forces=1), at.ellipsoid(1, 3)).axes)
    2
    """
    panels = statics_panels(measures, ellipsoid)
    with style.plain_style():
        from matplotlib.figure import Figure

        figure = Figure(figsize=(5.0 * len(panels), 5.2), layout="constrained")
        for place, panel in enumerate(panels, 1):
            axes = draw_polytope(figure, (1, len(panels), place), panel.polytope, panel.names, panel.ellipsoid)
            axes.set_title(panel.title, fontsize="medium")
        figure.suptitle(style.drawable(measures.freedom.at.name))
    return figure


def _kept(measures: Measures) -> list[int]:
    """Which of the free components are drawn: all of three or fewer, else those of the velocity."""
    freedom = measures.freedom
    places = freedom.free.places
    if len(places) <= _MOST:
        return list(range(len(places)))
    if freedom.at.held.structural:
        raise InputError(
            f"picture: its {len(places)} freedoms are too many to be drawn, and constraints couple velocities and "
            "turns, so that there is no section without turning"
        )
    return [k for k, place in enumerate(places) if freedom.at.motion.twist[place] < 3]


def _names(measures: Measures, names: tuple[str, ...], kept: list[int]) -> tuple[str, ...]:
    freedom = measures.freedom
    return tuple(names[freedom.at.motion.twist[freedom.free.places[place]]] for place in kept)


def _asked(ask: Callable[[], Polytope]) -> Polytope:
    try:
        return ask()
    except InputError:
        raise
    except PkmExactError as error:
        raise InputError(f"picture: {error}; give an exact pose") from None
