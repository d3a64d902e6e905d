"""Call services with time-outs and retries."""

from __future__ import annotations

import time
from typing import Any

from gazelle.clients.errors import ClientError
from gazelle_ros import Node, ServiceClient, load_service
from gazelle_ros.errors import RosError, RosTimeoutError, ServiceFailedError

_PAUSE_S = 0.05


class Caller:
    """Calls services under a namespace, over connections that stay open.

    Args:
        node: Calls.
        namespace: Put before the names of services.
        timeout: For a service to be there and for it to answer, each, in wall time [s].
        retries: Number of retries of an interrupted call.
    """

    def __init__(self, node: Node, namespace: str, timeout: float, retries: int) -> None:
        self.node = node
        self.namespace = "/" + namespace.strip("/") if namespace.strip("/") else ""
        self.timeout = timeout
        self.retries = retries
        self._clients: dict[str, tuple[Any, ServiceClient]] = {}

    def call(self, name: str, kind: str, /, **fields: Any) -> Any:
        """Call a service.

        Args:
            name: Below the namespace; one that begins with a slash is taken as it is.
            kind: Such as ``gazebo_msgs/GetModelState``.
            fields: Of the request.

        Raises:
            ClientError: The service is not there, breaks off, or answers that it failed.
        """
        return self._call_until(name, kind, fields, self.retries)[0]

    def call_once(self, name: str, kind: str, /, **fields: Any) -> Any:
        """Call a service that must not be repeated: it is never called again.

        Raises:
            ClientError: As ``call``; after a connection broke off it may have been done.
        """
        return self._call_until(name, kind, fields, 0)[0]

    def call_again(self, name: str, kind: str, /, **fields: Any) -> tuple[Any, bool]:
        """Call a service; also returns whether an earlier try may have taken effect.

        Raises:
            ClientError: As ``call``.
        """
        return self._call_until(name, kind, fields, self.retries)

    def _call_until(
        self, name: str, kind: str, fields: dict[str, Any], retries: int
    ) -> tuple[Any, bool]:
        full = name if name.startswith("/") else f"{self.namespace}/{name}"
        attempt = 0
        while True:
            try:
                return self._call(full, kind, fields), attempt > 0
            except ServiceFailedError as error:
                raise ClientError(f"{full}: {error}") from error
            except RosTimeoutError as error:
                raise ClientError(
                    f"{full} does not answer within {self.timeout:g} s",
                    hint=f"is it running? master: {self.node.master_uri}",
                ) from error
            except RosError as error:
                self._forget(full)
                if attempt == retries:
                    raise ClientError(f"{full}: {error}") from error
                attempt += 1
                time.sleep(_PAUSE_S)

    def demand(self, name: str, kind: str, /, **fields: Any) -> Any:
        """Call a service with ``success`` in its answer, and require it.

        Raises:
            ClientError: As ``call``, and when it answers that it did not succeed.
        """
        return self.accept(name, self.call(name, kind, **fields))

    def demand_once(self, name: str, kind: str, /, **fields: Any) -> Any:
        """Call a service that must not be repeated, and check its success.

        Raises:
            ClientError: As ``call_once``, and when it answers that it did not succeed.
        """
        return self.accept(name, self.call_once(name, kind, **fields))

    def accept(self, name: str, answer: Any) -> Any:
        """Return the answer of a service that has ``success``.

        Raises:
            ClientError: It did not succeed.
        """
        if not answer.success:
            full = name if name.startswith("/") else f"{self.namespace}/{name}"
            raise ClientError(f"{full}: {answer.status_message}")
        return answer

    def close(self) -> None:
        """Close the connections."""
        for full in list(self._clients):
            self._forget(full)

    def _call(self, full: str, kind: str, fields: dict[str, Any]) -> Any:
        if full not in self._clients:
            self.node.wait_for_service(full, timeout=self.timeout)
            service = load_service(kind)
            client = self.node.client(full, service, persistent=True)
            self._clients[full] = (service, client)
        service, client = self._clients[full]
        request = service._request_class(**fields)
        return client.call(request, timeout=self.timeout)

    def _forget(self, full: str) -> None:
        known = self._clients.pop(full, None)
        if known is not None:
            known[1].close()
