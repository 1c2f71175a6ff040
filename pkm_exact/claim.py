"""What a solution claims, and by which route completeness was proved."""

from __future__ import annotations

from enum import StrEnum


class Claim(StrEnum):
    """What is claimed of a list of poses.

    ``COMPLETE`` is a theorem about the very input; every other member promises less. In particular
    ``NOT_PROVEN_COMPLETE`` does not mean that a pose is missing, and ``POSITIVE_DIMENSIONAL_DETECTED`` is
    evidence from several primes, not a proof.

    Examples
    --------
    >>> Claim("complete") is Claim.COMPLETE, str(Claim.NOT_PROVEN_COMPLETE)
    (True, 'not-proven-complete')
    """

    COMPLETE = "complete"
    NOT_PROVEN_COMPLETE = "not-proven-complete"
    POSITIVE_DIMENSIONAL_DETECTED = "positive-dimensional-detected"
    POSITIVE_DIMENSIONAL_PROVED = "positive-dimensional-proved"
    INCONSISTENT = "inconsistent"


class RealMotion(StrEnum):
    """What is proved of real motions, where the complex poses form a set of positive dimension.

    ``PROVED``: a real pose is certified through which a curve of real poses leads; the robot moves with its legs
    locked. ``NO_REAL_POSE``: it is proved that none of the poses is real. ``OPEN``: neither is proved.
    """

    PROVED = "proved"
    NO_REAL_POSE = "no-real-pose"
    OPEN = "open"


class CompletenessRoute(StrEnum):
    """The argument that proves a list of poses complete.

    ``REFINED_BEZOUT``: the variety of rigid motions has degree 40 in P^16, so the irreducible components of
    its section by six hyperplanes have degrees that sum to at most 40 (Fulton, Intersection Theory, 12.3);
    40 distinct isolated solutions leave room for no other.

    ``PRODUCT_BOUND``: the constraints have low degrees on a variety of low degree, and as many isolated solutions as
    the theorem of Bezout then admits are listed.

    ``MODULAR_RANK``: ranks of integer matrices modulo a prime, which are no greater than over Q, leave room for as many
    solutions as are listed, with their multiplicities.

    ``COUNTING_AT_INFINITY``: the constraints and the variety of rigid motions meet in finitely many points, and the
    multiplicities of the solutions and of the points at infinity sum to the degree.

    ``EXACT_ELIMINATION``: an elimination over Q shows that the ideal of the poses contains polynomials whose leading
    monomials leave only as many others as there are distinct solutions listed (or as many, counted with the
    multiplicities that the trace form over Q shows); there cannot be more.

    Examples
    --------
    >>> from pkm_exact import Robot
    >>> str(Robot.load("models/3-rpr-merlet-p.toml").solve().completeness_route)
    'exact-elimination'
    """

    REFINED_BEZOUT = "refined-bezout"
    PRODUCT_BOUND = "product-bound"
    MODULAR_RANK = "modular-rank"
    COUNTING_AT_INFINITY = "counting-at-infinity"
    EXACT_ELIMINATION = "exact-elimination"
