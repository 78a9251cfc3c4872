#include "tasks/run/graph.hpp"

#include <gtest/gtest.h>

#include <atomic>
#include <chrono>
#include <map>
#include <new>
#include <stdexcept>
#include <string_view>
#include <thread>

#include "tasks/records/record.hpp"
#include "tests/tasks/run/quiet_stages.hpp"
#include "tests/tasks/support/support.hpp"

namespace isojam {
namespace {

using namespace std::chrono_literals;
using test::one_by_one;
using test::plan_of;
using test::quiet_stages;

/// Behaviour of the made-up stages for a replicate.
enum class Fate { good, begin_throws, jam_throws, jam_ends_early, contacts_throw, contacts_throw_int };

Fate fate_of(const ReplicateSpec& spec) { return static_cast<Fate>(hash_of(replicate_name(spec)) % 6); }

Stages fateful_stages() {
  auto stages = quiet_stages();
  stages.begin = [begin = stages.begin](const ReplicateSpec& spec) {
    if (fate_of(spec) == Fate::begin_throws) throw std::invalid_argument("no room");
    return begin(spec);
  };
  stages.jam = [jam = stages.jam](const ReplicateSpec& spec, JamProgress from, std::stop_token stop,
                                  const OnProgress& on_step) {
    if (fate_of(spec) == Fate::jam_throws) throw std::runtime_error("no jam");
    auto result = jam(spec, std::move(from), std::move(stop), on_step);
    if (fate_of(spec) == Fate::jam_ends_early) result.status = JamStatus::density_limit;
    return result;
  };
  stages.measure = [measure = stages.measure](const ReplicateSpec& spec, Measure what, const JamResult& jam) {
    if (fate_of(spec) == Fate::contacts_throw) throw std::runtime_error("no contacts");
    if (fate_of(spec) == Fate::contacts_throw_int) throw 5;
    return measure(spec, what, jam);
  };
  return stages;
}

std::string expected_failure(Fate fate) {
  switch (fate) {
    case Fate::good: return "";
    case Fate::begin_throws: return "begin: no room";
    case Fate::jam_throws: return "jam: no jam";
    case Fate::jam_ends_early: return "jam: density_limit after 4 strain steps";
    case Fate::contacts_throw: return "contacts: no contacts";
    case Fate::contacts_throw_int: return "contacts: an exception of unknown type";
  }
  return "?";
}

TEST(Graph, EveryReplicateYieldsOneOutcome) {
  const auto plan = plan_of(60);
  for (const int threads : {1, 2, 4}) {
    std::map<std::string, int> seen;
    std::map<Fate, int> fates;
    run_graph(one_by_one(plan), fateful_stages(), {threads, 0, {}, {}}, [&](const Outcome& outcome) {
      ++seen[replicate_name(outcome.spec)];
      const auto fate = fate_of(outcome.spec);
      ++fates[fate];
      EXPECT_FALSE(outcome.interrupted);
      const auto failure = outcome.failure ? outcome.failure->where + ": " + outcome.failure->why : std::string();
      EXPECT_EQ(failure.rfind(expected_failure(fate), 0), 0U) << failure;
      EXPECT_EQ(failure.empty(), fate == Fate::good) << failure;
      EXPECT_GT(outcome.timing.wall_seconds, 0);
    });
    EXPECT_EQ(seen.size(), plan.size());
    for (const auto& [name, times] : seen) EXPECT_EQ(times, 1) << name;
    EXPECT_EQ(fates.size(), 6U) << "the plan must meet every fate";
  }
}

TEST(Graph, ThreadsChangeNoOutcome) {
  const auto plan = plan_of(20);
  std::map<int, std::map<std::string, std::string>> records;
  for (const int threads : {1, 3}) {
    run_graph(one_by_one(plan), fateful_stages(), {threads, 0, {}, {}}, [&](const Outcome& outcome) {
      auto record = make_record(outcome);
      record.erase("timing");
      records[threads][replicate_name(outcome.spec)] = pretty(record);
    });
  }
  EXPECT_EQ(records.at(1), records.at(3));
}

/// Counts the replicates that run at the same time.
class InFlight {
 public:
  /// Stages that wait until `company` replicates run at the same time, but at most for several seconds.
  Stages stages(int company) {
    auto stages = quiet_stages();
    stages.begin = [this, begin = stages.begin](const ReplicateSpec& spec) {
      const int now = ++now_;
      for (int before = most_; now > before && !most_.compare_exchange_weak(before, now);) {
      }
      return begin(spec);
    };
    stages.jam = [this, company, jam = stages.jam](const ReplicateSpec& spec, JamProgress from, std::stop_token stop,
                                                   const OnProgress& on_step) {
      while (most_ < company && patience_-- > 0) std::this_thread::sleep_for(1ms);
      return jam(spec, std::move(from), std::move(stop), on_step);
    };
    return stages;
  }
  void leave() { --now_; }
  int most() const { return most_; }

 private:
  std::atomic<int> now_{0}, most_{0}, patience_{30000};
};

TEST(Graph, AsManyReplicatesAsThreadsAndOneConsumer) {
  for (const int threads : {1, 3}) {
    InFlight in_flight;
    std::atomic<int> consuming{0};
    run_graph(one_by_one(plan_of(30)), in_flight.stages(threads), {threads, 0, {}, {}}, [&](const Outcome&) {
      EXPECT_EQ(++consuming, 1);
      std::this_thread::sleep_for(5ms);
      --consuming;
      in_flight.leave();
    });
    EXPECT_EQ(in_flight.most(), threads);
  }
}

TEST(Graph, StopsPromptly) {
  std::stop_source source;
  std::atomic<int> started{0};
  auto stages = quiet_stages();
  stages.jam = [&](const ReplicateSpec& spec, const JamProgress&, std::stop_token stop, const OnProgress&) {
    ++started;
    if (spec.replicate < 3) return test::made_up_outcome(spec).jam;
    source.request_stop();
    for (int i = 0; i < 30000 && !stop.stop_requested(); ++i) std::this_thread::sleep_for(1ms);
    EXPECT_TRUE(stop.stop_requested());
    JamResult result;
    result.status = JamStatus::interrupted;
    return result;
  };
  int whole = 0, interrupted = 0;
  run_graph(one_by_one(plan_of(1000)), stages, {2, 0, source.get_token(), {}}, [&](const Outcome& outcome) {
    EXPECT_FALSE(outcome.failure) << outcome.failure->why;
    (outcome.interrupted ? interrupted : whole)++;
  });
  EXPECT_GE(interrupted, 1);
  EXPECT_LE(whole, 3);
  EXPECT_EQ(whole + interrupted, started);
  EXPECT_LT(started, 10);
}

TEST(Graph, NothingStartsAfterAStop) {
  std::stop_source source;
  source.request_stop();
  int outcomes = 0;
  run_graph(one_by_one(plan_of(10)), quiet_stages(), {2, 0, source.get_token(), {}},
            [&](const Outcome&) { ++outcomes; });
  EXPECT_EQ(outcomes, 0);
}

TEST(Graph, AResourceFailureIsNotAFailureOfTheReplicate) {
  for (const auto* where : {"begin", "jam", "measure"}) {
    auto stages = quiet_stages();
    const auto lacking = [&](const char* stage) {
      if (std::string_view(stage) == where) throw std::bad_alloc();
    };
    stages.begin = [&, begin = stages.begin](const ReplicateSpec& spec) { return lacking("begin"), begin(spec); };
    stages.jam = [&, jam = stages.jam](const ReplicateSpec& spec, JamProgress from, std::stop_token stop,
                                       const OnProgress& on_progress) {
      return lacking("jam"), jam(spec, std::move(from), std::move(stop), on_progress);
    };
    stages.measure = [&, measure = stages.measure](const ReplicateSpec& spec, Measure what, const JamResult& jam) {
      return lacking("measure"), measure(spec, what, jam);
    };
    int outcomes = 0;
    EXPECT_THROW(run_graph(one_by_one(plan_of(1000)), stages, {2, 0, {}, {}},
                           [&](const Outcome& outcome) {
                             ++outcomes;
                             EXPECT_TRUE(outcome.interrupted) << where;
                             EXPECT_FALSE(outcome.failure) << where;
                           }),
                 std::bad_alloc);
    EXPECT_GE(outcomes, 1) << where;
    EXPECT_LT(outcomes, 100) << where;
  }
}

TEST(Graph, FewerReplicatesThanThreadsIfMemoryRequiresIt) {
  InFlight in_flight;
  run_graph(one_by_one(plan_of(30)), in_flight.stages(2), {4, 2, {}, {}}, [&](const Outcome&) {
    std::this_thread::sleep_for(2ms);
    in_flight.leave();
  });
  EXPECT_EQ(in_flight.most(), 2);
}

TEST(Graph, ReplicatesAreRequestedOnlyWhenTheyCanStart) {
  int asked = 0, done = 0, ahead = 0;
  const auto specs = plan_of(200);
  const NextReplicate next = [&]() -> std::optional<ReplicateSpec> {
    ahead = std::max(ahead, asked - done);
    return asked < 200 ? std::optional(specs[static_cast<std::size_t>(asked++)]) : std::nullopt;
  };
  run_graph(next, quiet_stages(), {1, 0, {}, {}}, [&](const Outcome&) { ++done; });
  EXPECT_EQ(done, 200);
  EXPECT_LE(ahead, 4) << "specifications pile up";
}

TEST(Graph, ExceptionsOfCallbacksReachTheCaller) {
  const auto fault = [] { return std::runtime_error("disk full"); };
  const NextReplicate next = [&]() -> std::optional<ReplicateSpec> { throw fault(); };
  EXPECT_THROW(run_graph(next, quiet_stages(), {2, 0, {}, {}}, [](const Outcome&) {}), std::runtime_error);
  auto stages = quiet_stages();
  stages.jam = [](const ReplicateSpec& spec, const JamProgress& from, std::stop_token, const OnProgress& on_progress) {
    on_progress(from);
    return test::made_up_outcome(spec).jam;
  };
  std::atomic<int> steps{0};
  const GraphOptions options{2, 0, {}, [&](const ReplicateSpec&, const Checkpoint&) {
                               ++steps;
                               throw fault();
                             }};
  EXPECT_THROW(run_graph(one_by_one(plan_of(1000)), stages, options, [](const Outcome&) {}), std::runtime_error);
  EXPECT_GE(steps, 1);
  EXPECT_LT(steps, 100);
}

TEST(Graph, TimeSpentBeforeIsCounted) {
  auto stages = quiet_stages();
  stages.begin = [begin = stages.begin](const ReplicateSpec& spec) {
    auto checkpoint = begin(spec);
    checkpoint.spent = {1000, 500};
    return checkpoint;
  };
  run_graph(one_by_one(plan_of(1)), stages, {1, 0, {}, {}}, [](const Outcome& outcome) {
    EXPECT_GE(outcome.timing.wall_seconds, 1000);
    EXPECT_GE(outcome.timing.cpu_seconds, 500);
    EXPECT_LT(outcome.timing.cpu_seconds, 1000);
    double stages_together = 0;
    for (const auto& [stage, seconds] : outcome.stage_seconds) stages_together += seconds;
    EXPECT_GE(outcome.stage_seconds.at("jam"), 500);
    EXPECT_EQ(outcome.stage_seconds.size(), 1 + outcome.measured.size());
    EXPECT_NEAR(stages_together, outcome.timing.cpu_seconds, 1e-9 * stages_together);
  });
}

TEST(Graph, AnExceptionOfTheConsumerReachesTheCaller) {
  int outcomes = 0;
  const auto run = [&] {
    run_graph(one_by_one(plan_of(1000)), quiet_stages(), {2, 0, {}, {}}, [&](const Outcome&) {
      if (++outcomes == 3) throw std::runtime_error("disk full");
    });
  };
  EXPECT_THROW(run(), std::runtime_error);
  EXPECT_LT(outcomes, 100);
}

}  // namespace
}  // namespace isojam
