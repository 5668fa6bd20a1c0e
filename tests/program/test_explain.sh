#!/bin/sh
# SPDX-License-Identifier: MIT
# rhw explain: the history of a pixel, and the numbers of what is seen there.
. "$(dirname "$0")/harness.sh"
make_cube cube

field() { # FILE NAME: the first number, or the list of numbers, of that name
    sed -n "s/.*\"$2\": *\(\[[^]]*\]\|[^,}]*\).*/\1/p" "$1" | head -1
}

# A floor of two triangles with W from 2 to 10, straight ahead of a camera on the z axis, and a red one behind it.
cat >floor.mtl <<'MTL'
newmtl front
Kd 0.2 0.4 0.8
newmtl glass
Kd 0.9 0.1 0.1
d 0.5
MTL
cat >floor.obj <<'OBJ'
mtllib floor.mtl
v -4 -1 8
v 4 -1 8
v 4 -1 0
v -4 -1 0
vt 0 0
vt 1 0
vt 1 1
vt 0 1
o floor
usemtl front
f 1/1 2/2 3/3 4/4
v -4 -0.9 8
v 4 -0.9 8
v 4 -0.9 0
v -4 -0.9 0
o glass
usemtl glass
f 5 6 7 8
v -4 -1.5 8
v 4 -1.5 8
v 4 -1.5 0
v -4 -1.5 0
o cellar
usemtl front
f 9 10 11 12
OBJ
view="--camera 0,0,10,0,0,0,0,1,0,60 --lights none"
look="$view --size 160x120"
succeed explain floor.obj --at 80,100 $look
cp "$folder/log/out" told.txt
check "names the pixel" grep -q '^floor.obj: pixel (80, 100) of 160x120, sample 0 of 4, is #' told.txt
check "the background first" grep -q '^  1. the background: written$' told.txt
check "what it was before" grep -q '^     color (.*), which it was cleared to, becomes (' told.txt
check "what its shader gave" grep -Eq '^     color \(.*\) becomes \(.*\); its shader gave \([^()]*\)$' told.txt
check "the floor" grep -Eq '[0-9]\. floor, triangle [01], (front|back): depth 0\.[0-9]+, there is 0' told.txt
check "the cellar is hidden, or drawn over" grep -Eq 'cellar, triangle [01]' told.txt
check "the glass is seen" grep -q '^What is seen: glass, triangle' told.txt
check "as it is blended" sh -c "grep -A1 'glass, triangle .*written' told.txt | grep -q 'becomes'"
check "edges" grep -Eq '^    e_2 = [0-9]+$' told.txt
check "the division" grep -q '1/W_P = r/W_0 + s/W_1 + t/W_2' told.txt
check "three ways" grep -Eq '^    position z +[-0-9.e+]+ +[-0-9.e+]+' told.txt
check "within the bound" test "$(sed -n 's/^The largest error is \([0-9]*\)\..*/\1/p' told.txt)" -lt 6
check "smooth is not said to be noperspective" sh -c '! grep -q noperspective told.txt'
succeed explain floor.obj --at 80,2 $look --background transparent
check "where nothing is" grep -q '^It keeps what it was cleared to, (0, 0, 0, 0);' "$folder/log/out"
succeed explain floor.obj --at 80,100 $look --interpolate noperspective
check "nothing of 1/W is taken" grep -q "^This picture's varyings are noperspective: they take r, s, t, and nothing of 1/W.$" "$folder/log/out"
sed 's/^d 0.5/map_Kd nowhere.png/; s/^Kd 0.2.*/map_Kd nowhere.png/' floor.mtl >lost.mtl
sed 's/floor.mtl/lost.mtl/; s/^f 5 6 7 8/f 5\/1 6\/2 7\/3 8\/4/' floor.obj >lost.obj
succeed explain lost.obj --quiet --at 80,100 $look
check "a texture that is missing" grep -q 'the nearest texel, as it stands in for a file that is missing:$' "$folder/log/out"

# A floor that reaches behind the eye has corners nowhere on the screen: the weights follow from the homogeneous triangle.
sed 's/^v \(.*\) 8$/v \1 30/' floor.obj >long.obj
for way in smooth noperspective; do
    succeed explain long.obj --at 80,100 $look --interpolate $way
    cp "$folder/log/out" told.txt
    check "the corners are not snapped" grep -Eq '^    0 .* -20$' told.txt
    check "the weights in space" grep -Eq '^    a = 0\.[0-9]+ +the pipeline has 0\.[0-9]+$' told.txt
    check "within the bound" test "$(sed -n 's/^The largest error is \([0-9]*\)\..*/\1/p' told.txt)" -lt 6
done

# The same numbers for a program; and the picture's.
succeed explain floor.obj --at 80,100 $look --samples 1 --json
cp "$folder/log/out" told.json
succeed render floor.obj -o picture.ppm $look --samples 1
check "the colour is that of the picture" test "$(field told.json color | tr -d '"#')" = \
    "$(tail -c $((160 * 120 * 3)) picture.ppm | tail -c +$(((100 * 160 + 80) * 3 + 1)) | head -c 3 | od -An -tx1 | tr -d ' \n')"
check "sample in the middle" test "$(field told.json sample)" = "0"
if command -v python3 >/dev/null 2>&1; then
    check "every fragment's numbers agree" python3 - told.json <<'PY'
import json, sys
told = json.load(open(sys.argv[1]))
fragments = [f for f in told["fragments"] if "varyings" in f]
assert len(fragments) >= 2, "the floor, the glass, and perhaps the cellar"
assert [f["color_before"] for f in told["fragments"][1:]] == [f["color_after"] for f in told["fragments"][:-1]]
for f in fragments:
    assert f["sample"] == [80 * 256 + 128, 100 * 256 + 128] and f["at"] == [80.5, 100.5]
    assert sum(f["edges"]) == f["sum"] and all(0 <= e <= f["sum"] for e in f["edges"])
    for mine, exact in zip(f["screen"], f["screen_exact"]):
        assert abs(mine - exact) < 1e-14
    over = [edge / f["sum"] / corner[3] for edge, corner in zip(f["edges"], f["clip"])]
    assert abs(sum(over) - f["inverse_w"][0]) < 1e-14 and abs(f["inverse_w_exact"][0] - f["inverse_w"][0]) < 1e-15
    for mine, exact, part in zip(f["space"], f["space_exact"], over):
        assert abs(mine - exact) < 3e-7 and abs(exact - part / sum(over)) < 1e-12
    for v in f["varyings"]:
        assert v["error_ulp"] < 6
        space = sum(w * i for w, i in zip(f["space_exact"], v["vertices"]))
        naive = sum(w * i for w, i in zip(f["screen_exact"], v["vertices"]))
        largest = max(abs(i) for i in v["vertices"]) + 1e-30
        assert abs(space - v["exact"]) < 1e-6 * largest and abs(naive - v["naive"]) < 1e-6 * largest
z = [v for v in fragments[0]["varyings"] if v["name"] == "position z"][0]
assert abs(z["naive"] - z["exact"]) > 0.1, "a floor shows why one divides"
PY
fi

# A texture of one colour, #336699, shows at any level as the light of that colour.
sed 's/^newmtl front/&\nmap_Kd tile.ppm/; s/^Kd 0.2 0.4 0.8/Kd 1 1 1/; s/^d 0.5/d 1/' floor.mtl >tile.mtl
sed 's/floor.mtl/tile.mtl/; /^usemtl glass/,$d' floor.obj >tile.obj
{
    printf 'P6\n16 16\n255\n'
    i=0
    while [ $i -lt 256 ]; do
        printf '3f\231'
        i=$((i + 1))
    done
} >tile.ppm
succeed explain tile.obj --at 80,100 $look --json
check "the texel: $(field "$folder/log/out" texel)" sh -c "grep -Eq '\"texel\": \[0.033[0-9]*, 0.13[0-9]*, 0.318[0-9]*, 1\]' '$folder/log/out'"
check "the texels are that too" sh -c "grep -Eq '\"texels\": \[\[\[0.033[0-9]*, 0.13[0-9]*, 0.318[0-9]*, 1\], \[0.033' '$folder/log/out'"
succeed explain tile.obj --at 80,100 $look
check "level and texels" grep -Eq '^    base color +level [0-9.]+; level [0-4] has [0-9]+x[0-9]+ texels' "$folder/log/out"
check "why that level" grep -Eq '^ +[0-9.]+ and [0-9.]+ texels of 16x16; log2 of the larger is -?[0-9.]+$' "$folder/log/out"
check "and the color in the end" grep -q '^Of these values, light and shadow the shader makes (' "$folder/log/out"
# A square over a floor, in the way of the studio's light, which comes from (-0.5, 0.62, 0.6) of the eye.
cat >shaded.obj <<'OBJ'
v -4 -4 0
v 4 -4 0
v 4 4 0
v -4 4 0
v -1.4333 0.4333 1
v -0.2333 0.4333 1
v -0.2333 1.6333 1
v -1.4333 1.6333 1
f 1 2 3 4
f 5 6 7 8
OBJ
above="--size 81 --camera 0,0,10,0,0,0,0,1,0,40 --ambient-occlusion off"
succeed explain shaded.obj --at 40,40 $above
check "in shadow" grep -q '^    light 1, directional  l is (-[0-9.]*, [0-9.]*, [0-9.]*), n·l 0.6017: 100 % of it is in shadow, so of (0.56, 0.535, 0.5) arrives (0, 0, 0)$' "$folder/log/out"
succeed explain shaded.obj --at 60,60 $above
check "in the light" grep -q ': 0 % of it is in shadow, so of (0.56, 0.535, 0.5) arrives (0.3369, 0.3219, 0.3008)$' "$folder/log/out"
succeed explain shaded.obj --at 60,60 $above --lights none
check "no light" grep -q '^what there is comes from all around.$' "$folder/log/out"
succeed explain shaded.obj --at 40,40 $above --json
check "where it shines from" grep -Eq '"direction": \[-0.[0-9]*, 0.[0-9]*, 0.[0-9]*\], "has_shadows"' "$folder/log/out"
check "the same as JSON" grep -q '"has_shadows": true, "open": 0,' "$folder/log/out"
# A wall stands on the floor from x = 0 on: beside it half of what comes from all around is left, and a quarter of the
# other half.
cat >wall.obj <<'OBJ'
v -4 -4 0
v 4 -4 0
v 4 4 0
v -4 4 0
v 0 -4 0
v 0 4 0
v 0 4 8
v 0 -4 8
f 1 2 3 4
f 5 6 7 8
OBJ
beside="--size 81 --camera -3,0,10,-3,0,0,0,1,0,40"
succeed explain wall.obj --at 73,40 $beside
check "no more lights than there are" sh -c "! grep -Eq '^    and [0-9]+ more$' '$folder/log/out'"
check "ambient occlusion beside a wall" grep -Eq '^    of which ambient occlusion leaves (6[2-9]|7[0-9])\.[0-9]* %$' "$folder/log/out"
succeed explain wall.obj --at 35,40 $beside --lights none
check "and far from it" grep -Eq '^of which ambient occlusion leaves (100|99\.[0-9]*) %\.$' "$folder/log/out"
succeed explain wall.obj --at 73,40 $beside --json
check "as JSON too" grep -Eq '"ambient_open": 0\.[67]' "$folder/log/out"
check "the help names textures and light" sh -c "'$rhw' explain --help | grep -q 'texture.* light'"
# A hidden side comes last and is not shaded.
succeed explain cube.obj --at 100,100 --size 200 --samples 1 --json
check "a side that is hidden" grep -q '"fate": "failed_early"' "$folder/log/out"
check "has no light" test "$(sed -n 's/.*"light": \(.\).*/\1/p' "$folder/log/out" | tr -d '\n')" = 'n{n'
# Normals that lean away from the eye are bent to it, as the shader bends them: as they are, under layers, and where a map
# turns them; the texel of this one is (1, 0, -0.5). Of nine lights that shine from the eye eight are told.
triangle() { # EXTENSIONS-USED MATERIAL ATTRIBUTES NORMALS
    cat <<GLTF
{"asset": {"version": "2.0"}, "extensionsUsed": [$1], "extensions": {"KHR_lights_punctual": {"lights": [{"type": "directional"}]}},
 "scenes": [{"nodes": [0, 1, 2, 3, 4, 5, 6, 7, 8, 9]}], "nodes": [{"mesh": 0}$nine_lights],
 "meshes": [{"primitives": [{"material": 0, "attributes": {"POSITION": 0, $3}}]}],
 "materials": [{$2}], "textures": [{"source": 0}],
 "images": [{"uri": "data:image/png;base64,iVBORw0KGgoAAAANSUhEUgAAAAEAAAABCAIAAACQd1PeAAAADElEQVR4nGP43+AAAARBAcAM0e2RAAAAAElFTkSuQmCC"}],
 "accessors": [{"bufferView": 0, "componentType": 5126, "count": 3, "type": "VEC3", "min": [-1, -1, 0], "max": [1, 1, 0]},
  {"bufferView": 0, "byteOffset": 36, "componentType": 5126, "count": 3, "type": "VEC3"},
  {"bufferView": 0, "byteOffset": 72, "componentType": 5126, "count": 3, "type": "VEC4"},
  {"bufferView": 0, "byteOffset": 120, "componentType": 5126, "count": 3, "type": "VEC2"}],
 "bufferViews": [{"buffer": 0, "byteLength": 144}],
 "buffers": [{"byteLength": 144, "uri": "data:application/octet-stream;base64,$corners$4$tangents"}]}
GLTF
}
nine_lights=
for i in 1 2 3 4 5 6 7 8 9; do
    nine_lights="$nine_lights, {\"extensions\": {\"KHR_lights_punctual\": {\"light\": 0}}}"
done
corners=AACAvwAAgL8AAAAAAACAPwAAgL8AAAAAAAAAAAAAgD8AAAAA
leaning=SOF6PwAAAADNzEy+SOF6PwAAAADNzEy+SOF6PwAAAADNzEy+
facing=AAAAAAAAAAAAAIA/AAAAAAAAAAAAAIA/AAAAAAAAAAAAAIA/
tangents=AACAPwAAAAAAAAAAAACAPwAAgD8AAAAAAAAAAAAAgD8AAIA/AAAAAAAAAAAAAIA/AAAAPwAAAD8AAAA/AAAAPwAAAD8AAAA/
coat='"KHR_materials_clearcoat": {"clearcoatFactor": 1}'
map='"normalTexture": {"index": 0}'
triangle '"KHR_lights_punctual", "KHR_materials_clearcoat"' "\"extensions\": {$coat}" '"NORMAL": 1' "$leaning" >coat.gltf
triangle '"KHR_lights_punctual"' '' '"NORMAL": 1' "$leaning" >leaning.gltf
base='"pbrMetallicRoughness": {"baseColorTexture": {"index": 0}}' # is sampled at once with the map
triangle '"KHR_lights_punctual"' "$map" '"NORMAL": 1, "TANGENT": 2, "TEXCOORD_0": 3' "$facing" >mapped.gltf
triangle '"KHR_lights_punctual"' "$map, $base" '"NORMAL": 1, "TANGENT": 2, "TEXCOORD_0": 3' "$facing" >mapped_base.gltf
triangle '"KHR_lights_punctual", "KHR_materials_clearcoat"' "$map, \"extensions\": {$coat}" '"NORMAL": 1, "TANGENT": 2, "TEXCOORD_0": 3' "$facing" >mapped_coat.gltf
triangle '"KHR_lights_punctual", "KHR_materials_unlit"' '"extensions": {"KHR_materials_unlit": {}}' '"NORMAL": 1' "$leaning" >unlit.gltf
eye="--at 40,40 --size 81 --camera 0,0,5,0,0,0,0,1,0,40 --shadows off"
told() { # DESCRIPTION FILE PATTERN: what is told of the middle pixel has that line
    succeed explain "$2" $eye
    check "$1" grep -Eq "$3" "$folder/log/out"
}
told "what leans away is bent" leaning.gltf 'normal n is \(0.9998, 0, 0.020'
told "under a layer too" coat.gltf 'normal n is \(0.9998, 0, 0.020'
told "and faces the light" coat.gltf '^    light 8, directional +l is \(0, 0, 1\), n·l 0.0204[0-9]*: without shadows, of \('
told "eight lights are told" coat.gltf '^    and 1 more$'
told "the map's is bent" mapped.gltf 'normal n, which the normal map has turned, is \(0.99'
told "beside another texture too" mapped_base.gltf 'normal n, which the normal map has turned, is \(0.99'
told "under a layer too" mapped_coat.gltf 'normal n, which the normal map has turned, is \(0.99'
succeed explain unlit.gltf $eye --json
check "no light is told where there is none" grep -q '"light": null' "$folder/log/out"
check "of any fragment" sh -c "! grep -q n_dot_l '$folder/log/out'"

succeed explain tile.obj --at 80,100 $look --json
if command -v python3 >/dev/null 2>&1; then
    check "the steps make the level" python3 - "$folder/log/out" <<'PY'
import json, math, sys
look = [f for f in json.load(open(sys.argv[1]))["fragments"] if f["textures"]][-1]["textures"][0]
longer = max(math.hypot(*(16 * part for part in look[name])) for name in ("uv_dx", "uv_dy"))
assert abs(look["lod"] - math.log2(longer)) < 1e-4, (look["lod"], longer)
assert look["base_size"] == [16, 16] and look["level"] == max(0, min(look["lod"], 4))
PY
fi

# Beyond the edge.
sed 's/map_Kd/& -clamp on/' tile.mtl >clamp.mtl
sed 's/tile.mtl/clamp.mtl/; s/^vt 1/vt 9/' tile.obj >clamp.obj
succeed explain clamp.obj --at 80,100 $look
check "held at the edge" grep -Eq '^ *that is \(15\.000, [0-9.]+\), as u stays at the edge$' "$folder/log/out"
succeed explain clamp.obj --at 80,100 $look --json
check "JSON has it too" grep -Eq '"address": \["clamp", "clamp"\], "inside": \[15, [0-9.]+\]' "$folder/log/out"

# Shares of the four texels make what sampling gives, where one level is read.
box=/usr/share/assimp/models/glTF2/BoxTextured-glTF-Binary/BoxTextured.glb
if [ -f $box ] && command -v python3 >/dev/null 2>&1; then
    succeed explain $box --at 600,317
    check "a place beyond the edge" grep -q '^ *that is (79.236, 76.475), as u repeats$' "$folder/log/out"
    succeed explain $box --at 600,317 --json
    check "the shares make the texel" python3 - "$folder/log/out" <<'PY'
import json, math, sys
look = [f for f in json.load(open(sys.argv[1]))["fragments"] if f["textures"]][-1]["textures"][0]
assert look["level"] == 0 and len(look["texels"]) == 1
x, y = (place - math.floor(place) for place in look["place"])
for channel in range(3):
    corners = [texel[channel] for texel in look["texels"][0]]
    mixed = (corners[0] * (1 - x) + corners[1] * x) * (1 - y) + (corners[2] * (1 - x) + corners[3] * x) * y
    assert abs(mixed - look["texel"][channel]) < 1e-4, (mixed, look["texel"])
assert max(corners) > min(corners), "a place where the picture changes"
PY
    # This file reads the nearest texel where the texture is reduced, of two levels.
    succeed explain $box --at 663,58 --json
    check "the nearest texels make the texel" python3 - "$folder/log/out" <<'PY'
import json, math, sys
look = [f for f in json.load(open(sys.argv[1]))["fragments"] if f["textures"]][-1]["textures"][0]
assert look["filter"] == "nearest" and len(look["texels"]) == 2 and look["level_size"] == [105, 105]
nearest = []
for size, texels in zip((105, 52), look["texels"]):
    x, y = (uv * size - 0.5 - math.floor(uv * size - 0.5) >= 0.5 for uv in look["uv"])
    nearest.append(texels[x + 2 * y])
part = look["level"] % 1
for channel in range(3):
    mixed = nearest[0][channel] * (1 - part) + nearest[1][channel] * part
    assert abs(mixed - look["texel"][channel]) < 5e-3, (mixed, look["texel"])
PY
    succeed explain $box --at 663,58
    check "it says so" grep -q '^ *level 1, the nearest texel, as the file says:$' "$folder/log/out"
    check "one texel of each level" test "$(grep -c '^ *1.0000 of ' "$folder/log/out")" = 2
fi

# The picture of the triangle.
succeed explain tile.obj --at 80,100 $look --picture triangle.svg
check "the picture" grep -q '<svg xmlns' triangle.svg
check "its three shares" test "$(grep -c 'fill-opacity' triangle.svg)" = 3
check "81 pixels" test "$(grep -c "stroke='#888'" triangle.svg)" = 81
check "its numbers" grep -q "1/W = r/W_0 + s/W_1 + t/W_2 = 0\." triangle.svg
if command -v python3 >/dev/null 2>&1; then
    check "well formed" python3 -c "import xml.dom.minidom; xml.dom.minidom.parse('triangle.svg')"
fi
run explain cube.obj --at 0,0 --size 64 --picture none.svg
check "nothing to draw: status" test "$status" = 1
check "nothing to draw: says so" grep -q '^rhw: none.svg: not drawn: nothing of the model is seen there$' "$folder/log/err"
check "nothing to draw: no file" test ! -e none.svg
refuse 2 "--picture: 'a.png' is not the name of a .svg file" explain cube.obj --at 1,1 --picture a.png

# A sample that is covered while the middle of its pixel is not.
printf 'v 0 0 0\nv 1.3 0 0\nv 0 1 0\nf 1 2 3\n' >edge.obj
succeed explain edge.obj --at 31,31 --size 64 --sample 3
check "outside" grep -q '^P lies outside: the triangle covers the sample, ' "$folder/log/out"
check "e_0 is below 0" grep -q '^    e_0 = -' "$folder/log/out"
succeed explain edge.obj --at 30,33 --size 64
check "inside" sh -c "! grep -q 'P lies outside' '$folder/log/out'"

# Where nothing is, and what is clipped.
succeed explain cube.obj --at 0,0 --size 64
check "nothing of the model" grep -q '^Nothing of the model is seen here; the nearest pixel that shows it is ([0-9]*, [0-9]*)\.$' "$folder/log/out"
near=$(sed -n 's/^Nothing.*is (\([0-9]*\), \([0-9]*\))\.$/\1,\2/p' "$folder/log/out")
succeed explain cube.obj --at 0,0 --size 64 --json
check "JSON has it too" grep -q "\"nearest\": \[$(echo "$near" | sed 's/,/, /')\]" "$folder/log/out"
succeed explain cube.obj --at "$near" --size 64
check "there is something" grep -q '^What is seen: ' "$folder/log/out"
check "colors are told of" grep -q ' of sRGB: #[0-9a-f]*, the mean of the samples\.$' "$folder/log/out"
succeed explain cube.obj --at 0,0 --size 64 --camera 0,0,9,0,0,18,0,1,0,20 --quiet
check "nothing at all" grep -q '^Nothing of the model is seen here\.$' "$folder/log/out"
succeed explain floor.obj --at 80,110 --camera 0,0,4,0,0,0,0,1,0,90 --size 160x120
check "cut by the near plane" grep -q 'behind the eye\|The triangle is clipped' "$folder/log/out"
for sample in 1 2 3; do
    succeed explain floor.obj --at 80,100 $look --sample $sample
    check "sample $sample" grep -q "sample $sample of 4" "$folder/log/out"
done

# Of a grid of pixels for each one of the picture: the numbers of the larger picture but for colors and occlusion, as the
# background and the shading know of the picture's size. That of 9216 rows is drawn in two bands, as the one of 2304 is; the
# pixel lies in the second.
without_colors() {
    sed 's/, "\(color_before\|color_after\|output\)": \[[^]]*\]//g; s/, "ambient_open": [0-9.]*//; 1,/fragments/d' \
        "$folder/log/out"
}
for case in "80x60 40,50 2 4 3 81,101" "80x60 40,50 4 16 6 162,201" "1024x2304 512,2100 4 16 9 2049,8402"; do
    set -- $case
    width=${1%x*} height=${1#*x}
    succeed explain tile.obj --at "$2" --size "$1" --supersample "$4" --samples 1 --sample "$5" $view --json
    without_colors >grid.json
    succeed explain tile.obj --at "$6" --size $((width * $3))x$((height * $3)) --samples 1 $view --json
    without_colors >larger.json
    check "sample $5 of $4 at $2" sh -c 'grep -q snapped larger.json && cmp grid.json larger.json'
done
succeed explain floor.obj --at 80,100 $look --supersample 4 --sample 6
check "names the one that is drawn" grep -q '^It is the mean of 2x2 pixels. This is about (161, 200) of 320x240 that are drawn, sample 2 of 4\.$' "$folder/log/out"
check "the mean" grep -q ' of sRGB: #[0-9a-f]*, the mean of what is drawn for it\.$' "$folder/log/out"

# Without perspective.
for option in --ortho "--ortho --camera 0,0,4,0,0,0,0,1,0,3"; do
    succeed explain cube.obj --at 32,32 --size 64 $option --picture parallel.svg
    check "every W is 1: $option" grep -q '^Without perspective every W is 1, so that a, b, c are r, s, t' "$folder/log/out"
    check "nothing of perspective: $option" sh -c "! grep -q '1/W\|in perspective\|flat to the eye\|infinity' '$folder/log/out'"
    check "naive is right: $option" grep -q 't I_2, which is right without perspective;' "$folder/log/out"
    check "the pipeline's b: $option" grep -Eq '^    b = s = ([0-9.]+)      the pipeline has ' "$folder/log/out"
    check "the drawing: $option" grep -q 'Without perspective every W is 1: a, b, c are r, s, t' parallel.svg
    succeed explain cube.obj --at 32,32 --size 64 --json $option
    check "JSON: $option" grep -q '"orthographic": true' "$folder/log/out"
done
succeed explain cube.obj --at 32,32 --size 64
check "with perspective" grep -q '^Seen in perspective the triangle is not flat to the eye' "$folder/log/out"

# Every key of the JSON stands in docs/outputs.md and in the types of the npm package, and no type speaks of another.
if command -v python3 >/dev/null 2>&1; then
    awk '$1 == "v" { $2 += 10000000 } { print }' OFMT=%.9g CONVFMT=%.9g cube.obj >far.obj
    i=0
    for options in "tile.obj --at 80,100 $look" "tile.obj --at 80,100 $look --supersample 4" "cube.obj --at 0,0 --size 64" \
        "cube.obj --at 32,32 --size 64 --ortho" "far.obj --at 32,32 --size 64"; do
        i=$((i + 1))
        succeed explain $options --json
        cp "$folder/log/out" keys$i.json
    done
    check "keys" python3 - "$root" keys*.json <<'PY'
import json, re, sys
def keys(value):
    if isinstance(value, dict):
        return set(value) | keys(list(value.values()))
    return set().union(*map(keys, value)) if isinstance(value, list) else set()
written = set().union(*(keys(json.load(open(name))) for name in sys.argv[2:]))
types = open(sys.argv[1] + "/web/npm/index.d.ts").read()
types = types[types.index("export interface ExplainedFragment"):types.index("// Triangles without a model")]
typed = set(re.findall(r"^ *(\w+)\??:", types, re.M)) - {"text"}
page = open(sys.argv[1] + "/docs/outputs.md").read()
page = page[page.index("\n## What is told of a pixel"):page.index("\n## What is drawn")]
told = set(re.findall(r"`(\w+)`", page))
assert written == typed, (written - typed, typed - written)
assert written <= told, written - told
PY
fi
succeed explain --help
check "help" grep -q -- '--at X,Y' "$folder/log/out"

refuse 2 "explain: --at X,Y is missing: which pixel\?" explain cube.obj
refuse 2 "explain: expected MODEL --at X,Y; see 'rhw explain --help'" explain --at 1,1
refuse 2 "cube.obj: one argument too many; see 'rhw explain --help'" explain cube.obj cube.obj --at 1,1
refuse 2 "--at: '5' is not the X,Y of a pixel, from 0,0 on" explain cube.obj --at 5
refuse 2 "--at: '1.5,2' is not the X,Y of a pixel" explain cube.obj --at 1.5,2
refuse 2 "--at: '-1,2' is not the X,Y of a pixel" explain cube.obj --at -1,2
refuse 2 "--at: 64,3 lies outside the picture, which is 64x64" explain cube.obj --at=64,3 --size 64
refuse 2 "--sample: '256' is not a number of 0 to 255" explain cube.obj --at 1,1 --sample 256
refuse 2 "--sample: 4 is too many: a pixel has 4, 0 to 3" explain cube.obj --at 1,1 --sample 4
refuse 2 "--sample: 36 is too many: a pixel has 36, 0 to 35" explain cube.obj --at 1,1 --supersample 9 --sample 36
refuse 2 "--transparency: cannot be explained; without it the same surfaces are told in another order" explain cube.obj --at 1,1 --transparency exact
refuse 2 "--out: explain writes no picture; --picture" explain cube.obj --at 1,1 -o a.png
refuse 2 "--views: cannot be explained" explain cube.obj --at 1,1 --views top
refuse 2 "--no-such-thing: no such option; see 'rhw explain --help'" explain cube.obj --at 1,1 --no-such-thing
refuse 1 "missing.obj: cannot be opened" explain missing.obj --at 1,1
no_temporary_files
# Of parts that are far from each other positions count from the one that the camera is near.
printf 'v 0 0 0\nv 1 0 0\nv 0 1 0\nv 5000000 0 0\nv 5000001 0 0\nv 5000000 1 0\nf 1 2 3\nf 4 5 6\n' >apart.obj
succeed explain apart.obj --at 80,60 --json --camera 5000000.3,0.3,4,5000000.3,0.3,0,0,1,0,30
check "the origin is near the camera" grep -q '"origin": \[500000' "$folder/log/out"
finish
