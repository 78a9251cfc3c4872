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

}  // namespace
}  // namespace isojam
