// This is a flow graph instead of a parallel loop over replicates, because the stages differ in memory and cost, and
// files are written one after the other. The limiter bounds the number of replicates in memory, because each of them
// keeps all packings of its decompression until its outcome is stored. All measures of a replicate are tasks of one
// node, and no thread waits for another one to finish a measure. If fewer replicates than threads are left, idle
// threads help in the pair loops of the stages.

#include "tasks/run/graph.hpp"

#include <tbb/flow_graph.h>
#include <tbb/global_control.h>
#include <tbb/info.h>
#include <tbb/task_arena.h>

#include <algorithm>
#include <atomic>
#include <chrono>
#include <exception>
#include <memory>
#include <mutex>
#include <new>
#include <thread>
#include <tuple>
#include <utility>
#include <vector>

#include "tasks/io/resource_failure.hpp"
#include "tasks/io/thread_clock.hpp"

namespace isojam {
namespace {

namespace flow = tbb::flow;

/// Result of a stage: a value or a failure. If the run was stopped, it has neither.
template <class T>
struct StageResult {
  std::optional<T> value;
  std::optional<Failure> failure;
  Timing timing;
};

struct Started {
  ReplicateSpec spec;
  StageResult<Checkpoint> start;
};

struct Jammed {
  ReplicateSpec spec;
  StageResult<JamResult> jam;  ///< its timing includes `begin` and interrupted runs
};

/// A replicate whose measures are being computed. All use the same jammed result, and each writes to its own slot.
struct Measuring {
  std::shared_ptr<const Jammed> jammed;
  std::vector<StageResult<Measurement>>
      results;  ///< a slot for each of spec.measures; empty if the replicate did not jam
  std::atomic<std::size_t> tasks_left = 0;
};

struct MeasureTask {
  std::shared_ptr<Measuring> replicate;
  std::size_t slot = 0;
};

template <class T>
bool is_missing(const StageResult<T>& result) {
  return !result.value && !result.failure;
}

/// Wall-clock time, and CPU time of this thread, since the construction.
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

/// One call of run_graph(). Its member functions are the bodies of the nodes.
class Run {
 public:
  Run(const NextReplicate& next, const Stages& stages, const GraphOptions& options,
      const std::function<void(const Outcome&)>& on_outcome)
      : next_(next), stages_(stages), options_(options), on_outcome_(on_outcome), forward_stop_(options.stop, [this] {
          stop_.request_stop();
        }) {}

  ReplicateSpec next(tbb::flow_control& control) {
    std::optional<ReplicateSpec> spec;
    if (!stop_.stop_requested()) {
      catch_callback_error([&] { spec = next_(); });
    }
    if (spec) return *std::move(spec);
    control.stop();
    return {};
  }

  std::shared_ptr<const Started> begin(const ReplicateSpec& spec) {
    return std::make_shared<Started>(
        Started{spec, run_stage<Checkpoint>("begin", [&] { return stages_.begin(spec); })});
  }

  std::shared_ptr<const Jammed> jam(const Started& started) {
    const auto& start = started.start;
    if (!start.value) return std::make_shared<Jammed>(Jammed{started.spec, {{}, start.failure, start.timing}});
    const auto before = start.timing + start.value->spent;
    const Stopwatch watch;
    const OnProgress on_progress = [&](const JamProgress& progress) {
      if (!options_.on_step) return;
      catch_callback_error([&] { options_.on_step(started.spec, {progress, before + watch.elapsed()}); });
    };
    auto jam = run_stage<JamResult>(
        "jam", [&] { return stages_.jam(started.spec, start.value->progress, stop_.get_token(), on_progress); });
    if (jam.value && jam.value->status != JamStatus::interrupted) jam.failure = failure_of(*jam.value);
    jam.timing = jam.timing + before;
    return std::make_shared<Jammed>(Jammed{started.spec, std::move(jam)});
  }

  void measure(const MeasureTask& task) {
    const Jammed& jammed = *task.replicate->jammed;
    auto& results = task.replicate->results;
    if (task.slot == results.size() || stop_.stop_requested()) return;
    const auto what = jammed.spec.measures[task.slot];
    results[task.slot] =
        run_stage<Measurement>(to_string(what), [&] { return stages_.measure(jammed.spec, what, *jammed.jam.value); });
  }

  void store(const Measuring& measuring) {
    const auto& [spec, jam] = *measuring.jammed;
    Outcome outcome;
    outcome.spec = spec;
    outcome.failure = jam.failure;
    outcome.timing = jam.timing;
    outcome.stage_seconds["jam"] = jam.timing.cpu_seconds;
    if (jam.value) outcome.jam = *jam.value;
    outcome.interrupted = outcome.jam.status == JamStatus::interrupted || is_missing(jam);
    for (std::size_t k = 0; k < measuring.results.size(); ++k) {
      const auto& result = measuring.results[k];
      outcome.timing = outcome.timing + result.timing;
      if (result.value) {
        outcome.measured[spec.measures[k]] = *result.value;
        outcome.stage_seconds[std::string(to_string(spec.measures[k]))] = result.timing.cpu_seconds;
      }
      if (!outcome.failure) outcome.failure = result.failure;
      outcome.interrupted |= is_missing(result);
    }
    catch_callback_error([&] { on_outcome_(outcome); });
  }

  void end() { stop_.request_stop(); }
  void rethrow() const {
    if (error_) std::rethrow_exception(error_);
  }

 private:
  /// Runs a stage of a replicate, measures its time, and turns an exception into a failure. A resource failure is not a
  /// failure of the replicate: it ends the run, and the result then has neither value nor failure.
  template <class T, class Stage>
  StageResult<T> run_stage(std::string_view where, const Stage& stage) {
    StageResult<T> result;
    const Stopwatch watch;
    try {
      result.value = stage();
    } catch (const std::exception& error) {
      if (is_resource_failure(error)) {
        keep(std::current_exception());
      } else {
        result.failure = Failure{std::string(where), error.what()};
      }
    } catch (...) {
      result.failure = Failure{std::string(where), "an exception of unknown type"};
    }
    result.timing = watch.elapsed();
    return result;
  }

  /// Keeps exceptions of the caller's functions, which must not leave the graph.
  void catch_callback_error(const std::function<void()>& call) {
    try {
      call();
    } catch (...) {
      keep(std::current_exception());
    }
  }

  /// Keeps the first error, which run_graph() throws at the end, and ends the run.
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
  std::mutex error_mutex_;
  std::exception_ptr error_;
};

/// Waits until all tasks have ended after an exception. The nodes are destroyed before the graph, so no task may still
/// use them. If waiting fails again and again for lack of memory, the program ends.
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

/// One task for each measure of the replicate. If it has no measures, one task that only passes the replicate on.
std::vector<MeasureTask> measure_tasks(std::shared_ptr<const Jammed> jammed) {
  const auto replicate = std::make_shared<Measuring>();
  replicate->results.resize(jammed->jam.value ? jammed->spec.measures.size() : 0);
  replicate->tasks_left = std::max<std::size_t>(replicate->results.size(), 1);
  replicate->jammed = std::move(jammed);
  std::vector<MeasureTask> tasks;
  for (std::size_t slot = 0; slot < replicate->tasks_left; ++slot) tasks.push_back({replicate, slot});
  return tasks;
}

void build_and_wait(Run& run, int in_flight) {
  using JamNode = flow::multifunction_node<std::shared_ptr<const Started>, std::tuple<MeasureTask>>;
  using MeasureNode = flow::multifunction_node<MeasureTask, std::tuple<std::shared_ptr<const Measuring>>>;
  flow::graph graph;
  flow::input_node<ReplicateSpec> input(graph, [&](tbb::flow_control& control) { return run.next(control); });
  flow::limiter_node<ReplicateSpec> limiter(graph, static_cast<std::size_t>(in_flight));
  flow::function_node<ReplicateSpec, std::shared_ptr<const Started>> begin(
      graph, flow::unlimited, [&](const ReplicateSpec& spec) { return run.begin(spec); });
  JamNode jam(graph, flow::unlimited, [&](const auto& started, JamNode::output_ports_type& ports) {
    for (const auto& task : measure_tasks(run.jam(*started))) std::get<0>(ports).try_put(task);
  });
  MeasureNode measure(graph, flow::unlimited, [&](const MeasureTask& task, MeasureNode::output_ports_type& ports) {
    run.measure(task);
    // The task that finishes last passes the results of all measures on.
    if (--task.replicate->tasks_left == 0) std::get<0>(ports).try_put(task.replicate);
  });
  flow::function_node<std::shared_ptr<const Measuring>> store(graph, flow::serial, [&](const auto& measuring) {
    run.store(*measuring);
    return flow::continue_msg();
  });

  flow::make_edge(input, limiter);
  flow::make_edge(limiter, begin);
  flow::make_edge(begin, jam);
  flow::make_edge(flow::output_port<0>(jam), measure);
  flow::make_edge(flow::output_port<0>(measure), store);
  flow::make_edge(store, limiter.decrementer());
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
  // oneTBB 2022 waits forever if an allocation fails while it makes the arena. The arena needs less than 4 MiB. If this
  // memory is not available, the next line throws std::bad_alloc before the arena is made.
  void* volatile room = ::operator new (std::size_t{4} << 20);
  ::operator delete(room);
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
