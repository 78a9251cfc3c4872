#include "tasks/measure/trough_parts.hpp"

#include <algorithm>
#include <cmath>
#include <iterator>

namespace isojam {
namespace {

/// In records, bins are numbered from log10 θ = 0.
constexpr int zero = -angle_bins_from * angle_bins_per_decade;
constexpr Range bins{-zero, angle_bins - 1 - zero}, ends{-zero, angle_bins - zero}, numbers{0, 1e9};

AngleCounts counts_of(const std::vector<double>& counts) {
  const auto is_occupied = [](double count) { return count > 0; };
  const auto first = std::find_if(counts.begin(), counts.end(), is_occupied);
  const auto last = std::find_if(counts.rbegin(), std::make_reverse_iterator(first), is_occupied).base();
  AngleCounts record{first - counts.begin() - zero, {}};
  for (auto count = first; count < last; ++count) record.counts.push_back(std::lround(*count));
  return record;
}

void add_counts(std::vector<double>& counts, const AngleCounts& record, const JsonPlace& place) {
  const auto first = static_cast<std::size_t>(record.first + zero);
  if (first + record.counts.size() > counts.size())
    place.at("counts").refuse("the list has more bins than angles up to π need");
  std::copy(record.counts.begin(), record.counts.end(), counts.begin() + static_cast<std::ptrdiff_t>(first));
}

void add_cells(AngleHistogram& histogram, const std::vector<long>& cells, const JsonPlace& list) {
  constexpr std::size_t parts = 3;
  if (cells.size() % parts != 0)
    list.refuse("the list has the wrong length", "a bin of θ_ff, a bin of θ_ef, and a number, …");
  histogram.cells.reserve(cells.size() / parts);
  for (std::size_t k = 0; k < cells.size(); k += parts) {
    for (const auto bin : {k, k + 1})
      if (!bins.contains(static_cast<double>(cells[bin]))) list.at(bin).not_accepted(integer_in(bins));
    if (cells[k + 2] < 0) list.at(k + 2).not_accepted(integer_in(numbers));
    const int face_face = static_cast<int>(cells[k]) + zero, edge_face = static_cast<int>(cells[k + 1]) + zero;
    const auto contacts = static_cast<double>(cells[k + 2]);
    double& apart = histogram.edge_face_apart[static_cast<std::size_t>(edge_face)];
    apart -= contacts;
    if (apart < 0) list.at(k + 2).refuse("there are more of these contacts than contacts with this θ_ef");
    histogram.cells.push_back({face_face, edge_face, contacts});
  }
}

}  // namespace

void describe(Fields& field, TroughRecord& trough) {
  field.type("trough", "Trough in the density of log10 θ, between a population of small angles and the other angles.");
  field("verdict", trough.verdict,
        "Result of the search. `found`: There is a trough. `undecided`: There is no trough, or it is not deeper than "
        "the noise. `not_called`: No search was made.");
  field("excess", trough.excess,
        "Number of angles below the trough, in excess of the largest number that a density without a trough allows.")
      .range(not_negative)
      .finite();
  field("critical", trough.critical,
        "Value that the excess must exceed. Noise alone exceeds it in at most 5 % of all cases.")
      .range(not_negative)
      .finite();
  field("cutoff", trough.cutoff,
        "Cut-off: the angle with the smallest density, in radians; absent if no trough was found.")
      .range(positive)
      .finite();
  field("low", trough.low, "Lower edge of the trough, in radians; absent if no trough was found.")
      .range(positive)
      .finite();
  field("high", trough.high, "Upper edge of the trough, in radians; absent if no trough was found.")
      .range(positive)
      .finite();
  field("density", trough.density,
        "Density at the cut-off: number of contacts per particle and decade of θ. Each contact counts for both of its "
        "particles. Absent if no trough was found.")
      .range(not_negative)
      .finite();
  field("depth", trough.depth,
        "Depth of the trough: 1 minus the ratio of the density at the cut-off to the lower of the two peaks of the "
        "density. It is 1 if the trough is empty. Absent if no trough was found.")
      .range({0, 1})
      .finite();
  field("kernel", trough.kernel,
        "Standard deviation of the Gaussian kernel with which the density is estimated, in decades; absent if no "
        "trough was found.")
      .range(positive)
      .finite();
}

void describe(Fields& field, Troughs& troughs) {
  const auto add = [&](const char* key, Reasoned<>& value, const Column& column, const std::string& meaning) {
    field(key, value, meaning).unit("per particle").column(column);
  };
  const std::string with_both =
      ", with the cut-offs in the troughs of θ_ff and θ_ef; null if there is no trough of θ_ff or of θ_ef.";
  field("face_face", troughs.face_face, "Trough of the density of θ_ff. It gives the cut-off of face-face contacts.");
  field("edge_face", troughs.edge_face,
        "Trough of the density of θ_ef of the contacts that are not face-face. It gives the cut-off of edge-face "
        "contacts.");
  add("Z_ff", troughs.Z_ff, {"Z_ff_trough", contact_group, "Z_{ff}^{trough}"},
      "Number of face-face contacts per particle, with the cut-off in the trough of θ_ff; null if there is no trough.");
  add("Z_ef", troughs.Z_ef, {"Z_ef_trough", contact_group, "Z_{ef}^{trough}"},
      "Number of edge-face contacts per particle" + with_both);
  add("Z_l", troughs.Z_l, {"Z_l_trough", contact_group, "Z_l^{trough}"},
      "Number of lower-order contacts per particle" + with_both);
  add("C", troughs.C, {"C_trough", contact_group, "C^{trough}"},
      "Constraint number C with the cut-offs in the troughs of θ_ff and θ_ef; null if there is no trough of θ_ff or of "
      "θ_ef.");
  add("C_low", troughs.C_low, {"C_trough_low", contact_group, "C^{trough}_{low}"},
      "Constraint number C with both cut-offs at the lower edges of the troughs; null if there is no trough of θ_ff or "
      "of θ_ef. (`C_high` − `C_low`)/2 is the systematic error of C from the width of the troughs.");
  add("C_high", troughs.C_high, {"C_trough_high", contact_group, "C^{trough}_{high}"},
      "Constraint number C with both cut-offs at the upper edges of the troughs; null if there is no trough of θ_ff or "
      "of θ_ef.");
}

void describe(Fields& field, AngleCounts& counts) {
  field.type("angle_counts", "Numbers of contacts in consecutive bins of log10 θ. All other bins are empty.");
  field("first", counts.first, "Index of the first bin in the list.").range(ends);
  field("counts", counts.counts, "Number of contacts in each bin.").range(numbers);
}

void describe(Fields& field, AngleBins& angles) {
  field("width", angles.width, "Width of the bins, in decades.").range(positive).finite();
  field("face_face", angles.face_face, "Numbers of contacts by θ_ff.");
  field("edge_face", angles.edge_face, "Numbers of contacts by θ_ef.");
  field("face_face_end", angles.face_face_end,
        "Cut-offs of θ_ff are at the lower edge of this bin or below: half of the smallest critical angle is in this "
        "bin.")
      .range(ends);
  field("edge_face_end", angles.edge_face_end,
        "Cut-offs of θ_ef are at the lower edge of this bin or below: half of the smallest critical angle is in this "
        "bin.")
      .range(ends);
  field("cells", angles.cells,
        "Groups of three numbers in one list: a bin of θ_ff, a bin of θ_ef, and the number of contacts that have both "
        "angles in these bins. Only contacts with θ_ff below the bin `face_face_end` are listed.")
      .range({bins.low, numbers.high});
}

AngleHistogram histogram_of(const ClassifiedContacts& classified) {
  const auto& critical = classified.analysis.critical;
  return angle_histogram(classified.alignments, critical.ff_min() / 2, critical.ef_min() / 2);
}

TroughRecord trough_record(const Trough& trough, double particles) {
  TroughRecord record{trough.verdict, trough.excess, trough.critical, {}, {}, {}, {}, {}, {}};
  if (trough.verdict != TroughVerdict::found) return record;
  record.cutoff = angle_bin_edge(trough.cutoff);
  record.low = angle_bin_edge(trough.low);
  record.high = angle_bin_edge(trough.high);
  record.density = 2 * trough.density / particles;
  record.depth = trough.depth;
  record.kernel = trough.kernel;
  return record;
}

std::optional<std::string_view> undecided(const TroughCutoffs& cutoffs) {
  if (!cutoffs.has_face_face()) return "no trough in θ_ff";
  if (!cutoffs.has_all()) return "no trough in θ_ef";
  return std::nullopt;
}

Troughs troughs_of(const AngleHistogram& histogram, int particles) {
  const TroughCutoffs cutoffs = trough_cutoffs(histogram);
  const auto why = undecided(cutoffs);
  const auto& [n, C_low, C_high] = trough_numbers(histogram, particles, cutoffs);
  const auto value = [&](double number) { return given(!why, number, why.value_or("")); };
  return {trough_record(cutoffs.face_face, particles),
          trough_record(cutoffs.edge_face, particles),
          given(cutoffs.has_face_face(), n.Z_ff, why.value_or("")),
          value(n.Z_ef),
          value(n.Z_l),
          value(n.C),
          value(C_low),
          value(C_high)};
}

AngleBins bins_of(const AngleHistogram& histogram) {
  AngleBins record{
      1.0 / angle_bins_per_decade,       counts_of(histogram.face_face),    counts_of(histogram.edge_face_of_others(0)),
      histogram.face_face_window - zero, histogram.edge_face_window - zero, {}};
  for (const auto& cell : histogram.cells)
    record.cells.insert(record.cells.end(), {cell.face_face - zero, cell.edge_face - zero, std::lround(cell.contacts)});
  return record;
}

AngleHistogram read_angle_histogram(const JsonPlace& place) {
  const auto record = read<AngleBins>(place);
  AngleHistogram histogram;
  add_counts(histogram.face_face, record.face_face, place.at("face_face"));
  add_counts(histogram.edge_face_apart, record.edge_face, place.at("edge_face"));
  histogram.face_face_window = record.face_face_end + zero;
  histogram.edge_face_window = record.edge_face_end + zero;
  add_cells(histogram, record.cells, place.at("cells"));
  return histogram;
}

}  // namespace isojam
