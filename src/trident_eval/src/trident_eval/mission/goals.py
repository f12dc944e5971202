# SPDX-FileCopyrightText: 2026 The Trident authors
# SPDX-License-Identifier: Apache-2.0
"""What a joint mission has to reach."""

GOALS = {"coverage": 0.97, "found": 0.97, "served": 0.95}
"""Least shares of cells covered, of people found and of people served."""
