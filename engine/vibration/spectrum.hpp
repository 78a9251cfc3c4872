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
  converged,       ///< first attempt
  retried,         ///< second attempt, with another shift or a larger subspace
  dense_fallback,  ///< dense solver: the Lanczos method did not converge, or too many modes were requested for it
  failed           ///< no modes: too many particles for the dense solver, or D is not finite
};
template <>
inline constexpr std::array enum_names<ModeEnd>{
    EnumName{ModeEnd::not_called, "not_called"}, EnumName{ModeEnd::converged, "converged"},
    EnumName{ModeEnd::retried, "retried"}, EnumName{ModeEnd::dense_fallback, "dense_fallback"},
    EnumName{ModeEnd::failed, "failed"}};

/// Eigenpairs D u = λ u, λ = ω², without the three translations. Translations are null vectors in any state and are
/// projected out.
struct ModeSet {
  ModeEnd ended = ModeEnd::not_called;  ///< method that found them
  Eigen::VectorXd eigenvalues;          ///< ascending
  Eigen::MatrixXd vectors;              ///< 6N × modes, orthonormal, orthogonal to translations; coordinates as in D
  double residual = 0;                  ///< max ‖Du − λu‖ / λ_max
  /// Relative error max (‖Du − λu‖ + ε λ_max)/|λ|. By Weyl's theorem the distance to an eigenvalue of D is at most ‖Du
  /// − λu‖, and D itself has an error of ε λ_max. Infinite if some λ is 0.
  double relative_error = 0;
  int attempts = 0;  ///< attempts of the Lanczos method

  Eigen::Index size() const { return eigenvalues.size(); }  ///< number of modes
};

/// Both ends of a spectrum, eigenvalues in (Y/ρ)·V_p^(-2/3).
struct SpectrumEnds {
  ModeSet lowest, highest;  ///< without the translations
  double lambda_max = 0;    ///< largest |λ|

  bool complete() const { return lowest.size() > 0 && highest.size() > 0; }  ///< true if there are modes at both ends
};

/// Number of modes, and parameters of their computation.
struct ModeOptions {
  int lowest = 50, highest = 50;  ///< numbers of modes; all if there are fewer
  /// Shift −σ/λ_max of the first attempt. It must exceed the rounding error of the translations in the factorisation,
  /// and be below the softest modes: λ_l/λ_h ~ Δφ⁴ is 1e-12 for tetrahedra nearest to jamming. (1e-6 gives incorrect
  /// modes there.)
  double shift = 1e-11;
  /// Relative accuracy of 1/(λ − σ). The inverse iteration converges so fast that full accuracy costs little.
  double lowest_tolerance = 1e-13;
  /// Relative accuracy of the highest modes: a residual bound; the error of eigenvalues is about its square. These
  /// modes lie dense, so that higher accuracy costs time.
  double highest_tolerance = 1e-8;
  int restarts = 300;  ///< maximum number of restarts of the Krylov space
  /// Largest number of particles for the dense solver: 6N = 3000, 216 MB and half a minute.
  int largest_dense = 500;
};

/// Computes the lowest modes by shift-invert Lanczos with a shift below 0, and the highest ones by Lanczos on D itself.
/// Start vectors are fixed: the same matrix gives the same bits. A set is computed again if it does not converge, if
/// its residual indicates an inaccurate factorisation, or if it misses modes below the shift, whose number Sylvester's
/// inertia gives. The second attempt uses a larger subspace and a shift below the whole spectrum, the third the dense
/// solver. Never throws.
SpectrumEnds spectrum_ends(const BlockMatrix& matrix, const ModeOptions& options = {});

/// All 6N − 3 modes by the dense solver: the test oracle. O(N³) time, O(N²) memory.
ModeSet dense_modes(const BlockMatrix& matrix);

}  // namespace isojam
