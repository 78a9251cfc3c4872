#include "tasks/records/step_fields.hpp"

namespace isojam {

void describe(Fields& field, PairCounts& counts) {
  field("listed", counts.listed, "Number of pairs in the neighbour lists.");
  field("out_of_reach", counts.out_of_reach, "Number of listed pairs whose circumscribed spheres do not intersect.");
  field("by_axis", counts.by_axis,
        "Number of listed pairs that are still separated along the axis that separated them in an earlier evaluation.");
  field("overlapped", counts.overlapped, "Number of pairs whose overlap was computed.");
  field("clipped", counts.clipped,
        "Number of pairs whose overlap was computed by clipping in quadruple precision. This is done for degenerate "
        "pairs, for example with coplanar faces.");
  field("touching", counts.touching, "Number of pairs whose intersection has a volume V > 0.");
}

void describe(Fields& field, MinimiseWork& work) {
  field("double_double_evaluations", work.double_double_evaluations,
        "Number of evaluations of energy and forces with double-double coordinates. The field `evaluations` of the "
        "record includes them.");
  field("hessians", work.hessians, "Number of computations of the Hessian of the whole packing.");
  field("factorisations", work.factorisations,
        "Number of factorisations of the Hessian, with or without an added shift. Failed factorisations are included.");
  field("factor_updates", work.factor_updates,
        "Number of linear systems that were solved by updating an earlier factorisation.");
  field("envelopes", work.envelopes,
        "Number of evaluations of Φ, the function that the method of multipliers minimises.");
  field("envelope_overlaps", work.envelope_overlaps,
        "Number of overlaps that were computed, with their second derivatives, in the evaluations of Φ.");
  field("local_factorisations", work.local_factorisations,
        "Number of factorisations of the Hessian of a few particles only.");
  field("incomplete_factorisations", work.incomplete_factorisations,
        "Number of incomplete factorisations of the Hessian. They are the preconditioners of the method of "
        "multipliers. Failed factorisations are included.");
  field("krylov_vectors", work.krylov_vectors,
        "Number of vectors of the Krylov spaces in which the method of multipliers computed its steps.");
}

void describe(Fields& field, Rearrangement& rearrangement) {
  field.type("rearrangement",
             "Difference between a state of the decompression and the state before it. Absent if "
             "there is no earlier state on the same solution branch.");
  field("energy_ratio", rearrangement.energy_ratio,
        "Energy of this state divided by the value that E ∝ Δφ⁶ predicts from the state before it. The ratio is near 1 "
        "on a smooth solution branch, and far below 1 after a rearrangement.")
      .finite();
  field("contacts_lost", rearrangement.contacts_lost,
        "Number of pairs that touch in the state before this state, but not in this state.");
  field("contacts_gained", rearrangement.contacts_gained,
        "Number of pairs that touch in this state, but not in the state before it.");
  field("particles_moved", rearrangement.particles_moved,
        "Number of particles that moved: the participation number (Σu²)²/Σu⁴. For each particle, u² = x² + (Rθ)², "
        "where x is its translation without the affine part, and θ the angle of its rotation.")
      .range(not_negative)
      .finite();
}

void describe(Fields& field, JamStep& step, Reasoned<>& delta_phi, StepOf of) {
  auto& summary = step.summary;
  if (of != StepOf::state) field("stage", step.stage, "Stage of the protocol.");
  field("density", step.density, "Density φ.").range(not_negative);
  if (of != StepOf::checkpoint)
    field("delta_phi", delta_phi, "Distance to jamming, Δφ = φ − φ_J; null if there is no φ_J.");
  field("energy_per_particle", step.energy_per_particle, "Energy per particle E/N.").unit("Y·V_p");
  field("pressure", step.pressure, "Pressure −dE/dV_cell.").unit("Y");
  field("deviator", step.deviator,
        "Deviation of the stress from hydrostatic stress: the largest absolute entry of the matrix σ + p·1, divided by "
        "p.")
      .range(not_negative);
  field(
      "residual", summary.residual,
      "Residual: the greater of two numbers, divided by the mean contact force. The numbers are the largest net force "
      "on a particle, and the largest net torque divided by R. In a variable cell, the residual is instead the "
      "deviation of the stress from the prescribed stress, divided by p, if this deviation is greater.")
      .range(not_negative);
  field("residual_floor", summary.residual_floor,
        "Residual that rounding errors alone can cause. Residuals below this value are not significant.")
      .range(not_negative);
  field("stopped", summary.reason, "Reason for the end of the minimisation.");
  if (of != StepOf::state) {
    field("evaluations", summary.evaluations, "Number of evaluations of energy and forces in this step.");
    field("iterations", summary.iterations, "Number of iterations of the minimiser in this step.");
  }
  field("descents", step.descents,
        "Number of saddles that were relaxed along a negative mode before this state was reached.");
  field("rearrangement", step.rearrangement, "");
  field("lost", step.lost,
        "True if the solution branch ended in this step, because the packing lost all contact forces or slid without "
        "reaching an equilibrium. Absent otherwise.")
      .if_true();
  if (of != StepOf::checkpoint) return;
  field("energy", summary.energy, "Energy E of the state.").unit("Y·V_p");
  field("precision", summary.precision, "Precision of the coordinates in the last evaluation.");
  field("work", summary.work, "Numbers of operations of the minimiser in this step.");
}

void describe(Fields& field, StepRow& row) {
  field.type("step", "One strain step, with the state after its minimisation.");
  describe(field, row.step, row.delta_phi, StepOf::path);
}

void describe(Fields& field, CheckpointStep& row) {
  Reasoned<> unknown;
  describe(field, row.step, unknown, StepOf::checkpoint);
}

}  // namespace isojam
