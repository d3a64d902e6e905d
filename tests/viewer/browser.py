"""A real browser without a window, for tests of pages."""

import os
import shutil
from contextlib import contextmanager

import numpy as np
import pytest

# viser's own remark on wheels and drags, of which nothing follows.
HARMLESS = ("Unable to preventDefault inside passive event listener",)

# Pages draw as often as they can, and here the processor draws: ten times a second is enough.
FEWER_FRAMES = """
const whenDrawn = window.requestAnimationFrame.bind(window);
window.requestAnimationFrame = (callback) => setTimeout(() => whenDrawn(callback), 80);
window.cancelAnimationFrame = window.clearTimeout;
"""


@contextmanager
def opened(url, size=(1300, 480)):
    """Open a page; yields it, and all errors of its console, which must be empty at the end."""
    sync_api = pytest.importorskip("playwright.sync_api", reason="playwright is not installed")
    program = shutil.which("chromium") or shutil.which("chromium-browser")
    if program is None:
        pytest.skip("chromium is not installed")
    flags = ["--use-gl=angle", "--use-angle=swiftshader", "--enable-unsafe-swiftshader"]
    if os.geteuid() == 0:
        flags.append("--no-sandbox")
    errors, elsewhere = [], []
    with sync_api.sync_playwright() as player:
        browser = player.chromium.launch(executable_path=program, args=flags)
        page = browser.new_page(viewport={"width": size[0], "height": size[1]})
        page.set_default_timeout(120_000)
        page.add_init_script(FEWER_FRAMES)
        page.on("console", lambda said: said.type == "error" and errors.append(said.text))
        page.on("pageerror", lambda error: errors.append(str(error)))
        origin = url.split("/")[2]
        page.on("request", lambda asked: asked.url.split(":")[0] in ("http", "https")
                and origin not in asked.url and elsewhere.append(asked.url))  # fmt: skip
        page.goto(url)
        page.wait_for_selector("canvas")
        page.add_style_tag(content=".mantine-Notifications-root { pointer-events: none }")
        yield page
        browser.close()
    assert [text for text in errors if not text.startswith(HARMLESS)] == []
    assert elsewhere == []


def pixels(page):
    """Return the visible scene without notices, black where panels are, (height, width, 3)."""
    import io

    from PIL import Image

    picture = page.screenshot(style=".mantine-Notifications-root { display: none }")
    shown = np.asarray(Image.open(io.BytesIO(picture)).convert("RGB"), np.int16).copy()
    scene = page.locator("canvas").first.bounding_box()
    shown[:, : round(scene["x"])] = shown[:, round(scene["x"] + scene["width"]) :] = 0
    return shown
