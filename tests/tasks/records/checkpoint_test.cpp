#include "tasks/records/checkpoint.hpp"

#include <gtest/gtest.h>

#include <limits>

#include "tasks/io/input_error.hpp"
#include "tasks/io/sealed.hpp"
#include "tasks/records/record.hpp"
#include "tests/tasks/support/support.hpp"

namespace isojam {
namespace {

ReplicateSpec tiny_spec(std::size_t index = 0, const char* method = "multipliers", long max_evaluations = 2000) {
  auto manifest = test::tiny_manifest();
  manifest["measure"] = {"contacts"};
  manifest["protocol"]["compression_evaluations"] = 2000;  // replicate 1 jams with these packings
  manifest["minimiser"]["method"] = method;
  manifest["minimiser"]["max_evaluations"] = max_evaluations;
  return test::make_plan(parse_manifest(manifest.dump(), "tiny"))[index];
}

Json record_of(const ReplicateSpec& spec, const Checkpoint& from, const OnProgress& on_progress = {}) {
  const auto stages = engine_stages();
  Outcome outcome;
  outcome.spec = spec;
  outcome.jam = stages.jam(spec, from.progress, {}, on_progress);
  outcome.failure = failure_of(outcome.jam);
  if (!outcome.failure) outcome.measured[Measure::contacts] = stages.measure(spec, Measure::contacts, outcome.jam);
  return make_record(outcome);
}

/// Resumes a run from all its checkpoints and checks the bits. Returns the number of failed decompression steps.
int expect_the_same_bits(const ReplicateSpec& spec) {
  std::vector<std::string> texts;
  int halvings = 0;
  const auto whole = record_of(spec, engine_stages().begin(spec), [&](const JamProgress& progress) {
    texts.push_back(sealed(*make_checkpoint(spec, {progress, {3, 2}})));
    halvings = progress.halvings;
  });
  EXPECT_GT(texts.size(), 8U);
  EXPECT_EQ(whole.at("status"), "done");
  for (const auto& text : texts) {
    const auto document = parse_sealed(text, "checkpoint");
    const auto from = read_checkpoint({document, "checkpoint"}, spec);
    EXPECT_EQ(from.spent.cpu_seconds, 2);
    EXPECT_EQ(Json::diff(whole, record_of(spec, from)).dump(), "[]")
        << "after " << from.progress.result.path.size() << " steps";
    EXPECT_EQ(sealed(*make_checkpoint(spec, from)), text);
  }
  return halvings;
}

TEST(Checkpoint, TheRestOfARunInAVariableCellHasTheSameBits) {
  auto manifest = test::tiny_manifest();
  manifest["measure"] = {"contacts"};
  manifest["protocol"]["control"] = "pressure";
  manifest["protocol"]["cell"] = "free";
  expect_the_same_bits(test::make_plan(parse_manifest(manifest.dump(), "tiny"))[2]);
}

TEST(Checkpoint, TheRestOfARunWithCyclesHasTheSameBits) {
  auto manifest = test::tiny_manifest();
  manifest["measure"] = {"contacts"};
  manifest["protocol"]["cycles"] = 1;
  expect_the_same_bits(test::make_plan(parse_manifest(manifest.dump(), "tiny"))[0]);
}

TEST(Checkpoint, TheRestOfARunHasTheSameBits) {
  EXPECT_EQ(expect_the_same_bits(tiny_spec()), 0);
  EXPECT_GT(expect_the_same_bits(tiny_spec(1, "newton", 20)), 0) << "20 evaluations are enough for every step";
}

Checkpoint with_a_state(const ReplicateSpec& spec) {
  const auto outcome = test::made_up_outcome(spec);
  Checkpoint checkpoint{begin_jam(outcome.jam.states.back(), spec.options), {}};
  checkpoint.progress.stage = JamStage::decompression;
  checkpoint.progress.result = outcome.jam;
  checkpoint.progress.result.status = JamStatus::not_called;
  return checkpoint;
}

TEST(Checkpoint, ResumesWithOtherMeasures) {
  const auto manifest = parse_manifest(test::tiny_manifest().dump(), "tiny");
  auto fewer = manifest, seeded = manifest;
  fewer.measures = {Measure::contacts};
  seeded.seed += 1;
  const auto spec = test::make_plan(manifest)[0];
  const auto checkpoint = *make_checkpoint(test::make_plan(fewer)[0], with_a_state(spec));
  EXPECT_NO_THROW(read_checkpoint({checkpoint, "c"}, spec));
  EXPECT_THROW(read_checkpoint({checkpoint, "c"}, test::make_plan(seeded)[0]), InputError);
}

TEST(Checkpoint, ForeignCheckpointsAreRejected) {
  const auto spec = tiny_spec();
  const auto good = *make_checkpoint(spec, with_a_state(spec));
  EXPECT_NO_THROW(read_checkpoint({good, "c"}, spec));
  const std::vector<std::pair<std::string, Json>> wrong{{"/schema", "isojam.checkpoint.v0"},
                                                        {"/provenance/git", "another"},
                                                        {"/spec/replicate", 1},
                                                        {"/packing/solid", "icosahedron"},
                                                        {"/packing/positions", Json::array()},
                                                        {"/states/0/side", 0.1},
                                                        {"/state_steps/0", 99},
                                                        {"/state_steps", Json::array()},
                                                        {"/lost", 1000}};
  for (const auto& [pointer, value] : wrong) {
    auto bad = good;
    bad[Json::json_pointer(pointer)] = value;
    try {
      read_checkpoint({bad, "c"}, spec);
      FAIL() << pointer << ": " << value;
    } catch (const InputError& error) {
      const auto& said = error.details().pointer;
      // The place is the wrong entry, or the packing or provenance that contains it.
      EXPECT_TRUE(pointer.starts_with(said) || said.starts_with(pointer)) << pointer << ": " << error.what();
    }
  }
  for (const auto& item : good.items()) {
    auto bad = good;
    bad.erase(item.key());
    EXPECT_THROW(read_checkpoint({bad, "c"}, spec), InputError) << "without " << item.key();
  }
}

TEST(Checkpoint, OnlyResidualsMayBeInfinite) {
  const auto spec = tiny_spec();
  auto checkpoint = with_a_state(spec);
  auto& summary = checkpoint.progress.result.path.front().summary;
  summary.residual = std::numeric_limits<double>::infinity();
  const auto again = read_checkpoint({*make_checkpoint(spec, checkpoint), "c"}, spec);
  EXPECT_EQ(again.progress.result.path.front().summary.residual, summary.residual);
  summary.residual = std::numeric_limits<double>::quiet_NaN();
  EXPECT_FALSE(make_checkpoint(spec, checkpoint));
  summary.residual = 0;
  checkpoint.progress.result.path.front().pressure = std::numeric_limits<double>::infinity();
  EXPECT_FALSE(make_checkpoint(spec, checkpoint));
}

}  // namespace
}  // namespace isojam
