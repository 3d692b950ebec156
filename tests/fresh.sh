#!/usr/bin/env bash
# Builds and tests a clone of the last commit in a bare root of another system, as `./dev test` would there.
# ./dev fresh calls it: SUITE [gcc|clang] [arguments of ctest]. It needs root and debootstrap, and leaves nothing on
# the machine but a cache: bare roots, packages and compiled objects in ~/.cache/shoal/fresh.
set -euo pipefail
project=$(cd "$(dirname "${BASH_SOURCE[0]}")/.." && pwd)
suite=$1 compiler=${2:-gcc}
[[ $suite =~ ^[a-z]+$ ]] || { printf 'expected a suite such as trixie, found "%s"\n' "$suite" >&2; exit 2; }
shift
[ $# -eq 0 ] || shift
cache=${XDG_CACHE_HOME:-$HOME/.cache}/shoal/fresh
root=$cache/root-$suite-$compiler
log=$cache/$suite-$compiler.log
mkdir -p "$cache/packages-$suite" "$cache/compiled-$suite"

# All mounts are of this process alone, and are gone with it.
if [ "${SHOAL_FRESH_APART:-}" != 1 ]; then
    SHOAL_FRESH_APART=1 exec unshare --mount --pid --fork --mount-proc "$0" "$suite" "$compiler" "$@"
fi

say() { printf '%s\n' "$*" >&2; }

if [ ! -f "$cache/$suite.tar" ]; then
    say "Making a bare root of $suite"
    rm -rf "$cache/making-$suite"
    if ! debootstrap --variant=minbase "$suite" "$cache/making-$suite" >"$log" 2>&1; then
        tail -n 5 "$log" >&2
        printf '%s %s: not to be had (debootstrap failed)\n' "$suite" "$compiler"
        exit 1
    fi
    tar -C "$cache/making-$suite" -cf "$cache/$suite.tar.part" .
    mv "$cache/$suite.tar.part" "$cache/$suite.tar"
    rm -rf "$cache/making-$suite"
fi

rm -rf "$root"
mkdir -p "$root"
tar -C "$root" -xf "$cache/$suite.tar"
for name in proc sys dev; do mount --rbind "/$name" "$root/$name"; done
mount -t tmpfs tmpfs "$root/dev/shm" 2>/dev/null || true
mkdir -p "$root/var/cache/apt/archives" "$root/root/.cache/ccache"
mount --bind "$cache/packages-$suite" "$root/var/cache/apt/archives"
mount --bind "$cache/compiled-$suite" "$root/root/.cache/ccache"
printf 'Binary::apt::APT::Keep-Downloaded-Packages "1";\nAPT::Keep-Downloaded-Packages "1";\n' \
    >"$root/etc/apt/apt.conf.d/01keep"
# A mirror may lag behind.
printf 'Acquire::Check-Valid-Until "false";\n' >"$root/etc/apt/apt.conf.d/01late"
rm -f "$root/etc/apt/apt.conf.d/docker-clean"
cp /etc/resolv.conf /etc/hosts "$root/etc/" 2>/dev/null || true
for file in /etc/apt/apt.conf.d/*proxy*; do [ ! -f "$file" ] || cp "$file" "$root/etc/apt/apt.conf.d/"; done
git clone --quiet "$project" "$root/root/shoal"

say "Building and testing on $suite with $compiler; the log is $log"
code=0
setarch "$(uname -m)" chroot "$root" /usr/bin/env -i HOME=/root PATH=/usr/sbin:/usr/bin:/sbin:/bin LANG=C.UTF-8 CI=true \
    SHOAL_WERROR="${SHOAL_WERROR:-}" SHOAL_FRESH_COMPILER="$compiler" bash -c '
    set -e
    cd /root/shoal
    if [ "$SHOAL_FRESH_COMPILER" = clang ]; then
        apt-get update -qq
        # the oldest that CMakeLists.txt takes, where the suite has an older one
        name=$(apt-cache show clang | grep -q "^Version: 1:1[0-5]\." && echo clang-16 || echo clang)
        DEBIAN_FRONTEND=noninteractive apt-get install -y -qq --no-install-recommends "$name" >/dev/null
        export CC=$name CXX=${name/clang/clang++}
    fi
    ./dev test "$@"' fresh "$@" >"$log" 2>&1 || code=$?

versions=$(chroot "$root" dpkg-query -W -f='${Package} ${Version}\n' 2>/dev/null | awk '
    { name = $1; version = $2; sub(/^[0-9]+:/, "", version); sub(/[-+].*/, "", version) }
    name ~ /^(g\+\+-[0-9]+|clang-[0-9]+|libglm-dev|libassimp-dev|libimgui-dev|libembree-dev|libcatch2-dev|libopenexr-dev|libgl1-mesa-dri|libglfw3-dev|cmake)$/ {
        printf "%s %s, ", name, version }' | sed 's/, $//')
summary=$(grep -E 'tests passed|tests failed' "$log" | tail -n 1 || true)
warnings=$(grep -c 'warning:' "$log" || true)
printf '%s %s: %s; %s; %s warnings; %s\n' "$suite" "$compiler" \
    "$([ "$code" -eq 0 ] && echo passed || echo "failed ($code)")" \
    "${summary:-no test ran: $(grep -m 1 -E 'error' "$log" || tail -n 1 "$log")}" "$warnings" "$versions"
# What is mounted goes first: the caches lie below the root, on the same device.
for name in var/cache/apt/archives root/.cache/ccache proc sys dev; do umount -R -l "$root/$name"; done
[ "$code" -ne 0 ] || rm -rf --one-file-system "$root"
exit "$code"
