"""A step that returns something wrong never leads to an answer: one fault at a time, in both engines."""

import json
import pickle
import re
import sys
from collections.abc import Callable, Sequence
from dataclasses import replace
from fractions import Fraction
from importlib import import_module
from pathlib import Path
from typing import Any

import pytest
from flint import fmpz_poly
from hypothesis import given
from hypothesis import strategies as st
from samples import shipped, solved

from pkm_exact import Policy, Tolerances, solve, solve_krawczyk, tolerance_boxes
from pkm_exact.claim import Claim, CompletenessRoute
from pkm_exact.cli.main import main
from pkm_exact.engine import _Run
from pkm_exact.errors import InternalContradictionError, InternalError, PkmExactError, UnexpectedError
from pkm_exact.failures.contradiction import require
from pkm_exact.failures.failure_report import internal_error, reported
from pkm_exact.final_checks import consistent
from pkm_exact.numeric.double_boxes import DoubleBoxes
from pkm_exact.numeric.fallback import solve_within
from pkm_exact.poses.isolated_solutions import IsolatedSolutions
from pkm_exact.poses.pose import Interval, Pose
from pkm_exact.poses.pose_consistency import require_degree_zero
from pkm_exact.poses.self_motion import Cause, Mobility, SelfMotion
from pkm_exact.roots.counting import roots_in_gaps
from pkm_exact.solution import Solution

ROOT = Path(__file__).parent.parent
MODEL = ROOT / "models" / "3-rpr-merlet-p.toml"
Capture = pytest.CaptureFixture[str]
Patch = pytest.MonkeyPatch

Fault = tuple[str, str, str, Callable[[Any], Any]]
"""A robot, a module, a function in it (or Class.method), and how its result is made wrong."""


def _less(values: Sequence[Any]) -> Any:
    return type(values)(values[1:])


def _without_middle_pair(values: Sequence[Any]) -> Any:
    return type(values)([*values[:1], *values[3:]])


def _doubled(values: Sequence[Any]) -> Any:
    return type(values)([*values, values[-1]])


def _exchanged(values: Sequence[Any]) -> Any:
    return type(values)([values[1], values[0], *values[2:]])


def _cells(change: Callable[[list[Any]], list[Any]]) -> Callable[[Any], Any]:
    return lambda found: (found[0], change(found[1]))


def _first(change: Callable[[Any], Any]) -> Callable[[Any], Any]:
    return lambda values: type(values)([change(values[0]), *values[1:]])


def _numerator(index: int) -> Callable[[Any], Any]:
    def change(found: Any) -> Any:
        univariate = found.univariate
        numerators = list(univariate.numerators)
        numerators[index] = (numerators[index][0] + 1, *numerators[index][1:])
        return replace(found, univariate=replace(univariate, numerators=tuple(numerators)))

    return change


def _eliminant(found: Any) -> Any:
    first, *rest = found.univariate.eliminant
    return replace(found, univariate=replace(found.univariate, eliminant=(first + 1, *rest)))


def _multiplied(found: Any) -> Any:
    if found is None or not found.multiplicities:
        return found
    (factor, multiplicity), *rest = found.multiplicities
    return replace(found, multiplicities=((factor, multiplicity + 1), *rest))


def _at_five(found: Any) -> Any:
    """The poses with a first coordinate of 5: the rational pose of Merlet's robot."""
    return replace(found, algebra=found.algebra.quotient_by(found.position[0] - found.algebra.one * 5))


SEARCH = "pkm_exact.poses.search"
L, P, S, Q, T = "mourrain-l", "3-rpr-merlet-p", "similar-planar-s", "3-rpr-double-q", "3-rpr-triple"
D = "dietmaier"
EXACT: dict[str, Fault] = {
    "a real root is dropped": (L, "pkm_exact.poses.boxes", "isolated_and_enclosed", _less),
    "two neighbouring real roots are dropped": (
        D,
        "pkm_exact.poses.boxes",
        "isolated_and_enclosed",
        _without_middle_pair,
    ),
    "all real roots are dropped": (L, "pkm_exact.poses.boxes", "isolated_and_enclosed", lambda roots: roots[:0]),
    "a real root is doubled": (L, "pkm_exact.poses.boxes", "isolated_and_enclosed", _doubled),
    "enclosures lack a real root": (P, "pkm_exact.roots.isolation", "real_root_enclosures", _less),
    "enclosures near known roots lack one": (L, "pkm_exact.roots.isolation", "enclosures_near", _less),
    "two roots change places": (L, "pkm_exact.poses.boxes", "refined_enclosures", _exchanged),
    "two poses change places": (L, "pkm_exact.poses.boxes", "disjoint_cells", _cells(_exchanged)),
    "a box is there twice": (P, "pkm_exact.poses.boxes", "disjoint_cells", _cells(lambda rows: [rows[0], rows[0]])),
    "a coordinate is off": (
        L,
        "pkm_exact.poses.boxes",
        "disjoint_cells",
        _cells(_first(lambda row: [Interval(row[0].lo + 1, row[0].hi + 1), *row[1:]])),
    ),
    "rows and columns change places": (
        L,
        "pkm_exact.poses.boxes",
        "disjoint_cells",
        _cells(
            lambda rows: [
                [*row[:3], *(row[3 + 3 * j + i] for i in range(3) for j in range(3)), *row[12:]] for row in rows
            ]
        ),
    ),
    "quaternions have the other sign": (
        L,
        "pkm_exact.poses.boxes",
        "disjoint_cells",
        _cells(lambda rows: [[*row[:12], *(Interval(-entry.hi, -entry.lo) for entry in row[12:])] for row in rows]),
    ),
    "a coefficient of a rotation is wrong": (P, SEARCH, "pose_representation", _numerator(3)),
    "a coefficient of a translation is wrong": (P, SEARCH, "pose_representation", _numerator(5)),
    "a coefficient of the eliminant is wrong": (P, SEARCH, "pose_representation", _eliminant),
    "the coefficient goes wrong after verification": (
        P,
        SEARCH,
        "PoseSearch.representation",
        _numerator(6),
    ),
    "the eliminant goes wrong after verification": (
        P,
        SEARCH,
        "PoseSearch.representation",
        _eliminant,
    ),
    "the chart goes wrong after verification": (
        L,
        SEARCH,
        "PoseSearch.representation",
        lambda found: replace(found, chart=(0, 0, 1, 1)),
    ),
    "a determinant changes sign": (
        L,
        "pkm_exact.engine",
        "pose_jacobians",
        _first(lambda jacobian: replace(jacobian, det_sign=-jacobian.det_sign)),
    ),
    "a rank is too small": (L, "pkm_exact.engine", "pose_jacobians", _first(lambda j: replace(j, rank=5))),
    "a rank at a singular pose is too great": (
        Q,
        "pkm_exact.engine",
        "pose_jacobians",
        _first(lambda j: replace(j, rank=3)),
    ),
    "two Jacobians change places": (
        P,
        "pkm_exact.engine",
        "pose_jacobians",
        lambda js: [js[0], replace(js[1], det_sign=js[0].det_sign)],
    ),
    "a multiplicity is wrong": (T, "pkm_exact.engine", "prove_complete", _multiplied),
    "multiplicities are too small": (
        T,
        "pkm_exact.completeness.completeness_proof",
        "exact_multiplicities",
        lambda found: tuple((factor, 1) for factor, _ in found),
    ),
    "the bound is too small": (
        S,
        "pkm_exact.completeness.completeness_proof",
        "solution_bound",
        lambda bound: bound - 1,
    ),
    "the trace form has too small a rank": (
        T,
        "pkm_exact.algebra.exact_quotient",
        "exact_quotient",
        lambda quotient: replace(quotient, unknowns=tuple(matrix * 0 for matrix in quotient.unknowns)),
    ),
    "Bezout is claimed of too few": (
        S,
        "pkm_exact.engine",
        "prove_complete",
        lambda proof: replace(proof, route=CompletenessRoute.REFINED_BEZOUT),
    ),
    "the proof is one of more solutions": (
        S,
        "pkm_exact.engine",
        "prove_complete",
        lambda proof: replace(proof, total=17),
    ),
    "there are too many poses modulo a prime": (
        L,
        "pkm_exact.poses.modular",
        "ModularPoses.distinct_poses",
        lambda n: n + 1,
    ),
    "all poses but one are lost modulo a prime": (P, "pkm_exact.poses.modular_start", "modular_poses", _at_five),
}
"""What is wrong: a robot, the module and function, and the change of its result."""
OF_ELIMINATIONS = ("the chart goes wrong after verification", "there are too many poses modulo a prime")
"""Where a general robot needs no elimination, these steps are not taken."""


def _wrong(patch: Patch, module: str, name: str, change: Callable[[Any], Any]) -> list[int]:
    """Patch a function, or a method written Class.method; counts the calls."""
    owner: Any = import_module(module)
    *outer, name = name.split(".")
    for part in outer:
        owner = getattr(owner, part)
    right, calls = getattr(owner, name), [0]

    def wrong(*arguments: Any, **options: Any) -> Any:
        calls[0] += 1
        return change(right(*arguments, **options))

    patch.setattr(owner, name, wrong)
    return calls


@pytest.mark.parametrize("fault", EXACT)
def test_a_wrong_step_of_the_exact_engine_gives_no_answer(fault: str, monkeypatch: Patch) -> None:
    robot, module, name, change = EXACT[fault]
    problem = shipped(robot)
    calls = _wrong(monkeypatch, module, name, change)
    with pytest.raises(PkmExactError):
        solve(problem, policy=Policy(lifting_bits=1 << 15, eliminate=fault in OF_ELIMINATIONS))
    assert calls[0], "the step was not taken"


def _boxes(change: Callable[[IsolatedSolutions], IsolatedSolutions]) -> Callable[[Any], Any]:
    return lambda found: (change(found[0]), *found[1:])


def _poses(change: Callable[[tuple[Pose, ...]], tuple[Pose, ...]]) -> Callable[[Any], Any]:
    return lambda found: (*found[:2], change(found[2]))


KRAWCZYK: dict[str, tuple[str, Callable[[Any], Any]]] = {
    "a pose is dropped": ("real_poses", _poses(_less)),
    "two poses change places": (
        "real_poses",
        _poses(lambda poses: tuple(replace(pose, rotation=poses[0].rotation) for pose in poses)),
    ),
    "a pose is there twice": ("real_poses", _poses(lambda poses: (poses[0], *poses[:1], *poses[2:]))),
    "a determinant changes sign": (
        "real_poses",
        _poses(_first(lambda p: replace(p, jacobian=replace(p.jacobian, det_sign=-p.jacobian.det_sign)))),
    ),
    "a real box is there twice": (
        "real_poses",
        _boxes(lambda boxes: replace(boxes, real=(boxes.real[0], *boxes.real[:-1]))),
    ),
    "a pair is there twice": (
        "real_poses",
        _boxes(lambda boxes: replace(boxes, pairs=(boxes.pairs[0], *boxes.pairs[:-1]))),
    ),
    "a pair is conjugate to another": (
        "real_poses",
        _boxes(lambda boxes: replace(boxes, pairs=(boxes.pairs[1].conjugate(), *boxes.pairs[1:]))),
    ),
    "a real solution is taken for a pair": (
        "real_poses",
        _boxes(lambda boxes: replace(boxes, real=boxes.real[2:], pairs=(boxes.real[0], *boxes.pairs))),
    ),
    "there are too many": (
        "certified_solutions",
        lambda found: (found[0], replace(found[1], pairs=(*found[1].pairs, found[1].pairs[0]))),
    ),
}


@pytest.mark.parametrize("fault", KRAWCZYK)
def test_a_wrong_step_of_the_numeric_engine_gives_no_answer(fault: str, monkeypatch: Patch) -> None:
    name, change = KRAWCZYK[fault]
    calls = _wrong(monkeypatch, "pkm_exact.numeric_engine", name, change)
    with pytest.raises(InternalContradictionError):
        solve_krawczyk(shipped(L))
    assert calls[0]


@pytest.mark.parametrize("is_real", [True, False])
@pytest.mark.parametrize("in_doubles", [True, False])
def test_wrong_boxes_that_are_believed_give_no_answer(is_real: bool, in_doubles: bool, monkeypatch: Patch) -> None:
    certification = import_module("pkm_exact.numeric.certification")
    doubles = import_module("pkm_exact.numeric.double_boxes")
    right = doubles.box_at if in_doubles else certification.nearest_box

    def aside(*arguments: Any) -> Any:
        box = right(*arguments)
        first, (real, imaginary), *rest = box.centre
        return replace(box, centre=(first, (real + 1000, imaginary), *rest)) if box.is_real == is_real else box

    if in_doubles:
        monkeypatch.setattr(doubles, "box_at", aside)
    else:
        monkeypatch.setattr(certification, "_in_doubles", lambda _, points, __: DoubleBoxes.none(points))
        monkeypatch.setattr(certification, "nearest_box", aside)
    monkeypatch.setattr(certification, "certified", lambda _, boxes: [True] * len(boxes))
    with pytest.raises(InternalContradictionError):
        solve_krawczyk(shipped(L))


def test_wrong_bounds_of_tolerances_give_no_answer(monkeypatch: Patch) -> None:
    def aside(bounds: Any) -> Any:
        first, *rest = bounds.components
        return replace(bounds, components=(Interval(first.hi + 1, first.hi + 2), *rest))

    calls = _wrong(monkeypatch, "pkm_exact.numeric.tolerance", "pose_bounds", aside)
    with pytest.raises(PkmExactError):
        tolerance_boxes(shipped(P), Tolerances.uniform("0.0001"), solved(P))
    assert calls[0]


@pytest.mark.parametrize("count", [1, 3])
def test_a_lost_approximation_gives_the_answer_of_the_exact_engine(count: int, monkeypatch: Patch) -> None:
    """Fewer boxes than the degree prove nothing: that is no contradiction, and no answer of the numeric engine."""
    calls = _wrong(
        monkeypatch,
        "pkm_exact.numeric_engine",
        "certified_solutions",
        lambda found: (found[0], replace(found[1], pairs=found[1].pairs[count:])),
    )
    answer = solve_krawczyk(shipped(P))
    assert calls[0]
    assert (answer.method, answer.poses) == ("exact", solved(P).poses)


def test_a_wrong_rank_of_the_legs_is_no_self_motion(monkeypatch: Patch) -> None:
    """No pose has the lengths of a further random leg too; and if one were made up, the rank modulo a prime tells."""
    bound = Mobility(1, 5, (Cause.DEPENDENT_LEGS,))
    monkeypatch.setattr("pkm_exact.engine.mobility", lambda _: bound)
    assert solve(shipped(P)).poses == solved(P).poses
    made_up = SelfMotion(bound, (), solved(L).representation)  # type: ignore[arg-type]
    monkeypatch.setattr(_Run, "_witnessed", lambda *_: made_up)
    with pytest.raises(InternalContradictionError, match="rank of the legs") as caught:
        solve(shipped(L))
    assert caught.value.facts == {"modular": 6, "said": 5}


CLAIMS: dict[str, Callable[[Solution], dict[str, Any]]] = {
    "complete without proof": lambda _: {"completeness": None},
    "weaker than proved": lambda _: {"claim": Claim.NOT_PROVEN_COMPLETE},
    "moving without proof": lambda _: {"claim": Claim.POSITIVE_DIMENSIONAL_PROVED, "completeness": None},
    "inconsistent with poses": lambda _: {"claim": Claim.INCONSISTENT},
    "one complex solution more": lambda solution: {"complex_solutions": solution.complex_solutions + 1},
    "one distinct solution less": lambda solution: {"distinct_solutions": solution.distinct_solutions - 1},
    "another robot": lambda _: {"problem": shipped("dietmaier")},
    "no poses": lambda _: {"poses": ()},
    "no Jacobian": lambda solution: {"poses": tuple(replace(pose, jacobian=None) for pose in solution.poses)},
    "no multiplicity": lambda solution: {"poses": tuple(replace(pose, multiplicity=None) for pose in solution.poses)},
    "double poses": lambda solution: {"poses": tuple(replace(pose, multiplicity=2) for pose in solution.poses)},
    "no parameter": lambda solution: {"poses": tuple(replace(pose, parameter=None) for pose in solution.poses)},
}


@pytest.mark.parametrize("change", CLAIMS)
def test_a_claim_that_does_not_fit_the_rest_is_refused(change: str) -> None:
    solution = solved(L)
    assert consistent(solution) is solution
    with pytest.raises(InternalContradictionError):
        consistent(replace(solution, **CLAIMS[change](solution)))


@given(st.lists(st.sampled_from([-1, 1]), max_size=8), st.lists(st.integers(2, 4), max_size=2))
def test_signs_that_do_not_cancel_are_refused(signs: list[int], multiple: list[int]) -> None:
    """A list is right only if local degrees that are odd or even as the multiplicities can bring the sum to 0."""
    some = solved(Q).poses[0]
    assert some.jacobian is not None
    poses = [replace(some, multiplicity=1, jacobian=replace(some.jacobian, det_sign=sign)) for sign in signs]
    poses += [replace(some, multiplicity=m) for m in multiple]
    sums = {sum(signs)}
    for m in multiple:
        sums = {total + degree for total in sums for degree in range(-m, m + 1, 2)}
    if 0 in sums:
        require_degree_zero(poses)
    else:
        with pytest.raises(InternalContradictionError, match="do not cancel"):
            require_degree_zero(poses)


@given(st.sets(st.fractions(-9, 9, max_denominator=50), max_size=5), st.sets(st.integers(0, 5)), st.booleans())
def test_the_second_count_never_errs(roots: set[Fraction], left_out: set[int], paired: bool) -> None:
    polynomial = fmpz_poly([3, 1, 5]) if paired else fmpz_poly([7])
    for root in roots:
        polynomial *= fmpz_poly([-root.numerator, root.denominator])
    tiny = Fraction(1, 10**6)
    kept = [root for number, root in enumerate(sorted(roots)) if number not in left_out]
    places = [Interval(root - tiny, root + tiny) for root in kept]
    ends = [None, *kept, None]
    for found, low, high in zip(roots_in_gaps(polynomial, places), ends, ends[1:], strict=False):
        inside = [root for root in roots if (low is None or low < root) and (high is None or root < high)]
        assert found is None or found == bool(inside)
    if not left_out:
        assert all(found is False for found in roots_in_gaps(polynomial, places))


def test_facts_are_kept_and_can_be_sent() -> None:
    with pytest.raises(InternalContradictionError, match="three is odd") as caught:
        require(3 % 2 == 0, "three is odd", number=3)
    sent = pickle.loads(pickle.dumps(internal_error(caught.value)))  # noqa: S301
    assert (type(sent), str(sent), sent.facts) == (InternalContradictionError, "three is odd", {"number": "3"})


@pytest.fixture
def folder(tmp_path: Path, monkeypatch: Patch) -> Path:
    """The current folder, empty."""
    monkeypatch.chdir(tmp_path)
    return tmp_path


def _only_report(folder: Path) -> dict[str, Any]:
    [path] = folder.iterdir()
    assert re.fullmatch(r"pkm_exact-report-[0-9a-f]{16}\.json", path.name)
    content: dict[str, Any] = json.loads(path.read_text(encoding="ascii"))
    return content


def _ends_with_a_report(words: list[str], folder: Path, capsys: Capture) -> dict[str, Any]:
    assert main(words) == 4
    out, err = capsys.readouterr()
    content = _only_report(folder)
    assert (out, err.count("\n")) == ("", 1)
    assert err.startswith("certify-poses: error: no answer: ")
    assert f"please attach the file {next(folder.iterdir()).name} to a bug report" in err
    return content


def test_a_contradiction_ends_with_a_report(folder: Path, capsys: Capture, monkeypatch: Patch) -> None:
    _wrong(monkeypatch, "pkm_exact.engine", "pose_jacobians", _first(lambda jacobian: replace(jacobian, rank=1)))
    report = _ends_with_a_report(["solve", str(MODEL), "-o", "never.json"], folder, capsys)
    assert (report["kind"], report["sentence"]) == ("contradiction", "sign and rank of a Jacobian disagree")
    assert report["facts"] | {"sign": "?"} == {"pose": "0", "rank": "1", "sign": "?", "multiplicity": "1"}
    assert report["options"]["formulation"] == "SE3"
    assert report["problem"]["lengths_squared"] == [str(leg.length_squared) for leg in shipped(P).distances]
    assert report["command"] == ["solve", MODEL.name, "-o", "never.json"]
    assert report["versions"]["python-flint"]
    assert any(frame.startswith("pkm_exact/engine.py:") for frame in report["frames"])


COMMANDS = {
    "pkm_exact.engine.solve": ["solve", str(MODEL)],
    "pkm_exact.numeric_engine.solve_krawczyk": ["solve", str(MODEL), "--method", "krawczyk"],
    "pkm_exact.numeric.newton_iteration.solve_newton": ["solve", str(MODEL), "--method", "newton"],
    "pkm_exact.certify.build.certificate_bytes": ["solve", str(MODEL), "-o", "never.json"],
    "pkm_exact.certify.check.check_bytes": ["check", str(ROOT / "certs" / "3-rrr.json")],
    "pkm_exact.certify.pure.check_bytes": ["check", "--pure", str(ROOT / "certs" / "3-rrr.json")],
    "pkm_exact.geometry.reader.read_any": ["solve", str(MODEL)],
    "pkm_exact.cli.report.report": ["solve", str(MODEL)],
}


@pytest.mark.parametrize("place", COMMANDS)
@pytest.mark.parametrize(
    "error", [ZeroDivisionError("x"), RecursionError(), AssertionError(), OverflowError("y"), KeyError("z")]
)
def test_any_failure_ends_with_a_report(
    place: str, error: Exception, folder: Path, capsys: Capture, monkeypatch: Patch
) -> None:
    def fails(*_: object, **__: object) -> None:
        raise type(error)(*error.args)  # a new one: what is joined to it stays

    module, name = place.rsplit(".", 1)
    monkeypatch.setattr(import_module(module), name, fails)
    report = _ends_with_a_report(COMMANDS[place], folder, capsys)
    assert report["kind"] == "unexpected"
    assert report["sentence"].startswith(type(error).__name__)
    is_about_a_robot = COMMANDS[place][0] == "solve" and not place.endswith("read_any")
    assert (report["problem"] is not None) == is_about_a_robot


def test_the_same_failure_gives_the_same_file(folder: Path, capsys: Capture, monkeypatch: Patch) -> None:
    monkeypatch.setattr("pkm_exact.engine.mobility", lambda _: 1 // 0)
    for _ in range(2):
        report = _ends_with_a_report(["solve", str(MODEL)], folder, capsys)
        assert report["stage"] == "self-motion"


def test_a_report_tells_nothing_about_the_machine(folder: Path, capsys: Capture, monkeypatch: Patch) -> None:
    home = folder.parent / "home-of-somebody"
    monkeypatch.setenv("HOME", str(home))
    monkeypatch.setenv("SECRET_OF_SOMEBODY", "do not tell")

    monkeypatch.setattr("pkm_exact.engine.mobility", lambda _: int(f"{home}/x {folder}"))
    _ends_with_a_report(["solve", str(MODEL), "--configuration", "home"], folder, capsys)
    text = next(folder.iterdir()).read_text(encoding="ascii")
    for word in (str(folder), str(folder.parent), "somebody", "SECRET", "do not tell", sys.prefix, str(ROOT)):
        assert word not in text
    assert ".../x ..." in text


def test_without_a_writable_folder_the_report_goes_elsewhere(
    tmp_path: Path, capsys: Capture, monkeypatch: Patch
) -> None:
    closed, other = tmp_path / "closed", tmp_path / "other"
    other.mkdir()
    closed.mkdir()
    monkeypatch.chdir(closed)
    monkeypatch.setattr("tempfile.tempdir", str(other))
    monkeypatch.setattr("pkm_exact.engine.mobility", lambda _: 1 // 0)
    refused = import_module("pkm_exact.failures.failure_report").write_whole

    def write(path: Path, data: bytes) -> None:
        if not path.is_absolute():
            raise PermissionError
        refused(path, data)

    monkeypatch.setattr("pkm_exact.failures.failure_report.write_whole", write)
    assert main(["solve", str(MODEL)]) == 4
    assert str(other) in capsys.readouterr().err
    assert _only_report(other)["sentence"].startswith("ZeroDivisionError")

    def never(path: Path, data: bytes) -> None:
        raise PermissionError

    monkeypatch.setattr("pkm_exact.failures.failure_report.write_whole", never)
    assert main(["solve", str(MODEL)]) == 4
    assert "no report could be written" in capsys.readouterr().err


def _contradicts(*_: object, **__: object) -> Solution:
    require(False, "made up", number=1)
    raise AssertionError


def _breaks(*_: object, **__: object) -> Solution:
    raise KeyError("made up")


@pytest.mark.parametrize(("engine", "kind"), [(_contradicts, InternalContradictionError), (_breaks, UnexpectedError)])
def test_a_failure_in_another_process_arrives_with_its_facts(
    engine: Callable[..., Solution], kind: type[InternalError], folder: Path
) -> None:
    with pytest.raises(kind, match="made up") as caught:
        solve_within(engine, shipped(P), 60.0)
    assert "attach" in reported(caught.value)
    frames = _only_report(folder)["frames"]
    assert any(engine.__name__ in frame for frame in frames)


def test_a_limit_is_not_a_failure(folder: Path, capsys: Capture, monkeypatch: Patch) -> None:
    def gives_up(*_: object, **__: object) -> None:
        raise PkmExactError("it takes too long")

    monkeypatch.setattr("pkm_exact.engine.mobility", gives_up)
    assert main(["solve", str(MODEL)]) == 4
    assert capsys.readouterr().err == "certify-poses: error: no answer: it takes too long\n"
    assert not list(folder.iterdir())
