"""Robots that are nearly degenerate, each solved by both methods: both checkers must accept what is written.

``make campaign`` solves 1,000 planar and 300 spatial ones. A journal in build/campaign keeps what is done: a run that
is killed goes on where it was. The tests run a few of them. What a robot is follows from its name alone.

Near what? Two joints that coincide, joints on a line, base and platform that are similar or congruent, legs of one
length, and a pose at which the legs lose control. Then some numbers are changed by 1e-11 to 1e-60, the platform may be
1e-5 of the base, and all of it is scaled by 1e-9 to 1e9.
"""

from __future__ import annotations

import argparse
import json
import multiprocessing
import sys
import time
import traceback
from collections import Counter
from collections.abc import Callable, Iterator, Sequence
from contextlib import suppress
from dataclasses import asdict, dataclass
from fractions import Fraction
from multiprocessing.connection import Connection
from pathlib import Path
from random import Random

from pkm_exact import PkmExactError, solve, solve_krawczyk
from pkm_exact.certify import pure
from pkm_exact.certify.build import certificate_bytes
from pkm_exact.certify.check import check_bytes
from pkm_exact.geometry.reader import robot_from_toml
from pkm_exact.geometry.robot import Robot

FAMILIES = {"planar": 1000, "spatial": 300}
METHODS = {"exact": solve, "krawczyk": solve_krawczyk}
SHARE = 50
"""The tests take one robot of so many."""
LIMIT = 1800
"""Seconds after which a robot counts as a hang."""
BUILD = Path(__file__).parent.parent / "build" / "campaign"

Point = tuple[Fraction, ...]


@dataclass(frozen=True)
class Joints:
    """A robot before it is written down: joints of base and platform, and squared lengths of the legs."""

    base: list[Point]
    platform: list[Point]
    squares: list[Fraction]


@dataclass(frozen=True)
class Outcome:
    """What became of one robot by one method; ``failure`` is empty if all is well."""

    robot: str
    method: str
    answer: str
    failure: str
    seconds: float


def model(name: str) -> str:
    """The model file of a robot of the campaign, such as "planar-17"."""
    family, _, _ = name.partition("-")
    random = Random(name)
    dimension, legs = (2, 3) if family == "planar" else (3, 6)
    joints = _degenerate(random, dimension, legs)
    while len(set(zip(joints.base, joints.platform, strict=True))) < legs:  # no model: two legs are one
        joints = _degenerate(random, dimension, legs)
    joints = _changed(random, joints, 4 if family == "planar" else 2)
    metric = random.choice(["", "", f"metric = {[1, 3, 1][:dimension]}\n"])
    return "\n".join(
        (
            f'schema = 1\nname = "{name}"\nkind = "{"3-RPR" if dimension == 2 else "6-UPS"}"\nunit = "1"',
            f'source = "made at random, nearly degenerate"\n{metric}[base]\njoints = {_rows(joints.base)}',
            f'[platform]\njoints = {_rows(joints.platform)}\n[[configurations]]\nname = "home"',
            f"lengths_squared = {_texts(joints.squares)}\n",
        )
    )


def _texts(values: Sequence[Fraction]) -> str:
    return json.dumps([str(value) for value in values])


def _rows(points: Sequence[Point]) -> str:
    return f"[{', '.join(map(_texts, points))}]"


def _degenerate(random: Random, dimension: int, legs: int) -> Joints:
    """A robot of small numbers with something special, in a pose with small numbers."""
    small = Fraction(1, 10**5) if random.random() < 1 / 4 else Fraction(1)
    base, platform = ([_point(random, dimension) for _ in range(legs)] for _ in range(2))
    special = random.choice(["generic", "coincident", "line", "similar", "congruent", "singular", "singular"])
    if special in ("similar", "congruent"):
        factor = random.randint(1, 4) if special == "similar" else 1
        platform = [tuple(x / factor for x in point) for point in base]
    for points in random.sample([base, platform], random.randint(1, 2)):
        if special == "coincident":
            points[1] = points[0]
        elif special == "line":
            a, d = points[0], _point(random, dimension)
            points[:] = [tuple(x + k * y for x, y in zip(a, d, strict=True)) for k in range(legs)]
    platform = [tuple(x * small for x in point) for point in platform]
    rotation, position = _rotation(random, dimension), _point(random, dimension)
    places = [_sum(position, _turned(rotation, point)) for point in platform]
    if special == "singular":
        base = _on_lines(random, places)
    squares = [
        sum(((x - y) ** 2 for x, y in zip(a, b, strict=True)), Fraction(0)) for a, b in zip(base, places, strict=True)
    ]
    if random.random() < 1 / 4:
        squares = [squares[0] or Fraction(1)] * legs
    return Joints(base, platform, [square or Fraction(random.randint(1, 9)) for square in squares])


def _point(random: Random, dimension: int) -> Point:
    return tuple(Fraction(random.randint(-5, 5)) for _ in range(dimension))


def _sum(left: Point, right: Point) -> Point:
    return tuple(x + y for x, y in zip(left, right, strict=True))


def _turned(rotation: Sequence[Point], point: Point) -> Point:
    return tuple(sum((r * x for r, x in zip(row, point, strict=True)), Fraction(0)) for row in rotation)


def _rotation(random: Random, dimension: int) -> list[Point]:
    """Of an integer quaternion; about the third axis in the plane."""
    w, x, y, z = (Fraction(random.randint(-2, 2)) for _ in range(4))
    if dimension == 2:
        x = y = Fraction(0)
    w = w if any((w, x, y, z)) else Fraction(1)
    n = w * w + x * x + y * y + z * z
    rows = (
        (w * w + x * x - y * y - z * z, 2 * (x * y - w * z), 2 * (x * z + w * y)),
        (2 * (x * y + w * z), w * w - x * x + y * y - z * z, 2 * (y * z - w * x)),
        (2 * (x * z - w * y), 2 * (y * z + w * x), w * w - x * x - y * y + z * z),
    )
    return [tuple(value / n for value in row[:dimension]) for row in rows[:dimension]]


def _on_lines(random: Random, places: Sequence[Point]) -> list[Point]:
    """Base joints such that all leg lines meet one line, or in the plane one point: the pose is singular."""
    dimension = len(places[0])
    foot, direction = _point(random, dimension), _point(random, dimension)
    base = []
    for number, place in enumerate(places):
        meet = foot if dimension == 2 else tuple(a + number * d for a, d in zip(foot, direction, strict=True))
        stretch = random.choice([-2, -1, 2, 3])
        base.append(tuple(p + stretch * (m - p) for p, m in zip(place, meet, strict=True)))
    return base


def _changed(random: Random, joints: Joints, most: int) -> Joints:
    """Some numbers changed by very little, and all of it scaled."""
    points = [*map(list, joints.base), *map(list, joints.platform)]
    squares = list(joints.squares)
    step = Fraction(1, 10 ** random.randint(11, 60))
    for _ in range(random.randint(1, most)):
        change = random.choice([-2, -1, 1, 2]) * step
        if random.random() < 1 / 2:
            point = random.choice(points)
            point[random.randrange(len(point))] += change
        else:
            squares[random.randrange(len(squares))] += change
    scale = Fraction(10) ** random.choice([0, 0, *range(-9, 10)])
    scaled = [tuple(x * scale for x in point) for point in points]
    legs = len(squares)
    return Joints(scaled[:legs], scaled[legs:], [abs(square) * scale**2 for square in squares])


def tried(name: str, method: str) -> Outcome:
    """Solve a robot, write its certificate, and check it twice."""
    start = time.perf_counter()
    answer = failure = ""
    try:
        robot = robot_from_toml(model(name))
        assert isinstance(robot, Robot)
        solution = METHODS[method](robot.problem(robot.configuration()))
        counts = f"{solution.complex_solutions}/{solution.distinct_solutions}/{len(solution.poses)}"
        answer = f"{solution.claim} {counts}"
        failure = refusal(certificate_bytes(robot, "home", solution))
    except PkmExactError as error:
        failure = f"no answer: {type(error).__name__}: {error}"
    except Exception:
        failure = traceback.format_exc(limit=-3)
    return Outcome(name, method, answer, failure, round(time.perf_counter() - start, 1))


def refusal(data: bytes) -> str:
    """Why a certificate is not accepted by both checkers with the same lines; empty if it is."""
    one, other = check_bytes(data), pure.check_bytes(data)
    if str(one.status) != "accepted":
        return f"the checker: {one.status}: {one.lines[-1]}"
    if other.status != "accepted":
        return f"the plain checker: {other.status}: {other.lines[-1]}"
    return "" if one.lines == other.lines else f"verdicts differ: {one.lines} {other.lines}"


def names(share: int = 1) -> list[str]:
    """The robots of the campaign, planar and spatial ones mixed; one of ``share`` of each family."""
    chosen = [(k / count, f"{family}-{k}") for family, count in FAMILIES.items() for k in range(0, count, share)]
    return [name for _, name in sorted(chosen)]


def journal(path: Path) -> list[Outcome]:
    """What a journal has; a line that a killed run left unfinished is removed from it."""
    if not path.exists():
        return []
    whole, _, torn = path.read_text(encoding="utf-8").rpartition("\n")
    if torn:
        path.write_text(f"{whole}\n" if whole else "", encoding="utf-8")
    return [Outcome(**json.loads(line)) for line in whole.splitlines()]


def _serve(pipe: Connection) -> None:
    """A worker: gets a name and a method, answers with the outcome."""
    with suppress(EOFError, BrokenPipeError):  # the campaign has ended
        while True:
            pipe.send(tried(*pipe.recv()))


class Worker:
    """A process that tries robots, and is ended if one of them takes too long."""

    def __init__(self, limit: float) -> None:
        self.limit = limit
        self.process: multiprocessing.process.BaseProcess | None = None

    def __call__(self, name: str, method: str) -> Outcome:
        """The outcome, or that there was none in time."""
        if self.process is None:
            context = multiprocessing.get_context("spawn")
            self.pipe, end = context.Pipe()
            self.process = context.Process(target=_serve, args=(end,), daemon=True)
            self.process.start()
            end.close()
        start = time.perf_counter()
        self.pipe.send((name, method))
        failure = f"no end within {self.limit:.0f} seconds"
        try:
            if self.pipe.poll(self.limit):
                found: Outcome = self.pipe.recv()
                return found
        except EOFError:
            failure = "the process died"
        self.process.kill()
        self.process = None
        return Outcome(name, method, "", failure, round(time.perf_counter() - start, 1))


def todo(chosen: Sequence[str], done: Sequence[Outcome]) -> Iterator[tuple[str, str]]:
    """Robots and methods that are not done."""
    known = {(outcome.robot, outcome.method) for outcome in done}
    return ((name, method) for name in chosen for method in METHODS if (name, method) not in known)


def run(
    path: Path, chosen: Sequence[str], attempt: Callable[[str, str], Outcome], *, again: bool = False
) -> list[Outcome]:
    """Go on with a campaign; every outcome is in the journal before the next robot is tried."""
    done = journal(path)
    if again:
        done = [outcome for outcome in done if not outcome.failure]
        lines = [json.dumps(asdict(outcome)) + "\n" for outcome in done]
        path.parent.mkdir(parents=True, exist_ok=True)
        path.write_text("".join(lines), encoding="utf-8")
    path.parent.mkdir(parents=True, exist_ok=True)
    for name, method in list(todo(chosen, done)):
        outcome = attempt(name, method)
        with path.open("a", encoding="utf-8") as file:
            file.write(json.dumps(asdict(outcome)) + "\n")
        done.append(outcome)
        if outcome.failure:
            print(f"\r{name} {method} {outcome.answer}: {outcome.failure}", flush=True)
        if sys.stderr.isatty():
            print(f"\r{len(done)} of {len(chosen) * len(METHODS)} ", end="", file=sys.stderr, flush=True)
    return done


def disagreements(done: Sequence[Outcome]) -> list[str]:
    """Robots of which the two methods say different things."""
    answers: dict[str, set[str]] = {}
    for outcome in done:
        if outcome.answer:
            answers.setdefault(outcome.robot, set()).add(outcome.answer)
    return [f"{name}: {' and '.join(sorted(found))}" for name, found in answers.items() if len(found) > 1]


def summary(done: Sequence[Outcome]) -> str:
    """Numbers of a campaign."""
    lines = []
    for method in METHODS:
        found = [outcome for outcome in done if outcome.method == method]
        claims = Counter(outcome.answer.partition(" ")[0] or "none" for outcome in found)
        failures = sum(bool(outcome.failure) for outcome in found)
        words = ", ".join(f"{claim} {count}" for claim, count in claims.most_common())
        seconds = sum(outcome.seconds for outcome in found)
        lines.append(f"{method}: {len(found)} robots, {failures} failures; {words}; {seconds:.0f} s")
    return "\n".join([*lines, *disagreements(done)])


def main(words: Sequence[str]) -> int:
    """Run the campaign, or go on with it; 1 if anything failed."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--share", type=int, default=1, help="one robot of so many")
    parser.add_argument("--again", action="store_true", help="try those again that failed")
    parser.add_argument("--limit", type=float, default=LIMIT, help="seconds for a robot and a method")
    parser.add_argument("--show", metavar="ROBOT", help="print the model file of a robot and end")
    options = parser.parse_args(words)
    if options.show:
        print(model(options.show))
        return 0
    done = run(BUILD / "journal.jsonl", names(options.share), Worker(options.limit), again=options.again)
    print(summary(done))
    return 1 if disagreements(done) or any(outcome.failure for outcome in done) else 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
