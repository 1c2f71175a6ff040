# %% [markdown]
# # Which wrenches can planar machines exert?
#
# Chapter 6 of *Parallel Manipulators: Towards New Applications* (2008) compares planar machines with three and four
# legs, and with one or both joints of a leg driven, by polytopes of wrenches and six indices of them. *Which of its
# statements hold, if polytopes are exact?* Its table 4 is reproduced by the tests on a grid of one millimetre (94 of 96
# numbers; 63.23 must be 62.23, and 55.75 must be 59.75); here are the statements.

# %%
from fractions import Fraction
from math import sqrt

import matplotlib.pyplot as plt
import numpy as np

from pkm_exact.polytopes.zonotope import Zonotope
from pkm_exact.radicals import RootSum
from pkm_exact.statics.interval_arrays import Intervals
from pkm_exact.statics.planar_leg_wrenches import PlanarLeg, rpr, rrr, stacked
from pkm_exact.statics.planar_wrenches import wrench_indices

ONE = Fraction(1)


def corner_number(numerator, denominator=1.0):
    """A rational number in doubles, with bounds."""
    return Intervals.exactly(np.float64(numerator)) / Intervals.exactly(np.float64(denominator))


root_3 = corner_number(3).root()
turns = [
    (-root_3 / corner_number(2), corner_number(-1, 2)),
    (root_3 / corner_number(2), corner_number(-1, 2)),
    (corner_number(0), corner_number(1)),
]
legs = [
    PlanarLeg(
        tuple(corner_number(1, 2) / root_3 * c for c in turn), tuple(corner_number(1, 5) / root_3 * c for c in turn)
    )
    for turn in turns
]

# %% [markdown]
# ## Maps
#
# Base triangle of 0.5 m, platform triangle of 0.2 m, parallel; motors of 4.2 Nm. The isotropic force without moment of
# the 3-RRR, and of the 3-RPR driven by its hinges, which is singular on the circle $x^2 + y^2 = 3/100$.

# %%
ticks = np.arange(-160, 161, 8)
x, y = (values.ravel().astype(float) for values in np.meshgrid(ticks, ticks))
position = Intervals.exactly(x) / corner_number(1000), Intervals.exactly(y) / corner_number(1000)
inside = x**2 + y**2 < 160**2
machines = {
    "3-RRR": stacked([g for leg in legs for g in rrr(leg, position, (0.2, 0.2))], [4.2] * 3),
    "3-RPR": stacked([rpr(leg, position)[0] for leg in legs], [4.2] * 3),
}
figure, axes = plt.subplots(1, 2, figsize=(10, 4.4))
for (name, wrenches), place in zip(machines.items(), axes, strict=True):
    force = wrench_indices(wrenches).pure_isotropic_force
    assert np.all(force.hi[inside] - force.lo[inside] < 1e-6)
    shape = len(ticks), len(ticks)
    shown = np.where(inside, force.lo, np.nan).reshape(shape)
    drawn = place.contourf(ticks, ticks, shown, levels=12)
    figure.colorbar(drawn, ax=place)
    place.set_title(f"{name}: isotropic force [N]")
    place.set_aspect("equal")
    middle = len(ticks) // 2
    centre = shown[middle, middle]
    print(name, "at the centroid", centre)
    wanted = 252 / sqrt(39) if name == "3-RRR" else 21 * sqrt(3)
    assert abs(centre - wanted) < 1e-6

# %% [markdown]
# ## Faces that coincide
#
# With parallel triangles the lines through $B_i$ and $P_i$ meet in one point. If both joints of each 3-RPR leg are
# driven, three generators of the polytope lie in one plane: it has 30 vertices and 26 facets, where six generators in
# general position have 32 and 30. In coordinates $(x, y/\sqrt 3)$ all directions are rational: the zero test is exact.

# %%
POSITION = Fraction(3, 100), Fraction(2, 100)
base = [(-ONE / 4, -ONE / 12), (ONE / 4, -ONE / 12), (Fraction(0), ONE / 6)]  # metres, y by sqrt(3)
platform = [(Fraction(2, 5) * a, Fraction(2, 5) * b) for a, b in base]


def integral(vector):
    """A positive multiple with integers, and the multiple."""
    scale = np.lcm.reduce([value.denominator for value in vector])
    return tuple(int(value * int(scale)) for value in vector), int(scale)


generators, weights = [], []
for (bx, by), (px, py) in zip(base, platform, strict=True):
    dx, dy = POSITION[0] + px - bx, POSITION[1] + py - by
    square = dx * dx + 3 * dy * dy
    # Force of the slide along d, and of the hinge across it; moments about the platform's origin.
    for direction, weight in (
        ((dx, dy, px * dy - py * dx), 10 * RootSum.root(1 / square)),
        ((-dy, dx / 3, px * dx / 3 + py * dy), Fraction(21, 5) / square * RootSum.root(Fraction(3))),
    ):
        whole, scale = integral(direction)
        generators.append(whole)
        weights.append(weight * Fraction(1, scale))
minus, plus = (-ONE,) * 6, (ONE,) * 6
found = Zonotope(tuple(generators), tuple(weights), minus, plus, (ONE, Fraction(3), Fraction(3)))
shape = found.polytope()
print("both joints of three legs:", len(shape.vertices), "vertices,", len(shape.facets), "facets")
assert (len(shape.vertices), len(shape.facets)) == (30, 26)

# %% [markdown]
# ## How many vertices
#
# The chapter says that external vertices grow linearly with the actuators. In general position $m$ generators in space
# have $m^2 - m + 2$ vertices and $m (m - 1)$ facets: 8, 14, 32 for 3, 4, 6, as the chapter's own examples have.

# %%
random = np.random.default_rng(6)
for m in (3, 4, 5, 6, 7):
    some = tuple(tuple(int(v) for v in row) for row in random.integers(-99, 99, (m, 3)))
    zonotope = Zonotope(some, (ONE,) * m, (-ONE,) * m, (ONE,) * m, (ONE,) * 3)
    print(m, "actuators:", len(zonotope.vertices), "vertices,", len(zonotope.facets), "facets")
    assert (len(zonotope.vertices), len(zonotope.facets)) == (m * m - m + 2, m * (m - 1))

# %% [markdown]
# ## Axes of ellipses do not point to vertices
#
# The chapter says that the axes of the ellipse of wrenches point to vertices of the polygon. For the columns
# $(1, 0)$ and $(0.3, 1)$ axes are at 40.7 and 130.7 degrees, vertices at 37.6 and 125.0.

# %%
columns = np.array([[1, 0.3], [0, 1]])
directions, _, _ = np.linalg.svd(columns)
ellipse = sorted(np.degrees(np.arctan2(v[1], v[0])) % 180 for v in directions.T)
polygon = sorted(np.degrees(np.arctan2(v[1], v[0])) % 180 for v in (columns @ [1, 1], columns @ [-1, 1]))
print("axes", np.round(ellipse, 1), "vertices", np.round(polygon, 1))
assert np.allclose(np.round(ellipse, 1), [40.7, 130.7])
assert np.allclose(np.round(polygon, 1), [37.6, 125.0])

# %% [markdown]
# ## Answer
#
# The numbers of the table are right but two (62.23 and 59.75). External vertices grow with the square of the number of
# actuators; axes of ellipses do not point to vertices; and where a platform is parallel to its base, driving both
# joints of each leg gives fewer vertices and facets than counted, because three generators lie in a plane exactly.
