#include <fmt/format.h>

#include "tasks/extras/chart/comparisons.hpp"

namespace isojam {
namespace {

ChartFamily equilibrium_family() {
  return {
      "equilibrium",
      "residual",
      "All minimisers start from the same states: states of a decompression, strained by one of its steps. The "
      "residual is the largest net force on a particle, or its net torque divided by its radius of gyration, in units "
      "of the mean contact force. Bars show the spread over packings, for times also over repetitions. The bias is the "
      "median difference from a reference with residual 1e-9. The reference is the method of multipliers for this "
      "method, and Newton's method for all others.",
      FamilyEnd::complete,
      {}};
}

ChartFamily bias_family() {
  return {
      "bias",
      "|bias of jamming density|",
      "Difference of the jamming density from the reference if its states are computed by each minimiser. The fit is "
      "the same. A time is the sum over all states of a packing; bars show the spread over packings.",
      FamilyEnd::complete,
      {}};
}

ChartFamily hessian_family() {
  return {
      "hessian",
      "largest relative error of an eigenvalue",
      "The analytic Hessian of equilibria is compared with central differences of the gradient in double-double. The "
      "error of differences is relative to the analytic eigenvalues, without translations. The error of the "
      "analytic eigenvalues is the bound on their rounding error. A method fails if it finds spurious negative modes.",
      FamilyEnd::complete,
      {}};
}

ChartFamily modes_family() {
  return {
      "modes",
      "largest relative error of an eigenvalue",
      fmt::format("The {} lowest modes without translations are compared with those of the dense solver, whose own "
                  "error is the bound on its rounding error. Shifts are −σ/λ_max. Bars show the spread over packings.",
                  modes_compared),
      FamilyEnd::complete,
      {}};
}

ChartFamily overlap_family() {
  return {
      "overlap",
      "relative error of V",
      "Overlap volumes are compared with arithmetic of 50 digits, for each class of contact. Poses are first rounded "
      "to the precision of the method, as in a packing. Times are per pair and exclude the placement of the solids. "
      "Bars show the spread over pairs. Forces are −VS/2; the list of points contains the error of S if the method "
      "computes it.",
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
    case Comparison::atlas: return {};
  }
  return {};
}

}  // namespace isojam
