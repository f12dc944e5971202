# SPDX-FileCopyrightText: 2026 The Trident authors
# SPDX-License-Identifier: Apache-2.0
"""What the xacro command adds to the library: fewer imports, kept expansions."""
