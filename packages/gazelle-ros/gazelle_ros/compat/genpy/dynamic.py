"""Classes from the texts of connections and bags, where genpy keeps them."""

from __future__ import annotations

from gazelle_ros.messages import Message, class_from_text


def generate_dynamic(core_type: str, msg_cat: str) -> dict[str, type[Message]]:
    """Generate the class of a type, and of those it contains, by name.

    Args:
        core_type: Its name.
        msg_cat: Its definition, and after ``====`` lines those it depends on.
    """
    made = class_from_text(core_type, msg_cat)
    known: dict[str, type[Message]] = getattr(made, "_known", {})
    return {**known, core_type: made}
