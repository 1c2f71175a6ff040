"""What the machine can do at each pose, as a section of the page: matrices, singularities, indices, polytopes."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import TYPE_CHECKING, Any

from pkm_exact.errors import PkmExactError
from pkm_exact.report_page.markup import Markup, element, joined
from pkm_exact.report_page.numerals import unit_words
from pkm_exact.report_page.polytope_svg import polytope_svg

if TYPE_CHECKING:
    from pkm_exact.statics.asked_answers import StaticsAnswers
    from pkm_exact.statics.at_pose import AtPose
    from pkm_exact.statics.enclosed_matrix import EnclosedMatrix


def statics_section(poses: Sequence[AtPose], limits: Mapping[str, Any], remark: str = "") -> Markup:
    """The section on all poses.

    Parameters
    ----------
    poses : sequence of AtPose
    limits : mapping
        As for ``statics.limits_of_actuators``.
    remark : str
        What is said of the actuators.

    Raises
    ------
    InputError
        If a limit cannot be used.
    """
    found = [_answers(at, limits) for at in poses]
    common = _common([answers.refused for answers in found])
    body = (
        _pose(number, at, answers, common) for number, (at, answers) in enumerate(zip(poses, found, strict=True), 1)
    )
    parts = [element("p", _introduction(poses[0], limits, remark)), *body]
    if common:
        reasons = element("ul", *(element("li", f"{name}: {why}") for name, why in common.items()), cls="plain small")
        parts.append(element("details", element("summary", "What is not shown, and why"), reasons))
    title = element("h2", "Velocities and forces at the poses", id="statics-title")
    return element("section", title, *parts, cls="sheet", id="statics", aria_labelledby="statics-title")


def _answers(at: AtPose, limits: Mapping[str, Any]) -> StaticsAnswers:
    """What can be said of a pose; limits that cannot be used are refused, other refusals are for the page."""
    from pkm_exact.statics.asked_answers import StaticsAnswers, asked_answers
    from pkm_exact.statics.limits_of_actuators import KEYS, ActuatorLimits

    meant = limits if at.jacobian is not None else {key: value for key, value in limits.items() if key not in KEYS}
    ActuatorLimits.of(meant, len(at.actuated))
    try:
        return asked_answers(at, limits)
    except PkmExactError as error:
        return StaticsAnswers(None, {}, {"indices": str(error)}, {})


def _introduction(at: AtPose, limits: Mapping[str, Any], remark: str) -> str:
    unit = "unit of length" if at.unit == "1" else unit_words(at.unit)
    said = (
        f"A twist has the velocity of the platform's origin ({unit} per unit of time) and its angular "
        "velocity, in coordinates of the base; moments are about the origin. Computed from the boxes of the poses when "
        "the page was made, and no part of the certificate: all digits are right, the last one to within one unit."
    )
    if limits:
        given = ", ".join(f"{key} = {', '.join(map(str, _list(value)))}" for key, value in limits.items())
        said += f" Given for it: {given}."
    return f"{said} {remark}".rstrip()


def _list(value: Any) -> Sequence[Any]:
    return value if isinstance(value, list | tuple) else [value]


def _common(refused: Sequence[Mapping[str, str]]) -> dict[str, str]:
    """The refusals that are those of all poses."""
    first = refused[0]
    return {name: why for name, why in first.items() if all(other.get(name) == why for other in refused)}


def _pose(number: int, at: AtPose, answers: StaticsAnswers, common: Mapping[str, str]) -> Markup:
    """All of one pose, folded away but for the first."""
    parts = [element("p", str(found), cls="small") for found in at.singularities]
    parts.append(_matrix("Wrenches of the constraints, at unit force", at.wrenches))
    if at.jacobian is not None:
        parts.append(_matrix("J: speeds of the actuators by the twist of the platform", at.jacobian))
    else:
        parts.append(element("p", _no_jacobian(at), cls="small"))
        parts += _forward(at)
    if answers.indices:
        parts.append(_indices(answers))
    parts += _polytopes(answers)
    own = {name: why for name, why in answers.refused.items() if name not in common}
    if own:
        parts.append(
            element("ul", *(element("li", f"no {name}: {why}") for name, why in own.items()), cls="plain small")
        )
    return element(
        "details",
        element("summary", f"Pose {number}: {_singularities(at)}"),
        element("div", *parts, cls="stack"),
        open=number == 1,
        cls="statics",
    )


def _singularities(at: AtPose) -> str:
    rank = "a rank that is not decided" if at.rank is None else f"rank {at.rank}"
    words = [f"{len(at.equations)} constraints of {rank}, {at.motion.dimension} freedoms"]
    words += [f"singular, {found.name} ({', '.join(found.constraints)})" for found in at.singularities]
    if not at.singularities and not at.kinds.undecided:
        words.append("not singular")
    return "; ".join([*words, *(f"not decided: {name}" for name in at.kinds.undecided)])


def _forward(at: AtPose) -> list[Markup]:
    """T where there is no J, if the twist follows from the actuators."""
    try:
        found = at.forward
    except PkmExactError:
        return []
    return [] if found is None else [_matrix("T: twist of the platform by the speeds of the actuators", found)]


def _no_jacobian(at: AtPose) -> str:
    if at.held.is_redundant:
        return (
            "There is no J: with more actuators than constraints for them, their speeds do not follow from the twist."
        )
    if at.actuated:
        return "There is no J here: an actuator does not move the platform, or that is not decided."
    return "There is no J: no constraint is known to be actuated. With its model the page knows which are."


def _matrix(caption: str, matrix: EnclosedMatrix) -> Markup:
    from pkm_exact.statics.enclosed_matrix import shown_number

    heads = element("tr", element("td"), *(element("th", name, scope="col") for name in matrix.columns))
    rows = (
        element("tr", element("th", name, scope="row"), *(element("td", shown_number(entry)) for entry in entries))
        for name, entries in zip(matrix.rows, matrix.entries, strict=True)
    )
    parts = element("caption", caption), element("thead", heads), element("tbody", *rows)
    return _scrolled(element("table", *parts), caption)


def _indices(answers: StaticsAnswers) -> Markup:
    from pkm_exact.statics.enclosed_matrix import shown_number
    from pkm_exact.statics.index_rows import STATICS_INDICES, unit_of

    measures = answers.measures
    rows = []
    for index in STATICS_INDICES:
        if index.name in answers.indices and measures is not None:
            unit = unit_of(index, measures)
            rows.append(
                element(
                    "tr",
                    element("th", index.name, scope="row"),
                    element("td", shown_number(answers.indices[index.name])),
                    element("td", "" if unit == "1" else unit),
                    element("td", index.definition, cls="words"),
                )
            )
    titles = (("index", None), ("value", None), ("unit", None), ("definition", "words"))
    heads = element("tr", *(element("th", title, scope="col", cls=style) for title, style in titles))
    return _scrolled(element("table", element("thead", heads), element("tbody", *rows)), "Indices")


def _scrolled(table: Markup, label: str) -> Markup:
    return element("div", table, cls="scroll fitting", tabindex="0", role="region", aria_label=label)


def _polytopes(answers: StaticsAnswers) -> list[Markup]:
    from pkm_exact.statics.enclosed_matrix import shown_number

    facts = []
    for name, polytope in answers.polytopes.items():
        components = answers.components(name)
        size = f"{len(polytope.vertices)} vertices, {len(polytope.facets)} facets"
        size += f", volume {shown_number(polytope.volume)}"
        if len({component[0] for component in components}) == 1:  # norms of different units mean nothing
            size += f", greatest norm {shown_number(polytope.greatest_norm)}"
            size += f", radius of the largest ball about 0 {shown_number(polytope.inscribed_radius)}"
        facts.append(element("li", f"{name.replace('_', ' ')} in {', '.join(components)}: {size}"))
    if answers.ellipsoid is not None:
        axes = ", ".join(map(shown_number, answers.ellipsoid.half_axes))
        facts.append(element("li", f"largest ellipsoid in the velocity polytope: half axes {axes}"))
    found = [element("ul", *facts, cls="plain small")] if facts else []
    drawn = _pictures(answers)
    return found + ([element("div", *drawn, cls="polytopes")] if drawn else [])


def _pictures(answers: StaticsAnswers) -> list[Markup]:
    from pkm_exact.pictures.statics_picture import statics_panels

    if answers.measures is None or not answers.polytopes:
        return []
    try:
        panels = statics_panels(answers.measures, answers.ellipsoid)
    except PkmExactError as error:
        return [element("p", str(error), cls="small")]
    return [
        element("figure", polytope_svg(panel), element("figcaption", _caption(panel)))
        for panel in panels
        if panel.polytope.dimension in (2, 3)
    ]


def _caption(panel: Any) -> Markup:
    return joined(panel.title, "" if panel.ellipsoid is None else ", with the largest ellipsoid in them")
