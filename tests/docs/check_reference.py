#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Every declaration of msq.h and msq_io.h is described, says its errors, and is shown.

    python3 tests/docs/check_reference.py [--write]

Fails for a symbol without a description; for a function that returns msq_status without a list of
errors; and for a function that neither a document's compiled C nor an example calls, or a callback,
struct or enum that no document or example names. docs/site/exceptions.txt lists those that may lack
the last; it must list no more than needed. --write writes it.
"""
import pathlib
import sys

ROOT = pathlib.Path(__file__).resolve().parent.parent.parent
sys.path[:0] = [str(ROOT / "docs" / "site"), str(ROOT / "bindings" / "abi")]
import header as abi_header  # noqa: E402
import reference as header  # noqa: E402
import uses  # noqa: E402

EXCEPTIONS = ROOT / "docs" / "site" / "exceptions.txt"
HEAD = """\
# Symbols of the headers that no example or compiled document uses (functions), or that none names (others).
# tests/docs/check_reference.py fails if a line is missing or no longer needed.
"""


def problems_of_comments(found):
    for symbol in found.symbols.values():
        if symbol.kind == "macro" and symbol.name.startswith("MSQ_VERSION_"):
            continue
        text = header.parts(symbol.comment)
        other = header.inherited(symbol, found)
        if not text.get(""):
            yield f"{symbol.name} has no description"
        if symbol.kind != "function" or symbol.returns != "msq_status":
            continue
        if "Errors" not in text and not (other and "Errors" in other.comment):
            yield f"{symbol.name} has no list of errors (Errors: ...)"
        if "Errors" in text and not other and not header.errors(text["Errors"]):
            yield f"{symbol.name} lists errors that are no statuses: {text['Errors']}"


def problems_of_reading():
    """Two readers of msq.h see the same symbols."""
    found = header.read([header.HEADER])
    abi = abi_header.read_header(header.HEADER)
    kinds = {"function": abi.functions, "struct": abi.structs, "callback": abi.callbacks,
             "enum": abi.enums}
    names = {kind: {one.name for one in ones} for kind, ones in kinds.items()}
    names["handle"] = set(abi.handles)
    for kind, others in names.items():
        mine = {symbol.name for symbol in found.symbols.values() if symbol.kind == kind}
        for name in sorted(mine ^ others):
            yield f"{name}: docs/site and bindings/abi disagree whether msq.h declares this {kind}"
    members = {name for symbol in found.symbols.values() if symbol.kind == "enum"
               for member in symbol.members for name in member.names}
    members |= {symbol.name for symbol in found.symbols.values() if symbol.kind == "macro"}
    for name in sorted(members ^ set(abi_header.constants_of(abi))):
        yield f"{name}: docs/site and bindings/abi disagree whether msq.h has this constant"


def not_shown(found):
    shown = uses.by_symbol(uses.examples())
    for name, paths in uses.by_symbol(uses.documents(), uses.code_words).items():
        shown.setdefault(name, []).extend(paths)
    named = {**uses.by_symbol(uses.documents()), **shown}
    for symbol in found.symbols.values():
        names = [symbol.name]
        if symbol.kind == "enum":  # one of its values will do
            names += [name for member in symbol.members for name in member.names]
        where = shown if symbol.kind == "function" else named
        if symbol.kind not in ("macro", "type") and not any(name in where for name in names):
            yield symbol.name


def main() -> int:
    found = header.read()
    missing = sorted(not_shown(found))
    if "--write" in sys.argv[1:]:
        EXCEPTIONS.write_text(HEAD + "".join(name + "\n" for name in missing), encoding="utf-8")
    problems = [*problems_of_reading(), *problems_of_comments(found)]
    listed = [line for line in EXCEPTIONS.read_text(encoding="utf-8").split("\n")
              if line and not line.startswith("#")]
    for name in sorted(set(missing) - set(listed)):
        problems.append(f"{name} is in no example and in no document's C: add it to one (docs/howto)")
    for name in sorted(set(listed) - set(missing)):
        problems.append(f"{name} is shown: remove it from {EXCEPTIONS.relative_to(ROOT)}")
    print("\n".join(problems) if problems else f"{len(found.symbols)} symbols")
    return 1 if problems else 0


if __name__ == "__main__":
    sys.exit(main())
