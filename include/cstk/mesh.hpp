/* Part of cstk.hpp: meshes of the nodes of a hierarchy. */
#ifndef CSTK_MESH_HPP
#define CSTK_MESH_HPP

#include <cstk.h>
#include <cstk/detail.hpp>
#include <cstk/error.hpp>

namespace cstk {

/// Polygons for looking at; the view's pointers live as long as the mesh.
class Mesh : public Handle<cstk_mesh, cstk_mesh_retain, cstk_mesh_release> {
public:
    using Handle::Handle;

    [[nodiscard]] cstk_mesh_view view() const {
        cstk_mesh_view out;
        check(cstk_mesh_get_view(get(), &out));
        return out;
    }
};

} // namespace cstk

#endif
