/* Hostile input to environments and C-objects, and to cstk_show. */
#include <math.h>
#include <unistd.h>

#include "check.h"
#include "fixture.h"

static void references(const fixture *f) {
    EACH_BAD_HANDLE(f, NOUN_ENVIRONMENT, bad) {
        CHECK_FAILS(cstk_environment_retain(bad->handle), bad->status, "environment");
        if (bad->handle != NULL) {
            CHECK_FAILS(cstk_environment_release(bad->handle), bad->status, "environment");
        }
    }
    EACH_BAD_HANDLE(f, NOUN_COBJECT, bad) {
        CHECK_FAILS(cstk_cobject_retain(bad->handle), bad->status, "cobject");
        if (bad->handle != NULL) {
            CHECK_FAILS(cstk_cobject_release(bad->handle), bad->status, "cobject");
        }
    }
    fixture_unchanged(f);
}

static void environment_create(const fixture *f) {
    CHECK_FAILS(cstk_environment_create(NULL), CSTK_ERROR_NULL_ARGUMENT, "out");
    fixture_unchanged(f);
}

typedef struct applied {
    uint64_t ids[2];
    uint64_t version;
} applied;

/* `change` as the second of two: the first is fine, but is not done either. */
static void refuse_change(const fixture *f, const cstk_environment_change *change,
                          cstk_status status, const char *culprit) {
    applied out;
    cstk_environment_change changes[2];
    CHECK_OK(cstk_environment_change_default(&changes[0], sizeof changes[0]));
    changes[0].kind = CSTK_CHANGE_DELETE;
    changes[0].id = f->box;
    changes[1] = *change;
    CHECK_REFUSED(out, cstk_environment_apply(f->environment, changes, 2, out.ids, &out.version),
                  status, culprit);
}

static void apply_handles(const fixture *f) {
    applied out;
    cstk_environment_change change;
    CHECK_OK(cstk_environment_change_default(&change, sizeof change));
    change.body = f->body;
    EACH_BAD_HANDLE(f, NOUN_ENVIRONMENT, bad) {
        CHECK_REFUSED(out, cstk_environment_apply(bad->handle, &change, 1, out.ids, &out.version),
                      bad->status, "environment");
    }
    CHECK_REFUSED(out, cstk_environment_apply(f->environment, NULL, 1, out.ids, &out.version),
                  CSTK_ERROR_NULL_ARGUMENT, "changes");
    EACH_BAD_OPTIONS(change, bad) {
        CHECK_REFUSED(
            out, cstk_environment_apply(f->environment, bad->options, 1, out.ids, &out.version),
            bad->status, "changes[0]");
    }
    cstk_environment_change zeroed;
    memset(&zeroed, 0, sizeof zeroed);
    refuse_change(f, &zeroed, CSTK_ERROR_NOT_INITIALISED, "changes[1]");
    EACH_BAD_HANDLE(f, NOUN_BODY, bad) {
        change.body = bad->handle;
        refuse_change(f, &change, bad->status, "changes[1].body");
    }
    fixture_unchanged(f);
}

static void apply_values(const fixture *f) {
    const int32_t kinds[] = {-1, 4, INT32_MIN, INT32_MAX};
    cstk_environment_change good;
    cstk_environment_change change;
    CHECK_OK(cstk_environment_change_default(&good, sizeof good));
    good.body = f->body;
    change = good;
    for (int i = 0; i < 4; ++i) {
        change.kind = kinds[i];
        refuse_change(f, &change, CSTK_ERROR_INVALID_ARGUMENT, "changes[1].kind");
    }
    EACH_BAD_POSE(bad) {
        change = good;
        memcpy(change.pose, bad->pose, sizeof change.pose);
        refuse_change(f, &change, bad->status, "changes[1].pose");
        change.kind = CSTK_CHANGE_MOVE;
        change.id = f->box;
        refuse_change(f, &change, bad->status, "changes[1].pose");
    }
    /* The box was deleted by the first change; the others never were. */
    const uint64_t ids[] = {f->box, 0, f->box + 1000, UINT64_MAX};
    for (int i = 0; i < 4; ++i) {
        change = good;
        change.id = ids[i];
        change.kind = CSTK_CHANGE_MOVE;
        refuse_change(f, &change, CSTK_ERROR_NOT_FOUND, "change");
        change.kind = CSTK_CHANGE_DELETE;
        refuse_change(f, &change, CSTK_ERROR_NOT_FOUND, "change");
    }
    fixture_unchanged(f);
}

static void environment_others(const fixture *f) {
    cstk_environment *snapshot;
    applied state;
    double pose[12];
    size_t objects;
    EACH_BAD_HANDLE(f, NOUN_ENVIRONMENT, bad) {
        CHECK_REFUSED(snapshot, cstk_environment_snapshot(bad->handle, &snapshot), bad->status,
                      "environment");
        CHECK_REFUSED(state, cstk_environment_get_state(bad->handle, NULL, &state.version), bad->status,
                      "environment");
        CHECK_REFUSED(objects, cstk_environment_get_state(bad->handle, &objects, NULL), bad->status,
                      "environment");
        CHECK_REFUSED(pose, cstk_environment_get_object_pose(bad->handle, f->box, pose), bad->status,
                      "environment");
    }
    CHECK_OK(cstk_environment_get_state(f->environment, NULL, NULL));
    CHECK_FAILS(cstk_environment_snapshot(f->environment, NULL), CSTK_ERROR_NULL_ARGUMENT, "out");
    CHECK_FAILS(cstk_environment_get_object_pose(f->environment, f->box, NULL), CSTK_ERROR_NULL_ARGUMENT,
                "pose");
    const uint64_t ids[] = {0, f->box + 1000, UINT64_MAX};
    for (int i = 0; i < 3; ++i) {
        CHECK_REFUSED(pose, cstk_environment_get_object_pose(f->environment, ids[i], pose),
                      CSTK_ERROR_NOT_FOUND, "id");
    }
    fixture_unchanged(f);
}

static void cobject_options(const fixture *f) {
    cstk_cobject *out;
    cstk_induced_options good;
    const uint32_t pair[2] = {1, 3};
    CHECK_OK(cstk_induced_options_default(&good, sizeof good));
    EACH_BAD_OPTIONS(good, bad) {
        CHECK_REFUSED(
            out,
            cstk_cobject_induced(f->space, NULL, 0, f->environment, NULL, 0, bad->options, &out),
            bad->status, "options");
        CHECK_REFUSED(out, cstk_cobject_induced_links(f->space, pair, 1, bad->options, &out),
                      bad->status, "options");
    }
    const double values[] = {NAN, INFINITY, -INFINITY, -1e-9};
    for (int i = 0; i < 8; ++i) {
        cstk_induced_options options = good;
        *(i < 4 ? &options.margin : &options.contact_epsilon) = values[i % 4];
        const char *culprit = i < 4 ? "margin" : "contact_epsilon";
        const cstk_status status = i % 4 < 3 ? CSTK_ERROR_NOT_FINITE : CSTK_ERROR_INVALID_ARGUMENT;
        CHECK_REFUSED(
            out, cstk_cobject_induced(f->space, NULL, 0, f->environment, NULL, 0, &options, &out),
            status, culprit);
        CHECK_REFUSED(out, cstk_cobject_induced_links(f->space, pair, 1, &options, &out), status,
                      culprit);
    }
    fixture_unchanged(f);
}

/* The choice of pairs that no coordinate moves is a choice of two, and of s-objects alone. */
static void left_out(const fixture *f) {
    cstk_cobject *out;
    cstk_induced_options options;
    const uint32_t pair[2] = {1, 3};
    CHECK_OK(cstk_induced_options_default(&options, sizeof options));
    options.leave_out_unmoved = 2;
    CHECK_REFUSED(out, cstk_cobject_induced(f->space, NULL, 0, f->environment, NULL, 0, &options, &out),
                  CSTK_ERROR_INVALID_ARGUMENT, "leave_out_unmoved");
    options.leave_out_unmoved = 1;
    CHECK_REFUSED(out, cstk_cobject_induced_links(f->space, pair, 1, &options, &out), CSTK_ERROR_UNSUPPORTED,
                  "leave_out_unmoved");
    CHECK_OK(cstk_cobject_induced(f->space, NULL, 0, f->environment, NULL, 0, &options, &out));
    CHECK_OK(cstk_cobject_release(out));
    fixture_unchanged(f);
}

static void cobject_induced(const fixture *f) {
    cstk_cobject *out;
    const cstk_space *s = f->space;
    const cstk_environment *e = f->environment;
    EACH_BAD_HANDLE(f, NOUN_SPACE, bad) {
        CHECK_REFUSED(out, cstk_cobject_induced(bad->handle, NULL, 0, e, NULL, 0, NULL, &out),
                      bad->status, "space");
    }
    EACH_BAD_HANDLE(f, NOUN_ENVIRONMENT, bad) {
        CHECK_REFUSED(out, cstk_cobject_induced(s, NULL, 0, bad->handle, NULL, 0, NULL, &out),
                      bad->status, "environment");
    }
    CHECK_REFUSED(out, cstk_cobject_induced(s, NULL, 1, e, NULL, 0, NULL, &out), CSTK_ERROR_NULL_ARGUMENT,
                  "links");
    CHECK_REFUSED(out, cstk_cobject_induced(s, NULL, 0, e, NULL, 1, NULL, &out), CSTK_ERROR_NULL_ARGUMENT,
                  "ids");
    CHECK_FAILS(cstk_cobject_induced(s, NULL, 0, e, NULL, 0, NULL, NULL), CSTK_ERROR_NULL_ARGUMENT,
                "out");
    const uint32_t links[] = {1, FIXTURE_BASE, FIXTURE_LINKS, CSTK_NONE};
    const uint64_t ids[] = {f->box, 0, f->box + 1000, UINT64_MAX};
    CHECK_REFUSED(out, cstk_cobject_induced(s, links, SIZE_MAX, e, NULL, 0, NULL, &out),
                  CSTK_ERROR_WRONG_SIZE, "links");
    CHECK_REFUSED(out, cstk_cobject_induced(s, NULL, 0, e, ids, SIZE_MAX, NULL, &out),
                  CSTK_ERROR_WRONG_SIZE, "ids");
    /* The base has no body, but might hold something. */
    CHECK_OK(cstk_cobject_induced(s, links, 2, e, NULL, 0, NULL, &out));
    CHECK_OK(cstk_cobject_release(out));
    for (int i = 2; i < 4; ++i) {
        const uint32_t pair[2] = {1, links[i]};
        const uint64_t two[2] = {f->box, ids[i]};
        CHECK_REFUSED(out, cstk_cobject_induced(s, pair, 2, e, NULL, 0, NULL, &out),
                      CSTK_ERROR_NOT_FOUND, "link");
        CHECK_REFUSED(out, cstk_cobject_induced(s, NULL, 0, e, two, 2, NULL, &out), CSTK_ERROR_NOT_FOUND,
                      "id");
    }
    fixture_unchanged(f);
}

static void cobject_induced_links(const fixture *f) {
    cstk_cobject *out;
    const cstk_space *s = f->space;
    const uint32_t good[2] = {1, 3};
    EACH_BAD_HANDLE(f, NOUN_SPACE, bad) {
        CHECK_REFUSED(out, cstk_cobject_induced_links(bad->handle, good, 1, NULL, &out),
                      bad->status, "space");
    }
    CHECK_REFUSED(out, cstk_cobject_induced_links(s, NULL, 1, NULL, &out), CSTK_ERROR_NULL_ARGUMENT,
                  "pairs");
    CHECK_FAILS(cstk_cobject_induced_links(s, good, 1, NULL, NULL), CSTK_ERROR_NULL_ARGUMENT, "out");
    /* cstk_find_link_pairs may find none to test. */
    cstk_distance_result found;
    CHECK_OK(cstk_cobject_induced_links(s, NULL, 0, NULL, &out));
    CHECK_OK(cstk_distance(f->query, out, f->q, FIXTURE_NQ, INFINITY, &found));
    CHECK(found.kind == CSTK_DISTANCE_EMPTY);
    CHECK_OK(cstk_cobject_release(out));
    const size_t counts[] = {SIZE_MAX, SIZE_MAX / 2 + 2, SIZE_MAX / 8 + 2};
    for (int i = 0; i < 3; ++i) {
        CHECK_REFUSED(out, cstk_cobject_induced_links(s, good, counts[i], NULL, &out),
                      CSTK_ERROR_WRONG_SIZE, "pairs");
    }
    const struct {
        uint32_t pair[2];
        cstk_status status;
    } wrong[] = {
        {{1, 1}, CSTK_ERROR_INVALID_ARGUMENT},
        {{1, FIXTURE_BASE}, CSTK_ERROR_EMPTY},
        {{FIXTURE_LINKS, 1}, CSTK_ERROR_NOT_FOUND},
        {{1, CSTK_NONE}, CSTK_ERROR_NOT_FOUND},
    };
    for (int i = 0; i < 4; ++i) {
        const uint32_t pairs[4] = {1, 3, wrong[i].pair[0], wrong[i].pair[1]};
        CHECK_REFUSED(out, cstk_cobject_induced_links(s, pairs, 2, NULL, &out), wrong[i].status,
                      "pair 1");
    }
    fixture_unchanged(f);
}

static void cobject_union(const fixture *f) {
    cstk_cobject *out;
    cstk_cobject *elsewhere = NULL;
    cstk_space *space = NULL;
    const cstk_robot *robot = f->robot;
    EACH_BAD_HANDLE(f, NOUN_COBJECT, bad) {
        const cstk_cobject *parts[2] = {f->cobject, bad->handle};
        CHECK_REFUSED(out, cstk_cobject_union(parts, 2, &out), bad->status, "parts[1]");
    }
    const cstk_cobject *good = f->cobject;
    CHECK_REFUSED(out, cstk_cobject_union(NULL, 1, &out), CSTK_ERROR_NULL_ARGUMENT, "parts");
    CHECK_FAILS(cstk_cobject_union(&good, 1, NULL), CSTK_ERROR_NULL_ARGUMENT, "out");
    CHECK_REFUSED(out, cstk_cobject_union(&good, 0, &out), CSTK_ERROR_EMPTY, "union");
    CHECK_REFUSED(out, cstk_cobject_union(&good, SIZE_MAX, &out), CSTK_ERROR_WRONG_SIZE, "parts");
    CHECK_OK(cstk_space_create(&robot, 1, NULL, 0, NULL, &space));
    CHECK_OK(cstk_cobject_induced(space, NULL, 0, f->environment, NULL, 0, NULL, &elsewhere));
    const cstk_cobject *parts[2] = {good, elsewhere};
    CHECK_REFUSED(out, cstk_cobject_union(parts, 2, &out), CSTK_ERROR_INVALID_ARGUMENT, "C-object 1");
    CHECK_OK(cstk_cobject_release(elsewhere));
    CHECK_OK(cstk_space_release(space));
    fixture_unchanged(f);
}

static void refuse_show(const cstk_cobject *cobject, const double *q, size_t nq, const char *file,
                        cstk_status status, const char *culprit) {
    CHECK_FAILS(cstk_show(cobject, q, nq, file), status, culprit);
    CHECK(file == NULL || file[0] == '\0' || strcmp(file, ".") == 0 || access(file, F_OK) != 0);
}

static void show(const fixture *f) {
    const char *file = "hostile_show.glb";
    const double longer[FIXTURE_NQ + 1] = {0};
    EACH_BAD_HANDLE(f, NOUN_COBJECT, bad) {
        refuse_show(bad->handle, f->q, FIXTURE_NQ, file, bad->status, "cobject");
    }
    refuse_show(f->cobject, NULL, FIXTURE_NQ, file, CSTK_ERROR_NULL_ARGUMENT, "q");
    refuse_show(f->cobject, f->q, FIXTURE_NQ, NULL, CSTK_ERROR_NULL_ARGUMENT, "file");
    refuse_show(f->cobject, f->q, FIXTURE_NQ - 1, file, CSTK_ERROR_WRONG_SIZE, "configuration");
    refuse_show(f->cobject, f->q, SIZE_MAX, file, CSTK_ERROR_WRONG_SIZE, "q");
    EACH_NOT_FINITE(i) {
        const double q[FIXTURE_NQ] = {0, 0, not_finite[i]};
        refuse_show(f->cobject, q, FIXTURE_NQ, file, CSTK_ERROR_NOT_FINITE, "configuration");
    }
    refuse_show(f->cobject, f->q, FIXTURE_NQ, "no_such_folder/a.glb", CSTK_ERROR_IO, "no_such_folder");
    refuse_show(f->cobject, f->q, FIXTURE_NQ, ".", CSTK_ERROR_UNSUPPORTED, ".");
    refuse_show(f->cobject, f->q, FIXTURE_NQ, "", CSTK_ERROR_UNSUPPORTED, "");
    /* A file that is there stays as it is. */
    char kept[16] = "";
    FILE *other = fopen(file, "wb");
    CHECK(other != NULL && fputs("not a picture", other) >= 0 && fclose(other) == 0);
    CHECK_FAILS(cstk_show(f->cobject, longer, FIXTURE_NQ + 1, file), CSTK_ERROR_WRONG_SIZE,
                "configuration");
    other = fopen(file, "rb");
    CHECK(other != NULL && fgets(kept, sizeof kept, other) != NULL && fclose(other) == 0);
    CHECK(strcmp(kept, "not a picture") == 0);
    CHECK(remove(file) == 0);
    fixture_unchanged(f);
}

static void show_path(const fixture *f) {
    const char *file = "hostile_show_path.glb";
    double points[2 * FIXTURE_NQ];
    memcpy(points, f->q, sizeof f->q);
    memcpy(points + FIXTURE_NQ, f->q, sizeof f->q);
    points[FIXTURE_NQ] += 1;
    EACH_BAD_HANDLE(f, NOUN_COBJECT, bad) {
        CHECK_FAILS(cstk_show_path(bad->handle, points, 2, FIXTURE_NQ, 1, file), bad->status,
                    "cobject");
    }
    const struct {
        const double *points;
        size_t count, nq;
        double seconds;
        const char *file;
        cstk_status status;
        const char *culprit;
    } wrong[] = {
        {NULL, 2, FIXTURE_NQ, 1, file, CSTK_ERROR_NULL_ARGUMENT, "points"},
        {points, 2, FIXTURE_NQ, 1, NULL, CSTK_ERROR_NULL_ARGUMENT, "file"},
        {points, 0, FIXTURE_NQ, 1, file, CSTK_ERROR_WRONG_SIZE, "count"},
        {points, SIZE_MAX, FIXTURE_NQ, 1, file, CSTK_ERROR_WRONG_SIZE, "points"},
        {points, 2, FIXTURE_NQ - 1, 1, file, CSTK_ERROR_WRONG_SIZE, "nq"},
        {points, 2, FIXTURE_NQ, 0, file, CSTK_ERROR_INVALID_ARGUMENT, "seconds"},
        {points, 2, FIXTURE_NQ, -1, file, CSTK_ERROR_INVALID_ARGUMENT, "seconds"},
        {points, 2, FIXTURE_NQ, NAN, file, CSTK_ERROR_NOT_FINITE, "seconds"},
        {points, 2, FIXTURE_NQ, 1, "path.svg", CSTK_ERROR_UNSUPPORTED, "path.svg"},
        {points, 2, FIXTURE_NQ, 1, "no_such_folder/a.glb", CSTK_ERROR_IO, "no_such_folder"},
    };
    for (size_t i = 0; i < sizeof wrong / sizeof wrong[0]; ++i) {
        CHECK_FAILS(cstk_show_path(f->cobject, wrong[i].points, wrong[i].count, wrong[i].nq,
                                   wrong[i].seconds, wrong[i].file),
                    wrong[i].status, wrong[i].culprit);
        CHECK(access(file, F_OK) != 0);
    }
    points[FIXTURE_NQ + 1] = NAN;
    CHECK_FAILS(cstk_show_path(f->cobject, points, 2, FIXTURE_NQ, 1, file), CSTK_ERROR_NOT_FINITE,
                "point 1");
    points[FIXTURE_NQ + 1] = f->q[1];
    CHECK_OK(cstk_show_path(f->cobject, points, 2, FIXTURE_NQ, 1, file));
    CHECK_OK(cstk_show_path(f->cobject, points, 1, FIXTURE_NQ, 1, file));
    CHECK(remove(file) == 0);
    fixture_unchanged(f);
}

int main(void) {
    fixture f;
    fixture_create(&f);
    references(&f);
    environment_create(&f);
    apply_handles(&f);
    apply_values(&f);
    environment_others(&f);
    cobject_options(&f);
    left_out(&f);
    cobject_induced(&f);
    cobject_induced_links(&f);
    cobject_union(&f);
    show(&f);
    show_path(&f);
    fixture_release(&f);
    return check_result();
}
