"""State that calls a service."""

from __future__ import annotations

import copy
from typing import Any

from gazelle_ros.compat import rospy
from gazelle_ros.drop_in.smach import State
from gazelle_ros.drop_in.smach_ros.callbacks import UserCallback, filled, taken_apart


class ServiceState(State):
    """Call of a service; outcomes are ``succeeded``, ``aborted``, ``preempted`` and those of ``response_cb``.

    Args:
        service_name: Of the service.
        service_spec: The class of the service.
        request: The request; without it an empty one.
        request_key: Userdata with the request.
        request_slots: Fields of the request that are userdata of the same names.
        request_cb: Called with userdata and the request; returns the request, or changes it.
        request_cb_args: For it.
        request_cb_kwargs: For it.
        response_key: Userdata for the response.
        response_slots: Fields of the response that become userdata.
        response_cb: Called with userdata and the response; returns an outcome, or None.
        response_cb_args: For it.
        response_cb_kwargs: For it.
        input_keys: More userdata that is read.
        output_keys: More userdata that is written.
        outcomes: More outcomes.
    """

    def __init__(  # smach's interface
        self,
        service_name: str,
        service_spec: Any,
        request: Any = None,
        request_key: str | None = None,
        request_slots: Any = (),
        request_cb: Any = None,
        request_cb_args: Any = (),
        request_cb_kwargs: Any = None,
        response_key: str | None = None,
        response_slots: Any = (),
        response_cb: Any = None,
        response_cb_args: Any = (),
        response_cb_kwargs: Any = None,
        input_keys: Any = (),
        output_keys: Any = (),
        outcomes: Any = (),
    ) -> None:
        super().__init__(["succeeded", "aborted", "preempted", *outcomes], input_keys, output_keys)
        self._name, self._spec = service_name, service_spec
        self._request = service_spec._request_class() if request is None else request
        self._request_from = request_key, request_slots
        self._response_to = response_key, response_slots
        self.register_input_keys([*request_slots, *([request_key] if request_key else [])])
        self.register_output_keys([*response_slots, *([response_key] if response_key else [])])
        self._request_cb = UserCallback(request_cb, request_cb_args, request_cb_kwargs or {})
        self._response_cb = UserCallback(response_cb, response_cb_args, response_cb_kwargs or {})
        for each in (self._request_cb, self._response_cb):
            each.add_to(self, input_keys, output_keys)

    def execute(self, ud: Any) -> Any:
        """Wait for the service and call it; returns the outcome."""
        while not self.preempt_requested() and not rospy.is_shutdown():
            try:
                rospy.wait_for_service(self._name, 1.0)
                break
            except rospy.ROSException:
                rospy.logwarn(f"still waiting for the service '{self._name}'")
        if self.preempt_requested():
            self.service_preempt()
            return "preempted"
        try:
            request = filled(copy.copy(self._request), ud, *self._request_from)
            made = self._request_cb(ud, request)
            response = rospy.ServiceProxy(self._name, self._spec)(request if made is None else made)
            outcome = self._response_cb(ud, response)
        except Exception as error:  # noqa: BLE001  # smach's outcome for it is 'aborted'
            rospy.logerr(f"the service '{self._name}' cannot be used: {error!r}")
            return "aborted"
        taken_apart(response, ud, *self._response_to)
        return "succeeded" if outcome is None else outcome
