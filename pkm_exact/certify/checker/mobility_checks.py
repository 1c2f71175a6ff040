"""The checks of a mobility certificate, ``docs/certificates-mobility.md``: every matrix is computed from the joints."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Sequence

from flint import fmpq

from pkm_exact.certify.checker.mobility_bounds import check_second_order
from pkm_exact.certify.checker.mobility_document import MobilityDocument, Sets
from pkm_exact.certify.checker.mobility_groups import check_legs, group_dimensions
from pkm_exact.certify.checker.mobility_machine import Machine, Rows, proved, rank_of, times
from pkm_exact.certify.checker.verdict import rejected


def check_mobility(document: MobilityDocument) -> Iterator[str]:
    """One line per claim."""
    machine = Machine(document)
    size, freedoms = len(machine.matrix), document.freedoms
    motions = proved(document.proofs["loops"], machine.matrix, freedoms, "loops")
    rank = freedoms - len(motions)
    yield f"loops: rank {rank} of {size} equations in {freedoms} freedoms, mobility {len(motions)}"
    twists = times(machine.platform, motions)
    platform = len(motions) - len(proved(document.proofs["platform"], twists, len(motions), "platform"))
    yield f"platform: {platform} freedoms"
    units = [[fmpq(int(k == place)) for k in range(freedoms)] for place in document.actuated]
    left = proved(document.proofs["locked_loops"], machine.matrix + units, freedoms, "locked_loops")
    held = times(machine.platform, left)
    still = len(left) - len(proved(document.proofs["locked_platform"], held, len(left), "locked_platform"))
    yield f"actuators: {len(document.actuated)} locked leave mobility {len(left)}, of the platform {still}"
    expected = {
        "free": len(motions),
        "platform": platform,
        "gruebler_kutzbach": 6 * (document.bodies - 1 - len(document.joints)) + freedoms,
        "overconstraint": size - rank,
        "locked": len(left),
        "locked_platform": still,
    }
    for key, value in expected.items():
        if document.counts[key] != value:
            raise rejected(f"mobility.{key}: not the number that follows")
    yield f"mobility: {len(motions)}, by the formula of Gruebler and Kutzbach {expected['gruebler_kutzbach']}"
    speeds = [[motion[k] for motion in motions] for k in range(freedoms)]
    every = [[fmpq(int(i == j)) for j in range(len(motions))] for i in range(len(motions))]
    yield _check_sets("platform", document.sets["platform"], document.among, speeds, twists)
    yield _check_sets("mechanism", document.sets["mechanism"], document.among, speeds, every)
    yield _check_finite(document, machine, rank, motions)


def _check_sets(name: str, sets: Sets, among: Sequence[int], speeds: Rows, wanted: Rows) -> str:
    wanted = [row for row in wanted if any(row)]
    where = f"actuator_sets.{name}"

    def holds(chosen: Sequence[int]) -> bool:
        rows = [speeds[place] for place in chosen]
        return rank_of(rows + wanted) == rank_of(rows)

    for chosen in sets.sets:
        if not holds(chosen):
            raise rejected(f"{where}: a set that does not hold it")
        if any(holds([place for place in chosen if place != left]) for left in chosen):
            raise rejected(f"{where}: a set that is not minimal")
    number = len(sets.sets)
    if not sets.complete:
        return f"{name} sets: {number} minimal sets hold it, there may be others"
    if set(_all_minimal(among, speeds, holds)) != set(sets.sets):
        raise rejected(f"{where}: not all minimal sets")
    return f"{name} sets: {number} minimal sets hold it, there is no other among {len(among)} freedoms"


def _all_minimal(
    among: Sequence[int], speeds: Rows, holds: Callable[[Sequence[int]], bool]
) -> Iterator[tuple[int, ...]]:
    """All minimal sets, by levels of independent sets that do not hold."""
    level: list[tuple[int, ...]] = [()]
    if holds(()):
        yield ()
        return
    while level:
        larger = []
        for chosen in level:
            for place in among:
                if (chosen and place <= chosen[-1]) or not any(speeds[place]):
                    continue
                new = (*chosen, place)
                if rank_of([speeds[k] for k in new]) < len(new):
                    continue
                if not holds(new):
                    larger.append(new)
                elif not any(holds([k for k in new if k != left]) for left in new):
                    yield new
        level = larger


# Finite mobility


def _check_finite(document: MobilityDocument, machine: Machine, rank: int, motions: Rows) -> str:
    if document.second_order is not None:
        return check_second_order(document, document.second_order, machine, motions)
    if document.argument is None:
        return "finite: nothing is claimed"
    if document.argument == "regular":
        if group_dimensions(machine) != rank:
            raise rejected("finite: the loops are not regular")
    else:
        check_legs(document, document.legs, machine)
    return f"finite: mobility {len(motions)} near the configuration, by the argument {document.argument}"
