# SPDX-FileCopyrightText: 2026 The Trident authors
# SPDX-License-Identifier: Apache-2.0
"""The simulated world: models, ports and time."""

from __future__ import annotations

import difflib
import math
import os
import warnings
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import NamedTuple

import numpy as np
import numpy.typing as npt

from trident_sim._core import (
    Drive,
    Error,
    Message,
    Model,
    Port,
    Session,
    Snapshot,
    cast_rays,
    find_resource,
    ray_shapes,
    restore_snapshot,
    save_snapshot,
    sea_elevation,
)
from trident_sim.radio import Radio

_NS_PER_S = 1_000_000_000

FilePath = str | os.PathLike[str]
PoseLike = Sequence[float] | npt.NDArray[np.float64]
"""x y z, x y z roll pitch yaw, or x y z qx qy qz qw, in the world frame [m, rad]."""


class ShapeName(NamedTuple):
    """Whose shape a ray has hit.

    Attributes:
        model: name of the model.
        link: name of the link in it.
        name: of the collision or visual in the link.
    """

    model: str
    link: str
    name: str


@dataclass(frozen=True)
class RayHits:
    """What n rays hit first.

    Attributes:
        distance: along each ray [m], shape (n,); inf: nothing.
        normal: of the surface, of unit length, against the ray, in the world frame, shape (n, 3);
            zero: nothing.
        shape: index into `shapes`, shape (n,); -1: nothing.
        shapes: all that rays can hit.
    """

    distance: npt.NDArray[np.float64]
    normal: npt.NDArray[np.float64]
    shape: npt.NDArray[np.int64]
    shapes: list[ShapeName]


class SimulationWarning(UserWarning):
    """Something went wrong in the world and did not stop it."""


class Models(Mapping[str, Model]):
    """The models of a world by name, in name order."""

    def __init__(self, session: Session) -> None:
        self._session = session

    def __getitem__(self, name: str) -> Model:
        if not self._session.has_model(name):
            raise KeyError(f"model '{name}' is not in the world; there are: {', '.join(self)}")
        return Model(self._session, name)

    def __iter__(self) -> Iterator[str]:
        return iter(self._session.model_names())

    def __len__(self) -> int:
        return len(self._session.model_names())

    def __repr__(self) -> str:
        return f"<trident_sim models: {', '.join(self)}>"


class Ports(Mapping[str, Port]):
    """The ports of a world by full name, e.g. `UAV1/odometry_sensor1/odometry`, in name order."""

    def __init__(self, session: Session) -> None:
        self._session = session

    def __getitem__(self, name: str) -> Port:
        if not self._session.has_port(name):
            near = difflib.get_close_matches(str(name), list(self), n=5, cutoff=0.4)
            raise KeyError(
                f"port '{name}' is not in the world; similar: {', '.join(near) or 'none'}"
            )
        return Port(self._session, name)

    def __iter__(self) -> Iterator[str]:
        return iter(sorted(self._session.port_names()))

    def __len__(self) -> int:
        return len(self._session.port_names())

    def __repr__(self) -> str:
        return f"<trident_sim ports: {', '.join(self)}>"


class World:
    """A world of its own in this process; the same input gives the same states to the bit.

    One thread at a time may use it. Stepping lets other Python threads run.

    Attributes:
        models: the models by name.
        ports: the ports by name.
    """

    def __init__(
        self,
        world: FilePath,
        *,
        seed: int = 0,
        timing: str = "rotors",
        folders: Sequence[FilePath] = (),
        plugins: Sequence[FilePath] = (),
        sensor_threads: int = 1,
        strict: bool | None = None,
    ) -> None:
        """Load a world.

        Args:
            world: path of an SDF file, a URI (`model://`, `package://`, `file://`), a name below
                one of the search folders, or the text of an SDF file.
            seed: of all random numbers, 0 or more.
            timing: `rotors`: measurements and commands are delayed as on Gazebo with RotorS: the
                command computed from the state of step k acts as step k + 3 begins; `direct`: it
                acts in step k + 1.
            folders: searched for files before GAZEBO_MODEL_PATH, GAZEBO_RESOURCE_PATH and
                ROS_PACKAGE_PATH.
            plugins: shared objects that hold plugins, besides those that are built in.
            sensor_threads: threads that share the work of lidars and cameras, 1 to 256; what these
                measure does not depend on it.
            strict: whether an element that cannot be used is an error; otherwise it is left out,
                with a message. None: as TRIDENT_STRICT says, by default not.

        Raises:
            Error: the world cannot be found or read, or an argument is illegal.
        """
        if not 0 <= seed < 2**64:
            raise Error(f"seed is {seed}, legal: 0 to 2^64 - 1")
        if not 1 <= sensor_threads <= 256:
            raise Error(f"sensor_threads is {sensor_threads}, legal: 1 to 256")
        self._reported = 0
        self._session = Session(
            os.fspath(world),
            seed,
            timing,
            [*map(_path, folders)],
            [*map(_path, plugins)],
            sensor_threads,
            _is_set("TRIDENT_STRICT") if strict is None else strict,
        )
        self._folders = [*map(_path, folders)]
        self.models = Models(self._session)
        self.ports = Ports(self._session)
        self._warn()

    def spawn(
        self,
        name: str = "",
        *,
        urdf: str | None = None,
        sdf: str | None = None,
        file: FilePath | None = None,
        namespace: str | None = None,
        pose: PoseLike = (0.0, 0.0, 0.0),
    ) -> Model:
        """Put a model into the world.

        Args:
            name: of the model; "": the name in the file.
            urdf: text of a URDF. Exactly one of `urdf`, `sdf` and `file` has to be given.
            sdf: text of an SDF.
            file: path or URI of a URDF or SDF file.
            namespace: prefix of the ports of plugins that do not name one; by default `name`.
            pose: of the model in the world [m, rad], shape (3,), (6,) or (7,).

        Returns:
            The model.

        Raises:
            Error: a bad model, or one of that name is there already. The world is as before.
        """
        given = [source for source in (urdf, sdf, file) if source is not None]
        if len(given) != 1:
            raise Error(f"spawn of '{name}': {len(given)} of urdf, sdf, file given, legal: one")
        label = ""
        text = urdf if urdf is not None else sdf
        if text is None:
            label = find_resource(os.fspath(given[0]), self._folders)
            text = _read(label)
        prefix = (name if namespace is None else namespace).strip("/")
        spawned = self._session.spawn(name, text, label, prefix, pose)
        self._warn()
        return Model(self._session, spawned)

    def remove(self, name: str) -> None:
        """Take a model out of the world.

        Raises:
            Error: there is no such model.
        """
        self._session.remove(name)

    def model(self, name: str) -> Model:
        """The model of that name.

        Raises:
            Error: there is no such model; the text lists those that are there.
        """
        return Model(self._session, name)

    def step(self, n: int = 1) -> None:
        """Advance by n steps of `dt`.

        A problem that does not stop the world is added to `messages` and warned of.

        Raises:
            Error: n is negative.
        """
        if n < 0:
            raise Error(f"step: n is {n}, legal: 0 or more")
        self._session.step(n)
        if self._session.message_count != self._reported:
            self._warn()

    def step_until(self, time: float) -> None:
        """Advance to the first step that ends at or after a time [s]; none if that is past."""
        left_ns = round(time * _NS_PER_S) - self._session.time_ns
        self.step(max(0, -(-left_ns // self._session.dt_ns)))

    def reset(self, *, time: bool = True) -> None:
        """All models as they were spawned.

        The same commands afterwards give the same states as the first time.

        Args:
            time: whether time begins at zero again.
        """
        self._session.reset(time)

    def save_snapshot(self) -> Snapshot:
        """The whole state as it is now: bodies, joints, plugins with their noise, ports, time."""
        return save_snapshot(self._session)

    def restore_snapshot(self, snapshot: Snapshot) -> None:
        """Go back to a state of this world, any number of times.

        The same commands afterwards give the same states, to the bit, as they did then.

        Raises:
            Error: models or ports have come or gone since then; the world is as before.
        """
        restore_snapshot(self._session, snapshot)

    def drive(
        self,
        model: str,
        joint: str,
        mode: str = "position",
        *,
        target: float = 0.0,
        p: float = 0.0,
        i: float = 0.0,
        d: float = 0.0,
        integral_limit: float = math.inf,
        effort_limit: float = math.inf,
        axis: int = 0,
    ) -> Drive:
        """Drive an axis of a joint from now on, in place of a drive that it has.

        Args:
            model: name of the model.
            joint: name of the joint in it.
            mode: what the target is: `position` [rad] or [m], `velocity` [rad/s] or [m/s], or
                `effort` [N m] or [N].
            target: at first, and after a reset.
            p: effort per error.
            i: effort per error and second.
            d: effort per rate of the error; in `position` mode per rate of the joint.
            integral_limit: of the effort of the i term.
            effort_limit: of the whole effort; the joint's own limit holds as well.
            axis: 0, or 1 for the second axis of a universal joint or a gearbox.

        Returns:
            The drive; its `target` can be set at any time between two steps.

        Raises:
            Error: there is no such joint or axis, or a value is illegal.
        """
        if axis < 0:
            raise Error(f"drive of joint '{joint}': axis is {axis}, legal: 0 or 1")
        gains = {
            "p": p,
            "i": i,
            "d": d,
            "integral_limit": integral_limit,
            "effort_limit": effort_limit,
        }
        return Drive(self._session, model, joint, mode, target, gains, axis)

    def cast_rays(
        self,
        origins: npt.ArrayLike,
        directions: npt.ArrayLike,
        *,
        max_distance: float = math.inf,
        visual: bool = False,
    ) -> RayHits:
        """What rays hit in the world as it is now, its sea as it is about the first origin.

        Args:
            origins: where each begins, in the world frame [m], shape (n, 3).
            directions: of any length but zero, in the world frame, shape (n, 3).
            max_distance: what is farther is not hit [m].
            visual: look for what cameras see, not for what bodies touch.

        Raises:
            Error: a wrong shape, a value that is not finite, or a direction of length zero.
        """
        hits = cast_rays(
            self._session, np.asarray(origins), np.asarray(directions), max_distance, visual
        )
        names = [ShapeName(*shape) for shape in ray_shapes(self._session, visual)]
        self._warn()
        return RayHits(*hits, names)

    def sea_elevation(self, places: npt.ArrayLike, times: npt.ArrayLike) -> npt.NDArray[np.float64]:
        """Height of the sea's surface, at any time: the sea is a function of place and time.

        Args:
            places: x and y in the world frame [m], shape (n, 2).
            times: one per place [s], shape (n,).

        Returns:
            z of the surface in the world frame [m], shape (n,); 0 in a world without a sea.

        Raises:
            Error: a wrong shape, or a value that is not finite.
        """
        return sea_elevation(self._session, np.asarray(places), np.asarray(times))

    @property
    def radio(self) -> Radio:
        """The radios of its robots.

        Raises:
            Error: the world has no libtrident_radio_medium.so.
        """
        return Radio(self._session)

    @property
    def time(self) -> float:
        """Simulated time [s]."""
        return self._session.time_ns / _NS_PER_S

    @property
    def time_ns(self) -> int:
        """Simulated time, exact [ns]."""
        return self._session.time_ns

    @property
    def dt(self) -> float:
        """Length of a step [s]."""
        return self._session.dt_ns / _NS_PER_S

    @property
    def step_count(self) -> int:
        """Steps since time zero."""
        return self._session.step_count

    @property
    def seed(self) -> int:
        """Seed of all random numbers."""
        return self._session.seed

    @property
    def name(self) -> str:
        """Name of the world, as its file says."""
        return self._session.name

    @property
    def gravity(self) -> npt.NDArray[np.float64]:
        """Acceleration of free fall in the world frame [m/s^2], shape (3,)."""
        return self._session.gravity

    @property
    def messages(self) -> list[Message]:
        """What went wrong so far and did not stop the world, oldest first."""
        return self._session.messages

    def state_hash(self) -> str:
        """SHA-256 of all poses, velocities and rotor speeds and of the number of steps, as hex.

        Equal states to the bit, in this process or in the ROS server, give equal hashes.
        """
        return self._session.state_hash()

    def __repr__(self) -> str:
        models = ", ".join(self.models)
        return f"<trident_sim.World '{self.name}' at {self.time:g} s, models: {models}>"

    def _warn(self) -> None:
        """Warn of the messages since the last call, at the line that called into this module."""
        news = self._session.messages[self._reported :]
        self._reported += len(news)
        for message in news:
            warnings.warn(message.text, SimulationWarning, stacklevel=3)


def _is_set(variable: str) -> bool:
    return os.environ.get(variable, "") in ("1", "true", "yes")


def _path(path: FilePath) -> str:
    return os.fspath(path)


def _read(path: str) -> str:
    try:
        return Path(path).read_text(encoding="utf-8")
    except (OSError, UnicodeDecodeError) as error:
        reason = getattr(error, "strerror", None) or str(error)
        raise Error(f"{path}: {reason}, legal: a readable URDF or SDF file") from error
