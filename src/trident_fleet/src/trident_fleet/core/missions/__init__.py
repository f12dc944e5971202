# SPDX-FileCopyrightText: 2026 The Trident authors
# SPDX-License-Identifier: Apache-2.0
"""Missions: behavior trees over vehicles, tasks and a search; a whole mission in one process."""
