"""The page as a whole: one HTML document that loads nothing, and says so to the browser.

Its Content-Security-Policy allows the one script and the one style sheet in it, by their digests, and nothing else: no
connection, no image, no form, no evaluation of text.
"""

from __future__ import annotations

from base64 import b64encode
from collections.abc import Mapping, Sequence
from fractions import Fraction
from hashlib import sha256
from importlib.resources import files
from string import Template
from typing import TYPE_CHECKING, Any, Final

import pkm_exact
from pkm_exact.certify.build import canonical_bytes
from pkm_exact.certify.certified_machine import certified_machine, is_of_legs
from pkm_exact.certify.legs_view import legs_view
from pkm_exact.errors import InputError
from pkm_exact.geometry.kinds import KINDS
from pkm_exact.geometry.machine import locked_at
from pkm_exact.geometry.mechanism import Mechanism
from pkm_exact.geometry.robot import Robot
from pkm_exact.pictures.captions import NEAREST, leg_word
from pkm_exact.pictures.scene import configuration_of, scene_of
from pkm_exact.report_page.markup import Markup, element, embedded_json, joined
from pkm_exact.report_page.numerals import exact, unit_words
from pkm_exact.report_page.payload import payload
from pkm_exact.report_page.rows import PoseRows, certified_rows
from pkm_exact.report_page.sections import (
    Facts,
    claim_section,
    groups,
    legend,
    mechanism_section,
    pose_table,
    proof_section,
    reasons_section,
    robot_section,
)
from pkm_exact.report_page.tolerance_page import tolerance_rows, tolerance_scene
from pkm_exact.report_page.words import Meaning, is_of_tolerances, limits_of, meaning_of
from pkm_exact.wording import with_unit

if TYPE_CHECKING:
    from pkm_exact.geometry.machine import Machine
    from pkm_exact.pictures.drawn_robot import Scene

SCRIPTS: Final = ("view.js", "controls.js", "table.js", "report.js")
_PRESETS: Final = {"reset": "Reset", "top": "Top", "front": "Front", "side": "Side"}


def report_page(
    document: Mapping[str, Any],
    lines: tuple[str, ...],
    file: str,
    robot: Machine | None = None,
    limits: Mapping[str, Any] | None = None,
    near: Sequence[Fraction] | None = None,
) -> str:
    """The page on an accepted certificate, of poses or of tolerances.

    Parameters
    ----------
    document : mapping
        Content of the certificate.
    lines : tuple of str
        What the checker said of it, line by line.
    file : str
        Name of the certificate's file, without folders.
    robot : Machine, optional
        The model; with it, cranks and slides are drawn, and it is said which of its limits each pose keeps.
    limits : mapping, optional
        What actuators can do, as for ``statics.limits_of_actuators``: speeds, forces, length, ..
    near : sequence of Fraction, optional
        The pose that is meant, as for ``scene_of``.

    Raises
    ------
    InputError
        If the certificate is not one of the given robot, or its numbers are too large to be drawn.
    """
    tolerances = is_of_tolerances(document)
    machine = None if tolerances or is_of_legs(document) else certified_machine(document)
    mechanism = machine if isinstance(machine, Mechanism) else None
    shown_robot = document if tolerances or mechanism else legs_view(document)
    facts = Facts(
        file,
        sha256(canonical_bytes(document)).hexdigest(),
        document["digest"].removeprefix("sha256:"),
        lines,
        pkm_exact.__version__,
        not tolerances,
    )
    scene, poses = _within_tolerance(document, robot, near) if tolerances else _certified(document, robot, near)
    meaning = meaning_of(document)
    counts = _tolerance_counts(document) if tolerances else _counts(document, scene)
    notes = () if tolerances else document["notes"]
    extra = _tolerance_facts(document) if tolerances else {}
    sections = {
        "claim": claim_section(meaning, counts),
        "statics": _statics({"poses": []} if tolerances else document, robot, limits or {}),
        "reasons": reasons_section(meaning, limits_of(document), notes),
        "explorer": _explorer(scene, poses, tolerances=tolerances) if poses.rows else Markup(),
        "robot": mechanism_section(mechanism, scene.configuration)
        if mechanism is not None
        else robot_section(shown_robot, {**extra, **_actuators(document, scene, robot)}, has_knees=bool(scene.sorts)),
        "proof": proof_section(facts, document),
    }
    return _assembled(scene, meaning, poses, sections)


def _certified(
    document: Mapping[str, Any], robot: Machine | None, near: Sequence[Fraction] | None
) -> tuple[Scene, PoseRows]:
    scene = scene_of(document, robot, near)
    return scene, certified_rows(document, scene)


def _within_tolerance(
    document: Mapping[str, Any], robot: Machine | None, near: Sequence[Fraction] | None
) -> tuple[Scene, PoseRows]:
    if near is not None:
        raise InputError("--near: is for certificates of poses, not of tolerances; leave it out")
    if robot is not None:
        raise InputError("model: cranks and slides are drawn for certificates of poses only; leave it out")
    try:
        scene = tolerance_scene(document)
        return scene, tolerance_rows(document, scene)
    except OverflowError:
        raise InputError("robot: its coordinates are too large to be drawn; use another unit of length") from None


def _counts(document: Mapping[str, Any], scene: Scene) -> dict[str, str]:
    """Only where they count something: not for a robot that moves."""
    if document["claim"] not in ("complete", "not-proven-complete") or not document["distinct_solutions"]:
        return {}
    total, distinct = document["complex_solutions"], document["distinct_solutions"]
    counts = {"real poses": str(document["real_poses"])}
    if document["claim"] == "complete" and total == distinct:
        counts["complex solutions"] = str(total)
    elif document["claim"] == "complete":
        counts |= {"complex solutions, with multiplicity": str(total), "distinct ones": str(distinct)}
    else:
        counts["distinct complex solutions found"] = str(distinct)
    if modes := groups(pose.det_sign for pose in scene.poses):
        counts["assembly modes"] = modes
    return counts


def _statics(document: Mapping[str, Any], robot: Machine | None, limits: Mapping[str, Any]) -> Markup:
    """What the machine can do at the poses; nothing if there are none."""
    from pkm_exact.certify.statics_of_poses import at_certified_poses
    from pkm_exact.report_page.statics_section import statics_section

    if not document["poses"]:
        if limits:
            raise InputError("limits: are for the poses of a certificate of poses, and there are none; leave them out")
        return Markup()
    drives = "Legs are taken as actuators; slides and cranks are known to the page if it is made with the model."
    remark = "" if robot is not None else drives
    try:
        poses = at_certified_poses(document, robot)
    except InputError:  # its lengths were given freely, or are those of another configuration: the legs are the same
        poses = at_certified_poses(document)
    return statics_section(poses, limits, remark)


def _tolerance_counts(document: Mapping[str, Any]) -> dict[str, str]:
    return {
        "poses with a box": str(len(document["boxes"])),
        "without": str(len(document["unproved"])),
        "complete": "yes" if document["complete"] else "not proved",
    }


def _tolerance_facts(document: Mapping[str, Any]) -> dict[str, str]:
    unit = document["robot"]["unit"]
    names = {"base": "tolerance of base joints", "platform": "of platform joints", "lengths": "of leg lengths"}
    return {name: with_unit(exact(Fraction(document["tolerances"][key])), unit) for key, name in names.items()}


def _actuators(document: Mapping[str, Any], scene: Scene, robot: Machine | None) -> dict[str, str]:
    locked = configuration_of(document, robot) if isinstance(robot, Robot) else None
    if robot is None or locked is None or not scene.sorts:
        return {}
    texts = (f"({', '.join(map(str, v))})" if isinstance(v, tuple) else str(v) for v in locked.joint_values)
    stands = f"the certificate has it as {len(scene.legs)} legs that stand on its {scene.sorts[0]}s"
    return {"model": f"{robot.kind}: {KINDS[robot.kind].description}; {stands}", "joint values": ", ".join(texts)}


def _explorer(scene: Scene, poses: PoseRows, *, tolerances: bool) -> Markup:
    """The picture to turn, beside the table to choose from."""
    presets = {"reset": "Reset"} if scene.motion.is_planar else _PRESETS
    buttons = (element("button", title, type="button", data_preset=name) for name, title in presets.items())
    turn = "Drag to move it" if scene.motion.is_planar else "Drag to turn it, with Shift or two fingers to move it"
    arrows = "arrow keys" if scene.motion.is_planar else "arrow keys, + and -, T, F, S for top, front and side"
    precision = (
        "The middle of each box. Exact bounds stand below the table and in the copies."
        if tolerances
        else "All digits are right, the last one to within one unit; more of them with the button. Exact bounds stand "
        "below the table and in the copies."
    )
    precision += "".join(f" {row.number}*: {NEAREST}." for row in poses.rows if row.is_nearest)
    words = {
        "view_keys": f"{turn}, wheel or pinch to zoom; by keyboard: {arrows}, 0 to reset.",
        "presets": joined(*buttons),
        "legend": legend(len(scene.legs), scene.shapes, leg_word(scene)),
        "precision": precision,
        "count": str(len(poses.rows)),
        "table": pose_table(poses),
    }
    return Markup(Template(_asset("explorer.html")).substitute(words))


def _assembled(scene: Scene, meaning: Meaning, poses: PoseRows, sections: Mapping[str, Markup]) -> str:
    style = _asset("style.css")
    script = '"use strict";\n' + "\n".join(map(_asset, SCRIPTS))
    policy = (
        f"default-src 'none'; script-src '{_digest(script)}'; style-src '{_digest(style)}'; img-src data:; "
        "base-uri 'none'; form-action 'none'"
    )
    configuration = locked_at(scene.kind, scene.configuration)
    target, words = ("#poses", "Skip to the poses") if poses.rows else ("#claim", "Skip to the claim")
    parts: dict[str, str] = {
        "policy": policy,
        "title": joined(f"{scene.name}: {meaning.headline}"),
        "style": style,
        "skip": element("a", words, href=target, cls="skip"),
        "name": joined(scene.name),
        "subtitle": joined(f"{scene.kind}, {configuration}, unit of length: {unit_words(scene.unit)}"),
        "footer": joined(
            f"Made by pkm_exact {pkm_exact.__version__} from an accepted certificate. "
            "It holds all its data and connects to nothing."
        ),
        "data": embedded_json(payload(scene, poses)),
        "script": script,
    }
    return Template(_asset("template.html")).substitute(parts, **sections)


def _asset(name: str) -> str:
    return (files("pkm_exact.report_page") / name).read_text(encoding="utf-8")


def _digest(text: str) -> str:
    return f"sha256-{b64encode(sha256(text.encode()).digest()).decode()}"
