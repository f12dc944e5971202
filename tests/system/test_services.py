# SPDX-FileCopyrightText: 2026 The Trident authors
# SPDX-License-Identifier: Apache-2.0
"""The services of /gazebo, asked by rospy clients with gazebo_msgs' types."""

from __future__ import annotations

import math
import threading
from collections.abc import Callable
from concurrent.futures import ThreadPoolExecutor
from typing import Any

import pytest
import rospy
from gazebo_msgs.msg import LinkState, ModelState
from gazebo_msgs.srv import SetPhysicsPropertiesRequest
from geometry_msgs.msg import Point, Twist, Vector3, Wrench
from harness import Gazebo, Ros, box_sdf, eventually, package, pose, recorder, vehicle_urdf
from rosgraph_msgs.msg import Clock
from std_msgs.msg import Bool
from std_srvs.srv import Empty
from uuv_gazebo_ros_plugins_msgs.srv import (
    GetThrusterConversionFcn,
    GetThrusterEfficiency,
    GetThrusterState,
    SetThrusterEfficiency,
    SetThrusterState,
)

DT = 0.01  # of basic.world


def twist(linear: tuple[float, float, float], angular: tuple[float, float, float]) -> Twist:
    return Twist(Vector3(*linear), Vector3(*angular))


def test_a_urdf_and_an_sdf_are_spawned_while_paused_before_any_time_has_passed(
    gazebo: Gazebo,
) -> None:
    assert gazebo.time() == 0.0
    gazebo.spawn("UAV1", vehicle_urdf("UAV1"), pose(1.0, 2.0, 0.1))
    gazebo.spawn("crate", box_sdf("anything"), pose(0.0, 0.0, 3.0, yaw_rad=0.5))
    properties = gazebo.ask("get_world_properties")
    assert set(properties.model_names) == {"ground_plane", "UAV1", "crate"}
    assert properties.sim_time == 0.0
    assert gazebo.position("UAV1") == pytest.approx((1.0, 2.0, 0.1), abs=1e-12)
    state = gazebo.ask("get_model_state", model_name="crate")
    assert state.pose.orientation.z == pytest.approx(math.sin(0.25), abs=1e-12)


def test_a_second_model_of_a_name_is_refused_with_upstreams_words(gazebo: Gazebo) -> None:
    gazebo.spawn("UAV1")
    status = gazebo.refusal(
        "spawn_urdf_model",
        model_name="UAV1",
        model_xml=vehicle_urdf("UAV1"),
        robot_namespace="/UAV1",
        initial_pose=pose(z=1.0),
        reference_frame="",
    )
    assert status == "SpawnModel: Failure - model name UAV1 already exist."
    assert gazebo.position("UAV1") == pytest.approx((0.0, 0.0, 0.1))


def test_a_deleted_model_is_gone_and_its_name_is_free_again(gazebo: Gazebo) -> None:
    gazebo.spawn("UAV1")
    with recorder("/UAV1/odometry_sensor1/odometry", rospy.AnyMsg):
        gazebo.step(1)
    status = gazebo.ask("delete_model", model_name="UAV1").status_message
    assert "successfully deleted" in status
    assert "UAV1" not in gazebo.ask("get_world_properties").model_names
    topics = [topic for topic, _ in rospy.get_published_topics("/UAV1")]
    assert "/UAV1/odometry_sensor1/odometry" not in topics
    assert "UAV1" in gazebo.refusal("delete_model", model_name="UAV1")
    gazebo.spawn("UAV1", at=pose(5.0, 0.0, 0.1))
    gazebo.step(10)
    assert gazebo.position("UAV1")[0] == pytest.approx(5.0, abs=1e-3)


def test_spawn_in_the_frame_of_a_model(gazebo: Gazebo) -> None:
    gazebo.spawn("base", box_sdf("base"), pose(1.0, 1.0, 5.0, yaw_rad=math.pi / 2.0))
    gazebo.spawn("next", box_sdf("next"), pose(2.0, 0.0, 1.0), reference_frame="base")
    assert gazebo.position("next") == pytest.approx((1.0, 3.0, 6.0))
    status = gazebo.refusal(
        "spawn_sdf_model",
        model_name="lost",
        model_xml=box_sdf("lost"),
        robot_namespace="",
        initial_pose=pose(),
        reference_frame="no_such_frame",
    )
    assert status.startswith("SpawnModel: Failure - ")
    assert "no_such_frame" in status


def test_model_states_are_set_and_read_in_frames(gazebo: Gazebo) -> None:
    gazebo.spawn("a", box_sdf("a"), pose(1.0, 0.0, 5.0, yaw_rad=math.pi / 2.0))
    gazebo.spawn("b", box_sdf("b"), pose(0.0, 0.0, 9.0))
    state = ModelState("b", pose(2.0, 0.0, 0.0), twist((0.5, 0.0, 0.0), (0.0, 0.0, 0.2)), "a")
    gazebo.ask("set_model_state", model_state=state)
    in_world = gazebo.ask("get_model_state", model_name="b")
    assert gazebo.position("b") == pytest.approx((1.0, 2.0, 5.0))
    assert in_world.twist.linear.y == pytest.approx(0.5)
    assert in_world.twist.angular.z == pytest.approx(0.2)
    relative = gazebo.ask("get_model_state", model_name="b", relative_entity_name="a")
    assert relative.header.frame_id == "a"
    assert (relative.pose.position.x, relative.pose.position.y) == pytest.approx((2.0, 0.0))
    assert relative.twist.linear.x == pytest.approx(0.5)
    assert "GetModelState" in gazebo.refusal("get_model_state", model_name="nobody")
    assert "nowhere" in gazebo.refusal(
        "get_model_state", model_name="b", relative_entity_name="nowhere"
    )


def test_link_states_are_set_and_read_in_frames(gazebo: Gazebo) -> None:
    gazebo.spawn("a", box_sdf("a"), pose(0.0, 1.0, 5.0))
    gazebo.spawn("b", box_sdf("b"), pose(0.0, 0.0, 9.0))
    state = LinkState("b::link", pose(0.0, 1.0, 1.0), twist((0.0, 0.3, 0.0), (0.0, 0.0, 0.0)), "a")
    gazebo.ask("set_link_state", link_state=state)
    link = gazebo.ask("get_link_state", link_name="b::link", reference_frame="world").link_state
    assert (link.pose.position.x, link.pose.position.y, link.pose.position.z) == pytest.approx(
        (0.0, 2.0, 6.0)
    )
    assert link.twist.linear.y == pytest.approx(0.3)
    relative = gazebo.ask("get_link_state", link_name="b::link", reference_frame="a::link")
    assert relative.link_state.pose.position.z == pytest.approx(1.0)
    assert "no_such_link" in gazebo.refusal("get_link_state", link_name="b::no_such_link")


def test_model_properties_name_links_and_joints(gazebo: Gazebo) -> None:
    gazebo.spawn("UAV1")
    properties = gazebo.ask("get_model_properties", model_name="UAV1")
    assert "UAV1/base_link" in properties.body_names
    assert {f"UAV1/rotor_{i}_joint" for i in range(6)} <= set(properties.joint_names)
    assert properties.canonical_body_name == "UAV1/base_link"
    assert not properties.is_static
    assert gazebo.ask("get_model_properties", model_name="ground_plane").is_static
    assert "nobody" in gazebo.refusal("get_model_properties", model_name="nobody")


def test_set_model_state_works_as_a_topic(gazebo: Gazebo) -> None:
    gazebo.spawn("a", box_sdf("a"), pose(z=5.0))
    publisher = rospy.Publisher("/gazebo/set_model_state", ModelState, queue_size=1)
    eventually(lambda: publisher.get_num_connections() > 0, "a subscriber of set_model_state")
    publisher.publish(ModelState("a", pose(7.0, 8.0, 9.0), Twist(), ""))
    eventually(lambda: gazebo.position("a") == pytest.approx((7.0, 8.0, 9.0)), "the new pose")
    publisher.unregister()


def test_pause_stops_time_and_unpause_lets_it_run(start_gazebo: Callable[..., Gazebo]) -> None:
    gazebo = start_gazebo(paused=False)
    gazebo.until(0.5)
    gazebo.ask("pause_physics")
    stopped = gazebo.time()
    assert gazebo.ask("get_physics_properties").pause
    with recorder("/clock", Clock) as clock:  # latched: the time it stands at, and no more
        assert clock.received(1)[0].clock.to_sec() == pytest.approx(stopped)
        assert [gazebo.time() for _ in range(50)] == [stopped] * 50
        assert len(clock.messages) == 1
    gazebo.ask("unpause_physics")
    gazebo.until(stopped + 0.5)
    assert not gazebo.ask("get_physics_properties").pause


def test_step_blocks_and_ends_exactly_with_clock_sent(gazebo: Gazebo) -> None:
    gazebo.spawn("a", box_sdf("a"), pose(z=1000.0))
    done = 0
    with recorder("/clock", Clock) as clock:
        for n in (1, 7, 92, 1, 400):
            done += n
            response = gazebo.ask("step", n=n)
            assert response.sim_time.to_nsec() == done * 10_000_000
            assert gazebo.time() == pytest.approx(done * DT, abs=1e-12)
            eventually(
                lambda at=response.sim_time: (
                    bool(clock.messages) and clock.messages[-1].clock == at
                ),
                f"/clock at {response.sim_time}",
            )
        stamps = [message.clock.to_nsec() for message in clock.messages]
        assert stamps == sorted(set(stamps))
    # Free fall, integrated semi-implicitly as ODE does: exact to the step count.
    fallen = 1000.0 - gazebo.position("a")[2]
    assert fallen == pytest.approx(0.5 * 9.8 * DT * DT * done * (done + 1), rel=1e-9)


def test_step_of_nothing_is_refused(gazebo: Gazebo) -> None:
    assert "n is 0" in gazebo.refusal("step", n=0)
    assert gazebo.time() == 0.0


def test_step_while_running_comes_back_after_at_least_its_steps(
    start_gazebo: Callable[..., Gazebo],
) -> None:
    gazebo = start_gazebo(paused=False, real_time_factor=1.0)
    gazebo.until(0.1)
    before = gazebo.time()
    after = gazebo.step(20)
    assert after >= before + 20 * DT - 1e-9
    assert not gazebo.ask("get_physics_properties").pause
    gazebo.until(after + 0.1)


def test_two_step_calls_at_once_never_lose_steps(gazebo: Gazebo) -> None:
    responses = []
    with ThreadPoolExecutor(4) as pool:
        responses = list(pool.map(lambda _: gazebo.call("step", n=25), range(4)))
    made = sum(response.success for response in responses) * 25
    assert made >= 25
    assert gazebo.time() == pytest.approx(made * DT)
    for response in responses:
        assert response.success or "in progress" in response.message


def test_reset_world_restores_poses_and_keeps_the_time(gazebo: Gazebo) -> None:
    gazebo.spawn("a", box_sdf("a"), pose(1.0, 2.0, 5.0))
    gazebo.step(50)
    assert gazebo.position("a")[2] < 4.5
    gazebo.ask("reset_world")
    state = gazebo.ask("get_model_state", model_name="a")
    assert gazebo.position("a") == pytest.approx((1.0, 2.0, 5.0), abs=1e-12)
    assert state.twist.linear.z == 0.0
    assert gazebo.time() == pytest.approx(0.5)


def test_reset_simulation_sets_time_and_clock_back(gazebo: Gazebo) -> None:
    gazebo.spawn("a", box_sdf("a"), pose(1.0, 2.0, 5.0))
    gazebo.step(50)
    with recorder("/clock", Clock) as clock:
        gazebo.ask("reset_simulation")
        eventually(
            lambda: bool(clock.messages) and clock.messages[-1].clock.to_nsec() == 0, "/clock at 0"
        )
    assert gazebo.time() == 0.0
    assert gazebo.position("a") == pytest.approx((1.0, 2.0, 5.0), abs=1e-12)
    assert gazebo.step(3) == pytest.approx(3 * DT)


def test_a_force_moves_a_box_by_half_a_t_squared(gazebo: Gazebo) -> None:
    mass, force, steps = 2.0, 3.0, 100
    gazebo.spawn("a", box_sdf("a", mass_kg=mass), pose(z=200.0))
    gazebo.ask(
        "apply_body_wrench",
        body_name="a::link",
        reference_frame="world",
        reference_point=Point(),
        wrench=Wrench(Vector3(force, 0.0, 0.0), Vector3()),
        start_time=rospy.Time(0),
        duration=rospy.Duration(-1),
    )
    gazebo.step(steps)
    elapsed = steps * DT
    assert gazebo.position("a")[0] == pytest.approx(force * elapsed**2 / 2.0 / mass, rel=0.02)
    gazebo.ask("clear_body_wrenches", body_name="a::link")
    speed = gazebo.ask("get_model_state", model_name="a").twist.linear.x
    assert speed == pytest.approx(force * elapsed / mass, rel=1e-6)
    gazebo.step(steps)
    assert gazebo.ask("get_model_state", model_name="a").twist.linear.x == pytest.approx(speed)


def test_a_wrench_ends_after_its_duration_and_turns_about_its_point(gazebo: Gazebo) -> None:
    gazebo.spawn("a", box_sdf("a", size_m=0.2, mass_kg=2.0), pose(z=200.0))
    gazebo.ask(
        "apply_body_wrench",
        body_name="a::link",
        reference_frame="a::link",
        reference_point=Point(0.0, 0.1, 0.0),
        wrench=Wrench(Vector3(0.1, 0.0, 0.0), Vector3()),
        start_time=rospy.Time(0),
        duration=rospy.Duration(0.2),
    )
    gazebo.step(60)
    state = gazebo.ask("get_model_state", model_name="a")
    inertia = 2.0 * 0.2**2 / 6.0
    assert state.twist.angular.z == pytest.approx(-0.1 * 0.1 * 0.2 / inertia, rel=0.01)
    assert math.hypot(state.twist.linear.x, state.twist.linear.y) == pytest.approx(0.01, rel=0.01)
    refused = gazebo.refusal(
        "apply_body_wrench", body_name="a::nothing", duration=rospy.Duration(1)
    )
    assert "a::nothing" in refused


def test_physics_properties_are_got_set_and_refused(gazebo: Gazebo) -> None:
    got = gazebo.ask("get_physics_properties")
    assert got.time_step == pytest.approx(DT)
    assert got.gravity.z == pytest.approx(-9.8)
    assert got.pause
    assert got.ode_config.sor_pgs_iters == 1000
    assert got.ode_config.sor_pgs_w == pytest.approx(1.3)
    request = SetPhysicsPropertiesRequest(0.005, 400.0, Vector3(0.0, 0.0, -1.6), got.ode_config)
    fields = {slot: getattr(request, slot) for slot in request.__slots__}
    gazebo.ask("set_physics_properties", **fields)
    changed = gazebo.ask("get_physics_properties")
    assert (changed.time_step, changed.gravity.z) == pytest.approx((0.005, -1.6))
    assert changed.max_update_rate == pytest.approx(400.0)
    gazebo.spawn("a", box_sdf("a"), pose(z=50.0))
    assert gazebo.step(200) == pytest.approx(1.0)
    assert 50.0 - gazebo.position("a")[2] == pytest.approx(0.8, rel=0.01)
    for name, value, word in (
        ("time_step", -0.01, "-0.01"),
        ("time_step", math.nan, "nan"),
        ("max_update_rate", -5.0, "max_update_rate"),
        ("gravity", Vector3(0.0, math.inf, 0.0), "inf"),
    ):
        assert word in gazebo.refusal("set_physics_properties", **{**fields, name: value})
    still = gazebo.ask("get_physics_properties")
    assert (still.time_step, still.gravity.z) == pytest.approx((0.005, -1.6))
    assert gazebo.step(1) == pytest.approx(1.005)


def test_states_that_are_not_finite_are_refused(gazebo: Gazebo) -> None:
    gazebo.spawn("a", box_sdf("a"), pose(z=5.0))
    bad = ModelState("a", pose(math.nan, 0.0, 0.0), Twist(), "")
    assert "a" in gazebo.refusal("set_model_state", model_state=bad)
    gazebo.step(1)
    assert gazebo.position("a")[2] == pytest.approx(5.0, abs=0.01)


def test_fifty_models_are_spawned_in_parallel(start_gazebo: Callable[..., Gazebo]) -> None:
    gazebo = start_gazebo(paused=False, real_time_factor=1.0)
    names = [f"UAV{index}" for index in range(1, 51)]

    def spawn(index: int) -> None:
        gazebo.spawn(names[index], at=pose(2.0 * (index % 10), 2.0 * (index // 10), 0.1))

    with ThreadPoolExecutor(16) as pool:
        list(pool.map(spawn, range(len(names))))
    assert set(names) <= set(gazebo.ask("get_world_properties").model_names)
    published = {topic for topic, _ in rospy.get_published_topics("/")}
    assert {f"/{name}/odometry_sensor1/odometry" for name in names} <= published


@pytest.mark.parametrize("paused", [True, False])
def test_the_hovering_example_flies_whether_the_world_was_paused_or_not(
    ros: Ros, start_gazebo: Callable[..., Gazebo], paused: bool
) -> None:
    ros.set_param("/use_sim_time", True)
    gazebo = start_gazebo(paused=paused, real_time_factor=0.0 if paused else 10.0)
    gazebo.spawn("firefly")
    gazebo.controller("firefly")
    example = ros.launch(["rosrun", "rotors_gazebo", "hovering_example", "__ns:=/firefly"])
    eventually(lambda: gazebo.position("firefly")[2] > 0.9, "take-off to 1 m")
    assert not gazebo.ask("get_physics_properties").pause
    assert example.wait() == 0
    eventually(
        lambda: gazebo.position("firefly") == pytest.approx((0.0, 0.0, 1.04), abs=0.02),
        "hovering 4 cm above the set-point, as the tuning has it",
    )


def test_spawn_model_waits_in_wall_time_while_the_clock_stands(ros: Ros, gazebo: Gazebo) -> None:
    ros.set_param("/use_sim_time", True)
    ros.set_param("/UAV1/robot_description", vehicle_urdf("UAV1"))
    arguments = ["-urdf", "-param", "robot_description", "-model", "UAV1"]
    arguments += ["-x", "1", "-y", "2", "-z", "0.3", "-Y", "1.5"]
    output = ros.call("rosrun", "gazebo_ros", "spawn_model", *arguments, "__ns:=/UAV1")
    assert "Successfully spawned" in output
    assert gazebo.position("UAV1") == pytest.approx((1.0, 2.0, 0.3), abs=1e-6)
    again = ros.launch(["rosrun", "gazebo_ros", "spawn_model", *arguments, "__ns:=/UAV1"])
    assert again.wait() == 1
    assert "already exist" in again.log
    assert gazebo.time() == 0.0


def test_services_are_answered_while_a_long_step_runs(gazebo: Gazebo) -> None:
    gazebo.spawn("a", box_sdf("a"), pose(z=1e4))
    result: list[float] = []
    stepper = threading.Thread(target=lambda: result.append(gazebo.step(400_000)))
    stepper.start()
    seen = set()
    while stepper.is_alive():
        seen.add(gazebo.time())
    stepper.join()
    assert result == [pytest.approx(4000.0)]
    assert len(seen) > 3


def test_services_that_change_nothing_leave_the_state_hash_alone(
    ros: Ros, start_gazebo: Callable[..., Gazebo], tmp_path: object
) -> None:
    hashes = []
    for ask in (False, True):
        folder = ros.folder / f"asked-{ask}"
        folder.mkdir()
        gazebo = start_gazebo(out_dir=str(folder))
        gazebo.spawn("a", box_sdf("a"), pose(z=0.5, yaw_rad=0.3))
        for _ in range(20):
            gazebo.step(5)
            if ask:
                gazebo.ask("get_model_state", model_name="a")
                gazebo.ask("get_physics_properties")
                gazebo.ask("pause_physics")
        hashes.append(gazebo.finish()["state_hash"])
    assert hashes[0] == hashes[1]


THRUSTER = """<sdf version="1.6"><model name="rov"><link name="base_link"/>
<plugin name="thruster" filename="libuuv_thruster_ros_plugin.so">
  <linkName>base_link</linkName><thrusterID>0</thrusterID><propeller_efficiency>0.8</propeller_efficiency>
  <dynamics><type>ZeroOrder</type></dynamics>
  <conversion><type>Basic</type><rotorConstant>0.02</rotorConstant></conversion>
</plugin></model></sdf>"""


def test_a_thruster_has_the_services_of_uuv_simulator(ros: Ros, gazebo: Gazebo) -> None:
    gazebo.spawn("rov", THRUSTER)

    def ask(name: str, kind: type, *values: object) -> Any:
        return rospy.ServiceProxy(f"/rov/thrusters/0/{name}", kind)(*values)

    assert ask("get_thruster_state", GetThrusterState).is_on
    assert ask("get_dynamic_state_efficiency", GetThrusterEfficiency).efficiency == 0.8
    curve = ask("get_thruster_conversion_fcn", GetThrusterConversionFcn).fcn
    assert (curve.function_name, curve.tags, curve.data) == ("Basic", ["rotor_constant"], (0.02,))
    for wrong in (-0.1, 1.1, math.nan):
        assert not ask("set_thrust_force_efficiency", SetThrusterEfficiency, wrong).success
    assert ask("set_thrust_force_efficiency", SetThrusterEfficiency, 0.5).success
    assert ask("set_thruster_state", SetThrusterState, False).success
    assert ask("get_thrust_force_efficiency", GetThrusterEfficiency).efficiency == 0.5
    with recorder("/rov/thrusters/0/is_on", Bool) as is_on:
        is_on.connected()
        gazebo.step(2)
        assert not is_on.received()[0].data
    assert not ask("get_thruster_state", GetThrusterState).is_on
    assert ask("get_thrust_force_efficiency", GetThrusterEfficiency).efficiency == 0.5
    gazebo.ask("reset_simulation")
    gazebo.step(2)
    assert ask("get_thruster_state", GetThrusterState).is_on, "as the file has it"


def test_every_service_has_upstreams_name_and_type(ros: Ros, gazebo: Gazebo) -> None:
    listed = set(ros.call("rosservice", "list").split())
    for name, kind in {
        "pause_physics": "std_srvs/Empty",
        "reset_simulation": "std_srvs/Empty",
        "spawn_urdf_model": "gazebo_msgs/SpawnModel",
        "get_model_state": "gazebo_msgs/GetModelState",
        "set_physics_properties": "gazebo_msgs/SetPhysicsProperties",
    }.items():
        assert f"/gazebo/{name}" in listed
        assert ros.call("rosservice", "type", f"/gazebo/{name}").strip() == kind
    rospy.ServiceProxy("/gazebo/unpause_physics", Empty)()
    gazebo.until(0.2)
    output = ros.call("rosservice", "call", "/gazebo/get_model_state", "{model_name: ground_plane}")
    assert "success: True" in output
    assert package("gazebo_ros").is_dir()
