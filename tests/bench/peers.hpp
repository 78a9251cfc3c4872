#pragma once

#include <Eigen/SparseCore>
#include <cmath>
#include <cstddef>
#include <memory>
#include <string>

#include "tests/bench/pair_set.hpp"

namespace isojam::bench {

// Alternatives that a user could choose instead of the contact loop and the block factorisation.

/// voro++: A's cell, cut once per particle, is copied and cut by B's planes. The results are volume, centroid,
/// neighbours and, from its face areas, S_A.
class VoroCells {
 public:
  explicit VoroCells(const PairSet& set);
  ~VoroCells();
  VoroCells(const VoroCells&) = delete;
  VoroCells& operator=(const VoroCells&) = delete;

  /// Volume of A ∩ B for pair k.
  double overlap(std::size_t k);
  /// S_A of the pair in the last call of overlap().
  const Eigen::Vector3d& area() const { return area_; }

 private:
  struct Cells;
  const PairSet& set_;
  Eigen::Vector3d area_ = Eigen::Vector3d::Zero();
  std::unique_ptr<Cells> cells_;
};

/// CGAL: intersection of the half-spaces of both solids, with exact predicates and constructions in double.
double cgal_overlap(const PairSet& set, std::size_t k);

/// CHOLMOD: supernodal, with the better order of minimum degree and METIS, its symbolic part kept; one thread.
class CholmodFactor {
 public:
  explicit CholmodFactor(const Eigen::SparseMatrix<double>& lower_half);
  ~CholmodFactor();
  CholmodFactor(const CholmodFactor&) = delete;
  CholmodFactor& operator=(const CholmodFactor&) = delete;

  /// Returns false if the matrix is not positive definite.
  bool factorise();
  Eigen::VectorXd solve(const Eigen::VectorXd& b);

 private:
  struct Workspace;
  Eigen::SparseMatrix<double> lower_half_;
  std::unique_ptr<Workspace> workspace_;
};

/// The BLAS used by CHOLMOD: its version, its kernels for this machine, and its threads.
std::string blas_in_use();

/// Largest relative difference between a peer's volumes and the contact loop's over the first `pairs` pairs.
template <class Volume>
double worst_difference(const PairSet& set, std::size_t pairs, const Volume& volume) {
  double worst = 0;
  for (std::size_t k = 0; k < pairs; ++k) {
    SeparatingAxis unused;
    const double ours = overlap(set.a(k), set.b(k), set.r(k), unused).volume;
    const double difference = std::abs(volume(k) - ours) / ours;
    if (!(difference <= worst)) worst = difference;  // keeps a NaN
  }
  return worst;
}

/// The same for S_A of all pairs, relative to |S_A| of the contact loop.
template <class Area>
double worst_area_difference(const PairSet& set, const Area& area) {
  double worst = 0;
  for (std::size_t k = 0; k < set.size(); ++k) {
    SeparatingAxis unused;
    const Eigen::Vector3d ours = overlap(set.a(k), set.b(k), set.r(k), unused).area;
    const double difference = (area(k) - ours).norm() / ours.norm();
    if (!(difference <= worst)) worst = difference;
  }
  return worst;
}

}  // namespace isojam::bench
