#pragma once

#include <memory>
#include <string>

#include "engine/packing/mixture/mixture.hpp"
#include "engine/packing/packing.hpp"
#include "tasks/packings/gsd_file.hpp"

namespace isojam {

/// A file that replicates begin from.
struct StartFile {
  std::string path;
  int frame = -1;                            ///< of a file of several; −1: the last
  std::string digest;                        ///< of its bytes
  std::shared_ptr<const Packing> packing{};  ///< null until it is needed
};

/// The packing of n particles of the mixture that stands in a file: one of the program's own, which comes bit for bit,
/// a GSD or an extended XYZ. Sets digest and packing. Throws NoPackingFile for anything else, FileError if the file
/// cannot be read.
void load(StartFile& file, const Mixture& mixture, int n);

/// Whether these are the particles of a mixture, in some order.
bool are_particles_of(const Packing& packing, const Mixture& mixture);

}  // namespace isojam
