// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#include "fuzz/mutation.h"

#include <algorithm>
#include <cstring>
#include <limits>

namespace vegetation_sim::fuzz {
namespace {

/// Random numbers in a row.
class Dice {
 public:
  explicit Dice(const Random& random) : random_(random) {}
  std::size_t below(std::size_t count) {
    return count == 0 ? 0 : static_cast<std::size_t>(random_.bits(next_++) % count);
  }

 private:
  Random random_;
  std::uint64_t next_{0};
};

template <class Number>
std::string bytesOf(Number number) {
  std::string out(sizeof(number), '\0');
  std::memcpy(out.data(), &number, sizeof(number));
  return out;
}

/// Values at which programs fail, as they stand in messages and in text.
const std::vector<std::string>& notableValues() {
  using Double = std::numeric_limits<double>;
  static const std::vector<std::string> VALUES{bytesOf(0.0),
                                               bytesOf(-1.0),
                                               bytesOf(1e-300),
                                               bytesOf(1e300),
                                               bytesOf(1e7),
                                               bytesOf(Double::quiet_NaN()),
                                               bytesOf(Double::infinity()),
                                               bytesOf(std::numeric_limits<float>::quiet_NaN()),
                                               bytesOf(1e30F),
                                               bytesOf(std::uint32_t{0}),
                                               bytesOf(std::uint32_t{1}),
                                               bytesOf(std::uint32_t{1} << 24),
                                               bytesOf(std::numeric_limits<std::int32_t>::max()),
                                               bytesOf(std::numeric_limits<std::uint32_t>::max()),
                                               bytesOf(std::numeric_limits<std::int64_t>::min()),
                                               "0",
                                               "-1",
                                               "1e308",
                                               ".nan",
                                               ".inf",
                                               "4294967296",
                                               "99999999999999999999",
                                               "~",
                                               "[]",
                                               "{}",
                                               "*a",
                                               "&a ",
                                               "\n  - ",
                                               ": "};
  return VALUES;
}

void replace(std::string& text, std::size_t at, const std::string& value) {
  for (std::size_t i = 0; i < value.size() && at + i < text.size(); ++i) text[at + i] = value[i];
}

void change(std::string& text, const std::vector<std::string>& inputs, Dice& dice) {
  const std::size_t at = dice.below(text.size() + 1), length = 1 + dice.below(1 + dice.below(64));
  const std::vector<std::string>& values = notableValues();
  switch (dice.below(8)) {
    case 0:
      if (at < text.size()) text[at] = static_cast<char>(text[at] ^ (1 << dice.below(8)));
      break;
    case 1:
      if (at < text.size()) text[at] = static_cast<char>(dice.below(256));
      break;
    case 2:
    case 3:
      replace(text, at, values[dice.below(values.size())]);
      break;
    case 4:
      text.insert(at, values[dice.below(values.size())]);
      break;
    case 5:
      text.erase(at, length);
      break;
    case 6:
      text.insert(at, text.substr(at, length));
      break;
    default: {
      const std::string& other = inputs[dice.below(inputs.size())];
      const std::size_t from = dice.below(other.size() + 1);
      text.insert(at, other.substr(from, 4 * length));
    }
  }
}

}  // namespace

std::string mutate(const std::vector<std::string>& inputs, const Random& random) {
  Dice dice(random);
  std::string out = inputs[dice.below(inputs.size())];
  for (std::size_t changes = 1 + dice.below(1 + dice.below(8)); changes > 0; --changes)
    change(out, inputs, dice);
  if (out.size() > LONGEST_INPUT) out.resize(LONGEST_INPUT);
  return out;
}

}  // namespace vegetation_sim::fuzz
