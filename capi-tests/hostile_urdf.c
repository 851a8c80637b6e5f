/* Hostile input to the reader of URDF files: arguments, options, and files that are none. */
#define _POSIX_C_SOURCE 200809L
#include <math.h>
#include <stddef.h>
#include <sys/stat.h>
#include <unistd.h>

#include "check.h"
#include "fixture.h"

static const char *const file = "hostile.urdf";

static void write_file(const char *text) {
    FILE *out = fopen(file, "w");
    CHECK(out != NULL);
    CHECK(fputs(text, out) >= 0);
    CHECK(fclose(out) == 0);
}

static const char *const good =
    "<robot name='r'><link name='a'><collision><geometry><box size='1 1 1'/></geometry></collision>"
    "</link></robot>";

static cstk_urdf_options good_options(void) {
    cstk_urdf_options options;
    CHECK_OK(cstk_urdf_options_default(&options, sizeof options));
    return options;
}

static void refuse(const fixture *f, const cstk_urdf_options *options, cstk_status status,
                   const char *culprit) {
    uint32_t root;
    CHECK_REFUSED(root,
                  cstk_robot_builder_load_urdf(f->robot_builder, file, options, NULL, NULL, &root),
                  status, culprit);
}

static void defaults(void) {
    cstk_urdf_options options;
    CHECK_FAILS(cstk_urdf_options_default(NULL, sizeof options), CSTK_ERROR_NULL_ARGUMENT, "out");
    CHECK_REFUSED(options, cstk_urdf_options_default(&options, 0), CSTK_ERROR_WRONG_SIZE, "size");
    CHECK_REFUSED(options, cstk_urdf_options_default(&options, sizeof options - 1), CSTK_ERROR_WRONG_SIZE,
                  "size");
    /* The sizes that the structure had without the last fields, and without cache_folder. */
    CHECK_OK(cstk_urdf_options_default(&options, offsetof(cstk_urdf_options, link_forms)));
    CHECK_OK(cstk_urdf_options_default(&options, offsetof(cstk_urdf_options, cache_folder)));
}

static void arguments(const fixture *f) {
    uint32_t root;
    const cstk_urdf_options options = good_options();
    EACH_BAD_HANDLE(f, NOUN_ROBOT_BUILDER, bad) {
        CHECK_REFUSED(root,
                      cstk_robot_builder_load_urdf(bad->handle, file, &options, NULL, NULL, &root),
                      bad->status, "builder");
    }
    CHECK_REFUSED(root,
                  cstk_robot_builder_load_urdf(f->robot_builder, NULL, &options, NULL, NULL, &root),
                  CSTK_ERROR_NULL_ARGUMENT, "file");
    CHECK_REFUSED(root,
                  cstk_robot_builder_load_urdf(f->robot_builder, "/nowhere/r.urdf", &options, NULL,
                                               NULL, &root),
                  CSTK_ERROR_IO, "/nowhere/r.urdf");
    CHECK_REFUSED(root,
                  cstk_robot_builder_load_urdf(f->robot_builder, "/", &options, NULL, NULL, &root),
                  CSTK_ERROR_IO, "/");
    EACH_BAD_OPTIONS(options, bad) {
        /* NULL stands for the defaults. */
        if (bad->options != NULL) {
            refuse(f, bad->options, bad->status, "urdf_options");
        }
    }
    cstk_robot_builder *planar = NULL;
    CHECK_OK(cstk_robot_builder_create(2, &planar));
    CHECK_REFUSED(root, cstk_robot_builder_load_urdf(planar, file, NULL, NULL, NULL, &root),
                  CSTK_ERROR_INVALID_ARGUMENT, "dimension 3");
    CHECK_OK(cstk_robot_builder_release(planar));
    fixture_unchanged(f);
}

static void fields(const fixture *f) {
    const char *paths[] = {"/tmp", NULL};
    const int32_t numbers[] = {-1, 3, INT32_MIN, INT32_MAX};
    const uint32_t sides[] = {1, 2, 1025, UINT32_MAX};
    for (int i = 0; i < 4; ++i) {
        cstk_urdf_options options = good_options();
        options.geometry = numbers[i];
        refuse(f, &options, CSTK_ERROR_INVALID_ARGUMENT, "geometry");
        options = good_options();
        options.sides = sides[i];
        refuse(f, &options, CSTK_ERROR_INVALID_ARGUMENT, "sides");
    }
    const int32_t bases[] = {-1, CSTK_JOINT_REVOLUTE, CSTK_JOINT_CUSTOM, INT32_MAX};
    for (int i = 0; i < 4; ++i) {
        cstk_urdf_options options = good_options();
        options.base = bases[i];
        refuse(f, &options, CSTK_ERROR_INVALID_ARGUMENT, "base");
    }
    cstk_urdf_options options = good_options();
    options.parent = -2;
    refuse(f, &options, CSTK_ERROR_INVALID_ARGUMENT, "parent");
    options.parent = FIXTURE_LINKS;
    refuse(f, &options, CSTK_ERROR_NOT_FOUND, "parent");
    options = good_options();
    EACH_BAD_POSE(bad) {
        memcpy(options.at, bad->pose, sizeof options.at);
        refuse(f, &options, bad->status, "urdf_options->at");
    }
    options = good_options();
    options.prefix = "\xff";
    refuse(f, &options, CSTK_ERROR_INVALID_ARGUMENT, "prefix");
    options = good_options();
    options.mesh_form = 3;
    refuse(f, &options, CSTK_ERROR_INVALID_ARGUMENT, "mesh_form 3");
    cstk_link_mesh_form forms[2] = {{"a", CSTK_MESH_SOLID, 0}, {"no", CSTK_MESH_HULL, 0}};
    options = good_options();
    options.link_form_count = 2;
    refuse(f, &options, CSTK_ERROR_NULL_ARGUMENT, "link_forms");
    options.link_forms = forms;
    refuse(f, &options, CSTK_ERROR_NOT_FOUND, "\"no\"");
    forms[1].form = -1;
    refuse(f, &options, CSTK_ERROR_INVALID_ARGUMENT, "link_forms[1].form");
    forms[1].link = NULL;
    refuse(f, &options, CSTK_ERROR_NULL_ARGUMENT, "link_forms[1].link");
    options = good_options();
    options.package_path_count = 1;
    refuse(f, &options, CSTK_ERROR_NULL_ARGUMENT, "package_paths");
    options.package_paths = paths;
    options.package_path_count = 2;
    refuse(f, &options, CSTK_ERROR_NULL_ARGUMENT, "package_paths[1]");
    cstk_hierarchy_options damaged;
    memset(&damaged, 0, sizeof damaged);
    options = good_options();
    options.hierarchy = &damaged;
    refuse(f, &options, CSTK_ERROR_NOT_INITIALISED, "urdf_options->hierarchy");
    options = good_options();
    options.cache_folder = file;
    refuse(f, &options, CSTK_ERROR_IO, file);
    options.cache_folder = "/dev/null/folder";
    refuse(f, &options, CSTK_ERROR_IO, "/dev/null/folder");
    options.cache_folder = "";
    refuse(f, &options, CSTK_ERROR_IO, file);
    fixture_unchanged(f);
}

/* What was read is told; a failed load leaves the report of the one before. */
static void reports(const fixture *f) {
    cstk_urdf_report report;
    cstk_robot_builder *builder = NULL;
    EACH_BAD_HANDLE(f, NOUN_ROBOT_BUILDER, bad) {
        CHECK_REFUSED(report, cstk_robot_builder_get_urdf_report(bad->handle, &report), bad->status,
                      "builder");
    }
    CHECK_OK(cstk_robot_builder_create(3, &builder));
    CHECK_FAILS(cstk_robot_builder_get_urdf_report(builder, NULL), CSTK_ERROR_NULL_ARGUMENT, "out");
    CHECK_REFUSED(report, cstk_robot_builder_get_urdf_report(builder, &report), CSTK_ERROR_EMPTY, "URDF");
    CHECK_OK(cstk_robot_builder_load_urdf(builder, file, NULL, NULL, NULL, NULL));
    for (int i = 0; i < 2; ++i) {
        CHECK_OK(cstk_robot_builder_get_urdf_report(builder, &report));
        CHECK(report.root == 0 && report.link_count == 1 && report.joint_count == 0);
        CHECK(report.links_with_body == 1 && report.body_count == 1);
        CHECK(report.shape_count == 1 && report.primitive_count == 1);
        CHECK(report.links_with_other_shapes == 0 && report.skipped_elements == 0);
        CHECK_FAILS(cstk_robot_builder_load_urdf(builder, file, NULL, NULL, NULL, NULL),
                    CSTK_ERROR_INVALID_ARGUMENT, "name");
    }
    CHECK_OK(cstk_robot_builder_release(builder));
}

/* Files that never end, or never begin. */
static void devices(const fixture *f) {
    static const char *const robot =
        "<robot><link name='a'><collision><geometry><mesh filename='%s'/></geometry></collision>"
        "</link></robot>";
    char text[256];
    cstk_robot_builder *builder = f->robot_builder;
    CHECK(mkfifo("hostile_pipe.stl", 0600) == 0);
    CHECK(symlink("/dev/zero", "hostile_zero.stl") == 0);
    const char *names[] = {"hostile_pipe.stl", "hostile_zero.stl"};
    for (int i = 0; i < 2; ++i) {
        cstk_body *body;
        CHECK_FAILS(cstk_robot_builder_load_urdf(builder, names[i], NULL, NULL, NULL, NULL),
                    CSTK_ERROR_IO, names[i]);
        CHECK_REFUSED(body, cstk_body_load(names[i], &body), CSTK_ERROR_IO, names[i]);
        CHECK_FAILS(cstk_body_builder_add_mesh_file(f->body_builder, names[i], NULL, NULL), CSTK_ERROR_IO, names[i]);
        CHECK_FAILS(cstk_body_save(f->body, names[i]), CSTK_ERROR_IO, names[i]);
        snprintf(text, sizeof text, robot, names[i]);
        write_file(text);
        refuse(f, NULL, CSTK_ERROR_NOT_FOUND, names[i]);
        CHECK(remove(names[i]) == 0);
    }
    write_file(good);
    fixture_unchanged(f);
}

static int32_t stop(double fraction, void *user) {
    *(double *)user = fraction;
    return 1;
}

static void files(const fixture *f) {
    const struct {
        const char *text;
        cstk_status status;
        const char *culprit;
    } wrong[] = {
        {"", CSTK_ERROR_PARSE, file},
        {"<robot>", CSTK_ERROR_PARSE, file},
        {"<robot>\n<link name='a'>\n</link>\n", CSTK_ERROR_PARSE, "line 3"},
        {"<robot>\n<link name='a'", CSTK_ERROR_PARSE, "line 2"},
        {"\n<!DOCTYPE r [<!ENTITY a 'aaaa'>]><robot>&a;</robot>", CSTK_ERROR_PARSE, "line 2"},
        {"<sdf/>", CSTK_ERROR_PARSE, "<sdf>"},
        {"<robot/>", CSTK_ERROR_EMPTY, "no link"},
        {"<robot><link name='link0'/></robot>", CSTK_ERROR_INVALID_ARGUMENT, "link0"},
        {"<robot>\n<link name='a'><collision><geometry><box size='nan 1 1'/></geometry></collision>"
         "</link></robot>",
         CSTK_ERROR_NOT_FINITE, "line 2, <box>"},
        {"<robot><link name='a'><collision><geometry><box size='1e99 1 1'/></geometry></collision>"
         "</link></robot>",
         CSTK_ERROR_INVALID_ARGUMENT, "\"a\""},
        {"<robot><link name='a'><collision><geometry><mesh filename='package://p/none.stl'/>"
         "</geometry></collision></link></robot>",
         CSTK_ERROR_NOT_FOUND, "package://p/none.stl"},
    };
    for (size_t i = 0; i < sizeof wrong / sizeof wrong[0]; ++i) {
        write_file(wrong[i].text);
        refuse(f, NULL, wrong[i].status, wrong[i].culprit);
    }
    write_file(good);
    double told = 0;
    uint32_t root;
    CHECK_REFUSED(root,
                  cstk_robot_builder_load_urdf(f->robot_builder, file, NULL, stop, &told, &root),
                  CSTK_ERROR_CANCELLED, "progress");
    CHECK(told == 1.0);
    fixture_unchanged(f);
}

/* Texts in memory: the same refusals, and package:// by ROS's variables. */
static void texts(const fixture *f) {
    static const char *const packaged =
        "<robot name='r'><link name='a'><collision><geometry>"
        "<mesh filename='package://hostile_package/meshes/part.obj'/></geometry></collision></link></robot>";
    uint32_t root;
    const cstk_urdf_options options = good_options();
    cstk_robot_builder *builder = NULL;
    EACH_BAD_HANDLE(f, NOUN_ROBOT_BUILDER, bad) {
        CHECK_REFUSED(root, cstk_robot_builder_load_urdf_text(bad->handle, good, NULL, &options, NULL, NULL, &root),
                      bad->status, "builder");
    }
    builder = f->robot_builder;
    CHECK_REFUSED(root, cstk_robot_builder_load_urdf_text(builder, NULL, NULL, &options, NULL, NULL, &root),
                  CSTK_ERROR_NULL_ARGUMENT, "urdf");
    CHECK_REFUSED(root, cstk_robot_builder_load_urdf_text(builder, "\xff", NULL, &options, NULL, NULL, &root),
                  CSTK_ERROR_INVALID_ARGUMENT, "urdf");
    CHECK_REFUSED(root, cstk_robot_builder_load_urdf_text(builder, "", NULL, NULL, NULL, NULL, &root), CSTK_ERROR_PARSE,
                  "URDF text");
    CHECK_REFUSED(root, cstk_robot_builder_load_urdf_text(builder, "<robot>\n<link/></robot>", NULL, NULL, NULL, NULL, &root),
                  CSTK_ERROR_PARSE, "URDF text: line 2, <link>");
    EACH_BAD_OPTIONS(options, bad) {
        if (bad->options != NULL) {
            CHECK_REFUSED(root,
                          cstk_robot_builder_load_urdf_text(builder, good, NULL, bad->options, NULL, NULL, &root),
                          bad->status, "urdf_options");
        }
    }
    unsetenv("ROS_PACKAGE_PATH");
    unsetenv("AMENT_PREFIX_PATH");
    CHECK_REFUSED(root, cstk_robot_builder_load_urdf_text(builder, packaged, NULL, NULL, NULL, NULL, &root),
                  CSTK_ERROR_NOT_FOUND, "ROS_PACKAGE_PATH (empty)");
    fixture_unchanged(f);

    const char *folders[] = {"hostile_ws", "hostile_ws/src", "hostile_ws/share", "hostile_ws/share/hostile_package",
                             "hostile_ws/share/hostile_package/meshes"};
    for (int i = 0; i < 5; ++i) {
        CHECK(mkdir(folders[i], 0700) == 0);
    }
    /* A circle of links in the workspace ends. */
    CHECK(symlink("..", "hostile_ws/src/up") == 0);
    const char *part = "hostile_ws/share/hostile_package/meshes/part.obj";
    FILE *out = fopen(part, "w");
    CHECK(out != NULL && fputs("v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n", out) >= 0 && fclose(out) == 0);
    const char *variables[][2] = {{"ROS_PACKAGE_PATH", "/nowhere:hostile_ws/src::"}, /* through the circle */
                                  {"ROS_PACKAGE_PATH", "hostile_ws"},
                                  {"ROS_PACKAGE_PATH", "hostile_ws/share/hostile_package"},
                                  {"AMENT_PREFIX_PATH", "/nowhere:hostile_ws"}};
    for (int i = 0; i < 4; ++i) {
        CHECK(setenv(variables[i][0], variables[i][1], 1) == 0);
        cstk_urdf_report report;
        CHECK_OK(cstk_robot_builder_create(3, &builder));
        CHECK_OK(cstk_robot_builder_load_urdf_text(builder, packaged, NULL, NULL, NULL, NULL, &root));
        CHECK_OK(cstk_robot_builder_get_urdf_report(builder, &report));
        CHECK(root == 0 && report.mesh_file_count == 1 && report.links_with_body == 1);
        CHECK_OK(cstk_robot_builder_release(builder));
        CHECK(unsetenv(variables[i][0]) == 0);
    }
    CHECK(remove("hostile_ws/src/up") == 0 && remove(part) == 0);
    for (int i = 5; i-- > 0;) {
        CHECK(remove(folders[i]) == 0);
    }
}

/* What is good is taken, once under each prefix. */
static void taken(void) {
    cstk_robot_builder *builder = NULL;
    cstk_robot *robot = NULL;
    uint32_t root = 9;
    CHECK_OK(cstk_robot_builder_create(3, &builder));
    CHECK_OK(cstk_robot_builder_load_urdf(builder, file, NULL, NULL, NULL, NULL));
    cstk_urdf_options options = good_options();
    options.prefix = "second_";
    options.base = CSTK_JOINT_FREE;
    CHECK_OK(cstk_robot_builder_load_urdf(builder, file, &options, NULL, NULL, &root));
    CHECK(root == 1);
    CHECK_OK(cstk_robot_build(builder, &robot));
    CHECK_OK(cstk_robot_find_link(robot, "second_a", &root));
    CHECK(root == 1);
    CHECK_OK(cstk_robot_release(robot));
    CHECK_OK(cstk_robot_builder_release(builder));
}

int main(void) {
    fixture f;
    fixture_create(&f);
    write_file(good);
    defaults();
    arguments(&f);
    fields(&f);
    reports(&f);
    devices(&f);
    files(&f);
    texts(&f);
    taken();
    CHECK(remove(file) == 0);
    fixture_release(&f);
    return check_result();
}
