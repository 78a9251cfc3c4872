// The reference decides with rational numbers, and sums with 100 digits. Where faces coincide, the error may reach the
// effect of rounding the pose. Prints a table of errors and of the path used.

#include <gtest/gtest.h>

#include <algorithm>
#include <cstdio>
#include <string>
#include <vector>

#include "engine/geometry/overlap/clipped_overlap.hpp"
#include "engine/geometry/overlap/overlap.hpp"
#include "tasks/extras/chart/pairs/pair_cases.hpp"
#include "tests/oracle/exact_overlap.hpp"
#include "tests/oracle/overlap_checks.hpp"

namespace isojam::oracle {
namespace {

RelativePose rounded_pose(const PairCase& pair) { return {rotation_matrix(pair.pose()).high, pair.displacement}; }

Overlap computed_overlap(const PairCase& pair) {
  return relative_overlap(platonic(pair.a), platonic(pair.b), rounded_pose(pair));
}

double median(std::vector<double> values) {
  if (values.empty()) return 0;
  std::nth_element(values.begin(), values.begin() + values.size() / 2, values.end());
  return values[values.size() / 2];
}

double greatest(const std::vector<double>& values) {
  return values.empty() ? 0 : *std::max_element(values.begin(), values.end());
}

/// Errors for one class of pairs.
struct ErrorSample {
  /// Relative errors of V, S and M. The errors of S and M are stored only if gradient_limit() does not exceed the
  /// tolerance of the class.
  std::vector<double> volume, area, moment;
  int loop = 0, clip = 0, separated = 0;
};

void print_header() {
  std::printf("%-13s %-20s %5s | %8s %8s | %6s %8s %8s %8s %8s | %5s %5s %9s\n", "solid", "class", "n", "V median",
              "V max", "n(S,M)", "S median", "S max", "M median", "M max", "loop", "clip", "separated");
}

void print(const std::string& solid, PairClass pair_class, const ErrorSample& survey) {
  std::printf("%-13s %-20s %5zu | %8.1e %8.1e | %6zu %8.1e %8.1e %8.1e %8.1e | %5d %5d %9d\n", solid.c_str(),
              std::string(to_string(pair_class)).c_str(), survey.volume.size(), median(survey.volume),
              greatest(survey.volume), survey.area.size(), median(survey.area), greatest(survey.area),
              median(survey.moment), greatest(survey.moment), survey.loop, survey.clip, survey.separated);
  std::fflush(stdout);
}

/// Checks each pair and collects the errors.
ErrorSample survey_pairs(const std::vector<PairCase>& pairs, PairClass pair_class) {
  ErrorSample survey;
  for (const PairCase& pair : pairs) {
    const OverlapTolerance limits = tolerance(pair_class, pair.a, pair.b);
    const ExactOverlap exact = exact_overlap(pair, pair_class);
    const Overlap computed = computed_overlap(pair);
    EXPECT_EQ(disagreement(computed, exact, pair.a, limits), "")
        << to_string(pair_class) << ", path " << static_cast<int>(computed.path) << ": " << describe(pair);
    const Overlap clipped = clipped_overlap(platonic(pair.a), platonic(pair.b), rounded_pose(pair));
    EXPECT_EQ(disagreement(clipped, exact, pair.a, limits), "")
        << to_string(pair_class) << ", clipped_overlap: " << describe(pair);
    if (pair_class == PairClass::random_contact) {
      EXPECT_EQ(computed.faces_a, exact.faces_a) << describe(pair);
      EXPECT_EQ(computed.faces_b, exact.faces_b) << describe(pair);
      EXPECT_EQ(computed.edges_a, exact.edges_a) << describe(pair);
      EXPECT_EQ(computed.edges_b, exact.edges_b) << describe(pair);
    }
    const OverlapErrors error = errors(computed, exact, pair.a);
    survey.volume.push_back(error.volume);
    if (gradient_limit(exact, pair.a, limits) <= limits.gradient) {
      survey.area.push_back(error.area);
      survey.moment.push_back(error.moment);
    }
    survey.loop += computed.path == OverlapPath::loop;
    survey.clip += computed.path == OverlapPath::clip;
    survey.separated += computed.path == OverlapPath::separated;
  }
  return survey;
}

int case_count(PairClass pair_class) {
  switch (pair_class) {
    case PairClass::random_contact: return 300;
    case PairClass::near_parallel_faces:
    case PairClass::edge_in_face: return 100;
    default: return 40;
  }
}

class OverlapAccuracy : public testing::TestWithParam<SolidKind> {};

TEST_P(OverlapAccuracy, AgreesWithExactArithmetic) {
  const SolidKind kind = GetParam();
  print_header();
  for (const PairClass pair_class : all_pair_classes) {
    const auto pairs = pair_cases(kind, kind, pair_class, case_count(pair_class));
    const ErrorSample survey = survey_pairs(pairs, pair_class);
    print(std::string(to_string(kind)), pair_class, survey);
    if (pair_class == PairClass::random_contact) {
      EXPECT_LE(median(survey.volume), 1e-14) << to_string(kind);
    }
    if (!tolerance(pair_class, kind, kind).contested) {
      EXPECT_EQ(survey.area.size(), survey.volume.size()) << "S and M of some pairs are not unique";
    }
  }
}

INSTANTIATE_TEST_SUITE_P(Solids, OverlapAccuracy, testing::ValuesIn(all_solids),
                         [](const auto& solid) { return std::string(to_string(solid.param)); });

TEST(OverlapAccuracyMixed, DifferentSolidsAgreeWithExactArithmetic) {
  print_header();
  for (const PairClass pair_class : {PairClass::random_contact, PairClass::near_parallel_faces, PairClass::edge_in_face,
                                     PairClass::same_orientation, PairClass::coincident}) {
    std::vector<PairCase> pairs;
    for (const SolidKind a : all_solids) {
      for (const SolidKind b : all_solids) {
        if (a == b) continue;
        for (const PairCase& pair : pair_cases(a, b, pair_class, 5)) pairs.push_back(pair);
      }
    }
    const ErrorSample survey = survey_pairs(pairs, pair_class);
    print("different", pair_class, survey);
    const auto& first = pairs.front();
    if (!tolerance(pair_class, first.a, first.b).contested) {
      EXPECT_EQ(survey.area.size(), survey.volume.size()) << "S and M of some pairs are not unique";
    }
  }
}

}  // namespace
}  // namespace isojam::oracle
