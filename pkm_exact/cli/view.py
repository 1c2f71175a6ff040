"""The command ``view``: the robot in the browser, with sliders. Everything heavy is imported inside it."""

from __future__ import annotations

from dataclasses import replace
from fractions import Fraction

import click

from pkm_exact.cli import arguments
from pkm_exact.cli.program import ExitCode
from pkm_exact.errors import InputError


@click.command()
@click.argument("model", type=arguments.FilePath())
@arguments.configuration_option
@arguments.near_option(
    "The solid pose is the one nearest to this one", "the model's nominal pose, or the best conditioned"
)
@click.option(
    "--port",
    type=click.IntRange(1024, 65535),
    default=8080,
    show_default=True,
    help="Port of the page on this machine, or the next free one.",
)
def view(model: str, configuration: str | None, near: tuple[Fraction, ...] | None, port: int) -> int:
    """Show the robot in the file MODEL in the browser, with a slider for each actuator.

    All poses are certified for the values at the sliders, each time one moves: one is solid, followed from values to
    values by a proof where there is one, the others are ghosts, which become it by a click. Colours say how near to a
    singularity a pose is, and whether it keeps the limits of the model. The page is served to this machine only, and
    loads nothing from elsewhere. Needs the package viser. Ctrl-C ends it.

    \b
    Example:
      certify-poses view models/rolland-6-6.toml
    """
    from pkm_exact.live.viser_view import require_viser

    require_viser()
    from pkm_exact.cli.model_reading import announced_model
    from pkm_exact.live.viser_view import LiveView

    robot = announced_model(model)
    if not robot.actuated:
        raise InputError(f"{model}: has no actuators to move; give a model that has some")
    if near is not None:
        from pkm_exact.geometry.nominal_pose import nominal_from_numbers

        robot = replace(robot, nominal=nominal_from_numbers(near, "--near", robot.motion))
    try:
        live = LiveView(robot, configuration, port)
    except InputError as error:
        raise InputError(f"{model}: {error}") from None
    click.echo(f"{live.address} (Ctrl-C ends it)")
    try:
        live.serve()
    finally:
        live.stop()
    return ExitCode.DONE
