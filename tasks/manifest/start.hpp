#pragma once

#include <optional>
#include <vector>

#include "engine/solve/jam.hpp"
#include "tasks/json/place.hpp"
#include "tasks/packings/start_packing.hpp"

namespace isojam {

struct Manifest;

/// Initial packings instead of particles placed at random: replicate k starts from the k-th file.
struct Start {
  std::vector<StartFile> files;
  std::optional<double> density;             ///< density to which a packing is first strained; nullopt: its own
  JamStage stage = JamStage::consolidation;  ///< stage in which it starts
};

/// Reads {"packing": FILE or [FILE, …], "frame": k, "density": φ, "stage": "consolidation" or "expansion"}; paths are
/// relative to the manifest. A canonical start has "digests", and its files are not read until they are needed.
Start read_start(const JsonPlace& place);
Json to_json(const Start& start);

/// Reads the files that have not been read yet. Refuses files that contain no packing of the manifest's particles,
/// files that changed since their digests were taken, fewer files than replicates, and particles that overlap by more
/// than half of one. `place`: of the start.
void load_start(const JsonPlace& place, Manifest& manifest);
/// The same without the place of an error; does nothing if the manifest has no start.
void load_start(Manifest& manifest);

/// The initial packing of replicate k, which must have been loaded.
Packing begun_from(const Start& start, int replicate);

}  // namespace isojam
