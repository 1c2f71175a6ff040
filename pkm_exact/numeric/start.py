"""A generic section of the rigid motions and its 40 solutions, from which all others are tracked.

Six leg forms of a robot with random complex joints and lengths, found by monodromy: one solution is chosen first and
legs through it, then loops in the space of leg forms permute the solutions until there are 40, the degree of the rigid
motions. `python -m pkm_exact.numeric.start` computes it again. The same for every smaller group of motions: planar
robots have three legs and 6 solutions.
"""

from __future__ import annotations

import json
import sys
from dataclasses import dataclass
from functools import cache
from importlib.resources import files
from pathlib import Path
from typing import Final

import numpy as np

from pkm_exact.motions.motion import Motion
from pkm_exact.motions.motion_groups import MOTIONS
from pkm_exact.numeric.study_system import Complex, Frames, leg_forms, motion_values, section_quadrics
from pkm_exact.numeric.tracker import normalised, polished, track

SEED: Final = 20081125
SIZES: Final = {"base": 0.6, "platform": 0.4, "square": 0.5}
"""Typical joints and squared lengths of normalised robots."""
_ROUNDS: Final = 40
SAME: Final = 1e-8


@dataclass(frozen=True)
class StartSection:
    """Leg forms and all solutions of their section.

    Attributes
    ----------
    legs : (m, 17) complex array
    solutions : (p, n) complex array
        p = 40 and n = 8, or 6 and 4 if planar, ..: the degree, and the number of coordinates.
    frames : Frames or None
        Those of the robot for which the section was made: of a robot that is tracked from here, they are used as well.
    home : (p, n) complex array or None
        All solutions of this robot itself, in these frames, if they were found; of two that are conjugate, one.
    has_long_paths : bool
        Whether paths to this robot take so many steps that other ways are tried before them.
    """

    legs: Complex
    solutions: Complex
    frames: Frames | None = None
    home: Complex | None = None
    has_long_paths: bool = False


@cache
def generic_start(motion: Motion) -> StartSection:
    """The shipped section of a group of motions."""
    text = files("pkm_exact.numeric").joinpath("start.json").read_text(encoding="utf-8")
    entry = json.loads(text)[motion.name]
    return StartSection(_complex(entry["legs"]), _complex(entry["solutions"]))


def start_quadrics(start: StartSection, seed: int, motion: Motion) -> Complex:
    """The symmetric matrices of a section's equations, from which paths start.

    Each is multiplied by a random complex number of size 1, which changes the paths and not the solutions; with seed 0
    by 1.
    """
    quadrics = section_quadrics(start.legs, motion)
    turns = np.random.default_rng(seed).random(len(quadrics)) if seed else np.zeros(len(quadrics))
    turned: Complex = quadrics * np.exp(2j * np.pi * turns)[:, None, None]
    return turned


def _complex(rows: list[list[list[float]]]) -> Complex:
    array = np.array(rows, dtype=float)
    values: Complex = array[..., 0] + 1j * array[..., 1]
    return values


def find_start(seed: int, motion: Motion) -> StartSection:
    """A section with random complex legs and all its solutions, by monodromy.

    Raises
    ------
    RuntimeError
        If loops stop finding solutions before there are all of them.
    """
    random = np.random.default_rng(seed)
    first = _random_motion(random, motion)
    legs = _random_legs(random, motion)
    quantities = motion_values(first)
    legs[:, -1] -= legs @ quantities / quantities[-1]
    solutions = normalised(first[None, list(motion.support)])
    here = section_quadrics(legs, motion)
    for _ in range(_ROUNDS):
        stations = [section_quadrics(_random_legs(random, motion), motion) for _ in range(2)]
        points, arrived = solutions, np.ones(len(solutions), dtype=bool)
        for start, target in zip([here, *stations], [*stations, here], strict=True):
            points, ended = track(points, start, target)
            arrived &= ended
        points, change = polished(points, here)
        solutions = joined(solutions, points[arrived & (change < SAME)])
        if len(solutions) == motion.degree:
            return StartSection(legs, polished(solutions, here)[0])
    raise RuntimeError(f"{len(solutions)} of {motion.degree} solutions were found; take another seed")


def _random_legs(random: np.random.Generator, motion: Motion) -> Complex:
    count = motion.dimension
    base, platform = (_gaussian(random, count, 3) * SIZES[name] for name in ("base", "platform"))
    if motion.is_planar:
        base[:, 2] = platform[:, 2] = 0
    return leg_forms(base, platform, 1 + _gaussian(random, count) * SIZES["square"]).astype(np.complex128)


def _random_motion(random: np.random.Generator, motion: Motion) -> Complex:
    e, f = _gaussian(random, 4), _gaussian(random, 4)
    point = np.concatenate([e, f])
    point[[k for k in range(len(point)) if k not in motion.support]] = 0
    if motion.has_study_condition:
        e = point[:4]
        point[4:] -= (e @ point[4:]) / (e @ e) * e
    return point


def _gaussian(random: np.random.Generator, *shape: int) -> Complex:
    values: Complex = (random.standard_normal(shape) + 1j * random.standard_normal(shape)) / np.sqrt(2)
    return values


def joined(known: Complex, further: Complex) -> Complex:
    """The known projective points, of norm 1, and those of the others that are new."""
    for point in normalised(further):
        if np.max(np.abs(known.conj() @ point), initial=0) < 1 - SAME:
            known = np.concatenate([known, point[None]])
    return known


def main() -> int:
    """Compute all sections again and write them beside this module."""
    content = {}
    for motion in MOTIONS.values():
        start = find_start(SEED, motion)
        content[motion.name] = {key: _pairs(getattr(start, key)) for key in ("legs", "solutions")}
    lines = json.dumps(content).replace("]], [[", "]],\n[[").replace('": [[[', '": [\n[[')
    Path(__file__).with_name("start.json").write_text(lines + "\n", encoding="utf-8")
    return 0


def _pairs(array: Complex) -> list[list[list[float]]]:
    pairs: list[list[list[float]]] = np.stack([array.real, array.imag], axis=-1).tolist()
    return pairs


if __name__ == "__main__":
    sys.exit(main())
