"""The command ``selftest``. Everything heavy is imported inside it."""

from __future__ import annotations

from typing import Final

import click

from pkm_exact.cli.program import PROGRAM, ExitCode
from pkm_exact.wording import counted, printable

_COLUMN: Final = 24


@click.command()
def selftest() -> int:
    """Check that this installation works: solve two small robots and a polynomial system, certify them, and
    refuse forged certificates.

    Takes a few seconds and needs no files. Prints the versions, one line per check, and which optional packages are
    there.

    Exit codes: 0 all checks passed; 4 one failed.

    \b
    Example:
      certify-poses selftest
    """
    from pkm_exact.support.installation import extras, version_lines
    from pkm_exact.support.self_test_cases import run_checks

    for line in version_lines():
        click.echo(line)
    click.echo()
    failed = 0
    for check in run_checks():
        failed += not check.passed
        click.echo(f"{check.name:<{_COLUMN}}{'ok' if check.passed else 'FAILED'}: {printable(check.detail)}")
    click.echo()
    for name, version in (*extras().items(), ("msolve", _msolve())):
        click.echo(f"{'optional: ' + name:<{_COLUMN - 1}} {version or 'not installed'}")
    if failed:
        click.echo(
            f"{PROGRAM}: error: {counted(failed, 'check')} failed; reinstall the package, or report these lines",
            err=True,
        )
        return ExitCode.NO_ANSWER
    click.echo("everything works")
    return ExitCode.DONE


def _msolve() -> str | None:
    """Where the program is; only tests and benchmarks use it."""
    try:
        from pkm_exact.backends.msolve_program import find_msolve
    except ImportError:  # a broken installation, of which the checks say more
        return None
    return "found" if find_msolve() is not None else None
