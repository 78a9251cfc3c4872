#include "engine/packing/energy.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "engine/packing/strain_border.hpp"

namespace isojam {

namespace {

/// Sums over contacts from which the residual, residual_floor and energy_noise are computed.
struct Accumulator {
  double force = 0;
  std::vector<double> stiffness;  ///< per particle, Σ ½ |∇V|² over its contacts
  std::vector<double> noise;      ///< per particle, Σ ρ_c |F_c|, see Evaluation::residual_floor
  double energy_noise = 0;        ///< Σ ρ_c V²/2
};

/// Adds the contributions of a pair to the energy, its derivatives and their rounding errors.
void add_pair(const NeighbourPair& pair, const ContactTerms& terms, Evaluation& sum, Accumulator& sums) {
  sum.gradient.segment<3>(6 * pair.a) += terms.dx;
  sum.gradient.segment<3>(6 * pair.a + 3) += terms.dtheta_a;
  sum.gradient.segment<3>(6 * pair.b) -= terms.dx;
  sum.gradient.segment<3>(6 * pair.b + 3) += terms.dtheta_b;
  sum.energy += terms.energy;
  sum.stress -= terms.stress;
  sums.noise[pair.a] += terms.error * terms.force;
  sums.noise[pair.b] += terms.error * terms.force;
  sums.energy_noise += 2 * terms.error * std::abs(terms.energy);
}

void add_contact(const NeighbourPair& pair, const ContactTerms& terms, Evaluation& sum, Accumulator& sums) {
  add_pair(pair, terms, sum, sums);
  sums.force += terms.force;
  sums.stiffness[pair.a] += terms.stiffness_a;
  sums.stiffness[pair.b] += terms.stiffness_b;
  ++sum.contacts;
}

/// Sets residual_floor and energy_noise; requires mean_force > 0.
void bound_rounding(const Packing& packing, Precision precision, const Accumulator& sums, Evaluation& result) {
  if (precision == Precision::double_double) {
    const double levers = packing.solids.greatest_lever_arm();
    result.residual_floor = levers * *std::max_element(sums.noise.begin(), sums.noise.end()) / result.mean_force;
    result.energy_noise = sums.energy_noise;
    return;
  }
  // The largest eigenvalue of Σ ½ ∇V ∇Vᵀ is at most twice the largest trace of a diagonal block of this matrix.
  const double lambda = 2 * *std::max_element(sums.stiffness.begin(), sums.stiffness.end());
  const double ulp = std::numeric_limits<double>::epsilon() * packing.cell.side();
  result.residual_floor = lambda * ulp / result.mean_force;
  result.energy_noise = sums.force * ulp;
}

bool is_finite(const Packing& packing) {
  return std::all_of(packing.poses.begin(), packing.poses.end(), [](const Pose& pose) {
    return pose.position.allFinite() && pose.orientation.coeffs().allFinite() && pose.position_low.allFinite() &&
           pose.orientation_low.allFinite();
  });
}

/// Calls visit(k, now, closed) for every pair k of the neighbour list that is in one of the two lists, in the order of
/// k. `now` and `closed` are the overlaps of the pair in these lists, or null.
template <class Visit>
void for_each_of_either(const TouchingPairs& now, const TouchingPairs& closed, const Visit& visit) {
  for (std::size_t block = 0; block < now.blocks.size(); ++block) {
    auto at = now.blocks[block].begin();
    const auto end = now.blocks[block].end();
    if (!closed.blocks.empty()) {
      for (const PairOverlap& then : closed.blocks[block]) {
        for (; at != end && at->pair < then.pair; ++at) visit(at->pair, &at->overlap, nullptr);
        const bool both = at != end && at->pair == then.pair;
        visit(then.pair, both ? &at->overlap : nullptr, &then.overlap);
        if (both) ++at;
      }
    }
    for (; at != end; ++at) visit(at->pair, &at->overlap, nullptr);
  }
}

GyrationRadii radii_of(const Packing& packing, const NeighbourPair& pair) {
  return {packing.solids[pair.a].gyration_radius(), packing.solids[pair.b].gyration_radius()};
}

double largest_imbalance(const Eigen::VectorXd& gradient) {
  double largest = 0;
  for (Eigen::Index k = 0; k < gradient.size(); k += 3) largest = std::max(largest, gradient.segment<3>(k).norm());
  return largest;
}

}  // namespace

double deviator_of(const Evaluation& evaluation) {
  const double scale = evaluation.repulsive_pressure.value_or(evaluation.pressure);
  if (!(scale > 0)) return 0;
  const Eigen::Matrix3d excess = evaluation.stress + evaluation.pressure * Eigen::Matrix3d::Identity();
  return excess.cwiseAbs().maxCoeff() / scale;
}

bool PackingEnergy::accepts(const Packing& packing) {
  return is_legal(packing.cell, cohesion_ ? cohesion_->grown_solids(packing).widest() : packing.solids.widest());
}

Evaluation PackingEnergy::evaluate(const Packing& packing, Precision precision) {
  ++evaluations_;
  Evaluation result;
  if (!is_finite(packing)) {
    // Comparisons with NaN would classify every pair as separated.
    result.energy = std::numeric_limits<double>::quiet_NaN();
    result.gradient = Eigen::VectorXd::Constant(6 * packing.size(), result.energy);
    return result;
  }
  overlaps_.forget();  // so that every call computes and counts, even for a repeated state
  overlaps_.update(packing, precision, totals_);
  result.gradient = Eigen::VectorXd::Zero(6 * packing.size());
  const std::vector<double> zeros(packing.poses.size(), 0.0);
  Accumulator sums{0, zeros, zeros};
  // The terms of the pairs are computed in parallel. They are added serially, because the order of additions determines
  // their rounding.
  set_terms(packing, precision, overlaps_.pairs(), overlaps_.touching(), {}, terms_);
  for (const auto& block : terms_.blocks) {
    for (const PairTerms::Entry& at : block) add_contact(at.pair, at.terms, result, sums);
  }
  if (cohesion_) {
    result.repulsive_pressure = -(result.stress / packing.cell.volume()).trace() / 3;
    for (const auto& block : cohesion_->evaluate(packing, precision, totals_).blocks) {
      for (const PairTerms::Entry& at : block) add_pair(at.pair, at.terms, result, sums);
    }
  }
  result.stress /= packing.cell.volume();
  result.pressure = -result.stress.trace() / 3;
  const double imbalance = largest_imbalance(result.gradient);
  if (result.contacts > 0) result.mean_force = sums.force / static_cast<double>(result.contacts);
  if (imbalance > 0)
    result.residual = result.mean_force > 0 ? imbalance / result.mean_force : std::numeric_limits<double>::infinity();
  if (result.mean_force > 0) bound_rounding(packing, precision, sums, result);
  return result;
}

SecondOrder PackingEnergy::second_order(const Packing& packing, double probe_distance, Precision precision,
                                        CellFreedom cell) {
  overlaps_.update(packing, precision, totals_);  // usually of a state that has just been evaluated
  const std::vector<NeighbourPair>& pairs = overlaps_.pairs();
  const std::vector<PairHessian> hessians = overlaps_.hessians(packing);
  TouchingPairs closed;
  if (probe_distance > 0) closed = overlaps_.probe(packing, probe_distance);
  SecondOrder result;
  result.hessian.diagonal.assign(packing.poses.size(), Matrix6d::Zero());
  const StrainBasis strains = strain_basis(cell) / strain_length(packing.size());
  StrainBorder border(cell, packing.size(), result.hessian);
  std::size_t next = 0;
  for_each_of_either(overlaps_.touching(), closed, [&](std::size_t k, const Overlap* now, const Overlap* then) {
    const NeighbourPair& pair = pairs[k];
    const Eigen::Vector3d r = displacement(packing, pair);
    result.pairs.push_back(incipient_contact(pair.a, pair.b, now ? *now : Overlap{}, then ? *then : Overlap{}, r,
                                             probe_distance, radii_of(packing, pair), strains));
    if (!now) return;
    const PairHessian& h = hessians[next++];
    result.hessian.add_pair(pair.a, pair.b, h.aa, h.ab, h.bb);
    border.add_pair(pair.a, pair.b, h, -now->volume / 2 * now->area, r);
  });
  border.finish();
  if (cohesion_) result.hessian += cohesion_->hessian(packing, precision, cell, totals_);
  return result;
}

BlockMatrix PackingEnergy::hessian(const Packing& packing, Precision precision) {
  return second_order(packing, 0, precision).hessian;
}

std::vector<Contact> PackingEnergy::contacts(const Packing& packing, Precision precision) {
  overlaps_.update(packing, precision, totals_);
  std::vector<Contact> result;
  for (const auto& block : overlaps_.touching().blocks) {
    for (const PairOverlap& at : block) {
      const NeighbourPair& pair = overlaps_.pairs()[at.pair];
      const Eigen::Vector3d d = displacement(packing, pair);
      const Eigen::Quaterniond &a = packing.poses[pair.a].orientation, &b = packing.poses[pair.b].orientation;
      Contact contact{pair, d, relative_pose(a, b, d), at.overlap};
      contact.overlap.area = a.conjugate() * at.overlap.area;
      contact.overlap.moment = a.conjugate() * at.overlap.moment;
      result.push_back(contact);
    }
  }
  return result;
}

}  // namespace isojam
