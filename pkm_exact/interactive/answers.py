"""Answers as objects that can certify, check, save and show themselves: what an engine found, and who was asked.

Engines return data (``solution``, ``numeric.tolerance_result``) that know neither certificates nor pictures. Here they
meet the robot that was asked about, and get the same methods, whatever the question was.
"""

from __future__ import annotations

import os
from abc import ABC, abstractmethod
from dataclasses import dataclass, field, fields
from typing import TYPE_CHECKING, Any, Self

import pkm_exact.numeric.tolerance_result as tolerances
import pkm_exact.solution as solutions
from pkm_exact.errors import PkmExactError
from pkm_exact.geometry.machine import Machine

if TYPE_CHECKING:
    from matplotlib.figure import Figure

    from pkm_exact.certify.certificate import Certificate
    from pkm_exact.certify.checker.verdict import Verdict
    from pkm_exact.poses.limit_checks import LimitVerdict


@dataclass(frozen=True, repr=False, eq=False)
class Answer(ABC):
    """What every answer knows and can do beside its own data.

    Attributes
    ----------
    robot : Robot or None
        Who was asked; None if the question was a bare ``ForwardProblem``.
    configuration : str or None
        The name of its configuration; None if the lengths were given.
    """

    robot: Machine | None = field(default=None, repr=False, compare=False, kw_only=True)
    configuration: str | None = field(default=None, repr=False, compare=False, kw_only=True)

    @classmethod
    def of(cls, found: Any, robot: Machine | None = None, configuration: str | None = None) -> Self:
        """The answer with the data of what an engine returned."""
        data = {entry.name: getattr(found, entry.name) for entry in fields(found)}
        return cls(**data | {"robot": robot, "configuration": configuration})

    def certificate(self) -> Certificate:
        """What was found, in a form that a program checks which shares nothing with the solver.

        Raises
        ------
        PkmExactError
            If the answer does not know its robot.
        """
        from pkm_exact.certify.build import canonical_bytes
        from pkm_exact.certify.certificate import Certificate

        return Certificate(canonical_bytes(self._content(self._known_robot("certificate"))))

    def check(self) -> Verdict:
        """The verdict of the checker on the certificate.

        Raises
        ------
        PkmExactError
            If the answer does not know its robot.
        """
        return self.certificate().check()

    def save(self, path: str | os.PathLike[str]) -> None:
        """Write the certificate to a file, which appears whole or not at all.

        Raises
        ------
        PkmExactError
            If the answer does not know its robot, or the file cannot be written.
        """
        self.certificate().save(path)

    @abstractmethod
    def _content(self, robot: Machine) -> dict[str, Any]:
        """The certificate as a JSON object."""

    def _known_robot(self, what: str) -> Machine:
        if self.robot is None:
            raise PkmExactError(
                f"{what}: this solution knows its problem but not its robot; get it by robot.solve(..), or use "
                "pkm_exact.certificate(robot, name of the configuration or None, solution)"
            )
        return self.robot


@dataclass(frozen=True, repr=False)
class Solution(Answer, solutions.Solution):
    __doc__ = solutions.Solution.__doc__

    def limits(self) -> list[dict[str, LimitVerdict]]:
        """For each pose, what is proved of every limit of the robot: yes, no, or undecided within the box.

        Raises
        ------
        PkmExactError
            If the solution does not know its robot.

        Examples
        --------
        >>> from pkm_exact import Robot
        >>> Robot.load("models/3-rpr-merlet-p.toml").solve().limits()
        [{}, {}]
        """
        from pkm_exact.poses.limit_checks import limit_verdicts

        robot = self._known_robot("limits")
        locked = None if self.configuration is None else robot.configuration(self.configuration)
        return limit_verdicts(robot, locked, self.problem, self.poses)

    def plot(self) -> Figure:
        """A picture of all real poses side by side, a matplotlib figure.

        Raises
        ------
        PkmExactError
            If matplotlib is not installed, or the solution does not know its robot.

        Examples
        --------
        >>> from pkm_exact import Robot
        >>> figure = Robot.load("models/3-rpr-merlet-p.toml").solve().plot()  # doctest: +SKIP
        >>> figure.savefig("poses.png")  # doctest: +SKIP
        """
        from pkm_exact.interactive.display import solution_figure

        return solution_figure(self, self._known_robot("plot"), self.configuration)

    def _content(self, robot: Machine) -> dict[str, Any]:
        from pkm_exact.certify.build import certificate

        return certificate(robot, self.configuration, self)

    def _repr_html_(self) -> str:
        from pkm_exact.interactive.display import solution_html

        return solution_html(self, self.robot, self.configuration)


@dataclass(frozen=True, repr=False)
class ToleranceResult(Answer, tolerances.ToleranceResult):
    __doc__ = tolerances.ToleranceResult.__doc__

    def _content(self, robot: Machine) -> dict[str, Any]:
        from pkm_exact.certify.tolerance_build import tolerance_certificate
        from pkm_exact.geometry.robot import jointed

        return tolerance_certificate(jointed(robot, "certificate"), self.configuration, self)

    def _repr_html_(self) -> str:
        from pkm_exact.interactive.display import tolerance_html

        return tolerance_html(self)
