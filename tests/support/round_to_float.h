/* SPDX-License-Identifier: Apache-2.0
 * A double rounded to single precision. GCC 11 and 12 drop (double)(float)x where they put two of
 * them that lie side by side into one vector (docs/building.md); a volatile float stays. */
#ifndef ROUND_TO_FLOAT_H
#define ROUND_TO_FLOAT_H

static inline double round_to_float(double value) {
  volatile float single = (float)value;
  return (double)single;
}

#endif
