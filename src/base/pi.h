// SPDX-License-Identifier: Apache-2.0
#pragma once

namespace msq {

constexpr double pi = 3.14159265358979323846;
constexpr double two_pi = 2 * pi;

}  // namespace msq
