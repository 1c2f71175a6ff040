"""Finite mobility: the dimension of the configurations near the given one, where it can be proved.

Rank alone tells no more than an upper bound. The dimension d at the configuration is proved by one of these arguments
(``docs/mobility.md`` has the proofs):

    regular The motions along each loop lie in the group that its joints generate. If the rank of the loops' equations
    is the sum of the dimensions of these groups, the equations are regular and d is the instantaneous mobility.
    subgroups Each leg by itself moves the platform within a group, or within a product of two, and reaches a
    neighbourhood there (equal dimensions). If these manifolds are transversal, groups counted as their intersection and
    equal ones once, d is the instantaneous mobility.
    second-order d is at most the dimension of the cone of those speeds for which the accelerations can be chosen to
    fit, and 0 if a quadratic form that must be 0 there is definite. From below, it is at least what one of the other
    arguments proves with some freedoms locked; or the loops ask one thing more than their rank says, a quadratic form
    in the second order that takes both signs. The bounds agree.
    higher-order The instantaneous mobility is 1, and the power series of the only curve there can be has no term of
    some order.
    curve It is 1, and half tangents that are rational functions of one number close the loops, as polynomials.
    real curves From below, algebraic curves close the loops, as polynomials modulo the equation of the curve, and move
    parts that share no loop.
    local ring over C From above, the configuration is isolated, real and complex, on a section with linear forms.

Otherwise there are bounds: the least that is proved from above, and the most from below.
"""

from __future__ import annotations

from collections.abc import Collection
from dataclasses import dataclass, replace
from enum import StrEnum
from functools import reduce
from itertools import chain, combinations
from typing import Final

from pkm_exact.geometry.linkage import Linkage
from pkm_exact.mobility.algebraic_curve import AlgebraicCurve
from pkm_exact.mobility.closure_series import higher_order
from pkm_exact.mobility.curve_families import independent_curves
from pkm_exact.mobility.instantaneous_mobility import Instantaneous, images, instantaneous
from pkm_exact.mobility.legs_of_linkage import Leg, legs_of
from pkm_exact.mobility.local_ring import local_dimension
from pkm_exact.mobility.reachable import legs_are_transversal
from pkm_exact.mobility.second_order import cone_dimension, obstructions, signature
from pkm_exact.screws.screw import Screw
from pkm_exact.screws.screw_system import ScrewSystem

MOST_LOCKED_TOGETHER: Final = 2
MOST_TRIALS: Final = 200
MOST_WORK: Final = 60_000
"""Sets that are locked on trial, and entries of the matrices of all trials."""


class Argument(StrEnum):
    """By which argument a finite mobility is proved."""

    REGULAR = "regular"
    SUBGROUPS = "subgroups"
    SECOND_ORDER = "second-order"
    HIGHER_ORDER = "higher-order"
    CURVE = "curve"
    CURVES = "real curves"
    LOCAL_RING = "local ring over C"
    LOCAL_RING_AND_CURVES = "local ring over C and real curves"
    NONE = "not known"


@dataclass(frozen=True)
class Finite:
    """What is proved of the configurations near the given one.

    Attributes
    ----------
    least, most : int
        Bounds of the dimension of the real configurations there.
    argument : Argument
        ``NONE`` unless the bounds agree.
    platform_least, platform_most : int
        Bounds of the dimension of the platform's poses there.
    locked : tuple of str
        The freedoms whose locking leaves the motion that the lower bound is proved by.
    curves : tuple of AlgebraicCurve
        What the lower bound is proved by, if it is these.
    is_by_local_ring : bool
        Whether the upper bound is that of the complex configurations in the local ring.

    Examples
    --------
    >>> from pkm_exact.geometry.reader import read_linkage
    >>> found = finite(instantaneous(read_linkage("models/chains/3-pprr.toml")))
    >>> found.least, found.most, str(found.argument)
    (4, 4, 'subgroups')
    """

    least: int
    most: int
    argument: Argument
    platform_least: int
    platform_most: int
    locked: tuple[str, ...] = ()
    curves: tuple[AlgebraicCurve, ...] = ()
    is_by_local_ring: bool = False

    @property
    def is_known(self) -> bool:
        """Whether the dimension is proved."""
        return self.least == self.most


def finite(found: Instantaneous) -> Finite:
    """The finite mobility of a mechanism at its configuration."""
    argument = smooth_argument(found.linkage, found.locked)
    total, platform = found.total, found.platform.rank
    if argument is not Argument.NONE:
        # The platform's poses have constant rank if legs are submersions, or if the rank is as large as it can be.
        most_of_platform = platform if argument is Argument.SUBGROUPS else min(total, reach_of_platform(found))
        return Finite(total, total, argument, platform, most_of_platform)
    least, most = 0, cone_dimension(found)
    left = group_dimensions(found, found.locked) - found.rank
    signatures = [signature(entry.form, total) for entry in obstructions(found)]
    if any(one.is_definite for one in signatures):
        most = 0
    elif left == 1 and any(one.is_indefinite for one in signatures):
        least, most = total - 1, min(most, total - 1)
    if least == most:
        return Finite(least, most, Argument.SECOND_ORDER, 0, min(most, reach_of_platform(found)))
    further = higher_order(found)
    if further is not None and further.curve:
        most_of_platform = min(total, reach_of_platform(found))
        return Finite(total, total, Argument.CURVE, platform, most_of_platform)
    if further is not None:
        return Finite(0, 0, Argument.HIGHER_ORDER, 0, 0)
    least, platform_least, locked = _with_freedoms_locked(found, most)
    if least == most:
        return Finite(least, most, Argument.SECOND_ORDER, platform_least, min(most, reach_of_platform(found)), locked)
    return _by_the_ideal(found, Finite(least, most, Argument.NONE, platform_least, most, locked))


def _by_the_ideal(found: Instantaneous, known: Finite) -> Finite:
    """Narrower bounds, if curves of configurations or the local ring prove them."""
    curves = independent_curves(found, known.most)
    if len(curves) > known.least:
        speeds = [curve.speeds for curve in curves]
        moving = ScrewSystem.of_rows(images(speeds, found.loops.platform)).rank
        known = replace(known, least=len(curves), platform_least=moving, locked=(), curves=curves)
    most = local_dimension(found, known.least, known.most)
    known = replace(known, most=most, is_by_local_ring=most < known.most)
    argument = Argument.NONE
    if known.least == known.most and known.is_by_local_ring:
        argument = Argument.LOCAL_RING_AND_CURVES if known.curves else Argument.LOCAL_RING
    elif known.least == known.most:
        argument = Argument.CURVES
    return replace(known, argument=argument, platform_most=min(most, reach_of_platform(found)))


def reach_of_platform(found: Instantaneous) -> int:
    """A bound of the dimension of the platform's poses near the configuration, whatever the whole mechanism does.

    No leg moves the platform in more dimensions than it has freedoms by itself, nor out of the group that its joints
    generate; and the poses that all legs allow are in all of these groups.

    Examples
    --------
    >>> from pkm_exact.geometry.reader import read_linkage
    >>> reach_of_platform(instantaneous(read_linkage("models/chains/3-pprr.toml")))
    1
    """
    legs = legs_of(found.linkage, found.locked)
    groups = [_group_of_leg(leg, found.locked) for leg in legs]
    common = reduce(lambda one, other: one & other, groups)
    return min(common.rank, *(leg.freedoms for leg in legs))


def _group_of_leg(leg: Leg, locked: Collection[str]) -> ScrewSystem:
    names = [(joint, name) for joint in leg.linkage.joints for name in joint.freedoms]
    twists = [twist for joint in leg.linkage.joints for twist in joint.twists]
    kept = [twist for (_, name), twist in zip(names, twists, strict=True) if name not in locked]
    return ScrewSystem.span(map(Screw.from_coordinates, kept)).algebra()


def smooth_argument(linkage: Linkage, locked: Collection[str]) -> Argument:
    """Which argument proves that the finite mobility is the instantaneous one, if any."""
    found = instantaneous(linkage, locked)
    if found.rank == group_dimensions(found, locked):
        return Argument.REGULAR
    return Argument.SUBGROUPS if legs_are_transversal(found) else Argument.NONE


def group_dimensions(found: Instantaneous, locked: Collection[str]) -> int:
    """The sum of the dimensions of the groups that the loops generate: so many equations there are."""
    free = set(found.linkage.freedoms) - set(locked)
    return sum(_group_of(found, loop, free) for loop in range(len(found.loops.loops)))


def _group_of(found: Instantaneous, loop: int, free: Collection[str]) -> int:
    """The dimension of the group that the joints of a loop generate."""
    names, twists = found.linkage.freedoms, found.loops.twists
    along = [twists[index] for index, _ in found.loops.loops[loop] if names[index] in free]
    return ScrewSystem.span(map(Screw.from_coordinates, along)).algebra().rank


def _with_freedoms_locked(found: Instantaneous, most: int) -> tuple[int, int, tuple[str, ...]]:
    """The largest mobility, that of the platform, and the freedoms with which locked so much is proved to be left."""
    names = [name for name in found.linkage.freedoms if name not in found.locked]
    trials = chain.from_iterable(combinations(names, count) for count in range(1, MOST_LOCKED_TOGETHER + 1))
    best: tuple[int, int, tuple[str, ...]] = (0, 0, ())
    entries = (6 * len(found.loops.loops) + 1) * len(names)
    for _, chosen in zip(range(min(MOST_TRIALS, MOST_WORK // entries)), trials, strict=False):
        if best[0] == most:
            break
        locked = (*found.locked, *chosen)
        left = instantaneous(found.linkage, locked)
        if left.total > best[0] and smooth_argument(found.linkage, locked) is not Argument.NONE:
            best = left.total, left.platform.rank, chosen
    return best
