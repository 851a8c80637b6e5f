#include "problems.hpp"

namespace sandros::problems {

std::vector<Problem> generated() {
    return {windows(), two_arms(), two_carts(), bug_trap(true), bug_trap(false)};
}

} // namespace sandros::problems
