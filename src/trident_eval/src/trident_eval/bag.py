# SPDX-FileCopyrightText: 2026 The Trident authors
# SPDX-License-Identifier: Apache-2.0
"""Recorded runs: odometry and commands of every vehicle in a rosbag."""

from __future__ import annotations

import re
import sys
import tempfile
from collections import defaultdict
from pathlib import Path
from typing import Any

import numpy as np

from trident_eval.core.errors import EvalError
from trident_eval.core.scene import Scene
from trident_eval.core.tracks import Array, Tracks
from trident_eval.recovery import copy_whole_messages

_ODOMETRY = re.compile(r"/(?P<name>.+)/(?P<source>odometry_sensor1|ground_truth)/odometry$")
_COMMAND = re.compile(r"/(?P<name>.+)/command/(trajectory|pose)$")
_FLEET = "/gazebo/fleet_state"
_PROGRESS_EVERY = 2000
LONGEST_GAP_S = 0.25

Samples = list[tuple[float, float, float, float]]


def read_bag(path: Path) -> Scene:
    """Read odometry and commands of every vehicle.

    Args:
        path: the bag. Topics `/<vehicle>/odometry_sensor1/odometry` (else `ground_truth/odometry`),
            `/<vehicle>/command/trajectory`, `/<vehicle>/command/pose`, `/gazebo/fleet_state`.

    Returns:
        The scene, at the odometry stamps of all vehicles; vehicles in order of their names. Where a
        vehicle has no odometry for longer than `LONGEST_GAP_S`, its position is NaN.

    Raises:
        EvalError: no readable bag, or no odometry in it.
    """
    import rosbag

    if path.exists() and not path.is_file():
        raise EvalError(f"{path}: no regular file; legal: a readable, closed rosbag")
    try:
        with rosbag.Bag(str(path)) as bag:
            return _read_open_bag(bag, path)
    except rosbag.ROSBagUnindexedException:
        return _read_unindexed(path)
    except EvalError:
        raise
    # A damaged bag makes its reader raise anything.
    except Exception as error:
        text = str(error) or type(error).__name__
        raise EvalError(f"{path}: {text}; legal: a readable, closed rosbag") from error


def _read_unindexed(path: Path) -> Scene:
    """What is whole of a recording that was never closed, or whose end is missing."""
    import rosbag

    print(f"{path}: has no index: what is whole of it is read", file=sys.stderr)
    with tempfile.TemporaryDirectory(prefix="trident-bag-") as folder:
        copy = Path(folder) / "copy.bag"
        copy_whole_messages(path, copy)
        with rosbag.Bag(str(copy)) as bag:
            return _read_open_bag(bag, path)


def _command_topics(topics: list[str]) -> dict[str, str]:
    """Vehicle of each topic of commands."""
    return {topic: match["name"] for topic in topics if (match := _COMMAND.match(topic))}


def _add_odometry(samples: Samples, message: Any) -> None:
    position = message.pose.pose.position
    samples.append((message.header.stamp.to_sec(), position.x, position.y, position.z))


def _read_open_bag(bag: Any, path: Path) -> Scene:
    topics = list(bag.get_type_and_topic_info().topics)
    odometry, commands = _odometry_topics(topics), _command_topics(topics)
    if not odometry:
        raise EvalError(
            f"{path}: no odometry; topics: {', '.join(topics) or 'none'}; legal:"
            " /<vehicle>/odometry_sensor1/odometry or /<vehicle>/ground_truth/odometry"
        )
    measured: dict[str, Samples] = defaultdict(list)
    fleet: dict[str, Samples] = defaultdict(list)
    commanded: dict[str, Samples] = defaultdict(list)
    wanted = [*odometry, *commands, _FLEET]
    total = bag.get_message_count(topic_filters=wanted)
    for count, (topic, message, _) in enumerate(bag.read_messages(topics=wanted)):
        _show_progress(count, total)
        if topic in odometry:
            _add_odometry(measured[odometry[topic]], message)
        elif topic == _FLEET:
            _add_fleet(fleet, message)
        else:
            _add_command(commanded[commands[topic]], message)
    _show_progress(total, total)
    return _scene(path, _complete(path, dict(measured), fleet), dict(commanded))


def _odometry_topics(topics: list[str]) -> dict[str, str]:
    """Topic -> vehicle, one topic for each vehicle."""
    chosen: dict[str, str] = {}
    for wanted in ("ground_truth", "odometry_sensor1"):
        for topic in topics:
            match = _ODOMETRY.match(topic)
            if match and match["source"] == wanted:
                chosen[match["name"]] = topic
    return {topic: name for name, topic in chosen.items()}


def _add_command(samples: Samples, message: Any) -> None:
    """A newer message replaces what older ones said about the time from its stamp on."""
    start = message.header.stamp.to_sec()
    while samples and samples[-1][0] >= start - 1e-9:
        samples.pop()
    if hasattr(message, "points"):
        for point in message.points:
            position = point.transforms[0].translation
            stamp = start + point.time_from_start.to_sec()
            samples.append((stamp, position.x, position.y, position.z))
    else:
        position = message.pose.position
        samples.append((start, position.x, position.y, position.z))


def _add_fleet(fleet: dict[str, Samples], message: Any) -> None:
    stamp = message.header.stamp.to_sec()
    for name, pose in zip(message.name, message.pose, strict=True):
        position = pose.position
        fleet[name].append((stamp, position.x, position.y, position.z))


def _complete(
    path: Path, measured: dict[str, Samples], fleet: dict[str, Samples]
) -> dict[str, Samples]:
    """The odometry, or the simulator's own states where a recorder has dropped too much of it.

    They are not mixed: odometry carries the stamp of the step after its state.
    """
    missing = {name: _missing_s(samples) for name, samples in measured.items()}
    if not any(missing.values()):
        return measured
    if all(name in fleet for name in measured):
        return {name: fleet[name] for name in measured}
    _warn_of_missing(path, missing)
    return measured


def _warn_of_missing(path: Path, missing: dict[str, float]) -> None:
    for name, seconds in sorted(missing.items()):
        if seconds:
            print(f"{path}: {seconds:.1f} s of the odometry of {name} are missing", file=sys.stderr)


def _missing_s(samples: Samples) -> float:
    gaps = np.diff(sorted(sample[0] for sample in samples))
    return float(gaps[gaps > LONGEST_GAP_S].sum())


def _scene(path: Path, measured: dict[str, Samples], commanded: dict[str, Samples]) -> Scene:
    names = sorted(measured)
    tables = {name: np.array(sorted(samples)) for name, samples in measured.items()}
    time = np.unique(np.concatenate([table[:, 0] for table in tables.values()]))
    position = np.stack([_interpolate(tables[name], time) for name in names], axis=1)
    command = None
    if commanded:
        command = np.stack([_hold(commanded.get(name, []), time) for name in names], axis=1)
    return Scene(title=path.name, tracks=Tracks(names, time, position), commanded=command)


def _interpolate(table: Array, time: Array) -> Array:
    """Positions at other times, shape (M, 3); NaN outside of the samples and in gaps."""
    columns = [np.interp(time, table[:, 0], table[:, axis], np.nan, np.nan) for axis in (1, 2, 3)]
    position = np.stack(columns, axis=1)
    after = np.searchsorted(table[:, 0], time).clip(1, max(len(table) - 1, 1))
    is_gap = (np.diff(table[:, 0], append=np.inf) > LONGEST_GAP_S)[after - 1]
    is_sample = np.isin(time, table[:, 0])
    position[is_gap & ~is_sample] = np.nan
    return position


def _hold(samples: Samples, time: Array) -> Array:
    """The set-point that is in effect at each time, shape (M, 3); NaN before the first one."""
    if not samples:
        return np.full((len(time), 3), np.nan)
    table = np.array(samples)
    index = np.searchsorted(table[:, 0], time + 1e-9, side="right") - 1
    return np.where(index[:, None] >= 0, table[np.maximum(index, 0), 1:], np.nan)


def _show_progress(count: int, total: int) -> None:
    if sys.stderr.isatty() and total and (count % _PROGRESS_EVERY == 0 or count == total):
        end = "\n" if count == total else ""
        print(f"\rreading {100 * count // total:3d} %", end=end, file=sys.stderr, flush=True)
