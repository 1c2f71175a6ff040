"""Certificates of mechanisms with one known pose, at which every constraint is made to hold: all types, all motions."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from fractions import Fraction
from itertools import count
from typing import Any

from certificate_subjects import subject
from forged_representations import fit_real_poses, representation_through, set_representation

from pkm_exact.certify.build_constraints import constraint_entry
from pkm_exact.certify.checker.study_motion import motion
from pkm_exact.constraints.angle import Angle
from pkm_exact.constraints.at_point import AtPoint
from pkm_exact.constraints.axis_distance import AxisDistance
from pkm_exact.constraints.constraint import Constraint
from pkm_exact.constraints.distance import Distance
from pkm_exact.constraints.form import Vector
from pkm_exact.constraints.linear import LinearForm
from pkm_exact.constraints.on_line import OnLine
from pkm_exact.constraints.point_in_plane import Carries, InPlane

Content = dict[str, Any]
Numbers = Sequence[Fraction | int]
KEYS = (
    *("format", "version", "robot", "configuration", "formulation", "method", "claim", "completeness_route"),
    *("complex_solutions", "distinct_solutions", "real_poses", "representation", "infinity", "elimination"),
    *("self_motion", "krawczyk", "box_exponent", "poses", "notes"),
)
"""Of a certificate of version 2, in their order, without the digest."""


@dataclass(frozen=True)
class Pose:
    """(e, f), and the constraints that hold there, in a metric."""

    e: Numbers
    f: Numbers
    metric: tuple[int, int, int] = (1, 1, 1)

    def quantities(self) -> tuple[list[Fraction], list[list[Fraction]], list[Fraction]]:
        """C, R and u = R^-1 C."""
        placed = motion([Fraction(x) for x in self.e], [Fraction(x) for x in self.f], self.metric)
        assert placed.study == 0
        position = [x / placed.norm for x in placed.position]
        rotation = [[x / placed.norm for x in row] for row in placed.rotation]
        return position, rotation, [x / placed.norm for x in placed.turned]

    def image(self, point: Numbers) -> Vector:
        """C + R B."""
        position, rotation, _ = self.quantities()
        x, y, z = (
            c + sum((r * Fraction(b) for r, b in zip(row, point, strict=True)), Fraction(0))
            for c, row in zip(position, rotation, strict=True)
        )
        return x, y, z

    def product(self, one: Numbers, other: Numbers) -> Fraction:
        """That of the metric."""
        return sum(
            (g * Fraction(x) * Fraction(y) for g, x, y in zip(self.metric, one, other, strict=True)), Fraction(0)
        )

    def distance(self, base: Numbers, platform: Numbers) -> Distance:
        """A leg."""
        leg = [x - y for x, y in zip(self.image(platform), base, strict=True)]
        return Distance(_vector(base), _vector(platform), self.product(leg, leg))

    def in_plane(self, normal: Numbers, platform: Numbers) -> InPlane:
        """A platform point in a plane."""
        return InPlane(_vector(normal), self.product(normal, self.image(platform)), _vector(platform))

    def carries(self, normal: Numbers, base: Numbers) -> Carries:
        """A base point in a plane of the platform: m.(R^-1 A - u)."""
        return Carries(_vector(normal), self._turned_back(normal, base), _vector(base))

    def _turned_back(self, normal: Numbers, base: Numbers) -> Fraction:
        position, rotation, _ = self.quantities()
        turned = [sum((r * Fraction(m) for r, m in zip(row, normal, strict=True)), Fraction(0)) for row in rotation]
        return self.product(turned, [Fraction(a) - c for a, c in zip(base, position, strict=True)])

    def angle(self, base: Numbers, platform: Numbers) -> Angle:
        """The product of two directions."""
        turned = [x - y for x, y in zip(self.image(platform), self.image((0, 0, 0)), strict=True)]
        return Angle(_vector(base), _vector(platform), self.product(base, turned))

    def on_line(self, direction: Numbers, platform: Numbers) -> OnLine:
        """A platform point on a line, given by another point of it."""
        point = [x + 2 * Fraction(v) for x, v in zip(self.image(platform), direction, strict=True)]
        return OnLine(_vector(point), _vector(direction), _vector(platform))

    def at_point(self, platform: Numbers) -> AtPoint:
        """A platform point at a base point."""
        return AtPoint(self.image(platform), _vector(platform))

    def axis_distance(self, point: Numbers, direction: Numbers, platform: Numbers) -> AxisDistance:
        """A platform point at a distance from an axis."""
        d = [x - Fraction(y) for x, y in zip(self.image(platform), point, strict=True)]
        along = self.product(direction, d)
        square = self.product(d, d) - along * along / self.product(direction, direction)
        return AxisDistance(_vector(point), _vector(direction), _vector(platform), square)

    def linear(self, coefficients: Numbers) -> LinearForm:
        """Any form, of 16 coefficients and the one that makes it 0."""
        position, rotation, turned = self.quantities()
        values = [self.product(position, position), *turned, *position, *(x for row in rotation for x in row)]
        value = sum((Fraction(c) * x for c, x in zip(coefficients, values, strict=True)), Fraction(0))
        return LinearForm((*map(Fraction, coefficients), -value))


def _vector(values: Numbers) -> Vector:
    x, y, z = map(Fraction, values)
    return x, y, z


def mechanism(kind: str, metric: tuple[int, int, int], constraints: Sequence[Constraint]) -> Content:
    """The entry ``robot``."""
    entries = [
        {**constraint_entry(constraint, metric), "name": f"constraint {number}"}
        for number, constraint in zip(count(1), constraints, strict=False)
    ]
    described = {"name": "made up", "unit": "m", "source": "made up", "motion": kind}
    return {**described, "metric": [str(g) for g in metric], "constraints": entries}


def listing(
    kind: str,
    poses: Sequence[Pose],
    constraints: Sequence[Constraint],
    multiplicity: int | None = 1,
    weight: int = 1,
    form: Sequence[int] = (),
) -> Content:
    """Some rational poses of a mechanism, not proved to be all; the parameter of the n-th one is n, or a form there."""
    content = subject("not proven complete")
    content = {**content, "robot": mechanism(kind, poses[0].metric, constraints), "box_exponent": 31, "poses": []}
    chart = next(k for k in range(4) if all(pose.e[k] for pose in poses))
    points = []
    for pose in poses:
        scale = Fraction(pose.e[chart])
        points.append(([x / scale for x in pose.e], [x / scale for x in pose.f]))
    parameters = [Fraction(n) for n in range(len(poses))]
    if form:
        parameters = [sum((c * x for c, x in zip(form, (*e, *f), strict=True)), Fraction(0)) for e, f in points]
    rows = representation_through(parameters, points)
    set_representation(content, rows, form or _separating(points, parameters))
    content["representation"] = {**content["representation"], "chart": [int(k == chart) for k in range(4)]}
    fit_real_poses(content, multiplicity)
    content |= {"version": 2, "configuration": None, "infinity": None, "self_motion": None}
    content |= {"complex_solutions": weight * len(poses), "distinct_solutions": len(poses)}
    return {key: content[key] for key in KEYS}


def _separating(points: Sequence[tuple[Numbers, Numbers]], parameters: Sequence[Fraction]) -> list[int]:
    """The form that is the parameter; there is one pose, with the parameter 0, or they differ in one coordinate."""
    if len(points) == 1:
        return [0] * 8
    for k in range(8):
        values = [(*e, *f)[k] for e, f in points]
        if values == parameters:
            return [int(k == j) for j in range(8)]
    raise AssertionError("no coordinate is the parameter")


def moving(content: Content, cause: str, *, real: bool = True) -> Content:
    """The same poses as witnesses of a motion."""
    counts = dict.fromkeys(("complex_solutions", "distinct_solutions", "real_poses", "box_exponent"), 0)
    motion_entry = {"cause": cause, "real": real, "forms": [], "slices": []}
    return content | counts | {"poses": [], "claim": "positive-dimensional-proved", "self_motion": motion_entry}


# Every type of constraint

PLACED = Pose((2, 1, -1, 3), (3, 2, 5, -1), (1, 2, 3))
"""A pose of any kind."""
