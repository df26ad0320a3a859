// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <gtest/gtest.h>

#include <algorithm>
#include <cstdlib>
#include <fstream>
#include <functional>
#include <string>

#include "rviz/rigs/holdings.h"
#include "rviz/rigs/view_rig.h"

namespace vegetation_sim {

using MakeDisplay = std::function<rviz::Display*()>;

/// Returns the number of repetitions. The environment variable sets it for long runs.
inline int timesOf(const char* variable) {
  const char* wanted = std::getenv(variable);
  return wanted != nullptr ? std::atoi(wanted) : 12;
}

/// Writes the counts about a hundred times in a long run to the table $VEGETATION_SIM_MEMORY.
class MemoryLog {
 public:
  MemoryLog(std::string what, int times, Ogre::SceneManager& scene)
      : what_(std::move(what)), every_(std::max(1, times / 100)), scene_(scene) {
    if (const char* file = std::getenv("VEGETATION_SIM_MEMORY")) out_.open(file, std::ios::app);
  }

  void note(int time) {
    if (!out_.is_open() || time % every_ != 0) return;
    out_ << what_ << ',' << time << ',' << residentMemory() << ',' << heldMemory() << ','
         << holdings(scene_) << std::endl;
  }

 private:
  std::string what_;
  int every_;
  Ogre::SceneManager& scene_;
  std::ofstream out_;
};

/// Displays are created and removed, some of them after they have drawn. They leave no object of
/// Ogre behind.
inline void expectNothingLeftBehind(ViewRig& rig, const MakeDisplay& make,
                                    const std::function<bool(rviz::Display&)>& hasDrawn) {
  Ogre::SceneManager& scene = *rig.manager().getSceneManager();
  const Holdings before = holdings(scene);
  const int times = timesOf("VEGETATION_SIM_CYCLES");
  MemoryLog log("cycles", times, scene);
  for (int i = 0; i < times; ++i) {
    rviz::Display* another = make();
    ASSERT_NE(another, nullptr);
    if (i % 4 == 0)
      ASSERT_TRUE(rig.until([&] { return hasDrawn(*another); }));
    else
      rig.frames(1);
    if (i % 2 == 0) another->reset();
    if (i % 3 == 0) another->setEnabled(false);
    rig.remove(another);
    log.note(i);
  }
  EXPECT_EQ(holdings(scene), before);
  EXPECT_EQ(scene.getFogMode(), Ogre::FOG_NONE);
}

/// Runs rviz until the counts of Ogre have been the same for some frames.
inline void expectRest(ViewRig& rig) {
  constexpr int CALM = 15;  // [frames]
  Holdings last;
  int calm = 0;
  EXPECT_TRUE(rig.until([&] {
    rig.frames(1);
    const Holdings now = holdings(*rig.manager().getSceneManager());
    calm = now == last ? calm + 1 : 0;
    last = now;
    return calm >= CALM;
  }));
}

/// A node repeatedly dies, returns with the other one of two scenes and floods its topics. The
/// display shows the last scene, and no object of earlier ones remains.
/// @param restart starts the node with scene 0 or 1. @param shows returns whether a scene is shown.
inline void expectReloadsAreFollowed(ViewRig& rig, const std::function<void(int)>& restart,
                                     const std::function<bool(int)>& shows) {
  // Within one process roscpp sometimes leaves a publisher that restarts immediately without its
  // subscribers. Such a node is restarted again.
  const auto see = [&](int scene) {
    for (int attempt = 0; attempt < 5; ++attempt) {
      restart(scene);
      if (rig.until([&] { return shows(scene); }, 6.0 * (attempt + 1))) return true;
    }
    return false;
  };
  Ogre::SceneManager& scene = *rig.manager().getSceneManager();
  ASSERT_TRUE(see(0));
  rig.frames(5);
  const Holdings before = holdings(scene).lasting();
  const int times = timesOf("VEGETATION_SIM_RELOADS");
  MemoryLog log("reloads", times, scene);
  for (int i = 1; i < times; ++i) {
    if (i % 4 == 1) {
      ASSERT_TRUE(see(i % 2)) << "reload " << i;
      // The count is always taken with the same scene, and not while messages or transitions are
      // under way.
      expectRest(rig);
      log.note(i);
    } else {
      restart(i % 2);
      rig.frames(1);
    }
  }
  ASSERT_TRUE(see(0));
  rig.frames(5);
  EXPECT_EQ(holdings(scene).lasting(), before);
}

}  // namespace vegetation_sim
