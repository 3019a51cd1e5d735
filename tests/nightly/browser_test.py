"""A real browser at a real master: headless Chromium, driven by its DevTools: real clicks, keys and fingers.

What the canvas shows is held against what it showed before. NINEFOLD_SCREENSHOTS=FOLDER keeps screenshots. Skipped where
there is no Chromium; scripts/install_packages nightly brings it.
"""
import base64
import json
import os
import pathlib
import re
import shutil
import sys
import tempfile
import unittest
import urllib.parse

sys.path.insert(0, str(pathlib.Path(__file__).parent.parent / "cluster"))
from browser import Viewer, WebSocket, request  # noqa: E402
from programs import BIN, SCENES, Program, eventually, signal  # noqa: E402

CAMERA = "0.15,1.5,2.25:0,1.5,-0.5:60"  # of tests/window/window_test.py
LAMP = (0.5, 113 / 480)                 # in that view, as shares of the picture
CALM = 3                                # codes: noise of a picture at rest stays below
CHROMIUM = shutil.which("chromium")
SUMS = """(() => { const c = document.getElementById('picture'), n = 16;
  const d = c.getContext('2d').getImageData(0, 0, c.width, c.height).data, sums = new Array(n * n).fill(0), counts = sums.slice();
  for (let y = 0; y < c.height; ++y) for (let x = 0; x < c.width; ++x) {
    const i = (y * n / c.height | 0) * n + (x * n / c.width | 0), at = 4 * (y * c.width + x);
    sums[i] += d[at] + d[at + 1] + d[at + 2]; counts[i] += 3; }
  return sums.map((s, i) => s / Math.max(1, counts[i])); })()"""


class Picture:
    """Means of 16 x 16 blocks of the canvas, as codes."""

    def __init__(self, blocks):
        self.blocks = blocks

    def mean(self):
        return sum(self.blocks) / len(self.blocks)

    def difference(self, other):
        return sum(abs(a - b) for a, b in zip(self.blocks, other.blocks)) / len(self.blocks)


class Tab:
    """One page of the browser."""

    def __init__(self, port, url):
        _, _, body = request("127.0.0.1", port, f"/json/new?{urllib.parse.quote(url, safe='')}", method="PUT")
        self.socket = WebSocket("127.0.0.1", port, re.sub(r"^ws://[^/]*", "", json.loads(body)["webSocketDebuggerUrl"]))
        self.number, self.complaints = 0, []
        for domain in "Page", "Runtime", "Log":
            self.do(f"{domain}.enable")
        eventually(self.is_there, f"a page at {url}")

    def is_there(self):
        answer = self.ask("Runtime.evaluate", expression="document.readyState + !!document.getElementById('control')")
        return answer.get("result", {}).get("result", {}).get("value") == "completetrue"

    def do(self, method, **parameters):
        answer = self.ask(method, **parameters)
        assert "error" not in answer, (method, answer)
        return answer["result"]

    def ask(self, method, **parameters):
        self.number += 1
        self.socket.send(json.dumps({"id": self.number, "method": method, "params": parameters}))
        while True:
            message = json.loads(self.socket.receive())
            entry = message.get("params", {}).get("entry", {})
            if message.get("method") == "Runtime.exceptionThrown" or entry.get("level") == "error":
                self.complaints.append(message["params"])
            if message.get("id") == self.number:
                return message

    def value(self, expression):
        result = self.do("Runtime.evaluate", expression=expression, returnByValue=True)
        assert "exceptionDetails" not in result, result
        return result["result"].get("value")

    def text(self, name):
        return self.value(f"document.getElementById('{name}').textContent")

    def look(self):
        return Picture(self.value(SUMS))

    def rest(self, frames=6):
        def rested():
            found = re.fullmatch(r"(\d+) frames", self.text("frames") or "")
            return found and int(found.group(1)) >= frames
        eventually(rested, "a picture at rest")
        return self.look()

    def until(self, condition, what):
        eventually(lambda: condition(self.look()), what)
        return self.look()

    def at(self, share_x, share_y):
        box = self.value("(b => [b.left, b.top, b.width, b.height])(document.getElementById('picture').getBoundingClientRect())")
        return box[0] + share_x * box[2], box[1] + share_y * box[3]

    def mouse(self, kind, place, button="none", buttons=0):
        self.do("Input.dispatchMouseEvent", type=kind, x=place[0], y=place[1], button=button, buttons=buttons, clickCount=1)

    def click(self, place):
        self.mouse("mouseMoved", place)
        self.mouse("mousePressed", place, "left", 1)
        self.mouse("mouseReleased", place, "left")

    def drag(self, start, end, button, bit):
        self.mouse("mouseMoved", start)
        self.mouse("mousePressed", start, button, bit)
        for i in range(1, 6):
            self.mouse("mouseMoved", tuple(a + (b - a) * i / 5 for a, b in zip(start, end)), button, bit)
        self.mouse("mouseReleased", end, button)

    def press(self, code, key, held=0):
        for kind in "rawKeyDown", "keyUp":
            self.do("Input.dispatchKeyEvent", type=kind, code=code, key=key, modifiers=held)

    def button(self, selector):
        self.click(self.value(f"(e => {{ e.scrollIntoView(); const b = e.getBoundingClientRect(); "
                              f"return [b.left + b.width / 2, b.top + b.height / 2]; }})"
                              f"(document.querySelector({json.dumps(selector)}))"))

    def touch(self, kind, *places):
        self.do("Input.dispatchTouchEvent", type=kind, touchPoints=[{"x": x, "y": y} for x, y in places])

    def screenshot(self, name):
        folder = os.environ.get("NINEFOLD_SCREENSHOTS")
        data = base64.b64decode(self.do("Page.captureScreenshot")["data"])
        if folder:
            (pathlib.Path(folder) / f"{name}.png").write_bytes(data)


@unittest.skipUnless(CHROMIUM, "there is no chromium here")
class Browser(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory(prefix="ninefold-browser-", ignore_cleanup_errors=True)
        self.addCleanup(folder.cleanup)
        self.folder = pathlib.Path(folder.name)
        self.downloads = self.folder / "downloads"
        self.downloads.mkdir()

    def start(self, *command):
        program = Program(command, self.folder)
        self.addCleanup(program.close)
        return program

    def browse(self, *flags):
        profile = self.folder / "profile"
        browser = self.start(CHROMIUM, "--headless=new", "--no-sandbox", "--disable-gpu", "--disable-dev-shm-usage",
                             "--no-first-run", "--remote-debugging-port=0", f"--user-data-dir={profile}",
                             "--window-size=1000,760", *flags, "about:blank")
        self.addCleanup(browser.process.send_signal, signal.SIGTERM)
        return int(browser.waits_for(r"DevTools listening on ws://[^:]+:(\d+)/").group(1))

    def serve(self, address="127.0.0.1:0"):
        self.master = self.start(BIN / "ninefold-master", SCENES / "table_room.glb", "--size", "320x240", "--camera", CAMERA,
                                 "--local-clients", 1, "--serve", address)
        return self.master.waits_for(r"serving at (\S+)").group(1)

    def test_a_session(self):
        url = self.serve()
        browser = self.browse()
        tab = Tab(browser, url)
        first = tab.rest()
        self.assertGreater(first.mean(), 30)
        tab.screenshot("first")
        middle = tab.at(0.5, 0.5)

        with self.subTest("look around, and back"):
            tab.drag(middle, (middle[0] + 150, middle[1]), "right", 2)
            tab.until(lambda p: p.difference(first) > 8, "another view")
            tab.rest()
            tab.screenshot("looked_around")
            tab.press("Home", "Home")
            tab.until(lambda p: p.difference(first) < CALM, "the first view")

        with self.subTest("fly, and back"):
            tab.do("Input.dispatchKeyEvent", type="rawKeyDown", code="KeyW", key="w")
            tab.until(lambda p: p.difference(first) > 8, "another place")
            tab.do("Input.dispatchKeyEvent", type="keyUp", code="KeyW", key="w")
            tab.button("[data-key='268']")
            tab.until(lambda p: p.difference(first) < CALM, "the first view")

        with self.subTest("one finger looks around, two slide"):
            x, y = middle
            tab.touch("touchStart", (x, y))
            tab.touch("touchMove", (x + 80, y))
            tab.touch("touchMove", (x + 150, y))
            tab.touch("touchEnd")
            tab.until(lambda p: p.difference(first) > 8, "another view")
            tab.press("Home", "Home")
            tab.until(lambda p: p.difference(first) < CALM, "the first view")
            tab.touch("touchStart", (x - 50, y), (x + 50, y))
            for i in range(1, 6):
                tab.touch("touchMove", (x - 50 - 10 * i, y + 20 * i), (x + 50 + 10 * i, y + 20 * i))
            tab.touch("touchEnd")
            tab.until(lambda p: p.difference(first) > 8, "another place")
            tab.press("Home", "Home")
            tab.until(lambda p: p.difference(first) < CALM, "the first view")

        with self.subTest("switch the lamp, and undo"):
            tab.rest()
            tab.click(tab.at(*LAMP))
            eventually(lambda: tab.text("selection").startswith("lamp"), "the lamp is selected")
            tab.screenshot("lamp_selected")
            tab.button("[data-key='76']")
            tab.until(lambda p: p.mean() < 0.5 * first.mean(), "darkness")
            tab.screenshot("lamp_off")
            tab.press("KeyZ", "z", 2)
            tab.press("Escape", "Escape")
            tab.until(lambda p: p.difference(first) < CALM, "light again")

        with self.subTest("a view, by the panel"):
            tab.value("(s => { s.selectedIndex = 3; s.dispatchEvent(new Event('change')); })(document.getElementById('view'))")
            tab.until(lambda p: p.difference(first) > 8, "depth")
            tab.press("Digit1", "1")
            tab.until(lambda p: p.difference(first) < CALM, "beauty")

        with self.subTest("save"):
            tab.do("Browser.setDownloadBehavior", behavior="allow", downloadPath=str(self.downloads))
            for kind, magic in ("png", b"\x89PNG"), ("exr", b"\x76\x2f\x31\x01"):
                tab.button(f"#{kind}")
                file = self.downloads / f"table_room.{kind}"
                eventually(lambda: file.exists() and file.stat().st_size > 0, f"a file {file}")
                self.assertEqual(file.read_bytes()[:4], magic)

        with self.subTest("hand over"):
            port, token = re.search(r":(\d+)/#token=(\S+)", url).groups()
            other = Viewer("127.0.0.1", int(port), token)
            self.addCleanup(other.close)
            other.send("ask")
            other.look_until(lambda head: head["asking"])
            eventually(lambda: "hand control" in tab.text("control"), "somebody asks")
            tab.screenshot("asked_for_control")
            tab.button("#control")
            other.look_until(lambda head: head["control"] == head["you"])
            eventually(lambda: tab.text("control") == "ask for control", "control is gone")
        self.assertEqual(tab.complaints, [])
        self.master.process.send_signal(signal.SIGTERM)
        eventually(lambda: "no connection" in tab.text("word"), "the page tells that the master has gone")

    def test_beyond_loopback_with_a_token(self):
        url = self.serve("0.0.0.0:0")
        self.assertRegex(url, r"^https://.*#token=[0-9a-f]{64}$")
        local = re.sub(r"//[^/]*:", "//127.0.0.1:", url)
        browser = self.browse("--ignore-certificate-errors")
        tab = Tab(browser, local)
        tab.rest(2)
        stranger = Tab(browser, re.sub(r"#.*", "", local))
        eventually(lambda: "wrong token" in stranger.text("word"), "a line that the token is wrong")
        stranger.screenshot("wrong_token")


if __name__ == "__main__":
    unittest.main()
