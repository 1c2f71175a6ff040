"""The plain checker of polynomial systems: certificates made by hand, and what it reads."""

from __future__ import annotations

import ast
import re
import subprocess
import sys
from math import comb
from pathlib import Path
from random import Random

import pytest
from forged_systems import FORGERIES, MALFORMED
from handmade_systems import SQUARES, handmade, represented, sealed_bytes, system_content

from pkm_exact.certify import pure, pure_system

MADE = handmade()
SOURCES = [Path(module.__file__) for module in (pure, pure_system)]


@pytest.mark.parametrize("name", MADE)
def test_certificates_made_by_hand_are_accepted(name: str) -> None:
    verdict = pure.check_bytes(sealed_bytes(MADE[name]))
    assert verdict.status == "accepted", verdict.lines
    assert verdict.lines[-1].startswith(MADE[name]["claim"][:8].replace("not-prov", "not prov"))


def test_both_files_run_alone(tmp_path: Path) -> None:
    (tmp_path / "good.json").write_bytes(sealed_bytes(MADE["groups"]))
    (tmp_path / "changed.json").write_bytes(sealed_bytes(MADE["groups"]).replace(b"by hand", b"by feet"))
    command = [sys.executable, "-I", "-S", "program.py", "good.json", "changed.json"]

    def run() -> str:
        done = subprocess.run(command, cwd=tmp_path, capture_output=True, text=True, check=False)
        assert done.stderr == ""
        return done.stdout

    (tmp_path / "program.py").write_bytes(SOURCES[0].read_bytes())
    assert "good.json: malformed" in run()
    (tmp_path / "pure_system.py").write_bytes(SOURCES[1].read_bytes())
    lines = run().splitlines()
    assert "good.json: accepted" in lines
    assert "changed.json: rejected" in lines


def test_it_imports_only_the_standard_library_and_the_first_file() -> None:
    for node in ast.walk(ast.parse(SOURCES[1].read_text())):
        names = [alias.name for alias in node.names] if isinstance(node, ast.Import) else []
        names += [str(node.module)] if isinstance(node, ast.ImportFrom) else []
        assert all(
            name.split(".")[0] in {*sys.stdlib_module_names, "pure"} or name == "pkm_exact.certify" for name in names
        )


BAD_TERMS = (
    "",
    "0",
    "0*x",
    "+x",
    "1*x",
    "-1*x",
    "01",
    "x^1",
    "x^02",
    "x*x",
    "y*x",
    "x*",
    "*x",
    "x y",
    "x**2",
    "2*3",
    "x*2",
    "z",
    "--x",
    "1/2*x",
    "1.5",
    "x^-1",
    "\u0661",
)


@pytest.mark.parametrize("term", BAD_TERMS)
def test_terms_have_one_spelling(term: str) -> None:
    content = system_content("x,y", SQUARES)
    content["polynomials"] = [["x^2*y", term] if term else [term]]
    assert pure.check_bytes(sealed_bytes(content)).status == "malformed"


def test_terms_decrease_and_are_few_and_of_low_degree() -> None:
    content = system_content("x,y", SQUARES)
    for terms, status in (
        (["x", "x^2"], "malformed"),
        (["y", "x"], "malformed"),
        (["x*y", "x^2"], "malformed"),
        (["x", "x"], "malformed"),
        ([], "malformed"),
        (["x^64*y"], "too-large"),
        (["9" * 4001], "too-large"),
        (["9" * 4000], "accepted"),
    ):
        content["polynomials"] = [terms]
        assert pure.check_bytes(sealed_bytes(content)).status == status, terms


def test_numbers_of_homogeneous_polynomials() -> None:
    """Complete intersections have the product of the degrees; what is known by theory in a few other cases."""
    random = Random(5)
    for degrees in ((2, 2), (2, 3, 2), (1, 2, 3), (4, 3), (2, 2, 2, 2)):
        forms = []
        for degree in degrees:
            monomials = _monomials(len(degrees), degree)
            forms.append({m: random.randint(1, 10**6) for m in monomials})
        dimensions = pure_system.graded(len(degrees), forms, 1073741827, 2000)
        assert dimensions is not None
        product = 1
        for degree in degrees:
            product *= degree
        assert sum(dimensions) == product
        assert dimensions == dimensions[::-1]  # Gorenstein
        assert len(dimensions) == sum(degree - 1 for degree in degrees) + 1
    squares = [{(2, 0): 1}, {(1, 1): 1}, {(0, 2): 1}]
    assert pure_system.graded(2, squares, 1073741827, 2000) == [1, 2]
    assert pure_system.graded(2, squares[:2], 1073741827, 2000) is None
    assert pure_system.graded(2, squares[1:2], 1073741827, 2000) is None
    assert pure_system.graded(2, [{(0, 0): 3}, *squares], 1073741827, 2000) == []
    assert pure_system.graded(2, squares, 1073741827, 2) is None


def test_primes_follow_from_coefficients_of_any_length() -> None:
    primes = [pure_system.primes_of([{(1,): 10**5000 + k}]) for k in range(2)]
    assert len({p for each in primes for p in each}) == 6
    assert all(1 << 30 < p < 1 << 31 and p % 2 for each in primes for p in each)


def _monomials(number: int, degree: int) -> list[tuple[int, ...]]:
    if number == 1:
        return [(degree,)]
    return [(first, *rest) for first in range(degree + 1) for rest in _monomials(number - 1, degree - first)]


def test_multihomogeneous_numbers() -> None:
    """Of bilinear equations in groups of 2 and 3 unknowns a binomial coefficient; in one group that of Bezout."""
    bilinear = {tuple(int(k in pair) for k in range(5)): 1 for pair in ((0, 2), (1, 3), (0, 4))}
    assert pure_system.multihomogeneous([bilinear] * 5, [[0, 1], [2, 3, 4]]) == comb(5, 2)
    assert pure_system.multihomogeneous([bilinear] * 5, [[0, 1, 2, 3, 4]]) == 2**5


def test_ranks_are_found_where_roots_differ() -> None:
    """x^2 (x - 1), y^2 - y: the rank is 1 at x = 0 and 2 elsewhere, and h0 falls into factors."""
    found = represented([(0, 0), (0, 1), (1, 0), (1, 1)], (1, 2))
    h = [int(c, 16) for c in found["eliminant"]]
    numerators = tuple([int(c, 16) for c in each] for each in found["numerators"])
    points = pure_system.finite_points(pure.Representation((0, 0), (1, 2), h, numerators))
    forms = [pure_system.homogeneous(each) for each in ({(3, 0): 1, (2, 0): -1}, {(0, 2): 1, (0, 1): -1})]
    weights = pure_system.weighed(pure_system.Slopes(points, forms, (1, 2)), 2)
    assert weights.total == 6
    double = [factor for factor, weight in weights.parts if weight == 2]
    assert sum(len(factor) - 1 for factor in double) == 2
    for factor in double:
        assert all(pure.Fixed(factor, t, 0).at(t, 0, 1)[0] for t in (1, 3))


@pytest.mark.parametrize("name", FORGERIES)
def test_forged_certificates_are_rejected(name: str) -> None:
    make, reason = FORGERIES[name]
    verdict = pure.check_bytes(sealed_bytes(make()))
    assert verdict.status == "rejected", verdict.lines
    assert re.search(reason, verdict.lines[-1]), verdict.lines[-1]


@pytest.mark.parametrize("name", MALFORMED)
def test_malformed_certificates_are_malformed(name: str) -> None:
    assert pure.check_bytes(sealed_bytes(MALFORMED[name]())).status == "malformed"
