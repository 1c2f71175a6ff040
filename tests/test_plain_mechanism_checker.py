"""The plain checker of version 2 answers what the first one answers: honest certificates and forged ones."""

from __future__ import annotations

import ast
import re
import subprocess
import sys
from collections.abc import Callable
from fractions import Fraction
from pathlib import Path

import pytest
from certificate_tools import both
from flint import fmpq, fmpq_mat, fmpq_poly, fmpz_poly
from forged_infinity import (
    Content,
    changed_points,
    eliminant_of,
    factors_of,
    infinity_of,
    isotropic_points,
    points_at,
)
from held_mechanisms import Pose, listing
from mechanism_certificates import MADE, mechanism_bytes, mechanism_content
from mechanisms import random_vectors, vector

from pkm_exact.certify import check, pure, pure_mechanism
from pkm_exact.certify.build import canonical_bytes, sealed
from pkm_exact.certify.build_constraints import constraint_entry
from pkm_exact.certify.check import check_bytes
from pkm_exact.certify.checker import mechanism_section
from pkm_exact.certify.checker.mechanism_document import read_mechanism_document
from pkm_exact.certify.checker.solutions import PRIMES
from pkm_exact.constraints.angle import Angle
from pkm_exact.constraints.axis_distance import AxisDistance
from pkm_exact.constraints.constraint import Constraint
from pkm_exact.constraints.point_in_plane import Carries

SOURCES = [Path(module.__file__) for module in (pure, pure_mechanism)]
DEAR = ("3-RPS", "3-RPS, boxes")


@pytest.mark.parametrize("name", [pytest.param(n, marks=[pytest.mark.slow] * (n in DEAR)) for n in MADE])
def test_honest_certificates_are_accepted_with_the_same_lines(name: str) -> None:
    assert both(mechanism_bytes(name)).status == "accepted"


def test_both_files_run_alone(tmp_path: Path) -> None:
    (tmp_path / "good.json").write_bytes(mechanism_bytes("H4"))
    (tmp_path / "changed.json").write_bytes(mechanism_bytes("H4").replace(b"constraint 1", b"constraint 5"))
    command = [sys.executable, "-I", "-S", "program.py", "good.json", "changed.json"]

    def run() -> str:
        done = subprocess.run(command, cwd=tmp_path, capture_output=True, text=True, check=False)
        assert done.stderr == ""
        return done.stdout

    (tmp_path / "program.py").write_bytes(SOURCES[0].read_bytes())
    assert "good.json: malformed" in run()
    (tmp_path / "pure_mechanism.py").write_bytes(SOURCES[1].read_bytes())
    lines = run().splitlines()
    assert "good.json: accepted" in lines
    assert "changed.json: rejected" in lines


def test_they_import_only_the_standard_library_and_each_other() -> None:
    for source in SOURCES:
        for node in ast.walk(ast.parse(source.read_text())):
            names = [alias.name for alias in node.names] if isinstance(node, ast.Import) else []
            names += [str(node.module)] if isinstance(node, ast.ImportFrom) else []
            own = ("pkm_exact.certify", "pure") if source == SOURCES[1] else ()
            assert all(name.split(".")[0] in sys.stdlib_module_names or name in own for name in names)


# Forged certificates: consistent in all else, the digest computed again


def _refused(content: Content, reason: str) -> None:
    """Both reject, each for this reason."""
    data = canonical_bytes(sealed(content))
    one, other = check_bytes(data), pure.check_bytes(data)
    assert (str(one.status), other.status) == ("rejected", "rejected"), (one.lines, other.lines)
    for line in (one.lines[-1], other.lines[-1]):
        assert re.search(reason, line), (one.lines[-1], other.lines[-1])


def _constraint(content: Content, number: int) -> Content:
    constraint: Content = content["robot"]["constraints"][number]
    return constraint


def test_a_form_is_not_that_of_its_data() -> None:
    for number in range(17):
        content = mechanism_content("Delta")
        form = _constraint(content, 1)["forms"][0]
        form[number] = str(Fraction(form[number]) + 1)
        _refused(content, "its forms are not those of its data")


def test_a_quadric_is_not_that_of_its_data() -> None:
    content = mechanism_content("cylinders")
    forms = _constraint(content, 1)["forms"]
    forms.reverse()
    _refused(content, "its forms are not those of its data")


def test_a_constraint_is_changed() -> None:
    content = mechanism_content("Delta")
    leg = _constraint(content, 1)
    leg["length_squared"] = str(Fraction(leg["length_squared"]) + 1)
    leg["forms"][0][16] = str(Fraction(leg["forms"][0][16]) - 1)
    _refused(content, "constraints: .* every solution")
    content = mechanism_content("cylinders")
    cylinder = _constraint(content, 2)
    cylinder["radius_squared"] = str(Fraction(cylinder["radius_squared"]) + 1)
    cylinder["forms"][0][16] = str(Fraction(cylinder["forms"][0][16]) - 1)
    _refused(content, "constraints: .* every solution")


@pytest.mark.parametrize(("name", "motion"), [("H4", "translation"), ("about a point", "planar"), ("H4", "planar")])
def test_poses_are_not_of_the_motion(name: str, motion: str) -> None:
    content = mechanism_content(name)
    content["robot"]["motion"] = motion
    _refused(content, "motion: a coordinate")


def test_a_motion_has_more_freedoms_than_claimed() -> None:
    content = mechanism_content("H4")
    content["robot"]["motion"] = "spatial"
    _refused(content, "claim: complete by refined-bezout, but what is proved is not-proven-complete")


ROUTES = ("refined-bezout", "product-bound", "modular-rank", "counting-at-infinity", "exact-elimination", None)


@pytest.mark.parametrize("name", ["H4", "six planes", "point and spheres", "planar lines, boxes"])
def test_another_claim_or_route(name: str) -> None:
    content = mechanism_content(name)
    right = content["completeness_route"]
    for route in ROUTES:
        if route not in (right, "modular-rank"):
            _refused(content | {"completeness_route": route}, "claim|complet")
    for claim in ("inconsistent", "positive-dimensional-proved", "positive-dimensional-detected"):
        _refused(content | {"claim": claim}, "claim|method")
    weaker = content | {"claim": "not-proven-complete", "completeness_route": None}
    if right == "modular-rank":
        assert both(canonical_bytes(sealed(weaker))).status == "accepted"
    else:
        _refused(weaker, "claim: not-proven-complete")


def test_modular_rank_where_a_product_bound_proves_as_much() -> None:
    _refused(
        mechanism_content("six planes") | {"completeness_route": "modular-rank"}, "claim: complete by modular-rank"
    )


@pytest.mark.parametrize("name", ["Delta", "planar lines, boxes", "point and spheres"])
def test_the_numbers_of_solutions_are_wrong(name: str) -> None:
    for key in ("complex_solutions", "distinct_solutions", "real_poses"):
        for step in (-1, 1):
            content = mechanism_content(name)
            content[key] += step if content[key] else 1
            _refused(content, "solutions|real poses")


def test_multiplicities_are_wrong() -> None:
    for name, wrong in (("more legs than freedoms, a multiple solution", (1, 3, None)), ("3-PSS+C", (2,))):
        for value in wrong:
            content = mechanism_content(name)
            content["poses"][0]["multiplicity"] = value
            _refused(content, "multiplicity: that of pose 1")
    content = mechanism_content("more legs than freedoms, a multiple solution")
    content["poses"][0]["multiplicity"] = 1
    _refused(content | {"complex_solutions": 1}, "complex solutions: 1 claimed, 2 proved")


def test_the_elimination_ends_too_early() -> None:
    content = mechanism_content("3-PSS+C")
    content["elimination"].pop()
    _refused(content, "elimination: it leaves")


def test_a_box_is_moved_or_left_out() -> None:
    content = mechanism_content("cylinders, boxes")
    centre = content["krawczyk"]["real"][0]["centre"]
    centre[5] = hex(int(centre[5], 16) + 1)
    _refused(content, "boxes: .*real box 1.* not the grid point nearest")
    content = mechanism_content("cylinders, boxes")
    content["krawczyk"]["chart"] = [1, 1, 0, 0]
    _refused(content, "boxes: the chart")
    content = mechanism_content("cylinders, boxes")
    del content["krawczyk"]["real"][0], content["poses"][0]
    for key in ("complex_solutions", "distinct_solutions", "real_poses"):
        content[key] -= 1
    _refused(content, "claim: .*not-proven-complete")


# Points at infinity


def _at_infinity(change: Callable[[Content], Content]) -> Content:
    content = mechanism_content("3-RPS")
    return content | {"infinity": change(content["infinity"])}


def _kept(infinity: Content, multiplicity: int) -> Content:
    """All points but two conjugate ones."""
    parts = [(factor, points_at(infinity, factor)) for factor in factors_of(infinity)[1:]]
    return infinity_of(parts, infinity["chart"], infinity["separating_form"], multiplicity)


def test_the_points_are_put_together_as_they_were() -> None:
    content = mechanism_content("3-RPS")
    infinity = content["infinity"]
    parts = [(factor, points_at(infinity, factor)) for factor in factors_of(infinity)]
    assert infinity_of(parts, infinity["chart"], infinity["separating_form"], infinity["multiplicity"]) == infinity


def test_a_point_at_infinity_is_dropped() -> None:
    _refused(_at_infinity(lambda infinity: _kept(infinity, 20)), "infinity: 16 (finite|solutions) and 20 at infinity")


def test_points_count_more_than_they_are_proved_to() -> None:
    _refused(_at_infinity(lambda infinity: _kept(infinity, 24)), "infinity: (multiplicity )?24")
    for wrong in (12, 23, 25):
        _refused(_at_infinity(lambda infinity, wrong=wrong: infinity | {"multiplicity": wrong}), f"infinity: .*{wrong}")


def test_a_regular_point_is_counted_twice() -> None:
    content = mechanism_content("3-PSS+C, general")
    infinity = content["infinity"]
    degree, singular = 12, 4
    assert (eliminant_of(infinity).degree(), infinity["multiplicity"]) == (degree, degree + singular)
    regular = []
    for factor in factors_of(infinity):
        rest = [other for other in factors_of(infinity) if other != factor]
        parts = [(other, points_at(infinity, other)) for other in rest]
        left = infinity_of(parts, infinity["chart"], infinity["separating_form"], infinity["multiplicity"])
        _refused(content | {"infinity": left}, "infinity: (multiplicity )?16")
        regular.append(left)
    assert regular
    _refused(content | {"infinity": infinity | {"multiplicity": 2 * degree}}, "infinity: (multiplicity )?24")


def test_a_point_at_infinity_is_listed_twice() -> None:
    def doubled(infinity: Content) -> Content:
        first, *others = [(factor, points_at(infinity, factor)) for factor in factors_of(infinity)]
        shift = fmpz_poly([-7, 1])
        moved = (first[0](shift), [value(fmpq_poly(shift)) for value in first[1]])
        return infinity_of([first, moved, *others[1:]], infinity["chart"], infinity["separating_form"], 24)

    _refused(_at_infinity(doubled), "infinity: .*separating form")


def test_a_point_at_infinity_is_moved_off_the_motions() -> None:
    content = mechanism_content("3-RPS")
    infinity = content["infinity"]
    forms = [_constraint(content, k)["forms"][0][:16] for k in range(6)]
    rows = [[Fraction(value) for value in row] for row in (*forms, infinity["chart"], infinity["separating_form"])]
    kernel = fmpq_mat([[fmpq(x.numerator, x.denominator) for x in row] for row in rows]).rref()[0]
    pivots = [next(j for j in range(16) if kernel[i, j]) for i in range(len(rows)) if any(kernel.tolist()[i])]
    free = next(j for j in range(16) if j not in pivots)
    vector = [fmpq(0)] * 16
    vector[free] = fmpq(1)
    for row, pivot in enumerate(pivots):
        vector[pivot] = -kernel[row, free]
    moved = changed_points(infinity, lambda z: [value + x for value, x in zip(z, vector, strict=True)])
    _refused(content | {"infinity": moved}, "infinity: a point is not .* rigid motions")


def test_a_point_at_infinity_is_moved_off_the_constraints() -> None:
    """The base moves by (0, 0, 3), which takes motions to motions: s + 2 t.C, u + G^-1 R^T G t, C, R."""

    def moved(z: list[fmpq_poly]) -> list[fmpq_poly]:
        turned = [z[1] + 3 * z[13], z[2] + z[14], z[3] + 3 * z[15]]
        return [z[0] + 6 * z[6], *turned, *z[4:]]

    def moved_back(w: list[int]) -> list[int]:
        """The same values on what was moved."""
        back = list(w)
        for place, other, factor in ((0, 6, 6), (1, 13, 3), (2, 14, 1), (3, 15, 3)):
            back[other] -= factor * w[place]
        return back

    content = mechanism_content("3-RPS")
    infinity = content["infinity"]
    forged = changed_points(infinity, moved, infinity["chart"])
    forged |= {key: moved_back(infinity[key]) for key in ("chart", "separating_form")}
    _refused(content | {"infinity": forged}, "infinity: a (point is not on all constraints|linear form is not 0)")


def _inconsistent(constraints: list[Constraint], infinity: Content) -> Content:
    content = mechanism_content("contradictory leg")
    entries = [constraint_entry(constraint, (1, 1, 1)) for constraint in constraints]
    content["robot"] |= {"motion": "spatial", "metric": ["1", "1", "1"], "constraints": entries}
    return content | {"completeness_route": "counting-at-infinity", "infinity": infinity}


def _planes_of_platform() -> list[Constraint]:
    """Twelve points of the base that are in planes of the platform where it is, at C = 0, R = 1."""
    draw = random_vectors(1)
    pairs = [(draw(), draw()) for _ in range(12)]
    return [Carries(m, sum((x * y for x, y in zip(m, a, strict=True)), Fraction(0)), a) for m, a in pairs]


def test_the_section_is_not_finite() -> None:
    """Twenty singular points count 40, on a robot that has a real pose: it would be inconsistent."""
    content = _inconsistent(_planes_of_platform(), isotropic_points())
    _refused(content, "not proved (that the section is )?finite")


@pytest.mark.slow
def test_a_section_of_many_dimensions_is_too_large() -> None:
    one = (Fraction(1), Fraction(0), Fraction(0))
    data = canonical_bytes(sealed(_inconsistent([Angle(one, one, Fraction(1))], isotropic_points())))
    for checker in (pure, check):
        verdict, work = checker.check_counted(data)
        assert verdict.status == "too-large"
        assert work.spent > 0


def test_no_robot_is_built_on_the_primes_of_either_checker() -> None:
    found: set[int] = set()
    for name in ("3-RPS", "3-PSS+C, general", "cylinders"):
        content = mechanism_content(name)
        del content["digest"]
        first = mechanism_section._primes(read_mechanism_document(content).mechanism)
        second = pure_mechanism.primes_of(pure_mechanism.read(content).robot)
        assert len({*first, *second}) == 6
        assert not found & {*first, *second, *PRIMES, *pure.PRIMES}
        found |= {*first, *second}


def test_points_at_infinity_are_counted_for_spatial_motions_without_cylinders_only() -> None:
    content = _inconsistent(_planes_of_platform(), isotropic_points())
    content["robot"]["motion"] = "schoenflies"
    _refused(content, "infinity: .*spatial motions")
    zero, axis = vector(0, 0, 0), vector(0, 0, 1)
    planes, cylinder = _planes_of_platform(), AxisDistance(zero, axis, zero, Fraction(1))
    content = _inconsistent([*planes[:6], cylinder], isotropic_points())
    _refused(content, "infinity: .*cylinders")


# Self-motions


@pytest.mark.parametrize("name", ["few legs", "few legs, real", "joints on a line", "parallelogram", "slices"])
def test_what_is_said_of_real_poses_is_wrong(name: str) -> None:
    content = mechanism_content(name)
    content["self_motion"]["real"] = not content["self_motion"]["real"]
    _refused(content, "self-motion: what is claimed of real poses")


@pytest.mark.parametrize(
    ("name", "cause"),
    [
        ("few legs", "symmetry"),
        ("few legs", "equal-legs"),
        ("joints on a line", "equal-legs"),
        ("joints on a line", "dependent-forms"),
        ("parallelogram", "symmetry"),
        ("parallelogram", "dependent-forms"),
        ("parallelogram", "more-poses-than-bound"),
        ("slices", "equal-legs"),
    ],
)
def test_another_cause(name: str, cause: str) -> None:
    content = mechanism_content(name)
    content["self_motion"]["cause"] = cause
    _refused(content, "self-motion")


def test_a_robot_that_does_not_move() -> None:
    for name in ("H4", "planar lines"):
        content = mechanism_content(name)
        none = dict.fromkeys(("complex_solutions", "distinct_solutions", "real_poses", "box_exponent"), 0)
        content |= {"claim": "positive-dimensional-proved", "completeness_route": None, "poses": [], **none}
        for cause in ("symmetry", "dependent-forms", "equal-legs"):
            motion = {"cause": cause, "real": True, "forms": [], "slices": []}
            _refused(content | {"self_motion": motion}, "self-motion")


def test_slices_that_prove_nothing() -> None:
    def slices(change: Callable[[list[Content]], list[Content]]) -> Content:
        content = mechanism_content("slices")
        content["self_motion"]["slices"] = change(content["self_motion"]["slices"])
        return content

    _refused(slices(lambda cuts: cuts[:-1]), "self-motion: 6 poses")
    _refused(slices(lambda cuts: [*cuts[:-1], cuts[-2]]), "self-motion: the constants")
    _refused(slices(lambda cuts: cuts[::-1]), "self-motion: the constants")
    for number in range(4):
        content = mechanism_content("slices")
        cut = content["self_motion"]["slices"][number]
        cut["constant"] = str(Fraction(cut["constant"]) + Fraction(1, 1000))
        _refused(content, "constraints: .* every solution")
    content = mechanism_content("slices")
    form = content["self_motion"]["forms"][-1]
    form[16] = str(Fraction(form[16]) + 1)
    _refused(content, "constraints: .* every solution")


def test_poses_are_listed_beside_a_motion() -> None:
    content = mechanism_content("few legs")
    _refused(content | {"complex_solutions": 1, "distinct_solutions": 1}, "claim: beside positive dimension")
    _refused(content | {"completeness_route": "modular-rank"}, "claim: beside positive dimension")


# What no certificate shows of itself


def test_a_determinant_may_be_as_large_as_its_bound() -> None:
    """The modulus is larger: this one is 0 modulo 2^127 - 1."""
    at = Pose((1, 0, 0, 0), (0, 0, 0, 0))
    normals = [(1, 0, 0), (0, 1, 0), (0, 0, (1 << 127) - 1)]
    certificate = pure_mechanism.read(listing("translation", [at], [at.in_plane(n, (1, 1, 1)) for n in normals]))
    slopes, shown = pure_mechanism.Slopes(certificate.robot), certificate.representation
    assert shown is not None
    (value,) = pure_mechanism.large_determinants(slopes, shown, [0, 1], None)
    assert any(value)


@pytest.mark.parametrize(
    ("metric", "place", "exponent"),
    [((1, 1, 1), 7, 200), ((1, 1, 1 << 60), 6, 20)],
    ids=["products are as large as squares", "the metric is large in one place"],
)
def test_a_point_that_is_none_is_not_hidden_by_its_size(metric: pure.Metric, place: int, exponent: int) -> None:
    """At the root 0 a coordinate, and with it a quadric, is a multiple of a large power of 2."""
    numerators = tuple([1 << exponent] if place == k else [] for k in range(16))
    point = pure_mechanism.PointsAtInfinity((0,) * 16, (0,) * 16, [0, 1], numerators, 1)
    with pytest.raises(pure.Refusal, match="limit of rigid motions"):
        pure_mechanism.check_points_on_motions(point, metric)


def test_a_common_factor_modulo_a_prime_is_none_of_the_eliminant() -> None:
    """T divides T + p modulo p = 2^61 - 1, the first prime that is tried, alone."""
    assert pure_mechanism.degree_of_common_roots([(1 << 61) - 1, 1], [[0, 1]]) == 0
