# SPDX-FileCopyrightText: 2026 The Trident authors
# SPDX-License-Identifier: Apache-2.0
from __future__ import annotations

import signal
import threading
from pathlib import Path

import numpy as np
import pytest
from conftest import BALL, DT_S, GRAVITY, WORLD

import trident_sim


def test_time_and_steps(world: trident_sim.World) -> None:
    world.step(7)
    assert (world.step_count, world.time_ns, world.time) == (7, 70_000_000, 0.07)
    world.step_until(0.095)
    assert world.time == 0.1
    world.step_until(0.05)
    assert world.time == 0.1
    world.step(0)
    assert world.step_count == 10


def test_facts_of_the_world(world: trident_sim.World) -> None:
    assert (world.name, world.dt, world.seed, len(world.models)) == ("tiny", DT_S, 0, 0)
    np.testing.assert_array_equal(world.gravity, [0.0, 0.0, -GRAVITY])


def test_free_fall_is_that_of_the_semi_implicit_integrator(world: trident_sim.World) -> None:
    ball = world.spawn(sdf=BALL, pose=(1.0, 2.0, 50.0))
    n = 100
    world.step(n)
    fallen = GRAVITY * DT_S**2 * n * (n + 1) / 2
    np.testing.assert_allclose(ball.position, [1.0, 2.0, 50.0 - fallen], rtol=1e-12)
    np.testing.assert_allclose(ball.linear_velocity, [0.0, 0.0, -GRAVITY * n * DT_S], rtol=1e-12)


def test_world_from_file_and_by_name_below_a_folder(tmp_path: Path) -> None:
    file = tmp_path / "small.world"
    file.write_text(WORLD, encoding="utf-8")
    assert trident_sim.World(file).name == "tiny"
    assert trident_sim.World("small.world", folders=[tmp_path]).name == "tiny"


def test_models_come_and_go(world: trident_sim.World) -> None:
    first = world.spawn("a", sdf=BALL)
    world.spawn("b", sdf=BALL)
    assert list(world.models) == ["a", "b"]
    assert "a" in world.models
    assert world.models["b"].name == "b"
    world.remove("a")
    assert list(world.models) == ["b"]
    with pytest.raises(trident_sim.Error, match="model 'a' is not in the world; there are: b"):
        _ = first.position
    world.spawn("a", sdf=BALL, pose=(0.0, 0.0, 3.0))
    assert first.position[2] == 3.0


def test_model_from_file(world: trident_sim.World, tmp_path: Path) -> None:
    file = tmp_path / "ball.sdf"
    file.write_text(BALL, encoding="utf-8")
    assert world.spawn(file=file).name == "ball"


def test_pose_forms(world: trident_sim.World) -> None:
    half = np.sqrt(0.5)
    ball = world.spawn(sdf=BALL, pose=(1, 2, 3))
    np.testing.assert_array_equal(ball.orientation, [0, 0, 0, 1])
    ball.set_pose((4, 5, 6, 0.0, 0.0, np.pi / 2))
    np.testing.assert_allclose(ball.position, [4, 5, 6])
    np.testing.assert_allclose(ball.orientation, [0, 0, half, half], atol=1e-15)
    ball.set_pose(np.array([7.0, 8.0, 9.0, half, 0.0, 0.0, half]))
    np.testing.assert_allclose(ball.orientation, [half, 0, 0, half], atol=1e-15)


def test_velocity_carries_the_model(world: trident_sim.World) -> None:
    ball = world.spawn(sdf=BALL, pose=(0, 0, 50))
    ball.set_velocity((1.0, 0.0, 0.0), (0.0, 0.0, 0.5))
    world.step(100)
    np.testing.assert_allclose(ball.position[:2], [1.0, 0.0], atol=1e-9)
    np.testing.assert_allclose(ball.angular_velocity, [0.0, 0.0, 0.5], atol=1e-9)


def test_wrench_accelerates_for_its_duration(world: trident_sim.World) -> None:
    ball = world.spawn(sdf=BALL, pose=(0, 0, 50))
    assert ball.mass == 2.0
    ball.link("body").apply_wrench((4.0, 0.0, 0.0), duration=0.1)
    world.step(50)
    np.testing.assert_allclose(ball.link("body").linear_velocity[0], 4.0 / 2.0 * 0.1, rtol=1e-12)
    ball.link("body").apply_wrench((4.0, 0.0, 0.0))
    world.step(10)
    ball.link("body").clear_wrenches()
    world.step(10)
    np.testing.assert_allclose(ball.linear_velocity[0], 0.4, rtol=1e-12)


def test_reset_goes_back_to_the_spawn_pose(world: trident_sim.World) -> None:
    ball = world.spawn(sdf=BALL, pose=(0, 0, 50))
    world.step(10)
    world.reset(time=False)
    assert (ball.position[2], world.step_count) == (50.0, 10)
    world.reset()
    assert (world.step_count, world.time) == (0, 0.0)


def test_views_keep_the_world_alive() -> None:
    ball = trident_sim.World(WORLD).spawn(sdf=BALL, pose=(0, 0, 5))
    assert ball.position[2] == 5.0


def test_returned_arrays_are_copies(world: trident_sim.World) -> None:
    ball = world.spawn(sdf=BALL)
    ball.position[0] = 99.0
    assert ball.position[0] == 0.0


def test_unknown_plugin_is_one_warning_and_the_model_loads(world: trident_sim.World) -> None:
    plugin = '<plugin name="mystery" filename="libmystery.so"/></model>'
    with pytest.warns(trident_sim.SimulationWarning, match="libmystery.so"):
        world.spawn(sdf=BALL.replace("</model>", plugin))
    assert [message.severity for message in world.messages] == ["warning"]
    assert "model 'ball'" in world.messages[0].text
    assert "ball" in world.models


def test_another_thread_is_refused_while_one_steps(world: trident_sim.World) -> None:
    world.spawn(sdf=BALL)
    seen, failures = threading.Event(), []

    def step() -> None:
        try:
            while not seen.is_set():
                world.step(5000)
        except trident_sim.Error as error:
            failures.append(str(error))

    thread = threading.Thread(target=step)
    thread.start()
    try:
        while thread.is_alive():
            _ = world.time
    except trident_sim.Error as error:
        failures.append(str(error))
    finally:
        seen.set()
        thread.join()
    assert failures == ["the world is in use by another thread: one thread at a time"]
    assert world.step_count > 0


def test_a_signal_ends_a_long_step(world: trident_sim.World) -> None:
    def interrupt(*_: object) -> None:
        raise KeyboardInterrupt

    previous = signal.signal(signal.SIGALRM, interrupt)
    try:
        signal.setitimer(signal.ITIMER_REAL, 0.02)
        with pytest.raises(KeyboardInterrupt):
            world.step(10**12)
    finally:
        signal.setitimer(signal.ITIMER_REAL, 0.0)
        signal.signal(signal.SIGALRM, previous)
    before = world.step_count
    world.step()
    assert world.step_count == before + 1
