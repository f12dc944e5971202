# SPDX-FileCopyrightText: 2026 The Trident authors
# SPDX-License-Identifier: Apache-2.0
"""Missions of search and rescue in one process: flown, judged and drawn; their trees, too."""
