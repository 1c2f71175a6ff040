"""Places where constraints of any type seem to hold, in floating point: least squares from random starts.

The step at a pose is the least twist that cancels the values of all forms and quadrics, to first order: the wrenches
are their derivatives (``constraints.form``). With fewer constraints than freedoms it ends on the nearest pose or so.
Nothing is proved here; what is found is a proposal.
"""

from __future__ import annotations

from collections.abc import Iterator
from typing import Any, Final, TypeAlias

import numpy as np

from pkm_exact.constraints.form import Form, ordinary, value_at, wrench
from pkm_exact.geometry.problem import ForwardProblem
from pkm_exact.numeric.quaternions import rotation_matrix, turned
from pkm_exact.numeric.study_system import landmarks
from pkm_exact.numeric.uncertified import Ending, NumericPose

Real: TypeAlias = Any
"""An array of doubles, of which ``constraints.form`` asks that it is a sequence."""
STEPS: Final = 60
SMALL: Final = 1e-10
"""Of a step relative to the size of the mechanism: the descent has ended."""
CUTOFF: Final = 1e-9
"""Singular values below this, relative to the greatest, count as 0."""
LONGEST: Final = 0.5
"""Of a step, in radians and relative to the size."""
_ORDINARY: Final = (1, 1, 1)


def approximate_poses(problem: ForwardProblem, starts: int, seed: int) -> Iterator[NumericPose]:
    """The poses at which descents from random starts end, as they are found.

    Examples
    --------
    >>> from fractions import Fraction
    >>> from pkm_exact.constraints.distance import Distance
    >>> origin = (Fraction(0),) * 3
    >>> pose = next(approximate_poses(ForwardProblem((Distance(origin, origin, Fraction(4)),)), 1, 0))
    >>> round(sum(value**2 for value in pose.position), 9)
    4.0
    """
    random = np.random.default_rng(seed)
    try:
        equations = _Equations(problem)
    except OverflowError:
        return
    free = np.array([float(k in problem.motion.twist) for k in range(6)])
    for _ in range(starts):
        direction = random.standard_normal(4) * np.array([1.0, *free[3:]])
        position = equations.size * random.standard_normal(3) * free[:3]
        quaternion = tuple(direction / np.linalg.norm(direction))
        with np.errstate(all="ignore"):
            found = _descended(equations, position, quaternion)
        if found is not None:
            yield found


class _Equations:
    """Forms and quadrics in ordinary coordinates, each with its greatest coefficient 1."""

    def __init__(self, problem: ForwardProblem) -> None:
        roots = [float(g) ** 0.5 for g in problem.metric]
        self.twist = list(problem.motion.twist)

        def rounded(form: Form) -> Real:
            return np.array(ordinary([float(value) for value in form], roots))

        self._forms = [form / np.abs(form).max() for form in map(rounded, problem.forms)]
        self._squares = [(rounded(q.linear), rounded(q.root), float(q.factor)) for q in problem.squares]
        points = [point for side in landmarks(problem) for point in side]
        self.size = max(abs(float(x)) * r for point in points for x, r in zip(point, roots, strict=True)) or 1.0

    def at(self, position: Real, rotation: Real) -> tuple[Real, Real]:
        """Values, and the rows of derivatives along the twists that are possible."""
        place = position, rotation, _ORDINARY
        values = [value_at(form, *place) for form in self._forms]
        rows: list[Any] = [wrench(form, position, rotation) for form in self._forms]
        for linear, root, factor in self._squares:
            value = value_at(root, *place)
            values.append(value_at(linear, *place) - factor * value * value)
            pairs = zip(wrench(linear, position, rotation), wrench(root, position, rotation), strict=True)
            rows.append([left - 2 * factor * value * right for left, right in pairs])
        return np.array(values, dtype=float), np.array(rows, dtype=float).reshape(-1, 6)[:, self.twist]


def _descended(equations: _Equations, position: Real, quaternion: Any) -> NumericPose | None:
    """Where the steps end; None if they do not, within their number."""
    scale = np.array([equations.size] * 3 + [1.0] * 3)[equations.twist]
    for count in range(STEPS):
        values, rows = equations.at(position, rotation_matrix(quaternion))
        if not (np.isfinite(values).all() and np.isfinite(rows).all()):
            return None
        step = -scale * (np.linalg.pinv(rows * scale, rcond=CUTOFF) @ values)
        relative = float(np.linalg.norm(step / scale))
        if relative < SMALL:
            return _pose(position, quaternion, count, float(np.abs(values).max(initial=0.0)))
        full = np.zeros(6)
        full[equations.twist] = step * min(1.0, LONGEST / relative)
        position, quaternion = position + full[:3], turned(quaternion, full[3:].tolist())
    return None


def _pose(position: Real, quaternion: Any, steps: int, residual: float) -> NumericPose:
    x, y, z = map(float, position)
    q0, q1, q2, q3 = map(float, quaternion)
    first, second, third = ((float(a), float(b), float(c)) for a, b, c in rotation_matrix(quaternion))
    return NumericPose(Ending.CONVERGED, (x, y, z), (first, second, third), (q0, q1, q2, q3), steps, residual)
