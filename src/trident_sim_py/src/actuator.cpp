// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#include "actuator.h"

#include <algorithm>
#include <cmath>

#include "trident_base/error.h"
#include "trident_control/control_types.h"
#include "trident_control_sim/lee_plugin.h"
#include "trident_sim/commands.h"
#include "trident_sim/samples.h"

namespace trident::sim {
namespace {

constexpr double kLongestLeadM = 0.5;  ///< of a set-point before the vehicle that does not follow

template <class Sample>
InPort<Sample>* input(const std::string& name, const PortBoard& board) {
  if (InPort<Sample>* port = board.find_in<Sample>(name)) return port;
  throw Error("actions: '" + name + "' is not an input of this world that takes such commands");
}

class Rotors : public Actuator {
 public:
  Rotors(const ActuatorSpec& spec, const PortBoard& board)
      : Actuator(spec), port_(input<ActuatorCommand>(spec.ports.front(), board)) {}
  void apply(Span<const double> command, const Model& /*model*/, double /*period_s*/) override {
    sample_.angular_velocities.assign(command);
    port_->write(sample_);
  }

 private:
  InPort<ActuatorCommand>* port_;
  ActuatorCommand sample_;
};

/// One set-point that takes effect with the next state.
class SetPoint : public Actuator {
 public:
  SetPoint(const ActuatorSpec& spec, const PortBoard& board)
      : Actuator(spec), port_(input<control::TrajectorySample>(spec.ports.front(), board)) {
    sample_.points.resize(1);
  }

 protected:
  control::TrajectoryPoint& point() { return sample_.points.front().point; }
  void send() { port_->write(sample_); }

 private:
  InPort<control::TrajectorySample>* port_;
  control::TrajectorySample sample_;
};

class Rates : public SetPoint {
 public:
  using SetPoint::SetPoint;
  void apply(Span<const double> command, const Model& /*model*/, double /*period_s*/) override {
    point().level = control::ControlLevel::rates;
    point().w_body = Eigen::Vector3d(command.data());
    // Body rates [rad/s] and collective thrust [N].
    point().thrust = command[3];
    send();
  }
};

/// The position that the controller holds moves at the velocity, so that wind is held off, too.
class Velocity : public SetPoint {
 public:
  using SetPoint::SetPoint;
  void begin(const Model& model) override {
    const SE3 T = model.T_world_model();
    point().p_world = T.p;
    point().yaw = control::yaw_from_quaternion(T.R);
  }
  void apply(Span<const double> command, const Model& model, double period_s) override {
    const Eigen::Vector3d v(command.data());
    const Eigen::Vector3d p = model.T_world_model().p;
    // The set-point stays within kLongestLeadM of the
    // vehicle, as an integrator is kept from winding up.
    Eigen::Vector3d lead = point().p_world + period_s * v - p;
    lead *= std::min(1.0, kLongestLeadM / std::max(lead.norm(), 1e-9));
    point().p_world = p + lead;
    point().v_world = v;
    point().yaw += period_s * command[3];
    point().yaw_rate = command[3];
    send();
  }
};

/// Whether numbers are of single precision on a topic makes no difference here.
class Thrusters : public Actuator {
 public:
  Thrusters(const ActuatorSpec& spec, const PortBoard& board) : Actuator(spec) {
    for (const std::string& name : spec.ports) {
      single_.push_back(board.find_in<SingleNumber>(name));
      ports_.push_back(single_.back() != nullptr ? nullptr : input<ScalarSample>(name, board));
    }
  }
  void apply(Span<const double> command, const Model& /*model*/, double /*period_s*/) override {
    for (std::size_t i = 0; i < ports_.size(); ++i) {
      if (single_[i] != nullptr) single_[i]->write({{}, command[i]});
      if (ports_[i] != nullptr) ports_[i]->write({{}, command[i]});
    }
  }

 private:
  std::vector<InPort<SingleNumber>*> single_;
  std::vector<InPort<ScalarSample>*> ports_;  // nullptr where the other is not
};

class Twist : public Actuator {
 public:
  Twist(const ActuatorSpec& spec, const PortBoard& board)
      : Actuator(spec), port_(input<TwistCommand>(spec.ports.front(), board)) {}
  void apply(Span<const double> command, const Model& /*model*/, double /*period_s*/) override {
    TwistCommand sample;
    // A ground robot or boat: surge speed [m/s] and yaw rate [rad/s].
    sample.v_base.x() = command[0];
    sample.w_base.z() = command[1];
    port_->write(sample);
  }

 private:
  InPort<TwistCommand>* port_;
};

struct Kind {
  const char* name;
  std::size_t size;  ///< of an action; 0: as the ports or rotors have it
  std::unique_ptr<Actuator> (*make)(const ActuatorSpec&, const PortBoard&);
};

template <class Derived>
std::unique_ptr<Actuator> make(const ActuatorSpec& spec, const PortBoard& board) {
  return std::make_unique<Derived>(spec, board);
}

constexpr Kind kKinds[] = {{"rotors", 0, make<Rotors>},
                           {"rates", 4, make<Rates>},
                           {"velocity", 4, make<Velocity>},
                           {"thrusters", 0, make<Thrusters>},
                           {"twist", 2, make<Twist>}};

void check(const Kind& kind, const ActuatorSpec& spec) {
  const std::size_t ports = spec.kind == "thrusters" ? spec.middle.size() : 1;
  const bool is_size_legal = kind.size == 0 || spec.middle.size() == kind.size;
  if (!is_size_legal || spec.middle.size() != spec.reach.size() || spec.ports.size() != ports) {
    throw Error("actions '" + spec.kind + "': " + std::to_string(spec.middle.size()) +
                " middles, " + std::to_string(spec.reach.size()) + " reaches, " +
                std::to_string(spec.ports.size()) + " inputs do not fit each other");
  }
}

}  // namespace

std::vector<std::string> actuator_kinds() {
  std::vector<std::string> names;
  for (const Kind& kind : kKinds) names.emplace_back(kind.name);
  return names;
}

std::unique_ptr<Actuator> make_actuator(const ActuatorSpec& spec, const PortBoard& board) {
  std::string legal;
  for (const Kind& kind : kKinds) {
    if (spec.kind == kind.name) {
      check(kind, spec);
      return kind.make(spec, board);
    }
    legal += (legal.empty() ? "" : ", ") + std::string(kind.name);
  }
  throw Error("actions '" + spec.kind + "', legal: " + legal);
}

}  // namespace trident::sim
