// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#include "canopy/plants/mesh_leaves.h"

#include <algorithm>
#include <cctype>
#include <cmath>
#include <numeric>
#include <sstream>

#include "canopy/plants/form_hash.h"
#include "vegetation_sim/canopy/plants/plant.h"
#include "vegetation_sim/core/math/math.h"
#include "vegetation_sim/core/math/random.h"

namespace vegetation_sim::canopy {
namespace {

constexpr double LARGEST = 1e9;    // largest coordinate of a mesh
constexpr double FLATTEST = 1e-6;  // least height over width

std::string firstOf(std::size_t count, const char* what, std::size_t first) {
  return std::to_string(count) + " " + what + ", the first is number " + std::to_string(first);
}

/// Counts faults and keeps the first.
struct Wrong {
  std::size_t count{0}, first{0};
  void add(std::size_t index) {
    if (count++ == 0) first = index;
  }
};

void check(const LeafMesh& mesh, Faults& faults) {
  if (mesh.faces.empty()) faults.add("no faces");
  if (mesh.faces.size() > MOST_LEAVES)
    faults.add(std::to_string(mesh.faces.size()) + " faces, more than the " +
               std::to_string(MOST_LEAVES) + " allowed");
  if (!mesh.uv.empty() && mesh.uv.size() != mesh.vertices.size())
    faults.add(std::to_string(mesh.uv.size()) + " texture coordinates for " +
               std::to_string(mesh.vertices.size()) + " vertices");
  if (!mesh.rigid.empty() && mesh.rigid.size() != mesh.faces.size())
    faults.add(std::to_string(mesh.rigid.size()) + " rigid marks for " +
               std::to_string(mesh.faces.size()) + " faces");
  if (!mesh.normals.empty() && mesh.normals.size() != mesh.vertices.size())
    faults.add(std::to_string(mesh.normals.size()) + " normals for " +
               std::to_string(mesh.vertices.size()) + " vertices");
  if (!mesh.material.empty() && mesh.material.size() != mesh.faces.size())
    faults.add(std::to_string(mesh.material.size()) + " materials for " +
               std::to_string(mesh.faces.size()) + " faces");
  for (const std::uint16_t material : mesh.material)
    if (material > mesh.materials.size())
      return faults.add("material " + std::to_string(material) + " is outside 0 to " +
                        std::to_string(mesh.materials.size()));
  Wrong places, corners;
  for (std::size_t i = 0; i < mesh.vertices.size(); ++i) {
    const Vec3& v = mesh.vertices[i];
    const double size = std::fabs(v.x()) + std::fabs(v.y()) + std::fabs(v.z());
    if (!(size < LARGEST)) places.add(i);
  }
  for (std::size_t i = 0; i < mesh.faces.size(); ++i)
    for (const std::uint32_t corner : mesh.faces[i])
      if (corner >= mesh.vertices.size()) corners.add(i);
  if (places.count > 0)
    faults.add(firstOf(places.count, "vertices are not finite or beyond 1e9", places.first));
  if (corners.count > 0)
    faults.add(firstOf(corners.count, "corners of faces are no vertices", corners.first));
}

/// Disjoint sets; the smallest member represents a set.
class Sets {
 public:
  explicit Sets(std::size_t size) : of_(size) { std::iota(of_.begin(), of_.end(), 0U); }
  std::uint32_t find(std::uint32_t i) {
    while (of_[i] != i) i = of_[i] = of_[of_[i]];
    return i;
  }
  void join(std::uint32_t a, std::uint32_t b) {
    a = find(a), b = find(b);
    of_[std::max(a, b)] = std::min(a, b);
  }

 private:
  std::vector<std::uint32_t> of_;
};

/// Returns for each vertex the first one at the same position.
std::vector<std::uint32_t> samePlaces(const std::vector<Vec3>& vertices) {
  std::vector<std::uint32_t> order(vertices.size()), out(vertices.size());
  std::iota(order.begin(), order.end(), 0U);
  const auto key = [&](std::uint32_t i) {
    const Vec3& v = vertices[i];
    return std::array<double, 3>{v.x(), v.y(), v.z()};
  };
  std::sort(order.begin(), order.end(), [&](std::uint32_t a, std::uint32_t b) {
    const auto ka = key(a), kb = key(b);
    return ka != kb ? ka < kb : a < b;
  });
  for (std::size_t i = 0; i < order.size(); ++i)
    out[order[i]] = i > 0 && key(order[i]) == key(order[i - 1]) ? out[order[i - 1]] : order[i];
  return out;
}

struct Edge {
  std::uint32_t low, high;
  bool rigid;
  std::uint32_t face;
  std::array<std::uint32_t, 3> key() const { return {low, high, rigid ? 1U : 0U}; }
};

/// Scales a mesh to the units of Form.
class Measure {
 public:
  Measure(const LeafMesh& mesh, bool y_up) : y_up_(y_up), low_(Vec3::Zero()), high_(low_) {
    bool first = true;
    for (const auto& face : mesh.faces)
      for (const std::uint32_t corner : face) {
        const Vec3 v = upright(mesh.vertices[corner]);
        low_ = first ? v : Vec3(low_.cwiseMin(v));
        high_ = first ? v : Vec3(high_.cwiseMax(v));
        first = false;
      }
  }
  double height() const { return high_.z() - low_.z(); }
  bool isFlat() const {
    return !(height() > FLATTEST * std::max(high_.x() - low_.x(), high_.y() - low_.y())) ||
           !(height() > 0.0);
  }
  Vec3 operator()(const Vec3& vertex) const {
    const Vec3 foot(0.5 * (low_.x() + high_.x()), 0.5 * (low_.y() + high_.y()), low_.z());
    return Vec3(upright(vertex) - foot) / height();
  }

  /// Turns a direction or a place of the mesh so that z points up.
  Vec3 upright(const Vec3& v) const { return y_up_ ? Vec3(v.x(), -v.z(), v.y()) : v; }

 private:
  bool y_up_;
  Vec3 low_, high_;
};

/// Returns the places of a triangle in a texture that repeats, moved into 0 to 1 by whole repeats;
/// what is still beyond is at the edge.
std::array<std::array<float, 2>, 3> placesOf(const LeafMesh& mesh,
                                             const std::array<std::uint32_t, 3>& face) {
  std::array<std::array<float, 2>, 3> out{};
  if (mesh.uv.empty()) return out;
  for (std::size_t axis = 0; axis < 2; ++axis) {
    double middle = 0.0;
    for (const std::uint32_t corner : face) middle += mesh.uv[corner][axis] / 3.0;
    for (std::size_t k = 0; k < 3; ++k) {
      const double place = mesh.uv[face[k]][axis] - std::floor(middle);
      out[k][axis] = std::isfinite(place) ? static_cast<float>(saturate(place)) : 0.F;
    }
  }
  return out;
}

std::array<float, 3> normalOf(const LeafMesh& mesh, const std::array<std::uint32_t, 3>& face,
                              const Measure& measure) {
  if (mesh.normals.empty()) return {};
  Vec3 sum = Vec3::Zero();
  for (const std::uint32_t corner : face) sum += measure.upright(mesh.normals[corner]);
  const double size = length(sum);
  if (!(size > 1e-6) || !std::isfinite(size)) return {};
  return {static_cast<float>(sum.x() / size), static_cast<float>(sum.y() / size),
          static_cast<float>(sum.z() / size)};
}

/// Returns the root vertex of each leaf.
std::vector<std::uint32_t> rootsOf(const LeafMesh& mesh, const std::vector<std::uint32_t>& leaves,
                                   const Measure& measure) {
  std::vector<std::uint32_t> out;
  const auto rank = [&](std::uint32_t vertex) {
    if (mesh.uv.empty()) return measure(mesh.vertices[vertex]).z();
    const auto& uv = mesh.uv[vertex];
    const double square = uv[0] * uv[0] + uv[1] * uv[1];
    return square >= 0.0 ? square : LARGEST;  // not finite: last
  };
  for (std::size_t face = 0; face < leaves.size(); ++face)
    for (const std::uint32_t vertex : mesh.faces[face]) {
      if (leaves[face] == out.size()) out.push_back(vertex);
      std::uint32_t& root = out[leaves[face]];
      if (rank(vertex) < rank(root)) root = vertex;
    }
  return out;
}

std::string inSmallLetters(const std::string& text) {
  std::string out;
  for (const char c : text) out += static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
  return out;
}

}  // namespace

bool isRigidName(const std::string& name, const std::string& words) {
  const std::string small = inSmallLetters(name);
  std::istringstream list(inSmallLetters(words));
  for (std::string word; list >> word;)
    if (small.find(word) != std::string::npos) return true;
  return false;
}

std::vector<std::uint32_t> leavesOf(const LeafMesh& mesh) {
  const std::vector<std::uint32_t> place = samePlaces(mesh.vertices);
  std::vector<Edge> edges;
  edges.reserve(3 * mesh.faces.size());
  for (std::size_t i = 0; i < mesh.faces.size(); ++i)
    for (std::size_t k = 0; k < 3; ++k) {
      const std::uint32_t a = place[mesh.faces[i][k]], b = place[mesh.faces[i][(k + 1) % 3]];
      const bool rigid = !mesh.rigid.empty() && mesh.rigid[i];
      edges.push_back({std::min(a, b), std::max(a, b), rigid, static_cast<std::uint32_t>(i)});
    }
  std::sort(edges.begin(), edges.end(),
            [](const Edge& a, const Edge& b) { return a.key() < b.key(); });
  Sets sets(mesh.faces.size());
  for (std::size_t i = 1; i < edges.size(); ++i)
    if (edges[i].key() == edges[i - 1].key()) sets.join(edges[i - 1].face, edges[i].face);
  std::vector<std::uint32_t> out(mesh.faces.size());
  std::uint32_t count = 0;  // the smallest face of a set comes first
  for (std::uint32_t i = 0; i < out.size(); ++i)
    out[i] = sets.find(i) == i ? count++ : out[sets.find(i)];
  return out;
}

Form formOf(const LeafMesh& mesh, bool y_up) {
  Faults faults;
  check(mesh, faults);
  faults.throwIfAny();
  const Measure measure(mesh, y_up);
  if (measure.isFlat()) throw InvalidInput("height = 0: its vertices lie in a level plane");
  const std::vector<std::uint32_t> leaves = leavesOf(mesh);
  const std::vector<std::uint32_t> roots = rootsOf(mesh, leaves, measure);
  const Random random(0x6d657368);
  Form out;
  out.materials = mesh.materials;
  for (std::size_t i = 0; i < mesh.faces.size(); ++i) {
    const auto corner = [&](std::size_t k) { return measure(mesh.vertices[mesh.faces[i][k]]); };
    Leaf face;
    face.anchor = measure(mesh.vertices[roots[leaves[i]]]);
    face.root = 0.5 * (corner(0) + corner(1));
    face.side = 0.5 * (corner(1) - corner(0));
    face.tip = corner(2);
    face.root_width = 1.0F;
    face.tip_width = 0.0F;
    face.joined = true;
    face.shade = static_cast<float>(random.uniform(leaves[i]));
    const double away = 2.0 * length(Vec3(face.tip - Vec3(0.0, 0.0, 0.5)));
    face.light = static_cast<float>(0.4 + 0.6 * saturate(away));
    if (!mesh.material.empty() && mesh.material[i] > 0) {
      out.looks.push_back({placesOf(mesh, mesh.faces[i]), normalOf(mesh, mesh.faces[i], measure),
                           static_cast<std::uint16_t>(mesh.material[i] - 1)});
      face.look = static_cast<std::uint32_t>(out.looks.size());
    }
    (!mesh.rigid.empty() && mesh.rigid[i] ? out.rigid : out.leaves).push_back(face);
  }
  finish(out);
  return out;
}

}  // namespace vegetation_sim::canopy
