// States of self-stress that contacts can bear which only push, by linear programmes, whatever the margins of their
// patches, in stored states of results directories:
//
//   isojam_cones RESULTS_DIR... -o FILE [--below DELTA_PHI] [--each N]
//     the first N replicates (4) of every sweep point, every state of their paths with 0 < Δφ < DELTA_PHI (.02),
//     without those whose class cut-offs collapse. FILE holds {"rows": [...]}, a row for each state, in order of
//     directories, replicates and states; a table is printed.

#include <fmt/format.h>

#include <charconv>
#include <cstdio>
#include <cstdlib>
#include <exception>
#include <map>
#include <optional>
#include <string>
#include <tuple>
#include <vector>

#include "engine/parallel/parallel.hpp"
#include "engine/rigidity/contact_patch.hpp"
#include "tasks/export/stored_states.hpp"
#include "tasks/store/store.hpp"
#include "tasks/system/atomic_file.hpp"
#include "tests/engine/rigidity/push_dimension.hpp"

namespace isojam::bench {
namespace {

struct Options {
  std::vector<std::string> directories;
  std::string output;
  double below = 0.02;
  int each = 4;
};

/// A state to look at.
struct Asked {
  std::string study, solid;
  int replicate = 0;
  StoredState state;
};

/// What was found of it; no row where classes collapse.
struct Found {
  std::optional<OneSidedStresses> stresses;
  PushedStates pushed;
};

Found look_at(const Packing& packing) {
  const auto contacts = PackingEnergy().contacts(packing);
  const auto angles = alignments(packing.solids, contacts);
  const auto analysis = analyse_contacts(packing.solids, packing.size(), contacts, angles);
  if (!analysis.face_face.has_cutoff() || !analysis.edge_face.has_cutoff()) return {};
  const auto forces = contact_forces(packing, contacts);
  const auto patches = contact_patches(packing, contacts, forces, angles, analysis.classes);
  const auto corners = corner_constraints(packing, contacts, forces, patches);
  // The same for every state: what is found of one does not depend on which others are asked for.
  RandomStream random{43};
  return {one_sided_stresses(packing, contacts, forces, angles, analysis.classes),
          pushed_states(contacts, patches, normal_constraints(packing, contacts), corners, random)};
}

std::vector<Asked> states_of(const Options& options) {
  std::vector<Asked> list;
  const auto warn = [](const std::string& text) { std::fprintf(stderr, "warning: %s\n", text.c_str()); };
  for (const auto& directory : options.directories) {
    const auto manifest = own_manifest(directory);
    for_each_record(directory, manifest, warn, [&](const RecordedReplicate& held) {
      if (held.summary.failed || held.summary.replicate >= options.each) return;
      for (auto& state : stored_states(directory, held, true)) {
        if (!state.delta_phi || !(*state.delta_phi > 0 && *state.delta_phi < options.below)) continue;
        list.push_back(
            {manifest.name, std::string(to_string(held.summary.solid)), held.summary.replicate, std::move(state)});
      }
    });
  }
  return list;
}

Json row_of(const Asked& asked, const Found& found) {
  const auto& stresses = *found.stresses;
  return {{"study", asked.study},
          {"solid", asked.solid},
          {"particles", asked.state.packing.size()},
          {"replicate", asked.replicate},
          {"state", asked.state.index},
          {"delta_phi", *asked.state.delta_phi},
          {"constraints", stresses.constraints},
          {"self_stress", stresses.dimension},
          {"outside", stresses.outside},
          {"outside_faces", stresses.outside_faces},
          {"dimension", found.pushed.dimension ? Json(*found.pushed.dimension) : Json(nullptr)}};
}

/// States of a solid and size, and how many of them have what.
struct Counts {
  int states = 0, outside = 0, fewer = 0, none = 0, without_answer = 0, programmes = 0;

  void add(const Found& found) {
    const auto& dimension = found.pushed.dimension;
    ++states;
    programmes += found.pushed.programmes;
    outside += found.stresses->outside > 0;
    fewer += dimension && *dimension < found.stresses->dimension;
    none += dimension && *dimension == 0;
    without_answer += !dimension;
  }
};

void print(const std::map<std::tuple<std::string, std::string, int>, Counts>& table) {
  std::printf("%-20s %-14s %5s %7s %8s %6s %5s %10s %11s\n", "study", "solid", "N", "states", "outside", "fewer",
              "none", "no answer", "programmes");
  for (const auto& [of, counts] : table) {
    const auto& [study, solid, particles] = of;
    std::printf("%-20s %-14s %5d %7d %8d %6d %5d %10d %11d\n", study.c_str(), solid.c_str(), particles, counts.states,
                counts.outside, counts.fewer, counts.none, counts.without_answer, counts.programmes);
  }
}

void run(const Options& options) {
  const auto asked = states_of(options);
  std::vector<Found> found(asked.size());
  for_each_index(asked.size(), [&](std::size_t k) { found[k] = look_at(asked[k].state.packing); });
  Json rows = Json::array();
  std::map<std::tuple<std::string, std::string, int>, Counts> table;
  for (std::size_t k = 0; k < asked.size(); ++k) {
    if (!found[k].stresses) continue;
    rows.push_back(row_of(asked[k], found[k]));
    table[{asked[k].study, asked[k].solid, asked[k].state.packing.size()}].add(found[k]);
  }
  write_output(options.output, pretty({{"rows", rows}}));
  print(table);
}

class UsageError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// A number above 0; `kind` says which.
template <class Number>
Number number(const std::string& option, const std::string& text, const char* kind) {
  Number value{};
  const auto* end = text.data() + text.size();
  if (const auto [stop, error] = std::from_chars(text.data(), end, value);
      error != std::errc() || stop != end || !(value > 0))
    throw UsageError(fmt::format("{}: \"{}\" is not {} above 0", option, text, kind));
  return value;
}

Options parsed_options(const std::vector<std::string>& words) {
  Options options;
  for (std::size_t k = 0; k < words.size(); ++k) {
    const std::string& word = words[k];
    if (!word.starts_with("-")) {
      options.directories.push_back(word);
      continue;
    }
    if (word != "-o" && word != "--below" && word != "--each") throw UsageError(word + " is not an option");
    if (++k == words.size()) throw UsageError(word + " is followed by nothing");
    if (word == "-o") options.output = words[k];
    if (word == "--below") options.below = number<double>(word, words[k], "a number");
    if (word == "--each") options.each = number<int>(word, words[k], "an integer");
  }
  if (options.directories.empty() || options.output.empty())
    throw UsageError("usage: isojam_cones RESULTS_DIR... -o FILE [--below DELTA_PHI] [--each N]");
  return options;
}

}  // namespace
}  // namespace isojam::bench

int main(int count, char** values) {
  try {
    isojam::bench::run(isojam::bench::parsed_options({values + 1, values + count}));
    return 0;
  } catch (const std::exception& error) {
    std::fprintf(stderr, "error: %s\n", error.what());
    return 2;
  }
}
