// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#include "rviz/crowd/body_template.h"

#include <algorithm>
#include <cmath>

#include "vegetation_sim/core/math/math.h"
#include "vegetation_sim/core/math/random.h"

namespace vegetation_sim::view {
namespace {

using crowd::Part;
using P = crowd::Proportions;
using Kind = FormTube::Kind;

constexpr double BURIED = 0.014;  // depth below other parts from which vertices stay there
constexpr double FOLDS = 0.22;    // strength of folds in the normals of clothes
constexpr std::uint64_t FOLD_SEED = 0x464f4c44;

std::uint8_t boneOf(Bone bone, int side = 0) {
  return static_cast<std::uint8_t>(static_cast<int>(bone) + side);
}

Vec3 unit(const Vec3& v) {
  return v / std::max(1e-9, length(v));
}

// Returns axes of which the first is `main` and the second as near to `side` as possible.
BoneAxes axesAlong(const Vec3& main, const Vec3& side) {
  const Vec3 first = unit(main), second = unit(side - dot(side, first) * first);
  BoneAxes out;
  out.col(0) = first;
  out.col(1) = second;
  out.col(2) = cross(first, second);
  return out;
}

bool isCloth(Cover cover) {
  return cover == Cover::SHIRT || cover == Cover::SLEEVE || cover == Cover::TROUSERS;
}

// Rises from 0 to 1 around a place.
double step(double x, double middle, double half) {
  return smoothStep((x - middle + half) / (2.0 * half));
}

void bind(Bone first, Bone second, int side, double weight, SkinVertex& vertex) {
  vertex.bones = {first <= Bone::HEAD ? boneOf(first) : boneOf(first, side),
                  second <= Bone::HEAD ? boneOf(second) : boneOf(second, side)};
  vertex.second = weight;
}

// Hips and shoulders lie within both parts that they join, which follow both bones alike there.
void bindTrunk(SkinVertex& vertex) {
  const Vec3& at = vertex.position;
  const int side = at.y() >= 0.0 ? 0 : 1;
  const double hip = P::THIGH + P::SHANK + P::ANKLE, aside = std::fabs(at.y());
  if (at.z() > 0.86) return bind(Bone::CHEST, Bone::HEAD, 0, step(at.z(), 0.888, 0.02), vertex);
  const double arm = step(aside, P::SHOULDER_HALF, 0.045) * step(at.z(), P::SHOULDER - 0.03, 0.05);
  if (arm > 0.0) return bind(Bone::CHEST, Bone::UPPER_ARM, side, arm, vertex);
  if (at.z() < hip)
    return bind(Bone::PELVIS, Bone::THIGH, side,
                0.5 * step(hip - at.z(), 0.03, 0.03) * smoothStep(aside / 0.05), vertex);
  bind(Bone::PELVIS, Bone::CHEST, 0, step(at.z(), hip + 0.09, 0.09), vertex);
}

void bindLimb(const FormTube& tube, SkinVertex& vertex) {
  const double s = dot(vertex.position - tube.origin, tube.along);
  if (tube.kind == Kind::ARM) {
    if (s < 0.06)
      return bind(Bone::CHEST, Bone::UPPER_ARM, tube.side, step(s, 0.005, 0.05), vertex);
    return bind(Bone::UPPER_ARM, Bone::FOREARM, tube.side, step(s, P::UPPER_ARM, 0.03), vertex);
  }
  if (s < 0.09) return bind(Bone::PELVIS, Bone::THIGH, tube.side, step(s, 0.01, 0.06), vertex);
  if (s < 0.37) return bind(Bone::THIGH, Bone::SHANK, tube.side, step(s, P::THIGH, 0.045), vertex);
  bind(Bone::SHANK, Bone::FOOT, tube.side, 0.35 * step(s, 0.48, 0.03), vertex);
}

void bindTo(const FormTube& tube, SkinVertex& vertex) {
  switch (tube.kind) {
    case Kind::TRUNK:
      return bindTrunk(vertex);
    case Kind::HEAD:
      return bind(Bone::HEAD, Bone::HEAD, 0, 0.0, vertex);
    case Kind::LONG_HAIR:
      return bind(Bone::CHEST, Bone::HEAD, 0, step(vertex.position.z(), 0.84, 0.05), vertex);
    case Kind::SHOE:
      return bind(Bone::FOOT, Bone::FOOT, tube.side, 0.0, vertex);
    default:
      return bindLimb(tube, vertex);
  }
}

// The face is bare in front. Hair covers the back of the head and the temples.
Cover coverOf(const FormRing& ring, std::size_t side) {
  const auto from_front = std::abs(static_cast<int>(side) - 9);  // vertex 9 is in front, 3 behind
  const int around = std::min(from_front, 12 - from_front);
  if (ring.cover == Cover::SHOES && side >= 2 && side <= 4) return Cover::SOLES;
  if (ring.cover != Cover::FACE) return ring.cover;
  if (ring.along > 0.08) return around >= 2 ? Cover::HAIR : Cover::FACE;
  if (ring.along > 0.055) return around >= 3 ? Cover::HAIR : Cover::FACE;
  return ring.along > 0.02 && around >= 4 ? Cover::HAIR : Cover::FACE;
}

// Eyes, brows, nose and mouth by shape and shade. Vertex 9 of a ring is in front.
void shapeFace(const FormRing& ring, std::size_t side, SkinVertex& vertex) {
  if (ring.cover != Cover::FACE) return;
  const bool middle = side == 9, beside = side == 8 || side == 10;
  if (middle && ring.along > 0.03 && ring.along < 0.055)
    vertex.position.x() += ring.along < 0.045 ? 0.013 : 0.006;  // the nose
  if (beside && ring.along > 0.045 && ring.along < 0.055) {
    vertex.position.x() -= 0.004;
    vertex.shade = 0.42;  // eyes
  }
  if (beside && ring.along > 0.06 && ring.along < 0.07) vertex.shade = 0.75;  // brows
  if (middle && ring.along > 0.02 && ring.along < 0.03) vertex.shade = 0.72;  // the mouth
}

// Moves a vertex to the smooth surface, unless it lies deep in another part.
void raiseTo(const BodyForm& form, const FormTube& tube, SkinVertex& vertex) {
  const double free = 1.0 + form.distance(vertex.position, &tube) / BURIED;
  const double share = smoothStep(free);
  for (int i = 0; i < 4 && share > 0.0; ++i) {
    const double depth = form.distance(vertex.position);
    if (depth < 0.0) vertex.position -= 0.8 * share * depth * form.normal(vertex.position);
  }
}

double openness(const BodyForm& form, const SkinVertex& vertex) {
  double sum = 0.0;
  constexpr double WAYS[] = {0.02, 0.05, 0.10};
  for (const double way : WAYS)
    sum += saturate(form.distance(vertex.position + way * vertex.normal) / way) / 3.0;
  return 0.3 + 0.7 * sum;
}

void crease(std::uint64_t number, SkinVertex& vertex) {
  if (!isCloth(vertex.cover)) return;
  const Random random = Random(FOLD_SEED).child(number);
  vertex.shade = random.uniform(3, 0.9, 1.05);
  for (int i = 0; i < 3; ++i)
    vertex.normal[i] += FOLDS * random.uniform(static_cast<std::uint64_t>(i), -1.0, 1.0);
  vertex.normal = unit(vertex.normal);
}

std::vector<SkinRing> makeTemplate(bool long_hair) {
  const BodyForm form(long_hair);
  std::vector<SkinRing> out;
  for (const FormTube& tube : form.tubes()) {
    for (std::size_t r = 0; r < tube.rings.size(); ++r) {
      const FormRing& ring = tube.rings[r];
      SkinRing skin;
      skin.begins = r == 0;
      skin.fine = ring.fine;
      for (std::size_t k = 0; k < MOST_SIDES; ++k) {
        SkinVertex& vertex = skin.vertices[k];
        const SinCos turn = sinCosTurns(static_cast<double>(k) / MOST_SIDES);
        vertex.position = tube.centreOf(ring) + turn.cos * ring.broad * tube.left -
                          turn.sin * ring.deep * tube.front;
        vertex.cover = coverOf(ring, k);
        raiseTo(form, tube, vertex);
        vertex.normal = form.normal(vertex.position);
        vertex.open = openness(form, vertex);
        shapeFace(ring, k, vertex);
        crease(out.size() * MOST_SIDES + k, vertex);
        if (tube.kind == Kind::TRUNK) vertex.girth = 0.3 * saturate(ring.along / 0.25) - 0.14;
        bindTo(tube, vertex);
      }
      out.push_back(skin);
    }
  }
  return out;
}

}  // namespace

BoneFrames framesOf(const crowd::Skeleton& skeleton, const Vec3& left) {
  BoneFrames out;
  const auto set = [&](std::uint8_t bone, const Vec3& origin, const Vec3& main, const Vec3& side) {
    out[bone] = {axesAlong(main, side), origin};
  };
  const crowd::Limb& hips = limbOf(skeleton, Part::PELVIS);
  const crowd::Limb& chest = limbOf(skeleton, Part::CHEST);
  const crowd::Limb& shoulders = limbOf(skeleton, Part::SHOULDERS);
  const crowd::Limb& head = limbOf(skeleton, Part::HEAD);
  const Vec3 across = unit(hips.from - hips.to), wide = unit(shoulders.from - shoulders.to);
  const Vec3 spine = chest.to - chest.from;
  set(boneOf(Bone::PELVIS), 0.5 * (hips.from + hips.to), unit(spine) + Vec3::UnitZ(), across);
  set(boneOf(Bone::CHEST), 0.5 * (shoulders.from + shoulders.to), spine, wide);
  set(boneOf(Bone::HEAD), head.from, head.to - head.from, unit(wide + left));
  const std::pair<Bone, Part> limbs[] = {{Bone::THIGH, Part::THIGH},
                                         {Bone::SHANK, Part::SHANK},
                                         {Bone::FOOT, Part::FOOT},
                                         {Bone::UPPER_ARM, Part::UPPER_ARM},
                                         {Bone::FOREARM, Part::FOREARM}};
  for (const auto& [bone, part] : limbs) {
    for (int side = 0; side < 2; ++side) {
      const crowd::Limb& limb = limbOf(skeleton, part, side);
      set(boneOf(bone, side), limb.from, limb.to - limb.from, left);
    }
  }
  return out;
}

const std::vector<SkinRing>& bodyTemplate(bool long_hair) {
  static const std::vector<SkinRing> SHORT = makeTemplate(false), LONG = makeTemplate(true);
  return long_hair ? LONG : SHORT;
}

}  // namespace vegetation_sim::view
