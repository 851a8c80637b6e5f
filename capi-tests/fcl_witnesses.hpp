// Witness sets against brute force over all pairs of polygons.
#ifndef CSTK_FCL_WITNESSES_HPP
#define CSTK_FCL_WITNESSES_HPP

#include "fcl_common.hpp"

class WitnessCheck {
  public:
    explicit WitnessCheck(Tally &tally) : tally_(tally) {}

    long sets() const { return sets_; }
    long total() const { return total_; }

    // Asks for everything up to a little beyond the distance, and compares ids, distances and
    // contacts.
    void operator()(const Body &a, const Pose &pose_a, const Body &b, const Pose &pose_b,
                    models::Random &random) {
        const Question q = {a, b, pose_a, pose_b};
        origin_ = centre(pose_a);
        soup_a_ = a.by_primitive(pose_a, origin_);
        soup_b_ = b.by_primitive(pose_b, origin_);
        size_ = largest_coordinate(soup_a_, soup_b_);
        rounding_ = 1e-12 * size_ + 1e-15 * static_cast<double>(truth::length(origin_));
        cstk_distance_result r;
        must(cstk_pair_distance(query_.get(), a.body.get(), pose_a.m, b.body.get(), pose_b.m,
                                INFINITY, &r));
        const double epsilon = r.distance + random.uniform(1e-3, 0.1) * size_;
        ++sets_;

        const cstk_witness_list list = ask(q, epsilon, 1000000);
        total_ += static_cast<long>(list.witness_count);
        expect(!list.truncated, "all witnesses are given", q);
        compare_ids(q, list, epsilon);
        std::vector<double> distances;
        for (std::size_t i = 0; i < list.witness_count; ++i) {
            distances.push_back(list.witnesses[i].distance);
            check_witness(q, list, list.witnesses[i]);
        }
        expect(std::is_sorted(distances.begin(), distances.end()), "nearest first", q);
        expect(!distances.empty() && distances[0] == r.distance, "the nearest has the distance", q);

        if (distances.size() > 1) {
            const std::size_t half = distances.size() / 2;
            const cstk_witness_list part = ask(q, epsilon, half);
            bool nearest = part.truncated && part.witness_count == half;
            for (std::size_t i = 0; nearest && i < half; ++i) {
                nearest = part.witnesses[i].distance == distances[i];
            }
            expect(nearest, "a truncated list holds the nearest", q);
        }
    }

  private:
    struct Question {
        const Body &a, &b;
        const Pose &pose_a, &pose_b;
    };

    void expect(bool ok, const char *what, const Question &q) {
        tally_.expect(ok, what, [&] {
            std::printf("  witnesses of %s / %s\n", q.a.mesh.name.c_str(), q.b.mesh.name.c_str());
            print_pose("a", q.pose_a);
            print_pose("b", q.pose_b);
        });
    }

    cstk_witness_list ask(const Question &q, double epsilon, std::size_t max_count) {
        cstk_witness_list list;
        must(cstk_pair_witnesses(query_.get(), q.a.body.get(), q.pose_a.m, q.b.body.get(),
                                 q.pose_b.m, epsilon, max_count, &list));
        return list;
    }

    // Pairs within rounding of epsilon may be in the list or not.
    void compare_ids(const Question &q, const cstk_witness_list &list, double epsilon) {
        const double slack = 1e-12 * size_;
        const auto truth = truth::within(soup_a_, soup_b_, epsilon + slack);
        std::set<truth::Labels> seen;
        bool sound = true, right = true, complete = true;
        for (std::size_t i = 0; i < list.witness_count; ++i) {
            const cstk_witness &w = list.witnesses[i];
            const truth::Labels id = {w.r_primitive, w.s_primitive};
            sound = sound && seen.insert(id).second;
            const auto found = truth.find(id);
            right = right && found != truth.end() && std::fabs(found->second - w.distance) <= slack;
        }
        for (const auto &[id, distance] : truth) {
            complete = complete && (distance > epsilon - slack || seen.count(id) == 1);
        }
        expect(sound, "no witness is given twice", q);
        expect(right, "every witness has its true distance", q);
        expect(complete, "no witness is missing", q);
    }

    // The tag names the face that the primitive was made from: its vertices are among the face's.
    static bool made_from(const Body &body, std::uint32_t primitive, std::uint64_t tag) {
        if (tag >= body.mesh.faces.size()) {
            return false;
        }
        for (const models::Point &p : body.primitives[primitive]) {
            bool found = false;
            for (const std::uint32_t v : body.mesh.faces[tag]) {
                const models::Point &o = body.mesh.vertices[v];
                found = found ||
                        std::hypot(p[0] - o[0], p[1] - o[1], p[2] - o[2]) <= 1e-15 * body.radius;
            }
            if (!found) {
                return false;
            }
        }
        return true;
    }

    void check_witness(const Question &q, const cstk_witness_list &list, const cstk_witness &w) {
        expect(made_from(q.a, w.r_primitive, w.r_tag) && made_from(q.b, w.s_primitive, w.s_tag),
               "tags name the faces", q);
        expect(!w.overlapping || w.distance == 0, "overlap is at distance 0", q);
        expect(w.overlapping == (w.contact_count == 0), "apart or touching, there is a contact", q);
        expect(w.first_contact + w.contact_count <= list.contact_count, "contacts are in the list",
               q);
        for (std::uint32_t i = 0; i < w.contact_count; ++i) {
            check_contact(q, w, list.contacts[w.first_contact + i]);
        }
    }

    void check_contact(const Question &q, const cstk_witness &w, const cstk_contact &c) {
        const truth::V p = point(c.r_point, origin_), s = point(c.s_point, origin_),
                       n = point(c.normal, {0, 0, 0});
        expect(truth::off(soup_a_, w.r_primitive, p) <= rounding_, "contact point on a", q);
        expect(truth::off(soup_b_, w.s_primitive, s) <= rounding_, "contact point on b", q);
        expect(std::fabs(truth::length(p - s) - std::fabs(c.clearance)) <= rounding_,
               "contact points are that far apart", q);
        expect(std::fabs(c.distance - w.distance) <= rounding_, "the contact has the distance", q);
        expect(c.distance == std::fmax(c.clearance, 0), "just inside the clearance is negative", q);
        expect(std::fabs(truth::length(n) - 1) <= 1e-12, "the normal is a unit", q);
        // Features tilted by up to 1e-11 L still count as parallel, and share one normal.
        const truth::V rest = p - s - c.clearance * n;
        expect(truth::length(rest) <= rounding_ + 2e-11 * size_, "the normal joins the points", q);
    }

    Tally &tally_;
    Handle<cstk_query> query_ = make_query();
    truth::Soup soup_a_, soup_b_;
    truth::V origin_ = {0, 0, 0};
    double size_ = 1, rounding_ = 0;
    long sets_ = 0, total_ = 0;
};

#endif
