# SPDX-FileCopyrightText: 2026 The Trident authors
# SPDX-License-Identifier: Apache-2.0
"""The node that makes the vehicles hover and takes the measurement; a process of its own.

The simulator is paused: it steps when this node asks it to, so the wall time of a known number of
steps is exactly that of one service call. While it runs, this node waits for the answer.
"""

from __future__ import annotations

import argparse
import json
import math
import sys
import time
from collections.abc import Callable, Sequence
from typing import Any

import rospy
from gazebo_msgs.srv import GetModelState
from geometry_msgs.msg import PoseStamped
from trident_eval.core.errors import EvalError

from trident_benchmarks.procfs import machine_busy_s, memory_of, process_cpu_s
from trident_benchmarks.sim.lockstep_result import Sample, to_result
from trident_benchmarks.sim.vehicle import HOVER_HEIGHT_M, place, vehicle_name
from trident_msgs.srv import Step

_AIRBORNE_Z_M = 0.5
_TAKE_OFF_LIMIT_S = 30
_CONNECT_LIMIT_S = 60.0
_POLL_S = 0.005
_MAX_STEPS_PER_CALL = 2**32 - 1


class Pilot:
    """Commands and steps ``n`` vehicles."""

    def __init__(self, n: int) -> None:
        self._n = n
        self._step = rospy.ServiceProxy("/gazebo/step", Step, persistent=True)
        self._get_state = rospy.ServiceProxy("/gazebo/get_model_state", GetModelState)
        rospy.wait_for_service("/gazebo/step", _CONNECT_LIMIT_S)
        self._publishers = [
            rospy.Publisher(
                f"/{vehicle_name(i)}/command/pose", PoseStamped, queue_size=1, latch=True
            )
            for i in range(n)
        ]

    def command_hover(self) -> None:
        """Sends every vehicle to its place, once, before time zero is left.

        Raises:
            EvalError: a controller does not subscribe.
        """
        for index, publisher in enumerate(self._publishers):
            x, y = place(index)
            pose = PoseStamped()
            pose.header.frame_id = "world"
            pose.pose.position.x, pose.pose.position.y = x, y
            pose.pose.position.z = HOVER_HEIGHT_M
            pose.pose.orientation.w = 1.0
            publisher.publish(pose)
        for publisher in self._publishers:
            deadline = time.monotonic() + _CONNECT_LIMIT_S  # again with each that has connected
            while publisher.get_num_connections() == 0:
                if time.monotonic() > deadline:
                    raise EvalError(f"no controller listens to {publisher.resolved_name}")
                time.sleep(_POLL_S)

    def step(self, seconds: float, dt_s: float) -> float:
        """Steps by simulated ``seconds`` and returns the simulated time after that [s].

        Raises:
            EvalError: the simulator refuses.
        """
        steps = round(seconds / dt_s)
        if not 0 < steps <= _MAX_STEPS_PER_CALL:
            raise EvalError(f"{seconds} s are {steps} steps; legal: 1 to {_MAX_STEPS_PER_CALL}")
        answer = self._step(steps)
        if not answer.success:
            raise EvalError(answer.message)
        return float(answer.sim_time.to_sec())

    def positions(self) -> list[tuple[float, float, float]]:
        """Where the vehicles are in the world [m]."""
        found = []
        for index in range(self._n):
            answer = self._get_state(vehicle_name(index), "world")
            if not answer.success:
                raise EvalError(answer.status_message)
            point = answer.pose.position
            found.append((float(point.x), float(point.y), float(point.z)))
        return found

    def take_off(self, dt_s: float) -> float:
        """Steps by whole seconds until all are above 0.5 m; returns the simulated time [s].

        Raises:
            EvalError: they are not within 30 s.
        """
        for _ in range(_TAKE_OFF_LIMIT_S):
            now_s = self.step(1.0, dt_s)
            if min(z for _, _, z in self.positions()) > _AIRBORNE_Z_M:
                return now_s
        lowest = min(z for _, _, z in self.positions())
        raise EvalError(
            f"after {_TAKE_OFF_LIMIT_S} s the lowest vehicle is at z = {lowest:.3f} m; "
            f"legal: above {_AIRBORNE_Z_M} m"
        )

    def largest_offset_m(self) -> float:
        """The largest distance of a vehicle from the place that it is commanded to keep [m]."""
        commanded = [(*place(i), HOVER_HEIGHT_M) for i in range(self._n)]
        return max(map(math.dist, commanded, self.positions()))


def take_sample(server: int, controllers: Sequence[int], master: Sequence[int]) -> Sample:
    """CPU times and the wall clock, now."""
    return Sample(
        wall_s=time.perf_counter(),
        server_cpu_s=process_cpu_s(server),
        controllers_cpu_s=sum(map(process_cpu_s, controllers)),
        master_cpu_s=sum(map(process_cpu_s, master)),
        machine_busy_s=machine_busy_s(),
    )


def fly(options: argparse.Namespace) -> dict[str, Any]:
    """Takes off and measures; returns the result of the run."""
    pilot = Pilot(len(options.controllers))
    pilot.command_hover()
    airborne_s = pilot.take_off(options.dt)
    sample: Callable[[], Sample] = lambda: take_sample(  # noqa: E731
        options.server, options.controllers, options.master
    )
    begin = sample()
    end_s = pilot.step(options.window, options.dt)
    end = sample()
    memory = memory_of(options.server)
    result = to_result(begin, end, end_s - airborne_s)
    return result | {
        "rss_mb": memory.rss_mb,
        "peak_rss_mb": memory.peak_mb,
        "airborne_s": airborne_s,
        "lowest_z_m": min(z for _, _, z in pilot.positions()),
        "largest_offset_m": pilot.largest_offset_m(),
    }


def main(arguments: list[str] | None = None) -> int:
    """Prints the result as one line of JSON; 1 without a result."""
    parser = argparse.ArgumentParser(prog="trident_benchmarks.sim.pilot", description=__doc__)
    parser.add_argument("--window", type=float, required=True, help="simulated [s]")
    parser.add_argument("--dt", type=float, required=True, help="step size [s]")
    parser.add_argument("--server", type=int, required=True, metavar="PID")
    parser.add_argument("--controllers", type=int, nargs="+", required=True, metavar="PID")
    parser.add_argument("--master", type=int, nargs="+", required=True, metavar="PID")
    options = parser.parse_args(arguments)
    # Without this node's own /clock subscription, which would cost the machine CPU time.
    rospy.init_node("bench_pilot", disable_rostime=True, disable_signals=True)
    try:
        print(json.dumps(fly(options)), flush=True)
    except (EvalError, rospy.ROSException, rospy.ServiceException) as error:
        print(f"trident_benchmarks: {error}", flush=True)
        return 1
    return 0


if __name__ == "__main__":
    sys.exit(main())
