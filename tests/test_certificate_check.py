"""The checker: its formulas, its independence, what it accepts, and what it does with other files."""

import ast
import json
import re
import subprocess
import sys
from collections.abc import Sequence
from fractions import Fraction
from math import floor, prod
from pathlib import Path
from random import Random
from typing import Any

import pytest
from budgets import budget
from certificate_tools import CERTS, NAMES, both, check_resealed, golden, golden_bytes, last_line
from flint import arb, fmpq, fmpq_mat, fmpz, fmpz_poly
from hypothesis import given
from hypothesis import strategies as st
from samples import model, shipped

import pkm_exact
from pkm_exact.certify.build import canonical_bytes, certificate, sealed
from pkm_exact.certify.check import Status, Verdict, check_bytes
from pkm_exact.certify.checker import document, elimination, multiplicity, realposes, solutions, spelling, verdict
from pkm_exact.certify.checker.descartes import RealRoot, real_roots
from pkm_exact.certify.checker.section import section
from pkm_exact.certify.checker.study_motion import CYCLIC, Motion, leg_form, leg_lines, motion
from pkm_exact.claim import Claim, CompletenessRoute
from pkm_exact.constraints.distance import Distance
from pkm_exact.engine import solve
from pkm_exact.formulations.registry import formulation_codes
from pkm_exact.geometry.kinds import KINDS
from pkm_exact.roots.isolation import isolate_real_roots

PACKAGE = Path(pkm_exact.__file__).parent
SOURCES = [PACKAGE / "certify" / "check.py", *sorted((PACKAGE / "certify" / "checker").glob("*.py"))]

EXPECTED = {
    "dietmaier": ("complete", 40, 40),
    "mourrain-l": ("complete", 40, 4),
    "robocrane-r": ("complete", 16, 4),
    "rolland-6-6": ("complete", 40, 16),
    "similar-planar-s": ("complete", 16, 8),
}


# What it accepts


@pytest.mark.parametrize("name", NAMES)
def test_golden_certificates_are_accepted(name: str) -> None:
    content = golden(name)
    answer = check_bytes(golden_bytes(name))
    assert answer.status is Status.ACCEPTED
    claim, complex_solutions, real_poses = EXPECTED[name]
    assert (content["claim"], content["distinct_solutions"], content["real_poses"]) == EXPECTED[name]
    assert any(line.startswith(claim.replace("-", " ")) for line in answer.lines)
    assert f"eliminant: squarefree of degree {complex_solutions}" in answer.lines
    assert f"real poses: {real_poses}, one for each real root of the eliminant" in answer.lines


def test_no_line_repeats_free_text() -> None:
    content = golden("robocrane-r")
    content["robot"]["name"] = "\x1b[2J" + "remarkable"
    answer = check_resealed(content)
    assert answer.status == "accepted"
    assert not any("remarkable" in line or "\x1b" in line for line in answer.lines)


def test_a_verdict_prints_its_lines_and_its_status() -> None:
    assert str(Verdict(Status.ACCEPTED, ("digest: fine",))) == "digest: fine\naccepted"


@pytest.mark.parametrize("claim", ["not-proven-complete", "positive-dimensional-detected"])
def test_nothing_listed_and_nothing_claimed_is_accepted(claim: str) -> None:
    assert check_resealed(_nothing_listed(claim)).status == "accepted"


@pytest.mark.parametrize("claim", ["complete", "positive-dimensional-proved", "inconsistent"])
def test_nothing_listed_proves_nothing(claim: str) -> None:
    assert check_resealed(_nothing_listed(claim)).status == "rejected"


@pytest.mark.parametrize(
    ("key", "value"), [("complex_solutions", 40), ("distinct_solutions", 1), ("completeness_route", "refined-bezout")]
)
def test_nothing_listed_counts_nothing(key: str, value: Any) -> None:
    assert check_resealed({**_nothing_listed("not-proven-complete"), key: value}).status == "rejected"


def _nothing_listed(claim: str) -> dict[str, Any]:
    nothing = {
        "representation": None,
        "elimination": None,
        "poses": [],
        "completeness_route": None,
        "box_exponent": 0,
    }
    counts = dict.fromkeys(("complex_solutions", "distinct_solutions", "real_poses"), 0)
    return {**golden("robocrane-r"), **nothing, **counts, "claim": claim}


# Its independence


@pytest.mark.parametrize("path", SOURCES, ids=lambda path: path.name)
def test_the_checker_imports_only_itself_the_standard_library_and_flint(path: Path) -> None:
    # Arrays of integers of any size, with several indices: nothing is computed in floating point there.
    arrays = {"numpy"} if path.name in ("region_coefficients.py", "region_regular.py") else set()
    allowed = {*sys.stdlib_module_names, "flint"} | arrays
    if arrays:
        made = re.findall(r"np\.(?:array|full|zeros|empty)\(.*", path.read_text())
        assert all("dtype=object" in line for line in made)
    for node in ast.walk(ast.parse(path.read_text())):
        names = [alias.name for alias in node.names] if isinstance(node, ast.Import) else []
        if isinstance(node, ast.ImportFrom):
            assert node.level == 0
            names = [str(node.module)]
        for name in names:
            assert name.split(".")[0] in allowed or name.startswith("pkm_exact.certify.checker."), name


def test_checking_loads_nothing_of_the_solver() -> None:
    script = (
        "import sys\n"
        "from pkm_exact.certify.check import check_bytes\n"
        f"print(check_bytes(open({str(CERTS / 'robocrane-r.json')!r}, 'rb').read()).status)\n"
        "print(*(name for name in sys.modules if name.startswith('pkm_exact')))"
    )
    done = subprocess.run([sys.executable, "-c", script], capture_output=True, text=True, check=True)
    status, names = done.stdout.splitlines()
    assert status == "accepted"
    assert all(name.startswith("pkm_exact.certify") for name in names.split() if name != "pkm_exact")


def test_the_words_of_the_format_are_those_of_the_package() -> None:
    assert set(document.CLAIMS) == {claim.value for claim in Claim}
    assert set(document.ROUTES) <= {route.value for route in CompletenessRoute}
    assert set(document.KINDS) <= set(KINDS)
    assert all(document.FORMULATIONS.fullmatch(code) for code in formulation_codes())


# Its formulas

rationals = st.fractions(min_value=-9, max_value=9, max_denominator=9)
vectors = st.tuples(rationals, rationals, rationals)
metrics = st.tuples(*[st.integers(1, 9)] * 3)


def _dot(metric: Sequence[int], u: Sequence[Fraction], v: Sequence[Fraction]) -> Fraction:
    return sum((g * x * y for g, x, y in zip(metric, u, v, strict=True)), Fraction(0))


def _translation(e: Sequence[Fraction], c: Sequence[Fraction], g: Sequence[int]) -> list[Fraction]:
    """f of the pose with quaternion coordinates e and position c."""
    f = [-sum((g[i] * c[i] * e[i + 1] for i in range(3)), Fraction(0))]
    return f + [g[i] * e[0] * c[i] + c[j] * e[k + 1] - c[k] * e[j + 1] for i, j, k in CYCLIC]


def _determinant3(m: Sequence[Sequence[Fraction]]) -> Fraction:
    return sum(
        (m[0][i] * (m[1][j] * m[2][k] - m[1][k] * m[2][j]) for i, j, k in CYCLIC),
        Fraction(0),
    )


@given(st.tuples(rationals, rationals, rationals, rationals).filter(any), vectors, metrics)
def test_motions_are_rigid(e: Sequence[Fraction], c: Sequence[Fraction], g: tuple[int, int, int]) -> None:
    placed = motion(e, _translation(e, c, g), g)
    norm = placed.norm
    rotation = [[entry / norm for entry in row] for row in placed.rotation]
    columns = list(zip(*rotation, strict=True))
    for i in range(3):
        for j in range(3):
            assert _dot(g, columns[i], columns[j]) == (g[i] if i == j else 0)
    assert _determinant3(rotation) == 1
    assert [x / norm for x in placed.position] == list(c)
    assert [_dot((1, 1, 1), row, placed.turned) / norm for row in rotation] == list(c)
    assert placed.square / norm == _dot(g, c, c)
    assert placed.study == 0


@given(st.tuples(rationals, rationals, rationals, rationals).filter(any), vectors, vectors, vectors, metrics, rationals)
def test_a_leg_form_measures_the_leg(
    e: Sequence[Fraction],
    c: Sequence[Fraction],
    a: Any,
    b: Any,
    g: tuple[int, int, int],
    length_squared: Fraction,
) -> None:
    placed = motion(e, _translation(e, c, g), g)
    tip = [x + _dot((1, 1, 1), row, b) / placed.norm for x, row in zip(c, placed.rotation, strict=True)]
    leg = [x - y for x, y in zip(tip, a, strict=True)]
    form = leg_form(Distance(a, b, length_squared), g)
    value = sum(x * y for x, y in zip(form, placed.coordinates(), strict=True))
    assert form[-1] > 0
    assert value == form[-1] * placed.norm * (_dot(g, leg, leg) - length_squared)


def test_leg_lines_are_the_derivatives_of_the_lengths() -> None:
    """Up to a factor that does not depend on the legs, their determinant is that of the exact Jacobian."""
    random = Random(1)
    for g in ((1, 1, 1), (1, 3, 2)):
        e = [Fraction(random.randrange(-5, 6), 3) for _ in range(4)]
        c = [Fraction(random.randrange(-5, 6), 2) for _ in range(3)]
        placed = motion(e, _translation(e, c, g), g)
        ratios = set()
        for _ in range(3):
            legs = [
                Distance(
                    tuple(Fraction(random.randrange(-9, 10)) for _ in range(3)),  # type: ignore[arg-type]
                    tuple(Fraction(random.randrange(-9, 10)) for _ in range(3)),  # type: ignore[arg-type]
                    Fraction(1),
                )
                for _ in range(6)
            ]
            jacobian = [_derivatives(leg, e, c, g) for leg in legs]
            ratios.add(_determinant(leg_lines(legs, placed)) / _determinant(jacobian))
        assert len(ratios) == 1
        assert ratios.pop() != 0


def _derivatives(
    leg: Distance, e: Sequence[Fraction], c: Sequence[Fraction], g: tuple[int, int, int]
) -> list[Fraction]:
    """Exact derivatives of |C + R B - A|^2 by C and by the infinitesimal rotations R (1 + s W), W^T G + G W = 0."""
    placed = motion(e, _translation(e, c, g), g)
    rotation = [[x / placed.norm for x in row] for row in placed.rotation]
    arm = [_dot((1, 1, 1), row, leg.platform) for row in rotation]
    tip = [x + y - z for x, y, z in zip(c, arm, leg.base, strict=True)]
    row = [2 * w * x for w, x in zip(g, tip, strict=True)]
    for i, j, _ in CYCLIC:
        turned = [Fraction(0)] * 3
        turned[i], turned[j] = g[j] * leg.platform[j], -g[i] * leg.platform[i]
        row.append(2 * _dot(g, tip, [_dot((1, 1, 1), line, turned) for line in rotation]))
    return row


def _determinant(rows: Sequence[Sequence[Fraction]]) -> Fraction:
    matrix = fmpq_mat(6, 6, [fmpq(x.numerator, x.denominator) for row in map(_fractions, rows) for x in row])
    value = matrix.det()
    return Fraction(int(value.p), int(value.q))


def _fractions(row: Sequence[Any]) -> list[Fraction]:
    return [Fraction(x) for x in row]


def test_determinants_without_division() -> None:
    random = Random(2)
    rows = [[random.randrange(-9, 10) for _ in range(6)] for _ in range(6)]
    assert multiplicity.determinant(rows) == _determinant(rows)


def test_its_primes_are_primes() -> None:
    assert all(fmpz(p).is_prime() and p.bit_length() == 63 for p in solutions.PRIMES)


def test_the_section_consists_of_poses() -> None:
    """Its quadrics vanish at a pose, and its unknowns are those coordinates of the pose that the legs leave free."""
    random = Random(3)
    for g in ((1, 1, 1), (1, 3, 2)):
        e = [Fraction(random.randrange(1, 6)) for _ in range(4)]
        c = [Fraction(random.randrange(-5, 6), 2) for _ in range(3)]
        placed = motion(e, _translation(e, c, g), g)
        values = [x / placed.norm for x in (*placed.turned, *placed.position, placed.square, *sum(placed.rotation, ()))]
        packing, quadrics = section(_legs_at(placed, g, random), g)
        assert packing.size == 10
        assert all(max(map(packing.degree, quadric)) <= 2 for quadric in quadrics)
        free = [fmpq(x.numerator, x.denominator) for x in values[6:]]  # six legs give u and C on a general robot
        for quadric in quadrics:
            assert sum(value * _power(free, packing.unpacked(code)) for code, value in quadric.items()) == 0


def _legs_at(placed: Motion, g: tuple[int, int, int], random: Random) -> list[Distance]:
    """Random legs with the lengths that they have at a pose."""
    legs = []
    for _ in range(6):
        a, b = ([Fraction(random.randrange(-9, 10)) for _ in range(3)] for _ in range(2))
        tip = [
            (x + _dot((1, 1, 1), row, b)) / placed.norm for x, row in zip(placed.position, placed.rotation, strict=True)
        ]
        leg = [x - y for x, y in zip(tip, a, strict=True)]
        legs.append(Distance((a[0], a[1], a[2]), (b[0], b[1], b[2]), _dot(g, leg, leg)))
    return legs


def _power(values: Sequence[Any], exponents: Sequence[int]) -> Any:
    return prod((value**exponent for value, exponent in zip(values, exponents, strict=True)), start=fmpq(1))


def test_standard_monomials() -> None:
    assert elimination._standard({(2, 0), (1, 1), (0, 3)}, 2, 9) == [(0, 0), (0, 1), (1, 0), (0, 2)]
    assert elimination._standard({(0, 0)}, 2, 0) == []
    assert elimination._standard({(2, 0)}, 2, 9) is None
    with pytest.raises(verdict.Refusal, match="more than 9"):
        elimination.Elimination.begun(2, [{(2, 0): 1}]).standard(9)


# Real roots and cells


def test_nothing_is_cut_at_a_sign_that_is_not_known() -> None:
    """Of (x - 1) .. (x - 60) values between roots have no digit that is right at the first precision."""
    h = prod((fmpz_poly([-root, 1]) for root in range(1, 61)), start=fmpz_poly([1]))
    for number in range(1, 61):
        for left, right in ((2, 1), (1, 2)):
            root = RealRoot(h, number - fmpq(left, 5), number + fmpq(right, 5))
            root.narrow(20)
            assert root.low <= number <= root.high <= root.low + fmpq(1, 1 << 20)


def test_isolating_intervals_are_the_cells_of_the_coarsest_grid() -> None:
    close = fmpz_poly([-1, 3]) * fmpz_poly([-1, 3 * 2**40]) * fmpz_poly([0, 1]) * fmpz_poly([-2, 0, 1])
    cells, exponent = realposes.parameter_cells(close, real_roots(close))
    assert exponent == 42  # 1/(3 2^40) = (4/3) 2^-42: first cell without 0
    assert cells[1:3] == [(0, 0), (1, 2)]
    for (low, high), root in zip(cells, _ROOTS, strict=True):
        assert int(low) <= root * 2**exponent <= int(high) <= int(low) + 1


_ROOTS = (-(2**0.5), 0, 1 / (3 * 2**40), 1 / 3, 2**0.5)


def test_no_interval_touches_a_root_that_it_does_not_hold() -> None:
    """-(1/3) 2^-32 lies in the cell [-1, 0] of the grid 2^-32, but so does the root 0."""
    h = fmpz_poly([0, 1]) * fmpz_poly([1, 3 * 2**32])
    assert realposes.parameter_cells(h, real_roots(h)) == ([(-2, -1), (0, 0)], 34)


@given(st.lists(st.tuples(st.integers(-20, 20), st.integers(-20, 20), st.integers(1, 20)), min_size=1, max_size=5))
def test_solver_and_checker_isolate_alike(factors: list[tuple[int, int, int]]) -> None:
    h = fmpz_poly([1])
    for factor in factors:
        h *= fmpz_poly(list(factor))
    for factor, power in h.factor_squarefree()[1]:
        h //= factor ** (power - 1)
    cells, exponent = realposes.parameter_cells(h, real_roots(h))
    roots = isolate_real_roots(h)
    assert [(root.cell, root.cell + (not root.is_exact)) for root in roots] == cells
    assert all(root.exponent == exponent for root in roots)


def test_complex_roots_near_the_real_axis_are_not_taken_for_real() -> None:
    near = fmpz_poly([1, 0, 2**200]) * fmpz_poly([-5, 1])
    assert realposes.parameter_cells(near, real_roots(near)) == ([(5 << 32, 5 << 32)], 32)


@pytest.mark.parametrize(
    ("value", "cell"),
    [
        (Fraction(1, 3), (0, 1)),
        (Fraction(-1, 3), (-1, 0)),
        (Fraction(7), (6, 8)),
        (7 + Fraction(1, 2**33), (6, 8)),
        (7 - Fraction(1, 2**33), (6, 8)),
        (7 + Fraction(1, 2**31), (7, 8)),
        (7 - Fraction(1, 2**31), (6, 7)),
        (7 + Fraction(1, 2**32), None),
    ],
)
def test_cells_of_coordinates(value: Fraction, cell: tuple[int, int] | None) -> None:
    ball = arb(fmpq(value.numerator, value.denominator)) + arb(0, arb(2) ** -45)
    assert realposes._coordinate_cell(ball, 0, late=False) == cell
    assert realposes._coordinate_cell(ball, 0, late=True) == (cell or (6, 8))


@given(
    st.integers(-(10**6), 10**6),
    st.builds(lambda sign, power: Fraction(sign, 2**power), st.sampled_from((-1, 0, 1)), st.integers(1, 70))
    | st.fractions(-1, 1),
    st.integers(0, 70),
)
def test_cells_of_coordinates_are_as_they_are_defined(near: int, distance: Fraction, exponent: int) -> None:
    value = near + distance
    ball = (arb(fmpq(value.numerator, value.denominator)) + arb(0, arb(2) ** -80)) / 2**exponent
    found = realposes._coordinate_cell(ball, exponent, late=False)
    nearest = round(value)
    apart = abs(value - nearest) - Fraction(1, 2**32)
    if abs(apart) > Fraction(1, 2**70):
        assert found == ((nearest - 1, nearest + 1) if apart < 0 else (floor(value), floor(value) + 1))
    else:
        assert found in (None, (nearest - 1, nearest + 1), (floor(value), floor(value) + 1))


@given(st.integers(-(2**80), 2**80) | st.integers(-9, 9), st.integers(0, 2), st.integers(0, 90))
def test_ends_are_spelled_in_lowest_terms(low: int, width: int, exponent: int) -> None:
    ends = realposes.cell_ends(fmpz(low), fmpz(low + width), exponent)
    assert ends == (str(Fraction(low, 2**exponent)), str(Fraction(low + width, 2**exponent)))


def test_ends_of_many_digits() -> None:
    (end, _) = realposes.cell_ends(fmpz(3) ** 20000, fmpz(3) ** 20000, 9000)
    assert end == str(fmpq(fmpz(3) ** 20000, fmpz(1) << 9000))


# What is not a certificate


def _with_raw(old: str, new: str) -> bytes:
    text = golden_bytes("robocrane-r").decode()
    assert old in text
    return text.replace(old, new, 1).encode()


@pytest.mark.parametrize(
    "data",
    [
        b"",
        b"\n",
        b"null",
        b"[]",
        b"{}",
        b'{"digest": 5}',
        b"\xff\xfe",
        b"\xef\xbb\xbf{}",
        '{"digest": "ä"}'.encode(),
        b"{" * 100,
        b"[" * 500_000,
        b'{"digest":' + b"[" * 100_000 + b"]" * 100_000 + b"}",
        b'{"digest": "", "digest": ""}',
        b'{"digest": 1e400}',
        b'{"digest": NaN}',
        b'{"digest": -Infinity}',
        b'{"digest": ' + b"9" * 10**6 + b"}",
        golden_bytes("robocrane-r")[:-2],
        golden_bytes("robocrane-r") + b"x",
        golden_bytes("robocrane-r")[:-1],
        golden_bytes("robocrane-r") + b"\n",
        golden_bytes("robocrane-r").replace(b"\n", b"\r\n"),
        json.dumps(golden("robocrane-r")).encode(),
        json.dumps(golden("robocrane-r"), indent=2).encode(),
        _with_raw('"version": 1', '"version": 1.0'),
        _with_raw('"version": 1', '"version": 10e-1'),
        _with_raw('"version": 1', '"version": 1, "version": 1'),
        _with_raw("RoboCrane R", "RoboCran\\u0065 R"),
    ],
    ids=range(28),
)
def test_malformed(data: bytes) -> None:
    answer = check_bytes(data)
    assert answer.status is Status.MALFORMED
    assert len(answer.lines) == 1


@pytest.mark.parametrize(
    ("path", "value"),
    [
        (("version",), 2),
        (("version",), True),
        (("format",), "another"),
        (("robot", "kind"), "3-RPR"),
        (("robot", "metric"), ["1", "1"]),
        (("robot", "metric"), ["1", "0", "1"]),
        (("robot", "metric"), ["1", "-1", "1"]),
        (("robot", "metric"), ["1", "1/2", "1"]),
        (("robot", "metric"), [1, 1, 1]),
        (("robot", "base", 0, 0), "2/4"),
        (("robot", "base", 0, 0), "4/1"),
        (("robot", "base", 0, 0), "+2"),
        (("robot", "base", 0, 0), "02"),
        (("robot", "base", 0, 0), "-0"),
        (("robot", "base", 0, 0), "1/0"),
        (("robot", "base", 0, 0), "1.5"),
        (("robot", "base", 0, 0), " 2"),
        (("robot", "base", 0, 0), "2\n"),
        (("robot", "base", 0, 0), "٣"),
        (("robot", "base", 0, 0), "__import__('os')"),
        (("robot", "base", 0, 0), 2),
        (("robot", "base", 0, 0), None),
        (("configuration", "lengths_squared", 0), "0"),
        (("configuration", "lengths_squared", 0), "-1"),
        (("configuration", "name"), 3),
        (("formulation",), "XYZ"),
        (("formulation",), "SE3:" + "a" * 99),
        (("method",), "guess"),
        (("claim",), "certainly"),
        (("completeness_route",), "trust me"),
        (("complex_solutions",), -1),
        (("complex_solutions",), "16"),
        (("complex_solutions",), False),
        (("box_exponent",), -1),
        (("representation",), []),
        (("representation", "chart"), [1, 0, 0]),
        (("representation", "chart", 0), "1"),
        (("representation", "eliminant"), []),
        (("representation", "eliminant"), ["0x1"]),
        (("representation", "eliminant", 0), "0X1"),
        (("representation", "eliminant", 0), "0x01"),
        (("representation", "eliminant", 0), "-0x0"),
        (("representation", "eliminant", 0), "0xA"),
        (("representation", "eliminant", 0), "0x1_0"),
        *((("representation", "eliminant", 0), text) for text in ("0x", "", "x", "10", "0x_1", "0o1", "0b1", "0x1.0")),
        *((("representation", "eliminant", 0), text) for text in (" 0x1", "0x1 ", "0x1\n", "+0x1", "--0x1", "0x１")),
        (("representation", "eliminant", 0), 1),
        (("representation", "quaternion", 0), ["0x1", "0x0"]),
        (("poses", 0, "position"), []),
        (("poses", 0, "position", 0), ["0"]),
        (("poses", 0, "position", 0, 0), "1e5"),
        (("poses", 0, "multiplicity"), -1),
        (("poses", 0, "multiplicity"), "1"),
        (("elimination",), "36 5"),
        (("elimination",), ["36 5"]),
        (("elimination", 0, 0), 36),
        (("elimination", 0, 0), "36,5"),
        (("elimination", 0, 0), "36 "),
        (("elimination", 0, 0), "036 5"),
        (("elimination", 0, 0), "-1 5"),
        (("elimination", 0, 0), "36 5 4"),
        (("elimination", 0, 0), "36 16"),
        (("notes",), "none"),
        (("notes",), [1]),
    ],
)
def test_malformed_entries(path: tuple[str | int, ...], value: Any) -> None:
    content: Any = golden("robocrane-r")
    entry = content
    for key in path[:-1]:
        entry = entry[key]
    entry[path[-1]] = value
    answer = check_resealed(content)
    assert answer.status is Status.MALFORMED, last_line(answer)
    assert answer.lines[-1].startswith((str(path[0]), "format", "certificate"))


@pytest.mark.parametrize(
    ("path", "value"),
    [
        (("robot", "name"), "x" * 10_001),
        (("robot", "base", 0, 0), "1" * 601),
        (("robot", "base", 0, 0), "1" * 20_000),
        (("box_exponent",), 8193),
        (("representation", "eliminant"), ["0x1"] * 2002),
        (("representation", "eliminant", 0), "0x" + "f" * 70_000),
        (("poses", 0, "position", 0, 0), "1" * 20_000),
        (("notes",), ["x", "y"] * (1 << 20)),
        (("elimination", 0), ["0"] * 5001),
    ],
    ids=range(9),
)
def test_too_large(path: tuple[str | int, ...], value: Any) -> None:
    content: Any = golden("robocrane-r")
    entry = content
    for key in path[:-1]:
        entry = entry[key]
    entry[path[-1]] = value
    assert check_resealed(content).status is Status.TOO_LARGE


@pytest.mark.parametrize(("more", "status"), [(0, Status.MALFORMED), (1, Status.TOO_LARGE)])
def test_a_file_over_the_limit_is_not_read(more: int, status: Status) -> None:
    assert check_bytes(b" " * ((64 << 20) + more)).status is status


def test_a_lone_surrogate_is_text() -> None:
    content = golden("robocrane-r")
    content["robot"]["name"] = "\ud800"
    assert check_bytes(canonical_bytes(sealed(content))).status is Status.ACCEPTED


@given(st.binary(max_size=200))
def test_any_bytes_get_a_verdict(data: bytes) -> None:
    assert check_bytes(data).status in (Status.MALFORMED, Status.REJECTED)


@budget(20)
@given(st.data())
def test_any_json_in_place_of_an_entry_gets_a_verdict(data: st.DataObject) -> None:
    values = st.recursive(
        st.none() | st.booleans() | st.integers() | st.text(max_size=8),
        lambda inner: st.lists(inner, max_size=3) | st.dictionaries(st.text(max_size=4), inner, max_size=3),
        max_leaves=6,
    )
    content = golden("robocrane-r")
    key = data.draw(st.sampled_from(sorted(content)))
    answer = check_resealed({**content, key: data.draw(values)})
    assert answer.status in tuple(Status)


def test_another_grid_gives_another_true_certificate() -> None:
    """Entries that change together: other bounds throughout, and the same claim."""
    robot, problem = model("3-rpr-merlet-p"), shipped("3-rpr-merlet-p")
    widths = (Fraction(1, 10**9), Fraction(1, 10**12))
    contents = [certificate(robot, "home", solve(problem, width=width)) for width in widths]
    assert len({content["box_exponent"] for content in contents}) == 2
    assert contents[0]["poses"][0]["position"] != contents[1]["poses"][0]["position"]
    assert all(both(canonical_bytes(content)).status == "accepted" for content in contents)
    claims = {(content["claim"], content["complex_solutions"], content["real_poses"]) for content in contents}
    assert claims == {("complete", 6, 2)}


@pytest.mark.parametrize("value", [{}, [], "é\n\u2028\ud83d", [[], {}, {"a": [True, None, -3]}], {"b": {"ü": ["", 0]}}])
def test_the_canonical_form_is_that_of_the_json_module(value: object) -> None:
    assert spelling._canonical_bytes(value) == f"{json.dumps(value, indent=1)}\n".encode()
