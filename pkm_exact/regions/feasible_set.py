"""Which positions of several redundant axes together keep all legs within their strokes, the platform at a pose.

A machine with more axes than freedoms, a hexapod on a carriage, may stand in many ways while its platform does not move
(``geometry.feasible_axes`` has the exact intervals of one axis). Squares of the legs' lengths are polynomials in the
positions of slides and the half tangents of cranks, after multiplication by powers of 1 + w t^2. A box of axes is
halved until Bernstein coefficients, in exact arithmetic, show of a part that all legs are within their strokes
everywhere, or that one is nowhere.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass
from fractions import Fraction
from heapq import heappop, heappush
from itertools import count
from typing import Any, Final, TypeAlias

from flint import Ordering, fmpq, fmpq_mpoly, fmpq_mpoly_ctx

from pkm_exact.constraints.distance import Distance
from pkm_exact.errors import InputError
from pkm_exact.geometry.chains import JointValue
from pkm_exact.geometry.drives import Drive
from pkm_exact.geometry.feasible_axes import Stroke
from pkm_exact.geometry.inverse import Matrix
from pkm_exact.geometry.mechanism import Mechanism
from pkm_exact.geometry.working_modes import platform_point
from pkm_exact.regions.bernstein import bernstein_coefficients
from pkm_exact.wording import shown

Box: TypeAlias = tuple[Stroke, ...]
MOST_PARTS: Final = 512
_INSIDE, _OUTSIDE = "inside", "outside"


@dataclass(frozen=True)
class FeasibleSet:
    """A box of axes in parts, which cover it and meet in their sides only.

    Attributes
    ----------
    axes : tuple of str
        Names of slides and cranks, in the order of the sides of boxes; positions, and half tangents.
    inside : tuple of boxes
        At all positions in them all legs are within their strokes.
    outside : tuple of boxes
        At no position in them they are.
    undecided : tuple of boxes
        Of these nothing is said.
    """

    axes: tuple[str, ...]
    inside: tuple[Box, ...]
    outside: tuple[Box, ...]
    undecided: tuple[Box, ...]

    @property
    def volume(self) -> Stroke:
        """Bounds of the volume of the feasible set, in products of positions and half tangents.

        Examples
        --------
        >>> one, two = (Fraction(0), Fraction(1)), (Fraction(1), Fraction(3))
        >>> found = FeasibleSet(("X",), ((one,),), (), ((two,),))
        >>> [str(bound) for bound in found.volume]
        ['1', '3']
        """
        least = sum(map(_volume, self.inside), Fraction(0))
        return least, least + sum(map(_volume, self.undecided), Fraction(0))


def feasible_set(
    robot: Mechanism,
    axes: Mapping[str, Stroke],
    others: Mapping[str, JointValue],
    pose: tuple[Sequence[Fraction], Matrix],
    legs: Stroke,
    *,
    most_parts: int = MOST_PARTS,
) -> FeasibleSet:
    """Of a box of axes, the parts in which all legs of actuated length are within their stroke, and those in which not.

    Parameters
    ----------
    robot : Mechanism
    axes : mapping
        Strokes of slides and cranks that move legs' feet: positions, and half tangents (of a crank with the weight w
        divided by sqrt(w)); half a turn is not among these.
    others : mapping
        Values of the other slides and cranks.
    pose : tuple
        Position and rotation matrix of the platform, in the metric of the robot.
    legs : tuple of Fraction
        Least and greatest length of every leg.
    most_parts : int
        Parts are halved, the largest first, until there are so many, or none is undecided.

    Raises
    ------
    InputError
        If there is no such axis, a value is missing, or a stroke is none.

    Examples
    --------
    >>> from pkm_exact.geometry.inverse import rotation_of
    >>> from pkm_exact.geometry.reader import read_robot
    >>> robot = read_robot("models/carriage-hexapod.toml")
    >>> unturned = rotation_of((Fraction(1), Fraction(0), Fraction(0), Fraction(0)))
    >>> pose = (Fraction(1), Fraction(6), Fraction(9)), unturned
    >>> strokes = {"X": (Fraction(-8), Fraction(8)), "Y": (Fraction(-16), Fraction(8))}
    >>> tilt = Fraction(4, 5), Fraction(3, 5)
    >>> found = feasible_set(robot, strokes, {"tilt": tilt}, pose, (Fraction(2), Fraction(14)), most_parts=200)
    >>> [float(bound) for bound in found.volume]
    [209.25, 229.3125]
    """
    _require_strokes(axes, legs)
    names = tuple(axes)
    conditions = _conditions(robot, names, others, pose, legs)
    degrees = [[max(key[k] for key in terms) for k in range(len(names))] for terms in conditions]
    whole: Box = tuple(axes.values())
    order = count()
    open_parts = [(-Fraction(1), next(order), whole, tuple(range(len(conditions))))]
    found: dict[str, list[Box]] = {_INSIDE: [], _OUTSIDE: []}
    while open_parts and len(open_parts) + sum(map(len, found.values())) < most_parts:
        share, _, part, open_conditions = heappop(open_parts)
        for half in _halves(part, whole):
            verdict, left = _verdict(half, [(k, conditions[k], degrees[k]) for k in open_conditions])
            if verdict:
                found[verdict].append(half)
            else:
                heappush(open_parts, (share / 2, next(order), half, left))
    undecided = tuple(part for _, _, part, _ in sorted(open_parts, key=lambda entry: entry[1]))
    return FeasibleSet(names, tuple(found[_INSIDE]), tuple(found[_OUTSIDE]), undecided)


Terms: TypeAlias = dict[tuple[int, ...], fmpq]


def _require_strokes(axes: Mapping[str, Stroke], legs: Stroke) -> None:
    if not axes:
        raise InputError("axes: none given; name at least one slide or crank with its stroke")
    for name, (low, high) in axes.items():
        if not low < high:
            raise InputError(f"axes, {shown(name)}: not a stroke; give the least and a greater value")
    if not 0 <= legs[0] <= legs[1]:
        raise InputError("legs: not a stroke of lengths; give the least and the greatest, neither below 0")


def _verdict(part: Box, conditions: Sequence[tuple[int, Terms, Sequence[int]]]) -> tuple[str, tuple[int, ...]]:
    """Inside, outside, or the conditions that are left."""
    left = []
    for number, terms, degrees in conditions:
        coefficients = bernstein_coefficients(terms, degrees, part)
        if max(coefficients) < 0:
            return _OUTSIDE, ()
        if min(coefficients) < 0:
            left.append(number)
    return ("" if left else _INSIDE), tuple(left)


def _halves(part: Box, whole: Box) -> Iterator[Box]:
    """Along the side that is the longest share of the whole, the first of equal ones."""
    shares = [(high - low) / (b - a) for (low, high), (a, b) in zip(part, whole, strict=True)]
    axis = shares.index(max(shares))
    low, high = part[axis]
    for side in ((low, (low + high) / 2), ((low + high) / 2, high)):
        yield (*part[:axis], side, *part[axis + 1 :])


def _conditions(
    robot: Mechanism,
    names: Sequence[str],
    others: Mapping[str, JointValue],
    pose: tuple[Sequence[Fraction], Matrix],
    legs: Stroke,
) -> list[Terms]:
    """Polynomials that are not negative where all legs are within their stroke."""
    drives = [_drive(robot, name) for name in names]
    ring = fmpq_mpoly_ctx.get(tuple(f"q{k}" for k in range(len(names))), Ordering.lex)
    variables = dict(zip(names, ring.gens(), strict=True))
    fixed = {drive.name: others[drive.name] for drive in robot.drives if drive.name in others}
    missing = [drive.name for drive in robot.drives if drive.name not in variables and drive.name not in fixed]
    if missing:
        raise InputError(f"others: no value of {shown(missing[0])}; give one for every slide and crank but the axes")
    found = []
    for leg in robot.constraints:
        if isinstance(leg, Distance) and leg.name in robot.actuated:
            square, factor = _square(robot, leg, (drives, variables, fixed), pose)
            low, high = (_number(end * end) for end in legs)
            found += [square - low * factor, high * factor - square]
    if not found:
        raise InputError("robot: has no legs of actuated length; ask about one that has")
    return [
        {tuple(map(int, key)): value for key, value in f.to_dict().items()} or {(0,) * len(names): fmpq(0)}
        for f in found
    ]


def _drive(robot: Mechanism, name: str) -> Drive:
    drive = robot.drive(name)
    if drive is None:
        raise InputError(f"axes: {shown(name)} is not a slide or a crank of this robot; name one that is")
    return drive


def _square(
    robot: Mechanism,
    leg: Distance,
    values: tuple[Sequence[Drive], Mapping[str, fmpq_mpoly], Mapping[str, JointValue]],
    pose: tuple[Sequence[Fraction], Matrix],
) -> tuple[fmpq_mpoly, fmpq_mpoly]:
    """The square of the leg's length times a positive polynomial, and that."""
    moving, variables, fixed = values
    own = {leg.name: leg}
    for drive in robot.drives:
        if drive.name in fixed and any((part.constraint, part.field) == (leg.name, "base") for part in drive.parts):
            part = next(part for part in drive.parts if part.constraint == leg.name)
            value = drive.parsed(fixed[drive.name], "others")
            own[leg.name] = part.added(own[leg.name], value if isinstance(value, tuple) else (value,), "others")  # type: ignore[assignment]
    position, rotation = pose
    x, y, z = position
    end = platform_point(leg.platform, (x, y, z), rotation)
    one = next(iter(variables.values())) ** 0
    foot: list[Any] = [_number(a - p) * one for a, p in zip(own[leg.name].base, end, strict=True)]
    factor = one
    for drive in moving:
        axes = [part.axes for part in drive.parts if (part.constraint, part.field) == (leg.name, "base")]
        if not axes:
            continue
        q, vectors = variables[drive.name], axes[0]
        steps: tuple[Any, ...] = (q,)
        if drive.is_crank:
            whole = 1 + drive.weight * q * q
            steps = 1 - drive.weight * q * q, 2 * q
            foot, factor = [x * whole for x in foot], factor * whole
            steps = tuple(step * (factor / whole) for step in steps)
        else:
            steps = (q * factor,)
        for step, vector in zip(steps, vectors, strict=True):
            foot = [x + step * _number(v) for x, v in zip(foot, vector, strict=True)]  # type: ignore[arg-type]
    square = sum((g * x * x for g, x in zip(robot.metric, foot, strict=True)), 0 * one)
    return _reduced(square, factor * factor, factor)


def _reduced(square: fmpq_mpoly, power: fmpq_mpoly, factor: fmpq_mpoly) -> tuple[fmpq_mpoly, fmpq_mpoly]:
    """Divided by the factor, if that leaves no rest: the square of a circle's radius is constant."""
    quotient, rest = divmod(square, factor)
    return (square, power) if rest else (quotient, factor)


def _volume(part: Box) -> Fraction:
    product = Fraction(1)
    for low, high in part:
        product *= high - low
    return product


def _number(value: Fraction) -> fmpq:
    return fmpq(value.numerator, value.denominator)
