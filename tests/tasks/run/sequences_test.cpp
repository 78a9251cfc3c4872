#include <gtest/gtest.h>

#include <cstdlib>
#include <random>
#include <set>
#include <thread>

#include "tasks/io/file.hpp"
#include "tasks/io/input_error.hpp"
#include "tasks/records/record.hpp"
#include "tasks/run/campaign.hpp"
#include "tasks/tables/table_of.hpp"
#include "tests/tasks/support/bad_manifests.hpp"
#include "tests/tasks/support/support.hpp"

namespace isojam {
namespace {

namespace fs = std::filesystem;
using test::unheard;

/// Icosahedra fail below this max_density.
constexpr double least_limit = 0.9;

/// An artificial outcome, which takes much less time than a replicate.
Outcome outcome_of(const ReplicateSpec& spec) {
  auto outcome = test::made_up_outcome(spec);
  if (to_string(spec.solid) == "icosahedron" && spec.options.compression.max_density < least_limit)
    outcome.failure = Failure{"jam", "made up"};
  return outcome;
}

std::string digest_from_nothing(const ReplicateSpec& spec) {
  return make_record(outcome_of(spec)).at("result_digest").get<std::string>();
}

Manifest parsed(const Json& manifest) { return parse_manifest(manifest.dump(), "m.json"); }

/// A directory, the manifests that it has accepted, and random operations on both.
class Sequence {
 public:
  explicit Sequence(unsigned seed) : random_(seed) {}

  void step() {
    constexpr int kinds = 10;
    switch (pick(kinds)) {
      case 0: return run(another());
      case 1: return run(changed(accepted(), "replicates", 1 + pick(4)));
      case 2: return run(changed(accepted(), "measure", some({"contacts", "order", "clusters"})));
      case 3: return run(changed(accepted(), "keep_path", pick(2) == 1));
      case 4: return correct();
      case 5: return run(accepted(), pick(3));  // killed after a few replicates
      case 6: return run_two();
      case 7: return damage();
      case 8: return uncorrected_.empty() ? run(another()) : run_uncorrected(some(uncorrected_).back());
      default: return aggregate();
    }
  }

  /// Every manifest still runs to its end, with the digests of a run from nothing.
  void check() {
    std::shuffle(accepted_.begin(), accepted_.end(), random_);
    for (const auto& json : uncorrected_) run_uncorrected(json);
    for (const auto& json : accepted_) run(json);
    for (const auto& json : accepted_) {
      run(json);
      for (auto spec : test::make_plan(parsed(json))) {
        const auto held = read_record(here_ / "r", replicate_name(spec));
        EXPECT_TRUE(lacks(held, spec.measures).empty()) << held.name;
        spec.measures = held.summary.measures;
        EXPECT_EQ(held.summary.result_digest, digest_from_nothing(spec)) << held.name;
        if (parsed(json).replicates.goal && spec.replicate + 1 == 2) break;
      }
    }
    for (const auto& json : uncorrected_) run_uncorrected(json);
    aggregate();
  }

 private:
  int pick(int count) { return static_cast<int>(random_() % static_cast<unsigned>(count)); }
  Json some(const std::vector<Json>& all) {
    Json list = Json::array();
    for (const auto& one : all) {
      if (pick(2)) list.push_back(one);
    }
    return list.empty() ? Json{all.front()} : list;
  }
  Json limit() const { return {{"icosahedron", {{"max_density", is_corrected_ ? 0.95 : 0.5}}}}; }
  Json another() {
    auto manifest = test::good_manifest();
    manifest["sweep"]["solid"] = some({"dodecahedron", "icosahedron"});
    manifest["sweep"]["particles"] = some({64, 70, 80});
    manifest["measure"] = {"contacts"};
    manifest["replicates"] = 1 + pick(3);
    if (pick(4) == 0) manifest["replicates"] = {{"min", 2}, {"max", 4}, {"quantity", "phi_j"}, {"half_width", 1}};
    if (pick(4) == 0) manifest["sweep"]["step_fraction"] = some({0.3, 0.4});
    if (manifest["sweep"]["solid"].back() == "icosahedron") manifest["protocol"]["by_solid"] = limit();
    return manifest;
  }
  Json accepted() { return accepted_.empty() ? another() : accepted_[static_cast<std::size_t>(pick(count()))]; }
  int count() const { return static_cast<int>(accepted_.size()); }
  static Json changed(Json manifest, const char* key, const Json& value) {
    manifest[key] = value;
    return manifest;
  }

  /// Runs a manifest like `isojam run`, at most `most` replicates of it.
  void run(const Json& json, int most = 1000) {
    if (std::find(accepted_.begin(), accepted_.end(), json) == accepted_.end()) accepted_.push_back(json);
    run_campaign(json, most, unheard);
  }
  void run_campaign(const Json& json, int most, const Warn& warn) {
    const auto manifest = parsed(json);
    const Plan plan(manifest);
    const Store store(here_ / "r", manifest, warn);
    Campaign campaign(plan, manifest.replicates, {}, store);
    while (campaign.open_round()) {
      while (const auto spec = campaign.next()) {
        if (most-- == 0) return;
        store.write(outcome_of(*spec));
      }
    }
  }

  /// Two processes at once, for manifests that both are new.
  void run_two() {
    const auto one = another(), other = another();
    for (const auto& json : {one, other}) run(json, 0);
    const std::jthread second([&] { run(one); });
    run(other);
  }

  /// The user raises the limit of a solid that failed, in all manifests.
  void correct() {
    if (std::exchange(is_corrected_, true)) return;
    for (auto& json : accepted_) {
      if (!json.contains("protocol")) continue;
      uncorrected_.push_back(json);
      json["protocol"]["by_solid"] = limit();
    }
    run(accepted());
  }

  /// Changes a byte of a file, truncates or removes it.
  void damage() {
    if (!fs::exists(here_ / "r")) return;
    std::vector<fs::path> files;
    for (const auto& entry : fs::recursive_directory_iterator(here_ / "r")) {
      if (entry.path().extension() == ".json") files.push_back(entry.path());
    }
    std::sort(files.begin(), files.end());
    const auto& file = files[static_cast<std::size_t>(pick(static_cast<int>(files.size())))];
    auto text = read_file(file);
    if (pick(3) == 0) {
      fs::remove(file);
      return;
    }
    if (!text.empty()) text[static_cast<std::size_t>(pick(static_cast<int>(text.size())))] ^= 1;
    test::write_text(file, pick(2) ? text : text.substr(0, text.size() / 2));
  }

  /// The tables need all records, so that only damage may stop them.
  void aggregate() {
    try {
      table_of({(here_ / "r").string()}, unheard);
    } catch (const InputError&) {
    } catch (const FileError& error) {
      EXPECT_EQ(error.reason(), FileError::Reason::missing) << error.what();
    }
  }

  /// A manifest from before the correction runs to its end too, but for the replicates that the correction has made. It
  /// is refused only if its copy in manifests/ was lost.
  void run_uncorrected(const Json& json) {
    const std::string taken = "/spec/protocol/max_density: 0.95 in the record, 0.5 in this manifest";
    test::Warnings warnings;
    try {
      run_campaign(json, 1000, warnings.warn());
    } catch (const InputError& error) {
      EXPECT_NE(std::string(error.what()).find(taken), std::string::npos) << error.what();
      for (const auto& plan : requests_in(here_ / "r", unheard))
        EXPECT_NE(to_json(plan.manifest()), to_json(parsed(json)));
      return;
    }
    for (auto spec : test::make_plan(parsed(json))) {
      if (parsed(json).replicates.goal && spec.replicate >= 2) continue;
      const auto held = read_record(here_ / "r", replicate_name(spec));
      spec.measures = held.summary.measures;
      if (held.summary.spec_digest == spec_digest(spec)) {
        EXPECT_EQ(held.summary.result_digest, digest_from_nothing(spec)) << held.name;
        continue;
      }
      EXPECT_FALSE(held.summary.failed) << held.name;
      const auto names = [&](const std::string& said) {
        return said.find(held.name) != std::string::npos && said.find(taken) != std::string::npos;
      };
      EXPECT_TRUE(std::any_of(warnings.said.begin(), warnings.said.end(), names)) << held.name;
    }
  }

  std::mt19937 random_;
  test::TemporaryDirectory here_;
  std::vector<Json> accepted_, uncorrected_;  ///< uncorrected_: manifests before the correction
  bool is_corrected_ = false;
};

TEST(Sequences, EveryManifestStillRunsToItsEnd) {
  const auto* given = std::getenv("ISOJAM_SEQUENCES");
  const unsigned sequences = given ? static_cast<unsigned>(std::stoul(given)) : 25;
  if (fs::is_directory("/dev/shm")) ::setenv("TMPDIR", "/dev/shm", 1);  // thousands of files are synchronised
  for (unsigned seed = 0; seed < sequences && !testing::Test::HasFailure(); ++seed) {
    SCOPED_TRACE(seed);
    Sequence sequence(seed);
    for (int k = 0; k < 10; ++k) sequence.step();
    sequence.check();
  }
  ::unsetenv("TMPDIR");
}

}  // namespace
}  // namespace isojam
