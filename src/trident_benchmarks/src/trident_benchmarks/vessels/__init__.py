# SPDX-FileCopyrightText: 2026 The Trident authors
# SPDX-License-Identifier: Apache-2.0
"""Checks of vessels and the sea against closed forms and published models, with pictures."""
