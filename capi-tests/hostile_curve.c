/* Motions on curves, and as functions of the caller give them, with bad handles, numbers and functions. */
#include <math.h>

#include "check.h"
#include "fixture.h"

typedef struct motion_out {
    double reached[FIXTURE_NQ];
    cstk_motion_result result;
} motion_out;

static void curves(const fixture *f) {
    motion_out out;
    enum { COUNT = 3 };
    double points[COUNT * FIXTURE_NQ];
    for (int i = 0; i < COUNT * FIXTURE_NQ; ++i) {
        points[i] = f->q[i % FIXTURE_NQ];
    }
    const double knots[] = {0, 0, 0, 1, 1, 1};
    const size_t nq = FIXTURE_NQ;
    EACH_BAD_HANDLE(f, NOUN_QUERY, bad) {
        CHECK_REFUSED(out,
                      cstk_motion_curve(bad->handle, f->cobject, points, COUNT, nq, NULL,
                                        out.reached, &out.result),
                      bad->status, "query");
        CHECK_REFUSED(out,
                      cstk_motion_spline(bad->handle, f->cobject, 2, knots, 6, points, COUNT, nq,
                                         NULL, out.reached, &out.result),
                      bad->status, "query");
    }
    EACH_BAD_HANDLE(f, NOUN_COBJECT, bad) {
        CHECK_REFUSED(out,
                      cstk_motion_curve(f->query, bad->handle, points, COUNT, nq, NULL, out.reached,
                                        &out.result),
                      bad->status, "cobject");
        CHECK_REFUSED(out,
                      cstk_motion_spline(f->query, bad->handle, 2, knots, 6, points, COUNT, nq, NULL,
                                         out.reached, &out.result),
                      bad->status, "cobject");
    }
    CHECK_REFUSED(out,
                  cstk_motion_curve(f->query, f->cobject, NULL, COUNT, nq, NULL, out.reached,
                                    &out.result),
                  CSTK_ERROR_NULL_ARGUMENT, "points");
    CHECK_REFUSED(out,
                  cstk_motion_curve(f->query, f->cobject, points, COUNT, nq, NULL, out.reached, NULL),
                  CSTK_ERROR_NULL_ARGUMENT, "out");
    CHECK_REFUSED(out,
                  cstk_motion_spline(f->query, f->cobject, 2, NULL, 6, points, COUNT, nq, NULL,
                                     out.reached, &out.result),
                  CSTK_ERROR_NULL_ARGUMENT, "knots");
    CHECK_REFUSED(out,
                  cstk_motion_spline(f->query, f->cobject, 2, knots, 6, NULL, COUNT, nq, NULL,
                                     out.reached, &out.result),
                  CSTK_ERROR_NULL_ARGUMENT, "points");
    const size_t counts[] = {0, SIZE_MAX, SIZE_MAX / FIXTURE_NQ + 1};
    for (int i = 0; i < 3; ++i) {
        CHECK_REFUSED(out,
                      cstk_motion_curve(f->query, f->cobject, points, counts[i], nq, NULL,
                                        out.reached, &out.result),
                      CSTK_ERROR_WRONG_SIZE, "");
        CHECK_REFUSED(out,
                      cstk_motion_spline(f->query, f->cobject, 2, knots, 6, points, counts[i], nq,
                                         NULL, out.reached, &out.result),
                      CSTK_ERROR_WRONG_SIZE, "");
    }
    CHECK_REFUSED(out,
                  cstk_motion_curve(f->query, f->cobject, points, COUNT, nq - 1, NULL, out.reached,
                                    &out.result),
                  CSTK_ERROR_WRONG_SIZE, "nq");
    const struct {
        size_t degree;
        size_t knot_count;
        cstk_status status;
        const char *culprit;
    } wrong[] = {
        {0, 6, CSTK_ERROR_INVALID_ARGUMENT, "degree"},
        {SIZE_MAX, 6, CSTK_ERROR_INVALID_ARGUMENT, "degree"},
        {2, 5, CSTK_ERROR_WRONG_SIZE, "knots"},
        {2, 0, CSTK_ERROR_WRONG_SIZE, "knots"},
        {3, 6, CSTK_ERROR_WRONG_SIZE, "control points"},
    };
    for (size_t i = 0; i < sizeof wrong / sizeof wrong[0]; ++i) {
        CHECK_REFUSED(out,
                      cstk_motion_spline(f->query, f->cobject, wrong[i].degree, knots,
                                         wrong[i].knot_count, points, COUNT, nq, NULL, out.reached,
                                         &out.result),
                      wrong[i].status, wrong[i].culprit);
    }
    const double falling[] = {0, 0, 1, 0, 1, 1};
    const double unknown[] = {0, 0, NAN, 1, 1, 1};
    CHECK_REFUSED(out,
                  cstk_motion_spline(f->query, f->cobject, 2, falling, 6, points, COUNT, nq, NULL,
                                     out.reached, &out.result),
                  CSTK_ERROR_INVALID_ARGUMENT, "knot 3");
    CHECK_REFUSED(out,
                  cstk_motion_spline(f->query, f->cobject, 2, unknown, 6, points, COUNT, nq, NULL,
                                     out.reached, &out.result),
                  CSTK_ERROR_NOT_FINITE, "knot");
    points[nq] = NAN;
    CHECK_REFUSED(out,
                  cstk_motion_curve(f->query, f->cobject, points, COUNT, nq, NULL, out.reached,
                                    &out.result),
                  CSTK_ERROR_NOT_FINITE, "control point 1");
    points[nq] = f->q[0];
    /* What rests on a curve is where it was. */
    CHECK_OK(cstk_motion_curve(f->query, f->cobject, points, COUNT, nq, NULL, out.reached, &out.result));
    CHECK(out.result.outcome == CSTK_MOTION_FREE && out.reached[0] == f->q[0]);
    CHECK_OK(cstk_motion_spline(f->query, f->cobject, 2, knots, 6, points, COUNT, nq, NULL, NULL,
                                &out.result));
    CHECK(out.result.outcome == CSTK_MOTION_FREE);
}

/* What a motion function does at its calls. */
typedef struct caller {
    const fixture *f;
    int calls;
    int fails_at;
    double rate;
    bool writes;
} caller;

static int32_t give(double t, double *q, double *rates, double *accelerations, size_t nq,
                    void *user) {
    caller *asked = user;
    CHECK(nq == FIXTURE_NQ && t >= 0 && t <= 1);
    /* The context is busy; another may be asked. */
    cstk_class place;
    CHECK_FAILS(cstk_classify(asked->f->query, asked->f->cobject, asked->f->q, nq, &place),
                CSTK_ERROR_BUSY, "query");
    if (asked->calls++ == asked->fails_at) {
        return 17;
    }
    for (size_t i = 0; asked->writes && i < nq; ++i) {
        q[i] = asked->f->q[i];
        rates[i] = asked->rate;
        accelerations[i] = 0;
    }
    return CSTK_OK;
}

static void functions(const fixture *f) {
    motion_out out;
    const size_t nq = FIXTURE_NQ;
    double rests[FIXTURE_NQ] = {0}, wrong[FIXTURE_NQ] = {0};
    caller good = {f, 0, -1, 0, true};
    EACH_BAD_HANDLE(f, NOUN_QUERY, bad) {
        CHECK_REFUSED(out,
                      cstk_motion_function(bad->handle, f->cobject, give, &good, rests, rests, nq,
                                           NULL, out.reached, &out.result),
                      bad->status, "query");
    }
    EACH_BAD_HANDLE(f, NOUN_COBJECT, bad) {
        CHECK_REFUSED(out,
                      cstk_motion_function(f->query, bad->handle, give, &good, rests, rests, nq,
                                           NULL, out.reached, &out.result),
                      bad->status, "cobject");
    }
    CHECK_REFUSED(out,
                  cstk_motion_function(f->query, f->cobject, NULL, NULL, rests, rests, nq, NULL,
                                       out.reached, &out.result),
                  CSTK_ERROR_NULL_ARGUMENT, "function");
    CHECK_REFUSED(out,
                  cstk_motion_function(f->query, f->cobject, give, &good, NULL, rests, nq, NULL,
                                       out.reached, &out.result),
                  CSTK_ERROR_NULL_ARGUMENT, "max_rates");
    CHECK_REFUSED(out,
                  cstk_motion_function(f->query, f->cobject, give, &good, rests, NULL, nq, NULL,
                                       out.reached, &out.result),
                  CSTK_ERROR_NULL_ARGUMENT, "max_accelerations");
    CHECK_REFUSED(out,
                  cstk_motion_function(f->query, f->cobject, give, &good, rests, rests, nq, NULL,
                                       out.reached, NULL),
                  CSTK_ERROR_NULL_ARGUMENT, "out");
    CHECK_REFUSED(out,
                  cstk_motion_function(f->query, f->cobject, give, &good, rests, rests, nq + 1, NULL,
                                       out.reached, &out.result),
                  CSTK_ERROR_WRONG_SIZE, "nq");
    const double values[] = {NAN, INFINITY, -1};
    for (int i = 0; i < 3; ++i) {
        wrong[1] = values[i];
        CHECK_REFUSED(out,
                      cstk_motion_function(f->query, f->cobject, give, &good, wrong, rests, nq, NULL,
                                           out.reached, &out.result),
                      i < 2 ? CSTK_ERROR_NOT_FINITE : CSTK_ERROR_INVALID_ARGUMENT, "max_rates");
    }
    CHECK(good.calls == 0);
    caller fails = {f, 0, 0, 0, true}, writes_nothing = {f, 0, -1, 0, false};
    caller unknown = {f, 0, -1, NAN, true}, lies = {f, 0, -1, 1, true};
    CHECK_REFUSED(out,
                  cstk_motion_function(f->query, f->cobject, give, &fails, rests, rests, nq, NULL,
                                       out.reached, &out.result),
                  CSTK_ERROR_CALLBACK_FAILED, "17");
    CHECK_REFUSED(out,
                  cstk_motion_function(f->query, f->cobject, give, &writes_nothing, rests, rests, nq,
                                       NULL, out.reached, &out.result),
                  CSTK_ERROR_NOT_FINITE, "");
    CHECK_REFUSED(out,
                  cstk_motion_function(f->query, f->cobject, give, &unknown, rests, rests, nq, NULL,
                                       out.reached, &out.result),
                  CSTK_ERROR_NOT_FINITE, "rate");
    CHECK_REFUSED(out,
                  cstk_motion_function(f->query, f->cobject, give, &lies, rests, rests, nq, NULL,
                                       out.reached, &out.result),
                  CSTK_ERROR_INVALID_ARGUMENT, "max_rates");
    CHECK_OK(cstk_motion_function(f->query, f->cobject, give, &good, rests, rests, nq, NULL,
                                  out.reached, &out.result));
    CHECK(out.result.outcome == CSTK_MOTION_FREE && out.reached[0] == f->q[0] && good.calls > 0);
}

int main(void) {
    fixture f;
    fixture_create(&f);
    curves(&f);
    functions(&f);
    fixture_unchanged(&f);
    fixture_release(&f);
    return check_result();
}
