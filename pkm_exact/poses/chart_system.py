"""The conditions on a pose as polynomials in the free Study coordinates of a chart, those of degree 4 included.

Legs and other linear forms are lifted by equations of their own (``poses.study_equations``), which know that they are
quadratic. Cylinders are not: with them the system is lifted as any system (``algebra.equations``).
"""

from __future__ import annotations

from flint import fmpz_mpoly

from pkm_exact.algebra.system import PolynomialSystem, polynomial_ring, primitive
from pkm_exact.geometry.problem import ForwardProblem
from pkm_exact.geometry.study import Quadric, evaluate, motion_quadrics, pose_quadrics, pose_quartics
from pkm_exact.poses.study_equations import Chart, dependent_coordinate, free_coordinates

_NAMES = ("e0", "e1", "e2", "e3", "f0", "f1", "f2", "f3")


def chart_system(problem: ForwardProblem, chart: Chart) -> PolynomialSystem:
    """The polynomials that vanish at the poses, in the free coordinates of the chart w.e = 1.

    Examples
    --------
    >>> from pkm_exact.motions.motion_groups import SPHERICAL
    >>> chart_system(ForwardProblem((), motion=SPHERICAL), (0, 0, 0, 1)).unknowns
    ('e0', 'e1', 'e2')
    """
    free, dependent = free_coordinates(chart, problem), dependent_coordinate(chart)
    names = tuple(_NAMES[k] for k in free)
    ring = polynomial_ring(names)
    x = [ring.constant(0)] * 8
    for k, unknown in zip(free, ring.gens(), strict=True):
        x[k] = unknown
    x[dependent] = ring.constant(1)
    for k in free:
        if k < 4:
            x[dependent] -= chart[k] * x[k]
    products = [[left * right for right in x] for left in x]

    def value(quadric: Quadric) -> fmpz_mpoly:
        found: fmpz_mpoly = evaluate(quadric, products) if quadric else ring.constant(0)
        return found

    norm = value(motion_quadrics(problem.metric)[-1])
    found = [value(quadric) for quadric in pose_quadrics(problem)]
    found += [quartic.value(value(quartic.linear), value(quartic.root), norm) for quartic in pose_quartics(problem)]
    return PolynomialSystem(names, tuple(primitive(polynomial) for polynomial in found if polynomial))
