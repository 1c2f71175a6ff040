"""The conditions of a region certificate as polynomials (``docs/certificates-regions.md``), from robot and chart."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace
from fractions import Fraction
from typing import Any

from pkm_exact.certify.checker.region_document import SQUARED_COSINES, Cone, LegEntry, RegionDocument
from pkm_exact.certify.checker.region_pairs import legs_apart
from pkm_exact.certify.checker.region_parameters import RODS, scale_of, varied_joints
from pkm_exact.certify.checker.region_regular import Regular, own_length_row, regular_of
from pkm_exact.certify.checker.region_ring import Condition, Conditions, PlacedLeg, RegionRing, Signed
from pkm_exact.certify.checker.verdict import malformed, rejected


class RegionEquations:
    """The polynomials of a certificate."""

    def __init__(self, document: RegionDocument) -> None:
        self._document, self._ring = document, RegionRing(document)
        self.norm, self.rotation = self._pose()
        ring = self._ring
        self.center = [ring.times(self.norm, ring.entry(value)) for value in document.place]
        if document.path is not None:
            self._move_along(document.path)

    def conditions(self) -> Conditions:
        """All of them.

        Raises
        ------
        Refusal
            If a form of the robot does not vanish all over the chart, or working modes are asked for and not named.
        """
        document, ring = self._document, self._ring
        if any(not self._form_value(form).is_zero() for form in document.forms):
            raise rejected("chart: its poses are not all among those that the joints of the robot allow")
        legs = [self._leg(leg, k) for k, leg in enumerate(document.legs)]
        parts: list[Condition] = [Signed(leg.root, "0+") for leg in legs if leg.root is not None]
        if "limits" in document.conditions:
            for entry, leg in zip(document.legs, legs, strict=True):
                parts += self._reach(entry, leg)
            for cones, side in ((document.base_cones, "base"), (document.platform_cones, "platform")):
                parts += [self._cone(cone, leg, side) for cone, leg in zip(cones, legs, strict=False)]
            for c, (low, high) in zip(self.center, document.position, strict=False):
                parts += [
                    Signed(c - ring.number(low) * self.norm, "0+"),
                    Signed(ring.number(high) * self.norm - c, "0+"),
                ]
            parts += legs_apart(document, ring, self.norm, legs)
        if "no_type_1" in document.conditions:
            parts += [Signed(leg.value[0] if leg.root is None else leg.root, "+") for leg in legs]
        determinant = None
        if "no_type_2" in document.conditions:
            if document.by_matrix:
                determinant = self._matrix(legs)
                parts.append(determinant)
            else:
                determinant = self._determinant(legs)
                parts.append(Signed(determinant, "/"))
        shape = tuple(Signed(self._shape(part), "0+") for part in document.shape)
        region: list[Condition] = [*shape, *self._tube()]
        for entry, leg, pair in zip(document.legs, legs, document.joints, strict=False):
            region += [] if leg.root is None else [Signed(leg.root, "0+")]
            region += self._reach(replace(entry, reach=pair), leg)
        roots = tuple(x.root for x in legs if x.root is not None)
        return Conditions(("and", parts), ("and", region), shape, roots, determinant)

    def _move_along(self, path: Sequence[Sequence[Fraction]]) -> None:
        """Positions on a curve: all times its denominator."""
        ring = self._ring
        weight, *places = (ring.powers("along", coefficients) for coefficients in path)
        self.center = [ring.times(self.norm, place) for place in places]
        self.norm = ring.times(self.norm, weight)
        self.rotation = [[ring.times(weight, entry) for entry in row] for row in self.rotation]

    def _tube(self) -> list[Condition]:
        """That the position is near a corner, or near the piece between two."""
        tube, ring, n = self._document.tube, self._ring, self.norm
        if tube is None:
            return []
        offsets = [
            [c - n * ring.number(x) for c, x in zip(self.center, corner, strict=True)] for corner in tube.corners
        ]
        near = [ring.number(tube.radius**2) * ring.times(n, n) - ring.dot(o, o) for o in offsets]
        found: list[Condition] = [Signed(ball, "0+") for ball in near]
        for a, b, o, ball in zip(tube.corners, tube.corners[1:], offsets, near, strict=False):
            way = [y - x for x, y in zip(a, b, strict=True)]
            length = ring.number(sum(g * x * x for g, x in zip(self._document.metric, way, strict=True)))
            along = ring.dot([ring.number(x) for x in way], o)
            inside = (along, length * n - along, ball * length + ring.times(along, along))
            found.append(("and", [Signed(part, "0+") for part in inside]))
        return [("or", found)]

    def _pose(self) -> tuple[Any, list[list[Any]]]:
        document, ring = self._document, self._ring
        if document.quaternion is not None:
            return ring.number(1), _rotation_of(document.quaternion, document.metric, ring)
        norm, rotation = ring.number(1), None
        for axis, turn in enumerate(document.turns):
            c, s = (ring.number(1), ring.entry(turn[0])) if len(turn) == 1 else map(ring.entry, turn)
            i, j = (axis + 1) % 3, (axis + 2) % 3
            tail = document.metric[i] * document.metric[j] * s * s
            matrix = [[ring.number(0)] * 3 for _ in range(3)]
            matrix[axis][axis], matrix[i][i], matrix[j][j] = c * c + tail, c * c - tail, c * c - tail
            matrix[i][j], matrix[j][i] = -2 * document.metric[j] * c * s, 2 * document.metric[i] * c * s
            norm = ring.times(norm, c * c + tail)
            rotation = matrix if rotation is None else self._matrix_product(matrix, rotation)
        return norm, rotation or []

    def _matrix_product(self, left: Any, right: Any) -> list[list[Any]]:
        times = self._ring.times
        return [
            [
                times(left[i][0], right[0][j]) + times(left[i][1], right[1][j]) + times(left[i][2], right[2][j])
                for j in range(3)
            ]
            for i in range(3)
        ]

    def _turned(self, vector: Sequence[Fraction | str]) -> list[Any]:
        ring = self._ring
        exact = [ring.entry(b) for b in vector]
        return [
            sum((ring.times(entry, b) for entry, b in zip(row, exact, strict=True)), ring.number(0))
            for row in self.rotation
        ]

    def _joints(self, k: int) -> tuple[list[Any], list[Any]]:
        """N A and N R B of a leg."""
        base, platform = varied_joints(self._document, k)
        found = []
        for side, entries in (
            ("base", [self._ring.times(self.norm, self._ring.entry(x)) for x in base]),
            ("platform", self._turned(platform)),
        ):
            scale = scale_of(self._document, side)
            found.append(entries if scale is None else [self._ring.times(self._ring.named[scale], x) for x in entries])
        return found[0], found[1]

    def _rod_squared(self, leg: LegEntry) -> Any:
        """N^2 r^2."""
        ring, keys = self._ring, self._document.parameters
        r = ring.named[f"p{keys.index(RODS) + 1}"] if RODS in keys else None
        square = ring.number(leg.rod_squared) if r is None else r * r
        return ring.times(square, ring.times(self.norm, self.norm))

    def _leg(self, leg: LegEntry, k: int) -> PlacedLeg:
        ring, n = self._ring, self.norm
        base, arm = self._joints(k)
        e = [c + b - a for c, b, a in zip(self.center, arm, base, strict=True)]
        if leg.axis is not None:
            axis = [ring.number(x) for x in leg.axis]
            along = sum((g * x * x for g, x in zip(self._document.metric, leg.axis, strict=True)), Fraction(0))
            share = ring.times(ring.number(1 / along), ring.dot(axis, e))
            e = [x - ring.times(a, share) for a, x in zip(axis, e, strict=True)]
        square = ring.dot(e, e)
        if not leg.axes:
            return PlacedLeg(arm, e, square, (square, ring.times(n, n)), None, "")
        mode, y = self._document.modes[k], ring.named[f"y{k}"]
        self._require_mode(leg, mode)
        rod_squared = self._rod_squared(leg)
        axes = [[ring.number(x) for x in axis] for axis in leg.axes]
        if len(axes) == 1:
            a, p = ring.dot(axes[0], axes[0]), ring.dot(axes[0], e)
            way = p + mode * y
            rod = [ring.times(a, x) - ring.times(way, d) for x, d in zip(e, axes[0], strict=True)]
            root = ring.times(p, p) - ring.times(a, square - rod_squared)
            return PlacedLeg(arm, rod, rod_squared, (way, ring.times(a, n)), root, f"y{k}")
        share = ring.number(Fraction(1, leg.weight))
        a, p = (2 * ring.times(n, ring.dot(axis, e)) for axis in axes)
        h = square + ring.times(ring.dot(axes[0], axes[0]), ring.times(n, n)) - rod_squared
        m = ring.times(a, a) + share * ring.times(p, p)
        cosine = ring.times(a, h) - mode * ring.times(p, y)
        sine = share * ring.times(p, h) + mode * ring.times(a, y)
        rod = [
            ring.times(m, x) - ring.times(n, ring.times(cosine, u) + ring.times(sine, v))
            for x, u, v in zip(e, *axes, strict=True)
        ]
        return PlacedLeg(arm, rod, rod_squared, (cosine, sine), share * (m - ring.times(h, h)), f"y{k}", m)

    def _require_mode(self, leg: LegEntry, mode: int) -> None:
        asked = self._document.conditions
        cones = self._document.base_cones or self._document.platform_cones
        if not mode and ("no_type_2" in asked or ("limits" in asked and (leg.reach is not None or cones))):
            raise malformed("modes: a working mode is needed and not named")

    def _reach(self, entry: LegEntry, leg: PlacedLeg) -> list[Condition]:
        if entry.reach is None:
            return []
        low, high = entry.reach
        if len(entry.axes) == 2:
            return [self._crank_range(leg, low, high)]
        if not entry.axes:
            low, high = low * low, high * high
        value, unit = leg.value
        return [
            Signed(value - self._ring.number(low) * unit, "0+"),
            Signed(self._ring.number(high) * unit - value, "0+"),
        ]

    def _crank_range(self, leg: PlacedLeg, low: Fraction, high: Fraction) -> Condition:
        if high - low >= 360:
            return ("and", [])
        cosine, sine = leg.value
        (c1, s1), (c2, s2) = _right_angle(low), _right_angle(high)
        parts = [Signed(c1 * sine - s1 * cosine, "0+"), Signed(s2 * cosine - c2 * sine, "0+")]
        if low == high:
            parts.append(Signed(c1 * cosine + s1 * sine, "0+"))
        return ("or" if high - low > 180 else "and", parts)

    def _cone(self, cone: Cone, leg: PlacedLeg, side: str) -> Condition:
        ring = self._ring
        axis = [ring.number(x) for x in cone.axis] if side == "base" else self._turned(cone.axis)
        along = ring.dot(axis, leg.rod) if side == "base" else -ring.dot(axis, leg.rod)
        size = ring.times(ring.dot(axis, axis), ring.reduced(ring.dot(leg.rod, leg.rod), leg))
        if size.is_zero():
            raise rejected("cones: a leg has no direction all over the chart")
        difference = ring.reduced(ring.times(along, along), leg) - ring.number(SQUARED_COSINES[cone.degrees]) * size
        if cone.degrees <= 90:
            return ("and", [Signed(along, "0+"), Signed(difference, "0+")])
        return ("or", [Signed(along, "0+"), Signed(-difference, "0+")])

    def _form_value(self, form: Sequence[Fraction]) -> Any:
        """N^2 times the value of a form."""
        ring, n, c, r = self._ring, self.norm, self.center, self.rotation
        total = ring.number(form[0]) * ring.dot(c, c) + ring.number(form[16]) * ring.times(n, n)
        for i in range(3):
            weighted = (Fraction(g, self._document.metric[i]) for g in self._document.metric)
            u = sum((ring.number(w) * ring.times(r[k][i], c[k]) for k, w in enumerate(weighted)), ring.number(0))
            total += ring.number(form[1 + i]) * u + ring.number(form[4 + i]) * ring.times(n, c[i])
            for j in range(3):
                total += ring.number(form[7 + 3 * i + j]) * ring.times(n, r[i][j])
        return total

    def _wrench(self, form: Sequence[Fraction]) -> list[Any]:
        """N^2 times the wrench of a form in rational coordinates."""
        ring, n, c, r, g = self._ring, self.norm, self.center, self.rotation, self._document.metric
        moved = [
            sum((r[i][j] * ring.number(g[i] * form[1 + j] / g[j]) for j in range(3)), ring.number(0)) for i in range(3)
        ]
        force = [
            ring.times(n, ring.number(2 * g[i] * form[0]) * c[i] + moved[i] + ring.number(form[4 + i]) * n)
            for i in range(3)
        ]
        moment = []
        for i in range(3):
            j, k = (i + 1) % 3, (i + 2) % 3
            total = g[k] * ring.times(moved[j], c[k]) - g[j] * ring.times(moved[k], c[j])
            for column in range(3):
                total += ring.times(n, r[j][column]) * ring.number(g[j] * form[7 + 3 * k + column])
                total -= ring.times(n, r[k][column]) * ring.number(g[k] * form[7 + 3 * j + column])
            moment.append(total)
        return [*force, *moment]

    def _matrix(self, legs: Sequence[PlacedLeg]) -> Regular:
        """The rows of the determinant, those of legs of own length without a factor N."""
        document, ring = self._document, self._ring
        rows, names = self._rows(legs), [leg.name for leg in legs]
        for k, (entry, leg) in enumerate(zip(document.legs, legs, strict=True)):
            if not entry.axes:
                row = own_length_row(ring, leg.arm, leg.rod, entry.base, document.place)
                rows[k] = [row[j] for j in document.twist]
        return regular_of(ring, rows, [*names, *("" for _ in rows[len(names) :])])

    def _determinant(self, legs: Sequence[PlacedLeg]) -> Any:
        return self._expanded(self._rows(legs))

    def _rows(self, legs: Sequence[PlacedLeg]) -> list[list[Any]]:
        """Of legs and forms, on the freedoms."""
        ring, g, twist = self._ring, self._document.metric, self._document.twist
        rows = []
        for leg in legs:
            b, k = leg.arm, leg.rod
            moment = [
                g[(i + 1) % 3]
                * g[(i + 2) % 3]
                * (ring.times(b[(i + 1) % 3], k[(i + 2) % 3]) - ring.times(b[(i + 2) % 3], k[(i + 1) % 3]))
                for i in range(3)
            ]
            rows.append([*(g[i] * ring.times(self.norm, k[i]) for i in range(3)), *moment])
        rows += [self._wrench(form) for form in self._document.forms]
        if len(rows) != len(twist):
            raise malformed("conditions: as many equations as freedoms are needed for no_type_2")
        return [[row[j] for j in twist] for row in rows]

    def _expanded(self, rows: list[list[Any]]) -> Any:
        """The determinant, along the first column again and again, minors remembered."""
        ring, size = self._ring, len(rows)
        known: dict[tuple[int, ...], Any] = {(): ring.number(1)}
        for left in range(1, size + 1):
            column = size - left
            found = {}
            for chosen in _subsets(size, left):
                total = ring.number(0)
                for place, row in enumerate(chosen):
                    rest = chosen[:place] + chosen[place + 1 :]
                    if not rows[row][column].is_zero():
                        term = ring.times(rows[row][column], known[rest])
                        total = total - term if place % 2 else total + term
                found[chosen] = total
            known = found
        return known[tuple(range(size))]

    def _shape(self, part: Any) -> Any:
        ring, n = self._ring, self.norm
        total = ring.number(part.constant) * ring.times(n, n)
        for c, slope, weight in zip(self.center, part.linear, part.weights, strict=True):
            total += ring.number(slope) * ring.times(n, c) - ring.number(weight) * ring.times(c, c)
        return total


def _subsets(size: int, count: int) -> list[tuple[int, ...]]:
    if not count:
        return [()]
    return [(*rest, last) for last in range(count - 1, size) for rest in _subsets(last, count - 1)]


def _right_angle(degrees: Fraction) -> tuple[int, int]:
    return ((1, 0), (0, 1), (-1, 0), (0, -1))[int(degrees // 90) % 4]


def _rotation_of(e: Sequence[Fraction], g: Sequence[int], ring: RegionRing) -> list[list[Any]]:
    """The rotation matrix of a quaternion in the metric."""
    head = g[0] * g[1] * g[2] * e[0] ** 2
    squares = [g[k] * e[1 + k] ** 2 for k in range(3)]
    norm = head + sum(squares)
    found = [[ring.number(0)] * 3 for _ in range(3)]
    for i in range(3):
        j, k = (i + 1) % 3, (i + 2) % 3
        found[i][i] = ring.number((head + squares[i] - squares[j] - squares[k]) / norm)
        mixed, turn = e[1 + i] * e[1 + j], g[k] * e[0] * e[1 + k]
        found[i][j] = ring.number(2 * g[j] * (mixed - turn) / norm)
        found[j][i] = ring.number(2 * g[i] * (mixed + turn) / norm)
    return found
