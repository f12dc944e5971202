# SPDX-FileCopyrightText: 2026 The Trident authors
# SPDX-License-Identifier: Apache-2.0
"""Metrics, verdicts and pictures of recorded runs."""

from trident_base.moved_modules import keep_old_names

from trident_eval.moved_names import NEW_NAMES

keep_old_names(NEW_NAMES)
