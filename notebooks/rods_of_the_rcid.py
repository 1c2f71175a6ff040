# %% [markdown]
# # Where are six rods on vertical slides singular?
#
# Chapter 4 of *Parallel Manipulators: Towards New Applications* (2008) computes the dynamics of the RCID, six rods of
# 97.98 mm on vertical slides whose upper ends meet in pairs. *Do its Jacobians, its stroke and its counts of
# operations hold?*

# %%
from math import cos, sin, sqrt
from pathlib import Path

import matplotlib.pyplot as plt
import numpy as np

from pkm_exact import read_robot

root = next(folder for folder in (Path.cwd(), *Path.cwd().parents) if (folder / "models").is_dir())
robot = read_robot(root / "models" / "rcid.toml")
LENGTH_SQUARED = 97.98**2  # as printed; the model takes 9600
assert round(sqrt(9600), 2) == 97.98
degrees = np.radians([15, 105, 135, 225, 255, 345])
base = 80 * np.array([np.cos(degrees), np.sin(degrees), 0 * degrees]).T
corners = np.radians([60, 60, 180, 180, 300, 300])
platform = 40 * np.array([np.cos(corners), np.sin(corners), 0 * corners]).T

# %% [markdown]
# ## Poses
#
# The chapter has no count: 16 complex poses, 8 of them real, at both positions of the slides in the model.

# %%
for name in ("home", "near (3, -5, 120)"):
    solution = robot.solve(configuration=name)
    print(name, solution)
    assert (solution.complex_solutions, len(solution.poses), solution.is_complete) == (16, 8, True)


# %% [markdown]
# ## Two Jacobians
#
# Rows $(a_i, p_i \times a_i) / a_{iz}$. At home their determinant is $442368000000 \sqrt 2 / a_z^3$, with $a_z^2 =
# L^2 - 8000 + 3200 \sqrt 2$: the slides are not singular there, at whatever height.


# %%
def turned(psi, theta, phi):
    """R = Rz(psi) Ry(theta) Rx(phi), equation 4."""
    cz, sz, cy, sy, cx, sx = (f(t) for t in (psi, theta, phi) for f in (cos, sin))
    rz = np.array([[cz, -sz, 0], [sz, cz, 0], [0, 0, 1]])
    ry = np.array([[cy, 0, sy], [0, 1, 0], [-sy, 0, cy]])
    rx = np.array([[1, 0, 0], [0, cx, -sx], [0, sx, cx]])
    return rz @ ry @ rx


def rods_at(position, rotation):
    """Rods a, arms p and slides l, the rods upwards."""
    arms = platform @ rotation.T
    tips = np.asarray(position) + arms
    away = tips - base
    slides = tips[:, 2] - np.sqrt(LENGTH_SQUARED - away[:, 0] ** 2 - away[:, 1] ** 2)
    rods = away - np.outer(slides, [0, 0, 1])
    return rods, arms, slides


def jacobian(rods, arms):
    """Slides from twists."""
    return np.hstack([rods, np.cross(arms, rods)]) / rods[:, 2:]


rods, arms, _ = rods_at((0, 0, 120), np.eye(3))
home = np.linalg.det(jacobian(rods, arms))
a_z = sqrt(LENGTH_SQUARED - 8000 + 3200 * sqrt(2))
print("determinant at home", home)
assert np.isclose(abs(home), 442368000000 * sqrt(2) / a_z**3)
assert np.isclose(abs(home), 1304907.1, atol=0.05)
highest = max(robot.solve(configuration="home").poses, key=lambda pose: float(pose.position[2]))
at = robot.at(highest, configuration="home")
ours = at.jacobian.to_numpy()
assert np.isclose(abs(np.linalg.det(ours)), abs(home), rtol=1e-4)  # the rods of the model are 97.9796 long

position, angles = np.array([3, -5, 120.0]), (0.05, -0.1, 0.12)
rods, arms, slides = rods_at(position, turned(*angles))
assert np.allclose(slides, [46.676007, 50.772435, 44.119678, 33.853091, 40.449275, 36.891768], atol=5e-7)

# %% [markdown]
# ## Equation 66
#
# The angular velocity of a rod that does not spin is $a \times (v + \omega \times p - \dot l e_z) / L^2$. Its entry
# (3, 5) must be $-a_{iy} p_{iz}$, printed $-a_{iy} p_{ix}$. In (2, 3) $a_{iz}$ is printed for $a_{ix}$, before a
# factor $1 - J_{Ci3}$ that is always 0.

# %%
rows = jacobian(rods, arms)
for rod, arm, row in zip(rods, arms, rows, strict=True):
    columns = []
    for k in range(6):
        v, w = np.eye(3)[k] if k < 3 else np.zeros(3), np.eye(3)[k - 3] if k >= 3 else np.zeros(3)
        columns.append(np.cross(rod, v + np.cross(w, arm) - row[k] * np.array([0, 0, 1])))
    spin = np.array(columns).T
    assert np.isclose(row[2], 1)
    assert np.isclose(spin[1, 2], 0, atol=1e-9)
    assert np.isclose(spin[2, 4], -rod[1] * arm[2])
    assert not np.isclose(spin[2, 4], -rod[1] * arm[0])

# %% [markdown]
# ## Stroke
#
# Slides of 70 mm for a ball of 10 mm and 15 degrees: about any single axis 52 mm suffice, for three independent
# angles of 15 degrees each about 72 are used (both by sampling, which proves nothing).

# %%
random = np.random.default_rng(4)
directions = random.normal(size=(4000, 3))
directions *= 10 / np.linalg.norm(directions, axis=1)[:, None]
limit = np.radians(15)
corner = [(x, y, z) for x in (-limit, limit) for y in (-limit, limit) for z in (-limit, limit)]
strokes = []
for turn in corner:
    found = [rods_at((dx, dy, 120 + dz), turned(*turn))[2] for dx, dy, dz in directions[:400]]
    strokes += found
strokes = np.array(strokes)
span = strokes.max() - strokes.min()
print("slides use", span, "mm")
assert 70 < span < 73

heights = np.linspace(-15, 15, 61)
plt.plot(heights, [rods_at((0, 0, 120), turned(0, np.radians(t), 0))[2] for t in heights])
plt.xlabel("pitch [degrees]")
plt.ylabel("slides [mm]")

# %% [markdown]
# ## Counts of operations
#
# The totals of table 2 are those of its rows.

# %%
table = {
    "Lagrange": ((310, 590, 0), (3028, 4403, 30), (751, 1579, 6), (2180, 3711, 7), (20924, 36733, 108)),
    "momentum": ((94, 226, 0), (724, 940, 18), (131, 279, 4), (355, 664, 7), (3734, 6824, 84)),
}
for plate, slides_, moving, turning, total in table.values():
    assert tuple(a + b + 6 * (c + d) for a, b, c, d in zip(plate, slides_, moving, turning, strict=True)) == total

# %% [markdown]
# ## Answer
#
# At home nowhere: the determinant depends on no height. The Jacobians hold but one entry of equation 66; the stroke
# of 70 mm belongs to three independent angles; the counts add up.
