// The two libraries under one name: each program of this folder is built with FCL (WITH_FCL) and with cstk/fcl.hpp, and its answers
// are compared by compare.cpp.
#ifndef CSTK_FCL_PORT_LIBRARY_HPP
#define CSTK_FCL_PORT_LIBRARY_HPP

#ifdef WITH_FCL
#include <fcl/fcl.h>
#else
#include <cstk/fcl.hpp>
namespace fcl = cstk_fcl;
#endif

// As MoveIt asks for it.
#if FCL_MAJOR_VERSION == 0 && FCL_MINOR_VERSION < 6
#error "written for FCL 0.6 or later"
#endif

#include "../fcl_models.hpp"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <ctime>
#include <memory>
#include <string>
#include <vector>

using Model = fcl::BVHModel<fcl::OBBRSSd>;
using Geometry = std::shared_ptr<fcl::CollisionGeometryd>;
using Vector = fcl::Vector3d;
using Transform = fcl::Transform3d;

// A line that compare.cpp reads: both libraries must answer the same, within the tolerance.
inline void answer(const std::string &label, double value, double tolerance) {
    std::printf("value %s %.17g %g\n", label.c_str(), value, tolerance);
}

// The same for yes and no. `gap` is how far from touching the pair is, as this library measures it: where it is within the
// tolerance, the two may differ.
inline void decision(const std::string &label, bool yes, double gap, double tolerance) {
    std::printf("decision %s %d %.17g %g\n", label.c_str(), yes ? 1 : 0, gap, tolerance);
}

// Compared by ratio only, and printed.
inline void duration(const std::string &label, double seconds) { std::printf("time %s %.9g\n", label.c_str(), seconds); }

// What must be so whichever library answers.
inline int &failures() {
    static int count = 0;
    return count;
}

inline void expect(bool ok, const std::string &what) {
    if (!ok) {
        ++failures();
        std::printf("FAILED: %s\n", what.c_str());
    }
}

inline void expect_near(double value, double truth, double tolerance, const std::string &what) {
    if (!(std::fabs(value - truth) <= tolerance)) {
        ++failures();
        std::printf("FAILED: %s: %.12g, should be %.12g\n", what.c_str(), value, truth);
    }
}

inline Transform at(double x, double y, double z) {
    Transform t = Transform::Identity();
    t.translation() << x, y, z;
    return t;
}

// A rotation drawn evenly, and a place in a cube.
inline Transform random_transform(models::Random &random, double reach) {
    fcl::Quaterniond q;
    do {
        for (int i = 0; i < 4; ++i) {
            q.coeffs()[i] = random.uniform(-1, 1);
        }
    } while (q.norm() < 0.1 || q.norm() > 1);
    q.normalize();
    Transform t = Transform::Identity();
    t.linear() = q.toRotationMatrix();
    for (int i = 0; i < 3; ++i) {
        t.translation()[i] = random.uniform(-reach, reach);
    }
    return t;
}

inline std::shared_ptr<Model> model_of(const models::Mesh &mesh) {
    std::vector<Vector> points;
    std::vector<fcl::Triangle> triangles;
    for (const models::Point &p : mesh.vertices) {
        points.emplace_back(p[0], p[1], p[2]);
    }
    for (const models::Triangle &t : mesh.triangles) {
        triangles.emplace_back(t[0], t[1], t[2]);
    }
    auto model = std::make_shared<Model>();
    model->beginModel();
    model->addSubModel(points, triangles);
    model->endModel();
    model->computeLocalAABB();
    return model;
}

// A hull in FCL's form: vertices, and faces as counts and indices.
inline std::shared_ptr<fcl::Convexd> convex_of(const models::Mesh &mesh) {
    auto points = std::make_shared<std::vector<Vector>>();
    for (const models::Point &p : mesh.vertices) {
        points->emplace_back(p[0], p[1], p[2]);
    }
    auto faces = std::make_shared<std::vector<int>>();
    for (const models::Face &face : mesh.faces) {
        faces->push_back(static_cast<int>(face.size()));
        faces->insert(faces->end(), face.begin(), face.end());
    }
    return std::make_shared<fcl::Convexd>(points, static_cast<int>(mesh.faces.size()), faces);
}

// Processor time, which other programs on the machine lengthen less than they do the time of day.
class Clock {
  public:
    double seconds() const { return static_cast<double>(std::clock() - start_) / CLOCKS_PER_SEC; }

  private:
    std::clock_t start_ = std::clock();
};

#endif
