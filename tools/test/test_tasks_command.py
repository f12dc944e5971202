# SPDX-FileCopyrightText: 2026 The Trident authors
# SPDX-License-Identifier: Apache-2.0
"""The command that asks a running team."""

from __future__ import annotations

from collections.abc import Sequence

import pytest
from trident_tool import cli, tasks
from trident_tool.workspace import Runner, Workspace


@pytest.mark.parametrize(
    "words", [["list"], ["add", "a", "1", "2", "0", "--kind", "dig", "--repeatable"]]
)
def test_all_words_go_to_the_team(
    clone: Workspace, monkeypatch: pytest.MonkeyPatch, words: list[str]
) -> None:
    asked: list[tuple[str, list[str]]] = []

    def run(_workspace: Workspace, _runner: Runner, module: str, words: Sequence[str]) -> int:
        asked.append((module, list(words)))
        return 0

    monkeypatch.setattr(cli, "provision", lambda *_args: None)
    monkeypatch.setattr(tasks, "run_at_master", run)
    monkeypatch.setattr(Workspace, "of_this_file", staticmethod(lambda: clone))
    assert cli.main(["task", *words]) == 0
    assert asked == [("trident_fleet.cli.tasks", words)]
