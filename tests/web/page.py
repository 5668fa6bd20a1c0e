#!/usr/bin/python3
# SPDX-License-Identifier: MIT
"""The page in headless Chromium: its pictures and numbers against the native library's, its corners, lines, keys and words.

usage: page.py PAGE-FOLDER STAGE_REPLAY SCREENSHOT-FOLDER [TEST...]     with the page as one file beside its folder, PAGE-FOLDER.html

Without a TEST, such as Page.test_speed, all are run.
"""
import os
import re
import sys
import tempfile
import time
import unittest

from selenium import webdriver
from selenium.webdriver.common.actions.action_builder import ActionBuilder
from selenium.webdriver.common.by import By
from selenium.webdriver.common.keys import Keys

from page_case import CHAPTERS, PageCase, start_server
from page_lessons import Lessons  # noqa: F401: its tests are run, too

# Of a machine that does other things too; what it took is printed.
FIRST_PICTURE = 5.0  # seconds
FRAMES = 2  # a second


class Page(PageCase):
    def test_every_chapter_is_the_native_library(self):
        for name in CHAPTERS:
            self.show(name)
            self.check_native(name)
            self.browser.save_screenshot(os.path.join(sys.argv[3], f"{name}.png"))

    def test_every_choice_is_the_native_library(self):
        for name in ["triangle", "floor", "motion", "depth"]:
            self.show(name)
            for button in self.browser.find_elements(By.CSS_SELECTOR, f"#{name} .choice button"):
                self.script(f"rhw.views.{name}.figure.dataset.drawn = ''")
                button.click()
                self.still(name)
                self.check_native(name)

    def check_exact_column(self, name):
        """The exact value lies within 8 ULP of what was written, and the naive one elsewhere."""
        rows = self.browser.find_elements(By.CSS_SELECTOR, f"#{name} .derivation tr td:last-child")
        naive, exact, wrote = (float(row.text.replace("−", "-")) for row in rows)
        self.assertLess(abs(exact - wrote), 8 * 2**-24)
        self.assertGreater(abs(naive - exact), 1e-4)
        said = self.node(f"#{name} .derivation .note").text
        self.assertLess(float(said.split("rhw is ")[1].split(" ULP")[0]), 8)

    # Threads

    def test_stages_draw_with_threads(self):
        self.wait("rhw.stage.mostThreads > 1")
        self.script("rhw.stage.settle(rhw.stage.mostThreads)")
        for name in ["pixel", "floor"]:
            self.show(name)
            self.script(f"rhw.views.{name}.figure.dataset.drawn = ''; rhw.views.{name}.update()")
            self.still(name)
            self.check_native(name)
        self.show("pixel")
        self.drag("#pixel .view .cornerA .dot", 20, -20)  # whose place comes from the new stage too
        self.still()
        self.check_native("pixel")
        self.assertGreater(self.script("return rhw.stage.threads"), 1)

    def test_threads_are_tried(self):
        """Some pictures with one thread and as many with several, all alike; then what was quicker."""
        self.wait("rhw.stage.mostThreads > 1")
        drawn = self.script("const v = rhw.views.pixel, said = [], seen = new Set();"
                            "for (let i = 0; i < 16; i++) { v.stage.resize(v.canvas.width, v.canvas.height, 4);"
                            " v.stage.camera(v.scene.camera); v.stage.clear([0, 0, 0]); v.scene.draw(v.stage, v);"
                            " said.push(v.stage.threads); let sum = 0; for (const b of v.stage.draw()) sum = (31 * sum + b) | 0;"
                            " seen.add(sum); } return [said, seen.size]")
        most = self.script("return rhw.stage.mostThreads")
        self.assertEqual(drawn[1], 1)
        self.assertEqual(set(drawn[0][:6]), {1, most})
        self.assertEqual(len(set(drawn[0][14:])), 1)
        self.assertEqual(self.script("return rhw.stage.threads"), drawn[0][-1])

    def test_without_isolation_one_thread_draws(self):
        self.open("#pixel", start_server(sys.argv[1], isolated=False))
        self.wait("window.rhw?.views.pixel?.figure.dataset.drawn === 'still'")
        self.assertFalse(self.script("return crossOriginIsolated"))
        self.assertEqual(self.script("return rhw.stage.mostThreads"), 1)
        self.check_native("pixel")
        self.open_sample()

    def test_exact_column(self):
        self.check_exact_column("pixel")

    def test_exact_column_with_a_corner_behind_the_eye(self):
        self.show("clip")
        self.check_exact_column("clip")

    def test_by_the_world(self):
        self.show("floor")
        self.assertNotIn("Back to the world", self.node("#floor .derivation").text)
        self.node("#floor button[value='world']").click()
        self.wait("rhw.views.floor.numbers.method === 2")
        told = self.node("#floor .derivation").text
        self.assertIn("Back to the world", told)
        self.assertNotIn("What is linear there", told)
        x, y, z, a, weight, u, wrote = self.script(
            "const n = rhw.views.floor.numbers; return [n.world_x, n.world_y, n.world_z, n.world_a, n.a, n.world_u, n.u]")
        self.assertAlmostEqual(y, 0, places=5)  # it lies on the floor
        self.assertAlmostEqual((x + 1) / 2, u, places=5)  # where u runs along x
        self.assertAlmostEqual(a, weight, places=5)
        self.assertAlmostEqual(u, wrote, places=5)
        shown = self.node("#floor .derivation .world").text.replace("−", "-")
        for number, word in zip((x, y, z), shown.split("(")[1].rstrip(")").split(", ")):
            self.assertAlmostEqual(number, float(word), delta=1e-3)
        written = float(self.node("#floor .derivation .written td:last-child").text)
        self.assertAlmostEqual(written, u, delta=1e-8)  # not what the pipeline made
        self.check_native("floor")

    def test_the_last_word_on_what_is_seen_counts(self):
        """An observer may hear of several changes at once: here of the opposite, and then of what is so."""
        both = ("globalThis.IntersectionObserver = class extends IntersectionObserver { constructor(callback, options) {"
                " super((list) => callback(list.flatMap((one) => [{ target: one.target, isIntersecting: !one.isIntersecting }, one])), options); } }")
        added = self.browser.execute_cdp_cmd("Page.addScriptToEvaluateOnNewDocument", {"source": both})
        try:
            self.open("#pixel")
            self.wait("window.rhw?.views.pixel?.seen && rhw.views.pixel.figure.dataset.drawn === 'still'")
        finally:
            self.browser.execute_cdp_cmd("Page.removeScriptToEvaluateOnNewDocument", added)

    # Hands

    def test_corners_are_dragged(self):
        before = self.corner(0)
        self.drag("#pixel .view .cornerA .dot", 40, -60)
        after = self.corner(0)
        self.assertGreater(after[0], before[0])
        self.assertGreater(after[1], before[1])
        self.still()
        self.check_native("pixel")
        self.drag("#pixel .top .cornerB .dot", 0, 20)
        self.assertGreater(self.corner(1)[2], -1.6)

    def test_corners_under_a_finger(self):
        self.size(390, 844, touch=True)
        try:
            self.setUp()
            before, x, scrolled = self.corner(2), self.middle("#pixel .view .cornerC .dot"), self.script("return scrollY")
            self.swipe("#pixel .view .cornerC .dot", 60)
            self.assertEqual(self.script("return scrollY"), scrolled, "the page stays")
            self.assertLess(self.corner(2)[1], before[1])
            self.assertAlmostEqual(self.middle("#pixel .view .cornerC .dot")[1], x[1] + 60, delta=3)
            self.swipe("#pixel canvas", -120, beside=-140)
            self.wait(f"scrollY > {scrolled} + 50")  # where there is nothing to drag the page scrolls
        finally:
            self.size(1440, 900)

    def test_corners_by_keys(self):
        handle = self.node("#pixel .view .cornerA")
        self.script("document.querySelector('#pixel .view .cornerA').focus()")
        before = self.corner(0)
        handle.send_keys(Keys.ARROW_RIGHT)
        self.assertGreater(self.corner(0)[0], before[0])
        handle.send_keys(Keys.PAGE_UP)
        self.assertLess(self.corner(0)[2], before[2])

    def test_line_between_is_dragged(self):
        self.drag("#pixel .divider rect", 200, 0)
        self.assertGreater(self.script("return rhw.views.pixel.scene.split"), 0.6)
        self.still()
        self.check_native("pixel")

    def test_corner_goes_behind_the_eye(self):
        self.show("clip")
        self.assertLess(self.script("return rhw.views.clip.numbers.W_2"), 0)
        self.script("rhw.views.clip.scene.corners[2].at = [0.2, -0.55, -1]; rhw.views.clip.update()")
        self.wait("rhw.views.clip.numbers.W_2 > 0")
        self.check_native("clip")

    def test_pixel_under_the_pointer(self):
        x, y = self.middle("#pixel canvas")
        actions = ActionBuilder(self.browser)
        actions.pointer_action.move_to_location(x + 100, y + 150)
        actions.perform()
        self.wait("Math.abs(rhw.views.pixel.pixel[0] - 0.6) < 0.02")
        self.check_native("pixel")

    def test_terms_are_pointed_at(self):
        node = self.node("#pixel .derivation [data-term='b']")
        webdriver.ActionChains(self.browser).move_to_element(node).perform()
        self.assertIn(str(self.script("return rhw.views.pixel.numbers.b")), self.node(".tip").text)
        self.assertGreater(len(self.browser.find_elements(By.CSS_SELECTOR, "#pixel .alike")), 1)
        self.assertNotEqual(self.script("return document.querySelector('#pixel .view .part').getAttribute('points')"), "")

    def test_languages_and_themes(self):
        self.node("#language").click()
        self.assertEqual(self.script("return document.documentElement.lang"), "zh")
        self.assertIn("像素", self.node("#pixel .derivation").text)
        self.script("scrollTo(0, 0)")
        self.assertEqual(self.node("h1:not([lang='en'])").text, "为什么要除以 w？")
        self.open("")
        self.wait("document.documentElement.lang === 'zh'")
        theme = self.script("return document.documentElement.dataset.theme")
        self.node("#theme").click()
        self.assertNotEqual(self.script("return document.documentElement.dataset.theme"), theme)

    def test_phone(self):
        self.size(360, 800, touch=True)
        try:
            self.setUp()
            for language in ["en", "zh"]:
                rows = self.script("return [...document.querySelectorAll('header :is(button, summary)')].map((node) => node.offsetHeight)")
                self.assertLess(max(rows), 40, "the header has one row")
                self.node(".contents summary").click()
                box = self.script("const b = document.querySelector('.contents ol').getBoundingClientRect(); return [b.left, b.right]")
                self.assertTrue(0 <= box[0] < box[1] <= 360, f"the chapters' names are all on the screen: {box}")
                self.node(".contents summary").click()
                for name in ["first", *CHAPTERS, "inverse"]:
                    self.show(name)
                    for button in self.browser.find_elements(By.CSS_SELECTOR, f"#{name} .choice button"):
                        self.script("arguments[0].click()", button)
                        self.assertLessEqual(self.script("return document.documentElement.scrollWidth"), 360, f"{name} fits")
                    self.assertLessEqual(self.script("return document.documentElement.scrollWidth"), 360, f"{name} fits")
                    self.browser.save_screenshot(os.path.join(sys.argv[3], f"phone_{language}_{name}.png"))
                self.script("document.querySelector('#language').click()")
            self.check_native("pixel")
        finally:
            self.size(1440, 900)

    def test_no_width_scrolls_sideways(self):
        for name in [*CHAPTERS, "inverse", "exercises"]:
            self.show(name)
        try:
            for width in (320, 360, 641, 819, 820, 1000, 1001, 1024, 1280, 1440):
                self.size(width, 800)
                for language in ("en", "zh"):
                    self.script("document.documentElement.lang === arguments[0] || document.querySelector('#language').click()", language)
                    time.sleep(0.1)
                    self.assertLessEqual(self.script("return document.documentElement.scrollWidth"), width, language)
        finally:
            self.size(1440, 900)

    def test_phone_keeps_the_picture_beside_its_derivation(self):
        """The picture and all of the derivation are on the screen at once, once one has scrolled there."""
        self.size(390, 844, touch=True)
        try:
            self.setUp()
            for language in ["en", "zh"]:
                for name in ["pixel", "floor", "clip", "triangle"]:
                    self.show(name)
                    for value in ["world", "correct"] if name == "floor" else [None]:
                        if value:
                            self.script("arguments[0].click()", self.node(f"#floor button[value='{value}']"))
                            self.wait(f"rhw.views.floor.numbers?.method === {2 if value == 'world' else 1}")
                        self.script(f"document.querySelector('#{name} .derivation').scrollIntoView({{block: 'end'}})")
                        top, bottom, first, last = self.script(
                            f"const v = document.querySelector('#{name} .view').getBoundingClientRect(),"
                            f" d = document.querySelector('#{name} .derivation').getBoundingClientRect();"
                            "return [v.top, v.bottom, d.top, d.bottom]")
                        where = f"{name} {value} {language}"
                        self.assertGreaterEqual(top, 48, f"{where}: the picture stays")
                        self.assertGreaterEqual(first, bottom - 1, f"{where}: nothing of the derivation is under it")
                        self.assertLessEqual(last, 845, where)
                        self.browser.save_screenshot(os.path.join(sys.argv[3], f"beside_{language}_{name}_{value}.png"))
                        self.script("scrollBy(0, 150)")
                        top = self.script(f"return document.querySelector('#{name} .view').getBoundingClientRect().top")
                        self.assertGreaterEqual(top, 48, f"{where}: the picture stays, further down too")
                self.script("document.querySelector('#language').click()")
        finally:
            self.size(1440, 900)

    def test_a_finger_slides_along_the_pixels(self):
        self.size(390, 844, touch=True)
        try:
            self.setUp()
            before = self.script("return rhw.views.pixel.pixel[0]")
            x, y = self.middle("#pixel canvas")
            touch = lambda kind, points: self.browser.execute_cdp_cmd(  # noqa: E731
                "Input.dispatchTouchEvent", {"type": kind, "touchPoints": points})
            touch("touchStart", [{"x": x + 90, "y": y + 60}])
            for step in range(1, 9):
                touch("touchMove", [{"x": x + 90 + 5 * step, "y": y + 60}])
            self.wait("rhw.views.pixel.pixel[0] > 0.8")
            touch("touchEnd", [])
            self.assertGreater(self.script("return rhw.views.pixel.pixel[0]"), before)
        finally:
            self.size(1440, 900)

    # One's own model

    def test_a_model_is_turned_and_explained(self):
        self.show("model")
        self.assertIn("Drop a model here", self.node("#model .view").text)
        self.open_sample()
        self.assertEqual(self.node("#model .view").text, "")
        self.assertIn("12", self.node("#model .info").text)  # triangles of a box
        picture = "document.querySelector('#model canvas').toDataURL()"
        remember = f"window.before = {picture}; document.querySelector('#model .view').dataset.drawn = ''"
        self.script(remember)
        self.drag("#model canvas", 120, 40)
        self.wait("document.querySelector('#model .view').dataset.drawn === 'still'", 60)
        self.assertTrue(self.script(f"return {picture} !== before"), "the model has turned")
        x, y = self.middle("#model canvas")
        actions = ActionBuilder(self.browser)
        actions.pointer_action.move_to_location(x, y).pointer_down().pointer_up()
        actions.perform()
        self.wait("document.querySelector('#model .explained .numbers')", 60)
        self.check_model_derivation()
        seen = self.script("return rhw.views.model.explanation.fragments.findLast((f) => f.fate === 'written' && f.instance >= 0)")
        self.check_taken(seen)
        self.script("document.getElementById('model').scrollIntoView()")
        self.drag("#model canvas", 40, 0)
        self.assertEqual(self.script("return document.querySelector('#model .explained').textContent"), "", "it was of another picture")
        self.assertEqual(self.script("return document.querySelector('#model .derivation').textContent"), "")
        for value in ["normal", "depth", "uv", "triangle"]:
            self.script(remember)
            self.node(f"#model button[value='{value}']").click()
            self.wait(f"{picture} !== before", 60)
        self.browser.save_screenshot(os.path.join(sys.argv[3], "model.png"))

    def check_taken(self, seen):
        """The triangle of the model's pixel in the other chapters, with its numbers, the way back, and the chapters' own again."""
        uv = {name: varying["vertices"] for varying in seen["varyings"] for name in "uv" if varying["name"] == f"uv of base color {name}"}
        for name in ["weights", "pixel", "clip", "motion", "depth"]:
            own = self.script(f"return rhw.views.{name}.scene.corners.map((corner) => corner.at)")
            self.script(f"rhw.views.{name}.figure.dataset.drawn = ''")
            self.script("arguments[0].click()", self.node(f"#model .takes [value='{name}']"))
            self.wait(f"Math.abs(rhw.views.{name}.numbers?.W_0 - {seen['clip'][0][3]}) < 1e-5")
            self.show(name)
            n = self.script(f"return rhw.views.{name}.numbers")
            for key, share in zip("rstabc", seen["screen"] + seen["space"]):
                self.assertAlmostEqual(n[key], share, delta=0.02 if name == "motion" else 0.005)  # of a pixel of another picture
            for i in range(3):
                self.assertAlmostEqual(n[f"W_{i}"], seen["clip"][i][3], places=5)
                self.assertAlmostEqual(n[f"u_{i}"], uv["u"][i], places=5)
                self.assertAlmostEqual(n[f"v_{i}"], uv["v"][i], places=5)
            self.check_native(name)
            self.browser.save_screenshot(os.path.join(sys.argv[3], f"taken_{name}.png"))
            self.assertEqual(self.node(f"#{name} .taken a").get_attribute("href").split("#")[1], "model")
            self.node(f"#{name} .taken button").click()
            self.assertEqual(self.script(f"return rhw.views.{name}.scene.corners.map((corner) => corner.at)"), own)
            self.assertFalse(self.node(f"#{name} .taken").is_displayed())
        self.script("arguments[0].click()", self.node("#model .takes [value='inverse']"))
        n = self.script("return rhw.views.inverse.numbers()")
        self.assertAlmostEqual(n["W_A"], seen["clip"][0][3], places=5)
        self.assertAlmostEqual(n["W_B"], seen["clip"][1][3], places=5)
        self.assertAlmostEqual(n["s"] / n["r"], seen["screen"][1] / seen["screen"][0], places=5)
        self.browser.save_screenshot(os.path.join(sys.argv[3], "taken_inverse.png"))
        self.node("#inverse .taken button").click()
        self.assertEqual(self.script("return rhw.views.inverse.numbers().W_B"), 7)

    def check_model_derivation(self):
        """The library's numbers in the page's words, in both languages, and the triangle in the picture."""
        def told():
            return [self.node(f"#model {part}").text for part in [".derivation", ".explained"]]
        said = self.script("return rhw.views.model.explanation")
        seen = [f for f in said["fragments"] if f["fate"] == "written" and f["instance"] >= 0][-1]
        steps, tables = told()
        self.assertIn(said["color"], steps)
        for title in ["On the screen: areas", "What is linear there is 1/W", "In space: divide"]:
            self.assertIn(title, steps)
        for title in ["The triangle that is seen", "Every value three ways", "Its textures there", "in the order of drawing"]:
            self.assertIn(title, tables)
        terms = {"r": seen["screen"][0], "b": seen["space"][1], "W_P": 1 / seen["inverse_w"][0]}
        for term, value in terms.items():
            node = self.script(f"return [...document.querySelectorAll('#model .derivation [data-term={term}]')]"
                               ".map((n) => n.textContent).find((t) => /[0-9]/.test(t))")
            self.assertAlmostEqual(float(node.replace("−", "-")), value, delta=abs(value) * 1e-3)
        for varying in seen["varyings"]:
            row = self.script("return [...document.querySelectorAll('#model .explained tr')].map((r) => [...r.cells]"
                              ".map((c) => c.textContent)).find((r) => r[0] === arguments[0])",
                              varying["name"] if not varying["name"].startswith("uv of") else
                              f"{varying['name'][-1]} of {varying['name'][6:-2].replace('base color', 'base colour')}")
            self.assertAlmostEqual(float(row[3].replace("−", "-")), varying["pipeline"], delta=1e-9 + abs(varying["pipeline"]) * 1e-5)
            self.assertEqual(row[4], f"{varying['error_ulp']:.2f}")
        spelled = self.script("const page = document.body.cloneNode(true); page.querySelectorAll('.code, script').forEach((node) => node.remove());"
                              "return page.textContent.match(/[a-z]* ?color[a-z]*/gi) ?? []")
        self.assertEqual(spelled, [], "one spelling, but for names in programs")
        self.assertEqual(len(self.browser.find_elements(By.CSS_SELECTOR, "#model .view .outline text")), 3)
        self.browser.save_screenshot(os.path.join(sys.argv[3], "model_explained.png"))
        self.node("#language").click()
        steps, tables = told()
        for title in ["屏幕上：面积之比", "在屏幕上线性的是 1/W", "回到空间：除以 W"]:
            self.assertIn(title, steps)
        for title in ["可见的三角形", "每个值的三种算法", "此处的纹理", "依绘制顺序", "基色", "位置 x", "写入", "背景"]:
            self.assertIn(title, tables)
        english = re.findall(r"[A-Za-z]{3,}", steps + tables)
        self.assertEqual([word for word in english if word not in ("rhw", "ULP", "alpha") and word not in seen["node"]], [])
        self.script("document.getElementById('model').scrollIntoView()")
        self.browser.save_screenshot(os.path.join(sys.argv[3], "model_explained_zh.png"))
        self.node("#language").click()
        self.size(360, 844)
        told = self.script("const row = document.querySelectorAll('#model .explained tr:first-child')[1]; return row.cells[4].getBoundingClientRect().right")
        self.assertLessEqual(told, 360, "what became of a value stands before what its corners have")
        wide = ("const room = [...document.querySelectorAll('#model .explained .scroll')].find((one) => one.scrollWidth > one.clientWidth + 20);"
                "room.scrollLeft = 100; const left = (node) => Math.round(node.getBoundingClientRect().left);"
                "return [left(room.querySelector('td')) - left(room), room.scrollLeft > 10]")
        self.assertEqual(self.script(wide), [0, True], "a value's name stays where its row is wider than a phone")
        self.size(1440, 900)

    def test_a_picture_gives_way_to_a_drag(self):
        self.open_sample()
        self.script("const v = rhw.views.model; v.still = { samples: 16, supersample: 16 }; v.figure.dataset.drawn = ''; v.draw()")
        time.sleep(0.5)  # of the seconds that it would take
        self.assertEqual(self.script("return rhw.views.model.figure.dataset.drawn"), "")
        before = time.monotonic()
        self.script("const v = rhw.views.model; v.still = { samples: 4 }; v.turn(30, 0)")
        self.wait("rhw.views.model.figure.dataset.drawn !== ''")
        print(f"a picture gave way after {time.monotonic() - before:.2f} s")
        self.assertEqual(self.script("return rhw.views.model.givenUp"), 1)
        self.wait("rhw.views.model.figure.dataset.drawn === 'still'", 60)

    def test_a_file_that_is_no_model(self):
        self.open_sample()
        with tempfile.NamedTemporaryFile(suffix=".glb") as file:
            file.write(b"no model at all")
            file.flush()
            self.node("#model input").send_keys(file.name)
            self.wait("document.querySelector('#model .state').textContent.includes('rhw: ')", 60)

    def drop(self, files, folder):
        """Drops a folder with files, {path: URL of the page's or None: it cannot be read}, as a browser does."""
        self.script("""
            const [files, folder] = arguments;
            const entry = (name, inside) => inside instanceof Object ? {
              name, isFile: false, createReader() {
                let portions = [Object.entries(inside).map((pair) => entry(...pair)), []];
                return { readEntries: (done) => done(portions.shift()) };
              } } : { name, isFile: true, async file(done) {
                const file = new File([inside ? await (await fetch(inside)).arrayBuffer() : ''], name);
                if (inside === null) {
                  file.arrayBuffer = () => Promise.reject(new DOMException('gone', 'NotFoundError'));
                }
                done(file);
              } };
            const event = new Event('drop', { cancelable: true });
            event.dataTransfer = { files: [{}], items: [{ kind: 'file', webkitGetAsEntry: () => entry(folder, files) }] };
            document.dispatchEvent(event);""", files, folder)

    def test_a_folder_is_dropped(self):
        self.show("model")
        self.wait("rhw.views.model")
        box = "data:text/plain," + "%0A".join(["mtllib m/box.mtl", "v 0 0 0", "v 1 0 0", "v 0 1 0", "vt 0 0", "usemtl a", "f 1/1 2/1 3/1"])
        self.drop({"readme.txt": "data:,text", "inner": {"box.obj": box, "m": {"box.mtl": "data:text/plain,newmtl%20a%0AKd%201%200%200"}}}, "things")
        self.wait("rhw.views.model.name === 'box.obj' && rhw.views.model.figure.dataset.drawn === 'still'")
        self.assertEqual(self.script("return document.querySelector('#model .state').textContent"), "")
        square = "data:text/plain," + "%0A".join(["mtllib none.mtl", "v 0 0 0", "v 1 0 0", "v 1 1 0", "v 0 1 0", "f 1 2 3 4"])
        self.drop({"square.obj": square}, "things")
        self.wait("document.querySelector('#model .warnings').textContent.includes('none.mtl')")
        self.script("rhw.views.model.explain(0.5, 0.5)")
        self.wait("rhw.views.model.explanation")
        self.assertTrue(self.node("#model .warnings").is_displayed(), "a warning stays")
        self.assertEqual(self.script("return [...document.querySelectorAll('#model .why')].map((link) => link.hash)"),
                         ["#weights", "#inverse", "#clip", "#motion", "#pixel", "#depth"])
        self.node("#model .warnings button").click()
        self.assertFalse(self.node("#model .warnings").is_displayed())
        wall = "data:text/plain," + "%0A".join(["mtllib wall.mtl", "v 0 0 0", "v 1 0 0", "v 0 1 0", "vt 0 0", "usemtl a", "f 1/1 2/1 3/1"])
        named = "data:text/plain,newmtl%20a%0Amap_Kd%20wall.png"
        image = self.script("const c = document.createElement('canvas'); c.width = c.height = 1; return c.toDataURL()")
        self.drop({"source": {"wall.obj": wall, "wall.mtl": named}, "textures": {"wall.png": image, "large.zip": None, "gone.png": None}, "other": {"gone.png": None}}, "chair")
        self.wait("rhw.views.model.name === 'wall.obj' && rhw.views.model.figure.dataset.drawn === 'still'")
        self.assertFalse(self.node("#model .warnings").is_displayed(), "textures beside the model's folder")
        self.drop({"box.obj": box, "gone.png": None}, "things")
        self.wait("document.querySelector('#model .state').textContent.startsWith('things/gone.png: cannot be read. Drop the folder')")
        self.drop({}, "things")
        self.wait("document.querySelector('#model .state').textContent === 'There is no file in this folder.'")

    def test_a_server_that_does_not_know_the_types(self):
        self.open("#pixel", start_server(sys.argv[1], types={".wasm": "application/octet-stream"}))
        self.wait("window.rhw?.views.pixel?.figure.dataset.drawn === 'still'")

    def test_opened_as_a_file(self):
        self.browser.get("file://" + os.path.abspath(os.path.join(sys.argv[1], "index.html")))
        self.wait("document.querySelector('#first .view').dataset.error?.includes('python3 -m http.server')")
        self.browser.get_log("browser")  # that modules are refused

    def test_one_file(self):
        """Without a server, without the network, and without WebGL."""
        none = ("const own = HTMLCanvasElement.prototype.getContext; HTMLCanvasElement.prototype.getContext ="
                " function (kind, ...rest) { return kind === '2d' ? own.call(this, kind, ...rest) : null; }")
        added = self.browser.execute_cdp_cmd("Page.addScriptToEvaluateOnNewDocument", {"source": none})
        self.browser.execute_cdp_cmd("Network.enable", {})
        self.browser.execute_cdp_cmd("Network.emulateNetworkConditions", {"offline": True, "latency": 0, "downloadThroughput": 0,
                                                                         "uploadThroughput": 0})
        try:
            self.open("#pixel?P=0.4,0.55", "file://" + os.path.abspath(sys.argv[1]) + ".html")
            self.wait("window.rhw?.views.pixel?.figure.dataset.drawn === 'still' && rhw.views.model")
            self.assertAlmostEqual(self.script("return rhw.views.pixel.pixel[0]"), 0.4)
            self.assertIsNone(self.script("return document.createElement('canvas').getContext('webgl2')"))
            self.check_native("pixel")
            self.open_sample()
            self.assertIn("12", self.node("#model .info").text)
            self.assertIn("libstb", self.script("return document.querySelector('.licenses pre').textContent"))
        finally:
            self.browser.execute_cdp_cmd("Page.removeScriptToEvaluateOnNewDocument", added)
            self.browser.execute_cdp_cmd("Network.emulateNetworkConditions", {"offline": False, "latency": 0,
                                                                             "downloadThroughput": -1, "uploadThroughput": -1})

    def test_chapters_are_there_when_the_network_goes(self):
        self.wait("rhw.views.model && rhw.views.depth")  # which nobody has come to
        self.browser.execute_cdp_cmd("Network.enable", {})
        self.browser.execute_cdp_cmd("Network.emulateNetworkConditions", {"offline": True, "latency": 0, "downloadThroughput": 0,
                                                                         "uploadThroughput": 0})
        try:
            for name in ("motion", "depth"):
                self.show(name)
            self.show("model")
            self.node("#model .sample").click()
            self.wait("document.querySelector('#model .state').textContent.startsWith('models/box.glb: ')")
        finally:
            self.browser.execute_cdp_cmd("Network.emulateNetworkConditions", {"offline": False, "latency": 0,
                                                                             "downloadThroughput": -1, "uploadThroughput": -1})
        self.browser.get_log("browser")
        self.node("#model .sample").click()
        self.wait("rhw.views.model.figure.dataset.drawn === 'still'")

    def test_what_a_screen_reader_hears(self):
        self.wait("rhw.views.model && rhw.views.depth")
        nodes = self.browser.execute_cdp_cmd("Accessibility.getFullAXTree", {})["nodes"]
        roles = [(node.get("role", {}).get("value"), node.get("name", {}).get("value")) for node in nodes if not node.get("ignored")]
        names = [name for role, name in roles if role in ("Canvas", "canvas", "application")]
        self.assertEqual(len(names), 9)
        self.assertTrue(all(name and name.startswith("Picture: ") for name in names) and len(set(names)) == 9, names)
        for name in CHAPTERS:
            self.show(name)
        drawings = self.script("return [...document.querySelectorAll('svg.top, svg.plot')].map((svg) => [svg.getAttribute('role'),"
                               " svg.getAttribute('aria-label')])")
        self.assertEqual(len({name for _, name in drawings}), 7, drawings)  # a view from above is called so wherever it is
        self.assertEqual(len(drawings), 9)
        self.assertTrue(all(role in ("group", "img") and name for role, name in drawings), drawings)
        self.assertEqual(self.script("return [...document.querySelectorAll('th')].filter((cell) => !cell.textContent).length"), 0)
        levels = self.script("return [...document.querySelectorAll('h1, h2, h3, h4')].map((head) => Number(head.tagName[1]))")
        self.assertTrue(all(after <= before + 1 for before, after in zip(levels, levels[1:])), levels)

        names = [name for role, name in roles if role in ("button", "heading")]
        self.assertEqual([name for name in names if re.search(r"\Swhy\?|[\u4e00-\u9fff]", name) and name != "中文"], [], "in one language, word by word")
        self.assertEqual([name for name in names if name in ("A", "B")], [], "what is dragged is more than a letter")
        controls = ("button", "link", "slider", "heading", "image", "img", "application")
        self.assertEqual([role for role, name in roles if role in controls and not (name or "").strip()], [], "each has a name")
        self.assertEqual(self.script("return [...document.querySelectorAll('[data-name]')].filter((row) => row.role !== 'group' || !row.ariaLabel).length"), 0)
        self.assertEqual(self.script("return document.querySelectorAll('[aria-live=polite]').length"), 0, "nobody has worked with a chapter")
        live = ("const lines = document.getElementById(arguments[0]).querySelectorAll('[aria-live], [role=status]');"
                "return [...lines].map((line) => line.textContent).join('|')")
        for name in [*CHAPTERS, "exercises"]:  # a picture says what changed, once it rests
            self.show(name)
            self.script("arguments[0].focus()", self.node(f"#{name} .view canvas"))
            said = set()
            for key, x in ((Keys.HOME, 0), (Keys.END, 0.999999)):
                self.browser.switch_to.active_element.send_keys(key)
                self.assertAlmostEqual(self.script(f"return rhw.views.{name}.pixel[0]"), x)
                self.script(f"rhw.views.{name}.pick([{0.5 if name != 'floor' else 0.3}, {0.5 + x / 20}])")
                self.wait(f"(() => {{ {live.replace('arguments[0]', repr(name))} }})().match(/[0-9]/)")
                time.sleep(0.4)
                said.add(self.script(live, name))
            self.assertEqual(len(said), 2, name)

        for mark in ("#inverse .plane-room .mark", "#inverse .plot .mark", "#inverse .plane-room .mark ~ .mark"):
            self.script("arguments[0].focus()", self.node(mark))
            for key, q in ((Keys.HOME, 0), (Keys.END, 1)):
                self.browser.switch_to.active_element.send_keys(key)
                self.assertEqual(self.script("return rhw.views.inverse.q"), q)
                self.assertEqual(self.node(mark).get_attribute("aria-valuenow"), str(100 * q))

        slider = self.node("#pixel .divider")
        self.script("document.querySelector('#pixel .divider').focus()")
        heard_in = ("return [...new Set([...document.querySelectorAll('.chapter [aria-live=polite]')]"
                    ".map((line) => line.closest('section').id))]")
        self.assertEqual(self.script(heard_in), ["pixel"], "nothing of the other chapters, which change with the language too")
        for key, text in ((Keys.HOME, "left 0 % naive, right divided by w"), (Keys.END, "left 100 % naive, right divided by w"),
                          (Keys.ARROW_LEFT, "left 98 % naive, right divided by w")):
            self.browser.switch_to.active_element.send_keys(key)
            self.wait(f"document.querySelector('#pixel .divider').getAttribute('aria-valuetext') === '{text}'")
        self.assertEqual(slider.get_attribute("aria-valuemax"), "100")
        heard = "document.querySelector('#pixel .heard').textContent"
        self.wait(f"{heard}.startsWith('u: naive ') && document.querySelector('#pixel .heard').ariaLive === 'polite'")
        before = self.script(f"return {heard}")
        self.node("#pixel canvas").send_keys(Keys.ARROW_LEFT)
        self.wait(f"{heard} !== {before!r}")

    def work_of_a_drag(self, name):
        """What a step of a drag costs, whatever the machine: nodes that are made, layouts and styles of the page, calls of what moves."""
        self.show(name)
        self.browser.execute_cdp_cmd("Performance.enable", {})
        count = lambda: {m["name"]: m["value"] for m in self.browser.execute_cdp_cmd("Performance.getMetrics", {})["metrics"]}  # noqa: E731
        before = count()
        made, calls, writings, frames = self.browser.execute_async_script("""
            const [name, done] = arguments, view = rhw.views[name], move = view.moveCorner;
            const handle = document.querySelector(`#${name} .view .cornerA`);
            let made = 0, calls = 0, frames = 0, writings = 0;
            const panel = document.querySelector(`#${name} .derivation`);
            panel && new MutationObserver(() => writings++).observe(panel, { characterData: true, subtree: true });
            new MutationObserver((list) => list.forEach(({ addedNodes }) => (made += addedNodes.length)))
              .observe(document.body, { childList: true, subtree: true });
            view.moveCorner = (...rest) => { calls++; return move.apply(view, rest); };
            handle.setPointerCapture = () => {};
            const say = (kind, x) => handle.dispatchEvent(new PointerEvent(kind, { pointerId: 1, isPrimary: true, button: 0, clientX: x, clientY: 300 }));
            say('pointerdown', 300);
            const step = () => {
              for (let i = 0; i < 4; i++) say('pointermove', 300 + frames + i / 4); // a mouse may be quicker than the screen
              frames++ < 20 ? requestAnimationFrame(step) : (say('pointerup', 320), view.moveCorner = move, done([made, calls, writings, frames]));
            };
            requestAnimationFrame(step);""", name)
        after = count()
        counts = {key: (after[key] - before[key]) / frames for key in ("LayoutCount", "RecalcStyleCount")}
        return {"nodes": made / frames, "moves": calls / frames, "writings": writings / frames, **counts}

    def test_a_drag_writes_little(self):
        for name in ["pixel", "weights", "triangle", "clip", "exercises"]:
            work = self.work_of_a_drag(name)
            self.assertLess(work["nodes"], 0.5, f"{name}: texts change, nodes stay: {work}")
            self.assertLess(work["writings"], 0.6, f"{name}: numbers are written as fast as one reads: {work}")
            self.assertLess(work["moves"], 1.2, f"{name}: a frame hears of a drag once: {work}")
            self.assertLess(work["LayoutCount"], 1.6, f"{name}: the page is laid out once a frame: {work}")
            self.assertLess(work["RecalcStyleCount"], 1.6, f"{name}: {work}")

    # Speed: printed, and not held to what a busy machine may not reach.

    def test_what_the_first_picture_needs_is_fetched_at_once(self):
        """Each module that it needs is named in the page: else one would be asked for once the one before has come."""
        needed, waiting = set(), ["main.js", "chapters/first.js"]
        while waiting:
            name = waiting.pop()
            if name not in needed:
                needed.add(name)
                with open(os.path.join(sys.argv[1], name)) as file:
                    imports = re.findall(r"^import [^;]*? from '([^']+)';", file.read(), re.MULTILINE)
                waiting += [os.path.normpath(os.path.join(os.path.dirname(name), one)) for one in imports]
        with open(os.path.join(sys.argv[1], "index.html")) as file:
            named = set(re.findall(r'rel="modulepreload" href="([^"]+)"', file.read()))
        self.assertEqual(named, needed - {"main.js"})

    def test_speed(self):
        first = self.script("return rhw.views.pixel.drawnAt") / 1000
        frames, size = self.browser.execute_async_script("""
            const done = arguments[0], view = rhw.views.pixel, begin = performance.now() + 1000, end = begin + 2000;
            let frames = 0;
            const step = (now) => {
              frames += now > begin; // by then the stage knows how many threads are quicker
              view.moveCorner(view.scene.corners[0], [-0.9 + 0.3 * Math.sin(now / 200), 0.15, 0.75]);
              now < end ? requestAnimationFrame(step) : done([frames / 2, `${view.canvas.width}x${view.canvas.height}`]);
            };
            requestAnimationFrame(step);""")
        print(f"first picture after {first:.2f} s (wanted 1); {frames:.0f} frames a second at {size} with a pixel explained (wanted 60)")
        self.assertLess(os.path.getsize(os.path.join(sys.argv[1], "stage.wasm")), 1.4e6)
        self.assertLess(first, FIRST_PICTURE)
        self.assertGreater(frames, FRAMES)


if __name__ == "__main__":
    if len(sys.argv) < 4:
        sys.exit(__doc__)
    os.makedirs(sys.argv[3], exist_ok=True)
    unittest.main(argv=[sys.argv[0], *sys.argv[4:]], verbosity=2)
