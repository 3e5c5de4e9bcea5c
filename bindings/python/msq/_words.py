# SPDX-License-Identifier: Apache-2.0
"""Messages of the library in the words of the package."""
from __future__ import annotations

import re

_PLURALS = {"curve": "points of the curve", "layer_z": "heights"}


def _of_count(found: "re.Match[str]") -> str:
    word = found[1]
    return f"the number of {_PLURALS.get(word, word + 's')} is"


def in_words_of_python(message: str) -> str:
    """Members lose C's struct; counts of arrays and constants get the names that they have here.

    A member or a count is what a message begins with; further on are the caller's own words.
    """
    message = re.sub(r"^(?:grid|image)\.(?=[a-z])", "", message)
    message = re.sub(r"^([a-z][a-z_]*)_count is\b", _of_count, message)
    message = re.sub(r"^the file exists and replace is 0\b", "the file exists and replace is False", message)
    return re.sub(r"\bMSQ_(?:FOAM|POINTS)_([A-Z0-9_]+)", lambda found: repr(found[1].lower()), message)
