#include <fmt/format.h>

#include "tasks/chart/families/comparisons.hpp"

namespace isojam {
namespace {

ChartFamily equilibrium_family() {
  return {"equilibrium",
          "residual",
          "Minimisers from the same starts, states of an expansion strained by one of its steps; the residual is the "
          "largest imbalance of a particle over the mean contact force. Spread over packings; times are also over "
          "repetitions. Bias: median difference from the reference, the default method to 1e-9.",
          FamilyEnd::complete,
          {}};
}

ChartFamily bias_family() {
  return {"bias",
          "|bias of jamming density|",
          "What the states that each way of minimising ends in make of the jamming density, against the reference, by "
          "the same fit. Times are of all states of a packing together, spread over packings.",
          FamilyEnd::complete,
          {}};
}

ChartFamily hessian_family() {
  return {"hessian",
          "largest relative error of an eigenvalue",
          "The analytic Hessian of equilibria against central differences of the gradient in double-double. Error "
          "of differences: from the analytic eigenvalues, translations apart; of the analytic ones: what rounding can "
          "do to them at most. Failed: negative modes that are not there.",
          FamilyEnd::complete,
          {}};
}

ChartFamily modes_family() {
  return {"modes",
          "largest relative error of an eigenvalue",
          fmt::format("The {} lowest modes beyond translations, against the dense solver; its own error is what "
                      "rounding can do at most. Shifts are −σ/λ_max. Spread over packings.",
                      modes_compared),
          FamilyEnd::complete,
          {}};
}

ChartFamily overlap_family() {
  return {
      "overlap",
      "relative error of V",
      "Overlap volumes against arithmetic of 50 digits, by class of contact. Poses are rounded to the precision of "
      "the method first, as in a packing. Times are per pair, solids placed; spread of errors over pairs. Forces are "
      "−VS/2: the error of S, where a method gives it, stands in the list of points.",
      FamilyEnd::complete,
      {}};
}

ChartFamily phi_j_family() {
  return {
      "phi_j",
      "error of jamming density (95 % bound)",
      "Mean jamming density over replicates, one parameter of the protocol at a time moved away from the first "
      "setting. Dots and thin bars: the mean less that of the first setting, and its own 95 % interval; broad bars: "
      "the 95 % interval of the difference replicate by replicate, where both began alike; numbers: of the broad bar, "
      "or else of the thin one. Error in the list of "
      "points: the far end of the thin bar. Times are of all replicates together. That φ_J depends on the number "
      "of particles and on the target energy is physics, not error.",
      FamilyEnd::complete,
      {}};
}

ChartFamily growth_family() {
  return {
      "growth",
      "no error: the number of particles is what varies",
      "CPU seconds of one thread over the number of particles: of a replicate of the default protocol from random "
      "placement to its jamming density, without measurements; of one equilibrium of its expansion, the mean over "
      "several distances, by the default "
      "method; of an evaluation of energy and forces in doubles. Spread over replicates. Lines: powers of N fitted to "
      "all measurements, with the 95 % interval of the exponent.",
      FamilyEnd::complete,
      {}};
}

}  // namespace

std::vector<ChartFamily> empty_families(Comparison comparison) {
  switch (comparison) {
    case Comparison::equilibrium: return {equilibrium_family(), bias_family()};
    case Comparison::hessian: return {hessian_family()};
    case Comparison::modes: return {modes_family()};
    case Comparison::overlap: return {overlap_family()};
    case Comparison::phi_j: return {phi_j_family()};
    case Comparison::growth: return {growth_family()};
    case Comparison::atlas: return {};
  }
  return {};
}

}  // namespace isojam
