// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <cstdint>
#include <limits>
#include <map>
#include <string>
#include <type_traits>
#include <vector>

#include "vegetation_sim/core/config/fields.h"
#include "vegetation_sim/core/math/time.h"
#include "vegetation_sim/core/math/vectors.h"

namespace vegetation_sim {

/// Writes values as bytes, or reads them back. Each type has one function `archive(Archive&, T&)`
/// that serves both, so that reading and writing cannot disagree. Numbers are little-endian with
/// explicit widths, doubles and floats their bits. Reading is strict: every number is finite and in
/// its range, and a list is not longer than the bytes that are left, so that no input can allocate
/// more than a small multiple of its size. All functions throw InvalidInput with name, value and
/// allowed range when they read.
class Archive {
 public:
  /// Writes.
  Archive() = default;
  /// Reads. Every stamp that is later than zero, and not the last there is, moves by `shift`, so
  /// that a state continues at another time. The others mean "none", "never" or "for ever".
  static Archive reading(std::string bytes, Nanoseconds shift = 0);

  bool reads() const { return reads_; }
  Nanoseconds shift() const { return shift_; }
  const std::string& bytes() const { return bytes_; }
  /// The bytes, without a copy: the last use of the archive.
  std::string takeBytes() { return std::move(bytes_); }
  /// @throws InvalidInput if bytes are left.
  void finish() const;

  void flag(const char* name, bool& value);
  /// Finite.
  void number(const char* name, double& value);
  void number(const char* name, double& value, Range range);
  void number(const char* name, float& value, Range range);
  void vector(const char* name, Vec3& value);
  void pose(const char* name, Pose& value);
  /// When it reads: moved by shift(), and still later than zero.
  void stamp(const char* name, Nanoseconds& value);
  /// @param most bytes.
  void text(const char* name, std::string& value, std::size_t most);

  /// An integer or an enum.
  template <class Int>
  void integer(const char* name, Int& value, Int low = lowest<Int>(), Int high = highest<Int>()) {
    std::int64_t wide = static_cast<std::int64_t>(value);
    bits(wide, sizeof(Int));
    if (!reads_) return;
    const Int narrow = static_cast<Int>(wide);
    if (narrow < low || narrow > high)
      rejectInteger(name, wide, static_cast<std::int64_t>(low), static_cast<std::int64_t>(high));
    value = narrow;
  }
  void key(std::uint64_t& value);  ///< a hash or key: any bits

  /// A structure that declares its fields with describe().
  template <class T>
  void fields(const char* name, T& value) {
    Fields visitor(*this, name);
    describe(visitor, value);
  }

  /// The length of a list. @param most elements. @param least bytes of one element.
  std::size_t length(const char* name, std::size_t size, std::size_t most, std::size_t least);
  /// A list; `each(element)` handles one, which takes at least `least` bytes.
  template <class T, class Each>
  void list(const char* name, std::vector<T>& values, std::size_t most, std::size_t least,
            Each each) {
    const std::size_t size = length(name, values.size(), most, least);
    if (reads_) values.clear();
    for (std::size_t i = 0; i < size; ++i) {
      if (reads_) values.emplace_back();
      each(values[i]);
    }
  }
  /// A list of finite numbers.
  void numbers(const char* name, std::vector<double>& values, std::size_t most);
  void numbers(const char* name, std::vector<float>& values, std::size_t most);
  /// A map; `key(name, key)` and `each(key, value)` handle an entry, which takes at least `least`
  /// bytes. Keys rise.
  template <class Key, class T, class OfKey, class Each>
  void map(const char* name, std::map<Key, T>& values, std::size_t most, std::size_t least,
           OfKey of_key, Each each) {
    const std::size_t size = length(name, values.size(), most, least);
    if (!reads_) {
      for (auto& entry : values) {
        Key key = entry.first;
        of_key(key);
        each(key, entry.second);
      }
      return;
    }
    values.clear();
    for (std::size_t i = 0; i < size; ++i) {
      Key key{};
      of_key(key);
      if (!values.empty() && !(values.rbegin()->first < key)) rejectOrder(name, i);
      T value{};
      each(key, value);
      values.emplace_hint(values.end(), std::move(key), std::move(value));
    }
  }
  /// Throws for an entry of a list whose keys do not rise.
  [[noreturn]] static void rejectOrder(const char* name, std::size_t index);
  /// Throws `name = value is not allowed: why`.
  [[noreturn]] static void reject(const std::string& name, const std::string& why);

  /// Handles each field that a structure declares. A structure that checks itself as a whole
  /// is read with `ranges` false: numbers are finite, and that is all.
  class Fields : public FieldVisitor {
   public:
    Fields(Archive& archive, const char* owner, bool ranges = true)
        : archive_(archive), owner_(owner), ranges_(ranges) {}
    void number(const char* name, double& value, const char* unit, Range range) override;
    void integer(const char* name, int& value, const char* unit, Range range) override;
    void vector(const char* name, Vec3& value, const char* unit, Range range) override;
    void choice(const char* name, int& value, const std::vector<std::string>& names) override;

   private:
    Archive& archive_;
    std::string owner_;
    bool ranges_;
  };

 private:
  template <class T>
  static constexpr T lowest() {
    if constexpr (std::is_enum_v<T>)
      return static_cast<T>(0);
    else
      return std::numeric_limits<T>::lowest();
  }
  template <class T>
  static constexpr T highest() {
    static_assert(!std::is_enum_v<T>, "an enum needs its last value");
    return std::numeric_limits<T>::max();
  }
  Nanoseconds shifted(const char* name, Nanoseconds stamp) const;
  void bits(std::int64_t& value, std::size_t width);
  void rawNumber(double& value);
  void need(const char* name, std::size_t size) const;
  [[noreturn]] static void rejectInteger(const char* name, std::int64_t value, std::int64_t low,
                                         std::int64_t high);

  bool reads_{false};
  Nanoseconds shift_{0};
  std::string bytes_;
  std::size_t at_{0};  // next byte that is read
};

}  // namespace vegetation_sim
