"""The machine at the poses of an accepted certificate, as its boxes enclose them."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import replace
from typing import Any

from pkm_exact.certify.certified_machine import certified_configuration, certified_machine, certified_problem
from pkm_exact.errors import InputError
from pkm_exact.geometry.machine import Machine
from pkm_exact.poses.pose_spelling import pose_of
from pkm_exact.statics.at_pose import AtPose
from pkm_exact.statics.machine_at_pose import machine_at_solution
from pkm_exact.wording import shown


def at_certified_poses(
    document: Mapping[str, Any], model: Machine | None = None, places: Sequence[int] | None = None
) -> list[AtPose]:
    """The machine at all poses of a certificate, or at some of them.

    Parameters
    ----------
    document : mapping
        Content of an accepted certificate of poses.
    model : Machine, optional
        Its model, which knows how slides and cranks drive it, and which constraints are actuated; without it legs that
        have no names are taken as actuators.
    places : sequence of int, optional
        From 0, in the order of the certificate.

    Raises
    ------
    InputError
        If the model is not that of the certificate.

    Examples
    --------
    >>> import json
    >>> from pathlib import Path
    >>> found = at_certified_poses(json.loads(Path("certs/3-rpr-merlet-p.json").read_text()))
    >>> len(found), found[0].rank, found[0].actuated
    (2, 3, ('leg 1', 'leg 2', 'leg 3'))
    """
    problem, chosen = certified_problem(document), None
    machine: Machine = certified_machine(document)
    if model is not None:
        machine, chosen = model, model.configuration(certified_configuration(document))
        if machine.problem(chosen).digest != problem.digest:
            raise InputError(f"configuration {shown(chosen.name)} is not the robot of the certificate; give its model")
    entries = document["poses"]
    listed = range(len(entries)) if places is None else places
    poses = (replace(pose_of(entries[k]), multiplicity=entries[k]["multiplicity"]) for k in listed)
    return [machine_at_solution(machine, problem, pose, chosen) for pose in poses]
