# SPDX-FileCopyrightText: 2026 The Trident authors
# SPDX-License-Identifier: Apache-2.0
from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest
from massive import massive
from small import config, mission, scene
from trident_fleet.core.errors import FormationError
from trident_fleet.core.missions.knowledge import SharedEyes
from trident_fleet.core.missions.mission import MODES, Setup, names_of
from trident_fleet.core.missions.truth import Presence, Truth
from trident_fleet.core.search.detection import View


def test_a_joint_team_finds_and_serves_everybody() -> None:
    outcome = mission(Setup()).run()
    assert outcome.complete
    assert outcome.end_s < 240.0
    assert outcome.served == outcome.people == 4
    assert outcome.coverage >= 0.97
    assert outcome.lost == ()
    assert outcome.contacts == 0
    assert outcome.value == outcome.sectors + 4 * 2 + 4 * 4


def test_robots_that_have_mass_find_and_serve_everybody_too() -> None:
    outcome = mission(Setup(), massive).run()
    assert outcome.served == outcome.people == 4
    assert outcome.coverage >= 0.97
    assert outcome.end_s < 240.0
    assert outcome.lost == ()


def test_the_same_seed_is_the_same_mission_and_another_one_is_not() -> None:
    one, again = mission(Setup(mode="usv")), mission(Setup(mode="usv"))
    other = mission(Setup(mode="usv", seed=2))
    for made in (one, again, other):
        for _ in range(160):
            made.step()
    assert one.outcome() == again.outcome()
    assert one.outcome() != other.outcome()


@pytest.mark.parametrize("mode", ["uav", "ugv", "usv"])
def test_each_platform_alone_does_what_its_medium_allows(mode: str) -> None:
    outcome = mission(Setup(mode=mode)).run()
    assert not outcome.complete
    assert outcome.served >= {"uav": 0, "ugv": 1, "usv": 2}[mode]
    assert outcome.confirmed >= {"uav": 3, "ugv": 1, "usv": 2}[mode]
    assert outcome.coverage > {"uav": 0.85, "ugv": 0.25, "usv": 0.5}[mode]


def test_when_a_robot_dies_the_others_do_what_they_can() -> None:
    made = mission(Setup(deaths=(("usv1", 30.0),)))
    outcome = made.run()
    assert outcome.lost[0] == "usv1: killed at 30 s"
    assert {"casualty_2: not served", "casualty_3: not served"} <= set(outcome.lost)
    assert outcome.served == 2
    assert outcome.coverage >= 0.85
    manager = next(c for c in made.crews.values() if c.robot.member.manager.on_duty)
    records = manager.robot.member.follower.book.records
    open_records = {name: record for name, record in records.items() if not record.done_by}
    held = [name for name, record in open_records.items() if "usv1" in record.holders]
    assert not held, "what it held has been given to others, or to nobody"


def test_fixed_shares_are_searched_by_their_owners() -> None:
    made = mission(Setup(method="fixed"))
    for _ in range(60):
        made.step()
    records = made.crews["uav1"].robot.member.follower.book.records
    pieces = {name: record for name, record in records.items() if name.startswith("search/")}
    asked = [record.task.requirements for record in pieces.values()]
    assert all("only uav1" in text or "only usv1" in text for text in asked)
    assert any("only usv1" in text for text in asked)


def test_without_any_link_all_come_home() -> None:
    out = tuple((name, 0.0, 1e9) for name in names_of("joint"))
    made = mission(Setup(silences=out))
    outcome = made.run()
    assert outcome.served >= 1, "they do what they can on their own"
    for crew in made.crews.values():
        away = np.hypot(*np.subtract(crew.vehicle.place, crew.robot.home))
        assert away < 30.0 or outcome.complete


def test_people_are_served_by_who_stands_with_them_long_enough() -> None:
    truth = Truth(scene(), config(), 1)
    truth.people[0].found_s = 0.0
    lattice = scene().area.lattice
    row, column = lattice.cell(41.0, 31.0)
    view = View(np.array([row]), np.array([column]))
    ugv, usv = config().kinds["ugv"], config().kinds["usv"]
    for step in range(1, 41):
        truth.now_s = 0.5 * step
        present = {
            "ugv1": Presence(ugv, (42.0, 31.0), 0.0),
            "usv1": Presence(usv, (42.0, 31.0), 0.0),
        }
        truth.tend(present, {"ugv1": view, "usv1": view}, 0.5)
    assert truth.people[0].confirmed_s == 5.0
    assert truth.people[0].served_s == 20.0
    truth.people[0].served_s = None
    for step in range(41, 60):
        truth.now_s = 0.5 * step
        truth.tend({"ugv1": Presence(ugv, (42.0, 31.0), 2.0)}, {"ugv1": view}, 0.5)
    assert truth.people[0].served_s is None, "it drives past"


def test_all_kinds_have_eyes() -> None:
    assert set(SharedEyes(scene().area, config()).eyes) == set(config().kinds)
    assert all(len(set(names_of(mode))) == len(kinds) for mode, kinds in MODES.items())


@pytest.mark.parametrize(
    ("changed", "what"),
    [
        ({"mode": "two_uavs"}, "mode is 'two_uavs', legal: joint, uav"),
        ({"links": "radio"}, "links is 'radio', legal: network, perfect"),
        ({"method": "dice"}, "method is 'dice', legal: nearest"),
        ({"deaths": (("uav7", 1.0),)}, "robot is 'uav7', legal: uav1, ugv1, usv1"),
    ],
)
def test_unknown_names_are_refused(changed: dict[str, object], what: str) -> None:
    with pytest.raises(FormationError, match=what):
        mission(replace(Setup(), **changed))  # type: ignore[arg-type]
