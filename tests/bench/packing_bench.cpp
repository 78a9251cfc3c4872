// Benchmarks of one packing. Evaluation on one core, on two cores, and as a function of N, with the memory used.
// Factorisation compared with CHOLMOD, and on two cores.

#include <benchmark/benchmark.h>
#include <malloc.h>
#include <oneapi/tbb/global_control.h>

#include "engine/packing/energy.hpp"
#include "engine/solve/factor/shift_invert.hpp"
#include "tests/bench/peers.hpp"
#include "tests/bench/states.hpp"

namespace isojam::bench {
namespace {

std::string case_of(int n) { return "/N=" + std::to_string(n); }

double bytes_in_use() {
  const struct mallinfo2 info = mallinfo2();
  return static_cast<double>(info.uordblks + info.hblkhd);
}

/// Cycles through so many packings that they contain 10⁴ particles in total. Otherwise, branch predictors and caches
/// would adapt to a small packing more than to a large one.
class Turns {
 public:
  explicit Turns(int n) : packings_(relaxed(SolidKind::octahedron, n, 10000 / n)), energies_(packings_.size()) {}

  void next() { turn_ = (turn_ + 1) % packings_.size(); }
  const Packing& packing() const { return packings_[turn_]; }
  PackingEnergy& energy() { return energies_[turn_]; }
  std::size_t size() const { return packings_.size(); }

 private:
  const std::vector<Packing>& packings_;
  std::vector<PackingEnergy> energies_;
  std::size_t turn_ = 0;
};

/// Evaluates packings again that were evaluated before. The memory is that of one evaluator, including the working
/// memory for the Hessian.
void evaluate(benchmark::State& state, int n, std::size_t threads, Precision precision) {
  const oneapi::tbb::global_control limit(oneapi::tbb::global_control::max_allowed_parallelism, threads);
  Turns turns(n);
  const double before = bytes_in_use();
  for (std::size_t k = 0; k < turns.size(); ++k, turns.next()) turns.energy().hessian(turns.packing());
  state.counters["bytes"] = (bytes_in_use() - before) / static_cast<double>(turns.size());
  double contacts = 0;
  for (auto _ : state) {
    contacts += static_cast<double>(turns.energy().evaluate(turns.packing(), precision).contacts);
    turns.next();
  }
  state.counters["seconds_per_contact"] = seconds_per(contacts);
}

/// A Hessian, and a shift of its diagonal that makes it clearly positive definite.
struct System {
  BlockMatrix matrix;
  double shift = 0;
};

System system_of(int n) {
  System system{PackingEnergy().hessian(relaxed(SolidKind::octahedron, n).front()), 0};
  for (const Matrix6d& block : system.matrix.diagonal)
    system.shift = std::max(system.shift, block.diagonal().maxCoeff());
  return system;
}

void block_cholesky(benchmark::State& state, int n, std::size_t threads) {
  const oneapi::tbb::global_control limit(oneapi::tbb::global_control::max_allowed_parallelism, threads);
  const System system = system_of(n);
  BlockCholesky factor;
  bool done = factor.factorise(system.matrix, system.shift);  // not timed: the symbolic part, and the allocation
  for (auto _ : state) done = factor.factorise(system.matrix, system.shift) && done;
  if (!done) state.SkipWithError("not positive definite");
}

/// CHOLMOD with its preferred order, on one core. Its symbolic part is kept. The label states which BLAS it uses.
void cholmod(benchmark::State& state, int n) {
  const System system = system_of(n);
  CholmodFactor factor(lower_half(system.matrix, system.shift));
  bool done = factor.factorise();
  for (auto _ : state) done = factor.factorise() && done;
  BlockCholesky ours;
  const Eigen::VectorXd b = Eigen::VectorXd::LinSpaced(6 * n, -1, 1);
  done = done && ours.factorise(system.matrix, system.shift);
  if (!done) return state.SkipWithError("not positive definite");
  const Eigen::VectorXd x = ours.solve(b);
  if (!((factor.solve(b) - x).norm() < 1e-10 * x.norm())) state.SkipWithError("another solution");
  state.SetLabel(blas_in_use());
}

template <class Function, class... Arguments>
benchmark::internal::Benchmark* add(const std::string& name, Function function, Arguments... arguments) {
  return benchmark::RegisterBenchmark(name.c_str(), function, arguments...);
}

std::string threads_of(std::size_t threads) {
  return std::to_string(threads) + (threads == 1 ? "_thread" : "_threads");
}

bool register_all() {
  for (const int n : {100, 1000, 10000}) add("evaluate/1_thread" + case_of(n), evaluate, n, 1, Precision::working);
  add("evaluate/double_double" + case_of(100), evaluate, 100, 1, Precision::double_double);
  for (const int n : {100, 400, 800, 1000}) {
    add("factorise/cholmod" + case_of(n), cholmod, n);
    add("factorise/block_cholesky" + case_of(n), block_cholesky, n, 1);
  }
  // Wall-clock time, because the ratio of the times on one and two cores is the gain by the second core.
  for (const std::size_t threads : {1, 2}) {
    add("evaluate/" + threads_of(threads) + case_of(400), evaluate, 400, threads, Precision::working)->UseRealTime();
    add("factorise/" + threads_of(threads) + case_of(1000), block_cholesky, 1000, threads)->UseRealTime();
  }
  return true;
}

[[maybe_unused]] const bool registered = register_all();

}  // namespace
}  // namespace isojam::bench
