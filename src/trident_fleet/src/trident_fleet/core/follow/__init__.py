# SPDX-FileCopyrightText: 2026 The Trident authors
# SPDX-License-Identifier: Apache-2.0
"""Followers that keep a formation about a leader that flies as it likes."""
