"""Robots in other units: the same poses, scaled, whatever the kind; on request only."""

from __future__ import annotations

from dataclasses import replace
from fractions import Fraction
from pathlib import Path

import pytest
from samples import MODELS, model

from pkm_exact.cli.main import main
from pkm_exact.geometry.chains import Crank, Slide
from pkm_exact.geometry.length_units import METRES, in_unit
from pkm_exact.geometry.limits import Limits
from pkm_exact.geometry.reader import read_robot
from pkm_exact.geometry.robot import Robot
from pkm_exact.interactive import robots

Capture = pytest.CaptureFixture[str]
FILES = {path.stem: path for path in MODELS}
INCH = Fraction(127, 5)
LIMITED = """
[tolerances]
joints = 0.1
lengths = 0.2
[limits]
lengths = [2, 9]
position = [[0, 10], [0, 10]]
platform_cones = { axes = [0, 1], angle = 80 }
[nominal]
position = [5, 4]
degrees = 90
"""


def _limited(folder: Path, unit: str = "in") -> Path:
    path = folder / "limited.toml"
    text = FILES["3-rpr-merlet-p"].read_text().replace('unit = "1"', f'unit = "{unit}"')
    path.write_text(text.replace("lengths_squared = [50, 26, 25]", "lengths = [7.1, 5.1, 5]") + LIMITED)
    return path


def test_all_lengths_of_a_file_are_converted_and_nothing_else(tmp_path: Path, capsys: Capture) -> None:
    source, target = _limited(tmp_path), tmp_path / "new.toml"
    assert main(["convert", str(source), "--unit", "mm", "-o", str(target)]) == 0
    out, err = capsys.readouterr()
    assert out == f"{target}: all lengths times 127/5, in to mm\n"
    assert "how many decimals the numbers had is not to be seen" in err
    old, new = read_robot(source), read_robot(target)
    assert isinstance(old, Robot)
    assert isinstance(new, Robot)
    assert new.unit == "mm"
    assert new.source == f"{old.source}; converted from in to mm"
    assert new.base_joints[1] == (254, 0, 0)
    assert new.platform_joints[2] == (2 * INCH, 2 * INCH, 0)
    assert new.configuration().lengths_squared == tuple((INCH * x) ** 2 for x in map(Fraction, ("7.1", "5.1", "5")))
    assert new.tolerances is not None
    assert (new.tolerances.base, new.tolerances.lengths) == (INCH / 10, INCH / 5)
    assert new.limits is not None
    assert old.limits is not None
    assert new.limits.lengths == ((2 * INCH, 9 * INCH),) * 3
    assert new.limits.position[0] == (0, 254)
    assert new.limits.platform_cones == old.limits.platform_cones
    assert new.nominal is not None
    assert old.nominal is not None
    assert all(abs(x - y) < 1e-12 for x, y in zip(new.nominal.position, (5 * INCH, 4 * INCH, 0), strict=True))
    assert new.nominal.rotation[0][1] + 1 < 1e-12


@pytest.mark.parametrize("name", ["3-rrr", "3-prr", "hexa", "hexaglide"])
def test_cranks_and_slides_stand_where_they_stood(name: str) -> None:
    """The ends of the chains, and with them the poses, are those of the model times the factor."""
    before = model(name)
    assert isinstance(before, Robot)
    robot = robots.Robot(**{**vars(before), "unit": "mm"})
    for unit, metres in METRES.items():
        factor = METRES["mm"] / metres
        found = robot.in_unit(unit)
        assert isinstance(found, robots.Robot)
        assert len(found.configurations) == len(before.configurations)
        for old, new in zip(before.configurations, found.configurations, strict=True):
            for leg, chain in enumerate(found.chains):
                was = before.chains[leg]
                knee = was.knee(before.base_joints[leg], old.joint_values[leg])
                assert chain.knee(found.base_joints[leg], new.joint_values[leg]) == tuple(factor * x for x in knee)
                assert chain.rod_squared == factor**2 * was.rod_squared
                assert isinstance(chain, Crank if isinstance(was, Crank) else Slide)
            assert new.lengths_squared == tuple(factor**2 * x for x in old.lengths_squared)


def test_there_and_back_is_the_same_robot(tmp_path: Path) -> None:
    robot = read_robot(_limited(tmp_path))
    assert isinstance(robot, Robot)
    for unit in METRES:
        assert in_unit(in_unit(robot, unit), "in").limits == robot.limits
    assert in_unit(in_unit(robot, "m"), "in").written_digit == robot.written_digit
    spatial = model("rolland-6-6")
    assert isinstance(spatial, Robot)
    kept = in_unit(replace(spatial, limits=Limits(leg_distance=Fraction(3))), "m").limits
    assert kept == Limits(leg_distance=Fraction(3, 1000))


def test_digits_that_are_no_longer_seen_are_spoken_of(tmp_path: Path, capsys: Capture) -> None:
    source = _limited(tmp_path, "mm")
    words = ["convert", str(source), "-o", str(tmp_path / "new.toml"), "--force", "--unit"]
    assert main([*words, "m"]) == 0
    assert capsys.readouterr().err == ""
    assert main([*words, "in"]) == 0
    assert "is not to be seen in the new file" in capsys.readouterr().err


@pytest.mark.parametrize(
    ("model_name", "unit", "part"),
    [
        ("rolland-6-6", "inch", "--unit: 'inch' is no unit that is known; use one of: mm, cm, m, in, ft"),
        ("3-rpr-merlet-p", "mm", "unit: '1' is no unit that is known"),
        ("delta", "mm", "convert"),
    ],
)
def test_what_is_not_known_is_refused(model_name: str, unit: str, part: str, tmp_path: Path, capsys: Capture) -> None:
    target = tmp_path / "new.toml"
    assert main(["convert", str(FILES[model_name]), "--unit", unit, "-o", str(target)]) == 2
    err = capsys.readouterr().err
    assert part in err
    assert err.splitlines()[-1].startswith("certify-poses: error: ")
    assert not target.exists()


def test_nothing_is_overwritten_unasked(tmp_path: Path, capsys: Capture) -> None:
    source, target = _limited(tmp_path), tmp_path / "new.toml"
    target.write_text("mine")
    assert main(["convert", str(source), "--unit", "mm", "-o", str(target)]) == 2
    assert main(["convert", str(source), "--unit", "mm", "-o", str(source), "--force"]) == 2
    err = capsys.readouterr().err
    assert "exists; give -o another path, or --force" in err
    assert "is the model file itself" in err
    assert target.read_text() == "mine"
