// The parameters of a process as --print-config writes them: TOML with a comment behind every value.

export interface Parameter { section: string; key: string; value: string; unit: string; meaning: string; range: string }

/** `key = value  # [unit] meaning; range` behind `[section]`; other lines are left out. */
export function readSheet(text: string): Parameter[] {
  const parameters: Parameter[] = [];
  let section = "";
  for (const line of text.split("\n")) {
    const head = /^\[+([^\]]+)\]+/.exec(line);
    if (head?.[1] !== undefined) section = head[1];
    const found = /^(\w+) = (.*?)\s+# (?:\[([^\]]*)\] )?(.*)$/.exec(line);
    if (found === null) continue;
    const [, key = "", value = "", unit = "", comment = ""] = found;
    // Behind the last semicolon stands what the value may be; a text may be anything.
    const split = unit === "" && !comment.includes("; one of ") ? -1 : comment.lastIndexOf("; ");
    parameters.push({ section, key, value, unit: unit === "-" ? "" : unit,
      meaning: split < 0 ? comment : comment.slice(0, split), range: split < 0 ? "" : comment.slice(split + 2) });
  }
  return parameters;
}
