// SPDX-License-Identifier: Apache-2.0
// Definitions of an older host: what struct_size is for, shown on a struct that has grown.
#include "api/guard.h"
#include "msq_test.h"

namespace {

struct OldDef {
  uint32_t struct_size, first;
};
struct GrownDef {
  uint32_t struct_size, first;
  double added;
};
constexpr GrownDef defaults{0, 7, 0.5};

}  // namespace

template <>
inline constexpr size_t msq::api::first_size<GrownDef> = sizeof(OldDef);

namespace {

void an_older_host_gets_its_fields_alone(void**) {
  union {
    OldDef old;
    unsigned char bytes[sizeof(GrownDef)];
  } host;
  std::memset(&host, 0xa5, sizeof host);
  msq::api::set_defaults(reinterpret_cast<GrownDef*>(&host), sizeof(OldDef), defaults, "def");
  assert_int_equal(host.old.struct_size, sizeof(OldDef));
  assert_int_equal(host.old.first, 7);
  for (size_t i = sizeof(OldDef); i < sizeof host.bytes; ++i) assert_int_equal(host.bytes[i], 0xa5);
}

void what_an_older_host_lacks_has_its_default(void**) {
  OldDef host[2] = {{sizeof(OldDef), 3}, {0xffffffff, 0xffffffff}};
  const GrownDef known =
      msq::api::read_def(reinterpret_cast<const GrownDef*>(host), defaults, "def");
  assert_int_equal(known.first, 3);
  assert_true(known.added == 0.5);
}

void less_than_the_first_size_is_refused(void**) {
  GrownDef host = defaults;
  host.struct_size = sizeof(OldDef) - 1;
  try {
    msq::api::read_def(&host, defaults, "def");
    fail_msg("accepted");
  } catch (const msq::Error& error) {
    assert_int_equal(static_cast<int32_t>(error.status), MSQ_E_ARGUMENT);
  }
}

}  // namespace

int main() {
  const CMUnitTest tests[] = {
      cmocka_unit_test(an_older_host_gets_its_fields_alone),
      cmocka_unit_test(what_an_older_host_lacks_has_its_default),
      cmocka_unit_test(less_than_the_first_size_is_refused),
  };
  return cmocka_run_group_tests(tests, nullptr, nullptr);
}
