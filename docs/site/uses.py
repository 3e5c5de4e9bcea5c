# SPDX-License-Identifier: Apache-2.0
"""Where the repository's documents and examples name the symbols of msq.h and msq_io.h."""
import pathlib
import re
from typing import Dict, List, Set

from reference import ROOT

WORD = re.compile(r"\b(?:msq|MSQ)_\w+\b")


def documents() -> List[pathlib.Path]:
    """Pages for users, without the history of decisions and changes."""
    return [ROOT / "README.md", *sorted((ROOT / "docs").glob("*.md")),
            *sorted((ROOT / "docs" / "howto").glob("*.md")),
            *sorted((ROOT / "docs" / "tutorials").glob("*.md"))]


def examples() -> List[pathlib.Path]:
    found = [*(ROOT / "examples").glob("*/*.c"), *(ROOT / "examples").glob("*/*.cpp"),
             *(ROOT / "examples").glob("*/*.h"), ROOT / "examples" / "python" / "slice_ctypes.py"]
    return sorted(found)


def words(path: pathlib.Path) -> Set[str]:
    """What a reader sees: without the code in comments of a document."""
    text = re.sub(r"^<!-- c$.*?^-->$", "", path.read_text(encoding="utf-8"), flags=re.S | re.M)
    return set(WORD.findall(text))


def code_words(path: pathlib.Path) -> Set[str]:
    """The words of the C that a document shows, which tests/docs compiles and runs."""
    text = path.read_text(encoding="utf-8")
    code = re.findall(r"^```c$(.*?)^```$", text, flags=re.S | re.M)
    return set(WORD.findall("\n".join(code)))


def by_symbol(paths: List[pathlib.Path], find=words) -> Dict[str, List[pathlib.Path]]:
    found: Dict[str, List[pathlib.Path]] = {}
    for path in paths:
        for word in find(path):
            found.setdefault(word, []).append(path)
    return found
