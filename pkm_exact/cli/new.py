"""The command ``new``: a first model file from a few answers. Everything heavy is imported inside it."""

from __future__ import annotations

import shlex
import sys
from dataclasses import replace
from pathlib import Path
from typing import TYPE_CHECKING, Any, Final

import click

from pkm_exact.cli import arguments
from pkm_exact.cli.circle_options import PARTS
from pkm_exact.cli.design_questions import ALIASES, ask, asked_design, can_ask
from pkm_exact.cli.program import PROGRAM, ExitCode
from pkm_exact.errors import InputError
from pkm_exact.geometry.kinds import KINDS
from pkm_exact.geometry.machines.machine_kinds import MACHINES
from pkm_exact.templates import DEFAULT_DECIMALS, MOST_DECIMALS
from pkm_exact.wording import printable

if TYPE_CHECKING:
    from pkm_exact.solution import Solution
    from pkm_exact.templates.design import Design, Draft

STDOUT: Final = "-"
_BAD_CONDITION: Final = 1000
_CRANKED: Final = tuple(code for code, kind in KINDS.items() if kind.chain_table == "cranks")


CHAIN_NAMES: Final = ("3-PPRR", "Sarrus", "seven-link", "5-RRR(RR)", "3-PRRR", "3-UPU")
"""What ``--chains`` takes (``templates.chain_templates``)."""


@click.command()
@click.option(
    "--kind",
    type=click.Choice([*KINDS, *MACHINES, *ALIASES]),
    metavar="KIND",
    help=f"Kind of robot: {', '.join((*KINDS, *MACHINES))}; 6-6 means 6-UPS.",
)
@click.option(
    "--base-sides",
    metavar="P,Q",
    help="Sides 1-2, 2-3 of the base, a hexagon of equal angles with two side lengths in turn. A,B,C if planar: a "
    "triangle's sides 1-2, 2-3, 3-1.",
)
@click.option("--platform-sides", metavar="P,Q", help="The same of the platform.")
@click.option(
    "--base-circle",
    metavar="R,DEGREES",
    help="Instead of sides: radius of the circle through the base joints, and the angle between joints 1 and 2. The "
    "sides are rounded to six digits.",
)
@click.option("--platform-circle", metavar="R,DEGREES", help="The same of the platform.")
@click.option(
    "--platform-shift",
    metavar="DEGREES",
    help="With circles: turn of the platform's pairs of joints against the base's; 60 is the common hexapod. The "
    "DEGREES of both circles are then those between the two joints of a pair, and joint i of the platform is the "
    "nearest to joint i of the base.",
)
@click.option(
    "--base-azimuth",
    metavar="DEGREES",
    help="With it: where the first pair of the base is, from the x-axis.  [default: -90]",
)
@click.option(
    "--csv",
    type=arguments.FilePath(),
    metavar="JOINTS.csv",
    help="Instead of sides or circles: joints in columns base_x, base_y, base_z, platform_x, platform_y, platform_z, a "
    "row per leg, and length if known. Numbers are exact as written, or rounded with --digits.",
)
@click.option(
    "--urdf",
    type=arguments.FilePath(),
    metavar="ROBOT.urdf",
    help="Instead: links and joints of a URDF file, loops closed by loop_joint elements, as a robot with six legs "
    "(UPS, SPS or PUS) if it is one, otherwise as a mechanism of bodies and joints for mobility, all joint values 0.",
)
@click.option(
    "--loops",
    type=arguments.FilePath(),
    metavar="ROBOT.yaml",
    help="With --urdf: a YAML file that closes its loops: closed_loop: [[frame, frame], ..], type: [6d, 3d, ..], "
    "name_mot: [joint, ..].",
)
@click.option(
    "--platform",
    metavar="LINK",
    help="With --urdf: the link that is asked about.  [default: where six joints end, otherwise the last one]",
)
@click.option(
    "--bodies", is_flag=True, help="With --urdf: bodies and joints, also of a robot that is recognised by its six legs."
)
@click.option(
    "--chains",
    type=click.Choice(CHAIN_NAMES, case_sensitive=False),
    metavar="NAME",
    help=f"Instead: a mechanism of bodies and joints for mobility: {', '.join(CHAIN_NAMES)}; its dimensions by "
    "--dimension, examples of the others.",
)
@click.option("--height", metavar="H", help="Height of the platform at home; y of its joint 1 if planar.")
@click.option("--crank", metavar="L", help="Length of the cranks, for kinds that have them.")
@click.option(
    "--motor-direction",
    metavar="DEGREES",
    help="With --crank on circles: where the cranks point at 0 degrees, mirrored in each pair: 0 along the circle, "
    "away from the other joint of the pair, 90 away from the centre, 180 towards the other joint.  [default: 0]",
)
@click.option("--rod", metavar="L", help="Instead of --height: length of all rods, for 6-RUS and 6-PUS.")
@click.option(
    "--digits",
    type=click.IntRange(0, MOST_DECIMALS),
    help=f"Round joints to so many decimals.  [default: {DEFAULT_DECIMALS}, unless they are rational]",
)
@click.option(
    "--exact", is_flag=True, help="Exact joints, in a metric: y in the file is then not y, but y by a square root."
)
@click.option(
    "--dimension",
    "dimensions",
    multiple=True,
    metavar="KEY=VALUE",
    help=f"For {next(iter(MACHINES))} and the kinds after it: a dimension, as a model file has it, such as "
    "base_radius=120. The others are examples; may be given several times.",
)
@click.option("--unit", help="Unit of all lengths, for display.  [default: mm]")
@click.option("--name", help="Name of the robot.  [default: that of the file]")
@click.option(
    "-o", "--output", type=arguments.FilePath(), metavar="MODEL.toml", help="Write to this file; - for stdout."
)
@click.option("--force", is_flag=True, help="Overwrite the file if it exists.")
def new(
    output: str | None,
    name: str | None,
    force: bool,
    csv: str | None,
    dimensions: tuple[str, ...],
    urdf: str | None,
    loops: str | None,
    chains: str | None,
    platform: str | None,
    bodies: bool,
    **given: Any,
) -> int:
    """Write a commented model file of a symmetric robot, as a start for your own.

    On a terminal, what is needed and not given is asked for. Lengths are exact (12.5, 25/2) and in any unit. The file
    has a configuration "home" that puts the platform at the given height: level, or turned a little if it is planar. It
    is solved first, and nothing is written if its poses cannot be proved complete.

    \b
    Examples:
      certify-poses new --kind 6-6 --base-sides 400,200 --platform-sides 100,300 --height 500 -o my-robot.toml
      certify-poses new --kind 6-RUS --base-circle 300,40 --platform-circle 120,90 --height 400 --crank 120 --exact -o -
      certify-poses new --kind 3-RPR --base-sides 6,5,5 --platform-sides 1.6,1,1 --height 3 --unit m -o planar.toml
      certify-poses new --kind delta --dimension arm=120 --dimension rod=300 -o delta.toml
      certify-poses new --urdf models/chains/sarrus.urdf -o sarrus.toml
      certify-poses new --chains 3-UPU --dimension height=100 -o three-rods.toml
    """
    _checked_output(output, force)
    of_urdf = {"loops": loops, "platform": platform, "bodies": bodies}
    alone = next((option for option, value in of_urdf.items() if value), None)
    if urdf is None and alone is not None:
        raise click.UsageError(f"--{alone}: belongs to --urdf, give that as well.")
    written = _from_elsewhere(output, name, given, csv=csv, urdf=urdf, chains=chains, of_urdf=of_urdf, words=dimensions)
    if written is not None:
        return written
    if given["kind"] in MACHINES:
        return _new_machine(output, name, dimensions, given)
    if dimensions:
        raise click.UsageError("--dimension: only machines with dimensions have any; see the help of --kind.")
    if given["exact"] and given["digits"] is not None:
        raise click.UsageError("--exact and --digits exclude each other.")
    missing = _missing(given, output)
    if missing and not can_ask():
        raise click.UsageError(f"there is no terminal to ask on; give {', '.join(missing)} as well.")
    interview = given["kind"] is None
    design = asked_design(given, interview=interview)
    unit = given["unit"] or (ask("Unit of length, only for display", "mm", str) if interview else "mm")
    if output is None:
        output = ask("File to write", "my-robot.toml", lambda text: _checked_output(text, force))
    name = name or ("my robot" if output == STDOUT else Path(output).stem)

    from pkm_exact.templates.design import drawn
    from pkm_exact.templates.model_text import model_text

    draft = drawn(design)
    text = model_text(draft, name, unit)
    _require_sound_shape(design)
    found = _proved_at_home(draft, text)
    if output == STDOUT:
        sys.stdout.write(text)
        return ExitCode.DONE
    arguments.write_output(output, text.encode("utf-8"))
    click.echo(f"{printable(output)}: {design.kind}, home: {found}")
    click.echo(f"next: {PROGRAM} solve {printable(shlex.quote(output))}")
    return ExitCode.DONE


def _from_elsewhere(
    output: str | None,
    name: str | None,
    given: dict[str, Any],
    *,
    csv: str | None,
    urdf: str | None,
    chains: str | None,
    of_urdf: dict[str, Any],
    words: tuple[str, ...],
) -> int | None:
    """The model of a file or of a template of bodies and joints, if one is named."""
    if urdf is not None:
        from pkm_exact.cli.new_from_urdf import write_from_urdf

        others = {"csv": csv, "chains": chains, "name": name, "dimension": words}
        return write_from_urdf(urdf, output, given=given | others, **of_urdf)
    if chains is not None:
        from pkm_exact.cli.new_chains import write_chains

        return write_chains(chains, output, name, words, given | {"csv": csv})
    if csv is not None:
        from pkm_exact.cli.new_from_csv import write_from_csv

        return write_from_csv(csv, output, name, given)
    return None


def _new_machine(output: str | None, name: str | None, dimensions: tuple[str, ...], given: dict[str, Any]) -> int:
    """The model of a machine that has a recipe: dimensions that are given, examples of the others."""
    unfit = [
        key
        for key, value in given.items()
        if key not in ("kind", "unit") and value is not None and value is not False and value != ()
    ]
    if unfit:
        raise click.UsageError(
            f"--{unfit[0].replace('_', '-')}: a {given['kind']} has dimensions of its own; give them by --dimension."
        )
    if output is None:
        raise click.UsageError("give -o as well: the file to write, or - for stdout.")

    from pkm_exact.claim import Claim
    from pkm_exact.engine import solve
    from pkm_exact.geometry.reader import robot_from_toml
    from pkm_exact.interactive.display import headline
    from pkm_exact.templates.machine_text import given_dimensions, machine_text

    kind = MACHINES[given["kind"]]
    name = name or ("my robot" if output == STDOUT else Path(output).stem)
    text = machine_text(kind, name, given["unit"] or "mm", given_dimensions(kind, dimensions))
    robot = robot_from_toml(text)
    solution = solve(robot.problem(robot.configuration()))
    if solution.claim is not Claim.COMPLETE:
        raise InputError(
            f"--dimension: with these no list of poses of the {kind.name} is proved complete at home; "
            f"{headline(solution)} ({solution.claim}); change one of them"
        )
    if output == STDOUT:
        sys.stdout.write(text)
        return ExitCode.DONE
    arguments.write_output(output, text.encode("utf-8"))
    found = f"{len(solution.poses)} real poses of {solution.complex_solutions} complex ones, proved complete"
    if not solution.poses:
        found += (
            "; so it cannot be assembled at home: the joint values are those of an example, change them in the file"
        )
    click.echo(f"{printable(output)}: {kind.name}, home: {found}")
    click.echo(f"next: {PROGRAM} solve {printable(shlex.quote(output))}")
    return ExitCode.DONE


def _missing(given: dict[str, Any], output: str | None) -> list[str]:
    """The options without which nothing can be drawn: nobody is to guess them."""
    names = [] if given["kind"] else ["--kind"]
    names += [f"--{part}-sides" for part in PARTS if given[f"{part}_sides"] is None is given[f"{part}_circle"]]
    names += [] if given["height"] or given["rod"] else ["--height"]
    if given["kind"] in _CRANKED and given["crank"] is None:
        names.append("--crank")
    return names if output is not None else [*names, "-o"]


def _checked_output(output: str | None, force: bool) -> str | None:
    """The path itself, refused if it cannot be written or a file is there."""
    if output is None or output == STDOUT:
        return output
    path = Path(output)
    arguments.require_writable(path, "-o")
    if path.exists() and not force:
        raise InputError(f"{output}: exists; give -o another path, or --force to overwrite it")
    return output


def _require_sound_shape(design: Design) -> None:
    """Refuse rounded joints whose exact robot has no finite list of poses: rounding would only hide that."""
    from pkm_exact.templates.design import drawn
    from pkm_exact.templates.model_text import model_text

    if design.digits is None:
        return
    try:
        exact = drawn(replace(design, digits=None))
    except InputError:
        return  # not exact in any metric, or no robot: that of the rounded joints is looked at below
    _proved_at_home(exact, model_text(exact, "exact", "1"))


def _proved_at_home(draft: Draft, text: str) -> str:
    """What is proved of the home configuration of the model; refused if its poses are not proved complete."""
    from pkm_exact.claim import Claim
    from pkm_exact.engine import solve
    from pkm_exact.geometry.reader import robot_from_toml
    from pkm_exact.interactive.display import headline
    from pkm_exact.interactive.progress import Progress

    robot = robot_from_toml(text)
    with Progress(verbose=False) as progress:
        solution = solve(robot.problem(robot.configuration("home")), progress=progress)
    if solution.claim is not Claim.COMPLETE:
        raise InputError(
            f"--base-sides, --platform-sides: with these no list of poses of the {draft.design.kind} robot is proved "
            f"complete at home; {headline(solution)} ({solution.claim}); change the ratio of one pair of sides"
        )
    _say_if_nearly_singular(solution)
    if any(pose.multiplicity != 1 for pose in solution.poses):
        click.echo("note: one of the poses is singular; `solve` says which", err=True)
    return f"{len(solution.poses)} real poses of {solution.complex_solutions} complex ones, proved complete"


def _say_if_nearly_singular(solution: Solution) -> None:
    """A note if at every pose the legs hold the platform badly: most often base and platform have their pairs alike."""
    conditions = [pose.jacobian.condition for pose in solution.poses if pose.jacobian is not None]
    if conditions and all(condition is not None and condition.lo > _BAD_CONDITION for condition in conditions):
        click.echo(
            f"note: at every pose the condition number is above {_BAD_CONDITION}: the legs hardly hold the platform; "
            "if the two joints of each pair are joined to the two of one pair, give --platform-shift 60 with circles, "
            "or exchange the sides of the platform",
            err=True,
        )
