#include "scenes.hpp"

#include "built_in.hpp"

namespace {

// The plate, in metres: it stands on a radius of the arm's first joint.
const std::array<double, 3> plate_half = {0.35, 0.001, 0.5};
const std::array<double, 3> plate_center = {0.6, 0, 1};
// No point of the arm is farther from the first joint's axis, in metres.
const double arm_reach = 1.1;
// How far motions that meet the plate reach into it, in metres.
const double depth = 2e-4;
// Of a clearance, in metres.
const double clearance_tolerance = 1e-5;
// The first joint is turned by steps of so many radians until the motion is too near.
const double coarse_step = 0.04;

// A motion with its first joint turned.
Ends turned(Ends ends, double angle) {
    ends.q0[0] += angle;
    ends.q1[0] += angle;
    return ends;
}

// A random motion, turned about the first joint's axis towards the plate until its clearance is little more than `clearance`, or with
// a clearance of 0 until it reaches into the plate by about `depth`.
Scene::Draw beside(double clearance) {
    return [=](const Scene &scene, double length, Random &random) -> std::optional<Ends> {
        cstk::Query query;
        const cstk_motion_options options = cstk::motion_options(clearance);
        std::uint64_t state = random.next();
        const Numbers from = scene.space.sample(state), to = scene.space.sample(state);
        if (scene.space.distance(from, to) < length) {
            return {};
        }
        const Ends drawn =
            along(scene.space, from, scene.space.difference(from, to), length);
        const auto is_clear = [&](double angle) {
            const Ends at = turned(drawn, angle);
            return query.motion(scene.contact, at.q0, at.q1, options).outcome == CSTK_MOTION_FREE;
        };
        double clear = 0;
        if (!is_clear(clear)) {
            return {};
        }
        while (is_clear(clear + coarse_step)) {
            clear += coarse_step;
            if (clear > 2 * models::pi) {
                return {};
            }
        }
        double near = clear + coarse_step;
        while ((near - clear) * arm_reach > clearance_tolerance) {
            const double middle = 0.5 * (clear + near);
            (is_clear(middle) ? clear : near) = middle;
        }
        const Ends found = turned(drawn, clearance > 0 ? clear : near + depth / arm_reach);
        const bool in_limits =
            scene.space.within_limits(found.q0) && scene.space.within_limits(found.q1);
        return in_limits ? std::optional(found) : std::nullopt;
    };
}

} // namespace

void add_plate_scenes(const std::string &puma_folder, Scenes &scenes) {
    const std::size_t tries = 200;
    const cstk::Robot robot = problems::puma_560(puma_folder);
    const std::pair<const char *, double> clearances[] = {
        {"plate 1 mm beside", 1e-3}, {"plate 1 cm beside", 1e-2}, {"plate 10 cm beside", 0.1},
        {"plate 0.2 mm in", 0}};
    for (const auto &[name, clearance] : clearances) {
        const std::vector<Obstacle> plate = {problems::box(
            cstk::translation(plate_center[0], plate_center[1], plate_center[2]), plate_half)};
        scenes.push_back(std::make_unique<Scene>(name, robot, plate, std::vector<LinkPair>(),
                                                 tries, beside(clearance)));
    }
}
