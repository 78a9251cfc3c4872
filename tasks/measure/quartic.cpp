#include <algorithm>
#include <cmath>

#include "engine/arithmetic/elementary.hpp"
#include "engine/rigidity/floppy_motions.hpp"
#include "tasks/measure/parts.hpp"

namespace isojam {
namespace {

// How the energy grows along the motions that no contact opposes to first order.

constexpr std::string_view group = "floppy motions";
constexpr Quantity floppy{"floppy_motions", "/quartic/floppy", group, "1", "n_f"};
constexpr Quantity quartic{"quartic_motions", "/quartic/quartic", group, "1", "n_4"};
constexpr Quantity exponent{"x_floppy", "/quartic/exponent", group, "1", "x_f"};
constexpr Quantity coefficient{"c_floppy", "/quartic/coefficient", group, "Y V_p^(-1/3)", "c_4"};
constexpr std::array quantities{floppy, quartic, exponent, coefficient};

/// Amplitudes over Δφ, in V_p^(1/3): the largest motion of a particle. Each is four times the one before.
constexpr std::array ladder{.00390625, .015625, .0625, .25, 1.0};
/// The rung whose exponent and coefficient are the quantities: from it to the next.
constexpr std::size_t rung = 2;
/// An exponent nearer to 4 than to 2 or 6.
constexpr double least_quartic = 3, greatest_quartic = 5;
/// One that has hardly begun to rise from 2.
constexpr double greatest_quadratic = 2.5;
/// Dense: O(N³).
constexpr int up_to = 200;

constexpr std::string_view too_many = "packings of more than 200 particles are not looked at",
                           not_above = "the state is not above jamming", none_rises = "no motion raises the energy";

/// The element a share q of the way up the sorted list, which is not empty.
double quantile(std::vector<double> list, double q) {
  std::sort(list.begin(), list.end());
  return list[static_cast<std::size_t>(q * static_cast<double>(list.size() - 1))];
}

/// Exponents of the rise between one rung and the next, of the motions whose rise stands out from rounding.
std::vector<double> exponents(const EnergyAlong& along, std::size_t from) {
  std::vector<double> list;
  for (Eigen::Index k = 0; k < along.rise.rows(); ++k) {
    const auto at = [&](std::size_t step) { return along.rise(k, static_cast<Eigen::Index>(step)); };
    constexpr double above_noise = 10;
    if (at(from) > above_noise * along.noise && at(from + 1) > above_noise * along.noise)
      list.push_back(nearest::log(at(from + 1) / at(from)) / nearest::log(ladder[from + 1] / ladder[from]));
  }
  return list;
}

int count_quartic(const std::vector<double>& list) {
  return static_cast<int>(
      std::count_if(list.begin(), list.end(), [](double x) { return x > least_quartic && x < greatest_quartic; }));
}

/// Rises over a⁴, of the motions that rise as it does.
std::vector<double> coefficients(const EnergyAlong& along, double distance) {
  std::vector<double> list;
  const double a = ladder[rung] * distance;
  for (Eigen::Index k = 0; k < along.rise.rows(); ++k) {
    const double here = along.rise(k, rung), next = along.rise(k, rung + 1);
    if (!(here > 0 && next > 0)) continue;
    const double x = nearest::log(next / here) / nearest::log(ladder[rung + 1] / ladder[rung]);
    if (x > least_quartic && x < greatest_quartic) list.push_back(here / squared(squared(a)));
  }
  return list;
}

Json unknown(std::string_view why) {
  Json state;
  for (const auto& quantity : quantities) put(state, quantity, std::nullopt, why);
  state["quartic"]["rungs"] = Json::array();
  return state;
}

Json quartic_record(const Packing& packing, PackingEnergy& energy, double distance) {
  const auto contacts = energy.contacts(packing);
  const auto motions = floppy_motions(normal_constraints(packing, contacts), energy.hessian(packing, state_precision));
  std::vector<double> amplitudes;
  for (const double rung_at : ladder) amplitudes.push_back(rung_at * distance);
  const auto along = energy_along(packing, motions.vectors, amplitudes);
  Json state;
  put(state, floppy, motions.vectors.cols());
  Json rungs = Json::array();
  for (std::size_t k = 0; k + 1 < ladder.size(); ++k) {
    const auto list = exponents(along, k);
    Json json;
    json["from"] = ladder[k];
    json["motions"] = list.size();
    json["quadratic"] = std::count_if(list.begin(), list.end(), [](double x) { return x < greatest_quadratic; });
    json["quartic"] = count_quartic(list);
    json["steeper"] = std::count_if(list.begin(), list.end(), [](double x) { return x >= greatest_quartic; });
    for (const auto& [key, q] : {std::pair{"lower_quartile", .25}, {"median", .5}, {"upper_quartile", .75}})
      put_optional(json, key, list.empty() ? std::nullopt : std::optional(quantile(list, q)), none_rises);
    if (k == rung) {
      put(state, quartic, count_quartic(list));
      put(state, exponent, list.empty() ? std::nullopt : std::optional(quantile(list, .5)), none_rises);
    }
    rungs.push_back(std::move(json));
  }
  const auto list = coefficients(along, distance);
  put(state, coefficient, list.empty() ? std::nullopt : std::optional(quantile(list, .5)), none_rises);
  put_number(state["quartic"], "noise", along.noise);
  state["quartic"]["rungs"] = std::move(rungs);
  return state;
}

Measurement measure_quartic(const JamResult& jam, const MeasureOptions&) {
  Measurement measurement;
  PackingEnergy energy;
  for (const Packing& packing : jam.states) {
    const double distance = jam.phi_j ? packing.density() - jam.phi_j->density : 0;
    measurement.states.push_back(packing.size() > up_to ? unknown(too_many)
                                 : distance > 0         ? quartic_record(packing, energy, distance)
                                                        : unknown(not_above));
  }
  return measurement;
}

}  // namespace

const MeasureDefinition measures::quartic{.quantities = quantities, .measure = measure_quartic, .needs_minima = true};

}  // namespace isojam
