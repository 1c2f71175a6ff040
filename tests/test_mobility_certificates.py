"""Certificates of mobility: what is written is accepted by both checkers, and every check has a forgery of its own."""

from collections.abc import Callable
from copy import deepcopy
from fractions import Fraction
from itertools import combinations
from pathlib import Path
from typing import Any

import pytest
from certificate_subjects import subject
from mutations import outcome

from pkm_exact import check_bytes, mobility_of, read_linkage
from pkm_exact.certify import pure, pure_mobility
from pkm_exact.certify.build import canonical_bytes, sealed
from pkm_exact.certify.checker import mobility_document
from pkm_exact.certify.mobility_build import listed_sets, mobility_certificate
from pkm_exact.cli.main import main
from pkm_exact.geometry.joint_types import JointGeometry
from pkm_exact.geometry.linkage import Joint, Linkage
from pkm_exact.mobility.actuation import ActuatorSets

CHAINS = Path(__file__).parent.parent / "models" / "chains"
Content = dict[str, Any]


def _answers(content: Content) -> tuple[tuple[str, tuple[str, ...]], tuple[str, tuple[str, ...]]]:
    data = canonical_bytes(sealed({key: value for key, value in content.items() if key != "digest"}))
    one, other = check_bytes(data), pure.check_bytes(data)
    return (str(one.status), one.lines), (other.status, other.lines)


def _made(name: str, **words: Any) -> Content:
    return mobility_certificate(mobility_of(read_linkage(CHAINS / f"{name}.toml"), **words))


@pytest.mark.parametrize(
    ("name", "words"),
    [
        ("3-pprr", {"actuated": ["A1", "B1"]}),
        ("seven-link-oblique", {}),
        ("peaucellier", {}),
        ("bennett", {}),
        ("3-upu", {"among": ["P1", "P2", "P3", "U1"]}),
        ("5-rrr-rr", {"among": ["R11", "R21", "R31", "R41", "R51", "R12"]}),
        ("5-rrr-rr-alike", {"among": ["R11", "R21", "R31", "R41", "R51"]}),
    ],
)
def test_what_is_written_is_accepted(name: str, words: Content) -> None:
    one, other = _answers(_made(name, **words))
    assert one == other
    assert one[0] == "accepted"


@pytest.mark.slow
@pytest.mark.parametrize("path", sorted(CHAINS.glob("*.toml")), ids=lambda path: path.stem)
def test_what_is_written_of_every_mechanism_is_accepted(path: Path) -> None:
    one, other = _answers(_made(path.stem))
    assert one == other
    assert one[0] == "accepted"


def test_a_serial_chain_has_a_certificate() -> None:
    """No loop: a matrix without rows."""
    leg = mobility_of(read_linkage(CHAINS / "3-upu.toml")).legs[0].linkage
    one, other = _answers(mobility_certificate(mobility_of(leg)))
    assert one == other
    assert one[0] == "accepted"
    assert "loops: rank 0 of 0 equations in 5 freedoms, mobility 5" in one[1]


def test_joints_of_every_type_have_a_certificate() -> None:
    x, z = (Fraction(1), Fraction(0), Fraction(0)), (Fraction(0), Fraction(0), Fraction(1))
    point, screw = (Fraction(1), Fraction(2), Fraction(3)), tuple(map(Fraction, (0, 1, 2, 3, 4, 5)))
    kinds = {
        "R": JointGeometry(point, (x,)),
        "P": JointGeometry(axes=(z,)),
        "H": JointGeometry(point, (x,), Fraction(2, 3)),
        "C": JointGeometry(point, (z,)),
        "U": JointGeometry(point, (x, z)),
        "S": JointGeometry(point),
        "screw": JointGeometry(screws=(screw, (*screw[3:], *screw[:3]))),
    }
    count = len(kinds)
    joints = tuple(
        Joint(name, name, (f"b{k}", f"b{(k + 1) % count}"), geometry)
        for k, (name, geometry) in enumerate(kinds.items())
    )
    ring = Linkage("ring", "1", "a test", tuple(f"b{k}" for k in range(count)), joints, "b0", "b3")
    content = mobility_certificate(mobility_of(ring, ["R", "P"], ["R", "P", "H"]))
    one, other = _answers(content)
    assert one == other
    assert one[0] == "accepted"
    assert content["mobility"]["free"] == 12 - 6


# Forgeries: true certificates with one false claim, everything else made to fit.


def _bodies_in_two_legs() -> Content:
    """Each joint is in one leg, but both legs go through the same body."""
    x, y = (Fraction(1), Fraction(0), Fraction(0)), (Fraction(0), Fraction(1), Fraction(0))
    ends = (("base", "x"), ("x", "top"), ("base", "x"), ("x", "top"))
    joints = tuple(Joint(f"j{k}", "P", pair, JointGeometry(axes=(y if k % 2 else x,))) for k, pair in enumerate(ends))
    content = mobility_certificate(
        mobility_of(Linkage("crossed", "1", "a test", ("base", "x", "top"), joints, "base", "top"))
    )
    legs = [{"joints": ["j0", "j1"], "cut": 0}, {"joints": ["j2", "j3"], "cut": 0}]
    return content | {"finite": {"argument": "subgroups", "legs": legs}}


def _with_legs(name: str, *legs: tuple[str, int]) -> Content:
    listed = [{"joints": joints.split(), "cut": cut} for joints, cut in legs]
    return {**subject(name), "finite": {"argument": "subgroups", "legs": listed}}


def _changed(name: str, change: Callable[[Content], None]) -> Content:
    content = deepcopy(dict(subject(name)))
    change(content)
    return content


def _more_motion(content: Content) -> None:
    """Sarrus's linkage with a column of the minor given up: mobility 2, everything counted as if it were so."""
    proof = content["loops"]
    gone = proof["columns"].pop()
    proof["rows"].pop()
    proof["rank"] -= 1
    zero = ["0"] * len(content["mechanism"]["joints"])
    proof["null_space"].append([*zero[:gone], "1", *zero[gone + 1 :]])
    places = [k for k in range(len(zero)) if k not in proof["columns"]]
    proof["null_space"].sort(key=lambda x: [x[k] for k in places], reverse=True)


def _set(content: Content, *path: Any, to: Any) -> None:
    for key in path[:-1]:
        content = content[key]
    content[path[-1]] = to


SARRUS, SEVEN, OBLIQUE = "mobility, Sarrus", "mobility, seven-link", "mobility, nothing finite"
FORGERIES: dict[str, tuple[Callable[[], Content], str]] = {
    "a null space of two": (lambda: _changed(SARRUS, _more_motion), "loops.null_space: not"),
    "a vector not in the null space": (
        lambda: _changed(SARRUS, lambda c: _set(c, "loops", "null_space", 0, 0, to="7")),
        "loops.null_space: not in the null space",
    ),
    "a hinge of another place": (
        lambda: _changed(SARRUS, lambda c: _set(c, "mechanism", "joints", 1, "point", 1, to="6")),
        "loops.null_space: not in the null space",
    ),
    "a vector that is not 1 at its column": (
        lambda: _changed(
            SARRUS,
            lambda c: _set(c, "loops", "null_space", 0, to=[str(2 * Fraction(x)) for x in c["loops"]["null_space"][0]]),
        ),
        "loops.null_space: not 1 at its own column",
    ),
    "a minor that is 0": (
        lambda: _changed(SARRUS, lambda c: _set(c, "loops", "rows", to=[0, 1, 2, 3, 4])),
        "loops: the minor is 0",
    ),
    "a platform that moves otherwise": (
        lambda: _changed(SEVEN, lambda c: _set(c, "platform", "null_space", 0, to=["1", "0"])),
        "platform.null_space: not",
    ),
    "actuators that hold less": (
        lambda: _changed(SARRUS, lambda c: _set(c, "actuated", to=[])),
        "locked_loops: a place outside the matrix",
    ),
    **{
        f"another number under {key}": (
            lambda key=key: _changed(SARRUS, lambda c: _set(c, "mobility", key, to=c["mobility"][key] + 1)),  # type: ignore[misc]
            f"mobility.{key}: not the number that follows",
        )
        for key in mobility_document.COUNTS
    },
    "a set that does not hold": (
        lambda: _changed(SEVEN, lambda c: _set(c, "actuator_sets", "platform", "sets", 3, to=["F"])),
        "actuator_sets.platform",
    ),
    "a set that does not hold the mechanism": (
        lambda: _changed(SEVEN, lambda c: _set(c, "actuator_sets", "mechanism", "sets", to=[["A"]])),
        "actuator_sets.mechanism: a set that does not hold it",
    ),
    "a set that is not minimal": (
        lambda: _changed(SARRUS, lambda c: _set(c, "actuator_sets", "platform", "sets", to=[["A", "B"]])),
        "actuator_sets.platform: a set that is not minimal",
    ),
    "a set left out": (
        lambda: _changed(SARRUS, lambda c: c["actuator_sets"]["mechanism"]["sets"].pop()),
        "actuator_sets.mechanism: not all minimal sets",
    ),
    "regular loops that are not": (
        lambda: {**subject(SARRUS), "finite": {"argument": "regular", "legs": []}},
        "finite: the loops are not regular",
    ),
    "a leg that is no group": (
        lambda: _with_legs(OBLIQUE, ("A B C", 0), ("F E D G", 0)),
        "finite: a leg does not fill its groups",
    ),
    "legs that are not transversal": (
        lambda: _with_legs(OBLIQUE, ("A B C", 0), ("F E D G", 3)),
        "finite: the legs are not transversal",
    ),
    "a leg left out": (lambda: _with_legs(SARRUS, ("A B C", 0)), "finite: not every joint is in one leg"),
    "a leg twice": (
        lambda: _with_legs(SARRUS, ("A B C", 0), ("A B C", 0), ("F E D", 0)),
        "finite: not every joint is in one leg",
    ),
    "a body in two legs": (_bodies_in_two_legs, "finite: not every body is in one leg"),
    "joints in another order": (
        lambda: _with_legs(SARRUS, ("B A C", 0), ("F E D", 0)),
        "finite: the joints of a leg are no chain",
    ),
    "a leg that ends early": (
        lambda: _with_legs(SARRUS, ("A B", 0), ("F E D", 0)),
        "finite: a leg does not end at the platform",
    ),
    "a cut behind the leg": (
        lambda: _with_legs(SARRUS, ("A B C", 3), ("F E D", 0)),
        "finite.legs: a cut behind the leg's joints",
    ),
}


@pytest.mark.parametrize("name", FORGERIES)
def test_a_forgery_is_refused_by_both_checkers_in_the_same_words(name: str) -> None:
    make, line = FORGERIES[name]
    one, other = _answers(make())
    assert one[0] == other[0]
    assert one[0] in ("rejected", "malformed")
    assert one[1][-1].startswith(line)
    assert one == other


def test_joints_passed_backwards_are_reversed() -> None:
    """The cut of a leg with a universal joint counts from the base, whichever way the joint was written."""
    linkage = read_linkage(CHAINS / "5-rrr-rr.toml")
    turned = tuple(Joint(j.name, j.type, j.bodies[::-1], j.geometry) for j in linkage.joints)
    found = mobility_certificate(
        mobility_of(Linkage("turned", "1", "a test", linkage.bodies, turned, "base", "platform"), among=["R11"])
    )
    one, other = _answers(found)
    assert one == other
    assert one[0] == "accepted"


@pytest.mark.parametrize(
    ("path", "value", "status"),
    [
        (("mechanism", "bodies"), ["base"] * 65, "too-large"),
        (("mechanism", "joints"), [], "malformed"),
        (("mechanism", "joints", 0, "pitch"), "1", "malformed"),
        (("mechanism", "joints", 0, "screws"), [["1"] * 6], "malformed"),
        (("mechanism", "joints", 0, "axes"), [["0", "0", "0"]], "malformed"),
        (("mechanism", "joints", 0, "bodies"), ["base", "base"], "malformed"),
        (("mechanism", "platform"), "base", "malformed"),
        (("actuator_sets", "platform", "sets"), [["B"], ["A"]], "malformed"),
        (("actuator_sets", "among"), ["A"], "malformed"),
        (("loops", "columns"), [4, 3, 2, 1, 0], "malformed"),
        (("loops", "columns"), [0, 1, 2, 3, 99], "malformed"),
        (("loops", "null_space"), [], "malformed"),
    ],
)
def test_what_is_no_certificate_is_malformed(path: tuple[Any, ...], value: Any, status: str) -> None:
    one, other = _answers(_changed(SARRUS, lambda content: _set(content, *path, to=value)))
    assert one[0] == other[0] == status
    assert one[1][-1].partition(":")[0].partition("[")[0] == other[1][-1].partition(":")[0].partition("[")[0]


def test_the_limits_are_the_same_in_both_checkers() -> None:
    document = mobility_document
    assert (pure_mobility.MAX_BODIES, pure_mobility.MAX_FREEDOMS) == (document.MOST_BODIES, document.MOST_FREEDOMS)
    assert (pure_mobility.AXES, pure_mobility.MAX_SETS) == (document.TYPES, document.MOST_SETS)
    assert (pure_mobility.KEYS.split(), pure_mobility.COUNTS.split()) == ([*subject(SARRUS)][:-1], [*document.COUNTS])


def test_the_command_writes_a_certificate(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    path = tmp_path / "sarrus.json"
    assert main(["mobility", str(CHAINS / "sarrus.toml"), "-o", str(path)]) == 0
    assert main(["check", str(path)]) == main(["check", "--pure", str(path)]) == 0
    assert path.read_bytes() == canonical_bytes(subject(SARRUS))
    assert main(["check", "--recompute", str(path)]) == 0
    for command, output in (("report", "page.html"), ("plot", "picture.svg")):
        capsys.readouterr()
        assert main([command, str(path), "-o", str(tmp_path / output)]) == 2
        assert "lists no poses of a robot" in capsys.readouterr().err


@pytest.mark.parametrize(
    ("places", "least", "most", "above", "below"),
    [
        ((0, 1, 3), 0, 0, "definite", None),
        ((0, 1, 4, 3), 1, 1, "cone", "indefinite"),
        ((0, 1, 3, 2, 6, 1), 3, 3, "cone", "indefinite"),
        ((0, 1, 3, 6), 0, 0, "definite", None),
    ],
)
def test_bounds_of_second_order_have_certificates(
    places: tuple[int, ...], least: int, most: int, above: str, below: str | None
) -> None:
    """Hinges on a line: stretched they are rigid, folded back they move."""
    content = mobility_certificate(mobility_of(_on_a_line(places)))
    one, other = _answers(content)
    assert one == other
    assert one[0] == "accepted"
    assert one[1][-1] == f"finite: mobility {least} near the configuration, by the argument second-order"
    found = content["finite"]
    assert (content["version"], found["least"], found["most"], found["above"]["argument"]) == (2, least, most, above)
    assert (found["below"] or {"argument": None})["argument"] == below


def _on_a_line(places: tuple[int, ...]) -> Linkage:
    count, up = len(places), (Fraction(0), Fraction(0), Fraction(1))
    bodies = tuple(f"b{k}" for k in range(count))
    points = [(Fraction(x), Fraction(0), Fraction(0)) for x in places]
    joints = tuple(
        Joint(f"j{k}", "R", (bodies[k], bodies[(k + 1) % count]), JointGeometry(points[k], (up,))) for k in range(count)
    )
    return Linkage("in a line", "1", "a test", bodies, joints, "b0", "b1")


def test_a_section_that_meets_the_cone_is_another_one() -> None:
    """The vector that is looked at first is on the cone of this form; the proof of the same bound takes another one."""
    for middle in range(2, 40):
        found = mobility_of(_on_a_line((0, 12, middle, 12 + middle)))
        assert found.finite.is_known
        assert check_bytes(canonical_bytes(mobility_certificate(found)))


def test_what_is_bounded_only_is_said_by_its_certificate(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    path = tmp_path / "seven.json"
    assert main(["mobility", str(CHAINS / "seven-link-oblique.toml"), "-o", str(path)]) == 0
    assert not capsys.readouterr().err
    assert main(["check", str(path)]) == main(["check", "--recompute", str(path)]) == 0
    assert "finite: mobility 1 near the configuration, by the argument second-order" in capsys.readouterr().out


def test_a_mutation_survives_nowhere() -> None:
    """One of each kind, beside the sample of ``test_mutations``."""
    from mutations import Mutation

    for path, value in ((("mobility", "free"), 3), (("loops", "rank"), 6), (("finite", "argument"), "regular")):
        content = _changed(SARRUS, lambda c, path=path, value=value: _set(c, *path, to=value))  # type: ignore[misc]
        content.pop("digest")
        assert outcome(SARRUS, Mutation(path, "changed", content)) in ("rejected", "malformed")


def test_all_sets_are_all_among_the_freedoms_looked_at() -> None:
    """A list without a set is complete among no freedoms, and the checkers say among how many."""
    content = _made("3-upu", among=["P1"])
    (status, lines), other = _answers(content)
    assert (status, lines) == other
    assert "platform sets: 0 minimal sets hold it, there is no other among 1 freedoms" in lines


def test_of_a_list_that_is_not_called_complete_a_part_is_written() -> None:
    linkage = read_linkage(CHAINS / "3-pprr.toml")
    some = tuple(combinations(linkage.freedoms, 3))
    for is_complete, count in ((True, len(some)), (False, 100)):
        listed = listed_sets(ActuatorSets(some, is_complete=is_complete), linkage)
        assert listed == {"complete": is_complete, "sets": [list(names) for names in some[:count]]}
