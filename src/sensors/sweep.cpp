// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#include "sensors/sweep.h"

#include <optional>

namespace vegetation_sim::scan {
namespace {

/// Memory of one thread.
struct Scratch {
  std::vector<Hit> hits;
  std::vector<Echo> echoes;
  std::vector<Return> detected;
};

}  // namespace

int returnsPerRay(const SensorModel& model) {
  return Receiver(model, 0.0, 0.0).returns();
}

std::vector<Return> sweep(const Scene& scene, const Lidar& lidar, const SensorPath& path,
                          const NoiseKeys& noise, ThreadPool& threads) {
  const Beams& beams = lidar.beams;
  const Receiver receiver(lidar.model, beams.range_min, beams.range_max);
  const BeamPattern pattern(lidar.model.shape);
  const BeamDirections directions(beams);
  const bool random = receiver.isRandom();
  const auto columns = static_cast<std::size_t>(beams.columns);
  const auto per_ray = static_cast<std::size_t>(receiver.returns());
  std::vector<Return> out(static_cast<std::size_t>(beams.rings) * columns * per_ray);
  const auto castBeam = [&](const Pose& sensor, int ring, int column, Scratch& scratch) {
    const auto i = static_cast<std::size_t>(ring) * columns + static_cast<std::size_t>(column);
    const Vec3 axis = rotate(sensor.orientation, directions.at(ring, column));
    scratch.hits.clear();
    for (int ray = 0; ray < pattern.rays(); ++ray)
      scratch.hits.push_back(
          cast(scene, Ray(sensor.position, pattern.direction(axis, ray)), beams.range_max));
    joinHits(scratch.hits, lidar.model.shape.separation, scratch.echoes);
    const std::optional<RayRandom> numbers =
        random ? std::optional<RayRandom>(RayRandom(noise, i)) : std::nullopt;
    receiver.receive(scratch.echoes, numbers ? &*numbers : nullptr, scratch.detected,
                     &out[i * per_ray]);
  };
  const auto stride = static_cast<int>(threads.size());
  threads.run(threads.size(), [&](std::size_t first) {
    Scratch scratch;
    for (int column = static_cast<int>(first); column < beams.columns; column += stride) {
      const Pose sensor = path.at(timeOf(beams, column, path.seconds()));
      for (int ring = 0; ring < beams.rings; ++ring) castBeam(sensor, ring, column, scratch);
    }
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
