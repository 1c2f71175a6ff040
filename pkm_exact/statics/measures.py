"""Numbers from J that several indices share, each computed once, in balls.

A is J on an orthonormal basis of the allowed twists, turns times the length L. J^+ = (J^T J)^-1 J^T maps actuator
speeds to twists; actuator forces J^+T f of least norm bear the wrench f (Shayya et al., IROS 2014, equations 1 to 9).
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, field
from fractions import Fraction
from functools import cached_property
from typing import Any

from flint import arb, arb_mat

from pkm_exact.errors import InputError
from pkm_exact.polytopes.enclosures import ball_of
from pkm_exact.polytopes.polytope import Polytope
from pkm_exact.precision import working_precision
from pkm_exact.statics.ball_rows import BITS
from pkm_exact.statics.capability import velocity_polytope
from pkm_exact.statics.eigenvalues import gram_eigenvalues
from pkm_exact.statics.freedom import Freedom
from pkm_exact.statics.limits_of_actuators import ActuatorLimits


def norm_of(values: Sequence[arb]) -> arb:
    """The root of the sum of squares, each a product: powers of balls about 0 are no numbers.

    Examples
    --------
    >>> norm_of([arb(3), arb(0, 1e-30), arb(4)]).contains(arb(5))
    True
    """
    return sum((value * value for value in values), arb(0)).nonnegative_part().sqrt()


class RefusedError(InputError):
    """An index that has no meaning, or needs data that were not given; the message says which."""


@dataclass(frozen=True, eq=False)
class Measures:
    """J of a machine at a pose with limits of its actuators, and what follows.

    Attributes
    ----------
    freedom : Freedom
    limits : ActuatorLimits
    """

    freedom: Freedom
    limits: ActuatorLimits = field(default_factory=ActuatorLimits)

    @property
    def unit(self) -> str:
        """Of length."""
        return self.freedom.at.unit

    def require_norms(self) -> None:
        """Refuse norms of twists and actuator speeds that add what has different units."""
        if self.freedom.has_both and self.limits.length is None:
            raise RefusedError(
                "mixes translations and turns: give a length, or greatest speeds of the platform (twist)"
            )
        if len(self.freedom.units) > 1 and self.limits.speeds is None:
            raise RefusedError("mixes actuators of different units: give their greatest speeds")

    @cached_property
    def scaled(self) -> arb_mat:
        """A, its rows divided by greatest speeds where actuators have different units."""
        self.require_norms()
        speeds = self.limits.speeds if len(self.freedom.units) > 1 else None
        return self.freedom.scaled(self.limits.length, speeds)

    @cached_property
    def singular_values(self) -> list[arb]:
        """Of A, in increasing order."""
        matrix = self.scaled
        if matrix.nrows() < matrix.ncols():
            raise RefusedError("has no meaning with fewer actuators than freedoms")
        with working_precision(BITS):
            found = gram_eigenvalues(matrix)
            if found is None or not found[0] > 0:
                raise RefusedError("is not decided: J is singular, or the pose is not enclosed narrowly enough")
            return [value.sqrt() for value in found]

    @cached_property
    def unscaled(self) -> arb_mat:
        """J, of a machine all of whose constraints are actuated."""
        if self.freedom.at.held.structural:
            raise RefusedError(
                "is about single components of twists or wrenches: for machines all of whose constraints are actuated"
            )
        return self.freedom.ball_jacobian

    @cached_property
    def allowed(self) -> arb_mat | None:
        """J on an orthonormal basis of the twists that constraints allow, if some are not actuated."""
        if not self.freedom.at.held.structural:
            return None
        length = self.known("length") if self.freedom.has_both else None
        return self.freedom.scaled(length)

    @cached_property
    def inverse(self) -> arb_mat:
        """J^+ = (J^T J)^-1 J^T."""
        return self._inverse(self.unscaled)

    @staticmethod
    def _inverse(matrix: arb_mat) -> arb_mat:
        if matrix.nrows() < matrix.ncols():
            raise RefusedError("has no meaning with fewer actuators than freedoms")
        with working_precision(BITS):
            transpose = matrix.transpose()
            try:
                return matrix.inv() if matrix.nrows() == matrix.ncols() else (transpose * matrix).inv() * transpose
            except ZeroDivisionError:
                raise RefusedError(
                    "is not decided: J is singular, or the pose is not enclosed narrowly enough"
                ) from None

    def columns(self, *, turning: bool) -> list[int]:
        """Which components of a twist are translations, or turns."""
        found = [j for j, k in enumerate(self.freedom.at.motion.twist) if (k >= 3) == turning]
        if not found:
            raise RefusedError(f"has no meaning for a motion without {'turns' if turning else 'translations'}")
        return found

    def isotropic_speed(self, columns: Sequence[int] | None, spin: Sequence[Any] | None = None) -> arb:
        """The speed that is reached in every direction of these components, the others 0 or an imposed spin.

        None stands for all directions that constraints allow.
        """
        speeds, (matrix, places, factors) = self.known("speeds"), self._on(columns)
        with working_precision(BITS):
            least: arb | None = None
            for i, speed in enumerate(speeds):
                norm = norm_of([matrix[i, j] / factors[j] for j in places])
                left = ball_of(speed)
                if spin is not None:
                    turning = self.columns(turning=True)
                    left -= abs(sum((matrix[i, j] * ball_of(w) for j, w in zip(turning, spin, strict=True)), arb(0)))
                    left = left.max(arb(0))
                if norm.contains(0):
                    if not norm.is_zero():
                        raise RefusedError("is not decided: the pose is not enclosed narrowly enough")
                    if left > 0:
                        continue
                found = left / norm if not norm.is_zero() else arb(0)
                least = found if least is None else least.min(found)
        if least is None:
            raise RefusedError("is infinite: no actuator takes part in these motions")
        return least

    def isotropic_force(self, rows: Sequence[int] | None) -> arb:
        """The force that is borne in every direction of these components, actuator forces of least norm.

        None stands for all directions that constraints do not bear.
        """
        forces, (jacobian, places, factors) = self.known("forces"), self._on(rows)
        matrix = self._inverse(jacobian) if rows is None else self.inverse
        if self.limits.least_forces is not None:
            raise RefusedError("is for forces that are limited both ways alike; see the wrench polytope")
        with working_precision(BITS):
            least: arb | None = None
            for i, force in enumerate(forces):
                norm = norm_of([matrix[j, i] * factors[j] for j in places])
                if norm.contains(0):
                    if not norm.is_zero():
                        raise RefusedError("is not decided: the pose is not enclosed narrowly enough")
                    continue
                found = ball_of(force) / norm
                least = found if least is None else least.min(found)
        if least is None:
            raise RefusedError("is infinite: no actuator takes part in these forces")
        return least

    def _on(self, places: Sequence[int] | None) -> tuple[arb_mat, Sequence[int], list[arb]]:
        """J, which of its columns are meant, and by what the components that belong to them are multiplied."""
        if places is None and self.allowed is not None:
            count = self.allowed.ncols()
            return self.allowed, range(count), [arb(1)] * count
        chosen = range(len(self.freedom.at.twist)) if places is None else places
        return self.unscaled, chosen, self._factors(chosen)

    def _factors(self, places: Sequence[int]) -> list[arb]:
        """By what components of a twist are multiplied: turns by the length, where translations are meant too."""
        twist = self.freedom.at.motion.twist
        if len({twist[j] < 3 for j in places}) < 2:
            return [arb(1)] * len(twist)
        length = ball_of(self.known("length"))
        return [arb(1) if k < 3 else length for k in twist]

    def known(self, name: str) -> Any:
        """A limit that must have been given."""
        value = getattr(self.limits, name)
        if value is None:
            raise RefusedError(f"needs limits: {name}")
        return value

    @cached_property
    def error_polytope(self) -> Polytope:
        """The twists that errors of the actuators within their resolutions are."""
        return velocity_polytope(self.freedom, self.known("resolutions"))

    def greatest_error(self, columns: Sequence[int]) -> arb:
        """The greatest norm of these components over all errors: at a vertex, as it is convex."""
        polytope, expansion = self.error_polytope, self.freedom.expansion
        with working_precision(BITS):
            roots = [ball_of(square).sqrt() for square in polytope.squares]
            found = arb(0)
            for vertex in polytope.vertices:
                free = arb_mat([[root * ball_of(x)] for root, x in zip(roots, vertex, strict=True)])
                twist = expansion * free
                found = found.max(norm_of([twist[j, 0] for j in columns]))
            return found

    @cached_property
    def wanted(self) -> dict[str, Fraction | None]:
        """What is wanted of the platform."""
        names = ("speed", "turn", "force", "moment")
        return {name: getattr(self.limits, name) for name in names}
