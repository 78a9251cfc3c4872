#pragma once

#include <memory>
#include <string>

#include "engine/packing/mixture/mixture.hpp"
#include "engine/packing/packing.hpp"
#include "tasks/packings/gsd_file.hpp"

namespace isojam {

/// A file with an initial configuration.
struct StartFile {
  std::string path;
  /// index of the frame, from 0; −1 is the last frame. Files with one packing ignore it
  int frame = -1;
  std::string digest;                        ///< digest of the bytes of the file
  std::shared_ptr<const Packing> packing{};  ///< the packing; null until load() is called
};

/// Loads the packing from a file, and sets `digest` and `packing`. The file must contain n particles of the mixture. It
/// may be JSON that isojam wrote, which is read with all bits, or GSD or extended XYZ. Throws NoPackingFile if the file
/// has another format or contains other particles, and FileError if the file cannot be read.
void load(StartFile& file, const Mixture& mixture, int n);

/// True if the particles of the packing are those of the mixture, in any order.
bool are_particles_of(const Packing& packing, const Mixture& mixture);

}  // namespace isojam
