"""The figures of one formulation on one robot.

Solutions of a formulation's equations that are no poses are counted as follows. The complex ones: the equations are
split into branches (the signs of the mirrored joints of AFP4; a single branch otherwise), and the dimensions of the
branches' quotient algebras, modulo a prime and before any filter, are added up. The real ones are not solved for
again. Over a real pose all solutions of the formulation are real (two triples of angles, two signs of a unit
quaternion), and none over a pose that is not real, for the pose is a real polynomial in them; so there are as many as
the fibre has, times the number of real poses. The other solutions, those with det R = -1 in AFD3 and those with joints
on the wrong side in AFP4, are in the same way the poses of robots with mirrored joints (``mirrors`` of the formulated
problem). These robots are solved exactly, as SE3, and their real poses are counted.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from time import perf_counter, process_time

from flint import fmpz

from pkm_exact.algebra.modular_elimination import Elimination
from pkm_exact.algebra.system import PolynomialSystem
from pkm_exact.claim_wording import INFINITE
from pkm_exact.comparison.row import ResultFigures, SystemFigures
from pkm_exact.engine import solve
from pkm_exact.export.polynomial_text import polynomial_text
from pkm_exact.formulations.base import FormulatedProblem
from pkm_exact.formulations.registry import formulation_for
from pkm_exact.geometry.problem import ForwardProblem
from pkm_exact.policy import Policy
from pkm_exact.poses.pose import Pose
from pkm_exact.poses.pose_representation import PoseRepresentation
from pkm_exact.solution import Solution


def measure(
    problem: ForwardProblem,
    code: str,
    *,
    written: Callable[[SystemFigures], None],
    progress: Callable[[str], None],
) -> tuple[ResultFigures, tuple[Pose, ...]]:
    """The figures of a formulation and its real poses.

    Parameters
    ----------
    problem : ForwardProblem
    code : str
        Code of the formulation.
    written : callable
        Gets the size of the system as soon as there is one.
    progress : callable
        Gets one line when a stage starts.

    Raises
    ------
    InputError
        If the formulation does not apply to the robot.
    PkmExactError
        If there is no answer.
    """
    formulated = formulation_for(code, problem).formulate(problem)
    written(system_figures(formulated.system))
    start, processor_start = perf_counter(), process_time()
    # Formulations are compared by their bases.
    solution = solve(problem, formulation=code, policy=Policy(eliminate=True), progress=progress)
    solved, processor_solved = perf_counter(), process_time()
    progress("solutions that are no poses")
    complex_solutions = _complex_solutions(formulated, solution)
    real_solutions = _real_solutions(formulated, solution)
    size, bits = (None, None) if solution.representation is None else _size(solution.representation)
    figures = ResultFigures(
        basis_elements=solution.statistics.basis_size,
        rur_bytes=size,
        rur_bits=bits,
        primes=len(solution.statistics.primes),
        complex_solutions=complex_solutions,
        real_solutions=real_solutions,
        real_poses=_real_poses(solution),
        claim=solution.claim,
        seconds=solved - start,
        processor_seconds=processor_solved - processor_start,
        stages=solution.statistics.seconds,
        counting_seconds=perf_counter() - solved,
        notes=solution.notes,
    )
    return figures, solution.poses


def system_figures(system: PolynomialSystem) -> SystemFigures:
    """The size of a polynomial system.

    Examples
    --------
    >>> from pkm_exact.algebra.system import polynomial_ring
    >>> x, y = polynomial_ring(("x", "y")).gens()
    >>> system_figures(PolynomialSystem(("x", "y"), (x**2 - 12 * x * y, x - 1)))
    SystemFigures(unknowns=2, equations=2, degrees=(2, 1), terms=4, bytes=15, coefficient_digits=2)
    """
    polynomials = system.polynomials
    return SystemFigures(
        unknowns=len(system.unknowns),
        equations=len(polynomials),
        degrees=tuple(int(polynomial.total_degree()) for polynomial in polynomials),
        terms=sum(len(polynomial) for polynomial in polynomials),
        bytes=sum(len(polynomial_text(system.unknowns, polynomial)) + 1 for polynomial in polynomials),
        coefficient_digits=max(
            (len(str(abs(value))) for polynomial in polynomials for value in polynomial.coeffs()), default=0
        ),
    )


def _complex_solutions(formulated: FormulatedProblem, solution: Solution) -> int | None:
    total = solution.statistics.quotient_dimension
    for branch in formulated.branches[1:]:
        dimension = Elimination(branch, Policy()).image().dimension
        if total is None or dimension is None:
            return None
        total += dimension
    return None if total is None else formulated.multiplicity * total


def _real_solutions(formulated: FormulatedProblem, solution: Solution) -> int | None:
    poses = _real_poses(solution)
    for mirror in formulated.mirrors:
        others = None if poses is None else _real_poses(solve(mirror))
        if poses is None or others is None:
            return None
        poses += others
    return None if poses is None else formulated.fibre * poses


def _real_poses(solution: Solution) -> int | None:
    return None if solution.claim in INFINITE else len(solution.poses)


def _size(representation: PoseRepresentation) -> tuple[int, int]:
    """Length of the coefficients as decimal text, a separator after each, and bits of the largest."""
    parts: Sequence[Sequence[int]] = (representation.eliminant, *representation.univariate.numerators)
    values = [fmpz(value) for part in parts for value in part]
    return sum(len(str(value)) + 1 for value in values), max(abs(int(value)).bit_length() for value in values)
