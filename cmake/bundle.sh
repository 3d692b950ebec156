#!/usr/bin/env bash
# Packs the command, its libraries, the shaders and the data into one folder, and that into FOLDER.tar.gz.
# The folder runs on other machines without our packages; see cmake/bundle_launcher.sh, which becomes its `shoal`.
# With TESTS, the folder of the test programs, these and what they read go in as well, and its `tested` starts them
# (cmake/bundle_tested.sh).
# Run as: cmake/bundle.sh BINARY FOLDER [TESTS]
set -euo pipefail

source_dir=$(cd "$(dirname "${BASH_SOURCE[0]}")/.." && pwd)
limit=$((110 * 1024 * 1024)) # bytes, without tests; Embree alone has 42 MiB, OpenEXR 4
test_programs=(shoal-unit shoal-gl shoal-hard)

say() { printf '%s\n' "$*" >&2; }
fail() { say "bundle: $*"; exit 1; }

[ $# -eq 2 ] || [ $# -eq 3 ] || fail "run as: bundle.sh BINARY FOLDER [TESTS]"
binary=$1
folder=${2%/}
tests=${3-}
[ -x "$binary" ] || fail "$binary is not there; build it first"
case $folder in *[:\;]*) fail "the folder's name may not contain : or ;, which separate search paths" ;; esac
if [ -e "$folder" ] && [ ! -e "$folder/bin/shoal" ] && [ -n "$(ls -A "$folder")" ]; then
    fail "$folder holds something else; remove it or choose another folder"
fi

# Part of glibc: must match the machine's dynamic loader.
of_glibc() { # library
    case $1 in
    ld-linux*.so.* | libc.so.* | libm.so.* | libmvec.so.* | libpthread.so.* | libdl.so.* | librt.so.*) ;;
    libresolv.so.* | libutil.so.* | libnsl.so.* | libanl.so.* | libBrokenLocale.so.*) ;;
    *) return 1 ;;
    esac
}

# Part of a driver: must match the machine's kernel.
of_driver() { # library
    case $1 in
    libEGL_*.so.* | libGLX_*.so.* | libgbm.so.* | libdrm*.so.* | libnvidia*.so.* | libglapi.so.*) ;;
    libgallium*.so* | libLLVM*.so* | libOSMesa.so.*) ;;
    *) return 1 ;;
    esac
}

# The vendor-neutral front of OpenGL, which passes calls on to a driver: only libglvnd's.
of_front() { # library
    case $1 in
    libGL.so.* | libGLX.so.* | libOpenGL.so.* | libEGL.so.* | libGLdispatch.so.*) ;;
    *) return 1 ;;
    esac
}
is_glvnd() { # library, file
    case $1 in
    libGLdispatch.so.*) ;;
    *) readelf -d "$2" | grep -q 'NEEDED.*libGLdispatch' ;;
    esac
}

# Used by drivers as well, or by ffmpeg, which we start: the machine's own go first.
shared() { # library
    case $1 in
    libstdc++.so.* | libgcc_s.so.* | libz.so.* | libpng*.so.* | libzstd.so.* | liblzma.so.*) ;;
    libfontconfig.so.* | libfreetype.so.* | libbrotli*.so.*) ;;
    libexpat.so.* | libffi.so.* | libelf.so.* | libbsd.so.* | libmd.so.*) ;;
    libX*.so.* | libxcb*.so.* | libxkb*.so.* | libxshmfence.so.* | libwayland-*.so.*) ;;
    *) of_front "$1" ;;
    esac
}

# "name path" of each library that a program takes, libEGL included, which it opens at run time.
libraries() { # program
    local trace
    trace=$(LC_ALL=C LD_TRACE_LOADED_OBJECTS=1 LD_PRELOAD="libEGL.so.1" "$1" 2>&1)
    if grep -q "=> not found" <<<"$trace"; then fail "$1 itself does not run here: $trace"; fi
    sed -n 's|^[[:space:]]*\(lib[^ ]*\) => \(/[^ ]*\) (.*|\1 \2|p' <<<"$trace"
}

pack_library() { # name, path
    local place=$part/lib
    if of_front "$1" && ! is_glvnd "$1" "$2"; then
        say "$1 here is a driver's own: left out"
        return 0
    fi
    if shared "$1"; then place=$part/lib/fallback/$1; fi
    mkdir -p "$place"
    cp -L "$2" "$place/$1"
    chmod u+w "$place/$1"
    strip --strip-unneeded "$place/$1"
    pack_licence "$1" "$2"
}

# The licences of what is passed on, where the packages say.
pack_licence() { # name, path
    local real file package
    command -v dpkg-query >/dev/null || return 0
    real=$(readlink -f "$2")
    for file in "$real" "${real#/usr}"; do
        package=$(dpkg-query -S "$file" 2>/dev/null | head -n 1 | cut -d: -f1) || continue
        [ -r "/usr/share/doc/$package/copyright" ] || continue
        mkdir -p "$part/licenses"
        cp -L "/usr/share/doc/$package/copyright" "$part/licenses/$package.txt"
        return 0
    done
}

# The newest version of glibc that something in these folders asks for.
needed_glibc() { # folder...
    find "$@" -type f ! -name '*.json' -exec objdump -p {} + |
        sed -n -e 's/.* GLIBC_\([0-9][0-9.]*\)$/\1/p' -e 's/.* GLIBC_ABI_DT_RELR$/2.36/p' | sort -uV | tail -n 1
}

write_readme() { # which glibc
    local bench=
    if "$binary" --help | grep '^  bench ' >/dev/null; then bench=$'\n    ./shoal bench'; fi
    cat >"$part/README.txt" <<TEXT
$("$binary" --version | head -n 1 | sed 's/^[^0-9]*/Shoal /')

Shoal simulates and draws very many small mass-spring meshes on the GPU. This folder runs as it is, from anywhere:

    ./shoal info
    ./shoal run models/tree/leaves.scene.json --headless --capture pictures$bench
    ./shoal --help

It needs of the machine: $(uname -m); $1;
a driver with OpenGL 3.3 or newer that offers EGL, such as NVIDIA's or Mesa's. Everything else is in here.
A display is not needed. A window needs the X11 libraries of a desktop (libX11, libXcursor, libXi, libXinerama,
libXrandr), a video the ffmpeg command.

\`./shoal info\` says which driver is found and why others are not. A container gets NVIDIA's when its runtime passes
the driver's "graphics" capability on (NVIDIA_DRIVER_CAPABILITIES=all).

shoal           starts bin/shoal with the libraries in lib
lib/fallback    libraries that are taken only where the machine has none, or older ones
shaders         the simulation and the picture, as text
molecules       molecule files
models          meshes and scenes
licenses        of the libraries in lib; LICENSE is Shoal's
TEXT
    [ -z "$tests" ] || cat >>"$part/README.txt" <<TEXT

The tests are in here as well:

    ./tested shoal-gl "[agreement]"     of OpenGL; without a word all of them, some minutes on a GPU
    ./tested shoal-hard                 the hard cases
    ./tested shoal-unit                 what needs no OpenGL

They look for their files in $source_dir, which becomes a link to this folder: that takes the right to
make it. SHOAL_TEST_CONTEXT, SHOAL_TEST_PATH and the options of Catch2 mean what they always do.
TEXT
}

part=$folder.part
rm -rf "$part"
mkdir -p "$part/bin" "$part/lib/fallback"
trap 'rm -rf "$part"' EXIT

pack_program() { # program, where
    mkdir -p "$(dirname "$2")"
    cp "$1" "$2"
    strip --strip-unneeded "$2"
    local found name path
    found=$(libraries "$1")
    while read -r name path; do
        of_glibc "$name" || of_driver "$name" || [ -e "$part/lib/$name" ] || pack_library "$name" "$path"
    done <<<"$found"
}

pack_program "$binary" "$part/bin/shoal"
[ -e "$part/lib/fallback/libEGL.so.1" ] || say "libEGL.so.1 of libglvnd is not installed here: the machine must have it"
cat >"$part/lib/egl_nvidia.json" <<'JSON'
{"file_format_version": "1.0.0", "ICD": {"library_path": "libEGL_nvidia.so.0"}}
JSON

tar -C "$source_dir" --exclude='*.py' --exclude=__pycache__ -cf - shaders molecules models LICENSE | tar -C "$part" -xf -
if [ -n "$tests" ]; then
    for program in "${test_programs[@]}"; do pack_program "$tests/$program" "$part/build/tests/$program"; done
    # what tests read beside the data: golden pictures, documents that they compare, sources
    (cd "$source_dir" && tar --exclude=__pycache__ -cf - CMakeLists.txt dev src tests docs/*.md) |
        tar -C "$part" -xf -
    ln -s ../shoal "$part/build/shoal"
fi
glibc=$(needed_glibc "$part/bin" "$part"/lib/lib*)
fallback_glibc=$(needed_glibc "$part/bin" "$part/lib")
needs="glibc $glibc or newer"
if [ "$fallback_glibc" != "$glibc" ]; then needs+=" ($fallback_glibc where libstdc++ or the like is missing or old)"; fi
write_launcher() { # name, what it starts, more for sed
    sed -e "s|@WHAT@|$2|" -e "s/@GLIBC@/$needs/" -e "s/@MACHINE@/$(uname -m)/" "${@:3}" \
        "$source_dir/cmake/bundle_launcher.sh" >"$part/$1"
    chmod 755 "$part/$1"
}
write_launcher shoal bin/shoal -e '/@TESTED@/d'
if [ -n "$tests" ]; then
    write_launcher tested "a program of build/tests" -e "/@TESTED@/r $source_dir/cmake/bundle_tested.sh" \
        -e '/@TESTED@/d'
    sed -i "s|@ROOT@|$source_dir|" "$part/tested"
fi
write_readme "$needs"

size=$(du -sb "$part" | cut -f1)
if [ -z "$tests" ] && [ "$size" -ge "$limit" ]; then
    say "The bundle would have $size bytes and may have $limit. The largest files:"
    (cd "$part" && find . -type f -printf '%12s  %p\n' | sort -rn | sed -n '1,15p') >&2
    exit 1
fi

rm -rf "$folder"
mv "$part" "$folder"
tar -C "$(dirname "$folder")" --sort=name --owner=0 --group=0 --numeric-owner -czf "$folder.tar.gz" "$(basename "$folder")"
awk -v size="$size" -v needs="$needs" -v folder="$folder" \
    'BEGIN { printf "%s: %.1f MiB; needs %s\n", folder, size / 1048576, needs }'
