"""The page of guarantees names what the program can claim and do, and nothing that it cannot."""

import re
from pathlib import Path

from pkm_exact.claim import Claim, CompletenessRoute
from pkm_exact.cli.commands import COMMANDS
from pkm_exact.cli.methods import METHODS
from pkm_exact.numeric.uncertified import UNCERTIFIED

ROOT = Path(__file__).parent.parent
PAGE = (ROOT / "docs" / "guarantees.md").read_text(encoding="utf-8")


def _section(heading: str) -> str:
    """The text between a heading of the second rank and the next one."""
    return PAGE.split(f"\n## {heading}\n")[1].split("\n## ")[0]


def test_every_verdict_has_a_paragraph_and_there_is_no_other() -> None:
    headings = re.findall(r"^### `([\w-]+)`$", _section("Verdicts"), re.MULTILINE)
    assert sorted(headings) == sorted([*map(str, Claim), UNCERTIFIED])


def test_every_verdict_says_what_is_proved_and_what_is_not() -> None:
    for paragraph in re.split(r"^### ", _section("Verdicts"), flags=re.MULTILINE)[1:]:
        assert re.search(r"\*Proved", paragraph), paragraph[:30]
        if "uncertified" not in paragraph.splitlines()[0]:
            assert re.search(r"Not claimed|no more", paragraph), paragraph[:30]


def test_every_route_to_completeness_is_explained() -> None:
    assert sorted(re.findall(r"^`([\w-]+)`$", PAGE, re.MULTILINE)) == sorted(map(str, CompletenessRoute))


def test_every_command_and_method_has_a_row() -> None:
    rows = [row.split("|")[1:-1] for row in _section("In one table").splitlines() if row.startswith("| `")]
    named = " ".join(row[0] for row in rows)
    assert [name for name in COMMANDS if f"`certify-poses {name}" not in named] == []
    assert [method for method in METHODS if not re.search(rf"\b{method}\b", named)] == []
    assert all(len(row) == 4 for row in rows)
    assert set(re.findall(r"certify-poses (\w+)", PAGE)) <= set(COMMANDS)


def test_what_is_said_to_be_tested_or_trusted_exists() -> None:
    named = re.findall(r"`((?:tests|pkm_exact)/[\w./]+)`", PAGE)
    assert len(named) > 15
    assert [name for name in named if not (ROOT / name).exists()] == []
