// The paths that the slider example took keep clear of the obstacles, by FCL and by kinematics of
// our own: at every step, and at nine points between each two. Usage: fcl_slide FOLDER_OF_PATHS
// MODELS [PUMA560_MESHES]
#include "fcl_puma_cell.hpp"

#include <sstream>

namespace {

// A mesh with what FCL needs of it, and its pose.
struct Part {
    Body body;
    Pose pose;
};

// One configuration of a path: coordinates, then the distance libcstk found there.
using Row = std::vector<double>;

std::vector<Row> read_path(const std::string &file) {
    std::ifstream in(file);
    std::vector<Row> rows;
    for (std::string line; std::getline(in, line);) {
        std::istringstream fields(line);
        rows.emplace_back();
        for (std::string field; std::getline(fields, field, ',');) {
            rows.back().push_back(std::stod(field));
        }
    }
    return rows;
}

models::Mesh read_obj(const std::string &file) {
    std::ifstream in(file);
    models::Mesh m;
    m.name = file;
    for (std::string line; std::getline(in, line);) {
        std::istringstream fields(line);
        std::string kind;
        fields >> kind;
        if (kind == "v") {
            double x, y, z;
            fields >> x >> y >> z;
            m.vertex(x, y, z);
        } else if (kind == "f") {
            models::Face face;
            for (std::uint32_t i; fields >> i;) {
                face.push_back(i - 1);
            }
            m.face(face);
        }
    }
    return m;
}

// Yaw about y, pitch about the new z, roll about the new x: equations (3) to (5) of the report, one
// after the other.
Pose euler(double x, double y, double z, double yaw, double pitch, double roll) {
    Pose turn_y, turn_x;
    turn_y.m[0] = turn_y.m[10] = std::cos(yaw);
    turn_y.m[2] = std::sin(yaw);
    turn_y.m[8] = -turn_y.m[2];
    turn_x.m[5] = turn_x.m[10] = std::cos(roll);
    turn_x.m[9] = std::sin(roll);
    turn_x.m[6] = -turn_x.m[9];
    return product(translation(x, y, z), product(turn_y, product(turn_z(pitch), turn_x)));
}

// The links' frames of the arm of Appendix A.
std::vector<Pose> appendix_frames(const double *q) {
    const Pose at[3] = {Pose(), euler(0, 2.875, 0, 0, 0, models::pi / 2),
                        translation(6.5, 0, -2.125)};
    std::vector<Pose> frames;
    Pose frame;
    for (int i = 0; i < 3; ++i) {
        frame = product(frame, product(at[i], turn_z(q[i])));
        frames.push_back(frame);
    }
    return frames;
}

std::vector<Pose> puma560_frames(const double *q) {
    std::vector<Pose> frames = frames_at(q);
    frames.erase(frames.begin());
    return frames;
}

struct Scene {
    const char *name;
    std::vector<Body> links;
    std::vector<Part> obstacles;
    std::vector<Pose> (*frames)(const double *q);
};

double fcl_distance(const Scene &scene, const double *q) {
    const std::vector<Pose> frames = scene.frames(q);
    double least = INFINITY;
    for (std::size_t i = 0; i < scene.links.size(); ++i) {
        for (const Part &obstacle : scene.obstacles) {
            const fcl::Transform3d r = fcl_pose(frames[i]), s = fcl_pose(obstacle.pose);
            const FclMesh *link = scene.links[i].fcl.get(), *other = obstacle.body.fcl.get();
            fcl::DistanceRequestd request;
            fcl::DistanceResultd result;
            fcl::distance<double>(link, r, other, s, request, result);
            fcl::CollisionRequestd simple;
            fcl::CollisionResultd hit;
            fcl::collide<double>(link, r, other, s, simple, hit);
            least = std::min(least, hit.isCollision() ? 0 : result.min_distance);
        }
    }
    return least;
}

// Returns the number of faults.
int check_path(const Scene &scene, const std::string &folder) {
    const std::vector<Row> path = read_path(folder + "/" + scene.name + ".csv");
    if (path.size() < 61) {
        std::printf("FAILED: the path of %s has %zu rows\n", scene.name, path.size());
        return 1;
    }
    const std::size_t nq = path[0].size() - 1;
    int faults = 0;
    double least = INFINITY;
    for (std::size_t k = 0; k < path.size(); ++k) {
        const double mine = path[k][nq], theirs = fcl_distance(scene, path[k].data());
        if (!(theirs > 0) || std::fabs(mine - theirs) > 1e-9) {
            std::printf("FAILED: %s step %zu: libcstk %.17g, FCL %.17g\n", scene.name, k, mine,
                        theirs);
            ++faults;
        }
        for (int part = 1; k > 0 && part < 10; ++part) {
            Row q(nq);
            for (std::size_t i = 0; i < nq; ++i) {
                q[i] = path[k - 1][i] + (path[k][i] - path[k - 1][i]) * part / 10;
            }
            const double between = fcl_distance(scene, q.data());
            least = std::min(least, between);
            if (!(between > 0)) {
                std::printf("FAILED: %s hits between steps %zu and %zu\n", scene.name, k - 1, k);
                ++faults;
            }
        }
    }
    std::printf("%s: %zu configurations and 9 between each two are clear by FCL; least %.4g\n",
                scene.name, path.size(), least);
    return faults;
}

} // namespace

int main(int argc, char **argv) {
    if (argc < 3) {
        std::printf("usage: fcl_slide FOLDER_OF_PATHS MODELS [PUMA560_MESHES]\n");
        return 2;
    }
    const std::string folder = argv[1], path = std::string(argv[2]) + "/";
    Scene appendix = {"appendix", {}, {}, appendix_frames};
    for (const char *file : {"puma_shoulder.obj", "puma_upper_arm.obj", "puma_forearm.obj"}) {
        appendix.links.emplace_back(read_obj(path + file));
    }
    appendix.obstacles.push_back(
        {Body(read_obj(path + "cylinder.obj")), euler(9.27, 10.06, -2.44, 1.11, 0.88, -0.8)});
    int faults = check_path(appendix, folder);
    if (argc > 3) {
        Scene puma = {"puma560", {}, {}, puma560_frames};
        for (int i = 1; i <= joints; ++i) {
            puma.links.emplace_back(
                read_stl(std::string(argv[3]) + "/link" + std::to_string(i) + ".stl", i));
        }
        puma.obstacles.push_back(
            {Body(models::box("table", 0.9, 1.4, 0.04)), translation(0.75, 0, 0.3)});
        puma.obstacles.push_back(
            {Body(models::box("post", 0.1, 0.1, 0.9)), euler(0.66, 0.08, 0.94, -0.8, -0.14, 0.91)});
        puma.obstacles.push_back(
            {Body(models::box("crate", 0.2, 0.2, 0.2)), translation(0.9, -0.35, 0.42)});
        puma.obstacles.push_back(
            {Body(models::box("shelf", 0.8, 0.3, 0.03)), translation(-0.6, 0.7, 1.1)});
        faults += check_path(puma, folder);
    }
    return faults == 0 ? 0 : 1;
}
