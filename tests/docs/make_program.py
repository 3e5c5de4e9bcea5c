#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Makes a C program of the C in a document, so that what it shows is compiled and run.

    python3 tests/docs/make_program.py page.md program.c

The blocks marked ```c follow each other. Blocks that begin with a directive, a type or a function
stand outside of main, the others in it. What readers need not see stands in a comment of Markdown:
a line `<!-- c`, code, a line `-->`. msq.h, some headers of the C library, and check() of
examples/c/hello.c are there; for code that is not shown also model_of(), which fills a shape.
"""
import pathlib
import re
import sys

PRELUDE = """\
#define _POSIX_C_SOURCE 200809L
#include <math.h>
#include <msq.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

static void check(msq_status status) {
  if (status == MSQ_OK) return;
  fprintf(stderr, "%s: %s\\n", msq_status_name(status), msq_error_message());
  exit(1);
}

static msq_model* model_of(msq_context* context, const msq_shape* shape,
                           const msq_structure* structure) {
  const msq_scale_def scales[2] = {{.shape = shape}, {.structure = structure}};
  msq_model_def def;
  check(msq_model_def_init(&def, sizeof def));
  def.scales = scales;
  def.scale_count = 2;
  def.scale_size = sizeof scales[0];
  msq_model* model;
  check(msq_model_create(context, &def, &model));
  return model;
}
"""
BLOCK = re.compile(r"^(?:```c|<!-- c)\n(.*?)^(?:```|-->)$", flags=re.S | re.M)
OUTSIDE = re.compile(r"#|static\s+(?:\w+\s+)*\**\w+\(|typedef\b|(?:struct|enum)\s+\w*\s*\{|"
                     r"\w[\w\s*]*\([^;]*?\)\s*\{")
CONTROL = re.compile(r"(?:if|for|while|switch)\b")


def is_outside(code: str) -> bool:
    plain = re.sub(r"/\*.*?\*/", "", code, flags=re.S).strip()
    return bool(OUTSIDE.match(plain)) and not CONTROL.match(plain)


def program(text: str, name: str) -> str:
    outside, inside = [], []
    for match in BLOCK.finditer(text):
        line = text.count("\n", 0, match.start(1)) + 1
        code = f'#line {line} "{name}"\n{match.group(1)}'
        (outside if is_outside(match.group(1)) else inside).append(code)
    return "\n".join([PRELUDE, *outside, "int main(void) {\n  (void)check, (void)model_of;", *inside,
                      "  return 0;\n}\n"])


def main() -> int:
    if len(sys.argv) != 3:
        sys.exit(__doc__)
    page = pathlib.Path(sys.argv[1])
    pathlib.Path(sys.argv[2]).write_text(program(page.read_text(encoding="utf-8"), str(page)),
                                         encoding="utf-8")
    return 0


if __name__ == "__main__":
    sys.exit(main())
