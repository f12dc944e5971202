# SPDX-FileCopyrightText: 2026 The Trident authors
# SPDX-License-Identifier: Apache-2.0
"""The simulator as a library: the same world as the ROS server's, stepped in this process.

No ROS is imported and no master is needed. SI units; `world` is ENU, bodies are x forward, y left,
z up; quaternions are x y z w. Arrays that are returned are copies.

Example:
    world = trident_sim.World("package://rotors_gazebo/worlds/basic.world", seed=1)
    uav = world.spawn("UAV1", urdf=trident_sim.multirotor("UAV1"), pose=(0.0, 0.0, 0.1))
    world.ports["UAV1/command/trajectory"].write([[0.0, 0.0, 1.0]])
    world.step(500)
    print(world.time, uav.position, world.state_hash())
"""

from trident_base.moved_modules import keep_old_names

from trident_sim._core import (
    ActuatorCommand,
    ActuatorState,
    BatterySample,
    BoundingBox,
    BoundingBoxesSample,
    CameraInfoSample,
    ContactsSample,
    Drive,
    DriveCommand,
    EnvironmentSample,
    Error,
    FluidPressureSample,
    FrameSample,
    GnssFixSample,
    GnssStatusSample,
    ImageCloudSample,
    ImageSample,
    ImuSample,
    Joint,
    JointCommand,
    JointStateSample,
    LaserScanSample,
    LidarCloudSample,
    Link,
    MagneticFieldSample,
    Message,
    Model,
    NumberSample,
    OdometrySample,
    PathCommand,
    PointListSample,
    PointSample,
    Port,
    PoseSample,
    PoseWithCovarianceSample,
    RangeSample,
    ScalarSample,
    ServiceCommand,
    Snapshot,
    StampedNumber,
    TextCommand,
    TouchSample,
    TrajectorySample,
    TransformSample,
    TriggerCommand,
    TwistCommand,
    TwistSample,
    VectorSample,
    WindReadingSample,
    WindSample,
    WrenchSample,
)
from trident_sim._environment import complete_environment
from trident_sim.description import (
    expand_xacro,
    find_resource,
    lee_parameter_files,
    multirotor,
    with_lee_controller,
)
from trident_sim.radio import Radio, RadioLink, RadioMessage
from trident_sim.world import RayHits, ShapeName, SimulationWarning, World

complete_environment()
keep_old_names({"trident_sim.worldgen": "trident_worldgen"})

__all__ = [
    "ActuatorCommand",
    "ActuatorState",
    "BatterySample",
    "BoundingBox",
    "BoundingBoxesSample",
    "CameraInfoSample",
    "ContactsSample",
    "Drive",
    "DriveCommand",
    "EnvironmentSample",
    "Error",
    "FluidPressureSample",
    "FrameSample",
    "GnssFixSample",
    "GnssStatusSample",
    "ImageCloudSample",
    "ImageSample",
    "ImuSample",
    "Joint",
    "JointCommand",
    "JointStateSample",
    "LaserScanSample",
    "LidarCloudSample",
    "Link",
    "MagneticFieldSample",
    "Message",
    "Model",
    "NumberSample",
    "OdometrySample",
    "PathCommand",
    "PointListSample",
    "PointSample",
    "Port",
    "PoseSample",
    "PoseWithCovarianceSample",
    "Radio",
    "RadioLink",
    "RadioMessage",
    "RangeSample",
    "RayHits",
    "ScalarSample",
    "ServiceCommand",
    "ShapeName",
    "SimulationWarning",
    "Snapshot",
    "StampedNumber",
    "TextCommand",
    "TouchSample",
    "TrajectorySample",
    "TransformSample",
    "TriggerCommand",
    "TwistCommand",
    "TwistSample",
    "VectorSample",
    "WindReadingSample",
    "WindSample",
    "World",
    "WrenchSample",
    "expand_xacro",
    "find_resource",
    "lee_parameter_files",
    "multirotor",
    "with_lee_controller",
]
