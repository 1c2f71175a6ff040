"""The tree of a paving in arrays, beside the parts themselves."""

from __future__ import annotations

import random
from fractions import Fraction
from itertools import combinations

import numpy as np
import pytest

from pkm_exact.regions.paving import Part, depths_at, leaves
from pkm_exact.regions.paving_tree import PavingTree, joined


def _word(chosen: random.Random, depth: int) -> str:
    if depth and chosen.random() < 0.8:
        return f"s{_word(chosen, depth - 1)}{_word(chosen, depth - 1)}"
    return chosen.choice("iou")


def _ends(part: Part, axes: tuple[int, ...], variables: int) -> list[tuple[Fraction, Fraction]]:
    depths = depths_at(axes, part.depth, variables)
    return [
        (Fraction(place, 1 << depth), Fraction(place + 1, 1 << depth))
        for place, depth in zip(part.places, depths, strict=True)
    ]


def _share_a_face(one: list[tuple[Fraction, Fraction]], other: list[tuple[Fraction, Fraction]]) -> bool:
    common = [min(a[1], b[1]) - max(a[0], b[0]) for a, b in zip(one, other, strict=True)]
    return sorted(width > 0 for width in common) == [False] + [True] * (len(common) - 1) and min(common) == 0


@pytest.mark.parametrize("seed", range(8))
def test_faces_shares_and_depths_are_those_of_the_parts(seed: int) -> None:
    chosen = random.Random(seed)
    variables, depth = 1 + seed % 3, 6
    axes = tuple(chosen.randrange(variables) for _ in range(depth))
    word = _word(chosen, depth)
    found, tree = leaves(word, axes, variables), PavingTree(word)
    places = [k for k, letter in enumerate(word) if letter != "s"]
    assert tree.depths()[places].tolist() == [part.depth for _, part in found]
    for letter, share in zip("iou", tree.shares("iou"), strict=True):
        assert share == sum(Fraction(1, 1 << part.depth) for own, part in found if own == letter)
    boxes = [_ends(part, axes, variables) for _, part in found]
    expected = {
        (places[j], places[k]) for j, k in combinations(range(len(boxes)), 2) if _share_a_face(boxes[j], boxes[k])
    }
    pairs = list(zip(*(side.tolist() for side in tree.touching(axes)), strict=True))
    assert {(min(pair), max(pair)) for pair in pairs} == expected
    assert len(pairs) == len(expected)


def test_pieces_of_a_chain_and_of_a_star() -> None:
    order = np.array(random.Random(2).sample(range(1, 60), 59))
    for one in (order[:-1], np.full(58, order[7])):
        first = joined(60, one, order[1:])
        assert first[0] == 0
        assert set(first[np.union1d(one, order[1:])].tolist()) == {int(min(np.union1d(one, order[1:])))}
