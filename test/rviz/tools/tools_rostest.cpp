// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#include <diagnostic_msgs/DiagnosticArray.h>
#include <gtest/gtest.h>
#include <ros/callback_queue.h>
#include <rviz/properties/string_property.h>
#include <rviz/tool_manager.h>
#include <rviz/view_controller.h>
#include <rviz/viewport_mouse_event.h>
#include <vegetation_sim/GetTree.h>
#include <vegetation_sim/Pick.h>
#include <vegetation_sim/TreadEvent.h>
#include <vegetation_sim/WindField.h>

#include <QPushButton>
#include <atomic>
#include <chrono>
#include <cmath>
#include <future>
#include <initializer_list>
#include <map>

#include "rviz/render/ogre_vectors.h"
#include "rviz/rigs/view_rig.h"
#include "rviz/tools/grab_tool.h"
#include "rviz/tools/landscape_panel.h"
#include "rviz/tools/tread_tool.h"
#include "rviz/tools/wind_tool.h"
#include "vegetation_sim/ros/conversions/geometry_conversions.h"

namespace vegetation_sim {
namespace {

// rviz can be started only once in a process.
std::unique_ptr<ViewRig> shared_rig;

class ToolsTest : public testing::Test {
 protected:
  static void SetUpTestSuite() { shared_rig = std::make_unique<ViewRig>(); }
  static void TearDownTestSuite() { shared_rig.reset(); }

  void SetUp() override { setCamera(1.0f); }
  void TearDown() override { putAway(); }

  // Sets a camera in the south-west and above, 7 m from a point on the z axis. Returns when rviz
  // has drawn a frame with it.
  void setCamera(float z) {
    rviz::ViewController& view = *rig.manager().getViewManager()->getCurrent();
    view.lookAt(0.f, 0.f, z);
    view.subProp("Distance")->setValue(7.0);
    view.subProp("Yaw")->setValue(3.9);
    view.subProp("Pitch")->setValue(0.3);
    rig.frames(3);
  }
  void putAway() {
    rviz::ToolManager& tools = *rig.manager().getToolManager();
    tools.setCurrentTool(tools.addTool("rviz/MoveCamera"));
  }

  template <class Tool>
  Tool* use(const char* name) {
    rviz::ToolManager& tools = *rig.manager().getToolManager();
    auto* out = dynamic_cast<Tool*>(tools.addTool(name));
    if (out != nullptr) tools.setCurrentTool(out);
    return out;
  }

  struct Pixel {
    int x, y;
  };
  Pixel pixelOf(const Vec3& place) {
    const Ogre::Vector3 at(static_cast<float>(place.x()), static_cast<float>(place.y()),
                           static_cast<float>(place.z()));
    const Ogre::Vector3 seen =
        rig.camera().getProjectionMatrix() * (rig.camera().getViewMatrix() * at);
    return {static_cast<int>((0.5f + 0.5f * seen.x) * static_cast<float>(rig.panel().width())),
            static_cast<int>((0.5f - 0.5f * seen.y) * static_cast<float>(rig.panel().height()))};
  }

  void mouse(rviz::Tool& tool, QEvent::Type type, Pixel at) {
    const bool up = type == QEvent::MouseButtonRelease;
    QMouseEvent event(type, QPointF(at.x, at.y),
                      type == QEvent::MouseMove ? Qt::NoButton : Qt::LeftButton,
                      up ? Qt::NoButton : Qt::LeftButton, Qt::NoModifier);
    rviz::ViewportMouseEvent seen(&rig.panel(), rig.panel().getViewport(), &event, at.x, at.y);
    tool.processMouseEvent(seen);
  }

  bool getTree(GetTree& service) {
    service.request.tree = 0;
    return ros::service::call("/forest_animator/get_tree", service) && service.response.success;
  }

  ViewRig& rig{*shared_rig};
};

Vec3 middleOf(const GetTree::Response& tree, std::size_t branch) {
  const Pose pose = fromMsg(tree.transforms.poses[branch]);
  return transformed(pose, {0.0, 0.0, 0.5 * static_cast<double>(tree.lengths[branch])});
}

// S1-01, S1-27: the mouse grabs a branch, pulls it and releases it.
TEST_F(ToolsTest, TheMouseGrabsPullsAndReleasesABranch) {
  auto* tool = use<GrabTool>("vegetation_sim/GrabTool");
  ASSERT_NE(tool, nullptr);
  GetTree tree;
  ASSERT_TRUE(rig.until([&] { return getTree(tree); }));
  const Vec3 trunk = middleOf(tree.response, 0);
  const Pixel from = pixelOf(trunk), to = {from.x + 40, from.y};
  mouse(*tool, QEvent::MouseButtonPress, from);
  ASSERT_TRUE(rig.until([&] { return tool->grip().holding; })) << tool->grip().message;
  EXPECT_EQ(tool->grip().tree, 0u);
  mouse(*tool, QEvent::MouseMove, to);
  ASSERT_TRUE(rig.until([&] { return tool->grip().force.norm() > 20.0; }));
  const view::Grip pulled = tool->grip();
  const Vec3 right = view::toVec3(rig.camera().getDerivedRight());
  EXPECT_GT((pulled.target - pulled.start).dot(right), 0.1) << "not to the right";
  EXPECT_NEAR((pulled.target - pulled.start).dot(view::toVec3(rig.camera().getDerivedDirection())),
              0.0, 1e-3);
  EXPECT_LT(pulled.force.dot(right), 0.0) << "the tree pulls back";
  ASSERT_TRUE(getTree(tree));
  ASSERT_EQ(tree.response.grabs.size(), 1u);
  EXPECT_FALSE(tree.response.physical.empty());
  mouse(*tool, QEvent::MouseButtonRelease, to);
  EXPECT_TRUE(rig.until([&] { return getTree(tree) && tree.response.grabs.empty(); }));
  EXPECT_FALSE(tool->grip().holding);
}

TEST_F(ToolsTest, DeactivatingTheToolReleasesTheBranch) {
  auto* tool = use<GrabTool>("vegetation_sim/GrabTool");
  GetTree tree;
  ASSERT_TRUE(rig.until([&] { return getTree(tree); }));
  mouse(*tool, QEvent::MouseButtonPress, pixelOf(middleOf(tree.response, 0)));
  ASSERT_TRUE(rig.until([&] { return tool->grip().holding; }));
  putAway();
  EXPECT_TRUE(rig.until([&] { return getTree(tree) && tree.response.grabs.empty(); }));
}

TEST_F(ToolsTest, ANodeThatDoesNotReplyIsReported) {
  auto* tool = use<GrabTool>("vegetation_sim/GrabTool");
  putAway();
  tool->getPropertyContainer()->subProp("Node")->setValue("/no_node");
  rig.manager().getToolManager()->setCurrentTool(tool);
  mouse(*tool, QEvent::MouseButtonPress, {240, 180});
  EXPECT_TRUE(rig.until([&] {
    return tool->grip().message.find("/no_node/pick") != std::string::npos;
  })) << tool->grip().message;
}

// A service that does not return blocks neither the view nor the removal of the tool.
TEST_F(ToolsTest, ANodeThatHangsDoesNotBlockTheView) {
  ros::CallbackQueue queue;
  ros::NodeHandle hung("/hung");
  hung.setCallbackQueue(&queue);
  std::promise<void> enough;
  std::future<void> waited = enough.get_future();
  std::atomic<bool> called{false}, returned{false};
  const boost::function<bool(Pick::Request&, Pick::Response&)> hang = [&](auto&, auto&) {
    called = true;
    waited.wait_for(std::chrono::seconds(20));
    return returned = true;
  };
  const ros::ServiceServer server = hung.advertiseService("pick", hang);
  ros::AsyncSpinner spinner(1, &queue);
  spinner.start();
  auto* tool = use<GrabTool>("vegetation_sim/GrabTool");
  putAway();
  tool->getPropertyContainer()->subProp("Node")->setValue("/hung");
  rig.manager().getToolManager()->setCurrentTool(tool);
  mouse(*tool, QEvent::MouseButtonPress, {240, 180});
  ASSERT_TRUE(rig.until([&] { return called.load(); }));
  putAway();
  rig.frames(3);
  EXPECT_FALSE(returned);
  enough.set_value();
  EXPECT_TRUE(rig.until([&] { return returned.load(); }));
}

TEST_F(ToolsTest, InvalidNamesAreRejected) {
  for (const char* name : {"no name!", "~x", ""}) {
    auto* grab = use<GrabTool>("vegetation_sim/GrabTool");
    auto* wind = use<WindTool>("vegetation_sim/WindTool");
    auto* tread = use<TreadTool>("vegetation_sim/TreadTool");
    putAway();
    grab->getPropertyContainer()->subProp("Node")->setValue(name);
    wind->getPropertyContainer()->subProp("Node")->setValue(name);
    tread->getPropertyContainer()->subProp("Topic")->setValue(name);
    for (rviz::Tool* tool : std::initializer_list<rviz::Tool*>{grab, wind, tread}) {
      rig.manager().getToolManager()->setCurrentTool(tool);
      mouse(*tool, QEvent::MouseButtonPress, pixelOf({-0.6, 0.4, 0.0}));
      mouse(*tool, QEvent::MouseMove, pixelOf({0.7, -0.2, 0.0}));
      mouse(*tool, QEvent::MouseButtonRelease, pixelOf({0.7, -0.2, 0.0}));
      rig.frames(3);
    }
    EXPECT_FALSE(grab->grip().holding);
  }
}

// S2-21: a stroke of the mouse on the ground treads along it.
TEST_F(ToolsTest, TheMouseTreads) {
  std::vector<TreadEvent> events;
  const boost::function<void(const TreadEvent&)> receive = [&](const TreadEvent& e) {
    events.push_back(e);
  };
  const ros::Subscriber listener = rig.nodeHandle().subscribe<TreadEvent>("tread", 100, receive);
  auto* tool = use<TreadTool>("vegetation_sim/TreadTool");
  ASSERT_NE(tool, nullptr);
  ASSERT_TRUE(rig.until([&] { return listener.getNumPublishers() > 0; }));
  const Vec3 begin(-0.6, 0.4, 0.0), end(0.7, -0.2, 0.0);
  mouse(*tool, QEvent::MouseButtonPress, pixelOf(begin));
  mouse(*tool, QEvent::MouseMove, pixelOf(end));
  mouse(*tool, QEvent::MouseButtonRelease, pixelOf(end));
  ASSERT_TRUE(rig.until([&] { return events.size() == 3; }));
  EXPECT_EQ(events[0].action, TreadEvent::PLACE);
  EXPECT_EQ(events[1].action, TreadEvent::MOVE);
  EXPECT_EQ(events[2].action, TreadEvent::LIFT);
  // A pixel is about 3 cm here.
  EXPECT_LT((fromMsg(events[0].position) - begin).norm(), 0.08);
  EXPECT_LT((fromMsg(events[1].position) - end).norm(), 0.08);
}

// S2-20: a stroke starts a gust along it.
TEST_F(ToolsTest, AStrokeStartsAGust) {
  WindField field;
  const boost::function<void(const WindField&)> receive = [&](const WindField& f) { field = f; };
  const ros::Subscriber listener = rig.nodeHandle().subscribe<WindField>("wind", 1, receive);
  auto* tool = use<WindTool>("vegetation_sim/WindTool");
  ASSERT_NE(tool, nullptr);
  rig.until([&] { return !field.primitives.empty(); });
  mouse(*tool, QEvent::MouseButtonPress, pixelOf({-1.0, 0.0, 0.0}));
  mouse(*tool, QEvent::MouseMove, pixelOf({1.0, 0.0, 0.0}));
  mouse(*tool, QEvent::MouseButtonRelease, pixelOf({1.0, 0.0, 0.0}));
  const WindPrimitive* gust = nullptr;
  EXPECT_TRUE(rig.until([&] {
    for (const WindPrimitive& primitive : field.primitives)
      if (primitive.name == "mouse_gust") gust = &primitive;
    return gust != nullptr;
  }));
  ASSERT_NE(gust, nullptr);
  EXPECT_EQ(gust->kind, WindPrimitive::GUST);
  EXPECT_NEAR(gust->velocity.x, 2.0, 0.1);
  EXPECT_NEAR(gust->velocity.y, 0.0, 0.1);
}

// The dial and the slider of the panel set the breeze, and the button activates the tool.
TEST_F(ToolsTest, ThePanelSetsTheWind) {
  WindField field;
  const boost::function<void(const WindField&)> receive = [&](const WindField& f) { field = f; };
  const ros::Subscriber listener = rig.nodeHandle().subscribe<WindField>("wind", 1, receive);
  LandscapePanel panel;
  panel.initialize(&rig.manager());
  panel.findChild<QDial*>()->setValue(180);   // towards the south
  panel.findChild<QSlider*>()->setValue(60);  // 6 m/s
  EXPECT_TRUE(rig.until([&] {
    const WindPrimitive* breeze = nullptr;
    for (const WindPrimitive& primitive : field.primitives)
      if (primitive.name == "breeze") breeze = &primitive;
    return breeze != nullptr && std::fabs(breeze->velocity.y + 6.0) < 0.1;
  }));
  for (QPushButton* button : panel.findChildren<QPushButton*>())
    if (button->text() == "Gust") button->click();
  EXPECT_NE(dynamic_cast<WindTool*>(rig.manager().getToolManager()->getCurrentTool()), nullptr);
  EXPECT_TRUE(rig.until([&] {
    for (QProgressBar* bar : panel.findChildren<QProgressBar*>())
      if (bar->format().contains(" of 7")) return true;  // The scene has seven trees.
    return false;
  }));
}

// The panel shows the settings of the forest, and a change sets only its own parameter.
TEST_F(ToolsTest, ThePanelSetsToleranceAndBudget) {
  std::map<std::string, double> there;
  const boost::function<void(const dynamic_reconfigure::Config&)> receive =
      [&](const dynamic_reconfigure::Config& config) {
        for (const auto& value : config.doubles) there[value.name] = value.value;
      };
  const ros::Subscriber listener = rig.nodeHandle().subscribe<dynamic_reconfigure::Config>(
      "/forest_animator/parameter_updates", 1, receive);
  LandscapePanel panel;
  panel.initialize(&rig.manager());
  const auto box = [&](const char* unit) {
    for (QDoubleSpinBox* each : panel.findChildren<QDoubleSpinBox*>())
      if (each->suffix() == unit) return each;
    return static_cast<QDoubleSpinBox*>(nullptr);
  };
  QDoubleSpinBox *tolerance = box(" pixel"), *budget = box(" ms a frame");
  ASSERT_TRUE(tolerance && budget);
  ASSERT_TRUE(rig.until([&] {
    return there.count("frame_time") > 0 && budget->value() == there["frame_time"] &&
           tolerance->value() == there["tolerance"];
  }));
  const std::map<std::string, double> before = there;
  budget->setValue(0.125);
  EXPECT_TRUE(rig.until([&] { return there["frame_time"] == 0.125; }));
  tolerance->setValue(2.5);
  EXPECT_TRUE(rig.until([&] { return there["tolerance"] == 2.5; }));
  EXPECT_EQ(there["frame_time"], 0.125);
  budget->setValue(before.at("frame_time"));
  tolerance->setValue(before.at("tolerance"));
  EXPECT_TRUE(rig.until([&] { return there == before; }));
}

// Bars show how the trees move: the classes sum to the number of trees, and a value that no node
// reports is hidden.
TEST_F(ToolsTest, ThePanelShowsHowTreesMove) {
  LandscapePanel panel;
  panel.initialize(&rig.manager());
  const auto shown = [&] {
    std::map<std::string, int> out;
    for (QLabel* label : panel.findChildren<QLabel*>()) {
      const auto* grid = static_cast<QGridLayout*>(panel.layout());
      int row, column, rows, columns;
      grid->getItemPosition(grid->indexOf(label), &row, &column, &rows, &columns);
      QLayoutItem* beside = grid->itemAtPosition(row, 1);
      const auto* bar = beside ? dynamic_cast<QProgressBar*>(beside->widget()) : nullptr;
      if (bar && !bar->isHidden())
        out[label->text().toStdString()] = bar->format().section(' ', 0, 0).toInt();
    }
    return out;
  };
  EXPECT_TRUE(shown().empty());
  EXPECT_TRUE(rig.until([&] {
    auto trees = shown();
    return trees.count("Trees still") &&
           trees["Trees still"] + trees["Trees procedural"] + trees["Trees in modes"] == 7;
  }));
  EXPECT_EQ(shown().count("Trees physical"), 1u);
  EXPECT_EQ(shown().count("Forest, of its tick"), 1u);
  EXPECT_EQ(shown().count("People"), 0u);
  // A node has a bar from its first message until some seconds after the last one.
  const ros::Publisher diagnostics =
      rig.nodeHandle().advertise<diagnostic_msgs::DiagnosticArray>("/diagnostics", 1);
  diagnostic_msgs::DiagnosticArray people;
  people.status.resize(1);
  people.status[0].name = "agent_crowd: crowd";
  ASSERT_TRUE(rig.until([&] {
    diagnostics.publish(people);
    return shown().count("People") > 0;
  }));
  EXPECT_TRUE(rig.until([&] { return shown().count("People") == 0; }));
  EXPECT_EQ(shown().count("Trees still"), 1u);
}

// Another tool loads the saved settings of a tool, and each setting has a description.
TEST_F(ToolsTest, SettingsSurvive) {
  rviz::ToolManager& tools = *rig.manager().getToolManager();
  for (const char* name :
       {"vegetation_sim/GrabTool", "vegetation_sim/TreadTool", "vegetation_sim/WindTool"}) {
    rviz::Tool *one = tools.addTool(name), *other = tools.addTool(name);
    ASSERT_NE(one, nullptr);
    int changed = 0;
    for (auto* property : propertiesOf<rviz::Property>(*one->getPropertyContainer())) {
      EXPECT_FALSE(property->getDescription().isEmpty()) << property->getName().toStdString();
      const QVariant value = property->getValue();
      if (value.type() == QVariant::Bool)
        property->setValue(!value.toBool());
      else if (value.type() == QVariant::String)
        property->setValue("another");
      else
        property->setValue(0.5 * value.toDouble());
      changed += property->getValue() != value;
    }
    EXPECT_GT(changed, 0) << name;
    rviz::Config saved, again;
    one->save(saved);
    other->load(saved);
    other->save(again);
    int compared = 0;
    for (auto it = saved.mapIterator(); it.isValid(); it.advance(), ++compared)
      EXPECT_EQ(it.currentChild().getValue(), again.mapGetChild(it.currentKey()).getValue())
          << it.currentKey().toStdString();
    EXPECT_GT(compared, changed - 1) << name;
    tools.removeTool(tools.numTools() - 1);
    tools.removeTool(tools.numTools() - 1);
  }
}

}  // namespace
}  // namespace vegetation_sim

int main(int argc, char** argv) {
  testing::InitGoogleTest(&argc, argv);
  QApplication application(argc, argv);
  ros::init(argc, argv, "tools_rostest");
  return RUN_ALL_TESTS();
}
