"""Frames: what ``relative_to`` and ``attached_to`` mean, resolved to plain poses.

The rules are those of SDFormat's specification "Pose frame semantics" (sdformat.org).
"""

from __future__ import annotations

from dataclasses import dataclass, field

from gazelle.description import Parameters, Pose
from gazelle.errors import did_you_mean
from gazelle.formats import values
from gazelle.formats.reading import Reading

MODEL = "__model__"
WORLD = "world"
ANY = "*"

_IDENTITY = Pose()


@dataclass(frozen=True, slots=True)
class NamedFrame:
    """One named frame of a scope.

    Attributes:
        node: The element, for errors.
        pose: As written.
        relative_to: The frame that the pose is written in.
        attached_to: The frame it moves with; empty for links and models, which move by
            themselves.
        scope: The frames inside, of a nested model.
    """

    node: Parameters
    pose: Pose
    relative_to: str = ""
    attached_to: str = ""
    scope: Scope | None = None


@dataclass(slots=True)
class Scope:
    """All frames of one model or world, by name.

    Attributes:
        owner: Word for the scope's own frame: ``__model__`` or ``world``.
        canonical: The link that stands for the scope, scoped by ``::``.
        name: Of the model.
        reading: Takes faults, such as a pose in a frame that is not there; without one these
            are errors.
        missing: Names of included models that were not found; an empty one where the
            include gives no name, so that it could be any; ``ANY`` where it would have
            been merged, so that any name could be of it.
        entries: Links, joints, frames and nested models.
    """

    owner: str
    canonical: str = ""
    name: str = ""
    reading: Reading | None = None
    missing: set[str] = field(default_factory=set)
    entries: dict[str, NamedFrame] = field(default_factory=dict)
    _resolved: dict[str, Pose] = field(default_factory=dict)
    _open: dict[str, None] = field(default_factory=dict)
    _links: dict[str, str] = field(default_factory=dict)

    def add(self, name: str, entry: NamedFrame) -> None:
        """Add a frame; a link, joint and frame may share a name, which means the first.

        Raises:
            FormatError: Another of the same kind has the name.
        """
        taken = self.entries.get(name)
        if taken is None:
            self.entries[name] = entry
            return
        other = taken.node
        if other.tag == entry.node.tag or _is_model(other) == _is_model(entry.node) is True:
            line = other.source.line if other.source else None
            raise values.fail(
                entry.node,
                f"the name '{name}' is already taken by the <{other.tag}> in line {line}",
            )

    def pose(self, name: str, node: Parameters) -> Pose:
        """Return the pose of a frame in the frame of this scope.

        Raises:
            FormatError: Its poses lead in a circle; without a reading also when there is no such
            frame.
        """
        chain: list[tuple[str, NamedFrame]] = []
        try:
            base = self._climb(name, node, chain)
        finally:
            for step, _ in chain:
                del self._open[step]
        for step, entry in reversed(chain):
            base = entry.pose if base is _IDENTITY else base * entry.pose
            self._resolved[step] = base
        return base

    def _climb(self, name: str, node: Parameters, chain: list[tuple[str, NamedFrame]]) -> Pose:
        """Resolve frames up to one with a known pose; the chain collects those between."""
        while True:
            name = self.own(name)
            if name in {"", self.owner} or self.lacks(name):
                return _IDENTITY  # a missing include is already reported
            if name in self._resolved:
                return self._resolved[name]
            if name in self._open:
                steps = list(self._open)
                circle = " -> ".join([*steps[steps.index(name) :], name])
                raise values.fail(node, f"the poses form a cycle: {circle}")
            entry = self.entries.get(name)
            if entry is None:
                return self._resolve_inner(name, node)
            chain.append((name, entry))
            self._open[name] = None
            name, node = entry.relative_to, entry.node

    def _resolve_inner(self, name: str, node: Parameters) -> Pose:
        """Return a pose in a nested model, by a name scoped by ``::``.

        The parts of the name may hold ``::`` themselves.
        """
        parts = name.split("::")
        for count in range(len(parts) - 1, 0, -1):
            outer = self.entries.get("::".join(parts[:count]))
            if outer is not None and outer.scope is not None:
                inner = outer.scope.pose("::".join(parts[count:]), node)
                return self.pose("::".join(parts[:count]), node) * inner
        message = f"there is no frame '{name}' here"
        hint = did_you_mean(name, self.entries)
        if self.reading is None:
            raise values.fail(node, message, hint=hint)
        own = "world" if self.owner == WORLD else "model"
        self.reading.fault(f"{message}: that of the {own} was taken", node, hint)
        return _IDENTITY

    def lacks(self, name: str) -> bool:
        """Return whether the name leads into an included model that was not found."""
        head, _, rest = name.partition("::")
        if not self.missing or head in self.entries:
            return False
        if ANY in self.missing:
            return name != self.name
        unnamed = "" in self.missing and bool(rest) and head != self.name
        return head in self.missing or unnamed or (head == self.name and self.lacks(rest))

    def own(self, name: str) -> str:
        """Return the name without that of this model before it, which old files write."""
        if name in self.entries:
            return name
        head, separator, rest = name.partition("::")
        return rest if separator and head == self.name and head not in self.entries else name

    def has(self, name: str) -> bool:
        """Return whether the name leads to a frame of this scope or of a nested model."""
        name = self.own(name)
        if name in self.entries:
            return True
        head, _, rest = name.partition("::")
        outer = self.entries.get(head)
        if outer is not None and outer.scope is not None and rest:
            return rest == MODEL or outer.scope.has(rest)
        return False

    def link_of(self, name: str, node: Parameters) -> str:
        """Return the link (or nested model's link) that a frame moves with; empty for the scope.

        Raises:
            FormatError: There is no such frame, or the frames are attached in a circle.
        """
        seen: dict[str, None] = {}
        link = self._follow(self.own(name), node, seen)
        self._links.update(dict.fromkeys(seen, link))
        return link

    def _follow(self, name: str, node: Parameters, seen: dict[str, None]) -> str:
        while name not in {"", self.owner}:
            if name in self._links:
                return self._links[name]
            if name in seen:
                steps = list(seen)
                circle = " -> ".join([*steps[steps.index(name) :], name])
                raise values.fail(node, f"the attached frames form a cycle: {circle}")
            seen[name] = None
            entry = self.entries.get(name)
            if entry is None:
                self.pose(name, node)
                return self._inner_link(name, node) if self.has(name) else ""
            if entry.node.tag not in {"frame", "joint"}:
                return name
            name = entry.attached_to
        return ""

    def body_of(self, name: str, node: Parameters) -> str:
        """Return the same as ``link_of``, with a model's canonical link for the model.

        Raises:
            FormatError: As ``link_of``; or the model has no link.
        """
        link = self.link_of(name, node)
        scope = self.scope_of(link)
        if scope is None:
            return link
        if not scope.canonical:
            raise values.fail(node, f"the model '{name}' has no link")
        return f"{link}::{scope.canonical}" if link else scope.canonical

    def scope_of(self, name: str) -> Scope | None:
        """Return the scope of a name, if it is that of a model; itself for no name."""
        if not name:
            return self
        entry = self.entries.get(name)
        if entry is not None:
            return entry.scope
        head, _, rest = name.partition("::")
        outer = self.entries.get(head)
        return None if outer is None or outer.scope is None else outer.scope.scope_of(rest)

    def _inner_link(self, name: str, node: Parameters) -> str:
        head, _, rest = name.partition("::")
        outer = self.entries.get(head)
        if outer is None or outer.scope is None or not rest:
            return name
        inner = outer.scope.link_of(rest, node)
        return f"{head}::{inner}" if inner else head


def _is_model(node: Parameters) -> bool:
    return node.tag in {"model", "include"}
