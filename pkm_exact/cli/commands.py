"""All commands of ``certify-poses``. Everything heavy is imported inside a command, so that ``--help`` is quick."""

from __future__ import annotations

from typing import Final

import click

from pkm_exact.cli.check_command import check
from pkm_exact.cli.codegen import codegen
from pkm_exact.cli.compare_commands import compare
from pkm_exact.cli.formulation_commands import export, formulations
from pkm_exact.cli.legs import legs
from pkm_exact.cli.mobility_command import mobility
from pkm_exact.cli.new import new
from pkm_exact.cli.plot import plot
from pkm_exact.cli.region import region
from pkm_exact.cli.report_command import report
from pkm_exact.cli.selftest import selftest
from pkm_exact.cli.shell_completion import completion
from pkm_exact.cli.solve import solve
from pkm_exact.cli.statics_command import statics
from pkm_exact.cli.sweep import sweep
from pkm_exact.cli.track import track

COMMANDS: Final = (
    new,
    solve,
    check,
    formulations,
    export,
    legs,
    statics,
    mobility,
    compare,
    track,
    sweep,
    region,
    plot,
    report,
    codegen,
    selftest,
    completion,
)


def _show_versions(context: click.Context, _option: click.Parameter, wanted: bool) -> None:
    if not wanted or context.resilient_parsing:
        return
    from pkm_exact.support.installation import version_lines

    for line in version_lines():
        click.echo(line)
    context.exit()


@click.group(context_settings={"help_option_names": ["-h", "--help"], "max_content_width": 100})
@click.option(
    "--version",
    is_flag=True,
    is_eager=True,
    expose_value=False,
    callback=_show_versions,
    help="Show the versions of all that matters, and exit.",
)
def certify_poses() -> None:
    """Find every pose of a parallel robot exactly, and certify it.

    \b
    Examples:
      certify-poses selftest
      certify-poses new --kind 6-6 --base-sides 400,200 --platform-sides 100,300 --height 500 -o my-robot.toml
      certify-poses solve my-robot.toml -o my-robot.json
      certify-poses check my-robot.json

    Exit codes: 0 done and complete, or accepted; 1 a certificate was rejected; 2 bad input or usage; 3 done, but the
    claim is weaker than complete; 4 no answer; 130 interrupted; 141 the reader of the output went away.
    """


for command in COMMANDS:
    certify_poses.add_command(command)
