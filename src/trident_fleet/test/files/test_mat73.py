# SPDX-FileCopyrightText: 2026 The Trident authors
# SPDX-License-Identifier: Apache-2.0
from __future__ import annotations

from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from damage import check_damaged
from hypothesis import given, settings
from hypothesis import strategies as st
from layouts import laid_out, positions
from trident_fleet.core.errors import FormationError
from trident_fleet.core.files import mat73
from trident_fleet.core.files.formation_file import FormationSource, read_formation
from trident_fleet.core.files.mat5 import MatError
from trident_fleet.core.files.mat_file import LAYOUTS, LayoutRequest, read_mat_positions

h5py = pytest.importorskip("h5py", reason="the Debian package python3-h5py is not installed")

USERBLOCK_BYTES = 512
GZIP = {"compression": "gzip", "compression_opts": 3, "chunks": True}  # what MATLAB uses


def matlab_header() -> bytes:
    """What MATLAB writes before the HDF5 part: text, subsystem offset, version and byte order."""
    text = "MATLAB 7.3 MAT-file, Platform: GLNXA64, Created on: Mon Jan  5 10:00:00 2026"
    return (text + " HDF5 schema 1.00 .").encode().ljust(116) + bytes(8) + b"\x00\x02IM"


def add(file: Any, name: str, matrix: np.ndarray, matlab_class: str, **options: Any) -> None:
    """A variable as MATLAB stores it: transposed, with its class, and dimensions if it is empty."""
    if matrix.size:
        dataset = file.create_dataset(name, data=matrix.T, **options)
    else:
        dataset = file.create_dataset(name, data=np.array(matrix.shape, dtype=np.uint64))
        dataset.attrs["MATLAB_empty"] = np.uint8(1)
    dataset.attrs["MATLAB_class"] = np.bytes_(matlab_class)


@contextmanager
def matlab_file(path: Path) -> Iterator[Any]:
    """A file to put variables in, with the header that only MATLAB writes."""
    with h5py.File(path, "w", userblock_size=USERBLOCK_BYTES) as file:
        yield file
    with path.open("r+b") as stream:
        stream.write(matlab_header())


def save_v73(path: Path, variables: dict[str, np.ndarray], **options: Any) -> Path:
    classes = {"float64": "double", "float32": "single"}
    with matlab_file(path) as file:
        for name, matrix in variables.items():
            add(file, name, matrix, classes.get(matrix.dtype.name, matrix.dtype.name), **options)
    return path


@pytest.mark.parametrize("layout", LAYOUTS)
@pytest.mark.parametrize("options", [{}, GZIP], ids=["contiguous", "gzip"])
def test_any_orientation_is_read(tmp_path: Path, layout: str, options: dict[str, Any]) -> None:
    matrix = laid_out(positions(20, 6), layout)
    path = save_v73(tmp_path / "f.mat", {"vehicle_pos": matrix, "dt": np.ones((1, 1))}, **options)
    assert path.read_bytes()[USERBLOCK_BYTES:].startswith(mat73.HDF5_MAGIC)
    np.testing.assert_array_equal(read_mat_positions(path, LayoutRequest()), positions(20, 6))


def test_values_keep_the_place_that_matlab_gave_them(tmp_path: Path) -> None:
    matrix = np.arange(24.0).reshape(2, 3, 4)
    path = save_v73(tmp_path / "f.mat", {"vehicle_pos": matrix})
    (variable,) = mat73.read_variables(path, "vehicle_pos")
    assert variable.kind == "double"
    assert variable.values is not None
    np.testing.assert_array_equal(variable.values, matrix)


@pytest.mark.parametrize("dtype", ["int16", "uint8", "int64", "float32"])
def test_other_numbers_are_numbers(tmp_path: Path, dtype: str) -> None:
    path = save_v73(tmp_path / "f.mat", {"vehicle_pos": positions(2, 6).astype(dtype)})
    read = read_mat_positions(path, LayoutRequest("TxNx3"))
    np.testing.assert_array_equal(read, positions(2, 6))


def test_a_file_that_another_program_wrote_needs_no_class(tmp_path: Path) -> None:
    with h5py.File(tmp_path / "f.mat", "w") as file:
        file["vehicle_pos"] = positions(20, 6).T
    read = read_mat_positions(tmp_path / "f.mat", LayoutRequest())
    np.testing.assert_array_equal(read, positions(20, 6))


def test_a_file_with_scale_and_offset_from_end_to_end(tmp_path: Path) -> None:
    path = save_v73(tmp_path / "f.mat", {"vehicle_pos": laid_out(positions(20, 6), "3xNxT")})
    source = FormationSource(str(path), uavs=4, scale=(1.0, 2.0, 0.5), offset=(0.0, 0.0, 3.0))
    expected = positions(20, 6) * [1.0, 2.0, 0.5] + [0.0, 0.0, 3.0]
    np.testing.assert_array_equal(read_formation(source), expected)


@pytest.mark.parametrize(
    ("variables", "what"),
    [
        ({"pos": np.ones((2, 2)), "dt": np.ones((1, 1))}, "no variable vehicle_pos; .*: dt, pos"),
        ({"vehicle_pos": np.ones((5, 4))}, "5x4 fits no layout"),
        ({"vehicle_pos": np.zeros((3, 3, 20))}, "3x3x20 is ambiguous; give `layout`, one of"),
        (
            {"vehicle_pos": np.zeros((13, 3))},
            "rows interleave is open .all stand still.; .* one of 1, 13",
        ),
        ({"vehicle_pos": np.zeros((0, 3))}, "empty"),
        ({"vehicle_pos": np.array([[1, np.nan, 3]] * 6)}, r"\(1, 2\): nan is not finite"),
    ],
)
def test_the_rules_are_those_of_older_versions(
    tmp_path: Path, variables: dict[str, np.ndarray], what: str
) -> None:
    path = save_v73(tmp_path / "f.mat", variables)
    with pytest.raises(FormationError, match=what) as caught:
        read_mat_positions(path, LayoutRequest())
    assert str(path) in str(caught.value)


def struct_group(file: Any) -> None:
    file.create_group("vehicle_pos").attrs["MATLAB_class"] = np.bytes_("struct")


def sparse_group(file: Any) -> None:
    group = file.create_group("vehicle_pos")
    group.attrs["MATLAB_class"] = np.bytes_("double")
    group.attrs["MATLAB_sparse"] = np.uint64(6)


def text_dataset(file: Any) -> None:
    add(file, "vehicle_pos", np.ones((1, 4), dtype=np.uint16), "char")


def complex_dataset(file: Any) -> None:
    pairs = np.zeros((6, 3), dtype=[("real", "<f8"), ("imag", "<f8")])
    file.create_dataset("vehicle_pos", data=pairs).attrs["MATLAB_class"] = np.bytes_("double")


@pytest.mark.parametrize(
    ("make", "kind"),
    [
        (struct_group, "struct"),
        (sparse_group, "sparse"),
        (text_dataset, "char"),
        (complex_dataset, "complex double"),
    ],
)
def test_only_real_matrices_will_do(tmp_path: Path, make: Any, kind: str) -> None:
    with matlab_file(tmp_path / "f.mat") as file:
        make(file)
        file.create_group("#refs#")
    with pytest.raises(FormationError, match=f"vehicle_pos: of type {kind}; legal: a full matrix"):
        read_mat_positions(tmp_path / "f.mat", LayoutRequest())


def test_a_file_without_its_hdf5_part_is_refused(tmp_path: Path) -> None:
    (tmp_path / "f.mat").write_bytes(matlab_header().ljust(USERBLOCK_BYTES) + bytes(64))
    with pytest.raises(FormationError, match=r"f\.mat: not a readable .mat file \(HDF5: .*v7\.3"):
        read_mat_positions(tmp_path / "f.mat", LayoutRequest())


def test_a_bomb_does_not_fill_the_memory(tmp_path: Path) -> None:
    with matlab_file(tmp_path / "f.mat") as file:
        file.create_dataset("vehicle_pos", shape=(100_000, 6, 1000), dtype="f8", chunks=True)
    with pytest.raises(FormationError, match="a matrix of 600000000 numbers, more than 33554432"):
        read_mat_positions(tmp_path / "f.mat", LayoutRequest())


@pytest.mark.parametrize(
    ("program", "what"),
    [
        ("import os, signal; os.kill(os.getpid(), signal.SIGSEGV)", "crashed on it .Segmentation"),
        ("import signal; signal.pause()", "had not read it after 0.5 s"),
        ("raise MemoryError('no room')", "no room"),
    ],
)
def test_a_library_that_fails_takes_nobody_with_it(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, program: str, what: str
) -> None:
    child = tmp_path / "child.py"
    child.write_text(program)
    monkeypatch.setattr(mat73, "_CHILD", child)
    monkeypatch.setattr(mat73, "_LIMIT_S", 0.5 if "pause" in program else 20.0)
    with pytest.raises(MatError, match=what):
        mat73.read_variables(tmp_path / "f.mat", "vehicle_pos")


@pytest.fixture(scope="module")
def good(tmp_path_factory: pytest.TempPathFactory) -> bytes:
    path = tmp_path_factory.mktemp("mat") / "f.mat"
    return save_v73(path, {"vehicle_pos": positions(4, 6)}, **GZIP).read_bytes()


# An example is a process of 0.1 s.
@settings(max_examples=25)
@given(data=st.data())
def test_a_damaged_file_is_read_or_refused_and_never_crashes(
    good: bytes, tmp_path_factory: pytest.TempPathFactory, data: Any
) -> None:
    path = tmp_path_factory.mktemp("damaged") / "f.mat"
    check_damaged(path, good, USERBLOCK_BYTES, LayoutRequest("TxNx3"), data)


def test_the_child_gets_a_path_whatever_the_working_directory(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    save_v73(tmp_path / "f.mat", {"vehicle_pos": positions(20, 6)})
    monkeypatch.chdir(tmp_path)
    read = read_mat_positions(Path("f.mat"), LayoutRequest())
    np.testing.assert_array_equal(read, positions(20, 6))
