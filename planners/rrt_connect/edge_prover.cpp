#include "edge_prover.hpp"

namespace rrt_connect {

EdgeProver::EdgeProver(const cstk::Query &query, const cstk::Space &space, const cstk::CObject &contact, double spacing)
    : query_(query), space_(space), contact_(contact), spacing_(spacing), options_(cstk::motion_options()) {
    // Where a motion meets something first does not matter.
    options_.any_contact = 1;
}

bool EdgeProver::is_free(const Configuration &from, const Configuration &to) {
    ++checks_;
    return samples_are_free(from, to) && query_.motion(contact_, from, to, options_).outcome == CSTK_MOTION_FREE;
}

bool EdgeProver::is_free(const Configuration &q) const {
    return query_.classify(contact_, q) != CSTK_CLASS_INSIDE;
}

/// Looks at the end, the middle, the quarters and so on: far apart first, where a contact is found soonest. A tree's edges begin
/// where it is free.
bool EdgeProver::samples_are_free(const Configuration &from, const Configuration &to) const {
    if (!is_free(to)) {
        return false;
    }
    const double distance = space_.distance(from, to);
    for (double part = 0.5; 2 * part * distance > spacing_; part /= 2) {
        for (double t = part; t < 1; t += 2 * part) {
            if (!is_free(space_.interpolate(from, to, t))) {
                return false;
            }
        }
    }
    return true;
}

} // namespace rrt_connect
