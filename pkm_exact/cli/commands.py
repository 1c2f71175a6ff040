"""All commands of ``certify-poses``. Everything heavy is imported inside a command, so that ``--help`` is quick."""

from __future__ import annotations

from typing import Final

import click

import pkm_exact
from pkm_exact.cli.check import check
from pkm_exact.cli.compare_commands import compare
from pkm_exact.cli.formulation_commands import export, formulations
from pkm_exact.cli.legs import legs
from pkm_exact.cli.solve import solve
from pkm_exact.cli.track import track

COMMANDS: Final = (
    solve,
    check,
    formulations,
    export,
    legs,
    compare,
    track,
)


@click.group(context_settings={"help_option_names": ["-h", "--help"], "max_content_width": 100})
@click.version_option(pkm_exact.__version__, message="%(prog)s %(version)s")
def certify_poses() -> None:
    """Find every pose of a parallel robot exactly, and certify it.

    Exit codes: 0 done and complete, or accepted; 1 a certificate was rejected; 2 bad input or usage; 3 done, but the
    claim is weaker than complete; 4 no answer.
    """


for command in COMMANDS:
    certify_poses.add_command(command)
