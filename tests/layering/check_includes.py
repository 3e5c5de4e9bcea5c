#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Dependencies point down, third-party headers stay where they belong, files stay short.

A room (a folder of src/) includes its own files and those of rooms below it, never one above.
A header that is neither in src/ nor of the C or C++ standard library needs a rule below that says
which files may include it.

usage: check_includes.py SOURCE_DIR
"""
import pathlib
import re
import sys

ROOMS = ["document", "api", "printability", "slice", "fill", "surface", "ray", "query", "model", "structure", "cell", "field", "expression", "shape", "io",
         "strut", "base"]  # from the top down

# Rooms within a kind of structure, from the top down. A file of a room includes its own room and those
# below; the files of the kind itself, at its top, include any. A room may include of them only what
# is named here.
KIND_ROOMS = {
    "foam": ["shell", "paper", "rays", "walls", "sets", "joints", "edges", "point", "section",
             "seeds"],
    "lattice": ["warped", "mixed", "plates", "rows", "rays", "graph", "cell"],
}
KIND_BASE = {"foam": {"foam_data.h", "foam_graph.h"}, "lattice": set()}

# Headers from outside src/, and the files of src/ that may include them; the first rule that fits a
# header counts.
OUTSIDE = [
    (r"msq\.h", ["api/*", "document/*"]),
    # Files that are compiled once for each target include these themselves, between their own lines.
    (r"hwy/highway\.h", ["base/simd.cpp", "base/*-inl.h", "shape/*.cpp",
                         "shape/*-inl.h", "strut/*.cpp",
                         "strut/*-inl.h", "slice/*.cpp", "printability/*.cpp",
                         "printability/*-inl.h", "structure/*/*.cpp", "structure/*/*-inl.h",
                         "structure/*/*/*.cpp", "structure/*/*/*-inl.h", "expression/*.cpp",
                         "expression/*-inl.h", "ray/*.cpp"]),
    (r"hwy/foreach_target\.h", ["shape/*.cpp", "strut/*.cpp", "structure/*/*.cpp",
                                "structure/*/*/*.cpp", "slice/*.cpp", "printability/*.cpp", "expression/*.cpp",
                                "ray/*.cpp"]),
    (r"hwy/contrib/math/math-inl\.h", ["structure/functional/single_wave.cpp"]),
    (r"hwy/.*", ["base/simd.h", "base/simd.cpp"]),
    (r"(oneapi/)?tbb/.*", ["base/parallel.cpp"]),
    (r"tiff\w*\.h", ["io/tiff_image.cpp"]),
    (r"nlohmann/.*", ["io/json_text_nlohmann.cpp"]),
    (r"xxh.*\.h", ["base/digest_xxhash.cpp"]),
    (r"pthread\.h|windows\.h", ["api/last_error.cpp"]),  # a key whose values are freed with their threads
    (r"__msvc_int128\.hpp", ["base/int128.h"]),
    (r"execution", ["base/parallel.cpp"]),  # libstdc++ builds it upon TBB
    (r"assimp/.*|pugi(xml|config)\.hpp", ["io/*"]),
    (r"(minizip/)?(unzip|zip|ioapi|mz\w*)\.h|zlib\.h|zconf\.h", ["io/*"]),
    (r"CGAL/.*|gmp(xx)?\.h|mpfr\.h|boost/.*", ["*/*_cgal.cpp", "*/*/*_cgal.cpp", "*/*/*/*_cgal.cpp"]),
]
C_HEADERS = {f"{name}.h" for name in
             "assert complex ctype errno fenv float inttypes iso646 limits locale math setjmp signal "
             "stdalign stdarg stdatomic stdbool stddef stdint stdio stdlib stdnoreturn string tgmath "
             "threads time uchar wchar wctype".split()}

LINES_WARN, LINES_FAIL = 400, 600
LINES_IN = ["src", "include", "tests", "examples", "bench", "bindings", "tools"]
# One header for hosts in each language, however much it declares, and what is made from it.
LINES_FREE = {"include/msq.h", "tests/header/frozen/msq_0_2.h", "bindings/cpp/msq.hpp", "bindings/python/msq/_abi.py"}
LINES_OF = {".h", ".hpp", ".c", ".cpp", ".py"}

INCLUDE = re.compile(r'\s*#\s*include\s*([<"])([^>"]+)[>"]')


def fits(file, glob):
    """Whether a path fits a pattern whose * stands for any name within one folder."""
    return re.fullmatch(r"[^/]*".join(map(re.escape, glob.split("*"))), file) is not None


def problem(source, path, kind, header):
    """What is wrong with file `path` (relative to src/) including `header`, or None."""
    room, file = path.parts[0], path.as_posix()
    for pattern, allowed in OUTSIDE:
        if re.fullmatch(pattern, header):
            if any(fits(file, glob) for glob in allowed):
                return None
            return f"<{header}> belongs in {', '.join(allowed)} only"
    if kind == "<":
        standard = header in C_HEADERS or re.fullmatch(r"[a-z_]+", header)
        return None if standard else f"<{header}> is third-party and has no rule in check_includes.py"
    if not (source / "src" / header).is_file():
        return f'"{header}" is no file of src/ (paths start at src/)'
    target = pathlib.PurePath(header)
    if target.parts[0] not in ROOMS:
        return f'"{header}": {target.parts[0]} is no room'
    if ROOMS.index(target.parts[0]) < ROOMS.index(room):
        return f'"{header}": the arrow from {room} to {target.parts[0]} runs up'
    # structure/common/ is what kinds share, and the contract's defaults.
    if room == "structure" and target.parts[0] == "structure" and len(target.parts) > 2:
        if len(path.parts) == 2 and target.parts[1] != "common":
            return f'"{header}": the contract of structures knows none of its kinds'
        if target.parts[1] != "common" and path.parts[1] != target.parts[1]:
            return f'"{header}": kinds of structures do not know each other'
        return problem_of_kind(path, target)
    return None


def problem_of_kind(path, target):
    """What is wrong with a file below structure/ including another of its kind, or None."""
    kind = path.parts[1]
    if kind not in KIND_ROOMS or target.parts[1] != kind or len(path.parts) == 3:
        return None
    if len(target.parts) == 3:
        allowed = target.name in KIND_BASE[kind]
        return None if allowed else f'"{target}": the rooms of {kind} do not know the files above them'
    rooms = KIND_ROOMS[kind]
    room, other = path.parts[2], target.parts[2]
    if room not in rooms or other not in rooms:
        return f'"{target}": {room} or {other} is no room of {kind}'
    if rooms.index(other) < rooms.index(room):
        return f'"{target}": the arrow from {room} to {other} runs up'
    return None


def check_includes(source):
    errors, count = [], 0
    for path in sorted((source / "src").rglob("*")):
        if path.suffix not in {".h", ".hpp", ".c", ".cpp", ".inl"}:
            continue
        relative = path.relative_to(source / "src")
        if relative.parts[0] not in ROOMS:
            errors.append(f"src/{relative.as_posix()}: {relative.parts[0]} is no room")
            continue
        for number, line in enumerate(path.read_text(encoding="utf-8").splitlines(), 1):
            match = INCLUDE.match(line)
            if match is None:
                continue
            count += 1
            what = problem(source, relative, match.group(1), match.group(2))
            if what:
                errors.append(f"src/{relative.as_posix()}:{number}: {what}")
    if count == 0:
        errors.append(f"{source}/src: no includes found")
    return errors, count


def check_lengths(source):
    errors, warnings = [], []
    for folder in LINES_IN:
        for path in sorted((source / folder).rglob("*")):
            if "node_modules" in path.parts:  # what npm fetched
                continue
            if path.suffix not in LINES_OF or not path.is_file():
                continue
            if path.relative_to(source).as_posix() in LINES_FREE:
                continue
            lines = path.read_bytes().count(b"\n")
            text = f"{path.relative_to(source).as_posix()}: {lines} lines"
            if lines > LINES_FAIL:
                errors.append(f"{text}, over {LINES_FAIL}")
            elif lines > LINES_WARN:
                warnings.append(f"{text}, over {LINES_WARN}")
    return errors, warnings


if __name__ == "__main__":
    if len(sys.argv) != 2:
        sys.exit(__doc__)
    root = pathlib.Path(sys.argv[1])
    include_errors, includes = check_includes(root)
    length_errors, length_warnings = check_lengths(root)
    for warning in length_warnings:
        print(f"warning: {warning}")
    if include_errors or length_errors:
        sys.exit("\n".join(include_errors + length_errors))
    print(f"{includes} includes, all pointing down")
