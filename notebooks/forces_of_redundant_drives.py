# %% [markdown]
# # What do redundant drives gain, and what do errors of the model cost?
#
# Chapter 5 of *Parallel Manipulators: Towards New Applications* (2008) studies a point on three driven legs
# (RP/2RPR), one more than it needs: two measures of how well the drives act, internal forces, and how errors of the
# model turn internal forces into forces on the platform. *Which of its statements can be reproduced?* It prints
# curves and no dimensions; the base here is an equilateral triangle of side 1, exact in the coordinates $(x, y /
# \sqrt 3)$.

# %%
from dataclasses import replace
from fractions import Fraction
from math import sqrt

import matplotlib.pyplot as plt
import numpy as np

from pkm_exact import Mechanism
from pkm_exact.constraints.distance import Distance
from pkm_exact.motions.motion import Motion
from pkm_exact.motions.motion_groups import PLANAR
from pkm_exact.statics.forces import internal_loads
from pkm_exact.statics.redundant_actuation import perturbation_norm

ONE, ZERO = Fraction(1), Fraction(0)
CORNERS = ((ZERO, ZERO), (ONE, ZERO), (ONE / 2, ONE / 2))  # y by sqrt(3)
POINT = Motion("plane", "the motions of a point of a plane", 2, 2, (), (0, 5, 6), (0, 1))


def machine_at(x, y, legs=(0, 1, 2), moved=None, shift=(ZERO, ZERO)):
    """The machine at an exact point, one of its drives displaced; turns of the point mean nothing."""
    rods = []
    for k in legs:
        base = [c + (d if k == moved else 0) for c, d in zip(CORNERS[k], shift, strict=True)]
        rods.append(Distance((*base, ZERO), (ZERO,) * 3, ONE, f"leg {k + 1}"))
    names = tuple(rod.name for rod in rods)
    machine = Mechanism("RP/2RPR", "1", "chapter 5", tuple(rods), names, PLANAR, (1, 3, 1))
    return replace(machine.at({"position": [x, y], "half_tangent": 0}), motion=POINT)


# %% [markdown]
# ## The measures
#
# $\mu' = \det J^T J$ is the sum of the squared sines of the angles between legs, $\mu''$ the ratio of the two
# eigenvalues. At the centroid they are exactly $9/4$ and 1; in the middle of a side 2 and $1/2$, where the machine of
# that side's two legs alone is singular: it has $\mu' = 0$.

# %%
for name, x, y, wanted, ratio in (
    ("centroid", ONE / 2, ONE / 6, 2.25, 1.0),
    ("middle of a side", ONE / 2, ZERO, 2.0, 0.5),
):
    values = machine_at(x, y).indices()
    mu, condition = float(values["manipulability"]) ** 2, float(values["condition"]) ** -2
    print(f"{name}: mu' = {mu:.6f}, mu'' = {condition:.6f}")
    assert abs(mu - wanted) < 1e-9
    assert abs(condition - ratio) < 1e-9
assert machine_at(ONE / 2, ZERO).singular == ()
two = machine_at(ONE / 2, ZERO, legs=(0, 1))
assert two.rank == 1
assert "type-2" in two.singular

# %%
ticks = np.linspace(0.0, 1.0, 161)
px, py = np.meshgrid(ticks, ticks * sqrt(3) / 2)
units = []
for cx, cy in CORNERS:
    dx, dy = px - float(cx), py - sqrt(3) * float(cy)
    size = np.sqrt(dx * dx + dy * dy)
    size[size == 0] = np.nan
    units.append((dx / size, dy / size))
cross = [units[i][0] * units[j][1] - units[i][1] * units[j][0] for i, j in ((0, 1), (0, 2), (1, 2))]
mu = sum(c * c for c in cross)
root = np.sqrt(np.maximum(9 - 4 * mu, 0))
inside = (py <= sqrt(3) * px) & (py <= sqrt(3) * (1 - px))
figure, axes = plt.subplots(1, 2, figsize=(10, 4))
for place, shown, title in ((axes[0], mu, "mu'"), (axes[1], (3 - root) / (3 + root), "mu''")):
    drawn = place.contourf(px, py, np.where(inside, shown, np.nan), levels=12)
    figure.colorbar(drawn, ax=place)
    place.set_title(title)
    place.set_aspect("equal")
assert np.nanmin(mu[inside]) > 0.7
assert np.nanmax(mu[inside]) <= 2.25 + 1e-12

# %% [markdown]
# ## Internal forces
#
# Three legs bear any load with any one of a family of forces. At the centroid equal forces of all three legs do
# nothing: they can be added, so that all legs pull.

# %%
basis = internal_loads(machine_at(ONE / 2, ONE / 6))
print("internal forces", [[str(value) for value in row] for row in basis])
assert len(basis) == 1
assert len({str(value) for value in basis[0]}) == 1

# %% [markdown]
# ## Errors of the model
#
# The greatest singular value of $S$: the part of the wanted force that acts wrongly if a drive stands elsewhere than
# the model says, by a twentieth of the side, with the point held at the centroid. The chapter has curves for a
# displacement of 5 %, no numbers.

# %%
shifts = {
    "drive 3 along x": (2, (ONE / 20, ZERO), 0.04947),
    "drive 3 along y": (2, (ZERO, ONE / 20 / 2), 0.0),
    "drive 1 along x": (0, (ONE / 20, ZERO), 0.01801),
}
for name, (which, shift, wanted) in shifts.items():
    nominal = machine_at(ONE / 2, ONE / 6)
    real = machine_at(ONE / 2, ONE / 6, moved=which, shift=shift)
    norm = perturbation_norm(nominal, real, (1, 2))
    print(f"{name}: {float(norm):.5f}")
    assert abs(float(norm) - wanted) < 6e-6

steps = [Fraction(k, 100) for k in range(-8, 9)]
centre = machine_at(ONE / 2, ONE / 6)
moved = [machine_at(ONE / 2, ONE / 6, moved=2, shift=(x, ZERO)) for x in steps]
curve = [float(perturbation_norm(centre, real, (1, 2))) for real in moved]
plt.figure()
plt.plot([float(x) for x in steps], curve)
plt.xlabel("displacement of drive 3 along x, by the side")
plt.ylabel("greatest singular value of S")

# %% [markdown]
# ## Misprints
#
# The first term of equation 23 is printed with $\Delta A^T$, between a projector of three rows and the inverse of a
# matrix of two: it cannot be multiplied. With $\Delta A$ it can, and the first-order change of the pseudoinverse
# comes out right.

# %%
random = np.random.default_rng(5)
matrix, change = random.normal(size=(3, 2)), np.vstack([random.normal(size=(1, 2)), np.zeros((2, 2))])
pseudo = lambda m: m @ np.linalg.inv(m.T @ m)  # noqa: E731
projector = np.eye(3) - matrix @ np.linalg.inv(matrix.T @ matrix) @ matrix.T
first_order = projector @ change @ np.linalg.inv(matrix.T @ matrix) - pseudo(matrix) @ change.T @ pseudo(matrix)
step = 1e-6
difference = (pseudo(matrix + step * change) - pseudo(matrix - step * change)) / (2 * step)
assert np.allclose(first_order, difference, atol=1e-6)
assert (projector.shape, change.T.shape) == ((3, 3), (2, 3))

# %% [markdown]
# ## Answer
#
# The measures are exact rational functions: never 0 within the triangle, $9/4$ at most. A displaced drive turns up to
# as large a part of a force into another as it is displaced by the side, and none along its own leg. Equation 23
# needs $\Delta A$ for $\Delta A^T$; the text after equation 30 names the two control laws in the wrong order.
