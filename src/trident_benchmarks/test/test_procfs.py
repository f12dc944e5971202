# SPDX-FileCopyrightText: 2026 The Trident authors
# SPDX-License-Identifier: Apache-2.0
"""Reading /proc."""

from __future__ import annotations

import os
import time

import pytest
from trident_benchmarks.procfs import (
    Memory,
    descendants_of,
    memory_of,
    parse_machine_busy,
    parse_memory,
    parse_parent,
    parse_process_cpu,
    process_cpu_s,
    process_tree,
)
from trident_eval.core.errors import EvalError

_STAT = "42 (a (b) c) S 7 42 42 0 -1 4194560 100 0 0 0 150 50 900 900 20 0 3 0 1000 1 2 3"


def test_cpu_is_user_and_system_time_without_children_whatever_the_name():
    assert parse_process_cpu(_STAT, tick_s=0.01) == pytest.approx(2.0)
    assert parse_parent(_STAT) == 7


@pytest.mark.parametrize("text", ["", "42 (name) S 7", "42 (name) S 7 1 1 1 1 1 1 1 1 1 1 x y"])
def test_a_text_without_times_is_refused(text):
    with pytest.raises(EvalError, match="utime and stime"):
        parse_process_cpu(text)


def test_memory_is_in_mb():
    status = "Name:\tx\nVmHWM:\t    4096 kB\nVmRSS:\t    2048 kB\n"
    assert parse_memory(status) == Memory(rss_mb=2.0, peak_mb=4.0)


def test_a_process_that_has_ended_has_no_memory():
    with pytest.raises(EvalError, match="VmRSS"):
        parse_memory("Name:\tx\nState:\tZ (zombie)\n")


def test_busy_time_leaves_out_idle_iowait_and_what_guests_count_twice():
    #                  user nice system idle iowait irq softirq steal guest guest_nice
    stat = "cpu  100 10 50 1000 200 1 2 3 40 5\ncpu0 1 1 1 1 1 1 1 1 1 1\n"
    assert parse_machine_busy(stat, tick_s=0.01) == pytest.approx(1.66)


def test_busy_time_needs_the_sum_of_all_cores():
    with pytest.raises(EvalError, match="cpu"):
        parse_machine_busy("cpu0 1 2 3\n")


def test_descendants_are_found_at_any_depth_and_order():
    parents = {2: 1, 3: 9, 9: 2, 4: 1, 5: 4, 1: 0}
    assert descendants_of(2, parents) == [2, 3, 9]
    assert descendants_of(77, parents) == [77]


def test_this_process_can_be_measured():
    begin = process_cpu_s(os.getpid())
    until = time.process_time() + 0.05
    while time.process_time() < until:
        pass
    assert 0.03 <= process_cpu_s(os.getpid()) - begin < 5.0
    memory = memory_of(os.getpid())
    assert 1.0 < memory.rss_mb <= memory.peak_mb
    assert os.getpid() in process_tree(os.getpid())
