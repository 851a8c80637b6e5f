/* Batches with bad handles, arrays, numbers and options; items that fail alone; batches that are cancelled, or called back into. */
#include <math.h>
#include <stddef.h>

#include "batch_calls.h"
#include "check.h"
#include "fixture.h"

static outputs out;

static void bad_arguments(const fixture *f) {
    inputs in = good_inputs(f);
    EACH_CALL(i, all_calls) {
        EACH_BAD_HANDLE(f, NOUN_BATCH, bad) {
            in.batch = bad->handle;
            CHECK_REFUSED(out, all_calls[i](&in, &out), bad->status, "batch");
        }
        in = good_inputs(f);
        in.without_statuses = true;
        CHECK_REFUSED(out, all_calls[i](&in, &out), CSTK_ERROR_NULL_ARGUMENT, "statuses");
        in = good_inputs(f);
        in.without_out = true;
        CHECK_REFUSED(out, all_calls[i](&in, &out), CSTK_ERROR_NULL_ARGUMENT, "out");
        in = good_inputs(f);
        in.count = SIZE_MAX;
        CHECK_REFUSED(out, all_calls[i](&in, &out), CSTK_ERROR_WRONG_SIZE, "cannot have");
        in.count = SIZE_MAX / 16;
        CHECK_REFUSED(out, all_calls[i](&in, &out), CSTK_ERROR_WRONG_SIZE, "cannot have");
        in = good_inputs(f);
    }
    in.without_answers = true;
    CHECK_REFUSED(out, batch_classify(&in, &out), CSTK_ERROR_NULL_ARGUMENT, "classes");
    CHECK_REFUSED(out, batch_within(&in, &out), CSTK_ERROR_NULL_ARGUMENT, "within");
    CHECK_REFUSED(out, batch_motion(&in, &out), CSTK_ERROR_NULL_ARGUMENT, "results");
    CHECK_REFUSED(out, batch_pair_within(&in, &out), CSTK_ERROR_NULL_ARGUMENT, "within");
    EACH_CALL(i, of_robots) {
        EACH_BAD_HANDLE(f, NOUN_COBJECT, bad) {
            in = good_inputs(f);
            in.cobject = bad->handle;
            CHECK_REFUSED(out, of_robots[i](&in, &out), bad->status, "cobject");
        }
        in = good_inputs(f);
        in.q = NULL;
        CHECK_REFUSED(out, of_robots[i](&in, &out), CSTK_ERROR_NULL_ARGUMENT, "q");
        const size_t widths[] = {0, 1, NQ + 1, SIZE_MAX};
        for (int k = 0; k < 4; ++k) {
            in = good_inputs(f);
            in.nq = widths[k];
            CHECK_REFUSED(out, of_robots[i](&in, &out), CSTK_ERROR_WRONG_SIZE, "nq");
        }
    }
    in = good_inputs(f);
    in.q1 = NULL;
    CHECK_REFUSED(out, batch_motion(&in, &out), CSTK_ERROR_NULL_ARGUMENT, "q1");
    in = good_inputs(f);
    in.nv = NQ - 1;
    CHECK_REFUSED(out, batch_distance(&in, &out), CSTK_ERROR_WRONG_SIZE, "nv");
    in.nv = NQ;
    in.without_gradients = true;
    CHECK_REFUSED(out, batch_distance(&in, &out), CSTK_ERROR_WRONG_SIZE, "nv must be 0 without");
    EACH_CALL(i, of_pairs) {
        EACH_BAD_HANDLE(f, NOUN_BODY, bad) {
            in = good_inputs(f);
            in.body_a = bad->handle;
            CHECK_REFUSED(out, of_pairs[i](&in, &out), bad->status, "body_a");
            in = good_inputs(f);
            in.body_b = bad->handle;
            CHECK_REFUSED(out, of_pairs[i](&in, &out), bad->status, "body_b");
        }
        in = good_inputs(f);
        in.poses_a = NULL;
        CHECK_REFUSED(out, of_pairs[i](&in, &out), CSTK_ERROR_NULL_ARGUMENT, "poses_a");
        in = good_inputs(f);
        in.poses_b = NULL;
        CHECK_REFUSED(out, of_pairs[i](&in, &out), CSTK_ERROR_NULL_ARGUMENT, "poses_b");
    }
}

static void bad_numbers(const fixture *f) {
    const batch_call measured[] = {batch_within, batch_distance, batch_pair_within, batch_pair_distance};
    EACH_CALL(i, measured) {
        inputs in = good_inputs(f);
        in.limit = NAN;
        CHECK_REFUSED(out, measured[i](&in, &out), CSTK_ERROR_NOT_FINITE, "is NaN");
        in.limit = -1;
        CHECK_REFUSED(out, measured[i](&in, &out), CSTK_ERROR_INVALID_ARGUMENT, "negative");
    }
    cstk_batch_options good;
    CHECK_OK(cstk_batch_options_default(&good, sizeof good));
    EACH_CALL(i, all_calls) {
        inputs in = good_inputs(f);
        EACH_BAD_OPTIONS(good, bad) {
            in.options = bad->options;
            CHECK_REFUSED(out, all_calls[i](&in, &out), bad->status, "options");
        }
        cstk_batch_options given = good;
        in.options = &given;
        given.threads = 1025;
        CHECK_REFUSED(out, all_calls[i](&in, &out), CSTK_ERROR_INVALID_ARGUMENT, "threads");
    }
    cstk_motion_options motion_options;
    CHECK_OK(cstk_motion_options_default(&motion_options, sizeof motion_options));
    inputs in = good_inputs(f);
    EACH_BAD_OPTIONS(motion_options, bad) {
        in.motion_options = bad->options;
        CHECK_REFUSED(out, batch_motion(&in, &out), bad->status, "motion_options");
    }
    in.motion_options = &motion_options;
    motion_options.tolerance = 0;
    CHECK_REFUSED(out, batch_motion(&in, &out), CSTK_ERROR_INVALID_ARGUMENT, "tolerance");
}

static void bad_handles_of_the_batch(const fixture *f) {
    cstk_query_statistics done;
    cstk_batch *made;
    cstk_batch_options options;
    EACH_BAD_HANDLE(f, NOUN_BATCH, bad) {
        CHECK_FAILS(cstk_batch_retain(bad->handle), bad->status, "batch");
        if (bad->handle != NULL) {
            CHECK_FAILS(cstk_batch_release(bad->handle), bad->status, "batch");
        }
        CHECK_REFUSED(done, cstk_batch_get_statistics(bad->handle, true, &done), bad->status,
                      "batch");
    }
    CHECK_FAILS(cstk_batch_get_statistics(f->batch, true, NULL), CSTK_ERROR_NULL_ARGUMENT, "out");
    CHECK_FAILS(cstk_batch_create(NULL), CSTK_ERROR_NULL_ARGUMENT, "out");
    CHECK_FAILS(cstk_batch_options_default(NULL, sizeof options), CSTK_ERROR_NULL_ARGUMENT, "out");
    CHECK_REFUSED(options, cstk_batch_options_default(&options, 8), CSTK_ERROR_WRONG_SIZE, "size");
    CHECK_OK(cstk_batch_create(&made));
    CHECK_OK(cstk_batch_retain(made));
    CHECK_OK(cstk_batch_release(made));
    CHECK_OK(cstk_batch_release(made));
}

/* No items: nothing is read or written but the result. */
static void no_items(const fixture *f) {
    EACH_CALL(i, all_calls) {
        inputs in = good_inputs(f);
        in.count = 0;
        in.q = in.q1 = in.poses_a = in.poses_b = NULL;
        in.without_answers = in.without_statuses = in.without_gradients = true;
        in.nv = 0;
        memset(&out, CHECK_SENTINEL, sizeof out);
        CHECK_OK(all_calls[i](&in, &out));
        CHECK(out.done.answered == 0 && out.done.failed == 0 && !out.done.has_hit);
        check_untouched(&out, offsetof(outputs, done), "no items", __FILE__, __LINE__);
    }
}

/* What is wrong with one item is the status of that item. */
static void items_that_fail(const fixture *f) {
    const int bad_item = 17;
    cstk_batch_options options;
    CHECK_OK(cstk_batch_options_default(&options, sizeof options));
    for (uint32_t threads = 1; threads < 4; ++threads) {
        options.threads = threads;
        EACH_CALL(i, all_calls) {
            inputs in = good_inputs(f);
            in.options = &options;
            in.q1 = in.q;
            configurations[NQ * bad_item + 1] = NAN;
            poses_b[12 * bad_item + 3] = INFINITY;
            poses_a[12 * 30] = 2;
            memset(&out, CHECK_SENTINEL, sizeof out);
            CHECK_OK(all_calls[i](&in, &out));
            fill_items();
            const bool pairs = i >= 4;
            const size_t failed = pairs ? 2 : 1;
            CHECK(out.done.failed == failed && out.done.answered == COUNT - failed);
            CHECK(out.done.first_failed == (size_t)bad_item && !out.done.has_hit);
            CHECK(strstr(cstk_last_error_message(), "item 17: ") == cstk_last_error_message());
            for (int k = 0; k < COUNT; ++k) {
                const cstk_status expected = k == bad_item         ? CSTK_ERROR_NOT_FINITE
                                             : pairs && k == 30 ? CSTK_ERROR_NOT_A_ROTATION
                                                                   : CSTK_OK;
                CHECK_STATUS(out.statuses[k], expected);
            }
            check_untouched(&out.results[bad_item], sizeof out.results[bad_item], "item", __FILE__,
                            __LINE__);
        }
    }
}

typedef struct listener {
    const inputs *in;
    int calls;
    int stop_at;
} listener;

static int32_t listen(double fraction, void *user) {
    listener *heard = user;
    CHECK(fraction >= 0 && fraction <= 1);
    /* The batch is at work. */
    static outputs inner;
    inputs again = *heard->in;
    again.progress = NULL;
    EACH_CALL(i, all_calls) {
        CHECK_REFUSED(inner, all_calls[i](&again, &inner), CSTK_ERROR_BUSY, "batch");
    }
    return heard->calls++ == heard->stop_at ? 7 : 0;
}

static void progress(const fixture *f) {
    cstk_batch_options options;
    CHECK_OK(cstk_batch_options_default(&options, sizeof options));
    /* On one thread every run is reported. */
    options.threads = 1;
    EACH_CALL(i, all_calls) {
        inputs in = good_inputs(f);
        in.options = &options;
        listener heard = {&in, 0, -1};
        in.progress = listen;
        in.user = &heard;
        CHECK_OK(all_calls[i](&in, &out));
        CHECK(heard.calls >= 3);
        for (int stop = 0; stop < 3; ++stop) {
            heard.calls = 0;
            heard.stop_at = stop;
            CHECK_FAILS(all_calls[i](&in, &out), CSTK_ERROR_CANCELLED, "progress");
            CHECK(heard.calls == stop + 1);
            size_t answered = 0;
            for (int k = 0; k < COUNT; ++k) {
                CHECK(out.statuses[k] == CSTK_OK || out.statuses[k] == CSTK_ERROR_CANCELLED);
                answered += out.statuses[k] == CSTK_OK;
            }
            CHECK(out.done.answered == answered && out.done.failed == 0 && !out.done.has_hit);
            CHECK(out.done.environment_version == (i < 4 ? 1 : 0));
            memset(&out.done, 0xff, sizeof out.done);
            CHECK(stop > 0 || out.statuses[0] == CSTK_ERROR_CANCELLED);
        }
    }
}

/* Outputs that lie on inputs or on each other; what is only read may overlap. */
static void overlaps(const fixture *f) {
    static double path[2 * (COUNT + 1) * NQ];
    cstk_motion_result *motions = out.motions;
    cstk_status *statuses = out.statuses;
    cstk_batch_result *done = &out.done;
    cstk_batch *batch = f->batch;
    memcpy(path, configurations, sizeof configurations);
#define MOTIONS(reached, motions, statuses, done)                                                  \
    cstk_motion_batch(batch, f->cobject, path, path + NQ, COUNT, NQ, NULL, NULL, NULL, NULL,       \
                      (reached), (motions), (statuses), (done))
    const cstk_status refused = CSTK_ERROR_INVALID_ARGUMENT;
    CHECK_FAILS(MOTIONS(path, motions, statuses, done), refused, "reached overlaps q0");
    CHECK_FAILS(MOTIONS(path + COUNT * NQ, motions, statuses, done), refused,
                "reached overlaps q1");
    CHECK_FAILS(MOTIONS((double *)motions, motions, statuses, done), refused,
                "results overlaps reached");
    CHECK_FAILS(MOTIONS(out.reached, motions, (cstk_status *)motions, done), refused,
                "statuses overlaps results");
    CHECK_FAILS(MOTIONS(out.reached, motions, statuses, (cstk_batch_result *)motions), refused,
                "out overlaps results");
    CHECK(memcmp(path, configurations, sizeof configurations) == 0);
    CHECK_FAILS(cstk_classify_batch(batch, f->cobject, path, COUNT, NQ, NULL, NULL, NULL,
                                    (cstk_class *)path, statuses, done),
                refused, "classes overlaps q");
    CHECK_FAILS(cstk_within_batch(batch, f->cobject, path, COUNT, NQ, 0, NULL, NULL, NULL,
                                  (bool *)path, statuses, done),
                refused, "within overlaps q");
    CHECK_FAILS(cstk_distance_batch(batch, f->cobject, path, COUNT, NQ, 1, NULL, NULL, NULL,
                                    out.gradients + 1, NULL, out.gradients, NQ, statuses, done),
                refused, "gradients overlaps distances");
    CHECK_FAILS(cstk_pair_within_batch(batch, f->body, poses_a, f->body, poses_b, COUNT, 0, NULL,
                                       NULL, NULL, (bool *)poses_b, statuses, done),
                refused, "within overlaps poses_b");
    CHECK_FAILS(cstk_pair_distance_batch(batch, f->body, poses_a, f->body, poses_b, COUNT, 1, NULL,
                                         NULL, NULL, poses_a, NULL, statuses, done),
                refused, "distances overlaps poses_a");
#undef MOTIONS
}

static int32_t release_batch(double fraction, void *user) {
    cstk_batch **batch = user;
    (void)fraction;
    if (*batch != NULL) {
        CHECK_OK(cstk_batch_release(*batch));
        *batch = NULL;
    }
    return 0;
}

static void released_meanwhile(const fixture *f) {
    inputs in = good_inputs(f);
    cstk_batch *batch = NULL;
    CHECK_OK(cstk_batch_create(&batch));
    in.batch = batch;
    in.progress = release_batch;
    in.user = &batch;
    CHECK_OK(batch_classify(&in, &out));
    CHECK(batch == NULL && out.done.answered == COUNT);
}

int main(void) {
    fixture f;
    fixture_create(&f);
    fill_items();
    bad_arguments(&f);
    bad_numbers(&f);
    bad_handles_of_the_batch(&f);
    no_items(&f);
    items_that_fail(&f);
    progress(&f);
    overlaps(&f);
    released_meanwhile(&f);
    fixture_unchanged(&f);
    fixture_release(&f);
    return check_result();
}
