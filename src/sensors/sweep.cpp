// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#include "sensors/sweep.h"

#include <algorithm>
#include <optional>

namespace vegetation_sim::scan {
namespace {

/// Measures the beams of a sweep, tile by tile, in one thread.
class Sweeper {
 public:
  Sweeper(const Scene& scene, const Lidar& lidar, const SensorPath& path, const NoiseKeys& noise,
          std::vector<Return>& out)
      : beams_(lidar.beams),
        shape_(lidar.model.shape),
        path_(path),
        noise_(noise),
        receiver_(lidar.model, beams_.range_min, beams_.range_max),
        pattern_(shape_),
        directions_(beams_),
        caster_(scene, beams_.range_max),
        out_(out) {}

  /// Measures the beams of a number of columns.
  void measure(int column, BeamTile tile) {
    tile.columns = std::min(tile.columns, beams_.columns - column);
    poses_.clear();
    for (int i = 0; i < tile.columns; ++i)
      poses_.push_back(path_.at(timeOf(beams_, column + i, path_.seconds())));
    for (int ring = 0; ring < beams_.rings; ring += tile.rings)
      measure(ring, column, {std::min(tile.rings, beams_.rings - ring), tile.columns});
  }

 private:
  void measure(int ring, int column, const BeamTile& tile) {
    rays_.clear();
    for (int r = 0; r < tile.rings; ++r)
      for (int c = 0; c < tile.columns; ++c) {
        const Pose& sensor = poses_[static_cast<std::size_t>(c)];
        const Vec3 axis = rotate(sensor.orientation, directions_.at(ring + r, column + c));
        for (int ray = 0; ray < pattern_.rays(); ++ray)
          rays_.emplace_back(sensor.position, pattern_.direction(axis, ray));
      }
    auto next = caster_.cast(rays_).cbegin();
    for (int r = 0; r < tile.rings; ++r)
      for (int c = 0; c < tile.columns; ++c, next += pattern_.rays()) {
        hits_.assign(next, next + pattern_.rays());
        receive(ring + r, column + c);
      }
  }

  void receive(int ring, int column) {
    const auto i = static_cast<std::size_t>(ring) * static_cast<std::size_t>(beams_.columns) +
                   static_cast<std::size_t>(column);
    joinHits(hits_, shape_.separation, echoes_);
    const std::optional<RayRandom> numbers =
        receiver_.isRandom() ? std::optional<RayRandom>(RayRandom(noise_, i)) : std::nullopt;
    receiver_.receive(echoes_, numbers ? &*numbers : nullptr, detected_,
                      &out_[i * static_cast<std::size_t>(receiver_.returns())]);
  }

  const Beams& beams_;
  const BeamShape& shape_;
  const SensorPath& path_;
  const NoiseKeys& noise_;
  const Receiver receiver_;
  const BeamPattern pattern_;
  const BeamDirections directions_;
  RayCaster caster_;
  std::vector<Return>& out_;
  std::vector<Pose> poses_;  ///< of the sensor, for each column of a tile
  std::vector<Ray> rays_;
  std::vector<Hit> hits_;
  std::vector<Echo> echoes_;
  std::vector<Return> detected_;
};

}  // namespace

int returnsPerRay(const SensorModel& model) {
  return Receiver(model, 0.0, 0.0).returns();
}

std::vector<Return> sweep(const Scene& scene, const Lidar& lidar, const SensorPath& path,
                          const NoiseKeys& noise, ThreadPool& threads) {
  const Beams& beams = lidar.beams;
  std::vector<Return> out(static_cast<std::size_t>(beams.rings) *
                          static_cast<std::size_t>(beams.columns) *
                          static_cast<std::size_t>(returnsPerRay(lidar.model)));
  const BeamTile tile = tileOf(beams);
  const auto stride = static_cast<int>(threads.size()) * tile.columns;
  threads.run(threads.size(), [&](std::size_t first) {
    Sweeper sweeper(scene, lidar, path, noise, out);
    for (int column = static_cast<int>(first) * tile.columns; column < beams.columns;
         column += stride)
      sweeper.measure(column, tile);
  });
  return out;
}

std::array<std::uint32_t, LABELS> countLabels(const std::vector<Return>& returns, int per_ray) {
  std::array<std::uint32_t, LABELS> out{};
  for (std::size_t i = 0; i < returns.size(); ++i) {
    const bool point = returns[i].isPoint();
    if (point || i % static_cast<std::size_t>(per_ray) == 0)
      ++out[point ? static_cast<std::size_t>(returns[i].hit.label) : 0];
  }
  return out;
}

}  // namespace vegetation_sim::scan
