// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cmath>
#include <cstdint>
#include <map>
#include <string>
#include <vector>

#include "vegetation_sim/canopy/plants/plant.h"
#include "vegetation_sim/core/math/hash.h"
#include "vegetation_sim/tree/physical/body.h"

namespace vegetation_sim {
class Archive;
}

namespace vegetation_sim::canopy {

/// A horizontal vector in world axes.
struct Flat {
  double x{0.0}, y{0.0};
  double dot(const Flat& other) const { return x * other.x + y * other.y; }
  double size() const { return std::sqrt(dot(*this)); }
};

/// Largest angle by which fibres lean [rad], and the unit in which messages and leaves have it.
constexpr double LARGEST_LEAN = 1.5, LEAN_UNIT = 5e-5;
/// Limit of the cells of all plants that lean.
constexpr std::size_t MOST_CLUSTERS = 8192;
/// Largest number of bodies that push.
constexpr std::size_t MOST_PUSHING = 1024;

/// The medium of which a plant consists for bodies: vertical fibres of equal length, each of which
/// turns about its own foot. They fill a square of side x side cells, row by row from the lowest x
/// and y.
struct Fibres {
  Vec3 foot{Vec3::Zero()};  ///< of the fibre in the middle, world [m]
  double length{1.0};       ///< [m]
  double half{1.0};         ///< half of the edge of the square [m]
  int side{1};              ///< cells along the edge

  double edge() const { return 2.0 * half / side; }  ///< of a cell [m]
  std::size_t cells() const {
    return static_cast<std::size_t>(side) * static_cast<std::size_t>(side);
  }
  /// Returns the foot of the fibre in the middle of a cell.
  Vec3 footOf(std::size_t cell) const;
};
/// Length below which fibres answer no body: the stubble of a plant that is cut at its foot, or of
/// a crown that is cut at its trunk [m].
constexpr double SHORTEST_FIBRES = 1e-3;
/// Returns the fibres of a plant that is cut at a height [m]; those of a crown stand on its trunk.
/// Cutting does not change their cells.
Fibres fibresOf(const PlantKind& kind, const Plant& plant, double height = UNCUT);
/// Returns the share of a cell that lies within the circle of the plant's radius.
double filledShare(const Fibres& fibres, std::size_t cell);

/// The fibres of a cell, which lean alike.
struct Cluster {
  Flat lean;  ///< direction of the lean times its angle [rad]
  Flat rate;  ///< [rad/s]
  Flat set;   ///< lean without any force, until they have recovered [rad]

  bool rests() const;
};

/// Leans and cuts of plants, by bodies and tools.
struct PushState {
  std::map<std::uint32_t, std::vector<Cluster>> plants;  ///< that lean, by id, cell by cell
  forest::Bodies bodies;                                 ///< that push
  Stubble stubble;
  /// Returns the height at which a plant has been cut, or UNCUT [m].
  double heightOf(std::uint32_t plant) const;
  /// Adds nothing if there are no bodies and no plants that lean or have been cut.
  void addTo(Hash& hash) const;
};
void archivePush(Archive& a, PushState& state);

/// Force of a plant on a body: the mean over a tick.
struct PushForce {
  std::string body, frame;    ///< Body::id, Body::frame
  std::uint32_t plant{0};     ///< id
  Vec3 point{Vec3::Zero()};   ///< of application, world [m]
  Vec3 force{Vec3::Zero()};   ///< on the body, world [N]
  Vec3 torque{Vec3::Zero()};  ///< on the body about `point`, world [N m]
  double volume{0.0};         ///< of the overlap [m^3]
};

/// The lean of one cell in steps of LEAN_UNIT, as replicas receive it.
struct BentCell {
  std::uint32_t plant{0};
  std::uint16_t cell{0};
  std::int16_t x{0}, y{0};
};
/// Returns the cells that lean, in rising order of plants and cells.
std::vector<BentCell> bentCells(const PushState& state);

/// Returns the lean at a place by bilinear interpolation between the middles of the cells.
Flat leanAt(const Fibres& fibres, const std::vector<Flat>& cells, const Vec3& place);
/// Returns the rotation of a fibre that leans.
Quat leanTurn(const Flat& lean);

}  // namespace vegetation_sim::canopy
