#include "batch_calls.h"

#include <math.h>
#include <string.h>

#define GIVEN(flag, array) (in->without_##flag ? NULL : (array))

cstk_status batch_classify(const inputs *in, outputs *out) {
    return cstk_classify_batch(in->batch, in->cobject, in->q, in->count, in->nq, in->options,
                               in->progress, in->user, GIVEN(answers, out->classes),
                               GIVEN(statuses, out->statuses), GIVEN(out, &out->done));
}

cstk_status batch_within(const inputs *in, outputs *out) {
    return cstk_within_batch(in->batch, in->cobject, in->q, in->count, in->nq, in->limit,
                             in->options, in->progress, in->user, GIVEN(answers, out->within),
                             GIVEN(statuses, out->statuses), GIVEN(out, &out->done));
}

cstk_status batch_distance(const inputs *in, outputs *out) {
    return cstk_distance_batch(in->batch, in->cobject, in->q, in->count, in->nq, in->limit,
                               in->options, in->progress, in->user, GIVEN(answers, out->distances),
                               GIVEN(answers, out->results), GIVEN(gradients, out->gradients),
                               in->nv, GIVEN(statuses, out->statuses), GIVEN(out, &out->done));
}

cstk_status batch_motion(const inputs *in, outputs *out) {
    return cstk_motion_batch(in->batch, in->cobject, in->q, in->q1, in->count, in->nq,
                             in->motion_options, in->options, in->progress, in->user, out->reached,
                             GIVEN(answers, out->motions), GIVEN(statuses, out->statuses),
                             GIVEN(out, &out->done));
}

cstk_status batch_pair_within(const inputs *in, outputs *out) {
    return cstk_pair_within_batch(in->batch, in->body_a, in->poses_a, in->body_b, in->poses_b,
                                  in->count, in->limit, in->options, in->progress, in->user,
                                  GIVEN(answers, out->within), GIVEN(statuses, out->statuses),
                                  GIVEN(out, &out->done));
}

cstk_status batch_pair_distance(const inputs *in, outputs *out) {
    return cstk_pair_distance_batch(in->batch, in->body_a, in->poses_a, in->body_b, in->poses_b,
                                    in->count, in->limit, in->options, in->progress, in->user,
                                    GIVEN(answers, out->distances), GIVEN(answers, out->results),
                                    GIVEN(statuses, out->statuses), GIVEN(out, &out->done));
}

const batch_call of_robots[4] = {batch_classify, batch_within, batch_distance, batch_motion};
const batch_call of_pairs[2] = {batch_pair_within, batch_pair_distance};
const batch_call all_calls[6] = {batch_classify, batch_within,      batch_distance,
                                 batch_motion,   batch_pair_within, batch_pair_distance};

double configurations[(COUNT + 1) * NQ];
double poses_a[COUNT * 12];
double poses_b[COUNT * 12];

inputs good_inputs(const fixture *f) {
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

void fill_items(void) {
    for (int i = 0; i < (COUNT + 1) * NQ; ++i) {
        configurations[i] = 0.5 * sin(0.7 * i);
    }
    for (int i = 0; i < COUNT; ++i) {
        translation(0.03 * i, 0.01 * i, 0, &poses_a[12 * i]);
        translation(0.5, 0, 0.02 * i, &poses_b[12 * i]);
    }
}
