#include <algorithm>

#include "engine/analysis/order.hpp"
#include "engine/analysis/random_alignment.hpp"
#include "engine/packing/energy.hpp"
#include "tasks/measure/parts.hpp"

namespace isojam {
namespace {

bool has_cutoff(const CdfFit& fit) { return fit.verdict == FitVerdict::fitted || fit.verdict == FitVerdict::bimodal; }

Json fit_record(const CdfFit& fit) {
  Json json;
  json["verdict"] = to_string(fit.verdict);
  if (!has_cutoff(fit)) return json;
  put_number(json, "cutoff", fit.cutoff);
  put_number(json, "alpha", fit.alpha);
  put_number(json, "a_0", fit.a[0]);
  put_number(json, "a_0_error", fit.a0_error);
  put_number(json, "error", fit.error);
  return json;
}

Json gap_record(const GapSplit& gap) {
  Json json;
  json["verdict"] = to_string(gap.verdict);
  if (gap.cutoff > 0) put_number(json, "cutoff", gap.cutoff);
  return json;
}

Json fixed_record(const ContactNumbers& numbers) {
  Json json;
  put_number(json, "Z_ff", numbers.Z_ff);
  put_number(json, "Z_ef", numbers.Z_ef);
  put_number(json, "Z_l", numbers.Z_l);
  put_number(json, "C", numbers.C);
  return json;
}

}  // namespace

std::optional<std::string_view> undecided(const ContactAnalysis& analysis) {
  if (!has_cutoff(analysis.face_face)) return "no face-face cut-off";
  if (!has_cutoff(analysis.edge_face)) return "no edge-face cut-off";
  return std::nullopt;
}

Json contact_record(const ContactAnalysis& analysis) {
  Json json;
  const auto& n = analysis.numbers;
  put_number(json, "Z", n.Z);
  put_number(json, "Q6", analysis.Q6);
  // A cut-off that a fit did not give decides nothing: numbers that hang on it are absent rather than zero.
  const auto why = undecided(analysis);
  const auto put = [&](const std::string& key, double value, bool known) {
    put_optional(json, key, known ? std::optional(value) : std::nullopt, why.value_or(""));
  };
  put("Z_ff", n.Z_ff, has_cutoff(analysis.face_face));
  put("Z_ef", n.Z_ef, !why);
  put("Z_l", n.Z_l, !why);
  put("C", n.C, !why);
  json["face_face_fit"] = fit_record(analysis.face_face);
  json["edge_face_fit"] = fit_record(analysis.edge_face);
  json["face_face_gap"] = gap_record(analysis.face_face_gap);
  json["edge_face_gap"] = gap_record(analysis.edge_face_gap);
  put_optional(json, "Z_ff_gap", analysis.Z_ff_gap, to_string(analysis.face_face_gap.verdict));
  put_optional(json, "Z_ff_disagreement", analysis.disagreement(), "one of the methods gives no cut-off");
  json["fixed_cutoffs"] = fixed_record(analysis.fixed_cutoffs);
  json["pooled_over"] = analysis.pooled_over;
  return json;
}

std::vector<std::string> contact_flags(const ContactAnalysis& nearest) {
  std::vector<std::string> flags;
  if (undecided(nearest)) {
    flags.emplace_back("classes_undecided");
  } else if (nearest.face_face.verdict == FitVerdict::bimodal || nearest.edge_face.verdict == FitVerdict::bimodal) {
    flags.emplace_back("classes_doubtful");
  }
  if (nearest.Q6 > crystalline_q6) flags.emplace_back("crystalline");
  return flags;
}

namespace {

/// Of the state nearest jamming: the angles themselves, ascending, for whoever draws their CDFs, and whether more are
/// near 0 than ideal random contacts would have.
Json angle_record(const ConvexSolid& solid, const std::vector<Alignment>& alignments) {
  std::vector<double> face_face, edge_face;
  for (const auto& alignment : alignments) {
    face_face.push_back(alignment.face_face);
    edge_face.push_back(alignment.edge_face);
  }
  std::sort(face_face.begin(), face_face.end());
  std::sort(edge_face.begin(), edge_face.end());
  const RandomAlignment random(solid);
  const auto compared = [](const Randomness& randomness) {
    Json json;
    json["verdict"] = to_string(randomness.verdict);
    put_number(json, "angle", randomness.angle);
    json["below"] = randomness.below;
    put_number(json, "expected", randomness.expected);
    put_number(json, "probability", randomness.probability);
    return json;
  };
  Json json;
  json["face_face_random"] = compared(compare_with_random(
      face_face, [&](double theta) { return random.face_face(theta); }, random.ff_max()));
  json["edge_face_random"] = compared(compare_with_random(
      edge_face, [&](double theta) { return random.edge_face(theta); }, random.ef_max()));
  json["face_face"] = std::move(face_face);
  json["edge_face"] = std::move(edge_face);
  return json;
}

}  // namespace

Measurement measure_contacts(const JamResult& jam) {
  Measurement measurement;
  PackingEnergy energy;
  const auto nearest = nearest_state(jam);
  for (std::size_t k = 0; k < jam.states.size(); ++k) {
    const auto classified = classified_contacts(jam.states[k], energy);
    measurement.states.push_back(contact_record(classified.analysis));
    if (k != nearest) continue;
    measurement.flags = contact_flags(classified.analysis);
    measurement.states.back()["angles"] = angle_record(*jam.states[k].solid, classified.alignments);
  }
  return measurement;
}

}  // namespace isojam
