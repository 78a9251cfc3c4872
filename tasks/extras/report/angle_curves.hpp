#pragma once

#include <cstddef>
#include <optional>
#include <vector>

#include "engine/packing/mixture/mixture.hpp"
#include "tasks/io/json.hpp"

namespace isojam {

/// Critical angles of a solid, and distributions of the alignment angles of random contacts, as in Figure 2 of the
/// paper. They do not depend on a run. Angles are in degrees, and c is the fraction of angles up to θ:
/// {"critical": {"face_face": [{"topology", "angle"}], "edge_face": [...]},
/// "random": [{"which", "face_face": [[θ, c], ...], "edge_face": [...]}]}.
/// For a mixture, the critical angles are the smallest ones of its solids, and "random" is empty.
Json angle_references(const Mixture& mixture);

/// Smallest angle that is drawn, in degrees.
inline constexpr double angle_floor = 1e-6;

/// The empirical distribution of angles. It needs no more memory for more angles: where steps are too close in log θ
/// for a diagram to resolve them, it has only the last one. Angles below `angle_floor` are replaced by `angle_floor`.
class ThinnedCdf {
 public:
  void add(double angle);  ///< in radians
  std::size_t size() const { return size_; }
  /// [[θ in degrees, c], ...], with one entry for each step.
  Json steps() const;

 private:
  struct Bin {
    std::size_t angles = 0;
    double largest = 0;
  };
  std::vector<Bin> bins_;  ///< in ascending order
  double least_ = 0;
  std::size_t size_ = 0, equal_to_least_ = 0;
};

/// Jamming density in Table I of the paper, and half the width of its 95 % confidence interval.
struct PaperDensity {
  double phi_j = 0, half_width = 0;
};
/// The jamming density for packings of this solid with this N; nullopt if Table I does not contain it.
std::optional<PaperDensity> paper_density(const Mixture& solid, int particles);

}  // namespace isojam
