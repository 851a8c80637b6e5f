#include "picture.hpp"

#include "shorten.hpp"

void draw_path(const problems::Workcell &workcell, const std::vector<problems::Configuration> &path, std::size_t places,
               const std::string &file) {
    const cstk::Space &space = workcell.space;
    cstk::Environment environment;
    for (const problems::Obstacle &obstacle : workcell.obstacles) {
        environment.add(obstacle.body, obstacle.pose);
    }
    const double step = rrt_connect::length(space, path) / static_cast<double>(places);
    double away = step;
    for (std::size_t i = 0; i + 1 < path.size(); ++i) {
        const double edge = space.distance(path[i], path[i + 1]);
        for (; away <= edge; away += step) {
            const std::vector<cstk::Pose> poses = space.link_poses(space.interpolate(path[i], path[i + 1], away / edge));
            for (const std::uint32_t link : workcell.moving) {
                environment.add(workcell.robots.front().body(link), poses[link]);
            }
        }
        away -= edge;
    }
    cstk::CObject::induced(space, environment).show(path.front(), file);
}
