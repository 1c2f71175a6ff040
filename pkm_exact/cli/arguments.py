"""Words of the command line as values; what is wrong with them is said before any work begins."""

from __future__ import annotations

import re
from collections.abc import Callable
from fractions import Fraction
from pathlib import Path
from typing import TYPE_CHECKING, Any, Final, TypeAlias

import click

from pkm_exact.cli.program import PROBLEM
from pkm_exact.cli.shell_completion import configurations
from pkm_exact.errors import InputError
from pkm_exact.formulations.registry import checked_code, formulation_codes
from pkm_exact.policy import SMALLEST_WIDTH
from pkm_exact.wording import shown

if TYPE_CHECKING:
    from pkm_exact.geometry.machine import Machine
    from pkm_exact.geometry.problem import ForwardProblem
    from pkm_exact.geometry.robot import Configuration

LONGEST_TIME: Final = 10**8
MOST_LENGTHS: Final = 64
_POSE_NAME: Final = re.compile(r"[PN0X](-[A-Z]{1,2}){1,2}(\.[0-9]{1,9})?")
NEAR: Final = 0
"""Instead of the number of a pose: that of the nearest to the nominal pose."""
JointWord: TypeAlias = tuple[Fraction, bool]
"""A joint value, and whether it is an angle in degrees."""


def width(context: click.Context, _option: click.Parameter, value: str) -> Fraction:
    """The number that --width denotes."""
    number = _number(context, value, "--width")
    if not SMALLEST_WIDTH <= number <= 1:
        raise click.UsageError(f"--width: {shown(value)} is out of range, give a number from 2^-4096 to 1.", context)
    return number


def nearest(context: click.Context, _option: click.Parameter, value: str | None) -> Fraction | None:
    """The number that --nearest denotes; None if it is not given."""
    if value is None:
        return None
    number = _number(context, value, "--nearest")
    if number > 1 or number < SMALLEST_WIDTH:
        raise click.UsageError(f"--nearest: {shown(value)} is out of range, give a number from 2^-4096 to 1.", context)
    return number


def lengths(context: click.Context, _option: click.Parameter, value: str | None) -> tuple[Fraction, ...] | None:
    """The numbers that --lengths denotes; the robot says how many there must be."""
    if value is None:
        return None
    words = value.split(",")
    if len(words) > MOST_LENGTHS:
        raise click.UsageError(f"--lengths: {len(words)} given, at most {MOST_LENGTHS} are possible.", context)
    return tuple(_number(context, word.strip(), f"--lengths, number {i}") for i, word in enumerate(words, 1))


def near(context: click.Context, _option: click.Parameter, value: str | None) -> tuple[Fraction, ...] | None:
    """The numbers that --near denotes; the robot says how many there must be."""
    return None if value is None else _any_numbers(context, value, "--near")


def near_option(what: str, default: str = "the model's nominal pose") -> Callable[[Any], Any]:
    """The option --near of a command, which does this with the nearest pose."""
    return click.option(
        "--near",
        callback=near,
        metavar="X,Y,Z,R,P,Y",
        help=f"{what}: position, and roll, pitch, yaw in degrees, a quaternion or a matrix. X,Y,DEGREES if planar.  "
        f"[default: {default}]",
    )


def start_pose(context: click.Context, _option: click.Parameter, value: str | None) -> int | str | None:
    """The number of a pose that --start denotes, its name, or ``NEAR``; None if it is not given."""
    if value is None or _POSE_NAME.fullmatch(value):
        return value
    if value == "near":
        return NEAR
    if not value.isascii() or not value.isdigit() or not int(value[:9]) > 0 or len(value) > 9:
        raise click.UsageError(
            f"--start: {shown(value)} is no pose; give its number, from 1, its name, such as P-U-EU, or near.", context
        )
    return int(value)


def joints(context: click.Context, _option: click.Parameter, value: str | None) -> tuple[JointWord, ...] | None:
    """What --joints denotes: a number each, and whether it is one of degrees."""
    if value is None:
        return None
    words = [word.strip() for word in value.split(",")]
    bare = [word.removesuffix("deg").rstrip() for word in words]
    numbers = _any_numbers(context, ",".join(bare), "--joints")
    return tuple((number, word != text) for number, word, text in zip(numbers, words, bare, strict=True))


def _any_numbers(context: click.Context, text: str, where: str) -> tuple[Fraction, ...]:
    from pkm_exact.geometry.rational import NumberText, parse_rational

    words = [word.strip() for word in text.split(",")]
    if len(words) > MOST_LENGTHS:
        raise click.UsageError(f"{where}: {len(words)} given, at most {MOST_LENGTHS} are possible.", context)
    try:
        return tuple(
            parse_rational(word if "/" in word else NumberText(word), f"{where}, number {i}")
            for i, word in enumerate(words, 1)
        )
    except InputError as error:
        raise click.UsageError(str(error), context) from None


def timeout(context: click.Context, _option: click.Parameter, value: str) -> float:
    """The number of seconds that --timeout denotes."""
    return _seconds(context, value, "--timeout")


def time_limit(context: click.Context, _option: click.Parameter, value: str | None) -> float | None:
    """The number of seconds that --time-limit denotes; None if it is not given."""
    return None if value is None else _seconds(context, value, "--time-limit")


def _seconds(context: click.Context, value: str, where: str) -> float:
    number = _number(context, value, where)
    if number > LONGEST_TIME:
        raise click.UsageError(f"{where}: {shown(value)} is out of range, give at most 10^8 seconds.", context)
    return float(number)


def start(context: click.Context, _option: click.Parameter, value: str | None) -> tuple[float, ...] | None:
    """The numbers that --start denotes, seven or three; the robot says which. Only here a double may be rounded."""
    if value is None:
        return None
    from pkm_exact.geometry.rational import NumberText, parse_rational

    words = [word.strip() for word in value.split(",")]
    if len(words) not in (3, 7):
        raise click.UsageError(
            f"--start: {len(words)} numbers given, seven are needed between commas, three for a planar robot.", context
        )
    try:
        return tuple(
            float(parse_rational(word if "/" in word else NumberText(word), f"--start, number {i}"))
            for i, word in enumerate(words, 1)
        )
    except InputError as error:
        raise click.UsageError(str(error), context) from None


def code(context: click.Context, _option: click.Parameter, value: str) -> str:
    """The code that --formulation denotes."""
    return _code(context, value, "--formulation")


def codes(context: click.Context, _option: click.Parameter, value: str | None) -> tuple[str, ...]:
    """The codes that --only denotes; all if it is not given."""
    if value is None:
        return formulation_codes()
    return tuple(_code(context, word.strip(), "--only") for word in value.split(","))


def _code(context: click.Context, value: str, where: str) -> str:
    try:
        return checked_code(value)
    except InputError as error:
        raise click.UsageError(f"{where}: {str(error).removeprefix('formulation: ')}", context) from None


def _number(context: click.Context, text: str, where: str) -> Fraction:
    from pkm_exact.geometry.rational import NumberText, parse_positive

    try:
        return parse_positive(text if "/" in text else NumberText(text), where)
    except InputError as error:
        raise click.UsageError(str(error), context) from None


def chosen_problem(
    robot: Machine, model: str, configuration: str | None, given: tuple[Fraction, ...] | None = None
) -> tuple[Configuration | None, ForwardProblem]:
    """The configuration of that name, or the first, and its problem; or None and that of the given lengths."""
    try:
        if given is not None:
            chosen, problem = None, robot.problem_at(given)
        else:
            chosen = robot.configuration(configuration)
            problem = robot.problem(chosen)
    except InputError as error:
        raise InputError(f"{model}: {error}") from None
    context = click.get_current_context(silent=True)
    if context is not None:
        context.meta[PROBLEM] = problem
    return chosen, problem


def require_other_file(path: Path, source: str, option: str, what: str = "the model file") -> None:
    """Refuse an output that is an input itself: it would be overwritten."""
    if path.exists() and path.samefile(source):
        raise InputError(f"{path}: is {what} itself; give {option} another path")


def require_writable(path: Path, option: str) -> None:
    """Find out before the work, not after it, that a file cannot be written."""
    import os

    if path.is_dir():
        raise InputError(f"{path}: is a directory; give {option} the path of a file")
    if path.exists() and not path.is_file():  # a device or a pipe, which a file would take the place of
        raise InputError(f"{path}: is not a regular file; give {option} the path of one")
    folder = Path(os.path.realpath(path)).parent if path.is_symlink() else path.parent
    if not folder.is_dir():
        raise InputError(f"{path}: the folder {folder} does not exist; create it or give {option} another path")
    if not os.access(folder, os.W_OK):
        raise InputError(f"{path}: the folder {folder} is not writable; give {option} another path")


def write_output(path: str | Path, data: bytes, option: str = "-o") -> None:
    """Write what an option asks for.

    Raises
    ------
    InputError
        If the file cannot be written.
    """
    from pkm_exact.files import write_whole

    try:
        write_whole(path, data)
    except OSError as error:
        raise InputError(f"{path}: cannot be written ({error.strerror}); give another path to {option}") from None


class FilePath(click.Path):
    """The path of a file, which may or may not exist: it is opened, or refused, where it is needed."""

    def convert(self, value: Any, parameter: click.Parameter | None, context: click.Context | None) -> Any:
        """The path itself, refused if it is empty or no path."""
        if value == "":
            self.fail("the path '' is empty; give the path of a file", parameter, context)
        if isinstance(value, str) and "\0" in value:
            self.fail(f"the path {shown(value)} has a null character; give the path of a file", parameter, context)
        return super().convert(value, parameter, context)


def layout_option(meaning: str, choices: tuple[str, ...] = ("table", "json")) -> Callable[[Any], Any]:
    """The option --format of a command, with what it says of it; the first choice is taken if it is not given."""
    return click.option(
        "--format", "layout", type=click.Choice(choices), default=choices[0], show_default=True, help=meaning
    )


certificate_option = click.option(
    "-o", "--output", type=FilePath(), metavar="CERT.json", help="Write the certificate to this file."
)
configuration_option = click.option(
    "--configuration",
    metavar="NAME",
    shell_complete=configurations,
    help="Configuration of the model file.  [default: the first one]",
)
width_option = click.option(
    "--width",
    callback=width,
    metavar="W",
    default="1e-9",
    show_default=True,
    help="Greatest width of a box, exact: 1e-9 or 1/1000.",
)
lengths_option = click.option(
    "--lengths",
    callback=lengths,
    metavar="L1,..,L6",
    help="Leg lengths instead, exact: 1250 or 12.5 or 25/2. Three if planar.",
)
joints_option = click.option(
    "--joints",
    callback=joints,
    metavar="Q1,..,Qn",
    help="Joint values instead: lengths, positions of slides, half tangents of cranks, or their angles as 30deg.",
)
