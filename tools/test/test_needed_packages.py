# SPDX-FileCopyrightText: 2026 The Trident authors
# SPDX-License-Identifier: Apache-2.0
from pathlib import Path
from typing import Any

import pytest
from trident_tool import cli, needed_packages
from trident_tool.needed_packages import Package, read_packages, targets_of
from trident_tool.workspace import Workspace

WORKSPACE = Workspace.of_this_file()
PACKAGES = read_packages(WORKSPACE)


def _needed(*nodes: tuple[str, str], found: tuple[str, ...] = ()) -> set[str] | None:
    facts: dict[str, Any] = {
        "nodes": [{"package": package, "args": args} for package, args in nodes],
        "found": list(found),
    }
    return needed_packages.needed_packages(facts, PACKAGES, lambda name: name == "rviz")


def test_the_simulator_comes_with_its_plugins_and_without_slam() -> None:
    needed = _needed(("gazebo_ros", "worlds/a.world"), ("rviz", ""))
    assert needed is not None
    assert {"gazebo_ros", "trident_sim_ros", "trident_base"} <= needed
    others = {"trident_slam", "trident_estimation", "slam_toolbox", "trident_sim_py"}
    assert not (others | {"trident_bridges", "mavros_msgs"}) & needed


def test_the_package_of_a_node_comes_with_all_that_it_runs_with() -> None:
    needed = _needed(("slam_toolbox", ""))
    assert needed is not None
    assert {"slam_toolbox", "slam_toolbox_msgs", "trident_slam", "trident_ros"} <= needed
    assert "trident_sim" not in needed


def test_a_package_that_is_only_looked_into_brings_nothing_else() -> None:
    needed = _needed(("teleop_twist_keyboard", ""), found=("trident_bringup", "unheard_of"))
    assert needed is not None
    assert "trident_bringup" in needed
    assert "trident_eval" not in needed


def test_a_nodelet_needs_its_package() -> None:
    needed = _needed(("rviz", "load trident_control/LeePositionControllerNodelet manager"))
    assert needed is not None
    assert "trident_control" in needed


def test_the_tool_needs_what_checks_and_judges_a_run() -> None:
    needed = _needed()
    assert needed is not None
    assert {"trident_fleet", "trident_msgs"} <= needed


@pytest.mark.parametrize(
    "package", ["trident_benchmarks", "trident_testing", "trident_viewer", "of_an_overlay"]
)
def test_whatever_may_start_anything_needs_everything(package: str) -> None:
    assert _needed((package, "")) is None


def test_targets_are_the_folders_of_packages() -> None:
    targets = targets_of({"gazebo_ros", "trident_base"}, PACKAGES)
    assert targets == ["src/compat/gazebo_ros/all", "src/trident_base/all"]


def test_of_a_package_that_is_not_needed_the_simulator_brings_its_plugins() -> None:
    targets = targets_of({"trident_sim", "trident_control"}, PACKAGES)
    assert targets == [
        "src/trident_bridges/sim_plugin/all",
        "src/trident_control/all",
        "src/trident_sim/all",
    ]


def test_what_a_package_runs_with_and_is_compiled_against_are_distinguished(
    clone: Workspace,
) -> None:
    folder = clone.root / "src" / "a"
    folder.mkdir()
    (folder / "package.xml").write_text(
        "<package><name>a</name><depend>b</depend><exec_depend>c</exec_depend>"
        "<build_depend>d</build_depend><test_depend>e</test_depend></package>"
    )
    runs_with, builds_with = frozenset({"b", "c"}), frozenset({"b", "d"})
    assert read_packages(clone) == {"a": Package(Path("src/a"), runs_with, builds_with)}
    (folder / "sim_plugin").mkdir()
    (folder / "sim_plugin" / "CMakeLists.txt").touch()
    expected = Package(Path("src/a"), runs_with, builds_with, Path("src/a/sim_plugin"))
    assert read_packages(clone) == {"a": expected}


def test_run_builds_what_the_launch_file_needs(
    clone: Workspace, monkeypatch: pytest.MonkeyPatch
) -> None:
    built: list[list[str]] = []
    monkeypatch.setattr(Workspace, "of_this_file", staticmethod(lambda: clone))
    for name in ("provision", "make_configured"):
        monkeypatch.setattr(cli, name, lambda *_args: None)
    monkeypatch.setattr(cli, "is_built", lambda _workspace: False)
    monkeypatch.setattr(cli, "targets_of_launch", lambda *_args: ["src/a/all"])
    monkeypatch.setattr(cli, "build", lambda _workspace, _runner, targets: built.append(targets))
    monkeypatch.setattr(cli, "run_launch_file", lambda *_args: 0)
    assert cli.main(["run", "a.launch"]) == 0
    assert built == [["src/a/all"]]
