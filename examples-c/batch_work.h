/* A batch as tiles: each is a batch of its own, of items that follow one another. */
#ifndef BATCH_WORK_H
#define BATCH_WORK_H

#include "configurations.h"
#include "tile_work.h"

typedef enum batch_kind {
    BATCH_CLASSES,   /* a byte an item: its cstk_class, or NO_ANSWER */
    BATCH_DISTANCES, /* a double an item, or NaN */
    BATCH_MOTIONS, /* of the motion from each to the next, the cstk_motion_outcome, or NO_ANSWER */
    BATCH_CONFIGURATIONS, /* the configurations themselves, a row of doubles each */
} batch_kind;

/* Stands for an item that failed: one with a NaN, say. */
enum { NO_ANSWER = 255 };

typedef struct batch_work {
    batch_kind kind;
    const cstk_cobject *cobject;
    const configurations *q;
    cstk_batch *batch;
    cstk_batch_options options;
} batch_work;

/* The batch as values that are not yet cut into tiles; it refers to `batch`. */
tile_work batch_in_tiles(batch_work *batch, const char *scene);

/* Writes the answers of one batch of all items, by all threads of this process. */
void answer_whole_batch(batch_work *batch, const tile_work *work, const char *file);

#endif
