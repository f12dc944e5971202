# SPDX-FileCopyrightText: 2026 The Trident authors
# SPDX-License-Identifier: Apache-2.0
"""map_server and map_saver as processes: what is served is saved again, to the byte."""

from __future__ import annotations

from collections.abc import Iterator
from pathlib import Path

import pytest
from trident.testing import RosProcesses, program

YAML = (
    "image: room.pgm\nresolution: 0.100000\norigin: [-1.000000, 2.000000, 0.000000]\nnegate: 0\n"
    "occupied_thresh: 0.65\nfree_thresh: 0.196\n\n"
)
PGM = b"P5\n# CREATOR: map_saver.cpp 0.100 m/pix\n3 2\n255\n" + bytes([254, 0, 205, 254, 254, 0])


@pytest.fixture
def ros(tmp_path: Path) -> Iterator[RosProcesses]:
    processes = RosProcesses(tmp_path)
    yield processes
    processes.close()


def saved(folder: Path, ros: RosProcesses, *words: str) -> tuple[int, str]:
    return ros.run([program("map_server", "map_saver"), "-f", str(folder / "saved"), *words])


def test_a_served_map_is_saved_as_it_was(ros: RosProcesses, tmp_path: Path) -> None:
    (tmp_path / "room.yaml").write_text(YAML, encoding="utf-8")
    (tmp_path / "room.pgm").write_bytes(PGM)
    words = [program("map_server", "map_server"), str(tmp_path / "room.yaml")]
    ros.start_node("/map_server", [*words, "__name:=map_server"])
    code, output = saved(tmp_path, ros)
    assert code == 0, output
    assert (tmp_path / "saved.pgm").read_bytes() == PGM
    assert (tmp_path / "saved.yaml").read_text() == YAML.replace("room", "saved")


def test_a_bad_map_does_not_replace_the_good_one(ros: RosProcesses, tmp_path: Path) -> None:
    (tmp_path / "room.yaml").write_text(YAML, encoding="utf-8")
    (tmp_path / "room.pgm").write_bytes(PGM)
    words = [program("map_server", "map_server"), str(tmp_path / "room.yaml")]
    ros.start_node("/map_server", [*words, "__name:=map_server"])
    (tmp_path / "short.pgm").write_bytes(PGM[:-3])
    (tmp_path / "short.yaml").write_text(YAML.replace("room", "short"), encoding="utf-8")
    for name, result in (("short", "2"), ("missing", "1")):
        request = f"map_url: {tmp_path / name}.yaml"
        code, answer = ros.run(["rosservice", "call", "/change_map", request])
        assert code == 0, answer
        assert f"result: {result}" in answer
    code, output = ros.run(["rostopic", "echo", "-n", "1", "/diagnostics"])
    assert code == 0
    assert "map_server: change_map" in output
    assert 'value: "2"' in output
    assert "missing.yaml" in output
    code, output = saved(tmp_path, ros)
    assert code == 0, output
    assert (tmp_path / "saved.pgm").read_bytes() == PGM


@pytest.mark.parametrize(
    ("name", "words", "expected"),
    [
        ("map_server", ["/nowhere/map.yaml"], "/nowhere/map.yaml"),
        ("map_saver", ["--occ", "110"], "--occ: 110, legal: 1 to 100"),
        ("map_saver", ["--free", "many"], "--free: 'many'"),
    ],
)
def test_bad_input_is_one_error(
    ros: RosProcesses, name: str, words: list[str], expected: str
) -> None:
    code, output = ros.run([program("map_server", name), *words])
    assert code != 0
    assert expected in output
