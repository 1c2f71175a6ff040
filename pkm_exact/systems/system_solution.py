"""What is found of a polynomial system, and what is proved about it: data only."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass, field
from typing import Any

from pkm_exact.algebra.representation import UnivariateRepresentation
from pkm_exact.algebra.system import PolynomialSystem
from pkm_exact.claim import Claim
from pkm_exact.roots.interval import Interval
from pkm_exact.systems.mixed_volume import Subdivision
from pkm_exact.systems.system_claims import SystemRoute, meaning_of
from pkm_exact.wording import counted

Steps = tuple[tuple[tuple[int, tuple[int, ...]], ...], ...]
"""Steps of an elimination: products, each an element's index and the exponents of what multiplies it."""


@dataclass(frozen=True)
class InfinitePoints:
    """The points (0 : z) at infinity, z_i = n_i(t) / h'(t) with w.z = 1, and the sum of their weights."""

    chart: tuple[int, ...]
    univariate: UnivariateRepresentation
    multiplicity: int


@dataclass(frozen=True)
class ListProof:
    """Why a list of solutions is complete, or empty.

    Attributes
    ----------
    route : SystemRoute
    total : int
        Number of complex solutions with multiplicity.
    multiplicities : tuple of (tuple of int, int)
        If some are multiple: factors of the eliminant, by their coefficients, with the multiplicity of the solutions
        at their roots.
    groups : tuple of tuple of int
        For multihomogeneous Bezout numbers: groups of variables, by their numbers.
    elimination : Steps
        For exact elimination.
    infinity : InfinitePoints or None
        For counting at infinity.
    subdivision : Subdivision or None
        For mixed volumes.
    """

    route: SystemRoute
    total: int
    multiplicities: tuple[tuple[tuple[int, ...], int], ...] = ()
    groups: tuple[tuple[int, ...], ...] = ()
    elimination: Steps = ()
    infinity: InfinitePoints | None = None
    subdivision: Subdivision | None = None


@dataclass(frozen=True)
class Slice:
    """Solutions at which the last of some forms has a constant as value."""

    constant: int
    representation: UnivariateRepresentation


@dataclass(frozen=True)
class Witness:
    """Why there are infinitely many complex solutions.

    Attributes
    ----------
    cause : {"fewer-polynomials", "more-solutions-than-bound"}
    representation : UnivariateRepresentation or None
        Some solutions, of a system with fewer polynomials than unknowns.
    forms : tuple of tuple of int
        Linear forms, coefficients and then the constant.
    slices : tuple of Slice
        More solutions than there can be isolated ones.
    """

    cause: str
    representation: UnivariateRepresentation | None = None
    forms: tuple[tuple[int, ...], ...] = ()
    slices: tuple[Slice, ...] = ()


@dataclass(frozen=True)
class RealSolution:
    """A real solution in a box.

    Attributes
    ----------
    parameter : Interval
        Isolates the root of the eliminant.
    values : tuple of Interval
        One for each variable.
    multiplicity : int or None
        None where it is not proved.
    """

    parameter: Interval
    values: tuple[Interval, ...]
    multiplicity: int | None


@dataclass(frozen=True, repr=False)
class SystemSolution:
    """The solutions of a polynomial system, as far as they are proved.

    It can be iterated, and its ``len`` is the number of real solutions.

    Attributes
    ----------
    system : PolynomialSystem
    claim : Claim
        What is proved about the list.
    proof : ListProof or None
        The proof, if the claim is "complete" or "inconsistent".
    representation : UnivariateRepresentation or None
        Of all complex solutions listed, each verified over Q.
    box_exponent : int
        Boxes lie on the grid of spacing 2^-box_exponent.
    solutions : tuple of RealSolution
        By their boxes from left to right.
    notes : tuple of str
    witness : Witness or None
        The proof, if the claim is that the solutions are infinitely many.
    seconds : dict of str to float
        Time of each stage.

    Examples
    --------
    >>> from pkm_exact import solve_system
    >>> found = solve_system(["x^2 + y^2 = 5", "x*y = 2"])
    >>> str(found.claim), len(found)
    ('complete', 4)
    """

    system: PolynomialSystem
    claim: Claim
    proof: ListProof | None = None
    representation: UnivariateRepresentation | None = None
    box_exponent: int = 0
    solutions: tuple[RealSolution, ...] = ()
    notes: tuple[str, ...] = ()
    witness: Witness | None = None
    seconds: dict[str, float] = field(default_factory=dict, compare=False)

    @property
    def variables(self) -> tuple[str, ...]:
        """Names of the unknowns."""
        return self.system.unknowns

    @property
    def completeness_route(self) -> SystemRoute | None:
        """The argument of the proof, if there is one."""
        return None if self.proof is None else self.proof.route

    @property
    def is_complete(self) -> bool:
        """Whether it is proved that no solution is missing (or that there is none)."""
        return self.claim in (Claim.COMPLETE, Claim.INCONSISTENT)

    @property
    def complex_solutions(self) -> int | None:
        """Number of complex solutions with multiplicity; None where it is not proved."""
        return None if self.proof is None else self.proof.total

    @property
    def distinct_solutions(self) -> int:
        """Number of distinct complex solutions that are listed."""
        return 0 if self.representation is None else self.representation.degree

    @property
    def real_solutions(self) -> int:
        """Number of real solutions listed."""
        return len(self.solutions)

    def to_dict(self) -> dict[str, Any]:
        """What the command line prints as JSON: exact bounds as texts."""
        return {
            "claim": str(self.claim),
            "completeness_route": None if self.proof is None else str(self.proof.route),
            "complex_solutions": self.complex_solutions,
            "distinct_solutions": self.distinct_solutions,
            "real_solutions": self.real_solutions,
            "solutions": [
                {
                    "values": {
                        name: [str(value.lo), str(value.hi)]
                        for name, value in zip(self.variables, solution.values, strict=True)
                    },
                    "multiplicity": solution.multiplicity,
                }
                for solution in self.solutions
            ],
            "variables": list(self.variables),
            "notes": list(self.notes),
        }

    def __len__(self) -> int:
        return len(self.solutions)

    def __bool__(self) -> bool:
        return True

    def __iter__(self) -> Iterator[RealSolution]:
        return iter(self.solutions)

    def __str__(self) -> str:
        if self.representation is None:
            return meaning_of(self.claim)
        number = self.distinct_solutions if self.complex_solutions is None else self.complex_solutions
        return f"{counted(number, 'complex solution')}, {self.real_solutions} real; {meaning_of(self.claim)}"

    def __repr__(self) -> str:
        return f"<SystemSolution: {self.claim}, {self.real_solutions} real>"
