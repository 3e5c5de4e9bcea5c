// SPDX-License-Identifier: Apache-2.0
// Which vector instructions Highway's runtime dispatch uses. A file with kernels includes
// hwy/foreach_target.h and hwy/highway.h itself, since both are read once for each target.
#pragma once

namespace msq {

/// Name of the instruction set that the kernels use on this machine; static storage.
const char* simd_target_name();

}  // namespace msq
