#include "check.hpp"
#include "subjects.hpp"

#include <cmath>
#include <vector>

void paths(cstk::Query &query, const cstk::CObject &obstacles, const std::vector<double> &q) {
    std::vector<double> reached;
    const std::vector<double> far = {q[0] + 100, q[1]};
    const std::vector<double> near = {q[0] + 0.25, q[1]};
    std::vector<double> points = q;
    points.insert(points.end(), q.begin(), q.end());
    REQUIRE(query.motion_path(obstacles, points, 2).motion.outcome == CSTK_MOTION_FREE);
    points.insert(points.end(), far.begin(), far.end());
    const cstk_path_result meets =
        query.motion_path(obstacles, points, 3, cstk::motion_options(), {}, &reached);
    REQUIRE(meets.segment == 1 && meets.motion.outcome == CSTK_MOTION_HIT);
    REQUIRE(query.classify(obstacles, reached) == CSTK_CLASS_INSIDE);
    const auto stop = [](double) { return false; };
    REQUIRE(status_of([&] {
                return query.motion_path(obstacles, points, 3, cstk::motion_options(), stop);
            }) == CSTK_ERROR_CANCELLED);
    const std::vector<double> still = {q[0], q[1], q[0], q[1]};
    const cstk_clearance_result nearest =
        query.motion_clearance(obstacles, q, q, cstk::clearance_options(1e-6));
    const cstk_path_clearance_result along =
        query.path_clearance(obstacles, still, 2, cstk::clearance_options(1e-6), {}, &reached);
    REQUIRE(along.segment == 0 && reached == q && along.clearance.upper == nearest.upper);
    REQUIRE(status_of([&] {
                return query.path_clearance(obstacles, still, 2, cstk::clearance_options(1e-6), stop);
            }) == CSTK_ERROR_CANCELLED);
    const std::vector<double> detour = {q[0], q[1], q[0], q[1] + 3, near[0], near[1]};
    const cstk_shortcut_result shorter = query.path_shortcut(obstacles, detour, 3);
    REQUIRE(shorter.outcome == CSTK_SHORTCUT_DONE && shorter.path.count == 2 && shorter.cuts == 1);
    const std::vector<std::vector<double>> apart = {{q[0], q[1]}, {q[0], q[1] + 3}, near};
    REQUIRE(query.motion_path(obstacles, apart).motion.outcome == CSTK_MOTION_FREE);
    REQUIRE(query.path_clearance(obstacles, {q, q}, cstk::clearance_options(1e-6)).clearance.upper == nearest.upper);
    REQUIRE(is_invalid([&] { return query.motion_path(obstacles, {q, {1}}); }));
    REQUIRE(is_invalid([&] { return query.motion_path(obstacles, std::vector<std::vector<double>>()); }));
    REQUIRE(shorter.path.nq == 2 && cstk::configurations_of(shorter.path)[1] == near);
    REQUIRE(std::fabs(shorter.length_after - 0.25) < 1e-12);
    REQUIRE(query.path_shortcut(obstacles, apart).path.count == 2);
    const auto none = cstk::shortcut_options(0);
    REQUIRE(query.path_shortcut(obstacles, points, 3, none).outcome == CSTK_SHORTCUT_NOT_FREE);
    REQUIRE(status_of([&] { return query.path_shortcut(obstacles, detour, 3, none, stop); }) ==
            CSTK_ERROR_CANCELLED);
}
