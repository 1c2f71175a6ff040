"""A first model as the text of a model file, each line explained."""

from __future__ import annotations

import json
from collections.abc import Iterable, Iterator
from fractions import Fraction
from typing import Final

from pkm_exact.geometry.chains import Crank
from pkm_exact.geometry.inverse import UNIT_METRIC
from pkm_exact.geometry.kinds import KINDS, Joints
from pkm_exact.geometry.rational import finite_decimal
from pkm_exact.templates.design import Design, Draft
from pkm_exact.templates.layout import rounded_root
from pkm_exact.templates.rings import BOTTOM

_COLUMN: Final = 42  # where comments begin behind short lines
_DIGITS: Final = 6


def toml_number(number: Fraction) -> str:
    """The number as a model file has it: an integer, a decimal that ends, or a fraction in quotes.

    >>> [toml_number(Fraction(text)) for text in ("3", "-5/4", "1/3")]
    ['3', '-1.25', '"1/3"']
    """
    return finite_decimal(number) or f'"{number}"'


def model_text(draft: Draft, name: str, unit: str) -> str:
    """The text of the model file, which ``read_robot`` reads.

    Examples
    --------
    >>> from pkm_exact.templates.design import Design, drawn
    >>> sides = (Fraction(4), Fraction(2)), (Fraction(1), Fraction(3))
    >>> print(model_text(drawn(Design("6-UPS", *sides, Fraction(5))), "example", "m").split("\\n")[2])
    schema = 1                                # version of this format
    """
    parts = (
        _head(draft, name, unit),
        _base(draft),
        _chains(draft),
        _platform(draft),
        _home(draft),
        _nominal(draft),
        _limits(draft),
        _more(draft),
    )
    return "\n\n".join("\n".join(lines) for part in parts if (lines := list(part))) + "\n"


def _head(draft: Draft, name: str, unit: str) -> Iterator[str]:
    kind = draft.design.kind
    yield "# A model file for certify-poses. What follows a # is comment. Every number means exactly what is written:"
    yield '# 0.1 is 1/10, and "1/3", in quotes, is a third.'
    yield _line("schema = 1", "version of this format")
    yield _line(f"name = {json.dumps(name, ensure_ascii=False)}", "shown above every result")
    yield _line(f'kind = "{kind}"', KINDS[kind].description)
    yield _line(f"unit = {json.dumps(unit, ensure_ascii=False)}", "of all lengths; only shown, nothing is converted")
    yield "# Where the numbers come from: a drawing, a paper, a calibration. Say it here once they are yours."
    yield f'source = "a first design, drawn by certify-poses new {_options(draft)}"'
    if draft.metric != UNIT_METRIC:
        n = draft.metric[1]
        yield f"# Coordinates with sqrt({n}) are exact in this metric: the ordinary y is sqrt({n}) times the y in this"
        yield f"# file, for {'joints and vectors' if draft.chains else 'joints and positions'}. x and z are ordinary."
        yield "# Take this line out when you put in joints from a drawing: their y is ordinary."
        yield _line(f"metric = [1, {n}, 1]", "without it, every y is ordinary")


def _base(draft: Draft) -> Iterator[str]:
    yield "[base]"
    where = {"6-RUS": "the motors' axes", "3-RRR": "the motors' axes", "6-PUS": "the slides", "3-PRR": "the slides"}
    points = where.get(draft.design.kind, "the fixed joints, one row per leg")
    frame = "joint 1, x towards joint 2" if draft.design.base[2:] else "the centre, z upwards"
    yield (
        f"# In the fixed frame, a point on each of {points}; its origin is {frame}."
        if draft.chains
        else (f"# Centres of {points}; the frame's origin is {frame}.")
    )
    yield from _joints(draft, draft.base, draft.design.base)


def _platform(draft: Draft) -> Iterator[str]:
    yield "[platform]"
    frame = "joint 1, x towards joint 2" if draft.design.base[2:] else "its centre"
    yield f"# Centres of the moving joints, row i for leg i, in the platform's own frame; its origin is {frame}."
    yield from _joints(draft, draft.platform, draft.design.platform)


def _joints(draft: Draft, joints: Joints, sides: tuple[Fraction, ...]) -> Iterator[str]:
    rows = ["joints = ["]
    rows += [f"    [{_numbers(joint[:2] if len(sides) == 3 else joint)}]," for joint in joints]
    rows.append("]")
    if len(sides) == 2 and draft.design.digits is None:
        yield "# A hexagon of equal angles: sides 1-2, 3-4, 5-6 have the first length, sides 2-3, 4-5, 6-1 the second."
        yield f"hexagon = {{ sides = [{_numbers(sides)}], height = 0 }}"
        yield "# The same joint by joint, to move one (y in the metric): take out the line above, and the # below."
        yield from (f"# {row}" for row in rows)
    else:
        if draft.design.digits is not None:
            yield f"# Rounded to {draft.design.digits} decimals: what stands here is the robot."
        yield from rows


def _chains(draft: Draft) -> Iterator[str]:
    if not draft.chains:
        return
    first = draft.chains[0]
    if isinstance(first, Crank):
        yield "[cranks]"
        yield "# From each base joint to the end of its crank, at the angle 0 ..."
        if draft.metric == UNIT_METRIC and len(draft.chains) == 6:
            yield f"# (near {_crank_directions(draft)}; for decimals, exact ones within the last digit stand in)"
        yield from _vectors("at_0", draft, [chain.at_0 for chain in draft.chains if isinstance(chain, Crank)])
        yield "# ... and at 90 degrees: perpendicular to the first, and as long."
        yield from _vectors("at_90", draft, [chain.at_90 for chain in draft.chains if isinstance(chain, Crank)])
    else:
        dimension = 2 if KINDS[draft.design.kind].motion.is_planar else 3
        yield "[slides]"
        yield "# Of all slides; or directions = [...] with one vector per leg. A unit vector makes positions lengths."
        yield f"direction = [{_numbers(first.direction[:dimension])}]"
    yield ""
    yield "[rods]"
    rod = draft.design.rod
    long = f"from the home pose below; the rods are about {_roots(draft)}" if rod is None else f"all {_plain(rod)}"
    yield f"# Squared lengths of the rods, exact, {long} long."
    yield "# Or lengths = [...], one per leg, or length = ... if all are equal."
    yield f"lengths_squared = [{_numbers(draft.lengths_squared)}]"


def _vectors(key: str, draft: Draft, vectors: list[tuple[Fraction, ...]]) -> Iterator[str]:
    dimension = 2 if KINDS[draft.design.kind].motion.is_planar else 3
    yield f"{key} = ["
    yield from (f"    [{_numbers(vector[:dimension])}]," for vector in vectors)
    yield "]"


def _home(draft: Draft) -> Iterator[str]:
    height, nearly = _plain(draft.design.height), "about " if draft.design.rod is not None else ""
    kind = KINDS[draft.design.kind]
    yield "# Locked actuators, under a name; as many of these tables as you like. The first is what `solve` takes."
    yield "[[configurations]]"
    yield 'name = "home"'
    if draft.chains:
        where = (
            f"at ({_numbers(draft.position[:2])})" if kind.motion.is_planar else f"level at {nearly}the height {height}"
        )
        what = "Tangents of half the angles (0 is 0 degrees, 1 is 90)" if _cranks(draft) else "Positions of the slides"
        yield f"# {what}; the platform can then be {where}."
        yield f"{'half_tangents' if _cranks(draft) else 'slides'} = [{', '.join(['0'] * kind.legs)}]"
    elif kind.motion.is_planar:
        yield "# The lengths that the legs have in this pose; half_tangent is that of half the platform's angle."
        yield f"pose = {{ position = [{_numbers(draft.position[:2])}], {_turn(draft)} }}"
    else:
        yield f"# The lengths that the legs have when the platform is level, at the height {height}."
        yield f"pose = {{ position = [{_numbers(draft.position)}], quaternion = [1, 0, 0, 0] }}"


def _nominal(draft: Draft) -> Iterator[str]:
    yield "[nominal]"
    yield "# Which of the poses is meant: the nearest to this one is marked wherever poses are listed."
    if KINDS[draft.design.kind].motion.is_planar:
        yield f"position = [{_numbers(draft.position[:2])}]"
        yield _line(_turn(draft), "tangent of half the platform's angle")
    else:
        yield f"position = [{_numbers(draft.position)}]"
        turn = "rpy_degrees = [0, 0, 0]" if draft.metric == UNIT_METRIC else "quaternion = [1, 0, 0, 0]"
        yield _line(turn, "not turned")


def _limits(draft: Draft) -> Iterator[str]:
    """How far the actuators go, as a comment that holds once the # is taken away."""
    yield "# How far the actuators go, least and greatest; solve, track, region then say which poses keep that."
    yield "# [limits]"
    if not draft.chains:
        roots = [rounded_root(square, _DIGITS) for square in draft.lengths_squared]
        yield f"# lengths = [{_numbers([_two_digits(min(roots) * 4 / 5), _two_digits(max(roots) * 5 / 4)])}]"
    elif _cranks(draft):
        yield "# angles = [-85, 85]"
    else:
        half = _two_digits(draft.design.height / 2)
        yield f"# slides = [{_numbers([-half, half])}]"


def _two_digits(number: Fraction) -> Fraction:
    """A positive number to two digits.

    >>> _two_digits(Fraction(1925, 10)), _two_digits(Fraction(4, 300))
    (Fraction(190, 1), Fraction(13, 1000))
    """
    step = Fraction(1)
    while number < 10 * step:
        step /= 10
    while number >= 100 * step:
        step *= 10
    return round(number / step) * step


def _more(draft: Draft) -> Iterator[str]:
    """Examples of what else can be written, as comments that hold once the # is taken away."""
    if not draft.chains:
        yield "# Measured lengths, one per leg (here those of home, rounded):"
        yield "# [[configurations]]"
        yield '# name = "measured"'
        yield f"# lengths = [{_numbers(rounded_root(square, _DIGITS) for square in draft.lengths_squared)}]"
        return
    legs = KINDS[draft.design.kind].legs
    yield "# Other actuator positions:"
    yield "# [[configurations]]"
    yield '# name = "moved"'
    if _cranks(draft):
        yield f"# half_tangents = [{_numbers(Fraction(1, k) for k in (10, 5, 6, 7, 4, 8)[:legs])}]"
    else:
        step = draft.design.height / 20
        yield f"# slides = [{_numbers(step * k for k in (1, -2, 3, -1, 2, -3)[:legs])}]"


def _options(draft: Draft) -> str:
    """The options that make the same design again."""
    design = draft.design
    words = [f"--kind {design.kind}"]
    for option, sides in (("--base-sides", design.base), ("--platform-sides", design.platform)):
        words += [f"{option} {','.join(map(_plain, sides))}"] if sides else []
    words += _circles(design)
    words.append(f"--height {_plain(design.height)}" if design.rod is None else f"--rod {_plain(design.rod)}")
    if design.crank is not None:
        words.append(f"--crank {_plain(design.crank)}")
    if design.motor_direction:
        words.append(f"--motor-direction {_plain(design.motor_direction)}")
    if design.digits is not None:
        words.append(f"--digits {design.digits}")
    elif draft.metric != UNIT_METRIC:
        words.append("--exact")
    return " ".join(words)


def _crank_directions(draft: Draft) -> str:
    if draft.design.circles is None:
        return "the directions of the sides"
    turn = draft.design.motor_direction
    return "the tangents of the circle" + (f", turned by {_plain(turn)} degrees outward" if turn else "")


def _circles(design: Design) -> list[str]:
    if design.circles is None:
        return []
    base, platform = design.circles
    words = [
        f"--{part}-circle {_plain(ring.radius)},{_plain(ring.degrees)}"
        for part, ring in (("base", base), ("platform", platform))
    ]
    azimuth = [] if base.azimuth == BOTTOM else [f"--base-azimuth {_plain(base.azimuth)}"]
    return [*words, *azimuth, f"--platform-shift {_plain(platform.azimuth - base.azimuth)}"]


def _turn(draft: Draft) -> str:
    return f"half_tangent = {toml_number(draft.half_tangent)}"


def _cranks(draft: Draft) -> bool:
    return isinstance(draft.chains[0], Crank)


def _equal(draft: Draft) -> bool:
    return len(set(draft.lengths_squared)) == 1


def _roots(draft: Draft) -> str:
    squares = draft.lengths_squared[:1] if _equal(draft) else draft.lengths_squared
    return ", ".join(_plain(rounded_root(square, _DIGITS)) for square in squares)


def _numbers(numbers: Iterable[Fraction]) -> str:
    return ", ".join(map(toml_number, numbers))


def _plain(number: Fraction) -> str:
    return toml_number(number).strip('"')


def _line(text: str, comment: str) -> str:
    return f"{text:<{_COLUMN - 1}} # {comment}"
