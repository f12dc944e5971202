// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#include "core/plugins/rate_ticker.h"
#include "drive_parts.h"
#include "trident_base/random_stream.h"
#include "trident_sim/plugin_registry.h"

namespace trident::sim {
namespace {

SE3 read_offset(const PluginParams& params) {
  const Eigen::Vector3d p = params.vector3("xyzOffset", Eigen::Vector3d::Zero());
  const Eigen::Vector3d rpy = params.vector3("rpyOffset", Eigen::Vector3d::Zero());
  return SE3::from_xyz_rpy(p, rpy.x(), rpy.y(), rpy.z());
}

/// The link that <frameName> means; nullptr: the world.
const Link* find_reference(const PluginContext& context, const std::string& frame) {
  const std::string bare = frame.substr(frame.find_first_not_of('/') == 1 ? 1 : 0);
  if (bare == "world" || bare == "map") return nullptr;
  const Link* const link = context.model->find_link(bare);
  if (link == nullptr) context.params.refuse("frameName", frame, "world, map or a link");
  return link;
}

/// libgazebo_ros_p3d.so: the true pose of a link, with the velocities of its origin in the axes of
/// the frame, as upstream publishes them, or with <twistFrame> child, ours, in those of the link,
/// as nav_msgs/Odometry wants them. <bodyName>, <topicName>, <frameName> (world, map or a link of
/// the model), <xyzOffset>, <rpyOffset>, <gaussianNoise> of the velocities, <updateRate> (0: every
/// step). Ours: <tfFrameName>, the parent of a transform with the pose, too; the odometry then
/// names the same frames, which are prefixed by the namespace where there is no tf_prefix.
class P3d : public Plugin {
 public:
  explicit P3d(const PluginContext& context)
      : link_(required_link(context, "bodyName")),
        offset_(read_offset(context.params)),
        noise_(context.params.number("gaussianNoise", 0.0, {0.0, 1e6})),
        stream_(context.world.seed(), context.name),
        ticker_(context.params.number("updateRate", 0.0, {0.0, 1e9})) {
    const PluginParams& params = context.params;
    const std::string frame = params.text("frameName", "world");
    reference_ = find_reference(context, frame);
    const std::string twist = params.text("twistFrame", "parent");
    if (twist != "parent" && twist != "child") {
      params.refuse("twistFrame", twist, "parent, child");
    }
    is_twist_of_child_ = twist == "child";
    odometry_ = advertise<OdometrySample>(
        context, scoped_topic(params, params.required_text("topicName")), PortRank::kOdometry);
    OdometrySample& value = odometry_->value;
    value.parent_frame = resolved_frame(context, frame, FramePrefix::kTfPrefix);
    value.child_frame = resolved_frame(context, link_.name, FramePrefix::kTfPrefix);
    const std::string tf_frame = params.text("tfFrameName", "");
    if (!tf_frame.empty()) {
      constexpr auto kFrom = FramePrefix::kTfPrefixOrNamespace;
      value.parent_frame = resolved_frame(context, tf_frame, kFrom);
      value.child_frame = resolved_frame(context, link_.name, kFrom);
      frame_ = advertise_frame(context, value.parent_frame, value.child_frame);
    }
    for (std::size_t i = 0; i < 6; ++i) {
      // As upstream, although only the velocities are disturbed.
      value.pose_covariance[7 * i] = value.twist_covariance[7 * i] = noise_ * noise_;
    }
  }

  std::vector<Phase> phases() const override { return {Phase::kPost}; }

  void post_step(const World&, const StepInfo& info) override {
    if (!ticker_.tick(info) || !is_wanted()) return;
    OdometrySample& value = odometry_->value;
    const SE3 T_world_frame = reference_ == nullptr ? SE3() : reference_->T_world_link();
    const Eigen::Quaterniond R_frame_world = T_world_frame.R.conjugate();
    Eigen::Vector3d v = link_velocity_world(link_), w = link_.w_world();
    if (reference_ != nullptr) {
      // As upstream, the difference of the velocities, without the part w x r of a turning frame.
      v -= link_velocity_world(*reference_);
      w -= reference_->w_world();
    }
    const SE3 T_frame_link = T_world_frame.inverse() * link_.T_world_link();
    value.stamp = info.end;
    // As upstream, the offset is in the axes of the reference frame, not in those of the link.
    value.T_parent_child.p = T_frame_link.p + offset_.p;
    value.T_parent_child.R = (offset_.R * T_frame_link.R).normalized();
    const Eigen::Quaterniond R_twist_world =
        is_twist_of_child_ ? value.T_parent_child.R.conjugate() * R_frame_world : R_frame_world;
    value.v_child = R_twist_world * v + disturbance(info, 0);
    value.w_child = R_twist_world * w + disturbance(info, 3);
    odometry_->publish();
    if (frame_) publish_frame(value);
  }

  void reset() override { ticker_.reset(); }
  void state(StateArchive& archive) override { ticker_.state(archive); }

 private:
  bool is_wanted() const { return odometry_->wanted() || (frame_ && frame_->wanted()); }

  void publish_frame(const OdometrySample& odometry) {
    frame_->value.stamp = odometry.stamp;
    frame_->value.T_parent_child = odometry.T_parent_child;
    frame_->publish();
  }

  Eigen::Vector3d disturbance(const StepInfo& info, std::uint32_t channel) const {
    if (noise_ == 0.0) return Eigen::Vector3d::Zero();
    return noise_ * Eigen::Vector3d(stream_.normal(info.sample, channel),
                                    stream_.normal(info.sample, channel + 1),
                                    stream_.normal(info.sample, channel + 2));
  }

  const Link& link_;
  const Link* reference_ = nullptr;
  SE3 offset_;
  double noise_;
  bool is_twist_of_child_ = false;
  RandomStream stream_;
  RateTicker ticker_;
  OutHandle<OdometrySample> odometry_;
  OutHandle<FrameSample> frame_;
};

const PluginRegistrar kGazeboRosP3d("libgazebo_ros_p3d.so", factory_of<P3d>(),
                                    PluginExample{
                                        "<bodyName>base_link</bodyName><topicName>truth</topicName>"
                                        "<gaussianNoise>0.1</gaussianNoise>",
                                        {"bodyName", "topicName"},
                                        {"gaussianNoise", "updateRate", "xyzOffset", "rpyOffset"}});

}  // namespace

}  // namespace trident::sim
