#include "engine/analysis/exponents.hpp"

#include <cassert>
#include <cmath>

#include "engine/arithmetic/elementary.hpp"
#include "engine/solve/multipliers/multipliers.hpp"

namespace isojam {
namespace {

/// If the force of a contact grows by less than this share of the growth of the mean force, its own logarithm is no
/// clock for the contact.
constexpr double own_clock = 0.3;

double log_ratio(double to, double from) { return nearest::log(to / from); }

double force_of(const Overlap& overlap) { return overlap.volume * overlap.area.norm() / 2; }

double mean_force(std::span<const Contact> contacts) {
  double sum = 0;
  for (const Contact& contact : contacts) sum += force_of(contact.overlap);
  return sum / static_cast<double>(contacts.size());
}

/// φ − φ_J of an equilibrium, 6E/(dE/dφ) as in distance_to_jamming().
double distance_of(const Packing& packing, const Evaluation& here) {
  const double density = packing.density();
  return 6 * here.energy / packing.size() * density * density / here.pressure;
}

/// The result of the step from `before` to `after`. Both lists are sorted by canonical_key().
ContactExponents compare(std::span<const Contact> before, std::span<const Contact> after) {
  ContactExponents result;
  result.x.resize(before.size());
  const double mean_change = log_ratio(mean_force(after), mean_force(before));
  std::size_t k = 0;
  for (std::size_t c = 0; c < before.size(); ++c) {
    const auto key = canonical_key(before[c].pair);
    for (; k < after.size() && canonical_key(after[k].pair) < key; ++k) ++result.formed;
    if (k < after.size() && canonical_key(after[k].pair) == key) {
      result.x[c] = contact_exponent(before[c].overlap, after[k++].overlap, mean_change);
    } else {
      ++result.broken;
    }
  }
  result.formed += static_cast<int>(after.size() - k);
  return result;
}

}  // namespace

double contact_exponent(const Overlap& from, const Overlap& to, double mean_change) {
  const double own_change = log_ratio(force_of(to), force_of(from));
  const double change = own_change / mean_change < own_clock ? mean_change : own_change;
  const double area_change = log_ratio(to.area.squaredNorm(), from.area.squaredNorm());
  return 5 * (area_change - log_ratio(to.volume, from.volume)) / change;
}

ContactExponents contact_exponents(const Packing& packing, std::span<const Contact> contacts, PackingEnergy& energy,
                                   const ExponentOptions& options) {
  ContactExponents best;
  best.x.resize(contacts.size());
  const Evaluation here = energy.evaluate(packing, Precision::double_double);
  if (!(here.pressure > 0)) return best;
  const double distance = distance_of(packing, here);
  double step = options.longest_step;
  for (int attempt = 1; attempt <= options.most_attempts; ++attempt, step /= 2) {
    best.attempts = attempt;
    Packing next = packing;
    const auto summary =
        follow_equilibrium(next, packing.density() - step * distance, distance, energy, options.minimise);
    if (!is_equilibrium(summary)) continue;
    const auto after = energy.contacts(next);
    if (after.empty()) continue;
    best = compare(contacts, after);
    best.step = step;
    best.attempts = attempt;
    if (best.broken == 0 && best.formed == 0) break;
  }
  return best;
}

std::vector<ContactClass> classes_of(const ContactExponents& exponents, std::span<const Alignment> alignments,
                                     const ExponentBoundaries& boundaries) {
  assert(exponents.x.size() == alignments.size());
  std::vector<ContactClass> classes(alignments.size(), ContactClass::lower_order);
  for (std::size_t c = 0; c < classes.size(); ++c) {
    const auto& x = exponents.x[c];
    const auto& features = alignments[c];
    if (!x || !(*x < boundaries.edge_face)) continue;
    if (*x < boundaries.face_face && features.face_a >= 0 && features.face_b >= 0) {
      classes[c] = ContactClass::face_face;
    } else if (features.edge >= 0) {
      classes[c] = ContactClass::edge_face;
    }
  }
  return classes;
}

}  // namespace isojam
