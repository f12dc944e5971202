// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <limits>
#include <optional>
#include <string>
#include <variant>
#include <vector>

#include "trident_base/se3.h"
#include "trident_sim/param_tree.h"

namespace trident::sim {

// What a world and a model are made of, as plain data. The SDF reader fills it; nothing else in the
// simulator sees libsdformat, whose documents cost tens of megabytes each.

struct BoxShape {
  Eigen::Vector3d size;  ///< full edge lengths [m]
};
struct SphereShape {
  double radius;  ///< [m]
};
struct CylinderShape {
  double radius, length;  ///< [m], axis along z
};
struct CapsuleShape {
  double radius, length;  ///< [m], axis along z, length without the caps
};
struct PlaneShape {
  Eigen::Vector3d normal;
};
struct MeshShape {
  std::string file;  ///< resolved path
  Eigen::Vector3d scale;
};
struct HeightmapShape {
  std::string file;      ///< resolved path of a PNG or PGM picture, of any size
  Eigen::Vector3d size;  ///< extents [m]; black is at z 0, the brightest pixel at size.z
};
using Shape = std::variant<BoxShape, SphereShape, CylinderShape, CapsuleShape, PlaneShape,
                           MeshShape, HeightmapShape>;

/// Contact parameters of one collision, with Gazebo's defaults.
struct Surface {
  double mu = 1.0, mu2 = 1.0;
  Eigen::Vector3d fdir1 = Eigen::Vector3d::Zero();  ///< collision frame; zero: any direction
  double slip1 = 0.0, slip2 = 0.0;
  double restitution = 0.0;
  double bounce_threshold_m_s = 1e5;
  double kp_n_m = 1e12, kd_ns_m = 1.0;
  double min_depth_m = 0.0;  ///< to which nothing is pushed out
  /// Of the speed at which what is deeper is pushed out, what may remain after the step, >= 0
  double max_vel_m_s = 0.01;
  std::uint32_t collide_bitmask = 0xffff;
};

struct CollisionSpec {
  std::string name;
  SE3 T_link_shape;
  Shape shape;
  Surface surface;
  /// `<laser_retro>`: how strongly a lidar sees it
  std::optional<double> laser_retro = std::nullopt;
};

/// What a surface looks like. Colours: red, green, blue, alpha in [0, 1].
struct Material {
  Eigen::Vector4d ambient{0.7, 0.7, 0.7, 1.0}, diffuse{0.7, 0.7, 0.7, 1.0};
  Eigen::Vector4d specular{0.0, 0.0, 0.0, 1.0}, emissive{0.0, 0.0, 0.0, 1.0};
  std::string script;        ///< name of an OGRE material, "Gazebo/Grey" say; its colours are above
  std::string texture_file;  ///< resolved path of a picture; "": none
  bool is_given = false;     ///< false: a mesh's own materials count
};

struct VisualSpec {
  std::string name;
  SE3 T_link_shape;
  Shape shape;
  Material material;
  double transparency = 0.0;  ///< 1: invisible
  bool casts_shadows = true;
  std::uint32_t visibility_flags = 0xffffffff;
  std::optional<double> laser_retro;  ///< how strongly a lidar sees it; else by its colour
};

struct PluginSpec {
  std::string name, filename;
  ParamNode params;
};

/// A `<sensor>` of a link. What it does is up to its plugins, as in gazebo_ros.
struct SensorSpec {
  std::string name, type;  ///< type as in the file: "ray", "gpu_ray", "camera", ...
  SE3 T_link_sensor;
  double update_rate_hz = 0.0;  ///< 0: every step
  bool always_on = false, visualize = false;
  ParamNode params;  ///< the whole element but its plugins; empty once they are made
  std::vector<PluginSpec> plugins;
};

struct Inertial {
  double mass_kg = 1.0;
  SE3 T_link_com;  ///< origin at the centre of mass, axes of `inertia`
  Eigen::Matrix3d inertia_com = Eigen::Matrix3d::Identity();  ///< [kg m^2] about the centre of mass
};

struct LinkSpec {
  std::string name;
  SE3 T_model_link;
  Inertial inertial;
  bool gravity = true;
  bool kinematic = false;
  double linear_damping = 0.0, angular_damping = 0.0;
  std::vector<CollisionSpec> collisions;
  std::vector<VisualSpec> visuals;
  std::vector<SensorSpec> sensors;
};

enum class JointType { kFixed, kRevolute, kPrismatic, kBall, kUniversal, kScrew, kGearbox };

/// What one axis of a joint allows and resists.
struct AxisSpec {
  Eigen::Vector3d axis_model = Eigen::Vector3d::UnitZ();
  double lower = -std::numeric_limits<double>::infinity();  ///< [rad] or [m]
  double upper = std::numeric_limits<double>::infinity();
  double effort = std::numeric_limits<double>::infinity();    ///< [N m] or [N]
  double velocity = std::numeric_limits<double>::infinity();  ///< [rad/s] or [m/s]
  double damping = 0.0;                                       ///< [N m s/rad] or [N s/m]
  double friction = 0.0;                     ///< at most, against any motion [N m] or [N]
  double spring_stiffness = 0.0;             ///< [N m/rad] or [N/m]
  double spring_reference = 0.0;             ///< where the spring is at rest [rad] or [m]
  std::optional<double> stop_erp, stop_cfm;  ///< of the limits; else the world's
};

/// A joint, and its first axis. A screw's axis is its angle.
struct JointSpec : AxisSpec {
  std::string name;
  JointType type = JointType::kFixed;
  std::string parent, child;
  SE3 T_model_joint;
  AxisSpec axis2;              ///< of universal and gearbox joints
  double screw_pitch_m = 0.0;  ///< travel per turn; positive: a right-handed thread
  /// Of the angles against the reference body: child's about axis2 = -ratio times parent's about
  /// the first axis.
  double gearbox_ratio = 1.0;
  std::string gearbox_reference_body;

  /// A joint that cannot move: fixed, or with one axis whose limits leave no play.
  bool rigid() const {
    const bool has_one_axis =
        type == JointType::kRevolute || type == JointType::kPrismatic || type == JointType::kScrew;
    return type == JointType::kFixed || (has_one_axis && (upper - lower) <= 1e-9);
  }
};

/// What a load does with an element that it cannot use.
enum class OddElements {
  kRefuse,   ///< the load fails
  kLeaveOut  ///< the rest is loaded; what was left out or changed is reported
};

struct ModelSpec {
  std::string name;
  SE3 T_world_model;
  bool is_static = false;
  bool self_collide = false;
  std::vector<LinkSpec> links;
  std::vector<JointSpec> joints;
  std::vector<PluginSpec> plugins;
  std::vector<std::string> odd_elements{};  ///< that were left out or changed, a sentence each
  std::vector<std::string> odd_repeats{};   ///< more of the same: counted, not reported
};

/// `<physics>` and `<gravity>` with Gazebo's defaults.
struct PhysicsSpec {
  double max_step_size_s = 0.001;
  double real_time_factor = 1.0;
  double real_time_update_rate_hz = 1000.0;
  Eigen::Vector3d gravity{0.0, 0.0, -9.8};
  std::string solver = "quick";  ///< or "world": ODE's exact (Dantzig) solver for everything
  /// With "quick", islands of bodies with up to so many constraint rows are solved exactly: it is
  /// then both faster and better. 0: never (`<trident:exact_solver_rows>` of `<physics>`).
  int exact_solver_rows = 150;
  int iterations = 50;
  int precon_iterations = 0;  ///< kept for queries; ODE has no preconditioning
  double sor = 1.3;
  double cfm = 0.0, erp = 0.2;
  double contact_max_correcting_vel = 100.0;
  double contact_surface_layer = 0.001;
  int max_contacts = 20;
};

struct SphericalCoordinates {
  double latitude_deg = 0.0, longitude_deg = 0.0, elevation_m = 0.0, heading_deg = 0.0;
};

enum class LightType { kDirectional, kPoint, kSpot };

struct LightSpec {
  std::string name;
  LightType type = LightType::kPoint;
  SE3 T_world_light;
  Eigen::Vector3d direction_light{0.0, 0.0, -1.0};  ///< in the light's frame, of unit length
  Eigen::Vector4d diffuse{1.0, 1.0, 1.0, 1.0}, specular{0.1, 0.1, 0.1, 1.0};
  bool casts_shadows = false;
  double range_m = 10.0;  ///< nothing is lit beyond; neither this nor what follows: directional
  double attenuation_constant = 1.0, attenuation_linear = 0.0, attenuation_quadratic = 0.0;
  double spot_inner_rad = 0.0, spot_outer_rad = 0.0, spot_falloff = 0.0;
};

/// What the world looks like where nothing else says so, with Gazebo's defaults.
struct SceneSpec {
  Eigen::Vector4d ambient{0.4, 0.4, 0.4, 1.0}, background{0.7, 0.7, 0.7, 1.0};
  bool shadows = true;
};

struct WorldSpec {
  std::string name = "default";
  PhysicsSpec physics;
  SphericalCoordinates spherical;
  std::vector<ModelSpec> models;
  std::vector<LightSpec> lights;
  SceneSpec scene;
  std::vector<PluginSpec> plugins;
  std::vector<std::string> odd_elements{};  ///< that were left out or changed, a sentence each
  std::vector<std::string> odd_repeats{};   ///< more of the same: counted, not reported
};

}  // namespace trident::sim
