"""The command ``sweep``: many length vectors of one robot. Everything heavy is imported inside it."""

from __future__ import annotations

import os
import time
from contextlib import AbstractContextManager
from fractions import Fraction
from pathlib import Path
from typing import TYPE_CHECKING, Final

import click

from pkm_exact.cli import arguments
from pkm_exact.cli.program import PROGRAM, ExitCode
from pkm_exact.errors import InputError
from pkm_exact.wording import counted

if TYPE_CHECKING:
    from collections.abc import Callable

    from pkm_exact.interactive.progress import Progress
    from pkm_exact.sweep.asked_indices import AskedIndices
    from pkm_exact.sweep.job import SweepJob
    from pkm_exact.sweep.lengths import LengthsFile
    from pkm_exact.sweep.run import Tally, Workers

METHODS: Final = ("krawczyk", "exact")
MOST_WORKERS: Final = 1024
_SECONDS_PER_LINE: Final = 0.2


@click.command()
@click.argument("model", type=arguments.FilePath())
@click.argument("lengths", type=arguments.FilePath(), metavar="LENGTHS.csv")
@click.option(
    "-o",
    "--output",
    type=arguments.FilePath(),
    required=True,
    metavar="OUT",
    help="Write OUT.jsonl, one line per row, or OUT.csv, a table with one line per pose.",
)
@click.option(
    "--method",
    type=click.Choice(METHODS),
    default=METHODS[0],
    show_default=True,
    help="krawczyk: continuation from neighbouring lengths, then proof. exact: elimination.",
)
@arguments.width_option
@click.option("--squared", is_flag=True, help="The rows have squared lengths.")
@click.option(
    "--joints",
    is_flag=True,
    help="The rows have joint values, as `solve --joints` takes them: for cranks half tangents, or angles as 30deg.",
)
@click.option(
    "--certificates",
    type=arguments.FilePath(),
    metavar="DIR",
    help="Write the certificate of row n to DIR/n.json as well.",
)
@click.option(
    "--index",
    "indices",
    multiple=True,
    metavar="NAME",
    help="At each pose this index of statics as well, as condition or v_iso_p; can be repeated.",
)
@click.option(
    "--limits",
    "limits",
    multiple=True,
    metavar="KEY=VALUES",
    help="What indices need, as for statics: length=0.1, speeds=1/2, ..",
)
@click.option(
    "--workers",
    type=click.IntRange(1, MOST_WORKERS),
    metavar="N",
    help="Processes on this machine.  [default: as many as there are cores]",
)
@click.option("--scheduler", metavar="ADDRESS", help="Use the Dask cluster with this scheduler, as tcp://host:8786.")
@click.option("-v", "--verbose", is_flag=True, help="Keep every line of progress on a terminal.")
def sweep(
    model: str,
    lengths: str,
    output: str,
    method: str,
    width: Fraction,
    squared: bool,
    joints: bool,
    certificates: str | None,
    indices: tuple[str, ...],
    limits: tuple[str, ...],
    workers: int | None,
    scheduler: str | None,
    verbose: bool,
) -> int:
    """Find all real poses of the robot in the file MODEL at every length vector in LENGTHS.csv.

    LENGTHS.csv has one row of exact leg lengths per problem; a first line with the names l1,l2,.. may be left out. For
    each row, in the same order, OUT.jsonl gets one line: the claim, the poses in decimals that are right to one unit of
    the last digit, and the SHA-256 digest of the certificate that `solve --lengths` would write. A row that cannot be
    solved gets a line that says why, and does not stop the others. OUT.csv is a table for spreadsheets instead: one
    line per pose, with roll, pitch and yaw in degrees as well.

    An interrupted run leaves OUT.partial and OUT.journal beside OUT; the same command goes on from there, and the
    output is the same to the last byte, whatever the number of workers.

    Exit codes: 0 all rows complete; 3 some rows have a weaker claim or no answer. Others as for certify-poses.

    \b
    Examples:
      certify-poses sweep models/rolland-6-6.toml lengths.csv -o poses.jsonl
      certify-poses sweep models/rolland-6-6.toml lengths.csv -o poses.jsonl --certificates certificates
      certify-poses sweep models/rolland-6-6.toml lengths.csv -o poses.jsonl --index condition --limits length=100
      certify-poses sweep models/3-rrr.toml angles.csv -o poses.csv --joints
      certify-poses sweep models/rolland-6-6.toml lengths.csv -o poses.jsonl --scheduler tcp://10.0.0.1:8786
    """
    if workers is not None and scheduler is not None:
        raise click.UsageError("--workers and --scheduler exclude each other: a cluster has its own workers.")
    if joints and squared:
        raise click.UsageError("--joints and --squared exclude each other: joint values are not squared.")
    if limits and not indices:
        raise click.UsageError("--limits: belongs to --index, give that as well.")
    target = Path(output)
    folder = None if certificates is None else Path(certificates)
    from pkm_exact.cli.model_reading import announced_model
    from pkm_exact.sweep.lengths import read_lengths

    robot = announced_model(model)
    rows = read_lengths(lengths, robot, joints=joints)
    asked = _asked(indices, limits, len(rows.names))
    arguments.require_other_file(target, model, "-o")
    arguments.require_other_file(target, lengths, "-o", "the file of the lengths")
    arguments.require_writable(target, "-o")
    if folder is not None:
        _require_folder(folder)

    from pkm_exact.policy import Policy
    from pkm_exact.sweep.job import sweep_job
    from pkm_exact.sweep.pose_table import is_table

    job = sweep_job(
        robot,
        rows,
        method=method,
        width=width,
        policy=Policy(),
        squared=squared,
        certificates=folder is not None,
        indices=asked,
        joints=joints,
        table=is_table(target),
    )

    def started(job: SweepJob) -> AbstractContextManager[Workers]:
        return _workers(job, min(workers or _cores(), rows.count), scheduler)

    tally = _swept(job, rows, target, started, folder, verbose=verbose)
    click.echo(_summary(tally), err=True)
    return ExitCode.DONE if tally.is_complete else ExitCode.WEAKER_CLAIM


def _asked(indices: tuple[str, ...], limits: tuple[str, ...], actuators: int) -> AskedIndices | None:
    """The indices that are asked for."""
    if not indices:
        return None
    from pkm_exact.cli.statics_answers import given_limits
    from pkm_exact.sweep.asked_indices import AskedIndices

    try:
        return AskedIndices.of(indices, given_limits(limits), actuators)
    except InputError as error:
        raise InputError(f"--{error}") from None


def _swept(
    job: SweepJob,
    rows: LengthsFile,
    output: Path,
    workers: Callable[[SweepJob], AbstractContextManager[Workers]],
    certificates: Path | None,
    *,
    verbose: bool,
) -> Tally:
    """Run the sweep, show its progress, and say how to go on where it ends early."""
    from pkm_exact.interactive.progress import Progress
    from pkm_exact.sweep.run import sweep as run

    with Progress(verbose=verbose) as progress:
        shown = _Shown(progress, rows.count)
        try:
            return run(job, rows, output, workers, certificates=certificates, progress=shown)
        except KeyboardInterrupt:
            progress.clear()
            done = f"{shown.rows} of {rows.count} rows"
            click.echo(f"{PROGRAM}: interrupted after {done}; the same command goes on from there", err=True)
            raise
        except OSError as error:
            raise InputError(
                f"{output}: cannot be written ({error.strerror}); make room, and the same command goes on"
            ) from None


def _workers(job: SweepJob, count: int, scheduler: str | None) -> AbstractContextManager[Workers]:
    if scheduler is not None:
        from pkm_exact.sweep.cluster import cluster_workers

        return cluster_workers(job, scheduler)
    from pkm_exact.sweep.local import local_workers

    return local_workers(job, count)


def _cores() -> int:
    """Number of cores that this process may use."""
    affinity = getattr(os, "sched_getaffinity", None)
    return min(MOST_WORKERS, len(affinity(0)) if affinity else os.cpu_count() or 1)


def _require_folder(folder: Path) -> None:
    if folder.exists() and not folder.is_dir():
        raise InputError(f"{folder}: is not a folder; give --certificates the path of one")
    if not folder.exists():
        arguments.require_writable(folder, "--certificates")


def _summary(tally: Tally) -> str:
    """One sentence about all rows."""
    parts = [f"{count} {claim.replace('-', ' ')}" for claim, count in sorted(tally.claims.items())]
    if tally.errors:
        parts.append(f"{tally.errors} without an answer, the first: {tally.first_error}")
    return f"{counted(tally.rows, 'row')}, {tally.poses} real poses; {', '.join(parts)}"


class _Shown:
    """Shows how many rows are done, how fast, and how long the others will take."""

    def __init__(self, progress: Progress, count: int) -> None:
        self._progress, self._count, self.rows = progress, count, 0
        self._begin = self._last = time.monotonic()

    def __call__(self, rows: int, before: int) -> None:
        self.rows = rows
        now = time.monotonic()
        if rows == before or now - self._last < _SECONDS_PER_LINE:
            return
        self._last = now
        rate = (rows - before) / (now - self._begin)
        left = (self._count - rows) / rate
        minutes, seconds = divmod(round(left), 60)
        hours, minutes = divmod(minutes, 60)
        done = f"{rows} of {self._count} rows ({100 * rows / self._count:.1f} %)"
        self._progress(f"{done}, {rate:.3g} rows/s, {hours}:{minutes:02}:{seconds:02} left")
