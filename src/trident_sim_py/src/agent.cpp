// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#include "agent.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "trident_base/angle.h"
#include "trident_base/error.h"
#include "trident_control/control_types.h"

namespace trident::sim {

using Team = Span<const std::unique_ptr<Agent>>;

/// Parts of observations. Each writes its numbers and returns the place behind them.
struct Blocks {
  struct Block {
    const char* name;
    std::size_t (*size)(const Agent&, std::size_t agents);
    float* (*write)(const Agent&, Team, float*);
  };

  template <class Values>
  static float* put(const Values& values, float* out) {
    return std::transform(values.data(), values.data() + values.size(), out,
                          [](double value) { return static_cast<float>(value); });
  }
  /// Of what rounding may carry beyond 1.
  template <class Values>
  static float* put_unit(const Values& values, float* out) {
    return std::transform(values.data(), values.data() + values.size(), out, [](double value) {
      return static_cast<float>(std::clamp(value, -1.0, 1.0));
    });
  }
  template <std::size_t kSize>
  static std::size_t fixed(const Agent& /*agent*/, std::size_t /*agents*/) {
    return kSize;
  }
  static Eigen::Vector3d offset(const Agent& a) { return a.goal_.p_world - a.now_.T_world_model.p; }

  static float* goal_offset(const Agent& a, Team /*team*/, float* out) {
    return put(offset(a), out);
  }
  static float* goal_offset_body(const Agent& a, Team /*team*/, float* out) {
    return put(Eigen::Vector3d(a.now_.R_world_model.transpose() * offset(a)), out);
  }
  static float* goal_heading(const Agent& a, Team /*team*/, float* out) {
    const double angle = a.goal_.yaw_rad - a.yaw();
    // Cosine and sine, which do not jump at +-pi.
    return put_unit(std::array{std::cos(angle), std::sin(angle)}, out);
  }
  static float* rotation(const Agent& a, Team /*team*/, float* out) {
    const Eigen::Matrix3d by_rows = a.now_.R_world_model.transpose();  // stored column by column
    return put_unit(by_rows, out);
  }
  // The world's up in body axes: the attitude without the heading.
  static float* up(const Agent& a, Team /*team*/, float* out) {
    return put_unit(Eigen::Vector3d(a.now_.R_world_model.row(2)), out);
  }
  static float* quaternion(const Agent& a, Team /*team*/, float* out) {
    const Eigen::Vector4d q = a.now_.T_world_model.R.coeffs();
    // q and -q are one rotation; a learner shall see one of them.
    return put_unit(Eigen::Vector4d(q.w() < 0.0 ? -q : q), out);
  }
  static float* velocity(const Agent& a, Team /*team*/, float* out) {
    return put(a.now_.v_world, out);
  }
  static float* velocity_body(const Agent& a, Team /*team*/, float* out) {
    return put(Eigen::Vector3d(a.now_.R_world_model.transpose() * a.now_.v_world), out);
  }
  static float* rates(const Agent& a, Team /*team*/, float* out) { return put(a.now_.w_body, out); }
  static float* action(const Agent& a, Team /*team*/, float* out) { return put(a.action_, out); }
  static std::size_t action_size(const Agent& a, std::size_t /*agents*/) {
    return a.action_.size();
  }
  static float* scan(const Agent& a, Team /*team*/, float* out) { return put(a.beams_, out); }
  static std::size_t scan_size(const Agent& a, std::size_t /*agents*/) { return a.beams_.size(); }
  static float* others(const Agent& a, Team team, float* out) {
    for (const auto& other : team) {
      if (other.get() == &a) continue;
      out = put(Eigen::Vector3d(other->now_.T_world_model.p - a.now_.T_world_model.p), out);
    }
    return out;
  }
  static std::size_t others_size(const Agent& /*agent*/, std::size_t agents) {
    return 3 * (agents - 1);
  }

  static constexpr std::size_t kCount = 12;
  static const Block kTable[kCount];
};

const Blocks::Block Blocks::kTable[Blocks::kCount] = {
    {"goal_offset", fixed<3>, goal_offset},
    {"goal_offset_body", fixed<3>, goal_offset_body},
    {"goal_heading", fixed<2>, goal_heading},
    {"rotation", fixed<9>, rotation},
    {"quaternion", fixed<4>, quaternion},
    {"up", fixed<3>, up},
    {"velocity", fixed<3>, velocity},
    {"velocity_body", fixed<3>, velocity_body},
    {"rates", fixed<3>, rates},
    {"action", action_size, action},
    {"scan", scan_size, scan},
    {"others", others_size, others},
};

namespace {

std::size_t block_number(const std::string& name) {
  std::string legal;
  for (std::size_t i = 0; i < Blocks::kCount; ++i) {
    if (name == Blocks::kTable[i].name) return i;
    legal += (legal.empty() ? "" : ", ") + std::string(Blocks::kTable[i].name);
  }
  throw Error("observations: '" + name + "', legal: " + legal);
}

const Model& model_named(const std::string& name, const World& world) {
  const Model* model = world.find_model(name);
  if (model == nullptr || model->links.empty()) {
    throw Error("agent: the world has no model '" + name + "' with a link");
  }
  return *model;
}

}  // namespace

std::vector<std::string> block_names() {
  std::vector<std::string> names;
  for (const Blocks::Block& block : Blocks::kTable) names.emplace_back(block.name);
  return names;
}

Agent::Agent(const AgentSpec& spec, World& world)
    : model_(&model_named(spec.model, world)),
      actuator_(make_actuator(spec.actuator, world.ports())),
      beams_(spec.beams, 1.0F),
      nearest_beam_m_(std::numeric_limits<double>::infinity()),
      action_(actuator_->size(), 0.0F),
      last_(actuator_->size(), 0.0F),
      command_(actuator_->size(), 0.0) {
  for (const std::string& name : spec.blocks) blocks_.push_back(block_number(name));
  if (!spec.scan.empty()) {
    scan_ = world.ports().find_out<LaserScanSample>(spec.scan);
    if (scan_ == nullptr) throw Error("agent: '" + spec.scan + "' is not the output of a lidar");
  }
  look();
}

void Agent::begin(const Goal& goal) {
  look();
  actuator_->begin(*model_);
  std::fill(action_.begin(), action_.end(), 0.0F);
  std::fill(last_.begin(), last_.end(), 0.0F);
  set_goal(goal);
}

void Agent::set_goal(const Goal& goal) {
  goal_ = goal;
  distance_m_ = (goal_.p_world - now_.T_world_model.p).norm();
}

void Agent::act(Span<const float> action, double period_s) {
  // The last action is kept for the reward's term of change.
  std::swap(action_, last_);
  for (std::size_t i = 0; i < action_.size(); ++i) {
    action_[i] = std::clamp(action[i], -1.0F, 1.0F);
    // Actions in [-1, 1] span the range of each command about its middle.
    command_[i] = actuator_->middle(i) + actuator_->reach(i) * static_cast<double>(action_[i]);
  }
  actuator_->apply(command_, *model_, period_s);
}

void Agent::look() {
  const Link& link = *model_->canonical_link();
  now_.T_world_model = model_->T_world_model();
  now_.R_world_model = now_.T_world_model.R.toRotationMatrix();
  now_.v_world = link.v_world_at(now_.T_world_model.p);
  now_.w_body = now_.R_world_model.transpose() * link.w_world();
  now_.has_contact = std::any_of(model_->bodies.begin(), model_->bodies.end(),
                                 [](const auto& body) { return body->has_contact(); });
  if (scan_ != nullptr && !beams_.empty()) reduce_scan();
}

/// Each beam is the nearest of its share of the ranges.
void Agent::reduce_scan() {
  const LaserScanSample& sample = scan_->value;
  const std::size_t count = sample.ranges.size();
  // Nothing in range is infinite in the scan, and the largest range here.
  const auto largest = static_cast<float>(sample.range_max_m);
  float nearest = std::numeric_limits<float>::infinity();
  for (std::size_t beam = 0; beam < beams_.size(); ++beam) {
    float range = largest;
    for (std::size_t i = beam * count / beams_.size(); i < (beam + 1) * count / beams_.size(); ++i)
      range = std::min(range, sample.ranges[i]);
    range = std::max(range, 0.0F);  // too near
    if (count > 0) nearest = std::min(nearest, range);
    beams_[beam] = count > 0 ? range / largest : 1.0F;
  }
  nearest_beam_m_ = nearest;
}

std::size_t Agent::observation_size(std::size_t count) const {
  std::size_t sum = 0;
  for (const std::size_t number : blocks_) sum += Blocks::kTable[number].size(*this, count);
  return sum;
}

void Agent::observe(Team team, float* out) const {
  for (const std::size_t number : blocks_) out = Blocks::kTable[number].write(*this, team, out);
}

double Agent::yaw() const { return control::yaw_from_quaternion(now_.T_world_model.R); }

double Agent::nearest(Team team) const {
  double least = nearest_beam_m_;
  for (const auto& other : team) {
    if (other.get() == this) continue;
    least = std::min(least, (other->now_.T_world_model.p - now_.T_world_model.p).norm());
  }
  return least;
}

Terms Agent::judge(Team team) {
  double effort = 0.0, change = 0.0;
  for (std::size_t i = 0; i < action_.size(); ++i) {
    const double value = action_[i], difference = value - last_[i];
    effort += value * value;
    change += difference * difference;
  }
  // Means over the numbers of the action: weights do not depend on how many rotors there are.
  const auto numbers = static_cast<double>(std::max<std::size_t>(action_.size(), 1));
  const double distance = (goal_.p_world - now_.T_world_model.p).norm();
  Terms terms;
  auto& t = terms.values;
  t[Terms::kDistance] = distance;
  // Potential-based, so that its sum over an episode is the distance gained, however it was flown.
  t[Terms::kProgress] = distance_m_ - distance;
  t[Terms::kSpeed] = now_.v_world.norm();
  t[Terms::kTurnRate] = now_.w_body.norm();
  t[Terms::kUp] = now_.R_world_model(2, 2);
  t[Terms::kHeading] = std::abs(wrap_to_pi(goal_.yaw_rad - yaw()));
  t[Terms::kEffort] = effort / numbers;
  t[Terms::kChange] = change / numbers;
  t[Terms::kContact] = now_.has_contact ? 1.0 : 0.0;
  t[Terms::kNearest] = nearest(team);
  distance_m_ = distance;
  return terms;
}

}  // namespace trident::sim
