// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#include "rviz/crowd/body_template.h"

#include <algorithm>
#include <cmath>

#include "rviz/crowd/body_details.h"
#include "rviz/crowd/body_hair.h"
#include "vegetation_sim/core/math/math.h"

namespace vegetation_sim::view {
namespace {

using Kind = FormTube::Kind;

constexpr double BURIED = 0.014;  // depth below other parts from which vertices stay there
constexpr double HEM = 0.006;     // thickness of clothes at their hems
constexpr double HEM_FROM = -0.018, HEM_TO = -0.01;
constexpr double WRIST = 0.32;        // of rings of arms
constexpr double HAND_TURN = 0.1;     // by how much thumbs are turned to the body, in turns
constexpr double UNDER_SKIRT = 0.15;  // of rings of trunk and legs
constexpr double SCALP = 0.115;       // height of the head's rings that hair hides
constexpr double NO_HAIR = 1.0;       // a hairline above the head

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
  // What lies within other parts is seen only by the colour that it gives to its neighbours.
  const bool within = form.distance(vertex.position) < -0.003;
  return std::max(within ? 0.75 : 0.0, 0.3 + 0.7 * sum);
}

// The hips of the trunk and the tops of legs lie within each other, below the clothes.
bool isHidden(const FormTube& tube, const FormRing& ring) {
  return tube.isLoose() || (tube.kind == Kind::TRUNK && ring.along < HEM_FROM) ||
         (tube.kind == Kind::HEAD && ring.along < 0.01) ||
         (tube.kind == Kind::LEG && ring.along < 0.03) ||
         (tube.kind == Kind::ARM && (ring.along < 0.005 || ring.along > WRIST));
}

// Shoes are flat below.
void flatten(const FormRing& ring, std::size_t side, const FormTube& tube, SkinVertex& vertex) {
  if (tube.kind != Kind::SHOE || side < 1 || side > 5) return;
  const double broad = side == 3 ? 0.0 : side == 2 || side == 4 ? 0.7 : 0.98;
  const double up = side == 1 || side == 5 ? 0.008 : 0.0;
  vertex.position = tube.centreOf(ring) + (up - ring.deep) * tube.front +
                    (side < 3 ? 1.0 : -1.0) * broad * ring.broad * tube.left;
}

bool isLower(Cover cover) {
  return cover == Cover::TROUSERS || cover == Cover::HEM || cover == Cover::HEM_FRONT;
}

/// Makes the skin of tubes over a form.
class SkinMaker {
 public:
  SkinMaker(const BodyForm& form, const HairForm* hair) : form_(form), hair_(hair) {
    for (const FormTube& tube : form.tubes()) covers_ = covers_ || tube.kind == Kind::SKIRT;
  }

  void add(const FormTube& tube) {
    const std::size_t first = rings_.size();
    for (const FormRing& ring : tube.rings) {
      if (tube.kind == Kind::HEAD && ring.along > SCALP && !hair_->isBald()) continue;
      addRing(rings_.size() == first, ring);
      for (std::size_t k = 0; k < MOST_SIDES; ++k) place(tube, ring, k, rings_.back().vertices[k]);
    }
    if (tube.kind == Kind::HEAD || tube.kind == Kind::SKIRT) takeNormals(first);
    finish(tube, first);
  }

  /// @param head the tube of the head.
  void addHair(const FormTube& head) {
    const FormTube tube{Kind::HAIR, 1, head.origin, head.along, head.left, head.front, {}};
    const std::size_t first = rings_.size();
    for (std::size_t r = 0; r < hair_->rings(); ++r) {
      addRing(r == 0, hair_->at(r, 0));
      for (std::size_t k = 0; k < MOST_SIDES; ++k)
        place(tube, hair_->at(r, k), k, rings_.back().vertices[k]);
    }
    takeNormals(first);
    finish(tube, first);
  }

  SkinRings take() { return std::move(rings_); }

 private:
  void addRing(bool begins, const FormRing& ring) {
    SkinRing skin;
    skin.begins = begins;
    skin.fine = ring.fine;
    rings_.push_back(skin);
    placed_.push_back(ring);
  }

  void place(const FormTube& tube, const FormRing& ring, std::size_t side, SkinVertex& vertex) {
    const Around around = aroundOf(tube.kind, side);
    const bool hand = tube.kind == Kind::ARM && ring.along > WRIST;
    const SinCos turn = sinCosTurns(hand ? HAND_TURN : 0.0);
    const Vec3 left = turn.cos * tube.left + turn.sin * tube.front;
    const Vec3 front = turn.cos * tube.front - turn.sin * tube.left;
    vertex.position =
        tube.centreOf(ring) + around.left * ring.broad * left + around.front * ring.deep * front;
    flatten(ring, side, tube, vertex);
    vertex.cover = coverOf(tube.kind, ring, side, hair_ ? hair_->edge(columnOf(side)) : NO_HAIR);
    if (covers_ && ring.along < UNDER_SKIRT && isLower(vertex.cover)) vertex.cover = Cover::SKIRT;
    vertex.shade = ring.shade;
    if (!isHidden(tube, ring)) raiseTo(form_, tube, vertex);
    vertex.normal = tube.kind == Kind::EYE ? tube.along : form_.normal(vertex.position);
    vertex.position += thicknessAt(tube, ring) * vertex.normal;
    shapeDetails(tube.kind, ring, side, around.left * left + around.front * front, vertex);
  }

  // Clothes have hems, except below a skirt.
  double thicknessAt(const FormTube& tube, const FormRing& ring) const {
    const bool trunk = tube.kind == Kind::TRUNK;
    double out = trunk && ring.along > HEM_FROM && ring.along < HEM_TO ? HEM : 0.0;
    if (covers_ && (trunk || tube.kind == Kind::LEG) && ring.along < 0.03) out -= HEM;
    return out;
  }

  void finish(const FormTube& tube, std::size_t first) {
    for (std::size_t i = first; i < rings_.size(); ++i) {
      for (std::size_t k = 0; k < MOST_SIDES; ++k) {
        SkinVertex& vertex = rings_[i].vertices[k];
        vertex.open = openness(form_, vertex);
        if (tube.kind == Kind::HEAD) vertex.open = 0.4 + 0.6 * vertex.open;  // below the chin
        setBuilds(tube, placed_[i], vertex);
        crease(i * MOST_SIDES + k, vertex);
        bindTo(tube, vertex);
      }
    }
  }

  // Takes the normals of the last tube from its vertices, as features have no other.
  void takeNormals(std::size_t first) {
    std::vector<std::array<Vec3, MOST_SIDES>> normals;
    for (std::size_t i = first; i < rings_.size(); ++i) {
      const auto& own = rings_[i].vertices;
      const auto& low = rings_[std::max(i, first + 1) - 1].vertices;
      const auto& high = rings_[std::min(i + 1, rings_.size() - 1)].vertices;
      Vec3 middle = Vec3::Zero();
      for (const SkinVertex& vertex : own) middle += vertex.position / MOST_SIDES;
      auto& out = normals.emplace_back();
      for (std::size_t k = 0; k < MOST_SIDES; ++k) {
        const Vec3 round =
            own[(k + 1) % MOST_SIDES].position - own[(k + MOST_SIDES - 1) % MOST_SIDES].position;
        const Vec3 normal = cross(round, high[k].position - low[k].position);
        const double outward = dot(normal, own[k].position - middle);
        out[k] = (outward < 0.0 ? -1.0 : 1.0) / std::max(1e-12, length(normal)) * normal;
      }
    }
    for (std::size_t i = first; i < rings_.size(); ++i)
      for (std::size_t k = 0; k < MOST_SIDES; ++k)
        rings_[i].vertices[k].normal = normals[i - first][k];
  }

  const BodyForm& form_;
  const HairForm* hair_;  // or null
  bool covers_{false};    // a skirt covers the hips
  SkinRings rings_;
  FormRings placed_;  // of rings_
};

SkinRings makeBody(crowd::Outfit outfit) {
  const BodyForm form(outfit);
  SkinMaker maker(form, nullptr);
  for (const FormTube& tube : form.tubes())
    if (tube.kind != Kind::HEAD) maker.add(tube);
  return maker.take();
}

SkinRings makeHead(crowd::HairCut cut) {
  const BodyForm form(crowd::Outfit::TROUSERS);
  const HairForm hair(cut);
  SkinMaker maker(form, &hair);
  for (const FormTube& tube : form.tubes()) {
    if (tube.kind != Kind::HEAD) continue;
    maker.add(tube);
    maker.addHair(tube);
  }
  for (const FormTube& tube : headTubes(cut)) maker.add(tube);
  return maker.take();
}

template <typename Choice, typename Make>
std::array<SkinRings, static_cast<std::size_t>(Choice::COUNT)> makeAll(Make make) {
  std::array<SkinRings, static_cast<std::size_t>(Choice::COUNT)> out;
  for (std::size_t i = 0; i < out.size(); ++i) out[i] = make(static_cast<Choice>(i));
  return out;
}

}  // namespace

const SkinRings& bodyTemplate(crowd::Outfit outfit) {
  static const auto ALL = makeAll<crowd::Outfit>(makeBody);
  return ALL[static_cast<std::size_t>(outfit)];
}

const SkinRings& headTemplate(crowd::HairCut cut) {
  static const auto ALL = makeAll<crowd::HairCut>(makeHead);
  return ALL[static_cast<std::size_t>(cut)];
}

}  // namespace vegetation_sim::view
