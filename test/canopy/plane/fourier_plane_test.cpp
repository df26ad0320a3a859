// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#include "vegetation_sim/canopy/plane/fourier_plane.h"

#include <gtest/gtest.h>

#include <complex>
#include <stdexcept>

#include "scenes/canopy/plane_scene.h"
#include "vegetation_sim/core/config/instruction_set.h"
#include "vegetation_sim/core/math/hash.h"
#include "vegetation_sim/core/math/math.h"

namespace vegetation_sim::canopy {
namespace {

/// The sum that defines the transform, term by term.
std::complex<double> slowMode(const PlaneField& field, int kx, int ky) {
  std::complex<double> sum;
  for (int y = 0; y < field.size; ++y)
    for (int x = 0; x < field.size; ++x) {
      const SinCos turn = sinCosTurns(-static_cast<double>(kx * x + ky * y) / field.size);
      const auto i = static_cast<std::size_t>(y * field.size + x);
      sum +=
          std::complex<double>(field.u[i], field.v[i]) * std::complex<double>(turn.cos, turn.sin);
    }
  return sum;
}

TEST(FourierPlane, IsTheSumThatDefinesIt) {
  for (const int size : {16, 32, 64}) {  // powers of four, and not
    const PlaneField field = noiseField(size, 1);
    PlaneField spectrum = field;
    FourierPlane(size).forward(spectrum);
    for (const auto& [kx, ky] : {std::pair<int, int>(0, 0), {1, 0}, {0, 1}, {3, 13}, {15, 9}}) {
      const auto want = slowMode(field, kx, ky);
      const auto i = static_cast<std::size_t>(kx * size + ky);
      // The sum of size^2 numbers of order 1, rounded.
      EXPECT_NEAR(spectrum.u[i], want.real(), 1e-11) << size << ": " << kx << ", " << ky;
      EXPECT_NEAR(spectrum.v[i], want.imag(), 1e-11) << size << ": " << kx << ", " << ky;
    }
  }
}

TEST(FourierPlane, InverseUndoesForward) {
  for (int size = SMALLEST_FIELD; size <= LARGEST_FIELD; size *= 2) {
    const PlaneField field = noiseField(size, 2);
    PlaneField back = field;
    FourierPlane plane(size);
    plane.forward(back);
    plane.inverse(back);
    EXPECT_LT(relativeError(back, field), 1e-14) << size;
  }
}

// S3-11: the field is state, so it may not depend on the processor.
TEST(FourierPlane, HasTheSameBitsOnEveryInstructionSet) {
  std::vector<std::uint64_t> hashes;
  for (const std::string& name : instructionSets()) {
    forceInstructionSet(name);
    PlaneField field = noiseField(128, 3);
    FourierPlane(128).forward(field);
    hashes.push_back(hashOf(field));
  }
  forceInstructionSet("");
  for (const std::uint64_t hash : hashes) EXPECT_EQ(hash, hashes.front());
}

TEST(FourierPlane, RejectsSizesThatAreNoPowerOfTwo) {
  for (const int size : {0, -64, 8, 48, 63, 512})
    EXPECT_THROW(FourierPlane{size}, std::invalid_argument) << size;
}

}  // namespace
}  // namespace vegetation_sim::canopy
