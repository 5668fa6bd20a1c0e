#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""How long a picture of a model takes from Python, with depth and ids, beside pyrender on Mesa's CPU driver.

usage: bench/python_speed.py [MODEL] [--threads N] [--rounds N] [--picture FILE.png], with rhw installed or
       PYTHONPATH=BUILD/python
  MODEL         default: the Stanford bunny of Debian's package glmark2-data
  --threads N   of both; default: one for each core
  --rounds N    rounds, in which all take turns, each with a camera further round the model; default 30
  --picture     writes both pictures of one camera side by side

Pictures have 640 by 480 pixels of 4 samples. Both draw from the same arrays with the same camera, and where they see the
model is compared, as are distances. pyrender is used where Python has it, with PyOpenGL; PYOPENGL_PLATFORM says how, by
default osmesa. Its ids are those of nodes, from a second pass without samples; it has no numbers of triangles.
"""

import argparse
import os
import statistics
import sys
import time

import numpy as np

import rhw

BUNNY = "/usr/share/glmark2/models/bunny.obj"
SIZE = (640, 480)
IDS = ("color", "depth", "triangle", "object")
PLAIN = {"shadows": False, "ambient_occlusion": False}


def milliseconds(function, *arguments):
    """Of the clock, and of all processors together: what a busy machine changes less."""
    start = time.perf_counter(), time.process_time()
    function(*arguments)
    return (time.perf_counter() - start[0]) * 1e3, (time.process_time() - start[1]) * 1e3


class Pyrender:
    """The model in pyrender's scene. ImportError where that or what it needs is missing."""

    def __init__(self, model, threads):
        os.environ.setdefault("PYOPENGL_PLATFORM", "osmesa")
        os.environ.setdefault("LP_NUM_THREADS", str(threads if threads > 1 else 0))
        import pyrender

        self._module = pyrender
        self._scene = pyrender.Scene(ambient_light=(0.3, 0.3, 0.3), bg_color=(0.4, 0.44, 0.49, 1))
        material = pyrender.MetallicRoughnessMaterial(baseColorFactor=(0.8, 0.8, 0.8, 1), metallicFactor=0,
                                                      roughnessFactor=0.6, doubleSided=True)
        self._ids = {}
        for node in model.nodes:
            mesh = model.meshes[node.mesh]
            part = pyrender.Primitive(positions=mesh.vertices, normals=mesh.normals, indices=mesh.faces, mode=4,
                                      material=material)
            self._ids[self._scene.add(pyrender.Mesh([part]), pose=node.world)] = (node.object, 0, 0)
        self._renderer = pyrender.OffscreenRenderer(*SIZE)
        self._camera = self._light = None

    def look(self, view):
        """Takes the camera of one of rhw's pictures."""
        if self._camera is not None:
            self._scene.remove_node(self._camera)
            self._scene.remove_node(self._light)
        matrix = view.projection.copy()
        matrix[2] = 2 * matrix[2] - matrix[3]  # depth from -1 to 1

        class Same(self._module.Camera):
            def get_projection_matrix(self, width=None, height=None):
                return matrix

        pose = np.linalg.inv(view.view)
        self._camera = self._scene.add(Same(znear=view.near, zfar=view.far), pose=pose)
        self._light = self._scene.add(self._module.DirectionalLight(intensity=2), pose=pose)

    def color_and_depth(self, view):
        self.look(view)
        return self._renderer.render(self._scene)

    def all(self, view):
        color, depth = self.color_and_depth(view)
        flags = self._module.RenderFlags.SEG
        return color, depth, self._renderer.render(self._scene, flags=flags, seg_node_map=self._ids)[0][..., 0]

    def driver(self):
        from OpenGL import GL

        return GL.glGetString(GL.GL_RENDERER).decode()


def compare(model, view, context, peer):
    """Both pictures, which must see the same: percent of pixels, and how far distances are apart, of the nearest."""
    mine = model.render(SIZE, view, outputs=("color", "distance", "object"), context=context)
    color, distance, ids = peer.all(mine.view)
    same = (mine["object"] == ids) & ((mine["object"] > 0) == (distance > 0))
    both = (mine["object"] > 0) & (distance > 0)
    apart = np.abs(mine["distance"] - distance)[both] / mine["distance"][both].min()
    return np.hstack([mine["color"][..., :3], color]), 100 * same.mean(), np.median(apart)


def main():
    parser = argparse.ArgumentParser(usage="%(prog)s [MODEL] [--threads N] [--rounds N] [--picture FILE.png]")
    parser.add_argument("model", nargs="?", default=BUNNY)
    parser.add_argument("--threads", type=int, default=0)
    parser.add_argument("--rounds", type=int, default=30)
    parser.add_argument("--picture")
    options = parser.parse_args()
    context = rhw.Context(threads=options.threads)
    model = rhw.load(options.model)

    def draw(**keywords):
        return lambda camera: model.render(SIZE, camera, context=context, **keywords)

    rows = {"rhw, default look, color, depth, triangle, object": draw(outputs=IDS),
            "rhw, no shadows nor occlusion, the same": draw(outputs=IDS, **PLAIN),
            "rhw, the same, 1 sample": draw(outputs=IDS, samples=1, **PLAIN),
            "rhw, no shadows nor occlusion, color, depth": draw(outputs=IDS[:2], **PLAIN),
            "rhw, depth, triangle, object": draw(outputs=IDS[1:])}
    try:
        peer = Pyrender(model, context.threads)
        rows["pyrender, color, depth, ids of nodes"] = lambda camera: peer.all(camera.at(model, SIZE))
        rows["pyrender, color, depth"] = lambda camera: peer.color_and_depth(camera.at(model, SIZE))
    except ImportError as error:
        peer = None
        print(f"pyrender is left out: {error}")
    cameras = [rhw.Camera.orbit(360 * n / options.rounds, 20) for n in range(options.rounds)]
    for function in rows.values():
        function(cameras[0])  # shaders are compiled, and memory is got
    times = {name: [] for name in rows}
    for camera in cameras:
        for name, function in rows.items():
            times[name].append(milliseconds(function, camera))
    triangles = sum(len(model.meshes[node.mesh].faces) for node in model.nodes)
    print(f"{os.path.basename(options.model)}, {triangles} triangles, {SIZE[0]} x {SIZE[1]}, {context.threads} threads, "
          f"{options.rounds} cameras in turn")
    print(f"{'':50} {'median ms':>9} {'least':>7} {'processor ms, median':>21} {'least':>7}")
    for name, taken in times.items():
        clock, processor = zip(*taken)
        print(f"{name:50} {statistics.median(clock):9.1f} {min(clock):7.1f} {statistics.median(processor):21.1f} {min(processor):7.1f}")
    if peer:
        pictures, same, apart = compare(model, cameras[0], context, peer)
        print(f"pyrender on {peer.driver()}: {same:.2f} % of the pixels have the same id; distances are {apart:.1e} of the "
              "nearest apart")
        if options.picture:
            rhw.write_png(options.picture, np.ascontiguousarray(pictures))
        if same < 99:
            sys.exit("python_speed: more than 1 % of the pixels show something else")


main()
