// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#include "core/archive/archive.h"

#include <cmath>
#include <cstring>

namespace vegetation_sim {
namespace {

constexpr Range FINITE{std::numeric_limits<double>::lowest(), std::numeric_limits<double>::max()};

void checkRange(const std::string& name, double value, const char* unit, Range range) {
  const std::string fault = rangeFault(name, value, unit, range);
  if (!fault.empty()) throw InvalidInput(fault);
}

}  // namespace

Archive Archive::reading(std::string bytes, Nanoseconds shift) {
  Archive out;
  out.reads_ = true;
  out.shift_ = shift;
  out.bytes_ = std::move(bytes);
  return out;
}

void Archive::finish() const {
  if (reads_ && at_ != bytes_.size())
    throw InvalidInput(std::to_string(bytes_.size() - at_) + " bytes are left over, allowed are 0");
}

void Archive::need(const char* name, std::size_t size) const {
  if (size > bytes_.size() - at_)
    throw InvalidInput(std::string(name) + " takes " + std::to_string(size) + " bytes, " +
                       std::to_string(bytes_.size() - at_) + " are left");
}

void Archive::bits(std::int64_t& value, std::size_t width) {
  if (!reads_) {
    const auto all = static_cast<std::uint64_t>(value);
    char bytes[sizeof all];
    for (std::size_t i = 0; i < sizeof all; ++i)
      bytes[i] = static_cast<char>((all >> (8 * i)) & 0xff);
    bytes_.append(bytes, width);
    return;
  }
  need("a number", width);
  std::uint64_t all = 0;
  for (std::size_t i = 0; i < width; ++i)
    all |= static_cast<std::uint64_t>(static_cast<unsigned char>(bytes_[at_ + i])) << (8 * i);
  at_ += width;
  value = static_cast<std::int64_t>(all);
}

void Archive::rawNumber(double& value) {
  std::int64_t all;
  std::memcpy(&all, &value, sizeof all);
  bits(all, sizeof all);
  std::memcpy(&value, &all, sizeof all);
}

void Archive::flag(const char* name, bool& value) {
  std::uint8_t byte = value ? 1 : 0;
  integer<std::uint8_t>(name, byte, 0, 1);
  value = byte == 1;
}

void Archive::number(const char* name, double& value) {
  number(name, value, FINITE);
}

void Archive::number(const char* name, double& value, Range range) {
  double read = value;
  rawNumber(read);
  if (!reads_) return;
  checkRange(name, read, "", range);
  value = read;
}

void Archive::number(const char* name, float& value, Range range) {
  std::uint32_t raw;
  std::memcpy(&raw, &value, sizeof raw);
  auto all = static_cast<std::int64_t>(raw);
  bits(all, sizeof raw);
  if (!reads_) return;
  raw = static_cast<std::uint32_t>(all);
  float read;
  std::memcpy(&read, &raw, sizeof raw);
  checkRange(name, static_cast<double>(read), "", range);
  value = read;
}

void Archive::vector(const char* name, Vec3& value) {
  for (int i = 0; i < 3; ++i) {
    double each = value[i];
    number(name, each);
    value[i] = each;
  }
}

void Archive::pose(const char* name, Pose& value) {
  vector(name, value.position);
  Quat& q = value.orientation;
  for (double* each : {&q.w, &q.x, &q.y, &q.z}) number(name, *each);
}

void Archive::stamp(const char* name, Nanoseconds& value) {
  integer(name, value);
  if (reads_) value = shifted(name, value);
}

Nanoseconds Archive::shifted(const char* name, Nanoseconds stamp) const {
  constexpr Nanoseconds LAST = std::numeric_limits<Nanoseconds>::max();
  if (shift_ == 0 || stamp <= 0 || stamp == LAST) return stamp;
  const Nanoseconds earliest = shift_ < 0 ? -shift_ : 0;
  if (stamp <= earliest || (shift_ > 0 && stamp >= LAST - shift_))
    throw InvalidInput(std::string(name) + " = " + std::to_string(secondsBetween(0, stamp)) +
                       " s moves by " + std::to_string(secondsBetween(0, shift_)) +
                       " s, which is out of the range of stamps");
  return stamp + shift_;
}

void Archive::key(std::uint64_t& value) {
  auto all = static_cast<std::int64_t>(value);
  bits(all, sizeof all);
  value = static_cast<std::uint64_t>(all);
}

void Archive::text(const char* name, std::string& value, std::size_t most) {
  const std::size_t size = length(name, value.size(), most, 1);
  if (!reads_) {
    bytes_ += value;
    return;
  }
  value = bytes_.substr(at_, size);
  at_ += size;
}

std::size_t Archive::length(const char* name, std::size_t size, std::size_t most,
                            std::size_t least) {
  auto count = static_cast<std::uint32_t>(size);
  if (!reads_ && size > most)
    throw InvalidInput(std::string(name) + " has " + std::to_string(size) +
                       " elements, allowed are 0 to " + std::to_string(most));
  integer(name, count);
  if (!reads_) return size;
  if (count > most)
    throw InvalidInput(std::string(name) + " has " + std::to_string(count) +
                       " elements, allowed are 0 to " + std::to_string(most));
  need(name, count * std::max<std::size_t>(1, least));
  return count;
}

void Archive::numbers(const char* name, std::vector<double>& values, std::size_t most) {
  list(name, values, most, sizeof(double), [&](double& value) { number(name, value); });
}

void Archive::numbers(const char* name, std::vector<float>& values, std::size_t most) {
  list(name, values, most, sizeof(float), [&](float& value) { number(name, value, FINITE); });
}

void Archive::rejectOrder(const char* name, std::size_t index) {
  throw InvalidInput(std::string(name) + "[" + std::to_string(index) +
                     "] is not after the element before, allowed are rising keys");
}

void Archive::reject(const std::string& name, const std::string& why) {
  throw InvalidInput(name + " " + why);
}

void Archive::rejectInteger(const char* name, std::int64_t value, std::int64_t low,
                            std::int64_t high) {
  throw InvalidInput(std::string(name) + " = " + std::to_string(value) + " is outside " +
                     std::to_string(low) + " to " + std::to_string(high));
}

void Archive::Fields::number(const char* name, double& value, const char* unit, Range range) {
  double read = value;
  archive_.rawNumber(read);
  if (!archive_.reads_) return;
  checkRange(owner_ + "." + name, read, unit, ranges_ ? range : FINITE);
  value = read;
}

void Archive::Fields::integer(const char* name, int& value, const char*, Range range) {
  archive_.integer<int>((owner_ + "." + name).c_str(), value, static_cast<int>(range.low),
                        static_cast<int>(range.high));
}

void Archive::Fields::vector(const char* name, Vec3& value, const char* unit, Range range) {
  for (int i = 0; i < 3; ++i) {
    double each = value[i];
    number(name, each, unit, range);
    value[i] = each;
  }
}

void Archive::Fields::choice(const char* name, int& value, const std::vector<std::string>& names) {
  archive_.integer<int>((owner_ + "." + name).c_str(), value, 0,
                        static_cast<int>(names.size()) - 1);
}

}  // namespace vegetation_sim
