"""Exact data of a forward kinematics problem: constraints on a platform, the motions it is capable of, a Gram metric.

A parallel robot with locked actuators is a list of constraints on the pose (C, R) of its platform. Coordinates
are rational with respect to orthogonal axes whose squared lengths are the Gram diagonal ``metric``: the ordinary
coordinate is sqrt(metric[i]) times the rational one. With ``metric = (1, 3, 1)`` equilateral triangles are exact.
"""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property, lru_cache

from pkm_exact.constraints.constraint import Constraint, Role, SquareForm
from pkm_exact.constraints.distance import Distance
from pkm_exact.constraints.form import Form, Vector
from pkm_exact.digests import digest
from pkm_exact.errors import InputError
from pkm_exact.motions.motion import Motion
from pkm_exact.motions.motion_groups import PLANAR, SPATIAL


@dataclass(frozen=True)
class ForwardProblem:
    """A robot with locked actuators: find every pose (C, R) that all constraints admit.

    Attributes
    ----------
    constraints : tuple of Constraint
        Of a Gough platform six legs, each a ``Distance`` |C + R B - A| = l; of a planar one three.
    metric : tuple of 3 int
        Gram diagonal of both frames, positive integers.
    motion : Motion
        The motions that the platform is capable of. If they are planar, C3 = 0, R turns about the third axis, and all
        third coordinates of joints are 0.

    Examples
    --------
    >>> from fractions import Fraction
    >>> zero = (Fraction(0),) * 3
    >>> len(ForwardProblem((Distance(zero, zero, Fraction(4)),)).distances)
    1
    """

    constraints: tuple[Constraint, ...]
    metric: tuple[int, int, int] = (1, 1, 1)
    motion: Motion = SPATIAL

    def __hash__(self) -> int:
        return self._hash

    @cached_property
    def _hash(self) -> int:
        """That of its values: what is remembered of a problem is looked up several times in a solve.

        Robots with the same values are told apart as equal ones are. To hash fractions takes time, and a leg has seven.
        """
        values = [getattr(found, found.value_field) for found in self.constraints if found.value_field is not None]
        return hash((*values, self.metric, self.motion.name, len(self.constraints)))

    @property
    def distances(self) -> tuple[Distance, ...]:
        """The constraints of a robot all of whose constraints are legs of known length.

        Raises
        ------
        InputError
            If there is another constraint.
        """
        legs = tuple(found for found in self.constraints if isinstance(found, Distance))
        for found in self.constraints:
            if not isinstance(found, Distance):
                called = f" {found.name!r}" if found.name else ""
                raise InputError(
                    f"constraint{called}: is of the type {found.type}, but this question is for legs of known length "
                    "only; ask it about a robot all of whose constraints are distances"
                )
        return legs

    @property
    def gough_legs(self) -> tuple[Distance, ...]:
        """The legs of a Gough platform or of its planar sister: six of known length in space, or three in the plane.

        Raises
        ------
        InputError
            If it is another robot.
        """
        legs = self.distances
        if not self.is_gough:
            raise InputError(
                f"constraints: {len(legs)} legs and {self.motion.name} motions, but this question is for six legs in "
                "space or three in the plane; ask another one, or about another robot"
            )
        if self.motion == PLANAR and any(leg.base[2] or leg.platform[2] for leg in legs):
            raise InputError("constraints: a joint is out of the plane; give third coordinates 0")
        return legs

    @property
    def is_gough(self) -> bool:
        """Whether it has six legs of known length in space or three in the plane, and no other constraint."""
        is_of_kind = self.motion in (SPATIAL, PLANAR) and len(self.constraints) == self.motion.dimension
        return is_of_kind and self.has_only_distances

    @property
    def has_only_distances(self) -> bool:
        """Whether every constraint is a leg of known length."""
        return all(isinstance(found, Distance) for found in self.constraints)

    def __getstate__(self) -> dict[str, object]:
        """For copies and other processes: what is derived is derived again."""
        return {name: self.__dict__[name] for name in self.__dataclass_fields__}

    @cached_property
    def forms(self) -> tuple[Form, ...]:
        """The linear forms on rigid motions that vanish at the poses, in the order of the constraints.

        Examples
        --------
        >>> from pkm_exact import read_robot
        >>> robot = read_robot("models/3-rrr.toml")
        >>> len(robot.problem(robot.configuration()).forms)
        3
        """
        return tuple(form for found in self.constraints for form in found.forms(self.metric))

    @cached_property
    def squares(self) -> tuple[SquareForm, ...]:
        """The quadrics on rigid motions that vanish there as well: one for each cylinder."""
        return tuple(square for found in self.constraints for square in found.squares(self.metric))

    @property
    def equation_count(self) -> int:
        """How many equations the constraints are: a line is two of them, a point three."""
        return len(self.forms) + len(self.squares)

    @property
    def solution_bound(self) -> int:
        """The most isolated solutions, with multiplicities: the degree of the variety of motions, by Bezout's theorem.

        A hyperplane does not add to it; each cylinder, a quadric, doubles it.
        """
        return self.motion.degree << len(self.squares)

    @property
    def digest(self) -> int:
        """A number that follows from metric, motion and constraints, and from nothing else, not even their names.

        Random choices about the problem start from it.
        """
        return _digest(self)


@lru_cache(maxsize=16)
def _digest(problem: ForwardProblem) -> int:
    """The same; every step of a solve asks for it."""
    metric, constraints = problem.metric, problem.constraints
    squares = [(x.linear, x.root, x.factor) for found in constraints for x in found.squares(metric)]
    return digest(metric, problem.motion.name, [found.forms(metric) for found in constraints], squares)


def points(problem: ForwardProblem, role: Role) -> list[Vector]:
    """The points of the base or of the platform that constraints name, in their order, equal ones as often as named.

    Examples
    --------
    >>> from fractions import Fraction
    >>> zero = (Fraction(0),) * 3
    >>> points(ForwardProblem((Distance(zero, zero, Fraction(4)),)), Role.BASE_POINT) == [zero]
    True
    """
    return [
        getattr(found, name) for found in problem.constraints for name, kind in found.fields.items() if kind == role
    ]
