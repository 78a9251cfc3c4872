#!/usr/bin/env bash
# A clean root of a Debian release, to try the program as a new user finds it there. As root; needs debootstrap.
#   root.sh make DIR SUITE         installs a minimal SUITE (bookworm, trixie) and make in DIR
#   root.sh clone DIR SOURCE       a fresh clone of the HEAD of SOURCE, in DIR/isojam
#   root.sh run DIR COMMAND...     runs COMMAND in DIR/isojam; prints its CPU seconds to stderr
#   root.sh remove DIR
# Mounts live in a namespace of the command that needs them: nothing stays mounted, even after a kill.
set -euo pipefail
verb=${1:?make, clone, run or remove} dir=$(realpath -m "${2:?DIR}")
shift 2

# Runs a command inside the root.
inside() {
  unshare --mount --propagation private bash -c '
    set -e
    root=$1; shift
    mount -t proc proc "$root/proc"
    mount --rbind /sys "$root/sys"
    mount --rbind /dev "$root/dev"
    cp /etc/resolv.conf "$root/etc/resolv.conf"
    exec chroot "$root" /usr/bin/env -i HOME=/root LANG=C.UTF-8 PATH=/usr/local/sbin:/usr/local/bin:/usr/sbin:/usr/bin:/sbin:/bin \
      bash -c "cd /isojam 2>/dev/null || cd /; exec \"\$@\"" bash "$@"' bash "$dir" "$@"
}

case $verb in
  make)
    [[ $(id -u) = 0 ]] || { echo 'root.sh: making a root needs the rights of root; run it with sudo' >&2; exit 1; }
    command -v debootstrap >/dev/null || { echo 'root.sh: debootstrap is missing; apt-get install debootstrap' >&2; exit 1; }
    rm -rf --one-file-system "$dir"
    debootstrap --variant=minbase "${1:?SUITE}" "$dir" >"$dir.log" 2>&1 || { tail -n 5 "$dir.log" >&2; exit 1; }
    # Debian's installer writes this file; without it chromedriver does not find localhost.
    printf '127.0.0.1\tlocalhost\n::1\tlocalhost\n' >"$dir/etc/hosts"
    inside apt-get -q update >/dev/null
    inside apt-get -q -y install --no-install-recommends ca-certificates make >/dev/null ;;
  clone)
    rm -rf "$dir/isojam"
    git clone -q "${1:?SOURCE}" "$dir/isojam" ;;
  run)
    TIMEFORMAT='%U s of user and %S s of system CPU time, %R s elapsed'
    time inside "$@" </dev/null ;;
  remove)
    rm -rf --one-file-system "$dir" "$dir.log" ;;
  *)
    echo "root.sh: unknown command $verb" >&2
    exit 2 ;;
esac
