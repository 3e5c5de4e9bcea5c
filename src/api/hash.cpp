// SPDX-License-Identifier: Apache-2.0
#include "api/guard.h"

using namespace msq;
using namespace msq::api;

namespace {

template <class Handle>
msq_status hash_of(const Handle* handle, const char* name, uint8_t* hash) {
  return guard([&] {
    const Described& described = object(handle, name);
    if (!hash) fail(Status::argument, "hash is NULL");
    const Hash& found = described.hash();
    std::copy(found.begin(), found.end(), hash);
  });
}

}  // namespace

msq_status msq_shape_hash(const msq_shape* shape, uint8_t hash[16]) {
  return hash_of(shape, "shape", hash);
}

msq_status msq_field_hash(const msq_field* field, uint8_t hash[16]) {
  return hash_of(field, "field", hash);
}

msq_status msq_structure_hash(const msq_structure* structure, uint8_t hash[16]) {
  return hash_of(structure, "structure", hash);
}

msq_status msq_material_hash(const msq_material* material, uint8_t hash[16]) {
  return hash_of(material, "material", hash);
}

msq_status msq_model_hash(const msq_model* model, uint8_t hash[16]) {
  return hash_of(model, "model", hash);
}
