# %% [markdown]
# # Can a hexapod on inclined slides stand still in every pose?
#
# Chapter 12 of *Parallel Manipulators: Towards New Applications* (2008) moves a platform by six rods on inclined
# slides, and balances it by counterweights and a pantograph. *Do its hexagons, its path and its weights fit
# together?*

# %%
from fractions import Fraction
from math import sqrt
from pathlib import Path

import matplotlib.pyplot as plt
import numpy as np

from pkm_exact import read_robot
from pkm_exact.statics.static_balance import Pantograph, Rod, balance_identity, counterweights

root = next(folder for folder in (Path.cwd(), *Path.cwd().parents) if (folder / "models").is_dir())

# %% [markdown]
# ## Hexagons
#
# Equations 64 and 65, with long sides $L$ and short ones $l$: all corners must lie on one circle, $r^2 = (L^2 + L l +
# l^2) / 3$. As printed, the second is off it, and the fifth has the x of the second.


# %%
def hexagon(long, short):
    """Corners of the corrected equations."""
    c, y0 = sqrt(3) / 2, (long / 2 + short) / sqrt(3)
    right = [(long / 2, -y0), ((long + short) / 2, short * c - y0), (short / 2, (long + short) * c - y0)]
    return np.array([*right, *((-x, y) for x, y in reversed(right))])


for long, short, square in ((1.0, 0.09, 0.3660333), (0.5, 0.09, 0.1010333)):
    corners = hexagon(long, short)
    assert np.allclose(np.sum(corners**2, axis=1), (long**2 + long * short + short**2) / 3)
    assert abs(np.sum(corners[0] ** 2) - square) < 1e-7
    printed = np.array([corners[1][0], short * sqrt(3) / 2 + (long / 2 + short) / sqrt(3)])
    assert abs(np.sum(printed**2) - square) > 0.01

# %% [markdown]
# ## The path
#
# From 0.7 m upwards by 0.1 m. Guides inward at 45 degrees, rods of 0.5 m; the lower of two slider positions. Outward
# guides cannot reach it.

# %%
base, platform = hexagon(1.0, 0.09), hexagon(0.5, 0.09)


def sliders(height, way):
    """s^2 - 2 (u.d) s + |d|^2 - l^2 = 0, the lower one; radial guides."""
    found = []
    for b, p in zip(base, platform, strict=True):
        outward = b / np.linalg.norm(b)
        u = np.array([*(way * outward), 1.0]) / sqrt(2)
        d = np.array([*(p - b), height])
        room = (u @ d) ** 2 - d @ d + 0.25
        found.append(u @ d - np.sqrt(room) if room >= 0 else np.nan)
    return np.array(found)


for height, wanted in ((0.6, 0.179684), (0.7, 0.292805), (0.8, 0.425146)):
    inward = sliders(height, -1)
    print(f"z = {height}: s = {inward[0]:.6f}")
    assert np.allclose(inward, wanted, atol=6e-7)
assert np.isnan(sliders(0.7, 1)).all()

times = np.linspace(0, 1, 200)
path = 10 * times**3 - 15 * times**4 + 6 * times**5
for speed, duration in ((102 / 60, 0.110294), (30 / 60, 0.375)):
    total = 15 / 8 * 0.1 / speed
    print(f"peak speed {speed} m/s: {total:.6f} s, peak acceleration {10 / sqrt(3) * 0.1 / total**2:.3f} m/s^2")
    assert abs(total - duration) < 1e-6
    values = np.array([sliders(0.7 + 0.1 * p, -1)[0] for p in path])
    plt.plot(times * total, np.gradient(values, times * total), label=f"peak {speed * 60:.0f} m/min")
plt.xlabel("time [s]")
plt.ylabel("slider speed [m/s]")
plt.legend()

# %% [markdown]
# ## A singularity on the path
#
# The azimuth of the guides is not printed. With both guides of a short side parallel, all rods are upright at $z =
# 1/2 + 1 / (2 \sqrt 3) = 0.789$, on the path: the platform moves with its slides locked, proved.

# %%
robot = read_robot(root / "models" / "inclined-slides.toml")
upright = robot.solve(configuration="upright rods")
print(upright)
assert 0.7 < 0.5 + 1 / (2 * sqrt(3)) < 0.8
assert upright.claim.value == "positive-dimensional-proved"

# %% [markdown]
# ## Balance
#
# $M r = A h + Q B + \sum K_i s_i u_i$ + constant, exactly. Counterweights on the rods alone cannot make $A$ vanish,
# which is then the sum of all masses; with the pantograph of table 3 everything vanishes.

# %%
joints = [(Fraction(x), Fraction(y), Fraction(0)) for x, y in ((3, 1), (-1, 3), (-3, 1), (-3, -1), (1, -3), (3, -1))]
rods = [Rod(joint, Fraction(1, 2), Fraction(1, 2)) for joint in joints]
own = balance_identity(Fraction(8), (Fraction(0),) * 3, rods)
print("before:", own.position, [str(k) for k in own.slides])
assert not own.is_balanced
alone = balance_identity(Fraction(8), (Fraction(0),) * 3, [Rod((Fraction(0),) * 3, Fraction(3, 2), Fraction(0))] * 6)
assert alone.slides == (0,) * 6
assert alone.position == 17
frame = Pantograph(Fraction(3), Fraction(0), Fraction(17), (Fraction(1),) * 6)
found = counterweights(Fraction(8), (Fraction(0),) * 3, rods, frame)
print("on the arm", found.on_arm, "h; on the rods", 750 * found.on_rods[0], "mm; added", found.added, "kg")
assert (found.on_arm, found.on_platform, found.added) == (-1, None, 26)
assert [750 * part for part in found.on_rods] == [Fraction("-187.5")] * 6
assert (11 + found.added) / 11 == Fraction(37, 11)

# %% [markdown]
# ## Table 3 is singular by its form
#
# Its hexagons, 200/800, 100/400 and 250/1000, are similar. With equal sliders and matching corners the rods are then
# dependent in every pose.

# %%
ratios = [Fraction(long, short) for short, long in ((200, 800), (100, 400), (250, 1000))]
assert len(set(ratios)) == 1

# %% [markdown]
# ## Answer
#
# Yes, with counterweights and a pantograph, at 37/11 of its mass; the weights of table 3 are right. Its hexagons are
# similar and so a bad choice, equations 64 and 65 each have two wrong signs, and depending on what is not printed the
# path meets a singularity.
