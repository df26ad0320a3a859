// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#include "ros/params/mesh_bytes.h"

#include <algorithm>
#include <cstdint>
#include <cstring>
#include <utility>
#include <vector>

#include "vegetation_sim/core/config/faults.h"

namespace vegetation_sim {
namespace {

static_assert(sizeof(Vec3) == 3 * sizeof(double), "vectors are copied as they lie in memory");

template <class T>
void putList(const T& values, std::string& out) {
  const std::uint64_t size = values.size();
  out.append(reinterpret_cast<const char*>(&size), sizeof size);
  out.append(reinterpret_cast<const char*>(values.data()), size * sizeof(typename T::value_type));
}

/// Takes lists out of bytes in the order of putList().
class ListReader {
 public:
  explicit ListReader(const std::string& bytes) : bytes_(bytes) {}

  /// @param List a vector or a string. @param most elements.
  template <class List>
  List take(std::size_t most) {
    std::uint64_t size = 0;
    copy(&size, sizeof size);
    if (size > most) reject();
    List out;
    const std::size_t length = size * sizeof(typename List::value_type);
    if (length > bytes_.size() - at_) reject();  // before memory is taken for it
    out.resize(size);
    copy(out.data(), length);
    return out;
  }
  bool isAtEnd() const { return at_ == bytes_.size(); }
  [[noreturn]] static void reject() {
    throw InvalidInput("no mesh: its reader returned damaged bytes");
  }

 private:
  void copy(void* to, std::size_t length) {
    if (length > bytes_.size() - at_) reject();
    if (length > 0) std::memcpy(to, bytes_.data() + at_, length);
    at_ += length;
  }

  const std::string& bytes_;
  std::size_t at_{0};
};

/// Whether each list has an element for every corner or face, or none.
bool hasFullLists(const canopy::LeafMesh& mesh) {
  const std::size_t corners = mesh.vertices.size(), faces = mesh.faces.size();
  const auto fits = [](std::size_t size, std::size_t all) { return size == 0 || size == all; };
  return fits(mesh.uv.size(), corners) && fits(mesh.normals.size(), corners) &&
         fits(mesh.rigid.size(), faces) && fits(mesh.material.size(), faces);
}

}  // namespace

std::string toBytes(const canopy::LeafMesh& mesh) {
  std::vector<Vec3> colours;
  std::size_t names = 0;
  for (const canopy::FaceMaterial& each : mesh.materials) {
    colours.push_back(each.colour);
    names += each.texture.size() + sizeof(Vec3) + sizeof(std::uint64_t);
  }
  std::string out;
  // Lists of a large mesh need no second copy while the text grows.
  out.reserve(sizeof(Vec3) * (mesh.vertices.size() + mesh.normals.size()) + 16 * mesh.uv.size() +
              12 * mesh.faces.size() + 3 * mesh.faces.size() + names + 1024);
  putList(mesh.vertices, out);
  putList(mesh.uv, out);
  putList(mesh.faces, out);
  putList(std::string(mesh.rigid.begin(), mesh.rigid.end()), out);
  putList(mesh.normals, out);
  putList(mesh.material, out);
  putList(colours, out);
  for (const canopy::FaceMaterial& each : mesh.materials) putList(each.texture, out);
  return out;
}

canopy::LeafMesh meshOfBytes(const std::string& bytes) {
  ListReader in(bytes);
  canopy::LeafMesh out;
  out.vertices = in.take<decltype(out.vertices)>(MOST_MESH_CORNERS);
  out.uv = in.take<decltype(out.uv)>(MOST_MESH_CORNERS);
  out.faces = in.take<decltype(out.faces)>(MOST_MESH_CORNERS);
  const auto rigid = in.take<std::string>(MOST_MESH_CORNERS);
  out.rigid.assign(rigid.begin(), rigid.end());
  out.normals = in.take<decltype(out.normals)>(MOST_MESH_CORNERS);
  out.material = in.take<decltype(out.material)>(MOST_MESH_CORNERS);
  for (const Vec3& colour : in.take<std::vector<Vec3>>(MOST_MESH_MATERIALS)) {
    out.materials.emplace_back();
    out.materials.back().colour = colour;
  }
  for (canopy::FaceMaterial& each : out.materials)
    each.texture = in.take<std::string>(LONGEST_TEXTURE_NAME);
  if (!in.isAtEnd() || !hasFullLists(out)) ListReader::reject();
  return out;
}

}  // namespace vegetation_sim
