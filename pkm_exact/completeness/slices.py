"""More poses than there can be isolated ones: the poses then form a set of positive dimension.

Slices are cut by one more linear form, with one constant after the other; where that leaves curves, further forms are
joined first, with constants that do not change. Poses of different slices are different. If there are more than the
bound for the robot without the last form (``pose_bound``), not all of them are isolated. If so many real ones are
simple in their slices, one of them lies on a curve of real poses: the robot moves with its actuators locked.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass, replace
from fractions import Fraction
from itertools import islice
from random import Random
from typing import TYPE_CHECKING, Final

from pkm_exact.algebra.groebner import OutOfReachError
from pkm_exact.completeness.closed_section import rank_of
from pkm_exact.completeness.conditions import Conditions
from pkm_exact.completeness.pose_bound import pose_bound
from pkm_exact.completeness.pose_slices import MorePoses, Slice, shifted, with_forms
from pkm_exact.constraints.constraint import Role
from pkm_exact.constraints.form import SIZE, Form
from pkm_exact.errors import ReconstructionError
from pkm_exact.formulations.base import rational
from pkm_exact.formulations.registry import formulation_codes
from pkm_exact.geometry.problem import ForwardProblem, points
from pkm_exact.poses.search import PoseSearch
from pkm_exact.poses.singularity import are_isolated
from pkm_exact.roots.isolation import real_root_enclosures
from pkm_exact.stages import Amount, Stages

if TYPE_CHECKING:
    from pkm_exact.policy import Policy
    from pkm_exact.stages import Watch

LIFTING_BITS: Final = 1 << 15
"""Of the representation of a slice at most: others are tried."""
PARTS: Final = 16
"""Constants are multiples of the robot's size over this number."""
EMPTY: Final = 3
"""Slices without a pose after which a form is given up."""
INFINITE: Final = 2
"""Slices with infinitely many poses after which more forms are joined."""
PATIENCE: Final = 2
"""For a real motion so many times the slices that would do, if all were like the best one, are tried."""
ROOT_BITS: Final = 64
_POSITION, _ROTATION = (6, 4, 5), tuple(range(7, 16))


def more_poses(problem: ForwardProblem, policy: Policy, watch: Watch | None = None) -> MorePoses | None:
    """More poses than can be isolated, or None if none of the forms tried shows them.

    Parameters
    ----------
    problem : ForwardProblem
        Whose poses are infinitely many modulo a prime.
    policy : Policy
    watch : callable, optional
        Gets how many poses are found.
    """
    random = Random(policy.seed_for(problem.digest, "slices"))
    fixed: tuple[Form, ...] = ()
    for _ in range(problem.motion.dimension):
        extended = with_forms(problem, fixed)
        bound = pose_bound(Conditions.of(extended)).least
        for form in _candidates(random, extended):
            finite, slices = _Cut(extended, form, bound, policy, watch).slices()
            if slices:
                return MorePoses((*fixed, form), _needed(slices, bound), bound)
            if not finite:
                break
        else:
            return None
        fixed = (*fixed, shifted(form, _step(problem) * random.randint(1, 3)))
    return None


def _candidates(random: Random, problem: ForwardProblem) -> Iterator[Form]:
    """Forms to cut with: a coordinate of the position, then combinations of it, of the rotation, of both.

    Those that are constant by the problem's own forms are left out.
    """
    known = [*problem.forms, _form({SIZE - 1: 1})]
    forms = [_form({place: 1}) for place in _POSITION]
    parts = (_POSITION, _ROTATION, _POSITION + _ROTATION)
    forms += [_form({place: random.choice((-2, -1, 1, 2)) for place in places}) for places in parts]
    for form in forms:
        if _rank([*known, form]) > _rank(known):
            yield form


def _rank(forms: Sequence[Form]) -> int:
    return rank_of([[rational(value) for value in form] for form in forms])


@dataclass(frozen=True)
class _Cut:
    """The slices of a problem by one form."""

    problem: ForwardProblem
    form: Form
    bound: int
    policy: Policy
    watch: Watch | None

    def slices(self) -> tuple[bool, list[Slice]]:
        """Whether a slice has finitely many poses, and slices with more poses than the bound, none if they are few."""
        found: list[Slice] = []
        total = empty = infinite = 0
        for constant in islice(self._constants(), self.bound + EMPTY + 1):
            one = self._at(constant)
            if one is None:
                infinite += 1
                if infinite == INFINITE:
                    return False, []
                continue
            empty = 0 if one else empty + 1
            if empty == EMPTY:
                return True, []
            found += one
            total += sum(piece.count for piece in one)
            if self.watch is not None:
                self.watch(Amount(min(total, self.bound), self.bound, "poses"))
            if total > self.bound:
                return True, self._with_real(found)
        return True, []

    def _constants(self) -> Iterator[Fraction]:
        """First one that nothing is special about, then others around it."""
        step = _step(self.problem)
        yield 3 * step
        number = 1
        while True:
            yield (3 + number) * step
            yield (3 - number) * step
            number += 1

    def _at(self, constant: Fraction) -> list[Slice] | None:
        """The slice in a list, which is empty if it has no poses; None if it has infinitely many."""
        problem = with_forms(self.problem, (shifted(self.form, constant),))
        try:
            policy = replace(self.policy, lifting_bits=min(self.policy.lifting_bits, LIFTING_BITS))
            start, representation = PoseSearch(problem, formulation_codes()[0], policy, Stages()).found()
        except (OutOfReachError, ReconstructionError):
            return []
        if start.count is None:
            return None
        if representation is None:
            return []
        real = 0
        if are_isolated(representation, problem, self.policy):
            real = len(real_root_enclosures(representation.univariate.polynomial, ROOT_BITS))
        return [Slice(constant, representation, real)]

    def _with_real(self, found: list[Slice]) -> list[Slice]:
        """The slices with others close to the one with most real poses, if so more real poses than the bound appear."""
        best = max(found, key=lambda piece: piece.real)
        total = sum(piece.real for piece in found)
        if not best.real:
            return found
        step, more = _step(self.problem) / PARTS, list(found)
        for number in range(1, PATIENCE * (self.bound // best.real + 1)):
            if total > self.bound:
                break
            constant = best.constant + step * ((number + 1) // 2) * (1 if number % 2 else -1)
            one = self._at(constant) if all(piece.constant != constant for piece in more) else None
            more += one or []
            total += sum(piece.real for piece in one or [])
        return more


def _needed(found: Sequence[Slice], bound: int) -> tuple[Slice, ...]:
    """As few of the slices as prove a real motion, or else that there are too many poses; by increasing constant."""
    real = sum(piece.real for piece in found) > bound
    chosen, total = [], 0
    for piece in sorted(found, key=lambda piece: (piece.real if real else piece.count, piece.count), reverse=True):
        if total > bound:
            break
        chosen.append(piece)
        total += piece.real if real else piece.count
    return tuple(sorted(chosen, key=lambda piece: piece.constant))


def _step(problem: ForwardProblem) -> Fraction:
    """A part of the robot's size."""
    joints = [*points(problem, Role.BASE_POINT), *points(problem, Role.PLATFORM_POINT)]
    size = max((abs(value) for joint in joints for value in joint), default=Fraction(1))
    return Fraction(1 + size.__ceil__(), PARTS)


def _form(entries: dict[int, int]) -> Form:
    return tuple(Fraction(entries.get(place, 0)) for place in range(SIZE))
