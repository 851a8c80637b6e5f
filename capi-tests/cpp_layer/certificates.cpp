#include "check.hpp"
#include "subjects.hpp"

#include <cstdio>
#include <vector>

void certificates(cstk::Query &query, const cstk::CObject &obstacles, const std::vector<double> &q) {
    std::vector<double> reached;
    const std::vector<double> far = {q[0] + 100, q[1]};
    cstk_motion_result result;
    const auto any = cstk::motion_options();
    REQUIRE(!query.motion_certificate(obstacles, q, far, any, &result, &reached));
    REQUIRE(result.outcome == CSTK_MOTION_HIT && reached.size() == q.size());
    const std::vector<double> near = {q[0] + 0.25, q[1]};
    cstk::Certificate proof = query.motion_certificate(obstacles, q, near);
    proof.verify(obstacles, q, near);
    REQUIRE(status_of([&] { return proof.verify(obstacles, q, q); }) == CSTK_ERROR_NOT_PROVED);
    proof.save("cpp_layer.certificate");
    proof = cstk::Certificate::load("cpp_layer.certificate");
    REQUIRE(std::remove("cpp_layer.certificate") == 0);
    proof.verify(obstacles, q, near);
    REQUIRE(proof.ends().first == q && proof.ends().second == near);
    REQUIRE(proof.summary().entry_count > 0 && proof.entry(0).times[0] == 0.0);
    REQUIRE(proof.primitives(0, 1).size() == proof.entry(0).primitive_counts[1]);
}
