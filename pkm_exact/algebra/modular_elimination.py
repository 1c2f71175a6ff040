"""From a polynomial system to its quotient algebra modulo a prime, learned once and applied at further primes."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass, field

from pkm_exact.algebra import groebner
from pkm_exact.algebra.elimination_trace import Trace
from pkm_exact.algebra.primes import primes_from
from pkm_exact.algebra.quotient import QuotientAlgebra, quotient_algebra
from pkm_exact.algebra.system import PolynomialSystem
from pkm_exact.policy import Policy
from pkm_exact.stages import Watch


@dataclass(frozen=True)
class ModularImage:
    """What a system looks like modulo one prime.

    Attributes
    ----------
    prime : int
    basis : GroebnerBasis
    algebra : QuotientAlgebra or None
        None if the staircase is infinite.
    """

    prime: int
    basis: groebner.GroebnerBasis
    algebra: QuotientAlgebra | None

    @property
    def dimension(self) -> int | None:
        """Number of solutions with multiplicity modulo the prime, or None if it is infinite."""
        return None if self.algebra is None else self.algebra.dimension


@dataclass
class Elimination:
    """The modular eliminations of one system: deterministic, each prime used once. The primes follow from the system.

    Attributes
    ----------
    system : PolynomialSystem
    policy : Policy
    watch : callable, optional
        Gets how far the elimination at a prime has come.
    learned : dict
        By prime, the bases that were found from scratch. Another elimination of the same system may begin with them.
    """

    system: PolynomialSystem
    policy: Policy
    watch: Watch | None = field(default=None, repr=False, compare=False)
    _primes: Iterator[int] = field(init=False, repr=False)
    _digest: int = field(init=False, repr=False)
    _way: Trace | None = field(init=False, default=None, repr=False)
    primes_used: list[int] = field(init=False, default_factory=list)
    primes_unlucky: list[int] = field(init=False, default_factory=list)
    learned: dict[int, groebner.GroebnerBasis] = field(init=False, default_factory=dict, repr=False, compare=False)

    def __post_init__(self) -> None:
        self._digest = self.system.digest
        self._primes = primes_from(self.policy.seed_for(self._digest), self.policy.prime_bits)

    def knowing(self, other: Elimination) -> Elimination:
        """This elimination, which finds no basis again that another one has found of the same system."""
        if self._digest == other._digest and self.policy == other.policy:
            self.learned.update(other.learned)
        return self

    def image(self, *, record: bool = False) -> ModularImage:
        """The image at the next prime, found from scratch; with ``record`` the way to it is kept for ``following``.

        Raises
        ------
        OutOfReachError
            If a limit of the policy is met, or there is no further prime of its size.
        """
        prime = self._next_prime()
        basis = self._learned(prime, record=False)
        if record:
            self._way = basis.way()
        return self._finished(prime, basis)

    def trace(self) -> Trace | None:
        """The trace of an elimination at the next prime; None if the staircase is infinite there.

        Raises
        ------
        OutOfReachError
            As ``image``.
        """
        basis = self._learned(self._next_prime(), record=True)
        return basis.trace if basis.is_zero_dimensional else None

    def following(self) -> ModularImage:
        """The image at the next lucky prime, the way that was recorded; one that no prime follows is recorded anew.

        Raises
        ------
        OutOfReachError
            As ``image``.
        """
        for _ in range(self.policy.attempts):
            if self._way is None:
                break
            prime = self._next_prime()
            try:
                basis = groebner.apply(self._way, self.system.modulo(prime), self.system.monomials, prime)
            except groebner.UnluckyPrimeError:
                self.primes_unlucky.append(prime)
                continue
            return self._finished(prime, basis)
        return self.image(record=True)

    def _learned(self, prime: int, *, record: bool) -> groebner.GroebnerBasis:
        if prime not in self.learned:
            limit = self.policy.degree_limit
            system, ring = self.system.modulo(prime), self.system.monomials
            self.learned[prime] = groebner.learn(
                system, ring, prime, degree_limit=limit, record=False, watch=self.watch
            )
        return self.learned[prime].recorded() if record else self.learned[prime]

    def _next_prime(self) -> int:
        prime = next(self._primes, None)
        if prime is None:
            raise groebner.OutOfReachError(f"there is no further prime of {self.policy.prime_bits} bits")
        return prime

    def _finished(self, prime: int, basis: groebner.GroebnerBasis) -> ModularImage:
        self.primes_used.append(prime)
        finite = basis.is_zero_dimensional
        algebra = quotient_algebra(basis, self.policy.dimension_limit) if finite else None
        return ModularImage(prime, basis, algebra)
