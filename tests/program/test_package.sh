#!/bin/sh
# SPDX-License-Identifier: MIT
# The Debian packages that cpack makes of a build: what they say of themselves, and what they do in an empty root, where
# they are installed, used and removed.
# usage: test_package.sh BUILD_FOLDER SOURCE_ROOT C_COMPILER
set -u

build=$(realpath "$1")
root=$(realpath "$2")
compiler=$3
for tool in cpack dpkg dpkg-deb dpkg-shlibdeps file pkg-config; do
    command -v $tool >/dev/null 2>&1 || { echo "no $tool here"; exit 77; }
done
failures=0
checks=0
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
trap 'exit 1' INT TERM
cd "$folder" || exit 1
chmod 755 .

check() { # DESCRIPTION COMMAND...
    checks=$((checks + 1))
    description=$1
    shift
    "$@" >log 2>&1 || {
        failures=$((failures + 1))
        echo "FAILED: $description: $*" >&2
        tail -20 log >&2
    }
}

says() { # PACKAGE FIELD PATTERN
    check "$1: $2 is $(dpkg-deb -f "$1"_*.deb "$2")" sh -c "dpkg-deb -f $1_*.deb $2 | grep -Eq '$3'"
}

has() { # PACKAGE PATH...: relative to usr
    package=$1
    shift
    dpkg-deb -c "$package"_*.deb | awk '{ print $6 }' >"$package.files"
    for path in "$@"; do
        check "$package has $path" grep -Eq "^\./usr/$path\$" "$package.files"
    done
}

check "cpack" cpack -G DEB --config "$build/CPackConfig.cmake" -B "$folder"
rm -rf _CPack_Packages
packages=$(ls ./*.deb | sed 's/^\.\///; s/_.*//')
command -v lintian >/dev/null 2>&1 || echo "no lintian here: the packages are not looked at by it" >&2
check "there are packages: $packages" test -s "$(ls librhw-dev_*.deb)"
version=$("$compiler" -E -dM "$root/include/rhw/base.h" | awk '/RHW_VERSION_/ { print $3 }' | paste -sd .)
for package in $packages; do
    says "$package" Version "^$version-1\$"
    says "$package" Architecture "^$(dpkg --print-architecture)\$"
    says "$package" Maintainer ".+ <.+@.+>"
    says "$package" Description "^ This package has "
    has "$package" "share/doc/$package/copyright" "share/doc/$package/changelog.gz"
    check "$package runs no scripts" sh -c \
        "list=\$(dpkg-deb --ctrl-tarfile ${package}_*.deb | tar -t) && ! printf '%s' \"\$list\" | grep -E 'inst|rm'"
    if command -v lintian >/dev/null 2>&1; then
        tags=dir-or-file-in-opt,pkg-config-unavailable-for-cross-compilation # of a build that is not for /usr
        check "lintian" lintian --allow-root --fail-on error,warning --suppress-tags $tags \
            "$(ls "$package"_*.deb)"
    fi
done

# The shared library has its ABI in its package's name, so that an older one can stay beside it.
abi=${version%.*}
says librhw$abi Section '^libs$'
says librhw$abi Depends '^libc6 '
has librhw$abi "lib/.*/?librhw.so.$abi" "lib/.*/?librhw.so.$version" "lib/.*/?librhw-shader.so.$version"
check "librhw$abi has nothing else" sh -c "! grep -Ev '/\$|librhw|share/doc/' librhw$abi.files"
dpkg-deb -e librhw"$abi"_*.deb control
check "who links it is told the package" grep -q "^librhw $abi librhw$abi" control/shlibs
check "who links librhw-shader, too" grep -q "^librhw-shader $abi librhw$abi" control/shlibs
check "the loader is told of it" grep -q '^activate-noawait ldconfig$' control/triggers
rm -r control
says librhw-dev Section '^libdevel$'
says librhw-dev Depends "librhw$abi \\(= $version-1\\)"
has librhw-dev 'include/rhw/rhw.h' 'lib/.*/?rhw-config.cmake' 'lib/.*/?pkgconfig/rhw.pc' 'share/man/man3/rhw.3.gz' \
    'include/rhw/spirv.h' 'lib/.*/?librhw-shader.a' 'lib/.*/?librhw-shader.so' 'lib/.*/?pkgconfig/rhw-shader.pc' \
    'lib/.*/?librhw.a' 'lib/.*/?librhw.so' 'lib/.*/?pkgconfig/rhw-static.pc' 'lib/.*/?pkgconfig/rhw-shared.pc'
# An empty root with dpkg's own records and nothing else.
as_root=
[ "$(id -u)" = 0 ] || as_root=$(command -v fakeroot || echo none)
dpkg_clean() { # OPTION...: the root is thrown away afterwards, so dpkg need not wait for the disk after each file
    $as_root dpkg --root="$folder/clean" --log=/dev/null --force-unsafe-io,not-root,depends "$@"
}
mkdir -p clean/var/lib/dpkg/info clean/var/lib/dpkg/updates
touch clean/var/lib/dpkg/status
if [ "$as_root" = none ]; then
    for package in ./*.deb; do
        check "unpack" dpkg-deb -x "$package" clean
    done
else
    check "install" dpkg_clean --install ./*.deb
fi
usr=$folder/clean/usr
check "nothing names the build" sh -c "! grep -rl '$build' $usr/lib $usr/share"

if [ -x "$usr/bin/rhw" ]; then
    says rhw Section '^graphics$'
    says rhw Depends 'libc6 .*libspng0'
    says rhw Depends 'libtiff6'
    says rhw Recommends '^libavif[0-9]+$'
    has rhw bin/rhw share/man/man1/rhw.1.gz share/bash-completion/completions/rhw share/zsh/vendor-completions/_rhw \
        share/fish/vendor_completions.d/rhw.fish share/thumbnailers/rhw.thumbnailer share/mime/packages/rhw-models.xml
    mkdir work
    printf 'v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n' >work/triangle.obj
    check "the program draws" "$usr/bin/rhw" render work/triangle.obj -s 64 -o work/installed.png
    check "as that of the build" "$build/rhw" render work/triangle.obj -s 64 -o work/built.png
    check "the same bytes" cmp work/installed.png work/built.png
    check "it has no debugging symbols" sh -c "file -L $usr/bin/rhw | grep -q ', stripped'"
fi

if [ -x "$usr/bin/rhw" ] && grep -q '^RHW_LIBRARY_SPIRV:FILEPATH=/' "$build/CMakeCache.txt"; then
    has rhw share/doc/rhw/copyright.glslang-dev share/doc/rhw/copyright.spirv-tools
fi

if [ -x "$usr/bin/rhw-view" ]; then
    says rhw-view Section '^graphics$'
    says rhw-view Depends 'libsdl2-2.0-0'
    says rhw-view Depends '(^|, )rhw(,|$)'
    has rhw-view bin/rhw-view share/man/man1/rhw-view.1.gz share/applications/rhw-view.desktop
    check "rhw does without SDL2" sh -c "! dpkg-deb -f rhw_*.deb Depends | grep -q sdl"
    check "rhw finds it" sh -c "'$usr/bin/rhw' view --help | grep -q '^Usage: rhw view'"
fi

if ls librhw-vulkan_*.deb >/dev/null 2>&1; then
    says librhw-vulkan Section '^libs$'
    says librhw-vulkan Depends '^libc6 [^,]*$'
    has librhw-vulkan share/vulkan/icd.d/rhw_icd.json 'lib/.*/?rhw/librhw_vulkan.so'
    icd=$usr/share/vulkan/icd.d
    check "the loader finds the driver" test -e "$icd/$(sed -n 's|.*"library_path": "\(.*\)",|\1|p' "$icd/rhw_icd.json")"
fi

# A program of a user, by pkg-config.
pkgconfig=$(dirname "$(find "$usr" -name rhw.pc)")
sed -n '/^#include/,/^```/{/^```/!p}' "$root/docs/hello.md" >hello.c
check "a program is compiled" sh -c "$compiler -O2 hello.c \$(PKG_CONFIG_PATH=$pkgconfig pkg-config --cflags --libs rhw) -o hello"
check "it runs" ./hello
check "it drew" test -s hello.ppm
mv hello.ppm static.ppm
check "another with the shared library" sh -c \
    "$compiler -O2 hello.c \$(PKG_CONFIG_PATH=$pkgconfig pkg-config --cflags --libs rhw-shared) -o hello"
check "it runs" env LD_LIBRARY_PATH="$(dirname "$pkgconfig")" ./hello
check "it does not without" sh -c '! ./hello'
check "the same bytes" cmp hello.ppm static.ppm

if [ "$as_root" != none ]; then
    check "remove" dpkg_clean --purge $packages
    check "nothing is left" test -z "$(find clean -path clean/var -prune -o -type f -print)"
fi

echo "$checks checks, $failures failed"
[ "$failures" = 0 ]
