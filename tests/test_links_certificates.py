"""Certificates of mechanisms with passive bodies: honest ones are accepted by both checkers, forged ones by neither."""

import json
from collections.abc import Callable
from copy import deepcopy
from functools import cache
from math import dist
from pathlib import Path
from typing import Any

import jsonschema
import pytest
from certificate_tools import Path_, both, both_resealed, last_line, leaves, neighbours, with_entry

from pkm_exact.certify import pure
from pkm_exact.certify.build import canonical_bytes, sealed
from pkm_exact.certify.check import check_bytes
from pkm_exact.certify.links_build import links_certificate_bytes
from pkm_exact.cli.main import main
from pkm_exact.geometry.links import Links
from pkm_exact.geometry.reader import any_from_toml, read_links
from pkm_exact.links.link_engine import solve_links
from pkm_exact.links.start_box import solve_from_start
from pkm_exact.pictures.links_scene import links_scene

Content = dict[str, Any]
ROOT = Path(__file__).parent.parent
MODELS, CERTS = ROOT / "models" / "links", ROOT / "certs" / "links"
NAMES = sorted(path.stem for path in MODELS.glob("*.toml"))
SLOW = ("watt", "stephenson", "micabo-h-links")
IN_METRIC = json.loads(Path(pure.__file__).with_name("links-certificate-2.schema.json").read_text())
SCHEMA = json.loads(Path(pure.__file__).with_name("links-certificate-1.schema.json").read_text())


def _each(names: list[str]) -> list[Any]:
    return [pytest.param(name, marks=pytest.mark.slow if name in SLOW else ()) for name in names]


@cache
def _box_bytes(name: str) -> bytes:
    return links_certificate_bytes(solve_from_start(read_links(MODELS / f"{name}.toml")))


def _exact(name: str = "four-bar") -> Content:
    found: Content = json.loads((CERTS / f"{name}.json").read_bytes())
    return found


def _box(name: str = "four-bar") -> Content:
    found: Content = json.loads(_box_bytes(name))
    return found


def test_every_model_has_a_certificate() -> None:
    assert sorted(path.stem for path in CERTS.glob("*.json")) == NAMES


@pytest.mark.parametrize("name", _each(NAMES))
def test_golden_certificates_are_made_again(name: str) -> None:
    links = read_links(MODELS / f"{name}.toml")
    found = solve_from_start(links) if name.startswith("5-") else solve_links(links)
    assert links_certificate_bytes(found) == (CERTS / f"{name}.json").read_bytes()


@pytest.mark.parametrize("name", NAMES)
def test_golden_certificates_are_accepted_by_both(name: str) -> None:
    data = (CERTS / f"{name}.json").read_bytes()
    assert both(data)
    content = json.loads(data)
    jsonschema.Draft202012Validator(SCHEMA if content["version"] == 1 else IN_METRIC).validate(content)


def test_a_spatial_box_is_accepted_by_both() -> None:
    verdict = both(_box_bytes("micabo-h-links"))
    assert last_line(verdict) == "not proven complete: one pose is proved, others are not excluded"


@pytest.mark.parametrize("method", ["exact", "krawczyk"])
def test_certificates_in_a_metric_are_accepted_by_both(method: str) -> None:
    links = any_from_toml(TRIANGLE)
    assert isinstance(links, Links)
    found = solve_links(links) if method == "exact" else solve_from_start(links)
    data = links_certificate_bytes(found)
    assert both(data)
    content = json.loads(data)
    jsonschema.Draft202012Validator(IN_METRIC).validate(content)
    assert not jsonschema.Draft202012Validator(SCHEMA).is_valid(content)
    assert content["mechanism"]["metric"] == ["1", "3", "1"]
    for other in (["1", "1", "1"], ["3", "1", "1"]):
        forged = with_entry(content, ("mechanism", "metric"), other)
        assert both_resealed(forged).status == "rejected"
    scene = links_scene(content)
    (first, *_) = scene.poses
    pose = found.platform_pose(found.assemblies[0])
    assert first.position == pytest.approx([float(x.midpoint) for x in pose.position])
    for row, other in zip(first.rotation, pose.rotation, strict=True):
        assert row == pytest.approx([float(x.midpoint) for x in other])
    for bar in (part for part in first.parts if part.kind == "bar"):
        assert dist(*bar.points) == pytest.approx(6 if bar.name == "link" else 5)


HEAD = 'schema = 1\nname = "x"\nkind = "links"\nunit = "m"\nsource = "a test"\n'
TRIANGLE = (
    HEAD
    + """motion = "planar"
metric = [1, 3]
[platform]
body = "triangle"
[[bodies]]
name = "crank"
start = { position = [0, 0], half_tangent = "1/2" }
[[bodies]]
name = "triangle"
start = { position = [2, 3], half_tangent = "1/3" }
"""
)
TRIANGLE += """[[constraints]]
name = "hinge"
type = "at-point"
bodies = ["base", "crank"]
point = [0, 0]
platform = [0, 0]
[[constraints]]
name = "locked"
type = "angle"
bodies = ["base", "crank"]
base = [1, 0]
platform = [1, 0]
product = "1/2"
[[constraints]]
name = "pin"
type = "at-point"
bodies = ["crank", "triangle"]
point = [4, 0]
platform = [2, 0]
[[constraints]]
name = "rod"
type = "distance"
bodies = ["base", "triangle"]
base = [6, "1/2"]
platform = [-1, 1]
length_squared = 25
"""
TABLES = {
    "a point in the plane": (
        'motion = "planar"\n[[bodies]]\nname = "point"\nmotion = "translation"\n[[constraints]]\nname = "pin"\n'
        'type = "at-point"\nbodies = ["base", "point"]\npoint = ["1/3", 2]\nplatform = [0, 1]\n'
    ),
    "a turning body": '[[bodies]]\nname = "ball"\nmotion = "spherical"\n'
    + "".join(
        f'[[constraints]]\nname = "{i}{j}"\ntype = "angle"\nbodies = ["base", "ball"]\nproduct = 0\n'
        f"base = {[int(k == i) for k in range(3)]}\nplatform = {[int(k == j) for k in range(3)]}\n"
        for i, j in ((0, 1), (1, 2), (0, 2))
    ),
}


def _small(name: str) -> Content:
    """The certificate of one pose of a mechanism with one body."""
    links = any_from_toml(HEAD + TABLES[name])
    assert isinstance(links, Links)
    found: Content = json.loads(links_certificate_bytes(solve_from_start(links)))
    return found


@pytest.mark.parametrize("name", TABLES)
def test_certificates_of_one_body_are_accepted_by_both(name: str) -> None:
    assert both_resealed(_small(name))


def _turned_over() -> Content:
    """R = diag(1, 1, -1) fulfils all equations, as R = 1 does."""
    content = _small("a turning body")
    centre = content["box"]["centre"]
    return with_entry(content, ("box", "centre", 8), hex(-int(centre[8], 16)))


# Forgeries: each is consistent in all else


def _with(content: Content, *path: Any, value: Any) -> Content:
    return with_entry(content, path, value)


def _without_last(content: Content) -> Content:
    return _with(content, "mechanism", "joined", value=content["mechanism"]["joined"][:-1])


def _exchanged(content: Content) -> Content:
    """Two polynomials in another order: the same system, and none of the mechanism's in its place."""
    polynomials = list(content["system"]["polynomials"])
    polynomials[0], polynomials[1] = polynomials[1], polynomials[0]
    return _with(content, "system", "polynomials", value=polynomials)


def _twice(content: Content) -> Content:
    joined = content["mechanism"]["joined"]
    return _with(content, "mechanism", "joined", value=[*joined, joined[0]])


def _renamed(content: Content, v: str = "v") -> Content:
    """All variables of the system called by other names."""
    text = json.dumps(content["system"])
    for name in content["system"]["variables"]:
        text = text.replace(f'"{name}"', f'"{v}{name}"')
        for sign in ("-", "*", '"'):
            text = text.replace(f"{sign}{name}*", f"{sign}{v}{name}*").replace(f"{sign}{name}^", f"{sign}{v}{name}^")
            text = text.replace(f'{sign}{name}"', f'{sign}{v}{name}"')
    return {**content, "system": json.loads(text)}


def _moved(content: Content) -> Content:
    """A pin elsewhere, its forms with it."""
    constraint = deepcopy(content["mechanism"]["joined"][0]["constraint"])
    constraint["point"][0] = "2"
    constraint["forms"][0][16] = "-2"
    return _with(content, "mechanism", "joined", 0, "constraint", value=constraint)


def _other_bodies(content: Content) -> Content:
    """The pin of coupler and rocker belongs to the ground and the rocker."""
    return _with(content, "mechanism", "joined", 1, "bodies", value=[0, 2])


def _translated(content: Content) -> Content:
    return _with(content, "mechanism", "bodies", 1, "motion", value="translation")


def _shifted(units: int, place: int = 2) -> Callable[[Content], Content]:
    def change(content: Content) -> Content:
        centre = content["box"]["centre"]
        return _with(content, "box", "centre", place, value=hex(int(centre[place], 16) + units))

    return change


def _wide(content: Content) -> Content:
    """All of a wide box, on a grid so coarse that both poses are in it."""
    box = {"exponent": 0, "radius": 20, "centre": ["0x0"] * len(content["box"]["centre"])}
    return {**content, "box": box}


def _mirrored(content: Content) -> Content:
    """R less its third column, C and the rest alike: joints in the plane z = 0 of the platform do not see it."""
    centre = list(content["box"]["centre"])
    for place in (-7, -4, -1):
        centre[place] = hex(-int(centre[place], 16))
    return {**content, "box": {**content["box"], "centre": centre}}


FORGERIES: dict[str, tuple[Callable[[], Content], str]] = {
    "a pin moved": (lambda: _moved(_exact()), "system: its polynomials are not those of the mechanism"),
    "a pin left out": (lambda: _without_last(_exact()), "system: its polynomials are not those of the mechanism"),
    "other bodies": (lambda: _other_bodies(_exact()), "system: its polynomials are not those of the mechanism"),
    "polynomials exchanged": (lambda: _exchanged(_exact()), "system: its polynomials are not those of the mechanism"),
    "variables renamed": (lambda: _renamed(_exact()), "system: its variables are not the unknowns of the bodies"),
    "variables renamed otherwise": (
        lambda: _renamed(_exact(), "a"),
        "system: its variables are not the unknowns of the bodies",
    ),
    "a box with a pin twice": (lambda: _twice(_box()), "box: 10 polynomials in 8 unknowns, not as many"),
    "a box beside in the first unknown": (
        lambda: _shifted(1 << 16, 0)(_box()),
        "box: that it holds exactly one pose is not proved",
    ),
    "a box beside in the last unknown": (
        lambda: _shifted(1 << 16, 7)(_box()),
        "box: that it holds exactly one pose is not proved",
    ),
    "the only body mirrored": (_turned_over, "box: that body 1 is turned and not mirrored is not proved"),
    "another motion": (lambda: _translated(_exact()), "system: its variables are not the unknowns of the bodies"),
    "forms of another pin": (
        lambda: _with(_exact(), "mechanism", "joined", 0, "constraint", "forms", 0, 16, value="-2"),
        "its forms are not those of its data",
    ),
    "a system that claims too much": (
        lambda: _with(_exact(), "system", "complex_solutions", value=3),
        "complex solutions: ",
    ),
    "a box with a pin moved": (lambda: _moved(_box()), "box: that it holds exactly one pose is not proved"),
    "a box with a pin left out": (lambda: _without_last(_box()), "box: 6 polynomials in 8 unknowns, not as many"),
    "a box beside the pose": (lambda: _shifted(1 << 16)(_box()), "box: that it holds exactly one pose is not proved"),
    "a box with both poses": (lambda: _wide(_box()), "box: that it holds exactly one pose is not proved"),
    "a body mirrored": (
        lambda: _mirrored(_box("micabo-h-links")),
        "box: that body 7 is turned and not mirrored is not proved",
    ),
}


@pytest.mark.parametrize("name", FORGERIES)
def test_forged_certificates_are_rejected_for_their_one_fault(name: str) -> None:
    make, reason = FORGERIES[name]
    verdict = both_resealed(make())
    assert verdict.status == "rejected"
    assert reason in last_line(verdict)


MALFORMED: dict[str, tuple[Path_, Any]] = {
    "version": (("version",), 2),
    "method": (("method",), "krawczyk"),
    "no system": (("system",), None),
    "a box too many": (("box",), {"exponent": 1, "radius": 1, "centre": ["0x0"] * 8}),
    "the format of the system": (("system", "format"), "pkm_exact certificate"),
    "the version of the system": (("system", "version"), 2),
    "a variable that is no text": (("system", "variables", 1), None),
    "no body": (("mechanism", "bodies"), []),
    "no constraint": (("mechanism", "joined"), []),
    "a motion out of the plane": (("mechanism", "bodies", 0, "motion"), "spatial"),
    "a platform that there is not": (("mechanism", "platform"), 3),
    "the ground as the second": (("mechanism", "joined", 0, "bodies"), [1, 0]),
    "a body twice": (("mechanism", "joined", 0, "bodies"), [1, 1]),
    "a body that there is not": (("mechanism", "joined", 0, "bodies"), [0, 3]),
    "neither true nor false": (("mechanism", "planar"), 1),
    "the first that there is not": (("mechanism", "joined", 0, "bodies"), [3, 1]),
    "bodies that are no list": (("mechanism", "bodies"), {}),
    "a system that is none": (("system",), []),
    "a version that is no number": (("system", "version"), True),
    "a name that is none": (("mechanism", "name"), 1),
    "a source that is none": (("mechanism", "source"), 1),
    "a name of a body that is none": (("mechanism", "bodies", 0, "name"), 1),
    "a note that is none": (("notes",), [1]),
    "a configuration that is none": (("configuration",), None),
}


@pytest.mark.parametrize("name", MALFORMED)
def test_what_is_no_certificate_is_malformed(name: str) -> None:
    path, value = MALFORMED[name]
    assert both_resealed(with_entry(_exact(), path, value)).status == "malformed"


def test_the_method_has_its_own_part_only() -> None:
    both_parts = {**_exact(), "method": "krawczyk", "box": _box()["box"]}
    assert both_resealed(both_parts).status == "malformed"


@pytest.mark.parametrize(
    ("path", "value", "status"),
    [
        (("box", "radius"), 0, "malformed"),
        (("box", "radius"), 10**9 + 1, "malformed"),
        (("box", "exponent"), -1, "malformed"),
        (("box", "exponent"), 8193, "too-large"),
        (("box", "centre"), ["0x0"] * 7, "malformed"),
        (("box", "centre", 0), "0x00", "malformed"),
    ],
)
def test_boxes_have_one_shape(path: Path_, value: Any, status: str) -> None:
    assert both_resealed(with_entry(_box(), path, value)).status == status


def test_too_many_unknowns_are_too_large() -> None:
    content = _exact()
    bodies = [{"name": "b", "motion": "spatial"}] * 6
    changed = {**content, "mechanism": {**content["mechanism"], "planar": False, "bodies": bodies}}
    assert both_resealed(changed).status == "too-large"


DESCRIBES = ("name", "unit", "source", "configuration")
"""Entries that another digest may cover; of a box all: one that is a little different holds the same pose."""


def _is_free(path: Path_) -> bool:
    return path[0] in ("box", "notes") or path[-1] in DESCRIBES or path[1:] in (("title",), ("platform",))


@pytest.mark.parametrize(("make", "every"), [(_exact, 9), (_box, 4)])
def test_what_is_changed_is_refused_with_a_new_digest_too(make: Callable[[], Content], every: int) -> None:
    content = make()
    tried = 0
    for number, (path, value) in enumerate(leaves({k: v for k, v in content.items() if k != "digest"})):
        if number % every or _is_free(path) or isinstance(value, bool):
            continue
        for other in neighbours(value)[:1]:
            tried += 1
            assert both_resealed(with_entry(content, path, other)).status != "accepted", (path, other)
    assert tried > 15


def test_a_change_without_a_new_digest_is_seen() -> None:
    content = with_entry(_exact(), ("configuration",), "another")
    data = canonical_bytes(content)
    assert (check_bytes(data).status, pure.check_bytes(data).status) == ("rejected", "rejected")
    assert both(canonical_bytes(sealed(content)))


def test_the_command_writes_certificates_of_one_pose(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    path = tmp_path / "one.json"
    words = ["solve", str(MODELS / "four-bar.toml"), "--method", "krawczyk", "--start", "1,2,30", "-o", str(path)]
    assert main([*words, "--format", "json"]) == 3
    printed = json.loads(capsys.readouterr().out)
    assert (printed["method"], printed["claim"], printed["real_poses"]) == ("krawczyk", "not-proven-complete", 1)
    assert main(["check", str(path)]) == main(["check", "--pure", str(path)]) == 0
    assert "others are not excluded" in capsys.readouterr().out
