#include "check.hpp"
#include "models.hpp"
#include "subjects.hpp"

#include <array>
#include <cmath>
#include <cstdint>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

/* Each primitive's extent is a closed form. */
static void bodies_of_one_call() {
    const cstk::Pose at = cstk::translation(5, 0, 0);
    const auto spans = [](const cstk::Body &body, std::array<double, 3> low, std::array<double, 3> high) {
        const cstk_body_statistics found = body.statistics();
        bool same = found.primitive_count == 1 && body.primitive(0).tag == 9;
        for (int axis = 0; axis < 3; axis++) {
            same = same && std::fabs(found.low[axis] - low[axis]) < 1e-9 && std::fabs(found.high[axis] - high[axis]) < 1e-9;
        }
        return same;
    };
    REQUIRE(spans(cstk::Body::polygon({0, 0, 0, 1, 0, 0, 0, 2, 0}, 2, 9), {0, 0, 0}, {1, 2, 0}));
    REQUIRE(spans(cstk::Body::polyhedron({0, 0, 0, 1, 0, 0, 0, 2, 0, 0, 0, 3}, 9), {0, 0, 0}, {1, 2, 3}));
    REQUIRE(spans(cstk::Body::sphere(1, {1, 2, 3}, 3, 9), {0, 1, 2}, {2, 3, 4}));
    REQUIRE(spans(cstk::Body::capsule({0, 0, 0}, {4, 0, 0}, 1, 3, 9), {-1, -1, -1}, {5, 1, 1}));
    REQUIRE(spans(cstk::Body::box({1, 2, 3}, at, 9), {4, -2, -3}, {6, 2, 3}));
    REQUIRE(spans(cstk::Body::cylinder(1, 3, at, 9), {4, -1, -3}, {6, 1, 3}));
    REQUIRE(spans(cstk::Body::cone(1, 3, at, 9), {4, -1, -1.5}, {6, 1, 1.5}));
    REQUIRE(spans(cstk::Body::ellipsoid({1, 2, 3}, at, 9), {4, -2, -3}, {6, 2, 3}));
    REQUIRE(cstk::Body::sphere(1, {0, 0, 0}, 2).statistics().high[2] == 0);
}

void bodies() {
    bodies_of_one_call();
    cstk::BodyBuilder builder;
    REQUIRE(status_of([&] { return builder.build(); }) == CSTK_ERROR_EMPTY);
    REQUIRE(status_of([] { cstk::BodyBuilder plane(4); }) == CSTK_ERROR_INVALID_ARGUMENT);
    const std::vector<double> triangle = {0, 0, 2, 1, 0, 2, 0, 1, 2};
    builder.add_polyhedron(cube, 7).add_polygon(triangle, 8);
    builder.add_triangles(triangle, std::vector<std::uint32_t>{0, 1, 2});
    const std::uint32_t sizes[] = {3};
    builder.add_mesh(triangle, sizes, std::vector<std::uint32_t>{0, 1, 2});
    cstk::Body body = builder.build();
    REQUIRE(body.statistics().primitive_count == 4);
    REQUIRE(body.feature_vertices(0, CSTK_FEATURE_FACE, 0).size() == 12);
    const cstk_primitive solid = body.primitive(0);
    REQUIRE(solid.kind == CSTK_PRIMITIVE_POLYHEDRON && solid.vertex_count == 8 && solid.tag == 7);
    REQUIRE(status_of([&] { return body.primitive(4); }) == CSTK_ERROR_NOT_FOUND);
    const cstk::Body twice =
        cstk::BodyBuilder().add_body(body, cstk::translation(9, 0, 0), 3).add_body(body).build();
    REQUIRE(twice.part(0).tag == 3 && twice.part(1).first_primitive == 4);
    REQUIRE(status_of([&] { return twice.part(2); }) == CSTK_ERROR_NOT_FOUND);
    std::vector<double> all = body.vertices();
    for (double &coordinate : all) {
        coordinate *= 2;
    }
    REQUIRE(body.refit(all).vertices() == all);
    REQUIRE(status_of([&] { return body.refit(std::vector<double>(3)); }) == CSTK_ERROR_WRONG_SIZE);
    REQUIRE(status_of([&] { return builder.add_mesh_file("/nowhere.obj"); }) == CSTK_ERROR_IO);
    REQUIRE(status_of([] { return cstk::Body::from_mesh_file("/nowhere.obj"); }) == CSTK_ERROR_IO);
    cstk::BodyBuilder placed;
    const cstk::BodyBuilder::Vector scale = {2, 3, -4};
    placed.add_triangles(triangle, std::vector<std::uint32_t>{0, 1, 2}, cstk::translation(5, 6, 7),
                         scale);
    placed.add_mesh(triangle, sizes, std::vector<std::uint32_t>{0, 1, 2}, cstk::identity(), scale);
    const cstk_body_statistics extent = placed.build().statistics();
    REQUIRE(extent.low[2] == -8 && extent.high[0] == 7 && extent.high[1] == 9);
    REQUIRE(status_of([&] { return placed.add_mesh_file("/nowhere.obj", cstk::identity(), scale); }) ==
            CSTK_ERROR_IO);

    builder.set_solid();
    REQUIRE(status_of([&] { return builder.build(); }) == CSTK_ERROR_NOT_CLOSED);
    builder.set_solid(false);

    const std::vector<double> sheet = {0, 0, 0, 0, 1, 0, 1, 0, 0, 1, 1, 0.5};
    const std::vector<double> factors = {1, 1, 1, 2};
    const cstk_body_statistics bent =
        cstk::BodyBuilder().add_bezier_patch(1, 1, sheet, 0.01, factors, 3).build().statistics();
    REQUIRE(bent.primitive_count > 2 && bent.deviation > 0 && bent.deviation <= 0.01);
    REQUIRE(status_of([&] { return cstk::BodyBuilder().add_bezier_patch(2, 1, sheet, 0.01); }) ==
            CSTK_ERROR_WRONG_SIZE);
    const std::vector<double> ends = {0, 0, 1, 1};
    const cstk_body_statistics whole = cstk::BodyBuilder()
                                           .add_nurbs_surface(1, 1, ends, ends, sheet, 0.01, factors, 3)
                                           .build()
                                           .statistics();
    REQUIRE(whole.primitive_count == bent.primitive_count);
    REQUIRE(status_of([&] {
                cstk::BodyBuilder().add_nurbs_surface(2, 1, ends, ends, sheet, 0.01);
            }) == CSTK_ERROR_WRONG_SIZE);
    bool refused = false;
    try {
        const std::vector<double> three(3, 1.0);
        cstk::BodyBuilder().add_nurbs_surface(1, 1, ends, ends, sheet, 0.01, three);
    } catch (const std::invalid_argument &) {
        refused = true;
    }
    REQUIRE(refused);
    builder.set_deviation(0.25);
    REQUIRE(builder.build().statistics().deviation == 0.25);
    REQUIRE(status_of([&] { return builder.set_deviation(-1); }) == CSTK_ERROR_INVALID_ARGUMENT);
    builder.set_deviation(0);

    int heard = 0;
    static_cast<void>(builder.build(cstk::hierarchy_options(), [&](double) { return ++heard > 0; }));
    REQUIRE(heard > 1);
    REQUIRE(status_of([&] {
                return builder.build(cstk::hierarchy_options(), [](double) { return false; });
            }) == CSTK_ERROR_CANCELLED);
    bool passed = false;
    try {
        static_cast<void>(builder.build(cstk::hierarchy_options(),
                                        [](double) -> bool { throw std::domain_error("mine"); }));
    } catch (const std::domain_error &error) {
        passed = std::string(error.what()) == "mine";
    }
    REQUIRE(passed);

    cstk::Body copy = body;
    cstk::Body moved = std::move(body);
    REQUIRE(!body && copy.get() == moved.get());
    copy = cstk::Body();
    REQUIRE(moved.statistics().primitive_count == 4);
}
