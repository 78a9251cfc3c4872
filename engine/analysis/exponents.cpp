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

/// d ln E/dφ of an equilibrium.
double slope_of(const Packing& packing, const Evaluation& here) {
  const double density = packing.density();
  return packing.size() * here.pressure / (density * density * here.energy);
}

/// True if the packing loses no energy in the step, so that both states are on one solution branch. On a branch, the
/// change of ln E is the integral of d ln E/dφ. With E ~ Δφ⁶, the trapezoidal rule has the error −s³ for the relative
/// change s of Δφ; ten times as much is allowed. A rearrangement releases more, also if it changes no contact.
bool is_reversible(const Packing& from, const Evaluation& before, const Packing& to, const Evaluation& after,
                   double step) {
  const double mean_slope = (slope_of(from, before) + slope_of(to, after)) / 2;
  const double expected = mean_slope * (to.density() - from.density());
  return std::abs(log_ratio(after.energy, before.energy) - expected) <= 10 * std::abs(step * step * step);
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
  const double distance = best.distance = 6 / slope_of(packing, here);
  for (int k = 0; k < options.lengths; ++k) {
    const double length = std::ldexp(options.longest_step, -k);
    for (const double step : {-length, length}) {
      Packing next = packing;
      const double density = packing.density() + step * distance;
      if (!is_equilibrium(follow_equilibrium(next, density, distance, energy, options.minimise))) continue;
      if (!is_reversible(packing, here, next, energy.evaluate(next, Precision::double_double), step)) continue;
      best = compare(contacts, energy.contacts(next));
      best.step = step;
      best.distance = distance;
      if (best.broken == 0 && best.formed == 0) return best;
    }
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
