"""Indices of what the machine can do at each pose of a sweep, as they are asked for by name."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from typing import Any

from pkm_exact.errors import InputError
from pkm_exact.geometry.machine import Machine
from pkm_exact.geometry.problem import ForwardProblem
from pkm_exact.poses.pose import Pose
from pkm_exact.roots.interval import Interval, decimal
from pkm_exact.wording import shown

_WIDE = "is not decided: the pose is not enclosed narrowly enough"


@dataclass(frozen=True)
class AskedIndices:
    """Which indices, and with which limits of actuators.

    Attributes
    ----------
    names : tuple of str
        Rows of ``statics.index_rows``.
    limits : tuple of pairs
        Keys of ``statics.limits_of_actuators`` with their numbers as text.

    Examples
    --------
    >>> AskedIndices.of(["ms"], {"length": ["3"]}, 6)
    AskedIndices(names=('ms',), limits=(('length', ('3',)),))
    """

    names: tuple[str, ...]
    limits: tuple[tuple[str, tuple[str, ...]], ...] = ()

    @classmethod
    def of(cls, names: Sequence[str], limits: dict[str, list[str]], actuators: int) -> AskedIndices:
        """The same, checked.

        Raises
        ------
        InputError
            If there is no such index, or a limit cannot be used.
        """
        from pkm_exact.statics.index_rows import STATICS_INDICES
        from pkm_exact.statics.limits_of_actuators import ActuatorLimits

        known = [index.name for index in STATICS_INDICES]
        for name in names:
            if name not in known:
                raise InputError(f"index: {shown(name)} is unknown; give one of {', '.join(known)}")
        ActuatorLimits.of(limits, actuators)
        found = tuple(sorted((key, tuple(values)) for key, values in limits.items()))
        return cls(tuple(dict.fromkeys(names)), found)

    def at_poses(
        self, robot: Machine, problem: ForwardProblem, poses: Sequence[Pose]
    ) -> tuple[list[dict[str, str | None]], list[str]]:
        """Of each pose the values as decimals, None where there is none; and sentences that say why."""
        values, reasons = [], dict[tuple[str, str], list[int]]()
        for number, pose in enumerate(poses, 1):
            found, refused = self._at(robot, problem, pose)
            values.append({name: found.get(name) for name in self.names})
            for name in self.names:
                if name not in found:
                    reasons.setdefault((name, refused[name]), []).append(number)
        return values, [_sentence(name, reason, numbers, len(poses)) for (name, reason), numbers in reasons.items()]

    def _at(self, robot: Machine, problem: ForwardProblem, pose: Pose) -> tuple[dict[str, str], dict[str, str]]:
        from pkm_exact.statics.index_rows import enclosed_indices
        from pkm_exact.statics.machine_at_pose import machine_at_solution

        try:
            at = machine_at_solution(robot, problem, pose)
            if at.jacobian is None and not at.held.is_redundant:
                return {}, dict.fromkeys(self.names, "there is no J, or that there is one is not decided")
            given: dict[str, Any] = {key: list(texts) for key, texts in self.limits}
            found, refused = enclosed_indices(at.measures(**given), self.names)
        except InputError as error:
            return {}, dict.fromkeys(self.names, str(error))
        wide = {name: _WIDE for name, value in found.items() if _is_wide(value)}
        return {name: decimal(value) for name, value in found.items() if name not in wide}, refused | wide


def _is_wide(value: Interval) -> bool:
    """Whether not even the last digit before the point is right to within one unit."""
    return value.width > 1


def _sentence(name: str, reason: str, numbers: list[int], count: int) -> str:
    if len(numbers) == count:
        return f"index {name}: {reason}"
    return f"index {name} at pose {', '.join(map(str, numbers))}: {reason}"
