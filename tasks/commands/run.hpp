#pragma once

#include <string>

#include "tasks/manifest/shard.hpp"

namespace isojam {

/// Arguments of `run` and of its dry run.
struct RunArguments {
  std::string manifest;
  std::string directory;  ///< empty: results/<name of the manifest>
  int threads = 0;        ///< 0: as many as are available to this process
  double memory_gib = 0;  ///< for replicates in flight; 0: all available memory
  Shard shard;
  bool dry_run = false;
};

}  // namespace isojam
