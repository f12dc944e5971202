// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#include "port_access.h"

#include <map>
#include <typeindex>

#include "trident_base/error.h"
#include "trident_control_sim/lee_plugin.h"
#include "trident_sim/commands.h"
#include "trident_sim/samples.h"
#include "trident_sim/samples/battery_sample.h"
#include "trident_sim/samples/text_sample.h"
#include "trident_sim/samples/vector_sample.h"

namespace py = pybind11;

namespace trident::sim {
namespace {

template <class Sample>
std::pair<const std::type_index, PortType> entry(const char* name) {
  // The type was compared before either is called.
  return {typeid(Sample),
          {name,
           [](const PortBase& port) {
             return py::cast(static_cast<const OutPort<Sample>&>(port).value);
           },
           [](PortBase& port, const py::handle& sample) {
             static_cast<InPort<Sample>&>(port).write(sample.cast<const Sample&>());
           },
           InPort<Sample>::kDepth}};
}

/// A number of single precision is a number like any other to Python.
std::pair<const std::type_index, PortType> single_number() {
  return {typeid(SingleNumber),
          {"ScalarSample", nullptr,
           [](PortBase& port, const py::handle& sample) {
             const auto number = sample.cast<ScalarSample>();
             static_cast<InPort<SingleNumber>&>(port).write({number.stamp, number.value});
           },
           InPort<SingleNumber>::kDepth}};
}

const std::map<std::type_index, PortType>& port_types() {
  static const std::map<std::type_index, PortType> types = {
      entry<ActuatorCommand>("ActuatorCommand"),
      entry<ActuatorState>("ActuatorState"),
      entry<BoundingBoxesSample>("BoundingBoxesSample"),
      entry<CameraInfoSample>("CameraInfoSample"),
      entry<ContactsSample>("ContactsSample"),
      entry<DriveCommand>("DriveCommand"),
      entry<EnvironmentSample>("EnvironmentSample"),
      entry<FluidPressureSample>("FluidPressureSample"),
      entry<FrameSample>("FrameSample"),
      entry<GnssFixSample>("GnssFixSample"),
      entry<GnssStatusSample>("GnssStatusSample"),
      entry<ImageCloudSample>("ImageCloudSample"),
      entry<ImageSample>("ImageSample"),
      entry<BatterySample>("BatterySample"),
      entry<ImuSample>("ImuSample"),
      entry<JointCommand>("JointCommand"),
      entry<JointStateSample>("JointStateSample"),
      entry<LaserScanSample>("LaserScanSample"),
      entry<LidarCloudSample>("LidarCloudSample"),
      entry<MagneticFieldSample>("MagneticFieldSample"),
      entry<NumberSample>("NumberSample"),
      entry<OdometrySample>("OdometrySample"),
      entry<PathCommand>("PathCommand"),
      entry<PointListSample>("PointListSample"),
      entry<PointSample>("PointSample"),
      entry<PoseSample>("PoseSample"),
      entry<PoseWithCovarianceSample>("PoseWithCovarianceSample"),
      entry<RangeSample>("RangeSample"),
      entry<ScalarSample>("ScalarSample"),
      entry<ServiceCommand>("ServiceCommand"),
      single_number(),
      entry<StampedNumber>("StampedNumber"),
      entry<TextCommand>("TextCommand"),
      entry<control::TrajectorySample>("TrajectorySample"),
      entry<TransformSample>("TransformSample"),
      entry<TriggerCommand>("TriggerCommand"),
      entry<TwistSample>("TwistSample"),
      entry<TwistCommand>("TwistCommand"),
      entry<VectorSample>("VectorSample"),
      entry<WindReadingSample>("WindReadingSample"),
      entry<WindSample>("WindSample"),
      entry<WrenchSample>("WrenchSample"),
  };
  return types;
}

}  // namespace

const PortType* find_port_type(const PortBase& port) {
  const auto it = port_types().find(port.type());
  return it == port_types().end() ? nullptr : &it->second;
}

PortBase& PortView::required(PortDirection direction) const {
  if (PortBase* port = find(direction)) return *port;
  const bool other_direction =
      find(direction == PortDirection::kOut ? PortDirection::kIn : PortDirection::kOut) != nullptr;
  const char* kind = direction == PortDirection::kOut ? "output" : "input";
  throw Error("port '" + name_ + "' " +
              (other_direction ? std::string("is not an ") + kind : "is no longer in the world"));
}

const PortType& PortView::required_type(const PortBase& port) const {
  if (const PortType* type = find_port_type(port)) return *type;
  throw Error("port '" + name_ +
              "' carries a type that Python does not know: " + port.type().name());
}

std::string PortView::type() const {
  const PortBase* port = find(PortDirection::kOut);
  if (port == nullptr) port = &required(PortDirection::kIn);
  const PortType* type = find_port_type(*port);
  return type != nullptr ? type->name : port->type().name();
}

std::uint64_t PortView::count() const {
  const PortBase* port = find(PortDirection::kOut);
  return (port != nullptr ? *port : required(PortDirection::kIn)).count();
}

py::object PortView::value() {
  const PortBase& port = required(PortDirection::kOut);
  const PortType& type = required_type(port);
  if (!subscribed()) subscribe(true);
  if (port.count() == 0) {
    throw Error("port '" + name_ + "' has no value yet; it is subscribed now, step the world");
  }
  return type.read(port);
}

py::object PortView::read() {
  const PortBase& port = required(PortDirection::kOut);
  const PortType& type = required_type(port);
  if (!subscribed()) subscribe(true);
  // A restored snapshot has counts of its own: everything in it is new to the reader.
  if (restores_seen_ != session_->restore_count()) {
    restores_seen_ = session_->restore_count();
    seen_ = 0;
  }
  if (port.count() == seen_) return py::none();
  seen_ = port.count();
  return type.read(port);
}

void PortView::write(const py::args& args, const py::kwargs& kwargs) {
  PortBase& port = required(PortDirection::kIn);
  const PortType& type = required_type(port);
  const py::object sample_class = py::module_::import("trident_sim._core").attr(type.name);
  // Either a sample as it is, or the arguments that its class is made of.
  const bool is_sample =
      args.size() == 1 && kwargs.empty() && py::isinstance(args[0], sample_class);
  const py::object sample =
      is_sample ? py::reinterpret_borrow<py::object>(args[0]) : sample_class(*args, **kwargs);
  // A port holds few values between two steps; more would be lost silently.
  session_->count_write(port, type.depth);
  type.write(port, sample);
}

}  // namespace trident::sim
