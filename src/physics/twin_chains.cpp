// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#include "vegetation_sim/physics/twin_chains.h"

#include <algorithm>
#include <cmath>
#include <string>

#include "physics/twin_sweep.h"
#include "vegetation_sim/common/faults.h"

namespace vegetation_sim::physics {
namespace {

std::size_t blockOf(const TwinStore& store, int tree, int place) {
  return static_cast<std::size_t>(tree / ROW) * store.joints.size() +
         static_cast<std::size_t>(place);
}

float* laneOf(Rows& rows, std::size_t block, int quantities, int tree) {
  return rows.at(block * static_cast<std::size_t>(quantities)) + tree % ROW;
}

void check(const std::vector<std::vector<Link>>& trees) {
  Faults faults;
  for (std::size_t t = 1; t < trees.size(); ++t) {
    const std::string name = "tree " + std::to_string(t);
    if (trees[t].size() != trees[0].size()) {
      faults.add(name + ": " + std::to_string(trees[t].size()) + " links; as many as tree 0, " +
                 std::to_string(trees[0].size()));
      continue;
    }
    for (std::size_t i = 0; i < trees[t].size(); ++i)
      if (trees[t][i].parent != trees[0][i].parent)
        faults.add(name + ", link " + std::to_string(i) + ": parent " +
                   std::to_string(trees[t][i].parent) + "; as in tree 0, " +
                   std::to_string(trees[0][i].parent));
  }
  faults.throwIfAny();
}

}  // namespace

TwinChains::TwinChains(TwinChains&&) noexcept = default;
TwinChains& TwinChains::operator=(TwinChains&&) noexcept = default;
TwinChains::~TwinChains() = default;

TwinChains::TwinChains(const std::vector<std::vector<Link>>& trees)
    : store_(std::make_unique<TwinStore>()),
      links_(trees.empty() ? 0 : trees[0].size()),
      bases_(trees.size()),
      theta_(trees.size(), 0.5),
      products_(trees.size(), 1.0),
      fastest_(trees.size(), 0.f),
      loaded_(trees.size(), 0) {
  check(trees);
  if (links_ == 0) return;
  order(trees[0]);
  fill(trees);
}

// Depth first: a link's sub-tree follows it.
void TwinChains::order(const std::vector<Link>& links) {
  std::vector<std::vector<int>> children(links.size());
  std::vector<int> waiting, depth(links.size(), 0);
  root_.resize(links.size());
  for (std::size_t i = 0; i < links.size(); ++i) {
    const auto p = static_cast<std::size_t>(std::max(links[i].parent, 0));
    root_[i] = links[i].parent < 0 ? store_->roots++ : root_[p];
    depth[i] = links[i].parent < 0 ? 0 : depth[p] + 1;
    (links[i].parent < 0 ? waiting : children[p]).push_back(static_cast<int>(i));
  }
  place_.resize(links.size());
  while (!waiting.empty()) {
    const auto i = static_cast<std::size_t>(waiting.back());
    waiting.pop_back();
    place_[i] = static_cast<int>(store_->joints.size());
    TwinJoint joint;
    joint.depth = depth[i];
    joint.root = links[i].parent < 0 ? root_[i] : -1;
    joint.leaf = children[i].empty();
    // The first to wait is the last to go.
    joint.last = links[i].parent >= 0 &&
                 children[static_cast<std::size_t>(links[i].parent)][0] == static_cast<int>(i);
    store_->joints.push_back(joint);
    waiting.insert(waiting.end(), children[i].begin(), children[i].end());
  }
  const int deepest = *std::max_element(depth.begin(), depth.end());
  store_->stack.assign(static_cast<std::size_t>(deepest + 1) * P_ROWS);
}

void TwinChains::fill(const std::vector<std::vector<Link>>& trees) {
  TwinStore& store = *store_;
  const int count = static_cast<int>(trees.size()), packs = (count + ROW - 1) / ROW;
  const std::size_t blocks = static_cast<std::size_t>(packs) * links_;
  store.constants.assign(blocks * C_ROWS);
  store.state.assign(blocks * S_ROWS);
  store.loads.assign(blocks * L_ROWS);
  store.bases.assign(static_cast<std::size_t>(packs * store.roots) * F_ROWS);
  store.work.assign(links_ * W_ROWS);
  store.kept.assign(links_ * K_ROWS);
  for (TwinJoint& joint : store.joints) joint.bar = true;
  for (int tree = 0; tree < packs * ROW; ++tree)
    for (std::size_t i = 0; i < links_; ++i) {
      const std::size_t block = blockOf(store, tree, place_[i]);
      float* constants = laneOf(store.constants, block, C_ROWS, tree);
      laneOf(store.state, block, S_ROWS, tree)[S_THETA * ROW] = 0.5f;
      laneOf(store.state, block, S_ROWS, tree)[S_PRODUCTS * ROW] = 1.f;
      fillNobody(C_ROWS, constants);
      if (tree >= count) continue;
      const Link& link = trees[static_cast<std::size_t>(tree)][i];
      fillLink(link, C_ROWS, constants);
      TwinJoint& joint = store.joints[static_cast<std::size_t>(place_[i])];
      joint.bar = joint.bar && isBar(link);
    }
  for (const std::vector<Link>& tree : trees) {
    root_base_.emplace_back();
    for (const Link& link : tree)
      if (link.parent < 0) root_base_.back().push_back(link.base);
  }
  for (int tree = 0; tree < count; ++tree) fillBases(tree);
}

void TwinChains::setState(int tree, const ChainState& state, double theta) {
  float& fastest = fastest_[static_cast<std::size_t>(tree)];
  fastest = 0.f;
  theta_[static_cast<std::size_t>(tree)] = theta;
  for (std::size_t i = 0; i < links_; ++i) {
    float* rows = laneOf(store_->state, blockOf(*store_, tree, place_[i]), S_ROWS, tree);
    for (int axis = 0; axis < 2; ++axis) {
      rows[(S_Q + axis) * ROW] = static_cast<float>(state.q[i][axis]);
      rows[(S_RATE + axis) * ROW] = static_cast<float>(state.rate[i][axis]);
      fastest = std::max(fastest, std::fabs(rows[(S_RATE + axis) * ROW]));
    }
    rows[S_THETA * ROW] = static_cast<float>(theta);
  }
}

void TwinChains::setProducts(Products products) {
  store_->mean = products == Products::MEAN;
}

ChainState TwinChains::state(int tree) const {
  ChainState out;
  for (std::size_t i = 0; i < links_; ++i) {
    const float* rows = laneOf(store_->state, blockOf(*store_, tree, place_[i]), S_ROWS, tree);
    out.q.emplace_back(rows[S_Q * ROW], rows[(S_Q + 1) * ROW]);
    out.rate.emplace_back(rows[S_RATE * ROW], rows[(S_RATE + 1) * ROW]);
  }
  return out;
}

// ---- what acts ---------------------------------------------------------------------------------

const BaseMotion& TwinChains::baseOf(int tree, int root) const {
  static const BaseMotion GROUND;
  const auto t = static_cast<std::size_t>(tree);
  const auto base = static_cast<std::size_t>(root_base_[t][static_cast<std::size_t>(root)]);
  return base < bases_[t].size() ? bases_[t][base] : GROUND;
}

void TwinChains::fillBases(int tree) {
  for (int root = 0; root < store_->roots; ++root) {
    const BaseRows base = baseRows(baseOf(tree, root));
    const auto block = static_cast<std::size_t>(tree / ROW * store_->roots + root);
    float* rows = laneOf(store_->bases, block, F_ROWS, tree);
    for (int row = 0; row < F_ROWS; ++row) rows[row * ROW] = base.value[row];
  }
}

void TwinChains::setBases(int tree, const std::vector<BaseMotion>& bases) {
  bases_[static_cast<std::size_t>(tree)] = bases;
  fillBases(tree);
}

void TwinChains::setLoads(int tree, const Loads& loads) {
  for (std::size_t i = 0; i < links_; ++i)
    fillLoad(loads, i, laneOf(store_->loads, blockOf(*store_, tree, place_[i]), L_ROWS, tree));
  loaded_[static_cast<std::size_t>(tree)] = 1;
  store_->drag = store_->drag || !loads.drag.empty();
}

void TwinChains::ask(const Surroundings& around, double time, double h, int tree) {
  const auto t = static_cast<std::size_t>(tree);
  const auto motion = [&](std::size_t link) {
    return laneOf(store_->motion, static_cast<std::size_t>(place_[link]), M_ROWS, tree);
  };
  loads_.clear(links_);
  if (around.loads) {
    resize(kinematics_, links_);
    for (std::size_t i = 0; i < links_; ++i)
      readMotion(motion(i), baseOf(tree, root_[i]).pose.position, i, kinematics_);
    around.loads(kinematics_, time, loads_);
  }
  if (around.loads || loaded_[t]) setLoads(tree, loads_);
  loaded_[t] = static_cast<bool>(around.loads);
  for (const Anchor& anchor : loads_.anchors) {
    const auto link = static_cast<std::size_t>(anchor.link);
    store_->anchors.push_back(anchorRows(anchor, place_[link] * ROW + tree % ROW, theta_[t] * h));
  }
}

// ---- steps -------------------------------------------------------------------------------------

void TwinChains::guard(int pack, double h) {
  const std::size_t begin = static_cast<std::size_t>(pack) * links_;
  for (int lane = 0; lane < ROW && pack * ROW + lane < treeCount(); ++lane) {
    const auto tree = static_cast<std::size_t>(pack * ROW + lane);
    const double theta = thetaFor(fastest_[tree], h, theta_[tree]),
                 products = productsFor(fastest_[tree], h);
    if (theta == theta_[tree] && products == products_[tree]) continue;
    theta_[tree] = theta;
    products_[tree] = products;
    for (std::size_t block = begin; block < begin + links_; ++block) {
      float* rows = store_->state.at(block * S_ROWS) + lane;
      rows[S_THETA * ROW] = static_cast<float>(theta);
      rows[S_PRODUCTS * ROW] = static_cast<float>(products);
    }
  }
}

void TwinChains::step(const Surroundings* around, double time, double h) {
  const auto step = static_cast<float>(h);
  for (int pack = 0; pack * ROW < treeCount() && links_ > 0; ++pack) {
    guard(pack, h);
    const int begin = pack * ROW, end = std::min(begin + ROW, treeCount());
    for (int tree = begin; around && tree < end; ++tree) {
      std::vector<BaseMotion>& bases = bases_[static_cast<std::size_t>(tree)];
      bases.clear();
      if (around[tree].bases) around[tree].bases(time + theta(tree) * h, bases);
      fillBases(tree);
    }
    sweepPackOut(pack, step, *store_);
    store_->anchors.clear();
    for (int tree = begin; around && tree < end; ++tree)
      ask(around[tree], time + theta(tree) * h, h, tree);
    std::stable_sort(store_->anchors.begin(), store_->anchors.end(),
                     [](const AnchorRows& a, const AnchorRows& b) { return a.slot < b.slot; });
    sweepPackBack(pack, step, *store_);
    std::copy_n(store_->fastest, end - begin, fastest_.begin() + begin);
  }
}

void TwinChains::step(const std::vector<Surroundings>& around, double time, double h) {
  if (around.size() != theta_.size())
    throw InvalidInput("surroundings: " + std::to_string(around.size()) + "; one for each of the " +
                       std::to_string(theta_.size()) + " trees");
  store_->trace = std::any_of(around.begin(), around.end(),
                              [](const Surroundings& s) { return static_cast<bool>(s.loads); });
  if (store_->trace && store_->motion.empty()) store_->motion.assign(links_ * M_ROWS);
  step(around.data(), time, h);
}

void TwinChains::step(double h) {
  store_->trace = false;
  step(nullptr, 0.0, h);
}

}  // namespace vegetation_sim::physics
