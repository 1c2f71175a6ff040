"""The reconfigurable robot of chapter 18 with its other legs: counts in its modes, and the mobility that is printed."""

from fractions import Fraction

import pytest

from pkm_exact.claim import Claim
from pkm_exact.engine import solve
from pkm_exact.geometry.drive_modes import joint_values
from pkm_exact.geometry.inverse import rotation_of
from pkm_exact.geometry.joint_types import JointGeometry
from pkm_exact.geometry.linkage import Joint, Linkage
from pkm_exact.geometry.machines.machine_kinds import MACHINES
from pkm_exact.geometry.mechanism import Mechanism
from pkm_exact.geometry.reader import robot_from_toml
from pkm_exact.mobility.analysis import mobility_of
from pkm_exact.solution import Solution
from pkm_exact.templates.machine_text import given_dimensions, machine_text

FIXED = ("1/2", "2/3", "3/5")
DETACHED = ("4/7", "5/8", "5/9")
UNTURNED = rotation_of((Fraction(1), Fraction(0), Fraction(0), Fraction(0)), (1, 3, 1))


def robot(kind: str, freedoms: int) -> Mechanism:
    """A machine in a mode, its joints at values of which nothing is special."""
    free, locked = freedoms - 3, 6 - freedoms
    cranks = DETACHED[:free]
    values: dict[str, tuple[object, ...]] = {}
    if kind in ("R-TUS", "R-TCS"):
        cranks = (*FIXED, *cranks) if kind == "R-TUS" else ("1/3", "2/5", "3/8", *cranks)
    elif kind == "UP-VS":
        values["lengths"] = 150, 160, 145
    else:
        values["slides"] = (50, 53, 47)[:locked]
        values["lengths"] = (70, 75, 66)[:free]
    values["half_tangents"] = cranks
    text = machine_text(MACHINES[kind], "r", "mm", given_dimensions(MACHINES[kind], (f'freedoms="{freedoms}"',)))
    text = text[: text.index('name = "home"')] + 'name = "home"\n'
    found = robot_from_toml(text + "".join(f"{key} = {list(row)}\n" for key, row in values.items() if row))
    assert isinstance(found, Mechanism)
    return found


def solution(kind: str, freedoms: int) -> Solution:
    machine = robot(kind, freedoms)
    return solve(machine.problem(machine.configuration()))


@pytest.mark.parametrize(
    ("kind", "freedoms", "count"),
    [
        *((kind, m, count) for kind in ("R-TUS", "UP-VS") for m, count in ((3, 16), (4, 32), (5, 40), (6, 40))),
        *((kind, m, count) for kind in ("CP-VS", "R-TCS") for m, count in ((3, 8), (4, 24))),
    ],
)
def test_modes_have_as_many_poses_as_said(kind: str, freedoms: int, count: int) -> None:
    found = solution(kind, freedoms)
    assert (found.claim, found.complex_solutions) == (Claim.COMPLETE, count)


@pytest.mark.slow
@pytest.mark.parametrize(
    ("kind", "freedoms", "count"),
    [
        ("CP-VS", 5, 96),
        *(
            pytest.param(*row, marks=pytest.mark.largest)
            for row in [("R-TCS", 5, 96), ("CP-VS", 6, 320), ("R-TCS", 6, 320)]
        ),
    ],
)
def test_joints_on_cylinders_have_more_poses(kind: str, freedoms: int, count: int) -> None:
    found = solution(kind, freedoms)
    assert (found.claim, found.complex_solutions) == (Claim.COMPLETE, count)


def test_a_strut_is_as_long_as_its_joint_is_from_the_guide() -> None:
    """With a locked hinge the slide q is s / sqrt(2), without one the length is s: both say the same of a pose."""
    place = (Fraction(0), Fraction(0), Fraction(150))
    modes = {freedoms: joint_values(robot("CP-VS", freedoms), place, UNTURNED) for freedoms in (3, 6)}
    (slide,) = modes[3][0].modes
    (strut,) = modes[6][0].modes
    assert slide.position.p == 50  # type: ignore[union-attr]
    length = strut.position  # type: ignore[union-attr]
    assert length.p == 0
    assert length.q * length.q * length.n == 2 * 50**2


# Mobility, table 3


SORTS = {"R-TUS": "RUS", "P-FUS": "PUS", "UP-VS": "UPS", "CP-VS": "CPS", "R-TCS": "RCS"}
"""Of the fixed legs of the five architectures that remain of the source's tables: their joints from the base on."""


def _leg(k: int, half: Fraction, sort: str, *, locked: bool, turn: int) -> tuple[list[str], list[Joint]]:
    """Three joints in the vertical plane of a direction; of the one with two freedoms the turn out of it is locked."""
    c, s = (1 - half * half) / (1 + half * half), 2 * half / (1 + half * half)

    def vector(radius: int, height: int) -> tuple[Fraction, Fraction, Fraction]:
        return radius * c, radius * s, Fraction(height)

    places = {"base": vector(100, 0), "elbow": vector(130, 70), "ball": vector(50, 150)}
    across, guide, strut = (-s, c, Fraction(0)), vector(-2, 3), vector(3, 2 + turn)
    axes = {"R": (across,), "P": (strut if sort[0] in "UC" else guide,), "U": (across, strut), "C": (guide,), "S": ()}
    bodies = [f"first {k}", f"second {k}"]
    between = [("base", bodies[0]), (bodies[0], bodies[1]), (bodies[1], "platform")]
    joints = []
    for letter, pair, place in zip(sort, between, places.values(), strict=True):
        kept = {"U": "R", "C": "P"}.get(letter, letter) if locked else letter
        own = axes[letter][:1] if locked else axes[letter]
        joints.append(Joint(f"{letter}{k}", kept, pair, JointGeometry(place, own)))  # type: ignore[arg-type]
    return bodies, joints


def robot_in_mode(freedoms: int, sort: str) -> Linkage:
    """The fixed tripod, of which 6 - m hinges are locked, and m - 3 detachable legs R_TUS between."""
    azimuths = [Fraction(0), Fraction(7, 4), Fraction(-7, 4), Fraction(4, 7), Fraction(40), Fraction(-4, 7)]
    bodies, joints = ["base"], []
    for k, half in enumerate(azimuths[:freedoms], 1):
        names, found = _leg(k, half, sort if k <= 3 else "RUS", locked=k <= 6 - freedoms, turn=k)
        bodies += names
        joints += found
    return Linkage(sort, "mm", "chapter 18", (*bodies, "platform"), tuple(joints), "base", "platform")


def test_the_architectures_that_remain_are_the_kinds() -> None:
    """Five: of all recipes those with a mode of so many freedoms."""
    kinds = [name for name, kind in MACHINES.items() if any(found.key == "freedoms" for found in kind.dimensions)]
    assert sorted(kinds) == sorted(SORTS)


@pytest.mark.parametrize(
    "kind", [pytest.param(kind, marks=[] if kind in ("P-FUS", "R-TCS") else pytest.mark.slow) for kind in SORTS]
)
@pytest.mark.parametrize(
    ("freedoms", "links", "count", "legs", "locked"),
    [
        (3, 8, 9, (5, 5, 5), 3),
        (4, 10, 12, (5, 5, 6, 6), 2),
        (5, 12, 15, (5, 6, 6, 6, 6), 1),
        (6, 14, 18, (6,) * 6, 0),
    ],
)
def test_printed_mobilities_are_those_of_the_screws(
    kind: str, freedoms: int, links: int, count: int, legs: tuple[int, ...], locked: int
) -> None:
    """Table 3: numbers of links and joints, freedoms of the legs, and by Gruebler's count those of the platform."""
    linkage = robot_in_mode(freedoms, SORTS[kind])
    assert (len(linkage.bodies), len(linkage.joints)) == (links, count)
    rows = [linkage.joints[3 * k : 3 * k + 3] for k in range(freedoms)]
    assert tuple(sum(len(joint.twists) for joint in row) for row in rows) == legs
    assert legs.count(5) == locked == 6 - freedoms
    assert 6 * (links - count - 1) + sum(legs) == freedoms
    found = mobility_of(linkage)
    assert (found.free.counted, found.free.total) == (freedoms, freedoms)
