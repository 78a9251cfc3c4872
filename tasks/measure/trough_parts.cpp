#include "tasks/measure/trough_parts.hpp"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <vector>

namespace isojam {
namespace {

/// In records, bins are numbered from log10 θ = 0: bin k begins at log10 θ = k/20.
constexpr int zero = -angle_bins_from * angle_bins_per_decade;

/// The numbers from the first to the last bin that is not empty.
Json counts_record(const std::vector<double>& counts) {
  const auto is_occupied = [](double count) { return count > 0; };
  const auto first = std::find_if(counts.begin(), counts.end(), is_occupied);
  const auto last = std::find_if(counts.rbegin(), std::make_reverse_iterator(first), is_occupied).base();
  Json json;
  json["first"] = first - counts.begin() - zero;
  json["counts"] = Json::array();
  for (auto count = first; count < last; ++count) json["counts"].push_back(std::lround(*count));
  return json;
}

Json histogram_record(const AngleHistogram& histogram) {
  Json json;
  json["width"] = 1.0 / angle_bins_per_decade;
  json["face_face"] = counts_record(histogram.face_face);
  json["edge_face"] = counts_record(histogram.edge_face_of_others(0));
  json["face_face_end"] = histogram.face_face_window - zero;
  json["edge_face_end"] = histogram.edge_face_window - zero;
  json["cells"] = Json::array();
  for (const auto& cell : histogram.cells) {
    for (const long number : {long{cell.face_face - zero}, long{cell.edge_face - zero}, std::lround(cell.contacts)})
      json["cells"].push_back(number);
  }
  return json;
}

/// An integer in a list. Tables read millions of them. A place contains texts for messages, so it is made only for a
/// value that is not accepted.
int integer_at(const JsonPlace& list, std::size_t index, const Range& range) {
  const Json& value = list.value()[index];
  if (value.is_number_integer() && range.contains(value.get<double>())) return value.get<int>();
  return static_cast<int>(list.at(index).integer(range));
}

constexpr Range bins{-zero, angle_bins - 1 - zero}, ends{-zero, angle_bins - zero}, numbers{0, 1e9};

void read_counts(const JsonPlace& place, std::vector<double>& counts) {
  const auto list = place.at("counts");
  const auto size = list.expect_list("a list of numbers of contacts");
  const auto first = static_cast<std::size_t>(place.at("first").integer(ends) + zero);
  if (first + size > counts.size()) list.refuse("the list has more bins than angles up to π need");
  for (std::size_t k = 0; k < size; ++k) counts[first + k] = integer_at(list, k, numbers);
}

void read_cells(const JsonPlace& list, AngleHistogram& histogram) {
  constexpr std::size_t parts = 3;
  const auto size = list.expect_list("a list of bins and numbers");
  if (size % parts != 0) list.refuse("the list has the wrong length", "a bin of θ_ff, a bin of θ_ef, and a number, …");
  histogram.cells.reserve(size / parts);
  for (std::size_t k = 0; k < size; k += parts) {
    const int face_face = integer_at(list, k, bins) + zero, edge_face = integer_at(list, k + 1, bins) + zero;
    const double contacts = integer_at(list, k + 2, numbers);
    double& apart = histogram.edge_face_apart[static_cast<std::size_t>(edge_face)];
    apart -= contacts;
    if (apart < 0) list.at(k + 2).refuse("there are more of these contacts than contacts with this θ_ef");
    histogram.cells.push_back({face_face, edge_face, contacts});
  }
}

}  // namespace

AngleHistogram histogram_of(const ClassifiedContacts& classified) {
  const auto& critical = classified.analysis.critical;
  return angle_histogram(classified.alignments, critical.ff_min() / 2, critical.ef_min() / 2);
}

Json trough_record(const Trough& trough, double particles) {
  Json json;
  json["verdict"] = to_string(trough.verdict);
  put_number(json, "excess", trough.excess);
  put_number(json, "critical", trough.critical);
  if (trough.verdict != TroughVerdict::found) return json;
  put_number(json, "cutoff", angle_bin_edge(trough.cutoff));
  put_number(json, "low", angle_bin_edge(trough.low));
  put_number(json, "high", angle_bin_edge(trough.high));
  put_number(json, "density", 2 * trough.density / particles);
  put_number(json, "depth", trough.depth);
  put_number(json, "kernel", trough.kernel);
  return json;
}

std::optional<std::string_view> undecided(const TroughCutoffs& cutoffs) {
  if (!cutoffs.has_face_face()) return "no trough in θ_ff";
  if (!cutoffs.has_all()) return "no trough in θ_ef";
  return std::nullopt;
}

void put_trough(Json& state, const AngleHistogram& histogram, int particles) {
  state["contacts"]["angle_bins"] = histogram_record(histogram);
  const TroughCutoffs cutoffs = trough_cutoffs(histogram);
  Json& json = state["contacts"]["trough"];
  json["face_face"] = trough_record(cutoffs.face_face, particles);
  json["edge_face"] = trough_record(cutoffs.edge_face, particles);
  const auto why = undecided(cutoffs);
  const auto& [n, C_low, C_high] = trough_numbers(histogram, particles, cutoffs);
  const auto put_known = [&](const Quantity& quantity, double value, bool known) {
    put(state, quantity, known ? std::optional(value) : std::nullopt, why.value_or(""));
  };
  put_known(Z_ff_trough, n.Z_ff, cutoffs.has_face_face());
  put_known(Z_ef_trough, n.Z_ef, !why);
  put_known(Z_l_trough, n.Z_l, !why);
  put_known(C_trough, n.C, !why);
  put_known(C_trough_low, C_low, !why);
  put_known(C_trough_high, C_high, !why);
}

AngleHistogram read_angle_histogram(const JsonPlace& place) {
  AngleHistogram histogram;
  read_counts(place.at("face_face"), histogram.face_face);
  read_counts(place.at("edge_face"), histogram.edge_face_apart);
  histogram.face_face_window = static_cast<int>(place.at("face_face_end").integer(ends)) + zero;
  histogram.edge_face_window = static_cast<int>(place.at("edge_face_end").integer(ends)) + zero;
  read_cells(place.at("cells"), histogram);
  return histogram;
}

}  // namespace isojam
