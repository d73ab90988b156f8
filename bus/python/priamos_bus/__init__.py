"""PRIAMOS's bus in Python: logs, packed messages, UDP multicast. The standard library alone; see README.md."""

from .decoding import decode
from .encoding import encode, filled, json_form
from .log import Event, Log, LogError, LogWriter
from .model import MessageError, SchemaError
from .packing import Packed, Packer
from .schema import Schema, fingerprint_of, own_types, read_folder
from .udp import Bus, BusError, bus_url

__all__ = ["Bus", "BusError", "Event", "Log", "LogError", "LogWriter", "MessageError", "Packed", "Packer", "Schema",
           "SchemaError", "bus_url", "decode", "encode", "filled", "fingerprint_of", "json_form", "own_types", "read_folder"]
