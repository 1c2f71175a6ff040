"""What closes the loops of a URDF file, in a YAML file beside it, as Gepetto's example-parallel-robots have them.

closed_loop: [[frame, frame], ..]    pairs of frames, named by their link or joint, that are one in the closed robot
type: [6d, 3d, ..]                   of each pair: the frames are one (6d, if it is left out), or their origins (3d)
name_mot: [joint, ..]                actuated joints
joint_name, joint_type               joints of other types: SPHERICAL, FIXED, UJOINT_XY, UJOINT_YZ or UJOINT_ZX
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field
from pathlib import Path
from types import MappingProxyType
from typing import Any, Final

from pkm_exact.errors import InputError
from pkm_exact.wording import printable, shown

MOST_BYTES: Final = 1 << 16
_DEEPEST: Final = 8
JOINT_TYPES: Final = {
    "SPHERICAL": "ball",
    "FIXED": "fixed",
    "UJOINT_XY": "UJOINT_XY",
    "UJOINT_YZ": "UJOINT_YZ",
    "UJOINT_ZX": "UJOINT_ZX",
}
"""And what a URDF file calls them, or would: two turns about axes of the joint's frame, in their order."""
UNIVERSAL: Final = MappingProxyType({"UJOINT_XY": (0, 1), "UJOINT_YZ": (1, 2), "UJOINT_ZX": (2, 0)})
_KEYS: Final = ("closed_loop", "type", "name_mot", "joint_name", "joint_type")


@dataclass(frozen=True)
class Closures:
    """What a YAML file says of the links and joints of a URDF file.

    Attributes
    ----------
    loops : tuple of (str, str, bool)
        Two frames, and whether only their origins are one.
    actuated : tuple of str
        Joints.
    types : mapping
        Joints whose types are others than those of the URDF file, and those.
    """

    loops: tuple[tuple[str, str, bool], ...] = ()
    actuated: tuple[str, ...] = ()
    types: Mapping[str, str] = field(default_factory=dict)


def read_closures(path: str | Path) -> Closures:
    """The closures in a YAML file.

    Raises
    ------
    InputError
        If it is no such file, or PyYAML is not installed; one sentence with file, key and remedy.
    """
    try:
        return _closures(_content(Path(path)))
    except InputError as error:
        raise InputError(f"{printable(str(path))}: {error}") from None


def _content(path: Path) -> dict[str, Any]:
    try:
        import yaml
    except ImportError:
        raise InputError('PyYAML is not installed, which reads it; pip install "pkm_exact[urdf]"') from None
    try:
        with path.open("rb") as stream:
            data = stream.read(MOST_BYTES + 1)
    except (OSError, ValueError) as error:
        raise InputError(
            f"cannot be read ({getattr(error, 'strerror', error)}); give the path of a YAML file"
        ) from None
    if len(data) > MOST_BYTES:
        raise InputError(f"has more than {MOST_BYTES} bytes; a file of closures is smaller")
    try:
        text = data.decode("utf-8")
        depth = 0
        for event in yaml.parse(text, yaml.SafeLoader):
            # Aliases of aliases are short, and may stand for more than memory holds.
            if isinstance(event, yaml.AliasEvent):
                raise InputError("has an alias (*..); write out what it stands for")
            # The time to read a list grows with the square of its depth.
            depth += isinstance(event, yaml.CollectionStartEvent)
            depth -= isinstance(event, yaml.CollectionEndEvent)
            if depth > _DEEPEST:
                raise InputError(f"lists within lists, {_DEEPEST + 1} deep; write closed_loop: [[frame, frame]]")
        found = yaml.safe_load(text)
    except (yaml.YAMLError, ValueError, RecursionError):
        raise InputError("is not YAML; write closed_loop: [[frame, frame]]") from None
    if not isinstance(found, dict):
        raise InputError("has no keys; write closed_loop: [[frame, frame]]")
    unknown = next((key for key in found if key not in _KEYS), None)
    if unknown is not None:
        key = unknown if isinstance(unknown, str) else "a key that is no text"
        raise InputError(f"unknown key {shown(key)}; the known keys are: {', '.join(_KEYS)}")
    return found


def _closures(content: Mapping[str, Any]) -> Closures:
    """What the keys say.

    >>> _closures({"closed_loop": [["a", "b"]], "name_mot": ["m"]})
    Closures(loops=(('a', 'b', False),), actuated=('m',), types={})
    """
    pairs = content.get("closed_loop") or []
    if not isinstance(pairs, list) or not all(_is_pair(pair) for pair in pairs):
        raise InputError("closed_loop: is no list of pairs of names; write [[frame, frame], ..]")
    kinds = _texts(content, "type") or ["6d"] * len(pairs)
    if len(kinds) != len(pairs):
        raise InputError(f"type: {len(kinds)} given; give {len(pairs)}, one for each pair in closed_loop")
    wrong = next((kind for kind in kinds if kind.lower() not in ("3d", "6d")), None)
    if wrong is not None:
        raise InputError(f"type: {shown(wrong)} is unknown; use 3d or 6d")
    names, types = _texts(content, "joint_name"), _texts(content, "joint_type")
    if len(names) != len(types) or len(set(names)) < len(names):
        raise InputError(
            f"joint_type: {len(types)} types for {len(names)} names; give one for each in joint_name, each name once"
        )
    unknown = next((kind for kind in types if kind not in JOINT_TYPES), None)
    if unknown is not None:
        raise InputError(f"joint_type: {shown(unknown)} is unknown; use one of: {', '.join(JOINT_TYPES)}")
    loops = tuple((a, b, kind.lower() == "3d") for (a, b), kind in zip(pairs, kinds, strict=True))
    return Closures(loops, tuple(_texts(content, "name_mot")), dict(zip(names, types, strict=True)))


def _is_pair(pair: object) -> bool:
    return isinstance(pair, list) and len(pair) == 2 and all(isinstance(name, str) for name in pair)


def _texts(content: Mapping[str, Any], key: str) -> list[str]:
    found = content.get(key) or []
    if not isinstance(found, list) or not all(isinstance(entry, str) for entry in found):
        raise InputError(f"{key}: is no list of names; write [name, ..]")
    return found
