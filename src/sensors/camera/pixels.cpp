// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#include "sensors/camera/pixels.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>

#include "sensors/camera/shading.h"

namespace vegetation_sim::scan {
namespace {

constexpr double FAR = std::numeric_limits<double>::infinity();

// Samples of a pixel (Roberts 2018, a sequence of low discrepancy whose first one is the middle).
Pixel sampleOf(int column, int row, int sample) {
  const auto part = [](double x) { return x - std::floor(x) - 0.5; };
  return {column + part(0.5 + 0.7548776662466927 * sample),
          row + part(0.5 + 0.5698402909980532 * sample)};
}

float depthOf(const Hit& hit, double cosine, const Camera& camera) {
  if (hit.label == Label::NONE) return static_cast<float>(FAR);
  return static_cast<float>(hit.distance < camera.range_min ? -FAR : hit.distance * cosine);
}

std::int32_t instanceOf(const Hit& hit) {
  const bool none =
      hit.label == Label::NONE || hit.label == Label::GROUND || hit.label == Label::GRASS;
  return none ? -1 : static_cast<std::int32_t>(hit.plant);
}

constexpr int TILE_COLUMNS = 8, TILE_ROWS = RayBundle::MOST_RAYS / TILE_COLUMNS;

/// Takes the pixels of images, tile by tile, in one thread.
class ImageTaker {
 public:
  /// @param shading null: no colours.
  ImageTaker(const Scene& scene, const Camera& camera, const Pose& optical, const NoiseKeys& noise,
             const Shading* shading, Images& out)
      : camera_(camera),
        optical_(optical),
        noise_(noise),
        shading_(shading),
        caster_(scene, camera.range_max, GrassGrain::BLADES),
        out_(out) {}

  /// Takes the tile whose first pixel is given.
  void take(int column, int row) {
    pixels_.clear();
    for (int y = row; y < std::min(row + TILE_ROWS, camera_.lens.height); ++y)
      for (int x = column; x < std::min(column + TILE_COLUMNS, camera_.lens.width); ++x)
        pixels_.push_back({x, y});
    sums_.assign(pixels_.size(), Vec3::Zero());
    for (int sample = 0; sample < (shading_ ? camera_.samples : 1); ++sample) takeSample(sample);
    if (!shading_) return;
    for (std::size_t p = 0; p < pixels_.size(); ++p) {
      const std::size_t i = indexOf(pixels_[p]);
      const std::optional<RayRandom> random =
          noisy_ ? std::optional<RayRandom>(RayRandom(noise_, i)) : std::nullopt;
      out_.colour[i] =
          develop(camera_.exposure, sums_[p] / camera_.samples, random ? &*random : nullptr);
    }
  }

 private:
  struct Place {
    int column, row;
  };
  std::size_t indexOf(const Place& place) const {
    return static_cast<std::size_t>(place.row) * static_cast<std::size_t>(camera_.lens.width) +
           static_cast<std::size_t>(place.column);
  }

  // Depth and labels are those of the first sample.
  void takeSample(int sample) {
    rays_.clear();
    cosines_.clear();
    for (const Place& pixel : pixels_) {
      const Vec3 direction = directionOf(camera_.lens, sampleOf(pixel.column, pixel.row, sample));
      cosines_.push_back(direction.z());
      rays_.emplace_back(optical_.position, rotate(optical_.orientation, direction));
    }
    const std::vector<Hit>& hits = caster_.cast(rays_);
    for (std::size_t p = 0; p < pixels_.size(); ++p) {
      if (sample == 0) record(indexOf(pixels_[p]), hits[p], cosines_[p]);
      if (shading_) sums_[p] += shading_->radiance(rays_[p], hits[p]);
    }
  }

  void record(std::size_t i, const Hit& hit, double cosine) {
    if (!out_.depth.empty()) out_.depth[i] = depthOf(hit, cosine, camera_);
    if (!out_.label.empty()) out_.label[i] = static_cast<std::uint16_t>(hit.label);
    if (!out_.instance.empty()) out_.instance[i] = instanceOf(hit);
  }

  const Camera& camera_;
  const Pose& optical_;
  const NoiseKeys& noise_;
  const Shading* shading_;
  RayCaster caster_;
  Images& out_;
  const bool noisy_{camera_.exposure.read_noise > 0.0 || camera_.exposure.shot_noise > 0.0};
  std::vector<Place> pixels_;
  std::vector<Ray> rays_;
  std::vector<double> cosines_;  ///< of the rays with the optical axis
  std::vector<Vec3> sums_;       ///< radiance of the samples so far
};

}  // namespace

Images takeImages(const Scene& scene, const Camera& camera, const Pose& optical,
                  const NoiseKeys& noise, const Wanted& wanted, ThreadPool& threads) {
  const auto width = static_cast<std::size_t>(camera.lens.width);
  const auto height = static_cast<std::size_t>(camera.lens.height);
  Images out;
  out.colour.resize(wanted.colour ? width * height : 0);
  out.depth.resize(wanted.depth ? width * height : 0);
  out.label.resize(wanted.label ? width * height : 0);
  out.instance.resize(wanted.instance ? width * height : 0);
  const std::optional<Shading> shading =
      wanted.colour ? std::optional<Shading>(std::in_place, scene, camera) : std::nullopt;
  const auto stride = static_cast<int>(threads.size()) * TILE_ROWS;
  threads.run(threads.size(), [&](std::size_t first) {
    ImageTaker taker(scene, camera, optical, noise, shading ? &*shading : nullptr, out);
    for (int row = static_cast<int>(first) * TILE_ROWS; row < camera.lens.height; row += stride)
      for (int column = 0; column < camera.lens.width; column += TILE_COLUMNS)
        taker.take(column, row);
  });
  return out;
}

}  // namespace vegetation_sim::scan
