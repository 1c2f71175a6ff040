"""The command ``plot``: pictures of the poses in a certificate. Everything heavy is imported inside it."""

from __future__ import annotations

import sys
from fractions import Fraction
from pathlib import Path
from typing import TYPE_CHECKING, Any, Final

import click

from pkm_exact.cli import arguments
from pkm_exact.cli.program import PROGRAM, ExitCode
from pkm_exact.errors import InputError
from pkm_exact.wording import printable, shown

if TYPE_CHECKING:
    from matplotlib.figure import Figure

    from pkm_exact.geometry.machine import Machine
    from pkm_exact.pictures.capability_picture import Capability
    from pkm_exact.pictures.drawn_robot import Scene

SMALLEST: Final = 2
LARGEST: Final = 60
"""Inches of a figure, both ways."""


def _pair(context: click.Context, text: str, where: str) -> tuple[float, float]:
    from pkm_exact.geometry.rational import NumberText, parse_rational

    words = [word.strip() for word in text.split(",")]
    if len(words) != 2:
        raise click.UsageError(
            f"{where}: {len(words)} numbers given, two are needed with a comma between them.", context
        )
    try:
        first, second = (float(parse_rational(NumberText(word), where)) for word in words)
    except InputError as error:
        raise click.UsageError(str(error), context) from None
    return first, second


def _view(context: click.Context, _option: click.Parameter, value: str | None) -> tuple[float, float] | None:
    if value is None:
        return None
    azimuth, elevation = _pair(context, value, "--view")
    if abs(azimuth) > 360 or abs(elevation) > 90:
        raise click.UsageError(
            f"--view: {shown(value)} is out of range, give an azimuth up to 360 and an elevation up to 90 degrees.",
            context,
        )
    return azimuth, elevation


def _size(context: click.Context, _option: click.Parameter, value: str | None) -> tuple[float, float] | None:
    if value is None:
        return None
    size = _pair(context, value, "--size")
    if not all(SMALLEST <= inches <= LARGEST for inches in size):
        raise click.UsageError(
            f"--size: {shown(value)} is out of range, give two numbers from {SMALLEST} to {LARGEST}.", context
        )
    return size


@click.command()
@click.argument("certificate", type=arguments.FilePath(), metavar="CERT.json")
@click.option(
    "-o", "--output", type=arguments.FilePath(), required=True, metavar="FILE", help="A .png, .svg or .pdf file."
)
@click.option("--pose", type=int, metavar="K", help="One large picture of this pose instead, numbered as by solve.")
@click.option("--overlay", is_flag=True, help="One picture of all poses at once; with --pose that one stands out.")
@click.option("--roots", is_flag=True, help="The roots of the eliminant and their isolating intervals instead.")
@click.option(
    "--model",
    type=arguments.FilePath(),
    metavar="MODEL.toml",
    help="The robot's model: draws cranks or slides too, and says which limits each pose keeps.",
)
@arguments.near_option("Mark the pose nearest to this one")
@click.option(
    "--limits",
    "limits",
    multiple=True,
    metavar="KEY=VALUES",
    help="With --pose: what actuators can do, as for statics; draws the velocities (speeds=..), the largest ellipsoid "
    "(length=.. as well) and the forces (forces=..) at the platform.",
)
@click.option(
    "--view",
    callback=_view,
    metavar="AZIMUTH,ELEVATION",
    help="Direction of the viewer in degrees; planar robots are seen from above.  [default: -60,20; "
    "of a single pose, that in which legs hide each other least]",
)
@click.option(
    "--size", callback=_size, metavar="WIDTH,HEIGHT", help="Of the picture in inches.  [default: as the poses need]"
)
@click.option(
    "--dpi", type=click.IntRange(20, 600), default=150, show_default=True, help="Dots per inch of a .png file."
)
def plot(
    certificate: str,
    output: str,
    pose: int | None,
    overlay: bool,
    roots: bool,
    model: str | None,
    near: tuple[Fraction, ...] | None,
    limits: tuple[str, ...],
    view: tuple[float, float] | None,
    size: tuple[float, float] | None,
    dpi: int,
) -> int:
    """Draw the real poses that a certificate lists, side by side, to one scale and from the same side.

    The certificate is checked first: nothing is drawn of one that is rejected (exit code 1). Each title has the number
    of the pose, the sign of the determinant of its leg Jacobian and the condition number.

    \b
    Examples:
      certify-poses plot certs/rolland-6-6.json -o poses.png
      certify-poses plot certs/rolland-6-6.json -o pose.svg --pose 3 --view -30,15
      certify-poses plot certs/hexa.json -o hexa.pdf --model models/hexa.toml --near 0,0,650,0,0,0
      certify-poses plot certs/rolland-6-6.json -o forces.png --pose 3 --limits forces=5
      certify-poses plot certs/rolland-6-6.json -o roots.png --roots
    """
    if roots and any(given not in (None, False, ()) for given in (pose, overlay, view, model, near, limits)):
        raise click.UsageError("--roots excludes --pose, --overlay, --view, --model, --near and --limits.")
    if limits and pose is None:
        raise click.UsageError("--limits: is drawn at one pose, give --pose K as well.")
    path, source = Path(output), Path(certificate)
    from pkm_exact.interactive.progress import Progress
    from pkm_exact.pictures.output import picture_format
    from pkm_exact.pictures.scene import DRAWN, OF_POSES, RejectedError, accepted_document
    from pkm_exact.pictures.style import require_matplotlib

    suffix = picture_format(path)
    arguments.require_writable(path, "-o")
    for file, what in ((source, "the certificate"), (model and Path(model), "the model file")):
        if file and file.exists():
            arguments.require_other_file(path, str(file), "-o", what)
    require_matplotlib()
    try:
        with Progress(verbose=False) as progress:
            progress(f"checking {source.name}")
            document = accepted_document(source, formats={*OF_POSES, *DRAWN})
    except RejectedError as error:
        click.echo(f"{PROGRAM}: error: {printable(str(error))}", err=True)
        return ExitCode.REJECTED
    try:
        figure, line = _figure(document, pose, overlay, roots, model, near, limits, view, size)
        data = _bytes(figure, suffix, dpi)
    except InputError as error:
        raise InputError(f"{certificate}: {error}") from None
    arguments.write_output(path, data)
    sys.stdout.write(f"{printable(output)}: {line}\n")
    return ExitCode.DONE


def _figure(
    document: dict[str, Any],
    pose: int | None,
    overlay: bool,
    roots: bool,
    model: str | None,
    near: tuple[Fraction, ...] | None,
    limits: tuple[str, ...],
    view: tuple[float, float] | None,
    size: tuple[float, float] | None,
) -> tuple[Figure, str]:
    """The figure, and what it shows in one line."""
    from pkm_exact.certify import certified_links
    from pkm_exact.cli.model_reading import announced_model
    from pkm_exact.pictures import captions
    from pkm_exact.pictures.camera import DEFAULT_VIEW, View
    from pkm_exact.pictures.clear_view import clear_view
    from pkm_exact.pictures.roots import roots_figure
    from pkm_exact.pictures.scene import scene_of
    from pkm_exact.pictures.views import overlay_figure, pose_figure, poses_figure

    if roots:
        return roots_figure(document, size=size), "the roots of the eliminant"
    if model is not None and document["format"] == certified_links.FORMAT:
        raise InputError("--model: a certificate of a mechanism with passive bodies has all of it; leave out the model")
    machine = None if model is None else announced_model(model)
    scene = scene_of(document, machine, near)
    seen = DEFAULT_VIEW if view is None else View(*view)
    if pose is not None:
        if view is None and not overlay and pose <= len(scene.poses):
            seen = clear_view(scene, scene.poses[pose - 1])
        found = (
            _capabilities(document, machine, pose, limits, scene) if limits and 1 <= pose <= len(scene.poses) else ()
        )
        figure = pose_figure(scene, pose, view=seen, size=size, ghosts=overlay, capabilities=found)
        chosen = "" if seen == DEFAULT_VIEW or view else f", seen from {seen.azimuth:g},{seen.elevation:g}"
        scales = "".join(f"; {each.statement(scene.unit)}" for each in found)
        return figure, f"pose {pose} of {len(scene.poses)}{chosen}{scales}"
    figure = (overlay_figure if overlay else poses_figure)(scene, view=seen, size=size)
    return figure, captions.statement(scene)


def _capabilities(
    document: dict[str, Any], machine: Machine | None, pose: int, limits: tuple[str, ...], scene: Scene
) -> list[Capability]:
    """What the machine can do at a pose with these limits, to the scale of the picture."""
    from pkm_exact.certify.statics_of_poses import at_certified_poses
    from pkm_exact.cli.statics_answers import answers
    from pkm_exact.pictures.capability_picture import capabilities

    if "robot" not in document:
        raise InputError("--limits: is for certificates of poses of a robot or mechanism; this one has passive bodies")
    found = answers(at_certified_poses(document, machine, [pose - 1])[0], None, None, limits, None)
    if found.measures is None:
        raise InputError("--limits: there is no J at this pose; give --model, or another pose")
    return capabilities(found.measures, found.ellipsoid, scene.size)


def _bytes(figure: Figure, suffix: str, dpi: int) -> bytes:
    from pkm_exact.pictures.output import figure_bytes

    return figure_bytes(figure, suffix, dpi=dpi)
