/* Motions on segments, paths and of bodies, and clearances, with bad handles, numbers and options; and what they say of clear
 * cases. */
#include <math.h>

#include "check.h"
#include "fixture.h"

typedef struct motion_out {
    double reached[FIXTURE_NQ];
    cstk_motion_result result;
} motion_out;

static void arguments(const fixture *f) {
    motion_out out;
    const double *q = f->q;
    const size_t nq = FIXTURE_NQ;
    EACH_BAD_HANDLE(f, NOUN_QUERY, bad) {
        CHECK_REFUSED(out,
                      cstk_motion(bad->handle, f->cobject, q, q, nq, NULL, out.reached, &out.result),
                      bad->status, "query");
    }
    EACH_BAD_HANDLE(f, NOUN_COBJECT, bad) {
        CHECK_REFUSED(out,
                      cstk_motion(f->query, bad->handle, q, q, nq, NULL, out.reached, &out.result),
                      bad->status, "cobject");
    }
    CHECK_REFUSED(out, cstk_motion(f->query, f->cobject, NULL, q, nq, NULL, out.reached, &out.result),
                  CSTK_ERROR_NULL_ARGUMENT, "q0");
    CHECK_REFUSED(out, cstk_motion(f->query, f->cobject, q, NULL, nq, NULL, out.reached, &out.result),
                  CSTK_ERROR_NULL_ARGUMENT, "q1");
    CHECK_REFUSED(out, cstk_motion(f->query, f->cobject, q, q, nq, NULL, out.reached, NULL),
                  CSTK_ERROR_NULL_ARGUMENT, "out");
    const size_t counts[] = {0, 1, FIXTURE_NQ - 1, SIZE_MAX};
    for (int i = 0; i < 4; ++i) {
        CHECK_REFUSED(out,
                      cstk_motion(f->query, f->cobject, q, q, counts[i], NULL, NULL, &out.result),
                      CSTK_ERROR_WRONG_SIZE, "");
    }
}

static void numbers(const fixture *f) {
    motion_out out;
    const double values[] = {NAN, INFINITY, -INFINITY, 1e300};
    for (int i = 0; i < 4; ++i) {
        for (int k = 0; k < FIXTURE_NQ; ++k) {
            double bad[FIXTURE_NQ];
            for (int j = 0; j < FIXTURE_NQ; ++j) {
                bad[j] = j == k ? values[i] : f->q[j];
            }
            const cstk_status status =
                i < 3 ? CSTK_ERROR_NOT_FINITE : CSTK_ERROR_INVALID_ARGUMENT;
            CHECK_REFUSED(out,
                          cstk_motion(f->query, f->cobject, bad, f->q, FIXTURE_NQ, NULL, out.reached,
                                      &out.result),
                          status, "q0");
            CHECK_REFUSED(out,
                          cstk_motion(f->query, f->cobject, f->q, bad, FIXTURE_NQ, NULL, out.reached,
                                      &out.result),
                          status, "q1");
        }
    }
}

static void options(const fixture *f) {
    motion_out out;
    cstk_motion_options good;
    CHECK_OK(cstk_motion_options_default(&good, sizeof good));
    EACH_BAD_OPTIONS(good, bad) {
        CHECK_REFUSED(out,
                      cstk_motion(f->query, f->cobject, f->q, f->q, FIXTURE_NQ, bad->options,
                                  out.reached, &out.result),
                      bad->status, "options");
    }
    const struct {
        double threshold;
        double tolerance;
        cstk_status status;
        const char *culprit;
    } wrong[] = {
        {NAN, 1e-6, CSTK_ERROR_NOT_FINITE, "threshold"},
        {-1, 1e-6, CSTK_ERROR_INVALID_ARGUMENT, "threshold"},
        {INFINITY, 1e-6, CSTK_ERROR_INVALID_ARGUMENT, "threshold"},
        {0, 0, CSTK_ERROR_INVALID_ARGUMENT, "tolerance"},
        {0, -1, CSTK_ERROR_INVALID_ARGUMENT, "tolerance"},
        {0, NAN, CSTK_ERROR_INVALID_ARGUMENT, "tolerance"},
        {0, 1e-300, CSTK_ERROR_INVALID_ARGUMENT, "tolerance"},
        {0, 1.5, CSTK_ERROR_INVALID_ARGUMENT, "tolerance"},
    };
    for (size_t i = 0; i < sizeof wrong / sizeof wrong[0]; ++i) {
        cstk_motion_options given = good;
        given.threshold = wrong[i].threshold;
        given.tolerance = wrong[i].tolerance;
        CHECK_REFUSED(out,
                      cstk_motion(f->query, f->cobject, f->q, f->q, FIXTURE_NQ, &given, out.reached,
                                  &out.result),
                      wrong[i].status, wrong[i].culprit);
    }
}

/* A complement is met where the set is not: at once, from a free start. */
static void complements(const fixture *f) {
    motion_out out;
    cstk_cobject *complement = NULL;
    CHECK_OK(cstk_cobject_complement(f->cobject, &complement));
    CHECK_OK(cstk_motion(f->query, complement, f->q, f->q, FIXTURE_NQ, NULL, out.reached, &out.result));
    CHECK(out.result.outcome == CSTK_MOTION_HIT && out.result.times[1] == 0);
    CHECK_OK(cstk_cobject_release(complement));
}

static void answers(const fixture *f) {
    motion_out out;
    /* To rest is free; a whole turn of the arm meets the box. */
    CHECK_OK(cstk_motion(f->query, f->cobject, f->q, f->q, FIXTURE_NQ, NULL, NULL, &out.result));
    CHECK(out.result.outcome == CSTK_MOTION_FREE && !out.result.has_distance);
    double turned[FIXTURE_NQ];
    for (int i = 0; i < FIXTURE_NQ; ++i) {
        turned[i] = f->q[i];
    }
    turned[0] += 6.0;
    CHECK_OK(
        cstk_motion(f->query, f->cobject, f->q, turned, FIXTURE_NQ, NULL, out.reached, &out.result));
    if (out.result.outcome == CSTK_MOTION_HIT) {
        CHECK(out.result.has_distance && out.result.distance.distance == 0);
        CHECK(out.result.times[1] - out.result.times[0] <= 1e-6);
        cstk_class place;
        CHECK_OK(cstk_classify(f->query, f->cobject, out.reached, FIXTURE_NQ, &place));
        CHECK(place == CSTK_CLASS_INSIDE);
    } else {
        CHECK(out.result.outcome == CSTK_MOTION_FREE);
    }
    CHECK_OK(cstk_query_set_limit(f->query, 1));
    CHECK_OK(cstk_query_set_limit(f->query, 0));
}

typedef struct pair_out {
    double reached[24];
    cstk_motion_result result;
} pair_out;

static void pairs(const fixture *f) {
    pair_out out;
    const double start[12] = {1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0};
    const double end[12] = {1, 0, 0, 90, 0, 1, 0, 0, 0, 0, 1, 0};
    const double far[12] = {1, 0, 0, 50, 0, 1, 0, 0, 0, 0, 1, 0};
    const double skew[12] = {2, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0};
    const double nan[12] = {1, 0, 0, NAN, 0, 1, 0, 0, 0, 0, 1, 0};
    cstk_body *b = f->body;
    EACH_BAD_HANDLE(f, NOUN_QUERY, bad) {
        CHECK_REFUSED(out,
                      cstk_pair_motion(bad->handle, b, start, end, b, far, far, NULL, out.reached,
                                       &out.result),
                      bad->status, "query");
    }
    EACH_BAD_HANDLE(f, NOUN_BODY, bad) {
        CHECK_REFUSED(out,
                      cstk_pair_motion(f->query, bad->handle, start, end, b, far, far, NULL,
                                       out.reached, &out.result),
                      bad->status, "body_a");
        CHECK_REFUSED(out,
                      cstk_pair_motion(f->query, b, start, end, bad->handle, far, far, NULL,
                                       out.reached, &out.result),
                      bad->status, "body_b");
    }
    const struct {
        const double *poses[4];
        cstk_status status;
        const char *culprit;
    } wrong[] = {
        {{NULL, end, far, far}, CSTK_ERROR_NULL_ARGUMENT, "start_a"},
        {{start, NULL, far, far}, CSTK_ERROR_NULL_ARGUMENT, "end_a"},
        {{start, end, NULL, far}, CSTK_ERROR_NULL_ARGUMENT, "start_b"},
        {{start, end, far, NULL}, CSTK_ERROR_NULL_ARGUMENT, "end_b"},
        {{start, nan, far, far}, CSTK_ERROR_NOT_FINITE, "end_a"},
        {{start, end, nan, far}, CSTK_ERROR_NOT_FINITE, "start_b"},
        {{skew, end, far, far}, CSTK_ERROR_NOT_A_ROTATION, "start_a"},
    };
    for (size_t i = 0; i < sizeof wrong / sizeof wrong[0]; ++i) {
        const double *const *poses = wrong[i].poses;
        CHECK_REFUSED(out,
                      cstk_pair_motion(f->query, b, poses[0], poses[1], b, poses[2], poses[3], NULL,
                                       out.reached, &out.result),
                      wrong[i].status, wrong[i].culprit);
    }
    CHECK_REFUSED(out,
                  cstk_pair_motion(f->query, b, start, end, b, far, far, NULL, out.reached, NULL),
                  CSTK_ERROR_NULL_ARGUMENT, "out");
    CHECK_OK(cstk_pair_motion(f->query, b, start, end, b, far, far, NULL, out.reached, &out.result));
    CHECK(out.result.outcome == CSTK_MOTION_HIT && out.result.distance.distance == 0);
    CHECK(out.reached[15] == 50 && fabs(out.reached[3] - 90 * out.result.times[1]) < 1e-9);
    CHECK_OK(cstk_pair_motion(f->query, b, end, far, b, start, start, NULL, NULL, &out.result));
    CHECK(out.result.outcome == CSTK_MOTION_FREE && !out.result.has_distance);
}

typedef struct path_out {
    double reached[FIXTURE_NQ];
    cstk_path_result result;
} path_out;

enum { POINTS = 3 };

static cstk_status ask_path(const fixture *f, const double *points, size_t count, size_t nq,
                            const cstk_motion_options *options, path_out *out) {
    return cstk_motion_path(f->query, f->cobject, points, count, nq, options, NULL, NULL,
                            out->reached, &out->result);
}

/* The fixture's configuration, three times. */
static void resting(const fixture *f, double points[POINTS * FIXTURE_NQ]) {
    for (int i = 0; i < POINTS * FIXTURE_NQ; ++i) {
        points[i] = f->q[i % FIXTURE_NQ];
    }
}

static void paths_refused(const fixture *f) {
    path_out out;
    double points[POINTS * FIXTURE_NQ];
    resting(f, points);
    const size_t nq = FIXTURE_NQ;
    EACH_BAD_HANDLE(f, NOUN_QUERY, bad) {
        CHECK_REFUSED(out,
                      cstk_motion_path(bad->handle, f->cobject, points, POINTS, nq, NULL, NULL,
                                       NULL, out.reached, &out.result),
                      bad->status, "query");
    }
    EACH_BAD_HANDLE(f, NOUN_COBJECT, bad) {
        CHECK_REFUSED(out,
                      cstk_motion_path(f->query, bad->handle, points, POINTS, nq, NULL, NULL, NULL,
                                       out.reached, &out.result),
                      bad->status, "cobject");
    }
    CHECK_REFUSED(out, ask_path(f, NULL, POINTS, nq, NULL, &out), CSTK_ERROR_NULL_ARGUMENT,
                  "points");
    CHECK_REFUSED(out,
                  cstk_motion_path(f->query, f->cobject, points, POINTS, nq, NULL, NULL, NULL,
                                   out.reached, NULL),
                  CSTK_ERROR_NULL_ARGUMENT, "out");
    CHECK_REFUSED(out, ask_path(f, points, 0, nq, NULL, &out), CSTK_ERROR_WRONG_SIZE, "count");
    CHECK_REFUSED(out, ask_path(f, NULL, 0, nq, NULL, &out), CSTK_ERROR_WRONG_SIZE, "count");
    const size_t sizes[] = {0, 1, FIXTURE_NQ - 1, FIXTURE_NQ + 1, SIZE_MAX};
    for (int i = 0; i < 5; ++i) {
        CHECK_REFUSED(out, ask_path(f, points, POINTS, sizes[i], NULL, &out),
                      CSTK_ERROR_WRONG_SIZE, "nq");
    }
    /* Products beyond size_t, one that wraps round to a small number, and more than any memory. */
    const size_t counts[] = {SIZE_MAX, SIZE_MAX / FIXTURE_NQ + 1, SIZE_MAX / FIXTURE_NQ,
                             SIZE_MAX / 8 / FIXTURE_NQ};
    for (int i = 0; i < 4; ++i) {
        CHECK_REFUSED(out, ask_path(f, points, counts[i], nq, NULL, &out), CSTK_ERROR_WRONG_SIZE,
                      "points");
    }
    const double values[] = {NAN, INFINITY, -INFINITY, 1e300};
    for (int i = 0; i < 4; ++i) {
        for (int k = 0; k < POINTS * FIXTURE_NQ; ++k) {
            char culprit[16];
            snprintf(culprit, sizeof culprit, "point %d", k / FIXTURE_NQ);
            resting(f, points);
            points[k] = values[i];
            CHECK_REFUSED(out, ask_path(f, points, POINTS, nq, NULL, &out),
                          i < 3 ? CSTK_ERROR_NOT_FINITE : CSTK_ERROR_INVALID_ARGUMENT, culprit);
        }
    }
    resting(f, points);
    cstk_motion_options good;
    CHECK_OK(cstk_motion_options_default(&good, sizeof good));
    EACH_BAD_OPTIONS(good, bad) {
        CHECK_REFUSED(out, ask_path(f, points, POINTS, nq, bad->options, &out), bad->status,
                      "options");
    }
    good.tolerance = 0;
    CHECK_REFUSED(out, ask_path(f, points, POINTS, nq, &good, &out), CSTK_ERROR_INVALID_ARGUMENT,
                  "tolerance");
    cstk_cobject *complement = NULL;
    CHECK_OK(cstk_cobject_complement(f->cobject, &complement));
    CHECK_OK(cstk_motion_path(f->query, complement, points, POINTS, nq, NULL, NULL, NULL, out.reached,
                              &out.result));
    CHECK(out.result.motion.outcome == CSTK_MOTION_HIT && out.result.segment == 0);
    CHECK_OK(cstk_cobject_release(complement));
}

typedef struct listener {
    const fixture *f;
    int calls;
    int stop_at;
    double last;
} listener;

static int32_t listen(double fraction, void *user) {
    listener *l = user;
    CHECK(fraction >= l->last && fraction <= 1);
    l->last = fraction;
    /* The context serves the path. */
    path_out out;
    CHECK(ask_path(l->f, l->f->q, 1, FIXTURE_NQ, NULL, &out) == CSTK_ERROR_BUSY);
    return ++l->calls == l->stop_at;
}

static void paths_report(const fixture *f) {
    path_out out;
    double points[POINTS * FIXTURE_NQ];
    resting(f, points);
    listener all = {f, 0, 0, 0};
    CHECK_OK(cstk_motion_path(f->query, f->cobject, points, POINTS, FIXTURE_NQ, NULL, listen, &all,
                              NULL, &out.result));
    CHECK(all.calls == POINTS && all.last == 1);
    for (int stop = 1; stop <= all.calls; ++stop) {
        listener l = {f, 0, stop, 0};
        CHECK_REFUSED(out,
                      cstk_motion_path(f->query, f->cobject, points, POINTS, FIXTURE_NQ, NULL,
                                       listen, &l, out.reached, &out.result),
                      CSTK_ERROR_CANCELLED, "progress");
        CHECK(l.calls == stop);
    }
    CHECK_OK(ask_path(f, points, POINTS, FIXTURE_NQ, NULL, &out));
    CHECK(out.result.motion.outcome == CSTK_MOTION_FREE && out.result.segment == POINTS - 2);
    CHECK_OK(ask_path(f, points, 1, FIXTURE_NQ, NULL, &out));
    CHECK(out.result.motion.outcome == CSTK_MOTION_FREE && out.result.segment == 0);
    for (int i = 0; i < FIXTURE_NQ; ++i) {
        CHECK(out.reached[i] == f->q[i]);
    }
}

typedef struct clearance_out {
    double nearest[FIXTURE_NQ];
    cstk_clearance_result result;
} clearance_out;

static cstk_status ask_clearance(const fixture *f, const double *q0, const double *q1, size_t nq,
                                 const cstk_clearance_options *options, clearance_out *out) {
    return cstk_motion_clearance(f->query, f->cobject, q0, q1, nq, options, out->nearest,
                                 &out->result);
}

static void clearances_refused(const fixture *f) {
    clearance_out out;
    const double *q = f->q;
    const size_t nq = FIXTURE_NQ;
    cstk_clearance_options good;
    CHECK_OK(cstk_clearance_options_default(&good, sizeof good));
    /* The default says nothing of the tolerance. */
    CHECK_REFUSED(out, ask_clearance(f, q, q, nq, &good, &out), CSTK_ERROR_INVALID_ARGUMENT,
                  "tolerance");
    good.tolerance = 1e-3;
    EACH_BAD_HANDLE(f, NOUN_QUERY, bad) {
        CHECK_REFUSED(out,
                      cstk_motion_clearance(bad->handle, f->cobject, q, q, nq, &good, out.nearest,
                                            &out.result),
                      bad->status, "query");
    }
    EACH_BAD_HANDLE(f, NOUN_COBJECT, bad) {
        CHECK_REFUSED(out,
                      cstk_motion_clearance(f->query, bad->handle, q, q, nq, &good, out.nearest,
                                            &out.result),
                      bad->status, "cobject");
    }
    CHECK_REFUSED(out, ask_clearance(f, NULL, q, nq, &good, &out), CSTK_ERROR_NULL_ARGUMENT, "q0");
    CHECK_REFUSED(out, ask_clearance(f, q, NULL, nq, &good, &out), CSTK_ERROR_NULL_ARGUMENT, "q1");
    CHECK_REFUSED(out, ask_clearance(f, q, q, nq, NULL, &out), CSTK_ERROR_NULL_ARGUMENT,
                  "clearance_options");
    CHECK_REFUSED(
        out, cstk_motion_clearance(f->query, f->cobject, q, q, nq, &good, out.nearest, NULL),
        CSTK_ERROR_NULL_ARGUMENT, "out");
    const size_t sizes[] = {0, 1, FIXTURE_NQ - 1, SIZE_MAX};
    for (int i = 0; i < 4; ++i) {
        CHECK_REFUSED(out, ask_clearance(f, q, q, sizes[i], &good, &out), CSTK_ERROR_WRONG_SIZE,
                      "");
    }
    EACH_BAD_OPTIONS(good, bad) {
        CHECK_REFUSED(out, ask_clearance(f, q, q, nq, bad->options, &out), bad->status,
                      "clearance_options");
    }
    for (int i = 0; i < 3; ++i) {
        double bad[FIXTURE_NQ] = {0};
        bad[i] = not_finite[i];
        CHECK_REFUSED(out, ask_clearance(f, bad, q, nq, &good, &out), CSTK_ERROR_NOT_FINITE, "q0");
        CHECK_REFUSED(out, ask_clearance(f, q, bad, nq, &good, &out), CSTK_ERROR_NOT_FINITE, "q1");
    }
    const struct {
        double tolerance;
        double relative;
        double max_distance;
        cstk_status status;
        const char *culprit;
    } wrong[] = {
        {0, 0, 1, CSTK_ERROR_INVALID_ARGUMENT, "tolerance"},
        {-1, 0, 1, CSTK_ERROR_INVALID_ARGUMENT, "tolerance"},
        {NAN, 0, 1, CSTK_ERROR_NOT_FINITE, "tolerance"},
        {INFINITY, 0, 1, CSTK_ERROR_NOT_FINITE, "tolerance"},
        {1e-3, -1e-3, 1, CSTK_ERROR_INVALID_ARGUMENT, "relative_tolerance"},
        {1e-3, 1, 1, CSTK_ERROR_INVALID_ARGUMENT, "relative_tolerance"},
        {1e-3, NAN, 1, CSTK_ERROR_NOT_FINITE, "relative_tolerance"},
        {1e-3, 0, -1, CSTK_ERROR_INVALID_ARGUMENT, "max_distance"},
        {1e-3, 0, NAN, CSTK_ERROR_NOT_FINITE, "max_distance"},
    };
    for (size_t i = 0; i < sizeof wrong / sizeof wrong[0]; ++i) {
        cstk_clearance_options given = good;
        given.tolerance = wrong[i].tolerance;
        given.relative_tolerance = wrong[i].relative;
        given.max_distance = wrong[i].max_distance;
        CHECK_REFUSED(out, ask_clearance(f, q, q, nq, &given, &out), wrong[i].status,
                      wrong[i].culprit);
    }
    cstk_cobject *complement = NULL;
    CHECK_OK(cstk_cobject_complement(f->cobject, &complement));
    CHECK_REFUSED(out,
                  cstk_motion_clearance(f->query, complement, q, q, nq, &good, out.nearest,
                                        &out.result),
                  CSTK_ERROR_UNSUPPORTED, "C-object");
    CHECK_OK(cstk_cobject_release(complement));
}

static void clearances(const fixture *f) {
    clearance_out out;
    cstk_clearance_options options;
    CHECK_OK(cstk_clearance_options_default(&options, sizeof options));
    options.tolerance = 1e-6;
    /* At rest it is the distance. */
    CHECK_OK(ask_clearance(f, f->q, f->q, FIXTURE_NQ, &options, &out));
    CHECK(out.result.outcome == CSTK_CLEARANCE_KNOWN);
    CHECK(out.result.distance.distance == f->distance.distance);
    CHECK(out.result.lower <= f->distance.upper && out.result.upper >= f->distance.lower);
    CHECK(out.result.upper - out.result.lower <= 1e-6);
    /* What is known agrees with the motion that turns the whole arm. */
    double turned[FIXTURE_NQ];
    memcpy(turned, f->q, sizeof turned);
    turned[0] += 6.0;
    cstk_motion_result motion;
    CHECK_OK(cstk_motion(f->query, f->cobject, f->q, turned, FIXTURE_NQ, NULL, NULL, &motion));
    CHECK_OK(ask_clearance(f, f->q, turned, FIXTURE_NQ, &options, &out));
    CHECK((motion.outcome == CSTK_MOTION_HIT) == (out.result.outcome == CSTK_CLEARANCE_HIT));
    CHECK(out.result.lower <= f->distance.distance);
    /* The path that goes there and back starts and ends where the motion does. */
    double points[2 * FIXTURE_NQ];
    memcpy(points, f->q, sizeof turned);
    memcpy(points + FIXTURE_NQ, turned, sizeof turned);
    path_out path;
    CHECK_OK(ask_path(f, points, 2, FIXTURE_NQ, NULL, &path));
    CHECK(path.result.motion.outcome == motion.outcome && path.result.segment == 0);
    CHECK(path.result.motion.times[1] == motion.times[1]);
    if (out.result.outcome == CSTK_CLEARANCE_HIT) {
        CHECK(out.result.lower == 0 && out.result.upper < 1e-9);
        /* From the contact on: what starts inside says so. */
        CHECK_OK(ask_clearance(f, out.nearest, turned, FIXTURE_NQ, &options, &out));
        CHECK(out.result.outcome == CSTK_CLEARANCE_HIT);
        memcpy(points, path.reached, sizeof turned);
        CHECK_OK(ask_path(f, points, 2, FIXTURE_NQ, NULL, &path));
        CHECK(path.result.motion.outcome == CSTK_MOTION_HIT && path.result.motion.times[1] == 0);
    }
    /* With hardly any work allowed. */
    CHECK_OK(cstk_query_set_limit(f->query, 1));
    CHECK_OK(ask_path(f, points, 2, FIXTURE_NQ, NULL, &path));
    /* What is far apart is proved free with no more. */
    CHECK(path.result.motion.outcome == CSTK_MOTION_UNDECIDED ||
          path.result.motion.outcome == motion.outcome);
    CHECK(path.result.segment == 0);
    CHECK_REFUSED(out, ask_clearance(f, f->q, turned, FIXTURE_NQ, &options, &out),
                  CSTK_ERROR_LIMIT, "limit");
    CHECK_OK(cstk_query_set_limit(f->query, 0));
}

int main(void) {
    fixture f;
    fixture_create(&f);
    arguments(&f);
    numbers(&f);
    options(&f);
    complements(&f);
    answers(&f);
    pairs(&f);
    paths_refused(&f);
    paths_report(&f);
    clearances_refused(&f);
    clearances(&f);
    fixture_unchanged(&f);
    fixture_release(&f);
    return check_result();
}
