# SPDX-FileCopyrightText: 2026 The Trident authors
# SPDX-License-Identifier: Apache-2.0
from __future__ import annotations

import numpy as np
import numpy.typing as npt
import pytest
from conftest import ROTORS, Fly

import trident_sim

ODOMETRY = "UAV1/odometry_sensor1/odometry"
TRUTH = "UAV1/ground_truth/odometry"
COMMAND = "UAV1/command/motor_speed"
TRAJECTORY = "UAV1/command/trajectory"
HOVER_RAD_S = 543.0


@pytest.mark.parametrize("timing", ["rotors", "direct"])
def test_it_flies_to_its_set_point(make_flight: Fly, timing: str) -> None:
    world = make_flight((0.3, -0.2, 1.0), timing=timing)
    world.step_until(10.0)
    np.testing.assert_allclose(world.model("UAV1").position, [0.3, -0.2, 1.0], atol=0.05)


#: What RotorS' gains and masses leave of the height [m], by (controller's less true weight) / k_p.
STEADY_Z_M = {"pelican": -0.132, "ardrone": -0.022, "tutorial_iris": 0.003}


@pytest.mark.parametrize("vehicle", STEADY_Z_M)
def test_vehicles_hover_where_their_gains_hold_them(vehicle: str) -> None:
    world = trident_sim.World("package://rotors_gazebo/worlds/basic.world")
    world.spawn("UAV1", urdf=trident_sim.multirotor("UAV1", vehicle), pose=(0.0, 0.0, 0.1))
    world.ports[TRAJECTORY].write([[0.5, -0.5, 2.0]])
    world.step_until(15.0)
    np.testing.assert_allclose(
        world.model("UAV1").position, [0.5, -0.5, 2.0 + STEADY_Z_M[vehicle]], atol=5e-3
    )


def test_heading_follows_yaw(make_flight: Fly) -> None:
    world = make_flight(None)
    world.ports[TRAJECTORY].write([[0.0, 0.0, 1.0]], yaw=0.5)
    world.step_until(10.0)
    x, y, z, w = world.model("UAV1").orientation
    assert np.arctan2(2 * (w * z + x * y), 1 - 2 * (y * y + z * z)) == pytest.approx(0.5, abs=0.02)


def test_points_of_a_trajectory_take_effect_at_their_times(make_flight: Fly) -> None:
    world = make_flight(None)
    world.ports[TRAJECTORY].write([[0, 0, 1], [1, 0, 1]], times=[0.0, 5.0])
    world.step_until(5.0)
    assert abs(world.model("UAV1").position[0]) < 0.05
    world.step_until(15.0)
    assert world.model("UAV1").position[0] == pytest.approx(1.0, abs=0.05)


def test_rotors_timing_measures_the_state_before_the_step(make_flight: Fly) -> None:
    world = make_flight()
    port = world.ports[TRUTH]
    port.subscribe()
    world.step(200)
    before = world.model("UAV1").position
    world.step()
    assert port.value.stamp_ns == world.time_ns
    np.testing.assert_allclose(port.value.position, before, rtol=0, atol=1e-12)
    assert np.abs(world.model("UAV1").position - before).max() > 1e-6


def test_direct_timing_measures_the_state_after_the_step(make_flight: Fly) -> None:
    world = make_flight(timing="direct")
    port = world.ports[TRUTH]
    port.subscribe()
    world.step(201)
    assert port.value.stamp_ns == world.time_ns
    np.testing.assert_allclose(
        port.value.position, world.model("UAV1").position, rtol=0, atol=1e-12
    )


@pytest.mark.parametrize(("timing", "steps"), [("rotors", 2), ("direct", 1)])
def test_delay_of_a_command(make_flight: Fly, timing: str, steps: int) -> None:
    """The answer to the state stamped s turns the motors this many steps after it was measured."""
    world = make_flight(controlled=False, timing=timing)
    odometry = world.ports[ODOMETRY]
    odometry.subscribe()
    world.step(5)
    world.ports[COMMAND].write([HOVER_RAD_S] * ROTORS, stamp=odometry.value.stamp)
    rotor = world.model("UAV1").joint("UAV1/rotor_0_joint")
    for _ in range(steps):
        assert rotor.velocity == 0.0
        world.step()
    assert rotor.velocity != 0.0


def test_an_unstamped_command_acts_at_once(make_flight: Fly) -> None:
    world = make_flight(controlled=False)
    world.ports[COMMAND].write(trident_sim.ActuatorCommand(np.full(ROTORS, HOVER_RAD_S)))
    world.step()
    assert world.model("UAV1").joint("UAV1/rotor_0_joint").velocity != 0.0


def test_a_command_of_too_few_speeds_is_reported_and_the_rest_flies(make_flight: Fly) -> None:
    world = make_flight(controlled=False)
    world.ports[COMMAND].write([HOVER_RAD_S] * (ROTORS - 1))
    with pytest.warns(trident_sim.SimulationWarning, match="motor 5 is not in a command of 5"):
        world.step(2)
    model = world.model("UAV1")
    driven, free = (abs(model.joint(f"UAV1/rotor_{i}_joint").velocity) for i in (4, 5))
    assert free < 0.01 < 1.0 < driven
    assert [message.severity for message in world.messages] == ["error"]


def test_equal_input_gives_equal_states(make_flight: Fly) -> None:
    first, second = make_flight(), make_flight()
    assert first.state_hash() == second.state_hash()
    first.step(300)
    for _ in range(300):
        second.step()
    assert first.state_hash() == second.state_hash()
    second.step()
    assert first.state_hash() != second.state_hash()


def test_another_set_point_gives_another_state(make_flight: Fly) -> None:
    first, second = make_flight((0.0, 0.0, 1.0)), make_flight((0.0, 0.0, 1.0 + 1e-12))
    first.step(300)
    second.step(300)
    assert first.state_hash() != second.state_hash()


def test_reset_and_the_same_commands_give_the_same_state(make_flight: Fly) -> None:
    world = make_flight()
    world.step(300)
    expected = world.state_hash()
    world.step(50)
    world.reset()
    world.ports[TRAJECTORY].write([[0.0, 0.0, 1.0]])
    world.step(300)
    assert world.state_hash() == expected


def test_noise_follows_the_seed_and_does_not_move_the_vehicle(make_flight: Fly) -> None:
    def imu_and_hash(seed: int, listen: bool = True) -> tuple[npt.NDArray[np.float64], str]:
        world = make_flight(seed=seed)
        port = world.ports["UAV1/imu"]
        if listen:
            port.subscribe()
        world.step(100)
        return port.value.linear_acceleration if listen else np.zeros(3), world.state_hash()

    first, first_hash = imu_and_hash(3)
    again, again_hash = imu_and_hash(3)
    other, _ = imu_and_hash(4)
    np.testing.assert_array_equal(first, again)
    assert np.abs(first - other).max() > 0.0
    assert first_hash == again_hash == imu_and_hash(3, listen=False)[1]


def test_a_vehicle_can_be_removed_in_flight_and_spawned_again(
    make_flight: Fly, firefly_urdf: str
) -> None:
    world = make_flight()
    port = world.ports[ODOMETRY]
    port.subscribe()
    world.step(50)
    world.remove("UAV1")
    assert len(world.ports) == 0
    with pytest.raises(trident_sim.Error, match="no longer in the world"):
        port.read()
    world.step(10)
    world.spawn("UAV1", urdf=firefly_urdf, pose=(0, 0, 0.1))
    assert not port.subscribed
    assert port.read() is None
    world.step()
    assert port.read().stamp_ns == world.time_ns


def test_a_battery_gives_what_the_rotors_of_a_hovering_iris_take() -> None:
    world = trident_sim.World("package://rotors_gazebo/worlds/basic.world")
    rotors = ", ".join(f"UAV1/rotor_{i}_joint" for i in range(4))
    battery = (
        '<gazebo><plugin name="battery" filename="libtrident_battery.so">'
        "<robotNamespace>UAV1</robotNamespace><capacity>1</capacity><cells>4</cells>"
        f"<idlePower>20</idlePower><jointName>{rotors}</jointName><jointPower>2e-7</jointPower>"
        "<speedFactor>10</speedFactor></plugin></gazebo></robot>"
    )
    urdf = trident_sim.multirotor("UAV1", "iris").replace("</robot>", battery)
    world.spawn("UAV1", urdf=urdf, pose=(0.0, 0.0, 0.1))
    world.ports[TRAJECTORY].write([[0.0, 0.0, 1.0]])
    state = world.ports["UAV1/battery"]
    state.subscribe()
    world.step_until(10.0)
    before = state.value
    # Rotors carry 1.52 kg with 8.54858e-6 N s^2/rad^2 each.
    speed = np.sqrt(1.52 * 9.8 / 4 / 8.54858e-6)
    assert before.voltage * before.current == pytest.approx(20 + 4 * 2e-7 * speed**3, rel=0.02)
    world.step_until(20.0)
    used = before.charge - state.value.charge
    assert used == pytest.approx(before.current * 10.0 / 3600.0, rel=0.02)
    world.ports["UAV1/battery/set_charge"].write(0.5)
    world.step_until(21.0)
    assert state.value.percentage == pytest.approx(0.5, abs=1e-2)
