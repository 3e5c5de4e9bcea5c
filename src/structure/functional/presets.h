// SPDX-License-Identifier: Apache-2.0
// Named functions, as expressions in x, y, z: level sets that come close to triply periodic minimal
// surfaces, and columns.
// Surfaces: Schoen, "Infinite periodic minimal surfaces without self-intersections", NASA TN
// D-5541, 1970; Fischer and Koch, "On 3-periodic minimal surfaces", Z. Kristallogr. 179, 1987 (S,
// C(Y), C(+-Y)); Karcher, "The triply periodic minimal surfaces of Alan Schoen and their constant
// mean curvature companions", Manuscripta Math. 64, 1989 (K).
// Functions: von Schnering and Nesper, "Nodal surfaces of Fourier series", Z. Phys. B 83, 1991 (the
// first ones, S, C(Y), C(+-Y)); Wohlgemuth, Yufa, Hoffman and Thomas, "Triply periodic bicontinuous
// cubic microdomain morphologies by symmetries", Macromolecules 34, 2001 (G'); Fisher, Miller,
// Bartolai, Simpson and Yukish, "Catalog of triply periodic minimal surfaces, equation-based
// lattice structures, and their homogenized property data", Data in Brief 49, 2023 (K). Lidinoid,
// split P and the double functions are as programs for lattices have them; their first source is
// not known to us. The double functions have the other sign here, so that their networks are the
// two labyrinths.
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
    // Fischer-Koch S.
    "cos(2*x)*sin(y)*cos(z)+cos(2*y)*sin(z)*cos(x)+cos(2*z)*sin(x)*cos(y)",
    // C(Y).
    "sin(2*x)*sin(y)+sin(2*y)*sin(z)+sin(2*z)*sin(x)+sin(2*x)*cos(z)+sin(2*y)*cos(x)"
    "+sin(2*z)*cos(y)-sin(x)*sin(y)*sin(z)-cos(x)*cos(y)*cos(z)",
    // C(+-Y).
    "sin(2*x)*sin(y)+sin(2*y)*sin(z)+sin(2*z)*sin(x)-2*cos(x)*cos(y)*cos(z)",
    // Karcher K.
    "0.3*(cos(x)+cos(y)+cos(z))+0.3*(cos(x)*cos(y)+cos(y)*cos(z)+cos(z)*cos(x))"
    "-0.4*(cos(2*x)+cos(2*y)+cos(2*z))+0.2",
    // G'.
    "sin(2*x)*cos(y)*sin(z)+sin(2*y)*cos(z)*sin(x)+sin(2*z)*cos(x)*sin(y)+0.32",
    // Double gyroid.
    "cos(2*x)*cos(2*y)+cos(2*y)*cos(2*z)+cos(2*z)*cos(2*x)"
    "-2.75*(sin(2*x)*cos(y)*sin(z)+sin(2*y)*cos(z)*sin(x)+sin(2*z)*cos(x)*sin(y))+0.95",
    // Double diamond.
    "-0.5*(sin(x)*sin(y)+sin(y)*sin(z)+sin(z)*sin(x))-0.5*cos(x)*cos(y)*cos(z)",
    // Double P.
    "-0.5*(cos(x)*cos(y)+cos(y)*cos(z)+cos(z)*cos(x))-0.2*(cos(2*x)+cos(2*y)+cos(2*z))",
    // Honeycomb: three plane waves at 120 degrees if the cell is sqrt(3) times as long along y.
    "cos(2*y)+2*cos(x)*cos(y)+0.5",
    // Rods on a square grid.
    "1-cos(x)-cos(y)",
};
constexpr int preset_count = sizeof preset_expressions / sizeof *preset_expressions;

}  // namespace msq
