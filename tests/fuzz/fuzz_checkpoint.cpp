// Each document gets the build and the replicate of this program, so that it passes the first checks and reaches the
// later ones.

#include <cstdint>
#include <cstdlib>
#include <string_view>

#include "tasks/io/input_error.hpp"
#include "tasks/io/parse.hpp"
#include "tasks/manifest/plan.hpp"
#include "tasks/records/checkpoint.hpp"
#include "tasks/records/record.hpp"

namespace {

const isojam::ReplicateSpec& spec() {
  static const auto the_spec = isojam::Plan(isojam::parse_manifest(R"({"name": "fuzz", "seed": 7,
    "sweep": {"solid": ["dodecahedron"], "particles": [24]}, "replicates": 1, "protocol": {"max_density": 0.75}})",
                                                                   "fuzz"))[0];
  return the_spec;
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace isojam;
  try {
    auto document = parse_json(std::string_view(reinterpret_cast<const char*>(data), size), "fuzz");
    if (document.is_object()) {
      document["provenance"] = written(provenance_of(spec()));
      document["spec"] = to_json(spec());
    }
    const auto checkpoint = read_checkpoint({document, "fuzz"}, spec());
    if (const auto again = make_checkpoint(spec(), checkpoint)) read_checkpoint({*again, "again"}, spec());
  } catch (const InputError& refused) {
    if (*refused.what() == '\0') std::abort();
  }
  return 0;
}
