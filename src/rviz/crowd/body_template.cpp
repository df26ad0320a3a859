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
constexpr double HEM = 0.005;     // thickness of clothes at their hems
constexpr double HEM_FROM = -0.018, HEM_TO = -0.01;
constexpr double BELT = 0.035;    // of rings of the trunk
constexpr double TUCKED = 0.023;  // by how much hips are thinner without the top over them
// Depths of the head below hair, and of the trunk and of legs below a skirt.
constexpr double BELOW_HAIR = 0.005, BELOW_SKIRT = 0.018, LEG_BELOW_SKIRT = 0.013;
constexpr double WRIST = 0.32, KNUCKLES = 0.372;  // of rings of arms
constexpr double UNDER_SKIRT = 0.15;              // of rings of trunk and legs
constexpr double SCALP = 0.115;                   // height of the head's rings that hair hides
constexpr double NO_HAIR = 1.0;                   // a hairline above the head

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

bool isFinger(Kind kind) {
  return kind == Kind::FINGER || kind == Kind::THUMB;
}

bool isEye(const FormTube& tube, Cover cover) {
  return (tube.kind == Kind::EYE || tube.kind == Kind::IRIS) && cover != Cover::SKIN;
}

// Returns the number of vertices of a ring that is seen from near.
std::size_t sidesOf(Kind kind) {
  if (isFinger(kind)) return 4;
  return kind == Kind::IRIS || kind == Kind::EAR ? 6 : MOST_SIDES;
}

// Arms are raised over the trunk at the shoulders, so that their seams are clean.
bool isBelowSleeves(const FormTube& tube, const FormRing& ring) {
  return tube.kind == Kind::TRUNK && ring.along > 0.2 && ring.along < 0.3;
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
  return cover == Cover::TROUSERS || cover == Cover::HEM || cover == Cover::HEM_FRONT ||
         cover == Cover::UNDER_HEM;
}

/// Makes the skin of tubes over a form.
class SkinMaker {
 public:
  SkinMaker(const BodyForm& form, const HairForm* hair) : form_(form), hair_(hair) {
    for (const FormTube& tube : form.tubes())
      if (tube.kind == Kind::SKIRT) {
        skirt_ = -tube.rings.front().along;
        waist_ = tube.rings.back().along - 0.012;
      }
  }

  void add(const FormTube& tube) {
    const std::size_t first = rings_.size();
    for (const FormRing& ring : tube.rings) {
      if (tube.kind == Kind::HEAD && ring.along > SCALP && !hair_->isBald()) continue;
      addRing(tube, rings_.size() == first, ring);
      for (std::size_t k = 0; k < MOST_SIDES; ++k) place(tube, ring, k, rings_.back().vertices[k]);
    }
    if (tube.kind == Kind::HEAD || isFinger(tube.kind) || tube.kind == Kind::SKIRT ||
        tube.kind == Kind::EAR)
      takeNormals(first);
    finish(tube, first);
  }

  /// @param head the tube of the head.
  void addHair(const FormTube& head) {
    const FormTube tube{Kind::HAIR, 1, head.origin, head.along, head.left, head.front, {}};
    const std::size_t first = rings_.size();
    for (std::size_t r = 0; r < hair_->rings(); ++r) {
      addRing(tube, r == 0, hair_->at(r, 0));
      for (std::size_t k = 0; k < MOST_SIDES; ++k)
        place(tube, hair_->at(r, k), k, rings_.back().vertices[k]);
    }
    takeNormals(first);
    finish(tube, first);
  }

  SkinRings take() { return std::move(rings_); }

 private:
  void addRing(const FormTube& tube, bool begins, const FormRing& ring) {
    SkinRing skin;
    skin.begins = begins;
    skin.fine = ring.fine;
    skin.close = tube.isClose();
    skin.sides = sidesOf(tube.kind);
    rings_.push_back(skin);
    placed_.push_back(ring);
  }

  void place(const FormTube& tube, const FormRing& ring, std::size_t side, SkinVertex& vertex) {
    const Around around = aroundOf(tube.kind, side);
    Vec3 left = tube.left, front = tube.front, curl = Vec3::Zero();
    if (tube.kind == Kind::ARM && ring.along > WRIST) {
      const HandAxes hand = handAxes(tube);
      left = tube.side == 0 ? hand.back : Vec3(-hand.back);
      front = hand.thumb;
      curl = curlOf(ring.along - KNUCKLES) * hand.back;
    }
    vertex.position = tube.centreOf(ring) - curl + around.left * ring.broad * left +
                      around.front * ring.deep * front;
    flatten(ring, side, tube, vertex);
    const double hairline = hair_ ? hair_->edgeAt(around) : NO_HAIR;
    vertex.cover = coverOf(tube.kind, ring, side, hairline);
    if (skirt_ > 0.0 && ring.along < skirt_ && isLower(vertex.cover))
      vertex.cover = ring.along < UNDER_SKIRT ? Cover::SKIRT : Cover::SHANK;
    vertex.shade = ring.shade;
    if (!isHidden(tube, ring) && !isBelowSleeves(tube, ring)) raiseTo(form_, tube, vertex);
    vertex.normal = isEye(tube, ring.cover) ? tube.along : form_.normal(vertex.position);
    vertex.position += thicknessAt(tube, ring, hairline) * vertex.normal;
    if (tube.kind == Kind::TRUNK)
      vertex.tucked = -TUCKED * smoothStep((BELT - ring.along) / (BELT - HEM_FROM)) * vertex.normal;
    shapeDetails(tube.kind, ring, side, around.left * left + around.front * front, vertex);
  }

  // Clothes have hems. What lies below a skirt or hair is thinner.
  double thicknessAt(const FormTube& tube, const FormRing& ring, double hairline) const {
    if (tube.kind == Kind::HEAD)
      return -BELOW_HAIR * smoothStep((ring.along - hairline + 0.004) / 0.012);
    const bool trunk = tube.kind == Kind::TRUNK;
    double out = trunk && ring.along > HEM_FROM && ring.along < HEM_TO ? HEM : 0.0;
    if (trunk && ring.along < waist_) out -= ring.along < 0.03 ? BELOW_SKIRT : 0.5 * BELOW_SKIRT;
    if (tube.kind == Kind::LEG && skirt_ > 0.0 && ring.along < skirt_) out -= LEG_BELOW_SKIRT;
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
  double skirt_{0.0};     // length of a skirt or coat below the hips
  double waist_{-1.0};    // height of its upper end, where the trunk is no longer below it
  SkinRings rings_;
  FormRings placed_;  // of rings_
};

SkinRings makeBody(crowd::Outfit outfit, bool long_sleeves) {
  const BodyForm form(outfit, long_sleeves);
  SkinMaker maker(form, nullptr);
  for (const FormTube& tube : form.tubes())
    if (tube.kind != Kind::HEAD) maker.add(tube);
  for (const FormTube& tube : fingerTubes(form)) maker.add(tube);
  return maker.take();
}

SkinRings makeHead(crowd::HairCut cut) {
  const BodyForm form(crowd::Outfit::TROUSERS, true);
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
auto makeAll(Make make) {
  std::array<decltype(make(Choice())), static_cast<std::size_t>(Choice::COUNT)> out;
  for (std::size_t i = 0; i < out.size(); ++i) out[i] = make(static_cast<Choice>(i));
  return out;
}

}  // namespace

const SkinRings& bodyTemplate(crowd::Outfit outfit, bool long_sleeves) {
  static const auto ALL = makeAll<crowd::Outfit>([](crowd::Outfit choice) {
    return std::array<SkinRings, 2>{makeBody(choice, false), makeBody(choice, true)};
  });
  return ALL[static_cast<std::size_t>(outfit)][long_sleeves ? 1 : 0];
}

const SkinRings& headTemplate(crowd::HairCut cut) {
  static const auto ALL = makeAll<crowd::HairCut>(makeHead);
  return ALL[static_cast<std::size_t>(cut)];
}

}  // namespace vegetation_sim::view
