#include <string>

#include "tasks/io/atomic_file.hpp"
#include "tasks/io/json.hpp"
#include "tasks/io/version.hpp"
#include "tasks/measure/flag.hpp"
#include "tasks/measure/quantity.hpp"
#include "tasks/records/record.hpp"

// Writes a file with facts about the files of the program. The Python module reads it, so that these facts are defined
// once.
// usage: isojam-facts PROGRAM FILE, where PROGRAM is the path of isojam relative to the module

namespace {

isojam::Json facts(const std::string& program) {
  isojam::Json json;
  json["program"] = program;
  json["version"] = isojam::version();
  json["schemas"]["record"] = isojam::record_schema;
  json["schemas"]["packing"] = isojam::packing_schema;
  json["schemas"]["path"] = isojam::path_schema;
  json["exclude"] = isojam::Json::array();
  for (const auto flag : isojam::usually_excluded()) json["exclude"].push_back(to_string(flag));
  for (const auto& quantity : isojam::all_quantities()) {
    isojam::Json entry;
    entry["name"] = quantity.name;
    entry["pointer"] = quantity.pointer;
    entry["of"] = quantity.of == isojam::Quantity::Of::replicate ? "replicate" : "state";
    entry["unit"] = quantity.unit;
    entry["group"] = quantity.group.name;
    json["quantities"].push_back(entry);
  }
  return json;
}

}  // namespace

int main(int argc, char** argv) {
  if (argc != 3) return 2;
  isojam::write_output(argv[2], isojam::pretty(facts(argv[1])));
  return 0;
}
