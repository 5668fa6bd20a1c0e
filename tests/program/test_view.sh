#!/bin/sh
# SPDX-License-Identifier: MIT
# rhw view: keys are pressed in a window of a display of its own, and what is on that display is compared with pictures of
# rhw render, byte for byte. Nothing waits for a time: each step waits for what it wants to see.
. "$(dirname "$0")/harness.sh"
for tool in Xvfb xdotool python3; do
    command -v $tool >/dev/null 2>&1 || { echo "no $tool here"; exit 77; }
done
[ -x "$(dirname "$rhw")/rhw-view" ] || { echo "rhw-view was not built"; exit 77; }
make_cube cube
make_moving move
WIDTH=320 HEIGHT=240 PATIENCE=20
export ASAN_OPTIONS=detect_leaks=0 # the libraries that SDL2 opens keep what they have

# What can be told without a window.
refuse 1 "absent.obj: cannot be opened: No such file" view absent.obj
refuse 2 "--views: cannot be shown in a window" view cube.obj --views all
refuse 2 "--output with several outputs: cannot be shown" view cube.obj --output color,depth
refuse 2 "--out: cannot be shown in a window" view cube.obj -o picture.png
refuse 2 "other.obj: one argument too many" view cube.obj other.obj
refuse 2 "--size: 'huge' is not" view cube.obj --size huge
succeed view --help
check "help has the keys" grep -Eq '^  F12 +save the picture$' "$folder/log/out"
export SDL_VIDEODRIVER=x11
unset DISPLAY
refuse 1 "view: there is no display to open a window on: ." view cube.obj
mkdir alone
cp "$rhw" alone/rhw
check "no rhw-view" sh -c "! PATH=/nowhere alone/rhw view cube.obj 2>said"
check "which it says" grep -q '^rhw: view: rhw-view, which shows the window, cannot be run: it is not installed' said
rm -r alone said

# The display's pixels lie in a file in the form of xwd.
mkdir "$folder/display"
screen=$folder/display/Xvfb_screen0
cat >"$folder/seen.py" <<'PY'
"""seen.py SCREEN PICTURE SECONDS: waits until the top left of the screen is the PPM or PGM; 0: it is. With `not` behind:
until it is something else."""
import struct, sys, time

def screen(path, width, height):
    data = open(path, "rb").read()
    header = struct.unpack(">25I", data[:100])
    start, stride = header[0] + 12 * header[19], header[12]
    rows = bytearray()
    for y in range(height):
        row = data[start + y * stride:start + y * stride + 4 * width]
        rgb = bytearray(3 * width)
        rgb[0::3], rgb[1::3], rgb[2::3] = row[2::4], row[1::4], row[0::4]
        rows += rgb
    return bytes(rows)

def picture(path):
    data = open(path, "rb").read()
    lines = [line for line in data.split(b"\n", 8) if not line.startswith(b"#")]
    width, height = map(int, lines[1].split())
    channels = 3 if lines[0] == b"P6" else 1
    pixels = data[-width * height * channels:]
    return width, height, pixels if channels == 3 else bytes(v for v in pixels for _ in range(3))

path, wanted, seconds = sys.argv[1], sys.argv[2], float(sys.argv[3])
width, height, pixels = picture(wanted)
end = time.monotonic() + seconds
while (screen(path, width, height) == pixels) == (len(sys.argv) > 4):
    if time.monotonic() > end:
        sys.exit(1)
    time.sleep(0.01)
PY
mkfifo "$folder/number"
# Without -noreset the server begins anew when its last client goes, and refuses the next meanwhile.
Xvfb -displayfd 3 -screen 0 ${WIDTH}x${HEIGHT}x24 -nolisten tcp -noreset -fbdir "$folder/display" 3>"$folder/number" 2>"$folder/log/xvfb" &
server=$!
viewer=
trap 'kill $server $viewer 2>/dev/null; wait; rm -rf "$folder"' EXIT
read -r number <"$folder/number"
export DISPLAY=:$number

until_true() { # COMMAND...: tries until it succeeds
    tries=0
    until "$@"; do
        tries=$((tries + 1))
        [ $tries -lt $((PATIENCE * 20)) ] || return 1
        sleep 0.05
    done
}

lines() {
    wc -l <said
}

has_window() {
    xdotool search --onlyvisible --name rhw >/dev/null
}

view() { # ARGUMENT...: opens the window, with nothing over its picture
    "$rhw" view --size ${WIDTH}x$HEIGHT "$@" >said 2>complained </dev/null &
    viewer=$!
    check "a window" until_true has_window
    press Tab
}

press() { # KEY...
    xdotool key "$@"
}

# The command line that the window gives, without its end.
ask() {
    before=$(lines)
    press c
    until_true sh -c "[ \$(wc -l <said) -gt $before ]" || fail "C gives no command line"
    press z # which does nothing, but takes the notice away
    asked=$(tail -1 said | sed 's/^rhw \(.*\) -o picture.png$/\1/')
}

# What is seen is what the window says that it is.
seen() { # DESCRIPTION
    ask
    # shellcheck disable=SC2086
    "$rhw" $asked -o want.ppm || fail "$1: rhw $asked"
    check "$1: rhw $asked" python3 "$folder/seen.py" "$screen" want.ppm $PATIENCE
}

# Presses keys and looks; the command line then has the words.
key() { # KEYS WORDS
    # shellcheck disable=SC2086
    press $1
    seen "key $1"
    case "$asked " in
    *" $2 "*) ;;
    *) fail "key $1: '$2' is not in rhw $asked" ;;
    esac
}

closes() { # STATUS
    press Escape
    status=0
    wait $viewer || status=$?
    viewer=
    check "it ends with $1: $status, $(cat complained)" test $status = "$1"
}

# Until a model is there, C does nothing.
view cube.obj --samples 2
until_true sh -c 'xdotool key c; sleep 0.1; [ -s said ]'
press z
seen "the picture of the beginning"
first=$asked
key 2 "--output normal"
key 3 "--output depth --bits 8"
key 4 "--output uv"
key 5 "--output object"
key 6 "--output triangle"
key 7 "--output bary"
key 8 "--output overdraw"
key 9 "--output tiles"
key 0 "--output plan"
press 1 o o
seen "key o"
check "O goes on: $asked" test "${asked##*--output }" = "distance --bits 8"
press Shift+o 1
key x --wireframe=over
key x --wireframe=plain
press x
key p "--interpolate noperspective"
press p
key m "--samples 4"
press Shift+m
key l "--lights default"
key l "--lights none"
press l
key k "--shadows off --ambient-occlusion off"
press k
key b "--background ffffff"
press b
press b b
key t "--samples 2"
key i "--samples 2"
check "the keys have led back: $asked" test "$asked" = "$first"

# The mouse.
moves() { # DESCRIPTION XDOTOOL...: something of the camera is another then
    past=$asked
    description=$1
    shift
    xdotool "$@"
    seen "$description"
    check "$description moves" test "$asked" != "$past"
}
moves orbit mousemove 160 120 mousedown 1 mousemove 190 130 mousemove 200 140 mouseup 1
check "orbit keeps what is in the middle" test "$(echo "$asked" | cut -d , -f 4-6)" = "$(echo "$past" | cut -d , -f 4-6)"
moves pan mousemove 160 120 mousedown 3 mousemove 190 130 mousemove 200 140 mouseup 3
moves "look around" mousemove 160 120 mousedown 2 mousemove 170 130 mousemove 180 125 mouseup 2
check "looking around keeps the place" test "$(echo "$asked" | cut -d , -f 1-3)" = "$(echo "$past" | cut -d , -f 1-3)"
moves zoom mousemove 200 100 click 4
moves fit key f
press r
seen "the beginning again"
check "R leads back" test "$asked" = "$first"
past=$asked
xdotool keydown w
sleep 0.1
xdotool keyup w
seen "flying"
check "it flies" test "$asked" != "$past"
press r

# What a click explains, here and on standard output.
before=$(lines)
xdotool mousemove 160 120 click 1
until_true grep -q '^The largest error is' said || fail "a click explains nothing"
seen_text=$(tail -n +$((before + 1)) said)
check "it is open" python3 "$folder/seen.py" "$screen" want.ppm $PATIENCE not
press Escape
seen "the explanation is closed"
# shellcheck disable=SC2086
run explain --at 160,120 ${asked#render}
check "it is that of rhw explain" test "$seen_text" = "$(cat "$folder/log/out")"

# Help, a file, another size.
press h
check "help" python3 "$folder/seen.py" "$screen" want.ppm $PATIENCE not
press F1
check "no help" python3 "$folder/seen.py" "$screen" want.ppm $PATIENCE
press Tab
check "the line" python3 "$folder/seen.py" "$screen" want.ppm $PATIENCE not
press Tab F12
until_true grep -q '^Saved cube-1.png$' said || fail "F12 saves nothing"
# shellcheck disable=SC2086
succeed $asked -o want.png
check "what F12 saves" cmp cube-1.png want.png
xdotool search --onlyvisible --name rhw windowsize 260 200
until_true sh -c 'xdotool key c; sleep 0.1; tail -1 said | grep -q -e "--size 260x200"' || fail "it is not resized"
press z
seen "another size"
check "nothing was said" test ! -s complained
closes 0

# Animations.
view move.gltf --camera 1.5,0.5,8,1.5,0.5,0,0,1,0,30
until_true sh -c 'xdotool key c; sleep 0.1; [ -s said ]'
press z
seen "at rest"
press space
check "it plays" python3 "$folder/seen.py" "$screen" want.ppm $PATIENCE not
cp want.ppm rest.ppm
press space
seen "a moment"
check "the moment is told: $asked" sh -c "echo '$asked' | grep -Eq -e ' --time 0\.[0-9]+ '"
key period --time
press n
seen "another animation"
check "which stands still: $asked" cmp rest.ppm want.ppm
press r
seen "the pose of the beginning"
check "which has no time: $asked" cmp rest.ppm want.ppm
closes 0

# Files that cannot be read; and one that never comes to its end, for which a sanitized window waits (tools/view/loader.c).
echo "no model" >broken.glb
view broken.glb
until_true grep -q '^rhw: broken.glb: ' complained || fail "a broken file is not told of"
closes 1
if ! ldd "$rhw" | grep -Eq 'lib(a|ub|t)san'; then
    mkfifo endless
    sleep 1000 >endless &
    feeder=$!
    "$rhw" view - <endless >said 2>complained &
    viewer=$!
    check "a window while it reads" until_true has_window
    closes 0 # nothing has failed
    kill $feeder
fi

finish
