# SPDX-FileCopyrightText: 2026 The Trident authors
# SPDX-License-Identifier: Apache-2.0
"""What is in a running simulation, where, and about how large."""

from __future__ import annotations

import math
import re
from collections.abc import Sequence
from dataclasses import dataclass

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
_MOST_MODELS = 5000  # each costs two calls and some more
_MOST_LINKS = 12  # that are asked for their size
_LEAST_RADIUS_M = 0.12
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
        names = rospy.ServiceProxy("/gazebo/get_world_properties", GetWorldProperties)().model_names
        if len(names) > _MOST_MODELS:
            raise EvalError(f"{len(names)} models in the world, legal: up to {_MOST_MODELS}")
        found = [_sphere(name) for name in names if not _NO_FEATURE.fullmatch(name.lower())]
    except (rospy.ROSException, rospy.ServiceException) as error:
        raise EvalError(f"no simulator: {error}") from error
    return sorted(
        (s for s in found if s is not None), key=lambda s: (not s.has_joints, not s.moves)
    )


def _sphere(name: str) -> Sphere | None:
    """A model's sphere; None for one that has gone, or whose place is none."""
    model = rospy.ServiceProxy("/gazebo/get_model_properties", GetModelProperties)(name)
    state = rospy.ServiceProxy("/gazebo/get_model_state", GetModelState)(name, "")
    if not (model.success and state.success):
        return None
    at = state.pose.position
    if point_problem("position", at):
        return None
    centre = (at.x, at.y, at.z)
    radius_m = _SCENERY_RADIUS_M if model.is_static else _radius(name, model.body_names, centre)
    return Sphere(name, centre, radius_m, not model.is_static, bool(model.joint_names))


def _radius(name: str, links: list[str], centre: tuple[float, float, float]) -> float:
    state_of = rospy.ServiceProxy("/gazebo/get_link_state", GetLinkState)
    properties_of = rospy.ServiceProxy("/gazebo/get_link_properties", GetLinkProperties)
    bodies: list[Body] = []
    for link in links[:_MOST_LINKS]:
        full_name = link if "::" in link else f"{name}::{link}"
        state, of_link = state_of(full_name, ""), properties_of(full_name)
        if state.success and of_link.success:
            at = state.link_state.pose.position
            moments = (of_link.ixx, of_link.iyy, of_link.izz)
            bodies.append(Body(math.dist((at.x, at.y, at.z), centre), of_link.mass, moments))
    return radius_of(bodies)


@dataclass(frozen=True)
class Body:
    """A link: its distance from the model's origin [m], mass [kg], moments of inertia [kg m^2]."""

    away_m: float
    mass_kg: float
    moments: tuple[float, float, float]


def radius_of(bodies: Sequence[Body]) -> float:
    """Of a sphere around the model's origin that holds about all of its links [m].

    What weighs nearly nothing has moments that keep a solver happy, and tell no size.
    """
    heaviest = max((body.mass_kg for body in bodies), default=0.0)
    reach_m = [
        body.away_m + (_SHAPE * _half_diagonal(body) if body.mass_kg > _LIGHT * heaviest else 0.0)
        for body in bodies
    ]
    return max([_LEAST_RADIUS_M, *(reach for reach in reach_m if math.isfinite(reach))])


def _half_diagonal(body: Body) -> float:
    """Of a box with this mass and these moments of inertia: m (y^2 + z^2) / 12 = Ixx [m]."""
    if not body.mass_kg > 0.0:
        return 0.0
    ixx, iyy, izz = body.moments
    squares = 6.0 / body.mass_kg * np.array([iyy + izz - ixx, ixx + izz - iyy, ixx + iyy - izz])
    return 0.5 * math.sqrt(float(np.maximum(squares, 0.0).sum()))
