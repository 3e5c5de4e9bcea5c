// SPDX-License-Identifier: Apache-2.0
// Runs files through fuzzers without libFuzzer, in any build: replay FUZZER FILE-OR-FOLDER...
// replays inputs, for example one that a fuzzer found. replay CORPUS replays all folders of a
// corpus, each through the fuzzer of its name.
#include <algorithm>
#include <cstdio>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <iterator>

#include "fuzz.h"

namespace {

namespace fs = std::filesystem;

struct Fuzzer {
  const char* name;
  msq::fuzz::Run run;
};
constexpr Fuzzer fuzzers[] = {
    {"beam_file", msq::fuzz::run_beam_file}, {"calls", msq::fuzz::run_calls},
    {"contours", msq::fuzz::run_contours},   {"definitions", msq::fuzz::run_definitions},
    {"document", msq::fuzz::run_document},   {"expression", msq::fuzz::run_expression},
    {"foam", msq::fuzz::run_foam},           {"image_file", msq::fuzz::run_image_file},
    {"mesh", msq::fuzz::run_mesh},
};

int failed(const std::string& what) {
  std::fprintf(stderr, "replay: %s\n", what.c_str());
  return 1;
}

/// The number of inputs; -1 where there is none.
int replay(const Fuzzer& fuzzer, const fs::path& path) {
  std::vector<fs::path> files;
  if (fs::is_directory(path)) {
    for (const auto& entry : fs::recursive_directory_iterator(path))
      if (entry.is_regular_file()) files.push_back(entry.path());
  } else if (fs::is_regular_file(path)) {
    files.push_back(path);
  }
  std::sort(files.begin(), files.end());
  for (const fs::path& file : files) {
    std::ifstream stream(file, std::ios::binary);
    const std::string bytes((std::istreambuf_iterator<char>(stream)),
                            std::istreambuf_iterator<char>());
    if (!stream) return failed("cannot read " + file.string()) - 2;
    // If it is found wrong, the last line tells which it is.
    std::fprintf(stderr, "%s\n", file.c_str());
    fuzzer.run(reinterpret_cast<const uint8_t*>(bytes.data()), bytes.size());
  }
  return files.empty() ? failed("no inputs in " + path.string()) - 2
                       : static_cast<int>(files.size());
}

}  // namespace

int main(int argc, char** argv) {
  if (argc == 2) {
    for (const Fuzzer& fuzzer : fuzzers) {
      const int count = replay(fuzzer, fs::path(argv[1]) / fuzzer.name);
      if (count < 0) return 1;
      std::printf("%-12s %4d inputs\n", fuzzer.name, count);
    }
    return 0;
  }
  if (argc < 3) return failed("usage: replay FUZZER FILE-OR-FOLDER..., or: replay CORPUS") + 1;
  for (const Fuzzer& fuzzer : fuzzers) {
    if (std::strcmp(fuzzer.name, argv[1]) != 0) continue;
    for (int i = 2; i < argc; ++i)
      if (replay(fuzzer, argv[i]) < 0) return 1;
    return 0;
  }
  return failed(std::string("no fuzzer is named ") + argv[1]) + 1;
}
