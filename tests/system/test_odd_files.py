# SPDX-FileCopyrightText: 2026 The Trident authors
# SPDX-License-Identifier: Apache-2.0
"""Worlds, models and packages that users bring load with what they have."""

from __future__ import annotations

import json
from collections.abc import Callable
from concurrent.futures import ThreadPoolExecutor
from pathlib import Path

from diagnostic_msgs.msg import DiagnosticArray
from harness import Gazebo, Ros, box_sdf, eventually, fresh_folder, logged_problems, pose, recorder

#: A mesh that is nowhere, a value that SDF does not know, and a name that is there twice.
ODD_WORLD = """<?xml version="1.0"?>
<sdf version="1.6"><world name="odd">
<include><uri>model://ground_plane</uri></include>
<scene><sky><clouds>
<speed>-4</speed></clouds></sky></scene>
<model name="plant"><static>1</static><link name="l">
<collision name="c"><geometry><mesh><uri>model://no_such_plant/a.dae</uri></mesh></geometry></collision>
<collision name="d"><geometry><mesh><uri>model://no_such_plant/a.dae</uri></mesh></geometry></collision>
</link></model>
<model name="ball"><link name="l"/></model>
<model name="ball"><link name="l"/></model>
</world></sdf>
"""


def of_level(messages: list[DiagnosticArray], name: str) -> dict[str, str]:
    """The values of the newest diagnostic of a name; none: nobody has reported it."""
    for message in reversed(messages):
        for status in message.status:
            if status.name == name:
                return {pair.key: pair.value for pair in status.values}
    return {}


def test_a_world_loads_with_what_it_has_and_counts_what_it_has_not(
    ros: Ros, start_gazebo: Callable[..., Gazebo], tmp_path: Path
) -> None:
    world = tmp_path / "odd.world"
    world.write_text(ODD_WORLD)
    out = fresh_folder(tmp_path / "out")
    gazebo = start_gazebo(world, strict=False, out_dir=out, end_time=0.05, paused=True)
    assert set(gazebo.ask("get_world_properties").model_names) >= {"ball", "ball_1", "plant"}
    reported = [line for line in logged_problems(gazebo.log) if "odd.world" in line]
    assert len(reported) == 3, gazebo.log
    assert any(
        "odd.world:5: <speed> is '-4', legal: double, at least 0" in line for line in reported
    )
    assert any(
        "odd.world:7:" in line and "searched:" in line and "used in 2 places" in line
        for line in reported
    )
    with recorder("/diagnostics", DiagnosticArray) as diagnostics:
        eventually(
            lambda: of_level(diagnostics.messages, "gazebo: odd elements").get("count") == "4",
            "four odd elements in /diagnostics",
        )
    gazebo.ask("unpause_physics")
    assert gazebo.process.wait() == 0
    assert json.loads((Path(out) / "run.json").read_text())["odd_elements"] == 4


def test_the_answer_of_a_spawn_says_what_was_left_out(start_gazebo: Callable[..., Gazebo]) -> None:
    gazebo = start_gazebo(strict=False)
    mesh = "<geometry><mesh><uri>model://no_such_model/part.dae</uri></mesh></geometry>"
    xml = box_sdf("a").replace("</link>", f'<collision name="d">{mesh}</collision></link>', 1)
    response = gazebo.ask(
        "spawn_sdf_model",
        model_name="a",
        model_xml=xml,
        robot_namespace="",
        initial_pose=pose(z=1.0),
        reference_frame="",
    )
    assert "odd elements left out or changed: 1" in response.status_message
    assert "part.dae" in response.status_message


def test_models_that_take_long_to_read_keep_no_other_service_waiting(gazebo: Gazebo) -> None:
    # More of them at once than the server has threads for services.
    plugin = '<plugin name="p" filename="libmagic_carpet.so">' + "<x/>" * 60_000 + "</plugin>"
    with ThreadPoolExecutor(6) as pool:
        spawns = [
            pool.submit(gazebo.spawn, f"m{i}", box_sdf(f"m{i}", extra=plugin), pose(x=3.0 * i))
            for i in range(6)
        ]
        answered = 0
        while not any(spawn.done() for spawn in spawns):
            gazebo.ask("get_world_properties")
            answered += 1
        for spawn in spawns:
            spawn.result()
    assert answered > 10, "the world was asked while models were read"


def test_a_model_that_includes_itself_is_refused_and_the_next_is_spawned(
    ros: Ros, tmp_path: Path
) -> None:
    folder = tmp_path / "models" / "snake"
    folder.mkdir(parents=True)
    (folder / "model.config").write_text(
        '<model><name>snake</name><sdf version="1.6">model.sdf</sdf></model>'
    )
    text = (
        '<sdf version="1.6"><model name="snake"><link name="l"/>\n'
        "<include><uri>model://snake</uri></include></model></sdf>"
    )
    (folder / "model.sdf").write_text(text)
    before = ros.env.get("GAZEBO_MODEL_PATH", "")
    ros.env["GAZEBO_MODEL_PATH"] = "${GAZEBO_MODEL_PATH}:" + str(folder.parent)
    try:
        gazebo = Gazebo(ros, "basic").ready()
    finally:
        ros.env["GAZEBO_MODEL_PATH"] = before
    assert not any("GAZEBO_MODEL_PATH" in line for line in logged_problems(gazebo.log))
    assert "ground_plane" in gazebo.ask("get_world_properties").model_names
    status = gazebo.refusal(
        "spawn_sdf_model",
        model_name="snake",
        model_xml=text,
        robot_namespace="",
        initial_pose=pose(z=1.0),
    )
    assert "snake/model.sdf:2" in status
    assert "leads back to itself" in status
    gazebo.spawn("a", box_sdf("a"), pose(z=1.0))
