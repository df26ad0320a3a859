// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#include "ros/params/parameters.h"

#include <gtest/gtest.h>
#include <ros/ros.h>

#include "core/error_text.h"

namespace vegetation_sim {
namespace {

/// One value of each type that a reader supports.
struct Asked {
  double number{1.0};
  int integer{1}, choice{0};
  Vec3 vector{Vec3::Zero()};
  std::string text{"none"};
  bool flag{false};
  std::uint64_t seed{1};
  std::vector<int> integers{1};

  /// Returns all faults without the namespace.
  std::string read(const ros::NodeHandle& handle) {
    Parameters parameters(handle);
    parameters.number("number", number, "m", {0.0, 10.0});
    parameters.integer("integer", integer, "", {0.0, 10.0});
    parameters.choice("choice", choice, {"oak", "pine"});
    parameters.vector("vector", vector, "m/s", {-5.0, 5.0});
    parameters.text("text", text);
    parameters.flag("flag", flag);
    parameters.seed("seed", seed);
    parameters.integers("integers", integers, {0.0, 10.0});
    parameters.allow("elsewhere");
    std::string faults = errorOf([&] { parameters.finish(); });
    const std::string prefix = handle.getNamespace() + "/";
    for (std::size_t at; (at = faults.find(prefix)) != std::string::npos;)
      faults.erase(at, prefix.size());
    return faults;
  }
};

XmlRpc::XmlRpcValue list(std::initializer_list<double> numbers) {
  XmlRpc::XmlRpcValue out;
  int i = 0;
  for (const double number : numbers) out[i++] = number;
  return out;
}

class ParametersTest : public testing::Test {
 protected:
  ParametersTest() : handle_("~/case") {}
  ~ParametersTest() override { ros::param::del(handle_.getNamespace()); }

  /// Returns the error for one bad value while the other parameters are absent.
  template <class Value>
  std::string faultOf(const std::string& name, const Value& value) {
    handle_.setParam(name, value);
    const std::string fault = Asked().read(handle_);
    handle_.deleteParam(name);
    return fault;
  }

  ros::NodeHandle handle_;
};

TEST_F(ParametersTest, GoodValuesAreTaken) {
  handle_.setParam("number", 3);  // An integer is also a number.
  handle_.setParam("integer", 7);
  handle_.setParam("choice", "pine");
  handle_.setParam("vector", list({1.0, -2.5, 5.0}));
  handle_.setParam("text", "here");
  handle_.setParam("flag", true);
  handle_.setParam("seed", "18446744073709551615");
  handle_.setParam("integers", std::vector<int>{4, 10});
  handle_.setParam("elsewhere", 9);
  Asked asked;
  EXPECT_EQ(asked.read(handle_), "");
  EXPECT_EQ(asked.number, 3.0);
  EXPECT_EQ(asked.integer, 7);
  EXPECT_EQ(faultOf("integers", std::vector<double>{3.0, 10.0}), "");
  EXPECT_EQ(asked.choice, 1);
  EXPECT_EQ(asked.vector, Vec3(1.0, -2.5, 5.0));
  EXPECT_EQ(asked.text, "here");
  EXPECT_TRUE(asked.flag);
  EXPECT_EQ(asked.seed, 18446744073709551615ULL);
  EXPECT_EQ(asked.integers, (std::vector<int>{4, 10}));
}

TEST_F(ParametersTest, AbsentOnesKeepTheirDefaults) {
  Asked asked;
  EXPECT_EQ(asked.read(handle_), "");
  EXPECT_EQ(asked.number, 1.0);
  EXPECT_EQ(asked.text, "none");
}

TEST_F(ParametersTest, WholeNumbersMayHaveAPoint) {
  Asked asked;
  handle_.setParam("integer", 7.0);
  EXPECT_EQ(asked.read(handle_), "");
  EXPECT_EQ(asked.integer, 7);
}

TEST_F(ParametersTest, ErrorsNameBadValues) {
  EXPECT_EQ(faultOf("number", 11.0), "number = 11 m is outside 0 to 10 m");
  EXPECT_EQ(faultOf("number", "two"), "number = two is not a number");
  EXPECT_EQ(faultOf("number", true), "number = 1 is not a number");
  EXPECT_EQ(faultOf("integer", 2.5), "integer = 2.5 is not a whole number");
  EXPECT_EQ(faultOf("integer", 1e12), "integer = 1e+12 is outside 0 to 10");
  EXPECT_EQ(faultOf("integer", -1), "integer = -1 is outside 0 to 10");
  EXPECT_EQ(faultOf("choice", "elm"), "choice = 'elm' is none of oak, pine");
  EXPECT_EQ(faultOf("vector", list({1.0, 2.0})), "vector = {1,2} is not a list of three numbers");
  EXPECT_EQ(faultOf("vector", list({1.0, 9.0, 2.0})), "vector_y = 9 m/s is outside -5 to 5 m/s");
  EXPECT_EQ(faultOf("text", 5), "text = 5 is not text");
  EXPECT_EQ(faultOf("flag", 1), "flag = 1 is not true or false");
  EXPECT_EQ(faultOf("seed", -1), "seed = -1 is not a whole number from 0 to 2^64 - 1");
  EXPECT_EQ(faultOf("integers", std::vector<int>{3, 11}), "integers = 11 is outside 0 to 10");
  EXPECT_EQ(faultOf("integers", 3), "integers = 3 is not a list of whole numbers");
}

// Several launch files can each add the list of their robot.
TEST_F(ParametersTest, AListMayBeAMapOfListsAndAnEntryTheNameOfAFrame) {
  XmlRpc::XmlRpcValue maps;
  maps[0]["frame"] = "caster";
  maps[0]["radius"] = 0.1;
  handle_.setParam("sources/a", maps);
  handle_.setParam("sources/b", std::vector<std::string>{"left", "right"});
  Parameters parameters(handle_);
  YAML::Node found;
  ASSERT_TRUE(parameters.list("sources", found));
  const YAML::Node all = found["sources"];
  ASSERT_EQ(all.size(), 3u);
  EXPECT_EQ(all[0]["frame"].as<std::string>(), "caster");
  EXPECT_EQ(all[0]["radius"].as<double>(), 0.1);
  EXPECT_EQ(all[1]["frame"].as<std::string>(), "left");
  EXPECT_EQ(all[2]["frame"].as<std::string>(), "right");
  handle_.setParam("sources", 7);
  ASSERT_TRUE(parameters.list("sources", found));
  EXPECT_TRUE(found["sources"].IsScalar());
}

TEST_F(ParametersTest, ErrorsNameUnknownAndKnownParameters) {
  EXPECT_EQ(faultOf("numbre", 1.0),
            "numbre is not a known parameter; known are choice, diagnostic_period, elsewhere, "
            "flag, integer, integers, number, seed, text, vector");
}

TEST_F(ParametersTest, AllFaultsAreReported) {
  handle_.setParam("number", "two");
  handle_.setParam("integer", 99);
  handle_.setParam("inetger", 9);
  const std::string faults = Asked().read(handle_);
  for (const char* part : {"number = two", "integer = 99", "inetger is not a known parameter"})
    EXPECT_NE(faults.find(part), std::string::npos) << part << " in " << faults;
}

}  // namespace
}  // namespace vegetation_sim

int main(int argc, char** argv) {
  testing::InitGoogleTest(&argc, argv);
  ros::init(argc, argv, "parameters_test");
  const ros::NodeHandle handle;
  return RUN_ALL_TESTS();
}
