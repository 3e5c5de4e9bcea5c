// SPDX-License-Identifier: Apache-2.0
#include <engine.h>

#include <cstdio>

int main() {
  std::puts(engine_backend());
  return 0;
}
