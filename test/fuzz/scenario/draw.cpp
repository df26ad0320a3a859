// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#include "fuzz/scenario/draw.h"

#include <algorithm>
#include <cmath>

namespace vegetation_sim::fuzz {

double Draw::logarithmic(double low, double high) {
  return low * std::pow(high / low, between(0.0, 1.0));
}

void RandomFields::number(const char*, double& value, const char*, Range range) {
  if (!draw_.chance(share_)) return;
  value = std::clamp(value * draw_.logarithmic(1.0 / factor_, factor_), range.low, range.high);
}

void RandomFields::integer(const char*, int& value, const char*, Range range) {
  if (!draw_.chance(share_)) return;
  const double wanted = (value + draw_.below(3) - 1) * draw_.logarithmic(1.0 / factor_, factor_);
  value = static_cast<int>(std::clamp(wanted, range.low, range.high));
}

void RandomFields::vector(const char*, Vec3& value, const char*, Range range) {
  if (!draw_.chance(share_)) return;
  for (int i = 0; i < 3; ++i)
    value[i] = std::clamp(value[i] * draw_.between(-1.0, 1.0) * factor_, range.low, range.high);
}

void RandomFields::choice(const char*, int& value, const std::vector<std::string>& names) {
  if (!draw_.chance(share_)) return;
  const int wanted = draw_.below(static_cast<int>(names.size()));
  const std::string& name = names[static_cast<std::size_t>(wanted)];
  if (name.find("paper") == std::string::npos && name.find("printed") == std::string::npos)
    value = wanted;
}

wind::Field randomWind(Draw& draw, Nanoseconds start) {
  std::vector<wind::Primitive> out;
  const int count = draw.below(4);
  for (int i = 0; i < count; ++i) {
    wind::Primitive primitive;
    primitive.id = static_cast<std::uint32_t>(i + 1);
    primitive.name = "source_" + std::to_string(i);
    primitive.kind = static_cast<wind::Kind>(draw.below(5));
    RandomFields fields(draw, 4.0);
    describe(fields, primitive);
    primitive.epoch = primitive.t_on = start + fromSeconds(draw.between(-3.0, 1.0));
    if (draw.chance(0.3)) primitive.t_off = start + fromSeconds(draw.between(1.5, 3.0));
    primitive.trajectory = {{start, draw.point(8.0)},
                            {start + NANOSECONDS_PER_SECOND, draw.point(8.0)}};
    Faults faults;
    check(primitive, faults);
    if (faults.empty()) out.push_back(primitive);
  }
  return wind::Field(out, draw.key());
}

}  // namespace vegetation_sim::fuzz
