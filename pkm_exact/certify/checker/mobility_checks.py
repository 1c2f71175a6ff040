"""The checks of a mobility certificate, ``docs/certificates-mobility.md``: every matrix is computed from the joints."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Sequence
from fractions import Fraction
from functools import reduce
from itertools import combinations
from typing import Final

from flint import fmpq, fmpq_mat

from pkm_exact.certify.checker.budget import charge, limbs
from pkm_exact.certify.checker.mobility_document import Joint, MobilityDocument, RankProof, Sets
from pkm_exact.certify.checker.verdict import malformed, rejected

_UNITS: Final = tuple(tuple(fmpq(int(i == j)) for j in range(3)) for i in range(3))
Rows = list[list[fmpq]]


def check_mobility(document: MobilityDocument) -> Iterator[str]:
    """One line per claim."""
    machine = Machine(document)
    size, freedoms = len(machine.matrix), document.freedoms
    motions = _proved(document.proofs["loops"], machine.matrix, freedoms, "loops")
    rank = freedoms - len(motions)
    yield f"loops: rank {rank} of {size} equations in {freedoms} freedoms, mobility {len(motions)}"
    twists = _times(machine.platform, motions)
    platform = len(motions) - len(_proved(document.proofs["platform"], twists, len(motions), "platform"))
    yield f"platform: {platform} freedoms"
    units = [[fmpq(int(k == place)) for k in range(freedoms)] for place in document.actuated]
    left = _proved(document.proofs["locked_loops"], machine.matrix + units, freedoms, "locked_loops")
    held = _times(machine.platform, left)
    still = len(left) - len(_proved(document.proofs["locked_platform"], held, len(left), "locked_platform"))
    yield f"actuators: {len(document.actuated)} locked leave mobility {len(left)}, of the platform {still}"
    expected = {
        "free": len(motions),
        "platform": platform,
        "gruebler_kutzbach": 6 * (document.bodies - 1 - len(document.joints)) + freedoms,
        "overconstraint": size - rank,
        "locked": len(left),
        "locked_platform": still,
    }
    for key, value in expected.items():
        if document.counts[key] != value:
            raise rejected(f"mobility.{key}: not the number that follows")
    yield f"mobility: {len(motions)}, by the formula of Gruebler and Kutzbach {expected['gruebler_kutzbach']}"
    speeds = [[motion[k] for motion in motions] for k in range(freedoms)]
    every = [[fmpq(int(i == j)) for j in range(len(motions))] for i in range(len(motions))]
    yield _check_sets("platform", document.sets["platform"], document.among, speeds, twists)
    yield _check_sets("mechanism", document.sets["mechanism"], document.among, speeds, every)
    yield _check_finite(document, machine, rank, len(motions))


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

    def along(self, places: Sequence[tuple[int, int]]) -> Rows:
        """The twists of joints in the order in which they are passed."""
        found: Rows = []
        for place, sign in places:
            start = self.first[place]
            twists = self.twists[start : start + self.joints[place].freedoms]
            found += twists if sign == 1 else twists[::-1]
        return found

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
    point, pitch = [_exact(x) for x in joint.point], _exact(joint.pitch)
    axes = [[_exact(x) for x in axis] for axis in joint.axes]
    zero = [fmpq(0)] * 3
    if joint.type == "screw":
        return [[_exact(x) for x in screw] for screw in joint.screws]
    if joint.type == "P":
        return [zero + axes[0]]
    turns = []
    for axis in axes or _UNITS:
        moment = _cross(point, axis)
        turns.append([*axis, *(m + pitch * a for m, a in zip(moment, axis, strict=True))])
    return turns + ([zero + axes[0]] if joint.type == "C" else [])


def _exact(value: Fraction) -> fmpq:
    return fmpq(value.numerator, value.denominator)


def _cross(u: Sequence[fmpq], v: Sequence[fmpq]) -> list[fmpq]:
    return [u[1] * v[2] - u[2] * v[1], u[2] * v[0] - u[0] * v[2], u[0] * v[1] - u[1] * v[0]]


def _words(rows: Sequence[Sequence[fmpq]]) -> int:
    """The words of the longest number."""
    return limbs(max((max(abs(x.p).bit_length(), x.q.bit_length()) for row in rows for x in row), default=1))


def _matrix(rows: Sequence[Sequence[fmpq]], columns: int) -> fmpq_mat:
    return fmpq_mat(len(rows), columns, [value for row in rows for value in row])


def _rank(rows: Sequence[Sequence[fmpq]]) -> int:
    if not rows or not rows[0]:
        return 0
    size = max(len(rows), len(rows[0]))
    words = size * _words(rows)
    charge(3000 + len(rows) * len(rows[0]) * min(len(rows), len(rows[0])) * (300 + words * words))
    return int(_matrix(rows, len(rows[0])).rank())


def _times(rows: Rows, vectors: Sequence[Sequence[fmpq]]) -> Rows:
    """The matrix with the columns A x."""
    if not vectors:
        return [[] for _ in rows]
    words = _words(rows) + _words(vectors)
    charge(3000 + len(rows) * len(vectors) * len(vectors[0]) * (300 + words * words))
    product = _matrix(rows, len(vectors[0])) * _matrix(vectors, len(vectors[0])).transpose()
    return [list(row) for row in product.tolist()]


def _proved(proof: RankProof, rows: Rows, columns: int, where: str) -> Rows:
    """The null space, if the proof shows that it is one: a matrix of so many columns, by rows."""
    if any(place >= len(rows) for place in proof.rows) or any(place >= columns for place in proof.columns):
        raise malformed(f"{where}: a place outside the matrix")
    others = [place for place in range(columns) if place not in proof.columns]
    if len(proof.null_space) != len(others) or any(len(x) != columns for x in proof.null_space):
        raise malformed(f"{where}.null_space: not a vector for each other column")
    for own, x in zip(others, proof.null_space, strict=True):
        if any(x[place] != (place == own) for place in others):
            raise rejected(f"{where}.null_space: not 1 at its own column and 0 at the others")
    found = [[_exact(value) for value in x] for x in proof.null_space]
    if found and rows and any(any(row) for row in _times(rows, found)):
        raise rejected(f"{where}.null_space: not in the null space")
    minor = [[rows[i][j] for j in proof.columns] for i in proof.rows]
    if _rank(minor) != len(minor):
        raise rejected(f"{where}: the minor is 0")
    return found


def _check_sets(name: str, sets: Sets, among: Sequence[int], speeds: Rows, wanted: Rows) -> str:
    wanted = [row for row in wanted if any(row)]
    where = f"actuator_sets.{name}"

    def holds(chosen: Sequence[int]) -> bool:
        rows = [speeds[place] for place in chosen]
        return _rank(rows + wanted) == _rank(rows)

    for chosen in sets.sets:
        if not holds(chosen):
            raise rejected(f"{where}: a set that does not hold it")
        if any(holds([place for place in chosen if place != left]) for left in chosen):
            raise rejected(f"{where}: a set that is not minimal")
    number = len(sets.sets)
    if not sets.complete:
        return f"{name} sets: {number} minimal sets hold it, there may be others"
    if set(_all_minimal(among, speeds, holds)) != set(sets.sets):
        raise rejected(f"{where}: not all minimal sets")
    return f"{name} sets: {number} minimal sets hold it, there is no other among {len(among)} freedoms"


def _all_minimal(
    among: Sequence[int], speeds: Rows, holds: Callable[[Sequence[int]], bool]
) -> Iterator[tuple[int, ...]]:
    """All minimal sets, by levels of independent sets that do not hold."""
    level: list[tuple[int, ...]] = [()]
    if holds(()):
        yield ()
        return
    while level:
        larger = []
        for chosen in level:
            for place in among:
                if (chosen and place <= chosen[-1]) or not any(speeds[place]):
                    continue
                new = (*chosen, place)
                if _rank([speeds[k] for k in new]) < len(new):
                    continue
                if not holds(new):
                    larger.append(new)
                elif not any(holds([k for k in new if k != left]) for left in new):
                    yield new
        level = larger


# Finite mobility


def _check_finite(document: MobilityDocument, machine: Machine, rank: int, mobility: int) -> str:
    if document.argument is None:
        return "finite: nothing is claimed"
    if document.argument == "regular":
        dimensions = sum(len(_algebra(machine.along(loop))) for loop in machine.loops)
        if dimensions != rank:
            raise rejected("finite: the loops are not regular")
    else:
        _check_legs(document, machine)
    return f"finite: mobility {mobility} near the configuration, by the argument {document.argument}"


def _check_legs(document: MobilityDocument, machine: Machine) -> None:
    groups: list[Rows] = []
    products: list[tuple[Rows, Rows]] = []
    used: list[int] = []
    between: list[int] = []
    for leg in document.legs:
        path = _passed(document, leg.joints)
        used += leg.joints
        between += [document.joints[place].bodies[1 if sign == 1 else 0] for place, sign in path[:-1]]
        twists = machine.along(path)
        if leg.cut >= max(1, len(twists)):
            raise malformed("finite.legs: a cut behind the leg's joints")
        parts = [twists[: leg.cut], twists[leg.cut :]] if leg.cut else [twists]
        algebras = [_algebra(part) for part in parts]
        if len(_reduced([row for algebra in algebras for row in algebra])) != _rank(twists):
            raise rejected("finite: a leg does not fill its groups")
        if len(algebras) == 1:
            groups.append(algebras[0])
        elif (algebras[0], algebras[1]) not in products:
            products.append((algebras[0], algebras[1]))
    if sorted(used) != list(range(len(document.joints))):
        raise rejected("finite: not every joint is in one leg")
    inner = set(range(document.bodies)) - {document.base, document.platform}
    if sorted(between) != sorted(inner):
        raise rejected("finite: not every body is in one leg")
    if not _are_transversal(groups, products):
        raise rejected("finite: the legs are not transversal")


def _passed(document: MobilityDocument, places: Sequence[int]) -> list[tuple[int, int]]:
    """The joints of a leg with the directions in which they are passed."""
    body, found = document.base, []
    for place in places:
        one, other = document.joints[place].bodies
        if body not in (one, other):
            raise rejected("finite: the joints of a leg are no chain")
        sign = 1 if body == one else -1
        body = other if sign == 1 else one
        found.append((place, sign))
    if body != document.platform:
        raise rejected("finite: a leg does not end at the platform")
    return found


def _are_transversal(groups: Sequence[Rows], products: Sequence[tuple[Rows, Rows]]) -> bool:
    spaces: list[Rows] = []
    common = reduce(_meet, groups) if groups else None
    if common is not None:
        spaces.append(common)
    spaces += [
        _reduced([*pair[0], *pair[1]])
        for pair in products
        if common is None or not any(len(_reduced([*common, *part])) == len(part) for part in pair)
    ]
    together = reduce(_meet, spaces)
    return 6 - len(together) == sum(6 - len(space) for space in spaces)


def _reduced(rows: Rows) -> Rows:
    """The reduced echelon form, without rows of 0."""
    rank = _rank(rows)
    return [list(row) for row in _matrix(rows, 6).rref()[0].tolist()[:rank]] if rank else []


def _meet(one: Rows, other: Rows) -> Rows:
    """The intersection of two spaces of rows of six."""
    if not one or not other:
        return []
    rows = [*one, *([-value for value in row] for row in other)]
    words = 6 * _words(rows)
    charge(10_000 + 6 * 6 * 12 * (300 + words * words))
    columns = [list(column) for column in zip(*rows, strict=True)]
    reduced = _matrix(columns, len(rows)).rref()
    pivots = [next(k for k, value in enumerate(row) if value) for row in reduced[0].tolist()[: reduced[1]]]
    found = []
    for free in (k for k in range(len(rows)) if k not in pivots):
        factors = [fmpq(0)] * len(rows)
        factors[free] = fmpq(1)
        for row, pivot in zip(reduced[0].tolist(), pivots, strict=False):
            factors[pivot] = -row[free]
        found.append([sum((f * row[k] for f, row in zip(factors, one, strict=False)), fmpq(0)) for k in range(6)])
    return _reduced(found)


def _algebra(rows: Rows) -> Rows:
    """The closure under the Lie product, as a reduced echelon form."""
    found = _reduced(rows)
    while True:
        words = _words(found)
        charge(15 * (20_000 + 100 * words * words))
        larger = _reduced([*found, *(_bracket(a, b) for a, b in combinations(found, 2))])
        if len(larger) == len(found):
            return found
        found = larger


def _bracket(one: Sequence[fmpq], other: Sequence[fmpq]) -> list[fmpq]:
    turn = _cross(one[:3], other[:3])
    slide = [a + b for a, b in zip(_cross(one[:3], other[3:]), _cross(one[3:], other[:3]), strict=True)]
    return turn + slide
