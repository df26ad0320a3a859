// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#include "vegetation_sim/core/config/faults.h"

#include <gtest/gtest.h>

#include "core/error_text.h"
#include "vegetation_sim/core/config/fields.h"

namespace vegetation_sim {
namespace {

TEST(InQuotes, IsAtMostTheBeginningOfAValue) {
  EXPECT_EQ(inQuotes("oak"), "'oak'");
  EXPECT_EQ(inQuotes(std::string(60, 'a')), "'" + std::string(60, 'a') + "'");
  EXPECT_EQ(inQuotes(std::string(61, 'a')), "'" + std::string(60, 'a') + "...'");
  EXPECT_EQ(shortened("willow", 3), "wil...");
}

TEST(InQuotes, CutsNoLetterOfUtf8) {
  EXPECT_EQ(shortened("äöü", 3), "ä...");
  EXPECT_EQ(shortened("äöü", 4), "äö...");
  EXPECT_EQ(shortened("äöü", 6), "äöü");
}

TEST(InvalidInput, IsAtMostFourKilobytesLong) {
  const InvalidInput error("name = " + std::string(1 << 20, 'x'));
  EXPECT_EQ(std::string(error.what()).size(), LONGEST_ERROR + 3);
  EXPECT_EQ(std::string(InvalidInput("short").what()), "short");
}

TEST(Faults, KeepAHundredOfABoundedLength) {
  Faults faults;
  for (int i = 0; i < 150; ++i) {
    EXPECT_EQ(faults.isFull(), i >= 100);
    faults.add(std::string(100000, 'x'));
  }
  EXPECT_EQ(faults.list().size(), 100u);
  EXPECT_EQ(faults.list()[0].size(), LONGEST_ERROR + 3);
  EXPECT_EQ(errorOf([&] { faults.throwIfAny(); }).size(), LONGEST_ERROR + 3);
}

}  // namespace
}  // namespace vegetation_sim
