"""A robot's kinematics as C files: tables put into the code of ``c_code``, which follows poses as ``follower`` does."""

from __future__ import annotations

import re
from collections.abc import Mapping
from importlib import resources
from typing import Any, Final

import numpy as np

from pkm_exact.errors import InputError
from pkm_exact.following.follower import Followed
from pkm_exact.following.leg_tables import Array, LegTables
from pkm_exact.wording import printable, shown

FILES: Final = (".h", ".c", "_example.c", "_test.c")
_NAME: Final = re.compile(r"[A-Za-z][A-Za-z0-9_]{0,39}")
_VALUES: Final = {
    None: "lengths of the legs",
    False: "positions of the slides",
    True: "angles of the cranks, in radians",
}
_SMALL_MOVE: Final = 2.0**-11
_LEGS, _SLIDES, _CRANKS = 0, 1, 2


def checked_name(name: str) -> str:
    """The name itself, refused if it is no identifier in C.

    Raises
    ------
    InputError
        With what to do.
    """
    if not _NAME.fullmatch(name):
        raise InputError(f"--name: {shown(name)} is no name in C; use up to 40 letters, digits and _, a letter first")
    return name


def name_for(stem: str) -> str:
    """A name in C made from that of a model file.

    >>> name_for("3-rpr-merlet-p"), name_for("hexa")
    ('robot_3_rpr_merlet_p', 'hexa')
    """
    name = re.sub(r"[^A-Za-z0-9_]", "_", stem)[:30]
    return name if name[:1].isalpha() else f"robot_{name}"


def c_files(name: str, tables: LegTables, home: Followed, source: str) -> dict[str, str]:
    """The files of a robot, by file name: header, code, example, test.

    Parameters
    ----------
    name : str
        What functions and files begin with.
    tables : LegTables
    home : Followed
        A pose at which the example begins, and near which the test has its random poses.
    source : str
        Where the robot comes from, for the comments.

    Examples
    --------
    >>> from pkm_exact.interactive.robots import Robot
    >>> robot = Robot.load("models/3-rpr-merlet-p.toml")
    >>> home = robot.follow([50**0.5, 26**0.5, 5], ((5, 5, 0), (1, 0, 0, 0)))
    >>> list(c_files("merlet", home.tables, home, "an example"))
    ['merlet.h', 'merlet.c', 'merlet_example.c', 'merlet_test.c']
    """
    words = _words(checked_name(name), tables, home, source)
    folder = resources.files("pkm_exact.following").joinpath("c_code")
    return {
        f"{name}{ending}": _filled(folder.joinpath(f"robot{ending}").read_text(encoding="utf-8"), words)
        for ending in FILES
    }


def _filled(text: str, words: Mapping[str, str]) -> str:
    return re.sub(r"@([A-Z_0-9]+)@", lambda match: words[match[1]], text)


def _words(name: str, tables: LegTables, home: Followed, source: str) -> dict[str, str]:
    legs, n = len(tables.legs), len(tables.support)
    chained = bool(tables.robot.chains)
    kind = _LEGS if not chained else _CRANKS if tables.is_cranked else _SLIDES
    forms = tables.legs if tables.study is None else np.concatenate([tables.legs, tables.study[None]])
    step = 0.001 if tables.is_cranked else tables.unit * 2.0**-10
    planar = tables.robot.motion.is_planar
    move = tables.unit * _SMALL_MOVE
    moves = [move, move, 0.0 if planar else move]
    turns = [0.0, 0.0, 0.0, _SMALL_MOVE] if planar else [0.0, *[_SMALL_MOVE] * 3]
    return {
        "TITLE": _comment(f"{tables.robot.name} ({tables.robot.kind})"),
        "SOURCE": _comment(source),
        "VALUES": _VALUES[tables.is_cranked if chained else None],
        "UNIT": _comment(tables.robot.unit),
        "GUARD": f"{name.upper()}_H",
        "MACRO": name.upper(),
        "NAME": name,
        "M": str(legs),
        "N": str(n),
        "CHAINS": str(kind),
        "UNIT_OF_LENGTH": _number(tables.unit),
        "SUPPORT": f"{{{', '.join(map(str, tables.support))}}}",
        "ROOTS": _array(tables.roots),
        "WEIGHTS": _array(tables.weights),
        "LEGS": _array(forms),
        "POSE_FORMS": _array(np.concatenate([tables.pose, tables.norm[None]])),
        "PLATFORM": _array(tables.platform),
        "BASE": _array(tables.base),
        "MOVED": _array(tables.moved),
        "AT_0": _array(tables.at_0),
        "AT_90": _array(tables.at_90),
        "RODS_SQUARED": _array(tables.rods_squared),
        "HOME_POSITION": _array(home.position),
        "HOME_QUATERNION": _array(home.quaternion),
        "HOME_VALUES": _array(home.values),
        "STEP": _number(step),
        "MOVES": _array(np.array(moves)),
        "TURNS": _array(np.array(turns)),
        "ROOM": _number(tables.unit * 2.0**-34),
    }


def _array(values: Array) -> str:
    """Nested braces; each number reads back as the same double."""
    if values.ndim == 0:
        return _number(float(values))
    return f"{{{', '.join(_array(row) for row in values)}}}"


def _number(value: Any) -> str:
    text = repr(float(value) + 0.0)
    return text.removesuffix(".0") if text.endswith(".0") and "e" not in text and len(text) < 4 else text


def _comment(text: str) -> str:
    """The text for a comment: on one line, and not ending it."""
    return printable(text).replace("*/", "* /").replace("\\", "/").encode("ascii", "replace").decode("ascii")
