#pragma once

#include <optional>
#include <vector>

#include "engine/solve/jam.hpp"
#include "tasks/io/describe.hpp"
#include "tasks/packings/start_packing.hpp"

namespace isojam {

struct Manifest;

/// User-defined initial configurations, which replace the random ones. Replicate k starts from files[k].
struct Start {
  std::vector<StartFile> files;
  int frame = -1;  ///< index of the frame in each file, from 0; −1 is the last frame
  /// density to which each packing is strained before the protocol starts; nullopt: packings are not strained
  std::optional<double> density{};
  JamStage stage = JamStage::compression;  ///< first stage of the protocol
  std::optional<double> gap{};             ///< with the stage as_given: pairs with a smaller gap count as contacts
  TypeNames types{};                       ///< solids of the particle types whose shapes are not in the files
};

/// Paths are relative to the folder of the manifest. The canonical form of a manifest has an additional key "digests"
/// with the digests of the files. The files are not read, see load_start().
void describe(Fields& field, Start& start);

/// Reads the files that have not been read yet. `place` is the location of /start in the manifest. Throws InputError in
/// each of these cases:
/// - The sweep has more than one solid or more than one number of particles.
/// - There are fewer files than replicates.
/// - A file cannot be read, or does not contain a packing of the particles in the manifest.
/// - A file has changed since its digest was computed.
/// - The stage is as_given, and a measure needs states of a decompression, or /start/gap is given with another stage.
/// - The initial density is not below max_density, or is below half of compression_step.
/// - The cell is not a cube, but /protocol/cell is not "free": a prescribed cell shape is always a cube.
/// - The cell is so small that a particle could touch two images of another one.
/// - An overlap is larger than half of the volume of the smaller particle.
void load_start(const JsonPlace& place, Manifest& manifest);
/// Reads the files of a manifest whose JSON document is not available. Error messages then contain the name of the
/// manifest instead of its file. Does nothing if the manifest has no start.
void load_start(Manifest& manifest);

/// The initial configuration of a replicate, strained to `density` if it is given. load_start() must have been called.
Packing initial_packing(const Start& start, int replicate);

}  // namespace isojam
