#!/bin/sh
# SPDX-License-Identifier: MIT
# rhw bench at a tiny size: every form of output, with the peer where there is one and without.
. "$(dirname "$0")/harness.sh"

tiny="--size 96x54 --frames 2"

succeed bench --list
check "list names the scenes" test "$(grep -cE "^(fill_flat|overdraw|painter|sphere_1m_depth|bunny_lit|sponza|pbr_helmet|pbr_sponza|context|texture|mips|process|lines_1m|points_1m|shadow_volumes|shadow_map|reflection|deferred|particles|shadowed_helmet|shadowed_sponza|hair|transmission) " "$folder/log/out")" = 23

succeed bench $tiny --peer none --scene fill --threads 2
check "table has its rows" test "$(grep -cE '^fill_(flat|color|blend|tex) ' "$folder/log/out")" = 4
check "no ratio without a peer" sh -c "! grep -q ratio '$folder/log/out'"

# Several numbers of threads: each is timed, and the stages of a frame are part of it.
succeed bench $tiny --scene fill_color,sphere_10k,shadow_map --threads 1,3,2 --csv=scaling.csv --json=scaling.json
check "scaling: a row for each number" test "$(grep -cE '^(fill_color|sphere_10k|shadow_map| ) +[123] +[0-9.]+ ' "$folder/log/out")" = 9
check "scaling: csv" test "$(awk -F, 'NR == 1 { n = NF } NF == n { print $2 }' scaling.csv | paste -sd ,)" = threads,1,3,2,1,3,2,1,3,2
check "scaling: stages within the frame" awk -F, 'NR > 1 && ($8 <= 0 || $11 <= 0 || $14 < 0 || $9 > 1.01 || $12 > 1.01) { exit 1 }' scaling.csv
check "scaling: one thread does not wait" awk -F, '$2 == 1 && ($9 < 0.5 || $12 < 0.5 || $6 != 1) { exit 1 }' scaling.csv
check "scaling: json" python3 -c 'import json; assert [len(s["scaling"]) for s in json.load(open("scaling.json"))["scenes"]] == [3, 3, 3]'

succeed bench $tiny --peer none --scene fill_flat,sphere_10k --threads 1 --csv
check "csv: head and one line per scene" test "$(wc -l <"$folder/log/out")" = 3
check "csv: equal number of fields" test "$(awk -F, '{print NF}' "$folder/log/out" | sort -u | wc -l)" = 1

succeed bench $tiny --peer none --scene fill_flat --json=a.json --csv=a.csv
check "files beside the table" test "$(wc -l <a.csv)" = 2 -a -s "$folder/log/out"
check "json names the scene" grep -q '"name": "fill_flat", "rhw_ms": [0-9.]*' a.json

mkdir pictures
succeed bench $tiny --peer none --scene sphere_1m_depth,fill_tex --save pictures
check "pictures" test -s pictures/sphere_1m_depth_rhw.png -a -s pictures/fill_tex_rhw.png
refuse 1 "missing: is no folder" bench $tiny --scene fill_tex --save missing
refuse 1 "missing/a.json: " bench $tiny --peer none --scene fill_tex --json=missing/a.json --csv=b.csv

# A model that is not there leaves its scene out, and nothing else.
status=0
RHW_MODELS=$folder/none "$rhw" bench $tiny --peer none --scene sponza,pbr,empty --csv >"$folder/log/out" 2>"$folder/log/err" || status=$?
check "no model: status" test "$status" = 0
check "no model: a line each" test "$(grep -cE '^rhw: (sponza|pbr_helmet|pbr_sponza): warning: left out: there is no .*/none/gltf' "$folder/log/err")" = 3
check "no model: the others" grep -q '^empty,' "$folder/log/out"

# The program as a process, where there is the bunny; it leaves no picture behind.
mkdir -p leaves
status=0
TMPDIR=$PWD/leaves "$rhw" bench $tiny --peer none --scene process --csv >"$folder/log/out" 2>"$folder/log/err" || status=$?
if [ -r /usr/share/glmark2/models/bunny.obj ]; then
    check "process: status" test "$status" = 0
    check "process: a row" grep -qE '^process,[0-9.]+,' "$folder/log/out"
    status=0
    TMPDIR=$PWD/none "$rhw" bench $tiny --peer none --scene process >/dev/null 2>"$folder/log/err" || status=$?
    check "process: what fails is told" test "$status" = 1
else
    check "process: left out" grep -q '^rhw: process: warning: left out: there is no ' "$folder/log/err"
fi
check "process: nothing left" test -z "$(ls leaves)"

# Pictures of other formats, beside the peer where it draws into them.
run bench $tiny --scene cliffs --csv
check "formats: status" test "$status" = 0
check "formats: a row each" test "$(grep -cE '^cliffs_[a-z0-9_]+,' "$folder/log/out")" = "$("$rhw" bench --list | grep -c '^cliffs_')"
check "formats: pictures agree" sh -c "! grep -q ',no,' '$folder/log/out'"
check "formats: no other line" sh -c "! grep -v 'not compared with' '$folder/log/err'"

# The peer, or one line that says why there is none.
run bench $tiny --scene fill_blend,sphere_10k,points,shadow_,reflection,deferred,particles,empty,draws_10k,draws_textures,context,texture,mips --json
check "with the peer: status" test "$status" = 0
if grep -q 'not compared with' "$folder/log/err"; then
    check "without Mesa: one line" test "$(wc -l <"$folder/log/err")" = 1
    check "without Mesa: no peers" grep -q '"peers": {}' "$folder/log/out"
else
    check "with the peer: quiet" test ! -s "$folder/log/err"
    check "with the peer: ratio" grep -q '"peers": {"llvmpipe": {"ms": [0-9.]*, "ratio": [0-9.]*,.*"agrees": true' "$folder/log/out"
fi

# The built-in physically based shader against its twin in GLSL, on a model of our own in place of the two:
# patches.gltf has a patch in every kind of material that the scenes have.
mkdir -p models/gltf/sponza
cp "$root/tests/program/patches.gltf" models/gltf/DamagedHelmet.glb
cp "$root/tests/program/patches.gltf" models/gltf/sponza/Sponza.gltf
status=0
RHW_MODELS=$PWD/models "$rhw" bench --size 320x180 --frames 1 --scene pbr,shadowed,hair,transmission --csv >"$folder/log/out" 2>"$folder/log/err" || status=$?
check "physically based: status" test "$status" = 0
check "physically based: pictures agree" sh -c "! grep -v 'not compared with' '$folder/log/err'"
check "physically based: all scenes" test "$(grep -cE '^((pbr|shadowed)_(helmet|sponza)|hair|transmission),' "$folder/log/out")" = 6

# What the twin has no shader for is left out, not drawn differently.
sed 's/"scale": \[1, 0.9, 0.4\]/"scale": [-1, 0.9, 0.4]/' "$root/tests/program/patches.gltf" >models/gltf/DamagedHelmet.glb
status=0
RHW_MODELS=$PWD/models "$rhw" bench $tiny --peer none --scene pbr_helmet --csv >"$folder/log/out" 2>"$folder/log/err" || status=$?
check "mirrored: nothing is left to do" test "$status" = 1
check "mirrored: says so" grep -q '^rhw: bench: no scene was timed$' "$folder/log/err"
check "mirrored: left out" grep -q '^rhw: pbr_helmet: warning: left out: a material or an instance' "$folder/log/err"
no_temporary_files

# The chart of the README: a bar for each scene that a peer drew, but for the empty one.
cat >results.csv <<'CSV'
scene,rhw_ms,rhw_min_ms,rhw_max_ms,peer,peer_ms,ratio
fill_flat,2.0,1.9,2.2,llvmpipe,12.0,6.0
bunny_lit,5.0,4.9,5.2,llvmpipe,19.0,3.8
empty,0.05,0.04,0.1,llvmpipe,3.7,74
context,0.1,0.1,0.1,,,
CSV
"$root/script/bench_chart" results.csv >chart.svg
check "chart: two bars" test "$(grep -c '<rect class="bar"' chart.svg)" = 2
check "chart: labels" test "$(grep -cE '>(6.0|3.8)× ' chart.svg)" = 2

# The tables of docs/performance.md.
cat >older.csv <<'CSV'
scene,rhw_ms,rhw_1_thread_ms,peer,peer_ms,ratio,peer_version
fill_flat,2.0,3.0,llvmpipe,24.0,12.0,22.3.6
CSV
cat >newer.csv <<'CSV'
scene,rhw_ms,rhw_1_thread_ms,peer,peer_ms,ratio,peer_version
fill_flat,2.0,4.0,llvmpipe,12.0,6.0,25.0.7-2~bpo12+1
fill_color,4.0,8.0,llvmpipe,4.0,1.0,25.0.7-2~bpo12+1
cliffs_store_r8,5.0,9.0,llvmpipe,6.0,1.2,25.0.7-2~bpo12+1
cliffs_move_fill,6.0,9.0,llvmpipe,8.0,1.3,25.0.7-2~bpo12+1
cliffs_sample4_fill,24.0,40.0,llvmpipe,32.0,1.3,25.0.7-2~bpo12+1
context,0.1,0.1,,,,
CSV
"$root/script/bench_table" scenes newer.csv older.csv >table
check "table: names both" grep -qF '| scene | rhw, ms | llvmpipe 25.0.7, ms | times as fast | goal | than llvmpipe 22.3.6 | 2 threads over 1 |' table
check "table: a goal that is met" grep -qF '| fill_flat | 2.00 | 12.0 | **6.0** | 4 | 12.0 | 2.0 |' table
check "table: a goal that is missed" grep -qF '| fill_color | 4.00 | 4.00 | 1.0 | 2 |  | 2.0 |' table
check "table: pictures that a peer drew" test "$(wc -l <table)" = 4
"$root/script/bench_table" cliffs newer.csv >table
check "table: a factor" grep -qF '| cliffs_store_r8 | fill_color | 5.00 | **1.25** | 1.3 | 6.00 | 1.50 |' table

check "table: a factor no worse than the peer's" grep -qF '| cliffs_move_fill | fill_color | 6.00 | **1.50** | 2.00 | 8.00 | 2.00 |' table
check "table: a factor beside 4 frames" grep -qF '| cliffs_sample4_fill | 4 × fill_color | 24.0 | 1.50 | 1.3 | 32.0 | 2.00 |' table

# The peer's libraries, which a command is given by its environment, or a line where they cannot be had.
mkdir -p stubs peer/root/usr/lib peer/root/usr/share
printf '#!/bin/sh\nexit 1\n' >stubs/apt-get
chmod +x stubs/apt-get
RHW_PEER=$PWD/none PATH=$PWD/stubs:$PATH "$root/script/peer" echo ran >out 2>err
check "peer: runs without a network" grep -qx ran out
check "peer: says so" test "$(grep -c '^script/peer: no Mesa from .*; going on with the system' err)" = 1 -a "$(wc -l <err)" = 1
touch peer/root/usr/lib/libEGL_mesa.so.0 peer/root/usr/lib/libvulkan_lvp.so peer/root/usr/share/50_mesa.json
echo 99.1 >peer/version
RHW_PEER=$PWD/peer "$root/script/peer" sh -c 'echo "$LD_LIBRARY_PATH $__EGL_VENDOR_LIBRARY_FILENAMES"' >out 2>err
check "peer: names the version" grep -q '^script/peer: Mesa 99.1 from ' err
check "peer: the environment" grep -q "^$PWD/peer/root/usr/lib.* $PWD/peer/root/usr/share/50_mesa.json" out

if command -v xmllint >/dev/null 2>&1; then
    check "chart: well-formed" xmllint --noout chart.svg
fi

finish
