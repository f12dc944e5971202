# SPDX-FileCopyrightText: 2026 The Trident authors
# SPDX-License-Identifier: Apache-2.0
from __future__ import annotations

import os
import shutil
import subprocess
import xml.etree.ElementTree as ElementTree
from pathlib import Path
from typing import Any

import numpy as np
import pytest
import yaml
from conftest import REPO
from hypothesis import given
from hypothesis import strategies as st
from trident_fleet.core.choreography import perform
from trident_fleet.core.choreography_file import parse_words
from trident_fleet.core.config import PlanConfig
from trident_fleet.core.errors import FormationError
from trident_fleet.core.files.formation_file import FormationSource, read_formation
from trident_fleet.core.fleet_launch import NAMESPACE_TOKEN, Fleet, fleet_launch, spawn_grid
from trident_fleet.core.patterns import KINDS, Pattern, places
from trident_fleet.core.separation import min_separation
from trident_fleet.core.transit import transit_points

rospkg = pytest.importorskip("rospkg", reason="rospkg is not installed")

from trident_fleet.cli import make_launch  # noqa: E402

TEMPLATE = (REPO / "launch" / "multi_uav_simulation.launch").read_text("utf-8")


def fleet(count: int, **changes: Any) -> Fleet:
    spawn = places(Pattern("grid", 1.6), count) + np.array([0.0, 0.0, 0.1])
    good = {
        "spawn": spawn,
        "formation_file": "$(dirname)/a & b.txt",
        "vehicles_in_file": count,
        "layout": "",
        "mav_name": "hummingbird",
        "command": "./trident formation-launch --uavs 9",
    }
    return Fleet(**(good | changes))


def defaults(root: ElementTree.Element) -> dict[str, str]:
    return {arg.get("name", ""): arg.get("default", "") for arg in root.findall("arg")}


def vehicles(root: ElementTree.Element) -> list[ElementTree.Element]:
    return [i for i in root.findall("include") if i.get("file", "").endswith("robot/uav.launch")]


def test_a_fleet_has_the_arguments_of_six_and_its_own_defaults() -> None:
    root = ElementTree.fromstring(fleet_launch(TEMPLATE, fleet(9)))
    expected = defaults(ElementTree.fromstring(TEMPLATE)) | {
        "formation_file": "$(dirname)/a & b.txt",
        "vehicles_in_file": "9",
        "uavs": "9",
        "mav_name": "hummingbird",
    }
    assert defaults(root) == expected
    docs = {arg.get("name"): arg.get("doc") for arg in root.findall("arg")}
    assert docs["uavs"] == (
        "how many fly, 1 to 9; the file was made by ./trident formation-launch --uavs 9"
    )


def test_every_vehicle_has_its_namespace_and_its_place() -> None:
    nine = fleet(9)
    root = ElementTree.fromstring(fleet_launch(TEMPLATE, nine))
    assert "$(dirname)/robot" not in fleet_launch(TEMPLATE, nine)
    names = [include.find("arg[@name='namespace']") for include in vehicles(root)]
    assert [name.get("value") for name in names if name is not None] == [
        f"UAV{number}" for number in range(1, 10)
    ]
    conditions = [include.get("if") for include in vehicles(root)]
    assert conditions == [None, *(f"$(eval int(uavs) >= {n})" for n in range(2, 10))]
    spawner = root.find("node[@name='spawn_fleet']")
    assert spawner is not None
    positions = yaml.safe_load(spawner.findtext("rosparam", ""))["positions"]
    assert list(positions) == [f"UAV{number}" for number in range(1, 10)]
    np.testing.assert_allclose(list(positions.values()), nine.spawn, atol=1e-3)
    sources = root.find("param[@name='/gazebo/wait_for_sources']")
    assert sources is not None
    assert sources.get("value") == "1", "one node feeds all"


@pytest.mark.parametrize(
    ("template", "count", "what"),
    [
        (TEMPLATE, 101, "uavs: 101; legal: 1 to 100"),
        (TEMPLATE.replace("End of the vehicles", "End"), 9, "launch template: no .* End of the v"),
        (TEMPLATE.replace('"uavs" default', '"number" default'), 9, "no argument uavs with a def"),
        (TEMPLATE.replace("wait_for_sources", "wait"), 9, "0 times .*wait_for_sources.*; legal: o"),
    ],
)
def test_what_cannot_be_made_is_refused(template: str, count: int, what: str) -> None:
    with pytest.raises(FormationError, match=what):
        fleet_launch(template, fleet(count))


@given(count=st.integers(1, 50), kind=st.sampled_from(KINDS), x=st.floats(-5.0, 5.0))
def test_take_off_from_the_grid_crosses_nobodys_path(count: int, kind: str, x: float) -> None:
    first_row = places(Pattern(kind, 1.5), count) + np.array([x, 0.0, 1.2])
    spawn = spawn_grid(first_row, 1.6)
    assert (spawn[:, 2] == 0.1).all()
    points = transit_points(spawn, first_row, PlanConfig())
    assert len(points) == 3, "a climb and a straight path, without layers"
    assert min_separation(points) >= 1.0


@pytest.fixture
def sourced(monkeypatch: pytest.MonkeyPatch) -> None:
    """This clone's packages, whatever else is sourced."""
    path = os.environ.get("ROS_PACKAGE_PATH", "")
    monkeypatch.setenv("ROS_PACKAGE_PATH", os.pathsep.join([str(REPO / "src"), path]))
    try:
        rospkg.RosPack().get_path("trident_bringup")
    except rospkg.ResourceNotFound:
        pytest.skip("trident_bringup is not sourced")


@pytest.mark.usefixtures("sourced")
def test_without_a_formation_one_is_made(
    tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    out = tmp_path / "f.launch"
    assert make_launch.main(["--uavs", "11", "--out", str(out)]) == 0
    assert f"./trident run {out}" in capsys.readouterr().out
    root = ElementTree.fromstring(out.read_text("utf-8"))
    assert defaults(root)["formation_file"] == "$(dirname)/f.txt"
    rows = read_formation(FormationSource(str(tmp_path / "f.txt"), vehicles_in_file=11))
    assert rows.shape[1] == 11
    assert min_separation(rows) >= 1.0
    assert len(vehicles(root)) == 11


@pytest.mark.usefixtures("sourced")
@pytest.mark.parametrize("suffix", ["txt", "mat"])
def test_a_given_formation_is_checked_and_named(tmp_path: Path, suffix: str) -> None:
    from trident_fleet.core.files.position_file import write_positions

    (tmp_path / "sub").mkdir()
    file, out = tmp_path / f"given.{suffix}", tmp_path / "sub" / "f.launch"
    write_positions(file, perform(parse_words(["line", "grid"], 8, 1.5)).rows, [])
    arguments = ["--formation", str(file), "--vehicles-in-file", "8", "--out", str(out)]
    assert make_launch.main(["--uavs", "7", *arguments]) == 0
    values = defaults(ElementTree.fromstring(out.read_text("utf-8")))
    assert values["formation_file"] == str(file), "not below the launch file: absolute"
    assert (values["uavs"], values["vehicles_in_file"]) == ("7", "8")


@pytest.mark.usefixtures("sourced")
@pytest.mark.parametrize(
    ("words", "what"),
    [
        (["--uavs", "0"], "--uavs: 0; legal: 1 to 100"),
        (["--uavs", "7", "--formation", "/nowhere.txt"], "/nowhere.txt: No such file"),
        (["--uavs", "7", "--out", "/nowhere/f.launch"], "/nowhere/f.txt: No such file"),
        (["--uavs", "7", "--spacing", "0"], "spacing_m: 0.0; legal: over 0"),
    ],
)
def test_the_command_line_refuses_in_one_line(
    tmp_path: Path,
    monkeypatch: pytest.MonkeyPatch,
    capsys: pytest.CaptureFixture[str],
    words: list[str],
    what: str,
) -> None:
    monkeypatch.chdir(tmp_path)
    assert make_launch.main(words) == 1
    error = capsys.readouterr().err
    assert what in error
    assert error.count("\n") == 1
    assert not list(tmp_path.glob("*.launch"))


@pytest.mark.usefixtures("sourced")
@pytest.mark.skipif(shutil.which("roslaunch") is None, reason="roslaunch is not installed")
def test_roslaunch_reads_it(tmp_path: Path) -> None:
    out = tmp_path / "f.launch"
    assert make_launch.main(["--uavs", "8", "--out", str(out)]) == 0

    def roslaunch(*words: str) -> str:
        command = ["roslaunch", *words, str(out), "uavs:=3", "gui:=false"]
        return subprocess.run(command, capture_output=True, text=True, check=True).stdout

    assert set(roslaunch("--nodes").split()) == {
        "/gazebo",
        "/formation",
        "/spawn_fleet",
        *(f"/UAV{number}/lee_position_controller_node" for number in (1, 2, 3)),
    }
    params = yaml.safe_load(roslaunch("--dump-params"))
    assert f"{NAMESPACE_TOKEN}/base_link" in params["/spawn_fleet/robot_description"]
    assert params["/gazebo/wait_for"] == 3
    assert params["/formation/formation_file"] == str(tmp_path / "f.txt")
    assert params["/formation/vehicles_in_file"] == 8
