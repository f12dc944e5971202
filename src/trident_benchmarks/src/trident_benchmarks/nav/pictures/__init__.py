# SPDX-FileCopyrightText: 2026 The Trident authors
# SPDX-License-Identifier: Apache-2.0
"""Pictures of robots that drive: tracks and goals on maps, fields, crossings, tight places."""
