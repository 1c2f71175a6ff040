"""Colours, text and defaults of all pictures: legible without colour vision, the same on every machine."""

from __future__ import annotations

from collections.abc import Iterator
from contextlib import contextmanager
from functools import cache
from typing import Any, Final

from pkm_exact.errors import InputError
from pkm_exact.pictures.drawn_robot import BAR, BODY, Part
from pkm_exact.wording import printable

LEG_COLOURS: Final = ("#D55E00", "#0072B2", "#009E73", "#CC79A7", "#E69F00", "#56B4E9")
"""One per leg. M. Okabe, K. Ito, Color Universal Design (2008): told apart by colour-blind readers too."""
SHAPE_DASHES: Final[dict[str, Any]] = {
    "body": "-",
    "bar": "-",
    "plane": "-",
    "line": "--",
    "axis": "-.",
    "point": ":",
    "arm": "-",
    "strut": "-",
    "arc": "-",
    "axes": "-.",
}
"""Lines of constraints that are no legs, and of parts, by what they are."""
PLATFORM_FILL: Final = "#F0E442"
BASE_FILL: Final = "#B8B8B8"
INK: Final = "#202020"
BASE_INK: Final = "#606060"
SIGN_COLOURS: Final = {1: "#0072B2", -1: "#D55E00", 0: "#202020", None: "#808080"}
"""Of ghosts, by the sign of det J."""
GHOST_INK: Final = "#909090"
DASHES: Final = {"crank": (0.0, (1.0, 0.0)), "slide": (0.0, (1.6, 0.8))}
"""Line styles of cranks and slides."""
CABLE: Final = 0.45
"""How wide a cable is, by the width of a leg."""
LONGEST_NAME: Final = 48

_DEFAULTS: Final[dict[Any, Any]] = {
    "font.family": ["DejaVu Sans"],
    "svg.hashsalt": "pkm_exact",
    "svg.fonttype": "path",
    "axes.unicode_minus": False,
    "text.parse_math": False,
}


def require_matplotlib() -> None:
    """Refuse to draw without matplotlib."""
    try:
        import matplotlib.figure  # noqa: F401 - is it there?
    except ImportError:
        raise InputError("pictures need matplotlib, which is not installed; pip install 'pkm_exact[plots]'") from None


@contextmanager
def plain_style() -> Iterator[None]:
    """Matplotlib's defaults and ours, whatever the user's settings are; these come back at the end."""
    require_matplotlib()
    import matplotlib as mpl

    with mpl.rc_context():
        mpl.rcdefaults()
        mpl.rcParams.update(_DEFAULTS)
        yield


def drawable(text: str, longest: int = LONGEST_NAME) -> str:
    """The text, on one line and not too long, with every character that the font lacks written as an escape.

    Examples
    --------
    >>> drawable("Stewart–Gough\\n€")
    'Stewart–Gough\\\\n€'
    """
    known = _characters()
    escaped = "".join(c if ord(c) in known else ascii(c)[1:-1] for c in printable(text[: longest + 1]))
    return escaped if len(escaped) <= longest else f"{escaped[: longest - 3]}..."


@cache
def _characters() -> frozenset[int]:
    """The characters that the font has."""
    from matplotlib.font_manager import FontProperties, findfont, get_font

    return frozenset(get_font(findfont(FontProperties(family="DejaVu Sans"))).get_charmap())


def leg_colour(number: int) -> str:
    """The colour of a leg or another constraint, by its number from 1; they are used again after the last.

    >>> leg_colour(1) == leg_colour(7)
    True
    """
    return LEG_COLOURS[(number - 1) % len(LEG_COLOURS)]


def part_colour(part: Part) -> str:
    """The colour of a passive body, by its number; bars are dark, lines and planes pale."""
    return leg_colour(part.number) if part.kind == BODY else INK if part.kind == BAR else GHOST_INK
