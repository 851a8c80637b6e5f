// Cases of FCL's issue tracker that it answers wrongly, with what is true. With cstk/fcl.hpp all must be right; of FCL the
// program only prints what it answers.
#include "library.hpp"

namespace {

int wrong = 0;

void check(const std::string &what, double answered, double truth, double tolerance) {
    const bool right = std::fabs(answered - truth) <= tolerance;
    wrong += right ? 0 : 1;
    std::printf("%-62s %12.7g  true %9.7g  %s\n", what.c_str(), answered, truth, right ? "" : "WRONG");
}

// fcl#545: the depth of two convex sets is along an axis, not along the diagonal.
void depth_of_cubes() {
    const auto large = convex_of(models::box("cube", 1, 1, 1));
    for (const double side : {0.1, 0.3}) {
        const auto small = convex_of(models::box("cube", side, side, side));
        const fcl::Boxd box(side, side, side);
        const fcl::CollisionRequestd request(10, true);
        for (int with_box = 0; with_box < 2; ++with_box) {
            fcl::CollisionResultd result;
            const fcl::CollisionGeometryd *other = &box;
            if (with_box == 0) {
                other = small.get();
            }
            fcl::collide<double>(large.get(), at(0, 0, 0), other, at(0.4, 0.4, 0.4), request, result);
            double deepest = 0;
            Vector normal = Vector::Zero();
            for (std::size_t i = 0; i < result.numContacts(); ++i) {
                deepest = std::max(deepest, result.getContact(i).penetration_depth);
                normal = result.getContact(0).normal;
            }
            const std::string name = std::string("fcl#545 depth, convex and ") + (with_box == 1 ? "box " : "convex ");
            check(name + std::to_string(side), deepest, 0.1 + side / 2, 1e-9);
            check(name + std::to_string(side) + ", normal along an axis", normal.cwiseAbs().maxCoeff(), 1, 1e-9);
        }
    }
}

// fcl#503: two meshes that share a face touch; their depth is 0.
void depth_of_touching_meshes() {
    const auto cube = model_of(models::box("cube", 2, 2, 2));
    const fcl::CollisionRequestd request(1000, true);
    fcl::CollisionResultd result;
    fcl::collide<double>(cube.get(), at(-1, 0, 0), cube.get(), at(1, 0, 0), request, result);
    double deepest = 0;
    for (std::size_t i = 0; i < result.numContacts(); ++i) {
        deepest = std::max(deepest, result.getContact(i).penetration_depth);
    }
    check("fcl#503 meshes that share a face meet", result.isCollision(), 1, 0);
    check("fcl#503 deepest contact", deepest, 0, 1e-9);
}

struct Way {
    const char *name;
    fcl::CCDMotionType type;
};

const Way ways[] = {{"translation", fcl::CCDM_TRANS}, {"linear", fcl::CCDM_LINEAR}, {"screw", fcl::CCDM_SCREW}};

double time_of_contact(const fcl::CollisionGeometryd *a, const Transform &a0, const Transform &a1, const fcl::CollisionGeometryd *b,
                       const Transform &b0, const Transform &b1, fcl::CCDMotionType type, fcl::CCDSolverType solver) {
    const fcl::ContinuousCollisionRequestd request(100, 1e-5, type, fcl::GST_LIBCCD, solver);
    fcl::ContinuousCollisionResultd result;
    fcl::continuousCollide(a, a0, a1, b, b0, b1, request, result);
    return result.is_collide ? static_cast<double>(result.time_of_contact) : -1;
}

// fcl#555, fcl#120: meshes that move against each other; python-fcl#11, #38: a box past a cone. -1 is "no contact".
void straight_motions() {
    const auto cube = model_of(models::box("cube", 2, 2, 2));
    const fcl::Boxd box(1, 2, 3);
    const fcl::Coned cone(1, 3);
    for (const fcl::CCDSolverType solver : {fcl::CCDC_NAIVE, fcl::CCDC_CONSERVATIVE_ADVANCEMENT}) {
        const std::string by = solver == fcl::CCDC_NAIVE ? ", naive" : ", conservative advancement";
        for (const Way &way : ways) {
            const Transform left = at(-4, 0, 0), right = at(4, 0, 0), middle = at(0, 0, 0);
            check("fcl#555 both meshes move, " + std::string(way.name) + by,
                  time_of_contact(cube.get(), left, right, cube.get(), right, left, way.type, solver), 0.375, 1e-4);
            check("fcl#555 one mesh moves, " + std::string(way.name) + by,
                  time_of_contact(cube.get(), left, right, cube.get(), middle, middle, way.type, solver), 0.25, 1e-4);
            check("python-fcl#38 box and cone, " + std::string(way.name) + by,
                  time_of_contact(&box, at(-10, 0, 0), at(10, 0, 0), &cone, middle, middle, way.type, solver), 0.425, 1e-4);
        }
    }
}

} // namespace

int main() {
    depth_of_cubes();
    depth_of_touching_meshes();
    straight_motions();
    std::printf("%d wrong\n", wrong);
#ifdef WITH_FCL
    return 0;
#else
    return wrong == 0 ? 0 : 1;
#endif
}
