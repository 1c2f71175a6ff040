"""First models of bodies and joints: the shipped ones, and what they are with other dimensions."""

from pathlib import Path

import pytest

from pkm_exact import Screw, ScrewSystem, mobility_of, read_linkage
from pkm_exact.cli.main import main
from pkm_exact.cli.new import CHAIN_NAMES
from pkm_exact.geometry.linkage import Linkage
from pkm_exact.templates.chain_templates import CHAIN_TEMPLATES, template_linkage

CHAINS = Path(__file__).parent.parent / "models" / "chains"
SHIPPED = {
    "3-PPRR": "3-pprr",
    "Sarrus": "sarrus",
    "seven-link": "seven-link",
    "5-RRR(RR)": "5-rrr-rr",
    "3-PRRR": "3-prrr",
    "3-UPU": "3-upu",
}


def test_the_option_names_every_template() -> None:
    assert list(CHAIN_NAMES) == list(CHAIN_TEMPLATES) == list(SHIPPED)


def _lines(linkage: Linkage) -> dict[str, list[ScrewSystem]]:
    return {
        joint.name: [ScrewSystem.span([Screw.from_coordinates(twist)]) for twist in joint.twists]
        for joint in linkage.joints
    }


@pytest.mark.parametrize("name", SHIPPED)
def test_the_examples_are_the_shipped_mechanisms(name: str) -> None:
    """But for the rises of the 3-PPRR, which differ in the file."""
    found, shipped = template_linkage(name), read_linkage(CHAINS / f"{SHIPPED[name]}.toml")
    assert found.actuated == shipped.actuated
    different = {joint for joint, lines in _lines(found).items() if lines != _lines(shipped)[joint]}
    assert different == ({"RC2", "RC3"} if name == "3-PPRR" else set())


@pytest.mark.parametrize(
    ("name", "sizes", "mobility", "platform"),
    [
        ("3-PPRR", ["half_tangent_2=1/3", "rise=5"], 4, 1),
        ("Sarrus", ["half_tangent=2", "left=7"], 1, 1),
        ("Sarrus", ["half_tangent=0"], 3, 3),
        ("seven-link", ["height=6"], 2, 1),
        ("3-PRRR", ["aside_2=31/7"], 3, 3),
        ("3-UPU", ["height=100", "half_tangent=3/2"], 3, 3),
    ],
)
def test_other_dimensions_leave_the_mobility(name: str, sizes: list[str], mobility: int, platform: int) -> None:
    free = mobility_of(template_linkage(name, sizes), among=[]).free
    assert (free.total, free.platform.rank) == (mobility, platform)


def test_the_command_writes_what_is_read_back(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    path = tmp_path / "rods.toml"
    assert main(["new", "--chains", "3-upu", "--dimension", "height=100", "-o", str(path)]) == 0
    assert "9 joints" in capsys.readouterr().out
    written = read_linkage(path)
    assert (written.name, written.unit) == ("rods", "mm")
    assert _lines(written) == _lines(template_linkage("3-UPU", ["height=100"]))
    assert main(["new", "--chains", "Sarrus", "-o", "-"]) == 0
    assert capsys.readouterr().out.startswith("schema = 1")


@pytest.mark.parametrize(
    ("words", "sentence"),
    [
        (["--dimension", "width=3"], "--dimension: 'width=3' is none of a Sarrus; give one of: left, left_knee"),
        (["--dimension", "left"], "is none of a Sarrus"),
        (["--dimension", "left=three"], "--dimension left"),
        (["--kind", "delta"], "--chains and --kind exclude each other"),
        (["--height", "3"], "--chains and --height exclude each other"),
    ],
)
def test_what_is_no_dimension_is_refused(
    words: list[str], sentence: str, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    path = tmp_path / "bars.toml"
    assert main(["new", "--chains", "Sarrus", *words, "-o", str(path)]) == 2
    assert sentence in capsys.readouterr().err
    assert not path.exists()
