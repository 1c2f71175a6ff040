"""The published schemas and the page that defines the format: they say the same, and certificates are so."""

import json
import re
from functools import cache
from importlib import resources
from itertools import chain
from typing import Any

import jsonschema
import pytest
from certificate_subjects import SUBJECTS, subject
from certificate_tools import CERTS, golden, leaves, with_entry
from mutations import FREE

from pkm_exact.certify import (
    build,
    build_constraints,
    links_build,
    mobility_build,
    mobility_second_build,
    mobility_third_build,
    platform_build,
    pure,
    region_build,
    region_build_2,
    statics_box_build,
    statics_build,
    statics_driven_build,
    statics_equations_build,
    system_build,
    tolerance_build,
)
from pkm_exact.certify.build import sealed
from pkm_exact.certify.checker import document, tolerance_document, verdict
from pkm_exact.certify.checker.certificate_kinds import KINDS, CertificateKind

POSES, TOLERANCES = "certificate-1.schema.json", "tolerance-certificate-1.schema.json"
SECOND = "certificate-2.schema.json"
MOBILITY = "mobility-certificate-1.schema.json"
MOBILITY_2 = "mobility-certificate-2.schema.json"
MOBILITY_3 = "mobility-certificate-3.schema.json"
PLATFORM = "platform-certificate-1.schema.json"
SYSTEMS = "system-certificate-1.schema.json"
REGIONS = "region-certificate-1.schema.json"
REGIONS_2 = "region-certificate-2.schema.json"
STATICS = "statics-certificate-1.schema.json"
STATICS_2 = "statics-certificate-2.schema.json"
STATICS_3 = "statics-certificate-3.schema.json"
STATICS_4 = "statics-certificate-4.schema.json"
LINKS = "links-certificate-1.schema.json"
LINKS_2 = "links-certificate-2.schema.json"
GOLDEN = sorted(path.stem for path in CERTS.glob("*.json"))
QUICK = [name for name, entry in SUBJECTS.items() if entry.quick]


@cache
def _schema(name: str) -> Any:
    return json.loads(resources.files("pkm_exact.certify").joinpath(name).read_text("utf-8"))


def schema_of(content: Any) -> jsonschema.Draft202012Validator:
    """The validator for a certificate of this kind."""
    by_format = {tolerance_build.FORMAT: TOLERANCES, mobility_build.FORMAT: MOBILITY}
    by_format[platform_build.FORMAT] = PLATFORM
    name = by_format.get(content["format"], POSES)
    name = {POSES: SECOND, MOBILITY: MOBILITY_2}[name] if content["version"] == 2 else name
    name = MOBILITY_3 if content["version"] == 3 else name
    return jsonschema.Draft202012Validator(_schema(name))


@pytest.mark.parametrize(
    "name",
    [
        *(POSES, SECOND, TOLERANCES, SYSTEMS, MOBILITY, MOBILITY_2, MOBILITY_3, PLATFORM),
        *(REGIONS, REGIONS_2, STATICS, LINKS, LINKS_2, STATICS_2, STATICS_3),
    ],
)
def test_schemas_are_schemas(name: str) -> None:
    jsonschema.Draft202012Validator.check_schema(_schema(name))


@pytest.mark.parametrize("name", GOLDEN)
def test_golden_certificates_fit(name: str) -> None:
    schema_of(golden(name)).validate(golden(name))


@pytest.mark.parametrize("name", QUICK)
def test_certificates_of_every_kind_fit(name: str) -> None:
    content = sealed(subject(name))
    schema_of(content).validate(content)


# Keys


def _objects(value: Any, node: Any, root: Any) -> Any:
    """Every object below a value, with the part of the schema that describes it."""
    while "$ref" in node:
        node = root["$defs"][node["$ref"].rpartition("/")[2]]
    for choice in node.get("anyOf", ()):
        word = choice.get("properties", {}).get("type", {}).get("const")
        is_other = word is not None and word != value["type"]
        if choice != {"type": "null"} and value is not None and not is_other:
            node = choice
            while "$ref" in node:
                node = root["$defs"][node["$ref"].rpartition("/")[2]]
    if isinstance(value, dict):
        yield value, node
        yield from chain.from_iterable(_objects(value[key], node["properties"][key], root) for key in value)
    elif isinstance(value, list) and node["items"] is not False:  # no objects in lists of a fixed length
        yield from chain.from_iterable(_objects(entry, node["items"], root) for entry in value)


@pytest.mark.parametrize("name", QUICK)
def test_schemas_know_every_key_and_its_order(name: str) -> None:
    content = sealed(subject(name))
    root = schema_of(content).schema
    for value, node in _objects(content, root, root):
        assert list(value) == list(node["properties"]) == node["required"]
        assert node["additionalProperties"] is False


@pytest.mark.parametrize("wrong", [1.5, True, [], {}, "nonsense!"])
@pytest.mark.parametrize("name", ["planar, representation", "moving beside isolated poses", "tolerance-open, planar"])
def test_schemas_refuse_what_is_malformed(name: str, wrong: Any) -> None:
    content = sealed(subject(name))
    texts = [free.path.split(".") for free in FREE if free.reason == "describes" and free.path != "formulation"]
    for number, (path, value) in enumerate(leaves(content)):
        if number % 7 == 0 and list(map(str, path[:2])) not in texts and path[0] != "notes" and value is not wrong:
            assert not schema_of(content).is_valid(with_entry(content, path, wrong)), path


@pytest.mark.parametrize(
    ("name", "path", "value"),
    [
        ("planar, boxes", ("robot", "metric", 2), "2"),
        ("planar, boxes", ("robot", "base", 0, 2), "1"),
        ("planar, boxes", ("robot", "base"), [["0", "0", "0"]] * 6),
        ("general 6-6, boxes", ("robot", "kind"), "3-RPR"),
        ("general 6-6, boxes", ("configuration", "lengths_squared"), ["1"] * 3),
        ("nothing known", ("box_exponent",), 31),
        ("moving, dependent legs", ("poses",), [None]),
        ("tolerance, planar, complete", ("complete",), False),
        ("tolerance-open, planar", ("complete",), True),
        ("tolerance-open, planar", ("boxes", 0, "outer", 0), "0x0"),
    ],
)
def test_schemas_refuse_what_does_not_go_together(name: str, path: Any, value: Any) -> None:
    content = sealed(subject(name))
    assert not schema_of(content).is_valid(with_entry(content, path, value))


# The page


def _tables(start: str, end: str, name: str = "certificates.md") -> list[list[str]]:
    """The keys in the tables between two headings of the page."""
    page = (CERTS.parent / "docs" / name).read_text()
    part = page.partition(f"\n## {start}\n")[2].partition(f"\n{end}\n")[0]
    tables = part.split("| key | value |\n|---|---|\n")[1:]
    return [re.findall(r"^\| `(\w+)` \|", table.partition("\n\n")[0], flags=re.MULTILINE) for table in tables]


def _keys(node: Any) -> list[str]:
    return list(node["properties"])


def test_the_page_defines_every_key_in_its_order() -> None:
    root = _schema(POSES)
    parts = [root["properties"][key] for key in ("robot", "configuration")]
    parts += [root["$defs"][key] for key in ("representation", "krawczyk", "pose")]
    assert _tables("Format", "### Spelling") == [_keys(root), *map(_keys, parts)]
    root = _schema(TOLERANCES)
    parts = [root["properties"][key] for key in ("tolerances", "frames")]
    expected = [_keys(root), *map(_keys, parts), _keys(root["$defs"]["poseBox"])]
    assert _tables("Tolerance certificates", "## References") == expected


def test_the_page_of_version_2_defines_every_key_in_its_order() -> None:
    root = _schema(SECOND)
    definitions = root["$defs"]
    assert _tables("Format", "### Forms", "certificates-2.md") == [_keys(root), _keys(root["properties"]["robot"])]
    parts = [definitions[key] for key in ("infinity", "selfMotion")]
    assert _tables("Checks", "## What the digest binds", "certificates-2.md") == [_keys(part) for part in parts]
    page = (CERTS.parent / "docs" / "certificates-2.md").read_text()
    listed = re.findall(r'^\| `"([a-z-]+)"` \| (.*) \| .* \|$', page, flags=re.MULTILINE)
    data = {name: re.findall(r"`(\w+)`", fields) for name, fields in listed}
    choices = [choice["properties"] for choice in definitions["constraint"]["anyOf"]]
    assert data == {keys["type"]["const"]: list(keys)[2:-1] for keys in choices}
    words = definitions["selfMotion"]["properties"]["cause"]["enum"] + root["properties"]["completeness_route"]["enum"]
    assert all(f'"{word}"' in page for word in words if word)


def test_the_page_of_systems_defines_every_key_in_its_order() -> None:
    root = _schema(SYSTEMS)
    parts = [root["$defs"][key] for key in ("representation", "infinity", "subdivision", "witness", "solution")]
    assert _tables("Format", "### Polynomials", "certificates-systems.md") == [_keys(root), *map(_keys, parts)]
    page = (CERTS.parent / "docs" / "certificates-systems.md").read_text()
    words = [root["properties"][key]["enum"] for key in ("claim", "completeness_route")]
    words.append(root["$defs"]["witness"]["properties"]["cause"]["enum"])
    assert all(f'"{word}"' in page for word in chain.from_iterable(words) if word)


def test_the_page_of_mobility_defines_every_key_in_its_order() -> None:
    root = _schema(MOBILITY)
    definitions, parts = root["$defs"], [root]
    parts += [definitions[key] for key in ("mechanism", "joint", "rankProof")]
    parts += [root["properties"]["mobility"], root["properties"]["actuator_sets"]]
    parts += [definitions[key] for key in ("sets", "finite", "leg")]
    assert _tables("Format", "## Checks", "certificates-mobility.md") == [_keys(part) for part in parts]
    second = _schema(MOBILITY_2)["$defs"]
    expected = [_keys(second[key]) for key in ("finite", "above", "below")]
    assert _tables("Version 2", "## Version 3", "certificates-mobility.md") == expected
    third = _schema(MOBILITY_3)["$defs"]
    assert _tables("Version 3", "## What the digest binds", "certificates-mobility.md") == [
        _keys(third["below"])[-1:],
        _keys(third["curve"]),
    ]
    page = (CERTS.parent / "docs" / "certificates-mobility.md").read_text()
    words = [
        word
        for root in (second, third)
        for key in ("finite", "above", "below")
        for word in root[key]["properties"]["argument"]["enum"]
    ]
    assert all(f'`"{word}"`' in page for word in words)


def test_the_page_of_platforms_defines_every_key_in_its_order() -> None:
    root = _schema(PLATFORM)
    parts = [root, *(root["$defs"][key] for key in ("pose", "everywhere"))]
    assert _tables("Format", "## Rows", "certificates-platform.md") == [_keys(part) for part in parts]
    page = (CERTS.parent / "docs" / "certificates-platform.md").read_text()
    assert all(f'"{word}"' in page for word in root["$defs"]["everywhere"]["properties"]["route"]["enum"])


def test_the_page_of_regions_defines_every_key_in_its_order() -> None:
    root = _schema(REGIONS)
    assert _tables("Format", "## Robot and chart", "certificates-regions.md") == [_keys(root)]
    page = (CERTS.parent / "docs" / "certificates-regions.md").read_text()
    words = [key for part in ("robot", "chart") for key in root["properties"][part]["properties"]]
    words += [key for part in ("leg", "slide", "crank", "cone") for key in root["$defs"][part]["properties"]]
    assert all(f"`{word}`" in page or word in page for word in words)
    assert all(f'"{word}"' in page for word in root["properties"]["claim"]["enum"])
    root = _schema(REGIONS_2)
    assert _tables("Version 2", "### Curves, tubes and joint values", "certificates-regions.md") == [_keys(root)]
    words = ["leg_distance", "path", "axis", "corners", "radius", "along"]
    assert all(f"`{word}`" in page and f'"{word}"' in json.dumps(root) for word in words)


def test_the_page_of_statics_defines_every_key_in_its_order() -> None:
    root = _schema(STATICS)
    assert _tables("Format", "### Claims", "certificates-statics.md") == [_keys(root)]
    second = _schema(STATICS_2)
    page = (CERTS.parent / "docs" / "certificates-statics.md").read_text()
    assert _keys(_schema(STATICS_3)) == _keys(root)
    third = page.partition("## Version 3")[2]
    assert all(f"`{key}`" in third for key in _schema(STATICS_3)["properties"]["legs"]["items"]["properties"])
    fourth = page.partition("## Version 4")[2].partition("### What")[0]
    rows = re.findall(r"^\| (`.*?) \|", fourth, re.M)
    assert [key for row in rows for key in re.findall(r"`(\w+)`", row)] == list(_schema(STATICS_4)["properties"])
    keys, parts = page.partition("## Version 2")[2].partition("### What is claimed")[0].split("| part |")
    assert re.findall(r"^\| `(\w+)` \|", keys, re.M) == list(second["properties"])
    for name in ("solution", "velocity_polytope", "wrench_polytope", "ellipsoid"):
        row = next(line for line in parts.splitlines() if line.startswith(f"| `{name}` |"))
        words = re.findall(r"`(\w+)`", row)[1:]
        assert words == list(second["properties"][name]["anyOf"][0]["properties"])


def test_the_page_of_links_defines_every_key_in_its_order() -> None:
    root = _schema(LINKS)
    parts = [root, *(root["$defs"][key] for key in ("mechanism", "body", "joined", "box"))]
    assert _tables("Format", "## Unknowns and polynomials", "certificates-links.md") == [_keys(part) for part in parts]
    second = _schema(LINKS_2)
    assert _keys(second) == _keys(root)
    keys = _keys(root["$defs"]["mechanism"])
    place = keys.index("planar") + 1
    assert _keys(second["$defs"]["mechanism"]) == [*keys[:place], "metric", *keys[place:]]


def test_words_and_limits_are_the_same_everywhere() -> None:
    root = _schema(POSES)["properties"]
    for words, key in ((document.METHODS, "method"), (document.CLAIMS, "claim")):
        assert list(words) == root[key]["enum"]
    assert (*document.ROUTES, None) == tuple(root["completeness_route"]["enum"])
    assert list(document.KINDS) == root["robot"]["properties"]["kind"]["enum"]
    assert (pure.METHODS, pure.CLAIMS, pure.ROUTES) == (document.METHODS, document.CLAIMS, document.ROUTES)
    assert root["box_exponent"]["maximum"] == verdict.MAX_BOX_EXPONENT == pure.MAX_BOX_EXPONENT
    assert _schema(POSES)["$defs"]["grid"]["items"]["maximum"] == verdict.MAX_GRID_EXPONENT == pure.MAX_BOX_GRID
    exponent = _schema(TOLERANCES)["properties"]["exponent"]["maximum"]
    assert exponent == tolerance_document.MAX_EXPONENT == pure.MAX_TOLERANCE_GRID


@pytest.mark.parametrize("kind", KINDS, ids=lambda kind: f"{kind.format} {kind.version}")
def test_versions_are_the_same_everywhere(kind: CertificateKind) -> None:
    writers = (build, build_constraints, tolerance_build, system_build, mobility_build, region_build, statics_build)
    writers = (
        *writers,
        mobility_second_build,
        mobility_third_build,
        platform_build,
        links_build,
        region_build_2,
        statics_box_build,
        statics_driven_build,
        statics_equations_build,
    )
    versions = [(w.FORMAT, w.VERSION) for w in writers]
    versions.append((links_build.FORMAT, links_build.IN_A_METRIC))
    assert versions.count((kind.format, kind.version)) == 1
    stem = kind.format.removeprefix("pkm_exact ").replace(" ", "-")
    name = f"{stem}-{kind.version}.schema.json"
    schema = _schema(name)
    assert schema["properties"]["version"]["const"] == kind.version
    assert schema["properties"]["format"]["const"] == kind.format
    assert schema["$id"].endswith(f"-{kind.version}")
    pages = (CERTS.parent / "docs").glob("certificates*.md")
    assert any(name in page.read_text() for page in pages)
