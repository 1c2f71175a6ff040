"""The command ``calibrate``: joints and length offsets from measured poses. Everything heavy is imported inside it."""

from __future__ import annotations

import sys
from dataclasses import replace
from math import sqrt
from pathlib import Path
from typing import TYPE_CHECKING, Final

import click

from pkm_exact.cli import arguments
from pkm_exact.cli.program import PROGRAM, ExitCode
from pkm_exact.errors import InputError
from pkm_exact.wording import counted, printable

if TYPE_CHECKING:
    from pkm_exact.geometry.robot import Robot
    from pkm_exact.identification.calibration_fit import LegFit
    from pkm_exact.identification.observation import Identification

MOST_DIGITS: Final = 15


@click.command()
@click.argument("model", type=arguments.FilePath())
@click.argument("measured", type=arguments.FilePath(), metavar="POSES.csv")
@click.option(
    "-o", "--output", type=arguments.FilePath(), metavar="MODEL.toml", help="Write the calibrated model to this file."
)
@click.option(
    "--covariance",
    type=arguments.FilePath(),
    metavar="COV.toml",
    help="Write values, standard deviations, covariance and residuals to this file.  [default: beside -o, with "
    ".covariance.toml in its name]",
)
@click.option(
    "--offsets/--no-offsets", default=True, show_default=True, help="Whether the lengths read have unknown offsets."
)
@click.option(
    "--digits",
    type=click.IntRange(0, MOST_DIGITS),
    default=6,
    show_default=True,
    help="Decimals to which joints and lengths of the calibrated model are rounded.",
)
@click.option(
    "--picture", type=arguments.FilePath(), metavar="FILE", help="Draw the residuals of each leg: png, svg or pdf."
)
@click.option("--force", is_flag=True, help="Overwrite files that exist, and write a calibration that is not credible.")
def calibrate(
    model: str,
    measured: str,
    output: str | None,
    covariance: str | None,
    offsets: bool,
    digits: int,
    picture: str | None,
    force: bool,
) -> int:
    """Fit joints and length offsets of the robot in the file MODEL to poses that were measured.

    POSES.csv has a row for each pose: x,y,z,roll,pitch,yaw (degrees) or x,y,z,q0,q1,q2,q3, and the lengths l1,..,l6
    that were read there; x,y,theta,l1,l2,l3 if planar. Which parameters these numbers tell apart is decided by exact
    ranks. The fit itself is least squares in floating point, with scipy; nothing of it is certified. What the
    measurements do not show stays as it is in the model. A fit that is not credible (changes or standard deviations
    greater than the robot, lengths in another unit, exchanged columns) is said to be none: exit code 3, and the
    model is not written without --force. Only legs whose own lengths are read are taken (N-RPR and N-UPS, without a
    metric): no cranks, no slides, no machines of a recipe, nothing declared by constraints or bodies.

    \b
    Examples:
      certify-poses calibrate models/3-rpr-merlet-p.toml poses.csv --no-offsets
      certify-poses calibrate models/3-rpr-merlet-p.toml poses.csv --no-offsets -o calibrated.toml
    """
    targets = _targets(output, covariance, picture, (model, measured), force=force)
    from pkm_exact.cli.model_reading import announced_robot
    from pkm_exact.identification.calibration_doubts import doubts
    from pkm_exact.identification.calibration_fit import fitted_legs
    from pkm_exact.identification.calibration_text import calibrated_robot, covariance_text
    from pkm_exact.identification.measured_poses import identifiable, read_measured_poses

    robot = announced_robot(model, "calibrate")
    if robot.chains or set(robot.metric) != {1}:
        raise InputError(
            f"{model}: is no robot with actuated legs in ordinary coordinates; only such are calibrated, "
            "N-RPR and N-UPS without a metric: not cranks (RRR, RUS) and not slides (PRR, PUS)"
        )
    rows = read_measured_poses(measured, robot)
    known = identifiable(robot, rows, offsets=offsets)
    try:
        fits = fitted_legs(robot, rows, known, offsets=offsets)
    except InputError as error:
        raise InputError(f"{measured}: {error}") from None
    source = f"{robot.source}; calibrated from {counted(len(rows), 'pose')} of {Path(measured).name}"
    against = doubts(robot, rows, fits)
    if against and not force:
        targets = {key: path for key, path in targets.items() if key == "picture"}
    files: dict[Path, bytes] = {}
    if "model" in targets:
        from pkm_exact.geometry.model_writer import robot_text

        fitted = calibrated_robot(replace(robot, source=source), fits, digits)
        files[targets["model"]] = robot_text(fitted).encode("utf-8")
    if "covariance" in targets:
        files[targets["covariance"]] = covariance_text(robot.unit, fits).encode("utf-8")
    if "picture" in targets:
        files[targets["picture"]] = _picture(robot, fits, targets["picture"])
    for path, data in files.items():
        arguments.write_output(path, data)
    _print(robot, known, fits, len(rows))
    for path in files:
        click.echo(f"written: {printable(str(path))}")
    return _judged(against, withheld=output is not None and not force)


def _judged(against: tuple[str, ...], *, withheld: bool) -> ExitCode:
    """Say what speaks against the fit."""
    if not against:
        return ExitCode.DONE
    for sentence in against:
        click.echo(f"{PROGRAM}: warning: {sentence}", err=True)
    rest = "; the model is not written (--force writes it all the same)" if withheld else ""
    click.echo(f"{PROGRAM}: warning: this calibration is not credible{rest}", err=True)
    return ExitCode.WEAKER_CLAIM


def _targets(
    output: str | None, covariance: str | None, picture: str | None, inputs: tuple[str, ...], *, force: bool
) -> dict[str, Path]:
    """The files to be written, refused if one of them cannot be, or is there."""
    if output is not None and covariance is None:
        covariance = str(Path(output).with_suffix(".covariance.toml"))
    if picture is not None:
        from pkm_exact.pictures.output import picture_format
        from pkm_exact.pictures.style import require_matplotlib

        picture_format(Path(picture))
        require_matplotlib()
    given = {"model": ("-o", output), "covariance": ("--covariance", covariance), "picture": ("--picture", picture)}
    found: dict[str, Path] = {}
    for key, (option, text) in given.items():
        if text is None:
            continue
        path = Path(text)
        for source in inputs:
            arguments.require_other_file(path, source, option, "an input")
        if path in found.values():
            raise InputError(f"{path}: is to be another file too; give {option} another path")
        arguments.require_writable(path, option)
        if path.exists() and not force:
            raise InputError(f"{path}: exists; give {option} another path, or --force to overwrite it")
        found[key] = path
    return found


def _print(robot: Robot, known: tuple[Identification, ...], fits: tuple[LegFit, ...], poses: int) -> None:
    from pkm_exact.cli.table import print_rows

    shown, asked = sum(leg.rank for leg in known), sum(len(leg.parameters) for leg in known)
    sys.stdout.write(
        f"{robot.name} ({robot.kind}): {counted(poses, 'pose')}, {poses * len(fits)} lengths; they determine "
        f"{shown} of {asked} parameters (exact ranks, of the numbers as written)\n"
    )
    for text in (text for leg in known for text in leg.confused()):
        sys.stdout.write(f"note: {text}\n")
    sys.stdout.write(
        f"\nresiduals by leg [{robot.unit}]: true length less length read, root of the mean square, and greatest\n"
    )
    rows = [
        (str(leg), *(f"{value:.3g}" for part in (fit.before, fit.after) for value in (_rms(part), max(map(abs, part)))))
        for leg, fit in enumerate(fits, 1)
    ]
    print_rows(rows, ("leg", "model", "greatest", "calibrated", "greatest"))
    sys.stdout.write(f"\nchanges [{robot.unit}], with standard deviations; floating point, nothing certified\n")
    print_rows(
        [row for leg, fit in enumerate(fits) for row in _changes(robot, leg, fit)], ("", "model", "change", "+-")
    )


def _changes(robot: Robot, leg: int, fit: LegFit) -> list[tuple[str, str, str, str]]:
    from pkm_exact.identification.calibration_text import model_values

    rows = []
    for place, (name, before) in enumerate(zip(fit.names, model_values(robot, leg, len(fit.names)), strict=True)):
        spread = sqrt(max(fit.covariance[place][place], 0.0))
        rows.append((name, f"{float(before):.9g}", f"{fit.values[place] - float(before):+.3g}", f"{spread:.2g}"))
    return rows


def _rms(values: tuple[float, ...]) -> float:
    return sqrt(sum(value * value for value in values) / len(values))


def _picture(robot: Robot, fits: tuple[LegFit, ...], path: Path) -> bytes:
    from pkm_exact.pictures.output import figure_bytes, picture_format
    from pkm_exact.pictures.residuals import residuals_figure

    suffix = picture_format(path)
    figure = residuals_figure([fit.before for fit in fits], [fit.after for fit in fits], robot.unit)
    return figure_bytes(figure, suffix)
