#!/usr/bin/python3
# SPDX-License-Identifier: MIT
"""The page in headless Chromium: its pictures and numbers against the native library's, its corners, lines, keys and words.

usage: page.py PAGE-FOLDER STAGE_REPLAY SCREENSHOT-FOLDER
"""
import base64
import os
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

CHAPTERS = ["first", "triangle", "floor", "clip", "steps", "depth"]  # those with a stage
FIRST_PICTURE = 5.0  # seconds, of a machine that does other things too; what it took is printed


sys.path.insert(0, os.path.join(os.path.dirname(__file__), "..", "..", "web"))
import serve  # noqa: E402: it stands beside the page


def start_server(folder):
    server = serve.make_server(folder)
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

    def setUp(self):
        self.browser.get(self.url)
        self.browser.execute_script("localStorage.clear()")
        self.browser.get(self.url)
        self.wait("window.rhw?.views.first?.figure.dataset.drawn === 'still'")

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
        self.script(f"document.getElementById('{name}').scrollIntoView()")
        if name in CHAPTERS:
            self.wait(f"rhw.views.{name}?.figure.dataset.drawn === 'still' && rhw.views.{name}.seen")

    def still(self, name="first"):
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

    def corner(self, number, name="first"):
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
        for name in ["triangle", "floor", "steps", "depth"]:
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

    def test_exact_column(self):
        self.check_exact_column("first")

    def test_exact_column_with_a_corner_behind_the_eye(self):
        self.show("clip")
        self.check_exact_column("clip")

    # Hands

    def test_corners_are_dragged(self):
        before = self.corner(0)
        self.drag("#first .view .cornerA .dot", 40, -60)
        after = self.corner(0)
        self.assertGreater(after[0], before[0])
        self.assertGreater(after[1], before[1])
        self.still()
        self.check_native("first")
        self.drag("#first .top .cornerB .dot", 0, 20)
        self.assertGreater(self.corner(1)[2], -1.6)

    def test_corners_under_a_finger(self):
        self.size(390, 844, touch=True)
        try:
            self.setUp()
            before, x = self.corner(2), self.middle("#first .view .cornerC .dot")
            self.swipe("#first .view .cornerC .dot", 60)
            self.assertEqual(self.script("return scrollY"), 0, "the page stays")
            self.assertLess(self.corner(2)[1], before[1])
            self.assertAlmostEqual(self.middle("#first .view .cornerC .dot")[1], x[1] + 60, delta=3)
            self.swipe("#first canvas", -120, beside=-140)
            self.wait("scrollY > 50")  # where there is nothing to drag the page scrolls
        finally:
            self.size(1440, 900)

    def test_corners_by_keys(self):
        handle = self.node("#first .view .cornerA")
        self.script("document.querySelector('#first .view .cornerA').focus()")
        before = self.corner(0)
        handle.send_keys(Keys.ARROW_RIGHT)
        self.assertGreater(self.corner(0)[0], before[0])
        handle.send_keys(Keys.PAGE_UP)
        self.assertLess(self.corner(0)[2], before[2])

    def test_line_between_is_dragged(self):
        self.drag("#first .divider rect", 200, 0)
        self.assertGreater(self.script("return rhw.views.first.scene.split"), 0.6)
        self.still()
        self.check_native("first")

    def test_corner_goes_behind_the_eye(self):
        self.show("clip")
        self.assertLess(self.script("return rhw.views.clip.numbers.W_2"), 0)
        self.script("rhw.views.clip.scene.corners[2].at = [0.2, -0.55, -1]; rhw.views.clip.update()")
        self.wait("rhw.views.clip.numbers.W_2 > 0")
        self.check_native("clip")

    def test_pixel_under_the_pointer(self):
        x, y = self.middle("#first canvas")
        actions = ActionBuilder(self.browser)
        actions.pointer_action.move_to_location(x + 100, y + 150)
        actions.perform()
        self.wait("Math.abs(rhw.views.first.pixel[0] - 0.6) < 0.02")
        self.check_native("first")

    def test_terms_are_pointed_at(self):
        node = self.node("#first .derivation [data-term='b']")
        webdriver.ActionChains(self.browser).move_to_element(node).perform()
        self.assertIn(str(self.script("return rhw.views.first.numbers.b")), self.node(".tip").text)
        self.assertGreater(len(self.browser.find_elements(By.CSS_SELECTOR, "#first .alike")), 1)
        self.assertNotEqual(self.script("return document.querySelector('#first .view .part').getAttribute('points')"), "")

    def test_languages_and_themes(self):
        self.node("#language").click()
        self.assertEqual(self.script("return document.documentElement.lang"), "zh")
        self.assertIn("像素", self.node("#first .derivation").text)
        self.assertEqual(self.node("h1:not([lang='en'])").text, "为什么要除以 w？")
        self.browser.get(self.url)
        self.wait("document.documentElement.lang === 'zh'")
        theme = self.script("return document.documentElement.dataset.theme")
        self.node("#theme").click()
        self.assertNotEqual(self.script("return document.documentElement.dataset.theme"), theme)

    def test_phone(self):
        self.size(390, 844, touch=True)
        try:
            self.setUp()
            for language in ["en", "zh"]:
                for name in [*CHAPTERS, "inverse"]:
                    self.show(name)
                    for button in self.browser.find_elements(By.CSS_SELECTOR, f"#{name} .choice button"):
                        self.script("arguments[0].click()", button)
                        self.assertLessEqual(self.script("return document.documentElement.scrollWidth"), 390, f"{name} fits")
                    self.assertLessEqual(self.script("return document.documentElement.scrollWidth"), 390, f"{name} fits")
                    self.browser.save_screenshot(os.path.join(sys.argv[3], f"phone_{language}_{name}.png"))
                self.script("document.querySelector('#language').click()")
            self.check_native("first")
        finally:
            self.size(1440, 900)

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
        self.wait("document.querySelector('#model .explained').textContent.includes('1/W_P = r/W_0')", 60)
        self.drag("#model canvas", 40, 0)
        self.assertEqual(self.script("return document.querySelector('#model .explained').textContent"), "", "it was of another picture")
        for value in ["normal", "depth", "uv", "triangle"]:
            self.script(remember)
            self.node(f"#model button[value='{value}']").click()
            self.wait(f"{picture} !== before", 60)
        self.browser.save_screenshot(os.path.join(sys.argv[3], "model.png"))

    def test_a_file_that_is_no_model(self):
        self.open_sample()
        with tempfile.NamedTemporaryFile(suffix=".glb") as file:
            file.write(b"no model at all")
            file.flush()
            self.node("#model input").send_keys(file.name)
            self.wait("document.querySelector('#model .state').textContent.includes('rhw: ')", 60)

    # Speed: printed, and not held to what a busy machine may not reach.

    def test_speed(self):
        first = self.script("return rhw.views.first.drawnAt") / 1000
        frames, size = self.browser.execute_async_script("""
            const done = arguments[0], view = rhw.views.first, end = performance.now() + 2000;
            let frames = 0;
            view.pixel = null;
            const step = (now) => {
              frames++;
              view.moveCorner(view.scene.corners[0], [-0.9 + 0.3 * Math.sin(now / 200), 0.15, 0.75]);
              now < end ? requestAnimationFrame(step) : done([frames / 2, `${view.canvas.width}x${view.canvas.height}`]);
            };
            requestAnimationFrame(step);""")
        print(f"first picture after {first:.2f} s; {frames:.0f} frames a second at {size}")
        self.assertLess(first, FIRST_PICTURE)
        self.assertGreater(frames, 15)


if __name__ == "__main__":
    if len(sys.argv) != 4:
        sys.exit(__doc__)
    os.makedirs(sys.argv[3], exist_ok=True)
    unittest.main(argv=sys.argv[:1], verbosity=2)
