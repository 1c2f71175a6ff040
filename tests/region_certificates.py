"""Region certificates that several tests ask for, each made once."""

from __future__ import annotations

from collections.abc import Iterator
from copy import deepcopy
from fractions import Fraction
from functools import cache
from typing import Any

from samples import MODELS, model

from pkm_exact.certify import pure
from pkm_exact.certify.build import canonical_bytes, sealed
from pkm_exact.certify.check import check_bytes
from pkm_exact.certify.region_build import region_certificate
from pkm_exact.geometry.machine import Machine
from pkm_exact.geometry.reader import robot_from_toml
from pkm_exact.regions.question_reader import question_from_toml
from pkm_exact.regions.region_legs import region_machine
from pkm_exact.regions.region_solver import RegionAnswer, answered

_TEXTS = {path.stem: path for path in MODELS}
_PLANAR = """[limits]
lengths = [[4, 8], [4, 8], [1, 6]]
base_cones = { axes = [[1, 1], [0, 1], [0, -1]], angle = 60 }
platform_cones = { axes = [[-1, -1], [0, -1], [0, 1]], angle = [60, 120, 90] }
position = [[0, 6], [0, 11]]
"""
_SLIDES = """[limits]
slides = [-9, 20]
base_cones = { axes = [[0, 1], [1, 1], [0, -1]], angle = 120 }
"""
_CRANKS = """[limits]
angles = [[-270, 90], [0, 270], [-180, 360]]
platform_cones = { axes = [[-1, 0], [1, 0], [0, 1]], angle = 150 }
"""
_APART = "[limits]\nleg_distance = {0}\n"
_SQUARE = "position = [[0, 9], [0, 9]]\ndegrees = 0"
MAP = "kind = 'map'\nsteps = 7"

QUESTIONS = {
    "all of a planar robot": (
        "3-rpr-merlet-p",
        "",
        "position = [[4, 6], [4, 6]]\ndegrees = [-5, 5]",
        "no_type_2 = true",
        "",
    ),
    "two poses": (
        "3-rpr-merlet-p",
        "",
        "position = [['1/7', '43/7'], ['1/7', '57/7']]\ndegrees = [-50, -3]",
        "no_type_2 = true",
        "",
    ),
    "one pose": ("3-rrr", "", "position = [[0, 40], [0, 9]]\ndegrees = 0", "reachable = true", ""),
    "undecided": (
        "3-rpr-merlet-p",
        "",
        "position = [['-1/3', '2/3'], ['-1/3', '2/3']]\ndegrees = 0",
        "no_type_1 = true",
        "steps = 5",
    ),
    "limits of legs": ("3-rpr-merlet-p", _PLANAR, _SQUARE, "limits = true", MAP),
    "limits of slides": ("3-prr", _SLIDES, _SQUARE, "limits = true\nworking_modes = ['+', '-', '-']", MAP),
    "limits of cranks": ("3-rrr", _CRANKS, _SQUARE, "limits = true\nworking_modes = ['+', '-', '-']", MAP),
    "a crank at its angle": (
        "3-rrr",
        _CRANKS.replace("[-180, 360]", "[90, 90]"),
        _SQUARE,
        "limits = true\nworking_modes = ['+', '-', '-']",
        "kind = 'map'\nsteps = 3",
    ),
    "singularities of cranks": (
        "3-rrr",
        "",
        "position = [[0, 12], [-2, 10]]\ndegrees = 0",
        "no_type_1 = true\nno_type_2 = true\nworking_modes = ['+', '+', '-']",
        MAP,
    ),
    "a ball": (
        "rolland-6-6",
        "",
        "ball = { center = [0, 0, 770], radius = 60 }\nrpy_degrees = [0, [-9, 9], 0]",
        "no_type_1 = true\nno_type_2 = true",
        "",
    ),
    "a prism of a Delta": (
        "delta",
        "",
        "prism = { sides = 6, radius = '1/2', height = [-3, -2] }",
        "reachable = true",
        "",
    ),
    "turns with joints": (
        "2-ups-u",
        "",
        "position = [0, 0, 0]\nrpy_degrees = [[-9, 9], [-9, 9], 0]",
        "no_type_2 = true",
        "",
    ),
    "a map of angles": (
        "3-rpr-merlet-p",
        "",
        "position = [[4, 9], 5]\ndegrees = [-70, 60]",
        "no_type_1 = true\nno_type_2 = true",
        "kind = 'map'\nsteps = 8",
    ),
}
"""Model, its limits, region, conditions and answer."""

SECOND = {
    "legs apart": (
        "rolland-6-6",
        _APART.format(20),
        "position = [[-50, 50], [-50, 50], [700, 800]]\nrpy_degrees = [0, 0, 0]",
        "limits = true\nno_type_2 = true",
        "",
    ),
    "legs near each other": (
        "mssm",
        _APART.format(700),
        "position = [[-900, 900], 0, 600]\nrpy_degrees = [0, 0, [0, 60]]",
        "limits = true",
        "kind = 'map'\nsteps = 4",
    ),
    "legs too near": (
        "mssm",
        _APART.format(700),
        "position = [[-900, 900], 0, 600]\nrpy_degrees = [0, 0, 0]",
        "limits = true",
        "",
    ),
    "arms and rods on slides apart": (
        "p-fus-4",
        _APART.format(50),
        "position = [0, 0, [0, 16]]\nquaternion = [1, 0, 0, 0]",
        "limits = true\nworking_modes = ['-', '-', '-', '+']",
        "kind = 'map'\nsteps = 5",
    ),
    "bars apart": (
        "h4",
        _APART.format(12),
        "position = [[-9, 9], 0, 40]\ndegrees = 0",
        "limits = true\nworking_modes = ['-', '-', '-', '-']",
        "kind = 'map'\nsteps = 6",
    ),
    "a tube": (
        "3-rpr-merlet-p",
        "",
        "tube = { path = [[6, 3], [6, 6], [3, 6]], radius = 1 }\ndegrees = [-1, 1]",
        "no_type_2 = true",
        "",
    ),
    "a tube that is too wide": (
        "3-rpr-merlet-p",
        "",
        "tube = { path = [[6, 3], [6, 6], [3, 6]], radius = '5/2' }\ndegrees = 0",
        "no_type_2 = true",
        "",
    ),
    "a map of a tube": (
        "mssm",
        "[limits]\nlengths = [900, 1500]\n",
        "tube = { path = [[0, 0, 700], [300, 0, 900]], radius = 100 }\nrpy_degrees = [0, 0, 0]",
        "limits = true",
        "kind = 'map'\nsteps = 5",
    ),
    "a straight way": (
        "3-rpr-merlet-p",
        "",
        "line = { from = [6, 3], to = [6, 6] }\ndegrees = [0, 5]",
        "no_type_1 = true\nno_type_2 = true",
        "",
    ),
    "a straight way through a singularity": (
        "3-rpr-merlet-p",
        "",
        "line = { from = [1, 5], to = [5, 3] }\ndegrees = 0",
        "no_type_2 = true",
        "",
    ),
    "an arc": (
        "3-prrr",
        "",
        "arc = { center = [0.425, 0.425, 0.3], radius = 0.175, degrees = [-90, 90] }",
        "no_type_1 = true\nno_type_2 = true\nworking_modes = ['+', '+', '+']",
        "",
    ),
    "joint values": (
        "3-rpr-merlet-p",
        "",
        "position = [[1, 4], 5]\ndegrees = 0\njoints = [['11/2', 9], [0, 99], [0, 99]]",
        "no_type_2 = true",
        "",
    ),
    "joint values that do not suffice": (
        "3-rpr-merlet-p",
        "[limits]\nlengths = [2, 8]\n",
        "position = [[0, 8], [0, 8]]\ndegrees = 0\njoints = [[5, 8], [3, 6], [0, 5]]",
        "limits = true",
        "",
    ),
    "a map of angles of cranks": (
        "3-rrr",
        "",
        "position = [[-9, 9], [-9, 9]]\ndegrees = 0\njoints = [[-90, 90], [0, 270], [-180, 180]]",
        "reachable = true\nworking_modes = ['+', '-', '-']",
        "kind = 'map'\nsteps = 7",
    ),
}
"""The same for certificates of version 2."""


def machine_of(name: str, limits: str = "") -> Machine:
    """A shipped robot, with limits."""
    if not limits:
        return model(name)
    return robot_from_toml(_TEXTS[name].read_text().replace("[[configurations]]", f"{limits}[[configurations]]", 1))


@cache
def answer_of(name: str) -> RegionAnswer:
    """The answer to a question."""
    robot, limits, region, conditions, answer = (QUESTIONS | SECOND)[name]
    answer = answer if "kind" in answer else f"kind = 'all'\n{answer}"
    machine = region_machine(machine_of(robot, limits))
    text = f"[region]\n{region}\n[conditions]\n{conditions}\n[answer]\n{answer}\n"
    return answered(machine, question_from_toml(text, machine))


@cache
def _content(name: str) -> dict[str, Any]:
    return region_certificate(answer_of(name))


def content_of(name: str) -> dict[str, Any]:
    """The certificate without its digest, free to be changed."""
    content = deepcopy(_content(name))
    del content["digest"]
    return content


def verdicts(content: dict[str, Any]) -> tuple[tuple[str, tuple[str, ...]], tuple[str, tuple[str, ...]]]:
    """Status and lines of both checkers for a content, which gets its digest."""
    data = canonical_bytes(sealed(content))
    first, second = check_bytes(data), pure.check_bytes(data)
    return (str(first.status), first.lines), (second.status, second.lines)


def changed_numbers(value: Any, path: tuple[Any, ...] = ()) -> Iterator[tuple[Any, ...]]:
    """The places of all rationals and integers in a content."""
    if isinstance(value, dict | list):
        for key, entry in value.items() if isinstance(value, dict) else enumerate(value):
            yield from changed_numbers(entry, (*path, key))
    elif isinstance(value, int) and not isinstance(value, bool):
        yield path
    elif isinstance(value, str):
        try:
            Fraction(value)
        except (ValueError, ZeroDivisionError):
            return
        yield path
