"""The page of a graph in a browser, with a robot of one box, for tests."""

from contextlib import contextmanager, nullcontext

import numpy as np

from gazelle.viewer.graph import GraphView
from gazelle_ros import Master, Node, Time, WallClock, load_message
from tests.ros.graph import until
from tests.viewer.browser import opened

PANEL_PX = 330


def message(kind, **fields):
    return load_message(kind)(**fields)


class TalkingGraph:
    """A master, a node that says what tests want, and the page in a browser."""

    def __init__(self, view, node, page):
        self.view, self.node, self.page = view, node, page
        self.publishers = {}

    def say(self, topic, kind, frame=None, latch=True, **fields):
        """Publish a message, and return it."""
        made = message(kind, **fields)
        if frame is not None:
            made.header.frame_id = frame
        if topic not in self.publishers:
            self.publishers[topic] = self.node.advertise(topic, type(made), 10, latch=latch)
        self.publishers[topic].publish(made)
        return made

    def say_frames(self, **places):
        """Publish frames below map at (x, y) [m]."""
        sent = []
        for name, (x, y) in places.items():
            each = message("geometry_msgs/TransformStamped", child_frame_id=name)
            each.header.frame_id, each.header.stamp = "map", Time.from_sec(1.0)
            each.transform.translation.x, each.transform.translation.y = x, y
            each.transform.rotation.w = 1.0
            sent.append(each)
        self.say("/tf", "tf2_msgs/TFMessage", transforms=sent)

    def choose(self, label, option):
        """Choose an option of a dropdown."""
        self.page.get_by_role("combobox", name=label, exact=True).click()
        self.page.get_by_role("option", name=option, exact=True).click()

    def click(self, button):
        """Press a button of a panel."""
        self.page.get_by_role("button", name=button, exact=True).click()

    def box(self, label):
        """Return the text or number beside a label."""
        row = (
            f'//label[normalize-space()="{label}"]/ancestor::div[contains(@class, "Flex-root")][1]'
        )
        return self.page.locator(
            f"xpath={row}//*[self::textarea or self::input[not(@type) or @type='text']]"
        ).first

    def fill(self, label, text):
        """Fill in a text or number of a panel, and go on to the next."""
        self.box(label).fill(text)
        self.box(label).press("Tab")

    def wait_text(self, text):
        """Wait until the page has a text."""
        self.page.get_by_text(text).first.wait_for()

    def drag(self, start, end):
        """Drag over the scene, in pixels."""
        mouse = self.page.mouse
        mouse.move(*start)
        mouse.down()
        mouse.move(*end, steps=6)
        mouse.up()

    def pixels(self):
        """Return the scene beside the panel, (height, width, 3)."""
        import io

        from PIL import Image

        shot = Image.open(io.BytesIO(self.page.screenshot())).convert("RGB")
        return np.asarray(shot, np.int16)[:, :-PANEL_PX]

    def heard(self, topic, kind):
        """Return the list of messages that will come on a topic, once the page is connected."""
        got = []
        subscriber = self.node.subscribe(topic, load_message(kind), got.append)
        until(lambda: subscriber.num_connections > 0)
        return got


@contextmanager
def graph_page(size=(900, 480), master_uri=None):
    """Open the page of the graph of a master, by default of its own."""
    with nullcontext() if master_uri else Master("127.0.0.1", 0) as master:
        uri = master_uri or master.uri
        node = Node("talker", master_uri=uri, clock=WallClock())
        try:
            with GraphView(uri) as view, opened(view.url, size) as page:
                yield TalkingGraph(view, node, page)
        finally:
            node.close()
