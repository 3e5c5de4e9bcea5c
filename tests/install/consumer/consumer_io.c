/* SPDX-License-Identifier: Apache-2.0
 * The least that a host does with msq_io: both libraries are those of the headers, and refuse. */
#include <msq_io.h>
#include <stdio.h>

int main(void) {
  msq_io_png_def def;
  if (msq_io_version() != MSQ_VERSION || msq_version() != MSQ_VERSION) return 1;
  if (msq_io_png_def_init(&def, sizeof def) != MSQ_OK || def.digits != 5) return 1;
  if (msq_io_picture_save("", 1, 1, 1, NULL, 0, 0) != MSQ_E_ARGUMENT) return 1;
  printf("msq_io %u: %s\n", (unsigned)msq_io_version(), msq_io_error_message());
  return 0;
}
