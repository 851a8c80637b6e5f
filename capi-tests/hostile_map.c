/* cstk_map_build and what reads maps, with bad handles, axes, numbers and options; and a map beside single queries. */
#include <math.h>

#include "check.h"
#include "fixture.h"

enum { NQ = FIXTURE_NQ, ROWS = 7, COLUMNS = 5 };

static const cstk_map_axis good_axes[2] = {{0, 0, -3, 3, ROWS, 0, 0}, {2, 0, -1, 2, COLUMNS, 0, 0}};

static void bad_arguments(const fixture *f) {
    cstk_map *map;
    EACH_BAD_HANDLE(f, NOUN_COBJECT, bad) {
        CHECK_REFUSED(map,
                      cstk_map_build(bad->handle, f->q, NQ, good_axes, 2, NULL, NULL, NULL, &map),
                      bad->status, "cobject");
    }
    CHECK_REFUSED(map, cstk_map_build(f->cobject, NULL, NQ, good_axes, 2, NULL, NULL, NULL, &map),
                  CSTK_ERROR_NULL_ARGUMENT, "q");
    CHECK_REFUSED(map, cstk_map_build(f->cobject, f->q, NQ, NULL, 2, NULL, NULL, NULL, &map),
                  CSTK_ERROR_NULL_ARGUMENT, "axes");
    CHECK_FAILS(cstk_map_build(f->cobject, f->q, NQ, good_axes, 2, NULL, NULL, NULL, NULL),
                CSTK_ERROR_NULL_ARGUMENT, "out");
    const size_t widths[] = {0, 1, NQ - 1, SIZE_MAX};
    for (int i = 0; i < 4; ++i) {
        CHECK_REFUSED(map,
                      cstk_map_build(f->cobject, f->q, widths[i], good_axes, 2, NULL, NULL, NULL, &map),
                      CSTK_ERROR_WRONG_SIZE, "");
    }
    const size_t counts[] = {0, 7, SIZE_MAX};
    const cstk_map_axis many[7] = {{0, 0, 0, 1, 1, 0, 0}};
    for (int i = 0; i < 3; ++i) {
        CHECK_REFUSED(map,
                      cstk_map_build(f->cobject, f->q, NQ, many, counts[i], NULL, NULL, NULL, &map),
                      CSTK_ERROR_WRONG_SIZE, "ax");
    }
    const double nan_q[NQ] = {0, NAN, 0};
    CHECK_REFUSED(map, cstk_map_build(f->cobject, nan_q, NQ, good_axes, 2, NULL, NULL, NULL, &map),
                  CSTK_ERROR_NOT_FINITE, "");
}

static void bad_axes(const fixture *f) {
    cstk_map *map;
    const struct {
        cstk_map_axis axis;
        cstk_status status;
    } wrong[] = {
        {{0, 0, 0, 1, 3, 0, 0}, CSTK_ERROR_INVALID_ARGUMENT},
        {{NQ, 0, 0, 1, 3, 0, 0}, CSTK_ERROR_NOT_FOUND},
        {{UINT32_MAX, 0, 0, 1, 3, 0, 0}, CSTK_ERROR_NOT_FOUND},
        {{2, 0, 1, 1, 3, 0, 0}, CSTK_ERROR_INVALID_ARGUMENT},
        {{2, 0, 1, 0, 3, 0, 0}, CSTK_ERROR_INVALID_ARGUMENT},
        {{2, 0, NAN, 1, 3, 0, 0}, CSTK_ERROR_NOT_FINITE},
        {{2, 0, 0, INFINITY, 3, 0, 0}, CSTK_ERROR_NOT_FINITE},
        {{2, 0, 0, 1e300, 3, 0, 0}, CSTK_ERROR_INVALID_ARGUMENT},
        {{2, 0, 0, 1, 0, 0, 0}, CSTK_ERROR_INVALID_ARGUMENT},
        {{2, 0, 0, 1, 3, 3, 0}, CSTK_ERROR_INVALID_ARGUMENT},
        {{2, 0, 0, 1, 3, 1, 3}, CSTK_ERROR_INVALID_ARGUMENT},
        {{2, 0, 0, 1, 3, 1, SIZE_MAX}, CSTK_ERROR_INVALID_ARGUMENT},
        {{2, 0, 0, 1, 3, SIZE_MAX, SIZE_MAX}, CSTK_ERROR_INVALID_ARGUMENT},
    };
    for (size_t i = 0; i < sizeof wrong / sizeof wrong[0]; ++i) {
        const cstk_map_axis axes[2] = {good_axes[0], wrong[i].axis};
        CHECK_REFUSED(map, cstk_map_build(f->cobject, f->q, NQ, axes, 2, NULL, NULL, NULL, &map),
                      wrong[i].status, "axis 1");
    }
    cstk_map_axis axes[2] = {good_axes[0], good_axes[1]};
    axes[1].cells = SIZE_MAX;
    CHECK_REFUSED(map, cstk_map_build(f->cobject, f->q, NQ, axes, 2, NULL, NULL, NULL, &map),
                  CSTK_ERROR_WRONG_SIZE, "cells");
    axes[1].cells = SIZE_MAX / 64;
    CHECK_REFUSED(map, cstk_map_build(f->cobject, f->q, NQ, axes, 2, NULL, NULL, NULL, &map),
                  CSTK_ERROR_OUT_OF_MEMORY, "a map of");
}

static void refused_options(const fixture *f) {
    cstk_map *map;
    cstk_map_options good;
    CHECK_FAILS(cstk_map_options_default(NULL, sizeof good), CSTK_ERROR_NULL_ARGUMENT, "out");
    CHECK_REFUSED(good, cstk_map_options_default(&good, 8), CSTK_ERROR_WRONG_SIZE, "size");
    CHECK_OK(cstk_map_options_default(&good, sizeof good));
    EACH_BAD_OPTIONS(good, bad) {
        CHECK_REFUSED(
            map, cstk_map_build(f->cobject, f->q, NQ, good_axes, 2, bad->options, NULL, NULL, &map),
            bad->status, "options");
    }
    const struct {
        int32_t kind;
        uint32_t threads;
        double max_distance;
        uint64_t max_boxes;
        cstk_status status;
        const char *culprit;
    } wrong[] = {
        {3, 1, 1, 1, CSTK_ERROR_INVALID_ARGUMENT, "kind"},
        {-1, 1, 1, 1, CSTK_ERROR_INVALID_ARGUMENT, "kind"},
        {0, 1025, 1, 1, CSTK_ERROR_INVALID_ARGUMENT, "threads"},
        {1, 1, -1, 1, CSTK_ERROR_INVALID_ARGUMENT, "max_distance"},
        {1, 1, NAN, 1, CSTK_ERROR_NOT_FINITE, "max_distance"},
        {2, 1, 1, 0, CSTK_ERROR_INVALID_ARGUMENT, "max_boxes"},
    };
    for (size_t i = 0; i < sizeof wrong / sizeof wrong[0]; ++i) {
        cstk_map_options given = good;
        given.kind = wrong[i].kind;
        given.threads = wrong[i].threads;
        given.max_distance = wrong[i].max_distance;
        given.max_boxes = wrong[i].max_boxes;
        CHECK_REFUSED(map,
                      cstk_map_build(f->cobject, f->q, NQ, good_axes, 2, &given, NULL, NULL, &map),
                      wrong[i].status, wrong[i].culprit);
    }
}

static void bad_maps(const fixture *f) {
    cstk_map_view view;
    EACH_BAD_HANDLE(f, NOUN_MAP, bad) {
        CHECK_REFUSED(view, cstk_map_get_view(bad->handle, &view), bad->status, "map");
        CHECK_FAILS(cstk_map_save(bad->handle, "hostile_map.npy"), bad->status, "map");
        CHECK_FAILS(cstk_map_show(bad->handle, "hostile_map.png"), bad->status, "map");
        CHECK_FAILS(cstk_map_retain(bad->handle), bad->status, "map");
        if (bad->handle != NULL) {
            CHECK_FAILS(cstk_map_release(bad->handle), bad->status, "map");
        }
    }
    CHECK_FAILS(cstk_map_get_view(f->map, NULL), CSTK_ERROR_NULL_ARGUMENT, "out");
    CHECK_FAILS(cstk_map_show(f->map, NULL), CSTK_ERROR_NULL_ARGUMENT, "file");
    CHECK_FAILS(cstk_map_show(f->map, "hostile_map.png"), CSTK_ERROR_UNSUPPORTED, "axes");
    CHECK_FAILS(cstk_map_save(f->map, NULL), CSTK_ERROR_NULL_ARGUMENT, "file");
    CHECK_FAILS(cstk_map_save(f->map, ""), CSTK_ERROR_INVALID_ARGUMENT, "file");
    CHECK_FAILS(cstk_map_show(f->map, ""), CSTK_ERROR_INVALID_ARGUMENT, "file");
    CHECK_FAILS(cstk_map_save(f->map, "/nowhere/at/all.npy"), CSTK_ERROR_IO, "");
    CHECK_OK(cstk_map_retain(f->map));
    CHECK_OK(cstk_map_release(f->map));
}

/* The boundary of a map with three axes. */
static void boundaries(const fixture *f) {
    cstk_map *map;
    const cstk_map_axis axes[3] = {good_axes[0], good_axes[1], {1, 0, -1, 1, 4, 0, 0}};
    CHECK_OK(cstk_map_build(f->cobject, f->q, NQ, axes, 3, NULL, NULL, NULL, &map));
    CHECK_FAILS(cstk_map_show(map, "hostile_map.png"), CSTK_ERROR_UNSUPPORTED, ".glb");
    CHECK_FAILS(cstk_map_show(map, "/nowhere/at/all.glb"), CSTK_ERROR_IO, "");
    CHECK_OK(cstk_map_show(map, "hostile_map.glb"));
    CHECK(remove("hostile_map.glb") == 0);
    CHECK_OK(cstk_map_release(map));
}

static int32_t stop_at(double fraction, void *user) {
    CHECK(fraction >= 0 && fraction <= 1);
    return fraction > *(const double *)user ? 1 : 0;
}

static void cancelled(const fixture *f) {
    cstk_map *map;
    double ends[] = {-1, 0.4, 0.99};
    for (int i = 0; i < 3; ++i) {
        CHECK_REFUSED(
            map, cstk_map_build(f->cobject, f->q, NQ, good_axes, 2, NULL, stop_at, &ends[i], &map),
            CSTK_ERROR_CANCELLED, "progress");
    }
}

static void answers(const fixture *f) {
    cstk_map_options options;
    cstk_map_view view;
    CHECK_OK(cstk_map_options_default(&options, sizeof options));
    for (int32_t kind = 0; kind < 3; ++kind) {
        cstk_map *map;
        options.kind = kind;
        CHECK_OK(cstk_map_build(f->cobject, f->q, NQ, good_axes, 2, &options, NULL, NULL, &map));
        CHECK_OK(cstk_map_get_view(map, &view));
        CHECK(view.kind == (cstk_map_kind)kind && view.cell_count == ROWS * COLUMNS);
        CHECK(view.axis_count == 2 && view.axes[1].cells == COLUMNS && view.axes[1].low == -1);
        CHECK((view.values == NULL) == (kind == CSTK_MAP_DISTANCES));
        CHECK((view.distances == NULL) == (kind != CSTK_MAP_DISTANCES));
        CHECK(view.proofs + view.questions > 0);
        for (int i = 0; i < ROWS * COLUMNS; ++i) {
            double q[NQ] = {f->q[0], f->q[1], f->q[2]};
            const cstk_map_axis *a = &view.axes[0], *b = &view.axes[1];
            q[0] = a->low + (a->high - a->low) * ((i / COLUMNS + 0.5) / ROWS);
            q[2] = b->low + (b->high - b->low) * ((i % COLUMNS + 0.5) / COLUMNS);
            cstk_class class_of;
            cstk_distance_result nearest;
            CHECK_OK(cstk_classify(f->query, f->cobject, q, NQ, &class_of));
            CHECK_OK(cstk_distance(f->query, f->cobject, q, NQ, INFINITY, &nearest));
            CHECK(kind != CSTK_MAP_CLASSES || view.values[i] == class_of);
            CHECK(kind != CSTK_MAP_DISTANCES || view.distances[i] == nearest.distance);
            CHECK(kind != CSTK_MAP_CELLS || view.values[i] != CSTK_REGION_FREE ||
                  class_of != CSTK_CLASS_INSIDE);
        }
        CHECK_OK(cstk_map_save(map, "hostile_map.npy"));
        CHECK_OK(cstk_map_show(map, "hostile_map.png"));
        CHECK_FAILS(cstk_map_show(map, "/nowhere/at/all.png"), CSTK_ERROR_IO, "");
        CHECK_OK(cstk_map_release(map));
    }
    CHECK(remove("hostile_map.npy") == 0 && remove("hostile_map.png") == 0);
}

/* A part of the cells is a map of its own, with the values of the whole. */
static void parts(const fixture *f) {
    cstk_map *whole, *part;
    cstk_map_view all, some;
    cstk_map_axis axes[2] = {good_axes[0], good_axes[1]};
    axes[0].first = 2;
    axes[0].count = 4;
    axes[1].first = 1;
    CHECK_OK(cstk_map_build(f->cobject, f->q, NQ, good_axes, 2, NULL, NULL, NULL, &whole));
    CHECK_OK(cstk_map_build(f->cobject, f->q, NQ, axes, 2, NULL, NULL, NULL, &part));
    CHECK_OK(cstk_map_get_view(whole, &all));
    CHECK_OK(cstk_map_get_view(part, &some));
    CHECK(all.axes[0].count == ROWS && all.axes[1].count == COLUMNS);
    CHECK(some.axes[0].first == 2 && some.axes[0].count == 4 && some.axes[1].count == COLUMNS - 1);
    CHECK(some.cell_count == 4 * (COLUMNS - 1));
    for (int row = 0; row < 4; ++row) {
        for (int column = 0; column < COLUMNS - 1; ++column) {
            CHECK(some.values[row * (COLUMNS - 1) + column] == all.values[(row + 2) * COLUMNS + column + 1]);
        }
    }
    CHECK_OK(cstk_map_release(whole));
    CHECK_OK(cstk_map_release(part));
}

int main(void) {
    fixture f;
    fixture_create(&f);
    bad_arguments(&f);
    bad_axes(&f);
    refused_options(&f);
    bad_maps(&f);
    cancelled(&f);
    answers(&f);
    parts(&f);
    boundaries(&f);
    fixture_unchanged(&f);
    fixture_release(&f);
    return check_result();
}
