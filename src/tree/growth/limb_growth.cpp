// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#include "tree/growth/limb_growth.h"

#include <algorithm>
#include <cmath>

#include "core/math/random_batch.h"
#include "tree/growth/golden_angle.h"
#include "vegetation_sim/core/math/math.h"
#include "vegetation_sim/core/math/random.h"
#include "vegetation_sim/tree/growth/skeleton.h"

namespace vegetation_sim::forest {
namespace {

constexpr std::uint64_t FIRST_LATERAL = 16;  // number of the generator of a limb's first child

double crownFactor(Crown crown, double f) {
  switch (crown) {
    case Crown::CONICAL:
      return 1.0 - 0.88 * f;
    case Crown::ROUND:
      return 0.35 + 0.65 * 4.0 * f * (1.0 - f);
    case Crown::FLAME:
      return f < 0.3 ? 0.5 + f / 0.6 : 1.0 - 0.9 * (f - 0.3) / 0.7;
    case Crown::EVEN:
      break;
  }
  return 1.0 - 0.25 * f;
}

// Returns a value in [-1, 1] times the species' noise; 0 leaves the bare rules (S1-12).
double varied(const Species& species, std::uint64_t bits) {
  return std::min(1.0, species.noise) * (-1.0 + 2.0 * Random::uniformOf(bits));
}

// Where a limb grows: the child with number i of `count` children of a limb.
struct Bud {
  int bearer, i, count;
};

using Words = std::vector<std::uint64_t>;

// The numbers of many limbs, which are drawn at once.
struct LimbNumbers {
  Words key, length, place, azimuth, angle, leaves;

  static Words draw(const Words& keys, LimbDraw index) {
    Words out(keys.size());
    drawBits(keys.data(), keys.size(), index, out.data());
    return out;
  }
  explicit LimbNumbers(Words keys)
      : key(std::move(keys)),
        length(draw(key, LENGTH)),
        place(draw(key, PLACE)),
        azimuth(draw(key, AZIMUTH)),
        angle(draw(key, ANGLE)),
        leaves(draw(key, LEAVES)) {}
};

class LimbGrower {
 public:
  LimbGrower(const TreeSeed& seed, const Species& species) : seed_(seed), species_(species) {}

  std::vector<std::vector<Limb>> grow(std::size_t& count) const {
    std::vector<std::vector<Limb>> limbs{{trunk()}};
    for (int depth = 0; depth < species_.depths() && !limbs.back().empty(); ++depth) {
      count += limbs.back().size() * static_cast<std::size_t>(rule(depth).segments);
      if (depth + 1 < species_.depths()) limbs.push_back(sprout(limbs.back(), depth, count));
    }
    if (limbs.back().empty()) limbs.pop_back();
    return limbs;
  }

 private:
  const LimbRule& rule(int depth) const { return species_.limbs[static_cast<std::size_t>(depth)]; }
  double vary(std::uint64_t bits) const { return varied(species_, bits); }

  Limb trunk() const {
    const Random random = Random(seed_.seed).child(TREE);
    Limb out;
    const double size = trunkScale(seed_, species_);
    out.length = species_.height * size;
    out.base_radius = species_.trunk_radius * size;
    out.tip_radius = out.base_radius * rule(0).taper;
    out.key = random.key();
    out.azimuth = random.bits(AZIMUTH);
    out.angle = random.bits(ANGLE);
    out.theta = seed_.yaw + species_.turn * vary(out.azimuth);
    out.phi =
        std::min(largestAngle(species_, 1.0), species_.lean * std::fabs(vary(random.bits(LEAN))));
    out.leaves = leavesOf(random.bits(LEAVES), 0);
    return out;
  }
  int leavesOf(std::uint64_t bits, int depth) const {
    return static_cast<int>(rule(depth).leaves + 0.5 + 0.5 * vary(bits));
  }

  // Returns the limbs of the next depth. `grown` is the number of branches so far.
  std::vector<Limb> sprout(const std::vector<Limb>& bearers, int depth, std::size_t grown) const {
    const LimbRule& next = rule(depth + 1);
    const auto room = static_cast<std::size_t>(std::max(0, MAX_BRANCHES - static_cast<int>(grown)) /
                                               next.segments);
    Words keys;
    const std::vector<Bud> buds = findBuds(bearers, next, room, keys);
    const LimbNumbers numbers(std::move(keys));
    std::vector<Limb> out(buds.size());
    for (std::size_t k = 0; k < buds.size(); ++k)
      setLateral(bearers[static_cast<std::size_t>(buds[k].bearer)], buds[k], depth + 1, numbers, k,
                 out[k]);
    return out;
  }

  // Returns at most `room` buds, and the keys of the limbs that they become.
  std::vector<Bud> findBuds(const std::vector<Limb>& bearers, const LimbRule& next,
                            std::size_t room, Words& keys) const {
    Words bearer_keys(bearers.size());
    for (std::size_t b = 0; b < bearers.size(); ++b) bearer_keys[b] = bearers[b].key;
    const Words counts = LimbNumbers::draw(bearer_keys, COUNT),
                places = LimbNumbers::draw(bearer_keys, PLACE);
    std::vector<Bud> out;
    Words parents, indices;
    for (std::size_t b = 0; b < bearers.size(); ++b) {
      const double wanted = next.children * (1.0 + 0.2 * vary(counts[b]));
      const int count = static_cast<int>(wanted + 0.5 + 0.5 * vary(places[b]));
      for (int i = 0; i < count && out.size() < room; ++i) {
        out.push_back({static_cast<int>(b), i, count});
        parents.push_back(bearer_keys[b]);
        indices.push_back(static_cast<std::uint64_t>(i) + FIRST_LATERAL);
      }
    }
    keys.resize(out.size());
    drawChildren(parents.data(), indices.data(), out.size(), keys.data());
    return out;
  }

  void setLateral(const Limb& bearer, const Bud& bud, int depth, const LimbNumbers& numbers,
                  std::size_t k, Limb& out) const {
    const LimbRule& r = rule(depth);
    const int whorls = (bud.count + r.whorl - 1) / r.whorl, turn = bud.i / r.whorl;
    const double place = (turn + 0.5 + 0.25 * vary(numbers.place[k])) / whorls;
    const double f = std::min(r.start + (r.end - r.start) * place, 0.999);
    out.bearer = bud.bearer;
    const double along = f * rule(depth - 1).segments;
    out.segment = static_cast<int>(along);
    out.h = (along - out.segment) * bearer.length / rule(depth - 1).segments;
    out.length = bearer.length * r.length * crownFactor(r.crown, place) *
                 (1.0 + r.length_variation * vary(numbers.length[k]));
    const double bearer_radius = radiusAt(bearer, f);
    out.base_radius = std::max(bearer_radius * r.radius, species_.twig_radius);
    out.tip_radius = std::max(out.base_radius * r.taper, species_.twig_radius);
    out.length = std::min(out.length, species_.slenderness * out.base_radius);
    const double spread = 2.0 * PI * (bud.i % r.whorl) / r.whorl;
    out.theta = turn * GOLDEN_ANGLE + spread + 0.3 * vary(numbers.azimuth[k]);
    const double angle = r.angle_low + (r.angle_high - r.angle_low) * place +
                         r.angle_variation * vary(numbers.angle[k]);
    const double widest = largestAngle(species_, out.base_radius / bearer_radius);
    out.phi = std::max(0.0, std::min(angle, widest));
    out.leaves = leavesOf(numbers.leaves[k], depth);
    out.key = numbers.key[k];
    out.azimuth = numbers.azimuth[k];
    out.angle = numbers.angle[k];
  }

  const TreeSeed& seed_;
  const Species& species_;
};

}  // namespace

double trunkScale(const TreeSeed& seed, const Species& species) {
  const double change = varied(species, Random(seed.seed).child(TREE).bits(LENGTH));
  return seed.scale * (1.0 + species.height_variation * change);
}

std::vector<std::vector<Limb>> growLimbs(const TreeSeed& seed, const Species& species,
                                         std::size_t& count) {
  count = 0;
  return LimbGrower(seed, species).grow(count);
}

}  // namespace vegetation_sim::forest
