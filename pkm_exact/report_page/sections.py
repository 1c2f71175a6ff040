"""The sections of the page as HTML: claim, poses, robot, proof."""

from __future__ import annotations

import shlex
from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass
from fractions import Fraction
from typing import TYPE_CHECKING, Any, Final

from pkm_exact.geometry.kinds import KINDS
from pkm_exact.pictures.captions import NEAREST
from pkm_exact.report_page.markup import Markup, element, joined
from pkm_exact.report_page.numerals import exact, in_unit, root_of, times_root, unit_words

if TYPE_CHECKING:
    from pkm_exact.geometry.mechanism import Mechanism
    from pkm_exact.pictures.shapes import Shape
    from pkm_exact.report_page.rows import PoseRows, Row
    from pkm_exact.report_page.words import Meaning

_GROUPS: Final = {1: "with det J > 0", -1: "with det J < 0", 0: "singular"}


@dataclass(frozen=True)
class Facts:
    """What the page says of the certificate itself.

    Attributes
    ----------
    file : str
        Name of its file.
    file_digest : str
        SHA-256 of the file, in hexadecimal digits.
    digest : str
        The one it contains.
    lines : tuple of str
        What the checker said.
    version : str
        Of the program that made the page.
    has_second_checker : bool
        Whether the checker in plain Python knows certificates of this kind.
    """

    file: str
    file_digest: str
    digest: str
    lines: tuple[str, ...]
    version: str
    has_second_checker: bool


def claim_section(meaning: Meaning, counts: Mapping[str, str]) -> Markup:
    """What is claimed, in plain words, and how many poses there are."""
    style = "sheet claim proved" if meaning.settled else "sheet claim"
    figures = (element("div", element("dt", name), element("dd", value)) for name, value in counts.items())
    return element(
        "section",
        element("h2", "The claim", id="claim-title", cls="unseen"),
        element(
            "div",
            element(
                "div",
                element("span", meaning.word, cls="verdict"),
                element("p", meaning.headline, cls="lead"),
                element("p", meaning.meaning),
            ),
            element("dl", *figures, cls="counts") if counts else "",
            cls="claim-head",
        ),
        cls=style,
        id="claim",
        aria_labelledby="claim-title",
    )


def reasons_section(meaning: Meaning, limits: Sequence[str], notes: Sequence[str]) -> Markup:
    """How the claim is proved, and what is not claimed."""
    remarks = [element("div", element("h3", "Notes"), _list(notes), cls="stack")] if notes else []
    return element(
        "section",
        element("h2", "What the claim means", id="reasons-title"),
        element(
            "div",
            element("div", element("h3", "How it is proved"), element("p", meaning.proof), cls="stack"),
            element("div", element("h3", "What is not claimed"), _list(limits), cls="stack"),
            *remarks,
            cls="columns small",
        ),
        cls="sheet",
        id="reasons",
        aria_labelledby="reasons-title",
    )


def _list(texts: Iterable[str]) -> Markup:
    return element("ul", *(element("li", text) for text in texts), cls="plain")


def groups(signs: Iterable[int | None]) -> str:
    """How many poses there are with each sign of det J."""
    found = list(signs)
    return ", ".join(f"{found.count(sign)} {word}" for sign, word in _GROUPS.items() if sign in found)


def pose_table(poses: PoseRows) -> Markup:
    """The table of poses: short numbers, all certain digits as data."""
    heads = [
        element("th", element("input", type="checkbox", aria_label="Tick all poses"), scope="col", cls="tick"),
        element("th", element("button", "pose", type="button"), scope="col", aria_sort="ascending"),
    ]
    heads += [
        element("th", element("button", column.title, type="button", title=column.meaning), scope="col")
        for column in poses.columns
    ]
    body = (_table_row(row, first=place == 0) for place, row in enumerate(poses.rows))
    return element(
        "table",
        element("caption", "All poses. The chosen row is drawn; ticked rows are copied.", cls="unseen"),
        element("thead", element("tr", *heads)),
        element("tbody", *body),
        id="pose-table",
        cls="poses",
        role="grid",
        aria_multiselectable="true",
        aria_label="Poses",
        aria_describedby="table-keys",
    )


def _table_row(row: Row, *, first: bool) -> Markup:
    box = element("input", type="checkbox", tabindex="-1", aria_label=f"Tick pose {row.number} for copying")
    cells = (
        element(
            "td",
            cell.text,
            data_value="" if cell.value is None else repr(cell.value).replace("inf", "Infinity"),
            data_full=None if cell.full == cell.text else cell.full,
        )
        for cell in row.cells
    )
    return element(
        "tr",
        element("td", box, cls="tick"),
        element(
            "th",
            f"{row.number}*" if row.is_nearest else str(row.number),
            scope="row",
            data_value=row.number,
            title=NEAREST if row.is_nearest else None,
        ),
        *cells,
        data_pose=row.number,
        tabindex="0" if first else "-1",
        aria_selected="false",
        aria_current="true" if first else None,
    )


def legend(legs: int, shapes: Sequence[Shape] = (), word: str = "leg") -> Markup:
    """Number and colour of each leg, and of what else holds the platform; ``word`` says what a leg is."""
    entries = [(i, f"{word} {i}") for i in range(1, legs + 1)]
    entries += [(shape.number, f"{shape.name} ({shape.kind})") for shape in shapes]
    return element("ul", *(element("li", _swatch(i), text) for i, text in entries), cls="legend small")


def _swatch(number: int) -> Markup:
    line = element("line", x1=2, y1=5, x2=20, y2=5, cls=f"leg leg-{(number - 1) % 6 + 1}")
    return element("svg", line, cls="swatch", viewBox="0 0 22 10", aria_hidden="true")


def robot_section(document: Mapping[str, Any], extra: Mapping[str, str], *, has_knees: bool) -> Markup:
    """The robot as the certificate has it, every number exactly."""
    robot, configuration = document["robot"], document["configuration"]
    kind = robot["kind"]
    facts = {
        "name": robot["name"],
        "kind": f"{kind}: {KINDS[kind].description}",
        "configuration": configuration["name"] or "leg lengths given freely",
        "unit of length": unit_words(robot["unit"]),
        "source": robot["source"],
        **extra,
    }
    entries = (joined(element("dt", key), element("dd", value)) for key, value in facts.items())
    foot = "knee (upper end of crank or slide)" if has_knees else "base joint"
    caption = (
        f"Joints and legs, exact. The {foot} is given in the fixed frame, the platform joint in the frame of the "
        f"platform{in_unit(robot['unit'])}."
    )
    return element(
        "section",
        element("h2", "The robot", id="robot-title"),
        element("div", element("dl", *entries, cls="facts"), _joint_table(document, caption, foot), cls="halves"),
        cls="sheet",
        id="robot",
        aria_labelledby="robot-title",
    )


def mechanism_section(mechanism: Mechanism, configuration: str | None) -> Markup:
    """A mechanism as the certificate has it: each constraint with its data, exactly."""
    facts = {
        "name": mechanism.name,
        "kind": f"{len(mechanism.constraints)} constraints on {mechanism.motion.title}",
        "configuration": configuration or "values given freely",
        "unit of length": unit_words(mechanism.unit),
        "source": mechanism.source,
    }
    if set(mechanism.metric) != {1}:
        facts["metric"] = f"{', '.join(map(str, mechanism.metric))}: coordinates times the roots of these are ordinary"
    entries = (joined(element("dt", key), element("dd", value)) for key, value in facts.items())
    rows = (
        element(
            "tr",
            element("th", _swatch(number), constraint.name, scope="row"),
            element("td", constraint.type),
            element("td", "; ".join(f"{field} {_data(getattr(constraint, field))}" for field in constraint.fields)),
        )
        for number, constraint in enumerate(mechanism.constraints, 1)
    )
    table = element(
        "table",
        element("caption", f"Constraints, exact, in the coordinates of the certificate{in_unit(mechanism.unit)}."),
        element("thead", element("tr", *(element("th", title, scope="col") for title in ("name", "type", "data")))),
        element("tbody", *rows),
    )
    return element(
        "section",
        element("h2", "The robot", id="robot-title"),
        element("div", element("dl", *entries, cls="facts"), element("div", table, cls="scroll"), cls="halves"),
        cls="sheet",
        id="robot",
        aria_labelledby="robot-title",
    )


def _data(value: object) -> str:
    return f"({', '.join(map(str, value))})" if isinstance(value, tuple) else str(value)


def _joint_table(document: Mapping[str, Any], caption: str, foot: str) -> Markup:
    robot = document["robot"]
    metric = [int(g) for g in robot["metric"]]
    count = 2 if len(robot["base"]) == 3 else 3
    axes = ("x", "y", "z")[:count]

    def cells(joint: Sequence[str]) -> Iterable[Markup]:
        values = zip(joint[:count], metric[:count], strict=True)
        return (element("td", times_root(Fraction(value), g)) for value, g in values)

    squares = document["configuration"]["lengths_squared"]
    rows = (
        element(
            "tr",
            element("th", _swatch(number), str(number), scope="row"),
            *cells(base),
            *cells(platform),
            element("td", root_of(Fraction(square))),
            element("td", exact(Fraction(square))),
        )
        for number, (base, platform, square) in enumerate(
            zip(robot["base"], robot["platform"], squares, strict=True), 1
        )
    )
    spans = element(
        "tr",
        element("th", "leg", scope="col", rowspan=2),
        element("th", foot, scope="colgroup", colspan=count),
        element("th", "platform joint", scope="colgroup", colspan=count),
        element("th", "length", scope="col", rowspan=2),
        element("th", "length squared", scope="col", rowspan=2),
    )
    names = element("tr", *(element("th", axis, scope="col") for axis in axes * 2))
    style = "joints planar" if count == 2 else "joints"
    parts = (element("caption", caption), element("thead", spans, names), element("tbody", *rows))
    table = element("table", *parts, cls=style)
    return element("div", table, cls="scroll fitting", tabindex="0", role="region", aria_label="Joints and legs")


def proof_section(facts: Facts, document: Mapping[str, Any]) -> Markup:
    """What the checker said, and how to ask it again."""
    return element(
        "section",
        element("h2", "What was checked, and how to check it again", id="proof-title"),
        element("div", _checked(facts.lines), _how_to_check(facts, document), cls="halves even"),
        cls="sheet",
        id="proof",
        aria_labelledby="proof-title",
    )


def _checked(lines: Iterable[str]) -> Markup:
    said = (
        "When this page was made, the checker accepted the certificate. It shares nothing with the solver, takes no "
        "count and no verdict from the file, and proved:"
    )
    return element(
        "div", element("p", said), element("ul", *(element("li", line) for line in lines), cls="checks"), cls="stack"
    )


def _how_to_check(facts: Facts, document: Mapping[str, Any]) -> Markup:
    """Commands, and the digests that tell whether it is the same certificate."""
    name = shlex.quote(facts.file if not facts.file.startswith("-") else f"./{facts.file}")
    commands = [f"certify-poses check {name}"]
    if facts.has_second_checker:
        commands.append(f"certify-poses check --pure {name}")
    commands.append(f"sha256sum {name}")
    second = " The second command asks another checker, written in plain Python." if facts.has_second_checker else ""
    origin = {
        "certificate": facts.file,
        "SHA-256 of the file": facts.file_digest,
        "digest inside, of its content": facts.digest,
    }
    if "method" in document:
        origin["solved by"] = f"{document['method']}, formulation {document['formulation']}"
    origin["page made by"] = f"pkm_exact {facts.version}"
    entries = (joined(element("dt", key), element("dd", element("code", value))) for key, value in origin.items())
    advice = (
        "This page proves nothing by itself, the certificate does. Compare its SHA-256 with the one below, and have it "
        f"checked.{second}"
    )
    lines = (element("code", command) for command in commands)
    return element(
        "div",
        element("p", advice),
        element("pre", *lines, tabindex="0", role="region", aria_label="Commands"),
        element("dl", *entries, cls="facts small"),
        cls="stack",
    )
