"""Values as TOML text: what the standard library reads, but does not write."""
import json


def value(v):
    if isinstance(v, bool):
        return "true" if v else "false"
    if isinstance(v, (int, float)):
        return repr(v)
    if isinstance(v, str):
        return json.dumps(v, ensure_ascii=False)
    return "[" + ", ".join(value(x) for x in v) + "]"


def is_table_list(v):
    return isinstance(v, list) and bool(v) and all(isinstance(x, dict) for x in v)


def table(values, path):
    lines = [f"{key} = {value(v)}" for key, v in values.items() if not isinstance(v, dict) and not is_table_list(v)]
    for key, v in values.items():
        name = f"{path}{key}"
        if isinstance(v, dict):
            lines += ["", f"[{name}]"] + table(v, name + ".")
        elif is_table_list(v):
            for item in v:
                lines += ["", f"[[{name}]]"] + table(item, name + ".")
    return lines


def dumps(values):
    """The text of a table; keys are bare words."""
    return "\n".join(table(values, "")) + "\n"
