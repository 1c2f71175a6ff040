# %% [markdown]
# # From one vector equation to AFD1, ..., AFD6
#
# A leg of length $l$ joins the base joint $A$ to the platform joint $B$. The platform stands at the position $C$ with
# the rotation $R$ exactly when, for each of the six legs,
#
# $$|C + R\,B - A|^2 = l^2. \tag{1}$$
#
# *How does this one equation become the six displacement-based systems of the literature
# (Rolland 2008, section 4.1), and are the polynomials of this package those systems?*
#
# Every section below derives one system with sympy and ends in an identity check: the package's polynomials, converted
# term by term, must equal the derived ones up to a constant factor. The robot of the checks is Mourrain's general 6-6,
# whose coordinates are small fractions.

# %%
from pathlib import Path

import sympy as sp

from pkm_exact import read_robot
from pkm_exact.formulations.registry import formulation

root = next(folder for folder in (Path.cwd(), *Path.cwd().parents) if (folder / "models").is_dir())
robot = read_robot(root / "models" / "mourrain-l.toml")
problem = robot.problem(robot.configuration("home").lengths_squared)


def exact(value):
    return sp.Rational(value.numerator, value.denominator)


A = [sp.Matrix([exact(value) for value in leg.base]) for leg in problem.distances]
B = [sp.Matrix([exact(value) for value in leg.platform]) for leg in problem.distances]
squared_length = [exact(leg.length_squared) for leg in problem.distances]
legs = range(len(problem.distances))

# %% [markdown]
# ## The check
#
# The package keeps its systems over the integers and primitive, so a derived polynomial may differ from its
# counterpart by a constant. `matches` compares whole systems, in order, and prints one line for the summary.


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
    degrees = sorted({polynomial.total_degree() for polynomial in theirs}, reverse=True)
    terms = sum(len(polynomial.terms()) for polynomial in theirs)
    print(
        f"{code}: {len(theirs)} polynomials in {len(symbols)} unknowns, degrees {degrees}, {terms} terms; "
        f"identical up to constants: {same}"
    )
    assert same
    return dict(code=code, unknowns=len(symbols), equations=len(theirs), degrees=degrees, terms=terms)


summary = []

# %% [markdown]
# ## Expanding the vector equation
#
# With the square multiplied out, (1) reads
#
# $$|C|^2 + 2\,C\cdot RB - 2\,A\cdot C - 2\,A\cdot RB + |A|^2 + |B|^2 - l^2 = 0, \tag{2}$$
#
# where $|RB|^2$ has been replaced by $|B|^2$. This is the only step that uses that $R$ is a rotation: for a matrix of
# unknowns the two sides differ by $B^T (R^T R - I)\,B$, as the next cell confirms. Printed versions of (2) often lack
# the factor 2 of the mixed term $C\cdot RB$, and have $l$ in place of $l^2$; a check like this one finds such slips.

# %%
C = sp.Matrix(sp.symbols("c1:4"))
R = sp.Matrix(3, 3, sp.symbols("r11:14 r21:24 r31:34"))
identity = sp.eye(3)


def leg_equation(a, b, square, position, turned, unit=1):
    """Equation (2) for R B = turned / unit, times the unit."""
    constant = a.dot(a) + b.dot(b) - square
    at_rest = position.dot(position) - 2 * a.dot(position) + constant
    return sp.expand(unit * at_rest + 2 * (position - a).dot(turned))


a, b, length = sp.Matrix(sp.symbols("a1:4")), sp.Matrix(sp.symbols("b1:4")), sp.Symbol("l")
difference = C + R * b - a
vector_equation = difference.dot(difference) - length**2
orthogonality = (b.T * (R.T * R - identity) * b)[0]
assert sp.expand(vector_equation - leg_equation(a, b, length**2, C, R * b) - orthogonality) == 0
print("(1) - (2) = B.(R^T R - I) B")


# %%
def legs_with(rotation, unit=1):
    """The six legs for a rotation matrix, or for unit * R."""
    return [leg_equation(A[i], B[i], squared_length[i], C, rotation * B[i], unit) for i in legs]


# %% [markdown]
# In (2) the rotation matrix enters linearly. All six systems are (2) with a different way to say what a rotation is.
#
# ## AFD3: nine entries and $R R^T = I$
#
# The unknowns are $C$ and the entries of $R$; the upper triangle of $R R^T = I$ gives six more quadrics. It forces
# $\det R = \pm 1$ only, so that reflections solve the system too: half of its 80 solutions are not rigid motions.

# %%
orthonormal = R * R.T - identity
upper = [(i, j) for i in range(3) for j in range(i, 3)]
afd3 = legs_with(R) + [orthonormal[i, j] for i, j in upper]
summary.append(matches("AFD3", afd3, formulation("AFD3").formulate(problem).system))

# %%
signs = sp.diag(1, 1, -1)
assert signs * signs.T == identity
print("diag(1, 1, -1) satisfies R R^T = I; its determinant is", signs.det())

# %% [markdown]
# ## AFD4: nine entries and a Groebner basis of the rotation group
#
# Besides $R R^T = I$, rotations satisfy $R^T R = I$ and $R = \mathrm{cof}\,R$ (each entry equals its cofactor, which
# excludes reflections). These are 21 quadrics, but not independent: both traces of orthogonality are
# $\sum r_{ij}^2 - 3$. Linear algebra on their coefficients leaves 20, and these 20 are already a reduced Groebner basis
# for the degree reverse lexicographic order. It does not depend on the robot.

# %%
relations = [(R * R.T - identity)[i, j] for i, j in upper] + [(R.T * R - identity)[i, j] for i, j in upper]
relations += list(R - R.cofactor_matrix())
entries = list(R)
polynomials = [sp.Poly(relation, *entries) for relation in relations]
order = sp.polys.orderings.monomial_key("grevlex")
monomials = sorted({monomial for p in polynomials for monomial in p.monoms()}, key=order, reverse=True)
echelon, pivots = sp.Matrix([[p.coeff_monomial(m) for m in monomials] for p in polynomials]).rref()
quadrics = [
    sp.Poly({m: echelon[row, j] for j, m in enumerate(monomials) if echelon[row, j] != 0}, *entries)
    for row in range(len(pivots))
]
print(len(relations), "relations of rank", len(quadrics))
print("coefficients:", sorted({value for quadric in quadrics for value in quadric.coeffs()}))

# %%
basis = sp.groebner([quadric.as_expr() for quadric in quadrics], *entries, order="grevlex")
assert set(basis.polys) == set(quadrics)
print("the reduced Groebner basis consists of these", len(basis.polys), "quadrics")

afd4 = legs_with(R) + [quadric.as_expr() for quadric in quadrics]
summary.append(matches("AFD4", afd4, formulation("AFD4").formulate(problem).system))

# %% [markdown]
# The standard monomials of this basis, those that no leading monomial divides, count the functions on the rotation
# group: $(2d + 1)^2$ in degree exactly $d$, the spherical harmonics on the 3-sphere of even degree $2d$.

# %%
leading = [max(quadric.monoms(), key=order) for quadric in quadrics]


def standard_monomials(degree):
    """Number of monomials of the degree that are divisible by no leading monomial."""
    candidates = sp.itermonomials(entries, degree, degree)
    exponents = (sp.Poly(candidate, *entries).monoms()[0] for candidate in candidates)
    return sum(not any(all(map(int.__le__, lead, m)) for lead in leading) for m in exponents)


counts = [standard_monomials(degree) for degree in range(4)]
assert counts == [(2 * degree + 1) ** 2 for degree in range(4)]
print("standard monomials of degree 0, 1, 2, 3:", counts)

# %% [markdown]
# ## AFD1: cosines and sines of three angles
#
# Rotations about the coordinate axes are multiplied; the package's default convention "zyx" are the navigation angles
# yaw, pitch and roll. Each angle enters by $c_j = \cos\theta_j$ and $s_j = \sin\theta_j$, tied by a circle.


# %%
def axis_rotation(axis, cosine, sine, unit=1):
    """unit * rotation about a coordinate axis, for cosine and sine times the unit."""
    j, k = (axis + 1) % 3, (axis + 2) % 3
    matrix = sp.zeros(3)
    matrix[axis, axis] = unit
    matrix[j, j] = matrix[k, k] = cosine
    matrix[j, k], matrix[k, j] = -sine, sine
    return matrix


x_axis, y_axis, z_axis = range(3)
axes = (z_axis, y_axis, x_axis)
cosines, sines = sp.symbols("cos1:4"), sp.symbols("sin1:4")


def euler(cosine, sine, units=(1, 1, 1)):
    factors = [axis_rotation(*arguments) for arguments in zip(axes, cosine, sine, units, strict=True)]
    return (factors[0] * factors[1] * factors[2]).applyfunc(sp.expand)


circles = [c**2 + s**2 - 1 for c, s in zip(cosines, sines, strict=True)]
afd1 = legs_with(euler(cosines, sines)) + circles
summary.append(matches("AFD1", afd1, formulation("AFD1").formulate(problem).system))

# %% [markdown]
# Two triples of angles give the same rotation: $(\theta_1, \theta_2, \theta_3)$ and $(\theta_1 + \pi, \pi - \theta_2,
# \theta_3 + \pi)$. On cosines and sines this is a change of signs, so that each of the 40 poses is met twice.

# %%
twin = euler([-cosines[0], -cosines[1], -cosines[2]], [-sines[0], sines[1], -sines[2]])
assert twin == euler(cosines, sines)
print("both triples give the same matrix")

# %% [markdown]
# ## AFD2: tangents of half the angles
#
# With $t = \tan(\theta/2)$ we have $\cos\theta = (1-t^2)/(1+t^2)$ and $\sin\theta = 2t/(1+t^2)$. The circles disappear,
# and with them three unknowns; the price is the denominator $(1+t_1^2)(1+t_2^2)(1+t_3^2)$ by which each leg must be
# multiplied. The degree rises to 8, and the number of terms with it.

# %%
t = sp.symbols("t1:4")
units = [1 + value**2 for value in t]
denominator = units[0] * units[1] * units[2]
cleared = euler([1 - value**2 for value in t], [2 * value for value in t], units)
afd2 = legs_with(cleared, denominator)
formulated = formulation("AFD2").formulate(problem)
summary.append(matches("AFD2", afd2, formulated.system))

# %% [markdown]
# Multiplying by the denominator has a second price. Where a factor $1 + t_j^2$ vanishes there are solutions that mean
# nothing. Take $t_1 = i$: the third row of the cleared rotation becomes zero and the others proportional, so that it
# is of rank one, $w\,v^T$ with a constant isotropic vector $w$. A leg is then $2\,(C - A)\cdot w\;\, v\cdot B$.
# Where $v = 0$, all six vanish for *every* position $C$: a set of solutions of dimension three at least.

# %%
at_i = cleared.subs(t[0], sp.I).applyfunc(sp.expand)
w = sp.Matrix([sp.I, -1, 0])
v = (at_i.row(0) / w[0]).applyfunc(sp.factor).T
assert (at_i - w * v.T).applyfunc(sp.expand) == sp.zeros(3)
print("w.w =", w.dot(w), "  v =", list(v))

unwanted = {t[1]: 1, t[2]: sp.I}
assert v.subs(unwanted).applyfunc(sp.expand) == sp.zeros(3, 1)
assert all(sp.expand(leg.subs(t[0], sp.I).subs(unwanted)) == 0 for leg in afd2)
print("at t = (i, 1, i) every leg vanishes for every C")

# %% [markdown]
# So the package solves the *localised* system, away from the denominator: $y_j = 1/(1+t_j^2)$ and $z_j = t_j y_j$ join
# as unknowns, $\cos\theta_j = 2y_j - 1$ and $\sin\theta_j = 2z_j$. Written in these, legs have degree 4, and $1 = (1 +
# t_j^2)\,y_j = y_j + t_j z_j$ keeps every $1 + t_j^2$ away from zero.

# %%
y, z = sp.symbols("y1:4"), sp.symbols("z1:4")
localised = legs_with(euler([2 * value - 1 for value in y], [2 * value for value in z]))
for tangent, inverse, product in zip(t, y, z, strict=True):
    localised += [tangent * inverse - product, inverse + tangent * product - 1, inverse**2 + product**2 - inverse]
matches("AFD2, localised", localised, formulated.branches[0])


def with_tangents(expression):
    """prod(1 + t_j^2) times a polynomial of degree at most 1 in each pair (y_j, z_j), written in the tangents."""
    total = 0
    for exponents, coefficient in sp.Poly(expression, *y, *z).terms():
        factors = zip(t, units, exponents[:3], exponents[3:], strict=True)
        total += coefficient * sp.prod([value**in_z * unit ** (1 - in_y - in_z) for value, unit, in_y, in_z in factors])
    return sp.expand(total)


count = len(afd2)
assert all(with_tangents(new) == sp.expand(old) for new, old in zip(localised[:count], afd2, strict=True))
meaning = {symbol: 1 / unit for symbol, unit in zip(y, units, strict=True)}
meaning |= {symbol: value / unit for symbol, value, unit in zip(z, t, units, strict=True)}
assert all(sp.cancel(extra.subs(meaning)) == 0 for extra in localised[count:])
print("where no denominator vanishes the two systems are the same")

# %% [markdown]
# ## AFD5: unit quaternions
#
# The matrix of Euler and Rodrigues is quadratic in $q = (q_0, q_1, q_2, q_3)$ and satisfies $R R^T = N^2 I$, $\det R =
# N^3$ with $N = q\cdot q$. With $N = 1$ it is a rotation, and legs have degree 3. (The source gives degree 6.) Since
# $R(q) = R(-q)$, each pose is met twice.

# %%
q = sp.symbols("q0:4")


def quaternion_matrix(quaternion):
    """N(e) R for a quaternion e of any scale."""
    e0, vector = quaternion[0], sp.Matrix(quaternion[1:])
    skew = sp.Matrix([[0, -vector[2], vector[1]], [vector[2], 0, -vector[0]], [-vector[1], vector[0], 0]])
    return ((e0**2 - vector.dot(vector)) * identity + 2 * vector * vector.T + 2 * e0 * skew).applyfunc(sp.expand)


norm = sum(value**2 for value in q)
turn = quaternion_matrix(q)
assert (turn * turn.T - norm**2 * identity).applyfunc(sp.expand) == sp.zeros(3)
assert sp.expand(turn.det() - norm**3) == 0
assert turn == quaternion_matrix([-value for value in q])

afd5 = [*legs_with(turn), norm - 1]
summary.append(matches("AFD5", afd5, formulation("AFD5").formulate(problem).system))

# %% [markdown]
# ## AFD6: dual quaternions
#
# Let $e$ be a quaternion of $R$ of any scale, and $f = C\,e$ the product of quaternions, $C$ taken as a pure one. (The
# usual dual part is $f/2$.) Then $e\cdot f = 0$, Study's condition, and with $N = e\cdot e$
#
# $$N\,C = \mathrm{vec}(f\,\bar e), \qquad N\,R^T C = \mathrm{vec}(\bar e\,f), \qquad N\,|C|^2 = f\cdot f, \qquad
# N\,R = R(e).$$
#
# All of them are quadratic in $(e, f)$. And equation (2) is *linear* in $|C|^2$, $R^T C$, $C$, $R$ and 1, because
# $C\cdot RB = B\cdot R^T C$. So $N$ times a leg is a quadric: the mixed term of degree 3 in AFD5 is gone.

# %%
e, f = sp.symbols("e0:4"), sp.symbols("f0:4")


def product(left, right):
    """Product of quaternions, as a list."""
    l0, lv = left[0], sp.Matrix(left[1:])
    r0, rv = right[0], sp.Matrix(right[1:])
    return [l0 * r0 - lv.dot(rv), *(l0 * rv + r0 * lv + lv.cross(rv))]


def conjugate(quaternion):
    return [quaternion[0], *(-value for value in quaternion[1:])]


norm = sum(value**2 for value in e)
turn = quaternion_matrix(e)
position = sp.Matrix(product(f, conjugate(e))[1:])
turned_position = sp.Matrix(product(conjugate(e), f)[1:])
square = sum(value**2 for value in f)

study = dict(zip(f, product([0, *C], e), strict=True))
assert sp.expand(sum(left * right for left, right in zip(e, f, strict=True)).subs(study)) == 0
assert (position.subs(study) - norm * C).applyfunc(sp.expand) == sp.zeros(3, 1)
assert (turned_position.subs(study) - turn.T * C).applyfunc(sp.expand) == sp.zeros(3, 1)
assert sp.expand(square.subs(study) - norm * C.dot(C)) == 0
print("the four quadratic forms are what they should be")

# %%
quadratic_legs = []
for i in legs:
    constant = A[i].dot(A[i]) + B[i].dot(B[i]) - squared_length[i]
    mixed = B[i].dot(turned_position) - A[i].dot(position) - A[i].dot(turn * B[i])
    quadratic_legs.append(sp.expand(square + 2 * mixed + constant * norm))
    in_c_and_e = leg_equation(A[i], B[i], squared_length[i], C, turn * B[i], norm)
    assert sp.expand(quadratic_legs[i].subs(study) - in_c_and_e) == 0
print("with f = C e the quadric of each leg is N(e) times equation (2)")

# %% [markdown]
# The homogeneous system has the unwanted solutions $e = 0$, $f\cdot f = 0$; the equation $N = 1$ excludes them. What
# remains is eight quadrics in eight unknowns, and two solutions, $\pm(e, f)$, for each pose.

# %%
afd6 = [*quadratic_legs, sum(left * right for left, right in zip(e, f, strict=True)), norm - 1]
summary.append(matches("AFD6", afd6, formulation("AFD6").formulate(problem).system))

# %% [markdown]
# ## Answer
#
# All six systems are equation (2) with a parametrisation of $R$ substituted and the relations among its parameters
# joined. The identities above show that the package's polynomials are those systems.

# %%
print(f"{'code':6}{'unknowns':>9}{'equations':>11}{'terms':>8}   degrees")
for row in sorted(summary, key=lambda row: row["code"]):
    print(f"{row['code']:6}{row['unknowns']:9}{row['equations']:11}{row['terms']:8}   {row['degrees']}")

# %% [markdown]
# The table shows the trade. Fewer unknowns are paid for by degree and terms (AFD2), low degree by redundant unknowns
# (AFD3, AFD4) or by a double cover (AFD5, AFD6). What the systems add to the 40 poses follows from the derivations too:
#
# | system | adds | because |
# |---|---|---|
# | AFD1 | 40 twins | two triples of angles for a rotation |
# | AFD2 | 40 twins; sets of positive dimension unless localised | the same; vanishing denominators |
# | AFD3 | 40 reflections | $R R^T = I$ does not fix the sign of $\det R$ |
# | AFD4 | nothing | $R = \mathrm{cof}\,R$ excludes reflections |
# | AFD5, AFD6 | 40 twins | $q$ and $-q$ are the same rotation |
