#include "tasks/extras/report/distributions.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <numbers>
#include <numeric>
#include <string>
#include <vector>

#include "engine/arithmetic/elementary.hpp"
#include "tasks/measure/shared_parts.hpp"

namespace isojam {
namespace {

using Numbers = std::vector<double>;

/// The list at a JSON pointer; empty if it is missing or is not a list of numbers.
Numbers bins_at(const Json& json, const std::string& pointer) {
  const Json::json_pointer place(pointer);
  if (!json.contains(place) || !json.at(place).is_array()) return {};
  const auto& list = json.at(place);
  const bool all = std::all_of(list.begin(), list.end(), [](const Json& value) { return value.is_number(); });
  return all ? list.get<Numbers>() : Numbers{};
}

using Summed = Distributions::Summed;

constexpr std::array classes{"face_face", "edge_face", "lower_order"};

void add_list(Summed& total, const Json& state, const std::string& edges, const std::string& values) {
  auto ends = bins_at(state, edges), list = bins_at(state, values);
  if (list.empty() || ends.size() != list.size() + 1) return;
  if (total.states++ == 0) {
    total.edges = std::move(ends);
    total.sums.assign(list.size(), 0);
  }
  total.sums.resize(std::min(total.sums.size(), list.size()));
  for (std::size_t k = 0; k < total.sums.size(); ++k) total.sums[k] += list[k];
}

/// The curve [[x, y], ...] of a sum over logarithmic bins, between the first and the last bin with values. `y` is
/// called with the sum and the edges of a bin.
Json curve_of(const Summed& total, double unit, const std::function<double(double, double, double)>& y) {
  Json curve = Json::array();
  const auto used = [](double value) { return value > 0; };
  const auto first = std::find_if(total.sums.begin(), total.sums.end(), used) - total.sums.begin();
  const auto last = total.sums.rend() - std::find_if(total.sums.rbegin(), total.sums.rend(), used);
  for (auto k = static_cast<std::size_t>(first); k < static_cast<std::size_t>(last); ++k) {
    const double low = nearest::pow(10, total.edges[k]), high = nearest::pow(10, total.edges[k + 1]);
    curve.push_back({to_digits(unit * std::sqrt(low * high), 5), to_digits(y(total.sums[k], low, high), 5)});
  }
  return curve;
}

/// Adds the angles of a state, in wider bins than those of the records and without angles below 1e-4 rad.
void add_angles(Summed& total, const std::vector<double>& counts) {
  constexpr int wide = angle_bins_per_decade / Histogram::per_decade, from = -4;
  constexpr int first = (from - angle_bins_from) * angle_bins_per_decade;
  if (total.states++ == 0) {
    total.sums.assign((angle_bins - first + wide - 1) / wide, 0);
    for (std::size_t k = 0; k <= total.sums.size(); ++k)
      total.edges.push_back(from + static_cast<double>(k) / Histogram::per_decade);
  }
  for (int k = first; k < angle_bins; ++k)
    total.sums[static_cast<std::size_t>((k - first) / wide)] += counts[static_cast<std::size_t>(k)];
}

Json angles_of(const Summed& total) {
  const double all = std::accumulate(total.sums.begin(), total.sums.end(), 0.0);
  if (!(all > 0)) return nullptr;
  const auto per_decade = [&](double count, double, double) { return count / all * Histogram::per_decade; };
  return {{"curves", {{"all", curve_of(total, 180 / std::numbers::pi, per_decade)}}}, {"states", total.states}};
}

// Exponents x of the contacts (analysis/exponents.hpp) are in bins of 0.1 that are centred on the classes.
constexpr int bins_per_unit = 10, exponents_from = -8 * bins_per_unit, exponent_bins = 11 * bins_per_unit;

}  // namespace

void Distributions::add(const Json& state, const std::optional<AngleHistogram>& angles) {
  for (std::size_t c = 0; c < classes.size(); ++c)
    add_list(forces_[c], state, "/gaps/log10_force", std::string("/gaps/") + classes[c] + "/counts");
  add_list(pairs_, state, "/gaps/r", "/gaps/g");
  add_exponents(state);
  if (!angles) return;
  add_angles(face_face_, angles->face_face);
  add_angles(edge_face_, angles->edge_face_of_others(0));
}

void Distributions::add_exponents(const Json& state) {
  const Json::json_pointer place("/exponents/x");
  if (!state.contains(place) || state.at(place).empty()) return;
  if (exponents_.states++ == 0) exponents_.sums.assign(exponent_bins, 0);
  for (const Json& x : state.at(place)) {
    ++contacts_;
    if (!x.is_number()) continue;
    const auto bin = std::lround(x.get<double>() * bins_per_unit) - exponents_from;
    if (bin >= 0 && bin < exponent_bins) ++exponents_.sums[static_cast<std::size_t>(bin)];
  }
}

Json Distributions::forces() const {
  Json json;
  double all = 0;
  for (const auto& one : forces_) all += std::accumulate(one.sums.begin(), one.sums.end(), 0.0);
  if (!(all > 0)) return nullptr;
  auto total = forces_[0];
  for (std::size_t c = 1; c < classes.size(); ++c) {
    for (std::size_t k = 0; k < std::min(total.sums.size(), forces_[c].sums.size()); ++k)
      total.sums[k] += forces_[c].sums[k];
  }
  const auto density = [&](double count, double low, double high) { return count / (all * (high - low)); };
  json["curves"]["all"] = curve_of(total, 1, density);
  for (std::size_t c = 0; c < classes.size(); ++c) json["curves"][classes[c]] = curve_of(forces_[c], 1, density);
  json["states"] = total.states;
  return json;
}

Json Distributions::pairs() const {
  if (pairs_.sums.empty()) return nullptr;
  Json curve = Json::array();
  for (std::size_t k = 0; k < pairs_.sums.size(); ++k)
    curve.push_back(
        {to_digits((pairs_.edges[k] + pairs_.edges[k + 1]) / 2, 5), to_digits(pairs_.sums[k] / pairs_.states, 5)});
  return {{"curves", {{"all", std::move(curve)}}}, {"states", pairs_.states}};
}

Json Distributions::exponents() const {
  if (exponents_.states == 0) return nullptr;
  Json curve = Json::array();
  for (int k = 0; k < exponent_bins; ++k)
    curve.push_back(
        {to_digits(static_cast<double>(k + exponents_from) / bins_per_unit, 3),
         to_digits(exponents_.sums[static_cast<std::size_t>(k)] / static_cast<double>(contacts_) * bins_per_unit, 5)});
  return {{"curves", {{"all", std::move(curve)}}}, {"states", exponents_.states}};
}

Json Distributions::json() const {
  return {{"forces", forces()},
          {"pairs", pairs()},
          {"exponents", exponents()},
          {"face_face", angles_of(face_face_)},
          {"edge_face", angles_of(edge_face_)}};
}

}  // namespace isojam
