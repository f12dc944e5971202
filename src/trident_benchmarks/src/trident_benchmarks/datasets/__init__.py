# SPDX-FileCopyrightText: 2026 The Trident authors
# SPDX-License-Identifier: Apache-2.0
"""Drives through simulated worlds that others measure by: how they are driven and recorded."""
