/* @TITLE@. See @NAME@.h. The method and its proof are those of pkm_exact.following.follower. */
#include "@NAME@.h"

#include <math.h>

#ifdef __FAST_MATH__
#error "the proofs need IEEE arithmetic: compile without -ffast-math"
#endif

#define N @N@ /* unknowns */
#define M @M@ /* legs */
#define K (N - 1) /* quadratic forms: legs, and Study's condition where it is one */
#define POSE 13 /* position, rotation matrix, norm */
#define NORM (POSE - 1)
#define STEPS 12
#define CHAINS @CHAINS@ /* 0: legs of actuated length, 1: slides, 2: cranks */

static const double U = 1.1102230246251565e-16;
static const double OUTWARD = 1.0 + 9.094947017729282e-13;
static const double TINY = 1e-290;
#define FORM_ERROR (40 * U)
#define SLOPE_ERROR (48 * U)
#define ENDS_ERROR (8 * U)
#define POSE_ERROR (64 * U)

static const double unit = @UNIT_OF_LENGTH@; /* of lengths in the tables */
static const int support[N] = @SUPPORT@;
static const double roots[4] = @ROOTS@;
static const double weights[3] = @WEIGHTS@;
static const double legs[K][N][N] = @LEGS@;
static const double pose_forms[POSE][N][N] = @POSE_FORMS@;
static const double platform[M][3] = @PLATFORM@;
static const double base[M][3] = @BASE@;
#if CHAINS
static const double moved[M][3][N][N] = @MOVED@;
static const double at_0[M][3] = @AT_0@;
static const double at_90[M][3] = @AT_90@;
static const double rods_squared[M] = @RODS_SQUARED@;
#endif

typedef struct {
    double places[M][3], squares[M], sizes[M], off[M];
} ends_t;

typedef struct {
    double form[K][N][N], size[K][N][N];
} forms_t;

static double larger(double a, double b) { return a > b ? a : b; }

#if CHAINS
static double weighted(const double v[3]) {
    return weights[0] * v[0] * v[0] + weights[1] * v[1] * v[1] + weights[2] * v[2] * v[2];
}
#endif

static double norm_at(const double x[N]) {
    double total = 0;
    for (int k = 0; k < N; k++)
        for (int l = 0; l < N; l++) total += pose_forms[NORM][k][l] * x[k] * x[l];
    return total;
}

/* Lower ends of the legs, and |A|^2 - l^2, with what they may be off. */
static void find_ends(const double values[M], ends_t *e) {
    for (int j = 0; j < M; j++) {
#if CHAINS
        double first = values[j], second = 0, sizes[3];
#if CHAINS == 2
        first = cos(values[j]);
        second = sin(values[j]);
#endif
        for (int i = 0; i < 3; i++) {
            e->places[j][i] = base[j][i] + first * at_0[j][i] + second * at_90[j][i];
            sizes[i] = fabs(base[j][i]) + fabs(first * at_0[j][i]) + fabs(second * at_90[j][i]);
        }
        double square = weighted(e->places[j]);
        e->squares[j] = square - rods_squared[j];
        e->sizes[j] = square + rods_squared[j];
        e->off[j] = ENDS_ERROR * sqrt(weighted(sizes)) * OUTWARD;
#else
        double length = values[j] / unit;
        for (int i = 0; i < 3; i++) e->places[j][i] = 0;
        e->squares[j] = -length * length;
        e->sizes[j] = length * length;
        e->off[j] = 0;
#endif
    }
}

static void find_forms(const ends_t *e, forms_t *f) {
    for (int j = 0; j < K; j++)
        for (int k = 0; k < N; k++)
            for (int l = 0; l < N; l++) {
                double form = legs[j][k][l], size = fabs(form);
                if (j < M) {
                    form += e->squares[j] * pose_forms[NORM][k][l];
                    size += e->sizes[j] * fabs(pose_forms[NORM][k][l]);
#if CHAINS
                    for (int i = 0; i < 3; i++) {
                        form += e->places[j][i] * moved[j][i][k][l];
                        size += fabs(e->places[j][i] * moved[j][i][k][l]);
                    }
#endif
                }
                f->form[j][k][l] = form;
                f->size[j][k][l] = size;
            }
}

/* The inverse of a matrix, about; 0 if none is found. */
static int invert(double a[N][N], double y[N][N]) {
    for (int k = 0; k < N; k++)
        for (int l = 0; l < N; l++) y[k][l] = k == l;
    for (int c = 0; c < N; c++) {
        int p = c;
        for (int k = c + 1; k < N; k++)
            if (fabs(a[k][c]) > fabs(a[p][c])) p = k;
        if (!(fabs(a[p][c]) > 0)) return 0;
        for (int l = 0; l < N; l++) {
            double s = a[p][l], t = y[p][l];
            a[p][l] = a[c][l], y[p][l] = y[c][l];
            a[c][l] = s, y[c][l] = t;
        }
        double factor = 1 / a[c][c];
        for (int l = 0; l < N; l++) a[c][l] *= factor, y[c][l] *= factor;
        for (int k = 0; k < N; k++) {
            double g = a[k][c];
            if (k == c || g == 0) continue;
            for (int l = 0; l < N; l++) a[k][l] -= g * a[c][l], y[k][l] -= g * y[c][l];
        }
    }
    return 1;
}

/* Derivatives of the forms and of the chart at x, and the values. */
static void evaluate(const forms_t *f, const double chart[N], double constant, const double x[N], double jacobian[N][N], double value[N]) {
    for (int j = 0; j < K; j++) {
        value[j] = 0;
        for (int k = 0; k < N; k++) {
            double slope = 0;
            for (int l = 0; l < N; l++) slope += f->form[j][k][l] * x[l];
            jacobian[j][k] = 2 * slope;
            value[j] += slope * x[k];
        }
    }
    value[K] = -constant;
    for (int k = 0; k < N; k++) jacobian[K][k] = chart[k], value[K] += chart[k] * x[k];
}

static int newton(const forms_t *f, const double chart[N], double constant, double x[N]) {
    double size = 0;
    for (int k = 0; k < N; k++) size = larger(size, 4 * fabs(x[k]));
    for (int step = 0; step < STEPS; step++) {
        double jacobian[N][N], inverse[N][N], value[N], length = 0;
        evaluate(f, chart, constant, x, jacobian, value);
        if (!invert(jacobian, inverse)) return 0;
        for (int k = 0; k < N; k++) {
            double change = 0;
            for (int j = 0; j < N; j++) change += inverse[k][j] * value[j];
            x[k] -= change;
            length = length >= fabs(change) ? length : fabs(change); /* keeps what is not a number */
        }
        if (!(length < size)) return 0;
        if (length < 1e-13 * size) return 1;
    }
    return 0;
}

/* |C + R B - A| where leg j has this value. */
static double reach(int j, double value, double norm) {
#if CHAINS
    return sqrt(rods_squared[j] + fabs(value) / norm) * OUTWARD;
#else
    (void)j, (void)value, (void)norm;
    return 0;
#endif
}

/* By how much derivatives of leg j change, all in all, if A moves by so much and |A|^2 - l^2 changes by so much. */
static double slope_change(int j, double shift, double raised, const double absolute[N]) {
    double total = 0;
    for (int k = 0; k < N; k++)
        for (int l = 0; l < N; l++) {
            double entry = raised * fabs(pose_forms[NORM][k][l]);
#if CHAINS
            for (int i = 0; i < 3; i++) entry += shift * fabs(moved[j][i][k][l]);
#else
            (void)j, (void)shift;
#endif
            total += 2 * entry * absolute[l];
        }
    return total;
}

/* How far a value may be off: roundings, and lower ends that are not quite where they were computed to be. */
static double value_off(int j, const ends_t *e, const forms_t *f, const double absolute[N], double value, double norm) {
    double total = 0;
    for (int k = 0; k < N; k++)
        for (int l = 0; l < N; l++) total += f->size[j][k][l] * absolute[k] * absolute[l];
    total = FORM_ERROR * total + TINY;
    if (j < M) total += norm * (2 * reach(j, value, norm) + e->off[j]) * e->off[j] * OUTWARD;
    return total * OUTWARD;
}

/* |Y F| for values that are off by so much. */
static double distance(double inverse[N][N], const double value[N], const double off[N]) {
    double most = 0;
    for (int k = 0; k < N; k++) {
        double total = 0, about = 0;
        for (int j = 0; j < N; j++) {
            total += inverse[k][j] * value[j];
            about += fabs(inverse[k][j]) * (16 * U * fabs(value[j]) + off[j]);
        }
        most = larger(most, fabs(total) + about);
    }
    return most * OUTWARD;
}

static int contained(double z, double e, double curvature, double away) {
    double radius = away;
    for (int tries = 0; tries < 4; tries++) {
        double k = (e + radius * curvature) * OUTWARD;
        if (!(k < 1)) return 0;
        if (z <= (1 - k) * radius * (2 - OUTWARD)) return 1;
        radius = larger(radius, z / (1 - k)) * (1 + 1.0 / 64);
    }
    return 0;
}

/* The pose at a point, with bounds; 0 if these are not finite. */
static int hand_out(const double values[M], const double x[N], double radius, @NAME@_pose *pose) {
    double entry[POSE], change[POSE], rounding[POSE];
    for (int p = 0; p < POSE; p++) {
        double first = 0, second = 0, about = 0;
        entry[p] = 0;
        for (int k = 0; k < N; k++) {
            double slope = 0, size = 0;
            for (int l = 0; l < N; l++) {
                slope += pose_forms[p][k][l] * x[l];
                size += fabs(pose_forms[p][k][l] * x[l]);
                second += fabs(pose_forms[p][k][l]);
            }
            entry[p] += slope * x[k];
            first += size;
            about += size * fabs(x[k]);
        }
        change[p] = (2 * radius * first + radius * radius * second) * OUTWARD;
        rounding[p] = POSE_ERROR * about;
    }
    double norm = entry[NORM], room = norm * (1 - POSE_ERROR) - change[NORM], bound[2] = {0, 0};
    if (!(room > 0)) return 0;
    for (int p = 0; p < NORM; p++) {
        entry[p] /= norm;
        double off = ((change[p] + fabs(entry[p]) * change[NORM]) / room + rounding[p] / norm + TINY) * OUTWARD;
        bound[p >= 3] = larger(bound[p >= 3], off);
    }
    double root = sqrt(norm), most = 0;
    for (int p = 0; p < 3; p++) pose->position[p] = entry[p] * unit;
    for (int p = 0; p < 9; p++) pose->rotation[p] = entry[3 + p];
    for (int p = 0; p < 4; p++) pose->quaternion[p] = 0;
    for (int k = 0; k < N; k++) {
        pose->point[k] = x[k] / root;
        most = larger(most, fabs(pose->point[k]));
        if (support[k] < 4) pose->quaternion[support[k]] = pose->point[k] * roots[support[k]];
    }
    for (int j = 0; j < M; j++) pose->values[j] = values[j];
    pose->position_bound = bound[0] * unit;
    pose->rotation_bound = bound[1];
    pose->radius = (radius / root + 8 * U * most) * OUTWARD;
    return 1;
}

/* Whether all joint values on the way have exactly one pose in a ball around x in which the last pose is. */
static int is_same_mode(const ends_t *after, const double values[M], double inverse[N][N], const double value[N], const double off[N],
                        double e, double curvature, const double x[N], const double chart[N], double constant, const @NAME@_pose *last) {
    ends_t before;
    forms_t f;
    double jacobian[N][N], first[N], more[N], absolute[N], ones[N], norm = norm_at(x) * OUTWARD;
    double at_point = 0, further = 0, sum_chart = 0, size = 0, away = 0, at[M], beyond[M];
    find_ends(last->values, &before);
    find_forms(&before, &f);
    evaluate(&f, chart, constant, x, jacobian, first);
    for (int k = 0; k < N; k++) {
        absolute[k] = fabs(x[k]);
        ones[k] = 1;
        away = larger(away, fabs(x[k] - last->point[k]));
        size = larger(size, fabs(last->point[k]));
        sum_chart += fabs(chart[k]);
    }
    for (int j = M; j < N; j++) first[j] = value[j], more[j] = off[j];
    for (int j = 0; j < M; j++) {
        double change = fabs(values[j] - last->values[j]) * (1 + 4 * U), shift = 0, raised, bend = 0;
#if CHAINS
        double arm = sqrt(weighted(at_0[j])) * OUTWARD, length = sqrt(weighted(after->places[j])) * OUTWARD;
        shift = (arm * change + before.off[j] + after->off[j]) * OUTWARD;
        raised = (2 * length + shift) * shift * OUTWARD;
        bend = arm * change * arm * change / 4;
#if CHAINS == 2
        bend = change * change / 4 * arm * (reach(j, value[j], norm) + arm + arm * change);
#endif
        bend *= OUTWARD;
#else
        bend = change / unit * change / unit / 4 * OUTWARD; /* l * l is not even between its ends */
        raised = fabs(after->squares[j] - before.squares[j]) + 4 * U * (after->sizes[j] + before.sizes[j]);
#endif
        more[j] = off[j] + value_off(j, &before, &f, absolute, first[j], norm) + bend * norm * OUTWARD;
        at[j] = slope_change(j, shift, raised, absolute);
        beyond[j] = slope_change(j, shift, raised, ones);
    }
    for (int k = 0; k < N; k++) {
        double a = 0, b = 0;
        for (int j = 0; j < M; j++) a += fabs(inverse[k][j]) * at[j], b += fabs(inverse[k][j]) * beyond[j];
        at_point = larger(at_point, a);
        further = larger(further, b);
    }
    size += last->radius;
    double turn = sum_chart * (last->radius + 20 * U * size), room = fabs(constant) - turn;
    if (!(room > 0)) return 0;
    away = (away + (last->radius + size * turn / room) * OUTWARD) * OUTWARD;
    double z = larger(distance(inverse, value, more), distance(inverse, first, more));
    return contained(z, (e + at_point * OUTWARD) * OUTWARD, (curvature + further * OUTWARD) * OUTWARD, away);
}

/* By how much derivatives of leg j are off, entry by entry added up, because its lower end is. */
static void leg_off(int j, const ends_t *e, const double absolute[N], double *slope, double *curved) {
    *slope = *curved = 0;
#if CHAINS
    double ones[N], length = sqrt(weighted(e->places[j])) * OUTWARD, raised = (2 * length + e->off[j]) * e->off[j] * OUTWARD;
    for (int k = 0; k < N; k++) ones[k] = 1;
    *slope = slope_change(j, e->off[j], raised, absolute);
    *curved = slope_change(j, e->off[j], raised, ones) / 2;
#else
    (void)j, (void)e, (void)absolute;
#endif
}

/* e and K of the point. */
static void deviations(const forms_t *f, const ends_t *ends, double jacobian[N][N], double inverse[N][N], const double x[N],
                       const double chart[N], double *e, double *curvature) {
    double slope_size[N][N], size_sum[K], slope_off[M], curved_off[M], absolute[N];
    for (int k = 0; k < N; k++) absolute[k] = fabs(x[k]), slope_size[K][k] = fabs(chart[k]);
    for (int j = 0; j < K; j++) {
        size_sum[j] = 0;
        for (int k = 0; k < N; k++) {
            slope_size[j][k] = 0;
            for (int l = 0; l < N; l++) {
                slope_size[j][k] += 2 * f->size[j][k][l] * absolute[l];
                size_sum[j] += f->size[j][k][l];
            }
        }
    }
    for (int j = 0; j < M; j++) leg_off(j, ends, absolute, &slope_off[j], &curved_off[j]);
    *e = *curvature = 0;
    for (int k = 0; k < N; k++) {
        double total = 0, curved = 0;
        for (int l = 0; l < N; l++) {
            double product = k == l ? -1 : 0, about = 0;
            for (int j = 0; j < N; j++) {
                product += inverse[k][j] * jacobian[j][l];
                about += fabs(inverse[k][j]) * slope_size[j][l];
            }
            total += fabs(product) + SLOPE_ERROR * about;
            for (int m = 0; m < N; m++) {
                double entry = 0;
                for (int j = 0; j < K; j++) entry += inverse[k][j] * f->form[j][l][m];
                curved += fabs(entry);
            }
        }
        for (int j = 0; j < K; j++) curved += FORM_ERROR * fabs(inverse[k][j]) * size_sum[j];
        for (int j = 0; j < M; j++) total += fabs(inverse[k][j]) * slope_off[j], curved += fabs(inverse[k][j]) * curved_off[j];
        *e = larger(*e, total);
        *curvature = larger(*curvature, 2 * curved);
    }
    *e *= OUTWARD;
    *curvature *= OUTWARD;
}

static int next_pose(const double values[M], const double from[N], const @NAME@_pose *last, @NAME@_pose *pose) {
    ends_t ends;
    forms_t f;
    double chart[N], constant = 0, x[N], jacobian[N][N], copy[N][N], inverse[N][N], value[N], off[N], absolute[N], e, curvature;
    for (int k = 0; k < N; k++) {
        chart[k] = 0;
        for (int l = 0; l < N; l++) chart[k] += pose_forms[NORM][k][l] * from[l];
        constant += chart[k] * from[k];
        x[k] = from[k];
    }
#if !CHAINS
    for (int j = 0; j < M; j++)
        if (!(values[j] > 0)) return @MACRO@_NOT_PROVED; /* no length */
#endif
    find_ends(values, &ends);
    find_forms(&ends, &f);
    if (!newton(&f, chart, constant, x)) return @MACRO@_NOT_PROVED;
    evaluate(&f, chart, constant, x, jacobian, value);
    double norm = norm_at(x) * OUTWARD, size = fabs(constant);
    for (int k = 0; k < N; k++) {
        absolute[k] = fabs(x[k]);
        size += fabs(chart[k] * x[k]);
        for (int l = 0; l < N; l++) copy[k][l] = jacobian[k][l];
    }
    if (!invert(copy, inverse)) return @MACRO@_NOT_PROVED;
    for (int j = 0; j < K; j++) off[j] = value_off(j, &ends, &f, absolute, value[j], norm);
    off[K] = (FORM_ERROR * size + TINY) * OUTWARD;
    deviations(&f, &ends, jacobian, inverse, x, chart, &e, &curvature);
    double z = distance(inverse, value, off), k = (e + 2 * z * curvature) * OUTWARD;
    if (!(k <= 0.5)) return @MACRO@_NOT_PROVED;
    int same = last && is_same_mode(&ends, values, inverse, value, off, e, curvature, x, chart, constant, last);
    @NAME@_pose found;
    if (!hand_out(values, x, z / (1 - k) * OUTWARD, &found)) return @MACRO@_NOT_PROVED;
    *pose = found;
    return same ? @MACRO@_SAME_MODE : @MACRO@_PROVED;
}

/* Study coordinates of a pose, in the metric and in units of the tables. */
static void study_point(const double position[3], const double quaternion[4], double x[N]) {
    double full[8], c[3], norm;
    for (int k = 0; k < 4; k++) full[k] = quaternion[k] / roots[k];
    for (int i = 0; i < 3; i++) c[i] = position[i] / unit / sqrt(weights[i]);
    full[4] = -(weights[0] * c[0] * full[1] + weights[1] * c[1] * full[2] + weights[2] * c[2] * full[3]);
    for (int i = 0; i < 3; i++) {
        int j = (i + 1) % 3, k = (i + 2) % 3;
        full[5 + i] = weights[i] * full[0] * c[i] + c[j] * full[k + 1] - c[k] * full[j + 1];
    }
    for (int k = 0; k < N; k++) x[k] = full[support[k]];
    norm = sqrt(norm_at(x));
    for (int k = 0; k < N; k++) x[k] /= norm;
}

int @NAME@_start(const double values[M], const double position[3], const double quaternion[4], @NAME@_pose *pose) {
    double x[N];
    study_point(position, quaternion, x);
    return next_pose(values, x, 0, pose);
}

int @NAME@_follow(const double values[M], @NAME@_pose *pose) {
    double from[N];
    for (int k = 0; k < N; k++) from[k] = pose->point[k];
    return next_pose(values, from, pose, pose);
}

int @NAME@_inverse(const double position[3], const double quaternion[4], const double near[M], double values[M]) {
    double x[N], entry[POSE];
    study_point(position, quaternion, x);
    for (int p = 0; p < POSE; p++) {
        entry[p] = 0;
        for (int k = 0; k < N; k++)
            for (int l = 0; l < N; l++) entry[p] += pose_forms[p][k][l] * x[k] * x[l];
    }
    for (int j = 0; j < M; j++) {
        double d[3]; /* from the base joint to the platform's, ordinary coordinates */
        for (int i = 0; i < 3; i++) {
            d[i] = entry[i] - base[j][i] * sqrt(weights[i]) * entry[NORM];
            for (int k = 0; k < 3; k++) d[i] += entry[3 + 3 * i + k] * platform[j][k] * sqrt(weights[k]);
            d[i] /= entry[NORM];
        }
#if CHAINS
        double a = 0, b = 0, c = -rods_squared[j], arm = weighted(at_0[j]);
        for (int i = 0; i < 3; i++) {
            a += d[i] * at_0[j][i] * sqrt(weights[i]);
            b += d[i] * at_90[j][i] * sqrt(weights[i]);
            c += d[i] * d[i];
        }
#if CHAINS == 2 /* 2 (a cos + b sin) = c + arm */
        double radius = sqrt(a * a + b * b), middle = atan2(b, a), half;
        if (!(radius > 0) || fabs(c + arm) > 2 * radius) return j + 1;
        half = acos((c + arm) / (2 * radius));
        double turns = 6.283185307179586, one = middle - half, other = middle + half;
        one += turns * floor((near[j] - one) / turns + 0.5);
        other += turns * floor((near[j] - other) / turns + 0.5);
#else /* arm s^2 - 2 a s + c = 0 */
        double root = a * a - arm * c;
        if (!(root >= 0)) return j + 1;
        root = sqrt(root);
        double one = (a - root) / arm, other = (a + root) / arm;
        (void)b;
#endif
        values[j] = fabs(one - near[j]) <= fabs(other - near[j]) ? one : other;
#else
        (void)near;
        values[j] = sqrt(d[0] * d[0] + d[1] * d[1] + d[2] * d[2]) * unit;
#endif
    }
    return 0;
}
