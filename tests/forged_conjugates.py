"""Tolerance certificates around complex solutions, in charts of one's own, and bounds of poses that end where they may.

A pair of solutions has real and imaginary parts, and N(e) may be any complex number: that depends on the chart.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from fractions import Fraction
from functools import cache, partial
from math import ceil, floor
from typing import Any

from certificate_subjects import Content, subject
from certificate_tools import at, with_entry
from forged_cores import CORE, FIRST, PAIR, K, around, limit
from forged_cores import _off as _off_centre
from held_mechanisms import Pose

from pkm_exact.certify import pure

Case = tuple[Callable[[], Content], str]
REJECTED, ACCEPTED = "rejected", "accepted"
COMPLETE = "tolerance, planar, complete"
Complex = tuple[Fraction, Fraction]

# Bounds of a pose


def _ends(low: str, high: str) -> Content:
    """Other bounds of the first coordinate of a quaternion."""
    return with_entry(around(PAIR[:1], FIRST, K), ("boxes", 0, "quaternion", 0), [low, high])


def _beyond(place: int, end: int) -> Content:
    """Bounds of the pose that reach beyond the outer box at one end of one coordinate."""
    content = around(PAIR[:1], FIRST, K)
    content = with_entry(content, ("boxes", 0, "outer"), [hex(CORE if n == place else 1 << 44) for n in range(4)])
    path = ("boxes", 0, "quaternion", 3) if place == 1 else ("boxes", 0, "centroid", 1)
    ends = list(map(Fraction, at(content, path)))
    ends[end] += (2 * end - 1) * Fraction(1 << 36, 1 << K)
    return with_entry(content, path, list(map(str, ends)))


def _as_far() -> Content:
    """Bounds of the pose that reach as far as the outer box, and not beyond."""
    content = around([Pose((1, 0, 0, 0), (0, 0, 0, 0))], FIRST, K)
    least = 1 - Fraction(1, 1 << 10)
    most = least / (1 << 11)
    content = with_entry(content, ("boxes", 0, "quaternion", 0), [str(least), str(1 + Fraction(1, 1 << 30))])
    content = with_entry(content, ("boxes", 0, "quaternion", 3), [str(-most), str(most)])
    return with_entry(content, ("boxes", 0, "outer"), [hex(1 << K - 9), hex(1 << K - 11), *[hex(1 << K - 8)] * 2])


def _nearly_singular(k: int, bits: int) -> Content:
    """Three legs whose lines meet in a point but for 2^-bits: so large is the inverse of the Jacobian."""
    pose = Pose((1, 0, 0, 0), (0, 0, 0, 0))
    joints = ((3, 0), (1, 0)), ((0, -2), (0, 1)), ((-4, -8), (1, 2 + Fraction(1, 1 << bits)))
    legs = [pose.distance((*a, 0), (*b, 0)) for a, b in joints]
    content = around([pose], FIRST, k)
    content["robot"]["base"] = [[str(x) for x in leg.base] for leg in legs]
    content["robot"]["platform"] = [[str(x) for x in leg.platform] for leg in legs]
    content["configuration"] = {"name": None, "lengths_squared": [str(leg.length_squared) for leg in legs]}
    return content


BOUNDS: dict[str, Case] = {
    "a Jacobian whose inverse has 560 bits, on the grid 2^-1200": (partial(_nearly_singular, 1200, 560), ACCEPTED),
    "a quaternion whose first coordinate may be 0": (partial(_ends, "0", "1"), REJECTED),
    **{
        f"bounds that reach too far at end {end} of coordinate {place}": (partial(_beyond, place, end), REJECTED)
        for place in (1, 3)
        for end in (0, 1)
    },
}


def _large_coordinates(bits: int, k: int) -> Content:
    """e0 + e3 is 1, and both are so long: leg forms have products twice as long, and bounds must be as fine."""
    large = 1 << bits
    content = around([Pose((large, 0, 0, 1 - large), (0, 3 * large, 1 - 5 * large, 0))], (1, 0, 0, 1), k)
    family = pure.Family(pure.read_tolerances(content), 8 * bits + 3 * k)
    centre = [family.rectangle((int(re, 16), int(im, 16)), k).re for re, im in content["boxes"][0]["centre"]]
    unit = family.p - 2 * bits - k
    ends = [
        [str(Fraction((part >> unit) + more, 1 << 2 * bits + k)) for part, more in ((v.low, -1), (v.high, 2))]
        for v in pure.components(family, centre)[0]
    ]
    bounds = {"position": ends[:3], "rotation": [ends[3:6], ends[6:9], ends[9:12]]}
    bounds |= {"quaternion": ends[12:16], "centroid": ends[16:]}
    return content | {"boxes": [content["boxes"][0] | bounds]}


AS_FAR: dict[str, Callable[[], Content]] = {"bounds that reach as far as the outer box": _as_far}
"""What the plain checker proves in intervals, where balls are too wide."""


# Complex solutions as real ones


def _sideways(height: int) -> Content:
    """The pose of a platform whose legs have their lengths at (1, i height), in its first orientation."""
    joints = (((1, 0, 0), (0, 0, 0)), ((2, 3, 0), (0, 3, 0)), ((-3, 5, 0), (0, 5, 0)))
    content = around([Pose((1, 0, 0, 0), (0, 1, 0, 0))], FIRST, K)
    content["robot"]["platform"] = [[str(x) for x in b] for b, _ in joints]
    content["robot"]["base"] = [[str(x) for x in a] for _, a in joints]
    squares = [str((1 + b[0]) ** 2 - height**2) for b, _ in joints]
    content["configuration"] = {"name": None, "lengths_squared": squares}
    return with_entry(content, ("boxes", 0, "centre", 3), ["0x0", hex(height << K)])


def _half_turned(weight: int) -> Content:
    """A half turn, e = (0, 0, 0, 1), in a chart with this imaginary part of the first weight."""
    content = around([Pose((0, 0, 0, 1), (0, 1, 2, 0))], (0, 0, 0, 1), K)
    return with_entry(content, ("boxes", 0, "chart", 0), [1, weight])


REAL: dict[str, Case] = {
    "a solution that is real but for its last coordinate": (partial(_sideways, 1), REJECTED),
    **{
        f"a chart with the imaginary part {weight} where the pose is 0": (partial(_half_turned, weight), status)
        for weight, status in ((0, ACCEPTED), (1, REJECTED))
    },
}


# All solutions of a planar robot, in charts of one's own


def own(name: str = COMPLETE) -> Content:
    """A certificate to be changed."""
    return {key: value for key, value in subject(name).items() if key != "digest"}


@cache
def solution(kind: str, place: int) -> tuple[pure.Gaussian, ...]:
    """One of the solutions of ``COMPLETE``, to about 300 bits, with e0 = 1."""
    content = own()
    read = pure.read_tolerances(content)
    (base, platform), unit = read.origins, read.unit
    legs = [
        pure.Leg(_moved(leg.base, base, unit), _moved(leg.platform, platform, unit), leg.length_squared / unit**2)
        for leg in read.legs
    ]
    system = pure.chart_system(legs, pure.ORDINARY, FIRST)
    centre = (read.boxes[place].place if kind == "boxes" else read.pairs[place]).centre
    x = [pure.Gaussian(Fraction(re, 1 << read.exponent), Fraction(im, 1 << read.exponent)) for re, im in centre]
    x = [value * inverse(x[0]) for value in x]
    for _ in range(3):
        slopes = system.slopes(x)
        values = system.values(x, slopes)
        steps = [pure.total(a * b for a, b in zip(row, values, strict=True)) for row in pure.near_inverse(slopes, 600)]
        x = [(a - step).rounded(400) for a, step in zip(x, steps, strict=True)]
    return tuple(x)


def _moved(point: Sequence[Fraction], origin: Sequence[Fraction], unit: Fraction) -> Any:
    return tuple((x - m) / unit for x, m in zip(point, origin, strict=True))


def inverse(z: pure.Gaussian) -> pure.Gaussian:
    """1 / z."""
    size = z.re * z.re + z.im * z.im
    return pure.Gaussian(z.re / size, -z.im / size)


def in_chart(x: Sequence[pure.Gaussian], chart: Sequence[Sequence[int]], k: int) -> Content:
    """Where a solution is in a chart, on the grid 2^-k."""
    weights = [pure.Gaussian(Fraction(re), Fraction(im)) for re, im in (chart[0], chart[3])]
    scale = inverse(weights[0] * x[0] + weights[1] * x[1])
    centre = [value * scale for value in x]
    return {
        "chart": [list(pair) for pair in chart],
        "centre": [[hex(round(part * (1 << k))) for part in (value.re, value.im)] for value in centre],
    }


def fitted(content: Content, place: Content) -> Content:
    """With an outer box that is mapped into itself for every robot within tolerance, and wider by an eighth."""
    k = content["exponent"]
    core = 1 << k - k // 2
    family = pure.Family(pure.read_tolerances(content), k + k // 2 + pure.GUARD)
    found = pure.a_place((place["chart"], place["centre"], [hex(core)] * 4), "pair", 4)
    here = pure.Neighbourhood(family, found, k)
    outer = [core] * 4
    for _ in range(4):
        outer = [max(w + (w >> 3), core) for w in here.reached(here.image(outer, uncertain=True))]
    return place | {"outer": [hex(width) for width in outer]}


UPRIGHT = (-146329, 130625), (0, 0), (0, 0), (170422, 216236)
"""A chart in which N(e) is imaginary at the first pair, but for a part of 10^-21."""


def _with_pairs(*pairs: Content) -> Content:
    """Other pairs, in their order."""
    order = sorted(pairs, key=lambda pair: (pair["chart"], [[int(x, 16) for x in part] for part in pair["centre"]]))
    return own() | {"pairs": order}


def _upright() -> Content:
    """One of the pairs in the chart above."""
    content = own()
    place = in_chart(solution("pairs", 0), UPRIGHT, content["exponent"])
    return _with_pairs(fitted(content, place), content["pairs"][1])


def _conjugate_twice(place: int) -> Content:
    """A pair and the conjugate one in place of the other."""
    pair = own()["pairs"][place]
    chart = [[re, -im] for re, im in pair["chart"]]
    centre = [[re, hex(-int(im, 16))] for re, im in pair["centre"]]
    return _with_pairs(pair, pair | {"chart": chart, "centre": centre})


def _turned_conjugate(place: int) -> Content:
    """The same in the chart (1 + i) w: its quantities are conjugate numbers times -i/2, with other real parts."""
    content = own()
    pair = content["pairs"][place]
    conjugate = [pure.Gaussian(value.re, -value.im) for value in solution("pairs", place)]
    chart = [[re + im, re - im] for re, im in pair["chart"]]
    return _with_pairs(pair, fitted(content, in_chart(conjugate, chart, content["exponent"])))


def _off(part: int) -> Content:
    """The last coordinate of a pair is one unit of the grid away."""
    content = own()
    path = ("pairs", 1, "centre", 3, part)
    return with_entry(content, path, hex(int(at(content, path), 16) + 1))


def _outer(pair: int, coordinate: int | None, factor: Fraction) -> Content:
    """An outer box as wide in one coordinate, or in all, as a part of what it was, or as the core."""
    content = own()
    k = content["exponent"]
    widths = [int(text, 16) for text in content["pairs"][pair]["outer"]]
    changed = [max(int(w * factor), 1 << k - k // 2) if coordinate in (None, n) else w for n, w in enumerate(widths)]
    return with_entry(content, ("pairs", pair, "outer"), [hex(width) for width in changed])


ALL: dict[str, Case] = {
    "N(e) is imaginary": (_upright, ACCEPTED),
    **{f"pair {place} and its conjugate": (partial(_conjugate_twice, place), REJECTED) for place in (0, 1)},
    **{
        f"pair {place} and its conjugate in another chart": (partial(_turned_conjugate, place), REJECTED)
        for place in (0, 1)
    },
    **{f"part {part} of the last coordinate is off": (partial(_off, part), REJECTED) for part in (0, 1)},
    "the outer box of a pair is narrower than imaginary parts of the image": (
        partial(_outer, 0, 3, Fraction(873, 1000)),
        REJECTED,
    ),
    "the outer box of a pair is as wide as the core": (partial(_outer, 0, None, Fraction(0)), REJECTED),
}

# Real poses


def _one_sided(sign: int) -> Content:
    """The last coordinate of the pose is 2/5 of a unit from the centre, and changes by 3/4 within tolerance."""
    offset = sign * Fraction(2, 5) / (1 << K)
    pose = Pose((2, 0, 0, 1), (0, 1, 2 * (3 + offset), 0))
    content = around([pose], FIRST, K, 0, floor if sign > 0 else ceil)
    content["tolerances"]["lengths"] = str(Fraction(1, 1 << 66))
    return with_entry(content, ("boxes", 0, "inner"), [hex(64), hex(64), hex(64), hex(1)])


def _weighted(place: int) -> Content:
    """One of two planar boxes in a chart with a weight for e1."""
    content = around([PAIR[0]], FIRST, K)
    boxes = [{**content["boxes"][0], "pose": number} for number in (1, 2)]
    return with_entry(content | {"boxes": boxes}, ("boxes", place, "chart", 1, 0), 1)


THREE = (
    Pose((3, 1, 0, 0), (0, 0, 1, 4)),
    Pose((4, 0, 1, 1), (-1, 2, -3, 7)),
    Pose((5, -1, 2, 0), (0, -2, -1, 6)),
)
FLAT = ((1, 2), (-3, 1), (2, -5), (4, 1), (0, 3), (-2, -4))


def _six() -> Content:
    """A robot with six legs between two planes, at three poses and their mirror images, called all."""
    mirrored = [Pose((e[0], -e[1], -e[2], e[3]), (-f[0], f[1], f[2], -f[3])) for e, f in ((p.e, p.f) for p in THREE)]
    alone = [around([pose], FIRST, K, 2) for pose in (*THREE, *mirrored)]
    legs = []
    for b in FLAT:
        places = [pose.image((*b, 0)) for pose in THREE]
        squares = [sum((x * x for x in point), Fraction(0)) for point in places]
        (a, b_, c), (d, e, f) = (
            (places[k][0] - places[0][0], places[k][1] - places[0][1], (squares[k] - squares[0]) / 2) for k in (1, 2)
        )
        centre = (c * e - b_ * f) / (a * e - b_ * d), (a * f - c * d) / (a * e - b_ * d)
        legs.append(THREE[0].distance((*centre, 0), (*b, 0)))
    boxes = [{**content["boxes"][0], "pose": number} for number, content in enumerate(alone, 1)]
    content = alone[0] | {"boxes": boxes, "complete": True}
    content["robot"]["base"] = [[str(x) for x in leg.base] for leg in legs]
    content["robot"]["platform"] = [[str(x) for x in leg.platform] for leg in legs]
    content["configuration"] = {"name": None, "lengths_squared": [str(leg.length_squared) for leg in legs]}
    return content


SHRUNK = 0x21CF50089D6F3D2B
"""An outer box so many times 2^-60 as wide is proved to hold one pose by a box that is narrower in all eight steps."""
MORE = 304097366140463464190574305376428333802828573538636830670962943988
"""With a tolerance of lengths that is greater by this part of 2^-283, but not with the next one."""


def _shrunk(more: int) -> Content:
    """An outer box that the plain checker hardly shrinks until it is proved to hold one pose."""
    content = {**limit("tight-tolerance-planar")}
    limits = content["tolerances"]
    lengths = Fraction(limits["lengths"]) + Fraction(MORE + more, 1 << 283)
    content["tolerances"] = {**limits, "lengths": str(lengths)}
    widths = [floor(int(x, 16) * Fraction(SHRUNK, 1 << 60)) for x in content["boxes"][0]["outer"]]
    return with_entry(content, ("boxes", 0, "outer"), [hex(width) for width in widths])


def _turned_about(width: Fraction) -> Content:
    """Joints on lines through the origin, about which the platform turns by tan(angle / 2) = 20 or -20: e0 = 1/20.

    The Jacobian is linear in e0 in its first column alone: it is 0 where e0 is.
    """
    pose = Pose((1, 0, 0, 20), (0, 0, 0, 0))
    legs = [pose.distance([k * x for x in b], b) for k, b in ((2, (1, 2, 0)), (-1, (-3, 1, 0)), (3, (2, -5, 0)))]
    content = around([pose], (0, 0, 0, 1), K)
    content["robot"]["base"] = [[str(x) for x in leg.base] for leg in legs]
    content["robot"]["platform"] = [[str(x) for x in leg.platform] for leg in legs]
    content["configuration"] = {"name": None, "lengths_squared": [str(leg.length_squared) for leg in legs]}
    return with_entry(content, ("boxes", 0, "outer"), [hex(int(width * (1 << K))), *[hex(CORE)] * 3])


POSES: dict[str, Case] = {
    **{
        f"an inner box narrower than the image on side {sign} alone": (partial(_one_sided, sign), REJECTED)
        for sign in (1, -1)
    },
    **{f"a chart with a weight for e1, box {place}": (partial(_weighted, place), "malformed") for place in (0, 1)},
    "six poses of six legs, called all": (_six, REJECTED),
    "Study coordinates of 120 bits": (partial(_large_coordinates, 120, 24), ACCEPTED),
    **{
        f"an outer box of a half width of {width} in e0, another solution is 1/10 away": (
            partial(_turned_about, width),
            status,
        )
        for width, status in ((Fraction(1, 20), ACCEPTED), (Fraction(21, 200), REJECTED))
    },
    **{
        f"{coordinate} is {sign} (1/2 + {parts} 2^-20) units from the centre": (
            partial(_off_centre, coordinate, parts, sign),
            REJECTED,
        )
        for coordinate, more in (("e0", 45), ("f2", 49))
        for sign in (1, -1)
        for parts in (Fraction(1), 1 + Fraction(1, 1 << more))
    },
}
CONJUGATES: dict[str, Case] = {**BOUNDS, **REAL, **ALL, **POSES}


def _narrower(place: int, end: int) -> Content:
    """A coordinate of the quaternion narrower, by one unit of its last place, than what the plain checker proves."""
    content = limit("exact-tolerance-planar")
    bound = Fraction(content["boxes"][0]["quaternion"][place][end])
    unit = Fraction(1 - 2 * end, bound.denominator)
    return with_entry(content, ("boxes", 0, "quaternion", place, end), str(bound + unit))


ANGLE = 462243512231002560884752346611459977816146043706547703856681032045417059208983911731
"""How many times 2^-283 the rotation error is, where the sine of a quarter of it is half of the chord exactly."""


def _turned_by(angle: int) -> Content:
    """A tolerance of lengths that is less by 2^-282, for which the bound of the chord is an even number of units."""
    content = limit("exact-tolerance-planar")
    lengths = Fraction(content["tolerances"]["lengths"]) - Fraction(1, 1 << 282)
    content = content | {"tolerances": content["tolerances"] | {"lengths": str(lengths)}}
    return with_entry(content, ("boxes", 0, "rotation_error"), str(Fraction(angle, 1 << 283)))


PLAIN_ENDS: dict[str, Case] = {
    **{
        f"a rotation error {less} units less than one that is proved": (partial(_turned_by, ANGLE - less), status)
        for less, status in ((0, ACCEPTED), (1, REJECTED))
    },
    **{
        f"coordinate {place} of a quaternion hardly narrower than is proved": (partial(_narrower, place, end), REJECTED)
        for place, end in ((0, 0), (3, 1))
    },
    **{
        f"an outer box that is hardly shrunk, {more} units more": (partial(_shrunk, more), status)
        for more, status in ((0, ACCEPTED), (1, REJECTED))
    },
    "f2 is hardly less than the limit from the centre": (
        partial(_off_centre, "f2", 1 - Fraction(12, 10**14), 1),
        ACCEPTED,
    ),
}
"""The last that the plain checker proves; the other one has limits of its own."""
