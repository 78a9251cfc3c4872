#pragma once

#include <Eigen/Core>
#include <span>
#include <vector>

#include "engine/packing/neighbours.hpp"
#include "engine/packing/packing.hpp"
#include "engine/packing/pair_loop.hpp"

namespace isojam {

/// Contributions of one pair of particles a and b to an Evaluation.
struct ContactTerms {
  /// terms that are added to the gradient: (dx, dtheta_a) for a, and (−dx, dtheta_b) for b
  Eigen::Vector3d dx, dtheta_a, dtheta_b;
  Eigen::Matrix3d stress;        ///< −V_cell times the term that is added to the stress
  double energy = 0, force = 0;  ///< energy e of the pair, and force |F|
  /// ½ |∇V|², with derivatives with respect to one particle only: a for stiffness_a, and b for stiffness_b
  double stiffness_a = 0, stiffness_b = 0;
  double error = 0;  ///< relative error ρ_c, see Evaluation::residual_floor; 0 with Precision::working
};

/// Contributions of the touching pairs of a neighbour list.
struct PairTerms {
  /// A touching pair.
  struct Entry {
    NeighbourPair pair;  ///< the particles a and b, and the image of b
    ContactTerms terms;  ///< the contributions of the pair
  };
  std::vector<std::vector<Entry>> blocks;  ///< in the order of the list; the blocks are computed in parallel
};

/// Energy of a pair as a function of its overlap volume V: e = quadratic V² + linear V.
struct PairLaw {
  double quadratic = 0.25;  ///< in units of Y/V_p
  double linear = 0;        ///< in units of Y
};

/// Computes the contributions of all touching pairs of a neighbour list, and writes them to `terms`.
void set_terms(const Packing& packing, Precision precision, std::span<const NeighbourPair> pairs,
               const TouchingPairs& touching, const PairLaw& law, PairTerms& terms);

}  // namespace isojam
