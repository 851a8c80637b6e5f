#include "check.hpp"
#include "models.hpp"
#include "subjects.hpp"

void robots() {
    int calls = 0;
    const cstk::Robot robot = make_robot(calls);
    REQUIRE(robot.nq() == 9 && robot.nv() == 8 && robot.link_count() == 4);
    REQUIRE(robot.joint_name(0) == "rail" && robot.joint_name(1).empty());
    REQUIRE(robot.link_name(2) == "drone" && robot.link_name(1) == "link1");
    REQUIRE(robot.link_name(2).size() == 5);
    REQUIRE(robot.find_joint("rail") == 0);
    const cstk_link_info info = robot.link_info(1);
    REQUIRE(info.joint == CSTK_JOINT_PRISMATIC && info.parent == -1 && info.coordinate == 0);
    REQUIRE(info.multiplier == -1 && info.offset == 0.5);
    REQUIRE(robot.link_info(3).joint == CSTK_JOINT_CUSTOM && robot.link_info(3).velocity == 7);
    REQUIRE(status_of([&] { return robot.find_joint("none"); }) == CSTK_ERROR_NOT_FOUND);
    REQUIRE(status_of([&] { return robot.link_info(4); }) == CSTK_ERROR_NOT_FOUND);
    REQUIRE(status_of([&] { return robot.link_name(4); }) == CSTK_ERROR_NOT_FOUND);
    REQUIRE(status_of([&] { return robot.joint_name(4); }) == CSTK_ERROR_NOT_FOUND);
    REQUIRE(calls == 0);
}
