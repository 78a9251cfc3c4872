#include "tasks/io/memory.hpp"

#include <algorithm>
#include <fstream>
#include <iterator>
#include <limits>
#include <optional>
#include <sstream>
#include <string>

namespace isojam {
namespace {

constexpr double unknown = std::numeric_limits<double>::infinity();

/// The number in a file that contains one number; nullopt if the file is missing or contains "max".
std::optional<double> number_in_file(const std::filesystem::path& path) {
  std::ifstream file(path);
  double value = 0;
  return file >> value ? std::optional(value) : std::nullopt;
}

/// A mounted hierarchy of control groups that can limit memory.
struct Hierarchy {
  std::filesystem::path root;
  const char *limit, *usage;
};

/// Smallest number of bytes left in a group and in the groups that contain it.
double available_in(const Hierarchy& hierarchy, std::filesystem::path group) {
  double least = unknown;
  group = group.relative_path();
  for (bool more = true; more; group = group.parent_path()) {
    more = !group.empty();
    const auto folder = hierarchy.root / group;
    const auto limit = number_in_file(folder / hierarchy.limit), usage = number_in_file(folder / hierarchy.usage);
    if (limit && usage) least = std::min(least, *limit - *usage);
  }
  return least;
}

double available_of_machine() {
  std::ifstream file("/proc/meminfo");
  std::string key, unit;
  double kibibytes = 0;
  while (file >> key >> kibibytes && std::getline(file, unit)) {
    if (key == "MemAvailable:") return 1024 * kibibytes;
  }
  return unknown;
}

}  // namespace

double available_in_groups(std::string_view groups, const std::filesystem::path& root) {
  double least = unknown;
  std::istringstream lines{std::string(groups)};
  // Each line has the form number:controllers:path. Version 2 has an empty list of controllers.
  for (std::string line; std::getline(lines, line);) {
    const auto first = line.find(':'), second = line.find(':', first + 1);
    if (second == std::string::npos) continue;
    const auto controllers = "," + line.substr(first + 1, second - first - 1) + ",";
    const std::filesystem::path group = line.substr(second + 1);
    if (controllers == ",,") {
      for (const auto& mounted : {root, root / "unified"})
        least = std::min(least, available_in({mounted, "memory.max", "memory.current"}, group));
    } else if (controllers.find(",memory,") != std::string::npos) {
      least = std::min(least, available_in({root / "memory", "memory.limit_in_bytes", "memory.usage_in_bytes"}, group));
    }
  }
  return least;
}

double available_memory() {
  std::ifstream file("/proc/self/cgroup");
  const std::string groups{std::istreambuf_iterator<char>(file), {}};
  return std::max(0.0, std::min(available_of_machine(), available_in_groups(groups, "/sys/fs/cgroup")));
}

}  // namespace isojam
