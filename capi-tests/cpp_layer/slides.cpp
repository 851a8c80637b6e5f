#include "check.hpp"
#include "models.hpp"
#include "subjects.hpp"

#include <cmath>
#include <vector>

void steps() {
    cstk::Body body = cstk::BodyBuilder().add_polyhedron(cube).build();
    cstk::RobotBuilder builder;
    cstk::Link link;
    link.joint = CSTK_JOINT_PRISMATIC;
    link.axis = {1, 0, 0};
    builder.add_link(link);
    link.axis = {0, 1, 0};
    link.parent = 0;
    link.body = body;
    builder.add_link(link);
    cstk::Space space(builder.build());
    cstk::Environment environment;
    environment.add(body, cstk::translation(0, -1.1, 0));
    cstk::CObject obstacle = cstk::CObject::induced(space, environment);
    cstk::Query query;
    const cstk_witness_list list = query.gradients(obstacle, {0, 0}, 0.5);
    const auto slide = cstk::slide_step(list, {1, -1}, 0.2);
    REQUIRE(slide && std::fabs((*slide)[0] - 1) < 1e-9 && std::fabs((*slide)[1]) < 1e-9);
    const auto longer = cstk::slide_step(list, {1, -1}, 0.2, true);
    REQUIRE(longer && std::fabs((*longer)[0] - std::sqrt(2.0)) < 1e-9);
    REQUIRE(!cstk::slide_step(list, {0, -1}, 0.2));
    const auto spring = cstk::spring_step(list, 0.2);
    REQUIRE(spring && std::fabs((*spring)[0]) < 1e-9 && std::fabs((*spring)[1] - 0.1) < 1e-9);
    REQUIRE(!cstk::spring_step(list, 0.05));
    REQUIRE(status_of([&] { return cstk::slide_step(list, {1}, 0.2); }) == CSTK_ERROR_WRONG_SIZE);
    REQUIRE(status_of([&] { return cstk::spring_step(list, -1); }) == CSTK_ERROR_INVALID_ARGUMENT);
    const cstk_witness_list without = query.witnesses(obstacle, {0, 0}, 0.5);
    REQUIRE(status_of([&] { return cstk::spring_step(without, 0.2); }) == CSTK_ERROR_INVALID_ARGUMENT);
}

void slides(cstk::Query &query, const cstk::CObject &obstacles, const std::vector<double> &q) {
    std::vector<double> moving = q;
    const cstk_slide_result moved =
        query.slide(obstacles, moving, std::vector<double>{0.1, 0}, cstk::slide_options(0.5));
    REQUIRE(moved.outcome == CSTK_SLIDE_MOVED && std::fabs(moving[0] - 0.6) < 1e-15);

    const std::vector<double> far = {q[0] + 100, q[1]};
    const std::vector<double> near = {q[0] + 0.25, q[1]};
    const auto stop = [](double) { return false; };
    const auto slide = cstk::slide_options(0.5);
    const auto steps = cstk::slide_to_options(0.1);
    const cstk_slide_to_result led = query.slide_to(obstacles, q, near, slide, steps);
    REQUIRE(led.outcome == CSTK_SLIDE_TO_ARRIVED && led.path.count == 2 && led.remaining == 0);
    const cstk_slide_to_result held = query.slide_to(obstacles, q, far, far, slide, steps, {1, 2});
    REQUIRE(held.outcome != CSTK_SLIDE_TO_ARRIVED && held.remaining > 0);
    REQUIRE(is_invalid([&] { return query.slide_to(obstacles, q, {1}, slide, steps); }));
    REQUIRE(status_of([&] { return query.slide_to(obstacles, q, far, far, slide, steps, {}, stop); }) ==
            CSTK_ERROR_CANCELLED);
}
