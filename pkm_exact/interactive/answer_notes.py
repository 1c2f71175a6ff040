"""What is said beside an answer: the notes of the solution, and a doubt about the model's decimals if there is one.

The doubt is one about rounded data, not about what is proved; so it enters no certificate.
"""

from __future__ import annotations

from collections.abc import Sequence
from fractions import Fraction
from typing import TYPE_CHECKING

from pkm_exact.claim_wording import DIGITS, NEARBY, NEARBY_MOVES, NEARBY_SINGULAR
from pkm_exact.geometry.angle_degrees import stand_in_sentences
from pkm_exact.geometry.rational import finite_decimal
from pkm_exact.wording import with_unit

if TYPE_CHECKING:
    from pkm_exact.geometry.machine import Machine
    from pkm_exact.geometry.problem import ForwardProblem
    from pkm_exact.poses.pose import Pose
    from pkm_exact.solution import Solution


def answer_notes(robot: Machine | None, configuration: str | None, solution: Solution) -> tuple[str, ...]:
    """The notes of a solution, and those on the digits of the model that it is one of."""
    digit = None if robot is None else written_digit(robot, configuration)
    return (
        *solution.notes,
        *stand_in_notes(robot, configuration),
        *digit_notes(solution.problem, solution.poses, digit),
        *nominal_notes(robot, solution.poses),
        *(() if robot is None else _what_is_meant(solution, robot)),
    )


def _what_is_meant(solution: Solution, robot: Machine) -> tuple[str, ...]:
    """Why there is no pose, and what was perhaps meant in place of lengths that are far from the nominal pose."""
    problem, are_given = solution.problem, all(robot.are_lengths)
    why = () if solution.poses else _why_none(problem, robot, are_given=are_given)
    if robot.nominal is None or not are_given:
        return why
    from pkm_exact.poses.meant_lengths import farthest_note, meant_notes

    meant = meant_notes(problem, robot.nominal, robot.unit)
    farthest = () if solution.poses or why or meant else farthest_note(problem, robot.nominal, robot.unit)
    return (*(why[:1] if meant else why), *meant, *farthest)


def _why_none(problem: ForwardProblem, robot: Machine, *, are_given: bool) -> tuple[str, ...]:
    from pkm_exact.poses.unreachable_legs import unreachable_notes

    return unreachable_notes(problem, robot.unit, are_given=are_given)


def nominal_notes(robot: Machine | None, poses: Sequence[Pose]) -> tuple[str, ...]:
    """Which pose is the nearest to the one in which the robot is meant to be, if that is known."""
    if robot is None or robot.nominal is None:
        return ()
    from pkm_exact.poses.nearest_pose import nearest_pose

    found = nearest_pose(poses, robot.nominal)
    if found is None:
        return ()
    first, *others = found.numbers
    position = with_unit(f"{found.position_off:.4g}", robot.unit)
    off = f"its position is {position}, its rotation {found.degrees_off:.3g} degrees from it"
    if others:
        as_near = ", ".join(map(str, others))
        return (f"pose {first} is nearest to the nominal pose ({off}), or as near as its box tells: {as_near}",)
    return (f"pose {first} is the nearest to the nominal pose: {off}",)


def stand_in_notes(robot: Machine | None, configuration: str | None) -> tuple[str, ...]:
    """What stands in for angles that were given in degrees, in the geometry and the configuration."""
    if robot is None:
        return ()
    chosen = [entry for entry in robot.configurations if entry.name == configuration]
    found = [stand_in for part in (robot, *chosen) for stand_in in getattr(part, "stand_ins", ())]
    return stand_in_sentences(found)


def written_digit(robot: Machine, configuration: str | None) -> Fraction | None:
    """The unit of the last decimal in the geometry and the configuration; None if all numbers are exact."""
    chosen = [entry for entry in robot.configurations if entry.name == configuration]
    digits = [getattr(part, "written_digit", None) for part in (robot, *chosen)]
    return min((digit for digit in digits if digit is not None), default=None)


def digit_notes(problem: ForwardProblem, poses: Sequence[Pose], digit: Fraction | None) -> tuple[str, ...]:
    """A note if the condition number at a pose times the last digit is more than the size of the robot.

    At a singular pose it is infinite; that the pose is singular then rests on decimals.

    Examples
    --------
    >>> from pkm_exact import Robot
    >>> solution = Robot.load("models/3-rpr-merlet-p.toml").solve()
    >>> digit_notes(solution.problem, solution.poses, Fraction(1, 10))
    ()
    >>> digit_notes(solution.problem, solution.poses, Fraction(1))[0][:61]
    'all 2 poses: the condition number times the last digit writte'
    """
    if digit is None:
        return ()
    doubtful = [number for number, pose in enumerate(poses, 1) if _rests_on(pose, digit)]
    if not doubtful:
        return ()
    from pkm_exact.poses.nearby_shape import nearby_shape

    shape = nearby_shape(problem, digit)
    named = f"pose {doubtful[0]}" if len(doubtful) == 1 else f"poses {', '.join(map(str, doubtful))}"
    if len(doubtful) == len(poses) > 1:
        named = f"all {len(poses)} poses"
    sentences = [DIGITS.format(poses=named, digit=finite_decimal(digit) or digit)]
    if shape.facts:
        singular = NEARBY_SINGULAR if shape.is_singular else ""
        moves = NEARBY_MOVES if shape.is_singular and shape.moves else ""
        sentences.append(f"{NEARBY.format(facts=' and '.join(shape.facts))}{singular}{moves}")
    return tuple(sentences)


def _rests_on(pose: Pose, digit: Fraction) -> bool:
    if pose.jacobian is None:
        return False
    condition = pose.jacobian.condition
    return condition is None or condition.hi * digit > pose.jacobian.length
