/* cstk_region_classify and cstk_region_grow with bad handles, numbers and options; and what they say of clear cases. */
#include <math.h>

#include "check.h"
#include "fixture.h"

enum { SIDES = 2 * FIXTURE_NQ };

typedef struct region_out {
    double inside[FIXTURE_NQ];
    double outside[FIXTURE_NQ];
    cstk_region_result result;
} region_out;

typedef struct grow_out {
    double low[FIXTURE_NQ];
    double high[FIXTURE_NQ];
    cstk_region_side sides[SIDES];
} grow_out;

static void arguments_of_classify(const fixture *f) {
    region_out out;
    const double *q = f->q;
    const size_t nq = FIXTURE_NQ;
    EACH_BAD_HANDLE(f, NOUN_QUERY, bad) {
        CHECK_REFUSED(out,
                      cstk_region_classify(bad->handle, f->cobject, q, q, nq, NULL, out.inside,
                                           out.outside, &out.result),
                      bad->status, "query");
    }
    EACH_BAD_HANDLE(f, NOUN_COBJECT, bad) {
        CHECK_REFUSED(out,
                      cstk_region_classify(f->query, bad->handle, q, q, nq, NULL, out.inside,
                                           out.outside, &out.result),
                      bad->status, "cobject");
    }
    CHECK_REFUSED(out,
                  cstk_region_classify(f->query, f->cobject, NULL, q, nq, NULL, out.inside,
                                       out.outside, &out.result),
                  CSTK_ERROR_NULL_ARGUMENT, "low");
    CHECK_REFUSED(out,
                  cstk_region_classify(f->query, f->cobject, q, NULL, nq, NULL, out.inside,
                                       out.outside, &out.result),
                  CSTK_ERROR_NULL_ARGUMENT, "high");
    CHECK_REFUSED(out,
                  cstk_region_classify(f->query, f->cobject, q, q, nq, NULL, out.inside, out.outside,
                                       NULL),
                  CSTK_ERROR_NULL_ARGUMENT, "out");
    const size_t counts[] = {0, 1, FIXTURE_NQ - 1, SIZE_MAX};
    for (int i = 0; i < 4; ++i) {
        CHECK_REFUSED(out,
                      cstk_region_classify(f->query, f->cobject, q, q, counts[i], NULL, NULL, NULL,
                                           &out.result),
                      CSTK_ERROR_WRONG_SIZE, "");
    }
}

static void numbers_of_classify(const fixture *f) {
    region_out out;
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
                          cstk_region_classify(f->query, f->cobject, bad, f->q, FIXTURE_NQ, NULL,
                                               out.inside, out.outside, &out.result),
                          status, "low");
            CHECK_REFUSED(out,
                          cstk_region_classify(f->query, f->cobject, f->q, bad, FIXTURE_NQ, NULL,
                                               out.inside, out.outside, &out.result),
                          status, "high");
            CHECK_REFUSED(out,
                          cstk_region_grow(f->query, f->cobject, bad, FIXTURE_NQ, NULL, 0, NULL,
                                           out.inside, out.outside, NULL, 0),
                          status, "");
        }
    }
    for (int k = 0; k < FIXTURE_NQ; ++k) {
        double above[FIXTURE_NQ];
        for (int j = 0; j < FIXTURE_NQ; ++j) {
            above[j] = f->q[j] + (j == k ? 0.1 : 0.0);
        }
        char name[32];
        snprintf(name, sizeof name, "coordinate %d", k);
        CHECK_REFUSED(out,
                      cstk_region_classify(f->query, f->cobject, above, f->q, FIXTURE_NQ, NULL,
                                           out.inside, out.outside, &out.result),
                      CSTK_ERROR_INVALID_ARGUMENT, name);
    }
}

static void arguments_of_grow(const fixture *f) {
    grow_out out;
    const double *q = f->q;
    const size_t nq = FIXTURE_NQ;
    const double ones[FIXTURE_NQ] = {1, 1, 1};
    EACH_BAD_HANDLE(f, NOUN_QUERY, bad) {
        CHECK_REFUSED(out,
                      cstk_region_grow(bad->handle, f->cobject, q, nq, ones, nq, NULL, out.low,
                                       out.high, out.sides, SIDES),
                      bad->status, "query");
    }
    EACH_BAD_HANDLE(f, NOUN_COBJECT, bad) {
        CHECK_REFUSED(out,
                      cstk_region_grow(f->query, bad->handle, q, nq, ones, nq, NULL, out.low,
                                       out.high, out.sides, SIDES),
                      bad->status, "cobject");
    }
    CHECK_REFUSED(out,
                  cstk_region_grow(f->query, f->cobject, NULL, nq, ones, nq, NULL, out.low, out.high,
                                   out.sides, SIDES),
                  CSTK_ERROR_NULL_ARGUMENT, "q");
    CHECK_REFUSED(out,
                  cstk_region_grow(f->query, f->cobject, q, nq, NULL, nq, NULL, out.low, out.high,
                                   out.sides, SIDES),
                  CSTK_ERROR_NULL_ARGUMENT, "weights");
    CHECK_REFUSED(out,
                  cstk_region_grow(f->query, f->cobject, q, nq, ones, nq, NULL, NULL, out.high,
                                   out.sides, SIDES),
                  CSTK_ERROR_NULL_ARGUMENT, "low");
    CHECK_REFUSED(out,
                  cstk_region_grow(f->query, f->cobject, q, nq, ones, nq, NULL, out.low, NULL,
                                   out.sides, SIDES),
                  CSTK_ERROR_NULL_ARGUMENT, "high");
    CHECK_REFUSED(out,
                  cstk_region_grow(f->query, f->cobject, q, nq, ones, nq, NULL, out.low, out.high,
                                   NULL, SIDES),
                  CSTK_ERROR_NULL_ARGUMENT, "sides");
    CHECK_REFUSED(out,
                  cstk_region_grow(f->query, f->cobject, q, nq, ones, nq - 1, NULL, out.low,
                                   out.high, out.sides, SIDES),
                  CSTK_ERROR_WRONG_SIZE, "weights");
    CHECK_REFUSED(out,
                  cstk_region_grow(f->query, f->cobject, q, nq, ones, nq, NULL, out.low, out.high,
                                   out.sides, SIDES - 1),
                  CSTK_ERROR_WRONG_SIZE, "sides");
    const size_t counts[] = {0, 1, FIXTURE_NQ - 1, SIZE_MAX};
    for (int i = 0; i < 4; ++i) {
        CHECK_REFUSED(out,
                      cstk_region_grow(f->query, f->cobject, q, counts[i], ones, nq, NULL, out.low,
                                       out.high, out.sides, SIDES),
                      CSTK_ERROR_WRONG_SIZE, "");
    }
    const double wrong[] = {NAN, INFINITY, -1.0};
    for (int i = 0; i < 3; ++i) {
        const double weights[FIXTURE_NQ] = {1, wrong[i], 1};
        CHECK_REFUSED(out,
                      cstk_region_grow(f->query, f->cobject, q, nq, weights, nq, NULL, out.low,
                                       out.high, out.sides, SIDES),
                      i < 2 ? CSTK_ERROR_NOT_FINITE : CSTK_ERROR_INVALID_ARGUMENT, "weight");
    }
}

static void options(const fixture *f) {
    region_out out;
    cstk_region_options good;
    CHECK_OK(cstk_region_options_default(&good, sizeof good));
    EACH_BAD_OPTIONS(good, bad) {
        CHECK_REFUSED(out,
                      cstk_region_classify(f->query, f->cobject, f->q, f->q, FIXTURE_NQ, bad->options,
                                           out.inside, out.outside, &out.result),
                      bad->status, "options");
    }
    good.max_boxes = 0;
    CHECK_REFUSED(out,
                  cstk_region_classify(f->query, f->cobject, f->q, f->q, FIXTURE_NQ, &good,
                                       out.inside, out.outside, &out.result),
                  CSTK_ERROR_INVALID_ARGUMENT, "max_boxes");
    grow_out grown;
    cstk_growth_options growth;
    CHECK_OK(cstk_growth_options_default(&growth, sizeof growth));
    EACH_BAD_OPTIONS(growth, bad) {
        CHECK_REFUSED(grown,
                      cstk_region_grow(f->query, f->cobject, f->q, FIXTURE_NQ, NULL, 0, bad->options,
                                       grown.low, grown.high, grown.sides, SIDES),
                      bad->status, "options");
    }
    const struct {
        double tolerance;
        double max_side;
        uint64_t max_boxes;
        cstk_status status;
        const char *culprit;
    } wrong[] = {
        {0, 1, 9, CSTK_ERROR_INVALID_ARGUMENT, "tolerance"},
        {-1, 1, 9, CSTK_ERROR_INVALID_ARGUMENT, "tolerance"},
        {NAN, 1, 9, CSTK_ERROR_NOT_FINITE, "tolerance"},
        {0.1, 0, 9, CSTK_ERROR_INVALID_ARGUMENT, "max_side"},
        {0.1, INFINITY, 9, CSTK_ERROR_NOT_FINITE, "max_side"},
        {0.1, 1, 0, CSTK_ERROR_INVALID_ARGUMENT, "max_boxes"},
    };
    for (size_t i = 0; i < sizeof wrong / sizeof wrong[0]; ++i) {
        cstk_growth_options given = growth;
        given.tolerance = wrong[i].tolerance;
        given.max_side = wrong[i].max_side;
        given.max_boxes = wrong[i].max_boxes;
        CHECK_REFUSED(grown,
                      cstk_region_grow(f->query, f->cobject, f->q, FIXTURE_NQ, NULL, 0, &given,
                                       grown.low, grown.high, grown.sides, SIDES),
                      wrong[i].status, wrong[i].culprit);
    }
}

static void answers(const fixture *f) {
    region_out out;
    /* One configuration is a box too. */
    CHECK_OK(cstk_region_classify(f->query, f->cobject, f->q, f->q, FIXTURE_NQ, NULL, NULL,
                                  out.outside, &out.result));
    CHECK(out.result.outcome == CSTK_REGION_FREE && out.result.proved == 1);
    CHECK(out.result.has_outside && !out.result.has_inside);
    /* Nothing is known to meet or not with one part of a box that is a whole turn wide, but nothing false is said. */
    double low[FIXTURE_NQ], high[FIXTURE_NQ];
    for (int i = 0; i < FIXTURE_NQ; ++i) {
        low[i] = f->q[i] - 3;
        high[i] = f->q[i] + 3;
    }
    CHECK_OK(cstk_region_classify(f->query, f->cobject, low, high, FIXTURE_NQ, NULL, out.inside,
                                  out.outside, &out.result));
    cstk_class place;
    if (out.result.has_inside) {
        CHECK_OK(cstk_classify(f->query, f->cobject, out.inside, FIXTURE_NQ, &place));
        CHECK(place == CSTK_CLASS_INSIDE);
    }
    CHECK(out.result.outcome == CSTK_REGION_MIXED || out.result.outcome == CSTK_REGION_FREE ||
          out.result.outcome == CSTK_REGION_UNDECIDED);
    grow_out grown;
    CHECK_OK(cstk_region_grow(f->query, f->cobject, f->q, FIXTURE_NQ, NULL, 0, NULL, grown.low,
                              grown.high, grown.sides, SIDES));
    for (int i = 0; i < FIXTURE_NQ; ++i) {
        CHECK(grown.low[i] <= f->q[i] && f->q[i] <= grown.high[i]);
    }
    CHECK_OK(cstk_region_classify(f->query, f->cobject, grown.low, grown.low, FIXTURE_NQ, NULL, NULL,
                                  NULL, &out.result));
    CHECK(out.result.outcome == CSTK_REGION_FREE);
    /* With a limit nothing is proved, or the call says so. */
    CHECK_OK(cstk_query_set_limit(f->query, 1));
    const cstk_status limited = cstk_region_classify(f->query, f->cobject, low, high, FIXTURE_NQ,
                                                     NULL, NULL, NULL, &out.result);
    CHECK(limited == CSTK_ERROR_LIMIT ||
          (limited == CSTK_OK && out.result.outcome != CSTK_REGION_INSIDE));
    CHECK_OK(cstk_query_set_limit(f->query, 0));
}

int main(void) {
    fixture f;
    fixture_create(&f);
    arguments_of_classify(&f);
    numbers_of_classify(&f);
    arguments_of_grow(&f);
    options(&f);
    answers(&f);
    fixture_unchanged(&f);
    fixture_release(&f);
    return check_result();
}
