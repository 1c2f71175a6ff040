"""Krawczyk's operator: proof that a box holds exactly one solution of n equations F = 0 in n unknowns.

For a box X around a point m and any matrix Y,

    K(X) = m - Y F(m) + (1 - Y F'(X)) (X - m).

If K(X) lies in the interior of X, then X holds exactly one zero of F, and F' is regular all over X. Boxes are real, or
complex: rectangles in every coordinate. For quadrics this needs no mean value theorem: F(x) - F(y) =
F'((x + y) / 2) (x - y) exactly.

If F has parameters, and balls hold Y F(m) and Y F'(X) for all of them, all this holds for each of them. The equations
(``Equations``) are exact forms in a chart (``chart_equations``), legs with errors in their data (``linearisation``), or
legs that move along a path (``path_equations``).

References: Krawczyk, Computing 4 (1969); Moore, SIAM J. Numer. Anal. 14 (1977); Rump, "Solving algebraic problems with
high accuracy" (1983); Neumaier, Interval Methods for Systems of Equations (1990), section 5.1.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass
from typing import Protocol

from flint import arb

from pkm_exact.balls import Balls, box_around_zero, unit_matrix_for


class Equations(Protocol):
    """Y F near a point m. Y is multiplied in by them, as some do that before they round anything.

    Y may be any matrix; an approximate inverse of F'(m) will do.
    """

    @property
    def is_real(self) -> bool:
        """Whether F and m are real, and only real solutions are meant."""

    @property
    def residual(self) -> Balls:
        """Y F(m), a column."""

    def jacobian(self, box: Balls) -> Balls:
        """Y F'(X), with the box X given moved to 0."""


@dataclass(frozen=True, eq=False)
class Image:
    """The image of a box.

    Attributes
    ----------
    contracted : column of balls
        (1 - Y F'(X)) (X - m): what is left of the width of the box.
    moved : column of balls
        K(X) - m.
    """

    contracted: Balls
    moved: Balls


def contraction(near: Equations, box: Balls) -> Balls:
    """1 - Y F'(X), with the box X given moved to 0."""
    return unit_matrix_for(box) - near.jacobian(box)


def krawczyk(near: Equations, box: Balls) -> Image:
    """The image of the box X, which is given moved to 0."""
    contracted = contraction(near, box) * box
    return Image(contracted, contracted - near.residual)


def is_inside(near: Equations, image: Image, radii: Sequence[arb]) -> bool:
    """Whether an image lies in the interior of the box with these radii around m."""
    return all(
        abs(value.real) < radius and (value.imag == 0 if near.is_real else abs(value.imag) < radius)
        for value, radius in zip(image.moved.entries(), radii, strict=True)
    )


def around_zero(near: Equations, radii: Sequence[arb]) -> Balls:
    """The box with these radii, moved to 0."""
    return box_around_zero(radii, type(near.residual), real=near.is_real)


def holds_one(near: Equations, radii: Sequence[arb]) -> bool:
    """Whether the box with these radii is proved to hold exactly one solution. "No" means only that the proof fails."""
    return is_inside(near, krawczyk(near, around_zero(near, radii)), radii)


def inflated(
    near: Equations, radii: Sequence[arb], enlarged: Callable[[Sequence[Balls]], list[arb]], tries: int
) -> tuple[Sequence[arb], Image] | None:
    """Radii of a box that is proved to hold exactly one solution, and its image; None if none was found.

    Parameters
    ----------
    near : Equations
    radii : sequence of arb
        The first to be tried.
    enlarged : callable
        Gives those that are tried next, from the image of a box that does not hold it.
    tries : int
    """
    for _ in range(tries):
        image = krawczyk(near, around_zero(near, radii))
        if is_inside(near, image, radii):
            return radii, image
        radii = enlarged(image.moved.entries())
        if not all(radius < 1 for radius in radii):
            return None
    return None
