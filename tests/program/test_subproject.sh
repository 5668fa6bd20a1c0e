#!/bin/sh
# SPDX-License-Identifier: MIT
# rhw as a part of other projects: by add_subdirectory in one in C, by FetchContent in one in C++ that optimizes when it
# links. It builds the library alone, draws the known bytes, and leaves the other project's variables, targets, tests and
# installation as they were.
# usage: test_subproject.sh SOURCE_ROOT C_COMPILER
set -u

root=$(realpath "$1")
export CC="$2"
failures=0
checks=0
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
trap 'exit 1' INT TERM
cd "$folder" || exit 1
unset CMAKE_PREFIX_PATH MAKEFLAGS MAKELEVEL CMAKE_GENERATOR CMAKE_BUILD_TYPE
known=1f47e729f6795cb9 # what examples/project prints for its picture, everywhere

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

# What the libraries are made of and nothing else, as an archive that FetchContent can take.
tar -czf rhw.tar.gz -C "$root" CMakeLists.txt include src shader

# Watches what adding rhw changes: variables, the cache, tests, targets of names that are not its own.
cat >watch.cmake <<'CMAKE'
function(read_state prefix)
  foreach(name CMAKE_BUILD_TYPE CMAKE_C_STANDARD CMAKE_C_EXTENSIONS CMAKE_CXX_STANDARD CMAKE_C_VISIBILITY_PRESET
      CMAKE_POSITION_INDEPENDENT_CODE CMAKE_UNITY_BUILD BUILD_SHARED_LIBS CMAKE_CXX_FLAGS CMAKE_INSTALL_PREFIX
      CMAKE_INTERPROCEDURAL_OPTIMIZATION CMAKE_INSTALL_LIBDIR CMAKE_INSTALL_INCLUDEDIR CMAKE_INSTALL_BINDIR)
    if(DEFINED ${name})
      string(APPEND state "${name}=${${name}}\n")
    endif()
    get_property(cached CACHE ${name} PROPERTY VALUE)
    string(APPEND state "${name} in the cache=${cached}\n")
  endforeach()
  get_directory_property(options COMPILE_OPTIONS)
  get_directory_property(definitions COMPILE_DEFINITIONS)
  set(${prefix} "${state}${options}\n${definitions}" PARENT_SCOPE)
endfunction()
function(read_targets folder result)
  get_property(targets DIRECTORY ${folder} PROPERTY BUILDSYSTEM_TARGETS)
  get_property(inner DIRECTORY ${folder} PROPERTY SUBDIRECTORIES)
  foreach(folder IN LISTS inner)
    read_targets(${folder} more)
    list(APPEND targets ${more})
  endforeach()
  set(${result} ${targets} PARENT_SCOPE)
endfunction()
function(check_state before)
  read_state(after)
  if(NOT before STREQUAL after)
    message(SEND_ERROR "rhw changes the project:\n${before}\nbecomes\n${after}")
  endif()
  read_targets(${CMAKE_CURRENT_SOURCE_DIR} targets)
  list(SORT targets)
  list(FILTER targets EXCLUDE REGEX "^rhw(_options|(_shader)?(_baseline|_avx2|_avx512)?)$")
  if(targets)
    message(SEND_ERROR "rhw brings the targets ${targets}")
  endif()
  foreach(name RHW_PROGRAM RHW_EXAMPLES RHW_TESTS RHW_GOLDEN)
    if(${name})
      message(SEND_ERROR "${name} is on")
    endif()
  endforeach()
endfunction()
CMAKE

# A project in C, of warnings that are errors, another standard and targets that are called as ours.
mkdir c
cp "$root"/examples/project/*.[ch] c
cat >c/CMakeLists.txt <<CMAKE
cmake_minimum_required(VERSION 3.22)
project(parent VERSION 7.8 LANGUAGES C)
include(../watch.cmake)
set(CMAKE_C_STANDARD 11)
set(CMAKE_UNITY_BUILD ON)
add_compile_options(-Wall -Wextra -Wpedantic -Wconversion -Wmissing-prototypes -Wshadow -Wfloat-conversion -Werror)
read_state(before)
add_subdirectory($root rhw)
if(NOT RHW_INSTALL)
  check_state("\${before}")
endif()
enable_testing()
foreach(name golden fuzz exact harness options)
  add_library(\${name} INTERFACE)
endforeach()
add_executable(ripples main.c)
set_target_properties(ripples PROPERTIES UNITY_BUILD OFF)
target_link_libraries(ripples PRIVATE rhw::rhw)
rhw_add_shaders(ripples shaders.c)
if(OWN)
  install(TARGETS ripples)
endif()
CMAKE
# Flags of shaders are for C and C++; a file in another language has none of them.
cat >>c/CMakeLists.txt <<'CMAKE'
enable_language(ASM)
file(WRITE ${CMAKE_BINARY_DIR}/other.S ".section .note.GNU-stack,\"\",%progbits\n")
add_library(other OBJECT ${CMAKE_BINARY_DIR}/other.S)
target_link_libraries(other PRIVATE rhw::rhw)
CMAKE
check "c configures" cmake -S c -B c/build -DOWN=ON
check "c builds" cmake --build c/build --parallel 2
check "c has no warning" sh -c '! grep -q warning: log'
check "shaders have their flags" grep -q -e '-ffp-contract=off' c/build/CMakeFiles/ripples.dir/flags.make
check "another language does not have them" sh -c '! grep -q -e -ffp-contract -e -Wno-psabi c/build/CMakeFiles/other.dir/flags.make'
c/build/ripples c.ppm >c.txt || check "the program of c ends with 0" false
check "librhw-shader is built for whom it is linked to" test ! -e c/build/rhw/shader/librhw-shader.a
check "c draws the known bytes: $(cat c.txt)" test "$(awk '{print $NF}' c.txt | sort -u)" = $known
check "c has no test of rhw" sh -c 'ctest --test-dir c/build -N | grep -q "Total Tests: 0"'
check "the library is optimized where nothing is chosen" grep -q -e ' -O3 ' c/build/rhw/src/CMakeFiles/rhw_baseline.dir/flags.make
check "c configures for debuggers" cmake -S c -B c/debug -DCMAKE_BUILD_TYPE=RelWithDebInfo
check "kernels are as fast there" grep -q -e ' -O2 .* -O3 ' c/debug/rhw/src/CMakeFiles/rhw_baseline.dir/flags.make

check "c installs" cmake --install c/build --prefix "$folder/own"
check "c installs its own alone" test "$(cd own && find . -type f | sort | tr '\n' ' ')" = "./bin/ripples "
check "c with RHW_INSTALL configures" cmake -S c -B c/build -DRHW_INSTALL=ON
check "c with RHW_INSTALL builds" cmake --build c/build --parallel 2
check "c with RHW_INSTALL installs" cmake --install c/build --prefix "$folder/both"
for file in bin/ripples include/rhw/rhw.h; do
    check "$file is installed" test -f both/$file
done
for file in librhw.a librhw-shader.a rhw-config.cmake rhw-shaders.cmake rhw.pc rhw-shader.pc; do
    check "$file is installed" test -n "$(find both -name $file)"
done

# A project in C++ alone. FetchContent takes the archive, and the folder for one that has it beside it.
mkdir cxx cxx/shaders
cp "$root"/examples/project/*.[ch] cxx/shaders
cat >cxx/CMakeLists.txt <<CMAKE
cmake_minimum_required(VERSION 3.22)
project(parent LANGUAGES CXX)
include(../watch.cmake)
include(FetchContent)
set(CMAKE_CXX_STANDARD 11)
set(CMAKE_INTERPROCEDURAL_OPTIMIZATION ON)
add_compile_options(-Wall -Wextra -Wpedantic -Wconversion -Wshadow -Wold-style-cast -Werror)
set(FETCHCONTENT_QUIET ON)
FetchContent_Declare(rhw \${FROM})
read_state(before)
FetchContent_MakeAvailable(rhw)
check_state("\${before}")
add_executable(version version.cpp)
target_link_libraries(version PRIVATE rhw::rhw rhw::rhw_shader)
if(SHADERS)
  add_subdirectory(shaders)
endif()
CMAKE
cat >cxx/shaders/CMakeLists.txt <<'CMAKE'
if(SHADERS STREQUAL C)
  enable_language(C)
endif()
add_executable(ripples main.c)
target_link_libraries(ripples PRIVATE rhw::rhw)
rhw_add_shaders(ripples shaders.c)
CMAKE
cat >cxx/version.cpp <<'CXX'
#include <rhw/rhw.h>
#include <rhw/shader.h>
#include <rhw/spirv.h>
#include <cstdio>
int main()
{
    rhw_shader *shader;
    const rhw_shader_def def = {};
    if (rhw_shader_create("words", 5, &def, &shader, nullptr) != RHW_ERROR_MISUSE) {
        return 1;
    }
    std::printf("%s %d\n", rhw_version(), static_cast<int>(rhw_arithmetic_flaws()));
}
CXX
export CXX
case $(basename "$CC") in
*clang*) CXX=$(printf %s "$CC" | sed 's/clang\([^/]*\)$/clang++\1/') ;;
*) CXX=${CXX:-c++} ;;
esac
checks=$((checks + 1))
if cmake -S cxx -B cxx/mistake -DFROM="SOURCE_DIR;$root" -DSHADERS=CXX >log 2>&1 ||
    ! tr -s '\n ' ' ' <log | grep -q 'rhw_add_shaders: ripples has shaders in C, a language that this project does not'; then
    failures=$((failures + 1))
    echo "FAILED: shaders in C in a project in C++ are not refused" >&2
fi
check "cxx configures" cmake -S cxx -B cxx/build -DFROM="URL;file://$folder/rhw.tar.gz" -DSHADERS=C -DCMAKE_BUILD_TYPE=Release
check "cxx builds" cmake --build cxx/build --parallel 2
check "cxx has no warning" sh -c '! grep -q warning: log'
cxx/build/shaders/ripples cxx.ppm >cxx.txt || check "the program of cxx ends with 0" false
check "cxx draws the known bytes: $(cat cxx.txt)" test "$(awk '{print $NF}' cxx.txt | sort -u)" = $known
check "the same picture" cmp c.ppm cxx.ppm
check "a program in C++" test "$(cxx/build/version)" = \
    "$(sed -n 's/^#define RHW_VERSION_[A-Z]* //p' "$root/include/rhw/base.h" | paste -sd.) 0"

echo "$checks checks, $failures failed"
[ "$failures" = 0 ]
