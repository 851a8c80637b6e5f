#include "check.hpp"
#include "subjects.hpp"

#include <cmath>
#include <vector>

void batches(cstk::Query &query, const cstk::CObject &obstacles, const cstk::Body &body,
                    const std::vector<double> &q) {
    const auto stop = [](double) { return false; };
    const std::vector<double> far = {q[0] + 100, q[1]};
    std::vector<double> points = q;
    points.insert(points.end(), q.begin(), q.end());
    points.insert(points.end(), far.begin(), far.end());
    const cstk::Batch batch;
    REQUIRE(batch.classify(obstacles, points, 3).values[2] == query.classify(obstacles, far));
    REQUIRE(batch.within(obstacles, points, 3, 0).values[0] == query.within(obstacles, q, 0));
    const cstk::BatchDistances distances = batch.distance(obstacles, points, 3, 9, q.size());
    REQUIRE(distances.values[1].distance == query.distance(obstacles, q, 9).distance);
    REQUIRE(distances.gradients.size() == points.size() && distances.done.answered == 3);
    const cstk::Span<double> starts(points.data(), 2 * q.size());
    const cstk::Span<double> ends(points.data() + q.size(), 2 * q.size());
    const cstk::BatchMotions moves = batch.motion(obstacles, starts, ends, 2);
    REQUIRE(moves.values[0].outcome == CSTK_MOTION_FREE && moves.values[1].outcome == CSTK_MOTION_HIT);
    const std::vector<double> reached(moves.reached.begin() + 2, moves.reached.end());
    REQUIRE(query.classify(obstacles, reached) == CSTK_CLASS_INSIDE);
    const std::vector<cstk::Pose> poses = {cstk::identity(), cstk::translation(50, 0, 0)};
    const auto meet = batch.pair_within(body, poses, body, {cstk::identity(), cstk::identity()}, 0);
    REQUIRE(meet.values[0] == 1 && meet.values[1] == 0 && meet.first_failure.empty());
    REQUIRE(batch.pair_distance(body, poses, body, poses).values[1].distance == 0);
    std::vector<double> spoilt = points;
    spoilt[0] = std::nan("");
    const auto classes = batch.classify(obstacles, spoilt, 3, cstk::batch_options(1, true));
    REQUIRE(classes.done.failed == 1 && classes.statuses[0] == CSTK_ERROR_NOT_FINITE);
    REQUIRE(classes.first_failure.find("item 0") == 0);
    REQUIRE(status_of([&] { return batch.classify(obstacles, points, 3, cstk::batch_options(), stop); }) ==
            CSTK_ERROR_CANCELLED);
    REQUIRE(batch.statistics(true).primitive_pairs > 0);
    const std::vector<double> none;
    REQUIRE(batch.classify(obstacles, none, 0).values.empty() && batch.within(obstacles, none, 0, 0).statuses.empty());
    REQUIRE(batch.distance(obstacles, none, 0, 9, q.size()).gradients.empty());
    REQUIRE(batch.motion(obstacles, none, none, 0).done.answered == 0);
    const std::vector<cstk::Pose> nowhere;
    REQUIRE(batch.pair_within(body, nowhere, body, nowhere, 0).values.empty());
}
