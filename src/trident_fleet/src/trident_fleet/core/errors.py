# SPDX-FileCopyrightText: 2026 The Trident authors
# SPDX-License-Identifier: Apache-2.0
"""The one exception of this package."""


class FormationError(ValueError):
    """Bad input: the message names file, line or field, the value and what is legal."""
