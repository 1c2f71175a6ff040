"""Exact and certified forward kinematics of parallel robots.

From the exact geometry and leg lengths of a robot to every real pose of its platform, each in a rational box that
provably holds exactly one, with a certificate that a second, small program checks.

Everything below is loaded when it is first used, so that importing the package costs next to nothing.

>>> from pkm_exact import Robot
>>> Robot.__module__
'pkm_exact.interactive.robots'
"""

from __future__ import annotations

from importlib import import_module
from typing import TYPE_CHECKING, Any, Final

if TYPE_CHECKING:
    from pkm_exact.batch.many import ManySolutions as ManySolutions
    from pkm_exact.batch.many import solve_many as solve_many
    from pkm_exact.certify.build import certificate as certificate
    from pkm_exact.certify.build import write_certificate as write_certificate
    from pkm_exact.certify.certificate import Certificate as Certificate
    from pkm_exact.certify.certificate import check as check
    from pkm_exact.certify.check import check_bytes as check_bytes
    from pkm_exact.certify.checker.verdict import Verdict as Verdict
    from pkm_exact.claim import Claim as Claim
    from pkm_exact.claim import CompletenessRoute as CompletenessRoute
    from pkm_exact.constraints.distance import Distance as Distance
    from pkm_exact.errors import InputError as InputError
    from pkm_exact.errors import PkmExactError as PkmExactError
    from pkm_exact.following.follower import Followed as Followed
    from pkm_exact.geometry.linkage import Linkage as Linkage
    from pkm_exact.geometry.links import Links as Links
    from pkm_exact.geometry.problem import ForwardProblem as ForwardProblem
    from pkm_exact.geometry.reader import read_linkage as read_linkage
    from pkm_exact.geometry.reader import read_links as read_links
    from pkm_exact.geometry.robot import Configuration as Configuration
    from pkm_exact.geometry.tolerances import Tolerances as Tolerances
    from pkm_exact.interactive.answers import Solution as Solution
    from pkm_exact.interactive.answers import ToleranceResult as ToleranceResult
    from pkm_exact.interactive.questions import solve as solve
    from pkm_exact.interactive.questions import solve_krawczyk as solve_krawczyk
    from pkm_exact.interactive.questions import tolerance_boxes as tolerance_boxes
    from pkm_exact.interactive.robots import Mechanism as Mechanism
    from pkm_exact.interactive.robots import Robot as Robot
    from pkm_exact.interactive.robots import read_robot as read_robot
    from pkm_exact.interactive.system_answers import SystemSolution as SystemSolution
    from pkm_exact.interactive.system_answers import solve_system as solve_system
    from pkm_exact.links.link_engine import solve_links as solve_links
    from pkm_exact.links.link_solution import LinkSolution as LinkSolution
    from pkm_exact.links.start_box import solve_from_start as solve_from_start
    from pkm_exact.mobility.analysis import LinkageMobility as LinkageMobility
    from pkm_exact.mobility.analysis import mobility_of as mobility_of
    from pkm_exact.mobility.platform_mobility import PlatformMobility as PlatformMobility
    from pkm_exact.mobility.platform_mobility import platform_mobility as platform_mobility
    from pkm_exact.numeric.trajectory import track_branch as track_branch
    from pkm_exact.policy import Policy as Policy
    from pkm_exact.poses.pose import Interval as Interval
    from pkm_exact.poses.pose import Pose as Pose
    from pkm_exact.recomputation import recompute as recompute
    from pkm_exact.screws.free_motions import FreeMotions as FreeMotions
    from pkm_exact.screws.screw import Screw as Screw
    from pkm_exact.screws.screw_system import ScrewSystem as ScrewSystem
    from pkm_exact.statics.at_pose import AtPose as AtPose

__version__: Final = "0.1.0"

_HOME: Final = {
    "AtPose": "statics.at_pose",
    "Certificate": "certify.certificate",
    "Claim": "claim",
    "CompletenessRoute": "claim",
    "Configuration": "geometry.robot",
    "Followed": "following.follower",
    "Distance": "constraints.distance",
    "ForwardProblem": "geometry.problem",
    "FreeMotions": "screws.free_motions",
    "InputError": "errors",
    "Interval": "poses.pose",
    "Linkage": "geometry.linkage",
    "LinkSolution": "links.link_solution",
    "LinkageMobility": "mobility.analysis",
    "Links": "geometry.links",
    "ManySolutions": "batch.many",
    "Mechanism": "interactive.robots",
    "PkmExactError": "errors",
    "PlatformMobility": "mobility.platform_mobility",
    "Policy": "policy",
    "Pose": "poses.pose",
    "Robot": "interactive.robots",
    "Screw": "screws.screw",
    "ScrewSystem": "screws.screw_system",
    "Solution": "interactive.answers",
    "SystemSolution": "interactive.system_answers",
    "ToleranceResult": "interactive.answers",
    "Tolerances": "geometry.tolerances",
    "Verdict": "certify.checker.verdict",
    "certificate": "certify.build",
    "check": "certify.certificate",
    "check_bytes": "certify.check",
    "mobility_of": "mobility.analysis",
    "platform_mobility": "mobility.platform_mobility",
    "read_linkage": "geometry.reader",
    "read_links": "geometry.reader",
    "read_robot": "interactive.robots",
    "recompute": "recomputation",
    "solve": "interactive.questions",
    "solve_from_start": "links.start_box",
    "solve_krawczyk": "interactive.questions",
    "solve_links": "links.link_engine",
    "solve_many": "batch.many",
    "solve_system": "interactive.system_answers",
    "tolerance_boxes": "interactive.questions",
    "track_branch": "numeric.trajectory",
    "write_certificate": "certify.build",
}

__all__ = ["__version__", *_HOME]


def __getattr__(name: str) -> Any:
    if name not in _HOME:
        from difflib import get_close_matches

        close = get_close_matches(name, _HOME, 1)
        remedy = f"did you mean {close[0]!r}?" if close else f"dir({__name__}) lists what it has"
        raise AttributeError(f"module {__name__!r} has no attribute {name!r}; {remedy}")
    value = getattr(import_module(f"{__name__}.{_HOME[name]}"), name)
    globals()[name] = value
    return value


def __dir__() -> list[str]:
    return sorted(__all__)
