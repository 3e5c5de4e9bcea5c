// SPDX-License-Identifier: Apache-2.0
// Runs the vectors through msq.hpp: see tests/vectors/protocol.py. usage: vectors MODEL POINTS ...
#include <cstdio>
#include <cstring>
#include <fstream>
#include <iterator>
#include <msq.hpp>
#include <string>
#include <vector>

namespace {

std::string read_file(const char* path) {
  std::ifstream file(path, std::ios::binary);
  if (!file) throw std::runtime_error(std::string("cannot read ") + path);
  return std::string(std::istreambuf_iterator<char>(file), {});
}

void print_bits(double value) {
  uint64_t bits;
  std::memcpy(&bits, &value, sizeof bits);
  std::printf(" %016llx", static_cast<unsigned long long>(bits));
}

void print_bytes(msq::Span<const uint8_t> bytes) {
  std::putchar(' ');
  for (const unsigned byte : bytes) std::printf("%02x", byte);
}

void print_hash(const msq::Model& model) {
  std::printf("hash");
  try {
    print_bytes(model.hash());
  } catch (const msq::Error& error) {
    if (error.status() != MSQ_E_UNSUPPORTED) throw;
    std::printf(" -");
  }
  std::putchar('\n');
}

void print_points(const msq::Model& model, const std::string& bytes) {
  std::vector<double> triples(bytes.size() / sizeof(double));
  std::memcpy(triples.data(), bytes.data(), triples.size() * sizeof(double));
  const msq::PointsDef points = msq::points(triples);
  std::vector<uint8_t> inside(triples.size() / 3);
  model.membership(points, inside);
  std::printf("inside ");
  for (const uint8_t one : inside) std::putchar(one ? '1' : '0');
  std::vector<double> distances(triples.size() / 3);
  model.distance(points, distances);
  std::printf("\ndistance");
  for (const double distance : distances) print_bits(distance);
  std::putchar('\n');
}

void print_layers(const msq::Slicer& slicer) {
  const msq_slicer_report plan = slicer.info();
  std::printf("plan %u %u %llu\n", plan.width, plan.height,
              static_cast<unsigned long long>(plan.layer_count));
  slicer.run([](const msq_layer& layer) {
    std::printf("layer %llu", static_cast<unsigned long long>(layer.index));
    print_bits(layer.z);
    print_bytes({layer.data, static_cast<size_t>(layer.stride * layer.height)});
    std::putchar('\n');
  });
}

}  // namespace

int main(int count, char** arguments) {
  const msq::Context context;
  for (int i = 1; i + 1 < count; i += 2) {
    std::puts("case");
    msq::Document document;
    try {
      document = msq::Document::from_json(context, read_file(arguments[i]));
    } catch (const msq::Error& error) {
      std::printf("refused %s\n", error.what());
      continue;
    }
    std::printf("title %s\n", document.info().title);
    const msq::Model model = document.model();
    print_hash(model);
    print_points(model, read_file(arguments[i + 1]));
    print_layers(msq::Slicer(model, document.slicing()));
  }
}
