#!/usr/bin/env bash
# usage: no_contraction_test.sh PROGRAM
# No fused multiply-adds but those that the sources ask for: g++ 12 makes vfmaddsub of a product and a sum where it
# vectorises, and fcmla of complex products on arm64, -ffp-contract=off or not. Which bits a run produces would be up to it.
set -euo pipefail
found=$(objdump -d --no-show-raw-insn "$1" | grep -cE 'vfm(addsub|subadd)|fcmla' || true)
echo "$1: $found contracted pairs of sum and difference"
[[ $found == 0 ]]
