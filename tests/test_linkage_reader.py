"""Model files of bodies and joints: what is read, and what is refused in one sentence."""

from pathlib import Path

import pytest

from pkm_exact import InputError, read_linkage, read_robot
from pkm_exact.geometry.joint_types import JOINT_TYPES
from pkm_exact.geometry.linkage import Linkage

ROOT = Path(__file__).parent.parent
SHIPPED = sorted((ROOT / "models" / "chains").glob("*.toml"))

HEAD = 'schema = 1\nname = "x"\nkind = "chains"\nunit = "mm"\nsource = "a test"\n'
BODIES = '[[bodies]]\nname = "a"\n[[bodies]]\nname = "b"\n'
EXAMPLES = {
    "R": ("point = [1, 2, 3]\naxis = [0, 0, 1]", 1),
    "P": ("axis = [0, 0, 1]", 1),
    "H": ('point = [1, 2, 3]\naxis = [0, 0, 1]\npitch = "1/3"', 1),
    "C": ("point = [1, 2, 3]\naxis = [0, 0, 1]", 2),
    "U": ("point = [1, 2, 3]\naxes = [[0, 0, 1], [1, 0, 0]]", 2),
    "S": ("point = [1, 2, 3]", 3),
    "screw": ("screws = [[0, 0, 1, 0, 0, 0], [0, 0, 0, 1, 0, 0.5]]", 2),
}


def _joint(type_: str = "R", fields: str = EXAMPLES["R"][0], bodies: str = '["a", "b"]', name: str = "j") -> str:
    return f'[[joints]]\nname = "{name}"\ntype = "{type_}"\nbodies = {bodies}\n{fields}\n'


def _read(text: str, folder: Path) -> Linkage:
    path = folder / "model.toml"
    path.write_text(text)
    return read_linkage(path)


@pytest.mark.parametrize("type_", JOINT_TYPES)
def test_every_type_of_joint_is_read(type_: str, tmp_path: Path) -> None:
    fields, freedoms = EXAMPLES[type_]
    found = _read(HEAD + BODIES + _joint(type_, fields + "\nactuated = true"), tmp_path)
    assert len(found.freedoms) == len(found.actuated) == freedoms
    assert (found.base, found.platform) == ("a", "b")
    assert all(any(twist) for twist in found.joints[0].twists)


@pytest.mark.parametrize("path", SHIPPED, ids=lambda path: path.stem)
def test_shipped_mechanisms_are_read(path: Path) -> None:
    found = read_linkage(path)
    assert found.actuated
    assert path.name in (ROOT / "docs" / "mobility.md").read_text()


def test_actuated_names_single_freedoms(tmp_path: Path) -> None:
    found = _read(HEAD + BODIES + _joint("U", EXAMPLES["U"][0] + "\nactuated = [2]"), tmp_path)
    assert found.actuated == ("j.2",)


@pytest.mark.parametrize(
    ("text", "words"),
    [
        (BODIES, "joints: is missing"),
        (_joint(), "bodies: is missing"),
        ("bodies = 3\n", "bodies: 3 is not a list of tables"),
        (BODIES + "joints = []\n", "unknown key|bodies"),
        (BODIES + _joint("X"), "joints\\[1\\].type: 'X' is unknown; use one of: R, P, H"),
        (BODIES + _joint("R", "axis = [0, 0, 1]"), "joints\\[1\\].point: is missing"),
        (BODIES + _joint("P", "point = [0, 0, 0]\naxis = [0, 0, 1]"), "unknown key 'point'"),
        (BODIES + _joint("P", "axis = [0, 0, 0]"), "an axis is 0"),
        (BODIES + _joint("U", "point = [0, 0, 0]\naxes = [[0, 0, 1]]"), "not a list of 2 axes"),
        (BODIES + _joint("screw", "screws = [[0, 0, 0, 0, 0, 0]]"), "all six numbers are 0"),
        (BODIES + _joint("screw", "screws = [[0, 0, 1]]"), "not a list of six numbers"),
        (BODIES + _joint("screw", "screws = []"), "not a list of 1 to 6 screws"),
        (BODIES + _joint(bodies='["a", "c"]'), "'c' is not the name of a body"),
        (BODIES + _joint(bodies='["a", "a"]'), "'a' twice"),
        (BODIES + _joint(bodies='["a"]'), "not two names of bodies"),
        (BODIES + _joint() + _joint(), "the name 'j' is used twice"),
        (BODIES + '[[bodies]]\nname = "a"\n' + _joint(), "the name 'a' is used twice"),
        (BODIES + '[[bodies]]\nname = "c"\n' + _joint(), "no chain of joints connects 'c' with 'a'"),
        (BODIES + _joint(fields=EXAMPLES["R"][0] + "\nactuated = [2]"), "list of different numbers from 1 to 1"),
        (BODIES + _joint(fields=EXAMPLES["R"][0] + '\nactuated = "yes"'), "'yes' does not say"),
        (BODIES + _joint(fields="point = [1, 2]\naxis = [0, 0, 1]"), "joints\\[1\\].point: a list of 2"),
        ('base = "z"\n' + BODIES + _joint(), "base: 'z' is not the name of a body"),
        ('platform = "a"\n' + BODIES + _joint(), "platform: 'a' is the base too"),
        ("metric = [1, 3, 1]\n" + BODIES + _joint(), "unknown key 'metric'"),
        (BODIES + "".join(_joint("S", "point = [0, 0, 0]", name=f"j{i}") for i in range(43)), "at most 128"),
    ],
)
def test_defects_are_named(text: str, words: str, tmp_path: Path) -> None:
    with pytest.raises(InputError, match=words):
        _read(HEAD + text, tmp_path)


def test_kinds_are_not_taken_for_each_other() -> None:
    with pytest.raises(InputError, match="ask certify-poses mobility"):
        read_robot(SHIPPED[0])
    with pytest.raises(InputError, match="not a mechanism of bodies and joints"):
        read_linkage(ROOT / "models" / "mssm.toml")
