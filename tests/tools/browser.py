# SPDX-License-Identifier: GPL-3.0-or-later
"""A headless Chromium, driven by chromedriver (Debian: chromium, chromium-driver) with the standard library alone.

    with Browser() as browser:
        browser.open(path)
        browser.run("return document.title")
        browser.screenshot(Path("page.png"))
"""
import base64
import json
import os
import shutil
import socket
import subprocess
import tempfile
import time
import urllib.error
import urllib.request
from pathlib import Path

import limits  # beside this file

ARGUMENTS = [
    "--headless", "--no-sandbox", "--disable-gpu", "--no-first-run", "--disable-background-networking",
    "--disable-component-update", "--disable-sync", "--disable-default-apps", "--disable-dev-shm-usage",
    "--hide-scrollbars", "--force-color-profile=srgb",
]


class Missing(Exception):
    """There is no browser on this machine."""


class Browser:
    def __init__(self, width=1280, height=1400, dark=False):
        self.driver = shutil.which("chromedriver")
        self.chromium = shutil.which("chromium")
        if not self.driver or not self.chromium:
            raise Missing("chromium or chromedriver is not installed")
        self.size, self.dark, self.session = (width, height), dark, None

    def __enter__(self):
        self.profile = tempfile.mkdtemp(prefix="fbd-browser-")
        with socket.socket() as free:
            free.bind(("127.0.0.1", 0))
            self.port = free.getsockname()[1]
        environment = {**os.environ, "HOME": self.profile}
        self.process = subprocess.Popen([self.driver, f"--port={self.port}", "--log-level=SEVERE"],
                                        stdin=subprocess.DEVNULL, stdout=subprocess.DEVNULL,
                                        stderr=subprocess.DEVNULL, env=environment)
        try:
            self._wait()
            self._begin()
        except BaseException:
            self.__exit__()
            raise
        return self

    def __exit__(self, *_):
        if self.session:
            try:
                self._call("DELETE", "")
            except OSError:
                pass
        self.process.terminate()
        self.process.wait()
        shutil.rmtree(self.profile, ignore_errors=True)

    def _wait(self):
        end = time.monotonic() + limits.WAIT
        while time.monotonic() < end:
            try:
                with urllib.request.urlopen(f"http://127.0.0.1:{self.port}/status", timeout=limits.WAIT):
                    return
            except OSError:
                time.sleep(0.05)
        raise RuntimeError("chromedriver does not answer")

    def _begin(self):
        options = {
            "binary": self.chromium,
            "args": [*ARGUMENTS, f"--user-data-dir={self.profile}/data", "--window-size=%d,%d" % self.size,
                     *(["--blink-settings=preferredColorScheme=0"] if self.dark else [])],
            "perfLoggingPrefs": {"enableNetwork": True},
        }
        wanted = {"browserName": "chrome", "goog:chromeOptions": options,
                  "timeouts": {"script": int(1000 * limits.WAIT), "pageLoad": int(1000 * limits.WAIT)},
                  "goog:loggingPrefs": {"browser": "ALL", "performance": "ALL"}}
        answer = self._request("POST", "/session", {"capabilities": {"alwaysMatch": wanted}})
        self.session = answer["sessionId"]

    def _request(self, method, path, body=None):
        data = json.dumps(body).encode() if body is not None else None
        request = urllib.request.Request(f"http://127.0.0.1:{self.port}{path}", data=data, method=method,
                                         headers={"Content-Type": "application/json"})
        try:
            with urllib.request.urlopen(request, timeout=limits.WAIT) as answer:
                return json.load(answer)["value"]
        except urllib.error.HTTPError as error:
            raise RuntimeError(json.load(error)["value"]["message"]) from None

    def _call(self, method, path, body=None):
        return self._request(method, f"/session/{self.session}{path}", body)

    def open(self, path, fragment=""):
        self._call("POST", "/url", {"url": Path(path).resolve().as_uri() + fragment})

    def run(self, script, *arguments):
        """The value of a script that returns one; a promise is awaited."""
        wrapped = f"const f = async function() {{ {script} }}; return f.apply(null, arguments);"
        return self._call("POST", "/execute/sync", {"script": wrapped, "args": list(arguments)})

    def press(self, key):
        self._call("POST", "/actions", {"actions": [{"type": "key", "id": "keys", "actions": [
            {"type": "keyDown", "value": key}, {"type": "keyUp", "value": key}]}]})

    def type(self, text):
        """Keys one after another."""
        self._call("POST", "/actions", {"actions": [{"type": "key", "id": "keys", "actions": [
            {"type": kind, "value": key} for key in text for kind in ("keyDown", "keyUp")]}]})

    def chord(self, held, key):
        """A key while another one is held."""
        keys = [("keyDown", held), ("keyDown", key), ("keyUp", key), ("keyUp", held)]
        self._call("POST", "/actions", {"actions": [{"type": "key", "id": "keys", "actions": [
            {"type": kind, "value": value} for kind, value in keys]}]})

    def drag(self, places, pointer="mouse", press=True, release=True):
        """From the first place [x, y] of the window over the others to the last one, by mouse or by touch; without `release`
        it goes on by another call without `press`."""
        moves = [{"type": "pointerMove", "x": round(x), "y": round(y)} for x, y in places]
        down, up = [{"type": "pointerDown", "button": 0}], [{"type": "pointerUp", "button": 0}]
        actions = moves[:1] + down * press + moves[1:] + up * release
        self._call("POST", "/actions", {"actions": [
            {"type": "pointer", "id": pointer, "parameters": {"pointerType": pointer}, "actions": actions}]})

    def click(self, x, y):
        move = {"type": "pointerMove", "x": round(x), "y": round(y)}
        self._call("POST", "/actions", {"actions": [{"type": "pointer", "id": "mouse", "actions": [
            move, {"type": "pointerDown", "button": 0}, {"type": "pointerUp", "button": 0}]}]})

    def resize(self, width, height=900):
        """The window's inside; narrower than a real window may be."""
        self._call("POST", "/goog/cdp/execute", {"cmd": "Emulation.setDeviceMetricsOverride", "params": {
            "width": width, "height": height, "deviceScaleFactor": 1, "mobile": False}})

    def dark_mode(self, dark):
        scheme = {"name": "prefers-color-scheme", "value": "dark" if dark else "light"}
        self._call("POST", "/goog/cdp/execute", {"cmd": "Emulation.setEmulatedMedia", "params": {"features": [scheme]}})

    def print(self, path, width=21.0, height=29.7):
        """The page as a PDF on paper of that size in centimetres."""
        page = {"page": {"width": width, "height": height}, "background": True}
        path.write_bytes(base64.b64decode(self._call("POST", "/print", page)))

    def log(self, kind):
        """New entries of the log `browser` (the console) or `performance`."""
        return self._call("POST", "/se/log", {"type": kind})

    def requests(self):
        """Addresses that the page has asked for since the last time."""
        found = []
        for entry in self.log("performance"):
            message = json.loads(entry["message"])["message"]
            if message["method"] == "Network.requestWillBeSent":
                found.append(message["params"]["request"]["url"])
        return found

    def screenshot(self, path):
        path.write_bytes(base64.b64decode(self._call("GET", "/screenshot")))
