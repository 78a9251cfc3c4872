#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "engine/packing/mixture/mixture.hpp"
#include "engine/packing/packing.hpp"
#include "tasks/packings/foreign_packing.hpp"

namespace isojam {

/// A file with an initial configuration.
struct StartFile {
  std::string path;
  /// index of the frame, from 0; −1 is the last frame. Files with one packing ignore it
  int frame = -1;
  std::string digest;                        ///< digest of the bytes of the file
  std::shared_ptr<const Packing> packing{};  ///< the packing; null until load() is called
  /// Largest overlap volume of two particles, divided by that of the smaller one; and what it would be if the
  /// quaternions of an XYZ file had the order w x y z. load_start() sets them.
  double deepest_overlap = 0;
  std::optional<double> deepest_reordered{};
  bool is_xyz = false;               ///< true for extended XYZ, whose quaternions have the order x y z w
  std::vector<std::string> notes{};  ///< notes for the user about the content of the file
};

/// Makes the packing from the bytes of a file, and sets `digest`, `packing` and `notes`. The file must contain n
/// particles of the mixture. It may be JSON that isojam wrote, which is read with all bits, or GSD or extended XYZ.
/// For each particle type without a shape, `types` has the name of its solid. Throws ContentError if the file has
/// another format or contains other particles.
void load(StartFile& file, const std::string& bytes, const Mixture& mixture, int n, const TypeNames& types);

/// True if the particles of the packing are those of the mixture, in any order.
bool are_particles_of(const Packing& packing, const Mixture& mixture);

}  // namespace isojam
