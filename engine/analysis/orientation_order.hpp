#pragma once

#include <Eigen/Core>
#include <optional>
#include <span>
#include <vector>

#include "engine/packing/energy.hpp"

namespace isojam {

/// Rank l of the first spherical harmonics that the solid's vertex directions do not average out, 1..10: 3 for
/// tetrahedra, 4 (cubatic) for cubes and octahedra, 6 for dodecahedra and icosahedra; 2 (nematic) for most other
/// solids. No order parameter of lower rank sees these solids turn. Throws std::invalid_argument if all ranks up to 10
/// vanish.
unsigned orientation_rank(const ConvexSolid& solid);

/// Spherical harmonics of every particle, all of one shape, (2l + 1) × N: the components Σ_v Y_lm(v) over its vertex
/// directions in the lab frame, real harmonics, columns of unit norm. Particles alike but for a symmetry of the solid
/// have equal columns. Products of columns are q_ij = Σ_vw P_l(v·w)/Σ_vv' P_l(v·v'), 1 if i and j are aligned, 0 on
/// average if their orientations are independent.
Eigen::MatrixXd orientation_harmonics(const Packing& packing, unsigned l);

/// S_l = |mean column|, S_l² = (1/N²) Σ_ij q_ij: 1 if all are aligned, about 1/√N if orientations are independent.
double orientation_order(const Eigen::MatrixXd& harmonics);

/// Steinhardt's Q_l of each particle's own contacts, none for particles without.
std::vector<std::optional<double>> local_steinhardt_order(std::span<const Contact> contacts, int particles, unsigned l);

/// Order of a packing in the directions of its contacts and in its orientations. Near jamming at N = 64 and 100, S was
/// .03 to .05 for tetrahedra, .14 to .18 for octahedra, .16 to .41 for dodecahedra and icosahedra; where Q6 of
/// icosahedra was above crystalline_q6, it was .41 to .71.
struct Order {
  double Q4 = 0, Q6 = 0;                     ///< over all contacts; 0 without
  std::optional<double> local_Q4, local_Q6;  ///< means over particles with contacts; none without
  unsigned rank = 0;                         ///< orientation_rank; 0 where particles have several shapes
  std::optional<double> S;                   ///< orientation_order of that rank; none where there is none
  double random_S = 0;                       ///< 1/√N, what independent orientations give
};
/// Order of a packing with its contacts (PackingEnergy::contacts).
Order order_of(const Packing& packing, std::span<const Contact> contacts);

/// Mean q_ij of pairs whose centres are k·width to (k + 1)·width apart.
struct OrientationCorrelation {
  /// Pairs at one distance.
  struct Bin {
    long pairs = 0;              ///< in the bin
    std::optional<double> mean;  ///< none without pairs
  };
  double width = 0;       ///< V_p^(1/3)
  std::vector<Bin> bins;  ///< nearest first
};

/// Bins of a correlation, lengths in V_p^(1/3).
struct OrientationCorrelationOptions {
  double width = 0.1;  ///< a quarter of the least inradius: a shell of neighbours takes several bins
  /// Greatest distance. By default half the side of the cell, where images begin to repeat.
  std::optional<double> reach = std::nullopt;
};

/// Orientational pair correlation over all pairs and images nearer than the reach, in whole bins.
/// Throws std::invalid_argument unless width and reach are positive.
OrientationCorrelation orientation_correlation(const Packing& packing, const Eigen::MatrixXd& harmonics,
                                               const OrientationCorrelationOptions& options = {});

}  // namespace isojam
