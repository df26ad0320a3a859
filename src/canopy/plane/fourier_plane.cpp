// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#include "vegetation_sim/canopy/plane/fourier_plane.h"

#include <stdexcept>
#include <string>

#include "canopy/plane/fourier_passes.h"
#include "vegetation_sim/core/math/math.h"

namespace vegetation_sim::canopy {

FourierPlane::FourierPlane(int size) : size_(size) {
  if (!isFieldSize(size))
    throw std::invalid_argument("size = " + std::to_string(size) +
                                " is no power of two from 16 to 256");
  const auto cells = static_cast<std::size_t>(size);
  for (int k = 0; k < size; ++k) {
    const SinCos turn = sinCosTurns(-static_cast<double>(k) / size);
    cosine_.push_back(turn.cos);
    sine_.push_back(turn.sin);
  }
  re_.resize(cells * cells);
  im_.resize(cells * cells);
  lanes_.resize(4 * BLOCK * cells);
}

// Transforms columns, then what were rows. The first pass writes the transpose, so that both passes
// access memory in order.
void FourierPlane::transform(std::vector<double>& re, std::vector<double>& im) {
  FourierPass pass{size_,      cosine_.data(), sine_.data(), re.data(),    im.data(),
                   re_.data(), im_.data(),     true,         lanes_.data()};
  transformColumns(pass);
  pass.re = re_.data();
  pass.im = im_.data();
  pass.out_re = re.data();
  pass.out_im = im.data();
  pass.transposed = false;
  transformColumns(pass);
}

// Exchanging real and imaginary parts before and after inverts the transform.
void FourierPlane::inverse(PlaneField& field) {
  transform(field.v, field.u);
  const double scale = 1.0 / (static_cast<double>(size_) * size_);
  for (double& value : field.u) value *= scale;
  for (double& value : field.v) value *= scale;
}

}  // namespace vegetation_sim::canopy
