// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#include "rviz/textures/leaf_texture.h"

#include <algorithm>
#include <cmath>

#include "vegetation_sim/core/math/math.h"

namespace vegetation_sim::view {
namespace {

using forest::LeafShape;

constexpr Rgba TWIG{0.48f, 0.40f, 0.30f, 1.f};

struct Spot {
  float x, y;  // right and up; the foot is (0.5, 0), the edge at the tip is y = 1
};

// Returns half the width of a leaf of length 1 at t from its stalk (0) to its tip (1).
float halfWidth(LeafShape shape, bool bough, float t) {
  const float round = std::sin(static_cast<float>(PI) * std::pow(t, 0.85f));
  switch (shape) {
    case LeafShape::BROAD:  // lobed
      return 0.30f * round * (1.f + 0.22f * std::cos(4.5f * 2.f * static_cast<float>(PI) * t));
    case LeafShape::SMALL:  // widest near the stalk
      return 0.36f * std::sin(static_cast<float>(PI) * std::pow(t, 0.62f));
    case LeafShape::LONG:
      return 0.10f * round;
    case LeafShape::NEEDLE:
      break;
  }
  return (bough ? 0.1f : 0.055f) * (1.f - 0.6f * t);
}

class ClusterPainter {
 public:
  ClusterPainter(LeafShape shape, bool bough, int edge)
      : shape_(shape),
        bough_(bough),
        random_(0x1eaf + static_cast<std::uint64_t>(shape)),
        out_(2 * edge, 2 * edge, {0.8f, 0.8f, 0.8f, 0.f}) {}

  Image paint() {
    switch (shape_) {
      case LeafShape::BROAD:
        bough_ ? sprays(0.082f) : spray({0.5f, 0.f}, 0.f, 0.76f, 9, 7, 0.135f);
        break;
      case LeafShape::NEEDLE:
        bough_ ? needles(10, 0.07f, 55) : needles(6, 0.13f, 48);
        break;
      case LeafShape::SMALL:
        bough_ ? sprays(0.068f) : spray({0.5f, 0.f}, 0.f, 0.8f, 10, 7, 0.10f);
        break;
      case LeafShape::LONG:
        bough_ ? curtain() : strands();
        break;
    }
    return halved(out_);  // painting at twice the size smooths the edges
  }

 private:
  static Spot between(const Spot& a, const Spot& b, float f) {
    return {a.x + (b.x - a.x) * f, a.y + (b.y - a.y) * f};
  }

  float draw(float low, float high) {
    return static_cast<float>(random_.uniform(drawn_++, low, high));
  }

  // Paints side twigs along a stem and leaves along the side twigs; the last ones are in front.
  void spray(const Spot& foot, float lean, float stem, int twigs, int leaves, float leaf_length) {
    const Spot tip{foot.x + stem * std::sin(lean), foot.y + stem * std::cos(lean)};
    stroke(foot, tip, 0.008f * (bough_ ? 0.5f : 1.f));
    for (int i = 0; i < twigs; ++i) {
      const float up = 0.09f + 0.86f * static_cast<float>(i) / static_cast<float>(twigs - 1);
      const float angle =
          lean + (i % 2 == 0 ? 1.f : -1.f) * draw(0.55f, 1.f) * (1.25f - 0.63f * up);
      const float reach = 0.48f * stem * (1.f - 0.32f * up) * draw(0.85f, 1.1f);
      const Spot from = between(foot, tip, up);
      const Spot to{from.x + reach * std::sin(angle), from.y + reach * std::cos(angle)};
      stroke(from, to, 0.006f * (bough_ ? 0.5f : 1.f));
      for (int l = 0; l < leaves; ++l) {
        const float f = (static_cast<float>(l) + draw(0.3f, 1.f)) / static_cast<float>(leaves);
        const float turn = (l % 2 == 0 ? 1.f : -1.f) * draw(0.3f, 1.f);
        leaf(between(from, to, f), angle + turn, leaf_length * draw(0.75f, 1.1f));
      }
      leaf(to, angle, leaf_length);
    }
    for (int l = 0; l < 4; ++l)
      leaf(between(foot, tip, 0.96f), lean + draw(-0.8f, 0.8f), leaf_length * draw(0.8f, 1.f));
  }

  // Paints sprays on both sides of a stem and one at its end.
  void sprays(float leaf_length) {
    stroke({0.5f, 0.f}, {0.5f, 0.66f}, 0.007f);
    for (int i = 0; i < 9; ++i) {
      lightness_ = 0.55f + 0.05f * static_cast<float>(i);  // leaves behind are darker
      const float up = 0.04f + 0.07f * static_cast<float>(i);
      const float angle = (i % 2 == 0 ? 1.f : -1.f) * draw(0.6f, 1.15f) * (1.2f - 0.7f * up);
      spray({0.5f, up}, angle, draw(0.32f, 0.5f) * (1.f - 0.3f * up), 6, 4, leaf_length);
    }
    spray({0.5f, 0.55f}, 0.f, 0.34f, 7, 4, leaf_length);
  }

  void needles(int twigs, float length, int count) {
    const float thick = bough_ ? 0.5f : 1.f;
    stroke({0.5f, 0.f}, {0.5f, 0.88f}, 0.011f * thick);
    tufts({0.5f, 0.04f}, {0.5f, 0.88f}, 0.f, 3 * count / 2, length);
    for (int i = 0; i < twigs; ++i) {
      const float up = 0.06f + 0.66f * static_cast<float>(i) / static_cast<float>(twigs);
      const float angle = (i % 2 == 0 ? 1.f : -1.f) * draw(0.75f, 1.f);
      const float reach = 0.46f - 0.48f * up * up;
      const Spot from{0.5f, up};
      const Spot to{from.x + reach * std::sin(angle), from.y + reach * std::cos(angle)};
      stroke(from, to, 0.008f * thick);
      if (bough_) lightness_ = 0.6f + 0.04f * static_cast<float>(i);
      tufts(from, to, angle, count, length);
      if (!bough_) continue;
      for (const float side : {0.6f, -0.6f}) {
        const Spot fork = between(from, to, 0.4f);
        const float own = 0.45f * reach;
        const Spot end{fork.x + own * std::sin(angle + side),
                       fork.y + own * std::cos(angle + side)};
        tufts(fork, end, angle + side, count / 2, length);
      }
    }
  }

  void tufts(const Spot& from, const Spot& to, float angle, int count, float length) {
    for (int i = 0; i < count; ++i) {
      const float f = (static_cast<float>(i) + draw(0.f, 1.f)) / static_cast<float>(count);
      const float turn = (i % 2 == 0 ? 1.f : -1.f) * draw(0.35f, 0.95f) * (1.f - 0.6f * f * f);
      leaf(between(from, to, f), angle + turn, length * draw(0.75f, 1.2f));
    }
  }

  void strands() {
    constexpr std::array<float, 5> LEANS{0.42f, -0.40f, 0.2f, -0.2f, 0.f};
    for (std::size_t i = 0; i < LEANS.size(); ++i) {
      lightness_ = 0.72f + 0.07f * static_cast<float>(i);
      strand({0.5f, 0.f}, LEANS[i], 0.62f + 0.06f * static_cast<float>(i), 14);
    }
  }

  // Paints many strands side by side that hang from the edge of the foot.
  void curtain() {
    for (int i = 0; i < 13; ++i) {
      lightness_ = 0.6f + 0.033f * static_cast<float>(i);
      const float foot = 0.06f + 0.88f * (static_cast<float>((5 * i) % 13) + 0.5f) / 13.f;
      strand({foot, draw(0.f, 0.16f)}, draw(-0.08f, 0.08f), draw(0.6f, 0.84f), 22);
    }
  }

  void strand(const Spot& foot, float angle, float reach, int steps) {
    Spot at = foot;
    const float step = reach / static_cast<float>(steps);
    for (int i = 0; i < steps; ++i) {
      const Spot next{at.x + step * std::sin(angle), at.y + step * std::cos(angle)};
      stroke(at, next, 0.005f);
      for (const float side : {1.f, -1.f})
        leaf(next, angle + side * draw(0.25f, 0.7f),
             std::min(draw(0.2f, 0.3f) * (bough_ ? 0.42f : 0.68f), 1.f - next.y));
      angle += draw(-0.1f, 0.1f) - 0.04f * angle;
      at = next;
    }
  }

  void stroke(const Spot& from, const Spot& to, float width) {
    const float dx = to.x - from.x, dy = to.y - from.y;
    const float long2 = std::max(dx * dx + dy * dy, 1e-9f);
    forBox(std::min(from.x, to.x) - width, std::max(from.x, to.x) + width,
           std::min(from.y, to.y) - width, std::max(from.y, to.y) + width,
           [&](float x, float y, int c, int r) {
             const float f = std::clamp(((x - from.x) * dx + (y - from.y) * dy) / long2, 0.f, 1.f);
             if (std::hypot(x - from.x - f * dx, y - from.y - f * dy) < width)
               out_.blend(c, r, TWIG);
           });
  }

  void leaf(const Spot& stalk, float angle, float size) {
    const float ax = std::sin(angle), ay = std::cos(angle);
    const float light = lightness_ * draw(0.68f, 1.f), tilt = draw(-0.12f, 0.12f);
    const float warm = draw(-0.04f, 0.04f);
    forBox(stalk.x - size, stalk.x + size, stalk.y - size, stalk.y + size,
           [&](float x, float y, int c, int r) {
             const float t = ((x - stalk.x) * ax + (y - stalk.y) * ay) / size;
             const float s = ((x - stalk.x) * ay - (y - stalk.y) * ax) / size;
             if (t < 0.f || t > 1.f) return;
             const float half = halfWidth(shape_, bough_, t);
             if (std::fabs(s) > half) return;
             // The halves face the light differently; the midrib is pale, the stalk dark.
             float value = light * (0.86f + 0.14f * t) + (s > 0.f ? tilt : -tilt);
             if (shape_ != LeafShape::NEEDLE && std::fabs(s) < 0.022f) value += 0.1f;
             out_.blend(c, r, {value * (1.f + warm), value, value * (1.f - warm), 1.f});
           });
  }

  // Calls draw(x, y, column, row) for each pixel of a box in image units.
  template <class Draw>
  void forBox(float left, float right, float low, float high, const Draw& draw) {
    const auto n = static_cast<float>(out_.columns);
    const int c1 = std::min(out_.columns - 1, static_cast<int>(right * n));
    const int r1 = std::min(out_.rows - 1, static_cast<int>((1.f - low) * n));
    for (int r = std::max(0, static_cast<int>((1.f - high) * n)); r <= r1; ++r)
      for (int c = std::max(0, static_cast<int>(left * n)); c <= c1; ++c)
        draw((static_cast<float>(c) + 0.5f) / n, 1.f - (static_cast<float>(r) + 0.5f) / n, c, r);
  }

  LeafShape shape_;
  bool bough_;
  Random random_;
  std::uint64_t drawn_{0};
  float lightness_{1.f};  // of the current leaves
  Image out_;
};

}  // namespace

Image leafPicture(forest::LeafShape shape, bool bough, int edge) {
  return ClusterPainter(shape, bough, edge).paint();
}

double coverage(const Image& picture) {
  const auto passes = [](const Rgba& pixel) { return pixel[3] >= ALPHA_LIMIT; };
  return static_cast<double>(std::count_if(picture.pixels.begin(), picture.pixels.end(), passes)) /
         static_cast<double>(picture.pixels.size());
}

}  // namespace vegetation_sim::view
