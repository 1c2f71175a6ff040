"""The constraints in floating point: quadrics in Study coordinates, for many points at once.

All in ordinary coordinates, after a change of frames and of the unit of length that gives base and platform their
centroids as origins and the robot the size 1. A pose is x = (e, f) up to a complex factor; each of the 17 quantities
(|C|^2; u; C; R; 1) of ``geometry.study`` is a quadratic form x^T M x, and a leg is a linear form on these 17, as are
most constraints. So six legs are a 6 x 17 matrix, a section of the rigid motions, and the equations are

    x^T Q_k x = 0,   Q_0 Study's condition,   Q_k = sum_i legs[k, i] M_i.

Planar robots have three legs and four of the coordinates, and Study's condition holds by itself; other groups of
motions have their own coordinates.
"""

from __future__ import annotations

from dataclasses import dataclass
from fractions import Fraction
from functools import cache
from typing import Any, TypeAlias

import numpy as np
from numpy.typing import NDArray

from pkm_exact.constraints.constraint import Role
from pkm_exact.constraints.distance import Distance
from pkm_exact.constraints.form import SIZE, Vector, in_frames
from pkm_exact.constraints.point_in_plane import Carries, InPlane
from pkm_exact.geometry.problem import ForwardProblem, points
from pkm_exact.geometry.study import STUDY_CONDITION, Quadric, motion_quadrics
from pkm_exact.motions.motion import Motion
from pkm_exact.motions.motion_groups import PLANAR, SPATIAL
from pkm_exact.numeric.double_rounding import rounded
from pkm_exact.numeric.quaternions import quaternion_product

Complex: TypeAlias = NDArray[np.complex128]
Real: TypeAlias = NDArray[np.float64]
Inexact: TypeAlias = NDArray[np.inexact[Any]]

QUANTITIES = 17
"""Number of coordinates of rigid motions in which legs are linear."""


@dataclass(frozen=True)
class Frames:
    """How a robot is moved and scaled to unit size: x -> (x - origin) / unit, in ordinary coordinates.

    Attributes
    ----------
    base, platform : (3,) array
        Origins of the new frames.
    unit : float
        The new unit of length.
    scales : (3,) array
        Square roots of the metric: ordinary coordinates by rational ones.
    """

    base: Real
    platform: Real
    unit: float
    scales: Real


@dataclass(frozen=True)
class Section:
    """The legs of a robot, or its constraints of other types, in floating point.

    Attributes
    ----------
    legs : (m, 17) array
        Forms on (|C|^2; u; C; R; 1) of the robot in its normalised frames, as many as freedoms: 6, or 3 if planar.
    frames : Frames
    motion : Motion
    """

    legs: Complex
    frames: Frames
    motion: Motion

    @property
    def quadrics(self) -> Complex:
        """(q, n, n) symmetric matrices of the equations: q = 7 and n = 8, or 3 and 4 if planar."""
        return section_quadrics(self.legs, self.motion)


def numeric_section(problem: ForwardProblem, frames: Frames | None = None) -> Section:
    """The section of a problem, rounded to floating point in frames that fit it, or in the given ones.

    Sections of one robot in the same frames differ by the constants of their legs only.
    """
    if not problem.has_only_distances or problem.motion not in (SPATIAL, PLANAR):
        return _general_section(problem, frames)
    scales = np.sqrt(np.array(problem.metric, dtype=float))
    legs = problem.distances
    base, platform = (np.array([rounded(getattr(leg, side)) for leg in legs]) * scales for side in ("base", "platform"))
    squares = np.array(rounded(leg.length_squared for leg in legs))
    if frames is None:
        frames = _fitting_frames(base, platform, squares, scales)
    base, platform = (base - frames.base) / frames.unit, (platform - frames.platform) / frames.unit
    return Section(leg_forms(base, platform, squares / frames.unit**2).astype(np.complex128), frames, problem.motion)


def _fitting_frames(base: Real, platform: Real, squares: Real, scales: Real) -> Frames:
    """Frames in the centroids of the joints, and the unit that gives the robot the size 1."""
    origins = base.mean(axis=0), platform.mean(axis=0)
    total = ((base - origins[0]) ** 2).sum() + ((platform - origins[1]) ** 2).sum() + squares.sum()
    return Frames(*origins, float(np.sqrt(total / (3 * len(squares)))), scales)


def _general_section(problem: ForwardProblem, frames: Frames | None) -> Section:
    """The section of constraints of any type: frames are changed exactly, before anything is rounded."""
    metric, scales = problem.metric, np.sqrt(np.array(problem.metric, dtype=float))
    base, platform = landmarks(problem)
    if frames is None:
        joints = [np.array([[float(value) for value in point] for point in side]) * scales for side in (base, platform)]
        legs = [float(found.length_squared) for found in problem.constraints if isinstance(found, Distance)]
        spreads = [((side - side.mean(axis=0)) ** 2).sum(axis=1).mean() for side in joints]
        total = spreads[0] + spreads[1] + (float(np.mean(legs)) if legs else 0.0)
        # Origins are moved along those axes only along which the platform can move: the motions remain the same group.
        free = np.array([float(axis in problem.motion.twist) for axis in range(3)])
        origins = [side.mean(axis=0) * free for side in joints]
        frames = Frames(origins[0], origins[1], float(np.sqrt(total / 3)) or 1.0, scales)
        if not np.isfinite([*origins[0], *origins[1], frames.unit]).all():
            raise OverflowError("the mechanism is too large for doubles")
    b, a = ([Fraction(value) for value in side / scales] for side in (frames.base, frames.platform))
    moved = [in_frames(form, b, a, Fraction(frames.unit), metric) for form in problem.forms]
    # A number beyond doubles raises OverflowError, as one of a leg does.
    forms = np.array([[float(value) for value in form] for form in moved])
    forms *= np.concatenate([[1], 1 / scales, 1 / scales, (scales[None, :] / scales[:, None]).ravel(), [1]])
    forms /= np.maximum(np.abs(forms[:, : SIZE - 1]).max(axis=1, keepdims=True), np.finfo(float).tiny)
    return Section(forms.astype(np.complex128), frames, problem.motion)


def landmarks(problem: ForwardProblem) -> tuple[list[Vector], list[Vector]]:
    """Points of base and platform that tell where a mechanism is, and of what size; the origins, if it names none.

    Planes have the point nearest to the origin.
    """
    sides = []
    for role, kind in ((Role.BASE_POINT, InPlane), (Role.PLATFORM_POINT, Carries)):
        found = points(problem, role)
        for plane in problem.constraints:
            if isinstance(plane, kind):
                norm = sum((g * n * n for g, n in zip(problem.metric, plane.normal, strict=True)), Fraction(0))
                x, y, z = (plane.offset * n / (norm or 1) for n in plane.normal)
                found.append((x, y, z))
        sides.append(found or [(Fraction(0),) * 3])
    return sides[0], sides[1]


def leg_forms(base: Inexact, platform: Inexact, squares: Inexact) -> Inexact:
    """Leg forms on (|C|^2; u; C; R; 1) from joints (.., m, 3) and squared lengths (.., m) in ordinary coordinates."""
    ones = np.ones((*squares.shape, 1))
    mixed = -2 * (base[..., :, :, None] * platform[..., :, None, :]).reshape(*squares.shape, 9)
    constant = (base**2).sum(axis=-1) + (platform**2).sum(axis=-1) - squares
    return np.concatenate([ones, 2 * platform, -2 * base, mixed, constant[..., None]], axis=-1)


def section_quadrics(legs: Complex, motion: Motion) -> Complex:
    """The symmetric matrices of the equations of the forms (.., m, 17) of legs or other constraints.

    The first leg, or the form with most of |C|^2, is taken off the others: |C|^2 is left in one equation only, and does
    not drown the others when the platform is far away.
    """
    pivot = int(np.argmax(np.abs(legs[..., 0]).reshape(-1, legs.shape[-2])[0]))
    chosen = legs[..., pivot : pivot + 1, :]
    if chosen[..., 0].all():
        legs = legs - legs[..., :1] / chosen[..., :1] * chosen
        legs[..., pivot, :] = chosen[..., 0, :]
    forms = motion_forms()
    quadrics: Complex = np.tensordot(legs, forms[:QUANTITIES], axes=1)
    if motion.has_study_condition:
        study = np.broadcast_to(forms[QUANTITIES], (*legs.shape[:-2], 1, 8, 8))
        quadrics = np.concatenate([study, quadrics], axis=-3)
    if motion.support == tuple(range(8)):
        return quadrics
    return quadrics[..., motion.support, :][..., :, motion.support]


def motion_values(point: Complex) -> Complex:
    """The 17 quantities at a point (e, f)."""
    values: Complex = np.einsum("kij,i,j->k", motion_forms()[:QUANTITIES], point, point)
    return values


@cache
def motion_forms() -> Real:
    """(18, 8, 8): the symmetric matrices of the 17 quantities, then Study's condition."""
    return np.array([_symmetric(quadric) for quadric in (*motion_quadrics((1, 1, 1)), STUDY_CONDITION)])


def _symmetric(quadric: Quadric) -> Real:
    matrix = np.zeros((8, 8))
    for (k, m), value in quadric.items():
        matrix[k, m] += value / 2
        matrix[m, k] += value / 2
    return matrix


def rational_coordinates(points: Complex, section: Section) -> Complex:
    """Study coordinates with respect to the robot's own frames and metric, from those of the normalised robot.

    With a and b the origins of the normalised frames, f becomes unit f + a e - e b (products of quaternions); in the
    metric e is divided by (sqrt(g1 g2 g3), sqrt(g_i)), and f multiplied by (1, sqrt(g_i / g1 g2 g3)).
    """
    frames, count = section.frames, len(points)
    full = np.zeros((count, 8), dtype=complex)
    full[:, section.motion.support] = points
    e, f = full[:, :4], full[:, 4:]
    f = frames.unit * f + _product(_pure(frames.base), e) - _product(e, _pure(frames.platform))
    volume = float(np.prod(frames.scales))
    e = e / np.concatenate([[volume], frames.scales])
    f = f * np.concatenate([[1.0], frames.scales / volume])
    return np.concatenate([e, f], axis=1)


def _pure(vector: Real) -> Real:
    return np.concatenate([[0.0], vector])[None]


def _product(left: Inexact, right: Inexact) -> Inexact:
    """Products of quaternions (.., 4)."""
    return np.stack(quaternion_product([*left.T], [*right.T]), axis=-1)
