/* SPDX-License-Identifier: Apache-2.0
 * The header needs no other, and may come twice. */
#include "msq_io.h"
