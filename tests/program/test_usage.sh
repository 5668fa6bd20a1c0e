#!/bin/sh
# SPDX-License-Identifier: MIT
# Wrong command lines: status 2, one line that names the thing and the rule, nothing done.
. "$(dirname "$0")/harness.sh"
make_cube cube

refuse 2 "no verb given"
refuse 2 "draw: no such verb" draw cube.obj
refuse 2 "--verbose: no such option" --verbose

succeed --version
check "version" grep -Eq '^rhw [0-9]+\.[0-9]+\.[0-9]+$' "$folder/log/out"
succeed --help
cp "$folder/log/out" help.txt
succeed help
check "help as a word" cmp "$folder/log/out" help.txt
succeed help help
check "help of help" cmp "$folder/log/out" help.txt
refuse 2 "nope: no such verb" help nope
refuse 2 "--nope: no such option" help --nope
refuse 2 "extra: one argument too many" help render extra
for verb in render thumbs compare explain info shader bench; do
    succeed $verb --help
    cp "$folder/log/out" verb.txt
    succeed help $verb
    check "help $verb" cmp "$folder/log/out" verb.txt
done
succeed help
for verb in render thumbs compare explain view info shader bench; do
    check "help lists $verb" grep -Eq "^  rhw $verb " "$folder/log/out"
done
for verb in render compare info shader bench; do
    succeed $verb --help
    check "help of $verb" grep -q "^Usage: rhw $verb" "$folder/log/out"
    check "help of $verb states the statuses" grep -q "status" "$folder/log/out"
    refuse 2 "--no-such-thing: no such option" $verb --no-such-thing
    refuse 2 "-Z: no such option" $verb -Z
    [ $verb = bench ] || refuse 2 "$verb: expected " $verb
done

refuse 2 "render: -o OUT is missing" render -
refuse 2 "extra: stands behind no option, so it is a model, and there is no such file" render cube.obj extra -o a.png
refuse 2 "a.png: several models need a \{name\} in OUT" render cube.obj ./cube.obj -o a.png
refuse 2 "-o: needs an argument|--out: needs an argument" render cube.obj -o
refuse 2 "'': no format for this ending" render cube.obj -o ""
refuse 1 "'': cannot be opened" render "" -o a.png
refuse 2 "--quiet: takes no argument" render cube.obj -o a.png --quiet=1
refuse 2 "--si.*: needs an argument" render cube.obj -o a.png --size

for size in 0x10 10x0 16385x1 1x16385 -1x5 0 16385 -3 x 10x 10x10x10 1e3x5 99999999999x1 ' 1x1' '1x 1' ''; do
    refuse 2 "--size: '$size' is not WxH or one number, each 1..16384" render cube.obj -o a.png --size "$size"
done
for samples in 0 2 3 17 x -4 4.0; do
    refuse 2 "--supersample: '$samples' is not 1, 4, 9 or 16" render cube.obj -o a.png --supersample=$samples
done
refuse 2 "--samples: '9' is not 1, 2, 4, 8 or 16" render cube.obj -o a.png --samples 9
refuse 2 "--supersample: 4 are too many for 8193x10: 2 times" render cube.obj -o a.png --supersample 4 --size 8193x10
for threads in 0 65 -1 two; do
    refuse 2 "--threads: '$threads' is not a number of 1 to 64" render cube.obj -o a.png --threads=$threads
done
refuse 2 "--isa: 'mmx' is not baseline, avx2 or avx512" render cube.obj -o a.png --isa mmx
refuse 2 "--interpolate: 'flat' is not smooth or noperspective" render cube.obj -o a.png --interpolate flat
refuse 2 "--wireframe: 'red' is not over or plain" render cube.obj -o a.png --wireframe=red
for color in redd '#12' 12345g 1234567 ''; do
    refuse 2 "--background: '$color' is not a colour" render cube.obj -o a.png --background "$color"
done
refuse 2 "--output: 'colour' is no output; there are color, depth, distance, normal, position, uv, object, triangle, bary, overdraw, tiles, plan, all" render cube.obj -o a.png --output depth,colour,normal
refuse 2 "--output: '' is no output" render cube.obj -o a.png --output depth,
refuse 2 "--bits: '10' is not 8 or 16" render cube.obj -o a.png --bits 10
refuse 2 "--format: 'gif' is not png, exr, ppm, jpeg or webp" render cube.obj -o a.png --format gif
refuse 2 "--background: environment needs --environment FILE" render cube.obj -o a.png --background environment
refuse 2 "--tone-map: 'filmic' is not neutral, aces, agx or none" render cube.obj -o a.png --tone-map filmic
refuse 2 "--shadows: 'soft' is not on or off" render cube.obj -o a.png --shadows soft
refuse 2 "--environment-rotation: 'north' is not a number" render cube.obj -o a.png --environment-rotation north
refuse 2 "--exposure: '21' is not a number of -20 to 20" render cube.obj -o a.png --exposure 21
refuse 2 "--exposure: 'nan' is not" render cube.obj -o a.png --exposure nan
refuse 2 "--lights: 'off' is not file, default or none" render cube.obj -o a.png --lights off
refuse 2 "--fovy: '180' is not an angle" render cube.obj -o a.png --fovy 180

refuse 2 "--camera: '1,2,3' is not ten numbers" render cube.obj -o a.png --camera 1,2,3
refuse 2 "--camera: .* is not ten numbers" render cube.obj -o a.png --camera 0,0,5,0,0,0,0,1,0,30,1
refuse 2 "--camera: .* is not ten numbers" render cube.obj -o a.png --camera 0,0,inf,0,0,0,0,1,0,30
refuse 2 "--camera: " render cube.obj -o a.png --camera 1,1,1,1,1,1,0,1,0,30
refuse 2 "--camera: " render cube.obj -o a.png --camera 0,0,5,0,0,0,0,1,0,180
refuse 2 "--orbit: '30,1,2' is not one or two angles" render cube.obj -o a.png --orbit 30,1,2
refuse 2 "--camera: not a camera: the height of what is seen must be above 0" render cube.obj -o a.png --ortho --camera 0,0,5,0,0,0,0,1,0,0
refuse 2 "--ortho: cannot be together with --camera-index" render cube.obj -o a.png --ortho --camera-index 0
refuse 2 "--orbit: cannot be together with --camera" render cube.obj -o a.png --camera 0,0,5,0,0,0,0,1,0,30 --orbit 1,2
refuse 2 "--fovy: cannot be together with --camera" render cube.obj -o a.png --camera 0,0,5,0,0,0,0,1,0,30 --fovy 30
refuse 2 "--camera-index: '-1' is not a number" render cube.obj -o a.png --camera-index=-1
refuse 2 "--camera-index: cube.obj has no cameras" render cube.obj -o a.png --camera-index 0
refuse 2 "--camera-name: cube.obj has no cameras" render cube.obj -o a.png --camera-name front

for word in foo Name frame:04 names; do
    refuse 2 "a_\{$word\}.png: \{$word\} stands for nothing; there are \{name\}, \{view\}, \{frame\} and \{\}; --literal takes it as it is\$" \
        render cube.obj -o "a_{$word}.png"
    refuse 2 ".* stands for nothing" render cube.obj --turntable 2 -o "{name}{$word}/{frame}.png"
done
succeed render cube.obj --size 8 -o '{1-2}{a-b}{{x.{}.png' # none of those is a word
succeed render cube.obj --size 8 -o small.png
check "braces in a name" cmp '{1-2}{a-b}{{x.color.png' small.png
for word in '{foo}' '{name}' '{view}' '{frame}' '{}'; do
    succeed render cube.obj --size 8 --literal -o "a_$word.png"
    check "--literal $word" cmp "a_$word.png" small.png
    cp cube.obj "$word.obj"
    succeed render "$word.obj" --size 8
    check "a picture is named after $word.obj" cmp "$word.png" small.png
done

cp cube.obj color.obj
succeed render '{}.obj' color.obj --size 8 -o 'of_{name}.png'
check "braces of a model's name are no part of OUT" cmp 'of_{}.png' small.png
check "nor in the way of another" cmp of_color.png small.png
succeed render '{}.obj' --size 8 -o '{name}_{}.png' --output color,depth
succeed render cube.obj --size 8 -o depth.png --output depth
check "OUT's own are found behind them" cmp '{}_depth.png' depth.png

mkdir both
succeed render cube.obj --size 8 -o 'both/{}-{name}-{}.png' --output color,depth
check "each {} is the output's name" test "$(ls both | tr '\n' ' ')" = "color-cube-color.png depth-cube-depth.png "
refuse 2 "all_\{\}.exr: \{\} stands for an output's name, and an EXR file holds all outputs: leave it out" \
    render cube.obj --size 8 -o 'all_{}.exr' --output color,depth
refuse 2 "all_\{\}.png: \{\} stands for an output's name, and an EXR" render cube.obj -o 'all_{}.png' --format exr
succeed render cube.obj --size 8 -o 'all_{}.exr' --literal
run compare 'all_{}.exr' 'all_{}.exr'
check "an EXR named by --literal" test "$status" = 0
refuse 2 "--literal: is for one model: several need an OUT in which \{name\} stands for each one's name" \
    render cube.obj color.obj --literal -o '{name}.png'
refuse 2 "\{frame\}.jpg: only .png and .webp hold pictures that move; without --literal a \{frame\} gives each a file" \
    render cube.obj --turntable 2 --literal -o '{frame}.jpg'

# What getopt knows of a word is told of that word.
cp cube.obj ./-dash.obj
for verb in render info; do
    refuse 2 "-d: no such option; the file -dash.obj is to be named ./-dash.obj" $verb -dash.obj
done
refuse 2 "-d: no such option; the file -dash.obj is to be named" explain -dash.obj --at 1,1
refuse 2 "-d: no such option; see" render -dart.obj
refuse 2 "-3: no such option; see" render cube.obj -q3
refuse 2 "--qui: takes no argument" render --qui=3 cube.obj
refuse 2 "--s: more than one option begins so; see 'rhw render --help'" render cube.obj --s 16
refuse 2 "--s: more than one option begins so" render cube.obj --s=16
# Options that --help does not show take no beginning from those that it shows.
succeed render cube.obj --size 8 --th 1 -o th.png
succeed render cube.obj --size 8 --thr=1 -o th.png
refuse 2 "--thumb: no such option" render cube.obj --thumb x -o th.png
refuse 2 "--thumb-mark: needs a TEXT, and '' is none" render cube.obj --size 8 --thumb-mark "" -o th.png
refuse 2 "--thumb-mark: needs a TEXT, and '' is none" render cube.obj --size 8 --thumb-mark= -o th.png
succeed render cube.obj --size 8 --thumb-mark=some -o th.png
check "a mark" sh -c "tr '\\0' ' ' <th.png | grep -aq 'tEXtrhw thumbs some'"
succeed render ./-dash.obj --siz 8 -o ./-dash.png

# A name with what a terminal would obey is still one line.
refuse 1 "a\?b\?\[1mc\?d.obj: cannot be opened: No such file or directory" render "$(printf 'a\nb\033[1mc\td.obj')" -o a.png

# A second argument of an option that takes one is no model.
refuse 2 "20: stands behind no option, so it is a model, and there is no such file" render cube.obj --orbit 30 20 -o a.png
refuse 2 "20: stands behind no option, so it is a model" render cube.obj --orbit 30 20

# A folder is no model.
mkdir models
for verb in render info "explain --at 1,1"; do
    refuse 1 "models: is a folder, and a model is wanted; rhw thumbs draws all models in a folder" $verb models
done
refuse 2 "models/: is named as a folder, and a model is wanted" models/
refuse 2 "'': a model needs a name$" render ""

# A picture where a model should be; its name tells where there is none yet.
succeed render cube.obj --size 8 -o x.png
for words in x.png "cube.obj x.png" "cube.obj new.png" new.JPG; do
    refuse 2 "[a-z]*.(png|JPG): is no model but a picture, by its name; a picture to write is named by -o" render $words
done
refuse 2 "x.png: is no model but a picture, by its name" x.png
refuse 1 "x.png: is no model but a PNG picture" render x.png -o y.png

refuse 2 "a.gif: no format for this ending" render cube.obj -o a.gif
refuse 2 "png: no format for this ending" render cube.obj -o png
refuse 2 ".png: no format for this ending" render cube.obj -o .png
refuse 2 "--background: a PPM file cannot be transparent" render cube.obj -o a.ppm --background transparent
refuse 2 "--bits: an EXR file always holds 32 bits" render cube.obj -o a.exr --bits 16
refuse 2 "--stats: standard output takes the picture" render cube.obj -o - --stats
refuse 2 "--output: standard output takes one output" render cube.obj -o - --output color,depth

for option in --at --sample --picture; do
    refuse 2 "$option: needs an argument; see 'rhw explain --help'" explain cube.obj --at 1,1 $option
    refuse 2 "$option: '' is not " explain cube.obj --at 1,1 $option=
done
# The verbs that draw as rhw render does have its options and their own: what is short of both is neither, and an option
# that there is not is said before one that is missing.
refuse 2 "--sampl: more than one option begins so; see 'rhw explain --help'" explain cube.obj --at 1,1 --sampl 1
refuse 2 "--p: more than one option begins so" explain cube.obj --at 1,1 --p=a.svg
refuse 2 "--att: no such option; see 'rhw explain --help'" explain cube.obj --att 3,3
refuse 2 "--fullscreen: no such option; see 'rhw explain --help'" explain cube.obj --at 1,1 --fullscreen
refuse 2 "--json: takes no argument" explain cube.obj --at 1,1 --json=yes
succeed explain cube.obj --siz 8 --js --at 4,4
if [ -x "${rhw%/*}/rhw-view" ]; then
    refuse 2 "--f: more than one option begins so; see 'rhw view --help'" view cube.obj --f
    refuse 2 "--at: no such option; see 'rhw view --help'" view cube.obj --at 1,1
    refuse 2 "--full-screen: no such option" view cube.obj --full-screen
    refuse 2 "--fullscreen: takes no argument" view cube.obj --fullscreen=yes
    for verb in view explain; do
        run $verb --help
        check "help of $verb: its own options" grep -q '^Usage: rhw '$verb "$folder/log/out"
        check "help of $verb: not those of render" sh -c "! grep -q -e --turntable '$folder/log/out'"
    done
    check "keys" sh -c "'$rhw' view --help | grep -q F12"
fi

refuse 2 "scene: one argument too many" bench scene
refuse 2 "--scene: there is no scene 'fil_flat'" bench --scene fill_color,fil_flat
refuse 2 "--scene: there is no scene ''" bench --scene ''
refuse 2 "--size: '16385x1' is not WxH" bench --size 16385x1
refuse 2 "--frames: '0' is not a number of 1 to 10000" bench --frames 0
refuse 2 "--threads: '65' is not a number of 1 to 64" bench --threads 65
refuse 2 "--threads: '' is not a number of 1 to 64" bench --threads 1,,2
refuse 2 "--threads: takes 8 numbers at most" bench --threads 1,2,3,4,5,6,7,8,9
refuse 2 "--isa: 'mmx' is not baseline, avx2 or avx512" bench --isa mmx
refuse 2 "--peer: 'd3d' is not llvmpipe, softpipe, interpreter, machine, emitted or none" bench --peer d3d
refuse 2 "--peer-threads: '33' is not a number of 1 to 32" bench --peer-threads 33
refuse 2 "--csv: standard output takes one of --json and --csv" bench --json --csv

refuse 2 "compare: expected A B" compare a.png
refuse 2 "c.png: one argument too many" compare a.png b.png c.png
refuse 2 "--tolerance: 'x' is not a number" compare a.png b.png --tolerance x
refuse 2 "--tolerance: '-1' is not a number" compare a.png b.png --tolerance=-1
refuse 2 "--tolerance: '1/0' is not a number" compare a.png b.png --tolerance 1/0
refuse 2 "d.exr: a difference picture is named" compare a.png b.png --difference d.exr

finish
