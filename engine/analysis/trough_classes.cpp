#include "engine/analysis/trough_classes.hpp"

#include <numeric>
#include <stdexcept>
#include <vector>

namespace isojam {

namespace {

double sum_of_first(const std::vector<double>& counts, int bins) {
  return std::accumulate(counts.begin(), counts.begin() + bins, 0.0);
}

}  // namespace

TroughCutoffs trough_cutoffs(const AngleHistogram& histogram) {
  TroughCutoffs cutoffs;
  cutoffs.face_face = find_trough(histogram.face_face, histogram.face_face_window);
  cutoffs.edge_face = find_trough(histogram.edge_face_of_others(cutoffs.face_face.cutoff), histogram.edge_face_window);
  return cutoffs;
}

ContactNumbers numbers_in_bins(const AngleHistogram& histogram, int particles, int face_face_bins, int edge_face_bins) {
  if (particles < 1) throw std::invalid_argument("contact numbers need at least one particle");
  const double all = histogram.contacts(), face_face = sum_of_first(histogram.face_face, face_face_bins),
               edge_face = sum_of_first(histogram.edge_face_of_others(face_face_bins), edge_face_bins);
  const auto per_particle = [&](double contacts) { return 2 * contacts / particles; };
  return {.Z = per_particle(all),
          .Z_ff = per_particle(face_face),
          .Z_ef = per_particle(edge_face),
          .Z_l = per_particle(all - face_face - edge_face),
          .C = per_particle(all + 2 * face_face + edge_face)};
}

TroughNumbers trough_numbers(const AngleHistogram& histogram, int particles, const TroughCutoffs& cutoffs) {
  const Trough &ff = cutoffs.face_face, &ef = cutoffs.edge_face;
  return {.numbers = numbers_in_bins(histogram, particles, ff.cutoff, ef.cutoff),
          .C_low = numbers_in_bins(histogram, particles, ff.low, ef.low).C,
          .C_high = numbers_in_bins(histogram, particles, ff.high, ef.high).C};
}

}  // namespace isojam
