r"""Polynomials as people and programs write them: a small grammar, parsed, never evaluated.

    equation   = sum [ "=" sum ]
    sum        = product { ("+" | "-") product }
    product    = signed { ("*" | "/") signed }          what is divided by is a number
    signed     = { "+" | "-" } power
    power      = atom [ ("^" | "**") digits ]
    atom       = number | name | "(" sum ")"

A number is 12, 12.5 or 1e-3, exactly what is written; a name is a letter or "_", then letters, digits or "_".
"""

from __future__ import annotations

import re
from collections.abc import Sequence
from fractions import Fraction
from math import log2
from typing import Final

from flint import Ordering, fmpq, fmpq_mpoly, fmpq_mpoly_ctx

from pkm_exact.errors import InputError
from pkm_exact.systems.input_limits import INPUT_LIMITS, InputLimits
from pkm_exact.wording import shown

NAME: Final = re.compile(r"[A-Za-z_][A-Za-z0-9_]{0,31}", re.ASCII)
_TOKEN: Final = re.compile(
    r"\s*(?:(?P<number>[0-9]+(?:\.[0-9]+)?(?:[eE][+-]?[0-9]+)?)|(?P<name>[A-Za-z_][A-Za-z0-9_]*)|(?P<sign>\*\*|[-+*/^()=]))",
    re.ASCII,
)
_END: Final = ""
_DIGIT_BITS: Final = log2(10)


def names_in(text: str, where: str = "polynomial") -> list[str]:
    """The names in a text, in the order in which they appear first.

    Examples
    --------
    >>> names_in("y*x^2 - 3*y")
    ['y', 'x']
    """
    return list(dict.fromkeys(token for kind, token in _tokens(text, where) if kind == "name"))


def parsed(
    text: str, variables: Sequence[str], where: str = "polynomial", limits: InputLimits = INPUT_LIMITS
) -> fmpq_mpoly:
    """The polynomial that a text denotes; of an equation, the difference of its sides.

    Parameters
    ----------
    text : str
    variables : sequence of str
    where : str
        Name of the text, for messages.
    limits : InputLimits

    Raises
    ------
    InputError
        If the text is not of the grammar, or exceeds a limit.

    Examples
    --------
    >>> parsed("3/2*x^2 - (x - y)*y = 1", ("x", "y"))
    3/2*x^2 - x*y + y^2 - 1
    """
    return _Parser(text, variables, where, limits).equation()


def rational_ring(variables: Sequence[str]) -> fmpq_mpoly_ctx:
    """The ring Q[variables], degree reverse lexicographic."""
    return fmpq_mpoly_ctx.get(tuple(variables), Ordering.degrevlex)


def _tokens(text: str, where: str) -> list[tuple[str, str]]:
    found, place = [], 0
    end = len(text.rstrip())
    while place < end:
        match = _TOKEN.match(text, place)
        if match is None or match.lastgroup is None:
            raise InputError(
                f"{where}: {shown(text[place:].strip())} cannot be read; use numbers, names and + - * / ^ ( ) ="
            )
        found.append((match.lastgroup, match[match.lastgroup]))
        place = match.end()
    return found


class _Parser:
    """One text; every method reads what it is named after."""

    def __init__(self, text: str, variables: Sequence[str], where: str, limits: InputLimits) -> None:
        self.where, self.limits = where, limits
        self.tokens = _tokens(text, where)
        self.place = 0
        self.depth = 0
        self.ring = rational_ring(variables)
        self.unknowns = dict(zip(variables, self.ring.gens(), strict=True))
        self.bits = int(limits.digits * _DIGIT_BITS)

    def equation(self) -> fmpq_mpoly:
        left = self._sum()
        if self._taken("="):
            left = left - self._sum()
        if self.place < len(self.tokens):
            raise self._wrong("an operator or the end")
        return left

    def _sum(self) -> fmpq_mpoly:
        total = self._product()
        while True:
            if self._taken("+"):
                total = total + self._product()
            elif self._taken("-"):
                total = total - self._product()
            else:
                return total
            self._require_size(len(total), 0, 0)

    def _product(self) -> fmpq_mpoly:
        total = self._signed()
        while True:
            if self._taken("*"):
                total = self._times(total, self._signed())
            elif self._taken("/"):
                total = self._times(total, self._inverse(self._signed()))
            else:
                return total

    def _signed(self) -> fmpq_mpoly:
        negative = False
        while self.place < len(self.tokens) and self.tokens[self.place][1] in "+-":
            negative ^= self.tokens[self.place][1] == "-"
            self.place += 1
        power = self._power()
        return -power if negative else power

    def _power(self) -> fmpq_mpoly:
        base = self._atom()
        if not (self._taken("^") or self._taken("**")):
            return base
        kind, token = self._next()
        if kind != "number" or not token.isdigit():
            raise InputError(f"{self.where}: {shown(token)} is not an exponent; write digits after ^")
        exponent = int(token) if len(token) < 6 else 10**6
        if exponent > self.limits.degree:
            written = token if len(token) <= 20 else f"{token[:20]}.."
            raise InputError(f"{self.where}: an exponent of {written}; at most {self.limits.degree} is possible")
        total = self.ring.constant(1)
        for _ in range(exponent):
            total = self._times(total, base)
        return total

    def _atom(self) -> fmpq_mpoly:
        kind, token = self._next()
        if kind == "number":
            return self.ring.constant(self._number(token))
        if kind == "name":
            if token not in self.unknowns:
                raise InputError(f"{self.where}: {shown(token)} is not among the variables; name it there")
            return self.unknowns[token]
        if token != "(":  # noqa: S105 - a token of a polynomial
            self.place -= bool(kind)
            raise self._wrong("a number, a name or a bracket")
        self.depth += 1
        if self.depth > self.limits.nesting:
            raise InputError(
                f"{self.where}: brackets are nested more than {self.limits.nesting} deep; write it with fewer"
            )
        inside = self._sum()
        self.depth -= 1
        if not self._taken(")"):
            raise self._wrong("a closing bracket")
        return inside

    def _number(self, token: str) -> fmpq:
        mantissa, _, exponent = token.lower().partition("e")
        too_long = len(mantissa) > self.limits.digits or len(exponent) > 5
        if too_long or abs(int(exponent or 0)) > self.limits.digits:
            raise InputError(f"{self.where}: {shown(token)} is too long; use at most {self.limits.digits} digits")
        value = Fraction(mantissa) * Fraction(10) ** int(exponent or 0)
        return fmpq(value.numerator, value.denominator)

    def _inverse(self, value: fmpq_mpoly) -> fmpq_mpoly:
        if not value.is_constant():
            raise InputError(f"{self.where}: something is divided by a variable; multiply the polynomial by it instead")
        if value.is_zero():
            raise InputError(f"{self.where}: something is divided by 0; divide by another number")
        return self.ring.constant(1 / value.leading_coefficient())

    def _times(self, left: fmpq_mpoly, right: fmpq_mpoly) -> fmpq_mpoly:
        if left.is_zero() or right.is_zero():
            return self.ring.constant(0)
        bits = sum(max(int(value.height_bits()) for value in factor.coeffs()) for factor in (left, right))
        self._require_size(len(left) * len(right), int(left.total_degree()) + int(right.total_degree()), bits)
        return left * right

    def _require_size(self, products: int, degree: int, bits: int) -> None:
        limits = self.limits
        if degree > limits.degree:
            raise InputError(f"{self.where}: degree {degree}; at most {limits.degree} is possible")
        if products > 8 * limits.terms:
            raise InputError(f"{self.where}: more than {limits.terms} terms; a polynomial may not have so many")
        if bits > 2 * self.bits:
            raise InputError(f"{self.where}: a coefficient of more than {limits.digits} digits; use shorter numbers")

    def _taken(self, sign: str) -> bool:
        taken = self.place < len(self.tokens) and self.tokens[self.place] == ("sign", sign)
        self.place += taken
        return taken

    def _next(self) -> tuple[str, str]:
        if self.place == len(self.tokens):
            return ("", _END)
        self.place += 1
        return self.tokens[self.place - 1]

    def _wrong(self, wanted: str) -> InputError:
        if self.place >= len(self.tokens):
            return InputError(f"{self.where}: ends where {wanted} is expected; complete it")
        return InputError(f"{self.where}: {shown(self.tokens[self.place][1])} where {wanted} is expected; correct it")
