# SPDX-FileCopyrightText: 2026 The Trident authors
# SPDX-License-Identifier: Apache-2.0
"""What is wrong is named, once and with its place; the server and the other models continue."""

from __future__ import annotations

import math
import re
from collections.abc import Callable
from pathlib import Path

import pytest
import rospy
from diagnostic_msgs.msg import DiagnosticArray
from harness import REPO, Gazebo, Ros, box_sdf, eventually, logged_problems, package, pose, recorder
from std_msgs.msg import Float32

WORLD = """<?xml version="1.0"?>
<sdf version="1.6">
  <world name="w">
{}
  </world>
</sdf>
"""


def urdf(inertia: str, mass: float = 1.0) -> str:
    return f"""<?xml version="1.0"?>
<robot name="probe">
  <link name="base_link">
    <inertial>
      <mass value="{mass}"/>
      {inertia}
    </inertial>
    <collision><geometry><box size="0.1 0.1 0.1"/></geometry></collision>
  </link>
</robot>
"""


def inertia(ixx: float, iyy: float, izz: float, ixy: float = 0.0) -> str:
    return f'<inertia ixx="{ixx}" iyy="{iyy}" izz="{izz}" ixy="{ixy}" ixz="0" iyz="0"/>'


def refused_start(ros: Ros, world: str | Path, **options: object) -> str:
    """A server that must end by itself with exit code 1; its one error."""
    gazebo = Gazebo(ros, world, **options)  # type: ignore[arg-type]
    assert gazebo.process.wait() == 1, gazebo.log
    reported = [line for line in logged_problems(gazebo.log) if "FATAL" in line or "ERROR" in line]
    assert len(reported) == 1, gazebo.log
    return gazebo.log


def refused_spawn(gazebo: Gazebo, name: str, xml: str) -> str:
    """A model that must not come in, in a world that continues; the status message."""
    kind = "spawn_urdf_model" if "<robot" in xml else "spawn_sdf_model"
    before = gazebo.time()
    status = gazebo.refusal(
        kind, model_name=name, model_xml=xml, robot_namespace="", initial_pose=pose(z=1.0)
    )
    assert status.startswith("SpawnModel: Failure - ")
    assert "\n" not in status.strip(), status
    assert name not in gazebo.ask("get_world_properties").model_names
    assert gazebo.step(1) > before
    return status


def test_a_world_that_is_not_there(ros: Ros) -> None:
    assert "/nowhere/at_all.world" in refused_start(ros, "/nowhere/at_all.world")


def test_a_world_with_a_syntax_error_is_named_with_its_line(ros: Ros, tmp_path: Path) -> None:
    path = tmp_path / "broken.world"
    path.write_text(WORLD.format('    <model name="a">\n      <link name="l">\n    </model>'))
    log = refused_start(ros, path)
    assert re.search(r"broken\.world:[5-8]\b", log), log


def test_a_world_with_two_models_of_one_name(ros: Ros, tmp_path: Path) -> None:
    path = tmp_path / "twins.world"
    model = re.search(r"<model.*</model>", box_sdf("twin"), re.DOTALL)
    assert model
    path.write_text(WORLD.format(model[0] + "\n" + model[0]))
    log = refused_start(ros, path)
    assert "twins.world" in log
    assert "twin" in log


@pytest.mark.parametrize(
    ("name", "value", "words"),
    [
        ("timing", "fast", ["timing", "fast", "rotors", "direct"]),
        ("lockstep_policy", "hope", ["lockstep_policy", "hope", "free_run", "wait", "pause"]),
        ("real_time_factor", -2.0, ["real_time_factor", "-2", "0"]),
        ("wait_for", "six", ["wait_for", "six", "number"]),
        ("seed", math.nan, ["seed", "nan"]),
    ],
)
def test_parameters_out_of_range_name_what_is_legal(
    ros: Ros, name: str, value: object, words: list[str]
) -> None:
    log = refused_start(ros, "basic", **{name: value})
    assert all(word in log for word in words), log


def test_an_unknown_option_is_named(ros: Ros) -> None:
    log = refused_start(ros, "basic", args=["--warp"])
    assert "--warp" in log
    assert "--seed" in log, "the known ones are listed"


def test_a_parameter_that_nobody_knows_is_a_warning(ros: Ros) -> None:
    gazebo = Gazebo(ros, "basic", real_time_facter=3.0).ready()
    assert gazebo.step(1) == pytest.approx(0.01)
    reported = [line for line in logged_problems(gazebo.log) if "real_time_facter" in line]
    assert len(reported) == 1, gazebo.log


@pytest.mark.parametrize(
    ("case", "text"),
    [
        ("zero", inertia(0.0, 0.0, 0.0)),
        ("negative", inertia(0.1, -0.1, 0.1)),
        ("not positive definite", inertia(0.1, 0.1, 0.1, ixy=0.5)),
        ("not finite", inertia(math.nan, 0.1, 0.1)),
    ],
    ids=lambda value: value if "<" not in value else "",
)
def test_an_inertia_that_cannot_be_is_named_with_link_and_line(
    gazebo: Gazebo, case: str, text: str
) -> None:
    gazebo.spawn("crate", box_sdf("crate"), pose(z=5.0))
    status = refused_spawn(gazebo, "probe", urdf(text))
    assert "base_link" in status, case
    assert "inertia" in status
    assert re.search(r":[456]\b", status), f"the line of the inertial: {status}"
    assert gazebo.position("crate")[2] < 5.0


def test_a_mass_of_zero_is_refused(gazebo: Gazebo) -> None:
    assert "mass" in refused_spawn(gazebo, "probe", urdf(inertia(0.1, 0.1, 0.1), mass=0.0))


def test_a_link_without_inertial_is_a_warning_only(gazebo: Gazebo) -> None:
    text = urdf(inertia(0.1, 0.1, 0.1)).replace(
        "</robot>",
        '<link name="tip"/><joint name="j" type="fixed"><parent link="base_link"/>'
        '<child link="tip"/></joint></robot>',
    )
    gazebo.spawn("probe", text, pose(z=1.0))
    gazebo.step(1)


def test_xml_that_is_not_xml_is_refused_with_its_line(gazebo: Gazebo) -> None:
    broken = box_sdf("a").replace("</link>", "")
    status = refused_spawn(gazebo, "a", broken)
    assert re.search(r":\d+|line \d+", status), status
    assert "<" not in refused_spawn(gazebo, "b", "this is no model").split("Failure")[0]


def test_an_unknown_plugin_is_one_warning_and_the_model_flies(gazebo: Gazebo) -> None:
    plugin = '<plugin name="magic_plugin" filename="libmagic_carpet.so"/>'
    with recorder("/diagnostics", DiagnosticArray) as diagnostics:
        gazebo.spawn("crate", box_sdf("crate", extra=plugin), pose(z=5.0))
        gazebo.step(10)
        eventually(
            lambda: any(
                "libmagic_carpet.so" in status.message
                for message in diagnostics.messages
                for status in message.status
            ),
            "the plugin in /diagnostics",
        )
    reported = [line for line in logged_problems(gazebo.log) if "libmagic_carpet.so" in line]
    assert len(reported) == 1, gazebo.log
    assert "crate" in reported[0]
    assert "magic_plugin" in reported[0]
    assert gazebo.position("crate")[2] < 5.0


def test_a_missing_picture_is_a_warning_and_a_missing_hull_a_refusal(gazebo: Gazebo) -> None:
    mesh = "<geometry><mesh><uri>model://no_such_model/part.dae</uri></mesh></geometry>"
    whole = box_sdf("a")
    box = re.search(r"<geometry>.*?</geometry>", whole)
    assert box
    visual = f'<visual name="visual">{box[0]}</visual>'
    gazebo.spawn("a", whole.replace(visual, f'<visual name="visual">{mesh}</visual>'), pose(z=2.0))
    reported = [line for line in logged_problems(gazebo.log) if "part.dae" in line]
    assert len(reported) == 1, gazebo.log
    hull = whole.replace(
        f'<collision name="collision">{box[0]}', f'<collision name="collision">{mesh}'
    )
    assert "part.dae" in refused_spawn(gazebo, "b", hull)


def test_numbers_that_are_none_are_refused(gazebo: Gazebo) -> None:
    status = gazebo.refusal(
        "spawn_sdf_model",
        model_name="a",
        model_xml=box_sdf("a"),
        robot_namespace="",
        initial_pose=pose(math.nan, 0.0, 1.0),
    )
    assert "a" in status
    assert gazebo.step(1) == pytest.approx(0.01)


def test_a_vehicle_lost_in_space_does_not_take_the_world_with_it(
    start_gazebo: Callable[..., Gazebo],
) -> None:
    gazebo = start_gazebo()
    gazebo.spawn("crate", box_sdf("crate"), pose(0.0, 0.0, 0.1))
    gazebo.spawn("rocket", box_sdf("rocket", mass_kg=0.01), pose(5.0, 0.0, 5.0))
    from geometry_msgs.msg import Point, Vector3, Wrench
    from rospy import Duration, Time

    gazebo.ask(
        "apply_body_wrench",
        body_name="rocket::link",
        reference_frame="rocket::link",
        reference_point=Point(0.05, 0.0, 0.0),
        wrench=Wrench(Vector3(0.0, 1e6, 1e6), Vector3(1e6, 0.0, 0.0)),
        start_time=Time(0),
        duration=Duration(-1),
    )
    gazebo.step(3000)
    assert gazebo.position("crate") == pytest.approx((0.0, 0.0, 0.1), abs=0.01)
    assert gazebo.process.running


BOAT = """<robot name="boat">
  <link name="base_link">
    <inertial>
      <origin xyz="0 0 0.04"/>
      <mass value="12"/>
      <inertia ixx="0.8" iyy="1.1" izz="1.6" ixy="0" ixz="0" iyz="0"/>
    </inertial>
  </link>
  <gazebo>
    <plugin name="vessel" filename="libtrident_vessel.so">
      <vessel>{}</vessel>
      <bodyName>base_link</bodyName>
    </plugin>
  </gazebo>
</robot>
"""


@pytest.mark.parametrize(
    ("elements", "words"),
    [
        ("<waves><significant_height>-0.4</significant_height></waves>", "significant_height"),
        ("<waves><spectrum>tsunami</spectrum></waves>", "pierson_moskowitz"),
        ("<bathymetry><kind>file</kind><file>nowhere.asc</file></bathymetry>", "nowhere.asc"),
        ("<bathymetry><kind>terrain</kind></bathymetry>", "heightmap"),
    ],
    ids=["negative height", "unknown spectrum", "no bathymetry file", "no terrain"],
)
def test_a_sea_that_cannot_be_is_one_error(
    ros: Ros, tmp_path: Path, elements: str, words: str
) -> None:
    path = tmp_path / "sea.world"
    sea = f'<plugin name="sea" filename="libtrident_sea.so">{elements}</plugin>'
    path.write_text(WORLD.format(sea))
    assert words in refused_start(ros, path)


def test_a_boat_that_cannot_be_and_thrusts_that_cannot_be(
    start_gazebo: Callable[..., Gazebo], tmp_path: Path
) -> None:
    world = tmp_path / "sea.world"
    world.write_text(WORLD.format('<plugin name="sea" filename="libtrident_sea.so"/>'))
    gazebo = start_gazebo(world)
    shipped = (REPO / "config" / "vessels" / "small_catamaran.yaml").read_text("utf-8")
    heavy = re.sub(r"added_mass: \[[^\]]*\]", "added_mass: [-40, 0, 0, 0, 0, 0]", shipped)
    assert heavy != shipped
    (tmp_path / "heavy.yaml").write_text(heavy, encoding="utf-8")
    status = refused_spawn(gazebo, "a", BOAT.format(tmp_path / "heavy.yaml"))
    assert "positive definite" in status
    assert "nowhere.yaml" in refused_spawn(gazebo, "b", BOAT.format(tmp_path / "nowhere.yaml"))
    (tmp_path / "boat.yaml").write_text(shipped, encoding="utf-8")
    gazebo.spawn("boat", BOAT.format(tmp_path / "boat.yaml"))
    thrust = rospy.Publisher("/boat/thrusters/left_thrust_cmd", Float32, queue_size=1)
    eventually(lambda: thrust.get_num_connections() == 1, "the thruster")
    for value, words in ((math.nan, "nan is refused"), (1e4, "10000 is cut to the nearest")):
        thrust.publish(value)
        eventually(lambda: gazebo.step(1) > 0.0 and words in gazebo.log, words)  # noqa: B023
        (reported,) = [line for line in logged_problems(gazebo.log) if words in line]
        assert "left_thrust_cmd" in reported
        assert "legal is [" in reported
    thrust.unregister()


def test_the_shipped_worlds_load_without_a_word(ros: Ros) -> None:
    for world in sorted((package("rotors_gazebo") / "worlds").glob("*.world")):
        gazebo = Gazebo(ros, world).ready()
        gazebo.step(5)
        assert not logged_problems(gazebo.log), f"{world.name}: {gazebo.log}"
        ros.clean()
