"""From a polynomial system to all its complex solutions over Q, verified: elimination, separating form, lifting.

Modulo a prime first. A choice that turns out unlucky is made again, as often as the policy allows, at other primes. A
lift that takes long is doubted: then the next prime is asked whether it has as many solutions.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator
from dataclasses import dataclass, field
from functools import cached_property
from typing import Final

from pkm_exact.algebra.groebner import UnluckyPrimeError
from pkm_exact.algebra.lifting import lift_by_newton, lift_by_primes
from pkm_exact.algebra.modular_elimination import Elimination, ModularImage
from pkm_exact.algebra.representation import UnivariateRepresentation, union
from pkm_exact.algebra.rur import ModularRepresentation
from pkm_exact.algebra.system import PolynomialSystem
from pkm_exact.algebra.vanishing import satisfies
from pkm_exact.errors import InternalContradictionError
from pkm_exact.policy import Policy
from pkm_exact.stages import Amount, Stages
from pkm_exact.systems.mixed_equations import MixedEquations
from pkm_exact.systems.modular_solutions import SeparatedSolutions, most_values, represented, separated

FIRST_DOUBT: Final = 1 << 12
"""Bits of a lift at which another prime is asked; then at four times as many, and so on."""


@dataclass(frozen=True)
class FoundSolutions:
    """What a system looks like modulo a prime, and its solutions over Q.

    Attributes
    ----------
    dimension : int or None
        Number of solutions with multiplicity modulo the prime; None if they are infinitely many.
    representation : UnivariateRepresentation or None
        Verified. None if there are no solutions, or infinitely many.
    """

    dimension: int | None
    representation: UnivariateRepresentation | None


@dataclass
class SolutionSearch:
    """The search for the solutions of one system; called again, it begins again at other primes."""

    system: PolynomialSystem
    policy: Policy
    stages: Stages = field(default_factory=Stages)

    @cached_property
    def elimination(self) -> Elimination:
        """The eliminations modulo primes."""
        return Elimination(self.system, self.policy, watch=self.stages.amount)

    def image(self) -> ModularImage:
        """The system at the next prime; that it has none or infinitely many solutions is asked of a second one."""
        self.stages.enter("Groebner basis")
        image = self.elimination.image()
        if image.dimension:
            return image
        other = self.elimination.image()
        return other if other.dimension else image

    def found(self) -> FoundSolutions:
        """All solutions over Q.

        Raises
        ------
        OutOfReachError, ReconstructionError
            If a limit of the policy is met.
        InternalContradictionError
            If no representation passes verification.
        """
        for _ in range(self.policy.attempts):
            image = self.image()
            if not image.dimension or image.algebra is None:
                return FoundSolutions(image.dimension, None)
            self.stages.enter("separating form")
            chosen = separated(image.algebra, self.policy.seed_for(self.system.digest, image.prime))
            if chosen is None:
                continue
            try:
                return FoundSolutions(image.dimension, self.representation(image, chosen))
            except UnluckyPrimeError:
                continue
        raise InternalContradictionError(
            f"no representation of the solutions passed verification in {self.policy.attempts} attempts"
        )

    def representation(self, image: ModularImage, chosen: SeparatedSolutions) -> UnivariateRepresentation:
        """The verified representation over Q of which the one chosen is the image.

        Raises
        ------
        UnluckyPrimeError
            If the prime or the form was a bad choice.
        OutOfReachError, ReconstructionError
            If a limit of the policy is met.
        """
        equations = MixedEquations(self.system, self.policy.seed_for(self.system.digest, "combinations", image.prime))
        bits, lifted = self.policy.lifting_bits, []
        modular = chosen.modular
        for multiplicity, part in modular.parts().items():
            stage = "p-adic lifting" if multiplicity == 1 else "lifting by primes"
            self.stages.enter(stage)
            accept, watch = self._acceptance(stage), self._watch(chosen, stage)
            if multiplicity == 1:
                lifted.append(lift_by_newton(equations, chosen.form, part, bits, accept, watch))
            else:
                images = self._images(chosen, multiplicity)
                lifted.append(lift_by_primes(chosen.form, images, bits, accept, watch))
        whole = union(lifted)
        if len(lifted) > 1 and not is_verified(whole, self.system):
            raise UnluckyPrimeError("solutions of different multiplicities are not told apart")
        return whole

    def _images(self, chosen: SeparatedSolutions, multiplicity: int) -> Iterator[ModularRepresentation]:
        """The solutions of one multiplicity at further primes.

        Raises
        ------
        UnluckyPrimeError
            If too many primes have none.
        """
        misses = 0
        while misses <= self.policy.attempts:
            image = self.elimination.following()
            found = None
            if image.algebra is not None and image.dimension:
                found = represented(image.algebra, chosen.form).parts().get(multiplicity)
            if found is None:
                misses += 1
                continue
            misses = 0
            yield found
        raise UnluckyPrimeError(f"solutions of multiplicity {multiplicity} appear at the first prime only")

    def _acceptance(self, stage: str) -> Callable[[UnivariateRepresentation], bool]:
        def accept(lifted: UnivariateRepresentation) -> bool:
            self.stages.enter("verification")
            verified = is_verified(lifted, self.system)
            if not verified:
                self.stages.enter(stage)
            return verified

        return accept

    def _watch(self, chosen: SeparatedSolutions, stage: str) -> Callable[[int], None]:
        """Says how far a lift has come, and asks another prime where it is long."""
        doubtful = FIRST_DOUBT

        def watch(bits: int) -> None:
            nonlocal doubtful
            self.stages.amount(Amount(bits, None, "bits"))
            if bits > doubtful:
                doubtful *= 4
                self._require_agreement(chosen)
                self.stages.enter(stage)

        return watch

    def _require_agreement(self, chosen: SeparatedSolutions) -> None:
        """The next prime has as many distinct solutions.

        Raises
        ------
        UnluckyPrimeError
            If it has not: one of the two is unlucky.
        """
        self.stages.enter("Groebner basis")
        image = self.elimination.image()
        count = 0
        if image.algebra is not None and image.dimension:
            count = most_values(image.algebra, self.policy.seed_for(self.system.digest, image.prime))
        if count != chosen.modular.degree:
            raise UnluckyPrimeError("two primes have different solutions")


def is_verified(representation: UnivariateRepresentation, system: PolynomialSystem) -> bool:
    """Whether, exactly over Q, every root of h is a solution and distinct roots are distinct solutions.

    Examples
    --------
    >>> from pkm_exact.algebra.system import polynomial_ring
    >>> (x,) = polynomial_ring(("x",)).gens()
    >>> golden = UnivariateRepresentation((1,), (-1, -1, 1), ((2, 1),))
    >>> [is_verified(golden, PolynomialSystem(("x",), (f,))) for f in (x**2 - x - 1, x**2 - x - 2)]
    [True, False]
    """
    if representation.degree < 1 or any(len(n) > representation.degree for n in representation.numerators):
        return False
    if not (representation.is_squarefree and representation.is_separated):
        return False
    return satisfies(representation, system)
