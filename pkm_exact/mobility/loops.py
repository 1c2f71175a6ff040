"""The closed loops of a mechanism, and the linear equations that they put on the speeds of its joints.

Joints join a spanning tree in their order, unless their bodies are connected by it already; each of the others closes a
loop: the joint from its first body to its second, and back through the tree. Along a loop the twists of the joints,
each times its speed and with the sign of the direction in which it is passed, sum up to 0: six equations.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from functools import cached_property

from pkm_exact.geometry.linkage import Joint, Linkage
from pkm_exact.screws.exact_matrix import Row

Passage = tuple[int, int]
"""Index of a one-freedom joint, and 1 or -1 for the direction in which it is passed."""


@dataclass(frozen=True)
class Loops:
    """A mechanism with its loops.

    Attributes
    ----------
    linkage : Linkage
    loops : tuple of tuples of (int, int)
        The one-freedom joints along each loop, from the first body of the joint that closes it.
    to_platform : tuple of (int, int)
        Those from the base to the platform through the tree.

    Examples
    --------
    >>> from pkm_exact.geometry.reader import read_linkage
    >>> found = find_loops(read_linkage("models/chains/sarrus.toml"))
    >>> len(found.loops), len(found.loops[0]), found.to_platform
    (1, 6, ((0, 1), (1, 1), (2, 1)))
    """

    linkage: Linkage
    loops: tuple[tuple[Passage, ...], ...]
    to_platform: tuple[Passage, ...]

    @cached_property
    def twists(self) -> tuple[Row, ...]:
        """The twist of each one-freedom joint, (w; v)."""
        return tuple(twist for joint in self.linkage.joints for twist in joint.twists)

    @cached_property
    def matrix(self) -> tuple[Row, ...]:
        """Six equations a loop in the speeds of all one-freedom joints."""
        return tuple(row for loop in self.loops for row in self._along(loop))

    @cached_property
    def platform(self) -> tuple[Row, ...]:
        """The platform's twist from the speeds: 6 rows."""
        return self._along(self.to_platform)

    def _along(self, path: Sequence[Passage]) -> tuple[Row, ...]:
        columns = {index: tuple(sign * value for value in self.twists[index]) for index, sign in path}
        zero = tuple(0 * value for value in self.twists[0])
        entries = [columns.get(index, zero) for index in range(len(self.twists))]
        return tuple(tuple(entry[row] for entry in entries) for row in range(6))


def find_loops(linkage: Linkage) -> Loops:
    """The loops of a mechanism, and its path from the base to the platform."""
    first, tree, closing = _numbered(linkage), [], []
    part = {body: body for body in linkage.bodies}
    for place, joint in enumerate(linkage.joints):
        one, other = (part[body] for body in joint.bodies)
        if one == other:
            closing.append(place)
            continue
        tree.append(place)
        part = {body: one if where == other else where for body, where in part.items()}
    branches = [linkage.joints[place] for place in tree]
    loops = []
    for place in closing:
        joint = linkage.joints[place]
        back = _path(branches, joint.bodies[1], joint.bodies[0])
        loops.append(_passages([(joint, 1), *back], first))
    way = _path(branches, linkage.base, linkage.platform)
    return Loops(linkage, tuple(loops), _passages(way, first))


def _numbered(linkage: Linkage) -> dict[str, int]:
    """The index of the first one-freedom joint of each joint."""
    numbers, count = {}, 0
    for joint in linkage.joints:
        numbers[joint.name] = count
        count += len(joint.twists)
    return numbers


def _path(branches: Sequence[Joint], start: str, end: str) -> list[tuple[Joint, int]]:
    """The joints of the tree from one body to another, with the direction in which they are passed."""
    ways: dict[str, list[tuple[Joint, int]]] = {start: []}
    pending = [start]
    while pending:
        body = pending.pop()
        for joint in branches:
            if body in joint.bodies:
                sign = 1 if joint.bodies[0] == body else -1
                following = joint.bodies[1 if sign == 1 else 0]
                if following not in ways:
                    ways[following] = [*ways[body], (joint, sign)]
                    pending.append(following)
    return ways[end]


def _passages(way: Sequence[tuple[Joint, int]], first: dict[str, int]) -> tuple[Passage, ...]:
    found: list[Passage] = []
    for joint, sign in way:
        indices = range(first[joint.name], first[joint.name] + len(joint.twists))
        found += [(index, sign) for index in (indices if sign == 1 else reversed(indices))]
    return tuple(found)
