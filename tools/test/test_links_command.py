# SPDX-FileCopyrightText: 2026 The Trident authors
# SPDX-License-Identifier: Apache-2.0
"""The command about radios: which simulation it asks."""

from __future__ import annotations

import json
import socket
from collections.abc import Iterator, Mapping, Sequence
from contextlib import closing
from pathlib import Path

import pytest
from trident_tool import cli, links
from trident_tool.workspace import Runner, Workspace


@pytest.fixture(autouse=True)
def _nothing_is_built(clone: Workspace, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(cli, "provision", lambda *_args: None)
    monkeypatch.setattr(links, "build", lambda *_args: None)
    monkeypatch.setattr(links, "ros_environment", lambda _workspace: {"ROS_MASTER_URI": "other"})
    monkeypatch.setattr(Workspace, "of_this_file", staticmethod(lambda: clone))


@pytest.fixture
def asked(monkeypatch: pytest.MonkeyPatch) -> list[str]:
    """The masters that are asked."""
    found: list[str] = []

    def run(_runner: Runner, words: Sequence[str], env: Mapping[str, str]) -> int:
        assert words[-1] == "trident_viewer.links"
        found.append(env["ROS_MASTER_URI"])
        return 0

    monkeypatch.setattr(Runner, "run", run)
    return found


@pytest.fixture
def master() -> Iterator[str]:
    """Something that listens where a master may."""
    with closing(socket.create_server(("localhost", 0))) as server:
        yield f"http://localhost:{server.getsockname()[1]}"


def unused_uri() -> str:
    with closing(socket.create_server(("localhost", 0))) as server:
        return f"http://localhost:{server.getsockname()[1]}"


def test_without_a_roscore_it_says_so_in_one_line(
    monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str], asked: list[str]
) -> None:
    uri = unused_uri()
    monkeypatch.setenv("ROS_MASTER_URI", uri)
    assert cli.main(["links"]) == 1
    assert capsys.readouterr().err == (
        "trident: no roscore is reachable: there is no ./trident run in progress, nor one at "
        f"{uri}\n"
    )
    assert asked == []


def test_the_roscore_of_the_environment_is_asked(
    monkeypatch: pytest.MonkeyPatch, asked: list[str], master: str
) -> None:
    monkeypatch.setenv("ROS_MASTER_URI", master)
    assert cli.main(["links"]) == 0
    assert asked == [master]


def test_a_run_in_progress_is_asked_first(
    monkeypatch: pytest.MonkeyPatch, asked: list[str], master: str, clone: Workspace
) -> None:
    monkeypatch.setenv("ROS_MASTER_URI", unused_uri())
    run: Path = clone.out / "latest"
    run.mkdir(parents=True)
    (run / "launch.json").write_text(json.dumps({"ros_master_uri": master}))
    assert cli.main(["links"]) == 0
    assert asked == [master]


def test_a_dry_run_needs_no_roscore(capsys: pytest.CaptureFixture[str]) -> None:
    assert cli.main(["links", "--dry-run"]) == 0
    assert capsys.readouterr().out == "would run: /usr/bin/python3 -m trident_viewer.links\n"
