"""A headless Chromium that looks at pages from disk, by Debian's python3-selenium and chromium-driver."""
import base64
import contextlib
import io
import json
import pathlib
import shutil
import struct
import sys
import tempfile
import time
import zlib

SKIPPED = 77  # the exit code by which ctest knows a test that skips itself

try:
    from selenium import webdriver
    from selenium.webdriver.chrome.options import Options
    from selenium.webdriver.chrome.service import Service
except ImportError:
    webdriver = None

FLAGS = ["--headless=new", "--no-sandbox", "--disable-quic", "--no-first-run", "--disable-background-networking",
         "--disable-component-update", "--disable-sync", "--disable-dev-shm-usage", "--hide-scrollbars",
         "--use-gl=angle", "--use-angle=swiftshader", "--enable-unsafe-swiftshader"]


def pixels_of(png):
    """Width, height and a function (x, y) -> (red, green, blue) of a PNG with 8 bits and no interlacing."""
    width, height, _, kind = struct.unpack(">IIBB", png[16:26])
    channels = {2: 3, 6: 4}[kind]
    packed, at = b"", 8
    while at < len(png):
        size, name = struct.unpack(">I4s", png[at:at + 8])
        if name == b"IDAT":
            packed += png[at + 8:at + 8 + size]
        at += size + 12
    stream, stride = io.BytesIO(zlib.decompress(packed)), width * channels
    rows, above = [], bytearray(stride)
    for _ in range(height):
        rule, line = stream.read(1)[0], bytearray(stream.read(stride))
        for i in range(stride):
            left = line[i - channels] if i >= channels else 0
            corner = above[i - channels] if i >= channels else 0
            up = above[i]
            if rule == 1:
                line[i] = (line[i] + left) & 255
            elif rule == 2:
                line[i] = (line[i] + up) & 255
            elif rule == 3:
                line[i] = (line[i] + (left + up) // 2) & 255
            elif rule == 4:
                guess = left + up - corner
                nearest = min((left, up, corner), key=lambda value: abs(guess - value))
                line[i] = (line[i] + nearest) & 255
        rows.append(line)
        above = line
    return width, height, lambda x, y: tuple(rows[int(y)][int(x) * channels:int(x) * channels + 3])


class Browser:
    def __init__(self, driver):
        self.driver = driver

    def cdp(self, command, **arguments):
        return self.driver.execute_cdp_cmd(command, arguments)

    def run(self, script, *arguments):
        return self.driver.execute_script(script, *arguments)

    def resize(self, width, height, mobile=False, scale=1):
        self.cdp("Emulation.setDeviceMetricsOverride", width=width, height=height, deviceScaleFactor=scale, mobile=mobile)
        self.cdp("Emulation.setTouchEmulationEnabled", enabled=mobile)

    def prefer(self, scheme):
        self.cdp("Emulation.setEmulatedMedia", features=[{"name": "prefers-color-scheme", "value": scheme}])

    def open(self, path, seconds=60):
        self.driver.get_log("performance")
        self.driver.get(pathlib.Path(path).resolve().as_uri())
        end = time.time() + seconds
        while not self.run("return window.tufted?.ready"):
            if time.time() > end:
                raise AssertionError(f"{path} shows nothing: {self.run('return document.body.innerText')!r}, {self.errors()}")
            time.sleep(0.02)

    def errors(self):
        return [entry["message"] for entry in self.driver.get_log("browser") if entry["level"] in ("SEVERE", "WARNING")
                and "GPU stall due to ReadPixels" not in entry["message"]]

    def requests(self):
        """The addresses that were asked for since open()."""
        messages = [json.loads(entry["message"])["message"] for entry in self.driver.get_log("performance")]
        return [message["params"]["request"]["url"] for message in messages
                if message["method"] == "Network.requestWillBeSent"]

    def screenshot(self, path=None):
        png = base64.b64decode(self.cdp("Page.captureScreenshot", format="png")["data"])
        if path:
            pathlib.Path(path).write_bytes(png)
        return png

    def set(self, **changes):
        self.driver.execute_async_script(
            "const done = arguments[1]; tufted.set(arguments[0]).then(() => { tufted.stage.drawNow(); done(); })", changes)

    def color(self, *rows):
        """The colours of the picture where these points are."""
        script = """
          tufted.stage.drawNow();
          const canvas = document.getElementById('canvas'), gl = tufted.stage.renderer.getContext();
          const scale = canvas.width / canvas.clientWidth;
          return arguments[0].map((row) => {
            const [x, y] = tufted.place(row), bytes = new Uint8Array(4);
            gl.readPixels(Math.floor(x * scale), canvas.height - 1 - Math.floor(y * scale), 1, 1, gl.RGBA, gl.UNSIGNED_BYTE, bytes);
            return [...bytes.subarray(0, 3)];
          });"""
        return self.run(script, list(rows))

    def touch(self, kind, points):
        self.cdp("Input.dispatchTouchEvent", type=kind, touchPoints=[{"x": x, "y": y, "id": i} for i, (x, y) in enumerate(points)])

    def mouse(self, kind, x, y, **more):
        self.cdp("Input.dispatchMouseEvent", type=kind, x=x, y=y, **more)

    def key(self, key, code="", **more):
        self.cdp("Input.dispatchKeyEvent", type="keyDown", key=key, code=code, **({"text": key} if len(key) == 1 else {}), **more)
        self.cdp("Input.dispatchKeyEvent", type="keyUp", key=key, code=code, **more)


@contextlib.contextmanager
def browser():
    """A browser with an empty profile; the program ends with SKIPPED where there is none."""
    binary, service = shutil.which("chromium"), shutil.which("chromedriver")
    if not webdriver or not binary or not service:
        print("skipped: needs chromium, chromium-driver and python3-selenium")
        sys.exit(SKIPPED)
    with tempfile.TemporaryDirectory() as profile:
        options = Options()
        options.binary_location = binary
        for flag in [*FLAGS, f"--user-data-dir={profile}"]:
            options.add_argument(flag)
        options.set_capability("goog:loggingPrefs", {"browser": "ALL", "performance": "ALL"})
        driver = webdriver.Chrome(service=Service(service), options=options)
        try:
            driver.set_script_timeout(60)
            yield Browser(driver)
        finally:
            driver.quit()
