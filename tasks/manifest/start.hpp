#pragma once

#include <optional>
#include <vector>

#include "engine/solve/jam.hpp"
#include "tasks/io/place.hpp"
#include "tasks/packings/start_packing.hpp"

namespace isojam {

struct Manifest;

/// User-defined initial packings instead of random ones. Replicate k starts from the k-th file.
struct Start {
  std::vector<StartFile> files;
  /// density to which the packing is strained before the protocol; nullopt: it is not strained
  std::optional<double> density;
  JamStage stage = JamStage::consolidation;  ///< first stage of the protocol
};

/// Reads {"packing": FILE or [FILE, …], "frame": k, "density": φ, "stage": "consolidation" or "expansion"}; paths are
/// relative to the manifest. In the canonical form there is also the key "digests". The files are then not read before
/// they are needed.
Start read_start(const JsonPlace& place);
Json to_json(const Start& start);

/// Reads the files that have not been read yet. Throws InputError for these errors: a file does not contain a packing
/// of the particles in the manifest; a file has changed since its digest was computed; there are fewer files than
/// replicates; an overlap of two particles is more than half of a particle. `place` is the value of /start.
void load_start(const JsonPlace& place, Manifest& manifest);
/// Reads the files without the location of an error in the manifest. Does nothing if the manifest has no start.
void load_start(Manifest& manifest);

/// The initial packing of a replicate. Its file must have been loaded.
Packing initial_packing(const Start& start, int replicate);

}  // namespace isojam
