#!/usr/bin/env bash
# conda-build calls this in the source folder. conda-forge has neither Vega nor three.js in Debian's layout, so `report` and
# `chart` are left out.
set -euo pipefail
cmake -S . -B build -G Ninja ${CMAKE_ARGS} -DISOJAM_TESTS=OFF -DISOJAM_PAGES=OFF \
  -DISOJAM_PYTHON="$PYTHON" -DISOJAM_PYTHON_DIR="${SP_DIR#"$PREFIX"/}"
cmake --build build -j "$CPU_COUNT"
cmake --install build
