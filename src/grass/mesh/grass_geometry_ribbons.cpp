// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
// Batched blades as triangles. The traits of a blade are computed from the position of its root, so
// that no random number is drawn twice. A block of blades is first computed with a row of memory
// per number of a ribbon; the rows are then transposed into the lists of the mesh.

#include <cstring>

#include "grass/mesh/ribbon_plan.h"

// Vectors without arithmetic operators are not used; their processors run the plain target.
#define HWY_DISABLED_TARGETS (HWY_SVE | HWY_SVE2 | HWY_SVE_256 | HWY_SVE2_128 | HWY_RVV)
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "grass/mesh/grass_geometry_ribbons.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

#include "grass/mesh/ribbon_lanes-inl.h"

HWY_BEFORE_NAMESPACE();
namespace vegetation_sim::grass::HWY_NAMESPACE {

constexpr int QUAD = 4;  // rows that are transposed at once
constexpr int MOST_VERTICES = 2 * LINKS + 1;
constexpr int POSITION_ROWS = (3 * MOST_VERTICES + QUAD - 1) / QUAD * QUAD;
constexpr int COLOUR_ROWS = (MOST_VERTICES + QUAD - 1) / QUAD * QUAD;

// Numbers of the ribbons of one block.
struct alignas(64) RibbonRows {
  float position[POSITION_ROWS][BLOCK]{};
  std::uint32_t colour[COLOUR_ROWS][BLOCK]{};
  float side_x[BLOCK]{}, side_y[BLOCK]{}, side_z[BLOCK]{}, kind[BLOCK]{};
  float flower[BLOCK]{};  // radius, less than 0: half length of a seed head, 0: none [m]
  float length[BLOCK]{};  // from root to tip [m]
  std::uint32_t dice[BLOCK]{};
};

// Data that all ribbons of the same number of segments share.
struct RibbonPattern {
  static constexpr int ROOM = 32;  // more than a ribbon takes, so that whole vectors are copied
  explicit RibbonPattern(const RibbonPlan& plan) : segments(plan.segments()) {
    for (int k = 0; k <= segments; ++k) {
      const std::size_t i = static_cast<std::size_t>(4 * k);
      const float part = static_cast<float>(plan.kept[static_cast<std::size_t>(k)]) / LINKS;
      way[static_cast<std::size_t>(k)] = part;
      texture[i] = k < segments ? 0.f : 0.5f;
      texture[i + 1] = k < segments ? part : 1.f;
      if (k < segments) texture[i + 2] = 1.f, texture[i + 3] = part;
    }
    for (std::uint32_t t = 0; t < 2 * static_cast<std::uint32_t>(segments) - 1; ++t)
      for (std::uint32_t corner = 0; corner < 3; ++corner) index[3 * t + corner] = t + corner;
  }
  int segments;
  std::array<float, POINTS> way{};
  alignas(64) std::array<float, ROOM> texture{};
  alignas(64) std::array<std::uint32_t, ROOM> index{};
};

struct RibbonJob {
  RibbonJob(const RibbonPlan& p, int blades)
      : plan(p),
        pattern(p),
        light(p.style.light ? *p.style.light : GrassLight()),
        count(blades),
        leaving(static_cast<float>(p.style.leaving * blades)) {}
  const RibbonPlan& plan;
  RibbonPattern pattern;
  FloatLight light;
  int count;
  float leaving;
};

HWY_INLINE void putPoint(const Lanes3& p, int vertex, int lane, RibbonRows& rows) {
  hn::Store(p.x, Tag(), rows.position[3 * vertex] + lane);
  hn::Store(p.y, Tag(), rows.position[3 * vertex + 1] + lane);
  hn::Store(p.z, Tag(), rows.position[3 * vertex + 2] + lane);
}

// Numbers of a varied blade: RibbonForm.
struct LanesForm {
  explicit LanesForm(const RibbonPlan& plan, Words dice) {
    const Words word = mixLanes(dice + hn::Set(WordTag(), WORD_STEP)),
                byte = hn::Set(WordTag(), 255);
    const auto centred = [&](Words bits)
                             HWY_ATTR { return toLanes(bits) / all(127.5f) - all(1.f); };
    lean_x = centred(hn::And(word, byte));
    lean_y = centred(hn::And(hn::ShiftRight<8>(word), byte));
    hue = toLanes(hn::ShiftRight<24>(word)) / all(255.f);
    const float longest =
        plan.style.sibling == 0 ? RibbonForm::LONGEST : RibbonForm::LONGEST_SIBLING;
    const Lanes random = toLanes(hn::And(hn::ShiftRight<16>(word), byte)) / all(255.f);
    length = all(1.f) + all(plan.style.variety) *
                            (all(longest - 1.f) - all(RibbonForm::LENGTH_RANGE) * random);
  }
  Lanes lean_x, lean_y, length, hue;
};

// Blades of some hues are drier, of others bluer.
HWY_INLINE Lanes dryingOf(const RibbonPlan& plan, const LanesForm& form) {
  return all(plan.style.variety * RibbonForm::STRAW_DRY) *
         hn::Max(hn::Zero(Tag()), form.hue - all(RibbonForm::STRAW));
}

HWY_INLINE Lanes3 tinted(const RibbonPlan& plan, const LanesForm& form, const Lanes3& colour) {
  const Lanes cool =
      all(plan.style.variety) * hn::Max(hn::Zero(Tag()), all(RibbonForm::COOL) - form.hue);
  return {colour.x * (all(1.f) - all(RibbonForm::COOL_RED) * cool), colour.y,
          colour.z * (all(1.f) + all(RibbonForm::COOL_BLUE) * cool)};
}

HWY_INLINE Lanes3 ownColour(const RibbonPlan& plan, const LanesLook& look, const LanesCut& cut,
                            const LanesForm& form, Lanes u, Lanes v, Lanes chance) {
  const float variety = plan.style.variety;
  const Lanes pale = cut.is_cut * all(STUBBLE_PALENESS);
  Lanes dry = at(plan.colour, u, v) + all(variety) * (all(0.35f) * chance * chance - all(0.06f));
  if (plan.isVaried()) dry = dry + dryingOf(plan, form);
  Lanes3 colour = scaled(sum(look.fresh, scaled(look.drying, unitOf(dry + pale))),
                         all(1.f) + all(variety * 0.34f) * (chance - all(0.5f)));
  if (plan.isVaried()) colour = tinted(plan, form, colour);
  if (!plan.isMown()) return colour;
  return sum(colour, scaled(difference(all3(HAY), colour), cut.hidden));
}

// Replaces the radii of flowers by the sizes of what stands at the tips of varied blades.
HWY_INLINE void chooseTips(const RibbonPlan& plan, const BladeBlock& block, int lane,
                           RibbonRows& rows) {
  for (int i = lane; i < lane + static_cast<int>(hn::Lanes(Tag())); ++i) {
    // Lanes beyond the last blade may hold anything.
    const auto kind =
        std::min(static_cast<std::size_t>(std::max(0.f, rows.kind[i])), plan.looks.size() - 1);
    rows.flower[i] = tipSize(
        plan, {block.x[0][i], block.y[0][i], rows.length[i], rows.dice[i], static_cast<int>(kind)});
  }
}

// Computes the ribbons of the blades from `lane` of a block on. `blade` has their indices.
template <int SEGMENTS>
HWY_INLINE void ribbonLanes(const RibbonJob& job, const BladeBlock& block, Words blade, int lane,
                            RibbonRows& rows) {
  const RibbonPlan& plan = job.plan;
  const RibbonPattern& pattern = job.pattern;
  const Lanes zero = hn::Zero(Tag()), one = all(1.f), size = all(plan.tile.size);
  const Lanes x = hn::Load(Tag(), block.x[0] + lane), y = hn::Load(Tag(), block.y[0] + lane);
  const Lanes u = x / size, v = y / size;
  Lanes3 shift = all3(plan.corner);
  if (plan.style.slide > 0.0)
    shift = sum(shift, slideLanes(x, y, plan.tile.size, static_cast<float>(plan.style.slide)));
  const Words dice = mixLanes(hn::Xor(blade, hn::Set(WordTag(), plan.seed())));
  const LanesForm form(plan, dice);
  if (plan.style.sibling > 0) {
    const Lanes spread = all(static_cast<float>(plan.style.spread));
    const Lanes dx = spread * form.lean_x, dy = spread * form.lean_y;
    shift = sum(shift, {dx, dy, all(plan.slope_x) * dx + all(plan.slope_y) * dy});
  }
  const auto posed = [&](int k) HWY_ATTR {
    return Lanes3{hn::Load(Tag(), block.x[k] + lane), hn::Load(Tag(), block.y[k] + lane),
                  hn::Load(Tag(), block.z[k] + lane)};
  };
  const Lanes3 foot = posed(0), whole = difference(posed(LINKS), foot);
  const Lanes length =
      hn::Sqrt(whole.x * whole.x + whole.y * whole.y + whole.z * whole.z) * form.length;
  const Lanes lean = all(plan.style.variety * RibbonForm::LEAN) * length;
  const Lanes3 leaning{lean * form.lean_x, lean * form.lean_y, zero};
  const auto point = [&](int k) HWY_ATTR {
    if (!plan.isVaried()) return sum(posed(k), shift);
    const float way = static_cast<float>(k) / LINKS;
    const Lanes3 grown = sum(foot, scaled(difference(posed(k), foot), form.length));
    return sum(sum(grown, scaled(leaning, all(way * way))), shift);
  };
  const LanesLook look = lookLanes(plan, blade, u, v);
  const LanesCut cut = plan.isMown() ? cutLanes(plan, u, v) : LanesCut{zero, zero};
  LanesPiece piece;
  piece.root = point(0);
  const Lanes3 side =
      sideLanes(difference(point(LINKS), piece.root), difference(all3(plan.eye), piece.root));
  // Lightness and dryness vary, since blades of one colour look like plastic.
  const Lanes chance = toLanes(hn::And(dice, hn::Set(WordTag(), 0xffffU))) / all(65535.f);
  piece.facing = hn::Abs(toLanes(hn::ShiftRight<16>(dice)) * all(1.f / 32768.f) - one);
  piece.own = ownColour(plan, look, cut, form, u, v, chance);
  const Lanes3 own = piece.own;
  const auto left = toLanes(hn::Set(WordTag(), static_cast<std::uint32_t>(job.count)) - blade);
  const Lanes leaving = all(job.leaving);
  const Lanes width = hn::IfThenElse(left < leaving, left / leaving, one);
  const auto is_cut = cut.is_cut > zero;
  hn::Store(look.kind, Tag(), rows.kind + lane);
  hn::Store(length, Tag(), rows.length + lane);
  hn::Store(dice, WordTag(), rows.dice + lane);
  hn::Store(plan.hasTips() ? look.flower : zero, Tag(), rows.flower + lane);
  if (plan.hasTips() && plan.isVaried()) chooseTips(plan, block, lane, rows);
  const Lanes tip = hn::IfThenZeroElse(is_cut, hn::Load(Tag(), rows.flower + lane));
  hn::Store(width * tip, Tag(), rows.flower + lane);
  Lanes broad = width * look.half;
  if (plan.isVaried()) broad = hn::IfThenElse(tip == zero, broad, broad * all(RibbonForm::STEM));
  for (int k = 0; k <= SEGMENTS; ++k) {
    const float way = pattern.way[static_cast<std::size_t>(k)];
    piece.p = point(plan.kept[static_cast<std::size_t>(k)]);
    piece.way = hn::IfThenElse(is_cut, all(1.f - STUBBLE_SHADE * (1.f - way)), all(way));
    if (plan.isVaried()) {
      const Lanes bright =
          all(1.f) + all(plan.style.variety) *
                         (all(RibbonForm::TIP_BRIGHT) * piece.way - all(RibbonForm::ROOT_DARK));
      piece.own = scaled(own, bright);
    }
    const Words pixel =
        pixelLanes(plan.style.light ? litLanes(piece, job.light, plan.eye)
                                    : scaled(piece.own, all(0.45f) + all(0.55f) * piece.way));
    hn::Store(pixel, WordTag(), rows.colour[2 * k] + lane);
    if (k == SEGMENTS) {
      putPoint(piece.p, 2 * k, lane, rows);
      break;
    }
    const Lanes3 half = scaled(side, broad * all(1.f - way * way));
    putPoint(difference(piece.p, half), 2 * k, lane, rows);
    putPoint(sum(piece.p, half), 2 * k + 1, lane, rows);
    hn::Store(pixel, WordTag(), rows.colour[2 * k + 1] + lane);
  }
  hn::Store(side.x, Tag(), rows.side_x + lane);
  hn::Store(side.y, Tag(), rows.side_y + lane);
  hn::Store(side.z, Tag(), rows.side_z + lane);
}

// ---- writing -----------------------------------------------------------------------------------

// Writes numbers `row` to row + 3 of the blades from `lane` on behind the places of their ribbons.
#if HWY_TARGET == HWY_SCALAR
constexpr int BESIDE = 1;

template <class T>
HWY_INLINE void putQuad(const T (*rows)[BLOCK], int row, int lane, T* const* places) {
  for (int i = 0; i < QUAD; ++i)
    std::memcpy(places[lane] + row + i, rows[row + i] + lane, sizeof(T));
}
#else
constexpr int BESIDE = static_cast<int>(hn::MaxLanes(hn::CappedTag<float, 8>()));

// Writes blocks of four numbers in the order of the blades.
template <class D, class T = hn::TFromD<D>>
HWY_INLINE void storeBlocks(D tag, const hn::Vec<D> (&quad)[QUAD], int row, T* const* places) {
  if constexpr (BESIDE == QUAD) {
    for (int i = 0; i < QUAD; ++i) hn::StoreU(quad[i], tag, places[i] + row);
  } else {
    const hn::Half<D> half;
    for (int i = 0; i < QUAD; ++i) hn::StoreU(hn::LowerHalf(half, quad[i]), half, places[i] + row);
    for (int i = 0; i < QUAD; ++i)
      hn::StoreU(hn::UpperHalf(half, quad[i]), half, places[QUAD + i] + row);
  }
}

template <class T>
HWY_INLINE void putQuad(const T (*rows)[BLOCK], int row, int lane, T* const* places) {
  const hn::CappedTag<T, 8> tag;
  const hn::RepartitionToWide<hn::RebindToUnsigned<decltype(tag)>> pairs;
  const auto a = hn::Load(tag, rows[row] + lane), b = hn::Load(tag, rows[row + 1] + lane);
  const auto c = hn::Load(tag, rows[row + 2] + lane), d = hn::Load(tag, rows[row + 3] + lane);
  const auto ab_low = hn::BitCast(pairs, hn::InterleaveLower(tag, a, b));
  const auto ab_high = hn::BitCast(pairs, hn::InterleaveUpper(tag, a, b));
  const auto cd_low = hn::BitCast(pairs, hn::InterleaveLower(tag, c, d));
  const auto cd_high = hn::BitCast(pairs, hn::InterleaveUpper(tag, c, d));
  const hn::Vec<hn::CappedTag<T, 8>> quad[QUAD] = {
      hn::BitCast(tag, hn::InterleaveLower(pairs, ab_low, cd_low)),
      hn::BitCast(tag, hn::InterleaveUpper(pairs, ab_low, cd_low)),
      hn::BitCast(tag, hn::InterleaveLower(pairs, ab_high, cd_high)),
      hn::BitCast(tag, hn::InterleaveUpper(pairs, ab_high, cd_high))};
  storeBlocks(tag, quad, row, places + lane);
}
#endif

// Writes the rows of all blades. The last rows and the first blades come first: what they write too
// much is the begin of the next blade, or a flower, which are written later.
template <int COUNT, class T>
HWY_INLINE void putRows(const T (*rows)[BLOCK], T* const* places) {
  for (int lane = 0; lane < BLOCK; lane += BESIDE)
    for (int row = (COUNT - 1) / QUAD * QUAD; row >= 0; row -= QUAD)
      putQuad(rows, row, lane, places);
}

template <int COUNT, class T>
HWY_INLINE void copyPattern(const std::array<T, RibbonPattern::ROOM>& pattern, T offset, T* to) {
  const hn::CappedTag<T, 8> tag;
  const auto shift = hn::Set(tag, offset);
  for (int i = 0; i < COUNT; i += static_cast<int>(hn::Lanes(tag)))
    hn::StoreU(hn::Load(tag, pattern.data() + i) + shift, tag, to + i);
}

HWY_INLINE void skip(int vertices, int indices, MeshPlaces& out) {
  out.position += 3 * vertices, out.texture += 2 * vertices, out.colour += 4 * vertices;
  out.index += indices;
  out.next += static_cast<std::uint32_t>(vertices);
}

void putFlowers(const RibbonPlan& plan, const RibbonRows& rows, int segments, int valid,
                const MeshPlaces* flowers) {
  for (int lane = 0; lane < valid; ++lane) {
    if (rows.flower[lane] == 0.f) continue;
    const float(*tip)[BLOCK] = rows.position + 6 * segments;
    const float(*below)[BLOCK] = tip - 6;
    MeshPlaces place = flowers[lane];
    writeTip(plan, {tip[0][lane], tip[1][lane], tip[2][lane]},
             {below[0][lane], below[1][lane], below[2][lane]},
             {rows.side_x[lane], rows.side_y[lane], rows.side_z[lane]}, rows.flower[lane],
             rows.dice[lane], plan.looks[static_cast<std::size_t>(rows.kind[lane])], place);
  }
}

// Places in the mesh of the ribbons and flowers of one block.
struct BlockPlaces {
  float* position[BLOCK]{};
  std::uint32_t* colour[BLOCK]{};
  MeshPlaces flower[BLOCK]{};
};

// Writes a block, of which `valid` blades are drawn; the others are written too and not counted.
template <int SEGMENTS>
HWY_INLINE void putBlock(const RibbonJob& job, const RibbonRows& rows, int valid,
                         BlockPlaces& places, MeshPlaces& out) {
  constexpr int VERTICES = 2 * SEGMENTS + 1, INDICES = 3 * (2 * SEGMENTS - 1);
  MeshPlaces end = out;
  bool any = false;
  for (int lane = 0; lane < BLOCK; ++lane) {
    places.position[lane] = out.position;
    places.colour[lane] = reinterpret_cast<std::uint32_t*>(out.colour);
    copyPattern<2 * VERTICES>(job.pattern.texture, 0.f, out.texture);
    copyPattern<INDICES>(job.pattern.index, out.next, out.index);
    skip(VERTICES, INDICES, out);
    if (lane >= valid) continue;
    if (rows.flower[lane] != 0.f) {
      places.flower[lane] = out;
      any = true;
      skip(PETALS + 1, 3 * PETALS, out);
    }
    end = out;
  }
  putRows<3 * VERTICES>(rows.position, places.position);
  putRows<VERTICES>(rows.colour, places.colour);
  if (any) putFlowers(job.plan, rows, SEGMENTS, valid, places.flower);
  out = end;
}

template <int SEGMENTS>
HWY_INLINE MeshPlaces writeAll(const RibbonJob& job, const BladeBlock* blocks, MeshPlaces out) {
  const int step = static_cast<int>(hn::Lanes(Tag()));
  RibbonRows rows;
  BlockPlaces places;
  Words blade = hn::Iota(WordTag(), 0);
  for (int first = 0; first < job.count; first += BLOCK) {
    for (int lane = 0; lane < BLOCK; lane += step) {
      ribbonLanes<SEGMENTS>(job, blocks[first / BLOCK], blade, lane, rows);
      blade = blade + hn::Set(WordTag(), static_cast<std::uint32_t>(step));
    }
    putBlock<SEGMENTS>(job, rows, std::min(BLOCK, job.count - first), places, out);
  }
  return out;
}

MeshPlaces writeRibbons(const RibbonPlan& plan, const BladeBlock* blocks, int count,
                        MeshPlaces out) {
  const RibbonJob job(plan, count);
  switch (plan.segments()) {
    case 1:
      return writeAll<1>(job, blocks, out);
    case 2:
      return writeAll<2>(job, blocks, out);
    case 3:
      return writeAll<3>(job, blocks, out);
    default:
      return writeAll<LINKS>(job, blocks, out);
  }
}

}  // namespace vegetation_sim::grass::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace vegetation_sim::grass {

HWY_EXPORT(writeRibbons);

namespace {

// Returns room for so many more numbers, and for those that whole vectors write beyond them.
template <class T>
T* growRoom(MeshList<T>& list, std::size_t by) {
  constexpr std::size_t BEYOND = 32;
  const std::size_t before = list.size();
  list.resize(before + by + BEYOND);
  return list.data() + before;
}

template <class T>
void trimTo(const T* end, MeshList<T>& list) {
  list.resize(static_cast<std::size_t>(end - list.data()));
}

}  // namespace

void appendRibbons(const FeatureMap& map, const Tile& tile, const BladeBlock* blocks, int count,
                   const RibbonStyle& style, GrassMesh& mesh) {
  if (count <= 0) return;
  const RibbonPlan plan(map, tile, style, mesh.origin);
  const auto n = static_cast<std::size_t>(plan.segments());
  const auto blades = static_cast<std::size_t>(blocksFor(count) * BLOCK);
  const std::size_t flowers = plan.hasTips() ? blades : 0;
  const std::size_t vertices = blades * (2 * n + 1) + flowers * (PETALS + 1);
  const auto next = static_cast<std::uint32_t>(mesh.vertexCount());
  const MeshPlaces end = HWY_DYNAMIC_DISPATCH(writeRibbons)(
      plan, blocks, count,
      {growRoom(mesh.positions, 3 * vertices), growRoom(mesh.texture, 2 * vertices),
       growRoom(mesh.colours, 4 * vertices),
       growRoom(mesh.indices, 3 * (blades * (2 * n - 1) + flowers * PETALS)), next});
  trimTo(end.position, mesh.positions);
  trimTo(end.texture, mesh.texture);
  trimTo(end.colour, mesh.colours);
  trimTo(end.index, mesh.indices);
}

}  // namespace vegetation_sim::grass
#endif
