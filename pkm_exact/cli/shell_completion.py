"""The commands ``completion``, and what a shell asks for when the tabulator is pressed."""

from __future__ import annotations

import os
import sys
from typing import TYPE_CHECKING, Final

import click

from pkm_exact.cli.program import COMPLETIONS, PROGRAM, ROOTS, ExitCode
from pkm_exact.errors import InputError

if TYPE_CHECKING:
    from click.shell_completion import CompletionItem

SHELLS: Final = ("bash", "zsh", "fish")


@click.command()
@click.argument("shell", type=click.Choice(SHELLS))
def completion(shell: str) -> int:
    """Print the script that makes SHELL complete commands, options, files and configurations of a model.

    \b
    Examples:
      certify-poses completion bash > certify-poses.bash
      certify-poses completion zsh
      certify-poses completion fish

    bash: put the first into a file that ~/.bashrc sources. zsh: a file _certify-poses in a folder of $fpath. fish: the
    file ~/.config/fish/completions/certify-poses.fish.
    """
    sys.stdout.write(_completer(shell, PROGRAM, _group()).source() + "\n")
    return ExitCode.DONE


@click.command("completion", short_help="Completion of commands and options in your shell.")
@click.argument("shell", type=click.Choice(SHELLS))
def roots_completion(shell: str) -> int:
    """Print the script that makes SHELL complete commands, options and files.

    \b
    Examples:
      certify-roots completion bash > certify-roots.bash
      certify-roots completion zsh

    Files as for certify-poses completion, with certify-roots in their names.
    """
    sys.stdout.write(_completer(shell, ROOTS, _group()).source() + "\n")
    return ExitCode.DONE


def answered(program: str, group: click.Command) -> bool:
    """Answer the question of a completion script, if it was one that started the program."""
    shell, _, instruction = os.environ.get(COMPLETIONS[program], "").partition("_")
    if shell not in SHELLS or instruction not in ("source", "complete"):
        return False
    completer = _completer(shell, program, group)
    sys.stdout.write((completer.source() if instruction == "source" else completer.complete()) + "\n")
    return True


def _group() -> click.Command:
    """The program whose command is running."""
    return click.get_current_context().find_root().command


def _completer(shell: str, program: str, group: click.Command) -> click.shell_completion.ShellComplete:
    from click.shell_completion import BashComplete, FishComplete, ZshComplete

    known = dict(zip(SHELLS, (BashComplete, ZshComplete, FishComplete), strict=True))
    return known[shell](group, {}, program, COMPLETIONS[program])


def configurations(context: click.Context, _: click.Parameter, incomplete: str) -> list[CompletionItem]:
    """The names of the configurations in the model file that the command line names, as far as it can be read."""
    from click.shell_completion import CompletionItem

    from pkm_exact.geometry.reader import read_robot

    # While an option waits for its value, click has not yet told the arguments apart.
    model = context.params.get("model") or next(iter(context.args), "")
    try:
        names = [configuration.name for configuration in read_robot(model).configurations]
    except InputError:  # nothing to offer; the command itself says why
        return []
    return [CompletionItem(name) for name in names if name.startswith(incomplete)]
