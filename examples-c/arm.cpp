// A robot from its URDF and SRDF files among named obstacles: what blocks a motion, a way round it, the way made shorter and its clearance,
// the same with a cup in the hand, and which way is out. The texts stand here; Robot::from_urdf reads files.
#include <cstk.hpp>

#include <cstdio>
#include <string>
#include <vector>

static const char *urdf = R"(<robot name="arm">
  <link name="base"><collision><origin xyz="0 0 .05"/><geometry><box size=".2 .2 .1"/></geometry></collision></link>
  <link name="turret"><collision><origin xyz="0 0 .1"/><geometry><cylinder radius=".07" length=".2"/></geometry></collision></link>
  <link name="upper"><collision><origin xyz="0 0 .2"/><geometry><box size=".08 .08 .4"/></geometry></collision></link>
  <link name="fore"><collision><origin xyz="0 0 .175"/><geometry><box size=".06 .06 .35"/></geometry></collision></link>
  <link name="hand"><collision><origin xyz="0 0 .05"/><geometry><box size=".05 .08 .1"/></geometry></collision></link>
  <link name="tool"/>
  <joint name="yaw" type="revolute"><parent link="base"/><child link="turret"/><origin xyz="0 0 .1"/><axis xyz="0 0 1"/>
    <limit lower="-3" upper="3" effort="1" velocity="1"/></joint>
  <joint name="shoulder" type="revolute"><parent link="turret"/><child link="upper"/><origin xyz="0 0 .2"/><axis xyz="0 1 0"/>
    <limit lower="-2" upper="2" effort="1" velocity="1"/></joint>
  <joint name="elbow" type="revolute"><parent link="upper"/><child link="fore"/><origin xyz="0 0 .4"/><axis xyz="0 1 0"/>
    <limit lower="-2.5" upper="2.5" effort="1" velocity="1"/></joint>
  <joint name="wrist" type="revolute"><parent link="fore"/><child link="hand"/><origin xyz="0 0 .35"/><axis xyz="0 1 0"/>
    <limit lower="-2" upper="2" effort="1" velocity="1"/></joint>
  <joint name="grip" type="fixed"><parent link="hand"/><child link="tool"/><origin xyz="0 0 .1"/></joint>
</robot>)";

static const char *srdf = R"(<robot name="arm">
  <group name="arm"><chain base_link="base" tip_link="tool"/></group>
  <group_state name="up" group="arm"><joint name="yaw" value="0"/><joint name="shoulder" value="0"/>
    <joint name="elbow" value="0"/><joint name="wrist" value="0"/></group_state>
  <disable_collisions link1="base" link2="turret"/><disable_collisions link1="turret" link2="upper"/>
  <disable_collisions link1="upper" link2="fore"/><disable_collisions link1="fore" link2="hand"/>
</robot>)";

using Configuration = std::vector<double>;

int main() try {
    cstk::RobotBuilder builder;
    builder.load_urdf_text(urdf);
    builder.load_srdf_text(srdf);
    const cstk::Robot robot = builder.build();
    const cstk::Space space(robot);

    // The base stands on the table: pairs that no joint moves are left out.
    cstk::Environment world;
    world.add(cstk::Body::box({1, 1, 0.02}), cstk::translation(0, 0, -0.02), "table");
    world.add(cstk::Body::cylinder(0.04, 0.3), cstk::translation(0.35, 0.35, 0.3), "post");
    cstk_induced_options options = cstk::induced_options(0.002); // 2 mm kept from all obstacles
    options.leave_out_unmoved = 1;
    const cstk::CObject obstacles = cstk::CObject::induced(space, world, options);
    const cstk::CObject itself = cstk::CObject::induced_links(space, space.enabled_pairs());
    const cstk::CObject forbidden = cstk::CObject::union_of({obstacles, itself});

    // The whole motion is proved, or followed to its first contact.
    cstk::Query query;
    const Configuration from = {-0.6, 1.0, 0.6, 0.0}, to = {1.9, 1.0, 0.6, 0.0};
    Configuration reached;
    const cstk_motion_result straight = query.motion(forbidden, from, to, cstk::motion_options(), &reached);
    std::printf("straight on: %s", cstk::to_string(straight.outcome));
    if (straight.outcome == CSTK_MOTION_HIT) {
        std::printf(" at %.3f, %s", straight.times[1], cstk::describe(space, world, straight.distance.witness).c_str());
    }

    // Over the top, and as much shorter as can be proved.
    const Configuration up = robot.apply_state(robot.find_state("arm", "up"), space.neutral());
    Configuration up_before = up, up_behind = up;
    up_before[0] = from[0];
    up_behind[0] = to[0];
    const std::vector<Configuration> over = {from, up_before, up_behind, to};
    const bool is_free = query.motion_path(forbidden, over).motion.outcome == CSTK_MOTION_FREE;
    const cstk_shortcut_result cut = query.path_shortcut(forbidden, over);
    const std::vector<Configuration> path = cstk::configurations_of(cut.path);
    const double nearest = query.path_clearance(forbidden, path, cstk::clearance_options(1e-4)).clearance.lower;
    std::printf("\nover the top: %s, %.2f rad long, cut to %.2f; %.1f mm to spare beyond the margin\n",
                is_free ? "free" : "not free", cut.length_before, cut.length_after, 1e3 * nearest);

    // A cup in the hand, which the hand may touch, is part of the robot from then on.
    world.add_attached(cstk::Body::cylinder(0.05, 0.08), space, space.find_link("tool"), cstk::translation(0, 0, 0.08),
                       {space.find_link("hand")}, "cup");
    const cstk_path_result held = query.motion_path(forbidden, path);
    std::printf("with a cup: %s", cstk::to_string(held.motion.outcome));
    if (held.motion.outcome == CSTK_MOTION_HIT) {
        std::printf(" in segment %zu, %s", static_cast<std::size_t>(held.segment),
                    cstk::describe(space, world, held.motion.distance.witness).c_str());
    }
    const bool is_free_held = query.motion_path(forbidden, over).motion.outcome == CSTK_MOTION_FREE;
    std::printf("; over the top: %s\n", is_free_held ? "free" : "not free");

    // Which way is out, in joint space.
    std::vector<double> gradient(space.nv());
    const Configuration near = {0.45, 1.0, 0.6, 0.0};
    const cstk_distance_result distance = query.distance_with_gradient(forbidden, near, gradient);
    std::printf("%s are %.1f mm apart, changing by", cstk::describe(space, world, distance.witness).c_str(), 1e3 * distance.distance);
    for (const double slope : gradient) {
        std::printf(" %.3f", slope);
    }
    std::printf(" m/rad\n");
    const bool went_well = straight.outcome == CSTK_MOTION_HIT && is_free && cut.length_after < cut.length_before &&
                           nearest > 0 && is_free_held && distance.has_contact;
    return went_well ? 0 : 1;
} catch (const cstk::Error &error) {
    std::fprintf(stderr, "%s\n", error.what());
    return 1;
}
