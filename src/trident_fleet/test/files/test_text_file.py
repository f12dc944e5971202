# SPDX-FileCopyrightText: 2026 The Trident authors
# SPDX-License-Identifier: Apache-2.0
from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from hypothesis.extra.numpy import arrays
from trident_fleet.core.errors import FormationError
from trident_fleet.core.files.text_file import read_text_rows

finite = st.floats(allow_nan=False, allow_infinity=False, width=64)


def write(folder: Path, content: str | bytes) -> Path:
    path = folder / "rows.txt"
    path.write_bytes(content.encode() if isinstance(content, str) else content)
    return path


@pytest.mark.parametrize(
    "content",
    [
        "1\t0.5\t-2\t3e-1\n2\t1\t2\t3\n",
        " 1 0.5 -2 3e-1\n 2 1 2 3\n",
        "1,0.5,-2,3e-1\r\n2,1,2,3\r\n",
        "1, 0.5 ,\t-2, .3\n2,+1,2.,3",
        "% a title\n% index x y z\r\n1\t5.0e-01\t-2.0E+00\t0.3 % note\r\n\r\n2 1 2 3",
        "# octave\n\n   1    5d-1   -2.0D0   0.3\n2 1 2 3\n\n",
        b"\xef\xbb\xbf1 0.5 -2 0.3\n2 1 2 3\n",
        "% pos\xe9\n1 0.5 -2 0.3\n2 1 2 3\n".encode("latin-1"),
    ],
    ids=["tab", "space", "comma_crlf", "mixed", "comments", "octave", "bom", "latin1_comment"],
)
def test_every_written_form_gives_the_same_rows(tmp_path: Path, content: str | bytes) -> None:
    rows = read_text_rows(write(tmp_path, content))
    np.testing.assert_array_equal(rows, [[0.5, -2.0, 0.3], [1.0, 2.0, 3.0]])


@pytest.mark.parametrize(
    ("content", "where", "what"),
    [
        ("1 2 3 4\n1 2 3\n", ":2:", "3 columns in '1 2 3'; legal: 4"),
        ("1 2 3 4 5\n", ":1:", "5 columns"),
        ("1,2,3,\n", ":1: column z", "'' is not a number"),
        ("% one\n1 2 abc 4\n", ":2: column y", "'abc' is not a number"),
        ("1 2 1_0 4\n", ":1: column y", "'1_0' is not a number"),
        ("1 2 3 NaN\n", ":1: column z", "NaN is not finite"),
        ("1 -Inf 3 4\n", ":1: column x", "-Inf is not finite"),
        ("one 2 3 4\n", ":1: column index", "'one' is not a number"),
        ("1 2 3 1e999\n", ":1: column z", "out of range"),
        ("", "rows.txt:", "no rows"),
        ("% only a title\n\n", "rows.txt:", "no rows"),
        (b"1 2 3 4\n\x00\x01", "rows.txt:", "binary data"),
    ],
)
def test_bad_input_gives_one_error_with_place_value_and_what_is_legal(
    tmp_path: Path, content: str | bytes, where: str, what: str
) -> None:
    with pytest.raises(FormationError) as caught:
        read_text_rows(write(tmp_path, content))
    message = str(caught.value)
    assert where in message
    assert what in message
    assert "legal: " in message
    assert "\n" not in message


@given(
    rows=arrays(np.float64, st.tuples(st.integers(1, 8), st.just(3)), elements=finite),
    separator=st.sampled_from(["\t", " ", ",", " , ", "   "]),
    end=st.sampled_from(["\n", "\r\n"]),
    lead=st.sampled_from(["", " ", "\t"]),
    style=st.sampled_from([repr, "{:.17e}".format, "{:.17E}".format, "{:+.17g}".format]),
)
def test_what_is_written_is_read_to_the_bit(
    tmp_path_factory: pytest.TempPathFactory,
    rows: np.ndarray,
    separator: str,
    end: str,
    lead: str,
    style: object,
) -> None:
    lines = [
        lead + separator.join([str(number + 1), *(style(float(v)) for v in row)])  # type: ignore[operator]
        for number, row in enumerate(rows)
    ]
    path = write(tmp_path_factory.mktemp("text"), end.join(lines) + end)
    np.testing.assert_array_equal(read_text_rows(path), rows)


GOOD = b"% index x y z\n1\t0.5\t1.25\t-3e-1\r\n2, 1, 2, 3\n 3 4 5 6\n"


@given(
    place=st.integers(0, len(GOOD) - 1),
    length=st.integers(0, 4),
    patch=st.binary(max_size=4),
)
def test_a_damaged_file_is_read_or_refused_and_never_crashes(
    tmp_path_factory: pytest.TempPathFactory, place: int, length: int, patch: bytes
) -> None:
    damaged = GOOD[:place] + patch + GOOD[place + length :]
    path = write(tmp_path_factory.mktemp("damaged"), damaged)
    try:
        rows = read_text_rows(path)
    except FormationError as refusal:
        message = str(refusal)
    else:
        message = str(path)
        assert rows.shape[1] == 3
        assert np.isfinite(rows).all()
    assert str(path) in message


@pytest.mark.parametrize("name", ["zero", "urandom"])
def test_a_device_is_refused_and_not_read(name: str) -> None:
    with pytest.raises(FormationError, match=f"/dev/{name}: a device; legal: a file"):
        read_text_rows(Path("/dev") / name)


def test_a_file_that_is_too_large_is_refused_by_its_size(tmp_path: Path) -> None:
    path = tmp_path / "huge.txt"
    with path.open("wb") as stream:
        stream.truncate(1 << 40)
    with pytest.raises(FormationError, match=r"huge\.txt: more than 268435456 bytes"):
        read_text_rows(path)


def test_long_words_of_bad_input_are_cut_and_paths_are_not() -> None:
    path = f"/a/{'d' * 250}/f.txt:"
    error = FormationError(f"{path} '{'x' * 100000}' is not a number")
    assert str(error) == f"{path} '{'x' * 199}... is not a number"
