// Random slides: random robots among random obstacles are sent along random steps, up to 500 each.
// FCL and kinematics of our own judge every configuration reached and the one halfway to it. Where
// the slide reports blocked, 2,000 random directions at the floor step are tried: none may be free,
// keep the stand-off and gain more than the tolerance that the header states, a hundredth of its
// length. Usage: fcl_slides [SLIDES [SEED]]
#include "fcl_common.hpp"

namespace {

using Vector = std::vector<double>;

const int most_steps = 500, directions = 2000;
const double tolerance = 0.01;

Pose product(const Pose &a, const Pose &b) {
    Pose c;
    for (int i = 0; i < 3; ++i) {
        for (int j = 0; j < 4; ++j) {
            double sum = j == 3 ? a.m[4 * i + 3] : 0;
            for (int k = 0; k < 3; ++k) {
                sum += a.m[4 * i + k] * b.m[4 * k + j];
            }
            c.m[4 * i + j] = sum;
        }
    }
    return c;
}

Pose turn_z(double angle) {
    Pose p;
    p.m[0] = p.m[5] = std::cos(angle);
    p.m[4] = std::sin(angle);
    p.m[1] = -p.m[4];
    return p;
}

// x, y, z and a quaternion x, y, z, w.
Pose placement(const double *q) {
    double n = 0;
    for (int i = 3; i < 7; ++i) {
        n += q[i] * q[i];
    }
    n = std::sqrt(n);
    const double x = q[3] / n, y = q[4] / n, z = q[5] / n, w = q[6] / n;
    Pose p = translation(q[0], q[1], q[2]);
    const double r[9] = {1 - 2 * (y * y + z * z), 2 * (x * y - z * w),     2 * (x * z + y * w),
                         2 * (x * y + z * w),     1 - 2 * (x * x + z * z), 2 * (y * z - x * w),
                         2 * (x * z - y * w),     2 * (y * z + x * w),     1 - 2 * (x * x + y * y)};
    for (int i = 0; i < 9; ++i) {
        p.m[4 * (i / 3) + i % 3] = r[i];
    }
    return p;
}

struct Link {
    const Body *body;
    int parent;
    cstk_joint_kind joint;
    Pose at;
};

std::size_t nq_of(cstk_joint_kind joint) {
    return joint == CSTK_JOINT_FREE ? 7 : joint == CSTK_JOINT_PLANAR ? 3 : 1;
}

std::size_t nv_of(cstk_joint_kind joint) { return joint == CSTK_JOINT_FREE ? 6 : nq_of(joint); }

// A robot among obstacles, as libcstk has it and as FCL sees it.
struct Scene {
    std::vector<Link> links;
    std::vector<std::pair<const Body *, Pose>> obstacles;
    std::size_t nq = 0, nv = 0;
    Handle<cstk_space> space;
    Handle<cstk_cobject> cobject;

    std::vector<Pose> frames(const double *q) const {
        std::vector<Pose> found;
        for (const Link &link : links) {
            Pose motion;
            switch (link.joint) {
            case CSTK_JOINT_REVOLUTE:
                motion = turn_z(q[0]);
                break;
            case CSTK_JOINT_PRISMATIC:
                motion = translation(0, 0, q[0]);
                break;
            case CSTK_JOINT_PLANAR:
                motion = product(translation(q[0], q[1], 0), turn_z(q[2]));
                break;
            default:
                motion = placement(q);
            }
            const Pose at = product(link.at, motion);
            found.push_back(link.parent < 0 ? at : product(found[std::size_t(link.parent)], at));
            q += nq_of(link.joint);
        }
        return found;
    }

    // q moved by a small v; the free joint's velocity is in its own frame.
    Vector moved(const Vector &q, const Vector &v) const {
        Vector to = q;
        const double *velocity = v.data();
        double *own = to.data();
        for (const Link &link : links) {
            if (link.joint == CSTK_JOINT_FREE) {
                const Pose here = placement(own);
                for (int i = 0; i < 3; ++i) {
                    for (int j = 0; j < 3; ++j) {
                        own[i] += here.m[4 * i + j] * velocity[j];
                    }
                }
                const double x = own[3], y = own[4], z = own[5], w = own[6];
                const double a = velocity[3] / 2, b = velocity[4] / 2, c = velocity[5] / 2;
                own[3] = x + w * a + y * c - z * b;
                own[4] = y + w * b + z * a - x * c;
                own[5] = z + w * c + x * b - y * a;
                own[6] = w - x * a - y * b - z * c;
                double n = 0;
                for (int i = 3; i < 7; ++i) {
                    n += own[i] * own[i];
                }
                for (int i = 3; i < 7; ++i) {
                    own[i] /= std::sqrt(n);
                }
            } else {
                for (std::size_t i = 0; i < nv_of(link.joint); ++i) {
                    own[i] += velocity[i];
                }
            }
            own += nq_of(link.joint);
            velocity += nv_of(link.joint);
        }
        return to;
    }

    bool collides(const Vector &q) const {
        const std::vector<Pose> poses = frames(q.data());
        for (std::size_t i = 0; i < links.size(); ++i) {
            for (const auto &[body, pose] : obstacles) {
                fcl::CollisionRequestd request;
                fcl::CollisionResultd result;
                fcl::collide<double>(links[i].body->fcl.get(), fcl_pose(poses[i]), body->fcl.get(),
                                     fcl_pose(pose), request, result);
                if (result.isCollision()) {
                    return true;
                }
            }
        }
        return false;
    }

    // Of the pairs named; all pairs if none are.
    double distance(const Vector &q,
                    const std::vector<std::pair<std::size_t, std::size_t>> &pairs) const {
        const std::vector<Pose> poses = frames(q.data());
        double least = INFINITY;
        for (const auto &[i, k] : pairs) {
            fcl::DistanceRequestd request;
            fcl::DistanceResultd result;
            fcl::distance<double>(links[i].body->fcl.get(), fcl_pose(poses[i]),
                                  obstacles[k].first->fcl.get(), fcl_pose(obstacles[k].second),
                                  request, result);
            least = std::min(least, result.min_distance);
        }
        return least;
    }

    std::vector<std::pair<std::size_t, std::size_t>> pairs_within(const Vector &q,
                                                                  double reach) const {
        std::vector<std::pair<std::size_t, std::size_t>> found;
        for (std::size_t i = 0; i < links.size(); ++i) {
            for (std::size_t k = 0; k < obstacles.size(); ++k) {
                if (distance(q, {{i, k}}) <= reach) {
                    found.emplace_back(i, k);
                }
            }
        }
        return found;
    }
};

Pose random_pose(models::Random &random, double reach) {
    Pose p = random_rotation(random);
    for (int i = 0; i < 3; ++i) {
        p.m[4 * i + 3] = random.uniform(-reach, reach);
    }
    return p;
}

// An arm of one to four links, a free body, or a body on a plane with an arm.
std::vector<Link> random_robot(models::Random &random, const std::vector<Body> &bodies) {
    std::vector<Link> links;
    const auto body = [&] { return &bodies[random.below(bodies.size())]; };
    switch (random.below(4)) {
    case 0:
        return {{body(), -1, CSTK_JOINT_FREE, Pose()}};
    case 1:
        links.push_back({body(), -1, CSTK_JOINT_PLANAR, random_pose(random, 0.5)});
        break;
    default:
        links.push_back({body(), -1, CSTK_JOINT_REVOLUTE, random_pose(random, 0.5)});
    }
    for (std::size_t more = random.below(4); more > 0; --more) {
        const auto joint = random.below(3) == 0 ? CSTK_JOINT_PRISMATIC : CSTK_JOINT_REVOLUTE;
        links.push_back({body(), int(links.size()) - 1, joint, random_pose(random, 1.2)});
    }
    return links;
}

void make(Scene &scene) {
    cstk_robot_builder *builder = nullptr;
    must(cstk_robot_builder_create(3, &builder));
    const Handle<cstk_robot_builder> keep(builder);
    for (const Link &link : scene.links) {
        cstk_link_def def;
        must(cstk_link_def_default(&def, sizeof def));
        def.body = link.body->body.get();
        def.parent = link.parent;
        def.joint = link.joint;
        std::copy(link.at.m, link.at.m + 12, def.at);
        must(cstk_robot_builder_add_link(builder, &def, nullptr));
    }
    cstk_robot *robot = nullptr;
    must(cstk_robot_build(builder, &robot));
    const Handle<cstk_robot> keep_robot(robot);
    cstk_space *space = nullptr;
    must(cstk_space_create(&robot, 1, nullptr, 0, nullptr, &space));
    scene.space.reset(space);
    must(cstk_space_get_size(space, &scene.nq, &scene.nv, nullptr));
    cstk_environment *environment = nullptr;
    must(cstk_environment_create(&environment));
    const Handle<cstk_environment> keep_environment(environment);
    for (const auto &[body, pose] : scene.obstacles) {
        cstk_environment_change change;
        must(cstk_environment_change_default(&change, sizeof change));
        change.kind = CSTK_CHANGE_ADD;
        change.body = body->body.get();
        std::copy(pose.m, pose.m + 12, change.pose);
        must(cstk_environment_apply(environment, &change, 1, nullptr, nullptr));
    }
    cstk_cobject *cobject = nullptr;
    must(cstk_cobject_induced(space, nullptr, 0, environment, nullptr, 0, nullptr, &cobject));
    scene.cobject.reset(cobject);
}

struct Totals {
    long slides = 0, moved = 0, blocked = 0, inside = 0, hits = 0, ways_out = 0, turned_back = 0;
    double length = 0, asked = 0, seconds = 0, nearest = INFINITY;
};

double norm(const Vector &v) {
    double sum = 0;
    for (const double x : v) {
        sum += x * x;
    }
    return std::sqrt(sum);
}

double dot(const Vector &a, const Vector &b) {
    double sum = 0;
    for (std::size_t i = 0; i < a.size(); ++i) {
        sum += a[i] * b[i];
    }
    return sum;
}

Vector random_direction(models::Random &random, std::size_t n) {
    Vector v(n);
    double length = 0;
    do {
        for (double &x : v) {
            // A sum of uniform numbers is round enough.
            x = 0;
            for (int i = 0; i < 6; ++i) {
                x += random.uniform(-1, 1);
            }
        }
        length = norm(v);
    } while (length < 1e-3);
    for (double &x : v) {
        x /= length;
    }
    return v;
}

// Looks for a way on that the slide did not see.
bool has_way_out(const Scene &scene, const Vector &q, const Vector &step,
                 const cstk_slide_options &options, models::Random &random, double *best) {
    const double length = norm(step), h = options.floor * length;
    const double desired =
        options.desired_distance < 0 ? options.max_shell / 10 : options.desired_distance;
    const auto near = scene.pairs_within(q, desired + 50 * h);
    const double keep = std::min(desired, scene.distance(q, near));
    bool found = false;
    for (int i = 0; i < directions; ++i) {
        Vector u = random_direction(random, scene.nv);
        const double gain = dot(u, step) / length;
        if (gain <= std::max(tolerance, *best)) {
            continue;
        }
        for (double &x : u) {
            x *= h;
        }
        const Vector to = scene.moved(q, u);
        if (scene.distance(to, near) >= keep && !scene.collides(to)) {
            found = true;
            *best = gain;
        }
    }
    return found;
}

void slide(const Scene &scene, Vector q, const Vector &step, const cstk_slide_options &options,
           models::Random &random, Totals &totals, int number) {
    const Handle<cstk_query> query = make_query();
    Vector last(scene.nv, 0.0), between(scene.nv), half(scene.nq), next(scene.nq);
    ++totals.slides;
    for (int k = 0; k < most_steps; ++k) {
        cstk_slide_result result;
        const auto start = std::chrono::steady_clock::now();
        must(cstk_slide(query.get(), scene.cobject.get(), q.data(), q.size(), step.data(),
                        step.size(), &options, next.data(), &result));
        totals.seconds +=
            std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
        if (result.outcome == CSTK_SLIDE_INSIDE) {
            ++totals.inside;
            std::printf("FAILED: slide %d is inside at step %d\n", number, k);
            return;
        }
        if (result.outcome == CSTK_SLIDE_BLOCKED) {
            ++totals.blocked;
            double best = 0;
            if (has_way_out(scene, q, step, options, random, &best)) {
                ++totals.ways_out;
                std::printf("FAILED: slide %d is blocked at step %d (distance %.6g, shell %g, "
                            "%u contacts, nv %zu), but a way gains %.4f\n",
                            number, k, result.distance_before, options.max_shell,
                            result.contact_count, scene.nv, best);
            }
            return;
        }
        ++totals.moved;
        must(cstk_space_difference(scene.space.get(), q.data(), next.data(), q.size(),
                                   between.data()));
        must(cstk_space_interpolate(scene.space.get(), q.data(), next.data(), q.size(), 0.5,
                                    half.data()));
        totals.length += norm(between);
        totals.asked += norm(step);
        totals.turned_back += dot(between, last) < -0.25 * norm(between) * norm(last);
        last = between;
        totals.nearest = std::min(totals.nearest, result.distance_after);
        if (scene.collides(next) || scene.collides(half)) {
            ++totals.hits;
            std::printf("FAILED: slide %d collides at step %d by FCL; distance %.3g\n", number, k,
                        result.distance_after);
            return;
        }
        q = next;
    }
}

} // namespace

int main(int argc, char **argv) {
    const int slides = argc > 1 ? std::atoi(argv[1]) : 1000;
    const std::uint64_t seed = argc > 2 ? std::strtoull(argv[2], nullptr, 10) : 1;
    std::vector<Body> bodies;
    for (models::Mesh &mesh : models::all()) {
        if (mesh.vertices.size() < 400 && mesh.name != "disc" && mesh.name != "needle") {
            bodies.emplace_back(std::move(mesh));
        }
    }
    Totals totals;
    // A scene whose robot finds no free place is passed over.
    for (int number = 0; totals.slides < slides; ++number) {
        models::Random random(seed * 1000003 + std::uint64_t(number));
        Scene scene;
        scene.links = random_robot(random, bodies);
        for (std::size_t i = 2 + random.below(7); i > 0; --i) {
            scene.obstacles.emplace_back(
                &bodies[random.below(bodies.size())],
                random.below(4) == 0
                    ? product(random_quarter_turn(random),
                              translation(random.uniform(-2.5, 2.5), random.uniform(-2.5, 2.5),
                                          random.uniform(-2.5, 2.5)))
                    : random_pose(random, 2.5));
        }
        make(scene);
        Vector q(scene.nq);
        int tries = 0;
        do {
            Vector v = random_direction(random, scene.nv);
            const double far = random.uniform(0, 4);
            for (double &x : v) {
                x *= far;
            }
            Vector neutral(scene.nq);
            must(cstk_space_get_neutral(scene.space.get(), neutral.data()));
            must(cstk_space_step(scene.space.get(), neutral.data(), neutral.size(), v.data(),
                                 v.size(), q.data()));
        } while (scene.collides(q) && ++tries < 200);
        if (tries == 200) {
            continue;
        }
        Vector step = random_direction(random, scene.nv);
        const double length = std::pow(10, random.uniform(-2.3, -0.7));
        for (double &x : step) {
            x *= length;
        }
        cstk_slide_options options;
        must(cstk_slide_options_default(&options, sizeof options));
        options.max_shell = std::pow(10, random.uniform(-1.7, -0.3));
        options.normalize = random.below(2) == 1;
        slide(scene, q, step, options, random, totals, number);
        if (totals.slides % 100 == 0) {
            std::printf("%ld slides: %ld steps, %ld blocked\n", totals.slides, totals.moved,
                        totals.blocked);
            std::fflush(stdout);
        }
    }
    std::printf("fcl_slides: %ld slides, %ld steps taken, %.1f us each; %ld ended blocked, %ld "
                "inside; %ld collide by FCL, %ld blocked with a way on; path %.4g of %.4g asked; "
                "%ld steps turn back; nearest %.3g\n",
                totals.slides, totals.moved, 1e6 * totals.seconds / double(totals.moved),
                totals.blocked, totals.inside, totals.hits, totals.ways_out, totals.length,
                totals.asked, totals.turned_back, totals.nearest);
    return totals.hits + totals.ways_out + totals.inside == 0 ? 0 : 1;
}
