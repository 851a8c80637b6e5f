#include "peer_model.hpp"

#include <fcl/fcl.h>

namespace {

template <class Volume> Built build_of(const char *way, const Mesh &mesh, int times) {
    return model_build<fcl::BVHModel<Volume>, fcl::Vector3d, fcl::Triangle>("FCL", way, mesh,
                                                                            times);
}

} // namespace

std::vector<Built> fcl_builds(const Mesh &mesh, int times) {
    return {build_of<fcl::OBBd>("OBB", mesh, times), build_of<fcl::RSSd>("RSS", mesh, times),
            build_of<fcl::OBBRSSd>("OBBRSS", mesh, times),
            build_of<fcl::kIOSd>("kIOS", mesh, times)};
}
