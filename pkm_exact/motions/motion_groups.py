"""The groups of motions by their names. One row adds a group; the tests ask every row."""

from __future__ import annotations

from collections.abc import Mapping
from types import MappingProxyType
from typing import Final

from pkm_exact.motions.motion import IntegerForm, Motion

_PLACES: Final = {
    name: place
    for place, name in enumerate(("s", "u1", "u2", "u3", "c1", "c2", "c3", *(f"r{i}{j}" for i in "123" for j in "123")))
}


def _vanishing(*names: str) -> tuple[IntegerForm, ...]:
    """The forms that say that coordinates are 0, or 1 where "=1" is written behind."""
    forms = []
    for name in names:
        coordinate, one, _ = name.partition("=1")
        form = [0] * 17
        form[_PLACES[coordinate]], form[16] = 1, -1 if one else 0
        forms.append(tuple(form))
    return tuple(forms)


_TURN: Final = ("r13", "r23", "r31", "r32", "r33=1")

SPATIAL: Final = Motion("spatial", "all rigid motions", 6, 40, (), tuple(range(8)), tuple(range(6)))
PLANAR: Final = Motion(
    "planar",
    "motions in the plane of the first two axes",
    3,
    6,
    _vanishing("u3", "c3", *_TURN),
    (0, 3, 5, 6),
    (0, 1, 5),
)
SCHOENFLIES: Final = Motion(
    "schoenflies",
    "translations, and turns about the third axis",
    4,
    8,
    _vanishing(*_TURN),
    (0, 3, 4, 5, 6, 7),
    (0, 1, 2, 5),
)
TRANSLATION: Final = Motion(
    "translation",
    "translations",
    3,
    2,
    _vanishing("r11=1", "r12", "r13", "r21", "r22=1", "r23", "r31", "r32", "r33=1"),
    (0, 5, 6, 7),
    (0, 1, 2),
)
SPHERICAL: Final = Motion(
    "spherical",
    "turns about the origin",
    3,
    8,
    _vanishing("s", "u1", "u2", "u3", "c1", "c2", "c3"),
    (0, 1, 2, 3),
    (3, 4, 5),
)

MOTIONS: Final[Mapping[str, Motion]] = MappingProxyType(
    {motion.name: motion for motion in (SPATIAL, PLANAR, SCHOENFLIES, TRANSLATION, SPHERICAL)}
)
"""By name."""
