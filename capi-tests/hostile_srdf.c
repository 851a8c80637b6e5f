/* Hostile input to the reader of SRDF files, to what tells of them, and to robots with frozen joints. */
#define _POSIX_C_SOURCE 200809L
#include <math.h>
#include <sys/stat.h>
#include <unistd.h>

#include "check.h"
#include "fixture.h"

static const char *const file = "hostile.srdf";

/* Of the fixture's arm, whose links are link0 to link3 and whose joints have no names. */
static const char *const good =
    "<robot><group name='arm'><link name='link1'/><link name='link3'/></group>"
    "<group_state name='home' group='arm'/>"
    "<end_effector name='hand' parent_link='link2' group='arm'/>"
    "<virtual_joint name='base' type='planar' parent_frame='odom' child_link='link0'/>"
    "<passive_joint name='base'/><disable_collisions link1='link1' link2='link2'/></robot>";

static void write_file(const char *text) {
    FILE *out = fopen(file, "w");
    CHECK(out != NULL);
    CHECK(fputs(text, out) >= 0);
    CHECK(fclose(out) == 0);
}

static cstk_srdf_options good_options(void) {
    cstk_srdf_options options;
    CHECK_OK(cstk_srdf_options_default(&options, sizeof options));
    return options;
}

static void options_and_arguments(const fixture *f) {
    cstk_srdf_options options = good_options();
    cstk_robot_builder *builder = f->robot_builder;
    CHECK_FAILS(cstk_srdf_options_default(NULL, sizeof options), CSTK_ERROR_NULL_ARGUMENT, "out");
    CHECK_REFUSED(options, cstk_srdf_options_default(&options, 0), CSTK_ERROR_WRONG_SIZE, "size");
    options = good_options();
    EACH_BAD_HANDLE(f, NOUN_ROBOT_BUILDER, bad) {
        CHECK_FAILS(cstk_robot_builder_load_srdf(bad->handle, file, &options), bad->status, "builder");
        CHECK_FAILS(cstk_robot_builder_load_srdf_text(bad->handle, good, &options), bad->status, "builder");
        CHECK_FAILS(cstk_robot_builder_disable_pair(bad->handle, "link1", "link2"), bad->status, "builder");
    }
    CHECK_FAILS(cstk_robot_builder_load_srdf(builder, NULL, &options), CSTK_ERROR_NULL_ARGUMENT, "file");
    CHECK_FAILS(cstk_robot_builder_load_srdf(builder, "/nowhere/r.srdf", &options), CSTK_ERROR_IO, "/nowhere/r.srdf");
    CHECK_FAILS(cstk_robot_builder_load_srdf(builder, "/", &options), CSTK_ERROR_IO, "/");
    CHECK_FAILS(cstk_robot_builder_load_srdf_text(builder, NULL, &options), CSTK_ERROR_NULL_ARGUMENT, "srdf");
    CHECK_FAILS(cstk_robot_builder_load_srdf_text(builder, "\xff", NULL), CSTK_ERROR_INVALID_ARGUMENT, "srdf");
    EACH_BAD_OPTIONS(options, bad) {
        /* NULL stands for the defaults. */
        if (bad->options != NULL) {
            CHECK_FAILS(cstk_robot_builder_load_srdf(builder, file, bad->options), bad->status, "srdf_options");
            CHECK_FAILS(cstk_robot_builder_load_srdf_text(builder, good, bad->options), bad->status, "srdf_options");
        }
    }
    options.prefix = "\xff";
    CHECK_FAILS(cstk_robot_builder_load_srdf(builder, file, &options), CSTK_ERROR_INVALID_ARGUMENT, "prefix");
    options.prefix = "other_";
    CHECK_FAILS(cstk_robot_builder_load_srdf(builder, file, &options), CSTK_ERROR_NOT_FOUND, "\"other_link0\"");
    CHECK_FAILS(cstk_robot_builder_disable_pair(builder, NULL, "link2"), CSTK_ERROR_NULL_ARGUMENT, "r_link");
    CHECK_FAILS(cstk_robot_builder_disable_pair(builder, "link2", NULL), CSTK_ERROR_NULL_ARGUMENT, "s_link");
    CHECK_FAILS(cstk_robot_builder_disable_pair(builder, "link2", "no"), CSTK_ERROR_NOT_FOUND, "\"no\"");
    CHECK_FAILS(cstk_robot_builder_disable_pair(builder, "link2", "link2"), CSTK_ERROR_INVALID_ARGUMENT, "itself");
    fixture_unchanged(f);
}

static void files(const fixture *f) {
    const struct {
        const char *text;
        cstk_status status;
        const char *culprit;
    } wrong[] = {
        {"", CSTK_ERROR_PARSE, file},
        {"<robot>", CSTK_ERROR_PARSE, file},
        {"<robot><group name='arm'><link name='link1'/>", CSTK_ERROR_PARSE, file},
        {"<!DOCTYPE r [<!ENTITY a 'aaaa'>]><robot>&a;</robot>", CSTK_ERROR_PARSE, file},
        {"<sdf/>", CSTK_ERROR_PARSE, "<sdf>"},
        {"<robot>\n<group name='g'><link name='no'/></group></robot>", CSTK_ERROR_NOT_FOUND, "line 2, <link>"},
        {"<robot><group name='g'><group name='h'/></group><group name='h'><group name='g'/></group></robot>",
         CSTK_ERROR_INVALID_ARGUMENT, "circle"},
        {"<robot><group name='g'/><group name='g'/></robot>", CSTK_ERROR_INVALID_ARGUMENT, "\"g\""},
        {"<robot><disable_collisions link1='link1' link2='no'/></robot>", CSTK_ERROR_NOT_FOUND, "<disable_collisions>"},
    };
    for (size_t i = 0; i < sizeof wrong / sizeof wrong[0]; ++i) {
        write_file(wrong[i].text);
        CHECK_FAILS(cstk_robot_builder_load_srdf(f->robot_builder, file, NULL), wrong[i].status, wrong[i].culprit);
    }
    /* Files that never end, or never begin. */
    CHECK(mkfifo("hostile_pipe.srdf", 0600) == 0);
    CHECK_FAILS(cstk_robot_builder_load_srdf(f->robot_builder, "hostile_pipe.srdf", NULL), CSTK_ERROR_IO, "hostile_pipe.srdf");
    CHECK(remove("hostile_pipe.srdf") == 0);
    CHECK_FAILS(cstk_robot_builder_load_srdf(f->robot_builder, "/dev/zero", NULL), CSTK_ERROR_IO, "/dev/zero");
    write_file(good);
    fixture_unchanged(f);
}

static cstk_robot *with_semantics(const fixture *f) {
    cstk_robot_builder *builder = NULL;
    cstk_robot *robot = NULL;
    cstk_srdf_report report;
    CHECK_OK(cstk_robot_builder_create(3, &builder));
    CHECK_OK(cstk_robot_release(make_arm(builder, f->body)));
    EACH_BAD_HANDLE(f, NOUN_ROBOT_BUILDER, bad) {
        CHECK_REFUSED(report, cstk_robot_builder_get_srdf_report(bad->handle, &report), bad->status, "builder");
    }
    CHECK_FAILS(cstk_robot_builder_get_srdf_report(builder, NULL), CSTK_ERROR_NULL_ARGUMENT, "out");
    CHECK_REFUSED(report, cstk_robot_builder_get_srdf_report(builder, &report), CSTK_ERROR_EMPTY, "SRDF");
    CHECK_OK(cstk_robot_builder_load_srdf(builder, file, NULL));
    for (int i = 0; i < 2; ++i) {
        CHECK_OK(cstk_robot_builder_get_srdf_report(builder, &report));
        CHECK(report.group_count == 1 && report.state_count == 1 && report.end_effector_count == 1);
        CHECK(report.virtual_joint_count == 1 && report.passive_joint_count == 1 && report.disabled_pair_count == 1);
        CHECK(report.skipped_elements == 0 && report.unknown_names == 0 && report.unused_values == 0);
        /* What is there already is refused; the report stays. */
        CHECK_FAILS(cstk_robot_builder_load_srdf(builder, file, NULL), CSTK_ERROR_INVALID_ARGUMENT, file);
    }
    CHECK_OK(cstk_robot_builder_disable_pair(builder, "link3", "link2"));
    CHECK_OK(cstk_robot_build(builder, &robot));
    CHECK_OK(cstk_robot_builder_release(builder));
    return robot;
}

static void finds(const fixture *f, const cstk_robot *robot) {
    uint32_t index = 9;
    CHECK_OK(cstk_robot_find_group(robot, "arm", &index));
    CHECK(index == 0);
    CHECK_OK(cstk_robot_find_state(robot, "arm", "home", &index));
    CHECK(index == 0);
    CHECK_OK(cstk_robot_find_end_effector(robot, "hand", &index));
    CHECK(index == 0);
    EACH_BAD_HANDLE(f, NOUN_ROBOT, bad) {
        CHECK_REFUSED(index, cstk_robot_find_group(bad->handle, "arm", &index), bad->status, "robot");
        CHECK_REFUSED(index, cstk_robot_find_state(bad->handle, "arm", "home", &index), bad->status, "robot");
        CHECK_REFUSED(index, cstk_robot_find_end_effector(bad->handle, "hand", &index), bad->status, "robot");
    }
    CHECK_FAILS(cstk_robot_find_group(robot, "arm", NULL), CSTK_ERROR_NULL_ARGUMENT, "out");
    CHECK_FAILS(cstk_robot_find_state(robot, "arm", "home", NULL), CSTK_ERROR_NULL_ARGUMENT, "out");
    CHECK_FAILS(cstk_robot_find_end_effector(robot, "hand", NULL), CSTK_ERROR_NULL_ARGUMENT, "out");
    CHECK_REFUSED(index, cstk_robot_find_group(robot, NULL, &index), CSTK_ERROR_NULL_ARGUMENT, "name");
    CHECK_REFUSED(index, cstk_robot_find_state(robot, "arm", NULL, &index), CSTK_ERROR_NULL_ARGUMENT, "name");
    CHECK_REFUSED(index, cstk_robot_find_end_effector(robot, NULL, &index), CSTK_ERROR_NULL_ARGUMENT, "name");
    CHECK_REFUSED(index, cstk_robot_find_group(robot, "leg", &index), CSTK_ERROR_NOT_FOUND, "\"leg\"");
    CHECK_REFUSED(index, cstk_robot_find_state(robot, "leg", "home", &index), CSTK_ERROR_NOT_FOUND, "\"leg\"");
    CHECK_REFUSED(index, cstk_robot_find_state(robot, NULL, "home", &index), CSTK_ERROR_NOT_FOUND, "\"home\"");
    CHECK_REFUSED(index, cstk_robot_find_end_effector(robot, "foot", &index), CSTK_ERROR_NOT_FOUND, "\"foot\"");
}

static void views(const fixture *f, const cstk_robot *robot) {
    cstk_semantics semantics;
    cstk_joint_group group;
    cstk_named_state state;
    cstk_end_effector hand;
    cstk_virtual_joint base;
    CHECK_OK(cstk_robot_get_semantics(robot, &semantics));
    CHECK(semantics.group_count == 1 && semantics.passive_joint_count == 1 && semantics.passive_joints[0] == 0);
    CHECK_OK(cstk_robot_get_group(robot, 0, &group));
    CHECK(strcmp(group.name, "arm") == 0 && group.joint_count == 2 && group.coordinate_count == 2);
    CHECK(group.joints[0] == 1 && group.joints[1] == 3 && group.coordinates[0] == 0 && group.coordinates[1] == 2);
    CHECK_OK(cstk_robot_get_state(robot, 0, &state));
    CHECK(strcmp(state.name, "home") == 0 && state.group == 0 && state.count == 0);
    CHECK_OK(cstk_robot_get_end_effector(robot, 0, &hand));
    CHECK(strcmp(hand.name, "hand") == 0 && hand.parent_link == 2 && hand.parent_group == -1 && hand.touch_count == 3);
    CHECK_OK(cstk_robot_get_virtual_joint(robot, 0, &base));
    CHECK(strcmp(base.name, "base") == 0 && strcmp(base.parent_frame, "odom") == 0 && base.kind == CSTK_JOINT_PLANAR);
    EACH_BAD_HANDLE(f, NOUN_ROBOT, bad) {
        CHECK_REFUSED(semantics, cstk_robot_get_semantics(bad->handle, &semantics), bad->status, "robot");
        CHECK_REFUSED(group, cstk_robot_get_group(bad->handle, 0, &group), bad->status, "robot");
        CHECK_REFUSED(state, cstk_robot_get_state(bad->handle, 0, &state), bad->status, "robot");
        CHECK_REFUSED(hand, cstk_robot_get_end_effector(bad->handle, 0, &hand), bad->status, "robot");
        CHECK_REFUSED(base, cstk_robot_get_virtual_joint(bad->handle, 0, &base), bad->status, "robot");
    }
    CHECK_FAILS(cstk_robot_get_semantics(robot, NULL), CSTK_ERROR_NULL_ARGUMENT, "out");
    CHECK_FAILS(cstk_robot_get_group(robot, 0, NULL), CSTK_ERROR_NULL_ARGUMENT, "out");
    CHECK_FAILS(cstk_robot_get_state(robot, 0, NULL), CSTK_ERROR_NULL_ARGUMENT, "out");
    CHECK_FAILS(cstk_robot_get_end_effector(robot, 0, NULL), CSTK_ERROR_NULL_ARGUMENT, "out");
    CHECK_FAILS(cstk_robot_get_virtual_joint(robot, 0, NULL), CSTK_ERROR_NULL_ARGUMENT, "out");
    const uint32_t beyond[] = {1, UINT32_MAX};
    for (int i = 0; i < 2; ++i) {
        CHECK_REFUSED(group, cstk_robot_get_group(robot, beyond[i], &group), CSTK_ERROR_NOT_FOUND, "group");
        CHECK_REFUSED(state, cstk_robot_get_state(robot, beyond[i], &state), CSTK_ERROR_NOT_FOUND, "state");
        CHECK_REFUSED(hand, cstk_robot_get_end_effector(robot, beyond[i], &hand), CSTK_ERROR_NOT_FOUND, "end effector");
        CHECK_REFUSED(base, cstk_robot_get_virtual_joint(robot, beyond[i], &base), CSTK_ERROR_NOT_FOUND, "virtual joint");
    }
    double q[FIXTURE_NQ] = {1, 2, 3};
    CHECK_OK(cstk_robot_apply_state(robot, 0, q, FIXTURE_NQ));
    CHECK(q[0] == 1 && q[1] == 2 && q[2] == 3);
    EACH_BAD_HANDLE(f, NOUN_ROBOT, bad) {
        CHECK_FAILS(cstk_robot_apply_state(bad->handle, 0, q, FIXTURE_NQ), bad->status, "robot");
    }
    CHECK_FAILS(cstk_robot_apply_state(robot, 1, q, FIXTURE_NQ), CSTK_ERROR_NOT_FOUND, "state");
    CHECK_FAILS(cstk_robot_apply_state(robot, 0, NULL, FIXTURE_NQ), CSTK_ERROR_NULL_ARGUMENT, "q");
    CHECK_FAILS(cstk_robot_apply_state(robot, 0, q, 2), CSTK_ERROR_WRONG_SIZE, "2 entries");
    EACH_NOT_FINITE(i) {
        double wrong[FIXTURE_NQ] = {0, not_finite[i], 0};
        CHECK_FAILS(cstk_robot_apply_state(robot, 0, wrong, FIXTURE_NQ), CSTK_ERROR_NOT_FINITE, "1");
    }
}

static void pairs(const fixture *f, const cstk_robot *robot) {
    cstk_space *space = NULL;
    uint32_t list[8];
    size_t count = 0;
    CHECK_OK(cstk_space_create(&robot, 1, NULL, 0, NULL, &space));
    /* Of link1, link2 and link3 the file and the builder leave one pair. */
    CHECK_OK(cstk_space_get_enabled_pairs(space, 4, list, &count));
    CHECK(count == 1 && list[0] == 1 && list[1] == 3);
    CHECK_OK(cstk_space_get_enabled_pairs(space, 0, NULL, &count));
    EACH_BAD_HANDLE(f, NOUN_SPACE, bad) {
        CHECK_REFUSED(count, cstk_space_get_enabled_pairs(bad->handle, 4, list, &count), bad->status, "space");
    }
    CHECK_FAILS(cstk_space_get_enabled_pairs(space, 4, list, NULL), CSTK_ERROR_NULL_ARGUMENT, "count");
    CHECK_REFUSED(count, cstk_space_get_enabled_pairs(space, 4, NULL, &count), CSTK_ERROR_NULL_ARGUMENT, "pairs");
    CHECK_OK(cstk_space_release(space));
}

static void frozen(const fixture *f) {
    const uint32_t joints[] = {3, 3};
    const uint32_t beyond[] = {3, FIXTURE_LINKS};
    double one[1] = {0.25};
    double whole[FIXTURE_NQ];
    cstk_robot *robot = NULL;
    cstk_robot *refused;
    EACH_BAD_HANDLE(f, NOUN_ROBOT, bad) {
        CHECK_REFUSED(refused, cstk_robot_create_frozen(bad->handle, joints, 2, f->q, FIXTURE_NQ, &refused), bad->status,
                      "robot");
        CHECK_FAILS(cstk_robot_to_whole(bad->handle, one, 1, whole, FIXTURE_NQ), bad->status, "robot");
        CHECK_FAILS(cstk_robot_from_whole(bad->handle, f->q, FIXTURE_NQ, one, 1), bad->status, "robot");
    }
    CHECK_FAILS(cstk_robot_create_frozen(f->robot, joints, 2, f->q, FIXTURE_NQ, NULL), CSTK_ERROR_NULL_ARGUMENT, "out");
    CHECK_REFUSED(refused, cstk_robot_create_frozen(f->robot, NULL, 2, f->q, FIXTURE_NQ, &refused),
                  CSTK_ERROR_NULL_ARGUMENT, "joints");
    CHECK_REFUSED(refused, cstk_robot_create_frozen(f->robot, joints, 2, NULL, FIXTURE_NQ, &refused),
                  CSTK_ERROR_NULL_ARGUMENT, "q");
    CHECK_REFUSED(refused, cstk_robot_create_frozen(f->robot, joints, 2, f->q, 2, &refused), CSTK_ERROR_WRONG_SIZE,
                  "2 entries");
    CHECK_REFUSED(refused, cstk_robot_create_frozen(f->robot, beyond, 2, f->q, FIXTURE_NQ, &refused),
                  CSTK_ERROR_NOT_FOUND, "joints[1]");
    EACH_NOT_FINITE(i) {
        const double wrong[FIXTURE_NQ] = {0, not_finite[i], 0};
        CHECK_REFUSED(refused, cstk_robot_create_frozen(f->robot, joints, 2, wrong, FIXTURE_NQ, &refused),
                      CSTK_ERROR_NOT_FINITE, "1");
    }
    CHECK_FAILS(cstk_robot_to_whole(f->robot, f->q, FIXTURE_NQ, whole, FIXTURE_NQ), CSTK_ERROR_EMPTY, "whole");
    CHECK_FAILS(cstk_robot_from_whole(f->robot, f->q, FIXTURE_NQ, whole, FIXTURE_NQ), CSTK_ERROR_EMPTY, "whole");

    /* It outlives the robot it was made from, and answers as that does. */
    cstk_robot_builder *builder = NULL;
    CHECK_OK(cstk_robot_builder_create(3, &builder));
    cstk_robot *arm = make_arm(builder, f->body);
    CHECK_OK(cstk_robot_builder_release(builder));
    CHECK_OK(cstk_robot_create_frozen(arm, joints, 2, f->q, FIXTURE_NQ, &robot));
    CHECK_OK(cstk_robot_release(arm));
    CHECK_OK(cstk_robot_from_whole(robot, f->q, FIXTURE_NQ, one, 1));
    CHECK(one[0] == f->q[2]);
    CHECK_OK(cstk_robot_to_whole(robot, one, 1, whole, FIXTURE_NQ));
    CHECK(memcmp(whole, f->q, sizeof whole) == 0);
    for (uint32_t i = 0; i < FIXTURE_LINKS; ++i) {
        double pose[12];
        CHECK_OK(cstk_robot_link_pose(robot, one, 1, i, pose));
        for (int k = 0; k < 12; ++k) {
            CHECK(fabs(pose[k] - f->link_poses[12 * i + (uint32_t)k]) < 1e-15);
        }
    }
    CHECK_FAILS(cstk_robot_to_whole(robot, NULL, 1, whole, FIXTURE_NQ), CSTK_ERROR_NULL_ARGUMENT, "q");
    CHECK_FAILS(cstk_robot_to_whole(robot, one, 1, NULL, FIXTURE_NQ), CSTK_ERROR_NULL_ARGUMENT, "whole");
    CHECK_REFUSED(whole, cstk_robot_to_whole(robot, one, 1, whole, 2), CSTK_ERROR_WRONG_SIZE, "whole");
    CHECK_REFUSED(whole, cstk_robot_to_whole(robot, f->q, 2, whole, FIXTURE_NQ), CSTK_ERROR_WRONG_SIZE, "2 entries");
    CHECK_REFUSED(one, cstk_robot_from_whole(robot, f->q, 2, one, 1), CSTK_ERROR_WRONG_SIZE, "2 entries");
    CHECK_REFUSED(one, cstk_robot_from_whole(robot, NULL, FIXTURE_NQ, one, 1), CSTK_ERROR_NULL_ARGUMENT, "whole");
    CHECK_FAILS(cstk_robot_from_whole(robot, f->q, FIXTURE_NQ, NULL, 1), CSTK_ERROR_NULL_ARGUMENT, "q");
    CHECK_REFUSED(whole, cstk_robot_from_whole(robot, f->q, FIXTURE_NQ, whole, 2), CSTK_ERROR_WRONG_SIZE, "q has 2");
    CHECK_OK(cstk_robot_release(robot));
}

int main(void) {
    fixture f;
    fixture_create(&f);
    write_file(good);
    options_and_arguments(&f);
    files(&f);
    cstk_robot *robot = with_semantics(&f);
    finds(&f, robot);
    views(&f, robot);
    pairs(&f, robot);
    CHECK_OK(cstk_robot_release(robot));
    frozen(&f);
    fixture_unchanged(&f);
    CHECK(remove(file) == 0);
    fixture_release(&f);
    return check_result();
}
