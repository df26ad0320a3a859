// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#include "rviz/crowd/body_hair.h"

#include <algorithm>
#include <cmath>
#include <iterator>

#include "vegetation_sim/core/math/math.h"
#include "vegetation_sim/core/math/random.h"

namespace vegetation_sim::view {
namespace {

using crowd::HairCut;

/// A ring at a share of the way from the hairline to the crown.
struct HairRing {
  double share, below_crown;  ///< it is not lower than this below the crown
  bool fine;
  double shade;
};
// The first ring lies below the surface of the head, so that hair has an edge.
const HairRing HAIR_RINGS[] = {{0.0, 1.0, true, 0.6},     {0.06, 1.0, false, 0.8},
                               {0.3, 1.0, true, 1.0},     {0.55, 1.0, true, 1.05},
                               {0.78, 0.021, false, 1.0}, {0.93, 0.006, true, 0.95},
                               {1.0, 0.0, false, 0.95}};
constexpr double BELOW_SKIN = 0.007, TIP = 0.0005;
constexpr std::uint64_t STRANDS = 0x48414952;

// The outer surface of full hair, from the shoulders up.
const FormRings PROFILE = {{-0.090, 0.047, 0.020, -0.048},  {-0.060, 0.052, 0.030, -0.038},
                           {-0.030, 0.051, 0.040, -0.026},  {0.000, 0.0485, 0.050, -0.015},
                           {0.030, 0.0470, 0.058, -0.009},  {0.062, 0.0470, 0.0615, -0.007},
                           {0.085, 0.0475, 0.0620, -0.006}, {0.105, 0.0445, 0.0580, -0.0065},
                           {0.120, 0.0355, 0.0460, -0.007}, {0.129, 0.0235, 0.0300, -0.007},
                           {0.134, 0.0030, 0.0040, -0.006}};

struct Cut {
  double edges[HairForm::COLUMNS];
  double crown, swell;  ///< height of the crown; by how much hair is wider than the profile
  double rough, sweep;  ///< unevenness; by how much the left hairline is lower, and the hair fuller
};

const Cut& shapeOf(HairCut cut) {
  static const Cut SHORT{
      {0.104, 0.101, 0.090, 0.054, 0.056, 0.014, 0.006}, 0.134, 0.0005, 0.0022, 0.005};
  static const Cut CROP{
      {0.105, 0.103, 0.095, 0.060, 0.062, 0.022, 0.016}, 0.1325, -0.0025, 0.0006, 0.0};
  static const Cut BALD{
      {0.086, 0.086, 0.088, 0.052, 0.056, 0.014, 0.008}, 0.094, -0.0025, 0.0006, 0.0};
  static const Cut LONG{
      {0.110, 0.103, 0.086, -0.030, -0.065, -0.080, -0.085}, 0.134, 0.001, 0.0016, 0.004};
  static const Cut BOB{
      {0.092, 0.090, 0.080, 0.010, 0.004, 0.000, 0.000}, 0.135, 0.003, 0.0014, 0.003};
  static const Cut TAIL{
      {0.109, 0.107, 0.098, 0.066, 0.058, 0.030, 0.022}, 0.132, -0.002, 0.0008, 0.003};
  static const Cut CAP{{0.094, 0.094, 0.092, 0.088, 0.085, 0.082, 0.080}, 0.134, 0.002, 0.0, 0.0};
  switch (cut) {
    case HairCut::CROP:
      return CROP;
    case HairCut::BALD:
      return BALD;
    case HairCut::LONG:
      return LONG;
    case HairCut::BOB:
      return BOB;
    case HairCut::TAIL:
      return TAIL;
    case HairCut::CAP:
      return CAP;
    default:
      return SHORT;
  }
}

FormRing profileAt(double along) {
  std::size_t next = 1;
  while (next + 1 < PROFILE.size() && PROFILE[next].along < along) ++next;
  const FormRing &a = PROFILE[next - 1], &b = PROFILE[next];
  const double part = saturate((along - a.along) / (b.along - a.along));
  const auto mixed = [&](double FormRing::*value) {
    return (1.0 - part) * a.*value + part * b.*value;
  };
  return {along, mixed(&FormRing::broad), mixed(&FormRing::deep), mixed(&FormRing::forward)};
}

}  // namespace

HairForm::HairForm(HairCut cut) : cut_(cut) {}

std::size_t HairForm::rings() const {
  return std::size(HAIR_RINGS);
}

double HairForm::edgeAt(const Around& around) const {
  if (isBald()) return 1.0;  // above the head
  const auto& edges = shapeOf(cut_ == HairCut::CAP ? HairCut::SHORT : cut_).edges;
  const double angle = std::fabs(arcTangent(around.left, around.front)) * 180.0 / PI;
  std::size_t next = 1;
  while (next + 1 < COLUMNS && COLUMN_ANGLES[next] < angle) ++next;
  const double from = COLUMN_ANGLES[next - 1], to = COLUMN_ANGLES[next];
  return edges[next - 1] + saturate((angle - from) / (to - from)) * (edges[next] - edges[next - 1]);
}

FormRing HairForm::at(std::size_t ring, std::size_t vertex) const {
  const Cut& shape = shapeOf(cut_);
  const HairRing& own = HAIR_RINGS[ring];
  const std::size_t column = columnOf(vertex);
  const bool left = vertex < 3 || vertex > 9, tip = ring + 1 == rings();
  const double sweep = column > 0 && column < 4 ? (left ? -shape.sweep : shape.sweep) : 0.0;
  const double low = shape.edges[column] + sweep;
  FormRing out =
      profileAt(std::max(low + own.share * (shape.crown - low), shape.crown - own.below_crown));
  const double uneven = Random(STRANDS).child(ring).uniform(vertex, -1.0, 1.0);
  double swell = shape.swell + (ring == 0 ? -BELOW_SKIN : shape.rough * uneven - 0.5 * sweep);
  if (isBald() && (column < 3 || tip)) swell -= 0.004;  // below the skin
  out.broad = tip && !isBald() ? TIP : out.broad + swell;
  out.deep = tip && !isBald() ? TIP : out.deep + swell;
  out.cover = cut_ == HairCut::CAP ? Cover::HAT : Cover::HAIR;
  out.fine = own.fine;
  out.shade = own.shade;
  // The peak of a cap.
  constexpr double PEAK[] = {0.048, 0.040, 0.012};
  if (cut_ == HairCut::CAP && ring == 1 && column < std::size(PEAK)) {
    out.forward += PEAK[column];
    out.along -= 0.2 * PEAK[column];
  }
  return out;
}

const FormRings& HairForm::tailRings(HairCut cut) {
  static const FormRings TAIL = {{-0.055, 0.006, 0.006, -0.060, Cover::HAIR, true, 0.9},
                                 {-0.020, 0.017, 0.015, -0.066, Cover::HAIR, true},
                                 {0.050, 0.018, 0.016, -0.076, Cover::HAIR, true},
                                 {0.078, 0.008, 0.008, -0.064, Cover::HAIR, true, 0.7}};
  static const FormRings NONE;
  return cut == HairCut::TAIL ? TAIL : NONE;
}

}  // namespace vegetation_sim::view
