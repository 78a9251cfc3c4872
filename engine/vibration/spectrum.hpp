#pragma once

#include <Eigen/Core>
#include <array>
#include <string_view>

#include "engine/names/enum_names.hpp"
#include "engine/packing/block_matrix.hpp"

namespace isojam {

/// Method that found a set of modes.
enum class ModeEnd {
  not_called,
  converged,  ///< the Lanczos method converged at the first attempt, or dense_modes() converged
  /// the Lanczos method converged at the second attempt, with a larger subspace and, for lowest modes, another shift
  retried,
  /// a dense solver found the modes, because the Lanczos method did not converge or too many modes were requested
  dense_fallback,
  failed  ///< no modes were found, because there are too many particles for the dense solver or D is not finite
};
template <>
inline constexpr std::array enum_names<ModeEnd>{
    EnumName{ModeEnd::not_called, "not_called"}, EnumName{ModeEnd::converged, "converged"},
    EnumName{ModeEnd::retried, "retried"}, EnumName{ModeEnd::dense_fallback, "dense_fallback"},
    EnumName{ModeEnd::failed, "failed"}};

/// A set of modes: eigenvalues λ = ω² and eigenvectors u of D u = λ u. The three translations are excluded by
/// projection, because they are null vectors of D in any state.
struct ModeSet {
  ModeEnd ended = ModeEnd::not_called;  ///< method that found the modes
  Eigen::VectorXd eigenvalues;          ///< eigenvalues λ in ascending order
  /// eigenvectors u as columns, 6N × modes; orthonormal, and orthogonal to translations
  Eigen::MatrixXd vectors;
  double residual = 0;  ///< largest ‖Du − λu‖/λ_max of all modes
  /// Upper bound of the relative error of the eigenvalues, the maximum of (‖Du − λu‖ + ε λ_max)/|λ| with ε = 2⁻⁵²: by
  /// Weyl's theorem, an exact eigenvalue of D differs from λ by at most ‖Du − λu‖, and D itself has an error of ε
  /// λ_max. Infinite if a λ is 0.
  double relative_error = 0;
  int attempts = 0;  ///< number of attempts to compute the modes

  Eigen::Index size() const { return eigenvalues.size(); }  ///< number of modes
};

/// Lowest and highest modes of a packing. Eigenvalues are in units of (Y/ρ)·V_p^(-2/3).
struct SpectrumEnds {
  ModeSet lowest, highest;  ///< modes at the two ends of the spectrum, without the translations
  double lambda_max = 0;    ///< largest |λ| of the spectrum

  bool complete() const { return lowest.size() > 0 && highest.size() > 0; }  ///< true if modes were found at both ends
};

/// Numbers of modes to compute, and parameters of the methods.
struct ModeOptions {
  int lowest = 50, highest = 50;  ///< numbers of modes; if the packing has fewer modes, all modes are computed
  /// Magnitude |σ|/λ_max of the shift σ < 0 in the first attempt. It must be larger than the rounding errors of the
  /// translations in the factorisation, but not much larger than the smallest λ/λ_max. This ratio is of order Δφ⁴, and
  /// 1e-12 for the packings of tetrahedra nearest to jamming, for which a shift of 1e-6 gives wrong modes.
  double shift = 1e-11;
  /// Relative accuracy of 1/(λ − σ) for the lowest modes, where σ is the shift. The inverse iteration converges so fast
  /// that full accuracy costs little.
  double lowest_tolerance = 1e-13;
  /// Largest relative residual of the highest modes. The relative error of an eigenvalue is about the square of its
  /// residual, and a higher accuracy costs much time, because the highest eigenvalues are close to each other.
  double highest_tolerance = 1e-8;
  int restarts = 300;       ///< largest number of restarts of the Krylov space
  int largest_dense = 500;  ///< largest number of particles for the dense solver, which needs 216 MB for 500
};

/// Computes the lowest modes by the shift-invert Lanczos method with a shift below 0, and the highest modes by the
/// Lanczos method for D itself. Start vectors are fixed, so the same matrix gives the same bits. Modes are computed
/// again if the method does not converge, if the residual shows that the factorisation was inaccurate, or if there are
/// fewer modes below the shift than Sylvester's law of inertia requires: first with a larger subspace and a shift below
/// the whole spectrum, then by the dense solver, for at most `largest_dense` particles. If no modes are found,
/// ModeSet::ended reports the failure, and nothing is thrown.
SpectrumEnds spectrum_ends(const BlockMatrix& matrix, const ModeOptions& options = {});

/// Computes all 6N − 3 modes with the dense solver, in a time of O(N³) and with a memory of O(N²).
ModeSet dense_modes(const BlockMatrix& matrix);

}  // namespace isojam
