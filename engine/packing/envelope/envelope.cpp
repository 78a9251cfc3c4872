#include "engine/packing/envelope/envelope.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <memory>
#include <utility>

#include "engine/packing/pair_search.hpp"
#include "engine/packing/strain_border.hpp"
#include "engine/parallel/parallel.hpp"

namespace isojam {

namespace {

std::shared_ptr<const ProximalContact> kept(ProximalContact contact) {
  return std::make_shared<const ProximalContact>(std::move(contact));
}

/// The multiplier of each pair of the neighbour list, or null if `forces` does not contain the pair.
std::vector<const ContactMultiplier*> by_pair(const std::vector<NeighbourPair>& pairs,
                                              std::span<const ContactMultiplier> forces) {
  std::vector<const ContactMultiplier*> found;
  found.reserve(pairs.size());
  PairSearch search(forces, &ContactMultiplier::pair);
  for (const NeighbourPair& pair : pairs) found.push_back(search.find(pair));
  return found;
}

void add(const EnvelopeContact& contact, EnvelopeEvaluation& sum) {
  const ProximalContact& at = *contact.at;
  sum.value += at.value;
  sum.noise += std::numeric_limits<double>::epsilon() *
               (at.energy + std::abs(at.shift.dot(contact.multiplier)) + std::abs(at.shift.dot(at.wrench)));
  sum.gradient.segment<6>(6 * contact.pair.a) += at.gradient_a;
  sum.gradient.segment<6>(6 * contact.pair.b) += at.gradient_b;
  sum.virial += at.gradient_b.head<3>() * contact.displacement.transpose();
  sum.multiplier_error = std::max(sum.multiplier_error, (at.wrench - contact.multiplier).norm());
  if (!at.touching) return;
  sum.mean_force += at.wrench.head<3>().norm();
  ++sum.touching;
}

/// The sum over all pairs that touch or have a multiplier. Other pairs are dropped.
EnvelopeEvaluation summed(std::vector<EnvelopeContact> contacts, int particles) {
  EnvelopeEvaluation sum;
  sum.gradient = Eigen::VectorXd::Zero(6 * particles);
  for (const EnvelopeContact& contact : contacts) sum.overlaps += contact.at->iterations;
  std::erase_if(contacts,
                [](const EnvelopeContact& contact) { return !contact.at->touching && contact.multiplier.isZero(0); });
  for (const EnvelopeContact& contact : contacts) add(contact, sum);
  if (sum.touching > 0) sum.mean_force /= static_cast<double>(sum.touching);
  sum.contacts = std::move(contacts);
  return sum;
}

}  // namespace

/// Updates placed_ for the particles that have moved.
void EnvelopeEnergy::place(const Packing& packing) {
  list_.refresh(packing);
  const std::size_t n = packing.poses.size();
  const bool same = placed_.size() == n && solids_ == packing.solids;
  make_room(packing, Precision::double_double, placed_);
  solids_ = packing.solids;
  poses_.resize(n);
  for_each_small(n, [&](std::size_t k) {
    if (same && poses_[k] == packing.poses[k]) return;
    placed_.place(k, rotation_matrix(packing.poses[k]));
    poses_[k] = packing.poses[k];
  });
}

/// Indices of the pairs of the neighbour list that touch or have an element in `forces`. If `only` is not empty, pairs
/// without a flagged particle are skipped.
std::vector<std::size_t> EnvelopeEnergy::near_pairs(const Packing& packing,
                                                    const std::vector<const ContactMultiplier*>& force_of,
                                                    std::span<const char> only) {
  const std::vector<NeighbourPair>& pairs = list_.pairs();
  std::vector<char> near(pairs.size(), 0);
  for_each_small(pairs.size(), [&](std::size_t k) {
    const NeighbourPair& pair = pairs[k];
    if (!only.empty() && !only[pair.a] && !only[pair.b]) return;
    near[k] = force_of[k] != nullptr || overlap_listed(packing, placed_, pair, list_.axes()[k]).touching();
  });
  std::vector<std::size_t> found;
  for (std::size_t k = 0; k < near.size(); ++k) {
    if (near[k]) found.push_back(k);
  }
  return found;
}

template <class Find>
EnvelopeEvaluation EnvelopeEnergy::evaluate_pairs(const Packing& packing, const std::vector<std::size_t>& near,
                                                  const Find& find) {
  std::vector<EnvelopeContact> contacts(near.size());
  for_each_small(near.size(), [&](std::size_t slot) {
    EnvelopeContact& out = contacts[slot];
    out.pair = list_.pairs()[near[slot]];
    const DoubleDoubleVector r = displacement_double_double(packing, out.pair);
    out.displacement = r.high;
    find(slot, r, out);
  });
  return summed(std::move(contacts), packing.size());
}

EnvelopeEvaluation EnvelopeEnergy::evaluate(const Packing& packing, std::span<const ContactMultiplier> forces,
                                            const EnvelopeTerms& terms, std::span<const char> only) {
  place(packing);
  const std::vector<const ContactMultiplier*> force_of = by_pair(list_.pairs(), forces);
  const std::vector<std::size_t> near = near_pairs(packing, force_of, only);
  return evaluate_pairs(packing, near, [&](std::size_t slot, const DoubleDoubleVector& r, EnvelopeContact& out) {
    Vector6d start = Vector6d::Zero();
    if (const ContactMultiplier* force = force_of[near[slot]]) {
      if (force->plain) {
        out.at = kept(plain_contact(placed_[out.pair.a], placed_[out.pair.b], packing.poses[out.pair.b], r));
        out.multiplier = out.at->wrench;
        return;
      }
      out.multiplier = force->multiplier, start = force->shift;
    }
    out.at = kept(proximal_contact(placed_[out.pair.a], packing.solids[out.pair.b], packing.poses[out.pair.b], r,
                                   {out.multiplier, terms.stiffness, terms.series_below}, start));
  });
}

EnvelopeEvaluation EnvelopeEnergy::unshifted(const Packing& packing, double stiffness) {
  place(packing);
  const std::vector<const ContactMultiplier*> none(list_.pairs().size(), nullptr);
  return evaluate_pairs(packing, near_pairs(packing, none, {}),
                        [&](std::size_t, const DoubleDoubleVector& r, EnvelopeContact& out) {
                          out.at = kept(unshifted_contact(placed_[out.pair.a], packing.solids[out.pair.b],
                                                          packing.poses[out.pair.b], r, stiffness));
                          out.multiplier = out.at->wrench;
                        });
}

EnvelopeEvaluation part_of(const EnvelopeEvaluation& whole, std::span<const char> only) {
  std::vector<EnvelopeContact> contacts;
  for (const EnvelopeContact& contact : whole.contacts) {
    if (only[contact.pair.a] || only[contact.pair.b]) contacts.push_back(contact);
  }
  return summed(std::move(contacts), static_cast<int>(only.size()));
}

EnvelopeEvaluation with_part(const EnvelopeEvaluation& before, const EnvelopeEvaluation& part,
                             std::span<const char> only) {
  std::vector<EnvelopeContact> contacts;
  contacts.reserve(before.contacts.size() + part.contacts.size());
  for (const EnvelopeContact& contact : before.contacts) {
    if (!only[contact.pair.a] && !only[contact.pair.b]) contacts.push_back(contact);
  }
  const auto middle = contacts.insert(contacts.end(), part.contacts.begin(), part.contacts.end());
  std::inplace_merge(contacts.begin(), middle, contacts.end(), [](const auto& one, const auto& other) {
    return canonical_key(one.pair) < canonical_key(other.pair);
  });
  return summed(std::move(contacts), static_cast<int>(only.size()));
}

BlockMatrix curvature(const EnvelopeEvaluation& evaluation, int particles, CellFreedom cell) {
  std::vector<PairHessian> terms(evaluation.contacts.size());
  for_each_small(terms.size(), [&](std::size_t k) { terms[k] = evaluation.contacts[k].at->curvature(); });
  BlockMatrix sum;
  sum.diagonal.assign(static_cast<std::size_t>(particles), Matrix6d::Zero());
  StrainBorder border(cell, particles, sum);
  for (std::size_t k = 0; k < terms.size(); ++k) {
    const EnvelopeContact& contact = evaluation.contacts[k];
    if (!contact.at->touching) continue;
    sum.add_pair(contact.pair.a, contact.pair.b, terms[k].aa, terms[k].ab, terms[k].bb);
    border.add_pair(contact.pair.a, contact.pair.b, terms[k], contact.at->gradient_b.head<3>(), contact.displacement);
  }
  border.finish();
  return sum;
}

std::vector<ContactMultiplier> forces_of(const EnvelopeEvaluation& evaluation) {
  std::vector<ContactMultiplier> forces;
  forces.reserve(evaluation.contacts.size());
  for (const EnvelopeContact& contact : evaluation.contacts)
    forces.push_back({contact.pair, contact.multiplier, contact.at->shift, contact.at->plain});
  return forces;
}

void mark_soft(const EnvelopeEvaluation& evaluation, double limit, std::vector<ContactMultiplier>& forces) {
  for (std::size_t k = 0; k < forces.size(); ++k) {
    const ProximalContact& at = *evaluation.contacts[k].at;
    forces[k].plain = at.touching && std::max(at.ghost.aa.norm(), at.ghost.bb.norm()) < limit;
  }
}

}  // namespace isojam
