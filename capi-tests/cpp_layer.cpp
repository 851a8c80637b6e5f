// The C++ layer: every class and call once, exceptions both ways, copies and moves.
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <stdexcept>
#include <string>
#include <cstk.hpp>

static void require(bool condition, const char *what) {
    if (!condition) {
        std::fprintf(stderr, "failed: %s\n", what);
        std::exit(1);
    }
}

#define REQUIRE(condition) require(condition, #condition)

template <typename Action> static cstk_status status_of(Action action) {
    try {
        action();
    } catch (const cstk::Error &error) {
        REQUIRE(std::string(error.what()).find(": ") != std::string::npos);
        return error.status();
    }
    return CSTK_OK;
}

/// The layer itself refuses what it could not hand on.
template <typename Action> static bool is_invalid(Action action) {
    try {
        action();
    } catch (const std::invalid_argument &) {
        return true;
    }
    return false;
}

static const double cube[] = {0, 0, 0, 1, 0, 0, 1, 1, 0, 0, 1, 0,
                              0, 0, 1, 1, 0, 1, 1, 1, 1, 0, 1, 1};

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

static void bodies() {
    bodies_of_one_call();
    cstk::BodyBuilder builder;
    REQUIRE(status_of([&] { builder.build(); }) == CSTK_ERROR_EMPTY);
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
    REQUIRE(status_of([&] { body.primitive(4); }) == CSTK_ERROR_NOT_FOUND);
    const cstk::Body twice =
        cstk::BodyBuilder().add_body(body, cstk::translation(9, 0, 0), 3).add_body(body).build();
    REQUIRE(twice.part(0).tag == 3 && twice.part(1).first_primitive == 4);
    REQUIRE(status_of([&] { twice.part(2); }) == CSTK_ERROR_NOT_FOUND);
    std::vector<double> all = body.vertices();
    for (double &coordinate : all) {
        coordinate *= 2;
    }
    REQUIRE(body.refit(all).vertices() == all);
    REQUIRE(status_of([&] { body.refit(std::vector<double>(3)); }) == CSTK_ERROR_WRONG_SIZE);
    REQUIRE(status_of([&] { builder.add_mesh_file("/nowhere.obj"); }) == CSTK_ERROR_IO);
    cstk::BodyBuilder placed;
    const cstk::BodyBuilder::Vector scale = {2, 3, -4};
    placed.add_triangles(triangle, std::vector<std::uint32_t>{0, 1, 2}, cstk::translation(5, 6, 7),
                         scale);
    placed.add_mesh(triangle, sizes, std::vector<std::uint32_t>{0, 1, 2}, cstk::identity(), scale);
    const cstk_body_statistics extent = placed.build().statistics();
    REQUIRE(extent.low[2] == -8 && extent.high[0] == 7 && extent.high[1] == 9);
    REQUIRE(status_of([&] { placed.add_mesh_file("/nowhere.obj", cstk::identity(), scale); }) ==
            CSTK_ERROR_IO);

    builder.set_solid();
    REQUIRE(status_of([&] { builder.build(); }) == CSTK_ERROR_NOT_CLOSED);
    builder.set_solid(false);

    const std::vector<double> sheet = {0, 0, 0, 0, 1, 0, 1, 0, 0, 1, 1, 0.5};
    const std::vector<double> factors = {1, 1, 1, 2};
    const cstk_body_statistics bent =
        cstk::BodyBuilder().add_bezier_patch(1, 1, sheet, 0.01, factors, 3).build().statistics();
    REQUIRE(bent.primitive_count > 2 && bent.deviation > 0 && bent.deviation <= 0.01);
    REQUIRE(status_of([&] { cstk::BodyBuilder().add_bezier_patch(2, 1, sheet, 0.01); }) ==
            CSTK_ERROR_WRONG_SIZE);
    builder.set_deviation(0.25);
    REQUIRE(builder.build().statistics().deviation == 0.25);
    REQUIRE(status_of([&] { builder.set_deviation(-1); }) == CSTK_ERROR_INVALID_ARGUMENT);
    builder.set_deviation(0);

    int heard = 0;
    builder.build(cstk::hierarchy_options(), [&](double) { return ++heard > 0; });
    REQUIRE(heard > 1);
    REQUIRE(status_of([&] {
                builder.build(cstk::hierarchy_options(), [](double) { return false; });
            }) == CSTK_ERROR_CANCELLED);
    bool passed = false;
    try {
        builder.build(cstk::hierarchy_options(),
                      [](double) -> bool { throw std::domain_error("mine"); });
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

static void octrees() {
    cstk::Octree octree(0.5);
    const std::vector<double> cells = {0.1, 0.1, 0.1, 5.1, 0.1, 0.1};
    REQUIRE(octree.set(cells) == 2 && octree.set(cells) == 0 && octree.cell_count() == 2);
    REQUIRE(octree.get_cell({5.4, 0, 0}) && !octree.get_cell({5.6, 0, 0}) && octree.resolution() == 0.5);
    REQUIRE(octree.cubes() == std::vector<double>({0, 0, 0, 0.5, 5, 0, 0, 0.5}));
    REQUIRE(octree.build_body().statistics().primitive_count == 2);
    cstk::Environment world;
    octree.place(world, cstk::translation(1, 0, 0));
    REQUIRE(world.object_count() == 2 && octree.object_count() == 2 && world.version() == 1);
    octree.set(cells, false);
    REQUIRE(world.object_count() == 0);
    cstk::Octree other(0.5);
    other.set(cells);
    octree.insert(other);
    octree.move(cstk::identity());
    REQUIRE(world.object_count() == 2);
    octree.remove();
    REQUIRE(world.object_count() == 0 && octree.cell_count() == 2);
    REQUIRE(status_of([&] { octree.move(cstk::identity()); }) == CSTK_ERROR_NOT_FOUND);
    REQUIRE(status_of([] { cstk::Octree::load("/nowhere.bt"); }) == CSTK_ERROR_IO);
    REQUIRE(status_of([] { cstk::BodyBuilder().add_cloud_file("/nowhere.pcd", 0.1); }) == CSTK_ERROR_IO);
}

static void hierarchies() {
    const std::vector<double> triangle = {0, 0, 2, 1, 0, 2, 0, 1, 2};
    cstk::BodyBuilder builder;
    builder.add_polyhedron(cube, 7).add_polygon(triangle, 8).add_polyhedron(triangle, 9);
    cstk_hierarchy_options options = cstk::hierarchy_options();
    options.wrapper = CSTK_WRAPPER_ALIGNED_BOX;
    cstk::Body body = builder.build(options);
    const cstk_hierarchy_statistics statistics = body.hierarchy_statistics();
    REQUIRE(statistics.wrapper == CSTK_WRAPPER_ALIGNED_BOX);
    REQUIRE(statistics.node_count == 5 && statistics.leaf_count == 3 && statistics.depth == 3);
    REQUIRE(body.level_nodes(0) == std::vector<std::uint32_t>{0});
    REQUIRE(body.level_nodes(2).size() == 3 && body.level_statistics(2).leaves_above == 1);
    REQUIRE(std::fabs(body.level_statistics(0).volume - 2.0) < 1e-14);
    REQUIRE(status_of([&] { body.level_nodes(3); }) == CSTK_ERROR_NOT_FOUND);
    REQUIRE(status_of([&] { body.level_statistics(3); }) == CSTK_ERROR_NOT_FOUND);

    REQUIRE(body.cover_nodes(1) == body.level_nodes(0) && body.cover_nodes(2).size() == 2);
    REQUIRE(body.cover_nodes(SIZE_MAX) == body.level_nodes(2));
    REQUIRE(status_of([&] { body.cover_nodes(0); }) == CSTK_ERROR_INVALID_ARGUMENT);
    const cstk_hierarchy_node root = body.node(0);
    REQUIRE(root.children[0] == 1 && root.primitive == UINT32_MAX && root.corner_count == 8);
    REQUIRE(root.center[0] == 0.5 && root.center[1] == 0.5 && root.center[2] == 1.0);
    REQUIRE(body.node_corners(0).size() == 24);
    REQUIRE(status_of([&] { body.node(5); }) == CSTK_ERROR_NOT_FOUND);
    REQUIRE(status_of([&] { body.node_corners(5); }) == CSTK_ERROR_NOT_FOUND);

    const char *picture = "cpp_layer_nodes.glb";
    body.show_nodes(body.level_nodes(1), picture);
    REQUIRE(std::remove(picture) == 0);
    REQUIRE(status_of([&] { body.show_nodes({0}, "/nowhere/x.glb"); }) == CSTK_ERROR_IO);
    REQUIRE(status_of([&] { body.mesh_of_nodes({0, 5}); }) == CSTK_ERROR_NOT_FOUND);
    cstk::Mesh mesh = body.mesh_of_nodes({0});
    cstk::Mesh copy = mesh;

    const char *file = "cpp_layer.cstk";
    body.save(file);
    cstk::Body loaded = cstk::Body::load(file);
    REQUIRE(std::remove(file) == 0);
    REQUIRE(status_of([&] { cstk::Body::load(file); }) == CSTK_ERROR_IO);
    REQUIRE(status_of([&] { body.save("/nowhere/x"); }) == CSTK_ERROR_IO);
    REQUIRE(loaded.get() != body.get() && loaded.statistics().primitive_count == 3);
    REQUIRE(loaded.node_corners(0) == body.node_corners(0));

    /* The mesh outlives the body it was made of. */
    body = cstk::Body();
    mesh = cstk::Mesh();
    const cstk_mesh_view view = copy.view();
    REQUIRE(!mesh && view.vertex_count == 8 && view.face_count == 6 && view.index_count == 24);
    for (std::size_t i = 0; i < view.vertex_count; ++i) {
        REQUIRE(view.vertices[3 * i + 2] == 0.0 || view.vertices[3 * i + 2] == 2.0);
    }
}

static void poses() {
    const std::array<double, 6> placement = {1, 2, 3, 0.1, 0.2, 0.3};
    const std::array<double, 6> again = cstk::pose_to_euler(cstk::pose_from_euler(placement));
    for (int i = 0; i < 6; ++i) {
        REQUIRE(std::fabs(placement[i] - again[i]) < 1e-14);
    }
    REQUIRE(cstk::pose_from_quaternion({1, 2, 3, 0, 0, 0, 1}) == cstk::translation(1, 2, 3));
    REQUIRE(cstk::compose(cstk::translation(1, 2, 3), cstk::translation(1, 0, 0)) ==
            cstk::translation(2, 2, 3));
    REQUIRE(cstk::pose_inverse(cstk::translation(1, 2, 3)) == cstk::translation(-1, -2, -3));
    const std::array<double, 3> point = {3, 2, 1};
    REQUIRE((cstk::transform_point(cstk::translation(1, 2, 3), point) ==
             std::array<double, 3>{4, 4, 4}));
    REQUIRE((cstk::pose_to_quaternion(cstk::translation(1, 2, 3)) ==
             std::array<double, 7>{1, 2, 3, 0, 0, 0, 1}));
    cstk::Pose sheared = cstk::identity();
    sheared[1] = 0.5;
    REQUIRE(status_of([&] { cstk::pose_inverse(sheared); }) == CSTK_ERROR_NOT_A_ROTATION);
    REQUIRE(status_of([&] { cstk::pose_to_quaternion(sheared); }) == CSTK_ERROR_NOT_A_ROTATION);
    REQUIRE(status_of([&] { cstk::transform_point(sheared, point); }) == CSTK_ERROR_NOT_A_ROTATION);
}

static void euler_angles() {
    const std::array<double, 3> angles = {0.1, 0.2, 0.3};
    const std::array<double, 3> again = cstk::euler_from_rotation(cstk::euler_to_rotation(angles));
    const cstk::Matrix3 body = cstk::euler_rates(angles, CSTK_ANGULAR_BODY);
    const cstk::Matrix3 inverse = cstk::euler_rates_inverse(angles, CSTK_ANGULAR_BODY);
    REQUIRE(cstk::euler_rates(angles) == cstk::euler_rates(angles, CSTK_ANGULAR_WORLD));
    REQUIRE(cstk::euler_rates(angles) != body && cstk::euler_rates_inverse(angles) != inverse);
    for (std::size_t i = 0; i < 3; ++i) {
        REQUIRE(std::fabs(angles[i] - again[i]) < 1e-15);
        double product = 0;
        for (std::size_t k = 0; k < 3; ++k) {
            product += body[3 * i + k] * inverse[3 * k + i];
        }
        REQUIRE(std::fabs(product - 1) < 1e-15);
    }
    const std::vector<double> basic = {1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12};
    const std::vector<double> back =
        cstk::jacobian_from_euler(angles, cstk::jacobian_to_euler(angles, basic));
    for (std::size_t i = 0; i < 12; ++i) {
        REQUIRE(std::fabs(basic[i] - back[i]) < 1e-13);
    }
    const std::array<double, 3> singular = {0, std::acos(0.0), 0};
    REQUIRE(status_of([&] { cstk::euler_rates_inverse(singular); }) == CSTK_ERROR_DEGENERATE);
    REQUIRE(status_of([&] { cstk::jacobian_to_euler(singular, basic); }) == CSTK_ERROR_DEGENERATE);
    REQUIRE(is_invalid([&] { cstk::jacobian_to_euler(angles, {1, 2, 3}); }));
}

/* A cube on a rail that meets another 2.5 ahead of q. */
static void motions(const cstk::Query &query, const cstk::CObject &obstacles, const cstk::Body &body,
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
    cstk_motion_result result;
    const auto any = cstk::motion_options();
    REQUIRE(!query.motion_certificate(obstacles, q, far, any, &result, &reached));
    REQUIRE(result.outcome == CSTK_MOTION_HIT && reached.size() == q.size());
    const std::vector<double> near = {q[0] + 0.25, q[1]};
    cstk::Certificate proof = query.motion_certificate(obstacles, q, near);
    proof.verify(obstacles, q, near);
    REQUIRE(status_of([&] { proof.verify(obstacles, q, q); }) == CSTK_ERROR_NOT_PROVED);
    proof.save("cpp_layer.certificate");
    proof = cstk::Certificate::load("cpp_layer.certificate");
    REQUIRE(std::remove("cpp_layer.certificate") == 0);
    proof.verify(obstacles, q, near);
    REQUIRE(proof.ends().first == q && proof.ends().second == near);
    REQUIRE(proof.summary().entry_count > 0 && proof.entry(0).times[0] == 0.0);
    REQUIRE(proof.primitives(0, 1).size() == proof.entry(0).primitive_counts[1]);
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
                query.motion_path(obstacles, points, 3, cstk::motion_options(), stop);
            }) == CSTK_ERROR_CANCELLED);
    const cstk_clearance_result nearest =
        query.motion_clearance(obstacles, q, q, cstk::clearance_options(1e-6), &reached);
    REQUIRE(nearest.outcome == CSTK_CLEARANCE_KNOWN && reached == q);
    REQUIRE(nearest.lower <= 2.5 && nearest.upper >= nearest.lower);
    const std::vector<double> still = {q[0], q[1], q[0], q[1]};
    const cstk_path_clearance_result along =
        query.path_clearance(obstacles, still, 2, cstk::clearance_options(1e-6), {}, &reached);
    REQUIRE(along.segment == 0 && reached == q && along.clearance.upper == nearest.upper);
    REQUIRE(status_of([&] {
                query.path_clearance(obstacles, still, 2, cstk::clearance_options(1e-6), stop);
            }) == CSTK_ERROR_CANCELLED);
    const std::vector<double> detour = {q[0], q[1], q[0], q[1] + 3, near[0], near[1]};
    const cstk_shortcut_result shorter = query.path_shortcut(obstacles, detour, 3);
    REQUIRE(shorter.outcome == CSTK_SHORTCUT_DONE && shorter.path.count == 2 && shorter.cuts == 1);
    REQUIRE(shorter.path.nq == 2 && shorter.path.points[2] == near[0]);
    REQUIRE(std::fabs(shorter.length_after - 0.25) < 1e-12);
    const auto none = cstk::shortcut_options(0);
    REQUIRE(query.path_shortcut(obstacles, points, 3, none).outcome == CSTK_SHORTCUT_NOT_FREE);
    REQUIRE(status_of([&] { query.path_shortcut(obstacles, detour, 3, none, stop); }) ==
            CSTK_ERROR_CANCELLED);
    const auto slide = cstk::slide_options(0.5);
    const auto steps = cstk::slide_to_options(0.1);
    const cstk_slide_to_result led = query.slide_to(obstacles, q, near, slide, steps);
    REQUIRE(led.outcome == CSTK_SLIDE_TO_ARRIVED && led.path.count == 2 && led.remaining == 0);
    const cstk_slide_to_result held = query.slide_to(obstacles, q, far, far, slide, steps, {1, 2});
    REQUIRE(held.outcome != CSTK_SLIDE_TO_ARRIVED && held.remaining > 0);
    REQUIRE(is_invalid([&] { query.slide_to(obstacles, q, {1}, slide, steps); }));
    REQUIRE(status_of([&] { query.slide_to(obstacles, q, far, far, slide, steps, {}, stop); }) ==
            CSTK_ERROR_CANCELLED);

    const std::vector<double> curve = {q[0], q[1], q[0] + 1, q[1], q[0], q[1]};
    REQUIRE(query.motion_curve(obstacles, curve, 3).outcome == CSTK_MOTION_FREE);
    const std::vector<double> knots = {0, 0, 1, 1}, line = {q[0], q[1], q[0] + 100, q[1]};
    const auto options = cstk::motion_options();
    const cstk_motion_result spline =
        query.motion_spline(obstacles, 1, knots, line, 2, options, &reached);
    REQUIRE(spline.outcome == CSTK_MOTION_HIT && std::fabs(reached[0] - 3) < 1e-3);
    REQUIRE(is_invalid([&] { query.motion_curve(obstacles, {1, 2, 3}, 2); }));
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
    REQUIRE(status_of([&] { query.motion_function(obstacles, swing, slow, accelerations); }) ==
            CSTK_ERROR_INVALID_ARGUMENT);
    passed = false;
    try {
        query.motion_function(obstacles, [](double, double *, double *, double *) { throw 7; }, rates,
                              accelerations);
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

    const std::vector<double> low = {-1, -1}, high = {2.9, 1}, beyond = {3.5, 1};
    REQUIRE(query.region_classify(obstacles, low, high).outcome == CSTK_REGION_FREE);
    std::vector<double> inside, outside;
    const cstk_region_result mixed = query.region_classify(obstacles, low, beyond,
                                                           cstk::region_options(), &inside, &outside);
    REQUIRE(mixed.outcome == CSTK_REGION_MIXED && inside.size() == 2 && outside.size() == 2);
    REQUIRE(query.classify(obstacles, inside) == CSTK_CLASS_INSIDE);
    REQUIRE(query.classify(obstacles, outside) != CSTK_CLASS_INSIDE);
    const cstk::GrownRegion grown = query.region_grow(obstacles, q, std::vector<double>{1, 1});
    REQUIRE(grown.low[0] < q[0] && grown.high[0] > 2.9 && grown.high[0] < 3 + 1e-9);
    REQUIRE(grown.sides.size() == 4);
}

static void batches(const cstk::Query &query, const cstk::CObject &obstacles, const cstk::Body &body,
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
    REQUIRE(status_of([&] { batch.classify(obstacles, points, 3, cstk::batch_options(), stop); }) ==
            CSTK_ERROR_CANCELLED);
    REQUIRE(batch.statistics(true).primitive_pairs > 0);
    const std::vector<double> none;
    REQUIRE(batch.classify(obstacles, none, 0).values.empty() && batch.within(obstacles, none, 0, 0).statuses.empty());
    REQUIRE(batch.distance(obstacles, none, 0, 9, q.size()).gradients.empty());
    REQUIRE(batch.motion(obstacles, none, none, 0).done.answered == 0);
    const std::vector<cstk::Pose> nowhere;
    REQUIRE(batch.pair_within(body, nowhere, body, nowhere, 0).values.empty());
}

static void maps(const cstk::Query &query, const cstk::CObject &obstacles, const std::vector<double> &q) {
    const auto stop = [](double) { return false; };
    const cstk::Map map = cstk::Map::build(obstacles, q, {cstk::map_axis(0, 0, 10, 10)});
    REQUIRE(map.view().cell_count == 10 && map.view().values[4] == CSTK_CLASS_INSIDE);
    REQUIRE(map.view().values[0] == query.classify(obstacles, std::vector<double>{0.5, q[1]}));
    const cstk::Map part = cstk::Map::build(obstacles, q, {cstk::map_axis(0, 0, 10, 10, 4, 2)});
    REQUIRE(part.view().cell_count == 2 && part.view().values[0] == map.view().values[4]);
    map.save("cpp_layer.npy");
    REQUIRE(std::remove("cpp_layer.npy") == 0);
    REQUIRE(status_of([&] { map.show("cpp_layer.png"); }) == CSTK_ERROR_UNSUPPORTED);
    REQUIRE(status_of([&] {
                cstk::Map::build(obstacles, q, {cstk::map_axis(0, 0, 1, 9)}, cstk::map_options(), stop);
            }) == CSTK_ERROR_CANCELLED);
}

static void object_pairs(const cstk::Query &query, const cstk::Body &body) {
    cstk::Environment world, other;
    const std::uint64_t near = world.add(body, cstk::identity());
    const std::uint64_t far = world.add(body, cstk::translation(3, 0, 0));
    const std::uint64_t third = other.add(body, cstk::translation(0.5, 0, 0));
    REQUIRE(query.environment_pairs(world, nullptr, 1.9).count == 0);
    const cstk_object_pair_list two =
        query.environment_pairs(world, nullptr, 2.0, 9, cstk::object_pair_options(true));
    REQUIRE(two.count == 1 && two.pairs[0].r_object == near && two.pairs[0].s_object == far);
    REQUIRE(two.distances[0].distance == 2.0 && two.pairs[0].pair_class == CSTK_CLASS_CONTACT);
    REQUIRE(query.environment_within(world, &other, 0) && !query.environment_within(world, nullptr, 0));
    REQUIRE(query.environment_distance(world, nullptr).distance == 2.0);
    REQUIRE(query.environment_distance(world, &other).witness.s_object == third);
    REQUIRE(query.environment_witnesses(world, nullptr, 2.0).contact_count == 4);
    const auto not_near = [&](std::uint64_t r, std::uint64_t, void *, void *) { return r != near; };
    REQUIRE(query.filtered_pairs(world, &other, 9, not_near).count == 1);
    const auto thrower = [](std::uint64_t, std::uint64_t, void *, void *) -> bool {
        throw std::runtime_error("out of the filter");
    };
    std::string thrown;
    try {
        query.filtered_pairs(world, &other, 9, thrower);
    } catch (const std::runtime_error &error) {
        thrown = error.what();
    }
    REQUIRE(thrown == "out of the filter");
}

static void queries() {
    cstk::Body body = cstk::BodyBuilder().add_polyhedron(cube).build();
    cstk::RobotBuilder builder;
    cstk::Link slider;
    slider.name = "slider";
    slider.body = body;
    slider.joint = CSTK_JOINT_PRISMATIC;
    slider.axis = {1, 0, 0};
    builder.add_link(slider);
    cstk::Link arm;
    arm.body = body;
    arm.parent = 0;
    arm.joint = CSTK_JOINT_REVOLUTE;
    arm.at = cstk::translation(0, 3, 0);
    builder.add_link(arm);
    cstk::Robot robot = builder.build();
    REQUIRE(robot.nq() == 2 && robot.link_count() == 2 && robot.find_link("link1") == 1);
    REQUIRE(robot.body(1).statistics().primitive_count == 1);
    const std::vector<double> q = {0.5, 0.0};
    REQUIRE(robot.link_pose(q, 1) == cstk::translation(0.5, 3, 0));
    REQUIRE(robot.jacobian(q, 1, {1, 0, 0})[0] == 1.0);

    const cstk_range ranges[] = {cstk::interval(-10, 10), cstk::circle()};
    cstk::Space space;
    REQUIRE(!space);
    space = cstk::Space({robot}, ranges);
    REQUIRE(space.nq() == 2 && space.nv() == 2 && space.link_count() == 2);
    REQUIRE(space.contains(q) && !space.contains(std::vector<double>{11, 0}));

    cstk::Environment environment;
    const std::uint64_t id = environment.add(body, cstk::translation(5, 0, 0));
    cstk::Environment before = environment.snapshot();
    environment.move(id, cstk::translation(4, 0, 0));
    REQUIRE(environment.object_count() == 1 && environment.version() == 2);
    REQUIRE(environment.object_pose(id) == cstk::translation(4, 0, 0));
    REQUIRE(status_of([&] { before.remove(id); }) == CSTK_ERROR_UNSUPPORTED);

    cstk::CObject obstacles = cstk::CObject::induced(space, environment, cstk::induced_options(3));
    cstk::CObject self = cstk::CObject::induced_links(space, {{0, 1}});
    cstk::CObject all = cstk::CObject::union_of({obstacles, self});
    cstk::Query query;
    REQUIRE(query.distance(obstacles, q).distance == 2.5);
    REQUIRE(query.distance(self, q).distance == 2.0);
    REQUIRE(query.distance(all, q).distance == 2.0);
    REQUIRE(query.distance(all, {0, 0}).distance == 2.0);
    REQUIRE(query.distance(all, q, 1.0).kind == CSTK_DISTANCE_BEYOND_MAX);
    REQUIRE(query.classify(all, q) == CSTK_CLASS_CONTACT);
    REQUIRE(query.within(all, q, 2.0) && !query.within(all, q, 1.9));
    REQUIRE(query.witnesses(all, q, 2.6).witness_count == 2);
    const cstk_witness_list list = query.gradients(obstacles, q, 2.6);
    REQUIRE(list.contact_count == 4 && list.nv == 2 && list.gradients[0] == -1.0);
    const cstk_pseudo_normal_result everything = query.pseudo_normal(all, q, 2.6);
    REQUIRE(everything.point_class == CSTK_CLASS_CONTACT && everything.list.witness_count == 2);

    const std::vector<cstk::Pose> links = {robot.link_pose(q, 0), robot.link_pose(q, 1)};
    REQUIRE(query.classify_at_link_poses(all, links) == CSTK_CLASS_CONTACT);
    REQUIRE(query.within_at_link_poses(all, links, 2.0));
    REQUIRE(query.distance_at_link_poses(all, links).distance == 2.0);
    REQUIRE(query.witnesses_at_link_poses(all, links, 2.6).witness_count == 2);

    std::vector<double> moving = q;
    const cstk_slide_result slide =
        query.slide(obstacles, moving, std::vector<double>{0.1, 0}, cstk::slide_options(0.5));
    REQUIRE(slide.outcome == CSTK_SLIDE_MOVED && std::fabs(moving[0] - 0.6) < 1e-15);
    motions(query, obstacles, body, q);
    batches(query, obstacles, body, q);
    maps(query, obstacles, q);
    REQUIRE(query.statistics(true).primitive_pairs > 0);
    REQUIRE(query.statistics().primitive_pairs == 0);
    query.set_limit(1);
    REQUIRE(status_of([&] { query.witnesses(all, q, 2.6); }) == CSTK_ERROR_LIMIT);
    query.set_limit(0);
    REQUIRE(query.witnesses(all, q, 2.6).witness_count == 2);
    const cstk_query_statistics done = query.statistics(true);
    REQUIRE(done.primitive_distances <= done.primitive_pairs);

    const cstk::Pose here = cstk::identity(), there = cstk::translation(3, 0, 0);
    REQUIRE(query.pair_distance(body, here, body, there).distance == 2.0);
    REQUIRE(query.pair_within(body, here, body, there, 2.0));
    REQUIRE(query.pair_witnesses(body, here, body, there, 2.0).contact_count == 4);
    REQUIRE(query.pair_penetration(body, here, body, there).count == 0);
    REQUIRE(query.pair_penetration(body, here, body, here, 1).count == 1);
    REQUIRE(!query.pair_depth(body, here, body, there).meet);
    const cstk_depth_result deep = query.pair_depth(body, here, body, here, cstk::depth_options(1e-3, 100));
    REQUIRE(deep.meet && deep.tight && deep.lower <= deep.upper && deep.steps <= 100);
    REQUIRE(query.signed_distances(all, q, 2.6).count > 0);
    REQUIRE(status_of([&] { query.signed_distances(all, q, -1.0); }) == CSTK_ERROR_INVALID_ARGUMENT);
    REQUIRE(status_of([&] { query.pair_within(body, here, body, there, -1.0); }) ==
            CSTK_ERROR_INVALID_ARGUMENT);
    object_pairs(query, body);
    const char *file = "cpp_layer.glb";
    std::vector<double> both = q;
    both.insert(both.end(), q.begin(), q.end());
    all.show_path(both, 2, 1, file);
    REQUIRE(status_of([&] { all.show_path(both, 2, 0, file); }) == CSTK_ERROR_INVALID_ARGUMENT);
    all.show(q, file);
    REQUIRE(std::remove(file) == 0);
    REQUIRE(status_of([&] { all.show(q, "/nowhere/x.glb"); }) == CSTK_ERROR_IO);
}

static std::int32_t turn(const double *q, std::size_t, double *pose, void *calls) {
    ++*static_cast<int *>(calls);
    const double c = std::cos(q[0]), s = std::sin(q[0]);
    const cstk::Pose turned = {c, -s, 0, 0, s, c, 0, 0, 0, 0, 1, 0};
    std::copy(turned.begin(), turned.end(), pose);
    return CSTK_OK;
}

static std::int32_t turning(const double *, std::size_t, double *jacobian, void *) {
    std::fill_n(jacobian, 5, 0.0);
    jacobian[5] = 1;
    return CSTK_OK;
}

/// A sliding joint, one that mimics it, one that moves freely, and one of the caller's.
static cstk::Robot make_robot(int &calls) {
    cstk::RobotBuilder builder;
    cstk::Link link;
    link.joint = CSTK_JOINT_PRISMATIC;
    link.joint_name = "rail";
    link.lower = -1;
    link.upper = 2;
    builder.add_link(link);
    link.joint_name = "";
    link.coordinate = 0;
    link.multiplier = -1;
    link.offset = 0.5;
    builder.add_link(link);
    cstk::Link drone;
    drone.name = "drone";
    drone.joint = CSTK_JOINT_FREE;
    builder.add_link(drone);
    cstk_custom_joint joint = cstk::custom_joint();
    joint.pose = turn;
    joint.jacobian = turning;
    joint.user = &calls;
    cstk::Link wrist;
    wrist.joint = CSTK_JOINT_CUSTOM;
    REQUIRE(status_of([&] { builder.add_link(wrist); }) == CSTK_ERROR_NULL_ARGUMENT);
    wrist.custom = &joint;
    REQUIRE(builder.add_link(wrist) == 3);
    return builder.build();
}

static void robots() {
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
    REQUIRE(status_of([&] { robot.find_joint("none"); }) == CSTK_ERROR_NOT_FOUND);
    REQUIRE(status_of([&] { robot.link_info(4); }) == CSTK_ERROR_NOT_FOUND);
    REQUIRE(status_of([&] { robot.link_name(4); }) == CSTK_ERROR_NOT_FOUND);
    REQUIRE(status_of([&] { robot.joint_name(4); }) == CSTK_ERROR_NOT_FOUND);
    REQUIRE(calls == 0);
}

static void spaces() {
    int calls = 0;
    const cstk::Robot robot = make_robot(calls);
    std::vector<cstk_range> ranges(9, cstk::default_range());
    for (std::size_t i = 1; i < 4; ++i) {
        ranges[i] = cstk::interval(-1, 1);
    }
    ranges[8] = cstk::circle();
    std::vector<cstk_range> twice = ranges;
    twice.insert(twice.end(), ranges.begin(), ranges.end());
    const cstk::Space space({robot, robot}, twice, {-5, -5, -5, 5, 5, 5});
    REQUIRE(space.range(0).kind == CSTK_RANGE_INTERVAL && space.range(0).upper == 2);
    REQUIRE(space.range(4).kind == CSTK_RANGE_QUATERNION);
    REQUIRE(space.range(8).kind == CSTK_RANGE_CIRCLE);
    const cstk_space_offset offset = space.offset(1);
    REQUIRE(offset.link == 4 && offset.coordinate == 9 && offset.velocity == 8);
    REQUIRE(status_of([&] { space.range(18); }) == CSTK_ERROR_NOT_FOUND);
    REQUIRE(status_of([&] { space.offset(2); }) == CSTK_ERROR_NOT_FOUND);

    std::vector<double> q = space.neutral();
    REQUIRE(q.size() == 18 && q[7] == 1 && q[16] == 1 && q[0] == 0);
    REQUIRE(space.link_poses(q).size() == 8 && calls == 2);
    REQUIRE(space.link_poses(q)[1] == cstk::translation(0, 0, 0.5));
    REQUIRE(space.link_poses(q)[5] == robot.link_pose({q.data() + 9, 9}, 1));
    REQUIRE(space.jacobian(q, 1, {0, 0, 0})[2 * space.nv()] == -1);

    std::uint64_t state = 5, again = 5;
    const std::vector<double> q0 = space.sample(state);
    const std::vector<double> q1 = space.sample(state);
    REQUIRE(q0 == space.sample(again) && q0 != q1 && space.within_limits(q0));
    const std::vector<double> way = space.difference(q0, q1);
    REQUIRE(way.size() == 16);
    REQUIRE(space.distance(space.step(q0, way), q1) < 1e-14);
    REQUIRE(space.distance(space.interpolate(q0, q1, 1), q1) < 1e-14);
    std::vector<double> weights(16, 2.0);
    REQUIRE(std::fabs(space.distance(q0, q1, weights) - 2 * space.distance(q0, q1)) < 1e-14);
    std::vector<double> both = q0;
    both.insert(both.end(), q1.begin(), q1.end());
    const std::vector<double> one_by_one = {space.distance(q1, q0), space.distance(q1, q1)};
    REQUIRE(space.distances(q1, both) == one_by_one && space.distances(q1, {}).empty());

    std::uint32_t first = 0;
    q[0] = 7;
    REQUIRE(!space.within_limits(q, &first) && first == 0);
    REQUIRE(!space.within_world(q, &first) && first == 0 && !space.within_world(q));
    REQUIRE(space.clamp(q)[0] == 2 && space.within_limits(space.clamp(q), &first));
    REQUIRE(first == CSTK_NONE);
    q[8] = -1;
    REQUIRE(space.wrap(q)[8] > 5 && space.wrap(q)[0] == 7);

    const std::vector<double> shorter(17);
    REQUIRE(is_invalid([&] { space.difference(q, shorter); }));
    REQUIRE(is_invalid([&] { space.interpolate(shorter, q, 0.5); }));
    REQUIRE(is_invalid([&] { space.distance(q, shorter); }));
    REQUIRE(is_invalid([&] { space.distance(q, q, shorter); }));
    REQUIRE(is_invalid([&] { space.distances(q, shorter); }));
    REQUIRE(is_invalid([&] { space.distances(q, q, shorter); }));
    REQUIRE(status_of([&] { space.step(q, q); }) == CSTK_ERROR_WRONG_SIZE);
    REQUIRE(status_of([&] { space.clamp(shorter); }) == CSTK_ERROR_WRONG_SIZE);
    REQUIRE(status_of([&] { space.wrap(shorter); }) == CSTK_ERROR_WRONG_SIZE);
    REQUIRE(status_of([&] { space.link_poses(shorter); }) == CSTK_ERROR_WRONG_SIZE);
    REQUIRE(status_of([&] { space.within_limits(shorter); }) == CSTK_ERROR_WRONG_SIZE);
    REQUIRE(status_of([&] { space.within_world(shorter); }) == CSTK_ERROR_WRONG_SIZE);
    REQUIRE(status_of([&] { space.jacobian(q, 8, {0, 0, 0}); }) == CSTK_ERROR_NOT_FOUND);
    REQUIRE(status_of([&] { cstk::Space(robot).sample(state); }) == CSTK_ERROR_UNSUPPORTED);
}

static void steps() {
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
    REQUIRE(status_of([&] { cstk::slide_step(list, {1}, 0.2); }) == CSTK_ERROR_WRONG_SIZE);
    REQUIRE(status_of([&] { cstk::spring_step(list, -1); }) == CSTK_ERROR_INVALID_ARGUMENT);
    const cstk_witness_list without = query.witnesses(obstacle, {0, 0}, 0.5);
    REQUIRE(status_of([&] { cstk::spring_step(without, 0.2); }) == CSTK_ERROR_INVALID_ARGUMENT);
}

/// A cube that a rail moves along x, between -5 and 5; a wheel turns nothing.
static cstk::Space make_space(const cstk::Body &body) {
    cstk::RobotBuilder builder;
    cstk::Link link;
    link.joint = CSTK_JOINT_PRISMATIC;
    link.axis = {1, 0, 0};
    link.lower = -5;
    link.upper = 5;
    link.body = body;
    builder.add_link(link);
    link = cstk::Link();
    link.joint = CSTK_JOINT_REVOLUTE;
    link.parent = 0;
    builder.add_link(link);
    return cstk::Space({builder.build()}, {}, {-4, -4, -4, 4, 4, 4});
}

static void pure_sets(const cstk::Space &space) {
    cstk::Query query;
    const double infinity = std::numeric_limits<double>::infinity();
    const cstk_pure_options options = cstk::pure_options(1, 2);
    const cstk::CObject limits = cstk::CObject::beyond_limits(space);
    const cstk::CObject world = cstk::CObject::beyond_world(space);
    const cstk::CObject box = cstk::CObject::box(space, {1, -infinity}, {2, infinity}, options);
    const cstk::CObject plane = cstk::CObject::halfspace(space, {-2, 0}, -6, options);
    const cstk::CObject ball = cstk::CObject::ball(space, {0, 0}, 0.5, options);
    const std::vector<double> q = {3, 0};
    REQUIRE(query.distance(limits, q).distance == 2 && query.distance(world, q).distance == 1);
    REQUIRE(query.distance(box, q).distance == 2 && query.distance(ball, q).distance == 5);
    REQUIRE(query.classify(limits, q) == CSTK_CLASS_OUTSIDE && query.classify(ball, q) == CSTK_CLASS_OUTSIDE);
    REQUIRE(query.classify(box, q) == CSTK_CLASS_CONTACT && query.classify(plane, q) == CSTK_CLASS_INSIDE);
    REQUIRE(query.classify(limits, {6, 0}) == CSTK_CLASS_INSIDE);
    REQUIRE(query.gradients(box, q, 3).gradients[0] == 2);

    const cstk::CObject either = cstk::CObject::union_of({box, ball});
    const cstk::CObject both = cstk::CObject::intersection_of({box, plane});
    REQUIRE(query.distance(either, q).distance == 2);
    REQUIRE(query.classify(both, q) == CSTK_CLASS_CONTACT);
    REQUIRE(query.classify(both, {1, 0}) == CSTK_CLASS_OUTSIDE);
    REQUIRE(query.classify(cstk::CObject::difference(plane, box), {4, 0}) == CSTK_CLASS_INSIDE);
    REQUIRE(query.classify(ball.complement(), q) == CSTK_CLASS_INSIDE);
    REQUIRE(query.classify(ball.complement(), {0, 0}) == CSTK_CLASS_OUTSIDE);

    REQUIRE(is_invalid([&] { cstk::CObject::box(space, {1, 2}, {1}); }));
    REQUIRE(status_of([&] { cstk::CObject::box(space, {1}, {2}); }) == CSTK_ERROR_WRONG_SIZE);
    REQUIRE(status_of([&] { cstk::CObject::halfspace(space, {0, 0}, 1); }) == CSTK_ERROR_DEGENERATE);
    REQUIRE(status_of([&] { cstk::CObject::ball(space, {0, 0}, -1); }) == CSTK_ERROR_INVALID_ARGUMENT);
    const cstk_pure_options bad = cstk::pure_options(-1);
    REQUIRE(status_of([&] { cstk::CObject::beyond_limits(space, bad); }) == CSTK_ERROR_INVALID_ARGUMENT);
    REQUIRE(status_of([&] { cstk::CObject::beyond_world(space, bad); }) == CSTK_ERROR_INVALID_ARGUMENT);
    REQUIRE(status_of([] { cstk::CObject::intersection_of({}); }) == CSTK_ERROR_EMPTY);
    REQUIRE(status_of([] { cstk::CObject::union_of({}); }) == CSTK_ERROR_EMPTY);
    REQUIRE(status_of([] { cstk::CObject().complement(); }) == CSTK_ERROR_NULL_ARGUMENT);
    REQUIRE(status_of([&] { cstk::CObject::difference(box, cstk::CObject()); }) ==
            CSTK_ERROR_NULL_ARGUMENT);
}

static std::int32_t beyond_three(const double *q, std::size_t, std::int32_t *out, void *calls) {
    ++*static_cast<int *>(calls);
    *out = q[0] >= 3 ? CSTK_CLASS_INSIDE : CSTK_CLASS_OUTSIDE;
    return CSTK_OK;
}

static void count(void *calls) { *static_cast<int *>(calls) += 100; }

static void predicates(const cstk::Space &space) {
    cstk::Query query;
    int calls = 0;
    cstk_predicate plain = cstk::predicate();
    REQUIRE(status_of([&] { cstk::CObject::predicate(space, plain); }) == CSTK_ERROR_NULL_ARGUMENT);
    plain.classify = beyond_three;
    plain.user = &calls;
    plain.destroy = count;
    cstk::CObject by_c = cstk::CObject::predicate(space, plain);
    REQUIRE(query.classify(by_c, {3, 0}) == CSTK_CLASS_INSIDE && calls == 1);
    by_c = cstk::CObject();
    REQUIRE(calls == 101);

    const auto kept = std::make_shared<double>(3);
    cstk::Predicate functions;
    REQUIRE(status_of([&] { cstk::CObject::predicate(space, functions); }) == CSTK_ERROR_NULL_ARGUMENT);
    functions.classify = [kept](cstk::Span<double> q) {
        if (q.data()[1] == 1) {
            throw std::domain_error("mine");
        }
        return q.size() == 2 && q.data()[0] >= *kept ? CSTK_CLASS_INSIDE : CSTK_CLASS_OUTSIDE;
    };
    cstk::CObject by_class = cstk::CObject::predicate(space, functions);
    REQUIRE(query.distance(by_class, {1, 0}).kind == CSTK_DISTANCE_LOWER_BOUND);
    REQUIRE(query.classify(by_class, {3, 0}) == CSTK_CLASS_INSIDE);
    functions.distance = [kept](cstk::Span<double> q) { return *kept - q.data()[0]; };
    functions.gradient = [](cstk::Span<double> q) {
        return q.data()[1] == 2 ? std::vector<double>{-1} : std::vector<double>{-1, 0};
    };
    functions.knows_depth = true;
    cstk::CObject set =
        cstk::CObject::predicate(space, std::move(functions), cstk::pure_options(0, 2));
    functions = cstk::Predicate();
    REQUIRE(query.distance(set, {1, 0}).distance == 4);
    REQUIRE(query.distance(set.complement(), {4, 0}).distance == 2);
    REQUIRE(query.gradients(set, {1, 0}, 5).gradients[0] == -2);
    REQUIRE(status_of([&] { query.gradients(set, {1, 2}, 5); }) == CSTK_ERROR_CALLBACK_FAILED);
    REQUIRE(status_of([&] { query.classify(set, {1, 1}); }) == CSTK_ERROR_CALLBACK_FAILED);
    REQUIRE(status_of([&] {
                cstk::Predicate refused;
                refused.classify = [kept](cstk::Span<double>) { return CSTK_CLASS_OUTSIDE; };
                cstk::CObject::predicate(space, refused, cstk::pure_options(-1));
            }) == CSTK_ERROR_INVALID_ARGUMENT);
    by_class = cstk::CObject();
    REQUIRE(kept.use_count() > 1);
    set = cstk::CObject();
    REQUIRE(kept.use_count() == 1);
}

static void explanations(const cstk::Space &space, const cstk::Body &body) {
    cstk::Query query;
    int destroyed = 0;
    int mark = 0;
    cstk::Environment environment;
    const std::uint64_t id = environment.add(body, cstk::translation(2, 0, 0));
    cstk::CObject obstacle =
        cstk::CObject::induced(space, environment).with_data(&destroyed, count);
    cstk::CObject ball = cstk::CObject::ball(space, {0, 0}, 0.5).with_data(&mark);
    REQUIRE(obstacle.data() == &destroyed && ball.data() == &mark);
    REQUIRE(obstacle.number() != ball.number() && environment.object_count() == 1);
    const cstk::CObject all = cstk::CObject::union_of({obstacle, ball.complement()});
    const cstk_explanation why = query.explain(all, {1.5, 0});
    REQUIRE(why.point_class == CSTK_CLASS_INSIDE && why.leaf_count == 2 && why.list.witness_count == 1);
    REQUIRE(why.leaves[0].data == &destroyed && why.leaves[0].cobject == obstacle.number());
    REQUIRE(why.leaves[1].data == &mark && why.leaves[1].cobject == ball.number());
    REQUIRE(why.leaves[1].complemented && why.leaves[1].decisive && why.leaves[0].decisive);
    REQUIRE(why.list.witnesses[0].cobject_data == &destroyed);
    REQUIRE(why.list.witnesses[0].s_object == id);
    REQUIRE(query.explain(all, {1.5, 0}, 0).list.truncated);
    REQUIRE(status_of([&] { query.explain(all, {1.5}); }) == CSTK_ERROR_WRONG_SIZE);
    REQUIRE(status_of([&] { query.distance(all, {1.5, 0}); }) == CSTK_ERROR_UNSUPPORTED);
    REQUIRE(obstacle.with_shell(0.1).data() == &destroyed);
    REQUIRE(query.classify(obstacle.with_known(cstk::CObject::ball(space, {1.5, 0}, 0.1), CSTK_CLASS_OUTSIDE),
                           {1.5, 0}) == CSTK_CLASS_OUTSIDE);
    REQUIRE(status_of([&] { obstacle.with_known(obstacle, CSTK_CLASS_OUTSIDE); }) == CSTK_ERROR_UNSUPPORTED);
    REQUIRE(obstacle.with_shell(0.1).number() != obstacle.number());
    REQUIRE(status_of([&] { all.with_shell(0.1); }) == CSTK_ERROR_UNSUPPORTED);
    REQUIRE(status_of([] { cstk::CObject().with_shell(0.1); }) == CSTK_ERROR_NULL_ARGUMENT);
    REQUIRE(status_of([] { cstk::CObject().with_data(nullptr); }) == CSTK_ERROR_NULL_ARGUMENT);
    REQUIRE(status_of([] { cstk::CObject().data(); }) == CSTK_ERROR_NULL_ARGUMENT);
    REQUIRE(status_of([] { cstk::CObject().number(); }) == CSTK_ERROR_NULL_ARGUMENT);
    const cstk::CObject alone = obstacle;
    obstacle = cstk::CObject();
    REQUIRE(destroyed == 0);
}

/* A robot with an object in its hand, over a floor. */
static void worlds(const cstk::Space &space, const cstk::Body &body) {
    int mark = 0;
    const cstk::Body held = cstk::BodyBuilder().add_sphere({0, 0, 0}, 0.5).build();
    held.set_data(&mark);
    REQUIRE(held.data() == &mark && body.data() == nullptr);
    cstk::Environment world;
    const std::uint64_t id = world.add(held, cstk::translation(0, 0, 50));
    const std::vector<double> q(space.nq(), 0.0);
    cstk::Query query;
    const cstk::CObject ground = cstk::CObject::below_floor(space, {0, 0, 4}, -400);
    REQUIRE(query.distance(ground, q).distance > 90);
    const std::uint32_t hand = static_cast<std::uint32_t>(space.link_count() - 1);
    world.attach(id, space, hand, cstk::translation(0, 0, 20));
    const std::uint64_t wall = world.add(body, cstk::translation(0, 0, 30));
    const cstk::CObject all = cstk::CObject::induced(space, world);
    const cstk_distance_result found = query.distance(all, q);
    REQUIRE(found.witness.r_object == id && found.witness.s_object == wall);
    REQUIRE(found.witness.r_data == &mark && query.version(world) == world.version());
    REQUIRE(world.object(id).link == hand && world.object(id).data == &mark);
    REQUIRE((world.objects() == std::vector<std::uint64_t>{id, wall}));
    world.move(id, cstk::translation(0, 0, 50));
    REQUIRE(world.object(id).link == CSTK_NONE && world.object(id).pose[11] == 50);
    REQUIRE(query.distance(all, q).witness.r_object == 0);
    REQUIRE(space.link_name(hand) == "link1" && query.find_link_pairs(space).empty());
}

static void sets() {
    const cstk::Body body = cstk::BodyBuilder().add_polyhedron(cube).build();
    const cstk::Space space = make_space(body);
    pure_sets(space);
    predicates(space);
    explanations(space, body);
    worlds(space, body);
}

static void srdf() {
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
    REQUIRE(status_of([&] { robot.to_whole(q); }) == CSTK_ERROR_EMPTY);
    const auto pairs = cstk::Space(frozen).enabled_pairs();
    REQUIRE(pairs.size() == 2 && pairs[0][1] == 2 && pairs[1][0] == 1);
    REQUIRE(status_of([&] { robot.find_state("", "s"); }) == CSTK_ERROR_NOT_FOUND);
    REQUIRE(status_of([&] { builder.load_srdf("/nowhere.srdf"); }) == CSTK_ERROR_IO);
}

static void scenes() {
    const char *text = "s\n* ball\n1\nsphere\n1\n4 0 0\n0 0 0 1\n0 0 0 0\n.\n";
    cstk::Environment environment;
    cstk_scene_options options = cstk::scene_options();
    options.at[3] = 1;
    const std::vector<std::uint64_t> ids = environment.load_scene_text(text, options);
    REQUIRE(ids.size() == 1 && environment.object_pose(ids[0])[3] == 1);
    REQUIRE(std::string(static_cast<const char *>(environment.object(ids[0]).data)) == "ball");
    REQUIRE(status_of([&] { environment.load_scene("/nowhere.scene"); }) == CSTK_ERROR_IO);
}

static void urdf() {
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
    REQUIRE(std::remove(file) == 0);
    REQUIRE(status_of([&] { builder.load_urdf(file); }) == CSTK_ERROR_IO);
    cstk::RobotBuilder described;
    REQUIRE(described.load_urdf_text("<robot><link name='a'/></robot>") == 0);
    REQUIRE(described.urdf_report().link_count == 1);
}

int main() {
    urdf();
    srdf();
    scenes();
    bodies();
    octrees();
    hierarchies();
    poses();
    euler_angles();
    robots();
    spaces();
    steps();
    queries();
    sets();
    std::puts("the C++ layer holds");
}
