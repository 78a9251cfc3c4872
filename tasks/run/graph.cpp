// Why a graph and not a parallel_for over replicates: the stages differ in memory and cost, measurements that do not
// depend on each other run side by side, and writing to disk is serial. The limiter holds back what is in flight,
// since each replicate keeps all packings of its expansion until it is stored. When fewer replicates are left than
// threads, the pair loop inside a stage takes the idle ones.

#include "tasks/run/graph.hpp"

#include <tbb/flow_graph.h>
#include <tbb/global_control.h>
#include <tbb/info.h>
#include <tbb/task_arena.h>

#include <array>
#include <chrono>
#include <exception>
#include <map>
#include <memory>
#include <mutex>
#include <thread>
#include <tuple>
#include <utility>
#include <variant>
#include <vector>

#include "tasks/system/shortage.hpp"
#include "tasks/system/thread_clock.hpp"

namespace isojam {
namespace {

namespace flow = tbb::flow;

/// What a stage passes on: its value, or the failure of this stage or an earlier one.
template <class T>
struct Passed {
  std::size_t index = 0;  ///< the order in which replicates were begun, by which results of one meet
  ReplicateSpec spec;
  std::optional<T> value;
  std::optional<Failure> failure;
  Timing timing;
};

struct Begun {};
using Input = Passed<Begun>;
using Placed = Passed<Checkpoint>;
using Jammed = Passed<JamResult>;
using Measured = Passed<Measurement>;  ///< neither value nor failure: not asked for, or stopped

/// Wall clock and this thread's since it was made.
class Stopwatch {
 public:
  Timing elapsed() const {
    return {std::chrono::duration<double>(std::chrono::steady_clock::now() - wall_).count(),
            thread_cpu_seconds() - cpu_};
  }

 private:
  std::chrono::steady_clock::time_point wall_ = std::chrono::steady_clock::now();
  double cpu_ = thread_cpu_seconds();
};

Timing operator+(const Timing& a, const Timing& b) {
  return {a.wall_seconds + b.wall_seconds, a.cpu_seconds + b.cpu_seconds};
}

/// One run; the bodies of the nodes.
class Run {
 public:
  Run(const NextReplicate& next, const Stages& stages, const GraphOptions& options,
      const std::function<void(const Outcome&)>& on_outcome)
      : next_(next), stages_(stages), options_(options), on_outcome_(on_outcome), forward_stop_(options.stop, [this] {
          stop_.request_stop();
        }) {}

  Input next(tbb::flow_control& control) {
    std::optional<ReplicateSpec> spec;
    if (!stop_.stop_requested()) {
      sheltered([&] { spec = next_(); });
    }
    if (spec) return {begun_++, *spec, Begun{}, {}, {}};
    control.stop();
    return {};
  }

  Placed begin(const Input& input) {
    return guarded<Checkpoint>(input, "begin", [&] { return stages_.begin(input.spec); });
  }

  Jammed jam(const Placed& placed) {
    if (!placed.value) return {placed.index, placed.spec, std::nullopt, placed.failure, placed.timing};
    const auto before = placed.timing + placed.value->spent;
    const Stopwatch watch;
    const OnProgress on_progress = [&](const JamProgress& progress) {
      if (!options_.on_step) return;
      sheltered([&] { options_.on_step(placed.spec, {progress, before + watch.elapsed()}); });
    };
    auto jammed = guarded<JamResult>(placed, "jam", [&] {
      return stages_.jam(placed.spec, placed.value->progress, stop_.get_token(), on_progress);
    });
    if (jammed.value && jammed.value->status != JamStatus::interrupted) jammed.failure = failure_of(*jammed.value);
    jammed.timing = jammed.timing + before;
    return jammed;
  }

  Measured measure(Measure what, const Jammed& jammed) {
    if (!asked(what, jammed) || stop_.stop_requested()) return {jammed.index, {}, {}, {}, {}};
    return guarded<Measurement>(jammed, to_string(what),
                                [&] { return stages_.measure(jammed.spec, what, *jammed.value); });
  }

  /// `measured[k]` is that of all_measures[k].
  void store(const Jammed& jammed, const std::array<const Measured*, all_measures.size()>& measured) {
    Outcome outcome;
    outcome.spec = jammed.spec;
    outcome.failure = jammed.failure;
    outcome.timing = jammed.timing;
    outcome.stage_seconds["jam"] = jammed.timing.cpu_seconds;
    if (jammed.value) outcome.jam = *jammed.value;
    // Without result or failure it was the machine that could not go on.
    outcome.interrupted = outcome.jam.status == JamStatus::interrupted || (!jammed.value && !jammed.failure);
    for (std::size_t k = 0; k < measured.size(); ++k) {
      const Measured& one = *measured[k];
      outcome.timing = outcome.timing + one.timing;
      if (one.value) {
        outcome.measured[all_measures[k]] = *one.value;
        outcome.stage_seconds[std::string(to_string(all_measures[k]))] = one.timing.cpu_seconds;
      }
      if (one.failure && !outcome.failure) outcome.failure = one.failure;
      // Left out because of a stop request.
      outcome.interrupted |= asked(all_measures[k], jammed) && !one.value && !one.failure;
    }
    sheltered([&] { on_outcome_(outcome); });
  }

  void end() { stop_.request_stop(); }
  void rethrow() const {
    if (error_) std::rethrow_exception(error_);
  }

 private:
  bool asked(Measure what, const Jammed& jammed) const {
    const auto& measures = jammed.spec.measures;
    return jammed.value && std::find(measures.begin(), measures.end(), what) != measures.end();
  }

  /// Runs a stage of a replicate: measures its time and turns what it throws into a failure. What the machine lacks is
  /// none of the replicate's: it ends the run, and leaves neither value nor failure.
  template <class T, class From, class Stage>
  Passed<T> guarded(const From& from, std::string_view where, const Stage& stage) {
    Passed<T> passed{from.index, from.spec, {}, {}, {}};
    const Stopwatch watch;
    try {
      passed.value = stage();
    } catch (const std::exception& error) {
      if (is_shortage(error)) {
        keep(std::current_exception());
      } else {
        passed.failure = Failure{std::string(where), error.what()};
      }
    } catch (...) {
      passed.failure = Failure{std::string(where), "an exception of unknown type"};
    }
    passed.timing = watch.elapsed();
    return passed;
  }

  /// What the caller's functions throw must not cross the graph.
  void sheltered(const std::function<void()>& call) {
    try {
      call();
    } catch (...) {
      keep(std::current_exception());
    }
  }

  /// The first error is thrown from run_graph, and each ends the run.
  void keep(const std::exception_ptr& error) {
    const std::lock_guard lock(error_mutex_);
    if (!error_) error_ = error;
    stop_.request_stop();
  }

  const NextReplicate& next_;
  const Stages& stages_;
  const GraphOptions& options_;
  const std::function<void(const Outcome&)>& on_outcome_;
  std::stop_source stop_;
  std::stop_callback<std::function<void()>> forward_stop_;
  std::size_t begun_ = 0;  // touched by the input node alone
  std::mutex error_mutex_;
  std::exception_ptr error_;
};

/// The result of one stage of a replicate, on its way to where all of them meet.
struct Part {
  std::size_t index = 0;
  std::size_t place = 0;  ///< 0: of jam; k + 1: of all_measures[k]
  std::variant<Jammed, Measured> result;
};

/// What has come in of the replicates under way. (A join_node of oneTBB has ten ports, fewer than there are measures.)
class Meeting {
 public:
  /// Stores the replicate of which this is the last part; whether it is.
  bool add(const Part& part, Run& run) {
    Replicate& replicate = under_way_[part.index];
    if (part.place == 0) {
      replicate.jammed = std::get<Jammed>(part.result);
    } else {
      replicate.measured[part.place - 1] = std::get<Measured>(part.result);
    }
    if (++replicate.parts <= all_measures.size()) return false;
    std::array<const Measured*, all_measures.size()> measured{};
    for (std::size_t k = 0; k < measured.size(); ++k) measured[k] = &replicate.measured[k];
    run.store(replicate.jammed, measured);
    under_way_.erase(part.index);
    return true;
  }

 private:
  struct Replicate {
    Jammed jammed;
    std::array<Measured, all_measures.size()> measured;
    std::size_t parts = 0;
  };
  std::map<std::size_t, Replicate> under_way_;
};

/// Ends what an exception has left: the nodes go before the graph does, and none of its tasks may still find them.
/// The program ends where there is no memory even to wait.
void drain(flow::graph& graph) {
  constexpr int attempts = 100;
  graph.cancel();
  for (int k = 1;; ++k) {
    try {
      graph.wait_for_all();
      return;
    } catch (const std::exception&) {
      if (k == attempts) std::terminate();
      std::this_thread::sleep_for(std::chrono::milliseconds(10));
    }
  }
}

void build_and_wait(Run& run, int in_flight) {
  using PartNode = flow::function_node<Jammed, Part>;
  using MeetingNode = flow::multifunction_node<Part, std::tuple<flow::continue_msg>>;
  flow::graph graph;
  flow::input_node<Input> input(graph, [&](tbb::flow_control& control) { return run.next(control); });
  flow::limiter_node<Input> limiter(graph, static_cast<std::size_t>(in_flight));
  flow::function_node<Input, Placed> begin(graph, flow::unlimited, [&](const Input& i) { return run.begin(i); });
  flow::function_node<Placed, Jammed> jam(graph, flow::unlimited, [&](const Placed& p) { return run.jam(p); });
  Meeting meeting;
  MeetingNode store(graph, flow::serial, [&](const Part& part, MeetingNode::output_ports_type& ports) {
    if (meeting.add(part, run)) std::get<0>(ports).try_put(flow::continue_msg());
  });
  std::vector<std::unique_ptr<PartNode>> parts;
  parts.push_back(std::make_unique<PartNode>(graph, flow::unlimited, [](const Jammed& j) {
    return Part{j.index, 0, j};
  }));
  for (std::size_t k = 0; k < all_measures.size(); ++k) {
    parts.push_back(std::make_unique<PartNode>(graph, flow::unlimited, [&run, k](const Jammed& j) {
      return Part{j.index, k + 1, run.measure(all_measures[k], j)};
    }));
  }

  flow::make_edge(input, limiter);
  flow::make_edge(limiter, begin);
  flow::make_edge(begin, jam);
  for (const auto& part : parts) {
    flow::make_edge(jam, *part);
    flow::make_edge(*part, store);
  }
  flow::make_edge(flow::output_port<0>(store), limiter.decrementer());
  try {
    input.activate();
    graph.wait_for_all();
  } catch (...) {
    run.end();
    drain(graph);
    throw;
  }
}

}  // namespace

int default_threads() { return tbb::info::default_concurrency(); }

void with_threads(int threads, const std::function<void()>& work) {
  const tbb::global_control limit(tbb::global_control::max_allowed_parallelism, static_cast<std::size_t>(threads));
  tbb::task_arena arena(threads);
  arena.execute(work);
}

void run_graph(const NextReplicate& next, const Stages& stages, const GraphOptions& options,
               const std::function<void(const Outcome&)>& on_outcome) {
  const int threads = options.threads > 0 ? options.threads : default_threads();
  Run run(next, stages, options, on_outcome);
  with_threads(threads, [&] { build_and_wait(run, options.in_flight > 0 ? options.in_flight : threads); });
  run.rethrow();
}

}  // namespace isojam
