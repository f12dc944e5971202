# SPDX-FileCopyrightText: 2026 The Trident authors
# SPDX-License-Identifier: Apache-2.0
"""The runs of a sweep, each under a name that says what it is a run of."""

from __future__ import annotations

import hashlib
import json
from collections.abc import Mapping
from dataclasses import asdict, dataclass
from typing import Any

from trident_eval.core.sweep.scenario import Scenario


@dataclass(frozen=True)
class Job:
    """One run.

    Attributes:
        key: SHA-256 of subject, parameters, seed and code, hexadecimal.
        point: index of the point, in the order of the axes.
        subject: the function `module:name`, or `launch FILE.launch ...`.
        parameters: all of them, fixed ones included.
        seed: of the run.
        time_s: limit of wall-clock time [s].
        memory_mb: limit of address space [MB]; 0: none.
        metrics: names of the numbers that it has to give.
    """

    key: str
    point: int
    subject: str
    parameters: Mapping[str, Any]
    seed: int
    time_s: float
    memory_mb: float
    metrics: tuple[str, ...]

    def to_json(self) -> dict[str, Any]:
        """For a process that is to carry it out."""
        return asdict(self)

    @staticmethod
    def from_json(value: dict[str, Any]) -> Job:
        """What `to_json` has given."""
        return Job(**{**value, "metrics": tuple(value["metrics"])})


def key_of(subject: str, parameters: Mapping[str, Any], seed: int, code: str) -> str:
    """The name of a run: the same for the same work by the same code, and for no other."""
    text = json.dumps([subject, parameters, seed, code], sort_keys=True, allow_nan=False)
    return hashlib.sha256(text.encode()).hexdigest()


def jobs_of(scenario: Scenario, code: str) -> list[Job]:
    """All runs: the first seed of every point, then the second, and so on.

    Args:
        scenario: whose.
        code: the version of what is run.
    """
    metrics = tuple(metric.name for metric in scenario.metrics)
    return [
        Job(
            key_of(scenario.subject, parameters, seed, code),
            point,
            scenario.subject,
            parameters,
            seed,
            scenario.limits.time_s,
            scenario.limits.memory_mb,
            metrics,
        )
        for seed in scenario.seeds
        for point, parameters in enumerate(scenario.points())
    ]
