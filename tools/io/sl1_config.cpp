// SPDX-License-Identifier: Apache-2.0
#include "sl1_config.h"

#include <algorithm>
#include <charconv>
#include <cstdio>

#include "defs.h"
#include "names.h"
#include "panel.h"
#include "zip_file.h"

namespace msq_io {

namespace {

using Keys = std::map<std::string, std::string>;

/// The shortest decimal that is the same double.
std::string number(double value) {
  char text[32];
  return {text, std::to_chars(text, text + sizeof text, value).ptr};
}

std::string fixed(double value) {
  char text[400];
  return {text, std::to_chars(text, text + sizeof text, value, std::chars_format::fixed, 6).ptr};
}

std::string ini_of(const Keys& keys) {
  std::string text;
  for (const auto& [key, value] : keys) text += key + " = " + value + "\n";
  return text;
}

std::string read_line(const char* text, const char* fallback, const char* name) {
  const std::string line = text ? text : fallback;
  for (const char c : line)
    if (static_cast<unsigned char>(c) < 32 || c == 127)
      fail(MSQ_E_ARGUMENT, "%s has a control character; it must be one line", name);
  return line;
}

/// Keys of the panel and of the times.
Keys own_keys(const Sl1Settings& s) {
  const std::string w = number(s.panel.size[0]), h = number(s.panel.size[1]);
  return {{"area_fill", number(s.area_fill)},
          {"bed_shape", "0x0," + w + "x0," + w + "x" + h + ",0x" + h},
          {"display_height", h},
          {"display_mirror_x", std::to_string(s.panel.mirror[0])},
          {"display_mirror_y", std::to_string(s.panel.mirror[1])},
          {"display_orientation", s.panel.portrait ? "portrait" : "landscape"},
          {"display_pixels_x", std::to_string(s.panel.pixels[0])},
          {"display_pixels_y", std::to_string(s.panel.pixels[1])},
          {"display_width", w},
          {"exposure_time", number(s.exposure_time)},
          {"faded_layers", std::to_string(s.faded_layers)},
          {"fast_tilt_time", number(s.fast_tilt_time)},
          {"initial_exposure_time", number(s.initial_exposure_time)},
          {"initial_layer_height", number(s.layer_height)},
          {"layer_height", number(s.layer_height)},
          {"printer_model", s.printer_model},
          {"printer_technology", "SLA"},
          {"printer_variant", s.printer_variant},
          {"sla_material_settings_id", s.material},
          {"slow_tilt_time", number(s.slow_tilt_time)}};
}

/// Lines "key = value".
Keys read_settings(const char* text, const Keys& taken) {
  Keys keys;
  for (std::string rest = text ? text : ""; !rest.empty();) {
    const size_t end = rest.find('\n');
    const std::string line = rest.substr(0, end);
    const size_t sign = line.find(" = ");
    if (end == std::string::npos || sign == std::string::npos || sign == 0)
      fail(MSQ_E_ARGUMENT, "settings: \"%s\" is not \"key = value\" with a line feed",
           line.substr(0, 100).c_str());
    const std::string key = line.substr(0, sign);
    const std::string value = read_line(line.c_str() + sign + 3, "", "settings");
    read_line(key.c_str(), "", "settings");
    if (taken.count(key) || !keys.emplace(key, value).second)
      fail(MSQ_E_ARGUMENT, "settings: the key %s is written already", key.c_str());
    rest.erase(0, end + 1);
  }
  return keys;
}

}  // namespace

Sl1Settings read_sl1(const msq_io_sl1_def& def) {
  Sl1Settings s{};
  s.panel = read_panel(def.panel);
  s.job = read_prefix(def.job, "part", "job");
  s.printer_model = read_line(def.printer_model, "SL1", "printer_model");
  s.printer_variant = read_line(def.printer_variant, "default", "printer_variant");
  s.material = read_line(def.material, "", "material");
  s.faded_layers = require_range<uint32_t>(def.faded_layers, 0, 1000000, "faded_layers");
  s.exposure_time = require_not_negative(def.exposure_time, "exposure_time");
  s.initial_exposure_time =
      require_not_negative(def.initial_exposure_time, "initial_exposure_time");
  s.fast_tilt_time = require_not_negative(def.fast_tilt_time, "fast_tilt_time");
  s.slow_tilt_time = require_not_negative(def.slow_tilt_time, "slow_tilt_time");
  s.area_fill = require_not_negative(def.area_fill, "area_fill");
  s.layer_height = require_not_negative(def.layer_height, "layer_height");
  constexpr int64_t from_1980 = 315532800, to_2107 = 4354819199;
  s.created = def.created ? require_range(def.created, from_1980, to_2107, "created") : from_1980;
  s.more = read_settings(def.settings, own_keys(s));
  return s;
}

Sl1Statistics::Sl1Statistics(const Sl1Settings& settings)
    : settings_(settings),
      fade_time_(settings.initial_exposure_time),
      fade_step_((settings.initial_exposure_time - settings.exposure_time) /
                 (settings.faded_layers + 1)) {}

void Sl1Statistics::add_layer(uint64_t values) {
  const double pixels = static_cast<double>(settings_.panel.pixels[0]) * settings_.panel.pixels[1];
  const bool is_fast = static_cast<double>(values) / 255 <= pixels * settings_.area_fill / 100;
  const uint64_t number = fast_layers + slow_layers;
  if (number < 3) {
    print_time += settings_.initial_exposure_time;
  } else if (fade_time_ > settings_.exposure_time) {
    fade_time_ = std::max(fade_time_ - fade_step_, settings_.exposure_time);
    print_time += fade_time_;
  } else {
    print_time += settings_.exposure_time;
  }
  print_time += is_fast ? settings_.fast_tilt_time : settings_.slow_tilt_time;
  ++(is_fast ? fast_layers : slow_layers);
  values_ += values;
}

double Sl1Statistics::material() const {
  const msq_io_panel_def& panel = settings_.panel;
  const double pixel = panel.size[0] / panel.pixels[0] * (panel.size[1] / panel.pixels[1]);
  return static_cast<double>(values_) / 255 * pixel * settings_.layer_height / 1000;
}

std::string config_ini(const Sl1Settings& s, const Sl1Statistics& statistics) {
  const std::tm time = utc_of(s.created);
  char stamp[96];
  std::snprintf(stamp, sizeof stamp, "%04d-%02d-%02d at %02d:%02d:%02d UTC", time.tm_year + 1900,
                time.tm_mon + 1, time.tm_mday, time.tm_hour, time.tm_min, time.tm_sec);
  const Keys keys = {{"action", "print"},
                     {"expTime", number(s.exposure_time)},
                     {"expTimeFirst", number(s.initial_exposure_time)},
                     {"expUserProfile", "0"},
                     {"fileCreationTimestamp", stamp},
                     {"hollow", "0"},
                     {"jobDir", s.job},
                     {"layerHeight", number(s.layer_height)},
                     {"materialName", s.material},
                     {"numFade", std::to_string(s.faded_layers)},
                     {"numFast", std::to_string(statistics.fast_layers)},
                     {"numSlow", std::to_string(statistics.slow_layers)},
                     {"printProfile", ""},
                     {"printTime", fixed(statistics.print_time)},
                     {"printerModel", s.printer_model},
                     {"printerProfile", ""},
                     {"printerVariant", s.printer_variant},
                     {"prusaSlicerVersion", "msq"},
                     {"usedMaterial", fixed(statistics.material())}};
  return ini_of(keys);
}

std::string prusaslicer_ini(const Sl1Settings& settings) {
  Keys keys = own_keys(settings);
  keys.insert(settings.more.begin(), settings.more.end());
  return ini_of(keys);
}

}  // namespace msq_io
