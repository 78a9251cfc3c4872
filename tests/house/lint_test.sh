#!/usr/bin/env bash
# usage: lint_test.sh ROOT
# Every line of bad/tidy.cpp marked `// expect CHECK` breaks this check; bad/format.cpp breaks the format.
set -euo pipefail
root=$(cd "${1:?usage: lint_test.sh ROOT}" && pwd)
bad=$root/tests/house/bad
failures=0
fail() { echo "FAILED: $1"; sed 's/^/    /' <<<"${2:-}"; failures=$((failures + 1)); }
format() { clang-format --style=file:"$root/.clang-format" --dry-run -Werror "$@" 2>&1; }
tidy() { clang-tidy --quiet --config-file="$root/.clang-tidy" "$1" -- -std=c++20 2>&1; }

said=$(format "$bad/tidy.cpp") || fail 'formatter rejected a well laid out file' "$said"
said=$(format "$bad/format.cpp") && fail 'formatter accepted bad/format.cpp' "$said"
[[ $said == *clang-format-violations* ]] || fail 'formatter failed for another reason than layout' "$said"
wide="const int xy = $(printf '1 + %.0s' {1..26})1;"  # 121 columns
said=$(format <<<"$wide") && fail "formatter accepted ${#wide} columns" "$wide"
said=$(format <<<"${wide/xy/x}") || fail 'formatter rejected 120 columns' "$said"

wide_comments() { LC_ALL=C.UTF-8 grep -nE '^.{121,}' "$@" | grep -E '^[^"]*//' | grep -v NOLINT; }
comment="// $(printf 'φ%.0s' {1..118})"  # 121 columns
wide_comments <<<"$comment" >/dev/null || fail 'a comment of 121 columns was accepted'
said=$(wide_comments <<<"${comment%φ}") && fail 'a comment of 120 columns was rejected' "$said"
said=$(cd "$root" && wide_comments -r --include='*.[ch]pp' engine tasks tests) && fail 'comments end at 120 columns' "$said"

said=$(tidy "$bad/tidy.cpp") && fail 'linter accepted bad/tidy.cpp' "$said"
expected=0
while IFS=: read -r line check; do
  expected=$((expected + 1))
  grep -qE "^$bad/tidy.cpp:$line:[0-9]+: error: .*\[$check,-warnings-as-errors\]" <<<"$said" ||
    fail "linter did not report $check on line $line" "$said"
done < <(grep -n '// expect ' "$bad/tidy.cpp" | sed -E 's|^([0-9]+):.*// expect |\1:|')
[[ $expected -ge 10 ]] || fail "read only $expected expectations from bad/tidy.cpp"

on=$(clang-tidy --config-file="$root/.clang-tidy" --list-checks "$bad/tidy.cpp" -- | sed 's/^ *//')
asked=$(sed -n '/^Checks:/,/"$/p' "$root/.clang-tidy" | tr -d ' "\\\n' | sed 's/^Checks://' | tr ',' '\n')
while read -r check; do
  case $check in
    -*) ! grep -qx -- "${check#-}" <<<"$on" || fail "$check is switched on" ;;
    *) grep -qxE -- "${check//\*/.*}" <<<"$on" || fail "$check is asked for and not on: unknown, or dropped" ;;
  esac
done <<<"$asked"
[[ $(wc -l <<<"$asked") -ge 60 ]] || fail 'read too few checks from .clang-tidy' "$asked"

[[ $failures -eq 0 ]] && echo "linters reject what they must: $expected lines, $(wc -l <<<"$on") checks on"
