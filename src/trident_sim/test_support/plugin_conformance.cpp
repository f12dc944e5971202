// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#include "plugin_conformance.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <map>

#include "test_world.h"
#include "trident_base/error.h"
#include "trident_sim/commands.h"
#include "trident_sim/samples/vector_sample.h"
#include "trident_sim/sdf_loader.h"

namespace trident::sim {
namespace {

class Host {
 public:
  Host(const PluginCase& plugin, void (*register_plugins)(PluginRegistry&)) {
    if (register_plugins != nullptr) register_plugins(world_.registry);
    ModelSpec spec = make_quad();
    spec.plugins = {make_plugin("case", plugin.filename, plugin.params)};
    if (plugin.sensor) {
      LinkSpec& base = spec.links.front();
      base.collisions.push_back(make_collision(SphereShape{0.05}));  // for a bumper
      base.sensors.push_back(*plugin.sensor);
      base.sensors.back().name = "case";
      base.sensors.back().plugins.swap(spec.plugins);
    }
    world_.add(std::move(spec));
  }

  std::vector<std::string> ports() {
    std::vector<std::string> names;
    world_->ports().for_each([&](const PortBase& port) { names.push_back(port.name()); });
    return names;
  }

  void listen() {
    for (const std::string& name : ports()) {
      if (auto* port = world_->ports().find(name, PortDirection::kOut)) port->add_listener();
    }
  }

  /// Numbers of all outputs over some steps with the same inputs each time.
  std::vector<double> outputs() {
    std::vector<double> numbers;
    for (int step = 0; step < 20; ++step) {
      feed(100.0 + step);
      std::map<std::string, std::uint64_t> before;
      world_->ports().for_each([&](const PortBase& port) { before[port.name()] = port.count(); });
      world_->step();
      world_->ports().for_each([&](const PortBase& port) {
        if (port.count() != before[port.name()]) append(port, numbers);
      });
    }
    return numbers;
  }

  World* operator->() { return &*world_; }

 private:
  void feed(double value) {
    for (const std::string& name : ports()) {
      if (auto* in = world_->ports().find_in<ActuatorCommand>(name)) {
        const std::vector<double> speeds(4, value);
        ActuatorCommand command;
        command.angular_velocities.assign({speeds.data(), speeds.size()});
        in->write(command);
      }
      if (auto* in = world_->ports().find_in<TwistCommand>(name)) {
        in->write({{}, {0.01 * value, 0.0, 0.0}, {0.0, 0.0, 0.002 * value}});
      }
      if (auto* in = world_->ports().find_in<TriggerCommand>(name)) in->write({});
      if (auto* in = world_->ports().find_in<ServiceCommand>(name)) in->write({});
    }
  }

  template <class T>
  static const T* value_of(const PortBase& port) {
    const auto* typed = dynamic_cast<const OutPort<T>*>(&port);
    return typed == nullptr ? nullptr : &typed->value;
  }
  static void append(const SE3& T, std::vector<double>& numbers) {
    numbers.insert(numbers.end(), T.p.data(), T.p.data() + 3);
    numbers.insert(numbers.end(), T.R.coeffs().data(), T.R.coeffs().data() + 4);
  }
  static void append(const Eigen::Vector3d& v, std::vector<double>& numbers) {
    numbers.insert(numbers.end(), v.data(), v.data() + 3);
  }

  static void append(const PortBase& port, std::vector<double>& numbers) {
    if (port.direction() != PortDirection::kOut) return;
    if (const auto* odometry = value_of<OdometrySample>(port)) {
      numbers.push_back(odometry->stamp.seconds());
      append(odometry->T_parent_child, numbers);
      append(odometry->v_child, numbers);
      append(odometry->w_child, numbers);
    } else if (const auto* imu = value_of<ImuSample>(port)) {
      numbers.push_back(imu->stamp.seconds());
      append(imu->a_imu, numbers);
      append(imu->w_imu, numbers);
    } else if (const auto* pressure = value_of<FluidPressureSample>(port)) {
      numbers.push_back(pressure->pressure_pa);
    } else if (const auto* magnetic = value_of<MagneticFieldSample>(port)) {
      append(magnetic->field_t, numbers);
    } else if (const auto* fix = value_of<GnssFixSample>(port)) {
      numbers.insert(numbers.end(), {fix->latitude_deg, fix->longitude_deg, fix->altitude_m});
    } else if (const auto* status = value_of<GnssStatusSample>(port)) {
      numbers.insert(numbers.end(),
                     {status->stamp.seconds(), static_cast<double>(status->satellites),
                      static_cast<double>(status->fix_type)});
    } else if (const auto* twist = value_of<TwistSample>(port)) {
      append(twist->v, numbers);
      append(twist->w, numbers);
    } else if (const auto* scan = value_of<LaserScanSample>(port)) {
      numbers.push_back(scan->stamp.seconds());
      numbers.insert(numbers.end(), scan->ranges.begin(), scan->ranges.end());
    } else if (const auto* image = value_of<ImageSample>(port)) {
      numbers.push_back(image->stamp.seconds());
      numbers.insert(numbers.end(), image->data.begin(), image->data.end());
    } else if (const auto* info = value_of<CameraInfoSample>(port)) {
      numbers.push_back(info->stamp.seconds());
    } else if (const auto* cloud = value_of<LidarCloudSample>(port)) {
      numbers.push_back(cloud->stamp.seconds());
      for (const LidarPoint& point : cloud->points) {
        numbers.insert(numbers.end(), {point.x, point.y, point.z, point.intensity, point.time});
      }
    } else if (const auto* points = value_of<PointListSample>(port)) {
      for (const Eigen::Vector3f& p : points->points) append(p.cast<double>(), numbers);
    } else if (const auto* range = value_of<RangeSample>(port)) {
      numbers.insert(numbers.end(), {range->stamp.seconds(), range->range_m});
    } else if (const auto* contacts = value_of<ContactsSample>(port)) {
      numbers.push_back(contacts->stamp.seconds());
      for (const TouchSample& touch : contacts->touches) {
        for (const Eigen::Vector3d& force : touch.forces) append(force, numbers);
      }
    } else if (const auto* speeds = value_of<ActuatorState>(port)) {
      const auto view = speeds->angular_velocities.view();
      numbers.push_back(speeds->stamp.seconds());
      numbers.insert(numbers.end(), view.begin(), view.end());
    } else if (const auto* joints = value_of<JointStateSample>(port)) {
      numbers.insert(numbers.end(), joints->positions.begin(), joints->positions.end());
      numbers.insert(numbers.end(), joints->velocities.begin(), joints->velocities.end());
    } else if (const auto* scalar = value_of<ScalarSample>(port)) {
      numbers.push_back(scalar->value);
    } else if (const auto* wind = value_of<WindSample>(port)) {
      append(wind->v_world, numbers);
    } else if (const auto* vector = value_of<VectorSample>(port)) {
      append(vector->value, numbers);
    } else if (const auto* point = value_of<PointSample>(port)) {
      append(point->p_frame, numbers);
    } else if (const auto* wrench = value_of<WrenchSample>(port)) {
      append(wrench->force, numbers);
    } else {
      numbers.push_back(1.0);  // a type of the plugin's own: that it was sent
    }
  }

  TestWorld world_;
};

PluginCase without(PluginCase plugin, const std::string& key) {
  auto& params = plugin.params;
  params.erase(std::remove_if(params.begin(), params.end(),
                              [&](const auto& param) { return param.first == key; }),
               params.end());
  return plugin;
}

PluginCase with(PluginCase plugin, const std::string& key, const std::string& value) {
  plugin = without(std::move(plugin), key);
  plugin.params.emplace_back(key, value);
  return plugin;
}

}  // namespace

PluginCase case_of(const std::string& filename, const PluginExample& example) {
  std::string sdf =
      "<plugin name='example' filename='" + filename + "'>" + example.elements + "</plugin>";
  if (!example.sensor.empty()) {
    const std::string end = "</sensor>";
    const std::size_t at = example.sensor.rfind(end);
    if (at == std::string::npos) throw Error("example of '" + filename + "': no " + end);
    sdf = example.sensor.substr(0, at) + sdf + end;
  }
  // A plugin belongs to the model, a sensor to its link.
  sdf = example.sensor.empty() ? "<link name='base_link'/>" + sdf
                               : "<link name='base_link'>" + sdf + "</link>";
  const ModelSpec model = load_model_string(
      "<sdf version='1.6'><model name='example'>" + sdf + "</model></sdf>",
      "example of '" + filename + "'", Resources(std::vector<std::string>{}), [](const auto&) {});
  PluginCase result{filename, {}, example.required, example.numbers};
  if (!example.sensor.empty()) {
    result.sensor = model.links.at(0).sensors.at(0);
    result.sensor->plugins.clear();
  }
  const PluginSpec& plugin =
      example.sensor.empty() ? model.plugins.at(0) : model.links.at(0).sensors.at(0).plugins.at(0);
  result.params.emplace_back("robotNamespace", "ns");
  for (const ParamNode& node : plugin.params.children) {
    result.params.emplace_back(node.name, node.text);
  }
  return result;
}

void expect_plugin_conforms(const PluginCase& plugin, void (*register_plugins)(PluginRegistry&)) {
  SCOPED_TRACE(plugin.filename);
  const auto refusal = [&](const PluginCase& bad) {
    return error_of([&] { Host(bad, register_plugins); });
  };
  for (const std::string& key : plugin.required) {
    const std::string error = refusal(without(plugin, key));
    EXPECT_TRUE(contains(error, "<" + key + ">"));
    EXPECT_TRUE(contains(error, "model 'quad' "));
    EXPECT_TRUE(contains(error, " plugin 'case'"));
  }
  for (const std::string& key : plugin.numbers) {
    for (const char* value : {"nan", "inf", "much", ""}) {
      EXPECT_TRUE(contains(refusal(with(plugin, key, value)), "<" + key + ">"));
    }
  }
  Host host(plugin, register_plugins);
  EXPECT_FALSE(host.ports().empty());
  host.listen();
  const std::vector<double> first = host.outputs();
  EXPECT_FALSE(first.empty());
  host->reset();
  EXPECT_EQ(host.outputs(), first) << "after a reset";
  const Snapshot snapshot = host->save_snapshot();
  const std::vector<double> next = host.outputs();
  host->restore_snapshot(snapshot);
  EXPECT_EQ(host.outputs(), next) << "after a snapshot";
  host->remove("quad");
  EXPECT_TRUE(host.ports().empty());
}

}  // namespace trident::sim
