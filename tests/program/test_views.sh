#!/bin/sh
# SPDX-License-Identifier: MIT
# Several pictures of a model (--views), and several models.
. "$(dirname "$0")/harness.sh"
make_cube cube
# A file for each view is what --orbit draws.
succeed render cube.obj --size 48 --views front,iso,top -o 'v-{view}.png'
check "three files" test "$(find . -name 'v-*.png' | wc -l)" = 3
succeed render cube.obj --size 48 --orbit 0,0 -o front.png
succeed render cube.obj --size 48 --orbit 0,90 -o top.png
for view in front top; do
    check "$view is its orbit" "$rhw" compare "v-$view.png" "$view.png" >"$folder/log/compare"
done
check "top is no front" sh -c '! "$1" compare v-top.png v-front.png >/dev/null 2>&1' - "$rhw"

# A sheet: 7 views in 4 columns and 2 rows, of every output.
succeed render cube.obj --size 40x30 --views all -o sheet.png --output color,depth,object
check "4 columns, 2 rows: $(size_of sheet.png)" test "$(size_of sheet.png)" = 160x60
check "depth too" test "$(size_of sheet.depth.png)" = 160x60
succeed render cube.obj --size 40x30 --views all -o sheet.exr --output all
check "EXR" test "$(size_of sheet.exr)" = 160x60
succeed render cube.obj --size 40 --views back -o one.png
succeed render cube.obj --size 40 --orbit 180,0 -o back.png
check "a sheet of one view" "$rhw" compare one.png back.png >"$folder/log/compare"
succeed render cube.obj --size 40 --views back,left --ortho --zoom 0.5 -o two.webp
check "two beside each other: $(size_of two.webp)" test "$(size_of two.webp)" = 80x40
refuse 2 "--views: 'side' is no view; there are front, back, left, right, top, bottom, iso, all" \
    render cube.obj -o a.png --views front,side
refuse 2 "--views: 'top' stands there twice" render cube.obj -o a.png --views top,top
refuse 2 "--views: '' is no view" render cube.obj -o a.png --views ''
refuse 2 "--views: a sheet of 2x2 pictures of 9000x100 is larger than 16384" render cube.obj -o a.png \
    --size 9000x100 --views front,back,left,right
succeed render cube.obj -o wide.png --size 8192x1 --views front,back
check "as wide as may be: $(size_of wide.png)" test "$(size_of wide.png)" = 16384x1
succeed render cube.obj -o high.png --size 1x8192 --views all
check "as high as may be: $(size_of high.png)" test "$(size_of high.png)" = 4x16384
rm wide.png high.png
# The first view is drawn, but the sheet has no room. A sanitizer takes address space without a limit.
if ! grep -aq __asan_init "$rhw" && ! grep -aq __tsan_init "$rhw"; then
    refuse 1 "cube.obj: there is not enough memory for a sheet of 7 views" render cube.obj -o a.exr --size 512 --output all \
        --views all --samples 1 --threads 1 --max-memory 192M
fi
refuse 2 "--orbit: cannot be together with --views" render cube.obj -o a.png --views top --orbit 3
refuse 2 "--views: cannot be together with --camera-index" render cube.obj -o a.png --camera-index 0 --views top
refuse 2 "--stats: cannot be together with --views" render cube.obj -o a.png --views top --stats
refuse 2 ".*{view} needs --views" render cube.obj -o '{view}.png'

# An avatar of VRM 0 has its front where glTF has the back, and one of VRM 1 does not.
make_moving first
for version in '"VRM"' '"VRMC_vrm"'; do
    sed 's/"scene": 0/"extensionsUsed": ['"$version"'], &/' first.gltf >"avatar.gltf"
    succeed render avatar.gltf --size 48 --views front -o avatar.png -q
    [ "$version" = '"VRM"' ] && view=back || view=front
    succeed render first.gltf --size 48 --views "$view" -o plain.png -q
    check "the front with $version" cmp avatar.png plain.png
done

# Several models.
cp cube.obj other.obj
succeed render cube.obj other.obj --size 32 -o 'pictures-{name}.png'
check "both" cmp -s pictures-cube.png pictures-other.png
succeed render cube.obj other.obj --size 32 --views front,top -o '{name}.{view}.png' --output color,depth
check "each view of each output of each" test "$(find . -name '*.front.png' -o -name '*.top.depth.png' | wc -l)" = 4
run render cube.obj nowhere.obj other.obj --size 16 -o 'some-{name}.png'
check "status 1" test "$status" = 1
check "one line" grep -q "^rhw: nowhere.obj: cannot be opened" "$folder/log/err"
check "the others are drawn" cmp some-cube.png some-other.png
check "$(size_of some-cube.png), and no third one" test "$(size_of some-cube.png)" = 16x16 -a ! -e some-nowhere.png
mkdir deep
cp cube.obj deep
refuse 2 "out.png: several models need a \{name\} in OUT" render cube.obj other.obj -o out.png
refuse 2 "render: -o OUT is missing: several models" render cube.obj other.obj
refuse 2 "all: is no model; it belongs to --fit=all" render --fit all cube.obj -o out.png
refuse 2 "plain: is no model; it belongs to --wireframe=plain" render cube.obj --wireframe plain -o out.png
refuse 2 "deep/cube.obj: has the name of cube.obj" render cube.obj deep/cube.obj -o '{name}.png'
refuse 2 "render: standard input cannot be one of several models" render cube.obj - -o '{name}.png'
refuse 2 "--stats: is for one model" render cube.obj other.obj -o '{name}.png' --stats
no_temporary_files
finish
