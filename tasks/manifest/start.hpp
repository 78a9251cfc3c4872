#pragma once

#include <optional>
#include <vector>

#include "engine/solve/jam.hpp"
#include "tasks/json/place.hpp"
#include "tasks/packings/start_packing.hpp"

namespace isojam {

struct Manifest;

/// What replicates begin from instead of particles placed at random: replicate k from the k-th file.
struct Start {
  std::vector<StartFile> files;
  std::optional<double> density;             ///< to which a packing is strained first; its own without
  JamStage stage = JamStage::consolidation;  ///< in which it begins
};

/// {"packing": FILE or [FILE, …], "frame": k, "density": φ, "stage": "consolidation" or "expansion"}; paths from the
/// manifest's. A canonical one has "digests", and its files are not looked at until they are needed.
Start read_start(const JsonPlace& place);
Json to_json(const Start& start);

/// Reads the files that have not been read, and refuses what cannot be begun from: files that hold no packing of the
/// manifest's particles, have changed since their digests were taken, are fewer than replicates, or whose particles
/// overlap by more than half of one. `place`: of the start.
void load_start(const JsonPlace& place, Manifest& manifest);
/// The same of a manifest from anywhere; nothing if it has no start.
void load_start(Manifest& manifest);

/// The packing that replicate k begins with. It has been loaded.
Packing begun_from(const Start& start, int replicate);

}  // namespace isojam
