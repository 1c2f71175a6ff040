"""Model files: robots as TOML, read exactly. Every defect gives one sentence that names file, field, value and remedy.

Numbers are TOML integers, TOML decimals (kept as written, never as binary floats) or strings ``"p"``, ``"p/q"`` and
``"1.25"``. Nothing in a file is evaluated, and sizes are bounded before anything is parsed.
"""

from __future__ import annotations

import os
import re
import tomllib
from collections.abc import Sequence
from dataclasses import replace
from pathlib import Path
from typing import TYPE_CHECKING, Any, Final

from pkm_exact.constraints.distance import Distance
from pkm_exact.errors import InputError
from pkm_exact.geometry.chain_reader import CHAIN_TABLES, exact_cranks, read_chains, read_joints
from pkm_exact.geometry.configurations import read_configuration
from pkm_exact.geometry.fields import known_keys, label, required, truth
from pkm_exact.geometry.inverse import UNIT_METRIC, Metric
from pkm_exact.geometry.joints import parse_metric
from pkm_exact.geometry.kind_names import CHAINS_KIND, CONSTRAINTS_KIND, LINKS_KIND
from pkm_exact.geometry.kinds import KINDS
from pkm_exact.geometry.limits_reader import LimitedParts, read_limits
from pkm_exact.geometry.model_kinds import is_linkage, is_links
from pkm_exact.geometry.nominal_pose import read_nominal
from pkm_exact.geometry.polar_vectors import PolarVector, with_polar_vectors
from pkm_exact.geometry.rational import MAX_DIGITS, NumberText, parse_rational
from pkm_exact.geometry.robot import Robot, jointed
from pkm_exact.geometry.tolerances import read_tolerances
from pkm_exact.geometry.written_digits import finest_digit
from pkm_exact.motions.motion_groups import PLANAR
from pkm_exact.wording import printable, shown

if TYPE_CHECKING:
    from fractions import Fraction

    from pkm_exact.geometry.linkage import Linkage
    from pkm_exact.geometry.links import Links
    from pkm_exact.geometry.machines.machine_kind import MachineKind
    from pkm_exact.geometry.mechanism import Mechanism

__all__ = ["parse_rational", "read_robot", "robot_from_toml"]

SCHEMA: Final = 1
MAX_BYTES: Final = 1 << 16
"""Largest model file: a few hundred numbers of the largest size."""

_MAX_RUN: Final = 640  # digits in a row; below every limit that Python can be set to
_MAX_DOTS: Final = 200  # dots in a line; the parser's time grows steeply with the parts of a dotted key
_MAX_TEXT: Final = 2000
_TABLE: Final = re.compile(r"[^=\[\]{}#\"']*[,;\t][^=\[\]{}#\"']*")
_LONGEST_FIRST: Final = 1000
_YAML: Final = re.compile(r"[A-Za-z_][\w-]*:(\s|$)", re.ASCII)
_DECLARED: Final = (CONSTRAINTS_KIND, LINKS_KIND, CHAINS_KIND)
_TOP: Final = (
    "schema",
    "name",
    "kind",
    "unit",
    "source",
    "metric",
    "base",
    "platform",
    *CHAIN_TABLES,
    "tolerances",
    "limits",
    "configurations",
)


def read_robot(path: str | os.PathLike[str]) -> Robot | Mechanism:
    """The robot that a model file describes.

    Raises
    ------
    InputError
        If the file cannot be read or does not describe a robot; the message is one sentence that starts with the path.
    """
    name = os.fspath(path)
    try:
        return robot_from_toml(_text(_bytes(name)))
    except InputError as error:
        raise InputError(f"{printable(name)}: {error}") from None


def read_jointed_robot(path: str | os.PathLike[str], question: str) -> Robot:
    """The robot that a model file describes, for a question that needs its joints, cranks or slides.

    Raises
    ------
    InputError
        As ``read_robot``, and if it is a mechanism declared by constraints.
    """
    robot = read_robot(path)
    try:
        return jointed(robot, question)
    except InputError as error:
        raise InputError(f"{printable(os.fspath(path))}: {error}") from None


def read_any(path: str | os.PathLike[str]) -> Robot | Mechanism | Linkage | Links:
    """What a model file describes, of whatever kind: a robot, or a mechanism of bodies.

    Raises
    ------
    InputError
        As ``read_robot``.
    """
    name = os.fspath(path)
    try:
        return any_from_toml(_text(_bytes(name)))
    except InputError as error:
        raise InputError(f"{printable(name)}: {error}") from None


def read_linkage(path: str | os.PathLike[str]) -> Linkage:
    """The mechanism of bodies and joints that a model file of kind "chains" describes.

    Raises
    ------
    InputError
        As ``read_robot``, and if the file is of another kind.

    Examples
    --------
    >>> len(read_linkage("models/chains/sarrus.toml").joints)
    6
    """
    found = read_any(path)
    if not is_linkage(found):
        raise InputError(
            f"{printable(os.fspath(path))}: kind: {found.kind} is not a mechanism of bodies and joints; give a file of "
            f"kind {CHAINS_KIND}"
        )
    return found


def read_links(path: str | os.PathLike[str]) -> Links:
    """The mechanism with passive bodies that a model file of kind "links" describes.

    Raises
    ------
    InputError
        As ``read_robot``, and if the file is of another kind.

    Examples
    --------
    >>> read_links("models/links/four-bar.toml")
    Links('Four-bar linkage', 2 bodies)
    """
    found = read_any(path)
    if not is_links(found):
        raise InputError(
            f"{printable(os.fspath(path))}: kind: {found.kind} has no passive bodies; give a file of kind {LINKS_KIND}"
        )
    return found


def robot_from_toml(text: str) -> Robot | Mechanism:
    """The robot that the text of a model file describes."""
    return _with_one_body(any_from_toml(text))


def _with_one_body(found: Robot | Mechanism | Linkage | Links) -> Robot | Mechanism:
    if is_links(found):
        raise InputError(
            f"kind: {LINKS_KIND} is a mechanism with passive bodies, and only certify-poses solve takes those; give a "
            "robot with one moving body"
        )
    if is_linkage(found):
        raise InputError(
            f"kind: {CHAINS_KIND} is a mechanism of bodies and joints in one configuration, which has no forward "
            "kinematics here; ask certify-poses mobility about its freedoms"
        )
    return found


def any_from_toml(text: str) -> Robot | Mechanism | Linkage | Links:
    """What the text of a model file describes."""
    return _from_table(_parse(text))


def robot_with(text: str, key: str, value: Fraction) -> Robot | Mechanism:
    """The robot of a model file in which one number is another.

    Parameters
    ----------
    text : str
        The model file.
    key : str
        Where the number stands, such as "dimensions.height" or "base.joints.2.1", entries of lists counted from 1.
    value : Fraction

    Raises
    ------
    InputError
        If no number stands there, or the file describes no robot with it.
    """
    table = _parse(text)
    place: Any = table
    *path, last = key.split(".")
    for name in path:
        place = _entry(place, name, key)
    old = _entry(place, last, key)
    is_text = isinstance(old, str) and not any(digit in old for digit in "0123456789")
    if isinstance(old, dict | list | bool) or is_text or key in ("schema", "name", "source", "unit", "kind"):
        raise InputError(
            f"answer.parameter: {shown(key)} is no number of the model; name one, such as dimensions.height"
        )
    place[int(last) - 1 if isinstance(place, list) else last] = str(value)
    return _with_one_body(_from_table(table))


def _entry(place: Any, name: str, key: str) -> Any:
    """An entry of a table or list."""
    if isinstance(place, dict) and name in place:
        return place[name]
    if isinstance(place, list) and name.isascii() and name.isdigit() and 1 <= int(name) <= len(place):
        return place[int(name) - 1]
    raise InputError(
        f"answer.parameter: {shown(key)} is not in the model; name a number of it, such as dimensions.height"
    )


def _from_table(table: dict[str, Any]) -> Robot | Mechanism | Linkage | Links:
    nominal = table.pop("nominal", None)
    cables = truth(table, "cables", "")
    table.pop("cables", None)
    kind = table.get("kind")
    table, polar = with_polar_vectors(table, _metric(table), exact=kind in (CHAINS_KIND, LINKS_KIND))
    found = _noted(_described(table), polar)
    if cables:
        found = _on_cables(found)
    if nominal is None:
        return found
    if is_linkage(found) or is_links(found):
        raise InputError(f"nominal: a file of kind {found.kind} has no pose to choose; take the table out")
    return replace(found, nominal=read_nominal(nominal, found.motion, found.metric))


def _on_cables(found: Robot | Mechanism | Linkage | Links) -> Robot | Mechanism:
    """The same with cables for legs."""
    if isinstance(found, Robot):
        if not found.chains:
            return replace(found, cables=True)
    elif not (is_linkage(found) or is_links(found)) and any(isinstance(one, Distance) for one in found.constraints):
        return replace(found, cables=True)
    raise InputError(f"cables: a file of kind {found.kind} has no legs that could be cables; take the line out")


def _metric(table: dict[str, Any]) -> Metric:
    """That of the coordinates in a file; whatever is wrong with it is said by those who read it."""
    kind = table.get("kind")
    machine = _machine(kind) if isinstance(kind, str) and kind not in KINDS else None
    try:
        return parse_metric(table["metric"], PLANAR)
    except (KeyError, InputError):
        return UNIT_METRIC if machine is None else machine.metric


def _noted(
    found: Robot | Mechanism | Linkage | Links, polar: Sequence[PolarVector]
) -> Robot | Mechanism | Linkage | Links:
    """The same with what stands in for angles of its geometry."""
    stand_ins = tuple(stand_in for vector in polar for stand_in in vector.stand_ins.values())
    if not stand_ins or (is_linkage(found) or is_links(found)):
        return found
    if isinstance(found, Robot):
        return replace(found, stand_ins=(*found.stand_ins, *stand_ins))
    return replace(found, stand_ins=(*found.stand_ins, *stand_ins))


def _described(table: dict[str, Any]) -> Robot | Mechanism | Linkage | Links:
    """The same but for the nominal pose, which robots of all kinds may have."""
    schema = required(table, "schema", "")
    if isinstance(schema, bool) or schema != SCHEMA:
        raise InputError(f"schema: {shown(schema)} is unknown; write schema = {SCHEMA}")
    kind_name = label(table, "kind", "")
    machine = None if kind_name in KINDS and "actuators" not in table else _machine(kind_name)
    if machine is None and kind_name not in (*KINDS, *_DECLARED):
        from pkm_exact.geometry.machines.machine_kinds import MACHINES

        known = (*KINDS, *MACHINES, *_DECLARED)
        raise InputError(f"kind: {shown(kind_name)} is unknown; use one of: {', '.join(known)}")
    head = {
        "name": label(table, "name", ""),
        "unit": label(table, "unit", ""),
        "source": label(table, "source", "", limit=_MAX_TEXT),
    }
    if kind_name in _DECLARED:
        return _declared(table, head, kind_name)
    if machine is not None:
        from pkm_exact.geometry.machines.machine_reader import read_machine

        return read_machine(table, head, machine)
    return _robot(table, head, kind_name)


def _machine(name: str) -> MachineKind | None:
    """The machine of a name; the machines are loaded for it."""
    if name in _DECLARED:
        return None
    from pkm_exact.geometry.machines.machine_kinds import machine_kind

    return machine_kind(name)


def _declared(table: dict[str, Any], head: dict[str, str], kind_name: str) -> Mechanism | Linkage | Links:
    """A mechanism that the file declares part by part."""
    if kind_name == CHAINS_KIND:
        from pkm_exact.geometry.linkage_reader import read_linkage_tables

        return read_linkage_tables(table, head)
    if kind_name == LINKS_KIND:
        from pkm_exact.geometry.links_reader import read_links_tables

        return read_links_tables(table, head)
    from pkm_exact.geometry.mechanism_reader import read_mechanism

    return read_mechanism(table, head)


def _robot(table: dict[str, Any], head: dict[str, str], kind_name: str) -> Robot:
    """A robot with legs between joints."""
    known_keys(table, _TOP, "")
    kind = KINDS[kind_name]
    metric = parse_metric(table["metric"], kind.motion) if "metric" in table else UNIT_METRIC
    chains, stand_in = exact_cranks(table, read_chains(table, kind_name, kind, metric), metric)
    geometry: dict[str, Any] = head | {"kind": kind_name}
    geometry |= {
        "metric": metric,
        "base_joints": read_joints(table, "base", kind, metric),
        "platform_joints": read_joints(table, "platform", kind, metric),
        "chains": chains,
        "stand_ins": (stand_in,) if stand_in else (),
        "tolerances": read_tolerances(table["tolerances"]) if "tolerances" in table else None,
        "limits": read_limits(table["limits"], LimitedParts.of_kind(kind)) if "limits" in table else None,
        "written_digit": finest_digit(*(table.get(part) for part in ("base", "platform", "cranks", "slides", "rods"))),
    }
    rows = table.get("configurations", [])
    if not isinstance(rows, list) or not all(isinstance(row, dict) for row in rows):
        raise InputError(f"configurations: {shown(rows)} is not a list of tables; write [[configurations]] above each")
    robot = Robot(**geometry)
    configurations = tuple(
        replace(read_configuration(row, f"configurations[{i}]", robot), written_digit=finest_digit(row))
        for i, row in enumerate(rows, 1)
    )
    return replace(robot, configurations=configurations)


def _bytes(name: str) -> bytes:
    try:
        with Path(name).open("rb") as stream:
            data = stream.read(16 * MAX_BYTES)
    except FileNotFoundError:
        raise InputError("no such file; give the path of a model file") from None
    except IsADirectoryError:
        raise InputError("is a directory; give the path of a model file") from None
    except (OSError, ValueError) as error:
        reason = error.strerror if isinstance(error, OSError) else str(error)
        raise InputError(f"cannot be read ({reason}); give the path of a readable model file") from None
    return data


def _text(data: bytes) -> str:
    try:
        text = data.decode("utf-8-sig")  # some editors put a byte order mark first
    except UnicodeDecodeError as error:
        raise InputError(f"byte {error.start + 1} is not UTF-8 text; save the model file as UTF-8") from None
    return text.replace("\r\n", "\n")


def _parse(text: str) -> dict[str, Any]:
    """The TOML tables of a text whose size, digits and nesting are bounded first."""
    if known := _what_it_is(text):
        raise InputError(known)
    for number, line in enumerate(text.split("\n"), 1):
        if run := re.search(rf"[0-9_]{{{_MAX_RUN},}}", line):
            key = re.match(r"\s*([A-Za-z0-9_-]{1,40})\s*=", line)
            field = f"line {number} ({key[1]})" if key else f"line {number}"
            value = f"{run[0][:20]}... ({len(run[0])} digits)"
            raise InputError(f"{field}: {value} is too long a number; use at most {MAX_DIGITS} digits")
        if line.count(".") > _MAX_DOTS:
            raise InputError(f"line {number}: more than {_MAX_DOTS} dots in one line; use one line per joint")
    if len(text) > MAX_BYTES:
        raise InputError(f"the file has more than {MAX_BYTES} characters; a model file must be smaller")
    try:
        return tomllib.loads(text, parse_float=NumberText)
    except RecursionError:
        raise InputError("brackets are nested too deeply; a model file needs at most three levels") from None
    except ValueError as error:
        raise InputError(f"not valid TOML: {printable(str(error))[:200]}; correct the file") from None


def parsed_toml(text: str) -> dict[str, Any]:
    """The tables of another file with numbers as exact as in models, its size bounded likewise."""
    return _parse(text)


def _what_it_is(text: str) -> str | None:
    """What a file that is no TOML looks like by its first line, and what to do with it; None if it may be TOML.

    >>> _what_it_is("name: robot")
    'is YAML, it seems; a model file is TOML, with name = ".." in place of name: ..; `new` makes a first one'
    """
    first = next((line.strip() for line in text.split("\n") if line.strip() and not line.lstrip().startswith("#")), "")
    if first.startswith("{"):
        return "is JSON, as certificates are; use check, plot or report for it, and give the path of a model file here"
    if first == "---" or _YAML.match(first):
        return 'is YAML, it seems; a model file is TOML, with name = ".." in place of name: ..; `new` makes a first one'
    if first.startswith("<"):
        return "is XML, it seems; `new --urdf` makes a model of a URDF file"
    if _TABLE.fullmatch(first[:_LONGEST_FIRST]):
        return "is a table of numbers, it seems; `new --csv` makes a model of a table of joints"
    return None
