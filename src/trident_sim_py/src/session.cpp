// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#include "session.h"

#include <pybind11/pybind11.h>

#include <algorithm>

#include "trident_base/error.h"
#include "trident_control_sim/lee_plugin.h"
#include "trident_sim/sdf_loader.h"

namespace py = pybind11;

namespace trident::sim {
namespace {

/// Between two looks for Ctrl-C; so short that nobody waits, so long that the look costs nothing.
constexpr std::uint64_t kStepsPerLook = 64;

LoopTiming parse_timing(const std::string& name) {
  if (name == "rotors") return LoopTiming::kRotors;
  if (name == "direct") return LoopTiming::kDirect;
  throw Error("timing is '" + name + "', legal: rotors, direct");
}

template <class Map>
std::string known_names(const Map& names) {
  std::string text;
  for (const auto& name : names) text += (text.empty() ? "" : ", ") + name;
  return text.empty() ? "none" : text;
}

/// Whether the text is itself a world, not the name of a file.
bool is_xml(const std::string& text) {
  const std::size_t first = text.find_first_not_of(" \t\r\n");
  return first != std::string::npos && text[first] == '<';
}

WorldSpec load_world(const SessionOptions& options, const Resources& resources,
                     const WarningSink& warn, OddElements odd) {
  return is_xml(options.world) ? load_world_string(options.world, "world", resources, warn, odd)
                               : load_world_file(options.world, resources, warn, odd);
}

}  // namespace

/// Steps run without the GIL, so that another Python thread could reach the world meanwhile. It
/// gets an error instead of a race.
class Session::Busy {
 public:
  explicit Busy(Session& session) : session_(session) {
    if (session_.busy_.exchange(true)) {
      throw Error("the world is in use by another thread: one thread at a time");
    }
  }
  ~Busy() { session_.busy_ = false; }
  Busy(const Busy&) = delete;
  Busy& operator=(const Busy&) = delete;

 private:
  Session& session_;
};

/// A text that begins with "<" is a world, anything else the path of one.
Session::Session(const SessionOptions& options) : resources_(options.folders) {
  const LoopTiming timing = parse_timing(options.timing);
  register_builtin_plugins(registry_);
  control::register_control_plugins(registry_);
  const auto report = [this](Severity severity, const std::string& text) {
    messages_.push_back({severity == Severity::kError ? "error" : "warning", text,
                         world_ ? world_->time().seconds() : 0.0});
  };
  const auto warn = [&report](const std::string& text) { report(Severity::kWarning, text); };
  const py::gil_scoped_release unlocked;
  for (const std::string& warning : resources_.warnings()) warn(warning);
  for (const std::string& path : options.plugins) registry_.load_shared_object(path);

  const OddElements odd = options.strict ? OddElements::kRefuse : OddElements::kLeaveOut;
  const WorldSpec spec = load_world(options, resources_, warn, odd);
  world_ = std::make_unique<World>(
      spec, resources_, registry_,
      WorldOptions{options.seed, timing, report, {}, options.sensor_threads, {}, odd});
}

Session::~Session() = default;

const std::vector<Message>& Session::messages() const {
  world();
  return messages_;
}

World& Session::world() const {
  if (busy_) throw Error("the world is in use by another thread: one thread at a time");
  return *world_;
}

Model& Session::model(const std::string& name) {
  if (Model* found = world().find_model(name)) return *found;
  std::vector<std::string> known;
  for (const auto& [other, model] : world_->models()) known.push_back(other);
  throw Error("model '" + name + "' is not in the world; there are: " + known_names(known));
}

Link& Session::link(const std::string& model_name, const std::string& name) {
  Model& owner = model(model_name);
  if (Link* found = owner.find_link(name)) return *found;
  std::vector<std::string> known;
  for (const auto& link : owner.links) known.push_back(link->name);
  throw Error("model '" + model_name + "' has no link '" + name +
              "'; there are: " + known_names(known));
}

Joint& Session::joint(const std::string& model_name, const std::string& name) {
  Model& owner = model(model_name);
  if (Joint* found = owner.find_joint(name)) return *found;
  std::vector<std::string> known;
  for (const auto& joint : owner.joints) known.push_back(joint->spec.name);
  throw Error("model '" + model_name + "' has no joint '" + name +
              "'; there are: " + known_names(known));
}

std::string Session::spawn(const SpawnRequest& request) {
  const Busy busy(*this);
  const py::gil_scoped_release unlocked;
  return world_->spawn(request).name;
}

void Session::remove(const std::string& name) {
  model(name);
  world_->remove(name);
  prune();
}

/// In portions, between which Ctrl-C is looked for: a signal handler of Python runs only with the
/// GIL.
void Session::step(std::uint64_t n) {
  const Busy busy(*this);
  while (n > 0) {
    const std::uint64_t now = std::min(n, kStepsPerLook);
    {
      const py::gil_scoped_release unlocked;
      world_->step(now);
    }
    n -= now;
    if (n > 0 && PyErr_CheckSignals() != 0) throw py::error_already_set();
  }
}

void Session::use(const std::function<void(World&)>& work) {
  const Busy busy(*this);
  work(*world_);
}

void Session::reset(bool with_time) {
  if (with_time) {
    world().reset();
  } else {
    world().reset_models();
  }
  writes_.clear();
}

void Session::restore(const Snapshot& snapshot) {
  world().restore_snapshot(snapshot);
  writes_.clear();
  ++restore_count_;
}

PortBase* Session::find_port(const std::string& name, PortDirection direction) {
  return world().ports().find(name, direction);
}

void Session::subscribe(const std::string& name, bool wanted) {
  PortBase* port = find_port(name, PortDirection::kOut);
  if (port == nullptr) throw Error("port '" + name + "' is not an output");
  const auto known = subscribed_.find(name);
  if (wanted && known == subscribed_.end()) {
    port->add_listener();
    subscribed_[name] = port;
  } else if (!wanted && known != subscribed_.end()) {
    port->remove_listener();
    subscribed_.erase(known);
  }
}

bool Session::subscribed(const std::string& name) { return subscribed_.count(name) > 0; }

/// An input keeps `depth` values; one more in the same step would overwrite the first unseen.
void Session::count_write(const PortBase& port, std::uint64_t depth) {
  Writes& writes = writes_[port.name()];
  if (writes.step != world_->step_count()) writes = {world_->step_count(), 0};
  if (writes.count >= depth) {
    throw Error("port '" + port.name() + "': " + std::to_string(depth) +
                " values wait already; step the world before writing more");
  }
  ++writes.count;
}

/// A port that went with its model and came again with another one is a new port: listeners are not
/// carried over.
void Session::prune() {
  for (auto it = subscribed_.begin(); it != subscribed_.end();) {
    const bool is_there = find_port(it->first, PortDirection::kOut) == it->second;
    it = is_there ? std::next(it) : subscribed_.erase(it);
  }
  for (auto it = writes_.begin(); it != writes_.end();) {
    const bool is_there = find_port(it->first, PortDirection::kIn) != nullptr;
    it = is_there ? std::next(it) : writes_.erase(it);
  }
}

}  // namespace trident::sim
