# SPDX-FileCopyrightText: 2026 The Trident authors
# SPDX-License-Identifier: Apache-2.0
"""Delays the hand-overs of rospy nodes.

Python runs it in every process that has its folder on PYTHONPATH, so that the nodes themselves know
nothing of it. It does nothing without TRIDENT_SCHEDULE_FUZZ, the seed.
"""

import os

if os.environ.get("TRIDENT_SCHEDULE_FUZZ"):
    import delayed_rospy  # type: ignore[import-not-found]

    delayed_rospy.install(os.environ["TRIDENT_SCHEDULE_FUZZ"])
