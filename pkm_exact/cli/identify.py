"""The command ``identify``: which geometric parameters a plan of measured poses can tell apart."""

from __future__ import annotations

import json
import sys
from typing import TYPE_CHECKING, Any

import click

from pkm_exact.cli import arguments
from pkm_exact.errors import InputError
from pkm_exact.wording import counted, printable, shown

if TYPE_CHECKING:
    from collections.abc import Sequence

    from pkm_exact.geometry.mechanism import Mechanism
    from pkm_exact.geometry.robot import Robot
    from pkm_exact.identification.observation import Identification, Plan
    from pkm_exact.identification.root_rows import RootRow
    from pkm_exact.screws.exact_matrix import Row


@click.command()
@click.argument("model", type=arguments.FilePath())
@click.argument("plan", type=arguments.FilePath(), metavar="PLAN.csv")
@click.option("--zeros", is_flag=True, help="The zeros of the actuators' readings are unknown too.")
@click.option(
    "--known",
    multiple=True,
    metavar="NAME",
    help="Parameters that are known: all whose name begins with this, such as 'leg 1 base'; can be repeated.",
)
@click.option("--json", "as_json", is_flag=True, help="Print all of it as a JSON object, every number exact.")
def identify(model: str, plan: str, zeros: bool, known: tuple[str, ...], as_json: bool) -> None:
    """Print which geometric parameters of the machine in MODEL the poses in the file PLAN.csv can tell apart.

    The poses are measured and the joint values are read; every leg and joint is then an equation in the parameters,
    linearised. The rank of these equations is exact, and so are the combinations of parameters that they determine,
    those that nothing shows, and the fewest poses that determine as much. It is about errors to the first order.

    \b
    Examples:
      certify-poses identify models/3-rpr-merlet-p.toml plan.csv
      certify-poses identify models/3-rpr-merlet-p.toml plan.csv --known "leg 1 base" --json
    """
    from pkm_exact.cli.model_reading import announced_model
    from pkm_exact.geometry.path_reader import path_text
    from pkm_exact.identification.constraint_calibration import geometric_parameters, geometric_root_rows
    from pkm_exact.identification.measurement_plan import plan_from_csv
    from pkm_exact.identification.root_rows import identified_with_plan

    robot = announced_model(model)
    names = geometric_parameters(robot, zeros=zeros)
    kept = [k for k, name in enumerate(names) if not name.startswith(known)]
    for word in known:
        if not any(name.startswith(word) for name in names):
            raise InputError(f"--known: no parameter begins with {shown(word)}; they begin with {shown(names[0])}, ..")
    groups: list[list[RootRow]] = []
    try:
        for place, measured in enumerate(plan_from_csv(path_text(plan), robot), 1):
            rows = _rows(geometric_root_rows, robot, measured, place, zeros=zeros)
            groups.append([tuple(row[k] for k in kept) for row in rows])
        found, fewest = identified_with_plan(groups, [names[k] for k in kept])
    except InputError as error:
        raise InputError(f"{printable(plan)}: {error}") from None
    if as_json:
        sys.stdout.write(json.dumps(_object(robot, found, fewest, groups), indent=1) + "\n")
        return
    sys.stdout.write("".join(f"{line}\n" for line in _lines(robot, found, fewest, groups)))


def _rows(rows: Any, robot: Robot | Mechanism, measured: Any, place: int, *, zeros: bool) -> tuple[RootRow, ...]:
    try:
        found: tuple[RootRow, ...] = rows(robot, measured.pose, measured.values, zeros=zeros)
    except InputError as error:
        raise InputError(f"pose {place}: {error}") from None
    return found


def _lines(robot: Robot | Mechanism, found: Identification, fewest: Plan, groups: Sequence[list[RootRow]]) -> list[str]:
    """The answer as lines of a text."""
    count = len(found.parameters)
    equations = sum(map(len, groups))
    sizes = counted(len(groups), "pose"), counted(equations, "equation"), counted(count, "parameter")
    lines = [
        f"{printable(robot.name)} ({robot.kind}): {', '.join(sizes)}",
        f"rank {found.rank}: "
        + ("all parameters are determined" if found.rank == count else f"{count - found.rank} combinations are not"),
    ]
    if found.rank < count:
        alone, unseen = found.seen_alone, found.unseen
        mixed = [text for text in found.base_in_words() if text not in alone]
        lines += [f"determined   {text}" for text in ([", ".join(alone)] if alone else []) + mixed]
        lines += [f"never seen   {', '.join(unseen)}"] if unseen else []
        lines += [
            f"not told     {text}"
            for text, x in zip(found.confused(), found.null_space, strict=True)
            if sum(map(bool, x)) > 1
        ]
    poses = ", ".join(str(k + 1) for k in fewest.chosen) or "none"
    least = "no fewer do" if fewest.is_smallest else "none of them can be left out; whether fewer do is not known"
    lines.append(f"as much by   poses {poses}: {least}")
    return lines


def _object(
    robot: Robot | Mechanism, found: Identification, fewest: Plan, groups: Sequence[list[RootRow]]
) -> dict[str, Any]:
    """The answer as a JSON object."""

    def spelled(rows: Sequence[Row]) -> list[dict[str, str]]:
        return [{name: str(x) for name, x in zip(found.parameters, row, strict=True) if x} for row in rows]

    return {
        "robot": {"name": robot.name, "kind": robot.kind, "unit": robot.unit},
        "poses": len(groups),
        "equations": sum(map(len, groups)),
        "parameters": list(found.parameters),
        "rank": found.rank,
        "determined_alone": list(found.seen_alone),
        "unseen": list(found.unseen),
        "base": spelled(found.base),
        "null_space": spelled(found.null_space),
        "fewest_poses": {"poses": [k + 1 for k in fewest.chosen], "proved": fewest.is_smallest},
    }
