#include <gtest/gtest.h>
#include <malloc.h>

#include <cmath>
#include <cstdio>

#include "engine/random/stream.hpp"
#include "tasks/measure/trough_parts.hpp"
#include "tasks/tables/aggregate.hpp"
#include "tests/tasks/support/bad_manifests.hpp"
#include "tests/tasks/support/support.hpp"

namespace isojam {
namespace {

/// The parts of states with the angles of 300 contacts: 100 face-face ones, 50 edge-face ones, and others.
std::vector<Json> states_with_angles() {
  RandomStream random{73};
  const auto angle = [&](double from, double to) { return std::pow(10, from + (to - from) * random.uniform()); };
  std::vector<Json> states(50);
  for (Json& state : states) {
    std::vector<Alignment> contacts;
    for (int k = 0; k < 300; ++k) {
      contacts.push_back({.face_face = k < 100 ? angle(-8, -5) : angle(-0.7, 0),
                          .edge_face = k < 150 ? angle(-9, -6) : angle(-1.5, -0.3)});
    }
    test::set_angles(state, angle_histogram(contacts, 0.3, 0.25), 64);
  }
  return states;
}

/// Adds angles to each state. Different replicates have different angles in the same state.
void add_angles(Outcome& outcome) {
  static const auto all = states_with_angles();
  auto next = static_cast<std::size_t>(outcome.spec.replicate);
  for (Json& state : outcome.measured.at(Measure::contacts).states) {
    for (const auto& part : all[next++ % all.size()].at("contacts").items())
      state["contacts"][part.key()] = part.value();
  }
}

double bytes_in_use() {
  const auto memory = mallinfo2();
  return static_cast<double>(memory.uordblks + memory.hblkhd);
}

TEST(Scale, MemoryGrowsByLessThanAKilobyteARecord) {
  auto manifest = test::good_manifest();
  manifest["sweep"]["solid"] = {"octahedron"};
  manifest["sweep"]["particles"] = {64};
  manifest["replicates"] = 50;
  std::vector<RecordSummary> records;
  for (const auto& spec : test::make_plan(parse_manifest(manifest.dump(), "m"))) {
    auto outcome = test::made_up_outcome(spec);
    add_angles(outcome);
    records.push_back(summarise_record(test::record_on_disk(outcome), "made up"));
  }
  constexpr int few = 5000, many = 20000;
  Aggregation aggregation;
  double before = 0;
  for (int k = 0; k < many; ++k) {
    if (k == few) before = bytes_in_use();
    auto& record = records[static_cast<std::size_t>(k) % records.size()];
    record.replicate = k;
    aggregation.add(record);
  }
  const double each = (bytes_in_use() - before) / (many - few);
  std::printf("%.0f bytes for each record\n", each);
  EXPECT_LT(each, 1000);
  const auto table = aggregation.table();
  ASSERT_TRUE(table.rows.at(0).trough && !table.rows.at(0).series.empty());
  EXPECT_EQ(table.rows.at(0).trough->replicates, many);
}

}  // namespace
}  // namespace isojam
