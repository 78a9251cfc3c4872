#!/usr/bin/env bash
# usage: check_tree.sh ROOT
# Proves, line by line, of the tree at ROOT:
#   1. engine/ includes only engine/, the standard library, Eigen, Spectra, Boost.Math and METIS: nothing of tasks/,
#      no JSON, no formatting or command-line library, no file, clock, stream or environment; nor does it name these
#      by way of a header that happens to bring them.
#   2. inside engine/ and inside tasks/, includes never point upwards in the order of rooms below, and every source but
#      tasks/main.cpp stands in one of them.
#   3. oneTBB (also by way of <execution>) enters engine/parallel/parallel.cpp and tasks/run/graph.cpp, nothing else;
#      CLI11 enters tasks/commands/command_line.cpp; METIS enters engine/solve/factor/ordering.cpp.
#   4. no source of engine/, tasks/ or tests/ is longer than 400 lines.
#   5. nothing stands at the top that is not agreed on, build directories and results apart, which git ignores.
# Prints one line per breach, `file:line: why: text`, and exits 1 if there is one.
set -euo pipefail
export LC_ALL=C
cd "${1:?usage: check_tree.sh ROOT}"

readonly max_lines=400
readonly engine_rooms='names arithmetic random parallel geometry packing solve analysis vibration shear rigidity'
readonly tasks_rooms='system json solids packings measure manifest replicate store tables run page report export chart commands python'
readonly tbb_sources=' engine/parallel/parallel.cpp tasks/run/graph.cpp '
readonly cli_sources=' tasks/commands/command_line.cpp '
readonly metis_source='engine/solve/factor/ordering.cpp'
readonly banned_headers=' filesystem chrono ctime fstream iostream istream ostream sstream syncstream cstdio iomanip execution '
readonly system_headers=' quadmath.h immintrin.h '
readonly banned_names='std::(chrono|filesystem|cout|cerr|clog|random_device)\b|\b(std::)?(getenv|fopen|printf|clock_gettime)\('

breaches=0
breach() {  # file line why text
  printf '%s:%s: %s: %s\n' "$1" "$2" "$3" "$4"
  breaches=$((breaches + 1))
}

rank() {  # half/room/... -> the room's place in the order of its half, or nothing
  local place=0 name half=${1%%/*} room rooms
  room=$(cut -d/ -f2 <<<"$1")
  rooms=${half}_rooms
  for name in ${!rooms}; do
    [[ $name == "$room" ]] && { echo "$place"; return; }
    place=$((place + 1))
  done
}

check_order() {  # file line header; both of one half
  [[ $1 != tasks/main.cpp ]] || return 0
  local own theirs
  own=$(rank "$1") theirs=$(rank "${3:1:-1}")
  [[ -n $own && -n $theirs ]] || breach "$1" "$2" "room of ${1%%/*}/ without a place in the order" "$3"
  [[ -z $own || -z $theirs || $theirs -le $own ]] || breach "$1" "$2" 'include points upwards' "$3"
}

check_engine_include() {  # file line header
  case $3 in
    \"engine/*) check_order "$@" ;;
    \"*) breach "$1" "$2" 'engine/ includes what is not engine/' "$3" ;;
    '<Eigen/'* | '<Spectra/'* | '<boost/math/'*) ;;
    '<tbb/'* | '<oneapi/'* | '<metis.h>') ;;  # rule 3
    *[/.]*) [[ $system_headers == *" ${3:1:-1} "* ]] || breach "$1" "$2" 'engine/ includes what is not engine/' "$3" ;;
    *) [[ $banned_headers != *" ${3:1:-1} "* ]] || breach "$1" "$2" 'engine/ touches files, clock or streams' "$3" ;;
  esac
}

check_include() {  # file line header
  [[ $1 != engine/* ]] || check_engine_include "$@"
  [[ $1 != tasks/* || $3 != \"tasks/* ]] || check_order "$@"
  case $3 in
    [\<\"]tbb/* | [\<\"]oneapi/* | '<execution>')
      [[ $tbb_sources == *" $1 "* ]] || breach "$1" "$2" 'oneTBB outside its two sources' "$3" ;;
    [\<\"]CLI/*)
      [[ $cli_sources == *" $1 "* ]] || breach "$1" "$2" 'CLI11 outside its source' "$3" ;;
    [\<\"]metis.h[\>\"])
      [[ $1 == "$metis_source" ]] || breach "$1" "$2" 'METIS outside its source' "$3" ;;
  esac
}

readonly top=' engine tasks schemas tests examples docs CMakeLists.txt CMakePresets.json Containerfile Makefile README.md LICENSE CITATION.cff CHANGELOG.md CONTRIBUTING.md .ci .git .gitignore .clang-format .clang-tidy '
for name in $(ls -A); do
  [[ $top == *" $name "* || $name == build* || $name == results ]] || breach "$name" 1 'not at the top' "$name"
done

rooms=()
for room in engine tasks tests; do [[ ! -d $room ]] || rooms+=("$room"); done
[[ -d engine ]] || { echo "no engine/ in $PWD: nothing to prove" >&2; exit 2; }

sources=$(find "${rooms[@]}" -path tests/house/bad -prune -o -type f \
            \( -name '*.cpp' -o -name '*.hpp' -o -name '*.h' -o -name '*.sh' -o -name '*.cmake' -o -name CMakeLists.txt \) -print | sort)
while read -r file; do
  length=$(wc -l <"$file")
  [[ $length -le $max_lines ]] || breach "$file" "$length" "more than $max_lines lines" "$length"
done <<<"$sources"

directive='^[[:space:]]*#[[:space:]]*(include|include_next|import)\b'
includes=0
while IFS=: read -r file line text; do
  [[ -n $file ]] || continue
  includes=$((includes + 1))
  if [[ $text =~ (\<[^\>]*\>|\"[^\"]*\") ]]; then
    check_include "$file" "$line" "${BASH_REMATCH[1]}"
  else
    breach "$file" "$line" 'include that cannot be read' "$text"
  fi
done < <(grep -rnE "$directive" engine $([[ ! -d tasks ]] || echo tasks) --include='*.[ch]pp' --include='*.h' || true)

while IFS=: read -r file line text; do
  [[ -n $file ]] || continue
  breach "$file" "$line" 'engine/ touches files, clock, streams or environment' "$text"
done < <(grep -rnE "$banned_names" engine --include='*.[ch]pp' --include='*.h' || true)

[[ $includes -gt 0 ]] || { echo "no include found in $PWD: nothing was proved" >&2; exit 2; }
echo "$includes includes, $(wc -l <<<"$sources") files, $breaches breaches"
[[ $breaches -eq 0 ]]
