"""Mechanisms of mobility certificates as matrices: twists, loops, and ranks of rational matrices."""

from __future__ import annotations

from collections.abc import Collection, Sequence
from fractions import Fraction
from typing import Final, TypeAlias

from flint import fmpq, fmpq_mat

from pkm_exact.certify.checker.budget import charge, limbs
from pkm_exact.certify.checker.mobility_document import Joint, MobilityDocument, RankProof
from pkm_exact.certify.checker.verdict import malformed, rejected

_UNITS: Final = tuple(tuple(fmpq(int(i == j)) for j in range(3)) for i in range(3))
Rows: TypeAlias = list[list[fmpq]]


class Machine:
    """Twists, loops and matrices of a mechanism."""

    def __init__(self, document: MobilityDocument) -> None:
        self.joints = document.joints
        self.first: list[int] = []
        self.twists: Rows = []
        for joint in self.joints:
            self.first.append(len(self.twists))
            self.twists += twists_of(joint)
        charge(2000 * len(self.twists) * document.bodies)
        self.loops: list[list[tuple[int, int]]] = []
        self._tree: list[int] = []
        part = list(range(document.bodies))
        for place, joint in enumerate(self.joints):
            a, b = (part[body] for body in joint.bodies)
            if a == b:
                self.loops.append([*self._path(joint.bodies[1], joint.bodies[0]), (place, 1)])
            else:
                self._tree.append(place)
                part = [a if where == b else where for where in part]
        charge(50 * 6 * (len(self.loops) + 1) * len(self.twists))
        self.matrix = [row for loop in self.loops for row in self._block(loop)]
        self.platform = self._block(self._path(document.base, document.platform))

    def passed(self, places: Sequence[tuple[int, int]]) -> list[tuple[int, int]]:
        """The one-freedom joints of joints in the order in which they are passed, with the signs of these."""
        found: list[tuple[int, int]] = []
        for place, sign in places:
            start = self.first[place]
            columns = range(start, start + self.joints[place].freedoms)
            found += [(column, sign) for column in (columns if sign == 1 else reversed(columns))]
        return found

    def along(self, places: Sequence[tuple[int, int]], locked: Collection[int] = ()) -> Rows:
        """The twists of joints in the order in which they are passed, without those of locked freedoms."""
        return [self.twists[column] for column, _ in self.passed(places) if column not in locked]

    def without(self, rows: Rows, locked: Collection[int]) -> Rows:
        """Rows without the columns of locked freedoms."""
        kept = [column for column in range(len(self.twists)) if column not in locked]
        return [[row[column] for column in kept] for row in rows]

    def _path(self, start: int, end: int) -> list[tuple[int, int]]:
        """The joints from one body to another in the forest as far as it has grown."""
        came: dict[int, tuple[int, int, int]] = {}
        front = [start]
        while front and end not in came and start != end:
            charge(300 * len(self._tree))
            following = []
            for body in front:
                for place in self._tree:
                    one, other = self.joints[place].bodies
                    for here, there, sign in ((one, other, 1), (other, one, -1)):
                        if here == body and there not in came and there != start:
                            came[there] = (body, place, sign)
                            following.append(there)
            front = following
        path: list[tuple[int, int]] = []
        while end != start:
            end, place, sign = came[end]
            path.append((place, sign))
        return path[::-1]

    def _block(self, path: Sequence[tuple[int, int]]) -> Rows:
        rows = [[fmpq(0)] * len(self.twists) for _ in range(6)]
        for place, sign in path:
            for k in range(self.joints[place].freedoms):
                column = self.first[place] + k
                for i, value in enumerate(self.twists[column]):
                    rows[i][column] = sign * value
        return rows


def twists_of(joint: Joint) -> Rows:
    """The twists of the one-freedom joints."""
    point, pitch = [exact(x) for x in joint.point], exact(joint.pitch)
    axes = [[exact(x) for x in axis] for axis in joint.axes]
    zero = [fmpq(0)] * 3
    if joint.type == "screw":
        return [[exact(x) for x in screw] for screw in joint.screws]
    if joint.type == "P":
        return [zero + axes[0]]
    turns = []
    for axis in axes or _UNITS:
        moment = cross(point, axis)
        turns.append([*axis, *(m + pitch * a for m, a in zip(moment, axis, strict=True))])
    return turns + ([zero + axes[0]] if joint.type == "C" else [])


def exact(value: Fraction | int) -> fmpq:
    return fmpq(value.numerator, value.denominator)


def cross(u: Sequence[fmpq], v: Sequence[fmpq]) -> list[fmpq]:
    return [u[1] * v[2] - u[2] * v[1], u[2] * v[0] - u[0] * v[2], u[0] * v[1] - u[1] * v[0]]


def words_of(rows: Sequence[Sequence[fmpq]]) -> int:
    """The words of the longest number."""
    return limbs(max((max(abs(x.p).bit_length(), x.q.bit_length()) for row in rows for x in row), default=1))


def matrix_of(rows: Sequence[Sequence[fmpq]], columns: int) -> fmpq_mat:
    return fmpq_mat(len(rows), columns, [value for row in rows for value in row])


def rank_of(rows: Sequence[Sequence[fmpq]]) -> int:
    if not rows or not rows[0]:
        return 0
    size = max(len(rows), len(rows[0]))
    words = size * words_of(rows)
    charge(3000 + len(rows) * len(rows[0]) * min(len(rows), len(rows[0])) * (300 + words * words))
    return int(matrix_of(rows, len(rows[0])).rank())


def times(rows: Rows, vectors: Sequence[Sequence[fmpq]]) -> Rows:
    """The matrix with the columns A x."""
    if not vectors:
        return [[] for _ in rows]
    words = words_of(rows) + words_of(vectors)
    charge(3000 + len(rows) * len(vectors) * len(vectors[0]) * (300 + words * words))
    product = matrix_of(rows, len(vectors[0])) * matrix_of(vectors, len(vectors[0])).transpose()
    return [list(row) for row in product.tolist()]


def proved(proof: RankProof, rows: Rows, columns: int, where: str) -> Rows:
    """The null space, if the proof shows that it is one: a matrix of so many columns, by rows."""
    if any(place >= len(rows) for place in proof.rows) or any(place >= columns for place in proof.columns):
        raise malformed(f"{where}: a place outside the matrix")
    others = [place for place in range(columns) if place not in proof.columns]
    if len(proof.null_space) != len(others) or any(len(x) != columns for x in proof.null_space):
        raise malformed(f"{where}.null_space: not a vector for each other column")
    for own, x in zip(others, proof.null_space, strict=True):
        if any(x[place] != (place == own) for place in others):
            raise rejected(f"{where}.null_space: not 1 at its own column and 0 at the others")
    found = [[exact(value) for value in x] for x in proof.null_space]
    if found and rows and any(any(row) for row in times(rows, found)):
        raise rejected(f"{where}.null_space: not in the null space")
    minor = [[rows[i][j] for j in proof.columns] for i in proof.rows]
    if rank_of(minor) != len(minor):
        raise rejected(f"{where}: the minor is 0")
    return found
