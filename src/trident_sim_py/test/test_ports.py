# SPDX-FileCopyrightText: 2026 The Trident authors
# SPDX-License-Identifier: Apache-2.0
from __future__ import annotations

import numpy as np
import pytest
from conftest import Fly

import trident_sim

ODOMETRY = "UAV1/odometry_sensor1/odometry"


def test_ports_are_a_mapping(make_flight: Fly) -> None:
    ports = make_flight().ports
    assert list(ports) == sorted(ports)
    assert len(ports) == len(list(ports))
    assert ODOMETRY in ports
    assert "nothing" not in ports
    assert ports.get("nothing") is None
    assert (ports[ODOMETRY].is_output, ports[ODOMETRY].is_input) == (True, False)
    command = ports["UAV1/command/trajectory"]
    assert (command.is_output, command.is_input) == (False, True)
    assert command.type == "TrajectorySample"
    assert ports[ODOMETRY].type == "OdometrySample"
    passed_on = ports["UAV1/gazebo/command/motor_speed"]
    assert (passed_on.is_output, passed_on.is_input) == (True, True)


def test_every_port_of_a_vehicle_has_a_type_that_python_knows(make_flight: Fly) -> None:
    for port in make_flight().ports.values():
        assert hasattr(trident_sim, port.type), port.name


def test_only_what_is_subscribed_is_computed(make_flight: Fly) -> None:
    world = make_flight(controlled=False)
    port = world.ports[ODOMETRY]
    world.step(3)
    assert (port.count, port.subscribed) == (0, False)
    port.subscribe()
    port.subscribe()
    world.step(3)
    assert port.count == 3
    port.unsubscribe()
    world.step(3)
    assert (port.count, port.subscribed) == (3, False)


def test_value_before_the_first_is_an_error_and_subscribes(make_flight: Fly) -> None:
    world = make_flight(controlled=False)
    port = world.ports[ODOMETRY]
    with pytest.raises(trident_sim.Error, match="has no value yet; it is subscribed now"):
        _ = port.value
    world.step()
    assert port.value.stamp == world.time


def test_read_returns_each_value_once(make_flight: Fly) -> None:
    world = make_flight(controlled=False)
    port, other = world.ports[ODOMETRY], world.ports[ODOMETRY]
    assert port.read() is None
    world.step()
    assert port.read().stamp == 0.01
    assert port.read() is None
    assert other.read().stamp == 0.01
    world.step(2)
    assert port.read().stamp == 0.03


def test_odometry_fields(make_flight: Fly) -> None:
    world = make_flight()
    port = world.ports["UAV1/ground_truth/odometry"]
    port.subscribe()
    world.step(100)
    sample = port.value
    assert isinstance(sample, trident_sim.OdometrySample)
    assert (sample.stamp, sample.stamp_ns, sample.parent_frame) == (1.0, 1_000_000_000, "world")
    shapes = {
        "position": (3,),
        "orientation": (4,),
        "linear_velocity": (3,),
        "angular_velocity": (3,),
        "pose_covariance": (6, 6),
        "twist_covariance": (6, 6),
    }
    for name, shape in shapes.items():
        array = getattr(sample, name)
        assert (name, array.shape, array.dtype) == (name, shape, np.float64)
    assert np.linalg.norm(sample.orientation) == pytest.approx(1.0)


def test_a_value_does_not_change_with_later_steps(make_flight: Fly) -> None:
    world = make_flight()
    port = world.ports[ODOMETRY]
    port.subscribe()
    world.step(50)
    sample, height = port.value, port.value.position[2]
    world.step(50)
    assert sample.position[2] == height != port.value.position[2]


def test_each_output_of_a_vehicle_can_be_read(make_flight: Fly) -> None:
    world = make_flight()
    outputs = [port for port in world.ports.values() if port.is_output]
    for port in outputs:
        port.subscribe()
    world.step(100)
    fields_read = 0
    for port in outputs:
        if port.count == 0:
            continue
        value = port.value
        for field in (name for name in dir(value) if not name.startswith("_")):
            array = getattr(value, field)
            if isinstance(array, np.ndarray):
                fields_read += 1
                assert np.isfinite(array).all(), (port.name, field)
    assert fields_read > 20
    imu = world.ports["UAV1/imu"].value
    assert imu.linear_acceleration[2] == pytest.approx(9.8, abs=2.0)
    assert world.ports["UAV1/motor_speed"].value.angular_velocities.shape == (6,)
    names = world.ports["UAV1/joint_states"].value.names
    assert world.ports["UAV1/joint_states"].value.positions.shape == (len(names),)


def test_wind_pushes(make_flight: Fly) -> None:
    calm, windy = make_flight(), make_flight()
    for _ in range(300):
        windy.ports["UAV1/wind_speed"].write((3.0, 0.0, 0.0))
        windy.step()
    calm.step(300)
    assert windy.model("UAV1").position[0] > calm.model("UAV1").position[0] + 0.01


def test_the_ninth_value_between_two_steps_is_refused(make_flight: Fly) -> None:
    world = make_flight(None)
    port = world.ports["UAV1/command/trajectory"]
    for _ in range(8):
        port.write([[0.0, 0.0, 1.0]])
    with pytest.raises(trident_sim.Error, match="8 values wait already; step the world"):
        port.write([[0.0, 0.0, 1.0]])
    world.step()
    port.write([[0.0, 0.0, 1.0]])


def test_reading_an_input_and_writing_an_output_is_refused(make_flight: Fly) -> None:
    world = make_flight()
    with pytest.raises(trident_sim.Error, match=r"motor_speed' is not an output"):
        world.ports["UAV1/command/motor_speed"].read()
    with pytest.raises(trident_sim.Error, match=r"odometry' is not an input"):
        world.ports[ODOMETRY].write([1.0])
