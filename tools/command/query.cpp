// SPDX-License-Identifier: Apache-2.0
// msq query: evaluates the model at points.
#include <sys/stat.h>

#include <algorithm>
#include <cstring>

#include "output_file.h"
#include "point_reader.h"
#include "scene.h"
#include "text.h"
#include "watch.h"

namespace command {

namespace {

constexpr size_t POINTS_AT_ONCE = 1 << 20;

// What is evaluated, in the order of the columns.
struct Wanted {
  enum What { MEMBERSHIP, DISTANCE, MATERIAL, REGION };
  std::vector<What> values;
  std::vector<std::string> channels;
  bool has(What what) const {
    for (const What one : values) {
      if (one == what) return true;
    }
    return false;
  }
};

constexpr std::string_view NAMES[] = {"membership", "distance", "material", "region"};
constexpr std::string_view TYPES[] = {"|u1", "<f8", "<u4", "<i4"};

Wanted read_wanted(const Arguments& arguments) {
  Wanted wanted;
  std::vector<std::string_view> columns = {"x", "y", "z"};
  const std::string list = arguments.has("what") ? arguments.text("what") : "membership";
  for (const std::string_view name : split(list, ',')) {
    size_t i = 0;
    while (i < std::size(NAMES) && NAMES[i] != name) ++i;
    if (i == std::size(NAMES)) {
      arguments.refuse(
          "what", "'" + std::string(name) + "' is none of membership, distance, material, region");
    }
    const auto what = static_cast<Wanted::What>(i);
    if (wanted.has(what)) arguments.refuse("what", "'" + std::string(name) + "' occurs twice");
    wanted.values.push_back(what);
    columns.push_back(name);
  }
  if (!arguments.has("channels")) return wanted;
  if (!wanted.has(Wanted::MATERIAL)) arguments.refuse("channels", "needs --what material");
  for (const std::string_view name : split(arguments.text("channels"), ',')) {
    if (name.empty() || name != one_line(name) || name.find_first_of("'\"\\") != name.npos) {
      arguments.refuse("channels", "'" + std::string(name) + "' is no name of a channel");
    }
    if (std::find(columns.begin(), columns.end(), name) != columns.end()) {
      arguments.refuse("channels", "'" + std::string(name) + "' is the name of another column");
    }
    if (!is_utf8(name)) arguments.refuse("channels", "'" + std::string(name) + "' is not UTF-8");
    const bool is_double =
        std::find(wanted.channels.begin(), wanted.channels.end(), name) != wanted.channels.end();
    if (is_double) arguments.refuse("channels", "has '" + std::string(name) + "' twice");
    wanted.channels.emplace_back(name);
  }
  return wanted;
}

// Values of some points.
struct Values {
  std::vector<uint8_t> membership;
  std::vector<double> distance, channels;
  std::vector<uint32_t> material;
  std::vector<int32_t> region;
};

void evaluate(const Scene& scene, const msq_query_def& query, const Wanted& wanted,
              const std::vector<double>& points, Values& values, Work& work) {
  auto set = defaults(msq_points_def_init);
  set.kind = MSQ_POINTS_ARRAY;
  set.coordinates = points.data();
  set.count = points.size() / 3;
  const msq_model* model = scene.model.get();
  const size_t count = set.count;
  if (wanted.has(Wanted::MEMBERSHIP)) {
    values.membership.resize(count);
    check(msq_set_membership(model, &set, &query, values.membership.data(), count, work.job()));
  }
  if (wanted.has(Wanted::DISTANCE)) {
    values.distance.resize(count);
    check(msq_set_distance(model, &set, &query, values.distance.data(), count, work.job()));
  }
  if (wanted.has(Wanted::MATERIAL)) {
    std::vector<const char*> names;
    for (const std::string& name : wanted.channels) names.push_back(name.c_str());
    values.material.resize(count);
    values.channels.resize(count * names.size());
    check(msq_set_material(model, &set, &query, names.empty() ? nullptr : names.data(),
                           names.size(), values.material.data(), count,
                           names.empty() ? nullptr : values.channels.data(), values.channels.size(),
                           work.job()));
  }
  if (wanted.has(Wanted::REGION)) {
    values.region.resize(count);
    check(msq_set_region(model, &set, values.region.data(), count, work.job()));
  }
}

class Writer {
 public:
  virtual ~Writer() = default;
  virtual void add(const std::vector<double>& points, const Values& values) = 0;
  virtual void finish() = 0;
};

class CsvWriter : public Writer {
 public:
  CsvWriter(const std::string& path, const Wanted& wanted) : file_(path), wanted_(wanted) {
    text_ = "x,y,z";
    for (const Wanted::What what : wanted.values) {
      text_ += "," + std::string(NAMES[what]);
      if (what != Wanted::MATERIAL) continue;
      for (const std::string& name : wanted.channels) text_ += "," + name;
    }
    text_ += '\n';
  }

  void add(const std::vector<double>& points, const Values& values) override {
    const size_t channels = wanted_.channels.size();
    for (size_t i = 0; i < points.size() / 3; ++i) {
      for (size_t a = 0; a < 3; ++a) {
        if (a > 0) text_ += ',';
        append(text_, points[3 * i + a]);
      }
      for (const Wanted::What what : wanted_.values) {
        text_ += ',';
        switch (what) {
          case Wanted::MEMBERSHIP:
            text_ += static_cast<char>('0' + values.membership[i]);
            break;
          case Wanted::DISTANCE:
            append(text_, values.distance[i]);
            break;
          case Wanted::REGION:
            text_ += std::to_string(values.region[i]);
            break;
          case Wanted::MATERIAL:
            text_ += std::to_string(values.material[i]);
            for (size_t c = 0; c < channels; ++c) {
              text_ += ',';
              append(text_, values.channels[i * channels + c]);
            }
        }
      }
      text_ += '\n';
      file_.write(text_);
      text_.clear();
    }
  }

  void finish() override {
    file_.write(text_);  // of no points: the heading
    file_.commit();
  }

 private:
  OutputFile file_;
  const Wanted& wanted_;
  std::string text_;
};

// One array; of records, without room between their fields, if there is more than one value.
class NpyWriter : public Writer {
 public:
  NpyWriter(const std::string& path, const Wanted& wanted) : file_(path), wanted_(wanted) {
    for (const Wanted::What what : wanted.values) {
      add_field(NAMES[what], TYPES[what]);
      if (what != Wanted::MATERIAL) continue;
      for (const std::string& name : wanted.channels) add_field(name, "<f8");
    }
    type_ = fields_ == 1 ? type_ : "[" + list_ + "]";
    file_.write(head(0));  // the number of points comes at the end
  }

  void add(const std::vector<double>& points, const Values& values) override {
    const size_t channels = wanted_.channels.size();
    bytes_.clear();
    for (size_t i = 0; i < points.size() / 3; ++i) {
      for (const Wanted::What what : wanted_.values) {
        switch (what) {
          case Wanted::MEMBERSHIP:
            put(values.membership[i]);
            break;
          case Wanted::DISTANCE:
            put(values.distance[i]);
            break;
          case Wanted::REGION:
            put(values.region[i]);
            break;
          case Wanted::MATERIAL:
            put(values.material[i]);
            for (size_t c = 0; c < channels; ++c) put(values.channels[i * channels + c]);
        }
      }
    }
    file_.write(bytes_);
    count_ += points.size() / 3;
  }

  void finish() override {
    const std::string text = head(count_);
    file_.write_at(0, text.data(), text.size());
    file_.commit();
  }

 private:
  void add_field(std::string_view name, std::string_view type) {
    type_ = "'" + std::string(type) + "'";
    list_ += (fields_++ ? ", ('" : "('") + std::string(name) + "', " + type_ + ")";
  }

  template <class T>
  void put(T value) {
    char raw[sizeof value];
    std::memcpy(raw, &value, sizeof value);
    bytes_.append(raw, sizeof value);
  }

  // As long for any number of points. Version 1.0 where that can count its bytes, or 2.0. Version
  // 3.0, in UTF-8, where names have other characters than ASCII.
  std::string head(uint64_t count) const {
    std::string number = std::to_string(count);
    const std::string room(20 - number.size(), ' ');
    std::string text =
        "{'descr': " + type_ + ", 'fortran_order': False, 'shape': (" + number + ",), }" + room;
    const bool is_ascii = std::all_of(text.begin(), text.end(),
                                      [](char c) { return static_cast<unsigned char>(c) < 0x80; });
    const char version = !is_ascii ? 3 : text.size() > 60000 ? 2 : 1;
    const size_t start = version == 1 ? 10 : 12;
    text.append(63 - (start + text.size()) % 64, ' ');
    text += '\n';
    std::string bytes("\x93NUMPY", 6);
    bytes += version;
    bytes += '\0';
    for (size_t i = 8; i < start; ++i) {
      bytes += static_cast<char>(text.size() >> (8 * (i - 8)) & 255);
    }
    return bytes + text;
  }

  OutputFile file_;
  const Wanted& wanted_;
  std::string type_, list_, bytes_;
  size_t fields_ = 0;
  uint64_t count_ = 0;
};

std::unique_ptr<Writer> make_writer(const Arguments& arguments, const Wanted& wanted) {
  const std::string path = arguments.has("output") ? arguments.text("output") : "-";
  if (path == "-" || ending(path) == ".csv") return std::make_unique<CsvWriter>(path, wanted);
  if (ending(path) != ".npy") {
    arguments.refuse("output", "'" + path + "' ends neither in .csv nor in .npy");
  }
  struct stat status = {};
  if (stat(path.c_str(), &status) == 0 && !S_ISREG(status.st_mode)) {
    throw Failure(path +
                  ": no plain file; an array begins with the number of points, which is "
                  "known at the end. CSV goes anywhere");
  }
  return std::make_unique<NpyWriter>(path, wanted);
}

}  // namespace

void run_query(const Arguments& arguments) {
  const Wanted wanted = read_wanted(arguments);
  const msq_query_def query = make_query(arguments);
  const std::unique_ptr<PointReader> reader = open_points(arguments.operand(1));
  const Scene scene = open_scene(arguments);
  const std::unique_ptr<Writer> writer = make_writer(arguments, wanted);
  std::vector<double> points;
  Values values;
  uint64_t count = 0;
  {
    Work work("evaluating", "points");
    for (;;) {
      reader->next(points, POINTS_AT_ONCE);
      if (points.empty()) break;
      work.set_share(reader->share());
      evaluate(scene, query, wanted, points, values, work);
      writer->add(points, values);
      count += points.size() / 3;
      work.done(count);
    }
  }
  writer->finish();
}

}  // namespace command
