#include <gtest/gtest.h>

#include <array>
#include <atomic>
#include <chrono>
#include <mutex>
#include <stdexcept>
#include <thread>

#include "engine/parallel/parallel.hpp"
#include "tests/tasks/run/quiet_stages.hpp"

namespace isojam {
namespace {

using namespace std::chrono_literals;
using test::one_by_one;
using test::plan_of;
using test::quiet_stages;

TEST(GraphMeasures, NoMeasureIfNoneIsRequested) {
  auto plan = plan_of(3);
  for (auto& spec : plan) spec.measures.clear();
  auto stages = quiet_stages();
  stages.measure = [](const ReplicateSpec&, Measure, const JamResult&) -> Measurement {
    throw std::logic_error("not asked for");
  };
  int outcomes = 0;
  run_graph(one_by_one(plan), stages, {2, 0, {}, {}}, [&](const Outcome& outcome) {
    ++outcomes;
    EXPECT_FALSE(outcome.failure);
    EXPECT_FALSE(outcome.interrupted);
    EXPECT_TRUE(outcome.measured.empty());
  });
  EXPECT_EQ(outcomes, 3);
}

/// One replicate with these measures.
std::vector<ReplicateSpec> one_measured_by(std::vector<Measure> measures) {
  auto plan = plan_of(1);
  plan.front().measures = std::move(measures);
  return plan;
}

/// A point where two threads wait for each other.
class Rendezvous {
 public:
  bool met() {
    ++arrived_;
    for (int i = 0; i < 5000 && arrived_ < 2; ++i) std::this_thread::sleep_for(1ms);
    return arrived_ >= 2;
  }

 private:
  std::atomic<int> arrived_{0};
};

TEST(GraphMeasures, MeasuresOfAReplicateRunAtTheSameTime) {
  std::array<std::atomic<const JamResult*>, 2> read{};
  Rendezvous rendezvous;
  auto stages = quiet_stages();
  stages.measure = [&](const ReplicateSpec&, Measure what, const JamResult& jam) {
    read.at(what == Measure::order) = &jam;
    EXPECT_TRUE(rendezvous.met()) << "nobody else measures";
    return Measurement{};
  };
  run_graph(one_by_one(one_measured_by({Measure::contacts, Measure::order})), stages, {2, 0, {}, {}},
            [](const Outcome& outcome) { EXPECT_EQ(outcome.measured.size(), 2U); });
  EXPECT_NE(read[0], nullptr);
  EXPECT_EQ(read[0], read[1]) << "the result is copied for each measure";
}

TEST(GraphMeasures, AThreadWithoutAMeasureHelpsInsideAnother) {
  Rendezvous rendezvous;
  auto stages = quiet_stages();
  stages.measure = [&](const ReplicateSpec&, Measure what, const JamResult&) {
    if (what == Measure::order)
      for_each_index(2, [&](std::size_t) { EXPECT_TRUE(rendezvous.met()) << "the other thread waits"; });
    return Measurement{};
  };
  int outcomes = 0;
  run_graph(one_by_one(one_measured_by({Measure::contacts, Measure::order})), stages, {2, 0, {}, {}},
            [&](const Outcome&) { ++outcomes; });
  EXPECT_EQ(outcomes, 1);
}

TEST(GraphMeasures, AStopLeavesOutMeasures) {
  std::stop_source source;
  auto stages = quiet_stages();
  stages.measure = [&](const ReplicateSpec&, Measure, const JamResult&) {
    source.request_stop();
    return Measurement{};
  };
  int outcomes = 0;
  run_graph(one_by_one(one_measured_by({Measure::contacts, Measure::order})), stages, {1, 0, source.get_token(), {}},
            [&](const Outcome& outcome) {
              ++outcomes;
              EXPECT_TRUE(outcome.interrupted);
              EXPECT_FALSE(outcome.failure);
              EXPECT_EQ(outcome.measured.size(), 1U);
            });
  EXPECT_EQ(outcomes, 1);
}

}  // namespace
}  // namespace isojam
