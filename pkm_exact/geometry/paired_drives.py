"""Inverse kinematics of two drives in one leg: both joints of a planar leg driven, which hold a point together.

Of a crank or slide A and a link B of length l that hold the platform's joint p, A + B = p, the values of A are those
of a rod of length l, and each has one of B: the direction of p - A. Of a direction and a length along it, the direction
has its own equation, and each of its values one length. So working modes are pairs, and the discriminant is that of
the first drive.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from fractions import Fraction

from pkm_exact.constraints.at_point import AtPoint
from pkm_exact.constraints.distance import Distance
from pkm_exact.constraints.form import Vector
from pkm_exact.constraints.point_in_plane import InPlane
from pkm_exact.geometry.drives import Drive, Part
from pkm_exact.geometry.inverse import Matrix, Metric, dot
from pkm_exact.geometry.mechanism import Mechanism
from pkm_exact.geometry.surds import Surd
from pkm_exact.geometry.working_modes import (
    CrankMode,
    FreeCrank,
    Mode,
    PairedMode,
    SlideMode,
    half_tangent,
    platform_point,
)

_NONE = (Fraction(0), Fraction(0), Fraction(0))
Found = tuple[tuple[Mode, ...], Fraction | None]
Asked = Callable[[Mechanism, Drive], Found]


def partner_of(mechanism: Mechanism, drive: Drive) -> Drive | None:
    """The other drive of a leg that both hold together, if that is what they do.

    Examples
    --------
    >>> from pkm_exact.geometry.reader import read_robot
    >>> delta = read_robot("models/delta.toml")
    >>> partner_of(delta, delta.drives[0]) is None
    True
    """
    moved = {part.constraint for part in drive.parts}
    sharing = [
        other for other in mechanism.drives if other is not drive and moved & {part.constraint for part in other.parts}
    ]
    if len(sharing) != 1 or moved & set(mechanism.actuated):
        return None
    return sharing[0] if _ordered(mechanism, drive, sharing[0]) else None


def paired_modes(
    mechanism: Mechanism, drives: tuple[Drive, Drive], position: Vector, rotation: Matrix, ask: Asked
) -> Found:
    """The pairs of values of two drives, in the order of the second one's first.

    Parameters
    ----------
    mechanism : Mechanism
    drives : tuple of 2 Drive
        As ``partner_of`` has found them.
    position, rotation
        The pose, in the metric.
    ask : callable
        The modes of a drive that moves its constraint alone, of a mechanism, and their discriminant.
    """
    ordered = _ordered(mechanism, *drives)
    if ordered is None:
        raise ValueError("the drives are not a pair")
    first, second = ordered
    constraint = _constraint(mechanism, second)
    end = platform_point(constraint.platform, position, rotation)
    if isinstance(constraint, AtPoint):
        modes, discriminant = ask(_with_rod(mechanism, constraint, first, second), first)
        follows = _link(constraint, (first, second), end, mechanism.metric)
    else:
        modes, discriminant = ask(mechanism, first)
        follows = _length(constraint, (first, second), end, mechanism.metric)
    if any(isinstance(mode, FreeCrank) for mode in modes):
        return (FreeCrank(),), discriminant
    pairs = []
    for mode in modes:
        values = {first.name: mode, second.name: follows(mode)}
        pairs.append(PairedMode(tuple((drive.name, values[drive.name]) for drive in drives)))
    return tuple(pairs), discriminant


def _constraint(mechanism: Mechanism, drive: Drive) -> AtPoint | InPlane:
    name = drive.parts[0].constraint
    found = next(constraint for constraint in mechanism.constraints if constraint.name == name)
    if not isinstance(found, AtPoint | InPlane):
        raise ValueError("the drives are not a pair")
    return found


def _ordered(mechanism: Mechanism, one: Drive, other: Drive) -> tuple[Drive, Drive] | None:
    """The drive that has an equation of its own, or holds the foot of the link; then the one that follows from it."""
    constraints = {found.name: found for found in mechanism.constraints}
    for first, second in ((one, other), (other, one)):
        held = constraints[second.parts[0].constraint]
        if len(second.parts) != 1 or held.name not in {part.constraint for part in first.parts}:
            continue
        if isinstance(held, AtPoint) and second.is_crank and mechanism.motion.is_planar and len(first.parts) == 1:
            if not _is_link_of(first, second, mechanism):
                continue
            return first, second
        is_length = isinstance(held, InPlane) and not second.is_crank and second.parts[0].field == "offset"
        if is_length and first.is_crank and first.parts[0].constraint != held.name:
            return first, second
    return None


def _is_link_of(first: Drive, second: Drive, mechanism: Mechanism) -> bool:
    """Whether the link comes later in the leg, as its name does among the drives."""
    return mechanism.drives.index(first) < mechanism.drives.index(second)


def _with_rod(mechanism: Mechanism, held: AtPoint, first: Drive, second: Drive) -> Mechanism:
    """The leg with a rod in place of its link."""
    link = _vector(second.parts[0].axes[0])
    rod = Distance(held.point, held.platform, dot(link, link, mechanism.metric), held.name)
    drive = Drive(first.name, (Part(held.name, "base", first.parts[0].axes),), first.weight)
    return Mechanism(
        mechanism.name,
        mechanism.unit,
        mechanism.source,
        (rod,),
        (first.name,),
        mechanism.motion,
        mechanism.metric,
        drives=(drive,),
    )


def _link(held: AtPoint, drives: tuple[Drive, Drive], end: Vector, metric: Metric) -> Callable[[Mode], Mode]:
    """The direction of the link from where the first drive holds it to the platform's joint."""
    first, second = drives
    along, across = (_vector(axis) for axis in second.parts[0].axes)
    rest = tuple(p - a for p, a in zip(end, held.point, strict=True))

    def follows(mode: Mode) -> Mode:
        plain, rooted, n = _moved(first.parts[0].axes, mode)
        found = []
        for axis in (along, across):
            square = dot(axis, axis, metric)
            p = sum((g * a * (r - x) for g, a, r, x in zip(metric, axis, rest, plain, strict=True)), Fraction(0))
            q = sum((-g * a * x for g, a, x in zip(metric, axis, rooted, strict=True)), Fraction(0))
            found.append(Surd(p / square, q / square, n if q else 0))
        cosine, sine = found
        return CrankMode(cosine, sine, half_tangent(cosine, sine))

    return follows


def _length(held: InPlane, drives: tuple[Drive, Drive], end: Vector, metric: Metric) -> Callable[[Mode], Mode]:
    """How far the plane across the direction must be, for the platform's joint to be in it."""
    first, second = drives
    normal = next(part for part in first.parts if (part.constraint, part.field) == (held.name, "normal"))
    offset = next((part for part in first.parts if (part.constraint, part.field) == (held.name, "offset")), None)
    shifts = (Fraction(0),) * len(normal.axes) if offset is None else offset.axes
    heights = [
        dot(_vector(axis), end, metric) - shift  # type: ignore[operator]
        for axis, shift in zip(normal.axes, shifts, strict=True)
    ]
    step = second.parts[0].axes[0]
    start = dot(held.normal, end, metric) - held.offset

    def follows(mode: Mode) -> Mode:
        plain, rooted, n = _moved([(height, Fraction(0), Fraction(0)) for height in heights], mode)
        p, q = (start + plain[0]) / step, rooted[0] / step  # type: ignore[operator]
        return SlideMode(Surd(p, q, n if q else 0))

    return follows


def _moved(axes: Sequence[object], mode: Mode) -> tuple[Vector, Vector, int]:
    """What a drive adds at a mode: p + q sqrt(n)."""
    factors = (mode.position,) if isinstance(mode, SlideMode) else (mode.cos, mode.sin)  # type: ignore[union-attr]
    n = max(factor.n for factor in factors)  # type: ignore[union-attr]
    plain, rooted = list(_NONE), list(_NONE)
    for factor, axis in zip(factors, axes, strict=True):
        for i, x in enumerate(_vector(axis)):
            plain[i] += factor.p * x  # type: ignore[union-attr]
            rooted[i] += factor.q * x  # type: ignore[union-attr]
    return (plain[0], plain[1], plain[2]), (rooted[0], rooted[1], rooted[2]), n


def _vector(axis: object) -> Vector:
    if not isinstance(axis, tuple):
        raise TypeError("not a vector")
    return axis
