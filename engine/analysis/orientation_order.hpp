#pragma once

#include <Eigen/Core>
#include <optional>
#include <span>
#include <vector>

#include "engine/packing/energy.hpp"

namespace isojam {

/// Smallest rank l, 1..10, for which the spherical harmonics do not vanish when averaged over the solid's vertex
/// directions. It is 3 for tetrahedra, 4 (cubatic) for cubes and octahedra, 6 for dodecahedra and icosahedra, and 2
/// (nematic) for most other solids. An order parameter of lower rank does not depend on the orientation. Throws
/// std::invalid_argument if all ranks up to 10 vanish.
unsigned orientation_rank(const ConvexSolid& solid);

/// Spherical harmonics of every particle, all of the same shape, (2l + 1) × N: the components Σ_v Y_lm(v) over its
/// vertex directions in the lab frame, real harmonics, columns with norm 1. Orientations that differ by a symmetry of
/// the solid have equal columns. Products of columns are q_ij = Σ_vw P_l(v·w)/Σ_vv' P_l(v·v'): 1 if i and j are
/// aligned, 0 on average if their orientations are independent.
Eigen::MatrixXd orientation_harmonics(const Packing& packing, unsigned l);

/// S_l = |mean column|, S_l² = (1/N²) Σ_ij q_ij: 1 if all are aligned, about 1/√N if orientations are independent.
double orientation_order(const Eigen::MatrixXd& harmonics);

/// Steinhardt's Q_l of each particle's own contacts; nullopt for particles without contacts.
std::vector<std::optional<double>> local_steinhardt_order(std::span<const Contact> contacts, int particles, unsigned l);

/// Order of a packing in the directions of its contacts and in its orientations. S near jamming for N = 64 and 100:
///   tetrahedra                       0.03 to 0.05
///   octahedra                        0.14 to 0.18
///   dodecahedra and icosahedra       0.16 to 0.41
///   icosahedra with Q6 above crystalline_q6   0.41 to 0.71
struct Order {
  double Q4 = 0, Q6 = 0;                     ///< over all contacts; 0 without contacts
  std::optional<double> local_Q4, local_Q6;  ///< means over particles with contacts; nullopt without contacts
  unsigned rank = 0;                         ///< orientation_rank; 0 if particles have several shapes
  std::optional<double> S;                   ///< orientation_order of that rank; nullopt if rank is 0
  double random_S = 0;                       ///< 1/√N, the value for independent orientations
};
/// Order of a packing with its contacts (PackingEnergy::contacts).
Order order_of(const Packing& packing, std::span<const Contact> contacts);

/// Mean q_ij of pairs whose centres are k·width to (k + 1)·width apart.
struct OrientationCorrelation {
  /// Pairs at one distance.
  struct Bin {
    long pairs = 0;              ///< number of pairs in the bin
    std::optional<double> mean;  ///< nullopt without pairs
  };
  double width = 0;       ///< V_p^(1/3)
  std::vector<Bin> bins;  ///< nearest distances first
};

/// Bins of a correlation, lengths in V_p^(1/3).
struct OrientationCorrelationOptions {
  double width = 0.1;  ///< a quarter of the smallest inradius: several bins for a shell of neighbours
  /// Largest distance. The default is half the side of the cell, where images begin to repeat.
  std::optional<double> reach = std::nullopt;
};

/// Orientational pair correlation over all pairs and images within the reach, in complete bins. Throws
/// std::invalid_argument unless width and reach are positive.
OrientationCorrelation orientation_correlation(const Packing& packing, const Eigen::MatrixXd& harmonics,
                                               const OrientationCorrelationOptions& options = {});

}  // namespace isojam
