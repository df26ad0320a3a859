// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#include "vegetation_sim/grass/blades/blade_batch.h"

// Vectors without arithmetic operators are not used; their processors run the plain target.
#define HWY_DISABLED_TARGETS (HWY_SVE | HWY_SVE2 | HWY_SVE_256 | HWY_SVE2_128 | HWY_RVV)
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "grass/blades/blade_batch.cpp"
#include <hwy/cache_control.h>
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

#include "grass/blades/blade_lanes-inl.h"
#include "grass/blades/blade_placement.h"

HWY_BEFORE_NAMESPACE();
namespace vegetation_sim::grass::HWY_NAMESPACE {

// Intermediate values of some blades, in the first-level cache. The work is done in passes over
// them, since one long chain of operations per vector would wait for each result.
constexpr int CHUNK = 128;
struct alignas(64) Chunk {
  float u[CHUNK], v[CHUNK], shortness[CHUNK], lean_x[CHUNK], lean_y[CHUNK], kind[CHUNK];
  float length[CHUNK], hinge[CHUNK], arc[CHUNK], x[CHUNK], y[CHUNK];
};

HWY_INLINE Lanes from(const float* place) {
  return hn::Load(Tag(), place);
}

HWY_INLINE void to(Lanes value, float* place) {
  hn::Store(value, Tag(), place);
}

// First pass: random numbers and places.
HWY_INLINE void rootLanes(const Tile& tile, const TilePlan<float>& plan, Words index, int i,
                          Chunk& c) {
  const WordTag tag;
  const Words base = baseLanes(tile.key, index);
  const Words first = wordLanes(base, 0), second = wordLanes(base, 1), third = wordLanes(base, 2);
  const Words byte = hn::Set(tag, 0xffU);
  const Lanes unit = all(static_cast<float>(1.0 / 16777216.0)), one = all(1.f);
  const Lanes per_byte = all(static_cast<float>(1.0 / 255.0));
  const Corners& d = tile.density;
  const Lanes v =
      linearPlace(toLanes(hn::ShiftRight<8>(first)) * unit, all(plan.south), all(plan.north));
  const Lanes west = all(d[0]) + all(d[2] - d[0]) * v, east = all(d[1]) + all(d[3] - d[1]) * v;
  to(v, c.v + i);
  to(linearPlace(toLanes(hn::ShiftRight<8>(second)) * unit, west, east), c.u + i);
  const Words low = hn::And(third, byte) + hn::And(hn::ShiftRight<8>(third), byte);
  const Words high = hn::And(hn::ShiftRight<16>(third), byte) + hn::ShiftRight<24>(third);
  to(toLanes(low) * per_byte - one, c.lean_x + i);
  to(toLanes(high) * per_byte - one, c.lean_y + i);
  to(toLanes(hn::And(first, byte)) * all(static_cast<float>(1.0 / 256.0)), c.shortness + i);
  if (plan.mixed) to(kindLanes(base), c.kind + i);
}

// Blades before they are bent.
struct LanesRoot {
  Lanes u, v, length;
  Lanes rest, compliance;  // of the species, if they are mixed
};

HWY_INLINE LanesRoot rootOf(const Tile& tile, const TilePlan<float>& plan, int i, const Chunk& c) {
  LanesRoot root;
  root.u = from(c.u + i);
  root.v = from(c.v + i);
  root.length = at(plan.height, root.u, root.v);
  Lanes spread = all(tile.species[0].spread);
  if (plan.mixed) {
    const auto last = static_cast<std::size_t>(tile.species_count - 1);
    const Lanes aim = from(c.kind + i) * at(plan.shares[last], root.u, root.v);
    Lanes height = all(tile.species[0].height);
    root.rest = all(tile.species[0].lean);
    root.compliance = all(tile.species[0].compliance);
    for (std::size_t s = 1; s <= last; ++s) {
      const auto beyond = aim > at(plan.shares[s - 1], root.u, root.v);
      height = hn::IfThenElse(beyond, all(tile.species[s].height), height);
      spread = hn::IfThenElse(beyond, all(tile.species[s].spread), spread);
      root.rest = hn::IfThenElse(beyond, all(tile.species[s].lean), root.rest);
      root.compliance = hn::IfThenElse(beyond, all(tile.species[s].compliance), root.compliance);
    }
    root.length = root.length * height;
  }
  root.length = root.length * (all(1.f) - spread * from(c.shortness + i));
  return root;
}

struct LanesBent {
  Lanes hinge, arc, x, y;
};

HWY_INLINE Lanes bounded(Lanes size) {
  const Lanes knee = all(static_cast<float>(BEND_KNEE));
  const auto over = size > knee;
  if (hn::AllFalse(Tag(), over)) return size;  // the usual case
  const Lanes room = all(static_cast<float>(BEND_LIMIT - BEND_KNEE));
  const Lanes excess = (size - knee) / room;
  return hn::IfThenElse(over, knee + room * (excess / hn::Sqrt(all(1.f) + excess * excess)), size);
}

HWY_INLINE LanesBent directed(Lanes x, Lanes y) {
  const Lanes zero = hn::Zero(Tag()), one = all(1.f);
  const Lanes size = hn::Sqrt(x * x + y * y);
  const auto any = size > zero;
  const Lanes inverse = one / size;
  return {zero, size, hn::IfThenElse(any, x * inverse, one), hn::IfThenElseZero(any, y * inverse)};
}

HWY_INLINE LanesBent bendOf(const TilePlan<float>& plan, const LanesRoot& root, Lanes lean_x,
                            Lanes lean_y) {
  Lanes lean = at(plan.shape, root.u, root.v);
  Lanes x = at(plan.wind_x, root.u, root.v), y = at(plan.wind_y, root.u, root.v);
  if (plan.mixed) {
    lean = lean * root.rest;
    x = x * root.compliance;
    y = y * root.compliance;
  }
  LanesBent bend = directed(lean * lean_x + x, lean * lean_y + y);
  bend.arc = bounded(bend.arc);
  return bend;
}

HWY_INLINE LanesBent trodden(const LanesBent& bend, const CrushPatch& crush,
                             const LanesRoot& root) {
  const Lanes zero = hn::Zero(Tag());
  const LanesCell cell = cellAt(root.u, root.v, crush.cells);
  const Lanes tilt = interpolate(cell, gather(cell, crush.tilt));
  const Lanes tx = interpolate(cell, gather(cell, crush.tx));
  const Lanes ty = interpolate(cell, gather(cell, crush.ty));
  const Lanes along = hn::Sqrt(tx * tx + ty * ty);
  const Lanes scale = hn::IfThenElseZero(along > zero, tilt / along);
  const Lanes left = bend.arc * (all(1.f) - tilt * all(static_cast<float>(1.0 / BEND_LIMIT)));
  LanesBent both = directed(tx * scale + bend.x * left, ty * scale + bend.y * left);
  const Lanes part = tilt + left;
  both.hinge = hn::IfThenElseZero(part > zero, both.arc * (tilt / part));
  both.arc = both.arc - both.hinge;
  return both;
}

// Positions of the blades, and the directions along the ground and away from it.
struct LanesFrame {
  Lanes x, y, z, tx, ty, tz, nx, ny, nz;
};

HWY_INLINE void setSlope(const Tile& tile, Lanes u, Lanes v, LanesFrame& f) {
  const Lanes zero = hn::Zero(Tag()), one = all(1.f);
  const LanesCell c = cellAt(u, v, tile.ground_cells);
  const LanesCorners g = gather(c, tile.ground);
  const Lanes per_metre = all(static_cast<float>(tile.ground_cells) / tile.size);
  const Lanes east = ((g.low1 - g.low0) * (one - c.q) + (g.high1 - g.high0) * c.q) * per_metre;
  const Lanes north = ((g.high0 - g.low0) * (one - c.p) + (g.high1 - g.low1) * c.p) * per_metre;
  f.z = interpolate(c, g);
  const Lanes climb = east * f.tx + north * f.ty;
  const Lanes shrink = one / hn::Sqrt(one + climb * climb);
  f.tx = f.tx * shrink;
  f.ty = f.ty * shrink;
  f.tz = climb * shrink;
  f.nz = one / hn::Sqrt(one + (east * east + north * north));
  f.nx = zero - east * f.nz;
  f.ny = zero - north * f.nz;
}

HWY_INLINE void putFlat(const LanesFrame& f, const LanesProfile& p, int lane, BladeBlock& out) {
  to(f.x, out.x[0] + lane);
  to(f.y, out.y[0] + lane);
  to(hn::Zero(Tag()), out.z[0] + lane);
  for (int i = 1; i < POINTS; ++i) {
    to(f.x + p.reach[i] * f.tx, out.x[i] + lane);
    to(f.y + p.reach[i] * f.ty, out.y[i] + lane);
    to(p.rise[i], out.z[i] + lane);
  }
}

HWY_INLINE void putSloped(const LanesFrame& f, const LanesProfile& p, int lane, BladeBlock& out) {
  for (int i = 0; i < POINTS; ++i) {
    to(f.x + p.reach[i] * f.tx + p.rise[i] * f.nx, out.x[i] + lane);
    to(f.y + p.reach[i] * f.ty + p.rise[i] * f.ny, out.y[i] + lane);
    to(f.z + p.reach[i] * f.tz + p.rise[i] * f.nz, out.z[i] + lane);
  }
}

// Second pass: lengths and bends.
HWY_INLINE void bendLanes(const Tile& tile, const TilePlan<float>& plan, const CrushPatch* crush,
                          int i, Chunk& c) {
  LanesRoot root = rootOf(tile, plan, i, c);
  if (crush && !crush->cut.empty())
    root.length = hn::Min(root.length, hn::GatherIndex(Tag(), crush->cut.data(),
                                                       nearestAt(root.u, root.v, crush->cells)));
  LanesBent bent = bendOf(plan, root, from(c.lean_x + i), from(c.lean_y + i));
  if (crush) {
    bent = trodden(bent, *crush, root);
    to(bent.hinge, c.hinge + i);
  }
  to(root.length, c.length + i);
  to(bent.arc, c.arc + i);
  to(bent.x, c.x + i);
  to(bent.y, c.y + i);
}

// Third pass: points.
HWY_INLINE void pointLanes(const Tile& tile, BladeModel model, bool crushed, int i, const Chunk& c,
                           BladeBlock& out) {
  const Lanes length = from(c.length + i), arc = from(c.arc + i);
  const Lanes hinge = crushed ? from(c.hinge + i) : hn::Zero(Tag());
  LanesProfile profile;
  if (model == BladeModel::ARC)
    arcProfile(length, hinge, arc, !crushed, profile);
  else
    paperProfile(length, hinge, arc, profile);
  const Lanes u = from(c.u + i), v = from(c.v + i);
  LanesFrame frame;
  frame.x = u * all(tile.size);
  frame.y = v * all(tile.size);
  frame.tx = from(c.x + i);
  frame.ty = from(c.y + i);
  if (!tile.sloped) return putFlat(frame, profile, i % BLOCK, out);
  setSlope(tile, u, v, frame);
  putSloped(frame, profile, i % BLOCK, out);
}

// Writes past the caches, one line of 64 bytes after the other.
HWY_INLINE void stream(const BladeBlock& block, BladeBlock& out) {
  const float* from = block.x[0];
  float* line = out.x[0];
  for (int i = 0; i < 3 * POINTS * BLOCK; i += static_cast<int>(hn::Lanes(Tag())))
    hn::Stream(hn::Load(Tag(), from + i), Tag(), line + i);
}

template <bool STREAMED>
HWY_INLINE void poseAll(const Tile& tile, const TileMotion& motion, int count, BladeBlock* out) {
  const TilePlan<float> plan(tile, motion);
  const int step = static_cast<int>(hn::Lanes(Tag()));
  const CrushPatch* crush = motion.crush && motion.crush->cells > 0 ? motion.crush : nullptr;
  Words index = hn::Iota(WordTag(), 0);
  Chunk chunk;
  BladeBlock block;
  for (int begin = 0; begin < blocksFor(count) * BLOCK; begin += CHUNK) {
    const int size = std::min(CHUNK, blocksFor(count) * BLOCK - begin);
    for (int i = 0; i < size; i += step) {
      rootLanes(tile, plan, index, i, chunk);
      index = index + hn::Set(WordTag(), static_cast<std::uint32_t>(step));
    }
    for (int i = 0; i < size; i += step) bendLanes(tile, plan, crush, i, chunk);
    for (int first = 0; first < size; first += BLOCK) {
      BladeBlock& target = out[(begin + first) / BLOCK];
      for (int i = first; i < first + BLOCK; i += step)
        pointLanes(tile, motion.model, crush != nullptr, i, chunk, STREAMED ? block : target);
      if (STREAMED) stream(block, target);
    }
  }
}

void poseCached(const Tile& tile, const TileMotion& motion, int count, BladeBlock* out) {
  poseAll<false>(tile, motion, count, out);
}

void poseStreamed(const Tile& tile, const TileMotion& motion, int count, BladeBlock* out) {
  poseAll<true>(tile, motion, count, out);
  hwy::FlushStream();
}

}  // namespace vegetation_sim::grass::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace vegetation_sim::grass {

HWY_EXPORT(poseCached);
HWY_EXPORT(poseStreamed);

void poseBlades(const Tile& tile, const TileMotion& motion, int count, BladeBlock* out,
                Store store) {
  if (store == Store::CACHED)
    HWY_DYNAMIC_DISPATCH(poseCached)(tile, motion, count, out);
  else
    HWY_DYNAMIC_DISPATCH(poseStreamed)(tile, motion, count, out);
}

}  // namespace vegetation_sim::grass
#endif
