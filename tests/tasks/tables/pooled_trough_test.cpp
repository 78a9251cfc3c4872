#include "tasks/tables/pooled_trough.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "engine/random/stream.hpp"
#include "tasks/measure/trough_parts.hpp"
#include "tasks/records/record.hpp"
#include "tasks/tables/aggregate.hpp"
#include "tasks/tables/tables.hpp"
#include "tests/tasks/support/bad_manifests.hpp"
#include "tests/tasks/support/schema.hpp"
#include "tests/tasks/support/support.hpp"

namespace isojam {
namespace {

constexpr double ff_upper = 0.3, ef_upper = 0.25;

double log_uniform(double from, double to, RandomStream& random) {
  return std::pow(10, from + (to - from) * random.uniform());
}

/// Contacts of three known classes, with numbers that vary between packings.
AngleHistogram packing_with(int flat, int edges, int others, RandomStream& random) {
  std::vector<Alignment> list;
  const auto about = [&](int number) { return number - 1 + static_cast<int>(3 * random.uniform()); };
  for (int i = about(flat); i > 0; --i)
    list.push_back({.face_face = log_uniform(-10, -9, random), .edge_face = log_uniform(-11, -10, random)});
  for (int i = about(edges); i > 0; --i)
    list.push_back({.face_face = 0.5, .edge_face = log_uniform(-5.5, -4.5, random)});
  for (int i = about(others); i > 0; --i)
    list.push_back({.face_face = 0.5, .edge_face = log_uniform(-1.5, -0.3, random)});
  return angle_histogram(list, ff_upper, ef_upper);
}

void expect_equal(const AngleHistogram& a, const AngleHistogram& b) {
  EXPECT_EQ(a.face_face, b.face_face);
  EXPECT_EQ(a.edge_face_apart, b.edge_face_apart);
  EXPECT_EQ(a.face_face_window, b.face_face_window);
  EXPECT_EQ(a.edge_face_window, b.edge_face_window);
  for (int bins = 0; bins <= a.face_face_window; bins += 10)
    EXPECT_EQ(a.edge_face_of_others(bins), b.edge_face_of_others(bins));
}

TEST(PooledTrough, IsOfTheContactsOfAllPackings) {
  RandomStream random{70};
  constexpr int particles = 10;
  PooledAngles packings, one;
  AngleHistogram total;
  total.face_face_window = total.edge_face_window = angle_bins;
  for (int k = 0; k < 16; ++k) {
    const AngleHistogram own = packing_with(3, 4, 40, random);
    EXPECT_FALSE(trough_cutoffs(own).has_all());
    expect_equal(PackedAngles(own).unpacked(), own);
    packings.add("study", k, own);
    if (k == 0) one.add("study", k, own);
    total.add(own);
  }
  const auto pooled = packings.trough(particles, "key");
  ASSERT_TRUE(pooled && pooled->cutoffs.has_all());
  EXPECT_EQ(pooled->replicates, 16);
  EXPECT_EQ(pooled->particles, 160);
  const TroughNumbers all = trough_numbers(total, 160, trough_cutoffs(total));
  const std::array expected{all.numbers.Z_ff, all.numbers.Z_ef, all.numbers.Z_l, all.numbers.C, all.C_low, all.C_high};
  for (std::size_t i = 0; i < expected.size(); ++i) {
    EXPECT_NEAR(*pooled->estimates[i].mean, expected[i], 1e-12) << PooledTrough::names[i];
    EXPECT_EQ(pooled->estimates[i].n, 16);
  }
  EXPECT_GT(*pooled->estimates[3].half_width, 0);
  EXPECT_TRUE(pooled->estimates[3].bootstrap95);
  EXPECT_FALSE(PooledAngles().trough(particles, "key"));
  const auto undecided = one.trough(particles, "key");
  ASSERT_TRUE(undecided);
  EXPECT_EQ(undecided->estimates[3].n, 0);
}

/// The pooled trough of a hundred packings of two studies, and the numbers of face-face contacts of the packings.
std::pair<PooledTrough, std::vector<double>> of_a_hundred(bool backwards) {
  constexpr int packings = 100;
  RandomStream random{72};
  std::vector<AngleHistogram> list;
  for (int k = 0; k < packings; ++k) {
    // Interpolated numbers are not integers. Their sum would depend on the order without rounding.
    AngleHistogram own = packing_with(3, 4, 40, random);
    own.add(packing_with(3, 4, 40, random), 1 / 3.0);
    list.push_back(own);
  }
  PooledAngles pooled;
  for (int i = 0; i < packings; ++i) {
    const int k = backwards ? packings - 1 - i : i;
    pooled.add(k % 2 ? "one" : "other", k, list[static_cast<std::size_t>(k)]);
  }
  auto found = *pooled.trough(10, "key");
  std::vector<double> numbers;
  for (const auto& own : list) numbers.push_back(trough_numbers(own, 10, found.cutoffs).numbers.Z_ff);
  return {found, numbers};
}

TEST(PooledTrough, OfManyPackingsHasAFewGroupsThatDoNotDependOnTheOrder) {
  const auto [pooled, numbers] = of_a_hundred(false);
  ASSERT_TRUE(pooled.cutoffs.has_all());
  const auto& grouped = pooled.estimates[0];
  const auto expected = estimate(numbers, 0);
  EXPECT_EQ(grouped.n, 100);
  EXPECT_NEAR(*grouped.mean, *expected.mean, 1e-5);
  // The groups estimate the same standard deviation with fewer degrees of freedom.
  EXPECT_NEAR(*grouped.sd / *expected.sd, 1, 0.35);
  EXPECT_NE(*grouped.sd, *expected.sd);
  EXPECT_FALSE(grouped.bootstrap95);
  const auto again = of_a_hundred(true).first;
  for (std::size_t i = 0; i < PooledTrough::names.size(); ++i) {
    EXPECT_EQ(*again.estimates[i].mean, *pooled.estimates[i].mean) << PooledTrough::names[i];
    EXPECT_EQ(*again.estimates[i].half_width, *pooled.estimates[i].half_width) << PooledTrough::names[i];
  }
}

/// Outcomes of one row. State k of a packing has histograms with more edges than state k − 1.
std::vector<Outcome> outcomes(int replicates, int contacts) {
  auto manifest = test::good_manifest();
  manifest["sweep"]["solid"] = {"octahedron"};
  manifest["sweep"]["particles"] = {100};
  manifest["replicates"] = replicates;
  RandomStream random{71};
  std::vector<Outcome> list;
  for (const auto& spec : test::make_plan(parse_manifest(manifest.dump(), "m"))) {
    list.push_back(test::made_up_outcome(spec));
    int edges = contacts;
    for (Json& state : list.back().measured.at(Measure::contacts).states)
      test::set_angles(state, packing_with(contacts, edges += 5, 5 * contacts, random), spec.particles);
  }
  return list;
}

RecordSummary summary_of(const Outcome& outcome) { return summarise_record(test::record_on_disk(outcome), "made up"); }

std::vector<RecordSummary> summaries_of(const std::vector<Outcome>& list) {
  std::vector<RecordSummary> records;
  for (const Outcome& outcome : list) records.push_back(summary_of(outcome));
  return records;
}

TEST(PooledTrough, OfASeriesIsInterpolated) {
  const auto records = summaries_of(outcomes(6, 40));
  const auto table = aggregate(records);
  ASSERT_FALSE(table.rows.at(0).series.empty());
  for (const SeriesPoint& point : table.rows.at(0).series) {
    ASSERT_TRUE(point.trough && point.trough->cutoffs.has_all()) << point.delta_phi;
    double C = 0;
    for (const RecordSummary& record : records) {
      std::size_t k = 1;
      while (record.states[k].delta_phi < point.delta_phi) ++k;
      const auto C_of = [&](const StateValues& state) {
        return trough_numbers(*state.angles, record.particles, point.trough->cutoffs).numbers.C;
      };
      const double near = record.states[k - 1].delta_phi, far = record.states[k].delta_phi;
      const double weight = std::log(point.delta_phi / near) / std::log(far / near);
      C += ((1 - weight) * C_of(record.states[k - 1]) + weight * C_of(record.states[k])) / 6;
    }
    EXPECT_NEAR(*point.trough->estimates[3].mean, C, 1e-5) << point.delta_phi;
  }
}

TEST(PooledTrough, LeavesOutReplicatesThatDoNotCount) {
  auto list = outcomes(8, 40);
  const auto only = aggregate(summaries_of({list.begin() + 2, list.end()}));
  list[0].failure = Failure{"modes", "made up"};
  list[1].measured.at(Measure::contacts).flags = {"crystalline"};
  const auto table = aggregate(summaries_of(list));
  ASSERT_TRUE(table.rows.at(0).trough);
  EXPECT_EQ(table.rows[0].trough->replicates, 6);
  EXPECT_EQ(*table.rows[0].trough->estimates[3].mean, *only.rows.at(0).trough->estimates[3].mean);
}

TEST(PooledTrough, IsInAllTables) {
  const auto table = aggregate(summaries_of(outcomes(5, 40)));
  const auto json = to_json(table);
  EXPECT_EQ(test::violations("tables", json), "");
  const auto& pooled = json.at("rows").at(0).at("pooled_trough");
  EXPECT_EQ(pooled.at("replicates"), 5);
  EXPECT_EQ(pooled.at("edge_face").at("verdict"), "found");
  EXPECT_NEAR(pooled.at("C").at("mean").get<double>(), *table.rows[0].trough->estimates[3].mean, 1e-12);
  EXPECT_TRUE(json.at("rows").at(0).at("series").at(0).contains("pooled_trough"));
  for (const View view : {View::nearest, View::series}) {
    EXPECT_NE(to_text(table, view).find("troughs in the angles of all replicates together"), std::string::npos);
    for (const auto* head : {"ff low", "ff high", "ef low", "ef high"})
      EXPECT_NE(to_text(table, view).find(head), std::string::npos) << head;
    EXPECT_NE(to_latex(table, view).find("\\theta_{ef}"), std::string::npos);
    EXPECT_NE(to_csv(table, view).find(",C_pooled_mean,"), std::string::npos);
    EXPECT_NE(to_long_csv(table, view).find(",C_pooled,"), std::string::npos);
  }
}

}  // namespace
}  // namespace isojam
