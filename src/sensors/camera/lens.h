// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>

#include "vegetation_sim/core/config/fields.h"
#include "vegetation_sim/core/math/vectors.h"

namespace vegetation_sim::scan {

/// Place in an image [pixel]. Whole numbers are the middles of pixels, (0, 0) that of the upper
/// left one, as in sensor_msgs/CameraInfo.
struct Pixel {
  double u{0.0}, v{0.0};
};

/// Coefficients of the distortion model `plumb_bob` of sensor_msgs/CameraInfo.
struct Distortion {
  double k1{0.0}, k2{0.0}, p1{0.0}, p2{0.0}, k3{0.0};
};

/// A pinhole with distortion (Brown 1966), in the optical frame of REP 103: x right, y down, z
/// forward.
struct Lens {
  int width{320}, height{240};  ///< of the image [pixel]
  double fx{1.0}, fy{1.0};      ///< focal lengths [pixel]
  double cx{159.5}, cy{119.5};  ///< principal point [pixel]
  Distortion distortion;
};

/// A lens as parameters describe it: square pixels, and the principal point in the middle.
struct LensSettings {
  int width{320}, height{240};  ///< of the image [pixel]
  double field_of_view{1.2};    ///< horizontal, from edge to edge without distortion [rad]
  Distortion distortion;
};
void describe(FieldVisitor& visitor, LensSettings& settings);
Lens lensOf(const LensSettings& settings);

constexpr int MOST_PIXELS_OF_SIDE = 4096;  ///< width or height of an image
/// Error of directionOf() [pixel], for a lens that check() accepts.
constexpr double LENS_ERROR = 1e-6;

/// Returns the image of a place in the optical frame. Requires z > 0.
Pixel project(const Lens& lens, const Vec3& place);
/// Returns the unit vector in the optical frame that project() maps to a pixel.
Vec3 directionOf(const Lens& lens, const Pixel& pixel);

/// Adds a fault for each value of a calibration that is out of range, or one if the distortion
/// cannot be inverted all over the image.
void check(const Lens& lens, const std::string& context, Faults& faults);

}  // namespace vegetation_sim::scan
