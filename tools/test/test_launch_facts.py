# SPDX-FileCopyrightText: 2026 The Trident authors
# SPDX-License-Identifier: Apache-2.0
import hashlib
import json
import subprocess
import threading
from collections.abc import Iterator
from pathlib import Path
from typing import Any
from xmlrpc.server import SimpleXMLRPCServer

import pytest
from trident_tool.launch.launch_facts import (
    command_line,
    library_versions,
    save_launch,
    save_parameters,
    shortened,
    version,
)
from trident_tool.running import free_port
from trident_tool.workspace import Workspace

ENV = {"TRIDENT_REAL_TIME_FACTOR": "0", "ROS_MASTER_URI": "http://localhost:1"}


def digest(text: str) -> str:
    return hashlib.sha256(text.encode()).hexdigest()


def git(clone: Workspace, *words: str) -> None:
    identity = ("-c", "user.name=n", "-c", "user.email=e@example.invalid")
    subprocess.run(["git", *identity, *words], cwd=clone.root, check=True, capture_output=True)


@pytest.fixture
def committed(clone: Workspace, tmp_path_factory: pytest.TempPathFactory) -> Workspace:
    """A clone with one commit, its launch file in it."""
    (clone.launch / "fly.launch").write_text("<launch/>", encoding="utf-8")
    git(clone, "init", "-q")
    git(clone, "add", "launch")
    git(clone, "commit", "-q", "-m", "first")
    return clone


def save(clone: Workspace, folder: Path, **args: str) -> dict[str, Any]:
    folder.mkdir()
    save_launch(
        clone,
        folder,
        words=["fly.launch", *(f"{name}:={value}" for name, value in args.items())],
        launch_file=clone.launch / "fly.launch",
        args=args,
        env=ENV,
    )
    facts: dict[str, Any] = json.loads((folder / "launch.json").read_text(encoding="utf-8"))
    return facts


def test_a_clean_clone_is_identified_by_its_commit(
    committed: Workspace, tmp_path_factory: pytest.TempPathFactory
) -> None:
    folder = tmp_path_factory.mktemp("out") / "run"
    facts = save(committed, folder)
    assert len(facts["commit"]) == 40
    assert facts["is_changed"] is False
    assert facts["untracked"] == []
    assert not (folder / "changes.patch").exists()
    assert facts["inputs"] == {str(committed.launch / "fly.launch"): digest("<launch/>")}
    assert facts["started"]
    assert facts["machine"]["kernel"]


def test_changes_are_kept_as_a_patch_that_can_be_applied(
    committed: Workspace, tmp_path_factory: pytest.TempPathFactory
) -> None:
    file = committed.launch / "fly.launch"
    file.write_text("<launch>\xff</launch>\n", encoding="latin-1")
    (committed.root / "new.txt").touch()
    folder = tmp_path_factory.mktemp("out") / "run"
    facts = save(committed, folder)
    assert facts["is_changed"] is True
    assert facts["untracked"] == ["new.txt"]
    changed = file.read_bytes()
    git(committed, "checkout", "--", "launch")
    git(committed, "apply", str(folder / "changes.patch"))
    assert file.read_bytes() == changed


def test_files_among_the_arguments_are_identified_by_their_content(
    committed: Workspace, tmp_path: Path
) -> None:
    data = tmp_path / "positions.txt"
    data.write_text("1 2 3", encoding="utf-8")
    facts = save(committed, tmp_path / "run", formation_file=str(data), uavs="3")
    assert facts["inputs"][str(data)] == digest("1 2 3")
    assert set(facts["inputs"]) == {str(data), str(committed.launch / "fly.launch")}
    assert facts["command"][-2:] == [f"formation_file:={data}", "uavs:=3"]


def test_without_git_there_is_no_commit(clone: Workspace, tmp_path: Path) -> None:
    (clone.launch / "fly.launch").write_text("<launch/>", encoding="utf-8")
    facts = save(clone, tmp_path / "run")
    assert (facts["commit"], facts["is_changed"]) == ("", False)


def test_the_command_works_from_where_it_was_given(
    clone: Workspace, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.chdir(clone.root)
    assert command_line(clone, ["a.launch"]) == ["./trident", "run", "a.launch"]
    monkeypatch.chdir(clone.launch)
    assert command_line(clone, ["a.launch"])[0] == "../trident"


def test_versions_are_those_of_the_listed_packages(clone: Workspace) -> None:
    tools = clone.root / "tools"
    (tools / "apt-packages.txt").write_text("python3\nno-such-package\n", encoding="utf-8")
    (tools / "requirements.txt").write_text("ruff==1.2\n", encoding="utf-8")
    versions = library_versions(clone)
    assert versions["python3"].startswith("3.")
    assert versions["ruff"] == "1.2"
    assert "no-such-package" not in versions
    assert version(clone) == ""
    manifest = clone.root / "src" / "trident_bringup" / "package.xml"
    manifest.parent.mkdir()
    manifest.write_text("<package><version>0.3.1</version></package>", encoding="utf-8")
    assert version(clone) == "0.3.1"


@pytest.fixture
def parameters() -> Iterator[tuple[str, dict[str, Any]]]:
    """Address of something that answers like a master, and its parameters."""
    tree: dict[str, Any] = {}
    port = free_port()
    with SimpleXMLRPCServer(("localhost", port), logRequests=False, allow_none=True) as server:
        server.register_function(lambda _caller, _name: [1, "", tree], "getParam")
        thread = threading.Thread(target=server.serve_forever, kwargs={"poll_interval": 0.01})
        thread.start()
        yield f"http://localhost:{port}", tree
        server.shutdown()
        thread.join()


def test_parameters_are_kept_with_the_files_that_they_name(
    parameters: tuple[str, dict[str, Any]], tmp_path: Path
) -> None:
    uri, tree = parameters
    data = tmp_path / "f.txt"
    data.write_text("rows", encoding="utf-8")
    tree |= {"gazebo": {"seed": 3}, "formation": {"file": str(data), "other": "/gone/f.txt"}}
    assert save_parameters(uri, tmp_path)
    saved = json.loads((tmp_path / "params.json").read_text(encoding="utf-8"))
    assert saved == {"parameters": tree, "files": {str(data): digest("rows")}}


def test_no_master_no_parameters(tmp_path: Path) -> None:
    assert not save_parameters(f"http://localhost:{free_port()}", tmp_path)
    assert not list(tmp_path.iterdir())


def test_long_texts_are_distinguished_without_being_kept() -> None:
    text = "x" * 5000
    short = shortened({"a": {"b": text, "c": 1}, "d": "y"})
    assert short == {"a": {"b": f"(5000 characters, SHA-256 {digest(text)})", "c": 1}, "d": "y"}
