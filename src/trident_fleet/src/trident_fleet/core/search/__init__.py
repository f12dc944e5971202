# SPDX-FileCopyrightText: 2026 The Trident authors
# SPDX-License-Identifier: Apache-2.0
"""Search: where somebody may be, what has been seen, and how robots cover an area."""
