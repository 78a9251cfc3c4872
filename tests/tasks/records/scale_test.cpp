#include <gtest/gtest.h>
#include <malloc.h>
#include <sys/resource.h>

#include <cmath>
#include <cstdio>

#include "engine/random/stream.hpp"
#include "tasks/io/parse.hpp"
#include "tasks/io/sealed.hpp"
#include "tasks/measure/trough_parts.hpp"
#include "tasks/records/record.hpp"
#include "tasks/tables/aggregate.hpp"
#include "tests/tasks/support/bad_manifests.hpp"
#include "tests/tasks/support/support.hpp"

namespace isojam {
namespace {

/// Memory of the largest process that has ended.
double largest_child_megabytes() {
  rusage usage{};
  getrusage(RUSAGE_CHILDREN, &usage);
  return static_cast<double>(usage.ru_maxrss) * 1.024e-3;
}

double cpu_seconds_of_children() {
  rusage usage{};
  getrusage(RUSAGE_CHILDREN, &usage);
  return static_cast<double>(usage.ru_utime.tv_sec + usage.ru_stime.tv_sec) +
         1e-6 * static_cast<double>(usage.ru_utime.tv_usec + usage.ru_stime.tv_usec);
}

test::Finished run_and_print(const std::vector<std::string>& arguments, const std::filesystem::path& here) {
  const double before = cpu_seconds_of_children();
  auto ended = test::isojam(arguments, here);
  std::printf("%s: %.1f s of CPU time, at most %.0f MB\n", arguments[0].c_str(), cpu_seconds_of_children() - before,
              largest_child_megabytes());
  EXPECT_EQ(ended.exit_code, 0) << ended.err;
  return ended;
}

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

void write_halves(const std::filesystem::path& here, int records) {
  auto json = test::good_manifest();
  json["sweep"]["solid"] = {"octahedron", "dodecahedron"};
  json["replicates"] = records / 2;
  const Plan plan(parse_manifest(json.dump(), "m"));
  for (const std::string half : {"even", "odd"}) {
    for (const std::string folder : {"records", "packings"}) std::filesystem::create_directories(here / half / folder);
    test::write_text(here / half / "manifest.json", json.dump());
  }
  for (std::size_t i = 0; i < plan.size(); ++i) {
    const auto spec = plan[i];
    auto outcome = test::made_up_outcome(spec);
    add_angles(outcome);
    const auto record = make_record(outcome);
    const auto half = here / (i % 2 ? "odd" : "even");
    const auto file = replicate_name(spec) + ".json";
    test::write_text(half / "records" / file, sealed(record));
    test::write_text(half / "packings" / file, sealed(make_packing(outcome, record.at("result_digest"))));
  }
}

/// Aggregates both halves in both orders. Returns one of the tables, which must be equal.
std::string aggregate_halves(const std::filesystem::path& here) {
  std::vector<std::string> tables;
  for (const auto& halves : {std::pair<std::string, std::string>{"even", "odd"}, {"odd", "even"}}) {
    tables.push_back(run_and_print({"aggregate", halves.first, halves.second, "--format", "json"}, here).out);
  }
  EXPECT_EQ(tables[0], tables[1]);
  return tables[0];
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

TEST(Scale, DISABLED_AHundredThousandRecords) {
  constexpr int records = 100000;
  const test::TemporaryDirectory here;
  write_halves(here.path(), records);
  const auto table = parse_json(aggregate_halves(here.path()), "table");
  const auto status = run_and_print({"status", "even"}, here.path());
  EXPECT_EQ(status.out.rfind("tiny: 50000 of 100000 replicates recorded", 0), 0U) << status.out;
  EXPECT_EQ(table.at("rows").at(0).at("phi_j").at("n"), records / 2);
  EXPECT_LT(largest_child_megabytes(), 100);
}

}  // namespace
}  // namespace isojam
