# SPDX-FileCopyrightText: 2026 The Trident authors
# SPDX-License-Identifier: Apache-2.0
"""The exceptions of this package."""

from trident_base.error_text import with_short_words


class FormationError(ValueError):
    """Bad input: the message names file, line or field, the value and what is legal."""

    def __init__(self, text: str) -> None:
        """Long words of bad input are cut."""
        super().__init__(with_short_words(text))


class RowError(FormationError):
    """A row of a formation that cannot be flown; who knows the rows' file names it."""

    def of_file(self, file: str) -> FormationError:
        """The same error, with its file."""
        return FormationError(f"{file}: {self}")
