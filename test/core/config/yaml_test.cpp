// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#include "vegetation_sim/core/config/yaml.h"

#include <gtest/gtest.h>

#include <cmath>

#include "core/error_text.h"
#include "heap.h"

namespace vegetation_sim {
namespace {

struct Kite {
  double height{10.0};
  int tails{2};
  Vec3 pull{1.0, 2.0, 3.0};
  int shape{0};
};

void describe(FieldVisitor& v, Kite& kite) {
  v.number("height", kite.height, "m", {0.0, 100.0});
  v.integer("tails", kite.tails, "", {0, 9});
  v.vector("pull", kite.pull, "N", {-50.0, 50.0});
  v.choice("shape", kite.shape, {"diamond", "box"});
}

/// Reads a kite strictly and returns the faults.
std::string read(const std::string& text, Kite& kite) {
  Faults faults;
  YamlSection yaml(parseYaml(text, "kite.yaml"), "kite.yaml", faults);
  describe(yaml, kite);
  yaml.finish();
  return faults.text();
}

std::string faultsOf(const std::string& text) {
  Kite kite;
  return read(text, kite);
}

TEST(YamlSection, ReadsWhatIsThereAndKeepsTheRest) {
  Kite kite;
  EXPECT_EQ(read("{height: 3.5, shape: box, pull: [0, -1, 2]}", kite), "");
  EXPECT_EQ(kite.height, 3.5);
  EXPECT_EQ(kite.tails, 2);
  EXPECT_EQ(kite.pull, Vec3(0.0, -1.0, 2.0));
  EXPECT_EQ(kite.shape, 1);
}

TEST(YamlSection, NamesFileKeyValueAndRangeOfEachFault) {
  EXPECT_EQ(faultsOf("height: 101"), "kite.yaml: height = 101 m is outside 0 to 100 m");
  EXPECT_EQ(faultsOf("height: .nan"),
            "kite.yaml: height = nan m is not finite, allowed is 0 to 100 m");
  EXPECT_EQ(faultsOf("height: -.inf"),
            "kite.yaml: height = -inf m is not finite, allowed is 0 to 100 m");
  EXPECT_EQ(faultsOf("height: tall"), "kite.yaml: height = 'tall' is not a number");
  EXPECT_EQ(faultsOf("height: [1]"), "kite.yaml: height = a list is not a number");
  EXPECT_EQ(faultsOf("tails: 1.5"), "kite.yaml: tails = '1.5' is not a whole number");
  EXPECT_EQ(faultsOf("tails: 12"), "kite.yaml: tails = 12 is outside 0 to 9");
  EXPECT_EQ(faultsOf("pull: [1, 2]"), "kite.yaml: pull has 2 numbers; 3 are expected");
  EXPECT_EQ(faultsOf("pull: [1, 2, 70]"), "kite.yaml: pull[2] = 70 N is outside -50 to 50 N");
  EXPECT_EQ(faultsOf("shape: round"), "kite.yaml: shape = 'round' is none of diamond, box");
  EXPECT_EQ(faultsOf("colour: red"),
            "kite.yaml: colour is not a known key; known are height, pull, shape, tails");
  EXPECT_EQ(faultsOf("[1, 2]"), "kite.yaml: a list is not a map of keys");
}

TEST(YamlSection, ReportsAllFaultsAndChangesNoFaultyField) {
  Kite kite;
  const std::string faults = read("{height: -1, tails: 99, shape: round, color: 1}", kite);
  EXPECT_EQ(std::count(faults.begin(), faults.end(), '\n'), 3) << faults;
  EXPECT_EQ(kite.height, 10.0);
  EXPECT_EQ(kite.tails, 2);
  EXPECT_EQ(kite.shape, 0);
}

TEST(YamlSection, NamesTheEntryOfAList) {
  Faults faults;
  YamlSection yaml(parseYaml("kites: [{height: 1}, {height: 200}]", "k.yaml"), "k.yaml", faults);
  for (YamlSection& entry : yaml.sections("kites")) {
    Kite kite;
    describe(entry, kite);
  }
  EXPECT_EQ(faults.text(), "k.yaml: kites[1]: height = 200 m is outside 0 to 100 m");
}

TEST(YamlSection, ReadsTextFlagsAndSeeds) {
  Faults faults;
  YamlSection yaml(parseYaml("{name: red, on: true, seed: 18446744073709551615, bad: -1}", "k"),
                   "k", faults);
  std::string name;
  bool on = false;
  std::uint64_t seed = 0, bad = 5;
  yaml.text("name", name);
  yaml.flag("on", on);
  yaml.seed("seed", seed);
  EXPECT_TRUE(faults.empty()) << faults.text();
  EXPECT_EQ(name, "red");
  EXPECT_TRUE(on);
  EXPECT_EQ(seed, 18446744073709551615ULL);
  yaml.seed("bad", bad);
  EXPECT_EQ(faults.text(), "k: bad = '-1' is not a whole number from 0 to 2^64 - 1");
  EXPECT_EQ(bad, 5u);
}

TEST(LoadYaml, NamesTheFileThatIsMissingOrNoYaml) {
  EXPECT_EQ(errorOf([] { loadYamlFile("nowhere.yaml"); }),
            "nowhere.yaml: cannot be read: No such file or directory");
  EXPECT_EQ(errorOf([] { parseYaml("a: [1, 2", "k.yaml"); }).rfind("k.yaml: not YAML: ", 0), 0u);
}

// A parsed value takes some hundred bytes, so few bytes of text can take much memory.
TEST(ParseYaml, TextIsLimitedBeforeItIsParsed) {
  EXPECT_EQ(errorOf([] { parseYaml(std::string((1u << 20) + 1, ' '), "rules"); }),
            "rules: 1048577 bytes, more than the 1048576 allowed");
  for (const char* nested : {"[", "{a: ", "- ", "? "}) {
    std::string text;
    for (int i = 0; i < 20000; ++i) text += nested;
    EXPECT_EQ(errorOf([&] { parseYaml(text, "rules"); }),
              "rules: values lie 20000 deep, more than the 100 allowed")
        << nested;
  }
  EXPECT_EQ(errorOf([&] { parseYaml(std::string(200001, '['), "rules"); }),
            "rules: 200001 signs that separate values, more than the 200000 allowed");
  EXPECT_EQ(errorOf([] { parseYaml("[1, 2]", "rules"); }), "");
}

TEST(ParseYaml, FaultsQuoteTheBeginningOfALongValue) {
  Kite kite;
  const std::string fault = read("height: " + std::string(100000, 'x'), kite);
  EXPECT_LT(fault.size(), 200u);
  EXPECT_NE(fault.find("height"), std::string::npos);
}

// Each section has a copy of the path, which may have the name of a species.
TEST(YamlSection, ReadsNoLongerListsThanAllowed) {
  std::string text = "kites: [a";
  for (int i = 0; i < 99999; ++i) text += ",a";
  Faults faults;
  YamlSection yaml(parseYaml(text + "]", "k.yaml"), std::string(1000, 'n'), faults);
  restartPeak();
  const long before = liveBytes();
  EXPECT_TRUE(yaml.sections("kites", 5).empty());
  EXPECT_LT(peakBytes() - before, 1 << 20);
  ASSERT_EQ(faults.list().size(), 1u);
  EXPECT_EQ(faults.list()[0].substr(998), "nn: kites has 100000 entries, more than the 5 allowed");
}

TEST(YamlSection, DescribesNoMoreUnknownKeysThanFaultsAreKept) {
  const auto allocations = [](int keys) {
    std::string text;
    for (int i = 0; i < keys; ++i) text += "k" + std::to_string(i) + ": 1\n";
    Faults faults;
    YamlSection yaml(parseYaml(text, "k.yaml"), std::string(100, 'n'), faults);
    const std::size_t before = allocationCount();
    yaml.finish();
    EXPECT_EQ(faults.list().size(), 100u);
    return allocationCount() - before;
  };
  EXPECT_LT(allocations(10100), allocations(100) + 15000);  // less than two for each other key
}

TEST(KeepLimits, BoundsNamesAndTheSumOfTheTexts) {
  const std::string name(256, 'n'), longer(257, 'n'), half(1 << 19, ' '), more((1 << 19) + 1, ' ');
  Faults none, faults;
  EXPECT_TRUE(keepLimits("species", {{name, half}, {"oak", half}}, none));
  EXPECT_TRUE(none.empty());
  EXPECT_FALSE(keepLimits("species", {{longer, half}, {"oak", more}}, faults));
  EXPECT_EQ(faults.text(),
            "species " + inQuotes(longer) +
                ": name has 257 letters, more than the 256 allowed\n"
                "species: rules have 1048577 bytes together, more than the 1048576 allowed");
}

TEST(YamlFieldWriter, WritesWhatIsReadBackToTheBit) {
  Kite kite;
  kite.height = 1.0 / 3.0;
  kite.pull = Vec3(0.1, -1e-17, 49.999999999999993);
  kite.shape = 1;
  YAML::Emitter out;
  YamlFieldWriter writer(out);
  out << YAML::BeginMap;
  describe(writer, kite);
  out << YAML::EndMap;
  Kite copy;
  EXPECT_EQ(read(out.c_str(), copy), "");
  EXPECT_EQ(copy.height, kite.height);
  EXPECT_EQ(copy.pull, kite.pull);
  EXPECT_EQ(copy.shape, kite.shape);
}

TEST(FieldChecker, NamesItsOwnerAndEachFault) {
  Kite kite;
  kite.height = std::nan("");
  kite.pull.y() = 1e9;
  kite.shape = 7;
  Faults faults;
  FieldChecker checker("kite: ", faults);
  describe(checker, kite);
  EXPECT_EQ(faults.list().size(), 3u) << faults.text();
  EXPECT_EQ(faults.list().front(), "kite: height = nan m is not finite, allowed is 0 to 100 m");
  EXPECT_THROW(faults.throwIfAny(), InvalidInput);
}

TEST(FieldHasher, GivesEachFieldItsOwnHash) {
  const auto hashOf = [](Kite kite) {
    Hash hash;
    FieldHasher hasher(hash);
    describe(hasher, kite);
    return hash.value();
  };
  const Kite kite;
  std::vector<Kite> others(4);
  others[0].height = std::nextafter(kite.height, 11.0);
  others[1].tails = 3;
  others[2].pull.z() = 2.0;
  others[3].shape = 1;
  for (const Kite& other : others) EXPECT_NE(hashOf(other), hashOf(kite));
  EXPECT_EQ(hashOf(Kite{}), hashOf(kite));
}

}  // namespace
}  // namespace vegetation_sim
