"""Floating coordinates of certified poses, and what is certified of their Jacobians, from the content of a certificate.

The boxes of a certificate are as wide as they were asked for. Pictures take the poses in them from enclosures computed
anew, from the eliminant or from the boxes of Krawczyk's operator, narrow enough for every digit of a double.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass
from fractions import Fraction
from typing import TYPE_CHECKING, Any, Final

from flint import arb

from pkm_exact.certify.checker.document import read_document
from pkm_exact.certify.checker.krawczyk import Equations, narrowed
from pkm_exact.certify.checker.mechanism_boxes import MechanismEquations
from pkm_exact.certify.checker.mechanism_document import read_mechanism_document
from pkm_exact.certify.checker.realposes import ordinary_coordinates
from pkm_exact.geometry.problem import ForwardProblem
from pkm_exact.poses.jacobian import pose_jacobians
from pkm_exact.poses.leg_jacobian import LegJacobian
from pkm_exact.precision import working_precision
from pkm_exact.roots.isolation import real_root_enclosures

if TYPE_CHECKING:
    from pkm_exact.certify.checker.document import ListedPose, Representation
    from pkm_exact.certify.checker.krawczyk import Isolated

FIRST_PRECISION: Final = 256
DOUBLE_BITS: Final = 60
"""Coordinates are enclosed to 2^-60 of their size, or of 1: finer than a double."""


@dataclass(frozen=True)
class Placed:
    """A pose in doubles: position (3), rotation matrix by rows (9), unit quaternion (4); and its Jacobian."""

    coordinates: tuple[float, ...]
    det_sign: int | None
    jacobian: LegJacobian | None


@dataclass(frozen=True)
class ListedPoses:
    """The poses that a certificate lists, and what encloses them: a representation, or boxes with their equations."""

    representation: Representation | None
    isolated: Isolated | None
    equations: Equations | None
    metric: tuple[int, int, int]
    poses: tuple[ListedPose, ...]


def listed_poses(content: Mapping[str, Any]) -> ListedPoses:
    """The poses of an accepted certificate of either version."""
    body = {key: value for key, value in content.items() if key != "digest"}
    if "constraints" in content["robot"]:
        found = read_mechanism_document(body)
        boxes, mechanism = found.isolated, found.mechanism
        equations = None if boxes is None else MechanismEquations(mechanism, boxes.chart)
        return ListedPoses(found.representation, boxes, equations, mechanism.metric, found.poses)
    # A robot with legs as version 1 has it, of a certificate of either version.
    proofs = ("infinity", "self_motion")
    view = {key: value for key, value in body.items() if key not in proofs}
    document = read_document({**view, "version": 1, "completeness_route": None})
    isolated = document.isolated
    legs = None if isolated is None else Equations(document.legs, document.metric, isolated.chart)
    return ListedPoses(document.representation, isolated, legs, document.metric, document.poses)


def placed_poses(listed: ListedPoses, problem: ForwardProblem) -> list[Placed]:
    """The listed poses, in their order, and what is certified of the Jacobians of the problem that they answer."""
    enclosures = _Enclosures(listed)
    places = enclosures.in_doubles()
    jacobians = _jacobians(listed, enclosures, problem)
    return [Placed(coordinates, *jacobian) for coordinates, jacobian in zip(places, jacobians, strict=True)]


class _Enclosures:
    """Enclosures of the listed poses, to any precision."""

    def __init__(self, document: ListedPoses) -> None:
        self._document = document
        # The isolating intervals lie on one grid: in their order, the poses are those of the real roots in theirs.
        ends = [(Fraction(pose.parameter[0]), Fraction(pose.parameter[1])) for pose in document.poses if pose.parameter]
        self._places = [sorted(ends).index(end) for end in ends]

    def __call__(self, precision: int, indices: Sequence[int]) -> Iterator[Sequence[arb]]:
        """Position, rotation and quaternion of the poses with these indices."""
        representation, isolated = self._document.representation, self._document.isolated
        metric = self._document.metric
        equations = self._document.equations
        if isolated is not None and equations is not None:  # also if a representation of witnesses stands beside it
            for index in indices:
                bits = precision
                while (point := narrowed(equations, isolated.real[index], bits)) is None:
                    bits *= 2  # in a box that was proved this ends
                yield ordinary_coordinates(point[:4], point[4:], metric, bits)
        elif representation is not None:
            roots = real_root_enclosures(representation.eliminant // representation.eliminant.content(), precision)
            for index in indices:
                e, f = _study_coordinates(representation, roots[self._places[index]], precision)
                yield ordinary_coordinates(e, f, metric, precision)

    def in_doubles(self) -> list[tuple[float, ...]]:
        """All poses, each coordinate right to the last digits of a double."""
        count = len(self._document.poses)
        found: dict[int, tuple[float, ...]] = {}
        precision = FIRST_PRECISION
        while len(found) < count:
            left = [index for index in range(count) if index not in found]
            for index, values in zip(left, self(precision, left), strict=True):
                if all(_is_fine(value) for value in values):
                    found[index] = tuple(float(value.mid()) for value in values)
            precision *= 2
        return [found[index] for index in range(count)]


def _study_coordinates(representation: Representation, root: arb, precision: int) -> tuple[list[arb], list[arb]]:
    """(e, f) at an enclosed root of the eliminant."""
    with working_precision(precision):
        slope = representation.eliminant.derivative()(root)
        return (
            [numerator(root) / slope for numerator in representation.quaternion],
            [numerator(root) / slope for numerator in representation.translation],
        )


def _is_fine(value: arb) -> bool:
    return bool(value.is_finite() and value.rad() * arb(2) ** DOUBLE_BITS < 1 + abs(value.mid()))


def _jacobians(
    document: ListedPoses, enclosures: _Enclosures, problem: ForwardProblem
) -> list[tuple[int | None, LegJacobian | None]]:
    """Sign of the determinant of the leg Jacobian, and what is certified of it: 0 and None at a multiple solution.

    None twice where it is not proved whether the solution is simple.
    """
    simple = [index for index, pose in enumerate(document.poses) if pose.multiplicity == 1]

    def of_simple(precision: int, indices: Sequence[int]) -> Iterator[Sequence[arb]]:
        return enclosures(precision, [simple[index] for index in indices])

    found = dict(zip(simple, pose_jacobians(of_simple, problem, [None] * len(simple)), strict=True))
    return [
        (found[index].det_sign, found[index]) if index in found else (None if pose.multiplicity is None else 0, None)
        for index, pose in enumerate(document.poses)
    ]
