#include "tasks/crate/crate.hpp"

#include <fmt/format.h>

#include <array>
#include <map>
#include <set>
#include <system_error>
#include <utility>
#include <vector>

#include "tasks/crate/sha256.hpp"
#include "tasks/json/sealed.hpp"
#include "tasks/system/file.hpp"

namespace isojam {
namespace fs = std::filesystem;
namespace {

constexpr auto profile = "https://w3id.org/ro/wfrun/process/0.5", crate_version = "https://w3id.org/ro/crate/1.1";
constexpr auto own_license = "https://spdx.org/licenses/BSD-3-Clause";
// The text that the project follows, under the title and the number that it has there.
constexpr auto paper = "https://doi.org/10.48550/arXiv.1104.4933";
constexpr std::array paper_authors{"Kyle C. Smith", "Timothy S. Fisher", "Meheboob Alam"};

/// A text as a part of an address: all but what RFC 3986 calls unreserved, and what `kept` names, as %XX.
std::string encoded(std::string_view text, std::string_view kept = "") {
  constexpr std::string_view plain = "-._~0123456789ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz";
  std::string result;
  for (const char c : text) {
    const bool stays = plain.find(c) != std::string_view::npos || kept.find(c) != std::string_view::npos;
    result += stays ? std::string(1, c) : fmt::format("%{:02X}", static_cast<unsigned char>(c));
  }
  return result;
}

Json reference(const std::string& id) { return {{"@id", id}}; }

/// The program as its records name it, what it made, and of how many of these something failed.
struct Build {
  std::string version, git, compiler;
  Json results = Json::array();
  int records = 0, failed = 0, added_to = 0;
  double cpu_seconds = 0;

  std::string name() const { return encoded(fmt::format("{}-{}-{}", version, git, compiler)); }
};

class Crate {
 public:
  Crate(fs::path directory, const CrateOptions& options, const Warn& warn)
      : directory_(std::move(directory)), options_(options), warn_(warn) {}

  Json metadata() {
    if (names_in(directory_ / "records").empty()) throw_without_records(directory_);
    const Manifest manifest = own_manifest(directory_);
    digest_ = digest(manifest);
    const Json manifest_id = add_file("manifest.json", "What was asked for");
    for_each_record(directory_, manifest, warn_,
                    [&](const RecordedReplicate& held) { add_replicate(held, manifest.keep_path); });
    add_tables_and_report();
    Json runs = Json::array();
    for (const auto& [name, build] : builds_) runs.push_back(add_run(build, manifest_id));
    add_context(manifest, std::move(runs));
    return document();
  }

 private:
  /// Checks nothing: seals and owners are looked at before.
  Json add_file(const std::string& path, const std::string& what) {
    const auto bytes = read_file((directory_ / path).string());
    const auto id = encoded(path, "/");
    entities_[id] = {{"@id", id},
                     {"@type", "File"},
                     {"name", what},
                     {"encodingFormat", path.ends_with(".html") ? "text/html" : "application/json"},
                     {"contentSize", std::to_string(bytes.size())},
                     {"sha256", sha256_hex(bytes)}};
    parts_.push_back(reference(id));
    return reference(id);
  }

  bool has(const std::string& path) const {
    std::error_code error;
    return fs::exists(directory_ / path, error);
  }

  void add_replicate(const RecordedReplicate& held, bool keeps_path) {
    const auto& provenance = held.record.at("provenance");
    Build build{provenance.at("version"), provenance.at("git"), provenance.at("compiler")};
    Build& own = builds_.try_emplace(build.name(), std::move(build)).first->second;
    ++own.records;
    own.failed += held.summary.failed;
    own.cpu_seconds += held.summary.cpu_seconds;
    const Json record = add_file("records/" + held.name + ".json", "Record of " + held.name);
    own.results.push_back(record);
    if (provenance.contains("added")) add_additions(provenance.at("added"), own.name(), record);
    if (held.summary.failed) return;
    const auto path = "paths/" + held.name + ".json";
    check_companions(directory_, held, keeps_path || has(path));
    own.results.push_back(
        add_file("packings/" + held.name + ".json", "The state of " + held.name + " nearest jamming"));
    if (has(path)) own.results.push_back(add_file(path, "All states of the expansion of " + held.name));
  }

  /// A record is a result of every build that added measures to it.
  void add_additions(const Json& added, const std::string& own, const Json& record) {
    std::set<std::string> seen{own};
    for (const auto& addition : added) {
      Build build{addition.at("version"), addition.at("git"), addition.at("compiler")};
      if (!seen.insert(build.name()).second) continue;
      Build& adder = builds_.try_emplace(build.name(), std::move(build)).first->second;
      ++adder.added_to;
      adder.results.push_back(record);
    }
  }

  /// Of these two nobody records by which build they were made: they are results where there is one alone.
  void add_tables_and_report() {
    constexpr std::array files{std::pair{"tables.json", "Tables of means over replicates"},
                               std::pair{"report.html", "Report: tables, charts and packings"}};
    for (const auto& [name, what] : files) {
      if (!has(name)) continue;
      if (fs::path(name).extension() == ".json") (void)read_sealed((directory_ / name).string());
      const Json id = add_file(name, what);
      if (builds_.size() == 1) builds_.begin()->second.results.push_back(id);
    }
  }

  static std::string description_of(const Build& build) {
    auto text = fmt::format("{} replicates, of which {} failed, in {:.0f} CPU seconds", build.records, build.failed,
                            build.cpu_seconds);
    if (build.added_to > 0) text += fmt::format("; measures added to {} records of another build", build.added_to);
    return text;
  }

  Json add_run(const Build& build, const Json& manifest_id) {
    const auto program = "#isojam-" + build.name(), run = fmt::format("#run-{}-{}", digest_, build.name());
    Json& software = entities_[program];
    software = {{"@id", program},
                {"@type", "SoftwareApplication"},
                {"name", "isojam"},
                {"description", "Jammed packings of soft frictionless convex solids; built by " + build.compiler},
                {"softwareVersion", build.version},
                {"license", reference(add_license(own_license))}};
    if (build.git != "unknown") {
      const auto commit = "#commit-" + encoded(build.git);
      entities_[commit] = {{"@id", commit},
                           {"@type", "PropertyValue"},
                           {"name", "commit of the sources"},
                           {"propertyID", "git"},
                           {"value", build.git}};
      software["identifier"] = reference(commit);
    }
    Json action{{"@id", run},
                {"@type", "CreateAction"},
                {"name", build.records > 0 ? "isojam run manifest.json" : "isojam measure"},
                {"description", description_of(build)},
                {"instrument", reference(program)},
                {"object", manifest_id},
                {"result", build.results}};
    if (const auto agent = add_agent()) action["agent"] = reference(*agent);
    entities_[run] = std::move(action);
    return reference(run);
  }

  std::string add_license(const std::string& address) {
    entities_[address] = {
        {"@id", address}, {"@type", "CreativeWork"}, {"name", address.substr(address.find_last_of('/') + 1)}};
    return address;
  }

  std::optional<std::string> add_agent() {
    if (!options_.agent) return std::nullopt;
    const auto id = options_.agent_address.value_or("#" + encoded(*options_.agent));
    entities_[id] = {{"@id", id}, {"@type", "Person"}, {"name", *options_.agent}};
    return id;
  }

  void add_paper() {
    Json authors = Json::array();
    for (const std::string author : paper_authors) {
      const auto id = "#" + encoded(author);
      entities_[id] = {{"@id", id}, {"@type", "Person"}, {"name", author}};
      authors.push_back(reference(id));
    }
    entities_[paper] = {{"@id", paper},
                        {"@type", "ScholarlyArticle"},
                        {"name", "Isostaticity of Constraints in Jammed Systems of Soft Frictionless Platonic Solids"},
                        {"author", std::move(authors)},
                        {"datePublished", "2011"}};
  }

  void add_context(const Manifest& manifest, Json runs) {
    int records = 0;
    for (const auto& [name, build] : builds_) records += build.records;
    root_ = {
        {"@id", "./"},
        {"@type", "Dataset"},
        {"name", manifest.name},
        {"description", fmt::format("Results of isojam: {} replicates of the sweep \"{}\"", records, manifest.name)},
        {"datePublished", options_.date},
        {"conformsTo", reference(profile)},
        {"hasPart", parts_},
        {"mentions", std::move(runs)},
        {"citation", reference(paper)}};
    if (options_.license) root_["license"] = reference(add_license(*options_.license));
    entities_[profile] = {
        {"@id", profile}, {"@type", "CreativeWork"}, {"name", "Process Run Crate"}, {"version", "0.5"}};
    add_paper();
  }

  /// RO-Crate 1.1 was made before schema.org had a term for the hash.
  Json document() {
    Json graph = Json::array();
    graph.push_back({{"@id", crate_name},
                     {"@type", "CreativeWork"},
                     {"conformsTo", reference(crate_version)},
                     {"about", reference("./")}});
    graph.push_back(std::move(root_));
    for (auto& [id, entity] : entities_) graph.push_back(std::move(entity));
    Json document;
    document["@context"] = {std::string(crate_version) + "/context", {{"sha256", "https://schema.org/sha256"}}};
    document["@graph"] = std::move(graph);
    return document;
  }

  fs::path directory_;
  const CrateOptions& options_;
  const Warn& warn_;
  std::string digest_;                    ///< of the manifest
  std::map<std::string, Json> entities_;  ///< by their ids
  std::map<std::string, Build> builds_;
  Json root_, parts_ = Json::array();
};

}  // namespace

Json crate_metadata(const fs::path& directory, const CrateOptions& options, const Warn& warn) {
  return Crate(directory, options, warn).metadata();
}

}  // namespace isojam
