# SPDX-FileCopyrightText: 2026 The Trident authors
# SPDX-License-Identifier: Apache-2.0
"""Plugin of pytest: a run ends after TRIDENT_TEST_LIMIT_S of time that the machine gave it.

ctest's own limit is one of wall time, which a loaded machine exceeds with nothing being wrong.
"""

from __future__ import annotations

import _thread
import faulthandler
import os
import sys
import threading

import pytest

from trident.patience import Patience

VARIABLE = "TRIDENT_TEST_LIMIT_S"
_LOOK_S = 2.0
_LAST_S = 60.0  # of wall time, for fixtures to end what they have started
_HUNG = 3


def pytest_configure(config: pytest.Config) -> None:
    """Begins to count."""
    limit_s = float(os.environ.get(VARIABLE, "0"))
    if limit_s > 0.0:
        over = threading.Event()
        config.add_cleanup(over.set)
        threading.Thread(target=_watch, args=(limit_s, over), daemon=True).start()


def _watch(limit_s: float, over: threading.Event) -> None:
    patience = Patience()
    while patience.spent_s() < limit_s:
        if over.wait(_LOOK_S):
            return
    print(f"\nnot done after {limit_s:g} s that the machine gave it; it is here:", file=sys.stderr)
    faulthandler.dump_traceback(sys.__stderr__ or sys.stderr)
    _thread.interrupt_main()
    if not over.wait(_LAST_S):
        os._exit(_HUNG)
