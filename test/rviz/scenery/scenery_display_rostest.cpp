// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#include <functional>
#include <new>
#include <stdexcept>

#include "rviz/crowd/crowd_display.h"
#include "rviz/rigs/display_checks.h"
#include "rviz/rigs/view_rig.h"

namespace vegetation_sim {
namespace {

/// A display whose drawing does what the test sets.
class FailingDisplay : public CrowdDisplay {
 public:
  std::function<void()> drawing = [] {};
  int draws{0};

 protected:
  std::optional<std::string> frame() const override { return "map"; }
  void draw(Nanoseconds, const view::View&) override {
    ++draws;
    drawing();
  }
};

class SceneryDisplayTest : public testing::Test {
 protected:
  SceneryDisplayTest() { rig.manager().addDisplay(display, true); }

  /// Whether the display is drawn often enough for its status to be reported anew.
  bool draws() {
    const int before = display->draws;
    return rig.until([&] { return display->draws > before + 20; });
  }

  ViewRig rig;
  FailingDisplay* display = new FailingDisplay;  // rviz owns it
};

TEST_F(SceneryDisplayTest, AnyExceptionOfADrawingIsItsStatusOnly) {
  ASSERT_TRUE(draws());
  EXPECT_EQ(statusOf(*display, "Drawn").find("Not drawn: "), std::string::npos);
  const std::pair<std::function<void()>, std::string> failures[] = {
      {[] { throw InvalidInput("a broken layout"); }, "a broken layout"},
      {[] { throw std::runtime_error("no such texture"); }, "no such texture"},
      {[] { throw std::bad_alloc(); }, std::bad_alloc().what()}};
  for (const auto& [failure, text] : failures) {
    display->drawing = failure;
    EXPECT_TRUE(draws()) << text;
    const auto reported = [&, reason = "Not drawn: " + text] {
      return statusOf(*display, "Drawn") == reason;
    };
    EXPECT_TRUE(rig.until(reported)) << statusOf(*display, "Drawn");
  }
  display->drawing = [] {};
  EXPECT_TRUE(rig.until([&] {
    return statusOf(*display, "Drawn").find("Not drawn: ") == std::string::npos;
  })) << statusOf(*display, "Drawn");
}

}  // namespace
}  // namespace vegetation_sim

int main(int argc, char** argv) {
  testing::InitGoogleTest(&argc, argv);
  ros::init(argc, argv, "scenery_display_test");
  const QApplication application(argc, argv);
  return RUN_ALL_TESTS();
}
