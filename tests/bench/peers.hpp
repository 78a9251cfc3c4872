#pragma once

#include <Eigen/SparseCore>
#include <cstddef>
#include <memory>
#include <string>
#include <vector>

#include "engine/packing/packing.hpp"
#include "tests/bench/pair_set.hpp"

namespace isojam::bench {

// Other libraries with which the contact loop and the block factorisation are compared.

/// The library voro++. For each particle A, its cell is made once. For each pair, a copy of the cell is cut by the
/// planes of B. This gives the volume, the centroid, the neighbours, and S_A from the areas of the faces.
class VoroCells {
 public:
  explicit VoroCells(const PairSet& set);
  ~VoroCells();
  VoroCells(const VoroCells&) = delete;
  VoroCells& operator=(const VoroCells&) = delete;

  /// Volume of the intersection of pair k.
  double overlap(std::size_t k);
  /// S_A of the pair in the latest call of overlap().
  const Eigen::Vector3d& area() const { return area_; }

 private:
  struct Cells;
  const PairSet& set_;
  Eigen::Vector3d area_ = Eigen::Vector3d::Zero();
  std::unique_ptr<Cells> cells_;
};

/// The library CHOLMOD: supernodal factorisation with one thread. The elimination order is that of minimum degree or
/// METIS, whichever is better. The symbolic part is computed once.
class CholmodFactor {
 public:
  explicit CholmodFactor(const Eigen::SparseMatrix<double>& lower_half);
  ~CholmodFactor();
  CholmodFactor(const CholmodFactor&) = delete;
  CholmodFactor& operator=(const CholmodFactor&) = delete;

  /// Factorises the matrix. Returns false if it is not positive definite.
  bool factorise();
  Eigen::VectorXd solve(const Eigen::VectorXd& b);

 private:
  struct Workspace;
  Eigen::SparseMatrix<double> lower_half_;
  std::unique_ptr<Workspace> workspace_;
};

/// A contact that YADE found: its particles, in any order, the volume V, and the force on one of them.
struct YadeContact {
  int a = 0, b = 0;
  double volume = 0;
  Eigen::Vector3d force = Eigen::Vector3d::Zero();
};

/// A step of the program YADE with one thread.
struct YadeStep {
  double seconds = 0;  ///< CPU time
  int left = 0;        ///< contacts with V > 1/2 after an affine expansion by 10 % has separated all particles
  std::vector<YadeContact> contacts;
};

/// Runs YADE with a packing of one solid in a cube, without friction. Throws std::runtime_error if YADE fails.
YadeStep yade_step(const Packing& packing);

/// Description of the BLAS that CHOLMOD uses: its version, its kernels for this processor, and its number of threads.
std::string blas_in_use();

}  // namespace isojam::bench
