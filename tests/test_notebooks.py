"""Every notebook runs from its first cell to its last; the identities and counts in it are its own assertions."""

import os
import subprocess
import sys
from pathlib import Path

import pytest

ROOT = Path(__file__).parent.parent
NOTEBOOKS = sorted((ROOT / "notebooks").glob("*.py"))
QUICK = (
    "derive_displacement",
    "eight_poses_of_the_h4",
    "errors_of_the_linapod",
    "forces_of_a_grasp",
    "how_it_moves",
    "tensions_of_the_robocrane",
    "wrenches_of_planar_machines",
)
EACH = [pytest.param(path, id=path.stem, marks=() if path.stem in QUICK else pytest.mark.slow) for path in NOTEBOOKS]


def _run(notebook: Path, folder: Path, **variables: str) -> str:
    """What a notebook prints, executed as a script."""
    environment = os.environ | {"MPLBACKEND": "Agg", "MPLCONFIGDIR": str(folder)} | variables
    command = [sys.executable, "-W", "error", str(notebook)]
    done = subprocess.run(command, capture_output=True, text=True, cwd=ROOT, env=environment)
    assert done.returncode == 0, done.stderr
    return done.stdout


def test_the_four_documents_are_there() -> None:
    names = {notebook.stem for notebook in NOTEBOOKS}
    assert names >= {"derive_displacement", "derive_position", "compare_formulations", "motion_variety"}


@pytest.mark.parametrize("notebook", EACH)
def test_notebook_runs(notebook: Path, tmp_path: Path) -> None:
    assert _run(notebook, tmp_path, PKM_EXACT_QUICK="1")


@pytest.mark.slow
@pytest.mark.largest
def test_the_comparison_runs_on_all_formulations(tmp_path: Path) -> None:
    printed = _run(ROOT / "notebooks" / "compare_formulations.py", tmp_path, PKM_EXACT_QUICK="0")
    assert "all formulations give the same 16 boxes" in printed
    assert "AFD2" in printed


@pytest.mark.parametrize("notebook", NOTEBOOKS, ids=lambda path: path.stem)
def test_notebook_begins_with_a_question_and_ends_with_the_answer(notebook: Path) -> None:
    cells = notebook.read_text(encoding="utf-8").split("\n# %%")
    assert cells[0].startswith("# %% [markdown]\n# # ")
    assert "?" in cells[0]
    assert any("# ## Answer\n" in cell for cell in cells[-3:])
