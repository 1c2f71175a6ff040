"""What documents say of robots, from ``models/``, ``certs/`` and the registry of machines.

``python tests/robots_table.py`` writes the table in README.md, and the kinds in docs/machines.md.
"""

from __future__ import annotations

import json
from pathlib import Path
from typing import Final

from pkm_exact.geometry.machines.machine_kind import MachineKind
from pkm_exact.geometry.machines.machine_kinds import MACHINES
from pkm_exact.geometry.reader import read_links, read_robot

ROOT: Final = Path(__file__).parent.parent
_HEAD: Final = "| file in `models/` | robot | kind | complex solutions | real poses |\n|---|---|---|---|---|\n"
_CLAIMS: Final = {
    "inconsistent": ("none", "none, proved"),
    "positive-dimensional-proved": ("infinitely many", "moves"),
}


def row(path: Path) -> str:
    """The row of a model: who it is, and what is proved of its first configuration."""
    robot = read_robot(path)
    certificate = json.loads((ROOT / "certs" / f"{path.stem}.json").read_bytes())
    counts = certificate["complex_solutions"], certificate["real_poses"]
    found = _CLAIMS.get(certificate["claim"], counts)
    return f"| `{path.name}` | {robot.name} | {robot.kind} | {found[0]} | {found[1]} |\n"


def links_row(path: Path) -> str:
    """The same of a mechanism with passive bodies; of some one pose is proved."""
    links = read_links(path)
    system = json.loads((ROOT / "certs" / "links" / f"{path.stem}.json").read_bytes())["system"]
    counts = ("not known", "1 proved") if system is None else (system["complex_solutions"], system["real_solutions"])
    return f"| `links/{path.name}` | {links.name} | {links.kind} | {counts[0]} | {counts[1]} |\n"


def table() -> str:
    """All rows, by name."""
    models = ROOT / "models"
    rows = [*map(row, sorted(models.glob("*.toml"))), *map(links_row, sorted((models / "links").glob("*.toml")))]
    return _HEAD + "".join(rows)


def replaced(text: str) -> str:
    """The README with its table made anew."""
    start = text.index("| file in `models/` |")
    end = text.index("\n\n", start) + 1
    return text[:start] + table() + text[end:]


_BEGIN: Final = "<!-- kinds, written by tests/robots_table.py -->"
_END: Final = "<!-- end of kinds -->"


def kind_section(kind: MachineKind) -> str:
    """What a model file of a kind has: its dimensions, and the keys of configurations."""
    lines = [f"### {kind.name}", "", f'`kind = "{kind.name}"`: {kind.description}. Motion: {kind.motion.name}.']
    for table in kind.tables:
        lines += ["", f"| in `[{table}]` | meaning | example |", "|---|---|---|"]
        for dimension in kind.dimensions:
            if dimension.table == table:
                optional = ", optional" if dimension.is_optional else ""
                lines.append(f"| `{dimension.key}` | {dimension.what}{optional} | `{dimension.example}` |")
    home = ", ".join(f"`{key} = {value}`" for key, value in kind.home.items())
    return "\n".join([*lines, "", f"Configurations: such as {home}.", ""])


def kinds() -> str:
    """The sections of all kinds."""
    return "\n".join([_BEGIN, "", *map(kind_section, MACHINES.values()), _END])


def with_kinds(text: str) -> str:
    """The page of machines with its kinds made anew."""
    start, end = text.index(_BEGIN), text.index(_END) + len(_END)
    return text[:start] + kinds() + text[end:]


PAGES: Final = {ROOT / "README.md": replaced, ROOT / "docs" / "machines.md": with_kinds}


if __name__ == "__main__":
    for page, renewed in PAGES.items():
        page.write_text(renewed(page.read_text(encoding="utf-8")), encoding="utf-8")
