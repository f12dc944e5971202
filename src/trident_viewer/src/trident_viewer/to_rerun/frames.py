# SPDX-FileCopyrightText: 2026 The Trident authors
# SPDX-License-Identifier: Apache-2.0
"""The tree of frames, as paths of entities."""

from __future__ import annotations

EntityPath = tuple[str, ...]


def plain(frame: str) -> str:
    """The name of a frame without the slash that tf once had before it."""
    return frame.lstrip("/")


class FrameTree:
    """Who is whose parent, by transforms."""

    def __init__(self) -> None:
        """No frame is known."""
        self._parents: dict[str, str] = {}
        self.changed_s: float | None = None
        """Simulated time at which a frame came or went over to another parent [s]."""

    def add(self, parent: str, child: str, now_s: float) -> bool:
        """Takes an edge; whether it is a new one."""
        parent, child = plain(parent), plain(child)
        if self._parents.get(child) == parent:
            return False
        self._parents[child] = parent
        self.changed_s = now_s
        return True

    def path(self, frame: str) -> EntityPath:
        """From the root to the frame; an unknown frame is a root of its own.

        A frame that is its own ancestor is cut off at the first one that repeats.
        """
        names = [plain(frame) or "unnamed"]
        while (parent := self._parents.get(names[-1])) is not None and parent not in names:
            names.append(parent)
        return tuple(reversed(names))
