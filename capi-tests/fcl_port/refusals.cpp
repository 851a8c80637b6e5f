// What has no answer is refused, in double and in single precision, by every kind of pair; and what single precision rounds stays on the
// safe side. FCL answers most of this with something.
#include "library.hpp"

#include <limits>

namespace {

template <typename S> using Pose = fcl::Transform3<S>;

template <typename S> Pose<S> standing(S x, S y, S z) {
    Pose<S> tf = Pose<S>::Identity();
    tf.translation() = fcl::Vector3<S>(x, y, z);
    return tf;
}

template <typename Action> bool refused(const Action &action) {
    try {
        action();
    } catch (const cstk::Error &) {
        return true;
    } catch (const std::invalid_argument &) {
        return true;
    }
    return false;
}

template <typename S> fcl::Vector3<S> up() { return fcl::Vector3<S>::UnitZ(); }

// Each geometry beside a box, a half-space and a plane, first and second.
template <typename S>
void expect_refused(const fcl::CollisionGeometry<S> &geometry, const Pose<S> &tf, const Pose<S> &other, const std::string &what) {
    const fcl::Box<S> box(1, 1, 1);
    const fcl::Halfspace<S> floor(up<S>(), 0);
    const fcl::Plane<S> plane(up<S>(), 0);
    for (const fcl::CollisionGeometry<S> *beside : {static_cast<const fcl::CollisionGeometry<S> *>(&box),
                                                    static_cast<const fcl::CollisionGeometry<S> *>(&floor),
                                                    static_cast<const fcl::CollisionGeometry<S> *>(&plane)}) {
        for (const bool first : {true, false}) {
            const auto *const a = first ? &geometry : beside;
            const auto *const b = first ? beside : &geometry;
            const Pose<S> &at_a = first ? tf : other, &at_b = first ? other : tf;
            const std::string about = what + ", node type " + std::to_string(beside->getNodeType());
            expect(refused([&] {
                       fcl::CollisionResult<S> result;
                       fcl::collide(a, at_a, b, at_b, fcl::CollisionRequest<S>(), result);
                   }),
                   about + ": collide");
            expect(refused([&] {
                       fcl::CollisionRequest<S> request(10, true);
                       request.enable_distance_lower_bound = true;
                       fcl::CollisionResult<S> result;
                       fcl::collide(a, at_a, b, at_b, request, result);
                   }),
                   about + ": collide with contacts and a lower bound");
            expect(refused([&] {
                       fcl::DistanceResult<S> result;
                       fcl::distance(a, at_a, b, at_b, fcl::DistanceRequest<S>(true, true), result);
                   }),
                   about + ": distance");
        }
    }
}

template <typename S> void refusals() {
    const S nan = std::numeric_limits<S>::quiet_NaN(), infinity = std::numeric_limits<S>::infinity();
    const Pose<S> here = Pose<S>::Identity();
    const fcl::Box<S> box(1, 1, 1);
    Pose<S> turned = here, doubled = here, mirrored = here, flat = here, sheared = here, swapped = here;
    turned.linear()(0, 0) = nan;
    doubled.linear() *= 2;
    mirrored.linear()(2, 2) = -1;
    flat.linear().setZero();
    sheared.linear()(0, 1) = 1;
    swapped.linear() << 0, 1, 0, 1, 0, 0, 0, 0, 1;
    const Pose<S> wrong[] = {standing<S>(nan, 0, 0), standing<S>(0, 0, infinity), turned, doubled, mirrored, flat, sheared, swapped};
    for (std::size_t i = 0; i < 8; ++i) {
        expect_refused<S>(box, wrong[i], here, "transform " + std::to_string(i));
        expect_refused<S>(box, here, wrong[i], "transform of the other " + std::to_string(i));
    }
    expect_refused<S>(fcl::Sphere<S>(-1), here, here, "a negative radius");
    expect_refused<S>(fcl::Box<S>(-1, 1, 1), here, here, "a negative side");
    expect_refused<S>(fcl::Capsule<S>(S(0.5), -1), here, here, "a negative length");
    expect_refused<S>(fcl::Box<S>(nan, 1, 1), here, here, "a box as wide as no number");
    const auto faces = std::make_shared<const std::vector<int>>();
    const auto hull = std::make_shared<fcl::Convex<S>>(std::make_shared<const std::vector<fcl::Vector3<S>>>(), 0, faces);
    expect_refused<S>(*hull, here, here, "a hull without vertices");
    expect(refused([&] { fcl::CollisionObject<S> object(hull, here); }), "an object of a hull without vertices");
    expect(refused([&] { hull->findExtremeVertex(up<S>()); }), "the extreme vertex of none");
    expect(refused([&] { fcl::Convex<S> made(nullptr, 0, faces); }), "a hull of no list of vertices");
    expect_refused<S>(fcl::Box<S>(1, 1, nan), here, here, "a box as high as no number");
    const S third[3] = {1, nan, 1};
    const std::vector<fcl::Vector3<S>> corners = {{0, 0, -1}, {1, 0, 1}, {0, 1, 1}};
    using Models = fcl::BVHModel<fcl::OBBRSS<S>>;
    const Models empty;
    expect_refused<S>(empty, here, here, "a model that was never begun");
    Models open, lost, reaching;
    open.beginModel();
    open.addTriangle(corners[0], corners[1], corners[2]);
    expect_refused<S>(open, here, here, "a model that was not ended");
    lost.beginModel();
    lost.addTriangle(corners[0], corners[1], fcl::Vector3<S>(third[0], third[1], third[2]));
    lost.endModel();
    expect_refused<S>(lost, here, here, "a model with a corner that is no number");
    reaching.beginModel();
    reaching.addSubModel(corners, {fcl::Triangle(0, 1, 1000000000)});
    reaching.endModel();
    expect_refused<S>(reaching, here, here, "a model with a vertex that does not exist");

    fcl::Halfspace<S> none(up<S>(), 0);
    none.n.setZero();
    const fcl::Halfspace<S> offset(up<S>(), nan), normal(fcl::Vector3<S>(nan, 0, 1), 0), far(up<S>(), infinity);
    const fcl::Halfspace<S> *const nowhere[] = {&none, &offset, &normal, &far};
    for (const fcl::Halfspace<S> *floor : nowhere) {
        const fcl::Plane<S> plane = [&] {
            fcl::Plane<S> made;
            made.n = floor->n;
            made.d = floor->d;
            return made;
        }();
        for (const fcl::CollisionGeometry<S> *beside : {static_cast<const fcl::CollisionGeometry<S> *>(floor),
                                                        static_cast<const fcl::CollisionGeometry<S> *>(&plane)}) {
            expect(refused([&] {
                       fcl::CollisionResult<S> result;
                       const fcl::CollisionGeometry<S> *const bounded = &box;
                       fcl::collide(bounded, here, beside, here, fcl::CollisionRequest<S>(), result);
                   }),
                   "a half-space or plane that is nowhere");
        }
    }
    for (const S margin : {nan, S(-1)}) {
        fcl::CollisionRequest<S> request;
        request.security_margin = margin;
        fcl::CollisionResult<S> result;
        const fcl::CollisionGeometry<S> *const bounded = &box;
        expect(refused([&] { fcl::collide(bounded, here, bounded, here, request, result); }), "a margin that is none");
    }
    expect(refused([&] {
               const fcl::Halfspace<S> floor(up<S>(), 0);
               fcl::ContinuousCollisionResult<S> moving;
               fcl::continuousCollide<S>(&box, standing<S>(0, 0, 2), standing<S>(0, 0, 2), &floor, here, standing<S>(0, 0, 1),
                                         fcl::ContinuousCollisionRequest<S>(), moving);
           }),
           "a half-space that moves");
    expect(refused([&] {
               const fcl::Halfspace<S> floor(up<S>(), 0);
               fcl::ContinuousCollisionResult<S> moving;
               fcl::continuousCollide<S>(&box, standing<S>(0, 0, 2), standing<S>(0, 0, 1), &floor, doubled, doubled,
                                         fcl::ContinuousCollisionRequest<S>(), moving);
           }),
           "a half-space at what is no rotation");
    // No manager hides an object that is nowhere, or has no size.
    const auto shared = std::make_shared<fcl::Box<S>>(1, 1, 1);
    const auto sizeless = std::make_shared<fcl::Box<S>>(1, nan, 1);
    for (fcl::CollisionObject<S> lost_object : {fcl::CollisionObject<S>(shared, wrong[0]), fcl::CollisionObject<S>(sizeless)}) {
        fcl::CollisionObject<S> found(shared, standing<S>(9, 9, 9));
        fcl::DynamicAABBTreeCollisionManager<S> manager;
        manager.registerObjects({&found, &lost_object});
        manager.setup();
        fcl::DefaultCollisionData<S> data;
        expect(refused([&] { manager.collide(&data, fcl::DefaultCollisionFunction<S>); }), "a manager with an object nowhere");
    }
}

// Rotations that many products in single precision have worn are rotations still.
void worn_rotations() {
    const fcl::Boxf rod(10, 1, 1);
    const fcl::Spheref ball(1);
    Pose<float> turn = Pose<float>::Identity(), step = turn;
    step.linear() = Eigen::AngleAxisf(0.37F, Eigen::Vector3f(1, 2, 3).normalized()).toRotationMatrix();
    for (int i = 0; i < 300; ++i) {
        turn = turn * step;
    }
    fcl::DistanceResultf worn, exact;
    fcl::DistanceResultd in_double;
    const fcl::CollisionGeometryf *const a = &rod;
    const fcl::CollisionGeometryf *const b = &ball;
    fcl::distance(a, turn, b, standing<float>(4, 5, 6), fcl::DistanceRequestf(), worn);
    const fcl::Boxd rod_d(10, 1, 1);
    const fcl::Sphered ball_d(1);
    const Eigen::Isometry3d placed(Eigen::Quaterniond(turn.linear().cast<double>()).normalized());
    fcl::distance<double>(&rod_d, placed, &ball_d, standing<double>(4, 5, 6), fcl::DistanceRequestd(), in_double);
    expect_near(worn.min_distance, in_double.min_distance, 1e-4, "a worn rotation");
}

// Times before which all is proved are rounded down.
void times_are_rounded_down() {
    const fcl::Spheref ball(0.5F), other(0.25F);
    for (int i = 0; i < 2000; ++i) {
        const float from = -3 - 0.001F * static_cast<float>(i), by = 5 + 0.0007F * static_cast<float>(i);
        fcl::ContinuousCollisionResultf result;
        fcl::continuousCollide<float>(&ball, standing<float>(from, 0, 0), standing<float>(from + by, 0, 0), &other,
                                      standing<float>(0, 0, 0), standing<float>(0, 0, 0),
                                      fcl::ContinuousCollisionRequestf(10, 1e-9F), result);
        const double way = static_cast<double>(from + by) - static_cast<double>(from);
        const double contact = (-0.75 - static_cast<double>(from)) / way;
        expect(result.is_collide && static_cast<double>(result.time_of_contact) <= contact, "a time of contact that is too late");
        expect_near(result.time_of_contact, contact, 1e-6, "the time of contact");
    }
}

// Hulls in single precision over a floor, far from the origin, against the same vertices as points.
void hulls_over_a_floor() {
    unsigned state = 7;
    const auto random = [&] {
        state = state * 1664525 + 1013904223;
        return static_cast<float>(state >> 8) / static_cast<float>(1 << 24);
    };
    for (int i = 0; i < 3000; ++i) {
        const auto vertices = std::make_shared<std::vector<fcl::Vector3f>>();
        const float far = i % 3 == 0 ? 1e5F : 1;
        fcl::BVHModel<fcl::OBBRSSf> cloud;
        cloud.beginModel();
        for (int k = 0; k < 12; ++k) {
            vertices->push_back({far + random(), -far + random(), random()});
            cloud.addVertex(vertices->back());
        }
        cloud.endModel();
        const fcl::Convexf hull(vertices, 0, std::make_shared<std::vector<int>>());
        const fcl::Vector3f normal(random() - 0.5F, random() - 0.5F, random() - 0.5F);
        const fcl::Halfspacef floor(normal.normalized(), normal.normalized().dot((*vertices)[0]));
        fcl::DistanceResultf of_hull, of_points;
        const Pose<float> here = Pose<float>::Identity();
        fcl::distance<float>(&hull, here, &floor, here, fcl::DistanceRequestf(false, true), of_hull);
        fcl::distance<float>(&cloud, here, &floor, here, fcl::DistanceRequestf(false, true), of_points);
        expect(of_hull.min_distance == of_points.min_distance, "a hull over a floor");
    }
}

} // namespace

int main() {
    refusals<double>();
    refusals<float>();
    worn_rotations();
    times_are_rounded_down();
    hulls_over_a_floor();
    return failures() == 0 ? 0 : 1;
}
