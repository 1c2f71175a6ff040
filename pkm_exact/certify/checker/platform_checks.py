"""The checks of a certificate of a platform's mobility, ``docs/certificates-platform.md``: ranks of rows of forms."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from fractions import Fraction
from itertools import product
from typing import Any, Final

from flint import fmpq, fmpq_mat, fmpz_mat

from pkm_exact.certify.checker.budget import charge
from pkm_exact.certify.checker.mechanism_forms import Constraint, Form, Mechanism, Row, cleared, rank_beside
from pkm_exact.certify.checker.mobility_machine import Rows, exact, proved, rank_of, words_of
from pkm_exact.certify.checker.platform_document import AtPose, Everywhere, Placed, PlatformDocument
from pkm_exact.certify.checker.study_motion import CYCLIC, Metric, motion
from pkm_exact.certify.checker.verdict import malformed, rejected, too_large

MOST_POSES: Final = 20_000


def check_platform(document: PlatformDocument) -> Iterator[str]:
    """One line per claim."""
    mechanism, locked = document.mechanism, document.actuated
    yield f"robot: {len(mechanism.constraints)} constraints, {len(locked)} of them actuated"
    if document.pose is None:
        yield "pose: nothing is claimed"
    else:
        yield _check_pose(mechanism, locked, document.pose)
    if document.everywhere is None:
        yield "everywhere: nothing is claimed"
    else:
        yield _check_everywhere(mechanism, document.everywhere)


class _Pose:
    """A pose of the group, and the rows of forms there."""

    def __init__(self, mechanism: Mechanism, placed: Placed, where: str) -> None:
        self.mechanism = mechanism
        c, r = [exact(x) for x in placed.position], fmpq_mat([[exact(x) for x in row] for row in placed.rotation])
        g = fmpq_mat([[fmpq(x if i == j else 0) for j in range(3)] for i, x in enumerate(mechanism.metric)])
        charge(10**6)
        if r.transpose() * g * r != g or r.det() != 1:
            raise rejected(f"{where}.rotation: not one in the metric")
        turned = g.inv() * r.transpose() * g * fmpq_mat([[x] for x in c])
        entries = [entry for row in r.tolist() for entry in row]
        square = sum((weight * x * x for weight, x in zip(mechanism.metric, c, strict=True)), fmpq(0))
        self.values = [square, *(turned[i, 0] for i in range(3)), *c, *entries, fmpq(1)]
        self.basis = wrench_basis(mechanism.metric, c, r.tolist(), fmpq(1), mechanism.group.twists)
        if any(self.value(form) for form in mechanism.vanishing):
            raise rejected(f"{where}: not one of the motions")

    def value(self, form: Form | Row) -> fmpq:
        """The value of a form."""
        coefficients = [exact(x) for x in form]
        words = words_of([coefficients]) + words_of([self.values])
        charge(17 * (1000 + 3 * words * words))
        return sum((a * b for a, b in zip(coefficients, self.values, strict=True)), fmpq(0))

    def rows(self, constraints: Sequence[Constraint]) -> Rows:
        """The rows of constraints."""
        found: Rows = []
        for constraint in constraints:
            found += self._of_forms(constraint.linear)
            if constraint.quadric is not None:
                whole, root = self._of_forms((constraint.quadric.whole, constraint.quadric.root))
                factor, slope = exact(constraint.quadric.factor), 2 * self.value(constraint.quadric.root)
                found.append([factor * a - slope * b for a, b in zip(whole, root, strict=True)])
        return found

    def _of_forms(self, forms: Sequence[Form]) -> Rows:
        if not forms:
            return []
        table = [[exact(x) for x in form[:16]] for form in forms]
        words = words_of(table) + words_of(self.basis)
        charge(100 * len(forms) * (1000 + 3 * words * words))
        return [list(row) for row in (fmpq_mat(table) * fmpq_mat(self.basis)).tolist()]

    def holds(self, constraint: Constraint) -> bool:
        """Whether a constraint is fulfilled."""
        if constraint.quadric is not None:
            root = self.value(constraint.quadric.root)
            return bool(exact(constraint.quadric.factor) * self.value(constraint.quadric.whole) == root * root)
        return not any(self.value(form) for form in constraint.linear)


def wrench_basis(
    g: Metric, c: Sequence[Any], r: Sequence[Sequence[Any]], norm: Any, twists: Sequence[int]
) -> list[list[Any]]:
    """The rows of the 16 coordinates |C|^2, u, C, R, times the norm if R is, and times the metric's product."""
    volume = g[0] * g[1] * g[2]
    zero = 0 * norm
    found = [[2 * volume * norm * g[i] * c[i] for i in range(3)] + [zero] * 3]
    for n in range(3):
        a = [volume // g[n] * g[i] * r[i][n] for i in range(3)]
        found.append([*a, *(g[k] * a[j] * c[k] - g[j] * a[k] * c[j] for _, j, k in CYCLIC)])
    found += [[volume * norm if i == k else zero for k in range(6)] for i in range(3)]
    for row in range(3):
        for n in range(3):
            turns = [zero] * 3
            for i, j, k in CYCLIC:
                if row == k:
                    turns[i] = volume * g[j] * r[j][n]
                if row == j:
                    turns[i] = -volume * g[k] * r[k][n]
            found.append([zero] * 3 + turns)
    return [[row[k] for k in twists] for row in found]


def _check_pose(mechanism: Mechanism, locked: Sequence[int], claim: AtPose) -> str:
    pose, size = _Pose(mechanism, claim.placed, "pose"), len(mechanism.group.twists)
    always = [c for k, c in enumerate(mechanism.constraints) if k not in locked]
    if not all(map(pose.holds, always)):
        raise rejected("pose: a constraint that always holds does not hold there")
    free = len(proved(claim.free, pose.rows(always), size, "pose.free"))
    left = len(proved(claim.locked, pose.rows(mechanism.constraints), size, "pose.locked"))
    return f"pose: rank {size - free}, freedom {free}; with the actuators locked rank {size - left}, freedom {left}"


def _check_everywhere(mechanism: Mechanism, claim: Everywhere) -> str:
    if mechanism.quadrics:
        raise rejected("everywhere: a constraint is a quadric")
    forms, size, rank = mechanism.linear, len(mechanism.group.twists), len(claim.rows)
    rows = _Pose(mechanism, claim.placed, "everywhere").rows(mechanism.constraints)
    if any(place >= len(rows) for place in claim.rows) or any(place >= size for place in claim.columns):
        raise malformed("everywhere: a place outside the matrix")
    if rank_of([[rows[i][j] for j in claim.columns] for i in claim.rows]) != rank:
        raise rejected("everywhere: the minor is 0")
    if claim.route == "full":
        if rank != min(len(rows), size):
            raise rejected("everywhere: the rank is not the largest possible")
        return f"everywhere: rank {rank}, the largest possible, at almost every pose"
    if claim.route == "none":
        return f"everywhere: rank {rank} was met, a larger one is not excluded"
    if claim.route == "combination":
        _check_combinations(mechanism, forms, claim.combinations, rank)
    else:
        _check_grid(mechanism, forms, rank)
    return f"everywhere: rank {rank} at most, at every pose"


def _check_combinations(
    mechanism: Mechanism, forms: Sequence[Form], combinations: Sequence[tuple[Fraction, ...]], rank: int
) -> None:
    if any(len(factors) != len(forms) for factors in combinations):
        raise malformed("everywhere.combinations: not a number for each row")
    if rank != len(forms) - len(combinations):
        raise rejected("everywhere: not the rank that the combinations leave")
    table = [[exact(x) for x in factors] for factors in combinations]
    if rank_of(table) != len(table):
        raise rejected("everywhere.combinations: not independent")
    slopes = [[exact(x) for x in form[:16]] for form in forms]
    words = words_of(table) + words_of(slopes)
    charge(len(table) * len(forms) * 16 * (300 + words * words))
    sums = [tuple(Fraction(int(x.p), int(x.q)) for x in row) for row in (fmpq_mat(table) * fmpq_mat(slopes)).tolist()]
    if rank_beside(sums, [form[:16] for form in mechanism.vanishing]):
        raise rejected("everywhere.combinations: not 0 at every pose")


def _check_grid(mechanism: Mechanism, forms: Sequence[Form], rank: int) -> None:
    """No pose of the grid has a greater rank."""
    group = mechanism.group
    moments = sum(k >= 3 for k in group.twists)
    turn = 2 * (rank + 1) if moments else 0
    move = min(rank, moments) + 1 if 0 in group.twists else 0
    turns = _simplex([k for k in group.support if 1 <= k <= 3], turn, 4)
    moves = _simplex([k for k in group.twists if k < 3], move, 3)
    number = len(turns) * len(moves)
    if number > MOST_POSES:
        raise too_large(f"everywhere: a grid of more than {MOST_POSES} poses")
    table = fmpz_mat([cleared(form)[:16] for form in forms])
    words = words_of([[fmpq(x) for x in row] for row in table.tolist()])
    charge(number * (200_000 + 2000 * len(forms) * (1 + words)))

    def is_greater(pose: tuple[list[int], list[int]]) -> bool:
        angles, position = pose
        placed = motion((1, *angles[1:]), (0, 0, 0, 0), mechanism.metric)
        basis = wrench_basis(mechanism.metric, position, placed.rotation, placed.norm, group.twists)
        return int((table * fmpz_mat(basis)).rank()) > rank

    if any(map(is_greater, product(turns, moves))):
        raise rejected("everywhere: the rank is greater at a pose of the grid")


def _simplex(places: Sequence[int], degree: int, size: int) -> list[list[int]]:
    """All whole vectors with entries that are not negative, 0 but at these places, of a sum of at most the degree."""
    found = [[0] * size]
    for place in places:
        found = [
            [*point[:place], value, *point[place + 1 :]] for point in found for value in range(degree - sum(point) + 1)
        ]
    return found
