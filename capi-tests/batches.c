/* Batches answer as single calls do, to the last bit, on any number of threads; and where they stop
 * at a hit. */
#include <math.h>

#include "batch_calls.h"
#include "check.h"
#include "fixture.h"

static outputs out;

static bool same(const void *a, const void *b, size_t size) { return memcmp(a, b, size) == 0; }

static void same_distance(const cstk_distance_result *a, const cstk_distance_result *b) {
    CHECK(a->kind == b->kind && a->has_witness == b->has_witness);
    CHECK(same(&a->distance, &b->distance, sizeof a->distance));
    CHECK(same(&a->lower, &b->lower, sizeof a->lower) &&
          same(&a->upper, &b->upper, sizeof a->upper));
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
        CHECK_OK(batch_pair_within(&in, &out));
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
    CHECK_OK(batch_classify(&in, &out));
    CHECK(!out.done.has_hit && out.done.answered == COUNT);
    options.stop_at_hit = 0;
    options.limit = 1;
    in.limit = INFINITY;
    CHECK_OK(batch_pair_distance(&in, &out));
    CHECK(out.done.failed == COUNT && out.done.answered == 0 && out.done.first_failed == 0);
    CHECK(out.statuses[COUNT - 1] == CSTK_ERROR_LIMIT);
    CHECK(strstr(cstk_last_error_message(), "limit of 1") != NULL);
}
int main(void) {
    fixture f;
    fixture_create(&f);
    fill_items();
    answers(&f);
    first_hits(&f);
    fixture_unchanged(&f);
    fixture_release(&f);
    return check_result();
}
