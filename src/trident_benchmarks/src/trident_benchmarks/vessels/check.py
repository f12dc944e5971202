# SPDX-FileCopyrightText: 2026 The Trident authors
# SPDX-License-Identifier: Apache-2.0
"""What a check is: curves to compare, and figures with their tolerances."""

from __future__ import annotations

from dataclasses import dataclass, field

from trident_benchmarks.vessels.trial import Array


@dataclass(frozen=True)
class Figure:
    """A number that must be right.

    Attributes:
        what: its name.
        measured: in the simulator.
        reference: by closed form, specification or independent integration; for limits 0.
        tolerance: largest legal difference of the two.
        unit: of all three.
    """

    what: str
    measured: float
    reference: float
    tolerance: float
    unit: str = ""

    @property
    def passed(self) -> bool:
        """Whether the difference is within the tolerance."""
        return abs(self.measured - self.reference) <= self.tolerance

    def text(self) -> str:
        """One line: figure, reference, deviation of legal deviation."""
        unit = f" {self.unit}" if self.unit else ""
        deviation = abs(self.measured - self.reference)
        return (
            f"{'ok  ' if self.passed else 'FAIL'}  {self.what}: {self.measured:.6g}{unit}, "
            f"reference {self.reference:.6g}{unit}, off by {deviation:.2g} of {self.tolerance:.2g}"
        )


@dataclass(frozen=True)
class Curve:
    """Points x (n), y (n) with a name for the legend."""

    label: str
    x: Array
    y: Array
    dots: bool = False


@dataclass
class Panel:
    """One diagram.

    Attributes:
        title: above it.
        x_label, y_label: with units.
        measured: the simulator's curves.
        reference: what they are compared with.
        bands: lower and upper edge of what is legal, as (x, lower, upper).
        equal: whether both axes have one scale.
        log: whether the y axis is logarithmic.
    """

    title: str
    x_label: str
    y_label: str
    measured: list[Curve] = field(default_factory=list)
    reference: list[Curve] = field(default_factory=list)
    bands: list[tuple[Array, Array, Array]] = field(default_factory=list)
    equal: bool = False
    log: bool = False


@dataclass
class Check:
    """One thing that the simulator must show, with its picture."""

    title: str
    panels: list[Panel]
    figures: list[Figure]

    @property
    def passed(self) -> bool:
        """Whether all figures are within their tolerances."""
        return all(figure.passed for figure in self.figures)
