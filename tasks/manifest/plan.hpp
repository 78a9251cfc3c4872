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

/// Everything on which the result of one replicate depends. It is a value type, so a replicate can run in any thread or
/// process.
struct ReplicateSpec {
  Mixture solid = SolidKind::tetrahedron;
  int particles = 0;
  Json parameters = Json::object();  ///< values of the swept parameters other than solid and particles
  int replicate = 0;
  std::uint64_t seed = 0;  ///< seed of the manifest
  JamOptions options;
  std::vector<Measure> measures;
  MeasureOptions measuring;
  std::optional<Start> start{};
  std::map<std::string, double> volume_changes{};  ///< of repaired solids, see volume_changes()
};

/// Text that identifies a sweep point by its solid, its number of particles and its swept parameters. It stays the same
/// if the sweep gets more points.
std::string point_text(const Mixture& solid, int particles, const Json& parameters);
std::string point_text(const ReplicateSpec& spec);

/// All replicates that a manifest allows, sorted by sweep point (solid, particles, parameters) and then by replicate
/// number. A specification is made only when it is requested, so the memory does not depend on the number of
/// replicates.
class Plan {
 public:
  explicit Plan(const Manifest& manifest);

  std::size_t points() const { return points_; }
  int replicates() const { return manifest_.replicates.max; }  ///< largest number of replicates per sweep point
  std::size_t size() const { return points_ * static_cast<std::size_t>(replicates()); }
  const Manifest& manifest() const { return manifest_; }
  const std::vector<Flag>& exclude() const { return manifest_.exclude; }

  ReplicateSpec at(std::size_t point, int replicate) const;
  ReplicateSpec operator[](std::size_t index) const;
  struct Place {
    std::size_t point;
    int replicate;
  };
  /// Position of the replicate with this name; nullopt if the plan has no such sweep point. The number of the replicate
  /// may be larger than the plan requests, unless initial configurations are given.
  std::optional<Place> place_of(std::string_view name) const;
  bool requests(const Place& place) const { return place.replicate < replicates(); }
  /// spec_digest() of the replicate, in a fraction of the time.
  std::string digest(const Place& place) const;

 private:
  Manifest manifest_;
  std::vector<OptionSet> sets_;
  std::size_t points_;
  /// index of each sweep point; the key is the common beginning of the names of its replicates
  std::map<std::string, std::size_t, std::less<>> point_of_prefix_;
  mutable std::vector<std::string> texts_;  ///< hashed text of replicate 0 of each sweep point, once it is known
};

/// Name of a replicate, which is also the name of its files without extension:
/// <solid>-N<particles>[-<parameter><value>]…-r<replicate>. An underscore precedes values that are not numbers. If the
/// part before -r is longer than 96 characters, a hash of the sweep point replaces the parameters.
std::string replicate_name(const ReplicateSpec& spec);

/// Random stream of a replicate for one purpose. It depends only on the seed of the manifest, the solid, the number of
/// particles, the replicate number and the purpose. It does not depend on the number of threads or on other replicates.
/// It does not depend on the other swept parameters either: paired replicates therefore have the same initial
/// configuration, and the spread between packings does not hide the effect of a parameter.
RandomStream replicate_stream(const ReplicateSpec& spec, Purpose purpose);

/// The fields in the form in which records store them, without those of put_mixture().
void describe(Fields& field, ReplicateSpec& spec);
/// All fields in this form.
Json to_json(const ReplicateSpec& spec);

/// Digest of everything that determines a replicate: its specification in this form without the measures, and the seed.
/// Two replicates with the same digest have the same states, whatever else their manifests request.
std::string spec_digest(Json spec, std::uint64_t seed);
std::string spec_digest(const ReplicateSpec& spec);

}  // namespace isojam
