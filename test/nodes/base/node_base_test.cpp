// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#include "nodes/base/node_base.h"

#include <gtest/gtest.h>
#include <ros/callback_queue.h>
#include <vegetation_sim/Viewer.h>

#include <new>

namespace vegetation_sim {
namespace {

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

TEST(NodeBase, ACallbackThatThrowsEndsAlone) {
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

}  // namespace
}  // namespace vegetation_sim

int main(int argc, char** argv) {
  testing::InitGoogleTest(&argc, argv);
  ros::init(argc, argv, "node_base_test");
  ros::start();
  return RUN_ALL_TESTS();
}
