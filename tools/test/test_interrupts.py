# SPDX-FileCopyrightText: 2026 The Trident authors
# SPDX-License-Identifier: Apache-2.0
"""Ctrl-C at any instant of a program's start is answered without a traceback."""

import os
import signal
import subprocess
import time
from pathlib import Path

import pytest
from trident_tool.modules import module_command

ROOT = Path(__file__).resolve().parents[2]
ENV = {**os.environ, "PYTHONPATH": str(Path(__file__).parent)}
# A start takes a few tenths of a second; on a slow machine these fall into it the more.
INSTANTS_S = [0.0, 0.005, 0.01, 0.02, 0.03, 0.05, 0.08, 0.12, 0.2, 0.4]


def _interrupted(command: list[str], after_s: float) -> tuple[int, str]:
    process = subprocess.Popen(
        command, env=ENV, stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True
    )
    time.sleep(after_s)  # the instant is what is tested
    process.send_signal(signal.SIGINT)
    _, said = process.communicate(timeout=60)
    return process.returncode, said


@pytest.mark.parametrize("after_s", INSTANTS_S)
def test_trident_says_no_more_than_that_it_was_interrupted(after_s: float) -> None:
    code, said = _interrupted([str(ROOT / "trident"), "help"], after_s)
    assert said in ("", "trident: interrupted\n")
    assert code in (0, 130, -signal.SIGINT)


@pytest.mark.parametrize("after_s", INSTANTS_S)
def test_a_module_of_the_workspace_says_nothing(tmp_path: Path, after_s: float) -> None:
    (tmp_path / "slow_module.py").write_text(
        "import asyncio, decimal, email, html, http, json, logging, sqlite3, unittest, xmlrpc\n"
        "import signal\n"
        "signal.pause()\n"
    )
    ENV["PYTHONPATH"] = str(tmp_path)
    code, said = _interrupted(module_command("slow_module"), after_s)
    assert said == ""
    assert code == -signal.SIGINT


def test_other_errors_of_a_module_are_reported(tmp_path: Path) -> None:
    (tmp_path / "bad_module.py").write_text("raise ValueError('reported')\n")
    done = subprocess.run(
        module_command("bad_module"),
        env={**os.environ, "PYTHONPATH": str(tmp_path)},
        capture_output=True,
        text=True,
        check=False,
    )
    assert done.returncode == 1
    assert "ValueError: reported" in done.stderr


def test_a_module_gets_its_words_and_runs_as_by_m(tmp_path: Path) -> None:
    (tmp_path / "words.py").write_text("import sys\nprint(__name__, sys.argv[1:])\n")
    command = module_command("words", "a", "--b")
    run = {"capture_output": True, "text": True, "check": True}
    done = subprocess.run(command, env={**os.environ, "PYTHONPATH": str(tmp_path)}, **run)
    assert done.stdout == "__main__ ['a', '--b']\n"
