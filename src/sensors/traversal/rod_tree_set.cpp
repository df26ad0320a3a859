// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#include "sensors/traversal/rod_tree_set.h"

#include <algorithm>

namespace vegetation_sim::scan {

void RodTreeSet::set(const std::vector<const RodTree*>& trees, const Vec3& origin,
                     ThreadPool& threads) {
  buildTop(trees, origin);
  std::vector<Place> places;
  Place end{static_cast<std::int32_t>(boxes_.nodes().size()), 0};
  for (const RodTree* tree : trees) {
    places.push_back(end);
    end.node += static_cast<std::int32_t>(tree->boxes().nodes().size());
    end.group += static_cast<std::int32_t>(tree->groups().size());
  }
  nodes_.resize(static_cast<std::size_t>(end.node));
  groups_.resize(static_cast<std::size_t>(end.group));
  std::copy(boxes_.nodes().begin(), boxes_.nodes().end(), nodes_.begin());
  for (std::size_t i = 0; i < boxes_.nodes().size(); ++i)
    for (std::int32_t& child : nodes_[i].child) {
      if (child >= 0 || child == WideNode::EMPTY) continue;
      const auto tree = static_cast<std::size_t>(boxes_.item(~child, 0));
      child = trees[tree]->boxes().nodes().empty() ? WideNode::EMPTY : places[tree].node;
    }
  const std::size_t parts = threads.size();
  threads.run(parts, [&](std::size_t first) {
    for (std::size_t i = first; i < trees.size(); i += parts)
      copyTree(*trees[i], static_cast<std::uint32_t>(i), places[i]);
  });
}

void RodTreeSet::buildTop(const std::vector<const RodTree*>& trees, const Vec3& origin) {
  std::vector<Box> items;
  items.reserve(trees.size());
  for (const RodTree* tree : trees) {
    Box box = tree->bounds();
    if (box.isEmpty()) box.add(origin, 0.0);
    items.push_back({box.low - origin, box.high - origin});
  }
  boxes_.build(items);
  std::vector<Box> groups;
  groups.reserve(items.size());
  for (int group = 0; group < boxes_.groups(); ++group)
    groups.push_back(items[static_cast<std::size_t>(boxes_.item(group, 0))]);
  boxes_.fit(groups, origin);
}

void RodTreeSet::copyTree(const RodTree& tree, std::uint32_t index, const Place& place) {
  const std::vector<WideNode>& nodes = tree.boxes().nodes();
  for (std::size_t i = 0; i < nodes.size(); ++i) {
    WideNode& node = nodes_[static_cast<std::size_t>(place.node) + i];
    node = nodes[i];
    for (std::int32_t& child : node.child)
      if (child >= 0)
        child += place.node;
      else if (child != WideNode::EMPTY)
        child -= place.group;
  }
  for (std::size_t g = 0; g < tree.groups().size(); ++g) {
    const std::size_t at = static_cast<std::size_t>(place.group) + g;
    groups_[at] = tree.groups()[g];
    groups_[at].tree = index;
  }
}

}  // namespace vegetation_sim::scan
