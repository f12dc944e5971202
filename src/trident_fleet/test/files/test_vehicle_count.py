# SPDX-FileCopyrightText: 2026 The Trident authors
# SPDX-License-Identifier: Apache-2.0
from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest
from trident_fleet.core.choreography import perform
from trident_fleet.core.choreography_file import parse_words
from trident_fleet.core.errors import FormationError
from trident_fleet.core.files.formation_file import FormationSource, read_formation
from trident_fleet.core.files.text_file import read_text_rows
from trident_fleet.core.files.vehicle_count import infer_vehicles
from trident_fleet.core.quintic import Array

TOURS = {
    "line": ["line", "translate:5,0,0"],
    "wedge": ["wedge", "rescale:1.5"],
    "circle": ["circle", "rotate:360"],
    "tour": ["grid", "translate:4,0,0.5", "rotate:90", "circle", "line"],
}


def interleaved(words: list[str], vehicles: int) -> Array:
    return perform(parse_words(words, vehicles, 2.2)).rows.reshape(-1, 3)


@pytest.mark.parametrize("uavs", [0, 1, 4, 6])
def test_the_shared_files_are_those_of_six(formation_data: Path, uavs: int) -> None:
    for file in sorted(formation_data.glob("pos_data*")):
        assert infer_vehicles(read_text_rows(file), uavs, "f") == 6


@pytest.mark.parametrize("missing", [1, 2, 4, 5, 7])
def test_a_file_that_is_cut_short_is_refused(own_formation: Path, missing: int) -> None:
    rows = read_text_rows(own_formation)[:-missing]
    with pytest.raises(
        FormationError, match=f"f: {1200 - missing} rows do not divide by 6, the nu"
    ):
        infer_vehicles(rows, 1, "f")


@pytest.mark.parametrize("vehicles", [2, 3, 4, 5])
def test_fewer_of_the_shared_vehicles_are_counted(formation_data: Path, vehicles: int) -> None:
    six = read_text_rows(formation_data / "pos_data.txt").reshape(-1, 6, 3)
    assert infer_vehicles(six[:, :vehicles].reshape(-1, 3), 0, "f") == vehicles


@pytest.mark.parametrize("vehicles", [2, 3, 4, 5, 6, 7, 8, 12])
@pytest.mark.parametrize("tour", TOURS)
@pytest.mark.parametrize("uavs", [0, 2])
def test_formations_are_counted_by_their_continuity(tour: str, vehicles: int, uavs: int) -> None:
    # A wedge's second arm lies a step behind its first, and a circle closes: both mislead.
    assert infer_vehicles(interleaved(TOURS[tour], vehicles), uavs, "f") == vehicles


@pytest.mark.parametrize("scale", [1e-300, 1e-3, 1e305])
def test_units_do_not_matter(scale: float) -> None:
    assert infer_vehicles(interleaved(TOURS["tour"], 4) * scale, 0, "f") == 4


def test_a_lone_vehicle_is_one(own_formation: Path) -> None:
    assert infer_vehicles(read_text_rows(own_formation.with_name("leader_path.txt")), 0, "f") == 1


@pytest.mark.parametrize("uavs", [20, 7])
def test_a_large_ring_is_no_path_of_one_vehicle_when_several_fly(uavs: int) -> None:
    assert infer_vehicles(interleaved(TOURS["circle"], 20), uavs, "f") == 20


STILL = np.tile([[0.0, 0.0, 1.0], [0.0, 2.0, 1.0], [0.0, 4.0, 1.0], [2.0, 0.0, 1.0]], (50, 1))
ONE_ROW = np.array([[0.0, 1.6 * index, 1.0] for index in range(6)])
GRID = np.array([[1.9 * (index // 3), 2.0 * (index % 3), 1.0] for index in range(12)])
JUMPS = np.random.default_rng(1).uniform(-5.0, 5.0, (24, 3))


@pytest.mark.parametrize(
    ("rows", "uavs", "reason", "candidates"),
    [
        (STILL, 0, "all stand still", "4, 8, 20, 40, 100"),
        (STILL, 6, "all stand still", "4, 8, 20, 40, 100"),
        (np.ones((13, 3)), 2, "all stand still", "1, 13"),
        (ONE_ROW, 4, "vehicles in flight, or one row of vehicles", "1, 6"),
        (ONE_ROW[[0, 3, 1, 5, 2, 4]], 0, "vehicles in flight, or one row of vehicles", "2, 6"),
        (GRID, 4, "vehicles in flight, or one row of vehicles", "3, 12"),
        (JUMPS, 5, "the rows move in no small steps", "1, 2, 3, 4, 6, 8, 12, 24"),
        (np.tile(JUMPS, (50, 1))[:1200], 0, "all stand still", "24, 48"),
        (interleaved(TOURS["circle"], 20), 0, "they come back to where they were", "1, 20"),
    ],
    ids=[
        "still",
        "still for six",
        "one place",
        "one row",
        "mixed row",
        "grid",
        "jumps",
        "rounds",
        "ring",
    ],
)
def test_what_stays_open_names_the_candidates(
    rows: Array, uavs: int, reason: str, candidates: str
) -> None:
    with pytest.raises(FormationError) as caught:
        infer_vehicles(rows, uavs, "f.txt")
    assert str(caught.value) == (
        f"f.txt: how many vehicles its rows interleave is open ({reason}); give vehicles_in_file,"
        f" one of {candidates}"
    )


@pytest.mark.parametrize(
    ("rows", "uavs", "vehicles"),
    [
        (STILL, 4, 4),
        (ONE_ROW, 6, 6),
        (ONE_ROW, 1, 1),
        (JUMPS, 6, 6),
        (JUMPS[:7], 4, 7),  # no other number holds four
        (interleaved(TOURS["circle"], 20), 1, 1),
        (JUMPS[:1], 0, 1),
    ],
)
def test_the_number_that_fly_breaks_the_tie(rows: Array, uavs: int, vehicles: int) -> None:
    assert infer_vehicles(rows, uavs, "f") == vehicles


def test_a_file_of_four_flown_by_six_says_what_it_holds(tmp_path: Path) -> None:
    path = tmp_path / "four.txt"
    rows = interleaved(TOURS["line"], 4)
    path.write_text("".join(f"{i} {x} {y} {z}\n" for i, (x, y, z) in enumerate(rows)))
    assert read_formation(FormationSource(str(path), uavs=4)).shape[1] == 4
    with pytest.raises(FormationError, match=r"uavs: 6, but .*four.txt holds 4 vehicles; legal: 1"):
        read_formation(FormationSource(str(path), uavs=6))
