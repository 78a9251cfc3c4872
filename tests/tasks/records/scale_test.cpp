// Properties tested here with a hundred thousand synthetic records: `aggregate` needs less than a gibibyte of memory,
// and gives the same table whichever half of the records it finds first. The time is printed. The test takes a minute
// and a gigabyte of disk, so it runs only with --gtest_also_run_disabled_tests.

#include <gtest/gtest.h>
#include <sys/resource.h>

#include <chrono>

#include "tasks/io/parse.hpp"
#include "tasks/io/sealed.hpp"
#include "tasks/records/record.hpp"
#include "tests/tasks/support/bad_manifests.hpp"
#include "tests/tasks/support/support.hpp"

namespace isojam {
namespace {

constexpr int records = 100000;

double largest_child_gib() {
  rusage usage{};
  getrusage(RUSAGE_CHILDREN, &usage);
  return static_cast<double>(usage.ru_maxrss) / (1024 * 1024);
}

void write_halves(const std::filesystem::path& here) {
  auto json = test::good_manifest();
  json["sweep"]["solid"] = {"octahedron", "dodecahedron"};
  json["replicates"] = records / 2;
  const Plan plan(parse_manifest(json.dump(), "m"));
  for (const std::string half : {"even", "odd"}) {
    std::filesystem::create_directories(here / half / "records");
    test::write_text(here / half / "manifest.json", json.dump());
  }
  for (std::size_t i = 0; i < plan.size(); ++i) {
    const auto spec = plan[i];
    const auto record = sealed(make_record(test::made_up_outcome(spec)));
    test::write_text(here / (i % 2 ? "odd" : "even") / "records" / (replicate_name(spec) + ".json"), record);
  }
}

TEST(Scale, DISABLED_AHundredThousandRecords) {
  const test::TemporaryDirectory here;
  write_halves(here.path());
  std::vector<std::string> tables;
  for (const auto& halves : {std::pair<std::string, std::string>{"even", "odd"}, {"odd", "even"}}) {
    const auto begun = std::chrono::steady_clock::now();
    const auto table = test::isojam({"aggregate", halves.first, halves.second, "--format", "json"}, here.path());
    const std::chrono::duration<double> took = std::chrono::steady_clock::now() - begun;
    EXPECT_EQ(table.exit_code, 0) << table.err;
    tables.push_back(table.out);
    std::printf("%d records aggregated in %.1f s, %.2f GiB\n", records, took.count(), largest_child_gib());
  }
  EXPECT_EQ(tables[0], tables[1]);
  EXPECT_EQ(parse_json(tables[0], "table").at("rows").at(0).at("phi_j").at("n"), records / 2);
  EXPECT_LT(largest_child_gib(), 1);
}

}  // namespace
}  // namespace isojam
