# %% [markdown]
# # Newton's method says it has converged: to what?
#
# A controller that needs the pose of a parallel robot starts Newton's method at a pose it believes to be near, and
# takes what comes out. Off line, one starts it, or Levenberg-Marquardt, in many places, or tracks the paths of a
# homotopy. *Which poses does this practice find, which does it miss, how far off are they, and does it ever return a
# pose that does not exist?*
#
# The certified poses answer that: each lies in a box of width $10^{-30}$, and no other exists. What an iteration
# returns is taken as the rational numbers that its doubles are, and compared with the boxes in ball arithmetic. The
# distance of two poses is the greatest displacement of a platform joint. Nothing below rests on a residual.
#
# It runs for about a minute; with the environment variable `PKM_EXACT_QUICK=1` on fewer robots, in some seconds.

# %%
import os
from dataclasses import replace
from fractions import Fraction
from pathlib import Path

import matplotlib.pyplot as plt
import numpy as np

from pkm_exact import read_robot, solve
from pkm_exact.comparison.numeric import WIDTH, compare_numeric
from pkm_exact.comparison.numeric_distance import Judge, Landing
from pkm_exact.constraints.distance import Distance
from pkm_exact.numeric.newton_iteration import newton
from pkm_exact.numeric.numeric_machine import StartPose
from pkm_exact.numeric.numeric_robot import numeric_robot
from pkm_exact.poses.jacobian import characteristic_length

root = next(folder for folder in (Path.cwd(), *Path.cwd().parents) if (folder / "models").is_dir())
quick = os.environ.get("PKM_EXACT_QUICK") == "1"


def locked(name):
    """The first configuration of a shipped robot."""
    robot = read_robot(root / "models" / f"{name}.toml")
    return robot.problem(robot.configuration())


# %% [markdown]
# ## What is found
#
# Every method gets the same 100 random starts: rotations uniform, and the platform as far from the base as the mean
# of the squared leg lengths demands,
#
# $$\overline{l_i^2} = |c|^2 + \overline{|R B_i - A_i|^2}$$
#
# with joints relative to their centroids and $c$ between the centroids. That is the best one can do without knowing a
# pose. Path tracking has starts of its own, the 40 solutions of a generic complex robot (6 of a planar one).

# %%
names = ["rolland-6-6", "dietmaier", "mourrain-l", "similar-planar-s", "robocrane-r", "3-rrr", "3-rpr-double-q"]
if not quick:
    names += ["mssm", "ssm-exact", "6-6p", "hexa", "hexaglide", "linapod-n", "linuxcnc-hexapod", "3-rpr-triple"]
comparisons = {name: compare_numeric(locked(name)) for name in names}

print(f"{'robot':18}{'poses':>6}   found by, greatest error, starts that did not converge")
for name, comparison in comparisons.items():
    for place, result in enumerate(comparison.results):
        head = f"{name:18}{len(comparison.solution.poses):6}" if place == 0 else " " * 24
        errors = [float(error.hi) for error in result.errors()]
        worst = f"{max(errors):.0e}" if errors else "-"
        failed = result.count(Landing.NONE) + result.others.get("lost or at infinity", 0)
        print(f"{head}   {result.engine:20}{len(result.hits):3}{worst:>8}{failed:5} of {result.starts}")

for comparison in comparisons.values():
    for result in comparison.results:
        assert result.count(Landing.SPURIOUS) == 0
        assert set(result.hits) <= set(range(1, len(comparison.solution.poses) + 1))

# %% [markdown]
# With starts chosen that well, a hundred of them find all sixteen poses of Rolland's robot. They do not find the
# forty of Dietmaier's: the number of poses hit creeps up, and nothing in the iterations says when to stop.


# %%
def coverage(result):
    """How many poses have been found after each start."""
    seen = set()
    counts = []
    for judged in result.judged:
        seen |= {judged.mode} - {None}
        counts.append(len(seen))
    return counts


many = compare_numeric(locked("dietmaier"), starts=300 if quick else 3000, solution=comparisons["dietmaier"].solution)
figure, (left, right) = plt.subplots(1, 2, figsize=(10, 3.6))
for result in many.results[1:3]:
    left.plot(range(1, result.starts + 1), coverage(result), label=result.engine)
left.axhline(40, color="grey", linestyle=":")
left.set(xscale="log", xlabel="starts", ylabel="poses found", title="Dietmaier's robot: 40 poses")
left.legend()
modes = range(1, 41)
right.bar(modes, [many.results[1].hits.get(mode, 0) for mode in modes])
right.set(xlabel="assembly mode", ylabel="starts that end there", title=f"Newton, {many.starts} starts")
figure.tight_layout()
missed = {result.engine: many.missed(result) for result in many.results[1:]}
print(f"missed after {many.starts} starts: {missed}")
assert missed["path tracking"] == ()
assert len(many.missed(many.results[1])) < len(comparisons["dietmaier"].missed(comparisons["dietmaier"].results[1]))

# %% [markdown]
# The modes that stay missing longest have a large condition number and close neighbours: the basins from which
# Newton's method runs to them are small. Path tracking does not depend on basins. It loses paths for another reason,
# where solutions lie at infinity or coincide.
#
# ## How far off
#
# The condition number of the leg Jacobian at the certified pose tells how much of a double survives.

# %%
conditions, errors = [], []
for comparison in comparisons.values():
    size = float(characteristic_length(comparison.solution.problem))
    for mode, pose in enumerate(comparison.solution.poses, 1):
        found = [error for result in comparison.results for error in result.errors(mode)]
        if found and pose.jacobian.condition is not None:
            conditions.append(float(pose.jacobian.condition.midpoint))
            errors.append(max(float(error.hi) for error in found) / size)
figure, axes = plt.subplots(figsize=(6, 4))
axes.scatter(conditions, errors, s=12)
guide = np.array([min(conditions), max(conditions)])
axes.plot(guide, 1e-13 * guide, color="grey", linestyle=":", label="tolerance x condition")
axes.set(xscale="log", yscale="log", xlabel="condition number", ylabel="greatest error / platform size")
axes.legend()
figure.tight_layout()
assert max(error / condition for error, condition in zip(errors, conditions, strict=True)) < 1e-11

# %% [markdown]
# ## Where poses meet
#
# One planar robot has a double pose. Changing the square of its first leg's length by $t$ makes of it two poses for
# $t > 0$, and none for $t < 0$, whatever the size of $t$. That is proved, for each $t$.


# %%
def beside_double(change):
    """The singular 3-RPR, the square of its first leg's length changed."""
    problem = locked("3-rpr-double-q")
    first, *others = problem.distances
    return replace(problem, constraints=(Distance(first.base, first.platform, first.length_squared + change), *others))


exponents = range(2, 17, 2)
landings = {}
print(f"{'t':>8}{'poses':>7}   Newton: at a pose, not clear which, at none, not converged   error")
for sign in (1, -1):
    for k in exponents:
        comparison = compare_numeric(beside_double(Fraction(sign, 10**k)), starts=40)
        newton_result = comparison.results[1]
        counts = [
            newton_result.count(landing) for landing in (Landing.MODE, Landing.BETWEEN, Landing.SPURIOUS, Landing.NONE)
        ]
        landings[sign, k] = counts
        worst = max((float(error.hi) for error in newton_result.errors()), default=None)
        print(
            f"{sign * 10.0**-k:8.0e}{len(comparison.solution.poses):7}   "
            f"{counts[0]:17}{counts[1]:17}{counts[2]:9}{counts[3]:15}   {'-' if worst is None else f'{worst:.0e}':>5}"
        )
        assert len(comparison.solution.poses) == (2 if sign > 0 else 0)

# %%
figure, panels = plt.subplots(1, 2, figsize=(10, 3.2), sharey=True)
for axes, sign in zip(panels, (1, -1), strict=True):
    bottom = np.zeros(len(exponents))
    for place, label in enumerate(("at a pose", "not clear which", "at none", "not converged")):
        heights = np.array([landings[sign, k][place] for k in exponents])
        axes.bar([str(-k) for k in exponents], heights, bottom=bottom, label=label)
        bottom += heights
    axes.set(xlabel="log10 |t|", title="two poses, t > 0" if sign > 0 else "no pose, t < 0")
panels[0].set(ylabel="starts", ylim=(0, 62))
panels[1].legend(fontsize="small", ncols=2)
figure.tight_layout()
assert landings[-1, 2][2] == 0
assert landings[-1, 14][2] > 30  # they converge where there is nothing
assert landings[1, 2][0] > 30
assert landings[1, 14][0] == 0

# %% [markdown]
# From $|t| = 10^{-12}$ on, the tolerance of the iteration ($10^{-13}$ of the robot's size, some hundred roundings) no
# longer sees the difference. It converges, with a residual as small as any, to a place between two poses, or to one
# where there is no pose at all.
#
# ## Which pose
#
# Starts in a plane of positions, all at the same angle, on a planar robot with six poses; the colour is the pose to
# which Newton's method runs, white where it does not converge.

# %%
problem = locked("3-rrr")
solution = solve(problem, width=WIDTH)
judge = Judge(problem, solution.poses, characteristic_length(problem))
robot = numeric_robot(problem)
cells = 30 if quick else 90
centre, reach = robot.base_centre, 1.5 * robot.unit
offsets = np.linspace(-reach, reach, cells)
picture = np.full((cells, cells), np.nan)
for row, y in enumerate(centre[1] + offsets):
    for column, x in enumerate(centre[0] + offsets):
        end = judge.judge(newton(robot, StartPose((float(x), float(y), 0.0), (1.0, 0.0, 0.0, 0.0))))
        if end.mode is not None:
            picture[row, column] = end.mode

# %%
figure, axes = plt.subplots(figsize=(5.5, 4.5))
total = len(solution.poses)
colours = plt.get_cmap("tab10", total)
extent = [centre[0] - reach, centre[0] + reach, centre[1] - reach, centre[1] + reach]
image = axes.imshow(
    picture, origin="lower", extent=extent, cmap=colours, vmin=0.5, vmax=0.5 + total, interpolation="nearest"
)
figure.colorbar(image, ax=axes, ticks=range(1, total + 1), label="assembly mode")
axes.plot(
    [float(p.position[0].midpoint) for p in solution.poses],
    [float(p.position[1].midpoint) for p in solution.poses],
    "k+",
)
axes.set(xlabel="x", ylabel="y", title="3-RRR: starts at angle 0")
figure.tight_layout()
reached = np.unique(picture[np.isfinite(picture)]).astype(int).tolist()
print(f"assembly modes reached: {reached} of 1 to {total}")
assert len(reached) > 1

# %% [markdown]
# Around every pose there is a region from which all is well; elsewhere neighbouring starts end at different poses,
# and a start far from where the platform is says nothing about the pose that comes out.
#
# ## Answer
#
# Where poses are well apart, an iteration that converges has found one, to about the tolerance times the condition
# number; a controller that starts near enough is served well, in less than a millisecond. Three things it cannot say.
# Which assembly mode it is at, unless the start was in its region. Whether there are others: a hundred starts find all
# poses of most robots above and leave nine of Dietmaier's, three thousand find these too, and only the certified list
# knows the difference. And whether there is a pose at all: close to a singularity iterations converge, with a perfect
# residual, where none exists. Path tracking finds all isolated poses where none is close to another or to infinity, and
# it does not know when this is so. Only a proof does.
