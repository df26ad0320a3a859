// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#include "canopy/plane/fourier_passes.h"

#include <cstddef>
#include <utility>

// Vectors without arithmetic operators are not used; their processors run the plain target.
#define HWY_DISABLED_TARGETS (HWY_SVE | HWY_SVE2 | HWY_SVE_256 | HWY_SVE2_128 | HWY_RVV)
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "canopy/plane/fourier_passes.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

HWY_BEFORE_NAMESPACE();
namespace vegetation_sim::canopy::HWY_NAMESPACE {

namespace hn = hwy::HWY_NAMESPACE;
using Tag = hn::CappedTag<double, 8>;
using Lanes = hn::Vec<Tag>;

struct Complex {
  Lanes re, im;
};

HWY_INLINE Complex operator+(Complex a, Complex b) {
  return {a.re + b.re, a.im + b.im};
}
HWY_INLINE Complex operator-(Complex a, Complex b) {
  return {a.re - b.re, a.im - b.im};
}

// Rows of BLOCK numbers, real parts and imaginary parts.
struct Rows {
  double *re, *im;
  HWY_INLINE Complex get(int row, int lane) const {
    return {hn::LoadU(Tag(), re + row * BLOCK + lane), hn::LoadU(Tag(), im + row * BLOCK + lane)};
  }
  HWY_INLINE void set(int row, int lane, Complex value) const {
    hn::StoreU(value.re, Tag(), re + row * BLOCK + lane);
    hn::StoreU(value.im, Tag(), im + row * BLOCK + lane);
  }
};

struct Twiddle {
  Lanes cos, sin;
  HWY_INLINE Complex operator*(Complex z) const {
    return {z.re * cos - z.im * sin, z.re * sin + z.im * cos};
  }
};

HWY_INLINE Twiddle twiddleOf(const FourierPass& pass, int k) {
  return {hn::Set(Tag(), pass.cosine[k]), hn::Set(Tag(), pass.sine[k])};
}

// One radix-4 step of Stockham's transform, which needs no sorting (Van Loan 1992, section 1.7):
// `length` points at a distance of `stride` rows become four transforms of a quarter of the points.
HWY_INLINE void quarter(const FourierPass& pass, int length, int stride, Rows in, Rows out) {
  const int n = length / 4, turn = pass.size / length;
  for (int p = 0; p < n; ++p) {
    const Twiddle w1 = twiddleOf(pass, p * turn), w2 = twiddleOf(pass, 2 * p * turn),
                  w3 = twiddleOf(pass, 3 * p * turn);
    for (int q = 0; q < stride; ++q) {
      for (int lane = 0; lane < BLOCK; lane += static_cast<int>(hn::Lanes(Tag()))) {
        const Complex a = in.get(q + stride * p, lane), b = in.get(q + stride * (p + n), lane),
                      c = in.get(q + stride * (p + 2 * n), lane),
                      d = in.get(q + stride * (p + 3 * n), lane);
        const Complex sum = a + c, difference = a - c, other = b + d;
        const Complex turned{d.im - b.im, b.re - d.re};  // i (b - d)
        const int to = q + stride * 4 * p;
        out.set(to, lane, sum + other);
        out.set(to + stride, lane, w1 * (difference - turned));
        out.set(to + 2 * stride, lane, w2 * (sum - other));
        out.set(to + 3 * stride, lane, w3 * (difference + turned));
      }
    }
  }
}

HWY_INLINE void half(int stride, Rows in, Rows out) {
  for (int q = 0; q < stride; ++q) {
    for (int lane = 0; lane < BLOCK; lane += static_cast<int>(hn::Lanes(Tag()))) {
      const Complex a = in.get(q, lane), b = in.get(q + stride, lane);
      out.set(q, lane, a + b);
      out.set(q + stride, lane, a - b);
    }
  }
}

HWY_INLINE void load(const FourierPass& pass, int column, Rows rows) {
  for (int row = 0; row < pass.size; ++row) {
    for (int lane = 0; lane < BLOCK; ++lane) {
      rows.re[row * BLOCK + lane] = pass.re[row * pass.size + column + lane];
      rows.im[row * BLOCK + lane] = pass.im[row * pass.size + column + lane];
    }
  }
}

HWY_INLINE void store(const FourierPass& pass, int column, Rows rows) {
  const int across = pass.transposed ? pass.size : 1, down = pass.transposed ? 1 : pass.size;
  for (int lane = 0; lane < BLOCK; ++lane) {
    double* re = pass.out_re + (column + lane) * across;
    double* im = pass.out_im + (column + lane) * across;
    for (int row = 0; row < pass.size; ++row) {
      re[row * down] = rows.re[row * BLOCK + lane];
      im[row * down] = rows.im[row * BLOCK + lane];
    }
  }
}

void columns(const FourierPass& pass) {
  const std::ptrdiff_t part = static_cast<std::ptrdiff_t>(BLOCK) * pass.size;
  for (int column = 0; column < pass.size; column += BLOCK) {
    Rows in{pass.lanes, pass.lanes + part}, out{pass.lanes + 2 * part, pass.lanes + 3 * part};
    load(pass, column, in);
    int stride = 1;
    for (int length = pass.size; length > 1; stride *= 4, length /= 4) {
      if (length == 2)
        half(stride, in, out);
      else
        quarter(pass, length, stride, in, out);
      std::swap(in, out);
    }
    store(pass, column, in);
  }
}

}  // namespace vegetation_sim::canopy::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace vegetation_sim::canopy {

HWY_EXPORT(columns);

void transformColumns(const FourierPass& pass) {
  HWY_DYNAMIC_DISPATCH(columns)(pass);
}

}  // namespace vegetation_sim::canopy
#endif
