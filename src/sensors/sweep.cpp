// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#include "sensors/sweep.h"

#include <algorithm>
#include <cmath>

#include "vegetation_sim/core/math/random.h"

namespace vegetation_sim::scan {
namespace {

constexpr double ENDLESS = std::numeric_limits<double>::infinity();
constexpr std::array<double, LABELS> REFLECTANCE{0.0, 0.25, 0.35, 0.35, 0.5, 0.45, 0.4};

double measured(const Hit& hit, const Beams& beams, double error) {
  if (hit.label == Label::NONE) return ENDLESS;
  const double range = hit.distance + error;
  if (hit.distance < beams.range_min || range < beams.range_min) return -ENDLESS;
  return range > beams.range_max ? ENDLESS : range;
}

}  // namespace

void describe(FieldVisitor& v, Beams& b) {
  v.integer("rings", b.rings, "", {1, 512});
  v.number("elevation_low", b.elevation_low, "rad", {-1.5707, 1.5707});
  v.number("elevation_high", b.elevation_high, "rad", {-1.5707, 1.5707});
  v.integer("columns", b.columns, "", {1, 14400});
  v.number("azimuth_low", b.azimuth_low, "rad", {-6.2832, 6.2832});
  v.number("azimuth_high", b.azimuth_high, "rad", {-6.2832, 6.2832});
  v.number("range_min", b.range_min, "m", {0.0, 100.0});
  v.number("range_max", b.range_max, "m", {0.1, 500.0});
  v.number("noise", b.noise, "m", {0.0, 1.0});
}

void check(const Beams& b, const std::string& context, Faults& faults) {
  const auto ordered = [&](const char* low, double at, const char* high, double end, bool may) {
    if (!(at < end || (may && at == end)))
      faults.add(context + high + " = " + std::to_string(end) + " is not above " + low + " = " +
                 std::to_string(at));
  };
  ordered("elevation_low", b.elevation_low, "elevation_high", b.elevation_high, true);
  ordered("azimuth_low", b.azimuth_low, "azimuth_high", b.azimuth_high, false);
  ordered("range_min", b.range_min, "range_max", b.range_max, false);
  if (b.azimuth_high - b.azimuth_low > 2.0 * PI + 1e-3)
    faults.add(context + "azimuth_high is more than a turn above azimuth_low");
}

Vec3 directionOf(const Beams& b, int ring, int column) {
  const double up = b.rings > 1 ? static_cast<double>(ring) / (b.rings - 1) : 0.5;
  const SinCos e = sinCos(b.elevation_low + up * (b.elevation_high - b.elevation_low));
  const SinCos a = sinCos(b.azimuth_low + (b.azimuth_high - b.azimuth_low) * column / b.columns);
  return {e.cos * a.cos, e.cos * a.sin, e.sin};
}

Beams planeOf(const Beams& beams) {
  Beams out = beams;
  out.rings = 1;
  out.elevation_low = out.elevation_high = 0.0;
  return out;
}

double unitNoise(const NoiseKeys& noise, std::uint64_t ray) {
  const Random random = Random(noise.seed).child(noise.sensor).child(noise.sweep).child(ray);
  double sum = -6.0;
  for (std::uint64_t i = 0; i < 3; ++i)  // four numbers of 16 bits each
    for (std::uint64_t bits = random.bits(i), k = 0; k < 4; ++k, bits >>= 16)
      sum += (static_cast<double>(bits & 0xffff) + 0.5) / 65536.0;
  return sum;
}

std::vector<Return> sweep(const Scene& scene, const Beams& beams, const Pose& sensor,
                          const NoiseKeys& noise, ThreadPool& threads) {
  std::vector<Return> out(static_cast<std::size_t>(beams.rings) *
                          static_cast<std::size_t>(beams.columns));
  const auto stride = static_cast<int>(threads.size());
  threads.run(threads.size(), [&](std::size_t first) {
    for (int column = static_cast<int>(first); column < beams.columns; column += stride)
      for (int ring = 0; ring < beams.rings; ++ring) {
        const auto i = static_cast<std::size_t>(ring) * static_cast<std::size_t>(beams.columns) +
                       static_cast<std::size_t>(column);
        const Vec3 direction = rotate(sensor.orientation, directionOf(beams, ring, column));
        out[i].hit = cast(scene, Ray(sensor.position, direction), beams.range_max);
        const double error = beams.noise > 0.0 ? beams.noise * unitNoise(noise, i) : 0.0;
        out[i].range = measured(out[i].hit, beams, error);
      }
  });
  return out;
}

std::array<std::uint32_t, LABELS> countLabels(const std::vector<Return>& returns) {
  std::array<std::uint32_t, LABELS> out{};
  for (const Return& one : returns)
    ++out[one.isPoint() ? static_cast<std::size_t>(one.hit.label) : 0];
  return out;
}

double intensityOf(const Hit& hit) {
  return REFLECTANCE[static_cast<std::size_t>(hit.label)] * hit.cosine;
}

}  // namespace vegetation_sim::scan
