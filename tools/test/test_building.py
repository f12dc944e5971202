# SPDX-FileCopyrightText: 2026 The Trident authors
# SPDX-License-Identifier: Apache-2.0
import os
from pathlib import Path

import pytest
from trident_tool.building import (
    build,
    build_jobs,
    configure_key,
    errors_of_cmake,
    package_manifests,
    source_key,
)
from trident_tool.environment import is_sourced, parse_environment, ros_environment
from trident_tool.testing import ctest_command
from trident_tool.workspace import (
    Runner,
    TridentError,
    Workspace,
    base_environment,
    hide_from_crawlers,
)


def _add_package(clone: Workspace, name: str) -> Path:
    folder = clone.root / "src" / name
    folder.mkdir(parents=True)
    (folder / "package.xml").write_text("<package/>", encoding="utf-8")
    return folder


@pytest.mark.parametrize(
    ("cpus", "memory_gb", "jobs"), [(2, 24, 2), (16, 8, 5), (4, 1, 1), (1, 64, 1)]
)
def test_jobs_fit_cores_and_memory(cpus: int, memory_gb: float, jobs: int) -> None:
    assert build_jobs(cpus, memory_gb * 1e9) == jobs


def test_packages_are_found_in_compat_but_not_where_catkin_ignores_them(clone: Workspace) -> None:
    _add_package(clone, "b")
    _add_package(clone, "compat/a")
    hide_from_crawlers(_add_package(clone, "ignored"))
    names = [path.parent.name for path in package_manifests(clone)]
    assert names == ["b", "a"]


def test_a_new_package_asks_for_configuring(clone: Workspace) -> None:
    _add_package(clone, "a")
    before = configure_key(clone)
    assert configure_key(clone) == before
    _add_package(clone, "b")
    assert configure_key(clone) != before


def test_source_key_changes_with_any_source_and_target(clone: Workspace) -> None:
    source = _add_package(clone, "a") / "a.cpp"
    source.write_text("int a;", encoding="utf-8")
    before = source_key(clone, ["all"])
    assert source_key(clone, ["all"]) == before
    assert source_key(clone, ["tests"]) != before
    os.utime(source, ns=(1, 1))
    touched = source_key(clone, ["all"])
    assert touched != before
    source.unlink()
    assert source_key(clone, ["all"]) not in (before, touched)


def test_bytecode_does_not_ask_for_a_build(clone: Workspace) -> None:
    package = _add_package(clone, "a")
    before = source_key(clone, [])
    (package / "__pycache__").mkdir()
    (package / "__pycache__" / "a.pyc").touch()
    # Creating the folder must not count either.
    assert source_key(clone, []) == before


def test_dry_run_of_a_build_changes_nothing(
    clone: Workspace, capsys: pytest.CaptureFixture[str]
) -> None:
    before = sorted(clone.root.rglob("*"))
    assert build(clone, Runner(dry_run=True), ["all"], jobs=2)
    configure_line, ninja_line = capsys.readouterr().out.splitlines()
    assert "-DPYTHON_EXECUTABLE=/usr/bin/python3" in configure_line
    assert ninja_line == f"would run: ninja -C {clone.build} -j2 all"
    assert sorted(clone.root.rglob("*")) == before


def test_only_the_error_of_a_long_cmake_log_is_shown() -> None:
    log = "-- a\n" * 100 + "CMake Error at x (message):\n  why\n"
    assert errors_of_cmake(log) == "CMake Error at x (message):\n  why\n"
    assert errors_of_cmake("-- a\n" * 100).count("-- a") == 20


def test_usr_bin_comes_first_once(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setenv("PATH", "/home/me/.pyenv/shims:/usr/bin::/sbin")
    monkeypatch.setenv("VIRTUAL_ENV", "/home/me/venv")
    env = base_environment()
    assert env["PATH"] == "/usr/bin:/bin:/home/me/.pyenv/shims:/sbin"
    assert "VIRTUAL_ENV" not in env


def test_environment_block_keeps_newlines_and_equal_signs() -> None:
    assert parse_environment(b"A=1\0B=x=y\nz\0\0") == {"A": "1", "B": "x=y\nz"}


def test_an_overlay_on_this_workspace_is_left_as_it_is(
    clone: Workspace, monkeypatch: pytest.MonkeyPatch
) -> None:
    prefix = f"/home/me/overlay/devel:{clone.devel}"
    monkeypatch.setenv("CMAKE_PREFIX_PATH", prefix)
    assert ros_environment(clone)["CMAKE_PREFIX_PATH"] == prefix
    assert not is_sourced({"CMAKE_PREFIX_PATH": f"{clone.devel}-other"}, clone)


def test_hooks_of_the_devel_space_are_in_the_environment(
    clone: Workspace, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.delenv("CMAKE_PREFIX_PATH", raising=False)
    clone.devel.mkdir()
    (clone.devel / "setup.sh").write_text("export FROM_HOOK='a b'\n", encoding="utf-8")
    assert ros_environment(clone)["FROM_HOOK"] == "a b"


def test_without_a_build_the_error_says_what_to_run(
    clone: Workspace, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.delenv("CMAKE_PREFIX_PATH", raising=False)
    with pytest.raises(TridentError, match=r"run \./trident build"):
        ros_environment(clone)


def test_ctest_gets_the_pattern_and_refuses_an_empty_selection(clone: Workspace) -> None:
    command = ctest_command(clone, "fleet", 2, ["-V"])
    assert command[-3:] == ["-R", "fleet", "-V"]
    assert "--no-tests=error" in command
    assert "-R" not in ctest_command(clone, None, 2, [])
