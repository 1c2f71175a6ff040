"""The entries that certificates of both versions have in common, as they are spelled."""

from __future__ import annotations

from collections.abc import Iterable, Mapping, Sequence
from typing import TYPE_CHECKING, Any

from pkm_exact.certify.witness import translation_witnesses
from pkm_exact.poses.pose_spelling import pose_entry

if TYPE_CHECKING:
    from pkm_exact.poses.isolated_solutions import IsolatedSolutions
    from pkm_exact.poses.pose_representation import PoseRepresentation
    from pkm_exact.solution import Solution


def texts(values: Iterable[object]) -> list[str]:
    """Rationals as "p" or "p/q"."""
    return [str(value) for value in values]


def claim_entries(solution: Solution) -> dict[str, Any]:
    """What is claimed, by which engine, and the representation of the solutions: entries in their order."""
    return {
        "formulation": solution.formulation,
        "method": solution.method,
        "claim": str(solution.claim),
        "completeness_route": None if solution.completeness_route is None else str(solution.completeness_route),
        "complex_solutions": solution.complex_solutions,
        "distinct_solutions": solution.distinct_solutions,
        "real_poses": len(solution.poses),
        "representation": solutions_entry(solution),
    }


def pose_entries(solution: Solution) -> dict[str, Any]:
    """Boxes with one solution, the poses and the notes: entries in their order."""
    return {
        "krawczyk": None if solution.isolated is None else isolated_entry(solution.isolated),
        "box_exponent": solution.box_exponent if solution.poses else 0,
        "poses": [pose_entry(pose) for pose in solution.poses],
        "notes": list(solution.notes),
    }


def solutions_entry(solution: Solution) -> dict[str, Any] | None:
    """The representation of the solutions listed, or of complex poses that witness a self-motion."""
    from pkm_exact.poses.self_motion import SelfMotion, TranslationalMotion

    representation = solution.representation
    if isinstance(solution.self_motion, TranslationalMotion):
        return _spelled(translation_witnesses(solution.problem, solution.self_motion))
    if isinstance(solution.self_motion, SelfMotion):
        representation = solution.self_motion.representation
    return None if representation is None else representation_entry(representation)


def representation_entry(found: PoseRepresentation) -> dict[str, Any]:
    """A representation of poses."""
    keys = ("chart", "separating_form", "eliminant", "quaternion", "translation")
    return _spelled({key: getattr(found, key) for key in keys})


def _spelled(lists: Mapping[str, Any]) -> dict[str, Any]:
    return {
        "chart": list(lists["chart"]),
        "separating_form": list(lists["separating_form"]),
        "eliminant": coefficients(lists["eliminant"]),
        "quaternion": [coefficients(numerator) for numerator in lists["quaternion"]],
        "translation": [coefficients(numerator) for numerator in lists["translation"]],
    }


def steps_entry(solution: Solution) -> list[list[str]] | None:
    """The products in each step: index of an element, then the indices of the unknowns that multiply it."""
    if solution.completeness is None or solution.completeness.route != "exact-elimination":
        return None
    return products_entry(solution.completeness.elimination)


def products_entry(steps: Sequence[Sequence[tuple[int, tuple[int, ...]]]]) -> list[list[str]]:
    """Steps of an elimination, their products spelled one by one."""
    return [[" ".join(map(str, (index, *_factors(exponents)))) for index, exponents in step] for step in steps]


def isolated_entry(isolated: IsolatedSolutions) -> dict[str, Any]:
    """Boxes with exactly one solution each; of a pair of conjugate ones, one."""
    return {
        "chart": list(isolated.chart),
        "real": [
            {"exponents": list(box.exponents), "centre": [hex(real) for real, _ in box.centre]} for box in isolated.real
        ],
        "complex": [
            {"exponents": list(box.exponents), "centre": [[hex(part) for part in parts] for parts in box.centre]}
            for box in isolated.pairs
        ],
    }


def _factors(exponents: Iterable[int]) -> list[int]:
    return [unknown for unknown, exponent in enumerate(exponents) for _ in range(exponent)]


def coefficients(values: Iterable[int]) -> list[str]:
    """Hexadecimal integers, lowest degree first, without zeros of highest degree."""
    texts = [hex(value) for value in values]
    while texts and texts[-1] == "0x0":
        texts.pop()
    return texts
