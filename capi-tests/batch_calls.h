/* The calls of batches with arguments that can be spoilt one at a time. */
#ifndef CSTK_TESTS_BATCH_CALLS_H
#define CSTK_TESTS_BATCH_CALLS_H

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

typedef cstk_status (*batch_call)(const inputs *in, outputs *out);
/* Each asks what its name says, of the arguments. */
cstk_status batch_classify(const inputs *in, outputs *out);
cstk_status batch_within(const inputs *in, outputs *out);
cstk_status batch_distance(const inputs *in, outputs *out);
cstk_status batch_motion(const inputs *in, outputs *out);
cstk_status batch_pair_within(const inputs *in, outputs *out);
cstk_status batch_pair_distance(const inputs *in, outputs *out);

extern const batch_call of_robots[4];
extern const batch_call of_pairs[2];
/* Those of robots, and then those of pairs. */
extern const batch_call all_calls[6];

#define EACH_CALL(i, calls) for (size_t i = 0; i < sizeof(calls) / sizeof(calls[0]); ++i)

/* The items: configurations of the fixture's robot, each with the next one as its end, and poses of
 * two bodies. */
extern double configurations[(COUNT + 1) * NQ];
extern double poses_a[COUNT * 12];
extern double poses_b[COUNT * 12];

void fill_items(void);
inputs good_inputs(const fixture *f);

#endif
