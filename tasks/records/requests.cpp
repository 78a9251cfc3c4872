#include "tasks/records/requests.hpp"

#include <fmt/chrono.h>
#include <fmt/format.h>

#include <algorithm>
#include <chrono>

#include "tasks/io/atomic_file.hpp"
#include "tasks/io/file.hpp"
#include "tasks/io/input_error.hpp"
#include "tasks/io/sealed.hpp"
#include "tasks/records/texts.hpp"

namespace isojam {
namespace fs = std::filesystem;
namespace {

constexpr std::size_t date_size = std::string_view("20261231T235959").size();

std::string date_of(const std::string& stem) { return stem.substr(std::max(stem.size(), date_size) - date_size); }

/// Names of the manifests in manifests/, the oldest first.
std::vector<std::string> kept_names(const fs::path& directory) {
  auto names = names_in(directory / "manifests");
  std::stable_sort(names.begin(), names.end(),
                   [](const std::string& a, const std::string& b) { return date_of(a) < date_of(b); });
  return names;
}

fs::path kept_file(const fs::path& directory, const std::string& name) {
  return directory / "manifests" / (name + ".json");
}

/// Adds a manifest to manifests/ as the last one, or gives it a new date if it is there. No two have the same date.
void keep(const fs::path& directory, const std::string& name, const std::string& text) {
  const auto names = kept_names(directory);
  const auto is_same = [&](const std::string& kept) { return read_file(kept_file(directory, kept)) == text; };
  if (!names.empty() && is_same(names.back())) return;
  std::string date;
  for (auto now = std::chrono::system_clock::now(); date.empty() || (!names.empty() && date <= date_of(names.back()));
       now += std::chrono::seconds(1))
    date = fmt::format("{:%Y%m%dT%H%M%S}", fmt::gmtime(std::chrono::system_clock::to_time_t(now)));
  const auto file = kept_file(directory, name + "-" + date);
  const auto same = std::find_if(names.begin(), names.end(), is_same);
  write_atomically(file, text);
  std::error_code ignored;  // an older copy does no harm
  if (same != names.end()) fs::remove(kept_file(directory, *same), ignored);
}

}  // namespace

Requests requests_in(const fs::path& directory, const Warn& warn) {
  Requests requests;
  const auto last = stored_manifest(directory);
  if (last) requests.emplace_back(*last);
  const auto text = last ? sealed(to_json(*last)) : "";
  auto names = kept_names(directory);
  std::reverse(names.begin(), names.end());
  for (const auto& name : names) {
    const auto file = kept_file(directory, name).string();
    try {
      const auto kept = read_file(file);
      if (kept != text) requests.emplace_back(parse_manifest(kept, file));
    } catch (const InputError& damage) {
      warn(problem_line(damage.details()) + "; the manifest is ignored");
    }
  }
  return requests;
}

std::optional<ReplicateSpec> requested(const Requests& requests, std::string_view name) {
  for (const auto& plan : requests) {
    if (const auto place = plan.place_of(name)) return plan.at(place->point, place->replicate);
  }
  return std::nullopt;
}

bool is_requested(const Requests& requests, std::string_view name, const std::string& digest) {
  return std::any_of(requests.begin(), requests.end(), [&](const Plan& plan) {
    const auto place = plan.place_of(name);
    return place && plan.requests(*place) && plan.digest(*place) == digest;
  });
}

Standing standing_of(const RecordedReplicate& replicate, const std::optional<std::string>& digest) {
  if (digest == replicate.summary.spec_digest) return Standing::requested;
  return digest && replicate.summary.failed ? Standing::superseded : Standing::foreign;
}

bool are_in_conflict(const Plan& one, const Plan& other) {
  // Replicates of a sweep point differ only in their number and in the file from which they start.
  const int count = one.manifest().start ? std::min(one.replicates(), other.replicates()) : 1;
  for (std::size_t point = 0; point < one.points(); ++point) {
    for (int replicate = 0; replicate < count; ++replicate) {
      const auto spec = one.at(point, replicate);
      const auto place = other.place_of(replicate_name(spec));
      if (place && spec_digest(other.at(place->point, replicate)) != spec_digest(spec)) return true;
    }
  }
  return false;
}

InputError conflict_of(const fs::path& directory, const RecordedReplicate& replicate, const ReplicateSpec& spec) {
  auto theirs = replicate.record.at("spec"), ours = to_json(spec);
  ours["measure"] = theirs.at("measure");
  theirs["seed"] = replicate.summary.seed, ours["seed"] = spec.seed;
  const auto patch = Json::diff(theirs, ours);
  const auto pointer = patch.empty() ? "" : patch.front().at("path").get<std::string>();
  const Json::json_pointer at(pointer);
  const auto shown = [&](const Json& json) { return json.contains(at) ? compact(json.at(at)) : "not given"; };
  return InputError({(directory / "records" / (replicate.name + ".json")).string(),
                     pointer == "/seed" ? "/provenance/seed" : "/spec" + pointer,
                     fmt::format("{} in the record, {} in this manifest, and only failed replicates are computed again",
                                 shown(theirs), shown(ours)),
                     "", "", fmt::format("restore the setting, or {}", choose_another_directory)});
}

void request(const fs::path& directory, const Manifest& manifest) {
  const auto path = directory / "manifest.json";
  const auto text = sealed(to_json(manifest));
  std::string before;
  if (const auto last = stored_manifest(directory)) keep(directory, last->name, before = read_file(path));
  keep(directory, manifest.name, text);
  if (text != before) write_atomically(path, text);
}

}  // namespace isojam
