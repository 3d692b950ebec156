# The first word names a test program, the rest are its options. Tests look for their files where they were built:
# that place becomes a link to this folder, unless the tree itself is there.
root=@ROOT@
if [ $# -eq 0 ] || [ ! -x "$here/build/tests/$1" ]; then
    printf 'tested: expected the name of a test program and its options; there are' >&2
    for file in "$here"/build/tests/*; do printf ' %s' "${file##*/}" >&2; done
    printf '\n' >&2
    exit 2
fi
program=$here/build/tests/$1
shift
if [ ! -d "$root" ] || [ -L "$root" ]; then
    if ! { mkdir -p "${root%/*}" && ln -sfn "$here" "$root"; }; then
        printf 'tested: the tests look for their files in %s, which cannot be made a link to this folder\n' "$root" >&2
        exit 1
    fi
elif [ "$(readlink -f -- "$root")" != "$here" ]; then
    printf 'tested: the tests read their files in %s, which is there\n' "$root" >&2
fi
export SHOAL_TEST_CONTEXT="${SHOAL_TEST_CONTEXT:-egl}"
cd "$root"
