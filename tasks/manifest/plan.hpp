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

/// Everything on which one replicate depends. It is a value type, so that a replicate can run in any thread or process.
struct ReplicateSpec {
  Mixture solid = SolidKind::tetrahedron;
  int particles = 0;
  Json parameters = Json::object();  ///< values of the swept parameters other than solid and particles
  int replicate = 0;
  std::uint64_t seed = 0;  ///< of the manifest
  std::string manifest_digest;
  std::string sweep_digest;  ///< digest of the manifest without its measures
  JamOptions options;
  std::vector<Measure> measures;
  MeasureOptions measuring;
  std::optional<Start> start{};
};

/// Text that identifies a sweep point by its solid, its number of particles and its swept parameters. It does not
/// depend on the position of the point in the sweep.
std::string point_text(const Mixture& solid, int particles, const Json& parameters);
std::string point_text(const ReplicateSpec& spec);

/// The list of all replicates of a manifest, sorted by sweep point (solid, particles, parameters) and then by replicate
/// number. A specification is made only when it is requested, so the length of a plan needs no memory.
class Plan {
 public:
  explicit Plan(const Manifest& manifest);

  std::size_t points() const { return points_; }
  int replicates() const { return manifest_.replicates.max; }  ///< largest number of replicates of each sweep point
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
  /// Position of the replicate with this name; nullopt if the plan does not contain it.
  std::optional<Place> place_of(std::string_view name) const;

 private:
  Manifest manifest_;
  std::string digest_, sweep_digest_;
  std::vector<OptionSet> sets_;
  std::size_t points_;
  /// index of a sweep point, by the common prefix of the names of its replicates
  std::map<std::string, std::size_t, std::less<>> point_of_prefix_;
};

/// Name of a replicate, which is also a safe file name without extension:
/// <solid>-N<particles>[-<parameter><value>]…-r<replicate>. If the parameters are too long, a hash of the sweep point
/// replaces them.
std::string replicate_name(const ReplicateSpec& spec);

/// Random stream of a replicate. It depends on the seed of the manifest, the solid, the number of particles, the
/// replicate number and the purpose. It is the same if the replicate runs alone, in a sweep, or with any number of
/// threads. It does not depend on the other swept parameters. Replicates with the same number therefore have the same
/// initial configuration for all values of a parameter, so that the spread between packings does not hide the effect of
/// the parameter.
RandomStream replicate_stream(const ReplicateSpec& spec, Purpose purpose);

/// The specification, as it is written to a record.
Json to_json(const ReplicateSpec& spec);

}  // namespace isojam
