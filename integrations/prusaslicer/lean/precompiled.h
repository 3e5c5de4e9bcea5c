// SPDX-License-Identifier: Apache-2.0
// What most files of libslic3r include, compiled once.
#pragma once

#include "libslic3r/pchheader.hpp"

#include <boost/log/trivial.hpp>
#include "libslic3r/ClipperUtils.hpp"
#include "libslic3r/EdgeGrid.hpp"
#include "libslic3r/GCode.hpp"
#include "libslic3r/Geometry.hpp"
#include "libslic3r/I18N.hpp"
#include "libslic3r/Layer.hpp"
#include "libslic3r/Model.hpp"
#include "libslic3r/Print.hpp"
#include "libslic3r/PrintConfig.hpp"
#include "libslic3r/ShortestPath.hpp"
#include "libslic3r/Utils.hpp"
