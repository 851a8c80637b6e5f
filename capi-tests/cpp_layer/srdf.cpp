#include "check.hpp"
#include "subjects.hpp"

#include <cstdint>
#include <vector>

void srdf() {
    cstk::RobotBuilder builder;
    builder.load_urdf_text(
        "<robot><link name='a'><collision><geometry><sphere radius='0.1'/></geometry></collision></link>"
        "<link name='b'><collision><geometry><sphere radius='0.1'/></geometry></collision></link>"
        "<link name='c'><collision><geometry><sphere radius='0.1'/></geometry></collision></link>"
        "<joint name='ab' type='continuous'><parent link='a'/><child link='b'/><origin xyz='1 0 0'/></joint>"
        "<joint name='bc' type='continuous'><parent link='b'/><child link='c'/><origin xyz='1 0 0'/></joint></robot>");
    builder.load_srdf_text("<robot><virtual_joint name='v' type='fixed' parent_frame='w' child_link='a'/>"
                           "<group name='g'><joint name='bc'/></group>"
                           "<group_state name='s' group='g'><joint name='bc' value='0.5'/></group_state>"
                           "<end_effector name='e' parent_link='b' group='g'/></robot>");
    REQUIRE(builder.srdf_report().group_count == 1);
    builder.disable_pair("a", "b");
    const cstk::Robot robot = builder.build();
    REQUIRE(robot.semantics().state_count == 1 && robot.virtual_joint(0).child_link == 0);
    const cstk_joint_group group = robot.group(robot.find_group("g"));
    REQUIRE(group.joint_count == 1 && group.joints[0] == 2 && group.coordinates[0] == 1);
    REQUIRE(robot.end_effector(robot.find_end_effector("e")).touch_count == 2);
    const std::uint32_t state = robot.find_state("g", "s");
    REQUIRE(robot.state(state).values[0] == 0.5);
    const std::vector<double> q = robot.apply_state(state, {0.25, 0.0});
    REQUIRE(q[0] == 0.25 && q[1] == 0.5);
    const cstk::Robot frozen = robot.frozen({group.joints, group.joint_count}, q);
    REQUIRE(frozen.nq() == 1 && frozen.from_whole(q)[0] == 0.5 && frozen.to_whole({0.75})[0] == 0.25);
    const cstk::Robot again = frozen;
    REQUIRE(again.to_whole({0.75}) == (std::vector<double>{0.25, 0.75}));
    REQUIRE(status_of([&] { return robot.to_whole(q); }) == CSTK_ERROR_EMPTY);
    const auto pairs = cstk::Space(frozen).enabled_pairs();
    REQUIRE(pairs.size() == 2 && pairs[0][1] == 2 && pairs[1][0] == 1);
    REQUIRE(status_of([&] { return robot.find_state("", "s"); }) == CSTK_ERROR_NOT_FOUND);
    REQUIRE(status_of([&] { return builder.load_srdf("/nowhere.srdf"); }) == CSTK_ERROR_IO);
}
