# %% [markdown]
# # Why forty?
#
# A general six-legged platform with given leg lengths has 40 poses, counted over the complex numbers. *Where does the
# 40 come from, and where do the poses go when a symmetric robot has fewer?*
#
# The answer of this notebook: rigid motions form a projective variety $X$ of dimension 6 and degree 40, and each leg
# is a hyperplane. Six hyperplanes leave 40 points; some of them may lie at infinity.

# %%
from itertools import combinations_with_replacement, pairwise
from math import comb
from pathlib import Path
from random import Random

import matplotlib.pyplot as plt
from flint import fmpq, fmpq_mat, nmod_mat

from pkm_exact import Policy, Robot, read_robot, solve
from pkm_exact.algebra.modular_elimination import Elimination
from pkm_exact.algebra.primes import primes_from
from pkm_exact.formulations.base import over_integers, rational_ring
from pkm_exact.formulations.motion_variety import MOTION_COORDINATES, hyperplane, motion_quadrics
from pkm_exact.formulations.registry import formulation
from pkm_exact.geometry.rotation import quaternion_norm, scaled_rotation

root = next(folder for folder in (Path.cwd(), *Path.cwd().parents) if (folder / "models").is_dir())
policy = Policy()
prime = next(primes_from(policy.seed, policy.prime_bits))
random = Random(policy.seed)
euclidean = (1, 1, 1)
print("Hilbert functions below are computed modulo the prime", prime)

# %% [markdown]
# ## Legs are linear
#
# Expand $|C + RB - A|^2 = l^2$ and write $s = |C|^2$, $u = R^T C$, so that $C\cdot RB = u\cdot B$:
#
# $$(|A|^2 + |B|^2 - l^2)\,h + s - 2\,A\cdot C + 2\,B\cdot u - 2\,A^T R\,B = 0, \qquad h = 1.$$
#
# In the 17 homogeneous coordinates $(h : R : C : u : s)$ a leg is a hyperplane of $\mathbb P^{16}$. What
# is not linear has moved into the relations among the coordinates, and these are the same for all robots. They define
# $X$, the closure of the set of rigid motions (Gallet, Nawratil and Schicho, "Bond theory for pentapods and hexapods",
# J. Geometry 106, 2015).
#
# ## The quadrics of X
#
# The relations that come to mind are quadratic:
#
# * $R R^T = R^T R = h^2 I$ and $h R = \mathrm{cof}\,R$;
# * $R\,u = h\,C$, $R^T C = h\,u$, $C\cdot C = u\cdot u = s\,h$;
# * $C \times R e_j = R\,(u \times e_j)$: the vector product is carried along by the rotation.
#
# How many of them are independent, and are there more? Count from both sides: the rank of these quadrics, and the
# number of all quadrics that vanish at many random motions.

# %%
names = (*MOTION_COORDINATES, "h")
_, generators = rational_ring(names)
metric = [fmpq(g) for g in euclidean]
quadrics = over_integers(names, motion_quadrics(generators[:-1], generators[-1], metric)).polynomials


def monomials(count, degree):
    """Monomials of a degree, as sorted tuples of the numbers of their unknowns."""
    return list(combinations_with_replacement(range(count), degree))


def terms(polynomial):
    """Coefficients of a polynomial modulo the prime, by monomials as in ``monomials``."""
    return {
        tuple(i for i, exponent in enumerate(exponents) for _ in range(int(exponent))): int(value) % prime
        for exponents, value in polynomial.to_dict().items()
    }


def coefficient_matrix(polynomials, columns):
    position = {monomial: j for j, monomial in enumerate(columns)}
    entries = []
    for polynomial in polynomials:
        row = [0] * len(columns)
        for monomial, value in polynomial.items():
            row[position[monomial]] = value
        entries += row
    return nmod_mat(len(polynomials), len(columns), entries, prime)


rank = coefficient_matrix([terms(quadric) for quadric in quadrics], monomials(len(names), 2)).rank()
print(len(quadrics), "quadrics listed, of rank", rank)


# %%
def random_motion():
    """The coordinates of a random rigid motion, in the order of ``names`` and scaled by the norm of its quaternion."""
    quaternion = [random.randrange(prime) for _ in range(4)]
    C = [random.randrange(prime) for _ in range(3)]
    products = [[a * b for b in quaternion] for a in quaternion]
    h, R = quaternion_norm(products, euclidean), scaled_rotation(products, euclidean)
    u = [sum(R[i][j] * C[i] for i in range(3)) for j in range(3)]
    s = h * sum(c * c for c in C)
    return [value % prime for value in (*u, *(h * c for c in C), s, *R[0], *R[1], *R[2], h)]


def values_at(point, degree):
    """All monomials of a degree at a point."""
    values = []
    for monomial in monomials(len(point), degree):
        value = 1
        for i in monomial:
            value = value * point[i] % prime
        values.append(value)
    return values


def independent_functions(degree):
    """Rank of the monomials of a degree on random motions, as many as there are monomials."""
    count = len(monomials(len(names), degree))
    entries = [value for _ in range(count) for value in values_at(random_motion(), degree)]
    return nmod_mat(count, count, entries, prime).rank()


by_evaluation = [independent_functions(degree) for degree in (1, 2, 3)]
quadratic_monomials = len(monomials(len(names), 2))
print(f"{quadratic_monomials - by_evaluation[1]} of {quadratic_monomials} dimensions of quadrics vanish on X")
assert quadratic_monomials - by_evaluation[1] == rank == 37

# %% [markdown]
# So these are all: 37 quadrics. The number of independent forms of degree $d$ on $X$ is its Hilbert function. A
# Groebner basis (not repeated here) gives the Hilbert series
#
# $$\sum_d H_X(d)\,t^d = \frac{1 + 10 t + 18 t^2 + 10 t^3 + t^4}{(1 - t)^7},$$
#
# and the random motions confirm it as far as we looked. The exponent 7 says that $X$ has dimension 6; the numerator at
# $t = 1$ is the degree: $1 + 10 + 18 + 10 + 1 = 40$.

# %%
numerator = (1, 10, 18, 10, 1)
dimension = 6
by_series = [
    sum(value * comb(degree - k + dimension, dimension) for k, value in enumerate(numerator) if k <= degree)
    for degree in (1, 2, 3)
]
print("H_X(1), H_X(2), H_X(3) by evaluation", by_evaluation, "and by the series", by_series)
print("degree of X:", sum(numerator))
assert by_evaluation == by_series

# %% [markdown]
# ## Six legs: a linear section
#
# Six hyperplanes eliminate six of the 17 coordinates. What is left, for every robot, is 37 quadrics in ten unknowns and
# $h$: the formulation SE3 of this package. We look at its Macaulay matrices. The rows of the matrix of degree $d$ are
# the quadrics times all monomials of degree $d - 2$, the columns the monomials of degree $d$. The number of columns
# minus the rank, the *corank*, is the Hilbert function of the section.


# %%
def macaulay_corank(forms, count, degree):
    """Number of monomials of a degree minus the rank of the multiples of quadratic forms in that degree."""
    columns = monomials(count, degree)
    rows = [
        {tuple(sorted(monomial + factor)): value for monomial, value in form.items()}
        for form in forms
        for factor in monomials(count, degree - 2)
    ]
    return len(columns) - coefficient_matrix(rows, columns).rank()


def section(problem):
    """The quadratic forms of a robot's linear section of X, the number of unknowns, and the affine system."""
    system = formulation("SE3").formulate(problem).system
    h = len(system.unknowns)
    forms = [
        {monomial + (h,) * (2 - len(monomial)): value for monomial, value in terms(polynomial).items()}
        for polynomial in system.polynomials
    ]
    return forms, h + 1, system


DEGREES = (2, 3, 4)


def hilbert_function(forms, count):
    """The Hilbert function of quadratic forms in degrees 0 to 4."""
    return [1, count, *(macaulay_corank(forms, count, degree) for degree in DEGREES)]


def home(name):
    robot = read_robot(root / "models" / f"{name}.toml")
    return robot.problem(robot.configuration("home").lengths_squared)


rolland = home("rolland-6-6")
forms, count, _ = section(rolland)
on_section = hilbert_function(forms, count)
differences = [on_section[0], *(b - a for a, b in pairwise(on_section))]
print("Hilbert function of Rolland's robot:", on_section)
print("its differences:                    ", differences)

# %%
figure, (left, right) = plt.subplots(1, 2, figsize=(9, 3))
left.bar(range(len(on_section)), on_section)
left.axhline(sum(numerator), linestyle=":", color="black")
left.set(title="section by six legs", xlabel="degree", ylabel="independent forms")
right.bar(range(len(differences)), differences)
right.set(title="differences", xlabel="degree")
figure.tight_layout()

# %% [markdown]
# The differences are the numerator again. That is no accident of the robot. $X$ is Cohen-Macaulay, and so hyperplanes
# that cut its dimension down to 0 form a regular sequence: each one removes a factor $1 - t$ from the denominator of
# the Hilbert series, and the numerator stays. From degree 4 on there are exactly 40 independent forms, which is to say
# 40 points, counted with multiplicity.
#
# It is also why this formulation is fast. No combination of rows falls to a lower degree unforeseen: the elimination is
# over in degree 4, and its size is known before it starts.
#
# ## At most forty, proved
#
# Over the rationals there is more to use than a count modulo a prime. By the refined theorem of Bezout (Fulton,
# Intersection Theory, 12.3) the irreducible components of $X \cap H_1 \cap \dots \cap H_6$, of whatever dimension, have
# degrees that sum to at most $\deg X = 40$. So 40 distinct poses, each isolated because the Jacobian of the legs is
# regular there, are 40 components, and nothing is left: no further pose, no self-motion, no point at infinity.

# %%
solution = solve(rolland)
print(solution)
print("distinct complex poses:", solution.distinct_solutions, "  argument:", solution.completeness_route)

# %% [markdown]
# ## Where the others are
#
# The 40 counts points of the projective section, including those with $h = 0$, at infinity. They are no poses. Put
# $h = 0$ in the section. If there is no point at infinity, what remains has the Hilbert function 1, 10, 18, 10, 1 and
# nothing after it; other numbers show that there is one. How many solutions are finite says a Groebner basis.
#
# The robots compared are
#
# * Rolland's, a general one;
# * RoboCrane, two equilateral triangles whose corners carry two legs each;
# * a semi-regular hexagon on another one (the SSM type), exact in coordinates $y = \sqrt 3\,y'$, and the same robot
#   with $y$ rounded to a micron;
# * a planar robot whose platform is similar to its base.


# %%
robots = {
    "Rolland": rolland,
    "hexagons, rounded": home("ssm-rounded"),
    "hexagons, exact": home("ssm-exact"),
    "RoboCrane": home("robocrane-r"),
    "similar planar": home("similar-planar-s"),
}
rows = {}
for name, problem in robots.items():
    forms, count, system = section(problem)
    projective = on_section if problem is rolland else hilbert_function(forms, count)
    h = count - 1
    at_infinity = [{m: value for m, value in form.items() if h not in m} for form in forms]
    finite = Elimination(system, policy).image().dimension
    rows[name] = (projective, hilbert_function(at_infinity, h), finite)

print(f"{'robot':20}{'section':24}{'with h = 0':24}finite")
for name, (projective, infinite, finite) in rows.items():
    print(f"{name:20}{projective!s:24}{infinite!s:24}{finite}")

# %%
figure, axes = plt.subplots(figsize=(8, 3))
labels = list(rows)
finite = [rows[name][2] for name in labels]
axes.barh(labels, finite, label="finite")
axes.barh(
    labels, [sum(numerator) - value for value in finite], left=finite, color="lightgrey", label="lost at infinity"
)
axes.invert_yaxis()
axes.set(xlabel="solutions with multiplicity")
axes.legend(loc="upper left", bbox_to_anchor=(1, 1))
figure.tight_layout()

# %% [markdown]
# Three things can be read off.
#
# * Rolland's robot has nothing at infinity: its 40 are finite, and with $h = 0$ there remains 1, 10, 18, 10, 1.
# * The sections of the hexagons and of RoboCrane still have 40 points, but with $h = 0$ more remains: 4, 12 and 24 of
#   the 40 lie at infinity. Rounding $\sqrt 3$ brings eight of them back, from infinity to very far away: the count of
#   36, often printed for this type, belongs to rounded coordinates, not to the robot.
# * The similar planar robot has larger numbers, 40 and 44 in place of 39 and 40. Because $X$ is Cohen-Macaulay, that
#   can only mean that its section has a component of positive dimension, a curve or more. The finite solutions being 16
#   in number, it lies at infinity. Refined Bezout covers this case too: the component takes its degree from the 40.
#
# For such robots 40 isolated poses are not to be had. That their poses are complete the package proves by an
# elimination over the rationals instead:

# %%
symmetric = solve(robots["RoboCrane"])
print(symmetric)
print("distinct complex poses:", symmetric.distinct_solutions, "  argument:", symmetric.completeness_route)

# %% [markdown]
# ## When the robot can move
#
# Larger coranks may also mean a motion with locked legs. They show already in degrees 2 and 3, where general robots
# have 29 and 39. Two ways to it:


# %%
def describe(name, problem):
    forms, count, system = section(problem)
    rank = fmpq_mat([hyperplane(form) for form in problem.forms]).rank()
    coranks = [macaulay_corank(forms, count, degree) for degree in DEGREES[:2]]
    finite = Elimination(system, policy).image().dimension
    print(f"{name}: rank of the hyperplanes {rank}, coranks {coranks}, finite solutions {finite}")


def congruent_robot(joints, metric):
    """A robot whose platform is congruent to its base, with equal legs."""
    robot = Robot("congruent", "6-UPS", "1", "made up for this notebook", joints, joints, metric)
    return robot.problem([1] * 6)


general = read_robot(root / "models" / "mourrain-l.toml")
hexagon = read_robot(root / "models" / "ssm-exact.toml")
describe("congruent base and platform", congruent_robot(general.base_joints, general.metric))
describe("congruent hexagons on a circle", congruent_robot(hexagon.base_joints, hexagon.metric))

# %% [markdown]
# In the first, each translation by a vector of the legs' length is a pose: the six hyperplanes are independent and yet
# meet $X$ in a surface. In the second, the hyperplanes themselves are dependent, five do the work of six, and a curve
# at least must remain. Such a geometry is singular as a whole: with other lengths the same dependence between the legs
# mostly forces $h = 0$, and the robot cannot be assembled. ("None" stands for infinitely many.)
#
# Ranks modulo one prime are evidence, not proof: a rank over the rationals can only be larger. What this package calls
# proved rests on the argument with 40 isolated poses above, or on exact ranks.
#
# ## Answer
#
# Forty is the degree of the variety of rigid motions in $\mathbb P^{16}$, $1 + 10 + 18 + 10 + 1$, on which each leg is
# a hyperplane. A general robot finds all 40 at finite distance. A symmetric one has the same 40, but some of them are
# at infinity, and there they can even run together into curves.
