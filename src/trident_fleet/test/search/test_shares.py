# SPDX-FileCopyrightText: 2026 The Trident authors
# SPDX-License-Identifier: Apache-2.0
from __future__ import annotations

import numpy as np
import pytest
from scipy.ndimage import label
from trident_fleet.core.search.area import SearchError
from trident_fleet.core.search.samples import of_three_kinds
from trident_fleet.core.search.shares import Searcher, balanced_shares


@pytest.mark.parametrize("seed", range(12))
def test_three_kinds_are_done_within_five_percent_of_each_other(seed: int) -> None:
    robots = of_three_kinds(seed)
    shares = balanced_shares(robots)
    assert shares.imbalance <= 0.05
    for index, robot in enumerate(robots):
        own = shares.owner == index
        assert np.isfinite(robot.seconds[own]).all(), "nobody has what it does not get to"
        pieces = label(own, np.ones((3, 3)))[1]
        assert pieces == 1 or (robot.name == "uav" and pieces > 1), "it flies over the others'"
        assert robot.seconds[own].sum() == pytest.approx(shares.finish_s[index])
    assert (shares.owner >= 0).all()


def test_a_robot_that_is_busy_at_first_gets_less() -> None:
    seconds = np.ones((20, 20))
    one, other = Searcher("a", (0, 0), seconds), Searcher("b", (19, 19), seconds, ready_s=100.0)
    shares = balanced_shares([one, other])
    assert shares.finish_s == pytest.approx([250.0, 250.0], abs=8.0)


def test_who_gets_nowhere_else_is_done_early() -> None:
    pond = np.full((12, 30), np.inf)
    pond[:4, :5] = 1.0
    shares = balanced_shares(
        [Searcher("land", (6, 15), np.ones((12, 30))), Searcher("pond", (0, 0), pond)]
    )
    assert (shares.owner == 1).sum() >= 18, "all of it, or nearly"
    assert shares.finish_s[0] >= 340.0


def test_cells_that_nobody_gets_to_have_no_owner() -> None:
    seconds = np.ones((6, 6))
    seconds[:, 3] = np.inf
    shares = balanced_shares([Searcher("a", (0, 0), seconds)])
    assert (shares.owner[:, 3:] == -1).all()
    assert (shares.owner[:, :3] == 0).all()


def test_bad_input_names_what_is_wrong() -> None:
    seconds = np.ones((4, 4))
    with pytest.raises(SearchError, match="there is no robot"):
        balanced_shares([])
    with pytest.raises(SearchError, match=r"start of a is \(9, 0\), legal: on the grid"):
        balanced_shares([Searcher("a", (9, 0), seconds)])
    with pytest.raises(SearchError, match=r"seconds of b have shape \(2, 2\), legal: \(4, 4\)"):
        balanced_shares([Searcher("a", (0, 0), seconds), Searcher("b", (0, 0), np.ones((2, 2)))])
    dry = np.where(np.arange(16).reshape(4, 4) > 0, 1.0, np.inf)
    with pytest.raises(SearchError, match=r"start of a is \(0, 0\), legal: a cell that it gets"):
        balanced_shares([Searcher("a", (0, 0), dry)])
    with pytest.raises(SearchError, match="seconds of a, legal: all above 0"):
        balanced_shares([Searcher("a", (0, 0), np.zeros((4, 4)))])
    with pytest.raises(SearchError, match=r"tolerance is 1.0, legal: 0 ... 1"):
        balanced_shares([Searcher("a", (0, 0), seconds)], tolerance=1.0)
