// SPDX-License-Identifier: Apache-2.0
// config.ini and prusaslicer.ini of SL1 archives, with the keys of PrusaSlicer 2.5
// (libslic3r/Format/SL1.cpp).
#pragma once

#include <cstdint>
#include <map>
#include <string>

#include "msq_io.h"

namespace msq_io {

/// A definition with strings of its own.
struct Sl1Settings {
  msq_io_panel_def panel;
  std::string job, printer_model, printer_variant, material;
  uint32_t faded_layers;
  double exposure_time, initial_exposure_time, fast_tilt_time, slow_tilt_time, area_fill;
  double layer_height;
  int64_t created;
  /// Key and value of the host's own settings.
  std::map<std::string, std::string> more;
};

/// Checks the definition of the host; layer_height is 0 if it gives none.
Sl1Settings read_sl1(const msq_io_sl1_def& def);

/// What is known after all layers: as PrusaSlicer estimates it (SLAPrintSteps.cpp).
class Sl1Statistics {
 public:
  explicit Sl1Statistics(const Sl1Settings& settings);
  /// values: the sum of all pixels of the next layer.
  void add_layer(uint64_t values);

  uint64_t fast_layers = 0, slow_layers = 0;
  double print_time = 0;
  /// Millilitres.
  double material() const;

 private:
  const Sl1Settings& settings_;
  double fade_time_, fade_step_;
  uint64_t values_ = 0;
};

std::string config_ini(const Sl1Settings& settings, const Sl1Statistics& statistics);
std::string prusaslicer_ini(const Sl1Settings& settings);

}  // namespace msq_io
