// SPDX-License-Identifier: Apache-2.0
#include "contour_packet.h"

namespace msq_io {

namespace {

msq_contours_report report_of(const msq_contours* contours) {
  msq_contours_report report{};
  report.struct_size = sizeof report;
  check_msq(msq_contours_info(contours, &report));
  return report;
}

}  // namespace

void take_contours(const msq_output& output, Packet& packet) {
  if (output.output != MSQ_LAYER_CONTOURS)
    fail(MSQ_E_ARGUMENT, "the output of the layers is %d; it must be MSQ_LAYER_CONTOURS (%d)",
         output.output, MSQ_LAYER_CONTOURS);
  const msq_contours_report report = report_of(output.contours);
  msq_contours_retain(output.contours);
  packet.contours = {output.contours, msq_contours_release};
  packet.bytes = report.point_count * 16 + report.ring_count * 17 + 1;
}

Rings::Rings(const msq_contours* contours, double units)
    : report_(report_of(contours)), units_(units) {}

double Rings::at(uint64_t point, int axis) const {
  const uint64_t i = 2 * point + static_cast<uint64_t>(axis);
  switch (report_.type) {
    case MSQ_INT32:
      return static_cast<const int32_t*>(report_.points)[i] / units_;
    case MSQ_INT64:
      return static_cast<double>(static_cast<const int64_t*>(report_.points)[i]) / units_;
    default:
      return static_cast<const double*>(report_.points)[i] / units_;
  }
}

}  // namespace msq_io
