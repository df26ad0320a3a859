// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#include "sensors/model/hit_merging.h"

#include <algorithm>
#include <array>

namespace vegetation_sim::scan {
namespace {

// Dry soil, bark, bark, leaves, grass, clothes, the Fresnel reflectance of water, leaves, bark.
constexpr std::array<double, LABELS> REFLECTANCE{0.0,  0.25, 0.35, 0.35, 0.5,
                                                 0.45, 0.4,  0.02, 0.5,  0.35};

// Joins the hits of a range that is not empty.
Echo join(const Hit* first, const Hit* end, double rays) {
  if (end - first == 1) return {first->distance, signalOf(*first) / rays, *first};
  Echo out;
  double sum = 0.0, weighted = 0.0, strongest = -1.0;
  for (const Hit* hit = first; hit != end; ++hit) {
    const double signal = signalOf(*hit);
    sum += signal;
    weighted += signal * (hit->distance - first->distance);
    if (!(signal > strongest)) continue;
    strongest = signal;
    out.hit = *hit;
  }
  out.distance = first->distance + (sum > 0.0 ? weighted / sum : 0.0);
  out.signal = sum / rays;
  return out;
}

}  // namespace

double reflectanceOf(Label label) {
  return REFLECTANCE[static_cast<std::size_t>(label)];
}

double signalOf(const Hit& hit) {
  return reflectanceOf(hit.label) * hit.cosine;
}

void joinHits(std::vector<Hit>& hits, double separation, std::vector<Echo>& out) {
  out.clear();
  const auto rays = static_cast<double>(hits.size());
  const auto nothing = [](const Hit& hit) { return hit.label == Label::NONE; };
  hits.erase(std::remove_if(hits.begin(), hits.end(), nothing), hits.end());
  if (hits.size() > 1)
    std::stable_sort(hits.begin(), hits.end(),
                     [](const Hit& a, const Hit& b) { return a.distance < b.distance; });
  for (const Hit *hit = hits.data(), *last = hit + hits.size(); hit != last;) {
    const Hit* end = hit + 1;
    while (end != last && end->distance - (end - 1)->distance <= separation) ++end;
    out.push_back(join(hit, end, rays));
    hit = end;
  }
}

}  // namespace vegetation_sim::scan
