"""The command ``check``. Everything heavy is imported inside it."""

from __future__ import annotations

import os
import sys
from collections.abc import Callable, Iterator, Sequence
from pathlib import Path

import click

from pkm_exact.cli import arguments
from pkm_exact.cli.program import ExitCode, worst
from pkm_exact.errors import InputError
from pkm_exact.stages import Amount
from pkm_exact.wording import printable


@click.command()
@click.argument("paths", nargs=-1, required=True, type=arguments.FilePath(), metavar="PATH...")
@click.option("--pure", is_flag=True, help="Use the second checker: plain Python, no libraries, slower, same verdicts.")
@click.option(
    "--recompute", is_flag=True, help="Also solve each robot again, as the certificate says, and compare bytes."
)
@click.option(
    "--models",
    type=arguments.FilePath(),
    metavar="DIR",
    help="For --recompute: solve the model files in DIR, not the robots in the certificates. NAME.json and NAME.*.json "
    "belong to NAME.toml.",
)
@click.option(
    "--update", is_flag=True, help="For --recompute: write what is computed now over certificates that differ."
)
def check(paths: tuple[str, ...], pure: bool, recompute: bool, models: str | None, update: bool) -> int:
    """Replay certificates with a program that shares nothing with the solver.

    PATH is a certificate, or a folder: all *.json in it. Prints one line per claim; with --recompute one per file,
    which says where a certificate differs first, and a total. Exit code: 0 all accepted (and the same); 1 at least
    one was rejected (or differs); otherwise 4, at least one could not be recomputed; otherwise 2, at least one could
    not be read or is not a certificate.

    \b
    Examples:
      certify-poses check certs
      certify-poses check --pure certs/mourrain-l.json
      certify-poses check --recompute --models models certs/mourrain-l.json certs/3-rrr.json
    """
    context = click.get_current_context()
    if pure and recompute:
        raise click.UsageError("--pure and --recompute exclude each other.", context)
    for option, given in (("--models", models is not None), ("--update", update)):
        if given and not recompute:
            raise click.UsageError(f"{option}: belongs to --recompute; add it.", context)
    if models is not None and not Path(models).is_dir():
        raise InputError(f"{models}: is not a folder; give --models the folder with the model files")
    files = list(files_in(paths))
    if recompute:
        from pkm_exact.cli.recompute_report import recompute_all

        return recompute_all(files, None if models is None else Path(models), update=update)
    return check_all(files, pure=pure)


def check_all(files: Sequence[Path], *, pure: bool) -> ExitCode:
    """Replay certificates, and print the lines of each."""
    from pkm_exact.interactive.progress import Progress

    codes = []
    with Progress(verbose=False) as progress:
        for done, path in enumerate(files):
            progress(f"checking {path.name}")
            progress.amount(Amount(done, len(files), "files"))
            codes.append(_check(path, pure=pure, before_output=progress.clear))
    return worst(codes)


def files_in(paths: Sequence[str]) -> Iterator[Path]:
    """The files themselves, and those in folders, sorted."""
    for path in map(Path, paths):
        if not os.path.isdir(path):  # noqa: PTH112 - says no where Path.is_dir raises, as for a name that is too long
            yield path
            continue
        inside = sorted(entry for entry in path.glob("*.json") if not entry.name.startswith("."))
        if not inside:
            raise InputError(f"{path}: has no *.json in it; give the path of a certificate or of a folder with some")
        yield from inside


def _check(path: Path, *, pure: bool, before_output: Callable[[], None]) -> ExitCode:
    from pkm_exact.certify.certificate import content_of

    name = printable(str(path))
    try:
        data = content_of(path)
    except InputError as error:
        before_output()
        program = click.get_current_context().find_root().info_name
        click.echo(f"{program}: error: {printable(str(error))}", err=True)
        return ExitCode.BAD_INPUT
    status, lines = _verdict(data, pure=pure)
    before_output()
    for line in lines:
        sys.stdout.write(f"{name}: {printable(line)}\n")
    if status == "malformed" and not data.lstrip().startswith(b"{"):
        sys.stdout.write(f"{name}: give a certificate, as it is written with -o CERT.json\n")
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
