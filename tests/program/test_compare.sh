#!/bin/sh
# SPDX-License-Identifier: MIT
# rhw compare: numbers that can be computed by hand, every kind of file, and files that are none.
. "$(dirname "$0")/harness.sh"

# 2×2 pictures in PPM; B differs from A in two pixels: R by 51 (0.2 of 255) and 102 (0.4), G by 51 once.
printf 'P6\n# a comment\n2 2\n255\n\000\000\000\377\377\377\012\024\036\144\144\144' >a.ppm
printf 'P6 2 2 255\n\000\000\000\314\377\377\012\024\036\312\227\144' >b.ppm
printf 'P3\n2 2\n255\n0 0 0 255 255 255 10 20 30\n100 100 100 # end\n' >text.ppm
printf 'P5\n2 1\n255\n\000\200' >grey.pgm
printf 'P2\n2 1\n65535 0 32896' >grey16.pgm
printf 'P6\n2 1\n255\n\000\000\000\200\200\200' >grey.ppm

succeed compare a.ppm a.ppm
check "equal" grep -q "^all 4 pixels are equal" "$folder/log/out"
succeed compare a.ppm text.ppm
succeed compare grey.pgm grey16.pgm
succeed compare grey.pgm grey.ppm

run compare a.ppm b.ppm
check "status" test $status = 1
check "line" grep -q "^rhw: b.ppm: differs from a.ppm by up to 0.4, more than the tolerance of 0$" "$folder/log/err"
# R: max 0.4, mean (0.2 + 0.4) / 4 = 0.15, PSNR 10 log10(4 / (0.04 + 0.16)) = 13.01
check "red" grep -Eq "^R +0.4 +0.15 +13.01 +2$" "$folder/log/out"
# G: 0.2, 0.05, 10 log10(4 / 0.04) = 20.00
check "green" grep -Eq "^G +0.2 +0.05 +20.00 +1$" "$folder/log/out"
check "blue" grep -Eq "^B +0 +0 +inf +0$" "$folder/log/out"
check "pixels" grep -q "^2 of 4 pixels differ, most at 1,1 by 0.4" "$folder/log/out"
succeed compare a.ppm b.ppm --tolerance 102/255
succeed compare a.ppm b.ppm -t 0.41
run compare a.ppm b.ppm --tolerance 101/255
check "above the tolerance" test $status = 1
run compare a.ppm b.ppm --json
check "JSON numbers" grep -q '{"name": "R", "max": 0.4, "mean": 0.15, "psnr": 13.0103, "differing": 2}' "$folder/log/out"
check "JSON infinity is null" grep -q '"name": "B", "max": 0, "mean": 0, "psnr": null' "$folder/log/out"
check "JSON verdict" grep -q '"pass": false' "$folder/log/out"
if command -v python3 >/dev/null 2>&1; then
    check "JSON" python3 -m json.tool "$folder/log/out" /dev/null
fi

# The picture: black where equal; 0.2 and 0.4 are log2 + 10 = 7.678 and 8.678 of 9, so step 4.266 and 4.821 of 5:
# 27% and 82% of the way from (255, 40, 0) to white.
run compare a.ppm b.ppm --difference d.ppm
check "difference picture" test "$(echo $(od -A n -t u1 -j 11 d.ppm))" = "0 0 0 255 97 68 0 0 0 255 217 209"
run compare a.ppm b.ppm --difference d.png
succeed compare d.ppm d.png

# What rhw writes itself: EXR with ids, floats and infinities.
make_cube cube
succeed render cube.obj --size 64x48 -o one.exr --output all
succeed render cube.obj --size 64x48 -o two.exr --output all --orbit 10,10
succeed compare one.exr one.exr
run compare one.exr two.exr --difference d.png
check "different EXR" test $status = 1
check "an infinite distance beside a finite one is no number" grep -Eq "^distance.Z +inf +inf " "$folder/log/out"
run compare one.exr two.exr --json
check "infinity is null in JSON" grep -q '"name": "distance.Z", "max": null' "$folder/log/out"

# Files that are no pictures, or none that can be compared.
succeed render cube.obj --size 64x48 -o a.png
refuse 1 "a.png: is 64x48, but a.ppm is 2x2" compare a.ppm a.png
refuse 1 "a.png: an EXR file compares with EXR files only" compare one.exr a.png
refuse 1 "none.png: cannot be opened: No such file or directory" compare a.png none.png
refuse 1 "a.png: is one of the pictures; name another file for the difference" compare a.png a.png -d a.png
refuse 1 "./a.ppm: is one of the pictures" compare a.png a.ppm -d ./a.ppm
mkdir folder
refuse 1 "folder: cannot be opened: Is a directory" compare folder a.png
: >empty.png
refuse 1 "empty.png: the file is empty" compare empty.png a.png
echo hello >words.png
refuse 1 "words.png: not a picture that rhw reads" compare words.png a.png
head -c 300 a.png >cut.png
refuse 1 "cut.png: the PNG file ends too early" compare cut.png a.png
for length in 5 20 200 2000; do
    head -c $length one.exr >cut.exr
    refuse 1 "cut.exr: not a valid EXR file" compare cut.exr one.exr
done
succeed render cube.obj --size 64x48 -o a.webp
succeed compare a.png a.webp
succeed render cube.obj --size 64x48 -o clear.webp --background transparent
succeed render cube.obj --size 64x48 -o clear.png --background transparent
succeed compare clear.png clear.webp
run compare a.webp clear.webp
check "WebP with alpha" grep -Eq "^A +1 " "$folder/log/out"
for length in 12 20 30 200; do
    head -c $length a.webp >cut.webp
    refuse 1 "cut.webp: the WebP file ends too early" compare cut.webp a.webp
done
{ head -c 12 a.webp && echo "no chunk that WebP has, but long enough to be one"; } >words.webp
refuse 1 "words.webp: not a valid WebP file" compare words.webp a.webp
succeed render cube.obj --size 64x48 -o moving.webp --turntable 3
refuse 1 "moving.webp: moves; 'rhw render' with a \{frame\} in OUT" compare moving.webp a.webp
head -c 20 a.ppm >cut.ppm
refuse 1 "cut.ppm: the PPM file ends too early" compare cut.ppm a.ppm
printf 'P6\n0 2\n255\n' >zero.ppm
refuse 1 "zero.ppm: not a valid PPM header" compare zero.ppm a.ppm
printf 'P6\n99999999999999999999 2\n255\n' >wide.ppm
refuse 1 "wide.ppm: not a valid PPM header" compare wide.ppm a.ppm
printf 'P3\n1 1\n7\n8 0 0\n' >range.ppm
refuse 1 "range.ppm: a sample of the PPM file is out of range" compare range.ppm a.ppm
printf 'P6\n1 1\n7\n\000\010\000' >range.ppm
refuse 1 "range.ppm: a sample of the PPM file is out of range" compare range.ppm a.ppm
printf 'P5\n1 1\n300\n\001\055' >range.pgm
refuse 1 "range.pgm: a sample of the PPM file is out of range" compare range.pgm a.ppm

# What a picture may take. 8192 pixels each way of 16 channels are 4 GiB, of which a file of a few bytes can speak.
mkfifo pipe.png
refuse 1 "pipe.png: cannot be opened: it is no regular file" compare pipe.png a.png
words() { # NUMBER...: little endian, of 32 bits
    for number; do
        printf "\\$(printf %o $((number % 256)))\\$(printf %o $((number / 256 % 256)))\\$(printf %o $((number / 65536)))\\0"
    done
}
attribute() { # NAME TYPE SIZE
    printf '%s\0%s\0' "$1" "$2"
    words "$3"
}
large_exr() { # SIDE
    printf '\166\057\061\001\002\0\0\0'
    attribute channels chlist 305
    for channel in a b c d e f g h i j k l m n o p; do
        printf '%s\0' $channel && words 2 0 1 1
    done
    printf '\0'
    attribute compression compression 1 && printf '\003'
    attribute dataWindow box2i 16 && words 0 0 $(($1 - 1)) $(($1 - 1))
    attribute displayWindow box2i 16 && words 0 0 $(($1 - 1)) $(($1 - 1))
    attribute lineOrder lineOrder 1 && printf '\0'
    attribute pixelAspectRatio float 4 && printf '\0\0\200\077'
    attribute screenWindowCenter v2f 8 && words 0 0
    attribute screenWindowWidth float 4 && printf '\0\0\200\077\0'
    head -c 100000 /dev/zero
}
large_exr 8192 >large.exr
refuse 1 "large.exr: takes 4096 MiB of memory, more than the 2048 MiB that a picture may" compare large.exr large.exr
refuse 1 "large.exr: takes 4096 MiB of memory, more than the 2048 MiB" render cube.obj --environment large.exr -o b.png
large_exr 1024 >large.exr
refuse 1 "large.exr: takes 64 MiB of memory, more than the 32 MiB" compare large.exr large.exr --max-memory 64M
refuse 1 "large.exr: not a valid EXR file" compare large.exr large.exr
printf 'P5\n16384 16384\n255\n' >large.pgm
refuse 1 "large.pgm: takes 256 MiB of memory, more than the 32 MiB" compare large.pgm a.png --max-memory 64M
refuse 2 "--max-memory: '1k' is not a size" compare a.png a.png --max-memory 1k
refuse 2 "--max-time: '0' is not" compare a.png a.png --max-time 0
succeed compare a.png a.png --max-memory 4G --max-time 60

# A chunk of text, too, may become a thousand times as large as it is.
python3 - <<'PY'
import struct, zlib
def chunk(kind, data):
    return struct.pack(">I", len(data)) + kind + data + struct.pack(">I", zlib.crc32(kind + data))
zeros = zlib.compressobj(9)
packed = b"".join(zeros.compress(bytes(1 << 20)) for i in range(70)) + zeros.flush()
picture = open("a.png", "rb").read()
for name, kind, before in (("text", b"zTXt", b"k\0\0"), ("profile", b"iCCP", b"k\0\0")):
    open(name + ".png", "wb").write(picture[:33] + chunk(kind, before + packed) + picture[33:])
PY
for name in text profile; do
    refuse 1 "$name.png: not a valid PNG file: reached chunk/cache limits" compare a.png $name.png
done

finish
