# SPDX-FileCopyrightText: 2026 The Trident authors
# SPDX-License-Identifier: Apache-2.0
"""What a vehicle looks like: the visuals of a URDF, placed in its base."""

from __future__ import annotations

import xml.etree.ElementTree as ElementTree
from dataclasses import dataclass

import numpy as np
from trident_eval.core.errors import EvalError
from trident_eval.core.tracks import Array

MESH, BOX, CYLINDER, SPHERE = "mesh", "box", "cylinder", "sphere"


@dataclass(frozen=True)
class Visual:
    """One visible shape.

    Attributes:
        kind: `MESH`, `BOX`, `CYLINDER` or `SPHERE`.
        T_base_shape: pose in the root link, joints at zero, shape (4, 4) [m].
        scale: of a mesh; else the extent along x, y, z [m].
        resource: URI of a mesh; else "".
        color: red, green, blue, alpha; None: that of the mesh.
    """

    kind: str
    T_base_shape: Array
    scale: tuple[float, float, float]
    resource: str = ""
    color: tuple[float, float, float, float] | None = None


def visuals_of(urdf: str) -> list[Visual]:
    """The shapes of a URDF, in the order of the file.

    Raises:
        EvalError: it is not a URDF.
    """
    try:
        robot = ElementTree.fromstring(urdf)
        places = _link_poses(robot)
        colors = {
            material.get("name"): _color(material)
            for material in robot.iter("material")
            if material.find("color") is not None
        }
        return [
            _visual(visual, places[link.get("name", "")], colors)
            for link in robot.findall("link")
            for visual in link.findall("visual")
        ]
    except (ElementTree.ParseError, KeyError, TypeError, ValueError) as error:
        raise EvalError(f"robot_description: {error}; legal: a URDF") from error


def rotation(roll: float, pitch: float, yaw: float) -> Array:
    """Rotation matrix of fixed-axis angles [rad], shape (3, 3)."""
    cr, cp, cy = np.cos([roll, pitch, yaw])
    sr, sp, sy = np.sin([roll, pitch, yaw])
    return np.array(
        [
            [cy * cp, cy * sp * sr - sy * cr, cy * sp * cr + sy * sr],
            [sy * cp, sy * sp * sr + cy * cr, sy * sp * cr - cy * sr],
            [-sp, cp * sr, cp * cr],
        ]
    )


def _parents(robot: ElementTree.Element) -> dict[str, tuple[str, Array]]:
    """Parent and T_parent_child of every link that has one, joints at zero."""
    up = {}
    for joint in robot.findall("joint"):
        parent, child = joint.find("parent"), joint.find("child")
        if parent is not None and child is not None:
            up[child.get("link", "")] = (parent.get("link", ""), _origin(joint))
    return up


def _link_poses(robot: ElementTree.Element) -> dict[str, Array]:
    """T_base_link of every link, joints at zero."""
    up = _parents(robot)
    poses = {}
    for link in robot.findall("link"):
        name = link.get("name", "")
        pose, at = np.eye(4), name
        for _ in range(len(up) + 1):
            if at not in up:
                break
            at, T_parent_child = up[at]
            pose = T_parent_child @ pose
        else:
            raise ValueError(f"link {name!r} is its own ancestor")
        poses[name] = pose
    return poses


def _origin(element: ElementTree.Element) -> Array:
    pose = np.eye(4)
    origin = element.find("origin")
    if origin is not None:
        pose[:3, :3] = rotation(*_numbers(origin.get("rpy", "0 0 0")))
        pose[:3, 3] = _numbers(origin.get("xyz", "0 0 0"))
    return pose


def _visual(
    visual: ElementTree.Element,
    T_base_link: Array,
    colors: dict[str | None, tuple[float, float, float, float]],
) -> Visual:
    geometry = visual.find("geometry")
    if geometry is None or not len(geometry):
        raise ValueError("a visual has no geometry")
    shape = geometry[0]
    material = visual.find("material")
    color = None if material is None else colors.get(material.get("name"))
    pose = T_base_link @ _origin(visual)
    if shape.tag == MESH:
        scale = _numbers(shape.get("scale", "1 1 1"))
        return Visual(MESH, pose, scale, shape.get("filename", ""), color)
    return Visual(shape.tag, pose, _extent(shape), color=color)


def _extent(shape: ElementTree.Element) -> tuple[float, float, float]:
    if shape.tag == BOX:
        return _numbers(shape.get("size"))
    if shape.tag not in (CYLINDER, SPHERE):
        raise ValueError(f"geometry {shape.tag!r} is not known")
    width = 2.0 * float(shape.get("radius", "nan"))
    return width, width, float(shape.get("length", "nan")) if shape.tag == CYLINDER else width


def _color(material: ElementTree.Element) -> tuple[float, float, float, float]:
    element = material.find("color")
    words = (element.get("rgba") if element is not None else None) or "0.5 0.5 0.5 1"
    red, green, blue, alpha = (float(word) for word in words.split())
    return red, green, blue, alpha


def _numbers(text: str | None) -> tuple[float, float, float]:
    x, y, z = (float(word) for word in (text or "").split())
    return x, y, z
