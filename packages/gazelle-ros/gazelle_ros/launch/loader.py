"""Read roslaunch XML (http://wiki.ros.org/roslaunch/XML) into a `LaunchPlan`. Nothing is started."""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from pathlib import Path

from gazelle_ros import names
from gazelle_ros.base.errors import did_you_mean
from gazelle_ros.launch import nodes, params
from gazelle_ros.launch.document import Element, parse_document, read_document
from gazelle_ros.launch.errors import LaunchError, MissingArgumentError, SubstitutionError
from gazelle_ros.launch.limits import MAX_FILES
from gazelle_ros.launch.packages import Packages
from gazelle_ros.launch.plan import (
    Argument,
    LaunchMachine,
    LaunchPlan,
    NodePlan,
    SourceLocation,
    TestPlan,
)
from gazelle_ros.launch.scope import LaunchScope
from gazelle_ros.launch.substitution import Substitution

_DEEPEST, _MACHINE_DEFAULTS = 50, {"true": True, "false": True, "never": False}
_GONE = ("ros-root", "ros-package-path", "ros-ip", "ros-hostname")

ATTRIBUTES = {
    "arg": ("name", "value", "default", "doc"),
    "env": ("name", "value"),
    "group": ("ns", "clear_params"),
    "include": ("file", "ns", "clear_params", "pass_all_args"),
    "launch": ("deprecated",),
    "machine": (
        "name", "address", "env-loader", "ssh-port", "user", "password", "default", "timeout",
    ),
    "master": ("auto", "type", "uri"),
    "node": nodes.NODE_ATTRIBUTES,
    "param": ("name", "value", "type", "textfile", "binfile", "command"),
    "remap": ("from", "to"),
    "rosparam": ("command", "ns", "file", "param", "subst_value"),
    "test": nodes.TEST_ATTRIBUTES,
}  # fmt: skip
"""Attributes by element, besides ``if`` and ``unless``."""
_NAMESPACES = ("xmlns", "xsi")
"""Prefixes of attributes that name schemas, and say nothing to a reader of the file."""


def load_launch(
    path: str | Path | Sequence[str | Path],
    args: Mapping[str, str] | None = None,
    *,
    packages: Packages | None = None,
    environment: Mapping[str, str] | None = None,
    namespace: str = "/",
) -> LaunchPlan:
    """Read launch files.

    Args:
        path: One file or several, which are read in order.
        args: Values of arguments by name.
        packages: Packages; by default along ROS_PACKAGE_PATH.
        environment: Variables for ``$(env X)``; by default the process's environment.
        namespace: Namespace of all relative names.

    Raises:
        LaunchError: A file is malformed, a ``$(...)`` has no value, or a package is missing; it names
            file, line and element.
    """
    paths = [path] if isinstance(path, (str, Path)) else list(path)
    loader = _Loader(packages, environment)
    for each in paths:
        file = str(each)
        loader.load(read_document(file), file, dict(args or {}), namespace)
    loader.finish(args or {})
    return loader.plan


def load_launch_text(
    text: str | bytes,
    args: Mapping[str, str] | None = None,
    *,
    name: str = "string",
    packages: Packages | None = None,
) -> LaunchPlan:
    """Read the text of a launch file; ``name`` stands for the file in errors.

    Raises:
        LaunchError: As `load_launch`.
    """
    data = text.encode(errors="surrogatepass") if isinstance(text, str) else text
    loader = _Loader(packages, None)
    loader.load(parse_document(data, name), None, dict(args or {}), "/")
    loader.finish(args or {})
    return loader.plan


def declared_arguments(
    path: str | Path | Sequence[str | Path],
    args: Mapping[str, str] | None = None,
    *,
    packages: Packages | None = None,
) -> LaunchPlan:
    """Return a plan with only the declared arguments of launch files.

    Raises:
        LaunchError: A file is malformed.
    """
    loader = _Loader(packages, None, arguments_only=True)
    for each in [path] if isinstance(path, (str, Path)) else list(path):
        loader.load(read_document(str(each)), str(each), dict(args or {}), "/")
    return loader.plan


class _Loader:
    """Walks through launch files and fills a plan."""

    def __init__(
        self,
        packages: Packages | None,
        environment: Mapping[str, str] | None,
        *,
        arguments_only: bool = False,
    ) -> None:
        self._arguments_only = arguments_only
        self.plan = LaunchPlan()
        self._packages = packages or Packages(environment)
        self._environment = environment
        self._default_machine = ""
        self._depth = self._files = 0
        self._used: set[str] = set()
        self._handlers: dict[str, Callable[[Element, LaunchScope], None]] = {
            "arg": self._arg,
            "env": self._env,
            "group": self._group,
            "include": self._include,
            "machine": self._machine,
            "master": self._master,
            "node": self._node,
            "param": self._param,
            "remap": self._remap,
            "rosparam": self._rosparam,
            "test": self._node,
        }

    def load(self, root: Element, file: str | None, args: dict[str, str], namespace: str) -> None:
        """Read one file of the command line."""
        words = Substitution(self._packages, file, args)
        if self._environment is not None:
            words.environment = self._environment
        scope = LaunchScope(names.as_namespace(namespace), words)
        self._launch(root, scope)
        self._used |= scope.declared
        self.plan.arguments |= self._declared(root, scope)

    def finish(self, args: Mapping[str, str]) -> None:
        """Check the plan as a whole."""
        for name in sorted(set(args) - self._used):
            if not name.startswith("_"):
                hint = did_you_mean(name, self._used)
                self.plan.notices.append(f"no launch file declares the argument '{name}'; {hint}")
        known: dict[str, NodePlan] = {}
        for node in [*self.plan.nodes, *self.plan.tests]:
            other = known.setdefault(node.full_name, node)
            if other is not node:
                raise LaunchError(
                    f"two nodes are called '{node.full_name}'",
                    source=node.place,
                    hint=f"the other is in {other.place.file}:{other.place.line}; "
                    "names must differ, as a node ends when another of its name starts",
                )
        self._find_conflicts()

    def _find_conflicts(self) -> None:
        """Find parameters that hide each other: one is a value and has others below it."""
        for name, parameter in self.plan.parameters.items():
            above = names.namespace_of(name).rstrip("/")
            while above:
                if above in self.plan.parameters:
                    self._notice(parameter.place, f"'{name}' is below the parameter '{above}'")
                above = names.namespace_of(above).rstrip("/")

    def _notice(self, at: SourceLocation | Element, text: str) -> None:
        label = at.label if isinstance(at, Element) else at.element
        self.plan.notices.append(f"{at.file}:{at.line}: <{label}>: {text}")

    # One file ----------------------------------------------------------------------------

    def _launch(self, root: Element, scope: LaunchScope) -> None:
        self.plan.files.append(root.file)
        self._check_attributes(root)
        if root.attributes.get("deprecated"):
            self._notice(root, f"deprecated: {root.attributes['deprecated']}")
        self._children(root, scope)

    def _children(self, parent: Element, scope: LaunchScope) -> None:
        for element in parent.children:
            if self._arguments_only and element.tag != "arg":
                continue
            handler = self._handlers.get(element.tag)
            if handler is None:
                hint = did_you_mean(element.tag, self._handlers)
                self._notice(element, f"there is no element <{element.tag}>, ignored; {hint}")
                continue
            try:
                if scope.applies(element):
                    self._check_attributes(element)
                    handler(element, scope)
            except LaunchError as error:
                if error.file is None:
                    raise element.error(error.message, error.hint) from error
                raise

    def _check_attributes(self, element: Element) -> None:
        known = ATTRIBUTES[element.tag.lower()]
        for key in element.attributes:
            if key.partition(":")[0] in _NAMESPACES:
                continue
            if key not in known and key not in {"if", "unless"}:
                hint = did_you_mean(key, [*known, "if", "unless"])
                self._notice(element, f"unknown attribute '{key}', ignored; {hint}")

    @staticmethod
    def _declared(root: Element, scope: LaunchScope) -> dict[str, Argument]:
        """Return the arguments of a file, with their documentation."""
        found: dict[str, Argument] = {}
        for element in root.children:
            name = element.attributes.get("name", "")
            if element.tag != "arg" or name not in scope.declared or name in found:
                continue
            found[name] = Argument(
                name,
                scope.words.arguments.get(name),
                element.attributes.get("default"),
                element.attributes.get("doc", ""),
                "value" in element.attributes,
            )
        return found

    # One element -------------------------------------------------------------------------

    def _arg(self, element: Element, scope: LaunchScope) -> None:
        (name,) = scope.required(element, "name")
        try:
            value, default = scope.text(element, "value"), scope.text(element, "default")
        except SubstitutionError:
            if not self._arguments_only:
                raise
            value, default = None, element.attributes.get("default")
        if value is not None and default is not None:
            raise element.error("an argument has a value or a default, not both")
        scope.declare(element, name, value, default)

    def _env(self, element: Element, scope: LaunchScope) -> None:
        name, value = scope.required(element, "name", "value")
        if not name:
            raise element.error("the name is empty")
        scope.environment.append((name, value))

    def _group(self, element: Element, scope: LaunchScope) -> None:
        inner = scope.child(self._namespace(element, scope))
        self._clear(element, scope, inner)
        self._children(element, inner)

    @staticmethod
    def _namespace(element: Element, scope: LaunchScope) -> str | None:
        namespace = scope.text(element, "ns")
        if namespace is None:
            return None
        if not namespace:
            raise element.error("ns is empty", 'leave it out, or write ns="/" for the root')
        if names.is_private(namespace):
            raise element.error("a namespace cannot be private (begin with '~')")
        return namespace

    def _clear(
        self, element: Element, scope: LaunchScope, inner: LaunchScope, node: str = ""
    ) -> None:
        if not element.attributes.get("clear_params") or not scope.flag(element, "clear_params"):
            return
        if not node and "ns" not in element.attributes:
            raise element.error("clear_params needs the attribute 'ns'")
        self.plan.clear.append(names.as_namespace(inner.namespace + node))

    def _machine(self, element: Element, scope: LaunchScope) -> None:
        name, address = scope.required(element, "name", "address")
        for key in _GONE:
            if key in element.attributes:
                raise element.error(f"'{key}' is not supported since ROS Fuerte", "use env-loader")
        default = (scope.text(element, "default") or "false").lower()
        if default not in _MACHINE_DEFAULTS:
            raise element.error(f"default='{default}' is neither true, false nor never")
        place = SourceLocation(element.file, element.line, element.label)
        assignable = _MACHINE_DEFAULTS[default]
        self.plan.machines[name] = LaunchMachine(name, address, place, assignable)
        if default == "true":
            self._default_machine = name

    def _master(self, element: Element, scope: LaunchScope) -> None:
        del scope
        self._notice(element, "<master> has no meaning since ROS Fuerte, ignored")

    def _node(self, element: Element, scope: LaunchScope) -> None:
        inner = scope.child(self._namespace(element, scope))
        own = [child for child in element.children if self._may_be_in_node(child)]
        node, parameters = nodes.read_node(
            element, own, scope, inner, self.plan, machine=self._default_machine
        )
        self._clear(element, scope, inner, node.name)
        if not names.is_legal_base(node.name):
            self._notice(element, f"'{node.name}' is not a legal name of a node")
        for parameter in parameters:
            params.put(self.plan, parameter)
        if isinstance(node, TestPlan):
            self.plan.tests.append(node)
        else:
            self.plan.nodes.append(node)

    def _may_be_in_node(self, child: Element) -> bool:
        if child.tag.lower() in {"param", "rosparam", "remap", "env"}:
            self._check_attributes(child)
            return True
        self._notice(child, f"<{child.tag}> has no place in a node, ignored")
        return False

    def _param(self, element: Element, scope: LaunchScope) -> None:
        parameter = params.read_param(element, scope)
        if names.is_private(parameter.name):
            key = parameter.name[1:]
            scope.private[:] = [each for each in scope.private if each[0] != key]
            scope.private.append((key, parameter.value, parameter.place))
        else:
            params.put_at(self.plan, names.join(scope.namespace, parameter.name), parameter)

    def _remap(self, element: Element, scope: LaunchScope) -> None:
        old, new = scope.required(element, "from", "to")
        scope.remap(element, old, new)

    def _rosparam(self, element: Element, scope: LaunchScope) -> None:
        params.read_rosparam(element, scope, self.plan)

    def _include(self, element: Element, scope: LaunchScope) -> None:
        (file,) = scope.required(element, "file")
        given = dict(scope.words.arguments) if scope.flag(element, "pass_all_args") else {}
        passes_all = scope.flag(element, "pass_all_args")
        namespace = self._namespace(element, scope)
        inner = scope.included(namespace, given, file)
        inner.passes_all = passes_all
        self._clear(element, scope, inner)
        passed = self._passed(element, scope, inner)
        self._depth += 1
        if self._depth > _DEEPEST:
            raise element.error(f"files include each other more than {_DEEPEST} deep")
        self._files += 1
        if self._files > MAX_FILES:
            raise element.error(f"this launch includes more than {MAX_FILES:,} files")
        try:
            document = read_document(file)
        except LaunchError as error:
            if error.line is not None:
                raise
            raise element.error(f"{error.message}: {file}", error.hint) from None
        try:
            self._launch(document, inner)
        except MissingArgumentError as error:
            if error.argument in inner.declared:
                error.add_location(element.file, element.line)
            raise
        finally:
            self._depth -= 1
        unused = sorted(passed - inner.declared)
        if unused and not passes_all:
            raise element.error(
                f"{file} declares no argument '{unused[0]}'",
                did_you_mean(unused[0], inner.declared),
            )

    def _passed(self, element: Element, scope: LaunchScope, inner: LaunchScope) -> set[str]:
        """Evaluate the children of an include; returns the names of given arguments."""
        passed: set[str] = set()
        for child in element.children:
            tag = child.tag.lower()
            if tag not in {"arg", "env"}:
                self._notice(child, f"<{child.tag}> has no place in an include, ignored")
                continue
            if not scope.applies(child):
                continue
            self._check_attributes(child)
            if tag == "env":
                inner.environment.append(scope.required(child, "name", "value"))  # type: ignore[arg-type]
                continue
            (name,) = scope.required(child, "name")
            value, default = scope.text(child, "value"), scope.text(child, "default")
            if value is not None and default is not None:
                raise child.error("an argument has a value or a default, not both")
            if name in passed and not inner.passes_all:
                raise child.error(f"the argument '{name}' is given twice")
            if value is None and default is None and name not in inner.words.arguments:
                raise child.error(f"the argument '{name}' needs a value here")
            if value is not None:
                inner.words.arguments[name] = value
            elif default is not None:
                inner.words.arguments.setdefault(name, default)
            passed.add(name)
        return passed
