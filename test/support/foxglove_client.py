"""A client of foxglove.websocket.v1, written from its specification (https://github.com/foxglove/ws-protocol). Standard library only."""
import json
import struct
import threading

from web_socket import WebSocket

PROTOCOL = "foxglove.websocket.v1"
MESSAGE, TIME, ANSWER = 1, 2, 3


class Foxglove:
    """Keeps what the server offers, the newest message and the number of messages of each topic, and answers of services."""

    def __init__(self, port, target="/", origin=None):
        self.info, self.channels, self.services, self.status = None, {}, {}, []
        self.newest, self.counts, self.times, self.answers, self.time = {}, {}, {}, {}, None
        self.topics = {}  # by subscription
        self.parameters, self.parameter_answers = {}, {}
        self.socket = WebSocket(port, target, origin=origin, protocol=PROTOCOL)
        assert f"Sec-WebSocket-Protocol: {PROTOCOL}".encode() in self.socket.head, self.socket.head
        threading.Thread(target=self._listen, daemon=True).start()

    def subscribe(self, *topics):
        wishes = []
        for topic in topics:
            self.topics[len(self.topics) + 100] = topic
            wishes.append({"id": len(self.topics) + 99, "channelId": self.channels[topic]["id"]})
        self.socket.send(json.dumps({"op": "subscribe", "subscriptions": wishes}))

    def unsubscribe(self, topic):
        numbers = [number for number, name in self.topics.items() if name == topic]
        self.socket.send(json.dumps({"op": "unsubscribe", "subscriptionIds": numbers}))

    def call(self, service, number, **fields):
        head = struct.pack("<BIII", 2, self.services[service]["id"], number, 4) + b"json"
        self.socket.send(head + json.dumps(fields).encode(), 2)

    def ask_parameters(self, *names, number=""):
        self.socket.send(json.dumps({"op": "getParameters", "parameterNames": names, "id": number}))

    def set_parameter(self, name, value, number=""):
        self.socket.send(json.dumps({"op": "setParameters", "parameters": [{"name": name, "value": value}], "id": number}))

    def close(self):
        self.socket.close()

    def _listen(self):
        try:
            while True:
                kind, content = self.socket.receive()
                if kind == 1:
                    self._take(json.loads(content))
                elif kind == 2:
                    self._take_bytes(content)
        except OSError:
            pass

    def _take(self, text):
        if text["op"] == "serverInfo":
            self.info = text
        elif text["op"] == "advertise":
            self.channels.update({channel["topic"]: channel for channel in text["channels"]})
        elif text["op"] == "advertiseServices":
            self.services.update({service["name"]: service for service in text["services"]})
        elif text["op"] == "parameterValues":
            values = {parameter["name"]: parameter["value"] for parameter in text["parameters"]}
            self.parameters.update(values)
            if "id" in text:
                self.parameter_answers[text["id"]] = values
        elif text["op"] == "serviceCallFailure":
            self.answers[text["callId"]] = text["message"]
        elif text["op"] == "status":
            self.status.append(text["message"])

    def _take_bytes(self, content):
        if content[0] == MESSAGE:
            subscription, time_ns = struct.unpack_from("<IQ", content, 1)
            topic = self.topics[subscription]
            self.newest[topic], self.times[topic] = json.loads(content[13:]), time_ns
            self.counts[topic] = self.counts.get(topic, 0) + 1
        elif content[0] == TIME:
            self.time, = struct.unpack_from("<Q", content, 1)
        elif content[0] == ANSWER:
            service, call, length = struct.unpack_from("<III", content, 1)
            self.answers[call] = json.loads(content[13 + length:])
