// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>
#include <map>
#include <memory>
#include <string>
#include <typeindex>
#include <vector>

#include "trident_base/error.h"
#include "trident_base/span.h"
#include "trident_sim/state_archive.h"

namespace trident::sim {

/// Order in which the samples of one step leave: frames and odometry before the sensors that need
/// them (consumers look the transform up at the stamp of the scan).
enum class PortRank { kTransform = 0, kOdometry = 1, kState = 2, kSensor = 3 };

/// As the plugin sees it: kOut is a measurement or state, kIn a command.
enum class PortDirection { kOut, kIn };

/// A named, typed place where a plugin leaves (out) or finds (in) the newest value. Only the thread
/// that steps the world touches values.
class PortBase {
 public:
  /// `type` is the sample's, which the binder of a middleware looks its converter up by.
  PortBase(std::string name, PortDirection direction, PortRank rank, std::type_index type)
      : name_(std::move(name)), direction_(direction), rank_(rank), type_(type) {}
  virtual ~PortBase() = default;
  PortBase(const PortBase&) = delete;
  PortBase& operator=(const PortBase&) = delete;

  const std::string& name() const { return name_; }       ///< full name, without a leading slash
  PortDirection direction() const { return direction_; }  ///< fixed
  PortRank rank() const { return rank_; }         ///< of an output; that of an input is ignored
  std::type_index type() const { return type_; }  ///< typeid of the sample
  /// Values so far; a reader that keeps it knows what is new
  std::uint64_t count() const { return count_; }

  /// A port nobody listens to is not worth a computation.
  bool wanted() const { return listeners_ > 0; }
  /// Of an output: somebody outside receives its values. Of an input: a plugin reads it.
  void add_listener() { ++listeners_; }
  /// To be called once for each add_listener().
  void remove_listener() { --listeners_; }
  /// What was written so far; who listens is not part of it.
  virtual void state(StateArchive& archive) { archive(count_); }

 protected:
  std::uint64_t count_ = 0;

 private:
  std::string name_;
  PortDirection direction_;
  PortRank rank_;
  std::type_index type_;
  int listeners_ = 0;
};

/// Written by a plugin: edit `value` in place, then publish().
template <class T>
class OutPort : public PortBase {
 public:
  /// Plugins call PortBoard::advertise() instead, which keeps names unique.
  OutPort(std::string name, PortRank rank)
      : PortBase(std::move(name), PortDirection::kOut, rank, typeid(T)) {}
  /// The newest value, or the one that is being written. It stays between steps, so that vectors
  /// keep their memory and constant fields are set once.
  T value{};
  /// Marks `value` as new. Who listens finds it after the step, by count().
  void publish() { ++count_; }

  /// Of a sensor that is faster than the step: what was published in the same step before `value`,
  /// oldest first. Its plugin calls clear_buffered() before the first sample of a step and
  /// buffer_sample() before it overwrites one by the next.
  Span<const T> earlier() const { return {earlier_.data(), earlier_count_}; }
  void clear_buffered() { earlier_count_ = 0; }  ///< keeps the memory
  /// Copies `value` behind the earlier ones; see earlier().
  void buffer_sample() {
    if (earlier_count_ == earlier_.size()) earlier_.emplace_back();
    earlier_[earlier_count_++] = value;
  }

  void state(StateArchive& archive) override {
    PortBase::state(archive);
    archive(value, earlier_, earlier_count_);
  }

 private:
  std::vector<T> earlier_;
  std::size_t earlier_count_ = 0;
};

/// Written from outside, read by a plugin. Keeps the last kDepth values, because an answer to an
/// older state may still be due when a newer one is here.
template <class T>
class InPort : public PortBase {
 public:
  static constexpr std::uint64_t kDepth = 8;  ///< values that are kept
  /// Plugins call PortBoard::subscribe() instead, which shares one port between readers.
  explicit InPort(std::string name)
      : PortBase(std::move(name), PortDirection::kIn, PortRank::kState, typeid(T)) {}
  /// Called between steps by the stepping thread; overwrites the value kDepth before it.
  void write(const T& value) {
    ring_[count_ % kDepth] = value;
    ++count_;
  }
  /// Index of the oldest value that is kept
  std::uint64_t oldest() const { return count_ > kDepth ? count_ - kDepth : 0; }
  /// Value number `index`, for oldest() <= index < count(). Not checked.
  const T& at(std::uint64_t index) const { return ring_[index % kDepth]; }
  void clear() { count_ = 0; }  ///< forgets all values; indices begin at 0 again
  void state(StateArchive& archive) override {
    PortBase::state(archive);
    archive(ring_);
  }

 private:
  std::array<T, kDepth> ring_{};
};

/// All ports of a world by full name ("UAV1/odometry_sensor1/odometry"), in name order.
class PortBoard {
 public:
  /// Makes an output. Throws Error when the board has an output of this name.
  template <class T>
  OutPort<T>* advertise(const std::string& name, PortRank rank) {
    return add(std::make_unique<OutPort<T>>(name, rank));
  }
  /// Several plugins may read one input; each subscribe() is paired with a release().
  template <class T>
  InPort<T>* subscribe(const std::string& name) {
    if (PortBase* existing = find(name, PortDirection::kIn)) {
      auto* same = dynamic_cast<InPort<T>*>(existing);
      if (same == nullptr) throw Error("port '" + name + "' is read as two different types");
      same->add_listener();
      return same;
    }
    InPort<T>* port = add(std::make_unique<InPort<T>>(name));
    port->add_listener();
    return port;
  }
  /// nullptr when there is no output of this name, or it carries another type.
  template <class T>
  OutPort<T>* find_out(const std::string& name) const {
    return dynamic_cast<OutPort<T>*>(find(name, PortDirection::kOut));
  }
  /// nullptr when nobody reads an input of this name, or it carries another type.
  template <class T>
  InPort<T>* find_in(const std::string& name) const {
    return dynamic_cast<InPort<T>*>(find(name, PortDirection::kIn));
  }
  /// nullptr when there is no such port. Inputs and outputs have names of their own.
  PortBase* find(const std::string& name, PortDirection direction) const {
    const auto& map = direction == PortDirection::kOut ? out_ : in_;
    const auto it = map.find(name);
    return it == map.end() ? nullptr : it->second.get();
  }
  /// Gives a port back: an output goes at once, an input with its last reader.
  void release(PortBase* port) {
    if (port->direction() == PortDirection::kIn) {
      port->remove_listener();
      if (port->wanted()) return;
      in_.erase(std::string(port->name()));
    } else {
      out_.erase(std::string(port->name()));
    }
    ++version_;
  }
  /// Changes whenever a port comes or goes, so that a binder knows when to look again.
  std::uint64_t version() const { return version_; }
  /// Calls visit(PortBase&) for all outputs and then all inputs, each in name order.
  template <class Visitor>
  void for_each(Visitor&& visit) const {
    for (const auto& [name, port] : out_) visit(*port);
    for (const auto& [name, port] : in_) visit(*port);
  }

 private:
  template <class P>
  P* add(std::unique_ptr<P> port) {
    auto& map = port->direction() == PortDirection::kOut ? out_ : in_;
    if (map.count(port->name()) != 0) {
      throw Error("port '" + port->name() + "' is already taken: two plugins use one topic name");
    }
    P* raw = port.get();
    map.emplace(raw->name(), std::move(port));
    ++version_;
    return raw;
  }

  std::map<std::string, std::unique_ptr<PortBase>> out_, in_;
  std::uint64_t version_ = 0;
};

}  // namespace trident::sim
