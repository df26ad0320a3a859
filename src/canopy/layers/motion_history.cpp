// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#include "vegetation_sim/canopy/layers/motion_history.h"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <string>

#include "core/archive/archive.h"
#include "vegetation_sim/core/config/faults.h"

namespace vegetation_sim::canopy {
namespace {

// The exponents of half and single precision are 112 apart. Products with this power of two are
// exact, small halfs that have no leading one included.
constexpr float SHIFT = 5.192296858534828e+33F;  // 2^112
constexpr double LARGEST_HALF = 65504.0;

std::uint32_t bitsOf(float value) {
  std::uint32_t out;
  std::memcpy(&out, &value, sizeof out);
  return out;
}

float fromBits(std::uint32_t bits) {
  float out;
  std::memcpy(&out, &bits, sizeof out);
  return out;
}

void add(Hash& hash, const std::vector<std::uint16_t>& halfs) {
  for (std::size_t i = 0; i + 4 <= halfs.size(); i += 4)  // four a word
    hash.add(halfs[i] | (static_cast<std::uint64_t>(halfs[i + 1]) << 16) |
             (static_cast<std::uint64_t>(halfs[i + 2]) << 32) |
             (static_cast<std::uint64_t>(halfs[i + 3]) << 48));
}

}  // namespace

std::uint16_t toHalf(double value) {
  const double bounded = std::min(LARGEST_HALF, std::fabs(value));  // NaN: the largest
  const std::uint32_t bits = bitsOf(static_cast<float>(bounded) / SHIFT);
  const std::uint32_t rounded = (bits + 0xfffU + ((bits >> 13) & 1U)) >> 13;
  return static_cast<std::uint16_t>(rounded | (std::signbit(value) ? 0x8000U : 0U));
}

double fromHalf(std::uint16_t half) {
  const float size = fromBits((half & 0x7fffU) << 13) * SHIFT;
  return half & 0x8000U ? -size : size;
}

MotionFrame toFrame(const PlaneField& motion, double depth) {
  MotionFrame out;
  for (const double value : motion.u) out.u.push_back(toHalf(value));
  for (const double value : motion.v) out.v.push_back(toHalf(value));
  out.depth = toHalf(depth);
  return out;
}

History::History(int size, int frames) : size_(size) {
  if (!isFieldSize(size) || frames < 2)
    throw InvalidInput("history: " + std::to_string(frames) + " frames of " + std::to_string(size) +
                       " cells; allowed are 2 frames or more of a field size");
  ring_.resize(static_cast<std::size_t>(frames));
  clear();
}

void History::clear() {
  const MotionFrame rest = toFrame(PlaneField(size_), 0.0);
  std::fill(ring_.begin(), ring_.end(), rest);
  newest_ = 0;
  chain_ = 0;
}

std::size_t History::bytes() const {
  return ring_.size() * sizeof(std::uint16_t) * (2 * ring_[0].u.size() + 1);
}

void History::push(const MotionFrame& frame) {
  if (frame.u.size() != ring_[0].u.size() || frame.v.size() != ring_[0].v.size())
    throw InvalidInput("motion: " + std::to_string(frame.u.size()) + " and " +
                       std::to_string(frame.v.size()) + " cells, allowed are " +
                       std::to_string(ring_[0].u.size()));
  newest_ = (newest_ + 1) % ring_.size();
  ring_[newest_] = frame;
  Hash hash;
  hash.add(chain_);
  add(hash, frame.u);
  add(hash, frame.v);
  hash.add(static_cast<std::uint64_t>(frame.depth));
  chain_ = hash.value();
}

const MotionFrame& History::frame(int age) const {
  const auto back = static_cast<std::size_t>(std::min(std::max(age, 0), frames() - 1));
  return ring_[back <= newest_ ? newest_ - back : newest_ + ring_.size() - back];
}

PlaneMotion History::at(std::size_t cell, double age) const {
  const double bounded = std::min(frames() - 1.0, std::max(0.0, age));
  const int whole = static_cast<int>(bounded);
  const MotionFrame &late = frame(whole), &early = frame(whole + 1);
  const double q = bounded - whole, p = 1.0 - q;
  return {p * fromHalf(late.u[cell]) + q * fromHalf(early.u[cell]),
          p * fromHalf(late.v[cell]) + q * fromHalf(early.v[cell]),
          p * fromHalf(late.depth) + q * fromHalf(early.depth)};
}

PlaneMotion History::newestAt(double x, double y) const {
  const MotionFrame& now = frame(0);
  const double left = std::floor(x), low = std::floor(y), p = x - left, q = y - low;
  const int mask = size_ - 1, x0 = static_cast<int>(left) & mask, y0 = static_cast<int>(low) & mask;
  const int x1 = (x0 + 1) & mask, y1 = (y0 + 1) & mask;
  const auto mix = [&](const std::vector<std::uint16_t>& of) {
    const auto at = [&](int column, int row) {
      return fromHalf(of[static_cast<std::size_t>(row * size_ + column)]);
    };
    return (1.0 - q) * ((1.0 - p) * at(x0, y0) + p * at(x1, y0)) +
           q * ((1.0 - p) * at(x0, y1) + p * at(x1, y1));
  };
  return {mix(now.u), mix(now.v), fromHalf(now.depth)};
}

void History::archive(Archive& a) {
  const auto half = [&a](std::uint16_t& value) {
    a.integer("motion", value);
    if (!std::isfinite(fromHalf(value)))
      Archive::reject("motion = " + std::to_string(value), "is not finite");
  };
  for (MotionFrame& frame : ring_) {
    std::for_each(frame.u.begin(), frame.u.end(), half);
    std::for_each(frame.v.begin(), frame.v.end(), half);
    half(frame.depth);
  }
  std::uint64_t newest = newest_;
  a.integer<std::uint64_t>("newest frame", newest, 0, ring_.size() - 1);
  newest_ = static_cast<std::size_t>(newest);
  a.key(chain_);
}

}  // namespace vegetation_sim::canopy
