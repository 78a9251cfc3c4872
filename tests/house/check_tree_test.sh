#!/usr/bin/env bash
# usage: check_tree_test.sh
# Facts proved: check_tree.sh accepts a small tree that keeps every rule, and rejects it, naming file, line and
# rule, after each single change below. A rule that no longer bites fails here.
set -euo pipefail
here=$(cd "$(dirname "$0")" && pwd)
tree=$(mktemp -d)
trap 'rm -rf "$tree"' EXIT

good_tree() {
  rm -rf "${tree:?}"/*
  mkdir -p "$tree"/engine/{random,parallel,geometry,packing,solve/factor,analysis} "$tree"/tasks/{system,json,store,run,commands} "$tree/tests"
  printf '#pragma once\n#include <Eigen/Core>\n#include <vector>\n' >"$tree/engine/geometry/pose.hpp"
  printf '#include <tbb/parallel_for.h>\n#include "engine/random/stream.hpp"\n' >"$tree/engine/parallel/parallel.cpp"
  printf '#include "engine/parallel/parallel.hpp"\n#include "engine/geometry/pose.hpp"\n' >"$tree/engine/packing/pair_loop.cpp"
  printf '#include <metis.h>\n' >"$tree/engine/solve/factor/ordering.cpp"
  printf '#include "engine/packing/energy.hpp"\n// #include <chrono>\n' >"$tree/engine/solve/jam.cpp"
  printf '#include <oneapi/tbb/flow_graph.h>\n#include <chrono>\n#include "engine/solve/jam.hpp"\n' >"$tree/tasks/run/graph.cpp"
  printf '#include "tasks/commands/command.hpp"\n' >"$tree/tasks/main.cpp"
  printf '#include <CLI/CLI.hpp>\n#include "tasks/commands/command.hpp"\n' >"$tree/tasks/commands/command_line.cpp"
  printf '#include "tasks/system/file.hpp"\n#include "tasks/json/json.hpp"\n' >"$tree/tasks/store/store.hpp"
  printf '#include <tbb/global_control.h>\n' >"$tree/tests/threads_test.cpp"
}

failures=0
fail() { echo "FAILED: $1"; sed 's/^/    /' <<<"$2"; failures=$((failures + 1)); }

accept() {  # what
  local said
  said=$("$here/check_tree.sh" "$tree" 2>&1) || fail "rejected $1" "$said"
}

reject() {  # file, line appended to it, reason expected
  local said status=0 line
  good_tree
  mkdir -p "$tree/$(dirname "$1")"
  printf '%s\n' "$2" >>"$tree/$1"
  line=$(wc -l <"$tree/$1")
  said=$("$here/check_tree.sh" "$tree" 2>&1) || status=$?
  [[ $status -eq 1 && $said == *"$1:$line: $3"* ]] || fail "expected '$1:$line: $3' and exit 1, exit was $status after: $2" "$said"
}

good_tree
accept 'a tree that keeps every rule'

foreign='engine/ includes what is not engine/'
reject engine/packing/energy.cpp '#include "tasks/run/graph.hpp"' "$foreign"
reject engine/packing/energy.cpp '#include <tasks/run/graph.hpp>' "$foreign"
reject engine/packing/energy.cpp '#include "../../tasks/run/graph.hpp"' "$foreign"
reject engine/packing/energy.hpp '#include <nlohmann/json.hpp>' "$foreign"
reject engine/packing/energy.hpp '#include <nlohmann/json_fwd.hpp>' "$foreign"
reject engine/solve/jam.cpp '#include <fmt/core.h>' "$foreign"
reject engine/solve/jam.cpp '#include <CLI/CLI.hpp>' "$foreign"
reject engine/solve/jam.cpp '#include <unistd.h>' "$foreign"
reject engine/solve/jam.cpp '#include <sys/stat.h>' "$foreign"

outside='engine/ touches files, clock'
for header in filesystem chrono ctime fstream iostream cstdio; do
  reject engine/solve/jam.cpp "#include <$header>" "$outside"
done
reject engine/geometry/pose.hpp ' #  include <chrono> // by the way' "$outside"
reject engine/geometry/pose.hpp 'inline auto now() { return std::chrono::steady_clock::now(); }' "$outside"
reject engine/solve/jam.cpp 'const char* threads = std::getenv("THREADS");' "$outside"
reject engine/solve/jam.cpp 'void say() { std::cerr << 1; }' "$outside"
reject engine/random/stream.cpp 'std::random_device seed;' "$outside"
reject engine/solve/jam.cpp '#include HEADER' 'include that cannot be read'

upwards='include points upwards'
reject engine/random/stream.hpp '#include "engine/geometry/pose.hpp"' "$upwards"
reject engine/parallel/parallel.cpp '#include "engine/packing/packing.hpp"' "$upwards"
reject engine/geometry/overlap.cpp '#include "engine/packing/packing.hpp"' "$upwards"
reject engine/packing/energy.cpp '#include "engine/solve/jam.hpp"' "$upwards"
reject engine/solve/minimise/lbfgs.cpp '#include "engine/analysis/contacts.hpp"' "$upwards"
reject tasks/store/store.hpp '#include "tasks/run/graph.hpp"' "$upwards"
reject tasks/json/place.hpp '#include "tasks/manifest/plan.hpp"' "$upwards"
reject tasks/system/file.hpp '  # include "tasks/json/json.hpp"' "$upwards"
reject tasks/odds/ends.cpp '#include "tasks/json/json.hpp"' 'room of tasks/ without a place'
reject tasks/loose.cpp '#include "tasks/json/json.hpp"' 'room of tasks/ without a place'
reject tasks/json/json.cpp '#include "tasks/odds/ends.hpp"' 'room of tasks/ without a place'
reject engine/extra/thing.cpp '#include "engine/geometry/pose.hpp"' 'room of engine/ without a place'

tbb='oneTBB outside its two sources'
reject engine/parallel/parallel.hpp '#include <tbb/parallel_for.h>' "$tbb"
reject engine/packing/pair_loop.cpp '#include <tbb/parallel_for.h>' "$tbb"
reject engine/packing/energy.cpp '#include <tbb/parallel_for.h>' "$tbb"
reject engine/solve/jam.cpp '#include <oneapi/tbb/task_arena.h>' "$tbb"
reject engine/solve/jam.cpp '#include "tbb/task_arena.h"' "$tbb"
reject tasks/run/graph.hpp '#include <oneapi/tbb/flow_graph.h>' "$tbb"
reject tasks/store/store.cpp '#include <tbb/global_control.h>' "$tbb"
reject tasks/store/store.cpp '#include <execution>' "$tbb"

reject engine/solve/factor/elimination.cpp '#include <metis.h>' 'METIS outside its source'
reject tasks/run/graph.cpp '#include <metis.h>' 'METIS outside its source'
reject tasks/commands/run.cpp '#include <CLI/App.hpp>' 'CLI11 outside its source'

reject ratios.json '{}' 'not at the top'

long=$(printf '// line\n%.0s' {1..400})
for file in engine/solve/jam.cpp tasks/run/graph.cpp tests/threads_test.cpp; do reject "$file" "$long" 'more than 400 lines'; done
good_tree
printf '%s\n' "$long" >"$tree/tasks/run/campaign.cpp"
accept 'a file of exactly 400 lines'

rm -rf "${tree:?}"/engine
said=$("$here/check_tree.sh" "$tree" 2>&1) && fail 'accepted a tree without engine/' "$said"

[[ $failures -eq 0 ]] && echo 'every rule bites'
