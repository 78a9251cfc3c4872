#include <string>

#include "tasks/extras/export/contact_network.hpp"
#include "tasks/extras/export/record_rows.hpp"
#include "tasks/io/atomic_file.hpp"
#include "tasks/io/json.hpp"
#include "tasks/io/version.hpp"
#include "tasks/measure/quantity.hpp"
#include "tasks/records/record.hpp"

// Writes a file with facts about the files of the program. The Python module reads it, so that these facts are defined
// once.
// usage: isojam-facts PROGRAM FILE, where PROGRAM is the path of isojam relative to the module

namespace {

/// Columns with texts in the tables of `isojam export` and `isojam aggregate`.
isojam::Columns text_columns() {
  isojam::Manifest manifest;
  manifest.measures.assign(isojam::all_measures.begin(), isojam::all_measures.end());
  auto texts = isojam::RecordRows(isojam::RowOf::replicate, isojam::RowFormat::csv, manifest, {}).texts();
  for (const auto& name : isojam::contact_texts()) texts.push_back(name);
  texts.emplace_back("over");
  return texts;
}

isojam::Json facts(const std::string& program) {
  isojam::Json json;
  json["program"] = program;
  json["version"] = isojam::version();
  json["schemas"]["record"] = isojam::record_schema;
  json["schemas"]["packing"] = isojam::packing_schema;
  json["schemas"]["path"] = isojam::path_schema;
  json["texts"] = text_columns();
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
