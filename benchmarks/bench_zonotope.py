"""Wrench polytopes of cables: facets and vertices of zonotopes, beside PPL and Normaliz where they are installed.

Everyone gets the same integers and gives all facets and all vertices, exactly; the answers are compared. PPL and
Normaliz know no zonotopes: they get the 2^m sums of the generators. ``pip install pplpy PyNormaliz`` installs both.
"""

from __future__ import annotations

import argparse
import json
import os
import sys
from collections.abc import Callable
from fractions import Fraction
from importlib.metadata import PackageNotFoundError, version
from itertools import product
from math import gcd
from pathlib import Path
from random import Random
from statistics import median
from time import process_time
from typing import Any, TypeAlias

from pkm_exact.polytopes.zonotope import Zonotope

SIZES = ((3, 6), (4, 7), (6, 8))
"""Dimensions and generators: planar machines with more cables than needed, and eight cables in space."""
PART = 0.1
"""Part of the others' time that eight cables may take: facets and vertices, and their comparable form."""
Vector: TypeAlias = tuple[int, ...]
Answer: TypeAlias = tuple[set[tuple[Vector, int]], set[Vector]]
"""Facets, normal.x <= offset with primitive integers, and vertices."""


def main() -> int:
    """Measure, print a Markdown table, and tell by the exit code whether answers agree and the limit is kept."""
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--runs", type=int, default=7, help="runs of each (default 7)")
    parser.add_argument("--json", type=Path, metavar="FILE", help="write the times to FILE as well")
    arguments = parser.parse_args()
    contenders = {"pkm_exact": by_us, "facets alone": facets_alone, **others()}
    rows = [row_of(dimension, count, contenders, arguments.runs) for dimension, count in SIZES]
    titles = [f"{name} {version(PACKAGES[name])}, ms" if name in PACKAGES else name for name in contenders]
    print(f"| generators | facets | vertices | {' | '.join(titles)} |\n|---{'|---' * (2 + len(titles))}|")
    for row in rows:
        times = " | ".join(f"{1000 * row['seconds'][name]:.1f}" for name in contenders)
        print(f"| {row['generators']} in {row['dimension']} | {row['facets']} | {row['vertices']} | {times} |")
    missing = [name for name in PACKAGES if name not in contenders]
    if missing:
        print(f"not installed: {', '.join(missing)}", file=sys.stderr)
    if arguments.json is not None:
        arguments.json.write_text(json.dumps(rows, indent=1) + "\n")
    own, _, *theirs = rows[-1]["seconds"].values()
    bad = [f"{row['generators']} generators: answers differ" for row in rows if not row["agree"]]
    bad += [f"more than {PART} of another's time"] if any(own > PART * other for other in theirs) else []
    print("\n".join(bad), file=sys.stderr, end="\n" if bad else "")
    return 1 if bad else 0


PACKAGES = {"pkm_exact": "pkm_exact", "PPL": "pplpy", "Normaliz": "PyNormaliz"}


def others() -> dict[str, Callable[[list[Vector]], Answer]]:
    """Those that are installed."""
    found = {}
    for name, solve in (("PPL", by_ppl), ("Normaliz", by_normaliz)):
        try:
            version(PACKAGES[name])
        except PackageNotFoundError:
            continue
        found[name] = solve
    return found


def row_of(
    dimension: int, count: int, contenders: dict[str, Callable[[list[Vector]], Answer]], runs: int
) -> dict[str, Any]:
    """Times of all, in turn, and whether they say the same."""
    random = Random(count)
    generators = [tuple(random.randint(-1000, 1000) for _ in range(dimension)) for _ in range(count)]
    times: dict[str, list[float]] = {name: [] for name in contenders}
    answers = {}
    for _ in range(runs):
        for name, solve in contenders.items():
            begin = process_time()
            found = solve(generators)
            times[name].append(process_time() - begin)
            answers[name] = found
    facets, vertices = answers["pkm_exact"]
    return {
        "dimension": dimension,
        "generators": count,
        "facets": len(facets),
        "vertices": len(vertices),
        "seconds": {name: median(each) for name, each in times.items()},
        "agree": all(answer in ((facets, vertices), (facets, set())) for answer in answers.values()),
    }


def by_us(generators: list[Vector]) -> Answer:
    """By shifting hyperplanes: sums of generators with coefficients from 0 to 1."""
    found = zonotope(generators)
    return facets_of(found), set(found.vertices)


def facets_alone(generators: list[Vector]) -> Answer:
    """The same without the vertices: enough to tell which loads can be borne."""
    return facets_of(zonotope(generators)), set()


def zonotope(generators: list[Vector]) -> Zonotope:
    """A new one, of which nothing is known yet."""
    count, dimension = len(generators), len(generators[0])
    one, zero = Fraction(1), Fraction(0)
    return Zonotope(tuple(generators), (one,) * count, (zero,) * count, (one,) * count, (one,) * dimension)


def facets_of(found: Zonotope) -> set[tuple[Vector, int]]:
    """Its facets, comparable."""
    return {primitive([*normal, offset]) for normal, offset in found.facets}


def sums(generators: list[Vector]) -> list[Vector]:
    """All of which the zonotope is the convex hull."""
    choices = product((0, 1), repeat=len(generators))
    return [tuple(sum(e * x for e, x in zip(ends, column)) for column in zip(*generators)) for ends in choices]  # noqa: B905


def primitive(numbers: list[int]) -> tuple[Vector, int]:
    """A facet with coprime integers."""
    divisor = gcd(*numbers)
    *normal, offset = (number // divisor for number in numbers)
    return tuple(normal), offset


def by_ppl(generators: list[Vector]) -> Answer:
    """The double description of the Parma Polyhedra Library."""
    import ppl

    dimension = len(generators[0])
    system = ppl.Generator_System()
    for total in sums(generators):
        expression = ppl.Linear_Expression(list(total), 0)
        system.insert(ppl.point(expression))
    polyhedron = ppl.C_Polyhedron(system)
    facets = {
        primitive([*(-int(c.coefficient(ppl.Variable(j))) for j in range(dimension)), int(c.inhomogeneous_term())])
        for c in polyhedron.minimized_constraints()
    }
    vertices = {
        tuple(int(g.coefficient(ppl.Variable(j))) // int(g.divisor()) for j in range(dimension))
        for g in polyhedron.minimized_generators()
    }
    return facets, vertices


def by_normaliz(generators: list[Vector]) -> Answer:
    """The cone over it, by Normaliz; asked for the two lists alone, as its defaults ask for lattice points as well."""
    os.environ.setdefault("OMP_NUM_THREADS", "1")  # threads cost it more than they gain, on cores that others use
    import PyNormaliz

    cone = PyNormaliz.NmzCone(cone=[[*total, 1] for total in sums(generators)])
    PyNormaliz.NmzCompute(cone, ["SupportHyperplanes", "ExtremeRays"])
    rows, rays = (PyNormaliz.NmzResult(cone, name) for name in ("SupportHyperplanes", "ExtremeRays"))
    facets = {primitive([*(-int(x) for x in row[:-1]), int(row[-1])]) for row in rows}
    return facets, {tuple(int(x) // int(ray[-1]) for x in ray[:-1]) for ray in rays}


if __name__ == "__main__":
    sys.exit(main())
