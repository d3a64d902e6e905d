"""Classes of Debian's genpy for packages that Debian has none for, made from our definitions."""

from __future__ import annotations

from rossuites.generating import generate

from gazelle.ros import load_message, load_service
from gazelle.ros.messages import definitions

_RULE = "=" * 80


def generate_real_classes(packages, folder):
    """What goes on PYTHONPATH of a real client."""
    source, target = folder / "source", folder / "classes"
    for name in definitions():
        if name.partition("/")[0] in packages:
            _put(source, name, "msg", _own(load_message(name)))
    for name in definitions("srv"):
        if name.partition("/")[0] in packages:
            service = load_service(name)
            halves = (_own(service._request_class), _own(service._response_class))
            _put(source, name, "srv", "\n---\n".join(halves))
    generate(source, target)
    return target


def _own(kind):
    return kind._full_text.partition(_RULE)[0]


def _put(source, name, kind, text):
    package, _, own = name.partition("/")
    file = source / package / kind / f"{own}.{kind}"
    file.parent.mkdir(parents=True, exist_ok=True)
    file.write_text(text, encoding="utf-8")
