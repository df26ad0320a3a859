// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#include <mujoco/mujoco.h>

#include <cstdio>
#include <filesystem>
#include <fstream>
#include <limits>
#include <sstream>
#include <stdexcept>

#include "trees/engine.h"

namespace vegetation_sim::bench {
namespace {

// The tree in MuJoCo's file format, nested as its bodies are.
class Description {
 public:
  explicit Description(const TestTree& tree) : tree_(tree), children_(tree.links.size()) {
    out_.precision(17);
    out_ << "<mujoco><compiler angle='radian' boundmass='0' boundinertia='0'/>"
            "<size njmax='1' nconmax='1'/><worldbody>";
    for (std::size_t i = 0; i < tree.links.size(); ++i)
      if (tree.links[i].parent >= 0)
        children_[static_cast<std::size_t>(tree.links[i].parent)].push_back(i);
    for (std::size_t i = 0; i < tree.links.size(); ++i)
      if (tree.links[i].parent < 0) body(i);
    out_ << "</worldbody></mujoco>";
  }
  std::string text() const { return out_.str(); }

 private:
  void body(std::size_t i) {
    const TestLink& l = tree_.links[i];
    const double centre = 0.5 * l.length, across = l.across - l.mass * centre * centre;
    out_ << "<body name='" << i << "' pos='0 0 " << l.h << "' quat='" << l.rest.w << ' ' << l.rest.x
         << ' ' << l.rest.y << ' ' << l.rest.z << "'><inertial pos='0 0 " << centre << "' mass='"
         << l.mass << "' diaginertia='" << across << ' ' << across << ' ' << l.along << "'/>";
    for (const char* axis : {"1 0 0", "0 1 0"})
      out_ << "<joint type='hinge' axis='" << axis << "' stiffness='" << l.stiffness
           << "' damping='" << l.damping << "'/>";
    for (const std::size_t child : children_[i]) body(child);
    out_ << "</body>";
  }

  const TestTree& tree_;
  std::vector<std::vector<std::size_t>> children_;
  std::ostringstream out_;
};

// Compiling 10 000 bodies takes most of a minute, so the result is kept by the tree's hash.
mjModel* modelOf(const TestTree& tree, const std::string& cache) {
  namespace fs = std::filesystem;
  char name[40];
  std::snprintf(name, sizeof name, "%016llx.mjb", static_cast<unsigned long long>(tree.hash()));
  const fs::path folder = cache.empty() ? fs::temp_directory_path() : fs::path(cache);
  const fs::path kept = folder / name;
  if (!cache.empty() && fs::exists(kept)) return mj_loadModel(kept.c_str(), nullptr);
  const fs::path file = folder / (std::string(name) + ".xml");
  std::ofstream(file) << Description(tree).text();
  char error[500] = "";
  mjModel* out = mj_loadXML(file.c_str(), nullptr, error, sizeof error);
  fs::remove(file);
  if (!out) throw std::runtime_error(std::string("MuJoCo: ") + error);
  if (!cache.empty()) mj_saveModel(out, kept.c_str(), nullptr, 0);
  return out;
}

// The tree in the engine, stepped by one of its integrators.
class MujocoEngine : public Engine {
 public:
  MujocoEngine(const TestTree& tree, const TestLoad& load, int integrator, const std::string& cache)
      : tree_(tree), load_(load), model_(modelOf(tree, cache)) {
    // Derivatives of velocity products need memory of the order of the branches squared.
    if (integrator == mjINT_IMPLICIT) model_->nstack += 100 * model_->nbody * model_->nv;
    data_ = mj_makeData(model_);
    mju_user_warning = [](const char*) {};  // an unstable step is found by its error, not in a log
    // It is called at every evaluation, so that Runge-Kutta uses the load of its stages.
    mjcb_control = [](const mjModel* model, mjData* data) {
      const bool stages = model->opt.integrator == mjINT_RK4;
      if (running_) running_->push(stages ? data->time : data->time + 0.5 * model->opt.timestep);
    };
    model_->opt.integrator = integrator;
    model_->opt.gravity[2] = 0.0;
    model_->opt.disableflags = mjDSBL_CONSTRAINT | mjDSBL_CONTACT | mjDSBL_GRAVITY |
                               mjDSBL_ACTUATION | mjDSBL_WARMSTART | mjDSBL_EQUALITY |
                               mjDSBL_LIMIT | mjDSBL_FRICTIONLOSS;
    for (int body = 1; body < model_->nbody; ++body)
      links_.push_back(std::stoi(mj_id2name(model_, mjOBJ_BODY, body)));
    bodies_.resize(links_.size());
    for (std::size_t i = 0; i < links_.size(); ++i)
      bodies_[static_cast<std::size_t>(links_[i])] = static_cast<int>(i) + 1;
    wrench_.resize(static_cast<std::size_t>(model_->nbody));
  }
  ~MujocoEngine() override { mj_deleteData(data_), mj_deleteModel(model_); }
  MujocoEngine(const MujocoEngine&) = delete;
  MujocoEngine& operator=(const MujocoEngine&) = delete;

  void rest() override { mj_resetData(model_, data_); }

  void step(int interval, double time, double h) override {
    model_->opt.timestep = h;
    data_->time = time;
    interval_ = interval;
    running_ = this;
    mj_step(model_, data_);
    running_ = nullptr;
    for (const int fault : {mjWARN_BADQPOS, mjWARN_BADQVEL, mjWARN_BADQACC})
      if (data_->warning[fault].number > 0)
        data_->qpos[0] = std::numeric_limits<double>::quiet_NaN();  // the engine has reset itself
  }

  std::vector<Vec3> tips() const override {
    std::vector<double> q(2 * tree_.links.size());
    for (std::size_t i = 0; i < bodies_.size(); ++i)
      for (std::size_t k = 0; k < 2; ++k)
        q[2 * i + k] =
            data_->qpos[model_->jnt_qposadr[model_->body_jntadr[bodies_[i]]] + static_cast<int>(k)];
    return tipsOf(tree_, Bend::HINGES, q);
  }

 protected:
  // Sums the generalised forces in one sweep towards the root; xfrc_applied would cost O(N nv).
  void push(double time) {
    const double factor = load_.factor(interval_, time);
    if (factor == 0.0) {
      mju_zero(data_->qfrc_applied, model_->nv);
      return;
    }
    std::fill(wrench_.begin(), wrench_.end(), Wrench());
    int last = 0;
    for (std::size_t i = 0; i < load_.links.size(); ++i) {
      const int body = bodies_[static_cast<std::size_t>(load_.links[i])];
      const Eigen::Map<const Eigen::Matrix<double, 3, 3, Eigen::RowMajor>> turn(data_->xmat +
                                                                                9 * body);
      const Vec3 force = factor * load_.force[i], arm = load_.along[i] * turn.col(2);
      wrench_[static_cast<std::size_t>(body)] = {force, arm.cross(force)};
      last = std::max(last, body);
    }
    for (int body = last; body > 0; --body) project(body);
  }

  const TestTree& tree_;
  const TestLoad& load_;
  mjModel* model_;
  mjData* data_{nullptr};
  int interval_{0};

 private:
  struct Wrench {
    Vec3 force{Vec3::Zero()}, torque{Vec3::Zero()};
  };

  void project(int body) {
    const Wrench& own = wrench_[static_cast<std::size_t>(body)];
    const int joint = model_->body_jntadr[body], parent = model_->body_parentid[body];
    for (int k = 0; k < 2; ++k)
      data_->qfrc_applied[model_->jnt_dofadr[joint + k]] =
          Eigen::Map<const Vec3>(data_->xaxis + 3 * (joint + k)).dot(own.torque);
    const Vec3 arm = Eigen::Map<const Vec3>(data_->xpos + 3 * body) -
                     Eigen::Map<const Vec3>(data_->xpos + 3 * parent);
    Wrench& bearer = wrench_[static_cast<std::size_t>(parent)];
    bearer.force += own.force;
    bearer.torque += own.torque + arm.cross(own.force);
  }

  static thread_local MujocoEngine* running_;
  std::vector<int> links_, bodies_;  // of bodies, of links
  std::vector<Wrench> wrench_;       // about the body's joint
};

thread_local MujocoEngine* MujocoEngine::running_ = nullptr;

// Our integrator (the linearly implicit midpoint with averaged velocity products) with the engine's
// dynamics: what springs and dampers add implicitly is armature, h^2 k / 4 + h d / 2.
class MidpointMujoco final : public MujocoEngine {
 public:
  MidpointMujoco(const TestTree& tree, const TestLoad& load, const std::string& cache)
      : MujocoEngine(tree, load, mjINT_EULER, cache) {
    for (std::vector<double>* each : {&rate_, &acceleration_, &products_, &change_})
      each->resize(static_cast<std::size_t>(model_->nv));
  }

  void step(int interval, double time, double h) override {
    interval_ = interval;
    if (h != step_) setStep(h);
    const int count = model_->nv;
    mju_copy(rate_.data(), data_->qvel, count);
    mju_addToScl(data_->qpos, rate_.data(), 0.5 * h, count);
    mj_kinematics(model_, data_);
    mj_comPos(model_, data_);
    mj_crb(model_, data_);
    mj_factorM(model_, data_);
    mj_comVel(model_, data_);
    mj_passive(model_, data_);
    mj_rne(model_, data_, 0, data_->qfrc_bias);
    push(time + 0.5 * h);
    for (int i = 0; i < count; ++i)
      change_[static_cast<std::size_t>(i)] =
          data_->qfrc_passive[i] + data_->qfrc_applied[i] - data_->qfrc_bias[i];
    mj_solveM(model_, data_, acceleration_.data(), change_.data(), 1);
    averageProducts(h);
    // The positions are already half a step ahead at the old rate.
    mju_addToScl(data_->qpos, rate_.data(), 0.5 * h, count);
    mju_addToScl(data_->qpos, acceleration_.data(), 0.5 * h * h, count);
    mju_addScl(data_->qvel, rate_.data(), acceleration_.data(), h, count);
  }

 private:
  void setStep(double h) {
    step_ = h;
    for (int joint = 0; joint < model_->njnt; ++joint) {
      const int dof = model_->jnt_dofadr[joint];
      model_->dof_armature[dof] =
          0.25 * h * h * model_->jnt_stiffness[joint] + 0.5 * h * model_->dof_damping[dof];
    }
  }

  // Replaces the velocity products at the start by the mean of those at start and end.
  void averageProducts(double h) {
    const int count = model_->nv;
    mju_addScl(data_->qvel, rate_.data(), acceleration_.data(), h, count);
    mj_comVel(model_, data_);
    mj_rne(model_, data_, 0, products_.data());
    mju_sub(change_.data(), data_->qfrc_bias, products_.data(), count);
    mj_solveM(model_, data_, products_.data(), change_.data(), 1);
    mju_addToScl(acceleration_.data(), products_.data(), 0.5, count);
  }

  double step_{0.0};
  std::vector<double> rate_, acceleration_, products_, change_;
};

template <int INTEGRATOR>
std::unique_ptr<Engine> make(const TestTree& tree, const TestLoad& load, const std::string& cache) {
  return std::make_unique<MujocoEngine>(tree, load, INTEGRATOR, cache);
}

std::unique_ptr<Engine> makeMidpoint(const TestTree& tree, const TestLoad& load,
                                     const std::string& cache) {
  return std::make_unique<MidpointMujoco>(tree, load, cache);
}

Maker maker(const char* name, decltype(Maker::make) make,
            int most_branches = Maker().most_branches) {
  Maker out;
  out.most_branches = most_branches;
  out.name = name;
  out.peer = true;
  out.bend = Bend::HINGES;
  out.make = make;
  return out;
}

}  // namespace

std::vector<Maker> mujocoEngines() {
  return {maker("MuJoCo, Euler", make<mjINT_EULER>), maker("MuJoCo, RK4", make<mjINT_RK4>),
          maker("MuJoCo, implicit", make<mjINT_IMPLICIT>, 100),
          maker("MuJoCo, our midpoint", makeMidpoint)};
}

}  // namespace vegetation_sim::bench
