// A second file that includes cstk/fcl.hpp: linking finds no function twice.
#include <cstk/fcl.hpp>

double distance_of_balls(double apart);

double distance_of_balls(double apart) {
    const cstk_fcl::Spheref ball(1);
    cstk_fcl::Transform3f there = cstk_fcl::Transform3f::Identity();
    there.translation().x() = static_cast<float>(apart);
    cstk_fcl::DistanceResultf result;
    return cstk_fcl::distance<float>(&ball, cstk_fcl::Transform3f::Identity(), &ball, there, cstk_fcl::DistanceRequestf(), result);
}
