// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#include "sensors/camera/camera.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>

#include "sensors/camera/surface.h"
#include "sensors/camera/texture.h"
#include "sensors/sky_view.h"
#include "vegetation_sim/core/math/math.h"

namespace vegetation_sim::scan {
namespace {

constexpr double FAR = std::numeric_limits<double>::infinity();
constexpr double OFFSET = 1e-3;       // of rays of light from their surface [m]
constexpr double FARTHEST = 20000.0;  // ground that is seen beyond the range [m]
constexpr double DARK = 5.0;          // optical depth that leaves 0.7 % of the light
constexpr double OPEN_SPOT = 0.02;    // places that look at one part of the sky [m]
constexpr std::uint32_t OPEN_KEY = 0x6f70656eU;

/// Light that comes along rays.
class Picture {
 public:
  Picture(const Scene& scene, const Camera& camera)
      : scene_(scene), camera_(camera), light_(camera.light), surfaces_(scene) {}

  Vec3 radiance(const Ray& ray, const Hit& hit) const {
    if (hit.label == Label::NONE) return beyond(ray);
    const Vec3 place = ray.at(hit.distance);
    const bool sheltered = hit.label == Label::GROUND && camera_.shadows != Shadows::NONE;
    const Surface surface = sheltered ? groundAt(place) : surfaces_.at(ray, hit);
    return light_.through(lit(place, surface), hit.distance);
  }

 private:
  Surface groundAt(const Vec3& place) const {
    const double open = openness(place);
    Surface out = surfaces_.groundAt(place, open);
    out.sky = 0.25 + 0.75 * open;
    return out;
  }

  // Ground beyond the range is a plane; the rest is sky.
  Vec3 beyond(const Ray& ray) const {
    const Vec3 end = ray.at(camera_.range_max);
    const double above = end.z() - scene_.ground->height(end.x(), end.y());
    if (!(ray.direction.z() < 0.0 && above > 0.0)) return light_.skyTowards(ray.direction);
    const double distance = camera_.range_max - above / ray.direction.z();
    if (distance > FARTHEST) return light_.through(light_.skyTowards(ray.direction), FARTHEST);
    Surface ground = surfaces_.groundAt(ray.at(distance));
    return light_.through(
        ground.albedo.cwiseProduct(light_.sun() * light_.toSun().z() + light_.ambient(1.0, 1.0)),
        distance);
  }

  // Returns the share of the sky at a place of the ground, from one direction per spot.
  double openness(const Vec3& place) const {
    const Vec3 way = randomVector(cellAt(place, OPEN_SPOT), OPEN_KEY) + Vec3(0.0, 0.0, 1.6);
    const Vec3 from = place + Vec3(0.0, 0.0, OFFSET);
    return transmittance(scene_, Ray(from, way / length(way)), camera_.range_max, DARK);
  }

  // Returns the share of sunlight that reaches a place.
  double sunAt(const Vec3& place) const {
    const Ray ray(place, light_.toSun());
    Hit solid = castToGround(scene_, ray, camera_.range_max);
    const FloatRay narrow(ray);
    scene_.people.meet(ray, narrow, solid);
    scene_.plants.meet(ray, narrow, solid);
    scene_.crowns.meet(ray, narrow, solid);
    if (solid.label != Label::NONE) return 0.0;
    LightPath path(camera_.range_max, DARK);
    scene_.trees.addDepth(ray, narrow, path);
    if (scene_.grass.isPresent()) path.add(scene_.grass.depthAbove(place, light_.toSun()));
    return path.transmittance();
  }

  Vec3 lit(const Vec3& place, const Surface& surface) const {
    const double facing = dot(surface.normal, light_.toSun());
    double direct = facing > 0.0 ? facing : -facing * surface.transmits;
    if (direct > 0.0 && camera_.shadows != Shadows::NONE) {
      const Vec3 from = place + (facing > 0.0 ? OFFSET : -OFFSET) * surface.normal;
      direct *= sunAt(from);
    }
    return surface.albedo.cwiseProduct(direct * light_.sun() +
                                       light_.ambient(surface.normal.z(), surface.sky));
  }

  const Scene& scene_;
  const Camera& camera_;
  Daylight light_;
  Surfaces surfaces_;
};

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
  /// @param picture null: no colours.
  ImageTaker(const Scene& scene, const Camera& camera, const Pose& optical, const NoiseKeys& noise,
             const Picture* picture, Images& out)
      : camera_(camera),
        optical_(optical),
        noise_(noise),
        picture_(picture),
        caster_(scene, camera.range_max, GrassGrain::BLADES),
        out_(out) {}

  /// Takes the tile whose first pixel is given.
  void take(int column, int row) {
    pixels_.clear();
    for (int y = row; y < std::min(row + TILE_ROWS, camera_.lens.height); ++y)
      for (int x = column; x < std::min(column + TILE_COLUMNS, camera_.lens.width); ++x)
        pixels_.push_back({x, y});
    sums_.assign(pixels_.size(), Vec3::Zero());
    for (int sample = 0; sample < (picture_ ? camera_.samples : 1); ++sample) takeSample(sample);
    if (!picture_) return;
    for (std::size_t p = 0; p < pixels_.size(); ++p) {
      const std::size_t i = indexOf(pixels_[p]);
      const std::optional<RayRandom> random =
          noisy_ ? std::optional<RayRandom>(RayRandom(noise_, i)) : std::nullopt;
      out_.colour[i] =
          develop(camera_.photo, sums_[p] / camera_.samples, random ? &*random : nullptr);
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
      if (picture_) sums_[p] += picture_->radiance(rays_[p], hits[p]);
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
  const Picture* picture_;
  RayCaster caster_;
  Images& out_;
  const bool noisy_{camera_.photo.read_noise > 0.0 || camera_.photo.shot_noise > 0.0};
  std::vector<Place> pixels_;
  std::vector<Ray> rays_;
  std::vector<double> cosines_;  ///< of the rays with the optical axis
  std::vector<Vec3> sums_;       ///< radiance of the samples so far
};

}  // namespace

void describe(FieldVisitor& v, Camera& c) {
  v.number("range_min", c.range_min, "m", {0.0, 100.0});
  v.number("range_max", c.range_max, "m", {0.1, 500.0});
  v.integer("samples", c.samples, "", {1, 64});
  v.choice("shadows", c.shadows, {"none", "sun"});
  describe(v, c.light);
  describe(v, c.photo);
}

void check(const Camera& camera, const std::string& context, Faults& faults) {
  if (!(camera.range_min < camera.range_max))
    faults.add(context + "range_max = " + std::to_string(camera.range_max) +
               " is not above range_min = " + std::to_string(camera.range_min));
  const std::int64_t rays = std::int64_t{camera.lens.width} * camera.lens.height * camera.samples;
  if (rays > MOST_IMAGE_RAYS)
    faults.add(context + "samples = " + std::to_string(camera.samples) + " makes " +
               std::to_string(rays) + " rays an image, allowed are " +
               std::to_string(MOST_IMAGE_RAYS));
  check(camera.lens, context, faults);
}

Images takeImages(const Scene& scene, const Camera& camera, const Pose& optical,
                  const NoiseKeys& noise, const Wanted& wanted, ThreadPool& threads) {
  const auto width = static_cast<std::size_t>(camera.lens.width);
  const auto height = static_cast<std::size_t>(camera.lens.height);
  Images out;
  out.colour.resize(wanted.colour ? width * height : 0);
  out.depth.resize(wanted.depth ? width * height : 0);
  out.label.resize(wanted.label ? width * height : 0);
  out.instance.resize(wanted.instance ? width * height : 0);
  const std::optional<Picture> picture =
      wanted.colour ? std::optional<Picture>(std::in_place, scene, camera) : std::nullopt;
  const auto stride = static_cast<int>(threads.size()) * TILE_ROWS;
  threads.run(threads.size(), [&](std::size_t first) {
    ImageTaker taker(scene, camera, optical, noise, picture ? &*picture : nullptr, out);
    for (int row = static_cast<int>(first) * TILE_ROWS; row < camera.lens.height; row += stride)
      for (int column = 0; column < camera.lens.width; column += TILE_COLUMNS)
        taker.take(column, row);
  });
  return out;
}

}  // namespace vegetation_sim::scan
