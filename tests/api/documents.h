/* SPDX-License-Identifier: Apache-2.0
 * Documents of tests, and what they must do. */
#ifndef DOCUMENTS_H
#define DOCUMENTS_H

#include "fixtures.h"

static inline msq_document* read_document_in(msq_context* context, const char* text,
                                             const char* base_directory) {
  msq_document_def def;
  msq_document* document;
  assert_ok(msq_document_def_init(&def, sizeof def));
  def.base_directory = base_directory;
  const msq_status status =
      msq_document_from_json(context, text, strlen(text), &def, &document, NULL);
  if (status != MSQ_OK) fail_msg("%s\n%s", msq_error_message(), text);
  return document;
}

static inline msq_document* read_document(msq_context* context, const char* text) {
  return read_document_in(context, text, NULL);
}

/* The model of a document, which is released. */
static inline msq_model* model_of(msq_document* document) {
  msq_model* model;
  assert_ok(msq_document_model(document, &model));
  msq_document_release(document);
  return model;
}

/* The text of a model, to be freed. */
static inline char* json_of(const msq_model* model, const msq_json_def* def) {
  uint64_t bytes = 0, again = 0;
  if (msq_model_to_json(model, def, NULL, 0, &bytes) != MSQ_OK) fail_msg("%s", msq_error_message());
  char* text = (char*)malloc((size_t)bytes + 1);
  assert_non_null(text);
  assert_ok(msq_model_to_json(model, def, text, bytes + 1, &again));
  assert_int_equal(again, bytes);
  assert_int_equal(strlen(text), bytes);
  return text;
}

/* Equal hashes; without xxHash nothing is checked. */
static inline void assert_same_model(const msq_model* a, const msq_model* b, const char* text) {
  uint8_t of_a[16], of_b[16];
  if (!MSQ_WITH_XXHASH) return;
  assert_ok(msq_model_hash(a, of_a));
  assert_ok(msq_model_hash(b, of_b));
  if (memcmp(of_a, of_b, sizeof of_a) != 0) fail_msg("another model:\n%s", text);
}

/* A model that is written and read again is the same, and so is its text. */
static inline void assert_round_trip(msq_context* context, const msq_model* model,
                                     const char* base_directory) {
  msq_json_def def;
  assert_ok(msq_json_def_init(&def, sizeof def));
  def.base_directory = base_directory;
  char* text = json_of(model, &def);
  msq_model* again = model_of(read_document_in(context, text, base_directory));
  assert_same_model(model, again, text);
  char* second = json_of(again, &def);
  assert_string_equal(text, second);
  msq_model_release(again);
  free(second);
  free(text);
}

#endif
