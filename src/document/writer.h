// SPDX-License-Identifier: Apache-2.0
// Writes objects as a document, from the definitions that they keep.
#pragma once

#include <string>
#include <string_view>
#include <unordered_map>

#include "api/definitions.h"
#include "api/guard.h"
#include "document/output.h"

namespace msq::document {

struct WriterOptions {
  std::string base;  ///< paths of files below it become relative; "": none
  uint64_t max_numbers;
};

class ModelWriter {
 public:
  explicit ModelWriter(const WriterOptions& options) : options_(options) {}

  /// The writer is within a member, or an item of a list, as long as this lives.
  class Within {
   public:
    Within(ModelWriter& writer, std::string_view key);
    Within(ModelWriter& writer, uint64_t item);
    ~Within() { writer_.place_.resize(size_); }
    Within(const Within&) = delete;
    Within& operator=(const Within&) = delete;

   private:
    ModelWriter& writer_;
    const size_t size_;
  };
  /// A member of where the writer is, as readers name it: scales[1].structure.foam.radius.
  std::string place_of(std::string_view key) const;

  /// Adds the definitions that are used more than once, then scales or regions.
  void write(const Model& model, Output& document);
  /// Adds the members of a definition that are not the default.
  template <class Def>
  Output members_of(const Def& def);

  /// An object within a definition: its name or itself.
  Output object(const Shape& shape);
  Output object(const Field& field);
  Output object(const Structure& structure);
  Output object(const Material& material);
  Output object(const Model& model);
  std::string path(const char* file) const;
  /// In quotes.
  std::string text(std::string_view key, std::string_view text) const;
  void check_count(const char* key, uint64_t numbers) const;

 private:
  struct Use {
    uint64_t count = 0;
    std::string name;  ///< "": not written yet
  };
  struct Section {
    const char *name, *one;
    Output named;
  };
  class Counter;
  template <class Object, class Define>
  Output named(const Object& object, Section& section, Define&& define);
  [[noreturn]] void refuse(const std::string& what) const;

  const WriterOptions& options_;
  std::string place_;  ///< where the writer is; "": in the document
  std::unordered_map<const Described*, Use> uses_;
  Section shapes_{"shapes", "shape", {}}, fields_{"fields", "field", {}},
      structures_{"structures", "structure", {}}, materials_{"materials", "material", {}};
};

}  // namespace msq::document
