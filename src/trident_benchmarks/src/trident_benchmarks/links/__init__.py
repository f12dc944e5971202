# SPDX-FileCopyrightText: 2026 The Trident authors
# SPDX-License-Identifier: Apache-2.0
"""Radio links: goodput next to ns-3's, rate control, what they cost."""
