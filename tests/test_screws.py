"""Screw systems: geometry of single screws, and ranks beside an elimination that shares nothing with FLINT."""

from fractions import Fraction
from itertools import combinations
from random import Random

import pytest

from pkm_exact import InputError, Screw, ScrewSystem
from pkm_exact.screws.exact_matrix import null_space, rank

X, Y, Z = (1, 0, 0), (0, 1, 0), (0, 0, 1)


def _eliminated(rows: list[list[Fraction]]) -> int:
    """The rank by elimination in fractions, one pivot after another."""
    rows, found = [list(row) for row in rows], 0
    for column in range(len(rows[0]) if rows else 0):
        pivot = next((row for row in rows if row[column]), None)
        if pivot is None:
            continue
        rows.remove(pivot)
        found += 1
        for row in rows:
            factor = row[column] / pivot[column]
            row[:] = [a - factor * b for a, b in zip(row, pivot, strict=True)]
    return found


def _random_screws(random: Random) -> list[Screw]:
    """Screws of small numbers, so that dependent ones are not rare: lines, couples and helices."""
    screws = []
    for _ in range(random.randint(1, 8)):
        along = (0, 0, 0)
        while not any(along):
            along = tuple(Fraction(random.randint(-1, 2), random.randint(1, 2)) for _ in range(3))
        point = [random.randint(-1, 1) for _ in range(3)]
        kind = random.randrange(3)
        if kind == 0:
            screws.append(Screw.couple(along))
        else:
            screws.append(Screw.line(point, along, 0 if kind == 1 else Fraction(random.randint(-2, 2), 3)))
    return screws


def _examine(seed: int) -> int:
    random = Random(seed)
    one, other = _random_screws(random), _random_screws(random)
    first, second = ScrewSystem.span(one), ScrewSystem.span(other)
    assert first.rank == _eliminated([list(screw.coordinates) for screw in one])
    both = _eliminated([list(screw.coordinates) for screw in (*one, *other)])
    assert (first | second).rank == both
    assert (first & second).rank == first.rank + second.rank - both
    assert (first & second) <= first
    reciprocal = first.reciprocal()
    assert reciprocal.rank == 6 - first.rank
    assert all(a.is_reciprocal(b) for a in one for b in reciprocal.screws())
    assert reciprocal.reciprocal() == first
    motions = first.free_motions()
    twists = [*(Screw.couple(v) for v in motions.translations), *motions.turns]
    assert ScrewSystem.span(twists) == first
    assert motions.number == len(twists) == first.rank
    return first.rank


@pytest.mark.parametrize("part", range(10))
def test_random_systems_have_the_ranks_of_an_elimination(part: int) -> None:
    seen = {_examine(seed) for seed in range(10 * part, 10 * part + 10)}
    assert len(seen) > 1


@pytest.mark.slow
def test_a_thousand_random_systems_have_the_ranks_of_an_elimination() -> None:
    assert {_examine(seed) for seed in range(1000, 2000)} == {1, 2, 3, 4, 5, 6}


def test_pitch_axis_and_foot_are_recovered() -> None:
    screw = Screw.line((1, 2, 3), (2, -1, 2), "5/7")
    assert screw.pitch == Fraction(5, 7)
    foot = screw.foot
    assert foot is not None
    assert sum(a * b for a, b in zip(foot, screw.direction, strict=True)) == 0
    assert Screw.line(foot, screw.direction, "5/7") == screw
    assert Screw.couple(X).pitch is None
    assert Screw.couple(X).foot is None


def test_lines_are_reciprocal_exactly_if_they_meet() -> None:
    hinge = Screw.line((0, 0, 0), Z)
    assert hinge.is_reciprocal(Screw.line((0, 0, 7), (1, 2, 3)))
    assert hinge.is_reciprocal(Screw.line((4, 5, 6), Z))
    assert not hinge.is_reciprocal(Screw.line((1, 0, 0), Y))


@pytest.mark.parametrize(
    ("screws", "rank"),
    [
        ([Screw.couple(X), Screw.couple(Y)], 2),
        ([Screw.line((0, 0, 0), X), Screw.line((0, 0, 0), Y)], 3),
        ([Screw.line((0, 0, 0), Z), Screw.line((1, 0, 0), Z)], 3),
        ([Screw.line((0, 0, 0), Z), Screw.couple(Z)], 2),
        ([Screw.line((0, 0, 0), Z), Screw.couple(X)], 3),
        ([Screw.line((0, 0, 0), Z, 2), Screw.couple(X)], 3),
        ([Screw.line((0, 0, 0), Z), Screw.line((1, 0, 0), Z), Screw.couple(Z)], 4),
        ([Screw.line((0, 0, 0), Z), Screw.line((0, 1, 0), X)], 6),
    ],
)
def test_the_groups_that_screws_generate(screws: list[Screw], rank: int) -> None:
    assert ScrewSystem.span(screws).algebra().rank == rank


@pytest.mark.parametrize(
    ("screws", "words"),
    [
        ([], "no rotation and no translation"),
        ([Screw.line((1, 2, 0), Z)], "1 rotation about an axis along (0, 0, 1) through (1, 2, 0)"),
        ([Screw.line((1, 0, 0), Z, 3)], "1 screw motion of pitch 3 about an axis along (0, 0, 1) through (1, 0, 0)"),
        ([Screw.couple(X), Screw.couple((1, 1, 0))], "2 translations perpendicular to (0, 0, 1)"),
        (
            [Screw.line((0, 0, 5), axis) for axis in (X, Y, Z)],
            "3 rotations about axes in all directions through (0, 0, 5)",
        ),
        (
            [Screw.line((0, 0, 1), X), Screw.line((0, 0, 1), Y)],
            "2 rotations about axes perpendicular to (0, 0, 1) through (0, 0, 1)",
        ),
        (
            [Screw.line((0, 0, 0), X), Screw.line((0, 0, 1), Y)],
            ", ".join(
                f"1 rotation about an axis along {along} through {through}"
                for along, through in (("(1, 0, 0)", "(0, 0, 0)"), ("(0, 1, 0)", "(0, 0, 1)"))
            ),
        ),
        (
            [Screw.line((3, 4, 0), Z, 7), Screw.couple(Z)],
            "1 translation along (0, 0, 1), 1 rotation about an axis along (0, 0, 1) through (3, 4, 0)",
        ),
    ],
)
def test_free_motions_in_words(screws: list[Screw], words: str) -> None:
    assert str(ScrewSystem.span(screws).free_motions()) == words


@pytest.mark.parametrize(
    ("make", "words"),
    [
        (lambda: Screw.line((0, 0, 0), (0, 0, 0)), "direction: is 0"),
        (lambda: Screw.couple((0, 0, 0)), "direction: is 0"),
        (lambda: Screw.line((0.5, 0, 0), Z), "binary float"),
        (lambda: Screw.line((0, 0), Z), "list of 3 numbers"),
    ],
)
def test_what_is_no_screw_is_refused(make: object, words: str) -> None:
    with pytest.raises(InputError, match=words):
        make()  # type: ignore[operator]


# What the grasp of a hand, chapter 20 of the source, has for internal forces: nullities of G.


def _grasp(points: list[tuple[int, ...]], wrenches: list[list[list[int]]]) -> list[list[int]]:
    """The columns of all contacts: forces and moments about the origin."""
    columns = []
    for point, contact in zip(points, wrenches, strict=True):
        for force in contact:
            along, moment = force[:3], force[3:]
            arm = Screw.line(point, along).moment if any(along) else (0, 0, 0)
            columns.append([*along, *(a + b for a, b in zip(arm, moment, strict=True))])
    return [list(row) for row in zip(*columns, strict=True)]


def test_internal_forces_of_a_grasp() -> None:
    fingers = [(-3, 1, 0), (3, 4, 0), (3, 2, 0), (3, 0, 0), (3, -2, 0)]
    planar = [[[1, 0, 0, 0, 0, 0], [0, 1, 0, 0, 0, 0]]] * 5
    rows = [_grasp(fingers, planar)[k] for k in (0, 1, 5)]
    assert (rank(rows, 10), len(null_space(rows, 10))) == (3, 7)
    migrating = [[*contact, [0, 0, 0, 0, 0, 1]] for contact in planar]
    rows = [_grasp(fingers, migrating)[k] for k in (0, 1, 5)]
    assert len(null_space(rows, 15)) == 12
    every = [[[int(i == j) for j in range(6)] for i in range(6)]] * 5
    assert len(null_space(_grasp(fingers, every), 30)) == 24
    assert all(len(null_space(_grasp(list(some), every[:2]), 12)) >= 6 for some in combinations(fingers, 2))
