// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#include "rviz/crowd/body_details.h"

#include <algorithm>
#include <cmath>
#include <cstdlib>

#include "rviz/crowd/body_hair.h"
#include "vegetation_sim/core/math/math.h"
#include "vegetation_sim/core/math/random.h"

namespace vegetation_sim::view {
namespace {

using P = crowd::Proportions;
using Kind = FormTube::Kind;

constexpr double HIP_HEIGHT = P::THIGH + P::SHANK + P::ANKLE;
constexpr double HEM_SHARE = 0.4;        // of the thighs in the movement of shirts
constexpr double BETWEEN_FINGERS = 0.7;  // factor of the colour
constexpr double BETWEEN_THIGHS = 0.05;  // half width of what hangs between them
constexpr double FOLDS = 0.17;           // strength of folds in the normals of clothes
constexpr std::uint64_t FOLD_SEED = 0x464f4c44;

// A change of a vertex of the head: outwards, and its shade and cover.
struct Feature {
  double along;
  std::size_t column;
  double out, shade;
  Cover cover{Cover::SKIN};
};
const Feature FEATURES[] = {{0.0100, 0, 0.0022, 1.03},  // chin
                            {0.0100, 1, 0.0015, 1.0},
                            {0.0185, 0, -0.0010, 0.90},  // below the lips
                            {0.0185, 1, -0.0006, 0.93},
                            {0.0240, 0, 0.0022, 1.05, Cover::LIPS},
                            {0.0240, 1, 0.0010, 1.0},
                            {0.0270, 0, 0.0012, 1.0, Cover::LIP_LINE},
                            {0.0270, 1, 0.0004, 1.0, Cover::LIP_LINE},
                            {0.0270, 2, -0.0006, 0.92},
                            {0.0302, 0, 0.0026, 1.0, Cover::MOUSTACHE},
                            {0.0302, 1, 0.0014, 1.0, Cover::MOUSTACHE},
                            {0.0385, 0, 0.0050, 0.80},  // below the nose
                            {0.0385, 1, 0.0010, 0.86},
                            {0.0465, 0, 0.0110, 1.02},  // nose
                            {0.0465, 1, 0.0036, 0.96},
                            {0.0545, 0, 0.0085, 1.04},
                            {0.0545, 1, 0.0000, 0.97},
                            {0.0545, 2, 0.0004, 1.02},  // cheek
                            {0.0625, 0, 0.0052, 1.02},
                            {0.0625, 1, -0.0034, 0.84},  // sockets of the eyes
                            {0.0625, 2, -0.0024, 0.88},
                            {0.0725, 0, 0.0022, 0.98},
                            {0.0725, 1, -0.0010, 0.93},
                            {0.0725, 2, -0.0004, 0.95},
                            {0.0765, 0, 0.0012, 1.0},
                            {0.0765, 1, 0.0018, 1.0, Cover::BROW},
                            {0.0765, 2, 0.0014, 1.0, Cover::BROW}};

bool isAt(double a, double b) {
  return std::fabs(a - b) < 1e-6;
}

// Lashes are above the eye only, which is shaded by its upper lid.
void shapeEye(const FormRing& ring, std::size_t vertex, SkinVertex& out) {
  const bool above = vertex >= 7;
  if (ring.cover == Cover::LASHES && !above && vertex % 6 != 0) {
    out.cover = Cover::SKIN;
    out.shade *= 0.72;
  }
  if (ring.cover == Cover::EYE && above) out.shade *= 0.8;
}

bool isBearded(double along, std::size_t column) {
  if (along < 0.020) return column <= 3 && along > -0.004;
  if (along < 0.035) return column == 2 || column == 3;
  return column == 3 && along < 0.056;
}

Cover trunkCover(const FormRing& ring, std::size_t column) {
  const bool middle = column == 0, front = column <= 1;
  switch (ring.cover) {
    case Cover::SHIRT:
      return middle ? Cover::FRONT : front ? Cover::LAPEL : ring.cover;
    case Cover::STRIPE:
      return middle ? Cover::STRIPE_FRONT : front ? Cover::STRIPE_LAPEL : ring.cover;
    case Cover::YOKE:
      if (ring.along > 0.29 ? front : middle && ring.along > 0.27) return Cover::THROAT;
      return middle ? Cover::YOKE_FRONT : front ? Cover::YOKE_LAPEL : ring.cover;
    case Cover::COLLAR:
      return middle || (front && ring.along < 0.315) ? Cover::NOTCH : Cover::COLLAR;
    case Cover::HEM:
      return middle ? Cover::HEM_FRONT : Cover::HEM;
    default:
      return ring.cover;
  }
}

// Rises from 0 to 1 around a place.
double step(double x, double middle, double half) {
  return smoothStep((x - middle + half) / (2.0 * half));
}

double bump(double x, double middle, double half) {
  const double u = (x - middle) / half;
  return std::exp(-u * u);
}

void bind(Bone first, Bone second, int side, double weight, SkinVertex& vertex) {
  vertex.bones = {first <= Bone::HEAD ? boneOf(first) : boneOf(first, side),
                  second <= Bone::HEAD ? boneOf(second) : boneOf(second, side)};
  vertex.second = weight;
}

// Share of the thigh in the movement, the same for trunk, legs and skirts. The middle is still.
double thighShare(const Vec3& at) {
  const double below = HIP_HEIGHT - at.z(), aside = std::fabs(at.y());
  return step(below, 0.01, 0.06) * smoothStep((aside + std::max(0.0, below - 0.05)) / 0.045);
}

// Share of the upper arm, the same for trunk and arms.
double armShare(const Vec3& at) {
  return step(std::fabs(at.y()), 0.105, 0.04) * step(P::SHOULDER - at.z(), 0.012, 0.045);
}

// Hips and shoulders lie within both parts that they join, which follow both bones alike there.
void bindTrunk(SkinVertex& vertex) {
  const Vec3& at = vertex.position;
  const int side = at.y() >= 0.0 ? 0 : 1;
  if (at.z() > 0.86) return bind(Bone::CHEST, Bone::HEAD, 0, step(at.z(), 0.888, 0.02), vertex);
  const double arm = armShare(at) * step(at.z(), 0.77, 0.03);
  if (arm > 0.0) return bind(Bone::CHEST, Bone::UPPER_ARM, side, arm, vertex);
  if (at.z() < HIP_HEIGHT + 0.05)
    return bind(Bone::PELVIS, Bone::THIGH, side, HEM_SHARE * thighShare(at), vertex);
  bind(Bone::PELVIS, Bone::CHEST, 0, step(at.z(), HIP_HEIGHT + 0.12, 0.07), vertex);
}

// Below the hips, the middle of a skirt hangs between both thighs.
void bindSkirt(SkinVertex& vertex) {
  const double y = vertex.position.y(), below = HIP_HEIGHT - vertex.position.z();
  const int side = y >= 0.0 ? 0 : 1;
  if (below < 0.05)
    return bind(Bone::PELVIS, Bone::THIGH, side, thighShare(vertex.position), vertex);
  vertex.bones = {boneOf(Bone::THIGH, side), boneOf(Bone::THIGH, 1 - side)};
  vertex.second = 0.5 * (1.0 - smoothStep(std::fabs(y) / BETWEEN_THIGHS));
}

void bindLimb(const FormTube& tube, SkinVertex& vertex) {
  const double s = dot(vertex.position - tube.origin, tube.along);
  if (tube.kind == Kind::ARM) {
    if (s < 0.09)
      return bind(Bone::CHEST, Bone::UPPER_ARM, tube.side,
                  std::max(armShare(vertex.position), step(s, 0.06, 0.03)), vertex);
    return bind(Bone::UPPER_ARM, Bone::FOREARM, tube.side, step(s, P::UPPER_ARM, 0.03), vertex);
  }
  if (s < 0.12)
    return bind(Bone::PELVIS, Bone::THIGH, tube.side, thighShare(vertex.position), vertex);
  if (s < 0.37) return bind(Bone::THIGH, Bone::SHANK, tube.side, step(s, P::THIGH, 0.045), vertex);
  bind(Bone::SHANK, Bone::FOOT, tube.side, 0.35 * step(s, 0.48, 0.03), vertex);
}

}  // namespace

std::size_t columnOf(std::size_t vertex) {
  const auto from_front = static_cast<std::size_t>(std::abs(static_cast<int>(vertex) - 9));
  return std::min(from_front, MOST_SIDES - from_front);
}

Around aroundOf(Kind kind, std::size_t vertex) {
  if (kind == Kind::ARM || kind == Kind::LEG || kind == Kind::SHOE || kind >= Kind::EYE) {
    const SinCos turn = sinCosTurns(static_cast<double>(vertex) / MOST_SIDES);
    return {turn.cos, -turn.sin};
  }
  // Noses and mouths reach to column 1, eyes to column 2.
  constexpr double HEAD[HairForm::COLUMNS] = {0.0, 12.5, 33.0, 53.0, 87.0, 118.0, 180.0};
  constexpr double TRUNK[HairForm::COLUMNS] = {0.0, 18.0, 50.0, 87.0, 119.0, 150.0, 180.0};
  const auto& angles = kind == Kind::HEAD   ? HEAD
                       : kind == Kind::HAIR ? HairForm::COLUMN_ANGLES
                                            : TRUNK;
  const double angle = angles[columnOf(vertex)];
  const SinCos turn = sinCosTurns(angle / 360.0);
  const double left = vertex > 3 && vertex < 9 ? -turn.sin : turn.sin;
  // Trunks and what hangs around them are rather square.
  const double corner = kind == Kind::TRUNK || kind == Kind::SKIRT
                            ? 1.0 + 0.3 * turn.sin * turn.sin * turn.cos * turn.cos
                            : 1.0;
  return {corner * left, corner * turn.cos};
}

Cover coverOf(Kind kind, const FormRing& ring, std::size_t vertex, double hairline) {
  const std::size_t column = columnOf(vertex);
  if (kind == Kind::SHOE && vertex >= 1 && vertex <= 5) return Cover::SOLES;
  if (kind == Kind::TRUNK) return trunkCover(ring, column);
  if (kind != Kind::HEAD) return ring.cover;
  // Temples are bare up to the brows, next to which they are in small bodies.
  const bool bare = column <= 3 && ring.along < 0.08 && hairline > 0.05;
  if (ring.along > hairline + 0.012 && !bare) return Cover::HAIR;
  return isBearded(ring.along, column) ? Cover::BEARD : ring.cover;
}

void shapeDetails(Kind kind, const FormRing& ring, std::size_t vertex, const Vec3& outward,
                  SkinVertex& out) {
  if (kind == Kind::ARM && vertex == 9) {  // the thumb
    if (isAt(ring.along, 0.335)) out.position += 0.004 * outward;
    if (isAt(ring.along, 0.357)) out.position += 0.003 * outward;
  }
  if (kind == Kind::EYE) shapeEye(ring, vertex, out);
  if (kind == Kind::FINGER && vertex % 6 == 0) out.shade *= BETWEEN_FINGERS;
  if (kind != Kind::HEAD) return;
  for (const Feature& feature : FEATURES) {
    if (columnOf(vertex) != feature.column || !isAt(ring.along, feature.along)) continue;
    out.position += feature.out * outward;
    out.shade *= feature.shade;
    if (feature.cover != Cover::SKIN) out.cover = feature.cover;
  }
}

void crease(std::uint64_t number, SkinVertex& vertex) {
  const Random random = Random(FOLD_SEED).child(number);
  if (vertex.cover == Cover::HAIR)
    vertex.shade *= Random(FOLD_SEED + 1).uniform(number % MOST_SIDES, 0.72, 1.15) *
                    random.uniform(3, 0.92, 1.08);
  if (!isCloth(vertex.cover)) return;
  vertex.shade *= random.uniform(3, 0.88, 1.05);
  for (int i = 0; i < 3; ++i)
    vertex.normal[i] += FOLDS * random.uniform(static_cast<std::uint64_t>(i), -1.0, 1.0);
  vertex.normal /= std::max(1e-9, length(vertex.normal));
}

void setBuilds(const FormTube& tube, const FormRing& ring, SkinVertex& vertex) {
  const Vec3 &at = vertex.position, &normal = vertex.normal;
  const Vec3 across(0.0, at.y(), 0.0), side(0.0, at.y() > 0.0 ? 1.0 : -1.0, 0.0);
  switch (tube.kind) {
    case Kind::TRUNK:
    case Kind::SKIRT: {
      const double top = step(at.z(), 0.76, 0.08), waist = bump(at.z(), 0.64, 0.06);
      const double low = 1.0 - step(at.z(), 0.58, 0.05), neck = step(at.z(), 0.83, 0.02);
      const double belly = bump(at.z(), 0.60, 0.11) * (0.6 + 0.5 * std::max(-0.4, normal.x()));
      vertex.full = (1.0 - neck) * (0.010 + 0.026 * belly) * normal + 0.004 * neck * normal;
      vertex.hips = (0.05 * low - 0.06 * waist - 0.06 * top * (1.0 - neck)) * across;
      vertex.hips.x() += 0.017 * bump(at.z(), 0.738, 0.028) * bump(std::fabs(at.y()), 0.043, 0.03) *
                         smoothStep(2.0 * normal.x());
      vertex.shoulders = (0.05 * top * (1.0 - neck) + 0.06 * waist - 0.02 * low) * across;
      break;
    }
    case Kind::HEAD:
      vertex.full = 0.006 * (1.0 - step(ring.along, 0.04, 0.02)) * normal;
      vertex.hips = -0.05 * (1.0 - step(ring.along, 0.02, 0.02)) * across;
      vertex.shoulders = 0.05 * (1.0 - step(ring.along, 0.03, 0.02)) * across;
      break;
    case Kind::ARM:
      vertex.full = (ring.along < 0.3 ? 0.006 : 0.001) * normal;
      vertex.hips =
          (ring.along < 0.33 ? -0.0030 : -0.0015) * normal - 0.065 * P::SHOULDER_HALF * side;
      vertex.shoulders =
          (ring.along < 0.3 ? 0.002 : 0.0) * normal + 0.045 * P::SHOULDER_HALF * side;
      break;
    case Kind::LEG:
      vertex.full = 0.009 * (1.0 - 0.7 * saturate(ring.along / 0.4)) * normal;
      break;
    default:
      break;
  }
}

void bindTo(const FormTube& tube, SkinVertex& vertex) {
  switch (tube.kind) {
    case Kind::TRUNK:
      return bindTrunk(vertex);
    case Kind::SKIRT:
      return bindSkirt(vertex);
    case Kind::HAIR:
      return bind(Bone::CHEST, Bone::HEAD, 0, step(vertex.position.z(), 0.815, 0.045), vertex);
    case Kind::HEAD:
    case Kind::EYE:
    case Kind::IRIS:
    case Kind::EAR:
    case Kind::TAIL:
      return bind(Bone::HEAD, Bone::HEAD, 0, 0.0, vertex);
    case Kind::FINGER:
    case Kind::THUMB:
      return bind(Bone::FOREARM, Bone::FOREARM, tube.side, 0.0, vertex);
    case Kind::SHOE:
      return bind(Bone::FOOT, Bone::FOOT, tube.side, 0.0, vertex);
    default:
      return bindLimb(tube, vertex);
  }
}

}  // namespace vegetation_sim::view
