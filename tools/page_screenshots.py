"""Take the pictures of the live view that the docs show, in a browser without a window.

    python tools/page_screenshots.py            # writes docs/images/live.png

Needs the extra ``web``, playwright and chromium. ``--cost`` also prints what the page costs.
"""

from __future__ import annotations

import argparse
import shutil
import sys
import threading
import time
from pathlib import Path

ROOT = Path(__file__).parent.parent
sys.path.insert(0, str(ROOT))

import gazelle  # noqa: E402  of this checkout
from gazelle import assets  # noqa: E402
from gazelle.simulation import Simulation  # noqa: E402
from gazelle.viewer import LiveView  # noqa: E402

IMAGES = ROOT / "docs" / "images"
FLAGS = ["--no-sandbox", "--use-gl=angle", "--use-angle=swiftshader", "--enable-unsafe-swiftshader"]
NOTICES = ".mantine-Notifications-root { display: none }"  # of a browser without a graphics card


class Running:
    """A burger that drives about in real time, in a thread of its own."""

    def __init__(self) -> None:
        self.simulation = Simulation(assets.world("turtlebot3_world"), threads=1)
        robot = self.simulation.spawn("turtlebot3_burger", pose=gazelle.Pose(-2.0, -0.5))
        robot.inputs["cmd_vel"].send(linear=0.15, angular=0.1)
        self._over = threading.Event()
        self._thread = threading.Thread(target=self._run)
        self._thread.start()

    def _run(self) -> None:
        while not self._over.is_set():
            self.simulation.run(0.1, rate=1.0)

    def close(self) -> None:
        """Stop."""
        self._over.set()
        self._thread.join()
        self.simulation.close()


def cost(seconds: float = 6.0) -> float:
    """Share of a core that this process takes for a while."""
    begin, cpu = time.perf_counter(), time.process_time()
    time.sleep(seconds)
    return (time.process_time() - cpu) / (time.perf_counter() - begin)


def main() -> None:
    """Do it."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--cost", action="store_true", help="also measure what the page costs")
    args = parser.parse_args()
    from playwright.sync_api import sync_playwright

    running = Running()
    alone = cost() if args.cost else 0.0
    view = LiveView(running.simulation)
    if args.cost:
        print(f"nobody looks: {100 * (cost() - alone):.1f} % of a core")
    program = shutil.which("chromium") or "chromium"
    with sync_playwright() as player:
        browser = player.chromium.launch(executable_path=program, args=FLAGS)
        page = browser.new_page(viewport={"width": 1400, "height": 900})
        page.goto(view.url)
        page.wait_for_selector("canvas")
        page.get_by_label("Lidar rays").wait_for()
        if args.cost:
            time.sleep(3.0)
            print(f"one looks: {100 * (cost() - alone):.1f} % of a core")
        page.get_by_label("Lidar rays").click()
        page.get_by_label("Names").click()
        page.locator("[data-name=turtlebot3_burger]").click()
        page.get_by_label("Gizmo").click()
        page.get_by_role("button", name="pause").scroll_into_view_if_needed()
        time.sleep(8.0)
        page.screenshot(path=IMAGES / "live.png", style=NOTICES)
        browser.close()
    view.close()
    running.close()


if __name__ == "__main__":
    main()
