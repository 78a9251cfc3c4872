#!/usr/bin/env bash
# usage: test.sh PACKAGES ROOT...     as root
# Tries the .deb and the tarball of the folder PACKAGES in a copy of each clean root (inside.sh says how), and compares the
# results of all roots.
set -euo pipefail
here=$(cd "$(dirname "$0")" && pwd)
packages=${1:?usage: test.sh PACKAGES ROOT...}
shift
[[ $(id -u) = 0 ]] || { echo 'test.sh: entering a root needs the rights of root; run it with sudo' >&2; exit 1; }
scratch=$(mktemp -d "$packages/roots.XXXXXX")
trap 'rm -rf --one-file-system "$scratch"' EXIT

for root in "$@"; do
  copy=$scratch/$(basename "$root")
  cp -a "$root" "$copy"
  mkdir "$copy/packages"
  cp "$packages"/isojam_*_amd64.deb "$packages"/isojam-*-linux-x86_64.tar.gz "$here/inside.sh" \
    "$here/../reproducibility/quick.json" "$copy/packages"
  echo "== $root: $(. "$copy/etc/os-release" && echo "$PRETTY_NAME")"
  "$here/../debian/root.sh" run "$copy" bash /packages/inside.sh
  cp "$copy/packages/digests" "$scratch/digests.$(basename "$root")"
  cmp "$scratch/digests.$(basename "$1")" "$scratch/digests.$(basename "$root")"
  rm -rf --one-file-system "$copy"
done
echo "the same results in $# roots"
