#pragma once

#include <cmath>
#include <cstddef>
#include <memory>

#include "tests/bench/pair_set.hpp"

namespace isojam::bench {

/// What a user could take instead of the contact loop.

/// voro++: A's cell, cut once per particle, is copied and cut by B's planes; then volume, centroid and neighbours.
class VoroCells {
 public:
  explicit VoroCells(const PairSet& set);
  ~VoroCells();
  VoroCells(const VoroCells&) = delete;
  VoroCells& operator=(const VoroCells&) = delete;

  /// Volume of A ∩ B of pair k.
  double overlap(std::size_t k);

 private:
  struct Cells;
  const PairSet& set_;
  std::unique_ptr<Cells> cells_;
};

/// CGAL: intersection of the half-spaces of both, predicates exact and constructions in double.
double cgal_overlap(const PairSet& set, std::size_t k);

/// The greatest difference of a peer's volumes from the contact loop's over the first `pairs` pairs, relative.
template <class Volume>
double worst_difference(const PairSet& set, std::size_t pairs, const Volume& volume) {
  double worst = 0;
  for (std::size_t k = 0; k < pairs; ++k) {
    SeparatingAxis unused;
    const double ours = overlap(set.a(k), set.b(k), set.r(k), unused).volume;
    const double difference = std::abs(volume(k) - ours) / ours;
    if (!(difference <= worst)) worst = difference;  // a NaN stays
  }
  return worst;
}

}  // namespace isojam::bench
