/* What is asked of and done with whole paths, clearances, shortcuts and slides to goals, with bad handles, numbers and options; and what
 * they say of clear cases. */
#include <math.h>

#include "check.h"
#include "fixture.h"

enum { POINTS = 3, NQ = FIXTURE_NQ };

/* The fixture's configuration, three times. */
static void resting(const fixture *f, double points[POINTS * NQ]) {
    for (int i = 0; i < POINTS * NQ; ++i) {
        points[i] = f->q[i % NQ];
    }
}

typedef struct clearance_out {
    double nearest[NQ];
    cstk_path_clearance_result result;
} clearance_out;

static cstk_status ask_clearance(const fixture *f, const double *points, size_t count, size_t nq,
                                 const cstk_clearance_options *options, clearance_out *out) {
    return cstk_path_clearance(f->query, f->cobject, points, count, nq, options, NULL, NULL,
                               out->nearest, &out->result);
}

static cstk_status ask_shortcut(const fixture *f, const double *points, size_t count, size_t nq,
                                const cstk_shortcut_options *options, cstk_shortcut_result *out) {
    return cstk_path_shortcut(f->query, f->cobject, points, count, nq, options, NULL, NULL, out);
}

/* Points and sizes that neither of the two takes. */
static void points_refused(const fixture *f, const cstk_clearance_options *options) {
    clearance_out out;
    cstk_shortcut_result cut;
    double points[POINTS * NQ];
    resting(f, points);
    const struct {
        const double *points;
        size_t count, nq;
        cstk_status status;
        const char *culprit;
    } bad[] = {
        {NULL, POINTS, NQ, CSTK_ERROR_NULL_ARGUMENT, "points"},
        {points, 0, NQ, CSTK_ERROR_WRONG_SIZE, "count"},
        {points, SIZE_MAX, NQ, CSTK_ERROR_WRONG_SIZE, "points"},
        {points, POINTS, 0, CSTK_ERROR_WRONG_SIZE, "nq"},
        {points, POINTS, NQ - 1, CSTK_ERROR_WRONG_SIZE, "nq"},
        {points, POINTS, SIZE_MAX, CSTK_ERROR_WRONG_SIZE, "nq"},
    };
    for (size_t i = 0; i < sizeof bad / sizeof bad[0]; ++i) {
        CHECK_REFUSED(out, ask_clearance(f, bad[i].points, bad[i].count, bad[i].nq, options, &out),
                      bad[i].status, bad[i].culprit);
        CHECK_REFUSED(cut, ask_shortcut(f, bad[i].points, bad[i].count, bad[i].nq, NULL, &cut),
                      bad[i].status, bad[i].culprit);
    }
    for (int i = 0; i < 3; ++i) {
        resting(f, points);
        points[NQ + 1] = not_finite[i];
        CHECK_REFUSED(out, ask_clearance(f, points, POINTS, NQ, options, &out),
                      CSTK_ERROR_NOT_FINITE, "point 1");
        CHECK_REFUSED(cut, ask_shortcut(f, points, POINTS, NQ, NULL, &cut), CSTK_ERROR_NOT_FINITE,
                      "point 1");
    }
}

static void handles_refused(const fixture *f, const cstk_clearance_options *options) {
    clearance_out out;
    cstk_shortcut_result cut;
    double points[POINTS * NQ];
    resting(f, points);
    EACH_BAD_HANDLE(f, NOUN_QUERY, bad) {
        CHECK_REFUSED(out,
                      cstk_path_clearance(bad->handle, f->cobject, points, POINTS, NQ, options,
                                          NULL, NULL, out.nearest, &out.result),
                      bad->status, "query");
        CHECK_REFUSED(cut,
                      cstk_path_shortcut(bad->handle, f->cobject, points, POINTS, NQ, NULL, NULL,
                                         NULL, &cut),
                      bad->status, "query");
    }
    EACH_BAD_HANDLE(f, NOUN_COBJECT, bad) {
        CHECK_REFUSED(out,
                      cstk_path_clearance(f->query, bad->handle, points, POINTS, NQ, options, NULL,
                                          NULL, out.nearest, &out.result),
                      bad->status, "cobject");
        CHECK_REFUSED(cut,
                      cstk_path_shortcut(f->query, bad->handle, points, POINTS, NQ, NULL, NULL,
                                         NULL, &cut),
                      bad->status, "cobject");
    }
    CHECK_REFUSED(out,
                  cstk_path_clearance(f->query, f->cobject, points, POINTS, NQ, options, NULL, NULL,
                                      out.nearest, NULL),
                  CSTK_ERROR_NULL_ARGUMENT, "out");
    CHECK_REFUSED(
        cut,
        cstk_path_shortcut(f->query, f->cobject, points, POINTS, NQ, NULL, NULL, NULL, NULL),
        CSTK_ERROR_NULL_ARGUMENT, "out");
}

static void options_refused(const fixture *f, const cstk_clearance_options *good) {
    clearance_out out;
    cstk_shortcut_result cut;
    double points[POINTS * NQ];
    resting(f, points);
    CHECK_REFUSED(out, ask_clearance(f, points, POINTS, NQ, NULL, &out), CSTK_ERROR_NULL_ARGUMENT,
                  "clearance_options");
    EACH_BAD_OPTIONS(*good, bad) {
        CHECK_REFUSED(out, ask_clearance(f, points, POINTS, NQ, bad->options, &out), bad->status,
                      "clearance_options");
    }
    cstk_clearance_options zero = *good;
    zero.tolerance = 0;
    CHECK_REFUSED(out, ask_clearance(f, points, POINTS, NQ, &zero, &out),
                  CSTK_ERROR_INVALID_ARGUMENT, "tolerance");
    cstk_shortcut_options plain;
    CHECK_OK(cstk_shortcut_options_default(&plain, sizeof plain));
    EACH_BAD_OPTIONS(plain, bad) {
        CHECK_REFUSED(cut, ask_shortcut(f, points, POINTS, NQ, bad->options, &cut), bad->status,
                      "options");
    }
    plain.threshold = -1;
    CHECK_REFUSED(cut, ask_shortcut(f, points, POINTS, NQ, &plain, &cut),
                  CSTK_ERROR_INVALID_ARGUMENT, "threshold");
    plain.threshold = NAN;
    CHECK_REFUSED(cut, ask_shortcut(f, points, POINTS, NQ, &plain, &cut), CSTK_ERROR_NOT_FINITE,
                  "threshold");
    cstk_cobject *complement = NULL;
    CHECK_OK(cstk_cobject_complement(f->cobject, &complement));
    CHECK_REFUSED(out,
                  cstk_path_clearance(f->query, complement, points, POINTS, NQ, good, NULL, NULL,
                                      out.nearest, &out.result),
                  CSTK_ERROR_UNSUPPORTED, "C-object");
    CHECK_OK(cstk_path_shortcut(f->query, complement, points, POINTS, NQ, NULL, NULL, NULL, &cut));
    CHECK(cut.outcome == CSTK_SHORTCUT_NOT_FREE && cut.given.segment == 0);
    CHECK(cut.path.count == POINTS && cut.path.nq == NQ && cut.path.points[0] == f->q[0]);
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
    cstk_shortcut_result out;
    CHECK(ask_shortcut(l->f, l->f->q, 1, NQ, NULL, &out) == CSTK_ERROR_BUSY);
    return ++l->calls == l->stop_at;
}

static void paths_report(const fixture *f, const cstk_clearance_options *options) {
    clearance_out out;
    cstk_shortcut_result cut;
    double points[POINTS * NQ];
    resting(f, points);
    listener all = {f, 0, 0, 0};
    CHECK_OK(cstk_path_clearance(f->query, f->cobject, points, POINTS, NQ, options, listen, &all,
                                 out.nearest, &out.result));
    CHECK(all.calls == POINTS && all.last == 1);
    /* At rest it is the distance. */
    CHECK(out.result.clearance.outcome == CSTK_CLEARANCE_KNOWN);
    CHECK(out.result.clearance.distance.distance == f->distance.distance);
    for (int stop = 1; stop <= all.calls; ++stop) {
        listener l = {f, 0, stop, 0};
        CHECK_REFUSED(out,
                      cstk_path_clearance(f->query, f->cobject, points, POINTS, NQ, options, listen,
                                          &l, out.nearest, &out.result),
                      CSTK_ERROR_CANCELLED, "progress");
    }
    points[NQ] += 0.01;
    listener cuts = {f, 0, 0, 0};
    CHECK_OK(cstk_path_shortcut(f->query, f->cobject, points, POINTS, NQ, NULL, listen, &cuts, &cut));
    CHECK(cuts.last == 1 && cut.outcome == CSTK_SHORTCUT_DONE);
    CHECK(cut.length_after <= cut.length_before);
    /* What belongs to the context may be given to its next call. */
    CHECK_OK(ask_clearance(f, cut.path.points, cut.path.count, cut.path.nq, options, &out));
    CHECK_OK(ask_shortcut(f, cut.path.points, cut.path.count, cut.path.nq, NULL, &cut));
    listener l = {f, 0, 2, 0};
    CHECK_REFUSED(
        cut,
        cstk_path_shortcut(f->query, f->cobject, points, POINTS, NQ, NULL, listen, &l, &cut),
        CSTK_ERROR_CANCELLED, "progress");
}

typedef struct slide_case {
    const double *q, *low, *high;
    size_t nq;
    const double *weights;
    size_t nv;
    cstk_status status;
    const char *culprit;
} slide_case;

static cstk_status ask_slide(const fixture *f, const slide_case *c, const cstk_slide_options *slide,
                             const cstk_slide_to_options *options, cstk_slide_to_result *out) {
    return cstk_slide_to(f->query, f->cobject, c->q, c->low, c->high, c->nq, c->weights, c->nv,
                         slide, options, NULL, NULL, out);
}

static void slides_refused(const fixture *f, const cstk_slide_options *slide,
                           const cstk_slide_to_options *good) {
    cstk_slide_to_result out;
    const double *q = f->q;
    double above[NQ], free_ends[NQ], half[NQ], nan[NQ];
    for (int i = 0; i < NQ; ++i) {
        above[i] = q[i] + 1;
        free_ends[i] = INFINITY;
        half[i] = -INFINITY;
        nan[i] = NAN;
    }
    const double ones[NQ + 1] = {1, 1, 1, 1}, zero[NQ] = {0};
    const slide_case bad[] = {
        {NULL, q, q, NQ, NULL, 0, CSTK_ERROR_NULL_ARGUMENT, "q"},
        {q, NULL, q, NQ, NULL, 0, CSTK_ERROR_NULL_ARGUMENT, "goal_low"},
        {q, q, NULL, NQ, NULL, 0, CSTK_ERROR_NULL_ARGUMENT, "goal_high"},
        {q, q, q, 0, NULL, 0, CSTK_ERROR_WRONG_SIZE, ""},
        {q, q, q, NQ - 1, NULL, 0, CSTK_ERROR_WRONG_SIZE, ""},
        {q, q, q, SIZE_MAX, NULL, 0, CSTK_ERROR_WRONG_SIZE, ""},
        {nan, q, q, NQ, NULL, 0, CSTK_ERROR_NOT_FINITE, ""},
        {q, nan, q, NQ, NULL, 0, CSTK_ERROR_NOT_FINITE, "goal_low"},
        {q, q, nan, NQ, NULL, 0, CSTK_ERROR_NOT_FINITE, "goal_high"},
        {q, half, q, NQ, NULL, 0, CSTK_ERROR_NOT_FINITE, "goal_low"},
        {q, free_ends, half, NQ, NULL, 0, CSTK_ERROR_NOT_FINITE, "goal_low"},
        {q, above, q, NQ, NULL, 0, CSTK_ERROR_INVALID_ARGUMENT, "goal_low"},
        {q, q, q, NQ, NULL, NQ, CSTK_ERROR_NULL_ARGUMENT, "weights"},
        {q, q, q, NQ, ones, NQ + 1, CSTK_ERROR_WRONG_SIZE, "weight"},
        {q, q, q, NQ, ones, SIZE_MAX, CSTK_ERROR_WRONG_SIZE, "weights"},
        {q, q, q, NQ, zero, NQ, CSTK_ERROR_INVALID_ARGUMENT, "weight"},
        {q, q, q, NQ, nan, NQ, CSTK_ERROR_NOT_FINITE, "weight"},
    };
    for (size_t i = 0; i < sizeof bad / sizeof bad[0]; ++i) {
        CHECK_REFUSED(out, ask_slide(f, &bad[i], slide, good, &out), bad[i].status, bad[i].culprit);
    }
    const slide_case stay = {q, q, q, NQ, NULL, 0, CSTK_OK, ""};
    EACH_BAD_HANDLE(f, NOUN_QUERY, handle) {
        CHECK_REFUSED(out,
                      cstk_slide_to(handle->handle, f->cobject, q, q, q, NQ, NULL, 0, slide, good,
                                    NULL, NULL, &out),
                      handle->status, "query");
    }
    EACH_BAD_HANDLE(f, NOUN_COBJECT, handle) {
        CHECK_REFUSED(out,
                      cstk_slide_to(f->query, handle->handle, q, q, q, NQ, NULL, 0, slide, good,
                                    NULL, NULL, &out),
                      handle->status, "cobject");
    }
    CHECK_REFUSED(out, ask_slide(f, &stay, slide, good, NULL), CSTK_ERROR_NULL_ARGUMENT, "out");
    CHECK_REFUSED(out, ask_slide(f, &stay, NULL, good, &out), CSTK_ERROR_NULL_ARGUMENT,
                  "slide_options");
    CHECK_REFUSED(out, ask_slide(f, &stay, slide, NULL, &out), CSTK_ERROR_NULL_ARGUMENT, "options");
    EACH_BAD_OPTIONS(*slide, given) {
        CHECK_REFUSED(out, ask_slide(f, &stay, given->options, good, &out), given->status,
                      "slide_options");
    }
    EACH_BAD_OPTIONS(*good, given) {
        CHECK_REFUSED(out, ask_slide(f, &stay, slide, given->options, &out), given->status,
                      "options");
    }
}

/* One field at a time. */
static void slide_options_refused(const fixture *f, const cstk_slide_options *slide,
                                  const cstk_slide_to_options *good) {
    cstk_slide_to_result out;
    const slide_case stay = {f->q, f->q, f->q, NQ, NULL, 0, CSTK_OK, ""};
    const struct {
        double step, tolerance, min_gain;
        uint64_t max_steps, between;
        cstk_status status;
        const char *culprit;
    } wrong[] = {
        {0, 0, 0.1, 9, 9, CSTK_ERROR_INVALID_ARGUMENT, "step"},
        {-1, 0, 0.1, 9, 9, CSTK_ERROR_INVALID_ARGUMENT, "step"},
        {NAN, 0, 0.1, 9, 9, CSTK_ERROR_NOT_FINITE, "step"},
        {INFINITY, 0, 0.1, 9, 9, CSTK_ERROR_NOT_FINITE, "step"},
        {1, -1, 0.1, 9, 9, CSTK_ERROR_INVALID_ARGUMENT, "tolerance"},
        {1, NAN, 0.1, 9, 9, CSTK_ERROR_NOT_FINITE, "tolerance"},
        {1, 0, 1, 9, 9, CSTK_ERROR_INVALID_ARGUMENT, "min_gain"},
        {1, 0, NAN, 9, 9, CSTK_ERROR_NOT_FINITE, "min_gain"},
        {1, 0, 0.1, 0, 9, CSTK_ERROR_INVALID_ARGUMENT, "max_steps"},
        {1, 0, 0.1, 9, 0, CSTK_ERROR_INVALID_ARGUMENT, "steps_between_motions"},
    };
    for (size_t i = 0; i < sizeof wrong / sizeof wrong[0]; ++i) {
        cstk_slide_to_options given = *good;
        given.step = wrong[i].step;
        given.tolerance = wrong[i].tolerance;
        given.min_gain = wrong[i].min_gain;
        given.max_steps = wrong[i].max_steps;
        given.steps_between_motions = wrong[i].between;
        CHECK_REFUSED(out, ask_slide(f, &stay, slide, &given, &out), wrong[i].status,
                      wrong[i].culprit);
    }
    cstk_slide_options no_shell = *slide;
    no_shell.max_shell = 0;
    CHECK_REFUSED(out, ask_slide(f, &stay, &no_shell, good, &out), CSTK_ERROR_INVALID_ARGUMENT,
                  "max_shell");
}

static void slides(const fixture *f, const cstk_slide_options *slide,
                   const cstk_slide_to_options *options) {
    cstk_slide_to_result out;
    const slide_case stay = {f->q, f->q, f->q, NQ, NULL, 0, CSTK_OK, ""};
    CHECK_OK(ask_slide(f, &stay, slide, options, &out));
    CHECK(out.outcome == CSTK_SLIDE_TO_ARRIVED && out.path.count == 1 && out.remaining == 0);
    double turned[NQ];
    memcpy(turned, f->q, sizeof turned);
    turned[0] += 6.0;
    const slide_case turn = {f->q, turned, turned, NQ, NULL, 0, CSTK_OK, ""};
    CHECK_OK(ask_slide(f, &turn, slide, options, &out));
    CHECK(out.path.count >= 1 && out.path.nq == NQ);
    CHECK((out.outcome == CSTK_SLIDE_TO_ARRIVED) == (out.remaining == 0));
    CHECK(memcmp(out.path.points, f->q, sizeof f->q) == 0);
    /* Its path may be given to the next call. */
    cstk_shortcut_result cut;
    CHECK_OK(ask_shortcut(f, out.path.points, out.path.count, NQ, NULL, &cut));
    CHECK(cut.outcome == CSTK_SHORTCUT_DONE);
    listener l = {f, 0, 1, 0};
    CHECK_REFUSED(out,
                  cstk_slide_to(f->query, f->cobject, f->q, turned, turned, NQ, NULL, 0, slide,
                                options, listen, &l, &out),
                  CSTK_ERROR_CANCELLED, "progress");
    /* With hardly any work allowed. */
    CHECK_OK(cstk_query_set_limit(f->query, 1));
    CHECK_OK(ask_slide(f, &turn, slide, options, &out));
    CHECK(out.outcome == CSTK_SLIDE_TO_LIMITED || out.remaining == 0);
    CHECK_OK(cstk_query_set_limit(f->query, 0));
}

int main(void) {
    fixture f;
    fixture_create(&f);
    cstk_clearance_options clearance;
    CHECK_OK(cstk_clearance_options_default(&clearance, sizeof clearance));
    clearance.tolerance = 1e-6;
    points_refused(&f, &clearance);
    handles_refused(&f, &clearance);
    options_refused(&f, &clearance);
    paths_report(&f, &clearance);
    cstk_slide_options slide;
    CHECK_OK(cstk_slide_options_default(&slide, sizeof slide));
    slide.max_shell = 0.2;
    cstk_slide_to_options options;
    CHECK_OK(cstk_slide_to_options_default(&options, sizeof options));
    options.step = 0.1;
    slides_refused(&f, &slide, &options);
    slide_options_refused(&f, &slide, &options);
    slides(&f, &slide, &options);
    fixture_unchanged(&f);
    fixture_release(&f);
    return check_result();
}
