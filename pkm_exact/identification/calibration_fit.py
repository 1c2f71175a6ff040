"""Joints and length offsets of a robot from measured poses: least squares, with covariance. Floating point.

Leg i at pose k leaves the residual |C_k + R_k B_i - A_i| - (l_ik + o_i). The sum of their squares is minimised over
A_i, B_i and o_i, leg by leg, as no leg knows of another. Directions that are not shown stay at the model: the
parameters are theta = theta_0 + V y, the columns of V an orthonormal basis of what is shown. With s^2 the sum over all
legs divided by the number of measurements less that of the parameters shown, the covariance is s^2 V (J^T J)^-1 V^T.

Reference: Björck, Numerical Methods for Least Squares Problems (1996), section 1.1; solved by ``scipy.optimize``.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any

from pkm_exact.errors import InputError
from pkm_exact.poses.arrays import required

if TYPE_CHECKING:
    from collections.abc import Callable

    import numpy as np
    from numpy.typing import NDArray

    from pkm_exact.geometry.robot import Robot
    from pkm_exact.identification.measured_poses import MeasuredPose
    from pkm_exact.identification.observation import Identification

    Real = NDArray[np.float64]


@dataclass(frozen=True)
class LegFit:
    """What was fitted of a leg.

    Attributes
    ----------
    names : tuple of str
    values : tuple of float
        Of base joint, platform joint and, if it was asked for, offset: true length less length read.
    covariance : tuple of tuples of float
    before, after : tuple of float
        Residuals at each pose, of the model and of the fit: true length less length read.
    is_minimum : bool
        Whether the search ended at one, by its own tolerances.
    """

    names: tuple[str, ...]
    values: tuple[float, ...]
    covariance: tuple[tuple[float, ...], ...]
    before: tuple[float, ...]
    after: tuple[float, ...]
    is_minimum: bool = True


def fitted_legs(
    robot: Robot, measured: Sequence[MeasuredPose], known: Sequence[Identification], *, offsets: bool
) -> tuple[LegFit, ...]:
    """The least squares fit of all legs.

    Parameters
    ----------
    robot : Robot
    measured : sequence of MeasuredPose
    known : sequence of Identification
        Of each leg, for the parameters asked for.
    offsets : bool
        Whether lengths have offsets.

    Raises
    ------
    PkmExactError
        If scipy is not installed.
    InputError
        If there are not more measurements than parameters that they show, or no minimum is found.
    """
    least_squares = required("scipy.optimize", "calibrate", "pip install 'pkm_exact[scipy]'").least_squares
    import numpy as np

    freedom = len(measured) * len(known) - sum(leg.rank for leg in known)
    if freedom <= 0:
        raise InputError(
            f"{len(measured)} poses show {sum(leg.rank for leg in known)} parameters, no measurement is left to judge "
            "by; give more poses"
        )
    size = 2 if robot.motion.is_planar else 3
    c = np.array([[float(x) for x in m.position[:size]] for m in measured])
    r = np.array([[[float(x) for x in row[:size]] for row in m.rotation[:size]] for m in measured])
    found = []
    for leg, shown in enumerate(known):
        start = np.array(
            [float(x) for joint in (robot.base_joints[leg], robot.platform_joints[leg]) for x in joint[:size]]
            + [0.0] * offsets
        )
        residual = _residual(c, r, np.array([float(m.lengths[leg]) for m in measured]), size)
        basis = _basis(shown, len(start))
        fit = least_squares(
            lambda y, s=start, v=basis, f=residual: f(s + v @ y),
            np.zeros(basis.shape[1]),
            method="lm",
            xtol=1e-15,
            ftol=1e-15,
            gtol=1e-15,
        )
        if not np.isfinite(fit.x).all():
            raise InputError(f"leg {leg + 1}: no minimum was found; are the poses those of this robot?")
        found.append((start, basis, fit, residual))
    total = sum(float(fit.fun @ fit.fun) for _, _, fit, _ in found) / freedom
    return tuple(_leg_fit(shown.parameters, *entry, total) for shown, entry in zip(known, found, strict=True))


def _residual(c: Real, r: Real, lengths: Real, size: int) -> Callable[[Real], Real]:
    import numpy as np

    def residual(theta: Real) -> Real:
        arms = c + r @ theta[size : 2 * size] - theta[:size]
        offset = theta[2 * size] if len(theta) > 2 * size else 0.0
        return np.asarray(np.linalg.norm(arms, axis=1) - lengths - offset)

    return residual


def _basis(shown: Identification, size: int) -> Real:
    """An orthonormal basis of the directions that are shown: those perpendicular to what is not, and that exactly."""
    import numpy as np

    rows = np.array([[float(x) for x in row] for row in shown.base]).reshape(-1, size)
    return np.asarray(np.linalg.qr(rows.T)[0])


def _leg_fit(
    names: tuple[str, ...], start: Real, basis: Real, fit: Any, residual: Callable[[Real], Real], total: float
) -> LegFit:
    import numpy as np

    jacobian: Real = fit.jac
    covariance = np.zeros((len(start),) * 2)
    if basis.shape[1]:
        try:
            covariance = basis @ (total * np.linalg.inv(jacobian.T @ jacobian)) @ basis.T
        except np.linalg.LinAlgError:  # where the fit ended, not at the model: see the exact ranks
            covariance = np.full_like(covariance, np.inf)
    values = start + basis @ fit.x
    return LegFit(
        names,
        tuple(map(float, values)),
        tuple(tuple(map(float, row)) for row in covariance),
        tuple(map(float, residual(start))),
        tuple(map(float, residual(values))),
        bool(fit.success),
    )
