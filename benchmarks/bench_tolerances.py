"""How far tolerances are proved, beside how far random robots show the poses to be regular.

Proved: the greatest tolerance of all joint coordinates and lengths at once for which a pose has a box, to a few bits.
Seen: along rays of errors each pose is followed by Newton's method in doubles until the sign of det J changes or the
method fails. The rays go to random corners of the data, and to those where |det J| falls and grows fastest at first.
The nearest such robot over all rays is the first singular one that was seen; hardly anything beyond it can be
proved. The more rays, the nearer it may be. No times are measured.
"""

from __future__ import annotations

import argparse
import json
from fractions import Fraction
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray

from pkm_exact.engine import solve
from pkm_exact.geometry.problem import ForwardProblem
from pkm_exact.geometry.reader import read_jointed_robot
from pkm_exact.geometry.tolerances import Tolerances
from pkm_exact.numeric.tolerance import tolerance_boxes
from pkm_exact.poses.pose import Pose

ROOT = Path(__file__).parent.parent
FILES = (
    ROOT / "tests" / "cases" / "cad3.toml",
    ROOT / "models" / "mourrain-l.toml",
    ROOT / "models" / "3-rpr-merlet-p.toml",
)
GREATEST = Fraction(1, 5)
"""Of the tolerances that are tried, in parts of the longest leg: so great that no pose is proved for all of it."""
STEPS = 400
Real = NDArray[np.float64]


def main() -> None:
    """Measure, and print a Markdown table."""
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("files", nargs="*", type=Path, default=FILES, help="model files of hexapods or 3-RPR robots")
    parser.add_argument("--rays", type=int, default=200, help="random rays for each pose (default 200)")
    parser.add_argument("--json", type=Path, metavar="FILE", help="write the numbers to FILE as well")
    arguments = parser.parse_args()
    rows = [row for path in arguments.files for row in _rows(path, arguments.rays)]
    print("| robot | pose | proved | singular first seen at | proved / seen |\n|---|---|---|---|---|")
    for row in rows:
        ratio = row["proved"] / row["seen"]
        print(f"| {row['robot']} | {row['pose']} | {row['proved']:.3g} | {row['seen']:.3g} | {ratio:.2f} |")
    if arguments.json is not None:
        arguments.json.write_text(json.dumps(rows, indent=1) + "\n")


def _rows(path: Path, rays: int) -> list[dict[str, Any]]:
    robot = read_jointed_robot(path, "bench_tolerances")
    problem = robot.problem(robot.configuration())
    solution = solve(problem)
    longest = max(float(leg.length_squared) for leg in problem.distances) ** 0.5
    greatest = GREATEST * Fraction(longest).limit_denominator(1000)
    found = tolerance_boxes(problem, Tolerances.uniform(greatest), solution)
    return [
        {
            "robot": robot.name,
            "pose": number,
            "proved": float(box.fraction * greatest),
            "seen": _first_singular(problem, pose, float(greatest), rays),
        }
        for number, (box, pose) in enumerate(zip(found.boxes, solution.poses, strict=True), 1)
    ]


def _first_singular(problem: ForwardProblem, pose: Pose, greatest: float, rays: int) -> float:
    """The least error along all rays at which the sign of det J changes or Newton's method fails."""
    random, legs = np.random.default_rng(1), len(problem.distances)
    corners = np.sign(random.uniform(-1, 1, (rays, 7 * legs)))
    if problem.motion.is_planar:
        corners.reshape(rays, legs, 7)[:, :, [2, 5]] = 0
    scales = np.sqrt(np.array(problem.metric, dtype=float))
    lengths = [float(leg.length_squared) ** 0.5 for leg in problem.distances]
    data = [
        [float(x) * scale for x, scale in zip((*leg.base, *leg.platform, 1), (*scales, *scales, length), strict=True)]
        for leg, length in zip(problem.distances, lengths, strict=True)
    ]
    flat = np.array(data).ravel()
    corners = np.concatenate([_worst_corners(problem, pose, flat, corners[0] != 0), corners])
    nominal = np.tile(flat, (len(corners), 1))
    c, rotation = _starts(pose, len(corners))
    sign = None
    for step in range(STEPS + 1):
        errors = greatest * (step / STEPS) ** 2
        c, rotation, off, dets = _newton(problem, nominal + errors * corners, c, rotation)
        sign = np.sign(dets) if sign is None else sign
        if np.any((np.sign(dets) != sign) | ~(off < 1e-9 * np.abs(nominal).max())):
            return float(errors)
    return greatest


def _starts(pose: Pose, count: int) -> tuple[Real, Real]:
    c = np.array([float(x.midpoint) for x in pose.position])
    rotation = np.array([[float(x.midpoint) for x in row] for row in pose.rotation])
    return np.tile(c, (count, 1)), np.tile(rotation, (count, 1, 1))


def _worst_corners(problem: ForwardProblem, pose: Pose, nominal: Real, moving: NDArray[np.bool_]) -> Real:
    """To first order the corner of the data towards which |det J| falls fastest, and the opposite one."""
    step = 1e-6 * np.abs(nominal).max()
    moved = nominal + step * np.concatenate([np.diag(moving), np.zeros((1, len(nominal)))])
    dets = _newton(problem, moved, *_starts(pose, len(moved)))[3]
    falls = -np.sign((dets[:-1] - dets[-1]) * dets[-1]) * moving
    return np.array([falls, -falls])


def _newton(problem: ForwardProblem, data: Real, c: Real, rotation: Real) -> tuple[Real, Real, Real, Real]:
    """Positions, rotations, residuals and determinants after some steps."""
    parts = data.reshape(len(data), len(problem.distances), 7)
    base, platform, lengths = parts[..., :3], parts[..., 3:6], parts[..., 6]
    columns = [0, 1, 5] if problem.motion.is_planar else list(range(6))
    for _ in range(6):
        arms = np.einsum("mij,mnj->mni", rotation, platform)
        lines = c[:, None, :] + arms - base
        now = np.linalg.norm(lines, axis=2)
        units = lines / now[..., None]
        jacobian = np.concatenate([units, np.cross(arms, units)], axis=2)[..., columns]
        move = np.zeros((len(data), 6))
        move[:, columns] = (np.linalg.pinv(jacobian) @ (lengths - now)[..., None])[..., 0]
        c, rotation = c + move[:, :3], _turned(rotation, move[:, 3:])
    return c, rotation, np.abs(lengths - now).max(axis=1), np.linalg.det(jacobian)


def _turned(rotation: Real, turn: Real) -> Real:
    """Rotations after turns by vectors, by Rodrigues' formula."""
    angle = np.linalg.norm(turn, axis=1)[:, None, None]
    axis = np.divide(turn[:, :, None], angle, out=np.zeros((len(turn), 3, 1)), where=angle > 0)[..., 0]
    x, y, z = axis.T
    zero = np.zeros_like(x)
    cross = np.moveaxis(np.array([[zero, -z, y], [z, zero, -x], [-y, x, zero]]), 2, 0)
    return np.asarray((np.eye(3) + np.sin(angle) * cross + (1 - np.cos(angle)) * (cross @ cross)) @ rotation)


if __name__ == "__main__":
    main()
