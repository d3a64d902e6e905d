"""``<experimental:params>`` of an ``<include>``: changes to the included model, as in libsdformat.

Each element in it names one of the included model by its tag and by ``element_id``, its name after
those of what it is in (``arm::wrist::camera``), and selects with ``action`` one of:

    add       it becomes a part of what ``element_id`` names (the model where that is empty)
    remove    the one named goes; with children, only those of its parts go
    replace   it stands in the place of the one named
    modify    its attributes, text and parts are set in the one named; an empty part gets its default

Without an ``action`` each of its children has one, and is added to, removed from and so on the one
named. What cannot be done is left out with a fault. See http://sdformat.org/tutorials?tut=param_passing_proposal.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator
from dataclasses import dataclass, replace

from gazelle.description import Parameters
from gazelle.errors import did_you_mean
from gazelle.formats.reading import Reading
from gazelle.formats.sdf import schema

TAG = "experimental:params"
_ACTIONS = ("add", "modify", "remove", "replace")
_OWN = {"action", "element_id"}
_ITSELF = "__model__"
"""``element_id`` of a model that a parameter of a model around it changes."""
_OF_INCLUDE = {"pose", "static"}
"""Elements that an include sets for its model, rather than the model's own file."""

Parts = tuple[Parameters, ...]
Change = Callable[[Parameters, str], Parts]
"""From an element and its kind in the schema to what stands in its place."""


def with_params(
    model: Parameters, include: Parameters, reading: Reading, name_of: Callable[[Parameters], str]
) -> Parameters:
    """Return a model, light or actor with the changes of its include's parameters.

    Args:
        model: The element, as its own file has it.
        include: Including element.
        reading: Takes what cannot be done as faults.
        name_of: The name of the included model of an ``<include>`` in the model.
    """
    passing = _Passing(reading, name_of)
    for params in include.find_all(TAG):
        for entry in params.children:
            model = passing.applied(model, entry)
    return model


@dataclass(frozen=True, slots=True)
class _Passing:
    reading: Reading
    name_of: Callable[[Parameters], str]

    def applied(self, model: Parameters, entry: Parameters) -> Parameters:
        """Return the model with one element changed; unchanged where that is impossible."""
        path = entry.attributes.get("element_id")
        if path is None:
            return self._left(model, entry, "it has no 'element_id' that says what it changes")
        if path.endswith("::"):
            return self._left(model, entry, f"'{path}' lacks the name after the last '::'")
        action = entry.attributes.get("action", "")
        if "action" in entry.attributes and action not in _ACTIONS:
            return self._unknown(model, entry, action)
        if action == "add":
            return self._added(model, entry, path)
        return self._at(model, path, entry.tag, entry, self._change(entry, action))

    def _added(self, model: Parameters, entry: Parameters, path: str) -> Parameters:
        name = entry.attributes.get("name", "")
        if not name:
            return self._left(model, entry, "what is added needs a 'name'")
        holder = "" if path == _ITSELF else path
        full = f"{holder}::{name}" if holder else name
        if entry.tag != "plugin" and next(self._reached(model, full, entry.tag), None) is not None:
            return self._left(model, entry, f"there is a <{entry.tag}> '{full}' already")
        part = _plain(entry)
        if not holder:
            return replace(model, children=(*model.children, part))
        return self._at(
            model,
            path,
            "",
            entry,
            lambda node, _: (replace(node, children=(*node.children, part)),),
        )

    def _change(self, entry: Parameters, action: str) -> Change:
        """Return the change that an element makes to the element it names."""
        if action == "remove":
            return lambda node, _: self._without(node, entry)
        if action == "replace":
            return lambda node, _: self._instead(node, entry)
        if action == "modify":
            return lambda node, kind: (self._modified(node, entry, kind),)
        return lambda node, kind: (self._changed_inside(node, entry, kind),)

    # The element that is named.

    def _at(
        self, model: Parameters, path: str, tag: str, entry: Parameters, change: Change
    ) -> Parameters:
        if path == _ITSELF:
            (changed,) = change(model, model.tag) or (model,)
            return changed
        found = self._replaced(model, model.tag, path, tag, entry, change)
        if found is not None:
            return found
        what = f"<{tag}>" if tag else "element"
        hint = did_you_mean(path, _names(model, tag)) or None
        self.reading.fault(f"the included model has no {what} '{path}': left out", entry, hint)
        return model

    def _replaced(
        self,
        node: Parameters,
        kind: str,
        path: str,
        tag: str,
        entry: Parameters,
        change: Change,
    ) -> Parameters | None:
        """Return the element with the target of a path changed; None without a target."""
        for index, child, rest in self._steps(node, path):
            new: Parts | None
            if child.tag == "include":
                new = self._passed_on(child, entry, rest)
            elif rest:
                deeper = _kind(kind, child.tag)
                inner = self._replaced(child, deeper, rest, tag, entry, change)
                new = None if inner is None else (inner,)
            else:
                new = change(child, _kind(kind, child.tag)) if tag in {"", child.tag} else None
            if new is not None:
                before, after = node.children[:index], node.children[index + 1 :]
                return replace(node, children=(*before, *new, *after))
        return None

    def _reached(self, node: Parameters, path: str, tag: str) -> Iterator[Parameters]:
        """Yield the elements that a path leads to without going into other files."""
        for _, child, rest in self._steps(node, path):
            if rest:
                yield from self._reached(child, rest, tag)
            elif child.tag == tag:
                yield child

    def _steps(self, node: Parameters, path: str) -> list[tuple[int, Parameters, str]]:
        """Return the next children of a path: index, child, rest of the path.

        Longest names first.
        """
        found = []
        for index, child in enumerate(node.children):
            name = self._name(child)
            if name and path == name:
                found.append((index, child, ""))
            elif name and path.startswith(f"{name}::"):
                found.append((index, child, path[len(name) + 2 :]))
        return sorted(found, key=lambda step: len(step[2]))

    def _name(self, node: Parameters) -> str:
        return self.name_of(node) if node.tag == "include" else node.attributes.get("name", "")

    def _passed_on(self, include: Parameters, entry: Parameters, rest: str) -> Parts | None:
        """Return an include within the included model; the change is made when that is read."""
        action = entry.attributes.get("action", "")
        if not rest and action in {"remove", "replace"} and entry.tag == "model":
            return () if action == "remove" else (_plain(entry),)
        if not rest and entry.tag == "model" and action != "add":
            own = {child.tag for child in include.children} & _OF_INCLUDE
            here = tuple(child for child in entry.children if child.tag in own)
            kept = tuple(child for child in entry.children if child.tag not in own)
            if here:
                part = replace(entry, children=here, attributes=_without_name(entry))
                (include,) = self._change(part, action)(include, "include")
            entry = replace(entry, children=kept)
            if here and not kept:
                return (include,)
        elif not rest and action != "add":
            return None
        target = rest or (_ITSELF if action != "add" else "")
        entry = replace(entry, attributes={**entry.attributes, "element_id": target})
        params = Parameters(TAG, children=(entry,), source=entry.source)
        return (replace(include, children=(*include.children, params)),)

    # What becomes of it.

    def _changed_inside(self, node: Parameters, entry: Parameters, kind: str) -> Parameters:
        """Return the element with the actions of the entry's children applied."""
        for child in entry.children:
            action = child.attributes.get("action", "")
            if action not in _ACTIONS:
                node = self._unknown(node, child, action)
            elif action == "add":
                node = replace(node, children=(*node.children, _plain(child)))
            elif action == "modify":
                node = self._part_modified(node, child, kind)
            else:
                index = self._find(node, child)
                new = node.children[index] if index is not None else None
                if index is None or new is None:
                    node = self._left(node, child, f"<{node.tag}> has no such <{child.tag}>")
                    continue
                parts = self._change(child, action)(new, "")
                before, after = node.children[:index], node.children[index + 1 :]
                node = replace(node, children=(*before, *parts, *after))
        return node

    def _without(self, node: Parameters, entry: Parameters) -> Parts:
        """Return nothing, or the element without some of its parts."""
        if not entry.children:
            return ()
        for child in entry.children:
            index = self._find(node, child)
            if index is None:
                self._left(node, child, f"<{node.tag}> has no such <{child.tag}>")
                continue
            node = replace(node, children=(*node.children[:index], *node.children[index + 1 :]))
        return (node,)

    def _instead(self, node: Parameters, entry: Parameters) -> Parts:
        if "name" in node.attributes and not entry.attributes.get("name"):
            return (self._left(node, entry, f"what replaces a <{node.tag}> needs a 'name'"),)
        return (_plain(entry),)

    def _modified(self, node: Parameters, entry: Parameters, kind: str) -> Parameters:
        node = self._with_attributes(node, entry, kind)
        if entry.text:
            return replace(node, text=entry.text)
        for child in entry.children:
            node = self._part_modified(node, child, kind)
        return node

    def _part_modified(self, node: Parameters, entry: Parameters, kind: str) -> Parameters:
        index = self._find(node, entry, renaming=True)
        if index is None:
            return self._left(node, entry, f"<{node.tag}> has no such <{entry.tag}>")
        part, deeper = node.children[index], _kind(kind, entry.tag)
        if entry.text or entry.children:
            part = self._modified(part, entry, deeper)
        elif part.children:
            self.reading.note(f"this changes nothing in <{entry.tag}>", entry)
        else:
            default = schema.types().get(deeper, {}).get("default", "")
            part = replace(self._with_attributes(part, entry, deeper), text=default)
        return replace(node, children=(*node.children[:index], part, *node.children[index + 1 :]))

    def _with_attributes(self, node: Parameters, entry: Parameters, kind: str) -> Parameters:
        changed = dict(node.attributes)
        known = schema.types().get(kind, {}).get("attributes")
        for name, text in entry.attributes.items():
            if name in _OWN:
                continue
            if known is None or name in known or name in changed or ":" in name:
                changed[name] = text
            else:
                hint = did_you_mean(name, known)
                self.reading.fault(f"<{node.tag}> has no attribute '{name}': left out", entry, hint)
        return replace(node, attributes=changed)

    def _find(self, node: Parameters, part: Parameters, *, renaming: bool = False) -> int | None:
        """Return the index of a part's child: by tag and name, else the first of the tag."""
        alike = [i for i, child in enumerate(node.children) if child.tag == part.tag]
        name = part.attributes.get("name")
        if name is None or not alike:
            return alike[0] if alike else None
        named = [i for i in alike if node.children[i].attributes.get("name") == name]
        return named[0] if named else alike[0] if renaming else None

    # What is not done.

    def _left(self, node: Parameters, entry: Parameters, reason: str) -> Parameters:
        self.reading.fault(f"{reason}: left out", entry)
        return node

    def _unknown(self, node: Parameters, entry: Parameters, action: str) -> Parameters:
        text = f"'{action}' is not an action" if action else "an 'action' is needed here"
        hint = did_you_mean(action, _ACTIONS) if action else f"one of {', '.join(_ACTIONS)}"
        self.reading.fault(f"{text}: left out", entry, hint)
        return node


def _plain(entry: Parameters) -> Parameters:
    """Return a part of the parameters as it stands in the model."""
    kept = {name: text for name, text in entry.attributes.items() if name not in _OWN}
    return replace(entry, attributes=kept)


def _without_name(entry: Parameters) -> dict[str, str]:
    return {name: text for name, text in entry.attributes.items() if name != "name"}


def _kind(kind: str, tag: str) -> str:
    """Return the kind of a child in the schema; empty without one."""
    known = schema.types().get(kind, {}).get("children", {}).get(tag)
    return str(known[0]) if known else ""


def _names(node: Parameters, tag: str) -> set[str]:
    """Return the paths of all elements of a tag, or of all with a name."""
    found = set()
    for child in node.children:
        name = child.attributes.get("name", "")
        if name and tag in {"", child.tag}:
            found.add(name)
        if name:
            found |= {f"{name}::{inner}" for inner in _names(child, tag)}
    return found
