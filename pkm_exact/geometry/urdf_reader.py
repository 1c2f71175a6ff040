"""Mechanisms of bodies and joints from URDF files, with the loops that some writers add to them.

URDF describes trees: a joint has a parent, a child, a frame by translation and roll, pitch, yaw in radians, and an axis
in that frame. Loops are closed by elements ``loop_joint``, with a frame in each of two links (as Drake reads them), or
by a YAML file beside it (``urdf_closures``). All joint values are 0. Lengths are metres, and decimals the numbers that
they spell. An angle within the last digit written of a multiple of a right angle is that multiple; others are not
rational turns, and one next to them stands in.
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass
from fractions import Fraction
from pathlib import Path
from typing import TYPE_CHECKING, Final

from pkm_exact.constraints.form import Vector
from pkm_exact.errors import InputError
from pkm_exact.geometry.inverse import Matrix, cross, rotation_of
from pkm_exact.geometry.joint_types import JointGeometry
from pkm_exact.geometry.linkage import Joint, Linkage
from pkm_exact.geometry.rational import NumberText, parse_rational
from pkm_exact.geometry.rotation_degrees import NEAREST_TURN, quaternion_of_angles
from pkm_exact.geometry.urdf_closures import JOINT_TYPES, UNIVERSAL, Closures
from pkm_exact.geometry.written_digits import finest_digit
from pkm_exact.wording import shown

if TYPE_CHECKING:
    from xml.etree.ElementTree import Element

MOST_BYTES: Final = 4_000_000
MOST_ELEMENTS: Final = 500
_MOST_RADIANS: Final = 1000
_NOISE: Final = Fraction(1, 10**12)
"""Smaller numbers, and angles nearer to a right one, come from computations in doubles and mean 0."""
_GRID: Final = 10**15
_OPEN: Final = Fraction(1, 1000)
"""How far, in metres, the two frames of a loop may be apart."""
_ZERO: Final = (Fraction(0),) * 3
_TYPES: Final = {
    "revolute": "R",
    "continuous": "R",
    "prismatic": "P",
    "ball": "S",
    "planar": "screw",
    "floating": "screw",
    **dict.fromkeys(UNIVERSAL, "U"),
}
_FIXED: Final = "fixed"
_UNTURNED: Final = rotation_of((Fraction(1), Fraction(0), Fraction(0), Fraction(0)))


@dataclass(frozen=True)
class _Frame:
    """Where a frame is, in the coordinates of the base."""

    point: Vector = _ZERO
    rotation: Matrix = _UNTURNED
    is_exact: bool = True

    def moved(self, vector: Vector) -> Vector:
        """A vector of this frame, in the coordinates of the base."""
        found = [sum((a * b for a, b in zip(row, vector, strict=True)), Fraction(0)) for row in self.rotation]
        x, y, z = found if self.is_exact else (Fraction(round(value * _GRID), _GRID) for value in found)
        return x, y, z

    def then(self, other: _Frame) -> _Frame:
        """A frame that stands in this one."""
        columns = list(zip(*other.rotation, strict=True))
        rows = tuple(
            tuple(sum((a * b for a, b in zip(row, column, strict=True)), Fraction(0)) for column in columns)
            for row in self.rotation
        )
        x, y, z = (p + q for p, q in zip(self.point, self.moved(other.point), strict=True))
        return _Frame((x, y, z), rows, self.is_exact and other.is_exact)  # type: ignore[arg-type]


@dataclass(frozen=True)
class UrdfMechanism:
    """What a URDF file describes.

    Attributes
    ----------
    linkage : Linkage
    notes : tuple of str
        What was taken instead of what stands there.
    origin : vector of 3 Fraction
        Of the frame of the platform's link, in the coordinates of the base.
    """

    linkage: Linkage
    notes: tuple[str, ...]
    origin: Vector = _ZERO


def read_urdf(path: str | Path, platform: str | None = None, closures: Closures | None = None) -> UrdfMechanism:
    """The mechanism of a URDF file at joint values 0.

    Parameters
    ----------
    path : str or Path
    platform : str, optional
        The link that is asked about; by default the last one of the file.
    closures : Closures, optional
        What closes its loops, of a YAML file.

    Raises
    ------
    InputError
        If the file is not one, or has what mechanisms of bodies and joints do not have; the message says what to do.

    Examples
    --------
    >>> from tempfile import TemporaryDirectory
    >>> text = '<robot name="r"><link name="a"/><link name="b"/><joint name="j" type="revolute"><parent link="a"/>'
    >>> text += '<child link="b"/><origin xyz="0 0 0.5" rpy="0 1.5708 0"/><axis xyz="0 0 1"/></joint></robot>'
    >>> with TemporaryDirectory() as folder:
    ...     _ = Path(folder, "r.urdf").write_text(text)
    ...     found = read_urdf(Path(folder, "r.urdf"))
    >>> [list(map(str, found.linkage.joints[0].geometry.axes[0])), found.notes]
    [['1', '0', '0'], ('1 angle is taken as the multiple of a right angle within its last digit',)]
    """
    root = _root(Path(path))
    reader = _Reader(root, closures or Closures())
    linkage = reader.linkage(Path(path).name, platform)
    return UrdfMechanism(linkage, tuple(reader.notes()), reader.origin)


def _root(path: Path) -> Element:
    from xml.etree import ElementTree

    try:
        with path.open("rb") as stream:
            content = stream.read(MOST_BYTES + 1)
    except OSError as error:
        raise InputError(f"{path}: cannot be read: {error.strerror}") from None
    if len(content) > MOST_BYTES:
        raise InputError(f"{path}: has more than {MOST_BYTES} bytes; leave out what is no link and no joint")
    try:
        text = content.decode("utf-8-sig")
    except UnicodeDecodeError:
        raise InputError(f"{path}: is no text in UTF-8; save it as that") from None
    if "<!" in text.replace("<!--", ""):
        raise InputError(f"{path}: has a document type or CDATA, which URDF files do not need; leave it out")
    try:
        root = ElementTree.fromstring(text)  # noqa: S314 - without a document type no entity can be declared
    except (ElementTree.ParseError, ValueError) as error:
        raise InputError(f"{path}: is no XML: {error}") from None
    if root.tag != "robot":
        raise InputError(
            f"{path}: begins with {shown(root.tag)}, not with robot; give a URDF file, xacro files expanded"
        )
    return root


class _Reader:
    """Links and joints of a file, and what was taken instead of what stands there."""

    def __init__(self, root: Element, closures: Closures) -> None:
        self.root, self.closures = root, closures
        self.right, self.near, self.noise, self.open, self.origin = 0, 0, 0, Fraction(0), _ZERO
        self.links = [_name(link, "link") for link in root.findall("link")]
        if not 2 <= len(self.links) <= MOST_ELEMENTS or len(set(self.links)) < len(self.links):
            raise InputError(f"link: {len(self.links)} given; give 2 to {MOST_ELEMENTS} with different names")
        self.driven = {joint.get("name") for each in root.findall("transmission") for joint in each.findall("joint")}
        self._take_types()

    def notes(self) -> Iterator[str]:
        """What was taken instead of what stands there, in words."""
        if self.right:
            angles, its = ("1 angle is", "its") if self.right == 1 else (f"{self.right} angles are", "their")
            yield f"{angles} taken as the multiple of a right angle within {its} last digit"
        if self.near:
            angles = "1 angle is" if self.near == 1 else f"{self.near} angles are"
            off = f"rational turns stand in, off by {float(NEAREST_TURN):.0e} at most"
            kept = "ranks are those of the numbers in the model, and what holds for the ideal angles only is lost"
            yield f"{angles} no multiple of a right angle: {off}; {kept}"
        if self.noise:
            numbers = "1 number is" if self.noise == 1 else f"{self.noise} numbers are"
            yield f"{numbers} below {float(_NOISE):.0e} and taken as 0"
        if self.open:
            yield f"the frames of a loop are up to {float(self.open):.1e} apart: those of its first link are taken"

    def linkage(self, source: str, platform: str | None) -> Linkage:
        """The mechanism."""
        elements = self.root.findall("joint")
        if len(elements) > MOST_ELEMENTS:
            raise InputError(f"joint: {len(elements)} given; give at most {MOST_ELEMENTS}")
        base, frames, bodies = self._tree(elements)
        bodies = self._welded(frames, bodies, base)
        joints = [
            self._joint(
                element,
                (bodies[self._link(element, "parent")], bodies[self._link(element, "child")]),
                frames[self._link(element, "child")],
            )
            for element in elements
            if element.get("type") != _FIXED
        ]
        joints += [self._loop(element, frames, bodies) for element in self.root.findall("loop_joint")]
        joints += [self._ball(*loop[:2], frames, bodies) for loop in self.closures.loops if loop[2]]
        names = tuple(link for link in self.links if bodies[link] == link)
        last = self.links[-1] if platform is None else platform
        if last not in bodies:
            raise InputError(f"platform: {shown(last)} is not the name of a link; use one that is")
        self.origin = frames[last].point
        name = self.root.get("name") or source
        return Linkage(name, "m", f"URDF file {source}", names, tuple(joints), base, bodies[last])

    def _take_types(self) -> None:
        """Types and actuators as the closures have them."""
        joints = {element.get("name"): element for element in self.root.findall("joint")}
        for key, names in (("joint_name", tuple(self.closures.types)), ("name_mot", self.closures.actuated)):
            missing = next((name for name in names if name not in joints), None)
            if missing is not None:
                raise InputError(f"{key}: {shown(missing)} is not the name of a joint; name one that is")
        for name, kind in self.closures.types.items():
            joints[name].set("type", JOINT_TYPES[kind])
        for name in self.closures.actuated:
            if _TYPES.get(joints[name].get("type", "")) not in ("R", "P"):
                raise InputError(f"name_mot: the joint {shown(name)} neither turns nor slides; name one that does")
        self.driven |= set(self.closures.actuated)

    def _placed(self, name: str, frames: dict[str, _Frame]) -> tuple[_Frame, str]:
        """A frame by the name of its link, or of the joint that bears it, and that link."""
        children = {element.get("name"): element for element in self.root.findall("joint")}
        link = name if name in frames else self._link(children[name], "child") if name in children else None
        if link is None:
            raise InputError(f"closed_loop: {shown(name)} is the name of neither a link nor a joint; name one that is")
        return frames[link], link

    def _require_closed(self, first: str, second: str, frames: tuple[_Frame, _Frame], *, only_origins: bool) -> None:
        one, other = frames
        apart = max(abs(a - b) for a, b in zip(one.point, other.point, strict=True))
        pairs = [pair for rows in zip(one.rotation, other.rotation, strict=True) for pair in zip(*rows, strict=True)]
        turned = Fraction(0) if only_origins else max(abs(a - b) for a, b in pairs)
        if apart > _OPEN or turned > _OPEN:
            how = f"{float(apart):.3g} apart" if apart > _OPEN else "turned against each other"
            raise InputError(
                f"closed_loop: with all joint values 0 the frames {shown(first)} and {shown(second)} are {how}, so "
                "that the loop is open; give the files in a configuration in which it is closed"
            )
        self.open = max(self.open, apart)

    def _welded(self, frames: dict[str, _Frame], bodies: dict[str, str], base: str) -> dict[str, str]:
        """The bodies, those whose frames are one by a closure made one: the base, or the first in the file."""
        found = dict(bodies)
        for first, second, only_origins in self.closures.loops:
            (one, link), (other, another) = self._placed(first, frames), self._placed(second, frames)
            if found[link] == found[another]:
                raise InputError(f"closed_loop: {shown(first)} and {shown(second)} are of one body; leave the pair out")
            self._require_closed(first, second, (one, other), only_origins=only_origins)
            if not only_origins:
                order = [base, *self.links]
                kept, lost = sorted((found[link], found[another]), key=order.index)
                found = {name: kept if body == lost else body for name, body in found.items()}
        return found

    def _ball(self, first: str, second: str, frames: dict[str, _Frame], bodies: dict[str, str]) -> Joint:
        """The joint of two frames whose origins are one."""
        (one, link), (_, another) = self._placed(first, frames), self._placed(second, frames)
        geometry = JointGeometry(point=one.point)
        return Joint(f"{first}, {second}"[:100], "S", (bodies[link], bodies[another]), geometry, ())

    def _tree(self, elements: list[Element]) -> tuple[str, dict[str, _Frame], dict[str, str]]:
        """The base, the frame of every link, and to which body it belongs: links at fixed joints are one."""
        children = [self._link(element, "child") for element in elements]
        for child in children:
            if children.count(child) > 1:
                raise InputError(f"link {shown(child)}: is the child of two joints; close loops by <loop_joint>")
        roots = [link for link in self.links if link not in children]
        if len(roots) != 1:
            raise InputError(f"link: {len(roots)} links are no child of a joint; there must be one, the base")
        frames, bodies, waiting = {roots[0]: _Frame()}, {roots[0]: roots[0]}, elements
        while waiting:
            left = []
            for element in waiting:
                parent, child = self._link(element, "parent"), self._link(element, "child")
                if parent not in frames:
                    left.append(element)
                    continue
                frames[child] = frames[parent].then(self._frame(element.find("origin"), _name(element, "joint")))
                bodies[child] = bodies[parent] if element.get("type") == _FIXED else child
            if len(left) == len(waiting):
                name = shown(_name(left[0], "joint"))
                raise InputError(f"joint {name}: is in a ring of joints without the base; close loops by <loop_joint>")
            waiting = left
        return roots[0], frames, bodies

    def _link(self, element: Element, side: str) -> str:
        found = element.find(side)
        link = None if found is None else found.get("link")
        if link not in self.links:
            name = shown(_name(element, "joint"))
            raise InputError(f"joint {name}: its {side} {shown(link)} is not the name of a link; name one that is")
        return str(link)

    def _joint(self, element: Element, ends: tuple[str, str], frame: _Frame) -> Joint:
        name, kind = _name(element, "joint"), element.get("type")
        if element.find("mimic") is not None:
            raise InputError(f"joint {shown(name)}: mimics another one, which joints of models cannot; leave that out")
        if kind not in _TYPES:
            known = ", ".join((_FIXED, *_TYPES))
            raise InputError(f"joint {shown(name)}: type {shown(kind)} is unknown; use one of: {known}")
        axis, where = element.find("axis"), f"joint {shown(name)}: axis"
        along = (Fraction(1), Fraction(0), Fraction(0)) if axis is None else self._vector(axis, where)
        if not any(along):
            raise InputError(f"joint {shown(name)}: its axis is 0; give a direction that is not")
        actuated = (1,) if name in self.driven and _TYPES[kind] in ("R", "P") else ()
        return Joint(name, _TYPES[kind], ends, _geometry(kind, frame, along), actuated)

    def _loop(self, element: Element, frames: dict[str, _Frame], bodies: dict[str, str]) -> Joint:
        name, placed, ends = _name(element, "loop_joint"), [], []
        for side in ("link1", "link2"):
            link = self._link(element, side)
            placed.append(frames[link].then(self._frame(element.find(side), name)))
            ends.append(bodies[link])
        apart = max(abs(a - b) for a, b in zip(placed[0].point, placed[1].point, strict=True))
        if apart > _OPEN and element.get("type") in ("revolute", "continuous", "ball"):
            raise InputError(
                f"loop_joint {shown(name)}: with all joint values 0 its frames are {float(apart):.3g} apart, so that "
                "the loop is open; give the file in a configuration in which it is closed"
            )
        self.open = max(self.open, apart)
        return self._joint(element, (ends[0], ends[1]), placed[0])

    def _frame(self, origin: Element | None, name: str) -> _Frame:
        if origin is None:
            return _Frame()
        where = f"joint {shown(name)}: origin"
        texts = _words(origin, "rpy", where)
        angles = [self._degrees(text, f"{where}: rpy") for text in texts]
        roll, pitch, yaw = angles
        rotation = rotation_of(quaternion_of_angles(roll, pitch, yaw))
        return _Frame(self._vector(origin, where), rotation, all(angle % 90 == 0 for angle in angles))

    def _vector(self, element: Element, where: str) -> Vector:
        x, y, z = (self._number(word, f"{where}: xyz") for word in _words(element, "xyz", where))
        return x, y, z

    def _number(self, text: str, where: str) -> Fraction:
        found = parse_rational(NumberText(text), where)
        if found and abs(found) < _NOISE:
            self.noise += 1
            return Fraction(0)
        return found

    def _degrees(self, text: str, where: str) -> Fraction:
        """An angle in degrees: a multiple of a right one, if the text may mean it."""
        from flint import arb

        from pkm_exact.balls import ball
        from pkm_exact.precision import working_precision

        radians = self._number(text, where)
        if radians == 0:
            return radians
        if abs(radians) > _MOST_RADIANS:
            raise InputError(f"{where}: {shown(text)} is no angle in radians; give one below {_MOST_RADIANS}")
        with working_precision(256):
            middle = (ball(radians) * 180 / arb.pi()).mid().fmpq()
            unit = 60 * max(finest_digit(NumberText(text)) or _NOISE, _NOISE)  # more than a unit of the last digit
        degrees = Fraction(round(Fraction(int(middle.p), int(middle.q)) * 10**40), 10**40)
        nearest = Fraction(90 * round(degrees / 90))
        if abs(degrees - nearest) <= min(unit, Fraction(1, 10)):
            self.right += 1
            return nearest
        self.near += 1
        return degrees


def _geometry(kind: str, frame: _Frame, along: Vector) -> JointGeometry:
    """Where a joint of a type is, with its frame and the axis in that."""
    axis = frame.moved(along)
    if kind in UNIVERSAL:
        units = [tuple(Fraction(int(i == k)) for i in range(3)) for k in UNIVERSAL[kind]]
        return JointGeometry(point=frame.point, axes=tuple(frame.moved((x, y, z)) for x, y, z in units))
    if kind == "floating":
        screws = tuple(tuple(Fraction(int(i == k)) for i in range(6)) for k in range(6))
        return JointGeometry(screws=screws)
    if kind == "planar":
        first, second = _across(axis)
        return JointGeometry(screws=((*_ZERO, *first), (*_ZERO, *second), (*axis, *cross(frame.point, axis))))
    return JointGeometry(point=frame.point, axes=(axis,) if kind != "ball" else ())


def _across(axis: Vector) -> tuple[Vector, Vector]:
    """Two directions perpendicular to an axis and to each other."""
    least = min(range(3), key=lambda k: abs(axis[k]))
    first = cross(axis, tuple(Fraction(int(k == least)) for k in range(3)))  # type: ignore[arg-type]
    return first, cross(axis, first)


def _name(element: Element, what: str) -> str:
    name = element.get("name")
    if not name or not name.isprintable() or len(name) > 100:
        raise InputError(f"{what}: its name {shown(name)} is missing or no label; write 1 to 100 printable characters")
    return name


def _words(element: Element, key: str, where: str) -> list[str]:
    words = element.get(key, "0 0 0").split()
    if len(words) != 3:
        raise InputError(f"{where}: {key} {shown(element.get(key))} is not three numbers; write them with spaces")
    return words
