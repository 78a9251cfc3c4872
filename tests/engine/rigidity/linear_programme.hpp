#pragma once

#include <Eigen/Core>
#include <Eigen/SparseCore>
#include <cstdint>
#include <memory>

class ClpSimplex;

namespace isojam {

/// What became of a linear programme.
struct Optimum {
  enum class End : std::uint8_t { found, infeasible, unknown };
  End end = End::unknown;
  Eigen::VectorXd f;  ///< if found
};

/// Linear programmes over the f ≥ 0 with columns·f = 0 and Σf = 1, one objective after another, by the simplex method.
class LinearProgramme {
 public:
  /// f ≥ 0 and columns·f = 0 hold to `tolerance`.
  LinearProgramme(const Eigen::SparseMatrix<double>& columns, double tolerance);
  ~LinearProgramme();
  LinearProgramme(const LinearProgramme&) = delete;
  LinearProgramme& operator=(const LinearProgramme&) = delete;

  /// The f that makes objective·f greatest. Begins where the last one ended.
  Optimum greatest(const Eigen::VectorXd& objective);

 private:
  std::unique_ptr<ClpSimplex> model_;
  bool begun_ = false;
};

}  // namespace isojam
