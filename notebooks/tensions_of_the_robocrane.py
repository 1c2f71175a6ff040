# %% [markdown]
# # Do taut cables tell where a RoboCrane is?
#
# Chapter 1 of *Parallel Manipulators: Towards New Applications* (2008) describes the NIST RoboCrane, an octahedron on
# six cables, and prints its inverse kinematics, but no numbers. *Do the printed equations give the lengths of its
# cables, and does a pose with all cables taut have to be the right one?* Half sides here are $b = 2$ above and $a =
# 1$ below, $h = 3$.

# %%
from itertools import pairwise
from math import cos, pi, sin, sqrt
from pathlib import Path

import matplotlib.pyplot as plt
import numpy as np

from pkm_exact import read_robot

root = next(folder for folder in (Path.cwd(), *Path.cwd().parents) if (folder / "models").is_dir())
robot = read_robot(root / "models" / "robocrane-r.toml")
squares = [value / 11600 for value in (179827, 109747, 214867, 148547, 219867, 164267)]

# %% [markdown]
# ## Two misprints
#
# In equation 4 the second cable begins as the first one does, $-b$ for $+b$: it would be as long as another. In
# equation 6 the entry $Q_{21}$ has a minus; then $Q$ is no rotation.

# %%
a, b, h, s = 1.0, 2.0, 3.0, sqrt(3)
upper = {"A": (-b, -b * s / 3, -h), "B": (b, -b * s / 3, -h), "C": (0, 2 * b * s / 3, -h)}
lower = {"D": (0, -2 * a * s / 3, 0), "E": (a, a * s / 3, 0), "F": (-a, a * s / 3, 0)}
cables = [("A", "D"), ("B", "D"), ("B", "E"), ("C", "E"), ("C", "F"), ("A", "F")]
w, x, y, z = np.array([10, s, 1, 2 * s]) / sqrt(116)
Q = np.array(
    [
        [1 - 2 * (y * y + z * z), 2 * (x * y - z * w), 2 * (x * z + y * w)],
        [2 * (x * y + z * w), 1 - 2 * (x * x + z * z), 2 * (y * z - x * w)],
        [2 * (x * z - y * w), 2 * (y * z + x * w), 1 - 2 * (x * x + y * y)],
    ]
)
U = np.array([1 / 10, s / 20, 1 / 5])
found = [float(np.sum((U + Q @ lower[p] - upper[q]) ** 2)) for q, p in cables]
assert np.allclose(found, squares)
misprinted = U + Q @ lower["D"] - np.array([-b, *upper["B"][1:]])
print("second cable squared", squares[1], "as printed", misprinted @ misprinted, "the first one", squares[0])
assert np.isclose(misprinted @ misprinted, squares[0])


def turned(theta, gamma, phi, sign):
    """Q = Rz(phi) Rx(theta) Ry(gamma), its entry 21 with a sign as printed or as it should be."""
    st, ct, sg, cg, sp, cp = (f(t) for t in (theta, gamma, phi) for f in (sin, cos))
    rz = np.array([[cp, -sp, 0], [sp, cp, 0], [0, 0, 1]])
    rx = np.array([[1, 0, 0], [0, ct, -st], [0, st, ct]])
    ry = np.array([[cg, 0, sg], [0, 1, 0], [-sg, 0, cg]])
    whole = rz @ rx @ ry
    whole[1, 0] = cg * sp + sign * sg * st * cp
    return whole


for sign, is_rotation in ((1, True), (-1, False)):
    matrix = turned(0.3, -0.4, 0.5, sign)
    assert np.allclose(matrix.T @ matrix, np.eye(3)) is is_rotation

# %% [markdown]
# ## All poses
#
# 16 complex solutions, mirrored in the plane of the upper joints in pairs; four are real. The chapter names no count.

# %%
solution = robot.solve()
print(solution)
assert (solution.complex_solutions, len(solution.poses), solution.is_complete) == (16, 4, True)
heights = [float(pose.position[2]) for pose in solution.poses]
below = [pose for pose, height in zip(solution.poses, heights, strict=True) if height > -h]
assert len(below) == 2

# %% [markdown]
# ## Tensions
#
# The third axis points down. A weight of 1 at the platform's origin; signs are proved, for every pose in the box of
# the pose.

# %%
known = [(0.12167, 0.29858, 0.09718, 0.26460, 0.13968, 0.22707), (0.32132, 0.05348, 0.50310, 0.11751, 0.39249, 0.19409)]
determinants = []
for pose in below:
    at = robot.at(pose)
    forces = at.forces([0, 0, 1, 0, 0, 0])
    tensions = [-float(value) for value in forces.values]
    print("tensions", np.round(tensions, 5))
    assert forces.signs == (-1,) * 6  # cables pull, all of them
    assert any(np.allclose(tensions, row, atol=6e-6) for row in known)
    determinants.append(np.linalg.det(at.jacobian.to_numpy()))
print("determinants", np.round(determinants, 4))
assert determinants[0] * determinants[1] < 0

# %%
figure = plt.figure(figsize=(9, 4.5))
for place, pose in enumerate(below, 1):
    axes = figure.add_subplot(1, 2, place, projection="3d")
    turn = np.array([[float(x) for x in row] for row in pose.rotation])
    origin = np.array([float(x) for x in pose.position])
    joints = {name: origin + turn @ point for name, point in lower.items()}
    for points, colour in ((upper, "black"), (joints, "tab:blue")):
        ring = [*points.values(), next(iter(points.values()))]
        for one, other in pairwise(ring):
            axes.plot(*zip(one, other, strict=True), colour)
    for q, p in cables:
        axes.plot(*zip(upper[q], joints[p], strict=True), "tab:red", linewidth=1)
    axes.invert_zaxis()
    axes.set_title(f"all cables taut: pose {place}")

# %% [markdown]
# ## Fichter's singularity
#
# With a pure yaw $\varphi$ at $(0, 0, u)$ the determinant of the rows $(l_i, p_i \times l_i)$ is $48 \sqrt 3 a^3 b^3
# (h + u)^3 \cos \varphi$: exact poses at 0, 60 and 120 degrees.

# %%
values = []
for quaternion, angle in (([1, 0, 0, 0], 0.0), ([1, 0, 0, 1], pi / 3), ([1, 0, 0, 3], 2 * pi / 3)):
    at = robot.at({"position": [0, 0, 1], "quaternion": quaternion})  # in the metric of the model: e3 / e0 by sqrt(3)
    assert at.is_exact
    spin = np.array([[cos(angle), -sin(angle), 0], [sin(angle), cos(angle), 0], [0, 0, 1]])
    size = np.prod([np.linalg.norm(np.array([0, 0, 1]) + spin @ lower[p] - upper[q]) for q, p in cables])
    values.append(np.linalg.det(at.jacobian.to_numpy()) * size)
    wanted = 48 * s * a**3 * b**3 * (h + 1) ** 3 * cos(angle)
    print(round(angle * 180 / pi), "degrees:", values[-1], wanted)
    assert np.isclose(abs(values[-1]), abs(wanted))
assert values[0] * values[2] < 0  # between 60 and 120 degrees it vanishes
angles = np.linspace(-pi, pi, 200)
plt.figure()
plt.plot(np.degrees(angles), 48 * s * a**3 * b**3 * (h + 1) ** 3 * np.cos(angles))
plt.plot([0, 60, 120], np.array(values) * np.sign(values[0]), "o")
plt.xlabel("yaw [degrees]")
plt.ylabel("determinant of the rows, exact poses")

# %% [markdown]
# ## Answer
#
# The printed equations do not: one cable is duplicated, and $Q$ has a wrong sign; corrected, they give the lengths.
# And no: two of the four poses hang below the upper joints with all six cables taut, proved, on different sides of a
# singularity.
