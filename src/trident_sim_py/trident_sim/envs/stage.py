# SPDX-FileCopyrightText: 2026 The Trident authors
# SPDX-License-Identifier: Apache-2.0
"""A world in which episodes follow each other, by going back to its snapshot."""

from __future__ import annotations

import numpy as np

from trident_sim._core import Rollout
from trident_sim.envs.camera import add_camera
from trident_sim.envs.task import Task


class Stage:
    """The world of a task, and where in an episode it is.

    Attributes:
        world: it.
        session: what a rollout needs of it.
        beams: that the scans of its agent are reduced to.
    """

    def __init__(self, task: Task) -> None:
        """Make the world, and keep how it is."""
        self.task, self.world = task, task.make_world()
        add_camera(self.world, task.view)
        self.session = self.world._session
        self.beams = task.beams
        self._snapshot = self.world.save_snapshot()
        self._number = 0
        self._random = np.random.default_rng(0)

    def begin(self, rollout: Rollout, index: int, random: np.random.Generator) -> None:
        """Begin an episode in the world that the rollout knows by this index."""
        self.world.restore_snapshot(self._snapshot)
        self.task.place(self.world, random)
        self._number, self._random = 0, random
        rollout.begin(index, [self.task.goal(0, random)])

    def next_goal(self, rollout: Rollout, index: int) -> bool:
        """The goal has been reached; whether it was the last one."""
        self._number += 1
        if self._number >= self.task.goals:
            return True
        rollout.set_goals(index, [self.task.goal(self._number, self._random)])
        return False
