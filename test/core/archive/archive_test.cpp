// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#include "core/archive/archive.h"

#include <gtest/gtest.h>

#include <limits>

namespace vegetation_sim {
namespace {

struct Thing {
  std::string name;
  bool set{false};
  double number{0.0};
  float small{0.f};
  int whole{0};
  Nanoseconds stamp{0};
  std::uint64_t key{0};
  std::vector<double> list;
  std::map<int, std::string> map;
};

void archive(Archive& a, Thing& t) {
  a.text("name", t.name, 10);
  a.flag("set", t.set);
  a.number("number", t.number, {-1.0, 1.0});
  a.number("small", t.small, {-1.0, 1.0});
  a.integer("whole", t.whole, -5, 5);
  a.stamp("stamp", t.stamp);
  a.key(t.key);
  a.numbers("list", t.list, 100);
  a.map(
      "map", t.map, 10, 8, [&a](int& key) { a.integer("key", key); },
      [&a](int, std::string& text) { a.text("text", text, 10); });
}

Thing example() {
  return {"thing",
          true,
          -0.0,
          0.25f,
          -3,
          -1,
          0xfedcba9876543210ULL,
          {1.5, 1e-310},
          {{-2, "a"}, {7, ""}}};
}

std::string bytesOf(Thing thing) {
  Archive a;
  archive(a, thing);
  return a.bytes();
}

Thing read(const std::string& bytes) {
  Archive a = Archive::reading(bytes);
  Thing out;
  archive(a, out);
  a.finish();
  return out;
}

std::string faultOf(const std::string& bytes) {
  try {
    read(bytes);
  } catch (const InvalidInput& error) {
    return error.what();
  }
  return "";
}

TEST(Archive, ReadsWhatItWrites) {
  const Thing thing = read(bytesOf(example()));
  EXPECT_EQ(thing.name, "thing");
  EXPECT_TRUE(thing.set);
  EXPECT_TRUE(std::signbit(thing.number)) << "a double has the same bits";
  EXPECT_EQ(thing.small, 0.25f);
  EXPECT_EQ(thing.whole, -3);
  EXPECT_EQ(thing.stamp, -1);
  EXPECT_EQ(thing.key, 0xfedcba9876543210ULL);
  EXPECT_EQ(thing.list, (std::vector<double>{1.5, 1e-310}));
  EXPECT_EQ(thing.map, (std::map<int, std::string>{{-2, "a"}, {7, ""}}));
  EXPECT_EQ(bytesOf(thing), bytesOf(example()));
}

Nanoseconds readStamp(Nanoseconds stamp, Nanoseconds shift) {
  Archive a;
  a.stamp("stamp", stamp);
  Archive input = Archive::reading(a.bytes(), shift);
  input.stamp("stamp", stamp);
  return stamp;
}

TEST(Archive, MovesStampsButThoseThatMeanNoneNeverOrForEver) {
  constexpr Nanoseconds LAST = std::numeric_limits<Nanoseconds>::max();
  EXPECT_EQ(readStamp(5000, 70), 5070);
  EXPECT_EQ(readStamp(5000, -4999), 1);
  for (const Nanoseconds other : {Nanoseconds{0}, Nanoseconds{-1}, LAST})
    EXPECT_EQ(readStamp(other, 70), other);
}

TEST(Archive, RejectsAShiftOutOfTheRangeOfStamps) {
  const Nanoseconds second = NANOSECONDS_PER_SECOND;
  try {
    readStamp(5 * second, -5 * second);
    FAIL();
  } catch (const InvalidInput& error) {
    EXPECT_STREQ(error.what(),
                 "stamp = 5.000000 s moves by -5.000000 s, which is out of the range of stamps");
  }
  EXPECT_THROW(readStamp(std::numeric_limits<Nanoseconds>::max() - 1, 1), InvalidInput);
}

TEST(Archive, NumbersAreLittleEndian) {
  Archive a;
  std::uint32_t value = 0x01020304;
  a.integer("value", value);
  EXPECT_EQ(a.bytes(), std::string("\x04\x03\x02\x01"));
}

TEST(Archive, RejectsEveryTruncatedInputAndLeftOverBytes) {
  const std::string bytes = bytesOf(example());
  for (std::size_t size = 0; size < bytes.size(); ++size)
    EXPECT_NE(faultOf(bytes.substr(0, size)), "") << size << " bytes";
  EXPECT_EQ(faultOf(bytes + "x"), "1 bytes are left over, allowed are 0");
}

TEST(Archive, NamesThingValueAndAllowedRange) {
  Thing thing = example();
  thing.whole = 6;
  EXPECT_EQ(faultOf(bytesOf(thing)), "whole = 6 is outside -5 to 5");
  thing = example();
  thing.number = 2.0;
  EXPECT_EQ(faultOf(bytesOf(thing)), "number = 2 is outside -1 to 1");
  thing.number = std::numeric_limits<double>::quiet_NaN();
  EXPECT_EQ(faultOf(bytesOf(thing)), "number = nan is not finite, allowed is -1 to 1");
}

// A length of four thousand million doubles must not be allocated before their bytes are there.
TEST(Archive, RejectsALengthBeyondTheBytesThatAreLeft) {
  Archive a;
  std::uint32_t length = 0xffffffff;
  a.integer("length", length);
  Archive input = Archive::reading(a.bytes());
  std::vector<double> list;
  EXPECT_THROW(input.numbers("list", list, length), InvalidInput);
  EXPECT_EQ(list.capacity(), 0u);
}

TEST(Archive, RejectsKeysThatDoNotRise) {
  std::map<int, std::string> map{{1, "a"}, {2, "b"}};
  Archive a;
  const auto key = [&a](int& k) { a.integer("key", k); };
  a.map("map", map, 10, 5, key, [&a](int, std::string& text) { a.text("text", text, 10); });
  std::string bytes = a.bytes();
  bytes[4] = 3;  // the first key
  Archive input = Archive::reading(bytes);
  try {
    input.map(
        "map", map, 10, 5, [&input](int& k) { input.integer("key", k); },
        [&input](int, std::string& text) { input.text("text", text, 10); });
    FAIL();
  } catch (const InvalidInput& error) {
    EXPECT_STREQ(error.what(), "map[1] is not after the element before, allowed are rising keys");
  }
}

}  // namespace
}  // namespace vegetation_sim
