// SPDX-License-Identifier: Apache-2.0
// Functions of libslic3r whose files this build leaves out. Calls of them throw: supports, wipe
// towers, Arachne's perimeters, thumbnails and files other than STL are not to be had.
#include "libslic3r/Arachne/WallToolPaths.hpp"
#include "libslic3r/BuildVolume.hpp"
#include "libslic3r/Format/3mf.hpp"
#include "libslic3r/Format/AMF.hpp"
#include "libslic3r/Format/OBJ.hpp"
#include "libslic3r/Format/STEP.hpp"
#include "libslic3r/GCode/Thumbnails.hpp"
#include "libslic3r/GCode/WipeTower.hpp"
#include "libslic3r/SupportMaterial.hpp"

namespace Slic3r {

// Stands for a value of any type.
struct LeftOut {
  template <class T>
  operator T() const {
    throw RuntimeError("this build of libslic3r leaves out what was called");
  }
};
static constexpr LeftOut left_out;

namespace Arachne {
WallToolPaths::WallToolPaths(const Polygons& polygons, coord_t, coord_t, size_t, coord_t, coordf_t,
                             const PrintObjectConfig& config, const PrintConfig&)
    : outline(polygons), print_object_config(config) {
  throw RuntimeError("this build of libslic3r leaves out Arachne");
}
const std::vector<VariableWidthLines>& WallToolPaths::getToolPaths() {
  return left_out.operator const std::vector<VariableWidthLines>&();
}
const Polygons& WallToolPaths::getInnerContour() {
  return left_out.operator const Polygons&();
}
std::unordered_set<std::pair<const ExtrusionLine*, const ExtrusionLine*>,
                   boost::hash<std::pair<const ExtrusionLine*, const ExtrusionLine*>>>
WallToolPaths::getRegionOrder(const std::vector<ExtrusionLine*>&, bool) {
  return left_out;
}
}  // namespace Arachne

BuildVolume::ObjectState BuildVolume::object_state(const indexed_triangle_set&, const Transform3f&,
                                                   bool, bool) const {
  return left_out;
}
namespace GCodeThumbnails {
std::unique_ptr<CompressedImageBuffer> compress_thumbnail(const ThumbnailData&,
                                                          GCodeThumbnailsFormat) {
  return left_out;
}
}  // namespace GCodeThumbnails
PrintObjectSupportMaterial::PrintObjectSupportMaterial(const PrintObject*,
                                                       const SlicingParameters&) {
  throw RuntimeError("this build of libslic3r leaves out supports");
}
void PrintObjectSupportMaterial::generate(PrintObject&) {}
WipeTower::WipeTower(const PrintConfig&, const std::vector<std::vector<float>>&, size_t) {
  throw RuntimeError("this build of libslic3r leaves out wipe towers");
}
void WipeTower::set_extruder(size_t, const PrintConfig&) {}
void WipeTower::plan_toolchange(float, float, unsigned int, unsigned int, float) {}
void WipeTower::generate(std::vector<std::vector<ToolChangeResult>>&) {}
std::vector<WipeTower::ToolChangeResult> WipeTower::prime(float, const std::vector<unsigned int>&,
                                                          bool) {
  return left_out;
}
WipeTower::ToolChangeResult WipeTower::tool_change(size_t) {
  return left_out;
}
bool load_3mf(const char*, DynamicPrintConfig&, ConfigSubstitutionContext&, Model*, bool) {
  return left_out;
}
bool load_amf(const char*, DynamicPrintConfig*, ConfigSubstitutionContext*, Model*, bool) {
  return left_out;
}
bool load_obj(const char*, Model*, const char*) {
  return left_out;
}
bool load_step(const char*, Model*) {
  return left_out;
}

}  // namespace Slic3r
