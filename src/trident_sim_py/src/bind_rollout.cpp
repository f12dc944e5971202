// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
// The loop of learners; trident_sim/envs makes environments of it.
#include <pybind11/numpy.h>
#include <pybind11/stl.h>

#include "bindings.h"
#include "convert.h"
#include "rollout.h"
#include "trident_base/error.h"

namespace py = pybind11;

namespace trident::sim {
namespace {

using Actions = py::array_t<float, py::array::c_style | py::array::forcecast>;
using Resting = py::array_t<bool, py::array::c_style | py::array::forcecast>;

AgentSpec make_agent(const std::string& model, const std::string& actions,
                     const std::vector<std::string>& ports, const std::vector<double>& middle,
                     const std::vector<double>& reach, const std::vector<std::string>& blocks,
                     const std::string& scan, std::size_t beams) {
  return {model, {actions, ports, middle, reach}, blocks, scan, beams};
}

std::vector<Goal> to_goals(const py::object& values, std::size_t count) {
  const NumpyArray array = to_array(values, "goals", 2);
  if (static_cast<std::size_t>(array.shape(0)) != count || array.shape(1) != 4) {
    throw Error("goals has shape (" + std::to_string(array.shape(0)) + ", " +
                std::to_string(array.shape(1)) + "), legal: (" + std::to_string(count) + ", 4)");
  }
  std::vector<Goal> goals;
  for (py::ssize_t i = 0; i < array.shape(0); ++i) {
    const double* row = array.data() + 4 * i;
    goals.push_back({Eigen::Vector3d(row), row[3]});
  }
  return goals;
}

const float* checked(const Actions& actions, const RolloutSizes& sizes) {
  const std::size_t wanted = sizes.worlds * sizes.agents * sizes.action;
  if (static_cast<std::size_t>(actions.size()) != wanted) {
    throw Error("actions has " + std::to_string(actions.size()) +
                " numbers, legal: " + std::to_string(wanted));
  }
  return actions.data();
}

py::array_t<float> observe(Rollout& rollout, std::size_t world) {
  const RolloutSizes& sizes = rollout.sizes();
  py::array_t<float> result({sizes.agents, sizes.observation});
  rollout.observe(world, result.mutable_data());
  return result;
}

/// Of one agent in one world, without the cost of arrays of one row.
py::tuple step_one(Rollout& rollout, const Actions& actions) {
  const RolloutSizes& sizes = rollout.sizes();
  if (sizes.worlds * sizes.agents != 1) throw Error("step_one: legal: one world with one agent");
  const float* action = checked(actions, sizes);
  py::array_t<float> observation(static_cast<py::ssize_t>(sizes.observation));
  std::array<double, Terms::kCount> terms{};
  const Rollout::Results results{observation.mutable_data(), terms.data()};
  {
    const py::gil_scoped_release unlocked;
    rollout.step(action, nullptr, results);
  }
  py::tuple numbers(terms.size());
  for (std::size_t i = 0; i < terms.size(); ++i) numbers[i] = terms[i];
  return py::make_tuple(std::move(observation), std::move(numbers));
}

void step(Rollout& rollout, const Actions& actions, const Resting& resting,
          py::array_t<float, py::array::c_style> observations,
          py::array_t<double, py::array::c_style> terms) {
  const RolloutSizes& sizes = rollout.sizes();
  const float* numbers = checked(actions, sizes);
  const std::size_t rows = sizes.worlds * sizes.agents;
  if (static_cast<std::size_t>(resting.size()) != sizes.worlds ||
      static_cast<std::size_t>(observations.size()) != rows * sizes.observation ||
      static_cast<std::size_t>(terms.size()) != rows * Terms::kCount) {
    throw Error("step: resting, observations or terms have another size than the rollout's");
  }
  // Results are written into the caller's arrays, without a copy or an allocation in each step.
  const Rollout::Results results{observations.mutable_data(), terms.mutable_data()};
  const bool* rests = resting.data();
  // The worlds step on other threads; no Python object is touched until the lock is back.
  const py::gil_scoped_release unlocked;
  rollout.step(numbers, rests, results);
}

py::tuple sizes_of(const Rollout& rollout) {
  const RolloutSizes& sizes = rollout.sizes();
  return py::make_tuple(sizes.worlds, sizes.agents, sizes.action, sizes.observation);
}

}  // namespace

void bind_rollout(py::module_& module) {
  py::class_<AgentSpec>(module, "AgentSpec", "One model of a world that acts and observes.")
      .def(py::init(&make_agent), py::arg("model"), py::arg("actions"), py::arg("ports"),
           py::arg("middle"), py::arg("reach"), py::arg("blocks"), py::arg("scan") = "",
           py::arg("beams") = 0,
           "model: its name.\n"
           "actions: rotors, rates, velocity, thrusters or twist; commands are\n"
           "middle + reach * action and go to the input ports.\n"
           "blocks: of the observation, in order.\n"
           "scan: output of a planar lidar that is reduced to so many beams.");
  py::class_<Rollout>(module, "Rollout", "Worlds side by side, in each the same agents.")
      .def(py::init([](std::vector<std::shared_ptr<Session>> sessions,
                       const std::vector<AgentSpec>& agents, std::uint64_t steps,
                       std::size_t threads) {
             return std::make_unique<Rollout>(std::move(sessions), agents, steps, threads);
           }),
           py::arg("sessions"), py::arg("agents"), py::arg("steps"), py::arg("threads"),
           "steps: of the world that follow each action.\nthreads: that share the worlds.")
      .def_property_readonly("sizes", &sizes_of,
                             "Worlds, agents in each, numbers of an action, of an observation.")
      .def(
          "begin",
          [](Rollout& r, std::size_t world, const py::object& goals) {
            r.begin(world, to_goals(goals, r.sizes().agents));
          },
          py::arg("world"), py::arg("goals"),
          "An episode begins. goals: x y z yaw in the world [m, rad], shape (agents, 4).")
      .def(
          "set_goals",
          [](Rollout& r, std::size_t world, const py::object& goals) {
            r.set_goals(world, to_goals(goals, r.sizes().agents));
          },
          py::arg("world"), py::arg("goals"), "Other goals in the same episode; as begin().")
      .def("observe", &observe, py::arg("world"),
           "Observations as the world is, shape (agents, numbers), float32.")
      .def("step_one", &step_one, py::arg("actions"),
           "Of one world with one agent: observation and terms.")
      .def("step", &step, py::arg("actions"), py::arg("resting"), py::arg("observations"),
           py::arg("terms"),
           "Act and step, without the interpreter's lock; writes into the last two, shapes\n"
           "(worlds, agents, numbers), but for worlds that rest, shape (worlds,).")
      .def("state_hash", &Rollout::state_hash, py::arg("world"), "As World.state_hash().");
  for (const char* name : {"AgentSpec", "Rollout"}) {
    module.attr(name).attr("__module__") = "trident_sim";
  }
  module.def("block_names", &block_names, "What observations can be made of.");
  module.def("actuator_kinds", &actuator_kinds, "What actions can drive.");
}

}  // namespace trident::sim
