"""rosbridge: microseconds of processor time for a laser scan from a topic to a WebSocket client.

Publisher, server and client run in one process, so a figure is what all three take. The client only
reads frames. Beside it stands what the same text costs alone: Python's ``json`` of the message.

    gazelle bench rosbridge
"""

from __future__ import annotations

import argparse
import json
import time

import numpy as np
from websockets.sync.client import ClientConnection, connect

from gazelle_ros import Master, Node, Publisher, load_message
from gazelle_ros.rosbridge.server import BridgeServer
from gazelle_ros.rosbridge.settings import BridgeSettings

RAYS = 360
TOPIC = "/scan"


def measure(publisher: Publisher, client: ClientConnection, scans: int) -> tuple[float, int]:
    """Return processor time a scan [us] and the bytes of the last frame."""
    ranges = np.random.default_rng(0).uniform(0.1, 10.0, RAYS).astype(np.float32)
    message = load_message("sensor_msgs/LaserScan")(ranges=ranges)
    frame: str | bytes = b""
    begun = time.process_time()
    for _ in range(scans):
        publisher.publish(message)
        frame = client.recv(timeout=60.0)
    return (time.process_time() - begun) / scans * 1e6, len(frame)


def subscribed(port: int, publisher: Publisher, compression: str) -> ClientConnection:
    """Return a client that subscribes to the scans."""
    client = connect(f"ws://127.0.0.1:{port}", max_size=None)
    ask = {"op": "subscribe", "topic": TOPIC, "compression": compression}
    client.send(json.dumps(ask))
    end = time.monotonic() + 30.0
    while publisher.num_connections < 1 and time.monotonic() < end:
        time.sleep(0.01)
    return client


def main() -> None:
    """Measure each encoding."""
    parser = argparse.ArgumentParser(prog="gazelle bench rosbridge", description=__doc__)
    parser.add_argument("--scans", type=int, default=1000, help="for each figure (%(default)s)")
    args = parser.parse_args()
    settings = BridgeSettings(port=0, unregister_timeout=0.05)
    print(f"{RAYS} rays{'us a scan':>20}{'bytes':>10}")
    with (
        Master(port=0, rosout=False) as master,
        Node("rosbridge_websocket", master_uri=master.uri) as node,
        BridgeServer(node, settings) as server,
        Node("robot", master_uri=master.uri) as robot,
    ):
        publisher = robot.advertise(TOPIC, load_message("sensor_msgs/LaserScan"))
        for compression in ("none", "cbor", "cbor-raw"):
            client = subscribed(server.port, publisher, compression)
            measure(publisher, client, 20)
            spent, size = measure(publisher, client, args.scans)
            client.close()
            while publisher.num_connections:
                time.sleep(0.01)
            print(f"{compression:10}{spent:>18.0f}{size:>10}")
    values = np.random.default_rng(0).uniform(0.1, 10.0, RAYS).astype(np.float32).tolist()
    begun = time.process_time()
    for _ in range(args.scans):
        json.dumps({"ranges": values})
    print(f"{'json alone':10}{(time.process_time() - begun) / args.scans * 1e6:>18.0f}")


if __name__ == "__main__":
    main()
