// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
// A node may be destroyed at any time while another thread runs its callbacks, as a nodelet that is
// unloaded. The launch file sets MALLOC_PERTURB_, so that memory that is freed does not look valid.
#include "nodes/base/node_base.h"

#include <dynamic_reconfigure/Reconfigure.h>
#include <gtest/gtest.h>
#include <malloc.h>
#include <ros/callback_queue.h>
#include <unistd.h>
#include <vegetation_sim/Viewer.h>

#include <atomic>
#include <boost/make_shared.hpp>
#include <chrono>
#include <condition_variable>
#include <fstream>
#include <future>
#include <limits>
#include <memory>
#include <mutex>
#include <new>
#include <string>
#include <thread>
#include <vector>

#include "nodes/base/closable_queue.h"
#include "nodes/base/freed_memory.h"
#include "nodes/canopy/canopy_animator.h"
#include "nodes/crowd/agent_crowd.h"
#include "nodes/forest/forest_animator.h"
#include "nodes/grass/grass_field.h"
#include "nodes/rigs/repeating.h"
#include "nodes/sensors/vegetation_camera.h"
#include "nodes/sensors/vegetation_scanner.h"
#include "nodes/wind/wind_broadcaster.h"
#include "sanitized.h"

namespace vegetation_sim {
namespace {

constexpr int LIVES = 10, CALLS = 4;  // of a node that are answered before it ends
// Of wall time; only a test that fails waits that long.
constexpr std::chrono::seconds DEADLINE{60};

/// Counts the requests that a node has answered.
class Answers {
 public:
  void add(bool answered) {
    const std::lock_guard<std::mutex> lock(mutex_);
    if (answered) ++count_;
    changed_.notify_all();
  }
  /// Waits for more answers. @return whether they came in time.
  bool wait(int more) {
    std::unique_lock<std::mutex> lock(mutex_);
    const int wanted = count_ + more;
    return changed_.wait_for(lock, DEADLINE, [&] { return count_ >= wanted; });
  }

 private:
  std::mutex mutex_;
  std::condition_variable changed_;
  int count_{0};
};

/// Creates and destroys nodes while clients call their services and a thread runs their callbacks.
class NodeEnd : public testing::Test {
 protected:
  template <class Node>
  void liveAndEnd(const std::string& name, const std::string& scenario) {
    if (!scenario.empty())
      ros::param::set("/" + name + "/scenario", "package://vegetation_sim/test/nodes/" + scenario);
    Answers answers;
    // As a nodelet manager does, which calls nothing of a nodelet that ends, but does not wait for
    // the callback that runs.
    std::atomic<ros::CallbackQueue*> current{nullptr};
    const Repeating spinner([&] {
      if (ros::CallbackQueue* queue = current) queue->callOne(ros::WallDuration(0.001));
    });
    const Repeating resets([&] {
      std_srvs::Trigger request;
      answers.add(ros::service::call("/" + name + "/reset", request));
    });
    const Repeating tuning([&] {
      dynamic_reconfigure::Reconfigure request;
      ros::service::call("/" + name + "/set_parameters", request);
    });
    for (int life = 0; life < LIVES; ++life) {
      ros::CallbackQueue& queue = *queues_.emplace_back(std::make_unique<ros::CallbackQueue>());
      ros::NodeHandle handle, private_handle("/" + name);
      handle.setCallbackQueue(&queue);
      private_handle.setCallbackQueue(&queue);
      current = &queue;
      auto node = std::make_unique<Node>(handle, private_handle);
      ASSERT_TRUE(answers.wait(CALLS)) << name << " does not answer";
      current = nullptr;
      node.reset();
      queue.disable();
    }
  }

 private:
  std::vector<std::unique_ptr<ros::CallbackQueue>> queues_;  // the spinner may be in one
};

/// A node whose callback runs out of memory.
class ThrowingNode final : public NodeBase {
 public:
  ThrowingNode(const ros::NodeHandle& handle, const ros::NodeHandle& private_handle)
      : NodeBase("throwing_node", handle, private_handle) {
    subscribe("throwing_node/viewer", 10, &ThrowingNode::receive);
  }
  ~ThrowingNode() override { stopCallbacks(); }
  std::uint64_t refused() const { return refusals_.count(); }

 private:
  void receive(const Viewer&) { throw std::bad_alloc(); }
};

TEST_F(NodeEnd, ACallbackThatThrowsEndsAlone) {
  ros::CallbackQueue queue;
  ros::NodeHandle handle, private_handle("/throwing_node");
  handle.setCallbackQueue(&queue);
  const ThrowingNode node(handle, private_handle);
  const ros::Publisher viewers = handle.advertise<Viewer>("throwing_node/viewer", 10, true);
  viewers.publish(Viewer());
  for (int calls = 0; node.refused() == 0 && calls < 100; ++calls)
    ASSERT_NO_THROW(queue.callAvailable(ros::WallDuration(0.1)));
  EXPECT_EQ(node.refused(), 1u);
}

TEST_F(NodeEnd, MayComeWithinACallback) {
  liveAndEnd<WindBroadcaster>("wind_broadcaster", "wind/wind_scene.yaml");
  liveAndEnd<VegetationScanner>("vegetation_scanner", "");
  liveAndEnd<VegetationCamera>("vegetation_camera", "");
  liveAndEnd<ForestAnimator>("forest_animator", "scenarios/one_branch.yaml");
  liveAndEnd<GrassField>("grass_field", "scenarios/lawn.yaml");
  liveAndEnd<CanopyAnimator>("canopy_animator", "scenarios/shrubs.yaml");
  liveAndEnd<AgentCrowd>("agent_crowd", "scenarios/crowd.yaml");
}

/// Tells that it runs, and runs until it may end.
class LongCallback final : public ros::CallbackInterface {
 public:
  CallResult call() override {
    begun.set_value();
    may_end.get_future().wait();
    has_ended = true;
    return Success;
  }

  std::promise<void> begun, may_end;
  std::atomic<bool> has_ended{false};
};

// What a callback uses may be destroyed once its queue is closed.
TEST(ClosableQueue, IsClosedOnceTheCallbackThatRunsHasEnded) {
  ros::CallbackQueue target;
  ClosableQueue queue(target);
  const auto callback = boost::make_shared<LongCallback>();
  queue.addCallback(callback, 1);
  std::thread caller([&] { target.callOne(ros::WallDuration(0.0)); });
  callback->begun.get_future().wait();
  std::future<void> closing = std::async(std::launch::async, [&] { queue.close(); });
  EXPECT_EQ(closing.wait_for(std::chrono::milliseconds(100)), std::future_status::timeout);
  callback->may_end.set_value();
  closing.wait();
  EXPECT_TRUE(callback->has_ended);
  caller.join();
}

// A reset waits for the node's thread in another one, and for a shard that no node animates.
TEST_F(NodeEnd, MayComeWhileARequestIsPassedOn) {
  for (const char* name : {"/forest_shard", "/grass_shard"}) {
    ros::param::set(std::string(name) + "/shard/index", 0);
    ros::param::set(std::string(name) + "/shard/count", 2);
  }
  liveAndEnd<ForestAnimator>("forest_shard", "scenarios/one_branch.yaml");
  liveAndEnd<GrassField>("grass_shard", "scenarios/lawn.yaml");
}

/// A node that only has diagnostics.
class IdleNode final : public NodeBase {
 public:
  IdleNode(const ros::NodeHandle& handle, const ros::NodeHandle& private_handle)
      : NodeBase("idle_node", handle, private_handle) {
    startDiagnostics();
  }
  ~IdleNode() override { stopCallbacks(); }
};

double residentBytes() {
  long all = 0, resident = 0;
  std::ifstream("/proc/self/statm") >> all >> resident;
  return static_cast<double>(resident) * static_cast<double>(sysconf(_SC_PAGESIZE));
}

// glibc would take the second block from its heap, since the first one that is freed is larger.
TEST_F(NodeEnd, LargeBlocksAreReturnedAtOnceHoweverLargeThoseBeforeWere) {
  if (SANITIZED) return;  // a sanitizer replaces the allocator
  limitFreedMemory();
  { const std::vector<char> largest(16 * LARGE_BLOCK); }
  constexpr std::size_t COUNT = 100, SIZE = 2 * LARGE_BLOCK;  // more than the heap has free
  std::vector<std::vector<char>> freed, kept;
  for (std::size_t i = 0; i < COUNT; ++i) {
    freed.emplace_back(SIZE, 'a');
    kept.emplace_back(100, 'b');
  }
  const double full = residentBytes();
  freed.clear();
  EXPECT_LT(residentBytes(), full - 0.5 * COUNT * SIZE);
}

// Blocks that are kept between freed ones are what a flood of messages leaves. Where they lie
// depends on the tests before, and glibc returns what is free at the end of the heap by itself:
// it is told not to, so that only the node can.
TEST_F(NodeEnd, FreedMemoryIsReturnedToTheSystem) {
  if (SANITIZED) return;  // a sanitizer replaces the allocator
  ASSERT_EQ(mallopt(M_TRIM_THRESHOLD, std::numeric_limits<int>::max()), 1);
  constexpr std::size_t COUNT = 2000, SIZE = 50'000;  // smaller than what glibc maps on its own
  std::vector<std::vector<char>> kept, freed;
  for (std::size_t i = 0; i < COUNT; ++i) {
    freed.emplace_back(SIZE, 'a');
    kept.emplace_back(100, 'b');
  }
  const double full = residentBytes();
  freed.clear();
  ASSERT_GT(residentBytes(), full - 0.1 * COUNT * SIZE) << "the freed memory is not kept";
  ros::CallbackQueue queue;
  ros::NodeHandle handle, private_handle("/idle_node");
  handle.setCallbackQueue(&queue);
  const IdleNode node(handle, private_handle);
  for (int calls = 0; residentBytes() > full - 0.8 * COUNT * SIZE && calls < 300; ++calls)
    queue.callAvailable(ros::WallDuration(0.1));
  EXPECT_LT(residentBytes(), full - 0.8 * COUNT * SIZE);
}

}  // namespace
}  // namespace vegetation_sim

int main(int argc, char** argv) {
  testing::InitGoogleTest(&argc, argv);
  ros::init(argc, argv, "node_base_test");
  ros::start();
  return RUN_ALL_TESTS();
}
