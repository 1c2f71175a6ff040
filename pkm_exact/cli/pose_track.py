"""What ``track`` does with a path of poses: the joint values that it asks for, and what is proved along it."""

from __future__ import annotations

import csv
import io
import json
from decimal import ROUND_CEILING, ROUND_FLOOR, Context, Decimal
from fractions import Fraction
from pathlib import Path
from typing import TYPE_CHECKING, Any, Final

import click

from pkm_exact.cli import arguments
from pkm_exact.cli.program import ExitCode
from pkm_exact.cli.report import robot_object
from pkm_exact.errors import InputError
from pkm_exact.stages import Amount

if TYPE_CHECKING:
    from flint import arb

    from pkm_exact.geometry.machine import Machine
    from pkm_exact.geometry.pose_path_reader import PosePath
    from pkm_exact.regions.pose_path import PathRefusedError, Place, PosePathProof

_DIGITS: Final = 12
_SHORT: Final = 7


def follow_poses(robot: Machine, path: PosePath, target: Path, modes: str | None, *, verbose: bool) -> int:
    """Prove a path of poses, write what it asks of the joints, and say how far it can be followed."""
    from pkm_exact.interactive.progress import Progress
    from pkm_exact.regions.pose_path import PathRefusedError

    proof = _proof(robot, path, modes)
    samples: list[dict[str, Any]] = []
    refused: PathRefusedError | None = None
    with Progress(verbose=verbose) as progress:
        progress("following the path")

        def shown(row: int, share: Fraction) -> None:
            detail = f"{100 * float(share):.3g} % of the way to the next"
            progress.amount(Amount(row + 1, len(path.rows), "rows", detail=detail))

        try:
            for row, values, sign in proof.samples(shown):
                samples.append({"row": row + 1, "joints": [list(_ends(v, _DIGITS)) for v in values], "det_sign": sign})
        except PathRefusedError as found:
            refused = found
    content = _content(robot, path, proof, samples, refused)
    data = _csv(path, samples) if target.suffix.lower() == ".csv" else json.dumps(content, indent=1) + "\n"
    arguments.write_output(str(target), data.encode("ascii"))
    _say(path, proof, samples, content)
    return ExitCode.DONE if refused is None and not proof.facts.limits else ExitCode.WEAKER_CLAIM


def _proof(robot: Machine, path: PosePath, modes: str | None) -> PosePathProof:
    from pkm_exact.constraints.distance import Distance
    from pkm_exact.geometry.problem import ForwardProblem
    from pkm_exact.poses.jacobian import characteristic_length
    from pkm_exact.regions.pose_path import PosePathProof
    from pkm_exact.regions.region_legs import OnHinge, OwnLength, region_machine

    machine = region_machine(robot)
    if sliding := [leg.name for leg in machine.legs if leg.axis is not None]:
        raise InputError(
            f"{sliding[0]}: slides along an axis, which paths of poses do not know; give a path of lengths"
        )
    if hinged := [leg.name for leg in machine.legs if isinstance(leg.actuator, OnHinge)]:
        raise InputError(
            f"{hinged[0]}: is driven at its hinge, which paths of poses do not know; give a path of joint values"
        )
    if machine.forms or len(machine.legs) != len(machine.twist):
        raise InputError(
            "path: has poses, but these are followed only for robots whose legs are as many as their freedoms "
            f"({len(machine.legs)} legs, {len(machine.twist)} freedoms), without other joints; give joint values"
        )
    signs = [word.strip() for word in (modes or "").split(",")] if modes else []
    if not signs and any(not isinstance(leg.actuator, OwnLength) for leg in machine.legs):
        raise click.UsageError("--working-modes: slides and cranks reach a pose in two ways; give a sign for each leg.")
    if signs and (len(signs) != len(machine.legs) or set(signs) - {"+", "-"}):
        raise click.UsageError(f"--working-modes: give {len(machine.legs)} signs between commas, such as +,-,+.")
    chosen = tuple(1 if sign == "+" else -1 for sign in signs) or (1,) * len(machine.legs)
    legs = tuple(Distance(leg.base, leg.platform, Fraction(1), str(k)) for k, leg in enumerate(machine.legs))
    length = characteristic_length(ForwardProblem(legs, robot.metric, robot.motion))
    return PosePathProof(machine, robot.limits, path.columns, path.rows, chosen, length)


def _content(
    robot: Machine,
    path: PosePath,
    proof: PosePathProof,
    samples: list[dict[str, Any]],
    refused: PathRefusedError | None,
) -> dict[str, Any]:
    facts = proof.facts
    for sample in samples:
        place = sample["row"] - 1
        if path.times is not None:
            sample["time"] = str(path.times[place])
        sample["pose"] = [str(x) for x in path.rows[place]]
    bounds = {
        "sigma_min": facts.least_sigma,
        "determinant": facts.least_determinant,
        "condition": facts.greatest_condition,
    }
    return {
        "robot": robot_object(robot),
        "columns": list(path.columns),
        "rows": len(path.rows),
        "steps": facts.steps,
        "det_sign": facts.det_sign,
        "worst": {name: None if found is None else _worst(name, found) for name, found in bounds.items()},
        "limits": {name: _limit(path, facts.limits.get(name)) for name in (robot.limits.names if robot.limits else ())},
        "samples": samples,
        "stopped": None if refused is None else _where(path, refused.place) | {"reason": refused.reason},
    }


def _worst(name: str, found: tuple[arb, arb]) -> list[str]:
    """Two decimals between which the least or greatest value along the way lies."""
    certain, seen = found
    low, high = (seen, certain) if name == "condition" else (certain, seen)
    return [_ends(low, _SHORT)[0], _ends(high, _SHORT)[1]]


def _limit(path: PosePath, broken: tuple[Any, Place] | None) -> dict[str, Any]:
    if broken is None:
        return {"kept": "yes"}
    return {"kept": str(broken[0]), **_where(path, broken[1])}


def _where(path: PosePath, place: Place) -> dict[str, Any]:
    """Where on the path: between which rows, which parts of the way, and the values of what moves there."""
    following = min(place.row + 1, len(path.rows) - 1)
    ends = {}
    for name, a, b in zip(path.columns, path.rows[place.row], path.rows[following], strict=True):
        if a != b:
            ends[name] = [_decimal(a + share * (b - a), ROUND_FLOOR, _DIGITS) for share in (place.low, place.high)]
    return {
        "after_row": place.row + 1,
        "lines": [path.lines[place.row], path.lines[following]],
        "certified_to": str(place.low),
        "not_certified_to": str(place.high),
        "at": ends,
    }


def _csv(path: PosePath, samples: list[dict[str, Any]]) -> str:
    text = io.StringIO()
    writer = csv.writer(text, lineterminator="\n")
    joints = [
        f"joint{k}_{end}" for k in range(1, len(samples[0]["joints"]) + 1 if samples else 1) for end in ("lo", "hi")
    ]
    timed = path.times is not None
    writer.writerow(["row", *(["time"] if timed else []), *path.columns, *joints, "det_sign"])
    for sample in samples:
        place = sample["row"] - 1
        when = [str(path.times[place])] if path.times is not None else []
        values = [end for pair in sample["joints"] for end in pair]
        writer.writerow([sample["row"], *when, *map(str, path.rows[place]), *values, sample["det_sign"]])
    return text.getvalue()


def _say(path: PosePath, proof: PosePathProof, samples: list[dict[str, Any]], content: dict[str, Any]) -> None:
    sign = ">" if proof.facts.det_sign > 0 else "<"
    click.echo(
        f"{len(samples)} of {len(path.rows)} rows, {proof.facts.steps} certified steps: the poses are reached, "
        f"det J {sign} 0 all along"
        if samples
        else f"0 of {len(path.rows)} rows"
    )
    names = {"sigma_min": "least singular value", "determinant": "least |det J|", "condition": "greatest condition"}
    for name, bounds in content["worst"].items():
        if bounds is not None:
            click.echo(f"{names[name]} along the way: between {bounds[0]} and {bounds[1]}")
    for name, found in content["limits"].items():
        if found["kept"] == "yes":
            click.echo(f"limits, {name}: kept all along")
        else:
            word = "broken" if found["kept"] == "no" else "not decided"
            click.echo(
                f"limits, {name}: {word} between rows {found['after_row']} and {found['after_row'] + 1}{_at(found)}"
            )
    stopped = content["stopped"]
    if stopped is not None:
        click.echo(f"refused after row {stopped['after_row']}{_at(stopped)}: {stopped['reason']}")


def _at(found: dict[str, Any]) -> str:
    texts = (f"{name} from {low} to {high}" for name, (low, high) in found["at"].items())
    joined = ", ".join(texts)
    return f", {joined}" if joined else ""


def _ends(value: arb, digits: int) -> tuple[str, str]:
    """Decimals below and above an enclosed number."""
    low, high = (_fraction(end) for end in (value.lower(), value.upper()))
    return _decimal(low, ROUND_FLOOR, digits), _decimal(high, ROUND_CEILING, digits)


def _fraction(value: arb) -> Fraction:
    mantissa, exponent = value.mid().man_exp()
    return Fraction(int(mantissa)) * Fraction(2) ** int(exponent)


def _decimal(value: Fraction, way: str, digits: int) -> str:
    """A decimal with so many digits, rounded down or up.

    >>> _decimal(Fraction(2, 3), ROUND_CEILING, 4)
    '0.6667'
    """
    context = Context(prec=digits, rounding=way)
    return f"{context.divide(Decimal(value.numerator), Decimal(value.denominator)):f}"
