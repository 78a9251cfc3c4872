#pragma once

#include <Eigen/Core>
#include <array>
#include <string_view>

#include "engine/names/enum_names.hpp"
#include "engine/packing/block_matrix.hpp"

namespace isojam {

/// How a set of modes was found.
enum class ModeEnd {
  not_called,
  converged,       ///< at the first attempt
  retried,         ///< with another shift or a larger subspace
  dense_fallback,  ///< Lanczos did not converge, or was asked for more modes than it serves
  failed           ///< no modes: too many particles for the dense solver, or D is not finite
};
template <>
inline constexpr std::array enum_names<ModeEnd>{
    EnumName{ModeEnd::not_called, "not_called"}, EnumName{ModeEnd::converged, "converged"},
    EnumName{ModeEnd::retried, "retried"}, EnumName{ModeEnd::dense_fallback, "dense_fallback"},
    EnumName{ModeEnd::failed, "failed"}};

/// Eigenpairs D u = λ u, λ = ω², beyond the three translations: those are null vectors in any state, known exactly, and
/// projected out.
struct ModeSet {
  ModeEnd ended = ModeEnd::not_called;  ///< how they were found
  Eigen::VectorXd eigenvalues;          ///< ascending
  Eigen::MatrixXd vectors;              ///< 6N × modes, orthonormal, no translation in them; coordinates as D
  double residual = 0;                  ///< max ‖Du − λu‖ / λ_max
  /// Relative error max (‖Du − λu‖ + ε λ_max)/|λ|: an eigenvalue of D lies no farther (Weyl), and D is no better known
  /// than to ε λ_max. Infinity if some λ is 0.
  double relative_error = 0;
  int attempts = 0;  ///< of the Lanczos method

  Eigen::Index size() const { return eigenvalues.size(); }  ///< number of modes
};

/// Both ends of a spectrum, eigenvalues in (Y/ρ)·V_p^(-2/3).
struct SpectrumEnds {
  ModeSet lowest, highest;  ///< beyond the translations
  double lambda_max = 0;    ///< greatest |λ|

  bool complete() const { return lowest.size() > 0 && highest.size() > 0; }  ///< whether there are modes at both ends
};

/// How many modes, and how they are sought.
struct ModeOptions {
  int lowest = 50, highest = 50;  ///< modes wanted, all if there are fewer
  /// Shift −σ/λ_max of the first attempt. Above what rounding leaves of the translations in the factorisation, and
  /// below the softest modes: λ_l/λ_h ~ Δφ⁴ is 1e-12 for tetrahedra nearest jamming. (1e-6 gives wrong modes there.)
  double shift = 1e-11;
  /// Relative accuracy of 1/(λ − σ); the inverse converges so fast that it may as well be all there is.
  double lowest_tolerance = 1e-13;
  /// Relative accuracy of the highest: the bound, eigenvalues are as good as its square. They lie dense, more costs
  /// time.
  double highest_tolerance = 1e-8;
  int restarts = 300;  ///< of the Krylov space, at most
  /// Particles up to which the dense solver takes over: 6N = 3000, 216 MB and half a minute.
  int largest_dense = 500;
};

/// Finds the lowest modes by shift-invert Lanczos, shift below 0, and the highest by Lanczos on D itself. Start vectors
/// are fixed: the same matrix gives the same bits. A set that does not converge, or whose residual shows that a
/// factorisation went wrong, or that misses modes below the shift (Sylvester's inertia says how many there are), is
/// tried again, with a larger subspace and a shift below all of the spectrum, and then densely. Never throws.
SpectrumEnds spectrum_ends(const BlockMatrix& matrix, const ModeOptions& options = {});

/// All 6N − 3 modes by the dense solver: the oracle. O(N³) time, O(N²) memory.
ModeSet dense_modes(const BlockMatrix& matrix);

}  // namespace isojam
