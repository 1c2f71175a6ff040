"""From a mechanism with passive bodies to all its poses in boxes, by the solver of polynomial systems."""

from __future__ import annotations

from collections.abc import Callable
from fractions import Fraction
from typing import TYPE_CHECKING

from pkm_exact.links.link_equations import LinkEquations
from pkm_exact.links.link_poses import body_pose, unknowns_width
from pkm_exact.links.link_solution import EXACT, Assembly, LinkSolution
from pkm_exact.poses.boxes import DEFAULT_WIDTH
from pkm_exact.stages import Progress
from pkm_exact.systems.system_engine import solved_system

if TYPE_CHECKING:
    from pkm_exact.geometry.links import Links
    from pkm_exact.geometry.mechanism import LockedValues
    from pkm_exact.systems.system_solution import SystemSolution


def solve_links(
    links: Links,
    configuration: LockedValues | None = None,
    *,
    width: Fraction = DEFAULT_WIDTH,
    progress: Progress | None = None,
    solver: Callable[..., SystemSolution] = solved_system,
) -> LinkSolution:
    """All real poses of all bodies, and what is proved about their list.

    Parameters
    ----------
    links : Links
    configuration : LockedValues, optional
        Values of the actuators; by default those of the first configuration.
    width : Fraction
        Greatest width of a box, for each coordinate of position and rotation.
    progress : callable, optional
        Gets the name of each stage.
    solver : callable
        What solves the polynomial system, as ``systems.system_engine.solved_system``.

    Raises
    ------
    InputError
        If there is no configuration, or the system is too large.
    PkmExactError
        If a limit of the solver is met.

    Examples
    --------
    >>> from pkm_exact.geometry.reader import read_links
    >>> found = solve_links(read_links("models/links/four-bar.toml"))
    >>> print(found)
    2 complex solutions, 2 real poses; complete: it is proved that there is no other (counting-at-infinity)
    >>> print(found.platform_pose(found.assemblies[0]).position[0])
    1.800000000
    """
    chosen = configuration or links.configuration()
    equations = LinkEquations(links, links.locked(chosen))
    found = solver(equations.system(), width=unknowns_width(width, equations.metric), progress=progress)
    assemblies = []
    for solution in found.solutions:
        values = dict(zip(found.variables, solution.values, strict=True))
        poses = tuple(
            body_pose(body, values, solution.multiplicity, found.box_exponent, equations.metric)
            for body in equations.bodies
        )
        assemblies.append(Assembly(poses, solution.multiplicity))
    return LinkSolution(links, chosen, EXACT, found, tuple(assemblies), found.notes)
