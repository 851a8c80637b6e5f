#include "built_in.hpp"

namespace problems {

std::vector<Problem> built_in(const std::string &puma_folder) {
    std::vector<Problem> found = {windows(), chambers()};
    if (!puma_folder.empty()) {
        found.push_back(puma_cell(puma_folder));
    }
    return found;
}

} // namespace problems
