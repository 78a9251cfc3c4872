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

/// All that one replicate depends on: a value that can be run anywhere.
struct ReplicateSpec {
  Mixture solid = SolidKind::tetrahedron;
  int particles = 0;
  Json parameters = Json::object();  ///< the other swept values of its sweep point
  int replicate = 0;
  std::uint64_t seed = 0;  ///< the manifest's
  std::string manifest_digest;
  std::string sweep_digest;  ///< of the manifest without its measures
  JamOptions options;
  std::vector<Measure> measures;
  MeasureOptions measuring;
  std::optional<Start> start{};
};

/// Identity of a sweep point: solid, particles and the other swept values; never its place in the sweep.
std::string point_text(const Mixture& solid, int particles, const Json& parameters);
std::string point_text(const ReplicateSpec& spec);

/// Every replicate that a manifest can ask for, in canonical order: sweep point (solid, particles, parameters), then
/// replicate. A recipe: a specification is made when it is asked for, so that a plan of any length costs nothing.
class Plan {
 public:
  explicit Plan(const Manifest& manifest);

  std::size_t points() const { return points_; }
  int replicates() const { return manifest_.replicates.max; }  ///< of a point, at most
  std::size_t size() const { return points_ * static_cast<std::size_t>(replicates()); }
  const Manifest& manifest() const { return manifest_; }
  const std::string& manifest_digest() const { return digest_; }  ///< the manifest's
  const std::vector<Flag>& exclude() const { return manifest_.exclude; }

  ReplicateSpec at(std::size_t point, int replicate) const;
  ReplicateSpec operator[](std::size_t index) const;
  struct Place {
    std::size_t point;
    int replicate;
  };
  /// Where the replicate of that name stands; nullopt if the plan has none.
  std::optional<Place> place_of(std::string_view name) const;

 private:
  Manifest manifest_;
  std::string digest_, sweep_digest_;
  std::vector<OptionSet> sets_;
  std::size_t points_;
  std::map<std::string, std::size_t, std::less<>> point_of_prefix_;  ///< by what its replicates' names have in common
};

/// A safe file name without extension: <solid>-N<particles>[-<parameter><value>]…-r<replicate>, with a hash of the
/// point in the place of its parameters where they would take too long.
std::string replicate_name(const ReplicateSpec& spec);

/// Stream of (manifest seed, solid, particles, replicate, purpose): the same alone, in a sweep and with any number of
/// threads. The other swept values are no part of it: replicates of one number begin alike at each of them, so that
/// what these change is not hidden by the spread between packings.
RandomStream replicate_stream(const ReplicateSpec& spec, Purpose purpose);

/// The specification as it stands in a record.
Json to_json(const ReplicateSpec& spec);

}  // namespace isojam
