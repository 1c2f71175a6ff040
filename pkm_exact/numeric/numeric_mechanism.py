"""A mechanism declared by constraints in floating point: forms and quadrics at a pose, for many poses at once.

The frames are moved and scaled exactly (``constraints.form.in_frames``), and each equation is divided by the size of
its wrench (``Constraint.scales``) before anything is rounded: to first order its value is then an error of a length, of
a distance from a plane, or of a product of directions times the size of the platform.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from fractions import Fraction
from math import copysign, isqrt, sqrt
from typing import Any, Final

import numpy as np

from pkm_exact.constraints.constraint import Role, SquareForm
from pkm_exact.constraints.distance import Distance
from pkm_exact.constraints.form import Form, Vector, in_frames, ordinary
from pkm_exact.errors import InputError
from pkm_exact.geometry.problem import ForwardProblem, points
from pkm_exact.numeric.centred import centred_frames
from pkm_exact.numeric.numeric_machine import OUT_OF_REACH, NumericMachine, Place, Real
from pkm_exact.numeric.numeric_robot import numeric_robot
from pkm_exact.numeric.quaternions import rotation_matrix
from pkm_exact.poses.jacobian import characteristic_length

_AXES: Final = ((1, 0, 0), (0, 1, 0), (0, 0, 1))


@dataclass(frozen=True, eq=False)
class FormPlace(Place):
    """What forms and quadrics are at a pose, or at many.

    Attributes
    ----------
    sizes : (.., m) array
        Sums of the absolute values of their terms: what the rounding of the errors is relative to.
    rows : (.., 6, m) array
    """

    sizes: Real
    rows: Real

    @property
    def worst(self) -> Real:
        """The greatest error; of an equation whose terms are large, relative to them."""
        return np.asarray((np.abs(self.errors) / np.maximum(self.sizes, 1)).max(axis=-1, initial=0.0))

    def transposed_jacobian(self) -> Real:
        """The wrenches in columns."""
        return self.rows


@dataclass(frozen=True, eq=False)
class NumericMechanism(NumericMachine):
    """A locked mechanism in floating point.

    Attributes
    ----------
    forms : (m, 17) array
        On (|C|^2; u; C; R; 1), in ordinary coordinates: first the linear ones, then those of quadrics.
    roots : (s, 17) array
        For each quadric the form whose square is taken off.
    legs : pair of (3, n) arrays
        Joints of base and platform of those constraints that are legs.
    lengths : (n,) array
        Of these legs.
    """

    forms: Real
    roots: Real
    legs: tuple[Real, Real]
    lengths: Real
    marked: Real

    @property
    def markers(self) -> Real:
        """The platform's points that constraints name, and three more."""
        return self.marked

    def at(self, c: Real, quaternion: Sequence[Any]) -> FormPlace:
        """The constraints at a pose, or at many."""
        rotation = rotation_matrix(quaternion)
        values, rows = _quantities(c, rotation), _wrenches(self.forms, c, rotation)
        errors, sizes = values @ self.forms.T, np.abs(values) @ np.abs(self.forms).T
        if len(self.roots):
            roots, first = values @ self.roots.T, len(self.forms) - len(self.roots)
            errors[..., first:] -= roots * roots
            sizes[..., first:] += (np.abs(values) @ np.abs(self.roots).T) ** 2
            rows[..., first:] -= 2 * roots[..., None, :] * _wrenches(self.roots, c, rotation)
        return FormPlace(errors, sizes, rows)


def _quantities(c: Real, rotation: Real) -> Real:
    """(.., 17): (|C|^2; u; C; R; 1), with u = R^-1 C."""
    square = (c * c).sum(axis=-1, keepdims=True)
    turned = (c[..., None, :] @ rotation)[..., 0, :]
    return np.concatenate([square, turned, c, rotation.reshape(*c.shape[:-1], 9), np.ones_like(square)], axis=-1)


def _wrenches(forms: Real, c: Real, rotation: Real) -> Real:
    """(.., 6, m): the derivatives of the forms along a twist, as ``constraints.form.wrench`` has them."""
    moved = forms[:, 1:4] @ np.swapaxes(rotation, -1, -2)
    force = 2 * forms[:, :1] * c[..., None, :] + moved + forms[:, 4:7]
    columns = np.swapaxes(rotation, -1, -2)[..., None, :, :]
    moment = np.cross(moved, c[..., None, :])
    moment = moment + np.cross(columns, forms[:, 7:16].reshape(-1, 3, 3).transpose(0, 2, 1)).sum(axis=-2)
    return np.swapaxes(np.concatenate([force, moment], axis=-1), -1, -2)


def numeric_machine(problem: ForwardProblem) -> NumericMachine:
    """The robot of an exact problem, every number rounded once.

    Raises
    ------
    InputError
        If a number is out of reach of floating point.

    Examples
    --------
    >>> from pkm_exact.motions.motion_groups import TRANSLATION
    >>> origin = (Fraction(0),) * 3
    >>> feet = [(Fraction(x), Fraction(y), Fraction(0)) for x, y in ((0, 0), (4, 0), (2, 3))]
    >>> rods = tuple(Distance(foot, origin, Fraction(9)) for foot in feet)
    >>> machine = numeric_machine(ForwardProblem(rods, motion=TRANSLATION))
    >>> machine.unit, machine.base_centre.tolist()
    (2.0, [2.0, 1.0, 0.0])
    """
    return numeric_robot(problem) if problem.is_gough else _numeric_mechanism(problem)


def platform_markers(problem: ForwardProblem) -> list[Vector]:
    """The points of the platform that constraints name, and three along its axes: their displacements tell poses apart.

    In rational coordinates. The three are about the size of the platform from its origin.
    """
    size = characteristic_length(problem)
    further = [
        tuple(Fraction(axis) * size / isqrt(g) for axis, g in zip(unit, problem.metric, strict=True)) for unit in _AXES
    ]
    return [*points(problem, Role.PLATFORM_POINT), *((x, y, z) for x, y, z in further)]


def _numeric_mechanism(problem: ForwardProblem) -> NumericMechanism:
    try:
        return _rounded(problem)
    except (OverflowError, ZeroDivisionError):
        raise InputError(OUT_OF_REACH) from None


def _rounded(problem: ForwardProblem) -> NumericMechanism:
    frames, metric = centred_frames(problem), problem.metric
    unit, scales = frames.unit, np.sqrt(np.array(metric, dtype=float))
    forms, roots = [], []
    for form, root, size in _equations(problem):
        moved = in_frames(form, frames.base, frames.platform, unit, metric)
        forms.append(_row(moved, 1 / (size * unit**2), metric))
        if root is not None:
            moved = in_frames(root[0], frames.base, frames.platform, unit, metric)
            # (factor / (sqrt(size) unit))^(1/2) times the root: a fourth root, of a square.
            weight = Fraction(sqrt(root[1] ** 2 / (size * unit**2)))
            roots.append(_row(moved, weight, metric))
    legs = [found for found in problem.constraints if isinstance(found, Distance)]
    sides = ([leg.base for leg in legs], frames.base), ([leg.platform for leg in legs], frames.platform)
    base, platform = (_columns(joints, origin, unit, scales) for joints, origin in sides)
    machine = NumericMechanism(
        base_centre=scales * [float(x) for x in frames.base],
        platform_centre=scales * [float(x) for x in frames.platform],
        unit=float(unit),
        motion=problem.motion,
        forms=np.array(forms).reshape(-1, 17),
        roots=np.array(roots).reshape(-1, 17),
        legs=(base, platform),
        lengths=np.array([sqrt(leg.length_squared / unit**2) for leg in legs]),
        marked=_columns(platform_markers(problem), frames.platform, unit, scales),
    )
    numbers = (machine.base_centre, machine.platform_centre, machine.forms, machine.roots, machine.marked)
    if not all(np.isfinite(values).all() for values in numbers) or not 0 < machine.unit < np.inf:
        raise OverflowError
    return machine


def _equations(problem: ForwardProblem) -> Iterator[tuple[Form, tuple[Form, Fraction] | None, Fraction]]:
    """Linear forms, then quadrics with their roots and factors; each with the square of what it is divided by."""
    length = characteristic_length(problem)
    quadrics: list[tuple[SquareForm, Fraction]] = []
    for constraint in problem.constraints:
        forms, squares = constraint.forms(problem.metric), constraint.squares(problem.metric)
        sizes = constraint.scales(problem.metric, length)
        for form, size in zip(forms, sizes, strict=False):
            yield form, None, size
        quadrics += zip(squares, sizes[len(forms) :], strict=True)
    for square, size in quadrics:
        yield square.linear, (square.root, square.factor), size


def _row(form: Form, weight: Fraction, metric: Sequence[int]) -> list[float]:
    """The form in ordinary coordinates times the square root of a weight."""
    row = [copysign(sqrt(weight * value * value), value) for value in form]
    return ordinary(row, [sqrt(g) for g in metric])


def _columns(joints: Sequence[Vector], origin: Vector, unit: Fraction, scales: Real) -> Real:
    rows = [[float((x - m) / unit) for x, m in zip(joint, origin, strict=True)] for joint in joints]
    return np.asarray(scales[:, None] * np.array(rows, dtype=float).reshape(-1, 3).T)
