#pragma once

#include <cstdint>
#include <functional>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "engine/random/stream.hpp"
#include "tasks/manifest/manifest.hpp"

namespace isojam {

/// Everything that one replicate depends on, as a value that can be run anywhere.
struct ReplicateSpec {
  Mixture solid = SolidKind::tetrahedron;
  int particles = 0;
  Json parameters = Json::object();  ///< the other swept values of its sweep point
  int replicate = 0;
  std::uint64_t seed = 0;  ///< of the manifest
  std::string manifest_digest;
  std::string sweep_digest;  ///< of the manifest without its measures
  JamOptions options;
  std::vector<Measure> measures;
  MeasureOptions measuring;
  std::optional<Start> start{};
};

/// Identity of a sweep point: solid, particles and the other swept values. It does not depend on the position in the
/// sweep.
std::string point_text(const Mixture& solid, int particles, const Json& parameters);
std::string point_text(const ReplicateSpec& spec);

/// Every replicate that a manifest can ask for, in canonical order: by sweep point (solid, particles, parameters), then
/// by replicate. Specifications are made on request, so a plan of any length costs nothing.
class Plan {
 public:
  explicit Plan(const Manifest& manifest);

  std::size_t points() const { return points_; }
  int replicates() const { return manifest_.replicates.max; }  ///< maximum of each point
  std::size_t size() const { return points_ * static_cast<std::size_t>(replicates()); }
  const Manifest& manifest() const { return manifest_; }
  const std::string& manifest_digest() const { return digest_; }  ///< of the manifest
  const std::vector<Flag>& exclude() const { return manifest_.exclude; }

  ReplicateSpec at(std::size_t point, int replicate) const;
  ReplicateSpec operator[](std::size_t index) const;
  struct Place {
    std::size_t point;
    int replicate;
  };
  /// Position of the replicate with that name; nullopt if the plan has none.
  std::optional<Place> place_of(std::string_view name) const;

 private:
  Manifest manifest_;
  std::string digest_, sweep_digest_;
  std::vector<OptionSet> sets_;
  std::size_t points_;
  std::map<std::string, std::size_t, std::less<>> point_of_prefix_;  ///< by the common prefix of its replicates' names
};

/// A safe file name without extension: <solid>-N<particles>[-<parameter><value>]…-r<replicate>. A hash of the point
/// replaces the parameters if they are too long.
std::string replicate_name(const ReplicateSpec& spec);

/// Random stream of (manifest seed, solid, particles, replicate, purpose). It is the same alone, in a sweep and with
/// any number of threads. The other swept values are no part of it: replicates with the same number have the same
/// initial configuration at each of them, so that the spread between packings does not hide the effect of a parameter.
RandomStream replicate_stream(const ReplicateSpec& spec, Purpose purpose);

/// The specification as written to a record.
Json to_json(const ReplicateSpec& spec);

}  // namespace isojam
