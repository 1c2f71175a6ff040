"""What a certificate claims and what it does not, in plain words."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from typing import Any

from pkm_exact.claim import Claim, CompletenessRoute
from pkm_exact.claim_wording import (
    OF_CERTIFICATE,
    OF_CERTIFICATE_MEANING,
    OF_EVIDENCE,
    OF_EVIDENCE_MEANING,
    Subject,
    subject,
)
from pkm_exact.constraints.distance import Distance
from pkm_exact.geometry.kinds import KINDS
from pkm_exact.motions.motion import Motion
from pkm_exact.motions.motion_groups import MOTIONS
from pkm_exact.wording import counted


@dataclass(frozen=True)
class Meaning:
    """Of a claim: a word, whether it settles the question, a headline, what it says, and by which proof."""

    word: str
    settled: bool
    headline: str
    meaning: str
    proof: str


def is_of_tolerances(document: Mapping[str, Any]) -> bool:
    """Whether it is a certificate of tolerances, not one of poses."""
    return "tolerances" in document


def meaning_of(document: Mapping[str, Any]) -> Meaning:
    """What is claimed in a certificate."""
    if is_of_tolerances(document):
        return _within_tolerance(document)
    number, of = int(document["real_poses"]), _subject(document)
    claim = Claim(document["claim"])
    if claim is Claim.COMPLETE:
        return _complete(document, number, of)
    if claim is Claim.NOT_PROVEN_COMPLETE:
        return _open(document, number)
    if claim is Claim.INCONSISTENT:
        return Meaning(
            "inconsistent, proved",
            True,
            of.says("No pose: the {equation}s contradict each other."),
            of.says("No pose of the platform {meets}, not even a complex one."),
            _route_to_none(document, of),
        )
    return _infinite(number, of, proved=claim is Claim.POSITIVE_DIMENSIONAL_PROVED)


def _subject(document: Mapping[str, Any]) -> Subject:
    constraints = document["robot"].get("constraints", ())
    return subject(of_legs=all(entry["type"] == Distance.type for entry in constraints))


def _complete(document: Mapping[str, Any], number: int, of: Subject) -> Meaning:
    if number:
        headline = f"{counted(number, 'real pose')}, and it is proved that there is no other."
        meaning = (
            f"{of.given.capitalize()} the {of.robot} has exactly the poses listed. Each stands in a box of its own "
            "that holds exactly one pose. This is proved for the very numbers on this page, without rounding; no pose "
            "is missing."
        )
    else:
        headline = of.says("No real pose: it is proved that the {robot} cannot be assembled {given}.")
        meaning = "All solutions of its equations are known, and none of them is real."
    return Meaning("complete, proved", True, headline, meaning, _route(document, of))


def _motion(document: Mapping[str, Any]) -> Motion:
    robot = document["robot"]
    return MOTIONS[robot["motion"]] if "motion" in robot else KINDS[robot["kind"]].motion


def _route_to_none(document: Mapping[str, Any], of: Subject) -> str:
    """By which proof there is no pose."""
    if document["completeness_route"] == CompletenessRoute.COUNTING_AT_INFINITY:
        return (
            f"The {of.equation}s and the rigid motions, a variety of degree 40, meet in finitely many points, which "
            "count 40 at most. Points at infinity, found exactly, fill this number."
        )
    if document["completeness_route"] == CompletenessRoute.MODULAR_RANK:
        return of.says(
            "Ranks of integer matrices modulo a prime show that the equations of the {equation}s imply 0 = 1."
        )
    return of.says("An elimination over the rational numbers shows that the equations of the {equation}s imply 0 = 1.")


def _route(document: Mapping[str, Any], of: Subject) -> str:
    total, distinct = document["complex_solutions"], document["distinct_solutions"]
    if document["completeness_route"] == CompletenessRoute.REFINED_BEZOUT:
        return (
            f"The motions of the platform ({_motion(document).title}) form a variety, and the {of.equation}s cut it in "
            f"at most {total} isolated solutions, real or complex. {total} were found, distinct and simple: nothing is "
            f"left for another pose, for a motion with locked {of.locked}, or for solutions at infinity (refined "
            "theorem of Bezout)."
        )
    others = {
        CompletenessRoute.PRODUCT_BOUND: (
            f"The equations have low degrees in few unknowns, so that at most {total} isolated solutions are possible, "
            f"real or complex (theorem of Bezout). {total} were found, distinct and simple."
        ),
        CompletenessRoute.MODULAR_RANK: (
            f"Ranks of integer matrices modulo a prime leave room for {counted(total, 'solution')}, real or complex, "
            "counted with multiplicity. As many were found."
        ),
        CompletenessRoute.COUNTING_AT_INFINITY: (
            "The constraints and the rigid motions, a variety of degree 40, meet in finitely many points, which count "
            f"40 at most. {counted(total, 'solution')} and points at infinity, found exactly, fill this number: there "
            "is no other."
        ),
    }
    if document["completeness_route"] in others:
        return others[document["completeness_route"]]
    several = f" ({distinct} distinct ones, some of them multiple)" if distinct < total else ""
    return (
        "An elimination over the rational numbers gives polynomials that vanish at every pose and leave room for "
        f"{counted(total, 'solution')}, real or complex, counted with multiplicity. As many were found{several}: there "
        "is no other."
    )


def _open(document: Mapping[str, Any], number: int) -> Meaning:
    word = "not proved complete"
    found = document["distinct_solutions"]
    if not found:
        return Meaning(
            word,
            False,
            "Nothing is proved.",
            "The certificate lists no solution and excludes none.",
            "There is no proof.",
        )
    if number:
        headline = f"{counted(number, 'real pose')}, each one proved; others are not excluded."
        meaning = (
            "Each pose listed stands in a box that holds exactly one pose of the list. There may be further poses."
        )
    else:
        headline = "No real pose is known; others are not excluded."
        meaning = "The solutions that were found are not real. There may be others."
    return Meaning(
        word,
        False,
        headline,
        meaning,
        f"{counted(found, 'distinct complex solution')} were checked exactly. That there is no other was not proved.",
    )


def _infinite(number: int, of: Subject, *, proved: bool) -> Meaning:
    isolated = "1 isolated pose is" if number == 1 else f"{number} isolated poses are"
    beside = f" Beside them {isolated} certified, those listed; others are not excluded." if number else ""
    if proved:
        return Meaning(
            "infinitely many, proved",
            True,
            OF_CERTIFICATE,
            f"{of.says(OF_CERTIFICATE_MEANING)}{beside}",
            "The certificate contains solutions, and they lie on curves or surfaces of solutions for the reason in the "
            "last line of what was checked, below.",
        )
    return Meaning(
        "infinitely many, not proved",
        False,
        of.says(OF_EVIDENCE),
        f"{OF_EVIDENCE_MEANING}{beside}",
        "There is no proof.",
    )


def _within_tolerance(document: Mapping[str, Any]) -> Meaning:
    boxes, others = len(document["boxes"]), document["unproved"]
    if document["complete"]:
        return Meaning(
            "complete within tolerance, proved",
            True,
            f"Every robot within tolerance has exactly {counted(boxes, 'real pose')}, one in each box.",
            "However joints and lengths differ from the nominal ones, within the tolerances below: there is exactly "
            "one pose in each box, and none elsewhere.",
            "For all solutions, complex ones included, a box was mapped into its interior by Krawczyk's operator for "
            "all robots within tolerance at once. They are as many as the degree of the variety of motions: there is "
            "no other.",
        )
    some = ("Pose " if len(others) == 1 else "Poses ") + ", ".join(map(str, others))
    without = f" {some}: no box was proved, a singularity within tolerance is not excluded." if others else ""
    return Meaning(
        "completeness not proved",
        False,
        f"{'1 box' if boxes == 1 else f'{boxes} boxes'} proved for every robot within tolerance; other poses are not "
        "excluded.",
        "Every robot within tolerance has exactly one pose in each box listed. That it has no pose elsewhere is not "
        f"proved.{without}",
        "Each box was mapped into its interior by Krawczyk's operator for all robots within tolerance at once.",
    )


def limits_of(document: Mapping[str, Any]) -> tuple[str, ...]:
    """What is not claimed."""
    tolerances = is_of_tolerances(document)
    limits = [
        "Limits of legs and joints and collisions are not considered, nor which pose the machine is in.",
        "Name, source and notes are descriptions.",
    ]
    if document["boxes" if tolerances else "poses"]:
        limits[-1] += " The picture is drawn in floating point."
    if tolerances:
        return ("Nothing is said about robots outside the tolerances.", *limits)
    if document["poses"]:
        limits.insert(
            1,
            "Sign and condition number of the leg Jacobian J were computed for this page, in guaranteed enclosures; "
            "they are not a part of the certificate.",
        )
    model = (
        "A real machine differs from its model. What is proved holds for the numbers on this page; a certificate of "
        "tolerances says how far the poses of a real one can be off."
    )
    return (model, *limits)
