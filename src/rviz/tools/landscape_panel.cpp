// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#include "rviz/tools/landscape_panel.h"

#include <dynamic_reconfigure/Reconfigure.h>
#include <rviz/tool_manager.h>
#include <rviz/visualization_manager.h>

#include <QPushButton>
#include <QSignalBlocker>
#include <algorithm>
#include <cmath>
#include <pluginlib/class_list_macros.hpp>

#include "core/config/numbers.h"

namespace vegetation_sim {
namespace {

constexpr char WIND_NODE[] = "/wind_broadcaster", FOREST_NODE[] = "/forest_animator";
constexpr char TICK[] = "Time of a tick [ms]", BETWEEN_TICKS[] = "Time between ticks [ms]";
constexpr int SETTLE = 250;    // [ms] delay after the last move of the dial
constexpr int LOOK = 200;      // [ms] between checks for a reply
constexpr int SILENCE = 5000;  // [ms] without diagnostics that hide a bar
constexpr int TENTHS = 10;     // steps of the slider per m/s
constexpr int FASTEST = 250;   // steps of the slider
constexpr double DEGREE = 0.017453292519943295;

double valueOf(const diagnostic_msgs::DiagnosticStatus& status, const std::string& key,
               double other) {
  for (const diagnostic_msgs::KeyValue& entry : status.values)
    if (entry.key == key) return parseNumber(entry.value).value_or(other);
  return other;
}

QString inWords(double value) {
  return value < 1000.0 ? QString::number(value, 'g', 4) : QString::number(value, 'f', 0);
}

// The dial counts clockwise from north at the top; ROS counts counter-clockwise from east.
double toYaw(int compass) {
  return std::remainder((90.0 - compass) * DEGREE, 360.0 * DEGREE);
}

int toCompass(double yaw) {
  const int degrees = static_cast<int>(std::lround(90.0 - yaw / DEGREE));
  return ((degrees % 360) + 360) % 360;
}

}  // namespace

LandscapePanel::LandscapePanel(QWidget* parent)
    : rviz::Panel(parent),
      direction_(new QDial),
      speed_(new QSlider(Qt::Horizontal)),
      wind_text_(new QLabel),
      settings_{{"tolerance", new QDoubleSpinBox}, {"frame_time", new QDoubleSpinBox}},
      message_text_(new QLabel) {
  auto* grid = new QGridLayout;
  addWind(*grid);
  addSetting(*grid, "tolerance", "Tolerance of motion", " pixel", 0.01, 1000.0);
  addSetting(*grid, "frame_time", "Budget of motion", " ms a frame", 0.001, 1e6);
  addBars(*grid);
  message_text_->setWordWrap(true);
  grid->addWidget(message_text_, grid->rowCount(), 0, 1, 2);
  grid->setRowStretch(grid->rowCount(), 1);
  setLayout(grid);
}

LandscapePanel::~LandscapePanel() = default;

void LandscapePanel::addWind(QGridLayout& grid) {
  direction_->setRange(0, 360);
  direction_->setWrapping(true);
  direction_->setNotchesVisible(true);
  direction_->setToolTip("Where the breeze goes; north is up");
  speed_->setRange(0, FASTEST);
  speed_->setToolTip("Mean speed of the breeze");
  grid.addWidget(direction_, 0, 0, 2, 1);
  grid.addWidget(wind_text_, 0, 1);
  grid.addWidget(speed_, 1, 1);
  auto *gust = new QPushButton("Gust"), *tornado = new QPushButton("Tornado");
  gust->setToolTip("Then draw its way on the ground");
  tornado->setToolTip("Then draw its way on the ground");
  grid.addWidget(gust, 2, 0);
  grid.addWidget(tornado, 2, 1);
  connect(gust, SIGNAL(clicked()), this, SLOT(pickGust()));
  connect(tornado, SIGNAL(clicked()), this, SLOT(pickTornado()));
  connect(direction_, SIGNAL(valueChanged(int)), this, SLOT(windTurned()));
  connect(speed_, SIGNAL(valueChanged(int)), this, SLOT(windTurned()));
  connect(&wind_timer_, SIGNAL(timeout()), this, SLOT(sendWind()));
  wind_timer_.setSingleShot(true);
}

void LandscapePanel::addSetting(QGridLayout& grid, const std::string& parameter, const char* title,
                                const char* unit, double least, double most) {
  QDoubleSpinBox* box = settings_.at(parameter);
  box->setDecimals(3);
  box->setRange(least, most);
  box->setSuffix(unit);
  box->setKeyboardTracking(false);
  const int line = grid.rowCount();
  grid.addWidget(new QLabel(title), line, 0);
  grid.addWidget(box, line, 1);
  connect(box, static_cast<void (QDoubleSpinBox::*)(double)>(&QDoubleSpinBox::valueChanged), this,
          [this, parameter](double value) {
            send(FOREST_NODE, {{parameter, value}});
          });
}

void LandscapePanel::addBars(QGridLayout& grid) {
  const struct {
    const char *title, *status, *value, *limit;
  } rows[] = {
      {"Motion, of its budget", "forest_animator: governor", "Predicted frame time [ms]",
       "Frame time budget [ms]"},
      {"Forest, of its tick", "forest_animator: forest", TICK, BETWEEN_TICKS},
      {"Grass", "grass_field: grass", TICK, BETWEEN_TICKS},
      {"Leaves", "canopy_animator: canopy", TICK, BETWEEN_TICKS},
      {"People", "agent_crowd: crowd", TICK, BETWEEN_TICKS},
      {"Trees still", "forest_animator: forest", "Trees at rest", "Trees"},
      {"Trees procedural", "forest_animator: forest", "Trees that move by procedure", "Trees"},
      {"Trees in modes", "forest_animator: forest", "Trees that move in modes", "Trees"},
      {"Trees physical", "forest_animator: forest", "Physical trees", "Trees"},
      {"Frames in tf", "forest_animator: forest", "tf frames", "tf budget [frames]"},
      {"Points of markers", "forest_animator: governor", "Marker points", "Marker budget [points]"},
  };
  for (const auto& row : rows) {
    Bar bar{row.status, row.value, row.limit, new QLabel(row.title), new QProgressBar, {}};
    const int line = grid.rowCount();
    grid.addWidget(bar.label, line, 0);
    grid.addWidget(bar.bar, line, 1);
    bar.bar->setRange(0, 1000);
    show(bar, false);  // until the node publishes
    bars_.push_back(bar);
  }
}

void LandscapePanel::show(const Bar& bar, bool visible) {
  bar.label->setVisible(visible);
  bar.bar->setVisible(visible);
}

void LandscapePanel::onInitialize() {
  ros::NodeHandle nh;
  wind_ = nh.subscribe(std::string(WIND_NODE) + "/parameter_updates", 1, &LandscapePanel::takeWind,
                       this);
  forest_ = nh.subscribe(std::string(FOREST_NODE) + "/parameter_updates", 1,
                         &LandscapePanel::takeForest, this);
  diagnostics_ = nh.subscribe("/diagnostics", 10, &LandscapePanel::takeDiagnostics, this);
  connect(&message_timer_, SIGNAL(timeout()), this, SLOT(look()));
  message_timer_.start(LOOK);
}

void LandscapePanel::takeWind(const dynamic_reconfigure::Config& config) {
  if (wind_timer_.isActive()) return;  // the user moves the dial
  const QSignalBlocker dial(direction_), slider(speed_);
  for (const dynamic_reconfigure::DoubleParameter& value : config.doubles) {
    if (value.name == "breeze_speed")
      speed_->setValue(static_cast<int>(std::lround(TENTHS * value.value)));
    if (value.name == "breeze_direction") direction_->setValue(toCompass(value.value));
  }
  wind_text_->setText(QString("Breeze %1 m/s").arg(speed_->value() / double(TENTHS), 0, 'f', 1));
}

void LandscapePanel::takeForest(const dynamic_reconfigure::Config& config) {
  for (const dynamic_reconfigure::DoubleParameter& value : config.doubles) {
    const auto found = settings_.find(value.name);
    if (found == settings_.end()) continue;
    const QSignalBlocker blocker(found->second);
    found->second->setValue(value.value);
  }
}

void LandscapePanel::takeDiagnostics(const diagnostic_msgs::DiagnosticArray& message) {
  for (const diagnostic_msgs::DiagnosticStatus& status : message.status)
    for (Bar& bar : bars_) {
      if (status.name != bar.status) continue;
      const double value = valueOf(status, bar.value, 0.0), limit = valueOf(status, bar.limit, 0.0);
      const double share = limit > 0.0 ? value / limit : 0.0;
      bar.bar->setValue(static_cast<int>(1000.0 * std::min(1.0, std::max(0.0, share))));
      bar.heard.start();
      show(bar, true);
      bar.bar->setFormat(QString("%1 of %2").arg(inWords(value), inWords(limit)));
    }
}

void LandscapePanel::windTurned() {
  wind_text_->setText(QString("Breeze %1 m/s").arg(speed_->value() / double(TENTHS), 0, 'f', 1));
  wind_timer_.start(SETTLE);
}

void LandscapePanel::sendWind() {
  send(WIND_NODE, {{"breeze_speed", speed_->value() / double(TENTHS)},
                   {"breeze_direction", toYaw(direction_->value())}});
}

void LandscapePanel::send(const std::string& node, const std::map<std::string, double>& values) {
  dynamic_reconfigure::Reconfigure service;
  for (const auto& value : values) {
    dynamic_reconfigure::DoubleParameter parameter;
    parameter.name = value.first;
    parameter.value = value.second;
    service.request.config.doubles.push_back(parameter);
  }
  tasks_.add([answer = answer_, node, service]() mutable {
    const bool answered = ros::service::call(node + "/set_parameters", service);
    answer->give(answered ? "" : "no answer from " + node);
  });
}

void LandscapePanel::look() {
  if (const auto answer = answer_->take()) message_text_->setText(QString::fromStdString(*answer));
  for (const Bar& bar : bars_)
    if (bar.heard.isValid() && bar.heard.hasExpired(SILENCE)) show(bar, false);
}

void LandscapePanel::pickTool(WindTool::Kind kind) {
  rviz::ToolManager& tools = *vis_manager_->getToolManager();
  rviz::Tool* found = nullptr;
  for (int i = 0; i < tools.numTools(); ++i)
    if (dynamic_cast<WindTool*>(tools.getTool(i)) != nullptr) found = tools.getTool(i);
  if (found == nullptr) found = tools.addTool("vegetation_sim/WindTool");
  auto* tool = dynamic_cast<WindTool*>(found);
  if (tool == nullptr) return;
  tool->setKind(kind);
  tools.setCurrentTool(tool);
}

}  // namespace vegetation_sim

PLUGINLIB_EXPORT_CLASS(vegetation_sim::LandscapePanel, rviz::Panel)
