#!/usr/bin/env bash
# Runs inside a copy of a clean root with the packages in /packages. Proves that
#   1. the tarball runs from any folder, with the libraries of a minimal system;
#   2. the .deb installs; program, manual page, completions and Python module are in place and work;
#   3. from the .deb and from the tarball, results have the same bytes;
#   4. nothing is left when the .deb is removed.
# Writes the digests of the results to /packages/digests.
set -euo pipefail
cd /packages
fail() {
  echo "inside.sh: $*" >&2
  exit 1
}

mkdir -p '/opt/moved to'
tar -xzf isojam-*-linux-x86_64.tar.gz -C '/opt/moved to'
moved=$(echo '/opt/moved to'/isojam-*)
"$moved/bin/isojam" --version
"$moved/bin/isojam" run quick.json -o moved >/dev/null

export DEBIAN_FRONTEND=noninteractive
apt-get -q update >/dev/null
apt-get -q -y install ./isojam_*.deb >/packages/apt.log 2>&1 || { tail -n 20 apt.log >&2; exit 1; }
[[ $(isojam --version) = "$("$moved/bin/isojam" --version)" ]] || fail 'the .deb and the tarball have different versions'
gzip -dc /usr/share/man/man1/isojam.1.gz | grep -q '^\.TH' || fail 'no manual page'
for file in bash-completion/completions/isojam zsh/vendor-completions/_isojam fish/vendor_completions.d/isojam.fish \
            doc/isojam/copyright doc/isojam/changelog.Debian.gz; do
  [[ -s /usr/share/$file ]] || fail "/usr/share/$file is missing"
done

isojam run quick.json -o installed >/dev/null
isojam report installed >/dev/null
for module in /usr/lib/python3/dist-packages "$moved/lib/python3/dist-packages"; do
  for results in installed moved; do
    PYTHONPATH=$module python3 -c "
import isojam, sys
assert isojam.__file__.startswith(sys.argv[1]), isojam.__file__
study = isojam.load(sys.argv[2])
print(study.record(study.names[0])['result_digest'], len(study.contacts()))" "$module" "$results"
  done
done >digests
[[ $(sort -u digests | wc -l) = 1 ]] || fail "results differ: $(cat digests)"
for folder in packings paths; do
  diff -r "installed/$folder" "moved/$folder" || fail "installed/$folder and moved/$folder differ"
done

apt-get -q -y purge isojam >>apt.log 2>&1
left=$(find / -xdev \( -path /packages -o -path '/opt/moved to' -o -path /proc \) -prune -o -iname '*isojam*' -print)
[[ -z $left ]] || fail "left after removal: $left"
