# SPDX-FileCopyrightText: 2026 The Trident authors
# SPDX-License-Identifier: Apache-2.0
"""Row-by-row flight: the formation goes to the next row when all vehicles have reached this one."""

from __future__ import annotations

import enum
from collections import deque

import numpy as np
import numpy.typing as npt

from trident_fleet.core.config import GateConfig, PlanConfig
from trident_fleet.core.encoding import NS_PER_S
from trident_fleet.core.plan import plan_take_off
from trident_fleet.core.quintic import Array, Motion


class Phase(enum.Enum):
    """Where the flight is."""

    TAKE_OFF = "take-off"
    SETTLE = "settle at the first row"
    ROWS = "rows"
    HOLD = "hold at the last row"
    DONE = "done"
    FAILED = "failed"


class FormationGate:
    """The arrival gate, stepped with measured states; a pure function of what it was given.

    Call `step` once per period, in order. Each vehicle's process may run its own instance: fed with
    the same states they all decide the same.

    Attributes:
        phase: where the flight is.
        row: the row that is commanded now, from 0.
        failure: why the phase is FAILED, naming the vehicles; else "".
        command_ns: elapsed time at which row i was first commanded, one entry per commanded row.
        arrival_ns: elapsed time of the state in which all had reached row i.
        steady_offset: hover error that is subtracted [m, world], shape (N, 3).
    """

    def __init__(
        self,
        rows: Array,
        spawn: Array,
        names: list[str],
        plan_config: PlanConfig,
        gate_config: GateConfig,
    ) -> None:
        """Plan the take-off.

        Args:
            rows: p_world of each row and vehicle [m], shape (T, N, 3).
            spawn: where the vehicles stand [m, world], shape (N, 3).
            names: of the N vehicles, for messages.
            plan_config: limits and waits of the take-off.
            gate_config: radius, timeout, waits.

        Raises:
            FormationError: bad configuration or rows, or no free path to the first row.
        """
        plan_config.validate()
        gate_config.validate()
        self._rows = rows
        self._names = names
        self._config = gate_config
        self.take_off = plan_take_off(rows, spawn, plan_config)
        self.phase = Phase.TAKE_OFF
        self.row = 0
        self.failure = ""
        self.command_ns: list[int] = []
        self.arrival_ns: list[int] = []
        self.steady_offset: Array = np.zeros(spawn.shape)
        self._arrived = np.zeros(len(names), dtype=bool)
        self._since_ns = 0
        self._window: deque[Array] = deque()
        self._window_ns: deque[int] = deque()

    def step(self, elapsed_ns: int, position: Array, effective_ns: int) -> None:
        """Take one measured state into account.

        Args:
            elapsed_ns: its time since the first set-point [ns].
            position: p_world of each vehicle [m], shape (N, 3); NaN for one that is gone.
            effective_ns: from when on the next command acts, since the first set-point [ns].
        """
        if self.phase is Phase.TAKE_OFF and elapsed_ns >= round(self.take_off.duration * NS_PER_S):
            self._enter(Phase.SETTLE, elapsed_ns)
        elif self.phase is Phase.SETTLE:
            self._settle(elapsed_ns, position, effective_ns)
        elif self.phase is Phase.ROWS:
            self._pass_gate(elapsed_ns, position, effective_ns)
        elif self.phase is Phase.HOLD and self._waited_s(elapsed_ns) >= self._config.hold_last_s:
            self._enter(Phase.DONE, elapsed_ns)

    def command(self, time: Array) -> Motion:
        """Commanded motion at times [s] since the first set-point, all in the next period."""
        if self.phase is Phase.TAKE_OFF:
            return self.take_off.sample(time)
        position = np.repeat(self._rows[self.row][None], len(time), axis=0)
        still = np.zeros_like(position)
        return Motion(position, still, still)

    def _enter(self, phase: Phase, elapsed_ns: int) -> None:
        self.phase = phase
        self._since_ns = elapsed_ns

    def _waited_s(self, elapsed_ns: int) -> float:
        return (elapsed_ns - self._since_ns) / NS_PER_S

    def _settle(self, elapsed_ns: int, position: Array, effective_ns: int) -> None:
        self._window.append(position - self._rows[0])
        self._window_ns.append(elapsed_ns)
        while elapsed_ns - self._window_ns[0] > self._config.average_s * NS_PER_S:
            self._window.popleft()
            self._window_ns.popleft()
        if self._waited_s(elapsed_ns) < self._config.settle_s:
            return
        offset = np.mean(np.array(self._window), axis=0)
        present = np.sqrt((offset**2).sum(axis=-1)) <= self._config.max_offset_m
        if present.all():
            self.steady_offset = offset
            self.command_ns.append(self._since_ns)
            self.arrival_ns.append(elapsed_ns)
            self._next_row(elapsed_ns, effective_ns)
        else:
            limit_s = self._config.settle_s + self._config.timeout_s
            self._check_timeout(elapsed_ns, present, offset, limit_s)

    def _pass_gate(self, elapsed_ns: int, position: Array, effective_ns: int) -> None:
        error = position - self._rows[self.row] - self.steady_offset
        if elapsed_ns >= self.command_ns[self.row]:
            self._arrived |= np.sqrt((error**2).sum(axis=-1)) < self._config.radius_m
        if self._arrived.all():
            self.arrival_ns.append(elapsed_ns)
            self._next_row(elapsed_ns, effective_ns)
        else:
            self._check_timeout(elapsed_ns, self._arrived, error, self._config.timeout_s)

    def _next_row(self, elapsed_ns: int, effective_ns: int) -> None:
        if self.row + 1 == len(self._rows):
            self._enter(Phase.HOLD, elapsed_ns)
            return
        self.row += 1
        self.command_ns.append(effective_ns)
        self._arrived[:] = False
        self._enter(Phase.ROWS, elapsed_ns)

    def _check_timeout(
        self, elapsed_ns: int, arrived: npt.NDArray[np.bool_], error: Array, limit_s: float
    ) -> None:
        if self._waited_s(elapsed_ns) <= limit_s:
            return
        distance = np.sqrt((error**2).sum(axis=-1))
        late = ", ".join(
            f"{name} ({away:.2f} m away)" if np.isfinite(away) else f"{name} (gone)"
            for name, away, there in zip(self._names, distance, arrived, strict=True)
            if not there
        )
        self.failure = (
            f"row {self.row + 1} of {len(self._rows)} not reached within {limit_s:g} s by {late}"
        )
        self._enter(Phase.FAILED, elapsed_ns)
