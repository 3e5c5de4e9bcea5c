// SPDX-License-Identifier: Apache-2.0
// Scenarios for every function of the public interface (check_covered.py).
#pragma once

#include <vector>

#include "stage.h"

namespace msq::test {

std::vector<Scenario> small_scenarios();         ///< contexts, jobs, definitions, cameras
std::vector<Scenario> create_scenarios();        ///< shapes, fields, structures, materials, models
std::vector<Scenario> file_scenarios();          ///< meshes from files
std::vector<Scenario> point_scenarios();         ///< queries of single points
std::vector<Scenario> set_scenarios();           ///< queries of sets
std::vector<Scenario> slice_scenarios();         ///< layers
std::vector<Scenario> ray_scenarios();           ///< rays and pictures
std::vector<Scenario> statistic_scenarios();     ///< statistics and calibration
std::vector<Scenario> fill_scenarios();          ///< fill lines
std::vector<Scenario> contour_scenarios();       ///< contours
std::vector<Scenario> strut_scenarios();         ///< struts
std::vector<Scenario> printability_scenarios();  ///< printability
std::vector<Scenario> surface_scenarios();       ///< preview meshes
std::vector<Scenario> document_scenarios();      ///< documents

/// All of these.
std::vector<Scenario> all_scenarios();

/// Plays each scenario with allocations failing, in turn: the tests of a program.
int run_with_failing_memory(const char* group, std::vector<Scenario> scenarios);

}  // namespace msq::test
