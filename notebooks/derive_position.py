# %% [markdown]
# # From three points to AFP1, ..., AFP4
#
# A rigid platform is where three of its points are. Instead of a position and a rotation one may take as unknowns the
# joints themselves, $P_i = C + R\,B_i$.
#
# *How do the legs $|P_i - A_i|^2 = l_i^2$ become the four position-based systems of the literature (Rolland 2008,
# section 4.2), are the polynomials of this package those systems, and why has the last one 320 solutions?*
#
# As in the companion on the displacement-based systems, each section ends in an identity check against the package on
# Mourrain's general 6-6, whose coordinates are small fractions.

# %%
from itertools import combinations
from pathlib import Path

import sympy as sp

from pkm_exact import Policy, read_robot
from pkm_exact.algebra.modular_elimination import Elimination
from pkm_exact.formulations.registry import formulation

root = next(folder for folder in (Path.cwd(), *Path.cwd().parents) if (folder / "models").is_dir())
robot = read_robot(root / "models" / "mourrain-l.toml")
problem = robot.problem(robot.configuration("home").lengths_squared)


def exact(value):
    return sp.Rational(value.numerator, value.denominator)


A = [sp.Matrix([exact(value) for value in leg.base]) for leg in problem.distances]
B = [sp.Matrix([exact(value) for value in leg.platform]) for leg in problem.distances]
squared_length = [exact(leg.length_squared) for leg in problem.distances]


# %%
def to_sympy(system):
    """The polynomials of a package system, term by term."""
    symbols = sp.symbols(system.unknowns)
    return [
        sp.Poly({tuple(map(int, exponents)): int(value) for exponents, value in polynomial.to_dict().items()}, *symbols)
        for polynomial in system.polynomials
    ]


def matches(code, derived, system):
    """Whether each package polynomial is a constant times the derived one."""
    symbols = sp.symbols(system.unknowns)
    ours = [sp.Poly(expression, *symbols, domain="QQ") for expression in derived]
    theirs = [polynomial.set_domain("QQ") for polynomial in to_sympy(system)]
    same = len(ours) == len(theirs) and all(p.monic() == q.monic() for p, q in zip(ours, theirs, strict=True))
    degrees = [polynomial.total_degree() for polynomial in theirs]
    terms = sum(len(polynomial.terms()) for polynomial in theirs)
    print(f"{code}: degrees {degrees}, {terms} terms; identical up to constants: {same}")
    assert same
    return dict(code=code, unknowns=len(symbols), equations=len(theirs), degrees=degrees, terms=terms)


summary = []

# %% [markdown]
# ## A frame on three joints
#
# Let joints 1, 2, 3 of the platform not be collinear. They span the frame
#
# $$u_1 = B_2 - B_1, \qquad u_2 = B_3 - B_1, \qquad u_3 = u_1 \times u_2,$$
#
# in which every joint has three constants: $B_k - B_1 = a_k u_1 + b_k u_2 + c_k u_3$. The source normalises $u_1$ and
# $u_2$. That puts square roots into the constants, and exact arithmetic would need a number field. Left as they are,
# the vectors give *rational* constants by a linear system.

# %%
u1, u2 = B[1] - B[0], B[2] - B[0]
u3 = u1.cross(u2)
frame = sp.Matrix.hstack(u1, u2, u3)
constants = [tuple(frame.solve(joint - B[0])) for joint in B]
print("|u1|, |u2|, |u3| =", u1.norm(), u2.norm(), u3.norm())
for k, (a, b, c) in enumerate(constants, 1):
    print(f"joint {k}: a = {a}, b = {b}, c = {c}")

# %% [markdown]
# A rotation takes $u_1, u_2, u_3$ to
#
# $$v_1 = P_2 - P_1, \qquad v_2 = P_3 - P_1, \qquad v_3 = v_1 \times v_2,$$
#
# the last because rotations preserve vector products (reflections do not: here is where the determinant is fixed).
# Hence $P_k = P_1 + a_k v_1 + b_k v_2 + c_k v_3$ for all six joints: nine unknowns determine everything.

# %%
P = [sp.Matrix(sp.symbols(f"x{i} y{i} z{i}")) for i in (1, 2, 3)]
v1, v2 = P[1] - P[0], P[2] - P[0]
v3 = v1.cross(v2)


def leg(k):
    """|P_1 + a v1 + b v2 + c v3 - A|^2 - l^2."""
    a, b, c = constants[k]
    difference = P[0] + a * v1 + b * v2 + c * v3 - A[k]
    return sp.expand(difference.dot(difference) - squared_length[k])


leg_equations = [leg(k) for k in range(6)]

# %% [markdown]
# ## AFP1: three distances
#
# The three points are those of the platform, moved, exactly when their distances are right. Three distances complete
# the six legs. A leg is quadratic if its joint lies in the plane of the three points, and quartic if $c_k \ne 0$, since
# $v_3$ is quadratic itself. (The source calls all nine equations quadratic. That holds for planar platforms.)


# %%
def distance(i, j):
    edge = P[i] - P[j]
    return sp.expand(edge.dot(edge) - (B[i] - B[j]).dot(B[i] - B[j]))


afp1 = leg_equations + [distance(i, j) for i, j in combinations(range(3), 2)]
summary.append(matches("AFP1", afp1, formulation("AFP1").formulate(problem).system))

# %% [markdown]
# ## AFP2: two distances and a scalar product
#
# Write the constraints as $C_7 = |v_1|^2 - |u_1|^2$, $C_8 = |v_2|^2 - |u_2|^2$, $C_9 = v_1\cdot v_2 - u_1\cdot u_2$.
# (The source prints a vector product on the right of the last one.) Because $P_3 - P_2 = v_2 - v_1$, the third
# distance of AFP1 is $C_7 + C_8 - 2\,C_9$: both systems generate the same ideal and have the same solutions.

# %%
d7, d8, d9 = u1.dot(u1), u2.dot(u2), u1.dot(u2)
C7, C8, C9 = (sp.expand(value) for value in (v1.dot(v1) - d7, v2.dot(v2) - d8, v1.dot(v2) - d9))
assert sp.expand(distance(1, 2) - (C7 + C8 - 2 * C9)) == 0

summary.append(matches("AFP2", [*leg_equations, C7, C8, C9], formulation("AFP2").formulate(problem).system))

# %% [markdown]
# ## AFP3: recombination
#
# The quartic legs can be brought down. The first three legs say what $|P_i|^2$ is, namely something linear:
#
# $$F_i = |P_i|^2 - L_{ii}, \qquad L_{ii} = 2 A_i\cdot P_i - |A_i|^2 + l_i^2, \qquad i = 1, 2, 3.$$
#
# With it the distance between $P_i$ and $P_j$ says what $P_i\cdot P_j$ is, again something linear: from
# $|P_i - P_j|^2 = d_{ij}$ follows $P_i\cdot P_j = L_{ij} := (L_{ii} + L_{jj} - d_{ij})/2$. As an identity between
# polynomials, each new equation is a combination of old ones:

# %%
F = [leg_equations[i] for i in range(3)]
L = sp.zeros(3)
for i in range(3):
    L[i, i] = sp.expand(P[i].dot(P[i]) - F[i])
recombined = []
for i, j in combinations(range(3), 2):
    L[i, j] = L[j, i] = sp.expand((L[i, i] + L[j, j] - (B[i] - B[j]).dot(B[i] - B[j])) / 2)
    assert sp.Poly(L[i, j], *P[0], *P[1], *P[2]).total_degree() == 1
    recombined.append(sp.expand(P[i].dot(P[j]) - L[i, j]))
    assert sp.expand(2 * recombined[-1] - (F[i] + F[j] - distance(i, j))) == 0
print("P_i.P_j - L_ij = (F_i + F_j - distance_ij) / 2")

# %% [markdown]
# Now take a quartic leg apart. Let $Q = P_1 + a v_1 + b v_2 = w_1 P_1 + w_2 P_2 + w_3 P_3$ with the weights $w = (1 - a
# - b,\, a,\, b)$ be the foot of the joint in the plane of the three points. Since $v_3$ is perpendicular to $v_1$ and
# $v_2$,
#
# $$|Q + c\,v_3 - A|^2 = |Q|^2 - 2 A\cdot Q + 2c\,(v_3\cdot P_1 - v_3\cdot A) + c^2 |v_3|^2 + |A|^2 .$$
#
# * $|Q|^2 = \sum w_i w_j\, P_i\cdot P_j$ becomes linear, by the equations just found.
# * $v_3\cdot P_1 = \det(P_1, P_2, P_3)$ has degree 3 and stays.
# * $|v_3|^2$, the quartic part, becomes the constant $|u_3|^2$: by Lagrange's identity
#   $|v_3|^2 = |v_1|^2 |v_2|^2 - (v_1\cdot v_2)^2$, hence
#   $|v_3|^2 - |u_3|^2 = C_7\,|v_2|^2 + d_7\,C_8 - C_9\,(v_1\cdot v_2 + d_9)$, which vanishes with $C_7, C_8, C_9$.

# %%
assert sp.expand(v3.dot(P[0]) - sp.Matrix.hstack(*P).det()) == 0
assert u3.dot(u3) == d7 * d8 - d9**2
height = sp.expand(v3.dot(v3) - u3.dot(u3))
assert sp.expand(height - (C7 * v2.dot(v2) + d7 * C8 - C9 * (v1.dot(v2) + d9))) == 0


def reduced_leg(k):
    """A leg with everything replaced that the other equations know."""
    a, b, c = constants[k]
    weights = sp.Matrix([1 - a - b, a, b])
    foot = sum((weights[i] * P[i] for i in range(3)), sp.zeros(3, 1))
    linear = (weights.T * L * weights)[0] - 2 * A[k].dot(foot)
    cubic = 2 * c * v3.dot(P[0] - A[k])
    return sp.expand(linear + cubic + c**2 * u3.dot(u3) + A[k].dot(A[k]) - squared_length[k])


equations_of_dots = F + recombined
pairs = [(0, 0), (1, 1), (2, 2), *combinations(range(3), 2)]
for k in (3, 4, 5):
    a, b, c = constants[k]
    weights = (1 - a - b, a, b)
    removed = c**2 * height
    for (i, j), equation in zip(pairs, equations_of_dots, strict=True):
        removed += (1 if i == j else 2) * weights[i] * weights[j] * equation
    assert sp.expand(leg_equations[k] - reduced_leg(k) - removed) == 0
print("each reduced leg is the leg minus a combination of the other equations")

# %% [markdown]
# Every step is invertible, so AFP1, AFP2 and AFP3 have one and the same ideal. But AFP3 hands the elimination six
# quadrics and three sparse cubics instead of quartics: a part of the Groebner basis computation, done once and by hand.

# %%
afp3 = F + recombined + [reduced_leg(k) for k in (3, 4, 5)]
summary.append(matches("AFP3", afp3, formulation("AFP3").formulate(problem).system))

# %% [markdown]
# ## AFP4: all six points
#
# With all six joints as unknowns nothing needs to be expressed: six legs and twelve distances, namely those among
# joints 1, 2, 3 and those from each of them to joints 4, 5, 6. That makes 18 quadrics in 18 unknowns, very sparse.

# %%
P6 = P + [sp.Matrix(sp.symbols(f"x{i} y{i} z{i}")) for i in (4, 5, 6)]


def distance6(i, j):
    edge = P6[i] - P6[j]
    return sp.expand(edge.dot(edge) - (B[i] - B[j]).dot(B[i] - B[j]))


afp4 = [sp.expand((point - a).dot(point - a) - s) for point, a, s in zip(P6, A, squared_length, strict=True)]
afp4 += [distance6(i, j) for i, j in [*combinations(range(3), 2), *((i, k) for k in (3, 4, 5) for i in range(3))]]
formulated = formulation("AFP4").formulate(problem)
summary.append(matches("AFP4", afp4, formulated.system))

# %% [markdown]
# ### Mirror images
#
# Distances do not see on which side of the plane $P_1 P_2 P_3$ a joint lies. Let $w_k = P_k - P_1 - a_k v_1 - b_k v_2$
# be what joint $k$ has beyond its foot. The distances of $P_k$ from the three points give, as identities modulo the
# other equations,
#
# $$w_k\cdot v_1 = 0, \qquad w_k\cdot v_2 = 0, \qquad |w_k|^2 = c_k^2\,|v_3|^2 .$$
#
# The first two say that $w_k$ is a multiple of $v_3$ (which is not 0: $|v_3|^2 = |u_3|^2$), the third that the multiple
# is $+c_k$ or $-c_k$.

# %%
for k in (3, 4, 5):
    a, b, c = constants[k]
    to_point = P6[k] - P6[0]
    w = to_point - a * v1 - b * v2
    along_v1 = (distance6(0, k) - distance6(1, k) + C7) / 2
    along_v2 = (distance6(0, k) - distance6(2, k) + C8) / 2
    assert sp.expand(w.dot(v1) - (along_v1 - a * C7 - b * C9)) == 0
    assert sp.expand(w.dot(v2) - (along_v2 - a * C9 - b * C8)) == 0
    square = distance6(0, k) - 2 * a * along_v1 - 2 * b * along_v2 + a**2 * C7 + b**2 * C8 + 2 * a * b * C9
    assert sp.expand(w.dot(w) - c**2 * v3.dot(v3) - (square - c**2 * height)) == 0
print("the three identities hold for joints 4, 5 and 6")

# %% [markdown]
# Three joints with a choice of two signs each: the solutions fall into $2^3 = 8$ families. A family with minus signs is
# a robot too, one whose joints have been moved to their mirror images, and has 40 solutions like every general robot.
# Hence $8 \cdot 40 = 320$, of which only the family $(+, +, +)$ belongs to the rigid platform. The package joins $w_k =
# \pm c_k v_3$ to the 18 quadrics and counts each family by itself.

# %%
sign_choices = [(s4, s5, s6) for s4 in (1, -1) for s5 in (1, -1) for s6 in (1, -1)]
policy = Policy()
counts = [Elimination(branch, policy).image().dimension for branch in formulated.branches]
for signs, count in zip(sign_choices, counts, strict=True):
    print("signs of c4, c5, c6:", " ".join(f"{sign:+d}" for sign in signs), "  solutions:", count)
print("together:", sum(counts))

# %% [markdown]
# That the families are the ones named, and in this order, is checked once more as an identity.

# %%
for signs, branch in zip(sign_choices, formulated.branches, strict=True):
    split = []
    for sign, k in zip(signs, (3, 4, 5), strict=True):
        a, b, c = constants[k]
        split += list(P6[k] - P6[0] - a * v1 - b * v2 - sign * c * v3)
    ours = [sp.Poly(expression, *sp.symbols(branch.unknowns), domain="QQ").monic() for expression in afp4 + split]
    assert ours == [polynomial.set_domain("QQ").monic() for polynomial in to_sympy(branch)]
print("all eight branches are the split systems")

# %% [markdown]
# ## Answer
#
# Substituting points instead of a rotation gives four systems, and the identities above show that the package's
# polynomials are these.

# %%
print(f"{'code':6}{'unknowns':>9}{'equations':>11}{'terms':>8}   degrees")
for row in summary:
    degrees = ", ".join(f"{row['degrees'].count(d)} of degree {d}" for d in sorted(set(row["degrees"])))
    print(f"{row['code']:6}{row['unknowns']:9}{row['equations']:11}{row['terms']:8}   {degrees}")

# %% [markdown]
# * AFP1 and AFP2 are the same ideal, by $|v_2 - v_1|^2 = |v_1|^2 + |v_2|^2 - 2\,v_1\cdot v_2$.
# * AFP3 is that ideal again, with the legs of joints 4, 5, 6 reduced from quartics to cubics by the other equations.
# * AFP4 has 320 solutions because distances do not distinguish three of its joints from their mirror images: eight
#   robots of 40 poses in one system. A planar platform has $c_k = 0$: its joints are their own mirror images, the eight
#   families coincide, and the 18 quadrics count each solution several times.
#
# In AFP1, AFP2 and AFP3 no reflection can enter: $v_3$ is a vector product, and its sign is fixed.
