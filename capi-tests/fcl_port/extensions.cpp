// What FCL lacks or Coal adds: margins, lower bounds, functors, solids, depths of round shapes, threads, single precision.
#include "library.hpp"

#include <thread>

double distance_of_balls(double apart);

namespace {

void margins() {
    const fcl::Boxd box(2, 2, 2);
    const fcl::Sphered ball(1);
    fcl::CollisionRequestd request(4, true);
    request.security_margin = 0.5;
    request.enable_distance_lower_bound = true;
    fcl::CollisionResultd near, far;
    expect(fcl::collide<double>(&box, at(0, 0, 0), &ball, at(2.25, 0.2, 0), request, near) == 1, "within the margin");
    expect_near(near.getContact(0).penetration_depth, -0.25, 1e-12, "the depth is minus the distance within a margin");
    expect_near(near.getContact(0).normal[0], 1, 1e-12, "normal within a margin");
    expect_near(near.getContact(0).nearest_points[0][0], 1, 1e-12, "point of the box");
    expect_near(near.getContact(0).nearest_points[1][0], 1.25, 1e-12, "point of the ball");
    expect(fcl::collide<double>(&box, at(0, 0, 0), &ball, at(2.75, 0.2, 0), request, far) == 0, "beyond the margin");
    expect_near(far.distance_lower_bound, 0.25, 1e-12, "lower bound beyond the margin");
    request.distance_upper_bound = 0.6;
    fcl::collide<double>(&box, at(0, 0, 0), &ball, at(9, 0.2, 0), request, far);
    expect(far.distance_lower_bound >= 0.1 - 1e-12 && far.distance_lower_bound <= 7, "no bound beyond what was asked for");
    bool refused = false;
    request.security_margin = -0.1;
    try {
        fcl::collide<double>(&box, at(0, 0, 0), &ball, at(9, 0, 0), request, far);
    } catch (const std::invalid_argument &) {
        refused = true;
    }
    expect(refused, "negative margins are refused");
    const fcl::ComputeCollision collider(&box, &ball);
    const fcl::ComputeDistance measurer(&box, &ball);
    fcl::CollisionResultd again;
    fcl::DistanceResultd result;
    expect(collider(at(0, 0, 0), at(1.5, 0, 0), fcl::CollisionRequestd(), again) == 1, "ComputeCollision");
    expect_near(measurer(at(0, 0, 0), at(0, 5, 0), fcl::DistanceRequestd(), result), 3, 1e-12, "ComputeDistance");
}

// Half a turn goes either way round: the proof goes the way that the motion says.
void half_turns() {
    const fcl::Boxd box(2, 0.4, 0.3);
    const fcl::Sphered ball(0.15);
    int free = 0, met = 0;
    for (int i = 0; i < 128; ++i) {
        const double yaw = 0.05 * i, tilt = i % 2 == 0 ? 0.0 : 0.01 * i;
        const auto turned = [&](double angle, double height) {
            Transform tf = at(0, 0, height);
            tf.linear() = (Eigen::AngleAxisd(angle, Eigen::Vector3d(std::sin(tilt), 0, std::cos(tilt))) *
                           Eigen::AngleAxisd(tilt, Eigen::Vector3d::UnitY()))
                              .toRotationMatrix();
            return tf;
        };
        const Transform start = turned(yaw, -0.5), end = turned(yaw + 3.14159265358979323846, 0.5), there = at(0.8, 0.3, 0);
        const fcl::InterpMotiond straight(start, end);
        const fcl::ScrewMotiond screw(start, end);
        const fcl::TranslationMotiond rests(there, there);
        for (const fcl::MotionBased *motion : {static_cast<const fcl::MotionBased *>(&straight),
                                               static_cast<const fcl::MotionBased *>(&screw)}) {
            fcl::ContinuousCollisionResultd result;
            const fcl::MotionBased *const still = &rests;
            fcl::continuousCollide<double>(&box, motion, &ball, still, fcl::ContinuousCollisionRequestd(10, 1e-9), result);
            bool meets = false;
            for (int k = 0; k <= 400; ++k) {
                Transform now;
                motion->integrate(k / 400.0);
                motion->getCurrentTransform(now);
                fcl::CollisionResultd sample;
                meets = meets || fcl::collide<double>(&box, now, &ball, there, fcl::CollisionRequestd(), sample) > 0;
            }
            expect(!meets || result.is_collide, "half a turn that meets is not free");
            if (result.is_collide) {
                fcl::DistanceResultd nearest;
                fcl::distance<double>(&box, result.contact_tf1, &ball, result.contact_tf2, fcl::DistanceRequestd(), nearest);
                expect(nearest.min_distance < 1e-8, "a half turn's contact");
            }
            (result.is_collide ? met : free) += 1;
        }
    }
    expect(free > 20 && met > 20, "half turns that meet and that do not");
}

// Parts of a model on both sides of a plane do not meet it.
void both_sides_of_a_plane() {
    Model model;
    model.beginModel();
    for (const double z : {-1.0, 1.0}) {
        model.addTriangle(Eigen::Vector3d(0, 0, z), Eigen::Vector3d(1, 0, z), Eigen::Vector3d(0, 1, z));
    }
    model.endModel();
    const fcl::Planed plane(0, 0, 1, 0);
    const auto collides = [&](const Transform &end, fcl::CCDMotionType kind) {
        fcl::ContinuousCollisionResultd result;
        const fcl::ContinuousCollisionRequestd request(10, 1e-9, kind);
        fcl::continuousCollide<double>(&model, at(0, 0, 0), end, &plane, at(0, 0, 0), at(0, 0, 0), request, result);
        return result.is_collide;
    };
    Transform tilted = at(3, 0, 0);
    tilted.linear() = Eigen::AngleAxisd(1.2, Eigen::Vector3d::UnitX()).toRotationMatrix();
    for (const fcl::CCDMotionType kind : {fcl::CCDM_TRANS, fcl::CCDM_LINEAR, fcl::CCDM_SCREW}) {
        expect(!collides(at(30, 5, 0.99), kind), "along a plane, on both sides of it");
        expect(collides(at(30, 5, 1.01), kind), "into a plane");
        expect(kind == fcl::CCDM_TRANS || collides(tilted, kind), "turned into a plane");
    }
}

// A ball about the middle of an ellipsoid that is nearly round comes out along the shortest axis.
void depths_of_nearly_round_ellipsoids() {
    for (int i = 0; i < 120; ++i) {
        const double out = std::pow(10, -4 + i / 30.0), b = 1 + out * (0.1 + i % 7 / 8.0), c = 1 + out * (0.1 + i % 11 / 12.0);
        const double radius = 0.2 + 0.01 * i;
        const fcl::Ellipsoidd ellipsoid(1, b, c);
        const fcl::Sphered ball(radius);
        Transform tf = at(0, 0, 0);
        tf.linear() = Eigen::AngleAxisd(0.3 * i, Eigen::Vector3d(1, 0.1 * i, -0.5).normalized()).toRotationMatrix();
        fcl::DistanceResultd result;
        const double depth = -fcl::distance<double>(&ball, at(0, 0, 0), &ellipsoid, tf, fcl::DistanceRequestd(true, true), result);
        const double size = 2 * (radius + std::max(b, c));
        expect(depth >= radius + 1 - 1e-12 && depth <= radius + 1 + 1e-6 * size, "the depth of a ball in an ellipsoid");
    }
}

// A ball inside a closed mesh: a surface does not meet it, a solid does.
void solids() {
    const fcl::Sphered ball(0.2);
    for (const bool solid : {false, true}) {
        Model cube;
        cube.beginModel();
        cube.set_solid(solid);
        fcl::generateBVHModel(cube, fcl::Boxd(2, 2, 2), at(0, 0, 0));
        fcl::CollisionResultd result;
        fcl::DistanceResultd nearest;
        const fcl::CollisionRequestd request(5, true);
        expect((fcl::collide<double>(&cube, at(0, 0, 0), &ball, at(0, 0, 0), request, result) > 0) == solid, "a ball in a mesh");
        fcl::distance<double>(&cube, at(0, 0, 0), &ball, at(0, 0, 0), fcl::DistanceRequestd(true, true), nearest);
        expect_near(nearest.min_distance, solid ? -1 : 0.8, 1e-12, "distance of a ball in a mesh");
    }
    Model open;
    open.beginModel();
    open.set_solid();
    open.addTriangle(Vector(0, 0, 0), Vector(1, 0, 0), Vector(0, 1, 0));
    expect(open.endModel() == fcl::BVH_ERR_INCORRECT_DATA, "an open solid is refused");
}

// Triangles without area are kept: nothing passes through them.
void thin_triangles() {
    Model model;
    model.beginModel();
    model.addTriangle(Vector(0, 0, 0), Vector(1, 0, 0), Vector(2, 0, 0));
    model.addTriangle(Vector(0, 0, 5), Vector(1, 0, 5), Vector(0, 1, 5));
    expect(model.endModel() == fcl::BVH_OK, "a model with a triangle without area");
    const fcl::Sphered ball(0.5);
    fcl::DistanceResultd result;
    fcl::distance<double>(&model, at(0, 0, 0), &ball, at(1.5, 2, 0), fcl::DistanceRequestd(), result);
    expect_near(result.min_distance, 1.5, 1e-12, "distance from a triangle without area");
    expect(result.b1 == 0, "its number");
}

// Depths of round shapes: closed forms, and no direction gives a smaller one.
void depths() {
    const fcl::Cylinderd cylinder(1, 2);
    const fcl::Sphered ball(0.5);
    const fcl::Ellipsoidd egg(1, 2, 3);
    const fcl::CollisionRequestd request(1, true);
    const auto depth = [&](const fcl::CollisionGeometryd &a, const Transform &ta, const fcl::CollisionGeometryd &b,
                           const Transform &tb) {
        fcl::CollisionResultd result;
        fcl::collide<double>(&a, ta, &b, tb, request, result);
        return result.isCollision() ? result.getContact(0) : fcl::Contactd();
    };
    expect_near(depth(cylinder, at(0, 0, 0), ball, at(1.2, 0, 0)).penetration_depth, 0.3, 1e-6, "a ball at a cylinder's side");
    expect_near(depth(cylinder, at(0, 0, 0), ball, at(0.2, 0.1, 1.1)).penetration_depth, 0.4, 1e-6, "a ball on a cylinder's end");
    expect_near(depth(egg, at(0, 0, 0), egg, at(0, 0, 0)).penetration_depth, 2, 2e-6, "two ellipsoids, one in the other");
    models::Random random(61);
    const fcl::Coned cone(0.8, 1.5);
    const fcl::Boxd box(1, 1.5, 2);
    const std::vector<const fcl::CollisionGeometryd *> shapes = {&cylinder, &egg, &cone, &box};
    for (int i = 0; i < 200; ++i) {
        const fcl::CollisionGeometryd *a = shapes[random.below(3)], *b = shapes[random.below(4)];
        const Transform ta = random_transform(random, 0.3), tb = random_transform(random, 0.8);
        const fcl::Contactd found = depth(*a, ta, *b, tb);
        if (!(found.penetration_depth > 1e-3)) {
            continue;
        }
        const std::string label = "depth " + std::to_string(i);
        // The translation separates, and nothing shorter does along it.
        for (const double part : {1 + 1e-5, 1 - 1e-3}) {
            Transform moved = tb;
            moved.translation() += part * found.penetration_depth * found.normal;
            fcl::CollisionResultd result;
            expect((fcl::collide(a, ta, b, moved, fcl::CollisionRequestd(), result) > 0) == (part < 1), label + ": the way out");
        }
        // Nor does any other way, by support points along random directions.
        double least = found.penetration_depth;
        for (int k = 0; k < 2000; ++k) {
            const Vector n = Vector(random.uniform(-1, 1), random.uniform(-1, 1), random.uniform(-1, 1)).normalized();
            const Vector top = ta * a->support_point(ta.linear().transpose() * n, 0);
            const Vector bottom = tb * b->support_point(tb.linear().transpose() * -n, 0);
            least = std::min(least, n.dot(top - bottom));
        }
        expect(found.penetration_depth - least <= 1e-6, label + ": no other direction is shorter");
        expect_near((found.nearest_points[0] - found.nearest_points[1]).norm(), found.penetration_depth, 1e-3, label + ": points");
    }
}

// As many contacts as there are, however many are asked for.
void all_contacts() {
    const auto model = model_of(models::torus(1, 0.3, 12, 8));
    const fcl::Cylinderd cylinder(0.4, 3);
    const fcl::CollisionRequestd request(std::numeric_limits<std::size_t>::max(), true);
    fcl::CollisionResultd of_models, of_round;
    const auto count = fcl::collide<double>(model.get(), at(0, 0, 0), model.get(), at(0.3, 0.1, 0.2), request, of_models);
    expect(count > 10 && count == of_models.numContacts(), "all contacts of two models");
    expect(fcl::collide<double>(model.get(), at(0, 0, 0), &cylinder, at(0.8, 0, 0), request, of_round) > 10, "and of a cylinder");
    for (std::size_t i = 1; i < of_round.numContacts(); ++i) {
        expect(of_round.getContact(i - 1).penetration_depth >= of_round.getContact(i).penetration_depth, "deepest first");
    }
    expect(&of_round.getContact(99999) == &of_round.getContact(of_round.numContacts() - 1), "the last for a number too large");
}

// What lies on a plane touches it, though rounding may have moved it.
void lying() {
    const fcl::Boxd box(0.1, 0.2, 0.3);
    models::Random random(62);
    for (int i = 0; i < 200; ++i) {
        const Transform tf = random_transform(random, 10);
        const fcl::Halfspaced floor(0, 0, 1, -0.15);
        fcl::CollisionResultd result;
        expect(fcl::collide<double>(&box, tf, &floor, tf, fcl::CollisionRequestd(), result) == 1, "a box that lies on a floor");
    }
}

// A size that changes is seen by the next query.
void changed_sizes() {
    fcl::Boxd box(2, 2, 2);
    const fcl::Sphered ball(1);
    for (const double side : {2.0, 4.0}) {
        box.side[0] = side;
        fcl::DistanceResultd result;
        fcl::distance<double>(&box, at(0, 0, 0), &ball, at(5, 0, 0), fcl::DistanceRequestd(), result);
        expect_near(result.min_distance, 4 - side / 2, 1e-12, "distance of a box that has grown");
    }
    const fcl::Boxd flat(2, 2, 0);
    fcl::DistanceResultd result;
    fcl::distance<double>(&flat, at(0, 0, 0), &ball, at(0, 0, 3), fcl::DistanceRequestd(), result);
    expect_near(result.min_distance, 2, 1e-12, "distance of a box without height");
}

// Threads share geometries, which are built at the first query.
void threads() {
    const fcl::Cylinderd cylinder(1, 2);
    const fcl::Boxd box(1, 1, 1);
    std::vector<std::thread> running;
    std::vector<double> found(8);
    for (double &answer : found) {
        running.emplace_back([&] {
            for (int i = 0; i < 200; ++i) {
                fcl::DistanceResultd result;
                fcl::distance<double>(&cylinder, at(0, 0, 0), &box, at(3, 0.1, 0.2), fcl::DistanceRequestd(), result);
                answer = result.min_distance;
            }
        });
    }
    for (std::thread &thread : running) {
        thread.join();
    }
    expect(std::all_of(found.begin(), found.end(), [&](double d) { return d == found[0] && d == 1.5; }), "threads agree");
}

// A tree of very many objects in a row, added one by one, taken out again.
void rows() {
    const auto ball = std::make_shared<fcl::Sphered>(0.4);
    std::vector<std::unique_ptr<fcl::CollisionObjectd>> objects;
    fcl::DynamicAABBTreeCollisionManagerd manager;
    for (int i = 0; i < 3000; ++i) {
        objects.push_back(std::make_unique<fcl::CollisionObjectd>(ball, at(i, 0, 0)));
        manager.registerObject(objects.back().get());
    }
    fcl::DefaultDistanceData<double> data;
    manager.distance(&data, fcl::DefaultDistanceFunction<double>);
    expect_near(data.result.min_distance, 0.2, 1e-12, "nearest of a row");
    for (int i = 0; i < 3000; ++i) {
        if (i % 3 != 0) {
            manager.unregisterObject(objects[static_cast<std::size_t>(i)].get());
        }
    }
    fcl::DefaultDistanceData<double> sparse;
    manager.distance(&sparse, fcl::DefaultDistanceFunction<double>);
    expect_near(sparse.result.min_distance, 2.2, 1e-12, "nearest of every third");
    std::vector<fcl::CollisionObjectd *> left;
    manager.getObjects(left);
    expect(left.size() == 1000 && manager.size() == 1000, "a third is left");
}

} // namespace

int main() {
    margins();
    half_turns();
    both_sides_of_a_plane();
    solids();
    thin_triangles();
    depths();
    depths_of_nearly_round_ellipsoids();
    all_contacts();
    lying();
    changed_sizes();
    threads();
    rows();
    expect_near(distance_of_balls(5), 3, 1e-6, "single precision, in another file");
    return failures() == 0 ? 0 : 1;
}
