"""The roots of a certificate's eliminant h: its arcs and isolating intervals on the real axis, and the complex plane.

A pose of the robot, real or complex, is a root of h. Real roots may differ by factors of 10^9, so that axes are
stretched around 0, u = asinh(t / c), and each arc of h between two real roots is scaled to height 1.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from fractions import Fraction
from itertools import pairwise
from math import asinh, ceil, floor, inf, log10, sinh
from typing import TYPE_CHECKING, Any, Final, cast

from pkm_exact.certify.legs_view import legs_view
from pkm_exact.errors import InputError
from pkm_exact.pictures import captions, style
from pkm_exact.pictures.scene import LARGEST
from pkm_exact.precision import working_precision
from pkm_exact.wording import counted

if TYPE_CHECKING:
    from flint import acb, fmpz_poly
    from matplotlib.axes import Axes
    from matplotlib.figure import Figure

SIZE: Final = (8.0, 6.4)
LEAST: Final = 4
"""Inches of the smallest figure, both ways."""
SAMPLES: Final = 160
"""Steps in which an arc is drawn."""
_NUMBER_WIDTH: Final = 0.19
"""Inches between the numbers of neighbouring roots."""
_LINEAR_UP_TO: Final = 50.0
"""The axes are not stretched unless the sizes of roots differ by this factor."""
_REAL: Final = "#D55E00"
_COMPLEX: Final = "#0072B2"


@dataclass(frozen=True)
class Stretch:
    """The axis u = asinh(t / unit), or u = t if the unit is infinite."""

    unit: float

    def of(self, t: float) -> float:
        """Where t is drawn."""
        return t if self.unit == inf else asinh(t / self.unit)

    def back(self, u: float) -> float:
        """What is drawn at u."""
        return u if self.unit == inf else self.unit * sinh(u)

    def ticks(self, largest: float) -> list[float]:
        """Zero and powers of ten of both signs up to a number, five of each at most.

        Examples
        --------
        >>> Stretch(0.5).ticks(200)
        [-100.0, -10.0, -1.0, 0.0, 1.0, 10.0, 100.0]
        """
        first, last = ceil(log10(self.unit)), floor(log10(largest))
        step = max(1, ceil((last - first + 1) / 5))
        powers = [10.0**k for k in range(last, first - 1, -step)]
        return [*(-power for power in powers), 0.0, *reversed(powers)]


@dataclass(frozen=True)
class Roots:
    """The roots of h in doubles.

    Attributes
    ----------
    polynomial : fmpz_poly
        h, squarefree.
    real : tuple of float
        Increasing.
    intervals : tuple of pairs of Fraction
        Their isolating intervals as the certificate has them, in the same order.
    numbers : tuple of int
        The poses that they are.
    all : tuple of complex
        The real ones too.
    """

    polynomial: fmpz_poly
    real: tuple[float, ...]
    intervals: tuple[tuple[Fraction, Fraction], ...]
    numbers: tuple[int, ...]
    all: tuple[complex, ...]


def roots_figure(document: Mapping[str, Any], *, size: tuple[float, float] | None = None) -> Figure:
    """The eliminant of an accepted certificate over the real axis, and all its roots in the complex plane.

    Parameters
    ----------
    document : mapping
        From ``scene.accepted_document``.
    size : pair of float, optional
        Width and height in inches.

    Raises
    ------
    InputError
        If the certificate has no eliminant, or one of witnesses of positive dimension only.
    """
    roots = _roots(document)
    stretch = _stretch(roots)
    with style.plain_style():
        from matplotlib.figure import Figure

        figure = Figure(figsize=size or SIZE)
        width, height = figure.get_size_inches()
        if min(width, height) < LEAST:
            raise InputError(f"size: the roots need at least {LEAST},{LEAST} inches; give more")
        rest = (height - 1.9) / height
        left, across = 0.95 / width, 1 - 1.1 / width
        plane = figure.add_axes((left, 0.55 / height, across, 0.55 * rest), label="complex plane")
        arcs = figure.add_axes((left, 0.65 / height + 0.55 * rest, across, 0.45 * rest), sharex=plane, label="arcs")
        _draw_plane(plane, roots, stretch)
        _draw_arcs(arcs, roots, stretch)
        _number(arcs, roots, stretch, across * width)
        for axes in (plane, arcs):
            axes.yaxis.set_label_coords(-0.7 / (across * width), 0.5)
        _headline(figure, document, roots)
        return figure


def _roots(document: Mapping[str, Any]) -> Roots:
    from flint import fmpz_poly

    representation = document.get("representation")
    if representation is None:
        why = (
            "its solutions are in boxes of Krawczyk's operator; solve with --method exact"
            if document.get("krawczyk")
            else "there are no solutions to list"
        )
        raise InputError(f"representation: the certificate has no eliminant whose roots could be drawn, {why}")
    if document["claim"] == "positive-dimensional-proved":
        raise InputError(
            "representation: the eliminant is one of witnesses of positive dimension, its roots are not the poses; "
            "draw the poses instead"
        )
    h = fmpz_poly([int(text, 16) for text in representation["eliminant"]])
    found = [root for root, _ in cast("list[tuple[acb, int]]", h.complex_roots())]
    listed = sorted(
        (Fraction(pose["parameter"][0]), Fraction(pose["parameter"][1]), number)
        for number, pose in enumerate(document["poses"], 1)
    )
    everywhere = tuple(complex(root) for root in found)
    if not all(abs(root) < LARGEST for root in everywhere):
        raise InputError("representation: the roots of the eliminant are too large to be drawn")
    return Roots(
        h,
        tuple(sorted(float(root.real) for root in found if root.imag == 0)),
        tuple((low, high) for low, high, _ in listed),
        tuple(number for _, _, number in listed),
        everywhere,
    )


def _stretch(roots: Roots) -> Stretch:
    """Linear where the roots are of similar size; otherwise stretched so that the smallest real ones are seen."""
    sizes = [abs(root) for root in roots.real if root] or [abs(root) for root in roots.all if root]
    largest = max((abs(root) for root in roots.all), default=0.0)
    if not sizes or largest < _LINEAR_UP_TO * min(sizes):
        return Stretch(inf)
    return Stretch(max(min(sizes), 1e-12 * largest))


def _draw_plane(axes: Axes, roots: Roots, stretch: Stretch) -> None:
    """All roots, real ones filled."""
    others = [root for root in roots.all if root.imag]
    axes.axhline(0, color=style.BASE_INK, linewidth=0.8)
    axes.plot(
        [stretch.of(root.real) for root in others],
        [stretch.of(root.imag) for root in others],
        linestyle="none",
        marker="o",
        markersize=5,
        markerfacecolor="white",
        markeredgecolor=_COMPLEX,
        clip_on=False,
    )
    real = [stretch.of(root) for root in roots.real]
    axes.plot(real, [0.0] * len(real), linestyle="none", marker="o", markersize=5, color=_REAL, clip_on=False)
    largest = max((stretch.of(abs(root)) for root in roots.all), default=0.0)
    for axis, parts in ((axes.xaxis, [root.real for root in roots.all]), (axes.yaxis, [r.imag for r in roots.all])):
        reach = max(map(abs, parts), default=0.0) or 1.0
        ends = [stretch.of(min(parts, default=-1.0)), stretch.of(max(parts, default=1.0))]
        pad = max(0.06 * (ends[1] - ends[0]), 0.1 * largest) or 1.0
        axis.axes.set(**{f"{axis.axis_name}lim": (ends[0] - pad, ends[1] + pad)})
        if stretch.unit < inf:
            ticks = stretch.ticks(reach)
            axis.set_ticks([stretch.of(tick) for tick in ticks], [f"{tick:g}" for tick in ticks], fontsize=8)
        else:
            axis.set_tick_params(labelsize=8)
    axes.set_xlabel("real part of t" + ("" if stretch.unit == inf else ", stretched around 0"))
    axes.set_ylabel("imaginary part of t")
    axes.grid(visible=True, color="#E0E0E0", linewidth=0.6)
    axes.set_axisbelow(True)


def _draw_arcs(axes: Axes, roots: Roots, stretch: Stretch) -> None:
    """h between its real roots, each arc scaled to height 1, and the isolating intervals."""
    axes.axhline(0, color=style.BASE_INK, linewidth=0.8)
    low, high = map(float, axes.get_xlim())
    ends = [low, *(stretch.of(root) for root in roots.real), high]
    for start, end in pairwise(ends):
        across = [start + (end - start) * k / SAMPLES for k in range(SAMPLES + 1)]
        # At a root, rounded to a double, the value is 0 and not what rounding leaves.
        inner = [u for u in across[1:-1] if start < u < end]
        before, after = [low] if start == low else [], [high] if end == high else []
        drawn = [*before, *inner, *after]
        heights = _scaled_values(roots.polynomial, [stretch.back(u) for u in drawn])
        zeros = [] if before else [(start, 0.0)], [] if after else [(end, 0.0)]
        axes.plot(
            *zip(*zeros[0], *zip(drawn, heights, strict=True), *zeros[1], strict=True), color=style.INK, linewidth=1.2
        )
    for left, right in roots.intervals:
        axes.axvspan(stretch.of(float(left)), stretch.of(float(right)), color=_REAL, alpha=0.5, linewidth=0.8)
    axes.plot(ends[1:-1], [0.0] * len(roots.real), linestyle="none", marker="o", markersize=4, color=_REAL)
    axes.set_ylim(-1.25, 1.25)
    axes.set_yticks([-1, 0, 1], ["-", "0", "+"])
    axes.set_ylabel("h(t), arcs scaled")
    axes.tick_params(labelbottom=False)


def _scaled_values(h: fmpz_poly, places: Sequence[float]) -> list[float]:
    """The values at exact doubles, divided by the largest of them."""
    from flint import arb, fmpq

    values = [h(fmpq(*place.as_integer_ratio())) for place in places]
    largest = max(map(abs, values), default=fmpq(0))
    with working_precision(64):
        return [float(arb(value / largest)) if largest else 0.0 for value in values]


def _number(axes: Axes, roots: Roots, stretch: Stretch, inches: float) -> None:
    """The numbers of the poses above their roots, moved apart where they would overlap; the axes have this width."""
    low, high = map(float, axes.get_xlim())
    places = [(stretch.of(root) - low) / (high - low) for root in roots.real]
    step = min(_NUMBER_WIDTH / inches, 1 / max(1, len(places)))
    size = min(8.0, 8.0 * step * inches / _NUMBER_WIDTH)
    if places:
        axes.text(-0.25 / inches, 1.09, "pose", transform=axes.transAxes, fontsize=8, ha="right", va="bottom")
    for number, place, shifted in zip(roots.numbers, places, spread(places, step), strict=True):
        axes.annotate(
            str(number),
            (place, 1.0),
            (shifted, 1.09),
            xycoords="axes fraction",
            ha="center",
            va="bottom",
            fontsize=size,
            annotation_clip=False,
            arrowprops={"arrowstyle": "-", "color": _REAL, "linewidth": 0.6, "shrinkA": 0, "shrinkB": 0},
        )


def spread(places: Sequence[float], step: float) -> list[float]:
    """Increasing places in [0, 1] moved as little as possible, in sum of squares, until neighbours are a step apart.

    Pool adjacent violators: places less k steps must not decrease.

    Examples
    --------
    >>> spread([0.5, 0.5, 0.9], 0.25)
    [0.375, 0.625, 0.9]
    """
    pools: list[tuple[float, int]] = []
    for k, place in enumerate(places):
        pools.append((place - k * step, 1))
        while len(pools) > 1 and pools[-2][0] > pools[-1][0]:
            (a, m), (b, n) = pools[-2:]
            pools[-2:] = [((a * m + b * n) / (m + n), m + n)]
    levels = [level for level, count in pools for _ in range(count)]
    most = 1 - (len(places) - 1) * step
    return [min(max(level, 0.0), most) + k * step for k, level in enumerate(levels)]


def _headline(figure: Figure, document: Mapping[str, Any], roots: Roots) -> None:
    widest = max((high - low for low, high in roots.intervals), default=Fraction(0))
    if not roots.real:
        wide = "no real root"
    elif widest == 0:
        wide = "real roots known exactly"
    else:
        wide = f"isolating intervals at most {float(widest):.2g} wide"
    degree = roots.polynomial.degree()
    second = f"eliminant h of degree {degree}: {counted(len(roots.real), 'real root')}; {wide}"
    document = legs_view(document)
    robot = document["robot"]
    first = captions.headline(robot["name"], robot["kind"], document["configuration"]["name"])
    captions.add_headline(figure, first, second)
