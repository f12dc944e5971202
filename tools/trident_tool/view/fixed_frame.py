# SPDX-FileCopyrightText: 2026 The Trident authors
# SPDX-License-Identifier: Apache-2.0
"""The fixed frame of rviz where a robot has no odometry: in an unknown one nothing is drawn."""

from __future__ import annotations

import contextlib
import re
import subprocess
import tempfile
import time
from collections import Counter
from collections.abc import Iterator, Mapping
from dataclasses import dataclass
from pathlib import Path

from trident_tool.processes import supervised

#: A robot may be without this one. A map comes late, and what is in the world needs no transform.
_ODOMETRY = "odom"
_TOPICS = ("/tf", "/tf_static")
_FIXED = re.compile(r"^ *Fixed Frame: (\S+)$", re.MULTILINE)
_EDGE = re.compile(r'frame_id: "/?([^"]*)"\s+child_frame_id: "/?([^"]*)"')
_POLL_S = 0.2


def may_be_missing(configuration: Path | None) -> bool:
    """Whether the fixed frame of an rviz configuration is that of odometry."""
    if configuration is None:
        return False
    found = _FIXED.search(configuration.read_text(encoding="utf-8"))
    return found is not None and found[1] == _ODOMETRY


def parents_in(text: str) -> dict[str, str]:
    """Parents by their children, in what `rostopic echo` prints of transforms."""
    return {child: parent for parent, child in _EDGE.findall(text)}


def root_in_place_of_odometry(parents: Mapping[str, str]) -> str | None:
    """Root of the tree of the most frames; None where there is odometry, or nothing at all."""
    if not parents or _ODOMETRY in parents or _ODOMETRY in parents.values():
        return None
    sizes = Counter(_root(frame, parents) for frame in parents)
    return max(sorted(sizes), key=lambda root: sizes[root])


def _root(frame: str, parents: Mapping[str, str]) -> str:
    for _ in range(len(parents)):  # what has been sent may be a ring
        if frame not in parents:
            break
        frame = parents[frame]
    return frame


@dataclass(frozen=True)
class Transforms:
    """What has been heard of transforms, by files that `rostopic echo` writes."""

    files: tuple[Path, ...]

    def root_in_place_of_odometry(self, limit_s: float) -> str | None:
        """As the function of this name, once odometry has come or the limit has passed [s]."""
        give_up = time.monotonic() + limit_s
        while True:
            parents = parents_in("".join(file.read_text(encoding="utf-8") for file in self.files))
            root = root_in_place_of_odometry(parents)
            if (parents and root is None) or time.monotonic() > give_up:
                return root
            time.sleep(_POLL_S)


@contextlib.contextmanager
def heard_transforms(env: Mapping[str, str]) -> Iterator[Transforms]:
    """Listens to transforms: what is sent now is not sent again by a world that is held."""
    at_once = {**env, "PYTHONUNBUFFERED": "1"}
    silent = {"stdin": subprocess.DEVNULL, "stderr": subprocess.DEVNULL}
    with contextlib.ExitStack() as stack:
        folder = Path(stack.enter_context(tempfile.TemporaryDirectory(prefix="trident-view-")))
        files = []
        for topic in _TOPICS:
            files.append(folder / topic.strip("/"))
            output = stack.enter_context(files[-1].open("wb"))
            command = ["rostopic", "echo", topic]
            stack.enter_context(supervised(command, at_once, stdout=output, **silent))
        yield Transforms(tuple(files))
