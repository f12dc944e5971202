// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#include "trident_sim/world.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <sstream>

#include "core/physics/physics_engine.h"
#include "drop_if.h"
#include "silent_elements.h"
#include "trident_base/error.h"
#include "trident_sim/motion_limits.h"

namespace trident::sim {
namespace {

/// Adds the wall time between construction and destruction, when there is somewhere to add it.
class StageTimer {
 public:
  explicit StageTimer(double* seconds) : seconds_(seconds) {
    if (seconds_ != nullptr) begin_ = Clock::now();
  }
  ~StageTimer() {
    if (seconds_ != nullptr) {
      *seconds_ += std::chrono::duration<double>(Clock::now() - begin_).count();
    }
  }
  StageTimer(const StageTimer&) = delete;
  StageTimer& operator=(const StageTimer&) = delete;

 private:
  using Clock = std::chrono::steady_clock;
  double* seconds_;
  Clock::time_point begin_;
};

/// Checks the values of `<physics>`: throws Error at the first that is illegal, or, where `odd` is
/// given, puts Gazebo's default in its place and notes it.
class PhysicsCheck {
 public:
  PhysicsCheck(PhysicsSpec& physics, std::vector<std::string>* odd)
      : physics_(physics), odd_(odd) {}

  template <class T>
  void check(bool ok, const char* field, T PhysicsSpec::*member, const char* legal) {
    if (ok) return;
    std::ostringstream text;
    text << "physics: " << field << " is '" << print(physics_.*member) << "', must be " << legal;
    if (odd_ == nullptr) throw Error(text.str());
    physics_.*member = PhysicsSpec{}.*member;
    odd_->push_back(text.str() + "; the default is taken");
  }

 private:
  template <class T>
  static T print(const T& value) {
    return value;
  }
  static double print(const Eigen::Vector3d& value) { return value.norm(); }

  PhysicsSpec& physics_;
  std::vector<std::string>* odd_;
};

void validate(PhysicsSpec& p, std::vector<std::string>* odd = nullptr) {
  PhysicsCheck is(p, odd);
  const double dt = p.max_step_size_s;
  is.check(dt >= 1e-6 && dt <= 1.0, "max_step_size", &PhysicsSpec::max_step_size_s,
           "in [1e-6, 1] s");
  is.check(p.solver == "quick" || p.solver == "world", "solver type", &PhysicsSpec::solver,
           "quick or world");
  is.check(p.exact_solver_rows >= 0, "exact_solver_rows", &PhysicsSpec::exact_solver_rows, ">= 0");
  is.check(p.precon_iterations >= 0, "precon_iters", &PhysicsSpec::precon_iterations, ">= 0");
  is.check(is_within(p.gravity, 1e6), "gravity", &PhysicsSpec::gravity, "finite, up to 1e6 m/s^2");
  is.check(p.iterations >= 1 && p.iterations <= 100000, "iterations", &PhysicsSpec::iterations,
           "in [1, 100000]");
  is.check(p.sor > 0.0 && p.sor < 2.0, "sor", &PhysicsSpec::sor, "in (0, 2)");
  is.check(p.cfm >= 0.0 && p.cfm <= 1e12, "cfm", &PhysicsSpec::cfm, "in [0, 1e12]");
  is.check(p.erp >= 0.0 && p.erp <= 1.0, "erp", &PhysicsSpec::erp, "in [0, 1]");
  is.check(p.contact_surface_layer >= 0.0, "contact_surface_layer",
           &PhysicsSpec::contact_surface_layer, ">= 0 m");
  is.check(p.contact_max_correcting_vel >= 0.0, "contact_max_correcting_vel",
           &PhysicsSpec::contact_max_correcting_vel, ">= 0 m/s");
  is.check(p.max_contacts >= 1 && p.max_contacts <= 100000, "max_contacts",
           &PhysicsSpec::max_contacts, "in [1, 100000]");
  is.check(p.real_time_update_rate_hz >= 0.0, "real_time_update_rate",
           &PhysicsSpec::real_time_update_rate_hz, ">= 0 Hz");
}

/// Puts a body somewhere by hand. The jump is no acceleration: its past moves with it.
void place(Body& body, const SE3& T_world_body, const Eigen::Vector3d& v_world,
           const Eigen::Vector3d& w_world) {
  body.T_world_body.p = T_world_body.p;
  body.set_orientation(T_world_body.R);
  body.v_world = body.v_before = v_world;
  body.w_world = body.w_before = w_world;
  body.placed = true;
  body.frozen = false;
}

}  // namespace

World::World(const WorldSpec& spec, const Resources& resources, PluginRegistry& registry,
             WorldOptions options)
    : name_(spec.name),
      physics_(spec.physics),
      spherical_(spec.spherical),
      scene_(spec.scene),
      lights_(spec.lights),
      resources_(resources),
      registry_(registry),
      options_(std::move(options)),
      workers_(options_.sensor_threads) {
  std::vector<std::string> odd;
  validate(physics_, options_.odd_elements == OddElements::kRefuse ? nullptr : &odd);
  for (const std::string& text : odd) tell_odd(text);
  engine_ = std::make_unique<PhysicsEngine>(
      physics_, options_.timing == LoopTiming::kRotors,
      [this](const std::string& text) { report(Severity::kWarning, text); });
  dt_ = SimTime::from_seconds(physics_.max_step_size_s);
  for (const std::string& text : spec.odd_elements) tell_odd(text);
  odd_elements_.insert(odd_elements_.end(), spec.odd_repeats.begin(), spec.odd_repeats.end());
  for (const ModelSpec& model : spec.models) {
    leave_out_if_odd([&] { add_model(model, ""); });
  }
  for (const auto& [name, model] : models_) tell_overlap(*model);
  for (const PluginSpec& plugin : spec.plugins) {
    leave_out_if_odd([&] {
      auto made = create_plugin(plugin, {}, "world '" + name_ + "'");
      if (made != nullptr) world_plugins_.push_back(std::move(made));
    });
  }
  rebuild_schedule();
}

World::~World() {
  world_plugins_.clear();
  for (auto& [name, model] : models_) {
    model->plugins.clear();
    engine_->destroy(*model);
  }
}

void World::report(Severity severity, const std::string& text) const {
  if (options_.report) options_.report(severity, text);
}

void World::diagnose(Diagnostic diagnostic) {
  const Severity severity = diagnostic.severity;
  const std::string text = diagnostic.subject + ": " + diagnostic.message;
  if (!note(std::move(diagnostic))) return;
  if (options_.diagnosed) {
    options_.diagnosed(severity, text);
  } else {
    report(severity, text);
  }
}

bool World::note(Diagnostic diagnostic) { return diagnostics_.add(std::move(diagnostic), time_); }

Model& World::spawn(const SpawnRequest& request) {
  const std::string label = !request.label.empty()  ? request.label
                            : !request.name.empty() ? "model '" + request.name + "'"
                                                    : "model";
  ModelSpec spec = load_model_string(
      request.xml, label, resources_,
      [this](const std::string& text) { report(Severity::kWarning, text); }, options_.odd_elements);
  if (!request.name.empty()) spec.name = request.name;
  spec.T_world_model = request.T_world_model;
  return spawn(std::move(spec), request.robot_namespace);
}

Model& World::spawn(ModelSpec spec, const std::string& robot_namespace) {
  const std::vector<std::string> odd = std::move(spec.odd_elements);
  for (const std::string& text : odd) tell_odd(text);
  odd_elements_.insert(odd_elements_.end(), spec.odd_repeats.begin(), spec.odd_repeats.end());
  Model& model = add_model(std::move(spec), robot_namespace);
  tell_overlap(model);
  return model;
}

Model& World::add_model(ModelSpec spec, const std::string& robot_namespace) {
  if (spec.name.empty()) throw Error("a model needs a name");
  if (models_.count(spec.name) != 0) {
    throw Error("model name '" + spec.name + "' already exists in the world");
  }
  if (!is_place(spec.T_world_model)) {
    throw Error("model '" + spec.name +
                "': initial pose is not finite, is beyond 1e7 m or has a zero quaternion");
  }
  spec.T_world_model.R.normalize();
  diagnostics_.forget_model(spec.name);  // of earlier attempts
  std::unique_ptr<Model> model = build_model(std::move(spec), robot_namespace);
  Model& result = *model;
  result.spawn_number = ++spawn_count_;
  models_.emplace(result.name, std::move(model));
  ++models_version_;
  rebuild_schedule();
  return result;
}

std::unique_ptr<Model> World::build_model(ModelSpec spec, const std::string& robot_namespace) {
  auto model = std::make_unique<Model>();
  model->name = spec.name;
  model->robot_namespace = robot_namespace;
  model->T_world_model_initial = spec.T_world_model;
  model->is_static = spec.is_static;
  std::vector<PluginSpec> plugins = std::move(spec.plugins);
  spec.plugins.clear();
  model->spec = std::move(spec);
  std::vector<std::string> spun;
  for (const PluginSpec& plugin : plugins) {
    const PluginFactory* factory = registry_.find_or_load(plugin.filename, resources_);
    if (factory == nullptr || !factory->spun_joint) continue;
    const PluginParams params(plugin.params,
                              "model '" + model->name + "' plugin '" + plugin.name + "'");
    if (std::string joint = factory->spun_joint(params); !joint.empty()) spun.push_back(joint);
  }
  engine_->build(*model, spun,
                 [this](const std::function<void()>& make) { leave_out_if_odd(make); });
  try {
    create_plugins(*model, plugins);
  } catch (...) {
    model->plugins.clear();
    engine_->destroy(*model);
    throw;
  }
  return model;
}

void World::create_plugins(Model& model, const std::vector<PluginSpec>& specs) {
  const std::string owner = "model '" + model.name + "'";
  for (const PluginSpec& spec : specs) {
    leave_out_if_odd([&] {
      auto plugin = create_plugin(spec, {&model, nullptr, nullptr}, owner);
      if (plugin != nullptr) model.plugins.push_back(std::move(plugin));
    });
  }
  for (LinkSpec& link : model.spec.links) {
    for (SensorSpec& sensor : link.sensors) create_sensor(model, link, sensor);
  }
}

void World::create_sensor(Model& model, const LinkSpec& link, SensorSpec& sensor) {
  const std::string owner =
      "model '" + model.name + "' link '" + link.name + "' sensor '" + sensor.name + "'";
  for (const PluginSpec& spec : sensor.plugins) {
    leave_out_if_odd([&] {
      auto plugin = create_plugin(spec, {&model, model.find_link(link.name), &sensor}, owner);
      if (plugin != nullptr) model.plugins.push_back(std::move(plugin));
    });
  }
  sensor.plugins.clear();
  sensor.params = {};
}

std::unique_ptr<Plugin> World::create_plugin(const PluginSpec& spec, const PluginPlace& place,
                                             const std::string& owner) {
  Model* const model = place.model;
  const PluginFactory* factory = registry_.find_or_load(spec.filename, resources_);
  if (factory == nullptr) {
    // Once of an owner: a course of buoys has one in each buoy.
    if (!told_elements_.insert(owner + " " + spec.filename).second) return nullptr;
    std::string known;
    for (const std::string& name : registry_.names()) known += (known.empty() ? "" : ", ") + name;
    report(Severity::kWarning, owner + ": plugin '" + spec.name + "' (" + spec.filename +
                                   ") is unknown and is left out; known: " + known);
    return nullptr;
  }
  ParamNode params = spec.params;
  if (model != nullptr && params.find("robotNamespace") == nullptr) {
    params.children.push_back({"robotNamespace", model->robot_namespace, {}, {}});
  }
  const PluginParams reader(params, owner + " plugin '" + spec.name + "'");
  std::string name = (model ? model->name : name_) + "::";
  if (place.sensor != nullptr) name += place.link->name + "::" + place.sensor->name + "::";
  auto plugin = factory->create({*this, model, reader, name + spec.name, place.link, place.sensor});
  if (plugin != nullptr) tell_unread(spec, reader);
  return plugin;
}

/// Once in the world, or a fleet would tell it a hundred times.
void World::tell_unread(const PluginSpec& spec, const PluginParams& params) {
  // Of a link that libsdformat has joined to another; it writes the offsets itself.
  const bool is_lumped = params.has("ignition::corrected_offsets");
  std::string list;
  std::size_t count = 0;
  for (const std::string& element : params.unread()) {
    const bool is_offset = element == "xyzOffset" || element == "rpyOffset";
    if (is_of_no_account(spec.filename, element) || (is_offset && is_lumped)) continue;
    if (!told_elements_.insert(spec.filename + " " + element).second) continue;
    list.append(list.empty() ? "<" : ", <").append(element).append(">");
    ++count;
  }
  if (list.empty()) return;
  diagnose({Severity::kWarning,
            params.owner(),
            "elements without effect",
            list + " of " + spec.filename +
                (count == 1 ? " is not known here and has no effect"
                            : " are not known here and have no effect"),
            {{"elements", list}}});
}

void World::tell_overlap(const Model& model) {
  const auto overlap = engine_->deepest_overlap(model);
  if (!overlap || overlap->depth_m <= kDeepContact_m) return;
  const std::string depth = std::to_string(overlap->depth_m);
  diagnose({Severity::kWarning,
            "model '" + model.name + "'",
            "spawned inside",
            "was spawned with '" + overlap->own + "' " + depth + " m inside '" + overlap->other +
                "' and is pushed out slowly",
            {{"collision", overlap->own},
             {"obstacle", overlap->other},
             {"depth_m", depth},
             {"legal", "<= " + std::to_string(kDeepContact_m) + " m"}}});
}

void World::drop_references(const Model& model) {
  const auto of_model = [&model](const Link* link) {
    return std::any_of(model.links.begin(), model.links.end(),
                       [link](const auto& own) { return own.get() == link; });
  };
  drop_if(wrenches_, [&](const AppliedWrench& w) { return of_model(w.link); });
  drop_if(efforts_, [&](const AppliedEffort& e) { return of_model(e.joint->child); });
  drop_if(drives_, [&](const auto& drive) { return of_model(drive->joint().child); });
}

void World::remove(const std::string& name) {
  const auto it = models_.find(name);
  if (it == models_.end()) throw Error("model '" + name + "' does not exist");
  drop_references(*it->second);
  it->second->plugins.clear();
  engine_->destroy(*it->second);
  diagnostics_.forget_model(name);
  models_.erase(it);
  ++models_version_;
  rebuild_schedule();
}

void World::rebuild_schedule() {
  for (auto& phase : schedule_) phase.clear();
  const auto add = [this](Plugin* plugin) {
    for (const Phase phase : plugin->phases()) {
      schedule_[static_cast<std::size_t>(phase)].push_back(plugin);
    }
  };
  std::vector<Model*> models;
  for (const auto& plugin : world_plugins_) add(plugin.get());
  for (const auto& [name, model] : models_) {
    models.push_back(model.get());
    for (const auto& plugin : model->plugins) add(plugin.get());
  }
  engine_->set_models(models);
}

void World::run_phase(Phase phase, const StepInfo& info) {
  for (Plugin* plugin : schedule_[static_cast<std::size_t>(phase)]) {
    plugin->pre_step(phase, *this, info);
  }
}

void World::step(std::uint64_t n) {
  StageTimes* times = profiling_ ? &stage_times_ : nullptr;
  extensions_.begin_steps();
  for (std::uint64_t i = 0; i < n; ++i) {
    const std::uint64_t step = step_count_ + 1;
    const StepInfo info{
        step, time_, time_ + dt_, dt_, physics_.max_step_size_s, step - reset_step_};
    {
      const StageTimer timer(times ? &times->sense_s : nullptr);
      run_phase(Phase::kSense, info);
      extensions_.end_phase(Phase::kSense);
    }
    {
      const StageTimer timer(times ? &times->control_s : nullptr);
      run_phase(Phase::kControl, info);
    }
    {
      const StageTimer timer(times ? &times->actuate_s : nullptr);
      run_phase(Phase::kActuate, info);
      if (!wrenches_.empty() || !efforts_.empty()) apply_external(info);
      for (const auto& drive : drives_) drive->apply(info.dt_s);
    }
    {
      const StageTimer timer(times ? &times->physics_s : nullptr);
      engine_->step(info.dt_s);
    }
    time_ = info.end;
    step_count_ = info.step;
    const StageTimer timer(times ? &times->post_s : nullptr);
    for (Plugin* plugin : schedule_[static_cast<std::size_t>(Phase::kPost)]) {
      plugin->post_step(*this, info);
    }
    extensions_.end_phase(Phase::kPost);
    if (time_ >= next_floor_look_) tell_missing_floor();
    if (times != nullptr) ++times->steps;
  }
}

const std::vector<Contact>& World::contacts() const { return engine_->contacts(); }

World::StageTimes World::take_stage_times() {
  const StageTimes result = stage_times_;
  stage_times_ = {};
  return result;
}

void World::reset_models() {
  reset_step_ = step_count_;
  wrenches_.clear();
  efforts_.clear();
  for (const auto& drive : drives_) drive->reset();
  for (auto& [name, model] : models_) {
    for (const auto& joint : model->joints) joint->reset();
    for (const auto& body : model->bodies) {
      place(*body, body->T_world_body_initial, Eigen::Vector3d::Zero(), Eigen::Vector3d::Zero());
    }
    engine_->push_state(*model);
    for (const auto& plugin : model->plugins) plugin->reset();
  }
  for (const auto& plugin : world_plugins_) plugin->reset();
  engine_->forget_contacts();
  rebuild_schedule();
}

void World::reset() {
  time_ = {};
  step_count_ = 0;
  reset_models();
}

void World::set_physics(const PhysicsSpec& physics) {
  PhysicsSpec checked = physics;
  validate(checked);
  physics_ = checked;
  dt_ = SimTime::from_seconds(physics.max_step_size_s);
  engine_->configure(physics_);
}

Model* World::find_model(const std::string& name) const {
  const auto it = models_.find(name);
  return it == models_.end() ? nullptr : it->second.get();
}

Link* World::find_link(const std::string& scoped_name) const {
  const auto split = scoped_name.find("::");
  if (split != std::string::npos) {
    Model* model = find_model(scoped_name.substr(0, split));
    if (model != nullptr) return model->find_link(scoped_name.substr(split + 2));
  }
  Link* found = nullptr;
  for (const auto& [name, model] : models_) {
    Link* link = model->find_link(scoped_name);
    if (link == nullptr) continue;
    if (found != nullptr) return nullptr;
    found = link;
  }
  return found;
}

void World::set_model_pose(Model& model, const SE3& T_world_model) {
  if (!is_place(T_world_model)) {
    throw Error("model '" + model.name +
                "': pose is not finite, is beyond 1e7 m or has a zero quaternion");
  }
  if (model.is_static) throw Error("model '" + model.name + "' is static and cannot be moved");
  const SE3 target{T_world_model.R.normalized(), T_world_model.p};
  const SE3 T_move = target * model.T_world_model().inverse();
  for (const auto& body : model.bodies) {
    const SE3 moved = T_move * body->T_world_body;
    place(*body, {moved.R.normalized(), moved.p}, T_move.R * body->v_world,
          T_move.R * body->w_world);
  }
  engine_->push_state(model);
}

void World::set_model_twist(Model& model, const Eigen::Vector3d& v_world,
                            const Eigen::Vector3d& w_world) {
  if (!is_motion(v_world, w_world)) {
    throw Error("model '" + model.name + "': twist is not finite, or beyond 1e5 m/s or 1e4 rad/s");
  }
  const Eigen::Vector3d p_world = model.T_world_model().p;
  for (const auto& body : model.bodies) {
    const SE3 T = body->T_world_body;
    place(*body, T, v_world + w_world.cross(T.p - p_world), w_world);
  }
  engine_->push_state(model);
}

void World::set_link_state(Link& link, const SE3& T_world_link, const Eigen::Vector3d& v_world,
                           const Eigen::Vector3d& w_world) {
  if (!is_place(T_world_link) || !is_motion(v_world, w_world)) {
    throw Error("link '" + link.name +
                "': state is not finite, is beyond 1e7 m, 1e5 m/s or 1e4 rad/s, or has a zero "
                "quaternion");
  }
  if (link.body == nullptr) throw Error("link '" + link.name + "' is static and cannot be moved");
  const SE3 T = SE3{T_world_link.R.normalized(), T_world_link.p} * link.T_body_link.inverse();
  place(*link.body, {T.R.normalized(), T.p}, v_world + w_world.cross(T.p - T_world_link.p),
        w_world);
  engine_->push_state(*link.body);
}

}  // namespace trident::sim
