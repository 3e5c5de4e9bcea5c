/* SPDX-License-Identifier: Apache-2.0 */
/* Models of every kind of shape, structure and field, in a box from 0 to about 20. */
#ifndef MSQ_TEST_HASHES_MODELS_H
#define MSQ_TEST_HASHES_MODELS_H

#include <msq.h>

enum { model_count = 42 };

/** One word. */
const char* model_name(int i);

/** Ends the program with the message of msq if a call fails. */
void must(msq_status status);

msq_model* make_model(msq_context* context, int i);

#endif
