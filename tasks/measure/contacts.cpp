#include "engine/analysis/contacts.hpp"

#include "engine/analysis/order.hpp"
#include "engine/packing/energy.hpp"
#include "tasks/measure/parts.hpp"

namespace isojam {
namespace {

ContactAnalysis analyse(const Packing& packing, PackingEnergy& energy) {
  const auto contacts = energy.contacts(packing);
  auto analysis = analyse_contacts(*packing.solid, packing.size(), alignments(*packing.solid, contacts));
  analysis.Q6 = contact_q6(contacts);
  return analysis;
}

bool decided(const ContactAnalysis& analysis) {
  return analysis.face_face.verdict == FitVerdict::fitted && analysis.edge_face.verdict == FitVerdict::fitted;
}

Json fit_record(const CdfFit& fit) {
  Json json;
  json["verdict"] = to_string(fit.verdict);
  if (fit.verdict != FitVerdict::fitted) return json;
  put_number(json, "cutoff", fit.cutoff);
  put_number(json, "alpha", fit.alpha);
  put_number(json, "a_0", fit.a[0]);
  put_number(json, "a_0_error", fit.a0_error);
  put_number(json, "error", fit.error);
  return json;
}

}  // namespace

Json contact_record(const ContactAnalysis& analysis) {
  Json json;
  const auto& n = analysis.numbers;
  put_number(json, "Z", n.Z);
  put_number(json, "Q6", analysis.Q6);
  // A cut-off that a fit did not give decides nothing: numbers that hang on it are absent rather than zero.
  const bool faces = analysis.face_face.verdict == FitVerdict::fitted;
  const auto put = [&](const std::string& key, double value, bool known) {
    if (known) {
      put_number(json, key, value);
    } else {
      put_absent(json, key, faces ? "no edge-face cut-off" : "no face-face cut-off");
    }
  };
  put("Z_ff", n.Z_ff, faces);
  put("Z_ef", n.Z_ef, decided(analysis));
  put("Z_l", n.Z_l, decided(analysis));
  put("C", n.C, decided(analysis));
  json["face_face_fit"] = fit_record(analysis.face_face);
  json["edge_face_fit"] = fit_record(analysis.edge_face);
  return json;
}

std::vector<std::string> contact_flags(const ContactAnalysis& nearest) {
  std::vector<std::string> flags;
  if (!decided(nearest)) flags.emplace_back("classes_undecided");
  if (nearest.Q6 > crystalline_q6) flags.emplace_back("crystalline");
  return flags;
}

Measurement measure_contacts(const JamResult& jam) {
  Measurement measurement;
  PackingEnergy energy;
  const auto nearest = nearest_state(jam);
  for (std::size_t k = 0; k < jam.states.size(); ++k) {
    const auto analysis = analyse(jam.states[k], energy);
    measurement.states.push_back(contact_record(analysis));
    if (k == nearest) measurement.flags = contact_flags(analysis);
  }
  return measurement;
}

}  // namespace isojam
