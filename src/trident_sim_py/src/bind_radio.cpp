// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
// The radios of a world; trident_sim/radio.py makes classes of it.
#include <pybind11/stl.h>

#include <cstdint>

#include "bindings.h"
#include "session.h"
#include "trident_base/error.h"
#include "trident_sim/comms/radio.h"

namespace py = pybind11;

namespace trident::sim {
namespace {

Radio& radio_of(Session& session) {
  const auto radio = find_radio(session.world());
  if (radio != nullptr) return *radio;
  throw Error("the world has no radios, legal: one with libtrident_radio_medium.so");
}

bool send(Session& session, const std::string& source, const std::string& destination,
          const py::bytes& data, int priority, double deadline_s) {
  return radio_of(session).send(source, destination, data, {priority, deadline_s});
}

py::list receive(Session& session, const std::string& name) {
  py::list result;
  for (const RadioMessage& m : radio_of(session).receive(name)) {
    result.append(py::make_tuple(m.source, py::bytes(m.data), m.sent.seconds(),
                                 m.received.seconds(), m.snr_db));
  }
  return result;
}

py::list links(Session& session, const std::string& source) {
  py::list result;
  for (const RadioLink& l : radio_of(session).links(source)) {
    result.append(py::make_tuple(l.source, l.destination, l.distance_m, l.loss_db, l.snr_db, l.mcs,
                                 l.sent, l.delivered, l.lost, l.expired, l.refused,
                                 l.mean_delay_s()));
  }
  return result;
}

}  // namespace

void bind_radio(py::module_& module) {
  module.def(
      "has_radio", [](Session& s) { return find_radio(s.world()) != nullptr; }, py::arg("session"),
      "Whether the world has air for radios.");
  module.def(
      "radio_names", [](Session& s) { return radio_of(s).names(); }, py::arg("session"),
      "Names of the radios; see Radio.names.");
  module.def("radio_send", &send, py::arg("session"), py::arg("source"), py::arg("destination"),
             py::arg("data"), py::arg("priority"), py::arg("deadline"), "See Radio.send.");
  module.def("radio_receive", &receive, py::arg("session"), py::arg("name"),
             "Fields of the messages; see Radio.receive.");
  module.def("radio_links", &links, py::arg("session"), py::arg("source"),
             "Fields of the links; see Radio.links.");
  module.def(
      "radio_set_outage",
      [](Session& s, const std::string& name, bool is_out, const std::string& other) {
        // For as long as a simulation can be, or over.
        radio_of(s).set_outage(name, other, is_out ? SimTime{INT64_MAX} : SimTime{});
      },
      py::arg("session"), py::arg("name"), py::arg("out"), py::arg("other"),
      "See Radio.set_outage.");
}

}  // namespace trident::sim
