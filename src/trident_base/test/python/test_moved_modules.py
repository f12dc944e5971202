# SPDX-FileCopyrightText: 2026 The Trident authors
# SPDX-License-Identifier: Apache-2.0
"""Old names of modules."""

from __future__ import annotations

import importlib
import subprocess
import sys
import warnings
from collections.abc import Iterator
from pathlib import Path
from typing import Any

import pytest
from trident_base.moved_modules import keep_old_names

HELLO = "import sys\nprint('hello', *sys.argv[1:])\n"


@pytest.fixture
def packages(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Iterator[Path]:
    """A package `old_home`, and `new_home` to which its package `part` and a module have moved."""
    for name in ("old_home", "new_home", "new_home/tool"):
        (tmp_path / name).mkdir()
        (tmp_path / name / "__init__.py").write_text("")
    (tmp_path / "old_home/__init__.py").write_text(
        "from trident_base.moved_modules import keep_old_names\n"
        "keep_old_names({'old_home.part': 'new_home', 'old_home.lone': 'new_home.other'})\n"
    )
    (tmp_path / "new_home/thing.py").write_text("class Thing: pass\n")
    (tmp_path / "new_home/other.py").write_text("VALUE = 7\n")
    (tmp_path / "new_home/tool/__main__.py").write_text(HELLO)
    monkeypatch.syspath_prepend(str(tmp_path))
    finders = list(sys.meta_path)
    yield tmp_path
    sys.meta_path[:] = finders
    for name in [name for name in sys.modules if name.startswith(("old_home", "new_home"))]:
        del sys.modules[name]


def imported(name: str) -> Any:
    with warnings.catch_warnings():
        warnings.simplefilter("ignore")
        return importlib.import_module(name)


def test_an_old_name_is_the_module_of_the_new_one(packages: Path) -> None:
    old, new = imported("old_home.part.thing"), imported("new_home.thing")
    assert old is new
    assert new.__spec__.name == "new_home.thing", "it knows where it comes from"
    assert imported("old_home.lone").VALUE == 7


def test_what_to_write_instead_is_said_once(packages: Path) -> None:
    importlib.import_module("old_home")
    with pytest.warns(FutureWarning, match="old_home.part is new_home now") as warned:
        importlib.import_module("old_home.part.thing")
    assert len(warned) == 1
    with warnings.catch_warnings():
        warnings.simplefilter("error")
        importlib.import_module("old_home.part.tool")


def test_a_command_runs_by_its_old_name(packages: Path) -> None:
    command = [sys.executable, "-m", "old_home.part.tool", "you"]
    done = subprocess.run(command, cwd=packages, capture_output=True, text=True, check=True)
    assert done.stdout == "hello you\n"
    assert "old_home.part is new_home now" in done.stderr


def test_a_name_that_is_nowhere_is_not_found(packages: Path) -> None:
    with pytest.raises(ModuleNotFoundError, match=r"old_home\.part\.nothing"):
        imported("old_home.part.nothing")
    keep_old_names({"old_home.gone": "new_home.gone"})
    with pytest.raises(ModuleNotFoundError, match=r"old_home\.gone"):
        imported("old_home.gone")
