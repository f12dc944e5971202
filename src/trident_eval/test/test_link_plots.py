# SPDX-FileCopyrightText: 2026 The Trident authors
# SPDX-License-Identifier: Apache-2.0
"""The picture of radio links: which lines it has."""

from __future__ import annotations

from pathlib import Path

import numpy as np
from radio_runs import three_radios, write_links
from trident_eval.core.radio.link_plots import busy_pairs, draw_links, received_rate, snr_of
from trident_eval.core.radio.links import LinkLog, read_links


def log_of(folder: Path, lines: list[str]) -> LinkLog:
    write_links(folder, lines)
    log = read_links(folder)
    assert log is not None
    return log


def test_a_pair_counts_once_and_only_with_traffic(tmp_path: Path) -> None:
    assert busy_pairs(log_of(tmp_path, three_radios())) == [("gcs", "uav1"), ("gcs", "usv1")]


def test_traffic_of_one_direction_is_enough(tmp_path: Path) -> None:
    lines = [
        "0.5,b,a,10,20,7,0,0,0,1,1,0,0",
        "0.5,a,b,10,20,7,0,0,0,0,1,0,0",
        "0.5,a,c,1,20,7,0,0,0,0,1,0,0",
    ]
    assert busy_pairs(log_of(tmp_path, lines)) == [("a", "b")]


def test_the_snr_of_a_pair_is_that_of_either_direction(tmp_path: Path) -> None:
    lines = [
        "1,a,b,9,20,7,1,0,0,0,1,0,0",
        "2,b,a,9,21,7,1,0,0,0,1,0,0",
        "3,a,b,9,-inf,7,1,0,0,0,1,0,0",
    ]
    log = log_of(tmp_path, lines)
    np.testing.assert_array_equal(snr_of(log, ("a", "b")), [20.0, 21.0, np.nan])


def test_what_a_robot_receives_is_the_sum_over_sources(tmp_path: Path) -> None:
    lines = [
        *("0.5,a,c,9,20,7,4,0,0,0,1,0,0", "0.5,b,c,9,20,7,0,0,0,0,1,0,0"),
        *("1.0,a,c,9,20,7,6,0,0,0,1,0,0", "1.0,b,c,9,20,7,3,0,0,0,1,0,0"),
        *("2.0,a,c,9,20,7,2,0,0,0,1,0,0", "2.0,b,c,9,20,7,3,0,0,0,1,0,0"),
    ]
    log = log_of(tmp_path, lines)
    np.testing.assert_allclose(received_rate(log, "c"), [0.0, 10.0, 7.0 / 1.5])
    np.testing.assert_allclose(received_rate(log, "a"), 0.0)


def test_of_a_run_with_rules_what_crossed_by_them_counts(tmp_path: Path) -> None:
    lines = [f"{0.5 * i},a,b,9,20,7,{3 * i},0,0,0,1,{i // 2},0" for i in range(1, 21)]
    rate = received_rate(log_of(tmp_path, lines), "b")
    np.testing.assert_allclose(rate[5:], 1.0)


def test_the_picture_is_not_blank_and_comes_out_the_same(tmp_path: Path) -> None:
    from matplotlib.image import imread

    log = log_of(tmp_path, three_radios())
    (path,) = draw_links(log, "coast", tmp_path)
    assert path.name == "links.png"
    first = path.read_bytes()
    pixels = imread(path)[..., :3]
    assert 0.005 < (pixels < 0.9).any(axis=-1).mean() < 0.5
    draw_links(log, "coast", tmp_path)
    assert path.read_bytes() == first


def test_without_traffic_or_time_there_is_no_picture(tmp_path: Path) -> None:
    silent = ["0.5,a,b,9,20,7,0,0,0,0,1,0,0", "1.0,a,b,9,20,7,0,0,0,0,1,0,0"]
    assert draw_links(log_of(tmp_path, silent), "silent", tmp_path) == []
    once = ["0.5,a,b,9,20,7,3,0,0,0,1,0,0"]
    assert draw_links(log_of(tmp_path, once), "once", tmp_path) == []


def test_links_of_which_none_is_heard_are_drawn(tmp_path: Path) -> None:
    deaf = [f"{t},a,b,9000,-inf,0,0,{n},0,0,0,0,0" for n, t in enumerate((0.5, 1.0, 1.5))]
    assert draw_links(log_of(tmp_path, deaf), "deaf", tmp_path)
