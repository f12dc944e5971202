# SPDX-FileCopyrightText: 2026 The Trident authors
# SPDX-License-Identifier: Apache-2.0
from pathlib import Path

import pytest
from trident_tool.cli import main


def test_replay_hands_file_endpoint_and_speed_to_the_program(
    tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    recording = tmp_path / "drive.nmea"
    words = ["replay", str(recording), "--to", "pty:///tmp/gps", "--speed", "2"]
    assert main(["nmea", *words, "--dry-run"]) == 0
    assert f"nmea_replay {recording} pty:///tmp/gps 2" in capsys.readouterr().out


def test_a_recording_that_is_not_there_is_named(
    tmp_path: Path, capsys: pytest.CaptureFixture[str], monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr("trident_tool.cli.provision", lambda *_: None)
    assert main(["nmea", "replay", str(tmp_path / "missing.nmea")]) == 1
    assert "missing.nmea does not exist: nmea replay needs a recording" in capsys.readouterr().err
