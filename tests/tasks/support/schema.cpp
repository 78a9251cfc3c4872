#include "tests/tasks/support/schema.hpp"

#include <fmt/format.h>

#include <valijson/adapters/nlohmann_json_adapter.hpp>
#include <valijson/schema.hpp>
#include <valijson/schema_parser.hpp>
#include <valijson/validation_results.hpp>
#include <valijson/validator.hpp>

#include "tasks/io/parse.hpp"

namespace isojam::test {

Json schema(const std::string& name) {
  return read_json(fmt::format("{}/schemas/{}.schema.json", ISOJAM_SOURCE_DIR, name));
}

std::string violations(const std::string& schema_name, const Json& document) {
  return violations_of(schema(schema_name), document);
}

std::string violations_of(const Json& schema, const Json& document) {
  using Adapter = valijson::adapters::NlohmannJsonAdapter;
  const auto plain_schema = nlohmann::json::parse(schema.dump());
  const auto plain_document = nlohmann::json::parse(document.dump());
  valijson::Schema compiled;
  valijson::SchemaParser(valijson::SchemaParser::kDraft7).populateSchema(Adapter(plain_schema), compiled);
  valijson::ValidationResults results;
  valijson::Validator validator(valijson::Validator::kStrongTypes);
  validator.validate(compiled, Adapter(plain_document), &results);
  std::string text;
  for (valijson::ValidationResults::Error error; results.popError(error);) {
    for (const auto& step : error.context) text += step;
    text.append(": ").append(error.description).append("\n");
  }
  return text;
}

}  // namespace isojam::test
