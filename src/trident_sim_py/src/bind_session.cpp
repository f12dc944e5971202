// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#include <pybind11/stl.h>

#include <set>

#include "bindings.h"
#include "convert.h"
#include "port_access.h"
#include "session.h"
#include "trident_base/error.h"

namespace py = pybind11;

namespace trident::sim {
namespace {

std::shared_ptr<Session> make_session(const std::string& world, std::uint64_t seed,
                                      const std::string& timing,
                                      const std::vector<std::string>& folders,
                                      const std::vector<std::string>& plugins,
                                      std::size_t sensor_threads, bool strict) {
  return std::make_shared<Session>(
      SessionOptions{world, seed, timing, folders, plugins, sensor_threads, strict});
}

std::string spawn(Session& session, const std::string& name, const std::string& xml,
                  const std::string& label, const std::string& robot_namespace,
                  const py::object& pose) {
  return session.spawn({name, xml, label, robot_namespace, to_pose(pose, "pose")});
}

std::vector<std::string> model_names(Session& session) {
  std::vector<std::string> names;
  for (const auto& [name, model] : session.world().models()) names.push_back(name);
  return names;
}

std::set<std::string> port_names(Session& session) {
  std::set<std::string> names;
  session.world().ports().for_each([&names](const PortBase& port) { names.insert(port.name()); });
  return names;
}

bool has_port(Session& session, const std::string& name) {
  return session.find_port(name, PortDirection::kOut) != nullptr ||
         session.find_port(name, PortDirection::kIn) != nullptr;
}

std::string find_resource(const std::string& uri, const std::vector<std::string>& folders) {
  const Resources resources(folders);
  std::string found = resources.find(uri);
  if (found.empty()) throw Error("'" + uri + "' not found; searched: " + resources.searched());
  return found;
}

void bind_ports(py::module_& module) {
  py::class_<PortView>(module, "Port",
                       "A named place where the world leaves measurements (an output), takes\n"
                       "commands (an input), or both. Only what is subscribed is computed.")
      .def(py::init<std::shared_ptr<Session>, std::string>())
      .def_property_readonly("name", &PortView::name, "Full name, as that of the ROS topic.")
      .def_property_readonly("is_output", &PortView::is_output, "Whether it can be read.")
      .def_property_readonly("is_input", &PortView::is_input, "Whether it can be written.")
      .def_property_readonly("type", &PortView::type,
                             "Name of the class of its values, those that are read first.")
      .def_property_readonly("count", &PortView::count, "How many values there have been.")
      .def_property_readonly("subscribed", &PortView::subscribed,
                             "Whether its values are asked for.")
      .def(
          "subscribe", [](PortView& port) { port.subscribe(true); },
          "From the next step on, have its values computed.")
      .def(
          "unsubscribe", [](PortView& port) { port.subscribe(false); },
          "Have its values computed no longer.")
      .def_property_readonly("value", &PortView::value,
                             "The newest value, a copy. Subscribes; Error before the first value.")
      .def("read", &PortView::read,
           "The newest value if this Port object has not returned it yet, else None. Subscribes.")
      .def("write", &PortView::write,
           "Give it a value: one of its class, or what that class is made of.\n"
           "At most 8 between two steps.")
      .def("__repr__",
           [](const PortView& port) { return "<trident_sim.Port '" + port.name() + "'>"; });
  module.attr("Port").attr("__module__") = "trident_sim";
}

}  // namespace

void bind_session(py::module_& module) {
  py::class_<Message>(module, "Message", "Something that went wrong and did not stop the world.")
      .def_readonly("severity", &Message::severity, "How bad it is: 'warning' or 'error'.")
      .def_readonly("text", &Message::text, "What went wrong, and where.")
      .def_readonly("time", &Message::time_s, "Simulated time [s].")
      .def("__repr__", [](const Message& m) {
        return "<trident_sim.Message " + std::to_string(m.time_s) + " s " + m.severity + ": " +
               m.text + ">";
      });
  module.attr("Message").attr("__module__") = "trident_sim";
  // Private: trident_sim.World is the class that users see.
  py::class_<Session, std::shared_ptr<Session>>(module, "Session")
      .def(py::init(&make_session), py::arg("world"), py::arg("seed"), py::arg("timing"),
           py::arg("folders"), py::arg("plugins"), py::arg("sensor_threads"), py::arg("strict"))
      .def("spawn", &spawn)
      .def("remove", &Session::remove)
      .def("step", &Session::step)
      .def("reset", &Session::reset)
      .def("state_hash", [](Session& s) { return s.world().state_hash(); })
      .def_property_readonly("time_ns", [](Session& s) { return s.world().time().ns; })
      .def_property_readonly("dt_ns", [](Session& s) { return s.world().dt().ns; })
      .def_property_readonly("step_count", [](Session& s) { return s.world().step_count(); })
      .def_property_readonly("seed", [](Session& s) { return s.world().seed(); })
      .def_property_readonly("name", [](Session& s) { return s.world().name(); })
      .def_property_readonly("gravity", [](Session& s) { return s.world().physics().gravity; })
      .def_property_readonly("message_count", [](Session& s) { return s.messages().size(); })
      .def_property_readonly("messages", [](Session& s) { return s.messages(); })
      .def("model_names", &model_names)
      .def(
          "has_model",
          [](Session& s, const std::string& name) { return s.world().find_model(name) != nullptr; })
      .def("port_names", &port_names)
      .def("has_port", &has_port);
  bind_ports(module);
  module.def("find_resource", &find_resource, py::arg("uri"), py::arg("folders"));
}

}  // namespace trident::sim
