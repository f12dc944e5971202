# SPDX-FileCopyrightText: 2026 The Trident authors
# SPDX-License-Identifier: Apache-2.0
"""Whatever ends a caller, nothing that it has started is left."""

from __future__ import annotations

import os
import signal
import subprocess
import sys
import textwrap
import time
import uuid
from collections.abc import Callable, Iterator
from pathlib import Path

import pytest
from trident_tool import supervisor
from trident_tool.processes import Supervised, run_supervised, started, supervised

TOOLS = Path(__file__).resolve().parents[1]
LIMIT_S = 60.0
# Like roslaunch: a child in a session of its own, and an orphan in a third one that does not listen
# to an interrupt. A deaf one listens to nothing that can be ignored, nor do the others.
NODES = """
import os, signal, sys, time
is_deaf = sys.argv[2] == "deaf"
def ignore(*numbers):
    for number in numbers:
        signal.signal(number, signal.SIG_IGN)
if is_deaf:
    ignore(signal.SIGINT, signal.SIGTERM, signal.SIGHUP)
if os.fork() == 0:
    os.setsid()
    if os.fork() == 0:
        os.setsid()
        ignore(signal.SIGINT, signal.SIGHUP)
        if os.fork():
            os._exit(0)
open(sys.argv[1] + str(os.getpid()), "w").close()
while True:
    time.sleep(1000)
"""


class Family:
    """Processes that carry a mark in their environment, however they are related."""

    def __init__(self, folder: Path) -> None:
        self.mark = f"FAMILY={uuid.uuid4()}"
        self.ready = folder / "ready"
        self.ready.mkdir()
        name, value = self.mark.split("=")
        self.env = {**os.environ, name: value, "PYTHONPATH": str(TOOLS)}

    def command(self, kind: str = "listening") -> list[str]:
        return [sys.executable, "-c", NODES, f"{self.ready}/", kind]

    def pids(self) -> list[int]:
        found = []
        for folder in Path("/proc").glob("[0-9]*"):
            try:
                if self.mark.encode() in (folder / "environ").read_bytes():
                    found.append(int(folder.name))
            except OSError:
                continue
        return found

    def is_up(self) -> bool:
        return len(list(self.ready.iterdir())) >= 3


def eventually(condition: Callable[[], bool]) -> None:
    end = time.monotonic() + LIMIT_S
    while not condition():
        assert time.monotonic() < end
        time.sleep(0.02)


@pytest.fixture
def family(tmp_path: Path) -> Iterator[Family]:
    found = Family(tmp_path)
    yield found
    for pid in found.pids():
        os.kill(pid, signal.SIGKILL)


def _caller(family: Family, body: str, kind: str = "listening") -> subprocess.Popen[bytes]:
    """A process that does `body`, with the family's command as `command`."""
    text = f"""
        import os, signal, sys
        from trident_tool.processes import ends_by_exception, run_supervised, started, supervised
        command = {family.command(kind)!r}
        """
    script = textwrap.dedent(text) + textwrap.dedent(body)
    return subprocess.Popen([sys.executable, "-c", script], env=family.env)


@pytest.mark.parametrize("number", [signal.SIGINT, signal.SIGTERM, signal.SIGHUP, signal.SIGKILL])
@pytest.mark.parametrize("at_terminal", [False, True])
def test_nothing_outlives_a_caller_that_is_ended_by(
    family: Family, number: signal.Signals, at_terminal: bool
) -> None:
    caller = _caller(family, f"sys.exit(run_supervised(command, at_terminal={at_terminal}))")
    eventually(family.is_up)
    caller.send_signal(number)
    caller.wait(LIMIT_S)
    eventually(lambda: not family.pids())


@pytest.mark.parametrize("at_terminal", [False, True])
def test_nothing_that_is_deaf_outlives_a_caller(family: Family, at_terminal: bool) -> None:
    body = f"sys.exit(run_supervised(command, at_terminal={at_terminal}))"
    caller = _caller(family, body, "deaf")
    eventually(family.is_up)
    caller.send_signal(signal.SIGINT)
    caller.wait(LIMIT_S)
    assert not family.pids()


def test_nothing_outlives_a_caller_that_crashes_or_runs_out_of_memory(family: Family) -> None:
    body = """
        import resource
        with supervised(command):
            while len(os.listdir(command[-2])) < 3:
                pass
            resource.setrlimit(resource.RLIMIT_AS, (1 << 29, 1 << 29))
            bytearray(1 << 30)
        """
    caller = _caller(family, body)
    assert caller.wait(LIMIT_S) == 1
    assert not family.pids()


def test_nothing_outlives_its_supervisor(family: Family) -> None:
    with supervised(family.command(), family.env) as process:
        eventually(family.is_up)
        process.kill()
        process.wait(LIMIT_S)
    assert process.returncode == -signal.SIGKILL
    assert not family.pids()


def test_nothing_outlives_the_command_itself(family: Family) -> None:
    words = [
        sys.executable,
        "-c",
        "import os, sys; os.spawnv(os.P_NOWAIT, sys.argv[1], sys.argv[1:])",
    ]
    assert run_supervised([*words, *family.command()], family.env) == 0
    assert not family.pids()


def test_what_a_shell_leaves_in_the_background_stays(family: Family) -> None:
    line = 'trap "" HUP; setsid sleep 1000 & exit 3'
    assert run_supervised(["bash", "-c", line], family.env, at_terminal=True) == 3
    eventually(lambda: len(family.pids()) == 1)  # in exec it shows no environment


def test_below_nohup_a_hangup_ends_nothing(family: Family) -> None:
    body = """
        signal.signal(signal.SIGHUP, signal.SIG_IGN)
        try:
            run_supervised(command)
        except KeyboardInterrupt as interrupt:
            sys.exit(interrupt.args[0])
        """
    caller = _caller(family, body)
    eventually(family.is_up)
    caller.send_signal(signal.SIGHUP)
    caller.send_signal(signal.SIGTERM)
    assert caller.wait(LIMIT_S) == signal.SIGTERM, "not by SIGHUP"
    assert not family.pids()


def test_several_are_asked_to_end_at_once(tmp_path: Path) -> None:
    # Each ends when both have been interrupted: the one that is asked first must not end before it
    # has seen that the other was asked, nor the other before it was asked itself.
    script = (
        "import pathlib, signal, sys, time\n"
        "here, other = (pathlib.Path(sys.argv[1], name) for name in sys.argv[2:])\n"
        "signal.signal(signal.SIGINT, lambda *_: here.with_suffix('.asked').touch())\n"
        "here.touch()\n"
        "while not all(one.with_suffix('.asked').exists() for one in (here, other)):\n"
        "    time.sleep(0.01)\n"
        "here.with_suffix('.done').touch()\n"
    )
    command = [sys.executable, "-c", script, str(tmp_path)]

    def interrupted() -> None:
        with supervised([*command, "a", "b"]), supervised([*command, "b", "a"]):
            eventually(lambda: (tmp_path / "a").exists() and (tmp_path / "b").exists())
            raise KeyboardInterrupt

    with pytest.raises(KeyboardInterrupt):
        interrupted()
    assert (tmp_path / "a.done").exists()
    assert (tmp_path / "b.done").exists()


def test_the_command_is_interrupted_once_and_may_clean_up(tmp_path: Path) -> None:
    script = (
        "import pathlib, signal, sys\n"
        "asked = []\n"
        "signal.signal(signal.SIGINT, lambda *_: asked.append(1))\n"
        "pathlib.Path(sys.argv[1], 'ready').touch()\n"
        "while not asked:\n"
        "    signal.pause()\n"
        "pathlib.Path(sys.argv[1], 'done').write_text(str(len(asked)))\n"
    )
    with supervised([sys.executable, "-c", script, tmp_path]):
        eventually((tmp_path / "ready").exists)
    assert (tmp_path / "done").read_text() == "1"


@pytest.mark.parametrize(
    ("line", "code"), [("exit 0", 0), ("exit 7", 7), ("kill -SEGV $$", -11), ("kill -9 $$", -9)]
)
def test_the_end_of_the_command_is_reported(line: str, code: int) -> None:
    process = Supervised(["sh", "-c", line])
    assert process.wait(LIMIT_S) == code
    assert process.end() == code
    assert process.end() == code


def test_a_command_that_is_not_there_is_an_exit_code(capfd: pytest.CaptureFixture[str]) -> None:
    assert run_supervised(["/no/such/program"]) == 127
    assert "/no/such/program: No such file" in capfd.readouterr().err


def test_output_of_a_started_process_goes_nowhere(capfd: pytest.CaptureFixture[str]) -> None:
    with started(["sh", "-c", "echo heard"], dict(os.environ)) as process:
        process.wait(LIMIT_S)
    assert capfd.readouterr().out == ""


def test_all_steps_of_an_end_take_less_than_five_seconds() -> None:
    steps = supervisor.INTERRUPT_S + supervisor.LEFT_OVER_S + supervisor.TERMINATE_S
    assert steps <= 4.7
