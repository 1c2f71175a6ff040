"""Region certificates made by hand, and a reference for them: what holds at a pose, by geometry and in doubles.

The reference knows no polynomials. It places each leg at one pose, as ``docs/regions.md`` defines it, and looks.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from copy import deepcopy
from fractions import Fraction
from math import acos, atan2, degrees, floor, sqrt
from random import Random
from typing import Any

Content = dict[str, Any]
Numbers = Sequence[Any]

NAMES = ("x", "y", "z", "roll", "pitch", "yaw")
FREEDOMS = {
    "spatial": (0, 1, 2, 3, 4, 5),
    "planar": (0, 1, 5),
    "schoenflies": (0, 1, 2, 5),
    "translation": (0, 1, 2),
    "spherical": (3, 4, 5),
}


def texts(values: Any) -> Any:
    """Numbers as certificates spell them, in lists; nothing as nothing."""
    if values is None:
        return None
    return [texts(value) for value in values] if isinstance(values, list | tuple) else _text(values)


def _text(value: Any) -> str:
    return value if isinstance(value, str) else str(Fraction(value))


def leg(base: Numbers, platform: Numbers, reach: Any = None, **actuator: Any) -> Content:
    """A leg; ``direction`` and ``rod`` for a slide, ``u``, ``v``, ``weight`` and ``rod`` for a crank."""
    if "direction" in actuator:
        moved = {"type": "slide", "direction": texts(actuator["direction"]), "rod_squared": _text(actuator["rod"])}
    elif "u" in actuator:
        moved = {"type": "crank", "at_0": texts(actuator["u"]), "at_90": texts(actuator["v"])}
        moved |= {"weight": _text(actuator.get("weight", 1)), "rod_squared": _text(actuator["rod"])}
    else:
        moved = {"type": "length"}
    joints = {"name": "a leg", "base": texts(base), "platform": texts(platform)}
    return joints | {"actuator": moved, "reach": None if reach is None else texts(reach)}


def cone(axis: Numbers, angle: int) -> Content:
    return {"axis": texts(axis), "degrees": str(angle)}


ALONG = leg((0, 0, 0), (0, 0, 0), (3, 4))


def region(legs: Sequence[Content] = (ALONG,), **entries: Any) -> Content:
    """A certificate; by default of a leg that is as long as x says, from 3 to 4."""
    position = entries.pop("place", ["x", 0, 0])
    turns = entries.pop("turns", [])
    chart = {
        "variables": entries.pop("variables", ["x"]),
        "box": texts(entries.pop("box", [[3, 4]])),
        "position": texts(position),
        "quaternion": texts(entries.pop("quaternion", None if turns else [1, 0, 0, 0])) if not turns else None,
        "turns": texts(turns),
    }
    robot = {"name": "made up", "unit": "m", "source": "made up"}
    robot |= {"motion": entries.pop("motion", "spatial"), "metric": texts(entries.pop("metric", [1, 1, 1]))}
    robot |= {"legs": deepcopy(list(legs)), "forms": texts(entries.pop("forms", []))}
    robot |= {key: entries.pop(key, []) for key in ("base_cones", "platform_cones")}
    robot["position"] = texts(entries.pop("position", []))
    paving = entries.pop("paving", "i")
    content = {
        "format": "pkm_exact region certificate",
        "version": 1,
        "robot": robot,
        "chart": chart,
        "shape": [],
        "conditions": ["limits"],
        "modes": [0] * len(legs),
        "claim": "all",
        "axes": [0],
        "paving": paving,
        "inside": paving.count("i"),
        "undecided": paving.count("u"),
        "measure": None,
        "counterexample": [],
    }
    if "points" in entries:
        entries["counterexample"] = texts(entries.pop("points"))
        content |= {"claim": "not-all", "paving": "", "inside": 0}
    return content | entries


def part(constant: Any, linear: Numbers = (0, 0, 0), weights: Numbers = (0, 0, 0)) -> Content:
    """A part of a shape."""
    return {"constant": _text(constant), "linear": texts(linear), "weights": texts(weights)}


# The reference


def exact(values: Any) -> Any:
    """The numbers of lists of texts."""
    return [exact(value) for value in values] if isinstance(values, list) else Fraction(values)


class Placed:
    """A robot of a certificate at one pose: C, R and, for each leg, its rod from K to C + R B, in doubles."""

    def __init__(self, content: Content, point: Sequence[Fraction]) -> None:
        self.content, self.robot = content, content["robot"]
        chart = content["chart"]
        values = dict(zip(chart["variables"], point, strict=True))
        self.g = [int(x) for x in self.robot["metric"]]
        self.place = [float(values[x] if x in values else Fraction(x)) for x in chart["position"]]
        if chart.get("path"):
            w, *place = (
                sum(float(x) * float(values["along"]) ** k for k, x in enumerate(exact(row))) for row in chart["path"]
            )
            self.place = [x / w for x in place]
        self.rotation = self._rotation(chart, values)
        self.reached = True
        self.arms, self.rods, self.values = [], [], []
        for entry, mode in zip(self.robot["legs"], content["modes"], strict=False):
            self._place(entry, mode or 1)

    def dot(self, u: Numbers, v: Numbers) -> float:
        return sum(w * float(a) * float(b) for w, a, b in zip(self.g, u, v, strict=True))

    def _rotation(self, chart: Content, values: dict[str, Fraction]) -> list[list[float]]:
        g = self.g
        if chart["quaternion"] is not None:
            e0, *e = (float(Fraction(x)) for x in chart["quaternion"])
            return _of_quaternion(e0, e, g)
        found = [[float(i == j) for j in range(3)] for i in range(3)]
        for axis, turn in enumerate(chart["turns"]):
            c, s = (1.0, float(values[turn[0]])) if len(turn) == 1 else (float(Fraction(x)) for x in turn)
            e = [0.0, 0.0, 0.0]
            i, j = (axis + 1) % 3, (axis + 2) % 3
            e[axis] = s
            # Scaled so that e0^2 g1 g2 g3 + g_k e_k^2 is a multiple of c^2 + g_i g_j s^2.
            found = _product(_of_quaternion(c / (g[i] * g[j]), e, g), found)
        return found

    def _place(self, entry: Content, mode: int) -> None:
        a, b = ([float(Fraction(x)) for x in entry[key]] for key in ("base", "platform"))
        arm = [sum(r * x for r, x in zip(row, b, strict=True)) for row in self.rotation]
        e = [c + x - y for c, x, y in zip(self.place, arm, a, strict=True)]
        actuator = entry["actuator"]
        self.arms.append(arm)
        if entry.get("axis"):
            axis = [float(Fraction(x)) for x in entry["axis"]]
            share = self.dot(axis, e) / self.dot(axis, axis)
            e = [x - share * y for x, y in zip(e, axis, strict=True)]
        if actuator["type"] == "length":
            self.rods.append(e)
            self.values.append(sqrt(self.dot(e, e)))
            return
        rod = float(Fraction(actuator["rod_squared"]))
        if actuator["type"] == "slide":
            d = [float(Fraction(x)) for x in actuator["direction"]]
            size, along = self.dot(d, d), self.dot(d, e)
            square = along * along - size * (self.dot(e, e) - rod)
            value = (along + mode * sqrt(max(square, 0))) / size
            end = [value * x for x in d]
        else:
            u, v = ([float(Fraction(x)) for x in actuator[key]] for key in ("at_0", "at_90"))
            w = float(Fraction(actuator["weight"]))
            p, q = 2 * self.dot(u, e), 2 * self.dot(v, e) / sqrt(w)
            h = self.dot(e, e) + self.dot(u, u) - rod
            square = p * p + q * q - h * h
            # p cos + q sin = h
            turn = mode * sqrt(max(square, 0))
            value = atan2(q * h + p * turn, p * h - q * turn)
            cosine, sine = (p * h - q * turn) / (p * p + q * q), (q * h + p * turn) / (p * p + q * q)
            end = [cosine * x + sine * y / sqrt(w) for x, y in zip(u, v, strict=True)]
            value = degrees(value)
        self.reached &= square > 0
        self.rods.append([x - k for x, k in zip(e, end, strict=True)])
        self.values.append(value)
        assert square <= 0 or abs(self.dot(self.rods[-1], self.rods[-1]) - rod) < 1e-9 * (1 + rod)

    def margins(self) -> Iterator[float]:
        """Numbers that are positive where a limit holds and negative where it does not."""
        for entry, value in zip(self.robot["legs"], self.values, strict=True):
            if entry["reach"] is not None:
                low, high = (float(Fraction(x)) for x in entry["reach"])
                if entry["actuator"]["type"] != "crank":
                    yield min(value - low, high - value)
                elif high - low < 360:
                    turned = low + (value - low - 360 * floor((value - low) / 360))
                    yield high - turned if turned < high else -min(turned - high, low + 360 - turned)
        for key, sign in (("base_cones", 1), ("platform_cones", -1)):
            for entry, rod in zip(self.robot[key], self.rods, strict=False):
                axis = [float(Fraction(x)) for x in entry["axis"]]
                if sign < 0:
                    axis = [sum(r * x for r, x in zip(row, axis, strict=True)) for row in self.rotation]
                cosine = sign * self.dot(axis, rod) / sqrt(self.dot(axis, axis) * self.dot(rod, rod))
                yield int(entry["degrees"]) - degrees(acos(max(-1, min(1, cosine))))
        for c, (low, high) in zip(self.place, self.robot["position"], strict=False):
            yield min(c - float(Fraction(low)), float(Fraction(high)) - c)

    def distance(self, one: int, other: int) -> tuple[float, tuple[float, float], list[float]]:
        """Of two legs: how far apart they are, how far down from their upper ends, and the way between, to the other.

        In doubles, by going from each leg to the nearest point of the other again and again.
        """
        ends = [
            (
                [
                    x * sqrt(g)
                    for x, g in zip(map(sum, zip(self.place, self.arms[k], strict=True)), self.g, strict=True)
                ],
                [-x * sqrt(g) for x, g in zip(self.rods[k], self.g, strict=True)],
            )
            for k in (one, other)
        ]
        (p, u), (q, v) = ends
        s = t = 0.5
        for _ in range(20000):
            there = [a + s * b for a, b in zip(p, u, strict=True)]
            t_ = _foot(there, q, v)
            s_ = _foot([a + t_ * b for a, b in zip(q, v, strict=True)], p, u)
            if abs(s_ - s) + abs(t_ - t) < 1e-15:
                break
            s, t = s_, t_
        way = [c + t * d - a - s * b for a, b, c, d in zip(p, u, q, v, strict=True)]
        return sqrt(sum(x * x for x in way)), (s, t), [x * sqrt(g) for x, g in zip(way, self.g, strict=True)]

    def determinant(self) -> float:
        """Of unit rods and of the derivatives of forms, on the freedoms."""
        rows = [self._row(arm, rod) for arm, rod in zip(self.arms, self.rods, strict=True)]
        rows += [self._slope(exact(form)) for form in self.robot["forms"]]
        kept = FREEDOMS[self.robot["motion"]]
        return _determinant([[row[k] for k in kept] for row in rows])

    def _row(self, arm: Numbers, rod: Numbers) -> list[float]:
        size = sqrt(self.dot(rod, rod))
        moves = [[float(i == j) for j in range(3)] for i in range(3)] + [self.turned(k, arm) for k in range(3)]
        return [self.dot(move, rod) / size for move in moves]

    def turned(self, k: int, vector: Numbers) -> list[float]:
        """The velocity of a vector that turns about axis k, in rational coordinates."""
        i, j = (k + 1) % 3, (k + 2) % 3
        found = [0.0, 0.0, 0.0]
        found[i], found[j] = -self.g[j] * vector[j], self.g[i] * vector[i]
        return found

    def _slope(self, form: Numbers) -> list[float]:
        found = []
        for k in range(6):
            ends = []
            for step in (1, -1):
                place, columns = self.place, list(zip(*self.rotation, strict=True))
                if k < 3:
                    place = [c + step * (i == k) for i, c in enumerate(place)]
                else:
                    columns = [
                        tuple(x + step * y for x, y in zip(column, self.turned(k - 3, column), strict=True))
                        for column in columns
                    ]
                ends.append(form_at(form, place, columns, self.g))
            found.append((ends[0] - ends[1]) / 2)
        return found


def _foot(place: Sequence[float], start: Sequence[float], way: Sequence[float]) -> float:
    """How far along a segment the point nearest to a place is."""
    share = sum((a - b) * c for a, b, c in zip(place, start, way, strict=True)) / sum(c * c for c in way)
    return min(1.0, max(0.0, share))


def second(content: Content, **entries: Any) -> Content:
    """A certificate of version 1 as one of version 2, the other entries changed; ``path`` and ``leg_distance`` too."""
    chart, robot = dict(content["chart"]), deepcopy(content["robot"])
    path, least = entries.pop("path", None), entries.pop("leg_distance", None)
    parameters: dict[str, Numbers] = entries.pop("parameters", {})
    axes = entries.pop("leg_axes", [None] * len(robot["legs"]))
    for entry, axis in zip(robot["legs"], axes, strict=True):
        entry["axis"] = texts(axis)
    robot["leg_distance"] = None if least is None else _text(least)
    found: Content = {}
    for key, value in content.items():
        if key == "counterexample":
            found["member"] = []
        found[key] = value
        if key == "shape":
            found |= {"tube": None, "joints": [], "directions": []}
    ordered: Content = {}
    for key, value in chart.items():
        ordered[key] = value
        if key == "position":
            ordered["path"] = texts(path) if path is not None else None
    ordered["variables"] = [*ordered["variables"], *(f"p{k}" for k in range(1, len(parameters) + 1))]
    ordered["box"] = [*ordered["box"], *texts(list(parameters.values()))]
    ordered["parameters"] = list(parameters)
    found |= {"version": 2, "robot": robot, "chart": ordered}
    found["claim"] = "designs" if parameters else found["claim"]
    if found["claim"] in ("all", "designs"):
        found["member"] = texts([(Fraction(low) + Fraction(high)) / 2 for low, high in ordered["box"]])
    return found | {key: texts(value) if key in ("joints", "member") else value for key, value in entries.items()}


def form_at(form: Numbers, c: Numbers, columns: Sequence[Numbers], g: Sequence[int]) -> Any:
    """The value of a form at a pose, R by its columns."""
    total = form[0] * sum(w * x * x for w, x in zip(g, c, strict=True)) + form[16]
    for i in range(3):
        total += form[1 + i] * sum(w * r * x for w, r, x in zip(g, columns[i], c, strict=True)) / g[i]
        total += form[4 + i] * c[i]
        for j in range(3):
            total += form[7 + 3 * i + j] * columns[j][i]
    return total


def _of_quaternion(e0: float, e: Sequence[float], g: Sequence[int]) -> list[list[float]]:
    """By the turn of ordinary coordinates x_i sqrt(g_i) about (e_i / sqrt(g_j g_k)) with the scalar e0."""
    roots = [sqrt(x) for x in g]
    q = [e0, *(x / (roots[(k + 1) % 3] * roots[(k + 2) % 3]) for k, x in enumerate(e))]
    size = sqrt(sum(x * x for x in q))
    w, x, y, z = (part / size for part in q)
    turn = [
        [1 - 2 * (y * y + z * z), 2 * (x * y - w * z), 2 * (x * z + w * y)],
        [2 * (x * y + w * z), 1 - 2 * (x * x + z * z), 2 * (y * z - w * x)],
        [2 * (x * z - w * y), 2 * (y * z + w * x), 1 - 2 * (x * x + y * y)],
    ]
    return [[turn[i][j] * roots[j] / roots[i] for j in range(3)] for i in range(3)]


def _product(left: Sequence[Numbers], right: Sequence[Numbers]) -> list[list[float]]:
    return [[sum(left[i][k] * right[k][j] for k in range(3)) for j in range(3)] for i in range(3)]


def _determinant(rows: list[list[float]]) -> float:
    left, found = [list(row) for row in rows], 1.0
    for column in range(len(left)):
        place = max(range(column, len(left)), key=lambda r, column=column: abs(left[r][column]))
        if not left[place][column]:
            return 0.0
        if place != column:
            left[column], left[place], found = left[place], left[column], -found
        found *= left[column][column]
        for r in range(column + 1, len(left)):
            factor = left[r][column] / left[column][column]
            left[r] = [x - factor * y for x, y in zip(left[r], left[column], strict=True)]
    return found


# Random robots


ANGLES = (30, 45, 60, 90, 120, 135, 150, 180)
CIRCLES = (
    ((1, 2, 2), (2, 1, -2), 1),
    ((2, -2, 1), (4, 2, -4), 4),
    ((0, 3, 0), (0, 0, -3), 1),
    ((-1, 0, 0), (0, 0, 2), 4),
)
"""Axes at 0 and 90 degrees and the weight, in the metric (1, 1, 1)."""
STEP = Fraction(1, 1 << 14)


def vector(random: Random, size: int = 5) -> list[Fraction]:
    return [Fraction(random.randint(-4 * size, 4 * size), random.randint(2, 5)) for _ in range(3)]


def turn(random: Random) -> list[Any]:
    return [random.randint(1, 5), Fraction(random.randint(-4, 4), random.randint(2, 5))]


CHARTS = ("quaternion x", "turns y", "roll z", "pitch x", "yaw y")


def chart_of(kind: str, motion: str, random: Random) -> Content:
    """A chart of one or two variables, with a small box about random values."""
    word, name = kind.split()
    place: list[Any] = vector(random)
    place[NAMES.index(name)] = name
    if motion in ("planar", "spherical"):
        place = [*place[:2], 0] if motion == "planar" else [0, 0, 0]
    still = [random.choice([1, -2]), 0]
    turns: list[Any] = [turn(random) for _ in range(3)] if motion in ("spatial", "spherical") else [still] * 3
    if motion in ("planar", "schoenflies"):
        turns = [still, still, turn(random)]
    if word in NAMES and motion != "translation":
        turns[NAMES.index(word) - 3] = [word]
    variables = [x for x in NAMES if x in place or [x] in turns]
    box = []
    for _ in variables:
        low = Fraction(random.randint(-20, 20), 7)
        box.append([low, low + STEP])
    found: Content = {"variables": variables, "box": box, "place": place, "motion": motion}
    if word == "quaternion":
        free = (1, 2, 3) if motion in ("spatial", "spherical") else () if motion == "translation" else (3,)
        return found | {"quaternion": [3, *(random.randint(-5, 5) if k in free else 0 for k in (1, 2, 3))]}
    return found | {"turns": turns}


def point_of(content: Content) -> list[Fraction]:
    """A point of the box."""
    return [(Fraction(low) * 2 + Fraction(high)) / 3 for low, high in content["chart"]["box"]]


def random_legs(types: str, content: Content, random: Random) -> None:
    """Add legs of own length, slides and cranks (letters l, s, c) that reach the pose at the point."""
    point = point_of(content)
    content["robot"]["legs"], content["modes"] = [], []
    for letter in types:
        content["robot"]["legs"].append(leg(vector(random), vector(random)))
        content["modes"].append(0)
        rod = Placed(content, point).rods[-1]
        entry = content["robot"]["legs"].pop()
        if letter == "s":
            axis = vector(random)
            near = [x - Fraction(random.randint(-3, 3), 2) * a for x, a in zip(rod, axis, strict=True)]
            size = Fraction(Placed(content, point).dot(near, near)).limit_denominator(50) + 1
            entry = leg(entry["base"], entry["platform"], direction=axis, rod=size)
        if letter == "c":
            u, v, w = random.choice(CIRCLES)
            c, s = random.choice([(3, 4), (-4, 3), (5, -12), (-12, -5), (-3, 4)])
            size = abs(complex(c, s))
            near = [x - (c * a + s * b / sqrt(w)) / size for x, a, b in zip(rod, u, v, strict=True)]
            square = Fraction(Placed(content, point).dot(near, near)).limit_denominator(50)
            entry = leg(entry["base"], entry["platform"], u=u, v=v, weight=w, rod=square)
        content["robot"]["legs"].append(entry)
        content["modes"][-1] = 0 if letter == "l" else random.choice([1, -1])


Limit = tuple[list[Any], Any]
"""A place in the robot, and what stands there."""


def limits_of(content: Content, random: Random) -> tuple[list[Limit], list[Limit]]:
    """Limits that hold at the point, with room, and such that do not, each alone."""
    placed = Placed(content, point_of(content))
    pairs = [_reaches(placed, random), _cones(placed, random), _positions(placed)]
    return [limit for good, _ in pairs for limit in good], [limit for _, bad in pairs for limit in bad]


def _reaches(placed: Placed, random: Random) -> tuple[list[Limit], list[Limit]]:
    good: list[Limit] = []
    bad: list[Limit] = []
    for k, (entry, value) in enumerate(zip(placed.robot["legs"], placed.values, strict=True)):
        where = ["legs", k, "reach"]
        if entry["actuator"]["type"] == "crank":
            start, wide = 90 * floor(value / 90), random.choice([90, 180, 270])
            if entry["actuator"]["weight"] != "1" or not 2 < value - start < 88:
                continue
            start += 360 * random.randint(-1, 1)
            low = start - 90 * random.randrange(wide // 90)
            good.append((where, texts([low, low + wide])))
            bad.append((where, texts([start + 90, start + 360 - 90 * random.randrange(3)])))
            continue
        about = Fraction(value).limit_denominator(1000)
        good.append((where, texts([max(about - 1, 0) if value > 0 else about - 1, about + 1])))
        bad.append((where, texts([about + Fraction(1, 50), about + 2])))
        if value > 0.1:
            bad.append((where, texts([0, about - Fraction(1, 50)])))
    return good, bad


def _cones(placed: Placed, random: Random) -> tuple[list[Limit], list[Limit]]:
    good: list[Limit] = []
    bad: list[Limit] = []
    for key, sign in (("base_cones", 1), ("platform_cones", -1)):
        cones = []
        for rod in placed.rods:
            axis = vector(random)
            turned = axis
            if sign < 0:
                turned = [sum(r * x for r, x in zip(row, axis, strict=True)) for row in placed.rotation]
            cosine = sign * placed.dot(turned, rod) / sqrt(placed.dot(turned, turned) * placed.dot(rod, rod))
            angle = degrees(acos(cosine))
            cones.append((axis, [x for x in ANGLES if x > angle + 1], [x for x in ANGLES if x < angle - 1]))
        if all(wide for _, wide, _ in cones):
            good.append(([key], [cone(axis, wide[0]) for axis, wide, _ in cones]))
            bad += [([key, k], cone(axis, narrow[-1])) for k, (axis, _, narrow) in enumerate(cones) if narrow]
    return good, bad


def _positions(placed: Placed) -> tuple[list[Limit], list[Limit]]:
    c = [Fraction(x).limit_denominator(1000) for x in placed.place]
    bad: list[Limit] = []
    for k in range(3):
        bad.append((["position", k], texts([c[k] + Fraction(1, 50), c[k] + 1])))
        bad.append((["position", k], texts([c[k] - 1, c[k] - Fraction(1, 50)])))
    return [(["position"], texts([[x - 1, x + 1] for x in c]))], bad


def put(content: Content, path: Sequence[Any], value: Any) -> None:
    """Change an entry of the robot."""
    entry = content["robot"]
    for key in path[:-1]:
        entry = entry[key]
    entry[path[-1]] = value


def vanishing_form(content: Content, random: Random) -> list[Fraction]:
    """A random form that is 0 all over a chart of one turn, or of one coordinate: three of its numbers are solved for.

    On such a chart N times the value is quadratic, so that three poses suffice.
    """
    g = [int(x) for x in content["robot"]["metric"]]
    form: list[Any] = [Fraction(random.randint(-9, 9), random.randint(1, 3)) for _ in range(17)]
    chart = content["chart"]
    (name,) = chart["variables"]
    turns = name in NAMES[3:]
    axis = NAMES.index(name) % 3
    if turns:
        i, j = (axis + 1) % 3, (axis + 2) % 3
        solved = [16, *((7 + 3 * i + j, 7 + 3 * i + i) if axis == 2 else (7 + i, 7 + j))]
    else:
        form[0], solved = Fraction(0), [16, 4 + axis]
    poses = [exact_pose(chart, g, Fraction(t)) for t in (0, 1, -2)[: len(solved)]]
    units = []
    for place in solved:
        form[place] = Fraction(0)
        unit = [Fraction(int(k == place)) for k in range(17)]
        units.append([form_at(unit, c, columns, g) for c, columns in poses])
    rest = [-form_at(form, c, columns, g) for c, columns in poses]
    for place, value in zip(solved, _solved(list(zip(*units, strict=True)), rest), strict=True):
        form[place] = value
    return form


def exact_pose(chart: Content, g: Sequence[int], value: Fraction) -> tuple[list[Fraction], list[tuple[Fraction, ...]]]:
    """C and R by columns, of a chart with turns and one variable."""
    values = {chart["variables"][0]: value}
    place = [values[x] if x in values else Fraction(x) for x in chart["position"]]
    found = [[Fraction(int(i == j)) for j in range(3)] for i in range(3)]
    for axis, entry in enumerate(chart["turns"]):
        c, s = (Fraction(1), values[entry[0]]) if len(entry) == 1 else map(Fraction, entry)
        i, j = (axis + 1) % 3, (axis + 2) % 3
        w = g[i] * g[j]
        matrix = [[Fraction(int(a == b)) for b in range(3)] for a in range(3)]
        norm = c * c + w * s * s
        matrix[i][i] = matrix[j][j] = (c * c - w * s * s) / norm
        matrix[i][j], matrix[j][i] = -2 * g[j] * c * s / norm, 2 * g[i] * c * s / norm
        found = _product(matrix, found)  # type: ignore[assignment]
    return place, list(zip(*found, strict=True))


def _solved(rows: Sequence[Sequence[Fraction]], right: Sequence[Fraction]) -> list[Fraction]:
    left = [[*row, value] for row, value in zip(rows, right, strict=True)]
    size = len(left)
    for column in range(size):
        place = next(r for r in range(column, size) if left[r][column])
        left[column], left[place] = left[place], left[column]
        left[column] = [x / left[column][column] for x in left[column]]
        for r in range(size):
            if r != column:
                left[r] = [x - left[r][column] * y for x, y in zip(left[r], left[column], strict=True)]
    return [row[-1] for row in left]


# Exactly singular poses


def make_singular(content: Content, at: Fraction) -> None:
    """Move the base of the first leg, along some axis, to where the rows are dependent at a value of the variable."""
    g = [int(x) for x in content["robot"]["metric"]]
    c, columns = exact_pose(content["chart"], g, at)
    kept = FREEDOMS[content["robot"]["motion"]]
    first, *others = content["robot"]["legs"]
    rows = [exact_row(c, columns, exact(entry["base"]), exact(entry["platform"]), g) for entry in others]
    rows += [exact_slope(exact(form), c, columns, g) for form in content["robot"]["forms"]]

    def value(base: Sequence[Fraction]) -> Fraction:
        row = exact_row(c, columns, base, exact(first["platform"]), g)
        return exact_determinant([[line[k] for k in kept] for line in [row, *rows]])

    base = exact(first["base"])
    for axis in range(3):
        moved = [x + (k == axis) for k, x in enumerate(base)]
        there, slope = value(base), value(moved) - value(base)
        if slope:
            first["base"] = texts([x - (k == axis) * there / slope for k, x in enumerate(base)])
            break
    else:
        raise AssertionError("no place of the joint makes the rows dependent")
    content["singular"] = at


def exact_row(
    c: Sequence[Fraction], columns: Sequence[Numbers], base: Numbers, platform: Numbers, g: Sequence[int]
) -> list[Fraction]:
    """The derivatives of half of the squared length."""
    arm = [sum((columns[j][i] * platform[j] for j in range(3)), Fraction(0)) for i in range(3)]
    rod = [x + y - a for x, y, a in zip(c, arm, base, strict=True)]
    moves = [[Fraction(int(i == j)) for j in range(3)] for i in range(3)] + [exact_turn(k, arm, g) for k in range(3)]
    return [sum((w * x * y for w, x, y in zip(g, move, rod, strict=True)), Fraction(0)) for move in moves]


def exact_turn(k: int, vector_: Numbers, g: Sequence[int]) -> list[Fraction]:
    i, j = (k + 1) % 3, (k + 2) % 3
    found = [Fraction(0)] * 3
    found[i], found[j] = -g[j] * vector_[j], g[i] * vector_[i]
    return found


def exact_slope(form: Numbers, c: Sequence[Fraction], columns: Sequence[Numbers], g: Sequence[int]) -> list[Fraction]:
    """The derivatives of a form, which is quadratic along each of these."""
    found = []
    for k in range(6):
        ends = []
        for step in (1, -1):
            place, turned = list(c), [list(column) for column in columns]
            if k < 3:
                place[k] += step
            else:
                moves = [exact_turn(k - 3, column, g) for column in turned]
                turned = [
                    [x + step * y for x, y in zip(column, move, strict=True)]
                    for column, move in zip(turned, moves, strict=True)
                ]
            ends.append(form_at(form, place, turned, g))
        found.append((ends[0] - ends[1]) / 2)
    return found


def exact_determinant(rows: list[list[Fraction]]) -> Fraction:
    if not rows:
        return Fraction(1)
    first, *others = rows
    total = Fraction(0)
    for k, x in enumerate(first):
        if x:
            total += (-1) ** k * x * exact_determinant([row[:k] + row[k + 1 :] for row in others])
    return total
