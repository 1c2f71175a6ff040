"""Ranks of the matrices of a machine at a pose: of all wrenches, of J_x, of J_q."""

from __future__ import annotations

from flint import arb_mat

from pkm_exact.precision import working_precision
from pkm_exact.statics.ball_rows import BITS
from pkm_exact.statics.entangled_rows import ball_rates, exact_rates
from pkm_exact.statics.pose_rows import PoseRows
from pkm_exact.statics.ranks import proved_rank, rationalised, root_sum_rank


def matrix_ranks(at: PoseRows) -> dict[str, int | None]:
    """The ranks of the wrenches, of J_x and of J_q by their names; exact, None where a box does not decide them.

    J has the rank of J_x where there is J.

    Examples
    --------
    >>> from pkm_exact import read_robot
    >>> robot = read_robot("models/carriage-hexapod.toml")
    >>> matrix_ranks(robot.at({"position": ["3/2", 7, 9], "quaternion": [1, 0, 0, 0]}, configuration="home"))
    {'wrenches': 6, 'J_x': 6, 'J_q': 6}
    """
    driven, count = at.held.driven, len(at.actuated)
    found: dict[str, int | None] = {"wrenches": at.rank}
    if not driven:
        return found
    if at.exact_rows is not None:
        rows = [at.exact_rows[index].wrench for index in driven]
        rational = [rationalised(row) for row in rows]
        exact = [row for row in rational if row is not None]
        found["J_x"] = root_sum_rank(exact if len(exact) == len(rows) else rows)
        found["J_q"] = root_sum_rank(exact_rates(at.exact_rows, driven, count))
        return found
    with working_precision(BITS):
        wrenches = arb_mat([list(at.ball_rows[index].wrench) for index in driven])
        rates = arb_mat(ball_rates(at.ball_rows, driven, count))
        for name, matrix in (("J_x", wrenches), ("J_q", rates)):
            rank = proved_rank(matrix)
            found[name] = rank if rank == min(matrix.nrows(), matrix.ncols()) else None
    return found
