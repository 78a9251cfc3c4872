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
#include <type_traits>
#include <utility>
#include <vector>

#include "tasks/io/resource_failure.hpp"
#include "tasks/io/thread_clock.hpp"

namespace isojam {
namespace {

namespace flow = tbb::flow;

/// A replicate on its way through the graph.
struct Replicate {
  /// Result of a measure. If the run was stopped, it has neither value nor failure.
  struct Part {
    std::optional<Measurement> value;
    std::optional<Failure> failure;
    Timing timing;
  };

  Outcome outcome;                       ///< what the stages have added so far
  std::optional<Checkpoint> start;       ///< progress from which the stage "jam" begins
  std::vector<Part> parts;               ///< of all measures; each writes to its own part
  std::atomic<std::size_t> started = 0;  ///< number of measures that have started
  std::size_t ended = 0;                 ///< number of measures that have reached the node `join`
};
using Message = std::shared_ptr<Replicate>;

/// One call of run_graph().
class Run {
 public:
  Run(const NextReplicate& next, const Stages& stages, const GraphOptions& options,
      const std::function<void(const Outcome&)>& on_outcome)
      : next_(next), stages_(stages), options_(options), on_outcome_(on_outcome), forward_stop_(options.stop, [this] {
          stop_.request_stop();
        }) {}

  /// specs → limiter → begin → jam ⇉ measure → join → store → limiter. If there is nothing to measure, jam → store.
  void wait_for_all(int in_flight) {
    using Jam = flow::multifunction_node<Message, std::tuple<Message, Message>>;
    using Join = flow::multifunction_node<Message, std::tuple<Message>>;
    flow::graph graph;
    flow::input_node<Message> specs(graph, [this](tbb::flow_control& control) { return next(control); });
    flow::limiter_node<Message> limiter(graph, static_cast<std::size_t>(in_flight));
    flow::function_node<Message, Message> begin(graph, flow::unlimited, [this](Message replicate) {
      this->begin(*replicate);
      return replicate;
    });
    Jam jam(graph, flow::unlimited, [this](const Message& replicate, Jam::output_ports_type& ports) {
      this->jam(*replicate);
      const std::size_t measures = replicate->parts.size();
      for (std::size_t k = 0; k < measures; ++k) std::get<0>(ports).try_put(replicate);
      if (measures == 0) std::get<1>(ports).try_put(replicate);
    });
    flow::function_node<Message, Message> measure(graph, flow::unlimited, [this](Message replicate) {
      this->measure(*replicate);
      return replicate;
    });
    Join join(graph, flow::serial, [](const Message& replicate, Join::output_ports_type& ports) {
      if (++replicate->ended < replicate->parts.size()) return;
      add_parts(*replicate);
      std::get<0>(ports).try_put(replicate);
    });
    flow::function_node<Message> store(graph, flow::serial, [this](const Message& replicate) {
      catch_callback_error([&] { on_outcome_(replicate->outcome); });
      return flow::continue_msg();
    });

    flow::make_edge(specs, limiter);
    flow::make_edge(limiter, begin);
    flow::make_edge(begin, jam);
    flow::make_edge(flow::output_port<0>(jam), measure);
    flow::make_edge(flow::output_port<1>(jam), store);
    flow::make_edge(measure, join);
    flow::make_edge(flow::output_port<0>(join), store);
    flow::make_edge(store, limiter.decrementer());
    try {
      specs.activate();
      graph.wait_for_all();
    } catch (...) {
      stop_.request_stop();
      drain(graph);
      throw;
    }
    if (error_) std::rethrow_exception(error_);
  }

 private:
  Message next(tbb::flow_control& control) {
    std::optional<ReplicateSpec> spec;
    if (!stop_.stop_requested()) catch_callback_error([&] { spec = next_(); });
    if (!spec) {
      control.stop();
      return nullptr;
    }
    auto replicate = std::make_shared<Replicate>();
    replicate->outcome.spec = *std::move(spec);
    return replicate;
  }

  void begin(Replicate& replicate) {
    Outcome& outcome = replicate.outcome;
    replicate.start = run_stage("begin", outcome.timing, outcome.failure, [&] { return stages_.begin(outcome.spec); });
    if (replicate.start) outcome.timing = outcome.timing + replicate.start->spent;
  }

  void jam(Replicate& replicate) {
    Outcome& outcome = replicate.outcome;
    std::optional<JamResult> jammed;
    if (replicate.start) {
      const Timing before = outcome.timing;
      const Stopwatch watch;
      const OnProgress on_progress = [&](const JamProgress& progress) {
        if (!options_.on_step) return;
        catch_callback_error([&] { options_.on_step(outcome.spec, {progress, before + watch.elapsed()}); });
      };
      jammed = run_stage("jam", outcome.timing, outcome.failure, [&] {
        return stages_.jam(outcome.spec, std::move(replicate.start->progress), stop_.get_token(), on_progress);
      });
    }
    if (jammed) {
      outcome.jam = *std::move(jammed);
      outcome.interrupted = outcome.jam.status == JamStatus::interrupted;
      if (!outcome.interrupted) outcome.failure = failure_of(outcome.jam);
      replicate.parts.resize(outcome.spec.measures.size());
    } else {
      outcome.interrupted = !outcome.failure;
    }
    outcome.stage_seconds["jam"] = outcome.timing.cpu_seconds;
  }

  void measure(Replicate& replicate) {
    const std::size_t k = replicate.started++;
    if (stop_.stop_requested()) return;
    const Outcome& outcome = replicate.outcome;
    auto& part = replicate.parts[k];
    const auto what = outcome.spec.measures[k];
    part.value = run_stage(to_string(what), part.timing, part.failure,
                           [&] { return stages_.measure(outcome.spec, what, outcome.jam); });
  }

  static void add_parts(Replicate& replicate) {
    Outcome& outcome = replicate.outcome;
    for (std::size_t k = 0; k < replicate.parts.size(); ++k) {
      auto& part = replicate.parts[k];
      const auto what = outcome.spec.measures[k];
      outcome.timing = outcome.timing + part.timing;
      outcome.interrupted |= !part.value && !part.failure;
      if (!outcome.failure) outcome.failure = part.failure;
      if (!part.value) continue;
      outcome.measured[what] = *std::move(part.value);
      outcome.stage_seconds[std::string(to_string(what))] = part.timing.cpu_seconds;
    }
  }

  /// Runs a stage of a replicate, adds its time, and turns an exception into a failure. A resource failure is not a
  /// failure of the replicate: it ends the run, and there is neither a value nor a failure.
  template <class Stage>
  std::optional<std::invoke_result_t<const Stage&>> run_stage(std::string_view where, Timing& timing,
                                                              std::optional<Failure>& failure, const Stage& stage) {
    std::optional<std::invoke_result_t<const Stage&>> value;
    const Stopwatch watch;
    try {
      value = stage();
    } catch (const std::exception& error) {
      if (is_resource_failure(error)) {
        keep(std::current_exception());
      } else {
        failure = Failure{std::string(where), error.what()};
      }
    } catch (...) {
      failure = Failure{std::string(where), "an exception of unknown type"};
    }
    timing = timing + watch.elapsed();
    return value;
  }

  /// Keeps exceptions of the caller's functions, which must not leave the graph.
  void catch_callback_error(const std::function<void()>& call) {
    try {
      call();
    } catch (...) {
      keep(std::current_exception());
    }
  }

  /// Keeps the first error, which wait_for_all() throws at the end, and ends the run.
  void keep(const std::exception_ptr& error) {
    const std::lock_guard lock(error_mutex_);
    if (!error_) error_ = error;
    stop_.request_stop();
  }

  /// Waits until all tasks have ended after an exception. The nodes are destroyed before the graph, so no task may
  /// still use them. If waiting fails again and again for lack of memory, the program ends.
  static void drain(flow::graph& graph) {
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

  const NextReplicate& next_;
  const Stages& stages_;
  const GraphOptions& options_;
  const std::function<void(const Outcome&)>& on_outcome_;
  std::stop_source stop_;
  std::stop_callback<std::function<void()>> forward_stop_;
  std::mutex error_mutex_;
  std::exception_ptr error_;
};

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
  with_threads(threads, [&] { run.wait_for_all(options.in_flight > 0 ? options.in_flight : threads); });
}

}  // namespace isojam
