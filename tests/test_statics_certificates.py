"""Certificates of statics: honest ones are accepted by both checkers, forged ones by neither."""

import copy
import json
from collections.abc import Callable
from fractions import Fraction
from pathlib import Path
from typing import Any

import jsonschema
import numpy as np
import pytest
from certificate_tools import both, golden
from samples import model
from test_statics import POSES, at, vector

from pkm_exact import Mechanism, read_robot
from pkm_exact.certify import pure
from pkm_exact.certify.build import canonical_bytes, sealed
from pkm_exact.certify.check import check_bytes
from pkm_exact.certify.statics_any_build import any_statics_certificate
from pkm_exact.certify.statics_box_build import statics_box_certificate
from pkm_exact.certify.statics_build import statics_certificate
from pkm_exact.certify.statics_driven_build import driven_legs, statics_driven_certificate
from pkm_exact.certify.statics_of_poses import at_certified_poses
from pkm_exact.cli.main import main
from pkm_exact.constraints.distance import Distance
from pkm_exact.errors import InputError
from pkm_exact.motions.motion_groups import PLANAR, SPHERICAL
from pkm_exact.statics.machine_at_pose import machine_at

Capture = pytest.CaptureFixture[str]
SCHEMA, SECOND, THIRD, FOURTH = (
    Path(pure.__file__).with_name(f"statics-certificate-{k}.schema.json") for k in (1, 2, 3, 4)
)


def redundant() -> Mechanism:
    """Four legs in the plane, two of them in one line: facets are merged, a side is none."""
    joints = [((3, 0), (1, 0)), ((0, 4), (0, 1)), ((-3, 0), (-1, 0)), ((3, 4), (1, 1))]
    legs = [Distance(vector(*a, 0), vector(*b, 0), Fraction(1), f"leg {k}") for k, (a, b) in enumerate(joints, 1)]
    return Mechanism("redundant", "m", "made up", tuple(legs), tuple(leg.name for leg in legs), PLANAR)


def made(name: str) -> dict[str, Any]:
    limits = {"speeds": [1, "1/2", 2, 3] if name == "redundant" else 1, "forces": 2, "length": 3}
    if name == "redundant":
        machine = redundant()
        found = machine.at({"position": ["1/10", 0], "half_tangent": 0})
        return statics_certificate(machine, found.measures(**limits))
    return statics_certificate(model(name), at(name).measures(**limits))


@pytest.fixture(scope="module")
def small() -> dict[str, Any]:
    return made("redundant")


def verdicts(content: dict[str, Any]) -> tuple[str, str]:
    data = canonical_bytes(sealed({key: value for key, value in content.items() if key != "digest"}))
    return str(check_bytes(data).status), pure.check_bytes(data).status


@pytest.mark.parametrize("name", ["3-rpr-merlet-p", "redundant", pytest.param("robocrane-r", marks=pytest.mark.slow)])
def test_honest_certificates_are_accepted_with_the_same_lines(name: str) -> None:
    content = made(name)
    data = canonical_bytes(content)
    fast, plain = check_bytes(data), pure.check_bytes(data)
    assert (fast.status, plain.status) == ("accepted", "accepted")
    assert fast.lines == plain.lines
    assert len(fast.lines) == 6
    jsonschema.Draft202012Validator(json.loads(SCHEMA.read_text())).validate(content)


def forged(content: dict[str, Any], change: Callable[[dict[str, Any]], None]) -> dict[str, Any]:
    found = copy.deepcopy(content)
    change(found)
    return found


def _times(text: str, factor: Fraction) -> str:
    return str(Fraction(text) * factor)


def _scaled(content: dict[str, Any], factor: Fraction) -> None:
    content["ellipsoid"]["matrix"] = [[_times(x, factor) for x in row] for row in content["ellipsoid"]["matrix"]]


def _moved(content: dict[str, Any]) -> None:
    content["velocity_polytope"]["vertices"][0][0][0] = _times(
        content["velocity_polytope"]["vertices"][0][0][0] or "1", 1 + Fraction(1, 10**9)
    )
    first = content["velocity_polytope"]["vertices"][0]
    for line in first:
        for k, x in enumerate(line):
            if x != "0":
                line[k] = _times(x, 1 - Fraction(1, 10**9))
                return


def _offset(content: dict[str, Any]) -> None:
    offset = content["wrench_polytope"]["facets"][0]["offset"]
    place = next(k for k, x in enumerate(offset) if x != "0")
    offset[place] = _times(offset[place], 1 + Fraction(1, 10**9))


def _flipped(content: dict[str, Any]) -> None:
    content["wrench_polytope"]["vertices"][0] = [-x for x in content["wrench_polytope"]["vertices"][1]]


def _bound(name: str, end: int, factor: Fraction) -> Callable[[dict[str, Any]], None]:
    def change(content: dict[str, Any]) -> None:
        pair = content["indices"][name]
        pair[end] = _times(pair[end], factor)
        pair[1 - end] = max(pair, key=Fraction) if end == 0 and Fraction(pair[0]) > Fraction(pair[1]) else pair[1 - end]
        if Fraction(pair[0]) > Fraction(pair[1]):
            pair[1 - end] = pair[end]

    return change


MORE, LESS = 1 + Fraction(1, 10**9), 1 - Fraction(1, 10**9)
FRAUDS: dict[str, Callable[[dict[str, Any]], None]] = {
    "a facet of twists dropped": lambda c: c["velocity_polytope"]["facets"].pop(),
    "a facet of twists too many": lambda c: c["velocity_polytope"]["facets"].append(
        next([leg, 1] for leg in (1, 2, 3, 4) if [leg, 1] not in c["velocity_polytope"]["facets"])
    ),
    "a facet of twists twice": lambda c: c["velocity_polytope"]["facets"].append(c["velocity_polytope"]["facets"][0]),
    "a vertex of twists dropped": lambda c: c["velocity_polytope"]["vertices"].pop(),
    "a vertex of twists twice": lambda c: c["velocity_polytope"]["vertices"].append(
        c["velocity_polytope"]["vertices"][0]
    ),
    "a vertex of twists moved": _moved,
    "a facet of wrenches dropped": lambda c: c["wrench_polytope"]["facets"].pop(),
    "a facet of wrenches twice": lambda c: c["wrench_polytope"]["facets"].append(c["wrench_polytope"]["facets"][0]),
    "a facet of wrenches moved": _offset,
    "a vertex of wrenches dropped": lambda c: c["wrench_polytope"]["vertices"].pop(),
    "a vertex of wrenches twice": lambda c: c["wrench_polytope"]["vertices"].append(
        c["wrench_polytope"]["vertices"][0]
    ),
    "a vertex of wrenches instead of another": _flipped,
    "the ellipsoid larger": lambda c: _scaled(c, MORE * MORE),
    "the ellipsoid smaller": lambda c: _scaled(c, LESS * LESS),
    "weights whose sum is 2": lambda c: c["ellipsoid"].update(
        weights=[_times(x, Fraction(2)) for x in c["ellipsoid"]["weights"]]
    ),
    "sigma_min too high": _bound("sigma_min", 0, Fraction(11, 10)),
    "sigma_min too low": _bound("sigma_min", 1, Fraction(9, 10)),
    "sigma_max too low": _bound("sigma_max", 1, Fraction(9, 10)),
    "sigma_max too high": _bound("sigma_max", 0, Fraction(11, 10)),
    "condition too high": _bound("condition", 0, Fraction(11, 10)),
    "condition too low": _bound("condition", 1, Fraction(9, 10)),
    "a joint moved": lambda c: c["legs"][0]["base"].__setitem__(0, "301/100"),
    "another metric": lambda c: c.update(
        metric=["1", "1", "2"], rotation=[["1", "0", "0"], ["0", "0", "1"], ["0", "-1", "0"]]
    ),
    "a reflection": lambda c: c.update(rotation=[["1", "0", "0"], ["0", "1", "0"], ["0", "0", "-1"]]),
    "greater speeds": lambda c: c["speeds"].__setitem__(0, "2"),
    "greater forces": lambda c: c["forces"].__setitem__(0, ["-3", "2"]),
    "another length": lambda c: c.update(length="4"),
}


@pytest.mark.parametrize("name", FRAUDS)
def test_frauds_are_rejected_by_both(name: str, small: dict[str, Any]) -> None:
    assert verdicts(small) == ("accepted", "accepted")
    assert verdicts(forged(small, FRAUDS[name])) == ("rejected", "rejected")


@pytest.mark.parametrize(
    "change",
    [
        lambda c: c.update(freedoms=[0, 0, 5]),
        lambda c: c.update(metric=["1", "0", "1"]),
        lambda c: c.update(speeds=None),
        lambda c: c.update(forces=None),
        lambda c: c["speeds"].__setitem__(0, "2/4"),
        lambda c: c["forces"].__setitem__(0, ["2", "2"]),
        lambda c: c["legs"].__delitem__(slice(0, 2)),
        lambda c: c["wrench_polytope"]["vertices"][0].__setitem__(0, 0),
        lambda c: c["velocity_polytope"]["facets"].append([9, 1]),
        lambda c: c["indices"].update(sigma_min=["2", "1"]),
        lambda c: c.update(version=2),
    ],
)
def test_what_is_not_of_the_format_is_malformed(
    change: Callable[[dict[str, Any]], None], small: dict[str, Any]
) -> None:
    assert verdicts(forged(small, change)) == ("malformed", "malformed")


def test_every_number_matters(small: dict[str, Any]) -> None:
    """A number of every list of the certificate changed by a part in 10^9 or by 1: nobody accepts."""
    for key in ("position", "speeds"):
        for place in range(2):
            wrong = forged(
                small,
                lambda c, key=key, place=place: c[key].__setitem__(
                    place, _times(c[key][place], MORE) if c[key][place] != "0" else "1/1000"
                ),
            )
            assert "accepted" not in verdicts(wrong)


def test_too_many_choices_are_too_large(small: dict[str, Any]) -> None:
    def change(content: dict[str, Any]) -> None:
        content["freedoms"] = [0, 1, 2, 3, 4, 5]
        legs = [{"base": [str(k * k), str(k), "0"], "platform": ["0", str(k), str(k * k * k)]} for k in range(1, 13)]
        content["legs"], content["speeds"], content["forces"] = legs, ["1"] * 12, [["-1", "1"]] * 12
        content["velocity_polytope"] = {"facets": [], "vertices": []}
        content["wrench_polytope"] = content["ellipsoid"] = content["indices"] = None

    assert verdicts(forged(small, change)) == ("too-large", "too-large")


def test_the_command_writes_what_the_checkers_accept(tmp_path: Path, capsys: Capture) -> None:
    target = tmp_path / "statics.json"
    words = ["statics", "models/3-rpr-merlet-p.toml", "--position", "5,9/2", "--half-tangent", "1/3", "-o", str(target)]
    assert main([*words, "--limits", "speeds=1", "--limits", "forces=2", "--limits", "length=3"]) == 0
    measures = machine_at(model("3-rpr-merlet-p"), POSES["3-rpr-merlet-p"]).measures(speeds=1, forces=2, length=3)
    assert target.read_bytes() == canonical_bytes(statics_certificate(model("3-rpr-merlet-p"), measures))
    assert main(["check", str(target)]) == 0
    printed = capsys.readouterr()
    assert "and no others" in printed.out
    assert "does not have" not in printed.err
    assert main([*words, "--limits", "speeds=1"]) == 0
    assert "does not have indices: singular values need a length" in capsys.readouterr().err
    with pytest.raises(InputError, match="exact poses of machines of legs"):
        statics_certificate(model("3-rrr"), measures)


def _plain_machine(freedoms: list[int], joints: list[list[str]]) -> dict[str, Any]:
    """A certificate without a claim: legs from these base joints to the origin, nothing turned."""
    return {
        "format": "pkm_exact statics certificate",
        "version": 1,
        "name": "made up",
        "unit": "m",
        "metric": ["1", "1", "1"],
        "freedoms": freedoms,
        "position": ["0", "0", "0"],
        "rotation": [["1", "0", "0"], ["0", "1", "0"], ["0", "0", "1"]],
        "legs": [{"base": joint, "platform": ["0", "0", "0"]} for joint in joints],
        "speeds": ["1"] * len(joints),
        "forces": [["-1", "1"]] * len(joints),
        "length": None,
        "velocity_polytope": None,
        "wrench_polytope": None,
        "ellipsoid": None,
        "indices": None,
    }


def test_twists_without_bounds_are_no_polytope_without_facets() -> None:
    """Of two parallel legs: the strip has sides, though no vertex."""
    content = _plain_machine([0, 1], [["-1", "0", "0"], ["-2", "0", "0"]])
    assert verdicts(content) == ("accepted", "accepted")
    content["velocity_polytope"] = {"facets": [], "vertices": []}
    assert verdicts(content) == ("rejected", "rejected")


@pytest.mark.parametrize("vertices", [[], [[1, 1], [-1, 1]], [[1, -1], [-1, -1]]])
def test_a_leg_that_exerts_nothing_has_no_end_at_a_vertex(vertices: list[list[int]]) -> None:
    content = _plain_machine([0], [["-1", "0", "0"], ["0", "1", "0"]])
    facets = [{"normal": ["1"], "offset": ["1", "0"]}, {"normal": ["-1"], "offset": ["1", "0"]}]
    content["wrench_polytope"] = {"facets": facets, "vertices": vertices}
    assert verdicts(content) == ("rejected", "rejected")


def test_a_leg_through_the_center_of_turns_is_certified() -> None:
    """It does not change its length: no bound of twists, no wrench, and no division by its reach."""
    joints = [((3, 0, 0), (0, 1, 0)), ((0, 4, 0), (0, 0, 1)), ((0, 0, 5), (1, 0, 0)), ((2, 0, 0), (1, 0, 0))]
    legs = [Distance(vector(*a), vector(*b), Fraction(1), f"leg {k}") for k, (a, b) in enumerate(joints, 1)]
    machine = Mechanism("through", "m", "made up", tuple(legs), tuple(leg.name for leg in legs), SPHERICAL)
    content = statics_certificate(machine, machine.at({"quaternion": [1, 0, 0, 0]}).measures(speeds=1, forces=1))
    assert content["wrench_polytope"] is None
    assert content["ellipsoid"]["weights"][3] == "0"
    assert len(content["velocity_polytope"]["vertices"]) == 8
    assert verdicts(content) == ("accepted", "accepted")


@pytest.mark.parametrize(
    "name",
    [
        *("3-prrr", "3-rpr-turned", "3-prs", "spherical-3-rrr", "x-y"),
        pytest.param("carriage-hexapod", marks=pytest.mark.slow),
    ],
)
def test_machines_whose_actuators_drive_no_legs_have_certificates_too(name: str) -> None:
    """Turned legs, offsets, hinges that slides move along, axes; and a carriage that bears all legs."""
    at = at_certified_poses(golden(name), model(name), [0])[0]
    measures = at.measures(speeds=1, forces=2, length=3)
    content, left_out = any_statics_certificate(model(name), measures, [1] * len(at.twist), {"digest": "x", "pose": 1})
    assert (content["version"], content["regular"]) == (4, True)
    assert sorted(left_out) == (["ellipsoid", "indices"] if name == "carriage-hexapod" else [])
    verdict = both(canonical_bytes(content))
    assert verdict.status == "accepted", verdict.lines
    assert len(verdict.lines) == 8 - len(left_out)
    jsonschema.Draft202012Validator(json.loads(FOURTH.read_text())).validate(content)


LARGE = ("rolland-6-6", "linapod-n")


@pytest.mark.parametrize(
    "name",
    [
        *("3-rps", "3-rrr", "h4", "dual-v", "delta", "bipod", "3-rpr-triple"),
        *(pytest.param(name, marks=pytest.mark.slow) for name in LARGE),
    ],
)
def test_poses_of_certificates_have_certificates(name: str) -> None:
    """Slides, cranks, constraints that are not actuated, redundant legs, a singular pose."""
    at = at_certified_poses(golden(name), model(name), [0])[0]
    measures = at.measures(speeds=1, forces=2, length=3)
    content, left_out = statics_box_certificate(measures, [1] * len(at.twist), {"digest": "sha256:", "pose": 1})
    verdict = both(canonical_bytes(content))
    assert verdict.status == "accepted", verdict.lines
    assert len(verdict.lines) == 7 - len(left_out)
    assert bool(left_out) == (name in ("dual-v", "3-rpr-triple"))
    jsonschema.Draft202012Validator(json.loads(SECOND.read_text())).validate(content)


EXACT = {
    "dual-v": ({"position": [0, 0], "half_tangent": 0}, "+-+-"),
    "h4": ({"position": [0, 0, -42], "quaternion": [1, 0, 0, 0]}, "++++"),
}


@pytest.mark.parametrize("name", EXACT)
def test_slides_and_cranks_at_exact_poses_have_certificates(name: str) -> None:
    """The polytopes that are printed, corner by corner."""
    at = read_robot(f"models/{name}.toml").at(EXACT[name][0], modes=EXACT[name][1])
    measures = at.measures(speeds=1, forces=2, length=3)
    content, left_out = any_statics_certificate(model(name), measures)
    assert (content["version"], left_out) == (3, {})
    jsonschema.Draft202012Validator(json.loads(THIRD.read_text())).validate(content)
    verdict = both(canonical_bytes(content))
    assert verdict.status == "accepted", verdict.lines
    assert at.jacobian is not None
    rows = at.jacobian.to_numpy()
    lengths = [driven_length(content, k) for k in range(len(rows))]
    points = [[sum(float(Fraction(c)) * size for c, size in zip(line, lengths, strict=True)) for line in vertex]
              for vertex in content["velocity_polytope"]["vertices"]]  # fmt: skip
    speeds = np.abs(np.array(points) / np.sqrt(squares_of_columns(content)) @ rows.T)
    assert speeds.max() < 1 + 1e-12
    assert np.isclose(speeds, 1).sum(axis=1).min() >= rows.shape[1]
    assert len(points) == len(at.velocity_polytope(1).vertices)
    # With a load forces are what is asked for, which version 2 encloses.
    assert any_statics_certificate(model(name), measures, [1] * len(at.twist))[0]["version"] == 2


def test_knees_that_are_not_rational_have_none() -> None:
    robot = read_robot("models/3-rrr.toml")
    at = robot.at({"position": ["31/5", "-19/5"], "half_tangent": "-1/14"}, modes="+++")
    assert driven_legs(at) is None
    with pytest.raises(InputError, match="legs alone, 12 at most, with rational joints"):
        statics_driven_certificate(at.measures(speeds=1))
    with pytest.raises(InputError, match="must be rational but for one square root each actuator"):
        any_statics_certificate(model("3-rrr"), at.measures(speeds=1))


def driven_length(content: dict[str, Any], number: int) -> float:
    """|p_i| of a leg, in ordinary arithmetic."""
    g, c = (np.array([float(Fraction(x)) for x in content[key]]) for key in ("metric", "position"))
    turn = np.array([[float(Fraction(x)) for x in row] for row in content["rotation"]])
    a, b, n = (
        np.array([float(Fraction(x)) for x in content["legs"][number][key]])
        for key in ("base", "platform", "direction")
    )
    return abs(float(g * n @ (c + turn @ b - a)))


def squares_of_columns(content: dict[str, Any]) -> list[float]:
    """k_j of the freedoms."""
    g = [float(x) for x in content["metric"]]
    whole = [1 / g[0], 1 / g[1], 1 / g[2], 1 / (g[1] * g[2]), 1 / (g[2] * g[0]), 1 / (g[0] * g[1])]
    return [whole[k] for k in content["freedoms"]]


def test_what_is_in_a_box_is_what_is_said_of_the_pose() -> None:
    at = at_certified_poses(golden("3-rrr"), model("3-rrr"), [0])[0]
    limits = {"speeds": 1, "forces": 2, "length": 3}
    content, _ = statics_box_certificate(at.measures(**limits), [1, 2, 3])
    for listed, there in (
        *zip(content["jacobian"][0], (at.jacobian[0, j] for j in range(3)), strict=True),
        *((content["indices"][key], at.indices(**limits)[key]) for key in ("sigma_min", "sigma_max", "condition")),
        *zip(content["actuator_forces"], at.forces([1, 2, 3]).values, strict=True),
        (content["velocity_polytope"]["volume"], at.velocity_polytope(1).volume),
        (content["wrench_polytope"]["volume"], at.wrench_polytope(2).volume),
    ):
        low, high = map(Fraction, listed)
        assert low <= there.hi
        assert there.lo <= high
        assert max(high - low, there.hi - there.lo) < 1e-3


def test_a_machine_that_has_none_is_refused_in_a_sentence(tmp_path: Path, capsys: Capture) -> None:
    target = tmp_path / "statics.json"
    words = ["--position", "31/5,-19/5", "--half-tangent=-1/14", "--modes", "+++", "-o", str(target)]
    assert main(["statics", "models/3-rrr.toml", *words]) == 2
    assert "must be rational but for one square root each actuator" in capsys.readouterr().err
    assert not target.exists()


def test_the_command_certifies_a_pose_of_a_certificate(tmp_path: Path, capsys: Capture) -> None:
    target = tmp_path / "statics.json"
    words = ["statics", "certs/3-rrr.json", "--model", "models/3-rrr.toml", "--pose", "2", "-o", str(target)]
    assert main([*words, "--limits", "speeds=1", "--limits", "length=3", "--load", "1,2,3"]) == 0
    content = json.loads(target.read_text())
    assert content["solution"] == {"digest": golden("3-rrr")["digest"], "pose": 2}
    assert main(["check", str(target)]) == 0
    assert "forces: those that bear the load" in capsys.readouterr().out
    assert main([*words, "--load", "1,2", "--load-at", "1,1"]) == 2
    assert "--load-at makes moments that are not exact" in capsys.readouterr().err
