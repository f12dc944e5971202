# SPDX-FileCopyrightText: 2026 The Trident authors
# SPDX-License-Identifier: Apache-2.0
"""The simulator: flights in-process and in lockstep, whole launches, the three domains together."""
