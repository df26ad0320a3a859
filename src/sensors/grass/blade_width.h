// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>

namespace vegetation_sim::scan {

/// Returns the mean remaining width at `way` along blades whose lengths are evenly distributed over
/// [least, most]. A blade has the width 1 - (way / length)^2 of its root's.
inline double widthAt(double way, double least, double most) {
  if (way >= most) return 0.0;
  const double from = std::max(least, way);
  if (most - least < 1e-6 * most) return 1.0 - way * way / (most * most);
  return ((most - from) - way * way * (1.0 / from - 1.0 / most)) / (most - least);
}

/// Returns the same mean after all blades that are longer than `cut` were cut to this length. Their
/// tips are drawn anew, so that a cut blade looks like one that has grown so long.
inline double widthAfterCut(double way, double least, double most, double cut) {
  if (cut >= most) return widthAt(way, least, most);
  if (cut <= least) return widthAt(way, cut, cut);
  const double shorter = (cut - least) / (most - least);
  return shorter * widthAt(way, least, cut) + (1.0 - shorter) * widthAt(way, cut, cut);
}

}  // namespace vegetation_sim::scan
