# SPDX-FileCopyrightText: 2026 The Trident authors
# SPDX-License-Identifier: Apache-2.0
"""From messages to entities: where in the tree, at which simulated time, and what."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from typing import Any

import rerun as rr

from trident_viewer.to_rerun import archetypes
from trident_viewer.to_rerun.frames import EntityPath, FrameTree, plain
from trident_viewer.to_rerun.trail import Trail

WORLD = "world"
"""Root of the models' true poses; odometry and maps have roots of their own."""
_SETTLE_S = 0.2  # a tree of frames that grew is looked at so much later: it may grow on
_POSES_PERIOD_S = 0.02  # poses come at every step
_AXES_M = 0.25


@dataclass(frozen=True)
class Item:
    """One thing to be shown.

    Attributes:
        path: of the entity.
        stamp_s: simulated time from which on it is so [s]; None: always.
        content: an archetype of rerun.
    """

    path: EntityPath
    stamp_s: float | None
    content: Any


@dataclass(frozen=True)
class _Edge:
    """A geometry_msgs/Transform and the simulated time from which on it holds; None: always."""

    stamp_s: float | None
    transform: Any


def dotted(topic: str) -> str:
    """A topic as one part of a path."""
    return topic.strip("/").replace("/", ".")


class Converter:
    """Keeps what messages need from others before them: frames, cameras, what was shown last."""

    def __init__(self) -> None:
        """Nothing is known."""
        self.frames = FrameTree()
        self._cameras: set[str] = set()
        self._infos: dict[str, tuple[float, ...]] = {}
        self._trails: dict[str, Trail] = {}
        self._poses: dict[str, tuple[float, ...]] = {}
        self._poses_s: float | None = None
        self._edges: list[tuple[str, _Edge]] = []  # child and edge; not shown yet
        self._static: dict[str, _Edge] = {}
        self._placed_s: float | None = None
        self._roots: set[str] = set()
        self._begin_s: float | None = None
        self._in_frames: dict[str, Callable[[str, Any, float], list[Item]]] = {
            "nav_msgs/Odometry": self._odometry,
            "sensor_msgs/CameraInfo": self._camera_info,
            "sensor_msgs/Image": self._in_camera(archetypes.of_image),
            "trident_msgs/BoundingBoxes": self._in_camera(archetypes.of_boxes),
            "sensor_msgs/LaserScan": self._in_frame(archetypes.of_scan),
            "sensor_msgs/PointCloud2": self._in_frame(archetypes.of_cloud),
            "nav_msgs/OccupancyGrid": self._in_frame(archetypes.of_grid),
            "nav_msgs/Path": self._in_frame(archetypes.of_path),
        }
        self._functions: dict[str, Callable[[str, Any, float], list[Item]]] = {
            **self._in_frames,
            "tf2_msgs/TFMessage": self._transforms,
            "gazebo_msgs/ModelStates": self._models,
            "rosgraph_msgs/Log": self._log,
        }

    @property
    def types(self) -> frozenset[str]:
        """The types of messages that are understood."""
        return frozenset(self._functions)

    def has_to_wait(self, kind: str, now_s: float) -> bool:
        """Whether a message of that type is in a frame, and frames may still find a parent.

        Shown at once it would stand at a path that it does not keep.
        """
        return kind in self._in_frames and not self.is_settled(now_s)

    def know_camera(self, info_topic: str) -> None:
        """Pictures in the namespace of this CameraInfo are that camera's."""
        self._cameras.add(info_topic.rpartition("/")[0])

    def items(self, topic: str, kind: str, message: Any, now_s: float) -> list[Item]:
        """What a message shows.

        Args:
            topic: its topic.
            kind: its type, one of `types`.
            message: itself.
            now_s: the simulated time, for messages without a stamp [s].

        Raises:
            EvalError: the message contradicts itself or is of a kind that cannot be shown.
        """
        return [*self._known_transforms(now_s), *self._functions[kind](topic, message, now_s)]

    def is_settled(self, now_s: float) -> bool:
        """Whether frames are where they will stay, as far as is known."""
        if self._begin_s is None or now_s < self._begin_s:
            self._begin_s = now_s
        changed_s = self.frames.changed_s
        last_s = self._begin_s if changed_s is None else max(changed_s, self._begin_s)
        return now_s - last_s >= _SETTLE_S or now_s < last_s

    def _placed(
        self, frame: str, parts: EntityPath, stamp_s: float | None, content: Any
    ) -> list[Item]:
        path = self.frames.path(frame)
        return [*self._root(path[0]), Item((*path, *parts), stamp_s, content)]

    def _root(self, name: str) -> list[Item]:
        """The view coordinates, once: which axis is up."""
        if name in self._roots:
            return []
        self._roots.add(name)
        return [Item((name,), None, rr.ViewCoordinates.RIGHT_HAND_Z_UP)]

    def _in_frame(self, convert: Callable[[Any], Any]) -> Callable[[str, Any, float], list[Item]]:
        """Of a message with a header: at its frame, named for its topic."""

        def items(topic: str, message: Any, _now_s: float) -> list[Item]:
            header = message.header
            stamp_s = header.stamp.to_sec()
            return self._placed(header.frame_id, (dotted(topic),), stamp_s, convert(message))

        return items

    def _in_camera(self, convert: Callable[[Any], Any]) -> Callable[[str, Any, float], list[Item]]:
        """Of a picture: below the camera whose namespace it is in."""

        def items(topic: str, message: Any, _now_s: float) -> list[Item]:
            parts = self._camera_path(topic)
            header = message.header
            return self._placed(header.frame_id, parts, header.stamp.to_sec(), convert(message))

        return items

    def _camera_path(self, topic: str) -> EntityPath:
        name = topic.rpartition("/")[0]
        while name and name not in self._cameras:
            name = name.rpartition("/")[0]
        camera = name or topic.rpartition("/")[0]
        return (dotted(camera), dotted(topic[len(camera) :]))

    def _camera_info(self, topic: str, info: Any, _now_s: float) -> list[Item]:
        path = self.frames.path(info.header.frame_id)
        seen = (*info.K, info.width, info.height)
        key = "/".join((*path, topic))
        pinhole = archetypes.of_camera_info(info)
        if pinhole is None or self._infos.get(key) == seen:
            return []
        self._infos[key] = seen
        camera = dotted(topic.rpartition("/")[0])
        return self._placed(info.header.frame_id, (camera,), info.header.stamp.to_sec(), pinhole)

    def _transforms(self, topic: str, message: Any, now_s: float) -> list[Item]:
        is_static = topic.endswith("static")
        for transform in message.transforms:
            self.frames.add(transform.header.frame_id, transform.child_frame_id, now_s)
            stamp_s = None if is_static else transform.header.stamp.to_sec()
            edge = _Edge(stamp_s, transform.transform)
            self._edges.append((plain(transform.child_frame_id), edge))
        return self._known_transforms(now_s)

    def _known_transforms(self, now_s: float) -> list[Item]:
        """Those that have not been shown, or not where their frame is now."""
        if not self._edges or not self.is_settled(now_s):
            return []
        items = []
        if self._placed_s != self.frames.changed_s:
            self._placed_s = self.frames.changed_s
            self._edges = [*self._static.items(), *self._edges]
        for child, edge in self._edges:
            if edge.stamp_s is None:
                self._static[child] = edge
            items += self._placed(child, (), edge.stamp_s, archetypes.of_transform(edge.transform))
        self._edges.clear()
        return items

    def _models(self, _topic: str, states: Any, now_s: float) -> list[Item]:
        if self._poses_s is not None and 0.0 <= now_s - self._poses_s < _POSES_PERIOD_S:
            return []
        self._poses_s = now_s
        items = self._root(WORLD)
        for name, pose in zip(states.name, states.pose, strict=True):
            p, q = pose.position, pose.orientation
            place = (p.x, p.y, p.z, q.x, q.y, q.z, q.w)
            if self._poses.get(name) == place:
                continue  # what is shown stays
            is_new = name not in self._poses
            self._poses[name] = place
            items.append(Item((WORLD, name), now_s, archetypes.of_pose(pose, _AXES_M)))
            if is_new:
                label = rr.Points3D([[0.0, 0.0, 0.0]], labels=[name], radii=[0.0])
                items.append(Item((WORLD, name, "name"), None, label))
        return items

    def _odometry(self, topic: str, odometry: Any, _now_s: float) -> list[Item]:
        place = odometry.pose.pose.position
        trail = self._trails.setdefault(topic, Trail())
        if not trail.add(place.x, place.y, place.z):
            return []
        stamp_s = odometry.header.stamp.to_sec()
        line = archetypes.of_trail(trail.places)
        return self._placed(odometry.header.frame_id, (dotted(topic),), stamp_s, line)

    def _log(self, _topic: str, log: Any, _now_s: float) -> list[Item]:
        path = ("log", dotted(log.name))
        return [Item(path, log.header.stamp.to_sec(), archetypes.of_log(log))]
