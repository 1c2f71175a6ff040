"""The command ``check``. Everything heavy is imported inside it."""

from __future__ import annotations

import sys
from pathlib import Path
from typing import Final

import click

from pkm_exact.cli.main import ExitCode
from pkm_exact.wording import printable

MAX_CERTIFICATE_BYTES: Final = 64 << 20


@click.command(short_help="Replay certificates.")
@click.argument("certificates", nargs=-1, required=True, type=click.Path(), metavar="CERT.json...")
@click.option("--pure", is_flag=True, help="Use the second checker: one file of plain Python, slower, same verdicts.")
def check(certificates: tuple[str, ...], pure: bool) -> int:
    """Replay certificates with a program that shares nothing with the solver.

    Prints one line per claim. Exit code: 0 all accepted; 1 at least one was rejected; otherwise 2, at least one could
    not be read or is not a certificate. The second checker knows pose certificates only, not those of tolerances.

    \b
    Examples:
      certify-poses check certs/*.json
      certify-poses check --pure rolland.json
    """
    codes = [_check(Path(name), pure=pure) for name in certificates]
    if ExitCode.REJECTED in codes:
        return ExitCode.REJECTED
    return max(codes)


def _check(path: Path, *, pure: bool) -> ExitCode:
    name = printable(str(path))
    try:
        with path.open("rb") as stream:
            data = stream.read(MAX_CERTIFICATE_BYTES + 1)
    except (OSError, ValueError) as error:
        reason = error.strerror if isinstance(error, OSError) else str(error)
        click.echo(f"certify-poses: error: {name}: cannot be read ({reason}); give the path of a certificate", err=True)
        return ExitCode.BAD_INPUT
    status, lines = _verdict(data, pure=pure)
    for line in lines:
        sys.stdout.write(f"{name}: {printable(line)}\n")
    sys.stdout.write(f"{name}: {status}\n")
    sys.stdout.flush()
    if status == "accepted":
        return ExitCode.DONE
    return ExitCode.REJECTED if status == "rejected" else ExitCode.BAD_INPUT


def _verdict(data: bytes, *, pure: bool) -> tuple[str, tuple[str, ...]]:
    """Status and lines by one of the two checkers, which share nothing."""
    if pure:
        from pkm_exact.certify.pure import check_bytes as check_plainly

        plain = check_plainly(data)
        return str(plain.status), tuple(plain.lines)
    from pkm_exact.certify.check import check_bytes

    verdict = check_bytes(data)
    return str(verdict.status), verdict.lines
