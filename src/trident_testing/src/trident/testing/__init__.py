# SPDX-FileCopyrightText: 2026 The Trident authors
# SPDX-License-Identifier: Apache-2.0
"""Tests of launch files, in lockstep: the result does not depend on how fast the machine is.

Fixtures for pytest are in `trident.testing.pytest_plugin`; other test runners use the classes:

    ros = Ros(folder)
    with Launch(ros, "trident_bringup", "multi_uav_simulation.launch", uavs=2, paused=True) as run:
        run.ready()
        run.step_to(6.0)
        assert abs(run.position("UAV1")[2] - 1.5) < 0.1
    ros.shutdown()
"""

import warnings

from trident.testing.gazebo import Gazebo
from trident.testing.launch import Launch
from trident.testing.master import PYTHON, Ros, RosProcesses
from trident.testing.models import box_sdf, pose, vehicle_urdf
from trident.testing.programs import Process, logged_problems, package, program
from trident.testing.simulation import SERVICES, Simulation, State
from trident.testing.topics import Pilot, Recorder, pilot_of, recorder
from trident.testing.waiting import LIMIT_S, eventually, output_of

__all__ = [
    "LIMIT_S",
    "PYTHON",
    "SERVICES",
    "Gazebo",
    "Launch",
    "Pilot",
    "Process",
    "Recorder",
    "Ros",
    "RosProcesses",
    "Simulation",
    "State",
    "box_sdf",
    "eventually",
    "logged_problems",
    "output_of",
    "package",
    "pilot_of",
    "pose",
    "program",
    "recorder",
    "vehicle_urdf",
]

_RENAMED = {"complaints": "logged_problems"}


def __getattr__(name: str) -> object:
    """What has another name now; the old name warns."""
    if name in _RENAMED:
        new_name = _RENAMED[name]
        text = f"{__name__}.{name} is {__name__}.{new_name} now"
        warnings.warn(text, FutureWarning, stacklevel=2)
        return globals()[new_name]
    raise AttributeError(f"module {__name__!r} has no attribute {name!r}")
