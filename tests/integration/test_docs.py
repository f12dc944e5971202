# SPDX-FileCopyrightText: 2026 The Trident authors
# SPDX-License-Identifier: Apache-2.0
"""What the documentation shows works: the plugin compiles and flies, the world loads."""

from __future__ import annotations

import re
import subprocess
from pathlib import Path

import pytest

trident_sim = pytest.importorskip("trident_sim", reason="trident_sim is not built or sourced")

REPO = Path(__file__).resolve().parents[2]
EMPTY = "package://rotors_gazebo/worlds/empty.world"
BOX = """<sdf version='1.6'><model name='box'><link name='base_link'><gravity>0</gravity><inertial>
<mass>2</mass><inertia><ixx>0.1</ixx><iyy>0.1</iyy><izz>0.1</izz></inertia></inertial></link>
<plugin name='push' filename='libpush_plugin.so'><linkName>{link}</linkName><force>{force}</force>
</plugin></model></sdf>"""


def code_of(page: str, language: str) -> str:
    """The first code block of a language in a page of docs/."""
    text = (REPO / "docs" / page).read_text(encoding="utf-8")
    found = re.search(rf"```{language}\n(.*?)```", text, re.DOTALL)
    assert found, f"docs/{page} has no {language} code"
    return found[1]


def include_flags() -> list[str]:
    packages = ["trident_base", "trident_sim"]
    flags = [f"-I{REPO / 'src' / package / 'include'}" for package in packages]
    system = subprocess.run(
        ["pkg-config", "--cflags", "eigen3"], capture_output=True, text=True, check=True
    )
    return flags + system.stdout.split()


@pytest.fixture(scope="module")
def plugin_folder(tmp_path_factory: pytest.TempPathFactory) -> Path:
    folder = tmp_path_factory.mktemp("plugin")
    source = folder / "push_plugin.cpp"
    source.write_text(code_of("howto/add_a_plugin.md", "cpp"), encoding="utf-8")
    command = ["g++", "-std=c++17", "-shared", "-fPIC", "-Wall", "-Wextra", "-Werror"]
    command += [*include_flags(), str(source), "-o", str(folder / "libpush_plugin.so")]
    subprocess.run(command, check=True)
    return folder


def test_the_plugin_of_the_docs_pushes(
    plugin_folder: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setenv("GAZEBO_PLUGIN_PATH", str(plugin_folder))
    world = trident_sim.World(EMPTY)
    box = world.spawn("box", sdf=BOX.format(link="base_link", force=3.0))
    dt_s, steps = world.dt, 200
    world.step(steps)
    # Semi-implicit Euler: x = a dt^2 n (n + 1) / 2.
    expected = 3.0 / 2.0 * dt_s**2 * steps * (steps + 1) / 2.0
    assert box.position[0] == pytest.approx(expected, rel=1e-9)


def test_a_plugin_that_lacks_a_symbol_is_refused(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    source = tmp_path / "lacking.cpp"
    source.write_text(
        'void absent(); extern "C" void trident_register_plugins(void*) { absent(); }\n',
        encoding="utf-8",
    )
    library = tmp_path / "liblacking.so"
    subprocess.run(["g++", "-shared", "-fPIC", str(source), "-o", str(library)], check=True)
    monkeypatch.setenv("GAZEBO_PLUGIN_PATH", str(tmp_path))
    sdf = BOX.format(link="base_link", force=1.0).replace("push_plugin", "lacking")
    with pytest.raises(trident_sim.Error, match=r"liblacking\.so.*cannot be loaded.*absent"):
        trident_sim.World(EMPTY).spawn("box", sdf=sdf)


@pytest.mark.parametrize(
    ("link", "force", "named"), [("wheel", 1.0, "linkName"), ("base_link", 1000.0, "force")]
)
def test_the_plugin_of_the_docs_refuses_bad_parameters(
    plugin_folder: Path, monkeypatch: pytest.MonkeyPatch, link: str, force: float, named: str
) -> None:
    monkeypatch.setenv("GAZEBO_PLUGIN_PATH", str(plugin_folder))
    with pytest.raises(trident_sim.Error, match=named):
        trident_sim.World(EMPTY).spawn("box", sdf=BOX.format(link=link, force=force))


def test_the_world_of_the_docs_loads(tmp_path: Path) -> None:
    file = tmp_path / "yard.world"
    file.write_text(code_of("howto/add_a_world.md", "xml"), encoding="utf-8")
    world = trident_sim.World(str(file))
    assert {"ground_plane", "wall"} <= set(world.models)
    world.step(10)


def test_the_robot_of_the_docs_has_its_lidar(tmp_path: Path) -> None:
    file = tmp_path / "my_robot.urdf.xacro"
    file.write_text(code_of("howto/add_a_sensor.md", "xml"), encoding="utf-8")
    world = trident_sim.World(EMPTY)
    world.spawn("my_robot", urdf=trident_sim.expand_xacro(str(file)))
    points = world.ports["my_robot/velodyne_points"]
    points.subscribe()
    world.step_until(0.2)
    assert points.value.points.shape[0] > 1000
