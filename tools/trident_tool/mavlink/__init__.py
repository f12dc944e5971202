# SPDX-FileCopyrightText: 2026 The Trident authors
# SPDX-License-Identifier: Apache-2.0
"""The ``mavlink`` subcommand: which vehicles speak it, what they say, logs played again."""
