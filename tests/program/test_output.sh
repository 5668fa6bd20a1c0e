#!/bin/sh
# SPDX-License-Identifier: MIT
# Files that cannot be written, and work that is cut short: one line, status 1, and neither half a file nor
# a temporary one; what stood there before still stands.
. "$(dirname "$0")/harness.sh"
make_cube cube
small="--size 64x48"

# Places where nothing can be written.
mkdir folder folder.png
refuse 1 "none/a.png: cannot be written: No such file or directory" render cube.obj -o none/a.png
refuse 1 "folder.png: is a folder; name a file in it" render cube.obj -o folder.png
refuse 1 "new.png/: is named as a folder; name a file in it" render cube.obj --format png -o new.png/
refuse 2 "folder: is a folder; name a file in it" render cube.obj -o folder
refuse 2 "folder/: is a folder; name a file in it" render cube.obj -o folder/
refuse 1 "folder: is a folder; name a file in it" render cube.obj --format png -o folder
refuse 1 "cube.obj/a.png: cannot be written: Not a directory" render cube.obj -o cube.obj/a.png
refuse 1 "'': an output file needs a name" render cube.obj --format png -o ''
refuse 1 "/proc/a.png: " render cube.obj $small -o /proc/a.png
refuse 1 "none/s.json: cannot be written: No such file or directory" render cube.obj -o a.png --stats=none/s.json
refuse 1 "folder: is a folder; name a file in it" render cube.obj -o a.png --stats=folder
refuse 1 "--stats: new.png is the picture's file; name another" render cube.obj -o new.png --stats=new.png
refuse 1 "--stats: new.depth.png is the picture's file" render cube.obj -o new.png --output color,depth \
    --stats=new.depth.png
mkdir folder/within
for other in ./new.png folder/../new.png "$PWD/new.png" .//folder/within/../../new.png; do
    refuse 1 "--stats: new.png is the picture's file; name another" render cube.obj -o "$other" --stats=new.png
    refuse 1 "--stats: $other is the picture's file; name another" render cube.obj -o new.png --stats="$other"
done
succeed render cube.obj $small -o new.png --stats=folder/new.png
check "a name in another folder is another file" test "$(head -c 4 new.png | tail -c 3) $(head -c 1 folder/new.png)" = "PNG {"
run render cube.obj $small -o ./- --format png --stats=-
check "a file named as standard output is another" test "$status" = 0 -a -s ./-
check "and there is what was asked for" grep -q '^{' "$folder/log/out"
rm -r new.png folder/new.png folder/within ./-
name=$(printf '%0300d' 0).png
refuse 1 "$name: cannot be written: File name too long" render cube.obj -o "$name"
if [ "$(id -u)" != 0 ]; then
    chmod 555 folder
    refuse 1 "folder/a.png: cannot be written: Permission denied" render cube.obj -o folder/a.png
    chmod 755 folder
    : >fixed.png
    chmod 444 fixed.png
    refuse 1 "fixed.png: cannot be written: Permission denied" render cube.obj -o fixed.png
fi

# A device takes no temporary file, and must not be replaced by one. Root gets a device of this folder: a program
# that is broken here must not take the system's away.
full=/dev/full
[ "$(id -u)" != 0 ] || full=$folder/full
[ "$(id -u)" != 0 ] || mknod "$full" c 1 7 2>/dev/null || true
if [ "$(head -c 1 "$full" 2>/dev/null | od -A n -t u1 | tr -d ' ')" = 0 ]; then
    ln -s "$full" full.png
    ln -s "$full" full.exr
    ln -s "$full" full.ppm
    refuse 1 "full.png: cannot be written: No space left on device" render cube.obj $small -o full.png
    refuse 1 "full.ppm: cannot be written: No space left on device" render cube.obj $small -o full.ppm
    refuse 1 "full.exr: cannot be written: No space left on device" render cube.obj $small -o full.exr
    check "the device is still there" test -c "$full"
    check "the link is still one" test -L full.png
else
    echo "no device may be opened in $folder: writing to one is not tested" >&2
fi
checks=$((checks + 1))
status=0
"$rhw" render cube.obj $small -o - >/dev/full 2>"$folder/log/err" || status=$?
[ $status = 1 ] && grep -q "^rhw: standard output: cannot be written: No space left on device" "$folder/log/err" ||
    fail "full standard output: status $status, $(cat "$folder/log/err")"
checks=$((checks + 1))
status=0
"$rhw" render --help >/dev/full 2>"$folder/log/err" || status=$?
[ $status = 1 ] && grep -q "^rhw: standard output: cannot be written: No space left on device" "$folder/log/err" ||
    fail "--help to a full device: status $status, $(cat "$folder/log/err")"

# A full disk, as a limit on the size of a file, in the middle of each kind of file.
limited() { # FILE
    checks=$((checks + 1))
    status=0
    (
        ulimit -f 16 # blocks of 512 bytes
        exec "$rhw" render cube.obj --size 512x512 --output "$2" -o "$1" --bits 16
    ) 2>"$folder/log/err" || status=$?
    [ $status = 1 ] && [ "$(wc -l <"$folder/log/err")" = 1 ] && grep -q "^rhw: $1: cannot be written: File too large" "$folder/log/err" ||
        fail "$1 with a limit: status $status, $(cat "$folder/log/err")"
    check "$1 with a limit leaves nothing" test ! -e "$1"
    no_temporary_files
}
limited big.png normal
limited big.ppm color
checks=$((checks + 1))
status=0
(ulimit -f 16; exec "$rhw" render cube.obj --size 512x512 --output all -o big.exr) 2>"$folder/log/err" || status=$?
[ $status = 1 ] && grep -q "^rhw: big.exr: cannot be written: File too large" "$folder/log/err" ||
    fail "big.exr with a limit: status $status, $(cat "$folder/log/err")"
check "big.exr with a limit leaves nothing" test ! -e big.exr
no_temporary_files

# Several files: when the second does not fit, the first, which does, is not taken either.
echo old >two.png
checks=$((checks + 1))
status=0
(ulimit -f 128; exec "$rhw" render cube.obj --size 512x512 --bits 16 --output color,uv -o two.png) \
    2>"$folder/log/err" || status=$?
[ $status = 1 ] && [ "$(cat two.png)" = old ] && [ "$(ls | grep -c '^two')" = 1 ] ||
    fail "two outputs with a limit: status $status, $(cat "$folder/log/err"), $(ls)"
no_temporary_files

# A small disk for real, where this user may mount one.
mkdir disk
if mount -t tmpfs -o size=64k tmpfs disk 2>/dev/null; then
    checks=$((checks + 1))
    status=0
    "$rhw" render cube.obj --size 1024x1024 --output all --bits 16 -o disk/a.png 2>"$folder/log/err" || status=$?
    left=$(find disk -type f)
    umount disk
    [ $status = 1 ] && grep -Eq "^rhw: disk/a[.a-z]*.png: cannot be written: No space left on device" "$folder/log/err" ||
        fail "full disk: status $status, $(cat "$folder/log/err")"
    [ -z "$left" ] || fail "full disk: left $left"
fi

# Replacing: the file a link leads to, with its mode; through a relative path too.
succeed render cube.obj $small -o first.png
mkdir other
cp first.png other/target.png
chmod 640 other/target.png
echo old >other/target.png
ln -s other/target.png link.png
succeed render cube.obj $small -o link.png
check "the link stays a link" test -L link.png
check "its file is the picture" cmp -s first.png other/target.png
check "its mode is kept" test "$(stat -c %a other/target.png)" = 640
(umask 027; "$rhw" render cube.obj $small -o masked.png)
check "a new file obeys umask" test "$(stat -c %a masked.png)" = 640

# Signals while a file is being written: the old file stays, the temporary one goes.
# (Not SIGINT: a shell starts background jobs with it ignored, and rhw then leaves it ignored.)
tries="TERM:png TERM:exr KILL:png HUP:png"
if sh -c 'kill -HUP $$' 2>/dev/null; then
    tries="TERM:png TERM:exr KILL:png" # nohup started this
fi
for try in $tries; do
    signal=${try%:*}
    slow=slow.${try#*:}
    echo old >$slow
    "$rhw" render cube.obj --size 1600x1600 --output all -o $slow 2>"$folder/log/err" &
    process=$!
    waited=0
    while ! is_writing . && kill -0 $process 2>/dev/null && [ $waited -lt 1200 ]; do
        sleep 0.05
        waited=$((waited + 1))
    done
    checks=$((checks + 1))
    is_writing . || fail "SIG$signal: never saw the temporary file of $slow"
    kill -$signal $process
    status=0
    wait $process 2>/dev/null || status=$?
    [ $status -gt 128 ] || fail "SIG$signal: status $status"
    [ "$(cat $slow)" = old ] || fail "SIG$signal: $slow was replaced"
    [ "$(ls | grep -c '^slow')" = 1 ] || fail "SIG$signal: left $(ls)"
    no_temporary_files
    rm -f slow*
done

finish
