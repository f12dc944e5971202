# SPDX-FileCopyrightText: 2026 The Trident authors
# SPDX-License-Identifier: Apache-2.0
"""The one exception of this package."""


class EvalError(ValueError):
    """A run that cannot be judged: the message names file, line or field, value, legal range."""
