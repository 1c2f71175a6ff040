"""Rods on slides: motions of rods and platforms, axes at singular poses, static balance (chapters 12 and 19)."""

from fractions import Fraction
from random import Random

import numpy as np
import pytest

from pkm_exact import InputError
from pkm_exact.constraints.form import Vector
from pkm_exact.geometry.inverse import rotation_of
from pkm_exact.statics.closest_complex import closest_complex
from pkm_exact.statics.rod_motion import PlacedRod, PlatformMotion, platform_motion, rod_motion
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


E3: tuple[Vector, ...] = ((Fraction(1), ZERO, ZERO), (ZERO, Fraction(1), ZERO), (ZERO, ZERO, Fraction(1)))


@pytest.mark.parametrize("turning", [E3, E3[2:], ()])
@pytest.mark.parametrize("seed", [1, 2])
def test_a_platform_moves_as_its_sliders_ask(turning: tuple[Vector, ...], seed: int) -> None:
    """The sliders' speeds and accelerations that a motion asks for give that motion."""
    random = Random(seed)
    rods = [PlacedRod(*(vector(random) for _ in range(3))) for _ in range(3 + len(turning))]
    turns = [total(*((Fraction(random.randint(-5, 5)), axis) for axis in turning)) for _ in range(2)]
    motion = PlatformMotion(vector(random), turns[0], vector(random), turns[1])
    asked = [rod_motion(motion, r.joint, r.rod, r.direction) for r in rods]
    assert platform_motion(rods, [x.speed for x in asked], [x.acceleration for x in asked], turning) == motion


H4 = [
    ((-6, 0, 0), (42, 42, -42)),
    ((-6, 0, 0), (42, -42, -42)),
    ((6, 0, 0), (0, -42, -42)),
    ((6, 0, 0), (-42, 0, -42)),
]
"""Chapter 19 at home: hinges of the bars from the platform's centre, and rods from the sliders."""


def h4() -> list[PlacedRod]:
    return [PlacedRod(*(tuple(map(Fraction, v)) for v in (*pair, E3[2]))) for pair in H4]  # type: ignore[arg-type]


def test_speeds_and_accelerations_of_the_h4() -> None:
    """The book has -1/8 for the rate of the angle, and accelerations of 23 and 2.5."""
    speeds, accelerations = ([Fraction(n) for n in row] for row in ((1, -1, 1, 1), (10, -10, 10, 10)))
    found = platform_motion(h4(), speeds, [ZERO] * 4, E3[2:])
    assert [*found.velocity, found.turning[2]] == [Fraction(x) for x in ("1/2", "-1/4", "1/2", "1/8")]
    still = platform_motion(h4(), [ZERO] * 4, accelerations, E3[2:])
    assert [*still.acceleration, still.turning_acceleration[2]] == [Fraction(x) for x in ("5", "-5/2", "5", "5/4")]
    assert dot(still.acceleration, still.acceleration) == Fraction(15, 2) ** 2
    # Moving sliders without acceleration: what equations 39 and 40 leave out is not 0.
    assert any(found.acceleration)
    x, y, z = found.acceleration
    for rod, speed in zip(h4(), speeds, strict=True):
        lever = cross(found.turning, rod.joint)
        change = total((1, found.velocity), (1, lever), (-speed, rod.direction))
        free = total(
            (1, (x, y, z)), (1, cross(found.turning_acceleration, rod.joint)), (1, cross(found.turning, lever))
        )
        assert dot(rod.rod, free) + dot(change, change) == 0


def test_motions_that_sliders_do_not_determine_are_refused() -> None:
    same = [PlacedRod(ORIGIN, E3[0], E3[0])] * 3
    with pytest.raises(InputError, match="rods: singular here"):
        platform_motion(same, [ZERO] * 3, [ZERO] * 3, ())
    with pytest.raises(InputError, match="rods: 3, with 3 speeds, 3 accelerations and 1 directions"):
        platform_motion(same, [ZERO] * 3, [ZERO] * 3, E3[2:])


def lines_of_the_h4(x: float, y: float, theta: float) -> np.ndarray:  # type: ignore[type-arg]
    """Six lines of chapter 19 about the platform's centre: four rods through the hinges, two couples."""
    c, s = np.cos(theta), np.sin(theta)
    feet = np.array([[-48, -48], [-48, 48], [6, 48], [48, -6]], dtype=float)
    bars = np.array([[0, -6, 0], [0, 6, 0], [0, 6, 0], [0, -6, 0]], dtype=float)
    along = np.array([[-1, 1, 0], [1, 1, 0], [1, 0, 0], [0, -1, 0]], dtype=float)
    squares = [5292, 5292, 3528, 3528]
    rows, normals = [], []
    for k in range(4):
        hinge = np.array([c, s, 0]) * (-6 if k < 2 else 6)
        end = np.array([x, y, 0]) + hinge + bars[k]
        flat = end[:2] - feet[k]
        rod = np.array([*flat, -np.sqrt(squares[k] - flat @ flat)])
        rod /= np.linalg.norm(rod)
        rows.append([*rod, *np.cross(hinge, rod)])
        normals.append(np.cross(rod, along[k]))
    up = np.array([0.0, 0, 1])
    for one, other in ((0, 1), (2, 3)):
        couple = np.cross(np.cross(normals[one], normals[other]), up)
        rows.append([0, 0, 0, *(couple / np.linalg.norm(couple))])
    return np.array(rows)


@pytest.mark.parametrize(
    ("pose", "axis", "pitch"),
    [
        ((-9.5812, -9.4130, -1.5080), (0, 0, 1, -5.2937, -0.3331, 0), -9.4051),
        ((-3.6683, 3.3709, -2.3905), (0.9137, 0.3524, -0.2024, 0.3208, -0.2064, 1.0887), 1.0469),
    ],
)
def test_the_axes_at_both_singular_poses_of_the_h4(
    pose: tuple[float, float, float], axis: tuple[float, ...], pitch: float
) -> None:
    found = closest_complex(lines_of_the_h4(*pose))
    printed = np.array(axis)
    printed *= np.sign(printed[:3] @ found.direction)
    assert np.allclose([*found.direction, *found.moment], printed, atol=5e-4)
    assert found.pitch == pytest.approx(pitch, abs=1e-4)
    assert found.deviation < 2e-3
    assert closest_complex(lines_of_the_h4(0, 0, 0)).deviation > 0.05


@pytest.mark.parametrize(
    "pose",
    [(-8.50393, -9.59639, -1.5), (5.36667, -10.10858, -1.3), (12.51451, -6.80120, -1.1), (-9.58672, -9.41204, -1.508)],
)
def test_the_rods_of_the_h4_depend_along_a_curve(pose: tuple[float, float, float]) -> None:
    """The book has one such pose."""
    assert np.linalg.svd(lines_of_the_h4(*pose)[:4], compute_uv=False)[3] < 1e-5
    assert np.linalg.svd(lines_of_the_h4(0, 0, 0)[:4], compute_uv=False)[3] > 0.1


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
