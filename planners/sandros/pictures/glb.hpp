// Scenes in glTF 2.0 binary files (.glb).
#ifndef SANDROS_GLB_HPP
#define SANDROS_GLB_HPP

#include <cstk.hpp>

#include <array>
#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

namespace sandros::pictures {

/// Red, green and blue, from 0 to 1.
using Colour = std::array<float, 3>;

/// Corners in threes, counter-clockwise around the outside.
using Triangles = std::vector<std::array<double, 3>>;

/// Meshes and materials are named by the numbers that adding them gives.
class Glb {
  public:
    std::size_t add_mesh(const Triangles &triangles, const Colour &colour);

    void add_node(const std::string &name, std::size_t mesh, const cstk::Pose &pose);

    /// Throws std::runtime_error if the file cannot be written.
    void write(const std::string &file) const;

  private:
    std::size_t add_floats(const std::vector<float> &values, std::size_t width);
    std::string json() const;

    std::string buffer_;
    std::vector<std::string> views_, accessors_, materials_, meshes_, nodes_;
};

} // namespace sandros::pictures

#endif
