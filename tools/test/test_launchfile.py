# SPDX-FileCopyrightText: 2026 The Trident authors
# SPDX-License-Identifier: Apache-2.0
from pathlib import Path

import pytest
from trident_tool.launch.launchfile import (
    DeclaredArgs,
    LaunchRequest,
    check_args,
    declared_args,
    find_launch_file,
    parse_request,
)
from trident_tool.workspace import TridentError, Workspace

LAUNCH = """\
<launch>
  <arg name="uavs" default="6"/>
  <arg name="world"/>
  <arg name="mode" value="fixed"/>
  <arg name="either" default="a" if="$(arg x)"/>
  <arg name="either" value="b" unless="$(arg x)"/>
  <group>
    <arg name="inner" default="1"/>
    <include file="other.launch"><arg name="theirs" value="1"/></include>
  </group>
</launch>
"""


def _launch_file(clone: Workspace, name: str = "a.launch", text: str = LAUNCH) -> Path:
    path = clone.launch / name
    path.parent.mkdir(parents=True, exist_ok=True)
    path.write_text(text, encoding="utf-8")
    return path


def _find(clone: Workspace, file: str) -> Path:
    return find_launch_file(clone, LaunchRequest(file, None, {}), {})


def test_request_with_package_and_values_that_hold_separators() -> None:
    request = parse_request(["rotors_gazebo", "a.launch", "topic:=/a:=b", "empty:="])
    assert request == LaunchRequest("a.launch", "rotors_gazebo", {"topic": "/a:=b", "empty": ""})


@pytest.mark.parametrize(
    ("words", "message"),
    [
        (["x:=1"], "found nothing"),
        (["a", "b", "c"], "found a b c"),
        (["a.launch", ":=1"], "':=1': its name is empty"),
        (["a.launch", "x:=1", "x:=2"], "'x:=2': its name is given twice"),
    ],
)
def test_wrong_requests_are_refused(words: list[str], message: str) -> None:
    with pytest.raises(TridentError, match=message):
        parse_request(words)


def test_launch_files_are_found_at_the_top_below_and_by_path(
    clone: Workspace, tmp_path: Path
) -> None:
    top, deep = _launch_file(clone), _launch_file(clone, "sim/deep.launch")
    assert _find(clone, "a.launch") == top
    assert _find(clone, "deep.launch") == deep
    assert _find(clone, "sim/deep.launch") == deep
    assert _find(clone, str(top)) == top


def test_a_misspelt_launch_file_gets_a_suggestion(clone: Workspace) -> None:
    _launch_file(clone, "multi_uav_simulation.launch")
    with pytest.raises(TridentError, match=r"did you mean 'multi_uav_simulation\.launch'"):
        _find(clone, "multi_uav_simulaton.launch")


def test_two_files_of_one_name_are_ambiguous(clone: Workspace) -> None:
    _launch_file(clone, "sim/a.launch")
    _launch_file(clone, "demo/a.launch")
    with pytest.raises(TridentError, match="ambiguous"):
        _find(clone, "a.launch")


def test_declared_args_leave_out_those_of_includes(clone: Workspace) -> None:
    declared = declared_args(_launch_file(clone))
    assert declared == DeclaredArgs(
        frozenset({"uavs", "inner"}), frozenset({"world"}), frozenset({"mode", "either"})
    )


def test_malformed_xml_is_named_with_line(clone: Workspace) -> None:
    path = _launch_file(clone, text="<launch>\n  <arg name='a'>\n</launch>\n")
    with pytest.raises(TridentError, match=r"a\.launch:3:\d+: not well-formed XML"):
        declared_args(path)


@pytest.mark.parametrize(
    ("given", "message"),
    [
        ({"world": "w", "uav": "4"}, "no argument 'uav'; did you mean 'uavs'"),
        ({"world": "w", "zzz": "4"}, r"no argument 'zzz' \(it has: inner, uavs, world\)"),
        ({"world": "w", "mode": "x"}, "sets 'mode' itself"),
        ({"uavs": "4"}, "needs world:=…"),
    ],
)
def test_wrong_args_are_refused(clone: Workspace, given: dict[str, str], message: str) -> None:
    path = _launch_file(clone)
    with pytest.raises(TridentError, match=message):
        check_args(path, declared_args(path), given)


def test_right_args_pass(clone: Workspace) -> None:
    path = _launch_file(clone)
    check_args(path, declared_args(path), {"world": "w", "uavs": "4"})
