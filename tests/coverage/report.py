#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Prints what gcovr counted: for each folder the lines and branches that ran, then the lines that did not.

usage: report.py coverage.json
Exit status 1 if fewer ran than the targets below.
"""
import collections
import json
import pathlib
import sys

TARGETS = {"lines": 97.0, "branches": 90.0}
ROOT = pathlib.Path(__file__).resolve().parents[2]


def spans(numbers):
    """3, 5-8"""
    found = []
    for number in numbers:
        if found and number == found[-1][1] + 1:
            found[-1][1] = number
        else:
            found.append([number, number])
    return ", ".join(f"{low}" if low == high else f"{low}-{high}" for low, high in found)


def percent(ran, count):
    return 100 * ran / count if count else 100.0


def main():
    files = json.loads(pathlib.Path(sys.argv[1]).read_text(encoding="utf-8"))["files"]
    folders = collections.defaultdict(lambda: [0, 0, 0, 0])
    missed = []
    for file in sorted(files, key=lambda one: one["file"]):
        lines = [one for one in file["lines"] if not one.get("gcovr/noncode")]
        branches = [branch for line in lines for branch in line["branches"] if not branch.get("throw")]
        counts = (sum(one["count"] > 0 for one in lines), len(lines),
                  sum(one["count"] > 0 for one in branches), len(branches))
        folder = "/".join(file["file"].split("/")[:-1])
        for name in (folder, "src"):
            folders[name] = [a + b for a, b in zip(folders[name], counts)]
        left = [one["line_number"] for one in lines if one["count"] <= 0]
        half = [one["line_number"] for one in lines if one["count"] > 0
                and any(branch["count"] <= 0 and not branch.get("throw") for branch in one["branches"])]
        if left or half:
            missed.append((file["file"], left, half))
    print(f"{'folder':36} {'lines':>16} {'branches':>18}")
    for folder, (ran, lines, taken, branches) in sorted(folders.items()):
        print(f"{folder:36} {percent(ran, lines):6.2f} % {f'of {lines}':>9} {percent(taken, branches):6.2f} % {f'of {branches}':>9}")
    print("\nlines that did not run:")
    for name, left, _ in missed:
        if left:
            print(f"{name}: {spans(left)}")
    print("\nlines with a branch that was not taken, most of them first:")
    for name, _, half in sorted(missed, key=lambda one: -len(one[2]))[:40]:
        if half:
            print(f"{name}: {spans(half)}")
    ran, lines, taken, branches = folders["src"]
    got = {"lines": percent(ran, lines), "branches": percent(taken, branches)}
    short = [f"{got[what]:.2f} % of the {what}, not {target:g} %" for what, target in TARGETS.items() if got[what] < target]
    print("\nsrc: " + ("; ".join(short) if short else f"{got['lines']:.2f} % of the lines, {got['branches']:.2f} % of the branches"))
    return 1 if short else 0


if __name__ == "__main__":
    sys.exit(main())
