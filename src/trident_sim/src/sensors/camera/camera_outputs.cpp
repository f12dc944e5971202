// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#include "camera_outputs.h"

#include <cmath>

#include "trident_sim/ray_scene.h"

namespace trident::sim {
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
  // sensor_msgs/CameraInfo's plumb_bob.
  info.D = {d.k1, d.k2, d.t1, d.t2, d.k3};
  info.K = {model.fx, model.skew, model.cx, 0, model.fy, model.cy, 0, 0, 1};
  // P[3] of the right camera of a pair is -fx' B; the sum keeps a zero from being negative.
  const double shift = 0.0 - model.fx * setup.baseline_m;
  info.P = {model.fx, model.skew, setup.rectified_cx, shift, 0, model.fy, model.cy, 0, 0, 0, 1, 0};
  if (!setup.projection) return;
  const Projection& p = *setup.projection;
  info.P = {p.fx, 0, p.cx, p.tx, 0, p.fy, p.cy, p.ty, 0, 0, 1, 0};
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
      now_(setup),
      renderer_(
          std::make_unique<CameraRenderer>(context.world, setup.spec, setup.model, setup.owner)),
      stream_(context.world.seed(), context.name + "::" + setup.spec.name) {
  const CameraSetup::Topics& topics = setup.topics;
  image_ = advertise_if_named<ImageSample>(context, topics.image, setup.frame);
  info_ = advertise_if_named<CameraInfoSample>(context, topics.info, setup.frame);
  depth_ = advertise_if_named<ImageSample>(context, topics.depth, setup.frame);
  depth_info_ = advertise_if_named<CameraInfoSample>(context, topics.depth_info, setup.frame);
  cloud_ = advertise_if_named<ImageCloudSample>(context, topics.cloud, setup.frame);
  labels_ = advertise_if_named<ImageSample>(context, topics.labels, setup.frame);
  boxes_ = advertise_if_named<BoundingBoxesSample>(context, topics.boxes, setup.frame);
  const bool in_meters = setup.depth_format == DepthFormat::kMeters;
  describe_image(setup.model, encoding_name(setup.spec.format), channel_count(setup.spec.format),
                 image_);
  describe_image(setup.model, in_meters ? "32FC1" : "16UC1", in_meters ? 4 : 2, depth_);
  describe_image(setup.model, "mono16", 2, labels_);
  describe_camera(setup, info_);
  describe_camera(setup, depth_info_);
}

void CameraOutputs::set_angle_of_view(const std::optional<double>& angle_rad) {
  CameraSetup changed = setup_;
  if (angle_rad) {
    const double focal = 0.5 * setup_.model.width / std::tan(0.5 * *angle_rad);
    // Everything that is proportional to the focal length follows; the center does not.
    const double zoom = focal / setup_.model.fx;
    changed.model.fx *= zoom;
    changed.model.fy *= zoom;
    changed.model.skew *= zoom;
    changed.depth_noise.focal_px *= zoom;
    if (changed.projection) {
      for (double* const value : {&changed.projection->fx, &changed.projection->fy,
                                  &changed.projection->tx, &changed.projection->ty}) {
        *value *= zoom;
      }
    }
  }
  renderer_ = std::make_unique<CameraRenderer>(world_, changed.spec, changed.model, changed.owner);
  now_ = changed;
  describe_camera(now_, info_);
  describe_camera(now_, depth_info_);
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
  // One picture serves all outputs that are wanted, drawn only as far as they need it.
  renderer_->render(T_world_sensor * now_.spec.T_sensor_camera, stream_.bits(number, 0), picture_);
  if (picture_.wants_depths) {
    now_.depth_noise.apply(stream_.bits(number, 1), picture_.depths);
  }
  if (wanted.depth) publish_depths(stamp);
  if (wanted.labels || wanted.boxes) publish_labels(wanted, stamp);
  if (wanted.cloud) {
    write_cloud(picture_, now_.spec.format, now_.model, renderer_->table(), now_.depth_range,
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
  write_depths(picture_.depths, now_.depth_range, now_.depth_format, depth_->value.data);
  publish(depth_, stamp);
}

void CameraOutputs::publish_labels(const Wants& wanted, SimTime stamp) {
  const Labels labels(rays(world_, RayGeometry::kVisual), now_.label_kind);
  if (wanted.labels) {
    write_labels(picture_.shapes, labels, labels_->value.data);
    publish(labels_, stamp);
  }
  if (wanted.boxes) {
    write_boxes(picture_.shapes, now_.model.width, labels, boxes_->value.boxes);
    publish(boxes_, stamp);
  }
}

}  // namespace trident::sim
