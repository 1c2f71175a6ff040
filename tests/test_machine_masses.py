"""Rods on slides with their masses: motions of rods, and static balance, as chapter 12 should have them."""

from fractions import Fraction
from random import Random

import pytest

from pkm_exact import InputError
from pkm_exact.constraints.form import Vector
from pkm_exact.geometry.inverse import rotation_of
from pkm_exact.statics.rod_motion import PlatformMotion, rod_motion
from pkm_exact.statics.static_balance import Pantograph, Rod, balance_identity, counterweights

ZERO = Fraction(0)
ORIGIN: Vector = (ZERO, ZERO, ZERO)


def vector(random: Random) -> Vector:
    x, y, z = (Fraction(random.randint(-9, 9), random.randint(1, 5)) for _ in range(3))
    return x, y, z


def dot(u: Vector, v: Vector) -> Fraction:
    return sum((a * b for a, b in zip(u, v, strict=True)), ZERO)


def cross(u: Vector, v: Vector) -> Vector:
    return (u[1] * v[2] - u[2] * v[1], u[2] * v[0] - u[0] * v[2], u[0] * v[1] - u[1] * v[0])


def total(*terms: tuple[Fraction | int, Vector]) -> Vector:
    x, y, z = (sum((factor * v[k] for factor, v in terms), ZERO) for k in range(3))
    return x, y, z


@pytest.mark.parametrize("seed", range(5))
def test_a_rod_keeps_its_length_and_does_not_spin(seed: int) -> None:
    random = Random(seed)
    joint, rod, direction = (vector(random) for _ in range(3))
    motion = PlatformMotion(*(vector(random) for _ in range(4)))
    found = rod_motion(motion, joint, rod, direction)
    lever = cross(motion.turning, joint)
    first = total((1, motion.velocity), (1, lever), (-found.speed, direction))
    second = total(
        (1, motion.acceleration),
        (1, cross(motion.turning_acceleration, joint)),
        (1, cross(motion.turning, lever)),
        (-found.acceleration, direction),
    )
    assert cross(found.turning, rod) == first
    turned = cross(found.turning, cross(found.turning, rod))
    assert total((1, cross(found.turning_acceleration, rod)), (1, turned)) == second
    assert dot(found.turning, rod) == dot(found.turning_acceleration, rod) == 0
    # Equation 30 with the plus that is printed as a minus: the middle of the rod.
    middle = total((found.speed, direction), (Fraction(1, 2), cross(found.turning, rod)))
    assert middle == total(*((Fraction(1, 2), term) for term in (motion.velocity, lever)), (found.speed / 2, direction))


def test_a_rod_across_its_slide_is_refused() -> None:
    motion = PlatformMotion(ORIGIN, ORIGIN, ORIGIN, ORIGIN)
    with pytest.raises(InputError, match="perpendicular to its slide"):
        rod_motion(motion, ORIGIN, (Fraction(1), ZERO, ZERO), (ZERO, Fraction(1), ZERO))


def at_poses(
    mass: Fraction, centre: Vector, rods: list[Rod], sliders: list[tuple[Vector, Fraction]], seed: int
) -> tuple[Vector, Vector, list[Vector], Vector]:
    """A pose h, the places of the rods' joints, and mass times centre of mass of platform and rods there."""
    random = Random(seed)
    height = vector(random)
    rotation = rotation_of((Fraction(1), *vector(random)))

    def turned(v: Vector) -> Vector:
        x, y, z = (dot(row, v) for row in rotation)
        return x, y, z

    joints = [total((1, height), (1, turned(rod.joint))) for rod in rods]
    moment = total((mass, height), (mass, turned(centre)))
    for rod, joint, (guide, _) in zip(rods, joints, sliders, strict=True):
        moment = total((1, moment), (rod.mass * (1 - rod.part), joint), (rod.mass * rod.part, guide))
    return height, turned(balance_identity(mass, centre, rods).rotation), joints, moment


@pytest.mark.parametrize("seed", range(4))
def test_the_identity_of_static_balance(seed: int) -> None:
    """M r = A h + R B + sum K_i s_i u_i + sum K_i b_i, for masses, poses and sliders of any values."""
    random = Random(seed)
    rods = [Rod(vector(random), Fraction(random.randint(1, 5)), Fraction(random.randint(0, 7), 7)) for _ in range(6)]
    mass, centre = Fraction(8), vector(random)
    feet, ways = ([vector(random) for _ in rods] for _ in range(2))
    sliders = [(total((1, b), (1, s)), ZERO) for b, s in zip(feet, ways, strict=True)]
    height, turned, _, moment = at_poses(mass, centre, rods, sliders, seed)
    found = balance_identity(mass, centre, rods)
    terms = [(k, v) for k, b, s in zip(found.slides, feet, ways, strict=True) for v in (b, s)]
    assert moment == total((found.position, height), (1, turned), *terms)
    assert not found.is_balanced


def test_counterweights_on_rods_alone_balance_nothing() -> None:
    """With all K_i = 0 the coefficient of the position is the sum of the masses."""
    found = balance_identity(Fraction(8), ORIGIN, [Rod(ORIGIN, Fraction(3, 2), ZERO)] * 6)
    assert (found.position, found.slides) == (Fraction(17), (ZERO,) * 6)


HEXAGON: list[Vector] = [
    (Fraction(x), Fraction(y), ZERO) for x, y in ((3, 1), (-1, 3), (-3, 1), (-3, -1), (1, -3), (3, -1))
]


def test_the_weights_of_table_3_stand_still() -> None:
    """Platform 8 kg, rods 0.5 kg of 750 mm, pantograph 3 kg: 17 kg, 1 kg at -187.5 mm, 26 kg added, 37/11 in all."""
    rods = [Rod(joint, Fraction(1, 2), Fraction(1, 2)) for joint in HEXAGON]
    frame = Pantograph(Fraction(3), ZERO, Fraction(17), (Fraction(1),) * 6)
    found = counterweights(Fraction(8), ORIGIN, rods, frame)
    assert (found.on_arm, found.on_platform, found.added) == (-1, None, 26)
    assert [750 * part for part in found.on_rods] == [Fraction("-187.5")] * 6
    own = 8 + 6 * Fraction(1, 2)
    assert (own + found.added) / own == Fraction(37, 11)


@pytest.mark.parametrize("seed", range(4))
def test_with_counterweights_the_centre_of_mass_does_not_move(seed: int) -> None:
    random = Random(100 + seed)
    rods = [Rod(joint, Fraction(k + 1), Fraction(k + 1, 9)) for k, joint in enumerate(HEXAGON)]
    mass, centre = Fraction(7), vector(random)
    frame = Pantograph(Fraction(3), Fraction(1, 3), Fraction(20), tuple(map(Fraction, range(1, 7))), Fraction(5))
    found = counterweights(mass, centre, rods, frame)
    sliders = [(vector(random), ZERO) for _ in rods]
    height, _, joints, moment = at_poses(mass, centre, rods, sliders, seed)
    for weight, part, joint, (guide, _) in zip(frame.rod_weights, found.on_rods, joints, sliders, strict=True):
        moment = total((1, moment), (weight * (1 - part), joint), (weight * part, guide))
    assert found.on_platform is not None
    _, _, (place, *_), _ = at_poses(mass, centre, [Rod(found.on_platform, ZERO, ZERO)] * 6, sliders, seed)
    moment = total((1, moment), (frame.platform_weight, place))
    moment = total((1, moment), (frame.mass * frame.part + frame.weight * found.on_arm, height))
    assert moment == ORIGIN


def test_weights_that_cannot_balance_are_refused() -> None:
    rods = [Rod((Fraction(1), ZERO, ZERO), Fraction(1), Fraction(1, 2))]
    with pytest.raises(InputError, match="platform_weight: 0, but"):
        counterweights(Fraction(8), ORIGIN, rods, Pantograph(Fraction(3), ZERO, Fraction(17), (Fraction(1),)))
    with pytest.raises(InputError, match="one is 0"):
        counterweights(Fraction(8), ORIGIN, rods, Pantograph(Fraction(3), ZERO, Fraction(17), (ZERO,)))
    with pytest.raises(InputError, match="2 for 1 rods"):
        counterweights(Fraction(8), ORIGIN, rods, Pantograph(Fraction(3), ZERO, Fraction(17), (Fraction(1),) * 2))
