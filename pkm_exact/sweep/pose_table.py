"""A sweep's answers as a table for spreadsheets: one line per pose, in decimals and degrees."""

from __future__ import annotations

import csv
import io
import json
from collections.abc import Iterable, Iterator
from itertools import chain
from pathlib import Path
from typing import Any, Final

from pkm_exact.errors import InputError
from pkm_exact.geometry.csv_fields import exact_number
from pkm_exact.geometry.rational import finite_decimal
from pkm_exact.indices.index import Output
from pkm_exact.indices.pose_indices import shown_in
from pkm_exact.sweep.job import SweepJob

SUFFIX: Final = ".csv"
_ROW: Final = ("claim", "complex_solutions", "real_poses")
_PLANAR: Final = ("x", "y", "degrees")
_SPATIAL: Final = ("x", "y", "z", "roll", "pitch", "yaw", "q0", "q1", "q2", "q3")


def is_table(output: Path) -> bool:
    """Whether the output of a sweep is a table, by its name.

    Examples
    --------
    >>> is_table(Path("poses.CSV")), is_table(Path("poses.jsonl"))
    (True, False)
    """
    return output.suffix.lower() == SUFFIX


def pose_table(job: SweepJob, lines: Iterable[bytes]) -> Iterator[bytes]:
    """The lines of the table.

    Parameters
    ----------
    job : SweepJob
        One with ``table``.
    lines : iterable of bytes
        Its answers, one JSON object each.

    Yields
    ------
    bytes
        A header; then of every row a line per pose, or a single one without a pose. Poses are those of the answers, to
        the digit; joint values are decimals, rounded to the nearest double where they do not end.
    """
    planar = job.robot.motion.is_planar
    indices = [index.name for index in shown_in(Output.SWEEP)] + ["multiplicity"]
    asked = () if job.indices is None else job.indices.names
    joints = [f"joint_{name}" for name in job.names]
    header = [
        "row",
        *joints,
        *_ROW,
        "pose",
        "name",
        "nearest",
        *(_PLANAR if planar else _SPATIAL),
        *indices,
        *asked,
        "notes",
    ]
    yield _spelled(header)
    for record in map(json.loads, lines):
        first = [record["row"], *_joints(record["lengths"], len(joints))]
        poses = record.get("poses", [])
        said = record["error"] if "error" in record else " ".join(f"{note}." for note in record["notes"])
        first += [record.get(key) for key in _ROW]
        for number, pose in enumerate(poses, 1):
            near = "yes" if record.get("nearest_to_nominal") == [number] else ""
            values = [pose["name"], near, *_coordinates(pose, planar), *(pose[name] for name in indices)]
            yield _spelled([*first, number, *values, *(pose["indices"][name] for name in asked), said])
        if not poses:
            yield _spelled([*first, *[None] * (len(header) - len(first) - 1), said])


def _coordinates(pose: dict[str, Any], planar: bool) -> list[str | None]:
    if planar:
        return [*pose["position"][:2], *pose["degrees"]]
    return [*pose["position"], *pose["degrees"], *pose["quaternion"]]


def _joints(fields: list[str] | None, count: int) -> list[str]:
    """Joint values as numbers; what is none, as it was written. A line that has not as many has none."""
    if fields is None or len(fields) != count:
        return [""] * count
    return list(map(_number, fields))


def _number(field: str) -> str:
    try:
        value = exact_number(field, "")
        return finite_decimal(value) or repr(float(value))
    except (InputError, OverflowError):
        return field


def _spelled(fields: Iterable[object]) -> bytes:
    text = io.StringIO()
    csv.writer(text, lineterminator="\n").writerow(chain("" if field is None else str(field) for field in fields))
    return text.getvalue().encode()
