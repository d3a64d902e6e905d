# Written by tools/message_stubs.py from the bundled definitions; not to be edited.
from typing import ClassVar as _ClassVar
from gazelle_ros.messages import Message as _Message
from gazelle_ros.messages import ServiceDefinition as _ServiceDefinition
from gazelle_ros.time import Time as _Time
from gazelle_ros.msgs.rosapi import msg as _rosapi

class DeleteParamRequest(_Message):
    name: str
    def __init__(self, name: str | None = ...) -> None: ...
class DeleteParamResponse(_Message):
    def __init__(self) -> None: ...
class DeleteParam(_ServiceDefinition):
    _request_class: _ClassVar[type[DeleteParamRequest]]
    _response_class: _ClassVar[type[DeleteParamResponse]]
class GetActionServersRequest(_Message):
    def __init__(self) -> None: ...
class GetActionServersResponse(_Message):
    action_servers: list[str]
    def __init__(self, action_servers: list[str] | None = ...) -> None: ...
class GetActionServers(_ServiceDefinition):
    _request_class: _ClassVar[type[GetActionServersRequest]]
    _response_class: _ClassVar[type[GetActionServersResponse]]
class GetParamRequest(_Message):
    name: str
    default: str
    def __init__(self, name: str | None = ..., default: str | None = ...) -> None: ...
class GetParamResponse(_Message):
    value: str
    def __init__(self, value: str | None = ...) -> None: ...
class GetParam(_ServiceDefinition):
    _request_class: _ClassVar[type[GetParamRequest]]
    _response_class: _ClassVar[type[GetParamResponse]]
class GetParamNamesRequest(_Message):
    def __init__(self) -> None: ...
class GetParamNamesResponse(_Message):
    names: list[str]
    def __init__(self, names: list[str] | None = ...) -> None: ...
class GetParamNames(_ServiceDefinition):
    _request_class: _ClassVar[type[GetParamNamesRequest]]
    _response_class: _ClassVar[type[GetParamNamesResponse]]
class GetTimeRequest(_Message):
    def __init__(self) -> None: ...
class GetTimeResponse(_Message):
    time: _Time
    def __init__(self, time: _Time | None = ...) -> None: ...
class GetTime(_ServiceDefinition):
    _request_class: _ClassVar[type[GetTimeRequest]]
    _response_class: _ClassVar[type[GetTimeResponse]]
class HasParamRequest(_Message):
    name: str
    def __init__(self, name: str | None = ...) -> None: ...
class HasParamResponse(_Message):
    exists: bool
    def __init__(self, exists: bool | None = ...) -> None: ...
class HasParam(_ServiceDefinition):
    _request_class: _ClassVar[type[HasParamRequest]]
    _response_class: _ClassVar[type[HasParamResponse]]
class MessageDetailsRequest(_Message):
    type: str
    def __init__(self, type: str | None = ...) -> None: ...
class MessageDetailsResponse(_Message):
    typedefs: list[_rosapi.TypeDef]
    def __init__(self, typedefs: list[_rosapi.TypeDef] | None = ...) -> None: ...
class MessageDetails(_ServiceDefinition):
    _request_class: _ClassVar[type[MessageDetailsRequest]]
    _response_class: _ClassVar[type[MessageDetailsResponse]]
class NodeDetailsRequest(_Message):
    node: str
    def __init__(self, node: str | None = ...) -> None: ...
class NodeDetailsResponse(_Message):
    subscribing: list[str]
    publishing: list[str]
    services: list[str]
    def __init__(self, subscribing: list[str] | None = ..., publishing: list[str] | None = ..., services: list[str] | None = ...) -> None: ...
class NodeDetails(_ServiceDefinition):
    _request_class: _ClassVar[type[NodeDetailsRequest]]
    _response_class: _ClassVar[type[NodeDetailsResponse]]
class NodesRequest(_Message):
    def __init__(self) -> None: ...
class NodesResponse(_Message):
    nodes: list[str]
    def __init__(self, nodes: list[str] | None = ...) -> None: ...
class Nodes(_ServiceDefinition):
    _request_class: _ClassVar[type[NodesRequest]]
    _response_class: _ClassVar[type[NodesResponse]]
class PublishersRequest(_Message):
    topic: str
    def __init__(self, topic: str | None = ...) -> None: ...
class PublishersResponse(_Message):
    publishers: list[str]
    def __init__(self, publishers: list[str] | None = ...) -> None: ...
class Publishers(_ServiceDefinition):
    _request_class: _ClassVar[type[PublishersRequest]]
    _response_class: _ClassVar[type[PublishersResponse]]
class SearchParamRequest(_Message):
    name: str
    def __init__(self, name: str | None = ...) -> None: ...
class SearchParamResponse(_Message):
    global_name: str
    def __init__(self, global_name: str | None = ...) -> None: ...
class SearchParam(_ServiceDefinition):
    _request_class: _ClassVar[type[SearchParamRequest]]
    _response_class: _ClassVar[type[SearchParamResponse]]
class ServiceHostRequest(_Message):
    service: str
    def __init__(self, service: str | None = ...) -> None: ...
class ServiceHostResponse(_Message):
    host: str
    def __init__(self, host: str | None = ...) -> None: ...
class ServiceHost(_ServiceDefinition):
    _request_class: _ClassVar[type[ServiceHostRequest]]
    _response_class: _ClassVar[type[ServiceHostResponse]]
class ServiceNodeRequest(_Message):
    service: str
    def __init__(self, service: str | None = ...) -> None: ...
class ServiceNodeResponse(_Message):
    node: str
    def __init__(self, node: str | None = ...) -> None: ...
class ServiceNode(_ServiceDefinition):
    _request_class: _ClassVar[type[ServiceNodeRequest]]
    _response_class: _ClassVar[type[ServiceNodeResponse]]
class ServiceProvidersRequest(_Message):
    service: str
    def __init__(self, service: str | None = ...) -> None: ...
class ServiceProvidersResponse(_Message):
    providers: list[str]
    def __init__(self, providers: list[str] | None = ...) -> None: ...
class ServiceProviders(_ServiceDefinition):
    _request_class: _ClassVar[type[ServiceProvidersRequest]]
    _response_class: _ClassVar[type[ServiceProvidersResponse]]
class ServiceRequestDetailsRequest(_Message):
    type: str
    def __init__(self, type: str | None = ...) -> None: ...
class ServiceRequestDetailsResponse(_Message):
    typedefs: list[_rosapi.TypeDef]
    def __init__(self, typedefs: list[_rosapi.TypeDef] | None = ...) -> None: ...
class ServiceRequestDetails(_ServiceDefinition):
    _request_class: _ClassVar[type[ServiceRequestDetailsRequest]]
    _response_class: _ClassVar[type[ServiceRequestDetailsResponse]]
class ServiceResponseDetailsRequest(_Message):
    type: str
    def __init__(self, type: str | None = ...) -> None: ...
class ServiceResponseDetailsResponse(_Message):
    typedefs: list[_rosapi.TypeDef]
    def __init__(self, typedefs: list[_rosapi.TypeDef] | None = ...) -> None: ...
class ServiceResponseDetails(_ServiceDefinition):
    _request_class: _ClassVar[type[ServiceResponseDetailsRequest]]
    _response_class: _ClassVar[type[ServiceResponseDetailsResponse]]
class ServiceTypeRequest(_Message):
    service: str
    def __init__(self, service: str | None = ...) -> None: ...
class ServiceTypeResponse(_Message):
    type: str
    def __init__(self, type: str | None = ...) -> None: ...
class ServiceType(_ServiceDefinition):
    _request_class: _ClassVar[type[ServiceTypeRequest]]
    _response_class: _ClassVar[type[ServiceTypeResponse]]
class ServicesRequest(_Message):
    def __init__(self) -> None: ...
class ServicesResponse(_Message):
    services: list[str]
    def __init__(self, services: list[str] | None = ...) -> None: ...
class Services(_ServiceDefinition):
    _request_class: _ClassVar[type[ServicesRequest]]
    _response_class: _ClassVar[type[ServicesResponse]]
class ServicesForTypeRequest(_Message):
    type: str
    def __init__(self, type: str | None = ...) -> None: ...
class ServicesForTypeResponse(_Message):
    services: list[str]
    def __init__(self, services: list[str] | None = ...) -> None: ...
class ServicesForType(_ServiceDefinition):
    _request_class: _ClassVar[type[ServicesForTypeRequest]]
    _response_class: _ClassVar[type[ServicesForTypeResponse]]
class SetParamRequest(_Message):
    name: str
    value: str
    def __init__(self, name: str | None = ..., value: str | None = ...) -> None: ...
class SetParamResponse(_Message):
    def __init__(self) -> None: ...
class SetParam(_ServiceDefinition):
    _request_class: _ClassVar[type[SetParamRequest]]
    _response_class: _ClassVar[type[SetParamResponse]]
class SubscribersRequest(_Message):
    topic: str
    def __init__(self, topic: str | None = ...) -> None: ...
class SubscribersResponse(_Message):
    subscribers: list[str]
    def __init__(self, subscribers: list[str] | None = ...) -> None: ...
class Subscribers(_ServiceDefinition):
    _request_class: _ClassVar[type[SubscribersRequest]]
    _response_class: _ClassVar[type[SubscribersResponse]]
class TopicTypeRequest(_Message):
    topic: str
    def __init__(self, topic: str | None = ...) -> None: ...
class TopicTypeResponse(_Message):
    type: str
    def __init__(self, type: str | None = ...) -> None: ...
class TopicType(_ServiceDefinition):
    _request_class: _ClassVar[type[TopicTypeRequest]]
    _response_class: _ClassVar[type[TopicTypeResponse]]
class TopicsRequest(_Message):
    def __init__(self) -> None: ...
class TopicsResponse(_Message):
    topics: list[str]
    types: list[str]
    def __init__(self, topics: list[str] | None = ..., types: list[str] | None = ...) -> None: ...
class Topics(_ServiceDefinition):
    _request_class: _ClassVar[type[TopicsRequest]]
    _response_class: _ClassVar[type[TopicsResponse]]
class TopicsAndRawTypesRequest(_Message):
    def __init__(self) -> None: ...
class TopicsAndRawTypesResponse(_Message):
    topics: list[str]
    types: list[str]
    typedefs_full_text: list[str]
    def __init__(self, topics: list[str] | None = ..., types: list[str] | None = ..., typedefs_full_text: list[str] | None = ...) -> None: ...
class TopicsAndRawTypes(_ServiceDefinition):
    _request_class: _ClassVar[type[TopicsAndRawTypesRequest]]
    _response_class: _ClassVar[type[TopicsAndRawTypesResponse]]
class TopicsForTypeRequest(_Message):
    type: str
    def __init__(self, type: str | None = ...) -> None: ...
class TopicsForTypeResponse(_Message):
    topics: list[str]
    def __init__(self, topics: list[str] | None = ...) -> None: ...
class TopicsForType(_ServiceDefinition):
    _request_class: _ClassVar[type[TopicsForTypeRequest]]
    _response_class: _ClassVar[type[TopicsForTypeResponse]]
