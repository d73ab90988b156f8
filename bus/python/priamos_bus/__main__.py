"""`python3 -m priamos_bus`: messages of a log or a bus as lines of JSON."""

import argparse
import json
import os
import signal
import sys

from . import Bus, BusError, Log, LogError, MessageError, Schema, SchemaError, bus_url, json_form, own_types, read_folder


def parse(arguments):
    parser = argparse.ArgumentParser(prog="priamos_bus", description=__doc__.split(": ", 1)[1])
    parser.add_argument("source", help="a log, or a bus: onboard, offboard or udpm://GROUP:PORT")
    parser.add_argument("channel", nargs="*", help="only these channels")
    parser.add_argument("--types", action="append", help="folder of .lcm files; may be given again; none: PRIAMOS's own")
    parser.add_argument("--robot", default=os.environ.get("PRIAMOS_ROBOT", "priamos"), help="name of the robot of a bus")
    parser.add_argument("--seconds", type=float, help="of a bus: end after so long")
    return parser.parse_args(arguments)


def line(**fields):
    print(json.dumps(fields, ensure_ascii=False, separators=(",", ":")), flush=not sys.stdout.isatty())


def show_log(path, texts, channels):
    """As `priamos log export LOG jsonl` does."""
    log = Log(path, texts)
    for event, message in log.messages(*channels):
        line(utime=event.utime, number=event.number, channel=event.channel, type=log.schema.of(event.data).full_name,
             message=json_form(message))
    if log.skipped_bytes:
        print(f"priamos_bus: {path}: {log.damaged_places} damaged places, {log.skipped_bytes} bytes skipped", file=sys.stderr)


def show_bus(url, texts, channels, seconds):
    with Bus(url, Schema(own_types() if texts is None else texts)) as bus:
        for channel, message in bus.messages(*channels, seconds=seconds):
            line(channel=channel, message=json_form(message))


def main(arguments=None):
    signal.signal(signal.SIGPIPE, signal.SIG_DFL)
    signal.signal(signal.SIGTERM, signal.default_int_handler)
    options = parse(arguments)
    try:
        texts = None if not options.types else [text for folder in options.types for text in read_folder(folder)]
        if options.source in ("onboard", "offboard"):
            show_bus(bus_url(options.source, options.robot), texts, options.channel, options.seconds)
        elif "://" in options.source:
            show_bus(options.source, texts, options.channel, options.seconds)
        else:
            show_log(options.source, texts, options.channel)
    except (BusError, LogError, MessageError, SchemaError) as error:
        print(f"priamos_bus: {error}", file=sys.stderr)
        return 2
    except KeyboardInterrupt:
        return 0
    return 0


if __name__ == "__main__":
    sys.exit(main())
