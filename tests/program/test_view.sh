#!/bin/sh
# SPDX-License-Identifier: MIT
# rhw view: keys are pressed in a window of a display of its own, and what is on that display is compared with pictures of
# rhw render, byte for byte. Nothing waits for a time: each step waits for what it wants to see.
# usage: test_view.sh RHW SOURCES DROP_FILE
. "$(dirname "$0")/harness.sh"
drop_file=$(realpath "$3")
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
refuse 2 "--literal: cannot be shown in a window" view cube.obj --literal
refuse 2 "other.obj: one argument too many" view cube.obj other.obj
refuse 2 "--size: 'huge' is not" view cube.obj --size huge
succeed view --help
check "help has the keys" grep -Eq '^  F12 +save the picture$' "$folder/log/out"
unset DISPLAY WAYLAND_DISPLAY SDL_VIDEODRIVER
unset XDG_RUNTIME_DIR # which Wayland's library tells too
refuse 1 "view: there is no display to open a window on: neither X11 nor Wayland" view cube.obj
export XDG_RUNTIME_DIR="$folder"
refuse 1 "view: there is no display to open a window on: neither X11 nor Wayland" view cube.obj
unset XDG_RUNTIME_DIR
export SDL_VIDEODRIVER=x11
refuse 1 "view: there is no display to open a window on: ." view cube.obj
mkdir alone
cp "$rhw" alone/rhw
check "no rhw-view" sh -c "! PATH=/nowhere alone/rhw view cube.obj 2>said"
check "which it says" grep -q '^rhw: view: rhw-view, which shows the window, cannot be run: it is not installed' said
rm -r alone said

# The display's pixels lie in a file in the form of xwd.
mkdir "$folder/display"
screen=$folder/display/Xvfb_screen0
mkfifo "$folder/number"
# Without -noreset the server begins anew when its last client goes, and refuses the next meanwhile.
Xvfb -displayfd 3 -screen 0 ${WIDTH}x${HEIGHT}x24 -nolisten tcp -noreset -fbdir "$folder/display" 3>"$folder/number" 2>"$folder/log/xvfb" &
server=$!
viewer=
watcher=
trap 'kill $server $watcher $viewer 2>/dev/null; wait; rm -rf "$folder"' EXIT
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

# One Python watches the display all the time, as its start takes longer than a look.
mkfifo "$folder/asked" "$folder/answered"
python3 "$root/tests/program/display.py" serve "$screen" <"$folder/asked" >"$folder/answered" &
watcher=$!
exec 4>"$folder/asked" 5<"$folder/answered"

display() { # VERB ARGUMENT...: of display.py; prints what it says, to standard error what is wrong
    echo "$*" >&4
    read -r told words <&5
    if [ "$told" != 0 ]; then
        echo "$words" >&2
        return 1
    fi
    [ -z "$words" ] || echo "$words"
}

shown() { # PICTURE: waits until it is what is seen
    display seen "$1" $PATIENCE
}

unseen() { # PICTURE
    display unseen "$1" $PATIENCE
}

lines() {
    wc -l <said
}

told_more() { # since `before`
    [ "$(lines)" -gt "$before" ]
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
    until_true told_more || fail "C gives no command line"
    press z # which does nothing, but takes the notice away
    asked=$(tail -1 said | sed 's/^rhw \(.*\) -o picture.png$/\1/')
}

# What is seen is what the window says that it is.
seen() { # DESCRIPTION
    ask
    # shellcheck disable=SC2086
    "$rhw" $asked -o want.ppm || fail "$1: rhw $asked"
    check "$1: rhw $asked" shown want.ppm
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

# Until a model is there, C does nothing.
awaits() { # CONDITION: presses C until that holds
    until_true sh -c "xdotool key c; sleep 0.1; $1" || fail "no command line for which $1"
    press z
}

shows_model() {
    awaits '[ -s said ]'
}

drop() { # TYPE DATA: onto the window, as a file manager does
    check "the window takes $2" "$drop_file" "$(xdotool search --onlyvisible --name rhw | tail -1)" "$1" "$2"
}

drop_model() { # PATH
    drop text/uri-list "file://$(realpath "$1")"
}

# Presses a key that changes the pose, and keeps the process that reads it from ever coming to its end.
press_for_ever() { # KEY
    : >ready
    python3 "$root/tests/program/display.py" freeze $viewer >ready &
    freezer=$!
    until_true test -s ready
    press "$1"
    wait $freezer || fail "no pose was read"
}

closes() { # STATUS
    press Escape
    status=0
    wait $viewer || status=$?
    viewer=
    check "it ends with $1: $status, $(cat complained)" test $status = "$1"
}

view cube.obj --samples 2
shows_model
seen "the picture of the beginning"
first=$asked
check "its line has what differs from what is usual: $first" sh -c \
    "echo '$first' | grep -Eq '^render cube.obj --camera [-0-9.,e]+ --size ${WIDTH}x$HEIGHT --samples 2$'"
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
heading() { # COMMAND-LINE: of its camera around the vertical, in degrees
    echo "${1#*--camera }" | awk -F , '{ print atan2($4 - $1, $6 - $3) * 45 / atan2(1, 1) }'
}
check "a drag over the window's height turns by 90 degrees" python3 -c \
    "assert abs($(heading "$past") - $(heading "$asked") - 90 * 20 / $HEIGHT) < 1e-3"
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
seen "the beginning after a flight"

# What a click explains, here and on standard output.
before=$(lines)
xdotool mousemove 160 120 click 1
until_true grep -q '^The largest error is' said || fail "a click explains nothing"
seen_text=$(tail -n +$((before + 1)) said)
explained() { # X Y
    display explained want.ppm "$1" "$2" >place 2>reason
}
until_true explained 160 120 || fail "the explanation: $(tail -1 reason)"
read -r width height <place
display grab $WIDTH $HEIGHT open.ppm
press Down
check "it scrolls" unseen open.ppm
press Up
check "and back" shown open.ppm
xdotool click 5
check "the wheel scrolls it" unseen open.ppm
press Home
check "to its beginning" shown open.ppm
press End
check "to its end" unseen open.ppm
# Another pixel, clicked in the small picture, and seen in another output.
xdotool mousemove 30 20 click 1
x=$((61 * WIDTH / (2 * width))) y=$((41 * HEIGHT / (2 * height)))
until_true grep -q ": pixel ($x, $y) of ${WIDTH}x$HEIGHT" said || fail "not ($x, $y): $(grep ': pixel' said)"
until_true explained $x $y || fail "the explanation of another: $(tail -1 reason)"
press 2
# shellcheck disable=SC2086
"$rhw" $asked --output normal -o want.ppm
until_true explained $x $y || fail "the explanation over normals: $(tail -1 reason)"
press 1 Escape
seen "the explanation is closed"
# shellcheck disable=SC2086
run explain --at 160,120 ${asked#render}
check "it is that of rhw explain" test "$seen_text" = "$(cat "$folder/log/out")"

# Help, a file, another size.
press h
check "help" unseen want.ppm
# In a window as small as this one the help is one column, with room on both sides, which scrolls.
beside() { # PICTURE: the first and the last column of pixels
    python3 -c 'import sys
data = open(sys.argv[1], "rb").read().split(b"\n", 3)
width, pixels = int(data[1].split()[0]) * 3, data[3]
sys.stdout.buffer.write(b"".join(pixels[i : i + 3] + pixels[i + width - 3 : i + width] for i in range(0, len(pixels), width)))' "$1"
}
display grab $WIDTH $HEIGHT help.ppm
beside want.ppm >want.columns
beside help.ppm >help.columns
check "it has room" cmp want.columns help.columns
press End
check "it scrolls" unseen help.ppm
press F1
check "no help" shown want.ppm
press Tab
check "the line" unseen want.ppm
press Tab F12
until_true grep -q '^Saved cube-1.png$' said || fail "F12 saves nothing"
# shellcheck disable=SC2086
succeed $asked -o want.png
check "what F12 saves" cmp cube-1.png want.png
xdotool search --onlyvisible --name rhw windowsize 260 200
awaits 'tail -1 said | grep -q -e "--size 260x200"'
seen "another size"
check "nothing was said" test ! -s complained
closes 0

# Animations.
view move.gltf --camera 1.5,0.5,8,1.5,0.5,0,0,1,0,30
shows_model
seen "at rest"
check "no option is advised where a key does it: $(cat complained)" test "$(cat complained)" = \
    "rhw: move.gltf: warning: 2 animations: drawn at rest"
press space
check "it plays" unseen want.ppm
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
key comma "--time 0.966" # it goes round
key period "--time 0"
key period "--time 0.033"
key period "--time 0.066"
key comma "--time 0.033"
key comma "--time 0"
# A key that is held steps on, but does nothing else again and again.
# shellcheck disable=SC2086
"$rhw" $(echo "$asked" | sed 's/--time 0/--time 0.033/') -o step.ppm
xdotool keydown period
check "a step" shown step.ppm
check "another one" unseen step.ppm
xdotool keyup period
seen "a moment"
before=$(lines)
xdotool keydown c
until_true told_more
sleep 1
xdotool keyup c
check "a key that is held acts once" test "$(lines)" = $((before + 1))
# A pose that cannot be read: what is seen stays, and the window works on.
press r
seen "at rest again"
mv move.bin gone.bin
press period
until_true grep -q '^rhw: move.gltf: ' complained || fail "a pose that cannot be read is not told of"
press z
check "the picture stays" shown want.ppm
mv gone.bin move.bin
key period "--time 0.066"
closes 0

# The animation of the command line is where N goes on from and R leads back to.
view move.gltf --animation slide --time 0.5
shows_model
seen "the animation that was named"
first=$asked
key n "--animation 1 --time 0"
key n "--animation 0 --time 0"
press r
seen "the moment of the beginning"
check "R leads back: $asked" test "$asked" = "$first"

# A file that is dropped and cannot be read: what is shown stays as it was. Text is no file.
echo "no model" >broken.glb
drop_model broken.glb
until_true grep -q '^rhw: /.*/broken.glb: ' complained || fail "a dropped file is not told of"
press z
seen "what was shown"
check "it is what it was: $asked" test "$asked" = "$first"
drop text/plain "a text"
# A pose that takes for ever is given up for another model, and when the window is closed.
cp move.gltf quick
python3 -c 'print(open("quick").read().rstrip()[:-1] + ", \"extras\": [" + "0," * 4000000 + "0]}")' >move.gltf
press_for_ever period
drop_model cube.obj
awaits 'tail -1 said | grep -q cube.obj'
seen "the model that was dropped"
check "nothing of the command line is left: $asked" sh -c "! echo '$asked' | grep -q -e --time -e --animation"
closes 0
cp quick quick.gltf
view quick.gltf
shows_model
mv move.gltf quick.gltf
press_for_ever period
closes 0
mv quick move.gltf

# A name is no pattern.
cp cube.obj 'a{name}{}.obj'
view 'a{name}{}.obj'
shows_model
press F12
until_true grep -qx 'Saved a{name}{}-1.png' said || fail "F12 saves nothing of a{name}{}.obj: $(tail -1 said)"
check "it is there" test -s 'a{name}{}-1.png'
closes 0

# A camera without perspective.
sed 's/"nodes": \[0\]/"nodes": [0, 1]/; s/"name": "n"}/"name": "n"}, {"camera": 0, "translation": [0.5, 0.25, 4]}/
    s/"asset"/"cameras": [{"type": "orthographic", "orthographic": {"xmag": 2, "ymag": 1.5, "znear": 0.1, "zfar": 9}}], "asset"/' \
    move.gltf >flat.gltf
view flat.gltf
shows_model
seen "the camera of the file"
check "it has no perspective: $asked" sh -c "echo '$asked' | grep -q -e ' --ortho --camera [^ ]*,3 '"
"$rhw" render flat.gltf --size ${WIDTH}x$HEIGHT -o file.ppm 2>/dev/null
succeed compare file.ppm want.ppm --tolerance 2
moves "zoom without perspective" mousemove 160 120 click 4
check "zoom changes how much is seen: $asked" sh -c "echo '$asked' | grep -q -e ',2.55 '"
moves "orbit without perspective" mousemove 160 120 mousedown 1 mousemove 190 130 mousemove 200 140 mouseup 1
moves "fit without perspective" key f
closes 0
view cube.obj --ortho
shows_model
seen "--ortho"
check "it is --ortho: $asked" sh -c "echo '$asked' | grep -q -e ' --ortho '"
closes 0

# A model from standard input is read again for each pose.
"$rhw" view --size ${WIDTH}x$HEIGHT - <move.gltf >said 2>complained &
viewer=$!
check "a window" until_true has_window
press Tab
shows_model
press period
awaits 'tail -1 said | grep -q -e " --time 0"'
check "the pose is drawn" unseen rest.ppm
press F12
until_true grep -q '^Saved ' said || fail "F12 saves nothing of standard input"
closes 0

# A file that cannot be read; and standard input without an end.
view broken.glb
until_true grep -q '^rhw: broken.glb: ' complained || fail "a broken file is not told of"
closes 1
mkfifo endless
sleep 1000 >endless &
feeder=$!
view_endless() {
    "$rhw" view --size ${WIDTH}x$HEIGHT - <endless >said 2>complained &
    viewer=$!
    check "a window while it reads" until_true has_window
    press Tab
}
view_endless
closes 0 # nothing has failed
view_endless
drop_model cube.obj
shows_model
seen "what was dropped while standard input was read"
check "nothing was said: $(cat complained)" test ! -s complained
closes 0
kill $feeder

# What is said of the picture leaves the model free, wherever that stands.
for target in 2,1.2,0 -2,1.2,0; do
    view cube.obj --samples 1 --camera 0,0,12,$target,0,1,0,32
    shows_model
    seen "the cube in a corner, $target"
    # shellcheck disable=SC2086
    "$rhw" $asked --output object -o mask.ppm
    press Tab
    check "the text beside the cube, $target" display beside want.ppm mask.ppm $PATIENCE
    closes 0
done

finish
