#include "built_in.hpp"
#include "problems.hpp"
#include "shapes.hpp"

namespace sandros::problems {

namespace {

/// The number of the link that carries a mesh: each row is a joint, and behind it a fixed link.
std::uint32_t mesh_link(std::uint32_t number) { return 2 * number; }

} // namespace

Problem puma560(const std::string &meshes) {
    Problem problem;
    problem.name = "puma560";
    problem.robots = {::problems::puma_560(meshes)};
    problem.space = cstk::Space(problem.robots);
    /* Links with at least two others between them: nearer ones touch by design. */
    for (std::uint32_t a = 0; a <= 6; ++a) {
        for (std::uint32_t b = a + 3; b <= 6; ++b) {
            problem.link_pairs.push_back({mesh_link(a), mesh_link(b)});
        }
    }
    const std::vector<Box> table = {{{0.75, 0, 0.3}, {0.9, 1.6, 0.04}}};
    const std::vector<Box> post = {{{0.6, 0.05, 0.8}, {0.12, 0.12, 0.96}}};
    const std::vector<Box> shelf = {{{0.6, 0.55, 0.98}, {0.5, 0.5, 0.03}},
                                    {{0.6, 0.82, 0.65}, {0.5, 0.03, 0.7}}};
    const std::vector<Box> crates = {{{0.55, -0.3, 0.45}, {0.3, 0.06, 0.26}},
                                     {{0.55, -0.6, 0.45}, {0.3, 0.06, 0.26}}};
    for (const auto &boxes : {table, post, shelf, crates}) {
        problem.add_obstacle(body_of(boxes));
    }
    problem.start = {0.991, 0.437, -2.272, 0.007, -1.235, -0.208};
    problem.goal = {-0.461, 0.361, -2.352, -0.151, -1.709, -0.046};
    problem.axes = {{0, 16}, {1, 12}, {2, 12}, {3, 8}, {4, 8}, {5, 8}};
    problem.slide = {0.04, 0.08, 0.04};
    return problem;
}

} // namespace sandros::problems
