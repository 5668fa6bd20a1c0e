#!/bin/sh
# SPDX-License-Identifier: MIT
# rhw info tells of a material what is drawn of it: the numbers of its layers where they do something, as text and as JSON.
. "$(dirname "$0")/harness.sh"

cat >layers.gltf <<'END'
{"asset": {"version": "2.0"},
 "extensionsUsed": ["KHR_materials_clearcoat", "KHR_materials_sheen", "KHR_materials_ior",
                    "KHR_materials_pbrSpecularGlossiness", "ACME_glow"],
 "animations": [{"name": "wave", "samplers": [{"input": 1, "output": 0}],
                 "channels": [{"sampler": 0, "target": {"node": 0, "path": "translation"}}]}],
 "materials": [
  {"name": "velvet", "extensions": {
    "KHR_materials_sheen": {"sheenColorFactor": [0.5, 0.25, 0], "sheenRoughnessFactor": 0.75},
    "KHR_materials_clearcoat": {"clearcoatFactor": 0.5}, "KHR_materials_ior": {"ior": 1.5}}},
  {"name": "gloss", "extensions": {"KHR_materials_pbrSpecularGlossiness": {
    "specularFactor": [1, 0.5, 0.25], "glossinessFactor": 0.125}}},
  {"name": "plain"}],
 "meshes": [{"primitives": [{"attributes": {"POSITION": 0}, "material": 0},
  {"attributes": {"POSITION": 0}, "material": 1}, {"attributes": {"POSITION": 0}, "material": 2}]}],
 "nodes": [{"mesh": 0}], "scenes": [{"nodes": [0]}], "scene": 0,
 "accessors": [{"bufferView": 0, "componentType": 5126, "count": 3, "type": "VEC3", "min": [0, 0, 0], "max": [1, 1, 0]},
  {"bufferView": 0, "componentType": 5126, "count": 3, "type": "SCALAR", "min": [0], "max": [2.5]}],
 "bufferViews": [{"buffer": 0, "byteLength": 36}],
 "buffers": [{"byteLength": 36, "uri": "data:application/octet-stream;base64,AAAAAAAAAAAAAAAAAACAPwAAAAAAAAAAAAAAAAAAgD8AAAAA"}]}
END

usual="base 1 1 1 1, metallic 1, roughness 1"
run info layers.gltf
check "rhw info" test $status = 0
check "layers in the order of the list" grep -q \
    "^ *0  $usual, clearcoat 0.5, sheen_color 0.5 0.25 0, sheen_roughness 0.75  \"velvet\"$" "$folder/log/out"
check "glossiness" grep -q "gloss_specular 1 0.5 0.25, glossiness 0.125  \"gloss\"$" "$folder/log/out"
check "no layers" grep -q "^ *2  $usual  \"plain\"$" "$folder/log/out"
check "the unit" grep -q "^unit:      metre$" "$folder/log/out"
check "the size" grep -q "^size:      1 x 1 x 0$" "$folder/log/out"
check "what is up" grep -q "^up:        y, by its format$" "$folder/log/out"
grep -q "^framed:" "$folder/log/out" && fail "a frame that is the bounds is told of"
check "memory: 3 of each mesh's vertices of 24 bytes, 3 indices" grep -q "^memory:    0.0 MiB of meshes, 0.0 MiB of textures$" \
    "$folder/log/out"
check "extensions" grep -q "^  KHR_materials_sheen: drawn$" "$folder/log/out"
check "an ignored one" grep -q "^  ACME_glow: ignored$" "$folder/log/out"
check "animations" grep -q '^    0  2.5 s, 1 channels  "wave"$' "$folder/log/out"
run info --json layers.gltf
check "JSON of an animation" grep -q '{"name": "wave", "seconds": 2.5, "channels": 1}' "$folder/log/out"
check "JSON of an extension" grep -q '{"name": "ACME_glow", "required": false, "drawn": false}' "$folder/log/out"
check "JSON of bytes" grep -q '"mesh_bytes": 252,$' "$folder/log/out"
check "JSON" grep -q '"double_sided": false, "clearcoat": 0.5, "sheen_color": \[0.5, 0.25, 0\], "sheen_roughness": 0.75}' \
    "$folder/log/out"
check "JSON without layers" grep -q '"plain".*"double_sided": false}' "$folder/log/out"

# What a picture is about, where it is less than the bounds.
sed 's/\[{"mesh": 0}\]/[{"mesh": 0}, {"mesh": 0, "scale": [0, 0, 0], "translation": [9, 0, 0]}]/; s/"nodes": \[0\]/"nodes": [0, 1]/' \
    layers.gltf >framed.gltf
run info framed.gltf
check "the bounds" grep -q "^bounds:    0 0 0 to 9 1 0$" "$folder/log/out"
check "the frame" grep -q "^framed:    0 0 0 to 1 1 0$" "$folder/log/out"
run info --json framed.gltf
check "JSON of the frame" grep -q '"frame": {"empty": false, "min": \[0, 0, 0\], "max": \[1, 1, 0\]},$' "$folder/log/out"

check "JSON of the origin" grep -q '"origin": \[0, 0, 0\],$' "$folder/log/out"
printf 'v 5000000.5 0 0\nv 5000001.5 0 0\nv 5000000.5 1 0\nf 1 2 3\n' >far.obj
run info --json far.obj
check "JSON of an origin that is far" grep -Eq '"origin": \[500000[0-9.]*, [-0-9.]*, 0\],$' "$folder/log/out"


# Places of cameras and lights of a part that is far away, which floats would round to multiples of 4.
sed 's/\[{"mesh": 0}\]/[{"mesh": 0}, {"mesh": 0, "translation": [54598150.3, 0, 0]}, {"camera": 0, "translation": [54598150.3, 0.7, 5]},\
    {"translation": [-12345678.9, 1, 2], "extensions": {"KHR_lights_punctual": {"light": 0}}}, {"camera": 0, "translation": [0.7, 0, 5]}]/
    s/"nodes": \[0\]/"nodes": [0, 1, 2, 3, 4]/
    s/^{/{"cameras": [{"type": "perspective", "perspective": {"yfov": 1, "znear": 0.1}}], "extensions": {"KHR_lights_punctual": {"lights":\
    [{"type": "point"}]}}, /' layers.gltf >parts.gltf
run info --json parts.gltf
check "JSON of a far camera" grep -q '"world": \[.*, 54598150.3, 0.7, 5, 1\]}' "$folder/log/out"
check "JSON of a far light" grep -q '"position": \[-12345678.9, 1, 2\]' "$folder/log/out"
run info parts.gltf
check "a far camera" grep -q "at 54598150.3 0.7 5, perspective" "$folder/log/out"

# Samplers, where they are not linear and repeating.
printf 'P6\n1 1\n255\nabc' >dot.ppm
sed 's/{"name": "plain"}\],/{"name": "plain", "emissiveTexture": {"index": 0}, "normalTexture": {"index": 1}, "occlusionTexture":\
    {"index": 2}}], "images": [{"uri": "dot.ppm"}], "textures": [{"source": 0}, {"source": 0, "sampler": 0},\
    {"source": 0, "sampler": 1}], "samplers": [{"magFilter": 9728, "minFilter": 9729, "wrapS": 33648, "wrapT": 33071},\
    {"minFilter": 9984, "wrapS": 33071, "wrapT": 33071}],/' layers.gltf >sampled.gltf
run info sampled.gltf
check "samplers" grep -q "normal image 0 (nearest when enlarged, no mip levels, u mirror, v clamp), occlusion image 0 (nearest when reduced, nearest mip level, clamp), emissive image 0  \"plain\"$" \
    "$folder/log/out"
run info --json sampled.gltf
check "JSON of a sampler" grep -q '"normal_image": 0, "normal_sampler": {"min": "linear", "mag": "nearest", "mip": "none", "u": "mirror", "v": "clamp"}' \
    "$folder/log/out"


# What a mesh has, what an image is used for, and every number of a light.
cat >lit.gltf <<'END'
{"asset": {"version": "2.0"}, "extensionsUsed": ["KHR_lights_punctual"],
 "extensions": {"KHR_lights_punctual": {"lights": [
  {"type": "spot", "name": "lamp", "intensity": 5, "range": 7.5, "color": [1, 0.5, 0.25], "spot": {"outerConeAngle": 0.5}}]}},
 "images": [{"uri": "dot.ppm"}, {"uri": "dot.ppm"}, {"uri": "dot.ppm"}],
 "textures": [{"source": 0}, {"source": 1}, {"source": 2}],
 "materials": [
  {"pbrMetallicRoughness": {"baseColorTexture": {"index": 0}}, "normalTexture": {"index": 1}, "emissiveTexture": {"index": 2}},
  {"occlusionTexture": {"index": 2}}],
 "meshes": [{"primitives": [
  {"attributes": {"POSITION": 0, "NORMAL": 0, "TEXCOORD_0": 1, "TANGENT": 2}, "material": 0},
  {"attributes": {"POSITION": 0}, "material": 1}]}],
 "nodes": [{"mesh": 0}, {"extensions": {"KHR_lights_punctual": {"light": 0}}}], "scenes": [{"nodes": [0, 1]}], "scene": 0,
 "accessors": [{"bufferView": 0, "componentType": 5126, "count": 3, "type": "VEC3"},
  {"bufferView": 0, "componentType": 5126, "count": 3, "type": "VEC2"},
  {"bufferView": 0, "componentType": 5126, "count": 3, "type": "VEC4"}],
 "bufferViews": [{"buffer": 0, "byteLength": 48}],
 "buffers": [{"byteLength": 48, "uri": "data:application/octet-stream;base64,AAAAAAAAAAAAAAAAAACAPwAAAAAAAAAAAAAAAAAAgD8AAAAAAAAAAAAAAAAAAIA/"}]}
END
run info lit.gltf
check "what a mesh has" grep -q '^    0  1 triangles, 3 vertices, material 0, normals, tangents, uv 0$' "$folder/log/out"
check "and has not" grep -q '^    1  1 triangles, 3 vertices, material 1, normals$' "$folder/log/out"
check "uses of images" test "$(sed -n 's/^ *\([0-2]\)  1x1 RGBA8, \(.*\)  "dot.ppm"$/\1 \2;/p' "$folder/log/out" | tr '\n' ' ')" = \
    "0 color; 1 data; 2 color and data; "
run info --json lit.gltf
check "JSON of a light" grep -q '{"name": "lamp", "type": "spot", .*"color": \[1, 0.5, 0.25\], "intensity": 5, "range": 7.5}' "$folder/log/out"

# Source's models stand along z, and assimp leaves them so.
cat >stands.smd <<'SMD'
version 1
nodes
0 "a" -1
end
skeleton
time 0
0 0 0 0 0 0 0
end
triangles
x.bmp
0 0 0 0 0 0 1 0 0
0 1 0 0 0 0 1 1 0
0 0 1 0 0 0 1 0 1
end
SMD
run info stands.smd
check "z is up" grep -q '^up:        z, by its format$' "$folder/log/out"

# A binary FBX ends with a mark.
head -c -1 "$root/tests/fuzz/seeds/bone.fbx" >cut.fbx
run info cut.fbx
check "an FBX without its mark is read" test $status = 0
check "and told" grep -q '^  has no mark at its end: it may be cut$' "$folder/log/out"
run info "$root/tests/fuzz/seeds/bone.fbx"
grep -q "no mark" "$folder/log/out" && fail "a whole FBX is told to be cut"

finish
