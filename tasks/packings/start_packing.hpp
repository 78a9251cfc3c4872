#pragma once

#include <memory>
#include <string>

#include "engine/packing/mixture/mixture.hpp"
#include "engine/packing/packing.hpp"
#include "tasks/packings/gsd_file.hpp"

namespace isojam {

/// A file with an initial packing.
struct StartFile {
  std::string path;
  int frame = -1;                            ///< index of the frame, if the file has several; −1 is the last one
  std::string digest;                        ///< digest of the bytes of the file
  std::shared_ptr<const Packing> packing{};  ///< the packing; null until load() is called
};

/// Loads the packing of n particles of the mixture from a file, and sets `digest` and `packing`. The format is isojam's
/// own JSON, which is read with all bits, GSD or extended XYZ. Throws NoPackingFile if the file has another format or
/// other particles, and FileError if the file cannot be read.
void load(StartFile& file, const Mixture& mixture, int n);

/// True if the packing consists of the particles of the mixture, in any order.
bool are_particles_of(const Packing& packing, const Mixture& mixture);

}  // namespace isojam
