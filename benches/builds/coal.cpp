#include "peer_model.hpp"

#include <coal/BVH/BVH_model.h>

namespace {

template <class Volume> Built build_of(const char *way, const Mesh &mesh, int times) {
    return model_build<coal::BVHModel<Volume>, coal::Vec3s, coal::Triangle>("Coal", way, mesh,
                                                                            times);
}

} // namespace

std::vector<Built> coal_builds(const Mesh &mesh, int times) {
    return {build_of<coal::OBB>("OBB", mesh, times), build_of<coal::RSS>("RSS", mesh, times),
            build_of<coal::OBBRSS>("OBBRSS", mesh, times),
            build_of<coal::kIOS>("kIOS", mesh, times)};
}
