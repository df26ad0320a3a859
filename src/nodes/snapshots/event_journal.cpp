// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#include "nodes/snapshots/event_journal.h"

#include <fcntl.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <optional>

#include "nodes/snapshots/snapshot_store.h"
#include "vegetation_sim/core/math/hash.h"

namespace vegetation_sim {
namespace {

constexpr std::size_t LARGEST_INPUT = LARGEST_SNAPSHOT / 2;
constexpr std::size_t MOST_EVENTS = 1u << 16;  // of a tick
constexpr std::size_t LENGTH_BYTES = 4, SUM_BYTES = 8;

std::uint64_t checksumOf(const std::string& bytes) {
  Hash hash;
  hash.add(bytes);
  return hash.value();
}

void archive(Archive& a, JournalTick& tick) {
  a.stamp("tick", tick.stamp);
  vegetation_sim::archive(a, tick.events);
}

// A record is the length of a tick, the tick and a checksum.
std::optional<JournalTick> readRecord(const std::string& bytes, std::size_t& at) {
  if (bytes.size() - at < LENGTH_BYTES) return std::nullopt;
  std::uint32_t length = 0;
  Archive head = Archive::reading(bytes.substr(at, LENGTH_BYTES));
  head.integer("length", length);
  if (bytes.size() - at - LENGTH_BYTES < length + SUM_BYTES) return std::nullopt;
  const std::string body = bytes.substr(at + LENGTH_BYTES, length);
  std::uint64_t sum = 0;
  Archive end = Archive::reading(bytes.substr(at + LENGTH_BYTES + length, SUM_BYTES));
  end.key(sum);
  if (sum != checksumOf(body)) return std::nullopt;
  at += LENGTH_BYTES + length + SUM_BYTES;
  Archive a = Archive::reading(body);
  JournalTick out;
  archive(a, out);
  a.finish();
  return out;
}

}  // namespace

void archive(Archive& a, std::vector<StoredEvent>& events) {
  a.list("events", events, MOST_EVENTS, 2 * sizeof(std::uint32_t), [&a](StoredEvent& event) {
    a.text("event", event.message, LARGEST_INPUT);
    a.text("input of an event", event.input, LARGEST_INPUT);
  });
}

EventJournal::~EventJournal() {
  close();
}

void EventJournal::close() {
  if (number_ >= 0) ::close(number_);
  number_ = -1;
}

void EventJournal::restart() {
  close();
  number_ = ::open(file_.c_str(), O_WRONLY | O_CREAT | O_TRUNC | O_APPEND | O_CLOEXEC, 0644);
  if (number_ < 0) throw InvalidInput(file_ + ": cannot be written: " + std::strerror(errno));
}

void EventJournal::add(JournalTick tick) {
  if (number_ < 0) return;
  Archive body, head, end;
  archive(body, tick);
  auto length = static_cast<std::uint32_t>(body.bytes().size());
  std::uint64_t sum = checksumOf(body.bytes());
  head.integer("length", length);
  end.key(sum);
  const std::string record = head.bytes() + body.bytes() + end.bytes();
  for (std::size_t at = 0; at < record.size();) {
    const ssize_t written = ::write(number_, record.data() + at, record.size() - at);
    if (written < 0 && errno == EINTR) continue;
    if (written < 0) {
      const std::string why = std::strerror(errno);
      close();  // what follows would not continue the ticks
      throw InvalidInput(file_ + ": cannot be written: " + why);
    }
    at += static_cast<std::size_t>(written);
  }
}

std::vector<JournalTick> EventJournal::read(Nanoseconds after) const {
  std::vector<JournalTick> out;
  const std::optional<std::string> bytes = contentOf(file_, LARGEST_SNAPSHOT);
  for (std::size_t at = 0; bytes;) {
    std::optional<JournalTick> tick = readRecord(*bytes, at);
    if (!tick) break;
    if (tick->stamp > after) out.push_back(std::move(*tick));
  }
  return out;
}

}  // namespace vegetation_sim
