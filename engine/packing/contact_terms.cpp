#include "engine/packing/contact_terms.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

#include "engine/geometry/overlap/small_distances.hpp"
#include "engine/parallel/parallel.hpp"

namespace isojam {

namespace {

/// The relative error ρ_c, see Evaluation::residual_floor.
double relative_error(const ConvexSolid& a, const ConvexSolid& b, const Eigen::Vector3d& r, const Overlap& overlap) {
  const double tolerance = gap_tolerance(a, b, r), area = overlap.area.norm();
  return tolerance / std::max(double_double_below(a, b), overlap.volume / area) + tolerance / std::sqrt(area);
}

/// ∂e/∂x_A = (de/dV) S_A, ∂e/∂θ_A = (de/dV) M_A.
ContactTerms contact_terms(const Packing& packing, Precision precision, const NeighbourPair& pair,
                           const Overlap& overlap, const PairLaw& law) {
  const double v = overlap.volume, slope = 2 * law.quadratic * v + law.linear;
  ContactTerms terms;
  const Eigen::Vector3d r = displacement(packing, pair);
  const ConvexSolid &a = packing.solids[pair.a], &b = packing.solids[pair.b];
  const double radius_a = a.gyration_radius(), radius_b = b.gyration_radius();
  const Eigen::Vector3d dtheta = slope * overlap.moment;
  terms.dx = slope * overlap.area;
  terms.dtheta_a = dtheta / radius_a;
  terms.dtheta_b = (r.cross(terms.dx) - dtheta) / radius_b;
  terms.stress = terms.dx * r.transpose();
  terms.energy = law.quadratic * v * v + law.linear * v;
  terms.force = terms.dx.norm();
  const double square = overlap.area.squaredNorm();
  const Eigen::Vector3d moment_b = r.cross(overlap.area) - overlap.moment;
  terms.stiffness_a = (square + overlap.moment.squaredNorm() / (radius_a * radius_a)) / 2;
  terms.stiffness_b = (square + moment_b.squaredNorm() / (radius_b * radius_b)) / 2;
  if (precision == Precision::double_double) terms.error = relative_error(a, b, r, overlap);
  return terms;
}

}  // namespace

void set_terms(const Packing& packing, Precision precision, std::span<const NeighbourPair> pairs,
               const TouchingPairs& touching, const PairLaw& law, PairTerms& terms) {
  terms.blocks.resize(touching.blocks.size());
  for_each_index(terms.blocks.size(), [&](std::size_t block) {
    terms.blocks[block].clear();
    for (const PairOverlap& at : touching.blocks[block])
      terms.blocks[block].push_back(
          {pairs[at.pair], contact_terms(packing, precision, pairs[at.pair], at.overlap, law)});
  });
}

}  // namespace isojam
