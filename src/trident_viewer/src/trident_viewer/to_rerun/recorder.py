# SPDX-FileCopyrightText: 2026 The Trident authors
# SPDX-License-Identifier: Apache-2.0
"""The rerun viewer and .rrd files, as one place to write to."""

from __future__ import annotations

import uuid
from pathlib import Path

import rerun as rr
from trident_eval.core.errors import EvalError

from trident_viewer.to_rerun.converter import Item

TIMELINE = "sim_time"
_APPLICATION = "trident"


class Recorder:
    """Writes items to a file, a viewer, or both. To be used by one thread."""

    def __init__(self, file: Path | None, viewer: bool) -> None:
        """Open them.

        Args:
            file: the .rrd file; None: none.
            viewer: whether a viewer is opened on the display.

        Raises:
            EvalError: the file cannot be written.
        """
        recording = uuid.uuid4()  # the viewer's and the file's recording are the same one
        self._streams = []
        if file is not None:
            try:
                file.touch()
            except OSError as error:
                raise EvalError(f"{file}: cannot be written: {error.strerror}") from error
            stream = rr.new_recording(_APPLICATION, recording_id=recording)
            rr.save(file, recording=stream)
            self._streams.append(stream)
        if viewer:
            stream = rr.new_recording(_APPLICATION, recording_id=recording)
            rr.spawn(hide_welcome_screen=True, recording=stream)
            self._streams.append(stream)

    def log(self, item: Item) -> None:
        """Show one thing."""
        path = rr.new_entity_path(list(item.path))
        for stream in self._streams:
            if item.stamp_s is None:
                rr.log(path, item.content, static=True, recording=stream)
            else:
                rr.set_time_seconds(TIMELINE, item.stamp_s, recording=stream)
                rr.log(path, item.content, recording=stream)

    def close(self) -> None:
        """Nothing is lost that was logged before."""
        for stream in self._streams:
            stream.flush(blocking=True)
            rr.disconnect(recording=stream)
