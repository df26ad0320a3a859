// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#include "rviz/trees/drawn_tree.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "rviz/textures/bark_texture.h"
#include "rviz/textures/leaf_atlas.h"
#include "rviz/trees/folded_cards.h"
#include "rviz/trees/limb_ends.h"
#include "vegetation_sim/core/math/math.h"
#include "vegetation_sim/core/math/random.h"
#include "vegetation_sim/tree/motion/batch_poser.h"

namespace vegetation_sim::view {
namespace {

constexpr double VISIBLE_FLUTTER = 0.4;  // [pixel]
constexpr double BREATH = 0.15;          // [m/s] slower wind moves no leaf
constexpr double LIMB_VARIETY = 0.14;    // +- lightness of leaves from limb to limb
constexpr double LIT_EDGE = 1.1;         // lightness of the leaves at the edge of a crown
constexpr double DEEP_SHADE = 0.32;      // loss of lightness in the middle of a crown
constexpr std::uint64_t LIMB_DRAW = 0x6c696d62;
constexpr forest::Colour MOVES{0.86f, 0.22f, 0.12f}, CHANGES{0.25f, 0.72f, 0.20f},
    PHYSICAL{0.10f, 0.35f, 0.90f}, HELD{0.95f, 0.80f, 0.08f};

std::uint8_t byte(double x) {
  return static_cast<std::uint8_t>(saturate(x) * 255.0 + 0.5);
}

void setColour(const forest::Colour& colour, VertexPaint& paint) {
  for (std::size_t i = 0; i < 3; ++i) paint.colour[i] = byte(static_cast<double>(colour[i]));
}

void setNormal(const Vec3& normal, VertexPaint& paint) {
  const Vec3 unit = normal / std::max(length(normal), 1e-9);
  for (int i = 0; i < 3; ++i) paint.normal[i] = static_cast<float>(unit[i]);
}

void scale(double factor, forest::Colour& colour) {
  for (float& part : colour) part *= static_cast<float>(factor);
}

// Returns the lightness of the leaves of each branch: that of its limb, which stands out from
// others.
std::vector<double> limbLightness(const forest::Skeleton& skeleton) {
  std::vector<double> out;
  for (const forest::Branch& branch : skeleton.branches) {
    const auto parent = static_cast<std::size_t>(std::max(branch.parent, 0));
    const bool begins = branch.depth > 0 && skeleton.branches[parent].depth == 0;
    out.push_back(begins ? 1.0 + Random(branch.key).uniform(LIMB_DRAW, -LIMB_VARIETY, LIMB_VARIETY)
                  : branch.depth > 0 && branch.parent >= 0 ? out[parent]
                                                           : 1.0);
  }
  return out;
}

// Returns the lightness of leaves by their place in the crown: 0 in its middle, 1 at its edge.
double crownLightness(double place) {
  return LIT_EDGE - DEEP_SHADE * (1.0 - smoothStep((place - 0.2) / 0.65));
}

double radiusOf(const forest::BarkVertex& vertex) {
  return std::hypot(static_cast<double>(vertex.local[0]), static_cast<double>(vertex.local[1]));
}

void setFade(float fade, DrawnTree::Shape& shape) {
  for (DrawnTree::Part* part : {&shape.bark, &shape.leaves})
    for (VertexPaint& paint : part->paint) paint.fade = fade;
}

}  // namespace

DrawnTree::DrawnTree(const forest::ForestReplica& replica, std::uint32_t id, const Vec3& origin)
    : id_(id),
      origin_(origin),
      broken_(brokenOf(replica.broken(), id)),
      tree_(replica.grow(id)),
      species_(replica.layout().species.at(tree_.seed.species)),
      paint_(species_, tree_.seed.seed),
      poser_(tree_),
      boughs_(tree_.skeleton) {}

DrawnTree::DrawnTree(const forest::ForestReplica& replica, std::uint32_t id, const Vec3& origin,
                     std::shared_ptr<const forest::FallingPiece> piece)
    : id_(id),
      origin_(origin),
      piece_(std::move(piece)),
      tree_(piece_->tree()),
      species_(replica.layout().species.at(tree_.seed.species)),
      paint_(species_, tree_.seed.seed),
      poser_(tree_) {}

bool DrawnTree::movePiece(Nanoseconds stamp) {
  const bool falls = stamp < piece_->restsFrom();
  if (!falls && !moved_) return false;
  moved_ = falls;
  narrowPoses(piece_->poseAt(stamp), poses_);
  skin(forest::Flutter());
  return true;
}

void DrawnTree::regrow(const forest::ForestReplica& replica) {
  broken_ = brokenOf(replica.broken(), id_);
  tree_ = replica.grow(id_);
  poser_ = forest::BatchPoser(tree_);
  boughs_ = forest::Boughs(tree_.skeleton);
  painted_by_state_ = false;
}

void DrawnTree::addTo(forest::LightGrid& light) const {
  const double area = forest::LEAF_COVERAGE * species_.leaf_size * species_.leaf_size;
  for (const forest::Branch& branch : tree_.skeleton.branches) {
    if (branch.leaves == 0) continue;
    const Vec3 tip = tipOf(branch, branch.rest);
    light.addLeaf(tree_.foot + 0.5 * (branch.rest.position + tip), 0.5 * area * branch.leaves);
    light.addLeaf(tree_.foot + tip, 0.5 * area * branch.leaves);
  }
}

Vec3 DrawnTree::inLayout(const float* position) const {
  return origin_ + Vec3(position[0], position[1], position[2]);
}

forest::TreeLevels DrawnTree::levelsFor(const Viewpoint& eye, double factor, bool by_bough) const {
  return forest::treeLevels(tree_.skeleton, boughs_, tree_.foot, eye, factor, by_bough, levels_);
}

DrawnTree::Shape DrawnTree::makeShape(const forest::TreeLevels& levels,
                                      const TreeLook& look) const {
  const forest::TreeMeshDetail detail = forest::treeMeshDetail(boughs_, levels);
  Shape out{detail.depths(), forest::buildMesh(tree_.skeleton, species_, detail), {}, {}};
  finishLimbEnds(tree_.skeleton, out.mesh);
  if (!look.leaves) out.mesh.leaves.clear();
  out.bark.positions.resize(3 * out.mesh.bark.size());
  out.leaves.positions.resize(3 * forest::LEAF_CORNERS * out.mesh.leaves.size());
  return out;
}

void DrawnTree::setLevels(const forest::TreeLevels& levels, const forest::LightGrid& light,
                          const TreeLook& look, float fade_clock) {
  shapes_.resize(fade_clock > 0.f && levels_.trunk >= 0 ? 1 : 0);
  shapes_.insert(shapes_.begin(), makeShape(levels, look));
  levels_ = levels;
  poseAtRest();
  skin(forest::Flutter());
  moved_ = true;
  paintBark(light, shapes_.front());
  paintLeaves(light, shapes_.front());
  if (!fading()) return;
  fades_since_ = fade_clock;
  setFade(fade_clock, shapes_.front());
  setFade(-fade_clock, shapes_.back());
}

// A piece is lit as it was in its tree.
void DrawnTree::poseAtRest() {
  if (!piece_) return poser_.pose(wind::Instant(), forest::Weights{}, depths(), poses_);
  std::vector<Pose> rest;
  for (const forest::Branch& branch : tree_.skeleton.branches) rest.push_back(branch.rest);
  narrowPoses(rest, poses_);
}

void DrawnTree::endFade() {
  shapes_.resize(1);
  setFade(0.f, shapes_.front());
}

int DrawnTree::depths() const {
  int out = 0;
  for (const Shape& shape : shapes_) out = std::max(out, shape.depths);
  return out;
}

void DrawnTree::skin(const forest::Flutter& flutter) {
  const Vec3 foot = tree_.foot - origin_;
  const std::array<float, 3> at{static_cast<float>(foot.x()), static_cast<float>(foot.y()),
                                static_cast<float>(foot.z())};
  for (Shape& shape : shapes_) {
    forest::skinBark(shape.mesh, poses_, at, shape.bark.positions.data());
    forest::skinLeaves(shape.mesh, poses_, at, flutter, shape.leaves.positions.data());
    foldClusters(shape.mesh, shape.leaves.positions.data());
  }
}

bool DrawnTree::move(const forest::ForestReplica& replica, Nanoseconds stamp,
                     const wind::Instant& wind, const TreeLook& look, double pixels_per_metre) {
  if (level() < 0) return false;
  if (piece_) return movePiece(stamp);
  const forest::Weights weights = replica.weights(id_, stamp);
  forest::Flutter flutter;
  const double swing = species_.flutter * species_.leaf_size * pixels_per_metre;
  bool moves = forest::movingDepths(weights) > 0;
  if (look.flutter && swing > VISIBLE_FLUTTER && !shapes_.front().mesh.leaves.empty()) {
    const double speed = length(wind.velocity(tree_.foot + Vec3(0.0, 0.0, 0.6 * height())));
    if (speed > BREATH) {
      flutter = forest::Flutter(secondsBetween(0, stamp), speed, species_.flutter);
      moves = true;
    }
  }
  const bool remembers = !replica.promoted(id_).branches.empty() || replica.modalState(id_);
  moves = moves || remembers;
  if (!moves && !moved_) return false;
  moved_ = moves;
  const forest::ModalTreeState* modal_state = replica.modalState(id_);
  if (modal_state && replica.promoted(id_).branches.empty() && forest::modalWeight(weights) >= 1.0)
    modal_state->pose(poser_, stamp, poses_);
  else if (remembers)
    narrowPoses(replica.pose(tree_, id_, stamp), poses_);
  else
    poser_.pose(wind.relativeTo(tree_.foot), weights, depths(), poses_);
  skin(flutter);
  return true;
}

void DrawnTree::paintBark(const forest::LightGrid& light, Shape& shape) {
  shape.bark.paint.resize(shape.mesh.bark.size());
  std::vector<float> normals(3 * shape.mesh.bark.size());
  forest::turnBarkNormals(shape.mesh, poses_, normals.data());
  for (std::size_t i = 0; i < shape.mesh.bark.size(); ++i) {
    const forest::BarkVertex& vertex = shape.mesh.bark[i];
    VertexPaint& paint = shape.bark.paint[i];
    const Vec3 at = inLayout(&shape.bark.positions[3 * i]);
    setNormal(Vec3(normals[3 * i], normals[3 * i + 1], normals[3 * i + 2]), paint);
    // Bark is damp and darker at the foot.
    const double above = saturate((at.z() - tree_.foot.z()) / (6.0 * species_.trunk_radius));
    forest::Colour colour = paint_.bark(radiusOf(vertex));
    for (float& part : colour) part *= static_cast<float>(0.6 + 0.4 * above);
    setColour(colour, paint);
    paint.colour[3] = byte(light.sun(at));
    paint.place[0] = barkAtlasU(species_.leaf_shape, vertex.uv[0]);
    paint.place[1] = vertex.uv[1] / (2.f * BARK_PERIOD);
    paint.place[2] = static_cast<float>(light.sky(at));
  }
  painted_by_state_ = false;
}

// Normals point out of the crown, so that it is shaded as one round body and not as many cards.
void DrawnTree::paintLeaves(const forest::LightGrid& light, Shape& shape) {
  shape.leaves.paint.resize(forest::LEAF_CORNERS * shape.mesh.leaves.size());
  if (shape.mesh.leaves.empty()) return;
  Vec3 middle = Vec3::Zero();
  for (std::size_t i = 0; i < shape.leaves.positions.size(); i += 3)
    middle += inLayout(&shape.leaves.positions[i]);
  middle /= static_cast<double>(shape.leaves.positions.size() / 3);
  const Vec3 extent(reach() + 0.1, reach() + 0.1, 0.5 * height() + 0.1);
  const std::vector<double> limbs = limbLightness(tree_.skeleton);
  for (std::size_t card = 0; card < shape.mesh.leaves.size(); ++card) {
    const std::size_t first = forest::LEAF_CORNERS * card;
    const Vec3 centre = 0.5 * (inLayout(&shape.leaves.positions[3 * first]) +
                               inLayout(&shape.leaves.positions[3 * first + 6]));
    forest::Colour colour = paint_.leaf(shape.mesh.leaves[card]);
    scale(limbs[static_cast<std::size_t>(shape.mesh.leaves[card].branch)] *
              crownLightness(length(Vec3(centre - middle).cwiseQuotient(extent))),
          colour);
    const double sun = light.sun(centre), sky = light.sky(centre);
    for (std::size_t i = 0; i < forest::LEAF_CORNERS; ++i) {
      VertexPaint& paint = shape.leaves.paint[first + i];
      const Vec3 at = inLayout(&shape.leaves.positions[3 * (first + i)]);
      const Vec3 out = (at - middle).cwiseQuotient(extent);
      setNormal(out + 0.5 * (at - centre) / static_cast<double>(shape.mesh.leaves[card].size) +
                    Vec3(0.0, 0.0, 0.25),
                paint);
      setColour(colour, paint);
      paint.colour[3] = byte(sun);
      const std::array<float, 2> place = leafAtlasPlace(
          species_.leaf_shape, shape.mesh.showsBough(card), shape.mesh.outlineOf(card)[i]);
      std::copy(place.begin(), place.end(), paint.place);
      paint.place[2] = static_cast<float>(sky);
    }
  }
}

bool DrawnTree::paintStates(const forest::ForestReplica& replica, Nanoseconds stamp,
                            const TreeLook& look, const std::vector<int>& held) {
  const bool by_state = look.colours == TreeColours::BY_STATE;
  if (level() < 0 || (!by_state && !painted_by_state_)) return false;
  forest::Weights weights{};
  std::vector<int> physical, marked;
  if (by_state) {
    weights = replica.weights(id_, stamp);
    for (const auto& branch : replica.promoted(id_).branches) physical.push_back(branch.branch);
    marked = held;
  }
  if (painted_by_state_ && by_state && weights == painted_ && physical == painted_physical_ &&
      marked == painted_held_)
    return false;
  const auto contains = [](const std::vector<int>& branches, int branch) {
    return std::binary_search(branches.begin(), branches.end(), branch);
  };
  Shape& shape = shapes_.front();
  for (std::size_t i = 0; i < shape.mesh.bark.size(); ++i) {
    const forest::BarkVertex& vertex = shape.mesh.bark[i];
    const int depth = tree_.skeleton.branches[static_cast<std::size_t>(vertex.branch)].depth;
    const double weight = weights[static_cast<std::size_t>(depth)];
    setColour(contains(marked, vertex.branch)     ? HELD
              : contains(physical, vertex.branch) ? PHYSICAL
              : weight <= 0.0                     ? paint_.bark(radiusOf(vertex))
              : weight < 1.0                      ? CHANGES
                                                  : MOVES,
              shape.bark.paint[i]);
  }
  painted_ = weights;
  painted_physical_ = std::move(physical);
  painted_held_ = std::move(marked);
  painted_by_state_ = by_state;
  return true;
}

}  // namespace vegetation_sim::view
