# SPDX-FileCopyrightText: 2026 The Trident authors
# SPDX-License-Identifier: Apache-2.0
from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest
from trident_fleet.core.errors import FormationError
from trident_fleet.core.files.formation_file import FormationSource, flying_rows, read_formation
from trident_fleet.core.separation import min_separation

TUTORIAL_SCALE = (1.0, 2.0, 0.5)


@pytest.fixture
def two_rows(tmp_path: Path) -> Path:
    path = tmp_path / "two.txt"
    path.write_text("".join(f"{i} {i} {10 * i} {100 * i}\n" for i in range(1, 5)))
    return path


def test_rows_are_interleaved_vehicle_by_vehicle_scaled_then_shifted(two_rows: Path) -> None:
    source = FormationSource(
        str(two_rows), vehicles_in_file=2, scale=(1.0, 2.0, 0.5), offset=(0.0, -1.0, 0.25)
    )
    expected = [[[1, 19, 50.25], [2, 39, 100.25]], [[3, 59, 150.25], [4, 79, 200.25]]]
    np.testing.assert_array_equal(read_formation(source), expected)


def test_the_first_vehicles_fly(two_rows: Path) -> None:
    source = FormationSource(str(two_rows), vehicles_in_file=2, uavs=1)
    rows = flying_rows(read_formation(source), source.uavs, first_row=1)
    np.testing.assert_array_equal(rows, [[[3.0, 30.0, 300.0]]])


@pytest.mark.parametrize(
    ("change", "what"),
    [
        ({"file": "/nowhere/f.txt"}, "/nowhere/f.txt: No such file or directory"),
        ({"file": "/"}, "/: Is a directory"),
        ({"file": ""}, "formation_file: empty"),
        ({"vehicles_in_file": 3}, "4 rows do not divide by vehicles_in_file 3"),
        ({"vehicles_in_file": -2}, "vehicles_in_file: -2"),
        ({"uavs": 3}, "uavs: 3, but .* holds 2 vehicles; legal: 1 to 2"),
        ({"uavs": -1}, "uavs: -1"),
        ({"scale": (1.0, 0.0, 1.0)}, "scale_y: 0.0; legal: finite, not 0"),
        ({"scale": (1.0, 1.0, float("nan"))}, "scale_z: nan"),
        ({"scale": (1e308, 1.0, 1.0)}, "after scale"),
        ({"offset": (float("inf"), 0.0, 0.0)}, "offset_x: inf"),
        ({"layout": "3xNxT"}, "layout: '3xNxT' for the text file"),
    ],
)
def test_bad_settings_are_refused(two_rows: Path, change: dict[str, object], what: str) -> None:
    good: dict[str, object] = {"file": str(two_rows), "vehicles_in_file": 2}
    with pytest.raises(FormationError, match=what):
        read_formation(FormationSource(**(good | change)))  # type: ignore[arg-type]


def test_no_row_is_left_to_begin_with(two_rows: Path) -> None:
    positions = read_formation(FormationSource(str(two_rows), vehicles_in_file=2))
    with pytest.raises(FormationError, match=r"seq: begins at row 3 of 2; legal: 0 to 3"):
        flying_rows(positions, 2, first_row=2)


def test_a_text_file_may_be_called_mat(tmp_path: Path) -> None:
    path = tmp_path / "ascii.mat"
    path.write_text("".join(f" {i} 0 0 {i}\n" for i in range(1, 7)))
    assert read_formation(FormationSource(str(path), uavs=6)).shape == (1, 6, 3)


def test_every_real_form_holds_the_same_flight(formation_data: Path) -> None:
    files = sorted(f for f in formation_data.iterdir() if f.suffix in (".txt", ".csv", ".mat"))
    assert len(files) == 6
    flights = [read_formation(FormationSource(str(f), scale=TUTORIAL_SCALE)) for f in files]
    for flight in flights:
        assert flight.shape == (200, 6, 3)
        np.testing.assert_allclose(flight, flights[-1], atol=1e-3)
        assert min_separation(flight[:, :]) == pytest.approx(1.386, abs=2e-3)


def test_our_own_formation_keeps_its_distance_and_its_shape(own_formation: Path) -> None:
    rows = read_formation(FormationSource(str(own_formation)))
    assert rows.shape == (200, 6, 3)
    assert min_separation(rows) > 1.2
    shape = rows[60:] - rows[60:].mean(axis=1, keepdims=True)
    radii = np.linalg.norm(shape, axis=-1)
    np.testing.assert_allclose(radii, 1.7, atol=1e-5)


def test_our_own_formation_is_what_its_generator_writes(own_formation: Path) -> None:
    import subprocess

    generator = own_formation.with_name("generate_hexagon_translate_rotate.py")
    written = subprocess.run(["/usr/bin/python3", generator], capture_output=True, check=True)
    assert written.stdout == own_formation.read_bytes()
