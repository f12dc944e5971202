// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#include "camera_outputs.h"

#include "trident_sim/ray_scene.h"

namespace trident {
namespace {

template <class Sample>
OutHandle<Sample> advertise_if_named(const PluginContext& context, const std::string& name,
                                     const std::string& frame) {
  if (name.empty()) return {};
  OutHandle<Sample> port = advertise<Sample>(context, name, PortRank::kSensor);
  port->value.frame = frame;
  return port;
}

template <class Sample>
bool is_wanted(const OutHandle<Sample>& port) {
  return port && port->wanted();
}

void describe_image(const CameraModel& model, const char* encoding, int bytes_per_pixel,
                    const OutHandle<ImageSample>& port) {
  if (!port) return;
  ImageSample& image = port->value;
  image.encoding = encoding;
  image.width = static_cast<std::uint32_t>(model.width);
  image.height = static_cast<std::uint32_t>(model.height);
  image.bytes_per_row = image.width * static_cast<std::uint32_t>(bytes_per_pixel);
}

void describe_camera(const CameraSetup& setup, const OutHandle<CameraInfoSample>& port) {
  if (!port) return;
  const CameraModel& model = setup.model;
  const Distortion& d = model.distortion;
  CameraInfoSample& info = port->value;
  info.width = static_cast<std::uint32_t>(model.width);
  info.height = static_cast<std::uint32_t>(model.height);
  info.D = {d.k1, d.k2, d.t1, d.t2, d.k3};
  info.K = {model.fx, 0, model.cx, 0, model.fy, model.cy, 0, 0, 1};
  const double shift = 0.0 - model.fx * setup.baseline_m;
  info.P = {model.fx, 0, setup.rectified_cx, shift, 0, model.fy, model.cy, 0, 0, 0, 1, 0};
}

template <class Sample>
void publish(const OutHandle<Sample>& port, SimTime stamp) {
  port->value.stamp = stamp;
  port->publish();
}

}  // namespace

CameraOutputs::CameraOutputs(const PluginContext& context, const CameraSetup& setup)
    : world_(context.world),
      setup_(setup),
      renderer_(context.world, setup.spec, setup.model, setup.owner),
      stream_(context.world.seed(), context.name + "::" + setup.spec.name) {
  const CameraSetup::Topics& topics = setup.topics;
  image_ = advertise_if_named<ImageSample>(context, topics.image, setup.frame);
  info_ = advertise_if_named<CameraInfoSample>(context, topics.info, setup.frame);
  depth_ = advertise_if_named<ImageSample>(context, topics.depth, setup.frame);
  depth_info_ = advertise_if_named<CameraInfoSample>(context, topics.depth_info, setup.frame);
  cloud_ = advertise_if_named<ImageCloudSample>(context, topics.cloud, setup.frame);
  labels_ = advertise_if_named<ImageSample>(context, topics.labels, setup.frame);
  boxes_ = advertise_if_named<BoundingBoxesSample>(context, topics.boxes, setup.frame);
  const bool in_metres = setup.depth_format == DepthFormat::kMetres;
  describe_image(setup.model, encoding_name(setup.spec.format), channel_count(setup.spec.format),
                 image_);
  describe_image(setup.model, in_metres ? "32FC1" : "16UC1", in_metres ? 4 : 2, depth_);
  describe_image(setup.model, "mono16", 2, labels_);
  describe_camera(setup, info_);
  describe_camera(setup, depth_info_);
}

CameraOutputs::Wants CameraOutputs::wants() const {
  return {is_wanted(image_), is_wanted(depth_), is_wanted(cloud_), is_wanted(labels_),
          is_wanted(boxes_)};
}

void CameraOutputs::measure(const SE3& T_world_sensor, SimTime stamp, std::uint64_t number) {
  publish_infos(stamp);
  const Wants wanted = wants();
  if (!wanted.picture()) return;
  picture_.wants_colors = wanted.image || wanted.cloud;
  picture_.wants_depths = wanted.depth || wanted.cloud;
  picture_.wants_shapes = wanted.labels || wanted.boxes;
  renderer_.render(T_world_sensor * setup_.spec.T_sensor_camera, stream_.bits(number, 0), picture_);
  if (picture_.wants_depths) {
    setup_.depth_noise.apply(stream_.bits(number, 1), picture_.depths);
  }
  if (wanted.depth) publish_depths(stamp);
  if (wanted.labels || wanted.boxes) publish_labels(wanted, stamp);
  if (wanted.cloud) {
    write_cloud(picture_, setup_.spec.format, setup_.model, renderer_.table(), setup_.depth_range,
                cloud_->value);
    publish(cloud_, stamp);
  }
  if (wanted.image) {
    image_->value.data.swap(picture_.colors);
    publish(image_, stamp);
  }
}

void CameraOutputs::publish_infos(SimTime stamp) {
  if (is_wanted(info_)) publish(info_, stamp);
  if (is_wanted(depth_info_)) publish(depth_info_, stamp);
}

void CameraOutputs::publish_depths(SimTime stamp) {
  write_depths(picture_.depths, setup_.depth_range, setup_.depth_format, depth_->value.data);
  publish(depth_, stamp);
}

void CameraOutputs::publish_labels(const Wants& wanted, SimTime stamp) {
  const Labels labels(world_.rays(RayGeometry::kVisual), setup_.label_kind);
  if (wanted.labels) {
    write_labels(picture_.shapes, labels, labels_->value.data);
    publish(labels_, stamp);
  }
  if (wanted.boxes) {
    write_boxes(picture_.shapes, setup_.model.width, labels, boxes_->value.boxes);
    publish(boxes_, stamp);
  }
}

}  // namespace trident
