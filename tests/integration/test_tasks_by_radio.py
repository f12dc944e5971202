# SPDX-FileCopyrightText: 2026 The Trident authors
# SPDX-License-Identifier: Apache-2.0
"""A team shares out tasks over the radios of a simulated world, without ROS."""

from __future__ import annotations

from trident_fleet.core.tasks.fields import Capabilities
from trident_fleet.core.tasks.member import Member
from trident_fleet.core.tasks.messages import TaskAnnounce
from trident_fleet.core.tasks.methods import METHODS
from trident_fleet.core.tasks.plan import Plan
from trident_fleet.core.tasks.protocol import Team
from trident_fleet.core.tasks.radio_port import RadioPort
from trident_fleet.core.tasks.worker import Worker

import trident_sim

AIR = '<plugin name="air" filename="libtrident_radio_medium.so"/>'
ROBOT = """<sdf version="1.6"><model name="{name}"><link name="base"><gravity>0</gravity></link>
<plugin name="radio" filename="libtrident_radio.so"/></model></sdf>"""
PLACES = {"ugv1": (0.0, 0.0, 1.0), "usv1": (60.0, 0.0, 1.0), "uav1": (30.0, 20.0, 1.0)}
STEPS, STEP_S = 200, 0.2


def test_a_team_shares_out_tasks_by_radio_and_one_that_hears_nobody_claims_nothing() -> None:
    world = trident_sim.World(f'<sdf version="1.6"><world name="w">{AIR}</world></sdf>', seed=1)
    for name, place in PLACES.items():
        world.spawn(name, sdf=ROBOT.format(name=name), pose=place)
    can = Capabilities("ground", speed_m_s=5.0)
    team = Team(dict.fromkeys(PLACES, can), tuple(PLACES))
    now_s = 0.0
    members = {
        name: Member(
            RadioPort(world.radio, name, lambda: now_s),
            team,
            METHODS["improved"],
            Plan(name, can, place),
        )
        for name, place in PLACES.items()
    }
    workers = {name: Worker(member.robot) for name, member in members.items() if member.robot}
    world.radio.set_outage("uav1", True)
    for index, x in enumerate((5.0, 55.0, 30.0)):
        task = TaskAnnounce(0.0, f"t{index}", "", 0, "visit", "", (x, 0.0, 1.0), 1.0)
        members["ugv1"].follower.request(task)
    done: dict[str, str] = {}
    while now_s < 60.0 and len(done) < 3:
        world.step(STEPS)
        now_s += STEP_S
        for name, member in members.items():
            member.spin()
            goal = workers[name].goal(now_s)
            came = workers[name].at(goal or PLACES[name], now_s)
            member.send(list(came.sent))
            done |= {came.done: name} if came.done else {}
    assert (done["t0"], done["t1"]) == ("ugv1", "usv1")
    assert "uav1" not in done.values()
    assert not any(member.port.problems for member in members.values())  # type: ignore[attr-defined]
