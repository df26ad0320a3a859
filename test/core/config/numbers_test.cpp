// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#include "core/config/numbers.h"

#include <gtest/gtest.h>

#include <locale>

namespace vegetation_sim {
namespace {

struct DecimalComma : std::numpunct<char> {
  char do_decimal_point() const override { return ','; }
};

TEST(ParseNumber, TakesTheWholeTextOnly) {
  EXPECT_EQ(parseNumber("-2.5e3"), -2500.0);
  for (const char* text : {"", "2,5", "2.5 m", "height"}) EXPECT_FALSE(parseNumber(text)) << text;
}

// rviz and Qt set the locale of the user, which may have a decimal comma.
TEST(ParseNumber, ReadsADecimalPointInAnyLocale) {
  const std::locale before = std::locale::global(std::locale(std::locale(), new DecimalComma));
  const auto number = parseNumber("0.231");
  std::locale::global(before);
  EXPECT_EQ(number, 0.231);
}

}  // namespace
}  // namespace vegetation_sim
