#!/bin/sh
# Starts @WHAT@ with the libraries of this folder.
#
#   lib           libraries that only Shoal uses; always these.
#   lib/fallback  libraries that an OpenGL driver may use as well, one folder each. Two copies of one, or an older
#                 one than the driver was made for, would break it. So the machine's own goes first, and one from
#                 here is taken where the machine has none or one that is older than needed.
set -eu

here=$(readlink -f -- "$0")
here=${here%/*}
machine=${LD_LIBRARY_PATH-}
ours=$here/lib
program=$here/bin/shoal
# @TESTED@

# What the dynamic loader finds for the program and more libraries, which are opened at run time. Nothing runs.
trace() { # libraries, with spaces between
    LC_ALL=C LD_TRACE_LOADED_OBJECTS=1 LD_PRELOAD="$1${LD_PRELOAD:+ $LD_PRELOAD}" \
        LD_LIBRARY_PATH="$ours${machine:+:$machine}" "$program" 2>&1 || true
}

found() { # library
    case $(trace "$1") in *"object '$1'"*) return 1 ;; esac
}

# From a trace, the names of libraries that are missing or too old.
missing() {
    while IFS= read -r line; do
        case $line in
        *' => not found'*)
            line=${line%% =>*}
            printf '%s\n' "${line##*[[:space:]]}"
            ;;
        *': version `'*"' not found"*)
            line=${line%%: version *}
            printf '%s\n' "${line##*/}"
            ;;
        "ERROR: ld.so: object '"*"' from LD_PRELOAD"*)
            line=${line#*object \'}
            printf '%s\n' "${line%%\'*}"
            ;;
        esac
    done
}

# Where container hosts put NVIDIA's driver, which the dynamic loader need not know.
for folder in /usr/local/nvidia/lib64 /usr/local/nvidia/lib; do
    if [ -e "$folder/libEGL_nvidia.so.0" ] && ! found libEGL_nvidia.so.0; then
        machine=${machine:+$machine:}$folder
    fi
done

# What one library needs shows once it is there, so this goes on until nothing is added.
while :; do
    report=$(trace "libEGL.so.1 libEGL_nvidia.so.0")
    case $report in
    *'=>'*) ;;
    *)
        printf 'shoal: this machine does not run the program, which needs @MACHINE@ and @GLIBC@\n%s\n' "$report" >&2
        exit 1
        ;;
    esac
    added=
    for name in $(printf '%s\n' "$report" | missing); do
        case $name in
        libc.so.* | libm.so.*)
            echo 'shoal: needs @GLIBC@; the glibc of this machine is older' >&2
            exit 1
            ;;
        esac
        folder=$here/lib/fallback/$name
        case ":$ours:" in *":$folder:"*) continue ;; esac
        [ -d "$folder" ] || continue
        ours=$ours:$folder
        added=yes
    done
    [ -n "$added" ] || break
done

# EGL finds a driver through a file that names it. Containers often have NVIDIA's library without that file.
if [ -z "${__EGL_VENDOR_LIBRARY_FILENAMES-}${__EGL_VENDOR_LIBRARY_DIRS-}" ] && found libEGL_nvidia.so.0; then
    files=
    named=
    for file in /etc/glvnd/egl_vendor.d/*.json /usr/share/glvnd/egl_vendor.d/*.json; do
        [ -r "$file" ] || continue
        files=$files:$file
        case $(cat "$file") in *libEGL_nvidia*) named=yes ;; esac
    done
    if [ -z "$named" ]; then
        export __EGL_VENDOR_LIBRARY_FILENAMES="$here/lib/egl_nvidia.json$files"
    fi
fi

export LD_LIBRARY_PATH="$ours${machine:+:$machine}"
exec "$program" "$@"
