# SPDX-FileCopyrightText: 2026 The Trident authors
# SPDX-License-Identifier: Apache-2.0
"""What sensors cost: on moving robots among 60 boxes, in this process, without ROS.

The cost of a sensor is the CPU time of a run in which its topics are read, less that of the same
run in which nobody reads them. Python reads no value: a topic that is subscribed is computed.
"""

from __future__ import annotations

import math
import time
from collections.abc import Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np
from trident_eval.core.errors import EvalError

from trident_benchmarks.sim.rows import number_text

_DT_S = 0.001
_BOXES = 60
_WARM_UP_S = 0.2
_VELODYNE = "libgazebo_ros_velodyne_laser.so"

#: Gazebo 11.1's CPU `ray` sensor in a world of 20 boxes, the best that was seen.
GAZEBO = {
    "scan360_per_s": 3700.0,
    "scan360_mrays_per_s": 1.3,
    "rings16x1800_scans_per_s": 3.8,
    "rings16x1800_mrays_per_s": 0.11,
}


@dataclass(frozen=True)
class Case:
    """One sensor to measure.

    Attributes:
        name: of the row.
        sensor: `<sensor>` element.
        topics: of one robot, below its namespace; those that are read.
        rays: per sample.
        rate_hz: samples per simulated second.
        robots: how many carry one.
        sim_s: simulated time of one run [s].
        threads: that share the work; what is asked for is asked of one.
    """

    name: str
    sensor: str
    topics: tuple[str, ...]
    rays: int
    rate_hz: float
    robots: int = 1
    sim_s: float = 10.0
    threads: int = 1


def _lidar(samples: int, rings: int, rate_hz: float, plugin: str, topic: str) -> str:
    vertical = (
        f"<vertical><samples>{rings}</samples><min_angle>{-math.radians(15)}</min_angle>"
        f"<max_angle>{math.radians(15)}</max_angle></vertical>"
        if rings > 1
        else ""
    )
    last = math.pi - 2.0 * math.pi / samples
    of_plugin = "<gaussianNoise>0.008</gaussianNoise>" if plugin == _VELODYNE else ""
    return (
        f"<sensor type='ray' name='lidar'><update_rate>{rate_hz:g}</update_rate><ray><scan>"
        f"<horizontal><samples>{samples}</samples><min_angle>{-math.pi}</min_angle>"
        f"<max_angle>{last}</max_angle></horizontal>{vertical}</scan>"
        "<range><min>0.4</min><max>100</max></range></ray>"
        f"<plugin name='lidar' filename='{plugin}'><topicName>{topic}</topicName>"
        f"<frameName>lidar</frameName>{of_plugin}</plugin></sensor>"
    )


def _rgbd(width: int, height: int, rate_hz: float) -> str:
    return (
        f"<sensor type='depth' name='camera'><update_rate>{rate_hz:g}</update_rate>"
        "<camera><horizontal_fov>1.047</horizontal_fov><image>"
        f"<width>{width}</width><height>{height}</height><format>R8G8B8</format></image>"
        "<clip><near>0.1</near><far>20</far></clip>"
        "<noise><type>gaussian</type><mean>0</mean><stddev>0.007</stddev></noise></camera>"
        "<plugin name='camera' filename='libgazebo_ros_openni_kinect.so'>"
        "<cameraName>camera</cameraName><imageTopicName>rgb/image_raw</imageTopicName>"
        "<cameraInfoTopicName>rgb/camera_info</cameraInfoTopicName>"
        "<depthImageTopicName>depth/image_raw</depthImageTopicName>"
        "<depthImageCameraInfoTopicName>depth/camera_info</depthImageCameraInfoTopicName>"
        "<pointCloudTopicName>depth/points</pointCloudTopicName><frameName>camera</frameName>"
        "<pointCloudCutoff>0.1</pointCloudCutoff><pointCloudCutoffMax>20</pointCloudCutoffMax>"
        "</plugin></sensor>"
    )


_IMAGES = ("camera/rgb/image_raw", "camera/depth/image_raw")

CASES = (
    Case(
        "scan360",
        _lidar(360, 1, 0, "libgazebo_ros_laser.so", "scan"),
        ("scan",),
        rays=360,
        rate_hz=1.0 / _DT_S,
    ),
    Case(
        "scan360_6robots",
        _lidar(360, 1, 0, "libgazebo_ros_laser.so", "scan"),
        ("scan",),
        rays=360,
        rate_hz=1.0 / _DT_S,
        robots=6,
        sim_s=4.0,
    ),
    Case(
        "rings16x1800",
        _lidar(1800, 16, 100, _VELODYNE, "points"),
        ("points",),
        rays=16 * 1800,
        rate_hz=100.0,
        sim_s=4.0,
    ),
    Case(
        "vlp16_10hz",
        _lidar(1875, 16, 10, _VELODYNE, "points"),
        ("points",),
        rays=16 * 1875,
        rate_hz=10.0,
        sim_s=20.0,
    ),
    Case(
        "vlp16_10hz_6robots",
        _lidar(1875, 16, 10, _VELODYNE, "points"),
        ("points",),
        rays=16 * 1875,
        rate_hz=10.0,
        robots=6,
    ),
    Case(
        "rgbd_640x480_30hz",
        _rgbd(640, 480, 30),
        _IMAGES,
        rays=640 * 480,
        rate_hz=30.0,
        sim_s=5.0,
    ),
    Case(
        "rgbd_640x480_30hz_2threads",
        _rgbd(640, 480, 30),
        _IMAGES,
        rays=640 * 480,
        rate_hz=30.0,
        sim_s=5.0,
        threads=2,
    ),
    Case(
        "rgbd_640x480_30hz_points",
        _rgbd(640, 480, 30),
        ("camera/depth/points",),
        rays=640 * 480,
        rate_hz=30.0,
        sim_s=5.0,
    ),
    Case(
        "rgbd_320x240_15hz",
        _rgbd(320, 240, 15),
        _IMAGES,
        rays=320 * 240,
        rate_hz=15.0,
    ),
)


def world_text() -> str:
    """Boxes of 0.4 to 2 m, 3 to 20 m from the origin, on a ground plane."""
    random = np.random.default_rng(1)
    models = []
    for index in range(_BOXES):
        x, y, z = random.uniform(0.4, 2.0, 3)
        distance, bearing, yaw = random.uniform([4.0, -math.pi, -math.pi], [20.0, math.pi, math.pi])
        box = f"<geometry><box><size>{x} {y} {z}</size></box></geometry>"
        place = f"{distance * math.cos(bearing)} {distance * math.sin(bearing)} {z / 2} 0 0 {yaw}"
        models.append(
            f"<model name='box{index}'><static>1</static><pose>{place}</pose><link name='link'>"
            f"<collision name='c'>{box}</collision><visual name='v'>{box}</visual></link></model>"
        )
    return (
        "<sdf version='1.6'><world name='boxes'><include><uri>model://ground_plane</uri></include>"
        "<include><uri>model://sun</uri></include><physics type='ode'>"
        f"<max_step_size>{_DT_S}</max_step_size></physics>{''.join(models)}</world></sdf>"
    )


def robot_text(name: str, sensor: str) -> str:
    """A box that slides as commanded, with a sensor on a mast."""
    box = "<geometry><box><size>0.4 0.3 0.2</size></box></geometry>"
    return (
        "<sdf version='1.6'><model name='robot'><link name='base'><pose>0 0 0.1 0 0 0</pose>"
        "<inertial><mass>5</mass><inertia><ixx>0.1</ixx><iyy>0.1</iyy><izz>0.1</izz></inertia>"
        f"</inertial><collision name='c'>{box}</collision><visual name='v'>{box}</visual>"
        f"{sensor.replace('<update_rate>', '<pose>0 0 0.5 0 0 0</pose><update_rate>', 1)}</link>"
        "<plugin name='move' filename='libgazebo_ros_planar_move.so'>"
        f"<robotBaseFrame>{name}</robotBaseFrame></plugin></model></sdf>"
    )


def measure(case: Case, runs: int, quick: bool) -> dict[str, Any]:
    """One row: the medians of its runs.

    Raises:
        EvalError: it cannot be measured.
    """
    sim_s = case.sim_s / (5.0 if quick else 1.0)
    results = [_run(case, sim_s) for _ in range(runs)]
    row: dict[str, Any] = {"mode": case.name, "n": case.robots, "runs": runs, "sim_s": sim_s}
    for key in results[0]:
        row[key] = float(np.median([result[key] for result in results]))
    row["mrays_per_s_all"] = [result["mrays_per_s"] for result in results]
    return row


def failed(case: Case, error: str) -> dict[str, Any]:
    """The row of a case that could not be measured."""
    return {"mode": case.name, "n": case.robots, "error": error}


def _run(case: Case, sim_s: float) -> dict[str, float]:
    """The same simulated time without and with readers, one after the other."""
    world, ports = _make(case)
    steps = round(sim_s / _DT_S)
    world.step(round(_WARM_UP_S / _DT_S))
    idle_cpu, _ = _timed(world, steps)
    for port in ports:
        port.subscribe()
    world.step(round(_WARM_UP_S / _DT_S))
    before = [port.count for port in ports]
    cpu, wall = _timed(world, steps)
    counts = [port.count - was for port, was in zip(ports, before, strict=True)]
    wanted = case.rate_hz * sim_s
    if min(counts) < 0.9 * wanted - 1:
        raise EvalError(f"{case.name}: {min(counts)} samples in {sim_s:g} s, not {wanted:g}")
    samples = sum(counts) / len(case.topics)
    spent = max(cpu - idle_cpu, 1e-9)
    return {
        "samples_per_s": samples / spent,
        "mrays_per_s": samples * case.rays / spent / 1e6,
        "core_share": spent / sim_s,
        "cpu_s_per_sim_s": cpu / sim_s,
        "rtf": sim_s / wall,
    }


def _timed(world: Any, steps: int) -> tuple[float, float]:
    """CPU and wall time of that many steps [s]."""
    cpu, wall = time.process_time(), time.perf_counter()
    world.step(steps)
    return time.process_time() - cpu, time.perf_counter() - wall


def _make(case: Case) -> tuple[Any, list[Any]]:
    """A world in which robots drive circles, and the topics that are to be read."""
    import trident_sim

    try:
        world = trident_sim.World(world_text(), sensor_threads=case.threads)
        ports = []
        for index in range(case.robots):
            bearing = 2.0 * math.pi * index / case.robots
            place = (1.5 * math.cos(bearing), 1.5 * math.sin(bearing), 0.0, 0.0, 0.0, bearing)
            name = f"robot{index}"
            world.spawn(name, sdf=robot_text(name, case.sensor), pose=place)
            command = trident_sim.TwistCommand((0.1, 0.0, 0.0), (0.0, 0.0, 0.5))
            world.ports[f"{name}/cmd_vel"].write(command)
            ports += [world.ports[f"{name}/{topic}"] for topic in case.topics]
    except (trident_sim.Error, KeyError) as error:
        raise EvalError(f"{case.name}: {error}") from error
    return world, ports


_COLUMNS = (
    ("mode", "sensor"),
    ("n", "robots"),
    ("samples_per_s", "samples per CPU s"),
    ("mrays_per_s", "Mray per CPU s"),
    ("core_share", "CPU s per simulated s"),
    ("rtf", "real-time factor of the whole"),
    ("runs", "runs"),
)


def line(row: dict[str, Any]) -> str:
    """A row in a few words."""
    if "error" in row:
        return f"{row['mode']}: failed: {row['error']}"
    return (
        f"{row['mode']}: {number_text(row['samples_per_s'])} samples/s, "
        f"{number_text(row['mrays_per_s'])} Mray/s, {number_text(row['core_share'])} of a core, "
        f"rtf {number_text(row['rtf'])}"
    )


def markdown_table(rows: Sequence[dict[str, Any]]) -> str:
    """The rows as a Markdown table, and Gazebo's figures below."""
    lines = [
        "| " + " | ".join(title for _, title in _COLUMNS) + " |",
        "|" + "|".join(" --- " if key == "mode" else " ---: " for key, _ in _COLUMNS) + "|",
    ]
    for row in rows:
        cells = [number_text(row.get(key)) for key, _ in _COLUMNS]
        if "error" in row:
            cells[2] = f"failed: {row['error']}"
        lines.append("| " + " | ".join(cells) + " |")
    lines += ["", "Gazebo 11.1's CPU `ray` sensor in a world of 20 boxes: "]
    lines[-1] += "; ".join(f"{name} {number_text(value)}" for name, value in GAZEBO.items())
    return "\n".join(lines)


def headline(rows: Sequence[dict[str, Any]]) -> dict[str, float]:
    """The figures that are asked for, of the rows that are there."""
    wanted = {
        "mrays_per_s_core": ("rings16x1800", "mrays_per_s"),
        "vlp16_core_share": ("vlp16_10hz", "core_share"),
        "rgbd_640x480_30hz_rtf": ("rgbd_640x480_30hz", "rtf"),
        "scan360_per_s": ("scan360", "samples_per_s"),
        "scan360_6robots_per_s": ("scan360_6robots", "samples_per_s"),
        "vlp16_6robots_core_share": ("vlp16_10hz_6robots", "core_share"),
    }
    by_mode = {row["mode"]: row for row in rows if "error" not in row}
    return {name: by_mode[mode][key] for name, (mode, key) in wanted.items() if mode in by_mode}
