# %% [markdown]
# # Eleven ways to the same sixteen poses
#
# Rolland (2008) wrote the forward kinematics of a six-legged platform in ten ways and could solve his reference robot
# in five of them; three took a usable time. *What makes one formulation so much harder than another, if all describe
# the same poses?*
#
# This notebook solves that robot in all ten, and in an eleventh (SE3, linear on the variety of rigid motions), and
# looks at each stage: the system, its Groebner basis modulo a prime, the solutions, their univariate representation
# over the rationals. It runs for one to two minutes. With the environment variable `PKM_EXACT_QUICK=1` it takes four
# quick formulations only.

# %%
import os
from itertools import pairwise
from pathlib import Path

import matplotlib.pyplot as plt

from pkm_exact import Policy, read_robot, solve
from pkm_exact.algebra.equations import SystemEquations
from pkm_exact.algebra.lifting import lift_by_newton
from pkm_exact.algebra.modular_elimination import Elimination
from pkm_exact.algebra.rur import modular_representation
from pkm_exact.formulations.registry import formulation, formulation_codes

root = next(folder for folder in (Path.cwd(), *Path.cwd().parents) if (folder / "models").is_dir())
robot = read_robot(root / "models" / "rolland-6-6.toml")
problem = robot.problem(robot.configuration("home").lengths_squared)
policy = Policy(eliminate=True)  # SE3 as well, though poses prove themselves complete by their number

quick = os.environ.get("PKM_EXACT_QUICK") == "1"
codes = ("SE3", "AFD4", "AFD5", "AFP3") if quick else formulation_codes()
formulated = {code: formulation(code).formulate(problem) for code in codes}

# %% [markdown]
# ## The systems
#
# All are made primitive over the integers. "Digits" is the length of the longest coefficient, "size" the number of
# characters of the whole system written out.


# %%
def digits(system):
    return max(len(str(abs(int(value)))) for polynomial in system.polynomials for value in polynomial.coeffs())


def size(system):
    return sum(len(str(polynomial)) for polynomial in system.polynomials)


print(f"{'code':6}{'unknowns':>9}{'equations':>11}{'degree':>8}{'terms':>7}{'digits':>8}{'size':>8}")
for code in codes:
    system = formulated[code].system
    degree = max(int(polynomial.total_degree()) for polynomial in system.polynomials)
    terms = sum(len(polynomial.to_dict()) for polynomial in system.polynomials)
    print(
        f"{code:6}{len(system.unknowns):9}{len(system.polynomials):11}{degree:8}{terms:7}"
        f"{digits(system):8}{size(system):8}"
    )

# %%
figure, (left, right) = plt.subplots(1, 2, figsize=(10, 3.6))
left.bar(codes, [digits(formulated[code].system) for code in codes])
left.set(ylabel="digits", title="longest coefficient")
right.bar(codes, [size(formulated[code].system) / 1000 for code in codes])
right.set(ylabel="thousand characters", title="size of the system")
for axes in (left, right):
    axes.tick_params(axis="x", rotation=60)
figure.tight_layout()

# %% [markdown]
# Coordinates of the robot have six or seven digits. Products of two of them, as in $A\cdot RB$, have thirteen: that is
# what substitution alone costs, and where the displacement-based systems stay. AFP1, AFP2 and AFP3 pay for their frame:
# the constants $a, b, c$ of a joint are quotients of determinants, and enter squared. SE3 pays for having solved the
# legs for six coordinates, a 6 x 6 linear system. AFP4 and AFD6 keep small coefficients and low degree with more
# unknowns.
#
# So much for how a system looks. It says little about how hard it is: the longest coefficients belong to systems that
# are solved in no time, because the elimination works modulo primes and never sees a long number.
#
# ## Solving
#
# Each formulation is eliminated by itself. From its Groebner basis modulo a prime of 62 bits come the poses modulo that
# prime, and from these, lifted to the rationals and verified exactly, the boxes.

# %%
solutions = {code: solve(problem, formulation=code, policy=policy) for code in codes}

print(f"{'code':6}{'solutions':>10}{'poses, complex':>16}{'real':>6}{'basis':>7}{'seconds':>9}   claim")
for code, solution in solutions.items():
    statistics = solution.statistics
    print(
        f"{code:6}{statistics.quotient_dimension:10}{solution.complex_solutions:16}{len(solution.poses):6}"
        f"{statistics.basis_size:7}{sum(statistics.seconds.values()):9.1f}   {solution.claim.value}"
    )

reference = solutions[codes[0]]
assert all(solution.poses == reference.poses for solution in solutions.values())
print(f"all formulations give the same {len(reference.poses)} boxes")

# %%
BASIS = "Groebner basis"
figure, (left, right) = plt.subplots(1, 2, figsize=(10, 3.6))
left.bar(codes, [solutions[code].statistics.seconds[BASIS] for code in codes])
left.set(yscale="log", ylabel="seconds", title="Groebner basis modulo a prime")
bottom = [0.0] * len(codes)
for stage in (stage for stage in reference.statistics.seconds if stage != BASIS):
    heights = [solutions[code].statistics.seconds.get(stage, 0.0) for code in codes]
    right.bar(codes, heights, bottom=bottom, label=stage)
    bottom = [low + height for low, height in zip(bottom, heights, strict=True)]
right.set(ylim=(0, 2 * max(bottom)), ylabel="seconds", title="everything else")
right.legend(fontsize="small", loc="upper left", ncols=2)
for axes in (left, right):
    axes.tick_params(axis="x", rotation=60)
figure.tight_layout()

# %% [markdown]
# The formulations differ in one stage only, the Groebner basis. After it comes the same work for all: the poses are
# lifted in Study coordinates whatever the unknowns were before.
#
# ## What makes a basis hard
#
# The elimination treats critical pairs degree by degree, each batch in one matrix. The recorded trace shows the
# matrices that brought something new: their degree and their rank.

# %%
traces = {}
for code in codes:
    branch = formulated[code].branches[0]
    steps = Elimination(branch, policy).image(record=True).basis.recorded().trace.steps
    degree = branch.monomials.degree
    traces[code] = [(max(map(degree, step.leading)), len(step.rows), len(step.leading)) for step in steps]


def volume(steps):
    """Rows times rank, summed."""
    return sum(rows * rank for _, rows, rank in steps)


def falls(steps):
    """How often a matrix has no higher degree than the one before it: something of lower degree had turned up."""
    return sum(after[0] <= before[0] for before, after in pairwise(steps))


print(f"{'code':6}{'solutions':>10}{'entries':>10}{'falls':>7}   degrees of the matrices, in order")
for code, steps in sorted(traces.items(), key=lambda item: volume(item[1])):
    print(
        f"{code:6}{solutions[code].statistics.quotient_dimension:10}{volume(steps):10}{falls(steps):7}   "
        + " ".join(str(degree) for degree, _, _ in steps)
    )

# %%
hardest_first = sorted(codes, key=lambda code: volume(traces[code]), reverse=True)
figure, (left, right) = plt.subplots(1, 2, figsize=(10, 3.6), sharey=True)
left.barh(hardest_first, [volume(traces[code]) for code in hardest_first])
left.set(xscale="log", title="entries of all matrices")
right.barh(hardest_first, [max(rank for _, _, rank in traces[code]) for code in hardest_first])
right.set(title="rank of the largest matrix")
figure.tight_layout()

# %% [markdown]
# Three causes can be told apart.
#
# * **Unwanted solutions.** AFD1, AFD2, AFD3, AFD5 and AFD6 have 80 where the others have 40: two
#   triples of angles, a reflection, or the two signs of a quaternion. (AFP4 would have 320; it is split by chirality
#   before it is solved.) Not all covers cost the same. Quaternions enter with even degree only, which keeps monomials
#   apart and the matrices of AFD5 and AFD6 small. The reflections of AFD3 are poses of another robot, and cost what a
#   second robot costs.
# * **Degree falls.** After a fall the elimination goes back and multiplies up again what it has just found. SE3 has
#   none: its matrices climb through degrees 3, 4, 5 and that is all. AFD4 does better than AFD3 also because the
#   quadrics of $R^T R = I$ and $R = \mathrm{cof}\,R$, which AFD3 must find first, are given. The Euler angles of AFD1
#   and AFD2 start from legs of degree 4 and fall again and again. The recombination of AFP3, on the other hand, which
#   made the difference to AFP1 in the source, is no more than what this elimination finds in its first steps: the
#   matrices are nearly the same.
# * **Unwanted components.** The cleared legs of AFD2, of degree 8, vanish on whole sets where $1 + t_j^2 = 0$, so that
#   the system as it stands has infinitely many solutions: an elimination that counts on finitely many does not end. It
#   is solved localised, with six more unknowns, and still has far the largest matrices.
#
# ## Over the rationals
#
# A solution over the rationals is a univariate polynomial $h(T)$ and numerators $n_i(T)$ such that the unknowns are
# $x_i = n_i / h'$ at its roots. Here the coefficients do become long. As the engine chooses the parameter among the
# quaternion coordinates of the *poses*, all formulations end with the same representation:


# %%
def bits(polynomial):
    return max(abs(int(value)).bit_length() for value in polynomial)


def kilobytes(univariate):
    """Size of h and of all numerators in binary."""
    coefficients = [value for polynomial in (univariate.eliminant, *univariate.numerators) for value in polynomial]
    return sum(value.bit_length() for value in coefficients) / 8 / 1024


assert all(solution.representation == reference.representation for solution in solutions.values())
pose_level = reference.representation.univariate
print(f"of the poses: degree {pose_level.degree}, h has coefficients of {bits(pose_level.primitive_polynomial)} bits")

# %% [markdown]
# And if one stays with the unknowns of the formulation? For some of them, one of each kind, this is done below: the
# parameter is the first unknown that takes different values at all solutions, and the system itself is lifted.


# %%
def own_representation(code):
    """The representation of a formulation's solutions in its own unknowns."""
    system = formulated[code].branches[0]
    algebra = Elimination(system, policy).image().algebra
    size = len(system.unknowns)
    coordinates = [algebra.element(([system.monomials.unknown(index)], [1])) for index in range(size)]
    for index, coordinate in enumerate(coordinates):
        modular = modular_representation(algebra, coordinate, coordinates)
        if modular.degree == algebra.dimension:
            form = [int(k == index) for k in range(size)]
            equations = SystemEquations(system, policy.seed)
            return system.unknowns[index], lift_by_newton(equations, form, modular, policy.lifting_bits)
    raise AssertionError(f"no unknown of {code} separates its solutions")


kinds = ("AFD5", "AFP3") if quick else ("AFD5", "AFD6", "AFP3", "AFD4")
own = {code: own_representation(code) for code in kinds}
assert not any(own["AFD5"][1].eliminant[1::2])  # h is even: with a quaternion its negative is a solution
rows = [("poses", "half angle", pose_level), *((code, unknown, value) for code, (unknown, value) in own.items())]
print(f"{'of':7}{'parameter':12}{'degree':>7}{'bits of h':>11}{'kilobytes':>11}")
for name, parameter, univariate in rows:
    print(
        f"{name:7}{parameter:12}{univariate.degree:7}{bits(univariate.primitive_polynomial):11}{kilobytes(univariate):11.0f}"
    )

# %%
figure, (left, right) = plt.subplots(1, 2, figsize=(10, 3.2))
labels = [f"{name}\n({parameter})" for name, parameter, _ in rows]
left.bar(labels, [bits(univariate.primitive_polynomial) for *_, univariate in rows])
left.set(ylabel="bits", title="coefficients of h")
right.bar(labels, [kilobytes(univariate) for *_, univariate in rows])
right.set(ylabel="kilobytes", title="whole representation")
figure.tight_layout()

# %% [markdown]
# What counts is the parameter. A position or an entry of $R$ has numerators and denominators about twice as long as a
# quotient of quaternion coordinates, the tangent of a half angle: rotation matrices are quadratic in quaternions. The
# double covers have degree 80, but $h$ is even, so that half of its coefficients are zero. (AFD3 has no such luck: its
# 40 reflections are the poses of another, mirrored robot, and its $h$ is the product of two polynomials of degree 40
# that have nothing to do with each other, twice the degree and twice the length.)
#
# ## Answer
#
# The formulations differ in the work up to the Groebner basis, and there by three things: solutions that are no poses,
# degree falls, and unwanted components. The length of the input coefficients matters little to a modular
# elimination, and the length of the output does not depend on the formulation, once the result is stated for the poses.
# None of the ten is out of reach. The smallest matrices belong to those that give the elimination from the start what
# it would otherwise have to find: the rotation group's own basis (AFD4), or a variety on which nothing is left to be
# found (SE3).
