"""The command ``convert``: a model file in another unit of length."""

from __future__ import annotations

from pathlib import Path

import click

from pkm_exact.cli import arguments
from pkm_exact.cli.program import PROGRAM, ExitCode
from pkm_exact.errors import InputError
from pkm_exact.wording import printable


@click.command()
@click.argument("model", type=arguments.FilePath())
@click.option("--unit", metavar="UNIT", required=True, help="Unit of all lengths of the new file: mm, cm, m, in, ft.")
@click.option(
    "-o", "--output", type=arguments.FilePath(), metavar="NEW.toml", required=True, help="Write to this file."
)
@click.option("--force", is_flag=True, help="Overwrite the file if it exists.")
def convert(model: str, unit: str, output: str, force: bool) -> int:
    """Write the robot of the file MODEL, whose unit must be one of these, with all lengths in another unit.

    Joints, cranks, rods, configurations, tolerances, limits and the nominal pose are multiplied, exactly: what is no
    decimal then is written as a fraction. The robot is that of the file as it was read, with what stands in for
    numbers that are not exact; comments are not kept. Nothing else ever converts a unit.

    \b
    Examples:
      certify-poses convert models/rolland-6-6.toml --unit m -o metres.toml
      certify-poses convert metres.toml --unit in -o inches.toml
    """
    target = Path(output)
    from pkm_exact.cli.model_reading import announced_robot
    from pkm_exact.geometry.length_units import factor_between, in_unit
    from pkm_exact.geometry.model_writer import robot_text

    robot = announced_robot(model, "convert")
    arguments.require_other_file(target, model, "-o")
    arguments.require_writable(target, "-o")
    if target.exists() and not force:
        raise InputError(f"{printable(output)}: exists; give -o another path, or --force to overwrite it")
    try:
        converted = in_unit(robot, unit)
        factor = factor_between(robot.unit, unit)
    except InputError as error:
        raise InputError(f"{printable(model)}: {error}") from None
    arguments.write_output(target, robot_text(converted).encode("utf-8"))
    click.echo(f"{printable(output)}: all lengths times {factor}, {printable(robot.unit)} to {unit}")
    digits = (robot.written_digit, *(entry.written_digit for entry in robot.configurations))
    if any(digit is not None for digit in digits) and factor.numerator * factor.denominator % 127 == 0:
        click.echo(
            f"{PROGRAM}: note: how many decimals the numbers had is not to be seen in the new file, so that no answer "
            "from it will speak of doubts about the last one",
            err=True,
        )
    return ExitCode.DONE
