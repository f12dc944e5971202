# SPDX-FileCopyrightText: 2026 The Trident authors
# SPDX-License-Identifier: Apache-2.0
"""The start of a node that ends well."""

from __future__ import annotations

import signal
import threading
from types import FrameType
from typing import Any

import rospy


def init_node(name: str, **options: Any) -> None:
    """As rospy.init_node(), but SIGINT and SIGTERM shut down in a thread of their own.

    rospy shuts down inside of the signal handler, so on top of what the main thread does. If that
    publishes or asks the master, it holds a lock that shutting down takes, too: the node hangs.

    Args:
        name: see rospy.init_node(); to be called from the main thread.
        options: as well, but for `disable_signals`.

    Raises:
        ValueError: this is not the main thread.
        rospy.ROSException: see rospy.init_node().
    """
    rospy.init_node(name, disable_signals=True, **options)
    for number in (signal.SIGINT, signal.SIGTERM):
        signal.signal(number, _shut_down)


def _shut_down(number: int, _frame: FrameType | None) -> None:
    # No daemon: the process ends once the master knows that the node is gone.
    reason = f"signal-{number}"
    threading.Thread(target=rospy.signal_shutdown, args=[reason], name=reason).start()
