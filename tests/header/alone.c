/* SPDX-License-Identifier: Apache-2.0
 * msq.h needs no other header, may be included twice, and compiles as C and C++ without warnings.
 */
#include "msq.h"

#if MSQ_VERSION != MSQ_VERSION_MAJOR * 10000 + MSQ_VERSION_MINOR * 100 + MSQ_VERSION_PATCH
#error "MSQ_VERSION does not follow from its parts"
#endif

/* Statuses are 32 bits on every machine. */
typedef char msq_status_is_32_bits[sizeof(msq_status) == 4 ? 1 : -1];

/* A host's function goes where the callback is asked for. */
static int32_t take(void* user, const msq_layer* layer) {
  (void)user;
  return layer == NULL ? -1 : 0;
}

int main(void) {
  const msq_status_is_32_bits zero = {0};
  msq_layer_fn fn = take;
  return fn(NULL, NULL) + 1 + zero[0];
}
