// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <pybind11/pybind11.h>

#include <cstdint>
#include <memory>
#include <string>

#include "session.h"

namespace trident::sim {

/// How values of one type pass between a port and Python.
struct PortType {
  const char* name;  ///< of the Python class
  pybind11::object (*read)(const PortBase&);
  /// Returns how many unread values the port holds, after writing `sample`.
  void (*write)(PortBase&, const pybind11::handle& sample);
  std::uint64_t depth;
};

/// nullptr for a type that no Python class stands for.
const PortType* find_port_type(const PortBase& port);

/// A name on the port board, seen from Python: an output, an input, or both.
class PortView {
 public:
  PortView(std::shared_ptr<Session> session, std::string name)
      : session_(std::move(session)), name_(std::move(name)) {}

  const std::string& name() const { return name_; }
  bool is_output() const { return find(PortDirection::kOut) != nullptr; }
  bool is_input() const { return find(PortDirection::kIn) != nullptr; }
  std::string type() const;
  std::uint64_t count() const;
  bool subscribed() const { return session_->subscribed(name_); }
  void subscribe(bool wanted) { session_->subscribe(name_, wanted); }

  /// The newest value; throws Error before the first.
  pybind11::object value();
  /// The newest value if it has not been read through this view, else None.
  pybind11::object read();
  void write(const pybind11::args& args, const pybind11::kwargs& kwargs);

 private:
  PortBase* find(PortDirection direction) const { return session_->find_port(name_, direction); }
  PortBase& required(PortDirection direction) const;
  const PortType& required_type(const PortBase& port) const;

  std::shared_ptr<Session> session_;
  std::string name_;
  std::uint64_t seen_ = 0, restores_seen_ = 0;
};

}  // namespace trident::sim
