#!/bin/sh
# SPDX-License-Identifier: MIT
# Every documented function on 8 lanes has its twin for one at a time, named with a 1 behind it (_1 after a digit), and
# both stand in the table that test_shader_kit compares them by. What is about the lanes themselves has none.
# usage: twins.sh PROJECT_FOLDER
set -eu
cd "$1"
lanes_alone="splat splat_int lane_numbers load load_int store store_int mask_bits any all"
drawn_by_others="sample_grad sample_lod sample_bias sample_compare_grad sample_compare_lod sample_dual" # they need textures: test_sample.c, test_shader_dual.c
drawn_by_others="$drawn_by_others interpolate_at" # test_interpolate_at.c
failed=0
count=0

# Names, without rhw_, of the inline functions that a docstring stands before.
documented() {
    awk '/^\/\/\// { told = 1; next }
        /^static inline / && told { name = $0; sub(/\(.*/, "", name); sub(/.*[ *]rhw_/, "", name); print name }
        { told = 0 }' "$@"
}

for name in $(documented include/rhw/shader_vector.h include/rhw/shader_memory.h include/rhw/shader_linear.h \
    include/rhw/shader_math.h include/rhw/shader_hyperbolic.h include/rhw/shader_integer.h include/rhw/shader_pack.h \
    include/rhw/shader_sample.h include/rhw/shader_dual.h \
    include/rhw/shader_varying.h); do
    case " $lanes_alone " in *" $name "*) continue ;; esac
    count=$((count + 1))
    case $name in
    *[0-9]) twin=rhw_${name}_1 ;;
    *) twin=rhw_${name}1 ;;
    esac
    if ! grep -q "^static inline .*[ *]$twin(" include/rhw/shader_one.h include/rhw/shader_bits_one.h include/rhw/shader_dual_one.h \
        include/rhw/shader_varying.h; then
        echo "rhw_$name has no $twin"
        failed=$((failed + 1))
    fi
    case " $drawn_by_others " in *" $name "*) continue ;; esac
    if ! grep -q "^    {\"$name\", ${name}_lanes, ${name}_one}," tests/unit/harness/isa_kit*.c; then
        echo "rhw_$name and its twin are not compared in tests/unit/harness/isa_kit*.c"
        failed=$((failed + 1))
    fi
done
# Functions of the library that take or give lanes: textures, images and storage, compared by their own tests.
for name in $(sed -n '/^#if RHW_HAS_LANES/,/^#endif/s/^RHW_API .*[ *]rhw_\([a-z0-9_]*\)(.*/\1/p' \
    include/rhw/shader_sample.h include/rhw/shader_storage.h); do
    count=$((count + 1))
    if ! grep -q "^RHW_API .*[ *]rhw_${name}1(" include/rhw/shader_no_lanes.h \
        include/rhw/shader_storage.h; then
        echo "rhw_$name has no rhw_${name}1"
        failed=$((failed + 1))
    fi
done
[ $count -gt 60 ] || { echo "only $count functions found"; failed=$((failed + 1)); }
echo "$((count - failed)) passed, $failed failed"
[ $failed -eq 0 ]
