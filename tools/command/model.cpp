// SPDX-License-Identifier: Apache-2.0
// msq model: writes what the options describe as a model file.
#include <filesystem>

#include "output_file.h"
#include "scene.h"
#include "text.h"

namespace command {

void run_model(const Arguments& arguments) {
  const std::string path = arguments.has("output") ? arguments.text("output") : "-";
  if (path != "-" && ending(path) != ".json") {
    arguments.refuse("output", "'" + path + "' does not end in .json");
  }
  if (is_model_file(arguments.operand(0))) {
    throw UsageError("'" + arguments.operand(0) + "' is a model file already");
  }
  const Scene scene = open_scene(arguments, true);
  // Files below the folder of the model file are named from there, others by their whole path.
  std::error_code error;
  const std::filesystem::path whole = std::filesystem::absolute(path == "-" ? "stdout" : path);
  const std::filesystem::path folder =
      std::filesystem::weakly_canonical(whole, error).parent_path();
  const std::string base = folder.string(), title = arguments.text("title");
  auto def = defaults(msq_json_def_init);
  def.base_directory = base.c_str();
  if (!title.empty()) def.title = title.c_str();
  uint64_t bytes = 0;
  check(msq_model_to_json(scene.model.get(), &def, nullptr, 0, &bytes));
  std::string text(bytes, '\0');
  check(msq_model_to_json(scene.model.get(), &def, text.data(), bytes, &bytes));
  OutputFile out(path);
  out.write(text);
  if (!text.ends_with('\n')) out.write("\n");
  out.commit();
}

}  // namespace command
