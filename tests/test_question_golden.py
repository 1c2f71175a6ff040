"""Golden certificates of questions: they come out again byte by byte, and both checkers accept them."""

from __future__ import annotations

from pathlib import Path

import pytest
from certificate_tools import CERTS

from pkm_exact.certify import pure
from pkm_exact.certify.check import Status, check_bytes
from pkm_exact.cli.main import main

ROOT = CERTS.parent
LIMITS = [text for limit in ("speeds=1", "forces=2", "length=3") for text in ("--limits", limit)]
COMMANDS = {
    "statics/3-rpr-merlet-p": [
        "statics",
        "models/3-rpr-merlet-p.toml",
        "--position",
        "5,9/2",
        "--half-tangent",
        "1/3",
        *LIMITS,
    ],
    "statics/dual-v": [
        "statics",
        "models/dual-v.toml",
        "--position",
        "0,0",
        "--half-tangent",
        "0",
        "--modes",
        "+-+-",
        *LIMITS,
    ],
    "mobility/3-rps": ["mobility", "models/3-rps.toml", "--at", "0,0,1/2,1,0,0,0"],
    "mobility/bennett": ["mobility", "models/chains/bennett.toml"],
    "mobility/bricard": ["mobility", "models/chains/bricard.toml"],
    "statics/3-rps": [
        "statics",
        "certs/3-rps.json",
        "--model",
        "models/3-rps.toml",
        "--pose",
        "2",
        *LIMITS,
        "--load",
        "0,0,-10",
    ],
    "statics/3-prs": [
        "statics",
        "certs/3-prs.json",
        "--model",
        "models/3-prs.toml",
        "--pose",
        "1",
        *LIMITS,
        "--load",
        "0,0,-10",
    ],
    "mobility/seven-link-oblique": ["mobility", "models/chains/seven-link-oblique.toml"],
    "regions/3-rpr-merlet-p": ["region", "models/3-rpr-merlet-p.toml", "certs/regions/3-rpr-merlet-p.toml"],
    "regions/rolland-6-6": ["region", "models/rolland-6-6.toml", "certs/regions/rolland-6-6.toml"],
}


@pytest.mark.parametrize("name", COMMANDS)
def test_it_comes_out_again_and_is_accepted(name: str, tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.chdir(ROOT)
    target = tmp_path / "out.json"
    assert main([*COMMANDS[name], "-o", str(target)]) == 0
    data = (CERTS / f"{name}.json").read_bytes()
    assert target.read_bytes() == data
    assert check_bytes(data).status is Status.ACCEPTED
    assert pure.check_bytes(data).status == "accepted"


def test_every_one_has_its_command_in_the_makefile() -> None:
    makefile = (ROOT / "Makefile").read_text()
    found = {
        f"{path.parent.name}/{path.stem}"
        for part in ("statics", "regions", "mobility")
        for path in (CERTS / part).glob("*.json")
    }
    assert found == set(COMMANDS)
    assert all(f"{' '.join(command)} -o certs/{name}.json" in makefile for name, command in COMMANDS.items())
