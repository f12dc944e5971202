# SPDX-FileCopyrightText: 2026 The Trident authors
# SPDX-License-Identifier: Apache-2.0
"""The one exception of this package."""

from trident_base.error_text import with_short_words


class EvalError(ValueError):
    """A run that cannot be judged: the message names file, line or field, value, legal range."""

    def __init__(self, text: str) -> None:
        """Long words of bad input are cut."""
        super().__init__(with_short_words(text))
