// SPDX-License-Identifier: Apache-2.0
// msq model: writes what the options describe as a model file.
#include <filesystem>

#include "output_file.h"
#include "scene.h"
#include "text.h"

namespace command {

namespace {

namespace fs = std::filesystem;

// The path by which a mesh file is opened, and the folder from which the model file names it: "" if
// the file is neither in the folder of the model file nor below it.
struct Names {
  std::string mesh, folder;
};

bool is_below(const fs::path& file, const fs::path& folder) {
  const fs::path relative = file.lexically_relative(folder);
  return !relative.empty() && *relative.begin() != "..";
}

// Readers of the model file follow links, so the names stay as they are spelled if these lead to
// the file. Otherwise links of folders are resolved, at last that of the file.
Names find_names(const std::string& mesh, const std::string& output) {
  std::error_code error;
  const auto same = [&error](const fs::path& a, const fs::path& b) {
    return fs::equivalent(a, b, error) && !error;
  };
  const fs::path parent = fs::absolute(output == "-" ? "stdout" : output).parent_path();
  const fs::path spelled = fs::absolute(mesh), real = fs::canonical(mesh, error);
  if (error) return {mesh, ""};  // reading it fails
  const fs::path plain = spelled.lexically_normal(), folder = parent.lexically_normal();
  const bool is_plain = same(plain, spelled) && same(folder, parent);
  if (is_plain && is_below(plain, folder)) return {plain.string(), folder.string()};
  const fs::path real_folder = fs::canonical(parent, error);
  if (error) return {mesh, ""};
  const fs::path resolved = fs::canonical(spelled.parent_path(), error) / spelled.filename();
  for (const fs::path& file : {resolved, real}) {
    if (!error && same(file, real) && is_below(file, real_folder))
      return {file.string(), real_folder.string()};
  }
  return {real.string(), ""};
}

// Refuses what msq reads only with --any-files.
void check_names(const Arguments& arguments, const Names& names) {
  if (arguments.has("any-files")) return;
  constexpr char REMEDY[] = "; --any-files allows it, and must then be given to read the file, too";
  if (names.folder.empty()) {
    throw UsageError("'" + names.mesh +
                     "' is neither in the folder of the model file nor below it" + REMEDY);
  }
  const std::string name = fs::path(names.mesh).lexically_relative(names.folder).string();
  if (name.find_first_of(":\\") != name.npos) {
    throw UsageError("'" + name + "' has a colon or a backslash, which a model file must not name" +
                     REMEDY);
  }
}

}  // namespace

void run_model(const Arguments& arguments) {
  const std::string path = arguments.has("output") ? arguments.text("output") : "-";
  if (path != "-" && ending(path) != ".json") {
    arguments.refuse("output", "'" + path + "' does not end in .json");
  }
  const std::string& part = arguments.operand(0);
  if (is_model_file(part)) throw UsageError("'" + part + "' is a model file already");
  OutputFile out(path);
  Names names = {part, ""};
  if (!is_box(part)) {
    names = find_names(part, path);
    std::error_code error;
    if (fs::exists(names.mesh, error)) check_names(arguments, names);
  }
  const Scene scene = open_scene(arguments, &names.mesh);
  const std::string title = arguments.text("title");
  auto def = defaults(msq_json_def_init);
  if (!names.folder.empty()) def.base_directory = names.folder.c_str();
  if (!title.empty()) def.title = title.c_str();
  uint64_t bytes = 0;
  check(msq_model_to_json(scene.model.get(), &def, nullptr, 0, &bytes));
  std::string text(bytes, '\0');
  check(msq_model_to_json(scene.model.get(), &def, text.data(), bytes, &bytes));
  out.write(text);
  if (!text.ends_with('\n')) out.write("\n");
  out.commit();
}

}  // namespace command
