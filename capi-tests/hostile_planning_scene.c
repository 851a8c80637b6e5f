/* Hostile input to the reader of planning scenes, and the objects it adds. */
#define _POSIX_C_SOURCE 200809L
#include <math.h>
#include <sys/stat.h>
#include <unistd.h>

#include "check.h"
#include "fixture.h"

static const char *const file = "hostile.scene";

static const char *const good =
    "scene\n* far ball\n20 0 0\n0 0 0 1\n1\nsphere\n1\n0 0 0\n0 0 0 1\n0 0 0 0\n0\n"
    "* box\n0 20 0\n0 0 0 1\n1\nbox\n1 1 1\n0 0 0\n0 0 0 1\n0 0 0 0\n0\n.\n";

static void write_file(const char *text) {
    FILE *out = fopen(file, "w");
    CHECK(out != NULL);
    CHECK(fputs(text, out) >= 0);
    CHECK(fclose(out) == 0);
}

static cstk_scene_options good_options(void) {
    cstk_scene_options options;
    CHECK_OK(cstk_scene_options_default(&options, sizeof options));
    return options;
}

static void refuse(const fixture *f, const cstk_scene_options *options, cstk_status status, const char *culprit) {
    uint64_t ids[2];
    CHECK_REFUSED(ids, cstk_environment_load_scene(f->environment, file, options, 2, ids, NULL), status, culprit);
    CHECK_REFUSED(ids, cstk_environment_load_scene_text(f->environment, good, options, 2, ids, NULL), status, culprit);
}

static void arguments(const fixture *f) {
    uint64_t ids[2];
    size_t count = 0;
    cstk_scene_options options = good_options();
    CHECK_FAILS(cstk_scene_options_default(NULL, sizeof options), CSTK_ERROR_NULL_ARGUMENT, "out");
    CHECK_REFUSED(options, cstk_scene_options_default(&options, 0), CSTK_ERROR_WRONG_SIZE, "size");
    options = good_options();
    EACH_BAD_HANDLE(f, NOUN_ENVIRONMENT, bad) {
        CHECK_REFUSED(ids, cstk_environment_load_scene(bad->handle, file, &options, 2, ids, &count), bad->status,
                      "environment");
        CHECK_REFUSED(ids, cstk_environment_load_scene_text(bad->handle, good, &options, 2, ids, &count), bad->status,
                      "environment");
    }
    CHECK_FAILS(cstk_environment_load_scene(f->environment, NULL, NULL, 2, ids, &count), CSTK_ERROR_NULL_ARGUMENT, "file");
    CHECK_FAILS(cstk_environment_load_scene_text(f->environment, NULL, NULL, 2, ids, &count), CSTK_ERROR_NULL_ARGUMENT,
                "scene");
    CHECK_FAILS(cstk_environment_load_scene(f->environment, file, NULL, 2, NULL, &count), CSTK_ERROR_NULL_ARGUMENT, "ids");
    CHECK_FAILS(cstk_environment_load_scene_text(f->environment, good, NULL, 2, NULL, &count), CSTK_ERROR_NULL_ARGUMENT,
                "ids");
    CHECK_FAILS(cstk_environment_load_scene_text(f->environment, "\xff", NULL, 0, NULL, NULL), CSTK_ERROR_INVALID_ARGUMENT,
                "scene");
    CHECK_FAILS(cstk_environment_load_scene(f->environment, "/nowhere/s.scene", NULL, 2, ids, &count), CSTK_ERROR_IO,
                "/nowhere/s.scene");
    EACH_BAD_OPTIONS(options, bad) {
        /* NULL stands for the defaults. */
        if (bad->options != NULL) {
            refuse(f, bad->options, bad->status, "scene_options");
        }
    }
    EACH_BAD_POSE(bad) {
        memcpy(options.at, bad->pose, sizeof options.at);
        refuse(f, &options, bad->status, "scene_options->at");
    }
    options = good_options();
    options.mesh_form = -1;
    refuse(f, &options, CSTK_ERROR_INVALID_ARGUMENT, "mesh_form");
    cstk_hierarchy_options damaged;
    memset(&damaged, 0, sizeof damaged);
    options = good_options();
    options.hierarchy = &damaged;
    refuse(f, &options, CSTK_ERROR_NOT_INITIALISED, "scene_options->hierarchy");
    cstk_environment *snapshot = NULL;
    CHECK_OK(cstk_environment_snapshot(f->environment, &snapshot));
    CHECK_FAILS(cstk_environment_load_scene(snapshot, file, NULL, 0, NULL, NULL), CSTK_ERROR_UNSUPPORTED, "snapshot");
    CHECK_OK(cstk_environment_release(snapshot));
    fixture_unchanged(f);
}

static void files(const fixture *f) {
    const struct {
        const char *text;
        cstk_status status;
        const char *culprit;
    } wrong[] = {
        {"", CSTK_ERROR_PARSE, file},
        {"scene\n* a\n1\nbox\n1 1", CSTK_ERROR_PARSE, "object \"a\""},
        {"scene\n* a\n1\nplane\n0 0 1 0\n", CSTK_ERROR_UNSUPPORTED, "line 4"},
        {"scene\n* a\n1\nmesh\n3 4000000000\n", CSTK_ERROR_UNSUPPORTED, "4000000000"},
        {"scene\n* a\n1\nmesh\n4000000000 1\n", CSTK_ERROR_PARSE, "ends"},
        {"scene\n* a\n1\nsphere\n1\n0 0 0\n0 0 0 0\n", CSTK_ERROR_NOT_A_ROTATION, "line 7"},
        {"scene\n* a\n1\nsphere\n1\n0 0 0\n0 0 0 1\n0 0 0 0\n* a\n", CSTK_ERROR_INVALID_ARGUMENT, "\"a\""},
    };
    uint64_t ids[2];
    for (size_t i = 0; i < sizeof wrong / sizeof wrong[0]; ++i) {
        write_file(wrong[i].text);
        CHECK_REFUSED(ids, cstk_environment_load_scene(f->environment, file, NULL, 2, ids, NULL), wrong[i].status,
                      wrong[i].culprit);
    }
    CHECK(mkfifo("hostile_pipe.scene", 0600) == 0);
    CHECK_FAILS(cstk_environment_load_scene(f->environment, "hostile_pipe.scene", NULL, 0, NULL, NULL), CSTK_ERROR_IO,
                "hostile_pipe.scene");
    CHECK(remove("hostile_pipe.scene") == 0);
    write_file(good);
    fixture_unchanged(f);
}

/* The objects are those of the file, and their names live as long as they. */
static void taken(void) {
    cstk_environment *environment = NULL;
    cstk_object_info info;
    uint64_t ids[3] = {7, 7, 7};
    uint64_t version = 0;
    size_t count = 0;
    CHECK_OK(cstk_environment_create(&environment));
    CHECK_OK(cstk_environment_load_scene(environment, file, NULL, 3, ids, &count));
    CHECK(count == 2 && ids[2] == 7);
    const char *names[] = {"far ball", "box"};
    for (int i = 0; i < 2; ++i) {
        CHECK_OK(cstk_environment_get_object_info(environment, ids[i], &info));
        CHECK(strcmp(info.data, names[i]) == 0 && info.pose[i == 0 ? 3 : 7] == 20.0);
    }
    CHECK_OK(cstk_environment_load_scene_text(environment, good, NULL, 0, NULL, NULL));
    CHECK_OK(cstk_environment_get_state(environment, &count, &version));
    CHECK(count == 4 && version == 2);
    cstk_environment_change gone;
    CHECK_OK(cstk_environment_change_default(&gone, sizeof gone));
    gone.kind = CSTK_CHANGE_DELETE;
    gone.id = ids[0];
    CHECK_OK(cstk_environment_apply(environment, &gone, 1, NULL, NULL));
    CHECK_OK(cstk_environment_release(environment));
}

int main(void) {
    fixture f;
    fixture_create(&f);
    write_file(good);
    arguments(&f);
    files(&f);
    taken();
    CHECK(remove(file) == 0);
    fixture_release(&f);
    return check_result();
}
