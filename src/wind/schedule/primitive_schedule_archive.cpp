// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
// The primitives and the followed frames of a wind as bytes.
#include "core/archive/archive.h"
#include "wind/field_archive.h"
#include "wind/limits.h"
#include "wind/schedule/attachment.h"
#include "wind/schedule/primitive_schedule.h"

namespace vegetation_sim::wind {
namespace {

constexpr std::size_t ENTRY_BYTES = 100, LONGEST_FRAME = 4096, MOST_SAMPLES = 16;

}  // namespace

void PrimitiveSchedule::archive(Archive& a) {
  std::uint64_t seed = field_.seed();
  Entries entries = entries_;
  std::uint32_t next_id = next_id_;
  a.key(seed);
  a.list("primitives", entries, MAX_PRIMITIVES, ENTRY_BYTES, [&a](Entry& entry) {
    wind::archive(a, entry.primitive);
    a.integer<Nanoseconds>("keep", entry.keep, 0, KEEP_EDITED);
  });
  a.integer<std::uint32_t>("next id", next_id, 1);
  if (!a.reads()) return;
  for (const Entry& entry : entries)
    if (entry.primitive.id >= next_id)
      Archive::reject("primitive id = " + std::to_string(entry.primitive.id),
                      "is not below the next id, " + std::to_string(next_id));
  field_ = Field({}, seed);
  replaceEntries(std::move(entries), next_id);
}

void Attachment::archive(Archive& a) {
  Faults faults;
  wind::archive(a, source_.primitive);
  a.text("attached frame", source_.attached_frame, LONGEST_FRAME);
  a.flag("has started", started_);
  std::vector<Waypoint> samples(samples_.begin(), samples_.end());
  a.list("samples", samples, MOST_SAMPLES, sizeof(Waypoint), [&a](Waypoint& sample) {
    a.stamp("sample stamp", sample.stamp);
    a.vector("sample position", sample.position);
  });
  if (!a.reads()) return;
  check(source_, faults);
  for (std::size_t i = 1; i < samples.size(); ++i)
    if (samples[i].stamp <= samples[i - 1].stamp) Archive::rejectOrder("samples", i);
  for (std::size_t i = 1; i < samples.size(); ++i)
    if (const double speed = levelSpeed(samples[i - 1], samples[i]); speed > BODY_SPEEDS.high)
      faults.add(rangeFault("speed to sample " + std::to_string(i), speed, "m/s", BODY_SPEEDS));
  faults.throwIfAny();
  samples_.assign(samples.begin(), samples.end());
}

}  // namespace vegetation_sim::wind
