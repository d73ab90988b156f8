// The numbers in a message: their paths, values and units.

export type Json = null | boolean | number | string | Json[] | { [key: string]: Json };

const MOST_OF_AN_ARRAY = 32;

/** Paths of all numbers and flags in a message: "x_m", "range_m[3]", "points[0].x_m". Time stamps are left out. */
export function numberPaths(message: Json, prefix = ""): string[] {
  if (typeof message === "number" || typeof message === "boolean") return [prefix];
  if (Array.isArray(message))
    return message.slice(0, MOST_OF_AN_ARRAY).flatMap((one, i) => numberPaths(one, `${prefix}[${i}]`));
  if (message === null || typeof message !== "object") return [];
  return Object.entries(message).filter(([key]) => !key.startsWith("utime"))
    .flatMap(([key, value]) => numberPaths(value, prefix === "" ? key : `${prefix}.${key}`));
}

function steps(path: string): (string | number)[] {
  return [...path.matchAll(/\[(\d+)\]|[^.[\]]+/g)].map((m) => m[1] === undefined ? m[0] : Number(m[1]));
}

/** The number at a path; undefined when there is none, as for NaN, which messages have as a text. */
export function numberAt(message: Json, path: string): number | undefined {
  let value: Json | undefined = message;
  for (const step of steps(path)) {
    if (value === null || typeof value !== "object" || value === undefined) return undefined;
    value = Array.isArray(value) ? value[step as number] : value[String(step)];
  }
  if (typeof value === "boolean") return value ? 1 : 0;
  return typeof value === "number" ? value : undefined;
}

export interface TypeSchema {
  properties?: Record<string, TypeSchema>;
  items?: TypeSchema;
  description?: string;
}

/** What the type says of a number: "[m] in frame map, from -100 to 100: ..."; empty when it says nothing. */
export function describe(schema: TypeSchema | undefined, path: string): string {
  let description = "";
  for (const step of steps(path)) {
    schema = typeof step === "number" ? schema?.items : schema?.properties?.[step];
    description = schema?.description ?? description;
  }
  return description;
}

/** "m" of "[m] in frame map ..."; empty for plain numbers. */
export function unitOf(description: string): string {
  return /^\[([^\]]*)\]/.exec(description)?.[1] ?? "";
}
