#include "tasks/manifest/plan.hpp"

#include <fmt/format.h>

#include <cassert>
#include <charconv>
#include <mutex>
#include <utility>

#include "tasks/io/hash.hpp"
#include "tasks/packings/mixture_json.hpp"

namespace isojam {
namespace {

/// A longer prefix would be unreadable; a hash replaces it.
constexpr std::size_t longest_prefix = 96;

/// First part of the names of a sweep point's replicates. The values are numbers, booleans and names, which do not
/// contain the separator.
std::string prefix(const ReplicateSpec& spec) {
  const auto size = fmt::format("{}-N{}", to_string(spec.solid), spec.particles);
  auto text = size;
  for (const auto& item : spec.parameters.items()) {
    const auto& value = item.value();
    text += fmt::format("-{}{}{}", item.key(), value.is_number() ? "" : "_",
                        value.is_string() ? value.get<std::string>() : compact(value));
  }
  return text.size() <= longest_prefix ? text : fmt::format("{}-{}", size, hex_hash(point_text(spec)));
}

}  // namespace

std::string point_text(const Mixture& solid, int particles, const Json& parameters) {
  Json point;
  point["solid"] = to_string(solid);
  point["particles"] = particles;
  for (const auto& item : parameters.items()) point[item.key()] = item.value();
  return compact(point);
}

std::string point_text(const ReplicateSpec& spec) { return point_text(spec.solid, spec.particles, spec.parameters); }

Plan::Plan(const Manifest& manifest)
    : manifest_(manifest),
      sets_(option_sets(manifest)),
      points_(manifest.solids.size() * manifest.particles.size() * sets_.size()),
      texts_(points_) {
  for (std::size_t point = 0; point < points_; ++point) point_of_prefix_[prefix(at(point, 0))] = point;
}

ReplicateSpec Plan::at(std::size_t point, int replicate) const {
  assert(point < points_ && replicate >= 0 && (replicate < replicates() || !manifest_.start));
  const auto& set = sets_[point % sets_.size()];
  const auto size = point / sets_.size();
  const auto& solid = manifest_.solids[size / manifest_.particles.size()];
  const int particles = manifest_.particles[size % manifest_.particles.size()];
  return {solid,
          particles,
          set.parameters,
          replicate,
          manifest_.seed,
          options_of(manifest_, set, solid, particles),
          manifest_.measures,
          manifest_.measuring,
          manifest_.start,
          volume_changes(solid, manifest_.definitions)};
}

ReplicateSpec Plan::operator[](std::size_t index) const {
  const auto each = static_cast<std::size_t>(replicates());
  return at(index / each, static_cast<int>(index % each));
}

std::optional<Plan::Place> Plan::place_of(std::string_view name) const {
  const auto split = name.rfind("-r");
  if (split == std::string_view::npos) return std::nullopt;
  const auto point = point_of_prefix_.find(name.substr(0, split));
  const auto digits = name.substr(split + 2);
  int replicate = -1;
  const auto [end, error] = std::from_chars(digits.data(), digits.data() + digits.size(), replicate);
  if (point == point_of_prefix_.end() || error != std::errc() || replicate < 0 ||
      replicate >= (manifest_.start ? replicates() : static_cast<int>(most_replicates)))
    return std::nullopt;
  // The name must be spelt exactly as isojam spells it. For example, the number 1 must be written 0001.
  if (fmt::format("{}-r{:04}", point->first, replicate) != name) return std::nullopt;
  return Place{point->second, replicate};
}

std::string replicate_name(const ReplicateSpec& spec) { return fmt::format("{}-r{:04}", prefix(spec), spec.replicate); }

RandomStream replicate_stream(const ReplicateSpec& spec, Purpose purpose) {
  return RandomStream{spec.seed, hash_of(point_text(spec.solid, spec.particles, Json::object())),
                      static_cast<std::uint64_t>(spec.replicate), static_cast<std::uint64_t>(purpose)};
}

static Nested start_of(Start& start, std::size_t replicate) {
  return Nested{[&start, replicate](Fields& of) {
    of("digest", start.files[replicate].digest, "Digest of the file.");
    of("frame", start.frame, "Index of the frame in the file, counted from 0. The value -1 means the last frame.")
        .range({-1e9, 1e9});
    of("density", start.density,
       "Density to which the packing was strained before the protocol; absent if it kept the density of the file.")
        .range({0, 1, true})
        .finite();
    of("stage", start.stage,
       "First stage of the protocol. `compression`: The packing was first compressed to the target energy. "
       "`decompression`: The packing was treated as jammed and only decompressed. `as_given`: The packing was measured "
       "as it was, and nothing was relaxed.");
    of("gap", start.gap, "Pairs with a smaller gap count as contacts; absent if only overlapping pairs do.")
        .unit("V_p^(1/3)")
        .range({0, 1, true})
        .finite();
  }};
}

void describe(Fields& field, ReplicateSpec& spec) {
  field("particles", spec.particles, "Number N of particles.").range({1, 100000});
  field.custom("parameters",
               {[&spec] { return spec.parameters; },
                [&spec](const JsonPlace& place) { spec.parameters = place.value(); },
                {{"type", "object"}},
                "object"},
               "Values of the swept parameters, without `solid` and `particles`.");
  field("replicate", spec.replicate, "Number of the replicate at its sweep point, counted from 0.");
  describe(field, spec.options);
  field("measure", spec.measures, "Names of the measures.").distinct();
  field("modes", spec.measuring.modes, "Number of vibrational modes computed at each end of the spectrum.");
  field("shear", spec.measuring.shear,
        "All keys of `shear` in the manifest. Keys that the manifest leaves out have their default values.");
  field("exponents_of_all_states", spec.measuring.exponents_of_all_states,
        "True if the measure `exponents` measured all states, and not only the state nearest jamming.")
      .if_true();
  field
      .custom(
          "volume_changes",
          {[&spec] { return spec.volume_changes.empty() ? Json() : Json(spec.volume_changes); },
           [&spec](const JsonPlace& place) {
             for (const auto& item : place.value().items())
               spec.volume_changes[item.key()] = place.at(item.key()).number({-1, 1});
           },
           {{"type", "object"}, {"additionalProperties", {{"type", "number"}}}},
           "object of names and numbers"},
          "Relative changes of the volumes of solids by the repairs that the manifest requested. Absent if no repair "
          "changed a volume.")
      .optional();
  field.member("start",
               Maybe{[&spec] { return spec.start.has_value(); },
                     [&spec]() -> MemberRef {
                       if (!spec.start) spec.start.emplace().files.resize(static_cast<std::size_t>(spec.replicate) + 1);
                       return start_of(*spec.start, static_cast<std::size_t>(spec.replicate));
                     },
                     [&spec] { spec.start.reset(); },
                     []() -> MemberRef {
                       static Start example{{StartFile{}}};
                       return start_of(example, 0);
                     }},
               "Initial configuration from a file; absent if the initial configuration was random.");
}

Json to_json(const ReplicateSpec& spec) {
  Json json;
  put_mixture(json, spec.solid);
  json.update(written(spec));
  return json;
}

namespace {

std::string hashed_text(Json spec, std::uint64_t seed) {
  spec.erase("measure");
  spec["seed"] = seed;
  return compact(spec);
}

}  // namespace

std::string spec_digest(Json spec, std::uint64_t seed) { return hex_hash(hashed_text(std::move(spec), seed)); }

std::string spec_digest(const ReplicateSpec& spec) { return spec_digest(to_json(spec), spec.seed); }

std::string Plan::digest(const Place& place) const {
  if (manifest_.start) return spec_digest(at(place.point, place.replicate));
  static std::mutex mutex;
  const std::scoped_lock lock(mutex);
  auto& text = texts_[place.point];
  if (text.empty()) text = hashed_text(to_json(at(place.point, 0)), manifest_.seed);
  // Replicates of a sweep point differ only in their number. In a text, the quotation marks of a key have no backslash.
  constexpr std::string_view number = R"("replicate":0)";
  const auto found = text.find(number);
  return hex_hash(text.substr(0, found + number.size() - 1) + std::to_string(place.replicate) +
                  text.substr(found + number.size()));
}

}  // namespace isojam
