"""A mechanism of bodies and joints as the text of a model file, exactly: what is read back is the same mechanism."""

from __future__ import annotations

import json
from collections.abc import Iterable, Iterator
from fractions import Fraction

from pkm_exact.geometry.joint_types import JOINT_TYPES
from pkm_exact.geometry.linkage import Joint, Linkage
from pkm_exact.geometry.rational import finite_decimal


def linkage_text(linkage: Linkage) -> str:
    """The text of a model file of the kind "chains".

    Examples
    --------
    >>> from pkm_exact.geometry.reader import read_linkage
    >>> sarrus = read_linkage("models/chains/sarrus.toml")
    >>> print(*linkage_text(sarrus).splitlines()[:3], sep=chr(10))
    schema = 1
    name = "Sarrus's six-bar"
    kind = "chains"
    """
    keys = ("name", "kind", "unit", "source", "base", "platform")
    head = ["schema = 1", *(f"{key} = {_quoted(getattr(linkage, key))}" for key in keys)]
    parts = [head, *([["[[bodies]]", f"name = {_quoted(body)}"] for body in linkage.bodies])]
    parts += [list(_joint(joint)) for joint in linkage.joints]
    return "\n\n".join("\n".join(part) for part in parts) + "\n"


def _joint(joint: Joint) -> Iterator[str]:
    geometry, kind = joint.geometry, JOINT_TYPES[joint.type]
    yield "[[joints]]"
    yield f"name = {_quoted(joint.name)}"
    yield f"type = {_quoted(joint.type)}"
    yield f"bodies = [{', '.join(map(_quoted, joint.bodies))}]"
    if "point" in kind.fields:
        yield f"point = {_list(geometry.point)}"
    if "pitch" in kind.fields:
        yield f"pitch = {_number(geometry.pitch)}"
    if kind.axes == 1:
        yield f"axis = {_list(geometry.axes[0])}"
    elif kind.axes:
        yield f"axes = [{', '.join(map(_list, geometry.axes))}]"
    if "screws" in kind.fields:
        yield f"screws = [{', '.join(map(_list, geometry.screws))}]"
    if joint.actuated:
        yield f"actuated = [{', '.join(map(str, joint.actuated))}]"


def _quoted(text: str) -> str:
    return json.dumps(text, ensure_ascii=False)


def _list(values: Iterable[Fraction]) -> str:
    return f"[{', '.join(map(_number, values))}]"


def _number(value: Fraction) -> str:
    decimal = finite_decimal(value)
    return f'"{value}"' if decimal is None or len(decimal) > 40 else decimal
