#include "measure.hpp"

#include <cstk.hpp>

namespace {

cstk::Body body_of(const Mesh &mesh, std::uint32_t threads) {
    const cstk::BodyBuilder builder;
    const std::vector<std::uint32_t> sizes(mesh.triangles.size(), 3);
    cstk::check(cstk_body_builder_add_mesh(builder.get(), mesh.vertices.front().data(),
                                           mesh.vertices.size(), sizes.data(), sizes.size(),
                                           mesh.triangles.front().data(), 3 * sizes.size(),
                                           nullptr, nullptr));
    cstk_hierarchy_options options;
    cstk::check(cstk_hierarchy_options_default(&options, sizeof options));
    options.threads = threads;
    cstk_body *body = nullptr;
    cstk::check(cstk_body_build(builder.get(), &options, nullptr, nullptr, &body));
    return cstk::Body(body);
}

} // namespace

std::vector<Built> cstk_builds(const Mesh &mesh, int times) {
    const auto build = [&](const char *way, std::uint32_t threads) {
        return measured("cstk", way, mesh, times, [&] { return body_of(mesh, threads); });
    };
    return {build("one thread", 1), build("all threads", 0)};
}
