# %% [markdown]
# # What can a machine do at a pose?
#
# Four sources print numbers for velocities, forces and failures. *Which of them are right?* Every number below
# is exact or
# lies between proved bounds; where a source is wrong, the assertion has the true number.

# %%
from fractions import Fraction
from math import comb, sqrt

import matplotlib.pyplot as plt
import numpy as np
from flint import arb, arb_mat

from pkm_exact.polytopes.enclosures import interval_of
from pkm_exact.polytopes.slabs import Slabs
from pkm_exact.precision import working_precision
from pkm_exact.statics.eigenvalues import eigenvalues
from pkm_exact.statics.failures_of_actuators import relative_manipulability
from pkm_exact.statics.interval_arrays import Intervals
from pkm_exact.statics.largest_ellipsoid import largest_ellipsoid
from pkm_exact.statics.planar_leg_wrenches import PlanarLeg, rrr, stacked
from pkm_exact.statics.planar_wrenches import wrench_indices

# %% [markdown]
# ## Three rails at 120 degrees (Krut, Company and Pierrot 2004)
#
# At $(-40, -10)$, rods of length 100. Printed: condition 1.49, index of the largest ellipse 1.08, speeds 1.35
# and 0.97, index
# of the polytope 1.48.

# %%
with working_precision(256):
    s3, half = arb(3).sqrt(), arb(1) / 2
    t1, t2 = (5 * s3 - 20) / (9525 + 200 * s3).sqrt(), -(20 + 5 * s3) / (9525 - 200 * s3).sqrt()
    J = arb_mat(
        [
            [s3 / 2 - t1 / 2, half + s3 * t1 / 2],
            [-s3 / 2 - t2 / 2, half - s3 * t2 / 2],
            [2 / arb(21).sqrt(), arb(-1)],
        ]
    )
    least, greatest = eigenvalues(J.transpose() * J)
    condition = interval_of((greatest / least).sqrt())
    rows = tuple(tuple(J[i, j] for j in range(2)) for i in range(3))
    polytope = Slabs(rows, (arb(-1),) * 3, (arb(1),) * 3).polytope()
ellipse = largest_ellipsoid(J, ("vx", "vy"))
print("condition", condition)
print("ellipse   ", ellipse.index, "half axes", *ellipse.half_axes)
print("polytope  ", polytope.greatest_norm, polytope.inscribed_radius)
assert round(float(ellipse.index), 2) == 1.08
assert round(float(polytope.greatest_norm), 2) == 1.35
assert round(float(polytope.greatest_norm) / float(polytope.inscribed_radius), 2) == 1.48
assert round(float(condition), 2) == 1.48  # printed 1.49
assert abs(float(polytope.inscribed_radius) - sqrt(21) / 5) < 1e-12  # printed 0.97

# %% [markdown]
# The weights $(\tfrac12, 0, \tfrac12)$ prove the ellipse: it touches the first and the third pair of sides.

# %%
assert ellipse.touching == (0, 2)
corners = np.array([[float(x.mid()) for x in vertex] for vertex in polytope.vertices])
corners = corners[np.argsort(np.arctan2(*corners.T[::-1]))]
turn = np.linspace(0, 2 * np.pi, 200)
plt.fill(*corners.T, alpha=0.3)
plt.plot(*(np.linalg.cholesky(ellipse.matrix.to_numpy()) @ [np.cos(turn), np.sin(turn)]))
plt.gca().set_aspect("equal")
plt.title("speeds that three rails can follow, and the largest ellipse")

# %% [markdown]
# ## DUAL V with rational dimensions (Shayya et al. 2014)
#
# The set of resolutions is called a zonotope there. Zonotopes in space have faces with parallel edges; this one
# has triangles.

# %%
lines = ((-3, -4, -8), (3, -4, -8), (3, 4, -8), (-3, 4, -8))
dual = Slabs(
    tuple(tuple(Fraction(x, 25) for x in row) for row in lines), (Fraction(-1),) * 4, (Fraction(1),) * 4
).polytope()
print(len(dual.vertices), "vertices,", len(dual.facets), "facets")
assert {len(facet.vertices) for facet in dual.facets} == {3}

# %% [markdown]
# ## Wrenches of a 3-RRR (chapter 6 of Parallel Manipulators, 2008)
#
# Along a line through the centroid: isotropic force without moment, between certified bounds closer than the
# line is thick.

# %%
x = np.arange(-150, 151)
number = lambda a, b=1.0: Intervals.exactly(np.float64(a)) / Intervals.exactly(np.float64(b))  # noqa: E731
root = number(3).root()
turns = [(-root / number(2), number(-1, 2)), (root / number(2), number(-1, 2)), (number(0), number(1))]
position = Intervals.exactly(x.astype(float)) / number(1000), Intervals.exactly(np.zeros(x.shape)) / number(1)
legs = [
    PlanarLeg(tuple(number(1, 2) / root * c for c in turn), tuple(number(1, 5) / root * c for c in turn))
    for turn in turns
]
wrenches = stacked([g for leg in legs for g in rrr(leg, position, (0.2, 0.2))], [4.2] * 3)
indices = wrench_indices(wrenches)
force = indices.pure_isotropic_force
plt.figure()
plt.plot(x, force.lo)
plt.plot(x, force.hi)
plt.xlabel("x [mm]")
plt.ylabel("isotropic force [N]")
centre = indices.absolute_available_force
assert centre.lo[150] <= 336 / sqrt(39) <= centre.hi[150]

# %% [markdown]
# ## Failures (chapter 3)
#
# Squares of the relative manipulability sum to a binomial over all failure sets, C(m - n, i). The source's
# table prints
# 2 for m = 8 legs of which i = 2 fail, and 3 for m = 9 and i = 3; with n = 6 both sums are 1.

# %%
random = np.random.default_rng(3)
for count, freedoms in ((5, 3), (6, 3)):
    machine = [[Fraction(int(value)) for value in row] for row in random.integers(-9, 9, (count, freedoms))]
    for failed in range(1, count - freedoms + 1):
        total = sum(relative_manipulability(machine, failed).values(), Fraction(0))
        assert total == comb(count - freedoms, failed)
        print(count, "legs,", failed, "failed: sum", total)

# %% [markdown]
# ## Answer
#
# Of the first source 1.08 (the ellipse), 1.35 and 1.48 (the polytope) are right; 1.49 and 0.97 do not belong to its
# data: the condition number is 1.482, the least speed sqrt(21)/5. What the second calls a zonotope is none. The sums
# of chapter 3 that are printed as 2 and 3 are 1. The isotropic force of chapter 6 agrees at the centroid, where it has
# a closed form.
