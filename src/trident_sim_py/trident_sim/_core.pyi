# SPDX-FileCopyrightText: 2026 The Trident authors
# SPDX-License-Identifier: Apache-2.0
"""Types of the compiled part of trident_sim; docstrings as in the module, for editors."""

import typing
from collections.abc import Sequence

import numpy as np
import numpy.typing as npt

_Array = npt.NDArray[np.float64]
_Floats = npt.NDArray[np.float32]
_Bytes = npt.NDArray[np.uint8]
_Pixels = npt.NDArray[np.uint8] | npt.NDArray[np.uint16] | _Floats
_Vector = Sequence[float] | _Array
_Matrix = Sequence[Sequence[float]] | _Array

class Error(ValueError):
    """Bad input: a file, a field, a name or a value. The text names it and what is legal."""

class _Stamped:
    @property
    def stamp(self) -> float:
        """Simulated time of the sample [s]."""
    @property
    def stamp_ns(self) -> int:
        """Simulated time of the sample, exact [ns]."""

class ActuatorCommand(_Stamped):
    """Commanded rotor speeds."""
    def __init__(self, angular_velocities: _Vector, stamp: float = 0.0) -> None:
        """angular_velocities: rotor speeds [rad/s], shape (n,).
        stamp: that of the odometry it answers [s]; 0: it acts in the next step.
        """
    @property
    def angular_velocities(self) -> _Array:
        """Rotor speeds [rad/s], shape (n,)."""

class ActuatorState(_Stamped):
    """Rotor speeds."""
    @property
    def angular_velocities(self) -> _Array:
        """Rotor speeds, signed [rad/s], shape (n,)."""

class OdometrySample(_Stamped):
    """Pose of child_frame in parent_frame, twist in child_frame, as nav_msgs/Odometry has them."""
    @property
    def parent_frame(self) -> str:
        """Frame of the pose."""
    @property
    def child_frame(self) -> str:
        """Frame of the twist."""
    @property
    def position(self) -> _Array:
        """Position [m], shape (3,)."""
    @property
    def orientation(self) -> _Array:
        """Unit quaternion x y z w, shape (4,)."""
    @property
    def linear_velocity(self) -> _Array:
        """In child_frame [m/s], shape (3,)."""
    @property
    def angular_velocity(self) -> _Array:
        """In child_frame [rad/s], shape (3,)."""
    @property
    def pose_covariance(self) -> _Array:
        """x y z, rotation x y z [m, rad], shape (6, 6)."""
    @property
    def twist_covariance(self) -> _Array:
        """Linear x y z, angular x y z [m/s, rad/s], shape (6, 6)."""

class PathCommand(_Stamped):
    """Waypoints to follow, in the world frame."""
    def __init__(self, positions: _Array | Sequence[_Vector], stamp: float = 0.0) -> None:
        """positions: [m], shape (n, 3).
        stamp: simulated time of the start [s]; 0: at once."""
    def __len__(self) -> int: ...

class PoseSample(_Stamped):
    """Pose of a body in frame."""
    def __init__(self, position: _Vector, yaw: float = 0.0, stamp: float = 0.0) -> None:
        """position: [m], shape (3,).
        yaw: [rad].
        stamp: simulated time of the start [s]; 0: at once."""
    @property
    def frame(self) -> str:
        """Frame that the values are in."""
    @property
    def position(self) -> _Array:
        """Position [m], shape (3,)."""
    @property
    def orientation(self) -> _Array:
        """Unit quaternion x y z w, shape (4,)."""

class PoseWithCovarianceSample(_Stamped):
    """Pose of a body in frame, with covariance."""
    @property
    def frame(self) -> str:
        """Frame that the values are in."""
    @property
    def position(self) -> _Array:
        """Position [m], shape (3,)."""
    @property
    def orientation(self) -> _Array:
        """Unit quaternion x y z w, shape (4,)."""
    @property
    def covariance(self) -> _Array:
        """x y z, rotation x y z [m, rad], shape (6, 6)."""

class PointSample(_Stamped):
    """Position of a body in frame."""
    @property
    def frame(self) -> str:
        """Frame that the values are in."""
    @property
    def position(self) -> _Array:
        """Of the body in frame [m], shape (3,)."""

class TransformSample(_Stamped):
    """Pose of child_frame in parent_frame."""
    @property
    def parent_frame(self) -> str:
        """Frame that the values are in."""
    @property
    def child_frame(self) -> str:
        """Frame whose pose it is."""
    @property
    def position(self) -> _Array:
        """Origin of child_frame in parent_frame [m], shape (3,)."""
    @property
    def orientation(self) -> _Array:
        """Of child_frame in parent_frame, quaternion x y z w, shape (4,)."""

class FrameSample(_Stamped):
    """Pose of child_frame in parent_frame, for the tree of frames."""
    @property
    def parent_frame(self) -> str:
        """Frame that the values are in."""
    @property
    def child_frame(self) -> str:
        """Frame whose pose it is."""
    @property
    def position(self) -> _Array:
        """Origin of child_frame in parent_frame [m], shape (3,)."""
    @property
    def orientation(self) -> _Array:
        """Of child_frame in parent_frame, quaternion x y z w, shape (4,)."""

class ImuSample(_Stamped):
    """What an inertial measurement unit measures."""
    @property
    def frame(self) -> str:
        """Frame of the IMU."""
    @property
    def orientation(self) -> _Array:
        """Of the IMU in the world, quaternion x y z w, shape (4,)."""
    @property
    def angular_velocity(self) -> _Array:
        """In frame [rad/s], shape (3,)."""
    @property
    def linear_acceleration(self) -> _Array:
        """Specific force in frame [m/s^2], shape (3,)."""
    @property
    def orientation_covariance(self) -> _Array:
        """Rotation x y z [rad], shape (3, 3)."""
    @property
    def angular_velocity_covariance(self) -> _Array:
        """x y z in frame [rad/s], shape (3, 3)."""
    @property
    def linear_acceleration_covariance(self) -> _Array:
        """x y z in frame [m/s^2], shape (3, 3)."""

class LaserScanSample(_Stamped):
    """One sweep of a planar lidar; stamp: its first beam."""
    @property
    def frame(self) -> str:
        """Frame of the lidar; beams turn about its z."""
    @property
    def angle_min(self) -> float:
        """Of the first beam [rad]."""
    @property
    def angle_max(self) -> float:
        """Of the last beam [rad]."""
    @property
    def angle_increment(self) -> float:
        """From beam to beam [rad]."""
    @property
    def time_increment(self) -> float:
        """From beam to beam [s]."""
    @property
    def scan_time(self) -> float:
        """From scan to scan [s]; 0: not known."""
    @property
    def range_min(self) -> float:
        """Smallest range [m]."""
    @property
    def range_max(self) -> float:
        """Largest range [m]."""
    @property
    def ranges(self) -> _Floats:
        """[m], shape (n,), float32; inf: nothing in range, -inf: too near."""
    @property
    def intensities(self) -> _Floats:
        """Shape (n,), float32."""

class ImageSample(_Stamped):
    """A picture; stamp: when it was taken."""
    @property
    def frame(self) -> str:
        """Optical frame: x right, y down, z ahead."""
    @property
    def encoding(self) -> str:
        """rgb8, bgr8, mono8, mono16, 16UC1 or 32FC1, as ROS names them."""
    @property
    def pixels(self) -> _Pixels:
        """Shape (height, width, 3), uint8, of colors; else (height, width): m, mm or labels."""

class ImageCloudSample(_Stamped):
    """Points of a picture, pixel by pixel."""
    @property
    def frame(self) -> str:
        """Optical frame: x right, y down, z ahead."""
    @property
    def points(self) -> _Floats:
        """[m], shape (height, width, 3), float32; nan: nothing is seen there."""
    @property
    def colors(self) -> _Bytes:
        """Red, green, blue, shape (height, width, 3), uint8."""

class CameraInfoSample(_Stamped):
    """A pinhole camera, as sensor_msgs/CameraInfo has it."""
    @property
    def frame(self) -> str:
        """Optical frame: x right, y down, z ahead."""
    @property
    def width(self) -> int:
        """[pixels]."""
    @property
    def height(self) -> int:
        """[pixels]."""
    @property
    def d(self) -> _Array:
        """Distortion (plumb_bob): k1 k2 t1 t2 k3, shape (5,)."""
    @property
    def k(self) -> _Array:
        """Focal lengths and middle of the raw picture [pixels], shape (3, 3)."""
    @property
    def r(self) -> _Array:
        """Rotation that rectifies, shape (3, 3)."""
    @property
    def p(self) -> _Array:
        """Projection of the rectified picture [pixels], shape (3, 4)."""

class BoundingBox:
    """What a camera sees of one model or link."""
    @property
    def label(self) -> int:
        """Of its pixels in the segmentation picture."""
    @property
    def name(self) -> str:
        """Model, or model::link."""
    @property
    def x_min(self) -> int:
        """Leftmost pixel."""
    @property
    def y_min(self) -> int:
        """Topmost pixel."""
    @property
    def x_max(self) -> int:
        """Rightmost pixel."""
    @property
    def y_max(self) -> int:
        """Lowest pixel."""
    @property
    def pixels(self) -> int:
        """How many show it."""

class BoundingBoxesSample(_Stamped):
    """What a camera sees, by label."""
    @property
    def frame(self) -> str:
        """Optical frame of the camera."""
    @property
    def boxes(self) -> list[BoundingBox]:
        """One per model or link that is seen."""

class LidarCloudSample(_Stamped):
    """One scan of a lidar with many rings; stamp: its first beam."""
    @property
    def frame(self) -> str:
        """Frame of the lidar."""
    @property
    def points(self) -> npt.NDArray[np.void]:
        """Shape (n,), structured: x y z [m] in frame, intensity, ring, time since stamp [s]."""

class PointListSample(_Stamped):
    """A point per beam of a lidar."""
    @property
    def frame(self) -> str:
        """Frame of the points."""
    @property
    def points(self) -> _Floats:
        """In frame [m], shape (n, 3), float32."""
    @property
    def intensities(self) -> _Floats:
        """Shape (n,), float32."""

class RangeSample(_Stamped):
    """The nearest thing in a cone about x."""
    @property
    def frame(self) -> str:
        """Frame of the sensor."""
    @property
    def is_infrared(self) -> bool:
        """Else ultrasound."""
    @property
    def field_of_view(self) -> float:
        """Of the cone [rad]."""
    @property
    def range_min(self) -> float:
        """Smallest range [m]."""
    @property
    def range_max(self) -> float:
        """Largest range [m]."""
    @property
    def range(self) -> float:
        """[m]; the largest range: nothing hit."""

class TouchSample:
    """Contacts of two collisions."""
    @property
    def collision1(self) -> str:
        """model::link::collision."""
    @property
    def collision2(self) -> str:
        """model::link::collision."""
    @property
    def positions(self) -> _Array:
        """In the world [m], shape (n, 3)."""
    @property
    def normals(self) -> _Array:
        """In the world, into collision 1, shape (n, 3)."""
    @property
    def forces(self) -> _Array:
        """On collision 1, in the world [N], shape (n, 3)."""
    @property
    def torques(self) -> _Array:
        """On collision 1, about its body's centre of mass [N m], shape (n, 3)."""
    @property
    def depths(self) -> _Array:
        """[m], shape (n,)."""

class ContactsSample(_Stamped):
    """What the collisions of a bumper touch."""
    @property
    def frame(self) -> str:
        """Frame that a message is said to be in."""
    @property
    def touches(self) -> list[TouchSample]:
        """One for each pair of collisions."""

class FluidPressureSample(_Stamped):
    """What a barometer measures."""
    @property
    def frame(self) -> str:
        """Frame of the barometer."""
    @property
    def pressure(self) -> float:
        """Static pressure [Pa]."""
    @property
    def variance(self) -> float:
        """[Pa^2]."""

class MagneticFieldSample(_Stamped):
    """What a magnetometer measures."""
    @property
    def frame(self) -> str:
        """Frame that the field is in."""
    @property
    def field(self) -> _Array:
        """In frame [T], shape (3,)."""
    @property
    def covariance(self) -> _Array:
        """x y z in frame [T^2], shape (3, 3)."""

class GnssFixSample(_Stamped):
    """A satellite receiver's position fix, WGS84."""
    @property
    def frame(self) -> str:
        """Frame of the antenna."""
    @property
    def latitude(self) -> float:
        """[deg], north positive."""
    @property
    def longitude(self) -> float:
        """[deg], east positive."""
    @property
    def altitude(self) -> float:
        """Above the ellipsoid [m]."""
    @property
    def covariance(self) -> _Array:
        """East, north, up [m^2], shape (3, 3)."""

class GnssStatusSample(_Stamped):
    """How good a satellite receiver's fix is."""
    @property
    def frame(self) -> str:
        """Frame of the antenna."""
    @property
    def fix_type(self) -> int:
        """0: none, 1: single, 2: float, 3: fixed."""
    @property
    def horizontal_stddev(self) -> float:
        """Per axis, one sigma [m]."""
    @property
    def vertical_stddev(self) -> float:
        """One sigma [m]."""
    @property
    def satellites(self) -> int:
        """In view."""
    @property
    def geoid_separation(self) -> float:
        """Height of the geoid above the ellipsoid [m]; NaN: not known."""

class TwistSample(_Stamped):
    """Linear and angular velocity."""
    @property
    def frame(self) -> str:
        """Frame of what moves."""
    @property
    def linear(self) -> _Array:
        """[m/s], shape (3,)."""
    @property
    def angular(self) -> _Array:
        """[rad/s], shape (3,)."""

class JointStateSample(_Stamped):
    """Joint angles and rates."""
    @property
    def frame(self) -> str:
        """Of the header; joint angles have none."""
    @property
    def names(self) -> list[str]:
        """Joint names, n of them."""
    @property
    def positions(self) -> _Array:
        """Angles [rad] or lengths [m], shape (n,)."""
    @property
    def velocities(self) -> _Array:
        """Rates [rad/s] or [m/s], shape (n,); shape (0,) where they are not known."""

class ScalarSample(_Stamped):
    """One number."""
    def __init__(self, value: float, stamp: float = 0.0) -> None:
        """value: SI unit of the quantity.
        stamp: [s]."""
    @property
    def value(self) -> float:
        """SI unit of the quantity."""

class StampedNumber(_Stamped):
    """One number of uuv_simulator."""
    def __init__(self, value: float, stamp: float = 0.0) -> None:
        """value: SI unit of the quantity.
        stamp: [s]."""
    @property
    def value(self) -> float:
        """SI unit of the quantity."""

class DriveCommand(_Stamped):
    """Thrusts of a boat with two propellers."""
    def __init__(self, left: float, right: float, stamp: float = 0.0) -> None:
        """left, right: parts of full thrust, -1 to 1.
        stamp: [s]."""
    @property
    def left(self) -> float:
        """Part of full thrust, -1 to 1."""
    @property
    def right(self) -> float:
        """Part of full thrust, -1 to 1."""

class JointCommand(_Stamped):
    """Commands of joints or thrusters by name."""
    def __init__(
        self,
        names: Sequence[str],
        positions: Sequence[float] = (),
        velocities: Sequence[float] = (),
        efforts: Sequence[float] = (),
        stamp: float = 0.0,
    ) -> None:
        """names: n of them.
        positions, velocities, efforts: [rad, m], [rad/s, m/s], [N m, N], shape (n,), or none.
        stamp: [s]."""
    @property
    def names(self) -> list[str]:
        """Of joints or thrusters, n of them."""

class ServiceCommand(_Stamped):
    """A request without arguments, as a service of ROS takes it."""
    def __init__(self, stamp: float = 0.0) -> None:
        """stamp: [s], not looked at: it acts in the next step."""

class TriggerCommand(_Stamped):
    """A request without arguments, as a topic of ROS takes it."""
    def __init__(self, stamp: float = 0.0) -> None:
        """stamp: [s], not looked at: it acts in the next step."""

class TextCommand(_Stamped):
    """What is to be different from the next step on."""
    def __init__(self, text: str, stamp: float = 0.0) -> None:
        """text: the keys to change, as YAML.
        stamp: [s], not looked at: it acts in the next step."""
    @property
    def text(self) -> str:
        """The keys to change, as YAML."""

class EnvironmentSample(_Stamped):
    """A world's sea, wind and ground."""
    @property
    def yaml(self) -> str:
        """As the file of an environment says it."""

class NumberSample(_Stamped):
    """A number, as std_msgs/Float64 has it."""
    @property
    def value(self) -> float:
        """In the unit of the quantity."""

class BatterySample(_Stamped):
    """State of a battery."""
    @property
    def voltage(self) -> float:
        """At its terminals, under load [V]."""
    @property
    def current(self) -> float:
        """Drawn from it [A]."""
    @property
    def charge(self) -> float:
        """That is left [Ah]."""
    @property
    def capacity(self) -> float:
        """When full [Ah]."""
    @property
    def percentage(self) -> float:
        """Charge over capacity, 0 to 1."""

class WindReadingSample(_Stamped):
    """Speed and angle of the wind."""
    @property
    def frame(self) -> str:
        """Frame of the sensor."""
    @property
    def is_true(self) -> bool:
        """Over ground; else as the sensor feels it while it moves."""
    @property
    def speed(self) -> float:
        """[m/s]."""
    @property
    def angle(self) -> float:
        """Where it comes from, from the frame's x clockwise, in [0, 2 pi) [rad]."""

class TwistCommand(_Stamped):
    """Wanted velocity of a vehicle in its own frame."""
    def __init__(
        self, linear_velocity: _Vector, angular_velocity: _Vector, stamp: float = 0.0
    ) -> None:
        """linear_velocity: [m/s], shape (3,).
        angular_velocity: [rad/s], shape (3,).
        stamp: [s], not looked at: it acts from the next step on."""
    @property
    def linear_velocity(self) -> _Array:
        """In the vehicle's frame [m/s], shape (3,)."""
    @property
    def angular_velocity(self) -> _Array:
        """In the vehicle's frame [rad/s], shape (3,)."""

class VectorSample(_Stamped):
    """A vector in frame."""
    @property
    def frame(self) -> str:
        """Frame that the vector is in."""
    @property
    def value(self) -> _Array:
        """SI unit of the quantity, shape (3,)."""

class WindSample(_Stamped):
    """Wind at a vehicle."""
    def __init__(self, velocity: _Vector, stamp: float = 0.0, frame: str = "world") -> None:
        """velocity: in the world frame [m/s], shape (3,)."""
    @property
    def frame(self) -> str:
        """Of the header; the velocity is in the world frame."""
    @property
    def velocity(self) -> _Array:
        """In the world frame [m/s], shape (3,)."""

class WrenchSample(_Stamped):
    """Force and torque in frame."""
    @property
    def frame(self) -> str:
        """Frame that the values are in."""
    @property
    def force(self) -> _Array:
        """In frame [N], shape (3,)."""
    @property
    def torque(self) -> _Array:
        """In frame [N m], shape (3,)."""

class TrajectorySample(_Stamped):
    """Set-points of a position controller, in the world frame."""
    def __init__(
        self,
        positions: _Matrix,
        times: _Vector | None = None,
        velocities: _Matrix | None = None,
        accelerations: _Matrix | None = None,
        yaw: float | _Vector | None = None,
        yaw_rate: float | _Vector | None = None,
        stamp: float = 0.0,
    ) -> None:
        """positions: [m], shape (n, 3).
        times: of each point after the stamp [s], shape (n,); may be left out for one point.
        velocities, accelerations: [m/s], [m/s^2], shape (n, 3), else 0.
        yaw, yaw_rate: [rad], [rad/s], a number or shape (n,), else 0.
        stamp: simulated time of the start [s]; 0: with the next state.
        """
    def __len__(self) -> int: ...

class Link:
    """A link of a model, by name."""
    @property
    def name(self) -> str:
        """Of the link in its model."""
    @property
    def position(self) -> _Array:
        """Origin of the link in the world [m], shape (3,)."""
    @property
    def orientation(self) -> _Array:
        """Of the link in the world, quaternion x y z w, shape (4,)."""
    @property
    def linear_velocity(self) -> _Array:
        """Of the link's origin, in the world frame [m/s], shape (3,)."""
    @property
    def angular_velocity(self) -> _Array:
        """In the world frame [rad/s], shape (3,)."""
    @property
    def mass(self) -> float:
        """Of the link [kg]."""
    def apply_wrench(
        self,
        force: _Vector,
        torque: _Vector = (0, 0, 0),
        duration: float = -1.0,
        point: _Vector = (0, 0, 0),
    ) -> None:
        """Push from now on. force [N], torque [N m]: world frame, shape (3,). point: where the
        force acts, link frame [m], shape (3,). duration [s]; negative: until cleared.
        """
    def clear_wrenches(self) -> None:
        """End all pushes on this link."""

class Joint:
    """A joint of a model, by name."""
    @property
    def name(self) -> str:
        """Of the joint in its model."""
    @property
    def position(self) -> float:
        """Angle [rad] or displacement [m] along its axis; 0: as its description has it."""
    @property
    def velocity(self) -> float:
        """Rate of its position [rad/s] or [m/s]."""
    def apply_effort(self, effort: float, duration: float = -1.0) -> None:
        """Drive it from now on. effort [N m] or [N]; duration [s]; negative: until cleared."""
    def clear_efforts(self) -> None:
        """End all efforts on this joint."""

class Model:
    """A model of the world, by name."""
    def __init__(self, session: Session, name: str) -> None: ...
    @property
    def name(self) -> str:
        """Of the model in the world."""
    @property
    def namespace(self) -> str:
        """Prefix of its ports where the model does not say one."""
    @property
    def is_static(self) -> bool:
        """Whether it never moves."""
    @property
    def position(self) -> _Array:
        """Origin of the model in the world [m], shape (3,)."""
    @property
    def orientation(self) -> _Array:
        """Of the model in the world, quaternion x y z w, shape (4,)."""
    @property
    def linear_velocity(self) -> _Array:
        """Of the model's origin, in the world frame [m/s], shape (3,)."""
    @property
    def angular_velocity(self) -> _Array:
        """In the world frame [rad/s], shape (3,)."""
    @property
    def mass(self) -> float:
        """Of all its links [kg]."""
    def set_pose(self, pose: _Vector) -> None:
        """Put it there. pose in the world: x y z, x y z roll pitch yaw, or x y z qx qy qz qw
        [m, rad], shape (3,), (6,) or (7,).
        """
    def set_velocity(self, linear: _Vector, angular: _Vector = (0, 0, 0)) -> None:
        """Of the whole model, in the world frame [m/s], [rad/s], shape (3,)."""
    def scale_mass(self, factor: float) -> None:
        """Mass and inertia of all its links become factor, 0.01 to 100, times what they were when
        it was spawned. Snapshots from before fit."""
    @property
    def links(self) -> list[str]:
        """Names of its links."""
    @property
    def joints(self) -> list[str]:
        """Names of its joints."""
    def link(self, name: str) -> Link:
        """One of its links; Error if it has no such link."""
    def joint(self, name: str) -> Joint:
        """One of its joints; Error if it has no such joint."""

class Port:
    """A named place where the world leaves measurements (an output), takes
    commands (an input), or both. Only what is subscribed is computed.
    """
    def __init__(self, session: Session, name: str) -> None: ...
    @property
    def name(self) -> str:
        """Full name, as that of the ROS topic."""
    @property
    def is_output(self) -> bool:
        """Whether it can be read."""
    @property
    def is_input(self) -> bool:
        """Whether it can be written."""
    @property
    def type(self) -> str:
        """Name of the class of its values, those that are read first."""
    @property
    def count(self) -> int:
        """How many values there have been."""
    @property
    def subscribed(self) -> bool:
        """Whether its values are asked for."""
    def subscribe(self) -> None:
        """From the next step on, have its values computed."""
    def unsubscribe(self) -> None:
        """Have its values computed no longer."""
    # `type` says which class it is; a union would make every use a cast.
    @property
    def value(self) -> typing.Any:
        """The newest value, a copy. Subscribes; Error before the first value."""
    def read(self) -> typing.Any:
        """The newest value if this Port object has not returned it yet, else None. Subscribes."""
    def write(self, *args: typing.Any, **kwargs: typing.Any) -> None:
        """Give it a value: one of its class, or what that class is made of.
        At most 8 between two steps.
        """

class Message:
    """Something that went wrong and did not stop the world."""
    @property
    def severity(self) -> str:
        """How bad it is: 'warning' or 'error'."""
    @property
    def text(self) -> str:
        """What went wrong, and where."""
    @property
    def time(self) -> float:
        """Simulated time [s]."""

class Drive:
    """What drives an axis of a joint towards a target."""
    def __init__(
        self,
        session: Session,
        model: str,
        joint: str,
        mode: str,
        target: float,
        gains: dict[str, float],
        axis: int,
    ) -> None: ...
    @property
    def target(self) -> float:
        """Position [rad] or [m], velocity [rad/s] or [m/s], or effort [N m] or [N]."""
    @target.setter
    def target(self, target: float) -> None:
        """Position [rad] or [m], velocity [rad/s] or [m/s], or effort [N m] or [N]."""
    @property
    def effort(self) -> float:
        """Asked for in the last step [N m] or [N]."""
    def remove(self) -> None:
        """Drive the axis no longer."""

class Snapshot:
    """The state of a world between two steps."""
    @property
    def time(self) -> float:
        """Simulated time [s]."""
    @property
    def step_count(self) -> int:
        """Steps since time zero."""

class Session:
    def __init__(
        self,
        world: str,
        seed: int,
        timing: str,
        folders: list[str],
        plugins: list[str],
        sensor_threads: int,
        strict: bool,
    ) -> None: ...
    def spawn(self, name: str, xml: str, label: str, namespace: str, pose: _Vector) -> str: ...
    def remove(self, name: str) -> None: ...
    def step(self, n: int) -> None: ...
    def reset(self, with_time: bool) -> None: ...
    def state_hash(self) -> str: ...
    @property
    def time_ns(self) -> int: ...
    @property
    def dt_ns(self) -> int: ...
    @property
    def step_count(self) -> int: ...
    @property
    def seed(self) -> int: ...
    @property
    def name(self) -> str: ...
    @property
    def gravity(self) -> _Array: ...
    @property
    def message_count(self) -> int: ...
    @property
    def messages(self) -> list[Message]: ...
    def model_names(self) -> list[str]: ...
    def has_model(self, name: str) -> bool: ...
    def port_names(self) -> set[str]: ...
    def has_port(self, name: str) -> bool: ...

def save_snapshot(session: Session) -> Snapshot: ...
def restore_snapshot(session: Session, snapshot: Snapshot) -> None: ...
def cast_rays(
    session: Session, origins: _Matrix, directions: _Matrix, max_distance: float, visual: bool
) -> tuple[_Array, _Array, npt.NDArray[np.int64]]: ...
def ray_shapes(session: Session, visual: bool) -> list[tuple[str, str, str]]: ...
def has_radio(session: Session) -> bool: ...
def radio_names(session: Session) -> list[str]: ...
def radio_send(
    session: Session, source: str, destination: str, data: bytes, priority: int, deadline: float
) -> bool: ...
def radio_receive(session: Session, name: str) -> list[tuple[str, bytes, float, float, float]]: ...
def radio_links(
    session: Session, source: str
) -> list[tuple[str, str, float, float, float, int, int, int, int, int, int, float]]: ...
def radio_set_outage(session: Session, name: str, out: bool, other: str) -> None: ...
def sea_elevation(session: Session, places: _Matrix, times: _Vector) -> _Array: ...
def find_resource(uri: str, folders: list[str]) -> str: ...

class AgentSpec:
    """One model of a world that acts and observes."""
    def __init__(
        self,
        model: str,
        actions: str,
        ports: Sequence[str],
        middle: Sequence[float],
        reach: Sequence[float],
        blocks: Sequence[str],
        scan: str = "",
        beams: int = 0,
    ) -> None:
        """model: its name.
        actions: rotors, rates, velocity, thrusters or twist; commands are
        middle + reach * action and go to the input ports.
        blocks: of the observation, in order.
        scan: output of a planar lidar that is reduced to so many beams."""

class Rollout:
    """Worlds side by side, in each the same agents."""
    def __init__(
        self, sessions: Sequence[Session], agents: Sequence[AgentSpec], steps: int, threads: int
    ) -> None:
        """steps: of the world that follow each action.
        threads: that share the worlds."""
    @property
    def sizes(self) -> tuple[int, int, int, int]:
        """Worlds, agents in each, numbers of an action, of an observation."""
    def begin(self, world: int, goals: Sequence[_Vector] | _Array) -> None:
        """An episode begins. goals: x y z yaw in the world [m, rad], shape (agents, 4)."""
    def set_goals(self, world: int, goals: Sequence[_Vector] | _Array) -> None:
        """Other goals in the same episode; as begin()."""
    def observe(self, world: int) -> _Floats:
        """Observations as the world is, shape (agents, numbers), float32."""
    def step_one(self, actions: _Floats) -> tuple[_Floats, tuple[float, ...]]:
        """Of one world with one agent: observation and terms."""
    def step(
        self,
        actions: _Floats,
        resting: npt.NDArray[np.bool_],
        observations: _Floats,
        terms: _Array,
    ) -> None:
        """Act and step, without the interpreter's lock; writes into the last two, shapes
        (worlds, agents, numbers), but for worlds that rest, shape (worlds,)."""
    def state_hash(self, world: int) -> str:
        """As World.state_hash()."""

def block_names() -> list[str]:
    """What observations can be made of."""

def actuator_kinds() -> list[str]:
    """What actions can drive."""
