"""The second checker, in plain Python: it answers what the first one answers, whatever the file."""

import ast
import json
import subprocess
import sys
from collections.abc import Iterable, Sequence
from fractions import Fraction
from math import isqrt
from pathlib import Path
from random import Random
from types import FunctionType, ModuleType
from typing import Any

import pytest
import test_certificate_check
import test_certificate_fraud
import test_multiplicities
import test_self_motion
from certificate_subjects import subject
from certificate_tools import CERTS, both, both_resealed, boxed_certificate, golden, golden_bytes, with_entry
from flint import fmpq_mat, fmpz_poly
from hypothesis import given
from hypothesis import strategies as st

from pkm_exact.certify import pure
from pkm_exact.certify.build import canonical_bytes, certificate
from pkm_exact.certify.check import check_bytes
from pkm_exact.certify.checker import realposes
from pkm_exact.certify.checker.descartes import real_roots
from pkm_exact.geometry.reader import read_robot
from pkm_exact.geometry.robot import Robot
from pkm_exact.numeric_engine import solve_krawczyk

SOURCE = Path(pure.__file__)
ALL = sorted(path.stem for path in CERTS.glob("*.json"))
SMALL = ("3-prr", "3-rpr-double-q", "3-rpr-triple", "mourrain-l", "robocrane-r", "similar-planar-s")
LARGE = ("hexaglide", "ssm-rounded")
"""Half a minute each."""


# Certificates in the repository


def _marks(name: str) -> list[pytest.MarkDecorator]:
    return [*([] if name in SMALL else [pytest.mark.slow]), *([pytest.mark.largest] if name in LARGE else [])]


@pytest.mark.parametrize("name", [pytest.param(n, marks=_marks(n)) for n in ALL])
def test_golden_certificates_are_accepted_with_the_same_lines(name: str) -> None:
    assert both(golden_bytes(name)).status == "accepted"


def test_it_runs_alone(tmp_path: Path) -> None:
    (tmp_path / "copy.py").write_bytes(SOURCE.read_bytes())
    (tmp_path / "good.json").write_bytes(golden_bytes("3-rpr-triple"))
    (tmp_path / "changed.json").write_bytes(golden_bytes("3-rpr-triple").replace(b"cusp", b"kink"))
    (tmp_path / "tolerance.json").write_bytes(canonical_bytes(subject("tolerance, planar, complete")))
    (tmp_path / "none.json").write_bytes(b"[]")
    for names, code in (
        (["good"], 0),
        (["good", "changed", "none"], 1),
        (["good", "none"], 2),
        (["tolerance"], 0),
        (["missing"], 2),
        ([], 2),
    ):
        command = [sys.executable, "-I", "-S", "copy.py", *(f"{name}.json" for name in names)]
        done = subprocess.run(command, cwd=tmp_path, capture_output=True, text=True, check=False)
        assert done.returncode == code, done.stderr
        lines = done.stdout.splitlines()
        assert all(line.startswith(tuple(names)) for line in lines)
        assert ("good.json: accepted" in lines) == ("good" in names)
        assert ("changed.json: rejected" in lines) == ("changed" in names)
        assert "Traceback" not in done.stderr


def test_it_imports_only_the_standard_library() -> None:
    for node in ast.walk(ast.parse(SOURCE.read_text())):
        names = [alias.name for alias in node.names] if isinstance(node, ast.Import) else []
        names += [str(node.module)] if isinstance(node, ast.ImportFrom) else []
        assert all(name.split(".")[0] in sys.stdlib_module_names for name in names)


# The same files as the first checker is tested with: deceitful, malformed, too large


@pytest.fixture(autouse=True)
def _by_both(monkeypatch: pytest.MonkeyPatch) -> None:
    for module in (test_certificate_check, test_certificate_fraud, test_multiplicities, test_self_motion):
        monkeypatch.setattr(module, "check_resealed", both_resealed)
    monkeypatch.setattr(test_certificate_check, "check_bytes", both)


QUICK_FRAUDS = (
    "test_a_numerator_is_changed_by_a_multiple_of_the_eliminant",
    "test_a_robot_without_poses_is_inconsistent",
    "test_an_elimination_uses_what_there_is_not",
    "test_boxes_of_different_poses_meet",
    "test_e_and_f_are_no_motion",
    "test_n_of_e_is_zero",
    "test_one_pose_is_listed_under_forty_parameters",
    "test_self_motions_are_certified",
    "test_two_poses_exchange_their_boxes",
)
OTHER_FILES = (
    "test_nothing_listed_and_nothing_claimed_is_accepted",
    "test_nothing_listed_proves_nothing",
    "test_nothing_listed_counts_nothing",
    "test_malformed",
    "test_malformed_entries",
    "test_too_large",
    "test_a_lone_surrogate_is_text",
    "test_any_bytes_get_a_verdict",
)


def _take(module: ModuleType, names: Iterable[str], *, slow: bool) -> None:
    """Make tests of another module tests of this one, with its marks, and slow ones if asked for."""
    for name in names:
        test = vars(module)[name]
        copy = FunctionType(test.__code__, test.__globals__, name, test.__defaults__, test.__closure__)
        copy.__kwdefaults__ = test.__kwdefaults__
        copy.__dict__.update(test.__dict__)
        globals()[name] = pytest.mark.slow(copy) if slow else copy


def _names(module: ModuleType) -> list[str]:
    return [name for name in vars(module) if name.startswith("test_")]


_take(test_certificate_check, OTHER_FILES, slow=False)
_take(test_certificate_check, ["test_any_json_in_place_of_an_entry_gets_a_verdict"], slow=True)
_take(test_certificate_fraud, QUICK_FRAUDS, slow=False)
_take(test_certificate_fraud, sorted({*_names(test_certificate_fraud)} - {*QUICK_FRAUDS}), slow=True)
_take(test_multiplicities, _names(test_multiplicities), slow=True)
_take(test_self_motion, _names(test_self_motion), slow=True)


# Boxes around solutions


@pytest.fixture(scope="module", params=["3-rrr", pytest.param("mourrain-l", marks=pytest.mark.slow)])
def boxed(request: pytest.FixtureRequest) -> dict[str, Any]:
    return boxed_certificate(request.param)


@pytest.mark.parametrize("name", ["3-rrr", "mourrain-l", pytest.param("rolland-6-6", marks=pytest.mark.slow)])
def test_boxes_are_accepted(name: str) -> None:
    content = boxed_certificate(name)
    assert content["method"] == "krawczyk"
    answer = both_resealed(content)
    assert answer.status == "accepted"
    assert answer.lines[-1].startswith("complete: ")


@pytest.mark.usefixtures("remembered")
def test_changed_boxes(boxed: dict[str, Any]) -> None:
    real, others = boxed["krawczyk"]["real"], boxed["krawczyk"]["complex"]
    moved = {**real[0], "centre": [hex(int(real[0]["centre"][0], 16) + 64), *real[0]["centre"][1:]]}
    as_complex = {**real[0], "centre": [[value, "0x0"] for value in real[0]["centre"]]}
    conjugate = [{**box, "centre": [[x, hex(-int(y, 16))] for x, y in box["centre"]]} for box in others[:1]]
    changes = {
        ("real",): [real[1:], [real[0], *real[:-1]], [moved, *real[1:]], real[::-1]],
        ("complex",): [[*others, as_complex], [*others, *others[:1]], [*others[1:], *conjugate], [*others, *conjugate]],
        ("chart",): [[0, 0, 0, 0], [7, 1, 1, 1]],
        ("real", 0, "exponents"): [[0, 0], [4, 4], [2048, 2048], [2049, 0], [-1, 0], [3]],
        ("real", 0, "centre"): [["0x0"] * 8, real[0]["centre"][:7], ["0x1" + "0" * 1025] * 8, as_complex["centre"]],
    }
    statuses = set()
    for path, values in changes.items():
        for value in values:
            statuses.add(str(both_resealed(with_entry(boxed, ("krawczyk", *path), value)).status))
    assert {"accepted", "rejected", "malformed", "too-large"} >= statuses >= {"rejected", "malformed", "too-large"}


def test_pairs_of_boxes_are_spelled_in_one_way(boxed: dict[str, Any]) -> None:
    """The conjugate of a complex box stands for the same two solutions, but is not listed."""
    others = boxed["krawczyk"]["complex"]
    turned = [{**box, "centre": [[x, hex(-int(y, 16))] for x, y in box["centre"]]} for box in others]
    for place in range(0, len(others), 7):
        boxes = [*others[:place], turned[place], *others[place + 1 :]]
        assert both_resealed(with_entry(boxed, ("krawczyk", "complex"), boxes)).status == "rejected"
    if len(others) > 1:
        assert both_resealed(with_entry(boxed, ("krawczyk", "complex"), others[::-1])).status == "rejected"


@pytest.mark.usefixtures("remembered")
def test_claims_beside_boxes(boxed: dict[str, Any]) -> None:
    exact = golden("3-rrr" if len(boxed["robot"]["base"]) == 3 else "mourrain-l")
    for changed in (
        {"method": "exact"},
        {"krawczyk": None},
        {"representation": exact["representation"]},
        {"elimination": []},
        {"claim": "not-proven-complete", "completeness_route": None},
        {"completeness_route": "exact-elimination"},
        {"claim": "positive-dimensional-detected"},
        {"method": "exact", "claim": "positive-dimensional-detected"},
        {"method": "exact", "claim": "positive-dimensional-detected", "completeness_route": None},
        {"method": "exact", "claim": "positive-dimensional-proved", "completeness_route": None},
        {"complex_solutions": 39},
        {"distinct_solutions": 5},
        {"real_poses": 0},
        {"poses": exact["poses"]},
        {"poses": boxed["poses"][::-1]},
        {"poses": [{**pose, "multiplicity": None} for pose in boxed["poses"]]},
        {"box_exponent": boxed["box_exponent"] + 1},
    ):
        both_resealed(boxed | changed)


def test_fewer_boxes_prove_less(boxed: dict[str, Any]) -> None:
    content = with_entry(boxed, ("krawczyk", "complex"), [])
    number = len(boxed["krawczyk"]["real"])
    content |= {"complex_solutions": number, "distinct_solutions": number}
    assert both_resealed(content).status == ("accepted" if not boxed["krawczyk"]["complex"] else "rejected")
    weaker = content | {"claim": "not-proven-complete", "completeness_route": None}
    assert both_resealed(weaker).status == ("accepted" if boxed["krawczyk"]["complex"] else "rejected")


def test_another_robot_has_other_solutions(boxed: dict[str, Any]) -> None:
    length = Fraction(boxed["configuration"]["lengths_squared"][0])
    path = ("configuration", "lengths_squared", 0)
    assert both_resealed(with_entry(boxed, path, str(length + Fraction(1, 1000)))).status == "rejected"


# Its arithmetic

integers = st.integers(-(10**6), 10**6)
polynomials = st.lists(integers, min_size=1, max_size=6).filter(lambda p: p[-1])


@given(polynomials.filter(lambda p: len(p) > 1), polynomials, polynomials)
def test_multiples(h: list[int], q: list[int], r: list[int]) -> None:
    """h0 divides h0 q, and h0 q + r if and only if it divides r."""
    h0 = pure.primitive_part(h)
    q = q[: len(h0) - 1]
    product = fmpz_poly(h0) * fmpz_poly(q)
    other = product + fmpz_poly(r[: len(h0)])
    bound = max(sum(abs(int(c)) for c in p.coeffs()) for p in (product, other))
    multiples = pure.Multiples(h0, bound)
    assert multiples.include(pure.at_power([int(c) for c in product.coeffs()], multiples.k))
    divides = not divmod(other, fmpz_poly(h0))[1]
    assert multiples.include(pure.at_power([int(c) for c in other.coeffs()], multiples.k)) == divides


@given(polynomials.filter(lambda p: len(p) > 1), st.lists(integers, min_size=1, max_size=20), polynomials)
def test_multiples_of_many_times_the_degree(h: list[int], q: list[int], r: list[int]) -> None:
    """The same where the quotient is found in several steps; the first factor may vanish at 0, and signs are any."""
    h0 = pure.primitive_part(h)
    product = fmpz_poly(h0) * fmpz_poly(q)
    other = product + fmpz_poly(r)
    degrees = max(2, -(-max(product.degree(), other.degree()) // (len(h0) - 1)))
    bound = max(sum(abs(int(c)) for c in p.coeffs()) for p in (product, other))
    multiples = pure.Multiples(h0, bound, degrees)
    assert multiples.steps > 1 or degrees == 2
    assert multiples.include(pure.at_power([int(c) for c in product.coeffs()], multiples.k))
    divides = not divmod(other, fmpz_poly(h0))[1]
    assert multiples.include(pure.at_power([int(c) for c in other.coeffs()], multiples.k)) == divides


def test_an_exact_quotient_of_values_is_not_enough() -> None:
    """At X = 2^k the value of X - 1 divides that of 2^k - 1, and of every polynomial that vanishes there."""
    multiples = pure.Multiples([-1, 1], 5)
    assert multiples.include(pure.at_power([-2, 1, 1], multiples.k))
    assert not multiples.include((1 << multiples.k) - 1 << multiples.k - 1)


@given(st.lists(st.tuples(st.integers(-20, 20), st.integers(-20, 20), st.integers(1, 20)), min_size=1, max_size=5))
def test_both_isolate_alike(factors: list[tuple[int, int, int]]) -> None:
    h = fmpz_poly([1])
    for factor in factors:
        h *= fmpz_poly(list(factor))
    for factor, power in h.factor_squarefree()[1]:
        h //= factor ** (power - 1)
    cells, exponent = realposes.parameter_cells(h, real_roots(h))
    roots = pure.isolated(pure.primitive_part([int(c) for c in h.coeffs()]))
    assert [(root.m, root.m + (not root.exact)) for root in roots] == cells
    assert all(root.k == exponent for root in roots)


def test_roots_close_to_each_other_to_a_grid_point_and_to_the_axis() -> None:
    for factors in (
        ([-1, 3], [-1, 3 * 2**40], [0, 1], [-2, 0, 1]),
        ([0, 1], [1, 3 * 2**32]),
        ([1, 0, 2**200], [-5, 1]),
        ([-1, 2**90], [-(2**50) - 1, 2**140], [-1, 1]),
        ([-(10**40), 1], [1, 10**40]),
    ):
        h = fmpz_poly([1])
        for factor in factors:
            h *= fmpz_poly(factor)
        cells, exponent = realposes.parameter_cells(h, real_roots(h))
        roots = pure.isolated([int(c) for c in h.coeffs()])
        assert [(root.m, root.m + (not root.exact)) for root in roots] == cells
        assert all(root.k == exponent for root in roots)


huge = st.integers(-(10**60), 10**60) | integers | st.just(0)
cells = st.tuples(huge | st.integers(-3, 3), st.integers(0, 250))


def _value(polynomial: Sequence[int], x: Fraction) -> Fraction:
    return sum((c * x**i for i, c in enumerate(polynomial)), Fraction(0))


@given(st.lists(huge, max_size=8), cells, st.integers(0, 99), st.integers(0, 99), st.integers(1, 300))
def test_values_in_fixed_point_are_as_near_as_they_say(
    polynomial: list[int], cell: tuple[int, int], place: int, within: int, q: int
) -> None:
    """At a grid point of the cell, and at any point between two; the cell may be finer than the precision."""
    (m, k), finer = cell, 7
    values = pure.Fixed(polynomial, m, k)
    at, grid = (m << finer) + place, k + finer
    unit = Fraction(2) ** (values.s - q)
    for exact in (True, False):
        near, error = values.near(at, grid, q, exact=exact)
        x = Fraction(at, 1 << grid) + (0 if exact else Fraction(within, 99 << grid))
        assert abs(_value(polynomial, x) - near * unit) <= error * unit
        if q >= at.bit_length() and exact:
            assert error <= 2 * len(polynomial)


@given(st.lists(huge, min_size=1, max_size=8), cells, st.integers(0, 128), st.integers(0, 40), st.booleans())
def test_signs_of_values_are_exact(
    polynomial: list[int], cell: tuple[int, int], place: int, bits: int, is_root: bool
) -> None:
    """0 only at roots, which may be grid points of many digits; other values have so many right bits."""
    (m, k), finer = cell, 7
    at, grid = (m << finer) + place, k + finer
    if is_root:
        polynomial = [int(c) for c in (fmpz_poly(polynomial) * fmpz_poly([-at, 1 << grid])).coeffs()] or [0]
    values = pure.Fixed(polynomial, m, k)
    found, q = values.at(at, grid, bits)
    value = _value(polynomial, Fraction(at, 1 << grid))
    assert (found > 0, found < 0) == (value > 0, value < 0)
    unit = Fraction(2) ** (values.s - q)
    assert abs(value - found * unit) * 2**bits <= abs(found) * unit


@given(st.lists(st.lists(huge, max_size=6), max_size=4), cells, st.booleans(), st.integers(1, 300))
def test_values_of_several_polynomials_have_one_unit(
    polynomials: list[list[int]], cell: tuple[int, int], exact: bool, p: int
) -> None:
    """Their quotients by the value of 1 are what they are."""
    m, k = cell
    x = Fraction(2 * m + (not exact), 2 << k)
    *found, one = pure.enclosed([*polynomials, [1]], pure.Root(m, k, exact), p)
    assert 0 < (one.high - one.low) << p < one.low
    assert len(found) == len(polynomials)
    for polynomial, interval in zip(polynomials, found, strict=True):
        quotient = interval.over(one)
        assert quotient.low <= _value(polynomial, x) * (1 << p) <= quotient.high


def test_a_root_of_a_factor_is_seen_at_the_ends_of_its_cell() -> None:
    """x^2 - 2, 3 x - 1 and x - 3/2: roots that are exact, to the left, within and to the right of cells."""
    for k in (32, 300):
        exact, one = pure.Root(3 << (k - 1), k, True), 1 << k
        third = pure.Root((1 << k) // 3, k, False)
        assert pure.has_root([-3, 2], exact)
        assert not pure.has_root([-4, 2], exact)
        assert pure.has_root([-1, 3], third)
        for shift in (-one, -2, -1, 1, 2, one):
            assert not pure.has_root([-1, 3], third._replace(m=third.m + shift))
        assert pure.has_root([1, -3], third)
        assert not pure.has_root([-2, 0, 1], third)


@given(st.tuples(*[integers] * 4), st.tuples(integers, integers, st.integers(1, 10**6), integers))
def test_intervals_contain_what_they_must(ends: tuple[int, ...], others: tuple[int, ...]) -> None:
    p = 10
    a, b = sorted(ends[:2])
    c, d = sorted(abs(x) + 1 for x in others[:2])
    one, other = pure.Interval(a, b, p), pure.Interval(c, d, p)
    for x in (Fraction(a, 1 << p), Fraction(b, 1 << p), Fraction(a + b, 2 << p)):
        for y in (Fraction(c, 1 << p), Fraction(d, 1 << p), Fraction(c + d, 2 << p)):
            for interval, value in (
                (one + other, x + y),
                (one - other, x - y),
                (one * other, x * y),
                (one.over(other), x / y),
                (ends[2] * one, ends[2] * x),
            ):
                assert interval.low <= value * (1 << p) <= interval.high
            root = other.root()
            assert root.low**2 <= y * (1 << (2 * p)) <= root.high**2


def test_determinants_without_division() -> None:
    random = Random(5)
    for size in (3, 6):
        rows = [[random.randrange(-9, 10) for _ in range(size)] for _ in range(size)]
        assert pure.determinant(rows) == int(fmpq_mat(rows).det().p)


@given(st.integers(1, 7), st.integers(1, 9), st.integers(0, 10**6), st.sampled_from([3, 10**40]))
def test_echelon_forms(height: int, width: int, seed: int, largest: int) -> None:
    """Of matrices of any rank, with small and with large entries."""
    random = Random(seed)
    rank = random.randrange(1, height + 1)
    left = [[random.randrange(-2, 3) for _ in range(rank)] for _ in range(height)]
    right = [[random.randrange(-largest, largest + 1) for _ in range(width)] for _ in range(rank)]
    rows = [
        [sum(x * y for x, y in zip(row, column, strict=True)) for column in zip(*right, strict=True)] for row in left
    ]
    found = pure.echelon_form([{(-place,): value for place, value in enumerate(row)} for row in rows])
    expected, number = fmpq_mat(rows).rref()
    assert len(found) == number
    for place, row in enumerate(found):
        lead = next(iter(row.values()))
        values = [Fraction(row.get((-column,), 0), lead) for column in range(width)]
        assert values == [Fraction(int(x.p), int(x.q)) for x in expected.tolist()[place]]
        assert lead > 0


@pytest.mark.parametrize("prime", pure.PRIMES)
def test_residues(prime: int) -> None:
    random = Random(6)
    g = [random.randrange(prime) for _ in range(5)] + [7]
    ring = pure.Residues(g, prime)
    a, b = ([random.randrange(prime) for _ in range(5)] for _ in range(2))
    product = (ring.element(a) * ring.element(b)).polynomial()
    assert product == pure.divided(pure.product(a, b, prime), pure.reduced(g, prime), prime)[1]
    inverse = pure.inverse_modulo(a, g, prime)
    with pytest.raises(ValueError, match="invertible"):
        pure.inverse_modulo(g, pure.product(g, a, prime), prime)
    assert (ring.element(a) * ring.element(inverse)).polynomial() == [1]


def test_its_primes_are_primes() -> None:
    """Lucas and Lehmer: 2^n - 1 is prime iff s(n - 2) = 0 modulo it, for s(0) = 4, s(i + 1) = s(i)^2 - 2."""
    exponents = {prime.bit_length() for prime in pure.PRIMES} | {n for n in pure.MERSENNE if n < 5000}
    for n in sorted(exponents):
        s = 4
        for _ in range(n - 2):
            s = (s * s - 2) % ((1 << n) - 1)
        assert s == 0


def test_its_largest_primes_have_no_small_factors() -> None:
    """They are known; those of 2^n - 1, for a prime n, are 1 modulo 2 n."""
    for n in pure.MERSENNE:
        assert all(n % k for k in range(2, isqrt(n) + 1))
        assert all(pow(2, n, 2 * k * n + 1) != 1 for k in range(1, 1000) if 2 * k * n + 1 < (1 << n) - 1)


@pytest.mark.parametrize("power", [22, 30, 95])
def test_boxes_of_a_robot_in_huge_units_are_accepted_by_both(power: int) -> None:
    model = read_robot(Path(__file__).parent.parent / "models" / "3-rpr-merlet-p.toml")
    base, platform = (
        tuple(tuple(value * 10**power for value in joint) for joint in side)
        for side in (model.base_joints, model.platform_joints)
    )
    robot = Robot("large", "3-RPR", "m", "made up", base, platform)  # type: ignore[arg-type]
    squares = [square * 100**power for square in model.configuration().lengths_squared]
    data = canonical_bytes(certificate(robot, None, solve_krawczyk(robot.problem(squares))))
    assert json.loads(data)["method"] == "krawczyk"
    assert str(check_bytes(data).status) == str(pure.check_bytes(data).status) == "accepted"
