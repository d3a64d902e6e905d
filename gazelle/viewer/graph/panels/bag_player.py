"""Bag player and recorder, as rqt_bag."""

from __future__ import annotations

import threading
from collections.abc import Sequence
from typing import Any

from gazelle.errors import Error
from gazelle.viewer.graph.context import GraphContext
from gazelle.viewer.graph.panels.bag_recording import BagRecording
from gazelle.viewer.graph.panels.markup import table
from gazelle.viewer.graph.panels.panel import GraphPanel
from gazelle_ros.bags import Bag
from gazelle_ros.bags.playing import Player, PlayOptions
from gazelle_ros.base.path_texts import existing_file


class BagPlayerPanel(GraphPanel):
    """Publishes what a bag of this machine holds, and records others.

    Args:
        context: Of the page.
    """

    title = "Bag player"
    period = 0.25

    def __init__(self, context: GraphContext) -> None:
        super().__init__(context)
        self._player: Player | None = None
        self._thread: threading.Thread | None = None
        self._stop = threading.Event()
        self._state, self._passed, self._length = "", 0.0, 0.0
        self._failure = ""

    def build(self) -> None:
        """Add file, options, buttons and the list of topics."""
        gui, context = self.context.gui, self.context
        self._file: Any = gui.add_text("Bag", "", hint="Path on this machine")
        self._rate: Any = gui.add_number("Rate", 1.0, min=0.01, max=100.0, step=0.1)
        self._start: Any = gui.add_number("Start [s]", 0.0, min=0.0, step=0.01)
        self._loop: Any = gui.add_checkbox("Loop", initial_value=False)
        self._clock: Any = gui.add_checkbox("Publish /clock", initial_value=False)
        buttons = gui.add_button_group("Play", ("Play", "Pause", "Step", "Stop"))
        buttons.on_click(lambda event: context.guarded(lambda: self._press(event.target.value)))
        self._progress: Any = gui.add_progress_bar(0.0)
        self._text: Any = gui.add_markdown("")
        self._topics: Any = gui.add_html("")
        context.on_user_change(self._file, self._list)
        self._recording = BagRecording(context)
        self.inputs = self._recording.inputs | {
            "file": self._file, "rate": self._rate, "start": self._start, "loop": self._loop,
            "clock": self._clock,
        }  # fmt: skip

    def use(self, arguments: Sequence[str]) -> None:
        """Open the bag of a command line."""
        self._file.value = next((word for word in arguments if not word.startswith("-")), "")
        self.context.guarded(self._list)

    def refresh(self) -> None:
        """Show how far it is."""
        self._recording.refresh()
        playing = self._thread is not None and self._thread.is_alive()
        text = (
            f"{self._passed:.1f} of {self._length:.1f} s, {self._state.lower()}" if playing else ""
        )
        self._text.content = f"⚠ {self._failure}" if self._failure else text
        share = min(100.0 * self._passed / self._length, 100.0) if self._length > 0.0 else 0.0
        self._progress.value = share if playing else 0.0

    def pause(self) -> None:
        """Stop playing: no page is open."""
        self._end()

    def close(self) -> None:
        """Stop playing and recording."""
        self._recording.end()
        self._end()

    def _list(self) -> None:
        """List the topics of the bag."""
        with Bag(str(existing_file(self._file.value))) as bag:
            self._length = bag.get_end_time() - bag.get_start_time()
            found = bag.get_type_and_topic_info().topics
        rows = [
            ((name, each.msg_type, str(each.message_count)), "") for name, each in found.items()
        ]
        self._topics.content = table(("Topic", "Type", "Messages"), rows, ("Topic", "Type"), 240)

    def _press(self, button: str) -> None:
        player = self._player
        if button == "Stop":
            self._end()
        elif button == "Play" and player is None:
            self._begin()
        elif player is not None and button == "Step":
            player.step()
        elif player is not None and (button == "Pause") == (self._state != "PAUSED"):
            player.toggle()

    def _begin(self) -> None:
        """Play from the start.

        Raises:
            Error: There is no such bag.
        """
        self._list()
        options = PlayOptions(
            rate=float(self._rate.value), start=float(self._start.value), loop=self._loop.value,
            clock=self._clock.value,
        )  # fmt: skip
        path = str(existing_file(self._file.value))
        self._failure, self._stop = "", threading.Event()
        self._player = Player(self.context.node, [path], options, self._show)
        self._thread = threading.Thread(target=self._play, name="bag-player", daemon=True)
        self._thread.start()

    def _play(self) -> None:
        player = self._player
        if player is None:
            return
        try:
            player.play(self._stop)
        except Error as error:
            self._failure = str(error)
        finally:
            player.close()
            self._player = None

    def _show(self, state: str, _now: float, passed: float) -> None:
        self._state, self._passed = state, passed + float(self._start.value)

    def _end(self) -> None:
        self._stop.set()
        if self._thread is not None:
            self._thread.join()
            self._thread = None
