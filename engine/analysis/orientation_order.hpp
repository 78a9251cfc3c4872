#pragma once

#include <Eigen/Core>
#include <optional>
#include <span>
#include <vector>

#include "engine/packing/energy.hpp"

namespace isojam {

/// The smallest rank l from 1 to 10 for which the mean of the spherical harmonics over the vertex directions of the
/// solid does not vanish. The rank is 3 for tetrahedra, 4 (cubatic) for cubes and octahedra, and 6 for dodecahedra and
/// icosahedra. For most other solids it is 2 (nematic). Order parameters of lower rank do not depend on the
/// orientations of the particles. Throws std::invalid_argument if the mean vanishes for all ranks up to 10.
unsigned orientation_rank(const ConvexSolid& solid);

/// Spherical harmonics of all particles, a matrix with (2l + 1) × N entries. All particles must have the same shape.
/// The column of a particle has the components Σ_v Y_lm(v), scaled so that the column has the norm 1. The sum is over
/// the directions v of all vertices of the particle, in the lab frame. Y_lm are real spherical harmonics. Orientations
/// that differ by a symmetry of the solid have equal columns. The product of the columns of two particles i and j is
///   q_ij = Σ_vw P_l(v·w) / Σ_vv' P_l(v·v'),
/// where v and v' are vertex directions of i, w are those of j, and P_l is the Legendre polynomial. q_ij is 1 if the
/// particles are aligned, and 0 on average if their orientations are independent.
Eigen::MatrixXd orientation_harmonics(const Packing& packing, unsigned l);

/// Orientational order S_l, computed from orientation_harmonics(). S_l is the norm of the mean column, S_l² = (1/N²)
/// Σ_ij q_ij. S_l is 1 if all particles are aligned, and about 1/√N if their orientations are independent.
double orientation_order(const Eigen::MatrixXd& harmonics);

/// Local orientational order: the mean q_ij of the pairs of touching particles; nullopt without contacts. It is 1 in a
/// crystal of aligned particles, and almost 1 in a packing of several large crystallites, whose S_l is small. For
/// independent orientations, q_ij has the mean 0 and the variance 1/(2l + 1).
std::optional<double> local_orientation_order(std::span<const Contact> contacts, const Eigen::MatrixXd& harmonics);

/// Steinhardt's Q_l of each particle, computed from the contacts of this particle only; nullopt if it has no contacts.
std::vector<std::optional<double>> local_steinhardt_order(std::span<const Contact> contacts, int particles, unsigned l);

/// Order of a packing: Q of the directions of its contacts, and S of the orientations of its particles. Typical values
/// of S near jamming, for N = 64 and 100:
///   tetrahedra                                0.03 to 0.05
///   octahedra                                 0.14 to 0.18
///   dodecahedra and icosahedra, Q6 ≤ 0.32     0.16 to 0.41
///   icosahedra, Q6 > 0.32 (crystalline)       0.41 to 0.71
struct Order {
  double Q4 = 0, Q6 = 0;  ///< Steinhardt's Q4 and Q6 of all contacts; 0 without contacts
  /// means of the local Q4 and Q6 of all particles with contacts; nullopt without contacts
  std::optional<double> local_Q4, local_Q6;
  unsigned rank = 0;              ///< rank l of S, see orientation_rank(); 0 if particles have several shapes
  std::optional<double> S;        ///< orientational order S_l; nullopt if the rank is 0
  double random_S = 0;            ///< 1/√N, the order of magnitude of S for independent orientations
  std::optional<double> local_S;  ///< local orientational order; nullopt if the rank is 0 or without contacts
  /// 1/√((2l + 1)n) with n contacts, the order of magnitude of local_S for independent orientations; 0 without local_S
  double random_local_S = 0;
};

/// Values of S and local_S above which a packing is called crystalline. They depend on the rank l, and therefore on the
/// symmetry of the solid. docs/results.md describes the packings with which they were chosen.
struct OrderLimits {
  double S = 0, local_S = 0;
};
OrderLimits order_limits(unsigned rank);
/// True if local_S is above its limit, or if S is above its limit and above 3.5 random_S.
bool is_aligned(const Order& order);
/// Computes the order of a packing from all its contacts (PackingEnergy::contacts()).
Order order_of(const Packing& packing, std::span<const Contact> contacts);

/// Mean q_ij of pairs of particles as a function of the distance between their centres. Bin k contains the distances
/// from k·width to (k + 1)·width.
struct OrientationCorrelation {
  /// The pairs of one bin.
  struct Bin {
    long pairs = 0;              ///< number of pairs in the bin
    std::optional<double> mean;  ///< mean q_ij of these pairs; nullopt if there are none
  };
  double width = 0;       ///< width of a bin, in units of V_p^(1/3)
  std::vector<Bin> bins;  ///< bins in the order of increasing distance
};

/// Options of orientation_correlation(). Lengths are in units of V_p^(1/3).
struct OrientationCorrelationOptions {
  /// width of a bin; the default is about a quarter of the inradius of a tetrahedron, so that a shell of neighbours has
  /// several bins
  double width = 0.1;
  /// Largest distance. The default is half of the smallest height of the cell, because at larger distances several
  /// images of a particle are counted.
  std::optional<double> reach = std::nullopt;
};

/// Computes the correlation from all pairs of particles, including periodic images. The number of bins is
/// ⌊reach/width⌋, but at least 1. Pairs whose distance is beyond the last bin are not used. Throws
/// std::invalid_argument unless `width` and `reach` are positive.
OrientationCorrelation orientation_correlation(const Packing& packing, const Eigen::MatrixXd& harmonics,
                                               const OrientationCorrelationOptions& options = {});

}  // namespace isojam
