// Properties tested here with a hundred thousand synthetic records: `aggregate` and `status` each need less than 100 MB
// of memory, and `aggregate` gives the same table whichever half of the records it finds first. The CPU time is
// printed. The test takes a minute and a gigabyte of disk, so it runs only with --gtest_also_run_disabled_tests.

#include <gtest/gtest.h>
#include <sys/resource.h>

#include <cstdio>

#include "tasks/io/parse.hpp"
#include "tasks/io/sealed.hpp"
#include "tasks/records/record.hpp"
#include "tests/tasks/support/bad_manifests.hpp"
#include "tests/tasks/support/support.hpp"

namespace isojam {
namespace {

constexpr int records = 100000;

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

void write_halves(const std::filesystem::path& here) {
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
    const auto outcome = test::made_up_outcome(spec);
    const auto record = make_record(outcome);
    const auto half = here / (i % 2 ? "odd" : "even");
    const auto file = replicate_name(spec) + ".json";
    test::write_text(half / "records" / file, sealed(record));
    test::write_text(half / "packings" / file, sealed(make_packing(outcome, record.at("result_digest"))));
  }
}

TEST(Scale, DISABLED_AHundredThousandRecords) {
  const test::TemporaryDirectory here;
  write_halves(here.path());
  std::vector<std::string> tables;
  for (const auto& halves : {std::pair<std::string, std::string>{"even", "odd"}, {"odd", "even"}}) {
    tables.push_back(run_and_print({"aggregate", halves.first, halves.second, "--format", "json"}, here.path()).out);
  }
  const auto status = run_and_print({"status", "even"}, here.path());
  EXPECT_EQ(status.out.rfind("tiny: 50000 of 100000 replicates recorded", 0), 0U) << status.out;
  EXPECT_EQ(tables[0], tables[1]);
  EXPECT_EQ(parse_json(tables[0], "table").at("rows").at(0).at("phi_j").at("n"), records / 2);
  EXPECT_LT(largest_child_megabytes(), 100);
}

}  // namespace
}  // namespace isojam
