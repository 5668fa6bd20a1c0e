# SPDX-License-Identifier: MIT
"""Many small objects take time and memory by their number: seconds of the processor for a few of them, and for eight
times as many.

usage: small_objects.py RHW [small]   small: a tenth of them, and nobody looks at what they take: a sanitizer takes more
"""
import json
import resource
import struct
import subprocess
import sys

TIMES = 8
MOST = 1.75  # of the time of one of a few; a look at all others for each makes it 3 and more
RUNS = 2  # of the few, for a steadier time
AGAIN = 2  # of the many, where they took too long: what runs beside them takes their cache
BYTES = 20480  # that an object may take
DRAW = "--size 64 --samples 1 --shadows off --ambient-occlusion off --threads 1 -q --max-time 60".split()


def write_gltf(count, has_images):
    """Each object with a mesh and a material of its own, and an image that is not there where it has one."""
    primitives = [{"attributes": {"POSITION": 0}, "material": i} for i in range(count)]
    model = {
        "asset": {"version": "2.0"}, "scene": 0, "scenes": [{"nodes": list(range(count))}],
        "nodes": [{"mesh": i, "name": f"node {i}", "translation": [i % 100, i // 100, 0]} for i in range(count)],
        "meshes": [{"primitives": [primitive]} for primitive in primitives],
        "materials": [{"name": f"material {i}"} for i in range(count)],
        "accessors": [{"bufferView": 0, "componentType": 5126, "count": 3, "type": "VEC3"}],
        "bufferViews": [{"buffer": 0, "byteLength": 36}], "buffers": [{"byteLength": 36, "uri": "three.bin"}]}
    if has_images:
        model["images"] = [{"uri": f"none {i}.png"} for i in range(count)]
        model["textures"] = [{"source": i} for i in range(count)]
        for i, material in enumerate(model["materials"]):
            material["pbrMetallicRoughness"] = {"baseColorTexture": {"index": i}}
    with open("three.bin", "wb") as file:
        file.write(struct.pack("<9f", 0, 0, 0, 1, 0, 0, 0, 1, 0))
    with open("many.gltf", "w", encoding="utf-8") as file:
        json.dump(model, file)
    return "many.gltf"


def write_obj(count, has_textures):
    """Each object with a material of its own, and a texture that is not there where it has one."""
    with open("many.mtl", "w", encoding="utf-8") as file:
        texture = "map_Kd none{}.png\n" if has_textures else ""
        file.writelines(f"newmtl m{i}\nKd 0.{i % 10} 0 0\n" + texture.format(i) for i in range(count))
    with open("many.obj", "w", encoding="utf-8") as file:
        file.write("mtllib many.mtl\n")
        for i in range(count):
            x, y = i % 100, i // 100
            file.write(f"o o{i}\nusemtl m{i}\nv {x} {y} 0\nv {x + 1} {y} 0\nv {x} {y + 1} 0\nf -3 -2 -1\n")
    return "many.obj"


def draw(rhw, model):
    """Seconds of the processor, those of the process that reads included, and the most bytes that were in use."""
    before = resource.getrusage(resource.RUSAGE_CHILDREN)
    command = [rhw, "render", model, "-o", "many.png", "--stats=many.json", *DRAW]
    done = subprocess.run(command, stderr=subprocess.PIPE, text=True, check=False)
    after = resource.getrusage(resource.RUSAGE_CHILDREN)
    if done.returncode != 0:
        sys.exit(f"{model}: {done.stderr}")
    with open("many.json", encoding="utf-8") as file:
        memory = json.load(file)["process_memory_peak"]
    return after.ru_utime + after.ru_stime - before.ru_utime - before.ru_stime, memory


def main():
    rhw, is_small = sys.argv[1], sys.argv[2:] == ["small"]
    rows = [("objects", 5000, lambda count: write_gltf(count, False)),
            ("images", 1250, lambda count: write_gltf(count, True)),
            ("objects of OBJ", 5000, lambda count: write_obj(count, False)),
            ("textures of OBJ", 5000, lambda count: write_obj(count, True))]
    wrong = 0
    for name, number, write in rows:
        few = number // 10 if is_small else number
        runs = [draw(rhw, write(few)) for _ in range(1 if is_small else RUNS)]
        one = sum(run[0] for run in runs) / len(runs)
        many = write(TIMES * few)
        time, memory = draw(rhw, many)
        for _ in range(AGAIN if not is_small and time / TIMES / one > MOST else 0):
            time = min(time, draw(rhw, many)[0])
        share = time / TIMES / one
        each = (memory - runs[0][1]) / (TIMES - 1) / few
        print(f"{name}: of {TIMES} times as many one takes {share:.2f} of the time, and {each:.0f} bytes")
        wrong += not is_small and (share > MOST or each > BYTES)
    return wrong


if __name__ == "__main__":
    sys.exit(main())
