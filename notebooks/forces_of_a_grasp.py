# %% [markdown]
# # How many forces of a grasp move nothing?
#
# Chapter 20 of *Parallel Manipulators: Towards New Applications* (2008) takes the human hand for a parallel machine:
# five digits that hold a handle. *How many of their forces are internal, and do the printed ranges fit the motions?*
# All ranks are exact.

# %%
from fractions import Fraction

import matplotlib.pyplot as plt
import numpy as np

from pkm_exact.polytopes.rationals import rational_matrix
from pkm_exact.statics.grasp import Contact, grasp_matrix, internal_forces, is_closed_by_friction

ZERO, ONE = Fraction(0), Fraction(1)
THUMB = ((Fraction(-3), Fraction(1)), (ONE, ZERO))
FINGERS = [((Fraction(3), Fraction(y)), (-ONE, ZERO)) for y in (5, 2, -1, -4)]


def grasp(*, has_moment):
    """Thumb on the left, four fingers on the right, in centimetres."""
    return [Contact(point, normal, has_moment) for point, normal in (THUMB, *FINGERS)]


# %% [markdown]
# ## Nullities
#
# In the plane the grasp matrix of five digits is 3 x 10, of rank 3: 7 internal forces. With moments where contacts
# migrate it is 3 x 15: 12. In space with five soft fingers, each three forces and a turn about the normal, 6 x 30 is
# printed for full wrenches: 24.

# %%
for has_moment, width, count in ((False, 10, 7), (True, 15, 12)):
    rows = grasp_matrix(grasp(has_moment=has_moment))
    basis = internal_forces(grasp(has_moment=has_moment))
    print(f"3 x {len(rows[0])}: rank {rational_matrix(rows).rank()}, {len(basis)} internal forces")
    assert (len(rows[0]), rational_matrix(rows).rank(), len(basis)) == (width, 3, count)
    for vector in basis:
        assert all(sum(a * b for a, b in zip(row, vector, strict=True)) == 0 for row in rows)

spatial = [[ZERO] * 30 for _ in range(6)]
for digit, (point, _) in enumerate((THUMB, *FINGERS)):
    x, y = point
    for k in range(6):
        spatial[k][6 * digit + k] = ONE
    # Moments of the forces about the origin, at (x, y, 0).
    for row, column, value in ((3, 2, y), (4, 2, -x), (5, 0, -y), (5, 1, x)):
        spatial[row][6 * digit + column] = value
print("6 x 30: rank", rational_matrix(spatial).rank())
assert 30 - rational_matrix(spatial).rank() == 24

# %% [markdown]
# ## Thumb and virtual finger
#
# Four fingers as one: 3 x 6, so 3 internal forces, with moments at the contacts: the grip, opposite moments, and a
# tangential couple. Without moments there is one, the grip: the 3 of the chapter depends on the model of the
# contacts.

# %%
pair = [(THUMB[0], THUMB[1]), ((Fraction(3), ONE), (-ONE, ZERO))]
for has_moment, count in ((True, 3), (False, 1)):
    basis = internal_forces([Contact(point, normal, has_moment) for point, normal in pair])
    print("with moments:" if has_moment else "without:", len(basis))
    assert len(basis) == count

# %% [markdown]
# ## Friction
#
# Whether the grasp bears every load is decided exactly. Two opposite digits do with any friction; without any none of
# these grasps does.

# %%
assert is_closed_by_friction([Contact(point, normal) for point, normal in pair], Fraction(1, 100))
assert not is_closed_by_friction(grasp(has_moment=False), ZERO)

# %% [markdown]
# ## Printed ranges
#
# A weight $W$ that is shaken by $\pm g / 2$ loads the digits with $W (1 \pm 1/2)$: 4.4 to 13.2 N for 8.8 N, as
# printed. The internal force of figure 8 is said to range by about 8.0 N, from 12.0 to 21.0 N: that is 9.

# %%
weight = Fraction("8.8")
assert (weight / 2, weight * 3 / 2) == (Fraction("4.4"), Fraction("13.2"))
assert Fraction("21.0") - Fraction("12.0") == 9
assert (6 * 5 * 3, 6 * 5 * 5) == (90, 150)
time = np.linspace(0, 2, 400)
plt.plot(time, float(weight) * (1 + 0.5 * np.sin(2 * np.pi * 1.5 * time)), label="8.8 N at 1.5 Hz, as in figure 7")
plt.plot(time, 11.3 * (1 + 0.5 * np.sin(2 * np.pi * 3 * time)), label="11.3 N at 3 Hz, as in figure 8")
plt.xlabel("time [s]")
plt.ylabel("load [N]")
plt.legend()

# %% [markdown]
# ## Answer
#
# 7 of 10 in the plane, 12 of 15 with moments, 24 of 30 in space, as printed; 3 for thumb and virtual finger only if
# contacts have moments. One printed range is 8.0 N for 9.
