#!/bin/sh
# SPDX-License-Identifier: MIT
# rhw thumbs: every model of a folder, what cannot be drawn, what is there already.
. "$(dirname "$0")/harness.sh"
make_cube cube
mkdir -p in/deep/deeper
cp cube.obj cube.mtl in
cp cube.obj cube.mtl in/deep
cp cube.obj in/deep/deeper/CUBE.OBJ
cp cube.mtl in/deep/deeper
echo "no model" >in/notes.txt
succeed thumbs in -o out --size 32
check "the count" grep -q "^3 drawn, 0 kept, 0 failed$" "$folder/log/out"
for picture in out/cube.obj.png out/deep/cube.obj.png out/deep/deeper/CUBE.OBJ.png; do
    check "$picture: $(size_of "$picture")" test "$(size_of "$picture")" = 32x32
done
check "nothing else" test "$(find out -type f | wc -l)" = 3
succeed render cube.obj --size 32 -o one.png --background transparent
check "a thumbnail is what render draws" "$rhw" compare one.png out/cube.obj.png >"$folder/log/compare"

# A second run draws what is new.
touch -d '2 hours ago' in/cube.obj in/deep/cube.obj in/deep/deeper/CUBE.OBJ
touch in/deep/cube.obj
touch -d '1 hour ago' out/cube.obj.png out/deep/cube.obj.png out/deep/deeper/CUBE.OBJ.png
succeed thumbs in -o out --size 32
check "what is newer than its model is kept" grep -q "^1 drawn, 2 kept, 0 failed$" "$folder/log/out"
succeed thumbs in -o out --size 32 --force --jobs 1
check "--force" grep -q "^3 drawn, 0 kept, 0 failed$" "$folder/log/out"
succeed thumbs in -o out --size 32 --force --quiet
check "--quiet" test ! -s "$folder/log/out"

# One of other options is drawn anew, by options that are the same it is kept, however they are written.
thumbs_draws() { # NUMBER OPTION...: of the 3 models
    number=$1
    shift
    succeed thumbs in -o out "$@"
    check "thumbs $* draws $number" grep -q "^$number drawn, $((3 - number)) kept, 0 failed$" "$folder/log/out"
}
thumbs_draws 0 --size 32
thumbs_draws 3 --size 32x24
thumbs_draws 0 --size 32x24
thumbs_draws 3 --size 32x24 --background white
thumbs_draws 0 --size 32x24 --background '#fff'
thumbs_draws 3 --size 32x24 --background default
thumbs_draws 3 --size 32x24 --background transparent
thumbs_draws 0 --size 32x24
thumbs_draws 3 --size 32x24 --fit
thumbs_draws 0 --size 32x24 --fit=subject
thumbs_draws 3 --size 32x24 --fit=all
thumbs_draws 3 --size 32x24 --max-texture 64
thumbs_draws 3 --size 32
thumbs_draws 0 --size 32 --jobs 1 --max-time 100 --max-memory 2G
thumbs_draws 3 --size 32 --confine .
thumbs_draws 0 --size 32 --confine "$PWD"
# What a model may read is the same from the folder within: its picture is kept.
succeed thumbs in/deep -o out/deep --size 32 --confine .
check "a folder by itself" grep -q "^0 drawn, 2 kept, 0 failed$" "$folder/log/out"
thumbs_draws 3 --size 32
# Who has drawn what lies there is not told by its options: so is a picture of another program.
cp one.png out/cube.obj.png
cp one.png out/deep/cube.obj.png
: >out/deep/deeper/CUBE.OBJ.png
thumbs_draws 0 --size 24
thumbs_draws 3 --size 24 --force
# The bytes follow from the model and the options, not from where it lies.
cp -r in "$folder/elsewhere"
succeed thumbs "$folder/elsewhere" -o elsewhere --size 24
check "the same bytes elsewhere" diff -r out elsewhere
mkdir said
(cd said && "$rhw" thumbs ../in -o . --size 24 >/dev/null)
check "the same bytes from another folder" diff -r out said
rm -r "$folder/elsewhere" said
check "the mark is no option for users" sh -c "! '$rhw' render --help | grep -q mark"

# A link to a folder is not followed: it may lead back.
ln -s . in/here
ln -s .. in/deep/above
run thumbs in -o out --size 32 --force
check "links to folders" grep -q "^3 drawn, 0 kept, 0 failed$" "$folder/log/out"
for name in here deep/above; do
    check "$name is said" grep -q "^rhw: in/$name: warning: is a link to a folder, and is left out$" "$folder/log/err"
done
succeed thumbs in -o out --size 32 --quiet

# The camera of a file is taken, unless --fit says otherwise: as render does. A ground that makes it a dot is left out of
# the subject.
mkdir cameras
cp "$root/tests/fuzz/seeds/square.glb" cameras
cat cube.obj >cameras/ground.obj
printf 'v -500 0 -500\nv 500 0 -500\nv 500 0 500\nv -500 0 500\nf -4 -3 -2 -1\n' >>cameras/ground.obj
cp cube.mtl cameras
for option in "" --fit --fit=subject --fit=all; do
    succeed thumbs cameras -o fitted --size 32 --force $option
    for model in square.glb ground.obj; do
        succeed render cameras/$model --size 32 -o "$model$option.png" --background transparent $option
        check "a thumbnail is what render draws, $model $option" \
            "$rhw" compare "$model$option.png" fitted/$model.png >"$folder/log/compare"
    done
done
check "a camera of a file" sh -c "! cmp -s square.glb.png square.glb--fit.png"
check "all of a file" sh -c "! cmp -s ground.obj--fit.png ground.obj--fit=all.png"
refuse 2 "--fit: 'some' is not subject or all" thumbs cameras -o fitted --fit=some

# Names in braces stand for nothing.
mkdir -p 'braces/{name}'
cp cube.mtl 'braces/{name}'
for word in '{foo}' '{frame}' '{}'; do
    cp cube.obj "braces/{name}/$word.obj"
done
succeed thumbs braces -o '{view}' --size 16
for word in '{foo}' '{frame}' '{}'; do
    check "a picture of $word" cmp "{view}/{name}/$word.obj.png" '{view}/{name}/{foo}.obj.png'
done
check "of $word, as thumbs draws it" test "$(size_of '{view}/{name}/{foo}.obj.png')" = 16x16

# One that cannot be drawn is told, the others are drawn, nothing is left of it.
printf 'solid nothing\n' >in/broken.stl
run thumbs in -o other --size 16
check "status 1" test "$status" = 1
check "the count of failures" grep -q "^3 drawn, 0 kept, 1 failed$" "$folder/log/out"
check "one line about it" test "$(grep -c 'in/broken.stl: ' "$folder/log/err")" = 1
check "no half file" test "$(find other -type f | wc -l)" = 3

# Where a picture should be is a pipe: nobody writes into it or reads from it, and it is not waited for.
rm in/broken.stl other/cube.obj.png
mkfifo other/cube.obj.png
for option in "" --force; do
    status=0
    timeout 30 "$rhw" thumbs in -o other --size 16 $option >"$folder/log/out" 2>"$folder/log/err" || status=$?
    check "a pipe $option: status" test "$status" = 1
    check "a pipe $option: the others" grep -q "drawn, .* kept, 1 failed$" "$folder/log/out"
    check "a pipe $option: a line" grep -q "^rhw: other/cube.obj.png: is there and is no regular file" "$folder/log/err"
    check "a pipe $option: is there" test -p other/cube.obj.png
done

# Where a picture should be is a link that came with the models: what it leads to is none of theirs.
mkdir -p among outside
cp cube.obj cube.mtl among
cp among/cube.obj among/other.obj
echo mine >outside/mine
ln -s ../outside/mine among/cube.obj.png
ln -s third.png among/other.obj.png
"$rhw" thumbs in -o made --size 32 --quiet
cp made/cube.obj.png among/third.png
touch -d '1 hour ago' outside/mine among/third.png
run thumbs among -o among --size 16
check "a link out: status" test "$status" = 1
check "a link out: the others" grep -q "^1 drawn, 0 kept, 1 failed$" "$folder/log/out"
check "a link out: a line" grep -q "^rhw: among/cube.obj.png: is a link out of among; no picture is written there$" "$folder/log/err"
check "a link out: what it leads to" grep -q '^mine$' outside/mine
check "a link within" test "$(size_of among/third.png)" = 16x16

# A link to a model is no place for a picture either, nor is a folder that leads out.
mkdir -p pack/sub/deep pack/thumbs
cp cube.obj cube.mtl pack
cp cube.obj cube.mtl pack/sub
cp cube.obj cube.mtl pack/sub/deep
ln -s ../cube.obj pack/thumbs/cube.obj.png
ln -s ../../outside pack/thumbs/sub
run thumbs pack -o pack/thumbs --size 16 --force
check "a folder that leads out: status" test "$status" = 1
check "a folder that leads out: a line" grep -q "^rhw: pack/thumbs/sub: is a link out of pack/thumbs; no picture is written there$" "$folder/log/err"
check "a folder that leads out: nothing in it" test "$(ls outside)" = mine
ln -sf cube.obj pack/other.obj.png
cp cube.obj pack/other.obj
rm -r pack/sub
run thumbs pack -o pack --size 16 --force
check "a link to a model: a line" grep -q "^rhw: pack/other.obj.png: is a link to a file that is no thumbnail; no picture is written there$" "$folder/log/err"
check "a link to a model: the model" cmp cube.obj pack/cube.obj
"$rhw" render cube.obj -o pack/texture.png --size 8
cp pack/texture.png texture.png
ln -sf texture.png pack/other.obj.png
run thumbs pack -o pack --size 16 --force
check "a link to a texture: a line" grep -q "^rhw: pack/other.obj.png: is a link to a file that is no thumbnail; no picture is written there$" "$folder/log/err"
check "a link to a texture: the texture" cmp texture.png pack/texture.png
check "a link to a model: the others" test "$(size_of pack/cube.obj.png)" = 16x16

refuse 2 "thumbs: -o OUT is missing" thumbs in
refuse 2 "--out: '': a folder needs a name" thumbs in -o ''
refuse 2 "--background: 'puce' is not a colour" thumbs in -o out --background puce
refuse 2 "--background: environment is for rhw render" thumbs in -o out --background environment
refuse 2 "thumbs: expected DIR -o OUT" thumbs -o out
refuse 2 "--jobs: '0' is not a number of 1 to 64" thumbs in -o out --jobs 0
refuse 1 "nowhere: cannot be read: No such file or directory" thumbs nowhere -o new
refuse 1 "cube.obj: cannot be read: Not a directory" thumbs cube.obj -o new
check "and no folder" test ! -e new
refuse 1 "cube.obj: cannot be made: Not a directory" thumbs in -o cube.obj
refuse 1 "nowhere: cannot be read: No such file or directory" thumbs in -o new --confine nowhere
# A folder without a model is a mistake, most likely.
mkdir -p none/deeper
echo text >none/deeper/notes.txt
run thumbs none -o none-out
check "no model: status" test "$status" = 1
check "no model: says so" grep -q '^rhw: none: has no file whose name is that of a model$' "$folder/log/err"

# Formats that nothing reads are told once each, a script of autoconf is no AC3D, and points are models.
mkdir -p formats/deeper
printf '0 0 0\n1 0 0\n0 1 0\n' >formats/points.xyz
: >formats/configure.ac
for name in a.usda deeper/b.USDA c.pcd; do
    : >formats/$name
done
run thumbs formats -o formats-out --size 16
check "formats: status" test "$status" = 0
check "formats: the count" grep -q '^1 drawn, 0 kept, 0 failed$' "$folder/log/out"
check "formats: each" grep -q '^rhw: formats: warning: 2 files left out: USD (text), which is not supported$' "$folder/log/err"
check "formats: one" grep -q '^rhw: formats: warning: 1 file left out: PCD (point cloud), which is not supported$' "$folder/log/err"
check "formats: no more" test "$(wc -l <"$folder/log/err")" = 2
rm formats/points.xyz
run thumbs formats -o formats-out --size 16 --quiet
check "no such model: status" test "$status" = 1
check "no such model: says so" grep -q '^rhw: formats: has no file whose name is that of a model that is supported$' \
    "$folder/log/err"
check "no such model: one line" test "$(wc -l <"$folder/log/err")" = 1

# A link of a model out of the folder may lead to what is nobody's business; --confine names where it may lead.
mkdir -p links/in/sub elsewhere
cp cube.obj cube.mtl elsewhere
cp cube.obj cube.mtl links/in/sub
cp cube.mtl links/in
ln -s sub/cube.obj links/in/near.obj
ln -s "$PWD/elsewhere/cube.obj" links/in/far.obj
ln -s ../../../elsewhere/cube.obj links/in/sub/far.obj
run thumbs links/in -o far --size 16
check "links out: status $status" test "$status" = 0
check "no picture of a link out" test ! -e far/far.obj.png -a ! -e far/sub/far.obj.png
check "a link within" test "$(size_of far/near.obj.png) $(size_of far/sub/cube.obj.png)" = "16x16 16x16"
for name in far sub/far; do
    check "$name is said" grep -q "^rhw: links/in/$name.obj: warning: is a link out of links/in, and is left out; see --confine$" \
        "$folder/log/err"
done
succeed thumbs links/in -o quiet --size 16 --quiet
succeed thumbs links/in -o far --size 16 --confine .
check "links that may be followed" test "$(size_of far/far.obj.png) $(size_of far/sub/far.obj.png)" = "16x16 16x16"
rm links/in/near.obj links/in/sub/cube.obj
run thumbs links/in -o none --size 16
check "nothing but links out" grep -q "^0 drawn, 0 kept, 0 failed$" "$folder/log/out"

# No picture of a model of a game is its skin, nor that of another one, wherever it is written.
integer() { # NUMBER: of 16 bits, as 32
    printf "\\$(printf %03o $(($1 % 256)))\\$(printf %03o $(($1 / 256)))\\0\\0"
}
mkdir games
{
    printf IDP2
    for number in 8 64 64 52 1 3 3 1 0 1 68 132 144 156 68 208; do
        integer $number
    done
    head -c 76 /dev/zero
    printf '\0\0\1\0\2\0\0\0\1\0\2\0' # the corners of a triangle, and their places in the skin
    printf '\0\0\200\77\0\0\200\77\0\0\200\77'
    head -c 28 /dev/zero
    printf '\0\0\0\0\11\0\0\0\0\11\0\0'
    head -c 256 /dev/zero
} >games/a.md2
cp games/a.md2 games/b.md2
for run in 1 2; do
    for jobs in 1 2; do
        run thumbs games -o games --size 16 --jobs $jobs --force
        check "thumbnails beside games, $jobs jobs" cmp games/a.md2.png games/b.md2.png
        rm games/b.md2.png
    done
    run render games/a.md2 -o games/a.png --size 16
    mv games/a.png $run.png
    cp $run.png games/a.png
done
check "no picture is a skin" cmp 1.png 2.png

finish
