#include <cstdint>
#include <cstdlib>
#include <string_view>

#include "tasks/io/input_error.hpp"
#include "tasks/manifest/manifest.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace isojam;
  try {
    const std::string_view text(reinterpret_cast<const char*>(data), size);
    const auto canonical = to_json(parse_manifest(text, "fuzz"));
    if (to_json(parse_manifest(canonical.dump(), "canonical")) != canonical) std::abort();
  } catch (const InputError& refused) {
    if (*refused.what() == '\0') std::abort();
  }
  return 0;
}
