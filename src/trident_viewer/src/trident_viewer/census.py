# SPDX-FileCopyrightText: 2026 The Trident authors
# SPDX-License-Identifier: Apache-2.0
"""What is in a running simulation, where, and about how large."""

from __future__ import annotations

import math
import re
from collections.abc import Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np
import rospy
from gazebo_msgs.srv import (
    GetLinkProperties,
    GetLinkState,
    GetModelProperties,
    GetModelState,
    GetWorldProperties,
)
from trident_eval.core.errors import EvalError

from trident_ros import point_problem
from trident_viewer.framing import Sphere

_SERVICE_LIMIT_S = 300.0
_MAX_MODELS = 5000  # each costs two calls and some more
_MAX_LINKS = 12  # that are asked for their size
_MIN_RADIUS_M = 0.12
_SCENERY_RADIUS_M = 1.0  # of what stands still nobody knows the size
_SHAPE = 0.7  # of the half diagonal: most of a vehicle is nearer to its middle than a box would be
_LIGHT = 0.02  # of the heaviest link
# The ground has no place, and cameras of viewers are no part of what they see.
_NO_FEATURE = re.compile(r"ground(_?plane)?|sun|sea|ocean|(observer|scouts)_\d+")


def models_in_the_world() -> list[Sphere]:
    """Every model but the ground, those that move first.

    Raises:
        EvalError: there is no simulator, or more models than can be asked about.
    """
    try:
        rospy.wait_for_service("/gazebo/get_world_properties", _SERVICE_LIMIT_S)
        with _Simulator() as simulator:
            found = _spheres(simulator)
    except (rospy.ROSException, rospy.ServiceException) as error:
        raise EvalError(f"no simulator: {error}") from error
    return sorted(found, key=lambda s: (not s.has_joints, not s.moves))


def _spheres(simulator: _Simulator) -> list[Sphere]:
    names = simulator.world().model_names
    if len(names) > _MAX_MODELS:
        raise EvalError(f"{len(names)} models in the world, legal: up to {_MAX_MODELS}")
    features = [name for name in names if not _NO_FEATURE.fullmatch(name.lower())]
    found = [_sphere(simulator, name) for name in features]
    return [sphere for sphere in found if sphere is not None]


class _Simulator:
    """The services that are asked, while it is entered.

    Each over one connection: a fleet of a hundred vehicles is some thousand calls, and a look-up at
    the master and a new connection cost more than the answer.
    """

    def __init__(self) -> None:
        self.world = _service("get_world_properties", GetWorldProperties)
        self.model = _service("get_model_properties", GetModelProperties)
        self.model_state = _service("get_model_state", GetModelState)
        self.link = _service("get_link_properties", GetLinkProperties)
        self.link_state = _service("get_link_state", GetLinkState)

    def __enter__(self) -> _Simulator:
        return self

    def __exit__(self, *_: object) -> None:
        for service in (self.world, self.model, self.model_state, self.link, self.link_state):
            service.close()


def _service(name: str, kind: Any) -> rospy.ServiceProxy:
    return rospy.ServiceProxy(f"/gazebo/{name}", kind, persistent=True)


def _sphere(simulator: _Simulator, name: str) -> Sphere | None:
    """A model's sphere; None for one that has gone, or whose place is illegal."""
    model, state = simulator.model(name), simulator.model_state(name, "")
    if not (model.success and state.success):
        return None
    at = state.pose.position
    if point_problem("position", at):
        return None
    center = (at.x, at.y, at.z)
    radius_m = _SCENERY_RADIUS_M
    if not model.is_static:
        radius_m = _radius(simulator, name, model.body_names, center)
    return Sphere(name, center, radius_m, not model.is_static, bool(model.joint_names))


def _radius(
    simulator: _Simulator, name: str, links: list[str], center: tuple[float, float, float]
) -> float:
    bodies: list[Body] = []
    for link in links[:_MAX_LINKS]:
        full_name = link if "::" in link else f"{name}::{link}"
        state, of_link = simulator.link_state(full_name, ""), simulator.link(full_name)
        if state.success and of_link.success:
            at = state.link_state.pose.position
            moments = (of_link.ixx, of_link.iyy, of_link.izz)
            bodies.append(Body(math.dist((at.x, at.y, at.z), center), of_link.mass, moments))
    return radius_of(bodies)


@dataclass(frozen=True)
class Body:
    """A link: its distance from the model's origin [m], mass [kg], moments of inertia [kg m^2]."""

    away_m: float
    mass_kg: float
    moments: tuple[float, float, float]


def radius_of(bodies: Sequence[Body]) -> float:
    """Of a sphere around the model's origin that holds about all of its links [m].

    What weighs nearly nothing has moments that keep a solver happy, and give no size.
    """
    heaviest = max((body.mass_kg for body in bodies), default=0.0)
    reach_m = [
        body.away_m + (_SHAPE * _half_diagonal(body) if body.mass_kg > _LIGHT * heaviest else 0.0)
        for body in bodies
    ]
    return max([_MIN_RADIUS_M, *(reach for reach in reach_m if math.isfinite(reach))])


def _half_diagonal(body: Body) -> float:
    """Of a box with this mass and these moments of inertia: m (y^2 + z^2) / 12 = Ixx [m]."""
    if not body.mass_kg > 0.0:
        return 0.0
    ixx, iyy, izz = body.moments
    squares = 6.0 / body.mass_kg * np.array([iyy + izz - ixx, ixx + izz - iyy, ixx + iyy - izz])
    return 0.5 * math.sqrt(float(np.maximum(squares, 0.0).sum()))
