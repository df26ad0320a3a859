// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#include "reference/grass/ribbons_plain.h"

#include "grass/mesh/ribbon_plan.h"

namespace vegetation_sim::grass {
namespace {

// Returns the unit vector across `along` that turns a ribbon's face to the viewer.
Float3 sideOf(const Float3& along, const Float3& view) {
  const Float3 c{along.y * view.z - along.z * view.y, along.z * view.x - along.x * view.z,
                 along.x * view.y - along.y * view.x};
  const float square = c.x * c.x + c.y * c.y + c.z * c.z;
  return square > 1e-20f ? c * (1.f / std::sqrt(square)) : Float3{1.f, 0.f, 0.f};
}

// Returns the vector from a root at (x, y) of its tile to the nearest edge.
Float3 wayToEdge(float x, float y, float size) {
  const float east = size - x, north = size - y, least = std::min({x, east, y, north});
  if (x == least) return {-x, 0.f, 0.f};
  if (east == least) return {east, 0.f, 0.f};
  return {0.f, y == least ? -y : north, 0.f};
}

template <class T>
T* grow(MeshList<T>& list, std::size_t by) {
  list.resize(list.size() + by);
  return list.data() + (list.size() - by);
}

/// All blades of a tile.
class Ribbons {
 public:
  Ribbons(const FeatureMap& map, const Tile& tile, const RibbonStyle& style, const Vec3& origin)
      : plan_(map, tile, style, origin) {}

  void append(const BladeBlock* blocks, int count, GrassMesh& mesh) {
    const auto n = static_cast<std::size_t>(plan_.style.segments);
    kinds_.resize(static_cast<std::size_t>(count));
    flowers_.resize(static_cast<std::size_t>(count));
    std::size_t flowers = 0;
    for (int blade = 0; blade < count; ++blade) {
      const int kind = kindOf(blocks[blade / BLOCK], blade);
      kinds_[static_cast<std::size_t>(blade)] = kind;
      const bool none = !plan_.hasTips() || cutAt(blocks[blade / BLOCK], blade).is_cut;
      flowers_[static_cast<std::size_t>(blade)] =
          none ? 0.f : tipOf(blocks[blade / BLOCK], blade, kind);
      flowers += flowers_[static_cast<std::size_t>(blade)] != 0.f ? 1 : 0;
    }
    const auto blades = static_cast<std::size_t>(count);
    const std::size_t vertices = blades * (2 * n + 1) + flowers * (PETALS + 1);
    const auto first = static_cast<std::uint32_t>(mesh.vertexCount());
    MeshPlaces out{grow(mesh.positions, 3 * vertices), grow(mesh.texture, 2 * vertices),
                   grow(mesh.colours, 4 * vertices),
                   grow(mesh.indices, 3 * (blades * (2 * n - 1) + flowers * PETALS)), first};
    const auto leaving = static_cast<float>(plan_.style.leaving * count);
    for (int blade = 0; blade < count; ++blade) {
      const auto left = static_cast<float>(count - blade);
      write(blocks[blade / BLOCK], blade, left < leaving ? left / leaving : 1.f, out);
    }
  }

 private:
  // Numbers of a varied blade: RibbonForm.
  struct Form {
    float lean_x, lean_y, length, hue;
  };
  Form formOf(std::uint32_t dice) const {
    const std::uint32_t word = mix32(dice + WORD_STEP);
    const auto centred = [](std::uint32_t bits) {
      return static_cast<float>(bits & 0xff) / 127.5f - 1.f;
    };
    const float longest =
        plan_.style.sibling == 0 ? RibbonForm::LONGEST : RibbonForm::LONGEST_SIBLING;
    const float random = static_cast<float>(word >> 16 & 0xff) / 255.f;
    return {centred(word), centred(word >> 8),
            1.f + plan_.style.variety * ((longest - 1.f) - RibbonForm::LENGTH_RANGE * random),
            static_cast<float>(word >> 24) / 255.f};
  }

  std::uint32_t diceOf(int blade) const {
    return mix32(static_cast<std::uint32_t>(blade) ^ plan_.seed());
  }

  float lengthOf(const BladeBlock& block, int lane, const Form& form) const {
    const Float3 foot{block.x[0][lane], block.y[0][lane], block.z[0][lane]};
    const Float3 whole =
        Float3{block.x[LINKS][lane], block.y[LINKS][lane], block.z[LINKS][lane]} - foot;
    return std::sqrt(whole.x * whole.x + whole.y * whole.y + whole.z * whole.z) * form.length;
  }

  float tipOf(const BladeBlock& block, int blade, int kind) const {
    if (!plan_.isVaried()) return plan_.looks[static_cast<std::size_t>(kind)].flower;
    const int lane = blade % BLOCK;
    const std::uint32_t dice = diceOf(blade);
    return tipSize(plan_, {block.x[0][lane], block.y[0][lane], lengthOf(block, lane, formOf(dice)),
                           dice, kind});
  }

  struct Cut {
    bool is_cut;
    float hidden;  ///< share that is below cut grass
  };

  int kindOf(const BladeBlock& block, int blade) const {
    const TilePlan<float>& plan = plan_.plan;
    if (!plan.mixed) return 0;
    const int lane = blade % BLOCK;
    const Tile& tile = plan_.tile;
    const float u = block.x[0][lane] / tile.size, v = block.y[0][lane] / tile.size;
    const auto last = static_cast<std::size_t>(tile.species_count - 1);
    const float aim = BladeRandom<float>(tile.key, blade).kind() * plan.shares[last].at(u, v);
    int kind = 0;
    for (std::size_t s = 1; s <= last; ++s)
      if (aim > plan.shares[s - 1].at(u, v)) kind = static_cast<int>(s);
    return kind;
  }

  Cut cutAt(const BladeBlock& block, int blade) const {
    if (!plan_.isMown()) return {false, 0.f};
    const CrushPatch& crush = *plan_.style.crush;
    const int lane = blade % BLOCK;
    const std::size_t node =
        crush.nearest(block.x[0][lane] / plan_.tile.size, block.y[0][lane] / plan_.tile.size);
    const float swath = crush.swath[node];
    return {crush.cut[node] < UNCUT, swath / (swath + HALF_HIDDEN)};
  }

  void write(const BladeBlock& block, int blade, float width, MeshPlaces& out) const {
    const int lane = blade % BLOCK;
    const Tile& tile = plan_.tile;
    const RibbonStyle& style = plan_.style;
    const float x = block.x[0][lane], y = block.y[0][lane];
    Float3 shift = plan_.corner;
    if (style.slide > 0.0)
      shift = shift + wayToEdge(x, y, tile.size) * static_cast<float>(style.slide);
    const std::uint32_t dice = diceOf(blade);
    const Form form = formOf(dice);
    if (style.sibling > 0) {
      const auto spread = static_cast<float>(style.spread);
      const float dx = spread * form.lean_x, dy = spread * form.lean_y;
      shift = shift + Float3{dx, dy, plan_.slope_x * dx + plan_.slope_y * dy};
    }
    const auto posed = [&](int k) {
      const auto i = static_cast<std::size_t>(k);
      return Float3{block.x[i][lane], block.y[i][lane], block.z[i][lane]};
    };
    const Float3 foot = posed(0);
    const float lean = style.variety * RibbonForm::LEAN * lengthOf(block, lane, form);
    const Float3 leaning{lean * form.lean_x, lean * form.lean_y, 0.f};
    const auto point = [&](int k) {
      if (!plan_.isVaried()) return posed(k) + shift;
      const float along = static_cast<float>(k) / LINKS;
      return foot + (posed(k) - foot) * form.length + leaning * (along * along) + shift;
    };
    const RibbonLook& look =
        plan_.looks[static_cast<std::size_t>(kinds_[static_cast<std::size_t>(blade)])];
    const Float3 root = point(0), tip = point(LINKS);
    const Float3 side = sideOf(tip - root, plan_.eye - root);
    // Lightness and dryness vary, since blades of one colour look like plastic.
    const float chance = static_cast<float>(dice & 0xffff) / 65535.f;
    const float facing = std::fabs(static_cast<float>(dice >> 16) / 32768.f - 1.f);
    const Cut cut = cutAt(block, blade);
    const float pale = cut.is_cut ? STUBBLE_PALENESS : 0.f;
    float dry = plan_.colour.at(x / tile.size, y / tile.size) +
                style.variety * (0.35f * chance * chance - 0.06f);
    if (plan_.isVaried())
      dry =
          dry + style.variety * RibbonForm::STRAW_DRY * std::max(0.f, form.hue - RibbonForm::STRAW);
    Float3 own = (look.fresh + look.drying * std::min(1.f, std::max(0.f, dry + pale))) *
                 (1.f + style.variety * 0.34f * (chance - 0.5f));
    if (plan_.isVaried()) {
      const float cool = style.variety * std::max(0.f, RibbonForm::COOL - form.hue);
      own = {own.x * (1.f - RibbonForm::COOL_RED * cool), own.y,
             own.z * (1.f + RibbonForm::COOL_BLUE * cool)};
    }
    own = own + (HAY - own) * cut.hidden;
    const float radius = flowers_[static_cast<std::size_t>(blade)];
    float broad = width * look.half;
    if (plan_.isVaried() && radius != 0.f) broad = broad * RibbonForm::STEM;
    const std::uint32_t first = out.next;
    for (int k = 0; k <= style.segments; ++k) {
      const int at = plan_.kept[static_cast<std::size_t>(k)];
      const float way = static_cast<float>(at) / LINKS, half = broad * (1.f - way * way);
      const Float3 p = point(at);
      const float lit_way = cut.is_cut ? 1.f - STUBBLE_SHADE * (1.f - way) : way;
      const float bright =
          1.f + style.variety * (RibbonForm::TIP_BRIGHT * lit_way - RibbonForm::ROOT_DARK);
      const Float3 c =
          shadeRibbon(plan_, plan_.isVaried() ? own * bright : own, p, root, lit_way, facing);
      if (k == style.segments) {
        out.vertex(p, 0.5f, 1.f, c);
        break;
      }
      out.vertex(p - side * half, 0.f, way, c);
      out.vertex(p + side * half, 1.f, way, c);
    }
    for (std::uint32_t t = 0; t + 1 < 2 * static_cast<std::uint32_t>(style.segments); ++t)
      out.triangle(first + t, first + t + 1, first + t + 2);
    const float last =
        static_cast<float>(plan_.kept[static_cast<std::size_t>(style.segments - 1)]) / LINKS;
    const Float3 below = point(plan_.kept[static_cast<std::size_t>(style.segments - 1)]) -
                         side * (broad * (1.f - last * last));
    if (radius != 0.f) writeTip(plan_, tip, below, side, width * radius, dice, look, out);
  }

  RibbonPlan plan_;
  std::vector<int> kinds_;      ///< species of each blade
  std::vector<float> flowers_;  ///< radius of the flower of each blade, 0: none [m]
};

}  // namespace

void appendRibbonsPlain(const FeatureMap& map, const Tile& tile, const BladeBlock* blocks,
                        int count, const RibbonStyle& style, GrassMesh& mesh) {
  if (count > 0) Ribbons(map, tile, style, mesh.origin).append(blocks, count, mesh);
}

}  // namespace vegetation_sim::grass
