"""Compares what bus/python reads from a log with what `priamos log export LOG jsonl` wrote: same_log.py LOG LINES."""

import json
import sys

import priamos_bus as bus

log = bus.Log(sys.argv[1], texts=[])
with open(sys.argv[2], encoding="utf-8") as file:
    for (event, message), line in zip(log.messages(), file, strict=True):
        got = {"utime": event.utime, "number": event.number, "channel": event.channel,
               "type": log.schema.of(event.data).full_name, "message": bus.json_form(message)}
        if json.dumps(got) != json.dumps(json.loads(line)):
            sys.exit(f"expected {line}got {json.dumps(got)}")
    messages = sum(1 for _ in log.messages())
print(f"{messages} messages, the same; {log.skipped_bytes} bytes skipped, {log.damaged_places} places")
