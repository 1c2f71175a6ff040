# %% [markdown]
# # Does a Delta reach all of a cube?
#
# Laribi, Romdhane and Zeghloul (chapter 10 of *Parallel Manipulators: Towards New Applications*, 2008) design Deltas
# whose workspace has a given volume, and ask only of its corners whether they are reached. *Is that enough?* For the
# designs that they print the whole volume is proved; for a better one by their own measure it is not reached.

# %%
from fractions import Fraction
from pathlib import Path
from tempfile import TemporaryDirectory

from pkm_exact import read_robot
from pkm_exact.pictures.region_figure import region_figure

MODEL = """schema = 1
name = "Delta {rod}, {arm}, {radius}"
kind = "delta"
unit = "1"
source = "chapter 10 of Parallel Manipulators (2008)"
[dimensions]
base_radius = {base}
platform_radius = 1
arm = {arm}
rod = {rod}
"""


def delta(rod, arm, radius):
    """The robot: only the difference of the radii of base and platform matters."""
    with TemporaryDirectory() as folder:
        path = Path(folder) / "delta.toml"
        base = str(1 + Fraction(radius))
        path.write_text(MODEL.format(rod=rod, arm=arm, radius=radius, base=f'"{base}"'))
        return read_robot(path)


def question(region, answer="kind = 'all'"):
    """Whether all of a region is reached, or a map of it."""
    return f"[region]\n{region}\n[conditions]\nreachable = true\n[answer]\n{answer}\n"


# %% [markdown]
# ## The printed designs
#
# Tables 3 and 4: cubes of edge 2 whose lower face is at height 1.01 and 1.02. Table 6: a hexagonal prism of side 1, of
# which the height is not printed; with a height of 2 and a corner at the azimuth of the first arm it just fits.

# %%
cube = "position = [[-1, 1], [-1, 1], [{low}, {high}]]"
table_3 = delta("2.66", "1.73", "1.74").region(question(cube.format(low=1.01, high=3.01)))
table_4 = delta("2.5", "1.91", "1.48").region(question(cube.format(low=1.02, high=3.02)))
prism = question("prism = { sides = 6, radius = 1, height = [1.67, 3.67] }")
table_6 = delta("3.32", "1.4", "1.95").region(prism)
for name, answer in (("table 3", table_3), ("table 4", table_4), ("table 6", table_6)):
    print(name, "proved:", answer.is_proved, answer.counts)
    assert answer.is_proved

# %% [markdown]
# ## Corners are not enough
#
# By the source's own objective, the sum of the powers of the corners, rods of 2.45808, arms of 0.97868 and $r = 0$ are
# better than table 3: all eight corners of the cube from height 1 are reached. Its middle is not.

# %%
better = delta("2.45808", "0.97868", "0")
answer = better.region(question(cube.format(low=1, high=3)))
assert answer.counterexample is not None
(point,) = answer.counterexample.points
print("not reached:", *map(str, point), "(y in units of sqrt 3)")
paved = better.region(question(cube.format(low=1, high=3), "kind = 'map'\nsteps = 15"))
least, most = paved.shares["outside"], paved.shares["outside"] + paved.shares["undecided"]
print(f"not reached: between {float(least):.1%} and {float(most):.1%} of the cube")
assert least < Fraction(17, 100) < most

# %% [markdown]
# Three sections through the middle of the cube: reached, not reached, undecided.

# %%
figure = region_figure(paved)
figure  # noqa: B018

# %% [markdown]
# ## Answer
#
# No. Of the printed designs every pose of the cube is proved to be reached. Of the better one all corners are, and yet
# an exact pose in it is not, nor are between 14 and 19 percent of the cube: no sample of corners shows that.
