"""Every limit, precision and random choice of a solve, in one frozen object that is passed down."""

from __future__ import annotations

from dataclasses import dataclass
from fractions import Fraction
from typing import Final

from pkm_exact.digests import Data, digest

SMALLEST_WIDTH: Final = Fraction(1, 2**4096)
"""Boxes narrower than this are refused: they would take for ever."""


@dataclass(frozen=True)
class Policy:
    """Limits and choices of the exact engine. The defaults suit robots; nothing here decides a zero test.

    Attributes
    ----------
    prime_bits : int
        Size of the primes; 62 bits is the largest that FLINT's word arithmetic takes at full speed.
    seed : int
        Seed of every random choice (primes, separating forms, combinations of equations). Where a choice may fail,
        the data are joined to it (``seed_for``).
    lifting : {"numeric", "newton", "multimodular"}
        How a representation modulo a prime becomes one over Q. "newton" lifts p-adically and needs simple
        solutions; "multimodular" repeats the elimination at many primes. "numeric" asks real and complex solutions
        first, where doubles lead to all of them, and lifts otherwise. All of them give the same, verified exactly.
    attempts : int
        Primes, forms or charts tried after a failed choice before the engine gives up.
    lifting_bits : int
        Largest precision of a lift, in bits of the modulus.
    degree_limit : int
        Largest degree of a critical pair before the elimination is declared out of reach.
    dimension_limit : int
        Largest dimension of a quotient algebra.
    short_proofs : bool
        Whether short ways to completeness are tried on hexapods before an elimination, and slices where the poses of
        robots with legs only seem to be infinitely many. Their certificates are of version 2.
    eliminate : bool
        Whether poses are counted by an elimination modulo a prime even where doubles lead to as many as there can be,
        which is proof enough. The same is found and proved.

    Examples
    --------
    >>> from pkm_exact import Robot
    >>> len(Robot.load("models/3-rpr-merlet-p.toml").solve(policy=Policy(seed=7)))
    2
    """

    prime_bits: int = 62
    seed: int = 20081125
    lifting: str = "numeric"
    attempts: int = 12
    lifting_bits: int = 1 << 17
    degree_limit: int = 40
    dimension_limit: int = 2000
    short_proofs: bool = True
    eliminate: bool = False

    def seed_for(self, *data: Data) -> int:
        """The seed of a choice about these data: the same for the same data, and for others another.

        Examples
        --------
        >>> Policy().seed_for(1, "form") == Policy().seed_for(1, "form") != Policy().seed_for(2, "form")
        True
        """
        return digest(self.seed, *data)
