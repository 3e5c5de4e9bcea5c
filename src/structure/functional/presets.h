// SPDX-License-Identifier: Apache-2.0
// Named functions, as expressions in x, y, z: level sets that come close to triply periodic minimal
// surfaces.
// Source: Schoen, "Infinite periodic minimal surfaces without self-intersections", NASA TN D-5541,
// 1970 (surfaces); von Schnering and Nesper, "Nodal surfaces of Fourier series", 1991 (functions).
#pragma once

namespace msq {

/// Expressions by the number of the preset, from 1.
constexpr const char* preset_expressions[] = {
    // Gyroid.
    "sin(x)*cos(y)+sin(y)*cos(z)+sin(z)*cos(x)",
    // Schwarz P.
    "cos(x)+cos(y)+cos(z)",
    // Schwarz D (diamond).
    "sin(x)*sin(y)*sin(z)+sin(x)*cos(y)*cos(z)+cos(x)*sin(y)*cos(z)+cos(x)*cos(y)*sin(z)",
    // I-WP.
    "2*(cos(x)*cos(y)+cos(y)*cos(z)+cos(z)*cos(x))-(cos(2*x)+cos(2*y)+cos(2*z))",
    // Neovius.
    "3*(cos(x)+cos(y)+cos(z))+4*cos(x)*cos(y)*cos(z)",
    // F-RD.
    "4*cos(x)*cos(y)*cos(z)-(cos(2*x)*cos(2*y)+cos(2*y)*cos(2*z)+cos(2*z)*cos(2*x))",
    // Lidinoid.
    "0.5*(sin(2*x)*cos(y)*sin(z)+sin(2*y)*cos(z)*sin(x)+sin(2*z)*cos(x)*sin(y))"
    "-0.5*(cos(2*x)*cos(2*y)+cos(2*y)*cos(2*z)+cos(2*z)*cos(2*x))+0.15",
    // Split P.
    "1.1*(sin(2*x)*sin(z)*cos(y)+sin(2*y)*sin(x)*cos(z)+sin(2*z)*sin(y)*cos(x))"
    "-0.2*(cos(2*x)*cos(2*y)+cos(2*y)*cos(2*z)+cos(2*z)*cos(2*x))"
    "-0.4*(cos(2*x)+cos(2*y)+cos(2*z))",
};

}  // namespace msq
