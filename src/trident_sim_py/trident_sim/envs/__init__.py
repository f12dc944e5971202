# SPDX-FileCopyrightText: 2026 The Trident authors
# SPDX-License-Identifier: Apache-2.0
"""Environments for learners, of Gymnasium and PettingZoo, on worlds of this simulator.

Importing this module registers `trident/Hover-v0`, `trident/Waypoints-v0`, `trident/DockBoat-v0`
and `trident/DriveRoom-v0`; `gymnasium.make("trident_sim.envs:trident/Hover-v0")` imports it. The
modules `trident_formation_v0` and `trident_search_v0` in it are environments of PettingZoo.

Example:
    import gymnasium
    import trident_sim.envs

    env = gymnasium.make("trident/Hover-v0", actions="rates")
    observation, info = env.reset(seed=1)
"""

from trident_sim.envs.packages import require

require("gymnasium")

from gymnasium.envs.registration import register, registry  # noqa: E402

from trident_sim.envs.options import Randomization, Rewards, Terms  # noqa: E402
from trident_sim.envs.task import Task  # noqa: E402

__all__ = ["Randomization", "Rewards", "Task", "Terms"]

_TASKS = {"Hover": 500, "Waypoints": 2000, "DockBoat": 600, "DriveRoom": 400}

for _name, _limit in _TASKS.items():
    if f"trident/{_name}-v0" not in registry:
        register(
            f"trident/{_name}-v0",
            entry_point=f"trident_sim.envs.single:{_name}Env",
            vector_entry_point=f"trident_sim.envs.vector:{_name}VectorEnv",
            max_episode_steps=_limit,
        )
