// A Puma 560 in a workcell: the C-object queries of libcstk against FCL with kinematics of our own.
// The folder with the robot's meshes is the argument; without them the test is skipped.
#include "fcl_puma_cell.hpp"

#include <cstring>

namespace {

const double exact = 1e-12;
const double peer = 1e-9;

struct Peer {
    double distance = INFINITY;
    bool collides = false;
};

Peer ask_fcl(const Couple &c, double so_far) {
    const fcl::Transform3d tr = fcl_pose(c.pose_r), ts = fcl_pose(c.pose_s);
    fcl::DistanceRequestd request(true);
    request.rel_err = request.abs_err = 0;
    // A distance known already lets FCL stop early, which is fair to it.
    fcl::DistanceResultd result(so_far);
    fcl::distance<double>(c.r->fcl.get(), tr, c.s->fcl.get(), ts, request, result);
    return {result.min_distance, false};
}

bool fcl_collides(const Couple &c) {
    fcl::CollisionResultd result;
    const fcl::CollisionRequestd simple;
    fcl::collide<double>(c.r->fcl.get(), fcl_pose(c.pose_r), c.s->fcl.get(), fcl_pose(c.pose_s),
                         simple, result);
    return result.isCollision();
}

struct Run {
    explicit Run(const Cell &c) : cell(c) {}

    const Cell &cell;
    Tally tally;
    Handle<cstk_query> query = make_query();
    Stopwatch cstk_distance_time, cstk_within_time, fcl_distance_time, fcl_collide_time;
    long classes[3] = {0, 0, 0};
    long witness_sets = 0, witnesses = 0, truths = 0;
    double worst = 0, worst_fcl = 0;
};

// One configuration against one C-object.
class Visit {
  public:
    Visit(Run &run, const char *name, const cstk_cobject *cobject, const double *q,
          std::vector<Couple> all)
        : run_(run), name_(name), cobject_(cobject), q_(q), couples_(std::move(all)) {}

    void operator()(bool compare_sets) {
        ++run_.tally.poses;
        std::memset(&r_, 0, sizeof r_);
        run_.cstk_distance_time(
            [&] { must(cstk_distance(run_.query.get(), cobject_, q_, joints, INFINITY, &r_)); });
        expect(r_.kind == CSTK_DISTANCE_EXACT && r_.has_witness, "an exact distance with a witness");
        expect(r_.lower <= r_.distance && r_.distance <= r_.upper, "lower <= distance <= upper");
        compare_with_fcl();
        check_meeting();
        check_points();
        if (compare_sets) {
            check_witnesses();
        }
    }

  private:
    void expect(bool ok, const char *what) {
        run_.tally.expect(ok, what, [&] {
            std::printf("  C-object '%s', q = {", name_);
            for (int i = 0; i < joints; ++i) {
                std::printf("%s%.17g", i ? ", " : "", q_[i]);
            }
            std::printf("}\n    libcstk %.17g, FCL %.17g\n", r_.distance, f_.distance);
        });
    }

    // The couple that a witness names.
    const Couple *named(const cstk_witness &w) const {
        for (const Couple &c : couples_) {
            if (c.r_link == w.r_link && c.s_link == w.s_link && c.s_object == w.s_object) {
                return &c;
            }
        }
        return nullptr;
    }

    // The reach of the arm stands for L.
    static constexpr double size = 1.5;

    bool agree() const {
        return std::fabs(f_.distance - r_.distance) <= peer * size &&
               (f_.distance <= 0) == (r_.distance == 0) && f_.collides == (r_.distance == 0);
    }

    void compare_with_fcl() {
        run_.fcl_distance_time([&] {
            for (const Couple &c : couples_) {
                f_.distance = std::min(f_.distance, ask_fcl(c, f_.distance).distance);
            }
        });
        run_.fcl_collide_time([&] {
            for (std::size_t i = 0; !f_.collides && i < couples_.size(); ++i) {
                f_.collides = fcl_collides(couples_[i]);
            }
        });
        const Couple *mine = named(r_.witness);
        expect(mine, "the witness names a pair of the C-object");
        if (mine) {
            const double there = ask_fcl(*mine, std::numeric_limits<double>::max()).distance;
            expect(std::fabs(there - r_.distance) <= peer * size,
                   "the named pair is at the distance, says FCL");
        }
        if (agree()) {
            run_.worst_fcl = std::max(run_.worst_fcl, std::fabs(f_.distance - r_.distance));
        } else {
            judge();
        }
        if (!agree() || run_.tally.poses % 25 == 0) {
            const truth::Answer t = truth_of_all();
            const auto error = static_cast<double>(std::fabs(t.distance - r_.distance));
            run_.worst = std::max(run_.worst, error / size);
            expect(error <= exact * size, "distance is the truth within 1e-12 L");
            expect(r_.lower <= t.distance && t.distance <= r_.upper, "the bounds hold");
        }
    }

    truth::Answer truth_of_all() {
        ++run_.truths;
        truth::Answer best;
        for (const Couple &c : couples_) {
            const truth::Soup r = c.r->faces(c.pose_r, {0, 0, 0}),
                              s = c.s->faces(c.pose_s, {0, 0, 0});
            const truth::Real guess = std::min(best.distance, truth::Real{r_.distance + 1e-6});
            if (truth::apart(r.whole, s.whole) > guess) {
                continue;
            }
            // Beyond the guess the exact figure is of no use, and the search without one is long.
            const truth::Answer t = truth::distance_up_to(r, s, guess, peer * size);
            best.distance = std::min(best.distance, t.distance);
            best.depth = std::max(best.depth, t.depth);
        }
        return best;
    }

    void judge() {
        ++run_.tally.disagreements;
        const truth::Answer t = truth_of_all();
        const bool meets = r_.distance == 0;
        expect(meets ? t.distance <= exact * size : t.depth <= exact * size,
               "meeting is decided rightly");
        const bool touching = t.distance <= peer * size && t.depth <= peer * size;
        if (touching && std::fabs(f_.distance - static_cast<double>(t.distance)) <= peer * size) {
            ++run_.tally.ties;
        } else if (++run_.tally.fcl_wrong <= 6) {
            std::printf(
                "FCL is wrong: '%s', distance %.17g, collides %d; libcstk %.17g, truth %.17Lg\n",
                name_, f_.distance, f_.collides, r_.distance, t.distance);
        }
    }

    void check_meeting() {
        cstk_query *query = run_.query.get();
        cstk_class point_class = CSTK_CLASS_OUTSIDE, at_class = CSTK_CLASS_OUTSIDE;
        must(cstk_classify(query, cobject_, q_, joints, &point_class));
        const double d = r_.distance;
        const cstk_class expected = d == 0                 ? CSTK_CLASS_INSIDE
                                    : d <= contact_epsilon ? CSTK_CLASS_CONTACT
                                                           : CSTK_CLASS_OUTSIDE;
        expect(point_class == expected, "the class is that of the distance");
        ++run_.classes[expected];

        bool yes = false;
        run_.cstk_within_time([&] { must(cstk_within(query, cobject_, q_, joints, 0, &yes)); });
        expect(yes == (d == 0), "within 0 exactly when inside");
        must(cstk_within(query, cobject_, q_, joints, d + 1e-11, &yes));
        expect(yes, "within a little more than the distance");
        if (d > 1e-11) {
            must(cstk_within(query, cobject_, q_, joints, d - 1e-11, &yes));
            expect(!yes, "not within a little less");
        }

        // With our own kinematics; the joints' frames carry nothing and may be anywhere.
        const std::vector<Pose> frames = frames_at(q_);
        std::vector<Pose> poses(2 * frames.size() - 1);
        for (std::size_t i = 0; i < frames.size(); ++i) {
            poses[mesh_link(i)] = frames[i];
        }
        cstk_distance_result at;
        std::memset(&at, 0, sizeof at);
        must(cstk_distance_at_link_poses(query, cobject_, poses[0].m, poses.size(), INFINITY, &at));
        expect(std::fabs(at.distance - d) <= 1e-12, "the same distance with our own kinematics");
        must(cstk_classify_at_link_poses(query, cobject_, poses[0].m, poses.size(), &at_class));
        expect(at_class == point_class || std::min(d, std::fabs(d - contact_epsilon)) < 1e-12,
               "the same class with our own kinematics");

        const Handle<cstk_query> fresh = make_query();
        std::memset(&at, 0, sizeof at);
        must(cstk_distance(fresh.get(), cobject_, q_, joints, INFINITY, &at));
        expect(std::memcmp(&at, &r_, sizeof at) == 0, "a fresh context answers the same bits");
    }

    void check_points() {
        const Couple *c = named(r_.witness);
        if (!c) {
            return;
        }
        const truth::V p = point(r_.r_point, {0, 0, 0}), s = point(r_.s_point, {0, 0, 0});
        expect(std::fabs(truth::length(p - s) - r_.distance) <= exact * size,
               "the points are that far apart");
        expect(off(*c->r, c->pose_r, r_.witness.r_tag, p) <= 2 * exact, "point on the link's face");
        expect(off(*c->s, c->pose_s, r_.witness.s_tag, s) <= 2 * exact, "point on the other face");
    }

    // How far a point is from a face: triangles only, but for the caps and sides of generated
    // bodies.
    static truth::Real off(const Body &body, const Pose &pose, std::uint64_t face, truth::V p) {
        const truth::Frame frame(pose.m, {0, 0, 0});
        truth::Real best = truth::infinity;
        for (std::size_t i = 0; i < body.mesh.triangles.size(); ++i) {
            if (body.mesh.face_of[i] == face) {
                const models::Triangle &t = body.mesh.triangles[i];
                best = std::min(best,
                                truth::point_triangle(p, {frame(body.mesh.vertices[t[0]].data()),
                                                          frame(body.mesh.vertices[t[1]].data()),
                                                          frame(body.mesh.vertices[t[2]].data())}));
            }
        }
        return best;
    }

    // Everything within a little more than the distance, against brute force.
    void check_witnesses() {
        const double epsilon = r_.distance + 0.002;
        cstk_witness_list list;
        must(cstk_witnesses(run_.query.get(), cobject_, q_, joints, epsilon, 10000000, &list));
        ++run_.witness_sets;
        run_.witnesses += static_cast<long>(list.witness_count);
        expect(!list.truncated && list.witness_count > 0, "all witnesses");
        expect(list.witness_count > 0 && list.witnesses[0].distance == r_.distance,
               "the nearest has the distance");
        std::map<const Couple *, std::map<truth::Labels, double>> given;
        bool names = true, once = true, sorted = true;
        for (std::size_t i = 0; i < list.witness_count; ++i) {
            const cstk_witness &w = list.witnesses[i];
            const Couple *c = named(w);
            names = names && c;
            once =
                given[c].emplace(truth::Labels{w.r_primitive, w.s_primitive}, w.distance).second &&
                once;
            sorted = sorted && (i == 0 || w.distance >= list.witnesses[i - 1].distance);
        }
        expect(names, "witnesses name pairs of the C-object");
        expect(once, "no witness is given twice");
        expect(sorted, "nearest first");
        for (const Couple &c : couples_) {
            compare_set(c, given[&c], epsilon);
        }
    }

    void compare_set(const Couple &c, const std::map<truth::Labels, double> &given,
                     double epsilon) {
        const truth::Soup r = c.r->by_primitive(c.pose_r, {0, 0, 0}),
                          s = c.s->by_primitive(c.pose_s, {0, 0, 0});
        const double slack = exact * size;
        bool right = true, complete = true;
        std::size_t found = 0;
        for (const auto &[labels, distance] : truth::within(r, s, epsilon + slack)) {
            const auto it = given.find(labels);
            complete = complete && (it != given.end() || distance > epsilon - slack);
            right = right && (it == given.end() || std::fabs(it->second - distance) <= slack);
            found += it != given.end();
        }
        expect(complete, "no witness is missing");
        expect(right && found == given.size(), "every witness has its true distance");
    }

    Run &run_;
    const char *name_;
    const cstk_cobject *cobject_;
    const double *q_;
    std::vector<Couple> couples_;
    cstk_distance_result r_;
    Peer f_;
};

void check_kinematics(Run &run, const double *q) {
    const std::vector<Pose> frames = frames_at(q);
    for (std::size_t i = 0; i < frames.size(); ++i) {
        Pose p;
        must(cstk_robot_link_pose(run.cell.robot.get(), q, joints, mesh_link(i), p.m));
        double most = 0;
        for (int k = 0; k < 12; ++k) {
            most = std::max(most, std::fabs(p.m[k] - frames[i].m[k]));
        }
        run.tally.expect(most <= exact, "forward kinematics", [&] { print_pose("pose", p); });
    }
}

// The library's own reader must find the same surface, as far as single precision tells.
void check_reader(Run &run, const Body &link, const std::string &file) {
    cstk_body_builder *raw = nullptr;
    must(cstk_body_builder_create(3, &raw));
    const Handle<cstk_body_builder> builder(raw);
    must(cstk_body_builder_add_mesh_file(raw, file.c_str(), nullptr, nullptr));
    cstk_body *made = nullptr;
    must(cstk_body_build(raw, nullptr, nullptr, nullptr, &made));
    const Handle<cstk_body> body(made);
    cstk_body_statistics theirs, ours;
    must(cstk_body_get_statistics(made, &theirs));
    must(cstk_body_get_statistics(link.body.get(), &ours));
    bool same = theirs.primitive_count == ours.primitive_count &&
                theirs.faces_dropped == ours.faces_dropped;
    for (int k = 0; k < 3; ++k) {
        same = same && std::fabs(theirs.low[k] - ours.low[k]) <= 1e-6 &&
               std::fabs(theirs.high[k] - ours.high[k]) <= 1e-6;
    }
    run.tally.expect(same, "the mesh file reads as it should",
                     [&] { std::printf("  %s\n", file.c_str()); });
}

} // namespace

int main(int argc, char **argv) {
    Cell cell;
    if (!load_links(cell, argc > 1 ? argv[1] : ".")) {
        // A build that is to prove something must not pass for want of data.
        const char *ci = std::getenv("CI");
        return ci && std::string(ci) == "true" ? 1 : 77;
    }
    Run run(cell);
    for (std::size_t i = 0; i < cell.links.size(); ++i) {
        const Body &b = cell.links[i];
        check_reader(run, b, cell.files[i]);
        std::printf("%s %zu triangles, %zu primitives; ", b.mesh.name.c_str(),
                    b.mesh.triangles.size(), b.primitives.size());
    }
    std::printf("\n");
    make_robot(cell);
    make_workcell(cell);
    make_cobjects(cell);
    models::Random random(560);
    for (int number = 0; number < 2000; ++number) {
        double q[joints];
        for (double &c : q) {
            c = random.uniform(-models::pi, models::pi);
        }
        check_kinematics(run, q);
        const std::vector<Pose> frames = frames_at(q);
        Visit(run, "obstacles", cell.obstacles.get(), q,
              couples(cell, frames, true, false))(number % 40 == 0);
        if (number % 4 == 0) {
            Visit(run, "self", cell.self.get(), q,
                  couples(cell, frames, false, true))(number % 80 == 0);
            Visit(run, "both", cell.both.get(), q,
                  couples(cell, frames, true, true))(number % 160 == 0);
        }
    }
    std::printf("outside %ld, contact %ld, inside %ld; brute force: %ld; witness sets: %ld, %ld "
                "witnesses; largest "
                "error of libcstk %.2g L; agreeing with FCL within %.2g\n",
                run.classes[CSTK_CLASS_OUTSIDE], run.classes[CSTK_CLASS_CONTACT], run.classes[CSTK_CLASS_INSIDE],
                run.truths, run.witness_sets, run.witnesses, run.worst, run.worst_fcl);
    std::printf("median us: distance libcstk %.1f, FCL %.1f; meeting libcstk %.1f, FCL %.1f\n",
                run.cstk_distance_time.median(), run.fcl_distance_time.median(),
                run.cstk_within_time.median(), run.fcl_collide_time.median());
    return run.tally.finish("fcl_puma");
}
