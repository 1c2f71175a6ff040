"""The command ``region``: questions about whole regions of poses. Everything heavy is imported inside it."""

from __future__ import annotations

import sys
from fractions import Fraction
from pathlib import Path
from typing import TYPE_CHECKING, Any

import click

from pkm_exact.cli import arguments
from pkm_exact.cli.program import PROGRAM, ExitCode
from pkm_exact.errors import InputError
from pkm_exact.stages import Amount

if TYPE_CHECKING:
    from pkm_exact.interactive.progress import Progress
    from pkm_exact.regions.largest_region import LargestAnswer
    from pkm_exact.regions.region_legs import RegionMachine
    from pkm_exact.regions.region_question import RegionQuestion
    from pkm_exact.regions.region_solver import RegionAnswer

MANY_PARTS = 1000
"""Letters of a paving; no certificate with fewer was ever too large."""


@click.command()
@click.argument("model", type=arguments.FilePath())
@click.argument("question", type=arguments.FilePath(), metavar="QUESTION.toml")
@arguments.certificate_option
@arguments.layout_option("What to print: a few lines, or exact bounds as json.")
@click.option(
    "--workers", type=click.IntRange(1, 256), default=1, show_default=True, help="Processes; the answer is the same."
)
@click.option("--scheduler", metavar="ADDRESS", help="Use the Dask cluster with this scheduler, as tcp://host:8786.")
@click.option(
    "--picture", type=arguments.FilePath(), metavar="FILE", help="Draw the paving: a .png, .svg or .pdf file."
)
@click.option("-v", "--verbose", is_flag=True, help="Say more: the share of the work that is done.")
def region(
    model: str,
    question: str,
    output: str | None,
    layout: str,
    workers: int,
    scheduler: str | None,
    picture: str | None,
    verbose: bool,
) -> int:
    """Answer a question about all poses of a region of the robot in the file MODEL.

    QUESTION.toml says which region ([region]: a box, ball, cylinder, prism, arc or tube of positions, with a fixed
    orientation or intervals of angles), what is asked of its poses ([conditions]: reachable, limits, no_type_1,
    no_type_2), and which answer is wanted ([answer]: all of it proved or a counterexample; a map; the largest cube or
    ball; the locus of singular poses; extremes of joint values or indices; between which values of a number of the
    model it changes; for which designs it is yes).

    With -o an interrupted run leaves CERT.json.partial; the same command goes on from there, to the same bytes.

    \b
    Example:
      certify-poses region models/rolland-6-6.toml cube.toml -o cube.json

    Exit codes: 0 answered, be it yes, no, or a map; 3 undecided for the work allowed. Others as for certify-poses.
    """
    from pkm_exact.cli.model_reading import announced_model
    from pkm_exact.regions.question_reader import read_question
    from pkm_exact.regions.region_legs import region_machine

    if scheduler is not None and workers > 1:
        raise click.UsageError("--workers and --scheduler exclude each other: a cluster has its own workers.")
    robot = announced_model(model)
    try:
        machine = region_machine(robot)
    except InputError as error:
        raise InputError(f"{model}: {error}") from None
    asked = read_question(question, machine)
    _require_outputs(model, question, asked, output, picture)
    if output is not None:
        from pkm_exact.certify.region_build import require_words

        require_words(machine, asked)
    if asked.answer.kind == "locus":
        return _locus(machine, asked, question, layout)
    if asked.answer.kind == "extremes":
        return _extremes(machine, asked, question, layout, verbose=verbose)
    if asked.answer.kind == "designs":
        return _designs(machine, asked, question, output, layout, verbose=verbose)
    if asked.answer.kind == "threshold":
        return _threshold(model, asked, question, output, layout, verbose=verbose)
    from pkm_exact.interactive.progress import Progress

    try:
        with Progress(verbose=verbose) as progress:
            answer = _answer(machine, asked, scheduler or workers, output, progress)
    except InputError as error:
        raise InputError(f"{question}: {error}") from None
    from pkm_exact.cli import region_report

    if picture is not None:
        region_report.draw(answer, Path(picture))
    text = region_report.as_json(answer) if layout == "json" else region_report.as_text(answer)
    sys.stdout.write(text)
    return ExitCode.WEAKER_CLAIM if region_report.is_undecided(answer) else ExitCode.DONE


def _require_outputs(model: str, question: str, asked: RegionQuestion, output: str | None, picture: str | None) -> None:
    """Refuse files that the answer does not have, and those that must not be written."""
    kind = asked.answer.kind
    if kind in ("locus", "extremes") and (output or picture):
        raise InputError(f"{question}: answer.kind: {kind} has neither certificate nor picture; leave -o out")
    if kind in ("threshold", "designs") and picture is not None:
        raise InputError(f"{question}: answer.kind: {kind} has no picture; leave --picture out")
    if picture is not None:
        from pkm_exact.pictures.output import picture_format
        from pkm_exact.pictures.region_figure import require_drawable

        picture_format(Path(picture))
        require_drawable(asked.chart)
    for path, option in ((output, "-o"), (picture, "--picture")):
        if path is not None:
            arguments.require_other_file(Path(path), model, option)
            arguments.require_other_file(Path(path), question, option, "the question")
            arguments.require_writable(Path(path), option)


def _locus(machine: RegionMachine, asked: RegionQuestion, question: str, layout: str) -> int:
    from pkm_exact.cli import region_report
    from pkm_exact.regions.singularity_locus import locus

    try:
        found = locus(machine, asked)
    except InputError as error:
        raise InputError(f"{question}: {error}") from None
    said = region_report.locus_json if layout == "json" else region_report.locus_text
    sys.stdout.write(said(machine, found))
    return ExitCode.DONE


def _threshold(
    model: str, asked: RegionQuestion, question: str, output: str | None, layout: str, *, verbose: bool
) -> int:
    from pkm_exact.cli import extremes_report
    from pkm_exact.geometry.reader import robot_with
    from pkm_exact.interactive.progress import Progress
    from pkm_exact.regions.question_reader import read_question
    from pkm_exact.regions.region_legs import region_machine
    from pkm_exact.regions.region_solver import answered
    from pkm_exact.regions.region_threshold import threshold

    text, wanted = Path(model).read_text(encoding="utf-8"), asked.answer

    def ask(value: Fraction) -> RegionAnswer:
        machine = region_machine(robot_with(text, wanted.parameter, value))
        return answered(machine, read_question(question, machine))

    try:
        with Progress(verbose=verbose) as progress:
            found = threshold(
                ask,
                wanted.between,
                wanted.precision,
                progress=lambda value, _: progress(f"{wanted.parameter} = {float(value):.6g}"),
            )
    except InputError as error:
        raise InputError(f"{question}: {error}") from None
    if output is not None:
        _write(found.proved, output)
    said = extremes_report.threshold_json if layout == "json" else extremes_report.threshold_text
    sys.stdout.write(said(asked, found))
    return ExitCode.DONE if found.is_precise else ExitCode.WEAKER_CLAIM


def _designs(
    machine: RegionMachine, asked: RegionQuestion, question: str, output: str | None, layout: str, *, verbose: bool
) -> int:
    from pkm_exact.cli import designs_report
    from pkm_exact.interactive.progress import Progress
    from pkm_exact.regions.region_designs import OPEN, designs

    try:
        with Progress(verbose=verbose) as progress:
            found = designs(machine, asked, progress=lambda count: progress(f"{count} boxes of designs"))
    except InputError as error:
        raise InputError(f"{question}: {error}") from None
    if output is not None:
        from pkm_exact.certify.region_build import designs_certificate

        _write_certificate(designs_certificate(machine, asked, found), output)
    said = designs_report.as_json if layout == "json" else designs_report.as_text
    sys.stdout.write(said(machine, asked, found))
    return ExitCode.WEAKER_CLAIM if found.share(OPEN) == 1 else ExitCode.DONE


def _extremes(machine: RegionMachine, asked: RegionQuestion, question: str, layout: str, *, verbose: bool) -> int:
    from pkm_exact.cli import extremes_report
    from pkm_exact.interactive.progress import Progress
    from pkm_exact.regions.index_extremes import index_range
    from pkm_exact.regions.joint_ranges import joint_ranges

    is_index = asked.answer.of != "joint_values"
    try:
        with Progress(verbose=verbose) as progress:
            if is_index:
                found = index_range(machine, asked)
            else:
                ranges = joint_ranges(machine, asked, progress=progress)
    except InputError as error:
        raise InputError(f"{question}: {error}") from None
    if is_index:
        said_index = extremes_report.index_json if layout == "json" else extremes_report.index_text
        sys.stdout.write(said_index(machine, asked, found))
        return ExitCode.DONE if found.is_precise else ExitCode.WEAKER_CLAIM
    said = extremes_report.ranges_json if layout == "json" else extremes_report.ranges_text
    sys.stdout.write(said(machine, asked, ranges))
    return ExitCode.DONE if all(leg.is_precise for leg in ranges) else ExitCode.WEAKER_CLAIM


def _answer(
    machine: RegionMachine, asked: RegionQuestion, by: int | str, output: str | None, progress: Progress
) -> RegionAnswer | LargestAnswer:
    from pkm_exact.regions.largest_region import largest
    from pkm_exact.regions.question_reader import of_size
    from pkm_exact.regions.region_solver import answered
    from pkm_exact.regions.region_workers import workers

    def shown(size: Fraction, proved: bool) -> None:
        progress(f"size {float(size):.6g}: {'proved' if proved else 'not proved'}")

    if isinstance(by, str):
        from pkm_exact.sweep.region_cluster import cluster_run

        chosen = cluster_run(machine, by)
    else:
        chosen = workers(machine, by)
    with chosen as run:
        if asked.answer.kind == "largest":
            answer = largest(machine, asked, lambda size: of_size(asked, machine, size), run=run, progress=shown)
            if output is not None and answer.proved is not None:
                _write(answer.proved, output)
            return answer
        progress("paving the region")
        if output is None:
            return answered(machine, asked, run=run, progress=_shares(progress))
        return _stored(machine, asked, run, output, progress)


def _shares(progress: Progress) -> Any:
    def shown(share: Fraction) -> None:
        progress.amount(Amount(share.numerator, share.denominator, "of the parts"))

    return shown


def _stored(machine: RegionMachine, asked: RegionQuestion, run: Any, output: str, progress: Progress) -> RegionAnswer:
    import pkm_exact
    from pkm_exact.cli.track_store import TrackStore
    from pkm_exact.regions.region_solver import answered

    job = repr((pkm_exact.__version__, machine, asked))
    with TrackStore(Path(output), job) as store:
        try:
            answer = answered(machine, asked, run=run, store=store, progress=_shares(progress))
        except InputError:
            store.remove()
            raise
        except KeyboardInterrupt:
            click.echo(f"{PROGRAM}: interrupted; the same command goes on", err=True)
            raise
        _write(answer, output)
        store.remove()
    return answer


def _write(answer: RegionAnswer, output: str) -> None:
    from pkm_exact.certify.region_build import region_certificate

    _write_certificate(region_certificate(answer), output)


def _write_certificate(content: dict[str, Any], output: str) -> None:
    """Write it; and if it has many parts, ask whether checkers can afford them."""
    from pkm_exact.certify.build import canonical_bytes
    from pkm_exact.certify.check import Status, check_bytes
    from pkm_exact.wording import TOO_LARGE

    data = canonical_bytes(content)
    arguments.write_output(output, data)
    if len(content["paving"]) >= MANY_PARTS and check_bytes(data).status is Status.TOO_LARGE:
        click.echo(f"{output}: {TOO_LARGE}", err=True)
