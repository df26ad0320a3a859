// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#include "wind/schedule/primitive_schedule.h"

#include <algorithm>
#include <set>

#include "wind/limits.h"

namespace vegetation_sim::wind {
namespace {

bool endsBy(const Primitive& p, Nanoseconds stamp) {
  return p.t_off != 0 && p.t_off <= stamp;
}

/// Fades `p` out from `stamp` on over `duration` [s], unless it fades out by then already.
void end(Primitive& p, Nanoseconds stamp, double duration) {
  if (p.t_off != 0 && p.t_off - fromSeconds(p.fade_out) < stamp) return;
  p.fade_out = duration;
  p.t_off = stamp + fromSeconds(duration);
}

std::string seconds(Nanoseconds stamp) {
  return std::to_string(secondsBetween(0, stamp)) + " s";
}

}  // namespace

void PrimitiveSchedule::replaceEntries(Entries entries, std::uint32_t next_id) {
  std::vector<Primitive> primitives;
  for (const Entry& entry : entries) primitives.push_back(entry.primitive);
  field_ = Field(std::move(primitives), field_.seed());
  entries_ = std::move(entries);
  next_id_ = next_id;
}

void PrimitiveSchedule::start(const std::vector<Primitive>& primitives) {
  Entries entries = entries_;
  std::uint32_t id = next_id_;
  for (Primitive p : primitives) {
    if (latest(entries, p.name) != nullptr)
      throw InvalidInput("primitive " + inQuotes(p.name) + ": name is already in use");
    p.id = id++;
    entries.push_back({p, KEEP_EDITED});
  }
  replaceEntries(std::move(entries), id);
}

PrimitiveSchedule::Entry* PrimitiveSchedule::latest(Entries& entries, const std::string& name) {
  Entry* found = nullptr;
  for (Entry& entry : entries)
    if (entry.primitive.name == name &&
        (found == nullptr || entry.primitive.t_on >= found->primitive.t_on))
      found = &entry;
  return found;
}

void PrimitiveSchedule::dropPending(Entries& entries, const std::string& name,
                                    Nanoseconds earliest) {
  const auto pending = [&](const Entry& entry) {
    return entry.primitive.name == name && entry.primitive.t_on >= earliest;
  };
  entries.erase(std::remove_if(entries.begin(), entries.end(), pending), entries.end());
}

Primitive PrimitiveSchedule::set(Primitive p, Nanoseconds earliest) {
  return put(std::move(p), earliest, Change::EDIT);
}

Primitive PrimitiveSchedule::follow(Primitive p, Nanoseconds earliest) {
  return put(std::move(p), earliest, Change::PIECE);
}

Nanoseconds PrimitiveSchedule::freeFrom(const Primitive& old, Nanoseconds wanted, Faults& faults) {
  const Nanoseconds begin = std::max(wanted, old.t_on + fromSeconds(old.fade_in));
  if (begin - wanted > LONGEST_WAIT)
    faults.add("primitive " + inQuotes(old.name) + " is still fading in until " + seconds(begin) +
               "; an edit waits for that at most " + seconds(LONGEST_WAIT));
  return begin;
}

Primitive PrimitiveSchedule::put(Primitive p, Nanoseconds earliest, Change change) {
  Faults faults;
  if (p.t_on != 0 && p.t_on < earliest)
    faults.add("primitive " + inQuotes(p.name) + ": t_on = " + seconds(p.t_on) + " is before " +
               seconds(earliest) + ", the earliest stamp that all subscribers can receive in time");
  if (p.t_on == 0) p.t_on = earliest;
  check(p, faults);
  faults.throwIfAny();

  Entries entries = entries_;
  dropPending(entries, p.name, p.t_on);
  Entry* before = latest(entries, p.name);
  std::optional<Nanoseconds> default_epoch;
  if (before != nullptr && !endsBy(before->primitive, p.t_on)) {
    Primitive& old = before->primitive;
    p.t_on = freeFrom(old, p.t_on, faults);
    faults.throwIfAny();
    if (change == Change::EDIT) p.fade_in = std::max(p.fade_in, old.fade_out);
    end(old, p.t_on, p.fade_in);
    if (p.kind == old.kind) default_epoch = old.epoch;
  }
  if (p.epoch == 0) p.epoch = default_epoch.value_or(p.t_on);
  p.id = next_id_;
  entries.push_back({p, change == Change::EDIT ? KEEP_EDITED : KEEP_PIECES});
  replaceEntries(std::move(entries), next_id_ + 1);
  return p;
}

void PrimitiveSchedule::remove(const std::string& name, Nanoseconds earliest) {
  if (!find(name, earliest)) {
    std::string known;
    for (const std::string& other : names(earliest)) known += (known.empty() ? "" : ", ") + other;
    throw InvalidInput("no source is named " + inQuotes(name) +
                           "; known sources: " + (known.empty() ? "none" : known),
                       FaultCode::UNKNOWN);
  }
  Entries entries = entries_;
  dropPending(entries, name, earliest);
  for (Entry& entry : entries)
    if (entry.primitive.name == name) end(entry.primitive, earliest, entry.primitive.fade_out);
  replaceEntries(std::move(entries), next_id_);
}

bool PrimitiveSchedule::prune(Nanoseconds now) {
  const auto forgotten = [&](const Entry& entry) {
    const Nanoseconds t_off = entry.primitive.t_off;
    return t_off != 0 && t_off < now - entry.keep;
  };
  Entries entries = entries_;
  entries.erase(std::remove_if(entries.begin(), entries.end(), forgotten), entries.end());
  if (entries.size() == entries_.size()) return false;
  replaceEntries(std::move(entries), next_id_);
  return true;
}

std::vector<std::string> PrimitiveSchedule::names(Nanoseconds stamp) const {
  std::vector<std::string> names;
  for (const Entry& entry : entries_) {
    const Primitive& p = entry.primitive;
    if (!endsBy(p, stamp) && std::find(names.begin(), names.end(), p.name) == names.end())
      names.push_back(p.name);
  }
  return names;
}

std::optional<Primitive> PrimitiveSchedule::find(const std::string& name, Nanoseconds stamp) const {
  std::optional<Primitive> found;
  for (const Entry& entry : entries_) {
    const Primitive& p = entry.primitive;
    if (p.name == name && !endsBy(p, stamp) && (!found || p.t_on >= found->t_on)) found = p;
  }
  return found;
}

}  // namespace vegetation_sim::wind
