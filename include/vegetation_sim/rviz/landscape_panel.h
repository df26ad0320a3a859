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
#include <QGridLayout>
#include <QLabel>
#include <QProgressBar>
#include <QSlider>
#include <QTimer>
#include <map>
#include <mutex>
#include <string>
#include <vector>

#include "vegetation_sim/rviz/errands.h"
#include "vegetation_sim/rviz/wind_tool.h"

namespace vegetation_sim {

/// Panel: wind with a dial and a slider, buttons for the tool that makes gusts and tornadoes, the
/// tolerance of the forest, and bars of what is spent and of what is physical.
class LandscapePanel : public rviz::Panel {
  Q_OBJECT
 public:
  explicit LandscapePanel(QWidget* parent = nullptr);
  ~LandscapePanel() override;

  void onInitialize() override;

 private Q_SLOTS:
  void windTurned();
  void sendWind();
  void sendTolerance();
  void pickGust() { pickTool(WindTool::GUST); }
  void pickTornado() { pickTool(WindTool::TORNADO); }
  void showMessage();

 private:
  // A figure of /diagnostics beside its limit.
  struct Bar {
    std::string status, value, limit;
    QLabel* label;
    QProgressBar* bar;
  };

  void addWind(QGridLayout& grid);
  void addBars(QGridLayout& grid);
  void pickTool(WindTool::Kind kind);
  void takeWind(const dynamic_reconfigure::Config& config);
  void takeForest(const dynamic_reconfigure::Config& config);
  void takeDiagnostics(const diagnostic_msgs::DiagnosticArray& message);
  void send(const std::string& node, const std::map<std::string, double>& values);

  QDial* direction_;
  QSlider* speed_;
  QLabel* wind_text_;
  QDoubleSpinBox* tolerance_;
  QLabel* message_text_;
  QTimer wind_timer_, message_timer_;
  std::vector<Bar> bars_;
  ros::Subscriber wind_, forest_, diagnostics_;
  std::mutex mutex_;     // of message_
  std::string message_;  // of the last service called
  view::Errands errands_;
};

}  // namespace vegetation_sim
