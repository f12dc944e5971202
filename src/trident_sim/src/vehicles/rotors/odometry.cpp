// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#include <deque>

#include "core/plugins/plugin_util.h"
#include "trident_base/random_stream.h"
#include "trident_sim/plugin_registry.h"

namespace trident::sim {
namespace {

/// Normal plus uniform noise on a 3-vector, as a function of the sample number.
struct VectorNoise {
  Eigen::Vector3d normal_stddev, uniform_bound;
  std::uint32_t channel;

  bool zero() const { return normal_stddev.isZero() && uniform_bound.isZero(); }
  Eigen::Vector3d sample(const RandomStream& stream, std::uint64_t index) const {
    Eigen::Vector3d value;
    for (int i = 0; i < 3; ++i) {
      const auto axis = channel + static_cast<std::uint32_t>(i);
      value[i] = normal_stddev[i] * stream.normal(index, axis) +
                 uniform_bound[i] * (2.0 * stream.uniform(index, axis) - 1.0);
    }
    return value;
  }
  Eigen::Vector3d variance() const { return normal_stddev.cwiseAbs2(); }
};

/// RotorS' elements: a Gaussian and a uniform part are added; only the Gaussian's variance is in
/// the published covariance, as there.
VectorNoise read_noise(const PluginParams& params, const std::string& what, std::uint32_t channel) {
  VectorNoise noise{params.vector3("noiseNormal" + what, Eigen::Vector3d::Zero()),
                    params.vector3("noiseUniform" + what, Eigen::Vector3d::Zero()), channel};
  if (noise.normal_stddev.minCoeff() < 0.0 || noise.uniform_bound.minCoeff() < 0.0) {
    params.refuse("noiseNormal" + what, "negative", "values >= 0 in noiseNormal/noiseUniform");
  }
  return noise;
}

/// The pose of a link's centre of mass in the parent frame and its twist in the link's frame, on
/// the five topics of RotorS and in the frame tree.
class Odometry : public MeasuringPlugin {
 public:
  explicit Odometry(const PluginContext& context)
      : MeasuringPlugin(context.world.timing()),
        link_(required_link(context, "linkName")),
        stream_(context.world.seed(), context.name) {
    const PluginParams& params = context.params;
    noise_.position = read_noise(params, "Position", 0);
    noise_.rotation = read_noise(params, "Quaternion", 3);
    noise_.linear = read_noise(params, "LinearVelocity", 6);
    noise_.angular = read_noise(params, "AngularVelocity", 9);
    divisor_ = static_cast<std::uint64_t>(params.integer("measurementDivisor", 1, {1, 1e9}));
    delay_steps_ = static_cast<std::size_t>(params.integer("measurementDelay", 0, {0, 100000}));
    unknown_delay_ = SimTime::from_seconds(params.number("unknownDelay", 0.0, {0.0, 1e6}));
    if (!params.text("covarianceImage", "").empty()) {
      params.refuse("covarianceImage", params.text("covarianceImage", ""),
                    "no such element: not supported");
    }
    make_ports(context);
  }

  void reset() override { delayed_.clear(); }
  void state(StateArchive& archive) override { archive(delayed_); }

 protected:
  // The delay counts in steps of the model's own samples, which restart with a reset.
  void measure(const World&, const StepInfo& info) override {
    if (!anyone_listens()) return;
    const bool is_due = info.sample % divisor_ == 0;
    if (delay_steps_ == 0) {
      if (!is_due) return;
      sample(info, odometry_->value);
      send(odometry_->value);
      return;
    }
    if (is_due) {
      sample(info, scratch_);
      delayed_.push_back({info.sample + delay_steps_, scratch_});
    }
    send_delayed(info);
  }

  void send_delayed(const StepInfo& info) {
    // What became due while nobody listened is of no use to who listens now.
    while (!delayed_.empty() && delayed_.front().first < info.sample) delayed_.pop_front();
    if (delayed_.empty() || delayed_.front().first > info.sample) return;
    odometry_->value = delayed_.front().second;
    delayed_.pop_front();
    send(odometry_->value);
  }

 private:
  void make_ports(const PluginContext& context) {
    const PluginParams& params = context.params;
    const auto topic = [&](const char* key, const char* fallback) {
      return scoped_topic(params, params.text(key, fallback));
    };
    odometry_ =
        advertise<OdometrySample>(context, topic("odometryTopic", "odometry"), PortRank::kOdometry);
    pose_ = advertise<PoseSample>(context, topic("poseTopic", "pose"), PortRank::kOdometry);
    pose_with_covariance_ = advertise<PoseWithCovarianceSample>(
        context, topic("poseWithCovarianceTopic", "pose_with_covariance"), PortRank::kOdometry);
    point_ =
        advertise<PointSample>(context, topic("positionTopic", "position"), PortRank::kOdometry);
    transform_ = advertise<TransformSample>(context, topic("transformTopic", "transform"),
                                            PortRank::kOdometry);
    const std::string parent = params.text("parentFrameId", "world");
    const std::string child = params.text("childFrameId", "odometry_sensor");
    frame_ = advertise_frame(context, parent, child);
    OdometrySample& value = odometry_->value;
    value.parent_frame = parent;
    value.child_frame = child;
    fill_diagonal(value.pose_covariance, noise_.position.variance(), noise_.rotation.variance());
    fill_diagonal(value.twist_covariance, noise_.linear.variance(), noise_.angular.variance());
    scratch_ = value;
    pose_->value.frame = parent;
    pose_with_covariance_->value.frame = parent;
    pose_with_covariance_->value.covariance = value.pose_covariance;
    point_->value.frame = parent;
    transform_->value.parent_frame = parent;
    transform_->value.child_frame = child;
  }

  static void fill_diagonal(Covariance6& covariance, const Eigen::Vector3d& first,
                            const Eigen::Vector3d& second) {
    covariance.fill(0.0);
    for (std::size_t i = 0; i < 3; ++i) {
      covariance[7 * i] = first[static_cast<Eigen::Index>(i)];
      covariance[7 * (i + 3)] = second[static_cast<Eigen::Index>(i)];
    }
  }

  // Ports are counted one by one: which topics exist does not change what is computed.
  bool anyone_listens() const {
    return odometry_->wanted() || pose_->wanted() || pose_with_covariance_->wanted() ||
           point_->wanted() || transform_->wanted() || (frame_ && frame_->wanted());
  }

  // The position is the centre of mass', the velocity the link origin's, as RotorS reads both from
  // Gazebo.
  void sample(const StepInfo& info, OdometrySample& out) const {
    out.stamp = info.end + unknown_delay_;
    const SE3 T_world_link = link_.T_world_link();
    out.T_parent_child = {T_world_link.R, link_.p_world_com()};
    const Eigen::Quaterniond R_link_world = T_world_link.R.conjugate();
    out.v_child = R_link_world * link_velocity_world(link_);
    out.w_child = R_link_world * link_.w_world();
    if (!noise_.position.zero())
      out.T_parent_child.p += noise_.position.sample(stream_, info.sample);
    if (!noise_.rotation.zero()) {
      const Eigen::Vector3d half = 0.5 * noise_.rotation.sample(stream_, info.sample);
      // First order of the exponential map: noise of a rotation vector, in the body's frame.
      const Eigen::Quaterniond small(1.0, half.x(), half.y(), half.z());
      out.T_parent_child.R = (out.T_parent_child.R * small).normalized();
    }
    if (!noise_.linear.zero()) out.v_child += noise_.linear.sample(stream_, info.sample);
    if (!noise_.angular.zero()) out.w_child += noise_.angular.sample(stream_, info.sample);
  }

  void send(const OdometrySample& out) {
    if (frame_ && frame_->wanted()) {
      frame_->value.stamp = out.stamp;
      frame_->value.T_parent_child = out.T_parent_child;
      frame_->publish();
    }
    if (transform_->wanted()) {
      transform_->value.stamp = out.stamp;
      transform_->value.T_parent_child = out.T_parent_child;
      transform_->publish();
    }
    if (odometry_->wanted()) odometry_->publish();
    if (pose_->wanted()) {
      pose_->value.stamp = out.stamp;
      pose_->value.T_frame_body = out.T_parent_child;
      pose_->publish();
    }
    if (pose_with_covariance_->wanted()) {
      pose_with_covariance_->value.stamp = out.stamp;
      pose_with_covariance_->value.T_frame_body = out.T_parent_child;
      pose_with_covariance_->publish();
    }
    if (point_->wanted()) {
      point_->value.stamp = out.stamp;
      point_->value.p_frame = out.T_parent_child.p;
      point_->publish();
    }
  }

  struct Noise {
    VectorNoise position, rotation, linear, angular;
  };

  Link& link_;
  RandomStream stream_;
  Noise noise_;
  std::uint64_t divisor_ = 1;
  std::size_t delay_steps_ = 0;
  SimTime unknown_delay_;
  std::deque<std::pair<std::uint64_t, OdometrySample>> delayed_;
  OdometrySample scratch_;
  OutHandle<OdometrySample> odometry_;
  OutHandle<PoseSample> pose_;
  OutHandle<PoseWithCovarianceSample> pose_with_covariance_;
  OutHandle<PointSample> point_;
  OutHandle<TransformSample> transform_;
  OutHandle<FrameSample> frame_;
};

const PluginRegistrar kRotorsGazeboOdometryPlugin(
    "librotors_gazebo_odometry_plugin.so", factory_of<Odometry>(),
    PluginExample{"<linkName>base_link</linkName><measurementDelay>2</measurementDelay>"
                  "<noiseNormalPosition>0.1 0.1 0.1</noiseNormalPosition>",
                  {"linkName"},
                  {"measurementDivisor", "measurementDelay", "unknownDelay", "noiseNormalPosition",
                   "noiseUniformAngularVelocity"}});

}  // namespace

}  // namespace trident::sim
