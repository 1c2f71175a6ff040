"""All commands of ``certify-poses``. Everything heavy is imported inside a command, so that ``--help`` is quick."""

from __future__ import annotations

from importlib import import_module
from typing import Final

import click

COMMANDS: Final = {
    "new": ("new", "Write a first model file, from a few answers."),
    "convert": ("convert", "A model file in another unit of length."),
    "solve": ("solve", "All real poses of a robot, and a certificate."),
    "check": ("check_command", "Replay certificates, or recompute them."),
    "formulations": ("formulation_commands", "All formulations on one robot, side by side."),
    "export": ("formulation_commands", "The equations in another program's syntax."),
    "legs": ("legs", "Leg lengths and joint values at a given pose."),
    "statics": ("statics_command", "Jacobians, wrenches and singularities at a pose."),
    "mobility": ("mobility_command", "Freedoms of a mechanism, exactly, and which actuators hold it."),
    "identify": ("identify", "Which geometric parameters a plan of measurements tells apart."),
    "compare": ("compare_commands", "Numeric methods held against the certified poses."),
    "track": ("track", "Follow one assembly mode along a joint path."),
    "sweep": ("sweep", "All poses at each of many length vectors."),
    "region": ("region", "Is all of a region of poses good? Or where is it?"),
    "calibrate": ("calibrate", "Joints and length offsets from measured poses."),
    "plot": ("plot", "Pictures of the poses in a certificate."),
    "view": ("view", "The robot in the browser, with sliders."),
    "report": ("report_command", "A web page of a certificate."),
    "codegen": ("codegen", "Forward and inverse kinematics as C code, with proved bounds."),
    "selftest": ("selftest", "Check that this installation works."),
    "completion": ("shell_completion", "Completion of commands and options in your shell."),
}
"""By name: the module in this folder, and what the command does in a few words."""


class Commands(click.Group):
    """Commands that are loaded when they are used: ``--help`` needs none of them, and a command only itself."""

    def list_commands(self, ctx: click.Context) -> list[str]:
        """All names, in the order of the help."""
        del ctx
        return list(COMMANDS)

    def get_command(self, ctx: click.Context, cmd_name: str) -> click.Command | None:
        """The command of that name."""
        del ctx
        return command(cmd_name) if cmd_name in COMMANDS else None

    def format_commands(self, ctx: click.Context, formatter: click.HelpFormatter) -> None:
        """The names with their few words."""
        del ctx
        with formatter.section("Commands"):
            formatter.write_dl([(name, words) for name, (_, words) in COMMANDS.items()])


def command(name: str) -> click.Command:
    """One of the commands, with the few words of its row.

    >>> command("legs").short_help
    'Leg lengths and joint values at a given pose.'
    """
    module, words = COMMANDS[name]
    found: click.Command = getattr(import_module(f"pkm_exact.cli.{module}"), name)
    found.short_help = words
    return found


def _show_versions(context: click.Context, _option: click.Parameter, wanted: bool) -> None:
    if not wanted or context.resilient_parsing:
        return
    from pkm_exact.support.installation import version_lines

    for line in version_lines():
        click.echo(line)
    context.exit()


@click.group(cls=Commands, context_settings={"help_option_names": ["-h", "--help"], "max_content_width": 100})
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
