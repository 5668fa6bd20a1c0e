# SPDX-License-Identifier: MIT
"""A model drawn again and again: what is kept from draw to draw shows in no picture, and is not made anew."""

import gc
import os
import subprocess
import sys
import threading

import numpy as np
import pytest

import rhw
from conftest import SANITIZED

OUTPUTS = ("color", "depth", "triangle", "object")

#: Draws that have nothing in common with those beside them.
VARIED = [
    dict(size=(300, 200)),
    dict(size=(301, 199), ground=True),
    dict(size=64, shadows=False),
    dict(size=(300, 200), camera=rhw.Camera.orbit(200, 10), ambient_occlusion=False),
    dict(size=(300, 200), samples=1, background="transparent", outputs=("color", "linear", "normal")),
    dict(size=(20, 500), supersample=4, wireframe="over"),
    dict(size=(300, 200), lights="none", outputs=("depth",)),
]


def drawn(model, keywords, **more):
    pictures = model.render(**{"outputs": OUTPUTS, **keywords, **more})
    return {name: array.tobytes() for name, array in pictures.items()}


@pytest.fixture
def first_draws(box_obj):
    """What a model that was not drawn before shows of each."""
    return [drawn(rhw.load(box_obj), keywords) for keywords in VARIED]


def test_draws_do_not_see_each_other(box_obj, first_draws, context):
    model = rhw.load(box_obj)
    order = np.random.default_rng(5).permutation(3 * len(VARIED)) % len(VARIED)
    for number in order:
        assert drawn(model, VARIED[number], context=context) == first_draws[number], VARIED[number]


def test_models_in_threads_do_not_see_each_other(box_obj, first_draws, square):
    models = [rhw.load(box_obj), rhw.Model(*square)]
    wanted = [first_draws, [drawn(rhw.Model(*square), keywords) for keywords in VARIED]]
    wrong = []

    def draw_all(number):
        for _ in range(2):
            for keywords, first in zip(VARIED, wanted[number]):
                if drawn(models[number], keywords) != first:
                    wrong.append((number, keywords))

    threads = [threading.Thread(target=draw_all, args=(number,)) for number in (0, 1, 0)]
    for thread in threads:
        thread.start()
    for thread in threads:
        thread.join()
    assert not wrong


def test_pictures_outlive_their_model(box_obj):
    model = rhw.load(box_obj)
    pictures = [model.render((300, 200), rhw.Camera.orbit(angle, 20), outputs=OUTPUTS) for angle in (0, 70, 140)]
    before = [{name: array.tobytes() for name, array in each.items()} for each in pictures]
    depth = pictures.pop()["depth"]
    view = depth[::2, 1:]
    other = rhw.load(box_obj)
    del model
    gc.collect()
    for angle in range(0, 360, 30):
        other.render((300, 200), rhw.Camera.orbit(angle, 60), outputs=OUTPUTS)
    for each, bytes_of in zip(pictures, before):
        assert {name: array.tobytes() for name, array in each.items()} == bytes_of
    assert depth.tobytes() == before[-1]["depth"] and view.base is not None
    del depth
    gc.collect()
    other.render((300, 200), outputs=OUTPUTS)
    assert view.tobytes() == np.frombuffer(before[-1]["depth"], np.float32).reshape(200, 300)[::2, 1:].tobytes()


def test_nothing_is_uploaded_twice(box_obj, monkeypatch):
    made = []

    def counting(kind):
        def make(*arguments, **keywords):
            made.append(kind.__name__)
            return kind(*arguments, **keywords)
        return make

    model = rhw.load(box_obj)
    with monkeypatch.context() as patch:
        patch.setattr(rhw._rhw, "Context", counting(rhw._rhw.Context))
        patch.setattr(rhw._rhw, "Scene", counting(rhw._rhw.Scene))

        def draw_all():
            for keywords in VARIED:
                model.render(**keywords)

        thread = threading.Thread(target=draw_all)  # which has no context yet
        thread.start()
        thread.join()
    assert made == ["Context", "Scene"]


COUNT_PAGES = """
import resource, sys, rhw
model, context = rhw.load(sys.argv[1]), rhw.Context(threads=1)
for _ in range(4):
    before = resource.getrusage(resource.RUSAGE_SELF).ru_minflt
    model.render(%s, outputs=("color", "linear", "depth", "object"), context=context)
    print(resource.getrusage(resource.RUSAGE_SELF).ru_minflt - before)
"""


@pytest.mark.skipif(SANITIZED, reason="a sanitizer keeps what is freed")
@pytest.mark.parametrize("keywords", [
    "(640, 480)",  # 2700
    # 3600, in two bands of which the latter has two rows
    pytest.param("(4096, 130), supersample=16, samples=1, shadows=False, ambient_occlusion=False", marks=pytest.mark.long),
])
def test_pictures_stand_on_the_memory_of_the_last(box_obj, keywords):
    pytest.importorskip("resource")
    # Of malloc each picture would be new pages then, as many as are told above.
    environment = {**os.environ, "MALLOC_MMAP_THRESHOLD_": "100000"}
    told = subprocess.run([sys.executable, "-c", COUNT_PAGES % keywords, str(box_obj)], check=True, env=environment,
                          stdout=subprocess.PIPE, universal_newlines=True)
    assert max(map(int, told.stdout.split()[2:])) < 100
