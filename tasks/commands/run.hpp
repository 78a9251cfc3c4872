#pragma once

#include <string>

#include "tasks/manifest/shard.hpp"

namespace isojam {

/// Arguments of `run` and of its dry run.
struct RunArguments {
  std::string manifest;
  std::string directory;  ///< results directory; empty means results/<name of the manifest>
  int threads = 0;        ///< number of threads; 0 means all threads that the system allows this process
  double memory_gib = 0;  ///< memory (GiB) for all replicates that run at the same time; 0 means all available memory
  Shard shard;
  bool dry_run = false;
};

}  // namespace isojam
