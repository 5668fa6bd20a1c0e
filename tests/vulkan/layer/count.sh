#!/bin/sh
# SPDX-License-Identifier: MIT
# The layer counts what examples/vulkan does, and leaves its picture as it is.
# usage: count.sh RINGS FOLDER_OF_THE_LAYER DRIVER
set -eu

rings=$1
export VK_LAYER_PATH="$2" VK_DRIVER_FILES="$3"
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
"$rings" "$folder/without.ppm" >/dev/null
mkdir "$folder/modules"
VK_INSTANCE_LAYERS=VK_LAYER_count VULKAN_COUNT_FILE="$folder/counts" VULKAN_COUNT_MODULES="$folder/modules" VULKAN_COUNT_LEAST=1 \
    "$rings" "$folder/with.ppm" >/dev/null
cmp "$folder/without.ppm" "$folder/with.ppm"

passed=0 failed=0
while read -r line; do
    if grep -Eq "^ *$line\$" "$folder/counts"; then
        passed=$((passed + 1))
    else
        echo "not counted: $line"
        failed=$((failed + 1))
    fi
done <<'LINES'
1  pass begun
1  draw of instances
1  call vkCmdPushConstants
3  call vkCreateImage
2  SPIR-V capability 1
1  image 2D D32_SFLOAT samples 4 .*
1  submitted batch of 1 command buffers, waits no, signals no
LINES
[ "$(ls "$folder/modules" | wc -l)" -eq 2 ] || failed=$((failed + 1))
echo "$passed passed, $failed failed"
[ $failed -eq 0 ]
