"""Robots with legs only, as version 1 of certificates writes them, whatever the version: for what shows them."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

from pkm_exact.certify.certified_machine import certified_machine, certified_squares
from pkm_exact.errors import InputError
from pkm_exact.geometry.robot import Robot


def legs_view(document: Mapping[str, Any]) -> Mapping[str, Any]:
    """The content of a certificate with joints, kind and lengths in the places where version 1 has them.

    It is no certificate: what proves it stays as it is.

    Raises
    ------
    InputError
        If some constraint is not a leg.
    """
    if "constraints" not in document["robot"]:
        return document
    machine = certified_machine(document)
    if not isinstance(machine, Robot):
        raise InputError(
            "robot: mechanisms with other constraints than legs are not drawn; give a robot with legs only"
        )
    entry = {key: document["robot"][key] for key in ("name", "unit", "source", "metric")}
    sides = {"base": machine.base_joints, "platform": machine.platform_joints}
    joints = {side: [[str(x) for x in joint] for joint in found] for side, found in sides.items()}
    squares = [str(square) for square in certified_squares(document)]
    return {
        **document,
        "robot": {"name": entry.pop("name"), "kind": machine.kind, **entry, **joints},
        "configuration": {"name": document["configuration"], "lengths_squared": squares},
    }
