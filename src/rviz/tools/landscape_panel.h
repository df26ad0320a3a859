// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <diagnostic_msgs/DiagnosticArray.h>
#include <dynamic_reconfigure/Config.h>
#include <ros/node_handle.h>
#include <ros/subscriber.h>
#include <rviz/panel.h>

#include <QDial>
#include <QDoubleSpinBox>
#include <QElapsedTimer>
#include <QGridLayout>
#include <QLabel>
#include <QProgressBar>
#include <QSlider>
#include <QTimer>
#include <map>
#include <memory>
#include <string>
#include <vector>

#include "rviz/tools/async_tasks.h"
#include "rviz/tools/wind_tool.h"

namespace vegetation_sim {

/// Panel with the wind as a dial and a slider, buttons for gusts and tornadoes, the tolerance and
/// budget of the forest, and bars of the costs by part and of how trees move: fixed, procedural,
/// modal or physical.
class LandscapePanel : public rviz::Panel {
  Q_OBJECT
 public:
  explicit LandscapePanel(QWidget* parent = nullptr);
  ~LandscapePanel() override;

  void onInitialize() override;

 private Q_SLOTS:
  void windTurned();
  void sendWind();
  void pickGust() { pickTool(WindTool::GUST); }
  void pickTornado() { pickTool(WindTool::TORNADO); }
  void look();

 private:
  // A figure of /diagnostics and its limit.
  struct Bar {
    std::string status, value, limit;
    QLabel* label;
    QProgressBar* bar;
    QElapsedTimer heard;
  };

  void addWind(QGridLayout& grid);
  void addSetting(QGridLayout& grid, const std::string& parameter, const char* title,
                  const char* unit, double least, double most);
  void addBars(QGridLayout& grid);
  static void show(const Bar& bar, bool visible);
  void pickTool(WindTool::Kind kind);
  void takeWind(const dynamic_reconfigure::Config& config);
  void takeForest(const dynamic_reconfigure::Config& config);
  void takeDiagnostics(const diagnostic_msgs::DiagnosticArray& message);
  void send(const std::string& node, const std::map<std::string, double>& values);

  QDial* direction_;
  QSlider* speed_;
  QLabel* wind_text_;
  std::map<std::string, QDoubleSpinBox*> settings_;  ///< by parameter of forest_animator
  QLabel* message_text_;
  QTimer wind_timer_, message_timer_;
  std::vector<Bar> bars_;
  ros::Subscriber wind_, forest_, diagnostics_;
  std::shared_ptr<view::Answer> answer_{std::make_shared<view::Answer>()};  // of service calls
  view::AsyncTasks tasks_;
};

}  // namespace vegetation_sim
