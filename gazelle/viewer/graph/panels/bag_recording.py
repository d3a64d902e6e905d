"""Recording of topics into a bag, by controls of the bag's panel."""

from __future__ import annotations

import threading
import time
from typing import Any

from gazelle.errors import Error
from gazelle.viewer.graph.context import GraphContext
from gazelle_ros.bags.recording import BagRecorder, RecordOptions


class BagRecording:
    """Controls that record chosen topics, or all, as ``rosbag record``.

    A recording goes on while no page is open, and ends with the panel.

    Args:
        context: Of the page.

    Attributes:
        inputs: Controls for a saved layout, by name.
    """

    def __init__(self, context: GraphContext) -> None:
        self._context = context
        self._stop, self._began = threading.Event(), 0.0
        self._thread: threading.Thread | None = None
        self._recorder: BagRecorder | None = None
        self._result = ""
        gui = context.gui
        with gui.add_folder("Record"):
            topics = gui.add_text("Topics", "", hint="Names with spaces between; all if empty")
            file = gui.add_text("File", "", hint="Path on this machine; by date and time if empty")
            buttons = gui.add_button_group("Bag", ("Record", "End"))
            self._text: Any = gui.add_markdown("")
        self.inputs: dict[str, Any] = {"topics": topics, "recorded": file}
        buttons.on_click(lambda event: context.guarded(lambda: self._press(event.target.value)))

    def refresh(self) -> None:
        """Show for how long it records, or where the bag is."""
        text = self._result
        if self._thread is not None and self._thread.is_alive():
            text = f"recording for {time.monotonic() - self._began:.0f} s"
        if self._text.content != text:
            self._text.content = text

    def end(self) -> None:
        """End the recording."""
        self._stop.set()
        if self._thread is not None:
            self._thread.join()
            self._thread = None

    def _press(self, button: str) -> None:
        running = self._thread is not None and self._thread.is_alive()
        if button == "Record" and running:
            raise Error("a bag is recorded already", hint="end it first")
        self.end()
        if button == "Record":
            self._begin()

    def _begin(self) -> None:
        topics = self.inputs["topics"].value.split()
        options = RecordOptions(
            topics=topics, all_topics=not topics, name=self.inputs["recorded"].value.strip()
        )
        self._stop, self._began = threading.Event(), time.monotonic()
        self._recorder = BagRecorder(self._context.node, options, lambda _line: None)
        self._thread = threading.Thread(target=self._record, name="bag-recorder", daemon=True)
        self._thread.start()

    def _record(self) -> None:
        recorder = self._recorder
        if recorder is None:
            return
        try:
            recorder.run(self._stop)
            self._result = (
                f"recorded in {', '.join(str(file.absolute()) for file in recorder.files)}"
            )
        except Error as error:
            self._result = f"⚠ {error}"
