/* cstk_motion with bad handles, numbers and options; and what it says of clear cases. */
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

/* Sets of which no motion is proved are named. */
static void unsupported(const fixture *f) {
    motion_out out;
    cstk_cobject *complement = NULL;
    CHECK_OK(cstk_cobject_complement(f->cobject, &complement));
    CHECK_REFUSED(out,
                  cstk_motion(f->query, complement, f->q, f->q, FIXTURE_NQ, NULL, out.reached,
                              &out.result),
                  CSTK_ERROR_UNSUPPORTED, "C-object");
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

int main(void) {
    fixture f;
    fixture_create(&f);
    arguments(&f);
    numbers(&f);
    options(&f);
    unsupported(&f);
    answers(&f);
    fixture_unchanged(&f);
    fixture_release(&f);
    return check_result();
}
