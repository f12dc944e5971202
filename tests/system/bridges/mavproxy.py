# SPDX-FileCopyrightText: 2026 The Trident authors
# SPDX-License-Identifier: Apache-2.0
"""MAVProxy, unchanged and without windows, as a process that is typed to."""

from __future__ import annotations

import subprocess
import threading
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path

from trident.testing import eventually
from trident.testing.clients import clients_python

_LIMIT_S = 60.0
_AT_ONCE_S = 0.5
_MODULES = "cmdlong,mode,arm,wp,misc,param,rc,battery"


class MavProxy:
    """It, its words and what it says.

    Attributes:
        lines: what it has printed.
    """

    def __init__(self, port: int, folder: Path) -> None:
        python = clients_python("MAVProxy")
        command = [str(python), str(python.parent / "mavproxy.py")]
        command += [f"--master=tcp:127.0.0.1:{port}", f"--state-basedir={folder}"]
        self.process = subprocess.Popen(
            [*command, "--aircraft=vehicle", f"--default-modules={_MODULES}"],
            stdin=subprocess.PIPE,
            stdout=subprocess.PIPE,
            stderr=subprocess.STDOUT,
            text=True,
            bufsize=1,
        )
        self.lines: list[str] = []
        self._heard = threading.Condition()
        self._reader = threading.Thread(target=self._read, daemon=True)
        self._reader.start()

    def _read(self) -> None:
        assert self.process.stdout is not None
        for line in self.process.stdout:
            with self._heard:
                self.lines.append(line.rstrip())
                self._heard.notify_all()

    def expect(self, text: str, since: int = 0) -> None:
        """Until it says so."""

        def is_said() -> bool:
            return any(text in line for line in self.lines[since:])

        try:
            eventually(is_said, f"'{text}'", _LIMIT_S)
        except AssertionError as error:
            raise AssertionError("\n".join([str(error), *self.lines])) from None

    def say(self, line: str) -> None:
        """Type a line."""
        assert self.process.stdin is not None
        self.process.stdin.write(line + "\n")
        self.process.stdin.flush()

    def command(self, line: str, answer: str) -> None:
        """Type a line, and wait for what it must say then."""
        since = len(self.lines)
        self.say(line)
        self.expect(answer, since)

    def answers(self, line: str, answer: str) -> bool:
        """Type a line; whether it says so at once."""
        since = len(self.lines)
        self.say(line)
        with self._heard:
            return self._heard.wait_for(
                lambda: any(answer in one for one in self.lines[since:]), _AT_ONCE_S
            )


@contextmanager
def mavproxy(port: int, folder: Path) -> Iterator[MavProxy]:
    """Started, and ended with the test.

    Args:
        port: TCP port of a vehicle.
        folder: for its logs; made.
    """
    folder.mkdir()
    client = MavProxy(port, folder)
    try:
        yield client
    finally:
        client.process.kill()
        client.process.wait()
