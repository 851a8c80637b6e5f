#include "check.hpp"
#include "subjects.hpp"

#include <cmath>
#include <utility>
#include <vector>

/* A cube on a rail that meets another 2.5 ahead of q. */
void motions(cstk::Query &query, const cstk::CObject &obstacles, const cstk::Body &body,
             const std::vector<double> &q) {
    bool passed = false;
    std::vector<double> reached;
    const cstk_motion_result rests = query.motion(obstacles, q, q);
    REQUIRE(rests.outcome == CSTK_MOTION_FREE);
    const std::vector<double> far = {q[0] + 100, q[1]};
    const cstk_motion_result hits =
        query.motion(obstacles, q, far, cstk::motion_options(), &reached);
    REQUIRE(hits.outcome == CSTK_MOTION_HIT && hits.distance.distance == 0.0);
    REQUIRE(query.classify(obstacles, reached) == CSTK_CLASS_INSIDE);
    const cstk_clearance_result nearest =
        query.motion_clearance(obstacles, q, q, cstk::clearance_options(1e-6), &reached);
    REQUIRE(nearest.outcome == CSTK_CLEARANCE_KNOWN && reached == q);
    REQUIRE(nearest.lower <= 2.5 && nearest.upper >= nearest.lower);

    const std::vector<double> curve = {q[0], q[1], q[0] + 1, q[1], q[0], q[1]};
    REQUIRE(query.motion_curve(obstacles, curve, 3).outcome == CSTK_MOTION_FREE);
    const std::vector<double> knots = {0, 0, 1, 1}, line = {q[0], q[1], q[0] + 100, q[1]};
    const auto options = cstk::motion_options();
    const cstk_motion_result spline =
        query.motion_spline(obstacles, 1, knots, line, 2, options, &reached);
    REQUIRE(spline.outcome == CSTK_MOTION_HIT && std::fabs(reached[0] - 3) < 1e-3);
    REQUIRE(is_invalid([&] { return query.motion_curve(obstacles, {1, 2, 3}, 2); }));
    /* There and back by 5: at 3 after t with 5 sin(pi t) = 2.5. */
    const double pi = std::acos(-1.0);
    const auto swing = [&](double t, double *at, double *rates, double *accelerations) {
        at[0] = q[0] + 5 * std::sin(pi * t);
        rates[0] = 5 * pi * std::cos(pi * t);
        accelerations[0] = -5 * pi * pi * std::sin(pi * t);
        at[1] = q[1];
        rates[1] = accelerations[1] = 0;
    };
    const std::vector<double> rates = {5 * pi, 0}, accelerations = {5 * pi * pi, 0}, slow = {5, 0};
    const cstk_motion_result swung =
        query.motion_function(obstacles, swing, rates, accelerations, options, &reached);
    REQUIRE(swung.outcome == CSTK_MOTION_HIT && std::fabs(swung.times[1] - 1.0 / 6) < 1e-5);
    REQUIRE(status_of([&] { return query.motion_function(obstacles, swing, slow, accelerations); }) ==
            CSTK_ERROR_INVALID_ARGUMENT);
    passed = false;
    try {
        static_cast<void>(query.motion_function(
            obstacles, [](double, double *, double *, double *) { throw 7; }, rates, accelerations));
    } catch (int thrown) {
        passed = thrown == 7;
    }
    REQUIRE(passed);

    std::pair<cstk::Pose, cstk::Pose> poses;
    const cstk::Pose here = cstk::identity(), there = cstk::translation(5, 0, 0);
    const cstk_motion_result pair =
        query.pair_motion(body, here, there, body, there, there, options, &poses);
    REQUIRE(pair.outcome == CSTK_MOTION_HIT && std::fabs(poses.first[3] - 4) < 1e-3);
    REQUIRE(poses.second == there);
}
