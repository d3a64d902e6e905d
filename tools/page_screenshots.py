"""Take pictures of both pages, of a simulation and of a graph, in a browser without a window.

    python tools/page_screenshots.py                       # writes docs/images/live.png and graph.png
    python tools/page_screenshots.py --to build/shots --size 1920x1080 --dark graph

Needs the extra ``web``, playwright and chromium. ``--cost`` also prints what a page costs.
"""

from __future__ import annotations

import argparse
import io
import shutil
import sys
import threading
import time
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from pathlib import Path
from typing import Any

ROOT = Path(__file__).parent.parent
sys.path.insert(0, str(ROOT))

import gazelle  # noqa: E402  of this checkout
from gazelle import assets  # noqa: E402
from gazelle.bridges import serve_ros  # noqa: E402
from gazelle.cli.description_publisher import publishing_descriptions  # noqa: E402
from gazelle.simulation import Simulation  # noqa: E402
from gazelle.viewer import LiveView  # noqa: E402
from gazelle.viewer.graph import GraphView  # noqa: E402
from gazelle_ros import Master  # noqa: E402

IMAGES = ROOT / "docs" / "images"
FLAGS = ["--no-sandbox", "--use-gl=angle", "--use-angle=swiftshader", "--enable-unsafe-swiftshader"]
NOTICES = ".mantine-Notifications-root { display: none }"  # of a browser without a graphics card
COLORS = 255  # of a picture, so that it stays small


@contextmanager
def running() -> Iterator[Simulation]:
    """Run a burger that drives about in real time, in a thread of its own."""
    over = threading.Event()
    with Simulation(assets.world("turtlebot3_world"), threads=1) as simulation:
        robot = simulation.spawn("turtlebot3_burger", pose=gazelle.Pose(-2.0, -0.5))
        robot.inputs["cmd_vel"].send(linear=0.1, angular=0.35)

        def run() -> None:
            while not over.is_set():
                simulation.run(0.1, rate=1.0)

        thread = threading.Thread(target=run)
        thread.start()
        try:
            yield simulation
        finally:
            over.set()
            thread.join()


@contextmanager
def live_view() -> Iterator[tuple[Callable[[], Any], Callable[[Any], None]]]:
    """Yield the opener of the page of a simulation, and what is clicked there."""

    def arrange(page: Any) -> None:
        page.get_by_label("Lidar rays").click()
        page.get_by_label("Names").click()
        page.locator("[data-name=turtlebot3_burger]").click()
        page.get_by_label("Gizmo").click()
        page.get_by_role("button", name="pause").scroll_into_view_if_needed()

    with running() as simulation:
        yield lambda: LiveView(simulation), arrange


@contextmanager
def graph_view() -> Iterator[tuple[Callable[[], Any], Callable[[Any], None]]]:
    """Yield the opener of the page of the graph of that simulation, and what is clicked there."""

    def arrange(page: Any) -> None:
        for title in ("Plot", "tf tree"):
            page.get_by_role("combobox", name="Open panel").click()
            page.get_by_role("option", name=title, exact=True).click()
            page.get_by_text(title, exact=True).first.wait_for()
        field = page.locator("xpath=//label[normalize-space()='Field']/following::input[1]")
        field.fill("/turtlebot3_burger/odom/pose/pose/position")
        field.press("Tab")
        page.get_by_role("button", name="Add", exact=True).click()

    with (
        Master("127.0.0.1", 0) as master,
        running() as simulation,
        serve_ros(simulation, master.uri) as server,
        publishing_descriptions(simulation, server),
    ):
        yield lambda: GraphView(master.uri), arrange


VIEWS = {"live": live_view, "graph": graph_view}


def cost(seconds: float = 6.0) -> float:
    """Share of a core that this process takes for a while."""
    begin, cpu = time.perf_counter(), time.process_time()
    time.sleep(seconds)
    return (time.process_time() - cpu) / (time.perf_counter() - begin)


def save(picture: bytes, file: Path) -> None:
    """Write a picture with few colours."""
    from PIL import Image

    file.parent.mkdir(parents=True, exist_ok=True)
    Image.open(io.BytesIO(picture)).convert("RGB").quantize(COLORS).save(file, optimize=True)


def take(name: str, args: argparse.Namespace) -> None:
    """Take the picture of a page."""
    from playwright.sync_api import sync_playwright

    with VIEWS[name]() as (open_view, arrange), sync_playwright() as player:
        alone = cost() if args.cost else 0.0
        with open_view() as view:
            if args.cost:
                print(f"{name}, nobody looks: {100 * (cost() - alone):.1f} % of a core")
            program = shutil.which("chromium") or "chromium"
            browser = player.chromium.launch(executable_path=program, args=FLAGS)
            wide, high = map(int, args.size.split("x"))
            page = browser.new_page(
                viewport={"width": wide, "height": high},
                color_scheme="dark" if args.dark else "light",
            )
            page.goto(view.url)
            page.wait_for_selector("canvas")
            page.get_by_label("Dark", exact=True).wait_for()
            if args.cost:
                time.sleep(3.0)
                print(f"{name}, one looks: {100 * (cost() - alone):.1f} % of a core")
            arrange(page)
            time.sleep(args.wait)
            save(page.screenshot(style=NOTICES), args.to / f"{name}.png")
            browser.close()


def main() -> None:
    """Do it."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("pages", nargs="*", choices=[[], *VIEWS], help="all by default")
    parser.add_argument("--cost", action="store_true", help="also measure what a page costs")
    parser.add_argument("--dark", action="store_true", help="in the dark theme")
    parser.add_argument("--size", default="1400x900", help="of the window [pixel]")
    parser.add_argument("--to", type=Path, default=IMAGES, help="folder of the pictures")
    parser.add_argument("--wait", type=float, default=8.0, help="before a picture [s]")
    args = parser.parse_args()
    for name in args.pages or VIEWS:
        take(name, args)


if __name__ == "__main__":
    main()
