/* Batches with bad handles, arrays, numbers and options; items that fail alone; batches that are cancelled, or called back into; and
 * answers equal to those of single calls. */
#include <math.h>
#include <stddef.h>

#include "check.h"
#include "fixture.h"

enum { NQ = FIXTURE_NQ, COUNT = 40 };

/* All that batches write. */
typedef struct outputs {
    cstk_class classes[COUNT];
    bool within[COUNT];
    double distances[COUNT];
    double gradients[COUNT * NQ];
    double reached[COUNT * NQ];
    cstk_distance_result results[COUNT];
    cstk_motion_result motions[COUNT];
    cstk_status statuses[COUNT];
    cstk_batch_result done;
} outputs;

/* The arguments of every call, to be spoilt one at a time. */
typedef struct inputs {
    cstk_batch *batch;
    const cstk_cobject *cobject;
    const cstk_body *body_a;
    const cstk_body *body_b;
    const double *q;
    const double *q1;
    const double *poses_a;
    const double *poses_b;
    size_t count;
    size_t nq;
    size_t nv;
    double limit;
    const cstk_batch_options *options;
    const cstk_motion_options *motion_options;
    cstk_progress_fn progress;
    void *user;
    /* Which arrays are passed as NULL. */
    bool without_answers;
    bool without_gradients;
    bool without_statuses;
    bool without_out;
} inputs;

typedef cstk_status (*call)(const inputs *in, outputs *out);

#define GIVEN(flag, array) (in->without_##flag ? NULL : (array))

static cstk_status classify(const inputs *in, outputs *out) {
    return cstk_classify_batch(in->batch, in->cobject, in->q, in->count, in->nq, in->options,
                               in->progress, in->user, GIVEN(answers, out->classes),
                               GIVEN(statuses, out->statuses), GIVEN(out, &out->done));
}

static cstk_status within(const inputs *in, outputs *out) {
    return cstk_within_batch(in->batch, in->cobject, in->q, in->count, in->nq, in->limit,
                             in->options, in->progress, in->user, GIVEN(answers, out->within),
                             GIVEN(statuses, out->statuses), GIVEN(out, &out->done));
}

static cstk_status distance(const inputs *in, outputs *out) {
    return cstk_distance_batch(in->batch, in->cobject, in->q, in->count, in->nq, in->limit,
                               in->options, in->progress, in->user,
                               GIVEN(answers, out->distances), GIVEN(answers, out->results),
                               GIVEN(gradients, out->gradients), in->nv,
                               GIVEN(statuses, out->statuses), GIVEN(out, &out->done));
}

static cstk_status motion(const inputs *in, outputs *out) {
    return cstk_motion_batch(in->batch, in->cobject, in->q, in->q1, in->count, in->nq,
                             in->motion_options, in->options, in->progress, in->user, out->reached,
                             GIVEN(answers, out->motions), GIVEN(statuses, out->statuses),
                             GIVEN(out, &out->done));
}

static cstk_status pair_within(const inputs *in, outputs *out) {
    return cstk_pair_within_batch(in->batch, in->body_a, in->poses_a, in->body_b, in->poses_b,
                                  in->count, in->limit, in->options, in->progress, in->user,
                                  GIVEN(answers, out->within), GIVEN(statuses, out->statuses),
                                  GIVEN(out, &out->done));
}

static cstk_status pair_distance(const inputs *in, outputs *out) {
    return cstk_pair_distance_batch(in->batch, in->body_a, in->poses_a, in->body_b, in->poses_b,
                                    in->count, in->limit, in->options, in->progress, in->user,
                                    GIVEN(answers, out->distances), GIVEN(answers, out->results),
                                    GIVEN(statuses, out->statuses), GIVEN(out, &out->done));
}

static const call of_robots[] = {classify, within, distance, motion};
static const call of_pairs[] = {pair_within, pair_distance};
static const call all_calls[] = {classify, within, distance, motion, pair_within, pair_distance};

#define EACH_CALL(i, calls) for (size_t i = 0; i < sizeof(calls) / sizeof(calls[0]); ++i)

static double configurations[(COUNT + 1) * NQ];
static double poses_a[COUNT * 12];
static double poses_b[COUNT * 12];

static inputs good_inputs(const fixture *f) {
    inputs in;
    memset(&in, 0, sizeof in);
    in.batch = f->batch;
    in.cobject = f->cobject;
    in.body_a = f->body;
    in.body_b = f->body;
    in.q = configurations;
    in.q1 = configurations + NQ;
    in.poses_a = poses_a;
    in.poses_b = poses_b;
    in.count = COUNT;
    in.nq = NQ;
    in.nv = NQ;
    in.limit = 0.5;
    return in;
}

static void fill(void) {
    for (int i = 0; i < (COUNT + 1) * NQ; ++i) {
        configurations[i] = 0.5 * sin(0.7 * i);
    }
    for (int i = 0; i < COUNT; ++i) {
        translation(0.03 * i, 0.01 * i, 0, &poses_a[12 * i]);
        translation(0.5, 0, 0.02 * i, &poses_b[12 * i]);
    }
}

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
    CHECK_REFUSED(out, classify(&in, &out), CSTK_ERROR_NULL_ARGUMENT, "classes");
    CHECK_REFUSED(out, within(&in, &out), CSTK_ERROR_NULL_ARGUMENT, "within");
    CHECK_REFUSED(out, motion(&in, &out), CSTK_ERROR_NULL_ARGUMENT, "results");
    CHECK_REFUSED(out, pair_within(&in, &out), CSTK_ERROR_NULL_ARGUMENT, "within");
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
    CHECK_REFUSED(out, motion(&in, &out), CSTK_ERROR_NULL_ARGUMENT, "q1");
    in = good_inputs(f);
    in.nv = NQ - 1;
    CHECK_REFUSED(out, distance(&in, &out), CSTK_ERROR_WRONG_SIZE, "nv");
    in.nv = NQ;
    in.without_gradients = true;
    CHECK_REFUSED(out, distance(&in, &out), CSTK_ERROR_WRONG_SIZE, "nv must be 0 without");
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
    const call measured[] = {within, distance, pair_within, pair_distance};
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
        CHECK_REFUSED(out, motion(&in, &out), bad->status, "motion_options");
    }
    in.motion_options = &motion_options;
    motion_options.tolerance = 0;
    CHECK_REFUSED(out, motion(&in, &out), CSTK_ERROR_INVALID_ARGUMENT, "tolerance");
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
            fill();
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
    CHECK_OK(classify(&in, &out));
    CHECK(batch == NULL && out.done.answered == COUNT);
}

static bool same(const void *a, const void *b, size_t size) { return memcmp(a, b, size) == 0; }

static void same_distance(const cstk_distance_result *a, const cstk_distance_result *b) {
    CHECK(a->kind == b->kind && a->has_witness == b->has_witness);
    CHECK(same(&a->distance, &b->distance, sizeof a->distance));
    CHECK(same(&a->lower, &b->lower, sizeof a->lower) && same(&a->upper, &b->upper, sizeof a->upper));
    CHECK(same(a->r_point, b->r_point, sizeof a->r_point));
    CHECK(same(a->contact.normal, b->contact.normal, sizeof a->contact.normal));
    CHECK(a->witness.r_link == b->witness.r_link && a->witness.s_object == b->witness.s_object);
    CHECK(a->environment_version == b->environment_version);
}

/* The batch's answers for one item against those of single calls. */
static void same_as_single(const fixture *f, const outputs *of_all[], int k) {
    const double *q = &configurations[NQ * k];
    cstk_class class_of;
    bool is_within;
    cstk_distance_result nearest;
    cstk_motion_result moved;
    double reached[NQ];
    CHECK_OK(cstk_classify(f->query, f->cobject, q, NQ, &class_of));
    CHECK(class_of == of_all[0]->classes[k]);
    CHECK_OK(cstk_within(f->query, f->cobject, q, NQ, 0.5, &is_within));
    CHECK(is_within == of_all[1]->within[k]);
    CHECK_OK(cstk_distance(f->query, f->cobject, q, NQ, 0.5, &nearest));
    same_distance(&nearest, &of_all[2]->results[k]);
    CHECK(same(&nearest.distance, &of_all[2]->distances[k], sizeof(double)));
    if (nearest.has_contact) {
        cstk_witness_list list;
        CHECK_OK(cstk_gradients(f->query, f->cobject, q, NQ, nearest.upper, 1, &list));
        CHECK(same(list.gradients, &of_all[2]->gradients[NQ * k], NQ * sizeof(double)));
    } else {
        const double zeros[NQ] = {0};
        CHECK(same(zeros, &of_all[2]->gradients[NQ * k], sizeof zeros));
    }
    CHECK_OK(cstk_motion(f->query, f->cobject, q, q + NQ, NQ, NULL, reached, &moved));
    CHECK(moved.outcome == of_all[3]->motions[k].outcome);
    CHECK(same(moved.times, of_all[3]->motions[k].times, sizeof moved.times));
    CHECK(same(reached, &of_all[3]->reached[NQ * k], sizeof reached));
    const double *a = &poses_a[12 * k];
    const double *b = &poses_b[12 * k];
    CHECK_OK(cstk_pair_within(f->query, f->body, a, f->body, b, 0.5, &is_within));
    CHECK(is_within == of_all[4]->within[k]);
    CHECK_OK(cstk_pair_distance(f->query, f->body, a, f->body, b, 0.5, &nearest));
    same_distance(&nearest, &of_all[5]->results[k]);
}

static void answers(const fixture *f) {
    static outputs each[6];
    const outputs *of_all[6];
    cstk_batch_options options;
    CHECK_OK(cstk_batch_options_default(&options, sizeof options));
    CHECK(options.threads == 0 && options.stop_at_hit == 0 && options.limit == 0);
    CHECK_OK(cstk_query_set_contacts(f->query, CSTK_CONTACTS_NEAREST));
    for (uint32_t threads = 0; threads < 9; threads += 4) {
        options.threads = threads;
        inputs in = good_inputs(f);
        in.options = &options;
        EACH_CALL(i, all_calls) {
            of_all[i] = &each[i];
            CHECK_OK(all_calls[i](&in, &each[i]));
            CHECK(each[i].done.answered == COUNT && each[i].done.failed == 0);
            CHECK(each[i].done.environment_version == (i < 4 ? 1 : 0));
        }
        for (int k = 0; k < COUNT; ++k) {
            same_as_single(f, of_all, k);
        }
    }
    CHECK_OK(cstk_query_set_contacts(f->query, CSTK_CONTACTS_ALL));
    cstk_query_statistics done;
    CHECK_OK(cstk_batch_get_statistics(f->batch, true, &done));
    CHECK(done.primitive_pairs > 0);
    CHECK_OK(cstk_batch_get_statistics(f->batch, false, &done));
    CHECK(done.primitive_pairs == 0 && done.node_pairs == 0);
}

static void first_hits(const fixture *f) {
    cstk_batch_options options;
    CHECK_OK(cstk_batch_options_default(&options, sizeof options));
    options.stop_at_hit = 1;
    inputs in = good_inputs(f);
    in.options = &options;
    bool meets[COUNT];
    size_t first = COUNT;
    for (int k = COUNT - 1; k >= 0; --k) {
        CHECK_OK(cstk_pair_within(f->query, f->body, &poses_a[12 * k], f->body, &poses_b[12 * k], 0,
                                  &meets[k]));
        first = meets[k] ? (size_t)k : first;
    }
    for (uint32_t threads = 1; threads < 5; ++threads) {
        options.threads = threads;
        in.limit = 0;
        CHECK_OK(pair_within(&in, &out));
        CHECK(out.done.has_hit == (first < COUNT));
        if (first < COUNT) {
            CHECK(out.done.first_hit == first && out.done.answered == first + 1);
            CHECK(out.within[first] && out.statuses[first] == CSTK_OK);
            for (size_t k = first + 1; k < COUNT; ++k) {
                CHECK(out.statuses[k] == CSTK_ERROR_CANCELLED);
            }
        }
    }
    /* The arm is free at all configurations. */
    CHECK_OK(classify(&in, &out));
    CHECK(!out.done.has_hit && out.done.answered == COUNT);
    options.stop_at_hit = 0;
    options.limit = 1;
    in.limit = INFINITY;
    CHECK_OK(pair_distance(&in, &out));
    CHECK(out.done.failed == COUNT && out.done.answered == 0 && out.done.first_failed == 0);
    CHECK(out.statuses[COUNT - 1] == CSTK_ERROR_LIMIT);
    CHECK(strstr(cstk_last_error_message(), "limit of 1") != NULL);
}

int main(void) {
    fixture f;
    fixture_create(&f);
    fill();
    bad_arguments(&f);
    bad_numbers(&f);
    bad_handles_of_the_batch(&f);
    no_items(&f);
    items_that_fail(&f);
    progress(&f);
    overlaps(&f);
    released_meanwhile(&f);
    answers(&f);
    first_hits(&f);
    fixture_unchanged(&f);
    fixture_release(&f);
    return check_result();
}
