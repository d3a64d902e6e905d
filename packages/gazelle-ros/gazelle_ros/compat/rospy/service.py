"""Services: offering one, calling one, waiting for one."""

from __future__ import annotations

import threading
import time
import traceback
from collections.abc import Callable
from typing import TYPE_CHECKING, Any

from gazelle_ros import time as values
from gazelle_ros.base.deadlines import deadline_after
from gazelle_ros.compat.rospy.exceptions import (
    ROSException,
    ROSInterruptException,
    ServiceException,
)
from gazelle_ros.compat.rospy.guest import user
from gazelle_ros.compat.rospy.logs import logerr
from gazelle_ros.compat.rospy.msg import args_kwds_to_message
from gazelle_ros.compat.rospy.names import resolve_name
from gazelle_ros.compat.rospy.state import process
from gazelle_ros.errors import (
    ApiError,
    InvalidNameError,
    MasterUnreachableError,
    NodeClosedError,
    RosError,
    RosTimeoutError,
    ServiceError,
    ServiceFailedError,
    ServiceNotFoundError,
)
from gazelle_ros.messages import SerializationError
from gazelle_ros.services import ServiceClient, ServiceServer
from gazelle_ros.services import wait_for_service as wait

if TYPE_CHECKING:
    from types import TracebackType

DEFAULT_BUFF_SIZE = 65536
ErrorHandler = Callable[[Exception, type[Exception], Exception, "TracebackType | None"], Any]

__all__ = ["Service", "ServiceException", "ServiceProxy", "wait_for_service"]


class _Service:
    """Common base of both sides of a service.

    Attributes:
        resolved_name: Of the service.
        service_class: Its type; so are `request_class` and `response_class` of its parts.
    """

    def __init__(self, name: str, service_class: Any) -> None:
        self.resolved_name = resolve_name(name)
        self.service_class = service_class
        self.request_class: Any = service_class._request_class
        self.response_class: Any = service_class._response_class
        self.uri: str | None = None


class Service(_Service):
    """Offers a service.

    Args:
        name: Of the service.
        service_class: Its type.
        handler: From request to response: a message, or a dict, list or tuple of its fields.
            It may raise `ServiceException`.
        buff_size: Accepted, and not needed.
        error_handler: Called with the exception, its class, itself and its traceback when the
            handler raises anything else.

    Raises:
        ServiceException: This node offers it already.
    """

    def __init__(
        self,
        name: str,
        service_class: Any,
        handler: Callable[[Any], Any],
        buff_size: int = DEFAULT_BUFF_SIZE,
        error_handler: ErrorHandler | None = None,
    ) -> None:
        super().__init__(name, service_class)
        del buff_size
        self.handler = handler
        self._error_handler = error_handler
        self._server: ServiceServer | None = None
        self._closed = threading.Event()
        self._error: RosError | None = None
        process.when_ready(self._serve)
        if self._error is not None:
            raise ServiceException(f"service [{self.resolved_name}] already registered")

    def _serve(self) -> None:
        if self._closed.is_set():
            return
        try:
            server = process.require().serve(self.resolved_name, self.service_class, self.handler)
        except InvalidNameError as error:
            self._error = error
            return
        server.refusals = (*server.refusals, ServiceException)
        server.on_error = self._failed
        self._server, self.uri = server, server.uri

    def error_handler(
        self, e: Exception, exc_type: Any, exc_value: Any, tb: TracebackType | None
    ) -> None:
        """Handle an exception of the handler: by the function given for it, else by the log."""
        if self._error_handler is not None:
            self._error_handler(e, exc_type, exc_value, tb)
            return
        lines = "".join(traceback.format_exception(exc_type, exc_value, tb))
        logerr(f"Error processing request: {exc_value}\n{lines}")

    def _failed(self, error: Exception) -> None:
        self.error_handler(error, type(error), error, error.__traceback__)

    def spin(self) -> None:
        """Wait for the end of the node or of the service."""
        while not process.shutdown.is_set() and not self._closed.wait(0.5):
            pass

    def shutdown(self, reason: str = "") -> None:
        """Close the service."""
        del reason
        self._closed.set()
        if self._server is not None:
            self._server.close()


class ServiceProxy(_Service):
    """Calls a service, as a function would be called.

    Args:
        name: Of the service.
        service_class: Its type.
        persistent: Keep one connection for all calls.
        headers: More fields for the connection header.
    """

    def __init__(
        self,
        name: str,
        service_class: Any,
        persistent: bool = False,  # noqa: FBT001, FBT002  # rospy's interface
        headers: dict[str, str] | None = None,
    ) -> None:
        super().__init__(name, service_class)
        self.persistent = persistent
        self._headers = dict(headers or {})
        self._client: ServiceClient | None = None

    def wait_for_service(self, timeout: float | None = None) -> None:
        """Wait for the service; see the function of this name."""
        wait_for_service(self.resolved_name, timeout)

    def __call__(self, *args: Any, **kwds: Any) -> Any:
        """Call the service; see `call`."""
        return self.call(*args, **kwds)

    def call(self, *args: Any, **kwds: Any) -> Any:
        """Call the service.

        Args:
            args: The request, or its fields in order.
            kwds: Or its fields by name.

        Raises:
            ServiceException: The call failed; the text says how.
            SerializationError: A field holds what it cannot.
            TypeError: The message is not a request of this service.
            ROSInterruptException: The node was shut down meanwhile.
        """
        request = args_kwds_to_message(self.request_class, args, kwds)
        if request._type != self.request_class._type:
            raise TypeError(
                f"request object type [{type(request)}] does not match service type "
                f"[{self.request_class}]"
            )
        client = self._find_client()
        try:
            return client.call(request)
        except SerializationError:
            self._check_there()
            raise
        except ServiceNotFoundError:
            raise ServiceException(f"service [{self.resolved_name}] unavailable") from None
        except MasterUnreachableError:
            raise ServiceException("unable to contact master") from None
        except ServiceFailedError as error:
            raise ServiceException(
                f"service [{self.resolved_name}] responded with an error: {error.message}"
            ) from None
        except (ServiceError, NodeClosedError) as error:
            if process.over:
                raise ROSInterruptException("node shutdown interrupted service call") from None
            text = str(error)
            if not text.startswith("unable to connect to service"):
                text = f"transport error completing service call: {text}"
            raise ServiceException(text) from None
        except RosError as error:
            raise ServiceException(f"unable to connect to service: {error}") from None

    def _check_there(self) -> None:
        """Raise an error without a provider: rospy connects before it checks the request."""
        try:
            user().master.lookup_service(self.resolved_name)
        except ApiError:
            raise ServiceException(f"service [{self.resolved_name}] unavailable") from None

    def _find_client(self) -> ServiceClient:
        owner = user()
        client = self._client
        if client is None or client.node is not owner:
            client = ServiceClient(
                owner,
                self.resolved_name,
                self.service_class,
                owner.neighbour_service,
                persistent=self.persistent,
            )
            client.fields.update(self._headers)
            self._client = client
        return client

    def close(self) -> None:
        """Close the connection, if there is one."""
        client, self._client = self._client, None
        if client is not None:
            client.close()


def wait_for_service(service: str, timeout: values.Duration | float | None = None) -> None:
    """Wait until a service answers.

    Args:
        service: Its name.
        timeout: The longest wait [s of wall time], or a duration.

    Raises:
        ROSException: It does not in time.
        ROSInterruptException: The node was shut down meanwhile.
    """
    seconds = timeout.to_sec() if isinstance(timeout, values.Duration) else timeout
    deadline = None if seconds is None else deadline_after(seconds)
    name = resolve_name(service)
    while not process.over:
        left = 1.0 if deadline is None else min(1.0, deadline - time.monotonic())
        try:
            wait(user(), name, max(0.0, left))
        except NodeClosedError:
            break
        except RosTimeoutError:
            if deadline is not None and time.monotonic() >= deadline - 0.1:
                text = f"timeout exceeded while waiting for service {name}"
                raise ROSException(text) from None
        else:
            return
    raise ROSInterruptException("rospy shutdown")


def convert_return_to_response(response: Any, response_class: Any) -> Any:
    """Convert the return value of a handler to a response.

    Raises:
        ServiceException: It is none.
    """
    from gazelle_ros.services import as_message

    if response is None:
        raise ServiceException("service handler returned None")
    try:
        return as_message(response, response_class)
    except ServiceError as error:
        raise ServiceException(error.message) from None
