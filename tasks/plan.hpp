#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "engine/random/stream.hpp"
#include "tasks/manifest.hpp"

namespace isojam {

/// What a stream of random bits is used for; part of its key.
enum class Purpose : std::uint64_t { placement = 1, bootstrap = 2 };

/// All that one replicate depends on: a value that can be run anywhere.
struct ReplicateSpec {
  SolidKind solid = SolidKind::tetrahedron;
  int particles = 0;
  Json parameters = Json::object();  ///< the other swept values of its sweep point
  int replicate = 0;
  std::uint64_t seed = 0;  ///< the manifest's
  std::string manifest_digest;
  JamOptions options;
  std::vector<Measure> measures;
  MeasureOptions measuring;
};

/// Identity of a sweep point: solid, particles and the other swept values; never its place in the sweep.
std::string point_text(SolidKind solid, int particles, const Json& parameters);
std::string point_text(const ReplicateSpec& spec);

/// Every replicate in canonical order: solid, particles, parameters, replicate.
std::vector<ReplicateSpec> make_plan(const Manifest& manifest);

/// A safe file name without extension: <solid>-N<particles>[-<hash of the point>]-r<replicate>.
std::string replicate_name(const ReplicateSpec& spec);

/// Stream of (manifest seed, sweep point, replicate, purpose): the same alone, in a sweep and with any number of
/// threads.
RandomStream replicate_stream(const ReplicateSpec& spec, Purpose purpose);

/// The specification as it stands in a record.
Json to_json(const ReplicateSpec& spec);

}  // namespace isojam
