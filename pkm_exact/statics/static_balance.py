"""Static balance of a platform on rods and slides: when the common centre of mass does not move, as an identity.

With a rod's centre of mass at the part k of it, counted from the platform's joint, mass times centre of mass is

    M r = A h + R B + sum K_i s_i u_i + sum K_i b_i,  A = m + sum m_i (1 - k_i),  B = m g + sum m_i (1 - k_i) p_i,
    K_i = m_i k_i

for every pose h, R and every position of the sliders b_i + s_i u_i (section 5 of chapter 12 of *Parallel Manipulators*
(2008)). It is constant if A, B and all K_i are 0: an identity, which needs no poses.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from fractions import Fraction

from pkm_exact.constraints.form import Vector
from pkm_exact.errors import InputError


@dataclass(frozen=True)
class Rod:
    """A rod with its mass.

    Attributes
    ----------
    joint : Vector
        On the platform, in its frame.
    mass : Fraction
    part : Fraction
        Where its centre of mass is: 0 at the platform's joint, 1 at the slider.
    """

    joint: Vector
    mass: Fraction
    part: Fraction


@dataclass(frozen=True)
class BalanceIdentity:
    """Coefficients of the identity: of the position, of the rotation, and of each slider's way.

    Examples
    --------
    >>> origin = (Fraction(0),) * 3
    >>> found = balance_identity(Fraction(-3), origin, [Rod(origin, Fraction(1), Fraction(0))] * 3)
    >>> found.is_balanced
    True
    """

    position: Fraction
    rotation: Vector
    slides: tuple[Fraction, ...]

    @property
    def is_balanced(self) -> bool:
        """Whether the centre of mass stands still, however the machine moves."""
        return self.position == 0 and not any(self.rotation) and not any(self.slides)


def balance_identity(mass: Fraction, centre: Vector, rods: Sequence[Rod]) -> BalanceIdentity:
    """The coefficients A, B and K_i of a platform of the given mass, its centre of mass in its frame."""
    near = [rod.mass * (1 - rod.part) for rod in rods]
    x, y, z = (
        mass * centre[k] + sum((m * rod.joint[k] for m, rod in zip(near, rods, strict=True)), Fraction(0))
        for k in range(3)
    )
    return BalanceIdentity(mass + sum(near), (x, y, z), tuple(rod.mass * rod.part for rod in rods))


@dataclass(frozen=True)
class Counterweights:
    """Where counterweights balance a machine whose platform hangs on a pantograph.

    Attributes
    ----------
    on_rods : tuple of Fraction
        Parts of the rods, counted from the platform's joints; negative beyond them.
    on_arm : Fraction
        Part of the pantograph's diagonal from its fixed point to the platform's origin; negative on the other side.
    on_platform : Vector or None
        In the platform's frame; none if no weight is there.
    added : Fraction
        The mass of the pantograph and all counterweights.
    """

    on_rods: tuple[Fraction, ...]
    on_arm: Fraction
    on_platform: Vector | None
    added: Fraction


@dataclass(frozen=True)
class Pantograph:
    """What is added: a pantograph from the base's origin to the platform's, and weights.

    Attributes
    ----------
    mass, part : Fraction
        Of the pantograph; its centre of mass is at this part of the diagonal, counted from the base.
    weight : Fraction
        On the diagonal, moved by the pantograph.
    rod_weights : tuple of Fraction
        One per rod.
    platform_weight : Fraction
        On the platform; 0 if none.
    """

    mass: Fraction
    part: Fraction
    weight: Fraction
    rod_weights: tuple[Fraction, ...]
    platform_weight: Fraction = Fraction(0)


def counterweights(mass: Fraction, centre: Vector, rods: Sequence[Rod], added: Pantograph) -> Counterweights:
    """Where the weights must be so that the common centre of mass stands still at every pose.

    Equations 84 to 97 of the chapter, with the factor and the sign that are missing there.

    Raises
    ------
    InputError
        If a weight that is needed has no mass.

    Examples
    --------
    >>> origin = (Fraction(0),) * 3
    >>> rods = [Rod(origin, Fraction(1, 2), Fraction(1, 2))] * 6
    >>> frame = Pantograph(Fraction(3), Fraction(0), Fraction(17), (Fraction(1),) * 6)
    >>> found = counterweights(Fraction(8), origin, rods, frame)
    >>> print(found.on_rods[0], found.on_arm, found.added)
    -1/4 -1 26
    """
    if len(added.rod_weights) != len(rods):
        raise InputError(f"rod_weights: {len(added.rod_weights)} for {len(rods)} rods; give one per rod")
    if not all((added.weight, *added.rod_weights)):
        raise InputError("weight, rod_weights: one is 0; give masses that can balance something")
    on_rods = tuple(-rod.mass * rod.part / weight for rod, weight in zip(rods, added.rod_weights, strict=True))
    whole = [
        Rod(rod.joint, rod.mass + weight, Fraction(0)) for rod, weight in zip(rods, added.rod_weights, strict=True)
    ]
    rest = balance_identity(mass, centre, whole)
    on_platform: Vector | None = None
    if added.platform_weight:
        x, y, z = (-value / added.platform_weight for value in rest.rotation)
        on_platform = (x, y, z)
    elif any(rest.rotation):
        raise InputError("platform_weight: 0, but the platform with its joints is not centred; give it a mass")
    on_arm = -(rest.position + added.platform_weight + added.mass * added.part) / added.weight
    total = added.platform_weight + added.mass + added.weight + sum(added.rod_weights)
    return Counterweights(on_rods, on_arm, on_platform, total)
