"""Results of loading every description file of the corpus: loaded, warned about, or refused.

The table beside this file, ``corpus_table.txt``, holds what is not simply loaded. After a
change on purpose it is written again by ``python tests/formats/corpus_table.py CORPUS``.
"""

import collections
import os
import re
import sys
import time
from pathlib import Path

from gazelle import Error
from gazelle.formats.lint import lint
from gazelle.formats.loader import find_file, read_path
from gazelle.formats.reading import Reading
from gazelle.formats.resolve import MODEL_VARIABLES, PACKAGE_VARIABLE, Resolver
from gazelle.stage.format import is_stage

TABLE = Path(__file__).with_suffix(".txt")
KINDS = ("sdf", "world", "urdf", "xacro", "gazebo")
MOST_REASONS = 4


def files(corpus, *kinds):
    """Return the description files, without SDF's own schema and the worlds of Stage."""
    schema = corpus / "gazebosim__sdformat" / "sdf"
    found = [f for kind in kinds or KINDS for f in corpus.rglob(f"*.{kind}")]
    return sorted(f for f in found if schema not in f.parents and not _is_stage(f))


def _is_stage(path):
    return path.suffix == ".world" and is_stage(path.read_bytes(), path.suffix)


def outcome(path, corpus):
    """Return the outcome of the file, as in the table, and the seconds of loading it."""
    hidden = {*MODEL_VARIABLES, PACKAGE_VARIABLE}
    environ = {name: text for name, text in os.environ.items() if name not in hidden}
    reading = Reading(Resolver(environ=environ))
    start = time.process_time()
    try:
        world = read_path(find_file(path, reading), reading)
    except Error as error:
        return f"refused: {_plain(error.message, corpus)}", time.process_time() - start
    seconds = time.process_time() - start
    lint(world)  # never fails, whatever it finds
    reasons = collections.Counter(_general(note.message) for note in reading.notes)
    if reading.misses:
        reasons["not found"] = len(reading.misses)
    if not reasons:
        return "loaded", seconds
    said = [f"{count} x {text}" for text, count in sorted(reasons.items())]
    rest = [f"and {len(said) - MOST_REASONS} more"] if len(said) > MOST_REASONS else []
    return f"warned: {'; '.join(said[:MOST_REASONS] + rest)}", seconds


def _plain(text, corpus):
    return text.replace(f"{corpus}/", "")[:120].replace("\n", " ")


def _general(text):
    """Return a remark without the names in it."""
    return re.sub(r"'[^']*'", "'...'", text)[:90].replace("\n", " ")


def sweep(corpus, *kinds):
    """Return outcome and seconds by file."""
    paths = files(corpus, *kinds)
    return {str(path.relative_to(corpus)): outcome(path, corpus) for path in paths}


def as_text(outcomes):
    """Return the table: files by outcome; those that simply loaded are counted."""
    groups = collections.defaultdict(list)
    for name, (said, _) in outcomes.items():
        groups[said].append(name)
    loaded = collections.Counter(Path(name).suffix for name in groups.pop("loaded", []))
    lines = [f"loaded: {count} {suffix}" for suffix, count in sorted(loaded.items())]
    for said in sorted(groups):
        lines += [said, *(f"  {name}" for name in sorted(groups[said]))]
    return "\n".join([*lines, ""])


if __name__ == "__main__":
    TABLE.write_text(as_text(sweep(Path(sys.argv[1]).absolute())), encoding="utf-8")
