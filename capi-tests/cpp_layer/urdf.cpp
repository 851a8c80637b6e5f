#include "check.hpp"
#include "subjects.hpp"

#include <cstdio>

void urdf() {
    const char *file = "cpp_layer.urdf";
    std::FILE *out = std::fopen(file, "w");
    REQUIRE(out != nullptr);
    std::fputs("<robot name='r'><link name='a'><collision><geometry><sphere radius='1'/></geometry>"
               "</collision></link></robot>",
               out);
    REQUIRE(std::fclose(out) == 0);
    cstk::RobotBuilder builder;
    REQUIRE(builder.load_urdf(file) == 0);
    cstk_urdf_options options = cstk::urdf_options();
    options.prefix = "b_";
    options.base = CSTK_JOINT_FREE;
    REQUIRE(builder.load_urdf(file, options) == 1);
    const cstk_urdf_report report = builder.urdf_report();
    REQUIRE(report.root == 1 && report.links_with_body == 1 && report.primitive_count == 1);
    const cstk::Robot robot = builder.build();
    REQUIRE(robot.find_link("b_a") == 1 && robot.nq() == 7 && robot.nv() == 6);
    REQUIRE(robot.body(1).statistics().primitive_count == 1);
    REQUIRE(cstk::Robot::from_urdf(file, "", {"/packages"}).link_count() == 1);
    REQUIRE(status_of([&] { return cstk::Robot::from_urdf(file, "/nowhere.srdf"); }) == CSTK_ERROR_IO);
    REQUIRE(std::remove(file) == 0);
    REQUIRE(status_of([&] { return builder.load_urdf(file); }) == CSTK_ERROR_IO);
    cstk::RobotBuilder described;
    REQUIRE(described.load_urdf_text("<robot><link name='a'/></robot>") == 0);
    REQUIRE(described.urdf_report().link_count == 1);
}
