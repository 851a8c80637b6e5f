#include "glb.hpp"

#include <algorithm>
#include <cmath>
#include <fstream>
#include <sstream>
#include <stdexcept>

namespace sandros::pictures {

namespace {

/// "[a,b,c]"
template <typename Items> std::string list_of(const Items &items) {
    std::ostringstream out;
    out << "[";
    const char *between = "";
    for (const auto &item : items) {
        out << between << item;
        between = ",";
    }
    out << "]";
    return out.str();
}

std::array<double, 3> normal_of(const std::array<double, 3> *corners) {
    std::array<double, 3> u, v;
    for (std::size_t i = 0; i < 3; ++i) {
        u[i] = corners[1][i] - corners[0][i];
        v[i] = corners[2][i] - corners[0][i];
    }
    const std::array<double, 3> n = {u[1] * v[2] - u[2] * v[1], u[2] * v[0] - u[0] * v[2],
                                     u[0] * v[1] - u[1] * v[0]};
    const double length = std::sqrt(n[0] * n[0] + n[1] * n[1] + n[2] * n[2]);
    if (length == 0) {
        return {0, 0, 1};
    }
    return {n[0] / length, n[1] / length, n[2] / length};
}

/// Little-endian, as the processors are that the library is built for.
void append(std::string &bytes, const void *data, std::size_t size) {
    bytes.append(static_cast<const char *>(data), size);
}

void append_chunk(std::string &bytes, const std::string &chunk, const char *kind) {
    const auto size = static_cast<std::uint32_t>(chunk.size());
    append(bytes, &size, 4);
    append(bytes, kind, 4);
    bytes += chunk;
}

} // namespace

/// Vectors of `width` numbers each; returns the accessor.
std::size_t Glb::add_floats(const std::vector<float> &values, std::size_t width) {
    static const char *const types[] = {"", "SCALAR", "VEC2", "VEC3", "VEC4"};
    std::vector<float> low(values.begin(), values.begin() + static_cast<std::ptrdiff_t>(width));
    std::vector<float> high = low;
    for (std::size_t i = 0; i < values.size(); ++i) {
        low[i % width] = std::min(low[i % width], values[i]);
        high[i % width] = std::max(high[i % width], values[i]);
    }
    const std::size_t bytes = values.size() * sizeof(float);
    views_.push_back("{\"buffer\":0,\"byteOffset\":" + std::to_string(buffer_.size()) +
                     ",\"byteLength\":" + std::to_string(bytes) + "}");
    append(buffer_, values.data(), bytes);
    accessors_.push_back("{\"bufferView\":" + std::to_string(views_.size() - 1) +
                         ",\"componentType\":5126,\"count\":" +
                         std::to_string(values.size() / width) + ",\"type\":\"" + types[width] +
                         "\",\"min\":" + list_of(low) + ",\"max\":" + list_of(high) + "}");
    return accessors_.size() - 1;
}

std::size_t Glb::add_mesh(const Triangles &triangles, const Colour &colour) {
    std::vector<float> positions, normals;
    for (std::size_t i = 0; i < triangles.size(); ++i) {
        const std::array<double, 3> normal = normal_of(&triangles[i - i % 3]);
        for (std::size_t k = 0; k < 3; ++k) {
            positions.push_back(static_cast<float>(triangles[i][k]));
            normals.push_back(static_cast<float>(normal[k]));
        }
    }
    materials_.push_back("{\"doubleSided\":true,\"pbrMetallicRoughness\":{\"metallicFactor\":0,"
                         "\"roughnessFactor\":0.6,\"baseColorFactor\":" +
                         list_of(std::array<float, 4>{colour[0], colour[1], colour[2], 1}) + "}}");
    const std::size_t position = add_floats(positions, 3), normal = add_floats(normals, 3);
    meshes_.push_back("{\"primitives\":[{\"attributes\":{\"POSITION\":" + std::to_string(position) +
                      ",\"NORMAL\":" + std::to_string(normal) +
                      "},\"material\":" + std::to_string(materials_.size() - 1) + "}]}");
    return meshes_.size() - 1;
}

void Glb::add_node(const std::string &name, std::size_t mesh, const cstk::Pose &pose) {
    const std::array<double, 7> p = cstk::pose_to_quaternion(pose);
    nodes_.push_back("{\"name\":\"" + name + "\",\"mesh\":" + std::to_string(mesh) +
                     ",\"translation\":" + list_of(std::array<double, 3>{p[0], p[1], p[2]}) +
                     ",\"rotation\":" + list_of(std::array<double, 4>{p[3], p[4], p[5], p[6]}) +
                     "}");
}

std::string Glb::json() const {
    std::vector<std::size_t> roots;
    for (std::size_t i = 0; i < nodes_.size(); ++i) {
        roots.push_back(i);
    }
    std::string text =
        "{\"asset\":{\"version\":\"2.0\"},\"scene\":0,\"scenes\":[{\"nodes\":" + list_of(roots) +
        "}],\"nodes\":" + list_of(nodes_) + ",\"meshes\":" + list_of(meshes_) +
        ",\"materials\":" + list_of(materials_) + ",\"accessors\":" + list_of(accessors_) +
        ",\"bufferViews\":" + list_of(views_) +
        ",\"buffers\":[{\"byteLength\":" + std::to_string(buffer_.size()) + "}]";
    return text + "}";
}

void Glb::write(const std::string &file) const {
    std::string text = json();
    text.resize((text.size() + 3) / 4 * 4, ' ');
    /* The header of 12 bytes, and 8 for each chunk; the buffer holds floats alone. */
    const std::uint32_t numbers[2] = {
        2, static_cast<std::uint32_t>(28 + text.size() + buffer_.size())};
    std::string bytes = "glTF";
    append(bytes, numbers, 8);
    append_chunk(bytes, text, "JSON");
    append_chunk(bytes, buffer_, "BIN\0");
    std::ofstream out(file, std::ios::binary);
    out.write(bytes.data(), static_cast<std::streamsize>(bytes.size()));
    out.close();
    if (!out) {
        throw std::runtime_error(file + " cannot be written");
    }
}

} // namespace sandros::pictures
