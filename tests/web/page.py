#!/usr/bin/python3
# SPDX-License-Identifier: MIT
"""The page in headless Chromium: its pictures and numbers against the native library's, its corners, lines, keys and words.

usage: page.py PAGE-FOLDER STAGE_REPLAY SCREENSHOT-FOLDER     with the page as one file beside its folder, PAGE-FOLDER.html
"""
import base64
import functools
import os
import re
import struct
import subprocess
import sys
import tempfile
import threading
import time
import unittest

from selenium import webdriver
from selenium.webdriver.chrome.service import Service
from selenium.webdriver.common.actions.action_builder import ActionBuilder
from selenium.webdriver.common.actions.pointer_input import PointerInput
from selenium.webdriver.common.by import By
from selenium.webdriver.common.keys import Keys

CHAPTERS = ["weights", "pixel", "triangle", "floor", "clip", "motion", "depth"]  # those with a pixel that is explained
FIRST_PICTURE = 5.0  # seconds, of a machine that does other things too; what it took is printed


sys.path.insert(0, os.path.join(os.path.dirname(__file__), "..", "..", "web"))
import serve  # noqa: E402: it stands beside the page


def start_server(folder, isolated=True, types=None):
    """types: of files by their endings, where they are others."""
    server = serve.make_server(folder, isolated=isolated)
    if types:
        handler = server.RequestHandlerClass
        wrong = type("WrongHandler", (handler.func,), {"extensions_map": {**handler.func.extensions_map, **types}})
        server.RequestHandlerClass = functools.partial(wrong, **handler.keywords)
    threading.Thread(target=server.serve_forever, daemon=True).start()
    return f"http://127.0.0.1:{server.server_port}/index.html"


def start_browser():
    options = webdriver.ChromeOptions()
    for option in ["--headless=new", "--no-sandbox", "--disable-gpu", "--hide-scrollbars", "--no-first-run", "--lang=en",
                   "--disable-background-networking", "--disable-component-update", "--disable-sync", "--disable-quic"]:
        options.add_argument(option)
    options.set_capability("goog:loggingPrefs", {"browser": "ALL"})
    return webdriver.Chrome(service=Service("/usr/bin/chromedriver"), options=options)


class Page(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.browser = start_browser()
        cls.url = start_server(sys.argv[1])
        cls.size(1440, 900)

    @classmethod
    def tearDownClass(cls):
        cls.browser.quit()

    @classmethod
    def size(cls, width, height, touch=False):
        metrics = {"width": width, "height": height, "deviceScaleFactor": 1, "mobile": touch}
        cls.browser.execute_cdp_cmd("Emulation.setDeviceMetricsOverride", metrics)

    def open(self, behind, url=None):
        """A page anew: a browser does not load it again for what stands behind #."""
        self.browser.get("about:blank")
        self.browser.get((url or self.url) + behind)

    def setUp(self):
        self.open("#pixel")
        self.browser.execute_script("localStorage.clear()")
        self.open("#pixel")
        self.wait("window.rhw?.views.pixel?.figure.dataset.drawn === 'still' && rhw.views.model")  # nothing grows any more

    def tearDown(self):
        said = [line["message"] for line in self.browser.get_log("browser") if line["level"] == "SEVERE"]
        self.assertEqual(said, [], "the console stays empty")

    def script(self, text, *arguments):
        return self.browser.execute_script(text, *arguments)

    def wait(self, condition, seconds=20):
        end = time.monotonic() + seconds
        while not self.script(f"return Boolean({condition})"):
            self.assertLess(time.monotonic(), end, f"{condition} within {seconds} s")
            time.sleep(0.02)

    def show(self, name):
        self.script(f"document.getElementById('{name}').scrollIntoView();"
                    f"document.querySelector('#{name} .view')?.scrollIntoView({{block: 'nearest'}})")
        if name in CHAPTERS or name == "exercises":
            self.wait(f"rhw.views.{name}?.figure.dataset.drawn === 'still' && rhw.views.{name}.seen")

    def still(self, name="pixel"):
        self.wait(f"rhw.views.{name}.figure.dataset.drawn === 'still'")

    def node(self, selector):
        return self.browser.find_element(By.CSS_SELECTOR, selector)

    def middle(self, selector):
        return self.script(f"const b = document.querySelector('{selector}').getBoundingClientRect();"
                           "return [Math.round(b.x + b.width / 2), Math.round(b.y + b.height / 2)]")

    def drag(self, selector, dx, dy, kind="mouse"):
        x, y = self.middle(selector)
        actions = ActionBuilder(self.browser, mouse=PointerInput(kind, kind), duration=20)
        pointer = actions.pointer_action
        pointer.move_to_location(x, y).pointer_down()
        for step in (1, 2, 3, 4):
            pointer.move_to_location(x + dx * step // 4, y + dy * step // 4)
        pointer.pointer_up()
        actions.perform()

    def swipe(self, selector, dy, beside=0):
        """A real finger, which scrolls where it may, so far beside the node's middle."""
        x, y = self.middle(selector)
        x += beside
        point = lambda at: [{"x": x, "y": at}]  # noqa: E731
        touch = lambda kind, points: self.browser.execute_cdp_cmd(  # noqa: E731
            "Input.dispatchTouchEvent", {"type": kind, "touchPoints": points})
        touch("touchStart", point(y))
        for part in range(1, 11):
            touch("touchMove", point(y + dy * part / 10))
        touch("touchEnd", [])

    def corner(self, number, name="pixel"):
        return self.script(f"return rhw.views.{name}.scene.corners[{number}].at")

    # Against the native library

    def replay(self, name):
        """What the native library makes of the same calls: pixels, and the numbers of the page's pixel as bits."""
        text, pixel = self.script(f"const v = rhw.views.{name};"
                                  "return [v.script, [v.pixel[0] * v.canvas.width, v.pixel[1] * v.canvas.height]]")
        with tempfile.TemporaryDirectory() as folder:
            script, pixels = os.path.join(folder, "script"), os.path.join(folder, "pixels")
            with open(script, "w") as file:
                file.write(text)
            x, y = (str(int(place)) for place in pixel)
            told = subprocess.run([sys.argv[2], script, pixels, x, y], capture_output=True, text=True, check=True)
            with open(pixels, "rb") as file:
                return file.read(), told.stdout.split()

    def check_native(self, name):
        pixels, numbers = self.replay(name)
        shown = self.script(f"const c = rhw.views.{name}.canvas;"
                            "const d = c.getContext('2d').getImageData(0, 0, c.width, c.height).data;"
                            "let s = ''; for (let i = 0; i < d.length; i += 32768)"
                            " s += String.fromCharCode(...d.subarray(i, i + 32768)); return btoa(s)")
        self.assertEqual(base64.b64decode(shown), pixels, f"{name}: the picture has the native library's bytes")
        bits = self.script(f"return Object.values(rhw.views.{name}.numbers).map((n) => Number.isNaN(n) ? 'nan' :"
                           "[...new Uint8Array(new Float64Array([n]).buffer)].map((b) => b))")
        told = [struct.pack("<Q", int(number, 16)) for number in numbers]
        self.assertEqual(len(bits), len(told))
        for mine, theirs in zip(bits, told):
            if mine == "nan":
                self.assertNotEqual(*[struct.unpack("<d", theirs)[0]] * 2)
            else:
                self.assertEqual(bytes(mine), theirs, f"{name}: a number has the native library's bits")

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

    # What is asked, and what the address says

    def test_the_middle_is_asked_for(self):
        self.open("")
        self.wait("window.rhw?.views.first?.figure.dataset.drawn === 'still'")
        shown = lambda part: self.node(f"#first {part}").is_displayed()  # noqa: E731
        self.assertFalse(shown(".after") or shown(".second"), "nothing is told before it is asked")
        self.assertFalse(re.search(r"[0-9]", self.node("#first").text), "and no number")
        before = self.middle("#first .ask .mark")
        self.drag("#first .ask .mark circle:last-child", 60, -60)
        self.assertLess(self.middle("#first .ask .mark")[1], before[1] - 30)
        self.node("#first .look").click()
        self.wait("document.querySelector('#first .verdict').textContent")
        self.assertTrue(shown(".after") and shown(".second"))
        said = {}
        for percent in (5, 50, 98):
            self.script(f"rhw.views.first.restore(new URLSearchParams('mark={percent / 100}&shown=1'))")
            said[percent] = self.node("#first .verdict").text
        self.assertIn("halfway along the line in the picture", said[50])
        self.assertIn("Not so far up", said[98])
        self.assertEqual(len(set(said.values())), 3)
        right = self.script("const [a, b] = [1.3, -5].map((z) => rhw.views.first.stageClip([-1.15, 0, z])[3]); return b / (a + b)")
        self.script(f"rhw.views.first.restore(new URLSearchParams('mark={right}&shown=1'))")
        self.assertIn("That is where it is", self.node("#first .verdict").text)

        def ring_on(picture):  # how far the ring is from where the line across the middle meets the edge
            return self.script(
                "const line = document.querySelectorAll('#first .middle')[arguments[0]].points[0],"
                " at = document.querySelectorAll('#first .ask .mark')[arguments[0]].transform.baseVal[0].matrix;"
                "return Math.hypot(at.e - line.x, at.f - line.y)", picture)
        self.wait("document.querySelectorAll('#first .middle')[1].points.length === 2")
        self.assertLess(ring_on(1), 1.5)
        self.assertGreater(ring_on(0), 20)

    def test_shares_are_the_pixels_weights(self):
        self.show("weights")
        areas = ("const area = (p) => Math.abs([0, 1, 2].reduce((sum, i) => sum + p[i].x * p[(i + 1) % 3].y - p[(i + 1) % 3].x * p[i].y, 0));"
                 "const list = [...document.querySelectorAll(arguments[0])].map((node) => area(node.points));"
                 "const all = list.reduce((a, b) => a + b); return list.map((one) => one / all)")

        def check():
            n = self.script("return rhw.views.weights.numbers")
            for shapes, names in (("#weights .view .share", "rst"), ("#weights .straight .share", "abc")):
                for share, name in zip(self.script(areas, shapes), names):
                    self.assertAlmostEqual(share, n[name], delta=0.01)
            for name in "rstabc":
                width = self.script(f"return document.querySelector('#weights .bar [data-term={name}] + span b').style.width")
                self.assertAlmostEqual(float(width.rstrip("%")) / 100, n[name], delta=1e-4)
            return n
        before = check()
        places = self.script("return [...document.querySelectorAll('#weights .view .handle')].map((node) => node.getAttribute('transform'))")
        self.script("document.querySelector('#weights .view .handle.cornerB').focus(); rhw.views.weights.figure.dataset.drawn = ''")
        for _ in range(6):
            self.browser.switch_to.active_element.send_keys(Keys.PAGE_UP)
        self.wait("rhw.views.weights.figure.dataset.drawn === 'still'")
        after = check()
        self.assertLess(after["b"], before["b"] - 0.02)
        self.assertAlmostEqual(after["s"], before["s"], delta=0.002)  # pushed along its ray it is seen where it was
        moved = self.script("return [...document.querySelectorAll('#weights .view .handle')].map((node) => node.getAttribute('transform'))")
        for one, other in zip(places, moved):
            for a, b in zip(re.findall(r"[-0-9.]+", one), re.findall(r"[-0-9.]+", other)):
                self.assertAlmostEqual(float(a), float(b), delta=0.5)
        slide = "const b = document.querySelector('#weights [name=distance]'); b.value = arguments[0]; b.dispatchEvent(new Event('input'))"
        for w in (3, 11):
            self.script("rhw.views.weights.figure.dataset.drawn = ''")
            self.script(slide, w)
            self.wait("rhw.views.weights.figure.dataset.drawn === 'still'")
            pushed = check()
            self.assertAlmostEqual(pushed["W_1"], w, delta=1e-4)
            self.assertAlmostEqual(pushed["s"], before["s"], delta=0.002)
        b = "rhw.views.weights.scene.corners[1].at"
        at = self.script(f"return {b}")
        self.script("rhw.views.weights.moveTo(rhw.views.weights.scene.corners[1], 1000)")  # farther than it may go
        self.assertEqual(self.script(f"return {b}"), at, "it does not leave its ray")
        steps = "[...document.querySelectorAll('#weights .steps > li')].filter((step) => step.offsetHeight > 0).length"
        for count in (1, 2, 3, 4):
            self.assertEqual(self.script(f"return {steps}"), count)
            if count < 4:
                self.node("#weights .next").click()
        self.assertFalse(self.node("#weights .next").is_displayed())

    def test_curves_of_the_edge(self):
        self.show("inverse")
        self.wait("document.querySelector('#inverse .plot .curve')")
        bends = ("const p = [...document.querySelectorAll('#inverse .plot .curve')].map(({ points: q }) => {"
                 " const [a, b, m] = [q[0], q[q.length - 1], q[q.length >> 1]];"
                 " return Math.abs(a.y + (b.y - a.y) * (m.x - a.x) / (b.x - a.x) - m.y); }); return p")
        for value, straight in (("z", [False, True]), ("inverse", [True]), ("over", [True, True]), ("u", [False, True])):
            self.node(f"#inverse button[value='{value}']").click()
            self.assertEqual([bend < 1 for bend in self.script(bends)], straight, value)
        self.assertEqual(len(self.browser.find_elements(By.CSS_SELECTOR, "#inverse .on-curve")), 2)
        before = self.script("return rhw.views.inverse.q")
        self.drag("#inverse .plot .mark circle:last-of-type", 60, 0)
        after = self.script("return rhw.views.inverse.q")
        self.assertGreater(after, before + 0.05)
        place = self.script("const d = rhw.views.inverse, n = d.numbers(); return n.b * d.ends[1][1] + n.a * d.ends[0][1]")
        self.assertAlmostEqual(place, self.script("return rhw.views.inverse.numbers().Z_P"), places=9)  # P lies on the edge

    def test_the_program_says_the_same(self):
        n = self.script("return rhw.views.pixel.numbers")
        naive = sum(n[w] * n[f"u_{i}"] for i, w in enumerate("rst"))
        right = sum(n[w] * n[f"u_{i}"] for i, w in enumerate("abc"))
        for value, naming, comment in (("c", "A.W", "//"), ("python", "A.W", "#"), ("glsl", "W.x", "//")):
            self.node(f"#pixel button[value='{value}']").click()
            lines = self.script("return [...document.querySelectorAll('#pixel .code-line')].map((row) => [...row.children].map((c) => c.textContent))")
            self.assertEqual(len(lines), 10)
            self.assertTrue(any(naming in text for text, _ in lines))
            said = [float(behind.split()[1].replace("−", "-")) for _, behind in lines]
            self.assertTrue(all(behind.startswith(comment) for _, behind in lines))
            self.assertAlmostEqual(said[3], naive, delta=1e-4)
            self.assertAlmostEqual(said[9], right, delta=1e-4)
            if value == "python":  # it is a program, too
                values = {name: type(name, (), {"W": n[f"W_{i}"], "u": n[f"u_{i}"]}) for i, name in enumerate("ABC")}
                values |= {f"e_{name}": n[f"e_{i}"] for i, name in enumerate("ABC")}
                exec("\n".join(text for text, _ in lines), values)
                self.assertAlmostEqual(values["u"], right, delta=1e-6)
        webdriver.ActionChains(self.browser).move_to_element(self.node("#pixel .derivation [data-term='b']")).perform()
        self.assertGreater(self.script("return document.querySelectorAll('#pixel .code-line:has(.alike)').length"), 1)
        webdriver.ActionChains(self.browser).move_to_element(self.node("#pixel .code [data-term='s']")).perform()
        self.wait("document.querySelectorAll('#pixel .derivation .alike').length > 0")

    def test_one_motion(self):
        self.show("motion")
        self.script("document.querySelector('#motion .flight').scrollIntoView({block: 'center'})")
        self.wait("Number(document.querySelector('#motion [name=k]').value) === 1", 15)  # played once
        places = ("return [...document.querySelectorAll('#motion .flight .dot')].map((dot) => [Number(dot.getAttribute('cx')),"
                  " Number(dot.getAttribute('cy'))])")
        rim = "return [...document.querySelector('#motion .flight .screen').points].map(({ x, y }) => [x, y])"
        corners = self.script("return rhw.views.motion.clips")
        (left, bottom), (right, _), (_, top), _ = self.script(rim)
        for (x, y), clip in zip(self.script(places), [clip for clip in corners if clip[3] >= 1]):  # at the end it is the picture
            self.assertAlmostEqual(x, left + (right - left) * (clip[0] / clip[3] + 1) / 2, delta=0.1)
            self.assertAlmostEqual(y, bottom + (top - bottom) * (clip[1] / clip[3] + 1) / 2, delta=0.1)
        self.browser.save_screenshot(os.path.join(sys.argv[3], "motion_end.png"))
        slide = "const k = document.querySelector('#motion [name=k]'); k.value = arguments[0]; k.dispatchEvent(new Event('input'))"
        for k in (0, 0.5):
            self.script(slide, k)
            self.browser.save_screenshot(os.path.join(sys.argv[3], f"motion_{k}.png"))
        self.script(slide, 0)
        self.assertNotEqual(self.script("return document.querySelector('#motion .cut-off').getAttribute('points')"), "")
        self.assertIn("−0.2182", self.node("#motion table").text)  # Z of A, nearer than the near plane
        width, height = self.script("const { clientWidth: w, clientHeight: h } = document.querySelector('#motion .flight'); return [w, h]")
        for k in (0, 0.1, 0.2, 0.4, 0.6, 0.8, 1):
            self.script(slide, k)
            for x, y in self.script(places):
                self.assertTrue(0 < x < width and 0 < y < height, (k, x, y))  # every corner is in the drawing
        distance = "const a = document.querySelector('#motion [name=distance]'); a.value = arguments[0]; a.dispatchEvent(new Event('input'))"
        for w, hidden in ((-1, "true"), (2, "false")):  # behind the eye a corner has no place in the picture, and comes back
            self.script(distance, w)
            self.wait(f"rhw.views.motion.handles[0].hasAttribute('hidden') === {hidden}")

    def test_exercises_are_checked(self):
        self.show("exercises")
        done = lambda: self.script("return [...document.querySelectorAll('#exercises li')].map((li) => li.classList.contains('done'))")  # noqa: E731
        self.assertEqual(done(), [False] * 6)
        self.script("document.querySelector('#exercises').dispatchEvent(new Event('pointermove'))")

        def point(pixel):
            if pixel:
                self.script("rhw.views.exercises.pick(arguments[0])", pixel)
            time.sleep(0.8)  # what does not rest is not looked at

        def put(corners, pixel=None):
            self.script("const v = rhw.views.exercises; arguments[0].forEach((at, i) => (v.scene.corners[i].at = at));"
                        "v.pixel = null; v.figure.dataset.drawn = ''; v.update()", corners)
            self.wait("rhw.views.exercises.figure.dataset.drawn === 'still'")
            point(pixel)

        def seen(at):
            x, y, _, w = self.script("return rhw.views.exercises.stageClip(arguments[0])", at)
            return [(x / w + 1) / 2, (1 - y / w) / 2]
        a, b, c = [-1.3, -0.7, 0.4], [1.4, -0.6, -2.6], [0.1, 1.1, -0.6]
        put([a, b, c], seen([0.05, -0.645, -1.1]))  # the middle of AB, a little inside
        self.assertTrue(done()[2])
        self.assertFalse(any(done()[i] for i in (0, 3, 4, 5)))
        put([a, [1.4, -0.7, 0.4], [0.1, 1.1, -1.5]])
        self.assertTrue(done()[4])
        put([[-1.3, -0.7, 0], [1.4, -0.7, 0], [0.1, 1.1, 0]])
        self.assertTrue(done()[0])
        self.assertFalse(done()[5])
        put([a, b, c])
        errors = self.script("""
            const v = rhw.views.exercises, found = [];
            for (let y = 0.05; y < 1; y += 0.02) for (let x = 0.05; x < 1; x += 0.02) {
              v.pixel = [x, y]; v.explain();
              const n = v.numbers;
              if (n) found.push([x, y, Math.abs(n.r * n.u_0 + n.s * n.u_1 + n.t * n.u_2 - n.a * n.u_0 - n.b * n.u_1 - n.c * n.u_2),
                                Math.min(n.r, n.s, n.t) > 0.05 && Math.abs(n.t - n.c) < 0.005]);
            }
            return found""")
        self.assertFalse(done()[3], "whoever passes over a place has not pointed at it")
        worst = max(errors, key=lambda error: error[2])
        self.assertGreater(worst[2], 0.05)
        point(worst[:2])
        self.assertTrue(done()[1])
        point(next(error[:2] for error in errors if error[3]))
        self.assertTrue(done()[3])
        put([a, b, [0.1, 0.4, 3.6]])
        point(self.script("const v = rhw.views.exercises; for (let y = 0.05; y < 1; y += 0.05) {"
                          " v.pixel = [0.5, y]; v.explain(); if (v.numbers) return v.pixel; }"))
        self.assertTrue(done()[5], self.script("return rhw.views.exercises.numbers"))
        self.assertIn("✓", self.node("#exercises li:last-child .result").text)
        self.node("#exercises li:last-child button").click()
        self.wait("!document.querySelector('#exercises li:last-child').classList.contains('done')")

    def test_the_address_is_the_state(self):
        self.drag("#pixel .view .cornerA .dot", 40, -30)
        self.node("#pixel button[value='glsl']").click()
        self.wait("location.hash.includes('code=glsl') && location.hash.startsWith('#pixel?')")
        self.still()
        corner, pixel, address = self.corner(0), self.script("return rhw.views.pixel.pixel"), self.script("return location.hash")
        self.assertIn("lang=en", address)
        self.open(address.replace("lang=en", "lang=zh").replace("theme=light", "theme=dark"))
        self.wait("window.rhw?.views.pixel?.figure.dataset.drawn === 'still'")
        for value, kept in zip(self.corner(0) + self.script("return rhw.views.pixel.pixel"), corner + pixel):
            self.assertAlmostEqual(value, kept, delta=1e-4)
        self.assertEqual(self.script("return [document.documentElement.lang, document.documentElement.dataset.theme]"), ["zh", "dark"])
        self.assertEqual(self.node("#pixel [data-name='code'] [aria-pressed='true']").text, "GLSL")
        self.assertLess(abs(self.script("return document.getElementById('pixel').getBoundingClientRect().top") - 56), 10)
        self.node("#language").click()
        self.node("#theme").click()
        self.open(self.script("return location.hash"))
        self.wait("window.rhw?.views.pixel?.figure.dataset.drawn === 'still'")
        self.assertEqual(self.script("return [document.documentElement.lang, document.documentElement.dataset.theme]"), ["en", "light"])
        self.assertAlmostEqual(self.corner(0)[0], corner[0], delta=1e-4)
        self.open("#floor")
        self.wait("window.rhw?.views.floor?.figure.dataset.drawn === 'still'")
        self.script("rhw.views.floor.scene.turn(100, -60); rhw.views.floor.pick([0.5, 0.6])")
        eye, saved = self.script("const v = rhw.views.floor; return [v.scene.camera.eye, Object.entries(v.save())]")
        self.open(f"#floor?{'&'.join('='.join(pair) for pair in saved)}")
        self.wait("window.rhw?.views.floor?.figure.dataset.drawn === 'still'")
        for value, kept in zip(self.script("return rhw.views.floor.scene.camera.eye"), eye):
            self.assertAlmostEqual(value, kept, delta=1e-4)
        self.open("#weights?P=NaN,7&A=1,2&B=1e99,-1e99,Infinity&lang=xx&theme=%22")  # nothing of it is a place
        self.wait("window.rhw?.views.weights?.figure.dataset.drawn === 'still'")
        self.assertIn(self.script("return document.documentElement.lang"), ["en", "zh"])
        self.open("#floor?method=world&P=0.5,0.6")
        self.wait("window.rhw?.views.floor?.numbers?.method === 2")
        self.script("location.hash = '#floor?method=correct'")
        self.wait("rhw.views.floor.numbers.method === 1")

    def test_a_taken_triangle_by_its_address(self):
        """One of another picture, far beyond what may be dragged here, is the same when its address is opened."""
        self.show("weights")
        self.script("const v = rhw.views.weights, clips = [0, 1, 2].map((i) => ['X', 'Y', 'Z', 'W'].map((axis) => 100 * v.numbers[`${axis}_${i}`]));"
                    "v.take(clips, v.pixel)")
        self.wait("rhw.views.weights.numbers?.W_0 > 100")
        n, saved = self.script("return [rhw.views.weights.numbers, Object.entries(rhw.views.weights.save())]")
        self.open(f"#weights?{'&'.join('='.join(pair) for pair in saved)}")
        self.wait(f"Math.abs(window.rhw?.views.weights?.numbers?.W_0 / {n['W_0']} - 1) < 1e-4"
                  " && rhw.views.weights.figure.dataset.drawn === 'still'")
        again = self.script("return rhw.views.weights.numbers")
        for name in "rstabc":
            self.assertAlmostEqual(again[name], n[name], delta=0.002)

    def test_contents_and_notes(self):
        self.node(".contents summary").click()
        items = self.browser.find_elements(By.CSS_SELECTOR, ".contents li a[lang='en']")
        self.assertEqual(len(items), len(self.browser.find_elements(By.CSS_SELECTOR, "section.chapter")))
        [item for item in items if "Depth" in item.text][0].click()
        self.wait("Math.abs(document.getElementById('depth').getBoundingClientRect().top - 56) < 10")
        self.assertTrue(self.node("#depth .notes p").is_displayed())
        self.node("#notes").click()
        self.assertFalse(self.node("#depth .notes p").is_displayed())
        self.open("#depth")
        self.wait("window.rhw?.views.depth?.figure.dataset.drawn === 'still'")
        self.assertFalse(self.node("#depth .notes p").is_displayed(), "it is remembered")
        self.wait("rhw.views.model")
        self.script("for (const view of Object.values(rhw.views)) { if (view?.figure) delete view.figure.dataset.drawn; }"
                    "dispatchEvent(new Event('beforeprint'))")
        missing = self.script("return [...document.querySelectorAll('.view:not(.drop)')].filter((figure) => !figure.dataset.drawn)"
                              ".map((figure) => figure.closest('section').id)")
        self.assertEqual(missing, [], "paper has every picture")
        self.assertTrue(self.node("#first .after").is_displayed() and self.node("#depth .notes p").is_displayed())
        self.browser.execute_cdp_cmd("Emulation.setEmulatedMedia", {"media": "print"})
        self.assertFalse(self.node("header").is_displayed())
        self.assertEqual(len([1 for step in self.browser.find_elements(By.CSS_SELECTOR, ".steps > li") if step.is_displayed()]), 4)
        self.browser.execute_cdp_cmd("Emulation.setEmulatedMedia", {"media": ""})
        self.script("dispatchEvent(new Event('afterprint'))")
        self.assertFalse(self.node("#first .after").is_displayed(), "and the question is asked again")
        self.node("#notes").click()

    def test_whoever_wants_no_motion(self):
        self.browser.execute_cdp_cmd("Emulation.setEmulatedMedia", {"features": [{"name": "prefers-reduced-motion", "value": "reduce"}]})
        try:
            self.open("#motion")
            self.wait("window.rhw?.views.motion?.figure.dataset.drawn === 'still'")
            self.script("document.querySelector('#motion .flight').scrollIntoView({block: 'center'})")
            time.sleep(0.5)
            self.assertEqual(self.script("return document.querySelector('#motion [name=k]').value"), "0")
        finally:
            self.browser.execute_cdp_cmd("Emulation.setEmulatedMedia", {"features": []})

    # One's own model

    def open_sample(self):
        self.script("document.getElementById('model').scrollIntoView()")
        self.wait("document.querySelector('#model [data-name=picture] button').hasAttribute('aria-pressed')")
        self.node("#model .sample").click()
        self.wait("document.querySelector('#model .view').dataset.drawn === 'still'", 60)

    def test_a_model_is_turned_and_explained(self):
        self.open_sample()
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
        self.node("#model .take").click()
        self.wait(f"Math.abs(rhw.views.weights.numbers?.W_0 - {seen['clip'][0][3]}) < 1e-5")
        n = self.script("return rhw.views.weights.numbers")
        for name, share in zip("rstabc", seen["screen"] + seen["space"]):
            self.assertAlmostEqual(n[name], share, delta=0.01)  # of a pixel of another picture
        self.script("document.getElementById('model').scrollIntoView()")
        self.drag("#model canvas", 40, 0)
        self.assertEqual(self.script("return document.querySelector('#model .explained').textContent"), "", "it was of another picture")
        self.assertEqual(self.script("return document.querySelector('#model .derivation').textContent"), "")
        for value in ["normal", "depth", "uv", "triangle"]:
            self.script(remember)
            self.node(f"#model button[value='{value}']").click()
            self.wait(f"{picture} !== before", 60)
        self.browser.save_screenshot(os.path.join(sys.argv[3], "model.png"))

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
                              f"{varying['name'][-1]} of {varying['name'][6:-2]}")
            self.assertAlmostEqual(float(row[6].replace("−", "-")), varying["pipeline"], delta=1e-9 + abs(varying["pipeline"]) * 1e-5)
            self.assertEqual(row[7], f"{varying['error_ulp']:.2f}")
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

    # Speed: printed, and not held to what a busy machine may not reach.

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
                         ["#weights", "#inverse", "#clip"])
        self.node("#model .warnings button").click()
        self.assertFalse(self.node("#model .warnings").is_displayed())
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
        """Without a server, and without the network."""
        self.browser.execute_cdp_cmd("Network.enable", {})
        self.browser.execute_cdp_cmd("Network.emulateNetworkConditions", {"offline": True, "latency": 0, "downloadThroughput": 0,
                                                                         "uploadThroughput": 0})
        try:
            self.open("#pixel?P=0.4,0.55", "file://" + os.path.abspath(sys.argv[1]) + ".html")
            self.wait("window.rhw?.views.pixel?.figure.dataset.drawn === 'still' && rhw.views.model")
            self.assertAlmostEqual(self.script("return rhw.views.pixel.pixel[0]"), 0.4)
            self.check_native("pixel")
            self.open_sample()
            self.assertIn("12", self.node("#model .info").text)
            self.assertIn("libstb", self.script("return document.querySelector('.licenses pre').textContent"))
        finally:
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
        self.assertEqual(len(drawings), 8)
        self.assertTrue(all(role in ("group", "img") and name for role, name in drawings), drawings)
        self.assertEqual(self.script("return [...document.querySelectorAll('th')].filter((cell) => !cell.textContent).length"), 0)
        levels = self.script("return [...document.querySelectorAll('h1, h2, h3, h4')].map((head) => Number(head.tagName[1]))")
        self.assertTrue(all(after <= before + 1 for before, after in zip(levels, levels[1:])), levels)

        slider = self.node("#pixel .divider")
        self.script("document.querySelector('#pixel .divider').focus()")
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

    def test_speed(self):
        first = self.script("return rhw.views.pixel.drawnAt") / 1000
        frames, size = self.browser.execute_async_script("""
            const done = arguments[0], view = rhw.views.pixel, end = performance.now() + 2000;
            let frames = 0;
            view.pixel = null;
            const step = (now) => {
              frames++;
              view.moveCorner(view.scene.corners[0], [-0.9 + 0.3 * Math.sin(now / 200), 0.15, 0.75]);
              now < end ? requestAnimationFrame(step) : done([frames / 2, `${view.canvas.width}x${view.canvas.height}`]);
            };
            requestAnimationFrame(step);""")
        print(f"first picture after {first:.2f} s (wanted 1); {frames:.0f} frames a second at {size} (wanted 60)")
        self.assertLess(os.path.getsize(os.path.join(sys.argv[1], "stage.wasm")), 1.2e6)
        self.assertLess(first, FIRST_PICTURE)
        self.assertGreater(frames, 15)


if __name__ == "__main__":
    if len(sys.argv) != 4:
        sys.exit(__doc__)
    os.makedirs(sys.argv[3], exist_ok=True)
    unittest.main(argv=sys.argv[:1], verbosity=2)
