#pragma once

#include <array>
#include <optional>
#include <string>
#include <vector>

#include "engine/analysis/alignment/random_alignment.hpp"
#include "engine/analysis/contacts.hpp"
#include "tasks/io/describe.hpp"
#include "tasks/measure/trough_parts.hpp"

// Fields of the measure `contacts`.

namespace isojam {

/// What is optional is absent if the fit found no cut-off.
struct FitRecord {
  FitVerdict verdict = FitVerdict::not_called;
  std::optional<double> cutoff, alpha, a_0, a_0_error, error;
};
struct GapRecord {
  GapVerdict verdict = GapVerdict::not_called;
  std::optional<double> cutoff;
};
struct CutoffRecords {
  FitRecord face_face_fit, edge_face_fit;
  GapRecord face_face_gap, edge_face_gap;
};
/// Contact numbers by fitted cut-offs.
struct KnownNumbers {
  double Z = 0;
  Reasoned<> Z_ff, Z_ef, Z_l, C;
};
struct ShapePairRecord {
  std::array<std::string, 2> solids;
  long contacts = 1;
  CutoffRecords cutoffs;
};
struct Partial {
  std::vector<std::vector<double>> Z;
};
struct Angles {
  Randomness face_face_random, edge_face_random;
  std::vector<double> face_face, edge_face;
};

struct Contacts {
  KnownNumbers numbers;
  double Q6 = 0;
  CutoffRecords cutoffs;
  Reasoned<> Z_ff_gap, Z_ff_disagreement;
  ContactNumbers fixed_cutoffs;
  int pooled_over = 1;
  std::vector<KnownNumbers> kinds;
  std::optional<std::vector<ShapePairRecord>> shape_pairs;
  AngleBins angle_bins;
  Troughs trough;
  std::optional<Partial> partial;
  std::optional<Reasoned<>> mixing;
  std::optional<double> Z_grown, tension;
  std::optional<std::vector<std::array<int, 2>>> under_tension;
  std::optional<Angles> angles;
};
struct ContactsOfState {
  Contacts contacts;
};
void describe(Fields& field, ContactsOfState& state);

struct CycleRecord {
  Reasoned<> Z, Z_ff;
};
struct CycleRecords {
  std::vector<CycleRecord> cycles;
};
struct ContactsOfReplicate {
  std::optional<CycleRecords> contacts;
};
void describe(Fields& field, ContactsOfReplicate& replicate);

}  // namespace isojam
