"""interactive_markers: markers and menus that people use in a viewer."""

import importlib

import pytest
from graph import until


@pytest.fixture
def messages(node):
    return importlib.import_module("visualization_msgs.msg")


@pytest.fixture
def server(node):
    module = importlib.import_module("interactive_markers.interactive_marker_server")
    return module.InteractiveMarkerServer("shop")


@pytest.fixture
def updates(node, messages, server):
    """Return what a viewer is told, without the signs of life."""
    found = []
    kind = messages.InteractiveMarkerUpdate
    node.Subscriber(
        "shop/update", kind, lambda each: found.append(each) if each.type == kind.UPDATE else None
    )
    until(server.update_pub.get_num_connections)
    return found


def marker(messages, name):
    made = messages.InteractiveMarker(name=name)
    made.header.frame_id = "base_link"
    return made


def pose(x):
    made = importlib.import_module("geometry_msgs.msg").Pose()
    made.position.x = x
    return made


def test_changes_are_published_when_they_are_applied(messages, server, updates):
    server.insert(marker(messages, "x"))
    assert server.get("x").name == "x"
    assert server.getNames() == []
    assert not server.setPose("x", pose(1.0))  # nobody has seen it yet
    server.applyChanges()
    server.applyChanges()  # nothing is left
    assert server.getNames() == ["x"]
    assert server.setPose("x", pose(2.0))
    assert server.get("x").pose.position.x == 2.0
    server.applyChanges()
    assert server.erase("x")
    assert server.get("x") is None
    assert not server.erase("nobody")
    server.applyChanges()
    until(lambda: len(updates) == 3)
    assert [len(each.markers) for each in updates] == [1, 0, 0]
    assert [(each.name, each.pose.position.x) for each in updates[1].poses] == [("x", 2.0)]
    assert updates[1].poses[0].header.frame_id == "base_link"
    assert list(updates[2].erases) == ["x"]
    assert [each.seq_num for each in updates] == [1, 2, 3]
    assert updates[0].server_id == "/probe"


def test_who_comes_later_is_told_all_markers(node, messages, server):
    for name in ("x", "y"):
        server.insert(marker(messages, name))
    server.applyChanges()
    found = []
    node.Subscriber("shop/update_full", messages.InteractiveMarkerInit, found.append)
    until(lambda: found)
    assert [each.name for each in found[-1].markers] == ["x", "y"]
    server.clear()
    server.applyChanges()
    until(lambda: not found[-1].markers)


def test_feedback_calls_the_function_of_its_kind(messages, server):
    kind, called = messages.InteractiveMarkerFeedback, []
    server.insert(marker(messages, "x"), lambda feedback: called.append(("usual", feedback)))
    assert server.setCallback(
        "x", lambda feedback: called.append(("click", feedback)), kind.BUTTON_CLICK
    )
    assert not server.setCallback("nobody", None)
    server.applyChanges()
    for event in (kind.MOUSE_DOWN, kind.BUTTON_CLICK):
        server.processFeedback(kind(marker_name="x", event_type=event, client_id="one"))
    server.processFeedback(kind(marker_name="nobody", event_type=kind.BUTTON_CLICK))
    assert [name for name, _ in called] == ["usual", "click"]
    moved = kind(marker_name="x", event_type=kind.POSE_UPDATE, client_id="one", pose=pose(7.0))
    server.processFeedback(moved)
    assert server.get("x").pose.position.x == 7.0
    server.processFeedback(kind(marker_name="x", event_type=kind.BUTTON_CLICK, client_id="two"))
    assert len(called) == 3  # the other client has it for a second


def test_feedback_comes_by_its_topic(node, messages, server):
    kind, called = messages.InteractiveMarkerFeedback, []
    server.insert(marker(messages, "x"), called.append)
    server.applyChanges()
    publisher = node.Publisher("shop/feedback", kind, queue_size=1)
    until(publisher.get_num_connections)
    publisher.publish(kind(marker_name="x", event_type=kind.MOUSE_UP))
    until(lambda: called)
    assert called[0].event_type == kind.MOUSE_UP


def test_menus_have_entries_boxes_and_functions(messages, server):
    handler = importlib.import_module("interactive_markers.menu_handler").MenuHandler
    menu, chosen = handler(), []
    first = menu.insert("First", callback=chosen.append)
    below = menu.insert("Below", parent=first, callback=chosen.append)
    hidden = menu.insert("Hidden")
    assert menu.setCheckState(first, handler.CHECKED)
    assert menu.setVisible(hidden, False)
    assert menu.insert("Lost", parent=99) is None
    assert (menu.getTitle(below), menu.getCheckState(first), menu.getTitle(99)) == (
        "Below",
        1,
        None,
    )
    assert not menu.apply(server, "x")
    server.insert(marker(messages, "x"))
    assert menu.apply(server, "x")
    server.applyChanges()
    entries = server.get("x").menu_entries
    assert [(each.id, each.parent_id, each.title) for each in entries] == [
        (first, 0, "[x] First"),
        (below, first, "Below"),
    ]
    menu.setCheckState(first, handler.UNCHECKED)
    assert menu.reApply(server)
    server.applyChanges()
    assert server.get("x").menu_entries[0].title == "[ ] First"
    kind = messages.InteractiveMarkerFeedback
    for entry in (below, 99):
        server.processFeedback(
            kind(marker_name="x", event_type=kind.MENU_SELECT, menu_entry_id=entry)
        )
    assert [each.menu_entry_id for each in chosen] == [below]
