// Why a graph and not a parallel_for over replicates: the stages differ in memory and cost, measurements that do not
// depend on each other run side by side, and writing to disk is serial. The limiter holds back what is in flight,
// since each replicate keeps all packings of its expansion until it is stored. When fewer replicates are left than
// threads, the pair loop inside a stage takes the idle ones.

#include "tasks/graph.hpp"

#include <tbb/flow_graph.h>
#include <tbb/global_control.h>
#include <tbb/info.h>
#include <tbb/task_arena.h>

#include <chrono>
#include <ctime>
#include <exception>
#include <tuple>
#include <utility>
#include <vector>

namespace isojam {
namespace {

namespace flow = tbb::flow;

/// What a stage passes on: its value, or the failure of this stage or an earlier one.
template <class T>
struct Passed {
  std::size_t index = 0;
  std::optional<T> value;
  std::optional<Failure> failure;
  Timing timing;
};

using Placed = Passed<Packing>;
using Jammed = Passed<JamResult>;
using Measured = Passed<std::vector<ContactAnalysis>>;

double thread_cpu_seconds() {
  timespec now{};
  clock_gettime(CLOCK_THREAD_CPUTIME_ID, &now);
  return static_cast<double>(now.tv_sec) + 1e-9 * static_cast<double>(now.tv_nsec);
}

/// Runs a stage of a replicate: measures its time and turns what it throws into a failure.
template <class T, class Stage>
Passed<T> guarded(std::size_t index, const char* where, const Stage& stage) {
  Passed<T> passed;
  passed.index = index;
  const auto wall = std::chrono::steady_clock::now();
  const double cpu = thread_cpu_seconds();
  try {
    passed.value = stage();
  } catch (const std::exception& error) {
    passed.failure = Failure{where, error.what()};
  } catch (...) {
    passed.failure = Failure{where, "an exception of unknown type"};
  }
  passed.timing = {std::chrono::duration<double>(std::chrono::steady_clock::now() - wall).count(),
                   thread_cpu_seconds() - cpu};
  return passed;
}

Timing operator+(const Timing& a, const Timing& b) {
  return {a.wall_seconds + b.wall_seconds, a.cpu_seconds + b.cpu_seconds};
}

/// One run over a plan; the bodies of the nodes.
class Run {
 public:
  Run(std::span<const ReplicateSpec> plan, const Stages& stages, const GraphOptions& options,
      const std::function<void(const Outcome&)>& on_outcome)
      : plan_(plan), stages_(stages), options_(options), on_outcome_(on_outcome), forward_stop_(options.stop, [this] {
          stop_.request_stop();
        }) {}

  std::size_t next(tbb::flow_control& control) {
    if (next_ == plan_.size() || stop_.stop_requested()) control.stop();
    return next_++;
  }

  Placed place(std::size_t index) const {
    return guarded<Packing>(index, "place", [&] { return stages_.place(plan_[index]); });
  }

  Jammed jam(const Placed& placed) const {
    if (!placed.value) return {placed.index, std::nullopt, placed.failure, placed.timing};
    const auto& spec = plan_[placed.index];
    const OnStep on_step = [&](const JamStep& step) {
      if (options_.on_step) options_.on_step(spec, step);
    };
    auto jammed = guarded<JamResult>(placed.index, "jam",
                                     [&] { return stages_.jam(spec, *placed.value, stop_.get_token(), on_step); });
    if (jammed.value && jammed.value->status != JamStatus::interrupted) jammed.failure = failure_of(*jammed.value);
    jammed.timing = jammed.timing + placed.timing;
    return jammed;
  }

  Measured contacts(const Jammed& jammed) const {
    const auto& spec = plan_[jammed.index];
    const bool wanted = std::find(spec.measures.begin(), spec.measures.end(), Measure::contacts) != spec.measures.end();
    if (!wanted || !jammed.value || stop_.stop_requested()) return {jammed.index, {}, {}, {}};
    return guarded<std::vector<ContactAnalysis>>(jammed.index, "contacts",
                                                 [&] { return stages_.contacts(spec, *jammed.value); });
  }

  void store(const Jammed& jammed, const Measured& measured) {
    Outcome outcome;
    outcome.spec = plan_[jammed.index];
    outcome.failure = jammed.failure ? jammed.failure : measured.failure;
    outcome.timing = jammed.timing + measured.timing;
    if (jammed.value) outcome.jam = *jammed.value;
    if (measured.value) outcome.contacts = *measured.value;
    outcome.interrupted = outcome.jam.status == JamStatus::interrupted || skipped(jammed, measured);
    try {
      on_outcome_(outcome);
    } catch (...) {
      if (!error_) error_ = std::current_exception();
      stop_.request_stop();
    }
  }

  void rethrow() const {
    if (error_) std::rethrow_exception(error_);
  }

 private:
  /// A measurement was left out because of a stop request.
  bool skipped(const Jammed& jammed, const Measured& measured) const {
    return jammed.value && !plan_[jammed.index].measures.empty() && !measured.value && !measured.failure;
  }

  std::span<const ReplicateSpec> plan_;
  const Stages& stages_;
  const GraphOptions& options_;
  const std::function<void(const Outcome&)>& on_outcome_;
  std::stop_source stop_;
  std::stop_callback<std::function<void()>> forward_stop_;
  std::size_t next_ = 0;      // touched by the input node alone
  std::exception_ptr error_;  // touched by the serial store node alone
};

void build_and_wait(Run& run, int in_flight) {
  using Both = std::tuple<Jammed, Measured>;
  flow::graph graph;
  flow::input_node<std::size_t> input(graph, [&](tbb::flow_control& control) { return run.next(control); });
  flow::limiter_node<std::size_t> limiter(graph, static_cast<std::size_t>(in_flight));
  flow::function_node<std::size_t, Placed> place(graph, flow::unlimited, [&](std::size_t i) { return run.place(i); });
  flow::function_node<Placed, Jammed> jam(graph, flow::unlimited, [&](const Placed& p) { return run.jam(p); });
  flow::function_node<Jammed, Measured> contacts(graph, flow::unlimited,
                                                 [&](const Jammed& j) { return run.contacts(j); });
  flow::join_node<Both, flow::key_matching<std::size_t>> join(
      graph, [](const Jammed& j) { return j.index; }, [](const Measured& m) { return m.index; });
  flow::function_node<Both> store(graph, flow::serial, [&](const Both& both) {
    run.store(std::get<Jammed>(both), std::get<Measured>(both));
    return flow::continue_msg();
  });

  flow::make_edge(input, limiter);
  flow::make_edge(limiter, place);
  flow::make_edge(place, jam);
  flow::make_edge(jam, flow::input_port<0>(join));
  flow::make_edge(jam, contacts);
  flow::make_edge(contacts, flow::input_port<1>(join));
  flow::make_edge(join, store);
  flow::make_edge(store, limiter.decrementer());
  input.activate();
  graph.wait_for_all();
}

}  // namespace

void run_graph(std::span<const ReplicateSpec> plan, const Stages& stages, const GraphOptions& options,
               const std::function<void(const Outcome&)>& on_outcome) {
  const int threads = options.threads > 0 ? options.threads : tbb::info::default_concurrency();
  const tbb::global_control limit(tbb::global_control::max_allowed_parallelism, static_cast<std::size_t>(threads));
  tbb::task_arena arena(threads);
  Run run(plan, stages, options, on_outcome);
  arena.execute([&] { build_and_wait(run, threads); });
  run.rethrow();
}

}  // namespace isojam
