"""Copy pip's settings of this machine into a root file system, and print the folders they name."""

import ast
import subprocess
import sys
from pathlib import Path

ROOT = Path(sys.argv[1])

command = [sys.executable, "-m", "pip", "config", "list"]
listed = subprocess.run(command, capture_output=True, text=True, check=False)  # noqa: S603
settings = {}
for line in sorted(listed.stdout.splitlines(), key=lambda line: line.startswith(":env:")):
    name, _, value = line.partition("=")
    settings[name.rpartition(".")[2]] = ast.literal_eval(value)

folders = set()
for word in " ".join(settings.values()).split():
    path = Path(word.removeprefix("file://"))
    if path.is_dir() and path.is_absolute():
        # The pages of an index lead to files beside their folder.
        folders.add(path.parent if path.name == "simple" else path)
    elif path.is_file() and path.is_absolute():
        copy = ROOT / path.relative_to("/")
        copy.parent.mkdir(parents=True, exist_ok=True)
        copy.write_bytes(path.read_bytes())

lines = [f"{name} = {value.replace(chr(10), ' ')}\n" for name, value in settings.items()]
(ROOT / "etc/pip.conf").write_text("".join(["[global]\n", *lines]))
for folder in sorted(folders):
    print(folder)  # noqa: T201
