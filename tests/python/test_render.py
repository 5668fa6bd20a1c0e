# SPDX-License-Identifier: MIT
"""Pictures of models: the bytes of `rhw render`, in the shapes that are promised."""

import base64
import json
import math
import threading

import numpy as np
import pytest

import rhw
from conftest import model_file

ALL = ("linear", "depth", "distance", "normal", "position", "uv", "object", "triangle", "barycentric")


@pytest.mark.parametrize("row", rhw.pictures.TABLE.values(), ids=lambda row: row.name)
def test_documented_as_in_the_table(row):
    shape = "(H, W, 4)" if row.channels == 4 else "(H, W)"
    told = next(line.split() for line in rhw.Pictures.__doc__.splitlines() if line.split()[:1] == [row.name])
    assert " ".join(told).startswith(f"{row.name} {shape} {np.dtype(row.type).name} ")
    assert f"'{row.name}'" in rhw.Model.render.__doc__


@pytest.mark.parametrize("options, keywords", [
    ((), {}),
    (("--samples", "1", "--tone-map", "agx", "--exposure", "0.5"), {"samples": 1, "tone": "agx", "exposure": 0.5}),
    (("--orbit", "215,22", "--margin", "12", "--ground", "--background", "#10a020"),
     {"camera": rhw.Camera.orbit(215, 22, margin=12), "ground": True, "background": (0x10, 0xa0, 0x20)}),
    (("--camera", "4,3,5,1,0,0,0,1,0,33", "--background", "transparent", "--wireframe"),
     {"camera": rhw.Camera.look_at((4, 3, 5), (1, 0, 0), fovy=33), "background": "transparent", "wireframe": "over"}),
    (("--fit", "--ortho", "--zoom", "0.7", "--lights", "none", "--shadows", "off", "--ambient-occlusion", "off"),
     {"camera": rhw.Camera.fit(orthographic=True, zoom=0.7), "lights": "none", "shadows": False,
      "ambient_occlusion": False}),
    (("--fit", "--fovy", "50.3", "--up", "z", "--supersample", "4", "--interpolate", "noperspective"),
     {"camera": rhw.Camera.fit(fovy=50.3, up="z"), "up": "z", "supersample": 4, "interpolate": "noperspective"}),
])
def test_bytes_of_the_program(box_obj, program, options, keywords):
    pictures = rhw.load(box_obj).render((161, 120), **keywords)
    assert pictures.png() == program(box_obj, "x.png", "--size", "161x120", *options)


def test_bytes_of_every_output(box_obj, program, context, tmp_path):
    pictures = rhw.load(box_obj).render((161, 120), outputs=("color", "display") + ALL, context=context)
    pictures.save(tmp_path / "x.exr")
    assert (tmp_path / "x.exr").read_bytes() == program(box_obj, "x.exr", "--size", "161x120", "--output", "all")
    for name in ("color",) + ALL[1:]:
        option = "bary" if name == "barycentric" else name
        assert pictures.png(name) == program(box_obj, f"{name}.png", "--size", "161x120", "--output", option), name
    assert pictures.png(bits=16) == program(box_obj, "fine.png", "--size", "161x120", "--bits", "16")


def test_camera_and_textures_of_a_file(program):
    path = model_file("glTF2/BoxTextured-glTF-Binary/BoxTextured.glb")
    assert rhw.load(path).render(120).png() == program(path, "x.png", "--size", "120")
    path = model_file("glTF2/cameras/Cameras.gltf")
    model = rhw.load(path)
    assert model.render((120, 70)).png() == program(path, "y.png", "--size", "120x70")
    second = model.render((120, 70), rhw.Camera.of_model(1))
    assert second.png() == program(path, "z.png", "--size", "120x70", "--camera-index", "1")


def test_what_is_seen_is_framed(program, tmp_path):
    """A camera in which the model is a dot, and a speck far away: warnings, and the picture that is fitted."""
    vertices = np.array([[0, 0, 0], [1, 0, 0], [0, 1, 0]], np.float32)
    scene = {"asset": {"version": "2.0"}, "scene": 0, "scenes": [{"nodes": [0, 1, 2]}],
             "nodes": [{"mesh": 0}, {"mesh": 0, "translation": [900, 0, 0], "scale": [.01, .01, .01]},
                       {"camera": 0, "translation": [0, 0, 90]}],
             "cameras": [{"type": "perspective", "perspective": {"yfov": 0.5, "znear": 0.1}}],
             "meshes": [{"primitives": [{"attributes": {"POSITION": 0}}]}],
             "accessors": [{"bufferView": 0, "componentType": 5126, "count": 3, "type": "VEC3", "min": [0, 0, 0],
                            "max": [1, 1, 0]}], "bufferViews": [{"buffer": 0, "byteLength": 36}],
             "buffers": [{"byteLength": 36, "uri": "data:application/octet-stream;base64,"
                                                   + base64.b64encode(vertices).decode()}]}
    path = tmp_path / "dot.gltf"
    path.write_text(json.dumps(scene))
    model = rhw.load(path)
    assert any("specks far away" in each for each in model.warnings)
    assert model.bounds[1][0] > 900 and model.frame.tolist() == [[0, 0, 0], [1, 1, 0]]
    with pytest.warns(UserWarning, match="sees next to nothing of the model"):
        pictures = model.render(64, outputs=("color", "object"))
    assert pictures.png() == program(path, "x.png", "--size", "64") == program(path, "y.png", "--size", "64", "--fit")
    assert (pictures["object"] == 1).mean() > 0.3
    with pytest.warns(UserWarning, match="next to nothing of the model is in the picture"):
        model.render(64, rhw.Camera.look_at((0, 0, 90), (0, 0, 0)))


def test_shapes(box_obj):
    pictures = rhw.load(box_obj).render((30, 20), outputs=("color", "display") + ALL)
    for name, array in pictures.items():
        wanted = (20, 30) if name in ("depth", "distance", "object", "triangle") else (20, 30, 4)
        kind = np.uint8 if name == "color" else np.uint32 if name in ("object", "triangle") else np.float32
        assert array.shape == wanted and array.dtype == kind and array.flags.c_contiguous, name
    nothing = pictures["object"] == 0
    assert nothing.any() and not nothing.all()
    assert (pictures["depth"][nothing] == 1).all() and np.isinf(pictures["distance"][nothing]).all()
    assert (pictures["normal"][nothing] == 0).all() and (pictures["normal"][~nothing][:, 3] == 1).all()


def test_pictures_outlive_what_they_came_from(box_obj):
    depth = rhw.load(box_obj).render(50, outputs="depth")["depth"]
    again = rhw.load(box_obj).render(50, outputs="depth")["depth"]
    assert np.array_equal(depth, again)


def test_model_arrays(box_obj):
    model = rhw.load(box_obj)
    assert [mesh.faces.shape for mesh in model.meshes] == [(12, 3), (12, 3)]
    assert model.meshes[0].vertices.dtype == np.float32 and not model.meshes[0].vertices.flags.writeable
    assert np.allclose(model.bounds, [[0, 0, 0], [2.7, 1.34, 1]])
    assert [node.object for node in model.nodes] == [1, 2] and model.nodes[1].name == "box1"
    assert np.array_equal(model.nodes[0].world, np.eye(4))
    vertices = model.meshes[1].vertices
    del model
    assert np.isfinite(vertices).all()  # the view keeps the memory


def test_opencv_camera_puts_points_where_opencv_does(square):
    """Which triangles and depths a lens off the middle with oblong pixels shows, against the formula, pixel by pixel."""
    vertices, faces = square
    fx, fy, cx, cy, far_off = 90.0, 70.0, 31.25, 24.75, 3.0
    extrinsic = np.array([[1, 0, 0, -0.3], [0, -1, 0, 0.4], [0, 0, -1, far_off]])
    camera = rhw.Camera.intrinsics(fx, fy, cx, cy, extrinsic)
    pictures = rhw.Model(vertices, faces).render((64, 48), camera, outputs=("object", "distance", "position"))
    columns, rows = np.meshgrid(np.arange(64), np.arange(48))
    x = (columns - cx) / fx * far_off + 0.3
    y = 0.4 - (rows - cy) / fy * far_off
    inside = (x > 0) & (x < 1) & (y > 0) & (y < 1)
    assert 300 < inside.sum() < 1500
    assert np.array_equal(pictures["object"] == 1, inside)
    assert np.allclose(pictures["distance"][inside], far_off, rtol=1e-6)
    assert np.allclose(pictures["position"][inside][:, 0], x[inside], atol=1e-4)
    assert np.allclose(pictures["position"][inside][:, 1], y[inside], atol=1e-4)


def test_a_part_of_a_larger_picture():
    """A principal point moved by whole pixels: the same colours, ambient occlusion and shadows among them."""
    model = rhw.load(model_file("glTF2/2CylinderEngine-glTF-Binary/2CylinderEngine.glb"))
    least, most = model.bounds.astype(float)
    extrinsic = np.diag([1.0, -1, -1, 1])
    extrinsic[:3, 3] = -extrinsic[:3, :3] @ (least + most) / 2 + [0, 0, np.linalg.norm(most - least)]

    def colors(size, cx, cy):
        return model.render(size, rhw.Camera.intrinsics(170, 160, cx, cy, extrinsic), background=(0, 0, 0))["color"]

    whole, part = colors((192, 144), 95.5, 71.5), colors((96, 72), 31.5, 23.5)
    assert np.abs(whole[48:120, 64:160].astype(int) - part).mean() < 0.7  # occlusion is sampled by a pattern


def test_pose_and_look_at_agree(box_obj):
    model = rhw.load(box_obj)
    looking = rhw.Camera.look_at((4, 3, 5), (1, 0, 0), fovy=33)
    pose = np.linalg.inv(looking.at(model, 64).view)
    a = model.render(64, looking, outputs=("object", "distance"))
    b = model.render(64, rhw.Camera.from_matrix(pose, 33), outputs=("object", "distance"))
    assert np.array_equal(a["object"], b["object"])
    seen = a["object"] > 0
    assert seen.any() and np.allclose(a["distance"][seen], b["distance"][seen], rtol=1e-5)


def test_planes_cut(square):
    model = rhw.Model(*square)
    pose = np.eye(4)
    pose[:3, 3] = 0.5, 0.5, 2
    assert model.render(20, rhw.Camera.from_matrix(pose), outputs="object")["object"].any()
    with pytest.warns(UserWarning, match="nothing of the model"):
        behind = model.render(20, rhw.Camera.from_matrix(pose, near=0.1, far=1.9), outputs="object")
    assert not behind["object"].any()


def test_matrices_tell_where_things_are_drawn(box_obj):
    model = rhw.load(box_obj)
    pictures = model.render((64, 48), outputs=("position", "depth", "object"))
    row, column = np.argwhere(pictures["object"])[7]
    clip = pictures.view.matrix @ pictures["position"][row, column]
    ndc = clip[:3] / clip[3]
    assert math.isclose((ndc[0] + 1) * 32, column + 0.5, abs_tol=1e-3)
    assert math.isclose((1 - ndc[1]) * 24, row + 0.5, abs_tol=1e-3)
    assert math.isclose(ndc[2], pictures["depth"][row, column], abs_tol=1e-5)


def test_threads_draw_the_same_model_at_once(box_obj):
    model = rhw.load(box_obj)
    wanted = model.render(90).png()
    found = [None] * 6
    shared = rhw.Context(threads=2)

    def draw(i):
        for _ in range(3):
            found[i] = model.render(90, context=shared if i % 2 else None).png()

    threads = [threading.Thread(target=draw, args=(i,)) for i in range(len(found))]
    for thread in threads:
        thread.start()
    for thread in threads:
        thread.join()
    assert found == [wanted] * len(found)


def test_a_notebook_shows_it(box_obj):
    model = rhw.load(box_obj)
    assert model._repr_png_().startswith(b"\x89PNG")
    assert model.render(20, outputs="depth")._repr_png_().startswith(b"\x89PNG")
    light = model.render((20, 10), outputs=("linear", "display"))
    assert light._repr_png_() is None and repr(light) == "<rhw.Pictures 20 x 10: linear, display>"


def test_large_textures(box_obj, program):
    """The program halves images that its picture cannot use; rhw.load, which knows no picture, does so when it is told."""
    folder = box_obj.parent
    noise = np.random.default_rng(3).integers(0, 256, (2048, 2048, 3), np.uint8)
    rhw.write_png(folder / "noise.png", noise)
    (folder / "boxes.mtl").write_text("newmtl m0\nmap_Kd noise.png\n")
    (folder / "plate.obj").write_text("mtllib boxes.mtl\nusemtl m0\nv 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\n"
                                      "vt 0 0\nvt 1 0\nvt 1 1\nvt 0 1\nf 1/1 2/2 3/3 4/4\n")
    path = folder / "plate.obj"
    small, full = rhw.load(path, max_texture=1024), rhw.load(path)
    assert small.images[0].texels.shape == (1024, 1024, 4) and full.images[0].texels.shape == (2048, 2048, 4)
    assert np.array_equal(full.images[0].texels[..., :3], noise)
    assert small.render(64).png() == program(path, "small.png", "--size", "64")
    assert full.render(64).png() == program(path, "full.png", "--size", "64", "--max-texture", "16384")
