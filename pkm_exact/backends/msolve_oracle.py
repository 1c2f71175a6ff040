"""msolve as an oracle: its parametrisation of the solutions, to be verified by who asked.

It writes w, w' and polynomials p_i with x_i = -p_i(t) / (c_i w'(t)) at the roots t of w, where t is the last unknown,
or a further one that is 0 together with a linear form of all (msolve's manual, section on output).
"""

from __future__ import annotations

from math import lcm
from pathlib import Path

from flint import fmpz, fmpz_poly

from pkm_exact.algebra.representation import UnivariateRepresentation, from_common_fractions
from pkm_exact.algebra.system import PolynomialSystem, polynomial_ring
from pkm_exact.backends.msolve_program import MsolveError, Tree, msolve_output, output_tree


def msolve_proposal(
    system: PolynomialSystem, *, seconds: float | None = None, program: Path | None = None
) -> UnivariateRepresentation | None:
    """The representation that msolve proposes; None if it says that there is no solution, or that there are
    infinitely many.

    Raises
    ------
    MsolveError
        If there is no answer, or it is not understood.
    """
    names = tuple(f"v{number}" for number in range(len(system.unknowns)))
    ring = polynomial_ring(names)
    renamed = PolynomialSystem(names, tuple(ring.from_dict(f.to_dict()) for f in system.polynomials))
    written = msolve_output(renamed, seconds=seconds, program=program, is_isolating=False)
    return parsed_proposal(written, names)


def parsed_proposal(text: str, names: tuple[str, ...]) -> UnivariateRepresentation | None:
    """The representation in msolve's output, coordinates in the order of ``names``.

    Examples
    --------
    >>> found = "[1, [[2, [-4, 0, 13]], [1, [0, 26]], [[[1, [-12, 0]], 1]]]]"
    >>> text = f"[0, [0, 2, 2, ['x', 'y'], [0, 1], {found}], [1, []]]:"
    >>> parsed_proposal(text, ("x", "y"))
    UnivariateRepresentation(form=(0, 1), eliminant=(-4, 0, 13), numerators=((12,), (8,)))
    """
    match output_tree(text):
        case ["-1"] | ["1", _, "-1", []]:
            return None
        case ["0", [_, _, _, list(listed), list(form), ["1", [eliminant, slope, list(numerators)]]], *_]:
            return _representation([str(name).strip("'") for name in listed], form, eliminant, slope, numerators, names)
        case _:
            raise MsolveError(f"msolve's parametrisation is not understood: {text[:80]!r}")


def _representation(
    listed: list[str],
    form: list[Tree],
    eliminant: Tree,
    slope: Tree,
    numerators: list[Tree],
    names: tuple[str, ...],
) -> UnivariateRepresentation:
    h = _polynomial(eliminant)
    if h.degree() < 1 or _polynomial(slope) != h.derivative() or len(numerators) != len(listed) - 1:
        raise MsolveError("msolve's parametrisation is not one by an eliminant and its derivative")
    weights = [_integer(value) for value in form]
    found: dict[str, tuple[fmpz_poly, int]] = {}
    for name, entry in zip(listed, numerators, strict=False):
        match entry:
            case [polynomial, str(divisor)]:
                found[name] = (-_polynomial(polynomial), _integer(divisor))
            case _:
                raise MsolveError("msolve's parametrisation has a coordinate that is not understood")
    if listed[-1] in names:
        found[listed[-1]] = (fmpz_poly([0, 1]) * h.derivative() - h.degree() * h, 1)
        separating = dict(zip(listed, weights, strict=True))
    else:
        if abs(weights[-1]) != 1:
            raise MsolveError("msolve's separating form is not one with integer coefficients")
        separating = {name: -weight * weights[-1] for name, weight in zip(listed, weights, strict=True)}
    if set(names) - set(found) or not all(divisor for _, divisor in found.values()):
        raise MsolveError("msolve's parametrisation lacks a coordinate")
    scale = lcm(*(found[name][1] for name in names))
    lists = [[int(value) * (scale // divisor) for value in p.coeffs()] for p, divisor in (found[n] for n in names)]
    sign = 1 if h.leading_coefficient() > 0 else -1
    return from_common_fractions(
        [separating[name] for name in names],
        [sign * int(value) for value in h.coeffs()],
        1,
        [[sign * value for value in numerator] for numerator in lists],
        scale,
    )


def _polynomial(entry: Tree) -> fmpz_poly:
    match entry:
        case [str(_), list(values)]:
            return fmpz_poly([_integer(value) for value in values])
        case _:
            raise MsolveError("msolve wrote something else where a polynomial was expected")


def _integer(value: Tree) -> int:
    try:
        return int(fmpz(str(value)))
    except ValueError:
        raise MsolveError("msolve wrote something else where an integer was expected") from None
