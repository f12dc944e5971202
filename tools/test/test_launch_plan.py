# SPDX-FileCopyrightText: 2026 The Trident authors
# SPDX-License-Identifier: Apache-2.0
import os
from pathlib import Path

import pytest
from trident_tool.launch.launch_plan import (
    LaunchNode,
    LaunchPlan,
    check_plan,
    check_real_time_factor,
    load_plan,
)
from trident_tool.workspace import TridentError

LAUNCH = """\
<launch>
  <arg name="fleet" default="2"/>
  <arg name="number" value="1"/>
  <param name="/gazebo/wait_for" type="int" value="$(arg fleet)" if="$(eval fleet &gt; 2)"/>
  <param name="robot_description" command="false"/>
  <group ns="a1">
    <node name="spawn" pkg="gazebo_ros" type="spawn_model"
          args="-urdf -param robot_description -model a$(arg number)  -x 0"/>
    <node name="pilot" pkg="rotors_control" type="lee_position_controller_node">
      <remap from="command/motor_speed" to="/other/motors"/>
    </node>
  </group>
  <node name="spawn_boat" ns="sea" pkg="gazebo_ros" type="spawn_model" args="-sdf -model=boat"
        respawn="true"/>
</launch>
"""


def _spawner(name: str, args: str) -> LaunchNode:
    return LaunchNode(f"/{name}", "/", "gazebo_ros", "spawn_model", tuple(args.split()))


def _plan(text: str, folder: Path, **args: str) -> LaunchPlan:
    path = folder / "a.launch"
    path.write_text(text, encoding="utf-8")
    return load_plan(path, args, {**os.environ, "PATH": "/usr/bin:/bin"})


def test_what_a_launch_file_spawns_is_known_after_substitution(tmp_path: Path) -> None:
    plan = _plan(LAUNCH, tmp_path)
    assert plan.models == ["a1", "boat"]
    assert plan.motor_topics == ["/other/motors"]
    assert plan.waits({}) == {
        "TRIDENT_WAIT_FOR_MODELS": "a1,boat",
        "TRIDENT_WAIT_FOR_CONTROLLERS": "/other/motors",
    }


def test_the_lowest_place_of_what_is_spawned_is_known_if_all_places_are() -> None:
    def lowest(*args: str) -> float | None:
        return LaunchPlan(tuple(_spawner("s", words) for words in args), {}).lowest_spawn_m

    assert lowest("-sdf -model a -z 0.5", "-urdf -model b -z 0.1") == 0.1
    assert lowest("-sdf -model a -z 0.5", "-urdf -model b") == 0.0
    assert lowest("-sdf -model a -z high") is None
    assert lowest() is None


def test_who_says_what_is_waited_for_is_obeyed(tmp_path: Path) -> None:
    assert _plan(LAUNCH, tmp_path, fleet="3").waits({}) == {}
    assert _plan(LAUNCH, tmp_path).waits({"TRIDENT_WAIT_FOR": "0"}) == {}
    assert LaunchPlan((), {}).waits({}) == {}


def test_topics_are_resolved_in_the_namespace_of_their_node() -> None:
    node = LaunchNode("/a/n", "/a/", "p", "t", remap=(("command/x", "y"),))
    assert node.resolve("command/x") == "/a/y"
    assert node.resolve("command/z") == "/a/command/z"


def test_a_process_is_found_by_the_name_that_roslaunch_gives_it(tmp_path: Path) -> None:
    plan = _plan(LAUNCH, tmp_path)
    node = plan.of_process("sea/spawn_boat-12")
    assert node is not None
    assert node.respawn
    assert plan.of_process("sea/spawn-12") is None


@pytest.mark.parametrize(
    ("text", "words"),
    [
        ('<launch><node name="a" pkg="p"/></launch>', "type"),
        ('<launch><param name="a" type="int" value="six"/></launch>', "six"),
        ('<launch><rosparam command="load" file="/no/such.yaml"/></launch>', "/no/such.yaml"),
        ('<launch><include file="$(dirname)/a.launch"/></launch>', "without end"),
        ('<launch><include file="$(find no_such_package)/a.launch"/></launch>', "no_such_package"),
    ],
)
def test_what_roslaunch_would_refuse_is_refused_in_one_line(
    tmp_path: Path, text: str, words: str
) -> None:
    with pytest.raises(TridentError, match=words) as refusal:
        _plan(text, tmp_path)
    assert str(refusal.value).startswith("a.launch: ")
    assert "\n" not in str(refusal.value)


@pytest.mark.parametrize("text", ["-1", "nan", "inf", "fast", "", "1e7", "1,5"])
def test_a_real_time_factor_that_is_none_is_refused(text: str) -> None:
    with pytest.raises(TridentError, match=r"real_time_factor is .*, must be a number in \[0, "):
        check_real_time_factor(text)


def test_real_time_factors(tmp_path: Path) -> None:
    for text in ("0", "1", "0.25", "1e6"):
        check_real_time_factor(text)


def test_more_vehicles_than_are_spawned_are_refused() -> None:
    plan = LaunchPlan((_spawner("s", "-model a"), _spawner("t", "-model b")), {})
    check_plan(LaunchPlan(plan.nodes, {"/gazebo/wait_for": 2}), {})
    with pytest.raises(TridentError, match="wait_for is 3, but the launch file spawns 2 models"):
        check_plan(LaunchPlan(plan.nodes, {"/gazebo/wait_for": 3}), {})
    unknown = LaunchNode("/mine", "/", "my_package", "spawns_more.py")
    check_plan(LaunchPlan((*plan.nodes, unknown), {"/gazebo/wait_for": 3}), {})


def test_a_node_that_spawns_a_fleet_counts_its_places() -> None:
    fleet = LaunchNode("/spawn_fleet", "/", "trident_fleet", "spawn_fleet.py")
    places = {f"/spawn_fleet/positions/UAV{n}": [0.0, 0.0, 0.1] for n in range(1, 8)}
    check_plan(LaunchPlan((fleet,), {**places, "/gazebo/wait_for": 7}), {})
    with pytest.raises(TridentError, match="spawns 7 models"):
        check_plan(LaunchPlan((fleet,), {**places, "/gazebo/wait_for": 8}), {})


def test_an_integer_that_no_master_takes_is_refused() -> None:
    with pytest.raises(TridentError, match="parameter /a/seed is 10000000000, must be in"):
        check_plan(LaunchPlan((), {"/a/seed": 10**10}), {})
