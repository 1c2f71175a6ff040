"""A parallel robot with exact geometry, and the forward kinematics problems it poses."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, field, replace
from fractions import Fraction
from typing import TYPE_CHECKING

from pkm_exact.errors import InputError
from pkm_exact.geometry.angle_degrees import StandIn
from pkm_exact.geometry.chains import Chain, Crank, JointValue, parse_cosine_and_sine
from pkm_exact.geometry.inverse import UNIT_METRIC, Metric
from pkm_exact.geometry.joints import in_plane, parse_joints, parse_metric, refuse_equal_legs
from pkm_exact.geometry.kinds import KINDS, Joints, gough_legs, knees
from pkm_exact.geometry.limits import Limits
from pkm_exact.geometry.machine import Machine
from pkm_exact.geometry.problem import ForwardProblem
from pkm_exact.geometry.rational import MAX_COMPUTED_DIGITS, bounded, parse_positive, parse_rational
from pkm_exact.geometry.tolerances import Tolerances
from pkm_exact.motions.motion import Motion
from pkm_exact.wording import shown

if TYPE_CHECKING:
    from pkm_exact.geometry.nominal_pose import NominalPose


def _squares(values: Sequence[object], where: str) -> tuple[Fraction, ...]:
    return tuple(parse_positive(value, f"{where}[{i}]") for i, value in enumerate(values, 1))


@dataclass(frozen=True)
class Configuration:
    """Locked actuators under a name.

    Attributes
    ----------
    name : str
        Unique among the configurations of a robot.
    lengths_squared : tuple of 6 Fraction
        Squared leg lengths, positive, in squared units of length; of the rods, if the robot has cranks or slides. Three
        for a planar robot.
    joint_values : tuple of joint values, one per leg
        Positions of the slides, or (cos, sin) of the cranks' angles; empty if the legs themselves are actuated.
    written_digit : Fraction or None
        Unit of its last decimal in the model file; None without decimals.
    stand_ins : tuple of StandIn or str
        Angles among the joint values that were given in degrees and are taken as others, by how much; or sentences.

    Examples
    --------
    >>> [str(square) for square in Configuration("home", (4, "9/4", 1)).lengths_squared]
    ['4', '9/4', '1']
    """

    name: str
    lengths_squared: tuple[Fraction, ...]
    joint_values: tuple[JointValue, ...] = ()
    written_digit: Fraction | None = field(default=None, repr=False, compare=False)
    stand_ins: tuple[StandIn | str, ...] = field(default=(), repr=False, compare=False)

    def __post_init__(self) -> None:
        where = f"configuration {shown(self.name)}, lengths_squared"
        if len(self.lengths_squared) not in (3, 6):
            raise InputError(f"{where}: {len(self.lengths_squared)} values; give 6, one per leg, or 3 if it is planar")
        object.__setattr__(self, "lengths_squared", _squares(self.lengths_squared, where))


@dataclass(frozen=True)
class Robot(Machine):
    """A parallel robot: exact joint coordinates, how they are joined, and named configurations.

    Attributes
    ----------
    name, unit, source : str
        Its name, the unit of length, and where the numbers come from.
    kind : str
        Key in ``KINDS``: what the legs are made of.
    base_joints, platform_joints : tuple of 6 vectors of 3 Fraction
        Joint centres in the fixed and in the mobile frame, rational coordinates with respect to ``metric``. A crank
        turns about its base joint, a slide passes through it. Three if the kind is planar, given by two coordinates
        each; the third is then 0.
    metric : tuple of 3 int
        Gram diagonal, positive integers: the ordinary coordinate is sqrt(metric[i]) times the rational one. Two suffice
        if the kind is planar.
    configurations : tuple of Configuration
        In the order of the model file; the first one is the default.
    chains : tuple of Crank or Slide
        The actuated chains, one per leg; empty for a kind whose legs themselves are actuated.
    tolerances : Tolerances or None
        Of its data, if they are known.
    limits : Limits or None
        Of actuators, passive joints, legs and position, if there are any.
    nominal : NominalPose or None
        The pose in which it is meant to be.
    cables : bool
        Whether its legs are cables, which only pull.
    stand_ins : tuple of StandIn or str
        What stands in for numbers of the model file that are not exact: angles, or sentences.
    written_digit : Fraction or None
        Unit of the last decimal of joints, cranks, slides and rods in the model file; None without decimals.

    Examples
    --------
    >>> corners = tuple((Fraction(x), Fraction(y), Fraction(0)) for x in (0, 1, 2) for y in (0, 1))
    >>> robot = Robot("example", "6-UPS", "m", "made up", corners, corners)
    >>> robot.problem((4, 4, 4, 4, 4, "4.01")).distances[5].length_squared
    Fraction(401, 100)
    """

    name: str
    kind: str
    unit: str
    source: str
    base_joints: Joints
    platform_joints: Joints
    metric: Metric = UNIT_METRIC
    configurations: tuple[Configuration, ...] = ()
    chains: tuple[Chain, ...] = ()
    tolerances: Tolerances | None = None
    limits: Limits | None = None
    nominal: NominalPose | None = None
    cables: bool = False
    stand_ins: tuple[StandIn | str, ...] = field(default=(), repr=False, compare=False)
    written_digit: Fraction | None = field(default=None, repr=False, compare=False)

    def __post_init__(self) -> None:
        if self.kind not in KINDS:
            raise InputError(f"kind: {shown(self.kind)} is unknown; use one of: {', '.join(KINDS)}")
        kind = KINDS[self.kind]
        for side, where in (("base_joints", "base.joints"), ("platform_joints", "platform.joints")):
            rows = [in_plane(row) for row in getattr(self, side)] if kind.motion.is_planar else getattr(self, side)
            object.__setattr__(self, side, parse_joints(rows, where, kind))
        object.__setattr__(self, "metric", parse_metric(self.metric, kind.motion))
        self._require_chains()
        if not self.chains:
            refuse_equal_legs(self.base_joints, self.platform_joints)
        _refuse_equal_names(self.configurations)

    def __repr__(self) -> str:
        return f"Robot({self.name!r}, kind={self.kind!r})"

    @property
    def motion(self) -> Motion:
        """What the platform of a robot of this kind is capable of."""
        return KINDS[self.kind].motion

    @property
    def actuated(self) -> tuple[str, ...]:
        """The legs, by their numbers."""
        return tuple(f"leg {number}" for number in range(1, KINDS[self.kind].legs + 1))

    @property
    def are_lengths(self) -> tuple[bool, ...]:
        """Whether they are leg lengths: of other robots the values are positions or half tangents."""
        return tuple(not self.chains for _ in self.actuated)

    def _instead_of_configurations(self) -> str:
        count = "three" if self.motion.is_planar else "six"
        return "add one with joint values" if self.chains else f"give the {count} leg lengths instead"

    def problem(self, locked: Configuration | Sequence[Fraction | int | str]) -> ForwardProblem:
        """The forward kinematics problem of a configuration, or for squared leg lengths, exact and positive.

        Raises
        ------
        InputError
            If the values do not fit the kind: cranks and slides need a configuration, their rods have fixed lengths.
        """
        if not isinstance(locked, Configuration):
            if self.chains:
                raise InputError(
                    f"lengths: the rods of a {self.kind} robot have fixed lengths; give joint values (--joints) or a "
                    "configuration instead"
                )
            self._require_one_per_leg(locked, "lengths_squared")
            values = _squares(locked, "lengths_squared")
            return self._problem(self.base_joints, values)
        feet = self.knees(locked)
        self._require_one_per_leg(locked.lengths_squared, f"configuration {shown(locked.name)}, lengths_squared")
        return self._problem(feet, locked.lengths_squared)

    def problem_at(self, values: Sequence[Fraction], *, squared: bool = False) -> ForwardProblem:
        """The problem for given leg lengths, or squared ones."""
        self._require_one_per_leg(values, "lengths_squared" if squared else "lengths")
        return self.problem(values if squared else [value * value for value in values])

    def lock(self, name: str, values: Sequence[object]) -> Configuration:
        """The configuration in which the cranks or slides stand at the given joint values.

        Parameters
        ----------
        name : str
        values : sequence, one per leg
            Positions of slides; pairs (cos, sin) for cranks.

        Raises
        ------
        InputError
            If the values are not exact, or put two rods at the same two points.
        """
        if not self.chains:
            raise InputError(f"kind: the legs of a {self.kind} robot are locked by their lengths")
        if len(values) != len(self.chains):
            raise InputError(f"joint values: {len(values)} given; give {len(self.chains)}, one per leg")
        parse = parse_cosine_and_sine if isinstance(self.chains[0], Crank) else parse_rational
        exact = tuple(parse(value, f"joint values[{i}]") for i, value in enumerate(values, 1))
        locked = Configuration(name, tuple(chain.rod_squared for chain in self.chains), exact)
        feet = self.knees(locked)
        for leg, foot in enumerate(feet, 1):
            for coordinate in foot:
                bounded(coordinate, coordinate, f"the knee of leg {leg}", MAX_COMPUTED_DIGITS)
        refuse_equal_legs(feet, self.platform_joints, "knees and platform.joints")
        return locked

    def knees(self, locked: Configuration) -> Joints:
        """The lower ends of the legs: the base joints, or where cranks or slides put the rods."""
        if len(locked.joint_values) != len(self.chains):
            raise InputError(
                f"configuration {shown(locked.name)}: {len(locked.joint_values)} joint values do not fit the kind "
                f"{self.kind}; use one made for it"
            )
        return knees(self.base_joints, self.chains, locked.joint_values) if self.chains else self.base_joints

    def as_gough(self, locked: Configuration | None) -> Robot:
        """The 6-UPS (or 3-RPR) robot with the same poses: itself, or with a configuration's knees as base joints."""
        if not self.chains:
            return self
        if locked is None:
            raise InputError(f"configuration: a {self.kind} robot has knees only in a configuration; name one")
        kind = KINDS[self.kind].gough
        note = f"as {kind}: the knees of the {self.kind} robot in configuration {locked.name} are its base joints"
        reduced = Configuration(locked.name, locked.lengths_squared, stand_ins=locked.stand_ins)
        return replace(
            self,
            kind=kind,
            source=f"{self.source}; {note}",
            base_joints=self.knees(locked),
            chains=(),
            limits=None,
            configurations=(reduced,),
        )

    def _require_chains(self) -> None:
        kind = KINDS[self.kind]
        if kind.chain is None:
            if self.chains:
                raise InputError(f"kind: a {self.kind} robot has neither cranks nor slides; remove them")
            return
        if len(self.chains) != kind.legs:
            raise InputError(f"{kind.chain_table}: {len(self.chains)} given; give {kind.legs}, one per leg")
        for leg, chain in enumerate(self.chains, 1):
            if not isinstance(chain, kind.chain):
                raise InputError(
                    f"{kind.chain_table}[{leg}]: does not belong to the kind {self.kind}; use another kind"
                )
            chain.require_exact(self.metric, f"{kind.chain_table}, leg {leg}")
            if kind.motion.is_planar and not chain.is_planar:
                raise InputError(
                    f"{kind.chain_table}, leg {leg}: leaves the plane of a {self.kind} robot; give third coordinates 0"
                )

    def _require_one_per_leg(self, values: Sequence[object], where: str) -> None:
        legs = KINDS[self.kind].legs
        if len(values) != legs:
            raise InputError(f"{where}: {len(values)} values; give {legs}, one per leg")

    def _problem(self, feet: Joints, lengths_squared: tuple[Fraction, ...]) -> ForwardProblem:
        legs = gough_legs(feet, self.platform_joints, lengths_squared)
        return ForwardProblem(legs, self.metric, KINDS[self.kind].motion)


def jointed(robot: Machine, question: str) -> Robot:
    """The robot itself, for a question that needs its joints, cranks or slides.

    Raises
    ------
    InputError
        If it has none but is declared by constraints.
    """
    if not isinstance(robot, Robot):
        raise InputError(
            f"kind: {question} needs a robot with legs, not the kind {robot.kind}; give one of: {', '.join(KINDS)}"
        )
    return robot


def _refuse_equal_names(configurations: tuple[Configuration, ...]) -> None:
    names: set[str] = set()
    for configuration in configurations:
        if configuration.name in names:
            raise InputError(f"configurations: the name {shown(configuration.name)} is used twice; rename one of them")
        names.add(configuration.name)
