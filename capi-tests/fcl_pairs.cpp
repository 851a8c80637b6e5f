// Pairs of bodies at 20,000 poses and more: libcstk against FCL, and both against the truth
// wherever they differ, touch or nearly touch. A failure prints the names of the bodies and the
// poses, which reproduce it.
#include "fcl_cases.hpp"
#include "fcl_common.hpp"
#include "fcl_witnesses.hpp"

#include <cstring>

namespace {

// Lengths are compared relative to L, the pair's largest coordinate seen from body a.
const double exact = 1e-12;
const double peer = 1e-9;

struct Scene {
    const Body *a;
    const Body *b;
    Pose pose_a, pose_b;
    const char *stratum;
};

struct Stratum {
    const char *name;
    // Centres this far apart, in sums of the bodies' radii.
    double low, high;
    // The gap to close to, or negative to stay there.
    double gap;
    // Turns of a cube and shifts by quarters, which make faces and edges parallel.
    bool aligned;
    int count;
};

const Stratum strata[] = {
    {"far", 2, 8, -1, false, 40},
    {"near", 0.7, 1.2, -1, false, 70},
    {"near, aligned", 0.5, 1.2, -1, true, 40},
    {"overlapping", 0, 0.6, -1, false, 50},
    {"overlapping, aligned", 0, 0.6, -1, true, 20},
    {"gap 1e-3", 0.9, 1.5, 1e-3, false, 30},
    {"gap 1e-3, aligned", 0.9, 1.5, 1e-3, true, 30},
    {"gap 1e-6", 0.9, 1.5, 1e-6, false, 30},
    {"gap 1e-6, aligned", 0.9, 1.5, 1e-6, true, 30},
    {"gap 1e-9", 0.9, 1.5, 1e-9, false, 30},
    {"gap 1e-9, aligned", 0.9, 1.5, 1e-9, true, 30},
    {"touching", 0.9, 1.5, 0, false, 30},
    {"touching, aligned", 0.9, 1.5, 0, true, 30},
};

struct Session {
    Tally tally;
    Handle<cstk_query> warm = make_query();
    Stopwatch cstk_distance_time, cstk_within_time, fcl_distance_time, fcl_collide_time;
    long truths = 0, truths_small = 0, kept = 0;
    double worst = 0, worst_fcl = 0;
};

void dump(const Scene &s, double d, double f, const truth::Answer *t) {
    std::printf("  %s / %s, stratum '%s'\n", s.a->mesh.name.c_str(), s.b->mesh.name.c_str(),
                s.stratum);
    print_pose("a", s.pose_a);
    print_pose("b", s.pose_b);
    std::printf("    libcstk %.17g, FCL %.17g", d, f);
    if (t) {
        std::printf(", truth %.20Lg (depth of intersection %.3Lg)", t->distance, t->depth);
    }
    std::printf("\n");
}

cstk_distance_result ask(cstk_query *q, const Scene &s, double max_distance) {
    cstk_distance_result r;
    std::memset(&r, 0, sizeof r);
    must(cstk_pair_distance(q, s.a->body.get(), s.pose_a.m, s.b->body.get(), s.pose_b.m,
                            max_distance, &r));
    return r;
}

bool within(cstk_query *q, const Scene &s, double threshold) {
    bool yes = false;
    must(cstk_pair_within(q, s.a->body.get(), s.pose_a.m, s.b->body.get(), s.pose_b.m, threshold,
                          &yes));
    return yes;
}

Scene swapped(const Scene &s) { return {s.b, s.a, s.pose_b, s.pose_a, s.stratum}; }

void move(Pose &p, const double *from, const double *to, double length) {
    const double d[3] = {to[0] - from[0], to[1] - from[1], to[2] - from[2]};
    const double n = std::sqrt(d[0] * d[0] + d[1] * d[1] + d[2] * d[2]);
    for (int i = 0; i < 3; ++i) {
        p.m[4 * i + 3] += d[i] / n * length;
    }
}

Scene make_scene(const Body &a, const Body &b, const Stratum &stratum, models::Random &random,
                 cstk_query *query) {
    Scene s = {&a, &b, {}, {}, stratum.name};
    models::Point way = random.direction();
    if (stratum.aligned) {
        s.pose_a = random_quarter_turn(random);
        s.pose_b = random_quarter_turn(random);
        // Mostly along an axis, shifted sideways by quarters: faces then meet in common polygons.
        way = {0.25 * static_cast<double>(random.below(3)),
               0.25 * static_cast<double>(random.below(3)), 1};
        std::swap(way[2], way[random.below(3)]);
    } else {
        s.pose_a = random_rotation(random);
        s.pose_b = random_rotation(random);
    }
    // One scene in ten stands far from the world's origin.
    const double away = random.below(10) == 0 ? 100 : 1;
    const double reach = (a.radius + b.radius) * random.uniform(stratum.low, stratum.high);
    for (std::size_t i = 0; i < 3; ++i) {
        const double at = stratum.aligned ? 0.25 * std::floor(random.uniform(-4, 4) * away)
                                          : random.uniform(-away, away);
        s.pose_a.m[4 * i + 3] = at;
        s.pose_b.m[4 * i + 3] = at + reach * way[i];
    }
    if (stratum.gap < 0) {
        return s;
    }
    // Moving by d - gap along the shortest way leaves the distance at gap: it changes by no more
    // than the motion.
    cstk_distance_result r = ask(query, s, INFINITY);
    for (int tries = 0; r.distance < 0.01 && tries < 20; ++tries) {
        for (std::size_t i = 0; i < 3; ++i) {
            s.pose_b.m[4 * i + 3] += 0.2 * reach * way[i];
        }
        r = ask(query, s, INFINITY);
    }
    move(s.pose_b, r.s_point, r.r_point, r.distance - stratum.gap);
    return s;
}

// Whether an answer about meeting is plainly wrong: ties within `tolerance` may go either way.
bool wrong_meeting(bool meets, const truth::Answer &t, double tolerance) {
    return meets ? t.distance > tolerance : t.depth > tolerance;
}

struct Peer {
    double distance;
    bool collides;
};

Peer ask_fcl(Session &session, const Scene &s) {
    const fcl::Transform3d ta = fcl_pose(s.pose_a), tb = fcl_pose(s.pose_b);
    fcl::DistanceRequestd request(true);
    request.rel_err = request.abs_err = 0;
    fcl::DistanceResultd result;
    session.fcl_distance_time([&] {
        return fcl::distance<double>(s.a->fcl.get(), ta, s.b->fcl.get(), tb, request, result);
    });
    fcl::CollisionResultd collision;
    const fcl::CollisionRequestd simple;
    session.fcl_collide_time([&] {
        return fcl::collide<double>(s.a->fcl.get(), ta, s.b->fcl.get(), tb, simple, collision);
    });
    return {result.min_distance, collision.isCollision()};
}

// Judges both libraries by brute force.
void judge(Session &session, const Scene &s, const truth::Soup &a, const truth::Soup &b,
           double size, const cstk_distance_result &r, const Peer &f) {
    const truth::Answer t = truth::distance(a, b, r.distance + 1e-6 * size, peer * size);
    const auto tell = [&] { dump(s, r.distance, f.distance, &t); };
    Tally &tally = session.tally;
    const auto error = static_cast<double>(std::fabs(r.distance - t.distance)) / size;
    session.worst = std::max(session.worst, error);
    ++session.truths;
    session.truths_small += a.triangles.size() + b.triangles.size() <= 150;
    tally.expect(error <= exact, "distance is the truth within 1e-12 L", tell);
    // The brute force itself rounds at about 1e-19 L.
    tally.expect(r.lower <= t.distance + 1e-18L * size, "lower bound is not above the truth", tell);
    tally.expect(r.upper >= t.distance - 1e-18L * size, "upper bound is not below the truth", tell);
    tally.expect(!wrong_meeting(r.distance == 0, t, exact * size), "meeting is decided rightly",
                 tell);

    const bool differ = std::fabs(f.distance - r.distance) > peer * size ||
                        (f.distance <= 0) != (r.distance == 0) || f.collides != (r.distance == 0);
    if (!differ) {
        return;
    }
    ++tally.disagreements;
    const bool fcl_wrong = std::fabs(f.distance - t.distance) > peer * size ||
                           wrong_meeting(f.collides, t, exact * size) ||
                           wrong_meeting(f.distance <= 0, t, exact * size);
    if (!fcl_wrong) {
        // The truth itself is within 1e-12 L of the border: either answer will do.
        ++tally.ties;
        return;
    }
    ++tally.fcl_wrong;
    if (++session.kept <= 6) {
        std::printf("FCL is wrong (collides: %s):\n", f.collides ? "yes" : "no");
        tell();
    }
}

// What must hold of every answer, whatever the truth is.
void check_answer(Session &session, const Scene &s, const truth::Soup &a, const truth::Soup &b,
                  double size, const cstk_distance_result &r) {
    Tally &tally = session.tally;
    const auto tell = [&] { dump(s, r.distance, NAN, nullptr); };
    const double d = r.distance;
    tally.expect(r.kind == CSTK_DISTANCE_EXACT && r.has_witness, "an exact distance with a witness", tell);
    tally.expect(r.lower <= d && d <= r.upper, "lower <= distance <= upper", tell);
    tally.expect((d == 0) == (r.lower == 0), "lower is 0 exactly when the distance is", tell);
    tally.expect(r.upper - r.lower <= 2 * exact * size, "the bounds are tight", tell);
    tally.expect(r.witness.distance == d, "the witness has the distance", tell);

    const truth::V origin = centre(s.pose_a);
    const truth::V p = point(r.r_point, origin), q = point(r.s_point, origin);
    // Points are given in the world, where coordinates round at its scale.
    const double rounding = exact * size + 1e-15 * static_cast<double>(truth::length(origin));
    tally.expect(std::fabs(truth::length(p - q) - d) <= rounding, "the points are that far apart",
                 tell);
    tally.expect(truth::off(a, static_cast<std::uint32_t>(r.witness.r_tag), p) <= rounding,
                 "point on face of a", tell);
    tally.expect(truth::off(b, static_cast<std::uint32_t>(r.witness.s_tag), q) <= rounding,
                 "point on face of b", tell);
    if (r.has_contact) {
        // The normal is the direction of the gap, however small that is; just inside, the way out.
        const cstk_contact &c = r.contact;
        const truth::V across = point(c.r_point, origin) - point(c.s_point, origin);
        const truth::V normal = point(c.normal, {0, 0, 0});
        tally.expect(std::fabs(c.distance - d) <= exact * size, "the contact's distance", tell);
        tally.expect(std::fabs(truth::length(normal) - 1) <= exact, "a unit normal", tell);
        tally.expect(truth::length(across - c.clearance * normal) <= rounding,
                     "normal along the gap", tell);
        tally.expect(d > 0 ? c.clearance == c.distance
                           : c.clearance <= 0 && c.clearance >= -1e-6 * size,
                     "the contact's clearance", tell);
    }
    tally.expect(r.has_contact || d == 0, "a contact where there is a gap", tell);
}

bool same_bits(const cstk_distance_result &a, const cstk_distance_result &b) {
    return std::memcmp(&a, &b, sizeof a) == 0;
}

// Answers to the same question put otherwise.
void check_relations(Session &session, const Scene &s, double size, const cstk_distance_result &r) {
    Tally &tally = session.tally;
    cstk_query *warm = session.warm.get();
    const double d = r.distance, step = 2 * exact * size;
    const auto tell = [&] { dump(s, d, NAN, nullptr); };
    const Handle<cstk_query> fresh = make_query();
    tally.expect(same_bits(r, ask(fresh.get(), s, INFINITY)),
                 "a fresh context answers the same bits", tell);
    tally.expect(same_bits(r, ask(warm, s, INFINITY)), "asked again, the same bits", tell);
    tally.expect(std::fabs(ask(warm, swapped(s), INFINITY).distance - d) <= exact * size,
                 "symmetry", tell);

    tally.expect(session.cstk_within_time([&] { return within(warm, s, 0); }) == (d == 0),
                 "within 0 exactly when the distance is 0", tell);
    tally.expect(within(warm, s, d), "within its distance", tell);
    tally.expect(within(warm, s, d + step), "within a little more", tell);
    tally.expect(d <= step || !within(warm, s, d - step), "not within a little less", tell);

    tally.expect(same_bits(r, ask(warm, s, d + step)),
                 "a maximum above the distance changes nothing", tell);
    if (d > 1e-3 * size) {
        const double limit = 0.75 * d;
        const cstk_distance_result beyond = ask(warm, s, limit);
        const bool ok = beyond.kind == CSTK_DISTANCE_BEYOND_MAX && beyond.lower >= limit - exact * size &&
                        beyond.lower <= d && std::isinf(beyond.distance) &&
                        std::isinf(beyond.upper) && !beyond.has_witness;
        tally.expect(ok, "beyond the maximum", [&] {
            tell();
            std::printf("    max %.17g: kind %d, distance %.17g, lower %.17g, upper %.17g, "
                        "has_witness %d\n",
                        limit, static_cast<int>(beyond.kind), beyond.distance, beyond.lower,
                        beyond.upper, beyond.has_witness);
        });
    }
}

void check_scene(Session &session, const Scene &s, bool judge_anyway) {
    ++session.tally.poses;
    const truth::V origin = centre(s.pose_a);
    const truth::Soup a = s.a->faces(s.pose_a, origin), b = s.b->faces(s.pose_b, origin);
    const double size = largest_coordinate(a, b);
    const cstk_distance_result r =
        session.cstk_distance_time([&] { return ask(session.warm.get(), s, INFINITY); });
    const Peer f = ask_fcl(session, s);
    const auto tell = [&] { dump(s, r.distance, f.distance, nullptr); };
    check_answer(session, s, a, b, size, r);
    check_relations(session, s, size, r);
    const bool agree = std::fabs(f.distance - r.distance) <= peer * size &&
                       (f.distance <= 0) == (r.distance == 0) && f.collides == (r.distance == 0);
    if (agree) {
        session.worst_fcl = std::max(session.worst_fcl, std::fabs(f.distance - r.distance) / size);
    }
    if (!agree || judge_anyway || r.distance <= peer * size) {
        judge(session, s, a, b, size, r, f);
    }
    session.tally.expect(std::isfinite(f.distance), "FCL answers", tell);
}

// Split faces must be covered once, whole faces given back as they were.
void check_body(Session &session, const Body &b) {
    std::vector<std::vector<models::Point>> faces, triangles;
    for (const models::Face &f : b.mesh.faces) {
        faces.emplace_back();
        for (const std::uint32_t v : f) {
            faces.back().push_back(b.mesh.vertices[v]);
        }
    }
    for (const models::Triangle &t : b.mesh.triangles) {
        triangles.push_back({b.mesh.vertices[t[0]], b.mesh.vertices[t[1]], b.mesh.vertices[t[2]]});
    }
    cstk_body_statistics statistics = {};
    must(cstk_body_get_statistics(b.body.get(), &statistics));
    const auto tell = [&] { std::printf("  %s\n", b.mesh.name.c_str()); };
    const double whole = area(triangles);
    session.tally.expect(std::fabs(area(b.primitives) - whole) <= exact * whole,
                         "the primitives cover the body", tell);
    session.tally.expect(statistics.faces_dropped == 0, "no face is dropped", tell);
    session.tally.expect(statistics.faces_split > 0 || b.primitives.size() == faces.size(),
                         "a face, a primitive", tell);
    std::printf("%-12s %4zu faces, %4zu triangles, %4zu primitives, %llu faces split\n",
                b.mesh.name.c_str(), faces.size(), triangles.size(), b.primitives.size(),
                static_cast<unsigned long long>(statistics.faces_split));
}

// Cases FCL has been seen to get wrong: libcstk must have the known answer.
void check_kept(Session &session, const std::vector<Body> &bodies) {
    for (const cases::Kept &k : cases::kept()) {
        const auto find = [&](const char *name) {
            return std::find_if(bodies.begin(), bodies.end(),
                                [&](const Body &b) { return b.mesh.name == name; });
        };
        const auto a = find(k.body_a), b = find(k.body_b);
        Scene s = {&*a, &*b, {}, {}, k.name};
        std::copy(k.pose_a, k.pose_a + 12, s.pose_a.m);
        std::copy(k.pose_b, k.pose_b + 12, s.pose_b.m);
        const cstk_distance_result r = ask(session.warm.get(), s, INFINITY);
        const Peer f = ask_fcl(session, s);
        const auto tell = [&] { dump(s, r.distance, f.distance, nullptr); };
        session.tally.expect(std::fabs(r.distance - k.distance) <= 1e-12 &&
                                 (r.distance == 0) == (k.distance == 0),
                             k.name, tell);
        std::printf("kept: %s: true %.12g, libcstk %.12g, FCL %.12g and %s\n", k.name, k.distance,
                    r.distance, f.distance, f.collides ? "collides" : "does not collide");
    }
}

} // namespace

// The argument, if any, is the seed.
int main(int argc, char **argv) {
    Session session;
    models::Random random(argc > 1 ? std::strtoull(argv[1], nullptr, 10) : 1);
    std::vector<Body> bodies;
    for (models::Mesh &mesh : models::all()) {
        bodies.emplace_back(std::move(mesh));
        check_body(session, bodies.back());
    }
    check_kept(session, bodies);
    WitnessCheck witnesses(session.tally);
    long number = 0;
    for (std::size_t i = 0; i < bodies.size(); ++i) {
        for (std::size_t j = i; j < bodies.size(); ++j) {
            for (const Stratum &stratum : strata) {
                for (int k = 0; k < stratum.count; ++k) {
                    const Scene s =
                        make_scene(bodies[i], bodies[j], stratum, random, session.warm.get());
                    check_scene(session, s, number % 5 == 0);
                    if (stratum.low < 2 && number % 37 == 0) {
                        witnesses(*s.a, s.pose_a, *s.b, s.pose_b, random);
                    }
                    ++number;
                }
            }
        }
    }
    std::printf("brute force: %ld poses (%ld of small bodies), largest error of libcstk %.2g L; "
                "agreeing with FCL "
                "within %.2g L; witness sets: %ld, %ld witnesses\n",
                session.truths, session.truths_small, session.worst, session.worst_fcl,
                witnesses.sets(), witnesses.total());
    std::printf("median us: distance libcstk %.1f, FCL %.1f; meeting libcstk %.1f, FCL %.1f\n",
                session.cstk_distance_time.median(), session.fcl_distance_time.median(),
                session.cstk_within_time.median(), session.fcl_collide_time.median());
    return session.tally.finish("fcl_pairs");
}
