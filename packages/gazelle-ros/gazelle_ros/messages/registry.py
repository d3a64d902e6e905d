"""Find definitions by name, and keep the classes made from them.

A definition is looked for among those registered by the user, then in the packages on
ROS_PACKAGE_PATH, then among those that come with Gazelle.
"""

from __future__ import annotations

import functools
import threading
from collections.abc import Callable, Iterator, Mapping

from gazelle_ros.base.errors import did_you_mean
from gazelle_ros.messages import search
from gazelle_ros.messages.base import Message, ServiceDefinition
from gazelle_ros.messages.digest import full_text, message_md5, service_md5, split_full_text
from gazelle_ros.messages.errors import InvalidDefinitionError, UnknownTypeError
from gazelle_ros.messages.generate import message_class, service_class
from gazelle_ros.messages.library import (
    Definition,
    PackageDefinitions,
    bundled,
    bundled_packages,
)
from gazelle_ros.messages.parse import MOST_ELEMENTS, parse_message, parse_service
from gazelle_ros.messages.spec import BUILTIN, MessageSpec, ServiceSpec

_HALVES = ("Request", "Response")


class Registry:
    """Classes by type name, made at first access.

    Args:
        find: Gives what a package defines, from the first source that has it: an iterator over
            all sources, best first.
    """

    def __init__(self, find: Callable[[str], Iterator[PackageDefinitions]]) -> None:
        self._find = find
        self._messages: dict[str, type[Message]] = {}
        self._sizes: dict[str, int] = {}
        self._services: dict[str, type[ServiceDefinition]] = {}
        self._making: list[str] = []
        self._lock = threading.RLock()

    def message(self, name: str) -> type[Message]:
        """Return the class of a message type.

        Raises:
            UnknownTypeError: There is no definition of it, or of a type in it.
            InvalidDefinitionError: A definition is malformed, or contains itself.
        """
        name = {"Header": "std_msgs/Header", "roslib/Header": "std_msgs/Header"}.get(name, name)
        made = self._messages.get(name)
        if made is not None:
            return made
        with self._lock:
            return self._messages.get(name) or self._make_message(name)

    def service(self, name: str) -> type[ServiceDefinition]:
        """Return the class of a service type.

        Raises:
            UnknownTypeError: There is no definition of it, or of a type in it.
            InvalidDefinitionError: A definition is malformed.
        """
        made = self._services.get(name)
        if made is not None:
            return made
        with self._lock:
            return self._services.get(name) or self._make_service(name)

    def forget(self, name: str) -> None:
        """Remove the classes of a type and of all that contain it."""
        with self._lock:
            stale = {name} | {f"{name}{half}" for half in _HALVES}
            for each, made in list(self._messages.items()):
                if each in stale or stale.intersection(_known_of(made)):
                    del self._messages[each]
                    stale.add(each)
            for each, service in list(self._services.items()):
                halves = service._request_class, service._response_class
                if each in stale or any(self._messages.get(h._type) is not h for h in halves):
                    del self._services[each]

    def _make_message(self, name: str) -> type[Message]:
        definition = self._definition(name, "messages")
        if definition is not None:
            spec = parse_message(name, definition.text, file=definition.file)
            return self._from_spec(spec, "msg")
        for half in _HALVES:
            service = name.removesuffix(half)
            if service != name and self._definition(service, "services") is not None:
                self.service(service)
                return self._messages[name]
        raise self._unknown(name, "messages")

    def _make_service(self, name: str) -> type[ServiceDefinition]:
        definition = self._definition(name, "services")
        if definition is None:
            raise self._unknown(name, "services")
        spec: ServiceSpec = parse_service(name, definition.text, file=definition.file)
        request = self._from_spec(spec.request, "srv")
        response = self._from_spec(spec.response, "srv")
        made = self._services[name] = service_class(
            spec,
            md5sum=service_md5(spec, self._md5_of),
            full_text=spec.text,
            request=request,
            response=response,
        )
        return made

    def _from_spec(self, spec: MessageSpec, module: str) -> type[Message]:
        if spec.full_name in self._making:
            cycle = " > ".join([*self._making, spec.full_name])
            raise InvalidDefinitionError(f"a message cannot contain itself: {cycle}")
        self._making.append(spec.full_name)
        try:
            known: dict[str, type[Message]] = {}
            for each in spec.depends:
                inner = self._part_of(spec, each)
                known |= {each: inner, **_known_of(inner)}
        finally:
            self._making.pop()
        self._sizes[spec.full_name] = self._size_of(spec)
        made = self._messages[spec.full_name] = message_class(
            spec,
            md5sum=message_md5(spec, self._md5_of),
            full_text=full_text(spec, lambda name: known[name]._spec),
            known=known,
            module=module,
        )
        return made

    def _size_of(self, spec: MessageSpec) -> int:
        """Return the number of elements that a new message has, arrays of fixed length in all."""
        counts = ((each.length or 0) if each.is_array else 1 for each in spec.fields)
        parts = (self._sizes.get(each.base, 1) for each in spec.fields)
        size = sum(count * part for count, part in zip(counts, parts, strict=True))
        if size > MOST_ELEMENTS:
            raise InvalidDefinitionError(
                f"{spec.full_name} has {size:,} elements in arrays of fixed length, more than the "
                f"limit of {MOST_ELEMENTS:,}"
            )
        return size

    def _part_of(self, spec: MessageSpec, name: str) -> type[Message]:
        try:
            return self.message(name)
        except UnknownTypeError as error:
            place = error.file or spec.full_name
            raise UnknownTypeError(error.message, file=place, hint=error.hint) from None

    def _md5_of(self, name: str) -> str:
        return self.message(name)._md5sum

    def _definition(self, name: str, kind: str) -> Definition | None:
        package, _, short = name.partition("/")
        for source in self._find(package):
            found: Definition | None = getattr(source, kind).get(short)
            if found is not None:
                return found
        return None

    def _unknown(self, name: str, kind: str) -> UnknownTypeError:
        package, _, short = name.partition("/")
        if not short:
            return UnknownTypeError(
                f"'{name}' is not a type name",
                hint="write the package too, as in 'std_msgs/String'",
            )
        sources = list(self._find(package))
        if not sources:
            return UnknownTypeError(
                f"nothing is known of the package '{package}' of '{name}'",
                hint="put the folder it is in on ROS_PACKAGE_PATH",
            )
        names = [each for source in sources for each in getattr(source, kind)]
        names += BUILTIN if kind == "messages" and short[:1].islower() else ()
        return UnknownTypeError(
            f"the package '{package}' has no {kind.removesuffix('s')} '{short}'",
            hint=did_you_mean(short, names),
        )


def _known_of(made: type[Message]) -> dict[str, type[Message]]:
    return made._known  # type: ignore[attr-defined, no-any-return]  # set by generate


_registered: dict[str, PackageDefinitions] = {}


def _sources(package: str) -> Iterator[PackageDefinitions]:
    if package in _registered:
        yield _registered[package]
    on_path = _on_path(package)
    if on_path is not None:
        yield on_path
    found = bundled(package)
    if found is not None:
        yield found


def _on_path(package: str) -> PackageDefinitions | None:
    path = search.package_path()
    return _read_package(path, package) if path else None


@functools.cache
def _read_package(path: str, package: str) -> PackageDefinitions | None:
    folder = search.find_packages(path).get(package)
    return None if folder is None else search.read_definitions(folder)


_registry = Registry(_sources)
load_message = _registry.message
load_service = _registry.service

after_register: list[Callable[[], None]] = []
"""Functions called after each registration, to drop classes that they hold."""


def register(package: str, name: str, text: str, kind: str | None = None) -> None:
    """Register a definition, before any other of this name.

    Args:
        package: Name of the package.
        name: Name of the message, service or action, without the package.
        text: The definition, as in a ``.msg``, ``.srv`` or ``.action`` file.
        kind: ``msg``, ``srv`` or ``action``; by default decided by the number of ``---`` lines.

    Raises:
        InvalidDefinitionError: The text is malformed.
    """
    if kind is None:
        kind = ("msg", "srv", "action")[min(2, sum(line[:3] == "---" for line in text.split("\n")))]
    if kind not in {"msg", "srv", "action"}:
        raise InvalidDefinitionError(f"the kind is msg, srv or action, not '{kind}'")
    full_name = f"{package}/{name}"
    if kind == "srv":
        parse_service(full_name, text)
    elif kind == "msg":
        parse_message(full_name, text)
    before = set(_registered.setdefault(package, PackageDefinitions()).messages)
    _registered[package].add(kind, name, Definition(text))
    for each in {name, *(set(_registered[package].messages) - before)}:
        _registry.forget(f"{package}/{each}")
    for forget in after_register:
        forget()


_TABLES = {"msg": "messages", "srv": "services", "action": "actions"}


def definitions(kind: str = "msg") -> list[str]:
    """Return full names of all known types of a kind: ``msg``, ``srv`` or ``action``, sorted.

    Searches all packages on ROS_PACKAGE_PATH.

    Raises:
        UnknownTypeError: There is no such kind.
    """
    packages = {*_registered, *bundled_packages()}
    if search.package_path():
        packages |= set(search.find_packages())
    return sorted(
        f"{package}/{name}" for package in packages for name in package_names(package, kind)
    )


def package_names(package: str, kind: str = "msg") -> list[str]:
    """Return names, without the package, of a package's types of a kind, sorted.

    Raises:
        UnknownTypeError: There is no such kind.
    """
    if kind not in _TABLES:
        raise UnknownTypeError(f"'{kind:.60}' is none of the kinds {', '.join(_TABLES)}")
    return sorted({name for source in _sources(package) for name in getattr(source, _TABLES[kind])})


def class_from_text(name: str, text: str) -> type[Message]:
    """Return a message class from a full text, such as in bags and connections.

    Kept apart by name.

    Args:
        name: Full type name.
        text: Its definition and all it depends on, with ``====`` lines between.

    Raises:
        InvalidDefinitionError: A definition is malformed or missing.
    """
    main, depends = split_full_text(text)
    return _class_from_parts(name, main, tuple(depends.items()))


@functools.lru_cache(maxsize=512)
def _class_from_parts(name: str, main: str, depends: tuple[tuple[str, str], ...]) -> type[Message]:
    texts: Mapping[str, str] = {**dict(depends), name: main}

    def find(package: str) -> Iterator[PackageDefinitions]:
        found = PackageDefinitions()
        for each, body in texts.items():
            if each.partition("/")[0] == package:
                found.messages[each.partition("/")[2]] = Definition(body)
        yield found

    return Registry(find).message(name)
