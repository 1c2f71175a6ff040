"""First models of mechanisms of bodies and joints, from a few dimensions: one function and one row each.

A leg is a chain of joints (name, type, point, axes) from the base to the platform; names of bodies follow. Angles are
given by the tangents of their halves, so that all is rational.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass
from fractions import Fraction
from typing import Final, TypeAlias

from pkm_exact.errors import InputError
from pkm_exact.geometry.joint_types import JointGeometry
from pkm_exact.geometry.linkage import Joint, Linkage
from pkm_exact.geometry.rational import parse_rational
from pkm_exact.wording import shown

Vector: TypeAlias = tuple[Fraction, Fraction, Fraction]
Sizes: TypeAlias = Mapping[str, Fraction]
Entry: TypeAlias = tuple[str, str, Vector, tuple[Vector, ...]]
Chain: TypeAlias = Sequence[Entry]

_O: Final[Vector] = (Fraction(0),) * 3
UP: Final[Vector] = (Fraction(0), Fraction(0), Fraction(1))


@dataclass(frozen=True)
class ChainTemplate:
    """A mechanism that ``new --chains`` writes.

    Attributes
    ----------
    name, title : str
    sizes : dict
        Dimensions with their examples.
    legs : callable
        The chains of the legs, from the dimensions.
    actuated : tuple of str
        Names of joints.
    """

    name: str
    title: str
    sizes: Mapping[str, str]
    legs: Callable[[Sizes], list[Chain]]
    actuated: tuple[str, ...]


def _turn(half: Fraction) -> tuple[Fraction, Fraction]:
    """Cosine and sine."""
    return (1 - half * half) / (1 + half * half), 2 * half / (1 + half * half)


def _turned(half: Fraction, x: Fraction, y: Fraction, z: Fraction) -> Vector:
    c, s = _turn(half)
    return c * x - s * y, s * x + c * y, z


def _vector(x: Fraction | int, y: Fraction | int, z: Fraction | int) -> Vector:
    return Fraction(x), Fraction(y), Fraction(z)


def _pprr(d: Sizes) -> list[Chain]:
    found: list[Chain] = []
    for k in (1, 2, 3):
        half = d[f"half_tangent_{k}"]
        across = _turned(half, *_vector(0, -1, 0))
        points = [_turned(half, d["slide"], Fraction(0), d["height"])]
        points.append(_turned(half, d["slide"] - d["link"], Fraction(0), d["height"] + d["rise"]))
        slides: list[Entry] = [(f"A{k}", "P", _O, (_turned(half, *_vector(1, 0, 0)),)), (f"B{k}", "P", _O, (UP,))]
        found.append([*slides, (f"RB{k}", "R", points[0], (across,)), (f"RC{k}", "R", points[1], (across,))])
    return found


def _six_bar(d: Sizes) -> list[Chain]:
    c, s = _turn(d["half_tangent"])
    heights = (Fraction(0), d["height"] / 2, d["height"])
    left: list[Entry] = []
    right: list[Entry] = []
    for names, z, knee in zip(("AF", "BE", "CD"), heights, (0, 1, 0), strict=True):
        first, second = d["left"] + knee * d["left_knee"], d["right"] + knee * d["right_knee"]
        left.append((names[0], "R", _vector(0, first, z), (_vector(1, 0, 0),)))
        right.append((names[1], "R", (second * s, -second * c, z), (_vector(c, s, 0),)))
    return [left, right]


def _seven_link(d: Sizes) -> list[Chain]:
    left, right = _six_bar(d)
    return [left, [*right, ("G", "R", _vector(d["last"], 0, d["last_height"]), (_vector(0, 1, 0),))]]


def _upu(d: Sizes) -> list[Chain]:
    found: list[Chain] = []
    base, top, height = d["base_radius"], d["platform_radius"], d["height"]
    for k, half in enumerate((Fraction(0), d["half_tangent"], -d["half_tangent"]), 1):
        side = _turned(half, *_vector(0, 1, 0))
        inner = _turned(half, height, Fraction(0), base - top)
        foot, end = _turned(half, *_vector(base, 0, 0)), _turned(half, *_vector(top, 0, height))
        rod = _turned(half, top - base, Fraction(0), height)
        found.append(
            [(f"U{k}", "U", foot, (side, inner)), (f"P{k}", "P", _O, (rod,)), (f"V{k}", "U", end, (inner, side))]
        )
    return found


def _prrr(d: Sizes) -> list[Chain]:
    found: list[Chain] = []
    points = [(d[f"aside_{k}"], d[f"beyond_{k}"]) for k in (1, 2, 3)]
    for axis, name in enumerate("xyz"):
        along = tuple(Fraction(int(i == axis)) for i in range(3))
        placed = []
        for aside, beyond in points:
            point = [Fraction(0)] * 3
            point[(axis + 1) % 3], point[(axis + 2) % 3] = aside, beyond
            placed.append((point[0], point[1], point[2]))
        direction = (along[0], along[1], along[2])
        hinges: list[Entry] = [(f"R{name}{k}", "R", point, (direction,)) for k, point in enumerate(placed, 1)]
        found.append([(f"P{name}", "P", _O, (direction,)), *hinges])
    return found


def _spine(d: Sizes) -> list[Chain]:
    found: list[Chain] = []
    first, second = d["half_tangent_1"], d["half_tangent_2"]
    c, s = _turn(d["fork_half_tangent"])
    for k, (half, side) in enumerate(((Fraction(0), 1), (first, -1), (second, 1), (-second, -1), (-first, 1)), 1):
        low = -d["depth"]
        points = [(d["base_radius"], Fraction(0)), (d["elbow_x"], d["elbow_y"]), (d["wrist_x"], d["wrist_y"])]
        upright: list[Entry] = [
            (f"R{k}{n}", "R", _turned(half, x, side * y, low), (UP,)) for n, (x, y) in enumerate(points, 1)
        ]
        fork = _turned(half, c, side * s, Fraction(0))
        arc = _turned(half, d["arc_x"], side * d["arc_y"], d["arc_z"])
        found.append([*upright, (f"R{k}4", "R", _O, (fork,)), (f"R{k}5", "R", _O, (arc,))])
    return found


_BAR: Final = {"left": "3", "left_knee": "2", "right": "5", "right_knee": "5", "height": "4", "half_tangent": "1/2"}
_CARTESIAN: Final = {"aside_1": "40", "beyond_1": "10", "aside_2": "30", "beyond_2": "25"}
CHAIN_TEMPLATES: Final = {
    row.name: row
    for row in (
        ChainTemplate(
            "3-PPRR",
            "two slides and two hinges in each leg, one slide common",
            {
                "slide": "20",
                "height": "10",
                "link": "10",
                "rise": "11",
                "half_tangent_1": "0",
                "half_tangent_2": "1",
                "half_tangent_3": "-2",
            },
            _pprr,
            ("A1", "A2", "A3"),
        ),
        ChainTemplate("Sarrus", "two chains of three parallel hinges", _BAR, _six_bar, ("A",)),
        ChainTemplate(
            "seven-link",
            "Sarrus's six-bar with one more hinge",
            {**_BAR, "right": "4", "right_knee": "3", "half_tangent": "1", "last": "2", "last_height": "5"},
            _seven_link,
            ("A",),
        ),
        ChainTemplate(
            "5-RRR(RR)",
            "three upright hinges a leg, then two that meet in the platform's centre",
            {
                "base_radius": "100",
                "elbow_x": "80",
                "elbow_y": "40",
                "wrist_x": "60",
                "wrist_y": "5",
                "depth": "40",
                "half_tangent_1": "8/11",
                "half_tangent_2": "3",
                "fork_half_tangent": "1/3",
                "arc_x": "12",
                "arc_y": "5",
                "arc_z": "4",
            },
            _spine,
            tuple(f"R{k}1" for k in range(1, 6)),
        ),
        ChainTemplate(
            "3-PRRR",
            "a slide and three hinges along one axis in each leg",
            {**_CARTESIAN, "aside_3": "12", "beyond_3": "8"},
            _prrr,
            ("Px", "Py", "Pz"),
        ),
        ChainTemplate(
            "3-UPU",
            "a translational platform on three rods with universal joints",
            {"base_radius": "65", "platform_radius": "39", "height": "130", "half_tangent": "7/4"},
            _upu,
            ("P1", "P2", "P3"),
        ),
    )
}
"""All templates, by their names."""


def template_linkage(name: str, given: Sequence[str] = (), label: str | None = None, unit: str = "mm") -> Linkage:
    """The mechanism of a template, with some dimensions as "key=value" in place of the examples.

    Raises
    ------
    InputError
        If a dimension is none of the template, or no number.

    Examples
    --------
    >>> found = template_linkage("Sarrus", ["half_tangent=1"])
    >>> len(found.bodies), found.joints[3].geometry.axes[0] == (0, 1, 0)
    (6, True)
    """
    template = CHAIN_TEMPLATES[name]
    sizes = {key: Fraction(value) for key, value in template.sizes.items()}
    for word in given:
        key, equals, value = (part.strip() for part in word.partition("="))
        if key not in sizes or not equals:
            known = ", ".join(sizes)
            raise InputError(f"--dimension: {shown(word)} is none of a {name}; give one of: {known}, such as {key}=2")
        sizes[key] = parse_rational(value, f"--dimension {key}")
    bodies, joints = ["base"], []
    for number, chain in enumerate(template.legs(sizes), 1):
        before = "base"
        for place, (joint, kind, point, axes) in enumerate(chain, 1):
            after = "platform" if place == len(chain) else f"leg {number} body {place}"
            bodies += [after] if place < len(chain) else []
            actuated = (1,) if joint in template.actuated else ()
            joints.append(Joint(joint, kind, (before, after), JointGeometry(point, axes), actuated))
            before = after
    source = f"A template of {name}: {template.title}; replace this and the numbers by your own"
    return Linkage(label or name, unit, source, (*bodies, "platform"), tuple(joints), "base", "platform")
