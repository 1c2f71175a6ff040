"""The option ``--names-from`` of ``solve``: names of poses carried from a certificate. All is imported inside it."""

from __future__ import annotations

from pathlib import Path
from typing import TYPE_CHECKING, Any

from pkm_exact.errors import InputError
from pkm_exact.wording import printable

if TYPE_CHECKING:
    from pkm_exact.cli.feasible_poses import ShownPoses
    from pkm_exact.geometry.problem import ForwardProblem
    from pkm_exact.numeric.carried_names import NamedPoses
    from pkm_exact.solution import Solution


def named_poses(file: str | None, asked: ForwardProblem, method: str) -> NamedPoses | None:
    """The poses of an accepted certificate, each with the name that ``solve`` gave it there; None without one.

    Raises
    ------
    InputError
        If the certificate is not accepted, does not claim that its list is complete, or is one of another robot than
        the one that is asked about; or if the method certifies no poses.
    """
    if file is None:
        return None
    if method == "newton":
        raise InputError("--names-from: is for certified poses; leave it out or choose another method")
    from pkm_exact.certify.certified_machine import certified_problem
    from pkm_exact.numeric.carried_names import NamedPoses
    from pkm_exact.numeric.problem_path import ProblemPath
    from pkm_exact.pictures.coordinates import listed_poses, placed_poses
    from pkm_exact.pictures.scene import accepted_document
    from pkm_exact.poses.pose_names import pose_signature, told_apart
    from pkm_exact.poses.pose_spelling import pose_of

    document: dict[str, Any] = accepted_document(Path(file))
    if document.get("format") != "pkm_exact certificate" or document["claim"] != "complete":
        raise InputError(
            f"{printable(file)}: --names-from: is no certificate of all poses of a robot; give one that is complete"
        )
    problem = certified_problem(document)
    try:
        ProblemPath((problem, asked)).require()
    except InputError as error:
        raise _refused(file, error) from None
    places = placed_poses(listed_poses(document), problem)
    poses = tuple(map(pose_of, document["poses"]))
    signatures = [
        pose_signature(pose.position, pose.rotation, place.det_sign, problem.motion)
        for pose, place in zip(poses, places, strict=True)
    ]
    return NamedPoses(Path(file).name, problem, poses, told_apart(signatures))


def with_names(
    shown: ShownPoses, solution: Solution, file: str | None, reference: NamedPoses | None, *, verbose: bool
) -> ShownPoses:
    """The poses of a solution under the names that are carried to them; as they are without a certificate."""
    if file is None or reference is None:
        return shown
    from pkm_exact.interactive.progress import Progress
    from pkm_exact.numeric.carried_names import carried_names

    with Progress(verbose=verbose) as progress:
        try:
            return shown.named(carried_names(reference, solution, progress))
        except InputError as error:
            raise _refused(file, error) from None


def _refused(file: str, error: InputError) -> InputError:
    return InputError(
        f"--names-from {printable(file)}: {error}; give a certificate of this robot, or leave the option out"
    )
