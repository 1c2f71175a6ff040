"""Charts of regions: poses as polynomials of a few variables, each of which runs through an interval.

The variables are coordinates of the platform's origin, and half tangents t of turns. In the metric g a turn
has cosine (1 - w t^2) / (1 + w t^2) and sine sqrt(w) 2 t / (1 + w t^2), w the product of the other two entries of g, so
that the rotation matrix in rational coordinates is a polynomial matrix over N, the product of the (1 + w t^2). With

    R = Rz(yaw) Ry(pitch) Rx(roll)

every entry of N R and of N C is a polynomial, and N is positive.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from fractions import Fraction
from typing import Any, Final, TypeAlias

from flint import Ordering, fmpq, fmpq_mpoly, fmpq_mpoly_ctx

from pkm_exact.constraints.form import Vector
from pkm_exact.geometry.inverse import Metric, Quaternion, rotation_of

POSITIONS: Final = ("x", "y", "z")
TURNS: Final = ("roll", "pitch", "yaw")
Pair: TypeAlias = tuple[Fraction, Fraction]
Polynomial: TypeAlias = fmpq_mpoly


@dataclass(frozen=True)
class Arc:
    """The points c + r ((1 - t^2) (u, v) + 2 t (-v, u)) / (1 + t^2), t half the tangent of the angle from (u, v).

    Attributes
    ----------
    center : tuple of 2 Fraction
    radius : Fraction
    middle : tuple of 2 Fraction
        (u, v), of length 1.
    """

    center: Pair
    radius: Fraction
    middle: Pair


@dataclass(frozen=True)
class Line:
    """The points start + t way.

    Attributes
    ----------
    start, way : vectors of 3 Fraction
        In coordinates of the model.
    """

    start: Vector
    way: Vector


@dataclass(frozen=True)
class Parameter:
    """A number of the robot that is a variable of a chart.

    Attributes
    ----------
    name : str
        Of the variable.
    key : str
        Which number (``design_parameters``).
    """

    name: str
    key: str


@dataclass(frozen=True)
class Chart:
    """Which poses a region has.

    Attributes
    ----------
    position : tuple of 3 (Fraction or str)
        Fixed coordinates of the model, or the name of the variable.
    quaternion : tuple of 4 Fraction, or None
        The fixed rotation; None if it is made of turns.
    turns : tuple of 3 (pair of Fraction or str)
        Roll, pitch and yaw: cosine and sine of half the angle up to a factor, the sine over sqrt(w); or the variable.
    variables : tuple of str
        In the order of ``box``: positions first.
    box : tuple of pairs of Fraction
        Their intervals.
    arc : Arc or None
        If there is one, x and y run along it with the variable "arc".
    line : Line or None
        If there is one, the position runs along it with the variable "along".
    parameters : tuple of Parameter
        Variables, the last ones, that are numbers of the robot.
    """

    position: tuple[Fraction | str, ...]
    quaternion: Quaternion | None
    turns: tuple[Pair | str, ...]
    variables: tuple[str, ...]
    box: tuple[Pair, ...]
    arc: Arc | None = None
    parameters: tuple[Parameter, ...] = ()
    line: Line | None = None

    @property
    def has_fixed_orientation(self) -> bool:
        """Whether the variables are positions only, so that a part of the region has a length, an area or a volume."""
        return all(name in POSITIONS for name in self.variables)


@dataclass(frozen=True, eq=False)
class PosePolynomials:
    """The poses of a chart: norm N, N C and N R, and the ring they are in."""

    ring: fmpq_mpoly_ctx
    norm: Polynomial
    position: tuple[Polynomial, ...]
    rotation: tuple[tuple[Polynomial, ...], ...]

    def constant(self, value: Fraction | int) -> Polynomial:
        """A number as an element of the ring."""
        return self.ring.constant(rational(value))


def label_of(name: str) -> str:
    """What a variable of a chart is.

    >>> label_of("x"), label_of("along"), label_of("yaw")
    ('x', 'along', 'tan(yaw/2)')
    """
    return name if name in (*POSITIONS, "along") else f"tan({name}/2)"


def rational(value: Any) -> Any:
    """The number as FLINT has it; a polynomial in the place of a number as it is."""
    if isinstance(value, fmpq_mpoly):
        return value
    number = Fraction(value)
    return fmpq(number.numerator, number.denominator)


def pose_polynomials(chart: Chart, metric: Metric, roots: Sequence[str] = ()) -> PosePolynomials:
    """The poses of a chart in the ring of its variables, and of further ones that stand for square roots.

    Examples
    --------
    >>> zero = Fraction(0)
    >>> chart = Chart(("x", zero, zero), None, ((Fraction(1), zero),) * 2 + ("yaw",), ("x", "yaw"), ((zero, zero),) * 2)
    >>> pose = pose_polynomials(chart, (1, 1, 1))
    >>> print(pose.norm, "|", pose.position[0], "|", pose.rotation[1][0])
    yaw^2 + 1 | x*yaw^2 + x | 2*yaw
    """
    ring = fmpq_mpoly_ctx.get((*chart.variables, *roots), Ordering.lex)
    named = dict(zip((*chart.variables, *roots), ring.gens(), strict=True))

    def element(value: Fraction | str) -> Polynomial:
        return named[value] if isinstance(value, str) else ring.constant(rational(value))

    if chart.quaternion is not None:
        norm = ring.constant(fmpq(1))
        rotation = [[element(entry) for entry in row] for row in rotation_of(chart.quaternion, metric)]
    else:
        norm, rotation = _turned(chart.turns, metric, element, ring)
    if chart.arc is not None:
        return _along_arc(chart, chart.arc, ring, norm, rotation)
    if chart.line is not None:
        t, (start, way) = named["along"], (chart.line.start, chart.line.way)
        place = tuple(norm * (rational(a) + rational(d) * t) for a, d in zip(start, way, strict=True))
        return PosePolynomials(ring, norm, place, tuple(map(tuple, rotation)))
    position = tuple(norm * element(value) for value in chart.position)
    return PosePolynomials(ring, norm, position, tuple(map(tuple, rotation)))


def _along_arc(
    chart: Chart, arc: Arc, ring: fmpq_mpoly_ctx, norm: Polynomial, rotation: Sequence[Sequence[Polynomial]]
) -> PosePolynomials:
    """The same with x and y on an arc: all times 1 + t^2."""
    t = dict(zip(ring.names(), ring.gens(), strict=True))["arc"]
    size, cosine, (u, v) = 1 + t * t, 1 - t * t, arc.middle
    turned = (rational(u) * cosine - rational(2 * v) * t, rational(v) * cosine + rational(2 * u) * t)
    x, y = (norm * (rational(c) * size + rational(arc.radius) * way) for c, way in zip(arc.center, turned, strict=True))
    height = chart.position[2]
    if isinstance(height, str):
        raise TypeError("the height of an arc is a number")
    wide = norm * size
    matrix = tuple(tuple(size * entry for entry in row) for row in rotation)
    return PosePolynomials(ring, wide, (x, y, wide * rational(height)), matrix)


def _turned(turns: Sequence[Pair | str], metric: Metric, element: Any, ring: fmpq_mpoly_ctx) -> tuple[Polynomial, Any]:
    norm, rotation = ring.constant(fmpq(1)), None
    for axis, turn in enumerate(turns):
        c, s = (element(Fraction(1)), element(turn)) if isinstance(turn, str) else map(element, turn)
        i, j = (axis + 1) % 3, (axis + 2) % 3
        square = metric[i] * metric[j] * s * s
        size, cosine = c * c + square, c * c - square
        zero = ring.constant(fmpq(0))
        matrix = [[size if row == column else zero for column in range(3)] for row in range(3)]
        matrix[i][i] = matrix[j][j] = cosine
        matrix[i][j], matrix[j][i] = -2 * metric[j] * c * s, 2 * metric[i] * c * s
        norm = norm * size
        rotation = matrix if rotation is None else _product(matrix, rotation)
    return norm, rotation


def _product(left: Sequence[Sequence[Any]], right: Sequence[Sequence[Any]]) -> list[list[Any]]:
    return [
        [left[i][0] * right[0][j] + left[i][1] * right[1][j] + left[i][2] * right[2][j] for j in range(3)]
        for i in range(3)
    ]


def moved(pose: PosePolynomials, joint: Vector) -> list[Polynomial]:
    """N (C + R B) for a platform joint B."""
    return [
        c + sum((entry * rational(b) for entry, b in zip(row, joint, strict=True)), pose.constant(0))
        for c, row in zip(pose.position, pose.rotation, strict=True)
    ]
