# SPDX-License-Identifier: MIT
"""python -m rhw.dataset: what the files hold, and that the manifest says how to read them."""

import hashlib
import io
import json
import math
import shutil

import numpy as np
import pytest

import rhw
from conftest import model_file
from dataset_runs import files, manifest, read_png, run
from rhw.dataset import npz
from rhw.dataset.cameras import Sphere
from test_environment import radiance, sky

SIZE = "64x48"
COLUMNS, ROWS = np.meshgrid(np.arange(64), np.arange(48))


@pytest.fixture(scope="module")
def made(tmp_path_factory, boxes):
    """A data set of everything in NPZ, and one of the same in other formats."""
    folder = tmp_path_factory.mktemp("made")
    outputs = "color,linear,display,depth,distance,normal,position,uv,object,triangle,barycentric"
    run(boxes, "--views", 5, "--size", SIZE, "--outputs", ",".join(f"{each}:npz" for each in outputs.split(",")),
        "--out", folder / "numbers")
    run(boxes, "--views", 5, "--size", SIZE, "--outputs", "color,distance,uv,normal:png,object:png,triangle:png",
        "--out", folder / "files")
    return folder


def views(folder):
    """Each view of a data set's only model, with the arrays of its NPZ."""
    model, = manifest(folder)["models"]
    return [(view, np.load(folder / f"{model['name']}/{view['name']}.npz")) for view in model["views"]]


def test_cameras_of_the_manifest(made):
    """What a pixel shows is drawn there, as OpenCV has it, at its distance; both conventions mean the same camera."""
    seen = 0
    for view, arrays in views(made / "numbers"):
        there = arrays["object"] > 0
        extrinsic, pose = np.array(view["world_to_camera"]), np.array(view["camera_to_world"])
        assert np.allclose(pose @ np.diag([1, -1, -1, 1]) @ extrinsic, np.eye(4))
        x, y, z = extrinsic[:3] @ arrays["position"][there].T.astype(float)  # whose fourth number is 1
        # To the 256th of a pixel that corners are rounded to.
        assert np.abs(view["fx"] * x / z + view["cx"] - COLUMNS[there]).max() < 0.01
        assert np.abs(view["fy"] * y / z + view["cy"] - ROWS[there]).max() < 0.01
        assert np.allclose(z, arrays["distance"][there], rtol=1e-3)
        assert np.isinf(arrays["distance"][~there]).all()
        assert view["near"] <= z.min() and z.max() <= view["far"]
        seen += there.sum()
    assert seen > 1000


def test_ids_of_the_manifest(made):
    model, = manifest(made / "numbers")["models"]
    assert model["objects"] == [None, "box0", "box1"]
    assert [(node["name"], node["material"], node["triangles"]) for node in model["nodes"]] == [("box0", "m0", 12), ("box1", "m1", 12)]
    seen = set()
    for _, arrays in views(made / "numbers"):
        for node in model["nodes"]:
            own = (arrays["triangle"] >= node["first_triangle"]) & (arrays["triangle"] < node["first_triangle"] + node["triangles"])
            assert np.array_equal(own, arrays["object"] == node["object"])
            seen |= {node["name"]} if own.any() else set()
    assert seen == {"box0", "box1"}


def test_formats_agree(made):
    """PNGs have the numbers of the arrays; an EXR is the one of Pictures.exr."""
    model = rhw.load(manifest(made / "files")["models"][0]["path"])
    for view, arrays in views(made / "numbers"):
        picture = f"{made}/files/boxes/{view['name']}"
        assert np.array_equal(read_png(picture + ".png"), arrays["color"][:, :, :3])
        for output in ("object", "triangle"):
            numbers = read_png(f"{picture}.{output}.png")
            assert numbers.dtype.itemsize == 2 and np.array_equal(numbers[:, :, 0], arrays[output])
        scaled = (arrays["normal"][:, :, :3] * 0.5 + 0.5) * 65535 * arrays["normal"][:, :, 3:]
        assert np.abs(read_png(picture + ".normal.png")[:, :, :3] - scaled).max() <= 1
    # The camera of the manifest, given back, is the same to a rounding; what is drawn with the plan's own are the same bytes.
    sphere = Sphere(**manifest(made / "files")["cameras"]["sphere"])
    drawn = model.render((64, 48), sphere.shot(4, model, "boxes", (64, 48)).camera(), outputs=("distance", "uv"))
    assert drawn.exr() == (made / "files/boxes/0004.exr").read_bytes()


def test_what_lies_where(made):
    names = sorted(path.name for path in (made / "files/boxes").iterdir())
    assert names == sorted([f"{view:04}{end}" for view in range(5) for end in (
        ".png", ".exr", ".normal.png", ".object.png", ".triangle.png")] + ["transforms.json"])
    about = manifest(made / "files")
    assert about["outputs"]["distance"]["format"] == "exr" and about["size"] == [64, 48]
    assert about["models"][0]["views"][2]["files"]["object"] == "boxes/0002.object.png"
    hashes = files(made / "files")
    for view in about["models"][0]["views"]:
        assert {name: hashes[name] for name in view["sha256"]} == view["sha256"] and len(view["sha256"]) == 5
    assert not {"time", "host", "threads"} & set(json.dumps(about).replace('"', " ").split())


def test_a_sphere_is_even(boxes):
    """Nearest neighbours of 200 cameras are about as far apart as cells of equal area are wide."""
    model, sphere = rhw.load(boxes), Sphere(200)
    middle = model.bounds.astype(float).mean(axis=0)
    eyes = np.array([sphere.shot(view, model, "boxes", (64, 48)).eye for view in range(200)]) - middle
    radius = np.linalg.norm(eyes, axis=1)
    assert np.allclose(radius, radius[0], rtol=1e-12)
    apart = np.sort(np.linalg.norm(eyes[:, None] - eyes[None], axis=2) / radius[0], axis=1)[:, 1]
    assert 0.7 < apart.min() / math.sqrt(4 * math.pi / 200) and apart.max() / math.sqrt(4 * math.pi / 200) < 1.2


@pytest.mark.parametrize("up, axis, sign", [("y", 1, 1), ("z", 2, 1), ("-x", 0, -1)])
def test_what_is_up(boxes, up, axis, sign):
    model, sphere = rhw.load(boxes), Sphere(40, elevation=(20, 50), up=up)
    for view in range(40):
        shot = sphere.shot(view, model, "boxes", (64, 48))
        elevation = math.degrees(math.asin(sign * shot.back[axis]))
        assert 20 <= elevation <= 50 and sign * shot.up[axis] > 0.6
        assert np.isclose(np.linalg.det([shot.right, shot.up, shot.back]), 1)
    top = Sphere(1, elevation=(90, 90), up=up).shot(0, model, "boxes", (64, 48))
    assert top.back[axis] == sign and np.isclose(np.linalg.norm(top.up), 1)


def test_all_of_the_model_is_in_the_picture(boxes):
    model = rhw.load(boxes)
    for size in ((64, 48), (30, 80)):
        for view in range(20):
            drawn = model.render(size, Sphere(20).shot(view, model, "boxes", size).camera(), outputs="object")["object"]
            assert not (drawn[0].any() or drawn[-1].any() or drawn[:, 0].any() or drawn[:, -1].any()) and drawn.any()


def test_chance_depends_on_the_seed_alone(boxes):
    model = rhw.load(boxes)
    eyes = {}
    for seed in (1, 2):
        sphere = Sphere(30, radius=(2, 3), distance=True, jitter=1, seed=seed)
        eyes[seed] = [sphere.shot(view, model, "boxes", (64, 48)).eye for view in range(30)]
        assert eyes[seed][7] == sphere.shot(7, model, "boxes", (64, 48)).eye
        radius = np.linalg.norm(np.array(eyes[seed]) - model.bounds.astype(float).mean(axis=0), axis=1)
        assert 2 <= radius.min() < 2.2 and 2.8 < radius.max() <= 3
    assert eyes[1] != eyes[2]
    assert eyes[1][7] != Sphere(30, radius=(2, 3), distance=True, jitter=1, seed=1).shot(7, model, "other", (64, 48)).eye


def test_numbers_of_every_machine(boxes):
    """These digits, on whatever C library, compiler or processor this runs."""
    shot = Sphere(9, elevation=(-10, 75), jitter=0.5, seed=3).shot(5, rhw.load(boxes), "boxes", (64, 48))
    assert shot.eye == (-0.7863488254169795, 3.2502232977876786, 4.213086209057295)
    assert shot.right == (0.8667726856461007, 0.0, 0.4987034303249237)
    assert shot.fx == 65.93945806691094


def test_cameras_of_a_file(made, boxes, tmp_path):
    """The transforms.json of a data set gives the same pictures, in another size larger ones."""
    given = made / "numbers/boxes/transforms.json"
    run(boxes, "--cameras", given, "--outputs", "object:npz", "--out", tmp_path / "again")
    about, before = manifest(tmp_path / "again"), manifest(made / "numbers")
    assert about["size"] == [64, 48] and about["cameras"] == {"given": 5}
    for view, other in zip(about["models"][0]["views"], before["models"][0]["views"]):
        for key in ("fx", "fy", "cx", "cy", "world_to_camera", "camera_to_world"):
            assert np.allclose(view[key], other[key], rtol=1e-12, atol=1e-12), key
    for (_, arrays), (_, older) in zip(views(tmp_path / "again"), views(made / "numbers")):
        assert np.array_equal(arrays["object"], older["object"])
    run(boxes, "--cameras", given, "--outputs", "object:npz", "--size", "128x96", "--out", tmp_path / "large")
    for (_, arrays), (_, older) in zip(views(tmp_path / "large"), views(made / "numbers")):
        half = arrays["object"].reshape(48, 2, 64, 2)[:, 0, :, 0]
        assert (half != older["object"]).mean() < 0.03


def test_lenses_of_a_file(boxes, tmp_path):
    """An angle, as NeRF's own files have it, or a lens of each frame, off the middle and with oblong pixels."""
    pose = [[1, 0, 0, 1.3], [0, 1, 0, 0.6], [0, 0, 1, 6], [0, 0, 0, 1]]
    (tmp_path / "angle.json").write_text(json.dumps({"camera_angle_x": math.pi / 2, "frames": [
        {"file_path": "./train/r_0", "transform_matrix": pose},
        {"transform_matrix": pose[:3], "fl_x": 100, "fl_y": 90, "cx": 30, "cy": 25, "w": 128, "h": 96}]}))
    run(boxes, "--cameras", tmp_path / "angle.json", "--size", SIZE, "--out", tmp_path / "out")
    first, second = manifest(tmp_path / "out")["models"][0]["views"]
    assert np.allclose([first[key] for key in ("fx", "fy", "cx", "cy")], [32, 32, 31.5, 23.5])
    assert np.allclose([second[key] for key in ("fx", "fy", "cx", "cy")], [50, 45, 14.5, 12])
    assert first["camera_to_world"] == pose
    about = json.loads((tmp_path / "out/boxes/transforms.json").read_text())
    assert "fl_x" not in about and about["frames"][1]["fl_x"] == 50 and about["frames"][1]["file_path"] == "0001.png"


def test_npz(tmp_path):
    """numpy.load reads it; the bytes are these, with any NumPy, at any time."""
    arrays = {"a": np.arange(6, dtype=np.uint32).reshape(2, 3), "b": np.float32([[1.5], [-2]]), "c": np.zeros((1, 2, 4), np.uint8)}
    data = npz.encode(arrays)
    found = np.load(io.BytesIO(data))
    assert list(found) == ["a", "b", "c"]
    for name, array in arrays.items():
        assert np.array_equal(found[name], array) and found[name].dtype == array.dtype
    assert hashlib.sha256(data).hexdigest() == "bc44af5900fd8002cd86321b1634e643adfa95704de82ec43c5a5a53b46c0b7c"


def test_names_of_models(boxes, tmp_path):
    """The file's name; with as much of the folders as tells models apart."""
    paths = []
    for name in ("a/model/x.obj", "b/model/x.obj", "c/y.obj"):
        (tmp_path / name).parent.mkdir(parents=True, exist_ok=True)
        paths.append(shutil.copy(boxes, tmp_path / name))
    run(*paths, "--views", 1, "--size", 8, "--out", tmp_path / "out", "-q")
    assert [model["name"] for model in manifest(tmp_path / "out")["models"]] == ["a-model-x", "b-model-x", "y"]
    (tmp_path / "list.txt").write_text("\n".join(map(str, reversed(paths))))
    run("@" + str(tmp_path / "list.txt"), "--views", 1, "--size", 8, "--out", tmp_path / "again", "-q")
    assert files(tmp_path / "out/y") == files(tmp_path / "again/y")
    assert [model["name"] for model in manifest(tmp_path / "again")["models"]] == ["a-model-x", "b-model-x", "y"]


def test_options_reach_the_picture(boxes, tmp_path):
    """Each of them changes the picture as the same argument of Model.render does."""
    run(boxes, "--views", 1, "--size", 40, "--out", tmp_path / "out", "--samples", 1, "--supersample", 4, "--background",
        "transparent", "--lights", "none", "--shadows", "off", "--ground", "--ambient-occlusion", "off", "--tone-map", "agx",
        "--exposure", "-1.5", "--transparency", "exact", "--up", "z", "--center", "-1,0,0.5", "--fovy", 60, "--radius", 2)
    model = rhw.load(boxes)
    sphere = Sphere(1, up="z", center=(-1, 0, 0.5), fovy=60, radius=(2, 2))
    drawn = model.render(40, sphere.shot(0, model, "boxes", (40, 40)).camera(), samples=1, supersample=4, background="transparent",
                         lights="none", shadows=False, ground=True, ambient_occlusion=False, tone="agx", exposure=-1.5,
                         transparency="exact", up="z")
    assert drawn.png() == (tmp_path / "out/boxes/0000.png").read_bytes()


def test_light_of_a_panorama(boxes, tmp_path):
    """As Model.render draws it; the manifest has the file's hash. Where it lies when a run goes on is no matter."""
    light = tmp_path / "sky.hdr"
    light.write_bytes(radiance(sky()))
    asked = (boxes, "--views", 3, "--size", 40, "--environment-rotation", "-30", "--background", "environment")
    run(*asked, "--environment", light, "--out", tmp_path / "out", "--shard", "1/3")
    shutil.move(light, tmp_path / "moved.hdr")
    run(*asked, "--environment", tmp_path / "moved.hdr", "--out", tmp_path / "out")
    shot = Sphere(3).shot(1, rhw.load(boxes), "boxes", (40, 40))
    drawn = rhw.load(boxes).render(40, shot.camera(), environment=sky(), environment_rotation=-30, background="environment")
    assert drawn.png() == (tmp_path / "out/boxes/0001.png").read_bytes()
    sha256 = hashlib.sha256((tmp_path / "moved.hdr").read_bytes()).hexdigest()
    assert manifest(tmp_path / "out")["environment"] == {"path": str(light), "sha256": sha256, "rotation": -30}
    run("--verify", tmp_path / "out")


def test_a_textured_model(tmp_path):
    path = model_file("glTF2/BoxTextured-glTF-Binary/BoxTextured.glb")
    run(path, "--views", 2, "--size", 40, "--max-texture", 16, "--out", tmp_path / "small")
    run(path, "--views", 2, "--size", 40, "--out", tmp_path / "large")
    small, large = manifest(tmp_path / "small")["models"][0], manifest(tmp_path / "large")["models"][0]
    assert small["sha256"] == large["sha256"] and small["content"] != large["content"]
    assert (large["unit"], large["format"], large["up"]) == ("metre", "glTF 2.0", "y")
