// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#include "nodes/snapshots/event_journal.h"

#include <fcntl.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <optional>

#include "nodes/snapshots/snapshot_folder.h"
#include "vegetation_sim/core/math/hash.h"

namespace vegetation_sim {
namespace {

constexpr std::size_t LARGEST_INPUT = LARGEST_SNAPSHOT / 2;
constexpr std::size_t MOST_EVENTS = 1u << 16;  // of a tick
constexpr std::size_t KEY_BYTES = 8, LENGTH_BYTES = 4, SUM_BYTES = 8;

std::uint64_t checksumOf(const std::string& bytes) {
  Hash hash;
  hash.add(bytes);
  return hash.value();
}

void archive(Archive& a, JournalRecord& record) {
  a.stamp("tick", record.stamp);
  vegetation_sim::archive(a, record.events);
}

// In the file, a record has its length before it and a checksum after it.
std::optional<JournalRecord> readRecord(const std::string& bytes, std::size_t& at) {
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
  JournalRecord out;
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
  size_ = 0;
}

void EventJournal::restart(std::uint64_t checkpoint) {
  close();
  number_ = ::open(file_.c_str(), O_WRONLY | O_CREAT | O_TRUNC | O_APPEND | O_CLOEXEC, 0644);
  if (number_ < 0) throw InvalidInput(file_ + ": cannot be written: " + std::strerror(errno));
  Archive head;
  head.key(checkpoint);
  write(head.bytes());
}

void EventJournal::add(JournalRecord record) {
  if (number_ < 0) return;
  Archive body, head, end;
  archive(body, record);
  auto length = static_cast<std::uint32_t>(body.bytes().size());
  std::uint64_t sum = checksumOf(body.bytes());
  head.integer("length", length);
  end.key(sum);
  write(head.bytes() + body.bytes() + end.bytes());
}

void EventJournal::write(const std::string& bytes) {
  for (std::size_t at = 0; at < bytes.size();) {
    const ssize_t written = ::write(number_, bytes.data() + at, bytes.size() - at);
    if (written < 0 && errno == EINTR) continue;
    if (written < 0) {
      const std::string why = std::strerror(errno);
      close();  // what follows would not continue the records
      throw InvalidInput(file_ + ": cannot be written: " + why);
    }
    at += static_cast<std::size_t>(written);
  }
  size_ += bytes.size();
}

std::vector<JournalRecord> readRecords(const std::string& bytes, std::uint64_t checkpoint) {
  std::vector<JournalRecord> out;
  if (bytes.size() < KEY_BYTES) return out;
  std::uint64_t found = 0;
  Archive head = Archive::reading(bytes.substr(0, KEY_BYTES));
  head.key(found);
  if (found != checkpoint) return out;
  for (std::size_t at = KEY_BYTES;;) {
    std::optional<JournalRecord> record = readRecord(bytes, at);
    if (!record) return out;
    out.push_back(std::move(*record));
  }
}

std::vector<JournalRecord> EventJournal::read(std::uint64_t checkpoint) const {
  const std::optional<std::string> bytes = contentOf(file_, LARGEST_SNAPSHOT);
  return bytes ? readRecords(*bytes, checkpoint) : std::vector<JournalRecord>();
}

}  // namespace vegetation_sim
