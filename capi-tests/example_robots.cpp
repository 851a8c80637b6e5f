// The robots of example-robot-data that come with an SRDF file: each is loaded with it, and asked whether it meets itself in
// the states that the file names, by the pairs that the file leaves.
//
//   example_robots SHARE     the folder share/ that scripts/fetch_pinocchio.sh leaves; exit code 77 where it is not there
#include <cstk.hpp>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <filesystem>
#include <map>
#include <set>
#include <string>
#include <vector>

namespace {

struct Example {
    const char *urdf;
    const char *srdf;
};

// Of each SRDF file the URDF whose names it knows best. Cassie's has no URDF.
const Example examples[] = {
    {"a1_description/urdf/a1", "a1_description/srdf/a1"},
    {"alex_description/urdf/alex_nub_hands", "alex_description/srdf/alex_nub_hands"},
    {"alex_description/urdf/alex_psyonic_hands", "alex_description/srdf/alex_psyonic_hands"},
    {"alex_description/urdf/alex_sake_hands", "alex_description/srdf/alex_sake_hands"},
    {"alexander_description/urdf/alexander_v1.lowerBodyOnly", "alexander_description/srdf/alexander"},
    {"anymal_b_simple_description/robots/anymal-kinova", "anymal_b_simple_description/srdf/anymal-kinova"},
    {"anymal_b_simple_description/robots/anymal", "anymal_b_simple_description/srdf/anymal"},
    {"anymal_c_simple_description/urdf/anymal", "anymal_c_simple_description/srdf/anymal"},
    {"b1_description/urdf/b1-z1", "b1_description/srdf/b1-z1"},
    {"b1_description/urdf/b1", "b1_description/srdf/b1"},
    {"baxter_description/urdf/baxter", "baxter_description/srdf/baxter_manipulation"},
    {"bolt_description/robots/bolt", "bolt_description/srdf/bolt"},
    {"borinot_description/urdf/borinot_flying_arm_2", "borinot_description/srdf/borinot_flying_arm_2"},
    {"centauro_description/urdf/centauro", "centauro_description/srdf/centauro"},
    {"finger_edu_description/robots/finger_edu", "finger_edu_description/srdf/finger_edu"},
    {"go1_description/urdf/go1", "go1_description/srdf/go1"},
    {"go2_description/urdf/go2", "go2_description/srdf/go2"},
    {"hextilt_description/urdf/hextilt_flying_arm_5", "hextilt_description/srdf/hextilt_flying_arm_5"},
    {"hyq_description/robots/hyq_no_sensors", "hyq_description/srdf/hyq"},
    {"icub_description/robots/icub", "icub_description/srdf/icub"},
    {"kinova_description/robots/kinova", "kinova_description/srdf/kinova"},
    {"panda_description/urdf/panda", "panda_description/srdf/panda"},
    {"pr2_description/urdf/pr2", "pr2_description/srdf/pr2"},
    {"pr2_description/urdf/pr2", "pr2_description/srdf/pr2_manipulation"},
    {"romeo_description/urdf/romeo", "romeo_description/srdf/romeo"},
    {"romeo_description/urdf/romeo", "romeo_description/srdf/romeo_moveit"},
    {"romeo_description/urdf/romeo_small", "romeo_description/srdf/romeo_small"},
    {"simple_humanoid_description/urdf/simple_humanoid", "simple_humanoid_description/srdf/simple_humanoid"},
    {"simple_humanoid_description/urdf/simple_humanoid_classical",
     "simple_humanoid_description/srdf/simple_humanoid_classical"},
    {"solo_description/robots/solo12", "solo_description/srdf/solo"},
    {"talos_data/robots/talos_full_v2", "talos_data/srdf/talos"},
    {"ur_description/urdf/ur3_gripper", "ur_description/srdf/ur3_gripper"},
    {"ur_description/urdf/ur5_robot", "ur_description/srdf/ur5"},
    {"ur_description/urdf/ur5_gripper", "ur_description/srdf/ur5_gripper"},
    {"ur_description/urdf/ur5_joint_limited_robot", "ur_description/srdf/ur5_joint_limited_robot"},
    {"xarm_description/urdf/xarm7", "xarm_description/srdf/xarm7"},
    {"z1_description/urdf/z1", "z1_description/srdf/z1"},
};

// URDF files that are faulty, and what is said of them.
const std::map<std::string, std::string> faulty = {
    {"alex_description/urdf/alex_psyonic_hands", "there is no joint \"index_q1\" to mimic"},
};

// SRDF files by which the robot meets itself in a state that they name. Most rule no pair out at all, or forget joined links.
const std::set<std::string> touching = {
    "alex_description/srdf/alex_nub_hands",             // no pair ruled out
    "alex_description/srdf/alex_sake_hands",            // no pair ruled out
    "b1_description/srdf/b1-z1",                        // link02-link03, link02-link06, the gripper's parts
    "bolt_description/srdf/bolt",                       // lower legs and feet
    "borinot_description/srdf/borinot_flying_arm_2",    // no pair ruled out
    "centauro_description/srdf/centauro",               // no pair ruled out
    "hextilt_description/srdf/hextilt_flying_arm_5",    // no pair ruled out
    "icub_description/srdf/icub",                       // no pair ruled out
    "kinova_description/srdf/kinova",                   // no pair ruled out
    "romeo_description/srdf/romeo_small",               // no pair ruled out
    "solo_description/srdf/solo",                       // lower legs and feet
    "ur_description/srdf/ur5",                          // wrist_3_link-ee_link
    "z1_description/srdf/z1",                           // no pair ruled out
};

struct Counts {
    int loaded = 0, strict = 0, states = 0, free_states = 0, free_combined = 0, refused = 0, failed = 0;
};

// The configuration at rest: all coordinates 0, within their ranges.
std::vector<double> rest_of(const cstk::Space &space) { return space.clamp(space.neutral()); }

// The pairs of links that meet at q, by name.
std::vector<std::string> meeting(const cstk::Space &space, const std::vector<std::array<std::uint32_t, 2>> &pairs,
                                 const std::vector<double> &q) {
    std::vector<std::string> found;
    cstk::Query query;
    for (const auto &pair : pairs) {
        const cstk::CObject set = cstk::CObject::induced_links(space, {pair});
        if (query.classify(set, q) == CSTK_CLASS_INSIDE) {
            found.push_back(space.link_name(pair[0]) + "-" + space.link_name(pair[1]));
        }
    }
    return found;
}

// The pairs that the file leaves, less those that are joined, or meet at rest.
std::vector<std::array<std::uint32_t, 2>> combined_pairs(const cstk::Space &space) {
    cstk_link_pair_options options = cstk::link_pair_options();
    options.samples = 1;
    return cstk::Query().find_link_pairs(space, options).tested;
}

void load(cstk::RobotBuilder &builder, const std::string &robots, const Example &example, bool skips_unknown) {
    const std::string share = std::filesystem::path(robots).parent_path().parent_path();
    const char *paths[] = {share.c_str()};
    cstk_urdf_options of_urdf = cstk::urdf_options();
    of_urdf.package_paths = paths;
    of_urdf.package_path_count = 1;
    of_urdf.base = CSTK_JOINT_FREE;
    builder.load_urdf(robots + "/" + example.urdf + ".urdf", of_urdf);
    cstk_srdf_options of_srdf = cstk::srdf_options();
    of_srdf.skip_unknown = skips_unknown;
    builder.load_srdf(robots + "/" + example.srdf + ".srdf", of_srdf);
}

void try_states(const cstk::Robot &robot, const Example &example, Counts &counts) {
    const cstk::Space space(robot);
    const auto pairs = space.enabled_pairs();
    // A robot without bodies has no pairs.
    const auto combined = pairs.empty() ? pairs : combined_pairs(space);
    bool is_free = true;
    const std::uint32_t count = robot.semantics().state_count;
    for (std::uint32_t i = 0; i < std::max(count, 1u); ++i) {
        const std::vector<double> rest = rest_of(space);
        const std::vector<double> q = count > 0 ? robot.apply_state(i, rest) : rest;
        const std::vector<std::string> found = meeting(space, pairs, q);
        ++counts.states;
        counts.free_states += found.empty();
        is_free = is_free && found.empty();
        const std::vector<std::string> left = found.empty() ? found : meeting(space, combined, q);
        counts.free_combined += left.empty();
        std::printf("    %s: ", count > 0 ? robot.state(i).name : "at rest");
        std::printf(found.empty() ? "free" : "%zu pairs meet:", found.size());
        for (std::size_t k = 0; k < std::min<std::size_t>(found.size(), 4); ++k) {
            std::printf(" %s", found[k].c_str());
        }
        std::printf("%s", found.size() > 4 ? " ..." : "");
        if (!left.empty()) {
            std::printf("; %zu not joined, nor at rest: %s", left.size(), left[0].c_str());
        }
        std::printf("\n");
    }
    if (is_free == (touching.count(example.srdf) > 0)) {
        std::printf("    FAILED: %s\n", is_free ? "expected to meet itself" : "expected to be free");
        ++counts.failed;
    }
}

void try_one(const std::string &robots, const Example &example, Counts &counts) {
    const auto known = faulty.find(example.urdf);
    try {
        cstk::RobotBuilder builder;
        load(builder, robots, example, true);
        const cstk_srdf_report report = builder.srdf_report();
        const cstk::Robot robot = builder.build();
        std::printf("%s: %u groups, %u states, %u end effectors, %u disabled pairs, %zu left; unknown names %u, skipped elements %u\n",
                    example.srdf, report.group_count, report.state_count, report.end_effector_count,
                    report.disabled_pair_count, cstk::Space(robot).enabled_pairs().size(), report.unknown_names, report.skipped_elements);
        ++counts.loaded;
        counts.strict += report.unknown_names == 0;
        counts.failed += known != faulty.end();
        try_states(robot, example, counts);
    } catch (const cstk::Error &error) {
        const std::string message = error.what();
        const bool is_known = known != faulty.end() && message.find(known->second) != std::string::npos;
        std::printf("%s: refused: %s%s\n", example.srdf, message.substr(message.find("robots/") + 7).c_str(),
                    is_known ? "" : "  FAILED");
        ++counts.refused;
        counts.failed += !is_known;
    }
}

} // namespace

int main(int argc, char **argv) {
    const std::string robots = std::string(argc > 1 ? argv[1] : "") + "/example-robot-data/robots";
    if (!std::filesystem::exists(robots + "/panda_description/srdf/panda.srdf")) {
        std::printf("SKIPPED: no SRDF files in %s; see scripts/fetch_pinocchio.sh\n", robots.c_str());
        return 77;
    }
    Counts counts;
    for (const Example &example : examples) {
        try_one(robots, example, counts);
        std::fflush(stdout);
    }
    std::printf("%zu SRDF files: %d loaded with their URDF, %d of them without an unknown name; %d refused for a fault of the "
                "URDF; %d of %d states free by the files' pairs, %d by those that cstk_find_link_pairs leaves of them; %d FAILED\n",
                std::size(examples), counts.loaded, counts.strict, counts.refused, counts.free_states, counts.states,
                counts.free_combined, counts.failed);
    return counts.failed > 0 ? 1 : 0;
}
