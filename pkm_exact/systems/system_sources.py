"""A polynomial system from what users have: texts, a file in msolve's format, polynomials of python-flint or SymPy."""

from __future__ import annotations

import os
import re
from collections.abc import Iterable, Sequence
from math import lcm
from pathlib import Path
from typing import Any

from flint import fmpq, fmpq_mpoly, fmpz_mpoly

from pkm_exact.algebra.system import PolynomialSystem, polynomial_ring
from pkm_exact.errors import InputError
from pkm_exact.systems.input_limits import INPUT_LIMITS, InputLimits
from pkm_exact.systems.polynomial_grammar import NAME, names_in, parsed, rational_ring
from pkm_exact.wording import printable, shown


def polynomial_system(
    polynomials: Iterable[Any], variables: Sequence[Any] | None = None, limits: InputLimits = INPUT_LIMITS
) -> PolynomialSystem:
    """The system that these polynomials are, with integer coefficients.

    Parameters
    ----------
    polynomials : iterable
        Texts (``polynomial_grammar``), polynomials of python-flint over Z or Q, or SymPy expressions or equations.
    variables : sequence of str or of SymPy symbols, optional
        In this order; by default those that appear, texts in the order of their first appearance, symbols by name.
    limits : InputLimits

    Raises
    ------
    InputError
        If one of them is no polynomial with rational coefficients, or a limit is exceeded.

    Examples
    --------
    >>> polynomial_system(["x^2/2 + y = 1", "x*y"]).polynomials
    (x^2 + 2*y - 2, x*y)
    """
    if isinstance(polynomials, str):
        raise InputError("polynomials: a single text; give a list of them")
    given = list(polynomials)
    if not given:
        raise InputError("polynomials: an empty list; give at least one")
    _require(
        len(given) <= limits.polynomials,
        "polynomials",
        f"{len(given)} given, at most {limits.polynomials} are possible",
    )
    names = _names(given, variables)
    _check_names(names, limits)
    read = [_read(value, names, f"polynomial {number}", limits) for number, value in enumerate(given, 1)]
    return _cleared(read, names, limits)


def read_system(path: str | os.PathLike[str], limits: InputLimits = INPUT_LIMITS) -> PolynomialSystem:
    """The system in a file in msolve's format: a line of variables, the line 0, polynomials with commas between them.

    Raises
    ------
    InputError
        If the file cannot be read, or has no such system.
    """
    name = printable(os.fsdecode(path))
    try:
        with Path(path).open("rb") as stream:
            data = stream.read(limits.file_bytes + 1)
    except (OSError, ValueError) as error:
        reason = error.strerror if isinstance(error, OSError) else str(error)
        raise InputError(f"{name}: cannot be read ({reason}); give the path of a file with a system") from None
    if len(data) > limits.file_bytes:
        raise InputError(f"{name}: more than {limits.file_bytes} bytes; give a smaller system")
    try:
        return parse_system(data.decode("ascii"), limits)
    except UnicodeDecodeError:
        raise InputError(f"{name}: is not ASCII; write names and numbers with plain letters and digits") from None
    except InputError as error:
        raise InputError(f"{name}: {error}") from None


def parse_system(text: str, limits: InputLimits = INPUT_LIMITS) -> PolynomialSystem:
    r"""The system that a text in msolve's format denotes.

    Examples
    --------
    >>> parse_system("x,y\n0\nx^2+y^2-1,\nx-y\n").polynomials
    (x^2 + y^2 - 1, x - y)
    """
    lines = [line for line in text.splitlines() if line.strip()]
    if text.lstrip().startswith("{"):
        raise InputError("is JSON, as certificates are; use check for it, and give a file with a system here")
    if len(lines) < 3:
        raise InputError("has fewer than three lines; write variables, 0, and polynomials with commas between them")
    names = [name.strip() for name in lines[0].split(",")]
    characteristic = lines[1].strip()
    _require(
        bool(re.fullmatch(r"0+", characteristic)),
        "line 2",
        f"the characteristic is {shown(characteristic)}; only systems over the rational numbers, 0, can be solved",
    )
    written = "\n".join(lines[2:]).split(",")
    if not written[-1].strip():
        written.pop()
    return polynomial_system(written, names, limits)


def _names(given: Sequence[Any], variables: Sequence[Any] | None) -> list[str]:
    if variables is not None:
        if isinstance(variables, str):
            raise InputError('variables: a single text; give a list such as ["x", "y"]')
        return [str(name) for name in variables]
    names: dict[str, None] = {}
    for number, value in enumerate(given, 1):
        names.update(dict.fromkeys(_names_of(value, f"polynomial {number}")))
    return list(names)


def _names_of(value: Any, where: str) -> list[str]:
    if isinstance(value, str):
        return names_in(value, where)
    if isinstance(value, fmpq_mpoly | fmpz_mpoly):
        return [str(name) for name in value.context().names()]
    symbols = getattr(value, "free_symbols", None)
    return sorted(map(str, symbols)) if symbols is not None else []


def _check_names(names: Sequence[str], limits: InputLimits) -> None:
    _require(bool(names), "variables", "there is none; give at least one")
    _require(
        len(names) <= limits.variables, "variables", f"{len(names)} given, at most {limits.variables} are possible"
    )
    for number, name in enumerate(names, 1):
        _require(
            bool(NAME.fullmatch(name)),
            f"variable {number}",
            f"{shown(name)} is not a name; use a letter or _, then up to 31 letters, digits or _",
        )
    twice = next((name for name in names if list(names).count(name) > 1), None)
    _require(twice is None, "variables", f"{shown(twice)} occurs twice; name each once")


def _read(value: Any, names: Sequence[str], where: str, limits: InputLimits) -> fmpq_mpoly:
    if isinstance(value, str):
        return parsed(value, names, where, limits)
    if isinstance(value, fmpq_mpoly | fmpz_mpoly):
        return _from_flint(value, names, where)
    if isinstance(value, int) and not isinstance(value, bool):
        return rational_ring(names).constant(value)
    if hasattr(value, "free_symbols"):
        return _from_sympy(value, names, where)
    raise InputError(f"{where}: {shown(value)} is no polynomial; give a text, or one of python-flint or SymPy")


def _from_flint(value: fmpq_mpoly | fmpz_mpoly, names: Sequence[str], where: str) -> fmpq_mpoly:
    own = [str(name) for name in value.context().names()]
    ring = rational_ring(names)
    terms = {}
    for exponents, coefficient in value.to_dict().items():
        powers = {name: int(exponent) for name, exponent in zip(own, exponents, strict=True) if exponent}
        foreign = next((name for name in powers if name not in names), None)
        _require(foreign is None, where, f"{shown(foreign)} is not among the variables; name it there")
        terms[tuple(powers.get(name, 0) for name in names)] = fmpq(coefficient)
    return ring.from_dict(terms)


def _from_sympy(value: Any, names: Sequence[str], where: str) -> fmpq_mpoly:
    from sympy import Equality, Poly, PolynomialError, Symbol  # type: ignore[import-untyped]

    expression = value.lhs - value.rhs if isinstance(value, Equality) else value
    symbols = {str(symbol): symbol for symbol in expression.free_symbols}
    foreign = next((name for name in sorted(symbols) if name not in names), None)
    _require(foreign is None, where, f"{shown(foreign)} is not among the variables; name it there")
    try:
        terms = Poly(expression, *(symbols.get(name, Symbol(name)) for name in names)).terms()
    except PolynomialError:
        raise InputError(f"{where}: is no polynomial in the variables; clear denominators and roots") from None
    found = {}
    for exponents, coefficient in terms:
        _require(
            bool(coefficient.is_Rational),
            where,
            f"the coefficient {shown(coefficient)} is not an exact rational number; write it as Rational",
        )
        found[tuple(map(int, exponents))] = fmpq(int(coefficient.p), int(coefficient.q))
    return rational_ring(names).from_dict(found)


def _cleared(read: Sequence[fmpq_mpoly], names: Sequence[str], limits: InputLimits) -> PolynomialSystem:
    """The polynomials with integer coefficients, those that are 0 left out."""
    ring = polynomial_ring(names)
    found = []
    number = 0
    for place, polynomial in enumerate(read, 1):
        terms = {tuple(map(int, key)): fmpq(value) for key, value in polynomial.to_dict().items()}
        if not terms:
            continue
        where = f"polynomial {place}"
        degree = max(map(sum, terms))
        _require(degree <= limits.degree, where, f"degree {degree}; at most {limits.degree} is possible")
        number += len(terms)
        _require(number <= limits.terms, where, f"more than {limits.terms} terms in all; give a smaller system")
        denominator = lcm(*(int(value.q) for value in terms.values()))
        integers = {key: int(value * denominator) for key, value in terms.items()}
        longest = max(abs(value) for value in integers.values())
        _require(
            longest < 10**limits.digits,
            where,
            f"a coefficient of more than {limits.digits} digits over the common denominator; use shorter numbers",
        )
        found.append(ring.from_dict(integers))
    _require(bool(found), "polynomials", "all are 0, and every point is a solution; give one that is not")
    return PolynomialSystem(tuple(names), tuple(found))


def _require(condition: bool, where: str, sentence: str) -> None:
    if not condition:
        raise InputError(f"{where}: {sentence}")
