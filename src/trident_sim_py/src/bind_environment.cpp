// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
// What changes and describes a world's sea and wind; batteries.
#include "bindings.h"
#include "sample_class.h"
#include "trident_sim/samples/battery_sample.h"
#include "trident_sim/samples/text_sample.h"

namespace trident::sim {

void bind_environment(py::module_& module) {
  const auto make_text = [](const std::string& text, double stamp) {
    return TextCommand{to_time(stamp, "stamp"), text};
  };
  stamped<TextCommand>(module, "TextCommand", "What is to be different from the next step on.")
      .def(py::init(make_text), py::arg("text"), py::arg("stamp") = 0.0,
           "text: the keys to change, as YAML.\n"
           "stamp: [s], not looked at: it acts in the next step.")
      .def_readonly("text", &TextCommand::text, "The keys to change, as YAML.");
  stamped<EnvironmentSample>(module, "EnvironmentSample", "A world's sea, wind and ground.")
      .def_readonly("yaml", &EnvironmentSample::yaml, "As the file of an environment says it.");
  stamped<NumberSample>(module, "NumberSample", "A number, as std_msgs/Float64 has it.")
      .def_readonly("value", &NumberSample::value, "In the unit of the quantity.");
  stamped<BatterySample>(module, "BatterySample", "State of a battery.")
      .def_readonly("voltage", &BatterySample::voltage_v, "At its terminals, under load [V].")
      .def_readonly("current", &BatterySample::current_a, "Drawn from it [A].")
      .def_readonly("charge", &BatterySample::charge_ah, "That is left [Ah].")
      .def_readonly("capacity", &BatterySample::capacity_ah, "When full [Ah].")
      .def_readonly("percentage", &BatterySample::charge_share, "Charge over capacity, 0 to 1.");
  stamped<WindReadingSample>(module, "WindReadingSample", "Speed and angle of the wind.")
      .def_readonly("frame", &WindReadingSample::frame, "Frame of the sensor.")
      .def_readonly("is_true", &WindReadingSample::is_true,
                    "Over ground; else as the sensor feels it while it moves.")
      .def_readonly("speed", &WindReadingSample::speed_m_s, "[m/s].")
      .def_readonly("angle", &WindReadingSample::angle_rad,
                    "Where it comes from, from the frame's x clockwise, in [0, 2 pi) [rad].");
}

}  // namespace trident::sim
