"""Summary of a bag, as text and as YAML."""

from __future__ import annotations

import time
from collections import Counter
from typing import TYPE_CHECKING, Any

from gazelle_ros.bags import compression
from gazelle_ros.bags.errors import BagError
from gazelle_ros.base.errors import did_you_mean

if TYPE_CHECKING:
    from gazelle_ros.bags.bag import Bag

_SIZES = ("KB", "MB", "GB", "TB", "PB")
_RATES = ("Hz", "kHz", "MHz", "GHz")


def describe(bag: Bag, *, rates: bool = True) -> str:
    """Return the text that ``rosbag info`` prints, with ``--freq`` if rates are wanted."""
    rows: list[tuple[str, str]] = [("path", bag.filename), ("version", "2.0")]
    chunks = [chunk for chunk in bag.index.chunks if chunk.counts]
    if not chunks:
        rows.append(("size", size_text(bag.size)))
        return _aligned(rows)
    start, end = bag.get_start_time(), bag.get_end_time()
    rows += [
        ("duration", _duration(end - start)),
        ("start", _moment(start)),
        ("end", _moment(end)),
        ("size", size_text(bag.size)),
        ("messages", str(bag.get_message_count())),
        *_compression_rows(bag, end - start),
        *_content_rows(bag, rates=rates),
    ]
    return _aligned(rows)


def _aligned(rows: list[tuple[str, str]]) -> str:
    width = max(len(name) for name, _ in rows) + 1
    lines = (f"{name + ':' if name else '':{width}} {value}" for name, value in rows)
    return "\n".join(lines).rstrip()


def _compression_rows(bag: Bag, duration: float) -> list[tuple[str, str]]:
    counts: Counter[str] = Counter()
    plain: Counter[str] = Counter()
    packed: Counter[str] = Counter()
    bag.get_compression_info()  # looks up what the chunks are
    for chunk in bag.index.chunks:
        counts[chunk.compression] += 1
        plain[chunk.compression] += chunk.size
        packed[chunk.compression] += chunk.compressed
    total, parts = len(bag.index.chunks), []
    for count, kind in sorted(((n, kind) for kind, n in counts.items()), reverse=True):
        ratio = "" if kind == compression.NONE else f"; {100.0 * packed[kind] / plain[kind]:.2f}%"
        parts.append(f"{kind} [{count}/{total} chunks{ratio}]")
    rows = [("compression", ", ".join(parts))]
    if set(counts) == {compression.NONE}:
        return rows
    sizes = (plain.total(), packed.total())
    texts = [size_text(size) for size in sizes]
    texts = [text.rjust(max(map(len, texts))) for text in texts]
    if duration > 0.0:
        rates = [size_text(size / duration) for size in sizes]
        width = max(map(len, rates))
        texts = [f"{text} @ {rate:>{width}}/s" for text, rate in zip(texts, rates, strict=True)]
        texts[1] += f" ({100.0 * sizes[1] / sizes[0]:.2f}%)"
    return [*rows, ("uncompressed", texts[0]), ("compressed", texts[1])]


def _content_rows(bag: Bag, *, rates: bool) -> list[tuple[str, str]]:
    types, topics = bag.get_type_and_topic_info()
    type_width = max(len(kind) for kind in types)
    topic_width = max(len(topic) for topic in topics)
    count_width = max(len(str(each.message_count)) for each in topics.values())
    shown = {
        topic: _rate(each.frequency)
        for topic, each in topics.items()
        if rates and each.frequency is not None
    }
    rate_width = max(map(len, shown.values()), default=0)
    rows = [
        ("" if number else "types", f"{kind:{type_width}} [{types[kind]}]")
        for number, kind in enumerate(types)
    ]
    for number, (topic, each) in enumerate(topics.items()):
        unit = "msgs" if each.message_count > 1 else "msg "
        text = f"{topic:{topic_width}}   {each.message_count:{count_width}} {unit}"
        rate = shown.get(topic)
        text += f" @ {rate:>{rate_width}}" if rate is not None else "   " + " " * rate_width
        text += f" : {each.msg_type:{type_width}}"
        if each.connections > 1:
            text += f" ({each.connections} connections)"
        rows.append(("" if number else "topics", text))
    return rows


def as_dict(bag: Bag, *, rates: bool = True) -> dict[str, Any]:
    """Return the content of ``rosbag info --yaml``, with ``--freq`` if rates are wanted."""
    found: dict[str, Any] = {"path": bag.filename, "version": 2.0}
    if not any(chunk.counts for chunk in bag.index.chunks):
        return found | {"size": bag.size, "indexed": False}
    start, end = bag.get_start_time(), bag.get_end_time()
    info = bag.get_compression_info()
    found |= {
        "duration": round(end - start, 6),
        "start": round(start, 6),
        "end": round(end, 6),
        "size": bag.size,
        "messages": bag.get_message_count(),
        "indexed": True,
        "compression": info.compression,
    }
    if info.uncompressed != info.compressed:
        found |= {"uncompressed": info.uncompressed, "compressed": info.compressed}
    types, topics = bag.get_type_and_topic_info()
    found["types"] = [{"type": kind, "md5": checksum} for kind, checksum in types.items()]
    found["topics"] = [_topic_dict(topic, each, rates=rates) for topic, each in topics.items()]
    return found


def _topic_dict(topic: str, each: Any, *, rates: bool) -> dict[str, Any]:
    found = {"topic": topic, "type": each.msg_type, "messages": each.message_count}
    if each.connections > 1:
        found["connections"] = each.connections
    if rates and each.frequency is not None:
        found["frequency"] = round(each.frequency, 4)
    return found


def as_yaml(value: Any, indent: str = "") -> str:
    """Return information as YAML, in the form of ``rosbag info --yaml``."""
    lines = []
    for key, each in value.items():
        if isinstance(each, list):
            lines.append(f"{indent}{key}:")
            for entry in each:
                inner = as_yaml(entry, indent + "      ").rstrip("\n")
                lines.append(f"{indent}    - {inner.lstrip()}")
        else:
            lines.append(f"{indent}{key}: {_scalar(key, each)}")
    return "\n".join(lines) + "\n"


def _scalar(key: str, value: Any) -> str:
    if isinstance(value, float) and key in {"duration", "start", "end"}:
        return f"{value:.6f}"
    return f"{value:.4f}" if isinstance(value, float) and key == "frequency" else str(value)


def value_of(information: dict[str, Any], key: str) -> str:
    """Return one value of the information, such as ``duration`` or ``topics``.

    Raises:
        BagError: There is no such key.
    """
    if key not in information:
        raise BagError(f"there is no key '{key}'", hint=did_you_mean(key, information))
    value = information[key]
    if isinstance(value, list):
        return "".join(f"- {as_yaml(each, '  ').strip()}\n" for each in value)
    return _scalar("", value)


def size_text(size: float) -> str:
    """Return bytes as text."""
    for unit in _SIZES:
        size /= 1024.0
        if size < 1024.0:
            return f"{size:.1f} {unit}"
    return "-"


def _rate(hertz: float) -> str:
    for unit in _RATES:
        if hertz < 1000.0:
            return f"{hertz:.1f} {unit}"
        hertz /= 1000.0
    return "-"


def _moment(seconds: float) -> str:
    part = f"{seconds - int(seconds):.2f}"[1:]
    return time.strftime("%b %d %Y %H:%M:%S", time.localtime(seconds)) + f"{part} ({seconds:.2f})"


def _duration(seconds: float) -> str:
    minutes = int(seconds / 60)
    hours = int(minutes / 60)
    rest = int(seconds % 60)
    if hours > 0:
        return f"{hours}hr {minutes % 60}:{rest:02d}s ({int(seconds)}s)"
    if minutes > 0:
        return f"{minutes}:{rest:02d}s ({int(seconds)}s)"
    return f"{seconds:.1f}s"
