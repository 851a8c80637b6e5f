#include "batch_work.h"
#include "tile_file.h"

#include <errno.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

static void count_answers(const cstk_batch_result *done, tile_cost *cost) {
    cost->counts[0] = done->answered;
    cost->counts[1] = done->failed;
}

static void classify(const batch_work *work, const double *q, size_t count, uint8_t *bytes,
                     cstk_status *statuses, cstk_batch_result *done) {
    cstk_class *classes = zeros(count, sizeof *classes);
    require(cstk_classify_batch(work->batch, work->cobject, q, count, work->q->width,
                                &work->options, NULL, NULL, classes, statuses, done));
    for (size_t i = 0; i < count; ++i) {
        bytes[i] = statuses[i] == CSTK_OK ? (uint8_t)classes[i] : NO_ANSWER;
    }
    free(classes);
}

static void measure(const batch_work *work, const double *q, size_t count, double *distances,
                    cstk_status *statuses, cstk_batch_result *done) {
    require(cstk_distance_batch(work->batch, work->cobject, q, count, work->q->width, INFINITY,
                                &work->options, NULL, NULL, distances, NULL, NULL, 0, statuses,
                                done));
    for (size_t i = 0; i < count; ++i) {
        distances[i] = statuses[i] == CSTK_OK ? distances[i] : (double)NAN;
    }
}

static void move(const batch_work *work, const double *q, size_t count, uint8_t *bytes,
                 cstk_status *statuses, cstk_batch_result *done) {
    cstk_motion_result *motions = zeros(count, sizeof *motions);
    size_t nq = work->q->width;
    require(cstk_motion_batch(work->batch, work->cobject, q, q + nq, count, nq, NULL,
                              &work->options, NULL, NULL, NULL, motions, statuses, done));
    for (size_t i = 0; i < count; ++i) {
        bytes[i] = statuses[i] == CSTK_OK ? (uint8_t)motions[i].outcome : NO_ANSWER;
    }
    free(motions);
}

/* The numbers of the tile's columns. */
static void copy(const double *q, size_t width, const tile *t, double *out) {
    for (size_t i = 0; i < t->count[0]; ++i) {
        memcpy(out + i * t->count[1], q + i * width + t->first[1], t->count[1] * sizeof *out);
    }
}

/* The bytes come from malloc: they may be doubles. */
static void compute(void *values, const tile *t, void *bytes, tile_cost *cost) {
    const batch_work *work = values;
    size_t count = t->count[0], ends = work->kind == BATCH_MOTIONS ? 1 : 0;
    double *q = zeros((count + ends) * work->q->width, sizeof *q);
    cstk_status *statuses = zeros(count, sizeof *statuses);
    cstk_batch_result done;
    memset(&done, 0, sizeof done);
    get_configurations(work->q, t->first[0], count + ends, q);
    switch (work->kind) {
    case BATCH_CLASSES:
        classify(work, q, count, bytes, statuses, &done);
        break;
    case BATCH_DISTANCES:
        measure(work, q, count, bytes, statuses, &done);
        break;
    case BATCH_MOTIONS:
        move(work, q, count, bytes, statuses, &done);
        break;
    case BATCH_CONFIGURATIONS:
        copy(q, work->q->width, t, bytes);
        break;
    }
    count_answers(&done, cost);
    free(statuses);
    free(q);
}

tile_work batch_in_tiles(batch_work *batch, const char *scene) {
    bool is_bytes = batch->kind == BATCH_CLASSES || batch->kind == BATCH_MOTIONS;
    bool is_rows = batch->kind == BATCH_CONFIGURATIONS;
    tile_work work = {.axis_count = is_rows ? 2 : 1,
                      .value_size = is_bytes ? 1 : sizeof(double),
                      .count_names = {"answers", "failures"},
                      .compute = compute,
                      .values = batch};
    work.sides[0] = batch->kind == BATCH_MOTIONS ? batch->q->count - 1 : batch->q->count;
    work.sides[1] = is_rows ? batch->q->width : 0;
    describe(&work, "batch of %s kind %d configurations %s", scene, (int)batch->kind,
             batch->q->source);
    return work;
}

void answer_whole_batch(batch_work *batch, const tile_work *work, const char *file) {
    char header[MAX_HEADER];
    tile all = {{0}, {work->sides[0], work->sides[1]}};
    tile_cost cost = {0, 0, {0, 0}};
    size_t length = header_of(work, header), size = tile_size(work, &all);
    void *bytes = zeros(size, 1);
    batch->options.threads = 0;
    compute(batch, &all, bytes, &cost);
    FILE *out = fopen(file, "wb");
    if (out == NULL || fwrite(header, length, 1, out) != 1 || fwrite(bytes, size, 1, out) != 1 ||
        fclose(out) != 0) {
        fail("%s: %s", file, strerror(errno));
    }
    free(bytes);
}
