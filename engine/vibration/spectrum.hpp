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
  converged,  ///< the Lanczos method converged at the first attempt
  retried,    ///< the Lanczos method converged at the second attempt, with another shift or a larger subspace
  /// a dense solver found the modes, because the Lanczos method did not converge or too many modes were requested
  dense_fallback,
  failed  ///< no modes were found, because there are too many particles for the dense solver or D is not finite
};
template <>
inline constexpr std::array enum_names<ModeEnd>{
    EnumName{ModeEnd::not_called, "not_called"}, EnumName{ModeEnd::converged, "converged"},
    EnumName{ModeEnd::retried, "retried"}, EnumName{ModeEnd::dense_fallback, "dense_fallback"},
    EnumName{ModeEnd::failed, "failed"}};

/// A set of modes: eigenvalues λ = ω² and eigenvectors u of D u = λ u. The three translations, which are null vectors
/// in any state, are excluded by projection.
struct ModeSet {
  ModeEnd ended = ModeEnd::not_called;  ///< method that found the modes
  Eigen::VectorXd eigenvalues;          ///< eigenvalues λ in ascending order
  /// eigenvectors as columns, 6N × modes, in the coordinates of D; orthonormal, and orthogonal to translations
  Eigen::MatrixXd vectors;
  double residual = 0;  ///< largest ‖Du − λu‖ / λ_max
  /// Upper bound of the relative error of the eigenvalues, max (‖Du − λu‖ + ε λ_max)/|λ|. By Weyl's theorem, an exact
  /// eigenvalue of D differs from λ by at most ‖Du − λu‖; the matrix D itself has an error of ε λ_max. Infinite if some
  /// λ is 0.
  double relative_error = 0;
  int attempts = 0;  ///< number of attempts of the Lanczos method

  Eigen::Index size() const { return eigenvalues.size(); }  ///< number of modes
};

/// Lowest and highest modes of a packing. Eigenvalues are in units of (Y/ρ)·V_p^(-2/3).
struct SpectrumEnds {
  ModeSet lowest, highest;  ///< modes at both ends of the spectrum, without the translations
  double lambda_max = 0;    ///< largest |λ| of the spectrum

  bool complete() const { return lowest.size() > 0 && highest.size() > 0; }  ///< true if modes were found at both ends
};

/// Numbers of modes to compute, and parameters of the computation.
struct ModeOptions {
  int lowest = 50, highest = 50;  ///< numbers of modes; if the packing has fewer modes, all are computed
  /// Shift −σ/λ_max of the first attempt, where σ < 0. It must be larger than the rounding error of the translations in
  /// the factorisation. It must not be much larger than the softest modes: λ_l/λ_h ~ Δφ⁴ is 1e-12 for the tetrahedra
  /// nearest jamming. For these, a shift of 1e-6 gives wrong modes.
  double shift = 1e-11;
  /// Relative accuracy of 1/(λ − σ) for the lowest modes. The inverse iteration converges so fast that full accuracy
  /// costs little.
  double lowest_tolerance = 1e-13;
  /// Bound of the relative residual of the highest modes. The relative error of their eigenvalues is about the square
  /// of this. The highest eigenvalues are close to each other, so a higher accuracy costs much time.
  double highest_tolerance = 1e-8;
  int restarts = 300;  ///< largest number of restarts of the Krylov space
  /// Largest number of particles for the dense solver. With 500 particles, 6N = 3000, it needs 216 MB and half a
  /// minute.
  int largest_dense = 500;
};

/// Computes the lowest modes by the shift-invert Lanczos method with a shift below 0, and the highest modes by the
/// Lanczos method for D itself. Start vectors are fixed, so the same matrix gives the same bits. A set of modes is
/// computed again in three cases: if the method does not converge, if the residual shows that the factorisation was
/// inaccurate, or if modes below the shift are missing. Sylvester's inertia gives the number of modes below the shift.
/// The second attempt uses a larger subspace and a shift below the whole spectrum. The third attempt uses the dense
/// solver. Never throws.
SpectrumEnds spectrum_ends(const BlockMatrix& matrix, const ModeOptions& options = {});

/// Computes all 6N − 3 modes with the dense solver, in O(N³) time and O(N²) memory. Tests use it as a reference.
ModeSet dense_modes(const BlockMatrix& matrix);

}  // namespace isojam
