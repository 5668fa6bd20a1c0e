#!/bin/sh
# SPDX-License-Identifier: MIT
# Models that move: --time, --animation, --animate, --turntable.
. "$(dirname "$0")/harness.sh"
make_cube cube
make_moving move
look=1.5,0.5,8,1.5,0.5,0,0,1,0,30

# Each of a sequence is what --time draws.
succeed render move.gltf -o 'f-{frame}.png' --animate 4 --size 60 --camera $look
check "4 pictures of a second" test "$(find . -name 'f-*.png' | sort | tr -d '\n')" = \
    ./f-0000.png./f-0001.png./f-0002.png./f-0003.png
i=0
for time in 0 0.25 0.5 .75; do
    succeed render move.gltf -o time.png --time $time --size 60 --camera $look
    check "frame $i" cmp -s time.png "f-000$i.png"
    i=$((i + 1))
done
check "it moves" sh -c '! cmp -s f-0000.png f-0003.png'
succeed render move.gltf -o rest.png --animation rest --size 60 --camera $look
check "another animation" cmp -s rest.png f-0000.png
# Who draws it at rest is told what else there is, where there is a way to it.
for verb in "render -o hint.png" "explain --at 1,1"; do
    run $verb move.gltf --size 8
    check "$verb: the way to another moment" grep -q '^rhw: move.gltf: warning: 2 animations: drawn at rest; --time shows another moment$' "$folder/log/err"
done
mkdir hints
cp move.gltf move.bin hints
run thumbs hints -o hinted --size 8
check "thumbs has no --time" grep -q '^rhw: hints/move.gltf: warning: 2 animations: drawn at rest$' "$folder/log/err"
run info move.gltf
check "info has none either" grep -q '^ *2 animations: drawn at rest$' "$folder/log/out"
rm -r hints hinted hint.png
succeed render move.gltf -o end.png --time 9 --size 60 --camera $look
succeed render move.gltf -o one.png --time 1 --size 60 --camera $look
check "after the last key" cmp -s end.png one.png

# A fitted camera stands still and sees all of it: the triangle has as many pixels in every picture.
succeed render move.gltf -o 'g-{frame}.ppm' --animate 4 --size 60 --fit --ortho --orbit 0,0 --output object
pixels() {
    tail -c $((60 * 60 * 3)) "$1" | tr -d '\000' | wc -c
}
for i in 1 2 3; do
    near=$(($(pixels g-0000.ppm) - $(pixels "g-000$i.ppm")))
    check "frame $i is whole: $near" test $((near * near * 100)) -le $(($(pixels g-0000.ppm) * $(pixels g-0000.ppm)))
done
check "there is one" test "$(pixels g-0003.ppm)" -gt 300

# Files that move. The chunks of an animated PNG: acTL with the count, a control for each frame.
count() { # FILE TEXT
    grep -ao "$2" "$1" | wc -l
}
succeed render move.gltf -o move.apng --animate 8 --size 40
check "8 frames" test "$(count move.apng fcTL)" = 8
check "one control" test "$(count move.apng acTL)" = 1
check "data of the other frames" test "$(count move.apng fdAT)" -ge 7
succeed render move.gltf -o 's-{frame}.png' --animate 8 --size 40
check "the first picture is what others see" "$rhw" compare move.apng s-0000.png >"$folder/log/compare"
succeed render move.gltf -o move.webp --animate 8 --size 40
check "WebP" test "$(count move.webp ANMF)" = 8
succeed render move.gltf -o lossy.webp --animate 8 --size 40 --quality 30
succeed render move.gltf --animate 5 --turntable 6 -o both.png --size 40
check "a turn of 6" test "$(count both.png fcTL)" = 6

# Several are encoded at once, and are what one after the other gives.
for threads in 1 5; do
    succeed render move.gltf -o "many-$threads.apng" --animate 30 --size 90 --threads $threads
    succeed render move.gltf -o "many-$threads.webp" --animate 30 --size 90 --threads $threads
    mkdir "many-$threads"
    succeed render move.gltf -o "many-$threads/{frame}.png" --animate 30 --size 90 --output color,depth --threads $threads
done
check "a file that moves, by 5 threads" cmp -s many-1.apng many-5.apng
check "WebP, by 5 threads" cmp -s many-1.webp many-5.webp
check "60 files" test "$(find many-5 -name '*.png' | wc -l)" = 60
check "the same, by 5 threads" diff -r many-1 many-5

# What cannot be written ends the work, with a line for it, and leaves nothing half.
for out in big.apng big.webp 'big-{frame}.png'; do
    status=0
    (ulimit -f 8; exec "$rhw" render move.gltf -o "$out" --animate 30 --size 300 --threads 4) 2>"$folder/log/err" || status=$?
    check "$out: status" test "$status" = 1
    check "$out: says so" grep -q '^rhw: big.*: cannot be written: File too large$' "$folder/log/err"
    check "$out: leaves nothing" sh -c '! ls big* >/dev/null 2>&1'
    no_temporary_files
done

# A turntable of a still model: the first and the opposite picture of a cube of one colour show the same outline.
succeed render cube.obj -o 't-{frame}.png' --turntable 4 --size 48 --output depth
check "4 places" test "$(find . -name 't-*.png' | wc -l)" = 4
check "half a turn" "$rhw" compare t-0000.png t-0002.png --tolerance 1/1000 >"$folder/log/compare"
succeed render cube.obj -o 'c-{frame}.png' --turntable 4 --size 48
check "but another colour" sh -c '! cmp -s c-0000.png c-0001.png'

# A picture a second, or a slower one, is a sequence too.
printf '\000\000\200\100' | dd of=move.bin bs=1 seek=40 conv=notrunc 2>/dev/null # the last key comes after 4 seconds
sed -i 's/"max": \[1\]/"max": [4]/' move.gltf
for rate in 1 0.5; do
    succeed render move.gltf -o "r$rate-{frame}.png" --animate $rate --size 8
done
check "a picture a second" test "$(find . -name 'r1-*.png' | wc -l)" = 4
check "one in two seconds" test "$(find . -name 'r0.5-*.png' | wc -l)" = 2
make_moving move

# A bar on a terminal, and on nothing else.
if command -v script >/dev/null 2>&1; then
    script -qec "$rhw render move.gltf -o bar.png --animate 4 --size 16" /dev/null </dev/null >bar.txt 2>&1
    check "a bar on a terminal" grep -q '\[######\.*\] 1 of 4' bar.txt
    check "which is the only line" test "$(tr '\r' '\n' <bar.txt | grep -c 'reading.*gltf')" = 1
    rm bar.txt bar.png
fi

refuse 1 "cube.obj: has no animations that can be played" render cube.obj -o a.png --animate 10
refuse 1 "move.gltf: has no animation 'dance'" render move.gltf -o a.png --animation dance
refuse 2 "--time: 'soon' is not a number of seconds" render move.gltf -o a.png --time soon
refuse 2 "--animate: '0' is not a number of pictures a second, 0.1 to 240" render move.gltf -o a.png --animate 0
refuse 2 "--turntable: '1' is not a number of 2 to 10000" render move.gltf -o a.png --turntable 1
for name in turn.gif turn.mp4 turn; do
    refuse 2 "$name: no format for this ending; name it .png or .webp, or .jpg, .exr or .ppm with a \{frame\}, or give" \
        render move.gltf -o $name --turntable 4
done
refuse 2 ".*\{frame\}.gif: no format for this ending; name it .png, .jpg, .webp, .exr or .ppm," \
    render move.gltf -o 'turn-{frame}.gif' --turntable 4
refuse 2 "a.jpg: only .png and .webp hold pictures that move" render move.gltf -o a.jpg --animate 10
refuse 2 "--output: a file that moves has one output" render move.gltf -o a.png --animate 10 --output color,depth
refuse 2 ".*\{frame\} needs --animate or --turntable" render move.gltf -o 'a-{frame}.png'
refuse 2 "--animate: cannot be together with --time" render move.gltf -o a.png --animate 10 --time 1
refuse 2 "--turntable: cannot be together with --views" render move.gltf -o a.png --turntable 10 --views top
refuse 2 "--animate: cannot be together with --stats" render move.gltf -o a.png --animate 10 --stats=x.json
# A bar, long along x; and a ground far below it that is no part of what is fitted.
cat >bar.obj <<'OBJ'
o bar
v -20 0 -1
v 20 0 -1
v 20 0 1
v -20 0 1
f 1 4 3 2
OBJ
cp bar.obj ground.obj
cat >>ground.obj <<'OBJ'
v 0 -1 0
v 20 1 0
v -20 1 0
f 5 6 7
o ground
v -5000 -9 -5000
v 5000 -9 -5000
v 5000 -9 5000
v -5000 -9 5000
f 11 10 9 8
OBJ
# A camera that stands goes around, and what comes nearer or gets further than it was stays in the picture.
succeed render bar.obj -o 'b-{frame}.png' --turntable 4 --size 60 --output object --camera 0,4,30,0,0,0,0,1,0,70
succeed render bar.obj -o around.png --size 60 --output object --camera 30,4,0,0,0,0,0,1,0,70
check "a standing camera turns" "$rhw" compare b-0001.png around.png >"$folder/log/compare"
# The ground is drawn though it is not fitted.
succeed render ground.obj -o 'd-{frame}.ppm' --turntable 2 --size 60 --output object --orbit 0,60
check "the ground is there" test "$(pixels d-0000.ppm)" -gt 9000
no_temporary_files
finish
