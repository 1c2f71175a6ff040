"""Solutions that are regular, though by no prime that is tried first, and solutions that are singular in several ways.

The plain checker draws combinations of rows by seeds that anybody knows: some of these are made for them.
"""

from __future__ import annotations

from collections.abc import Sequence
from fractions import Fraction
from functools import partial
from math import prod
from random import Random

from certificate_subjects import Content
from flint import fmpq, fmpq_mat, fmpq_poly, fmpz_poly
from forged_margins import ACCEPTED, REJECTED, Case
from forged_representations import set_representation
from held_mechanisms import KEYS, Numbers, Pose, listing, mechanism, moving

from pkm_exact.certify import pure, pure_mechanism
from pkm_exact.certify.checker.solutions import primes_for
from pkm_exact.certify.checker.study_motion import motion
from pkm_exact.constraints.constraint import Constraint
from pkm_exact.constraints.linear import LinearForm

ONE_ROOT = (0, 1)
PRIMES = prod({*primes_for(fmpz_poly(list(ONE_ROOT))), *pure.good_primes(list(ONE_ROOT))})
"""All that are tried first on a solution with the parameter 0."""
AT = Pose((1, 0, 0, 0), (0, 1, 2, 5))

# Translations whose constraints have given gradients


def _with_gradients(rows: Sequence[Numbers], sphere: int) -> list[Constraint]:
    """Planes with these normals, and in one place a sphere in their stead."""
    position = AT.quantities()[0]
    forms = []
    for place, row in enumerate(rows):
        normal = [Fraction(x) - 2 * c * (place == sphere) for x, c in zip(row, position, strict=True)]
        forms.append(AT.linear([int(place == sphere), 0, 0, 0, *normal, *[0] * 9]))
    return list(forms)


def _drawn(seed: int, rows: int, columns: int) -> list[list[int]]:
    random = Random(seed)
    return [[random.randrange(1, pure_mechanism.RANDOM) for _ in range(columns)] for _ in range(rows)]


def _held(rows: Sequence[Numbers], sphere: int, total: int) -> Content:
    """A pose at which these are the gradients, with this multiplicity; if more than 1, it is not said to be proved."""
    content = listing("translation", [AT], _with_gradients(rows, sphere), 1 if total == 1 else None)
    return content | {"complex_solutions": total}


def _one_row_apart(place: int) -> list[list[int]]:
    """All rows but one begin with 0; all are 0 modulo primes."""
    rows = [[0, 1, 0], [0, 0, 1], [0, 1, 1]]
    rows.insert(place, [1, 0, 0])
    return [[PRIMES * x for x in row] for row in rows]


def _dependent_combinations() -> list[list[int]]:
    """Rows of rank 3, two combinations of which, those that are drawn, are one."""
    weights = fmpq_mat(_drawn(2, 2, 4))
    solved = weights.rref()[0]
    kernel = [[-solved[0, k], -solved[1, k], fmpq(k == 2), fmpq(k == 3)] for k in (2, 3)]
    columns = []
    for vector in kernel:
        scale = prod(int(x.q) for x in vector)
        columns.append([int(x * scale) for x in vector])
    return [[a, b, PRIMES * c] for a, b, c in zip(columns[0], (1, 2, 3, 5), columns[1], strict=True)]


def _one_combination() -> list[list[int]]:
    """Rows of rank 3, one combination of which, that is drawn, begins with zeros; all are 0 modulo primes."""
    (a, b, c, d) = _drawn(1, 1, 4)[0]
    columns = (b, -a, 0, 0), (0, 0, d, -c), (1, 2, 3, 5)
    return [[PRIMES * x for x in row] for row in zip(*columns, strict=True)]


def _large_and_small() -> list[list[int]]:
    """A small row, and others whose determinants with what completes the combinations are multiples of 2^n - 1.

    2^n - 1 is larger than what the determinant of the small row may be, and smaller than what those of others are.
    """
    weights = _drawn(2, 2, 4)
    (a, b, c), (d, e, f) = (row[1:] for row in weights)
    beside = [0, *(PRIMES * x for x in (b * f - c * e, c * d - a * f, a * e - b * d))]
    rows = [[1, 0, beside[0]], [0, 1, beside[1]], [0, 1, beside[2]], [1, 0, beside[3]]]
    body = _held(rows, 1, 1)
    certificate = pure_mechanism.read(body)
    sized = pure.sized_motion(certificate.representation, (1, 1, 1))
    bounds = pure_mechanism.determinants(pure_mechanism.Slopes(certificate.robot), sized, 2)
    modulus = (1 << pure.exponent_above(min(bound.size for bound in bounds), 1)) - 1

    def minor(*columns: int) -> int:
        (x, y), (z, t) = ([row[column] for column in columns] for row in weights)
        return x * t - y * z

    others = minor(0, 1) + minor(0, 2) + minor(3, 1) + minor(3, 2)
    rows[2][0] = -others * pow(minor(2, 1), -1, modulus) % modulus
    return rows


REGULAR: dict[str, Case] = {}
for _name, _rows, _sphere in (
    ("all rows but the first one are in a plane", _one_row_apart(0), 1),
    ("all rows but the last one are in a plane", _one_row_apart(3), 1),
    ("a combination of independent rows begins with zeros", _one_combination(), 0),
    ("determinants of rows are multiples of a number between their bounds", _large_and_small(), 1),
    ("combinations of independent rows are dependent", _dependent_combinations(), 0),
):
    for _total, _said in ((1, ACCEPTED), (2, REJECTED)):
        REGULAR[f"{_name}, multiplicity {_total}"] = (partial(_held, _rows, _sphere, _total), _said)


def _nearly_parallel(prime: int) -> Content:
    """Two planes in which a translation moves; their normals are dependent modulo one prime."""
    content = listing("translation", [AT], [AT.in_plane((prime, 0, 0), (1, 1, 2)), AT.in_plane((0, 1, 0), (0, 0, 0))])
    return moving(content, "dependent-forms")


REGULAR |= {
    f"planes whose normals are dependent modulo 2^{n} - 1": (partial(_nearly_parallel, 2**n - 1), ACCEPTED)
    for n in (61, 127)
}

# Planar poses: forms in |C|^2, u1, u2, C1, C2, r11, r21 and 1

PLACES = (0, 1, 2, 4, 5, 7, 10, 16)


def _values(pose: Pose) -> list[Fraction]:
    """Of the eight."""
    position, rotation, turned = pose.quantities()
    square = sum((x * x for x in position), Fraction(0))
    return [square, *turned[:2], *position[:2], rotation[0][0], rotation[1][0], Fraction(1)]


def _slopes(pose: Pose) -> list[list[Fraction]]:
    """Three rows: the derivatives of the eight for v1, v2 and w3."""
    (x, y, _), rotation, _ = pose.quantities()
    c, s, zero, one = rotation[0][0], rotation[1][0], Fraction(0), Fraction(1)
    return [
        [2 * x, c, -s, one, zero, zero, zero, zero],
        [2 * y, s, c, zero, one, zero, zero, zero],
        [zero, c * y - s * x, -c * x - s * y, zero, zero, -s, c, zero],
    ]


def _kernel(rows: Sequence[Sequence[Fraction | int]]) -> list[list[Fraction]]:
    """A basis of what is orthogonal to some rows."""
    solved, rank = fmpq_mat([[_rational(x) for x in row] for row in rows]).rref()
    width = len(rows[0])
    pivots = [next(j for j in range(width) if solved[i, j] != 0) for i in range(rank)]
    found = []
    for free in (j for j in range(width) if j not in pivots):
        vector = [Fraction(int(j == free)) for j in range(width)]
        for i, pivot in enumerate(pivots):
            vector[pivot] = -Fraction(int(solved[i, free].p), int(solved[i, free].q))
        found.append(vector)
    return found


def _rational(value: Fraction | int) -> fmpq:
    exact = Fraction(value)
    return fmpq(exact.numerator, exact.denominator)


def _form(eight: Sequence[Fraction]) -> LinearForm:
    form = [Fraction(0)] * 17
    for place, value in zip(PLACES, eight, strict=True):
        form[place] = value
    return LinearForm(tuple(form))


def _held_everywhere(total: int) -> Content:
    """Four forms whose gradients all are 0 at a pose."""
    at = Pose((1, 0, 0, 0), (0, 0, 0, 0))
    forms = [_form(eight) for eight in _kernel([_values(at), *_slopes(at)])]
    return listing("planar", [at], list(forms), None) | {"complex_solutions": total}


def _parallel() -> Content:
    """Four forms whose gradients are multiples of one at a pose."""
    at = Pose((1, 0, 0, 0), (0, 1, 2, 0))
    slopes = _slopes(at)
    along = [[x - y for x, y in zip(slopes[0], slope, strict=True)] for slope in slopes[1:]]
    forms = [_form(eight) for eight in _kernel([_values(at), *along])[1:]]
    return listing("planar", [at], list(forms), None)


def _of_two_ranks(multiplicity: int | None, total: int) -> Content:
    """Three forms whose gradients have rank 2 at one pose, and 1 at another one."""
    one, other = Pose((1, 0, 0, 0), (0, 1, 2, 0)), Pose((1, 0, 0, 1), (0, 2, -1, 0))
    values = [_values(one), _values(other)]
    flat_here, flat_there = (_kernel([*values, *_slopes(pose)]) for pose in (one, other))
    forms = [_form(eight) for eight in (*flat_there[:2], flat_here[0])]
    return listing("planar", [one, other], list(forms), multiplicity) | {"complex_solutions": total}


SINGULAR: dict[str, Case] = {
    **{
        f"a pose where nothing has a gradient, {total} in all": (partial(_held_everywhere, total), said)
        for total, said in ((1, ACCEPTED), (2, ACCEPTED), (7, REJECTED))
    },
    "a pose where all gradients are parallel": (_parallel, ACCEPTED),
    "two poses at which gradients have different ranks": (partial(_of_two_ranks, None, 4), ACCEPTED),
    "two poses at which gradients have different ranks, said to be simple": (
        partial(_of_two_ranks, 1, 2),
        REJECTED,
    ),
}

# Two conjugate planar poses, and a determinant that is 0 where the eliminant is nearly 0


def _nearly_singular(total: int) -> Content:
    """Two conjugate poses, at the roots of t^2 - t + c, with a prime c.

    The gradients of three forms are dependent at t = 0, a root modulo c alone, where the numerators are those of
    another pose; modulo the other primes they are dependent everywhere.
    """
    c = (1 << 127) - 1
    h, t = fmpq_poly([c, -1, 1]), fmpq_poly([0, 1])
    e, f = [2 * t - 1, 0 * t, 0 * t, t], [0 * t, t - 2 * c, 2 - 3 * t, 0 * t]
    placed = motion(e, f, (1, 1, 1))  # type: ignore[type-var]
    position, rotation = placed.position, placed.rotation
    eight = [placed.square, *placed.turned[:2], *position[:2], rotation[0][0], rotation[1][0], placed.norm]
    rests = [value % h for value in eight]
    conditions = [[Fraction(int(rest[k].p), int(rest[k].q)) for rest in rests] for k in range(2)]
    start = [Fraction(int(row[0].p), int(row[0].q)) for row in (*e, *f)]
    slopes = _slopes(Pose(start[:4], start[4:]))
    order = (7, 5, 0, 1, 2, 3, 4, 6)  # solved for the first two, with denominators that c does not divide
    solved = _kernel([[row[k] for k in order] for row in conditions])
    basis = [[vector[order.index(k)] for k in range(8)] for vector in solved]
    scale = prod(p for p in pure.good_primes([c, -1, 1]) if p != c)
    first, second, *others = basis
    values = [_determinant(slopes, (first, second, other)) for other in others[:2]]
    last = [scale * (values[1] * x - values[0] * y) for x, y in zip(*others[:2], strict=True)]
    content = listing("planar", [AT_REST], [AT_REST.distance((1, 0, 0), (0, 0, 0))], None)
    content["robot"] = mechanism("planar", (1, 1, 1), [_form(first), _form(second), _form(last)])
    set_representation(content, [h, *e, *f], [0, 0, 0, 0, 0, 1, 0, 0])
    content |= {"poses": [], "real_poses": 0, "box_exponent": 0, "complex_solutions": total}
    return {key: content[key] for key in KEYS}


AT_REST = Pose((1, 0, 0, 0), (0, 0, 0, 0))


def _determinant(slopes: Sequence[Sequence[Fraction]], forms: Sequence[Sequence[Fraction]]) -> Fraction:
    matrix = fmpq_mat(
        [
            [_rational(sum((x * y for x, y in zip(row, form, strict=True)), Fraction(0))) for row in slopes]
            for form in forms
        ]
    )
    value = matrix.det()
    return Fraction(int(value.p), int(value.q))


NEARLY: dict[str, Case] = {
    "two poses, and a determinant that is 0 beside them": (partial(_nearly_singular, 2), ACCEPTED),
    "two poses, and a determinant that is 0 beside them, three in all": (partial(_nearly_singular, 3), REJECTED),
}

RANKS: dict[str, Case] = {**REGULAR, **SINGULAR, **NEARLY}
