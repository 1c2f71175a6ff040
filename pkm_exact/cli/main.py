"""Entry points of ``certify-poses`` and ``certify-roots``: exit codes, and errors as one sentence on stderr.

Exit codes: 0 done, and the claim is "complete" or "inconsistent" (or every certificate was accepted); 1 a certificate
was rejected; 2 input or usage that cannot be used; 3 done, but the claim is weaker than complete; 4 no answer, the
engine gave up or contradicted itself, or the program failed; 130 interrupted; 141 the reader of the output went away.
A contradiction or failure leaves a report to send (``failures.failure_report``).
"""

from __future__ import annotations

import os
import sys
from collections.abc import Sequence
from functools import partial
from pathlib import Path

import click

from pkm_exact.cli.program import COMPLETIONS, PROBLEM, PROGRAM, ROOTS, ExitCode
from pkm_exact.errors import InputError, InternalError, PkmExactError
from pkm_exact.wording import printable

__all__ = ["COMPLETIONS", "PROBLEM", "PROGRAM", "ROOTS", "ExitCode", "main", "prefer_one_thread", "roots_main"]

THREADS = ("OPENBLAS_NUM_THREADS", "OMP_NUM_THREADS", "MKL_NUM_THREADS")
"""Variables that libraries of linear algebra obey when they are loaded."""


def prefer_one_thread() -> None:
    """Have linear algebra that is loaded later, here or in processes to be started, done in one thread.

    Matrices here are small: several threads gain nothing, and on cores with other work to do they wait for each other
    many times as long as the work takes. What the user has set stays as it is.
    """
    for name in THREADS:
        os.environ.setdefault(name, "1")


def roots_main(arguments: Sequence[str] | None = None) -> int:
    """Run ``certify-roots`` and return its exit code; as ``main``."""
    return main(arguments, ROOTS)


def main(arguments: Sequence[str] | None = None, program: str = PROGRAM) -> int:
    """Run ``certify-poses`` and return its exit code.

    Parameters
    ----------
    arguments : sequence of str, optional
        The words after the command's name; those of the process by default.
    program : str
        ``certify-roots`` instead.

    Examples
    --------
    >>> main(["completion", "tcsh"])
    <ExitCode.BAD_INPUT: 2>
    """
    for stream in ("stdout", "stderr"):
        if getattr(sys, stream) is None:  # closed by the caller: the exit code and the files still count
            setattr(sys, stream, Path(os.devnull).open("w", encoding="utf-8"))  # noqa: SIM115 - from now on
    _accept_any_character()
    prefer_one_thread()
    words = list(sys.argv[1:] if arguments is None else arguments)
    try:
        code = _run(words, program)
        sys.stdout.flush()
    except BrokenPipeError:
        _discard_output()
        return ExitCode.BROKEN_PIPE
    except (KeyboardInterrupt, click.Abort):
        return ExitCode.INTERRUPTED
    except OSError as error:
        _discard_output()
        sentence = f"the output cannot be written ({error.strerror}); free the disk or write elsewhere"
        return _complain(sentence, program=program)
    except Exception as error:
        return _failed(error, words, program)
    return code


def _commands(program: str) -> click.Group:
    """The commands of a program."""
    if program == ROOTS:
        from pkm_exact.cli.roots_commands import certify_roots

        return certify_roots
    from pkm_exact.cli.commands import certify_poses

    return certify_poses


def _run(words: list[str], program: str) -> int:
    group = _commands(program)
    complain = partial(_complain, program=program)
    if COMPLETIONS[program] in os.environ and _answered(program, group):
        return ExitCode.DONE
    try:
        # click's own main() would turn a broken pipe into exit code 1, which here means a rejected certificate.
        with group.make_context(program, list(words)) as context:
            return _invoked(group, context)
    except click.exceptions.Exit as end:
        return end.exit_code
    except click.UsageError as error:
        if isinstance(error, click.exceptions.NoArgsIsHelpError):
            click.echo(error.format_message(), err=True)
            return ExitCode.BAD_INPUT
        from pkm_exact.cli.usage import usage_sentence

        where = error.ctx.command_path if error.ctx else program
        return complain(f"{_sentence(usage_sentence(error))}; see {where} --help")
    except click.ClickException as error:
        return complain(_sentence(error.format_message()))
    except InputError as error:
        return complain(str(error))
    except InternalError:
        raise
    except PkmExactError as error:
        return complain(f"no answer: {error}", ExitCode.NO_ANSWER)
    except MemoryError:
        return complain("no answer: the memory is exhausted", ExitCode.NO_ANSWER)


def _answered(program: str, group: click.Group) -> bool:
    from pkm_exact.cli.shell_completion import answered

    return answered(program, group)


def _invoked(command: click.Command, context: click.Context) -> int:
    """The exit code of the command; what goes wrong in it takes along which robot it was about."""
    try:
        return int(command.invoke(context) or ExitCode.DONE)
    except Exception as error:
        if PROBLEM in context.meta:
            from pkm_exact.failures.contradiction import attach

            attach(error, context.meta[PROBLEM])
        raise


def _failed(error: Exception, words: list[str], program: str) -> ExitCode:
    from pkm_exact.failures.failure_report import reported

    return _complain(f"no answer: {reported(error, words)}", ExitCode.NO_ANSWER, program=program)


def _complain(sentence: str, code: ExitCode = ExitCode.BAD_INPUT, *, program: str) -> ExitCode:
    click.echo(f"{program}: error: {printable(sentence)}", err=True)
    return code


def _sentence(message: str) -> str:
    text = " ".join(message.split()).rstrip(".")
    return text[:1].lower() + text[1:]


def _accept_any_character() -> None:
    """Names in a model file may have characters that the terminal's encoding lacks: print them as escapes."""
    reconfigure = getattr(sys.stdout, "reconfigure", None)
    if reconfigure is not None:
        reconfigure(errors="backslashreplace")


def _discard_output() -> None:
    """Let the interpreter's last flush go nowhere instead of raising once more."""
    try:
        descriptor = sys.stdout.fileno()
    except (OSError, ValueError):
        return
    os.dup2(os.open(os.devnull, os.O_WRONLY), descriptor)


if __name__ == "__main__":
    sys.exit(main())
