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

/// A box about its origin, edges along the axes.
struct BoxShape {
  Eigen::Vector3d size;  ///< full edge lengths [m]
};
/// A sphere about its origin.
struct SphereShape {
  double radius;  ///< [m]
};
/// A cylinder about its origin, with flat ends.
struct CylinderShape {
  double radius, length;  ///< [m], axis along z
};
/// A cylinder about its origin with half a sphere on each end.
struct CapsuleShape {
  double radius, length;  ///< [m], axis along z, length without the caps
};
/// An infinite plane through its origin. As a collision it is solid on the side away from `normal`.
struct PlaneShape {
  Eigen::Vector3d normal;  ///< in the shape's frame
};
/// Triangles from a file (COLLADA, STL, OBJ).
struct MeshShape {
  std::string file;       ///< resolved path
  Eigen::Vector3d scale;  ///< per axis of the file, before T_link_shape
};
/// Terrain from a picture of heights, about its origin in x and y.
struct HeightmapShape {
  std::string file;      ///< resolved path of a PNG or PGM picture, of any size
  Eigen::Vector3d size;  ///< extents [m]; black is at z 0, the brightest pixel at size.z
};
using Shape = std::variant<BoxShape, SphereShape, CylinderShape, CapsuleShape, PlaneShape,
                           MeshShape, HeightmapShape>;

/// Contact parameters of one collision, with Gazebo's defaults.
struct Surface {
  /// Of Coulomb friction, along fdir1 and across; a pair has the smaller.
  double mu = 1.0, mu2 = 1.0;
  Eigen::Vector3d fdir1 = Eigen::Vector3d::Zero();  ///< collision frame; zero: any direction
  /// Force-dependent slip along both [m/s/N]; a pair has the smaller.
  double slip1 = 0.0, slip2 = 0.0;
  double restitution = 0.0;  ///< speed after a bounce by the one before; a pair has the smaller
  double bounce_threshold_m_s = 1e5;  ///< slower contacts do not bounce
  /// Of a contact; a pair's are in series, its dampers add up.
  double kp_n_m = 1e12, kd_ns_m = 1.0;
  double min_depth_m = 0.0;  ///< to which nothing is pushed out
  /// Of the speed at which what is deeper is pushed out, what may remain after the step, >= 0
  double max_vel_m_s = 0.01;
  std::uint32_t collide_bitmask = 0xffff;  ///< two touch when their masks share a bit
};

/// A `<collision>` of a link.
struct CollisionSpec {
  std::string name;  ///< unique within its link
  SE3 T_link_shape;  ///< pose of the shape's own frame
  Shape shape;       ///< about its own frame; what touches
  Surface surface;   ///< how contacts of it behave
  /// `<laser_retro>`: how strongly a lidar sees it
  std::optional<double> laser_retro = std::nullopt;
};

/// What a surface looks like. Colours: red, green, blue, alpha in [0, 1].
struct Material {
  /// Reflected of ambient and of directed light.
  Eigen::Vector4d ambient{0.7, 0.7, 0.7, 1.0}, diffuse{0.7, 0.7, 0.7, 1.0};
  /// Of highlights; light of its own, whatever shines on it.
  Eigen::Vector4d specular{0.0, 0.0, 0.0, 1.0}, emissive{0.0, 0.0, 0.0, 1.0};
  std::string script;        ///< name of an OGRE material, "Gazebo/Grey" say; its colours are above
  std::string texture_file;  ///< resolved path of a picture; "": none
  bool is_given = false;     ///< false: a mesh's own materials count
};

/// A `<visual>` of a link: what cameras and gpu_ray lidars see of it.
struct VisualSpec {
  std::string name;                             ///< unique within its link
  SE3 T_link_shape;                             ///< pose of the shape's own frame
  Shape shape;                                  ///< about its own frame; what is seen
  Material material;                            ///< of the whole shape
  double transparency = 0.0;                    ///< 1: invisible
  bool casts_shadows = true;                    ///< `<cast_shadows>`
  std::uint32_t visibility_flags = 0xffffffff;  ///< a camera sees it when its mask shares a bit
  std::optional<double> laser_retro;  ///< how strongly a lidar sees it; else by its colour
};

/// A `<plugin>` of a world, model or sensor, before it is made.
struct PluginSpec {
  std::string name, filename;  ///< as in the file; PluginRegistry knows filename's forms
  ParamNode params;            ///< the whole element
};

/// A `<sensor>` of a link. What it does is up to its plugins, as in gazebo_ros.
struct SensorSpec {
  std::string name, type;       ///< type as in the file: "ray", "gpu_ray", "camera", ...
  SE3 T_link_sensor;            ///< its x axis looks ahead
  double update_rate_hz = 0.0;  ///< 0: every step
  bool always_on = false, visualize = false;  ///< as in the file; neither changes what is simulated
  ParamNode params;                 ///< the whole element but its plugins; empty once they are made
  std::vector<PluginSpec> plugins;  ///< in file order; moved out when they are made
};

/// Mass and its distribution in one link.
struct Inertial {
  double mass_kg = 1.0;  ///< > 0
  SE3 T_link_com;        ///< origin at the centre of mass, axes of `inertia`
  Eigen::Matrix3d inertia_com = Eigen::Matrix3d::Identity();  ///< [kg m^2] about the centre of mass
};

/// A `<link>` of a model.
struct LinkSpec {
  std::string name;        ///< unique within its model
  SE3 T_model_link;        ///< at zero of all joints
  Inertial inertial;       ///< of the link alone
  bool gravity = true;     ///< `<gravity>`
  bool kinematic = false;  ///< moves with its velocity, whatever force acts on it
  /// Of the velocities [1/s]; of a body its first link's.
  double linear_damping = 0.0, angular_damping = 0.0;
  std::vector<CollisionSpec> collisions;  ///< in file order
  std::vector<VisualSpec> visuals;        ///< in file order
  std::vector<SensorSpec> sensors;        ///< in file order
};

/// What a joint lets its child do: nothing, turn about an axis, shift along it, turn about a point,
/// turn about two perpendicular axes, turn and shift in proportion, or turn in proportion to its
/// parent.
enum class JointType { kFixed, kRevolute, kPrismatic, kBall, kUniversal, kScrew, kGearbox };

/// What one axis of a joint allows and resists.
struct AxisSpec {
  Eigen::Vector3d axis_model = Eigen::Vector3d::UnitZ();    ///< of unit length, in the model's axes
  double lower = -std::numeric_limits<double>::infinity();  ///< [rad] or [m]
  /// Not below `lower`; infinite: no limit.
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
  std::string name;                    ///< unique within its model
  JointType type = JointType::kFixed;  ///< which axes count follows from it
  std::string parent, child;           ///< names of links; parent "world": the world
  SE3 T_model_joint;                   ///< its origin is the anchor
  AxisSpec axis2;                      ///< of universal and gearbox joints
  double screw_pitch_m = 0.0;          ///< travel per turn; positive: a right-handed thread
  /// Of the angles against the reference body: child's about axis2 = -ratio times parent's about
  /// the first axis.
  double gearbox_ratio = 1.0;
  std::string gearbox_reference_body;  ///< name of a link, or "world"

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

/// A `<model>` or a URDF `<robot>`, with nested models already merged into it.
struct ModelSpec {
  std::string name;                 ///< unique in a world; never empty
  SE3 T_world_model;                ///< as spawned
  bool is_static = false;           ///< none of its links ever moves
  bool self_collide = false;        ///< links without a joint between them can touch each other
  std::vector<LinkSpec> links;      ///< the first carries the model frame
  std::vector<JointSpec> joints;    ///< in file order
  std::vector<PluginSpec> plugins;  ///< of the model itself; those of sensors are with their links
  std::vector<std::string> odd_elements{};  ///< that were left out or changed, a sentence each
  std::vector<std::string> odd_repeats{};   ///< more of the same: counted, not reported
};

/// `<physics>` and `<gravity>` with Gazebo's defaults.
struct PhysicsSpec {
  double max_step_size_s = 0.001;  ///< the length of every step
  double real_time_factor = 1.0;   ///< as in the file; the step size and the rate below pace a run
  /// Wanted steps per wall second; 0: as fast as possible.
  double real_time_update_rate_hz = 1000.0;
  Eigen::Vector3d gravity{0.0, 0.0, -9.8};  ///< world frame [m/s^2]
  std::string solver = "quick";  ///< or "world": ODE's exact (Dantzig) solver for everything
  /// With "quick", islands of bodies with up to so many constraint rows are solved exactly: it is
  /// then both faster and better. 0: never (`<trident:exact_solver_rows>` of `<physics>`).
  int exact_solver_rows = 150;
  int iterations = 50;        ///< of "quick" per step
  int precon_iterations = 0;  ///< kept for queries; ODE has no preconditioning
  double sor = 1.3;           ///< successive over-relaxation of "quick", in (0, 2)
  /// ODE's constraint force mixing, and part of an error put right per step.
  double cfm = 0.0, erp = 0.2;
  double contact_max_correcting_vel = 100.0;  ///< at most pushed apart at this [m/s]
  double contact_surface_layer = 0.001;  ///< kept for queries; the engine has no such layer [m]
  int max_contacts = 20;                 ///< per pair of collisions
};

/// Where the world's origin lies on the WGS84 ellipsoid.
struct SphericalCoordinates {
  /// Heading: by how much the world's x axis is turned from east, counter-clockwise.
  double latitude_deg = 0.0, longitude_deg = 0.0, elevation_m = 0.0, heading_deg = 0.0;
};

/// Parallel light as of the sun, light from a point in all directions, or in a cone.
enum class LightType { kDirectional, kPoint, kSpot };

/// A `<light>` of the world.
struct LightSpec {
  std::string name;                    ///< of the file; "" is legal
  LightType type = LightType::kPoint;  ///< decides which of the fields below count
  SE3 T_world_light;                   ///< of a directional light only the rotation counts
  Eigen::Vector3d direction_light{0.0, 0.0, -1.0};  ///< in the light's frame, of unit length
  /// Red, green, blue, alpha in [0, 1]
  Eigen::Vector4d diffuse{1.0, 1.0, 1.0, 1.0}, specular{0.1, 0.1, 0.1, 1.0};
  bool casts_shadows = false;  ///< costs a ray for each lit pixel
  double range_m = 10.0;  ///< nothing is lit beyond; neither this nor what follows: directional
  /// Strength 1 / (c + l d + q d^2) at distance d [m]
  double attenuation_constant = 1.0, attenuation_linear = 0.0, attenuation_quadratic = 0.0;
  /// Full angles; between them it fades with this power.
  double spot_inner_rad = 0.0, spot_outer_rad = 0.0, spot_falloff = 0.0;
};

/// What the world looks like where nothing else says so, with Gazebo's defaults.
struct SceneSpec {
  /// Red, green, blue, alpha in [0, 1]
  Eigen::Vector4d ambient{0.4, 0.4, 0.4, 1.0}, background{0.7, 0.7, 0.7, 1.0};
  bool shadows = true;  ///< false: no light casts shadows
};

/// A world file after it was read and checked.
struct WorldSpec {
  std::string name = "default";             ///< of the `<world>` element
  PhysicsSpec physics;                      ///< checked by World, not by the reader
  SphericalCoordinates spherical;           ///< all zero where the file has none
  std::vector<ModelSpec> models;            ///< in file order, includes resolved
  std::vector<LightSpec> lights;            ///< of the world itself, in file order
  SceneSpec scene;                          ///< what cameras see where nothing is
  std::vector<PluginSpec> plugins;          ///< of the world itself, in file order
  std::vector<std::string> odd_elements{};  ///< that were left out or changed, a sentence each
  std::vector<std::string> odd_repeats{};   ///< more of the same: counted, not reported
};

}  // namespace trident::sim
