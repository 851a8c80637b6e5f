#include "edge_prover.hpp"

namespace rrt_connect {

EdgeProver::EdgeProver(cstk::Query &query, const cstk::CObject &contact)
    : query_(query), contact_(contact), options_(cstk::motion_options()) {
    // Where a motion meets something first does not matter.
    options_.any_contact = 1;
}

bool EdgeProver::is_free(const Configuration &from, const Configuration &to) {
    ++checks_;
    return query_.motion(contact_, from, to, options_).outcome == CSTK_MOTION_FREE;
}

bool EdgeProver::is_free(const Configuration &q) const {
    return query_.classify(contact_, q) != CSTK_CLASS_INSIDE;
}

} // namespace rrt_connect
