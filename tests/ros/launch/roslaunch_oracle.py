"""Runs under the system's Python: what the real roslaunch makes of launch files, as JSON lines."""

import contextlib
import io
import json
import sys

import roslaunch.config
import roslaunch.loader
import roslaunch.xmlloader

original = roslaunch.loader.Loader.param_value


def param_value(self, verbose, name, ptype, value, textfile, binfile, command):
    if command is not None:
        return {"command": command, "kind": ptype}
    found = original(self, verbose, name, ptype, value, textfile, binfile, command)
    return {"binary": found.data.hex()} if hasattr(found, "data") else found


roslaunch.loader.Loader.param_value = param_value


def plain(node):
    return {
        "package": node.package,
        "type": node.type,
        "name": node.name,
        "namespace": node.namespace,
        "arguments": node.args or "",
        "output": getattr(node, "output", None) or "log",
        "respawn": bool(getattr(node, "respawn", False)),
        "respawn_delay": float(getattr(node, "respawn_delay", 0.0)),
        "required": bool(getattr(node, "required", False)),
        "cwd": node.cwd,
        "launch_prefix": node.launch_prefix or "",
        "environment": [list(pair) for pair in node.env_args],
        "remappings": [list(pair) for pair in node.remap_args],
    }


def load(path, args):
    config = roslaunch.config.ROSLaunchConfig()
    loader = roslaunch.xmlloader.XmlLoader()
    try:
        with contextlib.redirect_stdout(io.StringIO()), contextlib.redirect_stderr(io.StringIO()):
            argv = [f"{key}:={value}" for key, value in args.items()]
            loader.load(path, config, argv=argv, verbose=False)
    except Exception as error:  # noqa: BLE001  # whatever it is, it is the answer
        return {"error": f"{type(error).__name__}: {error}"}
    tests = []
    for test in config.tests:
        found = plain(test)
        found |= {"test_name": test.test_name, "time_limit": test.time_limit, "retry": test.retry}
        tests.append(found)
    return {
        "files": config.roslaunch_files,
        "parameters": {key: param.value for key, param in config.params.items()},
        "clear": config.clear_params,
        "actions": [[each.command, *each.args] for each in config.executables],
        "nodes": [plain(node) for node in config.nodes],
        "tests": tests,
        "problems": len(config.config_errors),
    }


for line in sys.stdin:
    request = json.loads(line)
    answer = load(request["path"], request.get("args", {}))
    sys.stdout.write(json.dumps(answer, default=str) + "\n")
    sys.stdout.flush()
