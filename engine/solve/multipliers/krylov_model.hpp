#pragma once

#include <Eigen/Core>
#include <functional>
#include <optional>

#include "engine/packing/block_matrix.hpp"
#include "engine/solve/factor/block_cholesky.hpp"
#include "engine/solve/factor/incomplete_cholesky.hpp"
#include "engine/solve/minimise/summary.hpp"

namespace isojam {

/// A step, and the decrease of the function that its model predicts.
struct KrylovStep {
  Eigen::VectorXd step;
  double shift = 0;               ///< Levenberg–Marquardt shift λ of the step
  double predicted_decrease = 0;  ///< −g·s − ½ s·M s
};

/// Quadratic model g·s + ½ s·M s of a function, projected onto a Krylov space. The vectors P⁻¹g, P⁻¹M q₁, P⁻¹M q₂, …
/// span the space, where P is a preconditioner. The orthonormal basis of the space is Q = (q₁, q₂, …). With the
/// eigenvalues E and eigenvectors U of Qᵀ M Q, the step for a shift λ is
///   s = −Q U (|E| + λ)⁻¹ Uᵀ Qᵀ g.
/// One space therefore gives the steps for all shifts. M may be indefinite: since |E| replaces E, the step then leads
/// away from the saddle (saddle-free Newton method, Dauphin et al. 2014).
class KrylovModel {
 public:
  static constexpr int most_vectors = 48;

  /// Computes P⁻¹ b.
  using Preconditioner = std::function<Eigen::VectorXd(const Eigen::VectorXd& b)>;

  /// Builds the space. It is large enough if its last vectors hardly change the decrease at `shift`. It has at most
  /// most_vectors vectors.
  KrylovModel(const BlockMatrix& matrix, const Preconditioner& preconditioner, const Eigen::VectorXd& gradient,
              double shift);

  /// True if the space has most_vectors vectors and the last of them still changed the decrease.
  bool incomplete() const { return incomplete_; }
  int vectors() const { return static_cast<int>(eigenvalues_.size()); }  ///< dimension of the space
  /// Lowest eigenvalue of Qᵀ M Q, an upper limit of the lowest eigenvalue of M.
  double lowest() const { return vectors() > 0 ? eigenvalues_[0] : 0; }
  /// The step for the shift λ. If it would move a particle farther than `longest`, λ is doubled until it does not.
  KrylovStep step(double shift, double longest) const;

 private:
  void project(const Eigen::VectorXd& gradient, int vectors);
  double gain(double shift) const;
  Eigen::VectorXd step(double shift) const;

  Eigen::MatrixXd basis_;      ///< Q, one column for each vector
  Eigen::MatrixXd projected_;  ///< Qᵀ M Q
  Eigen::VectorXd eigenvalues_;
  Eigen::MatrixXd eigenvectors_;
  Eigen::VectorXd slopes_;  ///< Uᵀ Qᵀ g
  bool incomplete_ = false;
};

/// Builds Krylov models for a sequence of similar matrices. It chooses the shift λ_P of the preconditioner
/// P ≈ M + λ_P·1. If λ_P is too small, the factorisation fails; if it is too large, the space needs more vectors. λ_P
/// decreases slowly from model to model, and increases after a failed factorisation. It is at least λ, and at least
/// three times the magnitude of the last negative eigenvalue. For a complete factorisation, λ_P begins at λ.
/// If P is an incomplete factorisation, soft modes can remain outside the space. After a model that is incomplete(),
/// factorisations are therefore complete, until a matrix is indefinite.
class KrylovModels {
 public:
  /// `shift` is the first λ_P, and `complete` the memory for complete factorisations (DefiniteSolver).
  KrylovModels(double shift, BlockCholesky& complete) : complete_(complete), shift_(shift) {}

  /// Adapts λ_P to matrices that are larger by this factor from now on.
  void scale(double factor) { shift_ *= factor, negative_ *= factor; }
  /// Magnitude of the lowest eigenvalue in the last space if it was negative, otherwise 0.
  double negative() const { return negative_; }
  /// The model of a function at the Levenberg–Marquardt shift λ. Counts its operations in `work`. Returns nullopt if no
  /// λ_P makes P positive definite, because the matrix is not finite.
  std::optional<KrylovModel> model(const BlockMatrix& matrix, const Eigen::VectorXd& gradient, double shift,
                                   MinimiseWork& work);

 private:
  bool factorise(const BlockMatrix& matrix, MinimiseWork& work);

  IncompleteCholesky incomplete_;
  BlockCholesky& complete_;
  bool uses_complete_ = false;
  double shift_, negative_ = 0;
};

}  // namespace isojam
