#include "engine/vibration/lanczos.hpp"

#include <Spectra/SymEigsShiftSolver.h>
#include <Spectra/SymEigsSolver.h>

#include <stdexcept>
#include <system_error>

namespace isojam {
namespace {

template <class Solver>
LanczosModes solved(Solver& solver, Spectra::SortRule rule, const LanczosRequest& request) {
  LanczosModes modes;
  try {
    if (request.start.size() > 0) {
      solver.init(request.start.data());
    } else {
      solver.init();
    }
    solver.compute(rule, request.restarts, request.tolerance, Spectra::SortRule::SmallestAlge);
  } catch (const std::system_error&) {
    throw;  // a system error, not a numerical failure
  } catch (const std::runtime_error&) {
    modes.ended = LanczosEnd::small_problem_failed;
    return modes;
  }
  modes.products = solver.num_operations();
  if (solver.info() != Spectra::CompInfo::Successful) return modes;
  modes.ended = LanczosEnd::converged;
  modes.eigenvalues = solver.eigenvalues();
  modes.vectors = solver.eigenvectors();
  return modes;
}

}  // namespace

LanczosModes lanczos(LanczosOperation operation, const LanczosRequest& request) {
  if (request.shift) {
    Spectra::SymEigsShiftSolver<LanczosOperation> solver(operation, request.modes, request.subspace, *request.shift);
    return solved(solver, Spectra::SortRule::LargestMagn, request);
  }
  Spectra::SymEigsSolver<LanczosOperation> solver(operation, request.modes, request.subspace);
  const bool least = request.wanted == LanczosWanted::least;
  return solved(solver, least ? Spectra::SortRule::SmallestAlge : Spectra::SortRule::LargestAlge, request);
}

}  // namespace isojam
