"""Figures as bytes of a file: the same figure gives the same bytes, without dates, names or random numbers."""

from __future__ import annotations

from io import BytesIO
from pathlib import Path
from typing import TYPE_CHECKING, Any, Final

from pkm_exact.errors import InputError
from pkm_exact.pictures.style import plain_style
from pkm_exact.wording import shown

if TYPE_CHECKING:
    from matplotlib.figure import Figure

MOST_PIXELS: Final = 40_000_000
DPI: Final = 150

_METADATA: Final[dict[str, dict[str, Any]]] = {
    "png": {"Software": None},
    "svg": {"Date": None},
    "pdf": {"CreationDate": None},
}


def picture_format(path: Path) -> str:
    """The format that the suffix of a path asks for.

    Examples
    --------
    >>> picture_format(Path("poses.SVG"))
    'svg'
    """
    suffix = path.suffix.lower().removeprefix(".")
    if suffix not in _METADATA:
        raise InputError(
            f"{path}: {shown(path.suffix)} is no known format of pictures; end the name with .png, .svg or .pdf"
        )
    return suffix


def figure_bytes(figure: Figure, suffix: str, *, dpi: int = DPI) -> bytes:
    """The content of a file of the format png, svg or pdf; dpi is the number of dots per inch of a png.

    Raises
    ------
    InputError
        If the picture would have too many pixels.
    """
    width, height = figure.get_size_inches()
    if suffix == "png" and width * height * dpi * dpi > MOST_PIXELS:
        raise InputError(
            f"dpi: {dpi} makes {width * dpi:.0f} by {height * dpi:.0f} pixels, more than {MOST_PIXELS // 10**6} "
            "million; give fewer, or a smaller size"
        )
    stream = BytesIO()
    with plain_style():
        figure.savefig(stream, format=suffix, dpi=dpi, metadata=_METADATA[suffix])
    return stream.getvalue()
