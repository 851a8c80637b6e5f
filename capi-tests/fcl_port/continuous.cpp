// continuousCollide: translations with closed forms, FCL's own answers where it is right, and (of cstk/fcl.hpp) turning motions
// against dense samples of motions written down here.
#include "library.hpp"

namespace {

double time_of(const fcl::CollisionGeometryd *a, const Transform &a0, const Transform &a1, const fcl::CollisionGeometryd *b,
               const Transform &b0, const Transform &b1, const fcl::ContinuousCollisionRequestd &request, bool &hit) {
    fcl::ContinuousCollisionResultd result;
    fcl::continuousCollide(a, a0, a1, b, b0, b1, request, result);
    hit = result.is_collide;
    return result.is_collide ? static_cast<double>(result.time_of_contact) : 1;
}

// Two balls on straight ways: a quadratic equation.
void balls() {
    models::Random random(21);
    const fcl::Sphered a(0.5), b(0.7);
    const fcl::ContinuousCollisionRequestd request(200, 1e-6, fcl::CCDM_TRANS, fcl::GST_LIBCCD, fcl::CCDC_CONSERVATIVE_ADVANCEMENT);
    for (int i = 0; i < 100; ++i) {
        Transform ends[4];
        for (Transform &end : ends) {
            end = at(random.uniform(-3, 3), random.uniform(-3, 3), random.uniform(-3, 3));
        }
        const Vector gap = ends[0].translation() - ends[2].translation();
        const Vector rate = ends[1].translation() - ends[0].translation() - ends[3].translation() + ends[2].translation();
        const double p = gap.dot(rate), q = gap.squaredNorm() - 1.2 * 1.2, root = p * p - rate.squaredNorm() * q;
        const double first = q <= 0 ? 0 : root < 0 || p >= 0 ? 2 : (-p - std::sqrt(root)) / rate.squaredNorm();
        if (std::fabs(root) < 1e-3 || std::fabs(q) < 1e-3 || std::fabs(first - 1) < 1e-3) {
            continue;
        }
        bool hit = false;
        const double time = time_of(&a, ends[0], ends[1], &b, ends[2], ends[3], request, hit);
        const std::string label = "balls/" + std::to_string(i);
        expect(hit == (first <= 1), label + ": whether they meet");
        expect_near(time, std::min(first, 1.0), 1e-4, label);
        answer(label, time, 1e-4);
    }
}

void requests() {
    const fcl::ContinuousCollisionRequestd usual;
    expect(usual.num_max_iterations == 10 && usual.toc_err == 0.0001 && usual.ccd_motion_type == fcl::CCDM_TRANS, "defaults");
    // By objects, which start where they are.
    const auto ball = std::make_shared<fcl::Sphered>(1);
    const fcl::CollisionObjectd a(ball, at(-4, 0, 0)), b(ball, at(4, 0, 0));
    fcl::ContinuousCollisionRequestd request(100, 1e-5, fcl::CCDM_TRANS, fcl::GST_LIBCCD, fcl::CCDC_CONSERVATIVE_ADVANCEMENT);
    fcl::ContinuousCollisionResultd result;
    fcl::continuousCollide(&a, at(4, 0, 0), &b, at(-4, 0, 0), request, result);
    expect(result.is_collide, "two balls on one line meet");
    answer("line/time", result.time_of_contact, 1e-3);
    answer("line/where", result.contact_tf1.translation()[0], 1e-2);
    // By motions of the caller's.
    const auto m1 = std::make_shared<fcl::TranslationMotion<double>>(at(-4, 0, 0), at(4, 0, 0));
    const auto m2 = std::make_shared<fcl::TranslationMotion<double>>(at(4, 0, 0), at(-4, 0, 0));
    m1->integrate(0.25);
    Transform now;
    m1->getCurrentTransform(now);
    expect_near(now.translation()[0], -2, 1e-12, "a motion at a time");
    fcl::ContinuousCollisionObject<double> c(ball, m1), d(ball, m2);
    fcl::ContinuousCollisionResultd again;
    fcl::collide(&c, &d, request, again);
    answer("line/by_motions", again.time_of_contact, 1e-3);
}

#ifndef WITH_FCL
Transform sample(const Transform &start, const Transform &end, double t, bool screw) {
    const fcl::AngleAxisd turn(Eigen::Matrix3d(start.linear().transpose() * end.linear()));
    Transform out = start;
    if (!screw) {
        out.linear() = start.linear() * fcl::AngleAxisd(turn.angle() * t, turn.axis()).toRotationMatrix();
        out.translation() = (1 - t) * start.translation() + t * end.translation();
        return out;
    }
    // The exponential of t times the logarithm of the whole, by the power series of the left Jacobian.
    const Vector w = turn.angle() * turn.axis();
    Eigen::Matrix3d hat;
    hat << 0, -w[2], w[1], w[2], 0, -w[0], -w[1], w[0], 0;
    const auto jacobian = [&hat](double part) {
        Eigen::Matrix3d sum = Eigen::Matrix3d::Identity() * part, term = sum;
        for (int k = 1; k < 40; ++k) {
            term = term * hat * part / (k + 1);
            sum += term;
        }
        return sum;
    };
    const Vector v = jacobian(1).fullPivLu().solve(Vector((start.inverse() * end).translation()));
    out.linear() = start.linear() * fcl::AngleAxisd(turn.angle() * t, turn.axis()).toRotationMatrix();
    out.translation() = start * Vector(jacobian(t) * v);
    return out;
}

// No sample before the time of contact meets, and what is called a contact is one.
void turning(const fcl::CollisionGeometryd *a, const fcl::CollisionGeometryd *b, fcl::CCDMotionType type, models::Random &random,
             const std::string &label, int &hits) {
    const Transform a0 = random_transform(random, 2.5), a1 = random_transform(random, 2.5);
    const Transform b0 = random_transform(random, 2.5), b1 = random_transform(random, 2.5);
    const bool screw = type == fcl::CCDM_SCREW;
    const fcl::ContinuousCollisionRequestd request(10, 1e-5, type);
    fcl::ContinuousCollisionResultd found;
    fcl::continuousCollide(a, a0, a1, b, b0, b1, request, found);
    const auto meet = [&](double t) {
        fcl::CollisionResultd result;
        const fcl::CollisionRequestd any;
        return fcl::collide(a, sample(a0, a1, t, screw), b, sample(b0, b1, t, screw), any, result) > 0;
    };
    bool free = true;
    for (int i = 0; i < 400; ++i) {
        const double t = (found.is_collide ? found.time_of_contact - 1e-9 : 1.0) * i / 399;
        free = free && (t <= 0 || !meet(t));
    }
    expect(free, label + ": all before the time of contact is free");
    if (found.is_collide) {
        ++hits;
        fcl::DistanceResultd result;
        fcl::distance(a, found.contact_tf1, b, found.contact_tf2, fcl::DistanceRequestd(), result);
        expect(result.min_distance <= 1e-9, label + ": at contact_tf1 and contact_tf2 the two meet");
        expect(found.contact_tf1.isApprox(sample(a0, a1, std::min(1.0, found.time_of_contact + 5e-6), screw), 1e-4),
               label + ": contact_tf1 is on the motion");
    }
}

void all_turning() {
    models::Random random(31);
    const auto model = model_of(models::l_prism());
    const fcl::Coned cone(0.6, 1);
    const fcl::Halfspaced floor(0, 0, 1, -2);
    const fcl::Planed sheet(0, 0.6, 0.8, 0.5);
    int hits = 0, hits_of_flats = 0;
    for (int i = 0; i < 40; ++i) {
        for (const fcl::CCDMotionType type : {fcl::CCDM_LINEAR, fcl::CCDM_SCREW}) {
            const std::string label = "turning/" + std::to_string(i) + (type == fcl::CCDM_SCREW ? "/screw" : "/linear");
            turning(model.get(), &cone, type, random, label, hits);
            const Transform a0 = random_transform(random, 1), a1 = random_transform(random, 3);
            for (const fcl::CollisionGeometryd *flat : {static_cast<const fcl::CollisionGeometryd *>(&floor),
                                                        static_cast<const fcl::CollisionGeometryd *>(&sheet)}) {
                const fcl::ContinuousCollisionRequestd request(10, 1e-5, type);
                fcl::ContinuousCollisionResultd found;
                const Transform rest = at(0, 0, 0);
                fcl::continuousCollide<double>(model.get(), a0, a1, flat, rest, rest, request, found);
                bool free = true;
                for (int k = 0; k < 200; ++k) {
                    const double t = (found.is_collide ? found.time_of_contact - 1e-9 : 1.0) * k / 199;
                    const Transform there = sample(a0, a1, t, type == fcl::CCDM_SCREW);
                    const fcl::CollisionRequestd any;
                    fcl::CollisionResultd result;
                    free = free && (t <= 0 || fcl::collide<double>(model.get(), there, flat, rest, any, result) == 0);
                }
                expect(free, label + ": all before the contact with a plane is free");
                hits_of_flats += found.is_collide;
            }
        }
    }
    expect(hits > 10 && hits < 70 && hits_of_flats > 20 && hits_of_flats < 150, "some turning motions meet, some do not");
}
#endif

} // namespace

int main() {
    balls();
    requests();
#ifndef WITH_FCL
    all_turning();
#endif
    return failures() == 0 ? 0 : 1;
}
