# %% [markdown]
# # How can it move, and what holds it?
#
# Chapter 21 of *Parallel Manipulators: Towards New Applications* (2008) finds the mobility of mechanisms by screws.
# *Which of its examples are right, if every rank is exact, and which of its statements are not?*
#
# All matrices below have rational entries, so that a rank is a theorem. Numbers that the source does not give are
# ours.

# %%
import os
from fractions import Fraction
from pathlib import Path

import sympy

from pkm_exact import Screw, ScrewSystem, mobility_of, read_linkage
from pkm_exact.mobility.actuation import actuation

root = next(folder for folder in (Path.cwd(), *Path.cwd().parents) if (folder / "models").is_dir())
quick = os.environ.get("PKM_EXACT_QUICK") == "1"


def shipped(name):
    """The mobility of a shipped mechanism."""
    return mobility_of(read_linkage(root / "models" / "chains" / f"{name}.toml"))


# %% [markdown]
# ## 3-PPRR
#
# Slides along $e_{Ai}$ and the common $e_B$, then two hinges along $e_{Ai} \times e_B$. A leg has four joints of rank
# 3 and three constraints. The platform has one freedom, along $e_B$; the equations of the loops have rank 8 of 12,
# the whole mechanism four freedoms, where Gruebler's formula counts none. It is a real motion: legs move the platform
# in planar groups, and these intersect in the translations along $e_B$.

# %%
pprr = shipped("3-pprr")
assert (pprr.free.rank, pprr.free.total, pprr.free.counted) == (8, 4, 0)
assert str(pprr.free.platform.free_motions()) == "1 translation along (0, 0, 1)"
assert (pprr.finite.least, str(pprr.finite.argument)) == (4, "subgroups")

for names in (["A1"], ["A1", "B2"], ["A1", "RB1"], ["A1", "A2", "A3"], ["A1", "B1"], ["A1", "A2", "A3", "B1"]):
    done = actuation(pprr.free, names)
    print(f"{', '.join(names):14} locked: platform {done.left_of_platform}, mechanism {done.left}")

# %% [markdown]
# The source names $\{A_i, B_i\}$ as what holds the platform. The list of all minimal sets has six more: $B_i$ with
# either hinge of its leg. The rule is: $B_i$ and one other joint of the same leg. The source's equation (21) prints
# $(0, 0, 0; a_{12}, b_{22}, c_{32})$ and then $e = (a_{11}, b_{11}, c_{11})$; both must be $e_B = (a_{12}, b_{12},
# c_{12})$.

# %%
sets = {frozenset(names) for names in pprr.hold_platform.sets}
assert pprr.hold_platform.is_complete
assert sets == {frozenset((f"B{i}", f"{other}{i}")) for i in (1, 2, 3) for other in ("A", "RB", "RC")}
print(len(sets), "minimal sets hold the platform")

# %% [markdown]
# ## Sarrus's six-bar
#
# Two chains of three parallel hinges, at the angle $\alpha$. Rank 5, so one freedom where Gruebler counts none. The
# source's determinant is $\sin^2 \alpha$: four of the constraints are independent exactly if $\alpha$ is not 0 or
# $\pi$.

# %%
sarrus = shipped("sarrus")
assert (sarrus.free.rank, sarrus.free.total, sarrus.free.counted) == (5, 1, 0)
assert str(sarrus.free.platform.free_motions()) == "1 translation along (0, 0, 1)"

c, s = sympy.symbols("c s")
# Couples along y and z, and a force along x, of the first chain; the same, turned by alpha, of the second.
first = sympy.Matrix([[0, 0, 0, 0, 1, 0], [0, 0, 0, 0, 0, 1], [1, 0, 0, 0, 0, 0]])
second = sympy.Matrix([[0, 0, 0, -s, c, 0], [c, s, 0, 0, 0, 0]])
minor = sympy.Matrix.vstack(first[[0, 2], :], second)[:, [0, 1, 3, 4]]
assert sympy.expand(minor.det() ** 2 - s**4) == 0
print("minor of the constraints:", minor.det())

for tangent in (Fraction(0), Fraction(1, 3), Fraction(1)):
    cosine, sine = (1 - tangent**2) / (1 + tangent**2), 2 * tangent / (1 + tangent**2)
    chain = [Screw.line((0, 3, 0), (1, 0, 0)), Screw.line((0, 5, 2), (1, 0, 0)), Screw.line((0, 3, 4), (1, 0, 0))]
    axis, side = (cosine, sine, 0), (sine, -cosine)
    other = [Screw.line((r * side[0], r * side[1], z), axis) for r, z in ((5, 0), (10, 2), (5, 4))]
    joints = ScrewSystem.span([*chain, *other])
    common = ScrewSystem.span(chain) & ScrewSystem.span(other)
    print(f"tan(alpha/2) = {tangent}: rank of the joints {joints.rank}, platform {common.free_motions()}")
    assert joints.rank == (3 if sine == 0 else 5)

# %% [markdown]
# The condition $a b \neq 0$ in the source ($a = \cos\alpha$, $b = \sin\alpha$) excludes $\alpha = \pi/2$, which the
# source itself finds to be the best: $b \neq 0$ is enough, as the last line shows. Its (38) labels $S_1$ what is
# $S_2$.
#
# ## Seven links
#
# One more hinge $G$ along $y$ in the second chain. At $\alpha = \pi/2$ the platform keeps its one freedom, and the
# chain can move by itself. At other angles the mobility is 2, so that the mechanism is not the one of "Fig. 10" as
# printed but that of Fig. 11. Rank is not all, though: the second freedom exists to the first order only, and the
# finite mobility is 1.

# %%
right, oblique = shipped("seven-link"), shipped("seven-link-oblique")
assert (right.free.rank, right.free.total, right.free.platform.rank) == (5, 2, 1)
assert (oblique.free.total, oblique.free.platform.rank) == (2, 2)
assert (oblique.finite.least, oblique.finite.most, str(oblique.finite.argument)) == (1, 1, "second-order")
print("at a right angle:", right.free.platform.free_motions())
print("otherwise:", oblique.free.platform.free_motions(), "to the first order; finite mobility", oblique.finite.least)

# %% [markdown]
# ## Peaucellier and Lipkin: an exact straight line
#
# Eight bars, ten hinges: Gruebler counts $-8$ in space; in the group of planar motions the equations are regular, so
# the mobility is 1. That $P$ goes along the line $x = 8$ is a membership: with $w = B - D$, $Z = C \times P$, the
# polynomial $w_x C_x (C_x - P_x)(5 P_x - 40)$ is a combination of the closure equations, with the cofactors below.
# Where $B \neq D$, $C \neq P$ and $C_x \neq 0$, $P_x = 8$.

# %%
eight = shipped("peaucellier")
assert (eight.free.total, eight.free.counted, str(eight.finite.argument)) == (1, -8, "regular")

bx, by, dx, dy, cx, cy, px, py = sympy.symbols("bx by dx dy cx cy px py")


def square(x, y):
    """The square of a distance from the origin."""
    return x**2 + y**2


bars = {"OB": square(bx, by) - 65, "OD": square(dx, dy) - 65, "QC": square(cx, cy) - 5 * cx}
bars |= {"BC": square(bx - cx, by - cy) - 25, "DC": square(dx - cx, dy - cy) - 25}
bars |= {"BP": square(bx - px, by - py) - 25, "DP": square(dx - px, dy - py) - 25}
w_c = (bars["DC"] - bars["OD"] - bars["BC"] + bars["OB"]) / 2  # (B - D).C
w_p = (bars["DP"] - bars["OD"] - bars["BP"] + bars["OB"]) / 2
f_c, f_p = bars["BC"] - bars["OB"], bars["BP"] - bars["OB"]
w_z = py * w_c - cy * w_p  # (B - D)_x times C x P
wx, z = bx - dx, cx * py - cy * px
by_bars = wx * cx * (px * f_c - cx * f_p) - cx * w_z * (2 * by - cy - py)
by_bars -= (cx - px) * (wx * px * bars["QC"] + cy * w_z)
assert sympy.expand(w_z - wx * z) == 0
assert sympy.expand(by_bars - wx * cx * (cx - px) * (5 * px - 40)) == 0
print("P is on the line x = 8")

# %% [markdown]
# ## Answer
#
# The chapter's mobilities are right: 3-PPRR 1 of 4, Sarrus 1, seven links 1 of 2. Wrong or missing are: the sets
# $\{B_i, R_{Bi}\}$ and $\{B_i, R_{Ci}\}$, which hold the 3-PPRR too; equation (21); the condition $a b \neq 0$; the
# reference of the seven-link mechanism to Fig. 10. And rank alone does not tell the finite mobility: away from the
# right angle the seven-link mechanism has two freedoms to the first order, and one in truth.
