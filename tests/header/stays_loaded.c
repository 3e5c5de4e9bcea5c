/* SPDX-License-Identifier: Apache-2.0 */
/* The library stays in the process when a host closes it: threads of oneTBB may still run its code.
 * usage: stays_loaded LIBRARY */
#define _POSIX_C_SOURCE 200112L
#include <dlfcn.h>
#include <stdio.h>

int main(int count, char** arguments) {
  void* const library = count == 2 ? dlopen(arguments[1], RTLD_NOW | RTLD_LOCAL) : NULL;
  if (library == NULL) {
    fprintf(stderr, "%s\n", count == 2 ? dlerror() : "usage: stays_loaded LIBRARY");
    return 1;
  }
  if (dlclose(library) != 0 || dlopen(arguments[1], RTLD_NOW | RTLD_NOLOAD) == NULL) {
    fprintf(stderr, "the library was unloaded\n");
    return 1;
  }
  return 0;
}
