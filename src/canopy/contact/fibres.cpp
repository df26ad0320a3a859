// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#include "vegetation_sim/canopy/contact/fibres.h"

#include <algorithm>
#include <cmath>

#include "core/archive/archive.h"
#include "forest/contact/contact_body.h"
#include "vegetation_sim/core/math/math.h"

namespace vegetation_sim::canopy {
namespace {

constexpr int MOST_ON_A_SIDE = 16;
constexpr int SUBDIVISIONS = 12;  // of a cell's edge, for the share within the circle
constexpr double STILL = 2e-5;    // [rad], [rad/s]: less than half of LEAN_UNIT
constexpr std::size_t CLUSTER_BYTES = 48, BODY_BYTES = 200, LONGEST_NAME = 4096;

bool isStill(const Flat& v) {
  return std::fabs(v.x) < STILL && std::fabs(v.y) < STILL;
}

std::int16_t inUnits(double lean) {
  return static_cast<std::int16_t>(std::lround(lean / LEAN_UNIT));
}

void archiveFlat(Archive& a, const char* name, Flat& v, double limit) {
  a.number(name, v.x, {-limit, limit});
  a.number(name, v.y, {-limit, limit});
}

}  // namespace

Vec3 Fibres::footOf(std::size_t cell) const {
  const auto row = static_cast<int>(cell) / side, column = static_cast<int>(cell) % side;
  return foot + Vec3((column + 0.5) * edge() - half, (row + 0.5) * edge() - half, 0.0);
}

Fibres fibresOf(const PlantKind& kind, const Plant& plant, double height) {
  const double top = plant.scale * kind.height;
  const double trunk = kind.shape == PlantShape::CROWN ? TRUNK_SHARE * top : 0.0;
  Fibres out;
  out.foot = plant.position + Vec3(0.0, 0.0, trunk);
  out.length = std::max(0.0, std::min(height, top) - trunk);
  out.half = plant.scale * (kind.form ? kind.height * kind.form->radius : kind.radius);
  out.half = std::max(out.half, 1e-3);
  out.side =
      std::clamp(static_cast<int>(std::ceil(2.0 * out.half / kind.push.cell)), 1, MOST_ON_A_SIDE);
  return out;
}

double filledShare(const Fibres& fibres, std::size_t cell) {
  const Vec3 middle = fibres.footOf(cell) - fibres.foot;
  const double step = fibres.edge() / SUBDIVISIONS;
  int inside = 0;
  for (int i = 0; i < SUBDIVISIONS; ++i)
    for (int j = 0; j < SUBDIVISIONS; ++j) {
      const double x = middle.x() + (i + 0.5 - 0.5 * SUBDIVISIONS) * step;
      const double y = middle.y() + (j + 0.5 - 0.5 * SUBDIVISIONS) * step;
      inside += x * x + y * y <= fibres.half * fibres.half ? 1 : 0;
    }
  return static_cast<double>(inside) / (SUBDIVISIONS * SUBDIVISIONS);
}

bool Cluster::rests() const {
  return isStill(lean) && isStill(rate) && isStill(set);
}

double PushState::heightOf(std::uint32_t plant) const {
  const auto cut = stubble.find(plant);
  return cut == stubble.end() ? UNCUT : cut->second;
}

void PushState::addTo(Hash& hash) const {
  for (const auto& [id, clusters] : plants) {
    hash.add(static_cast<std::uint64_t>(id));
    for (const Cluster& cluster : clusters)
      for (const Flat& v : {cluster.lean, cluster.rate, cluster.set}) hash.add(v.x), hash.add(v.y);
  }
  for (const auto& [id, body] : bodies) {
    hash.add(id);
    forest::addTo(hash, body);
  }
  for (const auto& [id, height] : stubble) {
    hash.add(static_cast<std::uint64_t>(id));
    hash.add(height);
  }
}

void archivePush(Archive& a, PushState& state) {
  const auto one = [&a](Cluster& cluster) {
    archiveFlat(a, "lean", cluster.lean, LARGEST_LEAN);
    archiveFlat(a, "lean rate", cluster.rate, 1e9);
    archiveFlat(a, "lean set", cluster.set, LARGEST_LEAN);
  };
  a.map(
      "plants that lean", state.plants, MOST_CLUSTERS, sizeof(std::uint32_t) + CLUSTER_BYTES,
      [&a](std::uint32_t& id) { a.integer("plant that leans", id); },
      [&](std::uint32_t, std::vector<Cluster>& clusters) {
        a.list("cells", clusters, MOST_CLUSTERS, CLUSTER_BYTES, one);
      });
  a.map(
      "pushing bodies", state.bodies, MOST_PUSHING, BODY_BYTES,
      [&a](std::string& id) { a.text("pushing body", id, LONGEST_NAME); },
      [&a](const std::string&, forest::Body& body) { forest::archiveBody(a, body); });
  a.map(
      "cut plants", state.stubble, MOST_PLANTS, sizeof(std::uint32_t) + sizeof(double),
      [&a](std::uint32_t& id) { a.integer("cut plant", id); },
      [&a](std::uint32_t, double& height) { a.number("height of a cut", height, CUT_HEIGHTS); });
}

std::vector<BentCell> bentCells(const PushState& state) {
  std::vector<BentCell> out;
  for (const auto& [id, clusters] : state.plants)
    for (std::size_t cell = 0; cell < clusters.size(); ++cell) {
      const Flat& lean = clusters[cell].lean;
      const BentCell bent{id, static_cast<std::uint16_t>(cell), inUnits(lean.x), inUnits(lean.y)};
      if (bent.x != 0 || bent.y != 0) out.push_back(bent);
    }
  return out;
}

Flat leanAt(const Fibres& fibres, const std::vector<Flat>& cells, const Vec3& place) {
  const int last = fibres.side - 1;
  const auto along = [&](double offset) {
    return std::clamp((offset + fibres.half) / fibres.edge() - 0.5, 0.0, static_cast<double>(last));
  };
  const double x = along(place.x() - fibres.foot.x()), y = along(place.y() - fibres.foot.y());
  const int left = std::min(static_cast<int>(x), std::max(0, last - 1));
  const int low = std::min(static_cast<int>(y), std::max(0, last - 1));
  const double p = x - left, q = y - low;
  const auto at = [&](int column, int row) {
    return cells[static_cast<std::size_t>(std::min(row, last) * fibres.side +
                                          std::min(column, last))];
  };
  const Flat a = at(left, low), b = at(left + 1, low), c = at(left, low + 1),
             d = at(left + 1, low + 1);
  const auto mix = [&](double a0, double b0, double c0, double d0) {
    return (1.0 - q) * ((1.0 - p) * a0 + p * b0) + q * ((1.0 - p) * c0 + p * d0);
  };
  return {mix(a.x, b.x, c.x, d.x), mix(a.y, b.y, c.y, d.y)};
}

// The axis is horizontal and perpendicular to the lean.
Quat leanTurn(const Flat& lean) {
  const double angle = lean.size();
  if (!(angle > 0.0)) return {};
  const SinCos half = sinCos(0.5 * angle);
  return {half.cos, -lean.y / angle * half.sin, lean.x / angle * half.sin, 0.0};
}

}  // namespace vegetation_sim::canopy
