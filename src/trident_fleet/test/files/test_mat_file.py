# SPDX-FileCopyrightText: 2026 The Trident authors
# SPDX-License-Identifier: Apache-2.0
from __future__ import annotations

import struct
import zlib
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from damage import check_damaged
from hypothesis import given
from hypothesis import strategies as st
from layouts import laid_out, positions
from scipy.io import savemat
from trident_fleet.core.errors import FormationError
from trident_fleet.core.files.mat_file import (
    LAYOUTS,
    LAYOUTS_3D,
    LayoutRequest,
    arrange,
    read_mat_positions,
)

_TEXT_BYTES = 124  # at the beginning of a file; any are legal


@pytest.mark.parametrize("layout", LAYOUTS)
@pytest.mark.parametrize("options", [{}, {"do_compression": True}])
def test_any_orientation_of_any_version_is_read(
    tmp_path: Path, layout: str, options: dict[str, Any]
) -> None:
    path = tmp_path / "formation.mat"
    savemat(path, {"vehicle_pos": laid_out(positions(20, 6), layout), "other": 1.0}, **options)
    read = read_mat_positions(path, LayoutRequest())
    np.testing.assert_array_equal(read, positions(20, 6))


@pytest.mark.parametrize("vehicles", [1, 2, 4, 7])
@pytest.mark.parametrize("layout", LAYOUTS_3D)
def test_the_number_of_vehicles_comes_from_the_shape(layout: str, vehicles: int) -> None:
    p = positions(20, vehicles)
    np.testing.assert_array_equal(arrange(laid_out(p, layout), LayoutRequest(), "m"), p)


@pytest.mark.parametrize("layout", LAYOUTS_3D)
def test_three_vehicles_are_ambiguous_until_the_layout_is_given(layout: str) -> None:
    matrix = laid_out(positions(20, 3), layout)
    with pytest.raises(FormationError, match=r"ambiguous; give .layout., one of .*" + layout):
        arrange(matrix, LayoutRequest(), "m")
    np.testing.assert_array_equal(arrange(matrix, LayoutRequest(layout), "m"), positions(20, 3))


def test_fewer_steps_than_vehicles_need_their_number() -> None:
    p = positions(4, 6)
    np.testing.assert_array_equal(
        arrange(laid_out(p, "3xNxT"), LayoutRequest(vehicles_in_file=6), "m"), p
    )


@pytest.mark.parametrize(
    ("matrix", "request_", "what"),
    [
        (np.zeros((5, 4)), LayoutRequest(), "5x4 fits no layout"),
        (np.zeros((600, 18)), LayoutRequest(), "reshape(M', 3, []) is 3x3600"),
        (np.zeros((5, 4, 6)), LayoutRequest(), "5x4x6 fits no layout"),
        (np.zeros((2, 3, 4, 5)), LayoutRequest(), "2x3x4x5 fits no layout"),
        (np.zeros((3, 5, 20)), LayoutRequest(vehicles_in_file=6), "with N = vehicles_in_file = 6"),
        (np.zeros((3, 5, 20)), LayoutRequest("3xNxT", 6), "holds 5 vehicles, but vehicles_in"),
        (np.zeros((5, 5, 3)), LayoutRequest(), "ambiguous"),
        (np.zeros((3, 3)), LayoutRequest(), "ambiguous"),
        (np.zeros((13, 3)), LayoutRequest("", 6), "13 rows do not divide by vehicles_in_file 6"),
        (np.zeros((3, 5, 20)), LayoutRequest("TxNx3"), "does not fit layout TxNx3"),
        (np.zeros((12, 3)), LayoutRequest("NTx3"), "layout: 'NTx3'; legal: TNx3"),
        (np.zeros((0, 3)), LayoutRequest("TNx3"), "empty"),
        (np.array([[1.0, np.nan, 3.0]] * 6), LayoutRequest(), "m(1, 2): nan is not finite"),
    ],
)
def test_a_shape_that_does_not_fit_is_refused(
    matrix: np.ndarray, request_: LayoutRequest, what: str
) -> None:
    with pytest.raises(FormationError) as caught:
        arrange(matrix, request_, "m")
    assert what in str(caught.value)


@pytest.mark.parametrize(
    ("value", "what"),
    [
        (np.ones((6, 3)) * 1j, "legal: a full matrix of real numbers"),
        ("text", "legal: a full matrix of real numbers"),
        ({"field": 1.0}, "legal: a full matrix of real numbers"),
    ],
)
def test_only_real_matrices_will_do(tmp_path: Path, value: object, what: str) -> None:
    savemat(tmp_path / "f.mat", {"vehicle_pos": value})
    with pytest.raises(FormationError, match=what):
        read_mat_positions(tmp_path / "f.mat", LayoutRequest())


def test_integers_are_numbers(tmp_path: Path) -> None:
    savemat(tmp_path / "f.mat", {"vehicle_pos": positions(1, 6)[0].astype(np.int16)})
    read = read_mat_positions(tmp_path / "f.mat", LayoutRequest(uavs=6))
    np.testing.assert_array_equal(read, positions(1, 6))


def test_a_missing_variable_names_those_that_are_there(tmp_path: Path) -> None:
    savemat(tmp_path / "f.mat", {"pos": np.ones(3), "dt": 0.1})
    with pytest.raises(FormationError, match=r"no variable vehicle_pos; the file holds: dt, pos"):
        read_mat_positions(tmp_path / "f.mat", LayoutRequest())


@pytest.fixture(scope="module")
def compressed(tmp_path_factory: pytest.TempPathFactory) -> bytes:
    path = tmp_path_factory.mktemp("mat") / "f.mat"
    savemat(path, {"vehicle_pos": positions(4, 6)}, do_compression=True)
    return path.read_bytes()


@pytest.fixture(scope="module")
def plain(tmp_path_factory: pytest.TempPathFactory) -> bytes:
    path = tmp_path_factory.mktemp("mat") / "f.mat"
    savemat(path, {"vehicle_pos": positions(4, 6)})
    return path.read_bytes()


@given(data=st.data())
@pytest.mark.parametrize("form", ["compressed", "plain"])
def test_a_damaged_file_is_read_or_refused_and_never_crashes(
    form: str, request: pytest.FixtureRequest, tmp_path_factory: pytest.TempPathFactory, data: Any
) -> None:
    good: bytes = request.getfixturevalue(form)
    path = tmp_path_factory.mktemp("damaged") / "f.mat"
    check_damaged(path, good, _TEXT_BYTES, LayoutRequest(), data)


def test_a_big_endian_file_is_read(tmp_path: Path) -> None:
    values = np.arange(6.0).reshape(2, 3)
    body = struct.pack(">IIII", 6, 8, 6, 0) + struct.pack(">IIii", 5, 8, 2, 3)
    body += struct.pack(">II", 1, 11) + b"vehicle_pos".ljust(16, b"\0")
    body += struct.pack(">II", 9, 48) + values.astype(">f8").tobytes(order="F")
    head = b"MATLAB 5.0 MAT-file".ljust(124) + b"\x01\x00MI"
    path = tmp_path / "big.mat"
    path.write_bytes(head + struct.pack(">II", 14, len(body)) + body)
    read = read_mat_positions(path, LayoutRequest(vehicles_in_file=2))
    np.testing.assert_array_equal(read, values[None])


def test_a_bomb_does_not_fill_the_memory(tmp_path: Path) -> None:
    packed = zlib.compress(bytes(300_000_000), 9)
    head = b"MATLAB 5.0 MAT-file".ljust(124) + b"\x00\x01IM"
    path = tmp_path / "bomb.mat"
    path.write_bytes(head + struct.pack("<II", 15, len(packed)) + packed)
    with pytest.raises(FormationError, match="more than 268435456 bytes"):
        read_mat_positions(path, LayoutRequest())
