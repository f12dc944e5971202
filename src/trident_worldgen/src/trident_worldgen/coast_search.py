# SPDX-FileCopyrightText: 2026 The Trident authors
# SPDX-License-Identifier: Apache-2.0
"""What a search on a coast is for: covers, casualties, and the record of where they are.

The record is a YAML file next to the world with two pictures of 2 m cells: what each cell is, and
how high it is. Who simulates or judges a search reads it; who searches does not.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Iterable, Sequence
from dataclasses import dataclass, field

import numpy as np
import numpy.typing as npt
from PIL import Image
from scipy import ndimage

from trident_sim import Error
from trident_worldgen.coast_cells import (
    CELL_M,
    Area,
    Mask,
    Post,
    eroded,
    slopes,
    touched,
    within,
)
from trident_worldgen.coast_covers import COVER_M, Cover, build
from trident_worldgen.coast_parts import buildings, walls
from trident_worldgen.noise import Field, png
from trident_worldgen.placing import free_place
from trident_worldgen.sdf import Color, Files, StaticModel

LAND, COVER, GROUND, WATER = 1, 2, 4, 8
"""Flags of a cell: it is land; it lies below a cover; a ground robot, a boat gets there."""
GREATEST_SLOPE = math.tan(math.radians(12.0))
BASES = {"air": (30.0, 36.0), "ground": (36.0, 36.0), "water": (30.0, 15.0)}
"""Where robots start, x and y by the medium that they move in [m]."""
DRIFT_M_S = (0.135, -0.019)
"""Mean drift of a person in config/environments/search_coast.yaml [m/s]."""

Flags = npt.NDArray[np.uint8]

_DRIFT_S = 900.0  # for which casualties neither strand nor leave the area
_BOAT_DEPTH_M = 0.8
_ROBOT_M, _BOAT_M = 0.7, 1.5  # kept from what stands there
_IN_WATER, _COVERED = 5.0 / 12.0, 2.0 / 12.0  # shares of the casualties
_EDGE_M = 14.0
_TRIES = 4000
_ROAD_Y_M, _ROAD_GAP_M = 50.0, 15.0
_VEST = Color((0.95, 0.35, 0.05))
_RECORD = f"""# SPDX-FileCopyrightText: 2026 The Trident authors
# SPDX-License-Identifier: Apache-2.0
#
# What is to be found on {{world}}.world, and where. Lengths in m, z is up from the still water.
seed: {{seed}}
size: {{size}}
cell: {CELL_M:g}
# Flags: {LAND} land, {COVER} covered, {GROUND} a ground robot gets there, {WATER} a boat does.
cells: {{world}}.cells.png
heights: {{{{file: {{world}}.heights.png, lowest: {{lowest:g}}, relief: {{relief:g}}}}}}
environment: package://trident_bringup/config/environments/search_coast.yaml
bases: {{{{{{bases}}}}}}
covers:{{covers}}
casualties:{{casualties}}
"""


@dataclass(frozen=True)
class Casualty:
    """A person who lies or floats there.

    Attributes:
        x: [m].
        y: [m].
        where: `open`, `cover` or `water`.
        yaw: of the body [rad].
    """

    x: float
    y: float
    where: str
    yaw: float


@dataclass
class SearchSite:
    """What is to be found, and what can be reached."""

    area: Area
    seed: int
    count: int
    covers: list[Cover] = field(default_factory=list)
    casualties: list[Casualty] = field(default_factory=list)
    _posts: list[Post] = field(default_factory=list)

    @property
    def is_empty(self) -> bool:
        """Whether nothing is to be found."""
        return not self.covers and not self.casualties

    def is_covered(self, x: float, y: float) -> bool:
        """Whether nothing else may stand here, as a cover does."""
        return any(bool(cover.has(x, y, 2.0)) for cover in self.covers)

    def place_casualties(self, posts: Sequence[Post]) -> None:
        """Find a place for each of them that its rescuer reaches.

        Args:
            posts: what has grown since.

        Raises:
            Error: there is no room.
        """
        self._posts = [*self.area.posts, *posts]
        for cover in self.covers:
            self._posts += cover.posts()
        if not self.count:
            return
        cells = self.cells()
        in_water = round(self.count * _IN_WATER)
        covered = round(self.count * _COVERED) if self.covers else 0
        kinds = ["open"] * (self.count - in_water - covered)
        kinds += ["cover"] * covered + ["water"] * in_water
        random = np.random.default_rng([self.seed, 0xCA5])
        inner = {
            "open": eroded((cells & GROUND > 0) & (cells & COVER == 0)),
            "cover": eroded((cells & GROUND > 0) & (cells & COVER > 0)),
            "water": self._drift_stays(eroded(cells & WATER > 0)),
        }
        for kind in kinds:
            self.casualties.append(self._casualty(random, kind, inner[kind]))

    def _casualty(self, random: np.random.Generator, kind: str, allowed: Mask) -> Casualty:
        rows, columns = np.nonzero(allowed)
        for _ in range(_TRIES if len(rows) else 0):
            pick = int(random.integers(len(rows)))
            x, y = self._middle(int(rows[pick]), int(columns[pick]))
            near = [one for one in self.casualties if math.hypot(one.x - x, one.y - y) < 8.0]
            if not near:
                return Casualty(x, y, kind, round(float(random.uniform(-math.pi, math.pi)), 2))
        raise Error(f"casualties: {self.count}, no room for one more ({kind}); legal: fewer")

    def _drift_stays(self, allowed: Mask) -> Mask:
        """Cells from which a person drifts over allowed cells alone."""
        stays = allowed.copy()
        rows, columns = np.nonzero(allowed)
        for share in np.linspace(0.1, 1.0, 10):
            right = np.rint(columns + share * _DRIFT_S * DRIFT_M_S[0] / CELL_M).astype(int)
            down = np.rint(rows - share * _DRIFT_S * DRIFT_M_S[1] / CELL_M).astype(int)
            inside = (right >= 0) & (right < allowed.shape[1]) & (down >= 0)
            inside &= down < allowed.shape[0]
            there = np.zeros(len(rows), dtype=bool)
            there[inside] = allowed[down[inside], right[inside]]
            stays[rows[~there], columns[~there]] = False
        return stays

    def cells(self) -> Flags:
        """What each cell is, row 0 at the largest y, shape (rows, columns)."""
        x, y = self._grid()
        heights = self.area.ground.heights(x, y)
        quays = within(walls(self.area.front_y), x, y, 0.0)
        land = (heights > 0.0) | quays
        flags = np.where(land, LAND, 0)
        for cover in self.covers:
            flags = flags | np.where(cover.has(x, y), COVER, 0)
        ground = land & (slopes(self.area.ground, x, y) < GREATEST_SLOPE) | quays
        ground &= ~within(buildings(self.area.front_y), x, y, _ROBOT_M)
        ground &= ~touched(self._posts, x, y, 0.0)
        water = (heights < -_BOAT_DEPTH_M) & ~within(walls(self.area.front_y), x, y, _BOAT_M)
        water &= ~touched(self._posts, x, y, _BOAT_M)
        flags = flags | np.where(self._linked(ground, "ground"), GROUND, 0)
        flags = flags | np.where(self._linked(water, "water"), WATER, 0)
        return np.asarray(flags, dtype=np.uint8)

    def _linked(self, free: Mask, medium: str) -> Mask:
        """The free cells that are connected with the base, side by side."""
        labels, _ = ndimage.label(free)
        at = labels[self._cell(*BASES[medium])]
        return np.asarray((labels == at) & (at > 0))

    def _grid(self) -> tuple[Field, Field]:
        ground = self.area.ground
        columns, rows = round(ground.length / CELL_M), round(ground.width / CELL_M)
        x = (np.arange(columns) + 0.5) * CELL_M - ground.length / 2
        y = ground.width / 2 - (np.arange(rows) + 0.5) * CELL_M
        return x[None, :], y[:, None]

    def _middle(self, row: int, column: int) -> tuple[float, float]:
        ground = self.area.ground
        x = (column + 0.5) * CELL_M - ground.length / 2
        return x, ground.width / 2 - (row + 0.5) * CELL_M

    def _cell(self, x: float, y: float) -> tuple[int, int]:
        ground = self.area.ground
        return int((ground.width / 2 - y) / CELL_M), int((x + ground.length / 2) / CELL_M)

    def models(self) -> list[StaticModel]:
        """The covers, and each casualty as a model of its own."""
        if self.is_empty:
            return []
        built = StaticModel("covers")
        for index, cover in enumerate(self.covers):
            build(built, f"cover{index}", cover, self.area)
        people = []
        for index, one in enumerate(self.casualties):
            person = StaticModel(f"casualty_{index}")
            foot = max(self.area.ground.height(one.x, one.y), 0.0)
            center = (one.x, one.y, foot + 0.15)
            # A wave would push what is solid and does not move: those in the water are only seen.
            solid = one.where != "water"
            person.box("body", (1.7, 0.5, 0.3), center, _VEST, yaw=one.yaw, solid=solid)
            people.append(person)
        return [built, *people] if self.covers else people

    def record(self, world: str) -> Files:
        """The record and its pictures, by file name; nothing where nothing is to be found."""
        if self.is_empty:
            return {}
        heights = self._surface()
        lowest, relief = round(float(heights.min()), 4), round(float(np.ptp(heights)), 4)
        gray = np.round((heights - lowest) / relief * 65535.0).clip(0, 65535).astype(np.uint16)
        text = _RECORD.format(
            world=world,
            seed=self.seed,
            size=f"[{self.area.ground.length:g}, {self.area.ground.width:g}]",
            lowest=lowest,
            relief=relief,
            bases=", ".join(f"{name}: [{x:g}, {y:g}]" for name, (x, y) in BASES.items()),
            covers=_items(
                f"x: {one.x:g}, y: {one.y:g}, side: {COVER_M:g}, kind: {one.kind}"
                for one in self.covers
            ),
            casualties=_items(
                f"name: casualty_{index}, x: {one.x:g}, y: {one.y:g}, where: {one.where}"
                for index, one in enumerate(self.casualties)
            ),
        )
        return {
            f"{world}.scene.yaml": text,
            f"{world}.cells.png": png(Image.fromarray(self.cells())),
            f"{world}.heights.png": png(Image.fromarray(gray)),
        }

    def _surface(self) -> Field:
        """Of the ground, and of what is built on it, but for covers [m], shape (rows, columns)."""
        x, y = self._grid()
        heights = self.area.ground.heights(x, y)
        for built in (walls(self.area.front_y), buildings(self.area.front_y)):
            for name, one in built.items():
                top = self.area.level + one.height
                heights = np.where(within({name: one}, x, y, 0.0), top, heights)
        return heights


def _items(texts: Iterable[str]) -> str:
    """A list in YAML, behind its key."""
    lines = [f"\n  - {{{text}}}" for text in texts]
    return "".join(lines) or " []"


def search_site(area: Area, seed: int, covers: int, casualties: int) -> SearchSite:
    """A site with its covers; casualties are placed when all that grows has grown.

    Args:
        area: of the coast.
        seed: decides the places.
        covers: how many.
        casualties: how many there will be.

    Raises:
        Error: there is no room for so many covers.
    """
    site = SearchSite(area, seed, casualties)
    if not covers:
        return site
    reached = site.cells() & GROUND > 0
    random = np.random.default_rng([seed, 0xC07E])
    is_free = _cover_test(site, reached)
    ends = (area.ground.length / 2 - _EDGE_M, area.ground.width / 2 - _EDGE_M)
    for index in range(covers):
        place = free_place(random, (-ends[0], ends[0]), (0.0, ends[1]), is_free, _TRIES)
        if place is None:
            raise Error(f"covers: {covers}, there is room for {index}; legal: fewer")
        x, y = (round(value) + 0.0 for value in place)
        site.covers.append(Cover(x, y, "roof" if index % 2 == 0 else "grove"))
    return site


def _cover_test(site: SearchSite, reached: Mask) -> Callable[[float, float], bool]:
    x, y = site._grid()
    built = [*walls(site.area.front_y).values(), *buildings(site.area.front_y).values()]

    def is_free(at_x: float, at_y: float) -> bool:
        at_x, at_y = round(at_x), round(at_y)
        if abs(at_y - _ROAD_Y_M) < _ROAD_GAP_M or any(
            abs(at_x - one.x) < COVER_M / 2 + one.length / 2 + 2.0
            and abs(at_y - one.y) < COVER_M / 2 + one.width / 2 + 2.0
            for one in built
        ):
            return False
        if any(max(abs(at_x - one.x), abs(at_y - one.y)) < COVER_M + 4.0 for one in site.covers):
            return False
        return bool(reached[Cover(at_x, at_y, "").has(x, y, 3.0)].all())

    return is_free
