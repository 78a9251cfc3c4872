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
  int frame = -1;                            ///< in a file with several frames; −1: the last
  std::string digest;                        ///< of its bytes
  std::shared_ptr<const Packing> packing{};  ///< null until it is needed
};

/// Loads the packing of n particles of the mixture from a file: the program's own format, which is read bit for bit,
/// GSD or extended XYZ. Sets digest and packing. Throws NoPackingFile for anything else, FileError if the file cannot
/// be read.
void load(StartFile& file, const Mixture& mixture, int n);

/// True if these are the particles of a mixture, in any order.
bool are_particles_of(const Packing& packing, const Mixture& mixture);

}  // namespace isojam
