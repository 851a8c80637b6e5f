// The Puma 560 and its workcell, as libcstk has them and with kinematics of our own.
#ifndef CSTK_FCL_PUMA_CELL_HPP
#define CSTK_FCL_PUMA_CELL_HPP

#include "fcl_common.hpp"

#include <fstream>

const int joints = 6;
const double contact_epsilon = 0.02;

// Standard Denavit-Hartenberg: turn by theta about z, shift d along z, shift a along x, turn by
// alpha about x.
struct Dh {
    double d, a, alpha;
};
const Dh dh[joints] = {
    {0.67183, 0, models::pi / 2}, {0, 0.4318, 0},          {0.15005, 0.0203, -models::pi / 2},
    {0.4318, 0, models::pi / 2},  {0, 0, -models::pi / 2}, {0, 0, 0}};

inline Pose product(const Pose &a, const Pose &b) {
    Pose out;
    for (int i = 0; i < 3; ++i) {
        for (int j = 0; j < 4; ++j) {
            double sum = j == 3 ? a.m[4 * i + 3] : 0;
            for (int k = 0; k < 3; ++k) {
                sum += a.m[4 * i + k] * b.m[4 * k + j];
            }
            out.m[4 * i + j] = sum;
        }
    }
    return out;
}

inline Pose turn_z(double theta) {
    Pose p;
    p.m[0] = p.m[5] = std::cos(theta);
    p.m[4] = std::sin(theta);
    p.m[1] = -p.m[4];
    return p;
}

// The part of a row that does not move.
inline Pose fixed_part(const Dh &row) {
    Pose p = translation(row.a, 0, row.d);
    p.m[5] = p.m[10] = std::cos(row.alpha);
    p.m[9] = std::sin(row.alpha);
    p.m[6] = -p.m[9];
    return p;
}

inline models::Mesh read_binary(std::ifstream &in) {
    char header[80];
    std::uint32_t count = 0;
    in.seekg(0).read(header, 80).read(reinterpret_cast<char *>(&count), 4);
    models::Mesh m;
    for (std::uint32_t i = 0; i < count && in; ++i) {
        float numbers[12];
        std::uint16_t attribute;
        in.read(reinterpret_cast<char *>(numbers), 48)
            .read(reinterpret_cast<char *>(&attribute), 2);
        models::Face f;
        for (int k = 1; k < 4; ++k) {
            f.push_back(m.vertex(numbers[3 * k], numbers[3 * k + 1], numbers[3 * k + 2]));
        }
        m.face(f);
    }
    return m;
}

inline models::Mesh read_ascii(std::ifstream &in) {
    in.seekg(0);
    models::Mesh m;
    models::Face f;
    for (std::string word; in >> word;) {
        double x, y, z;
        if (word == "vertex" && in >> x >> y >> z) {
            f.push_back(m.vertex(x, y, z));
        } else if (word == "endfacet") {
            m.face(f);
            f.clear();
        }
    }
    return m;
}

// The robot's meshes are of both kinds.
inline models::Mesh read_stl(const std::string &file, int number) {
    std::ifstream in(file, std::ios::binary);
    std::string first(5, ' ');
    in.read(&first[0], 5);
    models::Mesh m = first == "solid" ? read_ascii(in) : read_binary(in);
    m.name = "link" + std::to_string(number);
    return m;
}

// Our own forward kinematics: frame i, which carries the mesh of link i. Frame 0 is the world.
inline std::vector<Pose> frames_at(const double *q) {
    std::vector<Pose> out(1);
    for (int i = 0; i < joints; ++i) {
        out.push_back(product(out.back(), product(turn_z(q[i]), fixed_part(dh[i]))));
    }
    return out;
}

// The robot as libcstk has it: for each row a joint at the frame before, and behind it a fixed link
// with the mesh.
inline std::uint32_t mesh_link(std::size_t frame) { return static_cast<std::uint32_t>(2 * frame); }

struct Item {
    Body body;
    Pose pose;
    std::uint64_t id;
};

struct Cell {
    std::vector<Body> links;
    std::vector<std::string> files;
    std::vector<Item> objects;
    Handle<cstk_robot> robot;
    Handle<cstk_space> space;
    Handle<cstk_environment> environment;
    Handle<cstk_cobject> obstacles, self, both;
};

inline std::uint32_t add_link(cstk_robot_builder *builder, std::int32_t parent, std::int32_t joint,
                              const Pose &at, const cstk_body *body) {
    cstk_link_def def;
    must(cstk_link_def_default(&def, sizeof def));
    def.parent = parent;
    def.joint = joint;
    def.body = body;
    std::copy(at.m, at.m + 12, def.at);
    std::uint32_t number = 0;
    must(cstk_robot_builder_add_link(builder, &def, &number));
    return number;
}

inline void make_robot(Cell &cell) {
    cstk_robot_builder *raw = nullptr;
    must(cstk_robot_builder_create(3, &raw));
    const Handle<cstk_robot_builder> builder(raw);
    std::uint32_t last = add_link(raw, -1, CSTK_JOINT_FIXED, Pose(), cell.links[0].body.get());
    for (std::size_t i = 0; i < joints; ++i) {
        const std::uint32_t joint =
            add_link(raw, static_cast<std::int32_t>(last), CSTK_JOINT_REVOLUTE, Pose(), nullptr);
        last = add_link(raw, static_cast<std::int32_t>(joint), CSTK_JOINT_FIXED, fixed_part(dh[i]),
                        cell.links[i + 1].body.get());
    }
    cstk_robot *robot = nullptr;
    must(cstk_robot_build(raw, &robot));
    cell.robot.reset(robot);
    cstk_space *space = nullptr;
    must(cstk_space_create(&robot, 1, nullptr, 0, nullptr, &space));
    cell.space.reset(space);
}

inline void place(Cell &cell, models::Mesh mesh, const Pose &pose) {
    cell.objects.push_back({Body(std::move(mesh)), pose, 0});
    Item &item = cell.objects.back();
    cstk_environment_change change;
    must(cstk_environment_change_default(&change, sizeof change));
    change.kind = CSTK_CHANGE_ADD;
    change.body = item.body.body.get();
    std::copy(pose.m, pose.m + 12, change.pose);
    must(cstk_environment_apply(cell.environment.get(), &change, 1, &item.id, nullptr));
}

inline void make_workcell(Cell &cell) {
    cstk_environment *environment = nullptr;
    must(cstk_environment_create(&environment));
    cell.environment.reset(environment);
    cell.objects.reserve(6);
    place(cell, models::box("table", 0.6, 1.2, 0.05), translation(0.85, 0, 0.3));
    place(cell, models::box("post", 0.08, 0.08, 1.6), translation(-0.5, 0.6, 0.8));
    place(cell, models::box("post", 0.08, 0.08, 1.6), translation(-0.5, -0.6, 0.8));
    place(cell, models::box("crate", 0.3, 0.25, 0.2),
          product(translation(0.8, 0.3, 0.45), turn_z(0.4)));
    place(cell, models::cylinder("drum", 0.15, 0.5, 24), translation(0.1, -0.8, 0.9));
    place(cell, models::sphere("rock", 0.2, 20, 26, 0.18), translation(0.2, 0.7, 1.1));
}

using LinkPair = std::pair<std::size_t, std::size_t>;

// Links with at least two others between them: nearer ones touch by design.
inline std::vector<LinkPair> self_pairs() {
    std::vector<LinkPair> pairs;
    for (std::size_t i = 0; i <= joints; ++i) {
        for (std::size_t j = i + 3; j <= joints; ++j) {
            pairs.emplace_back(j, i);
        }
    }
    return pairs;
}

inline void make_cobjects(Cell &cell) {
    cstk_induced_options options;
    must(cstk_induced_options_default(&options, sizeof options));
    options.contact_epsilon = contact_epsilon;
    cstk_cobject *made = nullptr;
    // The base never moves: leave it to the self-collisions.
    std::vector<std::uint32_t> moving;
    for (std::size_t i = 1; i <= joints; ++i) {
        moving.push_back(mesh_link(i));
    }
    must(cstk_cobject_induced(cell.space.get(), moving.data(), moving.size(),
                              cell.environment.get(), nullptr, 0, &options, &made));
    cell.obstacles.reset(made);
    std::vector<std::uint32_t> pairs;
    for (const auto &[r, s] : self_pairs()) {
        pairs.push_back(mesh_link(r));
        pairs.push_back(mesh_link(s));
    }
    must(cstk_cobject_induced_links(cell.space.get(), pairs.data(), pairs.size() / 2, &options,
                                    &made));
    cell.self.reset(made);
    const cstk_cobject *parts[] = {cell.obstacles.get(), cell.self.get()};
    must(cstk_cobject_union(parts, 2, &made));
    cell.both.reset(made);
}

// Two bodies at their poses, and the names libcstk has for them.
struct Couple {
    const Body *r, *s;
    Pose pose_r, pose_s;
    std::uint32_t r_link, s_link;
    std::uint64_t s_object;
};

inline std::vector<Couple> couples(const Cell &cell, const std::vector<Pose> &frames,
                                   bool obstacles, bool self) {
    std::vector<Couple> out;
    for (std::size_t i = 1; obstacles && i <= joints; ++i) {
        for (const Item &o : cell.objects) {
            out.push_back(
                {&cell.links[i], &o.body, frames[i], o.pose, mesh_link(i), CSTK_NONE, o.id});
        }
    }
    if (self) {
        for (const auto &[r, s] : self_pairs()) {
            out.push_back({&cell.links[r], &cell.links[s], frames[r], frames[s], mesh_link(r),
                           mesh_link(s), 0});
        }
    }
    return out;
}

inline bool load_links(Cell &cell, const std::string &folder) {
    for (int i = 0; i <= joints; ++i) {
        const std::string file = folder + "/link" + std::to_string(i) + ".stl";
        if (!std::ifstream(file)) {
            std::printf("SKIPPED: Puma 560 meshes not available (%s)\n", file.c_str());
            return false;
        }
        cell.links.emplace_back(read_stl(file, i));
        cell.files.push_back(file);
    }
    return true;
}

#endif
