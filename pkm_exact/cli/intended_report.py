"""What ``track --intended`` says: how far the branch is from intended poses, and after which row they part."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from fractions import Fraction
from typing import TYPE_CHECKING, Any

import click

from pkm_exact.errors import InputError

if TYPE_CHECKING:
    from pkm_exact.geometry.machine import Machine
    from pkm_exact.geometry.path_reader import JointPath
    from pkm_exact.geometry.pose_path_reader import PosePath


@dataclass(frozen=True)
class Intended:
    """Intended poses, one for each row of a path, and how far off the branch may be.

    Attributes
    ----------
    poses : PosePath
    distance, degrees : Fraction
    unit : str
    """

    poses: PosePath
    distance: Fraction
    degrees: Fraction
    unit: str

    def read_with(self, joints: JointPath) -> None:
        """Refuse poses that do not belong to the rows of a path of joint values."""
        if len(self.poses.rows) != len(joints.rows):
            raise InputError(
                f"--intended: has {len(self.poses.rows)} poses, and the path {len(joints.rows)} rows; give one for each"
            )
        if self.poses.times is None or joints.times is None:
            return
        for line, mine, other in zip(self.poses.lines, self.poses.times, joints.times, strict=True):
            if mine != other:
                raise InputError(f"--intended: line {line}, time: is not that of the path's row; give the same times")


def intended(path: str | None, within: str | None, robot: Machine) -> Intended | None:
    """What the options ask for.

    Raises
    ------
    InputError
        With file, line and remedy.
    """
    from pkm_exact.geometry.pose_path_reader import read_pose_path
    from pkm_exact.geometry.rational import parse_positive

    if path is None:
        if within is not None:
            raise click.UsageError("--within: belongs to --intended; leave it out, or give the intended poses.")
        return None
    if within is None:
        raise click.UsageError("--within: is missing: how far off the branch may be, such as 0.1,0.5 (degrees last).")
    numbers = within.split(",")
    if len(numbers) != 2:
        raise click.UsageError("--within: give a length and degrees between commas, such as 0.1,0.5.")
    poses = read_pose_path(path, robot)
    if poses is None:
        raise InputError(f"{path}: has no columns of poses; name them in the first line, as x,y,z,roll,pitch,yaw")
    distance, degrees = (parse_positive(_number(text.strip()), "--within") for text in numbers)
    return Intended(poses, distance, degrees, robot.unit)


def _number(text: str) -> str:
    from pkm_exact.geometry.rational import NumberText

    return text if "/" in text else NumberText(text)


def compared(wanted: Intended, records: Sequence[dict[str, Any]]) -> dict[str, Any]:
    """For each sample how far it is off, and after which row the branch and the intended poses part."""
    from pkm_exact.poses.limit_checks import LimitVerdict
    from pkm_exact.poses.pose_spelling import pose_of
    from pkm_exact.regions.intended_poses import deviation

    rows, parted, undecided = [], None, []
    for record in records:
        row = wanted.poses.rows[record["row"] - 1]
        found = deviation(pose_of(record), wanted.poses.columns, row)
        verdict = found.within(wanted.distance, wanted.degrees)
        rows.append(
            {
                "row": record["row"],
                "distance": [str(found.distance.lo), str(found.distance.hi)],
                "degrees": [str(found.degrees.lo), str(found.degrees.hi)],
                "within": str(verdict),
            }
        )
        if verdict is LimitVerdict.UNDECIDED:
            undecided.append(record["row"])
        if verdict is LimitVerdict.NO and parted is None:
            parted = record["row"]
    return {
        "within": [str(wanted.distance), str(wanted.degrees)],
        "compared": "rows",
        "parted_at_row": parted,
        "undecided_rows": undecided,
        "rows": rows,
    }


def said(wanted: Intended, found: dict[str, Any]) -> str:
    """One line."""
    from pkm_exact.cli.region_report import rounded_down, rounded_up

    unit = "" if wanted.unit == "1" else f" {wanted.unit}"
    allowed = f"{float(wanted.distance):.9g}{unit} and {float(wanted.degrees):.9g} degrees"
    parted = found["parted_at_row"]
    if parted is not None:
        row = found["rows"][parted - 1]
        far, turned = (rounded_down(Fraction(row[key][0])) for key in ("distance", "degrees"))
        where = "they part after row " + str(parted - 1) if parted > 1 else "they differ from the first row on"
        return (
            f"intended: at row {parted} the branch is at least {far}{unit} and {turned} degrees off, and no more than "
            f"{allowed} are allowed: {where}"
        )
    if found["undecided_rows"]:
        rows = ", ".join(map(str, found["undecided_rows"]))
        return f"intended: not decided at rows {rows} whether the branch is within {allowed}; give a smaller --width"
    far, turned = (rounded_up(max(Fraction(row[key][1]) for row in found["rows"])) for key in ("distance", "degrees"))
    return (
        f"intended: at every row within {allowed}; at most {far}{unit} and {turned} degrees off; between rows nothing "
        "is compared"
    )
