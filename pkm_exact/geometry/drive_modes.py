"""Inverse kinematics of a mechanism's drives: every value at which the constraint that a drive moves holds at a pose.

At a pose the constraint is one equation in the drive's value, found by evaluating it at a few values:

    slide    a q^2 + 2 b q + c = 0            discriminant b^2 - a c
    crank    a cos + b s + c = 0,             discriminant a^2 + b^2 / w - c^2,   s = sin / sqrt(w)

Two working modes where the discriminant is positive, none where it is negative; where it is 0 they meet, or there is
one (a slide whose equation is linear), and the drive can no longer push the platform or does so twice. A crank whose
equation is quadratic in cosine and sine has up to four (``geometry.curved_cranks``).
"""

from __future__ import annotations

from dataclasses import dataclass
from fractions import Fraction

from pkm_exact.constraints.form import Vector
from pkm_exact.errors import InputError
from pkm_exact.geometry.chains import JointValue
from pkm_exact.geometry.curved_cranks import curved_modes
from pkm_exact.geometry.drives import Drive
from pkm_exact.geometry.inverse import Matrix
from pkm_exact.geometry.mechanism import Mechanism, is_square
from pkm_exact.geometry.paired_drives import paired_modes, partner_of
from pkm_exact.geometry.surds import Surd, quadratic_roots
from pkm_exact.geometry.working_modes import CrankMode, FreeCrank, Mode, SlideMode, half_tangent
from pkm_exact.wording import shown


@dataclass(frozen=True)
class JointModes:
    """What an actuator must be for the platform to stand at a pose.

    Attributes
    ----------
    name : str
        Of the actuator; of two drives that hold a leg together both names, with a comma.
    modes : tuple
        Slides in increasing position, cranks the minus sign first, or in increasing half tangent where there may be
        four; empty if the pose is out of reach.
    discriminant : Fraction or None
        Vanishes where two modes meet; None for an actuator that has one value only.
    """

    name: str
    modes: tuple[Mode, ...]
    discriminant: Fraction | None = None


def joint_values(mechanism: Mechanism, position: Vector, rotation: Matrix) -> tuple[JointModes, ...]:
    """The working modes of every actuator at a pose, in the order of ``mechanism.actuated``.

    Two drives of one leg have modes together (``geometry.paired_drives``), at the place of the first.

    Raises
    ------
    InputError
        If more drives move one constraint, so that none has values of its own.
    """
    own = mechanism.values_at(position, rotation)
    found: list[JointModes] = []
    paired: set[str] = set()
    for name in mechanism.actuated:
        drive = mechanism.drive(name)
        partner = None if drive is None else partner_of(mechanism, drive)
        if drive is not None and partner is not None:
            if name not in paired:
                found.append(_pair(mechanism, (drive, partner), position, rotation))
                paired |= {name, partner.name}
            continue
        if drive is not None:
            found.append(_drive_modes(mechanism, drive, position, rotation))
            continue
        value, is_length = own[name], is_square(mechanism.value_field(name))
        if is_length and value < 0:
            found.append(JointModes(name, ()))
        else:
            found.append(JointModes(name, (SlideMode(Surd.root_of(value) if is_length else Surd(value)),)))
    return tuple(found)


def residual(mechanism: Mechanism, drive: Drive, value: JointValue, position: Vector, rotation: Matrix) -> Fraction:
    """By how much the constraint that a drive moves is violated at a pose, for any value."""
    name = drive.parts[0].constraint
    constraints = {found.name: found for found in mechanism.constraints}
    return mechanism.equation_at(drive.moved(constraints, value, drive.name)[name], position, rotation)


def _pair(mechanism: Mechanism, drives: tuple[Drive, Drive], position: Vector, rotation: Matrix) -> JointModes:
    def ask(leg: Mechanism, drive: Drive) -> tuple[tuple[Mode, ...], Fraction | None]:
        own = leg.drive(drive.name) or drive
        found = _drive_modes(leg, own, position, rotation)
        return found.modes, found.discriminant

    modes, discriminant = paired_modes(mechanism, drives, position, rotation, ask)
    return JointModes(", ".join(drive.name for drive in drives), modes, discriminant)


def _drive_modes(mechanism: Mechanism, drive: Drive, position: Vector, rotation: Matrix) -> JointModes:
    name = drive.parts[0].constraint
    others = [other.name for other in mechanism.drives if other is not drive and _moves(other, name)]
    if others:
        raise InputError(
            f"{shown(drive.name)} and {shown(others[0])} move the constraint {shown(name)} together, so that neither "
            "has values of its own at a pose; ask about a mechanism with one actuator in every leg"
        )

    if drive.is_crank and drive.parts[0].field == "direction":
        return JointModes(drive.name, *curved_modes(mechanism, drive, position, rotation))

    def at(first: int, second: int = 0) -> Fraction:
        value = (Fraction(first), Fraction(second)) if drive.is_crank else Fraction(first)
        return residual(mechanism, drive, value, position, rotation)

    if drive.is_crank:
        forth, back, up, down = at(1, 0), at(-1, 0), at(0, 1), at(0, -1)
        centre, corner = at(0, 0), at(1, 1)
        if up + down - 2 * centre != drive.weight * (forth + back - 2 * centre) or corner != forth + up - centre:
            return JointModes(drive.name, *curved_modes(mechanism, drive, position, rotation))
        return _crank(drive, (forth - back) / 2, (up - down) / 2, (forth + back) / 2)
    start, forth, back = at(0), at(1), at(-1)
    a, b = (forth + back) / 2 - start, (forth - back) / 4
    if a == 0:
        # A plane that the drive shifts: one value; or any, or none, where it moves nothing.
        if b == 0:
            return JointModes(drive.name, () if start else (FreeCrank(),))
        return JointModes(drive.name, (SlideMode(Surd(-start / (2 * b))),))
    return JointModes(drive.name, tuple(map(SlideMode, quadratic_roots(a, b, start))), b * b - a * start)


def _crank(drive: Drive, a: Fraction, b: Fraction, c: Fraction) -> JointModes:
    """The angles with a cos + b s + c = 0, cos^2 + w s^2 = 1."""
    w = drive.weight
    m = a * a + b * b / w
    if m == 0:
        return JointModes(drive.name, (FreeCrank(),) if c == 0 else (), Fraction(0) if c == 0 else -c * c)
    discriminant = m - c * c
    if discriminant < 0:
        return JointModes(drive.name, (), discriminant)
    root = Surd.root_of(discriminant / w)
    modes = []
    for sign in (Fraction(-1), Fraction(1)) if discriminant else (Fraction(1),):
        s = root.scaled(sign)
        cosine = s.scaled(-b / m).plus(-a * c / m)
        sine = s.scaled(a / m).plus(-b * c / (w * m))
        modes.append(CrankMode(cosine, sine, half_tangent(cosine, sine)))
    return JointModes(drive.name, tuple(modes), discriminant)


def _moves(drive: Drive, constraint: str) -> bool:
    return any(part.constraint == constraint for part in drive.parts)
