# SPDX-FileCopyrightText: 2026 The Trident authors
# SPDX-License-Identifier: Apache-2.0
"""The xacro command works from every place that a launch file or a user calls it from."""

from __future__ import annotations

import os
import subprocess
from pathlib import Path

import pytest

PACKAGE = Path(__file__).resolve().parents[1]
MODEL = """<robot name="r" xmlns:xacro="http://ros.org/wiki/xacro">
  <xacro:arg name="size" default="1"/>
  <link name="box_${2 * $(arg size)}"/>
  <!-- in $(find xacro) -->
  <xacro:property name="here" value="$(find xacro)"/>
  <link name="${here.split('/')[-1]}"/>
</robot>
"""


@pytest.fixture
def model(tmp_path: Path) -> Path:
    path = tmp_path / "model.xacro"
    path.write_text(MODEL)
    return path


def expand(command: list[str], **env: str) -> subprocess.CompletedProcess[str]:
    return subprocess.run(
        command, capture_output=True, text=True, check=False, env={**os.environ, **env}
    )


@pytest.mark.parametrize(
    "command",
    [
        [str(PACKAGE / "xacro")],
        [str(PACKAGE / "xacro.py")],
        ["/usr/bin/python3", str(PACKAGE / "xacro")],
        ["rosrun", "xacro", "xacro"],
        ["rosrun", "xacro", "xacro.py"],
    ],
    ids=lambda command: Path(command[0]).name + "-" + Path(command[-1]).name,
)
def test_command_expands_arguments_and_finds_packages(command: list[str], model: Path) -> None:
    result = expand([*command, str(model), "size:=3"])
    assert result.returncode == 0, result.stderr
    assert '<link name="box_6"/>' in result.stdout
    assert '<link name="xacro"/>' in result.stdout


def test_command_finds_the_library_without_an_environment(model: Path) -> None:
    text = model.read_text().replace('value="$(find xacro)"', 'value="a/xacro"')
    model.write_text(text)
    result = expand(["/usr/bin/env", "-i", str(PACKAGE / "xacro"), str(model)])
    assert result.returncode == 0, result.stderr
    assert '<link name="box_2"/>' in result.stdout


def test_python_imports_the_library_not_the_script() -> None:
    code = "import xacro; print(xacro.process_file.__module__, xacro.__file__)"
    result = expand(["/usr/bin/python3", "-c", code])
    assert result.returncode == 0, result.stderr
    assert result.stdout.startswith("xacro ")
    assert str(PACKAGE) not in result.stdout


def test_missing_file_is_one_clear_error(tmp_path: Path) -> None:
    result = expand([str(PACKAGE / "xacro"), str(tmp_path / "absent.xacro")])
    assert result.returncode != 0
    assert "absent.xacro" in result.stderr
    assert "Traceback" not in result.stderr


def test_undefined_argument_names_it(tmp_path: Path) -> None:
    path = tmp_path / "model.xacro"
    path.write_text('<robot name="$(arg missing_name)" xmlns:xacro="http://ros.org/wiki/xacro"/>\n')
    result = expand([str(PACKAGE / "xacro"), str(path)])
    assert result.returncode != 0
    assert "missing_name" in result.stderr


def write_package(folder: Path, name: str) -> Path:
    folder.mkdir(parents=True)
    (folder / "package.xml").write_text(f"<package><name>{name}</name></package>\n")
    return folder


def test_the_first_folder_of_the_path_that_has_a_package_wins(tmp_path: Path) -> None:
    path = tmp_path / "model.xacro"
    path.write_text(
        '<robot xmlns:xacro="http://ros.org/wiki/xacro" a="$(find pkg_a)" b="$(find pkg_b)"/>\n'
    )
    first = write_package(tmp_path / "overlay/some/folder", "pkg_a")
    write_package(tmp_path / "underlay/pkg_a", "pkg_a")
    second = write_package(tmp_path / "underlay/pkg_b", "pkg_b")
    folders = f"{tmp_path}/overlay:{tmp_path}/underlay"
    result = expand([str(PACKAGE / "xacro"), str(path)], ROS_PACKAGE_PATH=folders)
    assert result.returncode == 0, result.stderr
    assert f'a="{first}"' in result.stdout
    assert f'b="{second}"' in result.stdout


def test_a_package_that_is_not_there_is_named_with_the_folders_searched(tmp_path: Path) -> None:
    path = tmp_path / "model.xacro"
    path.write_text('<robot xmlns:xacro="http://ros.org/wiki/xacro" a="$(find no_such)"/>\n')
    result = expand([str(PACKAGE / "xacro"), str(path)], ROS_PACKAGE_PATH=str(tmp_path))
    assert result.returncode != 0
    assert "no_such" in result.stderr
    assert str(tmp_path) in result.stderr
    assert "Traceback" not in result.stderr


def test_eval_converts_arguments(tmp_path: Path) -> None:
    path = tmp_path / "model.xacro"
    path.write_text(
        '<robot xmlns:xacro="http://ros.org/wiki/xacro" a="$(eval size * 2)" '
        "b=\"$(eval name + '_y')\"/>\n"
    )
    result = expand([str(PACKAGE / "xacro"), str(path), "size:=3", "name:=x"])
    assert result.returncode == 0, result.stderr
    assert 'a="6"' in result.stdout
    assert 'b="x_y"' in result.stdout


def test_malformed_xml_is_one_clear_error(tmp_path: Path) -> None:
    path = tmp_path / "model.xacro"
    path.write_text("<robot><link></robot>\n")
    result = expand([str(PACKAGE / "xacro"), str(path)])
    assert result.returncode != 0
    assert str(path) in result.stderr
    assert "Traceback" not in result.stderr
